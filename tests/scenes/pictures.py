# SPDX-License-Identifier: LGPL-2.1-or-later
"""pictures.py HPVI: --picture draws what a scene says, --validate says it in words, and both solve nothing. What they
refuse is in tests/bad_input."""

import re
import unittest
import xml.etree.ElementTree as ElementTree

from runs import BAR, PROGRAM, SCENES, RunTest, run_program

SVG = "{http://www.w3.org/2000/svg}"


class Picture:
    """What is drawn in a file: groups of marks by their class and boundary, texts with their places."""

    def __init__(self, path):
        self.root = ElementTree.parse(path).getroot()
        self.box = [float(number) for number in self.root.get("viewBox").split()]

    def groups(self, name, boundary=None):
        return [group for group in self.root.iter(SVG + "g") if name in group.get("class", "").split()
                and boundary in (None, group.get("data-boundary"))]

    def marks(self, name, group, boundary=None):
        """The elements of a class within groups."""
        return [mark for found in self.groups(group, boundary) for mark in found.iter()
                if name in mark.get("class", "").split()]

    def arrows(self, group, boundary=None):
        """The vectors of shafts on paper, y up."""
        ends = [points(mark) for mark in self.marks("shaft", group, boundary)]
        return [(head[0] - tail[0], tail[1] - head[1]) for tail, head in ends]

    def words(self, group=None, boundary=None):
        return [text.text for found in ([self.root] if group is None else self.groups(group, boundary))
                for text in found.iter(SVG + "text")]

    def text_boxes(self):
        """At least as much as the letters take, from the widths of common fonts."""
        for text in self.root.iter(SVG + "text"):
            if text.get("transform"):
                continue
            size, x, y = float(text.get("font-size")), float(text.get("x")), float(text.get("y"))
            width = 0.5 * size * len(text.text)
            left = x - width * {"start": 0, "middle": 0.5, "end": 1}[text.get("text-anchor")]
            yield text.text, (left, y - 0.7 * size, left + width, y)


def points(path):
    return [tuple(map(float, point.split())) for point in re.split("[MLZ]", path.get("d")) if point]


class PictureTest(RunTest):
    def run_with(self, option, *settings, scene=None, status=0, output=True):
        line = [PROGRAM, option, scene or self.scene] + (["--output", self.out] if output else [])
        for setting in settings:
            line += ["--set", setting]
        return self.said(status, *run_program(line, self.home))

    drawn = {}  # those of shipped scenes as they are, by name: starting the program is what takes time here

    def shipped(self, name):
        if name not in self.drawn:
            self.drawn[name] = self.draw(scene=SCENES / f"{name}.prm")
        return self.drawn[name]

    def draw(self, *settings, **options):
        self.assertEqual(self.run_with("--picture", *settings, **options), f"picture in {self.out}/scene.svg\n")
        picture = Picture(self.out / "scene.svg")
        self.check_page(picture)
        return picture

    def check_page(self, picture):
        """Nothing is outside of the page, and no two texts overlap."""
        left, top, width, height = picture.box
        for path in picture.root.iter(SVG + "path"):
            for x, y in points(path):
                self.assertTrue(left < x < left + width and top < y < top + height, path.get("d"))
        boxes = list(picture.text_boxes())
        for k, (text, box) in enumerate(boxes):
            self.assertTrue(left < box[0] and box[2] < left + width and top < box[1] and box[3] < top + height, text)
            for other, beside in boxes[:k]:
                self.assertFalse(box[0] < beside[2] and beside[0] < box[2] and box[1] < beside[3] and beside[1] < box[3],
                                 f"{text} and {other}")

    def write(self, text):
        scene = self.home / "mine.prm"
        scene.write_text(text)
        return scene


