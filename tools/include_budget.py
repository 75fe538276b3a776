#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Holds <gnomon/gnomon.hpp> to its budget: to read a file that includes it, a compiler may need at
most LIMIT times what it needs for one that includes only what we build upon, Eigen and nanoflann.

    include_budget.py COMPILER [OPTION...]

The options must make the compiler stop after its front end (-fsyntax-only). What is counted are its
instructions, under valgrind: unlike seconds, they are the same on a busy machine.
"""

import pathlib
import sys
import tempfile

from instructions import hold, instructions, require_valgrind

LIMIT = 1.7
SOURCES = {
    "Eigen and nanoflann":
        "#include <Eigen/Core>\n#include <Eigen/Geometry>\n#include <nanoflann.hpp>\n",
    "gnomon": "#include <gnomon/gnomon.hpp>\n",
}


def main():
    command = sys.argv[1:]
    if not command:
        sys.exit(__doc__)
    require_valgrind("include budget")
    needed = {}
    with tempfile.TemporaryDirectory() as folder:
        for name, text in SOURCES.items():
            source = pathlib.Path(folder, "budget.cpp")
            source.write_text(text, encoding="utf-8")
            needed[name] = instructions([*command, str(source)])
    hold(needed, LIMIT)


main()
