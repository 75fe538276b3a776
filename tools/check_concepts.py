#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Checks that every public concept has its page, and that docs/terms.md has every public type.

A public concept is one of namespace gnomon, gnomon::recognition, gnomon::simulation or gnomon::io, in a header
outside detail/. A page docs/concepts/*.md may hold several concepts; each begins with a heading

    # `name`        or        ## `name`

and up to the next such heading has these five sections, in this order, as headings of a lower rank
or as bold leads of a paragraph ("**Laws.** ..."), none of them empty:

    Intuition, Minimal complete definition, Laws, Models, What the compiler says

A heading of this kind for a name that is no public concept is refused. docs/terms.md names every
public type of namespace gnomon (struct, class, enum, alias and concept) in `backticks`; more may
stand there.

Exit status: 0, 1 with problems, 77 without ctags.
"""

import argparse
import pathlib
import re
import sys

from cpp_source import ROOT, TYPES, concepts, public_names, require_ctags

SPACES = ("gnomon", "gnomon::recognition", "gnomon::simulation", "gnomon::io")
SECTIONS = ["Intuition", "Minimal complete definition", "Laws", "Models", "What the compiler says"]
HEADING = re.compile(r"^(?P<rank>#{1,2}) `(?P<name>\w+)`[ \t]*$", re.M)
SECTION = re.compile(rf"^(?:#{{2,5}} (?P<heading>{'|'.join(SECTIONS)})[ \t]*$"
                     rf"|\*\*(?P<lead>{'|'.join(SECTIONS)})[.:]?\*\*[.:]?)", re.M)


def parts(text):
    """(name, position, text) of the concepts of a page."""
    headings = list(HEADING.finditer(text))
    for heading, following in zip(headings, [*headings[1:], None]):
        end = following.start() if following else len(text)
        yield heading["name"], heading.start(), text[heading.end():end]


def section_problems(text):
    """What is wrong with the sections of one concept."""
    sections = list(SECTION.finditer(text))
    names = [section["heading"] or section["lead"] for section in sections]
    for missing in (name for name in SECTIONS if name not in names):
        yield f"has no section '{missing}'"
    if names != [name for name in SECTIONS if name in names]:
        yield f"has its sections in the order {', '.join(names)}"
    ends = [section.start() for section in sections[1:]] + [len(text)]
    for name, section, end in zip(names, sections, ends):
        if not text[section.end():end].strip():
            yield f"has nothing under '{name}'"


def page_problems(root, known):
    """What is wrong with the pages of the concepts of these names."""
    described = {}
    for page in sorted((root / "docs/concepts").glob("*.md")):
        path, text = page.relative_to(root), page.read_text(encoding="utf-8")
        for name, position, part in parts(text):
            place = f"{path}:{text.count(chr(10), 0, position) + 1}: `{name}`"
            if name not in known:
                yield f"{place} is no public concept"
            elif name in described:
                yield f"{place} is in {described[name]} too"
            described.setdefault(name, path)
            for problem in section_problems(part):
                yield f"{place} {problem}"
    for name, concept in sorted(known.items()):
        if name not in described:
            yield f"include/{concept.header}:{concept.line}: concept {name} has no page in docs/concepts/"


def term_problems(root):
    """The public types that docs/terms.md does not name."""
    page = root / "docs/terms.md"
    if not page.exists():
        yield "docs/terms.md is missing"
        return
    text = page.read_text(encoding="utf-8")
    named = {name for code in re.findall(r"`([^`]+)`", text) for name in re.findall(r"\w+", code)}
    for name in sorted(public_names(root / "include").values(), key=lambda name: name.name):
        if name.kind in TYPES and name.name not in named:
            yield f"docs/terms.md does not name `{name.name}` of include/{name.header}"


def main():
    parser = argparse.ArgumentParser(description="Checks the pages of concepts and the glossary.")
    parser.add_argument("--root", type=pathlib.Path, default=ROOT)
    options = parser.parse_args()
    require_ctags()

    known = {concept.name: concept for concept in concepts(options.root / "include", SPACES)}
    problems = [*page_problems(options.root, known), *term_problems(options.root)]
    for line in problems:
        print(line)
    print(f"{len(known)} concepts, {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
