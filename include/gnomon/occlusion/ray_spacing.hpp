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
    std::int64_t all = 0;
    for (int a = 0; a < 3; ++a)
        all = all << 21 | static_cast<std::int64_t>((direction[a] + 1.0) * 1e6 + 0.5);
    return random_stream(static_cast<std::uint64_t>(all)).bits();
}

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
        if (directions_.empty()) return radians(most);
        scratch<double> squared;
        for (scratch<double>& near : near_seeds(drawn())) {
            squared.push_back(reach2);
            if (near.size() <= neighbors) continue;
            std::nth_element(near.begin(), near.begin() + neighbors, near.end());
            squared.back() = near[neighbors];
        }
        const auto at = squared.begin() + static_cast<std::ptrdiff_t>(squared.size() * 3 / 4);
        std::nth_element(squared.begin(), at, squared.end());
        return radians(std::clamp(std::sqrt(*at * std::numbers::pi / neighbors), least, most));
    }

  private:
    static constexpr std::size_t neighbors = 16, seed_count = 32;
    static constexpr double least = std::numbers::pi / 3600, most = std::numbers::pi / 36;
    // Rays farther from a seed than this need not be looked at: 16 within it are `most` apart. In
    // cubes of more than this size, a ray has the seeds in its own cube and those about it.
    static constexpr double reach2 = most * most * neighbors / std::numbers::pi, size = 0.2;
    static_assert(reach2 < size * size);

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
    [[nodiscard]] scratch<scratch<double>> near_seeds(const scratch<std::size_t>& chosen) const {
        constexpr int cubes = 13;  // along a side, with one more at both ends
        scratch<std::uint32_t> seeds_about(cubes * cubes * cubes, 0);
        const auto cube_of = [](const Eigen::Vector3d& d) {
            const auto place = [&d](int a) { return static_cast<int>(d[a] / size + 6.5); };
            return static_cast<std::size_t>((place(0) * cubes + place(1)) * cubes + place(2));
        };
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
            for (int c = 0; c < 27; ++c) {
                const int way = ((c / 9 - 1) * cubes + c / 3 % 3 - 1) * cubes + c % 3 - 1;
                seeds_about[cube_of(seeds[s].direction) + static_cast<std::size_t>(way)] |= 1U << s;
            }
        }
        const bool is_still = viewpoints_.positions().size() <= 1;
        scratch<scratch<double>> near(chosen.size());
        for (std::size_t r = 0; r < directions_.size(); ++r) {
            const Eigen::Vector3d& d = directions_[r];
            for (std::uint32_t left = seeds_about[cube_of(d)]; left != 0; left &= left - 1) {
                const auto s = static_cast<std::size_t>(std::countr_zero(left));
                const double squared = squared_distance(seeds[s].direction, d);
                if (squared < reach2 &&
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
