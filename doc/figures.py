#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rerun Chapter 5 of the thesis and draw its figures.

    /usr/bin/python3 doc/figures.py --program build/hpvi --output output/chapter5

runs both examples with all nine methods, writes the runs, tables (CSV) and figures to the output
directory, copies what the documentation shows to doc/figures and renews the tables inside
doc/chapter5.md. Needs matplotlib and nothing else beyond Python.
"""
import argparse
import base64
import csv
import json
import math
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import time
import zlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

HERE = pathlib.Path(__file__).resolve().parent

# ------------------------------------------------------------------ what the thesis prints

# rows: number of elements of degree 3, 4, 5, ... at refinement steps 1, 2, ..., 15
TABLE_1 = """16; 28; 42 1; 58 6; 70 15; 66 28 3; 78 41 6 2; 79 57 12 9; 83 83 16 14; 75 107 25 19;
67 131 49 22 2; 59 165 61 26 8; 54 158 87 36 19 4; 40 180 113 44 37 4; 34 176 145 64 44 9"""
TABLE_2 = """4; 7; 13; 22; 37; 57 1; 78 7; 104 20; 135 40; 161 63 2; 171 94 11 4; 170 132 22 7;
167 173 45 14 1; 189 211 74 24 4; 170 254 116 33 7"""


class Example:
    """One of the two problems, and the thesis's numbers for it."""

    def __init__(self, number, scene, rates, beta, condition, table, zooms, figures, corners):
        self.number, self.scene = number, HERE.parent / "prm" / scene
        self.rates, self.beta, self.condition = rates, beta, condition
        self.table = [[int(n) for n in row.split()] for row in table.split(";")]
        self.zooms = zooms  # figure number -> interval of x; y from 0 to 0.5
        self.error_figure, self.mesh_figure, self.multiplier_figure = figures
        self.corners = corners  # where the clamp meets a free or loaded edge

    def __str__(self):
        return f"Example {self.number}"


def rates(hup, hap2, hap3, hap4, pu):
    return dict(hup2=hup, hup3=hup, hup4=hup, hap2=hap2, hap3=hap3, hap4=hap4, pu=pu)


EXAMPLES = [
    Example("5.2", "han-6-12.prm", rates(0.45, 0.6, 0.9, 1.5, 0.35), 0.3476,
            (22690, 5.5e8, 2.7e3), TABLE_1, {"5.4": (0.5, 1.5)}, ("5.1", "5.2", "5.3"), [(4, 4)]),
    Example("5.3", "han-6-13.prm", rates(0.38, 0.6, 0.95, 1.6, 0.3), 0.3167,
            (19045, 5.3e7, 1.2e3), TABLE_2, {"5.8": (1.25, 2.5), "5.9": (6.875, 8.125)},
            ("5.5", "5.6", "5.7"), [(0, 2), (10, 2)]),
]

# colours of Okabe and Ito, which the colour-blind can tell apart; families share a line style
METHODS = {
    "hup2": dict(color="#56b4e9", marker="o", linestyle=":"),
    "hup3": dict(color="#0072b2", marker="s", linestyle=":"),
    "hup4": dict(color="#003a5c", marker="D", linestyle=":"),
    "hap2": dict(color="#f0c030", marker="^", linestyle="--"),
    "hap3": dict(color="#e69f00", marker="v", linestyle="--"),
    "hap4": dict(color="#8a5a00", marker=">", linestyle="--"),
    "pu": dict(color="#cc79a7", marker="P", linestyle="-."),
    "hpa1": dict(color="#009e73", marker="X", linestyle="-"),
    "hpa2": dict(color="#d55e00", marker="*", linestyle="-"),
}
READINGS = ("joint", "plain")

# the degrees' colours in the mesh pictures of the program
DEGREE_COLOURS = ("#fffde0 #fdf3a0 #e6e66a #b4d857 #78c664 #3fab78 #1f8c86 #276f8e #33538f "
                  "#443a85 #471b6d #2d0a44").split()


# ------------------------------------------------------------------ running the program


