# SPDX-License-Identifier: LGPL-2.1-or-later
"""benchmarks.py HPVI DIR: hpvi.benchmarks is a table that others can compare with; its formulae have the values that other formulae and sums have, the fields of
doc/benchmarks/closed_forms.py are in equilibrium; each scene of prm/published is valid and has rows; doc/benchmarks has what doc/published.py makes of its runs; and
two cases are solved, whose rows say what they said."""
import csv
import json
import math
import pathlib
import sys
import tempfile
import unittest

import numpy as np

PROGRAM, MODULE = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(2))
sys.path.insert(0, str(MODULE))
import hpvi  # noqa: E402
import hpvi.benchmarks as benchmarks  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENES, TABLES = ROOT / "prm/published", ROOT / "doc/benchmarks"
sys.path += [str(ROOT / "doc"), str(TABLES)]
import closed_forms  # noqa: E402
import closed_values  # noqa: E402
import receding_layer  # noqa: E402
import published  # noqa: E402


def rows():
    with (TABLES / "rows.csv").open(newline="") as file:
        return {row["name"]: row for row in csv.DictReader(file)}


def value(name):
    (found,) = [row["value"] for row in benchmarks.table() if row["name"] == name]
    return found


class Table(unittest.TestCase):
    def test_rows_are_complete(self):
        table = benchmarks.table()
        self.assertEqual(len({row["name"] for row in table}), len(table))
        self.assertGreaterEqual(len(table), 20)
        for row in table:
            self.assertEqual(set(row), {"name", "scene", "entries", "quantity", "unit", "value", "within", "kind", "equation", "source"})
            self.assertTrue((ROOT / row["scene"]).exists(), row["scene"])
            self.assertIn(row["kind"], ("printed", "closed form", "own"))
            self.assertTrue(math.isfinite(row["value"]) and row["within"] >= 0, row["name"])
            self.assertTrue(row["kind"] != "closed form" or row["equation"], row["name"])
        json.dumps(table)

    def test_values_are_those_of_their_formulae(self):
        for name, wanted in closed_values.VALUES.items():
            self.assertAlmostEqual(value(name) / wanted, 1, 13, name)

    def test_values_of_others_are_compared(self):
        found = benchmarks.compare({"hertz force": 7.7, "ssnv128 u1": 28.63, "hertz p0": (7.01, 0.02)})
        self.assertEqual([one["agrees"] for one in found], [False, True, True])  # 28.6 is printed
        self.assertAlmostEqual(found[0]["relative"], (7.7 - 7.696902001295) / 7.696902001295, 10)
        with self.assertRaisesRegex(KeyError, "hertz farce"):
            benchmarks.compare({"hertz farce": 1})

    def test_scenes_are_valid_and_have_rows(self):
        named = {row["scene"] for row in benchmarks.table()} | {f"prm/published/{twin}.prm" for twin in benchmarks.TWINS.values() if isinstance(twin, str)}
        for path in sorted(SCENES.glob("*.prm")):
            self.assertIn(str(path.relative_to(ROOT)), named)
            self.assertIn("material", hpvi.Scene(str(path)).describe())
        for scene, entries in [(row["scene"], row["entries"]) for row in benchmarks.table() if row["entries"]] + \
                [(f"prm/published/{name}.prm", entries) for name, entries in benchmarks.TWINS.items() if isinstance(entries, dict)]:
            hpvi.Scene(str(ROOT / scene), entries).describe()


