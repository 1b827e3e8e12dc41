#!/bin/bash
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# usage: run.sh HPVI [SERVER]
#
# A table of bad input, as rows.sh says.

base=base.prm
source "$(dirname "$0")/rows.sh"

# --- probes, which scenes name themselves
invalid "Probe a.b" "is no name" "letters" -- "Probe a.b/At=1, 1"
invalid "Probe" "unknown subsection" "Probe NAME" -- "Probe/At=1, 1"
invalid "Probe Tip" "differs from Probe tip in case" -- "Probe tip/At=1, 1" "Probe Tip/At=1, 1"
invalid "Probe tip/Where" "unknown entry" -- "Probe tip/Where=1, 1"
invalid "Probe tip/At" "is missing" "From and To" -- "Probe tip/Size=1"
invalid "Probe tip/At = 1" "give a point x, y" -- "Probe tip/At=1"
invalid "Probe tip/At = 1, 2, 3" "give a point x, y" -- "Probe tip/At=1, 2, 3"
invalid "Probe tip/At = 5, 1" "outside of the body" -- "Probe tip/At=5, 1"
invalid "Probe tip/At = nan, 1" "give a point" -- "Probe tip/At=nan, 1"
invalid "Probe tip/On = top" "stands beside At" -- "Probe tip/At=1, 1" "Probe tip/On=top"
invalid "Probe tip/To = 1, 2" "stands beside At" -- "Probe tip/At=1, 1" "Probe tip/To=1, 2"
invalid "Probe tip/From = 1, 2" "stands beside On" -- "Probe tip/On=top" "Probe tip/From=1, 2"
invalid "Probe tip/On = topp" "is no boundary" "left, right, bottom and top" -- "Probe tip/On=topp"
invalid "Probe tip/Size = 0" "positive number" -- "Probe tip/At=1, 1" "Probe tip/Size=0"
invalid "Probe tip/Size = -1" "positive number" -- "Probe tip/At=1, 1" "Probe tip/Size=-1"
invalid "Probe tip/Size = 1.1" "leaves the body" "is 1 away" -- "Probe tip/At=1, 2" "Probe tip/Size=1.1"
invalid "Probe tip/Size = 1" "give At" -- "Probe tip/On=top" "Probe tip/Size=1"
invalid "Probe tip/From = 1, 1" "has no To" -- "Probe tip/From=1, 1"
invalid "Probe tip/To = 1, 1" "has no From" -- "Probe tip/To=1, 1"
invalid "Probe tip/To = 1, 5" "outside of the body" -- "Probe tip/From=1, 1" "Probe tip/To=1, 5"
invalid "Probe tip/Points = 1" "from 2 to 100000" -- "Probe tip/From=1, 1" "Probe tip/To=1, 2" "Probe tip/Points=1"
invalid "Probe tip/Points = 3" "give From and To" -- "Probe tip/At=1, 1" "Probe tip/Points=3"
invalid "Probe energy/At = 1, 1" "column of convergence.csv" -- "Probe energy/At=1, 1"
invalid "Probe bound/On = top" "Adaptivity/Tolerance on" -- "Probe bound/On=top"
invalid "Probe seconds_qp/From = 1, 1" "column of convergence.csv" -- "Probe seconds_qp/From=1, 1" "Probe seconds_qp/To=1, 2"
invalid "Probe tip_ux/At = 1, 2" "column of Probe tip" -- "Probe tip/At=1, 1" "Probe tip_ux/At=1, 2"
invalid "Adaptivity/Tolerance on = tip" "neither an error" "residual, bound, error_estimate_equilibrated, normal_resultant and friction_resultant" -- "Adaptivity/Tolerance on=tip"
invalid "Adaptivity/Tolerance on = tip_s1" "tip, tip_ux and tip_uy" -- "Probe tip/At=1, 1" "Adaptivity/Tolerance on=tip_s1"
invalid "Adaptivity/Tolerance on = friction_resultant" "it has 2" -- "Boundary top/Contact=bilateral" "Adaptivity/Tolerance on=friction_resultant"
invalid "Adaptivity/Tolerance on = energy" "neither an error" -- "Adaptivity/Tolerance on=energy"
invalid "Error/Bound = last" "true, false or last step" -- "Error/Bound=last"
invalid "Adaptivity/Indicator = bound" "Error/Bound = last step" "set residual" -- "Error/Bound=last step" "Adaptivity/Indicator=bound"

# --- pretensions
invalid "Pretension" "unknown subsection" "Pretension NAME" -- "Pretension/Force=1"
invalid "Pretension a.b" "is no name" -- "Pretension a.b/Force=1"
invalid "Pretension Bolt" "differs from Pretension bolt in case" -- "Pretension bolt/Force=1" "Pretension Bolt/Force=1"
invalid "Pretension bolt/Preload" "unknown entry" -- "Pretension bolt/Preload=1"
invalid "Pretension bolt/Through" "is missing" "two ends" -- "Pretension bolt/Force=1"
invalid "Pretension bolt/Force" "is missing" "tension" -- "Pretension bolt/Through=3, 0; 3, 4"
bolt() { # THROUGH WORD...
  local through="$1"
  shift
  invalid "Pretension bolt/Through = $through" "$@" -- "Pretension bolt/Through=$through" "Pretension bolt/Force=2" \
    "Boundary left/Traction=" "Boundary bottom/Contact=none" "Boundary bottom/Friction bound="
}
bolt "1, 2" "two points x1, y1; x2, y2"
bolt "1, 2; 1, 2; 3, 4" "two points x1, y1; x2, y2"
bolt "1, 2, 3; 1, 2, 3" "two points x1, y1; x2, y2"
bolt "1, 2; 1, 2" "has no length"
bolt "1, 5; 3, 5" "crosses no body" "a body between"
bolt "0, 0; 4, 0" "runs along the boundary" "through the bolt"
bolt "0, 0; 4, 4" "through the inside of a cell" "parallel to a side"
bolt "3, 0; 3, 2" "ends inside of the body, at (3, 2)" "from boundary to boundary"
bolt "0, 1; 4, 1" "has Displacement of Boundary right beside it, at (4, 1.5)" "swap its points"
for force in 0 -3 nan x; do
  invalid "Pretension bolt/Force = $force" "a positive number" -- "Pretension bolt/Through=3, 0; 3, 4" "Pretension bolt/Force=$force"
done
side() { # WORD ENTRY=VALUE...: what may not stand beside a cut
  local word="$1"
  shift
  invalid "Pretension bolt/Through" "has $word of Boundary top beside it, at (2.5, 4)" "parallel to it where cells end" -- \
    "Pretension bolt/Through=3, 0; 3, 4" "Pretension bolt/Force=2" "Boundary bottom/Contact=none" "Boundary bottom/Friction bound=" "$@"
}
side "a load" "Boundary top/Pressure=1"
side "Spring" "Boundary top/Spring=1; 0"
side "Rigid" "Boundary top/Rigid=true" "Boundary top/Displacement=0; 0" "Boundary top/Rotation=0"
side "Displacement" "Boundary top/Displacement=0; free"
side "friction" "Boundary top/Contact=bilateral" "Boundary top/Friction bound=1"
invalid "Pretension stud/Through" "Pretension bolt" "swap its points" -- "Pretension bolt/Through=3, 0; 3, 4" "Pretension bolt/Force=2" \
  "Pretension stud/Through=2, 4; 2, 0" "Pretension stud/Force=2" "Boundary bottom/Contact=none" "Boundary bottom/Friction bound="
invalid "Pretension bolt/Through" "is not offered by the primal path" "reduced path" -- "Pretension bolt/Through=3, 0; 3, 4" "Pretension bolt/Force=2" \
  "Boundary bottom/Friction bound=" "Solver/Path=primal" "Adaptivity/Method=hup2"
invalid "Exact solution/Solution = stick-slip" "knows no Pretension" -- "Pretension bolt/Through=4, 3; 0, 3" "Pretension bolt/Force=2" \
  "Boundary left/Traction=" "Boundary right/Displacement=0; free" "Exact solution/Solution=stick-slip"
invalid "Pretension bolt/Through = 3, 0; 3, 4" "is not across the axis" "the same y" -- \
  "Pretension bolt/Through=3, 0; 3, 4" "Pretension bolt/Force=2" "Material/Plane=axisymmetric" "Boundary bottom/Contact=none"

