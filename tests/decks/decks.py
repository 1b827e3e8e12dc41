#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Twelve decks as preprocessors write them, for hpvi --import and for CalculiX: decks.py DIRECTORY [FINENESS [PENALTY]] writes
all of them. Each asks CalculiX for the number by which it is compared, in QUANTITIES: the force of a support or the mean displacement of an edge.
PENALTY is the stiffness of contact over Young's modulus, per length of one."""
import math
import pathlib
import sys

CORNERS = ((0, 0), (2, 0), (2, 2), (0, 2))
MIDDLES = ((1, 0), (2, 1), (1, 2), (0, 1))


class Grid:
    """Cells of a grid, nx by ny, whose points are at place(s, t) of the unit square: quadrilaterals of 4 or 8 nodes, or triangles of 3 or 6.
    Sides are 1 below, 2 right, 3 above, 4 left."""

    def __init__(self, kind, nx, ny, place, before=None):
        self.kind, self.nx, self.ny = kind, nx, ny
        self.corners, self.quadratic = (3 if kind[-1] in "36" else 4), kind[-1] in "68"
        node, self.first = (before.last_node, before.last_element) if before else (0, 0), None
        number, self.nodes, self.number = node[0], [], {}
        for j in range(2 * ny + 1):
            for i in range(2 * nx + 1):
                if not self.quadratic and (i % 2 or j % 2) or self.quadratic and self.corners == 4 and i % 2 and j % 2:
                    continue
                number += 1
                self.number[i, j] = number
                self.nodes.append((number, *place(i / (2 * nx), j / (2 * ny))))
        self.elements, self.cells, element = [], {}, node[1]
        for j in range(0, 2 * ny, 2):
            for i in range(0, 2 * nx, 2):
                rings = [[(0, 1, 2, 3), None]] if self.corners == 4 else [[(0, 1, 2), None], [(0, 2, 3), None]]
                for ring, _ in rings:
                    element += 1
                    at = [CORNERS[k] for k in ring]
                    if self.quadratic:
                        at += [((a[0] + b[0]) // 2, (a[1] + b[1]) // 2) for a, b in zip(at, at[1:] + at[:1])]
                    self.elements.append((element, [self.number[i + a, j + b] for a, b in at]))
                    for k, (a, b) in enumerate(zip(at[:self.corners], at[1:self.corners] + at[:1])):
                        self.cells[(i + a[0], j + a[1]), (i + b[0], j + b[1])] = element, k + 1
        self.last_node, self.last_element = number, element

    def side(self, which):
        """Nodes from one end to the other."""
        last = 2 * self.nx, 2 * self.ny
        at = {1: [(i, 0) for i in range(last[0] + 1)], 2: [(last[0], j) for j in range(last[1] + 1)],
              3: [(i, last[1]) for i in range(last[0] + 1)], 4: [(0, j) for j in range(last[1] + 1)]}[which]
        return [self.number[place] for place in at if place in self.number]

    def faces(self, which):
        """Element and number of each edge."""
        nodes = set(self.side(which))
        return [face for (a, b), face in self.cells.items() if self.number[a] in nodes and self.number[b] in nodes]

    def node_lines(self, options=""):
        return [f"*NODE{options}"] + [f"{n:7d}, {x:.12g}, {y:.12g}, 0." for n, x, y in self.nodes]

    def element_lines(self, options):
        return [f"*ELEMENT, TYPE={self.kind}{options}"] + [", ".join(map(str, [e, *nodes])) for e, nodes in self.elements]

    def mesh(self, name):
        return self.node_lines(f", NSET=N{name}") + self.element_lines(f", ELSET=E{name}")


def box(x0, y0, x1, y1):
    return lambda s, t: (x0 + (x1 - x0) * s, y0 + (y1 - y0) * t)


def nset(name, nodes, wide=8):
    """Rows of several numbers, as most preprocessors write them."""
    return [f"*NSET, NSET={name}"] + [", ".join(map(str, nodes[k:k + wide])) + "," for k in range(0, len(nodes), wide)]


def surface(name, faces):
    """By sets of elements of one number of an edge, as Abaqus/CAE and PrePoMax do."""
    lines = []
    for k in sorted({k for _, k in faces}):
        elements = [e for e, face in faces if face == k]
        lines += [f"*ELSET, ELSET=_{name}_S{k}"] + [", ".join(map(str, elements[i:i + 16])) for i in range(0, len(elements), 16)]
    return lines + [f"*SURFACE, NAME={name}, TYPE=ELEMENT"] + [f"_{name}_S{k}, S{k}" for k in sorted({k for _, k in faces})]


def material(name, E, nu, *more):
    return [f"*MATERIAL, NAME={name}", "*ELASTIC", f"{E}, {nu}", *more]


def section(elements, name, thickness="1."):
    return [f"*SOLID SECTION, ELSET={elements}, MATERIAL={name}", thickness]


def contact(stiffness, slave, master, friction=0, how="SURFACE TO SURFACE", more=""):
    lines = ["*SURFACE INTERACTION, NAME=SI", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{stiffness:.9g}"]
    if friction:
        lines += ["*FRICTION", f"{friction}, {stiffness / 10:.9g}"]
    return lines + [f"*CONTACT PAIR, INTERACTION=SI, TYPE={how}{more}", f"{slave}, {master}"]


def step(*loads, static="1., 1.", head="*STEP, INC=1000", prints=()):
    return [head, "*STATIC", static, *loads, *prints, "*NODE FILE", "U", "*EL FILE", "S", "*END STEP"]


def displacements(name):
    return [f"*NODE PRINT, NSET={name}", "U"]


def force(name):
    return [f"*NODE PRINT, NSET={name}, TOTALS=ONLY", "RF"]


# ------------------------------------------------------------ the decks: each gives files by name, the deck itself first

def plate_with_hole(n, _):
    """CalculiX GraphiX: a file for mesh, sets, and loads each."""
    def place(s, t):
        angle = (1 - s) * math.pi / 2
        c, d = math.cos(angle), math.sin(angle)
        far = 5 / max(c, d)
        r = 1 + (far - 1) * t * (0.5 + 0.5 * t)
        return r * c, r * d
    grid = Grid("CPS8", 4 * n, 4 * n, place)
    up = grid.faces(3)[:2 * n]
    main = ["** plate with a hole, a quarter", "*INCLUDE, INPUT=plate.msh", "*INCLUDE, INPUT=plate.nam", "*MATERIAL, NAME=STEEL",
            "*ELASTIC", "210000., 0.3, 0", "*SOLID SECTION, ELSET=Eall, MATERIAL=STEEL", "0.5", "*STEP", "*STATIC", "*BOUNDARY", "Nbottom, 2, 2",
            "Nleft, 1, 1", "*DLOAD", "*INCLUDE, INPUT=top.dlo", "*NODE PRINT, NSET=Nend", "U", "*NODE FILE", "U", "*EL FILE", "S", "*END STEP"]
    mesh = grid.node_lines(", NSET=Nall") + grid.element_lines(", ELSET=Eall")
    end = [node for node, x, y in grid.nodes if abs(y - 5) < 1e-9]
    end.sort(key=lambda node: grid.nodes[node - 1][1])
    sets = nset("Nbottom", grid.side(2), 1) + nset("Nleft", grid.side(4), 1) + nset("Nend", end, 1)
    return {"deck.inp": main, "plate.msh": mesh, "plate.nam": sets, "top.dlo": [f"{e}, P{k}, -100." for e, k in up]}


def cantilever(n, _):
    """FreeCAD: sets by element sets, forces of nodes."""
    grid = Grid("CPS8", 10 * n, 3 * n, box(0, 0, 10, 2))
    right = grid.side(2)
    weights = [(1 if k in (0, len(right) - 1) else 4 if k % 2 else 2) / (3 * (len(right) - 1)) for k in range(len(right))]
    return {"deck.inp": ["** written by FreeCAD inp file writer for CalculiX,Abaqus meshes", *grid.node_lines(", NSET=Nall"),
                         *grid.element_lines(", ELSET=Eall"), "*ELSET,ELSET=SolidMaterialElementSolidSection", "Eall",
                         *nset("ConstraintFixed", grid.side(4), 1), *nset("ConstraintForce", right, 1),
                         "*MATERIAL, NAME=SolidMaterial", "*ELASTIC", "210000,0.300", "*DENSITY", "7.9E-09",
                         "*SOLID SECTION, ELSET=SolidMaterialElementSolidSection, MATERIAL=SolidMaterial", "1.0",
                         "*STEP", "*STATIC", "*BOUNDARY", "ConstraintFixed,1", "ConstraintFixed,2", "", "*CLOAD", "** node loads on edge",
                         *[f"{node},2,{-1000 * w:.9E}" for node, w in zip(right, weights)], "", "*NODE FILE", "U", "*EL FILE", "S, E",
                         "*NODE PRINT , NSET=ConstraintForce", "U", "*OUTPUT, FREQUENCY=1", "*END STEP"]}


def punch(n, penalty):
    """PrePoMax: comments around each part, surfaces by sets, contact of surfaces."""
    block = Grid("CPE8", 12 * n, 6 * n, box(-6, -6, 6, 0))
    tool = Grid("CPE8", 4 * n, 3 * n, lambda s, t: (-2 + 4 * s, 3 * t + 0.02 * (2 * s - 1) ** 2 * (1 - t)), block)
    return {"deck.inp": ["** Heading +++++++++++++++++", "**", "*HEADING", "Hash: 1, Date: 01/01/2024, Unit system: MM_TON_S_C", "**",
                         "** Nodes", "**", *block.node_lines(), *tool.node_lines(), "**", "** Elements", "**",
                         *block.element_lines(", ELSET=Block"), *tool.element_lines(", ELSET=Tool"), "**", "** Node sets", "**",
                         *nset("Fixed", block.side(1)), *nset("Moved", tool.side(3)), "**", "** Surfaces", "**",
                         *surface("Block_top", block.faces(3)), *surface("Tool_bottom", tool.faces(1)),
                         *material("S235", 210000, 0.28, "*DENSITY", "7.8E-09"), *section("Block", "S235", ""), *section("Tool", "S235", ""),
                         *contact(penalty * 210000, "Tool_bottom", "Block_top"), "**", "** Steps", "**",
                         *step("*BOUNDARY, OP=NEW", "Fixed, 1, 2, 0", "Moved, 1, 1, 0", "Moved, 2, 2, -0.03", prints=force("Moved"),
                               head="*STEP, NLGEOM=NO, INC=100", static="0.2, 1")]}


def roller(n, penalty):
    """A roller of the symmetrical half, pressed on a block with friction; names in small letters."""
    block = Grid("CPE8", 10 * n, 8 * n, lambda s, t: (6 * s * (0.3 + 0.7 * s), -6 * (1 - t) * (1.3 - 0.3 * (1 - t)) / 1 + 1.8 * (1 - t) * t))
    def place(s, t):
        r = 2 + 2 * t
        return r * math.cos(s * math.pi / 2) if s < 1 else 0., 4 - r * math.sin(s * math.pi / 2)
    wheel = Grid("CPE8", 12 * n, 4 * n, place, block)
    return {"deck.inp": ["*heading", "roller on a block, half", *[line.lower() for line in block.mesh("block") + wheel.mesh("wheel")],
                         *nset("fixed", block.side(1)), *nset("symmetry", sorted({*block.side(4), *wheel.side(2)})), *nset("bearing", wheel.side(4)),
                         *surface("ground", block.faces(3)), *surface("tread", wheel.faces(3)),
                         *material("rubber", 20, 0.4), *material("soil", 50, 0.3), *section("Ewheel", "rubber"), *section("Eblock", "soil"),
                         *contact(penalty * 50, "tread", "ground", 0.3), "*boundary", "fixed, 1, 2", "symmetry, 1, 1",
                         *step("*boundary", "bearing, 2, 2, -0.1", prints=force("fixed"), static="0.1, 1.")]}


def press_fit(n, penalty):
    """A hub of revolution on a shaft that it overlaps, pulled out."""
    shaft = Grid("CAX8", 4 * n, 12 * n, box(0, 0, 20, 60))
    hub = Grid("CAX8", 4 * n, 6 * n, box(19.98, 0, 40, 30), shaft)
    return {"deck.inp": ["*HEADING", "press fit", *shaft.mesh("SHAFT"), *hub.mesh("HUB"), *nset("AXIS", shaft.side(4)), *nset("HELD", hub.side(3)), *nset("PULLED", shaft.side(3)),
                         *surface("SEAT", shaft.faces(2)), *surface("BORE", hub.faces(4)),
                         *material("STEEL", 210000., 0.3), *section("ESHAFT", "STEEL"), *section("EHUB", "STEEL"),
                         *contact(penalty * 210000, "BORE", "SEAT", 0.15), "*BOUNDARY", "AXIS, 1, 1", "HELD, 2, 2",
                         *step("*DLOAD", *[f"{e}, P{k}, -20." for e, k in shaft.faces(3)], prints=displacements("PULLED"), static="0.05, 1.")]}


def flange(n, _):
    """Triangles of revolution, tied to a ring of another mesh."""
    plate = Grid("CAX6", 6 * n, 3 * n, box(10, 0, 40, 6))
    ring = Grid("CAX6", 2 * n, 4 * n, box(10, 6, 20, 30), plate)
    return {"deck.inp": ["*HEADING", "flange", *plate.mesh("PLATE"), *ring.mesh("RING"), *nset("CLAMPED", plate.side(2)), *nset("END", ring.side(3)),
                         *surface("PTOP", plate.faces(3)), *surface("RFOOT", ring.faces(1)), *surface("PIPE", ring.faces(4)),
                         *material("STEEL", 210000., 0.3), *section("EPLATE", "STEEL", ""), *section("ERING", "STEEL", ""),
                         "*TIE, NAME=WELD, POSITION TOLERANCE=0.1", "RFOOT, PTOP", "*BOUNDARY", "CLAMPED, 1, 2",
                         *step("*DSLOAD", "PIPE, P, 40.", prints=displacements("END"))]}


def bimetal(n, _):
    """Two materials in one body, heated; thin, for CalculiX makes bricks of plane elements, whose thicknesses differ."""
    grid = Grid("CPS8", 10 * n, 4 * n, box(0, 0, 10, 1))
    half = len(grid.elements) // 2
    return {"deck.inp": ["*HEADING", "bimetal", *grid.node_lines(", NSET=NALL"), *grid.element_lines(", ELSET=EALL"),
                         "*ELSET, ELSET=BRASS, GENERATE", f"1, {half}, 1", "*ELSET, ELSET=INVAR, GENERATE", f"{half + 1}, {2 * half}",
                         *nset("CLAMP", grid.side(4)), *nset("TIP", grid.side(2)),
                         *material("BRASS", 105000., 0.34, "*EXPANSION, ZERO=20.", "1.9e-5"),
                         *material("INVAR", 141000., 0.29, "*EXPANSION, ZERO=20.", "1.2e-6"),
                         *section("BRASS", "BRASS", "0.02"), *section("INVAR", "INVAR", "0.02"), "*INITIAL CONDITIONS, TYPE=TEMPERATURE", "NALL, 20.",
                         "*BOUNDARY", "CLAMP, 1, 2", *step("*TEMPERATURE", "NALL, 120.", prints=displacements("TIP"))]}


def rubbing(n, penalty):
    """Three steps: pressed, pushed, and pushed back, the load by an amplitude."""
    base = Grid("CPE8", 10 * n, 3 * n, box(-5, -3, 5, 0))
    pad = Grid("CPE8", 6 * n, 2 * n, box(-3, 0, 3, 2), base)
    top = nset("TOP", pad.side(3))
    return {"deck.inp": ["*HEADING", "rubbing", *base.mesh("BASE"), *pad.mesh("PAD"), *nset("FOOT", base.side(1)), *top,
                         *surface("TRACK", base.faces(3)), *surface("SOLE", pad.faces(1)),
                         *material("LINING", 1000., 0.25), *section("EBASE", "LINING"), *section("EPAD", "LINING"),
                         *contact(penalty * 1000, "SOLE", "TRACK", 0.3), "*AMPLITUDE, NAME=SOFT", "0., 0., 0.5, 0.8, 1., 1.",
                         "*BOUNDARY", "FOOT, 1, 2", *step("*BOUNDARY", "TOP, 1, 1", "TOP, 2, 2, -0.01", prints=force("FOOT"), static="0.25, 1."),
                         *step("*BOUNDARY, AMPLITUDE=SOFT", "TOP, 1, 1, 0.004", prints=force("FOOT"), static="0.1, 1."),
                         *step("*BOUNDARY", "TOP, 1, 1, 0.002", prints=force("FOOT"), static="0.1, 1.")]}


def dam(n, _):
    """Triangles under weight and water, whose pressure has a number for each element."""
    grid = Grid("CPE6", 8 * n, 10 * n, lambda s, t: ((1 - s) * 0 + s * (8 - 6 * t), 10 * t))
    ys = {node: y for node, _, y in grid.nodes}
    faces = grid.faces(4)
    corner = {e: nodes for e, nodes in grid.elements}
    def depth(e, k):
        ring = corner[e][:3]
        return 10 - (ys[ring[k - 1]] + ys[ring[k % 3]]) / 2
    return {"deck.inp": ["*HEADING", "dam", *grid.mesh("DAM"), *nset("ROCK", grid.side(1)), *nset("CREST", grid.side(3)),
                         *material("CONCRETE", 25000., 0.2, "*DENSITY", "0.0024"), *section("EDAM", "CONCRETE"), "*BOUNDARY", "ROCK, 1, 2",
                         *step("*DLOAD", "EDAM, GRAV, 9.81, 0., -1., 0.", *[f"{e}, P{k}, {0.00981 * depth(e, k):.9g}" for e, k in faces],
                               prints=displacements("CREST"))]}


def disc(n, _):
    """A disc of revolution that turns."""
    grid = Grid("CAX8", 8 * n, 3 * n, lambda s, t: (20 + 80 * s, (t - 0.5) * (20 - 12 * s)))
    ring = [n_ for n_, x, y in grid.nodes if abs(y) < 1e-9]
    middle = grid.side(2)
    return {"deck.inp": ["*HEADING", "disc", *grid.mesh("DISC"), *nset("BORE", grid.side(4)), *nset("RIM", middle), *nset("MIDDLE", ring),
                         *material("STEEL", 210000., 0.3, "*DENSITY", "7.8e-9"), *section("EDISC", "STEEL"), "*BOUNDARY", "BORE, 2, 2",
                         *step("*DLOAD", "EDISC, CENTRIF, 1.e6, 0., 0., 0., 0., 1., 0.", prints=displacements("RIM"))]}


def veneer(n, _):
    """An orthotropic plate whose fibres are turned by 30 degrees."""
    grid = Grid("CPS8", 8 * n, 4 * n, box(0, 0, 200, 100))
    return {"deck.inp": ["*HEADING", "veneer", *grid.mesh("PLY"), *nset("GRIP", grid.side(4)), *nset("PULLED", grid.side(2)),
                         "*ORIENTATION, NAME=FIBRE, SYSTEM=RECTANGULAR", f"{math.cos(math.pi / 6):.15g}, {math.sin(math.pi / 6):.15g}, 0., "
                         f"{-math.sin(math.pi / 6):.15g}, {math.cos(math.pi / 6):.15g}, 0.", "*MATERIAL, NAME=SPRUCE",
                         "*ELASTIC, TYPE=ENGINEERING CONSTANTS", "11000., 500., 700., 0.4, 0.35, 0.4, 700., 700.,", "50.",
                         "*SOLID SECTION, ELSET=EPLY, MATERIAL=SPRUCE, ORIENTATION=FIBRE", "4.", "*BOUNDARY", "GRIP, 1, 2", "PULLED, 2, 2",
                         *step("*BOUNDARY", "PULLED, 1, 1, 0.5", prints=force("PULLED"))]}


def mould(n, penalty):
    """A tool whose nodes are all held presses a block of quadrilaterals of first order; contact of nodes, as old decks have it."""
    block = Grid("CPE4", 16 * n, 8 * n, box(0, 0, 8, 4))
    tool = Grid("CPE4", 8 * n, 2 * n, lambda s, t: (2 + 4 * s, 4 + 1 * t + 0.2 * (1 - t) * (2 * s - 1) ** 2), block)
    tension = f", {1e-6 * 1000}, 1e-6"
    lines = contact(penalty * 1000, "SKIN", "FORM", how="NODE TO SURFACE")
    lines[2] += tension
    return {"deck.inp": ["*HEADING", "mould", *block.mesh("BLOCK"), *tool.mesh("TOOL"), *nset("BED", block.side(1)),
                         *surface("SKIN", block.faces(3)), *surface("FORM", tool.faces(1)), *material("PLASTIC", 1000., 0.35), *material("TOOL", 1000., 0.3),
                         *section("EBLOCK", "PLASTIC"), *section("ETOOL", "TOOL"), *lines,
                         *step("*BOUNDARY", "BED, 1, 2", "NTOOL, 1, 1", "NTOOL, 2, 2, -0.1", prints=force("BED"), static="0.1, 1.")]}


# Deck: what is compared, its component, the set of the deck, and the side of the scene. A force of CAX is that of two degrees in CalculiX.
QUANTITIES = {
    plate_with_hole: ("mean displacement", 1, "Nend"), cantilever: ("mean displacement", 1, "ConstraintForce"), punch: ("force", 1, "Moved"),
    roller: ("force", 1, "fixed"), press_fit: ("mean displacement", 1, "PULLED"), flange: ("mean displacement", 1, "END"),
    bimetal: ("mean displacement", 1, "TIP"), rubbing: ("force", 0, "FOOT"), dam: ("mean displacement", 0, "CREST"),
    disc: ("mean displacement", 0, "RIM"), veneer: ("force", 0, "PULLED"), mould: ("force", 1, "BED")}
DECKS = list(QUANTITIES)


def write(deck, directory, fineness=1, penalty=50.):
    """Path of the deck."""
    directory = pathlib.Path(directory)
    directory.mkdir(parents=True, exist_ok=True)
    for name, lines in deck(fineness, penalty).items():
        (directory / name).write_text("\n".join(lines) + "\n")
    return directory / "deck.inp"


def main():
    for deck in DECKS:
        print(write(deck, pathlib.Path(sys.argv[1]) / deck.__name__, *[float(word) if "." in word else int(word) for word in sys.argv[2:]]))


if __name__ == "__main__":
    main()
