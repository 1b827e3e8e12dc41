// SPDX-License-Identifier: LGPL-2.1-or-later
// An angle bracket of steel, lengths in mm: foot 80 x 20, arm 20 x 80, between them a fillet of radius 10. The washer of a bolt
// presses on 20 mm of the foot, a rope pulls at the uppermost 20 mm of the arm.
// gmsh -2 -format msh41 bracket.geo
size = 10; t = 20; l = 80; r = 10;
Point(1) = {0, 0, 0, size}; Point(2) = {l, 0, 0, size}; Point(3) = {l, t, 0, size};
Point(4) = {65, t, 0, size/2}; Point(5) = {45, t, 0, size/2}; // the ends of the washer
Point(6) = {t + r, t, 0, size/2}; Point(7) = {t + r, t + r, 0}; Point(8) = {t, t + r, 0, size/2};
Point(9) = {t, l - 20, 0, size}; Point(10) = {t, l, 0, size}; Point(11) = {0, l, 0, size};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Circle(6) = {6, 7, 8};
Line(7) = {8, 9}; Line(8) = {9, 10}; Line(9) = {10, 11}; Line(10) = {11, 1};
Curve Loop(1) = {1:10}; Plane Surface(1) = {1};
Mesh.Algorithm = 6; Mesh.RecombinationAlgorithm = 3; Mesh.RecombineAll = 1;
// What no group names is free.
Physical Curve("sole") = {1}; Physical Curve("washer") = {4}; Physical Curve("fillet") = {6}; Physical Curve("rope") = {8};
Physical Surface("steel") = {1};
