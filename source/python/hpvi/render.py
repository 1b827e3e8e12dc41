# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies in space in light, by VTK, in a process of its own: VTK ends that in which it finds no display. Xvfb is such a display where there is no screen.

    python3 render.py SURFACE.npz IMAGES.npz
"""
import contextlib
import importlib.util
import os
import pathlib
import select
import shutil
import subprocess
import sys
import tempfile

import numpy as np

SECONDS = 120  # of one picture
PIXELS = 900  # along the longer side of a view


class NotDrawn(Exception):
    """Why there is no picture, with the remedy; one line."""


@contextlib.contextmanager
def display():
    """The variables of a process that draws: with a display of Xvfb where it is installed, so that a picture is the same on each machine."""
    if not shutil.which("Xvfb"):
        yield dict(os.environ)
        return
    reader, writer = os.pipe()
    server = subprocess.Popen(["Xvfb", "-displayfd", str(writer), "-terminate", "-nolisten", "tcp", "-screen", "0", "64x64x24"], pass_fds=[writer],
                              stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(writer)
    try:
        number = os.read(reader, 16).decode().strip() if select.select([reader], [], [], 20)[0] else ""
        yield {**os.environ, "DISPLAY": f":{number}", "LIBGL_ALWAYS_SOFTWARE": "1"} if number else dict(os.environ)
    finally:
        os.close(reader)
        server.terminate()
        server.wait()


def images(faces, values, limit, colours, views):
    """For each of views an image (rows, columns, 3) of faces (m, n, n, 3) of a surface with values (m, n, n), coloured from 0 to the limit by colours (k, 3).

    A view is the directions to the right and upwards (2, 3) and its window on that plane, the lower left corner and the upper right one (2, 2) [length].
    Raises NotDrawn."""
    if not importlib.util.find_spec("vtkmodules"):
        raise NotDrawn("install python3-vtk9 and xvfb")
    try:
        with tempfile.TemporaryDirectory() as home, display() as variables:
            asked, drawn = (pathlib.Path(home, name) for name in ("surface.npz", "images.npz"))
            np.savez(asked, faces=faces.astype(np.float32), values=values.astype(np.float32), limit=limit, colours=colours,
                     axes=np.array([axes for axes, _ in views]), windows=np.array([window for _, window in views]))
            done = subprocess.run([sys.executable, *["-I"] * sys.flags.isolated, "-B", __file__, asked, drawn], env=variables, timeout=SECONDS,
                                  stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, check=False)
            if done.returncode == 0 and drawn.exists():
                with np.load(drawn) as known:
                    return [known[f"arr_{k}"] for k in range(len(views))]
    except subprocess.TimeoutExpired:
        raise NotDrawn(f"VTK took more than {SECONDS} seconds; take a smaller run") from None
    except OSError as problem:
        raise NotDrawn(f"VTK cannot be run ({problem}); install python3-vtk9 anew") from None
    if not shutil.which("Xvfb"):
        raise NotDrawn("VTK finds no display; install xvfb")
    said = done.stderr.decode(errors="replace").strip().splitlines() or ["it was killed"]
    raise NotDrawn(f"VTK failed ({said[-1][:200]}); install python3-vtk9 anew")


# -------------------------------------------------------------- the process that draws


def grid_of(kind, corners, x, values):
    """Cells (m, corners) of points x (k, 3) with values (k,), as vtkPolyData; kind: SetPolys or SetLines."""
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    points, cells, data = vtkPoints(), vtkCellArray(), vtkPolyData()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(x), deep=True))
    cells.SetData(*(numpy_to_vtk(np.ascontiguousarray(one, np.int64), deep=True) for one in (np.arange(len(corners) + 1) * corners.shape[1], corners.ravel())))
    data.SetPoints(points)
    getattr(data, kind)(cells)
    data.GetPointData().SetScalars(numpy_to_vtk(np.ascontiguousarray(values), deep=True))
    return data


def actors(faces, values, limit, colours):
    """The surface and on it the edges of its faces, which are those of the mesh."""
    from vtkmodules.vtkCommonCore import vtkLookupTable
    from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
    from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper
    number = np.arange(values.size).reshape(values.shape)
    quads = np.stack([number[:, :-1, :-1], number[:, 1:, :-1], number[:, 1:, 1:], number[:, :-1, 1:]], axis=-1).reshape(-1, 4)
    rims = np.concatenate([number[:, 0], number[:, -1], number[:, :, 0], number[:, :, -1]])
    smooth, table = vtkPolyDataNormals(), vtkLookupTable()
    smooth.SetInputData(grid_of("SetPolys", quads, faces.reshape(-1, 3), values.ravel()))
    smooth.SplittingOff()
    smooth.ConsistencyOff()
    table.SetNumberOfTableValues(len(colours))
    for k, colour in enumerate(colours):
        table.SetTableValue(k, *colour, 1)
    surface, lines = vtkPolyDataMapper(), vtkPolyDataMapper()
    surface.SetInputConnection(smooth.GetOutputPort())
    surface.SetLookupTable(table)
    surface.SetScalarRange(0, limit)
    surface.InterpolateScalarsBeforeMappingOn()
    lines.SetInputData(grid_of("SetLines", rims, faces.reshape(-1, 3), values.ravel()))
    lines.ScalarVisibilityOff()
    made = [vtkActor(), vtkActor()]
    for actor, mapper in zip(made, (surface, lines)):
        actor.SetMapper(mapper)
    made[0].GetProperty().SetAmbient(0.6)  # light may not make other colours of those of the bar
    made[0].GetProperty().SetDiffuse(0.4)
    made[1].GetProperty().SetColor(1, 1, 1)
    made[1].GetProperty().SetLineWidth(1.5 if len(faces) < 2000 else 1)
    made[1].GetProperty().SetOpacity(0.45 if len(faces) < 2000 else 0.25)
    made[1].GetProperty().LightingOff()
    return made


def draw(asked):
    """The images of a file that images() has written."""
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, what vtkRenderingCore draws with
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter
    renderer, window, found = vtkRenderer(), vtkRenderWindow(), []
    surface, lines = actors(asked["faces"], asked["values"], float(asked["limit"]), asked["colours"])
    renderer.AddActor(surface)
    renderer.AddActor(lines)
    renderer.SetBackground(1, 1, 1)
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(4)
    window.AddRenderer(renderer)
    camera, x = renderer.GetActiveCamera(), asked["faces"].reshape(-1, 3).astype(float)
    centre, far = x.mean(axis=0), 2 * np.linalg.norm(np.ptp(x, axis=0))
    camera.ParallelProjectionOn()
    for (right, up), ((x0, y0), (x1, y1)) in zip(asked["axes"], asked["windows"]):
        right, up = right / np.linalg.norm(right), up / np.linalg.norm(up)
        focus = centre + ((x0 + x1) / 2 - centre @ right) * right + ((y0 + y1) / 2 - centre @ up) * up
        camera.SetFocalPoint(*focus)
        camera.SetPosition(*(focus + far * np.cross(right, up)))
        camera.SetViewUp(*up)
        lines.SetPosition(*(5e-4 * far * np.cross(right, up)))  # before the surface on which they lie
        camera.SetParallelScale((y1 - y0) / 2)
        window.SetSize(*(max(2, round(PIXELS * side / max(x1 - x0, y1 - y0))) for side in (x1 - x0, y1 - y0)))
        renderer.ResetCameraClippingRange()
        window.Render()
        copy = vtkWindowToImageFilter()
        copy.SetInput(window)
        copy.ReadFrontBufferOff()
        copy.Update()
        columns, rows, _ = copy.GetOutput().GetDimensions()
        found.append(vtk_to_numpy(copy.GetOutput().GetPointData().GetScalars()).reshape(rows, columns, 3)[::-1].copy())
    return found


if __name__ == "__main__":
    np.savez(sys.argv[2], *draw(dict(np.load(sys.argv[1]))))
