#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rerun Chapter 5 of the thesis and draw its figures.

    /usr/bin/python3 doc/figures.py --program build/hpvi --output output/chapter5 [--draw]

runs both examples with all nine methods into the output directory, draws what the documentation shows to doc/figures by hpvi.plot,
and renews the tables inside doc/chapter5.md. --draw draws what an earlier call has left there, and runs nothing.
"""
import argparse
import json
import math
import pathlib
import sys
import time
from collections import namedtuple

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from gallery import call
from stability import COLOURS, N_LABEL, put_table

HERE = pathlib.Path(__file__).resolve().parent

# ------------------------------------------------------------------ what the thesis prints

# thesis.json: rates of decay of the indicator; condition: unknowns, cond(S), diagonally scaled; table: number of elements of degree 3, 4, 5, ... at steps 1, 2, ..., 15;
# zooms: figure number -> interval of x; y from 0 to 0.5; corners: where the clamp meets a free or loaded edge
Example = namedtuple("Example", "number scene rates beta condition table zooms error_figure mesh_figure multiplier_figure corners")
Example.__str__ = lambda example: f"Example {example.number}"
EXAMPLES = [Example(**one) for one in json.loads((HERE / "figures/thesis.json").read_text())]

# families share a line style
METHODS = {
    "hup2": dict(color="#56b4e9", marker="o", linestyle=":"),
    "hup3": dict(color="#0072b2", marker="s", linestyle=":"),
    "hup4": dict(color="#003a5c", marker="D", linestyle=":"),
    "hap2": dict(color="#f0c030", marker="^", linestyle="--"),
    "hap3": dict(color="#e69f00", marker="v", linestyle="--"),
    "hap4": dict(color="#8a5a00", marker=">", linestyle="--"),
    "pu": dict(color="#cc79a7", marker="P", linestyle="-."),
    "hpa1": dict(color="#009e73", marker="X", linestyle="-"),
    "hpa2": dict(color="#d55e00", marker="*", linestyle="-"),
}
READINGS = {"joint": "hpa2", "plain": "plain"}  # of the decay rate -> the run that has it

# ------------------------------------------------------------------ running the program


def limits(method):
    """Settings that let each method come to 20000 unknowns or to its end."""
    if method == "hpa2":
        # The thesis starts MPRGP from zero.
        return ["Adaptivity/Maximum steps=16", "Solver/Condition number=true", "Solver/QP solver=mprgp", "Solver/QP warm start=false"]
    if method == "pu":
        return ["Adaptivity/Maximum steps=11", "Adaptivity/Maximum degree=12"]
    return ["Adaptivity/Maximum steps=60", "Adaptivity/Maximum unknowns=20000"]


def run(program, example, method, directory, reading):
    vtu = method in ("hup4", "hpa2")  # drawn, or asked where its error sits
    settings = [f"Adaptivity/Method={method}", f"Output/VTU={str(vtu).lower()}", *limits(method), f"Adaptivity/Smoothness reading={reading}"]
    start = time.time()
    done = call(program, HERE.parent / f"prm/{example.scene}.prm", directory, *(word for setting in settings for word in ("--set", setting)))
    if done.returncode != 0:
        sys.exit(f"{example}, {directory.name} failed: {done.stderr.strip()}")
    print(f"  {directory.name:12s}{time.time() - start:7.1f} s", flush=True)


def all_runs(program, output, only_drawn, Run):
    """All of them by the number of their example and their name."""
    runs = {}
    for example in EXAMPLES:
        print(example, flush=True)
        runs[example.number] = {}
        for name in [*METHODS, "plain"]:
            directory = output / f"example-{example.number}" / name
            if not only_drawn:
                run(program, example, "hpa2" if name == "plain" else name, directory, "plain" if name == "plain" else "joint")
            runs[example.number][name] = Run(directory)
    return runs


def unknowns_and_indicator(one):
    return one.steps["dofs_free"], one.steps["estimate"]


def degrees(one):
    """Number of elements of degree 3, 4, ... at each step."""
    rows = np.stack([one.degrees[f"p{p}"] for p in range(3, 21) if f"p{p}" in one.degrees], axis=1)
    return [[int(n) for n in row[:np.flatnonzero(row)[-1] + 1]] for row in rows]


def transitions(one):
    """Halfway between neighbouring Gauss points of different state."""
    line, = one.lines
    return np.interp([begin for _, begin, _ in line.stretches()[1:]], line.s, line.x[:, 0])


# ------------------------------------------------------------------ tables


def put(name, rows):
    put_table(name, rows, page="chapter5", folder="figures")


def rate(n, eta):
    """Slope of eta ~ N^-rate by least squares."""
    return -np.polyfit(np.log(n), np.log(eta), 1)[0] if len(n) > 1 else math.nan


def corner_exponent(poisson):
    """Williams's exponent alpha of the displacement r^alpha in a right angle between a clamped and
    a free edge, in plane stress: 4 kappa sin^2(alpha pi/2) = (kappa + 1)^2 - 4 alpha^2."""
    kappa, alpha = (3 - poisson) / (1 + poisson), np.linspace(0.1, 1, 10 ** 6)
    return alpha[np.argmin(4 * kappa * np.sin(alpha * math.pi / 2) ** 2 < (kappa + 1) ** 2 - 4 * alpha ** 2)]


def rates_table(runs):
    table = []
    for example in EXAMPLES:
        for method, printed in example.rates.items():
            n, eta = unknowns_and_indicator(runs[example.number][method])
            table.append({"example": example.number, "method": method, "steps": len(n), "last N": n[-1], "thesis": printed}
                         | {words: f"{rate(n[used], eta[used]):.2f}" for words, used in
                            (("measured, N ≥ 300", n >= 300), ("last decade of N", n >= n[-1] / 10), ("last two steps", slice(-2, None)))})
    put("rates", table)


def betas_table(runs):
    table = []
    for example in EXAMPLES:
        for reading, name in READINGS.items():
            one = runs[example.number][name]
            for steps in (15, 16):
                n, eta = (values[:steps] for values in unknowns_and_indicator(one))
                table.append({"example": example.number, "reading": reading, "steps": steps, "last N": n[-1], "last η": f"{eta[-1]:.2e}",
                              "multipliers": one.steps["multipliers"][steps - 1], "β": f"{-np.polyfit(np.cbrt(n), np.log(eta), 1)[0]:.4f}", "thesis": example.beta})
    put("betas", table)


def conditions_table(runs):
    table = []
    for example in EXAMPLES:
        steps = runs[example.number]["hpa2"].steps
        n, raw, scaled = example.condition
        table.append({"example": example.number, "": "thesis", "N": n, "multipliers": "", "cond(S)": f"{raw:.1e}", "diagonally scaled": f"{scaled:.1e}"})
        for k in sorted({int(np.abs(np.log(steps["dofs_free"] / n)).argmin()), len(steps["step"]) - 1}):
            table.append({"example": example.number, "": f"step {k + 1}", "N": steps["dofs_free"][k], "multipliers": steps["multipliers"][k],
                          "cond(S)": f"{steps['condition_raw'][k]:.1e}", "diagonally scaled": f"{steps['condition_scaled'][k]:.1e}"})
    put("conditions", table)


def degree_tables(runs):
    """Tables 5.1 and 5.2."""
    for number, example in enumerate(EXAMPLES, 1):
        measured = {reading: degrees(runs[example.number][name]) for reading, name in READINGS.items()}
        table = []
        for k, printed in enumerate(example.table):
            row, slashed = {"step": k + 1, "elements: print": sum(printed)}, {"degrees 3/4/5/...: print": joined(printed)}
            for reading, counts in measured.items():
                count = counts[k] if k < len(counts) else []
                off = 100 * (sum(count) / sum(printed) - 1)
                row[reading] = f"{sum(count)}" + (f" ({off:+.1f} %)" if round(off, 1) else "")
                slashed[f"{reading} "] = joined(count) + (" =" if count == printed else "")
            table.append(row | slashed)
        put(f"table-5.{number}", table)


def joined(count):
    return "/".join(str(n) for n in count)


def corners_table(runs):
    """Where the error of hup4 sits: its mesh is fine enough to tell the places apart."""
    table = []
    for example in EXAMPLES:
        one = runs[example.number]["hup4"]
        alpha = corner_exponent(float(one.entries["Material/Poisson's ratio"]))
        corners = one.by_cell("points", 2)[..., :2].reshape(-1, 4, 2)
        low, high, squares = corners.min(axis=1), corners.max(axis=1), one.by_cells("estimate").astype(float) ** 2

        def share(places):
            """Percent of the error in the cells that touch one of them."""
            touched = np.any([((low <= np.array(place) + 1e-5) & (high >= np.array(place) - 1e-5)).all(axis=1) for place in places], axis=0)
            return f"{100 * squares[touched].sum() / squares.sum():.1f}"

        table.append({"example": example.number, "α": f"{alpha:.4f}", "α/2": f"{alpha / 2:.3f}", "% of η² at corners of clamp and free edge": share(example.corners),
                      "% at the ends of the contact edge": share([(0, 0), (high[:, 0].max(), 0)]), "% at transitions": share([(x, 0) for x in transitions(one)])})
    put("corners", table)


def transitions_table(runs):
    put("transitions", [{"example": example.number, "figure": figure, "zoom of the print [mm]": f"[{window[0]}, {window[1]}]", "transition x [mm]": f"{x:.5f}"}
                        for example in EXAMPLES
                        for x, (figure, window) in zip(transitions(runs[example.number]["hpa2"]), example.zooms.items())])


# ------------------------------------------------------------------ figures


def save(figure, name):
    """The same bytes for the same figure."""
    metadata = {"Date": None} if name.endswith(".svg") else {"Software": None}
    figure.savefig(HERE / "figures" / name, dpi=130, bbox_inches="tight", metadata=metadata)
    plt.close(figure)
    print("  " + name, flush=True)


def eta_label(one):
    return f"error indicator η [{one.stress_unit} · {one.length_unit}]"


def draw_errors(example, runs):
    figure, axes = plt.subplots(figsize=(7.6, 5.2))
    for method, style in METHODS.items():
        axes.loglog(*unknowns_and_indicator(runs[method]), label=method, markersize=9 if method == "hpa2" else 6,
                    linewidth=1.4, markeredgecolor="white", markeredgewidth=0.5, **style)
    axes.set(xlabel=N_LABEL, ylabel=eta_label(runs["hpa2"]), title=f"{example}: error indicator of all methods")
    axes.grid(linewidth=0.4)
    axes.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), handlelength=3.2)
    save(figure, f"figure-{example.error_figure}.svg")


def draw_exponential(runs):
    figure, axes = plt.subplots(figsize=(7.6, 4.4))
    for example, colour, marker in zip(EXAMPLES, COLOURS[1::-1], "*o"):
        n, eta = unknowns_and_indicator(runs[example.number]["hpa2"])
        x = np.cbrt(n)
        slope, height = np.polyfit(x, np.log(eta), 1)
        axes.semilogy(x, eta, marker, color=colour, markersize=8, markeredgecolor="white", markeredgewidth=0.5, label=f"{example}, hpa2")
        axes.semilogy(x, np.exp(height + slope * x), "-", color=colour, linewidth=1, label=f"exp(−β N$^{{1/3}}$), β = {-slope:.4f} (thesis {example.beta})")
    axes.set(xlabel="N$^{1/3}$ of the free displacement unknowns [-]", ylabel=eta_label(runs[example.number]["hpa2"]),
             title="hp-adaptive method hpa2: exponential convergence")
    axes.grid(linewidth=0.4)
    axes.legend(loc="upper right")
    save(figure, "exponential.svg")


def draw_conditions(runs):
    figure, axes = plt.subplots(figsize=(7.6, 4.6))
    for example, colour in zip(EXAMPLES, COLOURS[1::-1]):
        steps = runs[example.number]["hpa2"].steps
        n, *printed = example.condition
        for name, style, number in zip(("raw", "scaled"), ("o-", "s--"), printed):
            axes.loglog(steps["dofs_free"], steps[f"condition_{name}"], style, color=colour, markersize=5, label=f"{example}, {name}")
            axes.loglog(n, number, "*", color=colour, markersize=15, markeredgecolor="black", markeredgewidth=0.8)
    star = Line2D([], [], color="white", marker="*", markersize=13, linestyle="", markeredgecolor="black", label="printed in the thesis")
    axes.legend(handles=[*axes.get_legend_handles_labels()[0], star], loc="upper left")
    axes.set(xlabel=N_LABEL, ylabel="condition number of S [-]", title="hpa2: condition of the Schur complement")
    axes.grid(linewidth=0.4)
    save(figure, "conditions.svg")


def draw_mesh(example, one, plot):
    figure, axes = plt.subplots(figsize=(9.4, 4.2) if example.number == "5.3" else (6.6, 6), layout="constrained")
    plot.mesh(one, axes, is_moved=True)
    axes.set_title(f"{example}, hpa2, step {one.n_steps}: {axes.get_title()}")
    save(figure, f"figure-{example.mesh_figure}.png")


def draw_zoom(example, one, figure_number, window, plot):
    """The cells near a transition."""
    figure, axes = plt.subplots(figsize=(8.6, 4.8), layout="constrained")
    plot.mesh(one, axes, window=(window, (0, 0.5)))
    axes.set_title("")  # that of the whole mesh
    x, = [x for x in transitions(one) if window[0] < x < window[1]]
    axes.plot(x, -0.012 * (window[1] - window[0]), "^", color="#c4161c", markersize=7, clip_on=False, label=f"transition x = {x:.4f} {one.length_unit}")
    axes.legend(loc="lower right", bbox_to_anchor=(1, 1))
    axes.set_title(f"{example}, hpa2, step {one.n_steps}: degrees near the transition", loc="left")
    save(figure, f"figure-{figure_number}.png")


def draw_overview(example, one, plot):
    """The picture of the README: stress on the deformed body, and the mesh that found it."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 5.2), layout="constrained")
    plot.body(one, left)
    plot.mesh(one, right, is_moved=True)
    left.set_title(f"{example}: stress, {left.get_title()}")
    save(figure, "overview.png")


