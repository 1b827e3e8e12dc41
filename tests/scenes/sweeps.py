# SPDX-License-Identifier: LGPL-2.1-or-later
"""sweeps.py HPVI: each run of a sweep leaves what it leaves alone, byte by byte but for times; what is done is not done again, what
fails or is ended leaves the others, and sweep.csv tells of all."""

import csv
import json
import os
import re
import shutil
import signal
import subprocess
import time
import unittest

from runs import ENVIRONMENT, PROGRAM, SCENES, RunTest, run_program

SHORT = ("Adaptivity/Maximum steps=3",)
BOUND = "Boundary bottom/Friction bound"
# A bar that friction alone holds, up to a load of 1.75.
LIMIT = SCENES / "semicoercive.prm"
TIMES = ("seconds", "peak_memory")  # columns; peak_memory is that of the process


def table(text):
    return [{key: value for key, value in row.items() if not key.startswith(TIMES)}
            for row in csv.DictReader(text.splitlines())]


def state(text):
    """state.dat without its checksum and seconds: the fifth number of each step, which claims follow, and the eleventh
    of all load steps."""
    head, steps, rest = re.split(r"^(steps \d+)\n", text, flags=re.M)
    count = int(steps.split()[1])
    lines = [re.sub(r"^(loads(?: \S+){10}) \S+", r"\1", line) for line in rest.splitlines()]
    found = []
    for _ in range(count):
        words = lines.pop(0).split()
        claims = 2 + 3 * int(lines[0].split()[1])
        found.append((words[:4] + words[5:], lines[:claims]))
        del lines[:claims]
    return re.sub("checksum .*", "", head), found, lines


def without_times(path):
    """All that a run leaves."""
    result = {file.name: file.read_bytes() for file in path.iterdir()}
    result["convergence.csv"] = table(result["convergence.csv"].decode())
    if "state.dat" in result:
        result["state.dat"] = state(result["state.dat"].decode())
    summary = json.loads(result["summary.json"])
    for name in ("seconds", "final"):
        summary.pop(name)
    result["summary.json"] = summary
    return result


