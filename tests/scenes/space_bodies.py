#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""space_bodies.py HPVI held|floating|files MPIRUN: boxes in space whose meshes do not match. Held by supports a uniform pressure
passes from one to the other exactly, with hanging nodes, for all degrees, also one a body, and on one to three
processes; forces balance on each body; either may be the slave; on a stiff body the other one is as on a rigid floor. Layers between planes of symmetry are the runs
of the plane, held and held by contact alone; a stack of three has one energy by all solvers and on one to three processes, and
what no contact holds is named. Volumes of one mesh file, whose faces are any quadrilaterals and turned about two axes, pass a pressure
as boxes do, are boxes where they have their cells, and are found by Between = automatic."""
import csv
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

from runs import PROGRAM as HPVI, SCENES, read_vtu

PART, MPIRUN = sys.argv[1:]  # runs.py has taken the program
# A block with E = 10 on one with E = 20, both between planes of symmetry, pressed together by an interference of 0.01:
# p = 0.01/(0.5/10 + 1/20) = 0.1.
SCENE = """set Dimension = 3
subsection Body high
  set Lower corner = 0, 1, 0
  set Upper corner = 1, 1.5, 1
  set Subdivisions = 3, 1, 3
  set Material     = soft
end
subsection Body low
  set Upper corner = 1, 1, 1
  set Subdivisions = 5, 1, 4
end
subsection Material
  set Young's modulus = 20
  set Poisson's ratio = 0.3
end
subsection Material soft
  set Young's modulus = 10
end
subsection Contact joint
  set Between = high.bottom, low.top
  set Gap     = -0.01
end
subsection Adaptivity
  set Method        = hup2
  set Maximum steps = 1
end
subsection Solver
  set Primal tolerance = 1e-13
end
"""
SYMMETRIC = [f"Boundary {side}/Symmetry=true" for side in ("high.top", "high.left", "high.front", "low.bottom", "low.left", "low.front")]
GRADED = ["Body high/Graded towards=0, 1, 0", "Body high/Grading levels=1", "Body low/Graded towards=1, 1, 1", "Body low/Grading levels=1"]
FRICTION = ["Boundary high.top/Displacement=0.02; -0.01; 0.01", "Boundary low.bottom/Displacement=0; 0; 0", "Contact joint/Gap="]
# Two bodies as a layer of one cell between z = 0 and 0.5, and the same in the plane, as strings of LAYERED.
LAYERED = """set Dimension = {dim}
subsection Body low
  set Lower corner = {lower}, -1{zero}
  set Upper corner = 3, 0{depth}
  set Subdivisions = 6, 2{one}
end
subsection Body high
  set Lower corner = 1, 0{zero}
  set Upper corner = 2, 1{depth}
  set Subdivisions = 5, 2{one}
  set Material     = soft
end
subsection Material
  set Young's modulus = 20
  set Poisson's ratio = 0.3
end
subsection Material soft
  set Young's modulus = 10
  set Poisson's ratio = 0.25
end
subsection Boundary low.bottom
  {floor}
end
subsection Boundary high.top
  {load}
end
{symmetry}subsection Contact joint
  set Between = high.bottom, low.top
  set Slave   = high.bottom
  {law}
end
subsection Adaptivity
  set Method        = hup2
  set Maximum steps = 1
end
subsection Solver
  set Normal contact = multiplier
  {tolerance}
end
"""
LAWS = ["set Friction bound = 0.055", "set Friction coefficient = 0.3", "set Law = tied",
        "set Law = bilateral", "set Gap = 0.01*(x - 1.5)^2\n  set Friction coefficient = 0.3"]
HELD = {"floor": "set Displacement = 0; 0{none}", "load": "set Displacement = 0.03; -0.02{none}"}
FLOATING = {"floor": "set Contact = unilateral\n  set Friction coefficient = 0.4", "load": "set Traction = 0.052; -0.2{none}"}
# Three boxes under their weight and a push along the joints, of which the lowest is held.
STACK = """set Dimension = 3
subsection Body top
  set Lower corner = 0.25, 1.5, 0.25
  set Upper corner = 0.75, 2, 0.75
