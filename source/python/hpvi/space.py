# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes in space on paper: the faces of the boundary, seen from below and beside it from above, so that each face is seen from one of the two."""
import textwrap

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.patches import Patch

from .results import pretty
from .sheet import CONTACT, GREY, GROUND, LOAD, MATERIALS, PROBE, SUPPORT, key, words_of
from .words import digits

# Where x, y and z lie on the paper: bodies of runs are seen from below, for there the contact is.
BELOW = np.array(((0.85, 0., 0.53), (-0.21, 0.92, 0.33)))
ABOVE = BELOW * ((-1,), (1,))
TINTS = {"contact": ("#a9d8c8", "contact"), "held": ("#b3d4ee", "displacement given"), "symmetry": ("#dbe9f5", "symmetry"), "spring": ("#d9cdec", "springs"),
         "load": ("#f5cfae", "load")}


class View:
    """A projection, and where it stands on the paper."""

    def __init__(self, words, axes, shift):
        self.words, self.axes, self.shift = words, axes, np.asarray(shift)
        viewer = np.cross(*axes)
        self.viewer = viewer / np.linalg.norm(viewer)

    def __call__(self, x):
        return np.asarray(x) @ self.axes.T + self.shift


def all_points(scene):
    return np.concatenate([np.array(face["x"], float) for boundary in scene["boundaries"] for face in boundary["faces"]])


def views(scene):
    """Both, side by side with room for words between them."""
    x = all_points(scene)
    below = x @ BELOW.T
    beside = below[:, 0].max() + 0.35 * np.ptp(below, axis=0).max() - (x @ ABOVE.T)[:, 0].min()
    return View("from below", BELOW, (0, 0)), View("from above", ABOVE, (beside, 0))


def corners(scene):
    """What is drawn of the body, on the paper (n, 2)."""
    return np.concatenate([view(all_points(scene)) for view in views(scene)])


def tint(boundary, face):
    """What is most telling of a face: (key of TINTS or None, colour)."""
    told = {"contact": boundary["contact"], "held": any(boundary["held"]), "symmetry": boundary["symmetry"], "spring": boundary["spring"], "load": boundary["loads"]}
    kind = next((name for name, is_so in told.items() if is_so), None)
    return kind, TINTS[kind][0] if kind else MATERIALS[face["material"] % 8]


class Face:
    """A face of the coarse mesh: points (n, n, 3), outer normal, middle, and what is given there."""

    def __init__(self, boundary, face):
        x = np.array(face["x"], float)
        n = round(len(x) ** 0.5)
        self.x, self.boundary, self.given = x.reshape(n, n, 3), boundary, face
        self.normal = np.cross(self.x[0, -1] - self.x[0, 0], self.x[-1, 0] - self.x[0, 0])
        self.normal /= max(np.linalg.norm(self.normal), 1e-300)
        middle = n // 2
        self.middle = self.x[middle, middle] if n % 2 else self.x.mean(axis=(0, 1))
        self.kind, self.colour = tint(boundary, face)

    def quads(self, view):
        """Where some of the small quadrilaterals of the face look away, those that do not (m, 4, 2); else None."""
        x = self.x
        corners = np.stack([x[:-1, :-1], x[:-1, 1:], x[1:, 1:], x[1:, :-1]], axis=2).reshape(-1, 4, 3)
        looks = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]) @ view.viewer > 0
        return None if looks.all() else view(corners[looks])

    def outline(self):
        x = self.x
        return np.concatenate([x[0], x[1:, -1], x[-1, -2::-1], x[-2:0:-1, 0]])


def draw_faces(sheet, drawn):
    """Farthest first. Of a face that is bent to the far side at its rim the parts that are seen."""
    polygons, colours, edges = [], [], []
    for face, outline in zip(drawn.faces, drawn.outlines):
        quads = face.quads(drawn.view)
        polygons += [outline] if quads is None else [*quads, outline]
        colours += [face.colour] if quads is None else [face.colour] * len(quads) + ["none"]
        edges += ["#8a97a6"] if quads is None else [face.colour] * len(quads) + ["#8a97a6"]
    sheet.axes.add_collection(PolyCollection(polygons, facecolors=colours, edgecolors=edges, linewidths=0.5 if len(drawn.faces) < 500 else 0.2, gid="faces"))
    step = 1 + len(drawn.faces) // 2000  # words keep off the rest, too
    sheet.marks += drawn.outlines[::step] + [drawn.view(face.x.reshape(-1, 3)) for face in drawn.faces[::step]]


