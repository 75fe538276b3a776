# SPDX-License-Identifier: BSL-1.0
"""The prose of the repository, line by line: comments of sources, Markdown outside code blocks, and
the sentences in the scripts that write pages. Used by check_words.py and check_references.py.

Not prose, because a tool writes it: single_include/, and docs/results/, whose sentences are those
of the scripts in benchmarks/.
"""

import dataclasses
import io
import re
import tokenize

from cpp_source import TOKEN, comments

# What is read, relative to the root of the repository.
PAGES = ["README.md", "CHANGELOG.md", "docs/**/*.md"]
GENERATED_PAGES = "docs/results/"
WITH_MESSAGES = ("include/", "examples/", "benchmarks/")
CPP = [f"{tree}/**/*.[ch]pp" for tree in ("include", "tests", "examples", "benchmarks")]
PYTHON = [f"{tree}/**/*.py" for tree in ("tests", "examples", "benchmarks", "tools", "packaging",
                                           "docs")]
SHELL = [f"{tree}/**/{name}" for tree in ("tests", "examples", "benchmarks", "cmake", "tools",
                                                  "packaging", "docs")
         for name in ("*.sh", "*.cmake", "CMakeLists.txt")]

# In a source, a comment with one of these words alone is for tools: "// namespace gnomon", markers
# of snippets, formatter switches, licences.
FOR_TOOLS = re.compile(r"(namespace [\w:]+|\[\w+\]|clang-format (on|off)|NOLINT.*"
                       r"|SPDX-License-Identifier: .*|shellcheck .*|!/.*)$")


@dataclasses.dataclass(frozen=True)
class Line:
    path: str    # relative to the root
    number: int
    text: str
    kind: str    # "page", "comment" or "message"


def cpp_lines(text):
    """(number, text, kind) of comments, and of string literals that are sentences."""
    lines = [(number, line, "comment") for number, line in comments(text)]
    for token in TOKEN.finditer(text):
        if token["literal"] and len(token["literal"].split()) > 2:
            lines.append((text.count("\n", 0, token.start()) + 1, token["literal"][1:-1], "message"))
    return sorted(lines)


def page_lines(text):
    """(number, text, kind) of the lines of a Markdown page, without blocks of code and comments."""
    hidden = re.compile(r"^(?:```.*?^```|(?: {4,}|\t)\S[^\n]*|<!--.*?-->)$", re.M | re.S)
    shown = hidden.sub(lambda block: re.sub(r"[^\n]", "", block[0]), text)
    for number, line in enumerate(shown.split("\n"), 1):
        yield number, line, "page"


def python_lines(text):
    """(number, text, kind) of comments and docstrings, and of strings that hold a space."""
    strings = {tokenize.STRING, getattr(tokenize, "FSTRING_MIDDLE", tokenize.STRING)}
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT:
            yield token.start[0], token.string.lstrip("#! "), "comment"
        elif token.type in strings and " " in token.string.strip():
            kind = "comment" if token.string.startswith('"""') else "message"
            for i, line in enumerate(token.string.split("\n")):
                yield token.start[0] + i, line.strip(), kind


def shell_lines(text):
    """(number, text, kind) of the comments of a shell or CMake script."""
    for number, line in enumerate(text.split("\n"), 1):
        comment = re.search(r"(?:^|\s)#(.*)$", line)
        if comment:
            yield number, comment[1].strip(), "comment"


def prose(root):
    """All Lines of prose under the root of the repository, in the order of files and lines."""
    for patterns, lines_of in ((PAGES, page_lines), (CPP, cpp_lines), (PYTHON, python_lines),
                               (SHELL, shell_lines)):
        for file in sorted({file for pattern in patterns for file in root.glob(pattern)}):
            path = file.relative_to(root).as_posix()
            if path.startswith(GENERATED_PAGES):
                continue
            for number, text, kind in lines_of(file.read_text(encoding="utf-8")):
                if kind == "message" and not path.startswith(WITH_MESSAGES):
                    continue
                if text.strip() and not FOR_TOOLS.match(text.strip()):
                    yield Line(path, number, text, kind)


def paragraphs(lines):
    """(path, kind, text, number of the line at each position) of Lines that follow one another."""
    path, kind, text, numbers = None, None, "", []
    for line in lines:
        follows = (line.path, line.kind) == (path, kind) and line.number <= numbers[-1] + 1
        if not follows:
            if text:
                yield path, kind, text, numbers
            path, kind, text, numbers = line.path, line.kind, "", []
        text += line.text + "\n"
        numbers += [line.number] * (len(line.text) + 1)
    if text:
        yield path, kind, text, numbers
