#!/bin/bash
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# usage: bodies.sh HPVI [SERVER]
#
# A table of bad input, as rows.sh says: several bodies, pairs of their sides, and what they do not offer.

base=bodies.prm
source "$(dirname "$0")/rows.sh"
third=("Body third/Lower corner=1, 2" "Body third/Upper corner=2, 3" "Boundary third.top/Displacement=0; 0") # on the upper one

disc=("Body disc/Shape=half disc" "Body disc/Centre=1.5, 3" "Body disc/Radius=1" "Body disc/Angle=180" "Boundary disc.flat/Displacement=0; 0")

# --- names
invalid "Body a.b" "is no name" "letters" -- "Body a.b/Shape=box"
invalid "Body Upper" "differs from Body upper in case" -- "Body Upper/Shape=box"
invalid "Contact j/k" "is no name" -- "Contact j/k/Law=tied"
invalid "Contact Joint" "differs from Contact joint in case" -- "Contact Joint/Law=tied"
invalid "Body force/Shape = box" "unknown entry" -- "Body force/Shape=box"
invalid "Body Force" "force" "another name" -- "Body Force/Shape=box"
invalid "Body third/Size" "unknown entry" -- "Body third/Size=3"
invalid "Contact joint/Slide" "unknown entry" -- "Contact joint/Slide=3"
invalid "Contact joint/Contact" "unknown entry" -- "Contact joint/Contact=tied"

# --- what people mean stands in the entries of this scene
unknown() { # ENTRY WORD...
  local entry="$1"
  shift
  invalid "unknown" "$@" -- "$entry=1"
}
unknown "Contact joint/Friction" '"Contact joint/Friction bound"' '"Contact joint/Friction coefficient"'
unknown "Contact joint/mu" '"Contact joint/Friction coefficient"'
unknown "Contact joint/Type" '"Contact joint/Law" to unilateral, bilateral, tied or tangential'
unknown "Contact joint/Contact" '"Contact joint/Law"'
unknown "Contact joint/Clearance" '"Contact joint/Gap"'
unknown "Contact joint/Sides" '"Contact joint/Between" = BODY.side, BODY.side'
unknown "Boundary upper.left/Coefficient" '"Boundary upper.left/Friction coefficient"'
unknown "Boundary upper.top/Force density" "Boundary upper.top has Displacement"
unknown "Boundary upper.left/Loads" '"Boundary upper.left/Traction"'
unknown "Body upper/Width" '"Body upper/Lower corner" and "Body upper/Upper corner"'
unknown "Body upper/Mesh sise" '"Body upper/Mesh size"'
unknown "Friction" '"Boundary lower.left/Friction bound"'
unknown "Mesh" '"Body lower/Subdivisions"'
unknown "Material soft/E" "\"Material soft/Young's modulus\""

# --- scenes of one body and of several
invalid "Geometry" "Body" -- "Geometry/Upper corner=1, 1"
invalid "Geometry" "Body" -- "Geometry/Grading levels=2"
invalid "Boundary bottom" "unknown subsection; this scene has: lower.left, lower.right" "upper.top" -- "Boundary bottom/Traction=0; 0"
invalid "Boundary lower" "this scene has: lower.left" -- "Boundary lower/Traction=0; 0"
invalid "Boundary third.top" "this scene has: lower.left" -- "Boundary third.top/Traction=0; 0"
invalid "Boundary lower.inner" "this scene has: lower.left" -- "Boundary lower.inner/Traction=0; 0"
invalid "Boundary lower.Top" "\"Boundary lower.top\"" -- "Boundary lower.Top/Traction=0; 0"
base=base.prm
invalid "Boundary punch.bottom" "this scene has no bodies" "Boundary bottom" -- "Boundary punch.bottom/Traction=0; 0"
invalid "Contact joint" "Body" -- "Contact joint/Law=tied"
base=ring.prm
invalid "Boundary punch.inner" "this scene has no bodies" "Boundary inner" -- "Boundary punch.inner/Traction=0; 0"
base=bodies.prm

