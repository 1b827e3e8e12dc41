# SPDX-License-Identifier: LGPL-2.1-or-later
"""A directory of results as arrays.

    run = hpvi.results.Run("output/punch")
    run.steps["energy"], run.contact["normal_traction"], run.grid(5)["stress"], run.summary["status"]

A Run has the attributes of a Result, so that the functions of hpvi.plot take either. It needs NumPy alone.
"""
import base64
import csv
import functools
import json
import math
import pathlib
import re
import struct
import zlib
from collections import namedtuple

import numpy as np

WORDS = {"state", "boundary", "contact", "master", "name", "kind", "transitions", "stopped_by", "bound_kind", "coulomb_method"}
PROBED = ("ux", "uy", "uz", "s1", "s2", "s3", "szz", "mises")  # a probe's columns end so

Mesh = namedtuple("Mesh", "vertices cells degrees bodies")


class RunError(ValueError):
    """A file of results is not there, or not as hpvi writes it: one line, with the file."""


def table(text):
    """Columns of a CSV file by name: words are texts, counts whole numbers, all else float, NaN where a field is empty."""
    head, *rows = csv.reader(text.splitlines()) if text.strip() else [[]]
    rows = [row for row in rows if len(row) == len(head)]  # the last line of a run that is going on may not be whole
    return {name: column(name, [row[k] for row in rows]) for k, name in enumerate(head)}


def column(name, fields):
    for kind in () if name in WORDS else (int, float):
        try:
            return np.array([kind(field or "nan") for field in fields], kind)
        except ValueError:  # it has others
            continue
    return np.array(fields, str)


def where(columns, chosen):
    """The rows of a table for which the array @chosen is true, or which it numbers."""
    return {name: values[chosen] for name, values in columns.items()}


# ------------------------------------------------------------------ fields


class Vtu(dict):
    """The arrays of one file .vtu, which has values between 64-bit or 32-bit numbers, packed by zlib."""

    def __init__(self, path):
        self.file = path.name
        try:
            text = path.read_text(encoding="latin-1")
            super().__init__((self.name(attributes), self.decode(attributes, data))
                             for attributes, data in re.findall(r"<DataArray([^>]*)>\s*([^<\s]+)", text) if "binary" in attributes)
        except (OSError, KeyError, ValueError, IndexError, struct.error, zlib.error) as error:
            raise RunError(f"{path.name} cannot be drawn: {error}") from None

    def __missing__(self, name):
        raise RunError(f"{self.file} cannot be drawn: it has no array {name}")

    @staticmethod
    def name(attributes):
        found = re.search(r'Name="([^"]*)"', attributes)
        return found[1] if found else "points"  # those alone have none

    @staticmethod
    def decode(attributes, data):
        """Blocks behind a head that has their number, two sizes and the packed size of each; the head is coded by itself."""
        columns = re.search(r'NumberOfComponents="(\d+)"', attributes)
        kind = {"Float32": "<f4", "Float64": "<f8", "Int32": "<i4", "UInt8": "u1"}[re.search(r'type="(\w+)"', attributes)[1]]
        blocks = struct.unpack("<I", base64.b64decode(data[:8])[:4])[0]
        letters = 4 * math.ceil(4 * (3 + blocks) / 3)
        head = struct.unpack(f"<{3 + blocks}I", base64.b64decode(data[:letters])[:4 * (3 + blocks)])
        packed, values, at = base64.b64decode(data[letters:]), b"", 0
        for size in head[3:]:
            values += zlib.decompress(packed[at:at + size])
            at += size
        array = np.frombuffer(values, kind)
        return array.reshape(-1, int(columns[1])) if columns else array


@functools.lru_cache(maxsize=None)
def lagrange(nodes, points):
    """The matrix (points, nodes) that takes values of a polynomial at equidistant nodes to those at equidistant points."""
    if nodes == points:
        return np.eye(nodes)
    basis = [np.polynomial.legendre.legvander(np.linspace(-1, 1, n), nodes - 1) for n in (points, nodes)]
    return basis[0] @ np.linalg.inv(basis[1])


