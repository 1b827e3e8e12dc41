#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Errors on bodies with curved edges over the degree, those that a mesh file makes with polygons, splines and circles, and how
far the residual indicator is above the error on curved cells and on straight ones.

Runs a ring and a plate with a hole by uniform p and writes the tables of doc/curves.md, between its marker comments.
"""
import argparse
import csv
import math
import os
import pathlib
import shutil
import subprocess
import sys

import numpy as np

from stability import number, plain, progress, put_table

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
end
"""
FLOOR = 5e-8  # the root of what round-off leaves of J
# Lame: u = A r + B/r with E = 10, nu = 0.3 in plane strain.
LAMBDA, MU = 10 * 0.3 / (1.3 * 0.4), 10 / 2.6
J_FREE = -0.13 * (0.4 / 3 + 4 / 3) * math.pi / 4  # outside free
A = -1 / (2 * (LAMBDA + MU) + 8 * MU)             # outside held by a rigid ring
J_HELD, PRESSURE = 3 * A * math.pi / 4, -A * (2 * (LAMBDA + MU) + 2 * MU)


def run(program, home, scene, rest=REST):
    """Energy by degree."""
    home.mkdir(parents=True, exist_ok=True)
    (home / "scene.prm").write_text(scene + rest)
    done = subprocess.run([program, "--output", home / "out", home / "scene.prm"], text=True, stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, env={**os.environ, "OMP_NUM_THREADS": "1"})
    if done.returncode:
        sys.exit(f"{home}: {done.stderr}")
    return {int(row["p_max"]): float(row["energy"]) for row in rows_of(home)}


def rows_of(home):
    with open(home / "out/convergence.csv", newline="") as file:
        return list(csv.DictReader(file))


def effectivities(program, home, scene, J):
    """By degree: the indicator over the error, both over the norm of the solution."""
    energies = run(program, home, scene)
    estimates = {int(row["p_max"]): float(row["estimate_relative"]) for row in rows_of(home)}
    return {p: estimates[p] / error for p, error in norms(energies, J).items() if error > FLOOR}


def norms(energies, J):
    """The energy norm of the error over that of the solution."""
    return {p: math.sqrt(abs(energies[p] - J) / abs(J)) for p in DEGREES if p in energies}


def shown(error):
    return number(error, 2) if error > FLOOR else f"< {FLOOR:.0e}"


def pressures(home):
    """The largest error of the pressure by degree, over the pressure."""
    errors = {}
    degrees = {int(row["step"]): int(row["p_max"]) for row in rows_of(home)}
    for step, p in degrees.items():
        with open(home / f"out/contact-{step:02}.csv", newline="") as file:
            errors[p] = max(abs(float(row["normal_traction"]) / PRESSURE + 1) for row in csv.DictReader(file))
    return errors


def mesh(path, n, each_edge=False):
    """A quarter of the ring, 2 x n cells, by vertices alone; the arcs are one boundary each, or as many as they have edges."""
    nodes = [(r * math.cos(math.pi / 2 * j / n), r * math.sin(math.pi / 2 * j / n)) for r in (1, 1.5, 2) for j in range(n + 1)]
    at = [[i * (n + 1) + j + 1 for j in range(n + 1)] for i in range(3)]
    arcs = {f"{name}{j}" if each_edge else name: None for name in ("inner", "outer") for j in range(n)}
    number_of = {name: k for k, name in enumerate((*arcs, "start", "end", "ring"), 1)}
    edges = [(number_of[f"{name}{j}" if each_edge else name], at[i][j], at[i][j + 1])
             for i, name in ((0, "inner"), (2, "outer")) for j in range(n)]
    edges += [(number_of[name], at[i][j], at[i + 1][j]) for name, j in (("start", 0), ("end", n)) for i in range(2)]
    cells = [(at[i][j], at[i + 1][j], at[i + 1][j + 1], at[i][j + 1]) for i in range(2) for j in range(n)]
    group = number_of["ring"]
    elements = [f"1 2 {g} {g} {a} {b}" for g, a, b in edges] + [f"3 2 {group} {group} {' '.join(map(str, cell))}" for cell in cells]
    names = [f'{2 if name == "ring" else 1} {k} "{name}"' for name, k in number_of.items()]
    sections = {"MeshFormat": ["2.2 0 8"], "PhysicalNames": [len(names), *names],
                "Nodes": [len(nodes), *(f"{k} {x!r} {y!r} 0" for k, (x, y) in enumerate(nodes, 1))],
                "Elements": [len(elements), *(f"{k} {line}" for k, line in enumerate(elements, 1))]}
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("".join(f"${name}\n" + "".join(f"{line}\n" for line in lines) + f"$End{name}\n"
                            for name, lines in sections.items()))


def from_file(curve):
    said = f"  set Curve = {curve}\n" if curve else ""
    scene = FILE + RING[RING.index("subsection Boundary"):]
    scene = scene.replace("  set Pressure = 1\n", "  set Pressure = 1\n" + said)
    return scene + (f"subsection Boundary outer\n{said}end\n" if curve else "")


# Lame's stress is S + T/r^2 (1 - 2 e_r e_r'), u_r = U r + V/r.
S, T = 1 / 3, 4 / 3
U, V = 0.13 * 0.4 * S, 0.13 * T
FILE = "subsection Geometry\n  set Shape = file\n  set File = ring.msh\nend\n"


