#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Errors on bodies with curved edges over the degree, and those that a mesh file makes with polygons, splines and circles.

Runs a ring and a plate with a hole by uniform p and writes the tables of doc/curves.md, between its marker comments.
"""
import argparse
import csv
import math
import os
import pathlib
import subprocess
import sys

from stability import number, progress, put_table

PAGE = "curves"
DEGREES = (2, 3, 4, 5, 6, 8, 10, 12)
RING = """subsection Geometry
  set Shape        = ring sector
  set Radii        = 1, 2
  set Subdivisions = 2, 4
end
subsection Boundary inner
  set Pressure = 1
end
subsection Boundary start
  set Symmetry = true
end
subsection Boundary end
  set Symmetry = true
end
"""
PLATE = """subsection Geometry
  set Shape        = plate with hole
  set Upper corner = 2, 2
  set Radius       = 0.5
  set Part         = quarter
  set Subdivisions = 2, 2
end
subsection Boundary left
  set Symmetry = true
end
subsection Boundary bottom
  set Symmetry = true
end
subsection Boundary right
  set Traction = 1; 0
end
"""
REST = """subsection Material
  set Young's modulus = 10
  set Poisson's ratio = 0.3
end
subsection Adaptivity
  set Method            = pu
  set Tolerance         = 0
  set Maximum steps     = 13
  set Maximum degree    = 14
end
subsection Output
  set VTU = false
  set Mesh picture = false
end
"""
FLOOR = 5e-8  # the root of what round-off leaves of J
# Lame: u = A r + B/r with E = 10, nu = 0.3 in plane strain.
LAMBDA, MU = 10 * 0.3 / (1.3 * 0.4), 10 / 2.6
J_FREE = -0.13 * (0.4 / 3 + 4 / 3) * math.pi / 4  # outside free
A = -1 / (2 * (LAMBDA + MU) + 8 * MU)             # outside held by a rigid ring
J_HELD, PRESSURE = 3 * A * math.pi / 4, -A * (2 * (LAMBDA + MU) + 2 * MU)


def run(program, home, scene):
    """Energy by degree."""
    home.mkdir(parents=True, exist_ok=True)
    (home / "scene.prm").write_text(scene + REST)
    done = subprocess.run([program, "--output", home / "out", home / "scene.prm"], text=True, stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, env={**os.environ, "OMP_NUM_THREADS": "1"})
    if done.returncode:
        sys.exit(f"{home}: {done.stderr}")
    with open(home / "out/convergence.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    return {int(row["p_max"]): float(row["energy"]) for row in rows}


def norms(energies, J):
    """The energy norm of the error over that of the solution."""
    return {p: math.sqrt(abs(energies[p] - J) / abs(J)) for p in DEGREES if p in energies}


def shown(error):
    return number(error, 2) if error > FLOOR else f"< {FLOOR:.0e}"


def pressures(home):
    """The largest error of the pressure by degree, over the pressure."""
    errors = {}
    with open(home / "out/convergence.csv", newline="") as file:
        degrees = {int(row["step"]): int(row["p_max"]) for row in csv.DictReader(file)}
    for step, p in degrees.items():
        with open(home / f"out/contact-{step:02}.csv", newline="") as file:
            errors[p] = max(abs(float(row["normal_traction"]) / PRESSURE + 1) for row in csv.DictReader(file))
    return errors


def mesh(path, n):
    """A quarter of the ring, 2 x n cells, by vertices alone."""
    nodes = [(r * math.cos(math.pi / 2 * j / n), r * math.sin(math.pi / 2 * j / n)) for r in (1, 1.5, 2) for j in range(n + 1)]
    at = [[i * (n + 1) + j + 1 for j in range(n + 1)] for i in range(3)]
    edges = [(1, at[0][j], at[0][j + 1]) for j in range(n)] + [(2, at[2][j], at[2][j + 1]) for j in range(n)] + \
        [(3, at[i][0], at[i + 1][0]) for i in range(2)] + [(4, at[i][n], at[i + 1][n]) for i in range(2)]
    cells = [(at[i][j], at[i + 1][j], at[i + 1][j + 1], at[i][j + 1]) for i in range(2) for j in range(n)]
    elements = [f"1 2 {g} {g} {a} {b}" for g, a, b in edges] + [f"3 2 5 5 {' '.join(map(str, cell))}" for cell in cells]
    names = ['1 1 "inner"', '1 2 "outer"', '1 3 "start"', '1 4 "end"', '2 5 "ring"']
    sections = {"MeshFormat": ["2.2 0 8"], "PhysicalNames": [len(names), *names],
                "Nodes": [len(nodes), *(f"{k} {x!r} {y!r} 0" for k, (x, y) in enumerate(nodes, 1))],
                "Elements": [len(elements), *(f"{k} {line}" for k, line in enumerate(elements, 1))]}
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("".join(f"${name}\n" + "".join(f"{line}\n" for line in lines) + f"$End{name}\n"
                            for name, lines in sections.items()))


def from_file(curve):
    said = f"  set Curve = {curve}\n" if curve else ""
    scene = "subsection Geometry\n  set Shape = file\n  set File = ring.msh\nend\n" + RING[RING.index("subsection Boundary"):]
    scene = scene.replace("  set Pressure = 1\n", "  set Pressure = 1\n" + said)
    return scene + (f"subsection Boundary outer\n{said}end\n" if curve else "")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default="build/hpvi", type=pathlib.Path)
    parser.add_argument("--output", default="output/curves", type=pathlib.Path)
    options = parser.parse_args()
    program, output = options.program.resolve(), options.output
    (pathlib.Path(__file__).resolve().parent / PAGE).mkdir(exist_ok=True)

    free = norms(run(program, output / "ring", RING), J_FREE)
    held = norms(run(program, output / "held", RING + "subsection Boundary outer\n  set Contact = bilateral\nend\n"), J_HELD)
    pressed = norms(run(program, output / "pressed", RING + "subsection Boundary outer\n  set Contact = unilateral\nend\n"), J_HELD)
    pressure = pressures(output / "pressed")
    energies = run(program, output / "plate", PLATE)
    plate = norms(energies, energies[14])
    put_table("degrees", [{"p": p, "ring": shown(free[p]), "ring held along its arc": shown(held[p]),
                           "ring that may open": shown(pressed[p]), "its pressure": number(pressure[p], 2),
                           "plate with hole": shown(plate[p])} for p in DEGREES], page=PAGE)
    rows = []
    for n in (4, 8, 16):
        row = {"edges on a quarter": n}
        for curve, name in (("", "polygon"), ("spline", "spline"), ("circle", "circle")):
            home = output / f"{name}-{n}"
            mesh(home / "ring.msh", n)
            energy = run(program, home, from_file(curve))[8]
            row[name] = number(abs(energy - J_FREE) / abs(J_FREE), 2)
        rows.append(row)
    put_table("files", rows, page=PAGE)
    progress("doc/curves.md, doc/curves/degrees.csv, doc/curves/files.csv")


if __name__ == "__main__":
    main()
