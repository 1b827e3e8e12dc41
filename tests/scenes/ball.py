#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""ball.py HPVI: prm/ball.prm without friction beside the same ball as a body of revolution, whose boundary is the circle and whose force is
known to a millionth; and beside Hertz, whose half spaces leave a percent of the approach and less of the pressure."""
import csv
import math
import pathlib
import subprocess
import sys
import tempfile

from runs import PROGRAM, SCENES

PLANE = """set Dimension = 2
subsection Geometry
  set Shape = file
  set File  = quarter.msh
end
subsection Material
  set Young's modulus = 2000
  set Poisson's ratio = 0.3
  set Plane           = axisymmetric
end
subsection Boundary z0
  set Symmetry = true
end
subsection Boundary surface
  set Curve   = circle
  set Contact = unilateral
  set Gap     = (9.95 - y)*10/max(y, 1)
end
subsection Adaptivity
  set Method        = hpa3
  set Maximum steps = 14
end
"""


def run(folder, scene, *entries):
    """The force on the surface along the axis, and the largest pressure."""
    arguments = [part for entry in entries for part in ("--set", entry)]
    subprocess.run([PROGRAM, scene, "--output", folder, *arguments], check=True, stdout=subprocess.DEVNULL)
    with open(folder / "forces.csv") as file:
        force = [row for row in csv.DictReader(file) if row["name"] == "surface"][-1]
    with open(sorted(folder.glob("contact-*.csv"))[-1]) as file:
        return force, max(-float(row["normal_traction"]) for row in csv.DictReader(file))


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    mesh = subprocess.run([sys.executable, SCENES / "meshes/ball.py", "plane"], check=True, capture_output=True).stdout
    (folder / "quarter.msh").write_bytes(mesh)
    (folder / "plane.prm").write_text(PLANE)
    plane, plane_pressure = run(folder / "plane", folder / "plane.prm")
    space, pressure = run(folder / "space", SCENES / "ball.prm", "Boundary surface/Friction coefficient=0",
                          "Adaptivity/Maximum unknowns=20000")
    mesh = subprocess.run([sys.executable, SCENES / "meshes/ball.py"], check=True, capture_output=True).stdout
    assert mesh == (SCENES / "meshes/ball.msh").read_bytes(), "prm/meshes/ball.msh is not what ball.py writes"

whole, expected = -4 * float(space["Fz"]), -float(plane["Fy"])
assert abs(whole / expected - 1) < 1e-3, (whole, expected)
assert abs(pressure / plane_pressure - 1) < 0.005, (pressure, plane_pressure)
modulus = 2000 / (1 - 0.3**2)
hertz = (6 * whole * modulus**2 / (math.pi**3 * 100)) ** (1 / 3)
assert abs(pressure / hertz - 1) < 0.01, (pressure, hertz)
print(f"force {whole:.4f} N, of revolution {expected:.4f}; pressure {pressure:.3f} N/mm^2, {plane_pressure:.3f}, by Hertz {hertz:.3f}")
