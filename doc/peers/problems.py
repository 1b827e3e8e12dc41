# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the peers are told of the scenes of hpvi: numbers, closed forms, lines of a mesh, and where zones end."""
import numpy as np

# The half width a, the largest pressure, the gap c x^2 and the force of prm/hertz.prm.
HERTZ = {"a": 0.7, "p0": 7., "gap": 0.0455, "E": 200., "nu": 0.3}


def hertz_displacement(x, y):
    """u_x, u_y of the half plane above y = 0 under Hertz's pressure; the constant is that of prm/hertz.prm, null gap at x = 0."""
    a, k = HERTZ["a"], HERTZ["p0"] / HERTZ["a"]
    kappa, mu = 3 - 4 * HERTZ["nu"], HERTZ["E"] / (2 * (1 + HERTZ["nu"]))
    q = x * x - y * y - a * a
    s = np.sqrt(q * q + 4 * x * x * y * y)
    # No difference of equal numbers: the smaller root follows from the product m n = x y.
    large = np.sqrt((s + abs(q)) / 2)
    small = np.divide(abs(x * y), large, out=np.zeros_like(large), where=large > 0)
    m, n = np.where(q > 0, small, large), np.where(q > 0, large, small)
    n = np.where(x < 0, -n, n)
    X, Y = x + n, y + m
    h = np.hypot(X, Y)
    theta = np.arcsin(X / h)
    A = (x * x - y * y - x * n + y * m) / 2 + a * a / 2 * np.log(h / a)
    B = x * y - (x * m + y * n) / 2 - a * a * theta / 2
    return (k * ((kappa - 1) / 2 * B + y * (x - n)) / (2 * mu), -k * ((kappa + 1) / 2 * A + y * (y - m)) / (2 * mu))


def even(low, high, n):
    return np.linspace(low, high, n + 1)


def graded(points, n, only=None, power=2.5):
    """Lines that crowd where points (all, or those of @p only) are: between two of them 2 n cells, the i-th line (i/n)^power of
    the half away from its point. What a user does who knows where a solution is singular and where zones end. Powers are such that
    no cell is a thousand times as long as wide, which costs GetFEM unknowns."""
    away = (np.arange(n + 1) / n) ** power
    lines = [np.array([points[0]])]
    for left, right in zip(points, points[1:]):
        at_left, at_right = (only is None or point in only for point in (left, right))
        if at_left and at_right:
            middle = (left + right) / 2
            part = np.concatenate([left + (middle - left) * away, (right - (right - middle) * away[::-1])[1:]])
        elif at_left:
            part = left + (right - left) * away
        elif at_right:
            part = right - (right - left) * away[::-1]
        else:
            part = np.linspace(left, right, 2 * n + 1)
        lines.append(part[1:])
    return np.concatenate(lines)


def crossings(x, value):
    """Where a piecewise linear function changes its sign."""
    order = np.argsort(x)
    x, value = np.asarray(x)[order], np.asarray(value)[order]
    at = np.nonzero((value[1:] > 0) != (value[:-1] > 0))[0]
    return [float(x[i] + (x[i + 1] - x[i]) * value[i] / (value[i] - value[i + 1])) for i in at]


# Where zones end to a hundredth of their side, as a user reads it off a picture of an earlier run and grades a mesh by hand;
# and to a thousandth, off a picture of that.
ENDS = {"graded": {"hertz": [-0.72, 0.72], "ssnv128": [3.2, 30.], "example_5_2": [1.], "shrink_fit": [3.9, 8.7]},
        "regraded": {"hertz": [-0.7, 0.7], "ssnv128": [3.32, 29.84], "example_5_2": [0.992], "shrink_fit": [4.02, 8.58]}}


def lines(case, kind, n):
    """Grid lines of a case: even with n cells along the shorter side, or graded."""
    ends = ENDS[kind][case] if kind != "even" else None
    if case == "hertz":
        return (even(-2, 2, 2 * n), even(0, 2, n)) if kind == "even" else (
            graded([-2, *ends, 2], n, ends), graded([0, 2], 2 * n, [0], 2))
    if case == "ssnv128":
        return (even(0, 40, n), even(0, 40, n)) if kind == "even" else (
            graded([0, *ends, 40], n, ends, 2), graded([0, 40], 2 * n, [0], 2))
    if case == "example_5_2":  # the corners of the clamped side are singular too
        return (even(0, 4, n), even(0, 4, n)) if kind == "even" else (
            graded([0, *ends, 4], n, [*ends, 4]), graded([0, 4], n))
    if kind == "even":
        return even(0, 20, 2 * n), np.append(even(0, 30, 3 * n), even(30, 60, 3 * n)[1:]), even(20, 40, 2 * n)
    return (graded([0, 20], 2 * n, [20]), np.append(graded([0, *ends, 30], n, power=2), 30 + 30 * (np.arange(1, 2 * n + 1) / (2 * n)) ** 2),
            graded([20, 40], 2 * n, [20]))
