# SPDX-License-Identifier: LGPL-2.1-or-later
"""scenes.py HPVI DIR: what hpvi.plot.scene draws of a scene is what the scene says; all in one process. Status 77 without matplotlib."""
import importlib.util
import json
import pathlib
import sys
import unittest

import numpy as np

PROGRAM, MODULE = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(2))
sys.path[:0] = [str(MODULE), str(pathlib.Path(__file__).resolve().parents[1])]
import hpvi  # noqa: E402

if importlib.util.find_spec("matplotlib") is None:
    print("skipped: matplotlib is not installed")
    sys.exit(77)
import matplotlib  # noqa: E402
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from crowded import crowded  # noqa: E402
from hpvi import plot, space  # noqa: E402
from hpvi.scene import parts_of  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
BAR = {"Geometry/Upper corner": (2, 1), "Boundary left/Displacement": "0; free", "Boundary bottom/Displacement": "free; 0", "Boundary right/Traction": (3, 0)}


class Drawn:
    """The artists of one scene."""

    def __init__(self, scene):
        self.data = json.loads(scene.json())
        self.figure, self.axes = plot.figure(6, 5)
        self.remarks = plot.scene(self.data, self.axes)
        self.figure.canvas.draw()

    def arrows(self, gid):
        """(tail, vector) of each."""
        return [(np.array(one.xyann), np.array(one.xy) - one.xyann) for one in self.axes.texts if one.get_gid() == gid]

    def words(self, gid):
        return [text.get_text() for text in self.axes.texts if text.get_gid() == gid]

    def line(self, gid):
        return next(line.get_xydata() for line in self.axes.lines if line.get_gid() == gid)


