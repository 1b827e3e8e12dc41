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

from stability import number, plt, progress, put_table, save

PAGE = "bodies"
HALF_WIDTH, SLOPE = 0.7, 10  # of Hertz's pressure SLOPE*sqrt(a^2 - x^2)
FORCE = SLOPE * math.pi * HALF_WIDTH ** 2 / 2
POISSON = {"upper": 0.3, "lower": 0.2}
ENERGY = {"upper": 0.133954906582 * 200, "lower": 0.207680549090 * 100}  # times Young's modulus
BOXES = {"upper": "-2, 0; 2, 2; 6, 3", "lower": "-2, -1; 2, 0; 5, 2"}
QUIET = {"Output/VTU": "false"}

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


def rubbing_displacement(nu, modulus, friction, width, is_above):
    """What friction f k sqrt(w^2 - x^2) adds, by Muskhelishvili's potentials; below in a mirror."""
    mu, kappa, w2 = modulus / (2 * (1 + nu)), 3 - 4 * nu, width * width
    y, friction = ("y", friction) if is_above else ("(-y)", -friction)
    q = f"(x^2-y^2-{w2!r})"
    s = f"sqrt({q}^2+4*x^2*y^2)"
    n_out = f"((x<0?-1:1)*sqrt(({s}+{q})/2))"
    m_in = f"sqrt(max(0,({s}-{q})/2))"
    # One of m and n by x y over the other, that nothing cancels.
    m = f"({q}>0?x*{y}/{n_out}:{m_in})"
    n = f"({q}>0?{n_out}:({m_in}>0?x*{y}/{m_in}:0))"
    h = f"sqrt((x+{n})^2+({y}+{m})^2)"
    A = f"((x^2-y^2-x*{n}+{y}*{m})/2+{w2 / 2!r}*log({h}/{width!r}))"
    B = f"(x*{y}-(x*{m}+{y}*{n})/2-{w2 / 2!r}*asin((x+{n})/{h}))"
    factor = friction * SLOPE / (2 * mu)
    return (f"{factor!r}*({(kappa + 1) / 2!r}*{A}-{y}*({y}-{m}))",
            f"{factor if is_above else -factor!r}*({(kappa - 1) / 2!r}*{B}-{y}*(x-{n}))")


def rubbing(lower, radius, stick, shift, friction=0.3, **adaptivity):
    """Hertz's bodies with Coulomb's friction: all of the contact slips, or |x| < stick does not."""
    moduli, ratios, a2 = {"upper": 200, "lower": lower[0]}, {"upper": 0.3, "lower": lower[1]}, HALF_WIDTH ** 2
    own = dict(POISSON)
    POISSON.update(ratios)
    settings, _ = hertz(moduli, {name: adaptivity.pop("levels") if name == "upper" else 0 for name in moduli}, **adaptivity)
    POISSON.update(own)
    for name, E in moduli.items():
        for entry in ("Graded towards", "Grading levels"):
            settings[f"Body {name}/{entry}"] = settings[f"Body upper/{entry}"]
        if stick:
            settings[f"Body {name}/Graded towards"] += f"; {-stick}, 0; {stick}, 0"
        above = name == "upper"
        added = rubbing_displacement(ratios[name], E, friction, HALF_WIDTH, above)
        inner = rubbing_displacement(ratios[name], E, friction, stick, above) if stick else ("0", "0")
        for side in ("left", "right", "top" if above else "bottom"):
            parts = settings[f"Boundary {name}.{side}/Displacement"].split("; ")
            settings[f"Boundary {name}.{side}/Displacement"] = "; ".join(
                f"{parts[c]}+{added[c]}-{inner[c]}" + (f"+{shift!r}" if c == 0 and above else "") for c in (0, 1))
    slopes = {name: 2 * (1 + ratios[name]) / E * (2 - 4 * ratios[name]) for name, E in moduli.items()}
    uneven = friction * SLOPE / 4 * (slopes["upper"] - slopes["lower"])
    settings["Contact line/Gap"] = (f"x^2/2/{radius!r}+{uneven!r}*(abs(x)<{HALF_WIDTH}?x*sqrt(max(0,{a2!r}-x^2))/2+{a2 / 2!r}*asin(x/{HALF_WIDTH})"
                                    f":(x<0?-1:1)*{math.pi * a2 / 4!r})")
    settings["Contact line/Friction coefficient"] = repr(friction)
    return settings


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


