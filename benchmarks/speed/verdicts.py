# SPDX-License-Identifier: BSL-1.0
"""The figures required of gnomon, and whether the rows of speed.json reach them."""

import math
import statistics

from tables import GAIN, OFFICE, OURS, markdown

NATIVE, PORTABLE, V3 = "-O3 -march=native", "-O2", "-O3 -march=x86-64-v3"
CLOUDS = {"kitchen": "the kitchen", "kitchen_preprocessed": "the kitchen without floor and ceiling",
          "kitchen_million": "1,000,000 points", "kitchen_ten_million": "10,000,000 points",
          OFFICE: "the office"}

# What is wanted at least: the time of the fastest peer over ours, by k. For normals, what a
# prototype reached; for other tasks, more than the noise of a shared machine, and less than was
# measured when the figure was chosen.
NORMALS = {NATIVE: {10: 2.2, 20: 3.2, 30: 4, 50: 5}, PORTABLE: {10: 1.7, 20: 2, 30: 2.5, 50: 3.2}}
GRAPHS = {V3: {10: 1.5, 20: 1.5, 50: 1.5}, NATIVE: {10: 1.5, 20: 1.5, 30: 1.5, 50: 1.5},
          PORTABLE: {10: 1.3, 20: 1.5, 30: 1.5, 50: 1.5}}
SURFACES = {NATIVE: {30: 2, 50: 2.5}, PORTABLE: {30: 1.5, 50: 2}}
INSTRUCTIONS = {"normals": {10: 1.4, 50: 3}, "search": {10: 1.2, 50: 2}}


def rows_at(rows, **at):
    """The rows that were measured and have these values."""
    return [row for row in rows
            if row["seconds"] and all(row.get(key) == value for key, value in at.items())]


def peers_at(rows, **at):
    return [row for row in rows_at(rows, **at) if row["library"] != OURS]


def ours_at(rows, **at):
    return rows_at(rows, library=OURS, **at)


def fastest(rows):
    """The row of the fastest; nothing of none."""
    return min(rows, key=lambda row: row["ratio"], default=None)


def verdict(task, claim, wanted, measured, holds):
    """A line of the table; it may hold only where something was measured."""
    return {"task": task, "claim": claim, "wanted": wanted, "measured": "; ".join(measured),
            "holds": holds if measured else None}


def reached(measured, wanted):
    """Whether all figures are at least as large; nothing if some of them are missing."""
    if any(measured.get(key, least) < least for key, least in wanted.items()):
        return False
    return True if wanted.keys() <= measured.keys() else None


def by_k(rows, task, claim, wanted, cloud, flags, threads=1):
    """The fastest peer's time over ours at each k, and the ratio required there."""
    best = {k: fastest(peers_at(rows, task=task, cloud=cloud, flags=flags, threads=threads, k=k))
            for k in wanted}
    known = {k: row for k, row in best.items() if row}
    count = {1: "one thread", 2: "two threads"}[threads]
    return verdict(
        task,
        f"{claim} of {CLOUDS[cloud]}, {count}, `{flags}`: time of the fastest peer over ours at "
        f"k = {', '.join(map(str, wanted))}",
        "at least " + ", ".join(map(str, wanted.values())),
        [f"{row['ratio']:.2f} ({row['library']})" for row in known.values()],
        reached({k: row["ratio"] for k, row in known.items()}, wanted))


def two_threads(rows, cloud):
    own = rows_at(rows, task=GAIN, cloud=cloud)
    measured = []
    if own:
        worst, best = (extreme(own, key=lambda row: row["gain"]) for extreme in (min, max))
        measured = [f"{worst['gain']:.3f} (k = {worst['k']}, `{worst['flags']}`, where the two "
                    f"cores were worth {worst['worth_of_cores']:.2f}) to {best['gain']:.2f}"]
    return verdict("normals", f"normals of {CLOUDS[cloud]}: time of one thread over that of two",
                   "at least 1.8", measured, bool(own) and worst["gain"] >= 1.8)


