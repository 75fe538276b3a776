#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Holds <gnomon/gnomon.hpp> to its budget: a file that includes it must compile in at most twice the
time of one that includes only what we build upon, Eigen and nanoflann.

    include_budget.py COMPILER [OPTION...]

The options must make the compiler stop after its front end (-fsyntax-only). The measure is user CPU
time, the least of several runs in turn.
"""

import pathlib
import resource
import subprocess
import sys
import tempfile

LIMIT = 2.0
RUNS = 20
SOURCES = {
    "Eigen and nanoflann":
        "#include <Eigen/Core>\n#include <Eigen/Geometry>\n#include <nanoflann.hpp>\n",
    "gnomon": "#include <gnomon/gnomon.hpp>\n",
}


def user_time(command):
    """The user CPU time of one run of `command` [s]."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run(command, check=True)
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def main():
    command = sys.argv[1:]
    if not command:
        sys.exit(__doc__)
    best = dict.fromkeys(SOURCES, float("inf"))
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(RUNS):
            for name, text in SOURCES.items():
                source = pathlib.Path(folder, "budget.cpp")
                source.write_text(text, encoding="utf-8")
                best[name] = min(best[name], user_time([*command, str(source)]))

    theirs, ours = best.values()
    for name, seconds in best.items():
        print(f"{name:20} {seconds:6.2f} s")
    print(f"{'ratio':20} {ours / theirs:6.2f}   (limit {LIMIT})")
    sys.exit(0 if ours <= LIMIT * theirs else 1)


main()