# --- materials and parts of sides, which scenes name themselves
invalid "Material a.b" "is no name" "letters" -- "Material a.b/Where=x"
invalid "Material Soft" "differs from Material soft in case" -- "Material soft/Where=x" "Material Soft/Where=x"
invalid "Material soft/Where" "is missing" -- "Material soft/Density=1"
invalid "Material soft/Where = -1" "centre of no cell" -- "Material soft/Where=-1"
invalid "Material soft/Where" "inside a cell" "Subdivisions" -- "Material soft/Where=1.3 - (x-2)^2 - (y-2)^2"
invalid "Material soft/Where" "uses t" -- "Material soft/Where=x - t" "Loading/Steps=2"
invalid "Material soft/Where" "not an expression" "constants are pi" -- "Material soft/Where=E - x"
invalid "Material soft/Where" "has 2 component(s)" -- "Material soft/Where=x; y"
invalid "Material soft/Young's modulus = -3" "number E > 0" -- "Material soft/Where=x" "Material soft/Young's modulus=-3"
invalid "Material soft/Poisson's ratio = 0.5" "outside (-1, 1/2)" -- "Material soft/Where=x" "Material soft/Poisson's ratio=0.5"
invalid "Material soft/Plane = stress" "contradicts Material/Plane = strain" -- "Material/Plane=strain" "Material soft/Where=x" "Material soft/Plane=stress"
invalid "Material b/Thickness = 2" "contradicts Material a/Thickness = 3" -- "Material a/Where=x" "Material a/Thickness=3" "Material b/Where=y" "Material b/Thickness=2"
invalid "Material/Thickness = 0" "number > 0" -- "Material/Thickness=0"
invalid "Material/Thickness = -1" "number > 0" -- "Material/Thickness=-1"
invalid "Material/Density = -1" "number >= 0" -- "Material/Density=-1"
invalid "Body force/Gravity" "Material/Density" -- "Body force/Gravity=0; -9.81"
invalid "Body force/Gravity" "1 component(s)" -- "Body force/Gravity=-9.81" "Material/Density=1"
invalid "Boundary foot" "unknown subsection" "this scene has" -- "Boundary foot/Where=x"
invalid "Boundary foot/On = botom" "is no side" "left, right, bottom or top" -- "Boundary foot/On=botom"
invalid "Boundary foot/Where" "is missing" -- "Boundary foot/On=top"
invalid "Boundary foot/Where" "positive nowhere on top" -- "Boundary foot/On=top" "Boundary foot/Where=x - 100"
invalid "Boundary toe/Where" "overlaps Boundary foot/Where" -- "Boundary foot/On=top" "Boundary foot/Where=1" "Boundary toe/On=top" "Boundary toe/Where=1"
invalid "Boundary Top" "differs from Boundary top in case" -- "Boundary Top/On=top" "Boundary Top/Where=1"
invalid "Boundary foot/Where" "inside a face" "Subdivisions" -- "Boundary foot/On=top" "Boundary foot/Where=x - 0.3" "Geometry/Shape=quadrilateral" "Geometry/Upper corner=1, 1" "Geometry/Corners=0, 0; 4, 0; 4, 4; 0, 4"
invalid "Boundary foot/Displacement" "stands beside Contact = unilateral" -- "Boundary foot/On=top" "Boundary foot/Where=1" "Boundary foot/Contact=unilateral" "Boundary foot/Displacement=0; 0"
invalid "Boundary top/Pressure" "component y" -- "Boundary top/Traction=" "Boundary top/Displacement=free; 0" "Boundary top/Pressure=1"
invalid "Boundary top/Shear" "component x" -- "Boundary top/Traction=" "Boundary top/Displacement=0; free" "Boundary top/Shear=x+1"
invalid "Boundary top/Pressure" "not an expression" -- "Boundary top/Pressure=q"
invalid "Boundary top/Pressure" "materials along this boundary" -- "Boundary top/Pressure=E" "Material soft/Where=x - 2" "Material soft/Young's modulus=3"
invalid "Boundary bottom/Symmetry = true" "contradicts Boundary bottom/Contact" -- "Boundary bottom/Symmetry=true"
invalid "Boundary right/Symmetry = true" "contradicts Boundary right/Displacement" -- "Boundary right/Symmetry=true"
invalid "Boundary left/Symmetry = true" "contradicts Boundary left/Traction" -- "Boundary left/Symmetry=true"
invalid "Boundary left/Symmetry = true" "contradicts Boundary left/Spring" -- "Boundary left/Traction=" "Boundary left/Spring=1; 1" "Boundary left/Symmetry=true"
invalid "Boundary left/Symmetry = maybe" "true or false" -- "Boundary left/Symmetry=maybe"
invalid "Boundary bottom/Spring" "beside Contact = bilateral" -- "Boundary bottom/Spring=1; 1"
invalid "Boundary top/Spring" "is negative at" -- "Boundary top/Spring=1 - x; 0"
invalid "Boundary top/Spring" "1 component(s)" -- "Boundary top/Spring=1"
invalid "Boundary top/Spring" "uses t" -- "Boundary top/Spring=t; 0" "Loading/Steps=2"
refused "Boundary top/Spring" "the primal path" -- "$scenes/base.prm" --set "Boundary top/Spring=1; 0" --set "Solver/Path=primal" --set "Adaptivity/Method=hap2"
invalid "Boundary left/Rigid = true" "contradicts Boundary left/Traction" -- "Boundary left/Rigid=true"
invalid "Boundary bottom/Rigid = true" "contradicts Boundary bottom/Contact" -- "Boundary bottom/Rigid=true"
invalid "Boundary top/Rigid = true" "contradicts Boundary top/Spring" -- "Boundary top/Traction=" "Boundary top/Rigid=true" "Boundary top/Spring=1; 1"
invalid "Boundary top/Rigid = true" "contradicts Boundary top/Symmetry" -- "Boundary top/Traction=" "Boundary top/Rigid=true" "Boundary top/Symmetry=true"
invalid "Boundary top/Rigid = true" "contradicts Boundary top/Pressure" -- "Boundary top/Traction=" "Boundary top/Rigid=true" "Boundary top/Pressure=1"
invalid "Boundary top/Force = 1; 2" "set Rigid = true" "Traction" -- "Boundary top/Force=1; 2"
invalid "Boundary top/Moment = 1" "set Rigid = true" -- "Boundary top/Moment=1"
invalid "Boundary top/Rotation = 1" "set Rigid = true" -- "Boundary top/Rotation=1"
invalid "Boundary top/Force = x; 1" "uses x or y" -- "Boundary top/Traction=" "Boundary top/Rigid=true" "Boundary top/Force=x; 1"
invalid "Boundary top/Force = 1; 2" "contradicts Boundary top/Displacement" "in y" -- "Boundary top/Traction=" "Boundary top/Rigid=true" "Boundary top/Force=1; 2" "Boundary top/Displacement=free; 0"
invalid "Boundary top/Moment = 1" "contradicts Boundary top/Rotation" -- "Boundary top/Traction=" "Boundary top/Rigid=true" "Boundary top/Rotation=0" "Boundary top/Moment=1"
invalid "Boundary top/Force = 1" "1 component(s)" -- "Boundary top/Traction=" "Boundary top/Rigid=true" "Boundary top/Force=1"
invalid "Boundary top/Moment = 1e200" "1e100" -- "Boundary top/Traction=" "Boundary top/Rigid=true" "Boundary top/Moment=1e200"
invalid "Boundary top/Rigid = true" "free to move against Boundary right/Displacement" -- "Boundary top/Traction=" "Boundary top/Rigid=true"
invalid "Boundary top/Displacement" "contradicts Boundary right/Displacement" "by 1" -- "Boundary top/Traction=" "Boundary top/Rigid=true" "Boundary top/Displacement=1; 0" "Boundary top/Rotation=0"
invalid "Boundary left/Rigid = true" "free to move against Boundary top/Rigid" -- "Boundary top/Traction=" "Boundary right/Displacement=" "Boundary top/Rigid=true" "Boundary left/Traction=" "Boundary left/Rigid=true" "Boundary bottom/Contact=unilateral"
refused "Boundary top/Rigid = true" "the primal path" -- "$scenes/base.prm" --set "Boundary right/Displacement=" --set "Boundary top/Traction=" --set "Boundary top/Rigid=true" --set "Solver/Path=primal" --set "Adaptivity/Method=hap2"
invalid "Material/Initial strain = 0.1; 0" "2 component(s)" -- "Material/Initial strain=0.1; 0"
invalid "Material/Initial strain = 0; 0; 0; 0.1" "plane stress" "give e1; e2; e12" -- "Material/Initial strain=0; 0; 0; 0.1"
invalid "Material/Initial strain" "not an expression" -- "Material/Initial strain=q; 0; 0"
invalid "Material/Thermal expansion = hot" "a number" -- "Material/Thermal expansion=hot"
invalid "Temperature/Expression = 20" "give Material/Thermal expansion" -- "Temperature/Expression=20"
invalid "Temperature/Expression" "is not finite" -- "Material/Thermal expansion=1e-5" "Temperature/Expression=1/(x - 2)"
turned="Material/Plane=axisymmetric"
invalid "Material/Plane = axisymmetric" "x < 0" -- "$turned" "Boundary left/Traction=" "Geometry/Lower corner=-1, 0"
invalid "Boundary left/Traction = 1; 0" "axis" -- "$turned" "Boundary left/Traction=1; 0"
refused "Material/Plane = axisymmetric" "the primal path" -- "$scenes/base.prm" --set "$turned" --set "Boundary left/Traction=" --set "Solver/Path=primal" --set "Adaptivity/Method=hap2"
invalid "Boundary left/Symmetry = true" "axis" -- "$turned" "Boundary left/Traction=" "Boundary left/Symmetry=true"
invalid "Material/Thickness = 2" "full turn" -- "$turned" "Boundary left/Traction=" "Material/Thickness=2"
invalid "Boundary top/Moment = 1" "along the axis alone" -- "$turned" "Boundary left/Traction=" "Boundary top/Rigid=true" "Boundary top/Moment=1"
invalid "Boundary top/Force = 1; 1" "free in x" -- "$turned" "Boundary left/Traction=" "Boundary top/Rigid=true" "Boundary top/Force=1; 1"
invalid "Solver/Normal contact = nodes" "no weight" -- "$turned" "Boundary left/Traction=" "Boundary bottom/Contact=unilateral" "Solver/Normal contact=nodes"
invalid "Temperature/Expression = t" "the time of a load history" -- "Material/Thermal expansion=1e-5" "Temperature/Expression=t"
invalid "Exact solution/Solution" "no initial strain" -- "Exact solution/Solution=smooth" "Material/Initial strain=0.1; 0; 0"
refused "Initial strain" "the primal path" -- "$scenes/base.prm" --set "Material/Initial strain=0.1; 0; 0" --set "Solver/Path=primal" --set "Adaptivity/Method=hap2"
invalid "Boundary top/Spring" "the primal path" -- "Boundary top/Spring=1; 0" "Solver/Path=primal" "Adaptivity/Method=hap2"
invalid "Boundary left/On" "unknown entry" -- "Boundary left/On=top"
invalid "Boundary top/Contact direction = 0; 1" "needs contact" "or remove it" -- "Boundary top/Contact direction=0; 1"
invalid "Boundary bottom/Contact direction = 0; 0" "has no direction" "write a vector out of the body" -- "Boundary bottom/Contact direction=0; 0"
invalid "Boundary bottom/Contact direction = 1e-320 - 1e-320; 0" "has no direction" -- "Boundary bottom/Contact direction=1e-320 - 1e-320; 0"
invalid "Boundary bottom/Contact direction = 1; 2" "does not point out of the body at" "normal is (0, -1)" "d . n > 0" -- "Boundary bottom/Contact direction=1; 2"
invalid "Boundary bottom/Contact direction = 1; 0" "does not point out of the body at" -- "Boundary bottom/Contact direction=1; 0"
invalid "Boundary bottom/Contact direction = x; -1" "uses x, y or t" "write numbers" -- "Boundary bottom/Contact direction=x; -1"
invalid "Boundary bottom/Contact direction = t; -1" "uses x, y or t" -- "Boundary bottom/Contact direction=t; -1" "Loading/Steps=2"
invalid "Boundary bottom/Contact direction = 1" "1 component(s)" -- "Boundary bottom/Contact direction=1"
invalid "Boundary bottom/Contact direction = free; -1" "not an expression" -- "Boundary bottom/Contact direction=free; -1"
invalid "Boundary bottom/Contact direction = ; -1" "empty component" -- "Boundary bottom/Contact direction=; -1"
invalid "Boundary right/Displacement = 0.1; 0" "Contact = unilateral" "exceeds the gap by 0.06" -- "Boundary right/Displacement=0.1; 0" "Boundary bottom/Contact=unilateral" "Boundary bottom/Contact direction=3; -4"
invalid "Boundary right/Displacement = 0.1; 0" "contradicts Boundary bottom/Contact = bilateral" -- "Boundary right/Displacement=0.1; 0" "Boundary bottom/Contact direction=3; -4"
refused "Boundary bottom/Contact direction" "the primal path" "reduced" -- "$scenes/base.prm" --set "Boundary bottom/Contact direction=0; -1" --set "Solver/Path=primal" --set "Adaptivity/Method=hap2"

