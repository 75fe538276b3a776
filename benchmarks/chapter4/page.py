#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Writes the page of chapter 4 from the measurements of its programs.

Reads DIR/chapter4/*.json, and writes DIR/chapter4.json (the relations with their verdicts) and
DIR/chapter4.md. Both are functions of the measurements, to the byte; --check writes nothing and
reports whether they are up to date.
"""

import pathlib
import sys

sys.dont_write_bytecode = True  # in a folder of sources
sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))

import pages  # noqa: E402
from claims import judged  # noqa: E402
from pages import cell, table  # noqa: E402
from relations import STEPS, THESIS, by_both_chains, factor, factors, total  # noqa: E402

# Program, title, and a comparison of the results with the thesis. The counts of a program are shown
# table by table; a program that is not built, as a dependency is not installed, has no section.
SECTIONS = [
    ("table_4_1", "Table 4.1: times",
     "The thesis lists points, times and segments of eight scans. Here two rooms are modelled after its "
     "figures; the other two, which it shows in photographs, are surrogates (their n_pp, n_m and n_s "
     "cannot be compared). Values in brackets are those of the thesis. t_s is n over 28,800 points per "
     "second, which the thesis truncates. n_m is the number of segments that were merged into others, n_s "
     "the number of segments in the result. The first table is of the thesis's chain: smooth surfaces "
     "(Alg. 4.2) of normals from 50 neighbors, and merging; its noise of 15 mm is given. t_nve has the "
     "search tree, t_m the range images; the planes of surfaces are not in the thesis and in no sum of "
     "this chain. The default chain, of planes on cells of the noise, has steps of its own: \"all\" is "
     "the sum of every one of them, measuring the noise and the planes of surfaces included."),
    ("fig_4_1", "Fig. 4.1: groups of points",
     "The thesis shows a laboratory whose objects are separate groups once the floor is removed, without "
     "the outliers; here the scene has three boxes and two bins, and the parameters of the thesis, r = "
     "1 cm and n_min = 1,000. Of Alg. 4.1 alone, after the floor was left out: of no chain."),
    ("fig_4_2", "Fig. 4.2: points with normals",
     "The thesis segments (a) boxes and a cylinder by one distance in the space of points and "
     "normals, (b) to (d) a corner, a step and a bend by two thresholds; here a surrogate of (a) and "
     "the three scenes. Of segmentation alone, with normals of this library: of no chain."),
    ("fig_4_3", "Fig. 4.3: an outlier between two surfaces",
     "The thesis shows an outlier between two seats that would connect them; here it connects them "
     "unless the length of links is bounded. Of Alg. 4.2 alone: of no chain."),
    ("fig_4_9", "Fig. 4.9: the kitchen",
     "The thesis shows that all major surfaces of the kitchen are one segment each; here the walls, "
     "cupboard, sink cabinet, table and seats are, by the default chain. The seats of chairs 1 and 4 are "
     "covered by few scan lines: the table occludes all of chair 1 but a strip of 10 by 20 cm (last "
     "table). Black lines cross gaps that were closed, magenta ones gaps that were left open."),
    ("fig_4_10", "Fig. 4.10: the living room",
     "The thesis shows the same for the living room, where the vase is one segment; here the walls, the "
     "platform, the table and the arms are, by the default chain. The vase has about 350 points here, 3 cm "
     "apart; strips of its mantle are planes within the noise (last table)."),
    ("fig_4_12", "Fig. 4.12: three trajectories",
     "The thesis shows that horizontal, vertical and rotational scans of one room have the same major "
     "surfaces, with the wall behind the column merged; here a surrogate has them as well, by the default "
     "chain, also where every scan line has a view point of its own."),
    ("merge_policies", "Merge policies",
     "Correct and wrong merges in 100 random furnished rooms: conservative and liberal by the default chain, "
     "\"Alg. 4.2\" and \"literal\" of the segments of Alg. 4.2, by the merging of this library and by Alg. 4.3 "
     "as printed. Pairs of initial segments of one true "
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
     "furniture, many of them curved; the others are simulated. Ours are `segment_planes` alone and Alg. 4.2 "
     "alone, of no chain. **This table was measured before `segment_planes` was rebuilt, with the borders of "
     "Alg. 4.2 extended by a step that is no longer there; it is yet to be measured again.** For other scans: "
     "`--scan FILE FIELD FIRST_LABEL`."),
]
PROGRAMS = [program for program, _, _ in SECTIONS]


class Results(pages.Results):
    """The tables of all programs, and their pictures."""

    def __init__(self, folder):
        super().__init__(folder, PROGRAMS)
        self.pictures = {program: [p.name for pattern in (".png", "_*.png")
                                   for p in sorted(folder.glob(program + pattern))]
                         for program in self.tables}


def table_4_1(tables):
    rows = tables["rows"]
    lines = ["By the thesis's chain:", ""] + table(("data set", "n", "t_s [s]", "n_pp", *(f"{t} [ms]" for t in STEPS), "planes [ms]", "n_m",
                       "n_s"),
                  [(r["data set"], r["n"], r["t_s"],
                    f"{cell(r['n_pp'])} ({cell(THESIS[r['data set']][1])})",
                    *(f"{1e3 * r[t]:.1f} ({1e3 * s:,.0f})"
                      for t, s in zip(STEPS, THESIS[r["data set"]][2:6])),
                    f"{1e3 * r['planes of surfaces']:.1f}",
                    f"{r['n_m']} ({THESIS[r['data set']][6]})",
                    f"{r['n_s']} ({THESIS[r['data set']][7]})") for r in rows])
    lines += ["Times of the default chain [ms]:", ""]
    by_default = tables["default chain"]
    lasts = list(by_default[0])[1:list(by_default[0]).index("all") + 1]
    lines += table(("data set", *lasts),
                   [(r["data set"], *(f"{1e3 * r[s]:.1f}" for s in lasts)) for r in by_default])
    lines += ["Time in the thesis over time here, per point that a step processes (one core of today "
              "against one of 2.5 GHz in 2010); the steps, and their sum, by the thesis's chain, \"all\" by "
              "the default chain with every step:", ""]
    lines += table(("data set", *STEPS, "their sum", "all", "all [ms]", "of t_s"),
                   [(r["data set"], *(f"{f:.0f}" for f in factors(r)), f"{factor(r, total(r)):.0f}",
                     f"**{factor(r, d['all']):.0f}**", f"{1e3 * d['all']:.0f}",
                     f"{100 * d['all'] / r['t_s']:.1f} %") for r, d in by_both_chains(tables)])
    for chain, own in (("the thesis's chain", rows), ("the default chain", by_default)):
        lines += [f"Merging in detail, by {chain}:", ""]
        timed = ("n", "t_s", "n_pp", *STEPS, "planes of surfaces", *lasts)
        columns = [c for c in own[0] if c not in timed and not (own is rows and c == "n_s")]
        lines += table(columns, [[r[c] for c in columns] for r in own])
    return lines


def numbers(program, tables):
    if program == "table_4_1":
        return table_4_1(tables)
    lines = []
    for title, rows in tables.items():
        if len(tables) > 1:
            lines += [f"{title[0].upper()}{title[1:]}:", ""]
        lines += pages.table_of(rows)
    return lines


def page(results, verdicts):
    context = next(iter(results.contexts.values()))
    lines = ["# Chapter 4, reproduced", "",
             "<!-- Written by benchmarks/chapter4/page.py from chapter4/*.json: do not edit. -->", ""]
    if results.quick:
        lines += ["**Measured with `--quick`: one seed and one pass. A test of the programs, not a "
                  "result.**", ""]
    lines += [
        "The results of Klasing 2010 on surfaces, reproduced with this library by one command:", "", "    sh benchmarks/reproduce.sh chapter4", "",
        "Two chains are measured; the text of each table and figure names its own. The thesis's chain is "
        "`perception<knn, plane_pca, conservative, smooth_surfaces>` with the parameters of Sec. 4.4.1: k = "
        "50, links of at most 5 degrees and 0.30 m, segments of at least 30 points, merging by the "
        "conservative policy. The default chain is `perception<>`. The noise is 15 mm, which the thesis's "
        "chain is given and the default one measures.", "",
        "## How it was measured", "",
        f"{context['processor']}, {context['compiler']}, flags `{context['flags']}`. Times are single-"
        "threaded, medians of seven runs after a warm-up. IoU is the intersection over union of the points "
        "of a true surface and those of the segment that fits it best, without floor and ceiling; \"of "
        "area\" counts each pixel of one degree once instead of each point. Means and least values are "
        "over five seeds of the noise, and a claim holds only if it does for each of them. The results "
        "of each program are in [chapter4/](chapter4/), the relations in "
        "[chapter4.json](chapter4.json).", "",
        *pages.heading(verdicts)]
    for program, title, about in SECTIONS:
        if program not in results.tables:
            continue
        lines += [f"## {title}", "", f"{about} `{program} --out DIR`", ""]
        for name in results.pictures[program]:
            lines += [f"![{title}](chapter4/{name})", ""]
        lines += numbers(program, results.tables[program])
        lines += pages.relations(verdicts, program)
    return "\n".join(lines).rstrip() + "\n"


def make(folder):
    results = Results(folder)
    verdicts = judged(results.tables)
    return pages.relations_as_json(verdicts), page(results, verdicts), pages.summary_of(verdicts)


if __name__ == "__main__":
    sys.exit(pages.run(__doc__, PROGRAMS, "chapter4", make))