def exponential_chart(program, output):
    """Elastic energies of closed forms, uniform p on meshes that are graded p + 2 times in both bodies."""
    columns = {f"Hertz, E ratio {ratio:g}": ratio for ratio in (0.01, 1, 100)}
    columns.update({"full slip": ((100, 0.2), 3.53356890459, 0, 0.03, 0.149120752172 + 0.235901204537),
                    "partial slip": ((200, 0.3), 5.49450549451, 0.4, 0.0, 0.140448661664 + 0.093787639127)})
    rows = []
    for p in range(2, 11):
        row, method = {"p": p}, {"Method": "pu", "Start_degree": p, "Maximum_degree": p, "Maximum_steps": 1}
        for name, known in columns.items():
            if isinstance(known, tuple):
                settings, J = rubbing(*known[:4], levels=p + 2, **method), known[4]
            else:
                settings, J = hertz({"upper": 200, "lower": 200 / known}, {"upper": p + 2, "lower": p + 2}, **method)
            steps, _ = run(program, output / f"exponential-{name}-{p}", settings)
            row[name] = number(math.sqrt(abs(float(steps[-1]["energy_norm"]) ** 2 / 2 - J) / J), 2)
        rows.append(row)
    put_table("exponential", rows, page=PAGE)
    figure, axes = plt.subplots(figsize=(6.5, 4.2), layout="constrained")
    for name, marker in zip(columns, "osd^v"):
        axes.semilogy([row["p"] for row in rows], [float(row[name]) for row in rows], marker=marker, markersize=4, label=name)
    axes.set(xlabel="degree p, both bodies graded p + 2 times", ylabel="(|E_N - E| / E)$^{1/2}$, E the elastic energy")
    axes.grid(alpha=0.3)
    axes.legend()
    save(figure, "exponential.svg", PAGE)


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


def speed_table(program, output):
    """Microseconds for each unknown, the least of five runs: one block on a foundation, the same cut in two along its middle."""
    common = {"Material/Young's modulus": "10", "Adaptivity/Method": "pu", "Adaptivity/Maximum steps": "1", "Adaptivity/Tolerance": "0"}
    rows = []
    for p, n in ((2, 120), (4, 60), (8, 30)):
        law = {"Law": "unilateral", "Friction bound": "0.05"}
        one = {"Geometry/Upper corner": "2, 2", "Geometry/Subdivisions": f"{n}, {n}", "Boundary bottom/Contact": law["Law"],
               "Boundary bottom/Friction bound": law["Friction bound"], "Boundary top/Displacement": "0.03; -0.02"}
        two = {"Body upper/Lower corner": "0, 1", "Body upper/Upper corner": "2, 2", "Body upper/Subdivisions": f"{n}, {n // 2}",
               "Body lower/Upper corner": "2, 1", "Boundary lower.bottom/Displacement": "0; 0", "Contact joint/Between": "upper.bottom, lower.top",
               "Boundary upper.top/Displacement": "0.03; -0.02", **{f"Contact joint/{entry}": value for entry, value in law.items()}}
        scenes = {"one body": one, "two that match": {**two, "Body lower/Subdivisions": f"{n}, {n // 2}"},
                  "two that do not": {**two, "Body lower/Subdivisions": f"{n - 1}, {n // 2}"}}
        for name, scene in scenes.items():
            least = {}
            for _ in range(5):
                steps, _summary = run(program, output / f"speed-{name}-{p}",
                                      {**common, **scene, "Adaptivity/Start degree": str(p), "Error/Bound": "false"})
                row = steps[-1]
                for stage in (stage for stage in row if stage.startswith("seconds_")):
                    seconds = float(row[stage] or 0) / int(row["dofs_free"]) * 1e6
                    least[stage] = min(least.get(stage, math.inf), seconds)
            total = sum(least.values())
            rows.append({"p": p, "": name, "unknowns": row["dofs_free"], "all stages": f"{total:.2f} us", "factorisation": f"{least['seconds_factor']:.2f} us",
                         "the rest": f"{total - least['seconds_factor']:.2f} us"})
    put_table("speed", rows, page=PAGE)


# ---------------------------------------------------------------- curves

RINGS = {"in": ("1, 1.5", 10, 0.3), "out": ("1.5, 2", 30, 0.2)}


def rings(angle, inner, outer, **settings):
    scene = {"Contact fit/Between": "in.outer, out.inner"}
    for (name, (radii, E, nu)), edges in zip(RINGS.items(), (inner, outer)):
        scene.update({f"Body {name}/Shape": "ring sector", f"Body {name}/Radii": radii, f"Body {name}/Angles": f"0, {angle}",
                      f"Body {name}/Subdivisions": f"1, {edges}", f"Body {name}/Material": f"of {name}",
                      f"Material of {name}/Young's modulus": str(E), f"Material of {name}/Poisson's ratio": str(nu)})
        for side in ("start", "end") if angle < 360 else ():
            scene[f"Boundary {name}.{side}/Symmetry"] = "true"
    scene.update({"Adaptivity/Method": "pu", "Adaptivity/Start degree": "2", "Adaptivity/Maximum steps": "9", "Adaptivity/Tolerance": "0",
                  "Output/Steps": "all"})
    return {**scene, **settings}


