#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""by_hand.py HPVI: scenes whose energies and forces anybody can compute, a row each: settings and what summary.json has to say."""

import math
import re
import unittest

from runs import SCENES, RunTest, read_vtu

# A body of 2 x 1 that is free to become thinner: one step of degree 2 is exact for a uniform strain.
BLOCK = {"Geometry/Upper corner": "2, 1", "Geometry/Subdivisions": "2, 1", "Material/Young's modulus": "10",
         "Material/Poisson's ratio": "0", "Material/Plane": "stress", "Boundary left/Displacement": "0; free",
         "Boundary bottom/Displacement": "free; 0", "Adaptivity/Method": "hup2", "Adaptivity/Maximum steps": "1"}
HALVES = {**BLOCK, "Material stiff/Young's modulus": "30", "Boundary right/Traction": "3; 0"}
LAYERS = {**HALVES, "Geometry/Subdivisions": "2, 2", "Boundary right/Displacement": "0.1; free",
          "Boundary right/Traction": None, "Material stiff/Where": "y - 0.5"}
HEAVY = {**BLOCK, "Material/Density": "2", "Body force/Gravity": "0; -3", "Boundary bottom/Displacement": "0; 0"}
TOP = {**HEAVY, "Material/Density": None, "Body force/Gravity": None}
PART = {**TOP, "Boundary foot/On": "top", "Boundary foot/Where": "0.3 - abs(x - 1)", "Boundary foot/Pressure": "4"}
SPACE = {"Dimension": "3", "Geometry/Upper corner": "2, 1, 1", "Geometry/Subdivisions": "2, 1, 1",
         "Material/Young's modulus": "10", "Material/Poisson's ratio": "0", "Boundary bottom/Displacement": "0; 0; 0",
         "Adaptivity/Method": "hup2", "Adaptivity/Maximum steps": "1", "Solver/Primal tolerance": "1e-12"}
PLATE = {**BLOCK, "Boundary left/Displacement": "0; 0", "Boundary bottom/Displacement": None,
         "Boundary right/Rigid": "true"}
HOT = {**BLOCK, "Material/Thermal expansion": "0.001", "Temperature/Expression": "100"}
TURNED = {"Material/Plane": "axisymmetric", "Material/Young's modulus": "10", "Material/Poisson's ratio": "0",
          "Boundary bottom/Displacement": "free; 0", "Boundary top/Pressure": "3", "Adaptivity/Method": "hup2",
          "Adaptivity/Maximum steps": "1"}
WOOD = {**BLOCK, "Material/Young's modulus": None, "Material/Poisson's ratio": None, "Material/Elasticity": "orthotropic",
        "Material/Young's moduli": "10, 2", "Material/Poisson's ratios": "0.4", "Material/Shear moduli": "1.5, 7, 8",
        "Boundary right/Traction": "3; 0"}
GRAIN = {**SPACE, "Material/Young's modulus": None, "Material/Poisson's ratio": None, "Material/Elasticity": "orthotropic",  # axes 1, 2, 3 along y, z, x
         "Material/Young's moduli": "10, 2, 4", "Material/Poisson's ratios": "0.4, 0.5, 0.2", "Material/Shear moduli": "1.5, 7, 8",
         "Material/Axes": "0, 2, 0; 0, 1, 3", "Boundary bottom/Displacement": "free; 0; free", "Boundary left/Displacement": "0; free; free",
         "Boundary front/Displacement": "free; free; 0", "Boundary right/Traction": "3; 0; 0"}
FIBRES = math.radians(30)  # off-axis tension couples to shear: eps_xx, eps_yy and 2 eps_xy of sigma_xx = 1 in closed form
C, S = math.cos(FIBRES), math.sin(FIBRES)
ALONG = C ** 4 / 10 + S ** 4 / 2 + (1 / 1.5 - 2 * 0.4 / 10) * S * S * C * C
ASIDE = (1 / 10 + 1 / 2 - 1 / 1.5) * S * S * C * C - 0.4 / 10 * (S ** 4 + C ** 4)
SHEAR = (2 / 10 + 2 * 0.4 / 10 - 1 / 1.5) * S * C ** 3 - (2 / 2 + 2 * 0.4 / 10 - 1 / 1.5) * S ** 3 * C
# Under sigma_xx = 3 in plane strain with E = 10, nu = 0.25: u_x = 3 (1 - nu^2)/E x, u_y = -3 nu (1 + nu)/E y, sigma_zz = 0.75.
PROBED = {**BLOCK, "Material/Poisson's ratio": "0.25", "Material/Plane": "strain", "Boundary right/Traction": "3; 0",
          "Probe tip/At": "2, 1", "Probe core/At": "0.9, 0.5", "Probe core/Size": "0.4", "Probe side/On": "right"}
STRETCH, SQUEEZE = 3 * (1 - 0.25 ** 2) / 10, -3 * 0.25 * 1.25 / 10
HISTORY = {"Loading/Steps": "2", "Adaptivity/Method": "hup2"}
# A block whose stress is uniform, s_xy = 0.6 p + 0.8 z and s_yy = -0.8 p + 0.6 z under p along -d = (-0.6, 0.8) and z
# along -t = -(0.8, 0.6); with E = 10, nu = 0 its bottom moves by the top's displacement less (s_xy/5, s_yy/10).
OBLIQUE = {"Geometry/Upper corner": "2, 1", "Geometry/Subdivisions": "2, 1", "Material/Young's modulus": "10",
           "Material/Poisson's ratio": "0", "Material/Plane": "stress", "Boundary bottom/Contact direction": "3; -4",
           "Adaptivity/Method": "hup3", "Adaptivity/Maximum steps": "1"}
PRESSED = {**OBLIQUE, "Boundary bottom/Contact": "unilateral", "Boundary top/Displacement": "0.1; -0.2",
           "Boundary left/Traction": "0; -0.6", "Boundary right/Traction": "0; 0.6"}
RUBBED = {**OBLIQUE, "Boundary left/Traction": "0; -1", "Boundary right/Traction": "0; 1"}  # p = 1, z = 0.5
SLIDING = {**RUBBED, "Boundary bottom/Contact": "unilateral", "Boundary bottom/Gap": "0.3", "Boundary top/Displacement": "0.5; -0.2"}
# A weight of 6 on a plane that falls to the left by atan(3/4), whatever side of the body lies on it.
SLOPE = {**OBLIQUE, "Boundary bottom/Contact": "unilateral", "Body force/Expression": "0; -3"}

# A bar of 2 x 1 between walls, E = 10, tightened to 3: its force is E A (delta - u)/l, u what its ends give way.
BAR = {**BLOCK, "Material/Poisson's ratio": "0.3", "Boundary left/Displacement": None, "Boundary left/Symmetry": "true",
       "Boundary right/Symmetry": "true", "Pretension bar/Through": "0.7, 1; 0.7, 0", "Pretension bar/Force": "3"}
SPRUNG = {**BAR, "Boundary right/Symmetry": None, "Boundary right/Spring": "5; 0"}

# Two blocks of 2 x 1, one upon the other, E = 10 and 30, nu = 0, with meshes that do not match: squeezed by 0.2 they press with 1.5.
STACK = {"Body lower/Upper corner": "2, 1", "Body lower/Subdivisions": "3, 1", "Body upper/Lower corner": "0, 1",
         "Body upper/Upper corner": "2, 2", "Body upper/Subdivisions": "2, 2", "Body upper/Material": "stiff",
         "Material/Young's modulus": "10", "Material/Poisson's ratio": "0", "Material/Plane": "stress",
         "Material stiff/Young's modulus": "30", "Contact joint/Between": "upper.bottom, lower.top",
         "Boundary lower.bottom/Displacement": "0; 0", "Boundary upper.top/Displacement": "0; -0.2",
         "Adaptivity/Method": "hup3", "Adaptivity/Maximum steps": "1"}
SQUEEZED = {"final.energy": 0.5 * 1.5 * 2 * 0.2, "forces.lower.bottom.1": 3, "forces.upper.top.1": -3, "forces.upper.bottom.1": 3,
            "contact.upper.bottom.normal_resultant": -3, "contact.upper.bottom.through.0": 1}


def sheared(stress, **contact):
    """The upper block is moved, too; sides have the shear stress that the joint has, so that it is uniform."""
    return {**STACK, **{f"Contact joint/{entry.replace('_', ' ')}": value for entry, value in contact.items()},
            "Boundary upper.top/Displacement": "0.3; -0.2",
            **{f"Boundary {body}.{side}/Traction": f"0; {sign * stress}"
               for body in ("lower", "upper") for side, sign in (("left", -1), ("right", 1))}}


# A field of constant strain in three bodies that meet in one corner, and its energy in plane stress, E = 10 and nu = 0.3, on an area of 4.
FIELD = "0.01*x + 0.02*y; 0.005*x - 0.03*y"
CORNER = {"Body low/Lower corner": "0, -1", "Body low/Upper corner": "2, 0", "Body low/Subdivisions": "3, 2", "Body a/Subdivisions": "2, 2",
          "Body b/Lower corner": "1, 0", "Body b/Upper corner": "2, 1", "Body b/Subdivisions": "3, 3", "Material/Young's modulus": "10",
          "Material/Poisson's ratio": "0.3", "Material/Plane": "stress",
          **{f"Boundary {side}/Displacement": FIELD for side in ("low.bottom", "low.left", "low.right", "a.left", "a.top", "b.right", "b.top")},
          **{f"Contact {name}/{entry}": value for name, sides in (("one", "low.top, a.bottom"), ("two", "b.bottom, low.top"), ("three", "a.right, b.left"))
             for entry, value in (("Between", sides), ("Law", "tied"))}, "Adaptivity/Method": "hup3", "Adaptivity/Maximum steps": "1"}
CORNER_ENERGY = 4 * 0.5 * (10 / 0.91 * (0.01 ** 2 + 0.03 ** 2 - 0.6 * 0.01 * 0.03) + 10 / 2.6 * 0.025 ** 2)

# A shaft of radius 1 in a hub from 1 to 2, E = 10 and 30, both as long as their planes are apart: Lame's two cylinders, that want 0.01 more.
HUB = {"Body shaft/Upper corner": "1, 1", "Body shaft/Subdivisions": "2, 2", "Body hub/Lower corner": "1, 0", "Body hub/Upper corner": "2, 1",
       "Body hub/Subdivisions": "3, 3", "Body hub/Material": "hard", "Material/Plane": "axisymmetric", "Material/Young's modulus": "10",
       "Material/Poisson's ratio": "0.3", "Material hard/Young's modulus": "30", "Contact fit/Between": "shaft.right, hub.left",
       **{f"Boundary {body}.{side}/Displacement": "free; 0" for body in ("shaft", "hub") for side in ("bottom", "top")},
       "Adaptivity/Method": "pu", "Adaptivity/Start degree": "12", "Adaptivity/Maximum steps": "1"}
FIT = 2 * math.pi * 0.01 / (1.3 * 0.4 / 10 + 1.3 * (0.4 + 4) / (30 * 3))  # the force of a fit of 0.01 around the turn
COLUMN = {**STACK, "Material/Plane": "axisymmetric",
          "Boundary lower.bottom/Displacement": "free; 0", "Boundary upper.top/Displacement": "free; -0.2"}  # STACK turned about its left side
