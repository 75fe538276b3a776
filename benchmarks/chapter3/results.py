# SPDX-License-Identifier: BSL-1.0
"""The raw JSON of the programs here, as cells that can be asked for.

A cell is what one benchmark counted. The name of a benchmark is FIGURE/key:value/key:value/...; its
cell is found by those.
"""

import json

FIGURES = ["fig_3_5", "fig_3_6", "table_3_3", "fig_3_9", "fig_3_10", "fig_3_11", "fig_3_14",
           "decision"]

SEVEN = ["plane_svd", "plane_pca", "vector_svd", "quad_svd", "quad_trans_svd", "area_weighted",
         "angle_weighted"]
FIVE = ["plane_svd", "plane_pca", "vector_svd", "area_weighted", "angle_weighted"]
LINEAR = ["plane_svd", "plane_pca", "vector_svd"]
AVERAGING = ["area_weighted", "angle_weighted"]

TITLES = {
    "plane_svd": "PlaneSVD", "plane_pca": "PlanePCA", "vector_svd": "VectorSVD",
    "quad_svd": "QuadSVD", "quad_trans_svd": "QuadTransSVD", "area_weighted": "AreaWeighted",
    "angle_weighted": "AngleWeighted", "vector_pca": "VectorPCA", "ray_ls": "RayLS",
    "weighted_pca": "weighted PCA", "robust_pca": "robust PCA",
    "quad_trans_svd rank 6": "QuadTransSVD, rank 6",
    "literal_plane_ekf": "EKF of Alg. 3.2", "plane_ekf": "EKF on the sphere",
    "plane_pca with covariance": "PlanePCA with covariance",
    "knn": "nearest neighbors", "angularly_sorted_knn": "nearest neighbors in angular order",
    "delaunay": "Delaunay stars",
}


def value_of(text):
    """Numbers as numbers."""
    try:
        return int(text)
    except ValueError:
        return text


class Cell:
    """The parameters and counters of one benchmark."""

    def __init__(self, benchmark):
        self.figure, *parts = benchmark["name"].split("/")
        named = [part.split(":", 1) for part in parts if ":" in part]
        self.at = {key: value_of(value) for key, value in named}
        self.counters = benchmark

    def __getitem__(self, counter):
        return self.counters[counter]

    def seeds(self, counter):
        """The values of a counter for each seed."""
        values = []
        while f"{counter}_{len(values) + 1}" in self.counters:
            values.append(self.counters[f"{counter}_{len(values) + 1}"])
        return values


class Results:
    """All cells of all figures."""

    def __init__(self, folder):
        self.cells = {}
        self.contexts = {}
        for figure in FIGURES:
            raw = json.loads((folder / f"{figure}.json").read_text(encoding="utf-8"))
            self.contexts[figure] = raw["context"]
            self.cells[figure] = [Cell(b) for b in raw["benchmarks"]]

    @property
    def quick(self):
        return any(context["quick"] == "true" for context in self.contexts.values())

    def all(self, figure, **at):
        """The cells with these parameters, in the order in which they were measured."""
        return [c for c in self.cells[figure]
                if all(c.at.get(key) == value for key, value in at.items())]

    def one(self, figure, **at):
        """The cell with these parameters."""
        found = self.all(figure, **at)
        if len(found) != 1:
            raise LookupError(f"{figure} has {len(found)} cells of {at}")
        return found[0]

    def values(self, figure, key, **at):
        """The values that a parameter takes among such cells, ascending."""
        return sorted({c.at[key] for c in self.all(figure, **at) if key in c.at})
