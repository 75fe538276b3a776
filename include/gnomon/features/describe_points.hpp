// SPDX-License-Identifier: BSL-1.0
/// @file
/// Descriptors of all points of a cloud, or of some of them, by any `descriptor`:
///
///     auto images = gnomon::describe_points(index, surface, spin_image{.radius = 0.1});
///
///     auto some = gnomon::describe_points(index, surface, keypoints, shape_context{}, threads{});
///
/// One sweep over the index finds the neighbors of all these points; no graph is stored.
///
/// Klasing 2010, Sec. 3.4.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/pack.hpp>
#include <gnomon/core/detail/prefetch.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/touched_vector.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/features/descriptor.hpp>
#include <gnomon/features/detail/neighbor_extras.hpp>
#include <gnomon/features/detail/trust_of_normal.hpp>
#include <gnomon/neighborhoods/detail/lane_instructions.hpp>
#include <gnomon/neighborhoods/detail/leaf_balls.hpp>
#include <gnomon/neighborhoods/detail/leaf_sweep.hpp>
#include <gnomon/neighborhoods/detail/leaf_tree.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace gnomon {
namespace detail {

/// A row that no point has.
inline constexpr point_index no_row = std::numeric_limits<point_index>::max();

/// Writes the row of each point that a sweep visits. Each thread has its own object.
template <descriptor D, normal_range Surface>
class row_writer {
  public:
    /// @param row_of  for each place of the tree, the row of its point
    row_writer(const leaf_tree& tree, const Surface& surface, const D& describe,
               const neighbor_extras<D>& extras, std::span<const point_index> row_of,
               point_descriptors& result)
        : tree_(tree),
          surface_(surface),
          describe_(describe),
          extras_(extras),
          row_of_(row_of),
          result_(result),
          row_(result.dimension, 0.0) {}

    /// @param places  those of the neighbors
    void operator()(std::size_t place, std::span<const std::uint32_t> places) {
        const std::size_t r = row_of_[place];
        float* const values = result_.values.data() + r * row_.size();
        constexpr std::size_t line = 64 / sizeof(float);  // of the cache, performance only
        for (std::size_t k = 0; k < row_.size(); k += line) prefetch_to_write(values + k);
        trust found = described(place, places);
        if (!usable(found)) std::fill(row_.begin(), row_.end(), 0.0);
        if (!move_row(values)) found = trust::not_finite;
        if (found != trust::good) result_.trust[r] = found;
    }

  private:
    [[nodiscard]] trust described(std::size_t place, std::span<const std::uint32_t> places) {
        positions_.resize(places.size());
        for (std::size_t k = 0; k < places.size(); ++k) {
            const auto q = tree_.position(places[k]);
            positions_[k] = {q[0], q[1], q[2]};
        }
        const auto at = tree_.position(place);
        const Eigen::Vector3d p(at[0], at[1], at[2]);
        const Eigen::Vector3d normal = unit_normal(surface_[tree_.index()[place]].normal);
        const neighborhood_view neighbors(positions_);
        if constexpr (neighbor_extras<D>::any)
            return describe_(p, normal, neighbors, row_, extras_.at(places, extra_));
        else
            return describe_(p, normal, neighbors, row_);
    }

    /// Stores the row in the result, where it is zero unless all entries are finite, and makes it
    /// zero.
    /// @return whether all are
    [[nodiscard]] bool move_row(float* values) {
        const bool finite = with_widest([row = row_.data(), size = row_.size(), values](auto) {
            constexpr double most = std::numeric_limits<float>::max();
            constexpr std::size_t block = slim_pack::size;
            constexpr std::uint32_t all = (std::uint32_t{1} << block) - 1;
            std::uint32_t in_range = all;
            std::size_t k = 0;
            for (; k + block <= size; k += block) {
                in_range &= at_most(magnitude(slim_pack(row + k)), most);
                for (std::size_t l = 0; l < block; ++l)
                    values[k + l] = static_cast<float>(row[k + l]);
            }
            for (; k < size; ++k) {
                if (!(std::abs(row[k]) <= most)) in_range = 0;
                values[k] = static_cast<float>(row[k]);
            }
            std::fill_n(row, size, 0.0);
            return in_range == all;
        });
        if (!finite) std::fill_n(values, row_.size(), 0.0f);
        return finite;
    }

