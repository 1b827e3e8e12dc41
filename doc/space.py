#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Measurements of doc/space.md, of the slab of prm/slab.prm unless said otherwise: accuracy against CPU time beside GetFEM, the growth of
iterations and memory up to a million unknowns, speed-up, where the primal path overtakes the reduced one in the plane, what Coulomb's law
takes, coarse meshes of many cells, pairs of bodies, also beside CalculiX, and the guaranteed bound. Tables go to doc/space, and into doc/space.md between its
marker comments. Runs that are there already are not repeated; --without million leaves some out; --large measures ten and thirty million
unknowns instead, of pairs ten on two processes, which wants 24 GB that are free; --draw runs nothing, and draws the charts and writes
the page from the tables of doc/space."""
import argparse
import concurrent.futures
import csv
import json
import os
import pathlib
import re
import resource
import subprocess
import sys
import time

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

parser = argparse.ArgumentParser()
parser.add_argument("--program", default="build/hpvi")
parser.add_argument("--output", default="output/space")
parser.add_argument("--unknowns", type=int, default=80000, help="the largest of the limits at which runs of the accuracy chart end")
parser.add_argument("--repeat", type=int, default=3, help="of runs that take a second")
parser.add_argument("--figures", default="doc/space")
parser.add_argument("--without", nargs="*", default=[], choices=["million", "speedup", "peer", "crossover", "accuracy", "coulomb", "robust", "coarse", "parts", "pairs", "press", "bound"])
parser.add_argument("--large", action="store_true", help="ten and thirty million unknowns, and the speed-up at millions; nothing else")
parser.add_argument("--draw", action="store_true", help="draw from the tables that are there")
options = parser.parse_args()
OUTPUT, FIGURES = pathlib.Path(options.output), pathlib.Path(options.figures)
for directory in (OUTPUT, FIGURES):
    directory.mkdir(parents=True, exist_ok=True)
os.environ.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMP_NUM_THREADS="1",
                  OMPI_MCA_mpi_yield_when_idle="1")


# Colours of Okabe and Ito, which the colour-blind tell apart; marker and line say the same in grey.
LOOKS = (("#0072b2", "o", "-"), ("#d55e00", "s", "--"), ("#009e73", "^", "-."), ("#000000", "D", ":"),
         ("#8a5a00", "v", "-"), ("#cc79a7", "P", "--"))


def measured(command):
    """Wall and user seconds of a command with its children."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime, time.monotonic()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return {"wall": time.monotonic() - start, "user": resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before}


def number(text):
    try:
        return float(text)
    except ValueError:  # an empty field, or counts by kind
        return float("nan")


def run(name, scene="prm/slab.prm", processes=1, **settings):
    """Rows of convergence.csv, with the seconds of the whole run."""
    directory = OUTPUT / name
    times = OUTPUT / f"{name}.json"
    if not times.exists():
        overrides = [word for key, value in {"Output/VTU": "false", "Error/Bound": "false", **settings}.items()
                     for word in ("--set", f"{key}={value}")]
        start = [] if processes == 1 else ["mpirun", "--oversubscribe", "--bind-to", "none", "-np", str(processes)]
        cost = measured([*start, options.program, "--output", str(directory), scene, *overrides])
        times.write_text(json.dumps(cost))
    cost = json.loads(times.read_text())
    with (directory / "convergence.csv").open(newline="") as file:
        rows = [{key: number(value) for key, value in row.items()} for row in csv.DictReader(file)]
    for row in rows:
        row["run_wall"], row["run_cpu"] = cost["wall"], cost["user"]
    return rows


