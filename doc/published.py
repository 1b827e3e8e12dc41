#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Published cases with error bars: solves the scenes of prm/published, two at a time, reads the values of the rows of source/python/hpvi/benchmarks.json from their
result files, judges what is published against the error bar, and writes doc/benchmarks.md, doc/benchmarks/rows.csv and scenes.csv.

published.py --program build/hpvi [SCENE ...]      only these scenes; the other rows stay as they are
published.py --draw                                the page from the tables that are there"""
import argparse
import concurrent.futures
import csv
import importlib.util
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import textwrap
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCENES, PAGE, TABLES = ROOT / "prm/published", ROOT / "doc/benchmarks.md", ROOT / "doc/benchmarks"
MODULE, ROWS = (ROOT / f"source/python/hpvi/benchmarks.{end}" for end in ("py", "json"))
ROUND_OFF = 1e-11  # of a value: what is never claimed
NEAR = 5  # points of the contact table from which a value at a place is interpolated
WORDS = {"energy": "guaranteed", "coupling": "bounded", "zones": "if", "history": "bounded", "estimate": "estimated"}


def benchmarks():
    spec = importlib.util.spec_from_file_location("benchmarks", MODULE)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


# ---------------------------------------------------------------- runs


def key_of(scene, entries):
    return scene + "".join(f"-{re.sub('[^A-Za-z0-9.]+', '_', f'{path}={value}')}" for path, value in sorted(entries.items()))


def solve(program, output, scene, entries):
    home = output / key_of(scene, entries)
    words = [word for path, value in entries.items() for word in ("--set", f"{path}={value}")]
    start = time.monotonic()
    done = subprocess.run([program, SCENES / f"{scene}.prm", "--output", home, *words, "--set", "Output/VTU=false"], text=True, capture_output=True, check=False,
                          env={**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"})
    if done.returncode:
        sys.exit(f"{home.name}: {done.stderr}")
    return Run(home, time.monotonic() - start)


def table(path):
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


class Run:
    def __init__(self, home, seconds):
        self.home, self.seconds = home, seconds
        self.steps = table(home / "convergence.csv")
        self.forces = table(home / "forces.csv")
        self.summary = json.loads((home / "summary.json").read_text())

    def contact(self, step, boundary):
        return [row for row in table(self.home / f"contact-{step + 1:02}.csv") if row["boundary"] == boundary]

    # Each reader gives the value of a step and, where there is one, the half-width of its guaranteed interval.

    def column(self, step, name, factor=1):
        return self.with_bound(self.steps[step], name, factor)

    def force(self, step, name, kind, component, factor=1):
        (found,) = [row for row in self.forces if row["step"] == self.steps[step]["step"] and row["name"] == name and row["kind"] == kind]
        return self.with_bound(found, component, factor)

    @staticmethod
    def with_bound(found, name, factor):
        bound = found.get(f"{name}_bound")
        return factor * float(found[name]), abs(factor) * float(bound) if bound else None

    def ratio(self, step, one, other, factor=1):
        return factor * float(self.steps[step][one]) / float(self.steps[step][other]), None

    def energy(self, step):
        low, high = (self.steps[step][f"energy_{end}"] for end in ("low", "high"))
        if low and high:
            return (float(low) + float(high)) / 2, (float(high) - float(low)) / 2
        return float(self.steps[step]["energy"]), None

    def transition(self, step, which):
        places = sorted(float(place.split("/")[0]) for place in self.steps[step]["transitions"].split())
        return (abs(places[which]) if len(places) > (which if which >= 0 else 0) else math.nan), None

    def spacing(self, step, place):
        """Distance of the points on both sides of a place |x|: nothing is known of an end of a zone between them."""
        points = sorted(abs(float(found["x"])) for found in table(self.home / f"contact-{step + 1:02}.csv"))
        return min((x for x in points if x >= place), default=place) - max((x for x in points if x <= place), default=place)

    def nearest(self, step, boundary, column, x, factor=1):
        return factor * float(min(self.contact(step, boundary), key=lambda found: abs(float(found["x"]) - x))[column]), None

    def at(self, step, boundary, column, x, factor=1):
        points = {}
        for found in self.contact(step, boundary):
            points[float(found["x"])] = float(found[column])
        near = sorted(points, key=lambda place: abs(place - x))[:NEAR]
        values = [points[place] for place in near]
        for width in range(1, len(near)):  # Neville's scheme
            values = [((x - near[k + width]) * values[k] + (near[k] - x) * values[k + 1]) / (near[k] - near[k + width]) for k in range(len(near) - width)]
        return factor * values[0], None

    def extreme(self, step, boundary, column, factor=1):
        """The value that is farthest from their mean, of those that shall be one."""
        values = [float(found[column]) for found in self.contact(step, boundary)]
        mean = sum(values) / len(values)
        return factor * max(values, key=lambda value: abs(value - mean)), None

    def exponent(self, step, boundary, column, x):
        """-d log p/d log r between thirty of the smallest distances and 1e-3, by least squares."""
        points = [(abs(float(found["x"]) - x), abs(float(found[column]))) for found in self.contact(step, boundary) if float(found["x"]) < x]
        least = min(r for r, _ in points)
        chosen = [(math.log(r), math.log(p)) for r, p in points if 30 * least < r < 1e-3 and p > 0]
        if len(chosen) < 4:
            return math.nan, None
        r_mean, p_mean = (sum(values) / len(chosen) for values in zip(*chosen))
        return -sum((r - r_mean) * (p - p_mean) for r, p in chosen) / sum((r - r_mean) ** 2 for r, _ in chosen), None

    def read(self, how):
        """Value, half-width and word of the last step."""
        name, *arguments = how
        reader = getattr(self, {"contact": "at"}.get(name, name))
        n = len(self.steps)
        value, bound = reader(n - 1, *arguments)
        if bound is not None:
            return value, max(bound, ROUND_OFF * abs(value)), "guaranteed"
        if name == "nearest":
            return value, math.inf, "one mesh"
        half = float(self.steps[-1]["dofs_free"]) / 2
        before = [reader(k, *arguments)[0] for k in range(n - 1) if k >= n - 3 or float(self.steps[k]["dofs_free"]) > half]
        if not before:
            return value, ROUND_OFF * abs(value), "round-off" if self.summary["stopped_by"] != "Maximum steps" else "one mesh"
        change = max((abs(other - value) for other in before if not math.isnan(other)), default=math.inf)
        resolved = self.spacing(n - 1, abs(value)) if name == "transition" else 0
        return value, max(2 * change + resolved, ROUND_OFF * abs(value)), "last steps"

    def error(self):
        """The relative error in the energy norm, and the word that goes with it."""
        last = self.steps[-1]
        for found in reversed(self.steps):
            if found["error_bound_relative"]:
                return float(found["error_bound_relative"]), WORDS[found.get("bound_kind") or "energy"]
        if last.get("error_estimate_equilibrated"):
            return float(last["error_estimate_equilibrated"]) / float(last["energy_norm"]), "estimated"
        return float(last["estimate_relative"]), "indicator"


# ---------------------------------------------------------------- rows


def decimals(bar):
    """Decimals at which the bar has one digit, rounded up, or two if the first is a 1."""
    if bar <= 0:
        return 12
    exponent = math.floor(math.log10(bar))
    return -exponent + (1 if bar / 10.0 ** exponent < 2 else 0)


def with_bar(value, bar):
    if math.isinf(bar):
        return f"{value:.4g}"
    n = decimals(bar)
    shown = math.ceil(bar * 10.0 ** n - 1e-9) * 10.0 ** -n
    if n > 0 and (abs(value) >= 1e-3 or value == 0):
        return f"{value:.{n}f} ± {shown:.2g}"
    if n <= 0 and abs(value) < 1e7:
        return f"{round(value, n):.0f} ± {shown:.0f}"
    digits = max(0, n + math.floor(math.log10(abs(value)))) if value else 1
    return f"{value:.{digits}e} ± {shown:.2g}"


def judged(module, rows):
    """Writes differences and verdicts into the rows."""
    by_name = {found["name"]: found for found in rows}
    for r in module.ROWS:
        found = by_name.get(r.name)
        if not found:
            continue
        reference, within = module.reference_of(r)
        found["verdict"] = "own"
        if reference is None:
            continue
        difference = float(found["value"]) - reference
        found["difference"] = repr(difference / abs(reference))
        other = by_name.get(r.shown_by)
        if r.shows:
            found["verdict"] = "for comparison"
        elif abs(difference) <= float(found["bar"]) + within:
            found["verdict"] = "agrees"
        elif other and explains(found, other, r, module):
            found["verdict"] = "explained"
        elif abs(difference) <= module.TOLERANCES.get(r.source, 0) * abs(reference):
            found["verdict"] = f"within {100 * module.TOLERANCES[r.source]:g} %"
        else:
            found["verdict"] = "open"


def explains(found, other, r, module):
    """Does the companion, for which the assumption of the source holds better, come nearer to its own reference, by a factor of at least one and a half?"""
    (partner,) = [one for one in module.ROWS if one.name == r.shown_by]
    ours, theirs = (abs(float(one["value"]) / module.reference_of(row)[0] - 1) for one, row in ((found, r), (other, partner)))
    return theirs < ours / 1.5


def twin_of(module, scene):
    """Scene and entries of the second discretisation."""
    twin = module.TWINS[scene]
    return (twin, ()) if isinstance(twin, str) else (scene, tuple(sorted(twin.items())))


def measure(module, program, output, names, jobs):
    chosen = [r for r in module.ROWS if not names or r.scene in names]
    wanted = {(r.scene, tuple(sorted(r.entries.items()))) for r in chosen}
    wanted |= {twin_of(module, scene) for scene in module.TWINS if not names or scene in names}
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        runs = dict(zip(wanted, pool.map(lambda one: solve(program, output, one[0], dict(one[1])), wanted)))
    rows, scenes = [], []
    for r in chosen:
        run = runs[r.scene, tuple(sorted(r.entries.items()))]
        value, bar, word = run.read(r.read)
        if r.scene in module.TWINS:
            twin = runs[twin_of(module, r.scene)]
            other = twin.read(r.read)[0]
            resolved = max(one.spacing(len(one.steps) - 1, abs(value)) for one in (run, twin)) if r.read[0] == "transition" else 0
            bar, word = max(2 * abs(other - value) + resolved, ROUND_OFF * abs(value)), "two meshes"
        rows.append({"name": r.name, "scene": r.scene, "quantity": r.quantity, "unit": r.unit, "reference": "" if r.reference is None else r.reference, "value": repr(value),
                     "bar": repr(bar), "word": word, "difference": "", "verdict": "", "seconds": f"{run.seconds:.1f}"})
    for scene in dict.fromkeys(r.scene for r in chosen):
        run = runs[scene, ()] if (scene, ()) in runs else next(run for (name, _), run in runs.items() if name == scene)
        error, word = run.error()
        scenes.append({"scene": scene, "unknowns": run.steps[-1]["dofs_free"], "steps": len(run.steps), "degrees": f"{run.steps[-1]['p_min']} to {run.steps[-1]['p_max']}",
                       "error": repr(error), "word": word, "seconds": f"{run.seconds:.1f}"})
    return rows, scenes


def merged(path, new, order, key):
    """The rows of a table, those that are new in the place of old ones."""
    known = {found[key]: found for found in (table(path) if path.exists() else [])}
    known.update({found[key]: found for found in new})
    return [known[name] for name in order if name in known]


def write(path, rows):
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


# ---------------------------------------------------------------- page


def published(r):
    if r.reference is None:
        return ""
    return r.reference if isinstance(r.reference, str) else f"{r.reference:.10g}"


def row_table(module, rows, kinds):
    by_name = {found["name"]: found for found in rows}
    lines = ["| scene | quantity | unit | published | hpvi | bar | difference | verdict |", "|---|---|---|---|---|---|---|---|"]
    if kinds == ("own",):
        lines = ["| scene | quantity | unit | hpvi | bar |", "|---|---|---|---|---|"]
    for r in module.ROWS:
        kind = "own" if r.reference is None else "printed" if isinstance(r.reference, str) else "form"
        if r.source == "doc/bodies.md":
            kind = "second"
        if r.source in ("CGS-4", "V6.04.503", "V6.04.104", "SSNP154"):
            kind = "printed"
        found = by_name.get(r.name)
        if kind not in kinds or not found:
            continue
        ours = with_bar(float(found["value"]), float(found["bar"]))
        scene = f"[{r.scene}](../prm/published/{r.scene}.prm)"
        if kinds == ("own",):
            lines.append(f"| {scene} | {r.quantity} | {r.unit} | {ours} | {found['word']} |")
            continue
        relative = abs(float(found["difference"]))
        lines.append(f"| {scene} | {r.quantity} | {r.unit} | {published(r)} | {ours} | {found['word']} | {relative:.1e} | {found['verdict']} |")
    return lines


def differences(module, rows):
    by_name, said = {found["name"]: found for found in rows}, {}
    for r in module.ROWS:
        found = by_name.get(r.name)
        if found and found["verdict"] not in ("agrees", "own", "for comparison"):
            said.setdefault((r.scene, r.differs or "Not known why"), []).append((r, found))
    lines = []
    for (scene, why), ones in said.items():
        quantities = ", ".join(f"{r.quantity} ({found['verdict']})" for r, found in ones)
        lines.append(f"- **{scene}**, {quantities}: {why[0].upper()}{why[1:]}.")
    return lines


def source_lines(module):
    lines = []
    for name, text in module.SOURCES.items():
        ones = [r for r in module.ROWS if r.source == name]
        if ones:
            forms = list(dict.fromkeys(r.equation for r in ones if r.equation and r.equation not in ("the same", "as above")))
            lines.append(f"- {', '.join(dict.fromkeys(r.scene for r in ones))}: {text}." + (f" `{'`, `'.join(forms)}`" if forms else ""))
    return lines


def scene_table(scenes):
    lines = ["| scene | unknowns | steps | degrees | error in the energy norm | word | s |", "|---|---|---|---|---|---|---|"]
    for found in scenes:
        error = float(found["error"])
        lines.append(f"| [{found['scene']}](../prm/published/{found['scene']}.prm) | {found['unknowns']} | {found['steps']} | {found['degrees']} | "
                     f"{'round-off' if error < 1e-11 else f'{error:.1e}'} | {found['word']} | {found['seconds']} |")
    return lines


def verdict_lines(module, rows):
    count = {}
    for found in rows:
        count[found["verdict"]] = count.get(found["verdict"], 0) + 1
    exact = {r.name: r for r in module.ROWS if isinstance(r.reference, float) and not r.shows and not r.shown_by}
    shares = [abs(float(found["value"]) - exact[found["name"]].reference) / float(found["bar"]) for found in rows if found["name"] in exact and found["word"] == "last steps"]
    return [f"{len(rows)} rows of {len({found['scene'] for found in rows})} scenes: " + ", ".join(f"{n} {verdict}" for verdict, n in sorted(count.items(), key=lambda one: -one[1]))
            + f". Some bars are estimates. For {len(shares)} rows with such a bar the exact value is known, and {sum(share <= 1 for share in shares)} of the bars hold it. "
            f"The true error is {sorted(shares)[len(shares) // 2]:.2g} of the bar in the median and {max(shares):.2g} at most."]


def broken(line):
    """Text in lines of 118 characters, tables as they are."""
    return line if line.startswith("|") else textwrap.fill(line, 118, subsequent_indent="  " if line.startswith("- ") else "",
                                                           break_on_hyphens=False, break_long_words=False)


def replace(page, name, lines):
    lines = [broken(line) for line in lines]
    return re.sub(rf"(<!-- {name} -->\n).*?(<!-- end -->)", lambda found: found[1] + "\n".join(lines) + "\n" + found[2], page, flags=re.S)


def machine(program, seconds):
    version = subprocess.run([program, "--version"], text=True, capture_output=True, check=True).stdout.split("\n")[0]
    cpu = re.search(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text())
    return [f"{version}; {cpu[1] if cpu else 'a machine'}, two runs at a time of one thread each; {seconds:.0f} s for all."]


def draw(module, rows, scenes, said):
    page = PAGE.read_text()
    parts = {"count": verdict_lines(module, rows), "printed": row_table(module, rows, ("printed",)), "forms": row_table(module, rows, ("form",)),
             "second": row_table(module, rows, ("second",)), "own": row_table(module, rows, ("own",)), "differences": differences(module, rows),
             "sources": source_lines(module), "scenes": scene_table(scenes), **said}
    for name, lines in parts.items():
        page = replace(page, name, lines)
    PAGE.write_text(page)


def keep_own(rows):
    """Values of own cases go where hpvi.benchmarks has them."""
    text = ROWS.read_text()
    for found in rows:
        text = re.sub(rf'("name": "{re.escape(found["name"])}".*"own": )\[.*?\]', rf'\g<1>[{float(found["value"])!r}, {float(found["bar"]):.2g}]', text)
    ROWS.write_text(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="build/hpvi", type=pathlib.Path)
    parser.add_argument("--output", default="output/published", type=pathlib.Path)
    parser.add_argument("--jobs", default=2, type=int)
    parser.add_argument("--draw", action="store_true")
    parser.add_argument("--check", action="store_true", help="write nothing, and end with status 1 where a verdict is not that of rows.csv")
    parser.add_argument("scenes", nargs="*")
    options = parser.parse_args()
    module = benchmarks()
    known = list(dict.fromkeys(r.scene for r in module.ROWS))
    unknown = [name for name in options.scenes if name not in known]
    if unknown:
        sys.exit(f"published.py: {', '.join(unknown)}: unknown; there are {', '.join(known)}")
    start, rows, scenes = time.monotonic(), [], []
    if not options.draw:
        rows, scenes = measure(module, options.program.resolve(), options.output, options.scenes, options.jobs)
    seconds = time.monotonic() - start
    if options.check:
        before = {found["name"]: found["verdict"] for found in table(TABLES / "rows.csv")}
        judged(module, rows)
        wrong = [f"{found['name']}: {found['verdict']}, and was {before.get(found['name'])}: {found['value']} +- {found['bar']}" for found in rows
                 if found["verdict"] != before.get(found["name"])]
        sys.exit("\n".join(wrong) or 0)
    rows = merged(TABLES / "rows.csv", rows, [r.name for r in module.ROWS], "name")
    scenes = merged(TABLES / "scenes.csv", scenes, known, "scene")
    judged(module, rows)
    write(TABLES / "rows.csv", rows)
    write(TABLES / "scenes.csv", scenes)
    keep_own(rows)
    draw(module, rows, scenes, {} if options.draw or options.scenes else {"machine": machine(options.program.resolve(), seconds)})
    for found in rows:
        if not options.scenes or found["scene"] in options.scenes:
            print(f"{found['name']:28} {str(found['reference'])[:20]:>20}  {with_bar(float(found['value']), float(found['bar'])):>28} {found['word']:10} {found['verdict']}")


if __name__ == "__main__":
    main()
