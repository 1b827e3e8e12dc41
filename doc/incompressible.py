#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What stresses in equilibrium and the error are made of near incompressibility.

Runs tests/benchmark/incompressible.cc on the stick-slip field in plane strain, and writes a table to
doc/bound/ and into doc/bound.md, between its marker comments.
"""
import argparse
import csv
import io
import os
import subprocess

from stability import plain, put_table


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default="build/tests/incompressible")
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    done = subprocess.run([parser.parse_args().program], check=True, capture_output=True, text=True)
    rows = []
    for row in csv.DictReader(io.StringIO(done.stdout)):
        if any(row["nu"] == other["nu"] and row["degree"] == other["p"] and
               row["dofs_free"] == other["N"] for other in rows):
            continue  # both methods begin there
        value = {k: float(v) for k, v in row.items() if k != "method"}
        rows.append({"nu": row["nu"], "p": row["degree"], "N": row["dofs_free"],
                     "eta/error by u_N": plain(value["eta_of_u_N"] / value["error"], 2),
                     "shear in it": plain((value["shear_of_u_N"] / value["eta_of_u_N"]) ** 2, 3),
                     "shear in error^2": plain((value["error_shear"] / value["error"]) ** 2, 3),
                     "eta/error": plain(value["eta"] / value["error"], 2)})
    put_table("incompressible", rows, page="bound")


if __name__ == "__main__":
    main()
