#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What users see of the program, kept before a change that shall not change it, and compared byte by byte after it.

freeze.py keep HPVI DIR [--run RESULTS]...   write it into DIR, which is new or was written by this; RESULTS are those of an older version
freeze.py compare HPVI DIR                   tell where HPVI differs from it: file, line, old, new; status 1 if anywhere
Both: [-j N] runs at once, 2 as a rule; [--only REGEX] of their names, of keep those that are kept anew.

Kept are: three steps of each scene of prm/, some histories of loads, runs on two processes, a sweep and some commands, what --validate,
--print-parameters and --picture say of each scene, each refusal of tests/bad_input, and result directories to go on from. Of all runs
the rows and messages, tables, summaries, pictures and reports; of VTU files each array by its values. Times, memory, versions, hosts
and absolute paths are masked. state.dat itself is not compared: what goes on from it is.
"""
import argparse
import base64
import concurrent.futures
import csv
import difflib
import hashlib
import io
import json
import os
import pathlib
import re
import shutil
import socket
import struct
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as ElementTree
import zlib

ROOT = pathlib.Path(__file__).resolve().parent.parent
MASK = "-"
MASKED_COLUMNS = ("seconds", "peak_memory")
MOST_DIFFERENCES = 6  # of a file that are shown
STEPS = ("Adaptivity/Maximum steps=3",)
# Scenes of which three steps take long.
LESS = {"fretting-dome": ("Loading/Steps=3", "Adaptivity/Maximum unknowns=5000"), "lap-joint": ("Loading/Steps=10",),
        "fretting-pad": ("Loading/Steps=4", "Loading/Maximum cycles=2"), "rotating-load": ("Loading/Steps=4", "Loading/Maximum cycles=2"),
        "block-space": ("Adaptivity/Maximum unknowns=8000",), "dome": ("Adaptivity/Maximum unknowns=8000",),
        "clamped-plates": ("Adaptivity/Maximum unknowns=8000",), "spheres": ("Adaptivity/Maximum unknowns=8000",),
        "fretting-pad-space": ("Loading/Steps=3", "Adaptivity/Maximum unknowns=3000"),
        "foot": ("Adaptivity/Maximum unknowns=8000",), "floor-slab": ("Adaptivity/Maximum unknowns=4000",), "growth-rings": ("Adaptivity/Maximum unknowns=8000",)}
# Name, options, scene, settings: what no scene of prm/ asks for by itself.
RUNS = (
    ("history-tresca", (), "fretting", ("Loading/Steps=4", "Boundary bottom/Friction coefficient=", "Boundary bottom/Friction bound=2",
                                        "Adaptivity/Tolerance=0.05")),
    ("history-adapted", (), "lap-joint", ("Loading/Steps=3", "Loading/Adapt=every step", "Adaptivity/Maximum steps=2")),
    ("history-primal", (), "fretting", ("Loading/Steps=3", "Solver/Path=primal", "Adaptivity/Method=hap2", "Adaptivity/Start degree=2",
                                        "Boundary bottom/Contact=bilateral", "Boundary bottom/Friction coefficient=",
                                        "Boundary bottom/Friction bound=2", "Adaptivity/Maximum steps=2")),
    ("primal", (), "han-6-12", (*STEPS, "Solver/Path=primal", "Adaptivity/Method=hap2", "Adaptivity/Start degree=2")),
    ("amg", (), "slab", ("Adaptivity/Maximum steps=2", "Solver/Linear=amg")),
    ("multigrid", (), "slab", ("Adaptivity/Maximum steps=2", "Solver/Linear=multigrid")),
    ("mprgp", (), "han-6-12", (*STEPS, "Solver/QP solver=mprgp", "Solver/Condition number=true")),
    ("nodes", (), "han-6-12-unilateral", (*STEPS, "Solver/Normal contact=nodes")),
    ("fixed-point", (), "ssnv128", (*STEPS, "Solver/Coulomb solver=fixed point")),
    ("steered", (), "han-6-12", (*STEPS, "Adaptivity/Indicator=bound", "Output/Steps=last")),
    ("late-bound", (), "bracket", (*STEPS, "Error/Bound=last step")),
    ("reference", (), "han-6-13", (*STEPS, "Output/Reference solution=true")),
    ("sweep", ("--sweep", "Boundary bottom/Friction bound=1, 4.5", "--sweep", "Adaptivity/Method=hpa2 | hup3"), "han-6-12",
     ("Adaptivity/Maximum steps=2",)),
    ("inf-sup", ("--inf-sup",), "han-6-12", STEPS))
PROCESSES = (("slab", ("Adaptivity/Maximum steps=2",)), ("han-6-12", (*STEPS, "Adaptivity/Method=hap2")),
             ("fretting-dome", ("Loading/Steps=2", "Adaptivity/Maximum unknowns=3000")))
GO_ON = (("han-6-12", ()), ("hertz", ()), ("blocks", ()), ("slab", ()), ("fretting-dome", LESS["fretting-dome"]))
COMMANDS = (("help", ("--help",)), ("parameters", ("--print-parameters",)), ("nothing", ()), ("unknown", ("--unknown",)))


# --- what is no part of a result

def masked(text, paths):
    for path, name in paths.items():
        text = text.replace(path, name)
    text = re.sub(r"hpvi \d+\.\d+\.\d+( \(\w+ build\), deal\.II [\d.]+)?", "hpvi " + MASK, text)
    return text.replace(socket.gethostname(), "HOST")


def rows(text):
    """stdout without seconds, which are a column of steps and of a sweep, whose scenes end in any order, and the table of stages."""
    lines, columns, stages, sweep = [], None, False, []
    for line in text.splitlines():
        words = line.split()
        if words[:1] == ["step"] and "seconds" in words:
            columns = words
        elif words[:3] == ["stage", "seconds", "percent"]:
            stages = True
        elif words[:2] == ["scene", "status"]:
            sweep = [len(lines) + 1]
        elif not words:
            if sweep:
                lines[sweep[0]:] = sorted(lines[sweep[0]:])
            columns, stages, sweep = None, False, []
        elif sweep:
            line = re.sub(r"(\d +)\d+\.\d\d\b", r"\1" + MASK, line, count=1)
        elif stages:
            line = words[0]
        elif columns and words[0].isdigit():
            after = len(columns) - columns.index("seconds")
            words[len(words) - after] = MASK
            line = " ".join(words)
        line = re.sub(r"(\d\S*) (s|seconds|min|minutes|h)\b(?=[ ,;)]|$)", MASK + r" \2", line)
        lines.append(line)
    return "\n".join(lines) + "\n"


def table(text):
    found = list(csv.reader(io.StringIO(text)))
    if not found:
        return text
    hidden = [i for i, name in enumerate(found[0]) if name.startswith(MASKED_COLUMNS)]
    for row in found[1:]:
        for i in hidden:
            if i < len(row) and row[i]:
                row[i] = MASK
    return "".join(",".join(row) + "\n" for row in found) if hidden else text


def summary(text):
    text = re.sub(r'"(seconds\w*|peak_memory)": [-+.\de]+', rf'"\1": "{MASK}"', text)
    text = re.sub(r'("seconds": \{).*?\}', lambda block: re.sub(r": [-+.\de]+", f': "{MASK}"', block[0]), text, flags=re.S)
    return re.sub(r'"(program|build|deal\.II)": ".*?"', rf'"\1": "{MASK}"', text)


TYPES = {"Float64": "d", "Float32": "f", "Int32": "i", "UInt32": "I", "Int64": "q", "UInt64": "Q", "Int8": "b", "UInt8": "B"}


def array(words, kind, form, header):
    """The values of a DataArray of VTK: text, or base64 of blocks that zlib has packed."""
    if form == "ascii":
        return words.split()
    words = "".join(words.split())
    if not words:
        return []
    width = struct.calcsize(TYPES[header])
    n_blocks = struct.unpack("<" + TYPES[header], base64.b64decode(words[:16])[:width])[0]
    head = 4 * (-(-width * (3 + n_blocks) // 3))
    sizes = struct.unpack(f"<{3 + n_blocks}{TYPES[header]}", base64.b64decode(words[:head])[:width * (3 + n_blocks)])[3:]
    data, content, at = base64.b64decode(words[head:]), b"", 0
    for size in sizes:
        content += zlib.decompress(data[at:at + size])
        at += size
    return [value for value, in struct.iter_unpack("<" + TYPES[kind], content)]


def vtk(text):
    """A line for each element with its attributes, and for each array how many values it has, of which size, and their hash."""
    root = ElementTree.fromstring(text)
    lines = []
    for element in root.iter():
        head = element.tag + "".join(f' {key}="{value}"' for key, value in element.attrib.items())
        if element.tag == "DataArray" and (element.text or "").strip():
            values = array(element.text, element.get("type"), element.get("format"), root.get("header_type", "UInt32"))
            numbers = [float(value) for value in values]
            head += f": {len(values)} values from {min(numbers)!r} to {max(numbers)!r}, " if values else ": empty"
            head += hashlib.sha256(repr(values).encode()).hexdigest()[:16]
        elif (element.text or "").strip():
            head += ": " + element.text.strip()
        lines.append(head)
    return "\n".join(lines) + "\n"


def page(text):
    """report.html, without what differs between equal runs."""
    text = re.sub(r'<p class="times">.*', f'<p class="times">{MASK}', text)
    return re.sub(r"(seconds\w*|peak_memory)(</t[hd]><td[^>]*>)[^<]*", rf"\1\2{MASK}", text)


def content(path):
    if path.suffix == ".png":
        return hashlib.sha256(path.read_bytes()).hexdigest() + "\n"
    text = path.read_text(encoding="utf-8")
    by_name = {"summary.json": summary, "report.html": page}
    by_suffix = {".csv": table, ".vtu": vtk, ".pvtu": vtk}
    return by_name.get(path.name, by_suffix.get(path.suffix, lambda same: same))(text)


# --- runs

def set_to(settings):
    return [word for setting in settings for word in ("--set", setting)]


class Freeze:
    """Runs that leave what they say and write, masked, below a directory, each below its own name."""

    def __init__(self, program, kept, scratch):
        self.program, self.kept, self.scratch = program, kept, scratch
        self.directory = scratch / "new"
        self.environment = {**os.environ, "LC_ALL": "C", "OMP_NUM_THREADS": "1", "OPENBLAS_CORETYPE": "Haswell",
                            "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}

    def write(self, name, text):
        path = self.directory / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def run(self, name, *arguments, before=(), results=None):
        done = subprocess.run([*before, self.program, *map(str, arguments)], capture_output=True, text=True, cwd=ROOT,
                              env=self.environment, stdin=subprocess.DEVNULL, timeout=600, check=False)
        paths = {str(results): "RESULTS"} if results else {}
        paths |= {str(self.program): "HPVI", str(self.scratch): "SCRATCH", str(ROOT): "ROOT"}
        self.write(f"{name}/said.txt", masked(f"status {done.returncode}\n" + rows(done.stdout) + "stderr:\n" + done.stderr, paths))
        for path in sorted(results.rglob("*")) if results and results.is_dir() else ():
            if path.is_file() and path.name != "state.dat":
                self.write(f"{name}/{path.relative_to(results)}", masked(content(path), paths))

    def solve(self, name, scene, settings, before=(), options=()):
        results = self.scratch / "results" / name
        results.parent.mkdir(parents=True, exist_ok=True)
        where = () if "--inf-sup" in options else ("--output", results)  # it writes no file
        self.run(name, *options, *where, f"prm/{scene}.prm", *set_to(settings), before=before, results=results)

    def interrupt(self, scene, settings):
        """Keep what a run has left after two steps, which is where it ends or is ended: of a history of loads more are to come."""
        results = self.kept / "directories" / scene
        shutil.rmtree(results, ignore_errors=True)
        with subprocess.Popen([self.program, "--output", results, f"prm/{scene}.prm", *set_to((*settings, "Adaptivity/Maximum steps=2"))],
                              cwd=ROOT, env=self.environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as run:
            steps = results / "convergence.csv"
            while run.poll() is None and not (steps.exists() and len(steps.read_text().splitlines()) > 2):
                time.sleep(0.01)
            run.terminate()
        if not (results / "state.dat").exists():
            raise RuntimeError(f"{scene} has left nothing to go on from")

    def go_on(self, name, settings):
        """From a copy of what was kept, for results are written where those of the run before are."""
        results = self.scratch / "results" / "go_on" / name
        shutil.copytree(self.kept / "directories" / name, results)
        self.run(f"go_on/{name}", "--resume", results, *set_to(settings), results=results)

    def say(self, scene):
        name = pathlib.Path(scene).stem
        self.run(f"validate/{name}", "--validate", scene)
        self.run(f"parameters/{name}", "--print-parameters", scene)
        picture = self.scratch / "results" / "picture" / name
        self.run(f"picture/{name}", "--picture", "--output", picture, scene, results=picture)

    def refusals(self, script):
        """Command line, status and line of each row of a table of tests/bad_input."""
        lines = self.scratch / f"{script}.rows"
        lines.touch()
        library = self.program.parent / "tests/libfuzz_server.so"
        more = [library if library.exists() else "", *([shutil.which("mpirun")] if script == "space.sh" else [])]
        done = subprocess.run(["bash", ROOT / "tests/bad_input" / script, self.program, *more], cwd=ROOT, text=True,
                              capture_output=True, env={**self.environment, "HPVI_ROWS": str(lines)}, check=False)
        text = re.sub(re.escape(tempfile.gettempdir()) + r"/tmp\.\w+", "TEMPORARY", lines.read_text(encoding="utf-8", errors="backslashreplace"))
        text = re.sub(r"[\d.]+ \wB are left", f"{MASK} are left", text)  # of memory
        self.write(f"bad_input/{script}.txt", masked(text, {str(self.program): "HPVI", str(ROOT): "ROOT"}) +
                   f"status {done.returncode}\n")


def jobs(freeze, keep):
    """(name, what to do), those that take longest first."""
    found = [(f"bad_input/{script}", lambda script=script: freeze.refusals(script))
             for script in ("run.sh", "space.sh", "shapes.sh", "bodies.sh")]
    parallel = (shutil.which("mpirun") or "mpirun", "--oversubscribe", "--bind-to", "none", "-np", "2")
    for scene, settings in PROCESSES:
        found.append((f"processes/{scene}", lambda scene=scene, settings=settings:
                      freeze.solve(f"processes/{scene}", scene, settings, before=parallel)))
    scenes = sorted((ROOT / "prm").glob("*.prm"), key=lambda path: (path.stem not in LESS, path.stem))
    for path in scenes:
        found.append((f"scenes/{path.stem}", lambda scene=path.stem:
                      freeze.solve(f"scenes/{scene}", scene, (*STEPS, *LESS.get(scene, ())))))
    for name, options, scene, settings in RUNS:
        found.append((f"runs/{name}", lambda name=name, options=options, scene=scene, settings=settings:
                      freeze.solve(f"runs/{name}", scene, settings, options=options)))

    def one_step_more(scene, settings):
        if keep:
            freeze.interrupt(scene, settings)
        freeze.go_on(scene, STEPS)

    known = {scene for scene, _ in GO_ON}
    for scene, settings in GO_ON:
        found.append((f"go_on/{scene}", lambda scene=scene, settings=settings: one_step_more(scene, settings)))
    for path in sorted((freeze.kept / "directories").glob("*")):
        if path.name not in known:
            found.append((f"go_on/{path.name}", lambda name=path.name: freeze.go_on(name, STEPS)))
    for path in scenes:
        found.append((f"validate/{path.stem}", lambda path=path: freeze.say(f"prm/{path.name}")))
    for path in sorted((ROOT / "tests/bad_input").glob("*.prm")):
        found.append((f"bad_input/{path.stem}", lambda path=path:
                      freeze.run(f"bad_input/{path.stem}", "--validate", f"tests/bad_input/{path.name}")))
    for name, arguments in COMMANDS:
        found.append((f"commands/{name}", lambda name=name, arguments=arguments: freeze.run(f"commands/{name}", *arguments)))
    return found


# --- differences

def differences(name, old, new):
    """Lines of words: where, what it was, what it is."""
    old, new = old.splitlines(), new.splitlines()
    found = []
    for what, a, b, c, d in difflib.SequenceMatcher(None, old, new, autojunk=False).get_opcodes():
        if what == "equal":
            continue
        if b - a != d - c:
            found += [f"{name}:{i + 1}: gone: {old[i]}" for i in range(a, b)] + [f"{name}:{i + 1}: new: {new[i]}" for i in range(c, d)]
            continue
        for i, j in zip(range(a, b), range(c, d)):
            was, now = old[i].split(","), new[j].split(",")
            if name.endswith(".csv") and i and len(was) == len(now) == len(old[0].split(",")):
                columns = zip(old[0].split(","), was, now)
                found += [f"{name}:{i + 1}: {column}: {x} is now {y}" for column, x, y in columns if x != y]
            else:
                found.append(f"{name}:{i + 1}: {old[i]}\n{' ' * len(name)} is now {new[j]}")
    return found


def compare(kept, new, wanted):
    """The number of files, and of those that differ, whose differences are printed."""
    names = {str(path.relative_to(root)) for root in (kept, new) for path in root.rglob("*") if path.is_file()}
    names = sorted(name for name in names if wanted(name))
    differing = 0
    for name in names:
        if not (new / name).exists():
            found = [f"{name}: is gone"]
        elif not (kept / name).exists():
            found = [f"{name}: is new"]
        else:
            old_bytes, new_bytes = (kept / name).read_bytes(), (new / name).read_bytes()
            if old_bytes == new_bytes:
                continue
            found = differences(name, old_bytes.decode(), new_bytes.decode()) or [f"{name}: ends of lines differ"]
        differing += 1
        print("\n".join(line[:400] for line in found[:MOST_DIFFERENCES]))
        if len(found) > MOST_DIFFERENCES:
            print(f"{name}: {len(found) - MOST_DIFFERENCES} more")
    return len(names), differing


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", choices=("keep", "compare"))
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("directory", type=pathlib.Path)
    parser.add_argument("--run", type=pathlib.Path, action="append", default=[], metavar="RESULTS")
    parser.add_argument("-j", type=int, default=2)
    parser.add_argument("--only", default="", metavar="REGEX")
    options = parser.parse_args()
    program, kept, keep = options.program.resolve(), options.directory.resolve(), options.command == "keep"
    mark = kept / "kept.json"
    if keep and kept.exists() and any(kept.iterdir()) and not mark.exists():
        sys.exit(f"{kept} is not empty, and no freeze; give a new directory")
    if not keep and not mark.exists():
        sys.exit(f"{kept} is no freeze; write one with keep")
    if not keep and not options.only:
        options.only = json.loads(mark.read_text(encoding="utf-8"))["only"]  # what there is
    with tempfile.TemporaryDirectory() as scratch:
        freeze = Freeze(program, kept, pathlib.Path(scratch).resolve())
        freeze.directory.mkdir()
        if keep:
            for path in options.run:
                name = path.resolve().name
                shutil.rmtree(kept / "directories" / name, ignore_errors=True)
                shutil.copytree(path, kept / "directories" / name)
        todo = [(name, work) for name, work in jobs(freeze, keep) if re.search(options.only, name)]
        if not todo:
            sys.exit(f"no run has a name with {options.only}")
        with concurrent.futures.ThreadPoolExecutor(options.j) as pool:
            for done in [pool.submit(work) for _, work in todo]:
                done.result()

        def wanted(name):
            return any(name.startswith((f"{run}/", f"{run}.")) or name.startswith((f"parameters/{pathlib.Path(run).name}/",
                       f"picture/{pathlib.Path(run).name}/")) and run.startswith("validate/") for run, _ in todo)
        if keep:
            values = kept / "values"
            for path in sorted(values.rglob("*")) if values.exists() else ():
                if path.is_file() and wanted(str(path.relative_to(values))):
                    path.unlink()
            shutil.copytree(freeze.directory, values, dirs_exist_ok=True)
            n_files = sum(path.is_file() for path in values.rglob("*"))
            only = options.only if not mark.exists() else json.loads(mark.read_text(encoding="utf-8"))["only"]
            mark.write_text(json.dumps({"only": only}) + "\n", encoding="utf-8")
            print(f"kept {n_files} files of {len(todo)} runs in {kept}")
            return
        n_files, differing = compare(kept / "values", freeze.directory, wanted)
        print(f"{differing} of {n_files} files differ" if differing else f"{n_files} files are the same, byte by byte")
        sys.exit(1 if differing else 0)


if __name__ == "__main__":
    main()
