# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a scene says, as a picture: of scene.json, which `hpvi --picture SCENE.prm` and `hpvi --report DIR` write."""
import math
import textwrap

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.font_manager import FontProperties
from matplotlib.patches import Circle, Patch
from matplotlib.textpath import text_to_path

from .results import label, left, lengths, pretty
from .words import digits, one_digit

GROUND, LOAD, SUPPORT, CONTACT, PROBE, GREY = "#222222", "#b8500a", "#0072b2", "#00704f", "#8a2be2", "#666666"
MATERIALS = ("#e6edf5", "#f6d9a8", "#8fcbb0", "#dcc0ea", "#6f9bd1", "#e3da5c", "#a3a3a3", "#f0957f")  # whoever looks
FONT, LINE = 8.5, 10.5  # points


def interpolated(s, places, values):
    """Values (n,) or vectors (n, 2) between places, at s."""
    return np.interp(s, places, values) if values.ndim == 1 else np.stack([np.interp(s, places, one) for one in values.T], axis=1)


class Part:
    """Edges of a boundary that follow each other, the body on the left: places (n, 2), outer normals, lengths along them."""

    def __init__(self, edges):
        def joined(name):  # an edge begins where the one before it ends
            return np.concatenate([np.array(edge[name], float)[k > 0:] for k, edge in enumerate(edges)])

        self.x = joined("x")
        self.s = lengths(self.x)
        self.data = {name: None if edges[0][name] is None else joined(name) for name in ("gap", "traction", "displacement")}

    def at(self, s):
        """Places and outer normals at lengths s (m,)."""
        k = np.clip(np.searchsorted(self.s, s, side="right") - 1, 0, len(self.s) - 2)
        way = self.x[k + 1] - self.x[k]
        way /= np.hypot(*way.T)[:, None]
        return interpolated(s, self.s, self.x), -left(way)

    def middle(self):
        """Its place and outer normal."""
        return (values[0] for values in self.at(np.array([self.s[-1] / 2])))

    def along(self, spacing, with_ends=False):
        """Equidistant lengths, spacing or so from each other."""
        n = max(1, round(self.s[-1] / spacing))
        return np.linspace(0, self.s[-1], n + 1) if with_ends else (np.arange(n) + 0.5) * self.s[-1] / n

    def values(self, name, s):
        return interpolated(s, self.s, self.data[name])


def parts_of(edges):
    """Parts of a boundary without corners."""
    def goes_on(edge, other, cosine_of_corner=0.64):  # 50 degrees: an edge of a polygon for a curve turns by less
        arriving, leaving = np.subtract(edge["x"][-1], edge["x"][-2]), np.subtract(other["x"][1], other["x"][0])
        return arriving @ leaving > cosine_of_corner * math.hypot(*arriving) * math.hypot(*leaving)

    beginning, following = {}, {}
    for k, edge in enumerate(edges):
        beginning.setdefault(tuple(edge["x"][0]), []).append(k)
    for k, edge in enumerate(edges):
        following[k] = next((other for other in beginning.get(tuple(edge["x"][-1]), []) if goes_on(edge, edges[other])), None)
    inner = set(following.values())
    firsts = sorted(following, key=inner.__contains__)  # of a closed curve any
    parts = []
    for k in firsts:
        chain = []
        while k in following:
            chain.append(edges[k])
            k = following.pop(k)
        parts += [Part(chain)] if chain else []
    return parts


class Sheet:
    """Marks in units of a hundredth of the body's longer side, and boxes of words that find places beside them."""

    def __init__(self, scene, axes, is_brief):
        self.scene, self.axes, self.is_brief = scene, axes, is_brief
        corners = np.concatenate([np.array(cell["outline"], float) for cell in scene["cells"]])
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


# ------------------------------------------------------------------ marks: each begins `band` outside of the body and returns where it ends