# --- each entry's wrong kinds
glued=("Boundary top/Traction=" "Boundary right/Displacement=" "Boundary top/Rigid=true")
invalid "Material/Density = heavy" "number >= 0" -- "Material/Density=heavy"
invalid "Material/Thickness = thick" "number > 0" -- "Material/Thickness=thick"
invalid "Material/Plane = round" "stress, strain or axisymmetric" -- "Material/Plane=round"
invalid "Body force/Gravity = g; 0" "not an expression" -- "Body force/Gravity=g; 0" "Material/Density=1"
invalid "Material/Thermal expansion = nan" "a number" -- "Material/Thermal expansion=nan"
invalid "Temperature/Expression = q" "not an expression" -- "Temperature/Expression=q" "Material/Thermal expansion=1"
invalid "Temperature/Expression = 1; 2" "2 component(s)" -- "Temperature/Expression=1; 2" "Material/Thermal expansion=1"
invalid "Material/Initial strain = 0; 0; 0; 0; 1" "5 component(s)" -- "Material/Initial strain=0; 0; 0; 0; 1"
invalid "Material/Initial strain" "is not finite" -- "Material/Initial strain=1/(x - 2); 0; 0"
invalid "Boundary top/Spring = a; 0" "not an expression" -- "Boundary top/Spring=a; 0"
invalid "Boundary top/Shear = 1; 2" "2 component(s)" -- "Boundary top/Shear=1; 2"
invalid "Boundary top/Rigid = maybe" "true or false" -- "Boundary top/Rigid=maybe"
invalid "Boundary top/Rotation = abc" "not an expression" -- "${glued[@]}" "Boundary top/Rotation=abc"
invalid "Boundary top/Moment = 1; 2" "2 component(s)" -- "${glued[@]}" "Boundary top/Moment=1; 2"
invalid "Boundary top/Moment = t" "the time of a load history" -- "${glued[@]}" "Boundary top/Moment=t"
invalid "Boundary top/Displacement = x; 0" "a rigid plate has one value" -- "${glued[@]}" "Boundary top/Displacement=x; 0"
invalid "Boundary foot/Symmetry = true" "contradicts Boundary foot/Displacement" -- "Boundary foot/On=top" "Boundary foot/Where=1" "Boundary foot/Symmetry=true" "Boundary foot/Displacement=0; free"

# --- orthotropic materials: base.prm names E and nu in Material
wood=("Material wood/Where=x - 2" "Material wood/Elasticity=orthotropic" "Material wood/Young's moduli=9, 1, 1"
  "Material wood/Poisson's ratios=0.3, 0.3, 0.4" "Material wood/Shear moduli=0.7")
invalid "Material/Elasticity = cubic" "isotropic or orthotropic" -- "Material/Elasticity=cubic"
invalid "Material/Young's modulus" "contradicts Elasticity = orthotropic" "remove it or set Material/Elasticity = isotropic" -- "Material/Elasticity=orthotropic"
invalid "Material wood/Young's modulus = 3" "contradicts Elasticity = orthotropic" -- "${wood[@]}" "Material wood/Young's modulus=3"
invalid "Material wood/Young's moduli" "contradicts Elasticity = isotropic" "Material wood/Elasticity = orthotropic" -- "${wood[@]}" "Material wood/Elasticity=isotropic"
for entry in "Young's moduli=1, 2" "Poisson's ratios=0.3" "Shear moduli=1" "Angle=0"; do
  invalid "Material/${entry%=*} = ${entry#*=}" "contradicts Elasticity = isotropic" -- "Material/$entry"
done
for lacking in "Young's moduli=9, 1:E3" "Young's moduli=:E1" "Poisson's ratios=0.3:nu13" "Poisson's ratios=0.3, 0.3:nu23" "Shear moduli=:G12"; do
  invalid "Material wood/${lacking%%=*}" "lacks ${lacking##*:}" "plane strain" "give" -- "${wood[@]}" "Material wood/${lacking%:*}" "Material/Plane=strain"
done
invalid "Material wood/Poisson's ratios = " "lacks nu12" "plane stress" -- "${wood[@]}" "Material wood/Poisson's ratios=" "Material/Plane=stress"
for wrong in "Young's moduli=9" "Young's moduli=9, 0, 1" "Young's moduli=9, nan, 1" "Young's moduli=1, 2, 3, 4" "Young's moduli=9 1" \
  "Poisson's ratios=inf" "Poisson's ratios=0.1; 0.2" "Shear moduli=0" "Shear moduli=1, 1, -1" "Angle=400" "Angle=30 degrees"; do
  invalid "Material wood/${wrong%=*}" "not accepted" "give" -- "${wood[@]}" "Material wood/$wrong"
done
invalid "Material wood/Poisson's ratios" "nu12^2 = 16" "E1/E2 = 9" -- "${wood[@]}" "Material wood/Poisson's ratios=4, 0.3, 0.4"
invalid "Material wood/Poisson's ratios" "nu23^2" "E2/E3" -- "${wood[@]}" "Material wood/Poisson's ratios=0.3, 0.3, 1.1" "Material/Plane=strain"
invalid "Material wood/Poisson's ratios" "not positive definite" -- "${wood[@]}" "Material wood/Poisson's ratios=2, 2, 0.8" "Material/Plane=strain"
invalid "Boundary right/Traction" "Material wood is orthotropic" "no E, nu and mu" -- "${wood[@]}" "Boundary right/Traction=E; 0" "Boundary right/Displacement="
invalid "Boundary top/Pressure" "Material wood is orthotropic" -- "${wood[@]}" "Boundary top/Pressure=mu"
invalid "Body force/Expression" "Material wood is orthotropic" -- "${wood[@]}" "Body force/Expression=nu; 0"
invalid "Material wood/Elasticity = orthotropic" "not offered with Plane = axisymmetric" -- "${wood[@]}" "$turned" "Boundary left/Traction="
invalid "Boundary top/Rotation = 1" "along the axis alone" -- "$turned" "Boundary left/Traction=" "Boundary top/Rigid=true" "Boundary top/Rotation=1"
invalid "Exact solution/Solution = smooth" "plane body" -- "$turned" "Boundary left/Traction=" "Exact solution/Solution=smooth"
broken isotropic_beside_orthotropic.prm "Material soft/Young's modulus" "an isotropic material needs it" "E > 0"
broken exact_orthotropic.prm ":3:" "Material/Elasticity = orthotropic" "contradicts Exact solution/Solution = smooth"
refused "Material wood/Elasticity = orthotropic" "the primal path" -- "$scenes/base.prm" --set "${wood[0]}" --set "${wood[1]}" --set "${wood[2]}" --set "${wood[3]}" --set "${wood[4]}" --set "Solver/Path=primal" --set "Adaptivity/Method=hap2"
invalid "Exact solution/Solution" "knows one material" -- "Exact solution/Solution=smooth" "Material soft/Where=x - 2"

