# SPDX-License-Identifier: LGPL-2.1-or-later
"""report.py HPVI: report.html is valid, needs nothing but itself, holds the numbers of summary.json, and is the same whether a run
writes it or --report afterwards."""

import fcntl
import json
import math
import os
import re
import subprocess
import unittest

import html5lib

from runs import ENVIRONMENT, PROGRAM, SCENES, RunTest

SHORT = "Adaptivity/Maximum steps=4"
# Of each kind: a bound, a load history, two bodies, a plate, space.
SCENES_OF_ALL_KINDS = (
    ("han-6-12", SHORT), ("fretting", "Loading/Steps=4", "Adaptivity/Maximum steps=2"), ("blocks", "Adaptivity/Maximum steps=1"),
    ("punch-plate", "Adaptivity/Maximum steps=1"),
    ("dome", "Adaptivity/Maximum steps=1"))
# Members of summary.json whose numbers the page shows with six digits.
SHOWN = (("final", "elements"), ("final", "dofs_free"), ("final", "multipliers"), ("final", "energy"), ("contact",), ("forces",),
         ("largest_displacement",), ("loading",), ("error_bound", "energy"), ("plates",))
# Beside a force with an interval its value has so many digits as that; areas and tensors of contact are zones there.
HIDDEN = {"normal_resultant", "friction_resultant", "area", "open_area", "slipping_area", "moments_about", "length", "moment", "loads",
          "through"}


def numbers_in(value, key=""):
    if key in HIDDEN:
        return
    if isinstance(value, dict):
        for name, part in value.items():
            yield from numbers_in(part, name)
    elif isinstance(value, list):
        for part in value:
            yield from numbers_in(part, key)
    elif isinstance(value, (int, float)) and value is not None and not isinstance(value, bool):
        yield value


def words_of(page):
    """All that a reader sees, without the scene file."""
    short = re.sub(r'base64,[A-Za-z0-9+/=]+|(?<= d=")[^"]+', "", page)  # so much of it is pictures that reading them takes seconds
    tree = html5lib.HTMLParser(strict=True, namespaceHTMLElements=False).parse(short)
    for parent in tree.iter():
        for child in list(parent):
            if child.tag in ("style", "pre"):
                parent.remove(child)
    return " ".join(tree.itertext())


class Report(RunTest):
    def page(self):
        return (self.out / "report.html").read_text()

    def afterwards(self, *more, status=0, directory=None):
        done = subprocess.run([PROGRAM, "--report", directory or self.out, *more], capture_output=True, text=True, env=ENVIRONMENT,
                              check=False, timeout=100)
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 0 if status == 0 else 1, done.stderr)
        return done.stderr or done.stdout

    def refuse(self, *more, words, **options):
        line = self.afterwards(*more, status=1, **options)
        for word in words:
            self.assertIn(word, line)

    def check_page(self):
        page = self.page()
        self.assertLess(len(page), 1_000_000)
        for word in ("<script", "<link", "@import", "url("):
            self.assertNotIn(word, page)
        self.assertEqual(set(re.findall(r'\S*https?:[^"\s]*', page)) - {'xmlns="http://www.w3.org/2000/svg'}, set())
        words = words_of(page)
        found = {float(word) for word in re.findall(r"-?\d+\.?\d*(?:[eE][-+]?\d+)?", words)}
        summary = self.summary()
        for path in SHOWN:
            value = summary
            for name in path:
                value = (value or {}).get(name)
            if path == ("forces",) and summary["error_bound"]:
                continue  # with intervals, and as many digits as these say
            for number in numbers_in(value):
                small = abs(number) < 1e-9  # round-off of another digit on each machine
                self.assertTrue(small or any(math.isclose(number, shown, rel_tol=1e-5) for shown in found), (path, number))
        for warning in summary["warnings"]:
            self.assertIn(" ".join(warning.split()), " ".join(words.split()))
        return page, summary

    def test_of_all_kinds(self):
        for scene, *settings in SCENES_OF_ALL_KINDS:
            with self.subTest(scene):
                self.run_scene(*settings, scene=SCENES / f"{scene}.prm")
                page, summary = self.check_page()
                self.assertIn("report.html", self.files())
                self.assertIn("Done: ", page)
                self.assertGreaterEqual(page.count("<figure>"), 3 if scene == "dome" else 4)
                bound = summary["error_bound"]
                self.assertEqual(bool(bound), "guaranteed" in page.split("<h2>The scene")[0].split("no bound")[0])
                if bound:
                    said = float(re.search(r"error is at most (\S+) % of the solution, guaranteed", page)[1])
                    self.assertGreaterEqual(said, 100 * bound["relative"])
                    self.assertLess(said, 111 * bound["relative"])
                # One source: what the files hold tells the same.
                self.assertIn(f"report in {self.out}/report.html", self.afterwards())
                self.assertEqual(self.page(), page)

    def test_equal_runs_differ_in_one_line(self):
        pages = []
        for _ in range(2):
            self.run_scene(SHORT)
            pages.append(self.page().splitlines())
        self.assertEqual(len(pages[0]), len(pages[1]))
        different = [one for one, other in zip(*pages) if one != other]
        self.assertEqual([line[:17] for line in different], ['<p class="times">'])

    def test_what_was_switched_off_is_said(self):
        self.run_scene(SHORT, "Output/VTU=false", "Output/Mesh picture=false", "Output/Contact tables=false", "Error/Bound=false")
        page, _ = self.check_page()
        for entry in ("Output/VTU = true", "Output/Mesh picture = true", "Output/Contact tables = true"):
            self.assertIn(entry, page)
        self.assertNotIn("guaranteed", page.split("<h2>The scene")[0].replace("No bound is guaranteed", ""))
        self.run_scene(SHORT, "Output/Report=false")
        # Made by another command it is known by itself, and goes with the run of which it tells.
        self.afterwards()
        self.assertNotIn("report.html", self.files())
        self.run_scene(SHORT, "Output/Report=false")
        self.assertNotIn("report.html", self.names())

    def test_a_failed_run_comes_first(self):
        self.run_scene("Solver/QP maximum multiplications=20", "Solver/QP solver=mprgp", "Solver/QP warm start=false", status=2)
        self.assertEqual(self.summary()["status"], "failed")
        self.assertIn("report.html", self.files())
        page = self.page()
        words_of(page)
        self.assertIn('<p class="failed">This run failed: ', page)
        self.assertLess(page.index("This run failed"), page.index("<h2>"))
        self.assertIn("no result", page.split("<h2>")[0])
        self.assertNotIn("Done", page)

    def test_a_killed_run_comes_first(self):
        self.end(self.stopped("Adaptivity/Maximum steps=9", rows=3))
        self.assertNotIn("report.html", self.names())
        self.afterwards()
        self.assertIn("did not come to its end", self.page().split("<h2>")[0])
        self.assertIn("<h2>The answer</h2>", self.page())

    def test_what_is_no_run_is_refused(self):
        self.refuse(directory=self.home / "none", words=["--report", "has no summary.json", "name the directory"])
        self.run_scene(SHORT, "Output/Report=false")
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
