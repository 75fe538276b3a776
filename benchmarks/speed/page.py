#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Makes speed.md and speed.png of the speed.json in a folder; see ../peers/tables.py."""

import pathlib
import statistics
import sys

sys.dont_write_bytecode = True  # in a folder of sources
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "peers"))

import tables  # noqa: E402
from tables import (  # noqa: E402
    GAIN, OURS, busy_text, gamma_known, gamma_text, markdown, section, sections_of, threads_text,
    unique)
from verdicts import (  # noqa: E402
    exponent, extra_bytes, judged, ours_at, rows_at, table_of, without_verdict)

INTRODUCTION = """\
# How fast

`sh benchmarks/reproduce.sh speed`

Search, normals, smooth surfaces and clusters by gnomon and by other libraries, in turns on the same
machine. A ratio is a library's time over gnomon's in the same run: above 1 gnomon is faster. Only
ratios mean anything elsewhere, and even they depend on the processor and the compiler, here
{cpu} and {compiler}. [peers.md](peers.md) is the short version.

![How many times as long as gnomon each library takes](speed.png)
"""

METHOD = """\
## How it was measured

- As in [peers.md](peers.md): a program for each library, compiled by the same compiler, in turns
  after a warm-up; times are medians. All tasks start with the points in the library's own container
  and pay for trees, searches and everything else; k does not count the point itself.
- What is compiled with `-O2` alone may still use better instructions if it asks the processor: so
  does gnomon's search, for AVX2 (with `GNOMON_COMPILED_LANES` it would not); Open3D, PCL and FLANN
  come compiled as packages, Eigen and nanoflann as headers.
- Compiled for x86-64-v3 (AVX2, without AVX-512): libraries of headers alone, in seven rounds.
- Search: the k nearest neighbors of all points, sorted by distance, as one list of n times k
  numbers. `knn{}(points, threads{})`; for the others a loop around their search, by OpenMP. Equal
  mean distances to the last neighbor show that the same was found.
- Surfaces: normals from k neighbors, then growing from point to point where normals differ by 5
  degrees at most; fewer than 30 points are noise.
  - gnomon: `estimate_normals(points, knn{}, plane_pca{})`, then `segment_surfaces` (Alg. 4.2 of the
    thesis), which goes on to all points within the mean distance to the k neighbors.
  - nanoflann + Eigen: a loop of one's own that stores the graph of the normals and grows over it,
    breadth first, by all k neighbors.
  - PCL: NormalEstimationOMP and RegionGrowing, k neighbors, smoothness 5 degrees, the curvature
    test so wide that it has no say (it cannot be left out without another, costlier test), 30
    points at least. CGAL: pca_estimate_normals and Region_growing by K_neighbor_query; as its own
    region types would fit a plane or another shape again and again, one that compares normals.
  - Neither PCL, CGAL nor nanoflann's loop grows on several threads.
- Clusters: `euclidean_clusters` (Alg. 4.1), no gap wider than r, every point counts. PCL's
  EuclideanClusterExtraction, Open3D's ClusterDBSCAN where one point is enough for a core, CGAL's
  cluster_point_set, and a loop of one's own by nanoflann's radius search, breadth first. All must
  find the same number of clusters.
- Gains of two threads: one thread, two threads, and two programs side by side take eight turns
  each, of which the first three do not count, as a core that was idle takes some time to run at full
  speed; and again, several times over: the table says how many turns count.
- Memory: how far the resident set rose during the warm-up. Instructions: of the program doing the
  work twice less that of the program doing it once, under `valgrind --tool=callgrind`.
- A newer nanoflann is measured if CMake knows its folder: `GNOMON_NEWER_NANOFLANN_INCLUDE_DIR`.

What was left out, so that all takes less than half an hour: CGAL's jets and, but for the kitchen,
ANN with GSL and PCL's estimator for one thread, none of which is the fastest anywhere (see
[peers.md](peers.md)); but for the kitchen, on two threads compared with others, normals with another k than
30; search and surfaces of the office; clusters of 1,000,000 points; and of 10,000,000 points all but
normals, k = 20, for this processor, by the two peers that are the fastest on fewer. Those are measured
in one round.
"""


def nanoseconds(row):
    return 1e9 * row["seconds"] / row["points"]


def time_text(row):
    low, high = (1e9 * row[key] / row["points"] for key in ("seconds_low", "seconds_high"))
    return f"{nanoseconds(row):.0f} ({low:.0f} to {high:.0f})"


def segments_text(row):
    return f"{row['segments']:,}" if "segments" in row else "–"


def last_distance_text(row):
    return f"{row['last_distance']:.7f}"


EXTRAS = [
    ("gamma", gamma_text, gamma_known),
    ("Segments", segments_text, lambda rows: any("segments" in row for row in rows)),
    ("Mean distance to the last neighbor [m]", last_distance_text,
     lambda rows: any("last_distance" in row for row in rows)),
]


