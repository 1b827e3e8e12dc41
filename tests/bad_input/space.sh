#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# space.sh HPVI SERVER MPIRUN: what space and several processes do not offer ends with one line that says so.
set -u
root=$PWD mpirun=$3
source "$(dirname "$0")/rows.sh"
cd "$root" || exit 2

# check STATUS WORDS... -- COMMAND...: the command ends with the status and one line that has all words.
check() {
  local status=$1 words word
  words_of "${@:2}"
  set -- "${rest[@]}"
  local got
  if [ "$1" = "$hpvi" ]; then
    run_hpvi "${@:2}"
  else
    "$@" >"$scratch/stdout" 2>"$scratch/stderr"
  fi
  got=$?
  grep -v '^-*$\|^mpirun\|the job to be terminated\|^Primary job\|a non-zero exit code\|exiting improperly\|^ *Process name\|^ *Exit code\|^$' "$scratch/stderr" >"$scratch/lines"
  [ -z "${HPVI_ROWS:-}" ] || { echo "$* -> $got" && cat "$scratch/lines"; } >>"$HPVI_ROWS" # see rows.sh
  [ "$got" -eq "$status" ] || { echo "status $got, not $status: $*"; failures=1; }
  [ "$(wc -l <"$scratch/lines")" -eq 1 ] || { echo "not one line: $*"; cat "$scratch/stderr"; failures=1; }
  for word in "${words[@]}"; do
    grep -qF -- "$word" "$scratch/lines" || { echo "no \"$word\": $*"; cat "$scratch/lines"; failures=1; }
  done
}

# overridden STATUS COMMAND... -- WORD... -- ENTRY=VALUE...: that command with these entries overridden.
overridden() {
  local status=$1 command words override
  words_of "${@:2}"
  command=("${words[@]}")
  words_of "${rest[@]}"
  for override in "${rest[@]}"; do
    command+=(--set "$override")
  done
  check "$status" "${words[@]}" -- "${command[@]}"
}

invalid() {
  overridden 1 "$hpvi" --validate prm/slab.prm -- prm/slab.prm "$@"
}

"$hpvi" --validate prm/slab.prm >/dev/null || failures=1

# --- points and vectors have three components, and a plane scene has no z
invalid "Upper corner = 4, 4" "three finite numbers" -- "Geometry/Upper corner=4, 4"
invalid "Subdivisions = 4, 4" "three positive integers" -- "Geometry/Subdivisions=4, 4"
invalid "Probe tip/Size" "no disc" -- "Probe tip/At=1, 1, 1" "Probe tip/Size=0.1"
invalid "Probe tip/At = 1, 1" "give a point x, y, z" -- "Probe tip/At=1, 1"
invalid "Probe tip/At = 9, 1, 1" "outside of the body" -- "Probe tip/At=9, 1, 1"
invalid "2 component(s) instead of 3" -- "Boundary left/Traction=1; 0"
invalid "expression of x, y and z" -- "Boundary left/Traction=1; 0; w"
check 1 "expression of x and y" -- "$hpvi" --validate prm/han-6-12.prm --set "Boundary left/Traction=1; z"
check 1 "Lower corner = 0, 0, 0" "two finite numbers" -- "$hpvi" --validate prm/slab.prm --set Dimension=2

# --- bodies that touch, each held
cat >"$scratch/blocks.prm" <<'END'
set Dimension = 3
subsection Body high
  set Lower corner = 0, 1, 0
  set Upper corner = 1, 1.5, 1
end
subsection Body low
  set Upper corner = 1, 1, 1
end
subsection Boundary low.bottom
  set Displacement = 0; 0; 0
end
subsection Boundary high.top
  set Displacement = 0; -0.01; 0
end
subsection Contact joint
  set Between = high.bottom, low.top
