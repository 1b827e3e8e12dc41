#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tells each scene of prm/, and scenes that the fuzzer makes of them, in other ways that must agree: moved and in other units, with
sections and entries in another order, with pairs named from the other side, by other solvers, as a history of one load step, on the
other path. Here are bodies, pairs, curves, mesh files, probes, springs, plates, bodies of revolution and space, which metamorphic.cc's
own scenes have not; tables are compared column by column, by the units that doc/manual/columns.md gives them.

tellings.py HPVI --server LIBRARY [--seconds SECONDS] [--seed SEED] [--spoilt N] [--quick]

--quick: every other scene, in other units alone.

Each entry that the program has must have its unit here, or this fails: a new one is told in other units from its first day on.
"""
import argparse
import math
import pathlib
import random
import re
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "fuzz"))
import findings  # noqa: E402
import fuzz  # noqa: E402
import mutator  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Powers of stress and length, "point" for places, None for what no unit changes; by section and entry, else by entry.
UNITS = {
    "Lower corner": "point", "Upper corner": "point", "Corners": "point", "Centre": "point", "Graded towards": "point", "At": "point",
    "From": "point", "To": "point", "Through": "point", "Radii": (0, 1), "Radius": (0, 1), "Size": (0, 1), "Mesh size": (0, 1), "Young's modulus": (1, 0), "Young's moduli": (1, 0),
    "Shear moduli": (1, 0), "Density": (1, -1), "Body force/Expression": (1, -1), "Displacement": (0, 1), "Traction": (1, 0), "Pressure": (1, 0),
    "Shear": (1, 0), "Spring": (1, -1), "Force": (1, 1), "Moment": (1, 2), "Gap": (0, 1), "Closed within": (0, 1), "Friction bound": (1, 0), "Wear coefficient": (-1, 0),
    "Exact solution/Transition": "x", "Exact solution/Length": (0, 1), "Exact solution/Stick length": (0, 1)}
WITHOUT = """Title Dimension Units/Length Units/Stress Shape Angles Angle Part File Subdivisions Grading=levels Where Poisson's=ratio Poisson's=ratios
Initial=strain Thermal=expansion Plane Thickness Elasticity Axes Gravity Temperature/Expression Exact=solution/Solution Symmetry Rigid Rotation Contact
Contact=direction Friction=coefficient Friction=law Curve On Loading/Steps Adapt Until=steady Maximum=cycles Output/Steps VTU Mesh=picture Contact=tables Reference=solution Bound
Bound=on=distorted=cells Length=unit Mesh=size=from=curvature Curves Surfaces Material Between Law Slave Points Start=degree""".replace("=", "\0").split()
UNITS.update({entry.replace("\0", " "): None for entry in WITHOUT})
# Entries of geometries have defaults that mean nothing to other shapes, and may not be named there.
OF_SHAPES = {"box": ["Lower corner", "Upper corner"], "quadrilateral": ["Corners"], "ring sector": ["Centre", "Radii", "Angles"],
             "half disc": ["Centre", "Radius", "Angle"], "plate with hole": ["Lower corner", "Upper corner", "Centre", "Radius", "Part"], "file": ["File", "Length unit", "Mesh size", "Mesh size from curvature", "Surfaces"]}
SETTINGS = ("Adaptivity/", "Solver/", "Output/", "Error/")  # no data of the problem
NUMBER = re.compile(r"-?\d+\.?\d*(?:[eE][-+]?\d+)?")
EXPRESSIONS = ("Displacement Traction Shear Spring Force Moment Rotation Gap Expression Gravity Where").split() + [
    "Boundary/Pressure", "Friction bound", "Friction coefficient", "Initial strain"]
# Columns that units do not scale or that count how a result was found.
COUNTS = ("elements", "dofs", "dofs_free", "multipliers", "p_min", "p_max")
ENERGIES = ("lagrangian", "energy", "energy_norm", "estimate", "error_bound", "energy_low", "energy_high", "normal_resultant", "friction_resultant")


def unit_of(path):
    kind = mutator.kind(path)
    for name in (kind, kind.rpartition("/")[2]):
        if name in UNITS:
            return UNITS[name]
    if kind.startswith(SETTINGS):
        return None
    raise SystemExit(f"tellings.py: {path} is new; say in UNITS what another unit of stress or length makes of it")


def column_units():
    """Power of s and of l by dimension d, as doc/manual/columns.md has them."""
    units = {}
    for name, unit in re.findall(r"^\| `(\w+)` \| ([^|]*) \|", (ROOT / "doc/manual/columns.md").read_text(), re.M):
        units.setdefault(name, unit.strip())
    return units


class Telling:
    """x' = length (x + shift), stresses times stress; powers of two, so that no digit is lost but by the shift."""

    def __init__(self, stress=1., length=1., shift=(0., 0., 0.), is_revolved=False):
        self.stress, self.length, self.shift, self.is_revolved = stress, length, shift, is_revolved

    def factor(self, powers):
        return self.stress**powers[0] * self.length**powers[1]

    def place(self, text):
        """Points "x, y; x, y"."""
        return "; ".join(", ".join(repr(self.length * (float(number) + self.shift[d])) for d, number in enumerate(point.split(",")))
                         for point in text.split(";") if point.strip())

    def function(self, text, factor):
        """Each component that is an expression, of x, y, z, moduli and pressures."""
        def component(part):
            part = part.strip()
            if part in ("", "free", "exact"):
                return part
            if NUMBER.fullmatch(part):
                return repr(float(part) * factor)
            for d, letter in enumerate("xyz"):
                part = re.sub(rf"\b{letter}\b", f"({'XYZ'[d]}*{1 / self.length!r} - ({self.shift[d]!r}))" if self.shift[d] else f"({'XYZ'[d]}*{1 / self.length!r})", part)
            part = re.sub(r"\b(E|mu|p)\b", rf"(\1*{1 / self.stress!r})", part)
            part = re.sub(r"\b[XYZ]\b", lambda letter: letter[0].lower(), part)
            return part if factor == 1 else f"{factor!r}*({part})"
        return "; ".join(map(component, text.split(";")))

    def value(self, path, text):
        unit, kind = unit_of(path), mutator.kind(path)
        if not text or (unit is None and kind.rpartition("/")[2] not in EXPRESSIONS):
            return text
        if unit == "point":
            return self.place(text)
        if unit == "x":
            return repr(self.length * (float(text) + self.shift[0]))
        factor = 1. if unit is None else self.factor(unit)
        if self.is_revolved and kind.endswith("/Force"):
            factor *= self.length  # of the full turn
        if kind in EXPRESSIONS or kind.rpartition("/")[2] in EXPRESSIONS:
            return self.function(text, factor)
        return NUMBER.sub(lambda number: repr(float(number[0]) * factor), text)

    def mesh(self, text):
        """The nodes of a file of Gmsh."""
        lines, first = text.split("\n"), 0
        size = 3 if re.search(r"^4", lines[1]) else 4
        inside = False
        for i, line in enumerate(lines):
            if line.startswith("$"):
                inside, first = line == "$Nodes", i
            elif inside and i > first + 1 and len(words := line.split()) == size:
                x = [repr(self.length * (float(word) + self.shift[d])) for d, word in enumerate(words[-3:])]
                lines[i] = " ".join(words[:-3] + x)
        return "\n".join(lines)

    def scale(self, unit, dimension, is_revolved):
        """Of a column with this unit; around an axis, forces and energies have a length more, and norms its root."""
        powers = {"s l^d": (1, dimension, 1), "(s l^d)^(1/2)": (0.5, dimension / 2, 0.5), "s l^(d/2)": (1, dimension / 2, 0.5),
                  "s l^(d-1)": (1, dimension - 1, 1), "s": (1, 0, 0), "l": (0, 1, 0), "-": (0, 0, 0)}.get(unit)
        return self.stress**powers[0] * self.length**(powers[1] + is_revolved * powers[2]) if powers else None


