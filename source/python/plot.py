# SPDX-License-Identifier: LGPL-2.1-or-later
"""The pictures of Result.plot(), by matplotlib: a part of the module, which reads this text when the first is drawn."""
import numpy as np

STATES = {"open": "#999999", "slip": "#d55e00", "stick": "#56b4e9"}
ERRORS = {"error_bound_relative": "guaranteed bound", "error_relative": "true error",
          "estimate_relative": "indicator"}
PER_CELL = 7  # points a direction and cell, at which stresses are taken


def plot(result, what=None, axes=None, scale=None):
    """One of `body`, `contact` and `convergence`, into axes if given; without a name all that there are. Returns the figure."""
    try:
        import matplotlib.pyplot as plt
    except ImportError:
        raise ImportError("plot() needs matplotlib; install python3-matplotlib") from None
    drawn = {"body": draw_body, "contact": draw_contact, "convergence": draw_convergence}
    if what is not None and what not in drawn:
        raise ValueError(f"plot({what!r}): there are body, contact and convergence")
    if what is None and axes is not None:
        raise ValueError("axes are for one picture: name body, contact or convergence")
    if what != "convergence" and result.dimension == 3:
        raise NotImplementedError("plot() draws bodies in the plane alone; solve(output=DIR) writes files for ParaView, and "
                                  "plot(\"convergence\") shows the errors")
    names = [what] if what else [name for name in drawn if name != "contact" or result.contact]
    if axes is None:
        figure, several = plt.subplots(1, len(names), figsize=(5.2 * len(names), 4.2), layout="constrained", squeeze=False)
        figure.get_layout_engine().set(wspace=0.08)
        places = several[0]
    else:
        figure, places = axes.figure, [axes]
    for name, place in zip(names, places):
        drawn[name](result, place, **({"scale": scale} if name == "body" else {}))
    if axes is None:
        plt.close(figure)  # notebooks show what a cell returns, and would show it twice
    return figure


def label(name, unit, kind):
    """A scene that names no unit has its own."""
    return f"{name} [{unit or 'unit of ' + kind}]"


def von_mises(stress):
    deviator = stress - np.trace(stress, axis1=-2, axis2=-1)[..., None, None] / 3 * np.eye(3)
    return np.sqrt(1.5 * (deviator ** 2).sum(axis=(-2, -1)))


def usual(values, weights):
    """What 99.5 % of the weight stay below; the largest value if that is near: what is unbounded somewhere would hide all else."""
    order = np.argsort(values)
    share = weights[order].cumsum()
    limit = values[order][np.searchsorted(share, 0.995 * share[-1]).clip(max=len(values) - 1)]
    return limit if values.max() > 1.3 * limit > 0 else values.max()


def round_scale(displacement, x):
    """Which shows the displacement as a twelfth of the body, with one digit; never less than it is."""
    size, largest = np.ptp(x.reshape(-1, 2), axis=0).max(), np.linalg.norm(displacement, axis=-1).max()
    if largest == 0 or size <= 12 * largest:
        return 1.
    digits = 10 ** np.floor(np.log10(size / (12 * largest)))
    return max(1., digits * np.floor(size / (12 * largest) / digits))


