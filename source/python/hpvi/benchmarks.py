# SPDX-License-Identifier: LGPL-2.1-or-later
"""Contact problems with known answers, as a table: what is published, with its digits and source, and how hpvi's scenes of prm/published give it.

    hpvi.benchmarks.table()                       a dictionary for each row
    hpvi.benchmarks.compare({"hertz force": 7.7}) a dictionary for each value: difference, and whether it is within the digits published

`./run published` solves the scenes, judges each row by its error bar and writes doc/benchmarks.md. All numbers are in the units of the row. Where a row has a
formula its `equation` says which; those that no formula and no print has are `own` cases: two discretisations of hpvi agree on them.

benchmarks.json has the rows: `reference` is a text with the digits of the source, or a number, where none of FORMS gives it; `own` value and half-width of an own case,
which `./run published` writes; `differs` one of its reasons, or what is true of this row alone; `shown_by` the row of a run that shows why this one differs, and `shows`
the other way round; `entries` what this row sets in the scene; `read` what of a result it is, as a function of doc/published.py with its arguments."""
import json
import math
import pathlib
from collections import namedtuple

Row = namedtuple("Row", "name scene quantity unit read source reference own equation differs shown_by shows entries", defaults=(None, (None, None), "", "", "", "", {}))


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
# Values by the names of rows.
FORMS = {
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

DATA = json.loads(pathlib.Path(__file__).with_name("benchmarks.json").read_text(encoding="utf-8"))
SOURCES = DATA["sources"]
TOLERANCES = DATA["tolerances"]  # relative ones that a source itself gives its values: MARC, Abaqus and code_aster differ by up to 2.9 % in SSNP154
TWINS = DATA["twins"]  # scenes that a second discretisation, or a scene that is cut off nearer, solves, too: the bar is twice what both differ by
ROWS = [Row(**{"reference": FORMS.get(row["name"]), **row, "differs": DATA["reasons"].get(row.get("differs"), row.get("differs", ""))}) for row in DATA["rows"]]


def reference_of(r):
    """Of a row, and half a unit of its last digit where it is printed."""
    if isinstance(r.reference, str):
        return float(r.reference), 0.5 * 10.0 ** -len(r.reference.partition(".")[2])
    return r.reference, 0.0


def table():
    """The rows as dictionaries: name, scene, quantity, unit, value, within (what the digits of the source leave open; of own cases their bar), kind, equation, source."""
    rows = []
    for r in ROWS:
        kind = "own" if r.reference is None else "printed" if isinstance(r.reference, str) else "closed form"
        value, within = r.own if kind == "own" else reference_of(r)
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
