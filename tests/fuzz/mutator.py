# SPDX-License-Identifier: LGPL-2.1-or-later
"""Spoilt scenes: Vocabulary knows all entries, as the program prints them with their documentation, and what scenes say; Mutator
makes of a seed one scene more, mostly one that still makes sense."""
import dataclasses
import pathlib
import random
import re
import subprocess

NUMBERS = """0 -0 1 -1 2 3 7 0.5 -0.5 0.1 1e-3 1e-8 1e3 1e8 1e30 1e-30 1e100 1e-101 1e200 -1e200 1e308 1.8e308 5e-324 1e-310 nan inf -inf
+1 .5 5. 1e 0x10 99999999999 4294967296 -2147483649 007 1_000 180 360 -90 1e-5 1e5 1e-400 1,5 1;5 pi E 0.4999 0.499999999 1e-12""".split()
FUNCTIONS = ["sin(3*x)", "cos(2*y)", "exp(-x)", "if(x<0.3,1,2)", "(x>0.5)", "x", "y", "x*y", "t", "sin(6*t)", "(1-t)", "max(0,x-0.4)", "(x-0.5)^2",
             "abs(y-0.3)", "sqrt(x)", "1/x", "1/(x-0.5)", "log(x)", "1e-9", "1e9", "E", "nu", "mu", "z", "(0.49<x && x<0.51)", "x^40", "p", "0.3/(1+p)"]
TEXTS = ["", " ", "\t", "x", "sin(", ")", "1/0", "sqrt(-1)", "x=1", "x==1", "(1,2)", "\"a\"", "rand()", "free", "exact", "free; free", "0; free", "exact; exact",
         ";", ";;", ",", "\\", "'", "\u00a0", "\u2028", "\u202e", "\u00e9", "\u2212" + "1", "\x1b[31m", "\x7f", "0,\t1", "0,0; 1,0; 1,1; 0,1", "0,,1", "(" * 300, "1+" * 2000 + "1",
         "a" * 5000, "{", "true", "false", "none", "/", "..", "/dev/null", "%s%n", "$(ls)", "0.4<x<0.6", "x<y==(z", "&&", "left; right", "1; 2; 3", "0.1; -0.1", "x^1000", "rand_seed(1)", "x<1?2:3", "e", "1e200*x", "#", "\u0085", "\0",
         "0\t,1", "0,0;\t1,0; 1,1; 0,1", "0,0; 1,0; 1,1e-9; 0,1", "0,0; 1,0; 1,1; 0,1;"]
BYTES = [bytes([b]) for b in (0, 1, 9, 10, 13, 32, 34, 35, 44, 45, 46, 48, 57, 59, 61, 92, 101, 128, 195, 237, 255)]
NUMBER = re.compile(r"(?<![\w.])-?\d+\.?\d*(?:[eE][-+]?\d+)?")
# What keeps a run short; each may be spoilt as any other entry, and is no limit then.
LIMITS = {"Adaptivity/Maximum steps": "2", "Adaptivity/Maximum unknowns": "1500", "Adaptivity/Maximum seconds": "0.3"}
LIMITS_IN_SPACE = {"Adaptivity/Maximum steps": "1", "Adaptivity/Maximum unknowns": "3000", "Adaptivity/Maximum seconds": "0.3"}
LIMITS_OF_HISTORIES = {"Loading/Steps": "2"}


def settings(text):
    """Path and value of each assignment."""
    section, result = "", []
    for line in map(str.strip, text.splitlines()):
        if line.startswith("subsection "):
            section = line[len("subsection "):].split("#")[0].strip() + "/"
        elif line == "end" or line.startswith("end "):
            section = ""
        elif line.startswith("set ") and "=" in line:
            name, value = line[len("set "):].split("=", 1)
            result.append((section + name.strip(), value.split("#")[0].strip()))
    return result


def kind(path):
    """Where an entry stands, without the name that its section may have: "Boundary left/Gap" is "Boundary/Gap"."""
    section, _, entry = path.rpartition("/")
    section = re.sub("^(Boundary|Material|Body(?! force)|Contact|Probe|Pretension) .*", r"\1", section)
    return f"{section}/{entry}" if section else entry


