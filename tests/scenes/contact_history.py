#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""contact_history.py HPVI: what load steps do to the points of a contact together, and cycles, against what anybody can compute."""

import unittest

from runs import RunTest, read_vtu

# A block of 2 x 1 with E = 10 and nu = 0 whose stress is uniform: one cell of degree 2 is exact, up to the side tractions that shear asks for.
BLOCK = {"Geometry/Upper corner": "2, 1", "Geometry/Subdivisions": "2, 1", "Material/Young's modulus": "10", "Material/Poisson's ratio": "0",
         "Material/Plane": "stress", "Adaptivity/Method": "hup2", "Adaptivity/Maximum steps": "1", "Loading/Steps": "4"}
# Friction of 0.5 at the bottom moves on what the top is moved, to and fro: slip is 0.4, 0.1, -0.4, -0.1 and, from then on, comes back to these.
SAWED = {**BLOCK, "Boundary top/Displacement": "0.5*sin(2*pi*t); free", "Boundary top/Traction": "0; -1", "Boundary bottom/Contact": "bilateral",
         "Boundary bottom/Friction bound": "0.5", "Boundary bottom/Wear coefficient": "0.001", "Loading/Until steady": "0.01",
         **{f"Boundary {side}/Traction": f"0; {sign}*if(abs(t - 0.625) < 0.3, -0.5, 0.5)" for side, sign in (("left", -1), ("right", 1))}}


