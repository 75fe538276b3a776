// SPDX-License-Identifier: BSL-1.0
/// @file
/// Some points of a range, by index and without a copy: what pre-processing left over, or one
/// segment.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/index_iterator.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/viewpoints.hpp>

namespace gnomon {

/// Models `point_range` and `has_viewpoints`; refers to both the points and the indices.
template <class R, class Proj = std::identity>
    requires point_range<R, Proj>
class subset_view {
  public:
    /// Those of the selected points.
    viewpoint_table viewpoints;

    /// O(indices).
    /// @throws std::invalid_argument  for an index out of range, such as those of a larger cloud
    subset_view(const R& points, std::span<const point_index> indices, Proj projection = {})
        : points_(points, std::move(projection)),
          indices_(indices),
          epsilon_(detail::epsilon_of<position_view<R, Proj>>(points)) {
        for (const point_index i : indices)
            detail::require(i < points_.size(), "subset_view: an index is out of range");
        viewpoints = detail::viewpoints_of(points, indices);
    }

    subset_view(const R&& points, std::span<const point_index> indices, Proj p = {}) = delete;
    subset_view(const R& points, std::vector<point_index>&& indices, Proj p = {}) = delete;

    [[nodiscard]] std::size_t size() const { return indices_.size(); }
    [[nodiscard]] auto begin() const { return detail::index_iterator(this, 0); }
    [[nodiscard]] auto end() const {
        return detail::index_iterator(this, static_cast<std::ptrdiff_t>(size()));
    }

    /// The position of the i-th selected point [m].
    [[nodiscard]] Eigen::Vector3d operator[](std::size_t i) const { return points_[indices_[i]]; }

    /// The machine epsilon of the numbers that the points came in: float or double.
    [[nodiscard]] double epsilon() const { return epsilon_; }

  private:
    position_view<R, Proj> points_;
    std::span<const point_index> indices_;
    double epsilon_;
};

}  // namespace gnomon