class Run:
    """One finished run: its tables and files."""

    def __init__(self, directory):
        self.directory = directory
        self.rows = read_csv(directory / "convergence.csv")
        self.n = self.column("dofs_free")
        self.eta = self.column("estimate")
        self.steps = len(self.rows)
        units = json.loads((directory / "summary.json").read_text())["units"]
        self.length, self.stress = units["length"], units["stress"].replace("^2", "²")

    def column(self, name):
        return np.array([float(row[name]) for row in self.rows])

    def last(self, name, suffix):
        return self.directory / f"{name}-{self.steps:02d}.{suffix}"

    def degrees(self):
        """Number of elements of degree 3, 4, ... at each step."""
        counts = []
        for row in read_csv(self.directory / "degrees.csv"):
            count = [int(row[f"p{p}"]) for p in range(3, 21) if f"p{p}" in row]
            while count and count[-1] == 0:
                count.pop()
            counts.append(count)
        return counts


def read_csv(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def write_csv(path, head, rows):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(head)
        writer.writerows(rows)


def limits(method):
    """Settings that let each method come to 20000 unknowns or to its end."""
    if method == "hpa2":
        # The thesis starts MPRGP from zero.
        return ["Adaptivity/Maximum steps=16", "Solver/Condition number=true",
                "Solver/QP solver=mprgp", "Solver/QP warm start=false"]
    if method == "pu":
        return ["Adaptivity/Maximum steps=11", "Adaptivity/Maximum degree=12"]
    return ["Adaptivity/Maximum steps=60", "Adaptivity/Maximum unknowns=20000"]


def run(program, example, method, directory, settings=()):
    vtu = method in ("hup4", "hpa2")  # drawn, or asked where its error sits
    command = [program, "--output", str(directory), str(example.scene)]
    for setting in [f"Adaptivity/Method={method}", f"Output/VTU={str(vtu).lower()}",
                    *limits(method), *settings]:
        command += ["--set", setting]
    start = time.time()
    result = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                            env={"OMP_NUM_THREADS": "1", **os.environ})
    if result.returncode != 0:
        sys.exit(f"{' '.join(command)}\nfailed: {result.stderr.strip()}")
    finished = Run(directory)
    print(f"  {directory.name:12s}{finished.steps:4d} steps{finished.n[-1]:8.0f} unknowns   "
          f"eta ={finished.eta[-1]:10.3e}{time.time() - start:7.1f} s", flush=True)
    return finished


def run_all(program, output):
    """All runs by example number and name."""
    runs = {}
    for example in EXAMPLES:
        print(example, flush=True)
        home = output / f"example-{example.number}"
        runs[example.number] = {m: run(program, example, m, home / m,
                                       ["Adaptivity/Smoothness reading=joint"]) for m in METHODS}
        runs[example.number]["plain"] = run(program, example, "hpa2", home / "hpa2-plain",
                                            ["Adaptivity/Smoothness reading=plain"])
    return runs


# ------------------------------------------------------------------ the solution on the mesh


class Patches:
    """The cells of a solution-NN.vtu: (n+1) x (n+1) points each, x fastest, n the highest degree in the file. Between the nodes of
    a cell what it has is a polynomial."""

    def __init__(self, run):
        text = run.last("solution", "vtu").read_text(encoding="latin-1")
        self.ends = array(text, 'Name="offsets"')[:, 0]  # of the cells in the list of points
        self.points = self.by_cell(array(text, "<Points>"))[..., :2]
        self.displacement = self.by_cell(array(text, 'Name="displacement"'))[..., :2]
        self.von_mises = self.by_cell(array(text, 'Name="von_mises"'))[..., 0]
        self.degree = array(text, 'Name="degree"')[:, 0].astype(int)
        self.estimate = array(text, 'Name="estimate"')[:, 0]

    def by_cell(self, values):
        cells = [cell.reshape(math.isqrt(len(cell)), -1, values.shape[1]) for cell in np.split(values, self.ends[:-1])]
        side = max(len(cell) for cell in cells)
        weights = {n: lagrange(n, side) for n in {len(cell) for cell in cells}}
        return np.array([np.einsum("ai,bj,ijc->abc", weights[len(cell)], weights[len(cell)], cell) for cell in cells])

    def outlines(self, scale=0.):
        """The boundary of each cell, moved by scale times the displacement."""
        x = self.points + scale * self.displacement
        return [np.concatenate([c[0, :-1], c[:-1, -1], c[-1, :0:-1], c[:0:-1, 0]]) for c in x]

    def touches(self, corner):
        """Which cells have this point as a corner?"""
        corners = self.points[:, [0, 0, -1, -1], [0, -1, 0, -1]]
        return (np.abs(corners - np.array(corner)).max(axis=2) < 1e-5).any(axis=1)


