#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Writes the page of chapter 5 from the measurements of its programs.

Reads DIR/chapter5/*.json, and writes DIR/chapter5.json (the relations with their verdicts),
DIR/chapter5.md and, if matplotlib is installed, DIR/chapter5.png. The first two are functions of the
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
    ("fig_5_5", "Fig. 5.5: words",
     "The dictionary of the thesis: greedy means clustering of the five features of all parts of 480 views, Alg. 5.1, "
     "with weights 0.30, 0.30, 0.13, 0.13, 0.13; words have 4 parts or more. The simulator gives the true part of each segment. "
     "Relation words are counted over pairs of parts of the same view: the critical mass is the least share of the "
     "values of a pair of words in the fullest bin (36 bins of angles, 5 cm of distances), the support the least "
     "number of values. Words are tested for a normal distribution if they have 8 parts or more, at a significance "
     "level of 5 %, divided by the number of features or of statistics where several are tested. Purity is the "
     "share of parts that are of the most frequent kind (\"leg\") of their cluster, or of its most frequent part of "
     "one model; more clusters are purer, so x-means is also run with as many clusters at most as greedy means. The "
     "most frequent words are those of the first seed, all else are medians."),
    ("fig_5_8", "Figs. 5.7 and 5.8: the method of the thesis",
     "Word histograms as in Secs. 5.2 to 5.4, rho 0.03 unless given: with parts from 50 neighbors and segments of 30 "
     "points and more, as in the thesis. Repairs are documented in [the notes on the thesis](../thesis-notes.md): "
     "relations that are missing count as evidence; each part votes for its nearest word only; covariances of words "
     "are shrunk to that of all words. Repaired is the method with the first one, on segments of 15 points and "
     "more where given: on other seeds this was the most precise one at equal missed views. With hidden versions, each view is learned "
     "together with two of its scan of which a part is hidden, as in the recommended mode: three times as many parts, "
     "of which rho 0.02 makes finer words. At rho 0 words have one part and more, and each part is a word. Precision at "
     "30.4 % missed is that of the most certain 69.6 % of views, whatever their probability, so that methods are "
     "compared at the undecided views of the thesis."),
    ("default_mode", "The recommended mode",
     "`object_recognizer` with its defaults, and soft words (`part_kernels`). It is taught each view "
     "together with two versions of its scan of which a part is hidden by `hide_part`. Fresh views are of the same "
     "models in other poses; those that differ in duration, noise or occlusion only have the same poses. Times of "
     "decisions are those of the processor, of one thread; learning is with all threads, on the wall clock, "
     "next to other work of the machine."),
    ("occlusion", "Fig. 5.11: occluded objects",
     "A board in front of the object hides a share of its points, on the left, on the right or at the bottom. All "
     "methods learn the same views with the same two versions of which a part is hidden, but for the thesis "
     "as printed, which learns the views alone, and the peers once more without. VFH and ESF are of PCL, with the nearest neighbor by the sum of absolute "
     "differences; they have no probability, and decide on all views. The height profile is that of all points of the "
     "scan, without any parts, with the same trees as the default. The repaired method of the thesis has seen hidden versions, too, "
     "and does not count parts."),
    ("fig_5_11", "Fig. 5.11: examples",
     "Three models as in the thesis, by the recommended mode and one seed: how many of their views are recognized though a "
     "board hides half of the points, and a picture of the first such view of each, with the points that the board hides, "
     "taken from a scan without it."),
    ("skimmed", "Sec. 5.8.4: skimmed points",
     "Scans by a beam of 10 mrad, of 9 sub-rays, that averages the ranges of all surfaces that it meets, tested "
     "after learning scans by thin beams, and after learning both. Where the width of the beam is given, points "
     "at silhouettes are removed first (`remove_silhouettes`)."),
    ("backs", "Models that differ in their backs only",
     "Four chairs of the same seat, legs and back, which stands at the rear edge, 8 or 16 cm inwards, or 12 cm "
     "to the side, up to 3 m ahead, where seats are seen: 120 views of each to learn, and the same number to test."),
    ("furniture_files", "Furniture from files",
     "Chairs, tables and other furniture from mesh files of two sources. Models are left out, a fifth at a time, "
     "of each class alike, in an order of the seed; the views of a left-out model are classified by a recognizer that "
     "never saw it, which has learned classes, or models whose probabilities are added by class. \"Chair, table\": "
     "which of both is more probable, of views of chairs and tables. Fresh views are of models that were learned, by "
     "their names."),
    ("unknown", "What was not learned",
     "All models in six random pairs of each seed, of which each is withheld once: a recognizer of the other ten "
     "judges how novel the test views of all twelve are (`view_novelty`). AUROC is the probability that a view of a "
     "withheld model is more novel than one of a known model. Views are rejected if they are more novel than 95 % of the "
     "learned views; the rejected ones, known or not, are grouped without a number of groups, and the V-measure compares the "
     "groups with the models. Fallen furniture lies on its back, its front or either side, and is recognized by its "
     "model, or by its class: chair, stool or table. The invariant features need no ground, and there is no height profile with "
     "them."),
    ("offices", "Sec. 5.8.4: a real office",
     "A real scan of an office, from all sides, by a recognizer that has learned ten views of each of other models, "
     "simulated: `furniture_models()` but the stool, the mesh files of `furniture_files`, 16 `office_chairs()`, 16 "
     "`office_tables()` and 48 `clutter_models()`, as chair, table or background, by thin beams or by beams of 10 "
     "mrad, too; each view is learned in parts and as one part. None of its objects is among the models, but it is "
     "no scan that nothing was chosen on: office chairs, long tables with things on them, and views as one part were "
     "added to what is learned after trials on this scan, with other seeds. Objects are right "
     "if their class is decided at P_d 0.90, and screen and cabinet if neither chair nor table is. Their segments are "
     "the labeled parts, or an object is the group of `perceive_views` that most of its points are in. Probability is "
     "that of the true class, median and least of all seeds. Real over simulated: the share of chairs and tables "
     "that are right, all seeds together, over that of fresh simulated views of the learned models."),
    ("rooms", "Fig. 5.10: whole rooms",
     "40 rooms of each seed with four pieces of furniture and about 20 groups of clutter, and 10 further ones in which "
     "objects touch walls and each other; 30 more of these have a row of their own, since those 10 have some 38 objects only. All are scanned from a wall by a beam of 10 mrad that averages. Objects of 60 points "
     "and more count. Thesis grouping makes one view of all points but mixed ones (`remove_mixed_points`) with steps of 10 cm at "
     "most, Sec. 5.5.1, and decides by "
     "the recommended mode at P_d 0.90; it has learned other things as background. Voting and verification "
     "(`object_finder`) knows the surfaces of the models, has learned 120 views of each, of which 40 vote, and decides at "
     "a probability of 0.5. Precision is the share of right "
     "ones of the decided objects, a second one on the same piece being wrong; recall is the share of all pieces that "
     "were found; accuracy is the share of views that are decided rightly, or rejected and background; whole is the share of "
     "pieces of which one group has 80 % of the points, and hardly others. Poses are those of right objects of 200 "
     "points and more, up to the symmetry of the model; NEES are those of poses that are right and that the points "
     "determine: the mean of each seed, and the median of single ones. Both know the noise and the width of the beams. "
     "Hypotheses are offered at each piece of 200 points and more of the cluttered rooms: all models, at most 5 cm and 10 degrees off, in four headings of which the most "
     "probable one counts. Times are those of the processor, all threads together; the time of a room is the one that passes, for "
     "scans of half as many points."),
]
PROGRAMS = [program for program, _, _ in SECTIONS]


def processors_of(contexts):
    """The processors on which the programs ran: times of programs on different ones are not to be compared."""
    programs = {}
    for program, context in contexts.items():
        programs.setdefault(context["processor"], []).append(program)
    if len(programs) == 1:
        return next(iter(programs))
    return "; ".join(f"{processor} ({', '.join(names)})" for processor, names in programs.items())


def page(results, verdicts):
    context = next(iter(results.contexts.values()))
    lines = ["# Recognition of objects", "",
             "<!-- Written by benchmarks/chapter5/page.py from chapter5/*.json: do not edit. -->", ""]
    if results.quick:
        lines += ["**Measured with `--quick`: few views. A test of the programs, not a result.**", ""]
    lines += [
        "Chapter 5 of Klasing 2010 on simulated views, compared with the recommended mode of this library, by one "
        "command:", "", "    sh benchmarks/reproduce.sh chapter5", "",
        "The twelve models of `furniture_models()` stand alone, without floor or board unless given, in front of a "
        "UTM-30LX at a height of 1.2 m, which scans them vertically for 8 s with a noise of 5 mm: 0.5 to 5.5 m ahead, "
        "up to 2.5 m to the sides, never nearer than 1.2 m, at any heading. 40 views of each model are learned, and "
        "40 others classified. All is repeated with five seeds, which nothing was chosen on: values are medians, and those "
        "of the worst seed where given.", "",
        "A view is decided if the probability of the best class is P_d = 0.90 or more. **Precision** is the share of "
        "right ones of the decided views, **missed** the share of undecided ones of all views, **right** that of the "
        "right and decided, and **top 1** that of right best classes, however probable. Views without parts are "
        "missed. ECE is the expected calibration error.", "",
        f"{processors_of(results.contexts)}, {context['compiler']}, flags `{context['flags']}`. The results of each program are in "
        "[chapter5/](chapter5/), the relations in [chapter5.json](chapter5.json).", "",
        "![Precision by rho and by missed views, recognition by hidden share, and Fig. 5.10 for rooms](chapter5.png)", "",
        *pages.heading(verdicts)]
    for program, title, about in SECTIONS:
        if program not in results.tables:
            continue
        lines += [f"## {title}", "", f"{about} `{program} --out DIR`", ""]
        for name, rows in results.tables[program].items():
            lines += [f"{name[0].upper()}{name[1:]}:", "", *pages.table_of(rows)]
        lines += pages.relations(verdicts, program)
        if program == "fig_5_11":
            lines += ["![A chair, a table and an armchair, half of each hidden](chapter5/fig_5_11.png)", ""]
    return "\n".join(lines).rstrip() + "\n"


def draw_by_rho(axes, rows):
    rows = [r for r in rows if r["rho"] > 0]
    rhos = [r["rho"] for r in rows]
    axes.plot(rhos, [r["precision"] for r in rows], "o-", label="precision at P_d 0.90")
    axes.plot(rhos, [r["missed"] for r in rows], "s-", label="missed at P_d 0.90")
    axes.plot(rhos, [r["precision at 30.4 % missed"] for r in rows], "D-",
              label="precision at 30.4 % missed")
    axes.plot([0.03], [0.955], "k*", markersize=10, label="the thesis: precision, missed")
    axes.plot([0.03], [0.304], "k*", markersize=10)
    axes.set_xscale("log")
    axes.set_xticks(rhos, [f"{r:g}" for r in rhos], fontsize=7)
    axes.minorticks_off()
    axes.set_ylim(0, 1.02)
    axes.set_xlabel("rho_max of the words")
    axes.set_title("The thesis as printed (Fig. 5.8)")


def draw_by_probability(axes, rows):
    for views in dict.fromkeys(r["views"] for r in rows):
        own = [r for r in rows if r["views"] == views]
        line, = axes.plot([r["missed"] for r in own], [r["precision"] for r in own], "o-",
                          markersize=4, label=views)
        usual = next(r for r in own if r["P_d"] == 0.9)
        axes.plot(usual["missed"], usual["precision"], "o", markersize=9, color=line.get_color())
    axes.plot([0.304], [0.955], "k*", markersize=10, label="the thesis")
    axes.set_xlabel("missed views, by P_d from 0 to 0.99 (large: 0.90)")
    axes.set_ylabel("precision")
    axes.set_title("The recommended mode")


def draw_by_hidden(axes, rows, column, title):
    methods = [m for m in dict.fromkeys(r["method"] for r in rows) if "nothing hidden" not in m]
    if column == "right":  # nearest neighbors decide on all views
        methods = [m for m in methods if "nearest" not in m]
    for k, method in enumerate(methods):
        own = [r for r in rows if r["method"] == method]
        axes.plot([100 * r["hidden"] for r in own], [r[column] for r in own],
                  marker="osD^v<>"[k % 7], markersize=4, label=method)
    axes.set_ylim(0, 1.02)
    axes.set_xlabel("hidden points [%]")
    axes.set_title(title)


def draw_rooms(axes, rows, rooms):
    """Fig. 5.10: each measure in one color, each method in one style."""
    methods = {"voting and verification": "o-", "thesis grouping": "s--"}
    for color, measure in enumerate(("accuracy", "precision", "recall")):
        for method, style in methods.items():
            own = [r for r in rows if r["rooms"] == rooms and r["method"] == method]
            axes.plot([r["P_d"] for r in own], [r[measure] for r in own], style, color=f"C{color}",
                      markersize=4, label=f"{measure}, {method}")
    if rooms == "cluttered":
        for color, value in enumerate((0.90, 0.86, 0.43)):
            axes.plot(0.9, value, "*", color=f"C{color}", markersize=12, markeredgecolor="k")
        axes.plot([], [], "k*", markersize=10, label="the thesis, on real scans")
    axes.set_ylim(0, 1.02)
    axes.set_xlabel("P_d")
    axes.set_title(f"Fig. 5.10: {rooms} rooms")


def draw(results, path):
    """By rho, by P_d, by the hidden share (the best class and the decisions), and rooms by P_d."""
    try:
        import matplotlib
        matplotlib.use("agg")
        import matplotlib.pyplot as plt
    except ImportError:
        print("matplotlib is missing: no picture drawn")
        return
    figure, grid = plt.subplots(3, 2, figsize=(12, 13.5), layout="constrained")

    def rows(program, name):
        return results.tables.get(program, {}).get(name, [])

    draw_by_rho(grid[0][0], rows("fig_5_8", "by rho"))
    draw_by_probability(grid[0][1], rows("default_mode", "precision and missed views by P_d"))
    hidden = rows("occlusion", "by hidden share")
    draw_by_hidden(grid[1][0], hidden, "top 1", "Best class is right, of all views")
    draw_by_hidden(grid[1][1], hidden, "right", "Right and decided at P_d 0.90, of all views")
    in_rooms = rows("rooms", "whole rooms by P_d")
    if in_rooms:
        draw_rooms(grid[2][0], in_rooms, "cluttered")
        draw_rooms(grid[2][1], in_rooms, "touching")
    for axes in grid.flat:
        axes.set_visible(bool(axes.lines))  # not those of a program that was left out
        axes.grid(color="0.9")
        if axes.lines:
            axes.legend(fontsize=8)
    figure.savefig(path, dpi=100, metadata={"Software": None})
    plt.close(figure)


def read(folder):
    return pages.Results(folder, PROGRAMS)


def make(folder):
    results = read(folder)
    verdicts = judged(results.tables)
    return pages.relations_as_json(verdicts), page(results, verdicts), pages.summary_of(verdicts)


if __name__ == "__main__":
    sys.exit(pages.run(__doc__, PROGRAMS, "chapter5", make,
                       lambda folder, out: draw(read(folder), out / "chapter5.png")))
