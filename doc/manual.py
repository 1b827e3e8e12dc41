#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Write the manual: pages of doc/manual, the commented sources, and what the program says of itself.

manual.py --program build/hpvi --output build/doc

Doxygen makes HTML of them, with MathJax from Debian beside it: no network is needed to read it. Whatever
Doxygen warns of ends the run.
"""
import argparse
import csv
import html
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

import rooms
import scenes
from scenes import assignments

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGES = ROOT / "doc/manual"
OF_REPOSITORY = ("CONTRIBUTING.md", "doc/architecture.md", "doc/decisions.md")
MATHJAX = pathlib.Path("/usr/share/javascript/mathjax")
# Entries that no scene of prm/ sets: what one could write.
EXAMPLES = {
    ("Geometry", "Centre"): "1, 1", ("Geometry", "Radii"): "1, 2", ("Geometry", "Angles"): "0, 120",
    ("Geometry", "Radius"): "0.25", ("Geometry", "Angle"): "180", ("Geometry", "Part"): "quarter",
    ("Geometry", "File"): "body.msh", ("Boundary NAME", "Curve"): "circle", ("Boundary NAME", "Curves"): "4",
    ("Geometry", "Length unit"): "cm", ("Geometry", "Mesh size"): "0.4", ("Geometry", "Mesh size from curvature"): "16",
    ("Material", "Thickness"): "0.25", ("Boundary NAME", "Shear"): "0.1*x",
    ("Boundary NAME", "Contact direction"): "0.1; -1",
    ("Body NAME", "Surfaces"): "liner, shell", ("Contact NAME", "Friction law"): "limited",
    ("Contact NAME", "Gap"): "0.1*x^2", ("Contact NAME", "Closed within"): "0.001", ("Contact NAME", "Friction coefficient"): "0.3", ("Contact NAME", "Slave"): "lower.top",
    ("Boundary NAME", "Wear coefficient"): "1e-9", ("Contact NAME", "Wear coefficient"): "1e-9",
    ("Loading", "Until steady"): "0.01", ("Loading", "Maximum cycles"): "50",
    ("Material", "Initial strain"): "0.001; 0; 0", ("Boundary NAME", "Moment"): "2.5",
    ("Material", "Elasticity"): "orthotropic", ("Material", "Young's moduli"): "11000, 500, 700",
    ("Material", "Poisson's ratios"): "0.4, 0.35, 0.4", ("Material", "Shear moduli"): "700",
    ("Material", "Angle"): "30", ("Material NAME", "Surfaces"): "1",
    ("Adaptivity", "hap threshold"): "0.7", ("Adaptivity", "hpa1 bisected fraction"): "0.05",
    ("Adaptivity", "hpa1 raised fraction"): "0.2", ("Adaptivity", "Maximum seconds"): "60",
    ("Solver", "Path"): "reduced", ("Solver", "Linear"): "direct",
    ("Solver", "Primal tolerance"): "1e-8", ("Solver", "QP solver"): "mprgp",
    ("Solver", "QP warm start"): "false", ("Solver", "QP tolerance"): "1e-10",
    ("Solver", "QP maximum multiplications"): "1000", ("Solver", "Diagonal scaling"): "false",
    ("Solver", "Coulomb solver"): "fixed point", ("Solver", "Multiplier degree offset"): "-3",
    ("Solver", "Condition number"): "true", ("Solver", "Threads"): "2", ("Output", "VTU"): "false",
    ("Output", "Steps"): "last", ("Output", "Mesh picture"): "false",
    ("Output", "Contact tables"): "false",
    ("Output", "Report"): "false", ("Output", "Reference solution"): "true", ("Error", "Bound"): "false",
    ("Error", "Bound on distorted cells"): "true",
    ("Error", "Reference solution"): "output/han-6-12/reference.dat"}

# Scenes in which entries of the other shapes are tried.
SHAPES = {"Centre": "half_disc", "Radii": "ring", "Angles": "ring", "Radius": "half_disc", "Angle": "half_disc", "Part": "plate",
          "File": "mesh", "Curve": "mesh", "Curves": "drawing", "Length unit": "drawing", "Mesh size": "drawing",
          "Mesh size from curvature": "drawing"}
ORTHOTROPIC = ("Elasticity", "Young's moduli", "Poisson's ratios", "Shear moduli", "Angle")


def run(*command, **options):
    done = subprocess.run([str(word) for word in command], text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}")
    return done.stdout


# Prose

def doxygen_math(text):
    """Dollars are TeX as in deal.II's comments, except in code."""
    def formulas(prose):
        return re.sub(r"\$(.+?)\$", lambda m: rf"\f${m[1]}\f$",
                      re.sub(r"\$\$(.+?)\$\$", display, prose, flags=re.S), flags=re.S)

    def display(match):
        """MathJax 2 places the numbers of equations wrongly in narrow columns: here they are a column."""
        formula = match[1].replace("align*", "aligned")
        gap = "&&" if "aligned" in formula else r"\quad"
        return r"\f[" + re.sub(r"\\tag\{(.*?)\}", lambda m: rf"{gap} \text{{({m[1]})}}", formula) \
            + r"\f]"

    parts = re.split(r"(^```.*?^```$|`[^`\n]*`)", text, flags=re.S | re.M)
    return "".join(part if k % 2 else formulas(part) for k, part in enumerate(parts))


