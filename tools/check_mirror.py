#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Keeps include/ and tests/ one tree: include/gnomon/x/y.hpp has tests/x/y_test.cpp, and no test is
without its header. Umbrellas and headers under detail/ need no test of their own; tests
of the whole chain, in tests/scans/, have no header. Every source begins with its licence.
"""

import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
HEADERS = ROOT / "include/gnomon"
TESTS = ROOT / "tests"
CHAIN = TESTS / "scans"
SPDX = "// SPDX-License-Identifier: BSL-1.0\n"

problems = []

for header in sorted(HEADERS.glob("*/*.hpp")):
    name = header.relative_to(HEADERS)
    test = TESTS / name.with_name(name.stem + "_test.cpp")
    if not test.exists():
        problems.append(f"include/gnomon/{name} has no {test.relative_to(ROOT)}")

for test in sorted(set(TESTS.glob("*/*_test.cpp")) - set(CHAIN.glob("*"))):
    name = test.relative_to(TESTS)
    header = name.with_name(name.stem.removesuffix("_test") + ".hpp")
    homes = [HEADERS / header, HEADERS / header.parent / "detail" / header.name]
    if not any(home.exists() for home in homes):
        problems.append(f"tests/{name} has no include/gnomon/{header}")

for tree in ("include", "tests", "examples", "benchmarks"):
    for source in sorted((ROOT / tree).rglob("*.[ch]pp")):
        if not source.read_text(encoding="utf-8").startswith(SPDX):
            problems.append(f"{source.relative_to(ROOT)} does not begin with its SPDX line")

for line in problems:
    print(line)
print(f"{len(problems)} problems")
sys.exit(1 if problems else 0)
