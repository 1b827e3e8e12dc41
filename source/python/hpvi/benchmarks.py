# SPDX-License-Identifier: LGPL-2.1-or-later
"""Contact problems with known answers, as a table: what is published, with its digits and source, and how hpvi's scenes of prm/published give it.

    hpvi.benchmarks.table()                       a dictionary for each row
    hpvi.benchmarks.compare({"hertz force": 7.7}) a dictionary for each value: difference, and whether it is within the digits published

`./run published` solves the scenes, judges each row by its error bar and writes doc/benchmarks.md. All numbers are in the units of the row. Where a row has a
formula its `equation` says which; those that no formula and no print has are `own` cases: two discretisations of hpvi agree on them."""
import math
from collections import namedtuple

SOURCES = {
    "V6.04.128": "code_aster, Validation manual V6.04.128, SSNV128 (results of GRECO, averaged over programs, tolerance 5 %)",
    "SSNP154": "code_aster, V6.03.154, SSNP154 and astest/ssnp154d.comm; A. Konter, Advanced Finite Element Contact Benchmarks, FENET-UNOTT-DLE-09, 2005, and NAFEMS 2006",
    "SSNA122": "code_aster, V6.01.122, SSNA122 and astest/ssna122b.comm; A. Konter, Advanced Finite Element Contact Benchmarks, FENET-UNOTT-DLE-09, 2005, and NAFEMS 2006",
    "SSNP156": "code_aster, V6.03.156, SSNP156 and astest/ssnp156a.com1; A. Konter, Advanced Finite Element Contact Benchmarks, FENET-UNOTT-DLE-09, 2005, and NAFEMS 2006",
    "CGS-4": "NAFEMS, benchmark CGS-4 of the set of contact and gap elements, as FrontISTR states it; statics",
    "V6.04.104": "code_aster, V6.04.104, SSNV104, by Hertz's theory; H. Hertz, doi:10.1515/crll.1882.92.156",
    "V6.03.121": "code_aster, V6.03.121, SSNP121; N. El-Abbasi, K. J. Bathe, doi:10.1016/S0045-7949(01)00048-7",
    "SSNP170": "code_aster, astest/ssnp170a.comm, SSNP170",
    "V6.04.167": "code_aster, V6.04.167, SSNV167",
    "V6.04.503": "code_aster, V6.04.503, SSNV503",
    "Hertz": "H. Hertz, doi:10.1515/crll.1882.92.156; K. L. Johnson, Contact Mechanics, 1985, (4.43) to (4.45) and (4.22) to (4.24)",
    "Sadowsky": "M. Sadowsky, Z. angew. Math. Mech. 8 (1928) 107; K. L. Johnson, Contact Mechanics, 1985, (2.64)",
    "Boussinesq": "J. Boussinesq, 1885; I. N. Sneddon, doi:10.1016/0020-7225(65)90019-4",
    "Muskhelishvili": "N. I. Muskhelishvili, Some Basic Problems of the Mathematical Theory of Elasticity, section 114",
    "Mindlin": "C. Cattaneo, Rend. Accad. Lincei 27 (1938) 342; R. D. Mindlin, J. Appl. Mech. 16 (1949) 259; K. L. Johnson, 1985, (7.27), (7.28)",
    "Spence": "D. A. Spence, Proc. Camb. Phil. Soc. 73 (1973) 249; L. E. Goodman, J. Appl. Mech. 29 (1962) 515",
    "Lame": "G. Lame, 1852; S. Timoshenko, J. N. Goodier, Theory of Elasticity, section 28",
    "Euler": "L. Euler, 1775; J. A. Eytelwein, 1808",
    "Dundurs": "J. Dundurs, M. S. Lee, J. Elasticity 2 (1972) 109; M. Comninou, Z. angew. Math. Phys. 27 (1976) 493",
    "Doersek": "P. Doersek, hp-Finite Element Methods for Variational Inequalities, TU Wien, Examples 5.2 and 5.3, after W. Han, A Posteriori Error Analysis via Duality Theory, Springer 2005",
    "doc/bodies.md": "two discretisations of another program, doc/bodies.md",
    "Keer": "an integral equation, doc/benchmarks/receding_layer.py, after L. M. Keer, J. Dundurs, K. C. Tsai, J. Appl. Mech. 39 (1972) 1115",
    "hpvi": "two discretisations of hpvi",
}

