# SPDX-License-Identifier: LGPL-2.1-or-later
"""module.py HPVI DIR: the Python module in DIR gives the numbers and the errors of the program, stops when it is told to, lets
others work meanwhile, and keeps nothing."""
import csv
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy as np

PROGRAM, MODULE = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(2))
sys.path.insert(0, str(MODULE))
import hpvi  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
HAN = str(ROOT / "prm/han-6-12.prm")
STEPS = "Adaptivity/Maximum steps"
# A bar under uniaxial tension: u = (0.3 x, -0.075 y), sigma_xx = 3 and nothing else.
BAR = {"Geometry": {"Upper corner": (2, 1), "Subdivisions": (2, 1)},
       "Material": {"Young's modulus": 10, "Poisson's ratio": 0.25, "Plane": "stress"},
       "Boundary left": {"Displacement": ("0", "free")}, "Boundary bottom/Displacement": "free; 0",
       "Boundary right": {"Traction": (3, 0)}, "Adaptivity": {"Method": "hup2", "Maximum steps": 1}}
BEAM = {"Dimension": 3, "Geometry/Upper corner": (2, 1, 1), "Geometry/Subdivisions": (2, 1, 1), "Material/Young's modulus": 10,
        "Material/Poisson's ratio": 0.25, "Boundary left/Displacement": "0; free; free", "Boundary bottom/Displacement": "free; 0; free",
        "Boundary front/Displacement": "free; free; 0", "Boundary right/Traction": (3, 0, 0), "Adaptivity/Method": "hup2",
        STEPS: 1}
# One step of a scene without contact is enough to see what a long run does in between.
LONG = {STEPS: 100, "Adaptivity/Method": "hup3", "Adaptivity/Maximum unknowns": 100000000, "Adaptivity/Tolerance": 0}


def program(scene, *settings, output):
    words = [word for setting in settings for word in ("--set", setting)]
    return subprocess.run([PROGRAM, "--output", output, scene, *words], capture_output=True, text=True, timeout=300,
                          env={**os.environ, "OMP_NUM_THREADS": "1"}, check=False)


def numbers(result):
    """All but times and memory."""
    return {name: values.tobytes() for name, values in result.steps.items() if not re.match("seconds|peak_memory", name)}


class Case(unittest.TestCase):
    def setUp(self):
        home = tempfile.TemporaryDirectory()
        self.addCleanup(home.cleanup)
        self.home = pathlib.Path(home.name)

    def same_table(self, columns, file):
        with file.open() as text:
            rows = list(csv.DictReader(text))
        self.assertEqual(list(columns), list(rows[0]))
        for name, values in columns.items():
            if re.match("seconds|peak_memory", name):
                continue
            wanted = [row[name] for row in rows]
            if values.dtype.kind == "U":
                self.assertEqual(list(values), wanted)
            else:
                np.testing.assert_array_equal(values, [float(field or "nan") for field in wanted], name)


