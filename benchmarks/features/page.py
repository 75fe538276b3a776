#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Writes the page of features from the measurements of its programs.

Reads DIR/features/*.json, and writes DIR/features.json (the relations with their verdicts),
DIR/features.md and, if matplotlib is installed, DIR/features.png. The first two are functions of the
measurements, to the byte; --check writes nothing and reports whether they are up to date.
"""

import pathlib
import sys

sys.dont_write_bytecode = True  # in a folder of sources
sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))

import pages  # noqa: E402
import relations  # noqa: E402,F401: enters the claims
from claims import judged  # noqa: E402

# Program, title, and what its tables are.
SECTIONS = [
    ("points", "Features of points",
     "Pairs of scans of 20 furnished rooms from one position. Places are points of any surface, at most ten of "
     "each, at which a fifth of the neighbors are truly 2 cm or more off the tangent plane: on flat surfaces, "
     "all places are equal. The place in the second scan is the truly nearest point of the same surface, within 5 cm; "
     "different places are on other surfaces of the same room. Normals are those of `plane_pca` on 50 neighbors, "
     "oriented; the neighbors of all other features are those within 20 cm. Curvature is compared by the "
     "Euclidean distance of both principal curvatures, and \"as printed\" by Eqs. (3.25) to (3.27), from which "
     "the types are determined, without tolerances. Descriptors are normalized, so that the number of points "
     "has no effect; the cylinder of a spin image is inscribed in the ball. Times are per point, on one thread, and with the search for its neighbors: descriptors "
     "find those of all points in one sweep over the index, the other features point by point; \"spin image of "
     "normals\" has the normals of the whole scan to prepare."),
    ("descriptors", "Descriptors compared with PCL",
     "Spin images of 9 by 17 entries with bilinear interpolation, and 3D shape contexts of 12 by 11 by 15 bins "
     "with Frome's densities, compared with `SpinImageEstimation` and `ShapeContext3DEstimation` of the Point Cloud "
     "Library 1.13, on the same points, radii and normals, on one thread. The box is 20,000 points on the surface of "
     "one of 1 m x 0.8 m x 0.6 m with noise of 2 mm, the room a whole scan with noise of 15 mm. Times are those of the "
     "processor, the least of several runs in turns, without the building of the index; each library finds the memory "
     "of its last result. The program fails unless "
     "spin images are equal bin by bin to 1e-5, and shape contexts in all but a thousandth of their sums over azimuths, "
     "whose reference PCL draws at random. \"Difference\" is the largest of a bin, or that share. PCL computes in "
     "float: images with a neighbor so near to a limit of the cylinder, or to its axis, that rounding decides are "
     "counted and not compared."),
    ("segments", "Features of segments",
     "Parts of the room and of its furniture with 100 points and more, as the simulator has them, so that no "
     "segmentation interferes. Different parts are those of another name in the same room, so that two legs "
     "of chairs are not different. Differences of lengths, areas and numbers are absolute, in m, m^2 and m^3; "
     "normals without a sign are axes. The second scan is from the same position, and in the tables \"from two "
     "positions\" from 60 cm to the left, where other points of a part are seen. As most features are almost "
     "always repeatable, the ratios are shown too: the median distance of the same part in both scans over that "
     "of different parts, 0 is best. Times are per part on one thread, without the normals of points, of which "
     "mean normal and mean surface variation are averages; one call gives the first eight features."),
    ("growth", "Time by the number of points",
     "The shapes of one segment of 100,000 and of 1,000,000 points with noise of 5 mm: a wall of 4 m x 2.5 m with a "
     "door, half of a sphere of 0.5 m, of a cylinder of 0.1 m and of a cone. Times are those of the processor, "
     "medians of seven turns, in memory that the process keeps; in a turn the small segment is measured ten times, "
     "as long as the large one, so that a busy machine disturbs both alike."),
    ("zernike", "Zernike descriptors",
     "480 scans of one piece of furniture each, from 1.2 to 3 m away, with noise of 15 mm: the mean distance of "
     "the same part, such as seats of one model of chair, in different views, over that of different parts. "
     "Parts have 50 points and more; extended ones an aspect ratio of 0.2 or more, which leaves out legs. The "
     "five basic features are mean height, inclination, surface variation, aspect ratio and volume of the "
     "principal box, each of the range [0, 1], by the Manhattan distance. The Zernike descriptors are of order "
     "5: of points as masses in a ball of twice their root mean square distance (the default), of the ball that "
     "encloses all of them, and of 32 voxels along its diameter."),
    ("rectangles", "Edges of flat surfaces",
     "The rectangle of smallest area around the points of a flat surface, with noise of 15 mm, compared with that "
     "around the same points without noise. Planes are those of `estimate_planes`. With view points they are of "
     "maximum likelihood, and points are moved to them along their rays. Without view points planes are those of "
     "smallest variance and points are projected along the normal: the noise that remains in the plane makes the "
     "rectangle too large, as the outermost points determine it. Surfaces are the true ones "
     "with 200 points and more: joined faces as on the page of surfaces, of 20 furnished rooms, and of all "
     "models of furniture alone, seen from 2 m in 8 directions. Edges are right if both are within 2 cm and the "
     "spacing, the median distance of a point to its nearest neighbor; axes if they are within 2 degrees, "
     "modulo 90. Excess is the mean error of both edges with its sign. Surfaces are oblique if the ray to their "
     "center is more than 45 degrees from their normal, rectangular if their outline fills 90 % of the "
     "rectangle, disks if it fills 78.5 % within 2 % and the edges are equal within 2 %: these have no axes, and "
     "each gap between their points may turn the rectangle."),
    ("rooms", "Lengths of rooms",
     "40 furnished rooms with doors and windows, scanned all around from a place near the middle with 194,400 "
     "rays half a degree apart, measured by the code of the example `measure_a_room`: distances of opposite "
     "walls, and of floor and ceiling, lengths along walls from corner to corner, and widths, heights and sills of "
     "openings. The constants of the example were chosen on other rooms. An opening counts as found if a measured "
     "one is within half a metre of its center; edges that furniture hides are not measured."),
]
PROGRAMS = [program for program, _, _ in SECTIONS]


def page(results, verdicts):
    context = next(iter(results.contexts.values()))
    lines = ["# Features and descriptors", "",
             "<!-- Written by benchmarks/features/page.py from features/*.json: do not edit. -->", ""]
    if results.quick:
        lines += ["**Measured with `--quick`: few rooms. A test of the programs, not a result.**", ""]
    lines += [
        "The features of points and segments of Klasing 2010, Secs. 3.3 to 3.5, against noise and density of "
        "simulated scans, by one command:", "", "    sh benchmarks/reproduce.sh features", "",
        "A feature is repeatable if two scans with independent noise give the same place, or the same segment, "
        "more similar values than different ones. **Repeatability** is 2 P - 1, where P is the probability that "
        "the distance of the same is below that of different ones: 1 if it always is, 0 if the feature does not "
        "distinguish them. It depends on the order of the distances alone, so features of any unit and number of "
        "entries are comparable. The sensor of the second scan is turned by a fraction of the distance of scan "
        "lines, so that without noise the sampling differs all the same. \"Half\" and \"double\" are half and "
        "twice as many scan lines. The rooms are used for nothing else.", "",
        f"{context['processor']}, {context['compiler']}, flags `{context['flags']}`. Times are those of the "
        "processor, medians of seven runs. The results of each program are in [features/](features/), the "
        "relations in [features.json](features.json).", "",
        "![Repeatability of features by noise](features.png)", "",
        *pages.heading(verdicts)]
    for program, title, about in SECTIONS:
        if program not in results.tables:
            if program == "descriptors":
                lines += [f"## {title}", "", "Left out: PCL was not found.", ""]
            continue
        lines += [f"## {title}", "", f"{about} `{program} --out DIR`", ""]
        for name, rows in results.tables[program].items():
            lines += [f"{name[0].upper()}{name[1:]}:", "", *pages.table_of(rows)]
        lines += pages.relations(verdicts, program)
    return "\n".join(lines).rstrip() + "\n"


def draw(results, path):
    """One panel of points and one of segments: a line for each feature over the noise."""
    try:
        import matplotlib
        matplotlib.use("agg")
        import matplotlib.pyplot as plt
    except ImportError:
        print("matplotlib is missing: no picture drawn")
        return
    panels = [("points", "by noise", "repeatability of points"),
              ("segments", "ratios of distances", "same / different, of segments")]
    figure, grid = plt.subplots(1, 2, figsize=(12, 5), layout="constrained")
    colors = matplotlib.colormaps["viridis"]
    for axes, (program, name, label) in zip(grid, panels):
        rows = results.tables.get(program, {}).get(name, [])
        for k, row in enumerate(rows):
            noises = [column for column in row if column.endswith(" mm")]
            axes.plot([float(n.split()[0]) for n in noises], [row[n] for n in noises],
                      marker="osD^v"[k % 5], markersize=4, linewidth=1, label=row["feature"],
                      color=colors(0.9 * k / max(1, len(rows) - 1)))
        axes.set_xlabel("noise [mm]")
        axes.set_ylabel(label)
        axes.grid(color="0.9")
        if rows:
            axes.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5))
    grid[0].set_ylim(0, 1)
    grid[1].set_yscale("symlog", linthresh=1e-3)
    figure.savefig(path, dpi=100, metadata={"Software": None})
    plt.close(figure)


def read(folder):
    return pages.Results(folder, PROGRAMS)


def make(folder):
    results = read(folder)
    verdicts = judged(results.tables)
    return pages.relations_as_json(verdicts), page(results, verdicts), pages.summary_of(verdicts)


if __name__ == "__main__":
    sys.exit(pages.run(__doc__, PROGRAMS, "features", make,
                       lambda folder, out: draw(read(folder), out / "features.png")))