end
END
blocks() {
  overridden 1 "$hpvi" --validate "$scratch/blocks.prm" -- "$@"
}
"$hpvi" --validate "$scratch/blocks.prm" >/dev/null || failures=1
blocks "Contact joint/Between" "do not face each other" "name two that lie opposite" -- "Contact joint/Between=high.bottom, low.left"
blocks "Contact joint/Between" "beside each other" -- "Body high/Lower corner=2, 1, 0" "Body high/Upper corner=3, 2, 1"
blocks "Contact joint/Between" "0.25 inside each other" "negative Gap" -- "Body high/Lower corner=0, 0.75, 0"
blocks "Contact joint/Between" "finds no sides of two bodies that lie on each other" -- "Contact joint/Between=automatic" "Body high/Lower corner=0, 1.1, 0"
blocks "Contact joint/Between" "no two sides" "or automatic" -- "Contact joint/Between=high.bottom"
blocks "Body high/Surfaces" "those of a mesh file" -- "Body high/Surfaces=1"
"$hpvi" --validate "$scratch/blocks.prm" --set "Contact joint/Between=automatic" | grep -q "set Between = high.bottom, low.top" || { echo "automatic finds no joint"; failures=1; }
blocks "Contact joint/Between" "no side" "high.bottom" -- "Contact joint/Between=high.bottom, low.roof"
blocks "Contact joint/Between" "sides of one body" -- "Contact joint/Between=high.bottom, high.top"
blocks "Contact joint/Slave" "none of the two sides" -- "Contact joint/Slave=low.left"
blocks "Contact joint/Closed within" "more than 1 %" -- "Contact joint/Closed within=0.5"
blocks "Contact joint/Law" "needs bodies that touch" -- "Contact joint/Law=tied" "Body high/Lower corner=0, 1.1, 0"
blocks "Contact joint/Friction bound" "means nothing where bodies are tied" -- "Contact joint/Law=tied" "Contact joint/Friction bound=1"
blocks "Body high" "leave a rigid-body motion free" "no friction resists it" "tie it to a body that is held" -- "Boundary high.top/Displacement=" "Contact joint/Law=bilateral"
blocks "Boundary low.top/Traction" "Contact joint has all of this side" -- "Boundary low.top/Traction=0; 1; 0"
blocks "Body high/Start degree = 9" "is not offered by space" "give 2 to 8" -- "Body high/Start degree=9"
blocks "Body low/Start degree = 1" "is not offered by space" -- "Body high/Start degree=4" "Body low/Start degree=1"
blocks "Adaptivity/Start degree = 9" "is not offered by space" -- "Body high/Start degree=4" "Adaptivity/Start degree=9"
blocks "Body high/Start degree = 4" "exceeds Maximum degree = 3" -- "Body high/Start degree=4" "Adaptivity/Maximum degree=3" "Adaptivity/Start degree=2"
blocks "Body low/Start degree = x" "an integer from 0 to 20" -- "Body low/Start degree=x"
blocks "Solver/Linear = multigrid" "is for degrees 2 to 4" "Body low/Start degree is 5" -- "Body low/Start degree=5" "Solver/Linear=multigrid"
blocks "Adaptivity/Maximum unknowns = 1" "at least 48 free unknowns of degree 3" -- "Body high/Start degree=4" "Adaptivity/Start degree=3" "Adaptivity/Maximum unknowns=1"
invalid "Geometry" "Body" -- "Body block/Start degree=3"