class Numbers(Case):
    def test_tables_are_those_of_the_program(self):
        for scene, *settings in (("han-6-12", f"{STEPS}=3"), ("propped", f"{STEPS}=2"), ("blocks", f"{STEPS}=2"),
                                 ("fretting", "Loading/Steps=2", f"{STEPS}=2"), ("slab", f"{STEPS}=1")):
            with self.subTest(scene):
                file, out = ROOT / f"prm/{scene}.prm", self.home / scene
                done = program(file, *settings, output=out)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                result = hpvi.Scene(file, dict(setting.split("=") for setting in settings)).solve()
                self.same_table(result.steps, out / "convergence.csv")
                last = result["step"]
                self.same_table(result.contact, out / f"contact-{last:02d}.csv")
                forces = self.home / "forces.csv"
                head, *rows = (out / "forces.csv").read_text().splitlines(True)
                forces.write_text("".join([head, *(row for row in rows if row.startswith(f"{last},"))]))
                self.same_table(result.forces, forces)
                if (out / "loading.csv").exists():
                    self.same_table(result.loading, out / "loading.csv")
                    self.same_table(result.contact_history, out / "contact-history.csv")
                for name, line in result.probe_lines.items():
                    self.same_table(line, out / f"probe-{name}-{last:02d}.csv")
                summary = json.loads((out / "summary.json").read_text())
                self.assertEqual((result.stopped_by, result.warnings), (summary["stopped_by"], summary["warnings"]))
                self.assertTrue(result.contact and (scene != "propped" or result.probe_lines))

    def test_files_are_written_where_they_are_wanted_alone(self):
        os.chdir(self.home)
        self.addCleanup(os.chdir, ROOT)
        settings = {STEPS: 2}
        hpvi.Scene(HAN, settings).solve()
        self.assertEqual(list(self.home.iterdir()), [])
        hpvi.Scene(HAN, settings).solve(output=self.home / "python")
        program(HAN, f"{STEPS}=2", output=self.home / "program")
        files = [sorted(path.name for path in (self.home / name).iterdir()) for name in ("python", "program")]
        self.assertEqual(*files)
        self.assertEqual(json.loads((self.home / "python/summary.json").read_text())["status"], "done")

    def test_displacement_and_stress_at_points(self):
        points = np.random.default_rng(1).uniform(0, 1, (50, 3))
        for entries, dim in ((BAR, 2), (BEAM, 3)):
            with self.subTest(dim=dim):
                x = np.concatenate([points[:, :dim] * [2, 1, 1][:dim], np.eye(dim)[:1] * 2, np.zeros((1, dim))])
                result = hpvi.Scene(entries).solve()
                np.testing.assert_allclose(result.u(x), x * [0.3, -0.075, -0.075][:dim], atol=1e-8)
                np.testing.assert_allclose(result.stress(x), np.tile(np.diag([3., 0, 0]), (len(x), 1, 1)), atol=1e-6)
                self.assertEqual(result.u(x.reshape(4, 13, dim)).shape, (4, 13, dim))
                self.assertEqual(result.stress(x[0]).shape, (3, 3))
                outside = np.full((1, dim), 1.5)
                self.assertTrue(np.isnan(result.u(outside)).all() and np.isnan(result.stress(outside)).all())
                with self.assertRaisesRegex(ValueError, f"coordinates, {dim} of them"):
                    result.u([1., 2., 3., 4.])

    def test_points_at_a_joint_know_their_body(self):
        slab = {"Body low": {"Upper corner": (2, 1), "Subdivisions": (3, 1)}, "Body up": {"Lower corner": (0, 1), "Upper corner": (2, 2)},
                "Material/Plane": "stress", "Material/Young's modulus": 10, "Material/Poisson's ratio": 0.25,
                "Boundary low.bottom/Displacement": "free; 0", "Boundary low.left/Displacement": "0; free",
                "Boundary up.left/Displacement": "0.1; free", "Boundary up.right/Displacement": "0.7; free",
                "Boundary up.top/Pressure": 1, "Contact joint/Between": "up.bottom, low.top", STEPS: 1}
        result = hpvi.Scene(slab).solve()
        x = np.array([[0, 1], [0.3, 1], [1, 1], [2, 1.]])
        low = np.array([0.025, -0.1]) * x  # uniaxial; the upper one is strained by 0.3 along, and slides
        np.testing.assert_allclose(result.u(x, body="low"), low, atol=1e-9)
        np.testing.assert_allclose(result.u(x, body="up"), np.column_stack([0.1 + 0.3 * x[:, 0], low[:, 1]]), atol=1e-9)
        np.testing.assert_allclose(result.stress(x, body="low")[:, 0, 0], 0, atol=1e-8)
        np.testing.assert_allclose(result.stress(x, body="up")[:, 0, 0], 10 * 0.3 - 0.25, atol=1e-8)
        for body, other in (("low", [1, 1.5]), ("up", [1, 0.5])):
            self.assertTrue(np.isnan(result.u(other, body=body)).all() and np.isnan(result.stress(other, body=body)).all())
            self.assertFalse(np.isnan(result.u(other)).any())
        with self.assertRaisesRegex(ValueError, "none called middle; give low or up"):
            result.u(x, body="middle")
        with self.assertRaisesRegex(ValueError, "one body without a name"):
            hpvi.Scene(BAR).solve().stress(x, body="low")

    def test_points_of_curved_cells_agree_with_probes(self):
        result = hpvi.Scene(ROOT / "prm/press-ring.prm", {STEPS: 2}).solve()
        inside = result.grid(3)["x"][:, 1, 1]  # the middle of each cell
        for k in (0, len(inside) // 2, len(inside) - 1):
            probed = hpvi.Scene(ROOT / "prm/press-ring.prm", {STEPS: 2, "Probe here/At": inside[k]}).solve()
            np.testing.assert_array_equal(result.u(inside)[k], [probed["here_ux"], probed["here_uy"]])
            self.assertEqual(result.stress(inside)[k, 2, 2], probed["here_szz"])

    def test_grid_has_the_values_at_its_points(self):
        result = hpvi.Scene(HAN, {STEPS: 3}).solve()
        grid = result.grid(3)
        np.testing.assert_allclose(result.u(grid["x"]), grid["u"], atol=1e-12)
        middle = grid["x"][:, 1, 1]
        np.testing.assert_allclose(result.stress(middle), grid["stress"][:, 1, 1], atol=1e-10)
        self.assertEqual(grid["x"].shape, (len(result.mesh.cells), 3, 3, 2))

    def test_mesh(self):
        result = hpvi.Scene(HAN, {STEPS: 4}).solve()
        mesh = result.mesh
        a, b, c, d = np.moveaxis(mesh.vertices[mesh.cells], 1, 0)
        areas = 0.5 * np.cross(c - a, d - b)
        self.assertTrue((areas > 0).all())
        self.assertAlmostEqual(areas.sum(), 16)
        self.assertEqual((len(mesh.cells), mesh.degrees.min(), mesh.degrees.max()),
                         (result["elements"], result["p_min"], result["p_max"]))
        self.assertEqual(len(np.unique(mesh.vertices, axis=0)), len(mesh.vertices))
        beam = hpvi.Scene(BEAM).solve().mesh
        corners = beam.vertices[beam.cells[0]] - beam.vertices[beam.cells[0][0]]
        np.testing.assert_allclose(corners, [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]])

    def test_error_by_cell(self):
        for thickness in (1, 4):
            result = hpvi.Scene(HAN, {STEPS: 3, "Material/Thickness": thickness}).solve()
            self.assertAlmostEqual(np.sqrt((result.indicator_by_cell ** 2).sum()) / result["estimate"], 1)
            self.assertEqual(len(result.bound_by_cell), result["elements"])
            self.assertAlmostEqual(np.sqrt((result.bound_by_cell ** 2).sum()) / result["error_bound"], 1, delta=0.2)
            self.assertEqual(result.no_bound, "")
        without = hpvi.Scene(HAN, {STEPS: 1, "Error/Bound": False}).solve()
        self.assertIsNone(without.bound_by_cell)
        self.assertNotEqual(without.no_bound, "")


