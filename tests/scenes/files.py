# SPDX-License-Identifier: LGPL-2.1-or-later
"""files.py HPVI: the numbers in tables, VTU files, mesh pictures, summary.json and on standard
output, against closed forms and against each other."""

import collections
import math
import signal
import subprocess
import unittest

from runs import PROGRAM, SCENES, RunTest, read_vtu, size_limit

STEPS = 4


class Uniaxial(RunTest):
    """sigma_xx = 3: deviator, Hooke's law and displacement in closed form."""

    def run_bar(self, *settings):
        self.run_scene(*settings, scene=self.bar())
        return read_vtu(self.out / "solution-01.vtu")

    def check_field(self, field, expected):
        for value in field:
            self.assertLess(abs(value - expected), 1e-5)

    def test_stress_and_displacement(self):
        young, nu, tension = 10., 0.25, 3.
        for plane in ("stress", "strain"):
            grid = self.run_bar(f"Material/Plane={plane}")
            out_of_plane = nu * tension if plane == "strain" else 0.
            mises = math.sqrt(tension ** 2 - tension * out_of_plane + out_of_plane ** 2)
            self.check_field(grid["von_mises"], mises)
            self.check_field(grid["sigma_xx"], tension)
            self.check_field(grid["sigma_yy"], 0)
            self.check_field(grid["sigma_xy"], 0)
            axial = (tension - nu * out_of_plane) / young
            lateral = -nu * (tension + out_of_plane) / young
            self.assertEqual(len(grid["points"]), len(grid["displacement"]))
            for (x, y, _), (u_x, u_y, u_z) in zip(grid["points"], grid["displacement"]):
                self.assertLess(abs(u_x - axial * x), 1e-6)
                self.assertLess(abs(u_y - lateral * y), 1e-6)
                self.assertEqual(u_z, 0)

    def test_stress_across_fibres(self):
        """sigma_zz = E3 nu13/E1 sigma_1, or with axis 2 along the bar E3 nu23/E2 sigma_2."""
        for angle, across in ((0, 4 * 0.5 / 10 * 3), (90, 4 * 0.2 / 2 * 3)):
            grid = self.run_bar("Material/Young's modulus=", "Material/Poisson's ratio=", "Material/Elasticity=orthotropic",
                                "Material/Young's moduli=10, 2, 4", "Material/Poisson's ratios=0.25, 0.5, 0.2",
                                "Material/Shear moduli=1", f"Material/Angle={angle}", "Material/Plane=strain")
            self.check_field(grid["sigma_xx"], 3)
            self.check_field(grid["sigma_zz"], across)
            self.check_field(grid["von_mises"], math.sqrt(9 - 3 * across + across ** 2))

    def test_shear(self):
        grid = self.run_bar("Boundary left/Displacement=0.5*y; 0.2*x",
                            "Boundary right/Displacement=0.5*y; 0.2*x", "Boundary right/Traction=",
                            "Boundary bottom/Displacement=0.5*y; 0.2*x",
                            "Boundary top/Displacement=0.5*y; 0.2*x")
        sigma_xy = 10 / (2 * 1.25) * 0.7
        self.check_field(grid["sigma_xy"], sigma_xy)
        self.check_field(grid["von_mises"], math.sqrt(3) * sigma_xy)
        self.check_field(grid["sigma_xx"], 0)

    def test_degrees_of_uniform_methods(self):
        self.run_scene("Adaptivity/Method=hup3", "Geometry/Subdivisions=3, 2", scene=self.bar())
        self.assertEqual((self.out / "degrees.csv").read_text(),
                         "step,elements,p1,p2,p3\n1,6,0,0,6\n")
        self.run_scene("Adaptivity/Method=pu", "Adaptivity/Maximum steps=2")
        self.assertEqual((self.out / "degrees.csv").read_text(),
                         "step,elements,p1,p2,p3\n1,16,0,16,0\n2,16,0,0,16\n")


