# SPDX-License-Identifier: LGPL-2.1-or-later
"""report.py HPVI: report.html is valid, needs nothing but itself, holds the numbers of summary.json, and is the same whether a run
writes it or --report afterwards."""

import base64
import math
import re
import struct
import unittest
import zlib

import html5lib

from charts import RESOLUTION, charts
from runs import SCENES, RunTest

SHORT = "Adaptivity/Maximum steps=4"
# Of each kind: a bound, a load history, two bodies, a plate, space. Which charts each has, and what makes it short.
SCENES_OF_ALL_KINDS = (
    ("han-6-12", {"contact", "convergence"}, SHORT),
    ("fretting", {"contact", "convergence", "energies", "loop", "slip"}, "Loading/Steps=5", "Adaptivity/Maximum steps=2", "Boundary bottom/Wear coefficient=1e-6"),
    ("lap-joint", {"contact", "convergence", "energies", "loop", "slip"}, "Loading/Steps=4", "Adaptivity/Maximum steps=2",
     "Boundary upper strap.right/Displacement=0.04*sin(2*pi*t); -0.001"),  # what moves once and stays there has no loop
    ("punch-plate", {"contact", "convergence"}, "Adaptivity/Maximum steps=2"),
    ("dome", set(), "Adaptivity/Maximum steps=1"))
# Members of summary.json whose numbers the page shows with six digits.
SHOWN = (("final", "elements"), ("final", "dofs_free"), ("final", "multipliers"), ("final", "energy"), ("contact",), ("forces",),
         ("largest_displacement",), ("loading",), ("error_bound", "energy"), ("plates",))
# Beside a force with an interval its value has so many digits as that; areas and tensors of contact are zones there.
HIDDEN = {"normal_resultant", "friction_resultant", "area", "open_area", "slipping_area", "moments_about", "length", "moment", "loads",
          "through"}


def numbers_in(value, key=""):
    if key in HIDDEN:
        return
    if isinstance(value, dict):
        for name, part in value.items():
            yield from numbers_in(part, name)
    elif isinstance(value, list):
        for part in value:
            yield from numbers_in(part, key)
    elif isinstance(value, (int, float)) and value is not None and not isinstance(value, bool):
        yield value


def words_of(page):
    """All that a reader sees, without the scene file."""
    short = re.sub(r'base64,[A-Za-z0-9+/=]+|(?<= d=")[^"]+', "", page)  # so much of it is pictures that reading them takes seconds
    tree = html5lib.HTMLParser(strict=True, namespaceHTMLElements=False).parse(short)
    for parent in tree.iter():
        for child in list(parent):
            if child.tag in ("style", "pre"):
                parent.remove(child)
    return " ".join(tree.itertext())


