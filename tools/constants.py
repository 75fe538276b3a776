#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Lists the numbers in the code of the surfaces, each with its name, unit and source.

Read are the headers of FOLDERS. Every numeric literal other than 0, 1 and 2 has

- a name: that of the constexpr variable, data member or default argument whose initializer it is in;
- a source, in the comment on the same line or on the lines above, which determines its kind:
    chosen       "chosen"; such a 1 or 2 is listed as well, but not counted
    performance  "performance only"
    numerical    a guard against "rounding" or "overflow", or "numerical"
    formula      "formula", "quantile", or a significance level in %
    thesis       a section, an equation or a symbol of Klasing 2010, or another publication
- a unit in square brackets in the comment ("[m]"), unless it has none or is only a part of the value;
  an angle has that of degrees().

A number of a formula needs no name, and neither name nor source if FORMULAS has it.

    constants.py [--include DIR] [--json]

Prints a table and totals; --json prints a list of objects in place of these. Exit status: 0, or 1
with a number without name or source, or more than MAX_CHOSEN constants that are chosen.
"""

import argparse
import collections
import dataclasses
import json
import pathlib
import re
import sys

from cpp_source import (INCLUDE_DIR, code_only, comments, function_bodies, without_directives,
                        without_requirements)

FOLDERS = ["gnomon/segmentation", "gnomon/occlusion", "gnomon/perception",
           "gnomon/normals/detail/wide_noise.hpp"]
# The views of objects have surfaces of their own, with more that is chosen: on simulated furniture. So have
# hypotheses about objects.
OTHER = {"gnomon/perception/perceive_views.hpp", "gnomon/perception/detail/neighbors_by_density.hpp",
         "gnomon/perception/detail/separated_walls.hpp",
         "gnomon/perception/detail/cells_of_object.hpp", "gnomon/perception/detail/alignment_effort.hpp",
         "gnomon/perception/find_objects.hpp", "gnomon/perception/detail/object_hypotheses.hpp",
         "gnomon/perception/detail/known_objects.hpp",
         "gnomon/perception/detail/object_competition.hpp", "gnomon/perception/detail/object_probability.hpp",
         "gnomon/perception/detail/observed_space.hpp", "gnomon/perception/detail/pose_search.hpp",
         "gnomon/perception/detail/scene_evidence.hpp", "gnomon/perception/found_object.hpp",
         "gnomon/perception/detail/image_of_surface.hpp", "gnomon/perception/detail/surface_drawing.hpp",
         "gnomon/perception/detail/silhouette_rays.hpp", "gnomon/perception/detail/silhouette_fit.hpp",
         "gnomon/perception/detail/ground_motions.hpp",
         "gnomon/perception/detail/whole_beams.hpp"}
MAX_CHOSEN = 15

# Numbers of formulas: the number is a group of the pattern, which is found in its line. Name, source.
FORMULAS = [
    (r"\b[a-z] < (3)\b", "dimensions", "the coordinates of space"),
    (r"std::array<[\w:]+, (\d+)>", "components", "the number of components"),
    (r"(?<=[\w\]])\[(\d)\]", "component", "a component, or their number"),
    (r"\bcount < (3)\b", "points of a plane", "three points determine a plane"),
    (r"\b(1\.4826)\b", "deviations per median", "the median of a normal distribution"),
    (r"\b(12\.0) \* \S*values\[", "squares per variance", "a rectangle has side^2 / 12"),
    (r"\bexp2\((0\.5) \*", "one half", "a square root"),
    (r"\bcombined\((0\.5),.* (0\.5),", "one half", "the mean of two"),
    (r"(0\.5) \* atan2pi\(.* (0\.5);", "one half", "from -1 to 1, to 0 to 1"),
    (r"\batan2pi\(.* (0\.5);", "one half", "from -1/2 to 1/2, to 0 to 1"),
    (r"\bstd::clamp\(.*, 0\.0, 1\.0\) - (0\.5);", "one half", "from 0 to 1, to -1/2 to 1/2"),
    (r"(0\.5) \* std::numbers::pi", "one half", "a quarter turn"),
    (r"\+ (0\.5)\)", "one half", "rounding to the nearest number"),
    (r"(0\.5) \* squared\b", "one half", "the exponent of a normal distribution"),
    (r"\bquantile\(\w+, (0\.5)\)", "one half", "the median"),
]
FORMULAS = [(re.compile(pattern, re.I), name, source) for pattern, name, source in FORMULAS]

LITERAL = re.compile(r"(?<![\w.])(?P<value>0x[0-9a-f']+|(?:\d[\d']*\.?[\d']*|\.\d[\d']*)(?:e[+-]?\d+)?)[ulfz]*\b",
                     re.I)
PLAIN = (0.0, 1.0, 2.0)
KINDS = {
    "chosen": r"\bchosen\b",
    "performance": r"\bperformance only\b",
    "numerical": r"\b(?:numerical|rounding|overflow|underflow)\b",
    "formula": r"\bformula\b|\bquantile\b|\d %",
    "thesis": r"\bKlasing\b|\bthesis\b|\b(?:Eq|Sec|Alg|Fig|Table|Tab)s?\.? \(?\d"
              r"|\b(?:alpha_max|rho_\w+|sigma_sv\w*|n_min|n_b|k_c)\b|^[rk], |^[rk] \["
              r"|\b[A-Z]\w+(?: and [A-Z]\w+| et al\.)? (?:19|20)\d\d\b",
}
UNIT = re.compile(r"\[((?:1 / )?(?:mm?|s|rad|degrees|pixels)(?:\^\d)?)\]")
CLAUSE_END = re.compile(r"; |\. (?=[A-Z])")
SCOPE = re.compile(r"\b(?:class|struct|union|namespace|enum|else|do|try)\b|\)\s*(?:\w*\s*|->.*)$")
ACCESS = re.compile(r"\b(?:public|private|protected)\s*$")


@dataclasses.dataclass(frozen=True)
class Constant:
    kind: str      # of KINDS, or "" without a source
    name: str      # or "" without one
    value: str     # as in the code
    unit: str      # or ""
    source: str    # the clause of the comment that names it
    path: str      # from include/
    line: int
    column: int    # of the value, from 1 on
    declared: int  # the line on which the declaration begins

    @property
    def place(self):
        return f"include/{self.path}:{self.line}"

    def problem(self):
        missing = [what for what, given in (("a name", self.name), ("a source", self.kind)) if not given]
        return f"{self.place}: {self.name or 'the number'} {self.value}: needs {' and '.join(missing)}"


class Header:
    """The numbers of one header."""

    def __init__(self, path, text):
        self.path = path
        self.code = without_directives(without_requirements(code_only(text)))
        self.bodies = [(start, end) for _, start, end in function_bodies(self.code)]
        self.lines = self.code.split("\n")
        self.comments = collections.defaultdict(str)  # by line
        for line, comment in comments(text):
            self.comments[line] += comment
        self.openings = openings(self.code)
        self.starts = [len(line) - len(line.lstrip()) for line in text.split("\n")]

    def constants(self):
        """Its Constants, with and without name and source, in the order of the code."""
        for literal in LITERAL.finditer(self.code):
            constant = self.constant(literal)
            if constant:
                yield constant

    def constant(self, literal):
        line, value = self.line_of(literal.start()), literal["value"]
        name, first = self.declaration(literal.start())
        beside, above = self.comment(first, line, name)
        kind, source = kind_of(beside)
        if not kind:
            kind, source = kind_of(above)
        before, after = self.code[:literal.start()], self.code[literal.end():]
        is_whole = re.search(rf"\b{name}\s*[={{]\s*$", before) and re.match(r"\s*[;,)}]", after)
        if is_plain(value) and not (name and is_whole and kind == "chosen"):
            return None
        unit = UNIT.search(f"{beside} {above}")
        unit = unit[1] if unit and is_whole else ""
        if re.search(r"\bdegrees\(\s*$", before):
            unit = "degrees"
        column = literal.start() - before.rfind("\n")
        for pattern, name_there, source_there in FORMULAS:
            if self.is_group_of(pattern, line, column):
                name, kind, source = name or name_there, "formula", source_there
        return Constant(kind, name or ("formula" if kind == "formula" else ""), value, unit, source,
                        self.path, line, column, first)

    def is_group_of(self, pattern, line, column):
        return any(column - 1 == found.start(group)
                   for found in pattern.finditer(self.lines[line - 1])
                   for group in range(1, pattern.groups + 1))

    def line_of(self, position):
        return self.code.count("\n", 0, position) + 1

    def declaration(self, position):
        """(name of the constant that a position initializes or "", first line of its statement)"""
        start = self.statement(position)
        head = self.code[start:position]
        first = self.line_of(start + len(head) - len(head.lstrip()))
        in_function = any(begin < position < end for begin, end in self.bodies)
        if in_function and not re.match(r"\s*(?:static\s+)?constexpr\b(?!\s*\()", head):
            return "", first
        names = re.findall(r"(\w+)\s*=(?!=)", head) or re.findall(r"(\w+)\s*\{", head)
        return names[-1] if names else "", first

    def statement(self, position):
        """Where the statement begins that a position is in. Braces around a value are part of it."""
        i = position
        while i > 0:
            i -= 1
            c = self.code[i]
            if c == "}":
                opening = self.openings[i]
                if self.is_scope(opening):
                    return i + 1
                i = opening
            elif c == ";" or c == "{" and self.is_scope(i):
                return i + 1
            elif c == ":" and ACCESS.search(self.code[max(0, i - 20):i]):
                return i + 1
        return 0

    def is_scope(self, brace):
        """Whether the opening brace at a position begins a scope, not a value."""
        head = re.split(r"[;{}]", self.code[:brace])[-1]
        return bool(SCOPE.search(head) or not re.search(r"[\w>=(,]\s*$", head))

    def comment(self, first, last, name):
        """(the comment on some lines, also where it goes on below; that on the lines above, with the
        same indentation). From the comment of a function only that of its parameter `name`."""
        begin, end = first, last + 1
        while self.has_only_comment(begin - 1) and self.starts[begin - 2] == self.starts[first - 1]:
            begin -= 1
        while self.has_only_comment(end) and self.starts[end - 1] > self.starts[last - 1]:
            end += 1
        above = self.comment_on(range(begin, first))
        parameter = re.search(rf"@param {name or '-'}\b\s*([^@]*)", above)
        return self.comment_on(range(first, end)), parameter[1] if parameter else above

    def comment_on(self, lines):
        return " ".join(self.comments[line] for line in lines if self.comments[line])

    def has_only_comment(self, line):
        return line in self.comments and not self.lines[line - 1].strip()


def openings(code):
    """The position of the opening brace of each closing one."""
    stack, opening_of = [], {}
    for brace in re.finditer(r"[{}]", code):
        if brace[0] == "{":
            stack.append(brace.start())
        elif stack:
            opening_of[brace.start()] = stack.pop()
    return opening_of


def is_plain(value):
    return not value.lower().startswith("0x") and float(value.replace("'", "")) in PLAIN


def kind_of(comment):
    """(kind, the clause of the comment that determines it), both empty if none does."""
    for kind, pattern in KINDS.items():
        for clause in CLAUSE_END.split(comment):
            if re.search(pattern, clause):
                return kind, clause.strip().rstrip(".")
    return "", ""


def constants(include):
    """The constants of all headers of FOLDERS under a folder."""
    for folder in FOLDERS:
        place = include / folder
        for header in sorted(place.rglob("*.hpp")) if place.is_dir() else [place] * place.exists():
            name = header.relative_to(include).as_posix()
            if name not in OTHER:
                yield from Header(name, header.read_text(encoding="utf-8")).constants()


def print_table(rows):
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    for row in rows:
        print("  ".join(f"{cell:{width}}" for cell, width in zip(row, widths)).rstrip())


def main():
    parser = argparse.ArgumentParser(description="Lists numbers with their names, units and sources.")
    parser.add_argument("--include", type=pathlib.Path, default=INCLUDE_DIR)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()

    found = list(constants(options.include))
    complete = [c for c in found if c.kind and c.name]
    problems = [c.problem() for c in found if not (c.kind and c.name)]
    chosen = {(c.path, c.declared, c.name) for c in complete if c.kind == "chosen" and not is_plain(c.value)}
    if len(chosen) > MAX_CHOSEN:
        problems.append(f"{len(chosen)} constants are chosen, at most {MAX_CHOSEN}")
    if options.json:
        print(json.dumps([dataclasses.asdict(c) for c in complete], indent=1, ensure_ascii=False))
        return 1 if problems else 0

    order = list(KINDS)
    print_table([("kind", "name", "value", "unit", "source", "place"),
                 *((c.kind, c.name, c.value, c.unit or "1", c.source[:60], c.place)
                   for c in sorted(complete, key=lambda c: (order.index(c.kind), c.path, c.line)))])
    print()
    for line in problems:
        print(line)
    of_kind = collections.Counter(c.kind for c in complete)
    print(f"{len(found)} numbers: " + ", ".join(f"{of_kind[kind]} {kind}" for kind in order)
          + f"; {len(chosen)} constants chosen, {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
