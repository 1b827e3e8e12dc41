#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Coulomb friction: its solvers over the coefficient, exponential convergence, what it costs.

Runs three problems with coefficients from 0.1 to 5 by Newton's method and by the fixed point, two
problems in closed form against overkill solutions, and Coulomb's law beside Tresca's; writes tables and
charts to doc/coulomb/ and into doc/coulomb.md, between its marker comments.
"""
import argparse
import os
import pathlib
import statistics

import matplotlib.pyplot as plt
import numpy as np

from contact import solved
from stability import (COLOURS, ERROR_LABEL, Laboratory, chart, number, plain, progress, put_table, read_csv,
                       save, write_csv)

HERE = pathlib.Path(__file__).resolve().parent
GALLERY = HERE / "coulomb"
PAGE = "coulomb"
COEFFICIENTS = (0.1, 0.3, 0.6, 1, 2, 5)
STEPS = 12
BLOCK = ["Boundary top/Traction=", "Adaptivity/Method=hpa3"]
# Blocks are pressed by a hundredth of their height or less and sheared until they slip in part.
PROBLEMS = {
    "SSNV128": ("ssnv128", lambda mu: []),
    "flat block": ("brake-pad",
                   lambda mu: [*BLOCK, f"Boundary top/Displacement={-0.2 * mu}; -0.05"]),
    "tall block": ("brake-pad",
                   lambda mu: [*BLOCK, "Geometry/Lower corner=-5, 0", "Geometry/Upper corner=5, 20",
                               "Geometry/Subdivisions=2, 4",
                               f"Boundary top/Displacement={-0.3 * mu}; -0.05"])}
SOLVERS = {"Newton": ["Solver/Coulomb solver=newton"],
           "Newton, each step from stick": ["Solver/Coulomb solver=newton",
                                            "Solver/QP warm start=false"],
           "fixed point": ["Solver/Coulomb solver=fixed point"]}
LOOK = {"Newton": (COLOURS[0], "o"), "Newton, each step from stick": (COLOURS[2], "D"),
        "fixed point": (COLOURS[1], "s")}


# ---------------------------------------------------------------- solvers


def measure_solvers(lab):
    """A row for each problem, coefficient and solver; a run that fails is a result."""
    rows = []
    for problem, (scene, settings) in PROBLEMS.items():
        for mu in COEFFICIENTS:
            progress(f"  {problem}, coefficient {mu}")
            for solver, choice in SOLVERS.items():
                run = lab.run(scene, f"{scene}-{solver}".replace(" ", "-").replace(",", ""),
                              *settings(mu), *choice, f"Adaptivity/Maximum steps={STEPS}",
                              f"Boundary bottom/Friction coefficient={mu}")
                column = "coulomb_fixed_point" if solver == "fixed point" else "coulomb_newton"
                steps = run.column(column)
                contraction = np.nan_to_num(run.column("coulomb_contraction"))
                fallbacks = sum(r["coulomb_method"] not in ("newton", "fixed point")
                                for r in run.rows)
                rows.append({"problem": problem, "mu_f": mu, "solver": solver,
                             "solved": f"{len(run.rows)} of {STEPS}",
                             "N": run.last.get("dofs_free", "-"),
                             "multipliers": run.last.get("multipliers", "-"),
                             "iterations, median": plain(np.median(steps), 1) if len(steps) else "-",
                             "most": int(max(steps)) if len(steps) else "-",
                             "fallbacks": fallbacks,
                             "contraction": plain(max(contraction))
                             if solver == "fixed point" and any(contraction) else "-",
                             "dense factorisations": int(np.sum(run.column("qp_dense_solves"))),
                             "milliseconds": round(1e3 * float(np.sum(run.column("seconds_qp"))), 1),
                             "ended": "" if run.status == "0" else run.message})
    write_csv(GALLERY / "solvers.csv", rows)
    put_table("overview", [overview(rows, problem, mu) for problem in PROBLEMS
                           for mu in COEFFICIENTS], page=PAGE)
    return rows


def overview(rows, problem, mu):
    """One line for all solvers: median and most iterations, and what went wrong."""
    line = {"problem": problem, "mu_f": mu}
    for row in rows:
        if (row["problem"], row["mu_f"]) != (problem, mu):
            continue
        text = f"{row['iterations, median']} ({row['most']})"
        if row["fallbacks"]:
            text += f", fallbacks: {row['fallbacks']}"
        if not row["solved"].startswith(f"{STEPS} "):
            text = f"{row['solved']} steps"
        line[row["solver"]] = text
        if row["solver"] == "fixed point":
            line["contraction"] = row["contraction"]
    return line


def of(rows, problem, solver, column):
    return [r[column] for r in rows if (r["problem"], r["solver"]) == (problem, solver)]


def is_solved(row):
    return row["solved"].startswith(f"{STEPS} ")


def draw_solvers(rows):
    """Runs that end early stand in a band of their own: the few steps that they did say nothing of the rest."""
    figure, panels = chart(3, "Iterations of a step: median (markers) and most (dotted) of the runs that were solved",
                           13, 4.6, sharey=True)
    low, high = 250, 900  # the band
    for axes, problem in zip(panels, PROBLEMS):
        axes.axhspan(low, high, color="#e8e8e8", linewidth=0)
        for solver, (colour, marker) in LOOK.items():
            of_solver = [r for r in rows if (r["problem"], r["solver"]) == (problem, solver)]
            solved_runs = [r for r in of_solver if is_solved(r)]
            mu = [float(r["mu_f"]) for r in solved_runs]
            axes.loglog(mu, [float(r["iterations, median"]) for r in solved_runs], color=colour,
                        marker=marker, label=solver, linewidth=1.3)
            axes.loglog(mu, [float(r["most"]) for r in solved_runs], color=colour, linestyle=":",
                        linewidth=1.3)
            for row in of_solver:
                if not is_solved(row):
                    axes.plot(float(row["mu_f"]), 600, "x", color=colour, markersize=9,
                              markeredgewidth=2)
                    axes.annotate(row["solved"], (float(row["mu_f"]), 340), ha="center",
                                  va="center", fontsize=8, color=colour)
        axes.text(0.09, (low * high) ** 0.5, "not solved:\nsteps done", fontsize=8, va="center")
        axes.set(title=problem, xlabel="coefficient of friction $\\mu_f$ [-]", ylim=(0.8, high),
                 xlim=(0.08, 8))
        axes.set_xticks(COEFFICIENTS, [f"{mu:g}" for mu in COEFFICIENTS])
        axes.set_xticks([], minor=True)
    panels[0].set_yticks([1, 10, 100], ["1", "10", "100"])
    panels[0].set_ylabel("factorisations (Newton),\nproblems of Tresca (fixed point) [-]")
    panels[0].legend(loc="upper left", bbox_to_anchor=(0, 0.8), fontsize=9)
    save(figure, "solvers.png", PAGE)


def draw_contraction(rows):
    figure, panels = chart(3, "The fixed point beside Newton's method", 15)
    for k, problem in enumerate(PROBLEMS):
        contraction = np.array([np.nan if v == "-" else float(v)
                                for v in of(rows, problem, "fixed point", "contraction")])
        factors = {s: np.array(of(rows, problem, s, "dense factorisations"), float)
                   for s in ("fixed point", "Newton")}
        # A run that ended early took fewer than it asked for.
        whole = np.array([all(s.startswith(f"{STEPS} ") for s in pair)
                          for pair in zip(*(of(rows, problem, s, "solved") for s in factors))])
        ratio = np.where(whole, factors["fixed point"] / np.maximum(factors["Newton"], 1), np.nan)
        times = {s: np.array(of(rows, problem, s, "milliseconds"), float) for s in factors}
        slower = np.where(whole, times["fixed point"] / times["Newton"], np.nan)
        look = {"color": COLOURS[k], "marker": "osD"[k], "label": problem}
        panels[0].loglog(COEFFICIENTS, contraction, **look)
        panels[0].loglog(np.array(COEFFICIENTS)[~whole], contraction[~whole], linestyle="",
                         **{**look, "label": None}, markerfacecolor="white", markersize=9)
        panels[1].loglog(COEFFICIENTS, ratio, **look)
        panels[2].loglog(COEFFICIENTS, slower, **look)
    for axes in panels:
        axes.axhline(1, color="k", linewidth=0.8)
        axes.set_xlabel("coefficient of friction $\\mu_f$ [-]")
        axes.set_xticks(COEFFICIENTS, [f"{mu:g}" for mu in COEFFICIENTS])
        axes.set_xticks([], minor=True)
        axes.set_xlim(0.085, 6)
        axes.legend()
    panels[0].set_title("hollow: runs that were not solved", fontsize=9)
    for axes in panels[1:]:
        axes.set_title("runs that both solved", fontsize=9)
    panels[0].set_ylabel("contraction number, the largest seen [-]")
    panels[1].set_ylabel("dense factorisations, fixed point / Newton [-]")
    panels[2].set_ylabel("time of the solver, fixed point / Newton [-]")
    save(figure, "contraction.png", PAGE)


# ---------------------------------------------------------------- exponential convergence


def hertz_under_slip():
    """Hertz's pressure with friction -f p everywhere: displacements as expressions."""
    young, nu, a, k, f, shift = 200, 0.3, 0.7, 10, 0.3, 0.03
    mu, kappa, radius = young / (2 * (1 + nu)), 3 - 4 * nu, young / (2 * (1 - nu ** 2) * k)
    q = f"(x^2-y^2-{a}^2)"
    s = f"sqrt({q}^2+4*x^2*y^2)"
    # The roots of s - q and s + q, neither of which may cancel.
    m = f"if({q}>0, abs(x)*y/sqrt(({s}+{q})/2), sqrt(({s}-{q})/2))"
    n = f"if({q}>0, if(x<0,-1,1)*sqrt(({s}+{q})/2), if(y>0, x*y/sqrt(({s}-{q})/2), 0))"
    h = f"sqrt((x+{n})^2+(y+{m})^2)"
    th = f"asin((x+{n})/{h})"
    big_a = f"((x^2-y^2-x*{n}+y*{m})/2+{a}^2/2*log({h}/{a}))"
    big_b = f"(x*y-(x*{m}+y*{n})/2-{a}^2*{th}/2)"
    u_x = (f"({k}*(({kappa}-1)/2*{big_b}+y*(x-{n}))"
           f"+{f * k}*(({kappa}+1)/2*{big_a}-y*(y-{m})))/{2 * mu}+{shift}")
    u_y = (f"(-{k}*(({kappa}+1)/2*{big_a}+y*(y-{m}))"
           f"+{f * k}*(({kappa}-1)/2*{big_b}-y*(x-{n})))/{2 * mu}")
    inside = f"(x*sqrt(max(0,{a}^2-x^2))/2+{a}^2/2*asin(max(-1,min(1,x/{a}))))"
    gap = f"x^2/{2 * radius}+{f * (kappa - 1) * k / (4 * mu)}*{inside}"
    return ["Geometry/Lower corner=-2, 0", "Geometry/Upper corner=2, 2", "Geometry/Subdivisions=4, 2",
            f"Material/Young's modulus={young}", f"Material/Poisson's ratio={nu}",
            "Material/Plane=strain", f"Boundary bottom/Gap={gap}",
            f"Boundary bottom/Friction coefficient={f}", *sides(u_x, u_y)]