class Sweeps(RunTest):
    def sweep(self, *sweeps, settings=SHORT, status=0, scene=None, options=(), before=(), **more):
        """Returns what it printed, or its one line on stderr."""
        line = [*before, PROGRAM, "--output", self.out, scene or self.scene, *options]
        for setting in settings:
            line += ["--set", setting]
        for one in sweeps:
            line += ["--sweep", one]
        if not before and not more:
            return self.said(status, *run_program(line))
        done = subprocess.run(line, capture_output=True, text=True, env=ENVIRONMENT, timeout=300, check=False, **more)
        return self.said(status, done.returncode, done.stdout, done.stderr)

    def runs(self):
        """The rows of sweep.csv by directory."""
        return {row["directory"]: row for row in self.rows("sweep.csv")}

    def check_as_alone(self, name, *settings, scene=None):
        self.run_scene(*settings, scene=scene, output=self.home / "alone")
        together, alone = without_times(self.out / name), without_times(self.home / "alone")
        self.assertEqual(together.keys(), alone.keys())
        for file in together:
            self.assertEqual(together[file], alone[file], f"{name}/{file}")

    def test_each_run_is_that_of_its_scene_alone(self):
        values = ("1", "4.5*(1 + min(x, 2))")
        printed = self.sweep(f"{BOUND}={', '.join(values)}")
        names = ("Friction bound=1", "Friction bound=4.5__1_+_min_x__2__")
        self.assertEqual(self.names(), [*names, "sweep.csv"])
        for name, value in zip(names, values):
            self.check_as_alone(name, *SHORT, f"{BOUND}={value}")
            row = self.runs()[name]
            self.assertEqual((row[BOUND], row["status"], row["step"]), (value, "done", "3"))
            last = table((self.out / name / "convergence.csv").read_text())[-1]
            self.assertEqual({column: row[column] for column in last}, last)
            line = next(line for line in printed.splitlines() if line.startswith(name + " "))
            found = re.search(r"done +(\S+) +(\d+) +\d+\.\d\d", line)
            self.assertAlmostEqual(float(found[1]) / float(last["energy"]), 1, delta=1e-7)
            self.assertEqual(found[2], last["dofs_free"])
            for warning in json.loads((self.out / name / "summary.json").read_text())["warnings"]:
                self.assertIn(re.split("[:;] ", warning)[0], line)

    def test_all_pairs(self):
        step = "Adaptivity/Maximum steps=1"
        self.sweep("Solver/QP solver=mprgp, active set", "Material/Poisson's ratio=0.1|0.3", settings=(step,))
        names = [f"QP solver={solver},Poisson's ratio={ratio}" for solver in ("mprgp", "active_set") for ratio in ("0.1", "0.3")]
        self.assertEqual(list(self.runs()), names)
        self.check_as_alone(names[3], step, "Solver/QP solver=active set", "Material/Poisson's ratio=0.3")

    def test_other_paths(self):
        """Heat, a load history, the primal path beside the other one, and space."""
        for scene, settings, entry, values in (
                ("bimetal", SHORT, "Temperature/Expression", ("40", "50")),
                ("fretting", ("Loading/Steps=2",), "Boundary bottom/Friction coefficient", ("0.3", "0.5")),
                ("han-6-12", ("Adaptivity/Method=hap2", "Adaptivity/Maximum steps=2"), "Solver/Path", ("reduced", "primal")),
                ("slab", ("Adaptivity/Maximum steps=1",), "Boundary bottom/Friction bound", ("0.1", "0.2"))):
            self.out, scene = self.home / scene, SCENES / f"{scene}.prm"
            self.sweep(f"{entry}={','.join(values)}", settings=settings, scene=scene)
            self.check_as_alone(f"{entry.split('/')[1]}={values[1]}", *settings, f"{entry}={values[1]}", scene=scene)

    def test_what_is_done_is_not_done_again(self):
        core = min(os.sched_getaffinity(0))
        printed = self.sweep(f"{BOUND}=1, 1.5, 2", preexec_fn=lambda: os.sched_setaffinity(0, {core}))
        self.assertIn("3 scenes on 1 core\n", printed)
        first, second, third = (self.out / f"Friction bound={value}/summary.json" for value in ("1", "2", "1.5"))
        before = first.stat().st_mtime_ns
        second.write_text(second.read_text().replace('"status": "done"', '"status": "interrupted"'))
        third.write_text(third.read_text().replace('"program": "hpvi ', '"program": "hpvi 0.'))
        row = self.runs()["Friction bound=1"]
        printed = self.sweep(f"{BOUND}=1, 1.5, 2, 3")
        self.assertEqual(re.findall(r"^Friction bound=(\S+) .* before$", printed, re.M), ["1"])
        self.assertEqual(first.stat().st_mtime_ns, before)
        self.assertIn('"status": "done"', second.read_text())
        self.assertEqual(self.runs()["Friction bound=1"], row)
        self.assertNotIn('"hpvi 0.0', third.read_text())
        self.assertEqual([run["status"] for run in self.runs().values()], ["done"] * 4)
        self.check_other_results_are_left_alone()

    def check_other_results_are_left_alone(self):
        before = (self.out / "sweep.csv").read_bytes()
        for sweep, settings, words in (
                (f"{BOUND}=1, 1.5, 2, 3", ("Adaptivity/Maximum steps=2",), "Friction bound=1 has results of another scene"),
                (f"{BOUND}=1, 1.5, 3", SHORT, "is of another sweep, with Friction bound=2")):
            line = self.sweep(sweep, settings=settings, status=1)
            self.assertIn(f"output directory '{self.out}' cannot be used: its ", line)
            self.assertIn(words, line)
        self.assertEqual((self.out / "sweep.csv").read_bytes(), before)
        (self.out / "sweep.csv").write_text("mine\n")
        self.assertIn("no table of a sweep", self.sweep(f"{BOUND}=1, 1.5, 2, 3", status=1))
        self.assertEqual(self.names(), [*(f"Friction bound={k}" for k in (1, 1.5, 2, 3)), "sweep.csv"])

    def test_a_mesh_file_that_has_changed_is_noticed(self):
        scene, mesh = self.home / "bracket.prm", self.home / "meshes/bracket.msh"
        shutil.copytree(SCENES / "meshes", mesh.parent)
        shutil.copy(SCENES / "bracket.prm", scene)
        sweep, settings, before = "Boundary sole/Friction coefficient=0.2", ("Adaptivity/Maximum steps=1",), mesh.read_bytes()
        self.sweep(sweep, settings=settings, scene=scene)
        mesh.write_bytes(before + b"\n")
        line = self.sweep(sweep, settings=settings, scene=scene, status=1)
        self.assertIn("its Friction coefficient=0.2 has results of a mesh file or a reference solution that has changed; choose another", line)
        mesh.write_bytes(before)
        self.assertRegex(self.sweep(sweep, settings=settings, scene=scene), "(?m)^Friction coefficient=0.2 .* before$")

    def test_a_reference_solution_that_has_changed_is_noticed(self):
        reference, sweep = self.home / "overkill/reference.dat", "Material/Poisson's ratio=0.4"
        settings = ("Adaptivity/Maximum steps=2", f"Error/Reference solution={reference}")
        for steps, status, words in ((3, 0, "done"), (3, 0, "before"), (4, 1, "a reference solution that has changed")):
            self.run_scene(f"Adaptivity/Maximum steps={steps}", "Output/Reference solution=true", output=reference.parent)
            self.assertIn(words, self.sweep(sweep, settings=settings, status=status))

    def test_one_that_fails_does_not_end_the_others(self):
        line = self.sweep("Boundary top/Traction=0.9*1.75; 0 | 1.1*1.75; 0 | 0.8*1.75; 0", scene=LIMIT, status=2)
        self.assertIn(f"hpvi: 1 of 3 scenes failed; 2 of 3 scenes are done in {self.out}", line)
        self.assertEqual([run["status"] for run in self.runs().values()], ["done", "failed", "done"])
        summary = json.loads((self.out / "Traction=1.1_1.75__0/summary.json").read_text())
        self.assertEqual(summary["status"], "failed")

    def test_one_that_is_short_of_memory_waits_for_the_others(self):
        """Either fits a machine that has 133 MB left; both do not."""
        machine = self.home / "meminfo"
        machine.write_text("MemTotal: 1000000 kB\nMemAvailable: 130000 kB\nSwapFree: 0 kB\n")
        inside = ["unshare", "-m", "sh", "-c", f"mount --bind {machine} /proc/meminfo && exec \"$@\"", "sh"]
        if subprocess.run([*inside, "true"], stderr=subprocess.DEVNULL, check=False).returncode != 0:
            self.skipTest("needs the right to mount")
        if len(os.sched_getaffinity(0)) == 1:
            self.skipTest("needs two cores")
        settings = ("Adaptivity/Maximum steps=1", "Geometry/Subdivisions=110, 110", "Adaptivity/Start degree=2",
                    "Error/Bound=false", "Output/VTU=false")
        printed = self.sweep("Title=a, b", settings=settings, before=inside)
        self.assertEqual(len(re.findall("alone, for beside others it was short of memory", printed)), 1, printed)
        self.assertEqual([run["status"] for run in self.runs().values()], ["done", "done"])

    def test_validate_and_print_parameters(self):
        sweep = f"{BOUND}=1 | 2"
        printed = self.sweep(sweep, options=("--validate",))
        self.assertEqual(printed, f"Friction bound=1: valid: {BOUND} = 1\nFriction bound=2: valid: {BOUND} = 2\n")
        printed = self.sweep(sweep, options=("--print-parameters",))
        self.assertEqual(re.findall(r"^  set Friction bound +=.*(\d)$", printed, re.M), ["1", "2"])
        self.assertIn("\n# " + BOUND + " = 2\n", printed)
        self.assertFalse(self.out.exists())

    def test_a_signal_ends_all(self):
        line = [PROGRAM, "--output", self.out, self.scene, "--set", "Adaptivity/Maximum unknowns=1000000",
                "--sweep", "Adaptivity/Maximum steps=1, 2, 97, 98, 99"]
        run = subprocess.Popen(line, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=ENVIRONMENT)
        self.addCleanup(self.end, run)
        done = set()
        while len(done) < 2:
            done |= set(re.findall("^Maximum steps=[12] ", run.stdout.readline()))
        run.send_signal(signal.SIGINT)
        errors = run.communicate(timeout=120)[1]
        self.assertEqual(run.returncode, 130)
        self.assertEqual(errors, f"hpvi: interrupted by SIGINT; 2 of 5 scenes are done in {self.out}, and the same "
                                 "command goes on with the others\n")
        status = [run["status"] for run in self.runs().values()]
        self.assertEqual(status[:2], ["done", "done"])
        self.assertLessEqual(set(status[2:]), {"interrupted", "not begun"})
        for name, row in self.runs().items():
            summary = self.out / name / "summary.json"
            self.assertEqual(json.loads(summary.read_text())["status"] if summary.exists() else "not begun", row["status"])

    def test_a_signal_ends_the_primal_path(self):
        line = [PROGRAM, "--output", self.out, SCENES / "slab.prm", "--set", "Output/VTU=false", "--sweep", "Title=a, b"]
        run = subprocess.Popen(line, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=ENVIRONMENT)
        self.addCleanup(self.end, run)
        while not (self.out / "Title=a/convergence.csv").exists():
            self.assertIsNone(run.poll())
            time.sleep(0.01)
        run.send_signal(signal.SIGTERM)
        printed, errors = run.communicate(timeout=120)
        self.assertEqual(run.returncode, 143)
        self.assertIn("; 2 on the primal path, one after the other\n", printed)
        self.assertIn("interrupted by SIGTERM; 0 of 2 scenes are done", errors)
        self.assertEqual([run["status"] for run in self.runs().values()], ["interrupted", "not begun"])


if __name__ == "__main__":
    unittest.main()