# --- names: the nearest known one is named, from the file with the line
broken unknown_entry.prm ":3:" "Material/Poisson ratio = 0.4" "unknown entry" "Material/Poisson's ratio"
broken unknown_subsection.prm ":2:" "Boundary botom" "unknown subsection" "Boundary bottom"
invalid "Material/Yungs modulus = 3" "unknown entry" "Material/Young's modulus" -- "Material/Yungs modulus=3"
invalid "Adaptivity/Plane = stress" "unknown entry" "Material/Plane" -- "Adaptivity/Plane=stress"
invalid "Method = pu" "unknown entry" "Adaptivity/Method" -- "Method=pu"
invalid "Materail" "unknown subsection" '"Material"' -- "Materail/Plane=stress"
invalid "Boundary front" "unknown subsection" '"Dimension"' -- "Boundary front/Traction=1; 0"

# --- what is far from every name is answered by what people mean by it, or by all there is
unknown() { # ENTRY WORD...
  local entry="$1"
  shift
  invalid "unknown" "$@" -- "$entry=1"
}
unknown Material/rho '"Material/Density"' '"Body force/Gravity"'
unknown Material/E "\"Material/Young's modulus\""
unknown Material/nu "\"Material/Poisson's ratio\""
unknown "Boundary bottom/mu" '"Boundary bottom/Friction coefficient"' "Poisson's ratio"
unknown "Boundary bottom/Friction" '"Boundary bottom/Friction bound"'
unknown "Boundary bottom/Coefficient" '"Boundary bottom/Friction coefficient"'
unknown "Boundary top/Forces" '"Boundary top/Traction"'
unknown "Boundary top/PRESSURE" '"Boundary top/Pressure"'
unknown "Boundary left/Fixed" '"Boundary left/Displacement"'
unknown 3D '"Dimension"'
unknown Geometry/Thickness '"Material/Thickness"'
unknown Mesh/Size "unknown subsection" '"Geometry/Subdivisions"'
unknown Constants/a "unknown subsection" "pi, E, nu and mu"
unknown Gravity/g "unknown subsection" '"Body force/Gravity"'
unknown Adaptivity/Steps '"Adaptivity/Maximum steps"' '"Loading/Steps"'
unknown Contact/Gap "unknown subsection" "this is an entry" '"Boundary bottom/Contact"'
unknown Material "this is a subsection, which has Young's modulus, Poisson's ratio, Density, Initial strain, Thermal expansion, Plane, Thickness, Elasticity"
unknown Material/Axes '"Material/Angle"'
unknown Material/E1 '"Material/Elasticity" = orthotropic'
unknown "Material/Fibre angle" '"Material/Angle"'
unknown Traction '"Boundary left/Traction", "Boundary right/Traction", "Boundary bottom/Traction" or "Boundary top/Traction"'
unknown Units/Time "Loading/Steps"
unknown Units/Mass "unknown entry; Units has Length and Stress"
unknown "Boundary low/Traction" "unknown subsection; this scene has: left, right, bottom and top"
unknown "Boundary 1/Traction" "unknown subsection; this scene has: left, right, bottom and top"
unknown "Part of steel/Traction" "unknown subsection; there are Units, Geometry," "Boundary top, Loading"
unknown Colour "Title and Dimension stand outside of subsections" "Solver, Output or Error"
unknown Boundary_top/Traction 'the nearest known one is "Boundary top"'
invalid "names no entry" "Section/Entry=value" -- "Units/=mm"

# --- the syntax of the file
broken missing_end.prm ":5:" "subsection Boundary right" "inside subsection Material" '"end"'
broken missing_last_end.prm ":2:" "subsection Boundary right" "never closed" '"end"'
broken stray_end.prm ":3:" "no subsection is open" "remove"
broken missing_set.prm ":3:" "Plane = stress" "not a statement" '"set Entry = value"'
broken missing_equals.prm ":3:" "set Plane stress" "not a statement" '"set Entry = value"'
broken include.prm ":2:" "include base.prm" "not supported" "into one file"
refused "no_such_scene.prm" "cannot be read" "check the name" -- no_such_scene.prm
refused "is a directory" "name a scene file" -- "$scenes"
ln -s loop "$scratch/loop"
refused "loop: cannot be read" "check the name" -- "$scratch/loop"
refused "/dev/zero: is larger than a megabyte" "name a scene file" -- /dev/zero
refused "a b?.prm: cannot be read" -- $'a\nb\x1b.prm'
refused "no?.prm: cannot be read" -- $'no\xe9.prm'

# --- what nobody sees
printf '\xff\xfes\0e\0t\0' >"$scratch/little.prm"
printf '\0s\0e\0t' >"$scratch/big.prm"
printf 'set Dimension = 2\nset\xc2\xa0Title = x\n' >"$scratch/blank.prm"
for file in little big; do
  refused "$file.prm: is written in UTF-16" "save it as UTF-8" -- "$scratch/$file.prm"
done
refused "blank.prm:2: " "not a statement" "no-break space (U+00A0): write a blank" -- "$scratch/blank.prm"
invalid "not an expression" "minus sign (U+2212): write -" -- $'Boundary left/Traction=\xe2\x88\x921 + x; 0'
invalid "not accepted" "minus sign (U+2212): write -" -- $'Geometry/Lower corner=\xe2\x88\x921, 0'
invalid "unknown entry" "quotation mark (U+2019): write '" -- $'Material/Young\xe2\x80\x99s modulus=3'

# --- numbers
broken negative_young.prm ":3:" "Material/Young's modulus = -15" "E > 0"
for value in 0 -1 nan inf 1e400 "" "1 2" fifteen; do
  invalid "Material/Young's modulus = $value" "not accepted" "E > 0" -- "Material/Young's modulus=$value"
done
for value in 5e-324 1e-101 1e101 1e300; do
  invalid "Material/Young's modulus = $value" "not accepted" "from 1e-100 to 1e100" -- "Material/Young's modulus=$value"
done
for value in 0.5 -1 7; do
  invalid "Material/Poisson's ratio = $value" "outside (-1, 1/2)" "-1 < nu < 1/2" -- "Material/Poisson's ratio=$value"
done
invalid "Material/Poisson's ratio = nan" "-1 < nu < 1/2" -- "Material/Poisson's ratio=nan"
invalid "Dimension = 1" "give 2 or 3" -- "Dimension=1"
invalid "Title = a # b" "remove '#'" -- "Title=a # b"

# --- geometry
invalid "Geometry/Shape = triangle" "give box, quadrilateral, ring sector, half disc, plate with hole or file" -- "Geometry/Shape=triangle"
invalid "Geometry/Upper corner = 0, 4" "lower corner (0, 0)" "enlarge" -- "Geometry/Upper corner=0, 4"
invalid "Geometry/Upper corner = nan, 4" "two finite numbers" -- "Geometry/Upper corner=nan, 4"
invalid "Geometry/Upper corner = 4" "two finite numbers" -- "Geometry/Upper corner=4"
invalid "Geometry/Subdivisions = 0, 4" "two positive integers" -- "Geometry/Subdivisions=0, 4"
invalid "Geometry/Subdivisions = 2.5, 4" "two positive integers" -- "Geometry/Subdivisions=2.5, 4"
invalid "Geometry/Subdivisions = 9999, 9999" "a million cells" "start coarse" -- "Geometry/Subdivisions=9999, 9999"
invalid "Geometry/Subdivisions = 300, 300" "makes at least 1620899 free unknowns of degree 3" "Maximum unknowns = 1000000" \
  "start coarser" -- "Geometry/Subdivisions=300, 300"
invalid "Geometry/Graded towards = 5, 0" "(5, 0) outside the body" "points of the body" -- \
  "Geometry/Graded towards=5, 0" "Geometry/Grading levels=2"
invalid "Geometry/Grading levels = 2" "no point" "Graded towards" -- "Geometry/Grading levels=2"
invalid "Geometry/Corners" "has no meaning for a box" "Shape = quadrilateral" -- "Geometry/Corners=0,0; 4,0; 4,4; 0,4"
invalid "Geometry/Corners = " "four corners" "counterclockwise" -- "Geometry/Shape=quadrilateral" "Geometry/Upper corner=1, 1"
not_convex() {
  invalid "Geometry/Corners = $1" "not convex at $2" "counterclockwise" -- "Geometry/Shape=quadrilateral" "Geometry/Upper corner=1, 1" "Geometry/Corners=$1"
}
not_convex "0,0; 4,0; 1,1; 0,4" "(1, 1)"
not_convex "0,0; 4,0; 4,0; 0,4" "(4, 0)"
not_convex "0,0; 4,0; 8,0; 0,4" "(4, 0)"
not_convex "0,0; 0,4; 4,4; 4,0" "(0, 0)"
not_convex "0,0; 4,4; 4,0; 0,4" "(4, 4)"