def code_block(lines, language="cpp"):
    while lines and not lines[0].strip():
        lines = lines[1:]
    while lines and not lines[-1].strip():
        lines = lines[:-1]
    return [f"```{{.{language}}}", *lines, "```", ""] if lines else []


def commented_source(path):
    """Comments that begin a line are prose, @sect3{...} in them are headings; the rest is code."""
    result, code, prose = [], [], []

    def flush_code():
        result.extend(code_block(code))
        code.clear()

    def flush_prose():
        if prose:
            text = "\n".join(prose)
            result.extend([re.sub(r"@sect3\{(.*?)\}", r"## \1\n", text), ""])
        prose.clear()

    for line in path.read_text().splitlines():
        if line.startswith("// SPDX"):
            continue
        if line.startswith("//"):
            flush_code()
            prose.append(line[3:])
        else:
            flush_prose()
            code.append(line)
    flush_prose()
    flush_code()
    return doxygen_math("\n".join(result))


# Pages

def reading_order():
    """Noun and title of each commented source, from doc/architecture.md."""
    listed = (ROOT / "doc/architecture.md").read_text().split("## Reading order\n")[1].split("\n## ")[0]
    return re.findall(r"^\d+\. `([\w/]+)` (.*)$", listed, re.M)


def program_pages(order):
    pages = {}
    for k, (noun, title) in enumerate(order):
        around = []
        for step, arrow in ((-1, "back: {}"), (1, "next: {}")):
            if 0 <= k + step < len(order):
                other, name = order[k + step]
                around.append(arrow.format(f"[{name}](@ref program_{other.split('/')[1]})"))
        pages[f"program_{noun.split('/')[1]}"] = "\n".join([
            f"# {title} {{#program_{noun.split('/')[1]}}}", "",
            f"Part {k + 1} of {len(order)} of [the commented program](@ref program): "
            f"`source/{noun}.cc`, declared in `include/hpvi/{noun}.h`.", "",
            commented_source(ROOT / "source" / f"{noun}.cc"), "", ", ".join(around), ""])
    links = [f"{k}. [{title}](@ref program_{noun.split('/')[1]}), `{noun}`"
             for k, (noun, title) in enumerate(order, 1)]
    pages["program"] = linked((PAGES / "program.md").read_text(), PAGES).replace("@LIST@", "\n".join(links))
    pages["program"] = doxygen_math(pages["program"])
    return pages


def named(section):
    """NAME for what a scene names, or for a side."""
    return re.sub("^(Boundary|Material|Contact|Probe|Body(?! force$)) .*", r"\1 NAME", section)


def scene_examples():
    """The shortest value that a scene gives each entry, and the scene's name."""
    examples = {}
    for scene in sorted((ROOT / "prm").glob("*.prm")):
        for section, name, value, _ in assignments(scene.read_text()):
            key = (named(section), name)
            if value and (key not in examples or len(value) < len(examples[key][0])):
                examples[key] = (value, scene.name)
    return examples


