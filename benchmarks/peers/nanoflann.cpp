// SPDX-License-Identifier: BSL-1.0
// The loop that one writes oneself: nanoflann's tree, Eigen's closed-form solver, OpenMP.
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Eigenvalues>
#include <nanoflann.hpp>

#include "peer.hpp"

namespace {

/// Shows nanoflann the points.
struct point_view {
    const peers::vectors& points;

    std::size_t kdtree_get_point_count() const { return points.size(); }
    double kdtree_get_pt(std::size_t i, std::size_t axis) const {
        return points[i][static_cast<Eigen::Index>(axis)];
    }
    bool kdtree_get_bbox(auto&) const { return false; }
};

using tree_t = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, point_view>,
                                                   point_view, 3>;

/// The direction of least variance of some of the points.
Eigen::Vector3d fit(const peers::vectors& points, const std::vector<std::uint32_t>& ring) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const std::uint32_t j : ring) mean += points[j];
    mean /= static_cast<double>(ring.size());
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const std::uint32_t j : ring) {
        const Eigen::Vector3d d = points[j] - mean;
        covariance += d * d.transpose();
    }
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(covariance);
    return solver.eigenvectors().col(0);
}

struct normals {
    static constexpr const char* task = "normals";
    static constexpr const char* library = "nanoflann + Eigen";
    static constexpr bool one_thread_only = false;

    const peers::vectors& points;

    auto operator()(const peers::request& r) const {
        const point_view view{points};
        const tree_t tree(3, view);
        peers::vectors result(points.size());
        const std::size_t k = r.k + 1;  // the point itself is found, too
#pragma omp parallel num_threads(static_cast<int>(r.threads))
        {
            std::vector<std::uint32_t> ring(k);
            std::vector<double> squares(k);
#pragma omp for schedule(dynamic, 1024)
            for (std::size_t i = 0; i < points.size(); ++i) {
                ring.resize(k);
                ring.resize(tree.knnSearch(points[i].data(), k, ring.data(), squares.data()));
                result[i] = fit(points, ring);
            }
        }
        return result;
    }

    static Eigen::Vector3d normal(const peers::vectors& result, std::size_t i) { return result[i]; }
};

/// 0x143 stands for 1.4.3.
std::string version() {
    return std::to_string(NANOFLANN_VERSION >> 8) + '.' +
           std::to_string(NANOFLANN_VERSION >> 4 & 15) + '.' +
           std::to_string(NANOFLANN_VERSION & 15);
}

}  // namespace

int main(int argc, char** argv) { return peers::serve<normals>(version(), argc, argv); }