Row = namedtuple("Row", "name scene quantity unit read reference equation source differs shown_by shows entries")


def row(name, scene, quantity, unit, read, reference, source, equation="", differs="", shown_by="", shows="", entries=None):
    """reference: a text has the digits of the source, a number comes from `equation`, None is an own case. shown_by: the row of a run that shows why this one
    differs, and shows: the other way round. entries: what this row sets in the scene."""
    return Row(name, scene, quantity, unit, read, reference, equation, source, differs, shown_by, shows, entries or {})


def bonded_inner_force(nu, share, n=4000):
    """Force on |x| < share a of a glued punch under 1: cos(e v)/cosh(v/2) (3 - 4 nu + 1)/(4 pi (3 - 4 nu)^(1/2)) integrated over v = ln((a + x)/(a - x)), by Simpson's rule."""
    kappa = 3 - 4 * nu
    e, end = math.log(kappa) / (2 * math.pi), math.log((1 + share) / (1 - share))
    values = [math.cos(e * v) / math.cosh(v / 2) for v in (end * k / n for k in range(n + 1))]
    integral = end / n / 3 * (values[0] + values[-1] + 4 * sum(values[1:-1:2]) + 2 * sum(values[2:-1:2]))
    return 2 * integral * (1 + kappa) / (4 * math.pi * math.sqrt(kappa))


def exponent_of_punch(nu, friction):
    """p ~ r^-s at the edge of a rigid punch on a half plane that slips outward beneath it: tan(pi s) = 1/(f b), b = (1 - 2 nu)/(2 (1 - nu))."""
    return 0.5 - math.atan(friction * (1 - 2 * nu) / (2 * (1 - nu))) / math.pi


def cylinders(E, nu, inner, outer, depth):
    """Pressure of a hub of the radii inner, outer on a solid shaft, depth too narrow in radius, in plane strain."""
    return E / (1 - nu * nu) * depth * (outer ** 2 - inner ** 2) / (2 * inner * outer ** 2)


def bush(E, nu, inner, outer, depth):
    """Pressure of a ring in a rigid bore depth too narrow in radius, in plane stress."""
    return E * depth / outer * (outer ** 2 - inner ** 2) / ((1 - nu) * outer ** 2 + (1 + nu) * inner ** 2)


def spherical_ring(E, nu, inner, outer, depth):
    """Pressure of a spherical shell in a rigid seat depth too narrow in radius: u = A R + B/R^2."""
    B_over_A = inner ** 3 * (1 + nu) / (2 * (1 - 2 * nu))
    B = depth * B_over_A / (outer + B_over_A / outer ** 2)
    return 2 * E * B / (1 + nu) * (1 / inner ** 3 - 1 / outer ** 3)


def wedge(slope, friction):
    return (slope + friction) / (1 - friction * slope)


def hertz_spheres(E, nu, radius, approach):
    """Largest pressure, radius of contact, force of two equal spheres brought nearer by `approach`."""
    modulus = E / (1 - nu * nu) / 2
    return 2 / math.pi * modulus * math.sqrt(2 * approach / radius), math.sqrt(radius * approach / 2), 4 / 3 * modulus * math.sqrt(radius / 2) * approach ** 1.5


def roller(E1, E2, nu, radius, force):
    """Half width and largest pressure of a cylinder on a half plane."""
    a = math.sqrt(4 * force * radius * (1 - nu * nu) * (1 / E1 + 1 / E2) / math.pi)
    return a, 2 * force / (math.pi * a)


