#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Contact that opens and closes: both discretisations of u_n <= u_0 side by side, and pictures.

Runs Hertz's contact (exact solution), Example 5.2 unilateral and the flat punch (overkill reference
solutions) with nodes and with a multiplier, and writes tables and charts to doc/contact/ and into
doc/contact.md, between its marker comments.
"""
import argparse
import os
import pathlib
import sys

import matplotlib.pyplot as plt
import numpy as np

from stability import (COLOURS, ERROR_LABEL, N_LABEL, Laboratory, chart, number, plain, progress,
                       put_table, save, write_csv)

HERE = pathlib.Path(__file__).resolve().parent
GALLERY = HERE / "contact"
PAGE = "contact"
PROBLEMS = {"hertz": "Hertz, exact", "han-6-12-unilateral": "Example 5.2 unilateral",
            "punch": "Flat punch"}
KINDS = {"nodes": ("#0072b2", "o"), "multiplier": ("#d55e00", "s")}
METHODS = {"hpa3": "-", "hpa2": ":"}
HPA = ["Adaptivity/Smoothness reading=plain", "Adaptivity/Start degree=0",
       "Adaptivity/Maximum degree=14", "Adaptivity/Maximum steps=60"]
REPEATS = 3
A, P0 = 0.7, 7.  # half-width and largest pressure of prm/hertz.prm


# ---------------------------------------------------------------- runs


def settings(method, kind, unknowns):
    return [*HPA, f"Adaptivity/Method={method}", f"Solver/Normal contact={kind}",
            f"Adaptivity/Maximum unknowns={unknowns}"]


def solved(run):
    if run.status != "0":
        sys.exit(f"{run.home}: {run.message}")
    return run


def references(lab):
    """Overkill solutions by three paths; the setting that measures against the first of them."""
    against, facts = {"hertz": []}, []
    paths = {"multiplier, hpa3": settings("hpa3", "multiplier", 90000),
             "nodes, hpa3": settings("hpa3", "nodes", 90000),
             "nodes, hpa2": settings("hpa2", "nodes", 70000)}
    for scene in list(PROBLEMS)[1:]:
        for path, path_settings in paths.items():
            progress(f"  reference solution of {scene}: {path}")
            run = solved(lab.run(scene, f"reference-{scene}-{path}".replace(", ", "-"),
                                 *path_settings, "Output/Reference solution=true",
                                 *against.get(scene, [])))
            first = scene not in against
            if first:
                against[scene] = [f"Error/Reference solution={run.home / 'reference.dat'}"]
            facts.append({"problem": PROBLEMS[scene], "path": path, "N": run.last["dofs_free"],
                          "J": f"{run.value('energy'):.12f}",
                          "relative indicator": number(run.value("estimate_relative"), 2),
                          "relative distance to the first":
                              "-" if first else number(run.value("error_relative"), 2)})
    put_table("references", facts, page=PAGE)
    return against


def seconds_of_steps(runs):
    """Seconds up to each step: the least time of each over several runs, summed."""
    return np.cumsum(np.min([np.diff(r.column("seconds"), prepend=0) for r in runs], axis=0))


def measure(lab, against):
    """Both discretisations by each method: errors from one run, times the median of several."""
    table = []
    for scene in PROBLEMS:
        for kind in KINDS:
            for method in METHODS:
                progress(f"  {PROBLEMS[scene]}: {kind}, {method}")
                one = settings(method, kind, 40000)
                timed = [solved(lab.run(scene, f"{scene}-{kind}-{method}", *one))
                         for _ in range(REPEATS)]
                run = solved(lab.run(scene, f"{scene}-{kind}-{method}", *one, *against[scene]))
                pressure = run.column("error_pressure") / (P0 * np.sqrt(4 * A / 3))
                resultant = np.abs(run.column("normal_resultant") / (-np.pi / 2 * A * P0) - 1)
                for k, (row, seconds) in enumerate(zip(run.rows, seconds_of_steps(timed))):
                    exact = scene == "hertz"
                    table.append({"problem": scene, "normal contact": kind, "method": method,
                                  "step": row["step"], "dofs_free": row["dofs_free"],
                                  "contact unknowns": row["multipliers"],
                                  "seconds": f"{seconds:.5f}",
                                  "error_relative": row["error_relative"],
                                  "effectivity": row["effectivity"],
                                  "energy_difference": row["energy_difference"],
                                  "pressure_l2": number(pressure[k], 5) if exact else "-",
                                  "resultant": number(resultant[k], 5) if exact else "-",
                                  "half_width": row["error_transition"] if exact else "-",
                                  "qp_dense_solves": row["qp_dense_solves"],
                                  "qp_fell_back": row["qp_fell_back"]})
    write_csv(GALLERY / "methods.csv", table)
    return table


def select(table, scene, kind, method, column):
    return np.array([float(r[column]) if r[column] not in ("", "-") else np.nan for r in table
                     if (r["problem"], r["normal contact"], r["method"]) == (scene, kind, method)])


# ---------------------------------------------------------------- who wins


def fits(table):
    """Least squares of log(error) = c - b N^(1/3), and of c - r log(N), by hpa3."""
    rows = []
    for scene, title in PROBLEMS.items():
        for kind in KINDS:
            n = select(table, scene, kind, "hpa3", "dofs_free")
            error = select(table, scene, kind, "hpa3", "error_relative")
            good = error > 3e-8  # above the references and round-off
            row = {"problem": title, "normal contact": kind, "steps": int(good.sum())}
            for name, x in (("exponential", n[good] ** (1 / 3)), ("algebraic", np.log(n[good]))):
                b, c = np.polyfit(x, np.log(error[good]), 1)
                spread = np.exp(np.std(np.log(error[good]) - b * x - c))
                row["b in exp(-b N^(1/3))" if name == "exponential" else "r in N^-r"] = plain(-b)
                row[f"{name}: error off by a factor"] = plain(spread)
            half = len(n[good]) // 2
            row["r, last half"] = plain(-np.polyfit(np.log(n[good][half:]),
                                                    np.log(error[good][half:]), 1)[0])
            rows.append(row)
    put_table("fits", rows, page=PAGE)


def at(x, error, tolerance):
    """Where the least error so far passes a tolerance, interpolated by logarithms."""
    error = np.minimum.accumulate(error)
    return np.exp(np.interp(-np.log(tolerance), -np.log(error), np.log(x),
                            left=np.nan, right=np.nan))


def compared(table):
    """Nodes over multiplier: what they need for the same error."""
    tolerances = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7)
    rows = []
    for scene, title in PROBLEMS.items():
        for column, name in (("dofs_free", "unknowns"), ("seconds", "time")):
            for method in METHODS:
                row = {"problem": title, "method": method, "nodes / multiplier": name}
                ratios = []
                for tolerance in tolerances:
                    values = [at(select(table, scene, kind, method, column),
                                 select(table, scene, kind, method, "error_relative"), tolerance)
                              for kind in KINDS]
                    ratios.append(values[0] / values[1])
                    row[f"e = {tolerance:.0e}"] = plain(ratios[-1])
                row["mean"] = plain(np.exp(np.nanmean(np.log(ratios))))
                rows.append(row)
    put_table("compared", rows, page=PAGE)


def factors(table):
    """Error of the multiplier over error of nodes for the same number of unknowns."""
    sizes = (300, 1000, 3000, 10000, 30000)
    cases = [(scene, method, "error_relative", "energy norm")
             for scene in PROBLEMS for method in METHODS]
    cases += [("hertz", method, "pressure_l2", "pressure, L2") for method in METHODS]
    rows = []
    for scene, method, column, name in cases:
        errors = []
        for kind in KINDS:
            n = select(table, scene, kind, method, "dofs_free")
            errors.append(np.interp(np.cbrt(sizes), np.cbrt(n),
                                    np.log(select(table, scene, kind, method, column)),
                                    left=np.nan, right=np.nan))
        ratios = np.exp(errors[1] - errors[0])
        rows.append({"problem": PROBLEMS[scene], "method": method, "error": name,
                     **{f"N = {n}": plain(r) for n, r in zip(sizes, ratios)},
                     "mean": plain(np.exp(np.nanmean(np.log(ratios))))})
    put_table("factors", rows, page=PAGE)


def pressures(lab, table):
    """What is read off Hertz's contact for about the same number of unknowns."""
    rows = []
    for target in (1000, 3000, 10000, 30000):
        for kind in KINDS:
            n = select(table, "hertz", kind, "hpa3", "dofs_free")
            k = int(np.argmin(np.abs(np.log(n / target))))
            run = solved(lab.run("hertz", "pressures", *settings("hpa3", kind, 1000000),
                                 f"Adaptivity/Maximum steps={k + 1}"))
            contact = run.summary["contact"]["bottom"]
            touching = sum(z["length"] for z in contact["zones"] if z["state"] != "open")
            value = {c: select(table, "hertz", kind, "hpa3", c)[k]
                     for c in ("error_relative", "pressure_l2", "resultant")}
            rows.append({"normal contact": kind, "N": int(n[k]),
                         "energy norm": number(value["error_relative"], 2),
                         "pressure, L2": number(value["pressure_l2"], 2),
                         "largest pressure":
                             number(abs(contact["largest_pressure"] / P0 - 1), 2),
                         "resultant": number(value["resultant"], 2),
                         "width": number(abs(touching / (2 * A) - 1), 2),
                         "largest penetration / a":
                             number(contact["largest_penetration"] / A, 2)})
    put_table("pressures", rows, page=PAGE)


