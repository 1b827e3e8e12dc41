#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Write the manual: pages of doc/manual, those of doc with the theory, the commented sources, and what the program says of itself.

manual.py --program build/hpvi --output build/doc [--check]

Pages are finished where they stand, so that any viewer of Markdown shows them: outputs and tables that they ask for are written into
doc/manual, between marks, and pictures into doc/figures. That is an exception to the rule that results stay out of the repository;
with --check the end is an error where one of them was no longer current. Doxygen makes HTML of the same pages, with MathJax from Debian beside it: no network is needed to
read it. Whatever Doxygen warns of ends the run.
"""
import argparse
import csv
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
from pages import slug
from scenes import assignments

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGES = ROOT / "doc/manual"
OF_REPOSITORY = ("CONTRIBUTING.md", *sorted(f"doc/{page.name}" for page in (ROOT / "doc").glob("*.md") if page.name != "python.md"))
MATHJAX = pathlib.Path("/usr/share/javascript/mathjax")
# Entries that no scene of prm/ sets: what one could write.
EXAMPLES = {
    ("Geometry", "Centre"): "1, 1", ("Geometry", "Radii"): "1, 2", ("Geometry", "Angles"): "0, 120",
    ("Geometry", "Radius"): "0.25", ("Geometry", "Angle"): "180", ("Geometry", "Part"): "quarter",
    ("Geometry", "File"): "body.msh", ("Boundary NAME", "Curve"): "circle", ("Boundary NAME", "Curves"): "4",
    ("Geometry", "Length unit"): "cm", ("Geometry", "Mesh size"): "0.4", ("Geometry", "Mesh size from curvature"): "16",
    ("Material", "Thickness"): "0.25", ("Boundary NAME", "Shear"): "0.1*x",
    ("Boundary NAME", "Contact direction"): "0.1; -1",
    ("Body NAME", "Surfaces"): "liner, shell", ("Body NAME", "Start degree"): "4", ("Contact NAME", "Friction law"): "limited",
    ("Contact NAME", "Gap"): "0.1*x^2", ("Contact NAME", "Closed within"): "0.001", ("Contact NAME", "Friction coefficient"): "0.3", ("Contact NAME", "Slave"): "lower.top",
    ("Boundary NAME", "Wear coefficient"): "1e-9",
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
    ("Output", "Mesh picture"): "true",
    ("Output", "Contact tables"): "false",
    ("Output", "Report"): "true", ("Output", "Reference solution"): "true", ("Error", "Bound"): "false",
    ("Error", "Coupling"): "localised", ("Error", "Bound on distorted cells"): "true",
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


changed = []


def renewed(path, text):
    path.write_text(text)
    changed.append(path.relative_to(ROOT))
    print(f"{changed[-1]} has changed")


# Prose

CODE = r"(^```.*?^```$|^ {4}.*?$|``[^`\n]*``|`[^`\n]*`)"


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

    parts = re.split(CODE, text, flags=re.S | re.M)
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
    return pages


def named(section):
    """NAME for what a scene names, or for a side."""
    return re.sub("^(Boundary|Material|Contact|Pretension|Probe|Body(?! force$)) .*", r"\1 NAME", section)


def scene_examples(defaults):
    """The shortest value that a scene gives each entry, if possible another one than the default, and the scene's name."""
    examples = {}

    def rank(key, value):
        return value == defaults.get(key), len(value)
    for scene in sorted((ROOT / "prm").glob("*.prm")):
        for section, name, value, _ in assignments(scene.read_text()):
            key = (named(section), name)
            if value and (key not in examples or rank(key, value) < rank(key, examples[key][0])):
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
    if key == ("Body NAME", "Start degree"):
        scene, name = ROOT / "prm/clamped-plates.prm", "washer"
    if key[0] == "Contact NAME":
        scene, name = ROOT / "prm/blocks.prm", "joint"
        if key[1] == "Friction coefficient":
            beside = {"Contact joint/Friction bound": ""}
        elif key[1] == "Friction law":
            beside = {"Contact joint/Friction coefficient": "0.3"}
    beside[f"{key[0].replace('NAME', name)}/{key[1]}"] = value
    run(program, "--validate", *(word for path, text in beside.items() for word in ("--set", f"{path}={text}")), scene)


