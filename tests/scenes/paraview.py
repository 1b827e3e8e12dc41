# SPDX-License-Identifier: LGPL-2.1-or-later
"""paraview.py HPVI: files for ParaView, read without it, against contact-NN.csv, convergence.csv and degrees.csv."""

import collections
import math
import re
import struct
import unittest
import xml.etree.ElementTree as ElementTree

from runs import SCENES, RunTest, read_vtu

HIGHEST = 8  # degree of a cell in a file
STATES = {"open": 0, "slip": 1, "stick": 2}
# Scenes with their settings, the outer normal of the contact's first side, or none where it is curved: one body, several, contact on
# either side of a pair, along a direction of its own, around an axis, and in space.
LINES = (("han-6-12", (0, -1), "Adaptivity/Maximum steps=3"),
         ("lap-joint", None, "Loading/Steps=2", "Loading/Adapt=first step", "Adaptivity/Maximum steps=1"),
         ("blocks", None, "Adaptivity/Maximum steps=2"),
         ("askew", (0, -1), "Adaptivity/Maximum steps=2"),
         ("roller", None, "Adaptivity/Maximum steps=2"),
         ("press-ring-axi", None, "Adaptivity/Maximum steps=1"),
         ("slab", (0, -1, 0), "Adaptivity/Maximum steps=1"))

SPHERE = 4 * math.pi * 40 ** 2 * math.sin(math.radians(30))  # the area of the contact of press-ring-axi, which summary.json has to 3e-3


def places(n):
    """Of the nodes of VTK's quadrilateral of degree n, in its order, in [0,1]^2: corners, edges, inside."""
    corners = [(0, 0), (n, 0), (n, n), (0, n)]
    inner = range(1, n)
    edges = [(s, 0) for s in inner] + [(n, s) for s in inner] + [(s, n) for s in inner] + [(0, s) for s in inner]
    return [(i / n, j / n) for i, j in corners + edges + [(i, j) for j in inner for i in inner]]


def single(number):
    return struct.unpack("f", struct.pack("f", number))[0]


class Solution(RunTest):
    def run_to_the_end(self, scene, *settings):
        self.run_scene(*settings, scene=SCENES / f"{scene}.prm")
        self.step = len(self.rows())
        return read_vtu(self.out / f"solution-{self.step:02}.vtu")

    def test_cells_and_nodes(self):
        """A cell of the file is one of the mesh, of its degree; bilinear ones have their nodes where these belong."""
        grid = self.run_to_the_end("han-6-12", "Adaptivity/Maximum steps=6")
        row, degrees = self.rows()[-1], self.rows("degrees.csv")[-1]
        self.assertEqual(len(grid["cells"]), int(row["elements"]))
        self.assertEqual(collections.Counter(grid["degree"]),
                         {int(name[1:]): int(n) for name, n in degrees.items() if name[0] == "p" and n != "0"})
        self.assertAlmostEqual(math.sqrt(math.fsum(eta ** 2 for eta in grid["estimate"])) / float(row["estimate"]), 1, delta=1e-6)
        self.assertEqual(sorted(node for cell in grid["cells"] for node in cell), list(range(len(grid["points"]))))
        for cell, degree in zip(grid["cells"], grid["degree"]):
            n = min(int(degree), HIGHEST)
            self.assertEqual(len(cell), (n + 1) ** 2)
            a, b, c, d = (grid["points"][node] for node in cell[:4])
            for node, (s, t) in zip(cell, places(n)):
                for k, x in enumerate(grid["points"][node]):
                    self.assertAlmostEqual(x, (1 - t) * ((1 - s) * a[k] + s * b[k]) + t * (s * c[k] + (1 - s) * d[k]), delta=1e-12)

    def test_values_at_nodes(self):
        """Probes there say the same, to the digits that the file has, in cells with a curved edge too."""
        steps = "Adaptivity/Maximum steps=4"
        grid = self.run_to_the_end("plate-hole", steps)
        centre = {}  # a node inside a cell, by degree, of the cell that is nearest to the hole
        for cell, degree in zip(grid["cells"], grid["degree"]):
            if degree > 1:
                node = cell[4 * int(min(degree, HIGHEST))]  # the first inside
                x, y, _ = grid["points"][node]
                centre[degree] = min(centre.get(degree, (math.inf,)), (math.hypot(x, y), node))
        nodes = [node for _, node in centre.values()]
        probes = [f"Probe node {k}/At={grid['points'][node][0]!r}, {grid['points'][node][1]!r}" for k, node in enumerate(nodes)]
        again = self.run_to_the_end("plate-hole", steps, *probes)
        row = self.rows()[-1]
        self.assertGreater(len(nodes), 1)
        for k, node in enumerate(nodes):
            told = [float(row[f"node {k}_{name}"]) for name in ("ux", "uy", "szz", "mises")]
            (u, v, _), szz, mises = (again[name][node] for name in ("displacement", "sigma_zz", "von_mises"))
            sxx, syy, sxy = (again["sigma_" + name][node] for name in ("xx", "yy", "xy"))
            for ours, theirs in zip((u, v, szz, mises), told):
                self.assertAlmostEqual(ours, single(theirs), delta=2e-7 * abs(theirs))
            s1, s2 = (float(row[f"node {k}_{name}"]) for name in ("s1", "s2"))
            self.assertAlmostEqual(sxx + syy, s1 + s2, delta=1e-6 * abs(s1))
            self.assertAlmostEqual(math.hypot(sxx - syy, 2 * sxy), s1 - s2, delta=1e-6 * abs(s1))

    def test_units(self):
        for file in ("solution", "contact"):
            self.run_scene("Adaptivity/Maximum steps=1")
            units = {array.get("Name"): array.findtext("InformationKey[@name='UNITS_LABEL']") for array in
                     ElementTree.parse(self.out / f"{file}-01.vtu").iter("DataArray")}
            self.assertEqual(units["displacement"], "mm")
            self.assertEqual(units["von_mises" if file == "solution" else "normal_traction"], "kN/mm^2")