# ---------------------------------------------------------------- charts


def draw_chart(table, scene):
    figure, panels = plt.subplots(1, 2, figsize=(11, 4.6), sharey=True, layout="constrained")
    for kind, (colour, marker) in KINDS.items():
        for method, line in METHODS.items():
            look = {"color": colour, "marker": marker, "linestyle": line, "markersize": 5,
                    "linewidth": 1.3, "label": f"{kind}, {method}"}
            error = select(table, scene, kind, method, "error_relative")
            n = select(table, scene, kind, method, "dofs_free")
            panels[0].semilogy(n ** (1 / 3), error, **look)
            panels[1].loglog(select(table, scene, kind, method, "seconds"), error, **look)
    panels[0].set_xlabel("$N^{1/3}$, free displacement unknowns [-]")
    panels[1].set_xlabel("time, one thread [s]")
    panels[0].set_ylabel(ERROR_LABEL)
    for axes in panels:
        axes.grid(alpha=0.3)
    figure.suptitle(f"{PROBLEMS[scene]}: true error; straight lines on the left are exponential")
    panels[0].legend()
    save(figure, f"chart-{scene}.png", PAGE)


def draw_pressure_errors(table):
    figure, panels = chart(3, "Hertz, hpa3: errors of what is read off the contact", 13)
    for axes, column, label in zip(
            panels, ("pressure_l2", "resultant", "half_width"),
            ("pressure, relative error in $L_2$ [-]", "resultant, relative error [-]",
             "ends of the contact, largest distance [mm]")):
        for kind, (colour, marker) in KINDS.items():
            axes.loglog(select(table, "hertz", kind, "hpa3", "dofs_free"),
                        select(table, "hertz", kind, "hpa3", column), color=colour, marker=marker,
                        markersize=5, linewidth=1.3, label=kind)
        axes.set_xlabel(N_LABEL)
        axes.set_ylabel(label)
    panels[0].legend()
    save(figure, "hertz-pressure.png", PAGE)


