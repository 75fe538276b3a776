#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Counts the public names of namespace gnomon and refuses more than LIMIT of those of gnomon.hpp, or
more than LIMIT_BY_NAME of the headers that are included by name.

A public name is a type, an alias, a function or a variable of namespace gnomon in a header outside
detail/ and adapters/. Nested namespaces (simulation, io, detail) are not counted. Each name counts
once: overloads, specializations and forward declarations are one name. Members, friends, enumerators,
operators, parameters, macros and deduction guides (they have the name of their class) do not count.

Universal Ctags lists the names. Its version 5.9 does not know the concepts of C++20: these are
found by the regular expression `concept NAME =` and reported in addition to the sum, as each has a page
(check_concepts.py). Ctags also takes names within concepts and requires clauses for declarations:
these are removed from the text that ctags reads.

    public_names.py              the number of names of each header, and their sum
    public_names.py --list       the names too

Exit status: 0, 1 above LIMIT, 77 without ctags.
"""

import argparse
import collections
import pathlib
import re
import sys

from cpp_source import INCLUDE_DIR, public_names, require_ctags

LIMIT = 160
LIMIT_BY_NAME = 60
INCLUDE = re.compile(r"^\s*#\s*include\s*<(gnomon/[^>]+)>", re.M)


def included(include_dir, header="gnomon/gnomon.hpp", known=None):
    """The headers that one includes, with itself; none if there is no such file."""
    known = set() if known is None else known
    path = pathlib.Path(include_dir) / header
    if header not in known and path.exists():
        known.add(header)
        for other in INCLUDE.findall(path.read_text(encoding="utf-8")):
            included(include_dir, other, known)
    return known


def main():
    parser = argparse.ArgumentParser(description="Counts the public names of namespace gnomon.")
    parser.add_argument("--list", action="store_true", help="print the names too")
    parser.add_argument("--include", default=INCLUDE_DIR, help="the folder that holds gnomon/")
    options = parser.parse_args()
    require_ctags()

    by_header = collections.defaultdict(list)
    names = public_names(options.include)
    for name in names.values():
        by_header[name.header].append(name)
    for header, group in sorted(by_header.items()):
        print(f"{len(group):3} {header}")
        if options.list:
            for name in sorted(group, key=lambda n: n.name):
                print(f"        {name.name:32} {name.kind}")
    concepts = sum(1 for name in names.values() if name.kind == "concept")
    in_gnomon = included(options.include)
    by_name = sum(len([n for n in group if n.kind != "concept"])
                  for header, group in by_header.items() if in_gnomon and header not in in_gnomon)
    others = len(names) - concepts - by_name
    print(f"{others} public names in gnomon.hpp, at most {LIMIT}; {by_name} in headers included by name,"
          f" at most {LIMIT_BY_NAME}; and {concepts} concepts")
    return 1 if others > LIMIT or by_name > LIMIT_BY_NAME else 0


sys.exit(main())