def is_timed(row):
    """Whether a row is of a whole cloud and of libraries, not of parts, threads or instructions."""
    return "/" not in row["cloud"] and "instructions" not in row and not is_gain(row)


def is_gain(row):
    return row["task"] == GAIN


def is_part(row):
    return "/" in row["cloud"]


# ---- Memory -------------------------------------------------------------------------------------

def memory_section(rows):
    """Bytes for a point of every library, at the largest k on one thread and the first flags."""
    parts = ["## Memory of normals\n",
             "Bytes for each point: what the result itself takes (gnomon's holds trust, spectrum "
             "and mean\ndistance for each normal; CGAL writes into the cloud), and what was "
             "needed in addition to it and the cloud.\nThe whole process has libraries and cloud, "
             "too.\n"]
    lines = []
    for own in sections_of(rows_at(rows, task="normals")):
        flags, k = own[-1]["flags"], max(row["k"] for row in own)
        for row in own:
            if (row["flags"], row["k"], row["threads"]) == (flags, k, 1):
                lines.append([tables.version_text(row), f"{row['points']:,}", str(k),
                              f"{row['result_bytes'] / row['points']:.0f}",
                              f"{extra_bytes(row):.0f}", f"{row['process_bytes'] / 1e6:,.0f} MB"])
    parts.append(markdown(["library", "points", "k", "result", "in addition", "whole process"], lines))
    return "\n".join(parts)


# ---- Scaling ------------------------------------------------------------------------------------

def growth(library, along, rows, key):
    """A line of the table: how the time of some rows grows with one of their numbers."""
    return [library, along, rows[0]["flags"],
            f"{exponent([(row[key], row['seconds']) for row in rows]):.2f}",
            " ".join(f"{nanoseconds(row):.0f}" for row in rows)]


def scaling_section(rows):
    parts = ["## Scaling\n",
             "Exponents p of time proportional to n^p and to k^p, fitted to logarithms; one thread. "
             "Parts of a\ncloud are taken evenly over it.\n"]
    lines = []
    growing = [row for row in rows if is_part(row) and row["seconds"]]
    libraries = unique(row["library"] for row in growing)
    for library in libraries:
        own = rows_at(growing, library=library)
        sizes = unique(row["points"] for row in own)
        if len(sizes) > 1:
            along = f"n, {min(sizes):,} to {max(sizes):,}, k = {own[0]['k']}"
            lines.append(growth(library, along, own, "points"))
    for cloud in sections_of(rows_at([row for row in rows if is_timed(row)], task="normals",
                                     threads=1)):
        for flags in unique(row["flags"] for row in cloud):
            for library in libraries:
                own = rows_at(cloud, library=library, flags=flags)
                ks = unique(row["k"] for row in own)
                if len(ks) > 1:
                    along = f"k, {min(ks)} to {max(ks)}, {own[0]['points']:,} points"
                    lines.append(growth(library, along, own, "k"))
    parts.append(markdown(["library", "along", "flags", "exponent", "ns for each point"], lines))
    return "\n".join(parts)


# ---- Two threads --------------------------------------------------------------------------------

GAINS = """\
## Two threads

How many times as long gnomon takes on one thread as on two for normals: medians, and the least and
greatest ratio of any turn; and what the two cores are worth at that time: how much two programs
of one thread each, side by side, get done in the time of one alone. More than this no program can
gain; on a machine that is shared with others it is not always 2.

What is lost: the first levels of the tree have too few parts to share, one thread makes the room for
the results, and the second is started again by each call, though only once.
"""


def gains_section(rows):
    lines = [[tables.CLOUDS.get(row["cloud"], row["cloud"]), row["flags"], str(row["k"]),
              f"{1e9 * row['seconds_of_one_thread'] / row['points']:.0f}", f"{nanoseconds(row):.0f}",
              f"{row['gain']:.2f} ({row['gain_low']:.2f} to {row['gain_high']:.2f})",
              f"{row['worth_of_cores']:.2f}", str(row["turns"])]
             for row in rows if row["seconds"]]
    return "\n".join([GAINS, markdown(
        ["cloud", "flags", "k", "one thread [ns for each point]", "two", "gain", "cores are worth",
         "turns"], lines)])


# ---- Instructions -------------------------------------------------------------------------------

def instructions_section(rows):
    counted = [row for row in rows if "instructions" in row]
    if not any(row["instructions"] for row in counted):
        why = counted[0]["note"] if counted else "no row has them"
        return f"## Instructions\n\nNot counted: {why}.\n"
    first = next(row for row in counted if row["instructions"])
    parts = ["## Instructions\n",
             f"For each of {first['points']:,} points, compiled with `{first['flags']}`: the same on "
             "every day.\n"]
    lines = [[f"{row['task']}, {row['library']}", str(row["k"]),
              f"{row['instructions'] / row['points']:,.0f}"]
             for row in counted if row["instructions"]]
    parts.append(markdown(["task", "k", "instructions"], lines))
    return "\n".join(parts)


