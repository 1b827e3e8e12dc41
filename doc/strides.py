#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""hpa4 beside hpa3: time, unknowns and steps to some true errors, without the bound, into doc/accuracy.md.

The reference solution of a scene without a closed form is that of hpa3 far beyond need. A run of hpa3 to the end says
which relative indicator belongs to each true error. Both methods then run to that tolerance, in turn, hpa4 to a smaller one where its
true error is still above. Seconds are those of all stages on one thread, medians.
"""
import argparse
import csv
import os
import pathlib
import statistics
import subprocess
import sys

from accuracy import HERE, QUIET, TOP, put_table, write_csv

ERRORS = (1e-3, 1e-4, 1e-6)
EXACT = ("hertz", "stick-slip")
SCENES = EXACT + ("han-6-12", "han-6-13", "han-6-12-unilateral", "plane-strain", "punch", "punch-friction", "punch-limited",
                  "blocks", "resting", "receding", "semicoercive", "footing", "ssnv128", "partial-slip", "propped", "slope",
                  "ballast", "glued")
SETTINGS = QUIET + ["Error/Bound=false", "Adaptivity/Indicator=residual", "Adaptivity/Tolerance on=residual",
                    "Adaptivity/Maximum degree=12", "Adaptivity/Maximum steps=60", "Solver/Threads=1"]


def run(program, home, scene, settings):
    """Rows of convergence.csv; none where the run fails or takes too long."""
    command = [program, "--output", str(home / scene), str(TOP / "prm" / f"{scene}.prm")]
    for setting in SETTINGS + settings:
        command += ["--set", setting]
    try:
        subprocess.run(command, check=True, capture_output=True, timeout=300)
    except (subprocess.CalledProcessError, subprocess.TimeoutExpired):
        return []
    return list(csv.DictReader(open(home / scene / "convergence.csv")))


def reference(program, home, scene):
    """The setting that measures true errors, and how far that can be trusted."""
    if scene in EXACT:
        return [], 0.
    rows = run(program, home / "reference", scene,
               ["Adaptivity/Method=hpa3", "Adaptivity/Tolerance=1e-8", "Adaptivity/Maximum unknowns=130000",
                "Output/Reference solution=true"])
    if not rows:
        return None, 0.
    return ([f"Error/Reference solution={home / 'reference' / scene / 'reference.dat'}"],
            float(rows[-1]["estimate_relative"]))


def to_error(program, home, scene, method, truth, error, tolerance):
    """The tolerance at which the method has that error, and its rows."""
    for _ in range(6):
        rows = run(program, home, scene, [f"Adaptivity/Method={method}", f"Adaptivity/Tolerance={tolerance}"] + truth)
        if not rows:
            return None, []
        if float(rows[-1]["error_relative"]) <= error:
            return tolerance, rows
        tolerance *= 0.7
    return None, []


def compare(program, home, scene, repeats):
    truth, trust = reference(program, home, scene)
    if truth is None:
        return []
    whole = run(program, home, scene, ["Adaptivity/Method=hpa3", "Adaptivity/Tolerance=0",
                                       "Adaptivity/Maximum unknowns=70000"] + truth)
    table = []
    for error in ERRORS:
        step = next((row for row in whole if float(row["error_relative"]) <= error), None)
        if step is None or step is whole[0] or trust > 0.5 * error:
            continue
        found = {method: to_error(program, home, scene, method, truth, error,
                                  1.0001 * float(step["estimate_relative"])) for method in ("hpa3", "hpa4")}
        if None in (tolerance for tolerance, _ in found.values()):
            continue
        seconds = {"hpa3": [], "hpa4": []}
        for _ in range(repeats):
            for method in seconds:
                rows = run(program, home, scene, [f"Adaptivity/Method={method}",
                                                  f"Adaptivity/Tolerance={found[method][0]}"])
                seconds[method].append([float(row["seconds"]) for row in rows])
        old, new = ([statistics.median(times) for times in zip(*seconds[method])] for method in ("hpa3", "hpa4"))
        last_old, last_new = found["hpa3"][1][-1], found["hpa4"][1][-1]
        table.append({"scene": scene, "error": f"{error:.0e}", "hpa3 steps": last_old["step"], "hpa3 N": last_old["dofs_free"],
                      "hpa3 s": f"{old[-1]:.4f}", "hpa4 steps": last_new["step"], "hpa4 N": last_new["dofs_free"],
                      "hpa4 s": f"{new[-1]:.4f}", "time": f"{new[-1] / old[-1]:.2f}",
                      "unknowns": f"{int(last_new['dofs_free']) / int(last_old['dofs_free']):.2f}",
                      "all / last": f"{new[-1] / (new[-1] - (new[-2] if len(new) > 1 else 0)):.2f}"})
        print(table[-1], flush=True)
    return table


def summary(table):
    rows = []
    for error in ERRORS:
        of_error = [row for row in table if row["error"] == f"{error:.0e}"]
        if not of_error:
            continue
        column = lambda name: [float(row[name]) for row in of_error]
        rows.append({"error": f"{error:.0e}", "scenes": len(of_error),
                     **{f"{name}, {what}": f"{function(column(name)):.2f}" for name in ("time", "unknowns", "all / last")
                        for what, function in (("median", statistics.median), ("largest", max))},
                     "steps, largest": max(int(row["hpa4 steps"]) for row in of_error)})
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default="build/hpvi")
    parser.add_argument("--output", default="output/strides", type=pathlib.Path)
    parser.add_argument("--repeats", default=5, type=int)
    parser.add_argument("--scenes", nargs="*", default=SCENES)
    arguments = parser.parse_args()
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    home = arguments.output.resolve()
    (home / "reference").mkdir(parents=True, exist_ok=True)
    table = []
    for scene in arguments.scenes:
        table += compare(str(pathlib.Path(arguments.program).resolve()), home, scene, arguments.repeats)
    if not table:
        sys.exit("no scene comes to any of the errors")
    write_csv("strides.csv", table)
    put_table("strides_summary", summary(table))


if __name__ == "__main__":
    main()
