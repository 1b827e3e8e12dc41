# SPDX-License-Identifier: LGPL-2.1-or-later
"""output_directory.py HPVI: a run removes and overwrites what the program has written, nothing
else, nothing that it reads, and nothing of a run that is still going on."""

import json
import shutil
import unittest

from runs import RunTest, result_names

QUIET = ("Output/VTU=false", "Output/Contact tables=false")
SHORT = "Adaptivity/Maximum steps=2"
LONG = "Adaptivity/Maximum steps=4"


class OutputDirectory(RunTest):
    def refuse(self, *settings, words, **options):
        before = self.contents()
        line = self.run_scene(*settings, status=1, **options)
        for word in words:
            self.assertIn(word, line)
        self.assertEqual(self.contents(), before)

    def test_results_of_a_longer_run_do_not_stay(self):
        self.run_scene(LONG)
        self.assertEqual(self.check_whole(), 4)
        self.run_scene(SHORT)
        self.assertEqual(self.check_whole(), 2)
        self.run_scene(SHORT, *QUIET)
        self.assertEqual(self.names(), ["convergence.csv", "degrees.csv", "forces.csv", "scene.prm",
                                        "state.dat", "summary.json"])

    def test_foreign_files_stay(self):
        self.out.mkdir()
        foreign = {"notes.txt": "mine", "contact.csv": "mine", "mesh-1.svg": "mine",
                   "scene.prm.tmp": "mine", "reference.dat": "mine"}
        for name, text in foreign.items():
            (self.out / name).write_text(text)
        for _ in range(2):
            self.run_scene(SHORT)
            self.assertEqual(self.names(), sorted(result_names(2) + list(foreign)))
            for name, text in foreign.items():
                self.assertEqual((self.out / name).read_text(), text)

    def test_a_foreign_file_of_a_results_name_is_refused(self):
        self.out.mkdir()
        for name in ("scene.prm", "convergence.csv", "degrees.csv", "forces.csv", "contact-17.csv",
                     "solution-01.vtu", "solution.pvd", "contact-17.vtu", "contact.pvd"):
            (self.out / name).write_text("mine")
            self.refuse(words=[f"output directory '{self.out}'", name, "--output"])
            (self.out / name).unlink()
        for text in ("mine", '{"program": "other", "files": ["summary.json"]}', "[]", ""):
            (self.out / "summary.json").write_text(text)
            self.refuse(words=["summary.json would be overwritten"])
        (self.out / "summary.json").unlink()
        (self.out / "degrees.csv").symlink_to("nowhere")
        line = self.run_scene(status=1)
        self.assertIn("degrees.csv", line)
        self.assertEqual(self.names(), ["degrees.csv"])

    def test_a_name_that_this_run_does_not_write_is_no_obstacle(self):
        self.out.mkdir()
        names = ("contact-01.csv", "contact-01.vtu", "contact.pvd", "mesh-01.svg", "solution-01.vtu", "solution.pvd",
                 "reference.dat")
        for name in names:
            (self.out / name).write_text("mine")
        self.run_scene(SHORT, *QUIET)
        for name in names:
            self.assertEqual((self.out / name).read_text(), "mine")
        self.refuse(SHORT, *QUIET, "Output/Reference solution=true", words=["reference.dat"])

    def test_the_list_reaches_no_other_file(self):
        self.run_scene(SHORT)
        summary = self.summary()
        summary["files"] += ["notes.txt", "../victim", "sub/contact-01.csv"]
        (self.out / "summary.json").write_text(json.dumps(summary))
        (self.out / "sub").mkdir()
        victims = (self.out / "notes.txt", self.home / "victim", self.out / "sub/contact-01.csv")
        for victim in victims:
            victim.write_text("mine")
        self.run_scene(SHORT)
        for victim in victims:
            self.assertEqual(victim.read_text(), "mine")

    def test_a_file_that_was_added_later_is_refused(self):
        self.run_scene(SHORT)
        (self.out / "contact-03.csv").write_text("mine")
        self.refuse(LONG, words=["contact-03.csv"])

    def test_results_of_the_former_version_are_known_by_name(self):
        self.run_scene(LONG)
        summary = self.summary()
        del summary["files"]
        (self.out / "summary.json").write_text(json.dumps(summary))
        (self.out / "contact-05.csv.tmp").write_text("cut short")
        self.run_scene(SHORT)
        self.assertEqual(self.check_whole(), 2)
        summary["program"] = "another 1.0"
        (self.out / "summary.json").write_text(json.dumps(summary))
        self.refuse(words=["no summary.json says"])

    def test_a_link_in_the_place_of_a_partial_file_is_not_followed(self):
        self.out.mkdir()
        (self.home / "victim").write_text("mine")
        (self.out / ".hpvi.tmp").symlink_to(self.home / "victim")
        self.run_scene(SHORT)
        self.assertEqual((self.home / "victim").read_text(), "mine")
        self.assertEqual(self.check_whole(), 2)

    def test_what_the_run_reads_stays(self):
        reference = f"Error/Reference solution={self.out / 'reference.dat'}"
        self.run_scene(LONG, "Output/Reference solution=true")
        stored = (self.out / "reference.dat").read_bytes()
        for _ in range(2):
            self.run_scene(SHORT, reference)
            self.assertEqual((self.out / "reference.dat").read_bytes(), stored)
            self.assertGreater(float(self.rows()[0]["error_relative"]), 1e-4)
            self.assertEqual(self.names(), sorted(result_names(2) + ["reference.dat"]))
        self.refuse(SHORT, reference, "Output/Reference solution=true",
                    words=["the run reads its reference.dat"])
        self.run_scene(SHORT)
        self.assertEqual(self.check_whole(), 2)

    def test_the_scene_stays(self):
        self.run_scene(SHORT)
        self.refuse(scene=self.out / "scene.prm", words=["the run reads its scene.prm"])
        shutil.copy(self.scene, self.out / "mine.prm")
        self.run_scene(SHORT, scene=self.out / "mine.prm")
        self.assertEqual((self.out / "mine.prm").read_bytes(), self.scene.read_bytes())

    def test_results_of_another_scene_file_are_named(self):
        first, second = self.home / "a/case.prm", self.home / "b/case.prm"
        for scene in (first, second):
            scene.parent.mkdir()
            shutil.copy(self.bar(), scene)
        self.assertNotIn("replaces", self.run_scene(scene=first))
        self.assertEqual(self.summary()["scene_file"], str(first))
        self.assertNotIn("replaces", self.run_scene(scene=first))
        again = self.home / "again.prm"
        again.symlink_to(first)
        self.assertNotIn("replaces", self.run_scene(scene=again))
        self.assertIn(f"\nnote: replaces the results of {again} in {self.out}\n", self.run_scene(scene=second))
        self.assertEqual(self.summary()["scene_file"], str(second))

    def test_steps_are_listed_as_ranges(self):
        self.run_scene(LONG)
        self.assertEqual(self.summary()["files"],
                         ["contact-{01..04}.csv", "contact-{01..04}.vtu", "contact.pvd", "convergence.csv", "degrees.csv", "forces.csv",
                          "scene.prm", "solution-{01..04}.vtu", "solution.pvd", "state.dat", "summary.json"])

    def test_the_last_step_alone(self):
        last = "Output/Steps=last"
        self.run_scene(LONG)
        every = self.contents()
        self.run_scene(LONG, last)
        self.assertEqual(self.names(), [name for name in result_names(4) if "0" not in name or "04" in name])
        self.assertEqual(self.files(), self.names())
        self.assertEqual(len(self.rows()), 4)
        for name in ("contact-04.csv", "solution-04.vtu", "degrees.csv"):
            self.assertEqual((self.out / name).read_bytes(), every[name])
        self.assertEqual((self.out / "solution.pvd").read_text().count("solution-"), 1)
        self.assertEqual((self.out / "contact.pvd").read_text().count("contact-04.vtu"), 1)
        self.refuse(last + "s", words=["all or last"])
        run = self.stopped("Adaptivity/Maximum steps=9", last, rows=3)
        run.kill()
        run.communicate()
        steps = len(self.rows())
        self.assertGreaterEqual(steps, 2)
        for name in (f"contact-{steps:02}.csv", f"solution-{steps:02}.vtu"):
            self.assertIn(name, self.names())
        self.assertNotIn("contact-01.csv", self.names())

    def test_the_primal_path_has_results_like_others(self):
        primal = ("Solver/Path=primal", "Adaptivity/Method=hup2")
        self.run_scene(*primal, LONG, "Output/Steps=last")
        self.assertEqual([name for name in self.names() if name.startswith("solution")],
                         ["solution-04.vtu", "solution.pvd"])
        self.run_scene(*primal, LONG)
        self.assertEqual(self.files(), self.names())
        self.run_scene(*primal, SHORT)
        self.assertEqual(self.files(), self.names())
        self.assertNotIn("solution-03.vtu", self.names())
        self.run_scene(SHORT)
        self.assertEqual(self.check_whole(), 2)

    def test_a_second_run_is_refused_and_a_kill_leaves_no_lock(self):
        first = self.stopped("Adaptivity/Maximum steps=9", rows=3)
        self.refuse(SHORT, words=["another run of hpvi"])
        first.kill()
        first.communicate()
        listed = self.files()
        self.assertEqual(self.summary()["status"], "running")
        self.assertGreaterEqual(self.summary()["steps"], 2)
        self.assertLessEqual(set(self.names()) - {".hpvi.tmp"}, set(listed))
        self.run_scene(SHORT)
        self.assertEqual(self.check_whole(), 2)


if __name__ == "__main__":
    unittest.main()
