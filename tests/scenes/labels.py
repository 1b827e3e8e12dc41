# SPDX-License-Identifier: LGPL-2.1-or-later
"""labels.py HPVI: titles and units of any bytes, none at all, and bodies far from the origin leave
files that parsers read and numbers that tell points apart."""

import math
import unittest
import xml.etree.ElementTree as ElementTree

from runs import BAR, RunTest, read_vtu

FAR = 1e6


class Labels(RunTest):
    def run_text(self, text):
        """The bar with these lines before it; its printed title."""
        scene = self.home / "bar.prm"
        scene.write_bytes(text + BAR.encode())
        printed = self.run_scene(scene=scene)
        return printed.splitlines()[1]

    def test_titles_of_any_bytes(self):
        titles = {b"Gr\xf6\xdfe": "Größe", "Größe 三".encode(): "Größe 三",
                  b"a\x01b\x1b[31mc\td\x7fe": "a b [31mc d e", b"\"<&>\\ 'n": "\"<&>\\ 'n",
                  b"a\xed\xa0\x80b\xc0\x80c\xffd": "aí\u00a0 bÀ cÿd",
                  b"end\xe2\x82": "endâ ", "c1\u0085, \uffff".encode(): "c1 , \ufffd",
                  "\U0001f600".encode(): "\U0001f600"}
        for title, shown in titles.items():
            printed = self.run_text(b"set Title = " + title + b"\n")
            self.assertEqual(printed.rstrip(), shown.rstrip())
            self.assertEqual(self.summary()["title"].rstrip(), shown.rstrip())
            read_vtu(self.out / "solution-01.vtu")

    def test_a_byte_order_mark_is_no_part_of_the_first_line(self):
        self.assertEqual(self.run_text(b"\xef\xbb\xbfset Title = marked\n").rstrip(), "marked")

    def test_a_title_from_the_name_of_a_file_survives_scene_prm(self):
        for name, title in (("a#b", "a_b"), ("ends\\", "ends_"), ("two\nlines", "two_lines")):
            scene = self.home / f"{name}.prm"
            scene.write_text(BAR)
            self.run_scene(scene=scene)
            self.assertEqual(self.summary()["title"], title)
            again = self.home / "again"
            self.run_scene(scene=self.out / "scene.prm", output=again)
            self.assertEqual((again / "scene.prm").read_text(), (self.out / "scene.prm").read_text())

    def test_units_of_any_bytes(self):
        self.run_text(b"subsection Units\nset Length = \xb5\x02m\nset Stress = <\xb5&\"\nend\n")
        self.assertEqual(self.summary()["units"], {"length": "µ m", "stress": "<µ&\""})
        fields = {field.get("Name"): field.get("units") for field in
                  ElementTree.parse(self.out / "solution-01.vtu").iter("DataArray")}
        self.assertEqual((fields["displacement"], fields["von_mises"]), ("µ m", "<µ&\""))
        keys = {field.get("Name"): field.find("InformationKey[@name='UNITS_LABEL']") for field in
                ElementTree.parse(self.out / "solution-01.vtu").iter("DataArray")}
        self.assertEqual((keys["displacement"].text, keys["von_mises"].text), ("µ m", "<µ&\""))
        self.assertIsNone(keys["degree"])

    def test_no_units_are_no_label(self):
        self.run_text(b"")
        self.assertEqual(self.summary()["units"], {"length": "", "stress": ""})
        for words in (b"units=", b"UNITS"):
            self.assertNotIn(words, (self.out / "solution-01.vtu").read_bytes())
        self.run_scene("Units/Length=", "Units/Stress=", "Adaptivity/Maximum steps=2")
        self.assertRegex(" ".join(self.summary()["warnings"]), r"tensile, up to [0-9.]+ at \(")

    def test_shipped_units_are_named_by_the_scenes(self):
        for name, units in (("han-6-12", ("mm", "kN/mm^2")), ("han-6-13", ("mm", "kN/mm^2")),
                            ("semicoercive", ("mm", "kN/mm^2")), ("smooth", ("1", "E"))):
            self.run_scene("Adaptivity/Maximum steps=1", scene=self.scene.parent / f"{name}.prm")
            self.assertEqual(tuple(self.summary()["units"].values()), units)


class Coordinates(RunTest):
    def run_bar(self, x, y, *settings):
        self.run_scene(f"Geometry/Lower corner={x!r}, {y!r}",
                       f"Geometry/Upper corner={x + 2!r}, {y + 1!r}", *settings, scene=self.bar())
        return read_vtu(self.out / "solution-01.vtu")["points"]

    def test_far_bodies_keep_their_points(self):
        thirds = "Geometry/Subdivisions=3, 1"  # no short binary fractions, which any rounding keeps
        near = self.run_bar(0., 0., thirds)
        for k, x in enumerate(sorted({round(x, 12) for x, y, z in near})):
            self.assertLess(abs(x - k / 3), 1e-12)
        far = self.run_bar(FAR, -FAR, thirds)
        self.assertEqual(len(near), len(far))
        for (x, y, _), (far_x, far_y, z) in zip(near, far):
            self.assertLess(abs(far_x - FAR - x), 1e-9)
            self.assertLess(abs(far_y + FAR - y), 1e-9)
            self.assertEqual(z, 0)

    def test_deep_cells_keep_their_size(self):
        self.run_scene("Geometry/Graded towards=2, 0", "Geometry/Grading levels=36",
                       scene=self.bar())
        grid = read_vtu(self.out / "solution-01.vtu")
        areas = []
        for cell in grid["cells"]:
            corners = [grid["points"][k] for k in cell[:4]]
            areas.append(sum(a[0] * b[1] - a[1] * b[0]
                             for a, b in zip([(x - 2, y) for x, y, _ in corners],
                                             [(x - 2, y) for x, y, _ in corners[1:] + corners[:1]]))
                         / 2)
        self.assertGreater(min(areas), 0)
        self.assertTrue(math.isclose(math.fsum(areas), 2, rel_tol=1e-12))
        self.assertLess(min(areas), 1e-20)


if __name__ == "__main__":
    unittest.main()
