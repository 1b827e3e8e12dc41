# SPDX-License-Identifier: LGPL-2.1-or-later
"""pictures.py HPVI: --picture draws what a scene says, --validate says it in words, and both solve nothing. What they
refuse is in tests/bad_input."""

import importlib.util
import json
import re
import sys
import unittest
import xml.etree.ElementTree as ElementTree

from runs import BAR, PROGRAM, SCENES, RunTest, run_program


class PictureTest(RunTest):
    def run_with(self, option, *settings, scene=None, status=0, output=True):
        line = [PROGRAM, option, scene or self.scene] + (["--output", self.out] if output else [])
        for setting in settings:
            line += ["--set", setting]
        return self.said(status, *run_program(line, self.home))

    def draw(self, *settings, **options):
        """The texts of scene.json, beside the picture."""
        self.assertEqual(self.run_with("--picture", *settings, **options), f"picture in {self.out}/scene.svg\n")
        ElementTree.parse(self.out / "scene.svg")
        return json.loads((self.out / "scene.json").read_text())

    def write(self, text):
        scene = self.home / "mine.prm"
        scene.write_text(text)
        return scene


class Files(PictureTest):
    def test_a_picture_is_replaced_and_stays_beside_results(self):
        self.draw(scene=self.bar())
        self.run_scene(scene=self.bar())
        self.assertIn("scene.svg", self.names())
        self.assertIn("scene.svg", self.files())
        self.assertNotIn("scene.json", self.names())  # it told of what was there before
        drawn = ("scene.svg", "scene.json")
        results = {name: content for name, content in self.contents().items() if name not in drawn}
        self.assertEqual(self.draw("Title=another", scene=self.bar())["title"], "another")
        self.assertEqual({name: content for name, content in self.contents().items() if name not in drawn}, results)

    def test_a_foreign_picture_stays(self):
        self.out.mkdir()
        for content in ("mine", ""):
            (self.out / "scene.svg").write_text(content)
            line = self.run_with("--picture", status=1)
            for words in (f"output directory '{self.out}'", "its scene.svg would be overwritten", "--output"):
                self.assertIn(words, line)
            self.run_scene(scene=self.bar())
            self.assertEqual((self.out / "scene.svg").read_text(), content)
            self.assertNotIn("scene.svg", self.files())

    def test_a_directory_that_cannot_be(self):
        self.out.write_text("mine")
        self.assertIn("Not a directory", self.run_with("--picture", status=1))

    def test_the_default_directory_is_that_of_a_run(self):
        self.assertEqual(self.run_with("--picture", output=False, scene=self.bar()), "picture in output/bar/scene.svg\n")
        self.assertTrue((self.home / "output/bar/scene.svg").exists())


class Words(PictureTest):
    def words(self, *settings, scene=None):
        scene = scene or self.scene
        lines = self.run_with("--validate", *settings, scene=scene, output=False).splitlines()
        title = re.search(r"set Title *= (.*)", scene.read_text())
        self.assertEqual(lines[0], f"{scene}: valid: {title[1] if title else scene.stem}")
        self.assertEqual(list(self.home.glob("out*")), [])
        return lines[1:]

    def test_a_block(self):
        self.assertEqual(self.words(), [
            "body: box from (0, 0) to (4, 4) mm, 16 coarse cells",
            "material: Young's modulus 15 kN/mm^2, Poisson's ratio 0.4, plane stress",
            "left: traction x: 1.5 to 7.5 kN/mm^2, y: -0.75 kN/mm^2",
            "right: clamped",
            "bottom: bilateral contact, friction bound 4.5 kN/mm^2",
            "free: top",
            "loads: force (18 -3), moment 14 about (2 2)"])
        self.assertIn("loads: force (18 -3), moment 14 about (2 2)", self.run_scene("Adaptivity/Maximum steps=1"))

    def test_a_body_force_on_a_slope(self):
        self.assertEqual(self.words(scene=SCENES / "slope.prm"), [
            "body: quadrilateral from (-0.5, 0) to (1.73205, 1.86603) m, 8 coarse cells",
            "material: Young's modulus 1000 kN/m^2, Poisson's ratio 0.3, plane strain",
            "bottom: unilateral contact, no gap, friction coefficient 0.6",
            "free: left, right, top",
            "body force: y: -1 kN/m^2/m",
            "loads: force (0 -2), moment 0 about (0.616025 0.933013)"])

    def test_a_history(self):
        lines = self.words(scene=SCENES / "fretting.prm")
        self.assertEqual(lines[0], "body: box from (-2, 0) to (2, 1) mm, 40 coarse cells, graded towards 2 points")
        self.assertEqual(lines[2], "load history: 48 load steps; what follows is at t = 1")
        self.assertIn("top: ux = 0, uy free, traction y: -10 N/mm^2", lines)
        self.assertEqual(lines[-1], "loads: force (0 -40), moment 0 about (0 0.5)")

    def test_contact_in_words(self):
        for name, words in (("punch-limited", "gap 0 to 1 mm, friction 0.15 times the pressure, at most 0.8 N/mm^2"),
                            ("hertz", "gap 0 to 0.182 mm, no friction")):
            self.assertRegex("\n".join(self.words(scene=SCENES / f"{name}.prm")), f"bottom: .*{re.escape(words)}\n")

    def test_in_space(self):
        self.assertEqual(self.words(scene=SCENES / "slab.prm"), [
            "body: box from (0, 0, 0) to (4, 4, 2), 32 coarse cells",
            "material: Young's modulus 15, Poisson's ratio 0.4",
            "left (x = 0): traction x: 1.5 to 7.5, y: -0.75, z: 0.5",
            "right (x = 4): clamped",
            "bottom (y = 0): bilateral contact, friction bound 4.5",
            "free: top (y = 4), front (z = 0), back (z = 2)",
            "loads: force (36 -6 4), moment (0 8 28) about (2 2 1)"])

    def test_materials_are_those_that_cells_have(self):
        """Of a mesh file all cells may have named ones, of a box too: nothing is elsewhere then."""
        everywhere = ("Material upper/Where=y - 1", "Material lower/Where=1")
        for scene, settings, names in ((SCENES / "foot.prm", (), ["rubber"]), (self.scene, everywhere, ["upper", "lower"]),
                                       (self.scene, everywhere[:1], ["elsewhere", "upper"])):
            found = re.findall(r"^material (.*?):", "\n".join(self.words(*settings, scene=scene)), re.M)
            self.assertEqual(found, names)
        self.assertEqual(self.words(scene=SCENES / "foot.prm")[0],
                         "body: foot.msh, a mesh file of Gmsh, from (-2, 0, -2) to (2, 2, 2), 32 coarse cells")

    def test_probes(self):
        """Each kind in words."""
        probes = ("Probe tip/At=1, 2", "Probe core/At=2, 2", "Probe core/Size=0.5", "Probe foot/On=bottom",
                  "Probe cut/From=0, 1", "Probe cut/To=4, 3", "Probe cut/Points=7")
        said = self.run_with("--validate", *probes, output=False)
        for line in ("probe tip: at (1, 2)", "probe core: mean over the disc of radius 0.5", "probe foot: mean along bottom",
                     "probe cut: 7 points from (0, 1) to (4, 3)"):
            self.assertIn(line, said)


if __name__ == "__main__":
    if importlib.util.find_spec("matplotlib") is None:
        print("skipped: matplotlib is not installed")
        sys.exit(77)
    unittest.main()
