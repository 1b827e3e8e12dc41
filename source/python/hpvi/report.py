# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a run has found, on one page that holds its pictures: report.html, and report.pdf on demand.

    hpvi.report.write("output/punch")             also: hpvi --report output/punch

Needs python3-matplotlib and python3-jinja2, and weasyprint for the PDF.
"""
import base64
import math
import pathlib

import numpy as np

from . import plot, results, words
from .results import Run, RunError, von_mises

MOST_CONTACTS = 4  # of more charts nobody would see any
FIRST_STEPS, LAST_STEPS = 2, 9  # of a long table

# Columns of the table of steps: name, head, digits.
STEPS = (("step", "step", 9), ("load_step", "load step", 9), ("t", "t", 4), ("elements", "elements", 9), ("dofs_free", "free unknowns", 9),
         ("multipliers", "multipliers", 9), ("p_min", "p from", 9), ("p_max", "to", 9), ("estimate_relative", "indicator", 2),
         ("error_bound_relative", "bound", 2), ("error_relative", "true error", 2), ("energy", "energy", 7),
         ("qp_multiplications", "products", 9), ("newton_steps", "Newton steps", 9), ("newton_cg", "cg steps", 9))


def write(directory, pdf=False):
    """Writes report.html into a directory of results, with pdf report.pdf beside it. Returns the path of the page.

    Raises RunError (a ValueError) where the directory is none of a run, ImportError where a library is missing."""
    run = Run(directory)
    text = page(run)
    path = pathlib.Path(directory) / "report.html"
    replace(path, text.encode())
    if pdf:
        replace(path.with_suffix(".pdf"), pdf_of(text))
    return path


def replace(path, content):
    """Whole or not at all."""
    new = path.with_name(f".{path.name}.tmp")
    new.write_bytes(content)
    new.replace(path)


def pdf_of(text):
    try:
        import weasyprint
    except ImportError:
        raise ImportError("a PDF needs weasyprint; install weasyprint") from None
    return weasyprint.HTML(string=text).write_pdf() + b"% the run, told by hpvi\n"  # by which the program knows it


def page(run):
    """The text of report.html of a Run. Runs that are equal have equal pages but for the line of seconds."""
    try:
        import jinja2
    except ImportError:
        raise ImportError("the report needs jinja2; install python3-jinja2") from None
    environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True)
    template = environment.from_string((pathlib.Path(__file__).with_name("report.html")).read_text(encoding="utf-8"))
    return template.render(tell=Teller(run), run=run, summary=run.summary, scene=run.scene or {})


class Table:
    def __init__(self, head=(), rows=(), title="", note=""):
        filled = [k for k in range(len(head)) if any(row[k] not in ("", "–", "…") for row in rows)]
        self.head, self.rows = [head[k] for k in filled], [[row[k] for k in filled] for row in rows]
        self.title, self.note = title, note


def picture(function, *arguments, **options):
    """What a function of hpvi.plot draws, its remarks as the caption, or why it does not."""
    try:
        text, remarks = plot.svg(function, *arguments, **options)
    except RunError as problem:
        return f"No picture: {problem}."
    caption = "; ".join(remarks)
    return dict(svg=base64.b64encode(text.encode()).decode(), caption=caption[:1].upper() + caption[1:])


class Teller:
    """Of one run all parts of its page."""

    def __init__(self, run):
        self.run, self.summary = run, run.summary
        self.last = self.summary.get("final") or {}
        bound = self.summary.get("error_bound") or {}
        self.cells, self.extent, self.no_cells = None, np.zeros(1), ""
        try:
            self.cells = run.grid(plot.PER_CELL)
            self.extent = np.ptp(self.cells["x"].reshape(-1, run.dimension), axis=0)
        except RunError as problem:
            self.no_cells = str(problem)
        self.size = float(self.extent.max())
        self.number = words.Numbers(bound.get("relative") or self.last.get("estimate_relative"), self.size)

    # -------------------------------------------------------------- the first lines

    def ending(self):
        """Whether all is well, and why the run is over: one sentence."""
        summary, status = self.summary, self.summary["status"]
        left = (f" What follows is what step {summary['steps']}, the last one that was finished, left: no result of this scene."
                if summary["steps"] else " No step was finished: there is no result.")
        if status != "done":
            goes_on = "; hpvi --resume goes on with it"
            why = {"failed": f"failed: {summary['message']}", "interrupted": f"was interrupted: {summary['message']}{goes_on}"}
            return False, f"This run {why.get(status, f'did not come to its end: it was killed, or the machine stopped{goes_on}')}.{left}"
        by = summary["stopped_by"] or ""
        met = {"Tolerance": "the tolerance of the scene is met", "round-off": "exact to round-off", "first step": "solved once, as Loading/Adapt = first step says"}
        if by in met:
            return True, f"Done: {met[by]}."
        tolerance = self.run.entries.get("Adaptivity/Tolerance", "0")
        if tolerance not in ("", "0", "0.0"):
            return False, f"The tolerance {tolerance} is not met: stopped by {by or 'its limits'} of Adaptivity. What follows is the result of the last step."
        return True, f"Done: stopped by {by or 'its limits'} of Adaptivity, and the scene asks for no tolerance."

    def error(self):
        """How large the error is, with the word for what is known of it."""
        summary, bound = self.summary, self.summary.get("error_bound")
        if bound:
            relative = bound.get("relative")
            size = f"{words.at_most(100 * relative)} % of the solution" if relative is not None else f"{words.at_most(bound['energy_norm'])}"
            text = "Error in the energy norm: " + words.error(bound["kind"], size, summary.get("coupling"), summary.get("zones_assumed"), summary.get("coupling_known"))
            return f"{text}; but the run contradicts it, see the warnings." if summary.get("contradiction") else f"{text}."
        for estimate, by in (((summary.get("error_estimate_equilibrated") or {}).get("relative"), "a stress in equilibrium"),
                             (self.last.get("estimate_relative"), "the indicator, which is no bound")):
            if estimate is not None:
                return f"Error in the energy norm: {words.error('estimate', f'{words.digits(100 * estimate, 2)} % of the solution')} by {by}."
        return ""

    # -------------------------------------------------------------- the answer

    def answer(self):
        summary, run, number = self.summary, self.run, self.number
        items = self.of_energy()
        if self.last.get("error_relative") is not None:
            items.append(("True error", f"{words.digits(100 * self.last['error_relative'], 3)} % in the energy norm, beside the solution that is known"))
        for name, contact in (summary.get("contact") or {}).items():
            items.append((f"Contact {name}", self.of_contact(name, contact)))
        largest = summary.get("largest_displacement")
        if largest:
            items.append(("Largest displacement", number(largest["value"], run.length_unit) + self.at(largest)))
        if summary.get("von_mises"):
            items.append(("Largest von Mises stress", self.of_stress(summary["von_mises"])))
        for name, plate in (summary.get("plates") or {}).items():
            rotation = plate["rotation"]  # in space a vector
            turned = number.vector(rotation, "rad", 1e-3) if isinstance(rotation, list) else f"{number(rotation, largest=1e-3)} rad"
            items.append((f"Plate {name}", f"moves by {number.vector(plate['displacement'], run.length_unit)} and turns by {turned} "
                                           f"about {number.place(plate['mean_point'])}"))
        for name, cut in (summary.get("pretensions") or {}).items():
            items.append((f"Pretension {name}", f"force {number(cut['force'], run.force_unit, cut['force_bound'])}{self.sure(cut['force_bound'])}, "
                                                f"shortened by {number(cut['shortening'], run.length_unit)}"))
        return items

    def of_energy(self):
        summary, items = self.summary, []
        bound = summary.get("error_bound") or {}
        if bound.get("energy"):
            low, high = bound["energy"]
            items.append(("Least energy", f"{words.interval((low + high) / 2, (high - low) / 2)} {self.run.moment_unit}".rstrip() + f" ({self.word()})"))
        if summary.get("no_error_bound"):
            earlier = summary.get("last_error_bound")
            then = f"; in step {earlier['step']} it was {words.at_most(100 * earlier['relative'])} % of the solution" if earlier and earlier.get("relative") else ""
            items.append(("No bound of the error", summary["no_error_bound"] + then))
        return items

    def word(self):
        kind = (self.summary.get("error_bound") or {}).get("kind")
        return {"energy": "guaranteed", "coupling": "bounded, if the coupling is as estimated", "zones": "if the zones are as assumed", "history": "bounded for the computed history"}.get(kind, "guaranteed")

    def sure(self, half):
        return f" ({self.word()})" if half is not None and math.isfinite(half) else ""

    def at(self, known, name="at"):
        return f" at {self.number.place(known[name])}" if known.get(name) else ""

    def row_of(self, name):
        """Of forces.csv the row of a contact."""
        forces = self.run.forces
        rows = np.flatnonzero((forces["name"] == name) & (forces["kind"] == "contact")) if forces else []
        return {column: values[rows[0]] for column, values in forces.items()} if len(rows) else {}

    def of_contact(self, name, contact):
        run, number, row = self.run, self.number, self.row_of(name)
        force = [value for value in contact["force"] if value is not None]
        largest = max([abs(value) for value in force] + [self.largest_force()], default=0)
        parts = []
        for what, column in (("normal force", "normal"), ("friction", "friction")):
            value, half = contact[f"{column}_resultant"], half_width(row.get(f"{column}_bound"))
            if isinstance(value, list):
                parts.append(f"{what} {number.vector(value, run.force_unit, largest)}")
            elif value is not None:
                parts.append(f"{what} {number(value, run.force_unit, half, largest)}{self.sure(half)}")
        if contact.get("through"):
            parts.append(f"it acts through {number.place(contact['through'])}")
        parts.append(self.of_pressure(name, contact))
        if (contact.get("largest_penetration") or 0) > words.ROUND_OFF * self.number.size:
            parts.append(f"penetration between points up to {words.digits(contact['largest_penetration'], 2)} {run.length_unit}".rstrip()
                         + self.at(contact, "largest_penetration_at"))
        if "zones" not in contact and contact.get("area"):
            unit = f" {run.length_unit}²" if run.length_unit else ""
            parts.append(f"open {number(contact['open_area'])}, slip {number(contact['slipping_area'])} of the area {number(contact['area'])}{unit}")
        return "; ".join(part for part in parts if part)

    def largest_force(self):
        forces = self.run.forces
        return max((float(np.nanmax(abs(values))) for name, values in forces.items() if name in ("Fx", "Fy", "Fz") and np.isfinite(values).any()), default=0.)

    def of_pressure(self, name, contact):
        """The largest; where it has no bound, the largest away from all such places."""
        run, number, peaks = self.run, self.number, contact.get("unbounded_pressure") or []
        if not peaks:
            value = contact.get("largest_pressure") or 0
            return f"pressure up to {number(value, run.stress_unit)}{self.at(contact, 'largest_pressure_at')}" if value > 0 else ""
        rows = next((rows for title, rows in results.contacts(run.contact).items() if title == name or name.endswith(f"({title})")), [])
        own = results.where(run.contact, rows)
        return self.of_peaks("pressure", peaks, [own[axis] for axis in "xyz" if axis in own], -own.get("normal_traction", np.zeros(0)))

    def of_stress(self, stress):
        peaks, cells = stress.get("unbounded") or [], self.cells
        if not peaks:
            return self.number(stress["largest"], self.run.stress_unit) + self.at(stress)
        points = (cells["x"].reshape(-1, self.run.dimension).T, von_mises(cells["stress"]).ravel()) if cells else ([], [])
        return self.of_peaks("it", peaks, *points)

    def of_peaks(self, name, peaks, x, values):
        """x: where values are known, an array for each coordinate."""
        number, stress, length = self.number, self.run.stress_unit, self.run.length_unit
        away = beyond(np.stack(x, axis=1) if len(x) else np.zeros((0, self.run.dimension)), values, peaks)
        some = peaks[:6]
        places = ", ".join(number.place(peak["at"]) for peak in some) + (f" and {len(peaks) - len(some)} places more" if len(peaks) > len(some) else "")
        reach = f"{words.digits(max(peak['beyond'] for peak in peaks), 2)} {length}".rstrip()
        them = "there" if len(peaks) == 1 else "each of them"
        far = f"; beyond {reach} from {them} it is up to {number(away[0], stress)} at {number.place(away[1])}" if away else ""
        carry = [f"the last {words.digits(peak['within'], 2)} {length}".rstrip() + f" carry {words.digits(peak['force'], 2)} {self.run.force_unit}".rstrip()
                 for peak in some if peak.get("force") is not None]
        return f"{name} is unbounded at {places}, larger in smaller cells" + (f" ({', '.join(carry)})" if carry else "") + far

    def zones(self):
        rows = []
        for name, contact in (self.summary.get("contact") or {}).items():
            for zone in contact.get("zones") or []:
                rows.append([name, zone["state"], self.number.place(zone["from"]), self.number.place(zone["to"]), self.number(zone["length"])])
        most = 24
        note = [[f"{len(rows) - most} zones more", "", "", "", ""]] if len(rows) > most else []
        return Table(["contact", "state", "from", "to", plot.label("length", self.run.length_unit, "length")], rows[:most] + note, "Zones of contact")

    def probes(self):
        found, run = self.run.probes(), self.run
        names = [end for end in results.PROBED if any(end in own for own in found.values())]
        units = {end: run.length_unit if end[0] == "u" else run.stress_unit for end in names}
        size = {kind: max((abs(own[end][0]) for own in found.values() for end in own if (end[0] == "u") == kind), default=0) for kind in (True, False)}
        rows = [[name] + [self.number(own[end][0], half=own[end][1], largest=size[end[0] == "u"]) if end in own else "" for end in names]
                for name, own in found.items()]
        head = ["probe"] + [f"{'von Mises' if end == 'mises' else end}" + bracket(units[end]) for end in names]
        return Table(head, rows, "Probes")

    # -------------------------------------------------------------- pictures

    def field(self):
        if self.cells is None:
            return f"No picture of stress and displacement: {self.no_cells}."
        return picture(plot.body, self.run, size=(4.6, self.height()))

    def height(self):
        """Of a picture of the body with its bar and words [inches]."""
        if self.cells is None or self.run.dimension == 3:
            return 4.
        return float(min(4.8, 1.6 + 4 * self.extent[1] / self.extent[0]))

    def scene(self):
        if not self.run.scene:
            return "No picture of the scene: there is no scene.json; hpvi --report writes it."
        return picture(plot.scene, self.run.scene, is_brief=True, size=(4.6, min(5., 1.4 + self.height())))

    def charts(self):
        run, charts = self.run, []
        if self.summary.get("contact"):
            charts += self.of_contacts()
        if run.loading and len(run.loading["step"]) > 1:
            charts += self.of_history()
        charts += [picture(plot.probe, run, name) for name in run.probe_lines]
        if len(run.steps.get("step", [])) > 1 and plot.error_columns(run):
            charts.append(picture(plot.convergence, run))
        if run.dimension == 2 and self.cells is not None:
            charts.append(picture(plot.mesh, run, size=(4.6, self.height())))
        return charts

    def of_contacts(self):
        run = self.run
        if not run.contact:
            return ["No chart of contact: there is no contact-NN.csv of the last step; set Output/Contact tables = true to have it."]
        if run.dimension == 3:
            charts = [picture(plot.surface, run, name=name, what=what) for name in list(results.contacts(run.contact))[:2] for what in ("state", "pressure")]
        else:
            charts = [picture(plot.contact, run, line) for line in run.lines[:MOST_CONTACTS]]
        n = len(results.contacts(run.contact)) - (2 if run.dimension == 3 else MOST_CONTACTS)
        return charts + ([f"contact-NN.csv has {n} contacts more."] if n > 0 else [])

    def of_history(self):
        run, charts = self.run, []
        charts += [picture(plot.loop, run, *where) for where in plot.loops(run)[:2]]
        if run.dimension == 2:
            first = {line.name: line for line in run.lines_of(run.loading["step"][0])}
            charts += [picture(plot.load_steps, run, line.name, what) for line in run.lines[:2]
                       for what, column in (("pressure", "normal_traction"), ("friction", "tangential_traction"))
                       if first.get(line.name, line)[column].any() and line[column].any()]
        if run.dimension == 2 and run.contact_history:
            for name, rows in list(results.contacts(run.contact_history).items())[:2]:
                for columns, kind in (({"slip_path": "path", "slip_range": "range"}, "slip"), ({"wear_depth": "depth"}, "wear depth")):
                    values = [run.contact_history[column][rows] for column in columns]
                    if any(np.nan_to_num(np.asarray(one, float)).any() for one in values if one.dtype.kind in "fi"):
                        charts.append(picture(plot.history, run, name, columns, plot.label(kind, run.length_unit, "length")))
        if run.cycles and len(run.cycles["cycle"]) > 1:
            charts.append(picture(plot.cycles, run))
        return charts + [picture(plot.energies, run)]

    # -------------------------------------------------------------- tables

    def forces(self):
        """A row for each boundary, part and pair; round-off is 0, for it is another on each machine."""
        forces, run = self.run.forces, self.run
        columns = [name for name in forces if f"{name}_bound" in forces]
        size = {name: max([self.largest_force() * (self.size if name.startswith("M") else 1)] + [np.nanmax(abs(forces[one])) for one in columns if one.startswith("M") == name.startswith("M") and np.isfinite(forces[one]).any()])
                for name in columns}
        rows = [[str(forces["name"][k]), str(forces["kind"][k])]
                + ["" if math.isnan(forces[name][k]) else self.number(float(forces[name][k]), half=half_width(forces[f"{name}_bound"][k]), largest=size[name]) for name in columns]
                for k in range(len(forces.get("name", [])))]
        note = f"Forces{bracket(run.force_unit)} and moments{bracket(run.moment_unit)} on the body" + (f"; ±: intervals, {self.word()}." if "±" in str(rows) else ".")
        if self.summary.get("no_intervals"):
            note += f" Without an interval: {self.summary['no_intervals']}."
        return Table(["boundary", "kind"] + columns, rows, note=note)

    def balance(self):
        summary, lines = self.summary, []
        balance = summary.get("balance")
        if balance:
            lines.append(f"Balance: forces to {words.digits(balance['force'], 2)}, moments to {words.digits(balance['moment'], 2)} of their absolute sums.")
        loading = summary.get("loading")
        if loading:
            known = {name: loading[name] for name in ("work", "stored_energy", "dissipated_energy", "released_energy", "unbalanced_energy")}
            largest = max(abs(value) for value in known.values() if value is not None)
            lines.append(f"Load history: {loading['finished']} of {loading['load_steps']} load steps, to t = {words.digits(loading['t'], 4)}; energies"
                         f"{bracket(self.run.moment_unit)}: " + ", ".join(f"{name.split('_')[0]} {self.number(value, largest=largest)}" for name, value in known.items()) + ".")
        return lines + self.largest_of_history()

    def largest_of_history(self):
        found = []
        for name, what, unit in (("pressure", "pressure", self.run.stress_unit), ("von_mises", "von Mises stress", self.run.stress_unit),
                                 ("opening", "opening", self.run.length_unit)):
            one = (self.summary.get("history_largest") or {}).get(name)
            if one:
                where = f" of {one['boundary']}" if one.get("boundary") else ""
                found.append(f"{what} {self.number(one['value'], unit)}{self.at(one)}{where} in load step {one['load_step']}")
        return [f"Largest at the ends of load steps: {', '.join(found)}."] if found else []

    def steps(self):
        table = self.run.steps
        n = len(table.get("step", []))
        shown = list(range(n)) if n <= FIRST_STEPS + LAST_STEPS + 1 else [*range(FIRST_STEPS), None, *range(n - LAST_STEPS, n)]
        columns = [column for column in STEPS if column[0] in table]
        rows = [["…" if k is None else words.digits(float(table[name][k]), digits) for name, _, digits in columns] for k in shown]
        return Table([head for _, head, _ in columns], rows, note=f"convergence.csv has all {n} steps." if None in shown else "")

    def times(self):
        """All that differs between equal runs."""
        stages = {name: seconds for name, seconds in (self.summary.get("seconds") or {}).items() if name != "report"}
        memory = self.last.get("peak_memory")
        return (f"Seconds: {words.digits(sum(stages.values()), 3)} in all, " + ", ".join(f"{name} {words.digits(seconds, 2)}" for name, seconds in stages.items())
                + (f"; memory {memory / 1e6:.0f} MB" if memory else "") + ".")

    def listing(self):
        """Of entries those that are not at their defaults, where that is known."""
        changed = (self.run.scene or {}).get("changed")
        return "\n".join(f"{path} = {value}" for path, value in self.run.entries.items() if changed is None or path in changed)


def half_width(half):
    """Of a table; None where there is none."""
    return None if half is None or not math.isfinite(half) else float(half)


def bracket(unit):
    return f" [{unit}]" if unit else ""


def away_from(peaks, x):
    """Which places (n, dim) are farther from each of the peaks than where it stands out?"""
    return np.all([np.linalg.norm(x - np.array(peak["at"][:x.shape[1]]), axis=1) > peak["beyond"] for peak in peaks], axis=0)


def beyond(x, values, peaks):
    """The largest value and its place away from all peaks; None where there is none. A peak knows the largest away from itself."""
    known = [(peak["largest"], np.array(peak["largest_at"])) for peak in peaks if peak.get("largest_at")]
    known = [one for one in known if away_from(peaks, one[1][None, :])[0]]
    if known:
        return max(known, key=lambda one: one[0])
    kept = away_from(peaks, x)
    if not kept.any():
        return None
    k = np.flatnonzero(kept)[np.argmax(values[kept])]
    return float(values[k]), x[k]