class Vocabulary:
    """All entries of the program, with words and values that they may have, and the scenes."""

    def __init__(self, program, scenes):
        self.texts = {scene: scene.read_text() for scene in scenes}
        in_space = [scene for scene in scenes if "set Dimension = 3" in self.texts[scene]][:1]  # which has entries of its own
        printed = "".join(subprocess.run([program, "--print-parameters", *scene], capture_output=True, check=True, text=True).stdout
                          for scene in ([], in_space))
        self.values = {}  # by kind: what was seen
        for path, value in settings(printed):
            self.values.setdefault(kind(path), set()).add(value)
        self.learn_words(printed)
        self.entries = sorted(self.values)
        for text in self.texts.values():
            for path, value in settings(text):
                if kind(path) in self.values:
                    self.values[kind(path)].add(value)
        self.values = {entry: sorted(values) for entry, values in self.values.items()}
        self.sections = {}  # by kind: those of scenes, as they stand there
        for text in self.texts.values():
            for section in re.findall(r"^subsection .*?^end.*?$", text, re.M | re.S):
                self.sections.setdefault(section.split()[1], []).append(section)

    def learn_words(self, printed):
        """Documentation tells what a choice means: "word: ..."."""
        section, words = "", []
        for line in map(str.strip, printed.splitlines()):
            if line.startswith("subsection "):
                section, words = line[len("subsection "):] + "/", []
            elif line == "end":
                section = ""
            elif line.startswith("#"):
                words += re.findall(r"\b([a-z][a-z0-9 -]{1,18}):", line)
            elif line.startswith("set "):
                name, value = line[len("set "):].split("=", 1)
                if value.strip() in ("true", "false"):
                    words += ["true", "false"]
                self.values[kind(section + name.strip())].update(words)
                words = []


@dataclasses.dataclass
class Input:
    """Files, the scene first, and the command that reads them."""
    files: dict
    arguments: list
    origin: str
    has_exact: bool = False


