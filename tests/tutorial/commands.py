# SPDX-License-Identifier: LGPL-2.1-or-later
"""commands.py ROOT: ./run tells a copied checkout from its original, CMake refuses a deal.II of another version, and pictures of a
user's scene stay out of the manual."""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv.pop(1)).resolve()


class Run(unittest.TestCase):
    def setUp(self):
        self.home = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.home)
        shutil.copy(ROOT / "run", self.home)

    def refuse(self, build, *arguments):
        (self.home / build).mkdir(parents=True)
        (self.home / build / "CMakeCache.txt").write_text(
            "CMAKE_BUILD_TYPE:STRING=Release\nCMAKE_HOME_DIRECTORY:INTERNAL=/elsewhere\n")
        done = subprocess.run([self.home / "run", *arguments], capture_output=True, text=True, cwd="/", timeout=60)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertEqual(done.stderr, f"run: {build} was made for the sources in /elsewhere, and these are in "
                                      f"{self.home}; remove it: rm -r {self.home}/{build}\n")

    def test_a_copied_build_directory_is_named(self):
        self.refuse("build", "prm/han-6-12.prm")

    def test_that_of_the_tutorial_too(self):
        self.refuse("build/tutorial", "tutorial")

    def test_one_that_fits_is_none_of_them(self):
        script = (self.home / "run").read_text().split("\nbuild()")[0] + '\nfits "$1" "$2" && echo fits\n'
        (self.home / "build").mkdir()
        (self.home / "build/CMakeCache.txt").write_text(f"CMAKE_HOME_DIRECTORY:INTERNAL={self.home}\n")
        for build in ("build", "none"):
            done = subprocess.run(["bash", "-c", script, self.home / "run", build, "."], capture_output=True, text=True)
            self.assertEqual((done.stdout, done.stderr), ("fits\n", ""))


class DealII(unittest.TestCase):
    def test_another_version_is_refused(self):
        home = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, home)
        (home / "deal.IIConfigVersion.cmake").write_text("set(PACKAGE_VERSION 9.5.2)\nset(PACKAGE_VERSION_COMPATIBLE TRUE)\n")
        (home / "deal.IIConfig.cmake").write_text('set(DEAL_II_PACKAGE_VERSION 9.5.2)\nset(DEAL_II_PATH /other)\n')
        done = subprocess.run(["cmake", "-S", ROOT, "-B", home / "build", f"-DDEAL_II_DIR={home}"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn("hpvi needs deal.II 9.4, and deal.II 9.5.2 is in /other;", " ".join(done.stderr.split()))


class Gallery(unittest.TestCase):
    def test_pictures_of_others_are_no_part_of_the_manual(self):
        sys.path.insert(0, str(ROOT / "doc"))
        import gallery
        output = pathlib.Path("output/gallery")
        self.assertEqual(gallery.folder(ROOT / "prm/dome.prm", output), ROOT / "doc/gallery")
        self.assertEqual(gallery.folder(pathlib.Path("my.prm"), output), output)


if __name__ == "__main__":
    unittest.main()
