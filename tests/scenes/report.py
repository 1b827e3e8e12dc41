# SPDX-License-Identifier: LGPL-2.1-or-later
"""report.py HPVI: charts show what the tables hold, and the page says what its reader needs; all drawn in one process. Status 77 without matplotlib."""

import base64
import importlib.util
import pathlib
import re
import sys
import unittest
import xml.etree.ElementTree as ElementTree

from runs import PROGRAM, SCENES, RunTest

NEEDED = ("matplotlib", "jinja2")
if any(importlib.util.find_spec(name) is None for name in NEEDED):
    print("skipped: matplotlib or jinja2 is not installed")
    sys.exit(77)
sys.path.insert(0, str(pathlib.Path(PROGRAM).resolve().parent / "python"))
import matplotlib  # noqa: E402
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from hpvi import plot, report, results, words  # noqa: E402

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


def drawn(function, *arguments, **options):
    figure, axes = plot.figure()
    remarks = function(*arguments[:1], axes, *arguments[1:], **options)
    figure.canvas.draw()
    plt.close(figure)
    return axes, remarks


def line_named(axes, name):
    return next(line for line in axes.lines if line.get_label() == name)


class Report(RunTest):
    def tearDown(self):
        plt.close("all")
        super().tearDown()

    def solve(self, name=None, *settings, text=None):
        scene = SCENES / f"{name}.prm"
        if text:
            scene = self.home / "mine.prm"
            scene.write_text(text)
        self.run_scene(*settings, scene=scene)
        return results.Run(self.out)

    def page_of(self, run):
        """It is whole, and needs nothing but itself."""
        text = report.page(run)
        self.assertTrue(text.startswith("<!-- the run, told by hpvi -->") and text.endswith("</html>"))
        self.assertNotRegex(text, r'(src|href)="(?!data:)|https?://(?!www\.w3\.org)|<script|\bnan\b|None\b(?!\.)')
        pictures = re.findall(r"data:image/svg\+xml;base64,([^\"]*)", text)
        for picture in pictures:
            ElementTree.fromstring(base64.b64decode(picture))
        return re.sub("base64,[^\"]*", "", text), len(pictures)

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
        """Of ten scenes; one of them has two contacts, one a history, one is axisymmetric."""
        for name, more in (("han-6-12", ()), ("punch", ()), ("hertz", ()), ("receding", ()), ("brake-pad", ()), ("press-ring-axi", ()),
                           ("jaws", ()), ("seal", ()), ("fretting", ("Loading/Steps=4",)), ("bolted-flange", ("Loading/Steps=2",))):
            with self.subTest(name):
                run = self.solve(name, *FEW, *more)
                self.check_contact(run)
                self.check_convergence(run)
                axes, _ = drawn(plot.mesh, run)
                np.testing.assert_array_equal(axes.collections[0].get_array(), run.mesh.degrees)
                self.assertEqual(sum(run.degrees[f"p{p}"][-1] for p in np.unique(run.mesh.degrees)), len(run.mesh.degrees))
                bar, = [one for one in axes.figure.axes if one is not axes]
                ticks = [float(text.get_text()) for text in bar.get_xticklabels() + bar.get_yticklabels() if text.get_text()]
                self.assertTrue(all(tick == int(tick) for tick in ticks))  # whole degrees
                text, n_pictures = self.page_of(run)
                self.assertGreaterEqual(n_pictures, 4)
                self.assertIn("mesh of the last step", text)

    def test_loads_over_displacements(self):
        run = self.solve("fretting", "Loading/Steps=6", *FEW)
        (boundary, component), = plot.loops(run)
        axes, _ = drawn(plot.loop, run, boundary, component)
        np.testing.assert_array_equal(axes.lines[0].get_xydata().T, [run.loading["displacement_top_x"], run.loading["force_top_x"]])
        axes, _ = drawn(plot.load_steps, run, "bottom", "friction")  # all load steps in one chart
        last = axes.lines[-1].get_ydata()
        np.testing.assert_array_equal(last[np.isfinite(last)], run.contact["tangential_traction"])
        self.assertEqual([line.get_label() for line in axes.lines], [str(k) for k in range(1, 7)])
        axes, _ = drawn(plot.energies, run)
        np.testing.assert_array_equal(line_named(axes, "work").get_ydata(), run.loading["work"])

    def test_a_singular_end(self):
        run = self.solve("punch", "Adaptivity/Maximum steps=14")
        line, = run.lines
        axes, remarks = drawn(plot.contact, run, line)
        largest = line.pressure.max()
        self.assertLess(axes.get_ylim()[1], 0.2 * largest)  # readable beside it
        self.assertTrue(any("beyond the axis" in one and words.digits(largest, 3) in one for one in remarks))
        low, high = axes.get_xlim()  # what is open is a strip
        self.assertTrue(high < 2.5 and axes.child_axes)
        text, _ = self.page_of(run)
        self.assertRegex(text, r"pressure is unbounded at \(1, 0\)")
        self.assertRegex(text, r"Done: stopped by Maximum steps of Adaptivity")
        self.assertEqual(text.count("Done"), 1)
        self.assertRegex(text.split("<p")[1], "at most .* guaranteed")  # the bar and its word come first

    def test_two_pieces_and_names_of_columns(self):
        run = self.solve(text=TWO_FEET)
        line, = run.lines
        self.assertEqual(len(line.starts), 1)
        axes, _ = drawn(plot.contact, run, line)
        x = line_named(axes, "pressure").get_xdata()
        self.assertEqual(np.isnan(x).sum(), 1)  # no line joins the feet
        self.assertEqual(len(results.breaks(line.x)), 1)  # also where nothing but points is known
        own = run.probes()
        self.assertEqual(set(own), {"normal", "p"})
        self.assertEqual(own["p"]["ux"][0], run.summary["final"]["p_ux"])
        self.assertEqual(set(own["normal"]), {"ux", "uy", "s1", "s2", "szz", "mises"})
        text, _ = self.page_of(run)
        self.assertIn("is not met", text)  # the tolerance, and "Done" nowhere
        self.assertNotIn("Done", text)
        self.assertRegex(text, r"it is unbounded at \(2, 0\), \(8, 0\)")  # all corners
        self.assertEqual(text.count("<td>feet</td><td>open</td>") + text.count("<td>feet</td><td>slip</td>"), len(run.summary["contact"]["feet"]["zones"]))
        self.assertIn("pressure", text.split("Contact feet")[1].split("</li>")[0])
        self.assertRegex(text, r"<td>normal</td><td>0</td>")  # round-off

    def test_the_largest_stress_is_away_from_all_peaks(self):
        peaks = [{"at": [0, 0], "beyond": 1, "largest": 9., "largest_at": [3., 0]}, {"at": [3, 0], "beyond": 1, "largest": 8., "largest_at": [0., 0.5]}]
        x = np.array([[0, 0.5], [3, 0], [1.5, 0], [1.6, 0]])
        value, place = report.beyond(x, np.array([8., 9, 2, 3]), peaks)
        self.assertEqual((value, list(place)), (3, [1.6, 0]))

    def test_numbers(self):
        number = words.Numbers(1e-3, 4.)
        for shown, expected in ((number(0.123456, "mm"), "0.1235 mm"), (number(1e-17, largest=5.), "0"), (number(4.813676, "N", 0.00037), "4.81368 ± 0.00038 N"),
                                (number(1e-13, half=4e-13, largest=5.), "0"), (number.place([1, -2e-14]), "(1, 0)"), (number(-5151.48, half=2450.), "-5200 ± 2500"),
                                (words.at_most(0.01006), "0.011"), (words.interval(-0.5, 6.6e-14), "-0.5 ± 1e-12")):
            self.assertEqual(shown, expected)

    def test_each_body_has_its_contact_line(self):
        run = self.solve("blocks", *FEW)
        line = run.lines[0]
        axes, _ = drawn(plot.body, run, scale=1)
        paths = [one for one in axes.lines if one.get_gid() == f"state of {line.name}"]
        x, u = plot.opposite(line, plot.motion(run, line))
        ends = {tuple(np.round(point, 9)) for one in paths for point in one.get_xydata()}
        for places in (line.x + line["displacement"], x + u):
            self.assertTrue({tuple(np.round(point, 9)) for point in places} <= ends)
        np.testing.assert_allclose(u, line["displacement"] - line["jump"], atol=1e-9 * abs(u).max())

    def test_in_space(self):
        run = self.solve("slab", "Adaptivity/Maximum steps=2")
        axes, _ = drawn(plot.surface, run, name="bottom", what="pressure")
        np.testing.assert_array_equal(axes.collections[0].get_array(), -run.contact["normal_traction"])
        text, n_pictures = self.page_of(run)
        self.assertIn("Scenes in space", text.replace("Of scenes in space", "Scenes in space"))
        self.assertGreaterEqual(n_pictures, 4)

    def test_what_is_missing_is_said(self):
        run = self.solve("han-6-12", "Adaptivity/Maximum steps=2", "Output/VTU=false", "Output/Contact tables=false")
        text, _ = self.page_of(run)
        for expected in ("set Output/VTU = true", "set Output/Contact tables = true", "there is no scene.json"):
            self.assertIn(expected, text)


if __name__ == "__main__":
    unittest.main()
