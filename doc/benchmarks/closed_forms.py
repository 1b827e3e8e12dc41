#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes whose sides move, or are loaded, as a closed form of the half space says: `closed_forms.py --write` writes them into
prm/published. No truncation is left then, and the program has to find force and contact to all digits.

Frictionless contact of a half space y > 0 follows from one harmonic function F, F_yy = -p on y = 0 (Barber, Contact Mechanics, 2018,
section 5.1; the plane has the same form):

    2 mu u_y = 2 (1 - nu) F_y - y F_yy,    2 mu u_x = -(1 - 2 nu) F_x - y F_xy.

F is the imaginary part of a function of w = y + i a (of revolution) or of x + i y (plane); its derivatives are written out below.
"""
import argparse
import math
import pathlib

import bodies_that_touch

SCENES = pathlib.Path(__file__).resolve().parents[2] / "prm/published"
E, NU = 200.0, 0.3
MU = E / (2 * (1 + NU))
ADAPTIVITY = """subsection Adaptivity
  set Method             = hpa3
  set Smoothness reading = joint
  set Start degree       = 3
  set Maximum degree     = 12
  set Maximum steps      = {steps}
  set Tolerance          = 0
  set Indicator          = residual
end
"""
BOX = """subsection Geometry
  set Lower corner = 0, 0
  set Upper corner = 2, 2
  set Subdivisions = 4, 4
end

subsection Material
  set Young's modulus = 200
  set Poisson's ratio = 0.3
  set Plane           = {plane}
end
"""


def scene(name, comment, title, parts, steps):
    text = ["# SPDX-License-Identifier: LGPL-2.1-or-later", "# doc/benchmarks/closed_forms.py writes this scene.", "#"]
    text += [f"# {line}" for line in comment.splitlines()]
    text += ["", f"set Title     = {title}", "set Dimension = 2", "", *parts, ADAPTIVITY.format(steps=steps)]
    (SCENES / f"{name}.prm").write_text("\n".join(text))


def boundary(name, **entries):
    lines = [f"  set {entry.replace('_', ' ')} = {value}" for entry, value in entries.items()]
    return "\n".join([f"subsection Boundary {name}", *lines, "end", ""])


def root(real, twice, right):
    """Real and imaginary part of the root of real + i twice, both >= 0; the smaller one without cancellation."""
    size = f"sqrt({real}^2+{twice}^2)"
    if right:
        n = f"sqrt(({size}+{real})/2)"
        return n, f"({twice}/2/{n})", size
    m = f"sqrt(({size}-{real})/2)"
    return f"({twice}/2/{m})", m, size


def flat_punch_plane(x, y, right, P=10.0, a=1.0):
    """Sadowsky's punch: F_y = -(P/pi) Re K, F_x = -(P/pi) (Im K - pi/2), K = ln((s + (s^2 - a^2)^(1/2))/a), s = x + i y."""
    n, m, size = root(f"({x}^2-{y}^2-{a * a!r})", f"(2*{x}*{y})", right)
    c = P / math.pi / (2 * MU)
    u_x = f"{c!r}*({1 - 2 * NU!r}*(atan2({y}+{m},{x}+{n})-pi/2)+{y}*{n}/{size})"
    u_y = f"{c!r}*({y}*{m}/{size}-{2 * (1 - NU)!r}*log((({x}+{n})^2+({y}+{m})^2)/{a * a!r})/2)"
    return f"{u_x}; {u_y}"


def flat_punch_axi(x, y, right, c=1.0, a=1.0):
    """Boussinesq's punch: F = c Im[w ln(R + w) - R], R = (x^2 + w^2)^(1/2); p = c/(a^2 - x^2)^(1/2), P = 2 pi a c. Less its depth."""
    n, m, size = root(f"({x}^2+{y}^2-{a * a!r})", f"({2 * a!r}*{y})", right)
    D = f"(({n}+{y})^2+({m}+{a!r})^2)"
    f = c / (2 * MU)
    u_x = f"{f!r}*{x}/{D}*({y}*({n}*({m}+{a!r})+{m}*({n}+{y}))/{size}-{1 - 2 * NU!r}*({m}+{a!r}))"
    u_y = f"{f!r}*({2 * (1 - NU)!r}*(atan2({m}+{a!r},{n}+{y})-pi/2)+{y}*{m}/{size})"
    return f"{u_x}; {u_y}"


