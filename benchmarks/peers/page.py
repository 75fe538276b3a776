#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Makes peers.md and peers.png of the peers.json in a folder; see tables.py."""

import sys

sys.dont_write_bytecode = True  # in a folder of sources

import tables  # noqa: E402
from tables import OURS, busy_text, section, sections_of, threads_text, unique  # noqa: E402

INTRODUCTION = """\
# Beside other libraries

`sh benchmarks/reproduce.sh peers`

The same clouds through gnomon and other libraries, in turns on the same machine. A ratio is a
library's time over gnomon's in the same run: above 1 gnomon is faster, below 1 the other one. Only
ratios mean anything elsewhere, and even they depend on the processor and the compiler, here
{cpu} and {compiler}.

![How many times as long as gnomon each library takes](peers.png)
"""

METHOD = """\
## How it was measured

- What counts: building the tree, searching, fitting, and writing the normals. What does not:
  bringing the points into the container that the library wants, which gnomon, nanoflann and Open3D
  have no need of; this is generous to PCL, CGAL and ANN.
- k neighbors beside the point itself, for every library: PCL, Open3D, nanoflann and ANN, which find
  the point, too, are asked for k + 1. Defaults otherwise. The points stay in the order of the scan.
- Every library has a program of its own, compiled twice by the same compiler from the same source.
  PCL, Open3D, ANN and GSL are the system's packages, compiled for every processor of the family:
  flags reach only what stands in their headers. PCL computes in float, all others in double.
- One warm-up, then rounds in which all libraries take their turns, each round beginning with
  another one. A program may use as many cores as threads, no more. Times are medians, in brackets
  the fastest and the slowest round; bars in the picture span the ratios of the single rounds.
- gamma is the mean over all points of the cosine between normal and true normal, 1 being perfect.
  Memory is how far the resident set rose during the warm-up: tree, working storage and result, but
  not the cloud. gnomon's result holds trust, spectrum and mean distance beside each normal.
- gnomon: `estimate_normals(points, knn{}, plane_pca{}, threads{})`. nanoflann + Eigen: a plain loop
  with OpenMP. ANN + GSL: the tool chain of the thesis, a singular value decomposition for each
  point; ANN keeps the state of a search in global variables and so has one thread. CGAL jet fits
  quadrics, a richer model.
"""


def page(rows):
    """The whole page."""
    about = next(row for row in rows if row["library"] == OURS)
    head = INTRODUCTION.format(cpu=about["cpu"], compiler=about["compiler"]) + busy_text(about)
    return "\n".join([head, *map(section, sections_of(rows)), METHOD])


def picture(rows):
    """The first task and cloud: a panel for each number of threads and each set of flags."""
    rows = sections_of(rows)[0]
    panels = [[(f"{threads_text(count)}, {flags}",
                [row for row in rows if row["threads"] == count and row["flags"] == flags])
               for flags in unique(row["flags"] for row in rows)]
              for count in unique(row["threads"] for row in rows)]
    return tables.draw_panels(
        panels, f"{rows[0]['task'].capitalize()} of {rows[0]['points']:,} points: how many times as "
                f"long as {OURS} does each library take?")


tables.main("peers", page, picture)