def draw_supports(sheet, boundary, part, band):
    u = sheet.u
    if boundary["held"] == [True, True]:
        x, n = part.at(part.along(2 * u, True))
        sheet.ground(x + (band + 0.5 * u) * n, n, linewidth=2)
        band += 3.5 * u
    elif any(boundary["held"]):
        axis = np.array(boundary["held"], float)
        x, n = part.at(part.along(min(14 * u, part.s[-1] / 2)))
        for place, normal in zip(x, n):
            way = axis if axis @ normal >= -1e-9 else -axis
            is_beside = way @ normal < 0.5
            tip = place + (band + (2.5 if is_beside else 0.3) * u) * normal
            across = left(way)
            sheet.line([tip, tip + 2.4 * u * way + 1.5 * u * across, tip + 2.4 * u * way - 1.5 * u * across, tip], color=GROUND, linewidth=1)
            sheet.line([tip + 3.2 * u * way - 2 * u * across, tip + 3.2 * u * way + 2 * u * across], color=GROUND, linewidth=1)
        band += 5.5 * u
    if boundary["symmetry"]:
        x, n = part.at(part.along(2 * u, True))
        sheet.line(x + (band + u) * n, color=GROUND, linewidth=1.1, linestyle="-.")
        band += 2.5 * u
    if boundary["spring"]:
        band = draw_springs(sheet, part, band)
    return draw_plate(sheet, boundary["plate"], part, band) if boundary["plate"] else band


def draw_springs(sheet, part, band):
    u = sheet.u
    x, n = part.at(part.along(7 * u))
    shape = np.array([(0, 0), (1, 1), (2, -1), (3, 1), (4, -1), (5, 0), (6, 0)])
    for place, normal in zip(x, n):
        sheet.line(place + band * normal + shape[:, :1] * u * normal + shape[:, 1:] * u * left(normal), color=GROUND, linewidth=0.9)
    x, n = part.at(part.along(2 * u, True))
    sheet.ground(x + (band + 6 * u) * n, n)
    return band + 9 * u


def draw_plate(sheet, plate, part, band):
    u = sheet.u
    x, n = part.at(part.along(2 * u, True))
    sheet.axes.fill(*np.concatenate([x + (band + 0.3 * u) * n, (x + (band + 2.3 * u) * n)[::-1]]).T, color=GROUND, linewidth=0)
    band += 2.6 * u
    place, normal = part.middle()
    force = np.array(plate["force"])
    if force.any():
        way = 10 * u * force / np.hypot(*force)
        tip = place + band * normal
        pushes = way @ normal < 0
        sheet.arrow(tip - way if pushes else tip, tip if pushes else tip + way, LOAD, gid="plate")
        band += max(u, abs(way @ normal))
    if plate["moment"]:
        angle = np.linspace(0, math.pi, 21)[::1 if plate["moment"] > 0 else -1]
        arc = place + band * normal - 4 * u * np.cos(angle)[:, None] * left(normal) + 4 * u * np.sin(angle)[:, None] * normal
        sheet.line(arc, color=LOAD, linewidth=1.2)
        sheet.arrow(arc[-4], arc[-1], LOAD)
        band += 5 * u
    return band


def gap_scale(sheet, boundary):
    """How many times as wide gaps are drawn: they are seen, and not larger than the body."""
    widest = max((abs(part.data["gap"]).max() for part in boundary["drawn"] if part.data["gap"] is not None), default=0) / sheet.u
    if widest == 0 or 2 <= widest <= 18:
        return 1.
    return one_digit((6 if widest < 2 else 18) / widest)


def draw_contact(sheet, boundary, part, band):
    u, kind = sheet.u, boundary["contact"]
    if not kind:
        return band
    s = part.along(1.5 * u, True)
    x, n = part.at(s)
    sheet.line(x, color=CONTACT, linewidth=2.2, gid=f"contact {boundary['name']}")
    if boundary["pair"]:
        return band  # the other body takes the place of a foundation
    gap = part.values("gap", s) * gap_scale(sheet, boundary) if part.data["gap"] is not None else np.zeros(len(s))
    way = np.array(boundary["direction"]) if boundary["direction"] else n
    far = band + (2.5 if kind == "bilateral" else 1.2) * u
    line = x + far * n + gap[:, None] * way
    sheet.ground(line, np.broadcast_to(way, n.shape), linestyle="--" if kind == "tangential" else "-", gid=f"foundation {boundary['name']}")
    if kind == "bilateral":
        places, out = part.at(part.along(6 * u))
        sheet.axes.plot(*(places + (band + 1.3 * u) * out).T, "o", color="white", markeredgecolor=GROUND, markersize=3.2, clip_on=False)
    return far + max(0., ((gap[:, None] * way) * n).sum(axis=1).max()) + 2.5 * u