# --- what is of the plane
invalid "Material/Plane" "unknown entry" "only a body in the plane" -- "Material/Plane=stress"
invalid "Shape = quadrilateral" "give box" -- "Geometry/Shape=quadrilateral"
invalid "Material/Elasticity = cubic" "isotropic or orthotropic" -- "Material/Elasticity=cubic"
invalid "Material/Angle" '"Material/Axes" = x1, y1, z1; x2, y2, z2' -- "Material/Angle=0"
wood=("Material/Young's modulus=" "Material/Poisson's ratio=" "Material/Elasticity=orthotropic" "Material/Young's moduli=9, 1, 2" "Material/Poisson's ratios=0.3, 0.3, 0.3" "Material/Shear moduli=1, 1, 1")
invalid "Material/Young's modulus" "contradicts Elasticity = orthotropic" -- "${wood[@]:2}"
invalid "Material/Young's moduli = 9, 1" "give E1, E2, E3" -- "${wood[@]}" "Material/Young's moduli=9, 1"
invalid "Material/Shear moduli = 1" "give G12, G13, G23" -- "${wood[@]}" "Material/Shear moduli=1"
invalid "Material/Shear moduli" "lacks G12" "needs in space" "give G12, G13, G23" -- "${wood[@]}" "Material/Shear moduli="
invalid "Material/Poisson's ratios" "must be less than E1/E3" -- "${wood[@]}" "Material/Poisson's ratios=0.3, 3, 0.3"
invalid "Material/Axes = 1, 0, 0" "give two vectors x1, y1, z1; x2, y2, z2" -- "${wood[@]}" "Material/Axes=1, 0, 0"
invalid "Material/Axes = 1, 2, 3; -2, -4, -6" "are no two directions" "a vector in the plane of axes 1 and 2" -- "${wood[@]}" "Material/Axes=1, 2, 3; -2, -4, -6"
invalid "Material/Axes" "contradicts Elasticity = isotropic" -- "Material/Axes=1, 0, 0; 0, 1, 0"
invalid "Material wood/Axes" "are no two directions" -- "Material wood/Where=x - 1" "${wood[@]/Material/Material wood}" "Material wood/Axes=0, 0, 0; 0, 1, 0"
invalid "Body force/Expression" "is orthotropic and has no E, nu and mu" -- "${wood[@]}" "Body force/Expression=0; E; 0"
invalid "Material/Orientation" '"Material/Shear moduli" = G12, G13, G23' -- "Material/Orientation=1"
invalid "Material/Thickness" "only a body in the plane" -- "Material/Thickness=2"
invalid "Boundary top/Spring = 1; 1; 1" "3 component(s) instead of 2" -- "Boundary top/Spring=1; 1; 1"
invalid "Boundary top/Spring" "is negative at" -- "Boundary top/Spring=1; z - 1"
invalid "Boundary top/Spring" "uses t" "functions of x, y and z" -- "Boundary top/Spring=1; t"
invalid "Boundary bottom/Spring" "stands beside Contact" -- "Boundary bottom/Spring=1; 1"
invalid "Boundary top/Symmetry" "contradicts" "Spring" -- "Boundary top/Symmetry=true" "Boundary top/Spring=1; 1"
invalid "rigid-body motion free, translation in x" -- "Boundary right/Displacement=" "Boundary right/Spring=0; 1" "Boundary bottom/Friction bound="
invalid "Material/Initial strain = 0.1; 0; 0" "3 component(s) instead of 6" -- "Material/Initial strain=0.1; 0; 0"
invalid "Material/Initial strain" "is not finite" -- "Material/Initial strain=1/(z - 2); 0; 0; 0; 0; 0"
invalid "Material/Eigenstrain" '"Material/Initial strain" = e1; e2; e3; e12; e13; e23' -- "Material/Eigenstrain=0.1"
invalid "Material/Thermal expansion = hot" "a number" -- "Material/Thermal expansion=hot"
invalid "Temperature/Expression = 20" "give Material/Thermal expansion" -- "Temperature/Expression=20"
invalid "Temperature/Expression = t" "the time of a load history" -- "Material/Thermal expansion=1e-5" "Temperature/Expression=t"
# --- rigid plates
plate() {
  local words
  words_of "$@"
  invalid "${words[@]}" -- "Boundary left/Traction=" "Boundary left/Rigid=true" "Boundary bottom/Contact=none" "Boundary bottom/Friction bound=" "${rest[@]}"
}
plate "Boundary left/Displacement = 0; z; 0" "a rigid plate has one value" "x, y or z" -- "Boundary left/Displacement=0; z; 0"
plate "Boundary left/Moment = 1" "1 component(s) instead of 3" -- "Boundary left/Moment=1"
plate "Boundary left/Rotation = 0; t; 0" "the time of a load history" -- "Boundary left/Rotation=0; t; 0"
plate "Boundary left/Force = 1; 1; 0" "contradicts Boundary left/Displacement = free; 0; free in y" "write \`free\`" -- "Boundary left/Force=1; 1; 0" "Boundary left/Displacement=free; 0; free"
plate "Boundary left/Moment = 0; 0; 1" "contradicts Boundary left/Rotation = free; free; 0.1 in z" -- "Boundary left/Moment=0; 0; 1" "Boundary left/Rotation=free; free; 0.1"
plate "Boundary left/Rigid = true" "contradicts Boundary left/Contact = unilateral" "stands alone" -- "Boundary left/Contact=unilateral"
plate "Boundary left/Rigid = true" "contradicts Boundary left/Symmetry = true" -- "Boundary left/Symmetry=true"
plate "Boundary left/Rigid = true" "contradicts Boundary left/Pressure = 1" -- "Boundary left/Pressure=1"
plate "Boundary left/Rigid = true" "contradicts Boundary left/Spring = 1; 1" -- "Boundary left/Spring=1; 1"
plate "Boundary left/Rigid = true" "leaves a plate free to move against Boundary front/Symmetry" -- "Boundary front/Symmetry=true" "Boundary left/Rotation=0; free; 0"
plate "Boundary left/Displacement = 0; 0; 0.1" "contradicts Boundary front/Symmetry" "by 0.1" -- "Boundary front/Symmetry=true" "Boundary left/Displacement=0; 0; 0.1" "Boundary left/Rotation=0; 0; 0"
plate "Boundary left/Displacement" "exceeds the gap by 0.1" -- "Boundary bottom/Contact=unilateral" "Boundary left/Displacement=0; -0.1; 0" "Boundary left/Rotation=0; 0; 0"
plate "rigid-body motion free, translation in x" "no friction resists" -- "Boundary right/Displacement=" "Boundary left/Displacement=free; 0; 0" "Boundary left/Rotation=0; 0; 0"
invalid "Boundary left/Moment" "is that of a rigid plate" "set Rigid = true" -- "Boundary left/Moment=1; 0; 0"
invalid "Boundary bottom/Contact direction = 0; -1" "2 component(s) instead of 3" -- "Boundary bottom/Contact direction=0; -1"
invalid "Boundary bottom/Contact direction = 0; 0; 0" "has no direction" -- "Boundary bottom/Contact direction=0; 0; 0"
invalid "Boundary bottom/Contact direction" "uses x, y, z or t" -- "Boundary bottom/Contact direction=0; -1; z"
invalid "Boundary bottom/Contact direction" "does not point out of the body" -- "Boundary bottom/Contact direction=1; 0; 1"
invalid "Boundary top/Contact direction" "needs contact" -- "Boundary top/Contact direction=0; 1; 0"
invalid "Boundary bottom/Contact" "along no axis" "set unilateral" -- "Boundary bottom/Contact direction=1; -2; 0"
invalid "Boundary bottom/Direction" '"Boundary bottom/Contact direction" = dx; dy; dz' -- "Boundary bottom/Direction=1"
invalid "Boundary top/Shear" 'space has two tangents; write "Boundary top/Traction" = Gx; Gy; Gz' -- "Boundary top/Shear=1"
invalid "Boundary left/Shear" 'write "Boundary left/Traction" = Gx; Gy; Gz' -- "Boundary left/Shear=1"
! grep -q "Gz; Gz" "$scratch/lines" || { echo "a fourth component"; failures=1; }
invalid "Boundary top/Forces" '"Boundary top/Traction" = Gx; Gy; Gz' '"Body force/Expression" = Fx; Fy; Fz' -- "Boundary top/Forces=1"
invalid "Boundary back/Fixed" '"Boundary back/Displacement" = ux; uy; uz' -- "Boundary back/Fixed=true"
invalid "Boundary bottom/Friction" '"Boundary bottom/Friction bound"' '"Boundary bottom/Friction coefficient"' -- "Boundary bottom/Friction=1"
invalid "Loading/Time" '"Loading/Steps"' -- "Loading/Time=1"
invalid "Displacement" "uses t" "set Loading/Steps or write a function of x, y and z" -- "Boundary right/Displacement=0.01*t; 0; 0"
invalid "Boundary foot/Where" "uses t" "write a function of x, y and z" -- "Boundary foot/On=top" "Boundary foot/Where=x - t"
# Entries that do nothing here.
for entry in "Coulomb solver=fixed point" "Coulomb solver=newton" "Check uniqueness=true" "QP solver=mprgp" "QP warm start=false" "QP tolerance=1e-10" \
  "QP maximum multiplications=10" "Diagonal scaling=false"; do
  invalid "Solver/${entry%%=*} = ${entry#*=}" "only the reduced path of the plane has it; remove it" -- "Solver/$entry"
