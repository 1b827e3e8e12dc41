# SPDX-License-Identifier: LGPL-2.1-or-later
"""drawn_energies.py HPVI: the five drawings of tests/scenes/drawings.py by quadrilaterals, triangles and a mixture, whose edges follow the
curves of CAD, have one energy to 1e-6, contact included."""

import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "scenes"))
import drawings  # which takes the argument

CELLS = {"quadrilaterals": "", "triangles": "Mesh.RecombineAll = 0;\n", "mixture": "Mesh.RecombinationAlgorithm = 0;\n"}


class Energies(drawings.Drawings):
    def energy(self, cells, settings, bodies):
        (self.home / "cells.geo").write_text(drawings.KERNEL + 'Merge "drawing.step";\n' + cells)
        self.file = "cells.geo"
        self.run_scene("Output/VTU=false", "Error/Bound=false", "Adaptivity/Maximum steps=30",
                       "Adaptivity/Tolerance=3e-4", "Adaptivity/Maximum unknowns=60000",
                       scene=self.scene({"Material/Young's modulus": 1000, **settings}, bodies))
        return float(self.rows()[-1]["energy"])

    def forces(self, settings, bodies=()):
        energies = [self.energy(cells, settings, bodies) for cells in CELLS.values()]
        for energy in energies[1:]:
            self.near(energy, energies[0], 1e-6)
        self.file = "drawing.step"
        return super().forces(settings, bodies)


del drawings.Drawings  # whose tests are ctest's

if __name__ == "__main__":
    unittest.main()
