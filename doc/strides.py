#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""hpa4 beside hpa3: time, unknowns and steps to some true errors, without the bound, into doc/accuracy.md.

The reference solution of a scene without a closed form is that of hpa3 far beyond need. A run of hpa3 to the end says
which relative indicator belongs to each true error. Both methods then run to that tolerance, in turn, hpa4 to a smaller one where its
true error is still above. Seconds are those of all stages on one thread, medians.

With --random K it does so on K random boxes instead, and compares work, the sum of N^1.2 over all steps, and unknowns.
"""
import argparse
import csv
import os
import pathlib
import random
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


def random_box(chance, path):
    """A box on a foundation: two materials, a gap, loads that jump or are smooth, Tresca's friction, Coulomb's or none."""
    number = lambda low, high: f"{chance.uniform(low, high):.3g}"
    width, places = chance.uniform(0.7, 4), (number(0.2, 0.8), number(0.1, 0.4))
    profile = chance.choice(["1", "if(abs(x/{w} - {0}) < {1}, 1, 0)", "exp(-((x/{w} - {0})/{1})^2)",
                             "max(0, 1 - abs(x/{w} - {0})/{1})"]).format(*places, w=f"{width:.3g}")
    friction = chance.choice([f"Friction bound = {number(0.02, 0.3)}", f"Friction bound = {number(0.05, 0.3)}*(1 + x)",
                              f"Friction coefficient = {number(0.1, 0.6)}", "Friction bound = 0"])
    held = "Contact = unilateral" if "coefficient" in friction else chance.choice(["Contact = unilateral", "Contact = bilateral"])
    gap = chance.choice(["0", f"{number(0.002, 0.02)}*(x - {number(0.2, 0.8)}*{width:.3g})^2"])
    side = chance.choice(["Symmetry = true", "Displacement = 0; 0"])
    sections = {"Geometry": ["Shape = box", "Lower corner = 0, 0", f"Upper corner = {width:.3g}, 1",
                             f"Subdivisions = {max(1, round(2 * width))}, {chance.choice([1, 2, 3])}"],
                "Material": ["Young's modulus = 10", f"Poisson's ratio = {number(0, 0.4)}", "Plane = strain"],
                "Boundary left": [side],
                "Boundary top": [f"Traction = {number(-0.2, 0.2)}*{profile}; -{number(0.1, 1)}*{profile}"],
                "Boundary bottom": [held, friction] + ([f"Gap = {gap}"] if "unilateral" in held else []),
                "Adaptivity": ["Method = hpa3"]}
    if chance.random() < 0.3:
        sections["Material other"] = [f"Where = {number(0.2, 0.8)} - y", f"Young's modulus = {10 ** chance.uniform(-1, 3):.3g}"]
    lines = ["set Dimension = 2"]
    for name, entries in sections.items():
        lines += [f"subsection {name}"] + [f"  set {entry}" for entry in entries] + ["end"]
    path.write_text("\n".join(lines) + "\n")


def work(rows):
    return sum(int(row["dofs_free"]) ** 1.2 for row in rows)


def attack(program, home, count, seed):
    """Rows of all random boxes that come to an error; the worst of each error is printed."""
    table, failed = [], 0
    for k in range(count):
        scene = home / f"box-{k}.prm"
        random_box(random.Random(seed * 1000 + k), scene)
        truth, trust = reference(program, home, scene, "40000")
        whole = [] if truth is None else run(program, home, scene, ["Adaptivity/Method=hpa3", "Adaptivity/Tolerance=0",
                                                                    "Adaptivity/Maximum unknowns=20000"] + truth)
        failed += not whole
        for error in (1e-3, 1e-5):
            last = next((j for j, row in enumerate(whole) if float(row["error_relative"]) <= error), 0)
            if last == 0 or trust > 0.5 * error:
                continue
            old = whole[:last + 1]
            _, new = to_error(program, home, scene, "hpa4", truth, error, 1.0001 * float(old[-1]["estimate_relative"]))
            table.append({"scene": k, "error": f"{error:.0e}", "hpa3 steps": len(old), "hpa4 steps": len(new) or "-",
                          "work": f"{work(new) / work(old):.2f}" if new else "-",
                          "unknowns": f"{int(new[-1]['dofs_free']) / int(old[-1]['dofs_free']):.2f}" if new else "-"})
            print(table[-1], flush=True)
    print(f"{count} scenes, {failed} without a solution in time")
    for error in ("1e-03", "1e-05"):
        for name, most in (("work", 1.2), ("unknowns", 4)):
            values = [float(row[name]) for row in table if row["error"] == error and row[name] != "-"]
            if values:
                print(f"{error}: {name} of {len(values)}: median {statistics.median(values):.2f}, largest {max(values):.2f}, "
                      f"above {most}: {sum(value > most for value in values)}")


def run(program, home, scene, settings):
    """Rows of convergence.csv; none where the run fails or takes too long."""
    path = scene if isinstance(scene, pathlib.Path) else TOP / "prm" / f"{scene}.prm"
    command = [program, "--output", str(home / path.stem), str(path)]
    for setting in SETTINGS + settings:
        command += ["--set", setting]
    try:
        subprocess.run(command, check=True, capture_output=True, timeout=300)
    except (subprocess.CalledProcessError, subprocess.TimeoutExpired):
        return []
    return list(csv.DictReader(open(home / path.stem / "convergence.csv")))


def reference(program, home, scene, most="130000"):
    """The setting that measures true errors, and how far that can be trusted."""
    if scene in EXACT:
        return [], 0.
    rows = run(program, home / "reference", scene,
               ["Adaptivity/Method=hpa3", "Adaptivity/Tolerance=1e-8", f"Adaptivity/Maximum unknowns={most}",
                "Output/Reference solution=true"])
    if not rows:
        return None, 0.
    name = scene.stem if isinstance(scene, pathlib.Path) else scene
    return ([f"Error/Reference solution={home / 'reference' / name / 'reference.dat'}"],
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
    parser.add_argument("--random", type=int, metavar="K")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    home = arguments.output.resolve()
    (home / "reference").mkdir(parents=True, exist_ok=True)
    if arguments.random:
        return attack(str(pathlib.Path(arguments.program).resolve()), home, arguments.random, arguments.seed)
    table = []
    for scene in arguments.scenes:
        table += compare(str(pathlib.Path(arguments.program).resolve()), home, scene, arguments.repeats)
    if not table:
        sys.exit("no scene comes to any of the errors")
    write_csv("strides.csv", table)
    put_table("strides_summary", summary(table))


if __name__ == "__main__":
    main()
