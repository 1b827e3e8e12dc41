# SPDX-License-Identifier: LGPL-2.1-or-later
"""report.py HPVI: charts show what the tables hold, and the page says what its reader needs; all drawn in one process. Status 77 without matplotlib."""

import base64
import functools
import importlib.util
import itertools
import os
import pathlib
import re
import shutil
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from unittest import mock

from runs import PROGRAM, SCENES, command, run_program

NEEDED = ("matplotlib", "jinja2")
if any(importlib.util.find_spec(name) is None for name in NEEDED):
    print("skipped: matplotlib or jinja2 is not installed")
    sys.exit(77)
sys.path[:0] = [str(pathlib.Path(PROGRAM).resolve().parent / "python"), str(pathlib.Path(__file__).resolve().parents[1])]
import matplotlib  # noqa: E402
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from crowded import watched  # noqa: E402
from hpvi import plot, render, report, results, space, words  # noqa: E402
from hpvi.scene import MATERIALS  # noqa: E402

HAS_VTK = bool(importlib.util.find_spec("vtkmodules") and shutil.which("Xvfb"))
FEW = ("Adaptivity/Maximum steps=3", "Error/Bound=last step")
TWO_FEET = """set Title = two feet
subsection Geometry
  set Upper corner = 10, 2
  set Subdivisions = 10, 2
end
subsection Boundary feet
  set On = bottom
  set Where = abs(x-5) - 3
  set Contact = unilateral
  set Friction coefficient = 0.3
end
subsection Boundary top
  set Pressure = 0.001
end
subsection Probe normal
  set At = 5, 1
end
subsection Probe p
  set At = 1, 1
end
"""


HOME = tempfile.TemporaryDirectory()
PUNCH = ("punch", "Adaptivity/Maximum steps=14")
LOOP = ("fretting", "Loading/Steps=6", *FEW)
# What a dichromat sees of linear red, green and blue: G. M. Machado and others, doi:10.1109/TVCG.2009.113.
BLINDNESS = (((0.367322, 0.860646, -0.227968), (0.280085, 0.672501, 0.047413), (-0.011820, 0.042940, 0.968881)),
             ((0.152286, 1.052583, -0.204868), (0.114503, 0.786281, 0.099216), (-0.003882, -0.048116, 1.051998)))


def drawn(function, *arguments, **options):
    figure, axes = plot.figure()
    remarks = function(*arguments[:1], axes, *arguments[1:], **options)
    figure.canvas.draw()
    plt.close(figure)
    return axes, remarks


def line_named(axes, name):
    return next(line for line in axes.lines if line.get_label() == name)


@functools.lru_cache(maxsize=None)
def solve(name, *settings):
    """The run of a scene of prm/, or of TWO_FEET."""
    directory = pathlib.Path(tempfile.mkdtemp(dir=HOME.name))
    scene = SCENES / f"{name}.prm"
    if name == "two feet":
        scene = directory / "mine.prm"
        scene.write_text(TWO_FEET)
    status, _, errors = run_program(command(scene, directory / "out", *settings))
    assert status == 0, errors
    return results.Run(directory / "out")


@functools.lru_cache(maxsize=None)
def page_of(run):
    """Without its pictures, and how many these are."""
    text = report.page(run)
    pictures = re.findall(r"data:image/svg\+xml;base64,([^\"]*)", text)
    for picture in pictures:
        ElementTree.fromstring(base64.b64decode(picture))
    return re.sub("base64,[^\"]*", "", text), len(pictures)