def draw_multiplier(example, one, plot):
    line, = one.lines
    g, x = float(one.entries["Boundary bottom/Friction bound"]), line.x[:, 0]
    figure, (top, bottom) = plt.subplots(2, 1, figsize=(7.6, 5.4), sharex=True, gridspec_kw={"hspace": 0.1, "height_ratios": [3, 2]})
    for axes in (top, bottom):
        for state, begin, end in line.stretches():
            if state == "slip":
                axes.axvspan(*np.interp((begin, end), line.s, x), color="#f2dccb", linewidth=0)
    for wall in (-1, 1):
        top.axhline(wall, color=plot.GREY, linestyle="--", linewidth=1)
    top.plot(x, line["multiplier"], ".-", color=plot.BLUE, linewidth=1, markersize=4)
    top.set(ylabel="multiplier λ [-]", ylim=(-1.15, 1.15), title=f"{example}, hpa2, step {one.n_steps}: {len(x)} multipliers, g = {g:g} {one.stress_unit}")
    right = top.twinx()
    right.spines["right"].set_visible(True)
    right.set(ylim=(1.15 * g, -1.15 * g), ylabel=f"T$_t$ = −g λ [{one.stress_unit}]")
    bottom.plot(x, line["tangential_displacement"], ".-", color=plot.ORANGE, linewidth=1, markersize=4)
    bottom.set(ylabel=f"u$_t$ [{one.length_unit}]", xlabel=f"x [{one.length_unit}]", xlim=(0, round(x.max())))
    figure.legend(handles=[Line2D([], [], color=plot.BLUE, marker=".", label="λ at Gauss points"), Line2D([], [], color=plot.ORANGE, marker=".", label="u$_t$"),
                           Line2D([], [], color=plot.GREY, linestyle="--", label="|λ| = 1"), Patch(facecolor="#f2dccb", label="slip")],
                  loc="lower center", bbox_to_anchor=(0.5, -0.06), ncol=4)
    save(figure, f"figure-{example.multiplier_figure}.svg")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--program", default="build/hpvi", type=pathlib.Path, help="the executable hpvi")
    parser.add_argument("--output", default="output/chapter5", type=pathlib.Path, help="directory of the runs")
    parser.add_argument("--draw", action="store_true", help="draw what an earlier call has left")
    options = parser.parse_args()
    sys.path.insert(0, str(options.program.resolve().parent / "python"))
    from hpvi import plot, results
    runs = all_runs(options.program, options.output, options.draw, results.Run)
    for table in (rates_table, betas_table, conditions_table, corners_table, transitions_table, degree_tables):
        table(runs)
    plt.rcParams.update(plot.STYLE)
    for example in EXAMPLES:
        these, one = runs[example.number], runs[example.number]["hpa2"]
        draw_errors(example, these)
        draw_mesh(example, one, plot)
        draw_multiplier(example, one, plot)
        for number, window in example.zooms.items():
            draw_zoom(example, one, number, window, plot)
    draw_overview(EXAMPLES[0], runs["5.2"]["hpa2"], plot)
    draw_exponential(runs)
    draw_conditions(runs)


if __name__ == "__main__":
    main()
