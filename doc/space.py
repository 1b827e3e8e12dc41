#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Charts for doc/space.md: J against unknowns for uniform and adaptive meshes of degree 2, 3, 4, and
conjugate gradients against unknowns, of prm/slab.prm. J of the finest adaptive mesh of degree 4 is the limit."""
import argparse
import csv
import pathlib
import subprocess

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

parser = argparse.ArgumentParser()
parser.add_argument("--program", default="build/hpvi")
parser.add_argument("--output", default="output/space")
parser.add_argument("--unknowns", type=int, default=60000, help="a run ends behind so many")
parser.add_argument("--figures", default="doc/space")
options = parser.parse_args()
OUTPUT = pathlib.Path(options.output)


def run(name, method, unknowns):
    """The rows of convergence.csv of a run that is made unless it is there."""
    directory = OUTPUT / name
    table = directory / "convergence.csv"
    done = directory / "summary.json"
    if not done.exists() or '"done"' not in done.read_text():
        subprocess.run([options.program, "--output", str(directory), "prm/slab.prm",
                        "--set", f"Adaptivity/Method={method}", "--set", "Output/VTU=false",
                        "--set", "Output/Contact tables=false",
                        "--set", f"Adaptivity/Maximum unknowns={unknowns}"],
                       check=True, stdout=subprocess.DEVNULL)
    with table.open(newline="") as file:
        return [{key: float(value or "nan") for key, value in row.items()} for row in csv.DictReader(file)]


runs = {label: run(label.replace(" ", "-"), method, options.unknowns)
        for label, method in [("uniform Q2", "hup2"), ("adaptive Q2", "hap2"), ("adaptive Q3", "hap3"),
                              ("adaptive Q4", "hap4")]}
limit = run("limit", "hap4", 4 * options.unknowns)[-1]

figure, (error, steps) = plt.subplots(1, 2, figsize=(10, 4.2), layout="constrained")
for marker, (label, rows) in zip("os^D", runs.items()):
    n = [row["dofs_free"] for row in rows]
    error.loglog(n, [abs(row["lagrangian"] / limit["lagrangian"] - 1) for row in rows], marker + "-", label=label)
    steps.semilogx(n, [row["newton_cg"] for row in rows], marker + "-", label=label)
error.set_xlabel("free unknowns")
error.set_ylabel("relative error of J")
error.grid(alpha=0.3)
error.legend()
steps.set_xlabel("free unknowns")
steps.set_ylabel("conjugate-gradient steps of a whole Newton run")
steps.set_ylim(bottom=0)
steps.grid(alpha=0.3)
pathlib.Path(options.figures).mkdir(exist_ok=True)
figure.savefig(pathlib.Path(options.figures) / "convergence.png", dpi=110)

print(f"limit J = {limit['lagrangian']:.6f} at {limit['dofs_free']:.0f} unknowns")
for label, rows in runs.items():
    print(label)
    for row in rows:
        print("  {dofs_free:9.0f} {slipping:6.0f} {newton_steps:3.0f} {newton_cg:4.0f} {newton_setups:3.0f} "
              "{lagrangian:12.7f} {seconds:8.2f}".format(**row))
