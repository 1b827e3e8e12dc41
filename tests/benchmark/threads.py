#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What threads bring: seconds by stage of a long run on one thread and on several, and their ratio.

Runs scenes with their guaranteed bound, output off. Runs on one thread and on several take turns, and of each number
that with the least seconds in all counts: what else the machine does disturbs it least. Start-up is not counted.
"""
import argparse
import os

from stages import STAGES, run

SCENES = (("han-6-12", ("Adaptivity/Method=hpa2", "Adaptivity/Maximum unknowns=20000")),
          ("han-6-12", ("Adaptivity/Method=hpa2", "Adaptivity/Maximum unknowns=60000")),
          ("han-6-12", ("Adaptivity/Method=hup2", "Adaptivity/Maximum unknowns=100000")),
          ("hertz", ("Adaptivity/Maximum unknowns=20000",)),
          ("bolt", ("Adaptivity/Maximum unknowns=20000",)))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default="build/hpvi")
    parser.add_argument("--runs", type=int, default=7, help="of each scene on each number of threads")
    parser.add_argument("--threads", type=int, default=min(2, len(os.sched_getaffinity(0))))
    arguments = parser.parse_args()
    numbers = (1, arguments.threads)
    for scene, settings in SCENES:
        runs = {n: [] for n in numbers}
        for _ in range(arguments.runs):
            for n in numbers:
                runs[n].append(run(arguments.program, f"prm/{scene}.prm",
                                   settings + ("Adaptivity/Maximum steps=100", f"Solver/Threads={n}")))
        unknowns = runs[1][0][1]
        one, many = (min((seconds for seconds, _ in runs[n]), key=lambda s: sum(s.values())) for n in numbers)
        print(f"{scene}, {', '.join(settings)}: {unknowns} unknowns at the end, best of {arguments.runs} runs each")
        print(f"stage      1 thread{arguments.threads:5d} threads  times faster")
        for stage in STAGES:
            ratio = f"{one[stage] / many[stage]:14.2f}" if many[stage] > 0.001 else f"{'-':>14}"
            print(f"{stage:10}{one[stage]:9.3f}{many[stage]:13.3f}{ratio}")
        for what, stages in (("no bound", [s for s in STAGES if s != "bound"]), ("total", STAGES)):
            a, b = (sum(s[k] for k in stages) for s in (one, many))
            print(f"{what:10}{a:9.3f}{b:13.3f}{a / b:14.2f}")
        print()


if __name__ == "__main__":
    main()
