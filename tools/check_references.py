#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Checks that what comments and documents refer to exists.

- Names in `backticks` are declared in this repository (types, functions, members, enumerators,
  parameters, macros, as ctags lists them, and words of CMake files), stand in the source file that
  the comment is in, or are in FOREIGN. Of a qualified name of another library nothing is checked.
  In docs/terms.md, which translates our names, only the first column of tables is checked; in
  CHANGELOG.md the first column has names of earlier versions and is not checked.
- Files and folders that are named, in backticks or not, exist: from the root, from include/, or as
  the end of a path ("detail/lanes.hpp"). Options of programs (`--merge`) occur in a source.
- Links in Markdown lead to files, and to headings that are there.
- Numbers of equations, sections, figures, tables and algorithms are in thesis_numbers.txt.
- No document is cited that is not in the repository: "specification", "A12", "../shared". Numbers
  of headings of docs/thesis-notes.md can be cited, as in "docs/thesis-notes.md, A34".

    check_references.py [FOLDER...]      complaints, only about the given folders or files

Exit status: 0, 1 with problems, 77 without ctags.
"""

import argparse
import collections
import fnmatch
import functools
import pathlib
import re
import sys

from cpp_source import ROOT, TOKEN, blank, code_only, require_ctags, tags
from prose import paragraphs, prose

NUMBERS = pathlib.Path(__file__).with_name("thesis_numbers.txt")

# Names that are not ours: the language's, the standard library's without std::, other libraries'.
FOREIGN = set("""
    alignas auto bool char class concept const constexpr double else enum explicit false float for if
    inline int namespace noexcept operator private public requires return short signed static
    static_assert std struct template this true typename unsigned using void while
    errno float32 float64 int32 uint8 uint32 int32_t malloc NaN size_t uint32_t
    Eigen Vector3d Vector3f Vector4f Matrix3d KdBVH Map
    nanoflann boost pcl CGAL open3d Embree Assimp
    x y z NAME VALUE NDEBUG UTM