class ContactLine(RunTest):
    def test_points_are_those_of_the_table(self):
        for scene, normal, *settings in LINES:
            with self.subTest(scene):
                self.run_scene(*settings, scene=SCENES / f"{scene}.prm")
                step = len(self.rows())
                self.check(read_vtu(self.out / f"contact-{step:02}.vtu"), self.rows(f"contact-{step:02}.csv"), normal)
                self.check_collection(step)

    def check(self, grid, table, normal):
        dim = 3 if "z" in table[0] else 2
        suffixes = ("_x", "_y", "_z") if dim == 3 else ("",)
        self.assertEqual(len(grid["points"]), len(table))
        for k, row in enumerate(table):
            self.assertEqual(grid["points"][k][:dim], tuple(float(row[x]) for x in "xyz"[:dim]))
            for name in ("tangential_traction", "multiplier", *(("slip",) if "slip" in row else ())):
                of_row = tuple(float(row[name + suffix]) for suffix in suffixes)
                self.assertEqual(grid[name][k], of_row if dim == 3 else of_row[0])
            self.assertEqual(grid["normal_traction"][k], float(row["normal_traction"]))
            self.assertEqual(grid["state"][k], STATES[row["state"]])
            self.assertTrue(grid["gap"][k] == float(row["gap"]) if row["gap"] else math.isnan(grid["gap"][k]))
            for vector, parts in (("displacement", "displacement"), ("traction", "traction")):
                self.check_vector(grid[vector][k], row, parts, suffixes, normal)
        self.check_integrals(grid, dim)
        if dim == 2:
            self.check_lines(grid)

    def check_vector(self, vector, row, name, suffixes, normal):
        part, along = float(row["normal_" + name]), [float(row["tangential_" + name + suffix]) for suffix in suffixes]
        size = math.hypot(part, *along)
        self.assertAlmostEqual(math.hypot(*vector), size, delta=1e-12 * size)
        if normal:
            self.assertAlmostEqual(sum(v * n for v, n in zip(vector, normal)), part, delta=1e-12 * size)
            if len(suffixes) == 1:
                self.assertAlmostEqual(-vector[0] * normal[1] + vector[1] * normal[0], along[0], delta=1e-12 * size)

    def check_integrals(self, grid, dim):
        """Weights add up to the contact, and weigh friction as convergence.csv does."""
        summary = self.summary()
        size = SPHERE if "press-ring-axi" in summary["scene_file"] else \
            sum(contact["area" if dim == 3 else "length"] for contact in summary["contact"].values())
        self.assertAlmostEqual(math.fsum(grid["weight"]) / size, 1, delta=1e-5)
        friction = self.rows()[-1].get("friction_resultant")
        if friction and dim == 2:
            thickness = float((re.findall(r"set Thickness *= (\S+)", (self.out / "scene.prm").read_text()) or ["1"])[0] or 1)
            ours = thickness * math.fsum(w * t for w, t in zip(grid["weight"], grid["tangential_traction"]))
            self.assertAlmostEqual(ours, float(friction), delta=1e-10 * abs(float(friction)) + 1e-12)

    def check_lines(self, grid):
        """Each point is on one line, and arc lengths grow as the points follow each other."""
        self.assertEqual([node for cell in grid["cells"] for node in cell], list(range(len(grid["points"]))))
        for cell in grid["cells"]:
            for a, b in zip(cell, cell[1:]):
                self.assertEqual(grid["boundary"][a], grid["boundary"][b])
                self.assertAlmostEqual(grid["arc_length"][b] - grid["arc_length"][a],
                                       math.dist(grid["points"][a], grid["points"][b]), delta=1e-9)
        self.assertGreater(min(grid["arc_length"]), 0)

    def check_collection(self, step):
        for name in ("contact", "solution"):
            sets = ElementTree.parse(self.out / f"{name}.pvd").getroot().findall("./Collection/DataSet")
            self.assertEqual(sets[-1].get("file"), f"{name}-{step:02}.vtu")
        self.assertEqual(self.files(), self.names())

    def test_it_belongs_to_the_files_for_paraview(self):
        self.run_scene("Adaptivity/Maximum steps=2", "Output/Contact tables=false")
        self.assertIn("contact-02.vtu", self.names())
        self.assertNotIn("contact-02.csv", self.names())
        self.run_scene("Adaptivity/Maximum steps=2", "Output/VTU=false")
        self.assertEqual([name for name in self.names() if name.endswith(("vtu", "pvd"))], [])
        self.assertIn("contact-02.csv", self.names())

    def test_without_contact_there_is_none(self):
        self.run_scene(scene=self.bar())
        self.assertEqual([name for name in self.names() if name.startswith("contact")], [])


if __name__ == "__main__":
    unittest.main()