has_angle() {
  invalid "Geometry/Corners = $1" "an angle of $2" "between 0.1 and 179.9" -- "Geometry/Shape=quadrilateral" "Geometry/Upper corner=1, 1" "Geometry/Corners=$1"
}
has_angle "0,0; 4,0; 8,0.0066; 4,0.0066" "0.094538 degrees at (0, 0)"
has_angle "0,0; 4,0; 4,4; 1.9999,2.0001" "179.994 degrees at (1.9999, 2.0001)"
invalid "lengths from 4e-200 to 4e-200" "choose another unit" -- "Geometry/Upper corner=4e-200, 4e-200"
invalid "lengths from 4 to 1e+200" "choose another unit" -- "Geometry/Upper corner=1e200, 4"
invalid "an edge of length 4 and coordinates up to 1e+14" "towards the origin" -- \
  "Geometry/Lower corner=1e14, 0" "Geometry/Upper corner=100000000000004, 4"

# --- expressions
invalid "Boundary left/Traction = sin(x; 0" '"sin(x"' "Missing parenthesis" "constants are" -- "Boundary left/Traction=sin(x; 0"
invalid "Boundary left/Traction = 2*q; 0" 'Unexpected token "q' "constants are" -- "Boundary left/Traction=2*q; 0"
invalid "Boundary left/Traction = 1+; 0" "Unexpected end" -- "Boundary left/Traction=1+; 0"
invalid "Boundary left/Traction = 1" "1 component(s) instead of 2" "';'" -- "Boundary left/Traction=1"
invalid "Boundary left/Traction = 1, 0" "1 component(s) instead of 2" "';'" -- "Boundary left/Traction=1, 0"
invalid "Boundary left/Traction = ; 1" "empty component" "write 0" -- "Boundary left/Traction=; 1"
invalid "Boundary left/Traction = 1,5; 0" "comma" "'.'" -- "Boundary left/Traction=1,5; 0"
invalid "(0.4 < y < 0.6) ? -1 : 0" "write y > 0.4 && y < 0.6" -- "Boundary left/Traction=(0.4 < y < 0.6) ? -1 : 0; 0"
invalid "write y >= 0.4 && y <= 0.6" -- "Boundary left/Traction=-(0.4<=y<=0.6); 0"
invalid "write y < 3 && y > x && x != 2" -- "Boundary left/Traction=if(3>y>x != 2, 1, 0); 0"
invalid "write (x + y) > sin(x) && (x + y) == 3" -- "Boundary left/Traction=0; y < 1 || sin(x) < (x + y) == 3 ? 1 : 2"
invalid "write 2 != 1 && 2 < y" -- "Boundary left/Traction=0; 3*(x < 1 ? 4 : (1 != 2 < y))"
invalid "Friction bound" "write x > 1 && x < 2" -- "Boundary bottom/Friction bound=1 < x < 2"
invalid "Boundary left/Traction = y=3; 0" "assigns" "==" -- "Boundary left/Traction=y=3; 0"
invalid "Boundary left/Traction = 1/y; 0" "not finite at (0, 0)" "finite everywhere" -- "Boundary left/Traction=1/y; 0"
invalid "Boundary left/Traction = 0; log(y-4)" "not finite at (0, 0)" -- "Boundary left/Traction=0; log(y-4)"
invalid "Boundary left/Traction = nan; 0" '"nan"' -- "Boundary left/Traction=nan; 0"
invalid "Boundary left/Traction = 1e400; 0" '"1e400"' -- "Boundary left/Traction=1e400; 0"
invalid "Boundary right/Displacement = 0; sqrt(2-y)" "not finite at (4, 2" -- "Boundary right/Displacement=0; sqrt(2-y)"
for value in "1e200*x; 0" "0; 1e101" "1e-200; 0" "5e-324; 1"; do
  invalid "Boundary left/Traction = $value" "of magnitude" "choose other units" -- "Boundary left/Traction=$value" \
    "Geometry/Lower corner=-1, 0"
  invalid "Body force/Expression = $value" "of magnitude" "choose other units" -- "Body force/Expression=$value"
done
invalid "Boundary right/Displacement = 1e200; 0" "of magnitude 1e+200" -- "Boundary right/Displacement=1e200; 0"
for value in "rand()" "x*rand()" "rand_seed(1)"; do
  invalid "Boundary left/Traction = $value; 0" "is random" "function of x and y" -- "Boundary left/Traction=$value; 0"
done
invalid "Body force/Expression = 0; 1/(x-2)" "not finite at (2, 0)" -- "Body force/Expression=0; 1/(x-2)"
invalid "Boundary bottom/Friction bound = sin(x" "Missing parenthesis" -- "Boundary bottom/Friction bound=sin(x"
invalid "Boundary bottom/Friction bound = 4.5; 1" "2 component(s) instead of 1" -- "Boundary bottom/Friction bound=4.5; 1"

# --- contact and supports
invalid "Boundary bottom/Friction bound = -1" "negative at (0, 0)" "g >= 0" -- "Boundary bottom/Friction bound=-1"
invalid "Boundary bottom/Friction bound = 1-x" "negative at (" "g >= 0" -- "Boundary bottom/Friction bound=1-x"
invalid "Boundary bottom/Friction bound = nan" '"nan"' -- "Boundary bottom/Friction bound=nan"
invalid "Boundary bottom/Friction bound = sqrt(x-1)" "not finite" -- "Boundary bottom/Friction bound=sqrt(x-1)"
invalid "Boundary bottom/Contact = glue" "none, bilateral, unilateral or tangential" -- \
  "Boundary bottom/Contact=glue"
invalid "Boundary top/Friction bound = 1" "needs contact" "Contact = bilateral" -- "Boundary top/Friction bound=1"
invalid "Boundary bottom/Displacement = 0; 0" "Contact = bilateral" "only one" -- "Boundary bottom/Displacement=0; 0"
invalid "Boundary right/Traction = 1; 0" "component x" "free" -- "Boundary right/Traction=1; 0"
invalid "Boundary right/Displacement = 0; 0.1" "Boundary bottom/Contact = bilateral" "corner (4, 0) by 0.1" "agree" -- \
  "Boundary right/Displacement=0; 0.1"
invalid "Boundary right/Displacement = 0; 0" "Boundary top/Displacement = free; 1" "corner (4, 4) by 1" "agree" -- \
  "Boundary top/Displacement=free; 1"
broken no_support.prm "Boundary" "Displacement" "rigid-body motion" "translation in x" "prescribe"
invalid "rigid-body motion" "translation in x" "no friction resists" -- "Boundary right/Displacement=" "Boundary bottom/Friction bound="
unheld=("Boundary right/Displacement=" "Boundary bottom/Friction bound=")
invalid "rigid-body motion" "translation in x" -- "${unheld[@]}" "Boundary right/Spring=max(0, y - 50); 0"
invalid "rigid-body motion" "translation in x" -- "${unheld[@]}" "Boundary right/Spring=0; 3"
invalid "rigid-body motion" "translation in x" -- "${unheld[@]}" "Boundary top/Spring=3; 0"
frictionless=("Boundary bottom/Contact=none" "Boundary bottom/Friction bound=")
invalid "rigid-body motion" "translation in y" "prescribe" -- "${frictionless[@]}" "Boundary right/Displacement=0; free"
invalid "rigid-body motion" "rotation about (4, 0)" "prescribe" -- "${frictionless[@]}" \
  "Boundary right/Displacement=free; 0" "Boundary bottom/Displacement=0; free"
invalid "rigid-body motion" "translation along (1, 1)" -- "Boundary right/Displacement=" "Boundary bottom/Friction bound=" \
  "Geometry/Shape=quadrilateral" "Geometry/Upper corner=1, 1" "Geometry/Corners=0,0; 4,4; 0,8; -4,4"

# --- contact that opens, friction alone
open=("Boundary bottom/Contact=unilateral")
invalid "Boundary bottom/Gap = 0.1" "needs contact that can open" "Contact = unilateral" -- "Boundary bottom/Gap=0.1"
invalid "Boundary bottom/Gap = 0" "needs contact that can open" "Contact = unilateral" -- "Boundary bottom/Gap=0"
invalid "Boundary top/Gap = 0.1" "needs contact that can open" "remove it" -- "Boundary top/Gap=0.1"
invalid "Boundary bottom/Gap = 0.1" "needs contact that can open" -- "Boundary bottom/Gap=0.1" "Boundary bottom/Contact=tangential"
invalid "Boundary bottom/Gap = 1/x" "not finite at (0, 0)" "finite everywhere" -- "${open[@]}" "Boundary bottom/Gap=1/x"
invalid "Boundary bottom/Gap = nan" '"nan"' -- "${open[@]}" "Boundary bottom/Gap=nan"
invalid "Boundary bottom/Gap = 0.1; 0" "2 component(s) instead of 1" -- "${open[@]}" "Boundary bottom/Gap=0.1; 0"
invalid "Boundary bottom/Gap = rand()" "is random" -- "${open[@]}" "Boundary bottom/Gap=rand()"
for value in 1e101 -1e200 1e-200; do
  invalid "Boundary bottom/Gap = $value" "of magnitude" "choose other units" -- "${open[@]}" "Boundary bottom/Gap=$value"
done
invalid "Boundary bottom/Displacement = free; 0" "Contact = unilateral" "only one" -- "${open[@]}" "Boundary bottom/Displacement=free; 0"
invalid "Boundary bottom/Displacement = free; 0" "Contact = tangential" "only one" -- \
  "Boundary bottom/Contact=tangential" "Boundary bottom/Displacement=free; 0"
