#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the pages of doc/manual tell a user to write is what the program takes: their scenes are valid, the scenes, entries, options and
commands that they name exist, and each page is built, found from the others, and named by an anchor of its own.

manual.py HPVI ROOT
"""
import pathlib
import re
import subprocess
import sys
import tempfile

HPVI, ROOT = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
PAGES = {path.stem: path.read_text() for path in sorted((ROOT / "doc/manual").glob("*.md"))}


def entries():
    """Section/Entry of all that the program knows, Boundary NAME for each boundary."""
    section, found, listing = "", set(), ""
    for scene in ([], [ROOT / "prm/slab.prm"]):  # of the plane, and of space
        listing += subprocess.run([HPVI, "--print-parameters", *scene], stdout=subprocess.PIPE, text=True, check=True).stdout
    for line in map(str.strip, listing.splitlines()):
        if line.startswith("subsection "):
            section = re.sub("Boundary .*", "Boundary NAME", line[len("subsection "):])
        elif line.startswith("set "):
            found.add(f"{section}/{line[4:].split('=')[0].strip()}")
    return found


def scene_problems(name, text):
    """Scenes that a page says to write are valid."""
    problems = []
    with tempfile.TemporaryDirectory() as directory:
        for scene, content in re.findall(r"`(\w+\.(?:prm|geo))`:\n\n```\n(.*?)```", text, re.S):
            path = pathlib.Path(directory) / scene
            path.write_text(content)
            if path.suffix == ".geo":  # a drawing of the next scene
                continue
            done = subprocess.run([HPVI, "--validate", path], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            if done.returncode != 0:
                problems.append(f"{name}.md: {done.stdout.strip()}")
    return problems


def name_problems(name, text, known):
    """Scenes of prm/ and entries that a page names are there."""
    sections = "|".join(sorted({re.escape(entry.split("/")[0]) for entry in known} - {""}))
    problems = [f"{name}.md names {scene}, which is not there" for scene in set(re.findall(r"\bprm/[\w-]+\.prm", text))
                if not (ROOT / scene).exists()]
    for entry in set(re.findall(rf"[`\"]((?:{sections})/[A-Z][\w' -]*?)\s*[=`\"]", re.sub("Boundary [a-z]+/", "Boundary NAME/", text))):
        if entry not in known:
            problems.append(f"{name}.md names the entry {entry}, which is unknown")
    return problems


def command_problems(name, text):
    """Commands in words and code have options and files that are there; what is written in capitals the reader replaces."""
    options = set(re.findall(r"--[a-z-]+", subprocess.run([HPVI, "--help"], stdout=subprocess.PIPE, text=True, check=True).stdout))
    cases = {word for line in re.findall(r"^  ([\w| -]+)\)$", (ROOT / "run").read_text(), re.M) for word in line.split(" | ")}
    others = {option for path in (ROOT / "run", *(ROOT / "doc").glob("*.py")) for option in re.findall(r"--[a-z-]+", path.read_text())}
    problems = [f"{name}.md: there is no option {option}" for option in re.findall(r"`(--[a-z-]+)[^`\n]*`", text)
                if option not in options | others]
    made = {"first.prm", *re.findall(r"`(\w+\.\w+)`:\n", text), "scene.prm"}  # by the reader, by a run
    for command in re.findall(r"(?:`|^(?:\$ )?)((?:\./run|(?:build/)?hpvi) [^`\n#]*)", text, re.M):
        program, *words = command.replace('"', "").split()
        if not words or (program == "./run" and words[0] in cases):  # with options of its own
            continue
        problems += [f"{name}.md: {command.strip()}: there is no {word}" for word in words
                     if (re.fullmatch(r"--[a-z-]+", word) and word not in options)
                     or (re.fullmatch(r"[\w./-]+\.(?:prm|inp|step)", word) and not re.search(r"[A-Z]{3}", word)
                         and word not in made and not (ROOT / word).exists())
                     or (program == "./run" and re.fullmatch(r"[a-z]+", words[0]))]
    return problems


def main():
    known, problems = entries(), []
    header, builder = (ROOT / "doc/manual/header.html").read_text(), (ROOT / "doc/manual.py").read_text()
    for name in re.findall(r"\^([\w-]+)\.html", header):
        if f'"{name}"' not in builder and name != "index" and not re.search(rf'[/"]{name}\.md"', builder, re.I):
            problems.append(f"header.html leads to {name}.html, which doc/manual.py does not build")
    if len(re.findall(r"`\w+\.prm`:\n\n```\n", "".join(PAGES.values()))) < 3:
        problems.append("the manual's scenes are not found any more")
    for name, text in PAGES.items():
        problems += scene_problems(name, text) + name_problems(name, text, known) + command_problems(name, text)
        if f"{name}.html" not in header or f'"{name}"' not in builder:
            problems.append(f"{name}.md is not in header.html, or not built by doc/manual.py")
        if name not in ("index", "tutorial") and f"{{#{name}}}" not in text and f'<a id="{name}">' not in text:
            problems.append(f"{name}.md has no anchor {name}")
    for name in ("README", "CONTRIBUTING", "doc/python", "prm/README"):
        problems += command_problems(name, (ROOT / f"{name}.md").read_text())
    sys.exit("\n".join(problems) or 0)


if __name__ == "__main__":
    main()
