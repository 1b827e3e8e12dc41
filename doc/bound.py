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

import matplotlib.pyplot as plt
import numpy as np

from stability import (COLOURS, ERROR_LABEL, N_LABEL, Laboratory, chart, number, plain, progress,
                       put_table, read_csv, save, write_csv)

HERE = pathlib.Path(__file__).resolve().parent
GALLERY = HERE / "bound"
PAGE = "bound"
METHODS = {"hup2": 7, "hap4": 12, "hpa2": 16, "hpa3": 20}
PROBLEMS = {"stick-slip": ("Stick-slip", []), "plane-strain": ("The same in plane strain", []),
            "nearly-incompressible": ("The same, nu = 0.4999",
                                      ["Material/Poisson's ratio=0.4999"]),
            "incompressible": ("The same, nu = 0.499999", ["Material/Poisson's ratio=0.499999"]),
            "inside": ("Stick-slip, transition inside an edge", ["Exact solution/Transition=0.1"]),
            "smooth": ("Smooth slip", []), "han-6-12": ("Example 5.2", []),
            "han-6-13": ("Example 5.3", []), "hertz": ("Hertz contact", []),
            "opening": ("Example 5.2 that opens", []),
            "resting": ("Block with weight that opens", []),
            "varying": ("Example 5.2, g varies",
                        ["Boundary bottom/Friction bound=4.5*(1 + 0.3*sin(5*x))"]),
            "weight": ("Example 5.2 with weight", ["Body force/Expression=0.3; -2*y"]),
            "turned": ("Example 5.2, parallelogram",
                       ["Geometry/Shape=quadrilateral",
                        "Geometry/Corners=1, 0; 3, 1; 2.5, 2; 0.5, 1"])}
SCENES = {"nearly-incompressible": "plane-strain", "inside": "stick-slip", "incompressible": "plane-strain",
          "opening": "han-6-12-unilateral", "varying": "han-6-12", "weight": "han-6-12",
          "turned": "han-6-12"}
OVERKILL = ("han-6-12", "han-6-13", "opening", "resting", "varying", "weight", "turned")
TIMED = ("stick-slip", "han-6-12", "han-6-13", "hertz", "opening", "resting", "varying", "weight", "turned",
         "nearly-incompressible")
OTHER_METHODS = {"hup3": 6, "hup4": 5, "hap2": 12, "hap3": 12, "hpa1": 16, "pu": 9}
OTHER_PROBLEMS = ("stick-slip", "nearly-incompressible", "varying")
STIFF = ["Material/Plane=strain", "Material/Poisson's ratio=0.4999"]
STIFF_PROBLEMS = ("han-6-13", "opening", "varying", "weight", "turned")
QUANTITIES = {"Example 5.2, friction": ("han-6-12", [], "bottom", "friction"),
              "Example 5.2, force x on the right": ("han-6-12", [], "right", "Fx"),
              "Example 5.2, mean u_x of the left": ("han-6-12", ["Probe end/On=left"], None, "end_ux"),
              "Example 5.3, friction": ("han-6-13", [], "bottom", "friction"),
              "Example 5.3, force y on the top": ("han-6-13", [], "top", "Fy"),
              "Stick-slip, friction": ("stick-slip", [], "bottom", "friction"),
              "Hertz contact, normal force": ("hertz", [], "bottom", "normal"),
              "Example 5.2 that opens, friction": ("han-6-12-unilateral", [], "bottom", "friction"),
              "Block with weight, normal force": ("resting", [], "bottom", "normal")}
ANGLES = (90, 80, 60, 45, 30)
BOTTOM, RIGHT = "Boundary bottom/", "Boundary right/"
SLIDES = ["Contact=bilateral", "Friction bound=0.02"]
SKEW_SUPPORTS = {
    "bilateral, held": [BOTTOM + s for s in SLIDES] + [RIGHT + "Displacement=0; 0"],
    "unilateral, held": [BOTTOM + "Contact=unilateral", BOTTOM + SLIDES[1], RIGHT + "Displacement=0; 0"],
    "u_y = 0, held": [BOTTOM + "Displacement=free; 0", RIGHT + "Displacement=0; 0"],
    "u_x = 0, held": [BOTTOM + "Displacement=0; free", RIGHT + "Displacement=0; 0"],
    "u_y = 0, u_x = 0": [BOTTOM + "Displacement=free; 0", RIGHT + "Displacement=0; free"],
    "held, u_y = 0": [BOTTOM + "Displacement=0; 0", RIGHT + "Displacement=free; 0"],
    "u_y = 0, bilateral": [BOTTOM + "Displacement=free; 0", RIGHT + "Displacement="] +
                          [RIGHT + s for s in SLIDES]}
