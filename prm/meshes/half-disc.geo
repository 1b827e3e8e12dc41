// SPDX-License-Identifier: LGPL-2.1-or-later
// The half disc of roller.prm, lengths in mm: radius 10 around (0, 10), its flat side above. A layer of structured cells along the
// arc, so that none has two edges on it; free inside.
// gmsh -2 -format msh41 half-disc.geo
size = 3.5; r = 10; q = 6.5;
Point(1) = {0, r, 0, size}; Point(2) = {-r, r, 0}; Point(3) = {0, 0, 0}; Point(4) = {r, r, 0};
Point(5) = {-q, r, 0, size}; Point(6) = {0, r - q, 0, size}; Point(7) = {q, r, 0, size};
Circle(1) = {2, 1, 3}; Circle(2) = {3, 1, 4}; Circle(3) = {5, 1, 6}; Circle(4) = {6, 1, 7};
Line(5) = {5, 2}; Line(6) = {6, 3}; Line(7) = {7, 4}; Line(8) = {7, 5};
Curve Loop(1) = {-5, 3, 6, -1}; Curve Loop(2) = {-6, 4, 7, -2}; Curve Loop(3) = {3, 4, 8};
Plane Surface(1) = {1}; Plane Surface(2) = {2}; Plane Surface(3) = {3};
Transfinite Curve {1:4} = 5; Transfinite Curve {5:7} = 2; Transfinite Surface {1, 2}; Recombine Surface {1, 2};
Mesh.Algorithm = 6; Mesh.RecombinationAlgorithm = 1; Mesh.RecombineAll = 1;
Physical Curve("arc") = {1, 2}; Physical Curve("flat") = {5, 7, 8};
Physical Surface("disc") = {1:3};
