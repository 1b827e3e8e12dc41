#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""house.py ROOT: a file includes only files of its own folder and of folders before it, doc/plan.md has a row for
every noun under its folder and for nothing else, CMakeLists.txt builds every source, moduli and corners are asked for only
where their meaning is known, no source is longer than 400 lines, and doc/reliability.md names every source that asks for a function of the
scene, with as many places as it has here, and all files, commands and targets that README.md and CONTRIBUTING.md name are there."""
import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1])
PLAN = (ROOT / "doc/plan.md").read_text()
RELIABILITY = (ROOT / "doc/reliability.md").read_text()
CMAKE = (ROOT / "CMakeLists.txt").read_text()
LONGEST = 400
FOLDERS = re.findall(r"^### (\w+)$", PLAN, re.M)
KNOWN_IN = {r"\.(?:mu\(\)|lambda\([23d]|young\b|poisson\b)": ["scene", "closed_forms"],
            r"geometry\.corners": ["scene", "shapes", "checks", "body"]}
# What evaluates loads, strains, springs, friction, gaps and displacements of a scene, beyond the rooms that read and check them.
EVALUATES = re.compile(
    r"load_at<|scene\.initial_strain\(|initial_strain_(?:in|across)(?:<2>)?\(|initial_strains\[[^\]]*\]\.value|spring\.stiffness\("
    r"|(?:bound|coefficient|gap)_at\(|friction_(?:bound|coefficient)\(|friction\.(?:at\(|limit\(x)|gap_on_face\("
    r"|(?:component|function|displacement\[\w+\]|traction\[\w+\]|load\[\w\]|gap|u_D|past|expression|normal|tangential|given)(?:->|\.)value\(")
EVALUATE_FREELY = ["input", "scene", "gmsh", "shapes", "closed_forms", "reader", "checks", "output", "program", "python", "cones"]
EVALUATIONS = {
    "include/hpvi/admissibility/admissible_pressure.h": 1, "include/hpvi/body/load_quadrature.h": 1,
    "include/hpvi/contact/contact_space.h": 2, "include/hpvi/discretisation/initial_stress.h": 4,
    "include/hpvi/evaluation/contact_traces.h": 1, "include/hpvi/evaluation/turned_divergence.h": 1,
    "include/hpvi/moments/moment_space.h": 1, "source/admissibility/admissible_pressure.cc": 4,
    "source/admissibility/face_contact.cc": 1, "source/body/displacement_cuts.cc": 2, "source/body/given_data.cc": 7,
    "source/body/load_rule.cc": 4, "source/contact/collapse.cc": 3, "source/contact/contact_face.cc": 5,
    "source/contact/contact_numbering.cc": 6, "source/contact/resistance.cc": 1, "source/discretisation/elastic_system.cc": 2,
    "source/discretisation/initial_stress.cc": 3, "source/discretisation/missed_loads.cc": 1,
    "source/discretisation/springs.cc": 1, "source/equilibration/boundary_tractions.cc": 3,
    "source/equilibration/data_error.cc": 3, "source/equilibration/force_modes.cc": 3, "source/equilibration/initial_modes.cc":
    1, "source/equilibration/macro_stresses.cc": 2, "source/evaluation/contact_residuals.cc": 1,
    "source/evaluation/contact_state.cc": 2, "source/evaluation/elastic_strain.cc": 1,
    "source/evaluation/residual_estimator.cc": 4, "source/evaluation/true_error.cc": 3, "source/evaluation/unseen_contact.cc":
    2, "source/intervals/open_contact.cc": 1, "source/intervals/stress_work.cc": 1, "source/intervals/test_motion.cc": 1,
    "source/moments/moment_space.cc": 3, "source/moments/primal_system.cc": 1, "source/moments/support_constraints.cc": 1,
    "source/primal/contact_statics.cc": 1, "source/primal/load_check.cc": 1, "source/primal/load_work.cc": 1,
    "source/primal/moment_field.cc": 1, "source/primal/nodal_forces.cc": 1, "source/primal/past_state.cc": 1,
    "source/primal/upper_energy.cc": 1, "source/stresses/edge_polynomial.cc": 1, "source/warnings/contact.cc": 2}
problems = []


def named_problems(page):
    """Files, commands of ./run, targets of ninja and tests that a page names, in words, code and links, exist."""
    text, run = (ROOT / page).read_text(), (ROOT / "run").read_text()
    builds = CMAKE + (ROOT / "tests/CMakeLists.txt").read_text()
    files = set(re.findall(r"(?<![\w/.-])(?:\.ci|doc|include|prm|source|tests)/(?:[\w.-]*\w)?(?:/[\w.-]*\w)*", text))
    files |= {target for target in re.findall(r"\]\(([^)#:]+)[^)]*\)", text)}
    found = [f"the file {name}" for name in files if "NAME" not in name and not (ROOT / name).exists()]
    commands = set(re.findall(r"`\./run ([\w-]+)(?![\w./-])", text)) | set(re.findall(r"^\./run ([\w-]+)(?![\w./-])", text, re.M))
    found += [f"./run {name}" for name in commands if not re.search(rf"^  (?:[\w-]+ \| )*{name}(?: \| [\w-]+)*\)$", run, re.M)]
    for line in re.findall(r"ninja -C \S+ ([\w ]+?)(?: +#|`|$)", text, re.M):
        found += [f"the target {name}" for name in line.split()
                  if not re.search(rf"(?:add_\w+|hpvi_add_test\w*)\({name}\s", builds)]
    for name in re.findall(r"ctest .*?-R (\S+)", text):
        found += [f"the test {name}"] if not re.search(rf"add_test\(NAME \S*{name}|hpvi_add_tests\({name}", builds) else []
    return [f"{page} names {what}, which is not there" for what in sorted(found)]


problems += named_problems("CONTRIBUTING.md") + named_problems("README.md")
tested = set(re.findall(r"`(\w+)`", "".join(re.findall(r"^\| (`\w+`(?:, `\w+`)*) \|", (ROOT / "CONTRIBUTING.md").read_text(), re.M))))
for folder in tested ^ {path.name for path in (ROOT / "tests").iterdir() if path.is_dir() and path.name != "__pycache__"}:
    problems.append(f"tests/{folder} is no folder, or has no row in CONTRIBUTING.md")


def planned(folder):
    """The nouns in the first column of the folder's table."""
    table = PLAN.split(f"### {folder}\n")[1].split("\n#")[0]
    cells = re.findall(r"^\| (`[^|]*) \|", table, re.M)
    return {noun for cell in cells for noun in re.findall(r"`(\w+)`", cell)}