SKEW_LOADS = {"polynomial": "0; -0.1*(1 + x)", "cosine": "0.05*sin(4*x); -0.1*cos(3*x)",
              "partial": "0; if(x < 1.1, -0.1, 0)"}
ASPECTS = (1, 2, 4, 10, 20, 50, 100, 200)
# Bodies of long cells: title, upper corner, coarse mesh, a mesh of squares, and settings; A is the aspect.
FREE = ["Boundary left/Traction=", "Boundary right/Displacement=", "Boundary bottom/Contact=none",
        "Boundary bottom/Friction bound="]
LONG = {"beam": ("Cantilever", "{4*A}, 1", "4, 1", "{4*A}, 1",
                 ["Boundary left/Displacement=0; 0", "Boundary top/Traction=0; -1"]),
        "pressed": ("Block under pressure", "1, 1", "1, {A}", "4, 4",
                    ["Boundary bottom/Displacement=0; 0", "Boundary top/Traction=0; -1 - x"]),
        "sheared": ("Block under shear", "1, 1", "1, {A}", "4, 4",
                    ["Boundary bottom/Displacement=0; 0", "Boundary top/Traction=0.5; -1 - x"])}
# Bodies of curved cells, cells that do not match, and cells around an axis: title, a mesh in MESHES or a shape, and settings.
ELASTIC = ["Material/Young's modulus=10", "Material/Poisson's ratio=0.3"]
SECTOR = ["Geometry/Shape=ring sector", "Geometry/Radii=1, 2", "Boundary inner/Pressure=1",
          "Boundary start/Symmetry=true", "Boundary end/Symmetry=true"]
CURVED = {"lame": ("Lame's ring", None, [*SECTOR, "Geometry/Angles=0, 90", "Geometry/Subdivisions=1, 2"]),
          "sphere": ("Lame's sphere", None, [*SECTOR, "Geometry/Angles=-30, 30", "Geometry/Subdivisions=1, 2",
                                             "Material/Plane=axisymmetric"]),
          "clamped": ("Clamped ring", "ring", ["Boundary inner/Pressure=1", "Boundary start/Displacement=0; 0"]),
          "disc": ("Half disc, clamped", "disc", ["Boundary flat/Displacement=0; 0", "Boundary arc/Traction=0.1*y; -1"]),
          "hole": ("Plate with a hole", None, ["Geometry/Shape=plate with hole", "Geometry/Upper corner=2, 2",
                                               "Geometry/Radius=0.5", "Geometry/Part=quarter",
                                               "Geometry/Subdivisions=2, 2", "Boundary left/Symmetry=true",
                                               "Boundary bottom/Symmetry=true", "Boundary right/Traction=1; 0"])}
# Least energies in plane strain: u = A r + B/r; and between spheres u = A R + B/R^2, on a zone as high as its inner radius.
ENERGIES = {"lame": -0.13 * (0.4 / 3 + 4 / 3) * np.pi / 4, "sphere": -np.pi * (1 / 7 * 0.4 + 4 / 7 * 1.3) / 10}
TUBE = ["Geometry/Lower corner=1, 0", "Geometry/Upper corner=2, 1", "Geometry/Subdivisions=2, 2",
        "Material/Plane=axisymmetric"]
STRAIGHT = {"cylinder": ("Thick cylinder", "bare", [*TUBE, "Boundary bottom/Displacement=free; 0",
                                                    "Boundary left/Pressure=1 + y^2"]),
            "clamped-cylinder": ("Thick cylinder, clamped", "bare", [*TUBE, "Boundary bottom/Displacement=0; 0",
                                                                     "Boundary right/Shear=1"]),
            "solid-cylinder": ("Solid cylinder, clamped",
                               "bare", [*TUBE, "Geometry/Lower corner=0, 0", "Boundary bottom/Displacement=0; 0",
                                        "Boundary top/Traction=0; -1"])}
LAWS = {"tied": ["Contact joint/Law=tied", "Contact joint/Friction bound="],
        "sliding": ["Contact joint/Law=bilateral", "Contact joint/Friction bound="],
        "rubbing": ["Contact joint/Friction bound=0.0055"]}
RATIOS = {"1/100": "0.2", "1/10": "2", "1": "20", "10": "200", "100": "2000"}
FLOOR = 1e-9  # relative error below which round-off shows