def escaped(text):
    return text.replace("&", "&amp;").replace("<", "&lt;")


def code(text):
    return f"`{text}`" if text else ""


def list_of_entries(program):
    entries, lines, last = assignments(run(program, "--print-parameters")), [], None
    examples = scene_examples({(named(section), name): default for section, name, default, _ in entries})
    seen, said = set(), {}
    for section, name, default, comment in entries:
        key = (named(section), name)
        comment, accepts, accepted = comment.rpartition(" Accepts ")
        if not accepts:
            sys.exit(f"manual.py: {key[0]}/{name} does not say what it accepts")
        if key in seen:
            continue  # of another side
        seen.add(key)
        of_all = key if key in EXAMPLES else (key[0].replace("Material NAME", "Material"), name)  # a named material inherits it
        if key[0] == "Body NAME" and key not in examples and key not in EXAMPLES:
            of_all = ("Geometry", name)  # which says the same of one body
        shown = examples.get(key) or examples.get(of_all)
        if shown and not (shown[0] == default and of_all in EXAMPLES):
            value, where = shown
        elif of_all in EXAMPLES:
            value, where = EXAMPLES[of_all], ""
            check_example(program, of_all, value)
        else:
            sys.exit(f"manual.py: {key[0]}/{name} needs an example, in a scene or in EXAMPLES")
        if key[0] != last:
            anchor = re.sub(r"\W", "_", key[0].lower()) or "scene"
            lines += ["", f"## {key[0] or 'The scene'} <a id=\"entries_{anchor}\"></a>", ""]
            last = key[0]
            alike = []
        facts = [f"Accepts {escaped(accepted[:-1])}", f"Default {code(default) or 'empty'}", f"Example {code(value)}" + (f" in prm/{where}" if where else "")]
        base, inherits = {"Body NAME": ("Geometry", ""), "Material NAME": ("Material", " Empty: as of the unnamed Material.")}.get(key[0], ("", ""))
        said[key] = comment
        place = re.sub(r"\W", "_", name.lower())
        if base and comment == said.get((base, name), "") + inherits:
            if not alike:
                lines += [alike := [f"As in [{base}](#entries_{base.lower()})" + (", where an empty entry takes its value" if inherits else "") + ":"], ""]
            alike.append(f"[{escaped(name)}](#{base.lower()}_{place}),")
            continue
        lines += [f"### {escaped(name)} <a id=\"{anchor}_{place}\"></a>", "", escaped(comment), "", ". ".join(facts) + ".", ""]
    return "\n".join(line if isinstance(line, str) else " ".join(line)[:-1] + "." for line in lines).strip()


