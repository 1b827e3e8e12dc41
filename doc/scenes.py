#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The scenes of prm/ by what they show, read from their entries: prm/README.md and a page of the manual; and their pictures beside each
other in doc/manual/gallery.md, whose table has the words of each.

scenes.py --write | --check

--check ends with 1 where these pages are not what --write writes, a scene has no picture, or the table names one that is not there.
"""
import pathlib
import re
import sys
import textwrap

ROOT = pathlib.Path(__file__).resolve().parent.parent
GALLERY = ROOT / "doc/manual/gallery.md"
ROW = re.compile(r"^\| \[([\w-]+)\.prm\]\(.*?\) \| .*? \| (.*?) \| (.*?) \|$", re.M)
BEGIN, END = "<!-- what follows as far as the next remark is written by doc/scenes.py -->\n", "<!-- until here -->\n"
SPACE = "space"
# Groups and what there is in each, in the order of the page.
GROUPS = {
    "Contact": ("none", "bilateral", "unilateral", "tangential", "with a gap", "along a direction", "of several bodies, unilateral",
                "of several bodies, bilateral", "of several bodies, tangential", "of several bodies, tied", "several contact boundaries"),
    "Friction": ("none", "Tresca", "Coulomb", "limited", "cohesive", "by pressure"),
    "Body": ("box", "quadrilateral", "ring sector", "half disc", "plate with hole", "file", "several bodies", "curved edges",
             "body of revolution", "plane stress", "plane strain", SPACE),
    "Material": ("several materials", "orthotropic", "nearly incompressible", "weight", "thickness", "initial strain", "heat"),
    "Supports": ("prescribed displacement", "plane of symmetry", "elastic foundation", "rigid plate", "contact and friction alone"),
    "Loads": ("traction", "pressure", "force per volume", "parts of sides", "load history", "bolt that is tightened"),
    "Results": ("guaranteed bound", "bound by the coupling", "closed form", "probes")}


def assignments(text):
    """(section, entry, value, comment above) of each `set` of a .prm."""
    section, comment, found = "", [], []
    for line in map(str.strip, text.splitlines()):
        if line.startswith("#"):
            comment.append(line.lstrip("# "))
            if line.startswith("# ---"):
                comment = []  # ends deal.II's headline
            continue
        if line.startswith("subsection "):
            section = re.sub(r"\s*#.*", "", line[len("subsection "):])
        elif line == "end":
            section = ""
        elif line.startswith("set "):
            name, value = line[4:].split("=", 1)
            found.append((section, name.strip(), re.sub(r"\s*#.*", "", value).strip(),
                          " ".join(comment)))
        comment = []
    return found


class Scene:
    def __init__(self, path, words, has_bound):
        self.name = path.stem
        self.entries = [(section, name, value) for section, name, value, _ in assignments(path.read_text()) if value]
        self.in_space = ("", "Dimension", "3") in self.entries
        self.words = words or next(value for section, name, value in self.entries if name == "Title")
        self.shows = {group: self.found(group, has_bound) for group in GROUPS}

    def values(self, kind, name):
        """Those of an entry in all sections of a kind."""
        return [value for section, entry, value in self.entries if section.split(" ")[0] == kind and entry == name]

    def found(self, group, has_bound):
        return [one for one in GROUPS[group] if one in getattr(self, group.lower())(has_bound)]

    def contact(self, _):
        own = {value for value in self.values("Boundary", "Contact") if value != "none"}
        pairs = self.values("Contact", "Between")
        of_pairs = {f"of several bodies, {law}" for law in self.values("Contact", "Law") or (["unilateral"] if pairs else [])}
        gaps = [value for kind in ("Boundary", "Contact") for value in self.values(kind, "Gap") if value != "0"]
        n = sum(value != "none" for value in self.values("Boundary", "Contact")) + len(pairs)
        return own | of_pairs | ({"with a gap"} if gaps else set()) \
            | ({"along a direction"} if self.values("Boundary", "Contact direction") else set()) \
            | ({"several contact boundaries"} if n > 1 else set()) | (set() if own | of_pairs else {"none"})

    def friction(self, _):
        laws = set()
        for section in {section for section, _, _ in self.entries if section.split(" ")[0] in ("Boundary", "Contact")}:
            own = {name: value for other, name, value in self.entries if other == section}
            bound, coefficient = (own.get(name, "0") != "0" for name in ("Friction bound", "Friction coefficient"))
            if bound and coefficient:
                laws.add(own.get("Friction law"))
            elif coefficient and re.search(r"\bp\b", own["Friction coefficient"]):
                laws.add("by pressure")
            elif bound or coefficient:
                laws.add("Tresca" if bound else "Coulomb")
        return laws or {"none"}

    def body(self, _):
        shapes = set(self.values("Geometry", "Shape") + self.values("Body", "Shape")) or {"box"}
        if self.in_space:
            return shapes | {SPACE}
        planes = self.values("Material", "Plane")
        kinds = {"axisymmetric": "body of revolution", "stress": "plane stress", "strain": "plane strain"}
        is_curved = shapes & {"ring sector", "half disc", "plate with hole"} or self.values("Boundary", "Curve")
        n = len({section for section, _, _ in self.entries if re.match("Body (?!force)", section)})
        return shapes | {kinds[planes[0] if planes else "strain"]} | ({"curved edges"} if is_curved else set()) \
            | ({"several bodies"} if n > 1 else set())

    def material(self, _):
        sections = {section for section, _, _ in self.entries if section.split(" ")[0] == "Material"}
        said = {"orthotropic": "orthotropic" in self.values("Material", "Elasticity"), "several materials": len(sections) > 1,
                "nearly incompressible": any(float(value) > 0.45 for value in self.values("Material", "Poisson's ratio")),
                "weight": self.values("Body", "Gravity"), "thickness": self.values("Material", "Thickness"),
                "initial strain": self.values("Material", "Initial strain"), "heat": self.values("Temperature", "Expression")}
        return {name for name, is_said in said.items() if is_said}

    def supports(self, _):
        rigid = self.values("Boundary", "Rigid")
        said = {"prescribed displacement": self.values("Boundary", "Displacement"), "plane of symmetry": self.values("Boundary", "Symmetry"),
                "elastic foundation": self.values("Boundary", "Spring"), "rigid plate": rigid}
        return {name for name, is_said in said.items() if is_said} or {"contact and friction alone"}

    def loads(self, _):
        said = {"traction": self.values("Boundary", "Traction"), "pressure": self.values("Boundary", "Pressure"),
                "force per volume": [value for value in self.values("Body", "Expression")] + self.values("Body", "Gravity"),
                "parts of sides": self.values("Boundary", "On"), "load history": self.values("Loading", "Steps"),
                "bolt that is tightened": self.values("Pretension", "Force")}
        return {name for name, is_said in said.items() if is_said}

    def results(self, has_bound):
        exact = [value for section, name, value in self.entries if (section, name) == ("Exact solution", "Solution") and value != "none"]
        follows_pressure = any(value not in ("", "0") for value in self.values("Boundary", "Friction coefficient") +
                               self.values("Contact", "Friction coefficient"))
        said = {"guaranteed bound": has_bound and not follows_pressure, "bound by the coupling": has_bound and follows_pressure, "closed form": exact,
                "probes": any(section.startswith("Probe ") for section, _, _ in self.entries)}
        return {name for name, is_said in said.items() if is_said}


def scenes():
    """All of prm/, with the words of the gallery's table, which knows whether a scene has a bound to leave out; else with its title."""
    table = {name: (words, without != "-") for name, without, words in ROW.findall(GALLERY.read_text())}
    return [Scene(path, *table.get(path.stem, ("", False))) for path in sorted((ROOT / "prm").glob("*.prm"))]