class Mutator:
    """One scene more, from @p seed alone."""

    def __init__(self, library, seed):
        self.known, self.random = library, random.Random(seed)
        self.choose = self.random.choice

    def happens(self, probability):
        return self.random.random() < probability

    def make(self, scenes):
        scene = self.choose(scenes)
        text = self.known.texts[scene]
        self.is_in_space = bool(re.search(r"^\s*set Dimension\s*=\s*3", text, re.M))
        self.lines = text.split("\n")
        self.overrides, self.spoilt = [], set()
        if self.happens(0.12):
            self.take_other_path()
        for _ in range(self.choose((0, 1, 1, 1, 1, 1, 2, 2, 3))):
            self.mutate()
        data = "\n".join(self.lines).encode("utf-8", "surrogateescape")
        name = self.choose(("a\nb.prm", "\x1b[31m.prm", "\u00e9.prm")) if self.happens(0.05) else "scene.prm"
        files = {name: self.bytes_spoilt(data) if self.happens(0.05) else data}
        for drawing in re.findall(r"^\s*set File\s*=\s*(\S+)", text, re.M):
            mesh = (scene.parent / drawing).read_bytes()
            files[drawing] = self.mesh_spoilt(mesh) if self.happens(0.4) else mesh
        arguments = [name]
        settled = {**self.limits(text), **dict(self.overrides)}
        if any(path == "Loading/Steps" and re.fullmatch(r"\+?\d{2,9}|\d+e\d", value) for path, value in settings(data.decode(errors="replace")) + list(settled.items())):
            settled["Loading/Steps"] = "3"  # more take their time, and may
        for path, value in settled.items():
            arguments += ["--set", f"{path}={value}".replace("\0", "?")]
        mode = self.random.random()
        if mode < 0.1:
            arguments.append("--validate" if mode < 0.03 else "--picture" if mode < 0.06 else "--print-parameters" if mode < 0.08 else "--inf-sup")
        return Input(files, arguments, scene.stem, "Exact solution" in text)

    def limits(self, text):
        limits = dict(LIMITS_IN_SPACE if self.is_in_space else LIMITS)
        if self.happens(0.2):
            limits["Adaptivity/Maximum steps"] = self.choose(("1", "3", "4"))
        if re.search(r"^subsection Loading", text, re.M):
            limits.update(LIMITS_OF_HISTORIES)
        return {path: value for path, value in limits.items() if path not in self.spoilt}

    def take_other_path(self):
        """The primal path where the scene has another, and the reverse, by what they want."""
        path = self.choose(("primal", "reduced"))
        self.overrides += [("Solver/Path", path)]
        if path == "primal":
            self.overrides += [("Adaptivity/Method", self.choose(("hup2", "hap2", "hap3"))), ("Adaptivity/Start degree", "0"), ("Solver/Normal contact", "automatic")]

    # ------------------------------------------------------------ values

    def value(self, path, old):
        """Another value of an entry, mostly of its own kind."""
        known = self.known.values.get(kind(path), [""])
        takes_functions = any(re.search(r"\b[xyt]\b", value) for value in known)
        roll = self.random.random()
        if roll < 0.4 and NUMBER.search(old):
            return self.tweaked(old)
        if roll < 0.72:
            alike = [value for value in known if value != old and re.sub("[^;,]", "", value) == re.sub("[^;,]", "", old)]
            return self.choose(alike if alike and self.happens(0.85) else known)
        if roll < 0.84 and old and (takes_functions or self.happens(0.1)):
            return self.with_function(old)
        roll = self.random.uniform(0.74, 1)
        if roll < 0.82 and NUMBER.search(old):
            number = self.choose(list(NUMBER.finditer(old)))
            return old[:number.start()] + self.choose(NUMBERS) + old[number.end():]
        if roll < 0.9:
            return self.choose(("; ", ", ")).join(self.choose(NUMBERS) for _ in range(self.choose((1, 1, 2, 3))))
        return self.choose(TEXTS)

    def tweaked(self, old):
        number = self.choose(list(NUMBER.finditer(old)))
        factor = self.choose((0.5, 0.9, 1.1, 2, 3, -1, 0, 0.1, 10, 1e-3, 1e3, 1 + 1e-9))
        try:
            new = int(number[0]) * factor
            new = str(max(1, int(new))) if factor > 0 and factor != 1 + 1e-9 else repr(new)
        except ValueError:
            new = repr(float(number[0]) * factor)
        return old[:number.start()] + new + old[number.end():]

    def with_function(self, old):
        parts = old.split(";")
        k = self.random.randrange(len(parts))
        parts[k] = f"({parts[k].strip()}){self.choose('*+-*')}{self.choose(FUNCTIONS)}"
        return "; ".join(parts)

    # ------------------------------------------------------------ lines

    def mutate(self):
        kinds = ((self.change_value, 10), (self.add_entry, 6), (self.add_section, 2), (self.remove, 2), (self.repeat, 1), (self.rename, 1))
        self.random.choices([k for k, _ in kinds], [weight for _, weight in kinds])[0]()

    def assigned(self):
        return [i for i, line in enumerate(self.lines) if line.strip().startswith("set ") and "=" in line]

    def section_of(self, i):
        for line in reversed(self.lines[:i]):
            if line.strip().startswith("subsection "):
                return line.strip()[len("subsection "):].split("#")[0].strip() + "/"
            if line.strip().startswith("end"):
                return ""
        return ""

    def change_value(self):
        if not (lines := self.assigned()):
            return
        i = self.choose(lines)
        name, old = self.lines[i].split("=", 1)
        path = self.section_of(i) + name.strip()[len("set "):].strip()
        new = self.value(path, old.split("#")[0].strip())
        self.spoilt.add(path)
        if self.happens(0.2):
            self.overrides.append((path, new))
        else:
            self.lines[i] = f"{name}= {new}"

    def add_entry(self):
        """One that the scene may not name yet, where it belongs."""
        entry = self.choose(self.known.entries)
        section, _, name = entry.rpartition("/")
        there = [line.strip()[len("subsection "):].split("#")[0].strip() for line in self.lines if line.strip().startswith("subsection ")]
        alike = [other for other in there if kind(other + "/") == kind(section + "/")]
        if not alike and section in ("Body", "Contact", "Probe", "Pretension", "Geometry") and self.happens(0.8):
            return  # of scenes of another kind; a section comes whole
        path = f"{self.choose(alike) if alike else section}/{name}".lstrip("/")
        self.spoilt.add(path)
        self.overrides.append((path, self.value(path, self.choose(self.known.values[entry]))))

    def ranges(self):
        """First and last line of each section."""
        first, result = None, []
        for i, line in enumerate(self.lines):
            if line.strip().startswith("subsection "):
                first = i
            elif line.strip().startswith("end") and first is not None:
                result.append((first, i))
                first = None
        return result

    def add_section(self):
        """One of another scene, beside that of this one or in its place."""
        sections = self.known.sections
        section = self.choose(sections[self.choose(sorted(sections))]).split("\n")
        alike = [(first, last) for first, last in self.ranges() if self.lines[first].split("#")[0].split() == section[0].split("#")[0].split()]
        if alike and self.happens(0.8):
            first, last = alike[0]
            self.lines[first:last + 1] = section
        else:
            self.lines += section

    def remove(self):
        if self.happens(0.6) and (lines := self.assigned()):
            del self.lines[self.choose(lines)]
        elif ranges := self.ranges():
            first, last = self.choose(ranges)
            del self.lines[first:last + 1]
        else:
            self.lines = self.lines[:self.random.randrange(len(self.lines) + 1)]

    def repeat(self):
        if self.happens(0.5) and (lines := self.assigned()):
            self.lines.insert(self.random.randrange(len(self.lines)), self.lines[self.choose(lines)])
        elif ranges := self.ranges():
            first, last = self.choose(ranges)
            self.lines += self.lines[first:last + 1]

    def rename(self):
        named = [i for i, line in enumerate(self.lines) if line.strip().startswith(("set ", "subsection "))]
        if not named:
            return
        i = self.choose(named)
        head, equals, tail = self.lines[i].partition("=")
        k = self.random.randrange(len(head) + 1)
        self.lines[i] = self.choose((head[:k] + head[k + 1:], head[:k] + self.choose("ax. -\u00e9") + head[k:], head.upper(),
                                     head.replace("left", "right"), head.replace("bottom", "top"), head + " 2")) + equals + tail

    # ------------------------------------------------------------ bytes

    def bytes_spoilt(self, data):
        data = bytearray(data)
        for _ in range(self.choose((1, 1, 2, 4))):
            i = self.random.randrange(len(data) + 1)
            what = self.random.randrange(4)
            if what == 0:
                data[i:i] = self.choose(BYTES)
            elif what == 1:
                data[i:i + 1] = self.choose(BYTES)
            elif what == 2:
                del data[i:i + self.random.randrange(1, 30)]
            elif self.happens(0.5):
                del data[i:]
        return bytes(data)

    def mesh_spoilt(self, data):
        """Mostly another number, a line more or less; now and then other bytes."""
        if self.happens(0.2):
            return self.bytes_spoilt(data)
        lines = data.decode().split("\n")
        for _ in range(self.choose((1, 1, 1, 2, 3))):
            i = self.random.randrange(len(lines))
            if self.happens(0.7):
                words = lines[i].split(" ")
                k = self.random.randrange(len(words))
                words[k] = self.choose((self.choose(NUMBERS), self.tweaked(words[k]) if NUMBER.search(words[k]) else words[k], self.choose(TEXTS)))
                lines[i] = " ".join(words)
            else:
                lines.insert(self.random.randrange(len(lines)), lines[i]) if self.happens(0.5) else lines.pop(i)
        return "\n".join(lines).encode("utf-8", "surrogateescape")


def scenes_of(root):
    """Those that users see, and small ones of tests; bodies in space, of which there are few, several times."""
    own = sorted((root / "prm").glob("*.prm"))
    small = [root / "tests/bad_input" / f"{name}.prm" for name in ("base", "bodies", "half_disc", "mesh", "plate", "ring")]
    in_space = [scene for scene in own if re.search(r"^set Dimension\s*=\s*3", scene.read_text(), re.M)]
    return own + small + 2 * in_space


if __name__ == "__main__":
    raise SystemExit(f"{pathlib.Path(__file__).name} is a part of fuzz.py")
