#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Measures gnomon and its peers more thoroughly than peers does, and writes speed.json.

The same turns (../peers/turns.py) on more tasks and larger clouds; parts of a cloud, for how time
grows with the number of points; gnomon on one thread and on two, in turns with itself; and
instructions, which valgrind counts: these do not depend on who else uses the machine.
"""

import itertools
import pathlib
import re
import shutil
import statistics
import subprocess
import sys

sys.dont_write_bytecode = True  # in a folder of sources
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "peers"))

import turns  # noqa: E402
from turns import GAIN, OFFICE, OURS, Part, Refusal, blank, describe, unmeasured  # noqa: E402

SEARCH = {
    OURS: "gnomon",
    "nanoflann": "nanoflann",
    "newer nanoflann": "nanoflann_newer",
    "PCL KdTreeFLANN": "pcl",
    "Open3D KDTreeFlann": "open3d",
    "CGAL Orthogonal_k_neighbor_search": "cgal",
    "ANN": "ann_gsl",
}
NORMALS = {
    OURS: "gnomon",
    "nanoflann + Eigen": "nanoflann",
    "newer nanoflann + Eigen": "nanoflann_newer",
    "PCL NormalEstimation": "pcl",
    "PCL NormalEstimationOMP": "pcl",
    "Open3D": "open3d",
    "CGAL pca": "cgal",
    "CGAL jet": "cgal",
    "ANN + GSL": "ann_gsl",
}
SURFACES = {
    OURS: "gnomon",
    "nanoflann + Eigen": "nanoflann",
    "newer nanoflann + Eigen": "nanoflann_newer",
    "PCL RegionGrowing": "pcl",
    "CGAL pca + Region_growing": "cgal",
}
CLUSTERS = {
    OURS: "gnomon",
    "nanoflann": "nanoflann",
    "newer nanoflann": "nanoflann_newer",
    "PCL EuclideanClusterExtraction": "pcl",
    "Open3D ClusterDBSCAN": "open3d",
    "CGAL cluster_point_set": "cgal",
}


def only(peers, *libraries):
    return {library: peers[library] for library in libraries}


JET = {"CGAL jet": "left out: takes several times as long as the slowest other, see peers.md"}
SLOW = JET | {"ANN + GSL": "left out: takes twice as long as others, see the kitchen",
              "PCL NormalEstimation": "left out: the same as NormalEstimationOMP on one thread"}

# Libraries of headers alone, which follow the flags of the compiler.
HEADERS = only(SEARCH, OURS, "nanoflann", "newer nanoflann")

KS = [10, 20, 30, 50]
TWO_FASTEST = only(NORMALS, OURS, "nanoflann + Eigen", "Open3D")
NATIVE = ("native",)
PORTABLE = ("portable",)  # valgrind does not know the instructions of every processor
GROWING = only(NORMALS, OURS, "nanoflann + Eigen")

# How time grows: parts of a large cloud, and the whole.
SIZES = [10_000, 31_623, 100_000, 316_228, 1_000_000]


def growing(cloud, sizes, k, rounds):
    return [Part("normals", f"{cloud}/{size}", [k], GROWING, threads=(1,), flags=NATIVE,
                 rounds=rounds) for size in sizes]


FULL = [
    Part("normals", "kitchen", KS, NORMALS, left_out=JET),
    Part("search", "kitchen", KS, SEARCH, rounds=3),
    Part("search", "kitchen", KS, HEADERS, flags=("v3",), rounds=7),
    Part("clusters", "kitchen", [0.05], CLUSTERS, rounds=3),
    Part("surfaces", "kitchen_preprocessed", [30, 50], SURFACES, rounds=3),
    Part("normals", OFFICE, KS, NORMALS, threads=(1,), rounds=3, left_out=SLOW),
    Part("normals", OFFICE, [30], NORMALS, threads=(2,), rounds=3, left_out=SLOW),
    Part("clusters", OFFICE, [0.02], CLUSTERS, rounds=3),
    Part("normals", "kitchen_million", KS, NORMALS, threads=(1,), rounds=3, left_out=SLOW),
    Part("normals", "kitchen_million", [30], NORMALS, threads=(2,), rounds=3, left_out=SLOW),
    Part("search", "kitchen_million", [20], SEARCH, flags=NATIVE, rounds=2),
    Part("surfaces", "kitchen_million", [30], SURFACES, threads=(2,), flags=NATIVE, rounds=2),
    *growing("kitchen_million", SIZES, 20, rounds=3),
    Part("normals", "kitchen_ten_million", [20], TWO_FASTEST, flags=NATIVE, rounds=1),
]
SMALL = "kitchen_medium"
QUICK = [
    Part("normals", SMALL, [10, 50], NORMALS, threads=(1,), rounds=2, left_out=JET),
    Part("search", SMALL, [20], SEARCH, threads=(1,), rounds=2),
    Part("search", SMALL, [20], HEADERS, threads=(1,), flags=("v3",), rounds=2),
    Part("surfaces", SMALL, [30], SURFACES, threads=(1,), rounds=2),
    Part("clusters", SMALL, [0.05], CLUSTERS, threads=(1,), rounds=2),
    *growing(SMALL, [7_200, 28_800], 20, rounds=2),
]


def gains(programs, clouds, quick):
    """Rows of how many times as long one thread takes as two."""
    plan = [(SMALL, [10], 2)] if quick else [("kitchen", KS, 15), (OFFICE, KS, 8),
                                             ("kitchen_million", [30], 4)]
    rows = []
    for cloud_name, ks, rounds in plan:
        part = Part("normals", cloud_name, ks, only(NORMALS, OURS), threads=(2,), rounds=rounds)
        for folder, setting in part.settings(programs):
            setting["task"] = GAIN
            print(f"[{turns.text_of(setting)}]", file=sys.stderr, flush=True)
            try:
                cloud, setting["points"] = clouds.make(cloud_name)
                rows.append(gain(folder / OURS, setting, part, cloud))
            except Refusal as refusal:
                rows.append(unmeasured(setting, OURS, str(refusal)))
    return rows


def gain(program, setting, part, cloud):
    """The row of one setting. Who waits for two cores waits for the slower: so each takes several
    turns in a row, of which the first do not count, as a core that was idle takes some time to run
    at full speed; and two programs side by side, which share nothing but the machine, show what two
    cores of it are worth."""
    def worker(threads, on=None):
        return turns.Worker(program, f"{part.task}/{OURS}", cloud, setting["k"], threads, on)

    first, last = turns.cores()[-2:]
    teams = {"one": [worker(1)], "two": [worker(2)],
             "apart": [worker(1, [first]), worker(1, [last])]}
    seconds = {name: [] for name in teams}
    idle, turns_in_a_row = 3, 8
    try:
        for _, (name, team), turn in itertools.product(
                range(part.rounds), teams.items(), range(turns_in_a_row)):
            for one in team:
                one.begin()
            for one in team:
                one.end()
                if one.failure:
                    raise Refusal(one.failure)
            if turn >= idle:
                seconds[name].append(max(one.seconds[-1] for one in team))
    finally:
        for one in itertools.chain(*teams.values()):
            one.dismiss()
    median = {name: statistics.median(times) for name, times in seconds.items()}
    ratios = [a / b for a, b in zip(seconds["one"], seconds["two"])]
    return blank(setting, OURS) | {
        "version": describe(program)["version"], "seconds": median["two"],
        "seconds_of_one_thread": median["one"],
        "gain": round(median["one"] / median["two"], 3),
        "gain_low": round(min(ratios), 3), "gain_high": round(max(ratios), 3),
        "worth_of_cores": round(2 * median["one"] / median["apart"], 3), "turns": len(ratios)}


def count_instructions(program, job, cloud, reach, times):
    """Of the whole program, which does the work once and `times` times more."""
    valgrind = shutil.which("valgrind")
    if not valgrind:
        raise Refusal("valgrind is not here; benchmarks/peers/install.sh installs it")
    done = subprocess.run(
        [valgrind, "--tool=callgrind", "--callgrind-out-file=/dev/null", program, job, cloud,
         str(reach), "1"], input="\n" * times, capture_output=True, text=True)
    found = re.search(r"Collected : (\d+)", done.stderr)
    if done.returncode != 0 or not found:
        raise Refusal(f"valgrind failed with status {done.returncode}")
    return int(found.group(1))


def instructions(programs, clouds, quick):
    """Rows of the instructions that one round takes."""
    rows = []
    ks = [10] if quick else [10, 50]
    for part in (Part("normals", SMALL, ks, GROWING, threads=(1,), flags=PORTABLE),
                 Part("search", SMALL, ks, only(SEARCH, OURS, "nanoflann"), threads=(1,),
                      flags=PORTABLE)):
        for folder, setting in part.settings(programs):
            print(f"[instructions] {turns.text_of(setting)}", file=sys.stderr, flush=True)
            cloud, setting["points"] = clouds.make(part.cloud)
            for library, program in part.peers.items():
                row = blank(setting, library) | {"instructions": None}
                try:
                    row.update(version=describe(folder / program)["version"])
                    none, one = (count_instructions(folder / program, f"{part.task}/{library}",
                                                    cloud, setting["k"], times)
                                 for times in (0, 1))
                    row["instructions"] = one - none
                except Refusal as refusal:
                    row["note"] = str(refusal)
                rows.append(row)
    return rows


turns.main("speed", FULL, QUICK, lambda *about: gains(*about) + instructions(*about))