end
subsection Body middle
  set Lower corner = 0, 1, 0
  set Upper corner = 1, 1.5, 1
  set Subdivisions = 4, 1, 4
end
subsection Body low
  set Upper corner = 1, 1, 1
  set Subdivisions = 3, 1, 3
end
subsection Material
  set Young's modulus = 10
  set Poisson's ratio = 0.3
end
subsection Boundary low.bottom
  set Displacement = 0; 0; 0
end
subsection Body force
  set Expression = 0.002; -0.01; 0.001
end
subsection Contact upper
  set Between              = middle.top, top.bottom
  set Friction coefficient = 0.5
end
subsection Contact lower
  set Between              = low.top, middle.bottom
  set Friction coefficient = 0.3
end
subsection Adaptivity
  set Method        = hup2
  set Maximum steps = 1
end
subsection Solver
  set Primal tolerance = 1e-11
end
"""
# Two volumes of blocks.msh. The ratio nu/E is the same: under a uniaxial stress both get equally wide, and nothing slips.
FILES = """set Dimension = 3
subsection Body high
  set Shape    = file
  set File     = blocks.msh
  set Surfaces = high
  set Material = soft
end
subsection Body low
  set Shape    = file
  set File     = blocks.msh
  set Surfaces = low
end
subsection Material
  set Young's modulus = 20
  set Poisson's ratio = 0.3
end
subsection Material soft
  set Young's modulus = 10
  set Poisson's ratio = 0.15
end
subsection Boundary low.bottom
  set Displacement = {floor}
end
subsection Boundary high.top
  {load}
end
subsection Contact joint
  set Between = high.seat, low.{lid}
  {law}
end
subsection Adaptivity
  set Method        = hup2
  set Maximum steps = 1
end
subsection Solver
  set Primal tolerance = 1e-13
