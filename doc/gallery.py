#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run every scene of prm/ and draw what it says and what it ends with: doc/gallery/SCENE-scene.svg, as `hpvi --picture` draws it
in the plane, and SCENE.png, by hpvi.plot. Scenes of others are drawn into DIR.

gallery.py --program build/hpvi --output DIR [--draw] [SCENE.prm...]

--draw draws what an earlier call has left in DIR, and runs nothing.
"""
import argparse
import os
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
GALLERY = ROOT / "doc/gallery"


def call(program, scene, output, *options):
    return subprocess.run([program, *options, "--output", output, scene], stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, text=True, env={"OMP_NUM_THREADS": "1", **os.environ})


def solve(program, scene, output):
    """The picture first: a run lets it stay."""
    for options in (["--picture"], []):
        done = call(program, scene, output / scene.stem, *options)
        if done.returncode != 0:
            sys.exit(f"{scene}: {done.stderr.strip()}")


def folder(scene, output):
    """Pictures of the shipped scenes are part of the manual, those of others are not."""
    return GALLERY if scene.resolve().parent == ROOT / "prm" else output


def draw(scene, run, output, plot, contacts):
    """Stress on the deformed body with its contact; in space beside it the states of the first contact and its friction."""
    pyplot = plot.pyplot
    has_surface = run.dimension == 3 and bool(run.contact)
    with pyplot.rc_context(plot.STYLE):
        figure, places = pyplot.subplots(1, 1 + has_surface, figsize=(7.4, 4.1) if has_surface else (3.9, 4.1), layout="constrained", squeeze=False)
        plot.body(run, places[0][0])
        if has_surface:
            plot.surface(run, places[0][1], next(iter(contacts(run.contact))), what="state")
        figure.suptitle(scene.stem, fontsize=10)
        picture = folder(scene, output) / f"{scene.stem}.png"
        picture.parent.mkdir(parents=True, exist_ok=True)
        figure.savefig(picture, dpi=130, bbox_inches="tight", metadata={"Software": None})
        pyplot.close(figure)
    shutil.copyfile(run.directory / "scene.svg", folder(scene, output) / f"{scene.stem}-scene.svg")
    print(f"  {picture}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", required=True, type=pathlib.Path)
    parser.add_argument("--output", required=True, type=pathlib.Path)
    parser.add_argument("--draw", action="store_true", help="draw what an earlier call has left")
    parser.add_argument("scenes", nargs="*", type=pathlib.Path)
    options = parser.parse_args()
    sys.path.insert(0, str(options.program.resolve().parent / "python"))
    import matplotlib
    matplotlib.use("Agg")
    from hpvi import plot, results
    for scene in options.scenes or sorted((ROOT / "prm").glob("*.prm")):
        if not options.draw:
            solve(options.program.resolve(), scene, options.output)
        draw(scene, results.Run(options.output / scene.stem), options.output, plot, results.contacts)


if __name__ == "__main__":
    main()