invalid "Adaptivity/Maximum unknowns = 500" "the bodies" "free unknowns of degree" "Subdivisions" -- "Adaptivity/Maximum unknowns=500" "Body lower/Subdivisions=20, 20"

# --- probes
invalid "Probe tip/At = 1.5, 1" "lower and upper touch" "On = BODY.side" -- "Probe tip/At=1.5, 1"
invalid "Probe tip/Size = 0.3" "leaves the body" "is 0.2 away" -- "Probe tip/At=1.5, 1.2" "Probe tip/Size=0.3"
invalid "Probe tip/On = top" "is no boundary" "upper.bottom" -- "Probe tip/On=top"

# --- each body by itself
invalid "Body upper/Shape = cone" "give box, quadrilateral" -- "Body upper/Shape=cone"
invalid "Body upper/Start degree = 3" "is for bodies in space" "Adaptivity/Start degree" -- "Body upper/Start degree=3"
invalid "Body upper/Surfaces = a" "are those of a mesh file" "Shape = file" -- "Body upper/Surfaces=a"
invalid "missing.msh" "Body upper/File" -- "Body upper/Shape=file" "Body upper/File=missing.msh"
invalid "Body upper/Upper corner = 0, 0" "not above and right of the lower corner (1, 1)" -- "Body upper/Upper corner=0, 0"
invalid "Body upper/Subdivisions = 0, 2" -- "Body upper/Subdivisions=0, 2"
invalid "Body upper/Radius = 2" "has no meaning for a box" "half disc" -- "Body upper/Radius=2"
invalid "Body upper/Corners" "not convex" -- "Body upper/Shape=quadrilateral" "Body upper/Corners=0,0; 1,0; 0.1,0.1; 0,1"
invalid "Body upper/Graded towards = 5, 5" "outside the body" -- "Body upper/Graded towards=5, 5" "Body upper/Grading levels=2"
invalid "Body upper/Grading levels = -1" -- "Body upper/Grading levels=-1"
invalid "Body upper/Material = glass" "is no material of this scene" "subsection Material glass" -- "Body upper/Material=glass"
invalid "Material third/Where" "is missing" -- "Material third/Density=1"
invalid "Material soft" "Where" -- "Body upper/Material="
invalid "Upper corner" "three finite numbers" -- "Dimension=3"

# --- pairs of sides
for sides in "" "upper.bottom" "upper.bottom, lower.top, lower.left" "upper.bottom; lower.top"; do
  invalid "Contact joint/Between = $sides" "names no two sides" "BODY.side, BODY.side" -- "Contact joint/Between=$sides"
done
invalid "Contact joint/Between = automatic" "finds no sides of two bodies that lie on each other" "; name two, or set Closed within" -- \
  "Contact joint/Between=automatic" "Body upper/Lower corner=1, 1.001"
for side in bottom upper.inner third.top upper lower.Top; do
  invalid "Contact joint/Between = $side, lower.top" "names $side, which is no side" "this scene has: lower.left, lower.right" -- \
    "Contact joint/Between=$side, lower.top"
