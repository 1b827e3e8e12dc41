#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""loads.py HPVI: the resultant of all loads is printed before the first step and kept, narrow loads are in it, and what the
primal path does not resolve is warned of."""

import unittest

from runs import RunTest

STRIP = {"Geometry/Upper corner": "100, 20", "Geometry/Subdivisions": "4, 1", "Material/Young's modulus": "1000",
         "Material/Poisson's ratio": "0.3", "Boundary bottom/Contact": "bilateral", "Boundary bottom/Friction bound": "0.5",
         "Boundary top/Traction": "0; -1 - 50*(abs(x-40)<1)", "Adaptivity/Maximum steps": "1"}
BOX = {"Dimension": "3", "Geometry/Upper corner": "2, 2, 1", "Geometry/Subdivisions": "1, 1, 1", "Material/Young's modulus": "10",
       "Material/Poisson's ratio": "0.3", "Boundary bottom/Displacement": "0; 0; 0",
       "Boundary top/Traction": "0; 0; -100*(abs(x-1.2)<0.1)*(abs(z-0.4)<0.1)", "Adaptivity/Method": "hup2",
       "Adaptivity/Maximum steps": "1"}
RING = {"Geometry/Shape": "ring sector", "Boundary inner/Pressure": "1 + x", "Boundary start/Symmetry": "true",
        "Boundary end/Symmetry": "true", "Body force/Expression": "x; y^2", "Adaptivity/Method": "pu", "Adaptivity/Maximum steps": "4"}


class Loads(RunTest):
    def run_settings(self, settings, *more):
        return self.run_scene(*more, scene=self.written(settings)).splitlines()

    def test_stand_before_the_first_step(self):
        printed = self.run_settings(STRIP)
        line = "loads: force (0 -200), moment 1000 about (50 10)"
        head = next(k for k, text in enumerate(printed) if text.startswith("step "))
        self.assertIn(line, printed[:head])
        loads, summary = self.summary()["loads"], self.summary()
        self.assertAlmostEqual(loads["force"][1], -200, places=9)
        self.assertAlmostEqual(loads["moment"], 1000, places=8)
        self.assertEqual(loads["about"], [50, 10])
        self.assertAlmostEqual(summary["forces"]["loads"]["force"][1], -200, places=9)
        self.assertTrue(summary["error_bound"]["guaranteed"])
        self.assertEqual(summary["warnings"], [w for w in summary["warnings"] if "resolved" not in w])

    def test_in_a_history_are_those_of_the_first_load_step(self):
        printed = self.run_settings(STRIP, "Loading/Steps=2", "Boundary top/Traction=0; -t")
        self.assertIn("with t = 0.5, loads: force (0 -50), moment 0 about (50 10)", printed)
        self.assertAlmostEqual(self.summary()["loads"]["force"][1], -100, places=9)

    def test_on_curves_balance_supports_in_each_step(self):
        self.run_settings(RING)
        rows = self.rows("forces.csv")
        for step in {row["step"] for row in rows}:
            own = [row for row in rows if row["step"] == step]
            self.assertEqual([row["name"] for row in own if row["kind"] == "load"], ["inner", "body force"])
            for force in ("Fx", "Fy", "M"):
                self.assertAlmostEqual(sum(float(row[force]) for row in own), 0, places=11)
        body = [float(row["Fx"]) for row in rows if row["name"] == "body force"]
        self.assertAlmostEqual(body[-1], 7 / 3, places=6)  # int x over the sector

    def test_in_space_are_compared(self):
        printed = self.run_settings(BOX)
        self.assertTrue(any(line.startswith("loads: force (0 0 -") for line in printed), printed)
        warning = next(w for w in self.summary()["warnings"] if "resolved" in w)
        self.assertTrue(warning.startswith("Traction on top is not resolved near (1 2 0.5)"), warning)
        self.run_settings(BOX, "Boundary top/Traction=0; 0; x*z - 3")
        self.assertFalse([w for w in self.summary()["warnings"] if "resolved" in w])


if __name__ == "__main__":
    unittest.main()
