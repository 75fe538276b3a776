// SPDX-License-Identifier: BSL-1.0
/// @file
/// Makes one segment of a vase, a cup or a column: what turns by more from point to point than a
/// segmentation by normals lets pass falls into scraps and stray points. An edge, blended by large
/// neighborhoods, turns no faster than a slim vase, so that no look at a few points tells them
/// apart. The whole does: the normals of a surface of revolution all meet its axis, and those of a
/// box pass by any axis in a good part of its width.
///
/// (Not in the thesis, whose Alg. 4.2 is for surfaces that turn by at most 5 degrees from point to
/// point, as a vase does that is larger or scanned more densely.)
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/core/union_find.hpp>
#include <gnomon/features/principal_frame.hpp>
#include <gnomon/segmentation/detail/axis_of_normals.hpp>
#include <gnomon/segmentation/segments.hpp>
#include <gnomon/segmentation/surface_segmentation.hpp>

namespace gnomon {

/// Parameters of `join_round`.
struct round_joining {
    double sigma = 0.015;        ///< standard deviation of ranges [m]: radii of 2 sigma can be told
    double max_radius = 0.25;    ///< of what is joined, the mean over its points; of a piece that
                                 ///< is a segment, a quarter of the length [m]
    double max_distance = 0.30;  ///< rho_max between points that hang together [m]
    std::size_t min_points = 30;  ///< of what is joined
};

namespace detail {

/// Whether lines are normals of something round: eight in ten meet one axis, missing it by a
/// sixth of the radius at most, and they turn about it by some 80 degrees at least. Those of a
/// disk meet its axis too, being along it.
[[nodiscard]] inline bool are_of_something_round(std::vector<normal_line> lines,
                                                 const round_joining& options) {
    constexpr double least_share = 0.8, most_missed = 1.0 / 6.0;
    constexpr double least_across = 0.62;   // of a ball, 2/3
    constexpr double least_turning = 0.12;  // the variance of the sine of up to 37 degrees
    const double all = static_cast<double>(lines.size());
    const axis_of_normals axis = robust_axis_of(lines);
    return static_cast<double>(lines.size()) >= least_share * all &&
           axis.rms() <= most_missed * axis.radius() && axis.radius() >= 2.0 * options.sigma &&
           axis.radius() <= options.max_radius && axis.across() >= least_across &&
           axis.turning() >= least_turning;
}

/// One run over a cloud.
template <class R, class Surface, class Proj>
class round_joiner {
  public:
    round_joiner(const R& points, const Surface& surface, const segments& parts,
                 const round_joining& options, const Proj& projection)
        : range_(points),
          projection_(projection),
          points_(points, projection),
          surface_(surface),
          parts_(parts),
          options_(options),
          sets_(points_.size()) {}

    template <execution X>
    [[nodiscard]] segments operator()(const X& run) {
        const std::vector<point_index> some = candidates();
        join_near(some, run);
        std::vector<bool> is_candidate(points_.size(), false);
        for (const point_index i : some) is_candidate[i] = true;
        const segments groups =
            segments_of(sets_, options_.min_points, [&](std::size_t i) { return is_candidate[i]; });
        std::vector<std::int32_t> labels = parts_.labels();
        run(groups.size(), [&](std::size_t g) {
            if (!are_of_something_round(normal_lines(groups[g]), options_)) return;
            for (const point_index i : without_disks(groups[g]))
                labels[i] = static_cast<std::int32_t>(parts_.size() + g);
        });
        return largest_first(segments(std::move(labels))).first;
    }

  private:
    [[nodiscard]] bool has_normal(std::size_t i) const {
        return is_finite(points_[i]) && all_finite(Eigen::Vector3d(surface_[i].normal)) &&
               !is_missing(surface_[i].normal);
    }

    /// Points with a normal that are stray, or of a segment that may be a piece of something round,
    /// ascending; the points of such a segment stay together.
    [[nodiscard]] std::vector<point_index> candidates() {
        std::vector<bool> may_be_piece(parts_.size());
        for (std::size_t s = 0; s < parts_.size(); ++s) {
            may_be_piece[s] = is_small(parts_[s]);
            if (!may_be_piece[s]) continue;
            for (const point_index i : parts_[s]) sets_.unite(parts_[s].front(), i);
        }
        std::vector<point_index> some;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const std::int32_t label = parts_.labels()[i];
            if ((label == unlabeled || may_be_piece[static_cast<std::size_t>(label)]) &&
                has_normal(i))
                some.push_back(static_cast<point_index>(i));
        }
        return some;
    }