def at_points(values, dimension, n):
    """Of cells (cells, nodes, components) with equidistant nodes, x fastest, at n points a direction, x first: (cells, n, n[, n], components)."""
    side = round(values.shape[1] ** (1 / dimension))
    cells = values.reshape([-1] + [side] * dimension + [values.shape[2]]).transpose([0, *range(dimension, 0, -1), dimension + 1])
    for axis in range(1, dimension + 1):
        cells = np.moveaxis(np.tensordot(lagrange(side, n), cells, (1, axis)), 0, axis)
    return cells


def von_mises(stress):
    """sqrt(3/2 s:s) of stresses (..., 3, 3), s the deviator [stress]."""
    deviator = stress - np.trace(stress, axis1=-2, axis2=-1)[..., None, None] / 3 * np.eye(3)
    return np.sqrt(1.5 * (deviator ** 2).sum(axis=(-2, -1)))


def usual(values, weights, share=0.995, beyond=1.3):
    """What this share of the weight stays below; the largest value if that is not far beyond: what is unbounded somewhere would hide all else."""
    order = np.argsort(values)
    sums = weights[order].cumsum()
    limit = values[order][np.searchsorted(sums, share * sums[-1]).clip(max=len(values) - 1)]
    return limit if values.max() > beyond * limit > 0 else values.max()


def label(name, unit, kind):
    """Of an axis. A scene that names no unit has its own."""
    return f"{name} [{unit or 'unit of ' + kind}]"