def page(pictures, anchor=""):
    """@p pictures: how the page calls doc/gallery."""
    all_scenes = scenes()
    link = (lambda name: f"[{name}](#{name})") if not anchor else (lambda name: f"[{name}](@ref scene_{name.replace('-', '_')})")
    lines = [f"# Scenes by what they show{anchor}", "",
             "Each scene of prm/ is a text with its reasons in comments. Copy the one nearest to your problem and change it.",
             "`hpvi --validate` describes a scene in words, and `hpvi --picture` draws it.", ""]
    for group, names in GROUPS.items():
        lines += [f"**{group}**", ""]
        for name in names:
            ones = [link(scene.name) for scene in all_scenes if name in scene.shows[group]]
            if ones:
                lines.append(textwrap.fill(f"- {name}: {', '.join(ones)}", 118, subsequent_indent="  ", break_on_hyphens=False,
                                           break_long_words=False))
        lines.append("")
    for scene in all_scenes:
        mark = f" {{#scene_{scene.name.replace('-', '_')}}}" if anchor else ""
        what = "; ".join(f"{group.lower()}: {', '.join(scene.shows[group])}" for group in GROUPS if scene.shows[group])
        images = [f'<img src="{pictures}{scene.name}-scene.svg" width="400" alt="what {scene.name} says">',
                  f'<img src="{pictures}{scene.name}.png" width="330" alt="{scene.name}">']
        lines += [f"## {scene.name}{mark}", "", textwrap.fill(scene.words[0].upper() + scene.words[1:] + ".", 118, break_on_hyphens=False), "", " ".join(images), "", textwrap.fill(what + ".", 118, break_on_hyphens=False), "",
                  f"    ./run prm/{scene.name}.prm", ""]
    return "\n".join(lines)


