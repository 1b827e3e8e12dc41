# SPDX-License-Identifier: LGPL-2.1-or-later
"""loading.py HPVI: the files of load histories, by value."""

import csv
import json
import re
import unittest
import xml.etree.ElementTree as ElementTree

from runs import RunTest, result_names

# A block of height 1 in pure shear under tau = mu U as long as it sticks, mu = 0.5, g = 0.1.
# U = 0.2, 0.4, 0.2, 0: sticks, slips by 0.2, sticks, sticks up to the bound.
TAU = (0.1, 0.1, 0., -0.1)
SLIP = (0., 0.2, 0., 0.)
TAU_OF_T = "if(t < 0.6, 0.1, if(t < 0.8, 0, -0.1))"
BLOCK = {"Geometry/Upper corner": "2, 1", "Geometry/Subdivisions": "2, 1", "Material/Young's modulus": "1", "Material/Poisson's ratio": "0",
         "Boundary top/Displacement": "if(t < 0.6, 0.8*t, 0.8 - 0.8*t); 0", "Boundary left/Traction": f"0; -1*{TAU_OF_T}",
         "Boundary right/Traction": f"0; {TAU_OF_T}", "Boundary bottom/Contact": "bilateral", "Boundary bottom/Friction bound": "0.1",
         "Loading/Steps": "4", "Adaptivity/Method": "hup2", "Adaptivity/Maximum steps": "2"}


class Loading(RunTest):
    def setUp(self):
        super().setUp()
        self.scene = self.written(BLOCK)

    def test_tables(self):
        self.run_scene()
        rows, steps = self.rows("loading.csv"), self.rows()
        self.assertEqual([row["load_step"] for row in rows], ["1", "2", "3", "4"])
        dissipated = 0.
        for k, row in enumerate(rows):
            dissipated += 2 * abs(TAU[k]) * SLIP[k]
            expected = {"t": (k + 1) / 4, "dissipated_energy": dissipated,
                        "stored_energy": 2 * TAU[k] ** 2 / 2 / 0.5,
                        "work": dissipated + 2 * TAU[k] ** 2 / 2 / 0.5,
                        "force_bottom_x": -2 * TAU[k], "force_top_x": 2 * TAU[k],
                        "force_bottom_y": 0., "force_loads_y": 0., "open_bottom": 0.}
            for name, value in expected.items():
                self.assertAlmostEqual(float(row[name]), value, 10, name)
            self.assertAlmostEqual(float(row["slip_bottom"]) + float(row["stick_bottom"]), 2.)
            self.assertNotEqual(row["stopped_by"], "")
            last = next(s for s in reversed(steps) if s["load_step"] == row["load_step"])
            self.assertEqual((row["step"], row["t"]), (last["step"], last["t"]))
            for point in self.rows(f"contact-{int(row['step']):02}.csv"):
                self.assertAlmostEqual(float(point["slip"]), SLIP[k])
                self.assertAlmostEqual(float(point["tangential_displacement"]), sum(SLIP[:k + 1]))
        self.assertEqual([int(s["step"]) for s in steps], list(range(1, len(steps) + 1)))
        seconds = [float(s["seconds"]) for s in steps]
        self.assertEqual(seconds, sorted(seconds))
        summary = self.summary()["loading"]
        self.assertEqual((summary["load_steps"], summary["finished"], summary["t"]), (4, 4, 1))
        self.assertEqual(str(summary["dissipated_energy"]), rows[-1]["dissipated_energy"])
        expected = {*result_names(len(steps)), "loading.csv", "contact-history.csv"}
        self.assertEqual(self.names(), sorted(expected))

    def test_collection_runs_over_load_steps(self):
        self.run_scene()
        sets = ElementTree.parse(self.out / "solution.pvd").getroot().findall("./Collection/*")
        self.assertEqual([(float(s.get("timestep")), s.get("file")) for s in sets],
                         [(float(row["t"]), f"solution-{int(row['step']):02}.vtu")
                          for row in self.rows("loading.csv")])

    def test_of_each_load_step_the_last_step_may_be_kept_alone(self):
        self.run_scene("Output/Steps=last", "Adaptivity/Method=hap2", "Boundary bottom/Friction bound=0.1*(1+0.2*x)")
        kept = [int(row["step"]) for row in self.rows("loading.csv")]
        self.assertGreater(len(self.rows()), len(kept))
        for name, suffix in (("contact", "csv"), ("contact", "vtu"), ("solution", "vtu")):
            self.assertEqual(sorted(self.out.glob(f"{name}-[0-9]*.{suffix}")),
                             [self.out / f"{name}-{step:02}.{suffix}" for step in kept])
        self.assertEqual(self.files(), self.names())
        sets = ElementTree.parse(self.out / "solution.pvd").getroot().findall("./Collection/*")
        self.assertEqual([s.get("file") for s in sets], [f"solution-{step:02}.vtu" for step in kept])

    def test_effective_parameters_are_the_same_run(self):
        self.run_scene()
        once = self.contents()
        self.scene = self.home / "again.prm"
        self.scene.write_bytes(once["scene.prm"])
        self.run_scene(output=self.home / "again")
        again = {p.name: p.read_bytes() for p in (self.home / "again").iterdir()}
        for name in ("scene.prm", "loading.csv", "degrees.csv", "contact-04.csv"):
            self.assertEqual(once[name], again[name], name)

    def test_without_history_nothing_of_it_remains(self):
        self.run_scene()
        self.scene.write_text(self.scene.read_text().replace("set Steps = 4", "")
                              .replace(TAU_OF_T, "0.1")
                              .replace("if(t < 0.6, 0.8*t, 0.8 - 0.8*t)", "0.2"))
        self.run_scene()
        self.assertEqual(self.names(), result_names(len(self.rows())))
        self.assertNotIn("t", self.rows()[0])
        self.assertNotIn("load_step", self.rows()[0])
        self.assertNotIn("slip", self.rows("contact-01.csv")[0])
        self.assertIsNone(self.summary()["loading"])

    def test_finished_load_steps_stay(self):
        # In the third load step the prescribed displacements pass the plane between tried points.
        line = self.run_scene("Boundary top/Traction=0; 0", "Boundary top/Displacement=free; free",
                              "Boundary left/Traction=0;0", "Boundary right/Traction=0.3*t; 0",
                              status=2)
        self.assertRegex(line, r"load step 3, t = 0\.75: no equilibrium")
        self.assertEqual([row["t"] for row in self.rows("loading.csv")], ["0.25", "0.5"])
        self.assertEqual(self.summary()["status"], "failed")
        self.assertEqual(self.summary()["loading"]["finished"], 2)


