#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Measures gnomon and its peers more thoroughly than peers does, and writes speed.json.

The same turns (../peers/turns.py) on more tasks and larger clouds; parts of a cloud, for how time
grows with the number of points; and instructions, which valgrind counts: these do not depend on who
else uses the machine.
"""

import pathlib
import re
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True  # in a folder of sources
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "peers"))

import turns  # noqa: E402
from turns import OFFICE, OURS, Part, Refusal, blank, describe  # noqa: E402

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
    Part("surfaces", SMALL, [30], SURFACES, threads=(1,), rounds=2),
    Part("clusters", SMALL, [0.05], CLUSTERS, threads=(1,), rounds=2),
    *growing(SMALL, [7_200, 28_800], 20, rounds=2),
]


def count_instructions(program, job, cloud, reach, times):
    """Of the whole program, which does the work once and so many times more."""
    valgrind = shutil.which("valgrind")
    if not valgrind:
        raise Refusal("valgrind is not here; benchmarks/peers/install.sh installs it")
    told = subprocess.run(
        [valgrind, "--tool=callgrind", "--callgrind-out-file=/dev/null", program, job, cloud,
         str(reach), "1"], input="\n" * times, capture_output=True, text=True)
    found = re.search(r"Collected : (\d+)", told.stderr)
    if told.returncode != 0 or not found:
        raise Refusal(f"valgrind failed with status {told.returncode}")
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


turns.main("speed", FULL, QUICK, instructions)
