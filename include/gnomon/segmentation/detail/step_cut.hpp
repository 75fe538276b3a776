// SPDX-License-Identifier: BSL-1.0
/// @file
/// The steps within a region: patches that are a little higher or lower than the rest of it, as the
/// wheels at the side of a car, or the next front of a row. By a standard deviation or two they
/// are within the noise of a common plane, and grow into one region; but the means over squares of
/// 16 points show them. The plane of the rest is that of the squares that are nearest to it (least
/// trimmed squares, Rousseeuw 1984), as that of all is tilted by a patch.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/segmentation/detail/common_paraboloid.hpp>
#include <gnomon/segmentation/detail/plane_comparison.hpp>
#include <gnomon/segmentation/detail/plane_squares.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>
#include <gnomon/segmentation/detail/surface_patch.hpp>

namespace gnomon::detail {

/// The search for the steps within one region. (Number is a parameter so that only its users
/// compile a sort.)
template <class Cloud, class Number = double>
class step_search {
  public:
    step_search(const Cloud& cloud, std::span<const point_index> members,
                const planar_region& whole, std::size_t min_points)
        : squares_(cloud, members, whole, points_of_square),
          whole_(whole),
          min_points_(min_points),
          part_(squares_.sums.size(), rest),
          height_(part_.size(), 0.0) {}

    /// Finds the patches, the highest first; each is left out before the next one is searched.
    /// @return their number
    [[nodiscard]] std::int32_t operator()() {
        std::int32_t patches = 0;
        if (squares_.sums.empty()) return patches;
        while (level_most()) {
            const scratch<std::size_t> highest = highest_patch();
            if (highest.empty()) break;
            ++patches;
            for (const std::size_t s : highest) part_[s] = patches;
        }
        return patches;
    }

    /// The patch of a member, from 1 on, or `rest`.
    [[nodiscard]] std::int32_t part_of(std::size_t member) const {
        return part_[squares_.square_of(member)];
    }

    static constexpr std::int32_t rest = 0;

  private:
    /// A step of one standard deviation is four of those of the mean of a square.
    static constexpr double points_of_square = 16.0;  // numerical
    /// The plane of most is fit to this share of the points.
    static constexpr double core = 0.5;  // formula: of least trimmed squares
    /// The rest has at least this share of the points, as a step may halve a region.
    static constexpr double least = 0.4;  // numerical

    [[nodiscard]] bool is_of_rest(std::size_t s) const {
        return part_[s] == rest && squares_.sums[s].count > 0;
    }

    /// Sets the heights of the squares above the plane of most of the rest: of those that begin as
    /// the plane of all of it or of a half of the extent, the one that half of it is nearest to.
    /// @return whether there is one
    [[nodiscard]] bool level_most() {
        constexpr std::size_t halves = 4;  // formula: two of each axis
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t half = 0; half <= halves; ++half) {
            plane_sums sums;
            for (std::size_t s = 0; s < part_.size(); ++s)
                if (is_of_rest(s) && (half == halves || squares_.is_in_half(s, half)))
                    sums.add(squares_.sums[s]);
            const region_plane level = settled(sums.fit());
            if (!level.is_determined || !(level.chi2 < nearest)) continue;
            nearest = level.chi2;
            level_ = level;
        }
        if (!std::isfinite(nearest)) return false;
        for (std::size_t s = 0; s < part_.size(); ++s)
            if (is_of_rest(s)) height_[s] = height_above(level_, s);
        return true;
    }

    [[nodiscard]] double height_above(const region_plane& level, std::size_t s) const {
        return level.plane.signed_distance(squares_.sums[s].positions.mean());
    }

    /// The plane of the squares of the rest that are nearest to it, and have half of the points.
    /// @param level  where it begins
    [[nodiscard]] region_plane settled(region_plane level) const {
        constexpr int passes = 10;  // numerical: then it hardly moves
        for (int pass = 0; pass < passes && level.is_determined; ++pass) {
            scratch<std::pair<Number, std::size_t>> nearest;
            std::size_t points = 0;
            for (std::size_t s = 0; s < part_.size(); ++s) {
                if (!is_of_rest(s)) continue;
                nearest.emplace_back(std::abs(height_above(level, s)), s);
                points += squares_.sums[s].count;
            }
            std::sort(nearest.begin(), nearest.end());
            plane_sums sums;
            for (const auto& [height, s] : nearest) {
                sums.add(squares_.sums[s]);
                if (static_cast<double>(sums.count) >= core * static_cast<double>(points)) break;
            }
            level = sums.fit();
        }
        return level;
    }