def pressed_stick_slip():
    """Stick meets slip at 0 under a uniform pressure q."""
    nu, g, q = 0.3, 0.3, 1
    mu, kappa = 1 / (2 * (1 + nu)), (3 - nu) / (1 + nu)
    stiffness = nu / (1 - nu ** 2) + 2 * mu  # of plane stress
    amplitude = g / (1.5 * (1 + kappa))
    r, theta = "sqrt(x^2+y^2)^1.5", "atan2(-y,-x)"
    u_x = (f"{amplitude / (2 * mu)}*{r}*({2 * kappa + 1.5}*cos(1.5*{theta})-1.5*cos(0.5*{theta}))"
           f"+{g / mu}*y")
    u_y = (f"{amplitude / (2 * mu)}*{r}*(-1.5)*(sin(1.5*{theta})+sin(0.5*{theta}))"
           f"-{q / stiffness}*y")
    coefficient = f"{g}/({q}-{1.5 * (kappa - 1) * amplitude}*sqrt(max(0,-x)))"
    return ["Geometry/Lower corner=-1, 0", "Geometry/Upper corner=1, 1", "Geometry/Subdivisions=4, 2",
            "Material/Young's modulus=1", f"Material/Poisson's ratio={nu}", "Material/Plane=stress",
            f"Boundary bottom/Friction coefficient={coefficient}", *sides(u_x, u_y)]


