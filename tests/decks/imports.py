#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""imports.py HPVI: decks become scenes that are solved, with the numbers of doc/peers.md; what they cannot say is listed with its line; an
assembly of parts is the same as one flat deck; a deck is a mesh, too; and bad decks are refused in one line that names file, line and remedy."""
import csv
import math
import os
import pathlib
import sys
import tempfile
import types

import decks

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "scenes"))
import runs

problems = []
# What hpvi finds on the coarsest meshes, to which CalculiX comes as near as the table of doc/peers.md says.
EXPECTED = {"plate_with_hole": 0.0026331, "cantilever": -2.44648, "punch": -3101.32, "roller": 0.184501, "press_fit": 0.0112161,
            "flange": 0.0015026, "bimetal": 0.133455, "rubbing": -0.976, "dam": 3.54488e-05, "disc": 0.0061465, "veneer": 3572.2, "mould": 82.798}
SIDES = {"punch": "Tool.Moved", "roller": "eblock.fixed", "press_fit": "ESHAFT.PULLED", "flange": "ERING.END", "rubbing": "EBASE.FOOT", "mould": "EBLOCK.BED"}


def check(holds, what):
    if not holds:
        problems.append(what)


def hpvi(*words):
    return types.SimpleNamespace(**dict(zip(("returncode", "stdout", "stderr"), runs.run_program([runs.PROGRAM, *map(str, words)]))))


def last_rows(path):
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def solved(scene, results, quantity, component, side):
    probe = [] if quantity == "force" else ["--set", f"Probe mean/On={side}"]
    run = hpvi(scene, "--output", results, "--set", "Error/Bound=false", "--set", "Output/VTU=false",
               "--set", "Output/Steps=last", *probe)
    if run.returncode:
        return run.stderr
    x = "xy"[component]
    if quantity == "force":
        rows = [row for row in last_rows(results / "forces.csv") if row["name"] == side]
        return float(rows[-1][f"F{x}"] or "nan")
    return float(last_rows(results / "convergence.csv")[-1][f"mean_u{x}"])


def check_decks(home):
    for deck, (quantity, component, name) in decks.QUANTITIES.items():
        word = deck.__name__
        path = decks.write(deck, home / word)
        run = hpvi("--import", path, "--output", home / word / "scene")
        check(run.returncode == 0 and "left out" not in run.stdout.replace("nothing is left out", ""), f"{word}: {run.stdout}{run.stderr}")
        check((home / word / "scene/import.txt").read_text() == run.stdout.split("\n", 1)[1], f"{word}: import.txt is not what is printed")
        value = solved(home / word / "scene/scene.prm", home / word / "results", quantity, component, SIDES.get(word, name))
        close = isinstance(value, float) and abs(value / EXPECTED[word] - 1) < (5e-3 if word == "rubbing" else 1e-3)
        check(close, f"{word}: {value} and not {EXPECTED[word]}")
    again = hpvi("--import", home / "punch/deck.inp", "--output", os.path.relpath(home / "punch/scene"))
    check(again.returncode == 0, f"an import does not replace its own files: {again.stderr}")
    refused = hpvi("--import", home / "punch/deck.inp", "--output", home / "punch/results")
    check(refused.returncode == 1 and "no import has written; choose another one" in refused.stderr, f"files of a run: {refused.stderr}")


def assembly():
    """The punch, as Abaqus/CAE writes it: parts with own numbers, the tool drawn upside down elsewhere and turned and moved to its place."""
    block = decks.Grid("CPE8", 12, 6, decks.box(-6, -6, 6, 0))
    tool = decks.Grid("CPE8", 4, 3, lambda s, t: (2 - 4 * s, -(3 * t + 0.02 * (2 * s - 1) ** 2 * (1 - t))))
    part = lambda name, grid, sets: [f"*Part, name={name}", *grid.node_lines(), *grid.element_lines(""), *sets, f"*Elset, elset=All, generate",
                                     f"1, {len(grid.elements)}, 1", "*Solid Section, elset=All, material=S235", ",", "*End Part"]
    faces = lambda name, instance, side: [
        line.replace("*ELSET", f"*Elset, internal, instance={instance}") for line in decks.surface(name, side)]
    return ["*Heading", "** Job name: punch", *part("Block", block, decks.nset("Fixed", block.side(1))), *part("Tool", tool, []),
            "*Assembly, name=Assembly", "*Instance, name=Block-1, part=Block", "*End Instance", "*Instance, name=Tool-1, part=Tool",
            "1., 0., 0.", "0.5, 0., 0., 0.5, 0., 1., 180.", "*End Instance", "*Nset, nset=Moved, instance=Tool-1",
            ", ".join(map(str, tool.side(3))), *faces("Block_top", "Block-1", block.faces(3)), *faces("Tool_bottom", "Tool-1", tool.faces(1)),
            "*End Assembly", "*Material, name=S235", "*Elastic", "210000., 0.28", "*Surface Interaction, name=IntProp-1", "1.,",
            "*Surface Behavior, pressure-overclosure=HARD", "*Contact Pair, interaction=IntProp-1, type=SURFACE TO SURFACE", "Tool_bottom, Block_top",
            "*Boundary", "Block-1.Fixed, ENCASTRE", "*Step, name=Step-1, nlgeom=NO", "*Static", "1., 1., 1e-05, 1.", "*Boundary",
            "Moved, 1, 1", "Moved, 2, 2, -0.03", "*Output, field, variable=PRESELECT", "*End Step"]


def check_assembly(home):
    path = home / "assembly.inp"
    path.write_text("\n".join(assembly()) + "\n")
    run = hpvi("--import", path, "--output", home / "assembly")
    check(run.returncode == 0 and "left out" not in run.stdout.replace("nothing is left out", ""), f"assembly: {run.stdout}{run.stderr}")
    value = solved(home / "assembly/scene.prm", home / "assembled", "force", 1, "Tool-1.Moved")
    check(isinstance(value, float) and abs(value / EXPECTED["punch"] - 1) < 1e-3, f"the assembly gives {value}")


# What stands in the place of a line of the flat deck below, and what the list has to say of it, with the number of the line.
BASE = ["*HEADING", "a square", "*NODE, NSET=ALL", "1, 0, 0", "2, 1, 0", "3, 1, 1", "4, 0, 1", "*ELEMENT, TYPE=CPS4, ELSET=SQUARE", "1, 1, 2, 3, 4",
        "*NSET, NSET=LEFT", "1, 4", "*NSET, NSET=RIGHT", "2, 3", "*MATERIAL, NAME=STEEL", "*ELASTIC", "200., 0.3", "*SOLID SECTION, ELSET=SQUARE, MATERIAL=STEEL",
        "1.", "*BOUNDARY", "LEFT, 1, 2", "*STEP", "*STATIC", "1., 1.", "*CLOAD", "RIGHT, 1, 5.", "*END STEP"]
LISTED = [  # line, text, what is listed
    (20, "LEFT, 1, 2\n3, 1", ":21: *BOUNDARY: the node 3 on no edge of it; a point holds nothing in the continuum"),
    (25, "RIGHT, 1, 5.\n4, 2, 1.", ":26: *CLOAD: the node 4 on no edge of it; a force at a point has infinite energy"),
    (25, "RIGHT, 1, 5.", ":25: *CLOAD: forces of 2 nodes, 10 along x in all, are spread evenly over the edges of RIGHT"),
    (16, "200., 0.3\n*PLASTIC\n1., 0.", ":17: *PLASTIC: the material STEEL is linearly elastic here"),
    (16, "200., 0.3, 20.\n100., 0.3, 200.", ":15: *ELASTIC: numbers that depend on temperature; the first row is taken"),
    (19, "*EQUATION\n2\n1, 1, 1., 2, 1, -1.\n*BOUNDARY", ":19: *EQUATION"),
    (21, "*STEP, NLGEOM", ":21: *STEP, NLGEOM: large displacements"),
    (26, "*END STEP\n*STEP\n*FREQUENCY\n10,\n*END STEP", ":27: *STEP: it is *FREQUENCY ("),
    (25, "RIGHT, 6, 5.", ":25: *CLOAD: a force along 6, which is neither x (1) nor y (2)"),
    (24, "*DLOAD\nSQUARE, PNU, 1.\n*CLOAD", ":25: *DLOAD: a load PNU"),
    (9, "1, 1, 2, 3, 4\n*ELEMENT, TYPE=T2D2, ELSET=BAR\n2, 1, 2", ":10: *ELEMENT: elements of type T2D2")]
REFUSED = [  # line, text, what the one line says
    (8, "*ELEMENT, TYPE=C3D8, ELSET=SQUARE", ":8: elements of type C3D8 are of space"),
    (9, "1, 1, 2, 3, 9", ":9: the element 1 has a node 9 that is not there; write"),
    (9, "1, 1, 2, 3", ":9: the element 1 has 3 nodes of 4; write"),
    (9, "1, 1, 2, 3, 4\n*ELEMENT, TYPE=CPE4\n2, 1, 2, 3, 4", ":10: elements of type CPE4 stand beside others of another plane"),
    (9, "1, 1, 2, 3, 4\n1, 1, 2, 3, 4", ":10: the element 1 stands in a line before; give"),
    (5, "2, one, 0", ":5: one is no number; give"),
    (5, "1, 1, 0", ":5: the node 1 is at another place in a line before; give"),
    (7, "4, 0, 1, 1", ":9: the node 4 is not in the plane z = const of the others; draw"),
    (20, "LEST, 1, 2", ":20: names the node or node set LEST, which is not there; give"),
    (20, "LEFT, 0, 2", ":20: holds the degrees of freedom 0 to 2; give"),
    (15, "*DENSITY", "the material STEEL of"), (16, "-200., 0.3", "has no Young's modulus; write"),
    (17, "*SOLID SECTION, ELSET=ROUND, MATERIAL=STEEL", ":17: *SOLID SECTION is of the element set ROUND, which is not there; name"),
    (17, "*DENSITY", "has no material; write"), (2, "*INCLUDE, INPUT=none.inp", ":2: *INCLUDE names none.inp, which is not there; put"),
    (2, "*INCLUDE, INPUT=deck.inp", ":2: *INCLUDE goes deeper than 16 files; let"),
    (21, "*STOP", "has no step that is static; write"), (22, "*FREQUENCY", "has no step that is static; write"),
    (15, "*ELASTIC, TYPE=ANISOTROPIC", ":15: *ELASTIC is of TYPE = ANISOTROPIC, and"),
    (24, "*CLOAD, AMPLITUDE=NONE", ":25: follows the amplitude NONE, which is not there; write"),
    (24, "*DSLOAD\nRIGHT, P, 5.\n*CLOAD", ":25: names the surface RIGHT, which is not there; write"), (24, "*CONTACT PAIR\nA, B\n*CLOAD", ":25: names the surface A, which is not there; write"),
    (10, "*NSET", ":10: the set has no name; write"), 
    (10, "*NSET, NSET=LEFT, GENERATE\n4, 1", ":11: GENERATE goes from 4 to 1 by 1; give"),
    (8, "*ELEMENT, TYPE=S4", "has no elements of the plane or of revolution; give"), (1, "1, 2, 3", "is no deck of CalculiX or Abaqus")]


def spoilt(line, text):
    return "\n".join([*BASE[:line - 1], text, *BASE[line:]]) + "\n"


def check_words(home):
    path = home / "deck.inp"
    for line, text, words in LISTED:
        path.write_text(spoilt(line, text))
        run = hpvi("--import", path, "--output", home / "listed")
        check(run.returncode == 0 and "deck.inp" + words in run.stdout, f"{text!r}: {run.stdout}{run.stderr}")
    path.write_text("\n".join(BASE) + "\n")
    scene = home / "listed/scene.prm"
    hpvi("--import", path, "--output", home / "listed")
    check("Traction = 10; 0" in scene.read_text() and hpvi("--validate", scene).returncode == 0, "the square")
    for line, text, words in REFUSED:
        path.write_text(spoilt(line, text))
        run = hpvi("--import", path, "--output", home / "refused")
        check(run.returncode == 1 and run.stderr.count("\n") == 1 and words in run.stderr and "deck.inp" in run.stderr and "; " in run.stderr
              and not run.stdout and not (home / "refused").exists(), f"{text!r}: {run.stdout}{run.stderr}")
    for words, says in ((["scene.prm", "--import", path], "makes a scene of a deck; remove scene.prm"), (["--import", path, "--validate"], "solves nothing; remove"),
                        (["--import", home / "none.inp"], "is no file that can be read; name a deck")):
        run = hpvi(*words)
        check(run.returncode == 1 and says in run.stderr and run.stderr.count("\n") == 1, f"{words}: {run.stderr}")


def check_mesh(home):
    """A deck as the mesh of a scene, its sets as boundaries."""
    path = home / "mesh.inp"
    path.write_text("\n".join(BASE) + "\n")
    scene = home / "mesh.prm"
    scene.write_text("subsection Geometry\nset Shape = file\nset File = mesh.inp\nend\nsubsection Boundary LEFT\nset Displacement = 0; 0\nend\n"
                     "subsection Boundary RIGHT\nset Traction = 1; 0\nend\n")
    run = hpvi("--validate", scene)
    check(run.returncode == 0 and "a deck of CalculiX or Abaqus" in run.stdout, f"a deck as a mesh: {run.stdout}{run.stderr}")
    for entry, words in (("Geometry/Length unit=mm", "has no unit"), ("Geometry/Mesh size=1", "is a mesh")):
        run = hpvi("--validate", scene, "--set", entry)
        check(run.returncode == 1 and words in run.stderr, f"{entry}: {run.stderr}")


def check_courses(home):
    """Steps and amplitudes: what acts at the end of each load step."""
    steps = ["*AMPLITUDE, NAME=UP", "0., 0., 0.5, 1.", "*STEP", "*STATIC", "1., 1.", "*CLOAD", "RIGHT, 1, 5.", "*END STEP",
             "*STEP", "*STATIC", "1., 1.", "*CLOAD, AMPLITUDE=UP", "RIGHT, 1, 2.", "*END STEP", "*STEP", "*STATIC", "1., 1.", "*CLOAD, OP=NEW", "RIGHT, 2, 1.", "*END STEP"]
    path = home / "courses.inp"
    path.write_text("\n".join(BASE[:20] + steps) + "\n")
    run = hpvi("--import", path, "--output", home / "courses")
    results = home / "course results"
    solved_run = hpvi(home / "courses/scene.prm", "--output", results, "--set", "Output/VTU=false")
    check(run.returncode == 0 and solved_run.returncode == 0, f"steps: {run.stderr}{solved_run.stderr}")
    if solved_run.returncode:
        return
    forces = {}
    for row in last_rows(results / "forces.csv"):
        if row["name"] == "LEFT" and row["kind"] == "support":
            forces[round(6 * float(row["t"]))] = -float(row["Fx"]), -float(row["Fy"])
    # Half ways it rises from 0 to 10; the amplitude goes from 0, where it begins, to 4 at half the step; then all but 2 along y goes.
    for k, expected in {1: (5, 0), 2: (10, 0), 3: (4, 0), 4: (4, 0), 5: (2, 1), 6: (0, 2)}.items():
        check(k in forces and math.dist(forces[k], expected) < 1e-6, f"load step {k} of 6: {forces.get(k)} and not {expected}")


def main():
    with tempfile.TemporaryDirectory() as scratch:
        home = pathlib.Path(scratch)
        os.chdir(home)
        check_words(home)
        check_mesh(home)
        check_courses(home)
        check_assembly(home)
        check_decks(home)
    sys.exit("\n".join(problems) or 0)


main()