def lagrange(nodes, points):
    """From values of a polynomial at equidistant nodes on [-1, 1] to those at equidistant points."""
    if nodes == points:
        return np.eye(nodes)
    basis = [np.polynomial.legendre.legvander(np.linspace(-1, 1, n), nodes - 1) for n in (points, nodes)]
    return basis[0] @ np.linalg.inv(basis[1])


def array(text, mark):
    """Decode the first data array behind @p mark: base64, blocks compressed by zlib."""
    found = re.compile(r'<DataArray([^>]*)>\s*([^<\s]+)\s*<').search(
        text, text.rindex("<", 0, text.index(mark) + 1))
    attributes, data = found.groups()
    columns = re.search(r'NumberOfComponents="(\d+)"', attributes)
    kind = {"Float32": np.float32, "Float64": np.float64, "Int32": np.int32}[
        re.search(r'type="(\w+)"', attributes)[1]]
    blocks = struct.unpack("<I", base64.b64decode(data[:8])[:4])[0]
    head_bytes = 4 * (3 + blocks)  # number of blocks, two sizes, compressed size of each block
    head_letters = 4 * math.ceil(head_bytes / 3)  # base64, coded apart from the blocks
    head = struct.unpack(f"<{3 + blocks}I", base64.b64decode(data[:head_letters]))
    packed, values, at = base64.b64decode(data[head_letters:]), b"", 0
    for size in head[3:]:
        values += zlib.decompress(packed[at:at + size])
        at += size
    return np.frombuffer(values, kind).reshape(-1, int(columns[1]) if columns else 1)


def contact(run):
    """Columns of the last contact-NN.csv."""
    rows = read_csv(run.last("contact", "csv"))
    data = {name: np.array([float(row[name]) for row in rows]) for name in rows[0]
            if name != "state"}
    data["slip"] = np.array([row["state"] == "slip" for row in rows])
    return data


def transitions(data):
    """Halfway between neighbouring Gauss points of different state."""
    at = np.flatnonzero(data["slip"][1:] != data["slip"][:-1])
    return (data["x"][at] + data["x"][at + 1]) / 2


# ------------------------------------------------------------------ tables


def rate(n, eta):
    """Slope of eta ~ N^-rate by least squares."""
    return -np.polyfit(np.log(n), np.log(eta), 1)[0] if len(n) > 1 else math.nan


def beta(n, eta):
    """Slope of eta ~ exp(-beta N^(1/3)) by least squares."""
    return -np.polyfit(np.cbrt(n), np.log(eta), 1)[0]


def corner_exponent(poisson):
    """Williams's exponent alpha of the displacement r^alpha in a right angle between a clamped and
    a free edge, in plane stress: 4 kappa sin^2(alpha pi/2) = (kappa + 1)^2 - 4 alpha^2."""
    kappa = (3 - poisson) / (1 + poisson)

    def excess(a):
        return 4 * kappa * math.sin(a * math.pi / 2) ** 2 - (kappa + 1) ** 2 + 4 * a * a

    low, high = 0.1, 1.
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if excess(middle) < 0 else (low, middle)
    return low


def markdown(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(str(c) for c in row) + " |" for row in rows])


def rates_table(runs, output):
    head = ["example", "method", "steps", "N_first", "N_last", "eta_last", "rate",
            "rate_last_decade", "rate_last_two_steps", "thesis"]
    table, shown = [], []
    for example in EXAMPLES:
        for method, printed in example.rates.items():
            r = runs[example.number][method]
            used, late = r.n >= 300, r.n >= r.n[-1] / 10
            values = (rate(r.n[used], r.eta[used]), rate(r.n[late], r.eta[late]),
                      rate(r.n[-2:], r.eta[-2:]))
            table.append([example.number, method, r.steps, int(r.n[0]), int(r.n[-1]),
                          f"{r.eta[-1]:.4e}", *(f"{v:.4f}" for v in values), printed])
            shown.append([example.number, method, r.steps, int(r.n[-1]), printed,
                          *(f"{v:.2f}" for v in values)])
    write_csv(output / "rates.csv", head, table)
    return markdown(["example", "method", "steps", "last N", "thesis", "measured, N ≥ 300",
                     "last decade of N", "last two steps"], shown)


