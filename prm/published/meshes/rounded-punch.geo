// SPDX-License-Identifier: LGPL-2.1-or-later
// The punch of NAFEMS' second contact benchmark, of revolution about x = 0: D 100, H 100, its lower edge rounded with radius 10.
// gmsh -2 -format msh41 rounded-punch.geo
Point(1) = {0, 0, 0};    Point(2) = {40, 0, 0};   Point(3) = {50, 10, 0};
Point(4) = {50, 100, 0}; Point(5) = {40, 100, 0}; Point(6) = {28, 100, 0}; Point(7) = {0, 100, 0};
Point(8) = {0, 12, 0};   Point(9) = {33, 12, 0};  Point(10) = {40, 18, 0}; Point(11) = {40, 10, 0};
Line(1) = {1, 2};  Circle(2) = {2, 11, 3}; Line(3) = {3, 4};
Line(4) = {4, 5};  Line(5) = {5, 6};       Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 1};
Line(9) = {8, 9};  Line(10) = {9, 10};     Line(11) = {2, 9}; Line(12) = {3, 10};
Line(13) = {10, 5}; Line(14) = {9, 6};
Curve Loop(1) = {1, 11, -9, 8};     Plane Surface(1) = {1};
Curve Loop(2) = {2, 12, -10, -11};  Plane Surface(2) = {2};
Curve Loop(3) = {3, 4, -13, -12};   Plane Surface(3) = {3};
Curve Loop(4) = {10, 13, 5, -14};   Plane Surface(4) = {4};
Curve Loop(5) = {9, 14, 6, 7};      Plane Surface(5) = {5};
Transfinite Curve {1, 9, 6} = 5;
Transfinite Curve {2, 10, 5} = 3;
Transfinite Curve {8, 11, 12, 4} = 2;
Transfinite Curve {3, 13, 14, 7} = 5;
Transfinite Surface {1, 2, 3, 4, 5};
Recombine Surface {1, 2, 3, 4, 5};
Physical Curve("flat") = {1};
Physical Curve("fillet") = {2};
Physical Curve("side") = {3};
Physical Curve("top") = {4, 5, 6};
Physical Curve("axis") = {7, 8};
Physical Surface("punch") = {1, 2, 3, 4, 5};