class Scenes(unittest.TestCase):
    def test_values_become_text(self):
        scene = hpvi.Scene()
        for path, value, text in (("Boundary left/Traction", (0.3, 0), "0.3; 0"), ("Geometry/Subdivisions", (4, 2), "4, 2"),
                                  ("Geometry/Upper corner", np.array([2., 1]), "2.0, 1.0"), ("Output/VTU", False, "false"),
                                  ("Geometry/Corners", ((0, 0), (1, 0), (1, 1), (0, 1)), "0, 0; 1, 0; 1, 1; 0, 1"),
                                  ("Geometry/Graded towards", (0, 0), "0, 0"), ("Geometry/Graded towards", [(0, 0), (1, 1)], "0, 0; 1, 1"),
                                  ("Boundary left/Displacement", ("0.1*y", "free"), "0.1*y; free"), ("Adaptivity/Tolerance", 1e-5, "1e-05"),
                                  ("Contact joint/Between", ("a.top", "b.bottom"), "a.top, b.bottom"), (STEPS, np.int64(3), "3"),
                                  ("Material steel/Initial strain", (1e-3, 0, 0), "0.001; 0; 0"), ("Body force/Gravity", (0, -9.81), "0; -9.81"),
                                  ("Probe tip/At", (1, 2), "1, 2"), ("Boundary seat/Spring", (np.float64(2.5), 0), "2.5; 0"), ("Title", "A bar", "A bar")):
            scene[path] = value
            self.assertEqual(scene[path], text)
        for value in (None, {1: 2}, 1j, object()):
            with self.assertRaises(TypeError, msg=value):
                scene["Title"] = value

    def test_entries_are_those_of_the_file_until_they_are_set(self):
        scene = hpvi.Scene(HAN, {"Boundary bottom": {"Friction bound": 0.5}})
        self.assertEqual((scene["Boundary bottom/Friction bound"], scene["Boundary bottom/Contact"], scene["Solver/QP tolerance"]),
                         ("0.5", "bilateral", "1e-12"))
        other = scene.copy()
        other["Boundary bottom/Friction bound"] = 1
        self.assertEqual(scene["Boundary bottom/Friction bound"], "0.5")
        with self.assertRaisesRegex(hpvi.InputError, "no such entry"):
            scene["Boundary bottom/Frction bound"]
        self.assertIn("friction bound 0.5", scene.describe())
        self.assertIn("set Friction bound", scene.print())
        self.assertIn("<svg", scene._repr_svg_())
        self.assertIn("<svg", hpvi.Scene(BEAM)._repr_svg_())
        shows_nothing = hpvi.Scene({"Boundary left/Contact": "some"})
        self.assertIsNone(shows_nothing._repr_svg_())
        with self.assertRaises(hpvi.InputError):
            shows_nothing.picture()
        self.assertEqual(scene.title, "Example 5.2: square block pushed along a plane")

    def test_a_scene_of_entries_is_that_of_a_file(self):
        with tempfile.TemporaryDirectory() as home:
            file = pathlib.Path(home) / "bar.prm"
            file.write_text(hpvi.Scene(BAR).print())
            self.assertEqual(numbers(hpvi.Scene(file).solve()), numbers(hpvi.Scene(BAR).solve()))