class Scenes(unittest.TestCase):
    def tearDown(self):
        plt.close("all")

    def draw(self, name=None, **entries):
        drawn = Drawn(hpvi.Scene(ROOT / f"prm/{name}.prm", entries) if name else hpvi.Scene({**BAR, **entries}))
        self.assertEqual(crowded(drawn.figure), [])
        self.assertGreaterEqual(min(text.get_fontsize() for text in drawn.axes.texts), 8)
        return drawn

    def test_arrows_are_the_load_to_scale(self):
        drawn = self.draw("han-6-12")
        arrows = drawn.arrows("traction left")
        tails, vectors = (np.array(values) for values in zip(*arrows))
        heads = tails + vectors
        expected = np.stack([1.5 * (5 - heads[:, 1]), np.full(len(heads), -0.75)], axis=1)
        self.assertGreater(len(arrows), 8)
        ratio = np.hypot(*vectors.T) / np.hypot(*expected.T)
        self.assertLess(np.ptp(ratio), 0.05 * ratio.mean())
        self.assertIn("traction x: 1.5 to 7.5 kN/mm^2", drawn.words("boundary left"))
        self.assertEqual(len(drawn.data["cells"]), 16)
        self.assertIn("clamped", drawn.words("boundary right"))

    def test_a_narrow_load_has_an_arrow(self):
        drawn = self.draw("han-6-12", **{"Boundary top/Traction": "0; if(abs(x - 1.33) < 0.02, -50, 0)"})
        (tail, vector), = drawn.arrows("traction top")
        self.assertAlmostEqual(tail[0], 1.33, delta=0.03)
        self.assertLess(vector[1], 0)

    def test_what_is_held_and_what_pulls(self):
        drawn = self.draw()
        for tail, vector in drawn.arrows("traction right"):
            self.assertTrue(tail[0] > 2 and vector[0] > 0 and vector[1] == 0)
        self.assertEqual(drawn.words("boundary left"), ["left", "ux = 0", "uy free"])
        self.assertEqual(drawn.words("boundary top"), ["top", "free"])
        self.assertEqual(drawn.arrows("displacement left"), [])

    def test_foundations_stand_at_the_gap(self):
        gap = {"Boundary bottom/Displacement": "", "Boundary bottom/Contact": "unilateral", "Boundary bottom/Gap": "0.1*x", "Boundary left/Displacement": (0, 0)}
        x, y = self.draw(**gap).line("foundation bottom").T
        self.assertAlmostEqual((y[0] - y[-1]) / (x[-1] - x[0]), 0.1, delta=1e-6)
        inside = self.draw(**{**gap, "Boundary bottom/Gap": -0.2, "Boundary left/Displacement": (0, 0.2)})
        self.assertGreater(inside.line("foundation bottom")[:, 1].min(), 0.1)
        self.assertTrue(any("interference" in words for words in inside.words("boundary bottom")))

    def test_displacements_and_body_forces(self):
        for _, vector in self.draw("brake-pad").arrows("displacement top"):
            self.assertTrue(vector[0] < 0 and vector[1] == 0)
        drawn = self.draw("slope")
        (_, vector), = drawn.arrows("body force")
        self.assertTrue(vector[0] == 0 and vector[1] < 0)

    def test_edges_are_joined_up_to_corners(self):
        edges = [edge for boundary in self.draw("han-6-12").data["boundaries"] for edge in boundary["edges"]]
        self.assertEqual(len(edges), 16)
        plain = [{**edge, "gap": None, "traction": None, "displacement": None} for edge in edges]
        np.testing.assert_allclose([part.s[-1] for part in parts_of(plain)], [4, 4, 4, 4], rtol=1e-13)  # sums of 100 lengths
        ring = [boundary for boundary in self.draw("press-ring").data["boundaries"] if boundary["name"] == "outer"]
        part, = parts_of(ring[0]["edges"])
        self.assertEqual(len(part.x), len(part.data["gap"]))
        self.assertTrue((part.x[0] == part.x[-1]).all() and (np.diff(part.s) > 0).all())

    def test_labels_have_room(self):
        """The body is smaller, not the figure larger, where that is enough; a page leaves out what is free of many boundaries."""
        for name in ("han-6-12", "punch-plate", "bracket"):
            self.assertEqual(list(self.draw(name).figure.get_size_inches()), [6, 5])
        scene = hpvi.Scene(ROOT / "prm/bolted-flange.prm")
        _, axes = plot.figure(4.6, 5)
        plot.scene(json.loads(scene.json()), axes, is_brief=True)
        words = {text.get_text() for text in axes.texts}
        self.assertTrue({"bolt.left", "edge", "flange.bottom"} <= words and not {"flange.right", "head.top"} & words)

    def test_a_history_is_drawn_at_its_end(self):
        drawn = self.draw(**{"Loading/Steps": 4, "Boundary right/Traction": "8*t^3; 0"})
        self.assertIn("t = 1", drawn.remarks[0])
        self.assertIn("traction x: 8", drawn.words("boundary right"))

    def test_probes_and_curve_numbers(self):
        drawn = self.draw(**{"Probe tip/At": (2, 0.5), "Probe core/At": (1, 0.5), "Probe core/Size": 0.2, "Probe cut/From": (0, 0.5),
                             "Probe cut/To": (2, 0.6), "Probe cut/Points": 7, "Probe foot/On": "bottom"})
        circle, = drawn.axes.patches
        self.assertEqual((circle.get_gid(), circle.radius), ("probe core", 0.2))
        for name in ("tip", "cut", "foot"):
            self.assertTrue(len(drawn.line(f"probe {name}")))

    def test_scenes_of_all_kinds(self):
        for name in ("bolted-flange", "spruce", "press-ring", "jaws", "seal", "bimetal", "punch-plate", "sleeve"):
            with self.subTest(name):
                drawn = self.draw(name)
                shown = {text for boundary in drawn.data["boundaries"] for text in drawn.words(f"boundary {boundary['name']}")}
                self.assertLessEqual({boundary["name"] for boundary in drawn.data["boundaries"] if boundary["name"]}, shown)

    def test_bodies_of_any_size_place_and_words(self):
        for lower, upper in (((1e6, -3e6), (1000002, -2999999)), ((0, 0), (1e-6, 1e-3))):
            drawn = self.draw(**{"Geometry/Lower corner": lower, "Geometry/Upper corner": upper, "Title": "<a> & $b$"})
            self.assertTrue(drawn.arrows("traction right"))
        self.assertIn("<svg", hpvi.Scene({**BAR, "Title": "<a> & $b$"}).picture())

    def outlines(self, drawn):
        """Of the faces in space that are drawn, from below and from above."""
        return [collection for collection in drawn.axes.collections if collection.get_gid() == "faces"]

    def test_in_space_each_face_of_a_box_is_seen_once(self):
        drawn = self.draw("slab")
        below, above = self.outlines(drawn)
        n_faces = [len(one.get_paths()) for one in (below, above)]
        self.assertEqual(n_faces, [16 + 8 + 8] * 2)  # bottom, left and back of 4 x 4 x 2 cells; top, right and front
        contact = matplotlib.colors.to_rgba(space.TINTS["contact"][0])
        self.assertEqual([sum(tuple(colour) == contact for colour in one.get_facecolors()) for one in (below, above)], [8, 0])
        self.assertEqual(drawn.words("boundary bottom")[0], "bottom")
        self.assertIn("clamped", drawn.words("boundary right"))
        self.assertEqual(drawn.words("boundary top"), [])
        self.assertEqual(drawn.axes.get_xlabel(), "x: 0 to 4, y: 0 to 4, z: 0 to 2\nfree: top, front, back")

    def test_in_space_arrows_are_the_load_to_scale(self):
        drawn = self.draw(**{"Dimension": 3, "Geometry/Upper corner": (2, 1, 1), "Boundary left/Displacement": "0; free; free", "Boundary bottom/Displacement": "free; 0; free",
                             "Boundary top/Traction": (0, -2, 0), "Boundary right/Traction": (1, 0, 0), "Boundary front/Symmetry": "true", "Geometry/Subdivisions": (1, 1, 1)})
        (tail, down), = drawn.arrows("traction top")
        (_, out), = drawn.arrows("traction right")
        np.testing.assert_allclose(np.array((down, out)).T, space.ABOVE @ np.array(((0, -2, 0), (1, 0, 0))).T * (np.hypot(*down) / np.hypot(*(2 * space.ABOVE[:, 1]))), atol=1e-12)
        view = space.views(drawn.data)[1]
        np.testing.assert_allclose(tail + down, view((1, 1, 0.5)))  # it presses in the middle
        for name, words in (("left", "ux = 0"), ("bottom", "uy = 0"), ("front", "symmetry")):
            self.assertIn(words, " ".join(drawn.words(f"boundary {name}")))

    def test_in_space_words_of_all_boundaries_find_room(self):
        for name in ("ball", "spheres", "fretting-pad-space", "floor-slab", "growth-rings", "foot", "clamped-plates"):
            with self.subTest(name):
                drawn = self.draw(name)
                told = [boundary["name"] for boundary in drawn.data["boundaries"] if boundary["name"] and not space.is_free(boundary)]
                self.assertEqual([one for one in told if one not in drawn.words(f"boundary {one}")], [])


if __name__ == "__main__":
    unittest.main()