""".split())
# Namespaces of others.
FOREIGN_SPACES = ("std", "Eigen", "boost", "nanoflann", "pcl", "CGAL", "open3d", "o3d", "testing")
# Stand for a name: options here, in paths all words in capitals but those of README.md and the like.
PLACEHOLDERS = ("--name", "--name=VALUE")
CAPITALS = re.compile(r"(?<![A-Za-z])(?!README|CHANGELOG|LICENSE|CITATION)[A-Z]{2,}(?![A-Za-z])")
# Programs with which commands begin; those of others have options that are not ours.
FOREIGN_COMMANDS = ("cmake", "ctest", "g++", "git", "valgrind", "apt-get", "perf", "vcpkg", "conan")
COMMANDS = ("sh", "python3", *FOREIGN_COMMANDS)

FILE = re.compile(r"(?<![\w./:<-])(?:[\w*.-]+/)*[\w*-]+\.(?:hpp|cpp|py|sh|md|cmake|txt|json|cff)(?![\w/])")
FOLDER = re.compile(r"(?<![\w./-])(?:include|tests|examples|benchmarks|docs|tools|cmake|packaging)/(?:[\w-]+/)*")
NUMBERED = {"Eq": "Eqs?|Equations?", "Sec": "Secs?|Sections?|Apps?|Appendix|Chapters?",
            "Fig": "Figs?|Figures?", "Table": "Tabs?|Tables?", "Alg": "Algs?|Algorithms?"}
NUMBER = r"\(?((?:[1-9]|A(?=\.))(?:\.\d+)*)\)?(?:\s+\([a-f]\))?"
NUMBER_LIST = rf"{NUMBER}(?:(?:\s*(?:,|-|–|and|to|or)\s*)+{NUMBER})*"
ABSENT = re.compile(r"\b(?i:specification) of (?:it|the thesis|Klasing)|\bspecification(?=,? [AF]\d)"
                    r"|\b[AF]\d{2}\b|\bA\d\b(?=[:)])|\.\./shared\b|(?<![\w/])shared/design\b")


class References:
    """What there is to refer to, in the repository at `root`."""

    def __init__(self, root):
        self.root = root
        self.files = [file.relative_to(root).as_posix() for file in sorted(root.rglob("*"))
                      if file.is_file() and not self.is_hidden(file)]
        self.folders = {parent.as_posix() + "/" for file in self.files
                        for parent in pathlib.PurePosixPath(file).parents}
        self.names = {tag["name"] for tree in ("include", "examples", "tests", "benchmarks")
                      for tag in tags(root / tree, "+pxNzZ")}
        self.names |= {pathlib.PurePosixPath(file).stem for file in self.files
                       if file.endswith((".cpp", ".py", ".sh"))}
        code = []
        for file in self.files:
            if file.endswith((".cmake", "CMakeLists.txt")):
                self.names |= set(re.findall(r"\w+", self.text(file)))
            if file.endswith((".hpp", ".cpp")):
                source = code_only(self.text(file))
                self.names |= set(re.findall(r"\bGNOMON_\w+|(?<=\bconcept )\w+", source))
            if file.endswith((".hpp", ".cpp", ".py", ".sh", ".cmake", "CMakeLists.txt")):
                code.append(self.without_comments(file))
        self.code = "\n".join(code)
        self.numbers, self.others = read_numbers(NUMBERS.read_text(encoding="utf-8"))

    def has_note(self, before, number):
        """Whether text that ends in "docs/thesis-notes.md, " cites one of its headings by number."""
        page = "docs/thesis-notes.md"
        return (re.search(r"docs/thesis-notes\.md,\s+$", before) is not None and page in self.files
                and re.search(rf"(?m)^## {number}:", self.text(page)) is not None)

    def is_hidden(self, file):
        parts = file.relative_to(self.root).parts
        return parts[0] in ("build", "shared") or any(part in (".git", "__pycache__") for part in parts)

    @functools.cache
    def text(self, path):
        return (self.root / path).read_text(encoding="utf-8")

    def without_comments(self, path):
        text = self.text(path)
        if path.endswith((".hpp", ".cpp")):
            return TOKEN.sub(lambda token: " " if token["comment"] else token[0], text)
        return re.sub(r"(?m)(?:^|\s)#(?!include).*$", "", text)

    @functools.cache
    def words_of(self, path):
        """The words of a source outside its comments."""
        return set(re.findall(r"\w+", self.without_comments(path)))

    def has_file(self, name, page):
        """Whether a file or, if the name ends with a slash, a folder is there."""
        here = (pathlib.PurePosixPath(page).parent / name).as_posix()
        if name.endswith("/"):
            return name in self.folders or here + "/" in self.folders
        wanted = (name, "*/" + name, here)
        return any(fnmatch.fnmatchcase(file, pattern) for pattern in wanted for file in self.files)

    def is_written(self, name):
        """Whether a source contains the name of a file, an option or a package."""
        return re.search(rf"(?<![\w-]){re.escape(name)}(?![\w-])", self.code) is not None

    def has_heading(self, page, anchor):
        headings = re.findall(r"^#+ +(.*)$", self.text(page), re.M)
        return anchor in {re.sub(r"[^\w\- ]", "", heading).strip().lower().replace(" ", "-")
                          for heading in headings}


def read_numbers(text):
    """The numbers of the thesis by kind, and those of other works by kind and number."""
    numbers, others = collections.defaultdict(set), collections.defaultdict(set)
    for line in text.splitlines():
        parts = [part.strip() for part in line.split("|")]
        if line.startswith("#") or len(parts) < 2:
            continue
        if len(parts) == 2:
            numbers[parts[0]] |= set(parts[1].split())
        else:
            for number in parts[2].split():
                others[parts[1], number].add(parts[0])
    return numbers, others


def names_of(code):
    """The identifiers of a piece of C++, without literals and the names of other libraries."""
    code = re.sub(r'"[^"]*"|\'[^\']*\'', " ", code)
    code = re.sub(rf"\b(?:{'|'.join(FOREIGN_SPACES)})(?:::\w+)+", " ", code)
    code = re.sub(r"(?<![\w.])\d[\w.]*(?:[eE][+-]\d+)?", " ", code)
    return [name for name in re.findall(r"[A-Za-z_]\w*", code) if len(name) > 1]


def check_code(code, path, references):
    """What is wrong with a piece of code in backticks: a list of complaints."""
    words = code.split()
    if not words or re.fullmatch(r"\W*", code) or "..." in code and "/" in code:
        return []
    is_command = (words[0] in COMMANDS or words[0].startswith("-") and words[0] != "->"
                  or "/" in words[0] and len(words) > 1 or " --" in code)
    if is_command:
        if words[0] in FOREIGN_COMMANDS:
            return []
        return [f"no program has the option {word}" for word in words
                if re.match(r"--[a-z]", word) and word not in PLACEHOLDERS
                and not references.is_written(word.split("=")[0])]
    if re.fullmatch(r"<[\w/]+(\.\w+)?>", code):
        header = code.strip("<>")
        ours = header.startswith("gnomon/")
        return [f"there is no {code}"] if ours and not references.has_file(header, path) else []
    if len(words) == 1 and ("/" in code or re.search(r"\.[a-z]\w{1,4}$", code) and "(" not in code):
        if code.startswith("build/"):
            return [] if code.split("/")[-1] in references.names else [f"there is no program {code}"]
        if CAPITALS.search(code) or references.has_file(code, path) or references.is_written(code):
            return []
        if "/" in code or FILE.fullmatch(code):
            return [f"there is no file {code}"]
    if re.fullmatch(r"[A-Z]{3,}|[a-z0-9]+(-[a-z0-9]+)+", code):  # a keyword of files, a package
        return [] if references.is_written(code) else [f"no source mentions {code}"]
    known = references.names | FOREIGN
    if not path.endswith(".md"):
        known = known | references.words_of(path)
    return [f"there is no name '{name}'" for name in names_of(code) if name not in known]


def complaints_about(path, kind, text, references):
    """(position, complaint) of one paragraph."""
    shown = text
    if path == "docs/terms.md":  # of rows of tables the first column
        shown = re.sub(r"(?m)^(\|[^|\n]*\|)(.*)$", lambda row: row[1] + blank(row[2]), text)
    if path == "CHANGELOG.md":  # all but the first column, which has the former names
        shown = re.sub(r"(?m)^\|[^|\n]*\|", lambda column: blank(column[0]), text)
    if kind != "message":
        for code in re.finditer(r"(?<!`)`([^`]+)`(?!`)", shown):
            for complaint in check_code(code[1], path, references):
                yield code.start(), complaint
        plain = re.sub(r"`[^`]*`|\]\([^)]*\)|\w+://\S+", lambda code: blank(code[0]), shown)
        for name in [*FILE.finditer(plain), *FOLDER.finditer(plain)]:
            if not (CAPITALS.search(name[0]) or references.has_file(name[0], path)
                    or references.is_written(name[0])):
                yield name.start(), f"there is no {name[0]}"
    if kind == "page":
        yield from broken_links(path, text, references)
    yield from missing_numbers(text, references)
    for document in ABSENT.finditer(text):
        is_path = document[0].startswith("..")  # which messages may name, of data
        if references.has_note(text[:document.start()], document[0]):
            continue
        if kind != "message" if is_path else path != "docs/thesis-notes.md":
            yield document.start(), f"'{document[0]}' is not in the repository"


def broken_links(path, text, references):
    for link in re.finditer(r"\]\(([^)#\s]*)(?:#([^)\s]+))?\)", text):
        if re.match(r"\w+:", link[1]):
            continue
        target = (references.root / path).parent / link[1] if link[1] else references.root / path
        if not target.exists():
            yield link.start(), f"the link leads to no file: {link[1]}"
        elif link[2] and target.suffix == ".md":
            page = target.resolve().relative_to(references.root.resolve()).as_posix()
            if not references.has_heading(page, link[2]):
                yield link.start(), f"the link leads to no heading: {link[1]}#{link[2]}"


def missing_numbers(text, references):
    for kind, words in NUMBERED.items():
        for cited in re.finditer(rf"\b(?:{words})\.?\s+({NUMBER_LIST})", text):
            for number in re.findall(r"[0-9A](?:\.\d+)+", cited[1]):
                works = references.others.get((kind, number), ())
                if number not in references.numbers[kind] and not any(
                        " ".join(work.split()) in " ".join(text.split()) for work in works):
                    yield cited.start(), f"the thesis has no {kind} {number}"


def main():
    parser = argparse.ArgumentParser(description="Checks what comments and documents refer to.")
    parser.add_argument("folders", nargs="*", help="read only what is under these")
    parser.add_argument("--root", type=pathlib.Path, default=ROOT)
    options = parser.parse_args()
    require_ctags()

    references = References(options.root)
    problems = []
    for path, kind, text, numbers in paragraphs(prose(options.root)):
        if path.startswith("tools/"):  # which describe what is wrong
            continue
        if options.folders and not path.startswith(tuple(options.folders)):
            continue
        for position, complaint in complaints_about(path, kind, text, references):
            problems.append(f"{path}:{numbers[position]}: {complaint}")
    for line in problems:
        print(line)
    print(f"{len(references.names)} names, {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
