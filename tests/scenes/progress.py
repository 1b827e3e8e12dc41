#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""progress.py HPVI SCENE.prm: a terminal shows what a step is doing and keeps none of it; where
standard output is no terminal nothing of it appears. Dense work that takes long is said before."""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

from runs import PROGRAM, on_terminal

ERASE = "\r\x1b[K"


def piped(command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def without_times(text):
    """Times differ from run to run: drop every number with a decimal point but no exponent."""
    return re.sub(r" +\d+\.\d+(?![\de])", "", text)


def main():
    scene = sys.argv[1]
    with tempfile.TemporaryDirectory() as home:
        command = [PROGRAM, "--output", home, "--set", "Output/VTU=false", scene,
                   "--set", "Adaptivity/Maximum steps=3"]
        shown, plain = on_terminal(command), piped(command)
        for stage in ("step 1: assembling 16 elements", "step 2: factorising ",
                      "step 3: finding stick and slip for ", "step 3: estimating the error of "):
            if stage not in shown:
                sys.exit(f"a terminal does not show '{stage}': {shown}")
            if stage in plain:
                sys.exit(f"a pipe receives '{stage}'")
        if "\r" in plain or "\x1b" in plain:
            sys.exit("a pipe receives control characters")
        kept = re.sub(r"[^\n]*" + re.escape(ERASE), "", shown)
        if without_times(kept) != without_times(plain):
            sys.exit(f"a terminal keeps\n{kept}\ninstead of\n{plain}")

        long = piped(command[:-1] + ["Adaptivity/Maximum steps=1", "--set", "Geometry/Subdivisions=1100, 1"])
        note, row = long.find("note: the dense algebra of 2200 multipliers takes"), long.find("\n   1 ")
        if not 0 <= note < row:
            sys.exit(f"no note before the first row: {long}")
        warnings = json.loads((pathlib.Path(home) / "summary.json").read_text())["warnings"]
        if sum("the dense algebra of 2200 multipliers takes" in line for line in warnings) != 1:
            sys.exit(f"summary.json does not say it: {warnings}")


if __name__ == "__main__":
    main()
