# SPDX-License-Identifier: LGPL-2.1-or-later
"""processes.py HPVI MPIRUN: signals end a run of several processes as they end one, no process is left, and
none waits for another that cannot read its scene; what some processes have begun goes on on others."""

import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest

from runs import ENVIRONMENT, PROGRAM, SCENES, RunTest, command

# mpirun sends SIGCONT, SIGTERM and SIGKILL a second apart, which a busy machine may need for one step of conjugate
# gradients: four seconds.
MPIRUN = [sys.argv.pop(1), "--oversubscribe", "--bind-to", "none", "--mca", "odls_base_sigkill_timeout", "4"]
REFINED = ("Adaptivity/Maximum unknowns=1000000", "Output/VTU=false")
# A body that does not change its volume locks: minutes of short steps of conjugate gradients, for a signal takes
# seconds to arrive, and the run must not end before it.
STIFF = (*REFINED, "Geometry/Subdivisions=24, 24, 12", "Material/Poisson's ratio=0.49999")
SOLVING = rb"finding stick and slip: .*[1-9] steps of conjugate gradients"


def processes(directory):
    """Those of the run in that directory, mpirun aside."""
    found = []
    for path in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            words = (path / "cmdline").read_bytes().split(b"\0")
        except OSError:  # it has just ended
            continue
        if words[0] == PROGRAM.encode() and str(directory).encode() in words:
            found.append(int(path.name))
    return found


class Processes(RunTest):
    scene = SCENES / "slab.prm"

    def start_two(self, stage, *settings):
        """A run that has come to a stage; its first process shows them as on a terminal."""
        run = subprocess.Popen([*MPIRUN, "-np", "2", *command(self.scene, self.out, *settings)], stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, env={**ENVIRONMENT, "HPVI_TERMINAL": "1"})
        self.addCleanup(self.end, run)
        shown = b""
        while not re.search(stage, shown):
            part = os.read(run.stdout.fileno(), 4096)
            self.assertTrue(part, shown)
            shown += part
        return run

    def check_ended(self, run, number, safe):
        """One line, a summary that says the same, nobody left."""
        errors = run.communicate(timeout=60)[1].decode()
        own = [line for line in errors.splitlines() if line.startswith("hpvi")]
        self.assertEqual(own, [f"hpvi: interrupted by {number.name}; {safe} in {self.out}"], errors)
        self.assertEqual(self.summary()["status"], "interrupted")
        self.assertEqual(self.files(), self.names())
        self.check_nobody_left()

    def check_nobody_left(self):
        """mpirun may end a moment before the last of its processes is gone."""
        late = time.monotonic() + 5
        while (left := processes(self.out)) and time.monotonic() < late:
            time.sleep(0.05)
        self.assertEqual(left, [])

    def test_mpirun_passes_a_signal_on(self):
        """Either as SIGTERM, and its status is its own."""
        for number in (signal.SIGINT, signal.SIGTERM):
            run = self.start_two(SOLVING, *STIFF)
            run.send_signal(number)
            self.check_ended(run, signal.SIGTERM, "no step is finished")
            self.assertEqual(run.returncode, 1)

    def test_a_signal_to_one_process_ends_all(self):
        for number, stage, settings, safe in (
                (signal.SIGINT, rb"step 3: assembling \d+ elements", REFINED, "steps 1 to 2 are safe"),
                (signal.SIGTERM, SOLVING, STIFF, "no step is finished")):
            run = self.start_two(stage, *settings)
            os.kill(max(processes(self.out)), number)
            self.check_ended(run, number, safe)
            self.assertEqual(run.returncode, 128 + number)

    def resumed(self, n, whole):
        """Does a copy, on so many processes, end with the energies of the whole run?"""
        out = self.home / f"on-{n}"
        shutil.copytree(self.out, out)
        line = [PROGRAM, "--resume", out]
        done = subprocess.run(line if n == 1 else [*MPIRUN, "-np", str(n), *line], capture_output=True, text=True,
                              env=ENVIRONMENT, timeout=300, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = self.rows(out / "convergence.csv")
        self.assertEqual(len(rows), len(whole))
        for ours, theirs in zip(rows, whole):
            self.assertAlmostEqual(float(ours["energy"]) / float(theirs["energy"]), 1, delta=1e-9)
            self.assertEqual(ours["elements"], theirs["elements"])

    def test_goes_on_on_another_number_of_processes(self):
        self.scene = SCENES / "fretting-dome.prm"
        settings = ("Solver/Primal tolerance=1e-11", "Loading/Steps=2", "Adaptivity/Maximum unknowns=2000",
                    "Adaptivity/Maximum steps=2")
        self.run_scene(*settings, output=self.home / "whole")
        run = subprocess.Popen([*MPIRUN, "-np", "2", *command(self.scene, self.out, *settings)],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=ENVIRONMENT)
        self.addCleanup(self.end, run)
        while not (self.out / "state.dat").exists():
            time.sleep(0.001)
        os.kill(max(processes(self.out)), signal.SIGKILL)
        run.wait()
        self.check_nobody_left()
        for n in (1, 3):
            self.resumed(n, self.rows(self.home / "whole" / "convergence.csv"))

    def test_what_one_process_cannot_read_ends_all(self):
        for second in (command(self.home / "missing.prm", self.out), command(self.scene, self.out, "Material/Yung=1")):
            done = subprocess.run([*MPIRUN, "-np", "1", *command(self.scene, self.out), ":", "-np", "1", *second],
                                  capture_output=True, text=True, env=ENVIRONMENT, timeout=60, check=False)
            self.assertEqual(done.returncode, 1)
            self.assertEqual(len(re.findall(r"missing\.prm|Yung", done.stderr)), 1, done.stderr)
            self.assertFalse(self.out.exists())


if __name__ == "__main__":
    unittest.main()