    /// Of the patches that are at a step to the rest, the highest or lowest one.
    [[nodiscard]] scratch<std::size_t> highest_patch() const {
        scratch<std::size_t> best;
        double most = 0.0;
        scratch<char> is_visited(part_.size(), false);
        for (std::size_t s = 0; s < part_.size(); ++s) {
            if (is_visited[s] != 0 || !is_of_rest(s) || !is_off(s)) continue;
            double height = 0.0;
            scratch<std::size_t> patch = patch_around(s, is_visited, height);
            if (height > most && is_at_step(patch)) {
                most = height;
                best.swap(patch);
            }
        }
        return best;
    }

    [[nodiscard]] bool is_off(std::size_t s) const {
        const double variance = squares_.sums[s].noise_across(level_.plane.normal);
        return std::abs(height_[s]) > most_deviations * std::sqrt(variance * level_.excess());
    }

    /// The patch that a square is of: those connected with it that are on the same side of the
    /// plane and farther from it than half of the mean height of those found so far.
    /// @param height  becomes that mean, without its sign [m]
    [[nodiscard]] scratch<std::size_t> patch_around(std::size_t seed, scratch<char>& is_visited,
                                                    double& height) const {
        constexpr double half = 0.5;  // formula: between both planes
        const double sign = height_[seed] < 0.0 ? -1.0 : 1.0;
        scratch<std::size_t> patch(1, seed);
        is_visited[seed] = true;
        double sum = 0.0, count = 0.0;
        for (std::size_t p = 0; p < patch.size(); ++p) {
            const auto points = static_cast<double>(squares_.sums[patch[p]].count);
            sum += points * sign * height_[patch[p]];
            count += points;
            height = sum / count;
            squares_.for_each_around(patch[p], [&](std::size_t s) {
                if (is_visited[s] != 0 || part_[s] != rest || sign * height_[s] < half * height)
                    return;
                is_visited[s] = true;
                patch.push_back(s);
            });
        }
        return patch;
    }

    /// Whether a patch is at a step to the rest, without other patches. A bend is not, which a
    /// paraboloid explains better than two planes.
    [[nodiscard]] bool is_at_step(const scratch<std::size_t>& patch) const {
        planar_region own, others;
        for (const std::size_t s : patch) own.sums.add(squares_.sums[s]);
        if (own.sums.summands < min_points_) return false;
        scratch<char> is_own(part_.size(), false);
        for (const std::size_t s : patch) is_own[s] = true;
        std::size_t left = 0;  // points of the rest, with other patches
        for (std::size_t s = 0; s < part_.size(); ++s) {
            if (!is_of_rest(s) || is_own[s] != 0) continue;
            left += squares_.sums[s].count;
            if (!is_off(s)) others.sums.add(squares_.sums[s]);
        }
        if (others.sums.summands < min_points_ ||
            static_cast<double>(left) < least * static_cast<double>(whole_.sums.count))
            return false;
        own.fit = own.sums.fit();
        others.fit = others.sums.fit();
        if (!are_at_step(own, others)) return false;
        surface_patch of_own{{}, own.sums}, of_others{{}, others.sums};
        for (std::size_t s = 0; s < part_.size(); ++s) {
            if (!is_of_rest(s)) continue;
            if (is_own[s] != 0)
                of_own.parts.push_back(part_with(squares_.sums[s], own));
            else if (!is_off(s))
                of_others.parts.push_back(part_with(squares_.sums[s], others));
        }
        return !common_paraboloid(of_own, of_others).is_better();
    }

    plane_squares<Cloud> squares_;
    const planar_region& whole_;
    std::size_t min_points_;
    scratch<std::int32_t> part_;  // of each square
    scratch<double> height_;      // above the plane of most of the rest [m]
    region_plane level_;          // that plane
};

/// The numbers of the patches of the members of a region, from 1 on, and 0 for the rest of them;
/// none if there is no step within it. O(n + s log s) for s squares of 16 members, and for each
/// patch.
/// @param cloud       a planar_cloud
/// @param members     of the region, all finite
/// @param min_points  the least number of each part
template <class Cloud>
[[nodiscard]] scratch<std::int32_t> step_cut(const Cloud& cloud,
                                             std::span<const point_index> members,
                                             const planar_region& whole, std::size_t min_points) {
    scratch<std::int32_t> parts;
    if (members.size() < 2 * min_points || !whole.fit.is_determined ||
        whole.fit.chi2 > region_plane::most_excess)
        return parts;
    step_search<Cloud> search(cloud, members, whole, min_points);
    if (search() == 0) return parts;
    for (std::size_t m = 0; m < members.size(); ++m) parts.push_back(search.part_of(m));
    return parts;
}

}  // namespace gnomon::detail
