#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Writes the page of surfaces from the measurements of its programs.

Reads DIR/surfaces/*.json, and writes DIR/surfaces.json (the tables) and DIR/surfaces.md. Both are
functions of the measurements, to the byte; --check writes nothing and reports whether they are up to
date.
"""

import json
import math
import pathlib
import sys

sys.dont_write_bytecode = True  # in a folder of sources
sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))

import pages  # noqa: E402

# Program, title, and what its tables are.
SECTIONS = [
    ("rooms", "Furnished rooms",
     "Random furnished rooms, one scan each at each noise, density of the scan lines and trajectory; "
     "\"half\" and \"double\" are half and twice as many lines. The moving sensor is rotational on a path "
     "of 10 cm, so that each scan line has a view point of its own. A true surface is a curved face, or all "
     "flat faces whose planes are within 2 degrees and 1 cm and whose points are less than 20 cm apart; "
     "floor and ceiling are left out, and surfaces of fewer than 100 points do not count. The IoU of a "
     "surface is that with its best segment; a mean is over the surfaces of a room, each counting once or "
     "\"by points\", and then over rooms. Impurity is the share of labeled points that are not of the true "
     "surface of most points of their segment. Merging is tested by pairs of initial segments, which count "
     "with the points of the smaller one: wanted are those of one flat surface that an occluder "
     "interrupts, right those of them that are merged, wrong those that are merged and of two surfaces. "
     "\"Blobs\" are flat surfaces with a blob, see real scans. \"From the truth\" is the IoU that the competition of "
     "planes reaches from the true labels, on the cells and with the noise of the chain: there, what it lacks "
     "to 1 is the loss of the competition; the remainder is that of finding the planes."),
    ("cameras", "Depth cameras",
     "Images of 640 x 480 pixels of the same rooms, by structured light: depths come in steps that grow "
     "with the square of the depth. Surfaces of less than 2 % of the points do not count; nothing is left "
     "out."),
    ("streets", "Streets",
     "Sweeps of spinning lidars in random streets of 120 m, sigma 2 cm, and a real one. The ground is the road "
     "without its pavements, which are 12 cm higher: the share of its points in one segment, and of how many "
     "pavements of 100 points and more most points are in another segment. The IoU is as for rooms, by points, of all "
     "surfaces but leaves, and of the walls of facades, in which openings are 10 to 20 cm deep. Of the real "
     "sweep there is no truth: its ground is what is within 15 cm of the plane through most of the low points, 3 to "
     "40 m away. Wanted are 0.98 of 32 and 64 beams, 0.90 of 16 beams, 0.92 of the real sweep, 0.80 where the noise "
     "or the view point is wrong; IoU 0.95. These wishes were made on a street of boxes: in plain streets, houses have no openings, and "
     "vehicles are boxes. Curved roads are 10 cm higher in their middle, a parabola, so that rain runs off; the pieces of "
     "them that are missing lie beyond gaps in which free space or too little was observed, or reach onto a pavement. The second table lists how much each kind of surface loses: "
     "openings of a facade lie in one plane behind its wall, and are merged as one surface behind an occluder; a wall "
     "of which the lidar sees the pieces on both sides of an opening alone is several, as there is free space between; the "
     "wheels of vehicles stand out of their sides by 2 cm, a standard deviation. \"From the truth\" is the IoU of a segmentation "
     "without any error: the true surfaces, in the parts that no neighbors connect, merged as the chain does. No segmentation reaches more by these rules of merging; "
     "with 64 beams and openings they do not allow 0.95. Of curved roads it is lower than that of the chain, as these parts are merged by planes. Ground normals are those of `robust_ray_ls` on `ray_knn`, with the noise of the "
     "chain: wanted are errors of 5 degrees, root mean square, and a median of 1 with 32 beams."),
    ("noise", "Measured noise",
     "`measure_noise` without parameters. Errors are those of the standard deviation: the root of the mean "
     "ratio of measured and true variance, over all points, and over those of half a meter of range or "
     "depth where these are 1 % or more. Disparities of the cameras come in eighths of a pixel, and their "
     "noise grows with the square of the depth, from the given one at 1 m."),
    ("uncertainty", "Covariances of normals",
     "Each estimator with its own neighborhood, k = 10, 20 and 50, in the kitchen, ten furnished rooms and three "
     "random convex rooms, the noise given or measured, and images of five rooms by structured light. A setting is one "
     "scan, k and noise; counted are 10,000 random points whose neighbors truly lie on one plane, and in the columns after "
     "\"half good\" the settings in which half of their normals or more are good. Of good normals, the NEES should be 2 "
     "(wanted are 1.75 to 2.4 for range finders, up to 3.5 for cameras, whose quantized errors are correlated), and 92 to "
     "97 % of the true normals should be in the 95 % regions; good normals that are off by more than 40 degrees should be "
     "0.02 % on average, 0.1 % at most. Then the root mean square error of `plane_eif` on `ray_knn` and of `plane_pca` on "
     "`knn` at all points of the ten rooms, edges and curved surfaces as well, with measured noise (a normal that is "
     "missing counts as one radian off): wanted ratios are 1.02, 0.95 and 0.92 at 5, 15 and 30 mm. And normals of a kitchen, 15 mm, and of a street, 2 cm, "
     "with k = 30 and measured noise: their errors (90 degrees where one is missing), and the times of neighborhood and fit per point on one thread; wanted are 5 "
     "and 2 times the time of `plane_pca` on `knn`, returns of the own car make it at most 1.5 times as expensive, and errors in the kitchen that are not larger."),
    ("floors", "Floors",
     "Furniture alone, seen from 2 m in 8 directions and from 5 heights: there is no floor to be found. "
     "Furnished rooms, tilted by 0 to 3 degrees about a random horizontal axis: the error of the normal of "
     "the floor, and of the height of the sensor above it."),
    ("scans", "Real scans",
     "The default chain on scans of real sensors, which have no truth. The noise is that at the median range. "
     "Surfaces count from 30 points on, flat ones all; labeled is the share of the finite points. A flat "
     "surface has a blob if 30 of its points or more are connected (each with its 12 nearest neighbors in the "
     "surface), and each farther from its plane than five standard deviations of the measured noise and 1 cm: "
     "none should have one. Then an image of 12 planes whose truth is known, with noise added along the rays: "
     "the planes that are one initial segment with an overlap of 80 % (Hoover et al. 1996). Wanted are 10, 10 "
     "and 7. Without the scans, which are not part of the repository, there are no tables."),
    ("limits", "Limits of merging",
     "The time of `merge_occluded` on walls of up to 100,000 coplanar segments of six points: wanted are 10 s. "
     "The time per segment is the same for all numbers if the time grows in proportion. Then 500 points that "
     "are seen from a view point each: wanted is 1 s, for the chain, and for merging of 150 given segments, "
     "which the chain would not find, as its segments have 30 points at least. And a part of a wall that has "
     "one point 100 m away: it should be merged with the other part all the same."),
]
PROGRAMS = [program for program, _, _ in SECTIONS]
PAGE_WITHOUT = (("rooms", "rooms"), ("uncertainty", "settings"))  # long tables are in the files


class Results(pages.Results):
    """The tables of all programs, and a comparison with an older version."""

    def __init__(self, folder):
        super().__init__(folder, PROGRAMS)
        before = folder / "rooms_before.json"
        if before.exists() and "rooms" in self.tables:
            raw = json.loads(before.read_text(encoding="utf-8"))
            compared = comparison(raw["tables"]["rooms"], self.tables["rooms"]["rooms"])
            if compared:
                self.tables["rooms"]["compared with an older version"] = compared


def room_of(row):
    return tuple(row[c] for c in ("noise [mm]", "density", "trajectory", "seed"))


def paired(before, after, column):
    """The mean difference over rooms, and its standard error, as text. A room is scanned several times:
    the differences of its scans are not independent, and count as one, their mean."""
    by_seed = {}
    for key in sorted(before.keys() & after.keys()):
        by_seed.setdefault(key[-1], []).append(after[key][column] - before[key][column])
    means = [sum(d) / len(d) for d in by_seed.values()]
    n, mean = len(means), sum(means) / len(means)
    if n < 2:
        return f"{mean:+.4f}"
    error = math.sqrt(sum((d - mean) ** 2 for d in means) / (n - 1) / n)
    return f"{mean:+.4f} ± {error:.4f}"


def comparison(before, after):
    rows = []
    for noise in sorted({r["noise [mm]"] for r in before} & {r["noise [mm]"] for r in after}):
        old, new = ({room_of(r): r for r in rows_of if r["noise [mm]"] == noise}
                    for rows_of in (before, after))
        common = old.keys() & new.keys()
        if not common:
            continue

        def mean(rows_of, column):
            return round(sum(rows_of[k][column] for k in sorted(common)) / len(common), 4)

        rows.append({"noise [mm]": noise, "scans": len(common),
                     "mean IoU before": mean(old, "IoU"), "mean IoU": mean(new, "IoU"),
                     "difference": paired(old, new, "IoU"),
                     "of IoU by points": paired(old, new, "by points"),
                     "of impurity": paired(old, new, "impurity")})
    return rows


def shown(program, tables):
    return {title: rows for title, rows in tables.items()
            if rows and not ((program, title) in PAGE_WITHOUT)}


def page(results):
    context = next(iter(results.contexts.values()))
    lines = ["# Surfaces of scans", "",
             "<!-- Written by benchmarks/surfaces/page.py from surfaces/*.json: do not edit. -->", ""]
    if results.quick:
        lines += ["**Measured with `--quick`: few rooms. A test of the programs, not a result.**", ""]
    lines += ["`perception` and what it relies on, against the truth of simulated scans, on real scans, and at "
              "the limits of its work, by one command:", "",
              "    sh benchmarks/reproduce.sh surfaces", "",
              f"{context['processor']}, {context['compiler']}, flags `{context['flags']}`. Times are those of "
              "one call on one thread, where two rooms are processed at a time. The results of each program "
              "are in [surfaces/](surfaces/), the tables in [surfaces.json](surfaces.json).", ""]
    for program, title, about in SECTIONS:
        if program not in results.tables:
            continue
        lines += [f"## {title}", "", f"{about} `{program} --out DIR`", ""]
        for name, rows in shown(program, results.tables[program]).items():
            lines += [f"{name[0].upper()}{name[1:]}:", "", *pages.table_of(rows)]
            if name == "compared with an older version":
                lines += ["The same scans by an older version, which has the true noise as a parameter; differences with "
                          "their standard errors over rooms.", ""]
    return "\n".join(lines).rstrip() + "\n"


def make(folder):
    results = Results(folder)
    tables = {program: shown(program, of) for program, of in results.tables.items()}
    return pages.as_json(tables), page(results), ""


if __name__ == "__main__":
    sys.exit(pages.run(__doc__, PROGRAMS, "surfaces", make))
