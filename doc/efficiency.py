#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The efficiency of the thesis's residual indicator, cell by cell (Theorem 4.5).

Runs tests/benchmark/efficiency.cc on the stick-slip scene, whose solution is known in closed form, and
writes a chart and a table to doc/bound/ and into doc/bound.md, between its marker comments.
"""
import argparse
import csv
import io
import os
import subprocess

import numpy as np

from stability import COLOURS, chart, plain, progress, put_table, save

PAGE = "bound"
FLOOR = 1e-10  # of the largest local error in a step: below it round-off is measured


def read(program):
    """Columns of the table by name, without cells whose error is that of round-off."""
    done = subprocess.run([program], check=True, capture_output=True, text=True)
    rows = list(csv.DictReader(io.StringIO(done.stdout)))
    table = {name: np.array([r[name] if name == "run" else float(r[name]) for r in rows])
             for name in rows[0]}
    largest = {}
    for run, step, error in zip(table["run"], table["step"], table["error"]):
        largest[run, step] = max(largest.get((run, step), 0), error)
    keep = np.array([error > FLOOR * largest[run, step] for run, step, error in
                     zip(table["run"], table["step"], table["patch_error"])])
    return {name: values[keep] for name, values in table.items()}


def ratios(table):
    """eta_K over the right-hand side of the theorem without its powers of p, and without lambda."""
    multiplier = np.nan_to_num(table["multiplier_error"])
    return {"patch": table["indicator"] / np.hypot(table["patch_error"], multiplier),
            "displacement": table["indicator"] / table["patch_error"],
            "own": table["indicator"] / table["error"]}


def draw(table):
    figure, panels = chart(2, "Theorem 4.5 on the stick-slip scene: indicator over error, by cell",
                           width=11)
    contact = ~np.isnan(table["multiplier_error"])
    quotient = ratios(table)
    for axes, key, title in zip(
            panels, ("patch", "displacement"),
            ("with the multiplier's term", "without it")):
        for cells, colour, shift, label in ((~contact, COLOURS[0], -0.1, "cells inside"),
                                            (contact, COLOURS[1], 0.1, "cells on $\\Gamma_C$")):
            axes.semilogy(table["degree"][cells] + shift, quotient[key][cells], ".",
                          color=colour, markersize=3, alpha=0.4, label=label)
        degrees = np.arange(table["degree"].min(), table["degree"].max() + 1)
        axes.semilogy(degrees, 2 * degrees, "k--", linewidth=1, label="2 p")
        axes.set(title=title, xlabel="polynomial degree p of the cell [-]",
                 ylabel="$\\eta_K$ / local error on $K_{patch}$ [-]")
        axes.legend(fontsize=8, loc="lower right")
    save(figure, "efficiency.png", PAGE)


def tabulate(table):
    """Quantiles of the quotients by degree."""
    contact = ~np.isnan(table["multiplier_error"])
    quotient = ratios(table)
    rows = []
    for p in sorted(set(table["degree"])):
        row = {"p": int(p), "cells inside": int(((table["degree"] == p) & ~contact).sum()),
               "on Gamma_C": int(((table["degree"] == p) & contact).sum())}
        for name, key, where in (("inside: median", "patch", ~contact),
                                 ("inside: largest", "patch", ~contact),
                                 ("on Gamma_C: median", "patch", contact),
                                 ("on Gamma_C: largest", "patch", contact),
                                 ("largest without lambda", "displacement", contact)):
            values = quotient[key][where & (table["degree"] == p)]
            row[name] = plain(np.median(values) if "median" in name else values.max(), 2) \
                if len(values) else ""
        rows.append(row)
    put_table("efficiency", rows, page=PAGE)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default="build/tests/efficiency")
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    table = read(parser.parse_args().program)
    draw(table)
    tabulate(table)
    progress(f"{len(table['run'])} cells: doc/bound/efficiency.png, doc/bound/efficiency.csv")


if __name__ == "__main__":
    main()