invalid "Boundary right/Displacement = 0; 0" "Boundary bottom/Gap = 0.5 - x/5" "corner (4, 0)" "exceeds the gap by 0.3" "u_n <= u_0" -- \
  "${open[@]}" "Boundary bottom/Gap=0.5 - x/5"
invalid "Boundary right/Displacement = 0; -0.1" "Boundary bottom/Contact = unilateral" "corner (4, 0)" "by 0.1" "u_n <= u_0" -- \
  "${open[@]}" "Boundary right/Displacement=0; -0.1"
for bound in "" 0 "0*x"; do
  invalid "Boundary bottom/Contact = tangential" "friction nowhere to act" "Contact = none" -- \
    "Boundary bottom/Contact=tangential" "Boundary bottom/Friction bound=$bound"
done
invalid "Boundary top/Contact = tangential" "friction nowhere to act" "Friction bound > 0" -- "Boundary top/Contact=tangential"
coulomb=("${open[@]}" "Boundary bottom/Friction bound=")
invalid "Boundary bottom/Friction coefficient" "negative" "Coulomb's coefficient needs mu_f >= 0" -- \
  "${coulomb[@]}" "Boundary bottom/Friction coefficient=0.1-x"
invalid "Boundary bottom/Friction coefficient" "not finite" -- \
  "${coulomb[@]}" "Boundary bottom/Friction coefficient=1/(x-1)"
by_pressure() { # PART... -- COEFFICIENT ENTRY=VALUE...: what is said of a coefficient that uses p
  local parts=()
  while [ "$1" != -- ]; do
    parts+=("$1")
    shift
  done
  invalid "Boundary bottom/Friction coefficient" "${parts[@]}" -- "${coulomb[@]}" "Boundary bottom/Friction coefficient=$2" "${@:3}"
}
by_pressure "not an expression of x, y and p" -- "0.5/(1 + q)"
by_pressure "not an expression of x, y, p and t" -- "0.5/(1 + p*q)" "Loading/Steps=2"
by_pressure "uses t" -- "0.5/(1 + p*t)"
by_pressure "is not finite under p = 0 at (0, 0)" "max(p, ...)" -- "0.3/p"
by_pressure "negative" "needs mu_f >= 0" -- "p - 0.1"
by_pressure "bend upwards from p = " "concave" -- "0.1 + 0.1*p"
by_pressure "bend upwards" "concave" -- "0.1 + 0.1*sqrt(p)"
by_pressure "fall from" " at (0, 0)" "with if(p < " -- "0.5 - 0.1*p" "Boundary left/Traction=0; -20"
by_pressure "fall from" "(load step 2, t = 1)" -- "0.5 - 0.01*p" "Loading/Steps=2" "Boundary left/Traction=0; -if(t < 0.7, 1, 100)"
invalid "Boundary bottom/Gap" "uses p" "Friction coefficient alone" -- "${open[@]}" "Boundary bottom/Gap=p"
invalid "Boundary bottom/Friction bound" "uses p" -- "Boundary bottom/Friction bound=1 + p"
both=("${open[@]}" "Boundary bottom/Friction bound=1" "Boundary bottom/Friction coefficient=0.3")
invalid "Boundary bottom/Friction coefficient" "beside Friction bound" "keep" "Friction law = limited or cohesive" -- "${both[@]}"
for law in limited cohesive; do
  invalid "Boundary bottom/Friction law = $law" "give both Friction bound and Friction coefficient" -- \
    "${both[@]}" "Boundary bottom/Friction coefficient=" "Boundary bottom/Friction law=$law"
  invalid "Boundary bottom/Friction law = $law" "give both Friction bound and Friction coefficient" -- \
    "${coulomb[@]}" "Boundary bottom/Friction coefficient=0.3" "Boundary bottom/Friction law=$law"
  invalid "Boundary top/Friction law = $law" "give both" "remove it" -- "Boundary top/Friction law=$law"
  invalid "Boundary bottom/Friction coefficient" "negative" "needs mu_f >= 0" -- \
    "${both[@]}" "Boundary bottom/Friction coefficient=0.1-x" "Boundary bottom/Friction law=$law"
  invalid "Boundary bottom/Friction coefficient" "needs a pressure" "tangential" -- \
    "${both[@]}" "Boundary bottom/Contact=tangential" "Boundary bottom/Friction law=$law"
  invalid "Solver/Normal contact = nodes" "set multiplier" -- \
    "${both[@]}" "Boundary bottom/Friction law=$law" "Solver/Normal contact=nodes"
done
invalid "Boundary bottom/Friction law = coulomb" "automatic, limited or cohesive" -- "${both[@]}" "Boundary bottom/Friction law=coulomb"
invalid "Boundary top/Friction coefficient" "needs contact" -- "Boundary top/Friction coefficient=0.3"
invalid "Boundary bottom/Friction coefficient" "needs a pressure" "tangential" -- \
  "Boundary bottom/Contact=tangential" "Boundary bottom/Friction bound=" "Boundary bottom/Friction coefficient=0.3"
invalid "Solver/Coulomb solver = anderson" "newton or fixed point" -- "Solver/Coulomb solver=anderson"
invalid "Solver/Normal contact = nodes" "Boundary bottom" "Friction coefficient" "set multiplier" -- "${open[@]}" \
  "Boundary bottom/Friction bound=" "Boundary bottom/Friction coefficient=0.3" "Solver/Normal contact=nodes"
invalid "Solver/Normal contact = penalty" "automatic, nodes or multiplier" -- "Solver/Normal contact=penalty"
invalid "Start degree = 1" "contact" "at least 2" -- "${open[@]}" "Boundary bottom/Friction bound=" \
  "Solver/Normal contact=multiplier" "Adaptivity/Start degree=1"
invalid "Start degree = 1" "contact" "at least 2" -- "${open[@]}" "Adaptivity/Start degree=1"
invalid "Multiplier degree offset = 0" "makes S singular" -- "${open[@]}" "Boundary bottom/Friction bound=" \
  "Solver/Normal contact=multiplier" "Solver/Multiplier degree offset=0"

# --- the exact solution: named, on y = 0, with a constant bound, and not contradicted
invalid "Boundary right/Displacement = exact" "the scene has none" "Exact solution/Solution" -- "Boundary right/Displacement=exact"
invalid "Boundary left/Traction = 0; exact" "the scene has none" -- "Boundary left/Traction=0; exact"
invalid "Boundary bottom/Friction bound = exact" "not an expression" -- "Boundary bottom/Friction bound=exact"
invalid "Boundary right/Displacement = exact; 0; 0" "3 component(s) instead of 2" -- "Boundary right/Displacement=exact; 0; 0"
exact=("Exact solution/Solution=stick-slip" "Exact solution/Transition=2" "Boundary left/Traction=exact"
  "Boundary top/Traction=exact" "Boundary right/Displacement=exact")
invalid "Boundary bottom/Contact direction = 0; -1" "Exact solution/Solution = stick-slip" "along the normal" -- \
  "${exact[@]}" "Boundary bottom/Contact direction=0; -1"
invalid "Exact solution/Solution = boussinesq" "none, stick-slip, smooth, hertz or partial-slip" -- \
  "Exact solution/Solution=boussinesq"
invalid "Exact solution/Pressure = 0" "positive number" -- "Exact solution/Pressure=0"
invalid "Exact solution/Stick length = -1" "positive number" -- "Exact solution/Stick length=-1"
invalid "Boundary bottom/Contact = bilateral" "Solution = hertz" "Contact = unilateral" -- "Exact solution/Solution=hertz"
invalid "Boundary bottom/Contact = unilateral" "Solution = partial-slip" "Contact = tangential" -- \
  "${open[@]}" "Exact solution/Solution=partial-slip"
invalid "Exact solution/Stick length = 1" "Length = 1" "give less" -- "Boundary bottom/Contact=tangential" \
  "Exact solution/Solution=partial-slip" "Exact solution/Stick length=1"
hertz=("Exact solution/Solution=hertz" "Exact solution/Transition=2" "${open[@]}" "Boundary bottom/Friction bound="
  "Boundary left/Traction=" "Boundary left/Displacement=exact" "Boundary top/Displacement=exact" "Boundary right/Displacement=exact")
for gap in "if(x<1|x>3, 1, 0)" "0.04*(x-2)^2" "0.01 + (x-2)^2"; do
  invalid "Boundary bottom/Gap = $gap" "contradicts Exact solution/Solution = hertz" "give that of the solution" -- \
    "${hertz[@]}" "Boundary bottom/Gap=$gap"
done
invalid "Boundary left/Displacement = exact" "Boundary bottom/Contact = unilateral" "exceeds the gap by" -- "${hertz[@]}"
invalid "Boundary bottom/Friction bound = 1" "contradicts Exact solution/Solution = hertz" "without friction" -- \
  "${hertz[@]}" "Boundary bottom/Gap=(x-2)^2/E" "Boundary bottom/Friction bound=1"
partial_slip=("Exact solution/Solution=partial-slip" "Exact solution/Transition=2" "Boundary bottom/Contact=tangential"
  "Boundary left/Traction=" "Boundary left/Displacement=exact" "Boundary top/Displacement=exact" "Boundary right/Displacement=exact")
invalid "Boundary bottom/Friction bound = 4.5" "contradicts Exact solution/Solution = partial-slip" "give that of the solution" -- \
  "${partial_slip[@]}"
