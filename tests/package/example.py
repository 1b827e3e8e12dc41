#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Install the build tree, build doc/example against it as a user does, and check what it prints.

example.py BUILD SOURCE CMAKE GENERATOR [COMPILER_FLAGS]
"""
import csv
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path


def run(*command, **options):
    done = subprocess.run([str(word) for word in command], text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done


def check(holds, message):
    if not holds:
        sys.exit(message)


def check_package(prefix):
    """What a user gets must not choose his flags, and must be complete."""
    (targets,) = prefix.rglob("hpviTargets.cmake")
    for word in ("-W", "-O", "-g", "-std", "NDEBUG", "HPVI_", str(Path.cwd())):
        check(not re.search(rf'[ ;"]{re.escape(word)}', targets.read_text()),
              f"{targets.name} hands {word} to users")
    for header in (prefix / "include/hpvi").rglob("*.h"):
        for name in re.findall(r"#include <(hpvi/.*)>", header.read_text()):
            check((prefix / "include" / name).exists(), f"{header} includes {name}: not installed")
    check((prefix / "bin/hpvi").exists(), "the program is not installed")


def check_numbers(output, errors):
    rows = list(csv.DictReader(output.splitlines()))
    load, states = 0.3, [row["state"] for row in rows]
    for row in rows:
        x, bound, traction = (float(row[name]) for name in ("x", "bound", "tangential_traction"))
        check(abs(bound - 0.1 * (1 + x)) < 1e-10, f"bound {bound} at x = {x}")
        check(abs(traction) <= bound * (1 + 1e-7), f"|T_t| = {abs(traction)} > g = {bound}")
        check((abs(traction) >= bound * (1 - 1e-7)) == (row["state"] == "slip"),
              f"{row['state']} where T_t = {traction}, g = {bound}")
        check(traction <= 1e-12 or row["state"] == "stick", f"T_t = {traction} pushes at x = {x}")
    check({"slip", "stick"} <= set(states), f"states {set(states)}")
    # The balance of forces: what the plane exerts is the load, to round-off.
    force = [float(word) for word in re.search(r"force of the plane (\S+) (\S+)", errors).groups()]
    check(abs(force[0] + load) < 1e-5 and abs(force[1]) < 1e-5, f"force of the plane {force}")
    # So is the integral of T_t, here by trapezes between Gauss points.
    x = [0.0] + [float(row["x"]) for row in rows] + [2.0]
    t = [float(row["tangential_traction"]) for row in rows]
    t = [t[0]] + t + [t[-1]]
    integral = sum((x[k + 1] - x[k]) * (t[k] + t[k + 1]) / 2 for k in range(len(x) - 1))
    check(abs(integral + load) < 0.02 * load, f"friction {integral}")
    bound = float(re.search(r"relative error at most (\S+),", errors).group(1))
    check("stopped by Tolerance" in errors and bound < 0.01, errors)


def main():
    build, source, cmake, generator = map(str, sys.argv[1:5])
    flags = " ".join(sys.argv[5:] + ["-Wall -Wextra -Wpedantic -Werror"])
    with tempfile.TemporaryDirectory() as scratch:
        prefix, own = Path(scratch) / "prefix", Path(scratch) / "build"
        run(cmake, "--install", build, "--prefix", prefix)
        check_package(prefix)
        run(cmake, "-S", source, "-B", own, "-G", generator, f"-DCMAKE_PREFIX_PATH={prefix}",
            f"-DCMAKE_CXX_FLAGS={flags}")
        run(cmake, "--build", own)
        done = run(own / "pushed_block", cwd=scratch, env={**os.environ, "OMP_NUM_THREADS": "1"})
        check_numbers(done.stdout, done.stderr)


if __name__ == "__main__":
    main()
