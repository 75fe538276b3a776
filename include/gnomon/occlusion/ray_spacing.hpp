// SPDX-License-Identifier: BSL-1.0
/// @file
/// How far apart the rays of a cloud are, for range images of clouds whose sensor is not known.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/viewpoints.hpp>

namespace gnomon {

namespace detail {

/// As good as random, of a direction by a microradian: the same wherever the cloud lies.
[[nodiscard]] inline std::uint64_t drawn_number(const Eigen::Vector3d& direction) {
    constexpr double steps = 1e6;  // of a microradian; numerical: more than rounding
    constexpr int bits = 21;       // for all steps from -1 to 1 (formula)
    std::int64_t all = 0;
    for (int a = 0; a < 3; ++a)
        all = all << bits | static_cast<std::int64_t>((direction[a] + 1.0) * steps + 0.5);
    return random_stream(static_cast<std::uint64_t>(all)).bits();
}

/// Which seeds a direction may be near to, by cubes.
class cubes_of_seeds {
  public:
    /// @param reach  how far away rays are near [rad]
    explicit cubes_of_seeds(double reach) : reach_(reach + margin) {}

    /// Adds seed number s, of up to 32, to all cubes with directions in its reach.
    void add(std::size_t s, const Eigen::Vector3d& d) {
        std::array<std::size_t, 3> low{}, high{};
        for (std::size_t a = 0; a < 3; ++a) {
            const double at = d[static_cast<int>(a)];
            low[a] = place(std::max(-1.0, at - reach_));
            high[a] = place(std::min(1.0, at + reach_));
        }
        for (std::size_t x = low[0]; x <= high[0]; ++x)
            for (std::size_t y = low[1]; y <= high[1]; ++y)
                for (std::size_t z = low[2]; z <= high[2]; ++z)
                    seeds_[(x * side + y) * side + z] |= 1U << s;
    }

    /// One bit for each seed.
    [[nodiscard]] std::uint32_t seeds_near(const Eigen::Vector3d& d) const {
        return seeds_[(place(d[0]) * side + place(d[1])) * side + place(d[2])];
    }

  private:
    static constexpr double margin = 1e-9;      // [rad]; rounding
    static constexpr std::size_t side = 21;     // cubes (performance only)
    static constexpr double per_unit = 10.0;    // cubes (performance only)
    static constexpr double from_start = 1.05;  // rounding leaves -1 and 1 within the cubes

    /// Of a coordinate from -1 to 1.
    [[nodiscard]] static std::size_t place(double x) {
        return static_cast<std::size_t>((x + from_start) * per_unit);
    }

    double reach_;
    scratch<std::uint32_t> seeds_ = scratch<std::uint32_t>(side * side * side, 0);
};

/// See ray_spacing: one run over a cloud.
template <class Points>
class rays_of_cloud {
  public:
    /// @param p  a position_view
    rays_of_cloud(const Points& p, const viewpoint_table& viewpoints)
        : points_(p), viewpoints_(viewpoints) {
        directions_.reserve(p.size());
        for (std::size_t i = 0; i < p.size(); ++i) {
            const Eigen::Vector3d way = difference(p[i], viewpoints[i]);
            if (!has_length(way)) continue;  // nor do those have one that are not finite
            directions_.push_back(scaled(1.0 / length(way), way));
            point_.push_back(static_cast<point_index>(i));
        }
    }

    [[nodiscard]] angle spacing() const {
        constexpr double nearby = 1.0 / 16.0;   // of the squared reach (performance only)
        constexpr double three_of_four = 0.75;  // of the rays are no farther apart; chosen
        if (directions_.empty()) return radians(most);
        scratch<double> squared;
        const auto add = [&squared](scratch<double>& near) {
            std::nth_element(near.begin(), near.begin() + neighbors, near.end());
            squared.push_back(near[neighbors]);
        };
        // Most seeds have enough rays nearby; those of the others are looked for farther away.
        const scratch<std::size_t> seeds = drawn();
        scratch<scratch<double>> found = near_seeds(seeds, reach2 * nearby);
        scratch<std::size_t> others;
        for (std::size_t s = 0; s < seeds.size(); ++s) {
            if (found[s].size() > neighbors)
                add(found[s]);
            else
                others.push_back(seeds[s]);
        }
        if (!others.empty()) found = near_seeds(others, reach2);
        for (std::size_t s = 0; s < others.size(); ++s) {
            if (found[s].size() > neighbors)
                add(found[s]);
            else
                squared.push_back(reach2);
        }
        const auto at = squared.begin() + static_cast<std::ptrdiff_t>(
                                              three_of_four * static_cast<double>(squared.size()));
        std::nth_element(squared.begin(), at, squared.end());
        return radians(std::clamp(std::sqrt(*at * std::numbers::pi / neighbors), least, most));
    }

