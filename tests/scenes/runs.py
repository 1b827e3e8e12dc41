# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the tests of whole runs share: the program, scenes, readers of its files."""

import atexit
import base64
import csv
import json
import os
import pathlib
import pty
import re
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
import zlib

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "fuzz"))
import served

PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
SCENES = pathlib.Path(__file__).resolve().parents[2] / "prm"
ENVIRONMENT = {**os.environ, "OMP_NUM_THREADS": "1", "LC_ALL": "C"}


def text_of(settings):
    """A scene with these entries; None stands for one that it has not."""
    lines = []
    for path, value in settings.items():
        if value is not None:
            section, _, name = path.rpartition("/")
            lines += [f"subsection {section}"] * bool(section) + [f"set {name} = {value}"] + ["end"] * bool(section)
    return "\n".join(lines) + "\n"


# A bar under uniaxial tension: the exact solution is linear, sigma_xx = 3 and nothing else.
BAR = text_of({"Geometry/Upper corner": "2, 1", "Geometry/Subdivisions": "2, 1", "Material/Young's modulus": "10",
               "Material/Poisson's ratio": "0.25", "Material/Plane": "stress", "Boundary left/Displacement": "0; free",
               "Boundary bottom/Displacement": "free; 0", "Boundary right/Traction": "3; 0", "Adaptivity/Method": "hup2",
               "Adaptivity/Maximum steps": "1"})


def command(scene, output, *settings):
    line = [PROGRAM, "--output", output, scene]
    for setting in settings:
        line += ["--set", setting]
    return line


SERVERS = []  # the one of this process, from the first run on
LIBRARY = pathlib.Path(PROGRAM).parent / "tests/libfuzz_server.so"


def run_program(line, directory="."):
    """A run without input that is waited for: status, stdout, stderr."""
    if not LIBRARY.exists():
        done = subprocess.run(line, capture_output=True, text=True, env=ENVIRONMENT, timeout=300, check=False, cwd=directory)
        return done.returncode, done.stdout, done.stderr
    if not SERVERS:
        SERVERS.append(served.Server(PROGRAM, LIBRARY, ENVIRONMENT, os.getcwd()))
        atexit.register(SERVERS[0].stop)
    with tempfile.TemporaryDirectory() as home:
        out, errors = (pathlib.Path(home) / name for name in ("out", "errors"))
        status = SERVERS[0].run([str(word) for word in line[1:]], os.path.abspath(directory), str(out), str(errors), 1 << 40, 300, 300)[0]
        return os.waitstatus_to_exitcode(status), out.read_text(), errors.read_text()


class RunTest(unittest.TestCase):
    """Each test has a directory of its own and runs with han-6-12.prm unless it names a scene."""

    scene = SCENES / "han-6-12.prm"

    def setUp(self):
        self.home = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.home, ignore_errors=True)
        self.out = self.home / "out"

    def written(self, settings, name="own.prm"):
        """A scene of these entries, in a file."""
        file = self.home / name
        file.write_text(text_of(settings))
        return file

    def bar(self):
        scene = self.home / "bar.prm"
        scene.write_text(BAR)
        return scene

    def run_scene(self, *settings, status=0, scene=None, output=None, **options):
        """Run to the end; returns what it printed. A failure is one line on stderr."""
        line = command(scene or self.scene, output or self.out, *settings)
        if options:
            done = subprocess.run(line, stderr=subprocess.PIPE, env=ENVIRONMENT, timeout=300, check=False, text=True,
                                  **{"stdout": subprocess.PIPE, **options})
            return self.said(status, done.returncode, done.stdout, done.stderr)
        return self.said(status, *run_program(line))

    def said(self, status, ended, shown, errors):
        self.assertEqual(ended, status, errors)
        self.assertEqual(len(errors.splitlines()), 0 if status == 0 else 1, errors)
        return (shown or "") if status == 0 else errors.rstrip("\n")

    def start(self, *settings, scene=None, rows=1, **options):
        """A run that has printed so many rows of its table."""
        run = subprocess.Popen(command(scene or self.scene, self.out, *settings), text=True,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=ENVIRONMENT,
                               **options)
        self.addCleanup(self.end, run)
        for line in run.stdout:
            if line.startswith("step ") and rows == 0 or line.split()[:1] == [str(rows)]:
                return run
        return self.fail("the run has ended: " + run.stderr.read())

    def stopped(self, *settings, **options):
        """The same, and it stands still."""
        run = self.start(*settings, **options)
        run.send_signal(signal.SIGSTOP)
        return run

    @staticmethod
    def end(run):
        run.kill()
        run.communicate()

    def names(self):
        return sorted(path.name for path in self.out.iterdir())

    def contents(self):
        return {path.name: path.read_bytes() for path in self.out.iterdir()}

    def summary(self):
        return json.loads((self.out / "summary.json").read_text())

    def files(self):
        """The names that summary.json lists, of which a range {01..17} stands for many."""
        return sorted(name for entry in self.summary()["files"] for name in expanded(entry))

    def rows(self, name="convergence.csv"):
        with open(self.out / name, newline="") as file:
            return list(csv.DictReader(file))

    def page(self):
        return (self.out / "report.html").read_text()

    def afterwards(self, *more, status=0, directory=None):
        """The report of a run that is over, by --report; returns the line that it printed."""
        return self.said(status, *run_program([PROGRAM, "--report", directory or self.out, *more]))

    def check_whole(self):
        """Every file of every step that the tables name is there and whole, and no other one."""
        steps = len(self.rows())
        self.assertEqual(self.summary()["steps"], steps)
        self.assertEqual(len(self.rows("degrees.csv")), steps)
        self.assertEqual(self.names(), result_names(steps))
        self.assertEqual(self.files(), self.names())
        for step in range(1, steps + 1):
            self.rows(f"contact-{step:02}.csv")
            read_vtu(self.out / f"solution-{step:02}.vtu")
            read_vtu(self.out / f"contact-{step:02}.vtu")
        return steps