def check_example(program, key, value):
    if key in (("Error", "Reference solution"), ("Body NAME", "Surfaces"), ("Material NAME", "Surfaces")):
        return  # names a file of another run, surfaces of a mesh
    wood = [entry for entry in EXAMPLES if entry[0] == "Material" and entry[1] in ORTHOTROPIC]
    beside = {}
    if key in wood:  # one stands with the others
        beside = {"Material/Young's modulus": "", "Material/Poisson's ratio": "",
                  **{"/".join(entry): EXAMPLES[entry] for entry in wood}}
    elif key[1] == "Moment":
        beside = {"Boundary bottom/Contact": "none", "Boundary bottom/Friction bound": "", "Boundary right/Displacement": "",
                  "Boundary left/Traction": "", "Boundary top/Displacement": "0; 0", "Boundary bottom/Rigid": "true"}
    elif key[1] in ("Wear coefficient", "Until steady", "Maximum cycles"):
        beside = {"Loading/Steps": "4", "Loading/Until steady": "0.01" if key[1] == "Maximum cycles" else ""}
    scene, name = ROOT / "prm/han-6-12.prm", "bottom"
    if key[1] in SHAPES and key[0] != "Material":
        scene, name = ROOT / f"tests/bad_input/{SHAPES[key[1]]}.prm", "inside"
        if key[1] == "Part":
            beside["Geometry/Centre"] = "0, 0"
    if key[0] == "Contact NAME":
        scene, name = ROOT / "prm/blocks.prm", "joint"
        if key[1] == "Friction coefficient":
            beside = {"Contact joint/Friction bound": ""}
        elif key[1] == "Friction law":
            beside = {"Contact joint/Friction coefficient": "0.3"}
    beside[f"{key[0].replace('NAME', name)}/{key[1]}"] = value
    run(program, "--validate", *(word for path, text in beside.items() for word in ("--set", f"{path}={text}")), scene)


def escaped(text):
    return html.escape(text, quote=False)


def code(text):
    return f"`{text}`" if text else ""


def entries_page(program):
    examples, lines, last = scene_examples(), [], None
    seen = set()
    for section, name, default, comment in assignments(run(program, "--print-parameters")):
        key = (named(section), name)
        if key in seen:
            continue  # of another side
        seen.add(key)
        of_all = key if key in EXAMPLES else (key[0].replace("Material NAME", "Material"), name)  # a named material inherits it
        if key[0] == "Body NAME" and key not in examples and key not in EXAMPLES:
            of_all = ("Geometry", name)  # which says the same of one body
        if key in examples or of_all in examples:
            value, where = examples.get(key) or examples[of_all]
        elif of_all in EXAMPLES:
            value, where = EXAMPLES[of_all], ""
            check_example(program, of_all, value)
        else:
            sys.exit(f"manual.py: {key[0]}/{name} needs an example, in a scene or in EXAMPLES")
        if key[0] != last:
            anchor = re.sub(r"\W", "_", key[0].lower()) or "scene"
            lines += ["", f"## {key[0] or 'The scene'} {{#entries_{anchor}}}", ""]
            last = key[0]
        units = re.findall(r"\[(length|stress|stress/length)\]", comment) if name != "Density" else []
        facts = [f"default {code(default) or 'empty'}"] + ([f"unit {units[0]}"] if units else [])
        facts.append(f"example {code(value)}" + (f" in prm/{where}" if where else ""))
        lines += [f"**{escaped(name)}**: {escaped(comment)}", "", "<span class=\"facts\">"
                  + "; ".join(facts) + "</span>", ""]
    text = (PAGES / "entries.md").read_text()
    return text.replace("@ENTRIES@", "\n".join(lines))