# ---- The limit ----------------------------------------------------------------------------------

LIMIT = """\
## How far from the limit

A neighborhood of k points takes k distances at least, and it is not known beforehand which: all
nearby points are candidates. And each point must be read (24 bytes), copied into the tree (28 bytes
written and read again) and its result written ({result:.0f} bytes). Normals of {points:,} points, one
thread, `{flags}`:
"""

WHERE = """\
A straight line through these says that {base:.0f} ns go by whatever k is, and {slope:.1f} ns more for
each neighbor. Memory is not what it waits for: a core moves about ten bytes in a nanosecond, so that
these {bytes:.0f} bytes take some {move:.0f} ns.

Where the rest goes was looked at once, at k = 20 on 1,000,000 points, with AVX2. The tree takes a
fifth of the time, the search not quite half, sums, planes and writing a fifth, and the system a tenth
for memory that is touched for the first time. Counters that were built in for this say that each point
is compared with 48 boxes of leaves and 249 points, of which 39 pass; that two limits, between which
the 20th of these lies with seven others, are found in 1.3 counts; and that one more makes sure of it.
So there are 12 distances for each that is wanted, as the 32 points of a leaf are compared
together or not at all.
"""


def limit_section(rows):
    own = [some for some in sections_of(ours_at([row for row in rows if is_timed(row)],
                                                task="normals", threads=1))
           if len({row["k"] for row in some}) > 1]
    if not own:
        return ""
    largest = max(own, key=lambda some: some[0]["points"])
    flags = largest[-1]["flags"]
    largest = [row for row in largest if row["flags"] == flags]
    result = largest[0]["result_bytes"] / largest[0]["points"]
    moved = 24 + 2 * 28 + result
    lines = [[str(row["k"]), f"{nanoseconds(row):.0f}", f"{nanoseconds(row) / row['k']:.1f}",
              f"{moved:.0f}", f"{moved / nanoseconds(row):.2f}"] for row in largest]
    slope, base = statistics.linear_regression([row["k"] for row in largest],
                                               [nanoseconds(row) for row in largest])
    return "\n".join([
        LIMIT.format(result=result, points=largest[0]["points"], flags=flags),
        markdown(["k, and distances at least", "ns", "ns for each distance", "bytes at least",
                 "bytes in a ns"], lines),
        WHERE.format(base=base, slope=slope, bytes=moved, move=moved / 10)])


# ---- The page -----------------------------------------------------------------------------------

def verdicts_section(rows):
    verdicts = judged(rows)
    if without_verdict(rows):
        sys.exit(f"no verdict for {', '.join(sorted(without_verdict(rows)))}: see verdicts.py")
    known = [v for v in verdicts if v["holds"] is not None]
    held = sum(v["holds"] for v in known)
    unknown = len(verdicts) - len(known)
    rest = f"{unknown} of {len(verdicts)} were not measured.\n\n" if unknown else ""
    return (f"## {held} of {len(known)} wanted figures are reached\n\n{rest}"
            f"{table_of(verdicts)}")


def page(rows):
    """The whole page."""
    about = next(row for row in rows if row["library"] == OURS and row["seconds"])
    head = INTRODUCTION.format(cpu=about["cpu"], compiler=about["compiler"]) + busy_text(about)
    timed = [row for row in rows if is_timed(row)]
    sections = [section(own, times=("Nanoseconds for each point", time_text), extras=EXTRAS)
                for own in sections_of(timed)]
    gains = [row for row in rows if is_gain(row)]
    return "\n".join([head, verdicts_section(rows), *sections, gains_section(gains),
                      memory_section(timed), scaling_section(rows), instructions_section(rows),
                      limit_section(rows), METHOD])


def picture(rows):
    """One thread: a line for each task and cloud with several k, or else of normals; a panel for
    each set of flags."""
    timed = [row for row in rows if is_timed(row)]
    lines = [own for own in sections_of([row for row in timed if row["threads"] == 1])
             if own[0]["task"] == "normals" and len({row["k"] for row in own}) > 1]
    panels = [[(f"{tables.CLOUDS.get(own[0]['cloud'], own[0]['cloud'])}, {flags}",
                [row for row in own if row["flags"] == flags])
               for flags in unique(row["flags"] for row in own)] for own in lines]
    return tables.draw_panels(
        panels, f"Normals on {threads_text(1)}: how many times as long as {OURS} does each library "
                "take?")


tables.main("speed", page, picture)
