#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Makes the page of chapter 4 of what its programs measured, and of nothing else.

Reads DIR/chapter4/*.json, and writes DIR/chapter4.json (the relations with their verdicts) and
DIR/chapter4.md. Of the same measurements both come out the same to the byte; --check writes nothing
and tells whether they are.
"""

import argparse
import json
import pathlib
import sys

sys.dont_write_bytecode = True  # in a folder of sources

from relations import STEPS, THESIS, factor, factors, judged, total  # noqa: E402

# Program, title, and what the thesis shows and what is seen here. What a program has counted is shown
# table by table; a program that is not built, as it needs what is not installed, is no section.
SECTIONS = [
    ("table_4_1", "Table 4.1: times",
     "The thesis lists points, times and segments of eight scans; here are those of two rooms drawn "
     "after its figures and of surrogates of two rooms it shows in photographs (their n_pp, n_m and "
     "n_s are the surrogates', not to be compared). t_s is n over 28,800 points per second, which the "
     "thesis truncates. n_m counts segments that were merged away, here and, in brackets, in the "
     "thesis; n_s those in the end, among them what flat ones have released. t_m is that of both runs of "
     "merging, before and after that. What else follows merging here, strays and what is round, is not "
     "of the thesis and in no sum: its time [s] is the column \"strays\", more than that of the normals "
     "where many points have no segment."),
    ("fig_4_1", "Fig. 4.1: groups of points",
     "The thesis shows a laboratory whose objects fall apart into groups once the floor is gone, and "
     "outliers pruned; here three boxes and two bins do, with the thesis's r = 1 cm and n_min = "
     "1,000."),
    ("fig_4_2", "Fig. 4.2: points with normals",
     "The thesis shows (a) boxes and a cylinder in segments by one distance in the space of points "
     "and normals, (b) to (d) a corner, a step and a bend by two thresholds; here a surrogate of (a) "
     "and the three scenes."),
    ("fig_4_3", "Fig. 4.3: an outlier between two surfaces",
     "The thesis shows an outlier between two seats that would connect them; here it does unless the "
     "length of links is bounded."),
    ("fig_4_9", "Fig. 4.9: the kitchen",
     "The thesis shows that all major surfaces of the kitchen are one segment each; here the walls, "
     "cupboard, sink cabinet, table and seats are. The seats of chairs 1 and 4 are so by little: of "
     "chair 1 the table leaves a strip of 10 by 20 cm, and for one seed in five a piece that is half "
     "seat, half front of the board lies beside it and joins neither (the last table). Black lines "
     "cross gaps that were closed, magenta ones gaps that were left open."),
    ("fig_4_10", "Fig. 4.10: the living room",
     "The thesis shows the same of the living room, the vase being one segment; here the walls, the "
     "platform, the table and the arms are, and so is the vase, but by a step of ours: where it stands "
     "here it has some 350 points, 3 cm apart, and 50 of them reach round a neck of 7 cm. From one point "
     "to the next normals turn by more than 5 degrees, so that Alg. 4.2 leaves of it fragments, even "
     "without noise and of four times the points; join_round finds that they meet one axis."),
    ("fig_4_12", "Fig. 4.12: three trajectories",
     "The thesis shows that horizontal, vertical and rotational scans of one room have the same major "
     "surfaces, the wall behind the column mended; here the same is seen of a surrogate, also where "
     "the view point moves with every scan line."),
    ("merge_policies", "Merge policies",
     "What is merged rightly and wrongly in 100 random furnished rooms. Wanted are pairs of fragments "
     "of one true surface between which rays of the simulator meet something in front (or a chain of "
     "such pairs); wrong are pairs, merged directly or by way of others, of two. All faces of one "
     "object in one plane are one true surface; \"of planes\", those of all objects are, such as seats of "
     "the same height. A pair counts once, or (by points) as often as both have points. Fragments of "
     "which more than a fifth is of other surfaces are nobody's, and not counted. The sensor that moves "
     "is on an arm of 15 cm, so that each scan line has a view point of its own."),
    ("plane_segmentation", "Planes by other libraries",
     "How many true regions are segmented correctly, by the counts of Hoover et al. 1996, with the "
     "defaults of each method and with the setting from a small grid that has most of them correct "
     "(and, where that is another, with that of the best F). Neighbors, distances and gaps of the "
     "grids are the same for all methods, lengths in multiples of the noise and the spacing that each "
     "cloud tells itself. `synpeb_test_100` are planes; `tum_office_room1` are parts of furniture, "
     "many of them curved; the others are simulated. A scan of one's own: `--scan FILE FIELD "
     "FIRST_LABEL`."),
]


class Results:
    """What the programs counted."""

    def __init__(self, folder):
        self.contexts, self.tables = {}, {}
        for program, _, _ in SECTIONS:
            path = folder / f"{program}.json"
            if path.exists():
                raw = json.loads(path.read_text(encoding="utf-8"))
                self.contexts[program] = raw["context"]
                self.tables[program] = raw["tables"]
        if not self.tables:
            raise ValueError(f"nothing was measured in {folder}")
        self.quick = any(c["quick"] for c in self.contexts.values())
        self.pictures = {program: [p.name for pattern in (".png", "_*.png")
                                   for p in sorted(folder.glob(program + pattern))]
                         for program in self.tables}


def cell(value):
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float) and value.is_integer():
        value = int(value)
    return f"{value:,}" if isinstance(value, int) else str(value)


def table(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return ["| " + " | ".join(cell(c) for c in line) + " |" for line in lines] + [""]


def table_4_1(rows):
    lines = table(("data set", "n", "t_s [s]", "n_pp", *(f"{t} [ms]" for t in STEPS), "n_m", "n_s"),
                  [(r["data set"], r["n"], r["t_s"],
                    f"{cell(r['n_pp'])} ({cell(THESIS[r['data set']][1])})",
                    *(f"{1e3 * r[t]:.1f} ({1e3 * s:,.0f})"
                      for t, s in zip(STEPS, THESIS[r["data set"]][2:6])),
                    f"{r['n_m']} ({THESIS[r['data set']][6]})",
                    f"{r['n_s']} ({THESIS[r['data set']][7]})") for r in rows])
    lines += ["How many times as long the thesis took, per point that a step had to do with (one core "
              "of today against one of 2.5 GHz in 2010):", ""]
    lines += table(("data set", *STEPS, "all", "all [ms]", "of t_s"),
                   [(r["data set"], *(f"{f:.0f}" for f in factors(r)), f"**{factor(r):.0f}**",
                     f"{1e3 * total(r):.0f}", f"{100 * total(r) / r['t_s']:.1f} %") for r in rows])
    lines += ["Merging, seen closer:", ""]
    columns = [c for c in rows[0] if c == "data set" or c not in ("n", "t_s", "n_pp", *STEPS, "n_s")]
    return lines + table(columns, [[r[c] for c in columns] for r in rows])


def numbers(program, tables):
    if program == "table_4_1":
        return table_4_1(tables["rows"])
    lines = []
    for title, rows in tables.items():
        if len(tables) > 1:
            lines += [f"{title[0].upper()}{title[1:]}:", ""]
        lines += table(list(rows[0]), [list(r.values()) for r in rows])
    return lines


def page(results, verdicts):
    held = sum(v["holds"] for v in verdicts)
    context = next(iter(results.contexts.values()))
    lines = ["# Chapter 4, reproduced", "",
             "<!-- Written by benchmarks/chapter4/page.py of chapter4/*.json: do not edit. -->", ""]
    if results.quick:
        lines += ["**Measured in a hurry (`--quick`): one seed and one pass. To try it out, not to be "
                  "quoted.**", ""]
    lines += [
        "What Klasing 2010 says of surfaces, measured again with this library. One command does it "
        "all:", "", "    sh benchmarks/reproduce.sh chapter4", "",
        "Everywhere the one set of parameters of Sec. 4.4.1: k = 50, links of 5 degrees and 0.30 m at "
        "most, segments of 30 points at least, merging by the conservative policy; 15 mm of noise.", "",
        "## How it was measured", "",
        f"{context['processor']}, {context['compiler']}, flags `{context['flags']}`. Times are of one "
        "thread, medians of seven runs after one that warms up. IoU is that of the points of a true "
        "surface with those of the segment that fits it best, points of floor and ceiling left out "
        "before; \"of area\" counts each pixel of one degree once instead of each point. Means and "
        "least values are over five seeds of the noise, and a claim holds only if it does for every "
        "one of them. What each program counted is in [chapter4/](chapter4/), the relations in "
        "[chapter4.json](chapter4.json).", "",
        f"## {held} of {len(verdicts)} relations hold", ""]
    failed = [v for v in verdicts if not v["holds"]]
    lines += ["These do not, for the reasons given at their figures:", ""] if failed else []
    lines += [f"- {v['id']}: {v['claim']}" for v in failed] + [""] * bool(failed)
    for program, title, about in SECTIONS:
        if program not in results.tables:
            continue
        lines += [f"## {title}", "", f"{about} `{program} --out DIR`", ""]
        for name in results.pictures[program]:
            lines += [f"![{title}](chapter4/{name})", ""]
        lines += numbers(program, results.tables[program])
        own = [v for v in verdicts if v["program"] == program]
        if own:
            lines += table(("", "relation", "the thesis", "measured", ""),
                           [(v["id"], v["claim"], v["thesis"], v["measured"],
                             "holds" if v["holds"] else "**does not hold**") for v in own])
        whys = [f"- {v['id']} does not hold: {v['why']}." for v in own if v["why"]]
        lines += whys + [""] * bool(whys)
    return "\n".join(lines).rstrip() + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", metavar="DIR", type=pathlib.Path, nargs="?")
    parser.add_argument("--check", action="store_true",
                        help="write nothing; fail if the page is not what would be written")
    parser.add_argument("--programs", action="store_true", help="name the programs, and no more")
    options = parser.parse_args()
    if options.programs:
        print(*(program for program, _, _ in SECTIONS))
        return 0
    if options.folder is None:
        parser.error("DIR is missing")
    try:
        results = Results(options.folder / "chapter4")
    except (OSError, ValueError) as problem:
        parser.error(str(problem))
    verdicts = judged(results.tables)
    keys = ("id", "claim", "thesis", "measured", "holds")
    relations = {"relations": [{key: v[key] for key in keys} for v in verdicts]}
    texts = {"chapter4.json": json.dumps(relations, indent=2, ensure_ascii=False) + "\n",
             "chapter4.md": page(results, verdicts)}
    if options.check:
        stale = [name for name, text in texts.items()
                 if (options.folder / name).read_text(encoding="utf-8") != text]
        for name in stale:
            print(f"{options.folder / name} is not what the measurements say; run page.py")
        return 1 if stale else 0
    for name, text in texts.items():
        (options.folder / name).write_text(text, encoding="utf-8")
    print(f"wrote {options.folder / 'chapter4.md'}: {sum(v['holds'] for v in verdicts)} of "
          f"{len(verdicts)} relations hold")
    return 0


if __name__ == "__main__":
    sys.exit(main())