def betas_table(runs, output):
    table = []
    for example in EXAMPLES:
        for name, reading in (("hpa2", "joint"), ("plain", "plain")):
            r = runs[example.number][name]
            for steps in (15, 16):
                n, eta = r.n[:steps], r.eta[:steps]
                table.append([example.number, reading, len(n), int(n[-1]), f"{eta[-1]:.2e}",
                              int(r.rows[len(n) - 1]["multipliers"]), f"{beta(n, eta):.4f}",
                              example.beta])
    write_csv(output / "betas.csv", ["example", "reading", "steps", "N_last", "eta_last",
                                     "multipliers", "beta", "thesis"], table)
    return markdown(["example", "reading", "steps", "last N", "last η", "multipliers", "β",
                     "thesis"], table)


def conditions_table(runs, output):
    table, shown = [], []
    for example in EXAMPLES:
        r = runs[example.number]["hpa2"]
        raw, scaled = r.column("condition_raw"), r.column("condition_scaled")
        for k, row in enumerate(r.rows):
            table.append([example.number, k + 1, int(r.n[k]), row["multipliers"], f"{raw[k]:.4e}",
                          f"{scaled[k]:.4e}", row["qp_multiplications"]])
        n, printed_raw, printed_scaled = example.condition
        shown.append([example.number, "thesis", n, "", f"{printed_raw:.1e}",
                      f"{printed_scaled:.1e}"])
        for k in sorted({int(np.abs(np.log(r.n / n)).argmin()), r.steps - 1}):
            shown.append([example.number, f"step {k + 1}", int(r.n[k]), r.rows[k]["multipliers"],
                          f"{raw[k]:.1e}", f"{scaled[k]:.1e}"])
    write_csv(output / "conditions.csv", ["example", "step", "N", "multipliers", "raw", "scaled",
                                          "qp_multiplications"], table)
    return markdown(["example", "", "N", "multipliers", "cond(S)", "diagonally scaled"], shown)


def degree_tables(runs, output):
    """The text of Tables 5.1 and 5.2."""
    texts = []
    for number, example in enumerate(EXAMPLES, 1):
        measured = {reading: runs[example.number][name].degrees()
                    for name, reading in (("hpa2", "joint"), ("plain", "plain"))}
        table, shown = [], []
        for k, printed in enumerate(example.table):
            line, texts_of = [str(k + 1), f"{sum(printed)}"], [joined(printed)]
            for reading in READINGS:
                count = measured[reading][k] if k < len(measured[reading]) else []
                off = 100 * (sum(count) / sum(printed) - 1)
                line.append(f"{sum(count)}" + (f" ({off:+.1f} %)" if round(off, 1) else ""))
                texts_of.append(joined(count) + (" =" if count == printed else ""))
                for p in range(3, 3 + max(len(count), len(printed))):
                    table.append([k + 1, reading, p,
                                  printed[p - 3] if p - 3 < len(printed) else 0,
                                  count[p - 3] if p - 3 < len(count) else 0])
            shown.append(line + texts_of)
        write_csv(output / f"table-5.{number}.csv", ["step", "reading", "degree", "thesis",
                                                     "measured"], table)
        texts.append(markdown(["step", "elements: print", "joint", "plain",
                               "degrees 3/4/5/...: print", "joint", "plain"], shown))
    return texts


def joined(count):
    return "/".join(str(n) for n in count)


