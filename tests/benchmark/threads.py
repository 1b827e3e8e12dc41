#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What threads bring: seconds by stage of a long run on one thread and on several, and their ratio; and what the bound costs.

Runs scenes with their guaranteed bound and without, output off. Runs on one thread and on several take turns, and of each kind
that with the least seconds in all counts: what else the machine does disturbs it least. Start-up is not counted. Where one step is
solved while the error of another is bounded, seconds of stages are shares of the time that passes.
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
        runs = {(n, bound): [] for bound in ("true", "false") for n in numbers}
        for _ in range(arguments.runs):
            for (n, bound), of_kind in runs.items():
                of_kind.append(run(arguments.program, f"prm/{scene}.prm",
                                   settings + ("Adaptivity/Maximum steps=100", f"Solver/Threads={n}",
                                               f"Error/Bound={bound}")))
        unknowns = runs[1, "true"][0][1]
        best = {kind: min((seconds for seconds, _ in of_kind), key=lambda s: sum(s.values()))
                for kind, of_kind in runs.items()}
        one, many = (best[n, "true"] for n in numbers)
        print(f"{scene}, {', '.join(settings)}: {unknowns} unknowns at the end, best of {arguments.runs} runs each")
        print(f"stage         1 thread{arguments.threads:5d} threads  times faster")
        for stage in STAGES:
            ratio = f"{one[stage] / many[stage]:14.2f}" if many[stage] > 0.001 else f"{'-':>14}"
            print(f"{stage:13}{one[stage]:9.3f}{many[stage]:13.3f}{ratio}")
        total = {kind: sum(seconds.values()) for kind, seconds in best.items()}
        for what, bound in (("total", "true"), ("no bound", "false")):
            a, b = (total[n, bound] for n in numbers)
            print(f"{what:13}{a:9.3f}{b:13.3f}{a / b:14.2f}")
        adds = [total[n, "true"] / total[n, "false"] - 1 for n in numbers]
        print(f"{'bound adds':13}{adds[0]:9.2f}{adds[1]:13.2f}")
        print(flush=True)


if __name__ == "__main__":
    main()
