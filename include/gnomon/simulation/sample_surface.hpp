// SPDX-License-Identifier: BSL-1.0
/// @file
/// Samples of the visible surfaces of a model, evenly spaced: what a sensor can see of it from
/// outside, without inner surfaces and undersides that no ray reaches.
///
///     namespace sim = gnomon::simulation;
///     const auto samples = sim::sample_surface(sim::furniture_models()[0]);
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/simulation/bounds.hpp>
#include <gnomon/simulation/bvh_caster.hpp>
#include <gnomon/simulation/furniture.hpp>
#include <gnomon/simulation/ray.hpp>
#include <gnomon/simulation/ray_caster.hpp>
#include <gnomon/simulation/scene.hpp>

namespace gnomon::simulation {

/// A point of a surface.
struct surface_sample {
    Eigen::Vector3d position;  ///< [m]
    Eigen::Vector3d normal;    ///< unit vector, towards the side from which it was seen
};

/// How a surface is sampled.
struct surface_sampling {
    double spacing = 0.015;  ///< about one sample per square of this size [m]
    /// Directions, all round and from above and below, from which parallel rays are cast; chosen:
    /// each part of a surface is met by several rays per square.
    int directions = 96;
    std::uint64_t seed = 1;

    /// @throws std::invalid_argument  unless the spacing is positive and finite, and there is a
    ///                                direction
    void require_valid() const {
        using gnomon::detail::require;
        require(spacing > 0.0 && std::isfinite(spacing),
                "sample_surface: the spacing must be positive and finite");
        require(directions > 0, "sample_surface: requires a direction");
    }
};

namespace detail {

/// Accepts candidates that are not too near to an accepted one of a similar normal (dart throwing,
/// Cook 1986).
class spaced_samples {
  public:
    explicit spaced_samples(double least_distance) : least_(least_distance) {}

    void add(const surface_sample& candidate) {
        const auto cell = cell_of(candidate.position);
        for (std::int64_t x = -1; x <= 1; ++x) {
            for (std::int64_t y = -1; y <= 1; ++y) {
                for (std::int64_t z = -1; z <= 1; ++z) {
                    const auto found = cells_.find(key_of({cell[0] + x, cell[1] + y, cell[2] + z}));
                    if (found == cells_.end()) continue;
                    for (const std::uint32_t i : found->second)
                        if (is_same(samples_[i], candidate)) return;
                }
            }
        }
        cells_[key_of(cell)].push_back(static_cast<std::uint32_t>(samples_.size()));
        samples_.push_back(candidate);
    }

    [[nodiscard]] std::vector<surface_sample> take() { return std::move(samples_); }

  private:
    using cell_index = std::array<std::int64_t, 3>;

    [[nodiscard]] bool is_same(const surface_sample& a, const surface_sample& b) const {
        constexpr double similar = 0.5;  // chosen: 60 degrees; both sides of an edge are sampled
        return squared_distance(a.position, b.position) < least_ * least_ &&
               a.normal.dot(b.normal) > similar;
    }

    [[nodiscard]] cell_index cell_of(const Eigen::Vector3d& p) const {
        cell_index c{};
        for (std::size_t a = 0; a < 3; ++a)
            c[a] = static_cast<std::int64_t>(std::floor(p[static_cast<int>(a)] / least_));
        return c;
    }

    /// Different for cells that are less than 2^21 apart.
    [[nodiscard]] static std::uint64_t key_of(const cell_index& c) {
        constexpr std::uint64_t mask = (std::uint64_t{1} << 21) - 1;
        std::uint64_t key = 0;
        for (const std::int64_t a : c) key = (key << 21) | (static_cast<std::uint64_t>(a) & mask);
        return key;
    }

    double least_;
    std::vector<surface_sample> samples_;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

/// The direction `number` of `count` that are evenly distributed on the sphere (Fibonacci).
[[nodiscard]] inline Eigen::Vector3d direction_of_sphere(int number, int count) {
    const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double z = 1.0 - (2.0 * number + 1.0) / count;
    const double radius = std::sqrt(std::max(0.0, 1.0 - z * z));
    return {radius * std::cos(golden * number), radius * std::sin(golden * number), z};
}

}  // namespace detail

/// Samples the surfaces of a scene that are visible from outside of it: by parallel rays from all
/// directions, of whose hits those are left out that are nearer than 0.83 spacings to another,
/// which is the distance at which about one is left per square of the spacing. A model is sampled
/// in its own frame.
///
/// The same options give the same samples. O(rays), some 10^4 to 10^5 for each direction.
/// @return the samples in random order; none for an empty scene
/// @throws std::invalid_argument  for options that are not valid
[[nodiscard]] inline std::vector<surface_sample> sample_surface(
    const scene& model, const surface_sampling& options = {}) {
    options.require_valid();
    if (model.shapes().empty()) return {};
    const bvh_caster cast(model);
    const bounds extent = model.extent();
    const Eigen::Vector3d middle = extent.middle(), size = extent.size();
    const double radius = 0.5 * std::sqrt(size.dot(size)) + options.spacing;
    random_stream random(options.seed);
    std::vector<surface_sample> hits;
    for (int d = 0; d < options.directions; ++d) {
        const Eigen::Vector3d from = detail::direction_of_sphere(d, options.directions);
        const Eigen::Vector3d u = gnomon::detail::orthogonal(from);
        const Eigen::Vector3d v = gnomon::detail::cross(from, u);
        const auto half_width = [&](const Eigen::Vector3d& axis) {
            return 0.5 * (std::abs(axis.x()) * size.x() + std::abs(axis.y()) * size.y() +
                          std::abs(axis.z()) * size.z()) +
                   options.spacing;
        };
        const double width = half_width(u), height = half_width(v);
        for (double a = -width; a < width; a += options.spacing) {
            for (double b = -height; b < height; b += options.spacing) {
                const double s = a + options.spacing * random.uniform();
                const double t = b + options.spacing * random.uniform();
                const ray r{middle + from * radius + u * s + v * t, from * -1.0};
                if (const auto hit = cast(r)) hits.push_back({r.point_at(hit->range), hit->normal});
            }
        }
    }
    for (std::size_t i = hits.size(); i > 1; --i) std::swap(hits[i - 1], hits[random.below(i)]);
    constexpr double packed = 0.83;  // sqrt(.547 * 4 / pi): density of random packings of disks
    detail::spaced_samples spaced(packed * options.spacing);
    for (const surface_sample& s : hits) spaced.add(s);
    return spaced.take();
}

/// Samples the surfaces of a furniture model in its frame, as above.
[[nodiscard]] inline std::vector<surface_sample> sample_surface(
    const furniture_model& model, const surface_sampling& options = {}) {
    scene alone;
    add(alone, model);
    return sample_surface(alone, options);
}

}  // namespace gnomon::simulation
