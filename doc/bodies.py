#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies that touch each other: closed forms, cases of others, which side takes the multipliers, what the jump does between moments.

Writes the tables of doc/bodies.md, between its marker comments.
"""
import argparse
import csv
import json
import math
import os
import pathlib
import subprocess
import sys

from stability import number, progress, put_table

PAGE = "bodies"
HALF_WIDTH, SLOPE = 0.7, 10  # of Hertz's pressure SLOPE*sqrt(a^2 - x^2)
FORCE = SLOPE * math.pi * HALF_WIDTH ** 2 / 2
POISSON = {"upper": 0.3, "lower": 0.2}
ENERGY = {"upper": 0.133954906582 * 200, "lower": 0.207680549090 * 100}  # times Young's modulus
BOXES = {"upper": "-2, 0; 2, 2; 6, 3", "lower": "-2, -1; 2, 0; 5, 2"}
QUIET = {"Output/VTU": "false", "Output/Mesh picture": "false"}

CLAMP = {"Boundary lower.bottom/Displacement": "0; 0", "Contact joint/Between": "upper.bottom, lower.top", "Adaptivity/Maximum steps": "24",
         "Adaptivity/Tolerance": "1e-5"}
CASES = {
    "O1": {**CLAMP, "Body lower/Lower corner": "0, -1", "Body lower/Upper corner": "3, 0", "Body lower/Subdivisions": "7, 2",
           "Body upper/Lower corner": "1, 0", "Body upper/Upper corner": "2, 1", "Body upper/Subdivisions": "3, 3",
           "Body upper/Material": "other", "Material/Young's modulus": "20", "Material/Poisson's ratio": "0.3",
           "Material other/Young's modulus": "10", "Boundary upper.top/Displacement": "0; -0.02"},
    "O2": {**CLAMP, "Body lower/Lower corner": "0, -1", "Body lower/Upper corner": "2, 0", "Body lower/Subdivisions": "4, 2",
           "Body upper/Lower corner": "0, 0", "Body upper/Upper corner": "2, 1", "Body upper/Subdivisions": "5, 3",
           "Body upper/Material": "other", "Material/Young's modulus": "20", "Material/Poisson's ratio": "0.25",
           "Material/Plane": "stress", "Material other/Young's modulus": "10", "Material other/Poisson's ratio": "0.3",
           "Boundary upper.top/Displacement": "0.03; -0.02", "Contact joint/Friction bound": "0.055"}}
CASES["O3"] = {**CASES["O1"], "Material/Young's modulus": "10", "Material other/Young's modulus": "100",
               "Boundary upper.top/Displacement": "0.02; -0.02", "Contact joint/Law": "tied"}
# J, force across the joint and along it, ends of slip: two discretisations of another program, to the digits on which they agree.
KNOWN = {"O1": ("0.0016673526(5)", "0.166735265", "0", "-"), "O2": ("0.004281503947(2)", "0.27349126", "0.09761887", "0.2823(1), 1.8694"),
         "O3": ("0.0039624663(2)", "0.2957241(1)", "0.1005225", "-")}


def text_of(settings):
    lines = []
    for path, value in settings.items():
        section, _, name = path.rpartition("/")
        lines += [f"subsection {section}", f"  set {name} = {value}", "end"]
    return "\n".join(lines) + "\n"


def call(program, home, settings, *options):
    home.mkdir(parents=True, exist_ok=True)
    (home / "scene.prm").write_text(text_of({**settings, **QUIET}))
    done = subprocess.run([program, *options, home / "scene.prm"], text=True, capture_output=True,
                          env={**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"})
    if done.returncode:
        sys.exit(f"{home}: {done.stderr}")
    return done.stdout


def run(program, home, settings):
    """The rows of its steps, and its summary."""
    call(program, home, settings, "--output", home / "out")
    with open(home / "out/convergence.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    return rows, json.loads((home / "out/summary.json").read_text())


# ---------------------------------------------------------------- Hertz


def hertz_displacement(name, modulus):
    """u on the sides of a body as expressions: F = int sqrt(a^2 - t^2)/(z - t) dt up to factors, z = x + i|y|."""
    nu, a = POISSON[name], HALF_WIDTH
    mu, kappa, sign = modulus / (2 * (1 + nu)), 3 - 4 * nu, 1 if name == "upper" else -1
    y = "y" if sign == 1 else "(-y)"
    real, twice = f"(x^2-y^2-{a * a!r})", f"(2*x*{y})"
    size = f"sqrt({real}^2+{twice}^2)"
    sr = f"(x+(x<0?-1:1)*sqrt(({size}+{real})/2))"  # of s = z + sqrt(z^2 - a^2)
    si = f"({y}+sqrt(({size}-{real})/2))"
    ss = f"({sr}^2+{si}^2)"
    fr = f"{a * a / 2!r}*((x*{sr}+{y}*{si})/{ss}+log({ss}/{a * a!r})/2)"
    fi = f"{a * a / 2!r}*(({y}*{sr}-x*{si})/{ss}+atan2({si},{sr})-pi/2)"
    factor = SLOPE / (4 * mu)
    u_x = f"{factor!r}*({kappa - 1!r}*{fi}+2*{y}*{a * a!r}*{sr}/{ss})"
    u_y = f"{-sign * factor!r}*({kappa + 1!r}*{fr}-2*{y}*{a * a!r}*{si}/{ss})"
    return f"{u_x}; {u_y}"


def hertz(moduli, levels, **adaptivity):
    """Two boxes pressed on each other by what lies around them; their half spaces have Hertz's contact."""
    curvature = sum(SLOPE * (4 - 4 * POISSON[name]) / (4 * E / (2 * (1 + POISSON[name]))) for name, E in moduli.items())
    settings = {"Contact line/Between": "upper.bottom, lower.top", "Contact line/Gap": f"{curvature / 2!r}*x^2"}
    for name, E in moduli.items():
        for entry, value in zip(("Lower corner", "Upper corner", "Subdivisions"), BOXES[name].split("; ")):
            settings[f"Body {name}/{entry}"] = value
        settings[f"Body {name}/Material"] = f"of {name}"
        settings[f"Material of {name}/Young's modulus"] = repr(E)
        settings[f"Material of {name}/Poisson's ratio"] = repr(POISSON[name])
        if levels.get(name):
            settings[f"Body {name}/Graded towards"] = f"{-HALF_WIDTH}, 0; {HALF_WIDTH}, 0"
            settings[f"Body {name}/Grading levels"] = str(levels[name])
        for side in ("left", "right", {"upper": "top", "lower": "bottom"}[name]):
            settings[f"Boundary {name}.{side}/Displacement"] = hertz_displacement(name, E)
    settings.update({f"Adaptivity/{entry.replace('_', ' ')}": str(value) for entry, value in adaptivity.items()})
    return settings, sum(ENERGY[name] / E for name, E in moduli.items())