def sides(u_x, u_y):
    return [*(f"Boundary {side}/Displacement={u_x}; {u_y}" for side in ("left", "right", "top")),
            "Boundary top/Traction="]


CLOSED = {"Hertz under full slip": hertz_under_slip(), "stick-slip under pressure":
          pressed_stick_slip()}
PATHS = {"hpa3": (COLOURS[0], "o", 90), "hap3": (COLOURS[1], "s", 14), "hup3": (COLOURS[2], "D", 6)}


def converge(lab):
    """Both problems in closed form against an overkill solution, and a fit of exp(-b N^(1/3))."""
    table, fits = [], []
    figure, panels = chart(2, "Coulomb friction in closed form: straight lines are exponential", 12)
    for axes, (problem, settings) in zip(panels, CLOSED.items()):
        name = problem.replace(" ", "-")
        progress(f"  {problem}: reference solution")
        overkill = solved(lab.run("brake-pad", f"reference-{name}", *settings,
                                  "Adaptivity/Maximum degree=14", "Adaptivity/Maximum steps=60",
                                  "Adaptivity/Maximum unknowns=40000",
                                  "Output/Reference solution=true"))
        for method, (colour, marker, steps) in PATHS.items():
            run = solved(lab.run("brake-pad", f"{name}-{method}", *settings,
                                 f"Adaptivity/Method={method}", "Adaptivity/Start degree=0",
                                 f"Adaptivity/Maximum steps={steps}",
                                 "Adaptivity/Maximum unknowns=12000",
                                 f"Error/Reference solution={overkill.home / 'reference.dat'}"))
            n, error = run.column("dofs_free"), run.column("error_relative")
            table += [{"problem": problem, "method": method, "N": int(row["dofs_free"]),
                       "error": row["error_relative"], "effectivity": row["effectivity"]}
                      for row in run.rows]
            axes.semilogy(n ** (1 / 3), error, color=colour, marker=marker, markersize=5,
                          label=method)
            if method == "hpa3":
                b, c = np.polyfit(n ** (1 / 3), np.log(error), 1)
                r, d = np.polyfit(np.log(n), np.log(error), 1)
                off = [np.exp(np.std(np.log(error) - b * n ** (1 / 3) - c)),
                       np.exp(np.std(np.log(error) - r * np.log(n) - d))]
                fits.append({"problem": problem, "steps": len(n), "last N": int(n[-1]),
                             "last error": number(error[-1], 2), "b in exp(-b N^(1/3))": plain(-b),
                             "exponential: error off by a factor": plain(off[0]),
                             "algebraic: error off by a factor": plain(off[1]),
                             "effectivity": f"{np.min(run.column('effectivity')):.1f} to "
                                            f"{np.max(run.column('effectivity')):.1f}"})
        axes.set_title(problem)
        axes.set_xlabel("$N^{1/3}$, free displacement unknowns [-]")
        axes.legend()
    panels[0].set_ylabel(ERROR_LABEL)
    save(figure, "convergence.png", PAGE)
    write_csv(GALLERY / "convergence.csv", table)
    put_table("fits", fits, page=PAGE)