def against(rows, claim, wanted, more=False, **at):
    """The least ratio of some peers in all that was measured of a task."""
    row = fastest(peers_at(rows, **at))
    measured = []
    if row:
        where = f"{row['library']}, `{row['flags']}`, threads: {row['threads']}"
        measured = [f"{row['ratio']:.2f} ({where})"]
    holds = bool(row) and (row["ratio"] > wanted if more else row["ratio"] >= wanted)
    return verdict(at["task"], claim, f"{'more than' if more else 'at least'} {wanted:g}", measured,
                   holds)


def for_this_processor(rows, claim, wanted, **at):
    """The ratio to a peer when compiled for this processor; that for any is added."""
    line = against(rows, f"{claim}, `{NATIVE}`", wanted, flags=NATIVE, **at)
    portable = fastest(peers_at(rows, flags=PORTABLE, **at))
    if line["measured"] and portable:
        line["measured"] += f"; {portable['ratio']:.2f} with `{PORTABLE}`"
    return line


def surfaces_against_pcl(rows):
    at = dict(task="surfaces", cloud="kitchen_preprocessed", threads=2, k=50)
    line = for_this_processor(rows, "normals and smooth surfaces of the kitchen without floor and "
                              "ceiling, k = 50, two threads: PCL's time over ours", 6,
                              library="PCL RegionGrowing", **at)
    ours = ours_at(rows, flags=NATIVE, **at)
    if ours and line["measured"]:
        line["measured"] += (f"; ours takes {ours[0]['seconds']:.3f} s, the thesis's tool chain "
                             "took 3.5 s")
    return line


def extra_bytes(row):
    """Memory in addition to cloud and result, for a point."""
    return (row["peak_bytes"] - row["result_bytes"]) / row["points"]


def memory(rows, task, claim, least_points):
    own = [row for row in ours_at(rows, task=task)
           if row["points"] >= least_points and "result_bytes" in row]
    measured = []
    if own:
        most = max(own, key=extra_bytes)
        measured = [f"{extra_bytes(most):.0f} at most (k = {most['k']}, {most['points']:,} points)"]
    return verdict(task, f"{claim} of {least_points:,} points or more: bytes in addition to cloud "
                   "and result, for a point", "at most 64", measured, bool(own) and extra_bytes(most) <= 64)


def whole_process(rows):
    own = ours_at(rows, task="normals", cloud="kitchen_ten_million")
    most = max((row["process_bytes"] for row in own), default=0)
    return verdict("normals", "normals of 10,000,000 points: memory of the whole process, cloud and "
                   "result among it", "under 2 GB", [f"{most / 1e9:.2f} GB"] if own else [],
                   most < 2e9)


def exponent(pairs):
    """p of y = c x^p, by least squares of logarithms."""
    return statistics.linear_regression(*zip(*((math.log(x), math.log(y)) for x, y in pairs))).slope


def scaling(rows):
    """How the time grows with the number of points, over the parts of a cloud."""
    own = [row for row in ours_at(rows, task="normals") if "/" in row["cloud"]]
    measured = []
    if len({row["points"] for row in own}) > 2:
        p = exponent([(row["points"], row["seconds"]) for row in own])
        measured = [f"{p:.2f} (k = {own[0]['k']}, {min(row['points'] for row in own):,} to "
                    f"{max(row['points'] for row in own):,} points)"]
    return verdict("normals", "normals of parts of a cloud, one thread: exponent p of time "
                   "proportional to n^p", "at most 1.1", measured, bool(measured) and p <= 1.1)


def instructions(rows, task, wanted):
    """The least ratio of a peer's instructions to ours at each k."""
    counted = {(row["library"], row["k"]): row["instructions"] for row in rows
               if row["task"] == task and row.get("instructions")}
    ratios = {}
    for (library, k), count in counted.items():
        if library != OURS and (OURS, k) in counted:
            ratio = count / counted[OURS, k]
            ratios[k] = min(ratios.get(k, (ratio, library)), (ratio, library))
    return verdict(task, f"instructions for {'the graph' if task == 'search' else task}, one thread, "
                   f"`{PORTABLE}`: the peer's over ours at k = {', '.join(map(str, wanted))}",
                   "at least " + ", ".join(map(str, wanted.values())),
                   [f"{ratio:.2f} ({library})" for k, (ratio, library) in sorted(ratios.items())],
                   reached({k: ratio for k, (ratio, _) in ratios.items()}, wanted))


