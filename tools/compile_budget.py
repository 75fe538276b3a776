#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Holds one call by <gnomon/gnomon.hpp> to its budget: to compile it, a compiler may need at most
2.0 times what it needs for the loop that one would write with Eigen and nanoflann.

    compile_budget.py COMPILER [OPTION...]

The options must make the compiler compile with optimization (-O2 -c). What is counted are its
instructions, under valgrind: unlike seconds, they are the same on a busy machine.
"""

import pathlib
import sys
import tempfile

from instructions import hold, instructions, require_valgrind

LIMIT = 2.0
LOOP = """\
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <nanoflann.hpp>

namespace {

struct cloud {
    const std::vector<Eigen::Vector3d>& points;

    std::size_t kdtree_get_point_count() const { return points.size(); }
    double kdtree_get_pt(std::size_t i, std::size_t axis) const {
        return points[i][static_cast<Eigen::Index>(axis)];
    }
    bool kdtree_get_bbox(auto&) const { return false; }
};

using tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, cloud>,
                                                 cloud, 3>;

}  // namespace

std::vector<Eigen::Vector3d> normals_of(const std::vector<Eigen::Vector3d>& points) {
    constexpr std::size_t k = 20;
    const cloud seen{points};
    const tree index(3, seen);
    std::array<std::uint32_t, k> found;
    std::array<double, k> squared;
    std::vector<Eigen::Vector3d> normals;
    normals.reserve(points.size());
    for (const Eigen::Vector3d& point : points) {
        const std::size_t count = index.knnSearch(point.data(), k, found.data(), squared.data());
        Eigen::Vector3d mean = Eigen::Vector3d::Zero();
        for (std::size_t j = 0; j < count; ++j) mean += points[found[j]];
        mean /= static_cast<double>(count);
        Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
        for (std::size_t j = 0; j < count; ++j) {
            const Eigen::Vector3d d = points[found[j]] - mean;
            covariance += d * d.transpose();
        }
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
        solver.computeDirect(covariance);
        normals.push_back(solver.eigenvectors().col(0));
    }
    return normals;
}
"""
CALL = """\
#include <vector>

#include <gnomon/gnomon.hpp>

auto normals_of(const std::vector<Eigen::Vector3d>& points) {
    return gnomon::estimate_normals(points, gnomon::knn{.k = 20}, gnomon::plane_pca{});
}
"""


def main():
    command = sys.argv[1:]
    if not command:
        sys.exit(__doc__)
    require_valgrind("compile budget")
    needed = {}
    with tempfile.TemporaryDirectory() as folder:
        for name, text in {"Eigen and nanoflann": LOOP, "gnomon": CALL}.items():
            source = pathlib.Path(folder, "budget.cpp")
            source.write_text(text, encoding="utf-8")
            needed[name] = instructions([*command, "-o", f"{folder}/budget.o", str(source)])
    hold(needed, LIMIT)


main()