def method_settings(method, steps, indicator):
    return [f"Adaptivity/Method={method}", "Adaptivity/Start degree=0",
            "Adaptivity/Smoothness reading=plain", "Adaptivity/Maximum degree=12",
            f"Adaptivity/Maximum steps={steps}", "Adaptivity/Maximum unknowns=40000",
            f"Adaptivity/Indicator={indicator}", "Output/VTU=false",
            "Output/Contact tables=false"]


def measure(lab, methods=METHODS, indicators=("residual", "bound")):
    """All runs by problem, method and indicator."""
    runs = {}
    for problem, (_, settings) in PROBLEMS.items():
        scene = SCENES.get(problem, problem)
        against = []
        if problem in OVERKILL:
            against = [lab.reference(scene, problem, *settings, unknowns=90000)[0]]
        for method, steps in methods.items():
            for indicator in ["residual"] if method == "hup2" else indicators:
                progress(f"  {problem}, {method}, marked by {indicator}")
                runs[problem, method, indicator] = lab.run(
                    scene, f"{problem}-{method}-{indicator}", *settings, *against,
                    *method_settings(method, steps, indicator))
    return runs


def over_error(run):
    """N, bound/error and indicator/error of those steps that round-off leaves alone."""
    error = run.column("error_energy")
    keep = (run.column("error_relative") > FLOOR) & (run.column("error_bound") > 0)
    return (run.column(c)[keep] / d for c, d in (("dofs_free", 1), ("error_bound", error[keep]),
                                                 ("estimate_scaled", error[keep])))


def effectivities(runs):
    """Smallest and largest quotient of bound and indicator with the true error."""
    rows = []
    for (problem, method, indicator), run in runs.items():
        _, bound, estimate = over_error(run)
        rows.append({"problem": PROBLEMS[problem][0], "method": method, "marked by": indicator,
                     "steps": len(bound), "least bound/error": plain(bound.min(), 3),
                     "largest bound/error": plain(bound.max(), 2),
                     "last bound/error": plain(bound[-1], 2),
                     "indicator/error": f"{plain(estimate.min(), 1)} to {plain(estimate.max(), 1)}"})
    put_table("effectivity", rows, page=PAGE)


def record_chart(runs):
    """What the chart shows: hpa3, marked by the bound."""
    write_csv(GALLERY / "chart.csv",
              [{"problem": PROBLEMS[problem][0], "dofs_free": int(n), "bound/error": number(bound, 5),
                "indicator/error": number(estimate, 5)}
               for problem in PROBLEMS
               for n, bound, estimate in zip(*over_error(runs[problem, "hpa3", "bound"]))])


def draw_effectivity():
    """From chart.csv, a panel for each problem; the last row has those that need another scale."""
    wide = [problem for problem in PROBLEMS if "incompressible" in problem]
    figure, panels = plt.subplots(4, 4, figsize=(12.5, 11), sharey="row", layout="constrained")
    figure.suptitle("Guaranteed bound and residual indicator over the true error, hpa3 marked by the bound")
    rows = read_csv(GALLERY / "chart.csv")
    for axes, problem in zip(panels.flat, [p for p in PROBLEMS if p not in wide] + wide):
        title = PROBLEMS[problem][0]
        values = np.array([[float(row[c]) for c in ("dofs_free", "indicator/error", "bound/error")]
                           for row in rows if row["problem"] == title]).T
        axes.axhline(1, color="black", linewidth=1)
        for k, (name, colour, marker) in enumerate((("indicator", COLOURS[1], "s"), ("bound", COLOURS[0], "o"))):
            axes.loglog(values[0], values[k + 1], marker + "-", color=colour, markersize=4, linewidth=1.3)
            ends = " to ".join(f"{end:.2f}" if end < 10 else f"{end:.0f}"
                               for end in (values[k + 1].min(), values[k + 1].max()))
            axes.text(0.97, 0.96 - 0.1 * k, f"{name} {ends}", transform=axes.transAxes, ha="right", va="top",
                      fontsize=9, color=colour)
        axes.set(title=title.replace("The same", "Stick-slip"), xlabel=N_LABEL, xlim=(50, 8e4))
        ticks, top = ([1, 10, 100, 1000], 2e5) if problem in wide else ([1, 1.5, 2, 3, 5], 14)
        axes.set_ylim(0.9, top)
        axes.set_yticks(ticks, [f"{tick:g}" for tick in ticks])
        axes.set_yticks([], minor=True)
        axes.grid(alpha=0.3)
    for axes in panels.flat[len(PROBLEMS):]:
        axes.set_axis_off()
    for axes in panels[:, 0]:
        axes.set_ylabel("over the true error [-]")
    save(figure, "effectivity.png", PAGE)