def expanded(entry):
    found = re.fullmatch(r"(.*)\{(\d+)\.\.(\d+)\}(.*)", entry)
    if not found:
        return [entry]
    head, first, last, tail = found.groups()
    return [f"{head}{k:0{len(first)}}{tail}" for k in range(int(first), int(last) + 1)]


def result_names(steps):
    names = ["convergence.csv", "degrees.csv", "forces.csv", "scene.prm", "summary.json", "contact.pvd", "solution.pvd",
             "state.dat"]
    for step in range(1, steps + 1):
        names += [f"contact-{step:02}.csv", f"contact-{step:02}.vtu", f"solution-{step:02}.vtu"]
    return sorted(names)


def size_limit(size):
    return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))


# ---------------------------------------------------------------- VTU

FORMATS = {"Float32": "f", "Float64": "d", "Int32": "i", "UInt32": "I", "Int64": "q", "UInt64": "Q",
           "UInt8": "B"}


def numbers(array):
    """A DataArray: digits, or base64 of block sizes and of what zlib made of them."""
    kind = FORMATS[array.get("type")]
    if array.get("format") == "ascii":
        return [float(word) if kind in "fd" else int(word) for word in array.text.split()]
    text = array.text.strip()
    n_blocks = struct.unpack("<I", base64.b64decode(text[:8])[:4])[0]
    head = 4 * (3 + n_blocks)
    digits = 4 * ((head + 2) // 3)
    sizes = struct.unpack(f"<{3 + n_blocks}I", base64.b64decode(text[:digits])[:head])[3:]
    data, result = base64.b64decode(text[digits:]), b""
    for size in sizes:
        result += zlib.decompress(data[:size])
        data = data[size:]
    return list(struct.unpack(f"<{len(result) // struct.calcsize(kind)}{kind}", result))


def read_vtu(path):
    """Points, cells as lists of point numbers, fields of points and cells by name."""
    piece = ElementTree.parse(path).getroot().find("UnstructuredGrid/Piece")
    flat = numbers(piece.find("Points/DataArray"))
    cells = {array.get("Name"): numbers(array) for array in piece.find("Cells")}
    grid = {"points": [tuple(flat[k:k + 3]) for k in range(0, len(flat), 3)], "cells": []}
    start = 0
    for end in cells["offsets"]:
        grid["cells"].append(cells["connectivity"][start:end])
        start = end
    for place in ("PointData", "CellData"):
        for array in piece.find(place) or ():
            width = int(array.get("NumberOfComponents", "1"))
            values = numbers(array)
            name = array.get("Name")
            grid[f"cell {name}" if name in grid else name] = values if width == 1 else \
                [tuple(values[k:k + width]) for k in range(0, len(values), width)]
    return grid


def on_terminal(command):
    """What the program sends to a terminal."""
    controller, terminal = pty.openpty()
    process = subprocess.Popen(command, stdout=terminal)
    os.close(terminal)
    received = b""
    try:
        while part := os.read(controller, 4096):
            received += part
    except OSError:  # how Linux says that the other side is closed
        pass
    os.close(controller)
    if process.wait() != 0:
        sys.exit(f"exit status {process.returncode} on a terminal")
    return received.decode().replace("\r\n", "\n")
