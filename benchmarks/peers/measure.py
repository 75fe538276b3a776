#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Measures normals by gnomon and its peers, in turns (turns.py), and writes peers.json."""

import sys

sys.dont_write_bytecode = True  # in a folder of sources

import turns  # noqa: E402
from turns import OFFICE, OURS, Part  # noqa: E402

NORMALS = {
    OURS: "gnomon",
    "nanoflann + Eigen": "nanoflann",
    "PCL NormalEstimation": "pcl",
    "PCL NormalEstimationOMP": "pcl",
    "Open3D": "open3d",
    "CGAL pca": "cgal",
    "CGAL jet": "cgal",
    "ANN + GSL": "ann_gsl",
}

FULL = [Part("normals", "kitchen", [10, 20, 30, 50], NORMALS),
        Part("normals", OFFICE, [30], NORMALS)]
QUICK = [Part("normals", "kitchen_medium", [20], NORMALS, rounds=3)]

turns.main("peers", FULL, QUICK)