def draw_gap(lab):
    """Example 5.2 that may leave the plane, beside the one that is held down."""
    cases = {"bilateral, $u_n = 0$": ("han-6-12", COLOURS[1], "--"),
             "unilateral, $u_n \\leq 0$": ("han-6-12-unilateral", COLOURS[0], "-")}
    figure, panels = chart(3, "Example 5.2: held down, and free to leave the plane", 14)
    facts = []
    for case, (scene, colour, line) in cases.items():
        run = solved(lab.run(scene, f"gap-{scene}", "Output/Contact tables=true"))
        contact, look = run.contact(), {"color": colour, "linestyle": line, "label": case}
        x = contact["x"]
        panels[0].plot(x, -1e3 * contact["normal_displacement"], **look)
        panels[1].plot(x, contact["normal_traction"], **look)
        panels[2].plot(x, contact["tangential_traction"], **look)
        touching = contact["normal_traction"] < 0
        facts.append({"contact": scene, "J": f"{run.value('energy'):.6f}",
                      "friction resultant": plain(run.value("friction_resultant"), 4),
                      "largest gap": number(np.max(-contact["normal_displacement"])),
                      "touches from": number(x[touching][0]) if scene.endswith("al") else "-"})
    write_csv(GALLERY / "gap.csv", facts)
    for axes, label in zip(panels, ("gap $-u_n$ [$10^{-3}$ mm]", "$T_n$ [kN/mm$^2$]",
                                    "$T_t$ [kN/mm$^2$]")):
        axes.set_xlabel("x along the bottom [mm]")
        axes.set_ylabel(label)
    panels[1].set_ylim(-3, 5)
    panels[0].legend()
    save(figure, "gap.png", PAGE)
    return facts


