#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Makes peers.md and peers.png of the peers.json in a folder; the same bytes of the same rows.

    page.py FOLDER             writes them beside it
    page.py --check FOLDER     compares the page there with what its rows make; leaves with 77 if
                               it agrees, but Matplotlib, which the picture needs, is missing
"""

import argparse
import io
import json
import pathlib
import sys

try:
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
except ImportError:
    pyplot = None

OURS = "gnomon"

CLOUDS = {
    "kitchen": "a simulated kitchen",
    "kitchen_medium": "a simulated kitchen, thinned out",
    "pcl_office1_kinect.pcd": "an office, seen by a Kinect",
}

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


def unique(items):
    """The items, each once, in the order of their first."""
    return list(dict.fromkeys(items))


def threads_text(count):
    return f"{count} thread" + ("s" if count > 1 else "")


def version_text(row):
    return f"{row['library']} ({row['version']})" if row["version"] else row["library"]


def table(rows, columns, cell):
    """A table of Markdown with a line for each library. `columns` tells of each heading which rows
    it is of; cell(row) is what to print of the first of them that was measured."""
    lines = ["| library | " + " | ".join(columns) + " |", "|---|" + "---:|" * len(columns)]
    for library in unique(row["library"] for row in rows):
        own = [row for row in rows if row["library"] == library]
        if not any(row["seconds"] for row in own):
            texts = [own[0]["note"]] + [""] * (len(columns) - 1)
        else:
            texts = [next((cell(row) for row in own if belongs(row) and row["seconds"]), "–")
                     for belongs in columns.values()]
        lines.append(f"| {version_text(own[0])} | " + " | ".join(texts) + " |")
    return "\n".join(lines) + "\n"


def columns_of(rows):
    """A heading for each number of threads and neighbors."""
    pairs = sorted({(row["threads"], row["k"]) for row in rows})
    return {f"{threads_text(threads)}, k = {k}":
            lambda row, pair=(threads, k): (row["threads"], row["k"]) == pair
            for threads, k in pairs}


def ratio_text(row):
    return f"{row['ratio']:.2f}"


def time_text(row):
    low, median, high = (1000 * row[key] for key in ("seconds_low", "seconds", "seconds_high"))
    return f"{median:.0f} ({low:.0f} to {high:.0f})"


def gamma_text(row):
    return f"{row['gamma']:.4f}"


def memory_text(row):
    return f"{row['peak_bytes'] / 1e6:.1f} MB"


def conclusion(rows):
    """How gnomon does beside the best of the others, setting by setting."""
    best = {}
    for row in rows:
        if row["library"] != OURS and row["ratio"] is not None:
            setting = (row["flags"], row["threads"], row["k"])
            best[setting] = min(best.get(setting, row["ratio"]), row["ratio"])
    if not best:
        return "There was no other library to compare with.\n"
    ratios = sorted(best.values())
    first = sum(ratio > 1 for ratio in ratios)
    return (f"Of {len(ratios)} settings gnomon is the fastest in {first}.\nThe fastest of the "
            f"others takes {ratios[0]:.2f} to {ratios[-1]:.2f} times as long as gnomon.\n")


def section(rows):
    """What there is to say of one task and cloud."""
    task, cloud = rows[0]["task"], rows[0]["cloud"]
    title = f"## {task.capitalize()} of {CLOUDS.get(cloud, cloud)}\n"
    if rows[0]["library"] is None:
        return f"{title}\nNot measured: {rows[0]['note']}.\n"
    parts = [title, f"{rows[0]['points']:,} points. {conclusion(rows)}"]
    all_flags = unique(row["flags"] for row in rows)
    measured = {row["library"] for row in rows if row["seconds"]}
    shown = rows  # the first tables say of what is missing that it is
    for name, cell in (("Ratios", ratio_text), ("Milliseconds", time_text)):
        for flags in all_flags:
            own = [row for row in shown if row["flags"] == flags]
            parts.append(f"{name}, compiled with `{flags}`:\n")
            parts.append(table(own, columns_of(own), cell))
        shown = [row for row in rows if row["library"] in measured]
    own = [row for row in shown if row["flags"] == all_flags[0] and row["threads"] == 1]
    tables = {"gamma": gamma_text, "Peak memory above the cloud": memory_text}
    if not any(row["gamma"] for row in own):
        del tables["gamma"]  # where the truth is not known
    for name, cell in tables.items():
        parts.append(f"{name}:\n")
        parts.append(table(own, columns_of(own), cell))
    return "\n".join(parts)


def sections_of(rows):
    """The rows of each task and cloud."""
    return [[row for row in rows if (row["task"], row["cloud"]) == key]
            for key in unique((row["task"], row["cloud"]) for row in rows)]


def page(rows):
    """The whole page."""
    about = next(row for row in rows if row["library"] == OURS)
    head = INTRODUCTION.format(cpu=about["cpu"], compiler=about["compiler"])
    if about["busy_cores"] > 0.2:
        head += (f"\nOther work kept {about['busy_cores']:.1f} cores busy when this began, which "
                 "makes the figures scatter,\nmost of all those of several threads.\n")
    return "\n".join([head, *map(section, sections_of(rows)), METHOD])


def draw(axes, rows):
    """One panel: for each library a dot for each k, at its ratio."""
    libraries = unique(row["library"] for row in rows if row["library"] != OURS)
    ks = sorted({row["k"] for row in rows})
    shades = matplotlib.colormaps["viridis"]
    for row in rows:
        if row["library"] == OURS or row["seconds"] is None:
            continue
        step = ks.index(row["k"])
        height = libraries.index(row["library"]) + 0.16 * (step - (len(ks) - 1) / 2)
        color = shades(0.85 * (1 - step / max(1, len(ks) - 1)))
        axes.plot([row["ratio_low"], row["ratio_high"]], [height, height], color=color, zorder=2)
        axes.plot(row["ratio"], height, "o", color=color, zorder=3, label=f"k = {row['k']}")
    for library in libraries:
        own = [row for row in rows if row["library"] == library]
        if not any(row["seconds"] for row in own):
            axes.text(1.05, libraries.index(library), own[0]["note"].split(";")[0], va="center",
                      fontsize=8, color="gray")
    axes.axvline(1, color="black", linewidth=1, zorder=1)
    axes.set_axisbelow(True)
    axes.set_xscale("log")
    axes.set_yticks(range(len(libraries)), libraries)
    axes.set_ylim(len(libraries) - 0.5, -0.5)
    axes.grid(axis="x", color="0.9")


def picture(rows):
    """The bytes of a picture of one task and cloud."""
    all_flags = unique(row["flags"] for row in rows)
    counts = unique(row["threads"] for row in rows)
    figure, panels = pyplot.subplots(
        len(counts), len(all_flags), sharex=True, sharey=True, squeeze=False, layout="constrained",
        figsize=(5.2 * len(all_flags), 0.6 + 3.2 * len(counts)))
    for count, line in zip(counts, panels):
        for flags, axes in zip(all_flags, line):
            draw(axes, [row for row in rows
                        if row["threads"] == count and row["flags"] == flags])
            axes.set_title(f"{threads_text(count)}, {flags}", fontsize=10)
    ticks = [0.25, 0.5, 1, 2, 4, 8, 16, 32]
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.set_xticks([], minor=True)
    ratios = [row[key] for row in rows if row["ratio"] for key in ("ratio_low", "ratio_high")]
    axes.set_xlim(min(ratios) / 1.2, max(2.0, max(ratios)) * 1.2)
    handles = dict(zip(*reversed(panels[0][0].get_legend_handles_labels())))
    panels[0][-1].legend(handles.values(), handles.keys(), loc="upper right", fontsize=8)
    figure.suptitle(f"{rows[0]['task'].capitalize()} of {rows[0]['points']:,} points: how many "
                    f"times as long as {OURS} does each library take?")
    figure.supxlabel(f"time of the library / time of {OURS}; right of the line {OURS} is faster",
                     fontsize=10)
    file = io.BytesIO()
    figure.savefig(file, format="png", dpi=100, metadata={"Software": None})
    pyplot.close(figure)
    return file.getvalue()


def main():
    parser = argparse.ArgumentParser(description="Makes the page of peers.json.")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--check", action="store_true", help="compare, and write nothing")
    arguments = parser.parse_args()
    folder = arguments.folder
    try:
        rows = json.loads((folder / "peers.json").read_text(encoding="utf-8"))
    except OSError as problem:
        parser.error(str(problem))

    text = page(rows).encode()
    drawn = picture(sections_of(rows)[0]) if pyplot else None
    if arguments.check:
        if (folder / "peers.md").read_bytes() != text:
            sys.exit("peers.md is not what peers.json makes")
        if drawn is None:
            print("Matplotlib is missing: the picture was not checked")
            sys.exit(77)
        if drawn != picture(sections_of(rows)[0]):
            sys.exit("two pictures of the same rows differ")
        return
    (folder / "peers.md").write_bytes(text)
    if drawn is None:
        print("Matplotlib is missing: no picture was drawn", file=sys.stderr)
    else:
        (folder / "peers.png").write_bytes(drawn)


main()
