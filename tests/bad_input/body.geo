// SPDX-License-Identifier: LGPL-2.1-or-later
// Two rings of a quarter, 1 < r < 1.5 < 2, three cells around: gmsh -2 -format msh22 body.geo -o body.msh
Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0}; Point(3) = {1.5, 0, 0}; Point(4) = {2, 0, 0};
Point(5) = {0, 1, 0}; Point(6) = {0, 1.5, 0}; Point(7) = {0, 2, 0};
Circle(1) = {2, 1, 5}; Circle(2) = {3, 1, 6}; Circle(3) = {4, 1, 7};
Line(4) = {2, 3}; Line(5) = {3, 4}; Line(6) = {5, 6}; Line(7) = {6, 7};
Curve Loop(1) = {4, 2, -6, -1}; Plane Surface(1) = {1};
Curve Loop(2) = {5, 3, -7, -2}; Plane Surface(2) = {2};
Transfinite Curve {1, 2, 3} = 4; Transfinite Curve {4, 5, 6, 7} = 2;
Transfinite Surface {1, 2}; Recombine Surface {1, 2};
Physical Curve("inside") = {1}; Physical Curve("joint") = {2}; Physical Curve("outside") = {3};
Physical Curve("start") = {4, 5}; Physical Curve("end") = {6};
Physical Surface("bush") = {1}; Physical Surface("rim") = {2};
