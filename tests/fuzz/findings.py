# SPDX-License-Identifier: LGPL-2.1-or-later
"""What may be wrong with the end of a run and with what it leaves: finding() says so in one line."""
import csv
import json
import math
import re
import unicodedata
import xml.etree.ElementTree as ElementTree

MOST_KILOBYTES = 2_000_000
NUMBER = r"\d+\.?\d*(?:[eE][-+]?\d+)?"
ROUND_OFF = 1e-9  # of a norm that round-off makes of the solution's


def of_line(errors):
    """One printable line and no other, as users read it."""
    try:
        line = errors.decode("utf-8")
    except UnicodeDecodeError:
        return "stderr is not UTF-8"
    if not line.endswith("\n") or len(line[:-1].splitlines()) != 1:
        return "stderr does not hold one line"
    if any(unicodedata.category(c) in ("Cc", "Zl", "Zp") or "\u202a" <= c <= "\u202e" for c in line[:-1]):
        return "stderr holds control characters"
    if len(line) > 1100:
        return "stderr holds more than a line"
    return "internal error" if "internal error" in line else ""


def finding(run, files, directory):
    """Of a run of the program with these input files, whose results, if any, are in the directory; empty: nothing is wrong."""
    if run.timed_out:
        return "does not end"
    if run.kilobytes > MOST_KILOBYTES:
        return "takes more than 2 GB"
    if run.signal:
        return f"ends by signal {run.signal}"
    if run.status not in (0, 1, 2):
        return f"exit status {run.status}"
    if run.status == 0 and run.errors:
        return "something on stderr"
    if run.status != 0 and (wrong := of_line(run.errors)):
        return wrong
    line = run.errors.decode("utf-8", "replace")
    if run.status == 1 and not line.startswith((*files, "hpvi:")) and all(map(str.isprintable, files)):
        return "the line names no file"
    if "out of memory" in line:
        return "runs out of memory"
    if directory.exists() and run.writes_nothing:
        return "files were written"
    if directory.exists():
        try:
            return of_results(directory, run.status)
        except (ValueError, KeyError, OSError) as error:
            return f"results cannot be read: {type(error).__name__}"
    return "" if run.status != 0 or run.writes_nothing else "no results"


# ------------------------------------------------------------ files


def no_constant(name):
    raise ValueError(f"{name} in JSON")


def table(file):
    """Rows of a CSV file whose fields are empty, finite numbers or words; ValueError where it is ragged."""
    rows = list(csv.reader(file.read_text().splitlines()))
    for row in rows[1:]:
        if len(row) != len(rows[0]):
            raise ValueError("ragged")
    if any(re.fullmatch(r"[-+]?(nan|inf|infinity)", field, re.I) for row in rows for field in row):
        raise ValueError("not finite")
    return [dict(zip(rows[0], row)) for row in rows[1:]]


def of_results(directory, status):
    files = sorted(file for file in directory.iterdir() if file.is_file())
    names = [file.name for file in files]
    for file in files:
        try:
            if file.suffix == ".csv":
                table(file)
            elif file.suffix in (".vtu", ".pvd", ".svg"):
                ElementTree.parse(file)
            elif file.name == "scene.json":
                scene = json.loads(file.read_text(), parse_constant=no_constant)
                edges = [edge for boundary in scene.get("boundaries", []) for edge in boundary.get("edges", [])]  # in space faces
                if any(edge[name] is not None and len(edge[name]) != len(edge["x"]) for edge in edges for name in ("gap", "traction", "displacement")):
                    return "scene.json has values at other places"
                if any(len(face["x"]) not in (4, 25) for boundary in scene.get("boundaries", []) for face in boundary.get("faces", [])):
                    return "scene.json has faces of other points"
            elif file.suffix == ".html" and not file.read_text().endswith("</html>\n"):
                return f"{file.name} is cut"
            elif file.suffix not in (".html", ".json", ".prm", ".dat"):
                return f"leaves {file.suffix or file.name}"
        except (ValueError, UnicodeDecodeError, ElementTree.ParseError) as error:
            return f"{re.sub(r'[0-9]+', 'N', file.name)} is no {file.suffix[1:].upper()}: {error if file.suffix == '.csv' else ''}"
    if names in (["scene.json"], ["scene.json", "scene.svg"]):
        return ""
    if "summary.json" not in names:
        return "leaves files without summary.json"
    try:
        summary = json.loads((directory / "summary.json").read_text(), parse_constant=no_constant)
    except ValueError:
        return "summary.json is no JSON"
    if (summary["status"] == "done") != (status == 0):
        return f"summary.json says {summary['status']} beside exit status {status}"
    if status != 0 and not summary["message"]:
        return "summary.json does not say why"
    return of_numbers(directory, names, summary) if status == 0 else ""


# ------------------------------------------------------------ numbers


def number(row, column):
    return float(row[column]) if row.get(column) else math.nan


def of_numbers(directory, names, summary):
    steps = table(directory / "convergence.csv")
    if len(steps) != summary["steps"]:
        return "convergence.csv has other steps than summary.json"
    low, high, norm = -math.inf, math.inf, 0.
    for step in steps:
        norm = max(norm, number(step, "energy_norm"))
        if number(step, "error_energy") > number(step, "error_bound") * (1 + 1e-6) + ROUND_OFF * norm:
            return "the true error is above its bound"
        if summary["loading"] is None:
            low = max(low, number(step, "energy_low")) if step.get("energy_low") else low
            high = min(high, number(step, "energy_high")) if step.get("energy_high") else high
    if low > high + ROUND_OFF * (norm**2 + abs(low)):
        return "intervals of energy do not meet"
    scene = (directory / "scene.prm").read_bytes().decode("latin-1")  # bytes of the scene, which need not be UTF-8
    moduli = re.findall(r"^ *set (?:Young's modul|Thickness|Upper corner|Spring).*?=(.*)", scene, re.M)
    stiffness = math.prod(max([1., *map(float, re.findall(NUMBER, text))]) for text in moduli)
    return of_forces(table(directory / "forces.csv"), steps, summary, stiffness) if "forces.csv" in names else ""


def of_forces(rows, steps, summary, stiffness):
    """
    Supports, contact and loads are in balance: within their intervals, as far as summary.json states, and beside the forces that
    round-off makes of the displacement.
    """
    is_primal = bool(steps[-1].get("newton_steps"))  # ends where the error of discretisation is larger
    round_off = (1e-6 if is_primal else 1e-9) * stiffness * (summary["largest_displacement"] or {"value": 0})["value"]
    for step in {row["step"] for row in rows}:
        own = [row for row in rows if row["step"] == step]
        stated = 4 * (summary["balance"]["force"] or 0) if step == steps[-1]["step"] else 1e-2 if is_primal else 0
        size = sum(abs(number(row, c)) for row in own for c in ("Fx", "Fy", "Fz") if row.get(c))
        for component in ("Fx", "Fy", "Fz"):
            if all(row.get(component) for row in own):
                known = sum(number(row, component + "_bound") for row in own if row.get(component + "_bound"))
                if abs(sum(number(row, component) for row in own)) > max(1e-6, stated) * size + known + round_off:
                    return f"forces in {component[1]} are out of balance"
    imbalance = summary["balance"]["force"] or 0
    if imbalance > (1e-2 if is_primal else 1e-6) and imbalance * size > round_off and not any("balance" in w for w in summary["warnings"]):
        return "imbalance without a warning"
    return ""
