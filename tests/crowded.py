# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which words in figures of matplotlib overlap each other, or are too small to read?"""

import contextlib

from matplotlib.figure import Figure
from matplotlib.text import Text

NARROW = 383  # pixels of a picture where a page is 400 wide
LEAST = 9  # pixels of a letter's height


def hidden(axes):
    """Labels of ticks that are not drawn: beyond the ends of their axis, or of none."""
    found = set()
    for axis, ends in ((axes.xaxis, axes.get_xlim()), (axes.yaxis, axes.get_ylim())):
        low, high = min(ends), max(ends)
        for tick in [*axis.get_major_ticks(), *axis.get_minor_ticks()]:
            if not axes.axison or not axis.get_visible() or not low - 1e-9 * (high - low) <= tick.get_loc() <= high + 1e-9 * (high - low):
                found |= {tick.label1, tick.label2}
    return found


def crowded(figure, is_on_page=False):
    """A line for each two words that overlap, and of a figure on a page for words below LEAST where that is narrow."""
    figure.draw_without_rendering()
    renderer = figure.canvas.get_renderer()
    unseen = set().union(*(hidden(axes) for axes in figure.findobj(lambda one: hasattr(one, "axison"))))
    boxes = [(text, text.get_window_extent(renderer)) for text in figure.findobj(Text) if text.get_visible() and text.get_text().strip() and text not in unseen]
    found = []
    if is_on_page:
        scale = min(96, NARROW / figure.get_tightbbox(renderer).width) / 72  # no picture is enlarged
        found += [f"{text.get_text()!r} has {text.get_fontsize() * scale:.1f} pixels" for text, _ in boxes if text.get_fontsize() * scale < LEAST]
    for k, (text, box) in enumerate(boxes):
        # A box is that of the highest letters that there are.
        found += [f"{text.get_text()!r} lies on {other.get_text()!r}" for other, beside in boxes[:k] if box.shrunk(0.95, 0.75).overlaps(beside.shrunk(0.95, 0.75))]
    return found


@contextlib.contextmanager
def watched(is_on_page=True):
    """A list that gets the lines of each figure that is saved meanwhile."""
    found, save = [], Figure.savefig

    def savefig(figure, *arguments, **options):
        save(figure, *arguments, **options)
        found.extend(f"{figure.axes[0].get_title()!r}: {line}" for line in crowded(figure, is_on_page))

    Figure.savefig = savefig
    try:
        yield found
    finally:
        Figure.savefig = save
