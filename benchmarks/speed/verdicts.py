# SPDX-License-Identifier: BSL-1.0
"""What gnomon wants to reach, and whether the rows of speed.json show it."""

from tables import GAIN, OFFICE, OURS, markdown

NATIVE, PORTABLE = "-O3 -march=native", "-O2"
CLOUDS = {"kitchen": "the kitchen", "kitchen_million": "1,000,000 points", OFFICE: "the office"}

# How many times as long the fastest peer is wanted to take for normals, by k.
WANTED = {NATIVE: {10: 2.2, 20: 3.2, 30: 4, 50: 5}, PORTABLE: {10: 1.7, 20: 2, 30: 2.5, 50: 3.2}}


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


def verdict(claim, wanted, measured, holds):
    """A line of the table; it may hold only where something was measured."""
    return {"claim": claim, "wanted": wanted, "measured": "; ".join(measured),
            "holds": holds if measured else None}


def normals_against_peers(rows, cloud, flags):
    wanted = WANTED[flags]
    best = {k: fastest(peers_at(rows, task="normals", cloud=cloud, flags=flags, threads=1, k=k))
            for k in wanted}
    known = {k: row for k, row in best.items() if row}
    return verdict(
        f"normals of {CLOUDS[cloud]}, one thread, `{flags}`: time of the fastest peer over ours at "
        f"k = {', '.join(map(str, wanted))}",
        "at least " + ", ".join(map(str, wanted.values())),
        [f"{row['ratio']:.2f} ({row['library']})" for row in known.values()],
        len(known) == len(wanted) and all(row["ratio"] >= wanted[k] for k, row in known.items()))


def two_threads(rows, cloud):
    own = rows_at(rows, task=GAIN, cloud=cloud)
    measured = []
    if own:
        worst, best = (extreme(own, key=lambda row: row["gain"]) for extreme in (min, max))
        measured = [f"{worst['gain']:.3f} (k = {worst['k']}, `{worst['flags']}`, where the two "
                    f"cores were worth {worst['worth_of_cores']:.2f}) to {best['gain']:.2f}"]
    return verdict(f"normals of {CLOUDS[cloud]}: time of one thread over that of two",
                   "at least 1.8", measured, bool(own) and worst["gain"] >= 1.8)


def against(rows, claim, wanted, more=False, **at):
    """The least ratio of some peers in all that was measured of a task."""
    row = fastest(peers_at(rows, **at))
    measured = []
    if row:
        where = f"{row['library']}, `{row['flags']}`, threads: {row['threads']}"
        measured = [f"{row['ratio']:.2f} ({where})"]
    holds = bool(row) and (row["ratio"] > wanted if more else row["ratio"] >= wanted)
    return verdict(claim, f"{'more than' if more else 'at least'} {wanted:g}", measured, holds)


def for_this_processor(rows, claim, wanted, **at):
    """The ratio to a peer when compiled for this processor; that for any is told beside it."""
    line = against(rows, f"{claim}, `{NATIVE}`", wanted, flags=NATIVE, **at)
    portable = fastest(peers_at(rows, flags=PORTABLE, **at))
    if line["measured"] and portable:
        line["measured"] += f"; {portable['ratio']:.2f} with `{PORTABLE}`"
    return line


def surfaces(rows):
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
    """Memory beside cloud and result, for a point."""
    return (row["peak_bytes"] - row["result_bytes"]) / row["points"]


def memory(rows):
    own = [row for row in ours_at(rows, task="normals") if row["points"] >= 1_000_000]
    measured = []
    if own:
        most = max(own, key=extra_bytes)
        measured = [f"{extra_bytes(most):.0f} at most (k = {most['k']}, {most['points']:,} points)"]
    return verdict("normals of 1,000,000 points or more: bytes beside cloud and result for a point",
                   "at most 64", measured, bool(own) and extra_bytes(most) <= 64)


def whole_process(rows):
    own = ours_at(rows, task="normals", cloud="kitchen_ten_million")
    most = max((row["process_bytes"] for row in own), default=0)
    return verdict("normals of 10,000,000 points: memory of the whole process, cloud and result "
                   "among it", "under 2 GB", [f"{most / 1e9:.2f} GB"] if own else [], most < 2e9)


def judged(rows):
    """All verdicts: id, claim, wanted, measured, holds."""
    lines = [(f"{1 if flags == NATIVE else 2}.{number}", normals_against_peers(rows, cloud, flags))
             for flags in WANTED for number, cloud in enumerate(CLOUDS, 1)]
    for number, cloud in enumerate(CLOUDS, 1):
        lines.append((f"3.{number}", two_threads(rows, cloud)))
    for number, (library, cloud) in enumerate(
            [(library, cloud) for library in ("Open3D", "PCL NormalEstimationOMP")
             for cloud in CLOUDS], 1):
        lines.append((f"4.{number}", for_this_processor(
            rows, f"normals of {CLOUDS[cloud]}, k = 30, two threads: {library}'s time over ours", 4,
            task="normals", cloud=cloud, threads=2, k=30, library=library)))
    lines += [
        ("5.1", surfaces(rows)),
        ("5.2", against(rows, "clusters of the kitchen, 5 cm: any peer's time over ours", 1,
                        more=True, task="clusters", cloud="kitchen")),
        ("5.3", against(rows, "clusters of the office, 2 cm: any peer's time over ours", 2,
                        task="clusters", cloud=OFFICE)),
        ("6.1", memory(rows)),
        ("6.2", whole_process(rows)),
    ]
    return [{"id": id, **line} for id, line in lines]


VERDICTS = {True: "holds", False: "**does not hold**", None: "not measured"}


def table_of(verdicts):
    lines = [[v["id"], v["claim"], v["wanted"], v["measured"], VERDICTS[v["holds"]]]
             for v in verdicts]
    return markdown(["", "claim", "wanted", "measured", ""], lines, rule="---")
