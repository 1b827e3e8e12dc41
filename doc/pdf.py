#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The manual as one PDF: the pages that doc/manual/index.md lists, in its order.

pdf.py --output build/doc

pandoc makes one page of HTML of them, MathJax sets the formulas in it, and wkhtmltopdf prints it; all are Debian's, and no network is
asked for. Links between pages become links inside of the page.
"""
import argparse
import os
import pathlib
import re
import subprocess
import sys

from manual import MATHJAX, PAGES, ROOT
from pages import slug

STYLE = """<style>
body { max-width: none; font-family: serif; font-size: 11pt; }
header { display: none; } h1 ~ h1 { page-break-before: always; }
table { border-collapse: collapse; font-size: 9pt; page-break-inside: auto; }
th, td { border-top: 1px solid #bbb; padding: 2px 6px; text-align: left; vertical-align: top; }
pre { font-size: 8pt; white-space: pre-wrap; background: #f4f4f4; padding: 4px; }
code { font-size: 9pt; } img { max-width: 100%; } blockquote { color: #333; font-size: 10pt; }
</style>
<script type="text/x-mathjax-config">
MathJax.Hub.Config({ showMathMenu: false, messageStyle: "none" });
MathJax.Hub.Queue(function () { window.status = "set"; });
</script>
"""


def pages():
    """Of the manual, in the order of its start page."""
    start = PAGES / "index.md"
    listed = [start] + [(PAGES / name).resolve() for name in re.findall(r"\]\(([\w./-]+\.md)(?:#[\w-]*)?\)", start.read_text())]
    return [page for page in dict.fromkeys(listed) if ROOT / "doc" in page.parents]


def label(page):
    return "-".join(page.relative_to(ROOT / "doc").with_suffix("").parts)


def inside(page, known):
    """A page with names of its headings that no other has, links to those, and pictures by their whole path."""
    def heading(match):
        return f"{match[1]} {match[2]} {{#{label(page)}--{slug(match[2])}}}"

    def link(match):
        words, name, place = match.groups()
        target = (page.parent / name).resolve() if name else page
        if target not in known:
            return words
        is_own = bool(place) and f'id="{place}"' in target.read_text()
        return f"[{words}](#{place if is_own else '--'.join(filter(None, (label(target), place)))})"

    def prose(text):
        text = re.sub(r"^(#+) (.*)$", heading, text, flags=re.M)
        text = re.sub(r"(!\[[^\]]*\]\()([^)]*)\)", lambda m: f"{m[1]}{(page.parent / m[2]).resolve()})", text)
        text = re.sub(r'src="([^"]*)"', lambda m: f'src="{(page.parent / m[1]).resolve()}"', text)
        return re.sub(r"(?<!!)\[([^\]]*)\]\((?!https?:)([^)#\s]*)(?:#([\w-]*))?\)", link, text)

    parts = re.split(r"(^```.*?^```$|`[^`\n]*`)", re.sub(r"<!--.*?-->\n?", "", page.read_text(), flags=re.S), flags=re.S | re.M)
    return f'<a id="{label(page)}"></a>\n\n' + "".join(part if k % 2 else prose(part) for k, part in enumerate(parts))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--output", required=True, type=pathlib.Path)
    output = parser.parse_args().output.resolve()
    output.mkdir(parents=True, exist_ok=True)
    known = pages()
    text = "\n\n".join(inside(page, known) for page in known)
    places = {one for both in re.findall(r"\{#([\w-]+)\}|id=\"([\w-]+)\"", text) for one in both}
    if missing := sorted(set(re.findall(r"\]\(#([\w-]+)\)", text)) - places):
        sys.exit(f"pdf.py: links lead to {', '.join(missing)}, which is not there")
    (output / "pdf.md").write_text(text)
    (output / "pdf.style").write_text(STYLE)
    commands = (["pandoc", "-f", "markdown-yaml_metadata_block-auto_identifiers", "-t", "html5", "-s", "--metadata", "title=hpvi", "-H", output / "pdf.style",
                 f"--mathjax=file://{MATHJAX}/MathJax.js?config=TeX-AMS_SVG", "-o", output / "pdf.html", output / "pdf.md"],
                ["wkhtmltopdf", "-q", "--enable-local-file-access", "--window-status", "set", "-s", "A4", "--image-quality", "85", output / "pdf.html", output / "hpvi.pdf"])
    for command in commands:
        done = subprocess.run([str(word) for word in command], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              env={**os.environ, "QT_QPA_PLATFORM": "offscreen", "XDG_RUNTIME_DIR": str(output)})
        if done.returncode != 0:
            sys.exit(f"pdf.py: {command[0]} ends with status {done.returncode}\n{done.stdout}")
        if lost := sorted(places - {""} - set(re.findall(r'id="([^"]*)"', (output / "pdf.html").read_text()))):
            sys.exit(f"pdf.py: {', '.join(lost[:9])}, of {len(lost)} in all, are not in the page of HTML; is a bracket open above the first?")
    print(f"the manual is {os.path.relpath(output / 'hpvi.pdf')}")


if __name__ == "__main__":
    main()
