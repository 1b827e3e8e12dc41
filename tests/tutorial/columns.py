#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""doc/manual/columns.md has a row for each column of each table that hpvi writes, and for no other.

columns.py HPVI ROOT
"""
import pathlib
import re
import subprocess
import sys
import tempfile

HPVI, ROOT = sys.argv[1], pathlib.Path(sys.argv[2])
# Together these write every kind of table.
SPACE = ["--set", "Probe spot/At=0.5, 0.5, 0.1", "--set", "Probe cut/From=0.5, 0.5, 0.1", "--set", "Probe cut/To=0.6, 0.5, 0.1"]
RUNS = (["prm/han-6-12.prm"], ["prm/ssnv128.prm"], [*SPACE, "prm/slab.prm"], ["prm/blocks.prm"],
        ["--set", "Loading/Steps=2", "--set", "Loading/Until steady=0.5", "--set", "Loading/Maximum cycles=2", "prm/fretting.prm"], ["prm/propped.prm"])


def documented():
    """Column patterns by table; NN in a file's name and N or NAME in a column's stand for any."""
    text = (ROOT / "doc/manual/columns.md").read_text()
    tables = {}
    for title, body in re.findall(r"^## (\S+\.csv).*?\n(.*?)(?=^## |\Z)", text, re.M | re.S):
        names = re.findall(r"^\| `(.*?)` \| \S.*\|$", body, re.M)
        if len(names) != len(set(names)):
            sys.exit(f"columns.md: a column of {title} has two rows")
        tables[title] = names
    return tables


def matches(pattern, column):
    return re.fullmatch(pattern.replace("NAME", "[a-z]+").replace("pN", r"p\d+"), column)


def written():
    columns = {}
    for arguments in RUNS:
        with tempfile.TemporaryDirectory() as directory:
            done = subprocess.run([HPVI, "--output", directory, "--set",
                                   "Adaptivity/Maximum steps=1", *arguments], cwd=ROOT,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            if done.returncode != 0:
                sys.exit(done.stdout)
            for file in pathlib.Path(directory).glob("*.csv"):
                table = re.sub(r"^probe-.+-", "probe-NAME-", re.sub(r"\d+", "NN", file.name))
                with open(file) as lines:
                    columns.setdefault(table, set()).update(next(lines).strip().split(","))
    return columns


def main():
    rows, columns = documented(), written()
    problems = [f"{table} is not written" for table in rows.keys() - columns.keys()]
    for table in columns:
        patterns = rows.get(table, [])
        problems += [f"{table}: {column} has no row" for column in sorted(columns[table])
                     if not any(matches(pattern, column) for pattern in patterns)]
        problems += [f"{table}: the row {pattern} is of no column" for pattern in patterns
                     if not any(matches(pattern, column) for column in columns[table])]
    sys.exit("\n".join(problems) or 0)


if __name__ == "__main__":
    main()
