#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Does doc/manual/messages.md have what hpvi says when something is wrong, and nothing else?

messages.py --check

The literals of a message in the sources are parts of a row of the page, in which values stand as N for numbers, (x y) for places and
... for names; [a | b] is one of both, [a] may be missing. A message is what is thrown or warned of, and each literal with a remedy.
Says what is missing, and ends with 1 if that is anything.
"""
import html
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "doc/manual/messages.md"
TOKEN = re.compile(r"""//[^\n]*|/\*.*?\*/|^\#[^\n]*|R"\((?P<raw>.*?)\)"|"(?P<literal>(?:[^"\\]|\\.)*)"|'(?:[^'\\]|\\.)+'
                       |(?P<word>[A-Za-z_]\w*)|(?P<sign>[^\s\w])""", re.S | re.M | re.X)
# What stands in brackets behind these is said.
SPEAKERS = {"InputError", "reject", "refuse_row", "refuse_card", "Objection", "fail", "complain", "damaged", "refuse", "NumericalFailure", "MemoryFailure", "OutputFailure",
            "ShapeFlaw", "Flaw", "Problem", "Missing", "InadmissibleContact", "WarningKind"}
# Why there is no bound are literals of another form: long ones of these sources.
ALL_SAID = ("source/bound/error_bound.cc", "source/plane/matching.cc")
REMEDY = re.compile(r"; (?:add|allow|check|choose|cut|draw|enlarge|give|go on|leave|let|look|lower|make|mend|mesh|move|name|open|prescribe|put|"
                    r"raise|refine|remove|run|save|set|start|support|take|turn|use|wait|write)\b")
# Texts with a semicolon that ask for nothing, in reports and in what is said of entries, and answers to names of other programs.
NO_MESSAGES = ("source/output/", "source/program/command_line.cc", "source/reader/material_reader.cc", "source/reader/scene_aliases.cc")


def literals(code):
    """Literals, with adjacent ones as one, and whether they are said by a speaker."""
    found, depth, said, before = [], 0, None, ""
    for token in TOKEN.finditer(code):
        kind = token.lastgroup
        if kind in ("raw", "literal"):
            text = token[kind] if kind == "raw" else re.sub(r"\\(.)", lambda m: "\n" if m[1] == "n" else m[1], token[kind])
            if before == "literal":
                found[-1][0] += text
            else:
                found.append([text, said is not None])
            before = "literal"
        elif kind == "sign" and token["sign"] in "([{":
            depth += 1
            said = depth if said is None and before in SPEAKERS else said
            before = ""
        elif kind == "sign" and token["sign"] in ")]}":
            said = None if said == depth else said
            depth -= 1
            before = ""
        elif kind == "word" and token["word"] == "WarningKind" and said is None:
            said = depth  # {WarningKind::kind, size, text}
        elif kind:
            before = token[0]
    return found


def words(text):
    return f" {' '.join(re.findall(r'[A-Za-z0-9_]+', text))} "


def plain(text):
    return html.unescape(re.sub(r"\\(.)", r"\1", text.replace("**", " ")))


def complaints():
    """What the page lacks, and what it has in vain."""
    page, said, found = PAGE.read_text(), [], []
    all_words = words(plain(page))
    for path in [*sorted((ROOT / "source").rglob("*.cc")), *sorted((ROOT / "include").rglob("*.h"))]:
        name = str(path.relative_to(ROOT))
        if name.startswith("source/python"):
            continue
        for text, is_said in literals(path.read_text()):
            text = re.sub(r"^: [A-Z][^:]*: |^\nerror |%s", "", text)  # behind the name of the entry
            said.append(words(text))
            is_said |= name in ALL_SAID and len(text.split()) > 3 or (REMEDY.search(text) is not None and not name.startswith(NO_MESSAGES))
            if is_said and len(re.findall("[a-z]{2,}", text)) > 1 and said[-1] not in all_words:
                found.append(f"{name}: doc/manual/messages.md has no row with \"{text}\"")
    said = "\n".join(said)
    refused = page[page.index("# Refused input"):]
    for row in re.findall(r"^(?:> |- (?=[a-z]))(.*)", page, re.M) + re.findall(r"^\| (?!entry )[^|]*\| (.*) \|$", refused, re.M):
        text = plain(row)
        for part in re.split(r"\.\.\.|\bN\b|\(x y\)|[][|;:,()]", text):
            if words(part).strip() and words(part) not in said:
                found.append(f"doc/manual/messages.md: no source says \"{part.strip()}\" of \"{text.strip()}\"")
    for row in re.findall(r"^\| (?!entry ).*", refused, re.M):
        if "**" not in row:
            found.append(f"doc/manual/messages.md: no remedy in \"{plain(row).strip()}\"; write it behind a semicolon")
    for quoted, prose in re.findall(r"^### .*\n\n((?:>.*\n)+)\n*((?:(?!#).*\n)*)", page, re.M):
        if len(prose.split()) < 6:
            found.append(f"{quoted.strip()}: doc/manual/messages.md says no cause of it")
        if not all(";" in line for line in quoted.splitlines() if line != ">") and "**Remedy:**" not in prose:
            found.append(f"{quoted.strip()}: no remedy in it, and the page says none; write **Remedy:**")
    kinds = re.findall(r"^  (\w+),? +///<", (ROOT / "include/hpvi/results/warnings/warnings.h").read_text(), re.M)
    anchors = re.findall(r"^### .*(?:\{#|<a id=\")warning_(\w+)(?:\}|\"></a>)$", page, re.M)
    for kind in sorted({*kinds} ^ {*anchors}):
        found.append(f"warning {kind}: stands in one of WarningKind and doc/manual/messages.md, as an anchor, alone")
    return found


if __name__ == "__main__":
    missing = complaints()
    print("\n".join(missing), end="\n" if missing else "")
    sys.exit(1 if missing else 0)
