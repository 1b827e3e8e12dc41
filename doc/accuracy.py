#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""How long until the answer is this accurate? Runs every method on three problems and draws it.

Makes overkill reference solutions of Examples 5.2 and 5.3 by three refinement paths, compares them, measures every method against them (against the exact solution on the stick-slip scene), without
the guaranteed bound, then some with it, and writes charts and tables to doc/accuracy/ and into doc/accuracy.md, between its marker comments.
"""
import argparse
import csv
import math
import os
import pathlib
import re
import statistics
import subprocess
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
TOP = HERE.parent
GALLERY = HERE / "accuracy"
QUIET = ["Output/VTU=false", "Output/Contact tables=false"]
NO_BOUND, BOUND = ["Error/Bound=false"], ["Error/Bound=true"]
STAGES = "setup assemble factor qp recover estimate decide refine".split()
PROBLEMS = {"han-6-12": "Example 5.2", "han-6-13": "Example 5.3", "stick-slip": "Stick-slip, exact"}
METHODS = {  # colour, marker, line
    "hup2": ("#56b4e9", "o", ":"), "hup3": ("#0072b2", "s", ":"), "hup4": ("#003a63", "D", ":"),
    "hap2": ("#f0c030", "^", "--"), "hap3": ("#e69f00", "v", "--"), "hap4": ("#8a5a00", ">", "--"),
    "pu": ("#cc79a7", "P", "-."), "hpa1": ("#009e73", "X", "-"), "hpa2": ("#d55e00", "*", "-"),
    "hpa3": ("#000000", "h", "-")}
REPEATS = 3


class Run:
    """One run of the program: its rows, and the peak memory of the process in bytes."""

    def __init__(self, program, scene, home, settings):
        command = [program, "--output", str(home), str(TOP / "prm" / f"{scene}.prm")]
        for setting in QUIET + NO_BOUND + settings:  # the last one counts
            command += ["--set", setting]
        home.mkdir(parents=True, exist_ok=True)
        with open(home / "log", "w") as log:
            process = subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT)
            _, status, usage = os.wait4(process.pid, 0)
        if status != 0:
            sys.exit(f"{' '.join(command)} failed:\n{(home / 'log').read_text()}")
        if "(Release build)" not in (home / "log").read_text():
            sys.exit("this is a Debug build: build Release to measure")
        self.rows = list(csv.DictReader(open(home / "convergence.csv")))
        self.peak = usage.ru_maxrss * 1024

    def column(self, name):
        return np.array([float(row[name] or "nan") for row in self.rows])


def progress(text):
    print(text, flush=True)


PATHS = {  # the first is the reference; errors of the others are measured against it
    "hpa3, plain": ["Adaptivity/Method=hpa3", "Adaptivity/Smoothness reading=plain",
                    "Adaptivity/Maximum unknowns=200000"],
    "hpa3, joint, from p = 5": ["Adaptivity/Method=hpa3", "Adaptivity/Smoothness reading=joint",
                                "Adaptivity/Start degree=5", "Adaptivity/hpa3 threshold=0.1",
                                "Adaptivity/hpa3 decay threshold=1",
                                "Adaptivity/Maximum unknowns=200000"],
    "hpa2, plain": ["Adaptivity/Method=hpa2", "Adaptivity/Smoothness reading=plain",
                    "Adaptivity/Maximum unknowns=120000"]}


def references(program, home):
    """Overkill solutions by several paths; returns the reference file and facts of each example."""
    files, facts = {}, []
    for scene in ("han-6-12", "han-6-13"):
        for number, (path, settings) in enumerate(PATHS.items()):
            progress(f"reference solution of {PROBLEMS[scene]}: {path}")
            place = home / f"reference-{scene}-{number}"
            settings = settings + ["Adaptivity/Maximum degree=14", "Adaptivity/Maximum steps=99"]
            if number == 0:
                settings.append("Output/Reference solution=true")
                files[scene] = place / "reference.dat"
            else:
                settings.append(f"Error/Reference solution={files[scene]}")
            row = Run(program, scene, place, settings).rows[-1]
            facts.append({"example": PROBLEMS[scene][8:], "path": path, "N": row["dofs_free"],
                          "J": f"{float(row['energy']):.12f}",
                          "slack": f"{float(row['slack']):.1e}",
                          "transitions x": " ".join(f"{float(t.split('/')[0]):.8f}" for t in
                                                    row["transitions"].split()),
                          "friction resultant": f"{float(row['friction_resultant']):.10f}",
                          "relative indicator": f"{float(row['estimate_relative']):.1e}",
                          "relative distance to the first":
                              f"{float(row['error_relative']):.1e}" if number else "-",
                          "effectivity": f"{float(row['effectivity']):.1f}" if number else "-"})
    return files, facts


def measure(program, home, files):
    """Every method on every problem: errors from one run, times the median of several."""
    table = []
    for scene, title in PROBLEMS.items():
        for method in METHODS:
            progress(f"{title}: {method}")
            limit = {"pu": 3000, "hpa2": 70000, "hpa3": 70000}.get(method, 30000)
            settings = [f"Adaptivity/Method={method}", "Adaptivity/Smoothness reading=plain",
                        "Adaptivity/Maximum steps=60", "Adaptivity/Start degree=0",
                        "Adaptivity/Maximum degree=14",
                        f"Adaptivity/Maximum unknowns={limit}"]
            place = home / f"{scene}-{method}"
            timed = [Run(program, scene, place, settings) for _ in range(REPEATS)]
            if scene in files:
                settings.append(f"Error/Reference solution={files[scene]}")
                run = Run(program, scene, place, settings)
            else:
                run = timed[0]
            for k, row in enumerate(run.rows):
                seconds = statistics.median(float(t.rows[k]["seconds"]) for t in timed)
                table.append({"problem": scene, "method": method, "step": row["step"],
                              "dofs_free": row["dofs_free"], "seconds": f"{seconds:.5f}",
                              "error_energy": row["error_energy"],
                              "error_relative": row["error_relative"],
                              "effectivity": row["effectivity"],
                              "energy_difference": row["energy_difference"]})
    return table


def measure_bound(program, home, files):
    """One run with the bound of some methods: its seconds with that stage and without."""
    table = []
    for scene in PROBLEMS:
        for method in ("hap4", "hpa3"):
            progress(f"{PROBLEMS[scene]}: {method} with the bound")
            settings = [f"Adaptivity/Method={method}", "Adaptivity/Smoothness reading=plain",
                        "Adaptivity/Maximum steps=60", "Adaptivity/Start degree=0",
                        "Adaptivity/Maximum degree=14",
                        f"Adaptivity/Maximum unknowns={30000 if method == 'hap4' else 70000}"]
            if scene in files:
                settings.append(f"Error/Reference solution={files[scene]}")
            run = Run(program, scene, home / f"{scene}-{method}-bound", settings + BOUND)
            seconds = sum(run.column("seconds_" + s) for s in STAGES).cumsum()
            own = run.column("seconds_bound").cumsum()
            for k, row in enumerate(run.rows):
                table.append({"problem": scene, "method": method, "dofs_free": row["dofs_free"],
                              "seconds": f"{seconds[k]:.5f}",
                              "seconds_with_bound": f"{seconds[k] + own[k]:.5f}",
                              **{c: row[c] for c in ("error_energy", "error_relative",
                                                     "error_bound", "estimate_scaled")}})
    return table


def draw_bound(table):
    """What a run knows of its error, and what is true, against its time with the bound."""
    figure, panels = plt.subplots(1, 2, figsize=(11, 4.8), sharey=True, layout="constrained")
    for axes, scene in zip(panels, ("han-6-12", "han-6-13")):
        for method, colour in (("hap4", "#0072b2"), ("hpa3", "#d55e00")):
            error = select(table, scene, method, "error_energy")
            norm = error / select(table, scene, method, "error_relative")
            seconds = select(table, scene, method, "seconds_with_bound")
            for column, line, name in (("estimate_scaled", ":", "residual indicator"),
                                       ("error_bound", "--", "guaranteed bound"),
                                       ("error_energy", "-", "true error")):
                axes.loglog(seconds, select(table, scene, method, column) / norm, line,
                            color=colour, marker="o", markersize=3, linewidth=1.3,
                            label=f"{method}: {name}")
        axes.set_title(PROBLEMS[scene])
        axes.set_xlabel("time, one thread, with the bound [s]")
        axes.grid(alpha=0.3)
    panels[0].set_ylabel("relative to $|u|_a$ [-]")
    panels[-1].legend(loc="center left", bbox_to_anchor=(1.02, 0.5))
    save(figure, "bound.png")


def with_bound(table):
    """First step below some errors: seconds without and with the bound."""
    rows = []
    for scene, title in PROBLEMS.items():
        for method in ("hap4", "hpa3"):
            row = {"problem": title, "method": method}
            error = select(table, scene, method, "error_relative")
            for tolerance in (1e-2, 1e-3, 1e-4, 1e-5, 1e-6):
                below = np.nonzero(error <= tolerance)[0]
                row[f"e <= {tolerance:.0e}"] = " / ".join(
                    f"{select(table, scene, method, c)[below[0]]:.3f} s"
                    for c in ("seconds", "seconds_with_bound")) if len(below) else "-"
            rows.append(row)
    return rows


def select(table, scene, method, column):
    return np.array([float(r[column] or "nan") for r in table
                     if r["problem"] == scene and r["method"] == method])


def save(figure, name):
    figure.savefig(GALLERY / name, dpi=110)
    plt.close(figure)


def draw_chart(table, scene):
    figure, panels = plt.subplots(1, 2, figsize=(11, 5), sharey=True, layout="constrained")
    for method, (colour, marker, line) in METHODS.items():
        error = select(table, scene, method, "error_relative")
        for axes, column in zip(panels, ("seconds", "dofs_free")):
            axes.loglog(select(table, scene, method, column), error, color=colour, marker=marker,
                        linestyle=line, markersize=5, linewidth=1.3, label=method)
    panels[0].set_xlabel("time, one thread [s]")
    panels[1].set_xlabel("free displacement unknowns N [-]")
    panels[0].set_ylabel("true error $|u-u_N|_a / |u|_a$ [-]")
    for axes in panels:
        axes.grid(alpha=0.3)
    figure.suptitle(f"{PROBLEMS[scene]}: true error against time and unknowns")
    panels[-1].legend(loc="center left", bbox_to_anchor=(1.02, 0.5))
    save(figure, f"chart-{scene}.png")


def draw_effectivity(table):
    figure, panels = plt.subplots(1, 3, figsize=(12, 4), sharey=True, layout="constrained")
    for axes, scene in zip(panels, PROBLEMS):
        for method, (colour, marker, line) in METHODS.items():
            axes.loglog(select(table, scene, method, "dofs_free"),
                        select(table, scene, method, "effectivity"), color=colour, marker=marker,
                        linestyle=line, markersize=4, linewidth=1, label=method)
        axes.set_title(PROBLEMS[scene])
        axes.set_xlabel("free displacement unknowns N [-]")
        axes.grid(alpha=0.3, which="both")
    panels[0].set_ylabel("effectivity: scaled indicator / true error [-]")
    panels[-1].legend(loc="center left", bbox_to_anchor=(1.02, 0.5))
    save(figure, "effectivity.png")


def draw_stages(program, home):
    """Stacked stage times per step of the two hp-adaptive methods; returns the totals."""
    totals = []
    figure, panels = plt.subplots(1, 2, figsize=(11, 4.5), sharey=True, layout="constrained")
    colours = plt.get_cmap("tab10").colors
    for axes, method in zip(panels, ("hpa2", "hpa3")):
        progress(f"stage times: {method}")
        settings = [f"Adaptivity/Method={method}", "Adaptivity/Smoothness reading=plain",
                    "Adaptivity/Maximum steps=60", "Adaptivity/Maximum unknowns=60000"]
        runs = [Run(program, "han-6-12", home / "stages", settings) for _ in range(REPEATS)]
        n = runs[0].column("dofs_free")
        layers = [np.median([r.column("seconds_" + s) for r in runs], axis=0) for s in STAGES]
        axes.stackplot(n, [1000 * layer for layer in layers], labels=STAGES, colors=colours)
        axes.set_xlabel("free displacement unknowns N [-]")
        axes.set_title(f"Example 5.2, {method}")
        axes.grid(alpha=0.3)
        total = sum(layers)
        totals.append({"method": method, **{s: f"{layer.sum():.4f}" for s, layer in
                                            zip(STAGES, layers)},
                       "total": f"{total.sum():.4f}",
                       "total / factor": f"{total.sum() / layers[2].sum():.2f}"})
    panels[0].set_ylabel("time of one step [ms]")
    handles, labels = panels[0].get_legend_handles_labels()
    panels[-1].legend(handles[::-1], labels[::-1], loc="center left", bbox_to_anchor=(1.02, 0.5))
    save(figure, "stages.png")
    return totals


def draw_smooth(program, home):
    progress("smooth field: pu")
    run = Run(program, "smooth", home / "smooth", [])
    figure, axes = plt.subplots(figsize=(6, 4.2), layout="constrained")
    axes.semilogy(run.column("p_max"), run.column("error_relative"), "o-", color="#0072b2")
    axes.set_xlabel("polynomial degree p [-]")
    axes.set_ylabel("true error $|u-u_N|_a / |u|_a$ [-]")
    axes.set_title("Smooth exact solution: raising p alone")
    axes.grid(alpha=0.3)
    save(figure, "smooth.png")
    return [{"p": row["p_max"], "error_relative": row["error_relative"],
             "error_l2": row["error_l2"], "effectivity": row["effectivity"]} for row in run.rows]


def growth(program, home):
    """Time of the last step and peak memory against N, with fitted exponents."""
    rows = []
    base = Run(program, "han-6-12", home / "growth", ["Adaptivity/Maximum steps=1"]).peak
    for limit in (10000, 20000, 40000, 80000, 130000):
        progress(f"growth: {limit} unknowns")
        runs = [Run(program, "han-6-12", home / "growth",
                    ["Adaptivity/Maximum steps=60", "Adaptivity/Maximum degree=14",
                     "Adaptivity/Smoothness reading=plain",
                     f"Adaptivity/Maximum unknowns={limit}"]) for _ in range(REPEATS)]
        n = int(runs[0].rows[-1]["dofs_free"])
        last = statistics.median(r.column("seconds")[-1] - r.column("seconds")[-2] for r in runs)
        peak = statistics.median(r.peak for r in runs) - base
        rows.append({"N": n, "seconds of last step": f"{last:.4f}",
                     "memory above start [MB]": f"{peak / 1e6:.1f}",
                     "bytes per unknown": f"{peak / n:.0f}"})
    x = np.log([r["N"] for r in rows])
    exponents = [np.polyfit(x, np.log([float(r[c]) for r in rows]), 1)[0]
                 for c in ("seconds of last step", "memory above start [MB]")]
    rows.append({"N": "exponent", "seconds of last step": f"{exponents[0]:.2f}",
                 "memory above start [MB]": f"{exponents[1]:.2f}", "bytes per unknown": ""})
    return rows


def reached(table):
    """First step of each method below some errors: N and seconds."""
    rows = []
    for scene, title in PROBLEMS.items():
        for method in METHODS:
            row = {"problem": title, "method": method}
            error = select(table, scene, method, "error_relative")
            n = select(table, scene, method, "dofs_free")
            seconds = select(table, scene, method, "seconds")
            for tolerance in (1e-2, 1e-3, 1e-4, 1e-5, 1e-6):
                below = np.nonzero(error <= tolerance)[0]
                row[f"e <= {tolerance:.0e}"] = \
                    f"{n[below[0]]:.0f} in {seconds[below[0]]:.3f} s" if len(below) else "-"
            rows.append(row)
    return rows


def compared(table):
    """hpa3 beside hpa2: seconds and N at some errors, interpolated between steps."""
    def at(scene, method, column, tolerance):
        error = select(table, scene, method, "error_relative")
        k = np.nonzero(error <= tolerance)[0][0]
        return np.exp(np.interp(-np.log(tolerance), -np.log(error[k - 1:k + 1]),
                                np.log(select(table, scene, method, column)[k - 1:k + 1])))

    rows = []
    for scene, title in PROBLEMS.items():
        for column, name in (("seconds", "time"), ("dofs_free", "unknowns")):
            row = {"problem": title, "hpa3 / hpa2": name}
            for tolerance in (1e-3, 1e-4, 1e-5, 1e-6):
                ratio = at(scene, "hpa3", column, tolerance) / at(scene, "hpa2", column, tolerance)
                row[f"e = {tolerance:.0e}"] = f"{ratio:.2f}"
            rows.append(row)
    return rows


def effectivity_ranges(table):
    rows = []
    for method in METHODS:
        row = {"method": method}
        for scene, title in PROBLEMS.items():
            values = select(table, scene, method, "effectivity")
            row[title] = f"{np.nanmin(values):.1f} - {np.nanmax(values):.1f}"
        rows.append(row)
    return rows


def write_csv(name, rows):
    with open(GALLERY / name, "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def put_table(name, rows):
    """Replace the table between the marker comments of doc/accuracy.md, and write its CSV."""
    write_csv(f"{name}.csv", rows)
    head = list(rows[0])
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    lines += ["| " + " | ".join(str(r[c]) for c in head) + " |" for r in rows]
    page = HERE / "accuracy.md"
    text, count = re.subn(rf"(<!-- {name}: begin[^\n]*\n).*?(<!-- {name}: end)",
                          lambda m: m[1] + "\n".join(lines) + "\n" + m[2], page.read_text(),
                          flags=re.S)
    if count != 1:
        sys.exit(f"{page} has no place for the table {name}")
    page.write_text(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default="build/hpvi")
    parser.add_argument("--output", default="output/accuracy", type=pathlib.Path)
    arguments = parser.parse_args()
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    GALLERY.mkdir(exist_ok=True)
    program, home = str(pathlib.Path(arguments.program).resolve()), arguments.output.resolve()

    files, facts = references(program, home)
    put_table("references", facts)
    table = measure(program, home, files)
    write_csv("methods.csv", table)
    for scene in PROBLEMS:
        draw_chart(table, scene)
    draw_effectivity(table)
    table_with_bound = measure_bound(program, home, files)
    write_csv("bound.csv", table_with_bound)
    draw_bound(table_with_bound)
    put_table("with_bound", with_bound(table_with_bound))
    put_table("reached", reached(table))
    put_table("compared", compared(table))
    put_table("effectivity", effectivity_ranges(table))
    put_table("stages", draw_stages(program, home))
    put_table("smooth", draw_smooth(program, home))
    put_table("growth", growth(program, home))
    progress(f"charts and tables: {GALLERY}")


if __name__ == "__main__":
    main()
