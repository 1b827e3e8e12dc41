// SPDX-License-Identifier: LGPL-2.1-or-later
// Section of a rubber seal, lengths in mm: a foot 6 x 3 with a half-round crown of radius 3 on it. The fluid is on the left, up to
// where the crown falls by 45 degrees; the lid presses on the crown between 45 and 135 degrees.
// gmsh -2 -format msh41 seal.geo
size = 1; r = 3; h = 3; s = r*Sqrt(2)/2;
Point(1) = {-r, 0, 0, size}; Point(2) = {r, 0, 0, size}; Point(3) = {r, h, 0, size}; Point(4) = {s, h + s, 0, size};
Point(5) = {0, h + r, 0, size/2}; Point(6) = {-s, h + s, 0, size}; Point(7) = {-r, h, 0, size}; Point(8) = {0, h, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Circle(3) = {3, 8, 4}; Circle(4) = {4, 8, 5}; Circle(5) = {5, 8, 6}; Circle(6) = {6, 8, 7};
Line(7) = {7, 1};
Curve Loop(1) = {1:7}; Plane Surface(1) = {1};
Mesh.Algorithm = 6; Mesh.RecombinationAlgorithm = 3; Mesh.RecombineAll = 1;
Physical Curve("floor") = {1}; Physical Curve("wall") = {2}; Physical Curve("shoulder") = {3}; Physical Curve("crown") = {4, 5};
Physical Curve("wet crown") = {6}; Physical Curve("wet side") = {7};
Physical Surface("rubber") = {1};
