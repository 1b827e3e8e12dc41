#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""contact_tables.py HPVI: contact-01.csv and convergence.csv of uniform stress states, by value.

A block (0,2) x (0,1) with E = 1, nu = 0 under sigma_xy = tau, sigma_yy = -P; a traction G acts on
the contact edge too. There sigma n = (-tau, P) = G + contact, so that the contact's own tractions
are T_n = G_y - P, T_t = -(tau + G_x) = -g lambda.
"""
import csv
import json
import pathlib
import sys
import tempfile

from runs import command, run_program, text_of

BLOCK = {"Dimension": "2", "Geometry/Upper corner": "2, 1", "Geometry/Subdivisions": "2, 1", "Material/Young's modulus": "1",
         "Material/Poisson's ratio": "0", "Adaptivity/Method": "hup3", "Adaptivity/Maximum steps": "1", "Output/VTU": "false"}
CORNER = {"Dimension": "2", "Boundary bottom/Contact": "bilateral", "Boundary bottom/Friction bound": "0.3", "Boundary left/Contact": "bilateral",
          "Boundary left/Friction bound": "0.3", "Boundary top/Traction": "0.1; -1", "Adaptivity/Maximum steps": "2"}


def run(home, scene):
    """The table of contact points, that of steps, the summary, and what is printed."""
    file, out = home / "scene-file.prm", home / "out"
    file.write_text(text_of(scene))
    status, printed, errors = run_program(command(file, out))
    if status:
        sys.exit(errors)
    with open(out / "contact-01.csv") as points, open(out / "convergence.csv") as steps:
        return (list(csv.DictReader(points)), list(csv.DictReader(steps)),
                json.loads((out / "summary.json").read_text()), printed)


def expect(name, value, expected, tolerance=1e-11):
    if not abs(float(value) - expected) <= tolerance:
        sys.exit(f"{name} is {value}, expected {expected}")


def uniform_stress(home, slip, tau, bound, along=0., up=0., pressure=0.2):
    points, steps, _, _ = run(home, {
        **BLOCK, "Boundary top/Displacement": f"{slip} + 2*({tau}); -{pressure}", "Boundary left/Traction": f"0; -({tau})",
        "Boundary right/Traction": f"0; {tau}", "Boundary bottom/Contact": "bilateral", "Boundary bottom/Friction bound": bound,
        "Boundary bottom/Traction": f"{along}; {up}"})
    if len(points) != 4:
        sys.exit(f"{len(points)} rows, expected two Gauss points on each of two edges")
    x = [1 + (edge - 1) + 0.5 + sign * 0.5 / 3 ** 0.5 for edge in (0, 1) for sign in (-1, 1)]
    traction = -(tau + along)
    for point, x_expected in zip(points, x):
        expect("x", point["x"], x_expected)
        expect("y", point["y"], 0)
        expect("normal_displacement", point["normal_displacement"], 0)
        expect("tangential_displacement", point["tangential_displacement"], slip)
        expect("multiplier", point["multiplier"], -traction / bound)
        expect("normal_traction", point["normal_traction"], up - pressure)
        expect("tangential_traction", point["tangential_traction"], traction)
        state = "slip" if slip != 0 else "stick"
        if point["state"] != state:
            sys.exit(f"state is {point['state']}, expected {state}")
    expect("friction_resultant", steps[0]["friction_resultant"], 2 * traction)
    expect("estimate", steps[0]["estimate"], 0)


def unilateral(home, kind):
    """A block pressed down by 0.3 over a gap of 0.1: T_n = -10 (0.3 - 0.1), all of it slips."""
    def pressed(gap):
        return run(home, {**BLOCK, "Material/Young's modulus": "10", "Units/Length": "mm", "Units/Stress": "MPa",
                          "Boundary top/Displacement": "0; -0.3", "Boundary bottom/Contact": "unilateral", "Boundary bottom/Gap": gap,
                          "Solver/Normal contact": kind, "Output/VTU": None})

    points, steps, summary, text = pressed("0.1")
    for point in points:
        expect("normal_displacement", point["normal_displacement"], 0.1)
        expect("gap", point["gap"], 0)
        expect("normal_traction", point["normal_traction"], -2)
        if (point["state"], point["boundary"]) != ("slip", "bottom"):
            sys.exit(f"state is {point['state']} on {point['boundary']}, expected slip on bottom")
    expect("normal_resultant", steps[0]["normal_resultant"], -4)
    for part in ("normal", "penetration", "tension"):
        expect(part, steps[0]["estimate_" + part], 0)
    contact = summary["contact"]["bottom"]
    for name, value in (("force", (0, 4)), ("through", (1, 0))):
        for found, expected in zip(contact[name], value):
            expect(name, found, expected)
    expect("largest_pressure", contact["largest_pressure"], 2)
    expect("von_mises", summary["von_mises"]["largest"], 2)
    if contact["unbounded_pressure"] != [] or summary["von_mises"]["unbounded"] != []:
        sys.exit(f"a uniform stress is unbounded: {contact}, {summary['von_mises']}")
    expect("length", contact["length"], 2)
    expect("zone", contact["zones"][0]["length"], 2)
    if [zone["state"] for zone in contact["zones"]] != ["slip"]:
        sys.exit(f"zones are {contact['zones']}")
    for line in ("contact bottom: force (0 4) through (1 0)", "pressure up to 2 MPa at (",
                 "slip from (0 0) to (2 0), length 2 mm", "support top: force (0 -4), moment"):
        if line not in text:
            sys.exit(f"the console does not say: {line}\n{text}")

    # It does not reach the plane: open, and exactly without traction.
    points, steps, summary, text = pressed("0.4")
    for point in points:
        expect("gap", point["gap"], 0.1)
        if (point["state"], float(point["normal_traction"])) != ("open", 0):
            sys.exit(f"state is {point['state']} with {point['normal_traction']}, expected open with 0")
    expect("normal_resultant", steps[0]["normal_resultant"], 0, 0)
    contact = summary["contact"]["bottom"]
    if contact["through"] is not None or contact["largest_pressure_at"] is not None:
        sys.exit(f"a force where there is none: {contact}")
    for line in ("contact bottom: no force", "open from (0 0) to (2 0), length 2 mm"):
        if line not in text:
            sys.exit(f"the console does not say: {line}\n{text}")

    # Half of it: the block stands on x < 1 and its pressure pushes off centre.
    _, _, summary, _ = pressed("if(x<1,0.1,0.4)")
    contact = summary["contact"]["bottom"]
    if [zone["state"] for zone in contact["zones"]] != ["slip", "open"]:
        sys.exit(f"zones are {contact['zones']}")
    if not contact["through"][0] < 0.8 or contact["force"][1] <= 0:
        sys.exit(f"the force does not act on the left: {contact}")


with tempfile.TemporaryDirectory() as directory:
    home = pathlib.Path(directory)
    for sign in (1, -1):
        uniform_stress(home, slip=0, tau=sign * 0.1, bound=0.3)
        uniform_stress(home, slip=sign * 0.05, tau=sign * 0.1, bound=0.1)
        uniform_stress(home, slip=0, tau=sign * 0.1, bound=0.4, along=sign * 0.2, up=0.5)
        uniform_stress(home, slip=sign * 0.05, tau=sign * 0.1, bound=0.05, along=-sign * 0.05)

    for kind in ("nodes", "multiplier"):
        unilateral(home, kind)

    # Two contact boundaries have no tangent in common.
    points, steps, summary, _ = run(home, CORNER)
    if steps[-1]["friction_resultant"] != "" or summary["final"]["friction_resultant"] is not None:
        sys.exit("two contact boundaries share a friction_resultant")
    if steps[-1]["normal_resultant"] != "":
        sys.exit("two contact boundaries share a normal_resultant")
    if list(summary["contact"]) != ["left", "bottom"]:
        sys.exit(f"the summary has the contact boundaries {list(summary['contact'])}")
    left = [p for p in points if float(p["x"]) == 0]
    bottom = [p for p in points if float(p["y"]) == 0]
    if left + bottom != points:
        sys.exit("the table is not one boundary after the other")
    for name, rows, coordinate in (("left", left, lambda p: -float(p["y"])),
                                   ("bottom", bottom, lambda p: float(p["x"]))):
        if sorted(rows, key=coordinate) != rows:
            sys.exit(f"the points of {name} are not in the order of their tangent")
