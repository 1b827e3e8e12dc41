#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""foot.py > foot.msh: the mesh of prm/foot.prm, hexahedra in format 2.2: a block that tapers from 4 x 4 below to 2.8 x 2.8 above, 2 high."""
n = (4, 2, 4)


def node(i, j, k):
    return 1 + i + (n[0] + 1) * (j + (n[1] + 1) * k)


nodes, faces, cells = [], [], []
for k in range(n[2] + 1):
    for j in range(n[1] + 1):
        for i in range(n[0] + 1):
            width = 4 * (1 - 0.3 * j / n[1])
            nodes.append((width * (i / n[0] - 0.5), 2 * j / n[1], width * (k / n[2] - 0.5)))
for k in range(n[2]):
    for j in range(n[1]):
        for i in range(n[0]):
            c = [node(i + a, j + b, k + d) for d in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
            cells.append(c)
            if j == 0:
                faces.append((1, [c[0], c[1], c[5], c[4]]))
            if j == n[1] - 1:
                faces.append((2, [c[3], c[2], c[6], c[7]]))
            if i == 0:
                faces.append((3, [c[0], c[3], c[7], c[4]]))
print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4")
print('2 1 "bottom"\n2 2 "top"\n2 3 "flank"\n3 4 "rubber"\n$EndPhysicalNames\n$Nodes')
print(len(nodes))
for tag, x in enumerate(nodes, 1):
    print(tag, *(f"{value:.12g}" for value in x))
print("$EndNodes\n$Elements")
print(len(faces) + len(cells))
for tag, (group, corners) in enumerate(faces, 1):
    print(tag, 3, 2, group, group, *corners)
for tag, corners in enumerate(cells, len(faces) + 1):
    print(tag, 5, 2, 4, 1, *corners)
print("$EndElements")
