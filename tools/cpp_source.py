# SPDX-License-Identifier: BSL-1.0
"""Reading of C++ sources for the style checks: code, comments, functions, and names by ctags."""

import dataclasses
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
INCLUDE_DIR = ROOT / "include"

# Comments, and literals, within which a comment does not begin.
TOKEN = re.compile(
    r"(?P<comment>//[^\n]*|/\*.*?\*/)"
    r'|R"(?P<delimiter>[^\s()\\]{0,16})\(.*?\)(?P=delimiter)"'
    r'|(?P<literal>"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])+\')',
    re.S)

# What ctags calls the kinds of names that a namespace can hold.
KINDS = {"class", "struct", "union", "enum", "typedef", "function", "prototype", "variable",
         "externvar", "name"}
TYPES = {"class", "struct", "union", "enum", "typedef", "concept"}


@dataclasses.dataclass(frozen=True)
class Name:
    name: str
    kind: str
    header: str
    line: int


def blank(text):
    """Spaces instead of everything but line ends: positions and line numbers stay."""
    return re.sub(r"[^\n]", " ", text)


def code_only(text):
    """C++ without comments and without the contents of literals, line by line in its place."""
    def replace(token):
        if token["comment"] is not None:
            return blank(token[0])
        return '"' + blank(token[0][1:-1]) + '"'
    return TOKEN.sub(replace, text)


def comments(text):
    """(line, text) of each line of each comment, without the slashes and stars."""
    for token in TOKEN.finditer(text):
        if token["comment"] is None:
            continue
        first = text.count("\n", 0, token.start()) + 1
        for i, line in enumerate(token[0].split("\n")):
            yield first + i, re.sub(r"^\s*(?://[/!]?<?|/\*+|\*(?!/))|\*/\s*$", "", line).strip()


def end_of_bracket(code, start):
    """The position after the bracket that closes the one at `start`."""
    pairs = {"(": ")", "{": "}", "[": "]"}
    opening, closing = code[start], pairs[code[start]]
    depth = 0
    for i in range(start, len(code)):
        if code[i] == opening:
            depth += 1
        elif code[i] == closing:
            depth -= 1
            if depth == 0:
                return i + 1
    return len(code)


def end_of_template_arguments(code, start):
    """The position after the `>` that closes the `<` at `start`."""
    depth, i = 0, start
    while i < len(code):
        if code[i] in "({[":
            i = end_of_bracket(code, i)
            continue
        if code[i] == "<":
            depth += 1
        elif code[i] == ">":
            depth -= 1
            if depth == 0:
                return i + 1
        i += 1
    return len(code)


def end_of_requires_clause(code, start):
    """The position after the constraint that follows the word `requires`, which ends at `start`.

    A constraint is a chain of primary expressions joined by && and ||, each of which is something
    in parentheses, a requires expression, or a name with template arguments.
    """
    i = start
    while True:
        i += len(code[i:]) - len(code[i:].lstrip())
        expression = re.compile(r"requires\b\s*").match(code, i)
        if expression:
            i = expression.end()
            if code[i] == "(":
                i = end_of_bracket(code, i)
                i += len(code[i:]) - len(code[i:].lstrip())
            i = end_of_bracket(code, i)
        elif code[i] == "(":
            i = end_of_bracket(code, i)
        else:
            name = re.compile(r"!?\s*[\w:]+\s*").match(code, i)
            if not name:
                return i
            i = name.end()
            while i < len(code) and code[i] in "<:":
                if code[i] == "<":
                    i = end_of_template_arguments(code, i)
                else:
                    i = re.compile(r"::\s*\w+\s*").match(code, i).end()
                i += len(re.compile(r" *").match(code, i)[0])
        joint = re.compile(r"\s*(&&|\|\|)").match(code, i)
        if not joint:
            return i
        i = joint.end()


def end_of_statement(code, start):
    """The position after the next semicolon outside brackets."""
    i = start
    while i < len(code) and code[i] != ";":
        i = end_of_bracket(code, i) if code[i] in "({[" else i + 1
    return i + 1


def without_requirements(code):
    """The code with spaces instead of concepts and requires clauses."""
    concept = re.compile(r"\bconcept\s+\w+\s*=")
    clause = re.compile(r"(?<=[>)\w])(\s+)requires\b(?!\s*\{)")
    i = 0
    while found := concept.search(code, i):
        i = end_of_statement(code, found.end())
        code = code[:found.start()] + blank(code[found.start():i - 1]) + code[i - 1:]
    i = 0
    while found := clause.search(code, i):
        i = end_of_requires_clause(code, found.end())
        code = code[:found.end(1)] + blank(code[found.end(1):i]) + code[i:]
    return code


def require_ctags():
    """Leaves with 77, which ctest counts as skipped, where Universal Ctags is missing."""
    if shutil.which("ctags"):
        version = subprocess.run(["ctags", "--version"], capture_output=True, text=True, check=False)
        if "Universal Ctags" in version.stdout:
            return
    print("universal-ctags is missing")
    sys.exit(77)