def marking(runs):
    """Unknowns and true errors of runs that differ in what marks."""
    figure, panels = chart(3, "hpa3 marked by the residual and by the bound", width=14)
    shown = ("stick-slip", "incompressible", "han-6-12")
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
    """Unknowns by interpolation at errors that both runs pass, as ratios."""
    errors = [run.column("error_relative") for run in pair]
    low = max(max(e.min() for e in errors), FLOOR)
    high = min(e[0] for e in errors)
    targets = np.geomspace(high, low, 7)[1:]

    def at(run):
        error = np.minimum.accumulate(run.column("error_relative"))
        return np.exp(np.interp(-np.log(targets), -np.log(error),
                                np.log(run.column("dofs_free"))))

    unknowns = at(pair[1]) / at(pair[0])
    return {"problem": title, "method": method, "to the error": number(low, 1),
            "unknowns, bound/residual": plain(statistics.median(unknowns), 2),
            "at the end": plain(unknowns[-1], 2)}


def intervals(runs):
    """energy_low and energy_high close on the least energy."""
    figure, panels = chart(2, "Both ends of the interval that holds the least energy J(u)",
                           width=10)
    for axes, problem in zip(panels, ("han-6-12", "han-6-13")):
        run = runs[problem, "hpa3", "bound"]
        N, high, low = (run.column(c) for c in ("dofs_free", "energy_high", "energy_low"))
        lower, upper = low.max(), high.min()
        centre = (lower + upper) / 2
        ends = (high - centre) / abs(centre), (low - centre) / abs(centre)
        axes.fill_between(N, *ends, color=COLOURS[6], alpha=0.3, linewidth=0)
        for values, marker, label in zip(ends, "v^", ("energy_high", "energy_low")):
            axes.plot(N, values, marker + "-", color=COLOURS[0 if marker == "v" else 1],
                      markersize=4, label=label)
        axes.set_xscale("log")
        axes.set_yscale("symlog", linthresh=1e-7, linscale=1)
        axes.set_yticks([sign * 10.0 ** k for sign in (-1, 1) for k in range(-7, -1)] + [0])
        axes.set(title=f"{PROBLEMS[problem][0]}: J(u) = {centre:.6f} ± {(upper - lower) / 2:.0e}",
                 xlabel=N_LABEL, ylabel="(end - J(u)) / |J(u)| [-], linear within 1e-7")
        axes.legend(fontsize=8)
    save(figure, "interval.png", PAGE)


def shares(runs):
    """Near incompressibility: what the bound is made of where it is farthest from the error."""
    rows = []
    for problem in ("plane-strain", "nearly-incompressible", "incompressible"):
        for method, indicator in (("hup2", "residual"), ("hap4", "bound"), ("hpa3", "bound")):
            run = runs[problem, method, indicator]
            ratio = run.column("error_bound") / run.column("error_energy")
            k = int(np.nanargmax(ratio))
            row = {"problem": PROBLEMS[problem][0], "method": method, "N": run.rows[k]["dofs_free"],
                   "relative error": number(run.column("error_relative")[k], 1),
                   "largest bound/error": plain(ratio[k], 1)}
            for part in ("stress", "slip", "data"):
                row[f"{part}/error"] = plain(
                    run.column(f"bound_{part}")[k] / run.column("error_energy")[k], 2)
            rows.append(row)
    put_table("shares", rows, page=PAGE)


def seconds(lab, problems, methods):
    """By problem and method: a run, and its rows of the table of costs, or none below 5000 unknowns."""
    samples = {}
    for repeat in range(4):  # all cases in turn, so that a busy moment meets each of them
        progress(f"  cost, round {repeat + 1}")
        for problem in problems:
            for method, steps in methods.items():
                run = lab.run(SCENES.get(problem, problem), f"cost-{problem}-{method}",
                              *PROBLEMS[problem][1], *method_settings(method, steps, "bound"))
                stages = [c for c in run.rows[0] if c.startswith("seconds_")]
                samples.setdefault((problem, method), []).append(
                    (run, {c: run.column(c) for c in stages}))
    result = {}
    for key, rounds in samples.items():
        # What other processes take away shows in some rounds: the least time of each stage counts.
        least = {c: np.min([stages[c] for _, stages in rounds], axis=0) for c in rounds[0][1]}
        run, own = rounds[0][0], least.pop("seconds_bound")
        rest, large = sum(least.values()), run.column("dofs_free") >= 5000
        result[key] = run, {
            "from 5000 unknowns on": plain(own[large].sum() / rest[large].sum(), 2),
            "whole run": plain(own.sum() / rest.sum(), 2),
            "seconds without it": plain(rest.sum(), 3),
            "of it": plain(own.sum(), 3)} if large.any() else None
    return result


