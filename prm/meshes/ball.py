#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""ball.py > ball.msh: the mesh of prm/ball.prm, an eighth of a ball of radius 10, by hexahedra of 27 nodes in format 2.2."""
import math

radius, core, n = 10.0, 5.0, 2  # n cells along each edge of the core, and from it to the surface

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


for place in [inside] + [outside(axis) for axis in range(3)]:
    for number in range(n**3):
        first = (number % n, number // n % n, number // n // n)
        corners = [tuple((f + c) / n for f, c in zip(first, corner)) for corner in CORNERS]
        cell = corners + [middle(*(corners[v] for v in some)) for some in EDGES + FACES + [range(8)]]
        cells.append([tag(place(*x)) for x in cell])
        for some in FACES:
            face = [corners[v] for v in some]
            face += [middle(face[k], face[(k + 1) % 4]) for k in range(4)] + [middle(*face)]
            at = [place(*x) for x in face]
            for axis in range(3):
                if all(abs(x[axis]) < 1e-9 for x in at):
                    faces.append((axis + 1, [tag(x) for x in at]))
            if all(abs(math.hypot(*x) - radius) < 1e-9 for x in at):
                faces.append((4, [tag(x) for x in at]))

print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n5")
print('2 1 "x0"\n2 2 "y0"\n2 3 "z0"\n2 4 "surface"\n3 5 "rubber"\n$EndPhysicalNames\n$Nodes')
print(len(nodes))
for number, x in enumerate(nodes, 1):
    print(number, *(f"{value:.12g}" for value in x))
print("$EndNodes\n$Elements")
print(len(faces) + len(cells))
for number, (group, face) in enumerate(faces, 1):
    print(number, 10, 2, group, group, *face)
for number, cell in enumerate(cells, len(faces) + 1):
    print(number, 12, 2, 5, 1, *cell)
print("$EndElements")
