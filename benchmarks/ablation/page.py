#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Writes the page of the ablation from its measurements.

Reads DIR/ablation/variants.json, and writes DIR/ablation.json (the relations and the tables) and
DIR/ablation.md. Both are functions of the measurements, to the byte; --check writes nothing and
reports whether they are up to date.
"""

import argparse
import json
import math
import pathlib
import sys

SCORES = [("IoU", "mean IoU"), ("by points", "by points")]
DEVIATIONS = 3.0       # standard errors: what is more is beyond the scatter of seeds
MOST = {"IoU": 0.02, "by points": 0.01}  # change by a constant that the relations allow
SCATTER = "within the scatter of seeds"
# Steps whose replacement should change nothing.
REPLACED = ["measured noise, the true one instead"]

# Why steps stay for which the relation does not hold.
REASONS = {
    "merging behind occluders": "it is there for the pairs that an occluder interrupts, which hardly change a mean "
                                "over surfaces: without it recall is 0 (below)",
    "closing of narrow gaps": "a rule of the thesis (rho_c); in these rooms no gap without evidence is so narrow",
    "noise of wide planes": "simulated noise is independent from point to point; in real scans neighbors have "
                            "errors in common, and without it they are cut into many more segments (last table)",
    "cells, each point its own": "cells are there for speed, as they are fewer than the points; they cost a little "
                                 "accuracy at the least noise",
    "cutting of regions at edges": "at each noise alone it is within three standard errors, but worse in all six "
                                   "columns, by more than two of them in four",
    "weights of cells by their points": "in the rooms of this page a cell has little more than one point; with twice as "
                                        "many scan lines, at 30 mm, without it recall of merging is less (rooms 20,001 "
                                        "to 20,024: 0.69 instead of 0.92) and the mean IoU by 0.005",
    "no merging of planes at edges": "without it precision of merging is less (below), and regions that were cut "
                                     "become one again",
}

SECTIONS = [
    ("step", "Without a step",
     "Each row is the chain without one step, or with a plain substitute for it. A step that costs nothing to "
     "leave out is one too many."),
    ("chosen", "Chosen constants",
     "Each number that is marked \"chosen\" where it is defined, as `tools/constants.py` lists them, times 0.8 and "
     "times 1.25."),
    ("thesis", "Constants of the thesis",
     "The same for the numbers that are from the thesis or another publication."),
    ("option", "Neighborhoods of the normals",
     "The same for the members of `noise_knn`, the neighborhood of the default chain."),
]


class Results:
    """The measurements, and what follows from them."""

    def __init__(self, path):
        raw = json.loads(path.read_text(encoding="utf-8"))
        self.context = raw["context"]
        columns = self.context["columns"]
        for v in raw["variants"]:
            v["rooms"] = [dict(zip(columns, room)) for room in v["rooms"]]
        self.default, *self.variants = raw["variants"]
        self.noises = sorted({room["noise [mm]"] for room in self.default["rooms"]})
        self.unused = [v for v in self.variants if v["digest"] == self.default["digest"]]
        self.used = [v for v in self.variants if v["digest"] != self.default["digest"]]
        for v in self.used:
            v["differences"] = {(score, noise): self.difference(v, score, noise)
                                for score, _ in SCORES for noise in self.noises}

    def difference(self, variant, score, noise):
        """(mean over rooms, its standard error) of a score of a variant less that of the default."""
        before, after = ([room[score] for room in v["rooms"] if room["noise [mm]"] == noise]
                         for v in (self.default, variant))
        differences = [b - a for a, b in zip(before, after, strict=True)]
        n, mean = len(differences), sum(differences) / len(differences)
        if n < 2:
            return mean, math.inf
        return mean, math.sqrt(sum((d - mean) ** 2 for d in differences) / (n - 1) / n)

    def beyond_scatter(self, variant, sign):
        """The noises at which a variant is better, or with a sign of -1 worse."""
        return [noise for noise in self.noises
                if any(sign * mean > DEVIATIONS * error for score, _ in SCORES
                       for mean, error in [variant["differences"][score, noise]])]

    def by_chance(self):
        """The share of differences beyond the scatter if there are none: of Student's distribution."""
        freedom, steps = max(1, self.context["rooms"] - 1), 1000
        def density(t):
            return (1 + t * t / freedom) ** (-(freedom + 1) / 2)
        factor = math.exp(math.lgamma((freedom + 1) / 2) - math.lgamma(freedom / 2)) / math.sqrt(freedom * math.pi)
        width = DEVIATIONS / steps
        return 1 - 2 * factor * width * sum(density((i + 0.5) * width) for i in range(steps))