class Drawn:
    """Faces that look to one viewer, with their outlines on the paper."""

    def __init__(self, view, faces):
        self.view = view
        self.faces = sorted((face for face in faces if face.normal @ view.viewer > 1e-6), key=lambda face: face.middle @ view.viewer)
        self.outlines = [view(face.outline()) for face in self.faces]
        self.depths = np.array([face.middle @ view.viewer for face in self.faces])
        self.low, self.high = (np.array([end(outline, axis=0) for outline in self.outlines]).reshape(-1, 2) for end in (np.min, np.max))

    def covers(self, face):
        """Does another one lie before the middle of this face?"""
        place = self.view(face.middle)
        near = (self.depths > face.middle @ self.view.viewer) & (self.low < place).all(axis=1) & (self.high > place).all(axis=1)
        for k in np.flatnonzero(near):
            way = np.roll(self.outlines[k], -1, axis=0) - self.outlines[k]
            turns = way[:, 0] * (place[1] - self.outlines[k][:, 1]) - way[:, 1] * (place[0] - self.outlines[k][:, 0])
            if self.faces[k] is not face and ((turns > 0).all() or (turns < 0).all()):
                return True
        return False


def best_place(boundary, drawn, faces):
    """The view and the face of a boundary that are best seen, as large and as square to the viewer as there are, and whether nothing hides it."""
    best = None
    for one in drawn:
        own = sorted((face for face in one.faces if face.boundary is boundary), key=lambda face: -(face.normal @ one.view.viewer))
        visible = [face for face in own[:60] if not one.covers(face)]
        size = bool(visible), sum(face.normal @ one.view.viewer for face in own)
        if own and (best is None or size > best[0]):
            places = visible or own
            middle = np.mean([one.view(face.middle) for face in places], axis=0)
            best = size, one.view, min(places, key=lambda face: np.hypot(*(one.view(face.middle) - middle)))
    if best is None:  # seen edge on from both sides
        return drawn[0].view, next(face for face in faces if face.boundary is boundary), False
    (is_seen, _), view, face = best
    return view, face, is_seen


def outside(sheet, view, place, outward):
    """Where the way from a place of the body in this direction leaves what is drawn of the body."""
    own = view(sheet.body)
    ahead, aside = (own - place) @ outward, abs((own - place) @ np.array([-outward[1], outward[0]]))
    near = ahead[aside < 12 * sheet.u]
    return place + max(0, near.max() if len(near) else 0) * outward


def is_free(boundary):
    return not (boundary["supports"] or boundary["contacts"] or boundary["loads"] or boundary["pair"])


def write_words(sheet, drawn, faces):
    """Of each boundary that is not free, with a line to it; a broken one where something stands before it."""
    for boundary in sheet.scene["boundaries"]:
        words = words_of(sheet, boundary)
        if not boundary["name"] or not words or is_free(boundary):
            continue
        view, face, is_seen = best_place(boundary, drawn, faces)
        centre, at = view(sheet.body).mean(axis=0), view(face.middle)
        outward = at - centre if np.hypot(*(at - centre)) > 3 * sheet.u else np.array([0.3, 1.])
        outward = outward / np.hypot(*outward)
        end = outside(sheet, view, at, outward)
        sheet.axes.plot(*np.array([at, end]).T, color=GREY, linewidth=0.6, linestyle="-" if is_seen else "--", clip_on=False)
        sheet.axes.plot(*at, "o", color=GREY, markersize=2.2, clip_on=False)
        sheet.note(end, outward, words, f"boundary {boundary['name']}")


