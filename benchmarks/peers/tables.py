# SPDX-License-Identifier: BSL-1.0
"""Tables and pictures that compare libraries, for all pages with rows like those of peers.json. The
output is a function of the rows, to the byte.

    page.py FOLDER             writes NAME.md and NAME.png from the NAME.json in a folder
    page.py --check FOLDER     fails if the page there is not up to date; exit status 77 if it is,
                               but Matplotlib, which the picture requires, is missing
"""

import argparse
import io
import json
import pathlib
import re
import sys

try:
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
except ImportError:
    pyplot = None

from turns import BUSY, GAIN, OFFICE, OURS

CLOUDS = {
    "kitchen": "a simulated kitchen",
    "kitchen_medium": "a simulated kitchen, thinned out",
    "kitchen_preprocessed": "a simulated kitchen without floor and ceiling",
    "kitchen_million": "a simulated kitchen, seen from nine places",
    "kitchen_ten_million": "a simulated kitchen, densely seen from nine places",
    OFFICE: "an office, seen by a Kinect",
}


def unique(items):
    """The items, each once, in the order of their first."""
    return list(dict.fromkeys(items))


def threads_text(count):
    return f"{count} thread" + ("s" if count > 1 else "")


def version_text(row):
    return f"{row['library']} ({row['version']})" if row["version"] else row["library"]


def markdown(heads, lines, rule="---:"):
    """A Markdown table: a column of words, then columns with the given alignment."""
    return "".join([f"| {' | '.join(heads)} |\n", f"|---|{f'{rule}|' * (len(heads) - 1)}\n",
                    *(f"| {' | '.join(line)} |\n" for line in lines)])


def table(rows, columns, cell):
    """A table with a line for each library. `columns` maps each heading to a predicate of its rows;
    cell(row) is the text for the first of them that was measured."""
    lines = []
    for library in unique(row["library"] for row in rows):
        own = [row for row in rows if row["library"] == library]
        if not any(row["seconds"] for row in own):
            texts = [own[0]["note"]] + [""] * (len(columns) - 1)
        else:
            texts = [next((cell(row) for row in own if belongs(row) and row["seconds"]), "–")
                     for belongs in columns.values()]
        lines.append([version_text(own[0]), *texts])
    return markdown(["library", *columns], lines)


def reach(row):
    """k, or the radius."""
    return row["radius"] if "radius" in row else row["k"]


def reach_text(row):
    return f"r = {100 * row['radius']:g} cm" if "radius" in row else f"k = {row['k']}"


def columns_of(rows):
    """A heading for each number of threads and neighbors, or radius."""
    first = {(row["threads"], reach(row)): row for row in reversed(rows)}
    return {f"{threads_text(row['threads'])}, {reach_text(row)}":
            lambda row, key=key: (row["threads"], reach(row)) == key
            for key, row in sorted(first.items())}


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
    """The comparison of gnomon with the fastest of the others, setting by setting."""
    best = {}
    for row in rows:
        if row["library"] != OURS and row["ratio"] is not None:
            setting = (row["flags"], row["threads"], reach(row))
            best[setting] = min(best.get(setting, row["ratio"]), row["ratio"])
    if not best:
        return "No other library was measured.\n"
    ratios = sorted(best.values())
    first = sum(ratio > 1 for ratio in ratios)
    return (f"Of {len(ratios)} settings gnomon is the fastest in {first}.\nThe fastest of the "
            f"others takes {ratios[0]:.2f} to {ratios[-1]:.2f} times as long as gnomon.\n")


def gamma_known(rows):
    return any(row["gamma"] for row in rows)


# Tables of quality and memory: title, text of a row, and whether any row has a value.
EXTRAS = [("gamma", gamma_text, gamma_known),
          ("Peak memory above the cloud", memory_text, lambda rows: True)]