def normals(rows):
    lines = [(f"{1 if flags == NATIVE else 2}.{number}",
              by_k(rows, "normals", "normals", NORMALS[flags], cloud, flags))
             for flags in NORMALS
             for number, cloud in enumerate(("kitchen", "kitchen_million", OFFICE), 1)]
    lines.append(("1.4", by_k(rows, "normals", "normals", {20: NORMALS[NATIVE][20]},
                              "kitchen_ten_million", NATIVE)))
    return sorted(lines, key=lambda line: line[0])


def normals_on_two_threads(rows):
    clouds = ("kitchen", "kitchen_million", OFFICE)
    lines = [(f"3.{number}", two_threads(rows, cloud)) for number, cloud in enumerate(clouds, 1)]
    for number, (library, cloud) in enumerate(
            [(library, cloud) for library in ("Open3D", "PCL NormalEstimationOMP")
             for cloud in clouds], 1):
        lines.append((f"4.{number}", for_this_processor(
            rows, f"normals of {CLOUDS[cloud]}, k = 30, two threads: {library}'s time over ours", 4,
            task="normals", cloud=cloud, threads=2, k=30, library=library)))
    return lines


def graphs(rows):
    kitchen = [by_k(rows, "search", "neighbor graph", wanted, "kitchen", flags, threads)
               for flags, wanted in GRAPHS.items() for threads in (1, 2)]
    million = [by_k(rows, "search", "neighbor graph", {20: 1.5}, "kitchen_million", NATIVE, threads)
               for threads in (1, 2)]
    return [(f"5.{number}", line) for number, line in enumerate(kitchen + million, 1)]


def surfaces(rows):
    claim = "normals and smooth surfaces"
    lines = [by_k(rows, "surfaces", claim, wanted, "kitchen_preprocessed", flags, threads)
             for flags, wanted in SURFACES.items() for threads in (1, 2)]
    lines += [by_k(rows, "surfaces", claim, {30: 2.5}, "kitchen_million", NATIVE, 2),
              surfaces_against_pcl(rows)]
    return [(f"6.{number}", line) for number, line in enumerate(lines, 1)]


def clusters(rows):
    return [
        ("7.1", against(rows, "clusters of the kitchen, 5 cm: any peer's time over ours", 2,
                        task="clusters", cloud="kitchen")),
        ("7.2", against(rows, "clusters of the office, 2 cm: any peer's time over ours", 2,
                        task="clusters", cloud=OFFICE))]


def judged(rows):
    """All verdicts: id, task, claim, wanted, measured, holds."""
    whole = [row for row in rows if "/" not in row["cloud"] and "instructions" not in row]
    lines = [*normals(whole), *normals_on_two_threads(whole), *graphs(whole), *surfaces(whole),
             *clusters(whole),
             ("8.1", memory(whole, "normals", "normals", 1_000_000)),
             ("8.2", whole_process(whole)),
             ("8.3", memory(whole, "search", "neighbor graph", 100_000)),
             ("9.1", scaling(rows)),
             *((f"10.{number}", instructions(rows, task, wanted))
               for number, (task, wanted) in enumerate(INSTRUCTIONS.items(), 1))]
    return [{"id": id, **line} for id, line in lines]


VERDICTS = {True: "yes", False: "**no**", None: "not measured"}


def table_of(verdicts):
    lines = [[v["id"], v["claim"], v["wanted"], v["measured"], VERDICTS[v["holds"]]]
             for v in verdicts]
    return markdown(["", "claim", "wanted", "measured", "reached"], lines, rule="---")


def without_verdict(rows):
    """The tasks that were measured and of which nothing is wanted."""
    return {row["task"] for row in rows} - {GAIN} - {v["task"] for v in judged(rows)}
