# SPDX-License-Identifier: LGPL-2.1-or-later
"""hp finite elements for elastic bodies in contact with friction.

    hpvi.Scene("prm/punch.prm").solve()     solves, and returns a Result

hpvi.results reads a directory of results, hpvi.plot draws it and Results, hpvi.report makes a page of it, and hpvi.benchmarks has published cases.
"""
import importlib

PARTS = ("benchmarks", "plot", "render", "report", "results", "space", "words")


def __getattr__(name):
    """What is compiled is loaded when it is first asked for: pictures and reports do without."""
    if name in PARTS:
        return importlib.import_module(f".{name}", __name__)
    if name.startswith("__") and name != "__version__":
        raise AttributeError(name)
    return getattr(importlib.import_module("._hpvi", __name__), name)


def __dir__():
    compiled = importlib.import_module("._hpvi", __name__)
    return sorted({*globals(), *PARTS, *(name for name in dir(compiled) if not name.startswith("_")), "__version__"})