for top in ("include/hpvi", "source"):
    for folder in (ROOT / top).iterdir():
        if folder.name not in FOLDERS + ["package"]:
            problems.append(f"{top}/{folder.name} is no folder of doc/plan.md")
for position, folder in enumerate(FOLDERS):
    files = [*(ROOT / "include/hpvi" / folder).glob("*.h"), *(ROOT / "source" / folder).glob("*.cc")]
    nouns = {file.stem for file in files}
    for noun in nouns ^ planned(folder):
        problems.append(f"{folder}/{noun} stands only in {'the tree' if noun in nouns else 'doc/plan.md'}")
    for file in files:
        name = str(file.relative_to(ROOT))
        if len(file.read_text().splitlines()) > LONGEST:
            problems.append(f"{name} has more than {LONGEST} lines")
        if file.suffix == ".cc" and f"source/{folder}/{file.name}" not in CMAKE:
            problems.append(f"{name} is not built")
        places = len(EVALUATES.findall(re.sub(r"//.*|^ *\*.*|/\*\*.*", "", file.read_text(), flags=re.M)))
        if folder not in EVALUATE_FREELY and places != EVALUATIONS.get(name, 0):
            problems.append(f"{name} asks for functions of the scene in {places} places, known are {EVALUATIONS.get(name, 0)}: "
                            "integrals come from LoadRules, see doc/reliability.md")
        if folder not in EVALUATE_FREELY and places and f"`{file.stem}`" not in RELIABILITY:
            problems.append(f"{name} asks for functions of the scene, and doc/reliability.md does not name it")
        for what, folders in KNOWN_IN.items():
            if folder not in folders and (asked := re.search(what, file.read_text())):
                problems.append(f"{name} asks for {asked[0]}; ask Material or Geometry what it is for")
        for other in re.findall(r"#include <hpvi/(\w+)/\w+\.h>", file.read_text()):
            if FOLDERS.index(other) > position:
                problems.append(f"{name} includes {other}, which comes later")
sys.exit("\n".join(problems) or 0)
