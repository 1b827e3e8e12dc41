# SPDX-License-Identifier: LGPL-2.1-or-later
"""report_afterwards.py HPVI: what hpvi --report says of runs that were ended, and what it refuses."""

import fcntl
import json
import os
import unittest

from runs import RunTest


class Afterwards(RunTest):
    def refuse(self, *more, words, **options):
        line = self.afterwards(*more, status=1, **options)
        for word in words:
            self.assertIn(word, line)

    def test_it_belongs_to_its_run(self):
        without = ("Adaptivity/Maximum steps=2", "Output/Report=false")
        self.run_scene(*without)
        self.assertEqual(self.summary()["seconds"]["report"], 0)
        # Made by another command it is known by itself, and goes with the run of which it tells.
        self.afterwards()
        self.assertIn("report.html", self.names())
        self.assertNotIn("report.html", self.files())
        self.run_scene(*without)
        self.assertNotIn("report.html", self.names())

    def test_a_killed_run_comes_first(self):
        self.end(self.stopped("Adaptivity/Maximum steps=9", rows=3))
        self.assertNotIn("report.html", self.names())
        self.afterwards()
        self.assertIn("did not come to its end", self.page().split("<h2>")[0])
        self.assertIn("<h2>The answer</h2>", self.page())

    def test_what_is_no_run_is_refused(self):
        self.refuse(directory=self.home / "none", words=["--report", "has no summary.json", "name the directory"])
        self.run_scene("Adaptivity/Maximum steps=4", "Output/Report=false")
        self.refuse("prm/x.prm", words=["remove prm/x.prm"])
        self.refuse("--validate", words=["remove the other command"])
        (self.out / "report.html").write_text("<!DOCTYPE html>mine")
        self.refuse(words=["report.html would be overwritten", "move that file away"])
        self.run_scene("Adaptivity/Maximum steps=1", status=1)
        self.assertEqual(self.page(), "<!DOCTYPE html>mine")
        (self.out / "report.html").unlink()
        lock = os.open(self.out, os.O_RDONLY)
        fcntl.flock(lock, fcntl.LOCK_EX)
        self.refuse(words=["another run of hpvi", "wait until that run is over"])
        os.close(lock)
        kept = (self.out / "summary.json").read_text()
        for text, word in (("{}", "not one of hpvi"), (json.dumps({**json.loads(kept), "steps": 9}), "fewer steps")):
            (self.out / "summary.json").write_text(text)
            self.refuse(words=["--report", word])
        (self.out / "summary.json").write_text(kept)
        vtu = self.out / "solution-04.vtu"
        whole = vtu.read_text()
        for spoilt in (whole[:3000], whole.replace('Name="von_mises"', 'Name="other"')):
            vtu.write_text(spoilt)
            self.afterwards()
            self.assertIn("solution-04.vtu cannot be drawn", self.page())
        (self.out / "scene.prm").unlink()
        self.refuse(words=["has no scene.prm"])


if __name__ == "__main__":
    unittest.main()
