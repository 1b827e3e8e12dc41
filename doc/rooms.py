#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The rooms of source/, what they include of each other, as a picture, and their nouns, by the first comment of each header.

rooms.py [--root ROOT] [--picture FILE.svg] [--nouns]

The first room of the map stands at the bottom. An arrow leads from a room to one of which it includes something, its number is
how many includes there are; in order they lead downwards, those that lead upwards are red. Prints how many of both there are.
"""
import argparse
import collections
import math
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parent.parent
ROW, STEP, LEFT, BOX = 22, 17, 60, 150  # heights and widths in pixels


def rooms(root=ROOT):
    """Names in the order of the map, each with its sentence."""
    text = (root / "doc/architecture.md").read_text().split("\n## Rooms\n")[1].split("\n## ")[0]
    return {name: " ".join(words.split()) for name, words in re.findall(r"^- \*\*(\w+)\*\*: (.*?)(?=^- |^$)", text, re.M | re.S)}


def files_of(room, root=ROOT):
    return sorted([*(root / "include/hpvi" / room).rglob("*.h"), *(root / "source" / room).rglob("*.cc")])


def includes(root=ROOT):
    """How often a room includes headers of another, by (room, other)."""
    counts, names = collections.Counter(), list(rooms(root))
    for room in names:
        for file in files_of(room, root):
            for other in re.findall(r"^#include <hpvi/(\w+)/[\w/]+\.h>", file.read_text(), re.M):
                counts[room, other] += other != room and other in names
    return +counts


def first_comment(file):
    """The first paragraph of the first doc comment of a file; of a source without a header any comment before code will do."""
    text = re.sub(r"^// SPDX.*\n", "", file.read_text())
    found = re.search(r"/\*\*(.*?)\*/", text, re.S)
    if found:
        return " ".join(re.sub(r"^ *\* ?", "", found[1].split("\n *\n")[0].strip(), flags=re.M).split())
    found = re.match(r"(?:#include.*\n|\n)*((?://.*\n)+)", text)
    return " ".join(found[1].replace("//", "").split()) if found and file.suffix == ".cc" else ""


def nouns(root=ROOT):
    """A page of the manual: for each room a table of its headers."""
    lines = ["# Rooms and their nouns {#nouns}", "",
             "What each header of `include/hpvi` declares first, in its own words; [the map](@ref architecture) says what each room is for.", ""]
    for room, words in rooms(root).items():
        lines += [f"## {room} {{#nouns_{room}}}", "", words[0].upper() + words[1:], "", "| header | declares | what it is |", "|---|---|---|"]
        for file in files_of(room, root):
            if file.suffix != ".h":
                continue
            declared = re.findall(r"^(?:class|struct|enum class|using) (\w+)(?=\n|$| *[{:=])", file.read_text(), re.M)
            declared += re.findall(r"^(?!template|using|#)[\w:<>, &*]*[ &*](\w+)\(", file.read_text(), re.M)
            sentence = re.split(r"(?<=[.;:]) (?=[A-Z])", first_comment(file))[0]
            sentence = re.sub(r"@p (\w+)", r"`\1`", sentence).replace("|", "&#124;").replace("<", "&lt;").replace("@", "\\@").replace("$", "&#36;")
            lines.append(f"| `{file.relative_to(root / 'include/hpvi' / room).with_suffix('')}` | {', '.join(f'`{name}`' for name in dict.fromkeys(declared[:4]))} | {sentence} |")
        lines.append("")
    return "\n".join(lines)


def upward(names, counts):
    """Arrows to rooms that come later."""
    place = {name: k for k, name in enumerate(names)}
    return [(room, other) for room, other in counts if place[other] > place[room]]


def picture(root=ROOT):
    names, counts = list(rooms(root)), includes(root)
    lines = {room: sum(len(file.read_text().splitlines()) for file in files_of(room, root)) for room in names}
    height = {room: 14 + ROW * (len(names) - 1 - k) + ROW / 2 for k, room in enumerate(names)}
    wrong = set(upward(names, counts))
    farthest = max((abs(names.index(a) - names.index(b)) for a, b in counts), default=1)
    left = LEFT + max((STEP * abs(names.index(a) - names.index(b)) for a, b in wrong), default=0)
    width, most = left + BOX + STEP * farthest + 30, max(lines.values(), default=1)
    drawn, numbers = [], []
    for (room, other), n in sorted(counts.items(), key=lambda item: (item[0] in wrong, item[1])):
        begin, end = height[room], height[other]
        span, is_wrong = abs(names.index(room) - names.index(other)), (room, other) in wrong
        x, side = (left, -1) if is_wrong else (left + BOX, 1)
        colour = "#c1272d" if is_wrong else "#7d8ea3"
        drawn.append(f'<path d="M{x} {begin:g}A{STEP * span} {abs(end - begin) / 2:g} 0 0 1 {x + 3 * side} {end:g}" stroke="{colour}" '
                     f'stroke-width="{0.5 + 0.45 * math.log2(n):.2g}" marker-end="url(#{"wrong" if is_wrong else "right"})">'
                     f"<title>{room} includes {other}: {n}</title></path>")
        numbers.append(f'<text x="{x + side * STEP * span:g}" y="{(begin + end) / 2 + 3:g}" fill="{"#c1272d" if is_wrong else "#1b3a5c"}">'
                       f"{n}</text>")
    boxes = []
    for room in names:
        y = height[room]
        boxes.append(f'<rect x="{left}" y="{y - 9:g}" width="{BOX}" height="18" rx="3" fill="#eef2f7" stroke="#7d8ea3"/>'
                     f'<rect x="{left}" y="{y - 9:g}" width="{BOX * lines[room] / most:.0f}" height="18" rx="3" fill="#c9d8ea"/>'
                     f'<text x="{left + 6}" y="{y + 4:g}" class="room">{room}</text>'
                     f'<text x="{left + BOX - 6}" y="{y + 3.5:g}" class="lines">{lines[room]}</text>')
    markers = "".join(f'<marker id="{name}" viewBox="0 0 6 6" refX="5" refY="3" markerWidth="7" markerHeight="7" '
                      f'markerUnits="userSpaceOnUse" orient="auto"><path d="M0 0L6 3L0 6z" fill="{colour}" stroke="none"/></marker>'
                      for name, colour in (("right", "#7d8ea3"), ("wrong", "#c1272d")))
    bottom = 14 + ROW * len(names)
    words = f"{len(names)} rooms, {sum(lines.values())} lines, {len(counts)} arrows, {len(wrong)} of them upwards"
    return "\n".join([
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {bottom + 26}" width="{width}" height="{bottom + 26}">',
        "<!-- SPDX-License-Identifier: LGPL-2.1-or-later, drawn by doc/rooms.py -->",
        "<style>text{font:8px sans-serif;text-anchor:middle;stroke:#fff;stroke-width:2.5;paint-order:stroke}"
        ".room{font-size:12px;text-anchor:start;stroke:none}.lines{font-size:9px;text-anchor:end;stroke:none;fill:#555}"
        ".words{font-size:11px;text-anchor:start;stroke:none}</style>",
        f"<defs>{markers}</defs>", '<rect width="100%" height="100%" fill="#fff"/>',
        '<g fill="none">', *drawn, "</g>", *numbers, *boxes,
        f'<text x="{left}" y="{bottom + 14}" class="words">{words}</text>', "</svg>", ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--root", type=pathlib.Path, default=ROOT)
    parser.add_argument("--picture", type=pathlib.Path)
    parser.add_argument("--nouns", action="store_true", help="print the tables of the manual")
    options = parser.parse_args()
    if options.nouns:
        print(nouns(options.root))
        return
    names, counts = list(rooms(options.root)), includes(options.root)
    wrong = upward(names, counts)
    if options.picture:
        options.picture.write_text(picture(options.root))
    print(f"{len(names)} rooms, {len(counts)} arrows between them with {sum(counts.values())} includes, {len(wrong)} upwards"
          + "".join(f"\n  {room} includes {other}: {counts[room, other]}" for room, other in wrong))


if __name__ == "__main__":
    main()
