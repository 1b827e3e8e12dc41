# SPDX-License-Identifier: LGPL-2.1-or-later
"""Numbers as a reader wants them: no more digits than are certain, no round-off, each with its unit."""
import math

ROUND_OFF = 1e-9  # beside the largest of its kind: what is another number on each machine
UNSEEN = 1e-6  # beside the largest of its kind, of what has no interval: less than any estimate of the error is certain of


def digits(value, n):
    """With n significant digits, and no zeros behind them."""
    if value is None or not math.isfinite(value):
        return "–"
    if not value:
        return "0"
    rounded = float(f"{value:.{n}g}")
    power = math.floor(math.log10(abs(rounded)) + 1e-12)
    if not -5 < power < 7:
        return f"{rounded:g}" if n < 7 else f"{rounded:.{n}g}"
    text = f"{rounded:.{max(0, n - 1 - power)}f}"
    return text.rstrip("0").rstrip(".") if "." in text else text


def one_digit(value):
    """Rounded down to one."""
    unit = 10. ** math.floor(math.log10(value))
    return unit * math.floor(value / unit)


def interval(value, half):
    """As in "4.8137 ± 0.0004": the half width has two digits and is rounded up, the value ends where it does."""
    half = abs(half)  # of an energy it may be negative by round-off
    if half == 0 or not math.isfinite(half):
        return f"{digits(value, 6)} ± {digits(half, 2)}"
    unit = 10. ** (math.floor(math.log10(max(half, 1e-10 * abs(value)))) - 1)  # nobody wants to see twelve digits
    rounded = unit * round(value / unit)
    widened = math.ceil((half + abs(value - rounded)) / unit - 1e-6) * unit
    places = max(0, -round(math.log10(unit)))
    if places > 6 or abs(rounded) >= 1e7:
        n = 1 if rounded == 0 else max(1, math.floor(math.log10(abs(rounded)) + 1e-9) - round(math.log10(unit)) + 1)
        return f"{digits(rounded, min(n, 16))} ± {digits(widened, 3)}"
    return f"{rounded + 0.:.{places}f} ± {widened:.{places}f}"


def at_most(value):
    """Two digits, rounded up."""
    if not value > 0 or not math.isfinite(value):
        return digits(value, 2)
    unit = 10. ** (math.floor(math.log10(value)) - 1)
    return digits(unit * math.ceil(value / unit - 1e-9), 2)


def error(kind, size, coupling=None, zones=None, known=None):
    """An error of this size with the word for what is known of it: guaranteed, bounded, if, estimated."""
    known = f"if the coupling is at most {at_most(coupling or math.nan)} ({known or 'estimated'}; it must be below 2)"
    if kind == "coupling":
        return f"at most {size} for every solution of Coulomb's law, bounded {known}"
    if kind == "zones":
        return f"at most {size} if {zones}, and {known}"
    if kind == "history":
        return f"at most {size} for the slip that load steps before have computed, bounded" + (f" {known}" if coupling is not None and math.isfinite(coupling) else "")
    if kind == "estimate":
        return f"about {size}, estimated"
    return f"at most {size}, guaranteed"


class Numbers:
    """Numbers of one run. error: relative, in the energy norm, None where it is not known; size: of the body [length]."""

    def __init__(self, error, size):
        self.n = 4 if not error else min(6, max(2, 1 - math.floor(math.log10(error))))
        self.size = size

    def __call__(self, value, unit="", half=None, largest=None):
        """A value with its unit; half: of its interval; largest: beside which it may be round-off."""
        if value is None:
            return "–"
        if largest and (abs(value) <= UNSEEN * largest if half is None else max(abs(value), half) <= ROUND_OFF * largest):
            return "0"
        if half is not None and math.isfinite(half):
            known = interval(value, half) if half > 0 else digits(value, 6)
            return f"{known} {unit}".rstrip()
        return f"{digits(value, self.n)} {unit}".rstrip()

    def place(self, point):
        """As in "(1, 0)"."""
        return "(" + ", ".join(digits(0 if abs(x) <= 1e-6 * self.size else x, 5) for x in point if x is not None) + ")"

    def vector(self, values, unit="", largest=0):
        largest = max([largest, *(abs(value) for value in values if value is not None)])
        parts = [self(value, largest=largest) for value in values if value is not None]
        return f"({', '.join(parts)}) {unit}".rstrip()