class Charts(unittest.TestCase):
    def tearDown(self):
        plt.close("all")

    def check_contact(self, run):
        """Each line of the chart is a column of contact-NN.csv."""
        for name, rows in results.contacts(run.contact).items():
            line = next(one for one in run.lines if one.name == name)
            axes, _ = drawn(plot.contact, run, line)
            for label, values in (("pressure", -run.contact["normal_traction"][rows]), ("friction", run.contact["tangential_traction"][rows])):
                if values.any() or label == "pressure":
                    shown = line_named(axes, label).get_ydata()
                    np.testing.assert_array_equal(shown[np.isfinite(shown)], values)
            x = line_named(axes, "pressure").get_xdata()
            self.assertTrue((np.diff(x[np.isfinite(x)]) > 0).all())
            self.assertIn("arc length [", axes.get_xlabel())
            self.assertGreaterEqual(min(text.get_fontsize() for text in axes.texts + axes.get_xticklabels()), 8)

    def check_convergence(self, run):
        axes, _ = drawn(plot.convergence, run)
        at_ends = np.isin(run.steps["step"], run.loading["step"]) if run.loading else np.full(len(run.steps["step"]), True)
        values = run.steps["estimate_relative"][at_ends]
        np.testing.assert_array_equal(line_named(axes, "indicator, no bound").get_ydata(), values[np.isfinite(values)])

    def test_charts_are_the_tables(self):
        """Of ten scenes; one of them has two contacts, two a history, one is axisymmetric. No words lie on each other."""
        for name, more in (("han-6-12", ()), ("punch", ()), ("hertz", ()), ("receding", ()), ("brake-pad", ()), ("press-ring-axi", ()),
                           ("jaws", ()), ("seal", ()), ("fretting", ("Loading/Steps=4",)), ("bolted-flange", ("Loading/Steps=2",))):
            with self.subTest(name), watched() as crowded:
                run = solve(name, *FEW, *more)
                self.check_contact(run)
                self.check_convergence(run)
                axes, _ = drawn(plot.mesh, run)
                np.testing.assert_array_equal(axes.collections[0].get_array(), run.mesh.degrees)
                self.assertEqual(sum(run.degrees[f"p{p}"][-1] for p in np.unique(run.mesh.degrees)), len(run.mesh.degrees))
                text, n_pictures = page_of(run)
                self.assertGreaterEqual(n_pictures, 4)
                self.assertIn("mesh of the last step", text)
                self.assertEqual(crowded, [])

    def test_points_of_cells_count_x_first(self):
        """And corners go counterclockwise, as those of a Result."""
        for name, d in (("han-6-12", 2), ("slab", 3)):
            run = solve(name, "Adaptivity/Maximum steps=2")
            x = run.grid(3)["x"]
            for axis in range(d):
                self.assertTrue((np.diff(x, axis=1 + axis)[..., axis] > 0).all())
            corners = run.mesh.vertices[run.mesh.cells[:, :4]]
            one, two = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
            self.assertTrue((one[:, 0] * two[:, 1] > one[:, 1] * two[:, 0]).all())

    def test_loads_over_displacements(self):
        run = solve(*LOOP)
        (boundary, component), = plot.loops(run)
        axes, _ = drawn(plot.loop, run, boundary, component)
        np.testing.assert_array_equal(axes.lines[0].get_xydata().T, [run.loading["displacement_top_x"], run.loading["force_top_x"]])
        axes, _ = drawn(plot.energies, run)
        np.testing.assert_array_equal(line_named(axes, "work").get_ydata(), run.loading["work"])

    def test_in_space(self):
        run = solve("slab", "Adaptivity/Maximum steps=2")
        axes, _ = drawn(plot.surface, run, name="bottom", what="pressure")
        np.testing.assert_array_equal(axes.collections[0].get_array(), -run.contact["normal_traction"])
        text, n_pictures = page_of(run)
        self.assertIn("No picture of the scene: there is no scene.json; hpvi --report writes it", text)
        self.assertGreaterEqual(n_pictures, 4)

    def test_bodies_that_touch(self):
        """Blocks of 2 mm: where they touch both have faces, and across it they are drawn apart, the upper one upwards."""
        run = solve("spheres", "Adaptivity/Maximum steps=2")
        x, bodies = run.grid(5)["x"], run.mesh.bodies
        faces, names = plot.outer_faces(x, bodies)
        np.testing.assert_array_equal(plot.on_faces(x, names), faces)
        for body in (0, 1):
            own = faces[bodies[names[:, 0]] == body]
            sides = np.linalg.norm(np.cross(own[:, -1, 0] - own[:, 0, 0], own[:, 0, -1] - own[:, 0, 0]), axis=1)
            self.assertAlmostEqual(sides.sum(), 24, places=5)
            self.assertTrue((own[..., 1] * (1 - 2 * body) > -1e-9).all())
        upper, lower = plot.apart(run, faces, bodies[names[:, 0]])
        np.testing.assert_allclose(upper - lower, (0, 0.75 * np.ptp(run.contact["x"]), 0), atol=1e-9)
        self.assertTrue(1 < (upper - lower)[1] < 1.5)
        np.testing.assert_array_equal(plot.apart(solve("slab", "Adaptivity/Maximum steps=2"), *2 * [np.zeros(4, int)]), np.zeros((1, 3)))

    def test_what_vtk_is_asked_for(self):
        """Both views of all of the surface at its displaced places, bodies apart; words name the factor, the field with its unit, and the views."""
        run, asked = solve("spheres", "Adaptivity/Maximum steps=2"), []

        def images(*arguments):
            asked.append(arguments)
            return [np.full((40, 30, 3), 128, np.uint8)] * 2

        with mock.patch.object(render, "images", images), watched() as crowded:
            axes, (remark,) = drawn(plot.body, run, scale=7)
            text, _ = plot.svg(plot.body, run, size=(4.6, 4))
            shown = page_of.__wrapped__(run)[0]
        moved, values, limit, colours, views = asked[0]
        cells = run.grid(plot.PER_CELL)
        stress = results.von_mises(cells["stress"])
        self.assertEqual((values.max() <= stress.max(), 0 < limit <= values.max(), len(colours)), (True, True, 256))
        self.assertEqual([axes.get_title(), axes.images[0].get_array().shape], ["displacement 7 times", (40, 30, 3)])
        faces, names = plot.outer_faces(cells["x"], run.mesh.bodies)
        shifts = moved - faces - 7 * plot.on_faces(cells["u"], names)  # of each body one
        for body in (0, 1):
            self.assertLess(np.ptp(shifts[run.mesh.bodies[names[:, 0]] == body].reshape(-1, 3), axis=0).max(), 1e-9)
        self.assertGreater(np.ptp(shifts[..., 1]), 1)
        for (view, (low, high)), way in zip(views, (-1, 1)):
            self.assertEqual(np.sign(np.cross(*view)[1]), way)
            flat = moved.reshape(-1, 3) @ view.T
            self.assertTrue((low < flat.min(axis=0)).all() and (high > flat.max(axis=0)).all() and (high - low < 1.1 * np.ptp(flat, axis=0).max()).all())
        self.assertEqual(remark, "von Mises stress [N/mm²] on the deformed body, displacement 7 times as large, seen from below and from above, bodies drawn apart")
        self.assertRegex(shown, r"Von Mises stress \[N/mm²\] on the deformed body, displacement \d+ times as large, seen from below and from above")
        self.assertNotIn("install", shown)
        self.assertEqual({text.get_text() for text in axes.texts} - {""}, {"x", "y", "z", "from below", "from above"})
        self.assertEqual([one.get_ylabel() for one in axes.figure.axes[1:]], ["von Mises stress [N/mm²]"])
        self.assertEqual(crowded, [])
        self.assertEqual(text.count("<image"), 3)  # two views and the colours of the bar, each for itself

    def test_without_vtk(self):
        """The picture of matplotlib, and one line that says what to install, of a body in space alone."""
        with mock.patch.object(importlib.util, "find_spec", lambda name: None):
            shown, n_pictures = page_of.__wrapped__(solve("slab", "Adaptivity/Maximum steps=2"))
            self.assertEqual(shown.count("seen from below; VTK draws it from two sides: install python3-vtk9 and xvfb.</figcaption>"), 1)
            self.assertGreaterEqual(n_pictures, 4)
            self.assertNotIn("install", page_of.__wrapped__(solve("two feet"))[0])

    @unittest.skipUnless(HAS_VTK, "python3-vtk9 or xvfb is not installed")
    def test_a_picture_by_vtk(self):
        """A cube with stress on its upper face alone, which one of the two views has; and of a run a picture of many colours."""
        t = np.linspace(0, 1, 5)
        x = np.stack(np.meshgrid(t, t, t, indexing="ij"), axis=-1)[None]
        faces, _ = plot.outer_faces(x, np.zeros(1, int))
        values = np.where(faces[:, 1:2, 1:2, 1] == 1, 1., 0.) * np.ones((6, 5, 5))
        windows = [np.stack([end((faces @ view.T).reshape(-1, 2), axis=0) for end in (np.min, np.max)]) for view in (space.BELOW, space.ABOVE)]
        below, above = render.images(faces, values, 1, np.array([(0, 0, 1), (1, 0, 0)]), list(zip((space.BELOW, space.ABOVE), windows)))
        for image, red, (low, high) in ((below, 0, windows[0]), (above, 0.15, windows[1])):
            self.assertEqual(max(image.shape[:2]), render.PIXELS)
            self.assertAlmostEqual(image.shape[1] / image.shape[0], *(high - low)[:1] / (high - low)[1:], delta=0.01)
            is_red, is_white = (image[..., 0] > 1.5 * image[..., 2].astype(float)), (image == 255).all(axis=-1)
            self.assertTrue(red <= is_red.mean() < red + 0.1 and 0.1 < is_white.mean() < 0.5, (is_red.mean(), is_white.mean()))
        self.assertTrue((above[..., 0] > above[..., 2])[:450].any() and not (above[..., 0] > above[..., 2])[600:].any())  # up is up
        axes, remarks = drawn(plot.body, solve("slab", "Adaptivity/Maximum steps=2"))
        self.assertIn("from above", remarks[0])
        for image in axes.images:
            self.assertGreater(len(np.unique(image.get_array().reshape(-1, 3), axis=0)), 200)

    @unittest.skipUnless(HAS_VTK, "python3-vtk9 or xvfb is not installed")
    def test_vtk_that_fails(self):
        """In a process of its own: this one goes on, with a line that has the remedy."""
        run = solve("slab", "Adaptivity/Maximum steps=2")
        with mock.patch.object(render.shutil, "which", lambda name: None), mock.patch.dict(os.environ, {"DISPLAY": ":987"}):
            self.assertEqual(drawn(plot.body, run)[1][1], "VTK draws it from two sides: VTK finds no display; install xvfb")
        with mock.patch.object(render, "__file__", "/dev/null"):
            self.assertRegex(drawn(plot.body, run)[1][1], "VTK failed .*; install python3-vtk9 anew")
        with mock.patch.object(render.sys, "executable", "/none"):
            self.assertRegex(drawn(plot.body, run)[1][1], "VTK cannot be run .*; install python3-vtk9 anew")
        with mock.patch.object(render, "SECONDS", 0.01):
            self.assertRegex(drawn(plot.body, run)[1][1], "VTK took more than .* take a smaller run")

    def test_colours_are_told_apart_without_red_or_green(self):
        def seen(colour, blindness):
            rgb = np.array(matplotlib.colors.to_rgb(colour))
            linear = np.array(blindness) @ np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
            return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear.clip(1e-9, 1) ** (1 / 2.4) - 0.055)

        lines = (plot.BLUE, plot.ORANGE, plot.BLACK, plot.GREEN)
        for colours, blindness in itertools.product((plot.STATES.values(), plot.DEGREES, MATERIALS, lines), BLINDNESS):
            for one, other in itertools.combinations(colours, 2):
                self.assertGreater(np.linalg.norm(seen(one, blindness) - seen(other, blindness)), 0.12, f"{one} and {other}")


