# SPDX-License-Identifier: LGPL-2.1-or-later
"""Charts of report.html read back: lines in the numbers of their axes, as a reader with a ruler would."""

import math
import re
import xml.etree.ElementTree as ElementTree

SVG = "{http://www.w3.org/2000/svg}"
# Coordinates have two digits behind the point, also those of the ticks by which others are measured.
RESOLUTION = 0.04  # pixels


def corners(path):
    return [tuple(map(float, point.split())) for point in path.get("d")[1:].rstrip("Z").split("L")]


def look(path):
    return path.get("stroke"), path.get("stroke-dasharray")


def distance(point, begin, end):
    """Of a point from a piece of a line."""
    way = [end[k] - begin[k] for k in (0, 1)]
    length = way[0] ** 2 + way[1] ** 2
    share = min(max(sum((point[k] - begin[k]) * way[k] for k in (0, 1)) / length, 0), 1) if length else 0
    return math.dist(point, [begin[k] + share * way[k] for k in (0, 1)])


class Axis:
    """Pixels of numbers by the first and the last tick; all others have to stand between them."""

    def __init__(self, ticks, is_logarithmic=False):
        self.scale = math.log10 if is_logarithmic else float
        ticks = sorted((self.scale(number), at) for number, at in ticks)
        assert len(ticks) > 1, "nobody can read an axis with one number"
        (low, start), (high, end) = ticks[0], ticks[-1]
        self.pixels = (end - start) / (high - low)
        self.at_zero = start - self.pixels * low
        for number, at in ticks:
            assert abs(self.at_zero + self.pixels * number - at) < RESOLUTION, ticks

    def pixel(self, number):
        return self.at_zero + self.pixels * self.scale(number)


class Chart:
    """Its caption, the words at its axes, and its lines by their names in the key: pieces, each a list of corners."""

    def __init__(self, svg, caption):
        self.caption = caption
        elements = [element for element in ElementTree.fromstring(svg) if element.tag in (SVG + "path", SVG + "text")]
        paths = [element for element in elements if element.tag == SVG + "path"]
        texts = [element for element in elements if element.tag == SVG + "text"]
        (self.y_label,) = (text.text for text in texts if text.get("transform"))
        below = [text for text in texts if text.get("text-anchor") == "middle" and not text.get("transform")]
        self.x_label = below.pop().text
        self.x = Axis([(float(text.text), float(text.get("x"))) for text in below])
        # The words of a tick stand four pixels below its line.
        beside = [(float(text.text), float(text.get("y")) - 4) for text in texts if text.get("text-anchor") == "end"]
        self.y = Axis(beside, is_logarithmic=caption.startswith("How the error falls"))
        names, self.colours = {}, {}
        for sample, text in zip(elements, elements[1:]):
            if sample.tag == SVG + "path" and text.tag == SVG + "text" and text.get("text-anchor") == "start":
                if sample.get("fill") == "none":
                    names[look(sample)] = text.text
                else:
                    self.colours[text.text] = sample.get("fill")
        self.lines, self.bands = {}, []
        for path in paths:
            ends = corners(path)
            if path.get("stroke-width") == "1.8" and ends[0][1] >= 0:
                self.lines.setdefault(names.get(look(path), ""), []).append(ends)
            elif path.get("fill") != "none" and ends[0][1] >= 0:
                self.bands.append((path.get("fill"), ends[0][0], ends[1][0]))
        levels = [y for pieces in self.lines.values() for piece in pieces for x, y in piece]
        self.highest, self.lowest = min(levels), max(levels)

    def differences(self, name, points):
        """Pixels by which the line misses its points and its corners are none of them, and how many are cut off."""
        pieces = self.lines[name]
        exact = [(self.x.pixel(x), self.y.pixel(y)) for x, y in points]
        places = [(x, min(max(y, self.highest), self.lowest)) for x, y in exact]
        missed = [min(distance(place, *ends) for piece in pieces for ends in zip(piece, piece[1:])) for place in places]
        invented = [min(math.dist(corner, place) for place in places) for piece in pieces for corner in piece]
        return max(missed + invented), sum(math.dist(*both) > RESOLUTION for both in zip(exact, places))

    def states_at(self, x):
        """By the colours of the band below, two where one ends."""
        at = self.x.pixel(x)
        fills = {fill for fill, begin, end in self.bands if begin - RESOLUTION <= at <= end + RESOLUTION}
        return {name for name, colour in self.colours.items() if colour in fills}


def charts(page):
    found = re.findall(r"<figure>\n<!-- chart -->\n(<svg.*?</svg>)\n<figcaption>(.*?)</figcaption>", page, re.S)
    return [Chart(svg, caption) for svg, caption in found]
