#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run the tutorial program (doc/tutorial), put its table into its Readme.md and draw its picture.

tutorial.py --program build/tutorial/tresca_friction --output DIR
"""
import argparse
import csv
import pathlib
import re
import subprocess

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

HERE = pathlib.Path(__file__).resolve().parent / "tutorial"
COLOURS = ["#9ecae1", "#4292c6", "#08519c", "#d7301f"]


def put_results(table):
    """Indented by four, which is code in Markdown."""
    readme = HERE / "Readme.md"
    text = "".join(f"    {line.rstrip()}\n" for line in table.splitlines())
    begin = "<!-- results: begin, written by tutorial.py -->\n"
    readme.write_text(re.sub(re.escape(begin) + ".*?(?=<!-- results: end -->)",
                             lambda _: f"{begin}\n{text}\n", readme.read_text(), flags=re.S))


def draw(directory):
    figure, (slip, friction) = plt.subplots(2, 1, figsize=(7, 5), sharex=True,
                                            constrained_layout=True)
    for mesh, colour in enumerate(COLOURS, 1):
        with open(directory / f"contact-{mesh}.csv") as file:
            rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]
        x = [row["x"] for row in rows]
        n = 2 ** (mesh + 1)
        slip.plot(x, [1e3 * row["slip"] for row in rows], ".-", color=colour, markersize=4,
                  linewidth=1, label=f"{n} x {n} cells")
        friction.plot(x, [-4.5 * row["multiplier"] for row in rows], ".-", color=colour,
                      markersize=4, linewidth=1)
    slip.set_ylabel("displacement to the right [µm]")
    friction.set_ylabel("friction [kN/mm²]")
    friction.set_xlabel("x along the bottom [mm]")
    slip.legend(title="degree 3")
    for axes in (slip, friction):
        axes.grid(color="#dddddd")
    (HERE / "doc/images").mkdir(exist_ok=True)
    figure.savefig(HERE / "doc/images/contact.png", dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", required=True, type=pathlib.Path)
    parser.add_argument("--output", required=True, type=pathlib.Path)
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    table = subprocess.run([options.program.resolve()], cwd=options.output, check=True, text=True,
                           stdout=subprocess.PIPE).stdout
    print(table, end="")
    put_results(table)
    draw(options.output)


if __name__ == "__main__":
    main()
