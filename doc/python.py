#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run the code of doc/python.md, block by block in one process, and compare what it prints with what stands below.

python.py --module DIR [--write]

--write writes what is printed into the page, and the pictures into doc/python. Blocks that plot are left out where there is no
matplotlib, and said to be.
"""
import argparse
import contextlib
import importlib.util
import io
import os
import pathlib
import re
import shutil
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "doc/python.md"
BLOCK = re.compile(r"```python\n(.*?)```\n(?:\n```\n(.*?)```\n)?", re.S)


class Notebook:
    """What one block defines the next one has."""

    def __init__(self, can_plot):
        self.names, self.can_plot, self.problems = {}, can_plot, []

    def run(self, match):
        """The block with what it prints."""
        code, wanted = match[1], match[2] or ""
        if "plot" in code and not self.can_plot:
            print(f"left out, for there is no matplotlib:\n{code}")
            return match[0]
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile(code, str(PAGE), "exec"), self.names)  # pylint: disable=exec-used
        printed = printed.getvalue()
        if printed != wanted:
            self.problems.append(f"{code}\nprints\n{printed}\nand not\n{wanted}")
        return f"```python\n{code}```\n" + (f"\n```\n{printed}```\n" if printed else "")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--module", required=True, type=pathlib.Path)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    sys.path.insert(0, str(options.module.resolve()))
    can_plot = importlib.util.find_spec("matplotlib") is not None
    if can_plot:
        os.environ["MPLBACKEND"] = "Agg"
    notebook = Notebook(can_plot)
    with tempfile.TemporaryDirectory() as home:
        os.chdir(home)
        pathlib.Path("prm").symlink_to(ROOT / "prm")
        text = BLOCK.sub(notebook.run, PAGE.read_text())
        if options.write:
            PAGE.write_text(text)
            (ROOT / "doc/python").mkdir(exist_ok=True)
            for picture in pathlib.Path().glob("*.png"):
                shutil.copy(picture, ROOT / "doc/python")
        os.chdir(ROOT)
    if notebook.problems and not options.write:
        sys.exit("\n".join(notebook.problems))


if __name__ == "__main__":
    main()