def written(settings, order=None):
    """A file of these pairs of path and value; with random sections and entries, but materials and bodies as they come."""
    sections = {}
    for path, value in settings:
        section, _, entry = path.rpartition("/")
        sections.setdefault(section, []).append((entry, value))
    names = list(sections)
    if order:
        keep = [name for name in names if name.split(" ")[0] in ("", "Material", "Body", "Contact", "Probe", "Pretension")]
        others = [name for name in names if name not in keep]
        order.shuffle(others)
        names = keep + others
        for name in names:
            order.shuffle(sections[name])
    text = ""
    for name in names:
        lines = [f"set {entry} = {value}" for entry, value in sections[name]]
        text += "\n".join([f"subsection {name}", *lines, "end", ""] if name else [*lines, ""])
    return text


class Scenes:
    """Runs scenes that are told in several ways, and compares what they say."""

    def __init__(self, program, seed):
        self.program, self.random, self.units = program, random.Random(seed), column_units()
        self.passed, self.refused, self.failed = 0, 0, 0

    def tables(self, settings, files, order=None):
        """Status and rows of convergence.csv and forces.csv."""
        run, results = self.program.run({**files, "scene.prm": written(settings, order).encode()}, ["scene.prm"])
        if run.status != 0:
            return run.status or run.signal or "no end", run.errors.decode(errors="replace"), []
        forces = results / "forces.csv"
        return 0, findings.table(results / "convergence.csv"), findings.table(forces) if forces.exists() else []

    def complain(self, name, telling, flaws, settings, other, files):
        self.failed += 1
        directory = pathlib.Path("output/metamorphic").resolve() / f"{name}-{telling}".replace(" ", "-")
        for which, pairs in (("one", settings), ("other", other)):
            (directory / which).mkdir(parents=True, exist_ok=True)
            (directory / which / "scene.prm").write_text(written(pairs))
            for file, data in files.items():
                (directory / which / file).parent.mkdir(parents=True, exist_ok=True)
                (directory / which / file).write_bytes(data)
        print(f"FAILED: {name}, {telling}: {'; '.join(flaws[:3])}: {directory}", file=sys.stderr, flush=True)

    def compare(self, name, telling, one, other, flaws_of, pairs, files):
        if one[0] != other[0]:
            flaws = [f"ends with status {one[0]} and {other[0]}: {one[1] if one[0] else ''}{other[1] if other[0] else ''}"]
        elif one[0] != 0:
            self.refused += 1
            return
        else:
            flaws = flaws_of(one, other)
        if flaws:
            self.complain(name, telling, flaws, *pairs, files)
        else:
            self.passed += 1

    # ------------------------------------------------------------ claims

    def same(self, telling, dimension, is_revolved, tolerance, round_off):
        """All columns with a unit that is known, beside the largest of its kind; forces also beside round-off."""
        def flaws(one, other):
            result = [] if len(one[1]) == len(other[1]) else ["another number of steps"]
            norm = max((findings.number(row, "energy_norm") for row in one[1]), default=0.)
            for mine, theirs in zip(one[1], other[1]):
                if any(mine[c] != theirs[c] for c in COUNTS):
                    return result + ["another mesh"]
                for column in mine:
                    unit = self.units.get(column) or self.units.get("NAME" + column[column.rfind("_"):], "")
                    scale = telling.scale(unit, dimension, is_revolved)
                    if scale is None or column.startswith(("seconds", "qp_", "newton_", "coulomb_", "bound_imbalance", "effectivity", "error_", "condition")) and column not in ("error_bound", "error_energy"):
                        continue
                    if (mine[column] == "") != (theirs[column] == ""):
                        result.append(f"{column} of one alone")
                    elif mine[column] and (column in ENERGIES or column not in self.units):  # of a probe
                        size = max(abs(float(mine[column])), norm**2 if unit == "s l^d" else norm)
                        # Under Coulomb's law round-off decides at which points the correction of a bound is sought (doc/reliability.md).
                        near = 1e-6 if column == "error_bound" and mine.get("coupling") else tolerance
                        if abs(float(theirs[column]) / scale - float(mine[column])) > near * size:
                            result.append(f"{column}: {mine[column]} and {float(theirs[column]) / scale!r}")
            return result + self.forces(one[2], other[2], telling.scale("s l^(d-1)", dimension, is_revolved), tolerance, round_off)
        return flaws

    @staticmethod
    def forces(one, other, scale, tolerance, round_off):
        key = lambda row: (row["step"], row["name"], row["kind"])  # noqa: E731
        theirs = {key(row): row for row in other}
        if set(map(key, one)) != set(theirs):
            return ["other rows of forces"]
        columns = ("Fx", "Fy", "Fz", "normal", "friction")
        size = max((abs(findings.number(row, c)) for row in one for c in columns if row.get(c)), default=0.)
        return [f"{c} of {row['name']}: {row[c]} and {theirs[key(row)][c]}" for row in one for c in columns
                if row.get(c) and abs(findings.number(theirs[key(row)], c) / scale - float(row[c])) > 100 * tolerance * size + round_off]

    @staticmethod
    def meeting(one, other):
        """Intervals of energy of the two; where only upper ends are known, they lie above the lower ends."""
        def ends(rows, column, best):
            return best((float(row[column]) for row in rows if row.get(column)), default=math.nan)
        norm = max((findings.number(row, "energy_norm") for row in one[1] + other[1]), default=0.)
        for a, b in ((one, other), (other, one)):
            low, high = ends(a[1], "energy_low", max), ends(b[1], "energy_high", min)
            if low > high + 1e-9 * (norm**2 + abs(low)):
                return [f"intervals of energy do not meet: above {low!r} and below {high!r}"]
        return []

    def near(self, tolerance):
        def flaws(one, other):
            result = self.meeting(one, other)
            for mine, theirs in zip(one[1], other[1]):
                if mine["elements"] != theirs["elements"]:
                    break
                norm = findings.number(mine, "energy_norm")
                if abs(float(theirs["lagrangian"]) - float(mine["lagrangian"])) > tolerance * norm**2:
                    result.append(f"lagrangian: {mine['lagrangian']} and {theirs['lagrangian']}")
            return result
        return flaws

    # ------------------------------------------------------------ tellings

    def tell(self, name, settings, files, quick):
        """One scene in all ways."""
        def get(path):
            return dict(settings).get(path, "")

        def given(**values):
            return [(path, values.get(path.replace("/", "__").replace(" ", "_"), value)) for path, value in settings]

        dimension = int(get("Dimension"))
        if dimension == 3:  # where Newton's method stops by itself depends on the last bits of the indicator
            settings = given(Solver__Primal_tolerance=repr(min(float(get("Solver/Primal tolerance")) or 1., 1e-10)))
        is_revolved = any(value == "axisymmetric" for path, value in settings if path.endswith("/Plane"))
        near = 1e-9 if dimension == 2 else 1e-7  # what iterations leave
        has_history, has_exact = bool(get("Loading/Steps")), get("Exact solution/Solution") not in ("", "none")
        has_coulomb = any(value not in ("", "0") for path, value in settings if path.endswith("/Friction coefficient"))
        numbers = {entry: [abs(float(number)) for path, value in settings if path.endswith(entry) for number in NUMBER.findall(value)]
                   for entry in ("/Young's modulus", "/Young's moduli", "corner", "/Corners", "/Radii", "/Radius")}
        round_off = 1e-12 * math.prod(max([1., *values]) for values in numbers.values())
        one = self.tables(settings, files)
        if one[0] != 0:
            if not re.search("-[0-9]+$", name):  # shipped, and refused as the program itself prints it
                self.complain(name, "printed", [one[1]], settings, settings, files)
            return False

        def check(telling, other, flaws_of, other_files=files, order=None, first=(settings, one)):
            self.compare(name, telling, first[1], self.tables(other, other_files, order), flaws_of, (first[0], other), other_files)

        units = Telling(2.**self.random.randint(-20, 20), 2.**self.random.randint(-10, 10), is_revolved=is_revolved)
        self.check_frame(check, "other units", units, settings, files, self.same(units, dimension, is_revolved, near, round_off))
        if quick:
            return True
        if not has_exact:
            far = Telling(1., 1., (0. if is_revolved else 2., 1., 4. if dimension == 3 else 0.))
            self.check_frame(check, "elsewhere", far, settings, files, self.same(far, dimension, is_revolved, 10 * near, round_off))
        still = Telling()
        check("another order", settings, self.same(still, dimension, is_revolved, near, round_off), order=random.Random(self.random.random()))
        if not has_history:
            check("a history of one load step", given(Loading__Steps="1"), self.near(1e-7))
        if dimension == 3:
            check("another linear solver", given(Solver__Linear="direct", Solver__Primal_tolerance="1e-9"), self.near(1e-4))
        elif not name.startswith("strut"):  # which has two equilibria, and is about them
            solver = {"Solver__Coulomb_solver": "fixed point"} if has_coulomb else {"Solver__QP_solver": "mprgp"}
            check("another solver", given(**solver, Solver__QP_warm_start="false"), self.near(1e-7))
            self.take_other_path(check, settings, given, has_coulomb or has_history)
        self.exchange_sides(check, settings, files, dimension, is_revolved)
        return True

    @staticmethod
    def check_frame(check, telling, frame, settings, files, flaws_of):
        if not all(data.startswith(b"$MeshFormat") for data in files.values()):  # nobody moves what CAD has drawn
            return
        check(telling, [(path, frame.value(path, value)) for path, value in settings], flaws_of,
              {file: frame.mesh(data.decode()).encode() for file, data in files.items()})

    def take_other_path(self, check, settings, given, has_no_interval):
        """With a method that both have; the primal path refuses more."""
        both = dict(Adaptivity__Method="hup2", Adaptivity__Start_degree="0", Solver__Normal_contact="multiplier", Adaptivity__Maximum_steps="2")
        reduced, primal = given(**both, Solver__Path="reduced"), given(**both, Solver__Path="primal")
        other, one = self.tables(primal, {}), self.tables(reduced, {})
        if one[0] == 0 and other[0] == 0:
            check("on the other path", primal, self.near(1e-1 if has_no_interval else 1e-2), first=(reduced, one))
        else:
            self.refused += 1

    def exchange_sides(self, check, settings, files, dimension, is_revolved):
        """Of each pair, whose slave stays: then all but the rows of forces has the same numbers."""
        if not any(path.endswith("/Between") for path, _ in settings):
            return
        slaves = {path.rpartition("/")[0]: value.split(",")[0].strip() for path, value in settings if path.endswith("/Between")}
        one = [(path, slaves[path.rpartition("/")[0]] if path.endswith("/Slave") else value) for path, value in settings]
        other = [(path, ", ".join(reversed([side.strip() for side in value.split(",")])) if path.endswith("/Between") else value) for path, value in one]
        check("pairs from the other side", other, self.near(1e-8), first=(one, self.tables(one, files)))


