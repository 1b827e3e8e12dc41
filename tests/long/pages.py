# SPDX-License-Identifier: LGPL-2.1-or-later
"""pages.py HPVI DIR [--runs RUNS]: of all scenes of prm/ picture and report: no words lie on each other or are below 9 pixels, and the page prints on two
sheets. DIR gets screenshots of the pages, 1000 and 400 pixels wide, for whoever changes them to look at. RUNS has runs of the scenes by their names; without
it each is solved in few steps."""

import argparse
import json
import pathlib
import subprocess
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import weasyprint

TESTS = pathlib.Path(__file__).resolve().parents[1]
SCENES = TESTS.parent / "prm"
WIDTHS = (1000, 400)
BROWSER = ["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars"]


def solve(program, scene, home):
    is_history = "subsection Loading" in scene.read_text()
    settings = ["Adaptivity/Maximum steps=3"] + ["Loading/Steps=3"] * is_history
    line = [program, "--output", home / scene.stem, scene, *(word for setting in settings for word in ("--set", setting))]
    subprocess.run(line, stdout=subprocess.DEVNULL, check=True)


def shoot(page, home):
    """Screenshots, cut below the last line that is not white."""
    for width in WIDTHS:
        file = home / f"{page.parent.name}-{width}.png"
        subprocess.run([*BROWSER, f"--window-size={width},7000", f"--screenshot={file}", page.as_uri()], capture_output=True, timeout=120, check=True)
        pixels = plt.imread(file)
        last = (pixels[..., :3] < 1).any(axis=(1, 2)).nonzero()[0].max()
        plt.imsave(file, pixels[:last + 20])


def complaints(program, scene, directory):
    from crowded import watched
    from hpvi import plot, report, results
    subprocess.run([program, "--report", directory], stdout=subprocess.DEVNULL, check=True)
    with watched() as found:
        text = report.page(results.Run(directory))
    with watched(is_on_page=False) as of_picture:
        data = json.loads((directory / "scene.json").read_text())
        if data["dimension"] == 2:
            plot.scene_svg(data)
    n = len(weasyprint.HTML(string=text).render().pages)
    return found + of_picture + ([f"prints on {n} sheets"] if n > 2 else [])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("--runs", type=pathlib.Path)
    parser.add_argument("--only", nargs="*", default=[], help="names of scenes")
    options = parser.parse_args()
    program, output = options.program.resolve(), options.output.resolve()
    sys.path[:0] = [str(program.parent / "python"), str(TESTS)]
    output.mkdir(parents=True, exist_ok=True)
    n_wrong = 0
    for scene in sorted(SCENES.glob("*.prm")):
        if options.only and scene.stem not in options.only:
            continue
        if not options.runs:
            solve(program, scene, output / "runs")
        directory = (options.runs or output / "runs") / scene.stem
        found = complaints(program, scene, directory)
        shoot(directory / "report.html", output)
        for line in found:
            print(f"{scene.name}: {line}", flush=True)
        n_wrong += bool(found)
    print(f"screenshots of all pages are in {output}, {n_wrong} pages are wrong")
    sys.exit(n_wrong > 0)


if __name__ == "__main__":
    main()
