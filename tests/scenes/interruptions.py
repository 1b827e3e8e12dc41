# SPDX-License-Identifier: LGPL-2.1-or-later
"""interruptions.py HPVI: signals, streams and disks that fail end a run with the right status and
one line, and its finished steps stay whole."""

import os
import shutil
import signal
import subprocess
import unittest

from runs import ENVIRONMENT, PROGRAM, RunTest, result_names, size_limit

ENDLESS = ("Adaptivity/Maximum steps=99", "Adaptivity/Maximum unknowns=1000000")
SHORT = "Adaptivity/Maximum steps=2"


class Signals(RunTest):
    def finish(self, run):
        """Status and the one line on stderr."""
        errors = run.communicate(timeout=120)[1]
        self.assertEqual(len(errors.splitlines()), 1, errors)
        return run.returncode, errors.rstrip("\n")

    def test_a_signal_ends_the_run_in_good_order(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            run = self.start(*ENDLESS, rows=3)
            run.send_signal(number)
            status, line = self.finish(run)
            steps = self.check_whole()
            self.assertEqual(status, 128 + number)
            self.assertGreaterEqual(steps, 2)
            self.assertEqual(line, f"hpvi: interrupted by {number.name}; steps 1 to {steps} are "
                                   f"safe in {self.out}")
            self.assertEqual(self.summary()["status"], "interrupted")
            self.assertEqual(self.summary()["message"], f"hpvi: interrupted by {number.name}")
            self.assertIsNone(self.summary()["stopped_by"])

    def test_a_step_is_given_up_between_its_stages(self):
        run = self.start("Geometry/Subdivisions=70, 70", rows=0)
        run.send_signal(signal.SIGTERM)
        status, line = self.finish(run)
        self.assertEqual(status, 143)
        self.assertIn("no step is finished", line)
        self.assertEqual(self.names(), ["scene.prm", "summary.json"])
        self.assertEqual(self.summary()["steps"], 0)

    def test_a_second_signal_ends_the_run_at_once(self):
        run = self.stopped(*ENDLESS)
        run.send_signal(signal.SIGINT)
        run.send_signal(signal.SIGTERM)
        run.send_signal(signal.SIGCONT)
        run.communicate(timeout=120)
        self.assertIn(run.returncode, (-signal.SIGINT, -signal.SIGTERM))
        self.assertEqual(self.summary()["status"], "running")

    def test_an_ignored_signal_stays_ignored(self):
        run = self.start(SHORT, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_IGN))
        run.send_signal(signal.SIGINT)
        run.communicate(timeout=120)
        self.assertEqual(run.returncode, 0)
        self.assertEqual(self.check_whole(), 2)

    def test_a_measurement_ends_too(self):
        run = subprocess.Popen([PROGRAM, "--inf-sup", self.scene, "--set", ENDLESS[0]], text=True,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=ENVIRONMENT)
        self.addCleanup(self.end, run)
        next(line for line in run.stdout if line.startswith("step "))
        run.send_signal(signal.SIGINT)
        self.assertEqual(self.finish(run), (130, "hpvi: interrupted by SIGINT"))