end
"""
SIDES = ["left", "right", "bottom", "top", "front", "back"]
HIGH, LOW = ((0, 1, 0), (1, 1.5, 1)), ((0, 0, 0), (1, 1, 1))
failures = 0


def expect(is_so, *what):
    global failures
    if not is_so:
        failures += 1
        print("FAILED:", *what)


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def run(directory, entries, processes=1, scene=SCENE):
    start = [] if processes == 1 else [MPIRUN, "--oversubscribe", "--bind-to", "none", "-np", str(processes)]
    (directory / "blocks.prm").write_text(scene)
    overrides = [word for entry in entries for word in ("--set", entry)]
    return subprocess.run([*start, HPVI, "--output", str(directory / "out"), str(directory / "blocks.prm"), *overrides],
                          capture_output=True, text=True)


def solve(directory, entries, processes=1, scene=SCENE):
    """The contact points, the summary and the last row of the run."""
    done = run(directory, entries, processes, scene)
    if done.returncode != 0:
        sys.exit(f"{entries}: status {done.returncode}\n{done.stdout}{done.stderr}")
    out = directory / "out"
    table = rows(out / "convergence.csv")
    return rows(out / f"contact-{len(table):02}.csv"), json.loads((out / "summary.json").read_text()), table[-1]


def turned(x):
    """About z, and then about x."""
    c, s, d, t = math.cos(0.5), math.sin(0.5), math.cos(0.3), math.sin(0.3)
    y = c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]
    return y[0], d * y[1] - t * y[2], t * y[1] + d * y[2]


def write_mesh(path, volumes, place=lambda x: x, share=False):
    """Volumes as (name, (low, high), cells along each axis, seed, {side: name of its surface}[, map]): grids whose inner lines along y are moved
    where there is a seed. share: volumes have corners at one place in common, and the face between them."""
    nodes, known, elements, surfaces, seen = [], {}, [], {}, set()
    for number, (_, (low, high), n, seed, names, *bend) in enumerate(volumes, 1):
        dice = random.Random(seed)
        moved = {(i, k): [dice.uniform(-0.25, 0.25) if seed else 0 for _ in range(2)] for i in range(1, n[0]) for k in range(1, n[2])}

        def node(i, j, k):
            x, z = moved.get((i, k), (0, 0))
            at = [low[d] + (high[d] - low[d]) * w / n[d] for d, w in enumerate((i + x, j, k + z))]
            at = place(bend[0](at) if bend else at)
            key = tuple(round(a, 9) for a in at) if share else (number, i, j, k)
            if key not in known:
                nodes.append(at)
                known[key] = len(nodes)
            return known[key]

        for cell in [(i, j, k) for i in range(n[0]) for j in range(n[1]) for k in range(n[2])]:
            for side, name in enumerate(SIDES):
                d, end = divmod(side, 2)
                if cell[d] == (n[d] - 1 if end else 0):
                    corners = []
                    for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                        at = [a, b]
                        at.insert(d, end)
                        corners.append(node(*(c + w for c, w in zip(cell, at))))
                    if tuple(sorted(corners)) not in seen:
                        seen.add(tuple(sorted(corners)))
                        group = surfaces.setdefault(names.get(side, name), len(surfaces) + 1)
                        elements.append((3, group, corners))
            around = ((0, 0), (1, 0), (1, 1), (0, 1))
            elements.append((5, number, [node(cell[0] + a, cell[1] + b, cell[2] + c) for c in (0, 1) for a, b in around]))
    groups = [f'2 {tag} "{name}"' for name, tag in surfaces.items()] + [f'3 {tag} "{name}"' for tag, (name, *_) in enumerate(volumes, 1)]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(groups)), *groups, "$EndPhysicalNames",
             "$Nodes", str(len(nodes)), *(f"{tag} {' '.join(map(repr, x))}" for tag, x in enumerate(nodes, 1)), "$EndNodes",
             "$Elements", str(len(elements)),
             *(f"{tag} {kind} 2 {group} {group} {' '.join(map(str, own))}" for tag, (kind, group, own) in enumerate(elements, 1)), "$EndElements"]
    path.write_text("\n".join(lines) + "\n")


def uniaxial(normal, pressure=0.1, E=20, nu=0.3):
    """The displacement of the lower block under this pressure, as three expressions."""
    strain = [[pressure / E * (nu * (i == j) - (1 + nu) * normal[i] * normal[j]) for j in range(3)] for i in range(3)]
    return "; ".join(" + ".join(f"({value!r})*{axis}" for value, axis in zip(row, "xyz")) for row in strain)


def largest(points, column, value):
    return max(abs(float(point[column]) - value) for point in points)


def check_pressure(scratch):
    """A uniform pressure is exact to round-off, whichever body has it and however cells lie."""
    for degree, extra, processes in ((2, GRADED, 1), (3, GRADED, 1), (4, [], 1), (2, GRADED, 2), (3, [], 3),
                                     (2, ["Contact joint/Slave=high.bottom"], 1), (2, ["Solver/Linear=amg"], 1),
                                     (2, ["Solver/Linear=direct", *GRADED], 2),
                                     (2, ["Body high/Start degree=4", *GRADED], 1), (4, ["Body high/Start degree=2", *GRADED], 1),
                                     (2, ["Body low/Start degree=3", *GRADED], 3), (3, ["Body low/Start degree=2", "Contact joint/Slave=high.bottom"], 2),
                                     (2, ["Contact joint/Law=bilateral", "Contact joint/Gap=", "Boundary high.top/Symmetry=false",
                                          "Boundary high.top/Traction=0; -0.1; 0"], 1)):
        name = (degree, extra, processes)
        points, summary, row = solve(scratch, [*SYMMETRIC, f"Adaptivity/Method=hup{degree}", *extra], processes)
        # Conjugate gradients end at 0.3e-13 of the loads; a pressure is a force over an area of 0.06 and less.
        tolerance = 1e-11 if "Solver/Linear=amg" in extra else 1e-12
        expect(largest(points, "normal_traction", -0.1) < tolerance, name, largest(points, "normal_traction", -0.1))
        expect(float(row["estimate_relative"]) < 1e-9, name, "estimate", row["estimate_relative"])
        expect(summary["balance"]["force"] < 1e-11, name, summary["balance"])
        check_bodies_of_cells(scratch / "out")


def check_bodies_of_cells(out):
    """In all pieces of a file: 0 is the upper one."""
    for path in out.glob("solution-*.vtu"):
        grid = read_vtu(path)
        expect(len(grid["body"]) == len(grid["cells"]) > 0, path.name)
        for cell, body in zip(grid["cells"], grid["body"]):
            expect(body == (max(grid["points"][k][1] for k in cell) < 1.001), path.name, body)


def check_degrees(scratch):
    """A body with a degree of its own goes through load steps and on from a state as others do, on two processes as on one."""
    entries = [*FRICTION, *GRADED, "Body high/Start degree=3", "Contact joint/Friction coefficient=0.3", "Adaptivity/Method=hap2",
               "Adaptivity/Maximum steps=2", "Solver/Primal tolerance=1e-11"]
    moved = ["Boundary high.top/Displacement=0.02*sin(2*t); -0.01; 0.01", "Loading/Steps=2"]
    known = None
    for processes in (1, 2):
        solve(scratch, [*entries, *moved], processes)
        loads = rows(scratch / "out" / "loading.csv")
        known = known or loads
        for load, other in zip(loads, known, strict=True):
            for column in ("stored_energy", "dissipated_energy", "work"):
                expect(abs(float(load[column]) - float(other[column])) < 1e-9 * abs(float(known[-1]["stored_energy"])), column, load, other)
    solve(scratch, [*entries, "Adaptivity/Maximum steps=1"])
    went_on = subprocess.run([HPVI, "--resume", str(scratch / "out"), "--set", "Adaptivity/Maximum steps=2"], capture_output=True, text=True)
    expect(went_on.returncode == 0, went_on.stderr)
    resumed = rows(scratch / "out" / "convergence.csv")
    solve(scratch, entries)
    whole = rows(scratch / "out" / "convergence.csv")
    for one, other in zip(resumed, whole, strict=True):
        expect((one["p_min"], one["p_max"]) == ("2", "3") and abs(float(one["lagrangian"]) / float(other["lagrangian"]) - 1) < 1e-12, one, other)


def check_friction(scratch):
    """Both bodies balance, forces are those of the other, and either may have the multipliers."""
    known = {}
    for slave in ("high.bottom", "low.top"):
        for law in ("Friction coefficient=0.3",):
            points, summary, row = solve(scratch, [*FRICTION, f"Contact joint/Slave={slave}", f"Contact joint/{law}",
                                                   "Solver/Primal tolerance=1e-10", "Adaptivity/Maximum steps=2"])
            forces = {name: entry["force"] for name, entry in summary["forces"].items()}
            for d in range(3):
                expect(abs(forces["high.bottom"][d] + forces["low.top"][d]) < 1e-9, slave, law, forces)
                expect(abs(forces["low.top"][d] + forces["low.bottom"][d]) < 1e-8, slave, law, forces)
            expect(all(float(point["normal_traction"]) <= 1e-12 for point in points), slave, law, "tension")
            other = known.setdefault(law, forces["high.bottom"])
            for d in range(3):
                expect(abs(other[d] - forces["high.bottom"][d]) < 2e-3 * max(map(abs, other)), slave, law, other, forces)


def check_stiffness(scratch):
    """A stiff body under the block is a rigid floor, up to 1/E."""
    away = []
    for stiff in ("1e4", "1e5"):
        points, summary, row = solve(scratch, [*FRICTION, f"Material/Young's modulus={stiff}", "Contact joint/Friction bound=0.03",
                                               "Body low/Subdivisions=3, 1, 3", "Solver/Primal tolerance=1e-11"])
        away.append(summary["forces"]["high.top"]["force"][0])
    rigid = solve(scratch, [*FRICTION, "Material/Young's modulus=1e9", "Contact joint/Friction bound=0.03",
                            "Body low/Subdivisions=3, 1, 3", "Solver/Primal tolerance=1e-11"])[1]["forces"]["high.top"]["force"][0]
    expect(0.08 < (away[1] - rigid) / (away[0] - rigid) < 0.12, "stiff", away, rigid)


def check_layers(scratch, held, laws, entries=(), column="lagrangian", tolerance=1e-8):
    """A layer has the energy per thickness of the plane, with meshes that do not match."""
    for law in laws:
        energies = []
        for dim in (2, 3):
            symmetry = "".join(f"subsection Boundary {body}.{side}\n  set Symmetry = true\nend\n"
                               for body in ("low", "high") for side in ("front", "back"))
            in_space = {"zero": ", 0", "depth": ", 0.5", "one": ", 1", "none": "; 0", "symmetry": symmetry, "tolerance": "set Primal tolerance = 1e-12"}
            if dim == 2:
                in_space = dict.fromkeys(in_space, "")
            sides = {side: text.format(**in_space) for side, text in held.items()}
            scene = LAYERED.format(dim=dim, lower=0, law=law, **sides, **in_space)
            row = solve(scratch, entries, scene=scene if dim == 3 else scene + "subsection Error\n  set Bound = false\nend\n")[2]
            if entries:
                row = rows(scratch / "out" / "loading.csv")[-1]
            energies.append(float(row[column]) / (0.5 if dim == 3 else 1))
        expect(abs(energies[1] / energies[0] - 1) < tolerance, law, energies)


def check_stack(scratch):
    """Contact alone holds two of three bodies: one energy, and both balance."""
    known = None
    for entries, processes in (([], 1), (["Solver/Linear=amg"], 1), (["Solver/Linear=direct"], 2), ([], 3)):
        points, summary, row = solve(scratch, entries, processes, STACK)
        known = known or float(row["lagrangian"])
        expect(abs(float(row["lagrangian"]) / known - 1) < 1e-9, entries, processes, row["lagrangian"], known)
        for side, volume in {"top.bottom": 0.125, "middle.bottom": 0.625}.items():
            for found, force in zip(summary["forces"][side]["force"], (0.002, -0.01, 0.001)):
                expect(abs(found + volume * force) < 1e-9 * volume, side, summary["forces"][side], volume)
        expect(all(float(point["normal_traction"]) <= 1e-12 for point in points), "tension")
    glued = solve(scratch, ["Contact upper/Law=tied", "Contact upper/Friction coefficient="], scene=STACK)[1]
    expect(abs(glued["forces"]["top.bottom"]["force"][1] - 0.00125) < 1e-11, "glued", glued["forces"]["top.bottom"])


def check_motions(scratch):
    """What no contact holds is named, with both forces, or refused before."""
    for entries, status, words in (
            (["Contact lower/Friction coefficient=0.2"], 2,
             "sliding: the loads push top, middle along (0.894427, 0, 0.447213) with 0.001397542486, contact can resist with 0.00125 at most"),
            (["Contact upper/Friction coefficient=0.2"], 2,
             "with 0.0002795084972, contact can resist with 0.00025 at most"),
            (["Body force/Expression=0; 0.01; 0"], 2, "lifting off: the loads push top, middle along (0, 1, 0) with 0.00625"),
            (["Body force/Expression=0.02; -0.01; 0"], 2, "toppling: the loads turn top"),
            (["Contact upper/Law=bilateral", "Contact lower/Law=bilateral", "Contact upper/Friction coefficient=", "Contact lower/Friction coefficient="], 1,
             "Body top: its supports leave a rigid-body motion free, translation in x, and no friction resists it; prescribe a displacement")):
        done = run(scratch, entries, scene=STACK)
        expect(done.returncode == status and words in done.stderr, entries, done.returncode, done.stderr)
    alone = STACK.replace("""subsection Contact upper
  set Between              = middle.top, top.bottom
  set Friction coefficient = 0.5
