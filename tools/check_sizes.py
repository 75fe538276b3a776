#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Refuses functions of more than 50 lines and headers of more than 250 lines in include/.

A function counts from the line of its opening brace to the line of its closing brace; a lambda
counts to the function that contains it. Constructors, operators, templates and members are
functions. Bodies are found by matching brackets, after comments, literals, requires clauses and
preprocessor directives are removed.

    check_sizes.py [--include DIR] [--longest N]

--longest N prints the N longest functions and headers as well. Exit status: 0, or 1 with problems.
"""

import argparse
import pathlib
import sys

from cpp_source import INCLUDE_DIR, functions_of

MAX_FUNCTION = 50
MAX_HEADER = 250


def main():
    parser = argparse.ArgumentParser(description="Checks the sizes of functions and headers.")
    parser.add_argument("--include", type=pathlib.Path, default=INCLUDE_DIR)
    parser.add_argument("--longest", type=int, default=0)
    options = parser.parse_args()

    headers, functions = [], []  # (lines, what, where)
    for header in sorted(options.include.rglob("*.hpp")):
        text = header.read_text(encoding="utf-8")
        path = f"include/{header.relative_to(options.include).as_posix()}"
        headers.append((len(text.splitlines()), "the header", path))
        for name, first, last in functions_of(text):
            functions.append((last - first + 1, f"'{name}'", f"{path}:{first}"))

    for sizes in (functions, headers):
        for lines, what, where in sorted(sizes, reverse=True)[:options.longest]:
            print(f"{lines:4} lines: {where}: {what}")
    problems = [f"{where}: {what} has {lines} lines, at most {limit}"
                for sizes, limit in ((functions, MAX_FUNCTION), (headers, MAX_HEADER))
                for lines, what, where in sizes if lines > limit]
    for line in problems:
        print(line)
    print(f"{len(functions)} functions in {len(headers)} headers, {len(problems)} problems")
    return 1 if problems else 0


sys.exit(main())