invalid "Exact solution/Transition = nan" "give a number" -- "Exact solution/Transition=nan"
invalid "Exact solution/Length = 0" "positive number" -- "Exact solution/Length=0"
invalid "Exact solution/Length = 0.4" "|lambda| = 1.0" "> 1 at (3.6" "enlarge" -- "${exact[@]}" "Exact solution/Length=0.4"
invalid "Boundary top/Traction = exact" "of magnitude 9.07185e+274" -- "${exact[@]}" \
  "Exact solution/Solution=smooth" "Exact solution/Transition=0" "Exact solution/Length=1e-3"
invalid "Exact solution/Length = 0.5" "against its friction" "enlarge" -- "${exact[@]}" \
  "Exact solution/Solution=smooth" "Exact solution/Transition=0" "Exact solution/Length=0.5"
invalid "Exact solution/Solution = stick-slip" "y = 0" "put the bottom edge there" -- "${exact[@]}" "Geometry/Lower corner=0, 1"
for bound in "" 0 "1+x"; do
  invalid "Boundary bottom/Friction bound = $bound" "positive constant" "give a number" -- "${exact[@]}" "Boundary bottom/Friction bound=$bound"
done
invalid "Boundary left/Traction = 1.5*(5 - y); -0.75" "contradicts Exact solution/Solution = stick-slip" "write exact" -- \
  "${exact[@]}" "Boundary left/Traction=1.5*(5 - y); -0.75"
invalid "Boundary right/Displacement = 0; 0" "contradicts Exact solution/Solution" "write exact" -- \
  "${exact[@]}" "Boundary right/Displacement=0; 0"
invalid "Boundary left/Contact = bilateral" "contradicts Exact solution/Solution" "Contact = none" -- \
  "${exact[@]}" "Boundary left/Traction=" "Boundary left/Contact=bilateral"
invalid "Boundary bottom/Traction = 1; 0" "contradicts Exact solution/Solution" "without traction" -- \
  "${exact[@]}" "Boundary bottom/Traction=1; 0"
invalid "Body force/Expression = 0; -1" "contradicts Exact solution/Solution" "remove" -- "${exact[@]}" "Body force/Expression=0; -1"

# --- the method's numbers
invalid "Adaptivity/Method = hp5" "one of hup2" -- "Adaptivity/Method=hp5"
invalid "Adaptivity/Smoothness reading = both" "plain or joint" -- "Adaptivity/Smoothness reading=both"
invalid "Adaptivity/Start degree = 1" "contact" "at least 2" -- "Adaptivity/Start degree=1"
invalid "Adaptivity/Start degree = -1" "from 0 to 20" -- "Adaptivity/Start degree=-1"
invalid "Adaptivity/Start degree = 4" "Maximum degree = 3" "raise" -- "Adaptivity/Start degree=4" "Adaptivity/Maximum degree=3"
for entry in "hap threshold" "hpa1 bisected fraction" "hpa1 raised fraction" "hpa2 marked fraction" "hpa3 threshold"; do
  for value in 0 -0.1 1.5 nan; do
    invalid "Adaptivity/$entry = $value" "(0, 1]" -- "Adaptivity/$entry=$value"
  done
done
invalid "Adaptivity/hpa1 raised fraction = 0.6" "sum to at most 1" -- \
  "Adaptivity/hpa1 raised fraction=0.6" "Adaptivity/hpa1 bisected fraction=0.5"
invalid "Adaptivity/Maximum steps = 0" "positive integer" -- "Adaptivity/Maximum steps=0"
invalid "Adaptivity/Maximum unknowns = 99999999999" "positive integer" -- "Adaptivity/Maximum unknowns=99999999999"
for entry in "Tolerance" "Maximum seconds" "hpa2 decay threshold" "hpa3 decay threshold"; do
  invalid "Adaptivity/$entry = -1" ">= 0" -- "Adaptivity/$entry=-1"
done
invalid "Adaptivity/Tolerance = auto" "automatic or a number >= 0" -- "Adaptivity/Tolerance=auto"
invalid "Error/Reference solution = nowhere.dat" "cannot be read" "Output/Reference solution" -- \
  "Error/Reference solution=nowhere.dat"
invalid "Solver/QP tolerance = 0" "(0, 1]" -- "Solver/QP tolerance=0"
invalid "Solver/Diagonal scaling = maybe" "true or false" -- "Solver/Diagonal scaling=maybe"
invalid "Solver/QP solver = newton" "mprgp or active set" -- "Solver/QP solver=newton"
invalid "Solver/QP warm start = maybe" "true or false" -- "Solver/QP warm start=maybe"
invalid "Solver/Multiplier degree offset = 0" "makes S singular" "give -2" -- "Solver/Multiplier degree offset=0"
invalid "Solver/Multiplier degree offset = 7" "-20 to -1" -- "Solver/Multiplier degree offset=7"
for value in -1 2000 all 1.5; do
  invalid "Solver/Threads = $value" "integer from 0 to 64" -- "Solver/Threads=$value"
done
invalid "Start degree = 3" "multiplier has degree p - 5" "at least 5" -- \
  "Solver/Multiplier degree offset=-5" "Adaptivity/Start degree=3"

# --- the command line
refused "no scene" "name a parameter file" --
refused "--frobnicate" "hpvi --help" -- --frobnicate "$scenes/base.prm"
refused "--set Title" "has no '='" "Section/Entry=value" -- --set Title "$scenes/base.prm"
refused "--output" "hpvi --help" -- "$scenes/base.prm" --output
refused "hpvi --help" -- "$scenes/base.prm" "$scenes/base.prm"
refused "--inf-sup writes no file" "remove one" -- --inf-sup --output results "$scenes/base.prm"
for option in --inf-sup --validate --print-parameters; do
  refused "--picture draws the scene into a file" "$option writes none" "remove one" -- --picture $option "$scenes/base.prm"
done
refused "no scene" "name a parameter file" -- --picture
mkdir "$scratch/drawn"
echo mine >"$scratch/drawn/scene.json"
refused "its scene.json would be overwritten" "it does not say that hpvi has made it" "--output" -- --picture --output "$scratch/drawn" "$scenes/base.prm"
[ "$(cat "$scratch/drawn/scene.json")" = mine ] || complain "--picture beside a foreign scene.json" "the file was changed"
refused "base.prm (--set): Material/Young's modulus = 0" -- --picture --set "Material/Young's modulus=0" "$scenes/base.prm"
refused "no multiplier" "remove --inf-sup" -- --inf-sup --set "Boundary bottom/Friction bound=" "$scenes/base.prm"

refused "hpvi: --set a b?c" "has no '='" -- --set $'a\nb\x1bc' "$scenes/base.prm"
refused "base.prm (--set): a b = 1?: is an unknown entry" -- --set $'a\tb=1\x7f' "$scenes/base.prm"
refused "aaa...: has no '='" -- --set "$(printf 'a%.0s' {1..5000})" "$scenes/base.prm"

# --- a directory that cannot be written: below a regular file
touch "$scratch/file"
refused "$scratch/file/results" -- "$scenes/base.prm" --output "$scratch/file/results"
refused "$scratch/file" -- "$scenes/base.prm" --output "$scratch/file"
refused "$scratch/loop" "--output" -- "$scenes/base.prm" --output "$scratch/loop"
[ ! -s "$scratch/file" ] || complain "--output below a file" "the file was changed"

# --- an expression that misbehaves between the points at which it is tried: the run ends where it is
# used and keeps the steps before
misbehaves() { # STEPS WORD ENTRY=VALUE [--set ENTRY=VALUE]...
  local row="hpvi --set $3" kept="$scratch/kept" status
  rows=$((rows + 1))
  timeout 60 "$hpvi" "$scenes/base.prm" --set "$3" "${@:4}" --set Adaptivity/Method=hup3 --set "Adaptivity/Maximum steps=5" \
    --set Output/VTU=false --output "$kept" >"$scratch/stdout" 2>"$scratch/stderr"
  status=$?
  [ $status -eq 1 ] || complain "$row" "exit status $status instead of 1"
  [ "$(wc -l <"$scratch/stderr")" -eq 1 ] || complain "$row" "stderr does not hold one line"
  grep -qF "base.prm (--set): ${3/=/ = }: " "$scratch/stderr" || complain "$row" "stderr does not name the entry"
  grep -qF -- "$2" "$scratch/stderr" || complain "$row" "stderr does not say: $2"
  grep -qF '"status": "failed"' "$kept/summary.json" || complain "$row" "summary.json does not say failed"
  grep -qF "  \"steps\": $1," "$kept/summary.json" || complain "$row" "summary.json does not hold $1 steps"
  [ "$(find "$kept" -name 'contact-*.csv' | wc -l)" -eq "$1" ] || complain "$row" "there are not $1 tables of contact"
}
misbehaves 1 "is not finite at (0.129" "Body force/Expression=if(abs(x-0.13)<0.001,sqrt(-1),0); 0"
# Pressures beyond the loads, of 0.46 at a point of contact, under friction that falls from 0.3125 on.
misbehaves 0 "under the pressure of 0.46" "Boundary bottom/Friction coefficient=0.5-0.8*p" --set "Boundary bottom/Contact=unilateral" \
  --set "Boundary bottom/Gap=0.02*(x-2)^2" --set "Boundary bottom/Friction bound=" --set "Boundary left/Traction=" --set "Boundary top/Traction=0; -0.3"