done
invalid "Contact joint/Between" "sides of one body" "of two" -- "Contact joint/Between=upper.bottom, upper.top"
invalid "Contact joint/Between" "sides of one body" -- "Contact joint/Between=upper.bottom, upper.bottom"
invalid "Contact joint/Between" "do not face each other" "60 degrees" "two that lie opposite" -- "Contact joint/Between=upper.bottom, lower.left"
invalid "Contact joint/Between" "look the same way" -- "Contact joint/Between=upper.bottom, lower.bottom"
invalid "Contact joint/Between" "do not face each other" -- "Contact joint/Between=upper.bottom, lower.bottom" # both look down
invalid "Contact joint/Between" "do not face each other" "60 degrees" -- "Body upper/Shape=quadrilateral" "Body upper/Corners=1, 1; 2, 3; 2, 5; 1, 4"
invalid "Contact joint/Law = tied" "lie apart" -- "Body upper/Shape=quadrilateral" "Body upper/Corners=1, 1; 2, 1.001; 2, 2; 1, 2" "Contact joint/Law=tied"
invalid "Contact joint/Between" "one ends before the other begins" -- "Body upper/Lower corner=3, 1" "Body upper/Upper corner=4, 2"
invalid "Contact joint/Between" "inside each other" "0.25" "negative Gap" -- "Body upper/Lower corner=1, 0.75"
lid=("${disc[@]}" "Contact lid/Between=upper.top, disc.arc" "Boundary upper.top/Displacement=" "Boundary upper.left/Displacement=0; 0")
invalid "Contact lid/Between" "inside each other" "0.1" "at (1" "negative Gap" -- "${lid[@]}" "Body disc/Centre=1.5, 2.9"
invalid "Contact lid/Between" "do not face each other" "60 degrees" -- "${lid[@]}" "Contact lid/Between=upper.left, disc.arc"
invalid "Contact lid/Between" "do not face each other" -- "${lid[@]}" "Body disc/Angle=0"
invalid "Contact lid/Slave = disc.arc" "edge of the slave, at (" "hangs over" "automatic" -- "${lid[@]}" "Contact lid/Slave=disc.arc"
invalid "Contact lid/Law = bilateral" "lie apart" "move them together" -- "${lid[@]}" "Contact lid/Law=bilateral"
invalid "Contact lid/Law = tied" "lie apart" -- "${lid[@]}" "Contact lid/Law=tied"
invalid "Contact lid/Gap" "not an expression" "no body here" -- "${lid[@]}" "Contact lid/Gap=mu*x"
invalid "Contact again/Between" "overlaps Contact lid/Between" -- "${lid[@]}" "Contact again/Between=upper.top, disc.arc"
invalid "Contact again/Between" "edges of lower.top that Contact joint has, too" "one body" -- "Contact again/Between=lower.top, upper.bottom"
invalid "Contact joint/Between" "parts of both sides that hang over" "a vertex" -- "Body lower/Shape=quadrilateral" \
  "Body lower/Corners=0, 0; 3, 0; 3, 1; 0, 1" "Body lower/Subdivisions=2, 1" "Body upper/Shape=quadrilateral" "Body upper/Corners=2, 1; 4, 1; 4, 2; 2, 2" "Body upper/Subdivisions=1, 1"
invalid "Contact joint/Slave = lower.top" "hangs over the end" -- "Body lower/Shape=quadrilateral" \
  "Body lower/Corners=0, 0; 3, 0; 3, 1; 0, 1" "Body lower/Subdivisions=2, 1" "Contact joint/Slave=lower.top"
rings=("Body arch/Shape=ring sector" "Body arch/Radii=1, 2" "Body arch/Centre=1.5, 6" "Body arch/Angles=200, 300" "Body arch/Subdivisions=1, 2" "Boundary arch.outer/Displacement=0; 0"
  "Body tube/Shape=ring sector" "Body tube/Radii=0.5, 1" "Body tube/Centre=1.5, 6" "Body tube/Angles=220, 330" "Body tube/Subdivisions=1, 3" "Boundary tube.inner/Displacement=0; 0")
invalid "Contact lid/Between" "hang over the end of the other, at (" "parts of them" -- "${rings[@]}" "Contact lid/Between=tube.outer, arch.inner"
invalid "Contact lid/Slave = tube.outer" "edge of the slave, at (" "hangs over" -- "${rings[@]}" "Contact lid/Between=tube.outer, arch.inner" "Contact lid/Slave=tube.outer"

