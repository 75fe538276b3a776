// SPDX-License-Identifier: BSL-1.0
/// @file
/// The unlabeled points of a cloud, summed up in small cubes: the sum of the distances of many
/// points from a plane follows from their number and their mean, so that thousands of points at one
/// place cost hardly more than a few.
#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/detail/place_set.hpp>
#include <gnomon/neighborhoods/detail/tree_query.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/segmentation/detail/noisy_plane.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// Whether the unlabeled points near a cube are on the plane of a segment.
struct plane_judgement {
    std::int32_t segment;
    bool is_on_plane;
};

/// The unlabeled points of a cube.
struct unlabeled_cube {
    Eigen::Vector3d mean;       ///< of the points [m]
    Eigen::Vector3d viewpoint;  ///< the mean of their view points [m]; not finite if unknown
    double count;               ///< number of points
    double squared_reach;       ///< largest squared distance of a neighbor from its point [m^2]
    scratch<plane_judgement> judged = {};
};

/// An unlabeled point and the number of its cube.
struct unlabeled_point {
    point_index point;
    std::size_t cube;
};

/// The cubes with unlabeled points. They are aligned with the least coordinates of these points, so
/// that the position of the cloud has no influence.
template <neighborhood_graph G>
class unlabeled_cubes {
  public:
    /// @param graph  the neighbors of each unlabeled point, nearest first
    /// @param sigma  standard deviation of ranges [m]
    unlabeled_cubes(const spatial_index& points, std::span<const std::int32_t> labels,
                    const G& graph, double sigma)
        : tree_(points.tree()), side_(side * sigma) {
        const scratch<placed> all = placed_points(points, labels);
        unlabeled_.reserve(all.size());
        scratch<point_index> first_points;
        for (auto first = all.begin(); first != all.end();) {
            const auto last = std::find_if(
                first, all.end(), [&](const placed& other) { return other.cube != first->cube; });
            first_points.push_back(first->point);
            add_cube(points, graph, std::span(first, last));
            first = last;
        }
        found_by_.assign(tree_, first_points);
        in_tree_order_.resize(cubes_.size());
        for (std::size_t c = 0; c < cubes_.size(); ++c)
            in_tree_order_[found_by_.rank(tree_.place_of(first_points[c]))] = {cubes_[c].mean,
                                                                               cubes_[c].count};
    }

    /// The unlabeled finite points, cube by cube.
    [[nodiscard]] std::span<const unlabeled_point> points() const { return unlabeled_; }
    [[nodiscard]] unlabeled_cube& operator[](std::size_t cube) { return cubes_[cube]; }

    /// Calls visit(mean, count) for all cubes whose means are within a radius [m] of p, and for
    /// others near them. The index finds each cube by one of its points, which is no farther from
    /// the mean than the diagonal of the cube.
    void for_each_near(const Eigen::Vector3d& p, double radius, auto&& visit) const {
        const double diagonal = std::sqrt(3.0) * side_;
        for_each_leaf_within(tree_, found_by_, p, radius + diagonal,
                             [&](std::size_t begin, std::size_t end) {
                                 for (std::size_t c = begin; c < end; ++c)
                                     visit(in_tree_order_[c].mean, in_tree_order_[c].count);
                             });
    }

  private:
    /// In standard deviations of ranges: so narrow that the position of the grid has no influence.
    /// Chosen here, not in the thesis.
    static constexpr double side = 0.75;

    struct placed {
        std::array<double, 3> cube;
        point_index point;
        auto operator<=>(const placed&) const = default;
    };

    /// The part of a cube that others read.
    struct summary {
        Eigen::Vector3d mean;  // [m]
        double count;
    };

    /// The unlabeled points, sorted by cube.
    [[nodiscard]] scratch<placed> placed_points(const spatial_index& points,
                                                std::span<const std::int32_t> labels) const {
        const auto is_unlabeled = [&](std::size_t i) {
            return labels[i] == unlabeled && points.is_finite(i);
        };
        constexpr double infinity = std::numeric_limits<double>::infinity();
        Eigen::Vector3d least(infinity, infinity, infinity);
        std::size_t count = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (!is_unlabeled(i)) continue;
            ++count;
            const Eigen::Vector3d p = points[i];
            for (int a = 0; a < 3; ++a) least[a] = std::min(least[a], p[a]);
        }
        scratch<placed> all;
        all.reserve(count);
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (!is_unlabeled(i)) continue;
            const Eigen::Vector3d p = difference(points[i], least);
            const auto cell = [&](int a) { return std::floor(p[a] / side_); };
            all.push_back({{cell(0), cell(1), cell(2)}, static_cast<point_index>(i)});
        }
        std::sort(all.begin(), all.end());
        return all;
    }

    void add_cube(const spatial_index& points, const G& graph, std::span<const placed> members) {
        const Eigen::Vector3d origin = points[members.front().point];
        moments m, seen_from;
        double squared_reach = 0.0;
        for (const placed& member : members) {
            const Eigen::Vector3d p = points[member.point];
            m.add(difference(p, origin));
            seen_from.add(known_viewpoint(points.viewpoints, member.point));
            if (const auto neighbors = graph[member.point]; !neighbors.empty())
                squared_reach =
                    std::max(squared_reach, squared_distance(points[neighbors.back()], p));
            unlabeled_.push_back({member.point, cubes_.size()});
        }
        const auto n = static_cast<double>(m.count);
        cubes_.push_back({combined(1.0, origin, 1.0 / n, m.sum), scaled(1.0 / n, seen_from.sum), n,
                          squared_reach});
    }

    const leaf_tree& tree_;
    double side_;                         // [m]
    scratch<unlabeled_point> unlabeled_;  // cube by cube
    scratch<unlabeled_cube> cubes_;
    place_set found_by_;              // a point of each cube
    scratch<summary> in_tree_order_;  // the cubes, in the order of these points
};

}  // namespace gnomon::detail
