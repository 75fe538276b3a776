#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Refuses the words of words.txt in comments, documents and messages.

Read are the lines that prose.py finds: comments in include/, tests/, examples/ and benchmarks/,
README.md, CHANGELOG.md, docs/ (without blocks of code and without docs/results/, which scripts
write), the sentences in those scripts, and messages in include/, examples/ and benchmarks/.

    check_words.py [FOLDER...]      complaints, only about the given folders or files
    check_words.py --count          how often each word occurs in which folder
    check_words.py --unused         exceptions that excuse nothing

Exit status: 0, or 1 with problems.
"""

import argparse
import collections
import dataclasses
import fnmatch
import pathlib
import re
import sys

from cpp_source import ROOT
from prose import paragraphs, prose

WORDS = pathlib.Path(__file__).with_name("words.txt")


@dataclasses.dataclass
class Rule:
    words: list[str]
    remedy: str
    paths: dict[str, list[str]]    # exceptions: the paths with wildcards behind each name
    phrases: list[str]             # exceptions: phrases in which the words are allowed
    used: set = dataclasses.field(default_factory=set)

    def pattern(self):
        words = (r"\s+".join(map(re.escape, word.split())) for word in self.words)
        return re.compile(rf"(?<![\w-])(?:{'|'.join(words)})(?![\w-])", re.I)


def read_rules(text):
    """The rules of words.txt. @throws ValueError for a line that is none."""
    sets, rules = {}, []
    for number, line in enumerate(text.splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        if line.startswith("@"):
            name, _, paths = line.partition("=")
            sets[name.strip()] = [path.strip() for path in paths.split(",")]
            continue
        parts = [part.strip() for part in line.split("|")]
        if len(parts) != 3 or not parts[0] or not parts[1]:
            raise ValueError(f"{WORDS.name}:{number}: not 'words | instead | exceptions'")
        rule = Rule([word.strip() for word in parts[0].split(",")], parts[1], {}, [])
        for exception in filter(None, (part.strip() for part in parts[2].split(";"))):
            what = re.fullmatch(r'("(?P<phrase>[^"]+)"|(?P<path>[^\s"]+)) \(.+\)', exception)
            if not what or (what["path"] or "").startswith("@") and what["path"] not in sets:
                raise ValueError(f"{WORDS.name}:{number}: not 'exception (reason)': {exception}")
            if what["phrase"]:
                rule.phrases.append(what["phrase"])
            else:
                rule.paths[what["path"]] = sets.get(what["path"], [what["path"]])
        rules.append(rule)
    return rules


def find(rules, lines):
    """(path, line, word, rule) of each use of a word that no exception allows."""
    patterns = [(rule, rule.pattern()) for rule in rules]
    for path, _, text, numbers in paragraphs(lines):
        text = re.sub(r"`[^`]*`", lambda code: " " * len(code[0]), text)
        for rule, pattern in patterns:
            for use in pattern.finditer(text):
                if not is_allowed(rule, path, text, use):
                    yield path, numbers[use.start()], " ".join(use[0].split()), rule


def is_allowed(rule, path, text, use):
    for exception, patterns in rule.paths.items():
        if any(fnmatch.fnmatch(path, pattern) for pattern in patterns):
            rule.used.add(exception)
            return True
    for phrase in rule.phrases:
        pattern = re.compile(r"\s+".join(map(re.escape, phrase.split())), re.I)
        if any(found.start() <= use.start() and use.end() <= found.end() for found in pattern.finditer(text)):
            rule.used.add(phrase)
            return True
    return False


def count(uses):
    """Prints how often each word occurs in each folder, the most frequent rule first."""
    table = collections.defaultdict(collections.Counter)
    for path, _, _, rule in uses:
        parts = path.split("/")
        folder = "/".join(parts[:3] if parts[0] == "include" else parts[:2])
        table[rule.words[0]][folder if len(parts) > 1 else path] += 1
    for word, folders in sorted(table.items(), key=lambda row: -sum(row[1].values())):
        places = ", ".join(f"{folder} {n}" for folder, n in folders.most_common())
        print(f"{sum(folders.values()):4}  {word}: {places}")


def main():
    parser = argparse.ArgumentParser(description="Refuses the words of words.txt.")
    parser.add_argument("folders", nargs="*", help="read only what is under these")
    parser.add_argument("--root", type=pathlib.Path, default=ROOT)
    parser.add_argument("--words", type=pathlib.Path, default=WORDS)
    parser.add_argument("--count", action="store_true")
    parser.add_argument("--unused", action="store_true")
    options = parser.parse_args()

    rules = read_rules(options.words.read_text(encoding="utf-8"))
    lines = [line for line in prose(options.root)
             if not options.folders or any(line.path.startswith(folder.removeprefix("./"))
                                           for folder in options.folders)]
    uses = list(find(rules, lines))
    if options.count:
        count(uses)
    elif options.unused:
        for rule in rules:
            for exception in [*rule.paths, *rule.phrases]:
                if exception not in rule.used:
                    print(f"{rule.words[0]}: {exception}")
        return 0
    else:
        for path, number, word, rule in uses:
            print(f"{path}:{number}: '{word}': write {rule.remedy}")
    print(f"{len(lines)} lines, {len(uses)} problems")
    return 1 if uses else 0


if __name__ == "__main__":
    sys.exit(main())