class Pictures(PictureTest):
    def test_names_and_titles(self):
        for scene in ("smooth", "slope", "brake-pad"):
            picture = self.shipped(scene)
            for name in ("left", "right", "bottom", "top"):
                self.assertEqual(picture.words("boundary", name)[0], name, scene)
            title = re.search(r"set Title *= (.*)", (SCENES / f"{scene}.prm").read_text())[1]
            self.assertEqual(picture.words("title")[0], title)

    def test_the_marks_of_a_block(self):
        picture = self.shipped("han-6-12")
        self.assertEqual(len(picture.marks("cell", "body")), 16)
        self.assertEqual(len(picture.marks("clamp", "support", "right")), 1)
        self.assertEqual(len(picture.groups("support")), 1)
        self.assertEqual(len(picture.groups("foundation")), 1)
        self.assertEqual(len(picture.groups("bilateral", "bottom")), 1)
        self.assertGreater(len(picture.marks("roller", "foundation", "bottom")), 5)
        self.assertEqual(picture.words("size", "left"), ["up to 7.537 kN/mm^2"])
        self.assertEqual(picture.words("boundary", "bottom")[1:], ["bilateral contact", "friction bound 4.5 kN/mm^2"])
        self.assertEqual(picture.words("boundary", "right")[1:], ["clamped"])
        self.assertEqual(picture.words("boundary", "top")[1:], ["free"])
        for label in ("x [mm]", "y [mm]"):
            self.assertIn(label, picture.words("axes"))

    def test_arrows_are_the_load_to_scale(self):
        """1.5*(5 - y); -0.75 from the bottom up, all in one scale, less half a head."""
        arrows = sorted(self.shipped("han-6-12").arrows("traction", "left"), reverse=True)
        self.assertGreater(len(arrows), 10)
        full = [(x * (1 + 4 / (x * x + y * y) ** 0.5), y) for x, y in arrows]
        self.assertAlmostEqual(arrows[0][1] / arrows[0][0], -0.1, delta=0.01)
        self.assertAlmostEqual(arrows[-1][1] / arrows[-1][0], -0.5, delta=0.01)
        self.assertAlmostEqual(full[0][0] / full[-1][0], 5, delta=1)
        steps = [one[0] - other[0] for one, other in zip(arrows, arrows[1:-2])]
        self.assertLess(max(steps) - min(steps), 0.1)

    def test_a_narrow_load_has_an_arrow(self):
        picture = self.draw("Boundary top/Traction=0; if(abs(x - 1.33) < 0.02, -50, 0)")
        (x, y), = picture.arrows("traction", "top")
        self.assertTrue(x == 0 and y < -40)
        self.assertEqual(picture.words("size", "top"), ["up to 50 kN/mm^2"])

    def test_components_that_are_held_and_a_load_that_pulls(self):
        picture = self.draw(scene=self.bar())
        self.assertEqual(self.names(), ["scene.svg"])
        side = max(x for mark in picture.marks("cell", "body") for x, _ in points(mark))
        for mark in picture.marks("shaft", "traction", "right"):
            (tail, y), (head, end) = points(mark)
            self.assertTrue(side < tail < head and y == end)
        self.assertEqual(picture.words("size", "right"), ["3"])
        for name, across in (("left", 0), ("bottom", 1)):
            for mark in picture.marks("roller", "support", name):
                tip, one, other, _ = points(mark)
                self.assertAlmostEqual(one[across], other[across])  # the base is across what is held
                self.assertGreater(abs(tip[across] - one[across]), 5)
        self.assertEqual(picture.words("boundary", "left")[1:], ["ux = 0", "uy free"])
        self.assertEqual(picture.words("boundary", "bottom")[1:], ["ux free", "uy = 0"])
        self.assertEqual(picture.groups("displacement"), [])

    def test_displacements_are_arrows_with_their_size(self):
        picture = self.shipped("brake-pad")
        for x, y in picture.arrows("displacement", "top"):
            self.assertTrue(x < -30 and y == 0)
        self.assertEqual(picture.words("size", "top"), ["2 MPa", "0.1 mm"])
        self.assertEqual(len(picture.groups("traction", "top")), 1)

    def test_contact_can_be_told_apart(self):
        for settings, kind, dashed, words in (
                (["Boundary bottom/Contact=unilateral", "Boundary bottom/Gap=0.02*x"], "unilateral", False,
                 ["unilateral contact", "gap 0 to 0.08 mm", "friction bound 4.5 kN/mm^2", "(gap drawn 3 times as wide)"]),
                (["Boundary bottom/Contact=tangential"], "tangential", True,
                 ["tangential contact", "friction bound 4.5 kN/mm^2"]),
                (["Boundary bottom/Friction coefficient=0.3", "Boundary bottom/Friction law=cohesive"], "bilateral", False,
                 ["bilateral contact", "friction 4.5 kN/mm^2 and 0.3 times the pressure"])):
            picture = self.draw(*settings)
            ground, = picture.marks("ground", kind, "bottom")
            self.assertEqual(ground.get("stroke-dasharray") is not None, dashed)
            self.assertEqual(picture.words("boundary", "bottom")[1:], words)

    def test_the_foundation_stands_at_the_gap(self):
        picture = self.draw("Boundary bottom/Contact=unilateral", "Boundary bottom/Gap=0.25*x")
        below = {round(x, 2): y for x, y in points(picture.marks("ground", "foundation")[0])}
        self.assertAlmostEqual(below[480] - below[0], 120 * 0.7, delta=0.1)  # 120 pixels are more than fit
        self.assertIn("(gap drawn 0.7 times as wide)", picture.words("boundary", "bottom"))

    def test_interference_is_within_the_body(self):
        picture = self.draw("Boundary right/Displacement=0; free", "Boundary bottom/Contact=unilateral",
                            "Boundary bottom/Gap=-0.5")
        self.assertLess(max(y for _, y in points(picture.marks("ground", "foundation")[0])), -40)
        self.assertIn("gap -0.5 mm (interference)", picture.words("boundary", "bottom"))

    def test_a_body_force_is_one_arrow_from_the_centre(self):
        picture = self.shipped("slope")
        (x, y), = picture.arrows("body-force")
        self.assertTrue(x == 0 and y < -50)
        self.assertEqual(picture.words("size"), ["body force 1 kN/m^2/m"])

    def test_a_history_is_drawn_at_its_end(self):
        picture = self.draw("Loading/Steps=4", "Geometry/Graded towards=0, 0", "Geometry/Grading levels=2", "Boundary left/Traction=8*t^3; 0", "Boundary top/Displacement=sin(pi*t); free",
                            "Boundary right/Displacement=sin(pi*t); 0")
        self.assertEqual(len(picture.marks("cell", "body")), 22)
        self.assertIn("t = 1", picture.words("title")[-1])
        self.assertEqual(picture.words("size"), ["8 kN/mm^2"])
        self.assertEqual(picture.words("boundary", "top")[1:], ["ux = 0", "uy free"])

    def test_labels_of_any_bytes(self):
        scene = self.write("set Title = <a> & b\nsubsection Units\n set Length = <µ>\n set Stress = \"&\nend\n" + BAR)
        picture = self.draw(scene=scene)
        self.assertEqual(picture.words("title")[0], "<a> & b")
        self.assertIn("x [<µ>]", picture.words("axes"))
        self.assertEqual(picture.words("size", "right"), ["3 \"&"])

    def test_bodies_of_any_size_and_place(self):
        for lower, upper, subdivisions in (("1e6, -3e6", "1000002, -2999999", "2, 1"), ("0, 0", "1e-6, 1e-3", "1, 9")):
            picture = self.draw(f"Geometry/Lower corner={lower}", f"Geometry/Upper corner={upper}",
                                f"Geometry/Subdivisions={subdivisions}", scene=self.bar())
            self.assertEqual(len(picture.groups("arrow")), len(picture.arrows("traction", "right")))