class Formulae(unittest.TestCase):
    def integral(self, f, a, b, n=20000):
        """By the midpoint rule in t, x = a + (b - a) sin^2 t, which is smooth where f has roots at the ends."""
        total, step = 0.0, math.pi / 2 / n
        for k in range(n):
            t = (k + 0.5) * step
            total += f(a + (b - a) * math.sin(t) ** 2) * 2 * math.sin(t) * math.cos(t)
        return total * (b - a) * step

    def test_forces_are_integrals_of_pressures(self):
        self.assertAlmostEqual(value("hertz force"), self.integral(lambda x: 14 * math.sqrt(1 - (x / 0.7) ** 2), 0, 0.7), 7)
        self.assertAlmostEqual(value("hertz-axi force"), self.integral(lambda x: 20 * math.pi * x * math.sqrt(1 - x * x), 0, 1), 7)
        self.assertAlmostEqual(value("punch-axi force"), self.integral(lambda x: 2 * math.pi * x / math.sqrt(1 - x * x), 0, 1), 6)
        self.assertAlmostEqual(value("punch-plane force"), self.integral(lambda x: 10 / math.pi / math.sqrt(1 - x * x), 0, 1), 6)
        friction = self.integral(lambda x: 4.2 * math.sqrt(1 - (x / 0.7) ** 2), 0, 0.7) - self.integral(lambda x: 2.4 * math.sqrt(1 - (x / 0.4) ** 2), 0, 0.4)
        self.assertAlmostEqual(value("partial-slip friction"), friction, 7)

    def test_the_glued_punch_bears_its_load(self):
        self.assertAlmostEqual(closed_values.bonded_inner_force(0.3, 1 - 1e-12, 20000), 1, 5)
        self.assertAlmostEqual(closed_values.bonded_inner_force(0.4999999, 0.5), 2 * math.asin(0.5) / math.pi, 6)  # without friction at nu = 1/2

    def test_spheres_and_cylinders_as_printed(self):
        pressure, radius, force = closed_values.hertz_spheres(20000, 0.3, 50, 4)
        self.assertAlmostEqual(pressure, 2798.33, 2)
        self.assertAlmostEqual(radius, 10, 12)
        self.assertAlmostEqual(force, 586080.6, 1)
        self.assertAlmostEqual(force, 2 * math.pi * radius ** 2 * pressure / 3, 6)
        self.assertAlmostEqual(closed_values.roller(210000, 70000, 0.3, 50, 35000)[1], 3585.37, 1)
        for found, printed in zip(map(lambda f: closed_values.wedge(0.1, f), (0, 0.1, 0.2, 0.3)), (0.1, 0.202020, 0.306122, 0.412371)):
            self.assertAlmostEqual(found, printed, 6)

    def test_press_fits_by_two_equations(self):
        """u = A r + B/r: displacement and stress at both ends."""
        E, nu, a, b = 210000, 0.3, 20, 30
        p = closed_values.bush(E, nu, a, b, 0.03)
        B_over_A = a * a * (1 + nu) / (1 - nu)
        A = -0.03 / (b + B_over_A / b)
        self.assertAlmostEqual(-p, E / (1 - nu * nu) * ((1 + nu) * A - (1 - nu) * A * B_over_A / b ** 2), 8)
        p = closed_values.cylinders(E, nu, 20, 40, 0.02)  # of the shaft and the hub
        plane = E / (1 - nu * nu), nu / (1 - nu)
        shaft = p * (1 - plane[1]) * 20 / plane[0]
        hub = p * 20 / plane[0] * ((40 ** 2 + 20 ** 2) / (40 ** 2 - 20 ** 2) + plane[1])
        self.assertAlmostEqual(shaft + hub, 0.02, 12)

    def test_the_layer_by_more_terms(self):
        for terms in (12, 16):
            length, pressure = receding_layer.layer(n=terms)
            self.assertAlmostEqual(length, value("layer c"), 9)
            self.assertAlmostEqual(pressure, value("layer p0"), 9)
        k = np.array([0.0499, 0.0501])  # where the series end
        for kernel in receding_layer.kernels(k):
            self.assertAlmostEqual(kernel[0] / kernel[1] * (k[0] / k[1]) ** 3, 1, 5)

    def test_exponent_without_and_with_much_friction(self):
        self.assertAlmostEqual(closed_values.exponent_of_punch(0.3, 0), 0.5, 15)
        s, beta = closed_values.exponent_of_punch(0.3, 0.15), 0.4 / 1.4
        self.assertAlmostEqual(math.tan(math.pi * s) * 0.15 * beta, 1, 12)


def evaluate(text, x, y):
    """An expression of a scene as Python has it."""
    names = {name: getattr(math, name) for name in ("sqrt", "atan2", "log", "exp", "cos", "sin", "pi")}
    return eval(text.replace("^", "**"), {"__builtins__": {}}, {**names, "x": x, "y": y})


