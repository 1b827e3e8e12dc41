#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What README.md shows to a new user works: its first scene runs, in ten lines at most, with a bound of the error and
no friction on what is open, and with Coulomb's friction; the program has the options that it names. What it and all pages of the
repository link to is there, places in pages included.

readme.py HPVI ROOT
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

HPVI, ROOT = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
README = (ROOT / "README.md").read_text()


def check_run(what, scene, has_bound):
    """@p scene has parts that are open, stick and slip, no friction on what is open, and a guaranteed bound or none."""
    with tempfile.TemporaryDirectory() as directory:
        path = pathlib.Path(directory) / "first.prm"
        path.write_text(scene)
        done = subprocess.run([HPVI, path], cwd=directory, text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT)
        if done.returncode != 0:
            sys.exit(done.stdout)
        for state in ("open", "stick", "slip"):
            if not re.search(rf"^  {state} from", done.stdout, re.M):
                sys.exit(f"README.md: {what} has nothing that is {state}\n{done.stdout}")
        if "friction acts where contact is open" in done.stdout:
            sys.exit(f"README.md: {what} shears what is open\n{done.stdout}")
        summary = json.loads((pathlib.Path(directory) / "output/first/summary.json").read_text())
        if (summary["error_bound"] is not None) != has_bound:
            sys.exit(f"README.md: {what} has {'no' if has_bound else 'a'} bound of its error")


def check_first_scene():
    scene = re.search(r"`first\.prm`.*?```\n(.*?)```.*?```\n(subsection Boundary bottom.*?)```", README, re.S)
    if not scene:
        sys.exit("README.md: there is no first.prm, or none with Coulomb's friction")
    n_lines = len(scene[1].splitlines())
    if n_lines > 10:
        sys.exit(f"README.md: first.prm has {n_lines} lines, more than 10")
    check_run("first.prm", scene[1], True)
    coulomb = re.sub(r"subsection Boundary bottom.*?\nend\n", lambda _: scene[2], scene[1], flags=re.S)
    check_run("first.prm with Coulomb's friction", coulomb, True)


def places(path):
    """What links may name behind a hash: headings as GitHub calls them, and anchors of the manual."""
    text = re.sub(r"^```.*?^```", "", path.read_text(), flags=re.S | re.M)
    headings = re.findall(r"^#+ (.*?)(?: \{#[\w-]+\})?$", text, re.M)
    return set(re.findall(r"\{#([\w-]+)\}", text)) | {re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-") for heading in headings}


def missing_links():
    found, n = [], 0
    for page in [*ROOT.glob("*.md"), *(ROOT / "prm").glob("*.md"), *(ROOT / "doc").rglob("*.md")]:
        text = re.sub(r"^```.*?^```|`[^`\n]*`", "", page.read_text(), flags=re.S | re.M)
        for target in re.findall(r"\]\(([^)\s:@]+)\)|(?:src|href)=\"([^\":$]+)\"", text):
            n += 1
            name, _, place = "".join(target).partition("#")
            path = page.parent / name if name else page
            if not path.exists() or (place and place not in places(path)):
                found.append(f"{page.relative_to(ROOT)} links to {''.join(target)}, which is not there")
    return found if n > 300 else [f"of the links of all pages {n} are found"]


def missing_options():
    known = subprocess.run([HPVI, "--help"], stdout=subprocess.PIPE, text=True, check=True).stdout
    return [f"README.md names {option}, which is no option of hpvi"
            for option in re.findall(r"(?:hpvi|\.prm) (--[\w-]+)", README) if f" {option} " not in known]


def main():
    missing = missing_links() + missing_options()
    if missing:
        sys.exit("\n".join(missing))
    check_first_scene()


if __name__ == "__main__":
    main()