def write(name, head, rows):
    with (FIGURES / name).open("w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([head, *rows])


def read(name):
    with (FIGURES / name).open(newline="") as file:
        return [{key: number(value) if key != "method" else value for key, value in row.items()}
                for row in csv.DictReader(file)]


def chart(name, x, y, curves, log_y=True, ticks=None):
    """Each curve has its name at its end, or where @p curves says: (points, index of a point, offset)."""
    figure, axes = plt.subplots(figsize=(6.6, 4.4), layout="constrained")
    for (colour, marker, line), (label, (points, k, offset)) in zip(LOOKS, curves.items()):
        axes.loglog(*zip(*points), color=colour, marker=marker, linestyle=line)
        axes.annotate(label, points[k], offset, textcoords="offset points", color=colour, fontsize=9,
                      ha="right" if offset[0] < 0 else "left", va="center")
    if not log_y:
        axes.set_yscale("linear")
        axes.set_ylim(0, 1.15 * axes.get_ylim()[1])
    for axis, values in zip((axes.xaxis, axes.yaxis), ticks or ()):  # of less than a decade or two
        axis.set_ticks(values, [f"{value:g}" for value in values])
        axis.set_ticks([], minor=True)
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    axes.margins(x=0.15)
    axes.grid(alpha=0.3)
    figure.savefig(FIGURES / name, dpi=100)
    plt.close(figure)


def series():
    """What ends the runs of a method: its first mesh of 2 x 2 x 1 elements, then limits of unknowns, each a quarter of the
    next, which end with the first mesh that has as many. Degrees 2 to 4 get at least three points."""
    limits = [limit for limit in (options.unknowns // 4 ** k for k in (2, 1, 0)) if limit >= 1000]  # more than a first mesh
    return [{"Adaptivity/Maximum steps": 1}, *({"Adaptivity/Maximum unknowns": limit, "Adaptivity/Maximum steps": 99}
                                               for limit in limits)]


def accuracy():
    """The error of J(u_N), friction taken at all points, which is at least half the squared energy norm's. No
    conforming u_N is below the minimum: the lowest value of all runs stands for it."""
    limit = run("limit", **{"Adaptivity/Method": "hap4", "Geometry/Subdivisions": "2, 2, 1", "Adaptivity/Maximum unknowns": 2 * options.unknowns})[-1]
    if "million" not in options.without:
        limit = min(limit, run("million", "doc/space/slab-million.prm", 2)[-1], key=lambda row: row["energy"])
    J = limit["energy"]
    methods = {"uniform Q2": "hup2", "uniform Q4": "hup4", "adaptive Q2": "hap2", "adaptive Q3": "hap3", "adaptive Q4": "hap4"}
    table = []
    for label, method in methods.items():
        for limits in series():  # each a run of its own: CPU seconds of runs are known, not those of steps
            row = run(f"{method}-{'-'.join(map(str, limits.values()))}",
                      **{"Adaptivity/Method": method, "Geometry/Subdivisions": "2, 2, 1", **limits})[-1]
            point = (label, int(row["dofs_free"]), row["energy"], abs(1 - row["energy"] / J), round(row["run_cpu"], 3))
            if not any(point[:2] == known[:2] for known in table):  # two limits may end at the same mesh
                table.append(point)
    if "peer" not in options.without:
        result = OUTPUT / "getfem.json"
        if not result.exists():
            result.write_text(subprocess.run(["/usr/bin/python3", "doc/space_peer.py", "1", "2", "4"], check=True,
                                             stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout)
        table += [("GetFEM, uniform Q2", n, energy, abs(1 - energy / J), round(cpu, 3))
                  for n, energy, cpu in json.loads(result.read_text())]
    write("accuracy.csv", ["method", "dofs_free", "energy", "error", "cpu_seconds"], table)
    draw_accuracy()
    print(f"limit {J:.6f} at {limit['dofs_free']:.0f} unknowns")


def draw_accuracy():
    points = {}
    for row in read("accuracy.csv"):
        points.setdefault(row["method"], []).append((row["cpu_seconds"], row["error"]))
    places = {"uniform Q2": (0, (8, 0)), "uniform Q4": (-1, (8, 0)), "adaptive Q2": (0, (-8, 0)), "adaptive Q3": (0, (-8, 0)),
              "adaptive Q4": (0, (8, 4)), "GetFEM, uniform Q2": (0, (8, 4))}
    chart("accuracy.png", "CPU time of a run [s]", "relative error of the energy [-]",
          {label: (points[label], *places[label]) for label in places if label in points})


def million():
    rows = run("million", "doc/space/slab-million.prm", 2)
    columns = ["dofs_free", "multipliers", "newton_steps", "newton_cg", "newton_setups", "slipping", "lagrangian",
               "peak_memory", "seconds"]
    write("million.csv", columns, [[round(row[c], 6) for c in columns] for row in rows])
    draw_million()
    print("million: wall {run_wall:.0f} s, CPU of both {run_cpu:.0f} s, {bytes:.2f} GB".format(
        bytes=rows[-1]["peak_memory"] / 1e9, **rows[-1]))


def draw_million():
    points = [(row["dofs_free"], row["newton_cg"]) for row in read("million.csv")]
    larger = sorted((row["dofs_free"], row["newton_cg"]) for row in read("large.csv") if row["processes"] == 2)
    chart("million.png", "free displacement unknowns of a mesh [-]", "conjugate-gradient steps on it [-]",
          {"doc/space/slab-million.prm on 2 processes": (points, 5, (-10, -14)),
           "last meshes from other coarse ones": (larger, 2, (-90, 14))}, log_y=False)


def large():
    """Runs of slab-million.prm whose last meshes are larger, by other coarse meshes; times of whole runs."""
    table = []
    for name, processes, subdivisions, limit in (("ten million", 2, "3, 3, 2", 6e6), ("thirty million", 2, "5, 5, 3", 1.2e7),
                                                 ("three million", 1, "3, 3, 2", 2e6), ("three million", 2, "3, 3, 2", 2e6)):
        last = run(f"large-{name}-{processes}".replace(" ", "-"), "doc/space/slab-million.prm", processes,
                   **{"Geometry/Subdivisions": subdivisions, "Adaptivity/Maximum unknowns": int(limit)})[-1]
        table.append([name, processes, *(int(last[key]) for key in ("dofs_free", "multipliers", "newton_steps", "newton_cg")),
                      last["lagrangian"], round(last["peak_memory"] / 1e9, 2), round(last["run_wall"], 1)])
        print(*table[-1], flush=True)
    write("large.csv", ["run", "processes", "dofs_free", "multipliers", "newton_steps", "newton_cg", "lagrangian", "gigabytes",
                        "wall_seconds"], table)
    print("speed-up: wall {:.2f}".format(table[2][-1] / table[3][-1]))


COARSE = {4: 4, 8: 3, 16: 2, 32: 1, 58: 1}  # cells along an edge of the coarse cube, meshes of the run


def coarse():
    """A cube on a rough floor, refined from coarse meshes of 64 to 2e5 cells: seconds and memory of whole runs over the cells."""
    table = []
    for n, meshes in COARSE.items():
        last = run(f"coarse-{n}", "doc/space/cube.prm", **{"Geometry/Subdivisions": f"{n}, {n}, {n}",
                                                           "Adaptivity/Maximum steps": meshes})[-1]
        table.append([n ** 3, meshes, int(last["dofs_free"]), int(last["newton_steps"]), int(last["newton_cg"]),
                      round(last["lagrangian"], 12), round(last["peak_memory"] / 1e9, 3), round(last["run_cpu"], 1)])
    write("coarse.csv", ["coarse_cells", "meshes", "dofs_free", "newton_steps", "newton_cg", "lagrangian", "gigabytes", "cpu_seconds"],
          table)
    draw_coarse()


def draw_coarse():
    rows = read("coarse.csv")
    chart("coarse.png", "cells of the coarse mesh [-]", "per million unknowns",
          {"CPU time of a run [s]": ([(row["coarse_cells"], 1e6 * row["cpu_seconds"] / row["dofs_free"]) for row in rows], 0, (0, 12)),
           "memory [GB]": ([(row["coarse_cells"], 1e6 * row["gigabytes"] / row["dofs_free"]) for row in rows], 1, (0, 10))})


def speedup():
    table = []
    for n in (1, 2):
        last = run(f"speedup-{n}", processes=n, **{"Adaptivity/Maximum unknowns": 100000})[-1]
        table.append([n, int(last["dofs_free"]), round(last["run_wall"], 1), round(last["run_cpu"] / n, 1), last["lagrangian"]])
    write("speedup.csv", ["processes", "dofs_free", "wall_seconds", "cpu_seconds_per_process", "lagrangian"], table)
    print("speed-up: wall {:.2f}, CPU {:.2f}".format(table[0][2] / table[1][2], table[0][3] / table[1][3]))


PLATE = {"Boundary left/Symmetry": "true", "Boundary front/Symmetry": "true", "Boundary right/Traction": "0.2; 0; 0",
         "Body force/Expression": "0; 0; -1"}  # beside doc/space/part.prm, whose part is a bracket
PARTS = [("bracket, extruded", {}, 2, 0.125), ("bracket, extruded", {}, 2, 0.0625), ("bracket, extruded", {}, 3, 0.1),
         ("plate, of tetrahedra", PLATE, 2, 0.3), ("plate, of tetrahedra", PLATE, 2, 0.15), ("plate, of tetrahedra", PLATE, 3, 0.25)]


def parts():
    """
    Meshes of Gmsh as they come, held by contact: wall seconds of whole runs and of their steps on one process and on two, and of two runs at once on one
    each, which share the machine as two processes do; by turns, the least of some.
    """
    table = []
    for part, entries, degree, size in PARTS:
        drawing = OUTPUT.resolve() / f"{part.split(',')[0]}-{size}.geo"
        drawing.write_text(re.sub("^h = .*", f"h = {size};", pathlib.Path(f"doc/space/{part.split(',')[0]}.geo").read_text(), flags=re.M))
        rows, beside = {1: [], 2: []}, []

        def last(name, n=1):
            return run(f"part-{part.split(',')[0]}-{degree}-{size}-{name}", "doc/space/part.prm", n, **entries,
                       **{"Geometry/File": drawing, "Adaptivity/Start degree": degree})[-1]
        for k in range(options.repeat):
            for n, of_n in rows.items():
                of_n.append(last(f"{n}-{k}", n))
            with concurrent.futures.ThreadPoolExecutor() as pool:
                beside.append(max(row["seconds"] for row in pool.map(last, (f"beside-{k}-{i}" for i in range(2)))))
        wall = {n: min(row["run_wall"] for row in of_n) for n, of_n in rows.items()}
        step = {n: min(row["seconds"] for row in of_n) for n, of_n in rows.items()}
        one, two = rows[1][0], rows[2][0]
        table.append([part, size, degree, int(one["elements"]), int(one["dofs_free"]), int(one["newton_steps"]), int(one["newton_cg"]), round(wall[1], 1), round(wall[2], 1),
                      round(step[1], 2), round(step[2], 2), round(step[1] / step[2], 2), round(2 * step[1] / min(beside), 2), f"{abs(1 - two['lagrangian'] / one['lagrangian']):.1e}"])
        print(*table[-1], flush=True)
    write("parts.csv", ["part", "mesh_size", "degree", "cells", "dofs_free", "newton_steps", "newton_cg", "wall_seconds_1", "wall_seconds_2", "step_seconds_1", "step_seconds_2",
                        "times_as_fast", "two_runs_at_once", "difference"], table)


PAIRS = [("two spheres", "prm/spheres.prm", {"Contact touch/Friction coefficient": 0.3, "Body upper/Material": "soft", "Material soft/Young's modulus": 70000,
                                             "Material soft/Poisson's ratio": 0.3}),
         ("sphere on a rigid plane", "doc/space/sphere.prm", {})]


def pairs():
    """A sphere on another one and on a rigid plane under Coulomb's law, on one process and on two: wall seconds and memory of whole runs, each to the first
    mesh of at least so many unknowns from coarse meshes of so many cells before they are graded. Rows of other runs stay."""
    table = []
    for limit, cells in ((3e6, "4, 5, 4"),) if options.large else ((1e5, "2, 2, 2"), (5e5, "2, 2, 2")):
        for name, scene, entries in PAIRS:
            entries = {**entries, **{f"{body}/Subdivisions": cells for body in (("Body upper", "Body lower") if "Body upper/Material" in entries else ("Geometry",))}}
            last = {n: run(f"pairs-{name}-{limit:g}-{cells}-{n}".replace(", ", "").replace(" ", "-"), scene, n, **entries,
                           **{"Adaptivity/Maximum unknowns": int(limit), "Adaptivity/Maximum steps": 99})[-1] for n in ((1, 2) if limit < 3e6 else (2,))}
            column = lambda key, digits, unit=1: [round(last[n][key] / unit, digits) if n in last else "-" for n in (1, 2)]
            table.append([int(limit), cells, name, *(int(last[2][key]) for key in ("dofs_free", "multipliers", "coulomb_fixed_point", "newton_steps", "newton_cg")),
                          *column("run_wall", 1), *column("seconds", 1), *column("peak_memory", 2, 1e9),
                          f"{abs(1 - last[2]['lagrangian'] / last[1]['lagrangian']):.1e}" if 1 in last else "-"])
            print(*table[-1], flush=True)
    if (FIGURES / "pairs.csv").exists():
        with (FIGURES / "pairs.csv").open(newline="") as file:
            table += [row for row in list(csv.reader(file))[1:] if (int(row[0]), row[1]) not in {(known[0], known[1]) for known in table}]
    write("pairs.csv", ["limit", "coarse_cells", "bodies", "dofs_free", "multipliers", "tresca_problems", "newton_steps", "newton_cg", "wall_seconds_1", "wall_seconds_2",
                        "step_seconds_1", "step_seconds_2", "gigabytes_1", "gigabytes_2", "difference"], sorted(table, key=lambda row: (row[2], int(row[3]))))
    draw_pairs()


def draw_pairs():
    with (FIGURES / "pairs.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    curves = {}
    for column, what in (("wall_seconds_2", "time of a run [s]"), ("gigabytes_2", "memory [GB]")):
        for name in sorted({row["bodies"] for row in rows}):
            points = [(float(row["dofs_free"]), float(row[column])) for row in rows if row["bodies"] == name]
            curves[f"{what}, {name}"] = (points, 1, (10, -10)) if name == "two spheres" else (points, -1, (-10, 12))
    chart("pairs.png", "free unknowns [-]", "on two processes", curves)


def press():
    """Two spheres with friction as meshes of second order: the force for a given approach, beside CalculiX. The reference is the last mesh of degree 3."""
    mesh = OUTPUT / "spheres.msh"
    mesh.write_text(subprocess.run([sys.executable, "doc/space_pair_peer.py", "--mesh", "4"], check=True, capture_output=True, text=True).stdout)
    scene = OUTPUT / "press.prm"
    scene.write_text(pathlib.Path("doc/space/press.prm").read_text())

    def force(name):
        with (OUTPUT / name / "forces.csv").open(newline="") as file:
            return {row["step"]: float(row["Fy"]) for row in csv.DictReader(file) if row["name"] == "lower.far"}
    table = []
    for degree, limit in ((2, 100000), (3, 300000)):
        name = f"press-{degree}"
        rows, forces = run(name, str(scene), **{"Adaptivity/Start degree": degree, "Adaptivity/Method": f"hap{degree}", "Adaptivity/Maximum unknowns": limit}), force(name)
        seconds = 0.
        for row in rows:
            seconds += row["seconds"]
            table.append([f"hpvi, degree {degree}", "", int(row["dofs_free"]), forces[f"{row['step']:.0f}"], round(seconds, 2), round(row["peak_memory"] / 1e9, 2)])
    reference = table[-1][3]
    for n, penalty in ((4, 500), (6, 500), (8, 50), (8, 500), (8, 5000), (10, 500)):
        result = OUTPUT / f"press-{n}-{penalty}.json"
        if not result.exists():
            result.write_text(subprocess.run([sys.executable, "doc/space_pair_peer.py", str(n), str(penalty)], check=True, capture_output=True, text=True).stdout)
        unknowns, found, seconds, gigabytes = json.loads(result.read_text())
        table.append(["CalculiX", penalty, unknowns, found, round(seconds, 2), round(gigabytes, 2)])
    write("press.csv", ["program", "penalty_over_E", "unknowns", "force", "seconds", "gigabytes", "error"],
          [[*row, f"{abs(row[3] / reference - 1):.2e}"] for row in table])


CUBE = {"Geometry/Upper corner": "1, 1, 1", "Geometry/Subdivisions": "2, 2, 2", "Material/Young's modulus": 1, "Boundary left/Traction": "",
        "Boundary right/Displacement": "", "Boundary left/Symmetry": "true", "Boundary back/Displacement": "0; 0; 0",
        "Boundary top/Traction": "0.05; -0.3*(1 + x^2); 0.1", "Body force/Expression": "0.1*x*y; 0; -0.3*exp(x)", "Boundary bottom/Friction bound": ""}
PRESSED = {"Boundary bottom/Contact": "unilateral", "Boundary bottom/Gap": "0.01 + 0.3*(x - 0.4)^2"}
FREE = {"Boundary bottom/Contact": "none", "Adaptivity/Method": "hup3"}
BOUNDED = [("slab", "prm/slab.prm", {}), ("slab, one end a hundred times as stiff", "prm/slab.prm",
                                          {"Material stiff/Where": "2 - x", "Material stiff/Young's modulus": 1500, "Material stiff/Poisson's ratio": 0.3}),
           ("dome", "prm/dome.prm", {}), ("cube on a curved floor", "prm/slab.prm", {**CUBE, **PRESSED}), ("cube on a flat floor", "prm/slab.prm", {**CUBE, "Boundary bottom/Contact": "unilateral"}),
           ("cube, free below", "prm/slab.prm", {**CUBE, "Boundary bottom/Contact": "none"}), ("cube, no contact, p = 3", "prm/slab.prm", {**CUBE, **FREE})]


def bound():
    """The guaranteed bound of the last step over the distance in energy from a far finer solution, and intervals of J beside its J."""
    table = []
    for name, scene, entries in BOUNDED:
        stem = f"bound-{re.sub('[^a-z]+', '-', name)}"
        J = run(f"{stem}-fine", scene, **{**entries, "Adaptivity/Method": "hap3", "Adaptivity/Maximum steps": 99, "Adaptivity/Maximum unknowns": 300000,
                                          "Output/Reference solution": "true"})[-1]["energy"]
        for limit in (3000, 12000):
            last = run(f"{stem}-{limit}", scene, **{"Error/Bound": "last step", "Adaptivity/Maximum steps": 99, **entries, "Adaptivity/Maximum unknowns": limit,
                                                         "Error/Reference solution": OUTPUT / f"{stem}-fine" / "reference.dat"})[-1]
            table.append([name, int(last["dofs_free"]), last["error_bound_relative"], last["error_bound"] / last["error_energy"], last["energy_low"], last["energy_high"], J,
                          last["seconds_bound"], last["seconds"] - last["seconds_bound"]])
            print(*table[-1], flush=True)
    write("bound.csv", ["scene", "dofs_free", "bound", "over_error", "energy_low", "energy_high", "energy_fine", "bound_seconds", "step_seconds"], table)


def crossover():
    """Example 5.2 with one row of elements: CPU seconds of a run, best of some, reading the scene included; the wall seconds
    of the primal path over those of its factorisations, in the run where that is least."""
    table = []
    for n in (250, 500, 1000, 2000):
        runs = {path: [run(f"{path}-{n}-{k}", "prm/han-6-12.prm",
                           **{"Geometry/Subdivisions": f"{n}, 1", "Adaptivity/Method": "hap2",
                              "Adaptivity/Maximum steps": 1, "Solver/Path": path})[-1] for k in range(options.repeat)]
                for path in ("reduced", "primal")}
        cpu = {path: min(row["run_cpu"] for row in rows) for path, rows in runs.items()}
        ratio = min(row["seconds"] / row["seconds_factor"] for row in runs["primal"])
        table.append([n, round(cpu["reduced"], 3), round(cpu["primal"], 3), round(ratio, 2)])
    write("crossover.csv", ["multipliers", "reduced_cpu_seconds", "primal_cpu_seconds", "step_over_factorisations"], table)
    draw_crossover()
    for row in table:
        print(*row)


def coulomb():
    """Problems of Tresca and linear systems of the largest mesh over the coefficient of friction."""
    rubbed = {"Boundary bottom/Friction bound": "", "Adaptivity/Maximum unknowns": 8000}
    problems = {"dome": ("prm/dome.prm", {}), "slab": ("prm/slab.prm", {"Boundary bottom/Contact": "unilateral"}),
                "block": ("prm/dome.prm", {"Boundary bottom/Gap": "", "Boundary top/Displacement": "0.04; -0.02; 0.02"})}
    table = []
    for name, (scene, entries) in problems.items():
        for mu in (0.1, 0.2, 0.5, 1, 2):
            try:
                last = run(f"coulomb-{name}-{mu}", scene, **{**rubbed, **entries, "Boundary bottom/Friction coefficient": mu})[-1]
            except subprocess.CalledProcessError:
                table.append([name, mu, *[""] * 7])
                continue
            table.append([name, mu, *(int(last[key]) for key in ("dofs_free", "slipping", "pressing", "coulomb_fixed_point",
                                                                  "newton_steps", "newton_cg")), int(last["augmented_steps"])])
    write("coulomb.csv", ["method", "coefficient", "dofs_free", "slipping", "pressing", "tresca_problems", "newton_steps",
                          "cg_steps", "augmented_steps"], table)
    draw_coulomb()
    for row in table:
        print(*row)


def draw_coulomb():
    rows = read("coulomb.csv")
    chart("coulomb.png", "coefficient of friction [-]", "Newton steps in all problems of Tresca of a mesh [-]",
          {name: ([(row["coefficient"], row["newton_steps"]) for row in rows if row["method"] == name], -1, offset)
           for name, offset in (("dome", (-4, -10)), ("slab", (-12, -2)), ("block", (-6, 8)))}, log_y=False)


def robust():
    """Steps of conjugate gradients per linear system on the largest mesh, where something makes systems hard, and what solved
    them: multigrid, or what took over where it gave up."""
    hard = {"Material hard/Where": "y - 1", "Material hard/Poisson's ratio": 0.4}
    cases = [("Poisson's ratio", nu, {"Material/Poisson's ratio": nu}) for nu in (0.3, 0.4, 0.45, 0.48, 0.49, 0.495)]
    cases += [("Poisson's ratio", 0.499, {"Material/Poisson's ratio": 0.499, "Adaptivity/Maximum unknowns": 10000})]  # locks
    cases += [("cells a:1:1", a, {"Geometry/Upper corner": f"{4 * a}, 4, 2"}) for a in (2, 3, 5, 10)]
    cases += [("cells a:1:a", a, {"Geometry/Upper corner": f"{4 * a}, 4, {2 * a}"}) for a in (2, 3, 5, 10)]
    cases += [("jump of E", j, {**hard, "Material hard/Young's modulus": 15 * j}) for j in (1e-4, 1e-2, 1e2, 1e4)]
    cases += [("jump of g", j, {"Boundary bottom/Friction bound": f"z < 1 ? 4.5 : {4.5 * j}"}) for j in (1e-4, 1e-2, 1e2, 1e4)]
    table = []
    for family, value, entries in cases:
        name = f"robust-{family}-{value}".replace(" ", "-").replace(":", "").replace("'", "")
        last = run(name, **{"Adaptivity/Maximum unknowns": 40000, **entries})[-1]
        taken = json.loads((OUTPUT / name / "summary.json").read_text())["linear"]
        table.append([family, value, int(last["dofs_free"]), taken, int(last["newton_steps"]),
                      round(last["newton_cg"] / last["newton_steps"], 1), round(last["run_cpu"], 2)])
        print(*table[-1], flush=True)
    write("robust.csv", ["case", "value", "dofs_free", "linear", "newton_steps", "cg_per_newton_step", "cpu_seconds"], table)


def draw_crossover():
    rows = read("crossover.csv")
    chart("crossover.png", "multipliers of friction [-]", "CPU time of a run [s]",
          {f"{path} path": ([(row["multipliers"], row[f"{path}_cpu_seconds"]) for row in rows], -1, (-10, 6))
           for path in ("reduced", "primal")}, ticks=([250, 500, 1000, 2000], [0.3, 0.5, 1, 2, 3]))


def count(field):
    """A whole number in groups of three digits."""
    return f"{int(float(field)):,}".replace(",", " ")


# Of each table in doc/space.md: headings, and what stands below them for a row of the table in doc/space.
PAGE = {
    "coarse": ("coarse cells | meshes | free unknowns | Newton steps, last mesh | conjugate-gradient steps | gigabytes | CPU seconds", lambda row: [
        count(row["coarse_cells"]), row["meshes"], count(row["dofs_free"]), row["newton_steps"], row["newton_cg"],
        f"{float(row['gigabytes']):.2f}", row["cpu_seconds"]]),
    "parts": ("part | degree | cells | free unknowns | Newton steps | conjugate-gradient steps | seconds of a run | on two processes | of its step | on two processes | times as fast | two runs at once", lambda row: [
        row["part"], row["degree"], count(row["cells"]), count(row["dofs_free"]), row["newton_steps"], row["newton_cg"],
        *(row[f"{what}_seconds_{n}"] for what in ("wall", "step") for n in (1, 2)), row["times_as_fast"], row["two_runs_at_once"]]),
    "pairs": ("bodies | free unknowns | multipliers | problems of Tresca | Newton steps | conjugate-gradient steps | seconds of a run | on two processes | of its last step | "
              "on two processes | gigabytes | on two processes", lambda row: [
                  row["bodies"], count(row["dofs_free"]), count(row["multipliers"]), row["tresca_problems"], row["newton_steps"], row["newton_cg"],
                  *(row[f"{what}_{n}"] for what in ("wall_seconds", "step_seconds", "gigabytes") for n in (1, 2))]),
    "press": ("program | penalty, of E per mm | unknowns | force, N | its error | seconds | gigabytes", lambda row: [
        row["program"], row["penalty_over_E"] or "-", count(row["unknowns"]), f"{float(row['force']):.3f}", row["error"], row["seconds"], row["gigabytes"]]),
    "bound": ("scene | free unknowns | bound | over the error | interval of J | J of a finer run | seconds of the bound | of the rest of its step",
              lambda row: [row["scene"], count(row["dofs_free"]), f"{float(row['bound']):.2g}", f"{float(row['over_error']):.2f}",
                           f"{float(row['energy_low']):.5g} to {float(row['energy_high']):.5g}", f"{float(row['energy_fine']):.6g}",
                           *(f"{float(row[what]):.2f}" for what in ("bound_seconds", "step_seconds"))]),
    "million": ("free unknowns | multipliers | Newton steps | conjugate-gradient steps | slipping discs | J (Lagrangian) | peak memory of both, bytes",
                lambda row: [*(count(row[name]) for name in ("dofs_free", "multipliers", "newton_steps", "newton_cg", "slipping")),
                             f"{float(row['lagrangian']):.6f}", f"{float(row['peak_memory']):.2e}"]),
    "large": ("free unknowns | multipliers | processes | Newton steps | conjugate-gradient steps | gigabytes | wall seconds", lambda row: [
        count(row["dofs_free"]), count(row["multipliers"]),
        *(row[name] for name in ("processes", "newton_steps", "newton_cg", "gigabytes", "wall_seconds"))]),
    "robust": ("case | value | free unknowns | Newton steps | conjugate-gradient steps each | CPU s of the run", lambda row: [
        row["case"], row["value"], count(row["dofs_free"]), *(row[name] for name in ("newton_steps", "cg_per_newton_step", "cpu_seconds"))]),
    "accuracy": ("method | free unknowns | relative error | CPU seconds of the run", lambda row: [
        row["method"], count(row["dofs_free"]), f"{float(row['error']):.2e}", f"{float(row['cpu_seconds']):.2f}"]),
    "crossover": ("multipliers | reduced path, CPU s of a run | primal path, CPU s of a run | primal step over its sparse factorisations",
                  lambda row: [count(row["multipliers"]),
                               *(row[name] for name in ("reduced_cpu_seconds", "primal_cpu_seconds", "step_over_factorisations"))]),
    "coulomb": ("problem | mu_f | free unknowns | slip, of points that press | problems of Tresca | Newton steps in all of them | conjugate-gradient steps",
                lambda row: [row["method"], row["coefficient"], count(row["dofs_free"]), f"{row['slipping']} of {row['pressing']}",
                             *(row[name] for name in ("tresca_problems", "newton_steps", "cg_steps"))])}


def write_page():
    page = pathlib.Path("doc/space.md")
    text = page.read_text()
    for name, (heads, cells) in PAGE.items():
        with (FIGURES / f"{name}.csv").open(newline="") as file:
            lines = [heads, "|".join(["---"] * len(heads.split(" | "))),
                     *(" | ".join(cells(row)) for row in csv.DictReader(file) if row.get("dofs_free", "-"))]
        table = "".join(f"| {line} |\n" if "---" not in line else f"|{line}|\n" for line in lines)
        text, found = re.subn(rf"(<!-- {name}: begin[^\n]*\n).*?(<!-- {name}: end)", lambda m: m[1] + table + m[2], text, flags=re.S)
        if found != 1:
            sys.exit(f"{page} has no place for the table {name}")
    page.write_text(text)


if options.draw:
    draw_accuracy()
    draw_million()
    draw_crossover()
    draw_coulomb()
    draw_coarse()
    draw_pairs()
for part in (large, pairs) if options.large else (million, accuracy, crossover, speedup, coulomb, robust, coarse, parts, pairs, press, bound):
    if not options.draw and part.__name__ not in options.without:
        part()
write_page()