# What the first step finds comes before anything is written.
refused "Body force/Expression = 1/(x-0.125); 0" "is not finite at (0.125, " -- "$scenes/base.prm" --set "Body force/Expression=1/(x-0.125); 0"
early="Boundary bottom/Friction bound = 1+1.2*sin(16*pi*x)"
refused "$early" "is negative at (" -- "$scenes/base.prm" --set "${early/ = /=}"

# --- load histories
for value in 0 -3 2.5 20000 "5, 6" many; do
  invalid "Loading/Steps = $value" "not accepted" "an integer from 1 to 10000" -- "Loading/Steps=$value"
done
invalid "Loading/Adapt = never" "first step or every step" -- "Loading/Adapt=never"
invalid "Loading/Adapt = first step" "set Steps" -- "Loading/Adapt=first step"
invalid "Boundary left/Traction = t; 0" "uses t" "set Loading/Steps" -- "Boundary left/Traction=t; 0"
invalid "Boundary bottom/Friction bound = 1 + t" "uses t" "set Loading/Steps" -- "Boundary bottom/Friction bound=1 + t"
invalid "Body force/Expression" "is not an expression of x, y and t" -- "Loading/Steps=4" "Body force/Expression=tt; 0"
invalid "Boundary left/Traction" '"sqrt(0.5-t)" with t = 0.75 is not finite' -- "Loading/Steps=4" "Boundary left/Traction=sqrt(0.5-t); 0"
invalid "Boundary bottom/Friction bound" "is negative with t = 0.75" -- "Loading/Steps=4" "Boundary bottom/Friction bound=0.5-t"
invalid "Boundary right/Displacement" "contradicts" "(load step 3, t = 0.75)" -- "Loading/Steps=4" \
  "Boundary right/Displacement=0; if(t>0.6,1,0)"
invalid "Boundary left/Traction" "1e-120" "outside 1e-100 to 1e100" -- "Loading/Steps=4" "Boundary left/Traction=0; 1e-120*t"
invalid "Output/Reference solution = true" "asks for a history" "remove either" -- "Loading/Steps=4" "Output/Reference solution=true"
invalid "Error/Reference solution = base.prm" "asks for a history" -- "Loading/Steps=4" "Error/Reference solution=base.prm"
invalid "Exact solution/Solution = stick-slip" "asks for a history" -- "${exact[@]}" "Loading/Steps=4"
refused "Loading/Steps = 4" "inf-sup" "remove it" -- --inf-sup --set "Loading/Steps=4" "$scenes/base.prm"

# --- sweeps
swept=(--sweep "Boundary bottom/Friction bound=1, 2")
refused "--sweep Boundary bottom" "no '='" "quotes" -- --sweep "Boundary bottom" "$scenes/base.prm"
refused "--sweep =1, 2" "names no entry" -- --sweep "=1, 2" "$scenes/base.prm"
refused "Friction bound=1,,2" "no value before or after a separator" -- --sweep "Boundary bottom/Friction bound=1,,2" "$scenes/base.prm"
refused "Friction bound=1, 2, 1" "has the value 1 twice" "remove one" -- --sweep "Boundary bottom/Friction bound=1, 2, 1" "$scenes/base.prm"
refused "--sweep Boundary bottom/Friction bound" "is swept twice" -- "${swept[@]}" "${swept[@]}" "$scenes/base.prm"
refused "--sweep Boundary bottom/Friction bound" "--set gives it the value 3" "remove one" -- "${swept[@]}" --set "Boundary bottom/Friction  bound=3" "$scenes/base.prm"
refused "--sweep Dimension=2, 3" "write a scene of each" -- --sweep "Dimension=2, 3" "$scenes/base.prm"
refused "--sweep Boundary bottom/Friction bound = -1" "base.prm (--set)" "is negative" "g >= 0" -- --sweep "Boundary bottom/Friction bound=1, -1, -2" "$scenes/base.prm"
refused "--sweep Body force/Expression = 1/(x-0.125); 0" "is not finite at (0.125, " -- --sweep "Body force/Expression=0; 0 | 1/(x-0.125); 0" "$scenes/base.prm"
refused "Solver/Path = primal" "base.prm" "does not offer" -- --sweep "Solver/Path=reduced, primal" "$scenes/base.prm"
refused "--sweep Boundary bottom/Friction bound" "--picture" "--set" -- --picture "${swept[@]}" "$scenes/base.prm"
refused "--sweep Boundary bottom/Friction bound" "--inf-sup" "--set" -- --inf-sup "${swept[@]}" "$scenes/base.prm"
refused "--resume $scenes" "goes on with one scene" "remove --sweep" -- --resume "$scenes" "${swept[@]}"
refused "no scene" "hpvi --help" -- --print-parameters "${swept[@]}"
refused "cannot be used" "--output" -- --output /dev/null "${swept[@]}" "$scenes/base.prm"

# --- the good scene passes, and its effective parameters are the same scene again
"$hpvi" --validate "$scenes/base.prm" >"$scratch/stdout" 2>"$scratch/stderr" ||
  complain "base.prm" "the good scene is rejected"
"$hpvi" --validate "$scenes/base.prm" --set "Boundary bottom/Traction=1; -1" >"$scratch/stdout" 2>"$scratch/stderr" ||
  complain "base.prm" "a load on the contact boundary is rejected"
"$hpvi" --validate "$scenes/base.prm" --set $'Geometry/Subdivisions=2,\t2' --set $'Geometry/Upper corner=4\t, \t4' \
  --set "Material/Poisson's ratio=5e-324" >"$scratch/stdout" 2>"$scratch/stderr" ||
  complain "base.prm" "tabs beside a comma or a tiny number are rejected"
valid() { # WHAT ENTRY=VALUE...
  local what="$1" arguments=() override
  shift
  for override in "$@"; do
    arguments+=(--set "$override")
  done
  "$hpvi" --validate "$scenes/base.prm" "${arguments[@]}" >"$scratch/stdout" 2>"$scratch/stderr" ||
    complain "base.prm" "$what is rejected"
}
valid "one comparison at a time" "Boundary left/Traction=(y>1)*(y<=2); if(y<1 && y>0.5||y==3&&x!=2, y < 2 ? 1 : y < 3, (x>0)==(y>0))"
valid "a narrow strip of springs" "${unheld[@]}" "Boundary right/Spring=if(abs(y - 0.6) < 0.003, 1, 0); 0"
valid "springs along a side" "${unheld[@]}" "Boundary top/Spring=0; if(x > 1, 1, 0)"
valid "contact that opens" "${open[@]}" "Boundary bottom/Gap=if(abs(x)<=1, 0, x/8)"
valid "interference beside a free edge" "${open[@]}" "Boundary bottom/Gap=0.01*(x - 3)"
valid "contact without multiplier of degree 1" "${open[@]}" "Boundary bottom/Friction bound=" "Adaptivity/Start degree=1"
valid "friction alone" "Boundary bottom/Contact=tangential" "Boundary right/Displacement=0; -0.1"
valid "Hertz's contact" "${hertz[@]}" "Boundary bottom/Gap=(x-2)^2/E"
valid "partial slip" "${partial_slip[@]}" "Boundary bottom/Friction bound=sqrt(max(0, 1-(x-2)^2))"
valid "friction by pressure" "${coulomb[@]}" "Boundary bottom/Friction coefficient=if(p < 0.1, 0.5, 0.05 / max(p, 1e-3) + 0*x)"
valid "a load history" "Loading/Steps=3" "Boundary left/Traction=sin(t); x*t" "Boundary bottom/Friction bound=1-t"
valid "a support that is round-off off the foundation" "${open[@]}" "Boundary bottom/Gap=" \
  "Boundary right/Displacement=0; 0.01*sin(2*pi)"
valid "the same in the last load step" "${open[@]}" "Boundary bottom/Gap=" "Loading/Steps=4" \
  "Boundary right/Displacement=0; if(t<0.9,0.01*t,0.01*sin(2*pi*t))" "Boundary left/Traction="
valid "loads that decay" "Loading/Steps=100" "Boundary left/Traction=0; exp(-1000*(t-0.5)^2)"
valid "loads that begin with less than double precision squares" "Loading/Steps=40" "Boundary left/Traction=0; exp(-10000*(t-0.5)^2)"
"$hpvi" "$scenes/base.prm" --set "Material/Young's modulus=1e70" --set "Boundary left/Traction=1e-90*(2-y); -1e-90" \
  --set "Boundary bottom/Friction bound=0.3e-90" --output "$scratch/tiny" >"$scratch/stdout" 2>"$scratch/stderr" ||
  complain "base.prm" "slips whose products underflow end the run"
exact_scene=()
for override in "${exact[@]}"; do
  exact_scene+=(--set "$override")
done
"$hpvi" --validate "$scenes/base.prm" "${exact_scene[@]}" >"$scratch/stdout" 2>"$scratch/stderr" ||
  complain "base.prm" "its exact solution is rejected"
"$hpvi" --print-parameters "$scenes/base.prm" >"$scratch/effective.prm" 2>"$scratch/stderr"
"$hpvi" --print-parameters "$scratch/effective.prm" 2>"$scratch/stderr" | cmp -s - "$scratch/effective.prm" ||
  complain "base.prm" "effective parameters do not survive a round trip"

echo "$rows bad inputs, $failures failures"
[ $failures -eq 0 ]