class Adaptive(RunTest):
    """Four steps of Example 5.2, whose files must tell the same story."""

    def setUp(self):
        super().setUp()
        self.printed = self.run_scene(f"Adaptivity/Maximum steps={STEPS}").splitlines()

    def test_everything(self):
        for step in range(1, STEPS + 1):
            row, degrees = self.rows()[step - 1], self.rows("degrees.csv")[step - 1]
            count = {int(name[1:]): int(degrees[name]) for name in degrees if name[0] == "p"}
            self.assertEqual(int(degrees["elements"]), int(row["elements"]))
            self.assertEqual(sum(count.values()), int(row["elements"]))
            used = [p for p, number in count.items() if number > 0]
            self.assertEqual([min(used), max(used)], [int(row["p_min"]), int(row["p_max"])])
            self.check_vtu(step, row, count)
        self.assertGreater(len(used), 1)
        self.check_summary()
        self.check_printed()

    def check_vtu(self, step, row, count):
        grid = read_vtu(self.out / f"solution-{step:02}.vtu")
        self.assertEqual(collections.Counter(grid["degree"]), {p: number for p, number in count.items() if number > 0})
        self.assertGreater(max(grid["contact_friction"]), 0)
        self.assertEqual(min(grid["contact_friction"]), 0)
        squares = math.fsum(eta ** 2 for eta in grid["estimate"])
        self.assertTrue(math.isclose(math.sqrt(squares), float(row["estimate"]), rel_tol=1e-5))

    def check_summary(self):
        summary, rows = self.summary(), self.rows()
        self.assertEqual([summary[name] for name in ("status", "stopped_by", "scene", "title",
                                                     "steps")],
                         ["done", "Maximum steps", "han-6-12",
                          "Example 5.2: square block pushed along a plane", STEPS])
        version = subprocess.run([PROGRAM, "--version"], capture_output=True, text=True,
                                 check=True).stdout
        self.assertEqual(version, f"{summary['program']} ({summary['build']} build), "
                                  f"deal.II {summary['deal.II']}\n")
        self.assertEqual(set(summary["final"]), set(rows[-1]))
        for name, value in summary["final"].items():
            written = rows[-1][name]
            if isinstance(value, str) or value is None:
                self.assertEqual(value or "", written)
            else:
                self.assertEqual(value, float(written))
        for stage, seconds in summary["seconds"].items():
            self.assertLess(abs(seconds - sum(float(row["seconds_" + stage]) for row in rows)),
                            1e-4 * seconds + 1e-12)
        self.assertIsNone(summary["message"])
        self.assertEqual(summary["error_bound"]["energy"],
                         [float(rows[-1][end]) for end in ("energy_low", "energy_high")])

    def check_printed(self):
        self.assertRegex(self.printed[0], r"^hpvi \S+ \(\w+ build\), deal.II \S+$")
        self.assertEqual(self.printed[1], self.summary()["title"])
        head = next(k for k, line in enumerate(self.printed) if line.startswith("step "))
        self.assertEqual(self.printed[head].split(),
                         "step elements dofs_free multipliers p indicator bound slack "
                         "qp_products seconds".split())
        for row, line in zip(self.rows(), self.printed[head + 1:]):
            words = line.split()
            self.assertEqual(words[:5], [row["step"], row["elements"], row["dofs_free"],
                                         row["multipliers"], f"{row['p_min']}-{row['p_max']}"])
            self.assertEqual(words[5:9], [f"{float(row['estimate_relative']):.1e}",
                                          f"{float(row['error_bound_relative']):.1e}",
                                          f"{float(row['slack']):.3e}", row["qp_multiplications"]])
            self.assertLess(abs(float(words[9]) - float(row["seconds"])), 0.0051)
        self.assertEqual(self.printed[head + 1 + STEPS], "")
        self.assertIn("stopped by Adaptivity/Maximum steps", self.printed)
        self.assertEqual(self.printed[-2:], [f"results in {self.out}", f"report: hpvi --report {self.out}"])
        for warning in self.summary()["warnings"]:
            self.assertIn("warning: " + warning, self.printed)


class Intervals(RunTest):
    def test_that_of_each_step_holds_the_least_energy(self):
        """Where u_N penetrates J(u_N) may be below the least energy; the interval is about another displacement."""
        for scene in ("han-6-12", "han-6-12-unilateral", "resting"):
            self.run_scene("Adaptivity/Maximum steps=6", scene=SCENES / f"{scene}.prm")
            ends = [(float(row["energy_low"]), float(row["energy_high"])) for row in self.rows()]
            self.assertEqual(len(ends), 6)
            low, high = max(low for low, _ in ends), min(high for _, high in ends)
            self.assertLessEqual(low, high, scene)
            self.assertLess(high - low, 0.02 * (ends[0][1] - ends[0][0]), scene)


