# SPDX-License-Identifier: LGPL-2.1-or-later
"""A picture of a scene: marks beside a body, and words that find room between them."""
import math
import textwrap

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.font_manager import FontProperties
from matplotlib.patches import Patch
from matplotlib.textpath import text_to_path

from .results import left, lengths

GROUND, LOAD, SUPPORT, CONTACT, PROBE, GREY = "#222222", "#b8500a", "#0072b2", "#00704f", "#8a2be2", "#666666"
MATERIALS = ("#e6edf5", "#f6d9a8", "#8fcbb0", "#dcc0ea", "#6f9bd1", "#e3da5c", "#a3a3a3", "#f0957f")  # whoever looks
FONT, LINE = 8.5, 10.5  # points


def interpolated(s, places, values):
    """Values (n,) or vectors (n, 2) between places, at s."""
    return np.interp(s, places, values) if values.ndim == 1 else np.stack([np.interp(s, places, one) for one in values.T], axis=1)


class Sheet:
    """Marks in units of a hundredth of the body's longer side, and boxes of words that find places beside them."""

    def __init__(self, scene, axes, corners, is_brief):
        """corners (n, 2): what is drawn of the body reaches from the least to the largest of them."""
        self.scene, self.axes, self.is_brief = scene, axes, is_brief
        self.low, self.high = corners.min(axis=0), corners.max(axis=0)
        self.u = (self.high - self.low).max() / 100
        self.notes, self.marks = [], []

    def line(self, x, **style):
        self.marks.append(np.asarray(x))
        return self.axes.plot(*np.asarray(x).T, clip_on=False, **style)

    def strokes(self, begins, ends, **style):
        self.marks += [np.asarray(begins), np.asarray(ends)]
        self.axes.add_collection(LineCollection(np.stack([begins, ends], axis=1), clip_on=False, **style))

    def arrow(self, tail, head, colour, is_open=False, gid=None):
        self.marks.append(np.array([tail, head]))
        made = self.axes.annotate("", head, tail, annotation_clip=False, arrowprops=dict(
            arrowstyle="->" if is_open else "-|>", color=colour, shrinkA=0, shrinkB=0, mutation_scale=7, linewidth=1))
        made.set_gid(gid)

    def ground(self, x, n, **style):
        """A line with short strokes that lean, on its outer side."""
        self.line(x, color=GROUND, **{"linewidth": 1.3, **style})
        s = lengths(x)
        at, out = (interpolated(np.arange(self.u, s[-1], 2.2 * self.u), s, values) for values in (x, n))
        lean = out * 1.7 * self.u + left(out) * 1.3 * self.u
        self.strokes(at, at + lean, color=GROUND, linewidth=0.7)

    def note(self, place, outward, lines, gid=None):
        """lines: (words, colour, is bold), broken where they are long."""
        lines = [(part, colour, is_bold) for words, colour, is_bold in lines for part in textwrap.wrap(words, 20 if self.is_brief else 32) or [""]]
        if lines:
            self.notes.append((np.asarray(place, float), np.asarray(outward, float), lines, gid, extents(lines)))


# ------------------------------------------------------------------ words


def extents(lines):
    """Width and height of a box of lines [points]."""
    fonts = [FontProperties(size=FONT, weight=weight) for weight in ("normal", "bold")]
    widths = [text_to_path.get_text_width_height_descent(words, fonts[is_bold], False)[0] for words, _, is_bold in lines]
    return np.array([max(widths), LINE * len(lines)])


def overlaps(box, others):
    return any((box[0] < other[1]).all() and (box[1] > other[0]).all() for other in others)


def crossed(box, marks):
    return bool(((marks > box[0]) & (marks < box[1])).all(axis=1).any())


def place_notes(sheet, scale, marks):
    """Each as near to its place as there is room: (note, low corner, high corner), and whether all have found some."""
    placed, boxes, has_room = [], [], True
    for note in sheet.notes:
        place, outward, _, _, size = note
        size = size * scale
        across = left(outward)
        for reach in range(150):
            step, aside = divmod(reach, 5)
            centres = [place + outward * (abs(outward) @ size / 2 + (4 + 3 * step) * scale) + across * side * aside * 0.4 * (abs(across) @ size) for side in (1, -1)]
            here = [(centre - size / 2, centre + size / 2) for centre in centres]
            free = [box for box in here if not overlaps(box, boxes) and not crossed(box, marks)]
            if free:
                break
        has_room = has_room and bool(free)
        boxes.append((free or here)[0])
        placed.append((note, *boxes[-1]))
    return placed, has_room


