#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The bound on cells that are no parallelograms: cost and distance from the true error.

Runs tests/benchmark/distorted.cc several times, for medians of processor times, and writes tables to
doc/bound/ and into doc/bound-distorted.md, between its marker comments.
"""
import argparse
import csv
import io
import os
import subprocess

import numpy as np

from stability import HERE, plain, progress, put_table

PAGE = "bound-distorted"
REPEATS = 3
METHODS = ("hup2", "hap4", "hpa3")


def measure(program):
    """Columns by run; processor times are medians."""
    tables = []
    for repeat in range(REPEATS):
        progress(f"round {repeat + 1}")
        done = subprocess.run([program], check=True, capture_output=True, text=True)
        tables.append(list(csv.DictReader(io.StringIO(done.stdout))))
    runs = {}
    for rows in zip(*tables):
        run = runs.setdefault(rows[0]["run"], {})
        for name in rows[0]:
            if name != "run":
                run.setdefault(name, []).append(np.median([float(row[name]) for row in rows]))
    return {name: {c: np.array(v) for c, v in run.items()} for name, run in runs.items()}


def span(values, digits):
    return f"{plain(values.min(), digits)} to {plain(values.max(), digits)}"


def cost(run):
    return run["seconds_bound"] / run["seconds"]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default="build/tests/distorted")
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    runs = measure(parser.parse_args().program)
    (HERE / PAGE).mkdir(exist_ok=True)
    raised = {name: cost(runs[f"raised {name}"]) for name in ("block", "field", "bracket")}
    put_table("raised", [{"p": int(p), "block": plain(raised["block"][k], 2), "stick-slip": plain(raised["field"][k], 2),
                          "bracket": plain(raised["bracket"][k], 2)}
                         for k, p in enumerate(runs["raised block"]["degree"])], page=PAGE)
    rows = []
    for method in METHODS:
        block, field = runs[f"block {method}"], runs[f"field {method}"]
        rows.append({"method": method, "bound / step, block": span(cost(block), 1),
                     "bound / true error, stick-slip": span(field["bound"] / field["error"], 2)})
    put_table("adaptive", rows, page=PAGE)
    rows = []
    for problem in ("Example 5.2", "Stick-slip"):
        for method in METHODS:
            plain_run, by_rows = (runs[f"{problem} {kind} {method}"]
                                for kind in ("rectangles", "rows"))
            n = min(len(plain_run["bound"]), len(by_rows["bound"]))
            same = plain_run["dofs_free"][:n] == by_rows["dofs_free"][:n]
            ratio = by_rows["bound"][:n][same] / plain_run["bound"][:n][same]
            total = by_rows["seconds_bound"][:n][same] / plain_run["seconds_bound"][:n][same]
            rows.append({"problem": problem, "method": method, "steps": int(same.sum()),
                         "bound, rows / rectangles": span(ratio, 3),
                         "its time, rows / rectangles": span(total, 1)})
    put_table("rectangles", rows, page=PAGE)


if __name__ == "__main__":
    main()