def vtk(result, n=5):
    """A vtkUnstructuredGrid: displacement, stress and von_mises at n points a direction of each cell, small straight cells between them, and the degree of the
    cell that each is of."""
    try:
        from vtkmodules.util.numpy_support import numpy_to_vtk
        from vtkmodules.vtkCommonCore import vtkPoints
        from vtkmodules.vtkCommonDataModel import VTK_HEXAHEDRON, VTK_QUAD, vtkCellArray, vtkUnstructuredGrid
    except ImportError:
        raise ImportError("vtk() needs VTK; install python3-vtk9") from None
    values, dim = result.grid(n), result.dimension
    number = np.arange(values["x"].size // dim).reshape(values["x"].shape[:-1])
    corners = [corner + end for end in ([()] if dim == 2 else [(0,), (1,)]) for corner in ((0, 0), (1, 0), (1, 1), (0, 1))]
    small = np.stack([number[(slice(None), *(slice(at, n - 1 + at) for at in corner))] for corner in corners], axis=-1).reshape(-1, len(corners))

    def array(name, numbers):
        made = numpy_to_vtk(np.ascontiguousarray(numbers), deep=True)
        made.SetName(name)
        return made

    def in_space(vectors):
        return np.pad(vectors.reshape(-1, dim), ((0, 0), (0, 3 - dim)))

    points, cells, grid = vtkPoints(), vtkCellArray(), vtkUnstructuredGrid()
    points.SetData(array("points", in_space(values["x"])))
    cells.SetData(array("offsets", np.arange(len(small) + 1) * len(corners)), array("connectivity", small.ravel()))
    grid.SetPoints(points)
    grid.SetCells(VTK_QUAD if dim == 2 else VTK_HEXAHEDRON, cells)
    for name, numbers in (("displacement", in_space(values["u"])), ("stress", values["stress"].reshape(-1, 9)), ("von_mises", von_mises(values["stress"]).ravel())):
        grid.GetPointData().AddArray(array(name, numbers))
    grid.GetCellData().AddArray(array("degree", np.repeat(result.mesh.degrees, (n - 1) ** dim)))
    return grid


# ------------------------------------------------------------------ contact


def contacts(columns):
    """Of a table of contact points the numbers of the rows of each contact, by its name: that of the pair, else of the boundary."""
    names = columns.get("boundary", np.array([]))
    if "contact" in columns:
        names = np.where(columns["contact"] != "", columns["contact"], names)
    return {str(name): np.flatnonzero(names == name) for name in dict.fromkeys(names)}


def breaks(x):
    """Where a line of points (n, 2) goes on elsewhere: numbers of the points that begin a piece. A step is a gap where both beside it
    are four times shorter."""
    steps = np.hypot(*np.diff(x, axis=0).T) if len(x) > 1 else np.zeros(0)
    beside = np.maximum(np.append(steps[1:], 0), np.append(0, steps[:-1]))
    return np.flatnonzero((steps > 4 * beside) & (beside > 0)) + 1


def left(way):
    """What is turned by 90 degrees, counterclockwise: of vectors (..., 2)."""
    return np.stack([-way[..., 1], way[..., 0]], axis=-1)


def lengths(x):
    """Along the way from point to point of (n, 2), from the first one."""
    return np.append(0, np.hypot(*np.diff(x, axis=0).T).cumsum())


class Line(dict):
    """The points of one contact in the plane in their order: `name`, `title`, columns (`line["normal_traction"]`), `x` (n, 2),
    `s` the arc length from its beginning [length], `starts` where its pieces begin."""

    def __init__(self, name, columns, s=None, starts=None, begin=None):
        super().__init__(columns)
        self.name = name
        self.x = np.stack([columns["x"], columns["y"]], axis=1)
        self.boundary = str(columns["boundary"][0])
        self.title = name if name == self.boundary else f"{name} ({self.boundary})"
        ahead = 0 if begin is None else math.hypot(*(self.x[0] - begin))
        self.s = s if s is not None else ahead + lengths(self.x)
        self.starts = breaks(self.x) if starts is None else starts

    @property
    def pressure(self):
        return -self["normal_traction"]

    def broken(self, values):
        """With NaN between pieces, so that no line joins them."""
        return np.insert(np.asarray(values, float), self.starts, math.nan)

    def runs(self):
        """(first, last + 1, state) of neighbours of one state in one piece."""
        state = self["state"]
        firsts = [k for k in range(len(state)) if k == 0 or k in self.starts or state[k] != state[k - 1]]
        return [(first, last, str(state[first])) for first, last in zip(firsts, firsts[1:] + [len(state)])]

    def ends(self, values, first, last):
        """Of values (n, ...) at the points those at both ends of a run: halfway to the next run, or where the piece ends."""
        pieces = {0, len(values), *self.starts}
        return (values[first] if first in pieces else (values[first - 1] + values[first]) / 2,
                values[last - 1] if last in pieces else (values[last - 1] + values[last]) / 2)

    def stretches(self):
        """(state, begin, end) along s."""
        return [(state, *self.ends(self.s, first, last)) for first, last, state in self.runs()]

    def weights(self):
        """The length of each point [length]."""
        if len(self.s) < 2:
            return np.ones(len(self.s))
        steps = np.diff(self.s)
        steps[[k - 1 for k in self.starts]] = 0
        return (np.append(steps, 0) + np.append(0, steps)) / 2


def lines(result):
    """A Line for each contact of a body in the plane, of a Run or a Result."""
    if hasattr(result, "lines"):
        return result.lines
    columns = result.contact
    return [Line(name, where(columns, rows)) for name, rows in contacts(columns).items()]


# ------------------------------------------------------------------ runs


class Run:
    """What a directory has: tables as dictionaries of columns, JSON files as dictionaries, fields as arrays.

    summary: summary.json; entries: scene.prm, by "Section/Entry"; scene: scene.json, None where it is not there;
    steps, loading, cycles, degrees, contact_history: tables; forces, contact: those of the last step.
    """

    def __init__(self, directory):
        self.directory = pathlib.Path(directory)
        self.summary = self.json("summary.json")
        if not self.summary or "status" not in self.summary:
            raise RunError(f"{self.directory}: has no summary.json of a run; name the directory of its results")
        self.scene = self.json("scene.json")
        self.n_steps = self.summary["steps"]
        self.steps = self.table("convergence.csv")
        if len(self.steps.get("step", [])) < self.n_steps:
            raise RunError(f"{self.directory}: convergence.csv has fewer steps than summary.json")
        self.loading, self.cycles, self.degrees, self.contact_history = (self.table(f"{name}.csv") for name in ("loading", "cycles", "degrees", "contact-history"))
        self.contact = self.contact_of(self.n_steps)
        forces = self.table("forces.csv")
        self.forces = where(forces, forces["step"] == self.n_steps) if forces else {}
        units = self.summary["units"]
        self.length_unit, self.stress_unit = (pretty(units[name] or "") for name in ("length", "stress"))
        self.force_unit, self.moment_unit = (unit_of_load(self.stress_unit, self.length_unit, m) for m in (False, True))
        self.warnings = self.summary["warnings"] or []

    def text(self, name):
        path = self.directory / name
        return path.read_text(encoding="utf-8", errors="replace") if path.is_file() else ""

    def json(self, name):
        try:
            return json.loads(self.text(name) or "null")
        except ValueError as error:
            raise RunError(f"{self.directory}: {name} is not JSON: {error}") from None

    def table(self, name):
        return table(self.text(name))

    def contact_of(self, step):
        """The columns of contact-NN.csv of a step, {} where that is not there."""
        return self.table(f"contact-{step:02d}.csv")

    @functools.cached_property
    def entries(self):
        """"Section/Entry": value, of scene.prm."""
        values, section = {}, ""
        for line in self.text("scene.prm").splitlines():
            found = re.match(r"\s*(subsection|set|end)\b\s*(.*)", line)
            if found and found[1] != "set":
                section = found[2] + "/" if found[1] == "subsection" else ""
            elif found and "=" in found[2]:
                name, value = found[2].split("=", 1)
                values[section + name.strip()] = value.strip()
        return values

    def sections(self, kind):
        """Names of the sections of a kind with free names, as in ["tip"] of "Probe tip"."""
        return list(dict.fromkeys(path.split("/")[0][len(kind) + 1:] for path in self.entries if path.startswith(kind + " ")))

    @property
    def dimension(self):
        return int(self.entries.get("Dimension", 2))

    @functools.cached_property
    def pieces(self):
        """The files of the solution of the last step, one or those of several processes. Raises RunError where there is none."""
        name = f"solution-{self.n_steps:02d}"
        paths = [self.directory / f"{name}.vtu"]
        if not paths[0].exists():
            paths = sorted(self.directory.glob(f"{name}.*.vtu"), key=lambda path: int(path.suffixes[0][1:]))
        if not paths or not self.n_steps:
            raise RunError("there is no solution-NN.vtu of the last step; set Output/VTU = true to have it")
        return [Vtu(path) for path in paths]

    def by_cell(self, name, n):
        """(cells, n, n[, n], components) of an array of points."""
        found = []
        for vtu in self.pieces:
            values = vtu[name].astype(float).reshape(len(vtu["points"]), -1)
            sizes = np.diff(vtu["offsets"], prepend=0)
            cells = np.empty([len(sizes)] + [n] * self.dimension + [values.shape[1]])
            for size in np.unique(sizes):
                own = np.flatnonzero(sizes == size)
                rows = (vtu["offsets"][own] - size)[:, None] + np.arange(size)
                cells[own] = at_points(values[rows], self.dimension, n)
            found.append(cells)
        return np.concatenate(found)

    def by_cells(self, name):
        """(cells,) of an array of cells, as degree or estimate."""
        return np.concatenate([vtu[name] for vtu in self.pieces])

    def grid(self, n=5):
        """x [length], u [length] and stress (3, 3) at n points a direction of each cell, ends included, as Result.grid gives them."""
        dim = self.dimension
        stress = np.zeros([len(self.by_cells("degree"))] + [n] * dim + [3, 3])
        for i in range(3):
            for j in range(i, 3):
                if (i < dim and j < dim) or i == j:
                    stress[..., i, j] = stress[..., j, i] = self.by_cell("sigma_" + "xyz"[i] + "xyz"[j], n)[..., 0]
        return {"x": self.by_cell("points", n)[..., :dim], "u": self.by_cell("displacement", n)[..., :dim], "stress": stress}

    @functools.cached_property
    def mesh(self):
        """vertices, a row each; cells by their first and last ones; degrees; numbers of bodies."""
        corners = self.by_cell("points", 2)[..., :self.dimension]
        n = len(corners)
        order = [0, 2, 3, 1] if self.dimension == 2 else [0, 4, 6, 2, 1, 5, 7, 3]
        cells = np.arange(n * len(order)).reshape(n, -1)[:, order]
        bodies = self.by_cells("body").astype(int) if all("body" in vtu for vtu in self.pieces) else np.zeros(n, int)
        return Mesh(corners.reshape(-1, self.dimension), cells, self.by_cells("degree").astype(int), bodies)

    @functools.cached_property
    def lines(self):
        """A Line for each contact, with its arc lengths and pieces where contact-NN.vtu has them."""
        return self.lines_of(self.n_steps)

    def lines_of(self, step):
        columns, found = self.contact_of(step), []
        path = self.directory / f"contact-{step:02d}.vtu"
        vtu = Vtu(path) if columns and path.exists() else None
        for name, rows in contacts(columns).items():
            if vtu is None or len(vtu["points"]) != len(columns["x"]):
                found.append(Line(name, where(columns, rows), begin=self.begin_of(name)))
                continue
            firsts = np.append(0, vtu["offsets"][:-1])
            starts = [int(np.searchsorted(rows, vtu["connectivity"][k])) for k in firsts if vtu["connectivity"][k] in rows[1:]]
            line = Line(name, where(columns, rows), vtu["arc_length"][rows], np.array(starts, int))
            line.update((one, vtu[one][rows, :2]) for one in ("displacement", "jump") if one in vtu)
            found.append(line)
        return found

    def begin_of(self, name):
        """Where the first zone of a contact begins: of a pair on a part of a side summary.json has the name behind that of the side."""
        known = (words for title, words in (self.summary.get("contact") or {}).items() if title == name or title.endswith(f"({name})"))
        zones = next(known, {}).get("zones")
        return zones[0]["from"][:2] if zones else None

    @functools.cached_property
    def probe_lines(self):
        """Of each probe along a line the columns of its file of the last step."""
        return {name: columns for name in self.sections("Probe")
                if (columns := self.table(f"probe-{name}-{self.n_steps:02d}.csv"))}

    def probes(self):
        """By the name of each probe its own values of the last step: {"ux": (value, half width of its interval or NaN)}."""
        last, found = self.summary.get("final") or {}, {}
        for name in self.sections("Probe"):
            own = {end: (last[f"{name}_{end}"], last.get(f"{name}_{end}_bound"))
                   for end in PROBED if last.get(f"{name}_{end}") is not None}
            if own and self.entries.get(f"Probe {name}/From", "") == "":
                found[name] = own
        return found


def pretty(unit):
    """A unit as it is printed: mm², none where the scene has no name for it."""
    return "" if unit in ("1", "-") else unit.replace("^2", "²").replace("^3", "³")


def unit_of_load(stress, length, is_moment):
    """That of stress times length squared, of a moment cubed: "N" of "N/mm²" and "mm", of "MPa" and "mm" too."""
    if not stress or not length:
        return ""
    of_names = {("Pa", "m"): "N", ("kPa", "m"): "kN", ("MPa", "m"): "MN", ("GPa", "m"): "GN", ("MPa", "mm"): "N", ("GPa", "mm"): "kN"}
    force = next((stress[:-len(end)] for end in (f"/{length}²", f"/{length}2") if stress.endswith(end)), of_names.get((stress, length)))
    if not force:
        return f"{stress} {length}" + ("³" if is_moment else "²")
    return f"{force} {length}" if is_moment else force