def corners_table(runs, output):
    """Where the error of hup4 sits: its mesh is fine enough to tell the places apart."""
    table = []
    for example in EXAMPLES:
        r = runs[example.number]["hup4"]
        text = (r.directory / "scene.prm").read_text()
        alpha = corner_exponent(float(re.search(r"Poisson's ratio\s*=\s*(\S+)", text)[1]))
        patches = Patches(r)
        low, high = patches.points[:, 0, 0], patches.points[:, -1, -1]
        squares = patches.estimate.astype(float) ** 2
        clamped = np.any([patches.touches(c) for c in example.corners], axis=0)
        ends = patches.touches((0, 0)) | patches.touches((high[:, 0].max(), 0))
        changes = np.any([(low[:, 1] == 0) & (low[:, 0] < x + 1e-5) & (high[:, 0] > x - 1e-5)
                          for x in transitions(contact(r))], axis=0)
        shares = [f"{100 * squares[where].sum() / squares.sum():.1f}"
                  for where in (clamped, ends, changes)]
        table.append([example.number, f"{alpha:.4f}", f"{alpha / 2:.3f}", *shares])
    write_csv(output / "corners.csv", ["example", "alpha", "alpha/2", "percent_clamped_corners",
                                       "percent_contact_ends", "percent_transitions"], table)
    return markdown(["example", "α", "α/2", "% of η² at corners of clamp and free edge",
                     "% at the ends of the contact edge", "% at transitions"], table)


def transitions_table(runs, output):
    table = []
    for example in EXAMPLES:
        data = contact(runs[example.number]["hpa2"])
        for x, (figure, window) in zip(transitions(data), example.zooms.items()):
            table.append([example.number, figure, f"[{window[0]}, {window[1]}]", f"{x:.5f}"])
    write_csv(output / "transitions.csv", ["example", "figure", "zoom", "x"], table)
    return markdown(["example", "figure", "zoom of the print [mm]", "transition x [mm]"], table)


def renew(document, tables):
    """Replace what stands between <!-- NAME: begin --> and <!-- NAME: end -->."""
    text = document.read_text()
    for name, table in tables.items():
        pattern = re.compile(rf"(<!-- {re.escape(name)}: begin[^>]*-->\n).*?"
                             rf"(<!-- {re.escape(name)}: end -->)", re.DOTALL)
        text, found = pattern.subn(lambda m: m[1] + table + "\n" + m[2], text)
        if found != 1:
            sys.exit(f"{document}: has no place for the table '{name}'")
    document.write_text(text)


# ------------------------------------------------------------------ figures


class Gallery:
    """Saves figures to a directory, the same bytes for the same figure."""

    def __init__(self, directory):
        self.directory = directory
        directory.mkdir(parents=True, exist_ok=True)
        plt.rcParams.update({"font.size": 10, "axes.grid": True, "grid.color": "#dddddd",
                             "grid.linewidth": 0.6, "axes.axisbelow": True,
                             "figure.facecolor": "white", "svg.hashsalt": "hpvi",
                             "legend.framealpha": 1})

    def save(self, figure, name):
        metadata = {"Date": None} if name.endswith(".svg") else {"Software": None}
        figure.savefig(self.directory / name, dpi=130, bbox_inches="tight", metadata=metadata)
        plt.close(figure)
        print("  " + name, flush=True)


def eta_label(run):
    return f"error indicator η [{run.stress} · {run.length}]"


def draw_errors(example, runs, gallery):
    figure, axes = plt.subplots(figsize=(7.6, 5.2))
    for method, style in METHODS.items():
        r = runs[method]
        axes.loglog(r.n, r.eta, label=method, markersize=9 if method == "hpa2" else 6,
                    linewidth=1.4, markeredgecolor="white", markeredgewidth=0.5, **style)
    axes.set_xlabel("free displacement unknowns N [-]")
    axes.set_ylabel(eta_label(runs["hpa2"]))
    axes.set_title(f"{example}: error indicator of all methods")
    axes.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), handlelength=3.2)
    gallery.save(figure, f"figure-{example.error_figure}.svg")


def draw_exponential(runs, gallery):
    figure, axes = plt.subplots(figsize=(7.6, 4.4))
    for example, colour, marker in zip(EXAMPLES, ("#d55e00", "#0072b2"), "*o"):
        r = runs[example.number]["hpa2"]
        x = np.cbrt(r.n)
        slope, height = np.polyfit(x, np.log(r.eta), 1)
        axes.semilogy(x, r.eta, marker, color=colour, markersize=8, markeredgecolor="white",
                      markeredgewidth=0.5, label=f"{example}, hpa2")
        axes.semilogy(x, np.exp(height + slope * x), "-", color=colour, linewidth=1,
                      label=f"exp(−β N$^{{1/3}}$), β = {-slope:.4f} (thesis {example.beta})")
    axes.set_xlabel("N$^{1/3}$ of the free displacement unknowns [-]")
    axes.set_ylabel(eta_label(r))
    axes.set_title("hp-adaptive method hpa2: exponential convergence")
    axes.legend(loc="lower left")
    gallery.save(figure, "exponential.svg")


