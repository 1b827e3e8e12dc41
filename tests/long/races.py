#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Do threads of a step read what another one writes? The plane scenes of prm/ under the sanitizer for threads.

The libraries are not built for it, so that deal.II's own threads, which it cannot understand, are left out, and locks that
are taken in one library and given back in another are not counted.
"""
import argparse
import os
import pathlib
import platform
import re
import subprocess
import sys
import tempfile


def reports_of(program, scene, steps):
    """What is wrong with the first steps of a scene on two threads; empty: nothing."""
    environment = dict(os.environ, DEAL_II_NUM_THREADS="1",
                       TSAN_OPTIONS="detect_deadlocks=0 report_mutex_bugs=0 exitcode=66")
    with tempfile.TemporaryDirectory() as home:
        # The sanitizer wants addresses that are not random.
        command = ["setarch", platform.machine(), "-R", program, "--output", home, str(scene),
                   "--set", "Solver/Threads=2", "--set", f"Adaptivity/Maximum steps={steps}"]
        done = subprocess.run(command, capture_output=True, text=True, errors="replace", env=environment)
    found = sorted(set(re.findall(r"^SUMMARY: ThreadSanitizer: .*", done.stderr, re.M)))
    return found or ([] if done.returncode == 0 else [f"status {done.returncode}: {done.stderr[-500:]}"])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", help="built with -fsanitize=thread")
    parser.add_argument("--steps", type=int, default=4)
    parser.add_argument("scenes", nargs="*", type=pathlib.Path)
    arguments = parser.parse_args()
    scenes = arguments.scenes or [scene for scene in sorted(pathlib.Path("prm").glob("*.prm"))
                                  if not re.search(r"set\s+Dimension\s*=\s*3", scene.read_text())]
    failed = 0
    for scene in scenes:
        found = reports_of(arguments.program, scene, arguments.steps)
        failed += bool(found)
        print(f"{scene}: {'; '.join(found) or 'no race'}", flush=True)
    print(f"{len(scenes)} scenes, {failed} with reports")
    sys.exit(failed > 0)


if __name__ == "__main__":
    main()
