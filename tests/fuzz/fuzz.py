#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Spoils scenes at random and runs them: no crash, no hang, no status but 0, 1 and 2, one line where it is not 0, tables, JSON
and XML that can be read, no bound below the error, forces in balance, 2 GB at most.

fuzz.py HPVI --seconds SECONDS [--seed SEED] [--server LIBRARY] [--output DIR] [--number N] [--only K]

Input K of a seed is the same whatever came before. A finding goes to DIR/KKKKKK with its scene, made as short as it stays one, and
the command that repeats it. With the library of server.cc a run costs a tenth of its start.
"""
import argparse
import collections
import dataclasses
import os
import pathlib
import resource
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import findings
import mutator
import served

ROOT = pathlib.Path(__file__).resolve().parents[2]
MEGABYTES, CPU_SECONDS, WALL_SECONDS = 4000, 15, 300
ENVIRONMENT = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "LC_ALL": "C", "OMPI_ALLOW_RUN_AS_ROOT": "1",
               "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


@dataclasses.dataclass
class Run:
    """How a run ended."""
    status: int
    signal: int
    kilobytes: int
    seconds: float
    errors: bytes
    timed_out: bool
    writes_nothing: bool


class Program:
    """Runs hpvi in a directory of its own, by its server where there is one."""

    def __init__(self, program, library, scratch):
        self.program, self.preload, self.scratch, self.server = str(program), library, scratch, None
        self.environment = {**ENVIRONMENT, "TMPDIR": str(scratch)}

    def stop(self):
        if self.server:
            self.server.stop()

    def served(self, arguments, home):
        """Status as of waitpid, kilobytes, seconds, was it ended?"""
        if not self.server:
            self.server = served.Server(self.program, self.preload, self.environment, self.scratch)
        return self.server.run(arguments, home, "../stdout", "../stderr", MEGABYTES, CPU_SECONDS, WALL_SECONDS)

    def alone(self, arguments, home):
        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (MEGABYTES << 20, MEGABYTES << 20))
            resource.setrlimit(resource.RLIMIT_CPU, (CPU_SECONDS, CPU_SECONDS))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        with open(self.scratch / "stdout", "wb") as out, open(self.scratch / "stderr", "wb") as errors:
            child = subprocess.Popen([self.program, *arguments], stdin=subprocess.DEVNULL, stdout=out, stderr=errors, cwd=home,
                                     env=self.environment, preexec_fn=limit)
            _, status, usage = os.wait4(child.pid, 0)
            child.returncode = 0
        return status, usage.ru_maxrss, usage.ru_utime + usage.ru_stime, False

    def run(self, files, arguments):
        home = self.scratch / "home"
        shutil.rmtree(home, ignore_errors=True)
        for name, data in files.items():
            (home / name).parent.mkdir(parents=True, exist_ok=True)
            (home / name).write_bytes(data)
        status, kilobytes, seconds, ended = (self.served if self.preload else self.alone)(arguments + ([] if "--inf-sup" in arguments else ["--output", "out"]), home)
        number = os.WTERMSIG(status) if os.WIFSIGNALED(status) else 0
        run = Run(os.waitstatus_to_exitcode(status), number, kilobytes, seconds, (self.scratch / "stderr").read_bytes(),
                  ended or number in (signal.SIGXCPU, signal.SIGKILL), any(a in ("--validate", "--print-parameters", "--inf-sup") for a in arguments))
        return run, home / "out"

    def finding(self, spoilt):
        """What is wrong, and the run."""
        run, results = self.run(spoilt.files, spoilt.arguments)
        wrong = findings.finding(run, list(spoilt.files), results)
        if not wrong and run.status == 0 and "--print-parameters" in spoilt.arguments:
            wrong = self.reads_what_it_prints(spoilt)
        return wrong, run

    def reads_what_it_prints(self, spoilt):
        printed = (self.scratch / "stdout").read_bytes()
        scene = next(iter(spoilt.files))
        run, _ = self.run({**spoilt.files, scene: printed}, [scene, "--print-parameters"])
        if run.status != 0:
            return "what it prints is refused"
        return "" if (self.scratch / "stdout").read_bytes() == printed else "what it prints is read otherwise"


def shortened(program, spoilt, wrong, most=60):
    """The same finding with fewer lines and overrides, by halves, quarters and so on."""
    scene = next(iter(spoilt.files))
    lines = spoilt.files[scene].split(b"\n")
    pairs = [spoilt.arguments[i:i + 2] for i, a in enumerate(spoilt.arguments) if a == "--set"]
    rest = [a for i, a in enumerate(spoilt.arguments) if a != "--set" and (i == 0 or spoilt.arguments[i - 1] != "--set")]
    count = 0

    def build(lines, pairs):
        return dataclasses.replace(spoilt, files={**spoilt.files, scene: b"\n".join(lines)}, arguments=rest + sum(pairs, []))

    for which in (lines, pairs):
        piece = max(1, len(which) // 2)
        while piece and count < most:
            i = 0
            while i < len(which) and count < most:
                kept = which[:i] + which[i + piece:]
                count += 1
                if program.finding(build(kept, pairs) if which is lines else build(lines, kept))[0] == wrong:
                    which[:] = kept
                else:
                    i += piece
            piece //= 2
    return build(lines, pairs)


def keep(program, directory, spoilt, wrong, run, command, is_new):
    """Scene, its line, and the command that repeats it."""
    shutil.rmtree(directory, ignore_errors=True)
    short = shortened(program, spoilt, wrong) if is_new and not run.timed_out else spoilt
    for folder, files in (("", short.files), ("as_found", spoilt.files)):
        for name, data in files.items():
            (directory / folder / name).parent.mkdir(parents=True, exist_ok=True)
            (directory / folder / name).write_bytes(data)
    own = [shlex.join([program.program, *each.arguments, *([] if "--inf-sup" in each.arguments else ["--output", "out"])]) for each in (short, spoilt)]
    (directory / "README").write_text(f"{wrong}\n\ncd {directory} && {own[0]}\ncd {directory}/as_found && {own[1]}\n{command}\n\n"
                                      f"{run.errors.decode(errors='replace')}", errors="replace")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--seed", default="1")
    parser.add_argument("--server", type=lambda name: pathlib.Path(name).resolve())
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("output/fuzz"))
    parser.add_argument("--number", type=int, default=10**9)
    parser.add_argument("--only", type=int)
    options = parser.parse_args()
    scenes = mutator.scenes_of(ROOT)
    library = mutator.Vocabulary(options.program, scenes)
    begin, count, statuses, found, slowest, largest = time.monotonic(), 0, collections.Counter(), [], 0., 0
    with tempfile.TemporaryDirectory() as scratch:
        program = Program(options.program.resolve(), options.server, pathlib.Path(scratch))
        k = options.only or 0
        while count < (1 if options.only is not None else options.number) and time.monotonic() - begin < options.seconds:
            spoilt = mutator.Mutator(library, f"{options.seed}/{k}").make(scenes)
            wrong, run = program.finding(spoilt)
            count += 1
            statuses[run.status] += 1
            slowest, largest = max(slowest, run.seconds), max(largest, run.kilobytes)
            if wrong:
                is_new = wrong not in found
                found.append(wrong)
                directory = options.output.resolve() / f"{k:06}"
                keep(program, directory, spoilt, wrong, run, f"{shlex.join(sys.argv[:2])} --seed {options.seed} --only {k}", is_new)
                print(f"FOUND: {wrong}, from {spoilt.origin}: {directory}", file=sys.stderr, flush=True)
            k += 1
        program.stop()
    share = ", ".join(f"{100 * statuses[s] / max(1, count):.0f} % status {s}" for s in (0, 1, 2))
    print(f"{count} spoilt scenes of seed {options.seed} in {time.monotonic() - begin:.0f} s: {share}; "
          f"at most {slowest:.1f} s and {largest / 1e6:.2f} GB; {len(found)} findings")
    for wrong, times in collections.Counter(found).most_common():
        print(f"  {times} times: {wrong}")
    # Both answers must have been heard, or the fuzzer says nothing.
    return 1 if found or (count >= 100 and min(statuses[0], statuses[1]) < count / 10) else 0


if __name__ == "__main__":
    sys.exit(main())
