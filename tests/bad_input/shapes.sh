#!/bin/bash
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# usage: shapes.sh HPVI [SERVER]
#
# A table of bad input, as rows.sh says: shapes with curves, mesh files, and what these do not offer.

base=ring.prm
source "$(dirname "$0")/rows.sh"

# --- the shape, and entries of another one
invalid "Geometry/Shape = ring" "give box, quadrilateral, ring sector, half disc, plate with hole or file" -- "Geometry/Shape=ring"
invalid "Geometry/Subdivisions = 2, 6000" "more than Adaptivity/Maximum unknowns = 1500" -- \
  "Geometry/Subdivisions=2, 6000" "Adaptivity/Maximum unknowns=1500" # read in seconds: each normal once took all edges
base=mesh.prm
invalid "Geometry/Shape = fil" "plate with hole or file" -- "Geometry/Shape=fil"
foreign() { # BASE NAME ENTRY=VALUE:SHAPE...
  base=$1
  local name=$2 row
  shift 2
  for row in "$@"; do
    invalid "${row%%=*} = " "has no meaning for a $name" "Shape = ${row##*:}" "or remove it" -- "${row%:*}"
  done
}
foreign ring.prm "ring sector" "Geometry/Corners=0,0; 1,0; 1,1; 0,1:quadrilateral" "Geometry/Lower corner=1, 1:box" \
  "Geometry/Upper corner=5, 5:box" "Geometry/Radius=2:half disc" "Geometry/Angle=3:half disc" \
  "Geometry/Part=quarter:plate with hole" "Geometry/File=body.msh:file" "Geometry/Mesh size=1:file" "Geometry/Length unit=mm:file"
foreign half_disc.prm "half disc" "Geometry/Corners=0,0; 1,0; 1,1; 0,1:quadrilateral" "Geometry/Radii=1, 3:ring sector" \
  "Geometry/Angles=0, 180:ring sector" "Geometry/Upper corner=5, 5:box" "Geometry/Part=quarter:plate with hole"
foreign plate.prm "plate with hole" "Geometry/Corners=0,0; 1,0; 1,1; 0,1:quadrilateral" "Geometry/Radii=1, 3:ring sector" \
  "Geometry/Angles=0, 180:ring sector" "Geometry/Angle=3:half disc" "Geometry/File=body.msh:file"
foreign mesh.prm "" "Geometry/Corners=0,0; 1,0; 1,1; 0,1:quadrilateral" "Geometry/Upper corner=5, 5:box" \
  "Geometry/Radii=1, 3:ring sector" "Geometry/Centre=1, 1:ring sector" "Geometry/Part=quarter:plate with hole"
foreign base.prm box "Geometry/Radii=1, 3:ring sector" "Geometry/Angles=0, 180:ring sector" "Geometry/Radius=2:half disc" \
  "Geometry/Centre=1, 1:ring sector" "Geometry/Angle=3:half disc" "Geometry/Part=quarter:plate with hole" "Geometry/File=body.msh:file"

# --- ring sectors
base=ring.prm
for radii in "2, 1" "-1, 1" "0, 1" "1, 1"; do
  invalid "Geometry/Radii = $radii" "are not ordered" "0 < inner < outer" -- "Geometry/Radii=$radii"
done
for radii in 1 "1, 2, 3" "nan, 2" "a, 2" "1; 2" ""; do
  invalid "Geometry/Radii = $radii" 'two numbers "inner, outer"' -- "Geometry/Radii=$radii"
done
invalid "Geometry/Radii = 1, 1e200" "to 1e+200" "choose another unit" -- "Geometry/Radii=1, 1e200"
invalid "Geometry/Radii = 1e-200, 2" "lengths from 3.90181e-201" "choose another unit" -- "Geometry/Radii=1e-200, 2"
invalid "Geometry/Radii = 1, 1.00000000001" "round-off blurs" -- "Geometry/Radii=1, 1.00000000001"
for angles in "90, 0" "0, 0" "0, 361" "0, 360.00000001" "-300, 61" "1e300, 2e300"; do
  invalid "Geometry/Angles = $angles" "do not run counterclockwise by at most 360 degrees" "from < to <= from + 360" -- "Geometry/Angles=$angles"
done
for angles in 90 "0, nan" "0, 90 degrees" "0, pi" "0; 90"; do
  invalid "Geometry/Angles = $angles" 'two numbers "from, to"' -- "Geometry/Angles=$angles"
