#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Writes the page of chapter 3 from the measurements of its programs.

Reads DIR/chapter3/*.json, and writes DIR/chapter3.json (the relations with their verdicts),
DIR/chapter3.md and, if matplotlib is installed, DIR/chapter3_*.png. The first two are functions of
the measurements, to the byte; --check writes nothing and reports whether they are up to date.
"""

import argparse
import json
import pathlib
import statistics
import sys

sys.dont_write_bytecode = True  # in a folder of sources

from relations import judged  # noqa: E402
from results import FIVE, SEVEN, TITLES, Results  # noqa: E402

SECTIONS = [
    ("fig_3_5", "Fig. 3.5: box and cylinder",
     "Seven methods on 14,200 simulated points with 15 mm of noise (a to c), and five of them on "
     "Delaunay stars at four levels of noise (d)."),
    ("fig_3_6", "Fig. 3.6: little noise",
     "The same on a surrogate of the thesis's scan of two boxes and a bin, which is not public, and "
     "on a real scan of a table by the same kind of scanner. Its true normals are those of planes "
     "fitted to all points of the floor and of the table top."),
    ("table_3_3", "Table 3.3: Delaunay stars",
     "Five methods on stars in the clouds of Fig. 3.6."),
    ("fig_3_9", "Fig. 3.9: plates, and Kalman filters",
     "Plates of 30 x 30 cm in front of a SICK LMS-200 with 5 mm of noise, with ten points or more "
     "and an angle of incidence below 80 degrees: PlanePCA, the Kalman filter of Alg. 3.2, and the "
     "filter that this library has in its place."),
    ("fig_3_10", "Fig. 3.10: k, noise and density",
     "PlanePCA on nine scans of the kitchen at seven levels of noise with twelve k: 756 runs."),
    ("fig_3_11", "Fig. 3.11: anisotropic neighborhoods",
     "Normals from neighborhoods on one scan line, estimated again with doubled k."),
    ("fig_3_14", "Fig. 3.14: surface types",
     "Types by the signs of curvatures, at points of the dense rotational scan of the kitchen whose "
     "neighbors all lie on one plane."),
]


def row(*words):
    return "| " + " | ".join(str(w) for w in words) + " |"


def table(head, rows):
    return [row(*head), row(*["---"] * len(head)), *(row(*r) for r in rows), ""]


# ---- Which to take ------------------------------------------------------------------------------

CLOSE = 0.005  # of gamma


def described(c):
    """**PlanePCA, k = 20**: gamma, median error, time."""
    where = {"knn": f"k = {c.at.get('k')}", "angularly_sorted_knn": f"k = {c.at.get('k')} in angular order",
             "delaunay": "Delaunay stars"}[c.at["graph"]]
    return (f"**{TITLES[c.at['method']]}, {where}**: {c['gamma']:.4f}, {c['p50_deg']:.1f}\u00b0, "
            f"{c['us_with_search']:.1f} us")


def which_to_take(results):
    rows = []
    for sigma_mm in results.values("decision", "sigma_mm"):
        cells = results.all("decision", sigma_mm=sigma_mm)
        best = max(cells, key=lambda c: c["gamma"])
        close = [c for c in cells if c["gamma"] >= best["gamma"] - CLOSE]
        fast = min(close, key=lambda c: c["us_with_search"])
        pca = max((c for c in cells if c.at["method"] == "plane_pca"), key=lambda c: c["gamma"])
        rows.append((f"{sigma_mm} mm", described(best), described(fast), described(pca)))
    return table(("noise", "best normals", f"fastest within {CLOSE} of them",
                  "PlanePCA at its best k"), rows)


def which_k(results):
    """The k of the largest gamma, mean over the three scans; and the least k that is close."""
    densities = results.values("fig_3_10", "density")
    rows = []
    for sigma_mm in results.values("fig_3_10", "sigma_mm", scale=1):
        entries = []
        for density in densities:
            cells = results.all("fig_3_10", density=density, sigma_mm=sigma_mm, scale=1)
            mean = {k: statistics.mean(c["gamma"] for c in cells if c.at["k"] == k)
                    for k in sorted({c.at["k"] for c in cells})}
            best = max(mean, key=mean.get)
            least = next(k for k in mean if mean[k] >= mean[best] - CLOSE)
            entries.append(f"{best} ({mean[best]:.3f}); {least} suffices")
        rows.append((f"{sigma_mm} mm", *entries))
    return table(("noise", *(f"{d:,} points" for d in densities)), rows)


# ---- Numbers ------------------------------------------------------------------------------------

def numbers_of_methods(cells):
    return table(
        ("method", "gamma", "rms", "50 %", "90 %", "99 %", "us", "spread", "with search",
         "pi(1 us)", "pi(0.1 us)", "usable"),
        [(TITLES[c.at["method"]], f"{c['gamma']:.4f}",
          *(f"{c[f'{p}_deg']:.2f}\u00b0" for p in ("rms", "p50", "p90", "p99")), f"{c['us']:.3f}",
          f"{c['us_low']:.3f} to {c['us_high']:.3f}", f"{c['us_with_search']:.2f}",
          f"{c['pi_1us']:.3f}", f"{c['pi_01us']:.3f}", f"{100 * c['usable']:.1f} %")
         for c in cells])


def numbers(results, figure):
    """The numbers of a figure that its picture does not show, in a table."""
    if figure == "fig_3_5":
        at = dict(sigma_mm=15, scale=1, graph="knn", k=30)
        return ["At k = 30:", "",
                *numbers_of_methods([results.one(figure, method=m, **at) for m in SEVEN])]
    if figure == "fig_3_6":
        return ["On the surrogate at 1 mm, k = 30:", "",
                *numbers_of_methods(results.all(figure, cloud="surrogate", sigma_mm=1, k=30))]
    if figure == "table_3_3":
        lines = []
        for title, at in (("The surrogate at 1 mm", dict(sigma_mm=1)),
                          ("The surrogate at 2 mm", dict(sigma_mm=2)),
                          ("The real table", dict(cloud="real"))):
            cells = [c for m in FIVE for c in results.all(figure, method=m, **at)]
            if not cells:
                lines += [f"{title}: not measured, its scan is not available.", ""]
                continue
            lines += [f"{title}, {cells[0]['points']:,.0f} points, {cells[0]['mean_degree']:.2f} "
                      f"neighbors each, {cells[0]['max_degree']:.0f} at most:", "",
                      *numbers_of_methods(cells)]
        return lines
    if figure == "fig_3_9":
        many = results.values(figure, "plates")[-1]
        return table(("method", "gamma", "50 %", "90 %", "99 %", "gamma < 0.99", "us per plate"),
                     [(TITLES[c.at["method"]], f"{c['gamma']:.6f}",
                       *(f"{c[f'{p}_deg']:.2f}\u00b0" for p in ("p50", "p90", "p99")),
                       f"{c['failures_percent']:.2f} %", f"{c['us']:.2f}")
                      for c in results.all(figure, plates=many)])
    return []


# ---- The page -----------------------------------------------------------------------------------

def machine(results):
    contexts = results.contexts.values()
    first = next(iter(contexts))
    flags = first["flags"] or "none"
    lines = [f"{first['processor']}, {first['num_cpus']} cores at {first['mhz_per_cpu']} MHz; "
             f"{first['compiler']}, flags `{flags}`; measured on {first['date'][:10]}."]
    if any((c["compiler"], c["flags"]) != (first["compiler"], first["flags"]) for c in contexts):
        lines.append("**The programs were compiled with different flags.**")
    return lines


VERDICTS = {True: "holds", False: "**does not hold**", None: "not measured"}


def page(results, verdicts):
    held = sum(v["holds"] is True for v in verdicts)
    failed = [v for v in verdicts if v["holds"] is False]
    lines = ["# Chapter 3, reproduced", "",
             "<!-- Written by benchmarks/chapter3/page.py from chapter3/*.json: do not edit. -->", ""]
    if results.quick:
        lines += ["**Measured with `--quick`: fewer seeds, k and points. A test of the programs, not a "
                  "result.**", ""]
    lines += [
        "The results of Klasing 2010 on normals, reproduced with this library by one command:", "", "    sh benchmarks/reproduce.sh chapter3", "",
        "## Choosing an estimator", "",
        "The rotational scan of the kitchen, 28,800 points, with the seven methods of the thesis "
        "and three others. For each: mean gamma (the cosine of the error), median error, and time per "
        "normal on one core, with the search.", "",
        *which_to_take(results),
        "![Quality over time for each level of noise](chapter3_decision.png)", "",
        "The mean includes points near edges, where errors are larger. The median error is that of "
        "points away from edges.", "",
        "Numbers of neighbors for PlanePCA, mean over horizontal, vertical and rotational scans: the "
        f"best k (its gamma), and the smallest k within {CLOSE} of it:", "",
        *which_k(results),
        "## How it was measured", "", *machine(results), "",
        "Quality is the mean over "
        f"{max(len(c.seeds('gamma')) for c in results.all('fig_3_5'))} seeds of the noise, and a "
        "claim about quality holds only if it does for each of them. Times are processor time of one "
        "thread, for the first seed: the median of all passes over the cloud, with the quartiles as "
        "spread, after a warm-up. Claims about times are tested by the order of the methods, not by "
        "absolute times. Angles are percentiles of the error. The search is that of the whole graph, "
        "once for all methods. The results of each program are in "
        "[chapter3/](chapter3/), the relations in [chapter3.json](chapter3.json).", "",
        f"## {held} of {held + len(failed)} relations hold", ""]
    lines += ["These do not; the reasons are given with the figures:", ""] if failed else []
    lines += [f"- {v['id']}: {v['claim']}" for v in failed] + [""] * bool(failed)
    for figure, title, about in SECTIONS:
        lines += [f"## {title}", "", f"{about} `{figure} --benchmark_out={figure}.json`", ""]
        if figure != "table_3_3":
            lines += [f"![{title}](chapter3_{figure}.png)", ""]
        lines += numbers(results, figure)
        lines += table(("", "relation", "the thesis", "measured", ""),
                       [(v["id"], v["claim"], v["thesis"], v["measured"], VERDICTS[v["holds"]])
                        for v in verdicts if v["figure"] == figure])
        whys = [f"- {v['id']} does not hold: {v['why']}." for v in verdicts
                if v["figure"] == figure and v["holds"] is False and v["why"]]
        lines += whys + [""] * bool(whys)
    return "\n".join(lines).rstrip() + "\n"


def relations_json(verdicts):
    keys = ("id", "claim", "thesis", "measured", "holds")
    return json.dumps({"relations": [{key: v[key] for key in keys} for v in verdicts]}, indent=2,
                      ensure_ascii=False) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", metavar="DIR", type=pathlib.Path)
    parser.add_argument("--check", action="store_true",
                        help="write nothing; fail if the page is not up to date")
    options = parser.parse_args()
    try:
        results = Results(options.folder / "chapter3")
    except (OSError, ValueError) as problem:
        parser.error(str(problem))
    verdicts = judged(results)
    texts = {"chapter3.json": relations_json(verdicts), "chapter3.md": page(results, verdicts)}

    if options.check:
        stale = [name for name, text in texts.items()
                 if (options.folder / name).read_text(encoding="utf-8") != text]
        for name in stale:
            print(f"{options.folder / name} is not up to date; run page.py")
        return 1 if stale else 0

    for name, text in texts.items():
        (options.folder / name).write_text(text, encoding="utf-8")
    try:
        from pictures import PICTURES
    except ImportError:
        print("matplotlib is missing: no pictures drawn")
        PICTURES = {}
    for name, draw in PICTURES.items():
        draw(results, options.folder / f"chapter3_{name}.png")
    held = sum(v["holds"] is True for v in verdicts)
    print(f"wrote {options.folder / 'chapter3.md'}: {held} of "
          f"{sum(v['holds'] is not None for v in verdicts)} relations hold")
    return 0


if __name__ == "__main__":
    sys.exit(main())