end
""", "")
    done = run(scratch, [], scene=alone)
    expect(done.returncode == 1 and "Body top: its supports leave a rigid-body motion free, translation in x, and it touches nothing" in done.stderr, done.stderr)


def check_shipped(scratch):
    """Scenes of prm/ by statics, and by Hertz as far as their meshes and blocks go."""
    scene = (SCENES / "clamped-plates.prm").read_text()
    forces = solve(scratch, ["Adaptivity/Maximum unknowns=2000", "Solver/Primal tolerance=1e-11"], scene=scene)[1]["forces"]
    for side, force in {"washer.bottom": (0, 10000, 0), "lower.left": (-2400, 0, 0)}.items():
        expect(max(abs(a - b) for a, b in zip(forces[side]["force"], force)) < 1e-4, side, forces[side])
    points = solve(scratch, ["Adaptivity/Maximum unknowns=30000"], scene=(SCENES / "spheres.prm").read_text())[0]
    largest_pressure = -min(float(point["normal_traction"]) for point in points)
    expect(abs(largest_pressure / 4354 - 1) < 0.02, "spheres", largest_pressure)


def check_skew_pressure(scratch):
    """Of volumes with and without common corners, on faces that are no parallelograms."""
    normal = turned((0, 1, 0))
    entries = {"floor": uniaxial(normal), "load": "set Pressure = 0.1"}
    high, low = ("high", HIGH, (3, 1, 3), 1, {2: "seat"}), ("low", LOW, (5, 1, 4), 2, {3: "lid"})
    corner, other = (", ".join(map(repr, turned(x))) for x in ((0, 1, 0), (1, 1, 1)))
    graded = [f"Body high/Graded towards={corner}", "Body high/Grading levels=1", f"Body low/Graded towards={other}", "Body low/Grading levels=1"]
    friction, tied = "set Friction coefficient = 0.3", "set Law = tied"
    for degree, share, law, extra, processes in (
            (2, False, friction, graded, 1), (3, False, friction, [], 2), (4, False, tied, [], 1), (2, False, tied, graded, 3),
            (2, False, friction, ["Contact joint/Slave=high.seat", "Solver/Linear=direct"], 1), (3, True, friction, [], 1),
            (2, False, friction, ["Contact joint/Between=automatic"], 1)):
        write_mesh(scratch / "blocks.msh", (("high", HIGH, (3, 1, 3), 1, {2: "seat"}), ("low", LOW, (3, 1, 3), 1, {3: "seat"})) if share else (high, low),
                   turned, share)
        scene = FILES.format(law=law, lid="seat" if share else "lid", **entries)
        points, summary, row = solve(scratch, [f"Adaptivity/Method=hup{degree}", *extra], processes, scene)
        name = (degree, share, law, extra, processes)
        if "tied" not in law:
            expect(largest(points, "normal_traction", -0.1) < 1e-12, name, largest(points, "normal_traction", -0.1))
        expect(float(row["estimate_relative"]) < 1e-9, name, "estimate", row["estimate_relative"])
        force = summary["forces"]["high.seat"]["force"]
        expect(max(abs(f - 0.1 * n) for f, n in zip(force, normal)) < 1e-12, name, force)


def check_file_of_boxes(scratch):
    """A file with the cells of boxes is the boxes, and turned about two axes, too."""
    names = dict(floor="0; 0; 0", law="set Friction coefficient = 0.3", lid="lid")
    boxes = FILES.format(load="set Displacement = 0.02; -0.01; 0.01", **names)
    volumes = ("high", HIGH, (3, 1, 3), None, {2: "seat"}), ("low", LOW, (5, 1, 4), None, {3: "lid"})
    energies = []
    for place in (None, lambda x: x, turned):
        scene = boxes
        if place is None:
            for name, (low, high), n, side, own in (("high", HIGH, (3, 1, 3), "bottom", "seat"), ("low", LOW, (5, 1, 4), "top", "lid")):
                shape = "\n  ".join(f"set {key} = {', '.join(map(str, value))}" for key, value in
                                    (("Lower corner", low), ("Upper corner", high), ("Subdivisions", n)))
                scene = scene.replace(f"set Shape    = file\n  set File     = blocks.msh\n  set Surfaces = {name}", shape).replace(f"{name}.{own}", f"{name}.{side}")
        else:
            write_mesh(scratch / "blocks.msh", volumes, place)
            scene = boxes.replace("0.02; -0.01; 0.01", "; ".join(map(repr, place((0.02, -0.01, 0.01)))))
        energies.append(float(solve(scratch, ["Adaptivity/Maximum steps=2", "Solver/Primal tolerance=1e-11"], scene=scene)[2]["lagrangian"]))
    expect(max(abs(energy / energies[0] - 1) for energy in energies) < 1e-9, "boxes", energies)


def check_many_coarse_cells(scratch):
    """Coarse meshes of more than 12000 unknowns keep multigrid, which finds what ML does, also of two degrees."""
    cells = ["Body low/Subdivisions=8, 5, 8", "Body high/Subdivisions=6, 4, 6", "Contact joint/Friction coefficient=0.3", "Solver/Primal tolerance=1e-9"]
    for own, most in ([], 6), (["Body low/Subdivisions=8, 6, 8", "Body high/Subdivisions=4, 3, 4", "Body high/Start degree=3"], 10):
        known = float(solve(scratch, [*FRICTION, *cells, *own, "Solver/Linear=amg"])[2]["lagrangian"])
        for processes in (1, 2):
            row, linear = (lambda result: (result[2], result[1]["linear"]))(solve(scratch, [*FRICTION, *cells, *own], processes))
            expect(linear == "multigrid" and int(row["newton_cg"]) < most * int(row["newton_steps"]), "coarse", own, processes, linear, row)
            expect(abs(float(row["lagrangian"]) / known - 1) < 1e-8, "coarse", own, processes, row["lagrangian"], known)


def check_slanted(scratch):
    """Sides at an angle are at a distance that varies: as flat ones at that Gap, but for the angle; and each body balances."""
    forces = []
    for angle in (0.02, 0):
        high = "high", HIGH, (3, 1, 3), None, {2: "seat"}, lambda x: (x[0], x[1] + angle * x[0] * (3 - 2 * x[1]), x[2])
        write_mesh(scratch / "blocks.msh", (high, ("low", LOW, (5, 1, 4), None, {3: "lid"})))
        scene = FILES.format(floor="0; 0; 0", load="set Displacement = 0.02; -0.02; 0.01", law="set Friction coefficient = 0.3", lid="lid")
        gap = [] if angle else ["Contact joint/Gap=0.02*x"]
        summary = solve(scratch, ["Adaptivity/Maximum steps=2", "Solver/Primal tolerance=1e-11", *gap], scene=scene)[1]
        forces.append(summary["forces"]["high.seat"]["force"])
        for a, b in zip(forces[-1], summary["forces"]["high.top"]["force"]):
            expect(abs(a + b) < 1e-9, "slanted", summary["forces"])
    expect(max(abs(a - b) for a, b in zip(*forces)) < 0.05 * max(map(abs, forces[1])), "slanted", forces)


with tempfile.TemporaryDirectory() as scratch:
    scratch = pathlib.Path(scratch)
    if PART == "held":
        check_pressure(scratch)
        check_degrees(scratch)
        check_friction(scratch)
        check_stiffness(scratch)
        check_shipped(scratch)
    elif PART == "files":
        check_skew_pressure(scratch)
        check_file_of_boxes(scratch)
        check_slanted(scratch)
        check_many_coarse_cells(scratch)
    else:
        check_layers(scratch, HELD, LAWS)
        # Friction's work by the rules of plane and space, whose points differ: to and fro.
        moved = {**HELD, "load": "set Displacement = 0.03*sin(pi*t); -0.02{none}"}
        check_layers(scratch, moved, LAWS[1:2], ["Loading/Steps=4"], "dissipated_energy", 1e-5)
        # One of the two is heated, and what is held warps, in load steps as well.
        hot = "\nend\nsubsection Material soft\n  set Thermal expansion = 0.001\nend\nsubsection Temperature\n  set Expression = {}"
        check_layers(scratch, HELD, [law + hot.format("10*x*(1 - y)") for law in LAWS[1:4]])
        check_layers(scratch, moved, [LAWS[0] + hot.format("20*t")], ["Loading/Steps=2"], "stored_energy")
        check_layers(scratch, FLOATING, [law for law in LAWS if "bilateral" not in law])
        check_stack(scratch)
        check_motions(scratch)
sys.exit(failures > 0)
