#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The guaranteed bound of the error beside the true error: effectivity, marking, energies, cost.

Runs the stick-slip problem, near incompressibility and the smooth one (exact solutions), and Examples
5.2 and 5.3 (overkill reference solutions), and writes tables and charts to doc/bound/ and into
doc/bound.md, between its marker comments.
"""
import argparse
import os
import pathlib
import statistics

import numpy as np

from stability import (COLOURS, ERROR_LABEL, N_LABEL, Laboratory, chart, number, plain, progress,
                       put_table, save)

HERE = pathlib.Path(__file__).resolve().parent
GALLERY = HERE / "bound"
PAGE = "bound"
METHODS = {"hup2": 7, "hap4": 12, "hpa2": 16, "hpa3": 20}
PROBLEMS = {"stick-slip": ("Stick-slip", []), "plane-strain": ("The same in plane strain", []),
            "nearly-incompressible": ("The same, nu = 0.4999",
                                      ["Material/Poisson's ratio=0.4999"]),
            "smooth": ("Smooth slip", []), "han-6-12": ("Example 5.2", []),
            "han-6-13": ("Example 5.3", [])}
SCENES = {"nearly-incompressible": "plane-strain"}
FLOOR = 1e-9  # relative error below which round-off shows


def method_settings(method, steps, indicator):
    return [f"Adaptivity/Method={method}", "Adaptivity/Start degree=0",
            "Adaptivity/Smoothness reading=plain", "Adaptivity/Maximum degree=12",
            f"Adaptivity/Maximum steps={steps}", "Adaptivity/Maximum unknowns=40000",
            f"Adaptivity/Indicator={indicator}", "Output/VTU=false", "Output/Mesh picture=false",
            "Output/Contact tables=false"]


def measure(lab):
    """All runs by problem, method and indicator."""
    runs = {}
    for problem, (_, settings) in PROBLEMS.items():
        scene = SCENES.get(problem, problem)
        against = []
        if problem.startswith("han"):
            against = [lab.reference(scene, scene, unknowns=90000)[0]]
        for method, steps in METHODS.items():
            for indicator in ["residual"] if method == "hup2" else ["residual", "bound"]:
                progress(f"  {problem}, {method}, marked by {indicator}")
                runs[problem, method, indicator] = lab.run(
                    scene, f"{problem}-{method}-{indicator}", *settings, *against,
                    *method_settings(method, steps, indicator))
    return runs


def effectivities(runs):
    """Smallest and largest quotient of bound and indicator with the true error."""
    rows = []
    figure, panels = chart(2, "Bound and indicator over the true error", width=11)
    for (problem, method, indicator), run in runs.items():
        error = run.column("error_energy")
        keep = run.column("error_relative") > FLOOR
        bound, estimate = run.column("error_bound")[keep] / error[keep], \
            run.column("estimate_scaled")[keep] / error[keep]
        rows.append({"problem": PROBLEMS[problem][0], "method": method, "marked by": indicator,
                     "steps": int(keep.sum()), "least bound/error": plain(bound.min(), 3),
                     "largest bound/error": plain(bound.max(), 2),
                     "last bound/error": plain(bound[-1], 2),
                     "indicator/error": f"{plain(estimate.min(), 1)} to {plain(estimate.max(), 1)}"})
        if method == "hpa3" and indicator == "bound":
            for axes, values in zip(panels, (bound, estimate)):
                axes.semilogx(run.column("dofs_free")[keep], values, "o-", markersize=4,
                              label=PROBLEMS[problem][0])
    for axes, what in zip(panels, ("guaranteed bound / true error",
                                   "residual indicator / true error")):
        axes.set(xlabel=N_LABEL, ylabel=what, yscale="log")
        axes.axhline(1, color="black", linewidth=1)
        axes.legend(fontsize=8)
    save(figure, "effectivity.png", PAGE)
    put_table("effectivity", rows, page=PAGE)


def marking(runs):
    """Unknowns and true errors of runs that differ in what marks."""
    figure, panels = chart(3, "hpa3 marked by the residual and by the bound", width=14)
    shown = ("stick-slip", "nearly-incompressible", "han-6-12")
    rows = []
    for problem, (title, _) in PROBLEMS.items():
        for method in ("hap4", "hpa2", "hpa3"):
            pair = [runs[problem, method, indicator] for indicator in ("residual", "bound")]
            rows.append(compare(title, method, pair))
            if method == "hpa3" and problem in shown:
                axes = panels[shown.index(problem)]
                for run, indicator, colour in zip(pair, ("residual", "bound"), COLOURS):
                    axes.loglog(run.column("dofs_free"), run.column("error_energy"), "o-",
                                color=colour, markersize=4, label=f"marked by the {indicator}")
                axes.set(title=title, xlabel=N_LABEL, ylabel=ERROR_LABEL)
                axes.legend(fontsize=8)
    save(figure, "marking.png", PAGE)
    put_table("marking", rows, page=PAGE)


def compare(title, method, pair):
    """Unknowns and seconds by interpolation at errors that both runs pass, as ratios."""
    errors = [run.column("error_relative") for run in pair]
    low = max(max(e.min() for e in errors), FLOOR)
    high = min(e[0] for e in errors)
    targets = np.geomspace(high, low, 7)[1:]

    def at(run, column):
        error = np.minimum.accumulate(run.column("error_relative"))
        return np.exp(np.interp(-np.log(targets), -np.log(error), np.log(run.column(column))))

    unknowns = at(pair[1], "dofs_free") / at(pair[0], "dofs_free")
    seconds = at(pair[1], "seconds") / at(pair[0], "seconds")
    return {"problem": title, "method": method, "to the error": number(low, 1),
            "unknowns, bound/residual": plain(statistics.median(unknowns), 2),
            "at the end": plain(unknowns[-1], 2),
            "seconds": plain(statistics.median(seconds), 2)}


def intervals(runs):
    """J(u_N) and what is below it at most."""
    figure, panels = chart(2, "The least energy lies between J(u_N) and J(u_N) minus its bound",
                           width=11)
    for axes, problem in zip(panels, ("han-6-12", "han-6-13")):
        run = runs[problem, "hpa3", "bound"]
        N, J, width = (run.column(c) for c in ("dofs_free", "energy", "energy_bound"))
        best = (J - width).max(), J.min()
        centre = sum(best) / 2
        scale = abs(centre)
        axes.loglog(N, (J - best[0]) / scale, "v-", color=COLOURS[0], markersize=4,
                    label="J(u_N), above the least energy")
        axes.loglog(N, (best[1] - (J - width)) / scale, "^-", color=COLOURS[1], markersize=4,
                    label="lower end, below it")
        axes.set(title=f"{PROBLEMS[problem][0]}: J = {centre:.8f} ± {(best[1] - best[0]) / 2:.0e}",
                 xlabel=N_LABEL, ylabel="distance from the other end / |J|")
        axes.legend(fontsize=8)
    save(figure, "interval.png", PAGE)


def cost(lab):
    """Seconds of the bound beside those of all other stages, in the same run."""
    rows = []
    for problem in ("stick-slip", "han-6-12"):
        for method, steps in METHODS.items():
            samples = []
            for repeat in range(3):
                run = lab.run(problem, f"cost-{problem}-{method}-{repeat}",
                              *method_settings(method, steps, "bound"))
                own = run.column("seconds_bound")
                total = sum(run.column(c) for c in run.rows[0] if c.startswith("seconds_"))
                large = run.column("dofs_free") >= 5000
                samples.append((own[large].sum() / (total - own)[large].sum(),
                                own.sum() / (total - own).sum()))
            rows.append({"problem": PROBLEMS[problem][0], "method": method,
                         "from 5000 unknowns on": plain(statistics.median(s[0] for s in samples), 2),
                         "whole run": plain(statistics.median(s[1] for s in samples), 2)})
    put_table("cost", rows, page=PAGE)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default="build/hpvi")
    parser.add_argument("--output", default="output/bound", type=pathlib.Path)
    arguments = parser.parse_args()
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    GALLERY.mkdir(exist_ok=True)
    lab = Laboratory(str(pathlib.Path(arguments.program).resolve()), arguments.output.resolve())
    lab.home.mkdir(parents=True, exist_ok=True)
    runs = measure(lab)
    effectivities(runs)
    marking(runs)
    intervals(runs)
    cost(lab)
    progress(f"charts and tables: {GALLERY}")


if __name__ == "__main__":
    main()
