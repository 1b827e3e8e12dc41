# SPDX-License-Identifier: LGPL-2.1-or-later
"""freeze.py HPVI: tests/freeze.py finds no difference where there is none, and each one that there is, in every kind of file."""
import pathlib
import re
import subprocess
import sys
import tempfile

FREEZE = pathlib.Path(__file__).resolve().parents[1] / "freeze.py"
RUNS = ("--only", "scenes/threshold|validate/threshold|go_on/han|bad_input/no_support|commands/unknown")
# A digit or a word of each kind of file.
SPOILT = {"scenes/threshold/convergence.csv": r"(?m)^1,\d", "scenes/threshold/contact-01.csv": r"\d$",
          "scenes/threshold/forces.csv": r"\d(?=\D*$)", "scenes/threshold/summary.json": '"dofs": \\d',
          "scenes/threshold/solution-01.vtu": r"displacement.*values from .*[0-9a-f]",
          "scenes/threshold/said.txt": r"(?m)^1 \d", "scenes/threshold/scene.prm": "=",
          "validate/threshold/said.txt": "valid", "parameters/threshold/said.txt": "=", "picture/threshold/scene.json": r"\d",
          "go_on/han-6-12/convergence.csv": r"(?m)^3,\d", "bad_input/no_support/said.txt": "status 1", "commands/unknown/said.txt": "--"}


def freeze(command, program, directory):
    return subprocess.run([sys.executable, "-B", FREEZE, command, program, directory, *(RUNS if command == "keep" else ())], text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)


with tempfile.TemporaryDirectory() as home:
    kept = pathlib.Path(home) / "kept"
    if (done := freeze("keep", sys.argv[1], kept)).returncode:
        sys.exit(done.stdout)
    done = freeze("compare", sys.argv[1], kept)
    if done.returncode or "the same" not in done.stdout:
        sys.exit(f"one program differs from itself:\n{done.stdout}")
    for name, place in SPOILT.items():
        path = kept / "values" / name
        found = re.search(place, path.read_text())
        text = path.read_text()
        path.write_text(text[:found.end() - 1] + ("7" if text[found.end() - 1] != "7" else "8") + text[found.end():])
    (kept / "values/scenes/threshold/degrees.csv").unlink()
    done = freeze("compare", sys.argv[1], kept)
    missed = [name for name in [*SPOILT, "scenes/threshold/degrees.csv"] if f"{name}:" not in done.stdout]
    if missed or done.returncode != 1 or f"{len(SPOILT) + 1} of " not in done.stdout:
        sys.exit(f"status {done.returncode}, not noticed: {missed}\n{done.stdout}")
