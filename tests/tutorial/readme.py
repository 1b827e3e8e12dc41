#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What README.md shows to a new user works: its first scene runs, in ten lines at most, prints what stands below it, with a bound of
the error and no friction on what is open, and with Coulomb's friction; so does its scene of two bodies from a drawing, of ten
entries; the program has the options that it names.

readme.py HPVI ROOT
"""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

HPVI, ROOT = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
README = (ROOT / "README.md").read_text()


def check_run(what, scene, has_bound):
    """@p scene has parts that are open, stick and slip, no friction on what is open, and a guaranteed bound or none."""
    with tempfile.TemporaryDirectory() as directory:
        path = pathlib.Path(directory) / "first.prm"
        path.write_text(scene)
        done = subprocess.run([HPVI, path], cwd=directory, text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT)
        if done.returncode != 0:
            sys.exit(done.stdout)
        for state in ("open", "stick", "slip"):
            if not re.search(rf"^  {state} from", done.stdout, re.M):
                sys.exit(f"README.md: {what} has nothing that is {state}\n{done.stdout}")
        if "friction acts where contact is open" in done.stdout:
            sys.exit(f"README.md: {what} shears what is open\n{done.stdout}")
        summary = json.loads((pathlib.Path(directory) / "output/first/summary.json").read_text())
        if (summary["error_bound"] is not None) != has_bound:
            sys.exit(f"README.md: {what} has {'no' if has_bound else 'a'} bound of its error")


def near(shown, printed):
    """Equal but for numbers, which differ by a hundredth at most."""
    number = r"[-+]?\d[\d.]*(?:e[-+]\d+)?"
    return re.sub(number, "N", shown) == re.sub(number, "N", printed) and all(
        abs(float(a) - float(b)) <= 0.01 * abs(float(b))
        for a, b in zip(re.findall(number, shown), re.findall(number, printed)))


def check_output(shown):
    """The lines that README shows are printed, in this order."""
    with tempfile.TemporaryDirectory() as directory:
        (pathlib.Path(directory) / "first.prm").write_text(re.search(r"`first\.prm`.*?```\n(.*?)```", README, re.S)[1])
        printed = iter(subprocess.run([HPVI, "first.prm"], cwd=directory, text=True, stdout=subprocess.PIPE, check=True).stdout.splitlines())
    for line in shown.splitlines():
        if not any(near(line, one) for one in printed):
            sys.exit(f"README.md: first.prm does not print, after the line above, {line}")


def check_commands(scene):
    """What README says to do with first.prm runs: it is drawn, described, solved and continued."""
    with tempfile.TemporaryDirectory() as directory:
        (pathlib.Path(directory) / "first.prm").write_text(scene)
        commands = re.findall(r"`(?:\./run|build/hpvi) (first\.prm[^`]*|--resume [^`]*)`", README)
        for command in commands:
            steps = 3 if "--resume" in command else 2
            done = subprocess.run([HPVI, *command.split(), "--set", f"Adaptivity/Maximum steps={steps}"], cwd=directory, text=True,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            if done.returncode != 0:
                sys.exit(f"README.md: {command} fails\n{done.stdout}")
        if len(commands) < 4:
            sys.exit(f"README.md: of what to do with first.prm there is only {commands}")


def check_two_bodies():
    """The scene of two bodies from a drawing has ten entries, and is solved."""
    scene = re.search(r"`lug\.prm`.*?```\n(.*?)```", README, re.S)[1]
    if scene.count("  set ") != 10:
        sys.exit("README.md: lug.prm has not ten entries")
    with tempfile.TemporaryDirectory() as directory:
        (pathlib.Path(directory) / "lug.prm").write_text(scene)
        shutil.copy(ROOT / "prm/meshes/lug.step", directory)
        done = subprocess.run([HPVI, "lug.prm", "--set", "Adaptivity/Maximum steps=2"], cwd=directory, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        if done.returncode != 0 or not re.search("^  slip from", done.stdout, re.M):
            sys.exit(f"README.md: lug.prm is not solved, or does not slip\n{done.stdout}")


def check_first_scene():
    scene = re.search(r"`first\.prm`.*?```\n(.*?)```.*?^```\n(contact.*?)```.*?^```\n(subsection Boundary bottom.*?)```", README, re.S | re.M)
    if not scene:
        sys.exit("README.md: there is no first.prm, or none with Coulomb's friction")
    n_lines = len(scene[1].splitlines())
    if n_lines > 10:
        sys.exit(f"README.md: first.prm has {n_lines} lines, more than 10")
    check_run("first.prm", scene[1], True)
    check_commands(scene[1])
    check_output(scene[2])
    coulomb = re.sub(r"subsection Boundary bottom.*?\nend\n", lambda _: scene[3], scene[1], flags=re.S)
    check_run("first.prm with Coulomb's friction", coulomb, True)


def missing_options():
    known = subprocess.run([HPVI, "--help"], stdout=subprocess.PIPE, text=True, check=True).stdout
    return [f"README.md names {option}, which is no option of hpvi"
            for option in re.findall(r"(?:hpvi|\.prm) (--[\w-]+)", README) if f" {option} " not in known]


def main():
    missing = missing_options()
    if missing:
        sys.exit("\n".join(missing))
    check_first_scene()
    check_two_bodies()


if __name__ == "__main__":
    main()
