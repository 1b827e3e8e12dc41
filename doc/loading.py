#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Loads that come and go: the loop of a fretting cycle, Masing's rule, released energy against load steps.

Runs prm/fretting.prm as it is, with other amplitudes and with Tresca's law, and writes tables and
charts to doc/loading/ and into doc/loading.md, between its marker comments.
"""
import argparse
import pathlib
import sys

import numpy as np

from stability import (COLOURS, Laboratory, chart, number, plain, progress, put_table, save, slope,
                       write_csv)

HERE = pathlib.Path(__file__).resolve().parent
GALLERY = HERE / "loading"
PAGE = "loading"
AMPLITUDES = (0.008, 0.010, 0.012)  # mm
BODY = "Boundary top/Displacement={} ; free"
# Tresca's law for the same block, moved by its top alone: no other load does work.
TRESCA = ["Boundary bottom/Contact=bilateral", "Boundary bottom/Friction coefficient=",
          "Boundary bottom/Friction bound=3", "Boundary top/Traction=", "Loading/Adapt=first step",
          "Adaptivity/Maximum steps=1"]


def history(run):
    """The columns of loading.csv, from the unloaded body on."""
    if run.status != "0":
        sys.exit(f"{run.home}: {run.message}")
    table = np.genfromtxt(run.home / "loading.csv", delimiter=",", names=True, dtype=None,
                          encoding="utf-8")
    return {name: np.concatenate([[0.], table[name]]) for name in table.dtype.names
            if name != "stopped_by"}


def loops(lab):
    """Force against displacement for three amplitudes, and what each cycle takes."""
    figure, (axes, zones) = chart(2, "A pressed block moved to and fro: prm/fretting.prm")
    rows, curve = [], []
    for k, amplitude in enumerate(AMPLITUDES):
        progress(f"  fretting, amplitude {amplitude} mm")
        # The cycles begin at their largest displacements, behind the first loading.
        run = history(lab.run("fretting", f"fretting-{amplitude}", "Loading/Steps=60",
                              BODY.format(f"{amplitude}*sin(5*pi*t)")))
        u = amplitude * np.sin(5 * np.pi * run["t"])
        axes.plot(1e3 * u, run["force_top_x"], ".-", color=COLOURS[k], markersize=4,
                  label=f"{1e3 * amplitude:g} µm")
        zones.plot(run["t"][1:], run["slip_bottom"][1:] / 4, ".-", color=COLOURS[k], markersize=4)
        turns = [6, 30, 54]  # t = 1/10, 5/10, 9/10
        taken = np.diff(run["dissipated_energy"][turns])
        rows.append({"amplitude [µm]": f"{1e3 * amplitude:g}",
                     "largest force [N/mm]": plain(np.abs(run["force_top_x"]).max()),
                     **{f"cycle {c + 1} takes [N]": number(e) for c, e in enumerate(taken)}})
        curve += [{"amplitude": amplitude, "t": f"{t:.6f}", "displacement": f"{x:.6e}",
                   "force": f"{f:.6e}", "dissipated_energy": f"{d:.6e}"}
                  for t, x, f, d in zip(run["t"], u, run["force_top_x"],
                                        run["dissipated_energy"])]
    axes.set(xlabel="displacement of the top [µm]", ylabel="force on the top [N/mm]")
    zones.set(xlabel="t [-]", ylabel="share of the contact that slips [-]", ylim=(0, 1.02))
    axes.legend(title="amplitude")
    save(figure, "loops.png", PAGE)
    write_csv(GALLERY / "loops.csv", curve)
    put_table("cycles", rows, page=PAGE)


def zigzag(amplitude):
    """Up, down, and up again: t = 1/5, 3/5, 1."""
    return f"{amplitude}*if(t <= 0.2, 5*t, if(t <= 0.6, 2 - 5*t, 5*t - 4))"


def tresca(lab, steps, *settings, amplitude=0.01):
    run = history(lab.run("fretting", f"tresca-{steps}", *TRESCA, f"Loading/Steps={steps}",
                          BODY.format(zigzag(amplitude)), *settings))
    t = run["t"]
    run["u"] = amplitude * np.where(t <= 0.2, 5 * t, np.where(t <= 0.6, 2 - 5 * t, 5 * t - 4))
    return run


def masing(lab, axes):
    """The branches of the loop are the first loading, twice as large and turned around."""
    steps = 80
    run = tresca(lab, steps)
    u, force, n = run["u"], run["force_top_x"], steps // 5
    axes.plot(1e3 * u, force, "-", color=COLOURS[0], label="computed")
    worst = 0.
    for start, sign in ((n, -1), (3 * n, 1)):
        expected = force[start] + sign * 2 * force[:n + 1]
        axes.plot(1e3 * (u[start] + sign * 2 * u[:n + 1]), expected, "o", color=COLOURS[1],
                  markersize=4, label="first loading, doubled" if sign < 0 else None)
        # Each branch takes two load steps for twice the way of one.
        worst = max(worst, np.abs(force[start:start + 2 * n + 1:2] - expected).max())
    axes.set(xlabel="displacement of the top [µm]", ylabel="force on the top [N/mm]")
    axes.legend()
    return worst / np.abs(force).max()


def work(lab, axes):
    """Work, the area under the curve of force against displacement, and what it becomes."""
    rows = []
    for k, bound in enumerate(("3", "2 + 2*t")):
        for steps in (10, 20, 40, 80, 160, 320):
            run = tresca(lab, steps, f"Boundary bottom/Friction bound={bound}")
            force, energy = run["force_top_x"], run["work"]
            area = np.cumsum(np.diff(run["u"]) * (force[1:] + force[:-1]) / 2)
            balance = (energy - run["dissipated_energy"] - run["stored_energy"]
                       - run["released_energy"])
            rows.append({"g [N/mm²]": bound.replace("*", ""), "load steps": steps,
                         "work [N]": f"{energy[-1]:.7f}",
                         "dissipated [N]": f"{run['dissipated_energy'][-1]:.7f}",
                         "stored [N]": f"{run['stored_energy'][-1]:.7f}",
                         "released [N]": number(run["released_energy"][-1], 2),
                         "out of balance": number(np.abs(balance).max() / energy[-1], 1),
                         "area off by": number(np.abs(area - energy[1:]).max() / energy[-1], 1)})
        n, error = (np.array([abs(float(r[c])) for r in rows[-6:]])
                    for c in ("load steps", "released [N]"))
        axes.loglog(n, error, "os"[k] + "-", color=COLOURS[k],
                    label=f"g = {rows[-1]['g [N/mm²]']} N/mm²: slope {slope(n[2:], error[2:]):.1f}")
    put_table("work", rows, page=PAGE)
    axes.set(xlabel="load steps [-]", ylabel="absolute value of the released energy [N]")
    axes.set_xticks(n, [f"{steps:.0f}" for steps in n])
    axes.set_xticks([], minor=True)
    axes.legend()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default=HERE.parent / "build" / "hpvi", type=pathlib.Path)
    parser.add_argument("--output", default="output/loading", type=pathlib.Path)
    options = parser.parse_args()
    lab = Laboratory(options.program.resolve(), options.output)
    GALLERY.mkdir(exist_ok=True)
    loops(lab)
    progress("  Tresca's law: Masing's rule and work")
    figure, (left, right) = chart(2, "The same block under Tresca's law")
    progress(f"  Masing's rule holds to {masing(lab, left):.1e} of the largest force")
    work(lab, right)
    save(figure, "tresca.png", PAGE)


if __name__ == "__main__":
    main()