def draw_body(result, axes, scale=None):
    """Von Mises stress on the deformed body, with its cells."""
    from matplotlib.collections import LineCollection
    cells = result.grid(PER_CELL)
    x, u, stress = cells["x"], cells["u"], von_mises(cells["stress"])
    scale = round_scale(u, x) if scale is None else scale
    moved, n = x + scale * u, PER_CELL
    # Two triangles of each square between neighbouring points.
    corner = (np.arange(len(x))[:, None, None] * n + np.arange(n - 1)[:, None]) * n + np.arange(n - 1)
    corner = corner.ravel()
    triangles = np.concatenate([np.stack([corner, corner + n, corner + n + 1], 1),
                                np.stack([corner, corner + n + 1, corner + 1], 1)])
    a, b, c = np.moveaxis(x.reshape(-1, 2)[triangles], 1, 0)
    areas = abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    limit = usual(stress.ravel()[triangles].max(axis=1), areas)
    colours = axes.tripcolor(*moved.reshape(-1, 2).T, triangles, stress.ravel(), shading="gouraud", cmap="viridis",
                             vmin=0, vmax=limit or 1, rasterized=True)
    edges = [moved[:, 0], moved[:, -1], moved[:, :, 0], moved[:, :, -1]]
    axes.add_collection(LineCollection(np.concatenate(edges), colors="white", linewidths=0.4))
    axes.set(aspect="equal", xlabel=label("x", result.length_unit, "length"), ylabel=label("y", result.length_unit, "length"),
             title="deformed body" if scale == 1 else f"displacement {scale:g} times")
    axes.figure.colorbar(colours, ax=axes, label=label("von Mises stress", result.stress_unit, "stress"),
                         extend="max" if stress.max() > limit else "neither")


def along(x, y):
    """A coordinate along a boundary and its name: x or y where it is straight, else the length along it."""
    width, height = np.ptp(x), np.ptp(y)
    if height <= 1e-9 * width:
        return x, "x"
    if width <= 1e-9 * height:
        return y, "y"
    return np.concatenate([[0.], np.hypot(np.diff(x), np.diff(y)).cumsum()]), "length along the boundary"


def draw_contact(result, axes):
    """Pressure and friction along each contact boundary, and where it is open, slips and sticks."""
    table = result.contact
    if not table:
        raise ValueError("plot(\"contact\"): the scene has no contact")
    boundaries, sizes = list(dict.fromkeys(table["boundary"])), []
    for k, boundary in enumerate(boundaries):
        of_it = table["boundary"] == boundary
        s, name = along(table["x"][of_it], table["y"][of_it])
        order, suffix = np.argsort(s, kind="stable"), f", {boundary}" if len(boundaries) > 1 else ""
        for column, sign, words, style in (("normal_traction", -1, "pressure", "-"), ("tangential_traction", 1, "friction", "--")):
            values = sign * table[column][of_it][order]
            axes.plot(s[order], values, style, color=f"C{k}", label=words + suffix)
            if len(s) > 1:
                sizes += [sided * usual((sided * values).clip(0), np.gradient(s[order])) for sided in (-1, 1)]
        for state, colour in STATES.items():
            is_in = table["state"][of_it] == state
            if is_in.any():
                axes.plot(s[is_in], np.full(is_in.sum(), -0.03), "s", markersize=4, color=colour, clip_on=False,
                          transform=axes.get_xaxis_transform(), label=None if state in axes.get_legend_handles_labels()[1] else state)
    axes.axhline(0, color="black", linewidth=0.6, zorder=0)
    axes.tick_params(axis="x", pad=8)
    low, high = min(sizes, default=0), max(sizes, default=0)
    if low < high:
        axes.set_ylim(low - 0.1 * (high - low), high + 0.1 * (high - low))
    axes.set(xlabel=label(name, result.length_unit, "length"), ylabel=label("traction", result.stress_unit, "stress"),
             title="contact of " + ", ".join(boundaries))
    axes.legend(frameon=False)


def draw_convergence(result, axes):
    """Relative errors over the number of unknowns; of a load history those of the last load step."""
    table = result.steps
    if not table:
        raise ValueError("plot(\"convergence\"): no step is finished")
    last = table["load_step"] == table["load_step"][-1] if "load_step" in table else slice(None)
    depends = np.isfinite(table["coupling"]).any()  # of Coulomb's law
    for column, words in ERRORS.items():
        if depends and column == "error_bound_relative":
            words = "bound, if the coupling is as estimated"
        values = table[column][last]
        known = np.isfinite(values)  # not each step need have its bound
        if known.any():
            axes.loglog(table["dofs_free"][last][known], values[known], "o-", markersize=4, label=words)
    axes.set(xlabel="unknowns", ylabel="relative error", title="convergence")
    axes.grid(True, which="both", linewidth=0.3)
    axes.legend(frameon=False)
