#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Writes the page of chapter 4 from the measurements of its programs.

Reads DIR/chapter4/*.json, and writes DIR/chapter4.json (the relations with their verdicts) and
DIR/chapter4.md. Both are functions of the measurements, to the byte; --check writes nothing and
reports whether they are up to date.
"""

import argparse
import json
import pathlib
import sys

sys.dont_write_bytecode = True  # in a folder of sources

from relations import STEPS, THESIS, factor, factors, judged, total  # noqa: E402

# Program, title, and a comparison of the results with the thesis. The counts of a program are shown
# table by table; a program that is not built, as a dependency is not installed, has no section.
SECTIONS = [
    ("table_4_1", "Table 4.1: times",
     "The thesis lists points, times and segments of eight scans. Here two rooms are modelled after its "
     "figures; the other two, which it shows in photographs, are surrogates (their n_pp, n_m and n_s "
     "cannot be compared). Values in brackets are those of the thesis. t_s is n over 28,800 points per "
     "second, which the thesis truncates. n_m is the number of segments that were merged into others, n_s "
     "the number of segments in the result, with the outliers that were split off planes. t_m is the "
     "time of both runs of merging. The steps that follow merging here, splitting of outliers, assignment "
     "of unlabeled points and joining of surfaces of revolution, are not in the thesis and in no sum: "
     "their time [s] is the column \"assignment\". It exceeds that of the normals where many points are "
     "unlabeled."),
    ("fig_4_1", "Fig. 4.1: groups of points",
     "The thesis shows a laboratory whose objects are separate groups once the floor is removed, without "
     "the outliers; here the scene has three boxes and two bins, and the parameters of the thesis, r = "
     "1 cm and n_min = 1,000."),
    ("fig_4_2", "Fig. 4.2: points with normals",
     "The thesis segments (a) boxes and a cylinder by one distance in the space of points and "
     "normals, (b) to (d) a corner, a step and a bend by two thresholds; here a surrogate of (a) and "
     "the three scenes."),
    ("fig_4_3", "Fig. 4.3: an outlier between two surfaces",
     "The thesis shows an outlier between two seats that would connect them; here it connects them "
     "unless the length of links is bounded."),
    ("fig_4_9", "Fig. 4.9: the kitchen",
     "The thesis shows that all major surfaces of the kitchen are one segment each; here the walls, "
     "cupboard, sink cabinet, table and seats are. The seats of chairs 1 and 4 are close to the "
     "threshold: the table occludes all of chair 1 but a strip of 10 by 20 cm, and for one seed in five "
     "a segment with points of both the seat and the front of the board is merged with neither (last "
     "table). Black lines cross gaps that were closed, magenta ones gaps that were left open."),
    ("fig_4_10", "Fig. 4.10: the living room",
     "The thesis shows the same for the living room, where the vase is one segment; here the walls, the "
     "platform, the table, the arms and the vase are. The vase is one by a step that the thesis does not "
     "have: it has about 350 points here, 3 cm apart, and neighborhoods of 50 points extend around its "
     "neck of 7 cm. The normals of adjacent points differ by more than 5 degrees, so that Alg. 4.2 "
     "oversegments the vase, even without noise and with four times the points; "
     "`join_surfaces_of_revolution` finds the common axis of the segments."),
    ("fig_4_12", "Fig. 4.12: three trajectories",
     "The thesis shows that horizontal, vertical and rotational scans of one room have the same major "
     "surfaces, with the wall behind the column merged; here a surrogate has them as well, also where "
     "every scan line has a view point of its own."),
    ("merge_policies", "Merge policies",
     "Correct and wrong merges in 100 random furnished rooms. Pairs of initial segments of one true "
     "surface are interrupted if rays of the simulator hit an object in front of the gap between them "
     "(also pairs connected by a chain of such pairs); these should be merged. A merge, direct or by way "
     "of other segments, is wrong if the pair belongs to two true surfaces. All coplanar faces of one "
     "object are one true surface; in the columns \"of planes\", those of all objects are, such as seats "
     "of the same height. A pair is counted once, or, by points, weighted with the number of points of "
     "both. Segments with more than a fifth of their points on other surfaces are not counted. The "
     "moving sensor is on an arm of 15 cm, so that each scan line has a view point of its own."),
    ("plane_segmentation", "Planes by other libraries",
     "The number of regions that are segmented correctly, as defined by Hoover et al. 1996, with the "
     "defaults of each method and with the setting from a small grid that has the most correct regions "
     "(and, where it is another one, with the setting of the best F). Neighbors, distances and gaps of "
     "the grids are the same for all methods; lengths are multiples of the noise and the spacing that are "
     "estimated from each cloud. `synpeb_test_100` has planes; `tum_office_room1` has parts of "
     "furniture, many of them curved; the others are simulated. For other scans: `--scan FILE FIELD "
     "FIRST_LABEL`."),
]


class Results:
    """The tables of all programs."""

    def __init__(self, folder):
        self.contexts, self.tables = {}, {}
        for program, _, _ in SECTIONS:
            path = folder / f"{program}.json"
            if path.exists():
                raw = json.loads(path.read_text(encoding="utf-8"))
                self.contexts[program] = raw["context"]
                self.tables[program] = raw["tables"]
        if not self.tables:
            raise ValueError(f"no measurements in {folder}")
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
    lines += ["Time in the thesis over time here, per point that a step processes (one core of today "
              "against one of 2.5 GHz in 2010):", ""]
    lines += table(("data set", *STEPS, "all", "all [ms]", "of t_s"),
                   [(r["data set"], *(f"{f:.0f}" for f in factors(r)), f"**{factor(r):.0f}**",
                     f"{1e3 * total(r):.0f}", f"{100 * total(r) / r['t_s']:.1f} %") for r in rows])
    lines += ["Merging in detail:", ""]
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
             "<!-- Written by benchmarks/chapter4/page.py from chapter4/*.json: do not edit. -->", ""]
    if results.quick:
        lines += ["**Measured with `--quick`: one seed and one pass. A test of the programs, not a "
                  "result.**", ""]
    lines += [
        "The results of Klasing 2010 on surfaces, reproduced with this library by one command:", "", "    sh benchmarks/reproduce.sh chapter4", "",
        "All programs use the parameters of Sec. 4.4.1: k = 50, links of at most 5 degrees and 0.30 m, "
        "segments of at least 30 points, merging by the conservative policy; noise of 15 mm.", "",
        "## How it was measured", "",
        f"{context['processor']}, {context['compiler']}, flags `{context['flags']}`. Times are single-"
        "threaded, medians of seven runs after a warm-up. IoU is the intersection over union of the points "
        "of a true surface and those of the segment that fits it best, without floor and ceiling; \"of "
        "area\" counts each pixel of one degree once instead of each point. Means and least values are "
        "over five seeds of the noise, and a claim holds only if it does for each of them. The results "
        "of each program are in [chapter4/](chapter4/), the relations in "
        "[chapter4.json](chapter4.json).", "",
        f"## {held} of {len(verdicts)} relations hold", ""]
    failed = [v for v in verdicts if not v["holds"]]
    lines += ["These do not; the reasons are given with the figures:", ""] if failed else []
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
                        help="write nothing; fail if the page is not up to date")
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
            print(f"{options.folder / name} is not up to date; run page.py")
        return 1 if stale else 0
    for name, text in texts.items():
        (options.folder / name).write_text(text, encoding="utf-8")
    print(f"wrote {options.folder / 'chapter4.md'}: {sum(v['holds'] for v in verdicts)} of "
          f"{len(verdicts)} relations hold")
    return 0


if __name__ == "__main__":
    sys.exit(main())