def error(row, J):
    """The root of what J_N and J differ by, over J: as the error in the energy norm."""
    return math.sqrt(abs(float(row["energy"]) - J) / J)


def graded_table(program, output):
    moduli, rows = {"upper": 200, "lower": 100}, []
    for p in (3, 4, 5, 6, 7, 8):
        row = {"p": p}
        for graded in ("neither", "slave", "master", "both"):
            levels = {name: p + 1 for name, side in (("upper", "slave"), ("lower", "master")) if graded in (side, "both")}
            settings, J = hertz(moduli, levels, Method="pu", Start_degree=p, Maximum_steps=1)
            settings["Contact line/Slave"] = "upper.bottom"
            steps, _ = run(program, output / f"hertz-{graded}-{p}", settings)
            row[f"{graded} graded"] = number(error(steps[-1], J), 2)
        rows.append(row)
    put_table("graded", rows, page=PAGE)


def adaptive_table(program, output):
    rows = []
    for ratio in (0.01, 0.5, 1, 2, 100):
        moduli = {"upper": 200, "lower": 200 / ratio}
        settings, J = hertz(moduli, {}, Method="hpa3", Start_degree=3, Maximum_degree=12, Maximum_steps=20, Tolerance=0)
        steps, summary = run(program, output / f"hertz-hp-{ratio}", settings)
        row = {"E of the upper / lower": ratio}
        for k in (8, 12, 16, 20):
            row[f"error, step {k}"] = number(error(steps[k - 1], J), 2)
        last = steps[-1]
        row.update({"N": last["dofs_free"], "its indicator": number(float(last["estimate_relative"]), 2),
                    "force off by": number(abs(-float(last["normal_resultant"]) / FORCE - 1), 1)})
        rows.append(row)
    put_table("adaptive", rows, page=PAGE)


# ---------------------------------------------------------------- others


def cases_table(program, output):
    rows = []
    for name, settings in CASES.items():
        steps, summary = run(program, output / name, settings)
        last = steps[-1]
        slip = ", ".join(f"{float(place.split('/')[0]):.4f}" for place in last["transitions"].split()) or "-"
        rows.append({"case": name, "": "hpvi", "J": f"{float(last['lagrangian']):.12f}", "N": f"{abs(float(last['normal_resultant'])):.9f}",
                     "T": f"{abs(float(last['friction_resultant'])):.8f}", "slip from, to": slip, "unknowns": last["dofs_free"]})
        rows.append({"case": "", "": "known", **dict(zip(("J", "N", "T", "slip from, to"), KNOWN[name])), "unknowns": ""})
    put_table("cases", rows, page=PAGE)