def finished(text, program, directory, generated):
    """A page with all that it asks for: what stands between `<!-- @RUN arguments@ -->` and `<!-- end -->`, or in the place of
    `@RUN arguments@`, is the command and what it prints, in short (`@ALL arguments@`: all of it); a scene or a drawing that the page says to write
    is written before. Likewise `@RUN 2: arguments@` if it ends with status 2, `@LINES k from "words": arguments@` has k of these lines,
    `@ROWS NAME: columns; k@` k rows, evenly spaced, of the last contact table of the run NAME, `@TABLE NAME/FILE.csv: columns@` the
    rows of another one, `@JSON NAME: member@` that member of its summary.json, `@PICTURE NAME/FILE: words@` a picture that a command
    has drawn, and @p generated has lists by their names. Where nothing has changed but seconds and last digits, the page keeps what it had."""
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

    def printed(what):
        status, arguments = re.fullmatch(r"(?:(\d): )?(.*)", what).groups()
        return f"```\n$ ./run {arguments}\n{said(shlex.split(arguments), int(status or 0))}```"

    def printed_in_short(what):
        return in_short(printed(what))

    def excerpt(what):
        number, words, arguments = re.fullmatch(r"(\d+) from \"(.*?)\": (.*)", what).groups()
        lines = said(shlex.split(arguments), 0).splitlines()
        begin = next(k for k, line in enumerate(lines) if words in line)
        return f"```\n$ ./run {arguments}\n...\n" + "\n".join(lines[begin:begin + int(number)]) + "\n...\n```"

    def markdown(names, chosen):
        lines = [names, ["---"] * len(names), *([short(row[name]) for name in names] for row in chosen)]
        return "\n".join(f"| {' | '.join(line)} |" for line in lines)

    def rows(what):
        name, columns, number = re.fullmatch(r"(\w+): (.*); (\d+)", what).groups()
        table = table_of(sorted((directory / "output" / name).glob("contact-*.csv"))[-1])
        return markdown(columns.split(", "),
                        [table[round(k * (len(table) - 1) / (int(number) - 1))] for k in range(int(number))])

    def table_of(path):
        with path.open() as file:
            return list(csv.DictReader(file))

    def whole_table(what):
        name, columns = re.fullmatch(r"(\S+): (.*)", what).groups()
        return markdown(columns.split(", "), table_of(directory / "output" / name))

    def member(what):
        name, key = re.fullmatch(r"(\w+): (\w+)", what).groups()
        summary = json.loads((directory / "output" / name / "summary.json").read_text())
        return f"```json\n{json.dumps(summary[key], indent=2)}\n```"

    def picture(what):
        name, words = re.fullmatch(r"(\S+): (.*)", what).groups()
        drawn = (directory / "output" / name).read_text()
        kept = ROOT / "doc/figures" / name.replace("/", "-")
        if not kept.exists() or not agree(kept.read_text(), drawn):
            renewed(kept, drawn)
        return f"![{words}](../figures/{kept.name})"

    makers = {"RUN": printed_in_short, "ALL": printed, "LINES": excerpt, "ROWS": rows, "TABLE": whole_table, "JSON": member, "PICTURE": picture}

    def made(match):
        before = match["before"]
        if match["list"]:
            now = generated[match["list"]]
        else:
            now = makers[match["maker"]](match["what"])
        mark = match["mark"]
        return f"<!-- {mark} -->\n\n{before if before is not None and agree(before, now) else now}\n\n<!-- end -->"

    directory.mkdir(exist_ok=True)
    for name, scene in re.findall(r"`(\w+\.(?:prm|geo))`:\n\n```\n(.*?)```", text, re.S):
        (directory / name).write_text(scene)
    mark = rf"(?P<mark>@(?:(?P<maker>{'|'.join(makers)}) (?P<what>[^\n]*)|(?P<list>{'|'.join(generated)}))@)"
    marked = mark.replace("?P<", "?P<marked_")
    both = re.compile(rf"^<!-- {mark} -->\n\n(?P<before>.*?)\n\n<!-- end -->$|^{marked}$", re.S | re.M)

    def either(match):
        groups = match.groupdict()
        if groups["mark"] is None:
            groups = {name: groups.get(f"marked_{name}") for name in ("mark", "maker", "what", "list", "before")}
        return made(groups)

    return both.sub(either, text)


def in_short(text):
    """Output of a run with dots in the place of the seconds of stages, and of steps but the first and last two."""
    lines = re.sub(r"^stage +seconds.*?^total[^\n]*$", "...", text, flags=re.S | re.M).split("\n")
    steps = [k for k, line in enumerate(lines) if re.match(r" +\d+ +\d", line)]
    hidden = set(steps[2:-2]) if len(steps) > 6 else set()
    return "\n".join("   ..." if k == min(hidden) else line for k, line in enumerate(lines) if k not in hidden - {min(hidden, default=0)}) \
        if hidden else "\n".join(lines)