done
invalid "Solver/Threads = 2" "mpirun -np N hpvi" "remove it" -- "Solver/Threads=2"
invalid "Boundary foot/Where" "inside a face" "grid line" -- "Boundary foot/On=top" "Boundary foot/Where=x^2 + z^2 - 0.5"
invalid "Material soft/Where" "inside a cell" -- "Material soft/Where=x^2 + y^2 + z^2 - 0.5"
invalid "Error/Bound = first" "true, false or last step" -- "Error/Bound=first"
invalid "Bound on distorted cells" "no guaranteed bound" "remove it" -- "Error/Bound on distorted cells=false"

# --- hexahedra from a file
foot() {
  local words
  words_of "$@"
  set -- "${rest[@]}"
  cp prm/foot.prm "$scratch/foot.prm"
  mkdir -p "$scratch/meshes"
  sed "$1" prm/meshes/foot.msh >"$scratch/meshes/foot.msh"
  shift
  check 1 "${words[@]}" -- "$hpvi" --validate "$scratch/foot.prm" "$@"
}
"$hpvi" --validate prm/foot.prm >/dev/null || failures=1
foot "foot.msh:" "is folded or flat at a corner" "less than 179.9 degrees" -- '/^1 -2 0 -2$/s/.*/1 0 1.5 0/'
foot "element 50: the mesh has pyramids (1)" "transfinite" -- 's/^50 5 2 4 1 .*/50 7 2 4 1 1 2 3 4 7/'
foot "is in no physical volume" -- 's/^50 5 2 4 1/50 5 2 0 9/'
foot "has a face of no cell" -- 's/^1 3 2 1 1 .*/1 3 2 1 1 1 2 3 4/'
foot "cells may not overlap" -- 's/^50 5 2 4 1 .*/50 5 2 4 1 1 2 7 6 16 17 22 21/'
foot "Boundary flank/Contact" "along no axis" "set unilateral" -- '' --set "Boundary flank/Pressure=" --set "Boundary flank/Contact=bilateral"
foot "the boundary of the body has no physical surface" 'Physical Surface("left") = {4};' -- '5s/.*/1/; 6,8d; 90s/.*/32/; /^[0-9]* 3 2 /d'
foot "Boundary side" "this scene has" -- '' --set "Boundary side/Pressure=1"
foot "Boundary bottom/Curve" "unknown entry" -- '' --set "Boundary bottom/Curve=circle"
foot "Subdivisions" "no meaning for a file" -- '' --set "Geometry/Subdivisions=2, 2, 2"
foot "Geometry/File" "names no mesh" -- '' --set "Geometry/File="
foot "foot.prm: Geometry/File: " "is a directory" "name a drawing or a mesh" -- '' --set "Geometry/File=meshes"

