#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""All that hpvi says when something is wrong, read from the sources: warnings, numerical failures, refused input.

messages.py [--check]

Prints them; with --check it only says what the page doc/manual/messages.md lacks, and ends with 1 if that is anything.

A message is an expression of literals with values between them. Values become N for numbers, (x y) for places and ... for names;
[a | b] is one of both, [a] may be missing. Where a message is made in a function or a stream, its text is looked up there.
"""
import html
import pathlib
import re
import sys
from collections import namedtuple

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "doc/manual/messages.md"
TOKEN = re.compile(r"""(?P<comment>//[^\n]*|/\*.*?\*/|^\#[^\n]*)|R"\((?P<raw>.*?)\)"|"(?P<string>(?:[^"\\]|\\.)*)"
                       |'(?P<char>(?:[^'\\]|\\.)*)'|(?P<word>[A-Za-z_]\w*)|(?P<number>\d[\w.]*)
                       |(?P<sign><<|>>|->|::|\+=|&&|\|\||[<>=!]=|\S)|\n""", re.S | re.X | re.M)
# What throws, and the kind of what it says.
THROWERS = {"InputError": "refused", "reject": "refused", "Objection": "refused", "fail": "refused", "complain": "refused", "at": "refused",
            "damaged": "refused", "NumericalFailure": "failed", "MemoryFailure": "failed", "OutputFailure": "unwritten"}
# Values that hold a message, and the section it is about.
HOLDERS = {"ShapeFlaw": ("refused", "Geometry"), "Flaw": ("refused", "Material NAME"), "Problem": ("refused", "Boundary NAME"),
           "Missing": ("failed", ""), "InadmissibleContact": ("failed", "")}
# Functions that pass on what others say, or the words of the system, as NOUN:FUNCTION; what they say beside that is not passed on.
PASSED_ON = {
    "base/parameter_file:fail", "base/processes:collectively", "base/file_format:reject", "checks/rejection:reject",
    "checks/rejection:check_value", "checks/method:check_primal_path", "checks/loading:check_load_steps", "checks/functions:check_friction", "checks/shape:check_geometry",
    "checks/shape:check_materials", "driver/load_history:run", "driver/adaptive_solver:run", "gmsh/drawing_file:check_end", "gmsh/gmsh_text:damaged", "gmsh/gmsh_text:",
    "gmsh/mesh_complaint:", "gmsh/mesh_complaint:at", "gmsh/mesh_complaint:damaged", "scene/material:flaw_of", "input/sweep:reject",
    "input/parameters:reject", "shapes/shape:names_of_sides", "output/output:write_together", "output/output:take_up", "output/result_directory:path", "output/result_directory:take_lock",
    "driver/primal_backend:reach_loads", "driver/reduced_backend:discretise", "program/sweep_run:naming_values",
    "output/vtu_reader:require", "program/main:report_of"}
# Functions that return what is refused: section and entry.
RETURNED = {"scene/orthotropy:flaw": ("Material NAME", "Poisson's ratios")}
# What wrappers add to what they are given: where, and a literal that is there.
ENDINGS = {**{f"driver/{noun}": "; go on with the scene of that run, or begin a new one"
              for noun in ("adaptive_solver", "checkpoint", "load_history")}, "base/file_format": "; then what to make anew",
           "results/stored_solution": "; make the reference solution anew from a scene of the same problem with the same coarse mesh",
           "output/": "; choose another one with --output", "program/sweep_run": "; choose another one with --output"}
# Sections that a source is about where they are no literals.
SECTIONS = {"checks/functions": "Boundary NAME", "checks/axisymmetry": "Boundary NAME", "reader/boundary_reader": "Boundary NAME",
            "reader/plate_reader": "Boundary NAME", "reader/probe_reader": "Probe NAME",
            "reader/pair_sides": "Contact NAME", "reader/bodies_reader": "Contact NAME", "reader/body_reader": "Material NAME",
            "reader/material_reader": "Material NAME", "checks/supports": "Boundary NAME",
            "checks/parts": "Boundary NAME", "checks/method": "Boundary NAME", "checks/exact_agreement": "Boundary NAME",
            "closed_forms/closed_form": "Boundary NAME",
            "shapes/mesh_from_file": "Boundary NAME", "reader/scene_reader": "Material NAME", "shapes/shape": "Geometry"}
# What the refused input of other sources is about.
SUBJECTS = {"The command line": ("program/", "input/sweep"), "Scene files": ("base/parameter_file", "input/parameters", "input/remedies", "reader/user_names"),
            "Expressions": ("input/expressions",), "Mesh files": ("gmsh/", "shapes/mesh_from_file"),
            "Files of earlier runs": ("base/file_format", "driver/checkpoint", "driver/load_history", "driver/adaptive_solver", "results/stored_solution", "output/tables"),
            "The directory of results": ("output/",), "Scenes made by code": ("plane/mesh", "scene/scene", "driver/backend")}
NUMBERS = {"to_string", "text", "labelled", "bytes_text", "size", "n", "degrees"}
NAMES = {"name", "mention", "name_of", "listed", "what", "in_words", "words", "path", "printable", "checksum", "where", "section",
         "origin", "direction", "describe", "in_quotes"}
WORDY = re.compile(r"(words|name|entry|remedy|direction|limit|list|place|what|why|boundary|motion|places|function)$")
PLACE = re.compile(r"^(x|at|where|point|centre|piece|face|vertices)$|\b(at|centre|point|vertices|corners|where|folded)\b|piece|^face|^corner$")
REMEDY = re.compile(r"; [\w\[\"`-]|this scene has: |\bmake a dealii")
Token = namedtuple("Token", "kind text line")
Message = namedtuple("Message", "kind section entry text source")  # kind: refused, failed, unwritten, or a WarningKind


def tokens(text):
    found, line = [], 1
    for match in TOKEN.finditer(text):
        kind = match.lastgroup
        if kind in ("raw", "string", "char"):
            words = match[kind] if kind == "raw" else \
                re.sub(r"\\(.)", lambda m: {"n": "\n", "t": "\t"}.get(m[1], m[1]), match[kind])
            if found and found[-1].kind == "literal":
                found[-1] = Token("literal", found[-1].text + words, found[-1].line)
            else:
                found.append(Token("literal", words, line))
        elif kind and kind != "comment":
            found.append(Token(kind, match[kind], line))
        line += match[0].count("\n")
    return found


def is_sign(token, signs):
    return token.kind == "sign" and token.text in signs


def group(code, opening):
    """What stands between brackets, cut at commas, and where they close."""
    depth, parts = 0, [[]]
    for k in range(opening, len(code)):
        if is_sign(code[k], "([{"):
            depth += 1
            if depth == 1:
                continue
        elif is_sign(code[k], ")]}"):
            depth -= 1
            if depth == 0:
                return [part for part in parts if part], k
        if depth == 1 and is_sign(code[k], ","):
            parts.append([])
        else:
            parts[-1].append(code[k])
    return parts, len(code)


def cut(code, signs):
    """At signs outside of brackets."""
    depth, parts = 0, [[]]
    for token in code:
        depth += is_sign(token, "([{") - is_sign(token, ")]}")
        if depth == 0 and token.kind == "sign" and token.text in signs:
            parts.append([])
        else:
            parts[-1].append(token)
    return parts


def statement(code, k):
    """From k to the semicolon."""
    depth, end = 0, k
    while end < len(code) and not (depth == 0 and is_sign(code[end], ";")):
        depth += is_sign(code[end], "([{") - is_sign(code[end], ")]}")
        if depth < 0:
            break
        end += 1
    return code[k:end]


def has_words(text):
    return re.search(r"[A-Za-z]{2}", re.sub(r"\.\.\.|\bN\b|\(x y\)|FILE", "", text)) is not None


def one_of(texts, otherwise="..."):
    """Of several texts one; what has no words is none."""
    texts = list(dict.fromkeys(texts))
    said = [text for text in texts if has_words(text)]
    if not said:
        return otherwise
    before, after = (" " if all(text[k] == " " for text in said) else "" for k in (0, -1))
    inner = " | ".join(text.strip() if before or after else text for text in said)
    return f"{before}[{inner}]{after}" if len(texts) > 1 else inner


class Sources:
    def __init__(self):
        self.is_desperate = False  # where a message has no words but those of other rooms
        self.code = {}
        for path in sorted((ROOT / "source").rglob("*.cc")) + sorted((ROOT / "include").rglob("*.h")):
            if "python" not in path.parts and "source/python" not in str(path):
                noun = "/".join(path.with_suffix("").parts[-2:])
                self.code[noun + (".h" if path.suffix == ".h" else "")] = tokens(path.read_text())
        self.functions, self.constants = {}, {}  # a function: noun, begin and end; a constant: noun, place and literal
        for noun, code in self.code.items():
            for k in range(len(code) - 1):
                if code[k].kind != "word" or code[k].text in ("if", "for", "while", "switch", "catch"):
                    continue
                if is_sign(code[k + 1], "("):
                    end = group(code, k + 1)[1]
                    ahead = end + 1
                    while ahead < len(code) and code[ahead].kind == "word" and code[ahead].text in ("const", "override", "noexcept"):
                        ahead += 1
                    if ahead < len(code) and is_sign(code[ahead], "{"):
                        self.functions.setdefault(code[k].text, []).append((noun, ahead, group(code, ahead)[1]))
                elif is_sign(code[k + 1], "=") and k + 2 < len(code) and code[k + 2].kind == "literal":
                    self.constants.setdefault(code[k].text, []).append((noun, k, statement(code, k + 2)))

    # ---------------------------------------------------------------- texts of expressions

    def text(self, code, noun, place, depth=0, is_line=False):
        """Of an expression that stands at a place of a noun."""
        while len(code) > 2 and is_sign(code[0], "(") and group(code, 0)[1] == len(code) - 1:
            code = code[1:-1]
        parts = [part for part in cut(code, ("+", "<<")) if part]
        if len(parts) > 1:
            pieces = [self.text(part, noun, place, depth, is_line) for part in parts]
            for k, piece in enumerate(pieces):
                if piece in ("...", "N") and k > 0 and pieces[k - 1].endswith("(") and (pieces[k + 1:] or [""])[0].startswith(")"):
                    pieces[k] = "x y"
                elif piece == "..." and is_line and not WORDY.search(self.call(parts[k])[0]):
                    pieces[k] = "N"
            return "".join(pieces)
        alternatives = cut(code, ("?", ":"))
        if len(alternatives) == 2:
            return "..."
        if len(alternatives) > 2:
            texts = [self.text(part, noun, place, depth, is_line) for part in alternatives[1::2] + alternatives[2:][-1:]]
            return one_of(texts)
        if not code:
            return ""
        if code[0].kind == "literal":
            return code[0].text if len(code) == 1 else "..."  # a letter of it
        name, arguments = self.call(code)
        if name == "line" and arguments:
            return self.text([token for part in arguments for token in [*part, Token("sign", "+", 0)]][:-1], noun, place, depth, True)
        if name in ("string", "labelled", "accumulate") and arguments and any(token.kind == "literal" for token in arguments[0]):
            return self.text(arguments[0], noun, place, depth, is_line)
        if depth < 5 and name not in NUMBERS | NAMES:
            found = self.looked_up(code, name, arguments, noun, place, depth)
            if found:
                return found
        if name == "to_string" and arguments and PLACE.search(" ".join(token.text for token in arguments[0])):
            return "(x y)"
        return "N" if name in NUMBERS else "..."

    @staticmethod
    def call(code):
        """Name and arguments of `a::b.name(arguments)`, or name of `a->name`."""
        if is_sign(code[-1], ")}"):
            for k in range(len(code) - 1):
                if is_sign(code[k], "({") and group(code, k)[1] == len(code) - 1:
                    names = [token.text for token in code[:k] if token.kind == "word"]
                    return names[-1] if names else "", group(code, k)[0]
        return (code[-1].text if code[-1].kind == "word" else ""), None

    def around(self, noun, place):
        """Begin and end of the function that a place is in."""
        return max(((begin, end) for ranges in self.functions.values() for other, begin, end in ranges
                    if other == noun and begin < place < end), key=lambda one: one[0],
                   default=(0, place))

    def looked_up(self, code, name, arguments, noun, place, depth):
        """Where the words of a name are: in its function, in a stream, in a variable, in a constant."""
        if name == "str":
            return self.streamed(code[0].text, noun, place, depth)
        if name == "message" and len(arguments or ()) < 2:
            return ""  # of the system
        if arguments is not None:
            return one_of(self.returned(name, noun, depth), "")
        if len(code) > 1 and not self.is_desperate:
            return ""
        here, (begin, _) = self.code[noun], self.around(noun, place)
        for k in range(place - 1, begin, -1):
            if here[k].text != name or here[k - 1].text in (".", "->", "(", ",", "+", "<<"):
                continue
            if is_sign(here[k + 1], "="):
                text = self.text(statement(here, k + 2), noun, k, depth + 1)
            else:
                continue
            if has_words(text):
                return text
        found = self.passed(name, noun, begin, depth)
        if found:
            return found
        for other, k, value in self.constants.get(name, []):
            if other.endswith(".h") or (other == noun and self.around(noun, k)[0] == 0):
                return self.text(cut(value, (",",))[0], other, k, depth + 1)
        return ""

    def passed(self, name, noun, begin, depth):
        """What callers of the function that begins there, in the same noun, pass on as its argument of that name."""
        code, function = self.code[noun], self.function_at(noun, begin + 1)
        texts = []
        if function in THROWERS or f"{noun}:{function}" in PASSED_ON:
            return ""
        for k in range(len(code) - 1):
            if code[k].text != function or not is_sign(code[k + 1], "("):
                continue
            arguments, end = group(code, k + 1)
            if end < begin < end + 6:  # its definition
                names = [argument[-1].text for argument in arguments]
                if name not in names:
                    return ""
                place = names.index(name)
                texts = [self.text(others[place], noun, j, depth + 1) for j in range(len(code) - 1)
                         if code[j].text == function and is_sign(code[j + 1], "(") and j != k
                         for others in [group(code, j + 1)[0]] if len(others) > place]
        texts = [text for text in dict.fromkeys(texts) if has_words(text)]
        return "[" + " | ".join(texts) + "]" if len(texts) > 1 else "".join(texts)

    def streamed(self, name, noun, place, depth):
        """What was written to a stream before it is asked for, since its declaration."""
        here, (begin, _) = self.code[noun], self.around(noun, place)
        start = max((k for k in range(begin, place) if here[k].text == "ostringstream" and here[k + 1].text == name), default=place)
        written, k = [], start + 2
        while k < place:
            if here[k].text == name and here[k + 1].text == "<<":
                said = statement(here, k + 2)
                text = self.text(said, noun, k, depth + 1, True)
                if here[k - 1].text == "else" and written:
                    written[-1] = f"[{written[-1].strip('[]')} | {text}]"
                else:
                    written.append(f"[{text}]" if is_sign(here[k - 1], ")") else text)
                k += len(said)
            k += 1
        return "".join(written)

    def returned(self, name, noun, depth):
        """What functions of that name return, each with words: those of this noun, else, where nothing else has words, of any."""
        texts = []
        for other, begin, end in self.functions.get(name, []):
            if other != noun and not self.is_desperate:
                continue
            code = self.code[other]
            for k in range(begin, end):
                if code[k].text == "return" and code[k].kind == "word":
                    value = statement(code, k + 1)
                    if value and (is_sign(value[0], "{") or (len(value) > 1 and value[-1].text == "}")):
                        value = max(group(value, next(j for j, token in enumerate(value) if is_sign(token, "{")))[0] or [[]],
                                    key=lambda part: sum(len(token.text) for token in part if token.kind == "literal"))
                    texts.append(self.text(value, other, k, depth + 1))
        return [text for text in dict.fromkeys(texts) if has_words(text)]


    # ---------------------------------------------------------------- messages

    def messages(self):
        """All of them, and the places that say something whose words were not found."""
        found, silent = [], []
        for noun, code in self.code.items():
            for k in range(len(code) - 1):
                if code[k].kind != "word" or code[k - 1].text in ("class", "struct", "void"):
                    continue
                name = code[k].text
                if (name in THROWERS and is_sign(code[k + 1], "(")) or (name in {*HOLDERS, "Objection"} and code[k + 1].text == "{") \
                        or (name == "Missing" and code[k + 2].text == "{"):
                    arguments, end = group(code, k + (2 if code[k + 1].kind == "word" else 1))
                    if self.is_said(noun, code, k, arguments, end):
                        said = self.said(noun, k, name, arguments)
                        if f"{noun}:{self.function_at(noun, k)}" in PASSED_ON and not any(REMEDY.search(message.text) for message in said):
                            continue
                        found += said
                        if not said:
                            silent.append(f"source/{noun}.cc:{code[k].line} {self.function_at(noun, k)}")
            found += self.warnings(noun, code)
        for place, (section, entry) in RETURNED.items():
            noun, function = place.split(":")
            found += [Message("refused", section, entry, tidy(text), noun) for text in self.returned(function, noun, 0)]
        return list(dict.fromkeys(found)), silent

    def is_said(self, noun, code, k, arguments, end):
        """Is this a call, not a declaration, a definition or another function of that name?"""
        words = [token for argument in arguments for token in argument]
        if code[k - 1].kind == "word" and code[k - 1].text not in ("throw", "return", "else") or (len(words) == 1 and words[0] == code[k]):
            return False
        if not words or any(token.text in ("const", "using") for token in words[:3]) or code[k - 1].text in ("::", "~"):
            return code[k - 1].text == "::" and bool(words) and code[k].text == "Flaw"
        if code[k].text in ("at", "reject", "complain") and is_sign(code[k - 1], ".") and code[k].text == "at":
            return noun.startswith("gmsh/") and any(token.kind == "literal" for token in words)
        return not (code[k].text == "at" and not noun.startswith("gmsh/")) and not is_sign(code[min(end + 1, len(code) - 1)], "{:")

    def function_at(self, noun, place):
        begin, end = self.around(noun, place)
        return next((name for name, ranges in self.functions.items() if (noun, begin, end) in ranges), "")

    def said(self, noun, k, name, arguments):
        """The messages of a call: more than one where it throws one of several."""
        kind, section = HOLDERS.get(name, (THROWERS.get(name), ""))
        if name == "InputError":
            arguments = arguments[:1]  # without names_time
        texts = [self.text(argument, noun, k) for argument in arguments]
        entry = ""
        if name in HOLDERS:
            entry = texts[0] if section else ""
            texts = [max(texts[1:] or texts, key=len)]
        elif name in ("reject", "fail", "Objection") and len(arguments) >= 3:
            first = 0 if name != "reject" or self.code[noun][k - 1].text in (".", "->") or len(arguments) == 3 else 1
            if name == "fail":
                section, texts = (texts[1] if has_words(texts[1]) else ""), texts[2:3]
            else:
                section, entry = (self.section(noun, texts[first], arguments[first]), texts[first + 1])
                texts = texts[first + 2:first + 3]
        else:
            texts = texts[-1:]
        if not has_words(texts[0]):
            self.is_desperate = True
            texts = [self.text(arguments[-1], noun, k)]
            self.is_desperate = False
        ending = "; the file is damaged, write it anew with Gmsh" if name == "damaged" else ""
        if len(arguments) < 3 and (name == "reject" or (name == "InputError" and noun == "output/tables")):
            ending = next((words for begin, words in ENDINGS.items() if noun.startswith(begin)), "")
        result = []
        for text in split(texts[0]):
            place = re.match(r"^(?:\.\.\.: )?(Boundary|Geometry|Solver|Loading|Dimension|Body)([^/:;]*)(?:/([^:;=]*))?( = \w+)?: (?=\w)", text)
            if place and not section:
                text = text[place.end():]
                if place[1] == "Dimension":
                    result.append(Message(kind, "The scene", "Dimension", text, noun))
                    continue
                where = re.sub(r"^(Boundary|Body) .*", r"\1 NAME", place[1] + place[2].rstrip())
                result.append(Message(kind, where, (place[3] or "").strip() + (place[4] or ""), tidy(text) + ending, noun))
            elif has_words(text) and not text.startswith("...; the file"):
                if name in ("reject", "Objection") and not section and len(arguments) > 2:
                    section = SECTIONS.get(noun, "")
                result.append(Message(kind, section, entry, tidy(text) + ending, noun))
        return result

    @staticmethod
    def section(noun, text, code):
        words = {token.text for token in code}
        if has_words(text):
            return re.sub(r"^(Boundary|Material|Contact|Probe|Body(?! force)) .*", r"\1 NAME", text)
        if [(token.kind, token.text) for token in code] == [("literal", "")]:  # an entry outside of all sections
            return "The scene"
        if "section_of_material" in words:
            return "Material NAME"
        return SECTIONS.get(noun, "")

    def warnings(self, noun, code):
        """`{WarningKind::kind, size, text}`; where the kind is an argument of the function, for each that it is called with."""
        found = []
        for k in range(len(code) - 3):
            if not is_sign(code[k], "{") or code[k + 1].text not in ("WarningKind", "kind"):
                continue
            fields = group(code, k)[0]
            if len(fields) != 3:
                continue
            kinds = [code[k + 3].text]
            if code[k + 1].text == "kind":
                function = self.function_at(noun, k)
                kinds = [code[j].text for j in range(2, len(code)) if code[j - 2].text == "WarningKind" and code[j - 1].text == "::"
                         and function in {token.text for token in code[max(0, j - 9):j]} and is_sign(code[j + 1], ")")]
            text = self.text(fields[2], noun, k)
            if not has_words(text):
                self.is_desperate = True
                text = self.text(fields[2], noun, k)
                self.is_desperate = False
            found += [Message(kind, "", "", tidy(text), noun) for kind in dict.fromkeys(kinds)]
        return found


def tidy(text):
    text = re.sub(r"^\.\.\.: |(?<=\.\.\.)(?:\.\.\.)+", "", text)
    text = re.sub(r"\bN(?: ?N)+\b", "N", re.sub(r"\(N N\)", "(x y)", text))
    return re.sub(r"(?<=\.\.\.)(?=[a-z])", " ", text)


def split(text):
    """A text that is one of several long ones, into these."""
    if not (text.startswith("[") and text.endswith("]")):
        return [text]
    depth, parts, piece = 0, [], ""
    for k, letter in enumerate(text[1:-1]):
        depth += (letter == "[") - (letter == "]")
        if depth < 0:
            return [text]
        if depth == 0 and text[1:-1][k:k + 3] == " | ":
            parts.append(piece)
            piece = ""
        else:
            piece += letter
    parts = [part.removeprefix("| ") for part in [*parts, piece]]
    return parts if min(map(len, parts)) > 30 else [text]


# -------------------------------------------------------------------- the page

# In the order in which a scene is written; all others after these.
ORDER = ["The scene", "Geometry", "Body NAME", "Material", "Boundary NAME", "Contact NAME", "Body force", "Temperature", "Loading", "Probe NAME",
         "Exact solution", "Adaptivity", "Solver", "Error", "Output"]
PLACEHOLDER = re.compile(r"^@(WARNING|FAILURE) ([^@\n]+)@$\n", re.M)


def escaped(text):
    return re.sub(r"([\\*#@$]|--)", r"\\\1", html.escape(text, quote=False))


def with_remedy(text):
    """Bold is what to do about it, behind the last semicolon outside of brackets."""
    depth, last = 0, None
    for k, letter in enumerate(text):
        depth += (letter == "[") - (letter == "]")
        if letter == ";" and text[k + 1:k + 2] == " " and (depth == 0 or text[:k].rfind("[") == k - 1):
            last = k
    if last is None or "x, y; x, y" in text:
        return escaped(text)
    return f"{escaped(text[:last + 1])} <b>{escaped(text[last + 2:])}</b>"


def heading(text):
    """The words that a message begins with."""
    words = re.split(r"[:;,(]| \| ", re.sub(r"^(?:\.\.\.|\[)+ *", "", text))[0]
    return escaped(re.sub(r"\]|\[[^\]]*$", "", words).strip())


def quoted(messages):
    return "\n>\n".join(f"> {with_remedy(message.text)}" for message in messages) + "\n"


def table(messages, name_of):
    rows = [f"<tr><td>{name_of(message)}</td><td>{with_remedy(message.text)}</td></tr>" for message in messages]
    return "<table>\n" + "\n".join(dict.fromkeys(rows)) + "\n</table>\n"


def subject(message):
    """What refused input is about: a section of the scene, or else."""
    section = re.sub("^Material NAME$", "Material", message.section)
    if section in ORDER:
        return section
    if section.startswith("[Output"):
        return "Output"
    return next((name for name, begins in SUBJECTS.items() if message.source.startswith(begins)),
                "Scenes made by code" if message.source.startswith("checks/") else "Scene files")


def refused(messages):
    lines = []
    for name in [*ORDER, *SUBJECTS]:
        chosen = [message for message in messages if message.kind == "refused" and subject(message) == name]
        if not chosen:
            continue
        anchor = re.sub(r"\W", "_", name.lower())
        lines += [f"## {name} {{#messages_{anchor}}}", ""]
        if name in ORDER:
            chosen = sorted(chosen, key=lambda message: (message.entry.startswith(("...", "[")), message.entry))
            lines.append(table(chosen, lambda message: "any" if message.entry in ("", "...") else escaped(message.entry).strip("[]")))
        else:
            lines.append(table(chosen, lambda message: escaped("" if message.section.startswith("The") else message.section)))
    return "\n".join(lines)


def of_page(messages, kind, key):
    """The messages of `@WARNING key@`, of `@FAILURE key@`."""
    if kind == "WARNING":
        return [message for message in messages if message.kind == key]
    return [message for message in messages if message.kind == "failed" and message.text.startswith(key)]


def reasons(sources):
    """Why there is no bound of the error: what these functions return."""
    found = []
    for function in ("no_error_bound", "flaw", "cause_of_imbalance"):
        for noun, begin, end in sources.functions[function]:
            code = sources.code[noun]
            if function != "flaw" or noun == "bound/error_bound":
                found += [tidy(text) for k in range(begin, end) if code[k].text == "return"
                          for text in split(sources.text(statement(code, k + 1), noun, k)) if has_words(text)]
    return "\n".join(f"- {escaped(text)}" for text in dict.fromkeys(found)) + "\n"


def hints(sources):
    """What is answered to names of other programs: words, and what to write in their place."""
    code, found = sources.code["reader/scene_aliases"], []
    for k in range(len(code) - 1):
        if not (is_sign(code[k], "{") and is_sign(code[k + 1], "{")):
            continue
        parts = group(code, k)[0]
        words = [token.text for token in parts[0] if token.kind == "literal"]
        if len(parts) == 2 and words and all(token.kind == "literal" or is_sign(token, "{},") for token in parts[0]):
            remedy = sources.text(parts[1], "reader/scene_aliases", k)
            found.append(f"<tr><td>{escaped(', '.join(words))}</td><td><b>{escaped(remedy)}</b></td></tr>")
    return "<table>\n" + "\n".join(found) + "\n</table>\n"


def page():
    """doc/manual/messages.md with its messages."""
    sources = Sources()
    messages, _ = sources.messages()
    text = PLACEHOLDER.sub(lambda m: f"### {heading(of_page(messages, m[1], m[2])[0].text)}\n\n{quoted(of_page(messages, m[1], m[2]))}\n",
                           PAGE.read_text())
    unwritten = [message for message in messages if message.kind == "unwritten"]
    return text.replace("@REFUSED@", refused(messages)).replace("@UNWRITTEN@", quoted(unwritten)).replace("@REASONS@", reasons(sources)) \
        .replace("@HINTS@", hints(sources))


def complaints():
    """What the page lacks, and what it has in vain."""
    messages, silent = Sources().messages()
    found = [f"{place}: no words of the message are found; give it literals, or name it in PASSED_ON of doc/messages.py" for place in silent]
    text = PAGE.read_text()
    said = {(kind, key): prose for kind, key, prose in re.findall(r"^@(WARNING|FAILURE) ([^@\n]+)@\n\n(.*?)\n(?=@|#|\Z)", text, re.M | re.S)}
    kinds = re.findall(r"^  (\w+),? +///<", (ROOT / "include/hpvi/results/warnings/warnings.h").read_text(), re.M)
    for kind in kinds:
        if not any(message.kind == kind for message in messages):
            found.append(f"warning {kind}: its text is not found in the sources")
        if ("WARNING", kind) not in said:
            found.append(f"warning {kind}: doc/manual/messages.md has no cause of it; write @WARNING {kind}@ and a paragraph below")
    for message in messages:
        if message.kind == "failed" and not any(kind == "FAILURE" and message.text.startswith(key) for kind, key in said):
            found.append(f"\"{message.text}\": doc/manual/messages.md has no cause of it; write @FAILURE and its first words@ and a paragraph below")
        if message.kind == "refused" and not REMEDY.search(message.text):
            found.append(f"\"{message.text}\" in source/{message.source}.cc has no remedy; write it behind a semicolon")
    for (kind, key), prose in said.items():
        own = of_page(messages, kind, key)
        if not own:
            found.append(f"@{kind} {key}@: no message of the sources is that")
        if len(prose.split()) < 6:
            found.append(f"@{kind} {key}@: says no cause")
        if not all(";" in message.text for message in own) and "**Remedy:**" not in prose:
            found.append(f"@{kind} {key}@: the message has no remedy, and the page says none; write **Remedy:**")
    return found


def main():
    if sys.argv[1:] == ["--check"]:
        found = complaints()
        print("\n".join(found), end="\n" if found else "")
        sys.exit(1 if found else 0)
    for message in Sources().messages()[0]:
        print(f"{message.kind:<17} {message.section}/{message.entry}: {message.text}")


if __name__ == "__main__":
    main()
