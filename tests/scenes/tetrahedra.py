#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""tetrahedra.py HPVI: a bracket of a STEP file on a plane, meshed by tetrahedra, which become hexahedra: forces and moments are those of
statics, and the energy is that of transfinite hexahedra."""
import unittest

import runs

KERNEL = 'SetFactory("OpenCASCADE");\n'
BRACKET = """Box(1) = {0, 0, 0, 3, 1, 1}; Box(2) = {0, 0, 1, 1, 1, 1};
BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
"""
TETRAHEDRA = 'Merge "bracket.step";\nMeshSize{:} = 1.5;\n'
HEXAHEDRA = """Rectangle(1) = {0, 0, 0, 1, 1}; Rectangle(2) = {1, 0, 0, 2, 1}; Rectangle(3) = {0, 1, 0, 1, 1};
BooleanFragments{ Surface{1}; Delete; }{ Surface{2, 3}; Delete; }
Rotate {{1, 0, 0}, {0, 0, 0}, Pi/2} { Surface{:}; }
Transfinite Curve{:} = 4; Transfinite Surface{:}; Recombine Surface{:};
Extrude {0, 1, 0} { Surface{:}; Layers{3}; Recombine; }
"""
NAMES = """e = 1e-3;
Physical Surface("left") = Surface In BoundingBox{-e, -e, -e, e, 1 + e, 2 + e};
Physical Surface("front") = Surface In BoundingBox{-e, -e, -e, 3 + e, e, 2 + e};
Physical Surface("bottom") = Surface In BoundingBox{-e, -e, -e, 3 + e, 1 + e, e};
Physical Surface("top") = Surface In BoundingBox{-e, -e, 2 - e, 3 + e, 1 + e, 2 + e};
Physical Volume("body") = Volume{:};
"""


class Tetrahedra(runs.RunTest):
    def results(self, cells):
        """Fz and the largest of the other forces and of all moments by kind and name, and the energy."""
        (self.home / "cells.geo").write_text(KERNEL + cells + NAMES)
        self.run_scene("Output/VTU=false", scene=self.written({
            "Dimension": 3, "Geometry/Shape": "file", "Geometry/File": "cells.geo", "Material/Young's modulus": 100,
            "Boundary left/Symmetry": "true", "Boundary front/Symmetry": "true", "Boundary top/Traction": "0; 0; -1",
            "Boundary bottom/Contact": "unilateral", "Adaptivity/Start degree": 3, "Adaptivity/Maximum steps": 1,
            "Solver/Linear": "multigrid", "Solver/Primal tolerance": 1e-10}))
        forces = {(row["kind"], row["name"]): [float(row[key]) for key in ("Fx", "Fy", "Fz", "Mx", "My", "Mz")] for row in self.rows("forces.csv")}
        return forces, float(self.rows("convergence.csv")[-1]["energy"])

    def test_bracket_on_a_plane(self):
        (self.home / "drawing.geo").write_text(KERNEL + BRACKET + 'Save "bracket.step";\n')
        runs.subprocess.run([runs.pathlib.Path(runs.PROGRAM).parent / "hpvi_drawing", "geo", self.home / "drawing.geo", "3", "0", "12", "1", "-", "60", "8000"],
                            capture_output=True, check=True)
        energies = []
        for cells in (TETRAHEDRA, HEXAHEDRA):
            forces, energy = self.results(cells)
            energies.append(energy)
            self.assertAlmostEqual(forces["contact", "bottom"][2], 1, delta=1e-8)  # the pressure on the top
            for k in range(6):
                self.assertLess(abs(sum(force[k] for force in forces.values())), 1e-8)
        self.assertLess(abs(energies[0] / energies[1] - 1), 1e-3, energies)


unittest.main()
