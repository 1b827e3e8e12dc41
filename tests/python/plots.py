# SPDX-License-Identifier: LGPL-2.1-or-later
"""plots.py HPVI DIR: pictures are drawn of what the solution has, and refused with a reason. Status 77 without matplotlib."""
import importlib.util
import pathlib
import struct
import sys
import tempfile
import unittest

import numpy as np

PROGRAM, MODULE = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(2))
sys.path.insert(0, str(MODULE))
import hpvi  # noqa: E402

if importlib.util.find_spec("matplotlib") is None:
    print("skipped: matplotlib is not installed")
    sys.exit(77)
import matplotlib  # noqa: E402
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
STEPS = "Adaptivity/Maximum steps"


def scene(name, **entries):
    return hpvi.Scene(ROOT / f"prm/{name}.prm", {STEPS: 2, **entries})


class Plots(unittest.TestCase):
    def test_a_png_of_each(self):
        for name in ("han-6-12", "press-ring", "blocks", "plate-hole", "fretting"):
            with self.subTest(name), tempfile.TemporaryDirectory() as home:
                result = scene(name, **({"Loading/Steps": 2} if name == "fretting" else {})).solve()
                file = pathlib.Path(home) / "all.png"
                figure = result.plot()
                figure.savefig(file, dpi=50)
                content = file.read_bytes()
                self.assertEqual(content[:8], b"\x89PNG\r\n\x1a\n")
                width, height = struct.unpack(">2I", content[16:24])
                pixels = plt.imread(file)
                self.assertEqual(pixels.shape[:2], (height, width))
                self.assertGreater(len(np.unique(pixels.reshape(-1, pixels.shape[2]), axis=0)), 200)
                titles = [axes.get_title() for axes in figure.axes if axes.get_title()]
                self.assertEqual(len(titles), 3 if result.contact else 2)

    def test_what_is_drawn_is_what_was_found(self):
        result = scene("han-6-12").solve()
        contact, convergence = (result.plot(name).axes[0] for name in ("contact", "convergence"))
        pressure, friction = contact.lines[:2]
        np.testing.assert_array_equal(pressure.get_ydata(), -result.contact["normal_traction"])
        np.testing.assert_array_equal(friction.get_ydata(), result.contact["tangential_traction"])
        np.testing.assert_array_equal(convergence.lines[0].get_ydata(), result.steps["error_bound_relative"])
        moved, = [axes for axes in result.plot("body", scale=3).axes if "3 times" in axes.get_title()]
        corners = np.array([moved.dataLim.min, moved.dataLim.max])
        vertices = result.mesh.vertices + 3 * result.u(result.mesh.vertices)
        self.assertTrue((corners[0] <= vertices.min(axis=0) + 1e-9).all() and (corners[1] >= vertices.max(axis=0) - 1e-9).all())

    @unittest.skipUnless(importlib.util.find_spec("vtkmodules"), "python3-vtk9 is not installed")
    def test_a_grid_of_vtk(self):
        """Its values are those of the result, its cells fill the body and none is turned inside out."""
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
        for name, measure, size in (("han-6-12", "Area", 16), ("slab", "Volume", 32)):
            result = scene(name, **{STEPS: 1}).solve()
            grid, values = result.vtk(3), result.grid(3)
            shown = {k: vtk_to_numpy(grid.GetPointData().GetArray(k)) for k in ("displacement", "stress", "von_mises")}
            d = result.dimension
            np.testing.assert_array_equal(shown["displacement"][:, :d], values["u"].reshape(-1, d))
            np.testing.assert_array_equal(shown["stress"], values["stress"].reshape(-1, 9))
            np.testing.assert_allclose(shown["von_mises"].max(), hpvi.results.von_mises(values["stress"]).max())
            self.assertEqual(list(vtk_to_numpy(grid.GetCellData().GetArray("degree"))[::2 ** d]), list(result.mesh.degrees))
            sizes = vtkCellSizeFilter()
            sizes.SetInputData(grid)
            sizes.Update()
            areas = vtk_to_numpy(sizes.GetOutput().GetCellData().GetArray(measure))
            self.assertGreater(areas.min(), 0)
            self.assertAlmostEqual(areas.sum(), size, places=9)
            x = vtk_to_numpy(grid.GetPoints().GetData())[:, :d]
            np.testing.assert_allclose(result.u(x[5:50:7]), shown["displacement"][5:50:7, :d], atol=1e-12)

    def test_bodies_of_cells(self):
        """In the order of the scene, in memory and in files, in the plane and in space."""
        for name in ("blocks", "spheres"):
            with tempfile.TemporaryDirectory() as home:
                result = scene(name).solve(output=home)
                bodies = result.mesh.bodies
                np.testing.assert_array_equal(bodies, hpvi.results.Run(home).mesh.bodies)
                middles = result.grid(3)["x"].mean(axis=tuple(range(1, result.dimension + 1)))
                np.testing.assert_array_equal(bodies, middles[:, 1] > 0 if name == "blocks" else middles[:, 1] < 0)
        self.assertEqual(set(scene("han-6-12").solve().mesh.bodies), {0})

    def test_axes_of_others(self):
        figure, axes = plt.subplots()
        self.assertIs(scene("han-6-12").solve().plot("convergence", axes), figure)
        self.assertTrue(axes.lines)
        plt.close(figure)
        self.assertEqual(plt.get_fignums(), [])

    def test_refusals(self):
        result = hpvi.Scene({"Boundary left/Displacement": (0, 0), "Boundary right/Traction": (1, 0), STEPS: 1}).solve()
        for what, kind, words in (("mesh", ValueError, "body, contact and convergence"), ("contact", ValueError, "no contact")):
            with self.assertRaisesRegex(kind, words):
                result.plot(what)
        with self.assertRaisesRegex(ValueError, "axes are for one picture"):
            result.plot(axes=plt.gca())
        plt.close("all")
        space = scene("slab", **{STEPS: 1}).solve()
        with self.assertRaisesRegex(NotImplementedError, "lines in the plane"):
            space.plot("contact")
        self.assertTrue(space.plot().axes)


if __name__ == "__main__":
    unittest.main()
