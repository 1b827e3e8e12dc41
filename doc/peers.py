#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Error against wall time of the same problems by hpvi, GetFEM and CalculiX, each on one thread: what doc/peers.md shows. Rewrites its
tables, and the CSV files and charts in doc/peers, of all cases or of those after --only. doc/peers/*_peer.py tell peers the problems."""
import argparse
import csv
import json
import os
import pathlib
import platform
import re
import resource
import subprocess
import sys
import tempfile
import textwrap
import time

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

ROOT = pathlib.Path(__file__).resolve().parent.parent
FIGURES, PAGE = ROOT / "doc/peers", ROOT / "doc/peers.md"
os.environ.update(OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", CCX_NPROC_STIFFNESS="1", CCX_NPROC_EQUATION_SOLVER="1")
PYTHON = "/usr/bin/python3"  # that Debian's python3-getfem is for

# Scene, word of the force in convergence.csv, length of the contact side, coordinate along it, and words for force and ends.
CASES = {
    "hertz": ("hertz", "normal_resultant", 4, 0, "contact force", "ends of the contact"),
    "ssnv128": ("ssnv128", "friction_resultant", 40, 0, "friction force", "ends of the slip zone"),
    "example_5_2": ("han-6-12", "friction_resultant", 4, 0, "friction force", "end of the slip zone"),
    "shrink_fit": ("shrink-fit", "normal_resultant", 30, 1, "force between shaft and hub", "ends of the stick zone"),
}
CLOSED = {"hertz": (-7.6969020013, [-0.7, 0.7])}  # pi a p_0/2, prm/hertz.prm
STEPS = (1, 2, 3, 4, 6, 8, 10, 12, 14, 16, 18, 20)
BEYOND = 25  # steps of the run that stands for the solution where there is no closed form
HPVI, GETFEM, CALCULIX = "hpvi", "GetFEM", "CalculiX"
# Program, words, arguments, sizes; bold is what each program does best, drawn so. A series ends with the first run above --limit.
SERIES = [
    (HPVI, "hp-adaptive", {"Error/Bound": "false"}, STEPS, True),
    (HPVI, "hp-adaptive with guaranteed bound", {"Error/Bound": "true"}, STEPS, False),
    (HPVI, "uniform quadratic", {"Error/Bound": "false", "Adaptivity/Method": "hup2"}, (1, 2, 3, 4, 5, 6), False),
    (GETFEM, "even mesh, Q2", ["even", "2"], (4, 8, 16, 32), False),
    (GETFEM, "even mesh, Q2, penalty 100 E/h", ["even", "2", "100"], (4, 8, 16, 32), False),
    (GETFEM, "graded by hand, Q2", ["graded", "2"], (1, 2, 3, 4, 6, 8, 12, 16), False),
    (GETFEM, "graded twice by hand, Q2", ["regraded", "2"], (1, 2, 3, 4, 6, 8, 12, 16), True),
    (GETFEM, "graded twice by hand, Q4", ["regraded", "4"], (1, 2, 3, 4, 6, 8), False),
    (CALCULIX, "even mesh, nodes on surface, penalty 50 E", ["even", "nodes", "50"], (4, 8, 16, 32), False),
    (CALCULIX, "even mesh, surfaces, penalty 50 E", ["even", "surfaces", "50"], (4, 8, 16, 32), False),
    (CALCULIX, "even mesh, surfaces, penalty 5000 E", ["even", "surfaces", "5000"], (4, 8, 16), True),
    (CALCULIX, "graded twice by hand, surfaces, penalty 5000 E", ["regraded", "surfaces", "5000"], (1, 2, 3, 4), False),
    (CALCULIX, "even mesh, mortar, penalty 5000 E", ["even", "mortar", "5000"], (4, 8, 16), False),
]
# Colours of Okabe and Ito for programs, line and marker for settings; what is bold has a whole line.
COLOURS = {HPVI: "#0072b2", GETFEM: "#d55e00", CALCULIX: "#009e73"}
STYLES = [("o", (0, (6, 1, 1, 1, 1, 1))), ("s", "--"), ("^", "-."), ("D", ":"), ("v", (0, (3, 1, 1, 1)))]
COLUMNS = ["program", "setting", "size", "force", "ends", "force_error", "ends_error", "seconds", "seconds_without_start"]

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--program", default="build/hpvi")
parser.add_argument("--only", nargs="*", choices=[*CASES, "start_up"], default=[*CASES, "start_up"])
parser.add_argument("--repeat", type=int, default=3, help="the fastest of so many runs counts; of runs above two seconds the first")
parser.add_argument("--limit", type=float, default=6, help="seconds after which a series has no larger run")
parser.add_argument("--clock", choices=["wall", "cpu"], help="CPU time where the machine is busy; without it the load decides")
parser.add_argument("--settings", default="", help="a regular expression for those to run; the others stay as they are in the CSV files")
parser.add_argument("--draw", action="store_true", help="run nothing: charts and tables from the CSV files")
options = parser.parse_args()
HPVI_PROGRAM = ROOT / options.program
LOAD = os.getloadavg()[0]
LONGEST = max(20, int(4 * options.limit))  # CPU seconds of any run; the next but one of a series would take as much
CLOCK = options.clock or ("wall" if LOAD < 0.5 else "cpu")


def timed(command, **keywords):
    """Seconds of a process with its children, and what it prints; nothing where it fails or works too long."""
    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (LONGEST, LONGEST))

    begin, before = time.monotonic(), resource.getrusage(resource.RUSAGE_CHILDREN)
    run = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False, preexec_fn=limit, cwd=ROOT, **keywords)
    wall, after = time.monotonic() - begin, resource.getrusage(resource.RUSAGE_CHILDREN)
    return (wall if CLOCK == "wall" else after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime), run


def fastest(run):
    """What run() gives, (seconds, result), the fastest of several."""
    best = run()
    for _ in range(options.repeat - 1):
        if best[0] < 2:
            best = min(best, run(), key=lambda pair: pair[0])
    return best


def hpvi_run(case, entries, steps):
    """A run of so many steps from the start, files of the last step written: wall seconds, the last row of convergence.csv."""
    with tempfile.TemporaryDirectory() as home:
        words = [word for key, value in {"Adaptivity/Method": "hpa3", "Output/Steps": "last", "Adaptivity/Maximum steps": steps, **entries}.items()
                 for word in ("--set", f"{key}={value}")]
        seconds, run = timed([HPVI_PROGRAM, "--output", home, *words, f"prm/{CASES[case][0]}.prm"])
        if run.returncode:
            sys.exit(f"hpvi ended with {run.returncode}: {CASES[case][0]} {words}")
        with (pathlib.Path(home) / "convergence.csv").open(newline="") as file:
            row = list(csv.DictReader(file))[-1]
    along = CASES[case][3]
    return seconds, {"force": float(row[CASES[case][1]]), "ends": [float(place.split("/")[along]) for place in row["transitions"].split()],
                     "done": int(row["step"]), "bound": row["error_bound"]}


def peer_run(program, case, arguments, size):
    """Nothing where the peer finds no solution or takes too long: seconds of the whole process, its words."""
    seconds, run = timed([PYTHON, FIGURES / f"{program.lower()}_peer.py", case, arguments[0], str(size), *arguments[1:]])
    if run.returncode == 3 or run.returncode < 0:
        return seconds, None
    if run.returncode:
        sys.exit(f"{program} {case} {arguments} {size} ended with {run.returncode}: {run.stderr}")
    result = json.loads(run.stdout.splitlines()[-1])
    # Of CalculiX the script that writes its input does not count.
    return (result[CLOCK] if program == CALCULIX else seconds), result


def measured(case, start):
    """Rows of a case; one without a force found no solution."""
    rows, known = [], read(case) if options.settings else []
    for program, setting, arguments, sizes, _ in SERIES:
        if not re.search(options.settings, f"{program}, {setting}"):
            rows += [{**row, "ends": [float(end) for end in row["ends"].split()]} for row in known
                     if (row["program"], row["setting"]) == (program, setting)]
            continue
        if program == HPVI and "bound" in setting and case != "example_5_2":
            continue  # Coulomb's law has none; one case shows what it costs
        if program == CALCULIX and (case == "example_5_2" or case == "shrink_fit" and "surfaces" not in setting):
            continue  # no friction bound; no mortar contact of bodies of revolution, no pressures of contact by nodes
        for size in sizes:
            if program == HPVI:
                seconds, result = fastest(lambda: hpvi_run(case, arguments, size))
                if result["done"] < size:  # round-off ended the run
                    break
            else:
                seconds, result = fastest(lambda: peer_run(program, case, arguments, size))
            if result is None:
                rows.append({**dict.fromkeys(COLUMNS, ""), "program": program, "setting": setting, "size": size, "seconds": seconds})
                if seconds > options.limit:
                    break
                continue
            rows.append({"program": program, "setting": setting, "size": size, "force": result["force"], "ends": result["ends"], "seconds": seconds,
                         "seconds_without_start": result[CLOCK] if program == GETFEM else max(seconds - start[program], 1e-3)})
            print(case, *rows[-1].values(), flush=True)
            if seconds > options.limit:
                break
    return rows


def with_errors(case, rows):
    """Errors against the closed form, or against a run of hpvi beyond those of the chart."""
    force, ends = CLOSED.get(case) or (lambda result: (result["force"], result["ends"]))(hpvi_run(case, SERIES[0][2], BEYOND)[1])
    for row in rows:
        if row["force"] == "":
            row["ends"] = ""
            continue
        row["force_error"] = abs(abs(row["force"]) / abs(force) - 1)
        row["ends_error"] = ""
        if len(row["ends"]) == len(ends):
            row["ends_error"] = max(abs(a - b) for a, b in zip(sorted(row["ends"]), ends)) / CASES[case][2]
        row["ends"] = " ".join(f"{end:.9g}" for end in row["ends"])
    return {"force": abs(force), "ends": ends}


def write(case, rows):
    with (FIGURES / f"{case}.csv").open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows([[f"{row[c]:.{9 if c == 'force' else 3}g}" if isinstance(row[c], float) else row[c] for c in COLUMNS] for row in rows])


def read(case):
    with (FIGURES / f"{case}.csv").open(newline="") as file:
        return [{key: float(value) if value and key not in ("program", "setting", "ends") else value for key, value in row.items()}
                for row in csv.DictReader(file)]


def series_of(rows, program, setting):
    return [row for row in rows if (row["program"], row["setting"]) == (program, setting) and row["force"] != ""]


def draw(case, rows, clock):
    figure, all_axes = plt.subplots(1, 2, figsize=(11, 6))
    figure.subplots_adjust(left=0.07, right=0.99, top=0.98, bottom=0.28, wspace=0.2)
    for axes, error, words in zip(all_axes, ("force_error", "ends_error"), CASES[case][4:]):
        for program, colour in COLOURS.items():
            for (marker, line), (_, setting, _, _, bold) in zip(STYLES, [s for s in SERIES if s[0] == program]):
                points = [row for row in series_of(rows, program, setting) if row[error] != ""]
                if not points:
                    continue
                errors = [max(row[error], 1e-9) for row in points]
                axes.loglog([row["seconds"] for row in points], errors, color=colour, marker=marker, linestyle="-" if bold else line,
                            markersize=7 if bold else 3.5, linewidth=2.6 if bold else 1, label=f"{program}: {setting}")
                if bold and program != CALCULIX:
                    axes.loglog([row["seconds_without_start"] for row in points], errors, color=colour, linestyle=(0, (1, 1)), linewidth=1.6,
                                label=f"{program}: the same without start-up")
        axes.set_xlabel(f"{clock} time, one thread [s]")
        axes.set_ylabel(f"{words}: " + ("relative error" if error == "force_error" else "error over the length of the side"))
        axes.grid(alpha=0.3)
    handles, labels = all_axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncol=3, fontsize=7.5)
    figure.savefig(FIGURES / f"{case}.png", dpi=110)
    plt.close(figure)


def first_time(points, error, limit, column):
    """Seconds of the fastest run from which on all larger ones of its series stay below the limit."""
    below = [k for k in range(len(points)) if all(row[error] != "" and row[error] <= limit for row in points[k:])]
    return min((points[k][column] for k in below), default=None)


def seconds_text(seconds):
    return "-" if seconds is None else f"{seconds:.2g}" if seconds < 10 else f"{seconds:.0f}"


def table(case, rows):
    """Seconds to an error, with start-up and without."""
    lines = []
    for error, words in zip(("force_error", "ends_error"), CASES[case][4:]):
        limits = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6) if error == "force_error" else (1e-2, 1e-3, 1e-4, 1e-5)
        lines += [f"Seconds until the {words} {'is' if words.startswith(('end ', 'contact', 'friction', 'force')) else 'are'} right to "
                  "(in brackets without start-up; - : in no run):", "",
                  "| | " + " | ".join(f"{limit:.0e}".replace("e-0", "e-") if limit < 1e-2 else "1 %" for limit in limits) + " |",
                  "|---|" + "---|" * len(limits)]
        for program, setting, _, _, bold in SERIES:
            points = series_of(rows, program, setting)
            if not points or all(row[error] == "" for row in points):
                continue
            cells = []
            for limit in limits:
                whole, own = (first_time(points, error, limit, column) for column in ("seconds", "seconds_without_start"))
                cells.append("-" if whole is None else seconds_text(whole) if program == CALCULIX else f"{seconds_text(whole)} ({seconds_text(own)})")
            name = f"{program}: {setting}"
            lines.append(f"| {f'**{name}**' if bold else name} | " + " | ".join(cells) + " |")
        lines.append("")
    return lines


def replace(page, name, lines):
    return re.sub(rf"(<!-- {name} -->\n).*?(<!-- end -->)", lambda found: found[1] + "\n".join(lines) + "\n" + found[2], page, flags=re.S)


def version(command, pattern):
    return re.search(pattern, subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False).stdout)[1]


def processor():
    return re.search(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text())[1] if platform.system() == "Linux" else platform.processor()


def start_up():
    """Seconds of programs that are started and do nothing."""
    commands = {HPVI: [HPVI_PROGRAM, "--version"], CALCULIX: ["ccx", "-v"], GETFEM: [PYTHON, "-c", "import getfem"]}
    return {program: min(timed(command)[0] for _ in range(5)) for program, command in commands.items()}


def machine(start):
    versions = (version([HPVI_PROGRAM, "--version"], r"hpvi (\S+)"), version(["ccx", "-v"], r"Version (\S+)"),
                version([PYTHON, "-c", "import getfem; print('v', getfem.getfem_env('version'))"], r"v (\S+)"))
    clock = (f"wall time (load average {LOAD:.1f} at the begin)" if CLOCK == "wall" else
             f"CPU time, **while the machine had other work** (load average {LOAD:.1f}): which lengthens it")
    return wrapped("hpvi {}, CalculiX {} and GetFEM {}, these two of Debian 12; ".format(*versions) + f"{processor()}, one thread each, {clock}; "
                   f"the fastest of {options.repeat}. Start-up: hpvi {start[HPVI]:.2f} s, Python with GetFEM {start[GETFEM]:.2f} s, "
                   f"CalculiX {start[CALCULIX]:.2f} s.")


def wrapped(text):
    return textwrap.wrap(text, 118, break_on_hyphens=False, break_long_words=False)


def truth_lines(case, rows):
    """Compares, and says with what."""
    truth = with_errors(case, rows)
    words, ends = CASES[case][4:]
    closest = min((row["force_error"] for row in rows if row["program"] == GETFEM and row["force"] != ""), default=float("nan"))
    failed = [f"- {row['program']}, {row['setting']}, size {row['size']:.0f}" for row in rows if row["force"] == ""]
    compared = f"Compared with {'the closed form' if case in CLOSED else f'hpvi after {BEYOND} steps'}: {words} {truth['force']:.9g}, " \
        f"{ends} {', '.join(f'{end:.7g}' for end in truth['ends'])}. GetFEM comes as close to that force as {closest:.1e}."
    return wrapped(compared) + (["", f"No solution, or none within {LONGEST} s:", "", *failed] if failed else [])


def start_up_table():
    run = subprocess.run([PYTHON, "-B", FIGURES / "start_up.py", HPVI_PROGRAM, "output/peers/start"], cwd=ROOT, stdout=subprocess.PIPE, text=True, check=True)
    return ["| | libraries | relocations | `hpvi --version` | eight steps of Example 5.2 |", "|---|---|---|---|---|", *run.stdout.splitlines()]


def main():
    start = None if options.draw else start_up()
    for case in options.only:
        new = {}
        if case == "start_up":
            if not options.draw:
                PAGE.write_text(replace(PAGE.read_text(), case, start_up_table()))
            continue
        if not options.draw:
            rows = measured(case, start)
            new = {f"{case} truth": truth_lines(case, rows), "machine": machine(start)}
            write(case, rows)
        rows, page = read(case), PAGE.read_text()
        for name, lines in {**new, case: table(case, rows)}.items():
            page = replace(page, name, lines)
        PAGE.write_text(page)
        draw(case, rows, "CPU" if "CPU time, **" in page else "wall")


sys.exit(main())