def arranged(sheet, room):
    """The notes where the body is as large as the room (width, height) [points] lets it be: length per point, notes, low and high corner of all."""
    marks = np.concatenate([dense(mark, sheet.u) for mark in sheet.marks])
    body = np.concatenate([sheet.low[None], sheet.high[None], *sheet.marks])
    for scale in max(np.ptp(body, axis=0) / room) * 1.08 ** np.arange(18):
        placed, has_room = place_notes(sheet, scale, marks)
        everything = np.concatenate([body, *[np.array(box) for _, *box in placed]])
        low, high = everything.min(axis=0) - 3 * scale, everything.max(axis=0) + 3 * scale
        if has_room and (high - low <= scale * room).all():
            break
    return scale, placed, low, high


def dense(mark, spacing):
    """Points along a line, so that no word lies between two of them."""
    way = np.diff(mark, axis=0)
    pieces = [a + np.linspace(0, 1, 2 + int(np.hypot(*w) / spacing))[:, None] * w for a, w in zip(mark, way)]
    return np.concatenate([mark, *pieces])


def write_notes(sheet, placed, scale):
    for (place, _, lines, gid, _), low, high in placed:
        nearest = np.clip(place, low, high)
        if np.hypot(*(nearest - place)) > 14 * scale:
            sheet.axes.plot(*np.array([place, nearest]).T, color=GREY, linewidth=0.5, clip_on=False)
        for k, (words, colour, is_bold) in enumerate(lines):
            sheet.axes.text((low[0] + high[0]) / 2, high[1] - (k + 0.8) * LINE * scale, words, color=colour, fontsize=FONT, ha="center", va="baseline",
                            weight="bold" if is_bold else "normal", gid=gid, clip_on=False, parse_math=False)


def arrange(sheet):
    """Limits of the axes and places of the words, so that all have room; of a figure of its own its size, too."""
    axes, room = sheet.axes, np.zeros(2)
    for _ in range(3):  # limits change what is beside the axes, and that changes the room
        if engine := axes.figure.get_layout_engine():
            engine.execute(axes.figure)
        inches, before = axes.figure.get_size_inches(), room
        room = axes.get_position(original=True).size * inches * 72 - 4
        if (abs(room - before) < 2).all():
            break
        scale, placed, low, high = arranged(sheet, room)
        if len(axes.figure.axes) == 1:  # what finds no room makes some
            axes.figure.set_size_inches(inches + ((high - low) / scale - room).clip(0) / 72)
        axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
    write_notes(sheet, placed, scale)


def words_of(sheet, boundary, remark=""):
    loads = [(words, LOAD, False) for words in boundary["loads"]]
    if sheet.is_brief:  # of many boundaries those that are free have no room
        is_free = not (boundary["supports"] or boundary["contacts"] or loads or boundary["pair"])
        return [] if is_free and len(sheet.scene["boundaries"]) > 8 else [(boundary["name"], "black", True)] + loads
    lines = [(boundary["name"] + (f"  (curves {boundary['curves']})" if boundary["curves"] else ""), "black", True)]
    lines += [(words, SUPPORT, False) for words in boundary["supports"]] + [(words, CONTACT, False) for words in boundary["contacts"]]
    lines += ([(remark, GREY, False)] if remark else []) + loads
    return lines if len(lines) > 1 or boundary["pair"] else lines + [("free", GREY, False)]


def key(axes, materials, tints=(), n_lines=1):
    """Of materials, where there are several, and of tints, patches with labels, below so many lines of words; its lines are no longer than the picture is wide."""
    width = int(axes.figure.get_figwidth() * 72 / 5) - 12
    handles = list(tints)
    for one in materials if len(materials) > 1 else []:
        words = "\n".join(textwrap.wrap(f"{one['name']}: {one['words']}", width))
        handles.append(Patch(facecolor=MATERIALS[one["number"] % 8], edgecolor=GROUND, label=words))
    if handles:
        axes.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0), borderaxespad=2.5 + 1.4 * n_lines, frameon=False, fontsize=FONT, handlelength=1.4,
                    ncol=1 if len(materials) > 1 else len(handles))
