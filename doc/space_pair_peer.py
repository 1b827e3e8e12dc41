#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""space_pair_peer.py N [PENALTY]: the problem of doc/space/press.prm by CalculiX on N x N x N hexahedra of 20 nodes a body, graded
towards the contact; contact between surfaces, with a penalty of 50 E unless told otherwise. Prints [unknowns, force on the lower body, wall
seconds of CalculiX, gigabytes] as JSON. space_pair_peer.py --mesh N > spheres.msh: such a mesh of 27 nodes for hpvi, in format 2.2."""
import itertools
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

WIDTH, CURVATURE, DEPTH, FRICTION, POISSON = 2.0, 1 / 20, 0.02, 0.3, 0.3
MODULI = {"upper": 70000.0, "lower": 210000.0}
CORNERS = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
# In the order of Gmsh; CalculiX has the edges below, above, upright.
EDGES = [(0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 7), (5, 6), (6, 7)]
EDGES_OF_CALCULIX = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
FACES = [(0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]  # S1 to S6 of CalculiX
SIDES = ("left", "front", "touching", "far")


def middle(points):
    return tuple(sum(x) // len(points) for x in zip(*points))


class Body:
    """A block whose side towards the other one is a paraboloid of second order, as cells of such nodes are, too. Nodes are named by integers,
    even ones at corners; corners along an edge are at s^2."""

    def __init__(self, name, n, first):
        self.name, self.n, self.first, self.tags = name, n, first, {}
        self.cells = []
        for at in itertools.product(range(0, 2 * n, 2), repeat=3):
            corners = [tuple(a + b for a, b in zip(at, corner)) for corner in CORNERS]
            # The lower body is a mirror image: its cells are told from their other end.
            self.cells.append(corners if name == "upper" else corners[4:] + corners[:4])

    def place(self, at):
        x, y, z = ((k // 2 / self.n) ** 2 / 2 + ((k + 1) // 2 / self.n) ** 2 / 2 for k in at)
        rise = CURVATURE * WIDTH**2 * (x * x + z * z)
        rise += (WIDTH - rise) * y
        return (WIDTH * x, rise if self.name == "upper" else -rise, WIDTH * z)

    def tag(self, at):
        return self.tags.setdefault(at, self.first + len(self.tags) + 1)

    def faces(self, side):
        """Cell, number and corners of each."""
        axis, value = {"left": (0, 0), "front": (2, 0), "touching": (1, 0), "far": (1, 2 * self.n)}[side]
        for c, corners in enumerate(self.cells):
            for f, face in enumerate(FACES):
                if all(corners[v][axis] == value for v in face):
                    yield c, f, [corners[v] for v in face]


def bodies(n, edges):
    """With all nodes tagged: corners, those of edges, and of cells for hpvi those of faces and the middle."""
    result = []
    for name in MODULI:
        body = Body(name, n, len(result[0].tags) if result else 0)
        body.elements = [[body.tag(at) for at in nodes(corners, edges)] for corners in body.cells]
        result.append(body)
    return result


def nodes(corners, edges):
    result = corners + [middle([corners[v] for v in edge]) for edge in edges]
    if edges is EDGES:
        in_order = [(0, 3, 2, 1), (0, 1, 5, 4), (0, 4, 7, 3), (1, 2, 6, 5), (2, 3, 7, 6), (4, 5, 6, 7)]
        result += [middle([corners[v] for v in face]) for face in in_order] + [middle(corners)]
    return result


def mesh(n):
    """For hpvi."""
    both = bodies(n, EDGES)
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(SIDES) + 2)]
    lines += [f'2 {s + 1} "{side}"' for s, side in enumerate(SIDES)]
    elements = []
    for b, body in enumerate(both):
        lines.append(f'3 {b + 1} "{body.name}"')
        elements += [f"12 2 {b + 1} {b + 1} " + " ".join(map(str, element)) for element in body.elements]
        for s, side in enumerate(SIDES):
            for _, _, face in body.faces(side):
                at = face + [middle([face[k], face[(k + 1) % 4]]) for k in range(4)] + [middle(face)]
                elements.append(f"10 2 {s + 1} {s + 1} " + " ".join(str(body.tags[x]) for x in at))
    rows = [f"{tag} " + " ".join(f"{x:.15g}" for x in body.place(at)) for body in both for at, tag in body.tags.items()]
    lines += ["$EndPhysicalNames", "$Nodes", str(len(rows)), *rows, "$EndNodes", "$Elements", str(len(elements))]
    return "\n".join(lines + [f"{k + 1} {line}" for k, line in enumerate(elements)] + ["$EndElements"])


def wrapped(numbers):
    numbers = list(map(str, numbers))
    return [", ".join(numbers[k : k + 10]) + "," for k in range(0, len(numbers), 10)]


def deck(n, penalty):
    both = bodies(n, EDGES_OF_CALCULIX)
    lines = ["*NODE, NSET=all"]
    lines += [f"{tag}, " + ", ".join(f"{x:.12g}" for x in body.place(at)) for body in both for at, tag in body.tags.items()]
    first = 0
    for body in both:
        lines.append(f"*ELEMENT, TYPE=C3D20, ELSET={body.name}")
        for e, element in enumerate(body.elements):
            lines += [f"{first + e + 1}, " + ", ".join(map(str, element[:10])) + ",", ", ".join(map(str, element[10:]))]
        lines += [f"*MATERIAL, NAME={body.name}", "*ELASTIC", f"{MODULI[body.name]}, {POISSON}", f"*SOLID SECTION, ELSET={body.name}, MATERIAL={body.name}"]
        lines.append(f"*SURFACE, NAME={body.name}-touching, TYPE=ELEMENT")
        lines += [f"{first + c + 1}, S{f + 1}" for c, f, _ in body.faces("touching")]
        for side, axis, value in (("left", 0, 0), ("front", 2, 0), ("far", 1, 2 * n)):
            lines += [f"*NSET, NSET={body.name}-{side}"] + wrapped(tag for at, tag in body.tags.items() if at[axis] == value)
        first += len(body.elements)
    lines += ["*SURFACE INTERACTION, NAME=touch", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{penalty * MODULI['lower']:.9g}"]
    lines += ["*FRICTION", f"{FRICTION}, {penalty * MODULI['lower'] / 10:.9g}", "*CONTACT PAIR, INTERACTION=touch, TYPE=SURFACE TO SURFACE"]
    lines += ["upper-touching, lower-touching", "*BOUNDARY"]
    lines += [f"{body}-{side}, {k}, {k}" for body in MODULI for side, k in (("left", 1), ("front", 3))] + ["lower-far, 2, 2"]
    lines += ["*STEP, INC=1000", "*STATIC", "1., 1.", "*BOUNDARY", f"upper-far, 2, 2, {-DEPTH}", "*NODE PRINT, NSET=lower-far, TOTALS=ONLY", "RF", "*END STEP"]
    return "\n".join(lines) + "\n", 3 * (len(both[0].tags) + len(both[1].tags))


def solve(n, penalty):
    text, unknowns = deck(n, penalty)
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "CCX_NPROC_STIFFNESS": "1", "CCX_NPROC_EQUATION_SOLVER": "1"}
    with tempfile.TemporaryDirectory() as home:
        pathlib.Path(home, "deck.inp").write_text(text)
        begin = time.perf_counter()
        run = subprocess.run(["/usr/bin/time", "-f", "%M", "ccx", "-i", "deck"], cwd=home, env=environment, capture_output=True, text=True, check=False)
        seconds = time.perf_counter() - begin
        found = re.findall(r"total force.*\n\s*\n\s*\S+\s+(\S+)", pathlib.Path(home, "deck.dat").read_text())
        if run.returncode or not found:
            sys.exit(f"CalculiX: {(run.stdout + run.stderr)[-800:]}")
        return [unknowns, float(found[-1]), seconds, int(run.stderr.split()[-1]) / 1e6]


if sys.argv[1] == "--mesh":
    print(mesh(int(sys.argv[2])))
else:
    print(json.dumps(solve(int(sys.argv[1]), float((sys.argv[2:] or [50])[0]))))
