// SPDX-License-Identifier: LGPL-2.1-or-later
// A bracket with a fillet: quadrilaterals of its profile, extruded. doc/space.py draws it with other sizes of cells.
SetFactory("OpenCASCADE");
Point(1) = {0, 0, 0}; Point(2) = {3, 0, 0}; Point(3) = {3, 0, 0.6}; Point(4) = {1.1, 0, 0.6}; Point(5) = {1.1, 0, 1.1};
Point(6) = {0.6, 0, 1.1}; Point(7) = {0.6, 0, 2}; Point(8) = {0, 0, 2};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Circle(4) = {4, 5, 6}; Line(5) = {6, 7}; Line(6) = {7, 8}; Line(7) = {8, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6, 7};
Plane Surface(1) = {1};
h = 0.2;
MeshSize{:} = h;
Recombine Surface{1};
Extrude {0, 1, 0} { Surface{1}; Layers{Round(1 / h)}; Recombine; }
e = 1e-3;
Physical Surface("bottom") = Surface In BoundingBox{-e, -e, -e, 3 + e, 1 + e, e};
Physical Surface("top") = Surface In BoundingBox{-e, -e, 2 - e, 3 + e, 1 + e, 2 + e};
Physical Volume("body") = Volume{:};
