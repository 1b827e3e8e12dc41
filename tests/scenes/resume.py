# SPDX-License-Identifier: LGPL-2.1-or-later
"""resume.py HPVI [KILLS SEED]: a run that goes on, also after SIGKILL at any moment, leaves what the whole run leaves; what is no run
of the program or of the scene is refused."""

import random
import re
import subprocess
import sys
import time
import unittest
import zlib

KILLS, SEED = (int(sys.argv.pop(2)), int(sys.argv.pop(2))) if len(sys.argv) > 3 else (2, 1)

from runs import ENVIRONMENT, PROGRAM, SCENES, RunTest, command, run_program

STEPS = "Adaptivity/Maximum steps=7"
# No bound: which of some congruent patches is solved for all of them is not kept, and its last digits differ.
RUN = (STEPS, "Error/Bound=false")
# Histories of loads, the first setting that of their number: in the plane Coulomb's law and Tresca's, of one body and of two, on the
# other path, and in space.
HISTORIES = (
    ("fretting", ("Loading/Steps=5", "Loading/Adapt=first step", "Adaptivity/Tolerance=0.1", "Output/Steps=last")),
    ("fretting", ("Loading/Steps=4", "Adaptivity/Maximum steps=3", "Boundary bottom/Friction coefficient=",
                  "Boundary bottom/Friction bound=2", "Adaptivity/Tolerance=0.05", "Output/VTU=false")),
    ("bolted-flange", ("Loading/Steps=3", "Adaptivity/Maximum steps=2", "Output/VTU=false")),
    ("lap-joint", ("Loading/Steps=3", "Adaptivity/Maximum steps=2", "Output/VTU=false")),
    ("fretting", ("Loading/Steps=3", "Solver/Path=primal", "Adaptivity/Method=hap2", "Adaptivity/Start degree=2",
                  "Boundary bottom/Contact=bilateral", "Boundary bottom/Friction coefficient=",
                  "Boundary bottom/Friction bound=2", "Adaptivity/Maximum steps=2")),
    ("fretting", ("Loading/Steps=2", "Loading/Until steady=1e-6", "Loading/Maximum cycles=2", "Loading/Adapt=first step",
                  "Boundary bottom/Wear coefficient=1e-6", "Adaptivity/Maximum steps=2", "Output/VTU=false")),
    ("fretting-dome", ("Loading/Steps=3", "Loading/Adapt=every step", "Output/VTU=false", "Adaptivity/Maximum unknowns=2000",
                       "Adaptivity/Maximum steps=2")))
# Besides summary.json, which has times; convergence.csv is compared without them.
TIMES = ("seconds", "peak_memory")