# A ring in a ring that is held outside, both in plane stress: 2 r^2 s_rt is the moment of the shear 0.3 inside; pressed into each other by Gap.
RINGS = {"Body in/Shape": "ring sector", "Body in/Angles": "0, 360", "Body in/Radii": "1, 1.5", "Body in/Subdivisions": "1, 7",
         "Body out/Shape": "ring sector", "Body out/Angles": "0, 360", "Body out/Radii": "1.5, 2", "Body out/Subdivisions": "1, 5",
         "Material/Young's modulus": "10", "Material/Poisson's ratio": "0", "Material/Plane": "stress", "Contact fit/Between": "in.outer, out.inner",
         "Contact fit/Gap": "-0.1", "Contact fit/Friction coefficient": "0.5", "Boundary in.inner/Shear": "0.1", "Boundary out.outer/Spring": "0; 5",
         "Adaptivity/Method": "pu", "Adaptivity/Start degree": "12", "Adaptivity/Maximum steps": "1"}
# nu = 0: a ring from a to b under p at its side b shrinks by p b (a^2 + b^2)/(10 (b^2 - a^2)) there.
GRIP = 0.1 / (1.5 / 10 * ((1 + 1.5 ** 2) / (1.5 ** 2 - 1) + (4 + 1.5 ** 2) / (4 - 1.5 ** 2)))


def timoshenko(strain, h1, E1, h2, E2):
    """Curvature of two strips, the first one below and longer by @p strain (J. Opt. Soc. Am. 11, 1925, 233)."""
    m, n, h = h1 / h2, E1 / E2, h1 + h2
    return 6 * strain * (1 + m) ** 2 / (h * (3 * (1 + m) ** 2 + (1 + m * n) * (m ** 2 + 1 / (m * n))))


