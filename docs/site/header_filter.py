#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Copies the headers of a folder as doxygen is to read them:

    header_filter.py FOLDER COPY

- Deduction guides are left out: they have the name of their class. So are overloads that refuse a call,
  by their comment, which exist for their messages.
- What follows `Complexity:` is a paragraph of its own, also after a `@throws`.
- `explicit(...)` is `explicit`, as doxygen 1.9.4 takes the parentheses for a function's.
- `double u = 0.0, v = 0.0;  ///< text` is one declaration with the text for each name.
- Members without a comment that mean the same everywhere get the text of members.txt.

Lines keep their numbers.
"""

import pathlib
import re
import sys

from reference import blank, code_only, end_of_bracket

GUIDE = re.compile(r"^(?:template <[^\n]*>\n(?:    requires[^\n]*\n)?)?(\w+)\([^;{}]*\)\s*->\s*\1\b[^;]*;",
                   re.M)


SEVERAL = re.compile(r"^(?P<indent> +)(?P<before>/\*\* .*? \*/ )?(?P<type>[\w:]+) "
                     r"(?P<names>\w+ = [^,;{}()]+(?:, \w+ = [^,;{}()]+)+);(?:\s*///<(?P<after>.*))?$")


def rules(folder):
    """(expression, text) of the rules that apply to headers of a floor."""
    for line in pathlib.Path(__file__).with_name("members.txt").read_text(encoding="utf-8").splitlines():
        if line and not line.startswith("#"):
            expression, text, folders = (part.strip() for part in re.split(r"\s\|(?:\s|$)", line))
            if not folders or folder in folders.split():
                yield re.compile(rf"(?:{expression})$"), text


def with_comments(text, folder):
    """The header, with comments for members that have none."""
    lines, known = text.split("\n"), list(rules(folder))
    for i, line in enumerate(lines):
        if not line.startswith("    ") or "///<" in line:
            continue
        declaration = line.strip()
        comment = next((text for expression, text in known if expression.match(declaration)), None)
        if comment is None:
            continue
        first = i
        while re.match(r"\s*(template\b|requires\b|\[\[nodiscard\]\]$)", lines[first - 1]):
            first -= 1
        if lines[first - 1].lstrip().startswith("///"):
            continue
        indent = len(lines[first]) - len(lines[first].lstrip())
        if indent <= 8:
            lines[first] = f"{' ' * indent}/** {comment} */ {lines[first].lstrip()}"
    return "\n".join(lines)


def without_refusals(text):
    """The header without functions whose comment begins with "Refused"."""
    for refusal in reversed(list(re.finditer(r"^ *(/// Refused.*\n)( *///.*\n)*", text, re.M))):
        code, end = code_only(text), refusal.end()
        while code[end] not in "{;":
            end = end_of_bracket(code, end) if code[end] in "([" else end + 1
        end = end_of_bracket(code, end) if code[end] == "{" else end + 1
        text = text[:refusal.start()] + blank(text[refusal.start():end]) + text[end:]
    return text


def one_by_one(text):
    """The header, with a declaration for each name, on the same line."""
    lines = text.split("\n")
    for i, line in enumerate(lines):
        several = SEVERAL.match(line)
        if not several:
            continue
        comment = several["after"] or (several["before"] or "")[3:-3].strip()
        if not comment:
            above = i
            while lines[above - 1].lstrip().startswith("/// "):
                above -= 1
            comment = " ".join(line.strip()[4:] for line in lines[above:i])
            lines[above:i] = [""] * (i - above)
        if comment:
            lines[i] = several["indent"] + " ".join(
                f"/** {comment.strip()} */ {several['type']} {name};" for name in several["names"].split(", "))
    return "\n".join(lines)


def main():
    folder, copy = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    for path in sorted(folder.rglob("*.hpp")):
        if "detail" in path.parts:
            continue
        text = path.read_text(encoding="utf-8")
        text = without_refusals(text)
        text = GUIDE.sub(lambda guide: "\n" * guide[0].count("\n"), text)
        text = re.sub(r"\bexplicit\([^()]*\)", "explicit", text)
        text = re.sub(r"^( *///) Complexity: ", r"\1 @complexity ", text, flags=re.M)
        target = copy / path.relative_to(folder)
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(one_by_one(with_comments(text, path.parent.name)), encoding="utf-8")


main()
