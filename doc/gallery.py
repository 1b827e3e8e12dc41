#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run every scene of prm/ and draw what it ends with: doc/gallery/SCENE.png. Scenes of others are drawn into DIR.

gallery.py --program build/hpvi --output DIR [SCENE.prm...]
"""
import argparse
import os
import pathlib
import subprocess
import sys

import numpy as np

from figures import Patches, Run, deformation_scale, plt, read_csv, stress_limit

ROOT = pathlib.Path(__file__).resolve().parent.parent
GALLERY = ROOT / "doc/gallery"
STATES = {"open": "#999999", "slip": "#d55e00", "stick": "#56b4e9"}


def solve(program, scene, output):
    directory = output / scene.stem
    done = subprocess.run([program, "--output", directory, scene], stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, text=True,
                          env={"OMP_NUM_THREADS": "1", **os.environ})
    if done.returncode != 0:
        sys.exit(f"{scene}: {done.stderr.strip()}")
    return Run(directory)


def states_of(rows):
    return [STATES[row["state"]] for row in rows]


def draw_body(axes, run):
    """Von Mises stress on the deformed body, and what happens at the Gauss points of the contact."""
    patches = Patches(run)
    scale = deformation_scale(patches)
    x = patches.points + scale * patches.displacement
    for cell, stress in zip(x, patches.von_mises):
        axes.pcolormesh(cell[..., 0], cell[..., 1], stress, cmap="viridis", shading="gouraud",
                        vmin=0, vmax=stress_limit(patches), rasterized=True)
    rows = read_csv(run.last("contact", "csv"))
    points = np.array([[float(row["x"]), float(row["y"])] for row in rows])
    all_points, moved = patches.points.reshape(-1, 2), x.reshape(-1, 2)
    nearest = [np.argmin(((all_points - point) ** 2).sum(axis=1)) for point in points]
    points += moved[nearest] - all_points[nearest]
    axes.scatter(points[:, 0], points[:, 1], s=6, c=states_of(rows), linewidths=0, zorder=3)
    axes.set_aspect("equal", adjustable="datalim")
    return f"displacement × {scale:g}" if scale != 1 else ""


def draw_foundation(axes, run):
    """A body in space: the contact seen from above, with the friction on it."""
    rows = read_csv(run.last("contact", "csv"))
    x, z, t_x, t_z = (np.array([float(row[name]) for row in rows]) for name in (
        "x", "z", "tangential_traction_x", "tangential_traction_z"))
    axes.scatter(x, z, s=9, c=states_of(rows), linewidths=0)
    axes.quiver(x, z, t_x, t_z, width=0.004, color="#333333")
    axes.set_aspect("equal", adjustable="datalim")
    return "friction on the bottom, from above"


def folder(scene, output):
    """Pictures of the shipped scenes are part of the manual, those of others are not."""
    return GALLERY if scene.resolve().parent == ROOT / "prm" else output


def draw(scene, run, output):
    figure, axes = plt.subplots(figsize=(3.6, 2.7), constrained_layout=True)
    is_flat = "z" not in read_csv(run.last("contact", "csv"))[0]
    note = (draw_body if is_flat else draw_foundation)(axes, run)
    axes.set_axis_off()
    axes.set_title(scene.stem + (f"\n{note}" if note else ""), fontsize=8)
    picture = folder(scene, output) / f"{scene.stem}.png"
    picture.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(picture, dpi=110, metadata={"Software": None})
    plt.close(figure)
    print(f"  {picture}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", required=True, type=pathlib.Path)
    parser.add_argument("--output", required=True, type=pathlib.Path)
    parser.add_argument("scenes", nargs="*", type=pathlib.Path)
    options = parser.parse_args()
    for scene in options.scenes or sorted((ROOT / "prm").glob("*.prm")):
        draw(scene, solve(options.program.resolve(), scene, options.output), options.output)


if __name__ == "__main__":
    main()
