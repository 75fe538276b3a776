// SPDX-License-Identifier: BSL-1.0
/// @file
/// Joining of surfaces of revolution (vases, cups, columns), which a segmentation by normals
/// oversegments where they turn faster than its threshold from point to point. A few points do not
/// distinguish them from an edge that is blended by large neighborhoods; the whole does: the
/// normals of a surface of revolution all meet its axis, those of a box miss any axis by a good
/// part of its width.
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

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/union_find.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/features/principal_frame.hpp>
#include <gnomon/neighborhoods/detail/place_set.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/segmentation/detail/axis_of_normals.hpp>
#include <gnomon/segmentation/detail/link_within.hpp>
#include <gnomon/segmentation/segment_surfaces.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon {

/// Parameters of `join_surfaces_of_revolution`.
struct join_surfaces_of_revolution_options {
    double sigma = 0.015;  ///< standard deviation of ranges [m]: radii of 2 sigma can be told
    /// Largest mean distance of the points of a joined segment from its axis [m]; a segment may be
    /// joined if it is at most four times as long.
    double max_radius = 0.25;
    double max_distance = 0.30;   ///< between points that are connected [m]; rho_max
    std::size_t min_points = 30;  ///< the smallest size of a joined segment
};

namespace detail {

/// Whether lines are the normals of a surface of revolution: eight in ten miss a common axis by a
/// sixth of the radius at most, and they turn about it by at least 80 degrees. The normals of a
/// disk are excluded, which are parallel to its axis.
template <class Line>
[[nodiscard]] bool are_of_something_round(std::span<Line> lines,
                                          const join_surfaces_of_revolution_options& options) {
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
template <class Surface>
class revolution_joiner {
  public:
    revolution_joiner(const spatial_index& points, const Surface& surface, const segments& parts,
                      const join_surfaces_of_revolution_options& options)
        : points_(points),
          surface_(surface),
          parts_(parts),
          options_(options),
          sets_(points_.size()) {}

    /// The labels after joining.
    template <execution X>
    [[nodiscard]] scratch<std::int32_t> operator()(const X& run) {
        const scratch<point_index> some = candidates();
        join_near(some, run);
        scratch<char> is_candidate(points_.size(), false);
        for (const point_index i : some) is_candidate[i] = true;
        const label_groups groups(labels_of_sets(
            sets_, options_.min_points, [&](std::size_t i) { return is_candidate[i] != 0; }));
        scratch<std::int32_t> labels(parts_.labels().begin(), parts_.labels().end());
        // One array for all threads: the memory in use does not depend on which groups are tested
        // at the same time.
        scratch<std::size_t> begin(groups.size() + 1, 0);
        for (std::size_t g = 0; g < groups.size(); ++g) begin[g + 1] = begin[g] + groups[g].size();
        scratch<normal_line> lines(begin.back());
        run(groups.size(), [&](std::size_t g) {
            const auto own = std::span(lines).subspan(begin[g], groups[g].size());
            if (!are_of_something_round(normal_lines(groups[g], own), options_)) return;
            for (const point_index i : without_disks(groups[g], own))
                labels[i] = static_cast<std::int32_t>(parts_.size() + g);
        });
        number_by_size(labels);
        return labels;
    }

  private:
    [[nodiscard]] bool has_normal(std::size_t i) const {
        return is_finite(points_[i]) && all_finite(Eigen::Vector3d(surface_[i].normal)) &&
               !is_missing(surface_[i].normal);
    }

    /// Points with a normal that are unlabeled, or of a segment small enough to be part of a
    /// surface of revolution, ascending; the points of such a segment stay together.
    [[nodiscard]] scratch<point_index> candidates() {
        scratch<char> may_be_piece(parts_.size());
        for (std::size_t s = 0; s < parts_.size(); ++s) {
            may_be_piece[s] = is_small(parts_[s]);
            if (may_be_piece[s] == 0) continue;
            for (const point_index i : parts_[s]) sets_.unite(parts_[s].front(), i);
        }
        scratch<point_index> some;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const std::int32_t label = parts_.labels()[i];
            if ((label == unlabeled || may_be_piece[static_cast<std::size_t>(label)] != 0) &&
                has_normal(i))
                some.push_back(static_cast<point_index>(i));
        }
        return some;
    }

    /// No wider than half of a cylinder, the variance of whose width is half of its squared radius,
    /// and no longer than four radii: excludes the step of a stair on which a vase stands and to
    /// which a few unlabeled points connect it.
    [[nodiscard]] bool is_small(std::span<const point_index> part) const {
        scratch<Eigen::Vector3d> positions;
        positions.reserve(part.size());
        for (const point_index i : part) positions.push_back(points_[i]);
        const auto spread = principal_axes_of(moments_about_first(positions)).spectrum.lambda;
        const double squared_radius = options_.max_radius * options_.max_radius;
        return spread[1] <= 0.5 * squared_radius && spread[0] <= 16.0 / 12.0 * squared_radius;
    }

    /// Unites connected points as Alg. 4.2 does, whatever the angle between their normals.
    template <execution X>
    void join_near(std::span<const point_index> some, const X& run) {
        const smooth_link<Surface> link(
            surface_, {.max_angle = degrees(90), .max_distance = options_.max_distance},
            points_.size());
        const place_set among(points_.tree(), some);
        linker near(points_);
        near.link_all([&link](std::size_t i) { return link.radius(i); }, link, run, &among);
        for (const point_index i : some) sets_.unite(near.root_of(i), i);
    }

    /// A group but for its segments whose normals are along its axis: a piece of the table that a
    /// vase stands on, cut off by it, meets its axis no worse than the vase.
    /// @param memory  for as many lines as the group has points
    [[nodiscard]] scratch<point_index> without_disks(std::span<const point_index> group,
                                                     std::span<normal_line> memory) const {
        constexpr double least_across = 0.25;  // 30 degrees from the axis
        std::span<normal_line> lines = normal_lines(group, memory);
        const axis_of_normals axis = robust_axis_of(lines);
        scratch<std::int32_t> disks;
        scratch<point_index> rest;
        for (const point_index i : group) {
            const std::int32_t label = parts_.labels()[i];
            if (label == unlabeled) continue;
            const auto part = parts_[static_cast<std::size_t>(label)];
            if (part.front() != i) continue;
            double across = 0.0;
            lines = normal_lines(part, memory);
            for (const normal_line& l : lines) across += axis.across(l);
            if (across < least_across * static_cast<double>(lines.size())) disks.push_back(label);
        }
        for (const point_index i : group)
            if (std::find(disks.begin(), disks.end(), parts_.labels()[i]) == disks.end())
                rest.push_back(i);
        return rest;
    }

    /// The lines of the points with a normal, in `memory`.
    [[nodiscard]] std::span<normal_line> normal_lines(std::span<const point_index> group,
                                                      std::span<normal_line> memory) const {
        const Eigen::Vector3d origin = points_[*std::find_if(
            group.begin(), group.end(), [this](point_index i) { return has_normal(i); })];
        std::size_t count = 0;
        for (const point_index i : group)
            if (has_normal(i))
                memory[count++] = {difference(points_[i], origin), surface_[i].normal};
        return memory.first(count);
    }

    const spatial_index& points_;
    const Surface& surface_;
    const segments& parts_;
    const join_surfaces_of_revolution_options& options_;
    union_find sets_;
};

/// join_surfaces_of_revolution(index, surface, parts, options, run), in the memory of `result`,
/// which may be `parts`.
template <surfel_range Surface, execution X>
void join_surfaces_of_revolution_into(segments& result, const spatial_index& points,
                                      const Surface& surface, const segments& parts,
                                      const join_surfaces_of_revolution_options& options,
                                      const X& run) {
    require(parts.labels().size() == points.size(),
            "join_surfaces_of_revolution: the numbers of points and of labels differ");
    require(std::ranges::size(surface) == points.size(),
            "join_surfaces_of_revolution: the numbers of points and of surface elements differ");
    require(options.sigma >= 0.0, "join_surfaces_of_revolution: sigma must not be negative or NaN");
    require(options.max_radius >= 0.0,
            "join_surfaces_of_revolution: max_radius must not be negative or NaN");
    require(options.max_distance >= 0.0,
            "join_surfaces_of_revolution: max_distance must not be negative or NaN");
    result.assign(revolution_joiner(points, surface, parts, options)(run));
}

}  // namespace detail

/// The segments, where connected points of one surface of revolution are one segment: unlabeled
/// points and whole segments of limited width. Other points keep their segment.
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
[[nodiscard]] segments join_surfaces_of_revolution(
    const R& points, const Surface& surface, const segments& parts,
    const join_surfaces_of_revolution_options& options = {}, const X& run = {},
    Proj projection = {}) {
    const auto& team = detail::staying(run);
    segments result;
    detail::join_surfaces_of_revolution_into(result, detail::index_of(points, team, projection),
                                             surface, parts, options, team);
    return result;
}

}  // namespace gnomon
