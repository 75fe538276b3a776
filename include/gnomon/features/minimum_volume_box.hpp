// SPDX-License-Identifier: BSL-1.0
/// @file
/// The box of smallest volume around a point set or segment. In no umbrella: include it by name.
///
///     const auto chair = gnomon::minimum_volume_box(gnomon::subset_view(scan, parts[s]));
///
/// It is that of the convex hull, and has an edge of the hull on each of two adjacent faces
/// (O'Rourke 1985, Finding minimal enclosing boxes). These boxes are searched on the hull of a few
/// extreme points, whose smallest box is a lower bound; the extreme points along its axes join the
/// few until the bound is met.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/oriented_box.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/features/convex_hull.hpp>
#include <gnomon/features/convex_polygon.hpp>
#include <gnomon/features/detail/box_fit.hpp>
#include <gnomon/features/detail/flush_boxes.hpp>
#include <gnomon/features/detail/local_points.hpp>
#include <gnomon/features/detail/polytope.hpp>
#include <gnomon/features/minimum_area_rectangle.hpp>
#include <gnomon/features/principal_frame.hpp>

namespace gnomon {

namespace detail {

/// The smallest box around the corners of a hull: repeats the search on a growing core of them.
class smallest_box {
  public:
    /// @param corners  with coordinates up to 1 in magnitude, not coplanar
    /// @param start    axes of a box that the result is not larger than
    smallest_box(std::span<const Eigen::Vector3d> corners,
                 const std::array<Eigen::Vector3d, 3>& start)
        : corners_(corners), best_(corners, start) {
        const std::size_t thinnest = best_.thinnest();
        constexpr double flat = 1e-13;  // a height of rounding errors alone
        if (best_.size(thinnest) < flat) {
            best_ = turned_about(best_, thinnest, corners);
            return;
        }
        best_ = refined(best_, corners);
        join_extremes_along_a_lattice();
        join(best_);
        constexpr double tolerance = 1e-7;         // numerical
        constexpr std::size_t largest_core = 200;  // performance only: all of smaller hulls
        while (core_.size() <= largest_core) {
            const polytope hull(core_);
            const flush_boxes search(hull, best_.volume * (1.0 - tolerance));
            if (!search.found()) {
                is_proven_ = search.is_complete();
                return;
            }
            const box_fit found(corners, search.best());
            const bool has_grown = join(found);
            const box_fit better = refined(found, corners);
            join(better);
            if (better.volume < best_.volume) best_ = better;
            if (!has_grown) {
                is_proven_ = search.is_complete();
                return;
            }
        }
    }

    [[nodiscard]] const box_fit& best() const { return best_; }
    /// Whether no box is smaller by more than 1e-7 of the volume.
    [[nodiscard]] bool is_proven() const { return is_proven_; }

  private:
    bool join(std::uint32_t corner) {
        if (std::find(members_.begin(), members_.end(), corner) != members_.end()) return false;
        members_.push_back(corner);
        core_.push_back(corners_[corner]);
        return true;
    }

    /// Adds the corners on the faces of a box; returns whether any is new.
    bool join(const box_fit& box) {
        bool is_new = false;
        for (std::size_t a = 0; a < 3; ++a) {
            is_new = join(box.lowest[a]) || is_new;
            is_new = join(box.highest[a]) || is_new;
        }
        return is_new;
    }

    /// Adds the extremes along the 13 axes through the neighbors in a cubic lattice aligned with
    /// the box, which is stretched to a cube.
    void join_extremes_along_a_lattice() {
        for (int code = 0; code < 13; ++code) {
            Eigen::Vector3d direction(0.0, 0.0, 0.0);
            int digits = code;
            for (std::size_t a = 0; a < 3; ++a, digits /= 3) {
                const double size = best_.size(a);
                if (size > 0.0)
                    direction = combined(1.0, direction, (digits % 3 - 1) / size, best_.axes[a]);
            }
            std::uint32_t lowest = 0;
            std::uint32_t highest = 0;
            for (std::uint32_t i = 1; i < corners_.size(); ++i) {
                const double x = dot(direction, corners_[i]);
                if (x < dot(direction, corners_[lowest])) lowest = i;
                if (x > dot(direction, corners_[highest])) highest = i;
            }
            join(lowest);
            join(highest);
        }
    }

    std::span<const Eigen::Vector3d> corners_;
    box_fit best_;
    std::vector<std::uint32_t> members_;  // corners of the core
    std::vector<Eigen::Vector3d> core_;
    bool is_proven_ = false;
};

/// The box of a fit to local points, its axes by descending length, right-handed.
[[nodiscard]] inline oriented_box box_of(const box_fit& fit, const local_points& p) {
    std::array<std::size_t, 3> order{0, 1, 2};
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return fit.size(a) > fit.size(b); });
    oriented_box box;
    Eigen::Vector3d center(0.0, 0.0, 0.0);
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t a = order[k];
        center = combined(1.0, center, 0.5 * (fit.low[a] + fit.high[a]), fit.axes[a]);
        box.lengths[static_cast<int>(k)] = fit.size(a) / p.scale;
    }
    box.center = combined(1.0, p.origin, 1.0 / p.scale, center);
    const Eigen::Vector3d& x = fit.axes[order[0]];
    const Eigen::Vector3d& y = fit.axes[order[1]];
    box.axes = from_columns(x, y, cross(x, y));
    return box;
}

}  // namespace detail

/// The box of smallest volume around the finite points of a range. Its axes are by descending
/// length. Around coplanar points it is the rectangle of smallest area, around collinear ones their
/// line, without any finite point it is at its defaults.
/// @param points      any point range of n points [m]
/// @param projection  maps an element of the range to a point
/// @return the smallest box, to 1e-7 of its volume where the search proves it: for all tested hulls
///         of up to 200 vertices, and for larger ones if 200 of them suffice. It is cut off after
///         10,000 boxes of one pair of edges, and not begun for bodies thinner than 1e-13 of their
///         length. Never larger than the box of `principal_frame`
/// @throws std::invalid_argument  if n is 2^32 - 1 or more
/// Complexity: that of `convex_hull`, O(h) for its h vertices, and O(e^2) for the e edges of the
/// core. It takes no execution: the best box so far shortens the rest of the search.
template <class R, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] oriented_box minimum_volume_box(const R& points, Proj projection = {}) {
    const convex_hull hull = convex_hull::of(points, projection);
    if (hull.shape == hull_shape::none) return {};
    const subset_view<R, Proj> corners(points, hull.vertices, projection);
    if (hull.shape != hull_shape::solid) {
        const principal_frame frame = principal_frame::of(corners);
        const double offset = detail::dot(frame.normal(), frame.centroid);
        // As they are, whatever their view points.
        const std::vector<Eigen::Vector3d> bare(corners.begin(), corners.end());
        return minimum_area_rectangle(convex_polygon::of(bare, {frame.normal(), offset}));
    }
    const position_view<R, Proj> p(points, std::move(projection));
    const principal_frame frame = detail::principal_axes_of(detail::moments_about_first(p));
    const detail::local_points local(corners);
    const detail::smallest_box search(local.positions,
                                      {detail::column(frame.axes, 0), detail::column(frame.axes, 1),
                                       detail::column(frame.axes, 2)});
    return detail::box_of(search.best(), local);
}

}  // namespace gnomon
