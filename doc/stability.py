#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where do methods for frictional contact fail, and does this one? Runs a table of failure modes.

Each row_NN drives the program with scenes of prm/ and --set, and writes tables and charts to
doc/stability/ and into doc/stability.md, between its marker comments. A run that fails is a
result: its exit status and message go into the table.
"""
import argparse
import csv
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time
import zlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
TOP = HERE.parent
GALLERY = HERE / "stability"
QUIET = ["Output/VTU=false", "Output/Contact tables=false"]
EXAMPLES = {"han-6-12": "Example 5.2", "han-6-13": "Example 5.3"}
COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#000000", "#e69f00", "#56b4e9", "#8a5a00",
           "#777777", "#9400d3"]
MARKERS = "osD^vPX*<>"
N_LABEL = "free displacement unknowns N [-]"
ERROR_LABEL = "true error $|u-u_N|_a / |u|_a$ [-]"
LONGEST_RUN = 120  # seconds


def progress(text):
    print(text, flush=True)


# ---------------------------------------------------------------- runs


class Run:
    """One run of the program, failed or not: status, message, warnings, rows of its steps."""

    def __init__(self, program, scene, home, settings, environment=None):
        self.home = home
        shutil.rmtree(home, ignore_errors=True)  # a refused run leaves no rows of an earlier one
        command = [program, "--output", str(home), str(TOP / "prm" / f"{scene}.prm")]
        for setting in QUIET + settings:  # a later setting replaces an earlier one
            command += ["--set", setting]
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=LONGEST_RUN,
                                  env={**os.environ, **(environment or {})}, check=False)
            self.status, output, errors = str(done.returncode), done.stdout, done.stderr
        except subprocess.TimeoutExpired:
            self.status, output, errors = f"none in {LONGEST_RUN} s", "", ""
        lines = errors.strip().splitlines()
        self.message = lines[-1].replace(str(TOP) + "/", "") if lines else ""
        self.summary = {}
        if (home / "summary.json").exists():
            self.summary = json.loads((home / "summary.json").read_text())
        # Step by step the same warning may come again with other numbers: the last one counts.
        self.warnings = [str(w) for w in self.summary.get("warnings", [])] or \
            [line.split(":", 1)[1].strip() for line in (output + errors).splitlines()
             if line.startswith("warning:")]
        table = home / "convergence.csv"
        self.rows = list(csv.DictReader(open(table))) if table.exists() else []

    @property
    def last(self):
        return self.rows[-1] if self.rows else {}

    def column(self, name):
        return np.array([float(row.get(name) or "nan") for row in self.rows])

    def value(self, name, k=-1):
        return float(self.rows[k].get(name) or "nan") if self.rows else math.nan

    def contact(self):
        """Columns of the last step's contact table."""
        tables = self.contacts()
        return tables[-1] if tables else {}

    def contacts(self):
        return [self.read(table) for table in sorted(self.home.glob("contact-*.csv"))]

    @staticmethod
    def read(table):
        with open(table) as file:
            rows = list(csv.DictReader(file))
        return {name: np.array([float(row[name]) for row in rows])
                for name in (rows[0] if rows else []) if name not in ("boundary", "state")}


class Laboratory:
    def __init__(self, program, home):
        self.program, self.home = program, home
        self.files = {}  # reference solutions by name

    def run(self, scene, name, *settings, environment=None):
        return Run(self.program, scene, self.home / name, list(settings), environment)

    def reference(self, scene, name, *settings, unknowns=60000):
        """The setting that measures errors against an overkill run, and that run."""
        if name not in self.files:
            progress(f"  reference solution of {name}")
            run = self.run(scene, f"reference-{name}", "Adaptivity/Method=hpa2",
                           "Adaptivity/Smoothness reading=plain", "Adaptivity/Start degree=0",
                           "Adaptivity/Maximum degree=14", "Adaptivity/Maximum steps=60",
                           f"Adaptivity/Maximum unknowns={unknowns}",
                           "Output/Reference solution=true", *settings)
            self.files[name] = run
        run = self.files[name]
        return f"Error/Reference solution={run.home / 'reference.dat'}", run

    @staticmethod
    def passed_off(run, entries):
        """The setting that measures the distance from the solution of another problem, which the
        program takes for a mistake: its file under the entries of this one."""
        lines = (run.home / "reference.dat").read_text().split("\n")
        for k, line in enumerate(lines):
            path = line.split(" =")[0]
            if path in entries:
                lines[k] = f"{path} = {entries[path]}".rstrip()
        content = "\n".join(lines[2:])
        lines[1] = f"checksum {zlib.crc32(content.encode()):08x}"
        copy = run.home / "passed-off.dat"
        copy.write_text("\n".join(lines))
        return f"Error/Reference solution={copy}"


# ---------------------------------------------------------------- tables and charts


def number(value, digits=3):
    if isinstance(value, str):
        return value
    return "-" if math.isnan(value) else f"{value:.{digits - 1}e}"


def small(value):
    """Two digits, and 0 for round-off."""
    return "0" if abs(value) < 1e-13 else number(value, 2)


def plain(value, digits=2):
    return "-" if math.isnan(value) else f"{value:.{digits}f}"


def ended(run):
    """The exit status, and the message without its remedy if it is not 0."""
    return run.status + (": " + re.sub("; [a-z].*", "", run.message).replace("|", "\\|") if run.message else "")


def warned(run, pattern):
    """What a group of the pattern, or else all of it, finds in the warnings of the last step."""
    found = [re.search(pattern, w) for w in run.warnings]
    return "; ".join((m[1] if m.re.groups else m[0]).replace("|", "\\|")
                     for m in found if m) or "-"