def readme():
    return "<!-- SPDX-License-Identifier: LGPL-2.1-or-later -->\n<!-- doc/scenes.py --write writes this page -->\n" \
        + page("../doc/gallery/")


def gallery():
    """doc/manual/gallery.md with the results of all scenes: four of the plane in a row, or two in space."""
    def rows(cells, n):
        return ["<tr>\n" + "\n".join(cells[k:k + n]) + "\n</tr>" for k in range(0, len(cells), n)]

    def solved(name, width):
        return f'<td><a href="../../prm/{name}.prm"><img src="../gallery/{name}.png" width="{width}" alt="{name}"></a></td>'

    plane = [solved(scene.name, 200) for scene in scenes() if not scene.in_space]
    space = [solved(scene.name, 405) for scene in scenes() if scene.in_space]
    before, rest = GALLERY.read_text().split(BEGIN)
    table = ["<table>", *rows(plane, 4), "</table>", "", "These scenes are in space. Beside the body is its contact, with the friction on it:", "",
             "<table>", *rows(space, 2), "</table>", ""]
    return before + BEGIN + "\n" + "\n".join(table) + "\n" + END + rest.split(END)[1]


def pages():
    return {ROOT / "prm/README.md": readme(), GALLERY: gallery()}


def complaints():
    found = [f"doc/gallery/{name} is missing; run ./run gallery" for scene in scenes()
             for name in (f"{scene.name}.png", f"{scene.name}-scene.svg")
             if not (ROOT / "doc/gallery" / name).exists()]
    found += [f"doc/manual/gallery.md has a row for {name}.prm, which is not in prm/" for name, _, _ in ROW.findall(GALLERY.read_text())
              if not (ROOT / f"prm/{name}.prm").exists()]
    found += [f"{page.relative_to(ROOT)} is not what the scenes say; run python3 doc/scenes.py --write" for page, text in pages().items()
              if not page.exists() or page.read_text() != text]
    return found


def main():
    if sys.argv[1:] == ["--write"]:
        for page, text in pages().items():
            page.write_text(text)
    elif sys.argv[1:] == ["--check"]:
        found = complaints()
        print("\n".join(found), end="\n" if found else "")
        sys.exit(1 if found else 0)
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
