# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of runs by matplotlib. Each function takes a Result, or a Run of hpvi.results, and axes to draw into, and returns what a reader has to
know besides: remarks, a text each.

    figure, axes = matplotlib.pyplot.subplots()
    hpvi.plot.contact(run, axes)

Colours are those of Okabe and Ito, which the colour-blind tell apart; lines differ by dashes as well.
"""
import io
import itertools
import math

import numpy as np

try:
    from matplotlib import pyplot
    from matplotlib.cm import ScalarMappable
    from matplotlib.collections import LineCollection, PolyCollection
    from matplotlib.colors import BoundaryNorm, ListedColormap, Normalize
    from matplotlib.lines import Line2D
    from matplotlib.ticker import MaxNLocator, NullFormatter
except ImportError:
    raise ImportError("pictures need matplotlib; install python3-matplotlib") from None

from . import render, results
from .results import label, usual, von_mises
from .scene import scene
from .space import ABOVE, BELOW as PAPER, corners
from .words import digits, one_digit

STATES = {"open": "#999999", "slip": "#d55e00", "stick": "#56b4e9"}
BLUE, ORANGE, GREEN, BLACK, GREY = "#0072b2", "#d55e00", "#009e73", "#000000", "#777777"
DEGREES = ("#fffde0 #fdf3a0 #e6e66a #b4d857 #78c664 #3fab78 #1f8c86 #276f8e #33538f #443a85 #471b6d #2d0a44").split()
ERRORS = {"error_bound_relative": ("guaranteed bound", BLUE, "o-"), "estimate_equilibrated_relative": ("estimate by equilibrated stress", BLUE, "s--"),
          "estimate_relative": ("indicator, no bound", ORANGE, "^--"), "error_relative": ("true error", BLACK, "D:")}
STYLE = {"font.size": 9, "axes.titlesize": 10, "axes.labelsize": 9, "xtick.labelsize": 9, "ytick.labelsize": 9, "legend.fontsize": 9, "legend.frameon": False,
         "axes.spines.top": False, "axes.spines.right": False, "svg.hashsalt": "hpvi", "figure.facecolor": "white", "axes.axisbelow": True,
         "axes.formatter.useoffset": False, "image.composite_image": False}  # joined images have a grey rim
BELOW = {"loc": "upper center", "bbox_to_anchor": (0.5, 0), "borderaxespad": 3.9}  # a legend
PER_CELL = 5  # points a direction and cell; quarters of edges tell which cells are neighbours


def figure(width=4.6, height=3.2):
    """A figure and its axes [inches], whose text is 9 points high."""
    with pyplot.rc_context(STYLE):
        made, axes = pyplot.subplots(figsize=(width, height), layout="constrained")
    return made, axes


def svg(function, *arguments, size=(4.6, 3.3), **options):
    """What a function of this module draws, as text, and its remarks. Equal pictures are equal texts."""
    file = io.StringIO()
    with pyplot.rc_context(STYLE):
        made, axes = figure(*size)
        try:
            remarks = function(*arguments[:1], axes, *arguments[1:], **options)
            made.savefig(file, format="svg", dpi=150, bbox_inches="tight", pad_inches=0.05, metadata={"Date": None, "Creator": None})
        finally:
            pyplot.close(made)
    return file.getvalue(), remarks


def scene_svg(data):
    """A picture of its own as SVG, with its title: what `hpvi --picture` writes."""
    in_space = data["dimension"] == 3  # where the key has some lines more
    size = np.ptp(corners(data) if in_space else np.concatenate([cell["outline"] for cell in data["cells"]]), axis=0)
    text, _ = svg(scene, data, size=(7.2, float(np.clip(2.8 + in_space + 4.6 * size[1] / size[0], 3.2 + in_space, 8))))
    return "<!-- the scene, drawn by hpvi -->\n" + text[text.index("<svg"):]


def plot(result, what=None, axes=None, scale=None):
    """One of `body`, `contact` and `convergence`, into axes if given; without a name all that there are. Returns the figure."""
    drawn = {"body": body, "contact": contact, "convergence": convergence}
    if what is not None and what not in drawn:
        raise ValueError(f"plot({what!r}): there are body, contact and convergence")
    if what is None and axes is not None:
        raise ValueError("axes are for one picture: name body, contact or convergence")
    if what == "contact" and not result.contact:
        raise ValueError('plot("contact"): the scene has no contact')
    if what == "contact" and result.dimension == 3:
        raise NotImplementedError('plot("contact") draws lines in the plane; result.contact has the points, and hpvi.plot.surface draws them')
    if what == "convergence" and not result.steps:
        raise ValueError('plot("convergence"): no step is finished')
    names = [what] if what else [name for name in drawn if name != "contact" or (result.contact and result.dimension == 2)]
    if axes is None:
        with pyplot.rc_context(STYLE):
            made, several = pyplot.subplots(1, len(names), figsize=(5.2 * len(names), 4.4), layout="constrained", squeeze=False)
        places = several[0]
    else:
        made, places = axes.figure, [axes]
    for name, place in zip(names, places):
        drawn[name](result, place, **({"scale": scale} if name == "body" else {}))
    if axes is None:
        pyplot.close(made)  # notebooks show what a cell returns, and would show it twice
    return made


# ------------------------------------------------------------------ the body


def round_scale(displacement, x):
    """Which shows the displacement as a twelfth of the body, with one digit; never less than it is."""
    flat = x.reshape(-1, x.shape[-1])
    size, largest = np.ptp(flat, axis=0).max(), np.linalg.norm(displacement, axis=-1).max()
    if largest == 0 or size <= 12 * largest:
        return 1.
    return max(1., one_digit(size / (12 * largest)))


def in_words(scale, end="", name="von Mises stress"):
    """Title and remark of a deformed body."""
    return (("deformed body" if scale == 1 else f"displacement {scale:g} times") + end,
            f"{name} on the deformed body, displacement {'true to scale' if scale == 1 else f'{scale:g} times as large'}{end}")


def edges(x):
    """Of cells (cells, n, n, ...) their four edges: (4, cells, n, ...)."""
    return np.stack([x[:, 0], x[:, -1], x[:, :, 0], x[:, :, -1]])


def keys(x, low, size):
    """Whole numbers for places, the same for places that are the same to 1e-10 of the size: no place of a bisected mesh lies where two meet."""
    whole = np.floor(1e9 * (x - low) / size + 0.317).astype(np.int64)
    return whole @ np.array([1, 0x1000193, 0x5851F42D4C957F2D])[:x.shape[-1]]  # one number of each is sorted faster than three


def on_boundary(middles, points, low, size):
    """Which of the middles of edges or faces are at no place of another cell: points, all places at which cells tell of themselves."""
    flat = keys(points.reshape(-1, points.shape[-1]), low, size)
    _, number, count = np.unique(np.concatenate([flat, keys(middles, low, size)]), return_inverse=True, return_counts=True)
    return count[number[len(flat):]] <= 2  # once among the points, once among the middles


def outline(x):
    """The edges (edges, n, 2) that two cells do not share."""
    low, size = x.reshape(-1, 2).min(axis=0), np.ptp(x)
    own = edges(x).reshape(-1, x.shape[1], 2)
    return own[on_boundary(own[:, x.shape[1] // 2], own, low, size)]


def body(result, axes, scale=None):
    """Von Mises stress [stress] on the deformed body with its cells; of a body in the plane its outline at rest, and along each contact its state, on both
    sides. scale: how many times displacements are shown."""
    if result.dimension == 3:
        return body_in_space(result, axes, scale)
    cells = result.grid(PER_CELL)
    x, u, stress = cells["x"], cells["u"], von_mises(cells["stress"])
    scale = round_scale(u, x) if scale is None else scale
    moved, n = x + scale * u, PER_CELL
    # Two triangles of each square between neighbouring points.
    corner = ((np.arange(len(x))[:, None, None] * n + np.arange(n - 1)[:, None]) * n + np.arange(n - 1)).ravel()
    triangles = np.concatenate([np.stack([corner, corner + n, corner + n + 1], 1), np.stack([corner, corner + n + 1, corner + 1], 1)])
    a, b, c = np.moveaxis(x.reshape(-1, 2)[triangles], 1, 0)
    areas = abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    limit = usual(stress.ravel()[triangles].max(axis=1), areas)
    colours = axes.tripcolor(*moved.reshape(-1, 2).T, triangles, stress.ravel(), shading="gouraud", cmap="viridis",
                             vmin=0, vmax=limit or 1, rasterized=True)
    axes.add_collection(LineCollection(edges(moved).reshape(-1, n, 2), colors="white", linewidths=0.3 if len(x) < 400 else 0.1, rasterized=True))
    axes.add_collection(LineCollection(outline(x), colors=GREY, linewidths=0.8, linestyles="dashed", zorder=0.5))
    present = draw_states(result, axes, scale)
    frame(axes, result, moved if scale == 1 else np.concatenate([moved, x]))
    title, remark = in_words(scale)
    axes.set_title(title)
    bar(axes, colours, label("von Mises stress", result.stress_unit, "stress"), stress.max() > limit)
    key_of_states(axes, present)
    return [f"{remark}; dashed: the body at rest"] + (["the thick line: state of contact"] if present else [])


def bar(axes, colours, words, is_cut=False, ticks=None):
    """Below wide pictures, beside tall ones."""
    is_wide = np.ptp(axes.get_ylim()) < 0.7 * np.ptp(axes.get_xlim())
    axes.figure.colorbar(colours, ax=axes, label=words, extend="max" if is_cut else "neither", location="bottom" if is_wide else "right",
                         aspect=30, shrink=0.9, pad=0.03, ticks=MaxNLocator(5) if ticks is None else ticks)


def frame(axes, result, x):
    low, high = x.reshape(-1, 2).min(axis=0), x.reshape(-1, 2).max(axis=0)
    margin = 0.05 * (high - low).max()
    axes.set(aspect="equal", xlim=(low[0] - margin, high[0] + margin), ylim=(low[1] - margin, high[1] + margin),
             xlabel=label("x", result.length_unit, "length"), ylabel=label("y", result.length_unit, "length"))
    for axis, share in zip("xy", (high - low) / (high - low).max()):
        axes.locator_params(axis=axis, nbins=int(np.clip(10 * share, 1, 5)))


def normals(line):
    """Of a Line, up to their sign: across the way from point to point, as long as 1."""
    if len(line.x) < 2:
        return np.zeros_like(line.x)
    way = np.gradient(line.x, axis=0)
    way /= np.maximum(np.hypot(*way.T), 1e-300)[:, None]
    return -results.left(way)


def motion(result, line):
    """Displacement (n, 2) of the points of a line, of the body whose side it is."""
    if line.get("displacement") is not None:
        return line["displacement"]
    if "." in line.boundary:
        return result.u(line.x, body=line.boundary.split(".")[0])
    return result.u(line.x)


def opposite(line, u):
    """Places at rest and displacements of the other body's points opposite those of a line, or None where there is none."""
    if line.get("jump_normal") is None or line.get("master") is None or not str(line["master"][0]):
        return None
    n, jump = normals(line), np.stack([line["jump_normal"], line["jump_tangential"]], axis=1)
    known = np.stack([line["normal_displacement"], line["tangential_displacement"]], axis=1)

    def vector(sign, parts):  # t = (-n_y, n_x)
        return parts[:, :1] * sign * n + parts[:, 1:] * results.left(sign * n)

    sign = min((1, -1), key=lambda one: np.nan_to_num(abs(vector(one, known) - u)).sum())
    distance = np.nan_to_num(line["gap"] + line["jump_normal"]) if line.get("gap") is not None else np.zeros(len(n))
    return line.x + sign * distance[:, None] * n, u - vector(sign, jump)


