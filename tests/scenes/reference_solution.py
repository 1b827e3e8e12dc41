# SPDX-License-Identifier: LGPL-2.1-or-later
"""reference_solution.py HPVI: errors are measured against a reference solution of the same problem,
whole and unaltered, or not at all."""

import unittest

from runs import RunTest

STEPS = "Adaptivity/Maximum steps=2"


class ReferenceSolution(RunTest):
    def setUp(self):
        super().setUp()
        overkill = self.home / "overkill"
        self.run_scene("Adaptivity/Maximum steps=3", "Output/Reference solution=true",
                       "Output/VTU=false", output=overkill)
        self.file = overkill / "reference.dat"
        self.setting = f"Error/Reference solution={self.file}"

    def refuse(self, *settings, words):
        line = self.run_scene(STEPS, self.setting, *settings, status=1)
        for word in [str(self.file), "anew", *words]:
            self.assertIn(word, line)
        self.assertFalse(self.out.exists())

    def test_another_problem_is_refused_with_what_differs(self):
        self.refuse("Material/Poisson's ratio=0.3",
                    words=["Material/Poisson's ratio = 0.4 there, 0.3 here"])
        self.refuse("Material/Plane=strain", words=["Material/Plane = stress there, strain here"])
        self.refuse("Boundary left/Traction=2*(5 - y); -0.75",
                    words=["Boundary left/Traction = 1.5*(5 - y); -0.75 there, 2*(5 - y); -0.75"])
        self.refuse("Boundary bottom/Friction bound=4",
                    words=["Boundary bottom/Friction bound = 4.5 there, 4 here"])
        self.refuse("Boundary top/Traction=0; -1",
                    words=["Boundary top/Traction = nothing there, 0; -1 here"])
        self.refuse("Material core/Where=y > 2", words=["other entries"])
        self.refuse("Boundary foot/On=top", "Boundary foot/Where=x > 2", words=["other entries"])
        self.refuse("Geometry/Upper corner=4, 5", words=["Geometry/Upper corner = 4, 4 there"])
        self.refuse("Geometry/Subdivisions=2, 2", words=["Geometry/Subdivisions = 4, 4 there"])
        self.refuse("Geometry/Graded towards=0, 0", "Geometry/Grading levels=9",
                    words=["another coarse mesh"])

    def test_how_the_problem_is_solved_and_labelled_does_not_count(self):
        self.run_scene(STEPS, self.setting, "Title=another", "Units/Length=m",
                       "Adaptivity/Method=hup2", "Solver/QP solver=mprgp",
                       "Boundary right/Displacement=0;0", "Geometry/Subdivisions=4,4")
        self.assertGreater(float(self.rows()[1]["error_relative"]), 1e-4)

    def test_a_damaged_file_is_refused(self):
        content = self.file.read_bytes()
        for part in range(4):
            self.file.write_bytes(content[:part * len(content) // 4])
            self.refuse(words=["hpvi reference solution"] if part == 0 else ["cut short"])
        self.file.write_bytes(content[:-1])
        self.refuse(words=["cut short"])
        self.file.write_bytes(content + b"\n")
        self.refuse(words=["altered"])
        middle = next(k for k in range(len(content) // 2, len(content))
                      if content[k:k + 1] in b"12345678")
        altered = bytes([content[middle] + 1])
        self.file.write_bytes(content[:middle] + altered + content[middle + 1:])
        self.refuse(words=["altered"])

    def test_a_file_of_another_kind_is_refused(self):
        body = self.file.read_bytes().split(b"\n", 2)[2]
        energy = body.index(b"J(u) = ") + len(b"J(u) = ")
        for text in (body[energy:], b"\xff\x00\n" * 9):
            self.file.write_bytes(text)
            self.refuse(words=["does not begin with"])


# Two squares that stand on a floor; a point may be moved.
MESH = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
1 1 "floor"
1 2 "roof"
2 3 "block"
$EndPhysicalNames
$Nodes
6
1 0 0 0
2 1 0 0
3 2 0 0
4 0 1 0
5 {} 1 0
6 2 1 0
$EndNodes
$Elements
4
1 1 2 1 1 1 2
2 1 2 2 2 4 5
3 3 2 3 3 1 2 5 4
4 3 2 3 3 2 3 6 5
$EndElements
"""
BLOCK = """
set Dimension = 2
subsection {body}
  set Shape = file
  set File  = {file}
end
subsection Boundary {side}floor
  set Displacement = 0; 0
end
subsection Boundary {side}roof
  set Traction = 0; -1
end
subsection Adaptivity
  set Method        = hup2
  set Maximum steps = 1
end
"""


class MeshOfAFile(RunTest):
    """Of a mesh counts what is in its file, wherever that lies."""

    def block(self, directory, body="Geometry", side="", middle=1):
        home = self.home / directory
        home.mkdir(exist_ok=True)
        (home / "block.msh").write_text(MESH.format(middle))
        (home / "scene.prm").write_text(BLOCK.format(body=body, side=side, file="block.msh"))
        return home / "scene.prm"

    def test_counts_by_its_content(self):
        for body, side in (("Geometry", ""), ("Body block", "block.")):
            here = self.block("here", body, side)
            self.run_scene("Output/Reference solution=true", scene=here, output=self.home / "fine")
            setting = f"Error/Reference solution={self.home / 'fine/reference.dat'}"
            self.run_scene(setting, scene=self.block("there", body, side))
            self.assertLess(float(self.rows()[0]["error_relative"]), 1e-12)
            for altered in (self.block("there", body, side, middle=1.125),
                            self.block("here", body, side, middle=1.125)):
                line = self.run_scene(setting, scene=altered, status=1)
                self.assertIn(f"{body}/File = content ", line)
                self.assertIn("another problem", line)


if __name__ == "__main__":
    unittest.main()
