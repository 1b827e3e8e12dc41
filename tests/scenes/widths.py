# SPDX-License-Identifier: LGPL-2.1-or-later
"""widths.py HPVI: products without a matrix are the same for all widths of vectors that the machine has, and the loader takes the widest."""
import csv
import pathlib
import subprocess
import sys
import tempfile

hpvi = sys.argv[1]
loader = "/lib64/ld-linux-x86-64.so.2"
levels = ["x86-64-v4", "x86-64-v3"]
libraries = pathlib.Path(hpvi).resolve().parent / "glibc-hwcaps"


def command(mask):
    return [loader, "--glibc-hwcaps-mask", mask, hpvi]


def loaded(mask):
    """The library of cells that a run with this mask takes."""
    lines = subprocess.run([loader, "--glibc-hwcaps-mask", mask, "--list", hpvi], capture_output=True, text=True, check=True).stdout
    return next(line.split()[2] for line in lines.splitlines() if "libhpvi_cells.so" in line)


def energies(mask, scratch):
    subprocess.run(command(mask) + ["prm/slab.prm", "--set", "Adaptivity/Maximum unknowns=4000", "--set", "Solver/Primal tolerance=1e-11",
                                    "--set", "Solver/Linear=multigrid", "--output", scratch], check=True, capture_output=True)
    with open(pathlib.Path(scratch) / "convergence.csv") as table:
        return [float(row["lagrangian"]) for row in csv.DictReader(table)]


if not pathlib.Path(loader).exists() or not libraries.exists():
    print("no widths to choose from")
    sys.exit(0)
helped = subprocess.run([loader, "--help"], capture_output=True, text=True, check=True).stdout
present = [level for level in levels if any(level in line and "supported" in line for line in helped.splitlines())]
with tempfile.TemporaryDirectory() as scratch:
    baseline = energies("none", scratch + "/none")
    assert "glibc-hwcaps" not in loaded("none"), loaded("none")
    for level in present:
        assert level in loaded(level), (level, loaded(level))
        for ours, theirs in zip(energies(level, scratch + "/" + level), baseline, strict=True):
            assert abs(ours - theirs) <= 1e-10 * abs(theirs), (level, ours, theirs)
if present:
    unmasked = subprocess.run([loader, "--list", hpvi], capture_output=True, text=True, check=True).stdout
    assert any(present[0] in line for line in unmasked.splitlines() if "libhpvi_cells.so" in line), unmasked
print("widths:", ", ".join(present + ["baseline"]))
