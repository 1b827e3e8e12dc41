# SPDX-License-Identifier: LGPL-2.1-or-later
"""ends.py HPVI: a scene that names no limit is done below a relative error of 1e-3, and says so."""

import unittest

from runs import RunTest

PRESSED = {"Geometry/Subdivisions": "2, 2", "Boundary bottom/Contact": "bilateral", "Boundary bottom/Friction bound": "0.01",
           "Boundary top/Displacement": "0.03; -0.02"}
CUBE = {"Dimension": "3", "Boundary left/Displacement": "0; free; free", "Boundary front/Displacement": "free; free; 0",
        "Boundary bottom/Displacement": "free; 0; free", "Boundary top/Traction": "0; -0.01*(1 + 0.05*x^3); 0"}


class Ends(RunTest):
    def setUp(self):
        super().setUp()
        self.scene = self.written(PRESSED)

    def tolerance(self):
        lines = (self.out / "scene.prm").read_text().splitlines()
        return next(line.split("=")[1].strip() for line in lines if "set Tolerance  " in line
                    or "set Tolerance =" in line)

    def test_default(self):
        printed = self.run_scene()
        self.assertIn("\ndone: the error is below 1e-3, the default of Adaptivity/Tolerance\n", printed)
        rows = self.rows()
        bounds = [float(row["error_bound_relative"]) for row in rows]
        self.assertLess(bounds[-1], 1e-3)
        self.assertTrue(all(bound >= 1e-3 for bound in bounds[:-1]), bounds)
        self.assertEqual(self.summary()["stopped_by"], "Tolerance")
        self.assertEqual(self.tolerance(), "1e-3")

        scene = self.home / "again.prm"
        scene.write_bytes((self.out / "scene.prm").read_bytes())
        once = self.contents()
        self.assertIn("\nstopped by Adaptivity/Tolerance\n", self.run_scene(scene=scene))
        self.assertEqual(self.contents()["scene.prm"], once["scene.prm"])
        self.assertEqual([row["energy"] for row in self.rows()], [row["energy"] for row in rows])

    def test_named_limit(self):
        self.assertIn("\nstopped by Adaptivity/Maximum steps\n",
                      self.run_scene("Adaptivity/Maximum steps=2"))
        self.assertEqual(self.tolerance(), "0")

    def test_without_bound(self):
        printed = self.run_scene("Boundary bottom/Friction bound=",
                                 "Boundary bottom/Friction coefficient=0.3",
                                 "Boundary top/Displacement=0.003; -0.02")
        self.assertIn("\ndone: the error indicator is below 1e-3, the default of "
                      "Adaptivity/Tolerance\n", printed)
        line = "Adaptivity/Tolerance was compared with the indicator in its place, which guarantees nothing"
        self.assertEqual(printed.splitlines().count(line), 1)
        self.assertEqual([line for line in printed.splitlines() if line.startswith("warning: ") and "olerance" in line], [])
        self.assertLess(float(self.rows()[-1]["estimate_relative"]), 1e-3)

    def test_how_the_coupling_is_known(self):
        law = ("Boundary bottom/Contact=unilateral", "Boundary bottom/Friction bound=", "Boundary bottom/Friction coefficient=0.3",
               "Boundary top/Displacement=0.03; -0.02", "Adaptivity/Maximum steps=2")
        for settings, known in (((), "estimated"),
                                (("Error/Coupling=localised",), "finite part computed"),
                                (("Error/Coupling=localised", "Boundary left/Spring=1; 1"), "estimated, since there are springs")):
            printed = self.run_scene(*law, *settings)
            self.assertEqual(printed.count(f" ({known}; it must be below 2)"), 1, printed)
            self.assertEqual(self.summary()["coupling_known"], known)

    def last_step(self, *settings, known=(-1,)):
        """Rows with the bound of the last step beside those with the bound of each, marked alike: the same but for it."""
        self.run_scene("Adaptivity/Indicator=residual", *settings)
        each, reason = self.rows(), self.summary()["stopped_by"]
        printed = self.run_scene("Error/Bound=last step", *settings)
        rows = self.rows()
        self.assertEqual([row["energy"] for row in rows], [row["energy"] for row in each])
        self.assertEqual(self.summary()["stopped_by"], reason)
        found = [k for k, row in enumerate(rows) if row["error_bound"]]
        self.assertEqual(found, sorted({k % len(rows) for k in known}), [row["error_bound_relative"] for row in each])
        for k in found:
            for column, value in each[k].items():
                if (column.endswith("_bound") and column != "seconds_bound") or column in ("error_bound_relative", "energy_low", "energy_high"):
                    self.assertAlmostEqual(float(rows[k][column]) / float(value), 1, delta=1e-9, msg=column)
        for row in rows[:found[0]]:
            self.assertEqual([row[column] for column in row if "bound" in column and column != "seconds_bound"],
                             [""] * sum("bound" in column and column != "seconds_bound" for column in row))
        return rows, printed

    def test_bound_of_the_last_step(self):
        rows, printed = self.last_step("Adaptivity/Maximum steps=6")
        self.assertIn("  set Indicator              = residual\n", (self.out / "scene.prm").read_text())
        self.assertEqual(sum(line.split()[6:7] == ["-"] for line in printed.splitlines()), 5, printed)
        self.assertEqual(self.summary()["last_error_bound"], self.summary()["error_bound"])
        self.run_scene("Adaptivity/Indicator=residual", "Error/Bound=false", "Adaptivity/Maximum steps=6")
        self.assertEqual([row["energy"] for row in self.rows()], [row["energy"] for row in rows])

    def test_bound_where_the_tolerance_is_near(self):
        rows, _ = self.last_step(known=(0, -2, -1))
        self.assertLess(float(rows[-1]["error_bound_relative"]), 1e-3)
        rows, _ = self.last_step("Adaptivity/Tolerance on=friction_resultant", "Adaptivity/Tolerance=0.02", known=(0, -2, -1))
        self.assertLess(float(rows[-1]["friction_resultant_bound"]), 0.02 * abs(float(rows[-1]["friction_resultant"])))
        self.last_step("Adaptivity/Tolerance on=residual", "Adaptivity/Tolerance=0.01")

    def test_bound_of_the_last_step_of_load_steps(self):
        self.run_scene("Loading/Steps=2", "Boundary top/Displacement=0.03*t; -0.02*t", "Adaptivity/Maximum steps=3",
                       "Error/Bound=last step")
        self.assertEqual([bool(row["error_bound"]) for row in self.rows()][:3], [False, False, True])
        later = self.rows()[3:]
        self.assertEqual([row["bound_kind"] for row in later], [""] * (len(later) - 1) + ["history"])
        self.assertEqual([self.summary()["error_bound"][key] for key in ("kind", "guaranteed", "energy")], ["history", False, None])

    def test_in_space(self):
        printed = self.run_scene(scene=self.written(CUBE))
        self.assertIn("\ndone: the error indicator is below 1e-3, the default of "
                      "Adaptivity/Tolerance\n", printed)
        self.assertNotIn("warning", printed)
        self.assertLess(float(self.rows()[-1]["estimate_relative"]), 1e-3)
        self.assertEqual(self.tolerance(), "1e-3")


if __name__ == "__main__":
    unittest.main()
