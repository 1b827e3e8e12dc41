#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""calculix_peer.py CASE even|graded|regraded N nodes|surfaces|mortar STIFFNESS [DIRECTORY]: a scene of hpvi by CalculiX with quadratic elements, on the
meshes of getfem_peer.py. The plane is a layer of elements that are held. Contact takes a penalty of STIFFNESS times
Young's modulus per length unit. Writes the input, runs ccx, and prints as JSON what problems are compared by, and wall and CPU seconds of ccx."""
import json
import pathlib
import re
import resource
import subprocess
import sys
import tempfile
import time

import numpy as np

import problems

SCALE = 1. if sys.argv[1] == "ssnv128" else 1e-3  # displacements so small that contact is where it is drawn
NO_SOLUTION = 3  # status of a peer that gives up, unlike that of a mistake
TYPES = {"nodes": "NODE TO SURFACE", "surfaces": "SURFACE TO SURFACE", "mortar": "MORTAR"}


class Body:
    """Quadrilaterals of eight nodes on a grid, or bricks of twenty, one thick; numbers begin after those of the body before.
    Its sides are 1 below, 2 right, 3 above, 4 left."""

    def __init__(self, name, x, y, kind, before=None, bend=lambda x, y: y):
        self.name, self.kind, self.grid, self.brick = name, kind, (len(x) - 1, len(y) - 1), kind.startswith("C3D")
        first = before.last if before else (0, 0)
        both = [np.insert(line, range(1, len(line)), (line[1:] + line[:-1]) / 2) for line in (x, y)]
        self.number, self.nodes = {}, []
        for layer in (0, 1, 2) if self.brick else (0,):
            for j, Y in enumerate(both[1]):
                for i, X in enumerate(both[0]):
                    if i % 2 + j % 2 + layer % 2 <= 1:
                        self.number[i, j, layer] = first[0] + len(self.nodes) + 1
                        self.nodes.append((self.number[i, j, layer], X, bend(X, Y), layer / 2))
        self.cells = [(first[1] + e + 1, 2 * (e % self.grid[0]), 2 * (e // self.grid[0])) for e in range(self.grid[0] * self.grid[1])]
        self.last = first[0] + len(self.nodes), first[1] + len(self.cells)

    def text(self):
        square, middle = ((0, 0), (2, 0), (2, 2), (0, 2)), ((1, 0), (2, 1), (1, 2), (0, 1))
        if self.brick:
            places = [(*at, layer) for ring in (square, middle) for layer in (0, 2) for at in ring] + [(*at, 1) for at in square]
        else:
            places = [(*at, 0) for ring in (square, middle) for at in ring]
        lines = [f"*NODE, NSET=N{self.name}"] + [f"{n}, {x:.12g}, {y:.12g}, {z}" for n, x, y, z in self.nodes]
        lines.append(f"*ELEMENT, TYPE={self.kind}, ELSET=E{self.name}")
        for e, i, j in self.cells:
            words = [str(e)] + [str(self.number[i + k, j + m, layer]) for k, m, layer in places]
            lines += [", ".join(words[:15]) + ("," if self.brick else "")] + ([", ".join(words[15:])] if self.brick else [])
        return lines + [f"*NSET, NSET=ACROSS{self.name}", f"N{self.name}"]

    def side(self, face, condition=lambda j: True):
        last = 2 * self.grid[0] - 2, 2 * self.grid[1] - 2
        return [(e, face + 2 if self.brick else face) for e, i, j in self.cells
                if (j == 0, i == last[0], j == last[1], i == 0)[face - 1] and condition(j // 2)]

    def surface(self, name, face, condition=lambda j: True):
        return [f"*SURFACE, NAME={name}, TYPE=ELEMENT"] + [f"{e}, S{f}" for e, f in self.side(face, condition)]

    def pressed(self, face, pressure):
        return ["*DLOAD"] + [f"{e}, P{f}, {pressure}" for e, f in self.side(face)]

    def where(self, condition):
        return [node for node in self.nodes if condition(node[1], node[2])]

    def across(self):
        return ["*BOUNDARY", f"N{self.name}, 3, 3"] if self.brick else []


def material(name, E, nu, bodies):
    return [f"*MATERIAL, NAME={name}", "*ELASTIC", f"{E}, {nu}"] + [
        line for body in bodies for line in (f"*SOLID SECTION, ELSET=E{body.name}, MATERIAL={name}", "1.")]


def contact(method, stiffness, E, coefficient):
    # Springs of nodes pull where they are open; that is made as small as nothing, which the default is not.
    tension = f", {1e-6 * E}, 1e-6" if method == "nodes" else ""
    lines = ["*SURFACE INTERACTION, NAME=LAW", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{stiffness * E}{tension}"]
    if coefficient:  # the stick slope a tenth of that of the pressure
        lines += ["*FRICTION", f"{coefficient}, {stiffness * E / 10}"]
    return lines + [f"*CONTACT PAIR, INTERACTION=LAW, TYPE={TYPES[method]}", "SLAVE, MASTER"]


def held(nodes, *components):
    return [f"{node[0]}, {c}, {c}" for node in nodes for c in components]


def node_set(nodes):
    return ["*NSET, NSET=HELD", *[f"{node[0]}," for node in nodes]]


def step(loads):
    return ["*STEP, INC=1000", "*STATIC", "1., 1.", *loads, "*NODE PRINT, NSET=HELD, TOTALS=ONLY", "RF", "*NODE FILE", "U", "*CONTACT FILE",
            "CDIS, CSTR", "*END STEP"]


def on_plane(lines, method, stiffness, E, nu, coefficient, below, supports, loads, gap=0.):
    """A block on a plane: a layer of elements that is held and, under a gap, follows the parabola."""
    kind = "C3D20" if method == "mortar" else "CPE8"
    block = Body("BLOCK", *lines, kind)
    base = Body("BASE", lines[0], np.array([-below, 0.]), kind, block, lambda x, y: y - SCALE * gap * x * x)
    return [*block.text(), *base.text(), *block.surface("SLAVE", 1), *base.surface("MASTER", 3),
            *material("STEEL", E, nu, [block, base]), *node_set(supports(block)), *contact(method, stiffness, E, coefficient),
            "*BOUNDARY", "NBASE, 1, 2", *loads(block)[0], *block.across(), *base.across(), *step(loads(block)[1])]


def hertz(lines, method, stiffness):
    def supports(block):
        return block.where(lambda x, y: abs(x) == 2 or y == 2)

    def moved(block):
        nodes = supports(block)
        ux, uy = problems.hertz_displacement(*np.array(nodes).T[1:3])
        return [], ["*BOUNDARY"] + [f"{node[0]}, {c}, {c}, {SCALE * u[k]:.12g}" for k, node in enumerate(nodes) for c, u in ((1, ux), (2, uy))]

    return on_plane(lines, method, stiffness, 200., 0.3, 0, 0.2, supports, moved, problems.HERTZ["gap"])


def ssnv128(lines, method, stiffness):
    def supports(block):
        return block.where(lambda x, y: x == 40)

    return on_plane(lines, method, stiffness, 1.3e5, 0.2, 1., 5., supports,
                    lambda block: (held(supports(block), 1), [*block.pressed(4, SCALE * 150.), *block.pressed(3, SCALE * 50.)]))


def shrink_fit(lines, method, stiffness):
    shaft = Body("SHAFT", *lines[:2], "CAX8")
    n = int(np.searchsorted(lines[1], 30 - 1e-9))
    hub = Body("HUB", lines[2] - SCALE * 0.02, lines[1][:n + 1], "CAX8", shaft)
    return [*shaft.text(), *hub.text(), *shaft.surface("SLAVE", 2, lambda j: j < n), *hub.surface("MASTER", 4),
            *material("STEEL", 210000., 0.3, [shaft, hub]), *node_set(hub.where(lambda x, y: y == 30)),
            *contact(method, stiffness, 210000., 0.15), "*BOUNDARY", *held(shaft.where(lambda x, y: x == 0), 1), "HELD, 2, 2",
            *step(shaft.pressed(3, -20. * SCALE))]


def read_frd(file):
    """Coordinates of nodes, and the last CONTACT: opening, slip, pressure, shear by node."""
    places, contact_values, block = {}, {}, None
    for line in file.read_text().splitlines():
        if line.startswith("    2C"):
            block = "nodes"
        elif line.startswith(" -4"):
            block = line.split()[1]
            if block == "CONTACT":
                contact_values = {}
        elif line.startswith(" -3"):
            block = None
        elif line.startswith(" -1") and block in ("nodes", "CONTACT"):
            values = [float(line[k:k + 12]) for k in range(13, len(line.rstrip()), 12)]
            (places if block == "nodes" else contact_values)[int(line[3:13])] = values
    return places, contact_values


def results(home, case):
    """The reaction of the supports, and by place along the contact: opening, slip, pressure, shear."""
    total = re.findall(r"total force.*\n\s*\n\s*(\S+)\s+(\S+)", (home / "job.dat").read_text())[-1]
    places, values = read_frd(home / "job.frd")
    along, table = int(case == "shrink_fit"), {}
    for node, value in values.items():  # several nodes stand at a place, of either side and across the thickness
        if node not in places:
            continue
        place = round(places[node][along], 9)
        if abs(places[node][1 - along] - 20 * along) < 1e-6 and (place not in table or abs(value[3]) > abs(table[place][3])):
            table[place] = value
    return [float(value) / SCALE for value in total], np.array([(place, *value) for place, value in sorted(table.items())])


def changes(places, state):
    """Middle between nodes of different states."""
    at = np.nonzero(state[1:] != state[:-1])[0]
    return ((places[at] + places[at + 1]) / 2).tolist()


def answer(case, total, table):
    result = {"force": -total[1] if case == "hertz" else -6000 - total[0], "ends": []}
    if not len(table):  # of contact by nodes the results name nodes that the mesh has not
        return result
    place, pressure, shear = table[:, 0], table[:, 4], np.hypot(table[:, 5], table[:, 6])
    presses = pressure > 1e-6 * pressure.max()
    if case == "hertz":
        return {**result, "ends": changes(place, presses)}
    if case == "ssnv128":  # slip ends where friction falls below the coefficient times the pressure, 1
        return {**result, "ends": changes(place, presses)[:1] + changes(place, shear >= (1 - 1e-3) * pressure)[-1:]}
    # The force between shaft and hub is no reaction; Simpson's rule over pressures, 20 from the axis.
    p = pressure[place < 30 + 1e-6] / SCALE
    return {**result, "force": 40 * np.pi * float(np.dot(np.diff(place[:len(p):2]), (p[:-2:2] + 4 * p[1:-1:2] + p[2::2]) / 6))}


def main():
    case, kind, n, method, stiffness = sys.argv[1], sys.argv[2], int(sys.argv[3]), sys.argv[4], float(sys.argv[5])
    lines = problems.lines(case, kind, n)
    text = globals()[case](lines, method, stiffness)
    with tempfile.TemporaryDirectory() as scratch:
        home = pathlib.Path(sys.argv[6] if len(sys.argv) > 6 else scratch)
        home.mkdir(parents=True, exist_ok=True)
        print(json.dumps(solved(case, text, home)))


def solved(case, text, home):
    (home / "job.inp").write_text("\n".join(text) + "\n")
    begin = time.monotonic()
    with (home / "log").open("w") as log:
        if subprocess.run(["ccx", "-i", "job"], cwd=home, stdout=log, stderr=log, check=False).returncode:
            sys.exit(NO_SOLUTION)
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    times = {"wall": time.monotonic() - begin, "cpu": used.ru_utime + used.ru_stime}
    total, table = results(home, case)
    return {**times, **answer(case, total, table)}


main()
