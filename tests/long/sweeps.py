# SPDX-License-Identifier: LGPL-2.1-or-later
"""sweeps.py HPVI: two runs of each plane scene of prm/ at the same time leave what one leaves alone, byte by byte but for times: what
would meet in two threads of all that scenes can say."""

import pathlib
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "scenes"))
PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
from runs import ENVIRONMENT, SCENES  # which takes the argument
from sweeps import without_times


def differences(scene, home):
    is_history = "subsection Loading" in scene.read_text()
    settings = ("Loading/Steps=3", "Adaptivity/Maximum steps=2") if is_history else ("Adaptivity/Maximum steps=5",)
    line = [PROGRAM, scene, *(word for setting in settings for word in ("--set", setting))]
    for more in (["--output", home / "swept", "--sweep", "Title=a, b"], ["--output", home / "alone", "--set", "Title=a"]):
        subprocess.run([*line, *more], stdout=subprocess.DEVNULL, env=ENVIRONMENT, check=True)
    together, alone = without_times(home / "swept/Title=a"), without_times(home / "alone")
    return [name for name in sorted(together.keys() | alone.keys()) if together.get(name) != alone.get(name)]


def main():
    scenes = [scene for scene in sorted(SCENES.glob("*.prm")) if "Dimension = 3" not in scene.read_text()]
    n_different = 0
    for scene in scenes:
        home = pathlib.Path(tempfile.mkdtemp())
        if found := differences(scene, home):
            print(f"{scene.name}: {', '.join(found)} of two threads differ from those of one")
            n_different += 1
        shutil.rmtree(home)
    print(f"{len(scenes)} scenes in two threads, {n_different} differ from one alone")
    sys.exit(n_different > 0)


if __name__ == "__main__":
    main()