class Arrays(Case):
    """Meshes of points and cells."""

    r, angle = np.meshgrid(np.linspace(1, 2, 3), np.linspace(0, np.pi / 2, 5))
    points = np.stack([(r * np.cos(angle)).ravel(), (r * np.sin(angle)).ravel()], axis=-1)
    number = np.arange(15).reshape(5, 3)
    cells = np.stack([number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]], axis=-1).reshape(-1, 4)

    @staticmethod
    def along(line):
        return np.stack([line[:-1], line[1:]], axis=-1)

    def ring(self, cells):
        boundaries = {"inner": self.along(self.number[:, 0]), "outer": self.along(self.number[:, 2]),
                      "start": self.along(self.number[0]), "end": self.along(self.number[-1])}
        return hpvi.Scene({"Material": {"Young's modulus": 1, "Poisson's ratio": 0.3}, "Boundary inner": {"Pressure": 1, "Curve": "circle"},
                           "Boundary outer": {"Curve": "circle"}, "Boundary start": {"Symmetry": True}, "Boundary end": {"Symmetry": True},
                           "Adaptivity/Tolerance": 1e-7}, points=self.points, cells=cells, boundaries=boundaries)

    def test_cells_of_any_kind_are_lames_ring(self):
        triangles = np.concatenate([self.cells[:, :3], self.cells[:, [0, 2, 3]]])
        mixture = [*self.cells[:4].tolist(), *triangles[4:8], *triangles[12:].tolist()]
        exact = 1.3 * (0.4 + 4) / 3
        for cells in (self.cells, triangles, mixture, self.cells.astype(np.uint8)):
            ring = self.ring(cells)
            self.assertAlmostEqual(ring.solve().u(np.array([1., 0]))[0], exact, delta=1e-6)
            ring["Boundary outer/Curve"] = ""
            self.assertIn("boundary outer is a polygon with its vertices on a circle of radius 2 around (0, 0)", ring.describe())

    def test_the_mesh_is_written_beside_results(self):
        scene = self.ring(self.cells)
        one = scene.solve(output=self.home / "out")
        self.assertEqual(numbers(hpvi.Scene(self.home / "out/scene.prm").solve()), numbers(one))
        scene.solve(output=self.home / "out")
        (self.home / "out/mesh.msh").write_text("another")
        with self.assertRaisesRegex(hpvi.InputError, "has another mesh.msh; choose another one"):
            scene.solve(output=self.home / "out")
        self.assertEqual(numbers(self.ring(self.cells).solve()), numbers(one))

    def test_parts_are_bodies(self):
        points = [[x, y] for y in (0, 1) for x in (0, 1, 2)] + [[x, y] for y in (1, 2) for x in (0, 1, 2)]
        cells = [[a + b, a + b + 1, a + b + 4, a + b + 3] for a in (0, 6) for b in (0, 1)]
        blocks = hpvi.Scene({"Body low/Surfaces": "low", "Body high/Surfaces": "high", "Contact joint/Between": "automatic",
                             "Contact joint/Friction bound": 0.001, "Boundary low.base/Displacement": (0, 0), "Boundary high.top/Displacement": (0.1, -0.1)},
                            points=points, cells=cells, parts={"low": [0, 1], "high": [2, 3]},
                            boundaries={"base": [[0, 1], [1, 2]], "roof": [[3, 4], [4, 5]], "foot": [[6, 7], [7, 8]], "top": [[9, 10], [10, 11]]})
        self.assertIn("low.roof, high.foot", blocks.describe())
        self.assertAlmostEqual(blocks.solve().forces["Fx"][0], -0.002, delta=1e-9)

    def test_edges_without_names_have_numbers(self):
        square = hpvi.Scene({"Boundary 4/Symmetry": True, "Boundary 1/Symmetry": True}, points=[[0, 0], [1, 0], [1, 1], [0, 1]], cells=[[0, 1, 2, 3]])
        self.assertIn("boundary 3", square.describe())

    def test_space(self):
        points = [[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1, 2)]
        cells = [[k, k + 1, k + 4, k + 3, k + 6, k + 7, k + 10, k + 9] for k in (0, 1)]
        bar = hpvi.Scene({"Dimension": 3, "Boundary left/Displacement": (0, 0, 0), "Boundary right/Traction": (1, 0, 0)}, points=points, cells=cells,
                         boundaries={"left": [[0, 3, 9, 6]], "right": [[2, 5, 11, 8]]})
        self.assertIn("2 coarse cells", bar.describe())

    def test_what_is_wrong_is_said(self):
        square, one = [[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2, 3]]
        for words, arrays in (("the cell 0 has the point 4, and there are 4; count points from 0", {"cells": [[1, 2, 3, 4]]}),
                              ("the cell 0 has 5 points; give 3 or 4", {"cells": [[0, 1, 2, 3, 0]]}),
                              ("the point 1 is at .*; give finite numbers", {"points": [[0, 0], [np.nan, 0], [1, 1], [0, 1]]}),
                              ("has 1 coordinates a point; give 2", {"points": [[0], [1], [2], [3]]}),
                              ("boundaries: left has 3 points in a row; give the two ends", {"boundaries": {"left": [[0, 1, 2]]}}),
                              ("boundaries: left has the point -1", {"boundaries": {"left": [[0, -1]]}}),
                              ("parts: steel has the cell 1, and there are 1; count", {"parts": {"steel": [1]}}),
                              ("parts: .* has the cell 0, which another part has, too; give", {"parts": {"steel": [0], "brass": [0]}})):
            with self.subTest(words), self.assertRaisesRegex(hpvi.InputError, words):
                hpvi.Scene(**{"points": square, "cells": one, **arrays})
        with self.assertRaisesRegex(hpvi.InputError, "mesh [0-9]+: .*"):
            hpvi.Scene({"Boundary left/Pressure": 1}, points=square, cells=[[0, 1, 3, 2]], boundaries={"left": [[0, 3]]}).solve()
        for arrays in ({"cells": [[0., 1, 2, 3]]}, {"points": "no"}, {"cells": 3}, {"boundaries": {"left": [0, 1]}}):
            with self.subTest(arrays), self.assertRaises(TypeError):
                hpvi.Scene(**{"points": square, "cells": one, **arrays})
        with self.assertRaises(ValueError):
            hpvi.Scene(points=square)