LARGE = "the source has large deformations, hpvi small ones"
NUMBERS = "The source averages several programs, some with large deformations; hpvi has small ones. Its results in the plane and in space agree"
MESH = "Here M is the point of the foundation on the axis, and its bottom is held. Strains are a thousandth, so large deformations change little. code_aster's linear and \
quadratic cells have -0.130734 and -0.132941 without friction (astest/ssna122a.comm, ssna122b.comm), and hpvi's quadratic cells are as far off. In a trial with CalculiX 2.20, which no command repeats, CAX8 cells \
of 1 mm have -0.1320 in the node on the axis and -0.1335 beside it. Large deformations change that by 0.2 %"
PIN = "The source has large deformations, linear cells and a point force. Its stress is extrapolated to a node, where friction changes its sign. The rows of other coefficients of friction show \
how much friction matters there"
PUNCHES = "The printed value is a stress, extrapolated from cells to the node on the axis. Its mesh is not published. The rows of quadratic cells show how far such a mesh may be off"
ROWS = [
    *(row(f"ssnv128 u{k}", "ssnv128", f"u_x at x = {x}", "um", ("column", f"u{k}_ux", 1e3), text, "V6.04.128", differs=NUMBERS)
      for k, (x, text) in enumerate((("0", "28.6"), ("1.25", "27.2"), ("5", "22.8"), ("7.5", "19.8"), ("11.25", "15.0")), 1)),
    *(row(f"ssnv128-space u{k}", "ssnv128-space", f"u_x at x = {x}", "um", ("column", f"u{k}_ux", 1e3), text, "V6.04.128", differs=NUMBERS)
      for k, (x, text) in enumerate((("0", "28.6"), ("1.25", "27.2"), ("5", "22.8"), ("7.5", "19.8"), ("11.25", "15.0")), 1)),
    row("nafems-1 p0", "nafems-1", "largest pressure", "N/mm^2", ("contact", "block.top", "normal_traction", 0, -1), roller(210000, 70000, 0.3, 50, 35000)[1], "SSNP154",
        "p_0 = 2 F/(pi a), a^2 = 4 F R (1 - nu^2)(1/E_1 + 1/E_2)/pi", "Hertz has half planes; a/R is 0.12 here. With a hundredth of the force it is 0.012, and that row comes nearer", shown_by="nafems-1 p0 small"),
    row("nafems-1 p0 small", "nafems-1", "largest pressure, 350 N/mm", "N/mm^2", ("contact", "block.top", "normal_traction", 0, -1), roller(210000, 70000, 0.3, 50, 350)[1], "SSNP154",
        "the same", shows="nafems-1 p0", entries={"Boundary cylinder.flat/Force": "free; -350"}),
    row("nafems-1 a", "nafems-1", "half width of contact", "mm", ("transition", -1), roller(210000, 70000, 0.3, 50, 35000)[0], "SSNP154", "as above",
        "Hertz has half planes, as above", shown_by="nafems-1 a small"),
    row("nafems-1 a small", "nafems-1", "half width of contact, 350 N/mm", "mm", ("transition", -1), roller(210000, 70000, 0.3, 50, 350)[0], "SSNP154", "as above", shows="nafems-1 a",
        entries={"Boundary cylinder.flat/Force": "free; -350"}),
    row("nafems-1 MARC f uy", "nafems-1-friction", "u_y of the block at x = 0 (B), f = 0.1, MARC", "mm", ("contact", "block.top", "normal_displacement", 0, 1), "-1.3026356448389", "SSNP154",
        differs=LARGE + "; both sources differ from each other by as much"),
    row("nafems-1 aster f uy", "nafems-1-friction", "u_y of the block at x = 0 (B), f = 0.1, code_aster", "mm", ("contact", "block.top", "normal_displacement", 0, 1), "-1.2703109746450325", "SSNP154", differs=LARGE),
    row("nafems-1 MARC f syy", "nafems-1-friction", "s_yy of the block at x = 0 (B), f = 0.1, MARC", "N/mm^2", ("contact", "block.top", "normal_traction", 0, 1), "-3542.6878770218", "SSNP154", differs=LARGE + ". The value is a stress, extrapolated to a node"),
    row("nafems-1 aster f syy", "nafems-1-friction", "s_yy of the block at x = 0 (B), f = 0.1, code_aster", "N/mm^2", ("contact", "block.top", "normal_traction", 0, 1), "-3643.5619389874764", "SSNP154", differs=LARGE + ". The value is a stress, extrapolated to a node"),
    row("nafems-2 uy", "nafems-2", "u_y of the foundation on the axis (M)", "mm", ("contact", "foundation.top", "normal_displacement", 0, 1), "-0.13289744810653", "SSNA122", differs=MESH),
    row("nafems-2 syy", "nafems-2", "s_yy of the foundation on the axis (M)", "N/mm^2", ("contact", "foundation.top", "normal_traction", 0, 1), "-93.626123536884", "SSNA122", differs=PUNCHES),
    *(row(f"nafems-2 uy Q2 {h}", "nafems-2", f"u_y beside M, quadratic cells of {h}", "mm", ("nearest", "foundation.top", "normal_displacement", 0, 1), "-0.13289744810653", "SSNA122",
          shows="nafems-2 uy", entries={"Adaptivity/Method": "hup2", "Adaptivity/Start degree": "2", "Adaptivity/Maximum steps": str(k)}) for k, h in ((1, 10), (2, 5))),
    *(row(f"nafems-2 syy Q2 {h}", "nafems-2", f"s_yy beside M, quadratic cells of {h}", "N/mm^2", ("nearest", "foundation.top", "normal_traction", 0, 1), "-93.626123536884", "SSNA122",
          shows="nafems-2 syy", entries={"Adaptivity/Method": "hup2", "Adaptivity/Start degree": "2", "Adaptivity/Maximum steps": str(k)}) for k, h in ((2, 5), (3, 2.5))),
    row("nafems-2 f uy", "nafems-2-friction", "u_y of the foundation on the axis (M), f = 0.1", "mm", ("contact", "foundation.top", "normal_displacement", 0, 1), "-0.13079352874552", "SSNA122", differs=MESH),
    row("nafems-2 f syy", "nafems-2-friction", "s_yy of the foundation on the axis (M), f = 0.1", "N/mm^2", ("contact", "foundation.top", "normal_traction", 0, 1), "-95.473963617886994", "SSNA122", differs=PUNCHES),
    row("loaded-pin ux", "loaded-pin", "u_x of the sheet at (50, 0)", "mm", ("column", "S_ux", 1), "0.71799091025213", "SSNP156", differs=PIN),
    row("loaded-pin s", "loaded-pin", "s_xx of the sheet at (50, 0)", "N/mm^2", ("column", "S_s2", 1), "-136.67272217658", "SSNP156", differs=PIN),
    *(row(f"loaded-pin {name} f = {f}", "loaded-pin", f"{what} at (50, 0), f = {f}", unit, ("column", column, 1), reference, "SSNP156", shows=f"loaded-pin {name}", entries={"Contact seat/Friction coefficient": f})
      for name, what, unit, column, reference in (("ux", "u_x", "mm", "S_ux", "0.71799091025213"), ("s", "s_xx", "N/mm^2", "S_s2", "-136.67272217658")) for f in ("0", "0.2")),
    *(row(f"cgs-4 f = {f}", "cgs-4", f"F/G, f = {f}", "-", ("force", "left", "support", "Fx", 1 / 40), text, "CGS-4", "F/G = (tan a + f)/(1 - f tan a), tan a = 0.1",
          entries={"Boundary bottom/Friction coefficient": f}) for f, text in (("0", "0.1"), ("0.1", "0.202020"), ("0.2", "0.306122"), ("0.3", "0.412371"))),
    row("ssnv104 p0", "ssnv104", "largest pressure", "N/mm^2", ("contact", "pole", "normal_traction", 0, -1), "2798.33", "V6.04.104", "E (2 h/R)^(1/2)/(pi (1 - nu^2))",
        "Hertz has half spaces; a/R is 0.2 here. With a hundredth of the approach a/R is 0.02, and that row comes nearer", shown_by="ssnv104 p0 small"),
    row("ssnv104 p0 small", "ssnv104", "largest pressure, approach 0.04", "N/mm^2", ("contact", "pole", "normal_traction", 0, -1), hertz_spheres(20000, 0.3, 50, 0.04)[0], "V6.04.104", "the same",
        shows="ssnv104 p0", entries={"Boundary flat/Displacement": "free; -0.02"}),
    row("ssnv104 F", "ssnv104", "force", "N", ("force", "flat", "support", "Fy", -1), "586080.6", "V6.04.104", "4/3 E* (R/2)^(1/2) h^(3/2)", "Hertz has half spaces, as above", shown_by="ssnv104 F small"),
    row("ssnv104 F small", "ssnv104", "force, approach 0.04", "N", ("force", "flat", "support", "Fy", -1), hertz_spheres(20000, 0.3, 50, 0.04)[2], "V6.04.104", "the same", shows="ssnv104 F", entries={"Boundary flat/Displacement": "free; -0.02"}),
    row("ssnp121 p", "ssnp121", "pressure everywhere", "Pa", ("extreme", "upper.bottom", "normal_traction", -1), "100000", "V6.03.121", "E U/H"),
    row("ssnp170 p", "ssnp170", "pressure everywhere", "N/mm^2", ("extreme", "upper.bottom", "normal_traction", -1), "25.0", "SSNP170"),
    row("ssnv167 p", "ssnv167", "pressure everywhere", "N/mm^2", ("extreme", "upper.bottom", "normal_traction", -1), "10000", "V6.04.167", "E 0.1/2"),
    row("ssnv167 uz", "ssnv167", "displacement of the joint", "mm", ("contact", "upper.bottom", "normal_displacement", 1, -1), "-0.1", "V6.04.167"),
    row("ssnv503 slides", "ssnv503", "slides by", "mm", ("column", "pad_ux", 1), "9", "V6.04.503", "(1.01 - 1) f F_n/k"),
    row("ssnv503 friction", "ssnv503", "friction", "N/mm", ("column", "friction_resultant", -1), "3600", "V6.04.503", "f F_n"),
    row("ssnv503 sticks", "ssnv503", "friction where it sticks", "N/mm", ("column", "friction_resultant", -1), "3564", "V6.04.503", "0.99 f F_n",
        entries={"Boundary left/Traction": "178.2; 0"}),
    row("hertz force", "hertz", "force", "N/mm", ("column", "normal_resultant", -1), math.pi * 0.7 * 7 / 2, "Hertz", "pi a p_0/2"),
    row("hertz p0", "hertz", "largest pressure", "N/mm^2", ("contact", "bottom", "normal_traction", 0, -1), 7.0, "Hertz", "p_0"),
    row("hertz a", "hertz", "half width of contact", "mm", ("transition", -1), 0.7, "Hertz", "a"),
    row("hertz-axi force", "hertz-axi", "force", "-", ("column", "normal_resultant", -1), 2 * math.pi * 10 / 3, "Hertz", "2 pi a^2 p_0/3"),
    row("hertz-axi p0", "hertz-axi", "largest pressure", "-", ("contact", "bottom", "normal_traction", 0, -1), 10.0, "Hertz", "p_0"),
    row("hertz-axi a", "hertz-axi", "radius of contact", "-", ("transition", -1), 1.0, "Hertz", "a"),
    row("punch-plane force", "punch-plane", "force on half", "-", ("column", "normal_resultant", -1), 5.0, "Sadowsky", "P/2"),
    row("punch-plane p(1/2)", "punch-plane", "pressure at x = a/2", "-", ("contact", "bottom", "normal_traction", 0.5, -1), 10 / math.pi / math.sqrt(0.75), "Sadowsky", "P/(pi (a^2 - x^2)^(1/2))"),
    row("punch-axi force", "punch-axi", "force", "-", ("column", "normal_resultant", -1), 2 * math.pi, "Boussinesq", "2 pi a c, p = c/(a^2 - r^2)^(1/2)"),
    row("punch-axi p(1/2)", "punch-axi", "pressure at r = a/2", "-", ("contact", "bottom", "normal_traction", 0.5, -1), 1 / math.sqrt(0.75), "Boussinesq", "P/(2 pi a (a^2 - r^2)^(1/2))"),
    row("punch-bonded inner force", "punch-bonded", "force where x < a/2, half", "-", ("force", "inner", "support", "Fy", 1), 5 * bonded_inner_force(0.3, 0.5), "Muskhelishvili",
        "p = 2 (1 - nu) P cos(e ln((a + x)/(a - x)))/(pi (3 - 4 nu)^(1/2) (a^2 - x^2)^(1/2)), e = ln(3 - 4 nu)/(2 pi)"),
    row("partial-slip friction", "partial-slip", "friction", "N/mm", ("column", "friction_resultant", -1), math.pi * 2.1 * (0.49 - 0.16) / 0.7 / 2, "Mindlin", "pi f p_0 (a^2 - c^2)/(2 a)"),
    row("partial-slip c", "partial-slip", "half width of stick", "mm", ("transition", -1), 0.4, "Mindlin", "c/a = (1 - Q/(f P))^(1/2)"),
    row("cattaneo force", "cattaneo", "force", "-", ("column", "normal_resultant", -1), math.pi * 4.9 / 2, "Mindlin", "pi a p_0/2, p_0 = 7"),
    row("cattaneo friction", "cattaneo", "friction", "-", ("column", "friction_resultant", -1), 3 * math.pi * (0.49 - 0.16) / 2, "Mindlin", "f pi p_0 (a^2 - c^2)/(2 a)"),
    row("cattaneo c", "cattaneo", "half width of stick", "-", ("transition", 1), 0.4, "Mindlin", "c/a = (1 - Q/(f P))^(1/2)"),
    row("unlike force", "unlike", "force", "-", ("column", "normal_resultant", -1), math.pi * 4.9 / 2, "Mindlin", "pi a p_0/2"),
    row("unlike friction", "unlike", "friction", "-", ("column", "friction_resultant", -1), 0.3 * math.pi * 4.9 / 2, "Mindlin", "f P, the gap has a term for what friction lifts"),
    row("lame-bush p", "lame-bush", "pressure", "N/mm^2", ("extreme", "outer", "normal_traction", -1), bush(210000, 0.3, 20, 30, 0.03), "Lame", "E (d/b)(b^2 - a^2)/((1 - nu) b^2 + (1 + nu) a^2)"),
    row("lame-sphere p", "lame-sphere", "pressure", "N/mm^2", ("extreme", "outer", "normal_traction", -1), spherical_ring(210000, 0.3, 30, 40, 0.02), "Lame", "u_R = A R + B/R^2"),
    row("shrink-cylinders p", "shrink-cylinders", "pressure", "N/mm^2", ("extreme", "hub.left", "normal_traction", -1), cylinders(210000, 0.3, 20, 40, 0.02), "Lame", "E d (c^2 - b^2)/((1 - nu^2) 2 b c^2)"),
    row("turned-ring p", "turned-ring", "pressure", "-", ("extreme", "outer", "normal_traction", -1), 0.1794871795, "Lame", "u_r = A r + B/r"),
    row("turned-ring slip", "turned-ring", "slip", "-", ("extreme", "outer", "tangential_displacement", 1), 0.078, "Lame", "u_t = C r - K/(2 mu r), |K|/4 = f p"),
    row("belt", "belt", "T_2/T_1", "-", ("force", "end", "support", "Fx", -100), math.exp(0.3 * math.pi / 2), "Euler", "exp(f pi/2)", "The belt is 0.01 of the radius thick, and half as thick it is half as far away", shown_by="belt half"),
    row("belt half", "belt", "T_2/T_1, half as thick", "-", ("force", "end", "support", "Fx", -200), math.exp(0.3 * math.pi / 2), "Euler", "exp(f pi/2)", shows="belt",
        entries={"Geometry/Radii": "1, 1.005", "Geometry/Subdivisions": "1, 64"}),
    row("corner exponent", "corner", "s of p ~ r^-s at the edge", "-", ("exponent", "bottom", "normal_traction", 1), exponent_of_punch(0.3, 0.15), "Dundurs", "tan(pi s) = 2 (1 - nu)/(f (1 - 2 nu))"),
    row("spence c", "spence", "half width of stick over that of the punch", "-", ("transition", 0), math.sqrt(0.5), "Spence", "f K'(c/a) = b K(c/a), b = (1 - 2 nu)/(2 (1 - nu)), K the complete elliptic integral and K' that of the other modulus; f = b here",
        "Goodman's approximation leaves out that friction changes the pressure, by terms of b^2; with b = 0.091 in place of 0.286 it comes nearer", shown_by="spence-stiff c"),
    row("spence-stiff c", "spence-stiff", "the same with nu = 0.45", "-", ("transition", 0), math.sqrt(0.5), "Spence", "as above", shows="spence c"),
    row("han-6-12 J", "han-6-12", "J(u)", "kN", ("energy",), None, "Doersek"),
    row("han-6-12 friction", "han-6-12", "friction", "kN/mm", ("column", "friction_resultant", 1), None, "Doersek"),
    row("han-6-13 J", "han-6-13", "J(u)", "kN", ("energy",), None, "Doersek"),
    row("han-6-13 friction", "han-6-13", "friction", "kN/mm", ("column", "friction_resultant", 1), None, "Doersek"),
    row("block-on-block J", "block-on-block", "J(u)", "-", ("energy",), "0.00166735265", "doc/bodies.md"),
    row("block-on-block N", "block-on-block", "force", "-", ("column", "normal_resultant", -1), "0.166735265", "doc/bodies.md"),
    row("sheared-blocks J", "sheared-blocks", "J(u)", "-", ("energy",), "0.004281503947", "doc/bodies.md"),
    row("sheared-blocks N", "sheared-blocks", "force", "-", ("column", "normal_resultant", -1), "0.27349126", "doc/bodies.md"),
    row("sheared-blocks T", "sheared-blocks", "friction", "-", ("column", "friction_resultant", -1), "0.09761887", "doc/bodies.md"),
    row("glued-blocks J", "glued-blocks", "J(u)", "-", ("energy",), "0.0039624663", "doc/bodies.md"),
    row("glued-blocks N", "glued-blocks", "force", "-", ("column", "normal_resultant", -1), "0.295724", "doc/bodies.md"),
    row("glued-blocks T", "glued-blocks", "friction", "-", ("column", "friction_resultant", -1), "0.1005225", "doc/bodies.md"),
    row("layer c", "layer", "half width of contact over the height", "-", ("transition", -1), 1.0077823991, "Keer", "v'' = 0 where p > 0"),
    row("layer p0", "layer", "pressure in the middle over the load", "-", ("contact", "bottom", "normal_traction", 0, -1), 0.7895881617, "Keer", "v'' = 0 where p > 0"),
    row("space-coulomb Tx", "space-coulomb", "friction along x", "-", ("column", "friction_resultant_x", 1), None, "hpvi"),
    row("space-coulomb Tz", "space-coulomb", "friction along z", "-", ("column", "friction_resultant_z", 1), None, "hpvi"),
    row("space-coulomb My", "space-coulomb", "moment of friction about (1, 0.5, 0.5)", "-", ("force", "bottom", "contact", "My", 1), None, "hpvi"),
    row("space-coulomb Mx", "space-coulomb", "moment of the contact about the x axis there", "-", ("force", "bottom", "contact", "Mx", 1), None, "hpvi"),
    row("space-blocks Tx", "space-blocks", "friction along x", "-", ("column", "friction_resultant_x", 1), None, "hpvi"),
    row("space-blocks Tz", "space-blocks", "friction along z", "-", ("column", "friction_resultant_z", 1), None, "hpvi"),
    row("space-blocks My", "space-blocks", "moment of friction about (1, 0, 0.5)", "-", ("force", "upper.bottom", "contact", "My", 1), None, "hpvi"),
    row("space-blocks Mx", "space-blocks", "moment of the contact about the x axis there", "-", ("force", "upper.bottom", "contact", "Mx", 1), None, "hpvi"),
    row("spence T", "spence", "friction over force, half", "-", ("ratio", "friction_resultant", "normal_resultant", -1), None, "Spence"),
]