done
invalid "Geometry/Subdivisions = 1, 1" "arcs of 180 degrees" "at least 2 angular cells" -- "Geometry/Angles=0, 180" "Geometry/Subdivisions=1, 1"
invalid "Geometry/Subdivisions = 0, 4" "two positive integers" -- "Geometry/Subdivisions=0, 4"
invalid "Geometry/Subdivisions = 1, 4, 2" "two positive integers" -- "Geometry/Subdivisions=1, 4, 2"
invalid "Geometry/Subdivisions = 9999, 9999" "a million cells" "start coarse" -- "Geometry/Subdivisions=9999, 9999"
invalid "Geometry/Subdivisions = 400, 400" "free unknowns of degree 2" "Maximum unknowns = 1000000" -- "Geometry/Subdivisions=400, 400"
for centre in 0 "0, inf" "0, 0, 0"; do
  invalid "Geometry/Centre = $centre" 'two finite numbers "x, y"' -- "Geometry/Centre=$centre"
done
invalid "Geometry/Radii = 1, 2" "coordinates up to 1e+11" "towards the origin" -- "Geometry/Centre=1e11, 0"
invalid "Geometry/Graded towards = 0, 0" "outside the body" -- "Geometry/Graded towards=0, 0" "Geometry/Grading levels=2"
invalid "Boundary left" "unknown subsection; this scene has: inner, outer, start and end" -- "Boundary left/Pressure=1"
invalid "Boundary iner" 'the nearest known one is "Boundary inner"' -- "Boundary iner/Pressure=1"
invalid "Boundary start" "unknown subsection; this scene has: inner and outer" -- "Geometry/Angles=0, 360"
invalid "Boundary inner/Curve = circle" "unknown entry" -- "Boundary inner/Curve=circle"
invalid "Boundary foot/On = bottom" "give inner, outer, start or end" -- "Boundary foot/On=bottom" "Boundary foot/Where=1"
invalid "Boundary foot/Where" "inside a face" "where the mesh has a vertex" -- "Boundary foot/On=inner" "Boundary foot/Where=x - 0.5"
invalid "Material rim/Where" "inside a cell" "where cells meet" -- "Material rim/Where=x - 1"
invalid "Boundary inner/Contact direction" "does not point out of the body" -- "Boundary inner/Contact=unilateral" "Boundary inner/Contact direction=1; 1"
free=("Boundary start/Symmetry=false" "Boundary end/Symmetry=false")
invalid "rigid-body motion" "translation in x" "Boundary inner, outer, start, end" -- "${free[@]}"
invalid "rigid-body motion" "rotation about (" -- "${free[@]}" "Boundary outer/Contact=bilateral"
invalid "Material/Plane = axisymmetric" "corner (-2, 0) at x < 0" -- "Material/Plane=axisymmetric" "Geometry/Angles=0, 180"
invalid "Boundary end/Symmetry = true" "axis x = 0" -- "Material/Plane=axisymmetric"

# --- half discs
base=half_disc.prm
for radius in 0 -1; do
  invalid "Geometry/Radius = $radius" "give a positive number" -- "Geometry/Radius=$radius"
done
for radius in nan "1, 2" "" big; do
  invalid "Geometry/Radius = $radius" "not accepted" "a positive number" -- "Geometry/Radius=$radius"
done
for radius in 1e-200 1e200; do
  invalid "Geometry/Radius = $radius" "choose another unit" -- "Geometry/Radius=$radius"
done
for angle in nan up "0, 90" ""; do
  invalid "Geometry/Angle = $angle" "give a number" -- "Geometry/Angle=$angle"
done
invalid "Geometry/Subdivisions = 2, 2" "has no meaning for a half disc" "coarse mesh is given" -- "Geometry/Subdivisions=2, 2"
invalid "Boundary bottom" "unknown subsection; this scene has: flat and arc" -- "Boundary bottom/Pressure=1"
invalid "Geometry/Angle = 1e300" "not accepted" -- "Geometry/Angle=1e300"

# --- plates with a hole
base=plate.prm
for radius in 0 -2; do
  invalid "Geometry/Radius = $radius" "give a positive number" -- "Geometry/Radius=$radius"
done
for radius in 1 1.5; do
  invalid "Geometry/Radius = $radius" "reaches a side of the plate" "1 away from the centre" "give less or move it" -- "Geometry/Radius=$radius"
done
invalid "Geometry/Radius = 2" "2 away from the centre" -- "Geometry/Part=quarter" "Geometry/Centre=0, 0" "Geometry/Radius=2"
invalid "Geometry/Radius = 0.999999999999" "round-off blurs" -- "Geometry/Radius=0.999999999999"
invalid "Geometry/Centre = 1, 1" "no corner of the plate" "Part = whole" -- "Geometry/Part=quarter"
invalid "Geometry/Centre = 1e-17, 0" "no corner of the plate" -- "Geometry/Part=quarter" "Geometry/Centre=1e-17, 0"
invalid "Geometry/Radius = 1e-12" "round-off blurs" -- "Geometry/Radius=1e-12"
invalid "Geometry/Subdivisions = 9999, 9999" "a million cells" -- "Geometry/Subdivisions=9999, 9999"
invalid "Geometry/Part = half" "give whole or quarter" -- "Geometry/Part=half"
for corner in "-1, 2" "0, 2"; do
  invalid "Geometry/Upper corner = $corner" "not above and right of the lower corner (0, 0)" -- "Geometry/Upper corner=$corner"