def tags(include_dir, kinds="+pxN"):
    """What ctags finds in the C++ sources under a folder: a list of dictionaries, with paths relative
    to the folder. Ctags reads copies without comments and requires clauses."""
    include_dir = pathlib.Path(include_dir)
    with tempfile.TemporaryDirectory() as copy:
        for header in include_dir.rglob("*.[ch]pp"):
            target = pathlib.Path(copy) / header.relative_to(include_dir)
            target.parent.mkdir(parents=True, exist_ok=True)
            code = code_only(header.read_text(encoding="utf-8"))
            target.write_text(without_requirements(code), encoding="utf-8")
        found = subprocess.run(
            ["ctags", "--options=NONE", "-R", "--languages=C++", "--langmap=C++:.hpp.cpp",
             f"--kinds-C++={kinds}", "--fields=+Kne", "--output-format=json", "-f", "-", "."],
            cwd=copy, capture_output=True, text=True, check=True)
    return [json.loads(line) | {"path": json.loads(line)["path"].removeprefix("./")}
            for line in found.stdout.splitlines()]


def concepts(include_dir, spaces=("gnomon",)):
    """The concepts that the headers under a folder define in certain namespaces, without those under
    detail/, as a list of Names."""
    found = []
    for header in sorted(pathlib.Path(include_dir).rglob("*.hpp")):
        path = header.relative_to(include_dir).as_posix()
        code = code_only(header.read_text(encoding="utf-8"))
        for concept in re.finditer(r"\bconcept\s+(\w+)\s*=", code):
            if namespace_at(code, concept.start()) in spaces:
                found.append(Name(concept[1], "concept", path, code.count("\n", 0, concept.start()) + 1))
    return [name for name in found if not is_private(name.header)]


def namespace_at(code, position):
    """The namespace in which a position of a code without comments is."""
    scopes, stack = re.compile(r"\bnamespace\s+([\w:]+)\s*\{|([{}])"), []
    for brace in scopes.finditer(code, 0, position):
        if brace[1]:
            stack.append(brace[1])
        elif brace[2] == "{":
            stack.append("")
        elif stack:
            stack.pop()
    return "::".join(name for name in stack if name)


def is_private(path):
    return "/detail/" in path or "/adapters/" in path


def is_friend(include_dir, tag):
    """Whether a function is declared as a friend of a class: only its arguments' types find it."""
    lines = pathlib.Path(include_dir, tag["path"]).read_text(encoding="utf-8").splitlines()
    return bool(re.search(r"\bfriend\b", lines[tag["line"] - 1]))


def public_names(include_dir=INCLUDE_DIR):
    """The public names of namespace gnomon by name, as in public_names.py."""
    found = {}
    for tag in tags(include_dir):
        name = tag["name"]
        if tag.get("scope") != "gnomon" or tag["kind"] not in KINDS or is_private(tag["path"]):
            continue
        if name.startswith(("operator", "__anon")) or is_friend(include_dir, tag):
            continue
        here = Name(name, tag["kind"], tag["path"], tag["line"])
        known = found.get(name)
        # The class rather than its deduction guides.
        if known is None or (known.kind not in TYPES and here.kind in TYPES):
            found[name] = here
    found.update((concept.name, concept) for concept in concepts(include_dir))
    return found


def without_directives(code):
    """The code with spaces instead of preprocessor directives."""
    return re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", lambda line: blank(line[0]), code, flags=re.M)


SCOPE = re.compile(r"\b(?:namespace|class|struct|union)\b|^\s*extern\s*\"")
INITIALIZERS = re.compile(r"\)\s*(?:noexcept\s*(?:\(\))?\s*)?:(?!:)")


def function_bodies(code):
    """(name, position of the opening brace, position after the closing one) of each function that
    is defined in a namespace or class: constructors, operators and templates like the others, and
    variables that a lambda initializes. What is inside a body belongs to it.

    The code is without comments, requirements and directives.
    """
    head, i = "", 0  # the statement so far, what is in its brackets left out
    while i < len(code):
        c = code[i]
        if c == "}" or c == ";":
            head, i = "", i + 1
        elif c in "([":
            end = end_of_bracket(code, i)
            brackets = "" if re.search(r"\balignas\s*$", head) else c + {"(": ")", "[": "]"}[c]
            head, i = head + brackets, end
        elif c == "<" and head.rstrip().endswith("template"):
            i = end_of_template_arguments(code, i)
            head += "<>"
        elif c == "{":
            end = end_of_bracket(code, i)
            if re.search(r"\benum\b", head):
                i = end
            elif "()" in head and not re.search(r"\b(?:class|struct)\b[^()]*$", head):
                if INITIALIZERS.search(head) and re.search(r"[\w>]\s*$", head):
                    head, i = head + "{}", end  # a member that a constructor initializes
                    continue
                name = re.search(r"(operator\s*(?:\(\)|\[\]|[^\s(]+)|~?\w+)\s*(?:<>)?\s*\(", head)
                yield name[1] if name else " ".join(head.split()), i, end
                head, i = "", end
            elif SCOPE.search(head):
                head, i = "", i + 1
            else:
                head, i = head + "{}", end  # a value
        else:
            head, i = head + c, i + 1


def functions_of(text):
    """(name, first line, last line) of the body of each function of a source."""
    code = without_directives(without_requirements(code_only(text)))
    for name, start, end in function_bodies(code):
        yield name, code.count("\n", 0, start) + 1, code.count("\n", 0, end) + 1
