#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Compares two measurements of chapters 3 and 4: all but times must be the same.

    compare_results.py OLD NEW

OLD and NEW are each a folder with chapter3.json, chapter3/*.json, chapter4.json and chapter4/*.json,
such as docs/results/ or what `benchmarks/reproduce.sh chapter3 --out DIR` writes; or a copy of the
repository; or a commit of this repository, of which docs/results/ is read.

Labels, counts and verdicts (strings, integers, booleans) must be equal; other numbers equal to 1e-9
relative, angles in degrees to 1e-9 degrees where they are smaller than one; keys and rows must be
the same. Not compared are the machine (`context`, but for `quick`) and times (TIMES, TIMED_RELATIONS).
Of the sentences of a relation (`claim`, `thesis`, `measured`) the numbers are compared, not the words.
RENAMES lists keys and strings that have another name now, ALLOWED the differences that are wanted.

Exit status: 0, or 1 with differences that are not in ALLOWED.
"""

import argparse
import fnmatch
import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
RESULTS = "docs/results"
TOLERANCE = 1e-9

# Keys and whole strings by their old names: either name counts as the new one, on both sides.
RENAMES = {
    # keys of chapter 4
    "strays": "assignment",
    "fragments": "initial segments",
    "fragments of a scan": "initial segments of a scan",
    "of them of no one surface [%]": "of them on several surfaces [%]",
    "gaps looked into": "gaps considered",
    "pairs torn apart": "pairs interrupted",
    "mended": "merged correctly",
    "of planes: torn apart": "of planes: interrupted",
    "of planes: mended": "of planes: merged correctly",
    "n_m literally": "n_m, literal algorithm",
    "seats merged literally": "seats merged, literal algorithm",
    "what noise and density make of two of them": "two of them by noise and density",
    # values of chapter 4
    "conservative, to the letter": "conservative, literal",
    "liberal, to the letter": "liberal, literal",
    # graphs and methods in the names of rows of chapter 3
    "graph:sorted_knn": "graph:angularly_sorted_knn",
}

# Keys that hold times, or the performance index, half of which is a ratio of times.
TIMES = {
    "chapter3/*.json": ["real_time", "cpu_time", "us", "us_*", "pi_01us", "pi_1us"],
    "chapter4/fig_4_1.json": ["ms for all points"],
    # t_s is how long the scanner takes: a parameter
    "chapter4/table_4_1.json": ["t_pp", "t_nve", "t_seg", "t_m", "floor", "index", "noise", "cells",
                                 "normals", "planes", "assignment", "merging",
                                 "planes of surfaces", "all"],
}

# Relations whose measured numbers are times or ratios of times; their verdicts are compared.
TIMED_RELATIONS = {
    "3.5.6", "3.5.7", "3.5.8", "3.5.9", "3.5.10", "3.5.14", "3.6.5", "3.6.6", "3.6.8", "3.3.3",
    "3.3.4", "3.3.5", "3.9.6", "3.11.5", "4.1.2", "4.1.3", "4.1.4", "4.1.5", "4.1.6", "4.1c",
}

# Differences that are wanted: (path with wildcards as printed, "[" written "[[]"; reason).
ALLOWED = [
    ("chapter3/fig_3_9.json: benchmarks: fig_3_9/plates:10000/method:literal_plane_ekf/*"
     "near_weak_percent*",
     "4 of 10,010 covariances of Alg. 3.2 are nothing but rounding, 1e-8 rad^2 and less, some "
     "negative; the tangent plane's coordinates are computed in another order, so their axes differ"),
]

differences = []


def difference(path, text):
    differences.append((path, text))


def read(source):
    """The results of a folder, a copy of the repository or a commit: contents by file name."""
    folder = pathlib.Path(source)
    if folder.is_dir():
        if (folder / RESULTS).is_dir():
            folder = folder / RESULTS
        files = [*folder.glob("chapter[34].json"), *folder.glob("chapter[34]/*.json")]
        texts = {file.relative_to(folder).as_posix(): file.read_text(encoding="utf-8")
                 for file in files}
    else:
        listed = git("ls-tree", "-r", "--name-only", source, RESULTS + "/").split("\n")
        texts = {name.removeprefix(RESULTS + "/"): git("show", f"{source}:{name}") for name in listed
                 if re.fullmatch(rf"{RESULTS}/chapter[34](/[^/]+)?\.json", name)}
    if not texts:
        sys.exit(f"{source}: no results of chapter 3 or 4")
    return {name: json.loads(text) for name, text in texts.items()}


def git(*arguments):
    done = subprocess.run(["git", "-C", ROOT, *arguments], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"neither a folder nor a commit: {done.stderr.strip()}")
    return done.stdout


def canonical(value):
    """The value with new names for old ones, and rows of benchmarks by their names."""
    if isinstance(value, str):
        parts = [RENAMES.get(part, part) for part in value.split("/")]
        return RENAMES.get(value, "/".join(parts))
    if isinstance(value, list):
        values = [canonical(element) for element in value]
        names = [element.get("name") for element in values if isinstance(element, dict)]
        if values and len(set(names) - {None}) == len(values):
            return dict(zip(names, values))
        return values
    if isinstance(value, dict):
        return {canonical(key): canonical(element) for key, element in value.items()}
    return value


def is_time(file, key):
    return any(fnmatch.fnmatchcase(key, pattern) for files, keys in TIMES.items()
               if fnmatch.fnmatchcase(file, files) for pattern in keys)


def is_close(key, a, b):
    """Whether two numbers are equal up to rounding, under this key."""
    if isinstance(a, bool) or isinstance(b, bool):
        return a is b
    if isinstance(a, int) and isinstance(b, int):
        return a == b
    if a != a or b != b:
        return a != a and b != b
    smallest = 1.0 if key.endswith("_deg") else 0.0
    return a == b or abs(a - b) <= TOLERANCE * max(abs(a), abs(b), smallest)


def compare(file, path, key, old, new):
    """Enters the differences of two values, which are at `path` under `key`."""
    if isinstance(old, dict) and isinstance(new, dict):
        for name in [*old, *(name for name in new if name not in old)]:
            place = f"{path}: {name}"
            if name == "context":
                compare(file, place, "quick", old[name].get("quick"), new.get(name, {}).get("quick"))
            elif is_time(file, name):
                continue
            elif name not in new or name not in old:
                difference(place, f"is only in the {'old' if name in old else 'new'} results")
            else:
                compare(file, place, name, old[name], new[name])
    elif isinstance(old, list) and isinstance(new, list):
        if len(old) != len(new):
            difference(path, f"{len(old)} rows, now {len(new)}")
        for i, (a, b) in enumerate(zip(old, new), 1):
            compare(file, f"{path}: row {i}", key, a, b)
    elif isinstance(old, (int, float)) and isinstance(new, (int, float)):
        if not is_close(key, old, new):
            difference(path, f"{old!r}, now {new!r}")
    elif old != new:
        difference(path, f"{old!r}, now {new!r}")


def numbers(sentence):
    """The numbers of a sentence, as printed, without those of equations, figures and the like."""
    own = re.sub(r"\b(?:Alg|Eq|Fig|Sec|Tab)[a-z]*\.? \(?\d+\.[\d.]*\d\)?", "", sentence or "")
    return re.findall(r"-?\d(?:[\d,]*\d)?(?:\.\d+)?", own)


def compare_relations(file, old, new):
    """The same for relations, by their ids."""
    old, new = ({relation["id"]: relation for relation in page["relations"]} for page in (old, new))
    for name in [*old, *(name for name in new if name not in old)]:
        path = f"{file}: {name}"
        if name not in new or name not in old:
            difference(path, f"is only in the {'old' if name in old else 'new'} results")
            continue
        a, b = old[name], new[name]
        if a["holds"] is not b["holds"]:
            difference(f"{path}: holds", f"{a['holds']}, now {b['holds']} ({b['measured']})")
        for part in ("claim", "thesis", "measured"):
            if part == "measured" and name in TIMED_RELATIONS:
                continue
            before, now = numbers(a[part]), numbers(b[part])
            if part != "measured":  # whose words may have been put in another order
                before, now = sorted(before), sorted(now)
            if before != now:
                difference(f"{path}: {part}", f"'{a[part]}', now '{b[part]}'")


def main():
    parser = argparse.ArgumentParser(description="Compares two measurements of chapters 3 and 4.")
    parser.add_argument("old", help="folder of results, copy of the repository, or commit")
    parser.add_argument("new", help="the same")
    options = parser.parse_args()

    old, new = read(options.old), read(options.new)
    for file in sorted(old | new):
        if file not in new or file not in old:
            difference(file, f"is only in the {'old' if file in old else 'new'} results")
        elif "/" not in file:
            compare_relations(file, old[file], new[file])
        else:
            compare(file, file, "", canonical(old[file]), canonical(new[file]))

    allowed = 0
    for path, text in differences:
        reasons = [reason for pattern, reason in ALLOWED if fnmatch.fnmatchcase(path, pattern)]
        allowed += 1 if reasons else 0
        print(f"{path}: {text}" + (f" (allowed: {reasons[0]})" if reasons else ""))
    print(f"{len(old | new)} files, {len(differences)} differences, {allowed} of them allowed")
    return 1 if len(differences) > allowed else 0


if __name__ == "__main__":
    sys.exit(main())
