# SPDX-License-Identifier: LGPL-2.1-or-later
"""report_afterwards.py HPVI: what hpvi --report says of runs that were ended, and what it refuses."""

import fcntl
import importlib.util
import json
import os
import shutil
import subprocess
import sys
import unittest

from runs import PROGRAM, RunTest

if any(importlib.util.find_spec(name) is None for name in ("matplotlib", "jinja2")):
    print("skipped: matplotlib or jinja2 is not installed")
    sys.exit(77)


class Afterwards(RunTest):
    def refuse(self, *more, words, **options):
        line = self.afterwards(*more, **{"status": 1, **options})
        for word in words:
            self.assertIn(word, line)

    def test_it_belongs_to_its_run(self):
        without = ("Adaptivity/Maximum steps=2", "Output/Report=true", "Output/Mesh picture=true")
        said = self.run_scene(*without)
        for entry in ("Report", "Mesh picture"):
            self.assertIn(f"Output/{entry} has no effect any more", said)
        self.assertTrue(said.endswith(f"results in {self.out}\nreport: hpvi --report {self.out}\n"))
        self.assertEqual([name for name in self.names() if name.endswith((".svg", ".html"))], [])
        # Made by another command it is known by itself, and goes with the run of which it tells.
        self.afterwards()
        self.assertIn("report.html", self.names())
        self.assertNotIn("report.html", self.files())
        (self.out / "report.pdf").write_text("%PDF\n% the run, told by hpvi\n")
        self.run_scene(*without)
        for name in ("report.html", "report.pdf"):
            self.assertNotIn(name, self.names())

    def test_a_killed_run_comes_first(self):
        self.end(self.stopped("Adaptivity/Maximum steps=9", rows=3))
        self.assertNotIn("report.html", self.names())
        self.afterwards()
        self.assertIn("did not come to its end", self.page().split("<h2>")[0])
        self.assertIn("<h2>The answer</h2>", self.page())

    def test_a_package_that_is_missing(self):
        """The program where no package of Python is beside it: one line, status 2, and scene.json stays."""
        self.run_scene("Adaptivity/Maximum steps=1")
        alone = self.home / "bin" / "hpvi"
        alone.parent.mkdir()
        shutil.copy(PROGRAM, alone)
        done = subprocess.run([alone, "--report", self.out], capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("install python3-hpvi", done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1)
        self.assertIn("scene.json", self.names())

    def test_what_is_no_run_is_refused(self):
        self.refuse(directory=self.home / "none", words=["--report", "has no summary.json", "name the directory"])
        self.run_scene("Adaptivity/Maximum steps=4")
        self.refuse("prm/x.prm", words=["remove prm/x.prm"])
        self.refuse("--validate", words=["remove the other command"])
        (self.out / "report.html").write_text("<!DOCTYPE html>mine")
        self.refuse(words=["report.html would be overwritten", "move that file away"])
        self.run_scene("Adaptivity/Maximum steps=4")
        self.assertEqual(self.page(), "<!DOCTYPE html>mine")
        (self.out / "report.html").unlink()
        (self.out / "report.pdf").write_text("%PDF mine")
        self.refuse("--pdf", words=["report.pdf would be overwritten", "move that file away"])
        self.afterwards()
        self.assertEqual((self.out / "report.pdf").read_text(), "%PDF mine")
        (self.out / "report.pdf").unlink()
        lock = os.open(self.out, os.O_RDONLY)
        fcntl.flock(lock, fcntl.LOCK_EX)
        self.refuse(words=["another run of hpvi", "wait until that run is over"])
        os.close(lock)
        kept = (self.out / "summary.json").read_text()
        for text, word in (("{}", "no summary.json of a run"), (json.dumps({**json.loads(kept), "steps": 9}), "fewer steps")):
            (self.out / "summary.json").write_text(text)
            self.refuse(words=["report", word], status=2)
        (self.out / "summary.json").write_text(kept)
        vtu = self.out / "solution-04.vtu"
        whole = vtu.read_text()
        for spoilt in (whole[:3000], whole.replace('Name="sigma_xx"', 'Name="other"')):
            vtu.write_text(spoilt)
            self.afterwards()
            self.assertIn("solution-04.vtu cannot be drawn", self.page())
        (self.out / "scene.prm").unlink()
        self.refuse(words=["has no scene.prm"])


if __name__ == "__main__":
    unittest.main()
