# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes of two half planes under Hertz's pressure 10 (a^2 - x^2)^(1/2), a = 0.7, rubbing with Coulomb's coefficient 0.3, by Muskhelishvili's potentials.
Friction f k (w^2 - x^2)^(1/2) of both widths w = a and w = c is superposed (Cattaneo 1938, Mindlin 1949)."""
import math

A, SLOPE, FRICTION = 0.7, 10, 0.3


def roots(w, y):
    """m and n of the root of (x + i y)^2 - w^2 as texts; one of them by x y over the other, that nothing cancels."""
    q = f"(x^2-{y}^2-{w * w!r})"
    s = f"sqrt({q}^2+4*x^2*{y}^2)"
    n_out = f"((x<0?-1:1)*sqrt(({s}+{q})/2))"
    m_in = f"sqrt(max(0,({s}-{q})/2))"
    return f"({q}>0?x*{y}/{n_out}:{m_in})", f"({q}>0?{n_out}:({m_in}>0?x*{y}/{m_in}:0))"


def field(w, y):
    """A, B, y - m, x - n of the pressure (w^2 - x^2)^(1/2)."""
    m, n = roots(w, y)
    h = f"sqrt((x+{n})^2+({y}+{m})^2)"
    return (f"((x^2-{y}^2-x*{n}+{y}*{m})/2+{w * w / 2!r}*log({h}/{w!r}))", f"(x*{y}-(x*{m}+{y}*{n})/2-{w * w / 2!r}*asin((x+{n})/{h}))",
            f"({y}-{m})", f"(x-{n})")


def displacement(E, nu, above, stick, shift):
    """u of one body: pressure, friction of width a, less friction of width stick."""
    mu, kappa, sign = E / (2 * (1 + nu)), 3 - 4 * nu, 1 if above else -1
    y = "y" if above else "(-y)"
    f = SLOPE / (2 * mu)
    a, b, ym, xn = field(A, y)
    u_x = [f"{f!r}*({(kappa - 1) / 2!r}*{b}+{y}*{xn})"]
    u_y = [f"{-sign * f!r}*({(kappa + 1) / 2!r}*{a}+{y}*{ym})"]
    for w, weight in ((A, sign * FRICTION * f), (stick, -sign * FRICTION * f)):
        if w:
            a, b, ym, xn = field(w, y)
            u_x.append(f"{weight!r}*({(kappa + 1) / 2!r}*{a}-{y}*{ym})")
            u_y.append(f"{sign * weight!r}*({(kappa - 1) / 2!r}*{b}-{y}*{xn})")
    if shift and above:
        u_x.append(repr(shift))
    return f"{'+'.join(u_x)}; {'+'.join(u_y)}"


def scene(path, comment, title, lower, stick, shift, adaptivity):
    moduli = {"upper": (200.0, 0.3), "lower": lower}
    boxes = {"upper": ("-2, 0", "2, 2", "6, 3"), "lower": ("-2, -1", "2, 0", "5, 2")}
    lines = ["# SPDX-License-Identifier: LGPL-2.1-or-later", "# doc/benchmarks/closed_forms.py writes this scene.", "#",
             *(f"# {line}" for line in comment.splitlines()), "", f"set Title     = {title}", "set Dimension = 2", ""]
    for name, (E, nu) in moduli.items():
        lines += [f"subsection Body {name}", *(f"  set {entry} = {value}" for entry, value in zip(("Lower corner", "Upper corner", "Subdivisions"), boxes[name])),
                  f"  set Material = of {name}", "end", "", f"subsection Material of {name}", f"  set Young's modulus = {E!r}", f"  set Poisson's ratio = {nu!r}", "end", ""]
        for side in ("left", "right", "top" if name == "upper" else "bottom"):
            lines += [f"subsection Boundary {name}.{side}", f"  set Displacement = {displacement(E, nu, name == 'upper', stick, shift)}", "end", ""]
    curvature = sum(SLOPE * 2 * (1 + nu) / E * (1 - nu) for E, nu in moduli.values())
    slopes = {name: 2 * (1 + nu) / E * (2 - 4 * nu) for name, (E, nu) in moduli.items()}
    uneven = FRICTION * SLOPE / 4 * (slopes["upper"] - slopes["lower"])
    lifted = f"+{uneven!r}*(abs(x)<{A}?x*sqrt(max(0,{A * A!r}-x^2))/2+{A * A / 2!r}*asin(x/{A}):(x<0?-1:1)*{math.pi * A * A / 4!r})" if uneven else ""
    lines += ["subsection Contact line", "  set Between = upper.bottom, lower.top", f"  set Gap = {curvature / 2!r}*x^2{lifted}",
              f"  set Friction coefficient = {FRICTION}", "end", "", adaptivity]
    path.write_text("\n".join(lines))


def write(scenes, adaptivity):
    scene(scenes / "cattaneo.prm", "Cattaneo and Mindlin: two half planes of one material pressed on each other, a = 0.7, and sheared until |x| < 0.4 sticks.",
          "Two half planes in partial slip", (200.0, 0.3), 0.4, 0.0, adaptivity.format(steps=18))
    scene(scenes / "unlike.prm", "Two half planes of unlike materials that slide on each other everywhere, a = 0.7. Friction lifts one and lowers the other; the gap has a\n"
          "term for that, without which there is no closed form.", "Unlike half planes in full slip", (100.0, 0.2), 0, 0.03, adaptivity.format(steps=18))