def hertz_axi(x, y, right, k=10.0, a=1.0):
    """Hertz of revolution, punches of radius s summed with the weight k s: p = k (a^2 - x^2)^(1/2), P = 2 pi k a^3/3. Less its depth.
    F_x has 1/x, which is 0 on the axis."""
    n, m, _ = root(f"({x}^2+{y}^2-{a * a!r})", f"({2 * a!r}*{y})", right)
    theta = f"atan2({m}+{a!r},{n}+{y})"
    F_y = f"((({y}^2+{a * a!r})/2-{x}^2/4)*{theta}+{a / 4!r}*{n}-0.75*{y}*{m})"
    F_yy = f"({y}*{theta}-{m})"
    x_F_x = f"({n}^2*{m}-{m}^3/3+{a ** 3 / 3!r}-{y}*({y}*{m}+{a!r}*{n}+{x}^2*{theta})/2)"
    x_F_xy = f"({a!r}*{n}-{y}*{m}-{x}^2*{theta})/2"
    f = k / (2 * MU)
    u_x = f"-{f!r}*({1 - 2 * NU!r}*{x_F_x}+{y}*{x_F_xy})/{x}"
    if not right:
        u_x = f"({x}<1e-9?0:{u_x})"
    u_y = f"{f!r}*({2 * (1 - NU)!r}*({F_y}-{math.pi * a * a / 4!r})-{y}*{F_yy})"
    return f"{u_x}; {u_y}"


def bonded_stress(x, y, P=10.0, a=1.0):
    """s_xx, s_xy, s_yy of a rigid punch that is glued on: Phi = -i P/(2 pi) (s - a)^(-1/2 + i e) (s + a)^(-1/2 - i e), e = ln(3 - 4 nu)/(2 pi),
    s_yy - i s_xy = Phi(s) - Phi(conj s) + 2 i y conj(Phi'(s)), s_xx + s_yy = 4 Re Phi (Muskhelishvili, section 114)."""
    e = math.log(3 - 4 * NU) / (2 * math.pi)
    r1, r2 = f"(({x}-{a!r})^2+{y}^2)", f"(({x}+{a!r})^2+{y}^2)"  # squares
    t1, t2 = f"atan2({y},{x}-{a!r})", f"atan2({y},{x}+{a!r})"

    def phi(sign):
        size = f"({P / (2 * math.pi)!r}/({r1}*{r2})^0.25*exp({-sign * e!r}*({t1}-{t2})))"
        angle = f"({-sign * 0.5!r}*({t1}+{t2})+{e / 2!r}*log({r1}/{r2})-pi/2)"
        return f"({size}*cos({angle}))", f"({size}*sin({angle}))"

    (re, im), (re_, im_) = phi(1), phi(-1)
    # (-1/2 + i e)/(s - a) + (-1/2 - i e)/(s + a)
    q_re = f"((-0.5*({x}-{a!r})+{e!r}*{y})/{r1}+(-0.5*({x}+{a!r})-{e!r}*{y})/{r2})"
    q_im = f"(({e!r}*({x}-{a!r})+0.5*{y})/{r1}+(-{e!r}*({x}+{a!r})+0.5*{y})/{r2})"
    d_re, d_im = f"({re}*{q_re}-{im}*{q_im})", f"({re}*{q_im}+{im}*{q_re})"
    s_yy = f"({re}-{re_}+2*{y}*{d_im})"
    s_xy = f"(-({im}-{im_}+2*{y}*{d_re}))"
    return f"(4*{re}-{s_yy})", s_xy, s_yy


