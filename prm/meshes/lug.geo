// SPDX-License-Identifier: LGPL-2.1-or-later
// The drawing lug.step: gmsh -0 lug.geo -o lug.step -format step. A lug with a bore of radius 10 and a hollow pin in it [mm].
SetFactory("OpenCASCADE");
Rectangle(1) = {-20, -20, 0, 80, 40};
Disk(2) = {0, 0, 0, 10};
BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
Disk(4) = {0, 0, 0, 10};
Disk(5) = {0, 0, 0, 4};
BooleanDifference(6) = { Surface{4}; Delete; }{ Surface{5}; Delete; };
