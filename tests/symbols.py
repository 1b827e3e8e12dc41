#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""symbols.py ROOT OBJECTS: what includes do not show, by the symbols of the library's objects.

No room needs a function of a room that comes later in the map; the functions of a class are defined in the room of its header; and these
arrows, which would lead down, are never drawn."""
import collections
import pathlib
import re
import subprocess
import sys

ROOT, OBJECTS = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
sys.path.append(str(ROOT / "doc"))
import rooms

ORDER = list(rooms.rooms(ROOT))
# From whom to what, and why not.
NEVER = {("solvers", "reader"): "solvers know problems, not files", ("algebra", "reader"): "algebra knows no scene",
         ("algebra", "scene"): "algebra knows no scene", ("bound", "solvers"): "the bound asks for no solver",
         ("output", "solvers"): "output has numbers handed in"}
ALLOWED = {("bound", "solvers"): r"InequalityProgram|QuadraticProgram"}
SYMBOL = re.compile(r"^[0-9a-f ]{16} (\w) (.*)$")
MEMBER = re.compile(r"^(?:[\w:<>,\[\] *&]* )?hpvi::(\w+)(?:<\d>)?::\w+(?:\[abi:cxx11\])?\(")


def room_of(path):
    """Of an object: a unit of several sources is named after their folder."""
    folder = re.match(r"unity_(\w+?)_\d+_cxx", path.name)
    folder = folder[1] if folder else path.relative_to(OBJECTS / "source").parts[0]
    if folder in ORDER:
        return folder
    return next((room for room in ORDER if (ROOT / "source" / room / folder).is_dir()), None)


def symbols():
    """Defined and needed functions of hpvi, each with its rooms."""
    defined, needed = collections.defaultdict(set), collections.defaultdict(set)
    for path in [*OBJECTS.glob("Unity/*.o"), *OBJECTS.glob("source/**/*.o")]:
        listed = subprocess.run(["nm", "-C", path], capture_output=True, text=True, check=True).stdout
        for kind, name in (match.groups() for match in map(SYMBOL.match, listed.splitlines()) if match):
            if "hpvi::" in name:
                (needed if kind == "U" else defined)[name].add(room_of(path))
    return defined, needed


def home_of_classes():
    """The room of the header that declares a class, where that is one alone."""
    homes = collections.defaultdict(set)
    for room in ORDER:
        for file in (ROOT / "include/hpvi" / room).rglob("*.h"):
            for name in re.findall(r"^(?:class|struct) (\w+)(?: [^;]*)?$", file.read_text(), re.M):
                homes[name].add(room)
    return {name: next(iter(found)) for name, found in homes.items() if len(found) == 1}


def problems(defined, needed):
    homes, found = home_of_classes(), set()
    for name, users in needed.items():
        for user in users:
            owner = min(defined.get(name, {user}), key=ORDER.index)  # templates and inline functions are defined where they are used, too
            if ORDER.index(owner) > ORDER.index(user):
                found.add(f"{user} needs {name} of {owner}, which comes later")
            if (user, owner) in NEVER and not re.search(ALLOWED.get((user, owner), "$^"), name):
                found.add(f"{user} needs {name} of {owner}: {NEVER[user, owner]}")
    for name, owners in defined.items():
        member = MEMBER.match(name)
        home = homes.get(member[1]) if member else None
        if home and home not in owners and all(ORDER.index(owner) > ORDER.index(home) for owner in owners) and not is_inline(member[1], name, home):
            found.add(f"{name} is defined in {min(owners, key=ORDER.index)}, and its class stands in {home}")
    return sorted(found)


def is_inline(noun, name, home):
    """Is the function made by the compiler, or defined in its header? Then it is where it is used."""
    function = re.search(r"::(~?\w+)(?:\[abi:cxx11\])?\(", name[name.index(f"hpvi::{noun}"):])[1]
    if function.lstrip("~") == noun:
        return True
    text = "".join(file.read_text() for file in (ROOT / "include/hpvi" / home).rglob("*.h"))
    return re.search(rf"\b{function}\([^;{{}}]*\)(?: const)?(?:\s*:[^;{{}}]*(?:\{{[^{{}}]*\}}[^;{{}}]*)*)?\s*\{{", text) is not None


defined, needed = symbols()
if not defined:
    sys.exit(f"{OBJECTS} has no objects with symbols of hpvi")
sys.exit("\n".join(problems(defined, needed)) or 0)