class ContactHistory(RunTest):
    def run_settings(self, settings, **options):
        return self.run_scene(scene=self.written(settings), **options)

    def expect(self, row, **values):
        for name, value in values.items():
            self.assertAlmostEqual(float(row[name]), value, delta=1e-10, msg=name)

    def test_a_block_that_lifts_off_and_slides(self):
        """Open in the first of four load steps, then pressed by 0.5, 1.25 and 2 while it slides by a quarter, without friction."""
        self.run_settings({**BLOCK, "Boundary top/Displacement": "t; 0.1 - 0.3*t", "Boundary bottom/Contact": "unilateral",
                           "Boundary bottom/Wear coefficient": "0.001"})
        rows = self.rows("contact-history.csv")
        self.assertEqual([row["boundary"] for row in rows], ["bottom"] * len(rows))
        self.assertEqual([row["x"] for row in rows], [row["x"] for row in self.rows("contact-04.csv")])
        for row in rows:
            self.expect(row, y=0, pressure_max=2, shear_max=0, slip_range=0.75, slip_path=0.75, dissipated=0, time_open=0.25, ruiz_1=0, ruiz_2=0,
                        wear_depth=0.001 * 0.25 * (0.5 + 1.25 + 2))
        largest = self.summary()["history_largest"]
        self.assertEqual({name: (one["load_step"], one["boundary"]) for name, one in largest.items()},
                         {"pressure": (4, "bottom"), "von_mises": (4, None), "opening": (1, "bottom")})
        for name, value in (("pressure", 2), ("von_mises", 2), ("opening", 0.025)):
            self.assertAlmostEqual(largest[name]["value"], value, delta=1e-10, msg=name)
        arrays = read_vtu(self.out / "contact-04.vtu")
        self.assertEqual([float(row["slip_path"]) for row in rows], list(arrays["slip_path"]))
        self.assertIn("wear_depth", arrays)

    def test_ruiz_of_a_stretched_block(self):
        """u_x = t (0.3 + 0.02 x + 0.5 y/5): stress 0.2 t along the surface, friction 0.5 t against the slip of 0.3 + 0.02 x."""
        moved = "t*(0.3 + 0.02*x + 0.1)"
        self.run_settings({**BLOCK, "Loading/Steps": "2", "Boundary top/Displacement": f"{moved}; free", "Boundary top/Traction": "0; -t",
                           "Boundary bottom/Contact": "bilateral", "Boundary bottom/Friction bound": "0.5*t",
                           "Boundary left/Traction": "-0.2*t; -0.5*t", "Boundary right/Traction": "0.2*t; 0.5*t"})
        for row in self.rows("contact-history.csv"):
            slip = 0.3 + 0.02 * float(row["x"])
            self.expect(row, pressure_max=1, shear_max=0.5, slip_range=slip, slip_path=slip, dissipated=0.75 * 0.5 * slip, time_open=0,
                        ruiz_1=0.5 * slip, ruiz_2=0.2 * 0.5 * slip)
            self.assertEqual(row["wear_depth"], "")

    def test_cycles_until_they_are_steady(self):
        """The first takes 1.5, from rest, all others 1.6."""
        self.run_settings(SAWED)
        cycles = self.rows("cycles.csv")
        self.assertEqual([(row["cycle"], row["load_step"]) for row in cycles], [("1", "4"), ("2", "8"), ("3", "12")])
        for row, energy in zip(cycles, (1.5, 1.6, 1.6)):
            self.expect(row, dissipated_energy=energy)
        self.assertEqual(cycles[0]["change"], "")
        self.expect(cycles[1], change=1 - 1.5 / 1.6)
        self.expect(cycles[2], change=0)
        for row in self.rows("contact-history.csv"):
            self.expect(row, slip_path=4.7, slip_range=0.8, dissipated=0.5 * 4.7, wear_depth=0.0047)
        steps = self.rows("loading.csv")
        self.assertEqual([(row["cycle"], row["t"]) for row in steps], [(str(k // 4 + 1), ("0.25", "0.5", "0.75", "1")[k % 4]) for k in range(12)])
        self.assertEqual(self.summary()["loading"]["cycle"], 3)
        self.assertNotIn("in the last cycle", " ".join(self.summary()["warnings"]))
        self.assertIn('timestep="2.25"', (self.out / "contact.pvd").read_text())

    def test_contact_that_shakes_down(self):
        """Friction of 0.5 is 5 times 0.1 of shear: the top comes to 0.28, so the bottom slips by 0.18, and no more."""
        shear = "5*(0.02 + 0.08*sin(2*pi*t))"
        self.run_settings({**SAWED, "Boundary top/Displacement": "0.2 + 0.08*sin(2*pi*t); free",
                           "Boundary left/Traction": f"0; -{shear}", "Boundary right/Traction": f"0; {shear}"})
        cycles = self.rows("cycles.csv")
        self.assertEqual(len(cycles), 2)
        self.expect(cycles[0], dissipated_energy=2 * 0.5 * 0.18)
        self.expect(cycles[1], dissipated_energy=0)
        self.assertNotIn("in the last cycle", " ".join(self.summary()["warnings"]))

    def test_a_ratchet_reaches_its_steady_cycle(self):
        """Each foot holds in one half of the cycle, and slides under 0.02 in the other: a force of 0.1 drives the block on. In the steady
        cycle all of it has moved by one length l, by the work 0.1 l, of which 0.02 l is dissipated below each foot, 1 long."""
        self.run_settings({**BLOCK, "Geometry/Subdivisions": "4, 2", "Adaptivity/Method": "hup3", "Loading/Steps": "2",
                           "Loading/Until steady": "1e-8", "Loading/Maximum cycles": "100", "Boundary top/Traction": "0.05; 0",
                           "Boundary bottom/Contact": "bilateral",
                           "Boundary bottom/Friction bound": "if((x < 1) == (t < 0.7), 1, 0.02)"})
        cycles = self.rows("cycles.csv")
        self.assertGreater(len(cycles), 3)
        self.assertLess(len(cycles), 100)
        last = 2 * len(cycles)
        before, after = ([float(row["tangential_displacement"]) for row in self.rows(f"contact-{step:02d}.csv")] for step in (last - 2, last))
        lengths = [b - a for a, b in zip(before, after)]
        length, tolerance = lengths[0], 1e-7 * lengths[0]  # what is left falls with the cycles, as dissipation, which has reached 1e-8
        self.assertGreater(length, 0.001)
        for one in lengths:
            self.assertAlmostEqual(one, length, delta=tolerance)
        self.assertAlmostEqual(float(cycles[-1]["work"]), 0.1 * length, delta=tolerance)
        self.assertAlmostEqual(float(cycles[-1]["dissipated_energy"]), 0.04 * length, delta=tolerance)

    def test_cycles_that_are_too_few(self):
        self.run_settings({**SAWED, "Loading/Maximum cycles": "2"})
        self.assertEqual(len(self.rows("cycles.csv")), 2)
        self.assertEqual(len([line for line in self.summary()["warnings"] if "in the last cycle differs by 6.25 % from" in line]), 1)

    def test_what_has_no_history_or_no_slip_does_not_wear(self):
        for settings, words in (({**SAWED, "Loading/Steps": None, "Loading/Until steady": None, "Boundary top/Displacement": "0.5; free",
                                  "Boundary left/Traction": None, "Boundary right/Traction": None}, "set Loading/Steps"),
                                ({**SAWED, "Boundary top/Wear coefficient": "1"}, "nothing does here"),
                                ({**SAWED, "Loading/Until steady": None, "Loading/Maximum cycles": "3"}, "set Until steady"),
                                ({**SAWED, "Loading/Steps": None}, "no load step to repeat"),
                                ({**SAWED, "Loading/Until steady": "0.6"}, "a share from 1e-12 to 0.5")):
            self.assertIn(words, self.run_settings(settings, status=1))


if __name__ == "__main__":
    unittest.main()