# ---------------------------------------------------------------- cost


def cost(lab):
    """A Coulomb step over a Tresca step on the same meshes: medians of several runs."""
    meshes = ["Adaptivity/Method=hup3", "Adaptivity/Start degree=3", "Adaptivity/Maximum steps=4",
              "Solver/Normal contact=multiplier"]
    laws = {"Tresca": ["Boundary bottom/Friction coefficient=", "Boundary bottom/Friction bound=40"],
            "Coulomb": []}
    seconds = {law: [] for law in laws}
    for repeat in range(7):
        progress(f"  Coulomb beside Tresca, run {repeat + 1}")
        for law, settings in laws.items():
            run = solved(lab.run("ssnv128", f"cost-{law}", *meshes, *settings))
            seconds[law].append([np.diff(run.column("seconds"), prepend=0),
                                 run.column("seconds_qp")])
    rows = []
    for k in range(4):
        row = {"step": k + 1, "N": run.rows[k]["dofs_free"], "multipliers": run.rows[k]["multipliers"]}
        for part, name in enumerate(("step", "multipliers")):
            ratio = (statistics.median(s[part][k] for s in seconds["Coulomb"]) /
                     statistics.median(s[part][k] for s in seconds["Tresca"]))
            row[f"Coulomb / Tresca, time of the {name}"] = plain(ratio)
        rows.append(row)
    put_table("cost", rows, page=PAGE)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default="build/hpvi")
    parser.add_argument("--output", default="output/coulomb", type=pathlib.Path)
    parser.add_argument("--draw", action="store_true",
                        help="run nothing: draw the solvers' charts from doc/coulomb/solvers.csv")
    arguments = parser.parse_args()
    if arguments.draw:
        rows = read_csv(GALLERY / "solvers.csv")
        draw_solvers(rows)
        draw_contraction(rows)
        return
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    GALLERY.mkdir(exist_ok=True)
    lab = Laboratory(str(pathlib.Path(arguments.program).resolve()), arguments.output.resolve())
    lab.home.mkdir(parents=True, exist_ok=True)
    cost(lab)
    converge(lab)
    rows = measure_solvers(lab)
    draw_solvers(rows)
    draw_contraction(rows)
    progress(f"charts and tables: {GALLERY}")


if __name__ == "__main__":
    main()
