// SPDX-License-Identifier: LGPL-2.1-or-later
// The fourth contact benchmark of NAFEMS, the half above y = 0: a pin of radius 50 in a sheet, whose end is round with radius 100 and whose other end is
// 200 from the pin's middle. The pin is hollow there, with radius 1, so that its load is no point.
R1 = 50; R2 = 100; L1 = 200; hole = 1;
Point(1) = {0, 0, 0};
Point(2) = {R1, 0, 0};  Point(3) = {0, R1, 0};  Point(4) = {-R1/Sqrt(2), R1/Sqrt(2), 0};  Point(5) = {-R1, 0, 0};
Point(6) = {R2, 0, 0};  Point(7) = {0, R2, 0};  Point(8) = {-R2, R2, 0};  Point(9) = {-R2, 0, 0};
Point(10) = {-L1, R2, 0}; Point(11) = {-L1, 0, 0};
Circle(1) = {2, 1, 3}; Circle(2) = {3, 1, 4}; Circle(3) = {4, 1, 5};
Circle(4) = {6, 1, 7}; Line(5) = {7, 8}; Line(6) = {8, 9};
Line(7) = {2, 6}; Line(8) = {3, 7}; Line(9) = {4, 8}; Line(10) = {5, 9};
Line(11) = {8, 10}; Line(12) = {10, 11}; Line(13) = {11, 9};
Curve Loop(1) = {1, 8, -4, -7};   Plane Surface(1) = {1};
Curve Loop(2) = {2, 9, -5, -8};   Plane Surface(2) = {2};
Curve Loop(3) = {3, 10, -6, -9};  Plane Surface(3) = {3};
Curve Loop(4) = {6, -13, -12, -11}; Plane Surface(4) = {4};
// the pin, apart from the sheet
Point(22) = {R1, 0, 0};  Point(23) = {0, R1, 0};  Point(24) = {-R1, 0, 0};
Point(25) = {hole, 0, 0};  Point(26) = {0, hole, 0};  Point(27) = {-hole, 0, 0};
Circle(21) = {22, 1, 23}; Circle(22) = {23, 1, 24}; Circle(23) = {25, 1, 26}; Circle(24) = {26, 1, 27};
Line(25) = {25, 22}; Line(26) = {26, 23}; Line(27) = {27, 24};
Curve Loop(11) = {21, -26, -23, 25}; Plane Surface(11) = {11};
Curve Loop(12) = {22, -27, -24, 26}; Plane Surface(12) = {12};
Transfinite Curve {1, 4, 21, 23, 22, 24} = 7;
Transfinite Curve {2, 3, 5, 6, 12} = 4;
Transfinite Curve {7, 8, 9, 10} = 3;
Transfinite Curve {11, 13} = 3;
Transfinite Curve {25, 26, 27} = 6 Using Progression 2;
Transfinite Surface {1, 2, 3, 4, 11, 12};
Recombine Surface {1, 2, 3, 4, 11, 12};
Physical Surface("sheet") = {1, 2, 3, 4};
Physical Surface("pin") = {11, 12};
Physical Curve("hole") = {1, 2, 3};
Physical Curve("end") = {12};
Physical Curve("below") = {7, 10, 13};
Physical Curve("shaft") = {21, 22};
Physical Curve("load") = {23, 24};
Physical Curve("below pin") = {25, 27};
