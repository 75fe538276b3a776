#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Checks that C++ in prose is C++ that compiles.

In README.md and docs/, each block fenced as cpp follows a line

    <!-- snippet: examples/quick_start.cpp [name] -->

and equals, less the common indent, what stands in that file between two lines `// [name]`.
With --write, the blocks are taken from the files again.
"""

import pathlib
import re
import sys
import textwrap

ROOT = pathlib.Path(__file__).resolve().parent.parent
BLOCK = re.compile(
    r"(?P<head>(?:^<!-- snippet: (?P<file>\S+) \[(?P<name>[^\]]+)\] -->\n)?^```cpp\n)"
    r"(?P<code>.*?)(?=^```$)",
    re.M | re.S)

problems = []


def snippet(file, name):
    """The lines between the markers `// [name]` in a file, or None."""
    path = ROOT / file
    if not path.is_file():
        return None
    marker = rf"^[ \t]*// \[{re.escape(name)}\]\n"
    parts = re.split(marker, path.read_text(encoding="utf-8"), flags=re.M)
    return textwrap.dedent(parts[1]) if len(parts) == 3 else None


def main():
    write = sys.argv[1:] == ["--write"]
    count = 0
    for page in [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]:
        if not page.exists():
            continue
        text = page.read_text(encoding="utf-8")

        def check(block):
            nonlocal count
            count += 1
            line = text.count("\n", 0, block.start()) + 1
            place = f"{page.relative_to(ROOT)}:{line}"
            if not block["file"]:
                problems.append(f"{place}: C++ without a line '<!-- snippet: FILE [NAME] -->'")
                return block[0]
            code = snippet(block["file"], block["name"])
            if code is None:
                problems.append(f"{place}: no pair of '// [{block['name']}]' in {block['file']}")
                return block[0]
            if code != block["code"] and not write:
                problems.append(f"{place}: differs from {block['file']}: run {sys.argv[0]} --write")
            return block["head"] + code

        renewed = BLOCK.sub(check, text)
        if write and renewed != text:
            page.write_text(renewed, encoding="utf-8")

    for line in problems:
        print(line)
    print(f"{count} snippets, {len(problems)} problems")
    sys.exit(1 if problems else 0)


main()
