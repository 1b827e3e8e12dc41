#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""usage: mutations.py HPVI SCENE.prm... [--number N] [--seed S]

Spoils one scene after the other at random, the same way each time, and validates them. Whatever is given, the program
ends with status 0 and nothing on stderr, or with status 1 and one printable line; never with an
internal error.
"""

import argparse
import pathlib
import random
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "fuzz"))
import findings

NUMBERS = """0 -0 1 -1 2 3 0.5 1e-5 1e5 1e30 1e-30 1e100 1e-101 1e200 -1e200 1e308 1.8e308 5e-324 1e-310 1e-400 nan inf
-inf +1 .5 5. 1e 0x10 1,5 1;5 99999999999 4294967296 -2147483649 1e3 007 1_000 pi E""".split()
TEXTS = ["", " ", "\t", "x", "y", "sin(", ")", "1/x", "1/(x-1)", "log(x)", "sqrt(-1)", "x^1000", "rand()", "rand_seed(1)", "x=1",
         "x==1", "if(x<1,2,3)", "x<1?2:3", "(1,2)", "\"a\"", "e", "1e200*x", "free", "exact", "free; free", "exact; exact",
         ";", ";;", ",", "\\", "#", "'", "\u00a0", "\u0085", "\u2028", "\u202e", "é", "\x1b[31m", "\x00", "\x7f",
         "0,\t1", "0\t,1", "0,0;\t1,0; 1,1; 0,1", "0,0; 1,0; 1,1e-9; 0,1", "0,0; 1,0; 1,1; 0,1;", "0,,1", "(" * 300,
         "1+" * 2000 + "1", "a" * 5000, "{", "true", "false", "none", "bilateral", "unilateral", "tangential", "quadrilateral",
         "stick-slip", "smooth", "limited", "cohesive", "hertz", "partial-slip", "nodes", "multiplier", "automatic", "active set", "hpa1", "pu", "/", "..",
         "top", "left; right", "E", "nu*x", "stress", "x > 0.4", "min(x, y)", "(x-1)*(y-1)", "0.3 - abs(x - 1)", "t", "/dev/null", "%s%n", "$(ls)", "0.4<x<0.6", "x<y==(z", "&&", "x<1&&y", "tied", "upper.bottom, lower.top", "lower.top", "upper.top, lower.left",
         "cylinder.arc, block.top", "bush.inner, ring.inner", "block.left", "half disc", "ring sector", "axisymmetric"]
# Entries of materials and parts of which only some scenes have any.
NAMED = [f"{section}/{entry}" for section, entries in (
    ("Material soft", ("Where", "Young's modulus", "Poisson's ratio", "Density", "Plane", "Thickness", "Elasticity", "Young's moduli", "Poisson's ratios", "Shear moduli", "Angle", "Initial strain", "Thermal expansion")),
    ("Boundary foot", ("On", "Where", "Displacement", "Traction", "Pressure", "Shear", "Rigid", "Force", "Rotation", "Moment", "Contact", "Gap", "Contact direction", "Friction bound")),
    ("Body upper", ("Shape", "Lower corner", "Upper corner", "Corners", "Centre", "Radius", "Radii", "Angle", "Angles", "Subdivisions", "Graded towards", "Grading levels",
                    "Material")),
    ("Contact joint", ("Between", "Law", "Gap", "Closed within", "Friction bound", "Friction coefficient", "Slave")),
    ("Probe tip", ("At", "Size", "On", "From", "To", "Points")))
    for entry in entries]
BYTES = [bytes([b]) for b in (0, 1, 9, 10, 11, 12, 13, 27, 32, 34, 35, 40, 41, 44, 45, 46, 48, 57, 59, 61, 92, 101, 127,
                              128, 133, 192, 237, 244, 255)] + [c.encode() for c in "é\u0085\u2028\u202e😀"]


def spoil(scene, entries, rng):
    """The bytes of a spoilt scene and the --set arguments that spoil it further."""
    data, overrides = bytearray(scene), []
    for _ in range(rng.choice((1, 1, 1, 2, 3))):
        lines = bytes(data).split(b"\n")
        settings = [i for i, line in enumerate(lines) if b"=" in line]
        kind = rng.randrange(8)
        if kind == 0:  # a byte more
            data[rng.randrange(len(data) + 1):0] = rng.choice(BYTES)
        elif kind == 1 and data:  # another byte
            i = rng.randrange(len(data))
            data[i:i + 1] = rng.choice(BYTES)
        elif kind == 2 and data:  # a piece less
            i = rng.randrange(len(data))
            del data[i:i + rng.randrange(1, 30)]
        elif kind == 3 and lines:  # a line elsewhere
            lines.insert(rng.randrange(len(lines)), rng.choice(lines))
            data = bytearray(b"\n".join(lines))
        elif kind in (4, 5) and settings:  # another value
            i = rng.choice(settings)
            value = rng.choice(NUMBERS if kind == 4 else TEXTS)
            lines[i] = lines[i].split(b"=")[0] + b"= " + value.encode()
            data = bytearray(b"\n".join(lines))
        else:  # another value on the command line, where bytes of 0 cannot be
            name = rng.choice(entries + NAMED) if rng.random() < 0.9 else rng.choice(TEXTS)
            values = [rng.choice(NUMBERS + TEXTS) for _ in range(rng.choice((1, 1, 2)))]
            if name in NAMED and rng.random() < 0.7:  # there is such a material, such a part
                overrides += ["--set", "Material soft/Where=x - 1" if name.startswith("Material") else "Boundary foot/On=top"]
            overrides += ["--set", (name + "=" + rng.choice((", ", "; ", ",\t")).join(values)).replace("\0", "?")]
    return bytes(data), overrides


def entries_of(program, scene):
    """The paths of all entries."""
    text = subprocess.run([program, "--print-parameters", scene], capture_output=True, check=True, text=True).stdout
    section, paths = "", []
    for line in map(str.strip, text.splitlines()):
        if line.startswith("subsection "):
            section = line[len("subsection "):] + "/"
        elif line == "end":
            section = ""
        elif line.startswith("set "):
            paths.append(section + line[len("set "):].split("=")[0].strip())
    return paths


def complaint(run):
    """What is wrong with the way in which the program ended; empty: nothing."""
    if run.returncode == 0:
        return "something on stderr" if run.stderr else ""
    if run.returncode != 1:
        return f"exit status {run.returncode}"
    return findings.of_line(run.stderr)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("scenes", nargs="+")
    parser.add_argument("--number", type=int, default=25)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    program = str(pathlib.Path(options.program).resolve())
    scenes = [pathlib.Path(name).read_bytes() for name in options.scenes]
    entries = entries_of(program, options.scenes[0])
    rng = random.Random(options.seed)
    failures, statuses = 0, [0, 0]
    with tempfile.TemporaryDirectory() as scratch:
        for number in range(options.number):
            file = pathlib.Path(scratch) / rng.choice(("scene.prm", "a\nb.prm", "\x1b[31m.prm", "é.prm"))
            data, overrides = spoil(scenes[number % len(scenes)], entries, rng)
            file.write_bytes(data)
            run = subprocess.run([program, "--validate", *overrides, file.name], capture_output=True, cwd=scratch, timeout=60)
            wrong = complaint(run)
            if not wrong and len(list(pathlib.Path(scratch).iterdir())) > 1:
                wrong = "files were written"
            if wrong:
                failures += 1
                print(f"FAILED: number {number}: {wrong}\n  {overrides}\n  {run.stderr!r}", file=sys.stderr)
            else:
                statuses[run.returncode] += 1
            file.unlink()
    print(f"{options.number} spoilt scenes: {statuses[0]} valid, {statuses[1]} refused, {failures} failures")
    sys.exit(failures > 0 or 0 in statuses)  # both answers must have been heard


main()