# --- methods, laws and paths that space does not have
for method in pu hpa1 hpa2 hpa3; do
  invalid "Method = $method" "space does not offer" "hap2" -- "Adaptivity/Method=$method"
done
invalid "Start degree = 1" "2 to 8" -- "Adaptivity/Start degree=1"
invalid "Linear = multigrid" "degrees 2 to 4" "amg" -- "Solver/Linear=multigrid" "Adaptivity/Start degree=5"
invalid "Friction coefficient" "stands beside Friction bound" -- "Boundary bottom/Friction coefficient=0.3"
invalid "Friction coefficient" "mu_f >= 0" -- "Boundary bottom/Friction bound=" "Boundary bottom/Friction coefficient=0.3 - z"
invalid "Friction coefficient" "pressure" -- "Boundary bottom/Friction bound=" "Boundary bottom/Friction coefficient=0.3" "Boundary bottom/Contact=tangential"
check 2 "has not converged" "problems of Tresca" "lower Friction coefficient" -- "$hpvi" --output "$scratch/o" prm/slab.prm --set "Boundary bottom/Friction bound=" \
  --set "Boundary bottom/Friction coefficient=50" --set "Boundary left/Traction=1.5*(5 - y); -7; 0.5" --set "Boundary bottom/Contact=unilateral" --set "Solver/Primal tolerance=1e-11"