def cost(lab):
    """Seconds of the bound beside those of all other stages, in the same run."""
    put_table("cost", [{"problem": PROBLEMS[problem][0], "method": method, **row}
                       for (problem, method), (_, row) in seconds(lab, TIMED, METHODS).items()
                       if row], page=PAGE)


def bound_over_error(run):
    """In those steps that round-off leaves alone."""
    ratio = run.column("error_bound") / run.column("error_energy")
    return ratio[(run.column("error_relative") > FLOOR) & (ratio > 0)]


def stiff(lab):
    """Effectivity near incompressibility with all contacts and loads, marked by the bound."""
    rows = []
    for problem in STIFF_PROBLEMS:
        scene, settings = SCENES.get(problem, problem), PROBLEMS[problem][1] + STIFF
        reference = lab.reference(scene, f"{problem}-stiff", *settings, unknowns=90000)[0]
        for method, steps in METHODS.items():
            progress(f"  {problem} with nu = 0.4999, {method}")
            ratio = bound_over_error(lab.run(scene, f"{problem}-stiff-{method}", *settings,
                                             reference, *method_settings(method, steps, "bound")))
            rows.append({"problem": PROBLEMS[problem][0], "method": method, "steps": ratio.size,
                         "least bound/error": plain(ratio.min(), 3),
                         "largest bound/error": plain(ratio.max(), 2),
                         "last bound/error": plain(ratio[-1], 2)})
    put_table("stiff", rows, page=PAGE)


def skew(lab):
    """Effectivity on parallelograms of 2 x 1 with a load on top, 4 x 2 cells, p = 2 to 5."""
    rows = []
    for angle in ANGLES:
        c, s = (plain(f(np.radians(angle)), 12) for f in (np.cos, np.sin))
        shape = ["Geometry/Shape=quadrilateral", "Geometry/Subdivisions=4, 2", "Boundary left/Traction=",
                 f"Geometry/Corners=0, 0; 2, 0; {2 + float(c)}, {s}; {c}, {s}",
                 "Boundary bottom/Contact=none", "Boundary bottom/Friction bound="]
        for support, settings in SKEW_SUPPORTS.items():
            row = {"angle": angle, "bottom, right": support}
            for load, traction in SKEW_LOADS.items():
                progress(f"  {angle} degrees, {support}, {load}")
                entries = [*shape, f"Boundary top/Traction={traction}", *settings]
                name = f"skew-{angle}-{support}-{load}".replace(" ", "")
                reference = lab.reference("han-6-12", name, *entries, unknowns=4000)[0]
                run = lab.run("han-6-12", name, *entries, reference, "Adaptivity/Method=pu",
                              "Adaptivity/Start degree=2", "Adaptivity/Maximum steps=4")
                ratios = run.column("error_bound") / run.column("error_energy")
                # nan where a step has no bound
                row[f"bound/error, {load}"] = f"{plain(np.min(ratios), 2)} to {plain(np.max(ratios), 2)}"
            rows.append(row)
    put_table("skew", rows, page=PAGE)


def others(lab):
    """Effectivity and cost with the methods that the charts leave out."""
    rows = []
    for (problem, method), (run, row) in seconds(lab, OTHER_PROBLEMS, OTHER_METHODS).items():
        ratio = bound_over_error(run)
        rows.append({"problem": PROBLEMS[problem][0], "method": method,
                     "steps": len(run.rows),
                     "least bound/error": plain(ratio.min(), 2) if ratio.size else "",
                     "largest bound/error": plain(ratio.max(), 2) if ratio.size else "",
                     "cost from 5000 unknowns on": row["from 5000 unknowns on"] if row else ""})
    put_table("others", rows, page=PAGE)