def draw_states(result, axes, scale):
    """Along each contact, on the line of each body. Returns the states that there are."""
    present = []
    for line in results.lines(result) if result.contact else []:
        u = motion(result, line)
        present += list(line["state"])
        for x, displacement in [(line.x, u)] + [side for side in [opposite(line, u)] if side]:
            moved = x + scale * displacement
            for first, last, state in line.runs():
                begin, end = line.ends(moved, first, last)
                path = np.concatenate([[begin], moved[first:last], [end]])
                axes.plot(*path.T, color="white", linewidth=5, zorder=3, solid_capstyle="butt", clip_on=False)
                axes.plot(*path.T, color=STATES[state], linewidth=3, zorder=4, solid_capstyle="butt", clip_on=False, gid=f"state of {line.name}")
    return [state for state in STATES if state in present]


def key_of_states(axes, present):
    if not present:
        return
    handles = [Line2D([], [], color=STATES[state], linewidth=4, label=state) for state in present]
    axes.legend(handles=handles, **BELOW, ncol=len(present), handlelength=1.2, frameon=False)


def mesh(result, axes, is_moved=False, window=None):
    """The cells with their polynomial degrees as colours, and as digits where there is room. is_moved: of the deformed body; window: ((x from, to),
    (y from, to)) of what is shown."""
    cells, degrees = result.grid(PER_CELL), result.mesh.degrees
    scale = round_scale(cells["u"], cells["x"]) if is_moved else 0
    x = cells["x"] + scale * cells["u"]
    loops = np.concatenate([x[:, 0, :-1], x[:, :-1, -1], x[:, -1, :0:-1], x[:, :0:-1, 0]], axis=1)
    levels = np.arange(degrees.min(), degrees.max() + 2)
    colours = ListedColormap([DEGREES[min(max(p, 1), 12) - 1] for p in levels[:-1]])
    drawn = PolyCollection(loops, array=degrees, cmap=colours, norm=BoundaryNorm(levels - 0.5, colours.N), edgecolors="#444444",
                           linewidths=0.5 if len(x) < 400 else 0.15)
    axes.add_collection(drawn)
    frame(axes, result, x)
    if window:
        axes.set(xlim=window[0], ylim=window[1])
    bar(axes, drawn, "polynomial degree", ticks=levels[:-1])
    width = axes.get_position().width * axes.figure.get_figwidth() * 72 / max(np.ptp(axes.get_xlim()), np.ptp(axes.get_ylim()))
    m = PER_CELL // 2
    across = np.minimum(np.hypot(*(x[:, 0, m] - x[:, -1, m]).T), np.hypot(*(x[:, m, 0] - x[:, m, -1]).T))
    for cell, p, size in zip(x, degrees, across):
        if width * size > 11:
            axes.text(*cell[m, m], str(p), ha="center", va="center", fontsize=8, color="black" if p < 6 else "white", clip_on=True)
    axes.set_title(f"mesh, {len(x)} cells" + (f", displacement {scale:g} times" if scale > 1 else ""))
    return ["the mesh of the last step with the polynomial degrees of its cells"]