def lame(inside, gap):
    """u_r at r = 1 and the pressure at r = 1.5 of Lame's two rings, by A and B of u_r = A r + B/r in each."""
    def moduli(E, nu):
        return E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu))

    def stress(name, r):
        lam, mu = moduli(*RINGS[name][1:])
        return [2 * (lam + mu), -2 * mu / r ** 2]

    rows = [stress("in", 1) + [0, 0, -inside], stress("in", 1.5) + [-s for s in stress("out", 1.5)] + [0], [0, 0] + stress("out", 2) + [0],
            [1.5, 1 / 1.5, -1.5, -1 / 1.5, gap]]
    for k in range(4):
        pivot = max(range(k, 4), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        rows = [row if i == k else [a - row[k] / rows[k][k] * b for a, b in zip(row, rows[k])] for i, row in enumerate(rows)]
    A, B = (rows[k][4] / rows[k][k] for k in (0, 1))
    return A + B, -(stress("in", 1.5)[0] * A + stress("in", 1.5)[1] * B)


def farthest(home, step, column, value):
    """The largest error of a column of the table of points, over the value."""
    with open(home / f"out/contact-{step:02}.csv", newline="") as file:
        return max(abs(float(row[column]) / value - 1) for row in csv.DictReader(file))


def rings_table(program, output):
    def mu(name):
        return RINGS[name][1] / (2 * (1 + RINGS[name][2]))

    u, pressure = lame(1, 0)
    _, fit = lame(0, -0.01)
    turned = 0.02 / ((1 - 1 / 2.25) / (2 * mu("in")) + (1 / 2.25 - 0.25) / (2 * mu("out"))) / 2.25
    cases = {"loaded": rings(90, 2, 3, **{"Boundary in.inner/Pressure": "1"}), "pressed": rings(90, 2, 3, **{"Contact fit/Gap": "-0.01"}),
             "turned": rings(360, 7, 5, **{"Contact fit/Law": "tied", "Boundary in.inner/Displacement": "-0.02*y; 0.02*x",
                                           "Boundary out.outer/Displacement": "0; 0"})}
    found = {name: run(program, output / f"rings-{name}", settings)[0] for name, settings in cases.items()}
    rows = []
    for k, row in enumerate(found["loaded"]):
        J, step = -u * math.pi / 4, int(row["step"])
        error = math.sqrt(abs(float(row["energy"]) / J - 1))
        rows.append({"p": int(row["p_max"]), "energy": number(error, 2) if error > 5e-8 else "< 5e-08",
                     "pressure": number(farthest(output / "rings-loaded", step, "normal_traction", -pressure), 2),
                     "pressed into each other": number(farthest(output / "rings-pressed", step, "normal_traction", -fit), 2),
                     "turned": number(farthest(output / "rings-turned", step, "tangential_traction", -turned), 2)})
    put_table("rings", rows, page=PAGE)


def cylinder_table(program, output):
    """SSNP154 with both normals, and with a hundredth of its load."""
    rows = []
    for force in (35000, 3500, 350):
        a = math.sqrt(4 * force * 50 / (math.pi / (0.91 / 210000 + 0.91 / 70000)))
        rows.append({"F [N/mm]": force, "normals of": "Hertz's parabola", "a [mm]": f"{a:.4f}", "p_0 [N/mm^2]": f"{2 * force / (math.pi * a):.2f}",
                     "p_0 over Hertz's": "1", "N": ""})
        hertz_pressure = 2 * force / (math.pi * a)
        for slave in ("cylinder.arc", "block.top"):
            home = output / f"cylinder-{force}-{slave}"
            home.mkdir(parents=True, exist_ok=True)
            scene = pathlib.Path(__file__).resolve().parent.parent / "prm/ssnp154.prm"
            options = {"Boundary cylinder.flat/Force": f"free; {-force}", "Contact line/Slave": slave, "Adaptivity/Maximum steps": "30",
                       "Adaptivity/Tolerance": "3e-4", **QUIET}
            done = subprocess.run([program, scene, "--output", home / "out", *(part for name, value in options.items() for part in ("--set", f"{name}={value}"))],
                                  text=True, capture_output=True, env={**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"})
            if done.returncode:
                sys.exit(f"{home}: {done.stderr}")
            summary = json.loads((home / "out/summary.json").read_text())
            p = summary["contact"]["cylinder.arc (line)"]["largest_pressure"]
            rows.append({"F [N/mm]": force, "normals of": slave.split(".")[0], "a [mm]": f"{2 * force / (math.pi * p):.4f}", "p_0 [N/mm^2]": f"{p:.2f}",
                         "p_0 over Hertz's": f"{p / hertz_pressure:.5f}",
                         "N": summary["final"]["dofs_free"]})
    put_table("cylinder", rows, page=PAGE)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default="build/hpvi", type=pathlib.Path)
    parser.add_argument("--output", default="output/bodies", type=pathlib.Path)
    parser.add_argument("--table", help="only this one, as in rings")
    options = parser.parse_args()
    program, output = options.program.resolve(), options.output
    (pathlib.Path(__file__).resolve().parent / PAGE).mkdir(exist_ok=True)
    for table in (graded_table, exponential_chart, adaptive_table, cases_table, inf_sup_table, jump_table, bound_table,
                  rings_table, cylinder_table, speed_table):
        if not options.table or table.__name__.startswith(options.table):
            table(program, output)
    progress("doc/bodies.md, doc/bodies/*.csv")


if __name__ == "__main__":
    main()
