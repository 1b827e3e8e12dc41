#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""house.py ROOT: a file includes only files of its own room and of rooms before it in the map, doc/architecture.md, with no more arrows
between rooms than there were; the map has every room, at most 150 lines of 120 characters, names files that are there, and finds five
of them by what they are; each file says in its first comment what it is; CMakeLists.txt builds every source; moduli and corners are
asked for only where their meaning is known; doc/reliability.md names every source that asks for a function of the scene, with as many
places as it has here; all files, commands and targets that README.md and CONTRIBUTING.md name are there; and files that tell the version agree."""
import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1])
sys.path.append(str(ROOT / "doc"))
import rooms

MAP = (ROOT / "doc/architecture.md").read_text()
RELIABILITY = (ROOT / "doc/reliability.md").read_text()
CMAKE = (ROOT / "CMakeLists.txt").read_text()
FOLDERS = list(rooms.rooms(ROOT))
# Where does this live? What the words find in the map has this text.
QUESTIONS = {"friction law": r"^struct FrictionLaw\b", "mark cell": r"^Refinement mark\(", "column convergence.csv": r'\{"bound_oscillation", ',
             "oscillation bound": r"^  std::vector<double> oscillation;", "message mesh file": r"^class MeshComplaint\b"}
KNOWN_IN = {r"\.(?:mu\(\)|lambda\([23d]|young\b|poisson\b)": ["scene", "reader/closed_forms", "reader/material_reader"],
            r"geometry\.corners": ["scene", "reader/shapes", "reader/checks", "plane/"]}
# What evaluates loads, strains, springs, friction, gaps and displacements of a scene, beyond the rooms that read and check them.
EVALUATES = re.compile(
    r"load_at<|scene\.initial_strain\(|initial_strain_(?:in|across)(?:<2>)?\(|initial_strains\[[^\]]*\]\.value|spring\.stiffness\("
    r"|(?:bound|coefficient|gap)_at\(|friction_(?:bound|coefficient)\(|friction\.(?:at\(|limit\(x)|gap_on_face\("
    r"|(?:component|function|displacement\[\w+\]|traction\[\w+\]|load\[\w\]|gap|u_D|past|expression|normal|tangential|given)(?:->|\.)value\(")
EVALUATE_FREELY = ["scene", "reader", "solvers", "output", "program", "python"]
EVALUATIONS = {
    "include/hpvi/bound/admissible_pressure.h": 1, "include/hpvi/plane/load_quadrature.h": 1,
    "include/hpvi/plane/contact_space.h": 2, "include/hpvi/plane/initial_stress.h": 3,
    "include/hpvi/results/contact_traces.h": 1, "include/hpvi/results/turned_divergence.h": 1,
    "include/hpvi/space/primal_space.h": 1, "source/bound/admissible_pressure.cc": 4,
    "source/bound/coulomb_bound.cc": 3, "source/bound/coulomb_coupling.cc": 3, "source/bound/coupling_spaces.cc": 1, "source/bound/slip_direction.cc": 1,
    "source/plane/displacement_cuts.cc": 2, "source/plane/given_data.cc": 7,
    "source/plane/load_rule.cc": 4, "source/plane/failure_mechanism.cc": 3, "source/plane/contact_face.cc": 6,
    "source/plane/contact_numbering.cc": 6, "source/plane/static_admissibility.cc": 1, "source/plane/elastic_system.cc": 2,
    "source/plane/initial_stress.cc": 5, "source/plane/missed_loads.cc": 1,
    "source/plane/pretension_force.cc": 2, "source/plane/springs.cc": 1, "source/bound/boundary_tractions.cc": 2,
    "source/bound/data_error.cc": 2, "source/bound/displacement_lift.cc": 1, "source/bound/joint_lift.cc": 1,
    "source/bound/joint_tractions.cc": 2, "source/bound/force_modes.cc": 3, "source/bound/parallelogram_stresses.cc":
    1, "source/bound/row_stresses.cc": 6, "source/results/contact_residuals.cc": 1,
    "source/results/contact_state.cc": 2, "source/results/elastic_strain.cc": 1,
    "source/results/residual_estimator.cc": 4, "source/results/true_error.cc": 3, "source/results/unseen_contact.cc":
    2, "source/bound/open_contact.cc": 1, "source/bound/stress_work.cc": 1, "source/bound/test_motion.cc": 2,
    "source/space/primal_space.cc": 3, "source/space/primal_system.cc": 1, "source/space/box_contact.cc": 2, "source/space/box_correction.cc": 2,
    "source/space/box_coulomb.cc": 8,
    "source/space/contact_statics.cc": 1, "source/space/load_check.cc": 3, "source/space/load_work.cc": 1, "source/space/strain_loads.cc": 1,
    "source/space/primal_field.cc": 1, "source/space/nodal_forces.cc": 1, "source/space/past_state.cc": 1,
    "source/space/upper_energy.cc": 1, "source/results/warnings/contact.cc": 2}
MOST_ARROWS = 65  # between rooms
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
version = re.search(r"^project\(hpvi VERSION (\S+)", CMAKE, re.M)[1]
for name, pattern in (("CITATION.cff", r"^version: (\S+)"), (".zenodo.json", r'^  "version": "(.*)"'), ("CHANGELOG.md", r"^## (\d\S+), "),
                      ("doc/example/CMakeLists.txt", r"find_package\(hpvi (\S+)")):
    if not (version + ".").startswith(re.search(pattern, (ROOT / name).read_text(), re.M)[1] + "."):
        problems.append(f"{name} is of another version than {version}, that of CMakeLists.txt")
tested = set(re.findall(r"`(\w+)`", "".join(re.findall(r"^\| (`\w+`(?:, `\w+`)*) \|", (ROOT / "CONTRIBUTING.md").read_text(), re.M))))
for folder in tested ^ {path.name for path in (ROOT / "tests").iterdir() if path.is_dir() and path.name != "__pycache__"}:
    problems.append(f"tests/{folder} is no folder, or has no row in CONTRIBUTING.md")


def texts_of(noun):
    """Header and source of ROOM/NOUN; empty where there is none."""
    return "".join(path.read_text() for path in (ROOT / f"include/hpvi/{noun}.h", ROOT / f"source/{noun}.cc") if path.exists())


def found_in_map(words):
    """The first name of a file behind the words, in the first paragraph or line of a list that has them all."""
    for item in re.split(r"\n(?=- |\d+\. |\n)", MAP):
        at = [re.search(rf"\b{re.escape(word)}\b", item) for word in words.split()]
        if all(at):
            name = re.search(r"`(\w+(?:/\w+)+)`", item[at[0].start():])
            return name[1] if name else None
    return None


def map_problems():
    lines = MAP.splitlines()
    found = [f"has {len(lines)} lines, more than 150"] if len(lines) > 150 else []
    found += [f"has more than 120 characters in line {k}" for k, line in enumerate(lines, 1) if len(line) > 120]
    for noun in re.findall(r"`((?:%s)/\w[\w/]*)`" % "|".join(FOLDERS), MAP):
        if "NAME" not in noun and not texts_of(noun):
            found.append(f"names {noun}, which is not there")
    for words, text in QUESTIONS.items():
        noun = found_in_map(words)
        if not noun or not re.search(text, texts_of(noun), re.M):
            found.append(f"leads from \"{words}\" to {noun}, where it is not")
    decided = re.findall(r"^## (.*)$", (ROOT / "doc/decisions.md").read_text(), re.M)
    for name in set(re.findall(r"^- \*\*(.*?)\*\*", MAP.split("\n## Decisions\n")[1], re.M)) ^ set(decided):
        found.append(f"and doc/decisions.md do not both have the decision {name}")
    return [f"doc/architecture.md {what}" for what in found]


problems += map_problems()
for top in ("include/hpvi", "source"):
    for folder in (ROOT / top).iterdir():
        if folder.name not in FOLDERS + ["package"]:
            problems.append(f"{top}/{folder.name} is no room of doc/architecture.md")
for position, folder in enumerate(FOLDERS):
    files = rooms.files_of(folder, ROOT)
    if not files:
        problems.append(f"{folder} is a room of doc/architecture.md without files")
    for file in files:
        name = str(file.relative_to(ROOT))
        header = ROOT / "include/hpvi" / file.relative_to(ROOT / "source").with_suffix(".h") if file.suffix == ".cc" else None
        if not (header and header.exists()) and not rooms.first_comment(file):
            problems.append(f"{name} does not say in a first comment what it is")
        if file.suffix == ".cc" and name not in CMAKE:
            problems.append(f"{name} is not built")
        places = len(EVALUATES.findall(re.sub(r"//.*|^ *\*.*|/\*\*.*", "", file.read_text(), flags=re.M)))
        if folder not in EVALUATE_FREELY and places != EVALUATIONS.get(name, 0):
            problems.append(f"{name} asks for functions of the scene in {places} places, known are {EVALUATIONS.get(name, 0)}: "
                            "integrals come from LoadRules, see doc/reliability.md")
        if folder not in EVALUATE_FREELY and places and f"`{file.stem}`" not in RELIABILITY:
            problems.append(f"{name} asks for functions of the scene, and doc/reliability.md does not name it")
        for what, folders in KNOWN_IN.items():
            if not re.search(rf"/(?:{'|'.join(folders)})", name) and (asked := re.search(what, file.read_text())):
                problems.append(f"{name} asks for {asked[0]}; ask Material or Geometry what it is for")
        for other in re.findall(r"#include <hpvi/(\w+)/[\w/]+\.h>", file.read_text()):
            if other not in FOLDERS[:position + 1]:
                problems.append(f"{name} includes {other}, which comes later, or nowhere")
if (n := len(rooms.includes(ROOT))) > MOST_ARROWS:
    problems.append(f"{n} rooms include others, two by two; at most {MOST_ARROWS} were: see python3 doc/rooms.py")
sys.exit("\n".join(problems) or 0)