class Errors(Case):
    def test_exceptions_have_the_line_of_the_program(self):
        missing = str(self.home / "none.prm")
        cases = ((HAN, hpvi.InputError, "Boundary botom/Contact=bilateral"), (HAN, hpvi.InputError, "Boundary bottom/Friction bound=-1"),
                 (HAN, hpvi.InputError, "Boundary bottom/Contact=none", "Boundary bottom/Friction bound=", "Boundary right/Displacement="), (missing, hpvi.InputError, f"{STEPS}=2"),
                 (HAN, hpvi.InputError, "Material/Poisson's ratio=0.7"), (HAN, hpvi.InputError, "Boundary left/Traction=1/(x-0.3); 1/(y-1.7)"),
                 (HAN, hpvi.NumericalFailure, "Solver/QP solver=mprgp", "Solver/QP warm start=false", "Solver/QP maximum multiplications=20"),
                 (str(ROOT / "prm/slab.prm"), hpvi.InputError, "Boundary top/Traction=0"))
        for scene, kind, *settings in cases:
            with self.subTest(settings):
                done = program(scene, *settings, output=self.home / "out")
                with self.assertRaises(kind) as raised:
                    hpvi.Scene(scene, dict(setting.split("=") for setting in settings)).solve()
                self.assertEqual((done.returncode, done.stderr), (1 if kind is hpvi.InputError else 2, f"{raised.exception}\n"))

    def test_a_scene_without_file_is_called_scene(self):
        with self.assertRaises(hpvi.InputError) as raised:
            hpvi.Scene({"Boundary botom/Contact": "bilateral"}).solve()
        self.assertEqual(str(raised.exception), 'scene (--set): Boundary botom: is an unknown subsection; the nearest known one is '
                                                '"Boundary bottom"')
        self.assertTrue(issubclass(hpvi.InputError, ValueError) and issubclass(hpvi.NumericalFailure, ArithmeticError))

    def test_files_that_cannot_be_written(self):
        (self.home / "file").write_text("mine")
        with self.assertRaisesRegex(hpvi.InputError, "output directory"):
            hpvi.Scene(BAR).solve(output=self.home / "file")


