# SPDX-License-Identifier: BSL-1.0
"""What the pages of results have in common: the measurements of programs, tables in Markdown, claims with
their verdicts, and the command line of page.py."""

import argparse
import json
import pathlib


class Results:
    """The tables of all programs.

    Raises ValueError if there are none in the folder."""

    def __init__(self, folder, programs):
        self.contexts, self.tables = {}, {}
        for program in programs:
            path = folder / f"{program}.json"
            if path.exists():
                raw = json.loads(path.read_text(encoding="utf-8"))
                self.contexts[program] = raw["context"]
                self.tables[program] = raw["tables"]
        if not self.tables:
            raise ValueError(f"no measurements in {folder}")
        self.quick = any(c["quick"] for c in self.contexts.values())


def cell(value):
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float) and value.is_integer():
        value = int(value)
    return f"{value:,}" if isinstance(value, int) else str(value)


def table(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return ["| " + " | ".join(cell(c) for c in line) + " |" for line in lines] + [""]


def table_of(rows):
    """Of rows, of which some may have fewer keys."""
    head = list(max(rows, key=len))
    return table(head, [[row.get(key, "-") for key in head] for row in rows])


def heading(verdicts):
    """How many relations hold, and which do not."""
    lines = [f"## {sum(v['holds'] for v in verdicts)} of {len(verdicts)} relations hold", ""]
    failed = [v for v in verdicts if not v["holds"]]
    lines += ["These do not; the reasons are given with the figures:", ""] if failed else []
    return lines + [f"- {v['id']}: {v['claim']}" for v in failed] + [""] * bool(failed)


def relations(verdicts, program):
    """The table of the relations of a program, if it has any, and why some do not hold."""
    own = [v for v in verdicts if v["program"] == program]
    if not own:
        return []
    whys = [f"- {v['id']} does not hold: {v['why']}." for v in own if v["why"]]
    return [*table(("", "relation", "the thesis", "measured", ""),
                   [(v["id"], v["claim"], v["thesis"], v["measured"],
                     "holds" if v["holds"] else "**does not hold**") for v in own]),
            *whys, *[""] * bool(whys)]


def as_json(content):
    return json.dumps(content, indent=2, ensure_ascii=False) + "\n"


def relations_as_json(verdicts):
    keys = ("id", "claim", "thesis", "measured", "holds")
    return as_json({"relations": [{key: v[key] for key in keys} for v in verdicts]})


def run(doc, programs, name, make, draw=None):
    """The program: reads DIR/name/*.json, writes DIR/name.json and DIR/name.md, or compares them.

    doc       of the page
    programs  whose measurements it shows
    make      make(folder of the measurements) gives the texts (JSON, Markdown) and a summary of them
    draw      draw(folder, DIR) makes pictures, which no comparison looks at
    Returns the exit status."""
    parser = argparse.ArgumentParser(description=doc.splitlines()[0])
    parser.add_argument("folder", metavar="DIR", type=pathlib.Path, nargs="?")
    parser.add_argument("--check", action="store_true",
                        help="write nothing; fail if the page is not up to date")
    parser.add_argument("--programs", action="store_true", help="name the programs, and no more")
    options = parser.parse_args()
    if options.programs:
        print(*programs)
        return 0
    if options.folder is None:
        parser.error("DIR is missing")
    try:
        *texts, summary = make(options.folder / name)
    except (OSError, ValueError) as problem:
        parser.error(str(problem))
    files = {options.folder / f"{name}{suffix}": text for suffix, text in zip((".json", ".md"), texts)}
    if options.check:
        stale = [file for file, text in files.items() if file.read_text(encoding="utf-8") != text]
        for file in stale:
            print(f"{file} is not up to date; run page.py")
        return 1 if stale else 0
    for file, text in files.items():
        file.write_text(text, encoding="utf-8")
    if draw is not None:
        draw(options.folder / name, options.folder)
    print(f"wrote {options.folder / name}.md{summary}")
    return 0


def summary_of(verdicts):
    return f": {sum(v['holds'] for v in verdicts)} of {len(verdicts)} relations hold"
