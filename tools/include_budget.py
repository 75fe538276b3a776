#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Holds <gnomon/gnomon.hpp> to its budget: to read a file that includes it, a compiler may need at
most 1.7 times what it needs for one that includes only what we build upon, Eigen and nanoflann.

    include_budget.py COMPILER [OPTION...]

The options must make the compiler stop after its front end (-fsyntax-only). What is counted are its
instructions, under valgrind: unlike seconds, they are the same on a busy machine.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

LIMIT = 1.7
SOURCES = {
    "Eigen and nanoflann":
        "#include <Eigen/Core>\n#include <Eigen/Geometry>\n#include <nanoflann.hpp>\n",
    "gnomon": "#include <gnomon/gnomon.hpp>\n",
}
COUNTING = ["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null",
            "--trace-children=yes"]


def instructions(command):
    """How many a command takes, with the processes that it starts."""
    run = subprocess.run([*COUNTING, *command], stderr=subprocess.PIPE, text=True, check=False)
    counts = re.findall(r"I +refs: +([\d,]+)", run.stderr)
    if run.returncode != 0 or not counts:
        sys.exit(run.stderr)
    return sum(int(count.replace(",", "")) for count in counts)


def main():
    command = sys.argv[1:]
    if not command:
        sys.exit(__doc__)
    if not shutil.which(COUNTING[0]):
        print("include budget not checked: there is no valgrind here")
        sys.exit(77)
    needed = {}
    with tempfile.TemporaryDirectory() as folder:
        for name, text in SOURCES.items():
            source = pathlib.Path(folder, "budget.cpp")
            source.write_text(text, encoding="utf-8")
            needed[name] = instructions([*command, str(source)])

    theirs, ours = needed.values()
    for name, count in needed.items():
        print(f"{name:20} {count / 1e9:6.2f} billion instructions")
    print(f"{'ratio':20} {ours / theirs:6.2f}   (limit {LIMIT})")
    sys.exit(0 if ours <= LIMIT * theirs else 1)


main()
