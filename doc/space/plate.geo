// SPDX-License-Identifier: LGPL-2.1-or-later
// A quarter of a plate with a hole, of tetrahedra. doc/space.py draws it with other sizes of cells.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 2, 2, 0.5};
Cylinder(2) = {0, 0, -1, 0, 0, 2, 1};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
h = 0.4;
MeshSize{:} = h;
e = 1e-3;
Physical Surface("left") = Surface In BoundingBox{-e, -e, -e, e, 2 + e, 0.5 + e};
Physical Surface("front") = Surface In BoundingBox{-e, -e, -e, 2 + e, e, 0.5 + e};
Physical Surface("right") = Surface In BoundingBox{2 - e, -e, -e, 2 + e, 2 + e, 0.5 + e};
Physical Surface("bottom") = Surface In BoundingBox{-e, -e, -e, 2 + e, 2 + e, e};
Physical Surface("top") = Surface In BoundingBox{-e, -e, 0.5 - e, 2 + e, 2 + e, 0.5 + e};
Physical Volume("body") = Volume{:};