def long_cells(lab):
    """Bound over error by how long cells are, and by degree: the larger of two steps that bisect all cells."""
    rows = []
    figure, panels = chart(3, "Guaranteed bound over the true error by the aspect of cells", width=13, sharey=True)
    for axes, (body, (title, corner, mesh, squares, loads)) in zip(panels, LONG.items()):
        for A in ASPECTS:
            progress(f"  {title}, cells of {A}:1")
            rows.append({"body": title, "aspect": A,
                         **aspect_row(lab, body, *(text.replace("{4*A}", str(4 * A)).replace("{A}", str(A))
                                                   for text in (corner, mesh, squares)), FREE + loads)})
        own = [row for row in rows if row["body"] == title]
        for k, p in enumerate((2, 4, 6, 8)):
            axes.semilogx(ASPECTS, [float(row[f"p = {p}"]) for row in own], "os^v"[k] + "-",
                          color=COLOURS[k], markersize=5, label=f"p = {p}")
        axes.set(title=title, xlabel="length over width of cells [-]")
    panels[0].set_ylabel("bound / true error [-]")
    panels[0].legend(fontsize=8)
    save(figure, "aspect.png", PAGE)
    put_table("aspect", rows, page=PAGE)


def aspect_row(lab, body, corner, mesh, squares, settings):
    """By degree. The least energy of a mesh of squares tells the error, by Galerkin's orthogonality."""
    settings = [*settings, f"Geometry/Upper corner={corner}"]
    finest = lab.run("han-6-12", f"squares-{body}", *settings, f"Geometry/Subdivisions={squares}",
                     *method_settings("hpa3", 14, "bound"), "Adaptivity/Start degree=4")
    result = {}
    for p in range(2, 9):
        run = lab.run("han-6-12", f"long-{body}", *settings, f"Geometry/Subdivisions={mesh}",
                      *method_settings("hup2", 2, "bound"), f"Adaptivity/Start degree={p}")
        error = np.sqrt(2 * (run.column("energy") - finest.column("energy").min()))
        result[f"p = {p}"] = plain((run.column("error_bound") / error).max(), 2)
    return result


def on_circle(r, degrees):
    return r * np.cos(np.radians(degrees)), r * np.sin(np.radians(degrees))


def quarter_of_ring():
    """Of radii 1 and 2 in 2 x 4 cells, and its named edges with the points on circles in their middles."""
    t = np.linspace(0, 90, 5)
    cells = [[on_circle(r, t[j]), on_circle(r + 0.5, t[j]), on_circle(r + 0.5, t[j + 1]), on_circle(r, t[j + 1])]
             for r in (1, 1.5) for j in range(4)]
    named = {name: [(on_circle(r, t[j]), on_circle(r, t[j + 1]), on_circle(r, (t[j] + t[j + 1]) / 2))
                    for j in range(4)] for name, r in (("inner", 1), ("outer", 2))}
    for name, at in (("start", 0), ("end", 90)):
        named[name] = [(on_circle(r, at), on_circle(r + 0.5, at), on_circle(r + 0.25, at)) for r in (1, 1.5)]
    return cells, named


def half_disc():
    """The upper half of the unit disc, two cells in its middle."""
    inner = [(0.5, 0), (0.5, 0.5), (0, 0.5), (-0.5, 0.5), (-0.5, 0)]
    t = range(0, 181, 45)
    cells = [[inner[j], on_circle(1, t[j]), on_circle(1, t[j + 1]), inner[j + 1]] for j in range(4)]
    cells += [[(x, 0), (x + 0.5, 0), (x + 0.5, 0.5), (x, 0.5)] for x in (0, -0.5)]
    return cells, {"arc": [(on_circle(1, a), on_circle(1, b), on_circle(1, (a + b) / 2)) for a, b in zip(t, t[1:])],
                   "flat": [((x, 0), (x + 0.5, 0), (x + 0.25, 0)) for x in (-1, -0.5, 0, 0.5)]}


MESHES = {"ring": quarter_of_ring, "disc": half_disc}


def write_mesh(path, cells, named):
    """Of second order, so that all degrees have one body: Gmsh's format."""
    nodes = {}

    def node(x):
        return nodes.setdefault((round(x[0], 12) + 0., round(x[1], 12) + 0.), len(nodes) + 1)

    middles = {frozenset((node(a), node(b))): m for edges in named.values() for a, b, m in edges}
    elements = [f"8 2 {k} {k} {node(a)} {node(b)} {node(m)}"
                for k, edges in enumerate(named.values(), 1) for a, b, m in edges]
    for cell in cells:
        corners = [node(x) for x in cell]
        sides = [(cell[i], cell[(i + 1) % 4]) for i in range(4)]
        mids = [middles.get(frozenset((node(a), node(b))), tuple((np.array(a) + b) / 2)) for a, b in sides]
        elements.append(" ".join(map(str, [16, 2, len(named) + 1, 1, *corners, *map(node, mids)])))
    names = [f'1 {k} "{name}"' for k, name in enumerate(named, 1)] + [f'2 {len(named) + 1} "body"']
    sections = {"MeshFormat": ["2.2 0 8"], "PhysicalNames": [len(names), *names],
                "Nodes": [len(nodes), *(f"{k} {x!r} {y!r} 0" for (x, y), k in nodes.items())],
                "Elements": [len(elements), *(f"{k} {line}" for k, line in enumerate(elements, 1))]}
    path.write_text("".join(f"${name}\n" + "".join(f"{line}\n" for line in lines) + f"$End{name}\n"
                            for name, lines in sections.items()))