# --- parts of sides
seat=("Boundary seat/On=lower.top" "Boundary seat/Where=0.5 - abs(x - 1.5)")
invalid "Contact joint/Between" "names seet, which is no side" "upper.top and seat" -- "${seat[@]}" "Contact joint/Between=upper.bottom, seet"
invalid "Boundary seat/Pressure = 1" "acts nowhere" "Contact joint" -- "${seat[@]}" "Contact joint/Between=upper.bottom, seat" "Boundary seat/Pressure=1"
invalid "Boundary seat/Where" "is positive nowhere on lower.top" -- "${seat[@]}" "Contact joint/Between=upper.bottom, seat" "Boundary seat/Where=x - 5"
invalid "Contact joint/Between" "one ends before the other begins" -- "${seat[@]}" "Contact joint/Between=upper.bottom, seat" "Boundary seat/Where=0.5 - x"
invalid "Contact joint/Between" "sides of one body" -- "${seat[@]}" "Contact joint/Between=seat, lower.left"
invalid "Contact again/Between" "edges of" "Contact joint has, too" -- "${seat[@]}" "Contact joint/Between=upper.bottom, seat" "Contact again/Between=seat, upper.bottom"
invalid "Contact joint/Slave = lower.top" "is none of the two sides" -- "${seat[@]}" "Contact joint/Between=upper.bottom, seat" "Contact joint/Slave=lower.top"
invalid "Solver/Normal contact = nodes" "several bodies is not offered" "set multiplier" -- "Solver/Normal contact=nodes"
invalid "Contact joint/Slave = lower.bottom" "is none of the two sides" "automatic" -- "Contact joint/Slave=lower.bottom"
invalid "Contact joint/Slave = lower" "is none of the two sides" -- "Contact joint/Slave=lower"
invalid "Contact again/Between" "names no two sides" -- "Contact again/Law=tied"

invalid "Boundary foot/Where" "changes its sign inside a face of the coarse mesh, at (" "the mesh has a vertex" -- "${disc[@]}" "Boundary foot/On=disc.flat" \
  "Boundary foot/Where=x - 1.23" "Boundary foot/Pressure=1"

# --- their laws
invalid "Contact joint/Law = glued" "unilateral, bilateral, tied or tangential" -- "Contact joint/Law=glued"
for law in bilateral tied tangential; do
  invalid "Contact joint/Gap = 0.1" "needs contact that can open" "unilateral" -- "Contact joint/Law=$law" "Contact joint/Gap=0.1"
done
for law in bilateral tied; do
  invalid "Contact joint/Law = $law" "lie apart" "move them together" -- "Contact joint/Law=$law" \
    "Body upper/Lower corner=1, 1.1"
done
for law in bilateral tied; do
  invalid "Contact joint/Law = $law" "lie apart" "set Closed within" -- "Contact joint/Law=$law" "Body upper/Lower corner=1, 1.01" "Contact joint/Closed within=0.009"
done
invalid "Contact joint/Closed within = 0.04" "more than 1 % of the size" "give less" -- "Contact joint/Closed within=0.04"
for value in -0.001 1e400 "0.001*x" "0.001, 0.001"; do
  invalid "Contact joint/Closed within = $value" "a number of 0 or more" -- "Contact joint/Closed within=$value"