def draw_vectors(sheet, boundary, part, band, name, colour, largest):
    """Arrows to scale beside other boundaries; a small one is as long as one can see: its size stands beside it."""
    u, data = sheet.u, part.data[name]
    if data is None or not data.any():
        return band
    own = np.hypot(*data.T).max()
    length = max(5., 14 * own / largest) * u / own
    s = part.along(8 * u, True)
    if np.hypot(*part.values(name, s).T).max() < 0.9 * own:  # it is narrow
        s = np.append(s, part.s[np.hypot(*data.T).argmax()])
    x, n = part.at(s)
    deepest = band
    for place, normal, value in zip(x, n, part.values(name, s)):
        vector = length * value
        if np.hypot(*vector) < 0.8 * u:
            continue
        share = vector @ normal / np.hypot(*vector)
        if abs(share) < 0.2:
            tail = place + (band + 2 * u) * normal - vector / 2
        else:
            tail = place + (band + 0.7 * u) * normal - (vector if share < 0 else 0)
        sheet.arrow(tail, tail + vector, colour, name == "displacement", gid=f"{name} {boundary['name']}")
        deepest = max(deepest, (tail - place) @ normal, (tail + vector - place) @ normal)
    return deepest + 1.5 * u


def words_of(sheet, boundary):
    loads = [(words, LOAD, False) for words in boundary["loads"]]
    if sheet.is_brief:  # of many boundaries those that are free have no room
        is_free = not (boundary["supports"] or boundary["contacts"] or loads or boundary["pair"])
        return [] if is_free and len(sheet.scene["boundaries"]) > 8 else [(boundary["name"], "black", True)] + loads
    lines = [(boundary["name"] + (f"  (curves {boundary['curves']})" if boundary["curves"] else ""), "black", True)]
    lines += [(words, SUPPORT, False) for words in boundary["supports"]] + [(words, CONTACT, False) for words in boundary["contacts"]]
    if (times := gap_scale(sheet, boundary)) != 1:
        lines.append((f"(gap drawn {digits(times, 4)} times as wide)", GREY, False))
    lines += loads
    return lines if len(lines) > 1 or boundary["pair"] else lines + [("free", GREY, False)]


def draw_boundaries(sheet):
    scene = sheet.scene
    for boundary in scene["boundaries"]:
        boundary["drawn"] = parts_of(boundary["edges"])
    largest = {name: max((np.hypot(*part.data[name].T).max() for boundary in scene["boundaries"] for part in boundary["drawn"]
                          if part.data[name] is not None), default=1) for name in ("traction", "displacement")}
    for boundary in scene["boundaries"]:
        longest = max(boundary["drawn"], key=lambda part: part.s[-1])
        for part in boundary["drawn"]:
            sheet.line(part.x, color="#333333", linewidth=1.1)
            band = draw_contact(sheet, boundary, part, draw_supports(sheet, boundary, part, 0.))
            for name, colour in (("traction", LOAD), ("displacement", SUPPORT)):
                band = draw_vectors(sheet, boundary, part, band, name, colour, largest[name])
            if part is longest and boundary["name"]:
                place, normal = part.middle()
                sheet.note(place + band * normal, normal, words_of(sheet, boundary), f"boundary {boundary['name']}")


# ------------------------------------------------------------------ inside of the body


def draw_cells(sheet):
    cells = sheet.scene["cells"]
    sheet.axes.add_collection(PolyCollection([cell["outline"] for cell in cells], facecolors=[MATERIALS[cell["material"] % 8] for cell in cells],
                                             edgecolors="#8a97a6", linewidths=0.5 if len(cells) < 500 else 0.2, gid="cells"))
    drawn = {}
    for cell in cells:  # axes of orthotropic materials, so far from each other that they are told apart
        centre = np.mean(cell["outline"], axis=0)
        others = drawn.setdefault(cell["material"], [])
        if cell["angle"] is None or any(np.hypot(*(centre - other)) < 9 * sheet.u for other in others):
            continue
        others.append(centre)
        angle = math.radians(cell["angle"])
        one, two = 3 * sheet.u * np.array([math.cos(angle), math.sin(angle)]), 1.2 * sheet.u * np.array([-math.sin(angle), math.cos(angle)])
        sheet.strokes([centre - one, centre - two], [centre + one, centre + two], color="#55606e", linewidths=[1.2, 0.7])


