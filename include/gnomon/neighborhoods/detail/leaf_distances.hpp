// SPDX-License-Identifier: BSL-1.0
/// @file
/// From what a search over leaves measures distances: from points, or from segments of the rays
/// about points (ray_metric.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/instruction_set.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/neighborhoods/detail/lanes.hpp>
#include <gnomon/neighborhoods/detail/leaf_box.hpp>
#include <gnomon/neighborhoods/detail/ray_metric.hpp>
#include <gnomon/neighborhoods/detail/tree_query.hpp>

namespace gnomon::detail {
inline namespace GNOMON_LANES {

/// Euclidean distances from points.
template <class Tree>
class distances_from_points {
  public:
    explicit distances_from_points(const Tree& tree) : tree_(&tree) {}

    /// Adds the query point at a place to a box.
    void enclose(std::size_t place, leaf_box& box) { box.add(tree_->position(place)); }
    /// The canonical squared distance of the points at two places [m^2].
    [[nodiscard]] double squared(std::size_t place, std::size_t other) const {
        return tree_->squared_distance(place, other);
    }
    /// The metric of tree_query.hpp for the query point at a place.
    [[nodiscard]] canonical_metric metric_at(std::size_t) const { return {}; }
    /// The query point at a place, in units of a list, at these coordinates.
    [[nodiscard]] lane_point in_list(std::size_t, const std::array<float, 3>& at, double) const {
        return {at[0], at[1], at[2]};
    }
    /// The squared distances between which floats leave undecided whether a point is within a
    /// limit, if each coordinate is off by a few times `error` times 2^-24 / 1e-6.
    [[nodiscard]] static std::pair<float, float> doubt(float limit, float error) {
        const float below = limit > error ? (limit - error) * (limit - error) : -1.0f;
        return {below, (limit + error) * (limit + error)};
    }

  private:
    const Tree* tree_;
};

/// Distances from the segments of rays, 4 standard deviations of the noise to either side.
template <class Index>
class distances_from_rays {
  public:
    distances_from_rays(const Index& index, const noise_curve& noise)
        : index_(&index), noise_(&noise) {}

    /// Adds the segment about the query point at a place to a box.
    void enclose(std::size_t place, leaf_box& box) {
        ray_metric& m = segments_[place % segments_.size()];
        m = metric_at(place);
        auto nearby = index_->tree().position(place), distant = nearby;
        for (std::size_t a = 0; a < 3; ++a) {
            const double half = m.half_length() * m.direction()[static_cast<int>(a)];
            nearby[a] -= half;
            distant[a] += half;
        }
        box.add(nearby);
        box.add(distant);
    }
    [[nodiscard]] double squared(std::size_t place, std::size_t other) const {
        const auto p = index_->tree().position(place), q = index_->tree().position(other);
        return segments_[place % segments_.size()].squared(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
    }
    [[nodiscard]] ray_metric metric_at(std::size_t place) const {
        return ray_metric_of(*index_, index_->tree().index()[place], *noise_);
    }
    [[nodiscard]] lane_segment in_list(std::size_t place, const std::array<float, 3>& at,
                                       double scale) const {
        const ray_metric& m = segments_[place % segments_.size()];
        const auto u = [&m](int axis) { return static_cast<float>(m.direction()[axis]); };
        return {at[0], at[1], at[2], u(0), u(1), u(2), static_cast<float>(m.half_length() * scale)};
    }
    /// Squares are differences of squares of all coordinates, to which `error` is relative.
    [[nodiscard]] static std::pair<float, float> doubt(float limit, float error) {
        const float of_squares = 1e6f * error * error + 2.0f * limit * error;
        return {std::max(limit * limit - of_squares, -1.0f), limit * limit + of_squares};
    }

  private:
    const Index* index_;
    const noise_curve* noise_;
    std::array<ray_metric,
               std::remove_cvref_t<decltype(std::declval<const Index&>().tree())>::points_per_group>
        segments_;  // of the group
};

}  // namespace GNOMON_LANES
}  // namespace gnomon::detail