done
invalid "Boundary upper.bottom/Closed within" "unknown entry" -- "Boundary upper.bottom/Closed within=0.001"
invalid "Contact joint/Between" "inside each other" "0.025" "Closed within" -- "Body upper/Lower corner=1, 0.975" "Contact joint/Closed within=0.02"
invalid "Contact joint/Friction bound = 0.1" "where bodies are tied" "remove it" -- "Contact joint/Law=tied" "Contact joint/Friction bound=0.1"
invalid "Contact joint/Friction coefficient = 0.1" "where bodies are tied" -- "Contact joint/Law=tied" "Contact joint/Friction coefficient=0.1"
invalid "Contact joint/Friction bound" "g >= 0" -- "Contact joint/Friction bound=-1"
invalid "Contact joint/Friction bound" "g >= 0" -- "Contact joint/Friction bound=x - 1.5"
invalid "Contact joint/Friction coefficient" "mu_f >= 0" -- "Contact joint/Friction coefficient=1.5 - x"
invalid "Contact joint/Friction bound" "not an expression" "no body here" -- "Contact joint/Friction bound=E"
invalid "Contact joint/Gap" "not an expression" "no body here" -- "Contact joint/Gap=mu*x"
invalid "Contact joint/Gap" "has 2 component(s)" -- "Contact joint/Gap=x; y"
invalid "Contact joint/Gap" "not finite" -- "Contact joint/Gap=1/(x - x)"
invalid "Contact joint/Friction coefficient" "Friction bound" -- "Contact joint/Friction bound=1" "Contact joint/Friction coefficient=0.3"
invalid "Contact joint/Friction coefficient" -- "Contact joint/Law=tangential" "Contact joint/Friction coefficient=0.3"

# --- what else may stand on these sides
invalid "Boundary upper.bottom/Contact = unilateral" "Contact joint" -- "Boundary upper.bottom/Contact=unilateral"
invalid "Boundary upper.bottom/Displacement = 0; 0" "Contact joint" -- "Boundary upper.bottom/Displacement=0; 0"
invalid "Boundary upper.bottom/Pressure = 1" "Contact joint" -- "Boundary upper.bottom/Pressure=1"
invalid "Boundary upper.bottom/Rigid = true" "Contact joint" -- "Boundary upper.bottom/Rigid=true"
invalid "Boundary foot/Where" "overlaps Contact joint" -- "Boundary foot/On=lower.top" "Boundary foot/Where=0.5 - abs(x - 1.5)" "Boundary foot/Pressure=1"

# --- what holds each body: contact may, where there is any
invalid "Body third" "its supports leave a rigid-body motion free, translation in x" "it touches nothing" -- "${third[@]}" "Boundary third.top/Displacement="
invalid "Body third" "translation in y" "it touches nothing" -- "${third[@]}" "Boundary third.top/Displacement=" "Boundary third.left/Displacement=0; free"

# --- what several bodies do not offer
invalid "Solver/Path = primal" "several bodies is not offered" "auto or reduced" -- "Solver/Path=primal" "Adaptivity/Method=hup2"
invalid "Material/Plane = axisymmetric" "x < 0" -- "Material/Plane=axisymmetric" "Body lower/Lower corner=-1, 0"
invalid "Material/Elasticity = orthotropic" "axisymmetric" -- "Material/Plane=axisymmetric" "Material/Elasticity=orthotropic" "Material/Young's modulus=" \
  "Material/Poisson's ratio=" "Material/Young's moduli=1, 2, 3" "Material/Poisson's ratios=0.1, 0.1, 0.1" "Material/Shear moduli=1, 1, 1" "Material soft/Elasticity=isotropic" \
  "Material soft/Poisson's ratio=0.3"
invalid "Material/Thickness" "is that of a plane body" -- "Material/Plane=axisymmetric" "Material/Thickness=2" "Boundary lower.bottom/Displacement=free; 0" "Boundary upper.top/Displacement=free; -0.02"
invalid "Solver/Multiplier degree offset = -3" "several bodies is not offered" -- "Solver/Multiplier degree offset=-3"
invalid "Exact solution/Solution = smooth" "several bodies is not offered" "set none" -- "Exact solution/Solution=smooth"