# Relative tolerance that a source itself gives its values: MARC, Abaqus and code_aster differ by up to 2.9 % in SSNP154.
TOLERANCES = {"V6.04.128": 0.05, "SSNP154": 0.029}
# Scenes that a second discretisation, or a scene that is cut off nearer, solves, too: the bar is twice what both differ by.
TWINS = {
    "layer": {"Adaptivity/Method": "hpa2", "Geometry/Subdivisions": "18, 3", "Solver/Normal contact": "multiplier", "Adaptivity/Maximum steps": "20"},
    "space-coulomb": {"Geometry/Subdivisions": "6, 3, 3"},
    "space-blocks": {"Body upper/Subdivisions": "5, 3, 3", "Body lower/Subdivisions": "4, 2, 2"},
    "spence": "spence-half",
}
# Of own cases: value and half-width; `./run published` writes these lines.
OWN = {
    "han-6-12 J": (-6.265922117261127, 7.9e-09),
    "han-6-12 friction": (-8.787162758081916, 1.7e-05),
    "han-6-13 J": (-5.891855409754331, 1e-07),
    "han-6-13 friction": (0.6084793925489664, 3.1e-05),
    "space-coulomb Tx": (-0.045952435991363144, 1.1e-08),
    "space-coulomb Tz": (-0.0292682556495345, 2e-08),
    "space-coulomb My": (0.000920361683027616, 4.3e-10),
    "space-coulomb Mx": (0.012010097795295424, 6.8e-08),
    "space-blocks Tx": (-0.04753188385566574, 1.3e-08),
    "space-blocks Tz": (-0.030952494326053577, 2.2e-08),
    "space-blocks My": (0.0010085237581186279, 2e-08),
    "space-blocks Mx": (-0.0009251727711985927, 1.2e-07),
    "spence T": (0.19621942960756353, 1.7e-07),
}


