#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""mesh_mutations.py HPVI SCENE MESH: the program validates the scene with damaged copies of its mesh file, called body.msh
there, each damaged in another way. All are refused with exit status 1 and one line on stderr that names a file."""
import pathlib
import re
import subprocess
import sys
import tempfile
import unicodedata


def lines_of(text, section):
    """First line and last of a section, without its marks, as a range of line numbers."""
    lines = text.split("\n")
    return range(lines.index(f"${section}") + 2, lines.index(f"$End{section}"))


def with_line(text, number, line):
    lines = text.split("\n")
    lines[number] = line
    return "\n".join(lines)


def without_section(text, section):
    return re.sub(rf"\${section}\n.*?\$End{section}\n", "", text, flags=re.S)


def swapped(text, one, other):
    lines = text.split("\n")
    lines[one], lines[other] = lines[other], lines[one]
    return "\n".join(lines)


def damages(text):
    """Name and bytes of each copy."""
    nodes, elements, names = (lines_of(text, section) for section in ("Nodes", "Elements", "PhysicalNames"))
    lines = text.split("\n")
    node, cell = lines[nodes[0]].split(), lines[elements[-1]].split()
    copies = {
        "cut in the nodes": text[:text.index("$Nodes") + 60],
        "cut before the last mark": text[:text.index("$EndElements")],
        "no names": without_section(text, "PhysicalNames"),
        "no nodes": without_section(text, "Nodes"),
        "nodes after elements twice": text + "\n".join(["$Nodes", *[lines[i] for i in range(nodes[0] - 1, nodes[-1] + 1)], "$EndNodes", ""]),
        "said to be binary": text.replace("2.2 0 8", "2.2 1 8"),
        "more nodes than announced": with_line(text, nodes[0] - 1, "3"),
        "a huge number of nodes": with_line(text, nodes[0] - 1, "99999999999999999999"),
        "a huge number of elements": with_line(text, elements[0] - 1, "4000000000"),
        "a node twice": with_line(text, nodes[1], lines[nodes[0]]),
        "a node that is no number": with_line(text, nodes[0], f"{node[0]} nan 0 0"),
        "a node far away": with_line(text, nodes[0], f"{node[0]} 1e300 0 0"),
        "a node out of the plane": with_line(text, nodes[0], f"{node[0]} {node[1]} {node[2]} 0.5"),
        "nodes renumbered": with_line(with_line(text, nodes[0], " ".join(["2", *node[1:]])), nodes[1],
                                      " ".join(["1", *lines[nodes[1]].split()[1:]])),
        "a cell of a node that is missing": with_line(text, elements[-1], " ".join([*cell[:-1], "77"])),
        "a cell that crosses itself": with_line(text, elements[-1], " ".join([*cell[:-2], cell[-1], cell[-2]])),
        "a cell of another type": with_line(text, elements[-1], " ".join([cell[0], "5", *cell[2:]])),
        "a cell twice": with_line(text, elements[-2], lines[elements[-1]]),
        "a cell in no group": with_line(text, elements[-1], " ".join([*cell[:3], "0", *cell[4:]])),
        "an edge across a cell": with_line(text, elements[0], "1 1 2 1 1 1 9"),
        "a name without quotes": with_line(text, names[0], "1 1 inside"),
        "lines of two sections exchanged": swapped(text, nodes[0], elements[0]),
    }
    result = {name: copy.encode() for name, copy in copies.items()}
    result["bytes that are no text"] = text.encode().replace(b"0.8660254030594873", b"\x00\xff\x80\x01")
    result["UTF-16"] = text.encode("utf-16")
    result["zeros"] = bytes(4000)
    return result


def complaint(run):
    if run.returncode != 1:
        return f"exit status {run.returncode}"
    try:
        line = run.stderr.decode("utf-8")
    except UnicodeDecodeError:
        return "stderr is not UTF-8"
    if not line.endswith("\n") or len(line[:-1].splitlines()) != 1:
        return "stderr does not hold one line"
    if any(unicodedata.category(c) in ("Cc", "Zl", "Zp") for c in line[:-1]):
        return "stderr holds control characters"
    if len(line) > 1000:
        return "stderr holds more than a line"
    if "internal error" in line:
        return "internal error"
    if not line.startswith(("body.msh:", "scene.prm:")):
        return "stderr does not name the file"
    return "something on stdout" if run.stdout else ""


def main():
    program, scene, mesh = (pathlib.Path(name).resolve() for name in sys.argv[1:])
    failures = 0
    with tempfile.TemporaryDirectory() as scratch:
        file = pathlib.Path(scratch) / "body.msh"
        copy = pathlib.Path(scratch) / "scene.prm"
        copy.write_bytes(scene.read_bytes())
        copies = damages(mesh.read_text())
        for name, damaged in copies.items():
            file.write_bytes(damaged)
            run = subprocess.run([program, "--validate", copy.name], capture_output=True, cwd=scratch, timeout=60)
            if wrong := complaint(run):
                failures += 1
                print(f"FAILED: {name}: {wrong}\n  {run.stderr.decode(errors='replace')!r}", file=sys.stderr)
    print(f"{len(copies)} damaged meshes, {failures} failures")
    sys.exit(failures > 0)


main()