class Fields(unittest.TestCase):
    """Hooke's law and equilibrium of the closed forms, by differences."""

    def stress(self, field, x, y, of_revolution, h=1e-4):
        def u(x, y):
            return [evaluate(part, x, y) for part in field("x", "y", True).split("; ")]
        d_x = [(p - m) / (2 * h) for p, m in zip(u(x + h, y), u(x - h, y))]
        d_y = [(p - m) / (2 * h) for p, m in zip(u(x, y + h), u(x, y - h))]
        lam, mu = closed_forms.E * closed_forms.NU / ((1 + closed_forms.NU) * (1 - 2 * closed_forms.NU)), closed_forms.MU
        around = u(x, y)[0] / x if of_revolution else 0
        trace = lam * (d_x[0] + d_y[1] + around)
        return trace + 2 * mu * d_x[0], mu * (d_y[0] + d_x[1]), trace + 2 * mu * d_y[1], trace + 2 * mu * around

    def check(self, field, of_revolution, pressure):
        h = 1e-3
        for x, y in ((1.7, 0.4), (2, 1.1), (1.4, 0.2)):
            right, left, up, down, at = (self.stress(field, *point, of_revolution) for point in ((x + h, y), (x - h, y), (x, y + h), (x, y - h), (x, y)))
            hoop = (at[0] - at[3]) / x, at[1] / x
            balance = ((right[0] - left[0] + up[1] - down[1]) / (2 * h) + of_revolution * hoop[0],
                       (right[1] - left[1] + up[2] - down[2]) / (2 * h) + of_revolution * hoop[1])
            self.assertLess(max(map(abs, balance)), 1e-3)
        loaded = [self.stress(field, x, 2e-4, of_revolution)[1:3] for x in (0.3, 0.6, 1.3)]
        for x, (s_xy, s_yy) in zip((0.3, 0.6, 1.3), loaded):
            self.assertLess(abs(s_xy), 1e-2)
            self.assertLess(abs(s_yy + pressure(x)), 2e-2)

    def test_flat_punches(self):
        self.check(closed_forms.flat_punch_plane, False, lambda x: 10 / math.pi / math.sqrt(1 - x * x) if x < 1 else 0)
        self.check(closed_forms.flat_punch_axi, True, lambda x: 1 / math.sqrt(1 - x * x) if x < 1 else 0)

    def test_hertz_of_revolution(self):
        self.check(closed_forms.hertz_axi, True, lambda x: 10 * math.sqrt(1 - x * x) if x < 1 else 0)

    def test_scenes_are_those_that_the_script_writes(self):
        with tempfile.TemporaryDirectory() as home:
            closed_forms.SCENES = pathlib.Path(home)
            closed_forms.write()
            for path in closed_forms.SCENES.iterdir():
                self.assertEqual(path.read_text(), (SCENES / path.name).read_text(), path.name)


class Page(unittest.TestCase):
    def test_tables_have_all_rows(self):
        self.assertEqual(list(rows()), [row["name"] for row in benchmarks.table()])

    def test_no_number_is_typed(self):
        """The page is what its tables give."""
        page = published.PAGE.read_text()
        with tempfile.TemporaryDirectory() as home:
            copy = pathlib.Path(home) / "benchmarks.md"
            copy.write_text(page)
            published.PAGE = copy
            with (TABLES / "scenes.csv").open(newline="") as file:
                scenes = list(csv.DictReader(file))
            published.draw(published.benchmarks(), list(rows().values()), scenes, {})
            self.assertEqual(copy.read_text(), page)

    def test_bars_have_the_digits_that_are_certain(self):
        for value, bar, text in ((28.60321, 1.1e-7, "28.60321000 ± 1.1e-07"), (7.696902, 2.1e-7, "7.6969020 ± 3e-07"), (659773.14, 23, "659770 ± 30"), (9.0, math.inf, "9")):
            self.assertEqual(published.with_bar(value, bar), text)

    def test_what_differs_is_said(self):
        module, found = published.benchmarks(), rows()
        for row in module.ROWS:
            verdict = found[row.name]["verdict"]
            if row.reference is not None and verdict not in ("agrees", "for comparison"):
                self.assertTrue(row.differs, f"{row.name} is {verdict}, and nothing says why")


class Solved(unittest.TestCase):
    def test_two_cases(self):
        for scene in ("lame-bush", "ssnp121"):
            with tempfile.TemporaryDirectory() as home:
                module = published.benchmarks()
                found, _ = published.measure(module, PROGRAM, pathlib.Path(home), [scene], 1)
                published.judged(module, found)
                self.assertTrue(found)
                for row in found:
                    self.assertEqual(row["verdict"], rows()[row["name"]]["verdict"], row)


if __name__ == "__main__":
    unittest.main()