def rounding(text):
    """Half a unit of the last digit."""
    return 0.5 * 10.0 ** -len(text.partition(".")[2])


def table():
    """The rows as dictionaries: name, scene, quantity, unit, value, within (what the digits of the source leave open; of own cases their bar), kind, equation, source."""
    rows = []
    for r in ROWS:
        own = OWN.get(r.name, (None, None))
        kind = "own" if r.reference is None else "printed" if isinstance(r.reference, str) else "closed form"
        value, within = {"own": own, "printed": (float(r.reference or 0), rounding(r.reference or "")) if kind == "printed" else None, "closed form": (r.reference, 0.0)}[kind]
        rows.append({"name": r.name, "scene": f"prm/published/{r.scene}.prm", "entries": dict(r.entries), "quantity": r.quantity, "unit": r.unit, "value": value, "within": within,
                     "kind": kind, "equation": r.equation, "source": SOURCES[r.source]})
    return rows


def compare(values):
    """values: numbers by the names of rows, or pairs of a number and its error bar. A list of dictionaries in their order."""
    known = {r["name"]: r for r in table()}
    found = []
    for name, value in values.items():
        if name not in known:
            raise KeyError(f"no row of hpvi.benchmarks is called {name!r}")
        value, bar = value if isinstance(value, tuple) else (value, 0.0)
        reference, within = known[name]["value"], known[name]["within"]
        difference = None if reference is None else value - reference
        found.append({"name": name, "value": value, "reference": reference, "difference": difference,
                      "relative": None if not reference else difference / abs(reference), "agrees": None if reference is None else abs(difference) <= bar + within + 1e-14 * abs(reference)})
    return found
