# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a scene says, as a picture: of scene.json, which `hpvi --picture SCENE.prm` and `hpvi --report DIR` write. Marks of the plane."""
import math

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.patches import Circle

from .results import label, left, lengths, pretty
from .sheet import CONTACT, GREY, GROUND, LOAD, MATERIALS, PROBE, SUPPORT, Sheet, arrange, interpolated, key, words_of
from .space import corners, draw_space
from .words import digits, one_digit


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


def remark_on_gap(sheet, boundary):
    times = gap_scale(sheet, boundary)
    return f"(gap drawn {digits(times, 4)} times as wide)" if times != 1 else ""


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
                sheet.note(place + band * normal, normal, words_of(sheet, boundary, remark_on_gap(sheet, boundary)), f"boundary {boundary['name']}")


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


def draw_plane(sheet):
    draw_cells(sheet)
    draw_boundaries(sheet)
    draw_loads_inside(sheet)
    draw_probes(sheet)
    key(sheet.axes, sheet.scene["materials"])
    length = pretty(sheet.scene["units"]["length"])
    sheet.axes.set(xlabel=label("x", length, "length"), ylabel=label("y", length, "length"))
    sheet.axes.locator_params(nbins=5)


def scene(data, axes, is_brief=False):
    """The scene of scene.json, a dictionary: the body with its coarse mesh, supports, contact, gaps, loads as arrows, probes, each with its words and sizes; in
    space the faces of its boundary, seen from below and from above.

    is_brief: names and loads alone, where the words stand beside the picture. Returns remarks. Of a load history it is the end, t = 1."""
    in_space = data["dimension"] == 3
    sheet = Sheet(data, axes, corners(data) if in_space else np.concatenate([np.array(cell["outline"], float) for cell in data["cells"]]), is_brief)
    axes.set(aspect="equal", xlim=(sheet.low[0], sheet.high[0]), ylim=(sheet.low[1], sheet.high[1]))
    (draw_space if in_space else draw_plane)(sheet)
    at_the_end = ", at the end of its load history, t = 1" if data["history"] else ""
    axes.set_title("" if is_brief else data["title"] + at_the_end, parse_math=False)
    arrange(sheet)
    return ["what the scene says" + at_the_end]