def with_results(text, program, directory):
    """What a page asks for is computed: a scene or a drawing that it says to write is written, `@RUN arguments@` gives way to the
    command and what it prints, `@RUN 2: arguments@` if it ends with status 2, `@LINES k from "words": arguments@` to k of
    these lines, `@ROWS NAME: columns; k@` to k rows, evenly spaced, of the last contact table of the run NAME,
    `@TABLE NAME/FILE.csv: columns@` to the rows of another one, `@JSON NAME: member@` to that member of its summary.json,
    `@PICTURE NAME/FILE: words@` to a picture that a command has drawn."""
    def said(arguments, status):
        last = arguments[-1]
        is_own = last.startswith("-") or (directory / last).exists()
        command = [program, *arguments[:-1], last if is_own else ROOT / last]
        if arguments[0] == "-np":
            command = ["mpirun", "--oversubscribe", "--bind-to", "none", *arguments[:2], program,
                       *arguments[2:-1], command[-1]]
        done = subprocess.run([str(word) for word in command], text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, cwd=directory,
                              env={**os.environ, "OMP_NUM_THREADS": "1", "OMPI_ALLOW_RUN_AS_ROOT": "1",
                                   "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                                   "OMPI_MCA_mpi_yield_when_idle": "1"})
        if done.returncode != status:
            sys.exit(f"manual.py: {shlex.join(arguments)} ends with status {done.returncode}\n{done.stdout}")
        return done.stdout.replace(f"{ROOT}/", "").replace(f"{directory}/", "")

    def printed(match):
        return f"```\n$ ./run {match[2]}\n{said(shlex.split(match[2]), int(match[1] or 0))}```"

    def excerpt(match):
        lines = said(shlex.split(match[3]), 0).splitlines()
        begin = next(k for k, line in enumerate(lines) if match[2] in line)
        return f"```\n$ ./run {match[3]}\n...\n" + "\n".join(lines[begin:begin + int(match[1])]) + "\n...\n```"

    def markdown(names, chosen):
        lines = [names, ["---"] * len(names), *([short(row[name]) for name in names] for row in chosen)]
        return "\n".join(f"| {' | '.join(line)} |" for line in lines)

    def rows(match):
        table = table_of(sorted((directory / "output" / match[1]).glob("contact-*.csv"))[-1])
        return markdown(match[2].split(", "),
                        [table[round(k * (len(table) - 1) / (int(match[3]) - 1))] for k in range(int(match[3]))])

    def table_of(path):
        with path.open() as file:
            return list(csv.DictReader(file))

    def member(match):
        summary = json.loads((directory / "output" / match[1] / "summary.json").read_text())
        return f"```{{.json}}\n{json.dumps(summary[match[2]], indent=2)}\n```"

    def picture(match):
        name = match[1].replace("/", "-")
        shutil.copy(directory / "output" / match[1], directory.parent / "pages" / name)
        return f"![{match[2]}]({name})"

    directory.mkdir(exist_ok=True)
    for name, scene in re.findall(r"`(\w+\.(?:prm|geo))`:\n\n```\n(.*?)```", text, re.S):
        (directory / name).write_text(scene)
    text = re.sub(r"^@RUN (?:(\d): )?(.*)@$", printed, doxygen_math(text), flags=re.M)
    text = re.sub(r"^@LINES (\d+) from \"(.*?)\": (.*)@$", excerpt, text, flags=re.M)
    text = re.sub(r"^@ROWS (\w+): (.*); (\d+)@$", rows, text, flags=re.M)
    text = re.sub(r"^@TABLE (\S+): (.*)@$", lambda m: markdown(m[2].split(", "), table_of(directory / "output" / m[1])), text, flags=re.M)
    text = re.sub(r"^@PICTURE (\S+): (.*)@$", picture, text, flags=re.M)
    return re.sub(r"^@JSON (\w+): (\w+)@$", member, text, flags=re.M)


def linked(text, home):
    """Links between files, which readers of the repository follow: to pages of the manual where these have what they name."""
    def link(match):
        words, target, anchor = match.groups()
        path = (home / target).resolve()
        if not path.exists():
            return match[0]
        path = path.relative_to(ROOT)
        if path == pathlib.Path("prm/README.md"):
            return f"[{words}](@ref scenes)"
        if path.parent == pathlib.Path("prm"):
            return f"[{words}](@ref scene_{path.stem.replace('-', '_')})"
        if path.suffix == ".md" and (ROOT / path.parent == PAGES or str(path) in OF_REPOSITORY):
            return f"[{words}](@ref {anchor or path.stem.lower()})"
        return words if words == str(path) else f"{words} ({path})"

    text = re.sub(r"(?<!!)\[([^\]]*)\]\(([\w./-]+)(?:#([\w-]*))?\)", link, text)
    text = re.sub(r'href="\.\./\.\./prm/([\w-]+)\.prm"', lambda m: f'href="scenes.html#scene_{m[1].replace("-", "_")}"', text)
    return text.replace('"../gallery/', '"gallery/')


def of_repository(name):
    """A page that is no part of doc/manual."""
    text = linked((ROOT / name).read_text(), (ROOT / name).parent)
    return doxygen_math(re.sub("^# (.*)$", rf"# \1 {{#{pathlib.Path(name).stem.lower()}}}", text, count=1, flags=re.M))


def session(text):
    """doc/python.md as a page of the manual."""
    text = re.sub("^# (.*)$", r"# \1 {#python}", text, count=1, flags=re.M).replace("](python/", "](../python/")
    return text.replace("```python", "```{.py}").replace("```sh", "```{.sh}")


def short(field):
    """A number with five digits; what is none stays."""
    try:
        return f"{float(field):.5g}"
    except ValueError:
        return field


def images_of(text, sources):
    """Copies the images that a page shows to where Doxygen looks for them."""
    def copied(match):
        shutil.copy(ROOT / "doc" / match[2], sources / pathlib.Path(match[2]).name)
        return f"![{match[1]}]({pathlib.Path(match[2]).name})"
    return re.sub(r"!\[([^\]]*)\]\((?:\.\./)?([\w-]+/[^)]*)\)", copied, text)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", required=True, type=pathlib.Path)
    parser.add_argument("--output", required=True, type=pathlib.Path)
    options = parser.parse_args()
    program, output = options.program.resolve(), options.output.resolve()
    sources = output / "pages"
    shutil.rmtree(output, ignore_errors=True)
    sources.mkdir(parents=True)

    pages = program_pages(reading_order())
    pages["entries"] = entries_page(program)
    for name in ("index", "introduction", "unilateral", "coulomb", "materials", "bodies", "drawings", "pairs", "space", "processes", "probes", "paraview",
                 "results", "sweeps", "first-problem", "own-scene", "gallery", "library", "extensions", "columns", "messages"):
        pages[name] = with_results(linked((PAGES / f"{name}.md").read_text(), PAGES), program, output / "runs")
    for name in OF_REPOSITORY:
        pages[pathlib.Path(name).stem.lower()] = of_repository(name)
    pages["nouns"] = rooms.nouns()
    pages["scenes"] = scenes.page("gallery/", " {#scenes}")
    pages["python"] = session((ROOT / "doc/python.md").read_text())
    pages["tutorial"] = "# A small program to start from {#tutorial}\n\n" + \
        doxygen_math((PAGES / "tutorial.md").read_text()) + \
        commented_source(ROOT / "doc/tutorial/tresca_friction.cc")
    for name, text in pages.items():
        text = re.sub(r"<!-- SPDX.*?-->\n", "", text)
        (sources / f"{name}.md").write_text(images_of(text, sources))

    settings = (PAGES / "Doxyfile").read_text()
    settings += f'INPUT = "{sources}"\nIMAGE_PATH = "{sources}"\nOUTPUT_DIRECTORY = "{output}"\n'
    settings += f'HTML_HEADER = "{PAGES}/header.html"\nHTML_FOOTER = "{PAGES}/footer.html"\n'
    settings += f'MATHJAX_CODEFILE = "{PAGES}/mathjax.js"\n'
    settings += f'HTML_EXTRA_STYLESHEET = "{PAGES}/style.css"\n'
    (output / "Doxyfile").write_text(settings)
    run("doxygen", output / "Doxyfile", cwd=output)
    (output / "html/mathjax").symlink_to(MATHJAX)
    shutil.copytree(ROOT / "doc/gallery", output / "html/gallery")
    print(f"the manual is {os.path.relpath(output / 'html/index.html')}")


if __name__ == "__main__":
    main()
