#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run every scene of prm/ and draw what it says and what it ends with: doc/gallery/SCENE-scene.svg, as `hpvi --picture` draws it
in the plane, and SCENE.png. Scenes of others are drawn into DIR.

gallery.py --program build/hpvi --output DIR [--draw] [SCENE.prm...]

--draw draws what an earlier call has left in DIR, and runs nothing.
"""
import argparse
import os
import pathlib
import shutil
import subprocess
import sys

import numpy as np

from figures import (Line2D, Patches, Run, array, deformation_scale, plt, read_csv, scale_text,
                     stress_limit)

ROOT = pathlib.Path(__file__).resolve().parent.parent
GALLERY = ROOT / "doc/gallery"
STATES = {"open": "#999999", "slip": "#d55e00", "stick": "#56b4e9"}
# Bodies in space are seen from below, for there the contact is: where x, y and z lie on the paper.
PAPER = ((0.85, 0., 0.53), (-0.21, 0.92, 0.33))


def call(program, scene, output, *options):
    return subprocess.run([program, *options, "--output", output / scene.stem, scene], stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, text=True, env={"OMP_NUM_THREADS": "1", **os.environ})


def solve(program, scene, output):
    """The picture first: a run lets it stay. Bodies in space have none."""
    for options in (["--picture"], []):
        done = call(program, scene, output, *options)
        if done.returncode != 0 and not (options and "Dimension = 3" in done.stderr):
            sys.exit(f"{scene}: {done.stderr.strip()}")


def label(name, unit, kind):
    """A scene that names no unit has its own."""
    return f"{name} [{unit or 'unit of ' + kind}]"


def add_stress_bar(figure, axes, colours, run, is_cut, **place):
    bar = figure.colorbar(colours, ax=axes, extend="max" if is_cut else "neither", aspect=30, pad=0.03,
                          **place)
    bar.set_label(label("von Mises stress", run.stress, "stress"))
    bar.locator = plt.MaxNLocator(5)
    bar.update_ticks()


def add_key(figure, rows):
    """Which states the contact has, and their colours."""
    present = {row["state"] for row in rows}
    figure.legend(handles=[Line2D([], [], color=colour, linewidth=4, label=state)
                           for state, colour in STATES.items() if state in present],
                  loc="lower center", ncol=3, frameon=False, handlelength=1.2)
    height = 0.33 / figure.get_figheight()
    figure.get_layout_engine().set(rect=(0, height, 1, 1 - height))


def tidy(axes, names, run):
    axes.set_aspect("equal")
    axes.grid(False)
    axes.locator_params(nbins=5)
    axes.set(xlabel=label(names[0], run.length, "length"), ylabel=label(names[1], run.length, "length"))


# ------------------------------------------------------------------ in the plane


def node_of(row, point, resting, displacement):
    """Where the body of `boundary` is near to a point: of two bodies at one place that which moves as the row says."""
    distances = ((resting - point) ** 2).sum(axis=1)
    if not row.get("master"):
        return np.argmin(distances)
    near = np.argsort(distances)[:16]
    size = np.hypot(float(row["normal_displacement"]), float(row["tangential_displacement"]))
    misses = np.abs(np.hypot(*displacement[near].T) - size)
    return near[np.argmax(misses <= 2 * misses.min() + 1e-9 * size)]


def draw_contact(axes, rows, patches, moved):
    """The state of each Gauss point along its boundary, as far as halfway to its neighbours."""
    points = np.array([[float(row["x"]), float(row["y"])] for row in rows])
    resting, displacement = patches.points.reshape(-1, 2), patches.displacement.reshape(-1, 2)
    nearest = [node_of(row, point, resting, displacement) for row, point in zip(rows, points)]
    points += moved.reshape(-1, 2)[nearest] - resting[nearest]
    for boundary in {row["boundary"] for row in rows}:
        of_it = [k for k, row in enumerate(rows) if row["boundary"] == boundary]
        ends = np.concatenate([points[of_it[:1]], (points[of_it[:-1]] + points[of_it[1:]]) / 2, points[of_it[-1:]]])
        if len(of_it) > 3 and np.hypot(*(ends[-1] - ends[0])) < 2 * np.hypot(*np.diff(ends, axis=0).T).max():  # it is closed
            ends[[0, -1]] = (ends[0] + ends[-1]) / 2
        axes.plot(*ends.T, color="white", linewidth=7, zorder=3, solid_capstyle="butt", clip_on=False)
        states = [rows[k]["state"] for k in of_it]
        changes = [k for k in range(1, len(states)) if states[k] != states[k - 1]]
        for first, last in zip([0, *changes], [*changes, len(states)]):
            axes.plot(*ends[first:last + 1].T, color=STATES[states[first]], linewidth=4, zorder=4,
                      solid_capstyle="butt", clip_on=False)


def draw_body(run, rows):
    """Von Mises stress on the deformed body, and what happens along its contact."""
    patches = Patches(run)
    scale = deformation_scale(patches)
    moved = patches.points + scale * patches.displacement
    width, height = np.ptp(moved.reshape(-1, 2), axis=0)
    figure, axes = plt.subplots(figsize=(3.7, 2 + min(2.4, 2.9 * height / width)), layout="constrained")
    limit = stress_limit(patches)
    for cell, stress in zip(moved, patches.von_mises):
        colours = axes.pcolormesh(cell[..., 0], cell[..., 1], stress, cmap="viridis",
                                  shading="gouraud", vmin=0, vmax=limit, rasterized=True)
    if rows:
        draw_contact(axes, rows, patches, moved)
    for frame, low, high in zip((axes.set_xlim, axes.set_ylim), moved.min(axis=(0, 1, 2)), moved.max(axis=(0, 1, 2))):
        frame(low - 0.04 * max(width, height), high + 0.04 * max(width, height))
    tidy(axes, "xy", run)
    add_stress_bar(figure, axes, colours, run, patches.von_mises.max() > limit, location="bottom")
    return figure, scale


# ------------------------------------------------------------------ in space


class Box:
    """The cells of a body in space: (n+1)^3 points each, x fastest, from all pieces of the last step."""

    def __init__(self, run):
        pieces = [path.read_text(encoding="latin-1")
                  for path in sorted(run.directory.glob(f"solution-{run.steps:02d}*.vtu"))]
        cells = int(run.rows[-1]["elements"])
        for name, mark in (("points", "<Points>"), ("displacement", 'Name="displacement"'),
                           ("von_mises", 'Name="von_mises"')):
            values = np.concatenate([array(piece, mark) for piece in pieces])
            side = round((len(values) / cells) ** (1 / 3))
            setattr(self, name, values.reshape(cells, side, side, side, values.shape[1]))

    def faces_in_view(self):
        """Those of the surface that look to the viewer, the farthest first: places, displacements and stresses of their points."""
        viewer = np.cross(*PAPER)
        weights = np.linspace(0, 1, 5)  # of the places where a face of half the size may have its middle or corners
        owners, faces = {}, []
        low, size = self.points.min(axis=(0, 1, 2, 3)), np.ptp(self.points)

        def key(place):  # 0.317: no place of a bisected mesh lies where two keys meet
            return tuple(np.floor(1e5 * (place - low) / size + 0.317))

        for cell, points in enumerate(self.points):
            middle = points.mean(axis=(0, 1, 2))
            for axis in range(3):
                for end in (0, -1):
                    index = [slice(None)] * 3
                    index[2 - axis] = end
                    x = points[tuple(index)]
                    (a, b), (c, d) = x[[0, -1]][:, [0, -1]]
                    for s in weights:
                        for t in weights:
                            place = (1 - t) * ((1 - s) * a + s * b) + t * ((1 - s) * c + s * d)
                            owners.setdefault(key(place), set()).add(cell)
                    centre, normal = (a + b + c + d) / 4, np.cross(b - a, c - a)
                    normal *= np.sign(normal @ (centre - middle))
                    if normal @ viewer > 1e-9 * np.linalg.norm(normal):
                        faces.append((centre @ viewer, key(centre), (cell, *index)))
        on_surface = sorted(((depth, face) for depth, centre, face in faces if len(owners[centre]) == 1),
                            key=lambda entry: entry[0])
        return [[values[face] for values in (self.points, self.displacement, self.von_mises)] for _, face in on_surface]


def on_paper(x):
    return x @ np.array(PAPER).T


def name_edges(axes, box, drawn):
    """Below and to the right of what is drawn of the body: where it begins and ends in each direction."""
    low, high = box.points.min(axis=(0, 1, 2, 3)), box.points.max(axis=(0, 1, 2, 3))
    middle = (low + high) / 2
    below, beside = (on_paper(np.array(place)) for place in ((middle[0], low[1], low[2]), (high[0], low[1], middle[2])))
    right = drawn[:, 0].max(), on_paper(np.array((high[0], middle[1], high[2])))[1]
    for axis, place, offset, side in ((0, below, (-4, -8), {"ha": "right", "va": "top"}),
                                      (1, right, (5, 0), {"ha": "left", "va": "center"}),
                                      (2, beside, (5, -5), {"ha": "left", "va": "top"})):
        axes.annotate(f"{'xyz'[axis]}: {low[axis]:g} to {high[axis]:g}", place, offset,
                      textcoords="offset points", fontsize=9, **side)


def draw_box(figure, axes, run):
    """Von Mises stress on the surface of the deformed body, seen from below, as the contact is."""
    box = Box(run)
    patches = box.faces_in_view()
    scale = deformation_scale(box)
    stresses = np.concatenate([stress.ravel() for _, _, stress in patches])
    limit = np.quantile(stresses, 0.995)
    drawn = [on_paper(points + scale * displacement) for points, displacement, _ in patches]
    for cell, (_, _, stress) in zip(drawn, patches):
        colours = axes.pcolormesh(cell[..., 0], cell[..., 1], stress[..., 0], cmap="viridis",
                                  shading="gouraud", vmin=0, vmax=limit, rasterized=True)
    name_edges(axes, box, np.concatenate([cells.reshape(-1, 2) for cells in drawn]))
    axes.set_aspect("equal")
    axes.set_axis_off()
    add_stress_bar(figure, axes, colours, run, stresses.max() > limit, location="bottom", shrink=0.8)
    return scale


def draw_foundation(axes, run, rows):
    """The contact, with the friction on it."""
    x, z, t_x, t_z = (np.array([float(row[name]) for row in rows]) for name in (
        "x", "z", "tangential_traction_x", "tangential_traction_z"))
    axes.scatter(x, z, s=7, c=[STATES[row["state"]] for row in rows], linewidths=0)
    size = np.hypot(t_x, t_z)
    some = np.flatnonzero(size > 0.02 * size.max())[::max(1, len(x) // 150)]
    axes.quiver(x[some], z[some], t_x[some], t_z[some], width=0.004, color="#333333", scale=20 * size.max())
    axes.margins(0.1)
    axes.set_title(f"friction on the body,\nup to {size.max():.2g} {run.stress or 'units of stress'}", fontsize=9)
    tidy(axes, "xz", run)


def draw_space(run, rows):
    figure, (body, contact) = plt.subplots(1, 2, figsize=(7.4, 4.1), layout="constrained",
                                           width_ratios=[1, 1])
    scale = draw_box(figure, body, run)
    draw_foundation(contact, run, rows)
    return figure, scale


# ------------------------------------------------------------------ pictures


def folder(scene, output):
    """Pictures of the shipped scenes are part of the manual, those of others are not."""
    return GALLERY if scene.resolve().parent == ROOT / "prm" else output


def show_scene(scene, run, output):
    """Beside what is drawn of the result."""
    if (run.directory / "scene.svg").exists():
        shutil.copyfile(run.directory / "scene.svg", folder(scene, output) / f"{scene.stem}-scene.svg")


def draw(scene, run, output):
    table = run.last("contact", "csv")
    rows = read_csv(table) if table.exists() else []  # of a body without contact there is none
    is_space = bool(rows) and "z" in rows[0]
    figure, scale = (draw_space if is_space else draw_body)(run, rows)
    if rows:
        add_key(figure, rows)
    note = scale_text(scale) if scale != 1 else "displacement true to scale"
    figure.suptitle(f"{scene.stem}\n{note}" + (", seen from below" if is_space else ""), fontsize=10)
    picture = folder(scene, output) / f"{scene.stem}.png"
    picture.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(picture, dpi=130, metadata={"Software": None})
    plt.close(figure)
    show_scene(scene, run, output)
    print(f"  {picture}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", required=True, type=pathlib.Path)
    parser.add_argument("--output", required=True, type=pathlib.Path)
    parser.add_argument("--draw", action="store_true", help="draw what an earlier call has left")
    parser.add_argument("scenes", nargs="*", type=pathlib.Path)
    options = parser.parse_args()
    for scene in options.scenes or sorted((ROOT / "prm").glob("*.prm")):
        if not options.draw:
            solve(options.program.resolve(), scene, options.output)
        draw(scene, Run(options.output / scene.stem), options.output)


if __name__ == "__main__":
    main()
