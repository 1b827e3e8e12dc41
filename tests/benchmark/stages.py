#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the time of one long run goes: each stage as a multiple of the sparse factorisation.

Runs Example 5.2 with hpa2 to 20000 unknowns, and scenes whose contact opens to 50000, output off, and
takes the median of several runs.
The factorisation counts analysis, numeric factorisation and the Schur complement, in the same
process; so the ratios hold on any machine, absolute times do not.
"""
import argparse
import csv
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

STAGES = "setup assemble factor qp recover estimate decide refine bound".split()
QUIET = ("Output/VTU=false", "Output/Contact tables=false")


def run(program, scene, settings):
    """Seconds by stage of one run, and its last number of unknowns."""
    with tempfile.TemporaryDirectory() as home:
        command = [program, "--output", home, scene]
        for setting in QUIET + settings:
            command += ["--set", setting]
        done = subprocess.run(command, check=True, capture_output=True, text=True)
        if "(Release build)" not in done.stdout:
            sys.exit("this is a Debug build, 30 times slower in assembly: build Release to measure")
        rows = list(csv.DictReader(open(pathlib.Path(home) / "convergence.csv")))
    seconds = {s: sum(float(row["seconds_" + s]) for row in rows) for s in STAGES}
    return seconds, int(rows[-1]["dofs_free"])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default="build/hpvi")
    parser.add_argument("--runs", type=int, default=7)
    arguments = parser.parse_args()
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    steps = "Adaptivity/Maximum steps=100"
    one_thread = "Solver/Threads=1"
    for scene, settings in (
            ("han-6-12", ("Adaptivity/Method=hpa2", "Adaptivity/Maximum unknowns=20000",
                          "Adaptivity/Smoothness reading=joint")),
            ("han-6-12", ("Adaptivity/Method=hpa2", "Adaptivity/Maximum unknowns=20000",
                          "Adaptivity/Smoothness reading=plain")),
            ("han-6-12-unilateral", ("Adaptivity/Maximum unknowns=50000",)),
            ("hertz", ("Adaptivity/Maximum unknowns=50000",)),
            ("resting", ("Adaptivity/Maximum unknowns=50000",))):
        runs = [run(arguments.program, f"prm/{scene}.prm", settings + (steps, one_thread))
                for _ in range(arguments.runs)]
        factor = statistics.median(seconds["factor"] for seconds, _ in runs)
        print(f"{scene}, {', '.join(settings)}: {runs[0][1]} unknowns at the end, "
              f"median of {arguments.runs} runs")
        print("stage      seconds  / factorisation")
        for stage in STAGES:
            median = statistics.median(seconds[stage] for seconds, _ in runs)
            print(f"{stage:10}{median:8.3f}{median / factor:10.2f}")
        for what, left_out in (("no bound", ["bound"]), ("total", [])):
            totals = [sum(s[k] for k in STAGES if k not in left_out) for s, _ in runs]
            ratio = statistics.median(t / s["factor"] for t, (s, _) in zip(totals, runs))
            print(f"{what:10}{statistics.median(totals):8.3f}{ratio:10.2f}")
        print()


if __name__ == "__main__":
    main()