class Report(RunTest):
    def check_page(self):
        page = self.page()
        self.assertLess(len(page), 1_000_000)
        for word in ("<script", "<link", "@import", "url("):
            self.assertNotIn(word, page)
        # No expression that begins with any letters: on pictures in base64 that takes seconds.
        self.assertEqual(set(re.findall(r'(?:xmlns=")?https?:[^"\s]*', page)) - {'xmlns="http://www.w3.org/2000/svg'}, set())
        words = words_of(page)
        found = {float(word) for word in re.findall(r"-?\d+\.?\d*(?:[eE][-+]?\d+)?", words)}
        summary = self.summary()
        for path in SHOWN:
            value = summary
            for name in path:
                value = (value or {}).get(name)
            if path == ("forces",) and summary["error_bound"]:
                continue  # with intervals, and as many digits as these say
            for number in numbers_in(value):
                small = abs(number) < 1e-9  # round-off of another digit on each machine
                self.assertTrue(small or any(math.isclose(number, shown, rel_tol=1e-5) for shown in found), (path, number))
        for warning in summary["warnings"]:
            self.assertIn(" ".join(warning.split()), " ".join(words.split()))
        return page, summary

    def check_line(self, chart, name, points):
        """Each point of the data lies on the line, and each corner of the line is one of them, to the resolution of the picture."""
        difference, cut_off = chart.differences(name, points)
        self.assertLess(difference, RESOLUTION, (chart.caption, name))
        # Of the values at a singularity some do not fit; the caption says so.
        self.assertLessEqual(cut_off, 2 + 0.06 * len(points), (chart.caption, name))
        self.assertTrue(cut_off == 0 or "larger than the chart" in chart.caption, (chart.caption, name))

    def check_contact_chart(self, chart, rows, units):
        """Pressure is positive where a body is pressed, friction has the sign of the table."""
        summary, boundary = self.summary()["contact"], rows[0]["boundary"]
        at = (summary.get(boundary) or summary[f"{boundary} ({rows[0]['contact']})"])["zones"][0]["from"]
        lengths = []
        for row in rows:
            place = (float(row["x"]), float(row["y"]))
            lengths.append(math.dist(at, place) + (lengths[-1] if lengths else 0))
            at = place
            self.assertIn(row["state"], chart.states_at(lengths[-1]))
        self.assertEqual((chart.x_label, chart.y_label), (f"arc length{units[0]}", f"traction{units[1]}"))
        self.check_line(chart, "pressure -T_n", [(x, -float(row["normal_traction"])) for x, row in zip(lengths, rows)])
        friction = [(x, float(row["tangential_traction"])) for x, row in zip(lengths, rows)]
        self.assertEqual("friction T_t" in chart.lines, any(t for _, t in friction))
        if "friction T_t" in chart.lines:
            self.check_line(chart, "friction T_t", friction)

    def check_history_chart(self, chart, name):
        columns = {"pressure": "pressure_max", "shear": "shear_max", "path": "slip_path", "range": "slip_range", "depth": "wear_depth"}
        rows = [row for row in self.rows("contact-history.csv") if (row.get("contact") or row["boundary"]) == name]
        summary, boundary = self.summary()["contact"], rows[0]["boundary"]
        at = (summary.get(boundary) or summary[f"{boundary} ({name})"])["zones"][0]["from"]
        length, places = 0, []
        for row in rows:
            place = (float(row["x"]), float(row["y"]))
            length += math.dist(at, place)
            places.append(length)
            at = place
        self.assertTrue(chart.lines)
        for words in chart.lines:
            self.check_line(chart, words, [(x, float(row[columns[words]])) for x, row in zip(places, rows)])

    def check_charts(self, page):
        """Against the tables of the same run: contact, history, convergence. Returns what there was."""
        seen = set()
        contacts, loads = {}, self.rows("loading.csv") if "loading.csv" in self.names() else None
        for row in self.rows(max(name for name in self.names() if re.fullmatch(r"contact-\d+.csv", name))):
            if "z" not in row:  # in space a contact is a picture
                contacts.setdefault(row.get("contact") or row["boundary"], []).append(row)
        units = [f" [{unit}]" if unit not in ("", "1") else "" for unit in self.summary()["units"].values()]
        for chart in charts(page):
            if chart.caption.startswith("Contact "):
                name = re.match("Contact (.*?)( \\(.*\\))? over its arc length", chart.caption)[1]
                self.check_contact_chart(chart, contacts.pop(name), units)
                seen.add("contact")
            elif chart.caption.startswith("Load history: over"):
                name = re.match("Load history: over the arc length of contact (.*?)( \\(.*\\))?, up", chart.caption)[1]
                self.check_history_chart(chart, name)
                seen.add("slip")
            elif chart.caption.startswith("Load history: work"):
                self.assertEqual((chart.x_label, chart.y_label), ("t", "energy [N mm]"))
                for name, column in (("work", "work"), ("stored", "stored_energy"), ("dissipated", "dissipated_energy")):
                    self.check_line(chart, name, [(float(row["t"]), float(row[column])) for row in loads])
                seen.add("energies")
            elif chart.caption.startswith("Load history: force"):
                direction, boundary = re.match(r"u(.) of (.+) \[mm\]", chart.x_label).groups()
                self.assertEqual((direction, chart.y_label), ("x", f"force x on {boundary} [N]"))
                self.check_line(chart, "", [[float(row[f"{of}_{boundary}_{direction}"]) for of in ("displacement", "force")]
                                            for row in loads])
                seen.add("loop")
            else:
                self.assertTrue(chart.caption.startswith("How the error falls"))
                over, words = (float, "step") if loads else (math.log10, "free unknowns (logarithm of base 10)")
                self.assertEqual((chart.x_label, chart.y_label), (words, "relative to the solution"))
                column = "step" if loads else "dofs_free"
                rows = self.rows()
                of_energy = {row.get("bound_kind") for row in rows} <= {None, "", "energy"}
                for row in rows:
                    if not of_energy and row.get("bound_kind"):
                        row["equilibrated"] = float(row["error_estimate_equilibrated"]) / float(row["energy_norm"])
                bound = "guaranteed bound" if of_energy else "bound, if the coupling is as estimated"
                names = {bound: "error_bound_relative", "estimate by equilibrated stress": "equilibrated",
                         "indicator (no bound)": "estimate_relative", "true error": "error_relative"}
                for name, of in names.items():
                    points = [(over(float(row[column])), float(row[of])) for row in rows if row.get(of)]
                    self.assertEqual(name in chart.lines, len(points) > 1)
                    if name in chart.lines:
                        self.check_line(chart, name, points)
                self.assertLessEqual(set(chart.lines), set(names))
                seen.add("convergence")
        self.assertEqual(contacts, {})
        return seen

    def test_of_all_kinds(self):
        for scene, of, *settings in SCENES_OF_ALL_KINDS:
            with self.subTest(scene):
                self.run_scene(*settings, scene=SCENES / f"{scene}.prm")
                page, summary = self.check_page()
                self.assertIn("report.html", self.files())
                self.assertIn("Done: ", page)
                self.assertGreaterEqual(page.count("<figure>"), 2 if scene == "dome" else 4)
                bound = summary["error_bound"]
                is_of_energy = bool(bound and bound["guaranteed"])
                self.assertEqual(is_of_energy, "guaranteed" in page.split("<h2>The scene")[0].split("no bound")[0])
                self.assertEqual(is_of_energy, summary["final"]["bound_kind"] == "energy")
                if bound:
                    said = float(re.search(r"error is at most (\S+) % of the solution", page)[1])
                    self.assertGreaterEqual(said, 100 * bound["relative"])
                    self.assertLess(said, 111 * bound["relative"])
                self.assertEqual(self.check_charts(page), of)
                self.assertGreater(summary["seconds"]["report"], 0)
                # What is round-off is 0.
                self.assertNotRegex(page.split("<h2>Forces")[1].split("</table>")[0], r"e-1\d")
                # Small on paper, so that there are two pages.
                self.assertEqual('<body class="many">' in page, page.count("<figure>") > 6)
                if scene == "lap-joint":
                    self.assertRegex(page, r"normal resultant -\S+ N, friction \S+ N, force \(\S+, \S+\) N through")
                    self.assertIn("Forces [N] and moments [N mm] on the body", page)
                # One source: what the files hold tells the same.
                self.assertIn(f"report in {self.out}/report.html", self.afterwards())
                self.assertEqual(self.page(), page)
                if scene == "han-6-12":
                    self.check_equal_run(page, *settings)

    def test_probes_have_their_own_columns(self):
        """Other columns begin with the same words: p_max, normal_resultant_bound, error_bound, condition_raw."""
        names = ("p", "normal", "friction", "error", "qp", "condition", "coulomb", "newton", "tip")
        self.run_scene(SHORT, *(f"Probe {name}/At={k / 4}, 1" for k, name in enumerate(names)))
        page, row = self.page(), self.rows()[-1]
        for name in names:
            said = re.sub("<[^>]*>", "", page.split(f"Probe {name}:")[1].split("</li>")[0]).strip(" .\n").split(", ")
            self.assertEqual([words.split()[0] for words in said], ["ux", "uy", "s1", "s2", "szz", "mises"], name)
            for words in said:
                column, value = words.split()[:2]
                self.assertTrue(math.isclose(float(value), float(row[f"{name}_{column}"]), rel_tol=1e-5, abs_tol=1e-9), (name, words))

    def check_equal_run(self, page, *settings):
        self.run_scene(*settings)
        lines = [page.splitlines(), self.page().splitlines()]
        self.assertEqual(*map(len, lines))
        different = [one for one, other in zip(*lines) if one != other]
        self.assertEqual([line[:17] for line in different], ['<p class="times">'])

    def test_what_was_switched_off_is_said(self):
        self.run_scene(SHORT, "Output/VTU=false", "Output/Mesh picture=false", "Output/Contact tables=false", "Error/Bound=false",
                       "Material soft/Where=x < 1", "Material soft/Young's modulus=10")
        page, _ = self.check_page()
        # What the second material leaves to the first is not printed.
        self.assertRegex(page, r'<span class="default">\s*set Poisson.s ratio *=\s*</span>')
        for entry in ("Output/VTU = true", "Output/Mesh picture = true", "Output/Contact tables = true"):
            self.assertIn(entry, page)
        self.assertNotIn("guaranteed", page.split("<h2>The scene")[0].replace("No bound is guaranteed", ""))

    def stress_picture(self):
        """The drawing; the pixels of its picture by rows, without the outline: 0 is paper."""
        drawing = self.page().split("<!-- stress -->")[1].split("</svg>")[0]
        png = base64.b64decode(re.search(r"base64,([^\"]+)", drawing)[1])
        width, height = struct.unpack(">II", png[16:24])
        colours = png.index(b"PLTE")
        outline = struct.unpack(">I", png[colours - 4:colours])[0] // 3 - 1  # the last colour
        rows = zlib.decompress(png[png.index(b"IDAT") + 4:-16])
        self.assertEqual(len(rows), (width + 1) * height)
        return drawing, outline, [rows[y * (width + 1) + 1:(y + 1) * (width + 1)] for y in range(height)]

    def test_uniform_stress_has_one_colour_and_a_scale(self):
        """Round-off is no pattern: sigma_xx = 3 everywhere, to the last digits."""
        self.run_scene(scene=self.bar())
        drawing, outline, rows = self.stress_picture()
        self.assertEqual(len(set().union(*rows) - {0, outline}), 1)
        ticks = re.findall(r">([\d.]+)</text>", drawing)
        self.assertEqual((ticks[0], ticks[-1]), ("0", "3"))

    def test_stress_has_no_holes(self):
        """Edges that hang bend, and are painted by other polygons from either side."""
        self.run_scene("Adaptivity/Maximum steps=12")
        _, _, rows = self.stress_picture()
        holes = [(x, y) for y in range(1, len(rows) - 1) for x in range(1, len(rows[y]) - 1)
                 if rows[y][x] == 0 and rows[y][x - 1] and rows[y][x + 1] and rows[y - 1][x] and rows[y + 1][x]]
        self.assertEqual(holes, [])

    def test_hidden_faces_stay_hidden(self):
        """In space three sides are seen, each with a shade of its own, and nothing of the faces inside."""
        self.run_scene("Adaptivity/Maximum steps=2", scene=SCENES / "dome.prm")
        _, outline, rows = self.stress_picture()
        shades = [[(pixel - 1) // 24 if pixel not in (0, outline) else None for pixel in row] for row in rows]
        odd = sum(row[x] is not None and row[x] != row[x - 1] == row[x + 1] is not None for row in shades for x in range(1, len(row) - 1))
        self.assertLess(odd, 1e-3 * sum(map(len, rows)))

    def test_a_failed_run_comes_first(self):
        self.run_scene("Solver/QP maximum multiplications=20", "Solver/QP solver=mprgp", "Solver/QP warm start=false", status=2)
        self.assertEqual(self.summary()["status"], "failed")
        self.assertIn("report.html", self.files())
        page = self.page()
        words_of(page)
        self.assertIn('<p class="failed">This run failed: ', page)
        self.assertLess(page.index("This run failed"), page.index("<h2>"))
        self.assertIn("no result", page.split("<h2>")[0])
        self.assertNotIn("Done", page)


if __name__ == "__main__":
    unittest.main()