done
invalid "Geometry/Upper corner = 2, 2" "lower corner (2, 2)" -- "Geometry/Lower corner=2, 2"
invalid "Boundary outer" "unknown subsection; this scene has: left, right, bottom, top and hole" -- "Boundary outer/Pressure=1"

# --- mesh files
base=mesh.prm
cd "$scratch" && mkdir folder.msh && touch empty.msh && echo "Plane Surface(1) = {" >drawing.geo && cd empty || exit 2
sed 's/^2.2 0 8$/2.2 1 8/' "$scenes/body.msh" >"$scratch/binary.msh"
head -20 "$scenes/body.msh" >"$scratch/cut.msh"
mesh() { # FILE WORD...
  local file=$1
  shift
  words=("$(basename "$file")" "$@")
  check words --validate --set "Geometry/File=$file" "$scenes/mesh.prm"
}
mesh "$scratch/none.msh" "mesh.prm" "Geometry/File" "cannot be read" "check the name"
mesh "$scratch/empty.msh" "is empty" "write it anew"
mesh "$scratch/folder.msh" "is a directory" "name a drawing or a mesh"
mesh "$scratch/drawing.geo" "cannot be read or meshed" "as Gmsh says" "open it with gmsh"
mesh "$scratch/binary.msh" "has no cells in the plane" "give it a face"
mesh "$scratch/cut.msh" "cannot be read or meshed" "save it anew"
# Without names along its boundary a body cannot be held: with none at all, with points, with surfaces or inner curves alone.
sed '/^1 [1345] "/d; s/^7$/3/; /^[0-9]* 1 2 [1345] /d' "$scenes/body.msh" >"$scratch/inner_curve.msh"
for file in inner_curve; do
  lines=$(($(grep -n '^\$EndElements' "$scratch/$file.msh" | cut -d: -f1) - $(grep -n '^\$Elements' "$scratch/$file.msh" | cut -d: -f1) - 2))
  sed -i "/^\\\$Elements/{n;s/.*/$lines/}" "$scratch/$file.msh"
  mesh "$scratch/$file.msh" "the boundary of the body has no physical curve" 'Physical Curve("left") = {4};'
done
mesh "$scenes/ring.prm" "is no drawing" "and no mesh" "name such a file"
mesh /dev/null "cannot be read"
invalid "Geometry/Subdivisions = 2, 2" "whose coarse mesh is given" -- "Geometry/Subdivisions=2, 2"
invalid "Geometry/File = " "names no mesh" "body.msh" -- "Geometry/File="
invalid "Boundary left" "unknown subsection; this scene has: inside, outside, start, end and joint" -- "Boundary left/Pressure=1"
invalid "Boundary inside/Curve = ellipse" "give circle, spline or nothing" -- "Boundary inside/Curve=ellipse"
invalid "Boundary start/Curve = circle" "straight" "from (1, 0) to (2, 0)" "remove it" -- "Boundary start/Curve=circle"
invalid "Boundary end/Curve = circle" "has 2 vertices" "a circle needs three" -- "Boundary end/Curve=circle"
invalid "Boundary start/Curve = spline" "has 3 vertices" "a spline needs four" -- "Boundary start/Curve=spline"
inner="it is a curve inside of the body, which has Curve alone"
for entry in Pressure=1 Contact=unilateral "Friction coefficient=0.3" Gap=0 Displacement=0 Spring=1 Colour=red; do
  invalid "Boundary joint/${entry%%=*} = ${entry#*=}" "is an unknown entry; $inner" "for contact along it let each side be a Body NAME" -- "Boundary joint/$entry"
done
invalid "Boundary end/Colour = red" "unknown entry; Boundary end has Displacement" -- "Boundary end/Colour=red"
both=("Body a/Shape=file" "Body a/File=$scenes/body.msh" "Body b/Lower corner=0, 2" "Body b/Upper corner=1, 3")
sed '/^subsection \(Geometry\|Boundary.*\)$/,/^end/d' "$scenes/mesh.prm" >"$scratch/two.prm"
arguments=()
for override in "${both[@]}" "Contact c/Between=a.joint, b.bottom"; do
  arguments+=(--set "$override")
done
refused "Contact c/Between = a.joint, b.bottom" "names a.joint, a curve inside of body a" "by its Surfaces" -- --validate "${arguments[@]}" "$scratch/two.prm"
refused "Boundary foundation" "this scene has: a.inside, a.outside, a.start, a.end, b.left, b.right, b.bottom, b.top and a.joint" -- \
  --validate "${arguments[@]}" --set "Boundary foundation/Pressure=1" "$scratch/two.prm"
