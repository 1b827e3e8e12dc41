#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""ball.py > ball.msh: the mesh of prm/ball.prm, an eighth of a ball of radius 10, by hexahedra of 27 nodes in format 2.2.
ball.py plane > quarter.msh: the same as a body of revolution, whose boundaries are axis, z0 and surface."""
import itertools
import math
import sys

radius, core = 10.0, 5.0
# Of 45 degrees: arcs near the poles are short, for parabolas that follow a circle meet at an angle, which contact feels as a tip.
grid = (0, 1 / 6, 1 / 2, 1)

CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
EDGES = [(0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 7), (5, 6), (6, 7)]
FACES = [(0, 3, 2, 1), (0, 1, 5, 4), (0, 4, 7, 3), (1, 2, 6, 5), (2, 3, 7, 6), (4, 5, 6, 7)]


def middle(*points):
    return tuple(sum(x) / len(points) for x in zip(*points))


def inside(s, t, w):
    return tuple(core * x for x in (s, t, w))


def outside(axis):
    """From the face of the core across `axis` to the surface, w from 0 to 1; s and t along the two other axes, in cyclic order."""

    def place(s, t, w):
        a, b = math.tan(math.pi / 4 * s), math.tan(math.pi / 4 * t)
        far = radius / math.sqrt(1 + a * a + b * b)
        along = [(1 - w) * core * s + w * far * a, (1 - w) * core * t + w * far * b, (1 - w) * core + w * far]
        result = [0.0] * 3
        for k in range(3):
            result[(axis + 1 + k) % 3] = along[k]
        return tuple(result)

    return place


tags, nodes, faces, cells = {}, [], [], []


def tag(x):
    key = tuple(round(value, 9) + 0.0 for value in x)
    if key not in tags:
        nodes.append(key)
        tags[key] = len(nodes)
    return tags[key]


def meridian(s, w):
    x = outside(2)(s, 0, w)
    return (x[0], x[2])


def cells_of_ball():
    for place, upwards in [(inside, grid)] + [(outside(axis), (0, 0.5, 1)) for axis in range(3)]:
        lines = (grid, grid, upwards)
        for first in itertools.product(*(range(len(line) - 1) for line in lines)):
            corners = [tuple(line[f + c] for line, f, c in zip(lines, first, corner)) for corner in CORNERS]
            cell = corners + [middle(*(corners[v] for v in some)) for some in EDGES + FACES + [range(8)]]
            cells.append([tag(place(*x)) for x in cell])
            for some in FACES:
                face = [corners[v] for v in some]
                yield [place(*x) for x in face + [middle(face[k], face[k - 3]) for k in range(4)] + [middle(*face)]]


def cells_of_quarter():
    for place, upwards in ((lambda s, t: (core * s, core * t), grid), (meridian, (0, 0.5, 1)),
                           (lambda s, w: meridian(s, w)[::-1], (0, 0.5, 1))):
        for i, j in itertools.product(range(len(grid) - 1), range(len(upwards) - 1)):
            corners = [(grid[i + a], upwards[j + b]) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
            cell = corners + [middle(corners[k], corners[k - 3]) for k in range(4)] + [middle(*corners)]
            cells.append([tag(place(*x)) for x in cell])
            for k in range(4):
                yield [place(*x) for x in (corners[k], corners[k - 3], cell[4 + k])]


is_plane = sys.argv[1:] == ["plane"]
names = ("axis", "z0", "surface", "rubber") if is_plane else ("x0", "y0", "z0", "surface", "rubber")
for at in cells_of_quarter() if is_plane else cells_of_ball():
    for axis in range(len(at[0])):
        if all(abs(x[axis]) < 1e-9 for x in at):
            faces.append((axis + 1, [tag(x) for x in at]))
    if all(abs(math.hypot(*x) - radius) < 1e-9 for x in at):
        faces.append((len(names) - 1, [tag(x) for x in at]))

dim = 2 if is_plane else 3
print(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{len(names)}")
for number, name in enumerate(names, 1):
    print(dim - (number < len(names)), number, f'"{name}"')
print(f"$EndPhysicalNames\n$Nodes\n{len(nodes)}")
for number, x in enumerate(nodes, 1):
    print(number, *(f"{value:.12g}" for value in x + (0.0,) * (3 - dim)))
print("$EndNodes\n$Elements")
print(len(faces) + len(cells))
for number, (group, face) in enumerate(faces, 1):
    print(number, 8 if is_plane else 10, 2, group, group, *face)
for number, cell in enumerate(cells, len(faces) + 1):
    print(number, 10 if is_plane else 12, 2, len(names), 1, *cell)
print("$EndElements")