# --- the good scenes
valid() { # NAME ENTRY=VALUE...
  local name=$1 arguments=() override
  shift
  for override in "$@"; do
    arguments+=(--set "$override")
  done
  "$hpvi" --validate "$scenes/bodies.prm" "${arguments[@]}" >"$scratch/stdout" 2>"$scratch/stderr" || complain bodies.prm "$name is rejected"
  [ ! -s "$scratch/stderr" ] || complain bodies.prm "$name: something on stderr"
}
valid "the scene"
valid "a gap in the drawing" "Body upper/Lower corner=1, 1.25"
valid "interference" "Contact joint/Gap=-0.01"
valid "a small gap that counts as none" "Body upper/Lower corner=1, 1.01" "Contact joint/Closed within=0.01" "Contact joint/Law=tied"
valid "an overlap that counts as none" "Body upper/Lower corner=1, 0.98" "Contact joint/Closed within=0.03"
valid "parts and materials inside edges" "Body upper/Material=" "Material soft/Where=x < 1.234" "Boundary foot/On=upper.right" "Boundary foot/Where=y - 1.3" "Boundary foot/Pressure=1"
valid "a gap that varies" "Contact joint/Gap=0.1*(x - 1.5)^2"
valid "a third body" "${third[@]}" "Contact lid/Between=third.bottom, upper.top" "Boundary upper.top/Displacement=" "Boundary upper.left/Displacement=0; 0"
valid "a body that contact alone holds" "Boundary upper.top/Displacement=" "Boundary upper.top/Traction=0; -1"
valid "a history" "Loading/Steps=4"
valid "an edge that hangs over" "Body lower/Shape=quadrilateral" "Body lower/Corners=0, 0; 3, 0; 3, 1; 0, 1" "Body lower/Subdivisions=2, 1"
valid "a body on springs" "Boundary upper.top/Displacement=" "Boundary upper.top/Spring=1; 1"
valid "ends that a box cuts" "Body upper/Lower corner=0.9, 1" "Body upper/Upper corner=1.7, 2"
valid "sides at an angle" "Body upper/Shape=quadrilateral" "Body upper/Corners=1, 1; 2, 1.001; 2, 2; 1, 2"
valid "a disc on a block" "${lid[@]}"
valid "a disc on a wider block" "${lid[@]}" "Body disc/Radius=0.4" "Body disc/Centre=1.5, 2.4" "Contact lid/Slave=disc.arc"
valid "bodies of revolution" "Material/Plane=axisymmetric" "Boundary lower.bottom/Displacement=free; 0" "Boundary upper.top/Displacement=free; -0.02"
valid "--set opens a section" "Boundary lower.left/Traction=1; 0"
valid "a part of a side" "${seat[@]}" "Contact joint/Between=seat, upper.bottom" "Contact joint/Slave=seat"
valid "a part that says more than the pair takes" "${seat[@]}" "Contact joint/Between=upper.bottom, seat" "Boundary seat/Where=1.2 - abs(x - 1.5)" "Boundary seat/Pressure=1"
valid "a covered side that says nothing" "Boundary upper.bottom/Symmetry=false" "Boundary upper.bottom/Contact=none"
valid "friction of two kinds" "Contact joint/Friction coefficient=0.3 + x/10"
valid "a disc that lies with its flat side on a block" "Body disc/Shape=half disc" "Body disc/Centre=1.5, 2" "Body disc/Radius=0.5" "Body disc/Angle=0" \
  "Contact lid/Between=upper.top, disc.flat" "Boundary disc.arc/Displacement=0; -0.02" "Boundary upper.top/Displacement=" "Boundary upper.left/Displacement=0; 0"
"$hpvi" --print-parameters "$scenes/bodies.prm" >"$scratch/effective.prm" 2>"$scratch/stderr"
"$hpvi" --print-parameters "$scratch/effective.prm" 2>"$scratch/stderr" | cmp -s - "$scratch/effective.prm" ||
  complain bodies.prm "effective parameters do not survive a round trip"
"$hpvi" --inf-sup "$scenes/../../prm/bush.prm" --set "Adaptivity/Maximum steps=2" >"$scratch/stdout" 2>"$scratch/stderr" ||
  complain bush.prm "the inf-sup constant is not measured where the reference mesh has more multipliers on the other side"

echo "$rows bad inputs, $failures failures"
[ $failures -eq 0 ]