def body_row(title, method, error, bound):
    """In steps whose error is known to more than a hundredth of its square."""
    ratio = bound / error
    keep = np.isfinite(ratio)
    return {"body": title, "method": method, "steps": keep.sum(), "least bound/error": plain(ratio[keep].min(), 3),
            "largest bound/error": plain(ratio[keep].max(), 2), "last bound/error": plain(ratio[keep][-1], 2)}


def bodies(lab):
    """Bound over error on curved bodies, by the least energy of a finer run, and on the others by a finer solution."""
    rows = []
    bare = lab.home / "bare"
    bare.with_suffix(".prm").write_text("set Dimension = 2\n")
    methods = {"pu": 11, "hap3": 6, "hpa3": 10}
    for body, (title, mesh, settings) in CURVED.items():
        progress(f"  {title}")
        settings = [*ELASTIC, *settings]
        if mesh:
            write_mesh(lab.home / f"{mesh}.msh", *MESHES[mesh]())
            settings += ["Geometry/Shape=file", f"Geometry/File={lab.home / mesh}.msh"]
        if body in ENERGIES:
            J, doubt = ENERGIES[body], 0
        else:
            energies = lab.run(bare, f"finest-{body}", *settings, *method_settings("hpa3", 24, "residual"),
                               "Adaptivity/Start degree=4", "Error/Bound=false").column("energy")
            J, doubt = energies.min(), abs(energies[-2] - energies[-1])
        doubt += 1e-13 * abs(J)
        for method, steps in methods.items():
            run = lab.run(bare, f"{body}-{method}", *settings, *method_settings(method, steps, "bound"),
                          "Adaptivity/Start degree=2", "Error/Bound=true")
            square = 2 * (run.column("energy") - J)
            rows.append(body_row(title, method,
                                 np.sqrt(np.where(square > 200 * doubt, square, np.nan)), run.column("error_bound")))
    joints = {f"joint-{law}-{E}": (f"Blocks, {law}, E {ratio}", "blocks",
                                   [*entries, f"Material/Young's modulus={E}"])
              for law, entries in LAWS.items() for ratio, E in RATIOS.items()}
    for body, (title, scene, settings) in {**STRAIGHT, **joints}.items():
        settings = [*(ELASTIC if scene == "bare" else []), *settings]
        scene = bare if scene == "bare" else scene
        progress(f"  {title}")
        reference = lab.reference(scene, body, *settings, "Adaptivity/Start degree=2", "Error/Bound=false",
                                  unknowns=30000)[0]
        for method, steps in {**methods, "pu": 7}.items():
            run = lab.run(scene, f"{body}-{method}", *settings, *method_settings(method, steps, "bound"),
                          "Adaptivity/Start degree=2", "Error/Bound=true", reference)
            rows.append(body_row(title, method, run.column("error_energy"),
                                 run.column("error_bound")))
    put_table("bodies", rows, page=PAGE)


def forces(lab):
    """Half-widths of forces and mean displacements beside the errors of their centres, which a longer run tells."""
    rows, shown, runs = [], [], {}
    for quantity, (scene, settings, name, column) in QUANTITIES.items():
        key = (scene, *settings)
        if key not in runs:
            progress(f"  intervals of {scene}")
            runs[key] = lab.run(scene, f"forces-{scene}", *method_settings("hpa3", 26, "bound"),
                                "Adaptivity/Tolerance=0", "Adaptivity/Maximum unknowns=60000", *settings)
        run = runs[key]
        steps = {int(row["step"]): row for row in read_csv(run.home / "convergence.csv")}
        if name:
            values = [(int(row["step"]), float(row[column]), float(row[column + "_bound"]))
                      for row in read_csv(run.home / "forces.csv") if row["name"] == name and row[column + "_bound"]]
        else:
            values = [(step, float(row[column]), float(row[column + "_bound"])) for step, row in steps.items()
                      if row[column + "_bound"]]
        truth, doubt = values[-1][1:]
        shown += [{"quantity": quantity, "N": steps[step]["dofs_free"], "half-width": number(half),
                   "error": number(abs(centre - truth)) if abs(centre - truth) > doubt else ""}
                  for step, centre, half in values[:-2]]
        for wanted in (1500, 15000):
            step, centre, half = min(values[:-2], key=lambda v: abs(np.log(float(steps[v[0]]["dofs_free"]) / wanted)))
            row = steps[step]
            stages = sum(float(value) for stage, value in row.items() if stage.startswith("seconds_") and value)
            error = abs(centre - truth)
            rows.append({"quantity": quantity, "N": row["dofs_free"], "half-width": number(half),
                         "error of the centre": number(error) if error > doubt else f"< {number(doubt)}",
                         "half-width over the bound of the error": plain(half / float(row["error_bound"]), 2),
                         "digits": plain(-np.log10(half / abs(centre)), 2),
                         "seconds_recover over the step": plain(float(row["seconds_recover"]) / stages, 2)})
    put_table("forces", rows, page=PAGE)
    write_csv(GALLERY / "widths.csv", shown)
    draw_widths()