# Name, settings, {path in summary.json: value}; J = -L(u)/2 where loads alone act, a(u,u)/2 under displacements.
ROWS = [
    ("probes of a uniform stress", PROBED,
     {"final.tip_ux": 2 * STRETCH, "final.tip_uy": SQUEEZE, "final.core_ux": 0.9 * STRETCH, "final.core_uy": 0.5 * SQUEEZE,
      "final.side_ux": 2 * STRETCH, "final.side_uy": 0.5 * SQUEEZE,
      **{f"final.{probe}_{stress}": value for probe in ("tip", "core", "side")
         for stress, value in (("s1", 3), ("s2", 0), ("szz", 0.75), ("mises", (9 + 0.75 ** 2 - 3 * 0.75) ** 0.5))},
      "largest_displacement.value": math.hypot(2 * STRETCH, SQUEEZE), "largest_displacement.at.0": 2,
      "largest_displacement.at.1": 1}),
    ("probes of a thick body", {**PROBED, "Material/Thickness": "4"},
     {"final.tip_ux": 2 * STRETCH, "final.core_s1": 3}),
    ("probes of a body of revolution", {**TURNED, "Probe tip/At": "0.5, 1", "Probe core/At": "0.6, 0.5", "Probe core/Size": "0.2"},
     {"final.tip_ux": 0, "final.tip_uy": -0.3, "final.core_uy": -0.15, "final.tip_s2": -3, "final.tip_szz": 0, "final.tip_mises": 3}),
    ("a disc turns around the axis", {**TURNED, "Boundary top/Pressure": None, "Boundary right/Pressure": "2",
                                      "Probe core/At": "0.6, 0.5", "Probe core/Size": "0.2"},
     {"final.core_ux": -0.2 * (0.6 + 0.2 ** 2 / 4 / 0.6), "final.core_s1": 0, "final.core_s2": -2, "final.core_szz": -2}),
    ("probes in space", {**SPACE, "Boundary top/Pressure": "2", "Probe tip/At": "2, 1, 0.5", "Probe roof/On": "top"},
     {"final.tip_uy": -0.2, "final.roof_uy": -0.2, "final.tip_s1": 0, "final.tip_s3": -2, "final.roof_mises": 2}),
    ("probes on the primal path", {**PROBED, "Solver/Path": "primal"},
     {"final.tip_ux": 2 * STRETCH, "final.core_ux": 0.9 * STRETCH, "final.side_uy": 0.5 * SQUEEZE, "final.core_szz": 0.75}),
    ("materials in series", {**HALVES, "Material stiff/Where": "x - 1"}, {"final.energy": -0.5 * 3 * (3 / 10 + 3 / 30)}),
    ("a grid line where a material ends", {**HALVES, "Material stiff/Where": "x > 0.6"},
     {"final.energy": -0.5 * 3 * (3 / 10 * 0.6 + 3 / 30 * 1.4), "final.elements": 3}),
    ("materials in parallel", LAYERS, {"final.energy": 0.5 * 0.1 * (0.5 * 0.5 + 0.5 * 1.5), "forces.right.0": 1.0}),
    ("the first that is positive counts",
     {**HALVES, "Geometry/Subdivisions": "4, 1", "Material stiff/Where": "x - 1", "Material last/Where": "x - 0.5",
      "Material last/Young's modulus": "60"},
     {"final.energy": -0.5 * 3 * (3 / 10 * 0.5 + 3 / 60 * 0.5 + 3 / 30)}),
    ("a material that inherits", {**HALVES, "Material stiff/Young's modulus": None, "Material stiff/Where": "x - 1",
                                  "Material stiff/Poisson's ratio": "0"}, {"final.energy": -0.5 * 3 * 3 / 10 * 2}),
    ("thickness", {**LAYERS, "Material/Thickness": "0.25"},
     {"final.energy": 0.25 * 0.05, "forces.right.0": 0.25, "final.energy_norm": (0.25 * 0.1) ** 0.5}),
    ("weight", HEAVY, {"forces.bottom.1": 12, "loads.force.1": -12, "loads.moment": 0}),
    ("weights of materials", {**HEAVY, "Material lead/Density": "11", "Material lead/Where": "x - 1"},
     {"forces.bottom.1": 3 * (2 + 11), "loads.moment": -3 * (11 - 2) * 0.5}),
    ("weight beside another force", {**HEAVY, "Body force/Expression": "1; E", "Boundary left/Displacement": None},
     {"forces.bottom.1": 12 - 20, "forces.bottom.0": -2}),
    ("moduli of the cell at hand", {**HEAVY, "Body force/Gravity": None, "Body force/Expression": "0; E",
                                    "Material stiff/Young's modulus": "30", "Material stiff/Where": "x - 1"},
     {"forces.bottom.1": -(10 + 30)}),
    ("pressure", {**TOP, "Boundary top/Pressure": "y + 1"}, {"forces.bottom.1": 4}),
    ("shear", {**TOP, "Boundary top/Shear": "2", "Boundary left/Displacement": None}, {"forces.bottom.0": 4}),
    ("both beside a traction", {**TOP, "Boundary top/Traction": "1; 1", "Boundary top/Pressure": "3",
                                "Boundary top/Shear": "2", "Boundary left/Displacement": None},
     {"forces.bottom.0": 2, "forces.bottom.1": 4}),
    ("pressure on a slanted side", {**TOP, "Geometry/Upper corner": None, "Geometry/Shape": "quadrilateral",
                                    "Geometry/Corners": "0, 0; 2, 0; 3, 1; 0, 1", "Boundary right/Pressure": "5"},
     {"loads.force.0": -5, "loads.force.1": 5}),
    ("a part between grid lines", PART, {"forces.bottom.1": 4 * 0.6, "final.elements": 4}),
    ("what a part has is not the side's", {**PART, "Boundary top/Pressure": "1"}, {"forces.bottom.1": 4 * 0.6 + 1.4}),
    ("support by parts", {**HEAVY, "Boundary bottom/Displacement": None, "Boundary foot/On": "bottom",
                          "Boundary foot/Where": "abs(x - 1) - 0.5", "Boundary foot/Displacement": "0; 0"},
     {"forces.foot.1": 12}),
    ("contact of a part", {**HEAVY, "Boundary bottom/Displacement": None, "Boundary foot/On": "bottom",
                           "Boundary foot/Where": "abs(x - 1) - 0.5", "Boundary foot/Contact": "unilateral",
                           "Boundary foot/Friction bound": "1", "Adaptivity/Start degree": "3"},
     {"forces.foot.1": 12, "contact.foot.normal_resultant": -12, "contact.foot.zones.0.to.0": 0.5,
      "contact.foot.zones.1.from.0": 1.5, "contact.foot.length": 1}),
    ("contact beside a support on one side",
     {**HEAVY, "Boundary bottom/Displacement": None, "Boundary bottom/Contact": "bilateral",
      "Boundary foot/On": "bottom", "Boundary foot/Where": "x - 1.3", "Boundary foot/Displacement": "0; 0"},
     {"forces.bottom.1+forces.foot.1": 12}),
    ("symmetry", {**BLOCK, "Boundary left/Displacement": None, "Boundary bottom/Displacement": None,
                  "Boundary left/Symmetry": "true", "Boundary bottom/Symmetry": "true", "Boundary right/Traction": "3; 0"},
     {"final.energy": -0.5 * 3 * 3 / 10 * 2, "forces.left.0": -3, "forces.bottom.1": 0}),
    ("symmetry along a slanted side", {**BLOCK, "Geometry/Upper corner": None, "Geometry/Shape": "quadrilateral",
                                       "Geometry/Corners": "0, 0; 2, 1; 1.5, 2; -0.5, 1", "Geometry/Subdivisions": "2, 2",
                                       "Boundary left/Displacement": None, "Boundary bottom/Displacement": None,
                                       "Boundary left/Symmetry": "true", "Boundary bottom/Symmetry": "true",
                                       "Boundary right/Pressure": "-3"},
     {"final.energy": -0.5 * 3 * 3 / 10 * (5 * 1.25) ** 0.5 * 1, "forces.left.0": -3}),
    ("a spring in series", {**BLOCK, "Boundary left/Displacement": None, "Boundary left/Spring": "5; 0",
                            "Boundary right/Traction": "3; 0"},
     {"final.energy": -0.5 * 3 * (3 / 10 * 2 + 3 / 5), "forces.left.0": -3,
      "final.energy_norm": (3 * (3 / 10 * 2 + 3 / 5)) ** 0.5}),
    ("springs along the side", {**BLOCK, "Boundary left/Displacement": None, "Boundary left/Symmetry": "false",
                                "Boundary bottom/Displacement": None, "Boundary bottom/Spring": "20; x + 1",
                                "Boundary right/Traction": "3; 0"}, {"forces.bottom.0": -3, "forces.bottom.1": 0}),
    ("a spring that turns with the side", {**BLOCK, "Geometry/Upper corner": None, "Geometry/Shape": "quadrilateral",
                                           "Geometry/Corners": "0, 0; 2, 1; 1.5, 2; -0.5, 1",
                                           "Boundary left/Displacement": None, "Boundary left/Spring": "5; 0",
                                           "Boundary bottom/Displacement": None, "Boundary bottom/Symmetry": "true",
                                           "Boundary right/Pressure": "-3"},
     {"final.energy": -0.5 * 3 * 1.25 ** 0.5 * (3 / 10 * 5 ** 0.5 + 3 / 5), "forces.left.0": -3}),
    ("a spring beside a displacement", {**BLOCK, "Boundary left/Displacement": None, "Boundary left/Spring": "5; 0",
                                        "Boundary right/Displacement": "0.5; free", "Boundary right/Spring": "100; 0"},
     {"forces.left.0": -0.5 / (1 / 5 + 2 / 10), "forces.left.0+forces.right.0": 0}),
    ("along the fibres", WOOD, {"final.energy": -0.5 * 3 * 3 / 10 * 2}),
    ("across the fibres", {**WOOD, "Material/Angle": "90"}, {"final.energy": -0.5 * 3 * 3 / 2 * 2}),
    ("along the fibres of a plane strain",
     {**WOOD, "Material/Plane": "strain", "Material/Young's moduli": "10, 2, 4", "Material/Poisson's ratios": "0.4, 0.5, 0.1"},
     {"final.energy": -0.5 * 3 * 3 * (1 / 10 - 0.5 ** 2 / 10 ** 2 * 4) * 2}),
    ("at an angle to the fibres", {**WOOD, "Material/Angle": "30", "Boundary bottom/Displacement": None,
                                   "Boundary left/Displacement": f"{3 * SHEAR}*y; {3 * ASIDE}*y"},
     {"final.energy": 0.5 * 3 * 3 * ALONG * 2 - 3 * 3 * (2 * ALONG + SHEAR / 2), "forces.left.0": -3, "forces.left.1": 0,
      "final.energy_norm": (3 * 3 * ALONG * 2) ** 0.5}),
    ("fibres beside an isotropic material that they do not inherit from",
     {**HALVES, "Material stiff/Young's modulus": None, "Material stiff/Where": "x - 1", "Material stiff/Elasticity": "orthotropic",
      "Material stiff/Young's moduli": "30, 1", "Material stiff/Poisson's ratios": "0", "Material stiff/Shear moduli": "1"},
     {"final.energy": -0.5 * 3 * (3 / 10 + 3 / 30)}),
    ("an isotropic material beside fibres",
     {**WOOD, "Material/Poisson's ratios": "0", "Material soft/Where": "x - 1", "Material soft/Elasticity": "isotropic",
      "Material soft/Young's modulus": "5", "Material soft/Poisson's ratio": "0"},
     {"final.energy": -0.5 * 3 * (3 / 10 + 3 / 5)}),
    ("fibres that inherit all but their angle",
     {**WOOD, "Material/Poisson's ratios": "0", "Material turned/Where": "x - 1", "Material turned/Angle": "-90"},
     {"final.energy": -0.5 * 3 * (3 / 10 + 3 / 2)}),
    ("fibres in space", {**GRAIN, "Probe tip/At": "2, 1, 1"},
     {"final.energy": -0.5 * 3 * 3 / 4 * 2, "final.tip_ux": 3 / 4 * 2, "final.tip_uy": -0.5 / 10 * 3, "final.tip_uz": -0.2 / 2 * 3, "final.tip_s1": 3}),
    ("fibres in space that inherit all but their axes",
     {**GRAIN, "Material/Poisson's ratios": "0, 0, 0", "Material turned/Where": "x - 1", "Material turned/Axes": "1, 0, 0; 0, 1, 0"},
     {"final.energy": -0.5 * 3 * (3 / 4 + 3 / 10)}),
    ("springs of a thick body in time", {**BLOCK, **HISTORY, "Boundary left/Displacement": None,
                                         "Boundary left/Spring": "5; 0", "Boundary right/Traction": "3*t; 0",
                                         "Material/Thickness": "2"},
     {"loading.stored_energy": 2 * 0.5 * 3 * (3 / 10 * 2 + 3 / 5), "forces.left.0": -6}),
    ("a rigid plate that pulls", {**PLATE, "Boundary right/Displacement": "free; 0", "Boundary right/Rotation": "0",
                                  "Boundary right/Force": "3; free"},
     {"final.energy": -0.5 * 3 * 3 / 10 * 2, "plates.right.displacement.0": 0.6, "plates.right.rotation": 0,
      "forces.left.0": -3, "forces.right.0": 3}),
    ("a rigid plate that bends", {**PLATE, "Boundary right/Moment": "0.5"},
     {"final.energy": -0.5 * 0.5 * 1.2, "plates.right.rotation": 1.2, "plates.right.moment": 0.5,
      "plates.right.displacement.0": 0, "plates.right.displacement.1": 1.2, "forces.left.0": 0}),
    ("a plate that turns", {**PLATE, "Boundary right/Rotation": "1.2"},
     {"final.energy": 0.5 * 0.5 * 1.2, "plates.right.moment": 0.5, "plates.right.displacement.1": 1.2}),
    ("a plate that pulls askew", {**PLATE, "Geometry/Upper corner": None, "Geometry/Shape": "quadrilateral",
                                  "Geometry/Corners": "0, 0; 2, 1; 1.5, 2; -0.5, 1", "Boundary right/Force": "3; 1.5",
                                  "Boundary right/Rotation": "0"},
     {"final.energy": -0.5 * 11.25 ** 0.5 * 11.25 ** 0.5 / 10 / 1.25 ** 0.5 * 5 ** 0.5, "forces.left.0": -3,
      "plates.right.displacement.0": 0.6, "plates.right.displacement.1": 0.3}),
    ("totals of a plate on a thick body in time",
     {**PLATE, **HISTORY, "Boundary right/Force": "6*t; free", "Boundary right/Moment": "2*t", "Material/Thickness": "2"},
     {"plates.right.displacement.0": 0.6, "plates.right.moment": 2, "forces.left.0": -6,
      "loading.stored_energy": 0.5 * (6 * 0.6 + 2 * 2.4), "loading.work": 0.5 * (6 * 0.6 + 2 * 2.4)}),
    ("a plate that moves in time", {**PLATE, **HISTORY, "Boundary right/Displacement": "0.6*t; free",
                                    "Boundary right/Rotation": "0"}, {"loading.work": 0.9, "loading.stored_energy": 0.9}),
    ("a body between two plates", {**PLATE, "Boundary left/Displacement": "0; 0", "Boundary left/Rigid": "true",
                                   "Boundary left/Rotation": "0.1", "Boundary right/Force": "3; free"},
     {"final.energy_norm": 1.8 ** 0.5, "plates.right.displacement.0": 0.6, "plates.right.displacement.1": 0.2,
      "plates.right.rotation": 0.1, "plates.left.displacement.0": 0}),
    ("a plate on a body that contact alone holds",
     {**TOP, "Boundary bottom/Displacement": None, "Boundary left/Displacement": None, "Boundary bottom/Contact": "unilateral",
      "Boundary bottom/Friction bound": "1", "Boundary punch/On": "top", "Boundary punch/Where": "(x - 0.5)*(1.6 - x)",
      "Boundary punch/Rigid": "true", "Boundary punch/Force": "0.3; -4", "Boundary punch/Moment": "0.1"},
     {"contact.bottom.normal_resultant": -4, "forces.bottom.0": -0.3, "plates.punch.moment": 0.1,
      "plates.punch.mean_point.0": 1.05}),
    ("free expansion", {**HOT, "Material/Poisson's ratio": "0.3"},
     {"final.energy": -0.5 * 2 * 0.1 ** 2 * 10 / 0.7 * 2, "von_mises.largest": 0, "forces.left.0": 0}),
    ("heat between two walls", {**HOT, "Boundary right/Displacement": "0; free"},
     {"forces.left.0": 1, "forces.right.0": -1, "von_mises.largest": 1}),
    ("free expansion in plane strain", {**HOT, "Material/Plane": "strain", "Material/Poisson's ratio": "0.3"},
     {"von_mises.largest": 1, "forces.left.0": 0,
      "final.energy": -0.5 * 2 * 0.13 * 0.13 * 10 / (1.3 * 0.4) * 2}),
    ("an initial strain across the plane",
     {**HOT, "Temperature/Expression": None, "Material/Plane": "strain", "Material/Poisson's ratio": "0.3",
      "Material/Initial strain": "0; 0; 0; 0.1"},
     {"von_mises.largest": 1, "final.energy": -0.5 * 2 * 0.03 * 0.03 * 10 / (1.3 * 0.4) * 2}),
    ("an initial shear", {**HOT, "Temperature/Expression": None, "Material/Initial strain": "0; 0; 0.05",
                          "Boundary left/Displacement": "0; 0", "Boundary bottom/Displacement": None},
     {"von_mises.largest": 0, "final.energy": -0.5 * 2 * 0.05 * 2 * 5 * 0.05 * 2}),
    ("a temperature that bends", {**HOT, "Temperature/Expression": "100*y", "Boundary bottom/Displacement": None,
                                  "Boundary left/Displacement": "0; 0.05*y^2", "Material/Poisson's ratio": "0.3"},
     {"von_mises.largest": 0, "forces.left.0": 0, "forces.left.1": 0, "final.estimate": 0}),
    ("heat on cells that are no parallelograms",
     {**HOT, "Geometry/Upper corner": None, "Geometry/Shape": "quadrilateral", "Geometry/Corners": "0, 0; 2, 0; 1.5, 1; 0, 1",
      "Error/Bound": "true"},
     {"von_mises.largest": 0, "final.energy": -0.5 * 2 * 0.1 ** 2 * 10 * 1.75}),
    ("a strip of two metals bends as Timoshenko says",
     {**PLATE, "Material/Initial strain": "0.01; 0; 0", "Material steel/Where": "y - 0.25", "Material steel/Young's modulus": "30",
      "Material steel/Initial strain": "0.002; 0; 0"},
     {"plates.right.rotation": 2 * timoshenko(0.01 - 0.002, 0.25, 10, 0.75, 30), "plates.right.moment": 0,
      "forces.left.0": 0}),
    ("a cylinder under pressure", TURNED, {"final.energy": -0.5 * math.pi * 9 / 10, "forces.bottom.1": 3 * math.pi}),
    ("a cylinder on springs", {**TURNED, "Boundary bottom/Displacement": None, "Boundary bottom/Spring": "5; 0"},
     {"final.energy": -0.5 * math.pi * 3 * (3 / 10 + 3 / 5), "forces.bottom.1": 3 * math.pi}),
    ("a cylinder pressed from all sides, whose hoop stress is that pressure", {
        **TURNED, "Boundary top/Pressure": None, "Boundary right/Pressure": "3", "Material/Poisson's ratio": "0.3"},
     {"final.energy": -0.5 * 2 * math.pi * 3 * 3 * 0.7 / 10, "von_mises.largest": 3, "forces.bottom.1": 0}),
    ("a shrunk ring", {**TURNED, "Geometry/Lower corner": "1, 0", "Geometry/Upper corner": "2, 1", "Boundary top/Pressure": None,
                       "Material/Initial strain": "0.01; 0; 0; 0.01"}, {"von_mises.largest": 0}),
    ("a cylinder under a plate", {**TURNED, "Boundary top/Pressure": None, "Boundary top/Rigid": "true",
                                  "Boundary top/Force": "free; -3"},
     {"plates.top.displacement.1": -3 / (10 * math.pi), "forces.bottom.1": 3, "von_mises.largest": 3 / math.pi}),
    ("a heavy pipe", {**TURNED, "Geometry/Lower corner": "1, 0", "Geometry/Upper corner": "2, 1", "Boundary top/Pressure": None,
                      "Material/Density": "2", "Body force/Gravity": "0; -5"}, {"forces.bottom.1": 30 * math.pi}),
    ("a hot cylinder between two plates in time",
     {**TURNED, **HISTORY, "Boundary top/Pressure": None, "Boundary top/Displacement": "free; 0", "Material/Thermal expansion": "0.001",
      "Temperature/Expression": "100*t"},
     {"loading.stored_energy": 0.5 * 0.1 * math.pi, "forces.bottom.1": math.pi, "von_mises.largest": 1}),
    ("heat in time", {**HOT, **HISTORY, "Temperature/Expression": "100*t"},
     {"loading.stored_energy": 0, "loading.work": 0, "von_mises.largest": 0}),
    ("free expansion in plane strain in time",
     {**HOT, **HISTORY, "Temperature/Expression": "100*t", "Material/Plane": "strain", "Material/Poisson's ratio": "0.3"},
     {"loading.stored_energy": 0.5 * 10 * 0.1 ** 2 * 2, "loading.work": 0.5 * 10 * 0.1 ** 2 * 2, "forces.left.0": 0}),
    ("heat between two walls in time",
     {**HOT, **HISTORY, "Temperature/Expression": "100*t", "Boundary right/Displacement": "0; free", "Material/Thickness": "3"},
     {"loading.stored_energy": 3 * 0.5 * 0.1 * 1 * 2, "loading.work": 3 * 0.5 * 0.1 * 1 * 2, "forces.left.0": 3}),
    ("heat that comes and goes",
     {**HOT, "Loading/Steps": "4", "Temperature/Expression": "100*sin(pi*t)", "Boundary right/Displacement": "0; free"},
     {"loading.stored_energy": 0, "forces.left.0": 0}),
    ("contact along a direction", {**PRESSED, "Boundary bottom/Gap": "0.084"},
     {"contact.bottom.normal_resultant": -2, "contact.bottom.friction_resultant": 0, "forces.bottom.0": -1.2,
      "forces.bottom.1": 1.6, "contact.bottom.largest_penetration": 0, "contact.bottom.through.0": 1, "final.energy": 0.136, "final.estimate": 0}),
    ("a gap along a direction", {**PRESSED, "Boundary bottom/Gap": "0.23", "Boundary left/Traction": None, "Boundary right/Traction": None},
     {"contact.bottom.normal_resultant": 0, "contact.bottom.open_area": 2, "final.energy": 0}),
    ("the same by multipliers", {**PRESSED, "Boundary bottom/Gap": "0.084", "Solver/Normal contact": "multiplier"},
     {"contact.bottom.normal_resultant": -2, "forces.bottom.0": -1.2, "forces.bottom.1": 1.6}),
    ("Tresca's friction along a direction", {**SLIDING, "Boundary bottom/Friction bound": "0.5"},
     {"contact.bottom.normal_resultant": -2, "contact.bottom.friction_resultant": -1, "forces.bottom.0": -2, "forces.bottom.1": 1,
      "final.energy": 0.225 + 0.5 * 2 * 0.15, "final.estimate": 0}),
    ("Coulomb's friction along a direction", {**SLIDING, "Boundary bottom/Friction coefficient": "0.5"},
     {"contact.bottom.normal_resultant": -2, "contact.bottom.friction_resultant": -1, "contact.bottom.slipping_area": 2, "final.estimate": 0}),
    ("friction by pressure along a direction", {**SLIDING, "Boundary bottom/Friction coefficient": "1/(1 + p)"},
     {"contact.bottom.normal_resultant": -2, "contact.bottom.friction_resultant": -1, "contact.bottom.slipping_area": 2, "final.estimate": 0}),
    ("friction by pressure below a bound", {**SLIDING, "Boundary bottom/Friction coefficient": "2/(1 + p)", "Boundary bottom/Friction bound": "0.5",
                                            "Boundary bottom/Friction law": "limited"},
     {"contact.bottom.normal_resultant": -2, "contact.bottom.friction_resultant": -1, "contact.bottom.slipping_area": 2}),
    ("cohesive friction along a direction", {**SLIDING, "Boundary bottom/Friction coefficient": "0.3", "Boundary bottom/Friction bound": "0.2",
                                             "Boundary bottom/Friction law": "cohesive"},
     {"contact.bottom.normal_resultant": -2, "contact.bottom.friction_resultant": -1}),
    ("friction alone along a direction",
     {**OBLIQUE, "Boundary bottom/Contact": "tangential", "Boundary bottom/Friction bound": "0.5", "Boundary top/Displacement": "0.5; -0.2",
      "Boundary left/Traction": "0; -0.4", "Boundary right/Traction": "0; 0.4"},
     {"contact.bottom.friction_resultant": -1, "forces.bottom.0": -0.8, "forces.bottom.1": -0.6, "final.estimate": 0}),
    ("bilateral contact along a direction", {**RUBBED, "Boundary bottom/Contact": "bilateral", "Boundary bottom/Friction bound": "0.5",
                                             "Boundary top/Displacement": f"{1.6 / 3}; 0.2"},
     {"contact.bottom.normal_resultant": -2, "contact.bottom.friction_resultant": -1, "forces.bottom.0": -2, "forces.bottom.1": 1, "final.estimate": 0}),
    ("bilateral contact with Coulomb's law", {**RUBBED, "Boundary bottom/Contact": "bilateral", "Boundary bottom/Friction coefficient": "0.5",
                                              "Boundary top/Displacement": f"{1.6 / 3}; 0.2"},
     {"contact.bottom.normal_resultant": -2, "contact.bottom.friction_resultant": -1}),
    ("a direction in time", {**RUBBED, "Loading/Steps": "2", "Boundary bottom/Contact": "bilateral", "Boundary bottom/Friction bound": "0.5*t",
                             "Boundary top/Displacement": f"{1.6 / 3}*t; 0.2*t", "Boundary left/Traction": "0; -t", "Boundary right/Traction": "0; t"},
     {"contact.bottom.normal_resultant": -2, "contact.bottom.friction_resultant": -1,
      "loading.dissipated_energy": 2 * (0.8 * 1.6 / 3 + 0.6 * 0.2 - 0.13) * (0.25 + 0.5) / 2}),
    ("a frictionless direction between rollers", {**OBLIQUE, "Boundary bottom/Contact": "bilateral", "Boundary left/Displacement": "0; free",
                                                  "Boundary top/Pressure": "1"},
     {"forces.bottom.0": -1.5, "forces.bottom.1": 2, "forces.left.0": 1.5}),
    ("held up by friction along a direction", {**OBLIQUE, "Boundary bottom/Contact": "tangential", "Boundary bottom/Friction bound": "1",
                                               "Boundary left/Displacement": "0; free", "Boundary top/Pressure": "0.1"},
     {"contact.bottom.friction_resultant": 1 / 3, "forces.bottom.1": 0.2, "forces.left.0": -0.8 / 3}),
    ("a slanted side that lies on a level plane", {**OBLIQUE, "Geometry/Upper corner": None, "Geometry/Shape": "quadrilateral",
                                                   "Geometry/Corners": "0, 0; 2, 1; 1.5, 2; -0.5, 1", "Boundary bottom/Contact": "unilateral",
                                                   "Boundary bottom/Contact direction": "0; -1", "Boundary bottom/Friction bound": "1",
                                                   "Body force/Expression": "0; -3"},
     {"contact.bottom.normal_resultant": -3 * 2.5, "contact.bottom.friction_resultant": 0, "contact.bottom.through.0": 0.75}),
    ("at rest on a slope", {**SLOPE, "Boundary bottom/Friction coefficient": "0.76"},
     {"contact.bottom.normal_resultant": -6 * 0.8, "contact.bottom.friction_resultant": 6 * 0.6, "contact.bottom.through.0": 1}),
    ("pressure in time", {**TOP, **HISTORY, "Boundary top/Pressure": "3*t"}, {"forces.bottom.1": 6}),
    ("materials in time", {**LAYERS, **HISTORY, "Boundary right/Displacement": "0.1*t; free"}, {"forces.right.0": 1.0}),
    ("thickness in time", {**LAYERS, **HISTORY, "Boundary right/Displacement": "0.1*t; free", "Material/Thickness": "2"},
     {"loading.stored_energy": 0.1, "loading.work": 0.1}),
    ("materials in space", {**SPACE, "Material stiff/Young's modulus": "30", "Material stiff/Where": "x - 1.25",
                            "Boundary right/Traction": "3; 0; 0", "Boundary bottom/Displacement": "free; 0; free",
                            "Boundary left/Displacement": "0; free; free", "Boundary front/Displacement": "free; free; 0"},
     {"final.energy": -0.5 * 3 * (3 / 10 * 1.25 + 3 / 30 * 0.75), "final.elements": 3}),
    ("weights in space", {**SPACE, "Material/Density": "2", "Material lead/Density": "11", "Material lead/Where": "x - 1",
                          "Body force/Gravity": "0; -3; 0"}, {"forces.bottom.1": 3 * (2 + 11)}),
    ("a part in space", {**SPACE, "Boundary top/Pressure": "1", "Boundary foot/On": "top",
                         "Boundary foot/Where": "x > 1", "Boundary foot/Pressure": "z"},
     {"forces.bottom.1": 1 + 0.5}),
    ("friction by pressure in space", {**SPACE, "Boundary bottom/Displacement": None, "Boundary bottom/Contact": "bilateral",
                                       "Boundary bottom/Friction coefficient": "2/(3 + p)", "Boundary top/Displacement": "0.5; free; 0",
                                       "Boundary top/Traction": "0; -1; 0", "Boundary left/Traction": "0; -0.5; 0",
                                       "Boundary right/Traction": "0; 0.5; 0"}, {"forces.bottom.0": -1, "forces.bottom.1": 2}),
    ("symmetry in space", {**SPACE, "Boundary right/Traction": "3; 0; 0", "Boundary bottom/Displacement": None,
                           "Boundary bottom/Symmetry": "true", "Boundary left/Symmetry": "true",
                           "Boundary front/Symmetry": "true"},
     {"final.energy": -0.5 * 3 * 3 / 10 * 2, "forces.left.0": -3, "forces.front.2": 0}),
    ("a block on another", STACK, SQUEEZED),
    ("the same seen from below", {**STACK, "Contact joint/Between": "lower.top, upper.bottom"},
     {**{path.replace("upper.bottom", "lower.top") if path.startswith("contact") else path: value for path, value in SQUEEZED.items()}}),
    ("the same with either slave", {**STACK, "Contact joint/Slave": "lower.top"}, SQUEEZED),
    ("one that slides on another", {**STACK, "Contact joint/Law": "bilateral"}, SQUEEZED),
    ("one that is glued to another", {**STACK, "Contact joint/Law": "tied"}, SQUEEZED),
    ("thick blocks", {**STACK, "Material/Thickness": "0.25"}, {path: value * (0.25 if "through" not in path else 1) for path, value in SQUEEZED.items()}),
    ("a gap in the drawing", {**STACK, "Body upper/Lower corner": "0, 1.01", "Body upper/Upper corner": "2, 2.01",
                              "Boundary upper.top/Displacement": "0; -0.21"}, SQUEEZED),
    ("a gap beside it", {**STACK, "Contact joint/Gap": "0.1", "Boundary upper.top/Displacement": "0; -0.3"},
     {path: value for path, value in SQUEEZED.items() if "energy" not in path}),
    ("interference", {**STACK, "Contact joint/Gap": "-0.2", "Boundary upper.top/Displacement": "0; 0"}, SQUEEZED),
    ("a joint that opens", {**STACK, "Boundary upper.top/Displacement": "0; 0.1"}, {"final.energy": 0, "forces.lower.bottom.1": 0}),
    ("a joint that pulls", {**STACK, "Boundary upper.top/Displacement": "0; 0.2", "Contact joint/Law": "tied"},
     {"final.energy": 0.3, "forces.lower.bottom.1": -3}),
    ("friction of Tresca between blocks", sheared(0.5, Friction_bound="0.5"),
     {"contact.upper.bottom.friction_resultant": -1, "forces.lower.bottom.0": -1, "forces.upper.top.0": 1, "contact.upper.bottom.slipping_area": 2}),
    ("friction of Coulomb between blocks", sheared(0.3, Friction_coefficient="0.2"),
     {"contact.upper.bottom.friction_resultant": -0.6, "forces.lower.bottom.0": -0.6, "contact.upper.bottom.slipping_area": 2}),
    ("a joint that sticks", sheared(1.125, Friction_bound="2"),
     {"contact.upper.bottom.friction_resultant": -2.25, "forces.lower.bottom.0": -2.25, "contact.upper.bottom.slipping_area": 0}),
    ("friction alone", sheared(0.5, Law="tangential", Friction_bound="0.5"), {"forces.lower.bottom.0": -1, "forces.lower.bottom.1": 0}),
    ("three bodies that meet in a corner", CORNER, {"final.energy": CORNER_ENERGY}),
    ("a block on a part of another", {**STACK, "Body lower/Lower corner": "-1, 0", "Body lower/Upper corner": "2.5, 1", "Boundary lower.top/Pressure": "2"},
     {"forces.lower.bottom.1+forces.upper.top.1": 2 * 1.5}),
    ("a block on another on springs", {**STACK, "Boundary lower.bottom/Displacement": None, "Boundary lower.bottom/Spring": "5; 5"},
     {"forces.lower.bottom.1": 2 * 0.6, "final.energy": 0.5 * 2 * 0.6 * 0.2}),
    ("a plate on a block on another", {**STACK, "Boundary upper.top/Displacement": "0; free", "Boundary upper.top/Rigid": "true",
                                       "Boundary upper.top/Force": "free; -3", "Boundary upper.top/Rotation": "0"},
     {"plates.upper.top.displacement.1": -0.2, "final.energy": -0.5 * 3 * 0.2, "contact.upper.bottom.normal_resultant": -3}),
    ("a block of two materials on another", {**STACK, "Body lower/Subdivisions": "3, 2", "Material hard/Where": "0.5 - y", "Material hard/Young's modulus": "20"},
     {"forces.lower.bottom.1": 2 * 0.2 / (0.5 / 10 + 0.5 / 20 + 1 / 30)}),
    ("a block of fibres on another", {**STACK, "Body lower/Material": "wood", "Material wood/Elasticity": "orthotropic", "Material wood/Young's moduli": "40, 5",
                                      "Material wood/Poisson's ratios": "0", "Material wood/Shear moduli": "2, 3, 4"},
     {"forces.lower.bottom.1": 2 * 0.2 / (1 / 5 + 1 / 30)}),
    ("a hot block on a cold one", {**STACK, "Boundary upper.top/Displacement": "free; 0", "Material stiff/Thermal expansion": "0.002", "Temperature/Expression": "50",
                                   "Boundary upper.left/Symmetry": "true"}, {"forces.lower.bottom.1": 2 * 0.1 / (1 / 10 + 1 / 30)}),
    ("blocks, springs, a plate and initial strain in time",
     {**STACK, **HISTORY, "Boundary lower.bottom/Displacement": None, "Boundary lower.bottom/Spring": "5; 5", "Boundary upper.top/Displacement": "0; free",
      "Boundary upper.top/Rigid": "true", "Boundary upper.top/Force": "free; -3*t", "Boundary upper.top/Rotation": "0",
      "Material stiff/Initial strain": "0; 0.1*t; 0", "Contact joint/Friction coefficient": "0.2"},
     {"plates.upper.top.displacement.1": 0.1 - 1.5 * (1 / 5 + 1 / 10 + 1 / 30), "forces.lower.bottom.1": 3}),
    ("a bar that is tightened", BAR, {"pretensions.bar.force": 3, "pretensions.bar.shortening": 0.6, "forces.left.0": -3, "forces.right.0": 3}),
    ("a thick one, cut from the other side", {**BAR, "Material/Thickness": "4", "Pretension bar/Through": "0.7, 0; 0.7, 1"},
     {"pretensions.bar.force": 3, "pretensions.bar.shortening": 0.15, "forces.left.0": -3}),
    ("a bar of two pieces", {**BAR, "Material/Poisson's ratio": "0", "Material stiff/Young's modulus": "30", "Material stiff/Where": "x - 1"},
     {"pretensions.bar.force": 3, "pretensions.bar.shortening": 3 * (1 / 10 + 1 / 30)}),
    ("a layer of two materials", {**BAR, "Material/Poisson's ratio": "0", "Geometry/Subdivisions": "2, 2", "Material stiff/Young's modulus": "30",
                                  "Material stiff/Where": "y - 0.5"},
     {"pretensions.bar.force": 3, "pretensions.bar.shortening": 0.3}),
    ("a bar on a spring", {**SPRUNG, "Boundary right/Traction": "1; 0"}, {"pretensions.bar.force": 3, "pretensions.bar.shortening": 1, "forces.right.0": 2}),
    ("a load on it afterwards: the bar takes its share", {**SPRUNG, **HISTORY, "Boundary right/Traction": "2*t - 1; 0"},
     {"pretensions.bar.force": 3.5, "pretensions.bar.shortening": 1.2, "forces.left.0": -3.5}),
    ("a bar that is hot and tightened", {**BAR, **HISTORY, "Material/Thermal expansion": "0.001", "Temperature/Expression": "100*(2*t - 1)"},
     {"pretensions.bar.force": 2, "pretensions.bar.shortening": 0.6, "forces.left.0": -2}),
    ("a bar that is skew", {**BAR, "Geometry/Shape": "quadrilateral", "Geometry/Upper corner": None, "Geometry/Corners": "0, 0; 1.2, 1.6; 0.4, 2.2; -0.8, 0.6",
                            "Boundary bottom/Displacement": None, "Boundary bottom/Symmetry": "true", "Pretension bar/Through": "-0.2, 1.4; 0.6, 0.8"},
     {"pretensions.bar.force": 3, "pretensions.bar.shortening": 0.6}),
    ("a heavy bar that hangs and is tightened", {**HEAVY, "Boundary left/Displacement": None, "Boundary top/Displacement": "0; 0",
                                                 "Pretension bar/Through": "0, 0.25; 2, 0.25", "Pretension bar/Force": "3"},
     {"pretensions.bar.force": 3, "forces.bottom.1": -3 + 6 * 2 * 0.25, "forces.top.1": 3 + 6 * 2 * 0.75}),
    ("a rod that is tightened", {**TURNED, "Boundary bottom/Displacement": None, "Boundary bottom/Symmetry": "true", "Boundary top/Pressure": None,
                                 "Boundary top/Symmetry": "true", "Geometry/Subdivisions": "2, 2", "Material/Poisson's ratio": "0.3",
                                 "Pretension bar/Through": "1, 0.3; 0, 0.3", "Pretension bar/Force": "3"},
     {"pretensions.bar.force": 3, "pretensions.bar.shortening": 3 / (10 * math.pi), "forces.bottom.1": -3}),
    ("blocks 0.01 apart in the drawing", {**STACK, "Body upper/Lower corner": "0, 1.01", "Body upper/Upper corner": "2, 2.01", "Contact joint/Closed within": "0.01"},
     SQUEEZED),
    ("blocks 0.02 in each other in the drawing",
     {**STACK, "Body upper/Lower corner": "0, 0.98", "Body upper/Upper corner": "2, 1.98", "Contact joint/Closed within": "0.021", "Contact joint/Law": "tied"}, SQUEEZED),
    ("a load on a part of a block on another", {**STACK, "Boundary upper.top/Displacement": None, "Boundary upper.left/Symmetry": "true", "Boundary load/On": "upper.top",
                                                "Boundary load/Where": "0.3 - abs(x - 1)", "Boundary load/Pressure": "4"}, {"forces.lower.bottom.1": 2.4}),
    ("a column of two, squeezed", COLUMN, {"final.energy": 0.5 * 1.5 * 4 * math.pi * 0.2, "forces.lower.bottom.1": 6 * math.pi,
                                           "contact.upper.bottom.normal_resultant": -6 * math.pi, "contact.upper.bottom.area": 4 * math.pi}),
    ("the same with either slave", {**COLUMN, "Contact joint/Slave": "lower.top"}, {"forces.lower.bottom.1": 6 * math.pi}),
    ("a column that is glued", {**COLUMN, "Contact joint/Law": "tied", "Boundary upper.top/Displacement": "free; 0.2"}, {"forces.lower.bottom.1": -6 * math.pi}),
    ("a floating column", {**COLUMN, "Boundary upper.top/Displacement": None, "Boundary upper.top/Pressure": "3"}, {"forces.lower.bottom.1": 12 * math.pi}),
    ("a column with a rigid plate", {**COLUMN, "Boundary upper.top/Displacement": None, "Boundary upper.top/Rigid": "true", "Boundary upper.top/Force": "free; -3"},
     {"plates.upper.top.displacement.1": -3 / (4 * math.pi) * (1 / 10 + 1 / 30), "contact.upper.bottom.normal_resultant": -3}),
    ("a shaft in a hub", {**HUB, "Contact fit/Gap": "-0.01"}, {"contact.shaft.right.normal_resultant": -FIT, "final.energy": 0.5 * 0.01 * FIT}),
    ("the same with either slave", {**HUB, "Contact fit/Gap": "-0.01", "Contact fit/Slave": "shaft.right"}, {"contact.shaft.right.normal_resultant": -FIT}),
    ("the same seen from the hub", {**HUB, "Contact fit/Gap": "-0.01", "Contact fit/Between": "hub.left, shaft.right"},
     {"contact.hub.left.normal_resultant": -FIT}),
    ("a hot shaft in a cold hub", {**HUB, "Material/Thermal expansion": "0.001", "Material hard/Thermal expansion": "0", "Temperature/Expression": "10/1.3"},
     {"contact.shaft.right.normal_resultant": -FIT}),
    ("a shaft that is hot up to the hub", {**HUB, "Material/Thermal expansion": "0.001", "Material hard/Thermal expansion": "0.001",
                                           "Temperature/Expression": "x < 1 ? 10/1.3 : 0"},
     {"contact.shaft.right.normal_resultant": -FIT}),
    ("a shaft that is hot on the joint, too", {**HUB, **HISTORY, "Material/Thermal expansion": "0.001", "Material hard/Thermal expansion": "0.001",
                                               "Temperature/Expression": "x <= 1 ? 10/1.3*t : 0"},
     {"contact.shaft.right.normal_resultant": -FIT}),
    ("a shaft that gets hot in a hub, with friction", {**HUB, **HISTORY, "Material/Thermal expansion": "0.001", "Material hard/Thermal expansion": "0",
                                                       "Temperature/Expression": "10/1.3*t", "Contact fit/Friction coefficient": "0.3", "Adaptivity/Method": "pu"},
     {"contact.shaft.right.normal_resultant": -FIT, "contact.shaft.right.friction_resultant": 0}),
    ("a ring in a ring", RINGS, {"contact.in.outer.normal_resultant": -3 * math.pi * GRIP, "contact.in.outer.friction_resultant": 2 * math.pi * 0.1 / 1.5,
                                 "contact.in.outer.slipping_area": 0}),
    ("the same in time", {**RINGS, "Loading/Steps": "2", "Boundary in.inner/Shear": "0.1*t"},
     {"contact.in.outer.normal_resultant": -3 * math.pi * GRIP, "contact.in.outer.friction_resultant": 2 * math.pi * 0.1 / 1.5}),
    ("symmetry on the primal path", {**BLOCK, "Boundary left/Displacement": None, "Boundary left/Symmetry": "true",
                                     "Boundary right/Traction": "3; 0", "Solver/Path": "primal",
                                     "Solver/Primal tolerance": "1e-12"},
     {"final.energy": -0.5 * 3 * 3 / 10 * 2, "forces.left.0": -3}),
    ("the primal path in the plane", {**PART, **{"Solver/Path": "primal", "Solver/Primal tolerance": "1e-12",
                                                 "Material/Density": "2", "Body force/Gravity": "0; -3",
                                                 "Material stiff/Young's modulus": "30", "Material stiff/Where": "x - 1",
                                                 "Material/Thickness": "0.5"}},
     {"forces.bottom.1": 0.5 * (12 + 2.4)}),
    ("retaining.prm", SCENES / "retaining.prm",
     {"forces.bottom.1": 2.4 * 9.81 * 6, "forces.bottom.0": -9.81 * 4.5, "contact.bottom.friction_resultant": -9.81 * 4.5, "contact.bottom.normal_resultant": -2.4 * 9.81 * 6}),
    ("ballast.prm", SCENES / "ballast.prm", {"forces.bottom.1": 60, "forces.left.0+forces.bottom.0": 0}),
    ("punch-plate.prm", SCENES / "punch-plate.prm",
     {"forces.bottom.0": -20000, "forces.bottom.1": 300000, "contact.bottom.through.0": 70 + 80 * 20 / 300,
      "plates.punch.moment": 0}),
    ("column-base.prm", SCENES / "column-base.prm",  # about (800, 250, 800): the resultant passes through x = z = 850
     {"forces.bottom.force.0": -40000, "forces.bottom.force.1": 400000, "forces.bottom.moment.0": -400000 * 50,
      "forces.bottom.moment.2": 400000 * 50 - 40000 * 250, "plates.base.moment.0": 2e7}),
    ("key.prm", SCENES / "key.prm", {"forces.right.1": -1200, "forces.left.0+forces.right.0+forces.grip.0": 0}),
    ("askew.prm", SCENES / "askew.prm",
     {"contact.bottom.normal_resultant": -1500, "contact.bottom.friction_resultant": -250, "forces.bottom.0": -250, "forces.bottom.1": 1500}),
    ("spruce.prm", SCENES / "spruce.prm",
     {"forces.bottom.0": -2400, "forces.bottom.1": 16000}),
    ("sleeve.prm", SCENES / "sleeve.prm",
     {"forces.right.1": -2 * math.pi * 0.1076923076923077, "forces.left.1": 2 * math.pi * 0.1076923076923077,
      "contact.right.normal_resultant": -4 * math.pi * 0.1794871794871795}),
    ("bolt.prm", SCENES / "bolt.prm", {"forces.shaft.1+forces.bottom.1": -450, "forces.left.0": 0}),
    ("thermal-joint.prm", SCENES / "thermal-joint.prm", {"forces.left.0": 800, "forces.bottom.0": -800, "forces.bottom.1": 4000}),
    ("floor-slab.prm", SCENES / "floor-slab.prm",
     {"forces.bottom.1": 2.4 * 9.81 * 3 * 0.2 * 2.5, "forces.left.0+forces.bottom.0": 0, "forces.front.2+forces.bottom.2": 0}),
    ("footing.prm", SCENES / "footing.prm", {"forces.bottom.1": 200 + 9.81 * 8 * (1.8 * 2.5 + 2.1 * 1.5)}),
    ("plate-hole.prm", SCENES / "plate-hole.prm",
     {"contact.bottom.normal_resultant": -1000, "contact.bottom.friction_resultant": -100, "contact.bottom.through.0": 5}),
    ("bracket.prm", SCENES / "bracket.prm",
     {"contact.sole.normal_resultant": -1200, "contact.sole.friction_resultant": -100, "contact.sole.through.0": 55 + 7000 / 1200}),
    ("roller.prm", SCENES / "roller.prm",
     {"forces.rim.0": 0, "forces.rim.1": 500, "contact.rim.normal_resultant": -500, "plates.flat.moment": 0}),
    ("dovetail.prm", SCENES / "dovetail.prm",
     {"forces.flank.1": -500, "contact.flank.normal_resultant": -500 * 2 ** 0.5 / 1.15,
      "contact.flank.friction_resultant": -0.15 * 500 * 2 ** 0.5 / 1.15, "forces.middle.0": 500 * 0.85 / 1.15}),
    ("brake-shoe.prm", SCENES / "brake-shoe.prm", {"forces.outer.1": -400, "forces.inner.0+forces.outer.0": 0}),
    ("ssnp154.prm", SCENES / "ssnp154.prm",
     {"contact.cylinder.arc (line).force.1": 35000, "forces.block.bottom.1": 35000, "forces.block.bottom.0": 0, "plates.cylinder.flat.moment": 0}),
    ("lug.prm", SCENES / "lug.prm", {"forces.pin.bore.0": -4000, "forces.pin.bore.1": 0, "forces.lug.bore.0": -4000}),
    ("bush.prm", SCENES / "bush.prm",
     {"contact.bush.outer.friction_resultant": 2 * math.pi * 30 * 5 / 2.25,
      "contact.bush.outer.normal_resultant": -2 * math.pi * 0.03 / ((1300 / 500 - 0.34) / 110000 + (2925 / 1125 + 0.3) / 210000)}),
    ("shrink-fit.prm", SCENES / "shrink-fit.prm", {"forces.hub.top.1": -20 * math.pi * 400, "contact.shaft.right (fit).friction_resultant": -20 * math.pi * 400}),
    ("seal.prm", SCENES / "seal.prm",
     {"forces.floor.0+forces.wall.0+forces.shoulder.0": -0.1 * 3 * (1 + 0.5 ** 0.5), "forces.floor.1+forces.crown.1": 0.1 * 3 * (1 - 0.5 ** 0.5),
      "forces.wall.1+forces.shoulder.1+forces.crown.0": 0}),
]


