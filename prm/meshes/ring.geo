// SPDX-License-Identifier: LGPL-2.1-or-later
// The ring of press-ring.prm, lengths in mm: between the radii 20 and 30 around (0, 0), in four quarters of 2 x 3 cells. Structured:
// a free mesh has cells with two edges on one circle, whose angle between them is 180 degrees.
// gmsh -2 -format msh41 ring.geo
a = 20; b = 30;
Point(1) = {0, 0, 0};
Point(2) = {a, 0, 0}; Point(3) = {0, a, 0}; Point(4) = {-a, 0, 0}; Point(5) = {0, -a, 0};
Point(6) = {b, 0, 0}; Point(7) = {0, b, 0}; Point(8) = {-b, 0, 0}; Point(9) = {0, -b, 0};
Circle(1) = {2, 1, 3}; Circle(2) = {3, 1, 4}; Circle(3) = {4, 1, 5}; Circle(4) = {5, 1, 2};
Circle(5) = {6, 1, 7}; Circle(6) = {7, 1, 8}; Circle(7) = {8, 1, 9}; Circle(8) = {9, 1, 6};
Line(9) = {2, 6}; Line(10) = {3, 7}; Line(11) = {4, 8}; Line(12) = {5, 9};
Curve Loop(1) = {9, 5, -10, -1}; Curve Loop(2) = {10, 6, -11, -2}; Curve Loop(3) = {11, 7, -12, -3}; Curve Loop(4) = {12, 8, -9, -4};
Plane Surface(1) = {1}; Plane Surface(2) = {2}; Plane Surface(3) = {3}; Plane Surface(4) = {4};
Transfinite Curve {1:8} = 4; Transfinite Curve {9:12} = 3; Transfinite Surface {1:4}; Recombine Surface {1:4};
Physical Curve("inner") = {1:4}; Physical Curve("outer") = {5:8};
Physical Surface("ring") = {1:4};