    const leaf_tree& tree_;
    const Surface& surface_;
    const D& describe_;
    const neighbor_extras<D>& extras_;
    std::span<const point_index> row_of_;
    point_descriptors& result_;
    scratch<double> row_;  // zero before and after each point
    scratch<Eigen::Vector3d> positions_;
    scratch<typename neighbor_extras<D>::value> extra_;
};

/// The trust of a descriptor as far as point and normal determine it.
[[nodiscard]] trust trust_before(const spatial_index& index, const auto& surface, std::size_t i) {
    if (!index.is_finite(i) || !all_finite(surface[i].normal)) return trust::not_finite;
    const trust normal = trust_of_normal(surface[i]);
    return usable(normal) && is_missing(surface[i].normal) ? trust::degenerate : normal;
}

/// The descriptors of the points of n indices.
/// @param point_of  the index of row r
template <descriptor D, normal_range Surface, execution X>
[[nodiscard]] point_descriptors described_points(const spatial_index& index, const Surface& surface,
                                                 std::size_t n, auto&& point_of, const D& describe,
                                                 const X& run) {
    require_valid(describe);
    require(std::ranges::size(surface) == index.size(),
            "describe_points: surface and points differ in size");
    const double reach = describe.support_radius();
    require(reach >= 0.0 && std::isfinite(reach),
            "describe_points: the support radius must be finite and not negative");
    const leaf_tree& tree = index.tree();
    point_descriptors result;
    result.dimension = describe.dimension();
    resize_touched(result.values, n * result.dimension, run);
    result.trust.resize(n);
    scratch<point_index> row_of(tree.size(), no_row);
    scratch<point_index> again;  // rows of points that have another one before
    for (std::size_t r = 0; r < n; ++r) {
        const std::size_t i = point_of(r);
        require(i < index.size(), "describe_points: an index is out of range");
        result.trust[r] = trust_before(index, surface, i);
        if (!usable(result.trust[r])) {
            std::fill_n(result.values.data() + r * result.dimension, result.dimension, 0.0f);
            continue;
        }
        point_index& row = row_of[tree.place_of(i)];
        if (row == no_row)
            row = static_cast<point_index>(r);
        else
            again.push_back(static_cast<point_index>(r));
    }
    if (tree.size() > 0) {
        const neighbor_extras<D> extras(tree, surface, describe, run);
        const auto make_search = [&](const auto& of) {
            return leaf_balls(of, [&](std::size_t place) {
                if (row_of[place] == no_row) return -1.0;
                prefetch_element(surface, tree.index()[place]);
                return reach;
            });
        };
        search_all_groups(tree, run, make_search, [&] {
            return row_writer<D, Surface>(tree, surface, describe, extras, row_of, result);
        });
    }
    for (const std::size_t r : again) {
        const std::size_t first = row_of[tree.place_of(point_of(r))];
        std::copy_n(result[first].data(), result.dimension,
                    result.values.data() + r * result.dimension);
        result.trust[r] = result.trust[first];
    }
    return result;
}

}  // namespace detail

/// The descriptors of some points of a cloud.
///
/// @param points      any point range of n points [m], or the `spatial_index` of them
/// @param surface     n surface elements, such as the result of `estimate_normals`; most
///                    descriptors require oriented normals (`orient_normals`)
/// @param keypoints   the indices of the points to describe, in any order; all points are neighbors
/// @param describe    any descriptor
/// @param run         `sequential{}`, `threads{n}` or another execution; the result is the same
/// @param projection  maps an element of the range to a point
/// @return a descriptor of each keypoint, in their order. It is not usable, and zero, if the point
///         or its normal is not finite (`not_finite`), if the normal is missing (the trust of its
///         surface element, or `degenerate`), or if the descriptor determines so; it is at most
///         `weak` where the trust of the normal is. The entries do not depend on which other points
///         are described, up to rounding.
/// @throws std::invalid_argument  if points and surface differ in size, an index is not below n, or
///                                a parameter of the descriptor is out of range
/// Complexity: O(n), a search and a call of the descriptor for each keypoint, and the index if
/// `points` is none. Source: Klasing 2010, Sec. 3.4.
template <class R, normal_range Surface, descriptor D, execution X = sequential,
          class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] point_descriptors describe_points(const R& points, const Surface& surface,
                                                std::span<const point_index> keypoints,
                                                const D& describe, const X& run = {},
                                                Proj projection = {}) {
    const auto& team = detail::staying(run);
    const auto& index = detail::index_of(points, team, projection);
    return detail::described_points(
        index, surface, keypoints.size(), [keypoints](std::size_t r) { return keypoints[r]; },
        describe, team);
}

/// The descriptors of all points, in their order. Parameters, result, errors and complexity are as
/// above.
template <class R, normal_range Surface, descriptor D, execution X = sequential,
          class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] point_descriptors describe_points(const R& points, const Surface& surface,
                                                const D& describe, const X& run = {},
                                                Proj projection = {}) {
    const auto& team = detail::staying(run);
    const auto& index = detail::index_of(points, team, projection);
    return detail::described_points(index, surface, index.size(), std::identity{}, describe, team);
}

}  // namespace gnomon