invalid "Normal contact = nodes" "not offered by space" "multiplier" -- "Boundary bottom/Contact=unilateral" "Solver/Normal contact=nodes"
invalid "Path = reduced" "auto or primal" -- "Solver/Path=reduced"
invalid "Condition number" "does not form" -- "Solver/Condition number=true"
invalid "Reference solution" "asks for a history" -- "Loading/Steps=3" "Output/Reference solution=true"
invalid "Error/Reference solution = nowhere.dat" "cannot be read" -- "Error/Reference solution=nowhere.dat"
invalid "Exact solution/Solution" "slides along y = 0" -- "Exact solution/Solution=smooth" "Geometry/Lower corner=0, 1, 0"
invalid "Boundary bottom/Friction bound" "must be a positive constant" -- "Exact solution/Solution=smooth" "Boundary bottom/Friction bound=1 + z"
invalid "Boundary left/Traction" "contradicts Exact solution/Solution" "write exact" -- "Exact solution/Solution=smooth"
invalid "with t = 1 is not finite" "Displacement" -- "Loading/Steps=2" "Boundary right/Displacement=1/(t - 1); 0; 0"
check 1 "inf-sup" "the plane alone" -- "$hpvi" --inf-sup prm/slab.prm

# --- boundaries
invalid "rigid-body motion free, translation in x" "no friction resists" -- "Boundary right/Displacement=" "Boundary bottom/Friction bound="
invalid "rigid-body motion free, translation in z" -- "Boundary right/Displacement=0; free; free" "Boundary bottom/Friction bound="
invalid "rigid-body motion free, translation in y" -- "Boundary right/Displacement=0; free; 0" "Boundary bottom/Contact=tangential"
invalid "contradicts" "common point" -- "Boundary top/Displacement=1; free; free"
"$hpvi" --validate prm/slab.prm --set "Boundary top/Displacement=0.1*sin(pi); free; free" --set "Boundary right/Displacement=0; 0; 0" >/dev/null ||
  { echo "two supports that differ by round-off are refused"; failures=1; }
invalid "Traction" "that Displacement prescribes" -- "Boundary right/Traction=1; 0; 0"
invalid "needs contact" -- "Boundary top/Friction bound=1"
invalid "Gap" "at their common point" "u_n <= u_0" -- "Boundary bottom/Contact=unilateral" "Boundary bottom/Gap=-0.1"
invalid "Gap" "is not finite" -- "Boundary bottom/Contact=unilateral" "Boundary bottom/Gap=1/(x - 4)"

# --- what contact alone cannot hold
unheld() {
  overridden 2 "$hpvi" --output "$scratch/unheld" prm/block-space.prm -- "no equilibrium: " "$@"
}
unheld "sliding: the loads push the body along (1, 0, 0) with 2, contact can resist with 1.96 at most" "raise Friction coefficient" -- "Boundary bottom/Friction coefficient=0.49"
unheld "toppling: the loads turn the body about an axis along (0, 0, -1) through (2, 0, 1) with 2, contact can resist with 0 at most; add a support or change the loads" -- "Body force/Expression=3; -1; 0" "Boundary bottom/Friction coefficient=5"
unheld "lifting off: the loads push the body along (0, 1, 0) with 4, contact can resist with 0" "add a support" -- "Body force/Expression=0; 1; 0"

invalid "stands beside Contact" -- "Boundary bottom/Displacement=0; free; free"
invalid "Friction bound" "g >= 0" -- "Boundary bottom/Friction bound=1 - x"
invalid "million cells" -- "Geometry/Subdivisions=1000, 1000, 1000"
invalid "more than Adaptivity/Maximum unknowns" -- "Geometry/Subdivisions=90, 90, 90" "Adaptivity/Maximum unknowns=1000"

# --- more than there is is refused before it is asked for
limited() (
  ulimit -v 2500000
  exec "$@"
)
check 2 "4328691 unknowns needs 249 GB" "are left" "Maximum unknowns" -- limited "$hpvi" --output "$scratch/o" prm/slab.prm --set "Adaptivity/Start degree=8" --set "Geometry/Subdivisions=14, 14, 14" --set "Adaptivity/Maximum unknowns=100000000"

