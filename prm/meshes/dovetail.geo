// SPDX-License-Identifier: LGPL-2.1-or-later
// The root of a turbine blade, lengths in mm, right half, x = 0 is the plane of symmetry: a neck 10 mm wide that widens below to
// 24 mm along a flank at 45 degrees. Both ends of the flank are rounded, tangent to their neighbours.
// gmsh -2 -format msh41 dovetail.geo
size = 2.5; r = 3; s = Sqrt(2)/2;
q = r*Tan(Pi/8); // what a rounding of radius r takes of the two lines that it joins
Point(1) = {0, 0, 0, size}; Point(2) = {12, 0, 0, size}; Point(3) = {12, 4 - q, 0, size/2}; Point(4) = {12 - q*s, 4 + q*s, 0, size/2};
Point(5) = {5 + q*s, 11 - q*s, 0, size/2}; Point(6) = {5, 11 + q, 0, size/2}; Point(7) = {5, 22, 0, size}; Point(8) = {0, 22, 0, size};
Point(9) = {12 - r, 4 - q, 0}; Point(10) = {5 + r, 11 + q, 0}; // centres of the roundings
Line(1) = {1, 2}; Line(2) = {2, 3}; Circle(3) = {3, 9, 4}; Line(4) = {4, 5}; Circle(5) = {5, 10, 6}; Line(6) = {6, 7}; Line(7) = {7, 8};
Line(8) = {8, 1};
Curve Loop(1) = {1:8}; Plane Surface(1) = {1};
Mesh.Algorithm = 6; Mesh.RecombinationAlgorithm = 3; Mesh.RecombineAll = 1;
// What no group names is free.
Physical Curve("flank") = {4}; Physical Curve("roundings") = {3, 5}; Physical Curve("blade") = {7}; Physical Curve("middle") = {8};
Physical Surface("root") = {1};
