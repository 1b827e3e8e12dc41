#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Seconds of all scenes, with the bound of the error and without, into the table of doc/manual/gallery.md: wall time of the
whole program, one thread, the median of three runs."""
import argparse
import csv
import os
import pathlib
import re
import statistics
import subprocess
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
ROW = re.compile(r"^\| \[(\S+)\.prm\]\(\.\./\.\./prm/\S+\) \| [\d.]+ \| (?:[\d.]+|-) \| ", re.M)


def seconds(program, scene, *entries):
    """Median of three runs; pictures and tables are written."""
    times = []
    with tempfile.TemporaryDirectory() as home:
        for _ in range(3):
            start = time.monotonic()
            subprocess.run([program, f"prm/{scene}.prm", "--output", home, *entries], check=True, cwd=ROOT,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                           env={**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"})
            times.append(time.monotonic() - start)
        with open(pathlib.Path(home) / "convergence.csv", encoding="utf-8") as table:
            has_bound = any(step.get("error_bound") for step in csv.DictReader(table))
    return statistics.median(times), has_bound


def row(program, scene):
    """The start of its row; a dash where there is no bound that could be left out."""
    with_bound, has_bound = seconds(program, scene)
    without = f"{seconds(program, scene, '--set', 'Error/Bound=false')[0]:.1f}" if has_bound else "-"
    print(f"{scene}: {with_bound:.1f} s, without the bound {without}", flush=True)
    return f"| [{scene}.prm](../../prm/{scene}.prm) | {with_bound:.1f} | {without} | "


parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--program", default="build/hpvi")
program = ROOT / parser.parse_args().program
page = ROOT / "doc/manual/gallery.md"
text = page.read_text()
page.write_text(ROW.sub(lambda found: row(program, found[1]), text))