def draw_loads_inside(sheet):
    force = sheet.scene["body_force"]
    if force:
        mean, centre = np.array(force["mean"]), np.array(force["centre"])
        if mean.any():
            sheet.arrow(centre, centre + 14 * sheet.u * mean / np.hypot(*mean), LOAD, gid="body force")
        sheet.note(centre, (0, 1. if mean[1] <= 0 else -1.), [(force["words"], LOAD, False)])
    for cut in sheet.scene["pretensions"]:
        ends, normal = np.array([cut["from"], cut["to"]]), np.array(cut["normal"])
        sheet.line(ends, color=LOAD, linewidth=1.6, linestyle="--")
        for side in (-1, 1):
            sheet.arrow(ends.mean(axis=0) + side * sheet.u * normal, ends.mean(axis=0) + side * 8 * sheet.u * normal, LOAD, gid=f"pretension {cut['name']}")
        way = ends[1] - ends[0]
        sheet.note(ends[1], way / np.hypot(*way), [(cut["name"], LOAD, True), (cut["words"], LOAD, False)])


def draw_probes(sheet):
    for probe in sheet.scene["probes"]:
        place, outward = np.array(probe["at"]), np.array([0.7, 0.7])
        if probe["kind"] == "point":
            sheet.axes.plot(*place, "x", color=PROBE, markersize=6, gid=f"probe {probe['name']}")
        elif probe["kind"] == "disc":
            sheet.axes.add_patch(Circle(place, probe["size"], fill=False, edgecolor=PROBE, linewidth=1.2, gid=f"probe {probe['name']}"))
        elif probe["kind"] == "line":
            ends = np.array([probe["from"], probe["to"]])
            place, outward = ends.mean(axis=0), np.array([0., 1.])
            sheet.line(ends, color=PROBE, linewidth=1.3, linestyle=":", gid=f"probe {probe['name']}")
        else:
            for boundary in sheet.scene["boundaries"]:
                for part in boundary["drawn"] if boundary["name"] in probe["on"] else []:
                    x, n = part.at(part.along(2 * sheet.u, True))
                    sheet.line(x - 1.2 * sheet.u * n, color=PROBE, linewidth=1.3, gid=f"probe {probe['name']}")
                    place, outward = x[len(x) // 3] - 1.2 * sheet.u * n[len(x) // 3], -n[len(x) // 3]
        sheet.note(place, outward, [(probe["name"], PROBE, False)])


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


def scene(data, axes, is_brief=False):
    """The scene of scene.json, a dictionary: the body with its coarse mesh, supports, contact, gaps, loads as arrows, probes, each with its words and sizes.

    is_brief: names and loads alone, where the words stand beside the picture. Returns remarks. Of a load history it is the end, t = 1. Raises ValueError for a scene in space."""
    if data["dimension"] != 2:
        raise ValueError("Dimension = 3: pictures show scenes in the plane alone")
    length = pretty(data["units"]["length"])
    sheet = Sheet(data, axes, is_brief)
    draw_cells(sheet)
    draw_boundaries(sheet)
    draw_loads_inside(sheet)
    draw_probes(sheet)
    key_of_materials(axes, data["materials"])
    axes.set(aspect="equal", xlim=(sheet.low[0], sheet.high[0]), ylim=(sheet.low[1], sheet.high[1]), xlabel=label("x", length, "length"), ylabel=label("y", length, "length"))
    at_the_end = ", at the end of its load history, t = 1" if data["history"] else ""
    axes.set_title("" if is_brief else data["title"] + at_the_end, parse_math=False)
    axes.locator_params(nbins=5)
    room = np.zeros(2)
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
    return ["what the scene says" + at_the_end]


def key_of_materials(axes, materials):
    """Its lines are no longer than the picture is wide."""
    if len(materials) < 2:
        return
    width = int(axes.figure.get_figwidth() * 72 / 5) - 12
    labels = ["\n".join(textwrap.wrap(f"{one['name']}: {one['words']}", width)) for one in materials]
    axes.legend(handles=[Patch(facecolor=MATERIALS[one["number"] % 8], edgecolor=GROUND, label=words) for one, words in zip(materials, labels)],
                loc="upper center", bbox_to_anchor=(0.5, 0), borderaxespad=3.9, frameon=False, fontsize=FONT, handlelength=1.4)