def agree(before, now):
    """The same but for spaces, seconds, round-off, places (of a symmetric body any of several), and a hundredth of numbers."""
    number = r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?"

    def steady(text):
        text = re.sub(r"^stage +seconds.*?^total.*?$", "", text, flags=re.S | re.M)
        text = re.sub(rf"^( +\d+(?: +\S+)+) +\d+ +{number}$", r"\1", text, flags=re.M)  # iterations and seconds of a step
        text = re.sub(r"^(\S.*= ?\S.*? (?:done|failed) +\S+ +\S+) +\S+", r"\1", text, flags=re.M)  # and of a run of a sweep
        text = re.sub(rf"Process name: .*|{number} (?:s|seconds|MB|GB)\b|^balance: .*|\bat \([^)]*\)", "", text, flags=re.M)
        text = re.sub(r"-?\d(?:\.\d+)?e-1[2-9]\b|(?<!\S)-(?!\S)", "0", text)
        return "\n".join(sorted((" ".join(line.split()) for line in text.splitlines()), key=lambda line: (re.sub(number, "N", line), line)))  # runs end in any order
    before, now = steady(before), steady(now)
    words = [" ".join(re.sub(number, " N ", text).split()) for text in (before, now)]
    numbers = [[float(one) for one in re.findall(number, text)] for text in (before, now)]
    round_off = max([1e-8, *(1e-11 * abs(one) for one in numbers[1])])
    return words[0] == words[1] and all(abs(a - b) <= max(0.01 * abs(b), round_off) for a, b in zip(*numbers))


def with_places(pages):
    """Links that any viewer follows, in the place of `@ref`, and anchors that none shows."""
    where = {anchor: f"{name}.md" for name, text in pages.items()
             for anchor in re.findall(r"\{#([\w-]+)\}|<a id=\"([\w-]+)\">", text) for anchor in anchor if anchor}
    where |= {"scenes": "../../prm/README.md", "python": "../python.md", "contributing": "../../CONTRIBUTING.md", "tutorial": "tutorial.md",
              "architecture": "../architecture.md", "decisions": "../decisions.md", "nouns": "../architecture.md"}
    where |= {f"program_{noun.split('/')[1]}": f"../../source/{noun}.cc" for noun, _ in reading_order()}

    def link(anchor, page):
        if anchor not in where:
            sys.exit(f"manual.py: {page}.md links to {anchor}, which is nowhere")
        file = where[anchor]
        is_whole = not (PAGES / file).exists() or "/" in file or file == f"{anchor}.md"
        return f"](#{anchor})" if file == f"{page}.md" else f"]({file})" if is_whole else f"]({file}#{anchor})"

    result = {}
    for name, text in pages.items():
        text = re.sub(r"\]\(@ref ([\w-]+)\)", lambda m, page=name: link(m[1], page), text)
        result[name] = re.sub(r"^(#+ .*) \{#([\w-]+)\}$", r'\1 <a id="\2"></a>', text, flags=re.M)
    return result


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
        if path == pathlib.Path("doc/python.md"):
            return f"[{words}](@ref python)"
        if path.suffix == ".cc" and str(path.relative_to(path.parts[0]).with_suffix("")) in dict(reading_order()):
            return f"[{words}](@ref program_{path.stem})"
        if path.parent == pathlib.Path("prm") and path.suffix == ".prm":
            return f"[{words}](@ref scene_{path.stem.replace('-', '_')})"
        if str(path) in OF_REPOSITORY:
            return f"[{words}](@ref {'--'.join(filter(None, (path.stem.lower(), anchor)))})"
        if path.suffix == ".md" and ROOT / path.parent == PAGES:
            return f"[{words}](@ref {anchor or path.stem.lower()})"
        return words if words == str(path) else f"{words} ({path})"

    text = re.sub(r"(?<!!)\[([^\]]*)\]\(([\w./-]+)(?:#([\w-]*))?\)", link, text)
    text = re.sub(r'href="\.\./\.\./prm/([\w-]+)\.prm"', lambda m: f'href="scenes.html#scene_{m[1].replace("-", "_")}"', text)
    return text.replace('"../gallery/', '"gallery/')