def draw_vectors(sheet, view, seen, name, colour, largest):
    """Arrows to scale at faces that are so far from each other that they are told apart."""
    taken = []
    for face in seen:
        vector = np.array(face.given[name] or np.zeros(3))
        if not vector.any():
            continue
        at, own = view(face.middle), 14 * sheet.u * (vector @ view.axes.T) / largest
        if np.hypot(*own) < 0.8 * sheet.u or any(np.hypot(*(at - other)) < 8 * sheet.u for other in taken):
            continue
        taken.append(at)
        tail = at - own if vector @ face.normal < 0 else at
        sheet.arrow(tail, tail + own, colour, name == "displacement", gid=f"{name} {face.boundary['name']}")


def draw_axes(sheet, view):
    """x, y and z below the body on the left."""
    length, x = 9 * sheet.u, view(sheet.body)
    origin = np.array([x[:, 0].min() - 4 * sheet.u, x[:, 1].min() - 4 * sheet.u])
    for name, way in zip("xyz", view.axes.T):
        tip = origin + length * way
        sheet.arrow(origin, tip, GROUND, True)
        sheet.marks.append(np.array([tip, tip + 4 * sheet.u * way / np.hypot(*way)]))  # its letter
        sheet.axes.annotate(name, tip, 5 * way / np.hypot(*way), textcoords="offset points", ha="center", va="center", annotation_clip=False)


def draw_inside(sheet, view):
    force = sheet.scene["body_force"]
    if force:
        mean, centre = np.array(force["mean"]) @ view.axes.T, view(force["centre"])
        if np.hypot(*mean) > 0:
            sheet.arrow(centre, centre + 14 * sheet.u * mean / np.hypot(*mean), LOAD, gid="body force")
        sheet.note(outside(sheet, view, centre, np.array([0., 1.])), np.array([0., 1.]), [(force["words"], LOAD, False)])
    for probe in sheet.scene["probes"]:
        if probe["kind"] == "point":
            sheet.marks.append(view([probe["at"]] * 2))
            sheet.axes.plot(*view(probe["at"]), "x", color=PROBE, markersize=6, gid=f"probe {probe['name']}")
        elif probe["kind"] == "line":
            sheet.line(view([probe["from"], probe["to"]]), color=PROBE, linewidth=1.3, linestyle=":", gid=f"probe {probe['name']}")
        else:
            continue
        at = view(probe["at"] if probe["kind"] == "point" else probe["to"])
        outward = np.array([0.6, 0.8])
        sheet.note(outside(sheet, view, at, outward), outward, [(probe["name"], PROBE, False)])


def draw_space(sheet):
    """Into a sheet whose corners are those of corners()."""
    scene = sheet.scene
    faces = [Face(boundary, face) for boundary in scene["boundaries"] for face in boundary["faces"]]
    sheet.body = all_points(scene)
    drawn = [Drawn(view, faces) for view in views(scene)]
    for one in drawn:
        draw_faces(sheet, one)
    for name, colour in (("traction", LOAD), ("displacement", SUPPORT)):
        largest = max((np.linalg.norm(face.given[name]) for face in faces if face.given[name] is not None), default=0)
        for one in drawn:
            draw_vectors(sheet, one.view, one.faces, name, colour, largest)
    for view in (one.view for one in drawn):
        x = view(sheet.body)
        sheet.note((x[:, 0].mean(), x[:, 1].min()), np.array([0., -1.]), [(view.words, GREY, False)])
        draw_axes(sheet, view)
    draw_inside(sheet, drawn[1].view)
    write_words(sheet, drawn, faces)
    low, high = sheet.body.min(axis=0), sheet.body.max(axis=0)
    length = pretty(scene["units"]["length"])
    sizes = ", ".join(f"{name}: {digits(a, 4)} to {digits(b, 4)}" for name, a, b in zip("xyz", low, high)) + (f" {length}" if length else "")
    free = [boundary["name"] for boundary in scene["boundaries"] if boundary["name"] and is_free(boundary)]
    lines = [sizes] + (textwrap.wrap("free: " + ", ".join(free), 90) if free else [])
    sheet.axes.set(xticks=[], yticks=[], xlabel="\n".join(lines))
    for spine in sheet.axes.spines.values():
        spine.set_visible(False)
    kinds = {face.kind for face in faces}
    key(sheet.axes, scene["materials"], [Patch(facecolor=colour, edgecolor=GREY, label=words) for kind, (colour, words) in TINTS.items() if kind in kinds], len(lines))