def degree_colour(p):
    return DEGREE_COLOURS[min(max(p, 1), 12) - 1]


def add_degree_legend(axes, degrees, **place):
    axes.legend(handles=[Patch(facecolor=degree_colour(p), edgecolor="#333333", label=str(p))
                         for p in range(min(degrees), max(degrees) + 1)],
                title="degree", **place)


def prepare_map(axes, run):
    axes.grid(False)
    axes.set_aspect("equal")
    axes.set_xlabel(f"x [{run.length}]")
    axes.set_ylabel(f"y [{run.length}]")


def add_outline(axes, patches):
    """The body at rest."""
    low, high = patches.points.min(axis=(0, 1, 2)), patches.points.max(axis=(0, 1, 2))
    axes.plot([low[0], high[0], high[0], low[0], low[0]], [low[1], low[1], high[1], high[1], low[1]],
              color="#888888", linestyle="--", linewidth=1)


def deformation_scale(patches):
    """1, 2 or 5 times a power of ten; the largest displacement is drawn as up to a sixth of the
    body's height, and never smaller than it is."""
    size = np.ptp(patches.points[..., 1])
    largest = np.abs(patches.displacement).max()
    wanted = max(size / 6 / largest, 1)
    decade = 10 ** math.floor(math.log10(wanted))
    return decade * max(f for f in (1, 2, 5) if f * decade <= wanted)


def scale_text(scale):
    return f"displacement × {scale:g}"


def add_cells(axes, patches, scale, linewidth):
    axes.add_collection(PolyCollection(patches.outlines(scale), edgecolors="#333333",
                                       facecolors=[degree_colour(p) for p in patches.degree],
                                       linewidths=linewidth))
    axes.autoscale_view()


def draw_deformed(example, run, patches, gallery):
    wide = example.number == "5.3"
    figure, axes = plt.subplots(figsize=(9.4, 3.2) if wide else (6.6, 6))
    scale = deformation_scale(patches)
    add_cells(axes, patches, scale, 0.35)
    add_outline(axes, patches)
    prepare_map(axes, run)
    axes.set_title(f"{example}, hpa2, step {run.steps}: {len(patches.degree)} elements, "
                   f"{scale_text(scale)}")
    add_degree_legend(axes, patches.degree, loc="center left", bbox_to_anchor=(1.01, 0.5))
    gallery.save(figure, f"figure-{example.mesh_figure}.png")


def draw_multiplier(example, run, gallery):
    data = contact(run)
    text = (run.directory / "scene.prm").read_text()
    section = text[text.index("subsection Boundary bottom"):]
    g = float(re.search(r"Friction bound\s*=\s*(\S+)", section)[1])
    figure, (top, bottom) = plt.subplots(2, 1, figsize=(7.6, 5.4), sharex=True,
                                         gridspec_kw={"hspace": 0.1, "height_ratios": [3, 2]})
    for axes in (top, bottom):
        shade_slip(axes, data)
    for wall in (-1, 1):
        top.axhline(wall, color="#888888", linestyle="--", linewidth=1)
    top.plot(data["x"], data["multiplier"], ".-", color="#0072b2", linewidth=1, markersize=4)
    top.set_ylabel("multiplier λ [-]")
    top.set_ylim(-1.15, 1.15)
    right = top.twinx()
    right.grid(False)
    right.set_ylim(-1.15 * g, 1.15 * g)
    right.invert_yaxis()
    right.set_ylabel(f"T$_t$ = −g λ [{run.stress}]")
    bottom.plot(data["x"], data["tangential_displacement"], ".-", color="#d55e00", linewidth=1,
                markersize=4)
    bottom.set_ylabel(f"u$_t$ [{run.length}]")
    bottom.set_xlabel(f"x [{run.length}]")
    bottom.set_xlim(0, round(data["x"].max()))
    top.set_title(f"{example}, hpa2, step {run.steps}: {len(data['x'])} multipliers, "
                  f"g = {g:g} {run.stress}")
    figure.legend(handles=[Line2D([], [], color="#0072b2", marker=".", label="λ at Gauss points"),
                           Line2D([], [], color="#d55e00", marker=".", label="u$_t$"),
                           Line2D([], [], color="#888888", linestyle="--", label="|λ| = 1"),
                           Patch(facecolor="#f2dccb", label="slip")],
                  loc="lower center", bbox_to_anchor=(0.5, -0.06), ncol=4)
    gallery.save(figure, f"figure-{example.multiplier_figure}.svg")


