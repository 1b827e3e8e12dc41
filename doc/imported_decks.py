#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The decks of tests/decks by hpvi, imported, and by CalculiX: rewrites their table in doc/peers.md. What CalculiX finds is also
asked for with ten times the penalty of contact, and on a mesh of half the size: what these change is their share of the difference."""
import argparse
import csv
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "doc/peers.md"
sys.path.append(str(ROOT / "tests/decks"))
import decks

PENALTY = 50.
os.environ.update(OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", CCX_NPROC_STIFFNESS="1", CCX_NPROC_EQUATION_SOLVER="1")
parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--program", default="build/hpvi")
parser.add_argument("--fineness", type=int, default=2, help="of the meshes of the decks")
parser.add_argument("--only", nargs="*", default=[deck.__name__ for deck in decks.DECKS])
options = parser.parse_args()
HPVI = str((ROOT / options.program).resolve())


def hpvi(*words):
    run = subprocess.run([HPVI, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    return run.returncode, run.stdout, run.stderr


def by_hpvi(path, quantity, component, name):
    """The number, and the half-width of its guaranteed interval, if it has one."""
    scene, results = path.parent / "scene", path.parent / "results"
    status, _, error = hpvi("--import", path, "--output", scene)
    if status:
        sys.exit(error)
    text = (scene / "scene.prm").read_text()
    bodies = re.findall(r"^subsection Body (?!force)(.*)", text, re.M)
    sides = [f"{body}.{name}" for body in bodies] or [name]
    limits = ["--set", "Adaptivity/Maximum steps=6"] if "Loading" in text else ["--set", "Adaptivity/Tolerance=1e-4"]
    limits += ["--set", "Error/Bound=last step", "--output", results]
    x = "xy"[component]
    for side in sides:
        probe = [] if quantity == "force" else ["--set", f"Probe mean/On={side}"]
        status, _, error = hpvi(scene / "scene.prm", *limits, *probe)
        if status:
            continue
        if quantity == "force":
            with (results / "forces.csv").open(newline="") as file:
                rows = [row for row in csv.DictReader(file) if row["name"] == side and row["kind"] == "support"]
            if not rows:
                continue
            value, bound = rows[-1][f"F{x}"], rows[-1][f"F{x}_bound"]
        else:
            with (results / "convergence.csv").open(newline="") as file:
                row = list(csv.DictReader(file))[-1]
            value, bound = row[f"mean_u{x}"], row[f"mean_u{x}_bound"]
        return float(value), float(bound) if bound else None
    sys.exit(f"{path}: {error}")


def mean_along(places, values, is_turned):
    """Over the edge, by Simpson's rule where nodes are those of quadratic elements; of a body of revolution by the area."""
    nodes = list(values)
    radius = [places[node][0] if is_turned else 1. for node in nodes]
    length = lambda a, b: ((places[nodes[a]][0] - places[nodes[b]][0]) ** 2 + (places[nodes[a]][1] - places[nodes[b]][1]) ** 2) ** 0.5
    total = area = 0.
    for k in range(0, len(nodes) - 2, 2):
        for j, weight in ((k, 1), (k + 1, 4), (k + 2, 1)):
            w = weight / 6 * length(k, k + 2) * radius[j]
            total, area = total + w * values[nodes[j]], area + w
    return total / area


def by_calculix(deck, fineness, penalty, quantity, component, name):
    with tempfile.TemporaryDirectory() as home:
        path = decks.write(deck, home, fineness, penalty)
        if subprocess.run(["ccx", "-i", "deck"], cwd=home, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False).returncode:
            return None
        text = (path.parent / "deck.dat").read_text()
        mesh = "\n".join(file.read_text() for file in path.parent.iterdir() if file.name == "deck.inp" or file.suffix == ".msh")
    is_turned = "TYPE=CAX" in mesh
    if quantity == "force":
        found = re.findall(r"total force.*\n\s*\n\s*(\S+)\s+(\S+)", text)
        return float(found[-1][component]) * (180 if is_turned else 1) if found else None
    block = text[text.rfind("displacements"):]
    rows = re.findall(r"^\s+(\d+)\s+(\S+)\s+(\S+)\s+\S+$", block, re.M)
    places = {int(n): (float(x), float(y)) for n, x, y in re.findall(r"^ *(\d+), ([-+.\de]+), ([-+.\de]+), 0\.$", mesh, re.M)}
    return mean_along(places, {int(row[0]): float(row[1 + component]) for row in rows}, is_turned)


def percent(value):
    return "-" if value is None else f"{100 * value:.2g} %" if abs(value) > 5e-8 else "0"


def main():
    lines = ["| deck | compared | hpvi | guaranteed to | CalculiX | difference | its penalty's share | its mesh's share |", "|---|---|---|---|---|---|---|---|"]
    for deck in decks.DECKS:
        if deck.__name__ not in options.only:
            continue
        quantity, component, name = decks.QUANTITIES[deck]
        with tempfile.TemporaryDirectory() as home:
            path = decks.write(deck, home, options.fineness, PENALTY)
            has_contact = "*CONTACT PAIR" in path.read_text()
            own, bound = by_hpvi(path, quantity, component, name)
        ask = lambda fineness, penalty: by_calculix(deck, fineness, penalty, quantity, component, name)
        theirs, stiffer, finer = ask(options.fineness, PENALTY), ask(options.fineness, 10 * PENALTY) if has_contact else None, ask(2 * options.fineness, PENALTY)
        share = lambda other, factor: None if theirs is None or other is None else factor * (theirs - other) / own
        lines.append(f"| {deck.__name__.replace('_', ' ')} | {quantity} {'xy'[component]} of {name} | {own:.6g} | {percent(bound / abs(own)) if bound else '-'} | "
                     f"{'no solution' if theirs is None else f'{theirs:.6g}'} | {percent(None if theirs is None else theirs / own - 1)} | "
                     f"{percent(share(stiffer, 10 / 9))} | {percent(share(finer, 4 / 3))} |")
        print(lines[-1], flush=True)
    if len(options.only) == len(decks.DECKS):
        PAGE.write_text(re.sub(r"(<!-- decks -->\n).*?(<!-- end -->)", lambda found: found[1] + "\n".join(lines) + "\n" + found[2], PAGE.read_text(), flags=re.S))


sys.exit(main())