# --- the primal path in the plane
plane() {
  local words
  words_of "$@"
  set -- "${rest[@]}"
  check 1 "${words[@]}" -- "$hpvi" --output "$scratch/o" prm/"$1".prm --set Solver/Path=primal
}
plane "Method = hpa2" "the primal path does not offer" -- han-6-12
plane "primal" "does not offer" -- ssnv128
check 1 "free along (1 0)" "held by contact alone" "reduced path" -- "$hpvi" --output "$scratch/o" prm/semicoercive.prm --set Solver/Path=primal --set Adaptivity/Method=hap2
check 1 "Normal contact = nodes" "the primal path" "multiplier" -- "$hpvi" --output "$scratch/o" prm/han-6-12-unilateral.prm --set Solver/Path=primal --set Adaptivity/Method=hap2

# --- several processes
parallel() {
  timeout 60 "$mpirun" --oversubscribe --bind-to none "$@" # none waits for one that has failed
}
check 1 "fewer cells" "start fewer of them" -- parallel -np 2 "$hpvi" --output "$scratch/o" prm/slab.prm --set "Geometry/Subdivisions=1, 1, 1"
check 1 "Path = reduced" "start one" -- parallel -np 2 "$hpvi" --output "$scratch/o" prm/han-6-12.prm --set Solver/Path=reduced
check 1 "Normal contact = nodes" "the primal path" "multiplier" -- parallel -np 2 "$hpvi" --output "$scratch/o" prm/han-6-12-unilateral.prm --set Adaptivity/Method=hap2
check 1 "Method = hpa2" "does not offer" -- parallel -np 2 "$hpvi" --output "$scratch/o" prm/han-6-12.prm
check 1 "--sweep Boundary bottom/Friction bound" "start it as one process" -- parallel -np 2 "$hpvi" --output "$scratch/o" prm/slab.prm --sweep "Boundary bottom/Friction bound=1, 2"
check 1 "Yung" "unknown entry" -- parallel -np 2 "$hpvi" prm/slab.prm --set "Material/Yung=1"

# --- what the process of one point alone finds out, in whichever stage of a step it does
hidden() { # PROCESSES DEGREE ENTRY VALUE MORE...
  local processes=$1 degree=$2 entry=$3 value=$4
  shift 4
  check 1 "$entry" "is not finite" "give an expression that is finite" -- \
    parallel -np "$processes" "$hpvi" --output "$scratch/hidden" prm/slab.prm --set "Adaptivity/Method=hup$degree" \
    --set "Adaptivity/Maximum steps=2" --set Output/VTU=false --set "$entry=$value" "$@"
  grep -q '"status": "failed"' "$scratch/hidden/summary.json" || { echo "summary.json does not say failed: $entry"; failures=1; }
}
hidden 3 2 "Boundary bottom/Friction bound" "if((x-0.8873)^2 + (z-1.8873)^2 < 1e-6, 0/0, 0.1)"
hidden 2 2 "Boundary bottom/Gap" "if((x-0.8873)^2 + (z-1.8873)^2 < 1e-6, 0/0, 0.1)" --set "Boundary bottom/Contact=unilateral"
hidden 2 2 "Boundary left/Traction" "if((y-0.05635)^2 + (z-1.94365)^2 < 1e-6, 0/0, 1.5); 0; 0"
hidden 3 3 "Boundary right/Displacement" "if((y-0.2764)^2 + (z-1.2764)^2 < 1e-6, 0/0, 0); 0; 0"

# --- a load that cannot be summed is refused before anything is written
check 1 "Boundary left/Traction" "is not finite" -- "$hpvi" --output "$scratch/unwritten" prm/slab.prm \
  --set "Boundary left/Traction=if((y-0.1127)^2 + (z-1.8873)^2 < 1e-6, 0/0, 1.5); 0; 0"
[ ! -e "$scratch/unwritten" ] || { echo "results of a load that cannot be summed"; failures=1; }

exit $failures
