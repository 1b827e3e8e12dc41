#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Build the tutorial program as a user does, and compare it with hpvi on the same meshes; also with the
exercise done that lets the block lift off, which asks for walls at zero and at infinity.

energy.py HPVI TUTORIAL SCENE.prm CMAKE GENERATOR
"""
import csv
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

HPVI, TUTORIAL, SCENE, CMAKE, GENERATOR = sys.argv[1:6]
ENVIRONMENT = {**os.environ, "OMP_NUM_THREADS": "1"}
TOLERANCE = 1e-10
# A column of the tutorial's table and that of convergence.csv.
COLUMNS = {"cells": "elements", "dofs": "dofs_free", "multipliers": "multipliers",
           "lagrangian": "lagrangian", "energy": "energy"}


# The exercise: a second argument lets the block lift off. What is inserted, and before which line.
EXERCISE = {
    "/** The traction on the left edge. */": "bool lifts = false;\n",
    "  VectorTools::interpolate_boundary_values(dof_handler, Problem::bottom,": "  if (!Problem::lifts)\n",
    "// @sect3{Solving}": """void Block::assemble_pressure()
{
  const QGauss<1> quadrature(degree);
  const auto psi = Polynomials::generate_complete_Lagrange_basis(multiplier_points.get_points());
  const FEValuesExtractors::Scalar upward(1);
  Vector<double> row(fe.n_dofs_per_cell());
  std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
  for_each_contact_edge(quadrature, update_values | update_JxW_values,
                        [&](const unsigned int, const auto &cell, const FEFaceValues<2> &values)
                        {
                          cell->get_dof_indices(dofs);
                          for (const auto &psi_i : psi)
                          {
                            row = 0;
                            for (const unsigned int q : values.quadrature_point_indices())
                              for (unsigned int j = 0; j < row.size(); ++j)
                                row[j] -= psi_i.value(quadrature.point(q)[0]) *
                                          values[upward].value(j, q) * values.JxW(q);
                            B.emplace_back(dof_handler.n_dofs());
                            constraints.distribute_local_to_global(row, dofs, B.back());
                          }
                        });
}

""",
    "  void solve();": "  void assemble_pressure();\n",
    "  steps = Mprgp(S, d, lower, upper)": """  for (unsigned int i = n / 2; Problem::lifts && i < n; ++i)
  {
    lower[i] = 0.;
    upper[i] = std::numeric_limits<double>::infinity();
  }
""",
    "    solve();": "    if (Problem::lifts)\n      assemble_pressure();\n",
    "    const int degree = argc": "    TrescaFriction::Problem::lifts = argc > 2;\n",
}


def do_exercise(source):
    text = source.read_text()
    for line, inserted in EXERCISE.items():
        if text.count(line) != 1:
            sys.exit(f"{source.name}: not one line begins {line!r}")
        text = text.replace(line, inserted + line)
    source.write_text(text)


def run(*command, **options):
    done = subprocess.run([str(word) for word in command], text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, env=ENVIRONMENT, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout


def table(text):
    header, *rows = [line.split() for line in text.strip().splitlines()]
    return [dict(zip(header, row)) for row in rows]


def full_program(directory, degree, n_meshes, *settings):
    settings = [f"Adaptivity/Method=hup{degree}", f"Adaptivity/Maximum steps={n_meshes}", "Error/Bound=false", *settings]
    run(HPVI, "--output", directory, *(word for setting in settings for word in ("--set", setting)), SCENE)
    with open(directory / "convergence.csv") as file:
        return list(csv.DictReader(file))


def compare(directory, rows, degree, *settings):
    reference = full_program(directory / f"hpvi-{degree}-{len(settings)}", degree, len(rows), *settings)
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
        shutil.copytree(TUTORIAL, directory / "source")
        do_exercise(directory / "source/tresca_friction.cc")
        run(CMAKE, "-S", directory / "source", "-B", directory, "-G", GENERATOR,
            "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Wpedantic -Werror")
        run(CMAKE, "--build", directory)
        for degree in (2, 4, 3):
            arguments = [] if degree == 3 else [degree]
            rows = table(run(directory / "tresca_friction", *arguments, cwd=directory))
            compare(directory, rows, degree)
        check_contact(directory)
        check_readme(rows)
        rows = table(run(directory / "tresca_friction", 3, "lifts", cwd=directory))
        compare(directory, rows, 3, "Boundary bottom/Contact=unilateral", "Solver/Normal contact=multiplier")


if __name__ == "__main__":
    main()