  private:
    static constexpr std::size_t neighbors = 16;   // of a seed; chosen
    static constexpr std::size_t seed_count = 32;  // a sample (performance only)
    /// [rad] (performance only): an image has 26 million pixels.
    static constexpr double least = std::numbers::pi / 3600;
    static constexpr double most = std::numbers::pi / 36;  // [rad]; chosen: 5 degrees
    // Rays farther from a seed than this need not be looked at: 16 within it are `most` apart.
    static constexpr double reach2 = most * most * neighbors / std::numbers::pi;

    /// Some of the rays, of different directions, drawn by their numbers: the same in whatever
    /// order the points are stored, which may well be as regular as any other way to draw them.
    [[nodiscard]] scratch<std::size_t> drawn() const {
        scratch<std::pair<std::uint64_t, std::size_t>> some;
        for (std::size_t r = 0; r < directions_.size(); ++r) {
            const std::uint64_t number = drawn_number(directions_[r]);
            if (some.size() == seed_count && number > some.back().first) continue;
            const auto at = std::lower_bound(
                some.begin(), some.end(), number,
                [](const auto& other, std::uint64_t own) { return other.first < own; });
            if (at != some.end() && at->first == number) {
                if (as_numbers(r) < as_numbers(at->second)) at->second = r;
                continue;
            }
            some.insert(at, {number, r});
            if (some.size() > seed_count) some.pop_back();
        }
        scratch<std::size_t> chosen;
        for (const auto& s : some) chosen.push_back(s.second);
        return chosen;
    }

    /// The squares of the angles [rad^2] from each seed to the rays near it, as chords.
    /// @param within  the largest of them
    [[nodiscard]] scratch<scratch<double>> near_seeds(const scratch<std::size_t>& chosen,
                                                      double within) const {
        cubes_of_seeds about(std::sqrt(within));
        // From where the point of a seed is seen in nearly the same direction, rays count: stations
        // apart do not see more finely by being many, the lines of a moving sensor do.
        struct seed {
            Eigen::Vector3d direction, origin;
            double apart2;  // [m^2]
        };
        scratch<seed> seeds;
        for (std::size_t s = 0; s < chosen.size(); ++s) {
            const point_index i = point_[chosen[s]];
            const Eigen::Vector3d origin = viewpoints_[i];
            seeds.push_back({directions_[chosen[s]], origin,
                             most * most * squared_distance(origin, points_[i])});
            about.add(s, seeds[s].direction);
        }
        const bool is_still = viewpoints_.positions().size() <= 1;
        scratch<scratch<double>> near(chosen.size());
        for (std::size_t r = 0; r < directions_.size(); ++r) {
            const Eigen::Vector3d& d = directions_[r];
            for (std::uint32_t left = about.seeds_near(d); left != 0; left &= left - 1) {
                const auto s = static_cast<std::size_t>(std::countr_zero(left));
                const double squared = squared_distance(seeds[s].direction, d);
                if (squared < within &&
                    (is_still ||
                     squared_distance(seeds[s].origin, viewpoints_[point_[r]]) <= seeds[s].apart2))
                    near[s].push_back(squared);
            }
        }
        return near;
    }

    [[nodiscard]] std::array<double, 6> as_numbers(std::size_t r) const {
        const Eigen::Vector3d p = points_[point_[r]], v = viewpoints_[point_[r]];
        return {p[0], p[1], p[2], v[0], v[1], v[2]};
    }

    const Points& points_;
    const viewpoint_table& viewpoints_;
    scratch<Eigen::Vector3d> directions_;
    scratch<point_index> point_;  // of each direction
};

/// The spacing of the rays of a cloud [rad]: the side of the square of directions that each of the
/// 16 nearest rays has for itself, which is no more for three of four rays. From 32 rays, drawn as
/// if by chance, but in whatever order the points are; O(n).
template <class R, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] angle ray_spacing(const R& points, Proj projection = {}) {
    const position_view<R, Proj> p(points, std::move(projection));
    return with_table_of(points, [&p](const viewpoint_table& viewpoints) {
        return rays_of_cloud(p, viewpoints).spacing();
    });
}

}  // namespace detail
}  // namespace gnomon