class Files(PictureTest):
    def test_a_picture_is_replaced_and_stays_beside_results(self):
        self.draw(scene=self.bar())
        self.run_scene(scene=self.bar())
        self.assertIn("scene.svg", self.names())
        self.assertIn("scene.svg", self.files())
        results = {name: content for name, content in self.contents().items() if name != "scene.svg"}
        self.assertEqual(self.draw("Title=another", scene=self.bar()).words("title")[0], "another")
        self.assertEqual({name: content for name, content in self.contents().items() if name != "scene.svg"}, results)

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
                         "body: mesh file foot.msh from (-2, 0, -2) to (2, 2, 2), 32 coarse cells")
        self.assertNotIn("material elsewhere", "\n".join(self.draw(*everywhere).words("key")))

    def test_probes(self):
        """A cross, a circle of the disc's size, lines along a side and through the body; and the same in words."""
        probes = ("Probe tip/At=1, 2", "Probe core/At=2, 2", "Probe core/Size=0.5", "Probe foot/On=bottom",
                  "Probe cut/From=0, 1", "Probe cut/To=4, 3", "Probe cut/Points=7")
        picture = self.draw(*probes)
        for name, kind, number in (("tip", "path", 1), ("core", "circle", 1), ("foot", "path", 1), ("cut", "path", 1)):
            marks = [mark for mark in picture.marks("probe", "probe", name) if mark.tag == SVG + kind]
            self.assertEqual(len(marks), number, name)
            self.assertIn(name, picture.words("probe", name))
        circle = next(mark for mark in picture.marks("probe", "probe", "core") if mark.tag == SVG + "circle")
        self.assertAlmostEqual(float(circle.get("r")), 0.5 * 480 / 4, delta=0.1)
        said = self.run_with("--validate", *probes, output=False)
        for line in ("probe tip: at (1, 2)", "probe core: mean over the disc of radius 0.5", "probe foot: mean along bottom",
                     "probe cut: 7 points from (0, 1) to (4, 3)"):
            self.assertIn(line, said)


if __name__ == "__main__":
    unittest.main()