def found(summary, path):
    """The value at a path, or the sum of several; forces by name have x and y."""
    if "+" in path:
        return sum(found(summary, part) for part in path.split("+"))
    value, keys = summary, path.split(".")
    while keys:
        key = keys.pop(0)
        if isinstance(value, dict) and key not in value and not key.isdigit():
            key += "." + keys.pop(0)  # BODY.side
        if isinstance(value, dict) and "force" in value and key.isdigit():
            value = value["force"]
        value = value[int(key)] if isinstance(value, list) else value[key]
    return float(value)


class ByHand(RunTest):
    def test_all_rows(self):
        for name, scene, expected in ROWS:
            with self.subTest(name):
                if isinstance(scene, dict):
                    self.run_settings(scene)
                else:
                    self.run_scene("Adaptivity/Maximum steps=4", scene=scene)
                summary = self.summary()
                for path, value in expected.items():
                    largest = max(abs(value), *(abs(other) for other in expected.values()))
                    self.assertAlmostEqual(found(summary, path), value, delta=1e-8 * largest + 1e-10, msg=path)

    def run_settings(self, settings, **options):
        return self.run_scene("Output/VTU=false", scene=self.written(settings), **options)

    def run_meshed(self, scene, mesh, *circles):
        """Its twin whose body is a mesh of Gmsh, the named boundaries of which are circles."""
        text = re.sub(r"set (Centre|Radii|Radius|Angles?|Subdivisions) .*\n", "", (SCENES / f"{scene}.prm").read_text())
        text = re.sub(r"(set Shape +=) .*", rf"\1 file\nset File = {SCENES}/meshes/{mesh}.msh", text)
        file = self.home / f"{scene}.prm"
        file.write_text(text + "".join(f"subsection Boundary {name}\nset Curve = circle\nend\n" for name in circles))
        self.run_scene("Output/VTU=false", scene=file)
        return self.summary()

    def run_shipped(self, scene, *settings):
        self.run_scene("Output/VTU=false", *settings, scene=SCENES / f"{scene}.prm")
        return self.summary()

    def forces(self):
        """By step, kind and name."""
        return {(int(row["step"]), row["kind"], row["name"]): row for row in self.rows("forces.csv")}

    def test_forces_of_a_part_beside_loads(self):
        """Contact and weight, a pressure on the same boundary, a support; about the centre (1, 0.5)."""
        self.run_settings({**HEAVY, "Boundary bottom/Displacement": None, "Boundary bottom/Contact": "bilateral",
                           "Boundary bottom/Traction": "0; 0.5", "Boundary foot/On": "top", "Boundary foot/Where": "x - 1",
                           "Boundary foot/Pressure": "1", "Material/Thickness": "3", "Adaptivity/Start degree": "3"})
        forces = self.forces()
        self.assertEqual(set(forces), {(1, "support", "left"), (1, "contact", "bottom"), (1, "load", "bottom"),
                                       (1, "load", "foot"), (1, "load", "body force")})
        for (_, kind, name), fx, fy, moment in (((1, "load", "bottom"), 0, 3, 0), ((1, "load", "foot"), 0, -3, -1.5),
                                                ((1, "load", "body force"), 0, -36, 0)):
            row = forces[1, kind, name]
            for column, value in (("Fx", fx), ("Fy", fy), ("M", moment)):
                self.assertAlmostEqual(float(row[column]), value, delta=1e-11, msg=(name, column))
            self.assertEqual((row["normal"], row["friction"], row["load_step"], row["t"]), ("",) * 4)
        contact = forces[1, "contact", "bottom"]
        self.assertAlmostEqual(float(contact["Fy"]), 36, delta=1e-9)
        self.assertAlmostEqual(float(contact["normal"]), -36, delta=1e-6)
        self.assertAlmostEqual(float(contact["friction"]), 0, delta=1e-9)
        for column in ("Fx", "Fy", "M"):
            self.assertAlmostEqual(sum(float(row[column]) for row in forces.values()), 0, delta=1e-9)
        self.assertEqual({row["Fy_bound"] for key, row in forces.items() if key[1] == "load"}, {""})
        self.assertLess(float(contact["Fy_bound"]), 1e-6)  # statics

    def test_forces_of_both_sides_of_a_pair(self):
        """In each side's own frame tractions are the same; forces are opposite. Of a history each load step has its rows."""
        self.run_settings({**sheared(0.6, Friction_bound="0.6"), "Error/Bound": "false", "Loading/Steps": "2", "Boundary upper.top/Displacement": "0.3*t; -0.2*t"})
        forces = self.forces()
        steps = {step for step, _, _ in forces}
        for step in steps:
            upper, lower = (forces[step, "contact", side] for side in ("upper.bottom", "lower.top"))
            for column in ("Fx", "Fy"):
                self.assertAlmostEqual(float(upper[column]), -float(lower[column]), delta=1e-10)
            for column in ("normal", "friction"):
                self.assertEqual(upper[column], lower[column])
            self.assertAlmostEqual(sum(float(row["Fx"]) for key, row in forces.items() if key[0] == step), 0, delta=1e-9)
        self.assertEqual({(row["load_step"], row["t"]) for row in forces.values()}, {("1", "0.5"), ("2", "1")})
        last = forces[max(steps), "contact", "upper.bottom"]
        self.assertAlmostEqual(float(last["normal"]), -3, delta=1e-9)
        self.assertAlmostEqual(abs(float(last["friction"])), 1.2, delta=1e-9)

    def test_forces_around_an_axis_and_in_space(self):
        self.run_settings(TURNED)
        row = self.forces()[1, "load", "top"]
        self.assertEqual((row["Fx"], row["M"]), ("", ""))
        self.assertAlmostEqual(float(row["Fy"]), -3 * math.pi, delta=1e-9)
        self.run_settings({**SPACE, "Boundary top/Pressure": "2"})
        bottom, top = self.forces()[1, "support", "bottom"], self.forces()[1, "load", "top"]
        for column, value in (("Fx", 0), ("Fy", -4), ("Fz", 0), ("Mx", 0), ("My", 0), ("Mz", 0)):
            self.assertAlmostEqual(float(top[column]), value, delta=1e-10, msg=column)
            self.assertAlmostEqual(float(bottom[column]), -value, delta=1e-9, msg=column)

    def test_wood_across_its_growth_rings(self):
        """Without friction the stress is uniform, by the compliance along y in closed form; friction adds to it."""
        E, nu, G = (11600, 900, 500), {(0, 1): 0.37, (0, 2): 0.47, (1, 2): 0.43}, {(0, 1): 750, (0, 2): 720, (1, 2): 39}
        c, s = math.cos(math.radians(10)), math.sin(math.radians(10))
        length = math.hypot(s, c, c)  # of (c, s, 0) x (0, 1, 1) = (s, -c, c), which is along axis 3
        y = (s, c * c / length, -c / length)  # by its components along the axes
        compliance = sum(y[i] ** 4 / E[i] for i in range(3)) \
            + sum((y[i] * y[j]) ** 2 * (1 / G[i, j] - 2 * nu[i, j] / E[i]) for i, j in nu)
        smooth = found(self.run_shipped("growth-rings", "Adaptivity/Maximum steps=1", "Boundary bottom/Friction coefficient="), "forces.top.1")
        self.assertAlmostEqual(smooth, -0.01 / compliance * 2500, delta=1e-5)
        rough = found(self.run_shipped("growth-rings", "Adaptivity/Maximum steps=2"), "forces.top.1")
        self.assertAlmostEqual(rough / smooth, 1.08, delta=0.005)

    def test_a_line_through_a_hole(self):
        """Uniform stress along a line, of each step; where the line leaves the body fields are empty."""
        line = {"Probe my cut/From": "0, 0.25", "Probe my cut/To": "2, 0.75", "Probe my cut/Points": "5"}
        self.run_settings({**PROBED, **line, "Adaptivity/Method": "pu", "Adaptivity/Maximum steps": "2", "Adaptivity/Tolerance": "0"})
        self.assertIn("probe-my cut-01.csv", self.files())
        rows = self.rows("probe-my cut-01.csv")
        self.assertEqual(len(rows), 5)
        for k, row in enumerate(rows):
            x, y = 0.5 * k, 0.25 + 0.125 * k
            for column, value in (("x", x), ("y", y), ("ux", STRETCH * x), ("uy", SQUEEZE * y), ("s_xx", 3), ("s_yy", 0),
                                  ("s_xy", 0), ("s1", 3), ("s2", 0), ("szz", 0.75)):
                self.assertAlmostEqual(float(row[column]), value, delta=1e-10, msg=column)
        self.run_shipped("plate-hole", "Adaptivity/Maximum steps=1", "Output/Steps=last", "Probe cut/From=-40, 10",
                         "Probe cut/To=40, 90", "Probe cut/Points=3")
        self.assertEqual([row["ux"] == "" for row in self.rows("probe-cut-01.csv")], [False, True, False])
        self.assertNotIn("probe-my cut-01.csv", self.names())

    def test_a_propped_cantilever(self):
        """Beam theory, which a deep end and shear leave half a percent from."""
        summary = self.run_shipped("propped")
        final = summary["final"]
        force = 3 * 210000 * 1000 / 12 / 200 ** 3 * (0.05 * 200 ** 4 / (8 * 210000 * 1000 / 12) - 0.3)
        self.assertAlmostEqual(summary["contact"]["prop"]["normal_resultant"] / -force, 1, delta=0.03)
        self.assertAlmostEqual(final["end_uy"], -0.3, delta=0.01)
        last = self.rows(f"probe-root-{int(final['step']):02}.csv")
        moment = 0.05 * 190 ** 2 / 2 + summary["contact"]["prop"]["normal_resultant"] * 190
        self.assertAlmostEqual(float(last[-1]["s_xx"]) / (6 * moment / 100), 1, delta=0.02)
        self.assertAlmostEqual(float(last[0]["s_xx"]) / (-6 * moment / 100), 1, delta=0.02)
        self.assertEqual(float(last[10]["y"]), 5)

    def test_a_tolerance_without_an_interval(self):
        """The run says why, and ends by another limit."""
        said = self.run_settings({**PROBED, "Adaptivity/Tolerance on": "tip", "Adaptivity/Tolerance": "0.1"})
        self.assertIn("tip has no guaranteed interval, because a value at a point has none; give the probe a Size", said)
        self.assertNotIn("Adaptivity/Tolerance\n", said)

    def test_a_bush_in_a_bore(self):
        """Lame and pure torsion, the body a shape and a mesh: all of it exponentially close at degree 10."""
        E, nu, a, b, gap, s = 210000, 0.3, 20, 30, 0.03, 20
        p = E * gap / b * (b * b - a * a) / ((1 - nu) * b * b + (1 + nu) * a * a)
        energy = math.pi * b * p * gap - math.pi * s * s * a ** 4 * (1 / a ** 2 - 1 / b ** 2) * (1 + nu) / E
        for summary in (self.run_shipped("press-ring"), self.run_meshed("press-ring", "ring", "inner", "outer")):
            contact, final = summary["contact"]["outer"], summary["final"]
            self.assertAlmostEqual(contact["normal_resultant"], -2 * math.pi * b * p, delta=1e-11 * 2 * math.pi * b * p)
            self.assertAlmostEqual(contact["friction_resultant"], 2 * math.pi * a * a * s / b, delta=1e-8)
            self.assertAlmostEqual(contact["largest_pressure"], p, delta=1e-8 * p)
            self.assertAlmostEqual(final["energy"], energy, delta=1e-11 * energy)
            self.assertEqual(contact["slipping_area"], 0)

    def test_pictures_of_a_ring_are_round(self):
        """Points of the VTU lie between Lame's circles and have his displacements and stresses."""
        self.run_scene(scene=self.written({
            "Geometry/Shape": "ring sector", "Geometry/Subdivisions": "2, 4", "Material/Young's modulus": "10",
            "Material/Poisson's ratio": "0.3", "Boundary start/Symmetry": "true", "Boundary end/Symmetry": "true",
            "Boundary inner/Pressure": "1", "Adaptivity/Method": "pu", "Adaptivity/Start degree": "8",
            "Adaptivity/Maximum steps": "1"}))
        grid = read_vtu(self.out / "solution-01.vtu")
        radii = [math.hypot(x, y) for x, y, _ in grid["points"]]
        self.assertAlmostEqual(min(radii), 1, delta=1e-12)
        self.assertAlmostEqual(max(radii), 2, delta=1e-12)
        for (x, y, _), r, u, sxx, syy in zip(grid["points"], radii, grid["displacement"], grid["sigma_xx"], grid["sigma_yy"]):
            self.assertAlmostEqual((u[0] * x + u[1] * y) / r, 0.13 * (0.4 / 3 * r + 4 / 3 / r), delta=1e-6)
            self.assertAlmostEqual(sxx + syy, 2 / 3, delta=1e-4)

    def test_a_spherical_ring(self):
        """u_R = A R + B/R^2, all of whose energy is that of the interference."""
        E, nu, a, b, gap = 210000, 0.3, 30, 40, 0.02
        B = -gap / (2 * (1 - 2 * nu) / (1 + nu) * b / a ** 3 + 1 / b ** 2)
        p, area = 2 * E * B / (1 + nu) * (1 / b ** 3 - 1 / a ** 3), 2 * math.pi * b * 2 * b * math.sin(math.radians(30))
        summary = self.run_shipped("press-ring-axi")
        contact, final = summary["contact"]["outer"], summary["final"]
        self.assertAlmostEqual(contact["normal_resultant"], -p * area, delta=1e-10 * p * area)
        self.assertAlmostEqual(contact["largest_pressure"], p, delta=1e-8 * p)
        self.assertAlmostEqual(final["energy"], p * gap * area / 2, delta=1e-10 * p * gap * area / 2)

    def test_a_roller(self):
        """Hertz's pressure to (b/R)^2, the ends of his contact as far as a node away; and two meshes. Their energies differ by their
        errors: those are the squares of errors in energy norm, relative to which the indicator says 6e-4 and 4e-4."""
        b = (4 * 500 * 10 * (1 - 0.3 ** 2) / (math.pi * 210000)) ** 0.5
        summaries = self.run_shipped("roller"), self.run_meshed("roller", "half-disc", "arc")
        energies = [summary["final"]["energy"] for summary in summaries]
        self.assertAlmostEqual(*energies, delta=1e-7 * abs(energies[0]))
        for summary in summaries:
            contact = summary["contact"]["rim"]
            self.assertAlmostEqual(contact["largest_pressure"], 2 * 500 / (math.pi * b), delta=(b / 10) ** 2 * 2 * 500 / (math.pi * b))
            self.assertAlmostEqual(contact["area"] - contact["open_area"], 2 * b, delta=0.005 * 2 * b)

    def test_a_brake_shoe(self):
        """The lining slips everywhere: friction is 0.35 times the pressure, and its torque about the drum's centre has the arm 100. The
        arc is a polynomial on each edge, so its points are at that distance, and its normals radial, as far as degree 6 goes."""
        outer = self.run_shipped("brake-shoe", "Adaptivity/Start degree=6", "Adaptivity/Maximum steps=2")["contact"]["outer"]
        torque = outer["through"][0] * outer["force"][1] - outer["through"][1] * outer["force"][0]
        friction = outer["friction_resultant"]
        self.assertAlmostEqual(friction, 0.35 * outer["normal_resultant"], delta=1e-9 * abs(friction))
        self.assertAlmostEqual(torque, 100 * friction, delta=1e-9 * abs(100 * friction))

    def test_blocks(self):
        """What two discretisations of another program agree on; J to its indicator."""
        summary = self.run_shipped("blocks")
        contact, final = summary["contact"]["upper.bottom"], summary["final"]
        self.assertAlmostEqual(final["lagrangian"], 0.004281503947, delta=2e-12)
        self.assertAlmostEqual(contact["normal_resultant"], -0.27349126, delta=2e-8)
        self.assertAlmostEqual(contact["friction_resultant"], -0.09761887, delta=2e-8)
        self.assertEqual([zone["state"] for zone in contact["zones"]], ["stick", "slip", "stick"])
        self.assertAlmostEqual(contact["zones"][1]["from"][0], 0.2823, delta=1e-3)
        self.assertAlmostEqual(contact["zones"][1]["to"][0], 1.8694, delta=3e-3)

    def test_a_laminate(self):
        """Beams know the end of slip to a fourth of their height, and how the end moves to their shear strains."""
        summary = self.run_shipped("laminate")
        zones = summary["contact"]["upper.bottom"]["zones"]
        self.assertEqual([zone["state"] for zone in zones], ["slip", "stick"])
        self.assertAlmostEqual(zones[0]["to"][0], 90, delta=1)
        self.assertAlmostEqual(summary["plates"]["lower.right"]["displacement"][1], -0.8547, delta=0.0047)
        self.assertIsNone(summary["no_error_bound"])
        self.assertLess(summary["final"]["error_bound_relative"], 1e-4)

    def test_a_glued_joint(self):
        """One body of two materials has its energy in a guaranteed interval."""
        summary = self.run_shipped("glued")
        self.assertAlmostEqual(summary["final"]["energy"], 873.04001, delta=5e-6)
        # Whichever side is named first, its corners are said to be singular.
        turned = self.run_shipped("glued", "Contact glue/Between=base.top, block.bottom")["contact"]["base.top"]
        self.assertEqual(len(turned["unbounded_pressure"]), 2)
        self.run_settings({"Geometry/Lower corner": "0, -20", "Geometry/Upper corner": "60, 30", "Geometry/Subdivisions": "6, 5",
                           "Material/Plane": "strain", "Material/Thickness": "20", "Material/Young's modulus": "3000",
                           "Material/Poisson's ratio": "0.38", "Material aluminium/Where": "-y", "Material aluminium/Young's modulus": "70000",
                           "Material aluminium/Poisson's ratio": "0.33", "Boundary bottom/Displacement": "0; 0",
                           "Boundary top/Displacement": "0.05; -0.1", "Adaptivity/Start degree": "3", "Adaptivity/Maximum steps": "14"})
        final = self.summary()["final"]
        self.assertLess(final["energy_low"] - 1e-5, summary["final"]["energy"])
        self.assertLess(summary["final"]["energy"], final["energy_high"] + 1e-5)

    def test_a_stack(self):
        """Each joint carries the weight above it and the force of the wind, 60 * 0.075."""
        contact = self.run_shipped("stack")["contact"]
        for name, weight in (("low.bottom", 104), ("middle.bottom", 64), ("high.bottom", 30)):
            self.assertAlmostEqual(contact[name]["normal_resultant"], -weight, delta=1e-8)
            self.assertAlmostEqual(abs(contact[name]["friction_resultant"]), 4.5, delta=1e-8)

    def test_a_wedge(self):
        """F = 2 N (sin a + mu cos a), tan a = 1/4, with F = 190 and friction of 0.2 that slips all along."""
        contact = self.run_shipped("jaws")["contact"]
        for name, sign in (("wedge.left", 1), ("wedge.right", -1)):
            normal, friction = contact[name]["normal_resultant"], contact[name]["friction_resultant"]
            self.assertAlmostEqual(normal, -95 * math.sqrt(17) / (1 + 4 * 0.2), delta=1e-8)
            self.assertAlmostEqual(abs(friction), 0.2 * abs(normal), delta=1e-8)

    def test_a_lap_joint(self):
        """What slipped stays: the force at the end of a cycle is not that of its beginning, and each cycle takes energy."""
        self.run_shipped("lap-joint")
        rows = self.rows("loading.csv")
        force = {round(20 * float(row["t"])): float(row["force_upper strap.right_x"]) for row in rows}
        self.assertLess(max(abs(value) for value in force.values()), 0.4 * 200)
        self.assertGreater(force[5], 50)
        self.assertLess(force[10], -1)  # back where it was: what has slipped must be pushed
        self.assertLess(force[15], -50)
        last = {name: float(rows[-1][f"{name}_energy"]) for name in ("stored", "dissipated", "released", "unbalanced")}
        self.assertGreater(last["dissipated"], 0.1)
        self.assertAlmostEqual(float(rows[-1]["work"]), sum(last.values()), delta=1e-9)

    def test_a_slope_too_steep(self):
        """tan = 3/4: a coefficient of 0.74 holds 0.74 * 4.8 of the 3.6 along the slope."""
        line = self.run_settings({**SLOPE, "Boundary bottom/Friction coefficient": "0.74"}, status=2)
        self.assertIn("sliding along bottom: the loads push with 3.6, friction resists with 0.74 * 4.8 = 3.552", line)

    def test_a_block_that_turns_on_a_slope(self):
        """Loads of (20, -6) meet the base at x = 1 + 20/12, beyond its end: friction turns the body, too, and no end is blamed. About
        the right end they turn by 20/2 - 6, and with a coefficient above 4/3 friction would pull the base down."""
        line = self.run_settings({**SLOPE, "Boundary bottom/Friction coefficient": "0.8", "Boundary left/Traction": "20; 0"}, status=2)
        self.assertIn("no equilibrium: sliding: the loads turn the body about (2 0) with 4, contact can resist with 0 at most", line)

    def test_a_shaft_pressed_out_of_its_ring(self):
        """A pressure of 1 on a shaft of radius 2 against friction of 0.2 on its side, 3 long."""
        line = self.run_settings({**TURNED, "Geometry/Upper corner": "2, 3", "Boundary bottom/Displacement": None, "Boundary top/Pressure": "1",
                                  "Boundary right/Contact": "bilateral", "Boundary right/Friction bound": "0.2"}, status=2)
        self.assertIn(f"the loads push with {4 * math.pi:.10g}, friction resists with {2 * math.pi * 2 * 3 * 0.2:.10g}", line)

    def test_what_a_direction_leaves_free(self):
        """Along (-d_y, d_x) alone nothing holds the body, whatever its normal."""
        line = self.run_settings({**OBLIQUE, "Boundary bottom/Contact": "bilateral", "Boundary top/Pressure": "1"}, status=1)
        self.assertIn("translation along (1.33333, 1)", line)

    def test_contact_along_the_normal(self):
        """Whoever writes the normal down gets the same bytes, bound included, whatever round-off does to its digits."""
        slanted = {**OBLIQUE, "Geometry/Upper corner": None, "Geometry/Shape": "quadrilateral", "Geometry/Corners": "0, 0; 2, 1; 1.5, 2; -0.5, 1",
                   "Boundary bottom/Contact direction": None, "Boundary bottom/Contact": "unilateral", "Boundary bottom/Friction bound": "0.1",
                   "Boundary top/Displacement": "0.05; -0.1", "Adaptivity/Method": "hpa3", "Adaptivity/Maximum steps": "4"}
        file = self.written(slanted)
        for scene, direction in [(SCENES / "han-6-12-unilateral.prm", "1e-13; -7"), (SCENES / "ssnv128.prm", "0; -1"), (file, "1 + 1e-13; -2")]:
            tables = []
            for settings in ([], [f"Boundary bottom/Contact direction={direction}"]):
                self.run_scene("Adaptivity/Maximum steps=4", "Output/VTU=false", *settings, scene=scene)
                tables.append([(self.out / name).read_bytes() for name in self.names() if name.startswith("contact-")] +
                              [[{name: value for name, value in row.items() if not re.match("seconds|peak_memory", name)} for row in self.rows()]])
            self.assertGreater(len(tables[0]), 1)
            self.assertEqual(*tables)

    def test_a_direction_has_a_bound(self):
        self.run_settings({**SLIDING, "Boundary bottom/Friction bound": "0.5", "Adaptivity/Start degree": "2"})
        self.assertIsNone(self.summary()["no_error_bound"])
        self.assertTrue(all(float(row["error_bound"]) >= 0 for row in self.rows()))

    def test_conditions_at_all_points(self):
        """u . d <= u_0 and p >= 0 at the nodes, one of them with equality; |z| <= mu p; forces balance the loads."""
        curved = {**OBLIQUE, "Boundary bottom/Contact": "unilateral", "Boundary bottom/Gap": "0.05*(x - 1)^2", "Boundary top/Displacement": "0.03; -0.1",
                  "Adaptivity/Method": "hap3", "Adaptivity/Maximum steps": "8", "Material/Poisson's ratio": "0.3"}
        for law, limit in [({}, None), ({"Boundary bottom/Friction coefficient": "0.4"}, 0.4)]:
            self.run_settings({**curved, **law})
            points, summary = self.rows("contact-08.csv"), self.summary()
            modes = {point["state"] for point in points}
            self.assertIn("open", modes)
            self.assertIn("slip", modes)
            for point in points:
                gap, pressure, friction = (float(point[name]) for name in ("gap", "normal_traction", "tangential_traction"))
                x, u_d = float(point["x"]), float(point["normal_displacement"])
                self.assertAlmostEqual(gap, 0.05 * (x - 1) ** 2 - u_d, delta=1e-12)
                self.assertGreater(gap, -2e-4)
                self.assertLessEqual(pressure, 1e-2)
                self.assertLess(abs(pressure * gap), 1e-3)
                if limit:
                    self.assertLessEqual(abs(friction), limit * max(0, -pressure) + 1e-9)
            contact, force = summary["contact"]["bottom"], summary["forces"]["bottom"]["force"]
            self.assertAlmostEqual(0.6 * force[0] - 0.8 * force[1], contact["normal_resultant"], delta=1e-9)
            self.assertAlmostEqual(0.8 * force[0] + 0.6 * force[1], contact["friction_resultant"], delta=1e-9)

    def test_four_times_as_thick(self):
        """Energies and forces four times, norms and bounds twice, what is relative as it was."""
        tables = []
        for thickness in (1, 4):
            self.run_scene("Adaptivity/Maximum steps=2", f"Material/Thickness={thickness}", "Output/VTU=false",
                           scene=SCENES / "footing.prm")
            tables.append(self.rows())
        powers = {"energy": 2, "lagrangian": 2, "slack": 2, "energy_low": 2, "energy_high": 2, "normal_resultant": 2,
                  "friction_resultant": 2, "friction_resultant_x": 2, "error_bound": 1, "bound_stress": 1, "bound_slip": 1,
                  "estimate": 1, "estimate_scaled": 1, "estimate_jumps": 1, "estimate_contact": 1, "energy_norm": 1,
                  "error_bound_relative": 0, "estimate_relative": 0, "elements": 0}
        for thin, thick in zip(*tables):
            for name, power in powers.items():
                value = 2 ** power * float(thin[name])
                self.assertAlmostEqual(float(thick[name]), value, delta=1e-12 * abs(value), msg=name)

    def test_a_cylinder_on_a_block(self):
        """SSNP154: Hertz's largest pressure and width, from which the slope of the cylinder and its finite size differ by little."""
        self.run_scene("Adaptivity/Maximum steps=12", "Output/VTU=false", scene=SCENES / "ssnp154.prm")
        contact = self.summary()["contact"]["cylinder.arc (line)"]
        self.assertAlmostEqual(contact["largest_pressure"] / 3585.36, 1, delta=0.001)
        pressed = [zone for zone in contact["zones"] if zone["state"] != "open"]
        self.assertEqual(len(pressed), 1)
        self.assertAlmostEqual(pressed[0]["length"] / (2 * 6.2146), 1, delta=0.01)

    def test_a_strip_of_two_metals(self):
        """Far from its ends a heated strip bends as Timoshenko says: they cost less than a third of a percent."""
        self.run_scene("Adaptivity/Maximum steps=4", "Output/VTU=false", scene=SCENES / "bimetal.prm")
        plate = self.summary()["plates"]["right"]
        angle = 100 * timoshenko((19e-6 - 1.2e-6) * 60, 1, 100000, 1, 145000)
        self.assertAlmostEqual(plate["rotation"] / -angle, 1, delta=0.003)
        self.assertAlmostEqual(plate["displacement"][1] / (-angle * 50), 1, delta=0.003)

    def test_a_bound_at_a_million_times_the_stiffness(self):
        """u_N has 16 digits, of which the motion of the stiff part takes six or seven: the bound pays for what is left."""
        self.run_settings(
            {"Geometry/Upper corner": "4, 4", "Geometry/Subdivisions": "4, 4", "Material core/Young's modulus": "1e6",
             "Material core/Where": "min(min(x - 1, 3 - x), min(y - 1, 3 - y))", "Boundary left/Symmetry": "true",
             "Boundary bottom/Displacement": "0; 0", "Boundary top/Pressure": "1 + x", "Adaptivity/Maximum steps": "8"})
        rows = self.rows()
        self.assertTrue(all(row["error_bound"] for row in rows), [row["bound_imbalance"] for row in rows])
        self.assertGreater(max(float(row["bound_imbalance"]) for row in rows), 1e-9)  # what is paid for
        for row in rows:
            imbalance, cells, norm = (float(row[name]) for name in ("bound_imbalance", "elements", "energy_norm"))
            if imbalance > 1e-9:
                self.assertGreaterEqual(float(row["bound_oscillation"]), 0.999 * imbalance * cells ** 0.5 * norm)
        least = max(float(row["energy_low"]) for row in rows)
        self.assertLess(least, min(float(row["energy_high"]) for row in rows))


if __name__ == "__main__":
    unittest.main()