def draw_widths():
    """From widths.csv, a panel for each quantity: the interval's half-width above the error of its centre."""
    figure, panels = plt.subplots(3, 3, figsize=(12, 10), sharex=True, layout="constrained")
    figure.suptitle("Half-widths of guaranteed intervals and the errors of their centres, hpa3 marked by the bound")
    rows = read_csv(GALLERY / "widths.csv")
    for axes, quantity in zip(panels.flat, QUANTITIES):
        own = [row for row in rows if row["quantity"] == quantity]
        known = [row for row in own if row["error"]]
        axes.loglog([float(row["N"]) for row in own], [float(row["half-width"]) for row in own], "o-",
                    color=COLOURS[0], markersize=4, label="half-width")
        axes.loglog([float(row["N"]) for row in known], [float(row["error"]) for row in known], "s-",
                    color=COLOURS[1], markersize=4, label="error of the centre")
        quotients = [float(row["half-width"]) / float(row["error"]) for row in known if float(row["error"]) > 0]
        if quotients:
            axes.text(0.97, 0.96, f"quotient {min(quotients):.0f} to {max(quotients):.0f}", transform=axes.transAxes,
                      ha="right", va="top", fontsize=9)
        axes.set(title=quantity)
        low, high = axes.get_ylim()
        if high < 100 * low:  # statics: round-off
            axes.set_ylim(low / 10, 10 * high)
        axes.grid(alpha=0.3)
    for axes in panels[-1]:
        axes.set_xlabel(N_LABEL)
    for axes in panels[:, 0]:
        axes.set_ylabel("in units of the scene")
    panels[-1, -1].legend(*panels[0, 0].get_legend_handles_labels(), loc="upper right", fontsize=9)
    save(figure, "widths.png", PAGE)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default="build/hpvi")
    parser.add_argument("--output", default="output/bound", type=pathlib.Path)
    parser.add_argument("--only", choices=["cost", "chart", "skew", "aspect", "bodies", "forces"],
                        help="measure nothing else than the time, than what the charts of effectivities and intervals show, "
                             "than skew parallelograms, than long cells, than curved bodies, joints and bodies of revolution, "
                             "or than intervals of forces")
    parser.add_argument("--draw", action="store_true", help="run nothing: draw two charts from doc/bound/chart.csv and widths.csv")
    arguments = parser.parse_args()
    if arguments.draw:
        draw_effectivity()
        draw_widths()
        return
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    GALLERY.mkdir(exist_ok=True)
    lab = Laboratory(str(pathlib.Path(arguments.program).resolve()), arguments.output.resolve())
    lab.home.mkdir(parents=True, exist_ok=True)
    if arguments.only == "aspect":
        long_cells(lab)
        return
    if arguments.only == "bodies":
        bodies(lab)
        return
    if arguments.only == "forces":
        forces(lab)
        return
    if arguments.only == "chart":
        runs = measure(lab, {"hpa3": METHODS["hpa3"]}, ["bound"])
        record_chart(runs)
        draw_effectivity()
        intervals(runs)
        return
    if not arguments.only:
        runs = measure(lab)
        effectivities(runs)
        record_chart(runs)
        draw_effectivity()
        marking(runs)
        intervals(runs)
        shares(runs)
        stiff(lab)
        long_cells(lab)
        bodies(lab)
        forces(lab)
    if arguments.only != "cost":
        skew(lab)
    if arguments.only != "skew":
        cost(lab)
        others(lab)
    progress(f"charts and tables: {GALLERY}")


if __name__ == "__main__":
    main()