def draw_scenes(lab):
    figure, panels = chart(3, "Pressures that have no closed form", 14)
    for kind, (colour, _) in KINDS.items():
        contacts = {scene: solved(lab.run(scene, f"pressure-{scene}-{kind}",
                                          f"Solver/Normal contact={kind}",
                                          "Output/Contact tables=true")).contact()
                    for scene in ("punch", "receding", "resting")}
        look = {"color": colour, "linestyle": "-" if kind == "nodes" else "--", "label": kind}
        x = contacts["punch"]["x"]
        panels[0].loglog(1 - x[x < 1], -contacts["punch"]["normal_traction"][x < 1], **look)
        for axes, scene in zip(panels[1:], ("receding", "resting")):
            axes.plot(contacts[scene]["x"], -contacts[scene]["normal_traction"], **look)
    r = np.array([1e-6, 1])
    panels[0].loglog(r, 0.6 * 2.2 * r ** -0.5, "k:", label="~ (1 - x)$^{-1/2}$")
    for axes, title, label in zip(panels, ("Flat punch", "Receding contact", "Resting block"),
                                  ("distance 1 - x from the edge of the punch [mm]", "x [mm]",
                                   "x [m]")):
        axes.set_title(title)
        axes.set_xlabel(label)
        axes.legend()
    panels[0].set_ylabel("pressure [N/mm$^2$]")
    panels[1].set_ylabel("pressure [N/mm$^2$]")
    panels[2].set_ylabel("pressure [kN/m$^2$]")
    save(figure, "scenes.png", PAGE)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default="build/hpvi")
    parser.add_argument("--output", default="output/contact", type=pathlib.Path)
    arguments = parser.parse_args()
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    GALLERY.mkdir(exist_ok=True)
    lab = Laboratory(str(pathlib.Path(arguments.program).resolve()), arguments.output.resolve())
    lab.home.mkdir(parents=True, exist_ok=True)
    draw_gap(lab)
    draw_scenes(lab)
    against = references(lab)
    table = measure(lab, against)
    for scene in PROBLEMS:
        draw_chart(table, scene)
    draw_pressure_errors(table)
    fits(table)
    compared(table)
    factors(table)
    pressures(lab, table)
    progress(f"charts and tables: {GALLERY}")


if __name__ == "__main__":
    main()