def shade_slip(axes, data):
    ends = [0, *transitions(data), round(data["x"].max())]
    slips = data["slip"][0]
    for left, right in zip(ends, ends[1:]):
        if slips:
            axes.axvspan(left, right, color="#f2dccb", linewidth=0)
        slips = not slips


def draw_zoom(example, run, patches, figure_number, window, gallery):
    """The cells near a transition, their degrees as digits that shrink with the cells."""
    height = 0.5
    width_inches = 8.6
    figure, axes = plt.subplots(figsize=(width_inches, 1 + width_inches * height
                                         / (window[1] - window[0])))
    add_cells(axes, patches, 0., 0.6)
    points_per_length = 0.775 * 72 * width_inches / (window[1] - window[0])
    shown = []
    for outline, p in zip(patches.outlines(), patches.degree):
        low, high = outline.min(axis=0), outline.max(axis=0)
        size = min(high - low) * points_per_length
        centre = (low + high) / 2
        if low[0] >= window[1] or high[0] <= window[0] or low[1] >= height:
            continue
        shown.append(p)
        inside = window[0] < centre[0] < window[1] and centre[1] < height
        if size > 3 and inside:
            axes.text(*centre, str(p), fontsize=min(0.55 * size, 13), ha="center",
                      va="center_baseline", color="black" if p < 7 else "white", clip_on=True)
    for x in transitions(contact(run)):
        if window[0] < x < window[1]:
            axes.plot(x, -0.012 * (window[1] - window[0]), "^", color="#c4161c", markersize=7,
                      clip_on=False)
            handle = Line2D([], [], color="#c4161c", marker="^", linestyle="",
                            label=f"transition x = {x:.4f} {run.length}")
    axes.set_xlim(*window)
    axes.set_ylim(0, height)
    prepare_map(axes, run)
    axes.set_xticks(np.linspace(*window, 6 if window[1] - window[0] > 1.1 else 5))
    axes.tick_params(axis="x", pad=12)
    axes.set_title(f"{example}, hpa2, step {run.steps}: degrees near the transition")
    handles = [Patch(facecolor=degree_colour(p), edgecolor="#333333", label=f"p = {p}")
               for p in range(min(shown), max(shown) + 1)]
    axes.legend(handles=handles + [handle], loc="upper center",
                bbox_to_anchor=(0.5, -0.2), ncol=len(handles) + 1)
    gallery.save(figure, f"figure-{figure_number}.png")


def draw_conditions(runs, gallery):
    figure, axes = plt.subplots(figsize=(7.6, 4.6))
    for example, colour in zip(EXAMPLES, ("#d55e00", "#0072b2")):
        r = runs[example.number]["hpa2"]
        n, raw, scaled = example.condition
        for name, column, marker, line, printed in (("raw", "condition_raw", "o", "-", raw),
                                                    ("scaled", "condition_scaled", "s", "--",
                                                     scaled)):
            axes.loglog(r.n, r.column(column), marker + line, color=colour, markersize=5,
                        label=f"{example}, {name}")
            axes.loglog(n, printed, "*", color=colour, markersize=15, markeredgecolor="black",
                        markeredgewidth=0.8)
    handles, _ = axes.get_legend_handles_labels()
    handles.append(Line2D([], [], color="white", marker="*", markersize=13, linestyle="",
                          markeredgecolor="black", label="printed in the thesis"))
    axes.legend(handles=handles, loc="upper left")
    axes.set_xlabel("free displacement unknowns N [-]")
    axes.set_ylabel("condition number of S [-]")
    axes.set_title("hpa2: condition of the Schur complement")
    gallery.save(figure, "conditions.svg")


