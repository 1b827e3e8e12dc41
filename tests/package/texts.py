#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""texts.py PROGRAM SOURCE: the manual page of packages names all options and entries, and is one to man's readers."""
import gzip
import re
import subprocess
import sys
import tempfile
from pathlib import Path

program, source = sys.argv[1], Path(sys.argv[2])


def said(*command, text=None):
    return subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True, input=text).stdout


with tempfile.TemporaryDirectory() as directory:
    said(sys.executable, source / "source/package/package_texts.py", "--program", program, "--output", directory)
    page = gzip.open(Path(directory, "hpvi.1.gz"), "rt").read()
    news = gzip.open(Path(directory, "changelog.Debian.gz"), "rt").read()
    if [path.name for path in Path(directory).iterdir() if not path.name.endswith(".gz")]:
        sys.exit("something is left over beside the texts")
# STYLE and below are of taste; what mandoc calls a warning a reader can see.
complaints = subprocess.run(["mandoc", "-T", "lint", "-W", "warning"], input=page, capture_output=True, text=True)
if complaints.returncode:
    sys.exit(complaints.stdout)
read = re.sub(r".\x08", "", said("mandoc", "-T", "utf8", "-O", "width=1000", text=page))
options = re.findall(r"^  (?:-\w \[ )?(--[a-z-]+)", said(program, "--help"), re.MULTILINE)
entries = re.findall(r"^ *set (.*?) *=", said(program, "--print-parameters"), re.MULTILINE)
missing = [word for word in options + entries if word not in read]
if "SYNOPSIS" not in read:
    sys.exit("the manual page has no synopsis")
if missing or len(options) < 9 or len(entries) < 100:
    sys.exit(f"the manual page lacks {missing}, of {len(options)} options and {len(entries)} entries")
if said(program, "--version").split()[1] not in news:
    sys.exit(f"changelog.Debian.gz is of another version: {news}")