# ------------------------------------------------------------------ in space


def outer_faces(x, bodies):
    """Of cells (cells, n, n, n, 3) the faces (faces, n, n, 3) that no other cell of their body has, and of each (cell, axis, end)."""
    m, low, size = x.shape[1] // 2, x.reshape(-1, 3).min(axis=0), np.ptp(x)
    faces, names = [], []
    for body in np.unique(bodies):
        own = np.flatnonzero(bodies == body)
        sides = np.concatenate([np.take(x[own], end, axis=axis + 1) for axis in range(3) for end in (0, -1)])
        kept = on_boundary(sides[:, m, m], sides, low, size)
        faces.append(sides[kept])
        names.append(np.array([(cell, axis, end) for axis in range(3) for end in (0, -1) for cell in own])[kept])
    return np.concatenate(faces), np.concatenate(names)


def on_faces(values, names):
    """Of values (cells, n, n, n, ...) those on faces."""
    return np.stack([np.take(values[cell], end, axis=axis) for cell, axis, end in names])


def faces_in_view(x):
    """(cell, axis, end) of those of the surface that look to the viewer, farthest first; none where bodies touch."""
    faces, names = outer_faces(x, np.zeros(len(x), int))
    viewer, m = np.cross(*PAPER), x.shape[1] // 2
    normals = np.cross(faces[:, 0, -1] - faces[:, 0, 0], faces[:, -1, 0] - faces[:, 0, 0])
    normals *= np.sign(((faces[:, m, m] - x[names[:, 0], m, m, m]) * normals).sum(axis=1))[:, None]
    seen = np.flatnonzero(normals @ viewer > 1e-9 * np.linalg.norm(normals, axis=1))
    return names[seen[np.argsort(faces[seen, m, m] @ viewer)]]