def mean(rooms, score):
    return sum(room[score] for room in rooms) / len(rooms)


def share(part, whole):
    return part / whole if whole else 1.0


def merging(rooms):
    """Precision and recall of merging, pooled over rooms."""
    wanted, right, wrong = (sum(room[c] for room in rooms) for c in ("wanted", "right", "wrong"))
    return {"precision": f"{share(right, right + wrong):.3f}", "recall": f"{share(right, wanted):.3f}"}


def with_error(difference):
    value, error = difference
    return f"{value:+.4f}" + (f" ± {error:.4f}" if math.isfinite(error) else "")


def list_of(noises):
    return ", ".join(f"{noise:g}" for noise in noises) + " mm"


def verdict(results, variant):
    if results.context["rooms"] < 2:
        return "undetermined by one room"
    worse, better = (results.beyond_scatter(variant, sign) for sign in (-1, 1))
    words = [f"costs ({list_of(worse)})"] * bool(worse) + [f"better ({list_of(better)})"] * bool(better)
    return ", ".join(words) or SCATTER


def name(variant):
    if variant["kind"] in ("default", "step"):
        return {"what": variant["what"]}
    file = variant["place"].rsplit("/", 1)[1].split(":")[0]
    return {"what": f"`{variant['what']}` ({file})", "value": variant["value"]}


def sentence(variant):
    return " ".join(name(variant).values())


def default_rows(results):
    rows = []
    for noise in results.noises:
        rooms = [room for room in results.default["rooms"] if room["noise [mm]"] == noise]
        rows.append({"noise [mm]": f"{noise:g}", **{title: f"{mean(rooms, score):.4f}" for score, title in SCORES},
                     "impurity": f"{mean(rooms, 'impurity'):.4f}", **merging(rooms)})
    return rows


def difference_rows(results, kind):
    return [{**name(v), **{f"{title}, {noise:g} mm": with_error(v["differences"][score, noise])
                           for score, title in SCORES for noise in results.noises},
             "verdict": verdict(results, v)}
            for v in results.used if v["kind"] == kind]


def step_rows(results):
    """The other scores, over all rooms and noises."""
    return [{"what": v["what"], "impurity": f"{mean(v['rooms'], 'impurity'):.4f}", **merging(v["rooms"])}
            for v in [results.default, *results.used] if v["kind"] in ("default", "step")]


def scan_rows(results):
    """Segments and labels of the scans without ground truth, of the default and all that differ."""
    rows = []
    for v in [results.default, *results.used]:
        if not v["scans"] or v is not results.default and v["scans"] == results.default["scans"]:
            continue
        segments, labeled, points = (sum(scan[c] for scan in v["scans"]) for c in ("segments", "labeled", "points"))
        rows.append({"what": name(v)["what"], "value": v["value"], "segments": segments,
                     "labeled [%]": f"{100 * share(labeled, points):.2f}"})
    return rows


def tables_of(results):
    tables = {"default": default_rows(results)}
    for kind, _, _ in SECTIONS:
        tables[kind] = difference_rows(results, kind)
    tables["other scores"] = step_rows(results)
    tables["scans"] = scan_rows(results)
    return {title: rows for title, rows in tables.items() if rows}


def relations_of(results):
    found = []

    def add(claim, measured, holds):
        found.append({"id": f"a.{len(found) + 1}", "claim": claim, "thesis": "(not in the thesis)",
                      "measured": measured, "holds": bool(holds)})

    for v in results.used:
        if v["kind"] != "step":
            continue
        measured = "; ".join(f"{title} " + ", ".join(with_error(v["differences"][score, noise])
                                                     for noise in results.noises)
                             for score, title in SCORES) + f" at {list_of(results.noises)}"
        if v["what"] in REPLACED:
            add(f"{v['what']}: no difference beyond the scatter of seeds", measured,
                not results.beyond_scatter(v, 1) and not results.beyond_scatter(v, -1))
        else:
            add(f"without this step the mean IoU, or that by points, is less at some noise: {v['what']}",
                measured, results.beyond_scatter(v, -1))
    constants = [v for v in results.used if v["kind"] != "step"]
    for score, title in SCORES:
        if not constants:
            break
        change, where, noise = max(((abs(v["differences"][score, noise][0]), sentence(v), noise)
                                    for v in constants for noise in results.noises), key=lambda c: c[0])
        add(f"no constant times 0.8 or 1.25 changes the {'mean IoU' if score == 'IoU' else 'mean IoU by points'} "
            f"by more than {MOST[score]} at any noise",
            f"at most {change:.4f}, {where}, at {noise:g} mm", change <= MOST[score])
    better = [sentence(v) for v in constants if results.beyond_scatter(v, 1) and not results.beyond_scatter(v, -1)]
    add("no other value of a constant is better than that of the default chain at some noise, and worse at none",
        "; ".join(better) or "none is", not better)
    return found


