#!/bin/bash
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# usage: drawings.sh HPVI [SERVER]
#
# A table of bad input, as rows.sh says: drawings of CAD, and what a scene says of them.

base=drawing.prm
source "$(dirname "$0")/rows.sh"

invalid "Geometry/File" "Length unit = furlong" "give mm, cm, m, um, km, inch or ft" -- "Geometry/Length unit=furlong"
for size in 0 -1 nan "1, 2"; do
  invalid "Geometry/Mesh size = $size" "a positive number or nothing" -- "Geometry/Mesh size=$size"
done
invalid "Geometry/Mesh size from curvature = -1" "a number from 0 to 1000" -- "Geometry/Mesh size from curvature=-1"
invalid "Boundary inner/Curves = 4, x" "numbers of curves" -- "Boundary inner/Curves=4, x"
invalid "Geometry/File" "has no curve 5, which Boundary inner/Curves names" "it has 1, 2, 3 and 4" -- "Boundary inner/Curves=4, 5"
invalid "Boundary outer" "unknown subsection; this scene has: 1, 2, 3 and inner" -- "Boundary outer/Pressure=1"
sed 's/ADVANCED_FACE/ADVANCED_FUSS/' "$scenes/ring.step" >"$scratch/faceless.step"
printf 'ISO-10303-21;\nHEADER;\nENDSEC;\n' >"$scratch/cut.step"
for file in faceless cut; do
  invalid "Geometry/File" "$file.step: " "; " -- "Geometry/File=$scratch/$file.step"
done
cp "$scenes/ring.step" "$scratch/ring.vtk" # what it is stands in the file
invalid "Boundary outer" "unknown subsection; this scene has: 1, 2, 3 and inner" -- "Geometry/File=$scratch/ring.vtk" "Boundary outer/Pressure=1"
base=mesh.prm
invalid "Geometry/File" "is a mesh, of which Mesh size changes nothing; remove it" -- "Geometry/Mesh size=1"
invalid "Geometry/File" "has no unit of its own" -- "Geometry/Length unit=mm"

echo "$rows bad inputs, $failures failures"
[ $failures -eq 0 ]