def apart(result, faces, bodies):
    """How far each body is drawn away from those that it touches (bodies, 3) [length]: across a contact, by three quarters of its width.
    faces (faces, n, n, 3), of bodies (faces,)."""
    n, columns, ways, lengths = bodies.max() + 1, result.contact, [], []
    for rows in contacts_of_bodies(columns) if n > 1 else []:
        x = np.stack([columns[axis][rows] for axis in "xyz"], axis=1)
        some = x[::1 + len(x) // 40]
        far = [np.mean([np.linalg.norm(own - place, axis=1).min() for place in some]) for own in (faces[bodies == k].reshape(-1, 3) for k in range(n))]
        one, other = np.argsort(far, kind="stable")[:2]
        squares, axes = np.linalg.eigh(np.cov(x.T))
        if squares[0] > 0.1 * squares[1]:  # as around a shaft
            continue
        way = axes[:, 0] * 0.75 * np.sort(np.ptp(x, axis=0))[1]
        towards = (faces[bodies == one].mean(axis=(0, 1, 2)) - faces[bodies == other].mean(axis=(0, 1, 2))) @ way
        ways.append(np.eye(n)[one] - np.eye(n)[other])
        lengths.append(way if towards > 0 else -way)
    return np.linalg.lstsq(np.array(ways), np.array(lengths), rcond=None)[0] if ways else np.zeros((n, 3))


def contacts_of_bodies(columns):
    """Numbers of the rows of each contact of two bodies."""
    return [rows for rows in results.contacts(columns).values() if "master" in columns and str(columns["master"][rows[0]]) and len(rows) > 2]


def body_in_space(result, axes, scale=None):
    """By VTK from below and from above, bodies that touch drawn apart; where it is not there from below."""
    cells = result.grid(PER_CELL)
    x, u, stress = cells["x"], cells["u"], von_mises(cells["stress"])
    scale = round_scale(u, x) if scale is None else scale
    try:
        return in_light(result, axes, scale, cells, stress)
    except render.NotDrawn as problem:
        missing = str(problem)
    quads, values = [], []
    for cell, axis, end in faces_in_view(x):
        flat = np.take(x[cell] + scale * u[cell], end, axis=axis) @ PAPER.T
        colour = np.take(stress[cell], end, axis=axis)
        quads.append(np.stack([flat[:-1, :-1], flat[1:, :-1], flat[1:, 1:], flat[:-1, 1:]], axis=2).reshape(-1, 4, 2))
        values.append(((colour[:-1, :-1] + colour[1:, :-1] + colour[1:, 1:] + colour[:-1, 1:]) / 4).ravel())
    quads, values = np.concatenate(quads), np.concatenate(values)
    limit = usual(values, np.ones(len(values)))
    surface = PolyCollection(quads, array=values, cmap="viridis", edgecolors="face", linewidths=0.3, rasterized=True)
    surface.set_clim(0, limit or 1)
    axes.add_collection(surface)
    axes.autoscale_view()
    axes.set_aspect("equal")
    axes.set_axis_off()
    name_edges(axes, x, quads.reshape(-1, 2))
    title, remark = in_words(scale, ", seen from below")
    axes.set_title(title)
    bar(axes, surface, label("von Mises stress", result.stress_unit, "stress"), values.max() > limit)
    return [remark, f"VTK draws it from two sides: {missing}"]


def in_light(result, axes, scale, cells, stress):
    """The surface by VTK, from below and from above. Raises NotDrawn."""
    faces, names = outer_faces(cells["x"], result.mesh.bodies)
    bodies, values = result.mesh.bodies[names[:, 0]], on_faces(stress, names)
    shifts = apart(result, faces, bodies)
    moved = faces + scale * on_faces(cells["u"], names) + shifts[bodies][:, None, None]
    limit, windows = usual(values.ravel(), np.ones(values.size)), []
    for view in (PAPER, ABOVE):
        flat = moved.reshape(-1, 3) @ view.T
        margin = 0.02 * np.ptp(flat, axis=0).max()
        windows.append(np.stack([flat.min(axis=0) - margin, flat.max(axis=0) + margin]))
    colours = ScalarMappable(Normalize(0, limit or 1), "viridis")
    images = render.images(moved, values, limit or 1, colours.to_rgba(np.linspace(0, limit or 1, 256))[:, :3], list(zip((PAPER, ABOVE), windows)))
    show_views(axes, images, windows)
    words = label("von Mises stress", result.stress_unit, "stress")
    title, remark = in_words(scale, name=words)
    axes.set_title(title)
    bar(axes, colours, words, values.max() > limit)
    return [f"{remark}, seen from below and from above" + (", bodies drawn apart" if shifts.any() else "")]


def show_views(axes, images, windows):
    """Those from below and from above side by side, flat ones one above the other, each with its words above it and x, y and z below it."""
    (wide, high), (next_wide, next_high) = (np.diff(window, axis=0)[0] for window in windows)
    unit = 0.05 * max(wide, next_wide, high, next_high)
    is_flat = wide > 2.5 * high
    shift = np.array((0, high + 9 * unit) if is_flat else (wide + 2 * unit, 0))
    for image, (low, end), view, words, corner in zip(images, windows, (PAPER, ABOVE), ("from below", "from above"), (0 * shift, shift)):
        right, top = corner + end - low
        axes.imshow(image, extent=(corner[0], right, corner[1], top))
        axes.text((corner[0] + right) / 2, top + unit / 4, words, ha="center", va="bottom", color=GREY)
        origin = corner + (1.7 * unit, -4.5 * unit)
        for name, way in zip("xyz", view.T):
            axes.annotate("", origin + 2 * unit * way, origin, arrowprops={"arrowstyle": "->", "color": GREY, "linewidth": 0.8, "shrinkA": 0, "shrinkB": 0})
            axes.annotate(name, origin + 2 * unit * way, 6 * way / np.hypot(*way), textcoords="offset points", ha="center", va="center", fontsize=8, color=GREY,
                          annotation_clip=False)
    end = np.maximum((wide, high), shift + (next_wide, next_high))
    axes.set(aspect="equal", xlim=(0, end[0]), ylim=(-6 * unit, end[1] + 2 * unit))
    axes.set_axis_off()


def name_edges(axes, x, drawn):
    """Below and to the right of what is drawn of the body: where it begins and ends in each direction."""
    low, high = x.reshape(-1, 3).min(axis=0), x.reshape(-1, 3).max(axis=0)
    middle = (low + high) / 2
    below, beside = (np.array(place) @ PAPER.T for place in ((middle[0], low[1], low[2]), (high[0], low[1], middle[2])))
    right = drawn[:, 0].max(), (np.array((high[0], middle[1], high[2])) @ PAPER.T)[1]
    for axis, place, offset, side in ((0, below, (-4, -8), {"ha": "right", "va": "top"}), (1, right, (5, 0), {"ha": "left", "va": "center"}),
                                      (2, beside, (5, -5), {"ha": "left", "va": "top"})):
        axes.annotate(f"{'xyz'[axis]}: {low[axis]:g} to {high[axis]:g}", place, offset, textcoords="offset points", annotation_clip=False, **side)


def surface(result, axes, name=None, what="pressure"):
    """Of one contact in space (by its name; without it all) what, "pressure" or "state", at its points, seen along the axis in which it extends least;
    arrows are the friction on the body."""
    columns = result.contact
    if name is not None:
        columns = results.where(columns, results.contacts(columns)[name])
    x = np.stack([columns[axis] for axis in "xyz"], axis=1)
    first, second = sorted(np.argsort(-np.ptp(x, axis=0), kind="stable")[:2])
    place = x[:, first], x[:, second]
    size = min(40., max(2., 9000 / len(x)))
    if what == "state":
        for state, colour in STATES.items():
            own = columns["state"] == state
            if own.any():
                axes.scatter(place[0][own], place[1][own], s=size, c=colour, marker="s", linewidths=0, label=state, rasterized=len(x) > 2000)
        friction = np.stack([columns["tangential_traction_" + "xyz"[d]] for d in (first, second)], axis=1)
        largest = np.hypot(*friction.T).max()
        if largest > 0:
            some = np.flatnonzero(np.hypot(*friction.T) > 0.02 * largest)[::max(1, len(x) // 150)]
            axes.quiver(place[0][some], place[1][some], *friction[some].T, width=0.004, color="#333333", scale=20 * largest)
        axes.legend(**BELOW, ncol=3, markerscale=2)
        axes.set_title(f"state; friction up to {largest:.2g} {result.stress_unit}".rstrip() if largest > 0 else "state")
    else:
        pressure = -columns["normal_traction"]
        limit = usual(pressure, np.ones(len(pressure)))
        points = axes.scatter(*place, s=size, c=pressure, cmap="viridis", vmin=min(0, pressure.min()), vmax=limit or 1, marker="s", linewidths=0, rasterized=len(x) > 2000)
        axes.set_aspect("equal")
        bar(axes, points, label("pressure", result.stress_unit, "stress"), pressure.max() > limit)
        axes.set_title("pressure")
    axes.set(aspect="equal", xlabel=label("xyz"[first], result.length_unit, "length"), ylabel=label("xyz"[second], result.length_unit, "length"))
    axes.locator_params(nbins=5)
    return [f"contact {name}: {what}" if name else what]


# ------------------------------------------------------------------ contact


def closed_range(line):
    """Where the axis begins and ends that shows what is not open, None where the whole is readable."""
    closed = [(begin, end) for state, begin, end in line.stretches() if state != "open"]
    if not closed or len(line.s) < 2:
        return None
    low, high = min(begin for begin, _ in closed), max(end for _, end in closed)
    whole = line.s[-1] - line.s[0]
    if not 0 < high - low < 0.4 * whole:
        return None
    margin = 0.15 * (high - low)
    return max(low - margin, line.s[0]), min(high + margin, line.s[-1])


def friction_limit(line):
    """The largest friction at each point [stress]: what it is, over the share of it that the multiplier tells; NaN where that is too small."""
    share = abs(line["multiplier"].astype(float))
    return np.where(share > 1e-3, abs(line["tangential_traction"]) / np.maximum(share, 1e-3), math.nan)


def contact(result, axes, line=None):
    """Pressure and friction [stress] of one contact over its arc length, and where it is open, slips and sticks. Without line: all contacts. Beside a
    singular end the axis ends where 3 % of the length are above; marks say what lies beyond."""
    if line is None:
        every = results.lines(result)
        if len(every) > 1:
            return several_contacts(result, axes, every)
        line, = every
    curves = {"pressure": line.pressure}
    draw_along(axes, line, line.pressure, "-", color=BLACK, label="pressure")
    if line["tangential_traction"].any():
        curves["friction"] = line["tangential_traction"]
        draw_along(axes, line, line["tangential_traction"], "--", color=GREEN, label="friction")
        for sign, words in ((1, "limit of friction"), (-1, None)):
            draw_along(axes, line, sign * friction_limit(line), ":", color=GREY, label=words)
    window = closed_range(line) or (line.s[0], line.s[-1])
    remarks = cut(axes, line, curves, window, result.stress_unit)
    if window[0] < window[1]:
        axes.set_xlim(*window)
    band(axes, line)
    if window[1] - window[0] < 0.9 * (line.s[-1] - line.s[0]):
        strip(axes, line, window, result.length_unit)
        remarks.append("the strip above shows the whole contact and the part that is drawn")
    finish(axes, line.title, result)
    return [f"contact {line.title} over its arc length"] + remarks


def draw_along(axes, line, values, style, **options):
    axes.plot(line.broken(line.s), line.broken(values), style, **options)


def usual_range(curves, weights):
    """Between which most values of curves are, and 0."""
    return min(-usual((-v).clip(0), weights, 0.97, 1.5) for v in curves), max(usual(v.clip(0), weights, 0.97, 1.5) for v in curves)


def show_range(axes, ranges):
    """The y axis of curves whose usual ranges these are."""
    low, high = min((low for low, _ in ranges), default=0), max((high for _, high in ranges), default=0)
    if low < high:
        axes.set_ylim(low - 0.1 * (high - low), high + 0.1 * (high - low))


def several_contacts(result, axes, every):
    """Pressures in one colour each, friction dashed."""
    for line, colour in zip(every, itertools.cycle((BLUE, ORANGE, BLACK, GREEN, GREY))):
        draw_along(axes, line, line.pressure, "-", color=colour, label=f"pressure, {line.title}")
        draw_along(axes, line, line["tangential_traction"], "--", color=colour, label=f"friction, {line.title}")
    show_range(axes, [usual_range((line.pressure, line["tangential_traction"]), line.weights()) for line in every])
    finish(axes, "contact", result, columns=1)
    return []


def finish(axes, title, result, columns=3):
    axes.axhline(0, color=BLACK, linewidth=0.6, zorder=0)
    axes.set(xlabel=label("arc length", result.length_unit, "length"), ylabel=label("traction", result.stress_unit, "stress"))
    axes.set_title(title, pad=18 if axes.child_axes else 6)
    axes.locator_params(axis="x", nbins=6)
    axes.legend(**BELOW, ncol=columns, columnspacing=1.2, handlelength=1.8)


def cut(axes, line, curves, window, unit):
    """Ends the axis where few values are beyond, and marks these: triangles at its end, with the largest one. Returns what to say of them."""
    inside = (line.s >= window[0]) & (line.s <= window[1])
    low, high = usual_range(curves.values(), line.weights() * inside)
    if not low < high:
        return []
    room = 0.15 * (high - low)
    low, high = low - (room if low < 0 else 0), high + (room if high > 0 else 0)
    axes.set_ylim(low - 0.08 * (high - low), high)
    remarks, written = [], {}
    for name, v in curves.items():
        for sign, end in ((1, high), (-1, low)):
            beyond = np.flatnonzero(inside & (sign * v > sign * end))
            apart = np.flatnonzero(np.diff(line.s[beyond]) > 0.1 * (window[1] - window[0])) + 1
            for group in np.split(beyond, apart) if len(beyond) else []:
                worst = group[np.argmax(sign * v[group])]
                is_right = line.s[worst] > sum(window) / 2
                axes.plot([line.s[worst]], [end], marker="^" if sign > 0 else "v", color=ORANGE, clip_on=False, zorder=5, markersize=6, linestyle="none")
                below = written[sign, is_right] = written.get((sign, is_right), -1) + 1  # one under the other
                axes.annotate(f"{name} {digits(v[worst], 3)}", (line.s[worst], end), (-7 if is_right else 7, -sign * (2 + 11 * below)), textcoords="offset points", color=ORANGE,
                              ha="right" if is_right else "left", va="top" if sign > 0 else "bottom", annotation_clip=False, zorder=4,
                              bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.3})
                remarks.append(f"beyond the axis: {name} up to {digits(v[worst], 3)} {unit}".rstrip() + f" at ({line.x[worst][0]:.4g}, {line.x[worst][1]:.4g})")
    return remarks


def band(axes, line):
    """The states, along the lower end of the axes."""
    seen = set()
    for state, begin, end in line.stretches():
        axes.axvspan(begin, end, ymin=0, ymax=0.045, color=STATES[state], linewidth=0, label=None if state in seen else state, gid=f"state {state}")
        seen.add(state)


def strip(axes, line, window, unit):
    """The states of the whole above the axes, and the part that these show."""
    whole = axes.inset_axes([0, 1.03, 1, 0.04])
    for state, begin, end in line.stretches():
        whole.axvspan(begin, end, color=STATES[state], linewidth=0)
    whole.axvspan(*window, facecolor="none", edgecolor=BLACK, linewidth=1.2, clip_on=False)
    whole.set(xlim=(line.s[0], line.s[-1]), yticks=[], xticks=[])
    whole.text(1, 1.3, f"whole: {line.s[-1] - line.s[0]:.4g} {unit}".rstrip(), transform=whole.transAxes, ha="right", va="bottom", fontsize=8)
    for side in ("left", "bottom"):
        whole.spines[side].set_visible(False)


# ------------------------------------------------------------------ errors


def error_columns(result):
    """(words, colour, style, values) of each error that is known in some step, relative to the solution in the energy norm."""
    table = dict(result.steps)
    kinds = set(table.get("bound_kind", np.array([]))) - {""}
    is_energy = kinds <= {"energy"}
    if not is_energy and "error_estimate_equilibrated" in table:
        table["estimate_equilibrated_relative"] = table["error_estimate_equilibrated"] / table["energy_norm"]
    found = []
    for column, (words, colour, style) in ERRORS.items():
        values = table.get(column)
        if column == "error_bound_relative" and not is_energy:
            words = "bound, for the computed history" if "history" in kinds and "coupling" not in kinds else "bound, if the coupling is as estimated"
        if values is not None and np.isfinite(np.asarray(values, float)).any():
            found.append((words, colour, style, np.asarray(values, float)))
    return found


def convergence(result, axes):
    """Relative errors over the number of unknowns; of a load history at the end of each load step, over their number."""
    table, is_history = result.steps, "load_step" in result.steps and bool(result.loading)
    kept = np.isin(table["step"], result.loading["step"]) if is_history else np.ones(len(table["step"]), bool)
    x = table["load_step"][kept] if is_history else table["dofs_free"][kept]
    for words, colour, style, values in error_columns(result):
        known = np.isfinite(values[kept]) & (values[kept] > 0)  # not each step need have its bound
        if known.any():
            draw = axes.semilogy if is_history else axes.loglog
            draw(x[known], values[kept][known], style, color=colour, markersize=4, label=words)
    axes.set(xlabel="load step" if is_history else "free unknowns", ylabel="error over the solution", title="convergence")
    axes.grid(True, which="major", linewidth=0.3)
    decades(axes, is_history)
    axes.legend(**BELOW, ncol=2)
    return ["how the error falls from step to step, in the energy norm, over that of the solution" if not is_history
            else "the error at the end of each load step, in the energy norm, over that of the solution"]


def decades(axes, is_history):
    """At least one decade, whose ends have numbers."""
    for axis, limits, set_limits in ((axes.yaxis, axes.get_ylim(), axes.set_ylim),) + (() if is_history else ((axes.xaxis, axes.get_xlim(), axes.set_xlim),)):
        low, high = np.log10(limits)
        if high - low < 1.2:
            set_limits(10 ** math.floor(low), 10 ** math.ceil(high))
        axis.set_minor_formatter(NullFormatter())
    if is_history:
        axes.xaxis.set_major_locator(MaxNLocator(6, integer=True))


# ------------------------------------------------------------------ load histories


def loop(result, axes, boundary, component):
    """Force over displacement of a boundary whose displacement changes; component: x, y or z."""
    x, y = result.loading[f"displacement_{boundary}_{component}"], result.loading[f"force_{boundary}_{component}"]
    axes.plot(x, y, "o-", color=BLUE, markersize=3, linewidth=1)
    axes.plot(x[-1:], y[-1:], "o", color=ORANGE, markersize=6, label="end")
    force = results.unit_of_load(result.stress_unit, result.length_unit, False)
    axes.set(xlabel=label(f"$u_{component}$ of {boundary}", result.length_unit, "length"), ylabel=label(f"force {component} on {boundary}", force, "force"),
             title=f"force over displacement, {boundary}")
    axes.legend(loc="best")
    return [f"force over displacement of {boundary}; the area of a loop is what a cycle takes"]


def loops(result):
    """(boundary, component) of those whose prescribed displacement changes from load step to load step."""
    found = []
    for name, values in result.loading.items():
        if name.startswith("displacement_") and f"force_{name[13:]}" in result.loading:
            if np.ptp(values) > 1e-9 * abs(values).max() and len(values) > 1:
                found.append((name[13:-2], name[-1]))
    return found


def of_energies(result, axes, words, name, title):
    axes.set(xlabel=words, ylabel=label(name, results.unit_of_load(result.stress_unit, result.length_unit, True), "energy"), title=title)
    axes.xaxis.set_major_locator(MaxNLocator(6, integer=True))


def energies(result, axes):
    """Work of the loads, what is stored, and what friction dissipates, over the load steps."""
    for column, words, colour, style in (("work", "work", BLACK, "-"), ("stored_energy", "stored", BLUE, "--"), ("dissipated_energy", "dissipated", ORANGE, ":")):
        axes.plot(result.loading["load_step"], result.loading[column], style, color=colour, label=words)
    of_energies(result, axes, "load step", "energy", "energies")
    axes.legend(**BELOW, ncol=3)
    return ["work of the loads, and what became of it"]


def cycles(result, axes):
    """What friction dissipates in each cycle."""
    axes.plot(result.cycles["cycle"], result.cycles["dissipated_energy"], "o-", color=ORANGE)
    of_energies(result, axes, "cycle", "dissipated energy", "cycles")
    return ["what friction dissipates in each cycle"]


def load_steps(run, axes, name, what="pressure", most=6):
    """Pressure or friction of one contact at the ends of load steps, in one chart: most of them, dark the last one. Of a Run with the files of all steps."""
    numbers = np.unique(np.linspace(0, len(run.loading["step"]) - 1, most).round().astype(int))
    colours = pyplot.get_cmap("viridis_r")(np.linspace(0.1, 1, len(numbers)))
    ranges = []
    for k, colour in zip(numbers, colours):
        line = next((one for one in run.lines_of(run.loading["step"][k]) if one.name == name), None)
        if line is None:
            continue
        y = line.pressure if what == "pressure" else line["tangential_traction"]
        ranges.append(usual_range([y], line.weights()))
        draw_along(axes, line, y, "-", color=colour, linewidth=1.2, label=f"{run.loading['load_step'][k]}")
    show_range(axes, ranges)
    axes.set(xlabel=label("arc length", run.length_unit, "length"), ylabel=label(what, run.stress_unit, "stress"), title=f"{what}, {name}")
    axes.legend(**BELOW, ncol=6, title="at the end of load step", handlelength=1, columnspacing=1)
    return [f"{what} of contact {name} at the ends of load steps"]


def history(result, axes, name, columns, words):
    """Columns of contact-history.csv of one contact over its arc length: {column: words}; words: of the axis."""
    table = result.contact_history
    line = results.Line(name, results.where(table, results.contacts(table)[name]))
    for (column, what), style, colour in zip(columns.items(), ("-", "--", ":"), (BLACK, ORANGE, BLUE)):
        draw_along(axes, line, line[column], style, color=colour, label=what)
    axes.set(xlabel=label("arc length", result.length_unit, "length"), ylabel=words, title=f"history, {name}")
    axes.legend(**BELOW, ncol=3)
    return [f"contact {name} over its arc length, up to the end of the history"]


def probe(result, axes, name):
    """Along a line through the body: von Mises stress and displacement."""
    table = result.probe_lines[name]
    way = np.stack([table[axis] for axis in "xyz" if axis in table], axis=1)
    s = np.linalg.norm(way - way[0], axis=1)
    second = axes.twinx()
    second.spines["right"].set_visible(True)
    stress, = axes.plot(s, table["mises"], "-", color=BLACK, label="von Mises stress")
    size = np.sqrt(sum(table[f"u{axis}"] ** 2 for axis in "xyz" if f"u{axis}" in table))
    moved, = second.plot(s, size, "--", color=BLUE, label="displacement")
    axes.set(xlabel=label("length along the probe", result.length_unit, "length"), ylabel=label("von Mises stress", result.stress_unit, "stress"), title=f"probe {name}")
    second.set_ylabel(label("displacement", result.length_unit, "length"))
    axes.legend(handles=[stress, moved], **BELOW, ncol=2)
    return [f"along the probe {name}"]