refused "body.msh: Surfaces names bushes" "it has bush and rim" -- --validate "${arguments[@]}" --set "Body a/Surfaces=bushes" "$scratch/two.prm"
invalid "Boundary part/Curve" "unknown entry" -- "Boundary part/On=inside" "Boundary part/Where=1" "Boundary part/Curve=circle"
invalid "Boundary part/Where" "where the mesh has a vertex" -- "Boundary part/On=inside" "Boundary part/Where=x - 0.7"
invalid "Boundary part/On = joint" "is no side" "give inside, outside, start or end" -- "Boundary part/On=joint" "Boundary part/Where=1"
invalid "Material pin/Where" "is missing" "the mesh has no surface of this name" "bush and rim" -- "Material pin/Young's modulus=3"
invalid "Material rim/Where = x" "a surface of the mesh that has this name" "keep one" -- "Material rim/Where=x"
invalid "Material Rim" "differs from Material rim in case" -- "Material Rim/Young's modulus=3"
invalid "Material bush/Young's modulus = -3" "number E > 0" -- "Material bush/Young's modulus=-3"
invalid "Geometry/Graded towards = 3, 3" "outside the body" -- "Geometry/Graded towards=3, 3" "Geometry/Grading levels=3"
invalid "Boundary end/Displacement" "axis x = 0" -- "Material/Plane=axisymmetric"

# --- what curves and meshes do not offer
declined() { # BASE NAME WHAT SPACE SAYS
  base=$1
  invalid "Geometry/Shape = $2" "the primal path" "Shape = box" -- "Solver/Path=primal" "Adaptivity/Method=hap2"
  invalid "$3" -- "Dimension=3"
}
other="space has no other shape"
declined ring.prm "ring sector" "$other"
declined half_disc.prm "half disc" "$other"
declined plate.prm "plate with hole" "$other"
declined mesh.prm file "has no cells in space"
base=ring.prm
invalid "Geometry/Shape = ring sector" "Exact solution/Solution = smooth" "Error/Reference solution" -- "${free[@]}" "Exact solution/Solution=smooth" \
  "Boundary start/Contact=bilateral" "Boundary start/Friction bound=1" "Boundary inner/Pressure=" "Boundary inner/Displacement=exact" \
  "Boundary outer/Displacement=exact" "Boundary end/Displacement=exact"
refused "no multiplier" "--inf-sup" "Boundary inner, outer, start, end" -- --inf-sup "$scenes/ring.prm"

# --- the good scenes
for scene in ring half_disc plate mesh; do
  "$hpvi" --validate "$scenes/$scene.prm" >"$scratch/stdout" 2>"$scratch/stderr" || complain "$scene.prm" "the good scene is rejected"
  [ ! -s "$scratch/stderr" ] || complain "$scene.prm" "something on stderr"
done
valid() { # NAME SCENE ENTRY=VALUE...
  local name=$1 scene=$2 arguments=() override
  shift 2
  for override in "$@"; do
    arguments+=(--set "$override")
  done
  "$hpvi" --validate "$scenes/$scene" "${arguments[@]}" >"$scratch/stdout" 2>"$scratch/stderr" || complain "$scene" "$name is rejected"
}
valid "a closed ring that contact alone holds" ring.prm "${free[@]}" "Boundary outer/Contact=unilateral"
valid "a quarter of a plate" plate.prm "Geometry/Part=quarter" "Geometry/Centre=2, 0"
valid "half a ball" half_disc.prm "Geometry/Angle=-90" "Material/Plane=axisymmetric" "Boundary flat/Displacement=" "Boundary arc/Displacement=0; 0" "Boundary arc/Pressure="
valid "a disc that hangs" half_disc.prm "Geometry/Angle=180"
valid "a spline" mesh.prm "Boundary inside/Curve=spline"
valid "a part along a curve" mesh.prm "Boundary part/On=inside" "Boundary part/Where=x - 0.5" "Boundary part/Shear=1"
valid "a material in the place of a surface" mesh.prm "Material pin/Where=x^2 + y^2 < 2.2 ? 1 : -1"
for angles in "0, 360" "-90, 270"; do
  sed '/^subsection Boundary \(start\|end\)/,/^end/d' "$scenes/ring.prm" >"$scratch/closed.prm"
  "$hpvi" --validate "$scratch/closed.prm" --set "Geometry/Angles=$angles" --set "Boundary outer/Displacement=0; 0" \
    >"$scratch/stdout" 2>"$scratch/stderr" || complain closed.prm "a closed ring is rejected"
done

echo "$rows bad inputs, $failures failures"
[ $failures -eq 0 ]