class Streams(RunTest):
    def check_complete(self, line, contact):
        self.assertEqual(line, f"hpvi: standard output cannot be written; the results in {self.out} "
                               "are complete")
        self.assertEqual(self.check_whole(), 2)
        self.assertEqual(self.summary()["status"], "done")
        self.assertEqual((self.out / "contact-02.csv").read_bytes(), contact)

    def test_a_run_goes_on_without_standard_output(self):
        self.run_scene(SHORT)
        contact = (self.out / "contact-02.csv").read_bytes()
        with open("/dev/full", "wb") as full:
            self.check_complete(self.run_scene(SHORT, status=2, stdout=full), contact)
        self.check_complete(self.run_scene(SHORT, status=2, preexec_fn=lambda: os.close(1)), contact)
        reader, writer = os.pipe()
        os.close(reader)
        self.check_complete(self.run_scene(SHORT, status=2, stdout=writer), contact)
        os.close(writer)

    def test_closed_streams_do_not_fall_into_files(self):
        def close_all():
            for descriptor in range(3):
                os.close(descriptor)
        done = subprocess.run([PROGRAM, "--output", self.out, self.scene, "--set", SHORT],
                              preexec_fn=close_all, env=ENVIRONMENT, timeout=120, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(self.check_whole(), 2)

    def test_what_was_only_to_be_printed_is_missed(self):
        for option in ("--help", "-h", "--version", "--print-parameters"):
            with open("/dev/full", "wb") as full:
                done = subprocess.run([PROGRAM, option], stdout=full, stderr=subprocess.PIPE,
                                      env=ENVIRONMENT, timeout=120, check=False)
            self.assertEqual(done.returncode, 2)
            self.assertEqual(done.stderr, b"hpvi: standard output cannot be written\n")


class Disks(RunTest):
    def test_a_limit_of_the_file_size_keeps_the_steps_before(self):
        line = self.run_scene(*ENDLESS, status=2, preexec_fn=size_limit(40000))
        steps = len(self.rows())
        self.assertGreaterEqual(steps, 2)
        self.assertIn(f"output directory '{self.out}': ", line)
        self.assertIn(" cannot be written: File too large; ", line)
        self.assertIn(f"steps 1 to {steps} are safe", line)
        self.assertEqual((self.summary()["status"], self.summary()["message"]), ("failed", line))
        self.assertLessEqual(set(result_names(steps)), set(self.names()))
        self.assertNotIn(".hpvi.tmp", self.names())
        self.run_scene(SHORT)
        self.assertEqual(self.check_whole(), 2)

    def test_a_row_is_there_as_a_whole_or_not(self):
        quiet = ("Output/VTU=false", "Output/Contact tables=false")
        many = ("Loading/Steps=1000", "Adaptivity/Maximum steps=1", "Error/Bound=false")
        line = self.run_scene(*many, *quiet, status=2, preexec_fn=size_limit(20000))
        steps = len(self.rows())
        self.assertIn(f"convergence.csv cannot be written: File too large; steps 1 to {steps} are safe", line)
        table = (self.out / "convergence.csv").read_text()
        self.assertTrue(table.endswith("\n") and len(table) < 20000)
        self.assertEqual(self.summary()["steps"], steps)

    def test_a_table_that_another_has_changed_is_written_anew(self):
        run = self.stopped(*ENDLESS, rows=3)
        before = len(self.rows())
        (self.home / "copy").hardlink_to(self.out / "degrees.csv")
        copied = (self.home / "copy").read_text()
        (self.out / "convergence.csv").write_text("mine")
        (self.out / "solution.pvd").unlink()
        run.send_signal(signal.SIGCONT)
        for line in run.stdout:
            if line.split()[:1] == [str(before + 2)]:
                break
        run.send_signal(signal.SIGTERM)
        run.communicate(timeout=120)
        self.assertGreater(self.check_whole(), before)
        self.assertEqual([int(row["step"]) for row in self.rows()], list(range(1, len(self.rows()) + 1)))
        self.assertEqual((self.home / "copy").read_text(), copied)
        self.assertEqual((self.out / "solution.pvd").read_text().count("solution-"), len(self.rows()))

    def test_the_first_step_may_be_too_large(self):
        line = self.run_scene(status=2, preexec_fn=size_limit(6000))
        self.assertIn("no step is finished", line)
        self.assertEqual(self.summary()["steps"], 0)
        self.assertIsNone(self.summary()["final"])

    def test_a_directory_that_takes_nothing_is_bad_input(self):
        line = self.run_scene(status=1, preexec_fn=size_limit(10))
        self.assertIn("cannot be used: summary.json cannot be written: File too large", line)
        self.assertEqual(self.names(), [])

    def test_a_full_disk_keeps_the_steps_before(self):
        self.out.mkdir()
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=300k", "none", self.out],
                                 stderr=subprocess.DEVNULL, check=False).returncode == 0
        if not mounted:
            self.skipTest("needs the right to mount")
        self.addCleanup(subprocess.run, ["umount", self.out], check=True)
        line = self.run_scene(*ENDLESS, status=2)
        steps = len(self.rows())
        self.assertIn(f"No space left on device; steps 1 to {steps} are safe", line)
        self.assertLessEqual(set(result_names(steps)), set(self.names()))

    def test_a_vanished_directory_ends_the_run(self):
        run = self.stopped(*ENDLESS, rows=3)
        shutil.rmtree(self.out)
        run.send_signal(signal.SIGCONT)
        errors = run.communicate(timeout=120)[1]
        self.assertEqual(run.returncode, 2)
        self.assertRegex(errors, r"^output directory '.*': .* cannot be written: No such file or "
                                 r"directory; steps 1 to \d+ have vanished with it\n$")
        self.assertFalse(self.out.exists())

    def test_a_directory_put_in_its_place_is_left_alone(self):
        run = self.stopped(*ENDLESS, rows=3)
        self.out.rename(self.home / "moved")
        self.out.mkdir()
        run.send_signal(signal.SIGCONT)
        run.communicate(timeout=120)
        self.assertEqual(run.returncode, 2)
        self.assertEqual(self.names(), [])


if __name__ == "__main__":
    unittest.main()