class Summaries(RunTest):
    """summary.json can be read and has the same members whatever the outcome."""

    # Held all around with degree 1 nothing is free: the displacement is zero, the error is not.
    def still(self, force):
        return self.written({**{f"Boundary {side}/Displacement": "0; 0" for side in ("left", "right", "bottom", "top")},
                             "Body force/Expression": force})

    def check_members(self, status, *absent):
        summary = self.summary()
        self.assertEqual(list(summary), [*self.members, *["history_largest"] * (summary["loading"] is not None)])
        self.assertEqual(summary["status"], status)
        of_coulomb = {"error_estimate_equilibrated", "coupling", "zones_assumed", "coupling_known"}
        self.assertEqual([name for name in summary if summary[name] is None and name not in of_coulomb], list(absent))
        self.assertEqual(summary["error_estimate_equilibrated"] is None, summary["error_bound"] is None)
        self.assertIsNone(summary["coupling"] or summary["zones_assumed"])

    def setUp(self):
        super().setUp()
        self.run_scene("Adaptivity/Maximum steps=1", scene=self.bar())
        self.members = self.summary()

    def test_done(self):
        self.check_members("done", "message", "normal_contact", "linear", "loading", "no_error_bound", "no_intervals")
        self.run_scene("Loading/Steps=2", "Error/Bound=false", "Adaptivity/Maximum steps=1",
                       scene=self.bar())
        self.check_members("done", "message", "normal_contact", "linear", "error_bound", "last_error_bound")

    def test_a_displacement_of_zero(self):
        for _ in range(2):  # the second run knows the files of the first
            self.run_scene("Adaptivity/Start degree=1", "Adaptivity/Maximum steps=1",
                           scene=self.still("1; 0"))
            self.check_members("done", "message", "normal_contact", "linear", "loading", "error_bound", "last_error_bound")
            self.assertIsNone(self.summary()["final"]["estimate_relative"])
        self.run_scene(scene=self.still("0; 0"))
        self.check_members("done", "message", "normal_contact", "linear", "loading", "no_error_bound")

    def test_a_missing_bound_is_explained(self):
        """Far from its support a beam hardly strains: what it does is lost in cells that are small."""
        beam = {"Geometry/Upper corner": "20, 1", "Geometry/Subdivisions": "20, 1", "Geometry/Graded towards": "20, 0",
                "Geometry/Grading levels": "25", "Boundary left/Displacement": "0; 0", "Boundary top/Traction": "0; -1"}
        printed = self.run_scene("Adaptivity/Maximum steps=1", scene=self.written(beam))
        summary, row = self.summary(), self.rows()[0]
        self.assertIsNone(summary["error_bound"])
        self.assertGreater(float(row["bound_imbalance"]), 1e-9)
        self.assertEqual(summary["final"]["bound_imbalance"], float(row["bound_imbalance"]))
        self.assertIn(f"{float(row['bound_imbalance']):.2g} of their stresses", summary["no_error_bound"])
        self.assertIn(f"no bound of the error in step 1: {summary['no_error_bound']}", printed.splitlines())
        self.assertIsNone(summary["last_error_bound"])

    def test_words_are_no_numbers(self):
        self.run_scene("Boundary bottom/Friction bound=", "Boundary bottom/Friction coefficient=0.3",
                       "Boundary bottom/Contact=unilateral", "Adaptivity/Maximum steps=1")
        self.assertEqual(self.summary()["final"]["coulomb_method"], "newton")
        self.assertEqual(self.rows()[0]["coulomb_method"], "newton")

    def test_failed(self):
        self.run_scene(status=2, preexec_fn=size_limit(6000))
        self.check_members("failed", "stopped_by", "normal_contact", "linear", "loads", "final", "loading",
                           "error_bound", "no_error_bound", "last_error_bound", "forces", "balance",
                           "contact", "von_mises", "largest_displacement", "no_intervals")

    def test_running_and_interrupted(self):
        run = self.stopped("Adaptivity/Maximum steps=99", rows=2)
        early = ("normal_contact", "linear", "loading", "error_bound", "no_error_bound", "forces", "balance", "contact",
                 "von_mises", "largest_displacement", "no_intervals")
        self.check_members("running", "stopped_by", "message", *early)
        run.send_signal(signal.SIGTERM)
        run.send_signal(signal.SIGCONT)
        run.communicate(timeout=120)
        self.check_members("interrupted", "stopped_by", *early)


if __name__ == "__main__":
    unittest.main()
