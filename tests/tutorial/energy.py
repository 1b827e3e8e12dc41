#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Build the tutorial program as a user does, and compare it with hpvi on the same meshes.

energy.py HPVI TUTORIAL SCENE.prm CMAKE GENERATOR
"""
import csv
import os
import pathlib
import re
import subprocess
import sys
import tempfile

HPVI, TUTORIAL, SCENE, CMAKE, GENERATOR = sys.argv[1:6]
ENVIRONMENT = {**os.environ, "OMP_NUM_THREADS": "1"}
TOLERANCE = 1e-10
# A column of the tutorial's table and that of convergence.csv.
COLUMNS = {"cells": "elements", "dofs": "dofs_free", "multipliers": "multipliers",
           "lagrangian": "lagrangian", "energy": "energy"}


def run(*command, **options):
    done = subprocess.run([str(word) for word in command], text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, env=ENVIRONMENT, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout


def table(text):
    header, *rows = [line.split() for line in text.strip().splitlines()]
    return [dict(zip(header, row)) for row in rows]


def full_program(directory, degree, n_meshes):
    run(HPVI, "--output", directory, "--set", f"Adaptivity/Method=hup{degree}", "--set",
        f"Adaptivity/Maximum steps={n_meshes}", "--set", "Error/Bound=false", SCENE)
    with open(directory / "convergence.csv") as file:
        return list(csv.DictReader(file))


def compare(directory, rows, degree):
    reference = full_program(directory / f"hpvi-{degree}", degree, len(rows))
    if len(rows) != 4 or len(reference) != len(rows):
        sys.exit(f"{len(rows)} meshes, {len(reference)} of hpvi")
    for row, other in zip(rows, reference):
        for ours, theirs in COLUMNS.items():
            difference = float(row[ours]) - float(other[theirs])
            if abs(difference) > TOLERANCE:
                sys.exit(f"degree {degree}, {row['cells']} cells: {ours} {row[ours]}, hpvi has "
                         f"{other[theirs]}")


def check_contact(directory):
    """Friction is within its bound, and where it is below nothing slips more than the mesh allows."""
    with open(directory / "contact-4.csv") as file:
        rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]
    if any(abs(row["multiplier"]) > 1 for row in rows):
        sys.exit("|lambda| > 1")
    slips = [row for row in rows if abs(row["multiplier"]) == 1]
    if not 0.5 < max(row["x"] for row in slips) < 1.5:
        sys.exit("the transition is outside of [0.5, 1.5], where the thesis has it")
    if any(row["slip"] * row["multiplier"] <= 0 for row in slips):
        sys.exit("friction pushes")


def check_readme(rows):
    """The table in Readme.md is that of the program, to round-off."""
    text = (pathlib.Path(TUTORIAL) / "Readme.md").read_text()
    shown = table(re.search(r"^ *cells .*?(?=\n\n|\n<)", text, re.M | re.S).group())
    for row, printed in zip(rows, shown, strict=True):
        for column in COLUMNS:
            if abs(float(row[column]) - float(printed[column])) > TOLERANCE:
                sys.exit(f"Readme.md: {column} {printed[column]}, the program has {row[column]}")


def main():
    n_lines = len((pathlib.Path(TUTORIAL) / "tresca_friction.cc").read_text().splitlines())
    if n_lines > 600:
        sys.exit(f"tresca_friction.cc has {n_lines} lines, more than 600")
    with tempfile.TemporaryDirectory() as scratch:
        directory = pathlib.Path(scratch)
        run(CMAKE, "-S", TUTORIAL, "-B", directory, "-G", GENERATOR,
            "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Wpedantic -Werror")
        run(CMAKE, "--build", directory)
        for degree in (2, 4, 3):
            arguments = [] if degree == 3 else [degree]
            rows = table(run(directory / "tresca_friction", *arguments, cwd=directory))
            compare(directory, rows, degree)
        check_contact(directory)
        check_readme(rows)


if __name__ == "__main__":
    main()