def stress_limit(patches):
    """The von Mises stress that 99.5 % of the area stay below."""
    corners = patches.points[:, [0, 0, -1], [0, -1, 0]]
    area = np.prod(np.ptp(corners, axis=1), axis=1)
    stress = patches.von_mises.reshape(len(area), -1)
    order = np.argsort(stress, axis=None)
    share = np.cumsum(np.repeat(area, stress.shape[1])[order])
    return stress.ravel()[order][np.searchsorted(share, 0.995 * share[-1])]


def draw_overview(example, run, patches, gallery):
    """The picture of the README: stress on the deformed body, and the mesh that found it."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 5.6), sharey=True,
                                         gridspec_kw={"wspace": 0.12})
    scale = deformation_scale(patches)
    x = patches.points + scale * patches.displacement
    side = x.shape[1]
    quads = np.arange(len(x) * side * side).reshape(-1, side, side)
    a, b, c, d = quads[:, :-1, :-1], quads[:, :-1, 1:], quads[:, 1:, 1:], quads[:, 1:, :-1]
    triangles = np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3),
                                np.stack([a, c, d], -1).reshape(-1, 3)])
    flat = x.reshape(-1, 2)
    colours = left.tripcolor(flat[:, 0], flat[:, 1], triangles, patches.von_mises.ravel(),
                             shading="gouraud", cmap="viridis", vmin=0, vmax=stress_limit(patches),
                             rasterized=True)
    figure.colorbar(colours, ax=left, extend="max", shrink=0.8, location="bottom", pad=0.14,
                    label=f"von Mises stress [{run.stress}]")
    left.set_title(f"{example}: stress")
    add_cells(right, patches, scale, 0.3)
    right.set_title("mesh and degrees")
    levels = range(min(patches.degree), max(patches.degree) + 2)
    palette = matplotlib.colors.ListedColormap([degree_colour(p) for p in levels[:-1]])
    norm = matplotlib.colors.BoundaryNorm([p - 0.5 for p in levels], palette.N)
    figure.colorbar(plt.cm.ScalarMappable(norm, palette), ax=right, shrink=0.8, location="bottom",
                    pad=0.14, ticks=levels[:-1], label="polynomial degree p [-]")
    for axes in (left, right):
        add_outline(axes, patches)
        prepare_map(axes, run)
    right.set_ylabel("")
    gallery.save(figure, "overview.png")


def draw_all(runs, gallery):
    for example in EXAMPLES:
        these = runs[example.number]
        patches = Patches(these["hpa2"])
        draw_errors(example, these, gallery)
        draw_deformed(example, these["hpa2"], patches, gallery)
        draw_multiplier(example, these["hpa2"], gallery)
        for number, window in example.zooms.items():
            draw_zoom(example, these["hpa2"], patches, number, window, gallery)
        if example.number == "5.2":
            draw_overview(example, these["hpa2"], patches, gallery)
    draw_exponential(runs, gallery)
    draw_conditions(runs, gallery)


# ------------------------------------------------------------------ the command


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--program", default="build/hpvi", help="the executable hpvi")
    parser.add_argument("--output", default="output/chapter5", type=pathlib.Path,
                        help="directory of runs, tables and figures")
    arguments = parser.parse_args()
    output = arguments.output
    runs = run_all(arguments.program, output)

    tables = {"rates": rates_table(runs, output), "betas": betas_table(runs, output),
              "conditions": conditions_table(runs, output),
              "corners": corners_table(runs, output),
              "transitions": transitions_table(runs, output)}
    tables["table 5.1"], tables["table 5.2"] = degree_tables(runs, output)
    renew(HERE / "chapter5.md", tables)

    print("Figures", flush=True)
    gallery = Gallery(output / "figures")
    draw_all(runs, gallery)
    for path in [*gallery.directory.iterdir(), *output.glob("*.csv")]:
        shutil.copy(path, HERE / "figures")
    print(f"tables and figures are in {output}, copies in {HERE / 'figures'}, "
          f"the tables also in {HERE / 'chapter5.md'}")


if __name__ == "__main__":
    main()
