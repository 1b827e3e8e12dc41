# SPDX-License-Identifier: LGPL-2.1-or-later
"""Contact problems with known answers, as a table: what is published, with its digits and source, and how hpvi's scenes of prm/published give it.

    hpvi.benchmarks.table()                       a dictionary for each row
    hpvi.benchmarks.compare({"hertz force": 7.7}) a dictionary for each value: difference, and whether it is within the digits published

`./run published` solves the scenes, judges each row by its error bar and writes doc/benchmarks.md. All numbers are in the units of the row. Where a row has a
formula its `equation` says which; those that no formula and no print has are `own` cases: two discretisations of hpvi agree on them.

benchmarks.json has the rows: `reference` is a text with the digits of the source, or the number of a closed form (doc/benchmarks/closed_values.py); `own` value and half-width of an own case,
which `./run published` writes; `differs` one of its reasons, or what is true of this row alone; `shown_by` the row of a run that shows why this one differs, and `shows`
the other way round; `entries` what this row sets in the scene; `read` what of a result it is, as a function of doc/published.py with its arguments."""
import json
import pathlib
from collections import namedtuple

Row = namedtuple("Row", "name scene quantity unit read source reference own equation differs shown_by shows entries", defaults=(None, (None, None), "", "", "", "", {}))
DATA = json.loads(pathlib.Path(__file__).with_name("benchmarks.json").read_text(encoding="utf-8"))
SOURCES = DATA["sources"]
TOLERANCES = DATA["tolerances"]  # relative ones that a source itself gives its values: MARC, Abaqus and code_aster differ by up to 2.9 % in SSNP154
TWINS = DATA["twins"]  # scenes that a second discretisation, or a scene that is cut off nearer, solves, too: the bar is twice what both differ by
ROWS = [Row(**{**row, "differs": DATA["reasons"].get(row.get("differs"), row.get("differs", ""))}) for row in DATA["rows"]]


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