def means_something(path, value, settings):
    """May the entry be named?"""
    section, _, entry = path.rpartition("/")
    shape = settings.get(f"{section}/Shape")
    if shape in OF_SHAPES and any(entry in names for names in OF_SHAPES.values()):
        return entry in OF_SHAPES[shape] and value != ""
    if shape == "file" and entry == "Subdivisions":
        return False
    if settings.get(f"{section}/Elasticity") == "orthotropic" and entry in ("Young's modulus", "Poisson's ratio"):
        return False
    return value != "" and not (section == "Exact solution" and settings["Exact solution/Solution"] == "none")


def settings_of(program, files, arguments):
    """All entries of a scene with their values, as the program prints them; none where it is refused."""
    run, _ = program.run(files, [a for a in arguments if a not in ("--validate", "--picture", "--inf-sup")] + ["--print-parameters"])
    printed = (program.scratch / "stdout").read_text(errors="replace") if run.status == 0 else ""
    settings = mutator.settings(printed)
    return [(path, value) for path, value in settings if means_something(path, value, dict(settings))]


def bases(library, scenes, seed, n_spoilt):
    """Name, files and arguments: shipped scenes, or spoilt ones, those of them that are refused or fail left out."""
    for scene in dict.fromkeys(scenes if n_spoilt == 0 else []):
        is_in_space = "Dimension = 3" in library.texts[scene]
        files = {"scene.prm": library.texts[scene].encode()}
        for name in re.findall(r"^\s*set File\s*=\s*(\S+)", library.texts[scene], re.M):
            files[name] = (scene.parent / name).read_bytes()
        limits = {**(mutator.LIMITS_IN_SPACE if is_in_space else mutator.LIMITS), **(mutator.LIMITS_OF_HISTORIES if "subsection Loading" in library.texts[scene] else {})}
        yield scene.stem, files, ["scene.prm", *sum((["--set", f"{path}={value}"] for path, value in limits.items()), [])]
    for k in range(n_spoilt):
        spoilt = mutator.Mutator(library, f"{seed}/{k}").make(scenes)
        yield f"{spoilt.origin}-{k}", spoilt.files, spoilt.arguments


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--server", type=lambda name: pathlib.Path(name).resolve())
    parser.add_argument("--seconds", type=float, default=1e9)
    parser.add_argument("--seed", default="1")
    parser.add_argument("--spoilt", type=int, default=0)
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    scenes = mutator.scenes_of(ROOT)
    library = mutator.Vocabulary(options.program, scenes)
    for entry in library.entries:
        unit_of(entry)
    begin, count = time.monotonic(), 0
    with tempfile.TemporaryDirectory() as scratch:
        program = fuzz.Program(options.program.resolve(), options.server, pathlib.Path(scratch))
        told = Scenes(program, options.seed)
        for name, files, arguments in bases(library, scenes[::2] if options.quick else scenes, options.seed, options.spoilt):
            if time.monotonic() - begin > options.seconds:
                break
            settings = [(path, "0" if path == "Adaptivity/Maximum seconds" else value) for path, value in settings_of(program, files, arguments)]
            if settings:
                count += told.tell(name, settings, {file: data for file, data in files.items() if file != "scene.prm"}, options.quick)
        program.stop()
    print(f"{count} scenes in {time.monotonic() - begin:.0f} s: {told.passed} tellings agree, {told.failed} do not, {told.refused} refused alike")
    return 1 if told.failed or not told.passed else 0


if __name__ == "__main__":
    sys.exit(main())
