#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""contact_tables.py HPVI: contact-01.csv and convergence.csv of uniform stress states, by value.

A block (0,2) x (0,1) with E = 1, nu = 0 under sigma_xy = tau, sigma_yy = -P; a traction G acts on
the contact edge too. There sigma n = (-tau, P) = G + contact, so that the contact's own tractions
are T_n = G_y - P, T_t = -(tau + G_x) = -g lambda.
"""
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

SCENE = """
subsection Geometry
  set Upper corner = 2, 1
  set Subdivisions = 2, 1
end
subsection Material
  set Young's modulus = 1
  set Poisson's ratio = 0
end
subsection Boundary top
  set Displacement = {slip} + 2*({tau}); -{pressure}
end
subsection Boundary left
  set Traction = 0; -({tau})
end
subsection Boundary right
  set Traction = 0; {tau}
end
subsection Boundary bottom
  set Contact        = bilateral
  set Friction bound = {bound}
  set Traction       = {along}; {up}
end
subsection Adaptivity
  set Method        = hup3
  set Maximum steps = 1
end
subsection Output
  set VTU = false
end
"""

CORNER = """
subsection Boundary bottom
  set Contact        = bilateral
  set Friction bound = 0.3
end
subsection Boundary left
  set Contact        = bilateral
  set Friction bound = 0.3
end
subsection Boundary top
  set Traction = 0.1; -1
end
subsection Adaptivity
  set Maximum steps = 2
end
"""


def run(home, scene):
    file = home / "scene-file.prm"
    file.write_text("set Dimension = 2\n" + scene)
    subprocess.run([sys.argv[1], "--output", str(home / "out"), str(file)], check=True,
                   stdout=subprocess.DEVNULL)
    with open(home / "out" / "contact-01.csv") as table:
        points = list(csv.DictReader(table))
    with open(home / "out" / "convergence.csv") as table:
        return points, list(csv.DictReader(table)), json.loads(
            (home / "out" / "summary.json").read_text())


def expect(name, value, expected, tolerance=1e-11):
    if not abs(float(value) - expected) <= tolerance:
        sys.exit(f"{name} is {value}, expected {expected}")


def uniform_stress(home, slip, tau, bound, along=0., up=0., pressure=0.2):
    points, steps, _ = run(home, SCENE.format(**locals()))
    if len(points) != 4:
        sys.exit(f"{len(points)} rows, expected two Gauss points on each of two edges")
    x = [1 + (edge - 1) + 0.5 + sign * 0.5 / 3 ** 0.5 for edge in (0, 1) for sign in (-1, 1)]
    traction = -(tau + along)
    for point, x_expected in zip(points, x):
        expect("x", point["x"], x_expected)
        expect("y", point["y"], 0)
        expect("normal_displacement", point["normal_displacement"], 0)
        expect("tangential_displacement", point["tangential_displacement"], slip)
        expect("multiplier", point["multiplier"], -traction / bound)
        expect("normal_traction", point["normal_traction"], up - pressure)
        expect("tangential_traction", point["tangential_traction"], traction)
        state = "slip" if slip != 0 else "stick"
        if point["state"] != state:
            sys.exit(f"state is {point['state']}, expected {state}")
    expect("friction_resultant", steps[0]["friction_resultant"], 2 * traction)
    expect("estimate", steps[0]["estimate"], 0)


with tempfile.TemporaryDirectory() as directory:
    home = pathlib.Path(directory)
    for sign in (1, -1):
        uniform_stress(home, slip=0, tau=sign * 0.1, bound=0.3)
        uniform_stress(home, slip=sign * 0.05, tau=sign * 0.1, bound=0.1)
        uniform_stress(home, slip=0, tau=sign * 0.1, bound=0.4, along=sign * 0.2, up=0.5)
        uniform_stress(home, slip=sign * 0.05, tau=sign * 0.1, bound=0.05, along=-sign * 0.05)

    # Two contact boundaries have no tangent in common.
    points, steps, summary = run(home, CORNER)
    if steps[-1]["friction_resultant"] != "" or summary["final"]["friction_resultant"] is not None:
        sys.exit("two contact boundaries share a friction_resultant")
    left = [p for p in points if float(p["x"]) == 0]
    bottom = [p for p in points if float(p["y"]) == 0]
    if left + bottom != points:
        sys.exit("the table is not one boundary after the other")
    for name, rows, coordinate in (("left", left, lambda p: -float(p["y"])),
                                   ("bottom", bottom, lambda p: float(p["x"]))):
        if sorted(rows, key=coordinate) != rows:
            sys.exit(f"the points of {name} are not in the order of their tangent")