def polygon(n):
    """The tractions of Lame's field on the edges of a quarter of 2 x n straight cells, and J of its body."""
    scene, J = FILE + RING[RING.index("subsection Boundary start"):], 0.
    points, weights = np.polynomial.legendre.leggauss(30)
    for name, r, side in (("inner", 1, -1), ("outer", 2, 1)):
        for j in range(n):
            ends = [r * np.array((math.cos(t), math.sin(t))) for t in (math.pi / 2 * j / n, math.pi / 2 * (j + 1) / n)]
            normal = side * (ends[0] + ends[1]) / np.linalg.norm(ends[0] + ends[1])
            traction = "; ".join(f"{S * c!r}+{T!r}/(x^2+y^2)*({c!r}-2*({normal[0]:.17g}*x+({normal[1]:.17g})*y)*{x}/(x^2+y^2))"
                                 for c, x in zip(map(float, normal), "xy"))
            scene += f"subsection Boundary {name}{j}\n  set Traction = {traction}\nend\n"
            for s, weight in zip(points, weights):
                x = ends[0] + (1 + s) / 2 * (ends[1] - ends[0])
                rr = x @ x
                force = S * normal + T / rr * (normal - 2 * (normal @ x) * x / rr)
                J -= weight / 4 * np.linalg.norm(ends[1] - ends[0]) * (force @ x) * (U + V / rr)
    return scene, J


def rectangles(n):
    """The ring rolled out: 2 x n rectangles as long as its cells in the middle, u_x = U x + V/x, u_y = 0, and J."""
    length, M = 0.75 * math.pi, LAMBDA + 2 * MU
    scene = f"""subsection Geometry
  set Lower corner = 1, 0
  set Upper corner = 2, {length!r}
  set Subdivisions = 2, {n}
end
subsection Boundary left
  set Traction = {M * (V - U)!r}; 0
end
subsection Boundary right
  set Displacement = 0; free
end
subsection Boundary bottom
  set Symmetry = true
end
subsection Boundary top
  set Symmetry = true
end
subsection Body force
  set Expression = {-2 * M * V!r}/x^3; 0
end
"""
    return scene, -length * M / 2 * (U**2 - U * V + 7 * V**2 / 24)


DRAWING = """Point(1) = {0, 0, 0}; Point(2) = {4, 0, 0}; Point(3) = {3.6, 3.4, 0}; Point(4) = {0.3, 4, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Physical Curve("floor") = {1}; Physical Curve("right") = {2}; Physical Curve("roof") = {3};
Physical Surface("body") = {1};
Mesh.Algorithm = 6; Mesh.RecombineAll = 1; Mesh.RecombinationAlgorithm = 3;
Mesh.CharacteristicLengthMin = 0.0935; Mesh.CharacteristicLengthMax = 0.0935;
"""
PLATE_OF_FILE = FILE.replace("ring", "plate") + """subsection Boundary floor
  set Contact        = bilateral
  set Friction bound = 0.1
end
subsection Boundary roof
  set Pressure = 1
end
subsection Boundary right
  set Displacement = 0; 0
end
"""


def assembly(program, home):
    """Microseconds of each cell and percent of the step, the least of ten runs: of a first step, and where p is raised from 2."""
    home.mkdir(parents=True, exist_ok=True)
    (home / "plate.geo").write_text(DRAWING)
    subprocess.run(["gmsh", "-2", "-format", "msh41", home / "plate.geo", "-o", home / "plate.msh"], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    result = {}
    for name, degrees, scene in [("first step", (p,), PLATE_OF_FILE.replace("subsection Geometry", f"subsection Adaptivity\n  set Start degree = {p}\nend\n"
                                                                           "subsection Geometry")) for p in (4, 6, 8)] + \
                                [("p raised from 2", (4, 6, 8), PLATE_OF_FILE)]:
        rest = REST.replace("Maximum steps     = 13", f"Maximum steps     = {1 if name == 'first step' else 7}")
        least = {}
        for _ in range(10):
            run(program, home, scene, rest + "subsection Error\n  set Bound = false\nend\n")
            for row in rows_of(home):
                if int(row["p_max"]) in degrees:
                    for stage in [stage for stage in row if stage.startswith("seconds_")]:
                        key = int(row["p_max"]), stage
                        least[key] = min(least.get(key, math.inf), float(row[stage] or 0) / int(row["elements"]))
        for p in degrees:
            own = least[p, "seconds_assemble"]
            share = own / sum(value for (degree, _), value in least.items() if degree == p)
            result.setdefault(p, {"p": p})[name] = f"{1e6 * own:.0f} us, {100 * share:.0f} %"
    return list(result.values())


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
    columns = {}
    for n, turn in ((4, "22.5"), (2, "45")):
        mesh(output / f"polygon-{n}-tractions/ring.msh", n, each_edge=True)
        for name, scene, J in ((f"ring, cells of {turn} degrees", RING.replace("2, 4", f"2, {n}"), J_FREE),
                               (f"2 x {n} rectangles", *rectangles(n)), (f"polygon, 2 x {n}", *polygon(n))):
            home = output / f"polygon-{n}-tractions" if "polygon" in name else output / name.replace(" ", "-").replace(",", "")
            columns[name] = effectivities(program, home, scene, J)
    put_table("effectivity", [{"p": p, **{name: plain(values[p], 1) for name, values in columns.items()}} for p in range(2, 7)],
              page=PAGE)
    if shutil.which("gmsh"):
        put_table("assembly", assembly(program, output / "plate"), page=PAGE)
    progress("doc/curves.md, doc/curves/*.csv")


if __name__ == "__main__":
    main()
