# SPDX-License-Identifier: LGPL-2.1-or-later
"""paths.py HPVI MPIRUN: scenes that both paths offer have the same meshes, energies, forces and balance on each of
them, and on two and three processes."""

import math
import subprocess
import sys
import unittest

from runs import ENVIRONMENT, SCENES, RunTest, command, run_program

MPIRUN = [sys.argv.pop(1), "--oversubscribe", "--bind-to", "none"]
# Meshes that depend on the indicator alone, a discrete problem that both paths have, solved to the end.
ALIKE = ("Solver/Normal contact=multiplier", "Solver/Primal tolerance=1e-11", "Adaptivity/Start degree=2",
         "Adaptivity/Indicator=residual", "Adaptivity/Tolerance=0", "Adaptivity/Maximum steps=3", "Error/Bound=false",
         "Output/VTU=false")
# scene, settings, processes
TABLE = (
    ("han-6-12", ("Adaptivity/Method=hap2",), 3),
    ("han-6-12", ("Adaptivity/Method=hup3", "Adaptivity/Start degree=3", "Boundary bottom/Friction bound=1 + x^2"), 1),
    ("han-6-12", ("Adaptivity/Method=hup2", "Geometry/Subdivisions=2, 6", "Body force/Expression=0; -0.1*x"), 2),
    ("han-6-12-unilateral", ("Adaptivity/Method=hap2",), 2),
    ("han-6-12-unilateral", ("Adaptivity/Method=hup2", "Boundary bottom/Gap=0.02*(x - 2)^2"), 1),
    ("han-6-13", ("Adaptivity/Method=hap2",), 1),
    ("punch", ("Adaptivity/Method=hup2",), 3),
    ("threshold", ("Adaptivity/Method=hup2",), 1),
)
COUNTS = ("step", "elements", "dofs", "dofs_free", "multipliers", "p_min", "p_max")
# Contact forces are compared as nodal reactions, which hold to round-off. J holds |u_t|, whose kinks lie between points.
NUMBERS = {"lagrangian": 1e-8, "energy": 2e-2, "energy_norm": 1e-8, "estimate": 1e-5}


class Paths(RunTest):
    def results(self, n_processes, scene, settings):
        """Rows of the table and the summary."""
        run = command(SCENES / f"{scene}.prm", self.out, *ALIKE, *settings)
        if n_processes == 1:
            self.said(0, *run_program(run))
        else:
            subprocess.run([*MPIRUN, "-np", str(n_processes), *run], capture_output=True, env=ENVIRONMENT, timeout=120, check=True)
        return self.rows(), self.summary()

    def check_rows(self, reduced, primal):
        self.assertEqual(len(reduced), len(primal))
        for one, other in zip(reduced, primal):
            self.assertEqual([one[name] for name in COUNTS], [other[name] for name in COUNTS])
            for name, tolerance in NUMBERS.items():
                a, b, size = float(one[name]), float(other[name]), float(one["energy_norm"])
                size = size**2 if name in ("lagrangian", "energy") else size
                self.assertLessEqual(abs(a - b), tolerance * size, name)

    def check_forces(self, reduced, primal):
        """Nodal reactions by boundary and their balance."""
        self.assertEqual(reduced["forces"].keys(), primal["forces"].keys())
        largest = max(math.hypot(*force["force"]) for force in reduced["forces"].values())
        for name, force in reduced["forces"].items():
            self.assertLessEqual(math.dist(force["force"], primal["forces"][name]["force"]), 1e-7 * largest, name)
        for summary in (reduced, primal):
            self.assertLess(summary["balance"]["force"], 1e-8)
            self.assertLess(summary["balance"]["moment"], 1e-8)

    def test_agree(self):
        for scene, settings, n_processes in TABLE:
            with self.subTest(scene=scene, settings=settings, processes=n_processes):
                reduced = self.results(1, scene, (*settings, "Solver/Path=reduced"))
                primal = self.results(n_processes, scene, (*settings, "Solver/Path=primal"))
                self.check_rows(reduced[0], primal[0])
                self.check_forces(reduced[1], primal[1])


if __name__ == "__main__":
    unittest.main()