    /// No wider than half of a cylinder, the variance of whose width is half of its squared radius,
    /// and no longer than four radii: a stair is not, to which a vase hangs by a few stray points.
    [[nodiscard]] bool is_small(std::span<const point_index> part) const {
        const auto spread =
            principal_frame_of(subset_view<R, Proj>(range_, part, projection_)).spectrum.lambda;
        const double squared_radius = options_.max_radius * options_.max_radius;
        return spread[1] <= 0.5 * squared_radius && spread[0] <= 16.0 / 12.0 * squared_radius;
    }

    /// Joins what hangs together: by Alg. 4.2, whatever the angle.
    template <execution X>
    void join_near(const std::vector<point_index>& some, const X& run) {
        struct element {
            Eigen::Vector3d normal;
            double mean_distance;
        };
        std::vector<element> surface;
        for (const point_index i : some)
            surface.push_back({surface_[i].normal, static_cast<double>(surface_[i].mean_distance)});
        const segments near = segment_surfaces(
            subset_view<R, Proj>(range_, some, projection_), surface,
            {.max_angle = degrees(90), .max_distance = options_.max_distance, .min_points = 1},
            run);
        for (std::size_t s = 0; s < near.size(); ++s)
            for (const point_index k : near[s]) sets_.unite(some[near[s].front()], some[k]);
    }

    /// A group but for its segments whose normals are along its axis: a piece of the table that a
    /// vase stands on, cut off by it, meets its axis no worse than the vase.
    [[nodiscard]] std::vector<point_index> without_disks(std::span<const point_index> group) const {
        constexpr double least_across = 0.25;  // 30 degrees from the axis
        std::vector<normal_line> lines = normal_lines(group);
        const axis_of_normals axis = robust_axis_of(lines);
        std::vector<std::int32_t> disks;
        std::vector<point_index> rest;
        for (const point_index i : group) {
            const std::int32_t label = parts_.labels()[i];
            if (label == unlabeled) continue;
            const auto part = parts_[static_cast<std::size_t>(label)];
            if (part.front() != i) continue;
            double across = 0.0;
            lines = normal_lines(part);
            for (const normal_line& l : lines) across += axis.across(l);
            if (across < least_across * static_cast<double>(lines.size())) disks.push_back(label);
        }
        for (const point_index i : group)
            if (std::find(disks.begin(), disks.end(), parts_.labels()[i]) == disks.end())
                rest.push_back(i);
        return rest;
    }

    [[nodiscard]] std::vector<normal_line> normal_lines(std::span<const point_index> group) const {
        const Eigen::Vector3d origin = points_[*std::find_if(
            group.begin(), group.end(), [this](point_index i) { return has_normal(i); })];
        std::vector<normal_line> lines;
        for (const point_index i : group)
            if (has_normal(i))
                lines.push_back({difference(points_[i], origin), surface_[i].normal});
        return lines;
    }

    const R& range_;
    const Proj& projection_;
    position_view<R, Proj> points_;
    const Surface& surface_;
    const segments& parts_;
    const round_joining& options_;
    union_find sets_;
};

}  // namespace detail

/// The segments, where points that hang together and are something round are one segment: stray
/// points, and all of those segments that are no wider than round things may be. What is not round
/// stays as it was.
///
/// @param points   any point range of n points [m]
/// @param surface  their n surface elements, as estimate_normals gives them; normals of either sign
/// @param parts    segments of these points
/// @return the segments, largest first; the same bytes for every execution
/// @throws std::invalid_argument  if points, surface and segments differ in number, or if sigma,
///                                max_radius or max_distance is negative or NaN
/// Complexity: O(n), and that of segment_surfaces for the points without a wide segment.
template <class R, surfel_range Surface, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] segments join_round(const R& points, const Surface& surface, const segments& parts,
                                  const round_joining& options = {}, const X& run = {},
                                  Proj projection = {}) {
    const std::size_t n = position_view<R, Proj>(points, projection).size();
    detail::require(parts.labels().size() == n, "join_round: the segments are of other points");
    detail::require(std::ranges::size(surface) == n, "join_round: the surface is of other points");
    detail::require(options.sigma >= 0.0, "join_round: sigma must not be negative or NaN");
    detail::require(options.max_radius >= 0.0,
                    "join_round: max_radius must not be negative or NaN");
    detail::require(options.max_distance >= 0.0,
                    "join_round: max_distance must not be negative or NaN");
    return detail::round_joiner(points, surface, parts, options, projection)(run);
}

}  // namespace gnomon