class Page(unittest.TestCase):
    """What its reader needs, an item each."""

    def tearDown(self):
        plt.close("all")

    def test_it_is_whole_and_needs_nothing_but_itself(self):
        text = report.page(solve("two feet"))
        self.assertTrue(text.startswith("<!-- the run, told by hpvi -->") and text.endswith("</html>"))
        self.assertNotRegex(text, r'(src|href)="(?!data:)|https?://(?!www\.w3\.org)|<script|\bnan\b|None\b(?!\.)')

    def test_the_first_line_has_the_error_and_its_word(self):
        for run, words_of_error in ((solve(*PUNCH), "at most .* % of the solution, guaranteed"), (solve("slab", "Adaptivity/Maximum steps=2"), "at most .* % of the solution, guaranteed"),
                                    (solve("slab", "Adaptivity/Maximum steps=2", "Error/Bound=false"), "about .* % .*, estimated by")):
            self.assertRegex(page_of(run)[0].split("<p")[1], words_of_error)

    def test_intervals_are_named_where_there_are_some(self):
        self.assertIn("±: intervals, guaranteed", page_of(solve(*PUNCH))[0])
        self.assertNotIn("±", page_of(solve("slab", "Adaptivity/Maximum steps=2", "Error/Bound=false"))[0])

    def test_done_is_said_once_and_not_where_a_tolerance_is_missed(self):
        text, _ = page_of(solve(*PUNCH))
        self.assertRegex(text, r"Done: stopped by Maximum steps of Adaptivity")
        self.assertEqual(text.count("Done"), 1)
        text, _ = page_of(solve("two feet"))
        self.assertIn("is not met", text)
        self.assertNotIn("Done", text)

    def test_pressure_is_readable_beside_a_singular_end(self):
        line, = solve(*PUNCH).lines
        axes, remarks = drawn(plot.contact, solve(*PUNCH), line)
        end, largest = axes.get_ylim()[1], line.pressure.max()
        self.assertLess(end, 0.2 * largest)
        self.assertGreater(end, np.median(line.pressure[line["state"] != "open"]))
        marks = [tuple(one.get_xydata()[0]) for one in axes.lines if one.get_marker() == "^"]
        self.assertIn((line.s[line.pressure.argmax()], end), marks)  # what lies beyond
        self.assertIn(f"pressure {words.digits(largest, 3)}", [text.get_text() for text in axes.texts])
        self.assertTrue(any("beyond the axis" in one and words.digits(largest, 3) in one for one in remarks))

    def test_what_is_not_open_fills_the_chart(self):
        """A millimetre of thirty, and the whole is a strip."""
        line, = solve(*PUNCH).lines
        axes, remarks = drawn(plot.contact, solve(*PUNCH), line)
        low, high = axes.get_xlim()
        closed = [end for state, _, end in line.stretches() if state != "open"]
        self.assertTrue(max(closed) < high < 1.5 * max(closed) and high < 0.6 * line.s[-1], (max(closed), high, line.s[-1]))
        strip, = axes.child_axes
        self.assertEqual(strip.get_xlim(), (line.s[0], line.s[-1]))
        self.assertIn((low, high), [(box.xmin, box.xmax) for box in (patch.get_xy() for patch in strip.patches) for box in [matplotlib.transforms.Bbox([box.min(0), box.max(0)])]])
        self.assertTrue(any("strip" in one for one in remarks))

    def test_pieces_of_a_side_are_apart(self):
        line, = solve("two feet").lines
        self.assertEqual(len(line.starts), 1)
        axes, _ = drawn(plot.contact, solve("two feet"), line)
        x = line_named(axes, "pressure").get_xdata()
        self.assertEqual(np.isnan(x).sum(), 1)  # no line joins the feet
        self.assertEqual(len(results.breaks(line.x)), 1)  # also where nothing but points is known
        self.assertFalse(any(begin < 5 < end for _, begin, end in line.stretches()))

    def test_each_body_has_its_contact_line(self):
        run = solve("blocks", *FEW)
        line = run.lines[0]
        axes, _ = drawn(plot.body, run, scale=1)
        paths = [one for one in axes.lines if one.get_gid() == f"state of {line.name}"]
        x, u = plot.opposite(line, plot.motion(run, line))
        ends = {tuple(np.round(point, 9)) for one in paths for point in one.get_xydata()}
        for places in (line.x + line["displacement"], x + u):
            self.assertTrue({tuple(np.round(point, 9)) for point in places} <= ends)
        np.testing.assert_allclose(u, line["displacement"] - line["jump"], atol=1e-9 * abs(u).max())

    def test_zones_are_a_table(self):
        run = solve("two feet")
        table, zones = report.Teller(run).zones(), run.summary["contact"]["feet"]["zones"]
        self.assertEqual([(row[0], row[1], float(row[4])) for row in table.rows], [("feet", zone["state"], float(words.digits(zone["length"], report.Teller(run).number.n))) for zone in zones])
        for zone in zones:
            self.assertIn(f"<td>feet</td><td>{zone['state']}</td><td>", page_of(run)[0])

    def test_round_off_is_0(self):
        run = solve("two feet")
        self.assertNotEqual(run.summary["final"]["normal_ux"], 0)
        self.assertRegex(page_of(run)[0], r"<td>normal</td><td>0</td>")
        number = words.Numbers(1e-3, 4.)
        for shown in (number(1e-17, largest=5.), number(1e-13, half=4e-13, largest=5.)):
            self.assertEqual(shown, "0")
        self.assertEqual(number.vector((1e-8, -2e-8, 3.), "N"), "(0, 0, 3) N")
        # Friction of a washer that nothing pushes along, in space.
        contact = {"force": (1e-8, 1e4, -2e-8), "normal_resultant": -1e4, "friction_resultant": [1e-8, 0, -2e-8]}
        self.assertIn("friction (0, 0, 0)", report.Teller(run).of_contact("feet", contact))

    def test_no_more_digits_than_are_certain(self):
        for error in (0.2, 0.03, 1e-3, 4e-5):
            value = words.Numbers(error, 1.)(1 / 7)
            self.assertGreaterEqual(7 * 10. ** (2 - len(value)), 0.1 * error, value)  # the last digit beside the whole
            self.assertLess(abs(float(value) * 7 - 1), error)
        number = words.Numbers(1e-3, 4.)
        for shown, expected in ((number(0.123456, "mm"), "0.1235 mm"), (number(4.813676, "N", 0.00037), "4.81368 ± 0.00038 N"), (number(-5151.48, half=2450.), "-5200 ± 2500"),
                                (number.place([1, -2e-14]), "(1, 0)"), (words.at_most(0.01006), "0.011"), (words.interval(-0.5, 6.6e-14), "-0.5 ± 1e-12")):
            self.assertEqual(shown, expected)
        run = solve(*PUNCH)
        shown = words.digits(run.summary["largest_displacement"]["value"], report.Teller(run).number.n)
        self.assertIn(f"Largest displacement:</b> {shown}", page_of(run)[0])

    def test_singular_corners_are_all_named_or_counted(self):
        self.assertRegex(page_of(solve("two feet"))[0], r"it is unbounded at \(2, 0\), \(8, 0\)")
        peaks = [{"at": [k, 0], "beyond": 0.1} for k in range(9)]
        self.assertIn("(5, 0) and 3 places more", report.Teller(solve("two feet")).of_peaks("it", peaks, [], []))

    def test_the_largest_stress_is_away_from_all_of_them(self):
        peaks = [{"at": [0, 0], "beyond": 1, "largest": 9., "largest_at": [3., 0]}, {"at": [3, 0], "beyond": 1, "largest": 8., "largest_at": [0., 0.5]}]
        x = np.array([[0, 0.5], [3, 0], [1.5, 0], [1.6, 0]])
        value, place = report.beyond(x, np.array([8., 9, 2, 3]), peaks)
        self.assertEqual((value, list(place)), (3, [1.6, 0]))

    def test_a_largest_pressure_where_forces_cancel(self):
        run = solve("press-ring", *FEW)
        contact = run.summary["contact"]["outer"]
        self.assertLess(max(map(abs, contact["force"])), 1e-9 * contact["largest_pressure"])
        self.assertIn(f"pressure up to {report.Teller(run).number(contact['largest_pressure'])} N/mm²", page_of(run)[0])

    def test_degrees_are_whole(self):
        run = solve(*PUNCH)
        axes, _ = drawn(plot.mesh, run)
        bar, = [one for one in axes.figure.axes if one is not axes]
        ticks = [text.get_text() for text in bar.get_xticklabels() + bar.get_yticklabels() if text.get_text()]
        self.assertEqual([float(tick) for tick in ticks], list(range(run.mesh.degrees.min(), run.mesh.degrees.max() + 1)))
        table = report.Teller(run).steps()
        for row in table.rows:
            if row[0] != "…":
                self.assertTrue(row[table.head.index("p from")].isdigit() and row[table.head.index("to")].isdigit())

    def test_load_steps_are_in_one_chart(self):
        run = solve(*LOOP)
        axes, _ = drawn(plot.load_steps, run, "bottom", "friction")
        last = axes.lines[-1].get_ydata()
        np.testing.assert_array_equal(last[np.isfinite(last)], run.contact["tangential_traction"])
        self.assertEqual([line.get_label() for line in axes.lines], [str(k) for k in range(1, 7)])

    def test_probes_are_read_by_their_own_columns(self):
        """Of two that are called as columns begin."""
        run = solve("two feet")
        own = run.probes()
        self.assertEqual(set(own), {"normal", "p"})
        self.assertEqual(own["p"]["ux"][0], run.summary["final"]["p_ux"])
        self.assertEqual(set(own["normal"]), {"ux", "uy", "s1", "s2", "szz", "mises"})

    def test_what_is_missing_is_said(self):
        text, _ = page_of(solve("han-6-12", "Adaptivity/Maximum steps=2", "Output/VTU=false", "Output/Contact tables=false"))
        for expected in ("set Output/VTU = true", "set Output/Contact tables = true", "there is no scene.json"):
            self.assertIn(expected, text)


if __name__ == "__main__":
    unittest.main()