def write_csv(path, rows):
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def read_csv(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def put_table(name, rows, hidden=(), page="stability", folder=None):
    """Replace the table between the marker comments of doc/PAGE.md, and write its CSV to doc/PAGE, or to doc/FOLDER.

    The page leaves out hidden columns, those of dashes alone, and exit statuses where all are 0.
    """
    write_csv(HERE / (folder or page) / f"{name}.csv", rows)
    head = [c for c in rows[0] if c not in hidden and
            {str(r[c]) for r in rows} not in ([{"-"}, {"0"}] if c == "ended" else [{"-"}])]
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    lines += ["| " + " | ".join(str(r[c]) for c in head) + " |" for r in rows]
    text, count = re.subn(rf"(<!-- {name}: begin[^\n]*\n).*?(<!-- {name}: end)",
                          lambda m: m[1] + "\n".join(lines) + "\n" + m[2],
                          (HERE / f"{page}.md").read_text(), flags=re.S)
    if count != 1:
        sys.exit(f"doc/{page}.md has no place for the table {name}")
    (HERE / f"{page}.md").write_text(text)


def chart(columns, title, width=None, height=4.2, sharey=False):
    figure, panels = plt.subplots(1, columns, figsize=(width or 1.5 + 4 * columns, height),
                                  sharey=sharey, layout="constrained", squeeze=False)
    figure.suptitle(title)
    for axes in panels[0]:
        axes.grid(alpha=0.3)
    return figure, panels[0]


def style(k):
    return {"color": COLOURS[k % len(COLOURS)], "marker": MARKERS[k % len(MARKERS)],
            "markersize": 5, "linewidth": 1.3}


def legend(axes, **options):
    axes.legend(loc="center left", bbox_to_anchor=(1.02, 0.5), **options)


def save(figure, name, page="stability"):
    figure.savefig(HERE / page / name, dpi=100)
    plt.close(figure)


def slope(x, y):
    return np.polyfit(np.log(x), np.log(y), 1)[0]


def nearest(run, unknowns):
    """The step whose number of unknowns is nearest to the given one."""
    return int(np.argmin(np.abs(np.log(run.column("dofs_free") / unknowns))))


# ---------------------------------------------------------------- 1 locking


def graded(levels):
    return ["Adaptivity/Method=pu", "Geometry/Graded towards=0, 0",
            f"Geometry/Grading levels={levels}", "Adaptivity/Maximum degree=12",
            "Adaptivity/Start degree=2", "Adaptivity/Maximum steps=11"]


def row_01(lab):
    ratios = ["0.3", "0.49", "0.4999", "0.499999"]
    methods = {f"uniform h, p = {p}": ["Adaptivity/Method=hup2", f"Adaptivity/Start degree={p}",
                                       "Adaptivity/Maximum unknowns=3000"] for p in (2, 3, 4, 8)}
    for name, settings in {"hpa2": ["hpa2"], "hpa3": ["hpa3"],
                           "hpa3 from p = 4": ["hpa3", "Adaptivity/Start degree=4"],
                           "hpa3 from p = 6": ["hpa3", "Adaptivity/Start degree=6"]}.items():
        methods[name] = ["Adaptivity/Maximum unknowns=12000", "Adaptivity/Method=" + settings[0],
                         *settings[1:]]
    methods["9 levels, p = 10"] = graded(9)
    methods["12 levels, p = 10"] = graded(12)
    figure, panels = chart(3, "Stick-slip in plane strain, nu towards 1/2", 15)
    table, by_degree = [], {}
    for k, (method, settings) in enumerate(methods.items()):
        runs = [lab.run("stick-slip", "locking", "Material/Plane=strain",
                        f"Material/Poisson's ratio={nu}", "Adaptivity/Maximum steps=60", *settings)
                for nu in ratios]

        def add(size, steps):
            error = [r.value("error_relative", s) for r, s in zip(runs, steps)]
            multiplier = [r.value("error_multiplier", s) for r, s in zip(runs, steps)]
            unknowns = [int(r.rows[s]["dofs_free"]) for r, s in zip(runs, steps)]
            table.append({"method": method + size, "ended": max(map(ended, runs)),
                          "N": str(unknowns[0]) if min(unknowns) == max(unknowns) else
                          f"{min(unknowns)} - {max(unknowns)}",
                          "error, nu = 0.3": number(error[0], 2),
                          **{f"times, nu = {nu}": plain(e / error[0], 1)
                             for nu, e in zip(ratios[1:], error[1:])},
                          "of the multiplier, 0.3": number(multiplier[0], 2),
                          "times, 0.499999": plain(multiplier[-1] / multiplier[0], 1),
                          "effectivity, 0.3": plain(runs[0].value("effectivity", steps[0]), 1),
                          "at 0.499999": plain(runs[-1].value("effectivity", steps[-1]), 0),
                          "warns of locking": ", ".join(
                              nu for nu, r in zip(ratios, runs)
                              if warned(r, "may lock") != "-") or "no"})
            if size != ", small":
                for axes, values in zip(panels, (error, multiplier)):
                    axes.loglog([0.5 - float(nu) for nu in ratios], values, **style(k),
                                label=method)

        if "levels" in method:
            add("", [int(np.argmin(np.abs(r.column("p_max") - 10))) for r in runs])
            by_degree[method.split(",")[0]] = dict(zip(ratios, runs))
        elif "uniform" in method:
            add("", [nearest(r, 4000) for r in runs])
        else:
            add(", small", [nearest(r, 4000) for r in runs])
            add(", large", [nearest(r, 12000) for r in runs])
    for axes in panels[:2]:
        axes.invert_xaxis()
        axes.set_xlabel("1/2 - nu [-]")
    panels[0].set_ylabel(ERROR_LABEL)
    panels[1].set_ylabel(r"multiplier error $\|\lambda-\lambda_N\|_{L_2}$ [length$^{1/2}$]")
    legend(panels[1], fontsize=8)
    rows = []
    for line, (levels, runs) in zip(("--", "-"), by_degree.items()):
        for k, (nu, r) in enumerate(runs.items()):
            panels[2].semilogy(r.column("p_max"), r.column("error_relative"),
                               **{**style(k), "linestyle": line, "markersize": 3},
                               label=f"nu = {nu}, {levels}")
    for k in range(11):
        row = {"p": next(iter(by_degree.values()))["0.3"].rows[k]["p_max"]}
        for levels, runs in by_degree.items():
            least = runs["0.3"].value("error_relative", k)
            row[f"{levels}: N"] = runs["0.3"].rows[k]["dofs_free"]
            row[f"{levels}: error, 0.3"] = number(least, 2)
            for nu in ratios[1:]:
                row[f"{levels}: times, {nu}"] = \
                    plain(runs[nu].value("error_relative", k) / least, 1)
        rows.append(row)
    panels[2].set_xlabel("degree p on graded meshes [-]")
    panels[2].set_ylabel(ERROR_LABEL)
    legend(panels[2], fontsize=8)
    save(figure, "locking.png")
    put_table("locking", table)
    put_table("locking-by-degree", rows)


# ---------------------------------------------------------------- 2 inf-sup constant


def inf_sup(lab, *settings):
    """Rows of `hpvi --inf-sup` for Example 5.2: a line that names the columns, then a line each."""
    command = [lab.program, "--inf-sup", str(TOP / "prm" / "han-6-12.prm")]
    for setting in settings:
        command += ["--set", setting]
    done = subprocess.run(command, capture_output=True, text=True, timeout=LONGEST_RUN, check=True)
    head, rows = None, []
    for line in done.stdout.splitlines():
        words = line.split()
        if "beta" in words and "step" in words:
            head = words
        elif head and len(words) == len(head):
            rows.append({c: float(w) for c, w in zip(head, words)})
    return rows


def row_02(lab):
    degrees = {-2: "p - 2", -1: "p - 1", 0: "p"}
    offsets = {o: f"Solver/Multiplier degree offset={o}" for o in degrees}
    figure, panels = chart(2, "Example 5.2: inf-sup constant of displacement and multiplier", 12)
    path = ["Adaptivity/Method=pu", "Adaptivity/Start degree=2", "Adaptivity/Maximum steps=11",
            "Adaptivity/Maximum degree=12"]
    raised = {o: inf_sup(lab, offsets[o], *path) for o in degrees}
    c = raised[-2][1]["beta"] / raised[-2][1]["bound"]
    table = [{"p": f"{one['p_max']:.0f}", "contact edges": 4, "N": f"{one['dofs_free']:.0f}",
              **{f"beta, degree {degrees[o]}": f"{raised[o][k]['beta']:.3f}" for o in degrees},
              "bound, scaled": f"{c * one['bound']:.3f}" if k else "-"}
             for k, one in enumerate(raised[-2])]
    for k, o in enumerate(degrees):
        panels[0].plot([r["p_max"] for r in raised[o]], [r["beta"] for r in raised[o]], **style(k),
                       label=f"multipliers of degree {degrees[o]}")
    panels[0].plot([r["p_max"] for r in raised[-2][1:]], [c * r["bound"] for r in raised[-2][1:]],
                   "k--", linewidth=1,
                   label=r"proven bound $c\,/\,(p^{1/2} \log^{3/2} p)$,"
                   "\nc unknown: through p = 3")
    panels[0].set_xlabel("degree p, 4 contact edges [-]")
    panels[0].set_xticks(range(2, 13, 2))
    panels[0].set_ylim(-0.03, 1)
    panels[0].legend(fontsize=8, loc="upper right", bbox_to_anchor=(1, 0.8))
    curves = [(2, 5, o) for o in degrees] + [(4, 4, -2), (8, 3, -2)]
    halved = {}
    for k, (p, steps, o) in enumerate(curves):
        rows = inf_sup(lab, offsets[o], "Adaptivity/Method=hup2", f"Adaptivity/Start degree={p}",
                       f"Adaptivity/Maximum steps={steps}")
        edges = [math.sqrt(r["elements"]) for r in rows]
        halved[p, o] = rows
        if rows[0]["beta"] > 1e-6:
            panels[1].loglog(edges, [r["beta"] for r in rows], **style(k),
                             label=f"p = {p}, degree {degrees[o]}")
        else:
            panels[1].text(4, 0.006, f"p = {p}, degree {degrees[o]}: 0 on every mesh", fontsize=8)
    for p, o in [(2, -2), (4, -2), (8, -2)]:
        for k, one in enumerate(halved[p, o]):
            if k:
                table.append({"p": p, "contact edges": f"{math.sqrt(one['elements']):.0f}",
                              "N": f"{one['dofs_free']:.0f}",
                              **{f"beta, degree {degrees[d]}": f"{halved[p, d][k]['beta']:.3f}"
                                 if (p, d) in halved else "-" for d in degrees},
                              "bound, scaled": f"{c * one['bound']:.3f}" if p > 2 else "-"})
    panels[1].set_ylim(0.005, 1.2)
    panels[1].set_xticks([4, 8, 16, 32, 64], "4 8 16 32 64".split())
    panels[1].set_xticks([], minor=True)
    panels[1].set_xlabel("contact edges [-]")
    panels[1].legend(fontsize=8, loc="lower left", bbox_to_anchor=(0, 0.1))
    for axes in panels:
        axes.set_ylabel("inf-sup constant beta [-]")
    save(figure, "inf-sup.png")
    put_table("inf-sup", table)
    table = []
    for o in degrees:
        run = lab.run("han-6-12", "inf-sup", offsets[o], "Adaptivity/Method=hup2",
                      "Adaptivity/Maximum steps=4")
        table.append({"degree of the multiplier": degrees[o], "ended": ended(run),
                      "warning": warned(run, "multipliers of degree.*")})
    put_table("inf-sup-runs", table)


# ---------------------------------------------------------------- 3, 12 high degrees


def rows_03_and_12(lab):
    """Uniform p from 2 to 14; the first rows are those of contact that meets a clamp."""
    figure, panels = chart(2, "Uniform p up to 14", 10, sharey=True)
    table = []
    for axes, (scene, title) in zip(panels, EXAMPLES.items()):
        against, overkill = lab.reference(scene, scene)
        run = lab.run(scene, "degrees", "Adaptivity/Method=pu", "Adaptivity/Maximum degree=14",
                      "Adaptivity/Maximum steps=13", "Solver/Condition number=true", against)
        for row in run.rows:
            value = {c: float(row[c] or "nan") for c in row if c != "transitions"}
            table.append({"example": title[8:], "p": row["p_max"], "N": row["dofs_free"],
                          "lagrangian": f"{value['lagrangian']:.6f}",
                          "energy J": f"{value['energy']:.6f}",
                          "slack": number(value["slack"], 2),
                          "error_relative": number(value["error_relative"], 2),
                          "effectivity": plain(value["effectivity"], 1),
                          "cond S": number(value["condition_raw"], 2),
                          "scaled": number(value["condition_scaled"], 2),
                          "QP products": row["qp_multiplications"]})
        table.append({"example": title[8:], "p": "overkill", "N": overkill.last["dofs_free"],
                      "lagrangian": f"{overkill.value('lagrangian'):.6f}",
                      "energy J": f"{overkill.value('energy'):.6f}",
                      "slack": number(overkill.value("slack"), 2), "error_relative": "-",
                      "effectivity": "-", "cond S": "-", "scaled": "-",
                      "QP products": overkill.last["qp_multiplications"]})
        p = run.column("p_max")
        final = overkill.value("lagrangian")
        axes.loglog(p, run.column("error_relative"), **style(0), label=ERROR_LABEL)
        axes.loglog(p, np.abs(run.column("lagrangian") / final - 1), **style(1),
                    label="Lagrangian: distance from overkill [-]")
        axes.loglog(p, np.abs(run.column("energy") / final - 1), **style(2),
                    label="J: distance from overkill [-]")
        axes.set_xticks([2, 3, 4, 6, 8, 10, 12, 14], "2 3 4 6 8 10 12 14".split())
        axes.set_xticks([], minor=True)
        axes.set_xlabel("degree p [-]")
        axes.set_title(title)
    panels[0].set_ylabel("relative error or distance [-]")
    legend(panels[1], fontsize=8)
    save(figure, "degrees.png")
    put_table("degrees", table, hidden=["slack"])


# ---------------------------------------------------------------- 4 semicoercive


def row_04(lab):
    table = []
    for factor in (0.9, 0.999999, 1.0, 1.000001, 1.1):
        run = lab.run("semicoercive", "semicoercive",
                      f"Boundary top/Traction={factor!r}*1.75; 0",
                      "Output/Contact tables=true")
        contact = run.contact()
        slide = contact.get("tangential_displacement", np.array([math.nan]))
        bound = np.abs(contact.get("multiplier", np.array([math.nan])))
        table.append({"top traction / g": factor, "steps": len(run.rows) or "-",
                      "ended": ended(run), "warning": warned(run, "the loads reach.*"),
                      "J [kN]": plain(run.value("energy"), 3),
                      "friction resultant [kN/mm]": plain(run.value("friction_resultant"), 3),
                      "largest slip [mm]": plain(float(np.max(np.abs(slide)))),
                      "largest 1 - \\|lambda\\|": number(float(1 - np.min(bound)), 2),
                      "relative indicator": number(run.value("estimate_relative"), 2)})
    put_table("semicoercive", table)


# ---------------------------------------------------------------- 5 limits of the friction bound


def row_05(lab):
    base = ["Adaptivity/Method=hpa2", "Adaptivity/Smoothness reading=plain"]
    stick = ["Boundary bottom/Contact=none", "Boundary bottom/Friction bound=",
             "Boundary bottom/Displacement=0; 0"]
    roller = ["Boundary bottom/Friction bound=0"]
    overkills = [lab.reference("han-6-12", "roller", *roller)[1],
                 lab.reference("han-6-12", "full-stick", *stick)[1]]
    entries = {"Boundary bottom/Contact": "bilateral", "Boundary bottom/Friction bound": "4.5",
               "Boundary bottom/Displacement": ""}
    cases = {"roller: g = 0": roller,
             "full stick: u = 0 below": stick}
    for factor in ("1e-300", "1e-160", "1e-12", "1e-6", "1e-3", "1", "1e3", "1e6", "1e12", "1e100",
                   "1e160"):
        cases[f"g x {factor}"] = [f"Boundary bottom/Friction bound=4.5*{factor}"]
    cases["g falls by exp(-40 x)"] = ["Boundary bottom/Friction bound=4.5*exp(-40*x)"]
    cases["g x 1e12 where x > 2"] = ["Boundary bottom/Friction bound=if(x<2, 4.5, 4.5e12)"]
    table = []
    for case, settings in cases.items():
        problem = {**entries, **dict(setting.split("=", 1) for setting in settings)}
        runs = [lab.run("han-6-12", "bounds", *base, *settings, lab.passed_off(overkill, problem))
                for overkill in overkills]
        run = runs[0]
        table.append({"case": case, "ended": ended(run), "N": run.last.get("dofs_free", "-"),
                      "multipliers": run.last.get("multipliers", "-"),
                      "QP products, last step": run.last.get("qp_multiplications", "-"),
                      "lagrangian": plain(run.value("lagrangian"), 5),
                      "J": number(run.value("energy"), 6),
                      "friction resultant": number(run.value("friction_resultant"), 3),
                      "distance from roller": number(runs[0].value("error_relative"), 2),
                      "distance from full stick": number(runs[1].value("error_relative"), 2)})
    put_table("bounds", table)


# ---------------------------------------------------------------- 6 exact threshold


def row_06(lab):
    table = []
    paths = {"uniform h, p = 4": ["Adaptivity/Method=hup4", "Adaptivity/Maximum steps=5"],
             "uniform p = 2..12": ["Adaptivity/Method=pu", "Adaptivity/Start degree=2",
                                   "Adaptivity/Maximum steps=11"],
             "p = 4, unscaled S": ["Adaptivity/Method=hup4", "Adaptivity/Maximum steps=5",
                                   "Solver/Diagonal scaling=false"]}
    for path, settings in paths.items():
        for text, factor in (("1 - 1e-6", 1 - 1e-6), ("1 - 1e-12", 1 - 1e-12), ("1", 1.),
                             ("1 + 1e-12", 1 + 1e-12), ("1 + 1e-6", 1 + 1e-6)):
            side = f"mu*0.1*{min(factor, 1.)!r}/2"
            run = lab.run("threshold", "threshold", f"Boundary top/Displacement=0.1*{factor!r}; 0",
                          f"Boundary left/Traction=0; -{side}",
                          f"Boundary right/Traction=0; {side}",
                          "Output/Contact tables=true", *settings)
            contact = run.contact()
            slip = 0.1 * max(factor - 1, 0.)
            error = np.max(np.abs(contact["tangential_displacement"] - slip)) if contact else \
                math.nan
            bound = np.max(np.abs(contact["multiplier"] - min(factor, 1.))) if contact else math.nan
            table.append({"path": path, "shear / g": text, "ended": ended(run),
                          "N": run.last.get("dofs_free", "-"),
                          "relative indicator": number(run.value("estimate_relative"), 2),
                          "error of u_t / U": number(error / 0.1, 2),
                          "error of lambda": number(bound, 2),
                          "QP products, most": plain(np.max(run.column("qp_multiplications")), 0)
                          if run.rows else "-"})
    put_table("threshold", table)


# ---------------------------------------------------------------- 7 transition inside an edge


GAUSS = {n: (np.polynomial.legendre.leggauss(n)[0] + 1) / 2 for n in range(1, 20)}


def edges_of_points(x, start):
    """Groups of Gauss points that share an edge, and the edge: p-1 points each, p is not told."""
    groups, k = [], 0
    while k < len(x):
        for n in range(min(19, len(x) - k), 0, -1):
            # The first and last point give an edge of any other number of points: no error adds up.
            h = 2 * (x[k] - start) if n == 1 else \
                (x[k + n - 1] - x[k]) / (GAUSS[n][-1] - GAUSS[n][0])
            begin = x[k] - h * GAUSS[n][0]
            if abs(begin - start) < 1e-6 * h and \
                    np.max(np.abs(begin + h * GAUSS[n] - x[k:k + n])) < 1e-7 * h:
                break
        groups.append((slice(k, k + n), begin, h))
        k, start = k + n, begin + h
    return groups


def overshoot(contact, start, end):
    """How far |lambda_N| passes 1 between the Gauss points, and the length where it does."""
    most, length = 0., 0.
    fine = np.linspace(0, 1, 401)
    edges = edges_of_points(contact["x"], start)
    if abs(edges[-1][1] + edges[-1][2] - end) > 1e-6:
        return -math.inf, math.nan  # edges near round-off that cannot be told apart
    for points, left, h in edges:
        s = (contact["x"][points] - left) / h
        values = contact["multiplier"][points]
        curve = np.zeros_like(fine)
        for i, node in enumerate(s):  # Lagrange polynomials of the Gauss points
            others = np.delete(s, i)
            curve += values[i] * np.prod([(fine - o) / (node - o) for o in others], axis=0)
        beyond = np.abs(curve) - 1
        most = max(most, beyond.max())
        length += h * np.mean(beyond > 1e-9)
    return most, length


def row_07(lab):
    transitions = ("0", "0.1", "0.314159265")
    methods = {"hup2": 4, "pu": 5, "hpa2": 1, "hpa3": 0}
    figure, panels = chart(3, "Stick-slip: the transition at a node, and inside edges", 13,
                           sharey=True)
    table = []
    for axes, c in zip(panels, transitions):
        for k, method in enumerate(methods):
            run = lab.run("stick-slip", "transition", f"Adaptivity/Method={method}",
                          f"Exact solution/Transition={c}", "Output/Contact tables=true",
                          "Adaptivity/Maximum steps=" + {"pu": "13", "hup2": "6"}.get(method, "26"),
                          "Adaptivity/Maximum degree=14", "Adaptivity/Maximum unknowns=12000")
            error, n = run.column("error_relative"), run.column("dofs_free")
            axes.loglog(n, error, **style(k), label=method)
            beyond = [overshoot(contact, -1., 1.) for contact in run.contacts()]
            beyond = [b if math.isfinite(b[0]) else (math.nan, math.nan) for b in beyond]
            worst = max((b for b in beyond if b[0] >= 0), key=lambda b: b[0],
                        default=(math.nan, math.nan))
            rises = int(np.sum(error[1:] > error[:-1]))
            warning = "-"
            if worst[0] > 0.05:  # a run ends with the warnings of its last step: end at the worst
                to_there = lab.run("stick-slip", "transition-worst", f"Adaptivity/Method={method}",
                                   f"Exact solution/Transition={c}", "Adaptivity/Maximum degree=14",
                                   f"Adaptivity/Maximum steps={beyond.index(worst) + 1}")
                warning = warned(to_there, r"(\|lambda\| reaches .*), at")
            table.append({"transition": c, "method": method, "ended": ended(run),
                          "steps": len(run.rows), "N": run.last.get("dofs_free", "-"),
                          "error_relative": number(run.value("error_relative"), 2),
                          "rate in N": plain(-slope(n[len(n) // 2:], error[len(n) // 2:])),
                          "rises in steps": rises,
                          "largest rise": plain(np.max(error[1:] / error[:-1]))
                          if rises else "-",
                          "transition off by": small(run.value("error_transition")),
                          "least effectivity": plain(np.min(run.column("effectivity"))),
                          "largest overshoot": plain(worst[0]) if worst[0] > 1e-13 else "0",
                          "on a length": small(worst[1]),
                          "warning there": warning,
                          "overshoot, last step": small(beyond[-1][0]) if beyond else "-"})
        axes.set_title(f"transition at x = {c}")
        axes.set_xlabel(N_LABEL)
    panels[0].set_ylabel(ERROR_LABEL)
    legend(panels[2])
    save(figure, "transition.png")
    put_table("transition", table, hidden=["on a length", "overshoot, last step", "rate in N"])


# ---------------------------------------------------------------- 8 deep meshes


def deep_row(name, run):
    error = run.column("error_relative")
    known = bool(np.isfinite(error).any())
    return {"run": name, "ended": ended(run), "steps": len(run.rows),
            "N": run.last.get("dofs_free", "-"), "multipliers": run.last.get("multipliers", "-"),
            "dense solves, most": plain(np.max(run.column("qp_dense_solves")), 0),
            "steps that fell back": plain(np.sum(run.column("qp_fell_back")), 0),
            "QP products, most": plain(np.max(run.column("qp_multiplications")), 0),
            "projected gradient, most": number(np.max(run.column("qp_projected_gradient")), 2),
            "least error_relative": number(np.min(error), 2) if known else "-",
            "last error_relative": number(error[-1], 2) if known else "-",
            "last J": f"{run.value('energy'):.11f}"}


def row_08(lab):
    figure, panels = chart(2, "Deep meshes: stick-slip", 11)
    table = []
    runs = {}
    for levels in (10, 20, 30, 40):
        runs[f"p = 2..10, {levels} levels"] = lab.run(
            "stick-slip", "deep", "Adaptivity/Method=pu", "Adaptivity/Maximum steps=9",
            "Geometry/Graded towards=0, 0", f"Geometry/Grading levels={levels}")
    runs["p = 2..10, 40 levels, uneven"] = lab.run(
        "stick-slip", "deep", "Adaptivity/Method=pu", "Adaptivity/Maximum steps=9",
        "Geometry/Graded towards=0.1, 0", "Geometry/Grading levels=40",
        "Exact solution/Transition=0.1")
    runs["hpa3"] = lab.run("stick-slip", "deep", "Adaptivity/Method=hpa3",
                           "Adaptivity/Maximum steps=40", "Adaptivity/Maximum unknowns=100000")
    runs["hpa3 from 22 levels"] = lab.run(
        "stick-slip", "deep", "Adaptivity/Method=hpa3", "Adaptivity/Maximum steps=16",
        "Geometry/Graded towards=0, 0", "Geometry/Grading levels=22")
    for k, (name, run) in enumerate(runs.items()):
        n = run.column("multipliers")
        panels[0].plot(n, run.column("qp_dense_solves"), **style(k), label=name)
        panels[1].loglog(run.column("dofs_free"), run.column("error_relative"), **style(k),
                         label=name)
        table.append(deep_row(name, run))
    panels[0].set_xlabel("multipliers n [-]")
    panels[0].set_ylabel("dense solves in one step [-]")
    panels[1].set_xlabel(N_LABEL)
    panels[1].set_ylabel(ERROR_LABEL)
    legend(panels[1], fontsize=8)
    save(figure, "deep.png")
    for scene, point in (("han-6-12", "0.99022, 0"), ("han-6-13", "1.8527, 0; 7.7536, 0")):
        for levels in (10, 40):
            run = lab.run(scene, "deep", "Adaptivity/Method=pu", "Adaptivity/Start degree=2",
                          "Adaptivity/Maximum steps=7", f"Geometry/Graded towards={point}",
                          f"Geometry/Grading levels={levels}")
            table.append(deep_row(f"{EXAMPLES[scene]}, p = 2..8, {levels} levels", run))
    put_table("deep", table)


# ---------------------------------------------------------------- 9 conditioning


# The thesis's condition numbers: unknowns, of S, of S scaled by its diagonal.
CONDITIONS = {"han-6-12": (22690, 5.5e8, 2.7e3), "han-6-13": (19045, 5.3e7, 1.2e3)}


def row_09(lab):
    table = []
    for scene, title in EXAMPLES.items():
        figure, panels = chart(2, f"{title}, hpa2: conditioning of S", 11)
        hpa2 = ["Adaptivity/Method=hpa2", "Adaptivity/Smoothness reading=plain",
                "Adaptivity/Maximum steps=32", "Adaptivity/Maximum unknowns=190000"]
        cold = ["Solver/QP solver=mprgp", "Solver/QP warm start=false"]
        variants = {
            "scaled, from zero": [*cold, "Solver/Condition number=true"],
            "scaled, from zero, tolerance 1e-9": [*cold, "Solver/QP tolerance=1e-9"],
            "raw, from zero": [*cold, "Solver/Diagonal scaling=false",
                               "Solver/QP maximum multiplications=20000"],
            "scaled, from the step before": ["Solver/QP solver=mprgp"]}
        runs = {}
        for k, (name, settings) in enumerate(variants.items()):
            progress(f"  {title}: {name}")
            run = runs[name] = lab.run(scene, "conditioning", *hpa2, *settings)
            n = run.column("multipliers")
            if k == 0:
                raw = run.column("condition_raw")
                raw[~np.isfinite(raw)] = np.nan
                panels[0].loglog(n, raw, **style(1), label="cond S, raw")
                panels[0].loglog(n, run.column("condition_scaled"), **style(0),
                                 label="cond S, scaled")
                panels[0].axhline(2 ** 52, color="grey", linestyle=":", label="1/eps")
            panels[1].loglog(n, run.column("qp_multiplications"), **style(k), label=name)
            conditions = runs["scaled, from zero"]
            at = nearest_column(conditions, "multipliers", n[-1]) if len(n) else 0
            table.append({"example": title[8:], "variant": name, "ended": ended(run),
                          "steps": len(run.rows), "N": run.last.get("dofs_free", "-"),
                          "multipliers": run.last.get("multipliers", "-"),
                          "cond S": number(conditions.value("condition_raw", at), 2),
                          "cond S scaled": number(conditions.value("condition_scaled", at), 2),
                          "QP products, last step": run.last.get("qp_multiplications", "-"),
                          "growth: products ~ n^": plain(slope(n, run.column(
                              "qp_multiplications")))})
        panels[0].set_ylabel("condition number [-]")
        unknowns, raw, scaled = CONDITIONS[scene]
        first = runs["scaled, from zero"]
        n = first.column("multipliers")[nearest(first, unknowns)]
        panels[0].plot(n, raw, "*", color=COLOURS[1], markersize=14, label="thesis, raw")
        panels[0].plot(n, scaled, "*", color=COLOURS[0], markersize=14, label="thesis, scaled")
        panels[1].set_ylabel("products with S in one step [-]")
        for axes in panels:
            axes.set_xlabel("multipliers n [-]")
            axes.legend(fontsize=8)
        save(figure, f"conditioning-{scene}.png")
    put_table("conditioning", table)


def nearest_column(run, column, value):
    return int(np.argmin(np.abs(run.column(column) - value)))


# ---------------------------------------------------------------- 11 aspect ratio and distortion


def row_11(lab):
    bodies = {
        "10 x 2 bar": ([], ["4, 1", "16, 1", "1, 16", "1, 1"]),
        "200 x 2 bar": (["Geometry/Upper corner=200, 2"], ["100, 1", "4, 1", "1, 1"]),
        "parallelogram": (["Geometry/Shape=quadrilateral",
                           "Geometry/Corners=0, 0; 10, 0; 13, 2; 3, 2"],
                          ["4, 1", "16, 1", "1, 16"]),
        "trapezoid": (["Geometry/Shape=quadrilateral",
                       "Geometry/Corners=0, 0; 10, 0; 6, 2; 4, 2"], ["4, 1", "16, 1", "1, 16"])}
    figure, panels = chart(4, "Example 5.3 on other bodies and meshes: effectivity of hpa3", 15,
                           sharey=True)
    table = []
    for axes, (body, (shape, meshes)) in zip(panels, bodies.items()):
        for k, mesh in enumerate(meshes):
            settings = [*shape, f"Geometry/Subdivisions={mesh}"]
            label = mesh.replace(", ", " x ")
            against, overkill = lab.reference("han-6-13", f"{body}-{label}".replace(" ", ""),
                                              *settings, unknowns=300000)
            run = lab.run("han-6-13", "aspect", "Adaptivity/Method=hpa3",
                          "Adaptivity/Smoothness reading=plain", "Adaptivity/Maximum steps=60",
                          "Adaptivity/Maximum unknowns=10000", *settings, against)
            good = run.column("error_relative") > 1e-6  # the reference ends near 1e-8
            effectivity = run.column("effectivity")[good]
            axes.loglog(run.column("dofs_free")[good], effectivity, **style(k), label=label)
            table.append({"body": body, "coarse mesh": label,
                          "ended": ended(run) if run.status != "0" else ended(overkill),
                          "limit: N": overkill.last.get("dofs_free", "-"),
                          "limit: lagrangian": f"{overkill.value('lagrangian'):.8f}",
                          "limit: friction resultant":
                              f"{overkill.value('friction_resultant'):.5f}",
                          "hpa3: N": run.last.get("dofs_free", "-"),
                          "error_relative": number(run.value("error_relative"), 2),
                          "effectivity": f"{np.min(effectivity):.1f} - {np.max(effectivity):.1f}"
                          if len(effectivity) else "-",
                          "warning": warned(run, "elements up to .*? as wide")})
        axes.set_title(body)
        axes.set_xlabel(N_LABEL, fontsize=8)
        axes.legend(title="coarse mesh", fontsize=8, title_fontsize=8)
    panels[0].set_ylabel("effectivity: scaled indicator / true error [-]")
    panels[0].set_yticks([2, 3, 5, 10, 20], "2 3 5 10 20".split())
    panels[0].set_yticks([], minor=True)
    save(figure, "aspect.png")
    put_table("aspect", table)


# ---------------------------------------------------------------- 13 Coulomb friction


def row_13(lab):
    """The fixed point over the coefficient, Newton's ladder, and problems with two solutions."""
    cases = [("SSNV128", "ssnv128", f) for f in (0.1, 0.3, 0.6, 1, 2, 5)] + \
        [("strut", "strut", f) for f in (0.3, 1, 2, 5)]
    table = []
    for name, scene, f in cases:
        runs = {solver: lab.run(scene, f"coulomb-{scene}-{f}-{solver[0]}", "Adaptivity/Maximum steps=12",
                                f"Boundary bottom/Friction coefficient={f}",
                                f"Solver/Coulomb solver={solver}",
                                f"Solver/Check uniqueness={'true' if solver == 'newton' else 'false'}")
                for solver in ("newton", "fixed point")}
        newton, fixed = runs["newton"], runs["fixed point"]
        resultant = {solver: run.value("normal_resultant") for solver, run in runs.items()}
        off = abs(resultant["newton"] - resultant["fixed point"])
        table.append({"problem": name, "f": f,
                      "Newton: most steps": plain(np.max(newton.column("coulomb_newton")), 0)
                      if newton.rows else "-",
                      "fallbacks": sum(r["coulomb_method"] != "newton" for r in newton.rows),
                      "second start differs by": number(newton.value("coulomb_difference"), 2)
                      if newton.rows else "-",
                      "Newton ended": ended(newton),
                      "fixed point: most problems":
                          plain(np.max(fixed.column("coulomb_fixed_point")), 0)
                          if fixed.rows else "-",
                      "contraction": plain(np.nanmax([0, *fixed.column("coulomb_contraction")])),
                      "steps": len(fixed.rows), "fixed point ended": ended(fixed),
                      "resultants agree": "-" if not fixed.rows or fixed.status != "0" else
                      "yes" if off <= 1e-6 * max(map(abs, resultant.values())) else "no"})
    put_table("coulomb", table)


# ---------------------------------------------------------------- 14 tension on the contact


def row_14(lab):
    cases = {"as it stands": [],
             "left edge pushed up": ["Boundary left/Traction=1.5*(5 - y); 0.75"],
             "top pulled up by 1": ["Boundary top/Traction=0; 1"],
             "top pressed down by 5": ["Boundary top/Traction=0; -5"],
             "normal traction -5 on the contact": ["Boundary bottom/Traction=0; -5"],
             "normal traction 5 on the contact": ["Boundary bottom/Traction=0; 5"]}
    table = []
    for case, settings in cases.items():
        run = lab.run("han-6-12", "tension", "Output/Contact tables=true",
                      "Adaptivity/Method=hpa3", "Adaptivity/Smoothness reading=plain", *settings)
        contact = run.contact()
        row = {"case": case, "ended": ended(run),
               "warning": warned(run, "bilateral contact pulls: (.*);")}
        if contact:
            x, pull = contact["x"], contact["normal_traction"]
            middle = np.concatenate(([0], (x[1:] + x[:-1]) / 2, [4]))
            length = np.diff(middle)
            away = (x > 0.1) & (x < 3.9)
            row.update({"normal force [kN/mm]": plain(float(np.sum(pull * length))),
                        "length in tension [mm]": plain(float(np.sum(length[pull > 0]))),
                        "first and last point in tension, x [mm]":
                            f"{x[pull > 0][0]:.4g}, {x[pull > 0][-1]:.4g}",
                        "largest 0.1 mm off the corners [kN/mm^2]":
                            plain(float(np.max(pull[away])), 1)})
        else:
            row.update({"normal force [kN/mm]": "-", "length in tension [mm]": "-",
                        "first and last point in tension, x [mm]": "-",
                        "largest 0.1 mm off the corners [kN/mm^2]": "-"})
        table.append(row)
    put_table("tension", table, hidden=["first and last point in tension, x [mm]"])


# ---------------------------------------------------------------- 15 effectivity along uniform p


def row_15(lab):
    figure, (axes,) = chart(1, "Effectivity along uniform p", 7)
    table = []
    cases = {"stick-slip": ["stick-slip"],
             "stick-slip, transition at 0.1": ["stick-slip", "Exact solution/Transition=0.1"],
             "smooth": ["smooth"]}
    for scene, title in EXAMPLES.items():
        cases[title] = [scene, lab.reference(scene, scene)[0]]
    for k, (name, (scene, *settings)) in enumerate(cases.items()):
        run = lab.run(scene, "effectivity", "Adaptivity/Method=pu", "Adaptivity/Maximum degree=14",
                      "Adaptivity/Start degree=2", "Adaptivity/Maximum steps=13", *settings)
        good = run.column("error_relative") > 1e-11  # above round-off and tolerance of the QP
        p, effectivity = run.column("p_max")[good], run.column("effectivity")[good]
        axes.loglog(p, effectivity, **style(k), label=name)
        table.append({"problem": name, "ended": ended(run),
                      "p": f"{p[0]:.0f} - {p[-1]:.0f}",
                      "effectivity at the least p": plain(effectivity[0]),
                      "at the largest p": plain(effectivity[-1]),
                      "fit: effectivity ~ p^": plain(slope(p, effectivity)),
                      "fit from p = 4 on": plain(slope(p[2:], effectivity[2:]))})
    p = np.array([2, 14])
    axes.loglog(p, 1.2 * p, "k:", label="~ p")
    axes.set_xticks([2, 3, 4, 6, 8, 10, 12, 14], "2 3 4 6 8 10 12 14".split())
    axes.set_xticks([], minor=True)
    axes.set_xlabel("degree p [-]")
    axes.set_ylabel("effectivity: scaled indicator / true error [-]")
    legend(axes, fontsize=8)
    save(figure, "effectivity.png")
    put_table("effectivity", table)


# ---------------------------------------------------------------- solvers of the program


SOLVERS = {"MPRGP, from zero": ("mprgp", "false"),
           "MPRGP, from the step before": ("mprgp", "true"),
           "active set, from zero": ("active set", "false"),
           "active set, from the step before": ("active set", "true")}


def solvers(lab):
    """Every quadratic program of all scenes by each solver; times are medians of three runs."""
    figure, panels = chart(3, "The solvers of the quadratic program, all scenes and steps", 14)
    table = []
    for k, (name, (solver, warm)) in enumerate(SOLVERS.items()):
        columns = {c: [] for c in ("multipliers", "seconds_qp", "qp_multiplications",
                                   "qp_dense_solves", "qp_fell_back", "qp_projected_gradient")}
        failures, total = 0, 0.
        for scene in ("han-6-12", "han-6-13", "stick-slip", "semicoercive", "threshold"):
            for method in ("hpa2", "hpa3"):
                runs = [lab.run(scene, "solvers", f"Adaptivity/Method={method}",
                                "Adaptivity/Maximum steps=24", "Adaptivity/Maximum unknowns=60000",
                                f"Solver/QP solver={solver}", f"Solver/QP warm start={warm}")
                        for repetition in range(3)]
                failures += runs[0].status != "0"
                total += float(np.median([r.value("seconds") for r in runs]))
                for c in columns:
                    columns[c].extend(np.median([r.column(c) for r in runs], axis=0))
        c = {c: np.array(v) for c, v in columns.items()}
        n = c["multipliers"]
        kind = {**style(k), "linewidth": 0, "markersize": 4, "alpha": 0.7, "label": name}
        panels[0].loglog(n, 1e3 * c["seconds_qp"], **kind)
        count = "qp_multiplications" if solver == "mprgp" else "qp_dense_solves"
        panels[1].loglog(n, np.maximum(c[count], 1), **kind)
        panels[2].loglog(n, np.maximum(c["qp_projected_gradient"], 1e-17), **kind)
        table.append({"solver": name, "programs": len(n), "runs that failed": failures,
                      "products": plain(np.sum(c["qp_multiplications"]), 0),
                      "dense solves": plain(np.sum(c["qp_dense_solves"]), 0),
                      "fell back": plain(np.sum(c["qp_fell_back"]), 0),
                      "projected gradient, most": number(np.max(c["qp_projected_gradient"]), 2),
                      "seconds": plain(np.sum(c["seconds_qp"]), 4),
                      "% of the runs": plain(100 * np.sum(c["seconds_qp"]) / total, 1)})
    fastest = min(float(row["seconds"]) for row in table)
    for row in table:
        row["times the fastest"] = plain(float(row["seconds"]) / fastest, 1)
    for axes, label in zip(panels, ("time of one program [ms]",
                                    "products (MPRGP), dense solves (active set) [-]",
                                    "relative projected gradient at the end [-]")):
        axes.set_xlabel("multipliers n [-]")
        axes.set_ylabel(label)
    legend(panels[2], fontsize=8, markerscale=2)
    save(figure, "solvers.png")
    put_table("solvers", table, hidden=["seconds"])


# ---------------------------------------------------------------- the same run twice


def without_times(run):
    return [{c: v for c, v in row.items() if not c.startswith("seconds")} for row in run.rows]


def determinism(lab):
    threads = {"again": ("1", "1"), "2 BLAS threads": ("2", "1"), "2 deal.II threads": ("1", "2"),
               "2 of both": ("2", "2"), "2 of both, again": ("2", "2")}
    table = []
    for scene in ("han-6-12", "han-6-13", "stick-slip"):
        runs = {}
        for case, (blas, dealii) in {"first": ("1", "1"), **threads}.items():
            runs[case] = lab.run(scene, f"determinism-{case}".replace(" ", "-"),
                                 "Output/Contact tables=true",
                                 environment={"OMP_NUM_THREADS": blas,
                                              "OPENBLAS_NUM_THREADS": blas,
                                              "DEAL_II_NUM_THREADS": dealii})
        first = runs.pop("first")
        for case, run in runs.items():
            same = without_times(run) == without_times(first)
            columns = sorted({c for one, two in zip(without_times(run), without_times(first))
                              for c in one if one[c] != two.get(c)})
            tables = sorted(p.name for p in first.home.glob("contact-*.csv"))
            contacts = all((run.home / t).exists() and
                           (run.home / t).read_bytes() == (first.home / t).read_bytes()
                           for t in tables)
            meshes = [r["dofs_free"] for r in run.rows] == [r["dofs_free"] for r in first.rows]
            error = np.max(np.abs(run.column("lagrangian") / first.column("lagrangian") - 1)) \
                if meshes else math.nan
            table.append({"scene": scene, "run": case, "ended": ended(run),
                          "convergence.csv without seconds":
                              "the same bytes" if same else "differs in " + ", ".join(columns),
                          "contact tables": "the same bytes" if contacts else "differ",
                          "meshes": "the same" if meshes else "differ",
                          "lagrangian differs by": number(float(error), 2)})
    put_table("determinism", table)


# ---------------------------------------------------------------- contact that opens and closes


KINDS = ("nodes", "multiplier")


def normal(kind):
    return f"Solver/Normal contact={kind}"


def hertz(a, k=10., centre="0"):
    """Hertz's contact of half-width a under the same gap: p_0 = k a."""
    return [f"Exact solution/Length={a!r}", f"Exact solution/Pressure={k * a!r}",
            f"Exact solution/Transition={centre}",
            f"Boundary bottom/Gap={k * 0.00455!r}*(x - {centre})^2"]


def bottom(run):
    """What summary.json says of the contact boundary."""
    return (run.summary.get("contact") or {}).get("bottom", {})


def touching(run):
    return sum(z["length"] for z in bottom(run).get("zones", []) if z["state"] != "open")


def qp(run):
    """How hard the quadratic programs were."""
    if not run.rows:
        return {"dense solves, most": "-", "all": "-", "steps that fell back": "-"}
    solves = run.column("qp_dense_solves")
    return {"dense solves, most": plain(np.max(solves), 0), "all": plain(np.sum(solves), 0),
            "steps that fell back": plain(np.sum(run.column("qp_fell_back")), 0)}


def off(value, exact, digits=2):
    """Relative distance, 0 for round-off."""
    return small(abs(value / exact - 1)) if value is not None else "-"


def row_18(lab):
    figure, panels = chart(2, "Hertz, hpa3: the contact ends at a vertex, and inside an edge", 11,
                           sharey=True)
    table = []
    lengths = {"1, a vertex": 1., "1 - 1e-9": 1 - 1e-9, "1/2, a vertex later": 0.5, "0.7": 0.7,
               "1/3": 1 / 3}
    methods = {"hpa3": ["Adaptivity/Maximum unknowns=15000", "Adaptivity/Maximum steps=40"],
               "pu": ["Adaptivity/Maximum steps=12", "Adaptivity/Maximum degree=14",
                      "Adaptivity/Start degree=2"]}
    for (name, a), method in ((one, m) for m in methods for one in lengths.items()):
        for axes, kind in zip(panels, KINDS):
            run = lab.run("hertz", "vertex", *hertz(a), normal(kind), f"Adaptivity/Method={method}",
                          *methods[method])
            error = run.column("error_relative")
            if method == "hpa3":
                axes.loglog(run.column("dofs_free"), error,
                            **style(list(lengths).index(name)), label=f"a = {name}")
            table.append({"a": name, "method": method, "normal contact": kind, "ended": ended(run),
                          "N": run.last.get("dofs_free", "-"),
                          "error_relative": number(run.value("error_relative"), 2),
                          "pressure, L2": number(run.value("error_pressure") / (
                              10 * a * math.sqrt(4 * a / 3)), 2),
                          "ends off by": small(run.value("error_transition")),
                          "rises in steps": int(np.sum(error[1:] > error[:-1])),
                          "least effectivity": plain(np.min(run.column("effectivity"))),
                          **qp(run)})
    for axes, kind in zip(panels, KINDS):
        axes.set_title(kind)
        axes.set_xlabel(N_LABEL)
        axes.legend(fontsize=8)
    panels[0].set_ylabel(ERROR_LABEL)
    save(figure, "opening.png")
    put_table("opening", table, hidden=["all"])


CARE = "(the error indicator rose|contact pulls|.lambda. reaches|its place is not unique)"


def row_19(lab):
    table = []
    cases = {f"a = {a}, centre {centre}": (float(a), centre)
             for centre in ("0", "0.3") for a in ("0.07", "7e-3", "7e-4", "7e-6")}
    for case, (a, centre) in cases.items():
        for kind in KINDS:
            run = lab.run("hertz", "point", *hertz(a, centre=centre), normal(kind),
                          "Adaptivity/Maximum steps=40", "Adaptivity/Maximum unknowns=30000")
            table.append({"case": case, "normal contact": kind, "ended": ended(run),
                          "steps": len(run.rows), "N": run.last.get("dofs_free", "-"),
                          "first step that touches": first_touch(run),
                          "relative indicator": number(run.value("estimate_relative"), 2),
                          "error_relative": number(run.value("error_relative"), 2),
                          "resultant off by": off(run.value("normal_resultant"),
                                                  -math.pi / 2 * a * 10 * a),
                          "largest pressure off by": off(bottom(run).get("largest_pressure"),
                                                         10 * a),
                          "width off by": off(touching(run), 2 * a), **qp(run),
                          "warning": warned(run, CARE)})
    still = ["Exact solution/Solution=none", *(f"Boundary {side}/Displacement=0; 0"
                                               for side in ("left", "right", "top"))]
    for case, scene, settings in (
            ("no load, one point touches", "hertz", still),
            ("no load, one point touches, not a node", "hertz",
             [*still, "Boundary bottom/Gap=0.0455*(x - 0.3)^2"]),
            ("weight on a curved support", "resting",
             ["Boundary left/Traction=0; 0", "Boundary bottom/Gap=10*(x - 1)^2"]),
            ("weight on a tip", "resting",
             ["Boundary left/Traction=0; 0", "Boundary bottom/Gap=10*abs(x - 1)"]),
            ("weight on a tip beside the middle", "resting",
             ["Boundary left/Traction=0; 0", "Boundary bottom/Gap=10*abs(x - 1.25)"])):
        for kind in KINDS:
            run = lab.run(scene, "point", *settings, normal(kind))
            table.append({"case": case, "normal contact": kind, "ended": ended(run),
                          "steps": len(run.rows) or "-", "N": run.last.get("dofs_free", "-"),
                          "first step that touches": first_touch(run),
                          "relative indicator": number(run.value("estimate_relative"), 2),
                          "error_relative": "-",
                          "resultant off by": off(run.value("normal_resultant"), -4.)
                          if scene == "resting" and run.rows else "-",
                          "largest pressure off by": "-", "width off by": "-", **qp(run),
                          "warning": warned(run, CARE)})
    put_table("point", table, hidden=["all"])


def first_touch(run):
    pressed = np.flatnonzero(np.abs(run.column("normal_resultant")) > 0)
    return int(pressed[0]) + 1 if len(pressed) else "-"


BLOCK = ["Adaptivity/Maximum steps=8", "Exact solution/Solution=none",
         "Geometry/Lower corner=0, 0", "Geometry/Upper corner=2, 1", "Geometry/Subdivisions=3, 2",
         "Output/Contact tables=true"]  # uneven: bisection meets no special point
MODULUS, LAME = 200 / 1.3 * 0.7 / 0.4, 200 / 1.3 * 0.3 / 0.4  # lambda + 2 mu, lambda; nu = 0.3


def patch_row(run, u_n, pressure):
    """Distance of a run from a constant strain."""
    contact = run.contact()
    row = {"ended": ended(run), "steps": len(run.rows) or "-",
           "N": run.last.get("dofs_free", "-"),
           "pressure": number(pressure, 3) if pressure > 1e-16 else "0"}
    if contact:
        row.update({"u_n off by": number(float(np.max(np.abs(
                        contact["normal_displacement"] - u_n))), 2),
                    "pressure off by": number(float(np.max(np.abs(
                        contact["normal_traction"] + pressure))), 2)})
    else:
        row.update({"u_n off by": "-", "pressure off by": "-"})
    return {**row, "open": plain(bottom(run).get("length", math.nan) - touching(run), 3),
            **qp(run), "warning": "; ".join(run.warnings) or "-"}


def row_20(lab):
    """A block pressed between two plates bulges towards the plane and just reaches it."""
    table = []
    squeeze = 0.01  # strain
    reach = LAME / MODULUS * squeeze  # the bottom comes down by this if nothing stops it
    for text, factor in (("1 - 1e-3", 1 - 1e-3), ("1 - 1e-9", 1 - 1e-9), ("1 - 1e-14", 1 - 1e-14),
                         ("1", 1.), ("1 + 1e-14", 1 + 1e-14), ("1 + 1e-9", 1 + 1e-9),
                         ("1 + 1e-3", 1 + 1e-3)):
        for kind in KINDS:
            gap = reach * factor
            run = lab.run("hertz", "grazing", *BLOCK, normal(kind),
                          "Boundary left/Displacement=0; free", "Boundary top/Displacement=free; 0",
                          f"Boundary right/Displacement=-{2 * squeeze}; free",
                          f"Boundary bottom/Gap={gap!r}")
            table.append({"gap / reach": text, "normal contact": kind,
                          **patch_row(run, min(gap, reach),
                                      max(0., MODULUS * reach * (1 - factor)))})
    put_table("grazing", table, hidden=["all"])


def row_21(lab):
    """Press fit: the plane stands higher than the body's bottom."""
    table = []
    for gap in ("-1e-9", "-0.01", "-0.5", "-1e6"):
        for kind in KINDS:
            run = lab.run("hertz", "interference", *BLOCK, normal(kind),
                          "Boundary left/Displacement=0; free", "Boundary top/Displacement=free; 0",
                          "Boundary right/Displacement=0; free", f"Boundary bottom/Gap={gap}")
            table.append({"case": f"gap {gap}", "normal contact": kind,
                          **patch_row(run, float(gap), -MODULUS * float(gap))})
    free = ["Boundary left/Displacement=0; free", "Boundary top/Displacement=free; 0",
            "Boundary right/Displacement=", "Boundary bottom/Friction bound="]
    others = {"a hump of 0.1": "-0.1*exp(-4*x^2)",
              "a step, on a vertex": "if(x < 2/3, -0.1, 0.1)",
              "a step, inside an edge": "if(x < 0.5, -0.1, 0.1)",
              "a tilt": "0.05 - 0.1*x"}
    for case, gap in others.items():
        for kind in KINDS:
            run = lab.run("hertz", "interference", *BLOCK, normal(kind), *free,
                          "Adaptivity/Maximum steps=14", f"Boundary bottom/Gap={gap}")
            row = {"case": case, "normal contact": kind, **patch_row(run, 0., 0.)}
            row.update({"pressure": number(bottom(run).get("largest_pressure", math.nan), 3),
                        "u_n off by": "-", "pressure off by": "-"})
            table.append(row)
    for kind in KINDS:
        run = lab.run("hertz", "interference", *BLOCK, normal(kind), *free[1:],
                      "Boundary left/Displacement=0; 0", "Boundary bottom/Gap=-0.01")
        row = {"case": "against a clamp", "normal contact": kind, **patch_row(run, 0., 0.)}
        row.update({"pressure": "-", "u_n off by": "-", "pressure off by": "-"})
        table.append(row)
    put_table("interference", table, hidden=["all"])


def row_22(lab):
    table = []
    for load in ("1e-12", "1e-6", "1", "1e6"):
        for kind in KINDS:
            run = lab.run("receding", "receding", normal(kind),
                          f"Boundary top/Traction=0; if(x < 0.5, -{load}, 0)")
            table.append({"load": load, "normal contact": kind, "ended": ended(run),
                          "N": run.last.get("dofs_free", "-"),
                          "touches up to x": f"{touching(run):.8f}",
                          "J / load^2": f"{run.value('energy') / float(load) ** 2:.10e}",
                          "resultant / load": f"{run.value('normal_resultant') / float(load):.12f}",
                          "relative indicator": number(run.value("estimate_relative"), 2),
                          **qp(run), "warning": "; ".join(run.warnings) or "-"})
    put_table("receding", table)


def row_23(lab):
    table = []
    cases = {"Hertz, %d levels": ("hertz", "-0.7, 0; 0.7, 0"),
             "Hertz, %d levels beside the end": ("hertz", "-0.69, 0; 0.71, 0"),
             "Flat punch, %d levels": ("punch", "1, 0"),
             "Receding, %d levels": ("receding", "1.0, 0"),
             "Example 5.2 unilateral, %d levels": ("han-6-12-unilateral", "0.6714, 0")}
    for case, (scene, towards) in cases.items():
        for levels in (10, 40):
            for kind in KINDS:
                run = lab.run(scene, "chatter", normal(kind), "Adaptivity/Method=pu",
                              "Adaptivity/Start degree=2", "Adaptivity/Maximum steps=7",
                              f"Geometry/Graded towards={towards}",
                              f"Geometry/Grading levels={levels}")
                table.append(chatter_row(case % levels + ", p = 2..8", kind, run))
    for scene in ("hertz", "punch", "receding", "resting", "han-6-12-unilateral"):
        for name, settings in {"hpa3": [], "hpa3, each step from zero":
                               ["Solver/QP warm start=false"], "hpa3, MPRGP":
                               ["Solver/QP solver=mprgp"]}.items():
            for kind in KINDS:
                run = lab.run(scene, "chatter", normal(kind), "Adaptivity/Method=hpa3",
                              "Adaptivity/Smoothness reading=plain", "Adaptivity/Maximum steps=20",
                              "Adaptivity/Maximum unknowns=30000", *settings)
                table.append(chatter_row(f"{scene}, {name}", kind, run))
    put_table("chatter", table)


def chatter_row(name, kind, run):
    return {"run": name, "normal contact": kind, "ended": ended(run), "steps": len(run.rows),
            "N": run.last.get("dofs_free", "-"),
            "contact unknowns": run.last.get("multipliers", "-"), **qp(run),
            "products, most": plain(np.max(run.column("qp_multiplications")), 0)
            if run.rows else "-",
            "projected gradient, most": number(np.max(run.column("qp_projected_gradient")), 2)
            if run.rows else "-",
            "last J": f"{run.value('energy'):.10g}",
            "relative error": number(run.value("error_relative"), 2)}


ROWS = {"1": ("locking", row_01), "2": ("inf-sup constant", row_02),
        "3": ("contact meets a clamp; 12: high degrees", rows_03_and_12),
        "4": ("semicoercive", row_04), "5": ("limits of the friction bound", row_05),
        "6": ("exact threshold of slip", row_06), "7": ("transition inside an edge", row_07),
        "8": ("deep meshes", row_08), "9": ("conditioning", row_09),
        "11": ("aspect ratio and distortion", row_11), "13": ("Coulomb friction", row_13),
        "14": ("tension on the contact", row_14),
        "15": ("effectivity along uniform p", row_15), "16": ("determinism", determinism),
        "17": ("solvers of the quadratic program", solvers),
        "18": ("opening at a vertex", row_18), "19": ("one point touches", row_19),
        "20": ("grazing contact", row_20), "21": ("interference", row_21),
        "22": ("contact that recedes", row_22), "23": ("chattering active sets", row_23)}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default="build/hpvi")
    parser.add_argument("--output", default="output/stability", type=pathlib.Path)
    parser.add_argument("--rows", default=",".join(ROWS), help="which, as in 1,5,9; default: all")
    arguments = parser.parse_args()
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    GALLERY.mkdir(exist_ok=True)
    lab = Laboratory(str(pathlib.Path(arguments.program).resolve()), arguments.output.resolve())
    lab.home.mkdir(parents=True, exist_ok=True)
    begin = time.monotonic()
    for row in arguments.rows.split(","):
        title, function = ROWS[row]
        progress(f"{time.monotonic() - begin:5.0f} s  {row}: {title}")
        function(lab)
    progress(f"{time.monotonic() - begin:5.0f} s  charts and tables: {GALLERY}")


if __name__ == "__main__":
    main()
