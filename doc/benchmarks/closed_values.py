# SPDX-License-Identifier: LGPL-2.1-or-later
"""Values of published closed forms: what rows of source/python/hpvi/benchmarks.json have as their reference. The test python.benchmarks compares both."""
import math


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

SMALL_ROLLER, ROLLER = (roller(210000, 70000, 0.3, 50, force) for force in (350, 35000))
SMALL_SPHERES = hertz_spheres(20000, 0.3, 50, 0.04)
# By the names of rows.
VALUES = {
    "nafems-1 p0": ROLLER[1], "nafems-1 p0 small": SMALL_ROLLER[1], "nafems-1 a": ROLLER[0], "nafems-1 a small": SMALL_ROLLER[0],
    "ssnv104 p0 small": SMALL_SPHERES[0], "ssnv104 F small": SMALL_SPHERES[2],
    "hertz force": math.pi * 0.7 * 7 / 2,
    "hertz-axi force": 2 * math.pi * 10 / 3,
    "punch-plane p(1/2)": 10 / math.pi / math.sqrt(0.75),
    "punch-axi force": 2 * math.pi, "punch-axi p(1/2)": 1 / math.sqrt(0.75),
    "punch-bonded inner force": 5 * bonded_inner_force(0.3, 0.5),
    "partial-slip friction": math.pi * 2.1 * (0.49 - 0.16) / 0.7 / 2,
    "cattaneo force": math.pi * 4.9 / 2, "cattaneo friction": 3 * math.pi * (0.49 - 0.16) / 2,
    "unlike force": math.pi * 4.9 / 2, "unlike friction": 0.3 * math.pi * 4.9 / 2,
    "lame-bush p": bush(210000, 0.3, 20, 30, 0.03),
    "lame-sphere p": spherical_ring(210000, 0.3, 30, 40, 0.02),
    "shrink-cylinders p": cylinders(210000, 0.3, 20, 40, 0.02),
    "belt": math.exp(0.3 * math.pi / 2), "belt half": math.exp(0.3 * math.pi / 2),
    "corner exponent": exponent_of_punch(0.3, 0.15),
    "spence c": math.sqrt(0.5), "spence-stiff c": math.sqrt(0.5),
}