class Resume(RunTest):
    def go_on(self, *settings, status=0, directory=None, options=()):
        line = [PROGRAM, "--resume", directory or self.out, *options]
        for setting in settings:
            line += ["--set", setting]
        return self.said(status, *run_program(line))

    def result(self):
        """Every byte but times."""
        result = self.contents()
        for name in ("convergence.csv", "state.dat", "summary.json"):
            result.pop(name)
        rows = [{key: value for key, value in row.items() if not key.startswith(TIMES)}
                for row in self.rows()]
        summary = self.summary()
        for name in ("seconds", "final"):
            summary.pop(name)
        return result, rows, summary

    def whole(self, *settings):
        self.run_scene(*settings)
        result = self.result()
        for path in self.out.iterdir():
            path.unlink()
        return result

    def check_same(self, whole):
        for ours, theirs in zip(self.result(), whole):
            self.assertEqual(ours, theirs)

    def test_more_steps(self):
        for more in ((), ("Output/Steps=last",), ("Solver/Path=primal", "Adaptivity/Method=hap2")):
            whole = self.whole(*RUN, *more)
            self.run_scene("Adaptivity/Maximum steps=3", *RUN[1:], *more)
            self.assertIn("\ngoes on after step 3\n", self.go_on(STEPS))
            self.check_same(whole)

    def test_in_space(self):
        self.scene = SCENES / "slab.prm"
        whole = self.whole("Adaptivity/Maximum steps=3", "Error/Bound=false")
        self.run_scene("Adaptivity/Maximum steps=2", "Error/Bound=false")
        self.go_on("Adaptivity/Maximum steps=3")
        self.check_same(whole)

    def test_killed_at_any_moment(self):
        self.kill(2 * KILLS, RUN, 7)

    def test_histories_killed_at_any_moment(self):
        for scene, settings in HISTORIES:
            self.scene = SCENES / (scene + ".prm")
            n_cycles = next((int(entry.split("=")[1]) for entry in settings if "Maximum cycles" in entry), 1)
            self.kill(KILLS if scene == "fretting" else KILLS // 2, settings, n_cycles * int(settings[0].split("=")[1]))

    def test_the_bound_of_the_last_step(self):
        """Its last digits, too, and that of the coarse mesh, by which one knows where the tolerance is near."""
        settings = ("Error/Bound=last step", "Adaptivity/Tolerance=0.01")
        self.kill(KILLS, settings, len(self.whole(*settings)[1]))
        self.run_scene(STEPS, "Error/Bound=last step")
        early = self.rows()
        self.assertTrue(early[-1]["error_bound"])
        self.go_on("Adaptivity/Maximum steps=9")
        rows = self.rows()
        self.assertEqual(rows[:7], early)
        self.assertEqual([bool(row["error_bound"]) for row in rows[7:]], [False, True])

    def kill(self, n_kills, settings, n_ends):
        """After some step and a pause of some milliseconds, or of about a step."""
        whole = self.whole(*settings)
        dice = random.Random(SEED)
        finished = 0
        for _ in range(n_kills):
            self.kill_in_step(settings, dice.randint(2, n_ends), dice.choice((0.01, 0.1, 1)) * dice.random())
            finished += self.ends() == n_ends
            self.resume_to_the_end(whole, n_ends)
        print(f"{self.scene.stem} {' '.join(settings)}: {n_kills} kills, {finished} of them after the last state")

    def resume_to_the_end(self, whole, n_ends):
        if self.ends() == n_ends:
            self.assertIn("nothing to go on with after ", self.go_on(status=1))
        else:
            self.go_on()
        self.check_same(whole)
        for path in self.out.iterdir():
            path.unlink()

    def kill_in_step(self, settings, step, pause):
        run = subprocess.Popen(command(self.scene, self.out, *settings), stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL, env=ENVIRONMENT)
        while self.ends() < step - 1:
            time.sleep(0.001)
        time.sleep(pause)
        run.kill()
        run.wait()

    def ends(self):
        """How many steps, in a history load steps, the state knows."""
        state = self.out / "state.dat"
        text = state.read_text() if state.exists() else "\nsteps 0\nloads 0\n"
        return int(text.split("\nloads ")[1].split()[0]) or int(text.split("\nsteps ")[1].split()[0])

    def test_the_bound_to_its_last_digits(self):
        self.run_scene(STEPS)
        whole = self.rows()
        self.run_scene("Adaptivity/Maximum steps=3")
        self.go_on(STEPS)
        for ours, theirs in zip(self.rows(), whole):
            self.assertAlmostEqual(float(ours["error_bound"]) / float(theirs["error_bound"]), 1, delta=1e-9)
            self.assertEqual(ours["energy"], theirs["energy"])

    def test_scene_prm_reads_back(self):
        for name in ("shrink-fit", "stack"):  # sides on which nothing can act
            printed = self.said(0, *run_program([PROGRAM, SCENES / f"{name}.prm", "--print-parameters"]))
            (self.home / "printed.prm").write_text(printed)
            self.said(0, *run_program([PROGRAM, self.home / "printed.prm", "--validate"]))

    def test_what_is_refused(self):
        short = ("Adaptivity/Maximum steps=2", "Error/Bound=false")
        self.assertIn("has no scene.prm", self.go_on(status=1))
        self.run_scene(*short)
        before = self.contents()
        self.assertIn("nothing to go on with after step 2: Adaptivity/Maximum steps", self.go_on(status=1))
        self.assertIn("limits alone may change", self.go_on("Material/Young's modulus=2", status=1))
        self.assertIn("remove --output", self.go_on(status=1, options=("--output", "other")))
        self.assertIn("remove the other command", self.go_on(status=1, options=("--validate",)))
        state, scene = self.out / "state.dat", self.out / "scene.prm"
        text = state.read_text()
        for other, words in ((text[:-20], "cut short or altered"), ("mine", "does not begin with"),
                             (text.replace("format", "shape", 1), "does not begin with"),
                             (re.sub("format [0-9]+", "format 7", text, count=1), "another version of hpvi has written it")):
            state.write_text(other)
            self.assertIn(words, self.go_on(STEPS, status=1))
        state.write_text(text)
        scene.write_text(scene.read_text().replace("set Poisson's ratio = 0.4", "set Poisson's ratio = 0.3", 1))
        if scene.read_bytes() != before["scene.prm"]:
            self.assertIn("another problem: Material/Poisson's ratio", self.go_on(STEPS, status=1))
        scene.write_bytes(before["scene.prm"])
        self.assertEqual(self.contents(), before)
        sum_of = lambda content: f"checksum {zlib.crc32(content.encode()):08x}"
        head, checksum, content = text.split("\n", 2)
        self.assertEqual(checksum, sum_of(content))
        content = re.sub(r"hpvi = .*", "hpvi = 0.0.9", content, count=1)
        state.write_text("\n".join((head, sum_of(content), content)))
        self.assertIn("hpvi = 0.0.9 there, ", self.go_on(STEPS, status=1))
        state.unlink()
        self.assertIn("has no state.dat", self.go_on(STEPS, status=1))

    def test_what_is_refused_of_histories(self):
        self.scene = SCENES / "fretting.prm"
        self.run_scene("Loading/Steps=2", "Adaptivity/Maximum steps=1")
        before = self.contents()
        self.assertIn("nothing to go on with after load step 2, the last one",
                      self.go_on("Adaptivity/Maximum steps=3", status=1))
        scene = self.out / "scene.prm"
        scene.write_text(re.sub(r"(set Steps +=) 2", r"\1 3", scene.read_text(), count=1))
        self.assertIn("another problem: Loading/Steps = 2 there, 3 here", self.go_on(status=1))
        scene.write_bytes(before["scene.prm"])
        self.assertEqual(self.contents(), before)


if __name__ == "__main__":
    unittest.main()
