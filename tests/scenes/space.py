#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""space.py HPVI MPIRUN: a run in space leaves the same tables from one process and from two, its files
are complete and listed, and what it prints is printed once."""
import csv
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

from runs import PROGRAM as HPVI, expanded, on_terminal, read_vtu

MPIRUN = sys.argv[1]  # runs.py has taken the program
PROBES = {"spot/At": "0.5, 0.5, 0.1", "roof/On": "top", "cut/From": "0.2, 0.5, 0.1", "cut/To": "0.8, 0.5, 0.1", "cut/Points": "5"}
SCENE = ["prm/slab.prm", "--set", "Adaptivity/Maximum steps=2", "--set", "Solver/Primal tolerance=1e-11", "--set", "Error/Bound=false",
         *(word for entry, value in PROBES.items() for word in ("--set", f"Probe {entry}={value}"))]


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def arrays(path, prefix=""):
    """Names, types and widths of the arrays of points and cells, which an index must say as its pieces have them."""
    grid = ElementTree.parse(path).getroot()[0]
    piece = grid if prefix else grid.find("Piece")
    return [[(array.get("Name"), array.get("type"), array.get("NumberOfComponents")) for array in piece.find(prefix + section)]
            for section in ("Points", "PointData", "CellData")]


def run(directory, processes):
    start = [] if processes == 1 else [MPIRUN, "--oversubscribe", "--bind-to", "none", "-np", str(processes)]
    return subprocess.run([*start, HPVI, "--output", str(directory), *SCENE], check=True,
                          capture_output=True, text=True).stdout


def near(a, b, what):
    try:
        x, y = float(a), float(b)
    except ValueError:
        assert a == b, (what, a, b)
    else:
        assert abs(x - y) <= 1e-7 * max(1, abs(x), abs(y)), (what, a, b)


with tempfile.TemporaryDirectory() as scratch:
    scratch = pathlib.Path(scratch)
    one, two = scratch / "one", scratch / "two"
    printed = {1: run(one, 1), 2: run(two, 2)}
    for text in printed.values():
        assert len(re.findall(r"^ +\d+ +\d+ ", text, re.M)) == 2, text
        assert text.count("results in") == 1, text
        assert "stopped by Adaptivity/Maximum steps" in text, text

    tables = {name: rows(one / name) for name in ("convergence.csv", "contact-01.csv", "contact-02.csv", "forces.csv", "probe-cut-02.csv")}
    assert float(tables["convergence.csv"][1]["roof_ux"]) and float(tables["probe-cut-02.csv"][4]["mises"])
    for name, table in tables.items():
        other = rows(two / name)
        assert len(table) == len(other), name
        for row, twin in zip(table, other):
            for column in row:
                if "seconds" not in column and not column.startswith(("newton", "processes", "peak_memory")):
                    near(row[column], twin[column], (name, column))
    assert rows(two / "convergence.csv")[0]["processes"] == "2"
    for directory in (one, two):
        peaks = [float(row["peak_memory"]) for row in rows(directory / "convergence.csv")]
        assert 1e7 < peaks[0] <= peaks[1] < 4e9, peaks  # bytes

    # Contact: |T_t| <= g, slip against friction, one file sorted by place, forces that add up.
    points = tables["contact-02.csv"]
    places = [tuple(float(p[c]) for c in "xyz") for p in points]
    assert places == sorted(places)
    for p in points:
        multiplier, slip = ([float(p[name + c]) for c in ("_x", "_y", "_z")]
                            for name in ("multiplier", "tangential_displacement"))
        size = sum(m * m for m in multiplier) ** 0.5
        assert size <= 1 + 1e-12 and multiplier[1] == slip[1] == 0
        assert p["state"] == ("slip" if size >= 1 - 1e-8 else "stick")
        assert abs(float(p["tangential_traction_x"]) + 4.5 * multiplier[0]) < 1e-12
    assert {p["state"] for p in points} == {"slip", "stick"}

    for directory, n in ((one, 1), (two, 2)):
        summary = json.loads((directory / "summary.json").read_text())
        members = list(summary)
        assert summary["status"] == "done" and summary["processes"] == n and summary["linear"] == "multigrid"
        listed = sorted(name for entry in summary["files"] for name in expanded(entry))
        assert listed == sorted(p.name for p in directory.iterdir()), listed
        # The loads are int 1.5 (5 - y), -0.75, 0.5 over 4 x 2; supports and contact carry them, moments too.
        forces = {name: entry["force"] + entry["moment"] for name, entry in summary["forces"].items()}
        for got, expected in zip(forces["loads"], (36, -6, 4, 0, 8, 28)):
            assert abs(got - expected) < 1e-9, forces["loads"]
        assert sorted(forces) == ["bottom", "loads", "right"]
        for component in range(6):
            assert abs(sum(force[component] for force in forces.values())) < 1e-7, forces
        assert summary["balance"]["force"] < 1e-9 and summary["balance"]["moment"] < 1e-9
        contact = summary["contact"]["bottom"]
        assert contact["force"] == summary["forces"]["bottom"]["force"]
        assert contact["moment"] == summary["forces"]["bottom"]["moment"]
        for axis in (0, 2):
            assert abs(forces["bottom"][axis] - contact["friction_resultant"][axis]) < 1e-9
        assert abs(contact["area"] - 8) < 1e-12 and 0 < contact["slipping_area"] < 8
        name = "solution-02.vtu" if n == 1 else "solution-02.pvtu"
        assert name in (directory / "solution.pvd").read_text()
        index = (directory / name).read_text()
        assert " at " not in index.split("<VTKFile")[0], "a date"
        for rank in range(n if n > 1 else 0):
            assert f"solution-02.{rank}.vtu" in index
            assert (directory / f"solution-02.{rank}.vtu").stat().st_size > 1000
            assert arrays(directory / f"solution-02.{rank}.vtu") == arrays(directory / name, "P"), rank
        for field in ("degree", "estimate", "contact_pressure", "contact_friction"):
            assert f'Name="{field}"' in index.split("CellData")[1], field
        assert 'type="Float64"' in index
        line = read_vtu(directory / "contact-02.vtu")
        assert line["points"] == [tuple(float(p[x]) for x in "xyz") for p in rows(directory / "contact-02.csv")]
        assert "contact-02.vtu" in (directory / "contact.pvd").read_text()

    # Contact that opens: states and counts agree, and what opens is no part of the slipping area.
    lifted = scratch / "lifted"
    told = subprocess.run([HPVI, "--output", str(lifted), "prm/dome.prm", "--set", "Adaptivity/Maximum steps=2", "--set",
                           "Solver/Primal tolerance=1e-11"], check=True, capture_output=True, text=True).stdout
    row = rows(lifted / "convergence.csv")[-1]
    left = float(told.split("Newton's method left ")[1].split()[0])
    assert abs(left / float(row["newton_residual"]) - 1) < 0.1 and "Primal tolerance = 1e-11\n" in told, told
    points, row = rows(lifted / "contact-02.csv"), rows(lifted / "convergence.csv")[-1]
    states = [p["state"] for p in points]
    assert set(states) == {"open", "slip", "stick"}, set(states)
    assert int(row["pressing"]) == len(states) - states.count("open")
    assert int(row["multipliers"]) == 3 * len(points)
    for p in points:
        pressure, gap = -float(p["normal_traction"]), float(p["gap"])
        u_0 = 0.08 * (float(p["x"]) ** 2 + float(p["z"]) ** 2)
        assert abs(gap - u_0 + float(p["normal_displacement"])) < 1e-12
        assert pressure == 0 if p["state"] == "open" else pressure > 0 and abs(gap) < 3e-3, p
    hardest = min(points, key=lambda p: float(p["normal_traction"]))
    summary = json.loads((lifted / "summary.json").read_text())
    # Sought at p+1 points a direction, too: no less than at those of the table, and in the same cell.
    largest = -float(hardest["normal_traction"])
    assert largest <= summary["contact"]["bottom"]["largest_pressure"] < 1.5 * largest, (largest, summary["contact"])
    for axis, x in zip("xyz", summary["contact"]["bottom"]["largest_pressure_at"]):
        assert abs(x - float(hardest[axis])) < 0.25, hardest
    for part in ("normal", "penetration", "tension"):
        assert float(row["estimate_" + part]) >= 0
    squares = sum(float(row["estimate_" + part]) ** 2 for part in (
        "volume", "jumps", "neumann", "contact", "normal", "penetration", "tension"))
    assert abs(squares ** 0.5 / float(row["estimate"]) - 1) < 1e-12
    bottom = summary["contact"]["bottom"]
    assert bottom["area"] > bottom["open_area"] > 2 and 0 < bottom["slipping_area"] < 2
    assert 0 < bottom["largest_penetration"] < 0.01 and len(bottom["largest_penetration_at"]) == 3
    assert abs(summary["forces"]["bottom"]["force"][1] + bottom["normal_resultant"]) < 1e-9
    assert summary["balance"]["force"] < 1e-9 and summary["balance"]["moment"] < 1e-9

    # Constant strain: each component of the stress, von Mises' and the displacement have their closed form.
    gradient = ((0.01, 0.002, -0.03), (0.005, -0.02, 0.007), (0.011, 0.013, 0.017))
    exact = "; ".join(" + ".join(f"{b}*{x}" for b, x in zip(row, "xyz")) for row in gradient)
    words = [word for side in ("left", "right", "bottom", "top", "front", "back")
             for word in ("--set", f"Boundary {side}/Displacement={exact}")]
    subprocess.run([HPVI, "--output", str(scratch / "strain"), "prm/slab.prm", "--set", "Boundary left/Traction=", "--set",
                    "Boundary bottom/Contact=none", "--set", "Boundary bottom/Friction bound=", *words, "--set",
                    "Adaptivity/Maximum steps=1", "--set", "Geometry/Subdivisions=1, 1, 1"], check=True, capture_output=True)
    grid = read_vtu(scratch / "strain/solution-01.vtu")
    shear = 15 / (2 * 1.4)
    sigma = [[shear * (gradient[a][b] + gradient[b][a]) + (15 * 0.4 / (1.4 * 0.2) * sum(gradient[c][c] for c in range(3))
                                                           if a == b else 0) for b in range(3)] for a in range(3)]
    pressure = sum(sigma[c][c] for c in range(3)) / 3
    mises = sum(1.5 * (sigma[a][b] - (pressure if a == b else 0)) ** 2 for a in range(3) for b in range(3)) ** 0.5
    fields = {"sigma_" + "xyz"[a] + "xyz"[b]: sigma[a][b] for a in range(3) for b in range(a, 3)}
    for name, value in {**fields, "von_mises": mises}.items():
        assert len(grid[name]) >= 27 and all(abs(v - value) < 1e-6 for v in grid[name]), (name, value, grid[name][:3])
    for x, u in zip(grid["points"], grid["displacement"]):
        assert all(abs(u[a] - sum(gradient[a][c] * x[c] for c in range(3))) < 1e-6 for a in range(3)), (x, u)

    # In the plane the path follows the multipliers of the first mesh, but not where it lacks what a scene asks for.
    opens = ["Boundary bottom/Contact=unilateral", "Solver/Normal contact=multiplier"]
    for n, extra, primal in ((1500, [], True), (150, [], False), (1500, ["Solver/Path=reduced"], False),
                             (1000, opens, False), (100, [*opens, "Solver/Path=primal"], True)):
        subprocess.run([HPVI, "--output", str(scratch / "plane"), "prm/han-6-12.prm", "--set", "Adaptivity/Method=hap2",
                        "--set", f"Geometry/Subdivisions={n}, 1", "--set", "Adaptivity/Maximum steps=1",
                        "--set", "Output/VTU=false", *(word for entry in extra for word in ("--set", entry))],
                       check=True, capture_output=True)
        summary = json.loads((scratch / "plane/summary.json").read_text())
        assert list(summary) == members, list(summary)
        assert (summary["final"]["newton_steps"] is not None) == primal, (n, extra)
        assert summary["linear"] == ("direct" if primal else None)
        if primal:
            assert summary["error_bound"] is None and "primal" in summary["no_error_bound"]
        assert summary["normal_contact"] == ("multiplier" if "Boundary bottom/Contact=unilateral" in extra else None)

    # What normal contact is follows the processes, and both files say so.
    for n, taken in ((1, "nodes"), (2, "multiplier")):
        subprocess.run([*([MPIRUN, "--oversubscribe", "--bind-to", "none", "-np", "2"] if n == 2 else []), HPVI, "--output",
                        str(scratch / "taken"), "prm/han-6-12.prm", "--set", "Adaptivity/Method=hap2", "--set",
                        "Adaptivity/Maximum steps=1", "--set", "Boundary bottom/Contact=unilateral"], check=True,
                       capture_output=True)
        assert json.loads((scratch / "taken/summary.json").read_text())["normal_contact"] == taken
        assert re.search(f"set Normal contact += {taken}", (scratch / "taken/scene.prm").read_text())

    # A foundation with a kink inside the one cell is penetrated, wherever supports are moved along it; friction where
    # nothing presses is warned of too.
    for shift in (0, 100):
        done = subprocess.run([HPVI, "--output", str(scratch / "kink"), "prm/slab.prm", "--set", "Boundary left/Traction=",
                               "--set", "Boundary right/Displacement=", "--set", f"Boundary top/Displacement={shift}; -0.1; 0",
                               "--set", "Boundary bottom/Contact=unilateral", "--set", "Boundary bottom/Gap=0.1*abs(x - 1.7)",
                               "--set", "Geometry/Subdivisions=1, 1, 1", "--set", "Adaptivity/Maximum steps=1"],
                              check=True, capture_output=True, text=True).stdout
        assert "warning: the body penetrates the foundation of bottom by up to" in done, done
        assert "warning: friction acts where contact is open" in done, done

    # A terminal hears of steps within a step.
    shown = on_terminal([HPVI, "--output", str(scratch / "shown"), *SCENE])
    assert re.search(r"step 2: finding stick and slip: Newton step \d+, \d+ steps of conjugate gradients", shown), shown
    assert b"finding stick" not in printed[1].encode()

    # What another program under mpirun has left in the environment silences nobody.
    inherited = {**os.environ, "OMPI_COMM_WORLD_RANK": "1", "OMPI_COMM_WORLD_SIZE": "2"}
    assert subprocess.run([HPVI, "--version"], env=inherited, check=True, capture_output=True,
                          text=True).stdout.startswith("hpvi "), "silent"

    # The scene that a run leaves repeats it.
    again = subprocess.run([HPVI, "--validate", str(one / "scene.prm")], capture_output=True, text=True)
    assert again.returncode == 0, again.stderr

    # A uniform pressing is exact on its first mesh; where round-off hides that, on the next.
    pressed = {"Geometry/Subdivisions": "2, 2, 1", "Boundary left/Traction": "", "Boundary left/Displacement": "0; free; free",
               "Boundary right/Displacement": "0; free; free", "Boundary front/Displacement": "free; free; 0",
               "Boundary top/Displacement": "free; -0.01; free", "Boundary bottom/Contact": "unilateral",
               "Boundary bottom/Friction bound": "", "Adaptivity/Tolerance": "0"}
    for method in ("hup2", "hap4"):
        settings = [word for entry in {**pressed, "Adaptivity/Method": method}.items() for word in ("--set", "=".join(entry))]
        done = subprocess.run([HPVI, "--output", str(one), "prm/slab.prm", *settings], check=True, capture_output=True, text=True)
        assert "exact to round-off" in done.stdout, done.stdout
        assert json.loads((one / "summary.json").read_text())["final"]["step"] <= 2