def spans(paragraph):
    """Each name or formula between backticks on one line, and between two of them where an apostrophe would end it for Doxygen."""
    parts = paragraph.split("`")
    if "``" in paragraph or len(parts) % 2 == 0:
        return paragraph
    for k in range(1, len(parts), 2):
        ticks = "``" if "'" in parts[k] else "`"
        parts[k] = f"{ticks}{' '.join(parts[k].split())}{ticks}"
    return "".join(parts)


def of_repository(name):
    """A page that is no part of doc/manual: its headings have their names behind that of the page."""
    stem = pathlib.Path(name).stem.lower()

    def heading(match):
        level, words, anchor = match.groups()
        return f"{level} {words} {{#{stem if level == '#' else f'{stem}--{anchor or slug(words)}'}}}"

    def prose(text):
        text = re.sub(r"^(#+) (.*?)(?: <a id=\"([\w-]+)\"></a>)?$", heading, text, flags=re.M)
        text = re.sub(r"\]\(#([\w-]+)\)", rf"](@ref {stem}--\1)", text)
        text = re.sub(r"<(?!/?\w[^<>\n]*>)", "&lt;", linked(text, (ROOT / name).parent))
        return re.sub(r"@(?!ref )", r"\\@", text)

    text = re.sub(r"<!--.*?-->\n?", "", (ROOT / name).read_text(), flags=re.S)
    parts = re.split(CODE, "\n\n".join(map(spans, text.split("\n\n"))), flags=re.S | re.M)
    return doxygen_math("".join(part if k % 2 else prose(part) for k, part in enumerate(parts)))


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
        name = match[2].replace("/", "-")
        shutil.copy(ROOT / "doc" / match[2], sources / name)
        return f"![{match[1]}]({name})"
    return re.sub(r"!\[([^\]]*)\]\((?:\.\./)?([\w-]+/[^)]*)\)", copied, text)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", required=True, type=pathlib.Path)
    parser.add_argument("--output", required=True, type=pathlib.Path)
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    program, output = options.program.resolve(), options.output.resolve()
    sources = output / "pages"
    shutil.rmtree(output, ignore_errors=True)
    sources.mkdir(parents=True)

    order = reading_order()
    own = {name: (PAGES / f"{name}.md").read_text() for name in (
        "index", "introduction", "unilateral", "friction", "materials-and-loads", "shapes", "drawings", "pairs", "bodies-in-space", "processes", "probes", "paraview",
        "results", "sweeps", "first-problem", "own-scene", "gallery", "library", "extensions", "columns", "messages", "entries", "program")}
    generated = {"ENTRIES": list_of_entries(program), "LIST": "\n".join(
        f"{k}. [{title}](../../source/{noun}.cc), `{noun}`" for k, (noun, title) in enumerate(order, 1))}
    own = with_places({name: finished(text, program, output / "runs", generated) for name, text in own.items()})
    pages = program_pages(order)
    for name, text in own.items():
        if (PAGES / f"{name}.md").read_text() != text:
            renewed(PAGES / f"{name}.md", text)
        text = re.sub(r"^(#+ .*) <a id=\"([\w-]+)\"></a>$", r"\1 {#\2}", text, flags=re.M)
        pages[name] = doxygen_math(linked(re.sub(r"<!-- .*? -->\n", "", text), PAGES))
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
    if options.check and changed:
        sys.exit("manual.py: the pages and pictures above were not current; look at the differences and commit them")


if __name__ == "__main__":
    main()
