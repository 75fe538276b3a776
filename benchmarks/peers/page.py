#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Writes peers.md and peers.png from the peers.json in a folder; see tables.py."""

import sys

sys.dont_write_bytecode = True  # in a folder of sources

import tables  # noqa: E402
from tables import OURS, busy_text, section, sections_of, threads_text, unique  # noqa: E402

INTRODUCTION = """\
# Comparison with other libraries

`sh benchmarks/reproduce.sh peers`

Normals of the same clouds by gnomon and other libraries, in turns on the same machine. A ratio is the
time of a library over the time of gnomon in the same run: above 1 gnomon is faster, below 1 the other
library. Only ratios can be compared with other machines, and they still depend on the processor and
the compiler, here {cpu} and {compiler}.

![Time of each library over the time of gnomon](peers.png)
"""

METHOD = """\
## How it was measured

- Timed are the construction of the tree, the search, the fits, and the storage of the normals. Not
  timed is the conversion of the points into the container of the library, which gnomon, nanoflann and
  Open3D do not require; this favors PCL, CGAL and ANN.
- Every library uses k neighbors without the point itself: PCL, Open3D, nanoflann and ANN, which also
  find the point, search for k + 1. All other parameters have their defaults. The points stay in the
  order of the scan.
- Every library has a program of its own, compiled twice by the same compiler from the same source.
  PCL, Open3D, ANN and GSL are packages of the system, compiled for every processor of the family: the
  flags apply to the code in their headers only. PCL computes in float, all others in double.
- One warm-up, then rounds in which each library runs once; each round begins with another library. A
  program may use as many cores as threads. Times are medians, in brackets the fastest and the slowest
  round; bars in the picture span the ratios of the single rounds.
- gamma is the mean over all points of the cosine between normal and true normal; 1 is perfect. Memory
  is the increase of the resident set during the warm-up: tree, working memory and result, without the
  cloud. The result of gnomon has trust, spectrum and mean distance in addition to each normal.
- gnomon: `estimate_normals(points, knn{}, plane_pca{}, threads{})`. nanoflann + Eigen: a plain loop
  with OpenMP. ANN + GSL: the libraries of the thesis, with a singular value decomposition for each
  point; ANN keeps the state of a search in global variables and therefore has one thread. CGAL jet
  fits quadrics, a richer model.
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
        panels, f"{rows[0]['task'].capitalize()} of {rows[0]['points']:,} points: time of each "
                f"library over the time of {OURS}")


tables.main("peers", page, picture)