class Runs(Case):
    def status(self):
        return json.loads((self.home / "out/summary.json").read_text())

    def test_callback_that_returns_false(self):
        result = hpvi.Scene(HAN).solve(lambda result: result["step"] < 2, output=self.home / "out")
        self.assertEqual((len(result), result.stopped_by), (2, "callback"))
        self.assertTrue(np.isfinite(result.u([1, 1])).all())
        self.assertEqual((self.status()["status"], self.status()["message"]), ("interrupted", "hpvi: stopped by the callback"))
        self.same_table(result.steps, self.home / "out/convergence.csv")

    def test_callback_that_returns_something_else(self):
        for answer in (None, 0, True):
            self.assertEqual(len(hpvi.Scene(HAN, {STEPS: 2}).solve(lambda result: answer)), 2)

    def test_callback_that_raises(self):
        seen, error = [], KeyError("mine")

        def callback(result):
            seen.append(result)
            if len(result) == 2:
                raise error

        with self.assertRaises(KeyError) as raised:
            hpvi.Scene(HAN).solve(callback, output=self.home / "out")
        self.assertIs(raised.exception, error)
        self.assertEqual(self.status()["message"], "hpvi: interrupted by KeyError")
        self.assertEqual(len(seen[0].steps["step"]), 2)  # what was finished stays
        with self.assertRaisesRegex(RuntimeError, "^the solution of the last step is at hand in the callback"):
            seen[0].u([1, 1])

    def test_interruption(self):
        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(signal.SIGINT, signal.default_int_handler))
        times = []

        def interrupt():
            times.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)

        timer = threading.Timer(0.3, interrupt)
        with self.assertRaises(KeyboardInterrupt):
            hpvi.Scene(HAN, LONG).solve(lambda result: timer.start() if len(result) == 1 else None, output=self.home / "out")
        self.assertLess(time.monotonic() - times[0], 30)
        self.assertEqual(self.status()["message"], "hpvi: interrupted by KeyboardInterrupt")
        self.assertGreaterEqual(self.status()["steps"], 1)

    def test_others_work_meanwhile(self):
        ticks, ends = [], []

        def solve():
            hpvi.Scene(HAN, {"Adaptivity/Method": "hup3", STEPS: 5}).solve()
            ends.append(time.monotonic())

        thread = threading.Thread(target=solve)
        thread.start()
        while not ends:
            time.sleep(0.001)
            ticks.append(time.monotonic())
        thread.join()
        self.assertGreater(len(ticks), 20)

    def test_two_threads(self):
        scenes = [hpvi.Scene(ROOT / f"prm/{name}.prm", {STEPS: 4}) for name in ("han-6-12", "han-6-13")]
        one_after_the_other = [numbers(scene.solve()) for scene in scenes]
        at_once = [None, None]

        def solve(k):
            at_once[k] = numbers(scenes[k].solve())

        threads = [threading.Thread(target=solve, args=(k,)) for k in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(at_once, one_after_the_other)

    def test_memory_stays(self):
        def pages():
            return int(pathlib.Path("/proc/self/statm").read_text().split()[1])

        kept = None
        for k in range(60):
            result = hpvi.Scene(HAN, {STEPS: 1, "Error/Bound": False}).solve()
            kept = result.contact["x"], result.mesh.vertices
            if k == 20:
                before = pages()
        self.assertLess(pages() - before, 1000)  # 4 MB
        del result
        np.testing.assert_array_equal(kept[1].min(axis=0), [0, 0])  # arrays own what they hold

    def test_the_interpreter_ends_with_results_of_mpi(self):
        """The second one is of multigrid, whose vectors deal.II keeps."""
        for scene in (f"{BEAM!r}", f"{str(ROOT / 'prm/spheres.prm')!r}, {{'Adaptivity/Maximum steps': 1}}"):
            script = f"import sys; sys.path.insert(0, {str(MODULE)!r}); import hpvi; result = hpvi.Scene({scene}).solve(); print(len(result))"
            done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=100, check=False)
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "1\n", ""))


if __name__ == "__main__":
    unittest.main()
