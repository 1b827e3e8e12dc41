// SPDX-License-Identifier: LGPL-2.1-or-later
// Half of a sphere of radius 50 that hangs below its flat side y = 50, of revolution about x = 0. gmsh -2 -format msh41 quarter-sphere.geo
Point(1) = {0, 0, 0}; Point(2) = {35.35533905932738, 14.64466094067262, 0}; Point(3) = {50, 50, 0}; Point(4) = {0, 50, 0};
Point(5) = {0, 25, 0}; Point(6) = {22, 28, 0}; Point(7) = {25, 50, 0};
Circle(1) = {1, 4, 2}; Circle(2) = {2, 4, 3}; Line(3) = {3, 7}; Line(4) = {7, 4}; Line(5) = {4, 5}; Line(6) = {5, 1};
Line(7) = {5, 6}; Line(8) = {6, 7}; Line(9) = {2, 6};
Curve Loop(1) = {1, 9, -7, 6};  Plane Surface(1) = {1};
Curve Loop(2) = {2, 3, -8, -9}; Plane Surface(2) = {2};
Curve Loop(3) = {7, 8, 4, 5};   Plane Surface(3) = {3};
Transfinite Curve {1, 7, 4} = 5;
Transfinite Curve {2, 8, 5} = 3;
Transfinite Curve {6, 9, 3} = 3;
Transfinite Surface {1, 2, 3};
Recombine Surface {1, 2, 3};
Physical Curve("arc") = {1, 2};
Physical Curve("flat") = {3, 4};
Physical Curve("axis") = {5, 6};
Physical Surface("sphere") = {1, 2, 3};
