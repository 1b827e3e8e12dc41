# SPDX-License-Identifier: LGPL-2.1-or-later
"""module.py: 400 scenes by the Python module hpvi in one process: memory and numbers stay. Where there is no module, that is said."""
import pathlib
import sys

try:
    import hpvi
except ImportError:
    print("no Python module hpvi: left out")
    sys.exit(0)

PRM = pathlib.Path(__file__).resolve().parents[2] / "prm"
NAMES, ROUNDS, NOISE = ("han-6-12", "blocks", "hertz", "slope"), 100, 16e6


def resident_set():
    return int(pathlib.Path("/proc/self/statm").read_text().split()[1]) * 4096


def numbers(name):
    """All but times and memory, as bytes."""
    steps = hpvi.Scene(PRM / f"{name}.prm", {"Adaptivity/Maximum steps": "1"}).solve().steps
    return {column: values.tobytes() for column, values in steps.items() if not column.startswith(("seconds", "peak_memory"))}


first = {name: numbers(name) for name in NAMES}
for _ in range(ROUNDS // 10):
    different = [name for name in NAMES if numbers(name) != first[name]]
begin = resident_set()
for _ in range(ROUNDS):
    different += [name for name in NAMES if numbers(name) != first[name]]
growth = resident_set() - begin
print(f"Python: {ROUNDS * len(NAMES)} scenes, {len(different)} different, resident set grows by {growth / 1e6:.1f} MB")
sys.exit(1 if different or growth > NOISE else 0)
