#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Write what Debian packages want beside the program: the manual page, from the program's own texts, and both changelogs.

package_texts.py --program build/hpvi --output build/package
"""
import argparse
import datetime
import email.utils
import gzip
import os
import pathlib
import re
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]

parser = argparse.ArgumentParser()
parser.add_argument("--program", default="build/hpvi")
parser.add_argument("--output", default="build/package")
options = parser.parse_args()
OUTPUT = pathlib.Path(options.output)


def said(*words):
    return subprocess.run([options.program, *words], check=True, capture_output=True, text=True).stdout


def escaped(text):
    text = text.replace("\\", "\\e").replace("-", "\\-").replace("'", "\\(aq")
    return re.sub(r"^\.", r"\\&.", text, flags=re.MULTILINE)


def entries():
    """Of --print-parameters: a heading per section, a paragraph per entry with its default."""
    lines, remark = [], []
    for line in said("--print-parameters").splitlines()[2:]:  # below its own heading
        line = line.strip()
        if line.startswith("#"):
            remark.append(line.removeprefix("#").strip())
        elif line.startswith("subsection "):
            lines.append(f".SS {escaped(line.removeprefix('subsection '))}")
        elif line.startswith("set "):
            name, _, value = (part.strip() for part in line.removeprefix("set ").partition("="))
            lines += [".TP", f".B {escaped(name)}" + (f" = {escaped(value)}" if value else ""), escaped(" ".join(remark))]
        if not line.startswith("#"):
            remark = []
    return "\n".join(lines)


def manual_page():
    include = OUTPUT / "hpvi.h2m"
    include.write_text("[entries of a scene]\nA scene is a text file of assignments, \"set Entry = value\", in sections, "
                       f"\"subsection Name\" to \"end\"; a hash begins a remark. After the equals sign: the default.\n{entries()}\n\n"
                       "[see also]\nThe manual, its scenes and tutorial: /usr/share/doc/hpvi\\-doc, of the package hpvi\\-doc.\n")
    page = subprocess.run(["help2man", "--no-info", "--section=1", "--name=hp finite elements for elastic contact with friction",
                           f"--version-string={version}", f"--include={include}", options.program], check=True,
                          capture_output=True, text=True, env=dict(os.environ, SOURCE_DATE_EPOCH=date)).stdout
    include.unlink()
    day = datetime.date.fromtimestamp(int(date))  # in the place of month and year, which mandoc takes for no date
    return re.sub(r'^(\.TH \S+ "1" )"[^"]*"', rf'\1"{day}"', page, flags=re.MULTILINE)


def compress(name, text):
    with gzip.GzipFile(OUTPUT / name, "wb", 9, mtime=0) as file:
        file.write(text.encode())


OUTPUT.mkdir(parents=True, exist_ok=True)
news = (ROOT / "CHANGELOG.md").read_text()
version = said("--version").split()[1]
date = subprocess.run(["git", "-C", ROOT, "log", "-1", "--format=%ct"], capture_output=True, text=True).stdout.strip() or "0"
compress("hpvi.1.gz", manual_page())
compress("changelog.gz", news)
compress("changelog.Debian.gz", f"hpvi ({version}-1) unstable; urgency=low\n\n  * Version {version}: see changelog.gz.\n\n"
                                f" -- hpvi developers <hpvi@example.org>  {email.utils.formatdate(int(date))}\n")
