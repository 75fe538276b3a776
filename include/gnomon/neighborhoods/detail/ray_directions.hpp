// SPDX-License-Identifier: BSL-1.0
/// @file
/// The directions in which the points of an index are seen: a tree of unit vectors, in which rays
/// next to each other are found whatever the ranges of their points, and how far apart they are.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/detail/scan_line.hpp>
#include <gnomon/neighborhoods/detail/tree_query.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>

namespace gnomon::detail {

/// How far apart the rays of a scan are; 0 where that is not known.
struct line_spacing {
    angle along = radians(0);   ///< from a ray to the next one of its scan line
    angle across = radians(0);  ///< to the next scan line
};

/// The direction in which a point of an index is seen, of unit length; NaN if the point is not
/// finite, or at its view point.
[[nodiscard]] Eigen::Vector3d ray_direction(const auto& index, std::size_t i) {
    const Eigen::Vector3d way = difference(index[i], index.viewpoints[i]);
    if (has_length(way)) return scaled(1.0 / length(way), way);
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    return {nan, nan, nan};
}

/// The square of the angle [rad^2] below which two rays are one with several returns: a
/// microradian, finer than any sensor is (numerical).
inline constexpr double same_ray = 1e-12;

/// The directions, and their spacing. (A template for compile time only.)
template <class Tree>
class ray_directions {
  public:
    /// Replaces the directions by those of the points of an index, in the same memory. O(n log n).
    template <class Index, execution X>
    void rebuild(const Index& index, const X& run) {
        struct {
            const Index& index;
            [[nodiscard]] std::size_t size() const { return index.size(); }
            [[nodiscard]] Eigen::Vector3d operator[](std::size_t i) const {
                return ray_direction(index, i);
            }
        } const directions{index};
        tree_.rebuild(directions, run);
        viewpoints_ = index.viewpoints.number();
        measure_spacing();
    }

    /// Whether they are of view points with this viewpoint_table::number().
    [[nodiscard]] bool are_from(std::uint64_t viewpoints) const {
        return viewpoints_ == viewpoints;
    }
    [[nodiscard]] const Tree& tree() const { return tree_; }
    [[nodiscard]] const line_spacing& spacing() const { return spacing_; }
    /// That of a neighbor in the tree.
    [[nodiscard]] Eigen::Vector3d direction(const neighbor& q) const {
        const auto u = tree_.position(tree_.place_of(q.index));
        return {u[0], u[1], u[2]};
    }

  private:
    /// The medians over some rays: of the nearest ray along the scan line, and of the nearest one
    /// across it.
    void measure_spacing() {
        constexpr std::size_t seeds = 128;            // performance only
        constexpr std::size_t few = 64, many = 1024;  // rays; performance only, 30 : 1 and more
        scratch<double> along, across;
        scratch<neighbor> nearby;
        const std::size_t step = std::max<std::size_t>(1, tree_.leaves() / seeds);
        for (std::size_t leaf = 0; leaf < tree_.leaves(); leaf += step) {
            const Eigen::Vector3d u = first_of(leaf);
            for (const std::size_t count : {few, many}) {
                search_tree(tree_, u, {.k = count}, nearby);
                const auto [a, b] = nearest_around(u, nearby);
                const bool is_whole = b < std::numeric_limits<double>::infinity();
                if (!is_whole && count == few) continue;
                if (is_whole) across.push_back(b);
                if (a < std::numeric_limits<double>::infinity()) along.push_back(a);
                break;
            }
        }
        const auto median = [](scratch<double>& values) {
            if (values.empty()) return radians(0);
            const auto half = values.begin() + std::ssize(values) / 2;
            std::nth_element(values.begin(), half, values.end());
            return radians(std::sqrt(*half));
        };
        spacing_ = {median(along), median(across)};
    }

    /// The least direction of a leaf, whatever the order of its points.
    [[nodiscard]] Eigen::Vector3d first_of(std::size_t leaf) const {
        std::array<double, 3> least{4.0, 4.0, 4.0};
        const std::size_t begin = leaf * Tree::leaf_size;
        for (std::size_t p = begin; p < std::min(begin + Tree::leaf_size, tree_.size()); ++p)
            least = std::min(least, tree_.position(p));
        return {least[0], least[1], least[2]};
    }

    /// The squared distances to the nearest ray along the scan line of a ray and across it [rad^2];
    /// infinite where there is none.
    /// @param near  the nearest rays, nearest first
    [[nodiscard]] std::array<double, 2> nearest_around(const Eigen::Vector3d& u,
                                                       const auto& nearby) const {
        constexpr std::size_t nearest = 4;  // two to either side, or one in each direction
        const ray_plane<> plane(u);
        scan_line<> line;
        std::size_t count = 0;
        for (const neighbor& q : nearby) {
            if (q.squared_distance < same_ray) continue;
            line.add(plane.offset(direction(q)), 1.0 / q.squared_distance);
            if (++count == nearest) break;
        }
        line.fit();
        constexpr double none = std::numeric_limits<double>::infinity();
        std::array<double, 2> found{none, none};
        for (const neighbor& q : nearby) {
            if (q.squared_distance < same_ray) continue;
            double& to = found[line.is_along(plane.offset(direction(q))) ? 0 : 1];
            to = std::min(to, q.squared_distance);
        }
        return found;
    }

    Tree tree_;
    std::uint64_t viewpoints_ = 0;
    line_spacing spacing_;
};

}  // namespace gnomon::detail