def table(rows):
    lines = [list(rows[0]), ["---"] * len(rows[0]), *(list(r.values()) for r in rows)]
    return ["| " + " | ".join(f"{c:,}" if isinstance(c, int) else c.replace("->", "→") for c in line) + " |"
            for line in lines] + [""]


def introduction(results):
    context = results.context
    last = context["first seed"] + context["rooms"] - 1
    tests = len(results.used) * len(SCORES) * len(results.noises)
    lines = ["# The default chain without its steps, and with other constants", "",
             "<!-- Written by benchmarks/ablation/page.py from ablation/variants.json: do not edit. -->", ""]
    if context["quick"]:
        lines += ["**Measured with `--quick`: few variants, one room. A test of the programs, not a result.**", ""]
    lines += ["`perception<>` and variants of it, by one command:", "",
              "    sh benchmarks/reproduce.sh ablation", "",
              f"Each variant is compiled ({context['compiler']}, `{context['flags']}`) and run on rotational scans of "
              f"{context['rooms']} furnished rooms, the seeds {context['first seed']:,} to {last:,}, which no other "
              "page uses, each at every noise; floor and ceiling are left out, and the scores are those of "
              "[surfaces.md](surfaces.md). Whole numbers are rounded, and change by one at least. A difference is "
              "the mean over rooms of the variant's score less that of the default chain, ± its standard error. "
              f"One of more than {DEVIATIONS:g} standard errors is beyond the scatter of seeds; where nothing "
              f"differs, {results.by_chance() * tests:.0f} of these {tests} would be so by chance. \"Costs\" is a "
              "variant that is worse beyond the scatter, by mean IoU or by points, at the noises in brackets. The "
              "measurements are in [ablation/](ablation/), relations and tables in [ablation.json](ablation.json).",
              ""]
    return lines


def reasons(relations):
    """One line for each step without effect that stays."""
    return [f"- {r['id']} does not hold: {reason}." for r in relations if not r["holds"]
            for step, reason in REASONS.items() if r["claim"].endswith(step)]


def page(results, tables, relations):
    lines = introduction(results)
    lines += [f"## {sum(r['holds'] for r in relations)} of {len(relations)} relations hold", ""]
    lines += table([{"": r["id"], "claim": r["claim"], "measured": r["measured"],
                     "holds": "yes" if r["holds"] else "no"} for r in relations])
    lines += [*reasons(relations), ""] if reasons(relations) else []
    lines += ["## The default chain", "", *table(tables["default"])]
    for kind, title, about in SECTIONS:
        if kind not in tables:
            continue
        lines += [f"## {title}", "", about, "", *table(tables[kind])]
        if kind == "step":
            lines += ["Impurity is the mean over all rooms and noises; precision and recall of merging are those of "
                      "all rooms together:", "", *table(tables["other scores"])]
    unused = sorted({name(v)["what"] for v in results.unused})
    if unused:
        lines += ["Not in this chain, which is the same to the byte with another value: " + ", ".join(unused) + ".", ""]
    if "scans" in tables:
        lines += ["## Real scans", "",
                  f"{len(results.default['scans'])} scans without ground truth, of all points: how many segments have "
                  "30 points or more, and how many points have a label. Variants that change neither are left out.",
                  "", *table(tables["scans"])]
    return "\n".join(lines).rstrip() + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", metavar="DIR", type=pathlib.Path)
    parser.add_argument("--check", action="store_true",
                        help="write nothing; fail if the page is not up to date")
    options = parser.parse_args()
    try:
        results = Results(options.folder / "ablation/variants.json")
    except (OSError, ValueError) as problem:
        parser.error(str(problem))
    tables, relations = tables_of(results), relations_of(results)
    texts = {"ablation.json": json.dumps({"relations": relations, "tables": tables}, indent=2,
                                         ensure_ascii=False) + "\n",
             "ablation.md": page(results, tables, relations)}
    if options.check:
        stale = [name for name, text in texts.items()
                 if (options.folder / name).read_text(encoding="utf-8") != text]
        for name in stale:
            print(f"{options.folder / name} is not up to date; run page.py")
        return 1 if stale else 0
    for name, text in texts.items():
        (options.folder / name).write_text(text, encoding="utf-8")
    print(f"wrote {options.folder / 'ablation.md'}: {sum(r['holds'] for r in relations)} of "
          f"{len(relations)} relations hold")
    return 0


if __name__ == "__main__":
    sys.exit(main())