COULOMB, TRESCA, FADING = ("Friction coefficient", "0.3"), ("Friction bound", "3"), ("Friction bound", "3*sin(pi*t)")
KINDS = [("bilateral", COULOMB), ("bilateral", TRESCA), ("bilateral", FADING),
         ("unilateral", COULOMB), ("unilateral", TRESCA), ("unilateral", FADING)]
HELD = ("Displacement", "0.001*sin(2*pi*t); -0.002*sin(pi*t)")
PUSHED = ("Traction", "1*sin(2*pi*t); -10*sin(pi*t)")
# contact, friction, the boundary of the load and the load, load steps
RETURNS = [("bilateral", COULOMB, "top", ("Displacement", "0.03*(1-t); 0"), 2),
           ("tangential", TRESCA, "top", HELD, 4),
           ("unilateral", COULOMB, "right",
            ("Displacement", "0; if(t < 0.9, 0.001*t, 0.001*sin(2*pi*t))"), 4)]
RETURNS += [(*kind, "top", load, steps) for kind in KINDS
            for load, steps in ((HELD, 4), (PUSHED, 4), (PUSHED, 3))]


class ReturnToZero(RunTest):
    """Histories whose data at the end are the round-off of zero."""

    def run_history(self, contact, friction, side, load, steps):
        self.scene = self.written({"Material/Young's modulus": "1000", "Boundary bottom/Contact": contact,
                                   f"Boundary bottom/{friction[0]}": friction[1], f"Boundary {side}/{load[0]}": load[1],
                                   "Loading/Steps": steps, "Adaptivity/Maximum steps": "3"})
        return self.run_scene("Output/VTU=false")

    def test_what_is_left_is_zero_or_locked_in(self):
        for case in RETURNS:
            with self.subTest(case=case):
                printed = self.run_history(*case)
                last = self.rows("loading.csv")[-1]
                # Friction that keeps its bound keeps a stress; that of Coulomb leaves with the pressure.
                if case[1] != TRESCA:
                    self.assertEqual(last["stopped_by"], "round-off")
                    self.assertEqual(len([s for s in self.rows() if s["load_step"] == str(case[4])]),
                                     1)
                    for name in ("force_bottom_x", "force_bottom_y", "force_loads_x"):
                        self.assertLess(abs(float(last[name])), 1e-9, name)
                    for words in ("|lambda|", "pulls", "round-off reaches", "rose from"):
                        self.assertNotRegex(printed,
                                            re.escape(words) + rf".*\(load step {case[4]},")
                balance = self.summary()["balance"]
                self.assertLess(max(balance["force"], balance["moment"]), 1e-8)

    def test_round_off_of_one_load_pushes_nothing(self):
        for friction in (("Friction bound", "0"), COULOMB):
            with self.subTest(friction=friction):
                self.run_history("unilateral", friction, "top", ("Traction", "5*sin(2*pi); -100"), 1)
                force = self.summary()["forces"]["bottom"]["force"]
                self.assertAlmostEqual(force[1], 100., 9)
                self.assertLess(abs(force[0]), 1e-9)


if __name__ == "__main__":
    unittest.main()