def flat_punch_with_friction(name, nu, L, levels):
    """The punch of flat_punch_plane with Coulomb's coefficient f = b, b = (1 - 2 nu)/(2 (1 - nu)), on a body of 2 L x L whose sides move as without friction: friction adds
    tractions without resultant, which are felt there like (a/L)^2."""
    global NU, MU
    kept = NU, MU
    NU, MU = nu, E / (2 * (1 + nu))
    field = lambda x, y, right: flat_punch_plane(x, y, right)
    box = BOX.format(plane="strain").replace("2, 2", f"{L}, {L}").replace("4, 4", f"4, 4\n  set Graded towards = 1, 0\n  set Grading levels = {levels}").replace("0.3", repr(nu))
    scene(name, f"A flat rigid punch |x| < 1 with Coulomb's friction f = (1 - 2 nu)/(2 (1 - nu)) on a half plane, nu = {nu}, half of it, cut off at {L}. Spence (1973); Goodman\n"
          "(1962) leaves out that friction changes the pressure, and finds 1/2^(1/2) of the punch to stick.", "Flat punch with friction on a half plane",
          [box, boundary("left", Displacement="0; free"), boundary("right", Displacement=field(str(L), "y", True)), boundary("top", Displacement=field("x", str(L), False)),
           boundary("bottom", Contact="unilateral", Gap="if(x <= 1, 0, 1)", Friction_coefficient=repr((1 - 2 * nu) / (2 * (1 - nu))))], 34)
    NU, MU = kept


def write():
    for name, nu, L, levels in (("spence", 0.3, 64, 4), ("spence-half", 0.3, 32, 3), ("spence-stiff", 0.45, 64, 4)):
        flat_punch_with_friction(name, nu, L, levels)
    sides = lambda field: (boundary("right", Displacement=field("2", "y", True)), boundary("top", Displacement=field("x", "2", False)))
    symmetry = boundary("left", Displacement="0; free")
    scene("punch-plane", "A flat rigid punch |x| < 1 under 10 on a half plane, without friction, half of it: Sadowsky's closed form.",
          "Flat punch on a half plane", [BOX.format(plane="strain"), symmetry, *sides(flat_punch_plane),
                                         boundary("bottom", Contact="unilateral", Gap="if(x <= 1, 0, 1)")], 36)
    scene("punch-axi", "A flat rigid punch x < 1 on a half space, of revolution, without friction: Boussinesq's closed form.",
          "Flat punch on a half space", [BOX.format(plane="axisymmetric"), *sides(flat_punch_axi),
                                         boundary("bottom", Contact="unilateral", Gap="if(x <= 1, 0, 1)")], 36)
    curvature = 2 * (1 - NU) / (2 * MU) * 10 * math.pi / 8
    scene("hertz-axi", "Hertz's contact of a sphere and a half space: p = 10 (1 - x^2)^(1/2) where x < 1, under the gap that belongs to it.",
          "Hertz's contact of revolution", [BOX.format(plane="axisymmetric"), *sides(hertz_axi),
                                            boundary("bottom", Contact="unilateral", Gap=f"{curvature!r}*x^2")], 18)
    right, top = bonded_stress("2", "y"), bonded_stress("x", "2")
    scene("punch-bonded", "A flat rigid punch |x| < 1 under 10, glued to a half plane, half of it; the sides are loaded by the stress of the closed form. The\n"
          "punch is in two parts, so that the force on its inner half can be read.",
          "Glued punch on a half plane", [BOX.format(plane="strain"), symmetry, boundary("right", Traction=f"{right[0]}; {right[1]}"),
                                          boundary("top", Traction=f"{top[1]}; {top[2]}"),
                                          boundary("inner", On="bottom", Where="0.5 - x", Displacement="0; 0"),
                                          boundary("outer", On="bottom", Where="(x - 0.5)*(1 - x)", Displacement="0; 0")], 40)
    bodies_that_touch.write(SCENES, ADAPTIVITY)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--write", action="store_true", required=True)
    parser.parse_args()
    write()