def section(rows, times=("Milliseconds", time_text), extras=EXTRAS):
    """The section of one task and cloud."""
    task, cloud = rows[0]["task"], rows[0]["cloud"]
    title = f"## {task.capitalize()} of {CLOUDS.get(cloud, cloud)}\n"
    if rows[0]["library"] is None:
        return f"{title}\nNot measured: {rows[0]['note']}.\n"
    parts = [title, f"{rows[0]['points']:,} points. {conclusion(rows)}"]
    all_flags = unique(row["flags"] for row in rows)
    measured = {row["library"] for row in rows if row["seconds"]}
    shown = rows  # the first tables also list libraries that were not measured
    for name, cell in (("Ratios", ratio_text), times):
        for flags in all_flags:
            own = [row for row in shown if row["flags"] == flags]
            parts.append(f"{name}, compiled with `{flags}`:\n")
            parts.append(table(own, columns_of(own), cell))
        shown = [row for row in rows if row["library"] in measured]
    fewest = min(row["threads"] for row in rows)
    own = [row for row in shown if row["flags"] == all_flags[0] and row["threads"] == fewest]
    for name, cell, known in extras:
        if known(own):
            parts.append(f"{name}:\n")
            parts.append(table(own, columns_of(own), cell))
    return "\n".join(parts)


def sections_of(rows):
    """The rows of each task and cloud."""
    return [[row for row in rows if (row["task"], row["cloud"]) == key]
            for key in unique((row["task"], row["cloud"]) for row in rows)]


def busy_text(about):
    """A warning if other processes were using the machine."""
    if about["busy_cores"] <= BUSY:
        return ""
    return (f"\nOther processes used {about['busy_cores']:.1f} cores at the start, which increases the "
            "variance,\nmostly of times with several threads.\n")


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
            why = re.split("[;:]", own[0]["note"])[0]
            axes.text(1.05, libraries.index(library), why, va="center",
                      fontsize=8, color="gray")
    axes.axvline(1, color="black", linewidth=1, zorder=1)
    axes.set_axisbelow(True)
    axes.set_xscale("log")
    axes.set_yticks(range(len(libraries)), libraries)
    axes.set_ylim(len(libraries) - 0.5, -0.5)
    axes.grid(axis="x", color="0.9")


def draw_panels(panels, title):
    """The bytes of a picture of panels in rows and columns: (title, rows of libraries) each."""
    figure, grid = pyplot.subplots(
        len(panels), len(panels[0]), sharex=True, sharey=True, squeeze=False,
        layout="constrained", figsize=(5.2 * len(panels[0]), 0.6 + 3.2 * len(panels)))
    every = [row for line in panels for _, rows in line for row in rows]
    for line, places in zip(panels, grid):
        for (name, rows), axes in zip(line, places):
            draw(axes, rows)
            axes.set_title(name, fontsize=9)
    ticks = [0.25, 0.5, 1, 2, 4, 8, 16, 32]
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.set_xticks([], minor=True)
    ratios = [row[key] for row in every if row["ratio"] for key in ("ratio_low", "ratio_high")]
    axes.set_xlim(min(ratios) / 1.2, max(2.0, max(ratios)) * 1.2)
    handles = dict(zip(*reversed(grid[0][0].get_legend_handles_labels())))
    grid[0][-1].legend(handles.values(), handles.keys(), loc="upper right", fontsize=8)
    figure.suptitle(title)
    figure.supxlabel(f"time of the library / time of {OURS}; right of the line {OURS} is faster",
                     fontsize=10)
    file = io.BytesIO()
    figure.savefig(file, format="png", dpi=100, metadata={"Software": None})
    pyplot.close(figure)
    return file.getvalue()


def main(name, page, picture):
    """Writes or checks NAME.md, which page(rows) gives, and NAME.png, by picture(rows)."""
    parser = argparse.ArgumentParser(description=f"Writes the page of {name}.json.")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--check", action="store_true", help="compare, and write nothing")
    arguments = parser.parse_args()
    folder = arguments.folder
    try:
        rows = json.loads((folder / f"{name}.json").read_text(encoding="utf-8"))
    except OSError as problem:
        parser.error(str(problem))

    text = page(rows).encode()
    drawn = picture(rows) if pyplot else None
    if arguments.check:
        if (folder / f"{name}.md").read_bytes() != text:
            sys.exit(f"{name}.md is not up to date with {name}.json")
        if drawn is None:
            print("Matplotlib is missing: the picture was not checked")
            sys.exit(77)
        if drawn != picture(rows):
            sys.exit("two pictures of the same rows differ")
        return
    (folder / f"{name}.md").write_bytes(text)
    if drawn is None:
        print("Matplotlib is missing: no picture was drawn", file=sys.stderr)
    else:
        (folder / f"{name}.png").write_bytes(drawn)
