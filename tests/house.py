#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""house.py ROOT: a file includes only files of its own folder and of folders before it, doc/plan.md has a row for
every noun under its folder and for nothing else, CMakeLists.txt builds every source, moduli and corners are asked for only
where their meaning is known, and no source is longer than 400 lines."""
import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1])
PLAN = (ROOT / "doc/plan.md").read_text()
CMAKE = (ROOT / "CMakeLists.txt").read_text()
LONGEST = 400
FOLDERS = re.findall(r"^### (\w+)$", PLAN, re.M)
KNOWN_IN = {r"\.(?:mu\(\)|lambda\([23d]|young\b|poisson\b)": ["scene", "closed_forms"],
            r"geometry\.corners": ["scene", "shapes", "checks", "body"]}
problems = []


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
        for what, folders in KNOWN_IN.items():
            if folder not in folders and (asked := re.search(what, file.read_text())):
                problems.append(f"{name} asks for {asked[0]}; ask Material or Geometry what it is for")
        for other in re.findall(r"#include <hpvi/(\w+)/\w+\.h>", file.read_text()):
            if FOLDERS.index(other) > position:
                problems.append(f"{name} includes {other}, which comes later")
sys.exit("\n".join(problems) or 0)
