#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Measure the Markdown pages: length of lines and sentences, and whether each link between them leads to a place that is there.

pages.py [--check | --longest PAGE]

Limits: no words of a diary; lines of 120 characters, tables and lines that are one link excepted; 20 words a sentence on average and 35
in any; 40 words in a cell of a table; README.md 9000 bytes and 120 lines; doc/manual 350 kB. Code, formulas, headings and quoted messages
are not counted; a formula, or a name in backticks, is one word. --check ends with 1 where a page exceeds a limit, a link leads nowhere,
two pages have one name, the start page of the manual leaves one out, or a notebook has outputs. --longest prints what exceeds the limits
of a page.
"""
import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
LINE, AVERAGE, SENTENCE, CELL = 120, 20, 35, 40
README = {"bytes": 9000, "lines": 120}
MANUAL = 350000
# What a page may have, column by column.
LIMITS = {"diary": 0, "long_lines": 0, "words_per_sentence": AVERAGE, "long_sentences": 0, "long_cells": 0}
COMMIT = r"(?<![./\d])\b(?=[0-9a-f]*\d)(?=[0-9a-f]*[a-f])(?:[0-9a-f]{7,8}|[0-9a-f]{40})\b(?![-+.]\d)"
DIARY = re.compile(r"(?i:\b(?:ours|yesterday|today|tonight|recently|of late|(?:this|last|one) (?:morning|afternoon|evening|night|week|month))\b)|" + COMMIT)
ABBREVIATION = re.compile(r"\b(?:e\.g|i\.e|cf|vs|Fig|Eq|No|resp|approx|pp?)\.$")


def pages():
    return [*sorted(ROOT.glob("*.md")), *sorted((ROOT / "prm").glob("*.md")), *sorted((ROOT / "doc").rglob("*.md"))]


def without_code(text):
    text = re.sub(r"^<!-- @.*?^<!-- end -->$", "", text, flags=re.S | re.M)  # what ./run doc has written
    text = re.sub(r"<!--.*?-->", "", text, flags=re.S)
    return re.sub(r"^```.*?^```$", "", text, flags=re.S | re.M)


def plain(text):
    """Prose with one word for each formula and name, without what is not read aloud."""
    text = re.sub(r"\$\$(.*?)\$\$", lambda formula: " F. " if re.search(r"\.\s*(\\tag\{.*?\}\s*)?(\\end\{\S+\}\s*)?$", formula[1]) else " F ", text,
                  flags=re.S)  # one that ends with a full stop ends its sentence
    text = re.sub(r"\$[^$\n]+\$|\$[^$]+?\$", "F", text)
    text = re.sub(r"`[^`]*`", "C", text)
    text = re.sub(r"(?:\[[^\]]*\]\([^)]*\),\s+){5,}", "C, ", text)  # a list of links is no sentence
    text = re.sub(r"!\[[^\]]*\]\([^)]*\)", "", text)
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", text)
    return re.sub(r"</?\w[^>]*>|[*_]{2}", "", text)


def n_words(text):
    return sum(bool(re.search(r"\w", word)) for word in text.split())


def sentences(text):
    """Of the paragraphs and items of lists of a page."""
    lines = []
    for line in without_code(text).splitlines():
        if re.match(r"#|\||>|</?t|@\w+ .*@$| {4,}[^-*\s]", line):
            lines.append("")
        else:
            lines.append(re.sub(r"^\s*(?:[-*]|\d+\.) ", "\n", line))
    found = []
    for paragraph in re.split(r"\n\s*\n", plain("\n".join(lines))):
        begin = 0
        for end in re.finditer(r"[.!?][\"')*]*(?=\s|$)", paragraph):
            if not ABBREVIATION.search(paragraph[:end.start() + 1]):
                found.append(paragraph[begin:end.end()])
                begin = end.end()
        found.append(paragraph[begin:])
    return [" ".join(sentence.split()) for sentence in found if n_words(sentence) > 0]


def cells(text):
    rows = re.findall(r"^\|(?!.*; \*\*).*\|$", without_code(text), re.M)  # without messages and their remedies
    return [cell for row in rows for cell in re.split(r"(?<!\\)\|", re.sub(r"`[^`]*`", "C", row))]


def long_lines(text):
    """Beyond 120 characters, but for tables and what is one link, picture, title or quoted message."""
    return [line for line in without_code(text).splitlines()
            if len(line) > LINE and not re.match(r"\||<|>|#|\s*(?:- )?!?\[[^\]]*\]\([^)]*\)[.,;]?$|@\w+ .*@$", line)]


def diary(text):
    """Words of a day or of an owner, and commits: a page says what holds, and CHANGELOG.md what changed."""
    prose = re.sub(r"`[^`]*`|\]\([^)]*\)", "", without_code(text))
    return [match[0] for match in DIARY.finditer(prose)]


def measured(text):
    lengths = [n_words(sentence) for sentence in sentences(text)]
    return {"diary": len(diary(text)),
            "long_lines": len(long_lines(text)),
            "words_per_sentence": -(-sum(lengths) // len(lengths)) if lengths else 0,
            "long_sentences": sum(length > SENTENCE for length in lengths),
            "long_cells": sum(n_words(plain(cell)) > CELL for cell in cells(text))}


def slug(heading):
    """What GitHub calls a heading."""
    return re.sub(r"[^\w -]", "", re.sub(r"<[^>]*>| \{#[\w-]+\}$|\[([^\]]*)\]\([^)]*\)", r"\1", heading).strip().lower()).replace(" ", "-")


def places(path):
    """What links may name behind a hash: headings as GitHub calls them, and anchors."""
    text = re.sub(r"^```.*?^```", "", path.read_text(), flags=re.S | re.M)
    return {first or second for first, second in re.findall(r"\{#([\w-]+)\}|<a id=\"([\w-]+)\">", text)} \
        | {slug(heading) for heading in re.findall(r"^#+ (.*?)$", text, re.M)}


def missing_links():
    found, n = [], 0
    for page in pages():
        text = re.sub(r"^```.*?^```|`[^`\n]*`", "", page.read_text(), flags=re.S | re.M)
        for target in re.findall(r"\]\(([^)\s:@]+)\)|(?:src|href)=\"([^\":$]+)\"", text):
            n += 1
            name, _, place = "".join(target).partition("#")
            path = page.parent / name if name else page
            if not path.exists() or (place and path.suffix == ".md" and place not in places(path)):
                found.append(f"{page.relative_to(ROOT)} links to {''.join(target)}, which is not there")
    return found if n > 300 else [f"of the links of all pages {n} are found"]


def misplaced():
    """Pages of doc/ and doc/manual of one name, and those that the start page of the manual does not list."""
    start = (ROOT / "doc/manual/index.md").read_text()
    guide, theory = ({page.name for page in (ROOT / folder).glob("*.md")} for folder in ("doc/manual", "doc"))
    return [f"doc/{name} and doc/manual/{name}: one name for two pages" for name in sorted(guide & theory)] \
        + [f"doc/manual/index.md does not list {link}" for link in sorted(guide - {"index.md"}) + [f"../{name}" for name in sorted(theory)]
           if f"]({link}" not in start]


def complaints():
    found = missing_links() + misplaced()
    readme = (ROOT / "README.md").read_bytes()
    for name, value in (("bytes", len(readme)), ("lines", readme.count(b"\n"))):
        if value > README[name]:
            found.append(f"README.md: {value} {name}, more than {README[name]}")
    if (n_bytes := sum(page.stat().st_size for page in (ROOT / "doc/manual").glob("*.md"))) > MANUAL:
        found.append(f"doc/manual: {n_bytes} bytes, more than {MANUAL}")
    for notebook in sorted((ROOT / "doc/notebooks").glob("*.ipynb")):
        if any(cell.get("outputs") or cell.get("execution_count") for cell in json.loads(notebook.read_text())["cells"]):
            found.append(f"{notebook.relative_to(ROOT)} has outputs; clear them before you save it")
    for page in pages():
        name = str(page.relative_to(ROOT))
        for column, value in measured(page.read_text()).items():
            if value > LIMITS[column]:
                found.append(f"{name}: {column} {value}, more than {LIMITS[column]}; see python3 doc/pages.py --longest {name}")
    return found


def show():
    print(f"{'page':32}{'bytes':>8}" + "".join(f"{name:>20}" for name in LIMITS))
    n_bytes = 0
    for page in pages():
        n_bytes += page.stat().st_size
        values = measured(page.read_text())
        print(f"{page.relative_to(ROOT)!s:32}{page.stat().st_size:8}" + "".join(f"{values[name]:20}" for name in LIMITS))
    print(f"{'all':32}{n_bytes:8}")


def main():
    if sys.argv[1:2] == ["--longest"]:
        text = (ROOT / sys.argv[2]).read_text()
        print("\n".join([f"of a diary: {one}" for one in diary(text)]
                        + [f"{n_words(one)} words: {one}" for one in sentences(text) if n_words(one) > SENTENCE]
                        + [f"{n_words(plain(one))} words: {one}" for one in cells(text) if n_words(plain(one)) > CELL]
                        + [f"{len(one)} characters: {one}" for one in long_lines(text)]))
    elif sys.argv[1:] == ["--check"]:
        sys.exit("\n".join(complaints()) or 0)
    else:
        show()


if __name__ == "__main__":
    main()