def inf_sup_table(program, output):
    """Two boxes of 2 x 1 with square cells: beta on the first mesh, by degree, cells and stiffness of the slave over the master's."""
    rows = []
    for p, slave, master in ((2, 4, 4), (4, 8, 8), (8, 4, 4), (2, 4, 16), (4, 4, 12), (2, 16, 4), (4, 12, 4)):
        row = {"p": p, "cells of the slave": slave, "of the master": master}
        for ratio in (1e-3, 1, 1e3):
            settings = {"Body lower/Upper corner": "2, 1", "Body lower/Subdivisions": f"{master}, {master // 2}",
                        "Body upper/Lower corner": "0, 1", "Body upper/Upper corner": "2, 2", "Body upper/Subdivisions": f"{slave}, {slave // 2}",
                        "Body upper/Material": "other", "Material/Young's modulus": "10", "Material other/Young's modulus": repr(10 * ratio),
                        "Boundary lower.bottom/Displacement": "0; 0", "Boundary upper.top/Displacement": "0; 0",
                        "Contact joint/Between": "upper.bottom, lower.top", "Contact joint/Slave": "upper.bottom", "Contact joint/Friction bound": "1",
                        "Adaptivity/Method": "pu", "Adaptivity/Start degree": str(p), "Adaptivity/Maximum steps": "1"}
            said = call(program, output / "inf-sup", settings, "--inf-sup")
            row[f"E ratio {ratio:g}"] = f"{float(said.splitlines()[-1].split()[6]):.3f}"
        rows.append(row)
    put_table("inf-sup", rows, page=PAGE)


def jump_table(program, output):
    """What is left of the jump between moments along a glued joint, and of a joint pressed together."""
    rows = []
    for p in (2, 3, 4, 6, 8):
        row = {"p": p}
        for law in ("tied", "unilateral"):
            settings = {**CASES["O2"], "Contact joint/Law": law, "Adaptivity/Method": "pu", "Adaptivity/Start degree": str(p),
                        "Adaptivity/Maximum steps": "1"}
            if law == "tied":
                del settings["Contact joint/Friction bound"]
            run(program, output / f"jump-{law}-{p}", settings)
            with open(output / f"jump-{law}-{p}/out/contact-01.csv", newline="") as file:
                points = list(csv.DictReader(file))
            scale = max(abs(float(point["normal_displacement"])) for point in points)
            row[f"{law}: largest jump over u_n"] = number(max(abs(float(point["jump_normal"])) for point in points) / scale, 2)
        rows.append(row)
    put_table("jumps", rows, page=PAGE)


# Cells of the lower and the upper body that match, by case.
MATCHING = {"O1": ("6, 2", "2, 2"), "O2": ("4, 2", "4, 2"), "O3": ("6, 2", "2, 2")}


def bounded(case, **changes):
    lower, upper = MATCHING[case]
    return {**CASES[case], "Body lower/Subdivisions": lower, "Body upper/Subdivisions": upper, "Adaptivity/Tolerance": "0", **changes}


def bound_table(program, output):
    """The bound over the distance from a finer run, whose own bound is below a tenth of that."""
    soft = {"Material/Young's modulus": "1e5", "Material other/Young's modulus": "10"}
    locking = {"Material/Poisson's ratio": "0.4999", "Material other/Poisson's ratio": "0.4999", "Material/Plane": "strain"}
    scenes = {"O1": bounded("O1"), "O2": bounded("O2"), "O2, bilateral": bounded("O2", **{"Contact joint/Law": "bilateral"}), "O3": bounded("O3"),
              "O3, E = 1e5 below and 10 above": bounded("O3", **soft), "O1, nu = 0.4999": bounded("O1", **locking),
              "O3, nu = 0.4999": bounded("O3", **locking)}
    rows = []
    for scene, settings in scenes.items():
        home = output / f"bound-{scene}"
        run(program, home / "finer", {**settings, "Adaptivity/Maximum steps": "22", "Output/Reference solution": "true"})
        for method, steps in (("hup2", 4), ("hap4", 8), ("hpa2", 10), ("hpa3", 12)):
            found, _ = run(program, home / method, {**settings, "Adaptivity/Method": method, "Adaptivity/Maximum steps": str(steps),
                                                    "Error/Reference solution": str((home / "finer/out/reference.dat").resolve())})
            ratios = [float(row["error_bound"]) / float(row["error_energy"]) for row in found]
            rows.append({"case": scene, "method": method, "steps": len(found), "least bound/error": f"{min(ratios):.2f}",
                         "largest bound/error": f"{max(ratios):.2f}", "last": f"{ratios[-1]:.2f}",
                         "its error, relative": number(float(found[-1]["error_relative"]), 2)})
    put_table("bound", rows, page=PAGE)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default="build/hpvi", type=pathlib.Path)
    parser.add_argument("--output", default="output/bodies", type=pathlib.Path)
    options = parser.parse_args()
    program, output = options.program.resolve(), options.output
    (pathlib.Path(__file__).resolve().parent / PAGE).mkdir(exist_ok=True)
    for table in (graded_table, adaptive_table, cases_table, inf_sup_table, jump_table, bound_table):
        table(program, output)
    progress("doc/bodies.md, doc/bodies/*.csv")


if __name__ == "__main__":
    main()
