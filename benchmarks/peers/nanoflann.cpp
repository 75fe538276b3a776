// SPDX-License-Identifier: BSL-1.0
// The loop that one writes oneself: nanoflann's tree, Eigen's closed-form solver, OpenMP. Any
// release of nanoflann since 1.4: PEERS_NANOFLANN says what to call it.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>
#include <nanoflann.hpp>

#include "loops.hpp"
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
Eigen::Vector3d fit(const peers::vectors& points, const std::vector<std::uint32_t>& neighbors) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const std::uint32_t j : neighbors) mean += points[j];
    mean /= static_cast<double>(neighbors.size());
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const std::uint32_t j : neighbors) {
        const Eigen::Vector3d d = points[j] - mean;
        covariance += d * d.transpose();
    }
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(covariance);
    return solver.eigenvectors().col(0);
}

/// What is alike for all.
struct on_points {
    static constexpr bool one_thread_only = peers::loops_have_one_thread;

    const peers::vectors& points;

    /// Calls visit(i, neighbors) with the k nearest neighbors of each point, itself among them.
    void for_each_neighborhood(const peers::request& r, auto&& visit) const {
        const point_view view{points};
        const tree_t tree(3, view);
        const std::size_t k = r.k() + 1;  // the point itself is found, too
        peers::for_each_index(points.size(), r.threads, [&] {
            return [&, neighbors = std::vector<std::uint32_t>(k),
                    squares = std::vector<double>(k)](std::size_t i) mutable {
                neighbors.resize(k);
                neighbors.resize(
                    tree.knnSearch(points[i].data(), k, neighbors.data(), squares.data()));
                visit(i, neighbors);
            };
        });
    }
};

struct search : on_points, peers::search_job {
    static constexpr const char* library = PEERS_NANOFLANN;

    explicit search(const peers::vectors& p) : on_points{p} {}

    auto operator()(const peers::request& r) const {
        peers::neighbor_lists lists(points.size(), r.k());
        for_each_neighborhood(
            r, [&](std::size_t i, const auto& neighbors) { lists.set(i, neighbors); });
        return lists;
    }
};

struct normals : on_points {
    static constexpr const char* task = "normals";
    static constexpr const char* library = PEERS_NANOFLANN " + Eigen";

    explicit normals(const peers::vectors& p) : on_points{p} {}

    auto operator()(const peers::request& r) const {
        peers::vectors result(points.size());
        for_each_neighborhood(
            r, [&](std::size_t i, const auto& neighbors) { result[i] = fit(points, neighbors); });
        return result;
    }

    static Eigen::Vector3d normal(const peers::vectors& result, std::size_t i) { return result[i]; }
    static std::size_t bytes(const peers::vectors& result) {
        return result.size() * sizeof(result[0]);
    }
};

/// One search for both: the graph that the normals come of is kept, and surfaces grow over it.
struct surfaces : on_points {
    static constexpr const char* task = "surfaces";
    static constexpr const char* library = PEERS_NANOFLANN " + Eigen";

    explicit surfaces(const peers::vectors& p) : on_points{p} {}

    auto operator()(const peers::request& r) const {
        peers::neighbor_lists lists(points.size(), r.k());
        peers::vectors normals(points.size());
        for_each_neighborhood(r, [&](std::size_t i, const auto& neighbors) {
            lists.set(i, neighbors);
            normals[i] = fit(points, neighbors);
        });
        const double min_cosine = std::cos(peers::max_angle);
        auto sizes = peers::grow(points.size(), [&](std::size_t i, auto&& visit) {
            std::for_each_n(lists.begin(i), lists.k(), [&](std::uint32_t j) {
                if (std::abs(normals[i].dot(normals[j])) >= min_cosine) visit(j);
            });
        });
        return std::pair(std::move(normals), std::move(sizes));
    }

    static Eigen::Vector3d normal(const auto& result, std::size_t i) { return result.first[i]; }
    static std::size_t segment_count(const auto& result) {
        return peers::count_of(result.second, peers::min_points);
    }
};

#if NANOFLANN_VERSION < 0x150
using found_t = std::pair<std::uint32_t, double>;
const nanoflann::SearchParams unsorted(32, 0.0f, false);
#else
using found_t = nanoflann::ResultItem<std::uint32_t, double>;
const nanoflann::SearchParameters unsorted(0.0f, false);
#endif

struct clusters : on_points {
    static constexpr const char* task = "clusters";
    static constexpr const char* library = PEERS_NANOFLANN;
    static constexpr bool one_thread_only = true;  // each search starts where others have ended

    explicit clusters(const peers::vectors& p) : on_points{p} {}

    auto operator()(const peers::request& r) const {
        const point_view view{points};
        const tree_t tree(3, view);
        const double square = r.radius() * r.radius();
        std::vector<found_t> found;
        return peers::grow(points.size(), [&](std::size_t i, auto&& visit) {
            tree.radiusSearch(points[i].data(), square, found, unsorted);
            for (const found_t& q : found) visit(q.first);
        });
    }

    static std::size_t segment_count(const auto& sizes) { return sizes.size(); }
};

/// 0x143 stands for 1.4.3.
std::string version() {
    return std::to_string(NANOFLANN_VERSION >> 8) + '.' +
           std::to_string(NANOFLANN_VERSION >> 4 & 15) + '.' +
           std::to_string(NANOFLANN_VERSION & 15);
}

}  // namespace

int main(int argc, char** argv) {
    return peers::serve<search, normals, surfaces, clusters>(version(), argc, argv);
}
