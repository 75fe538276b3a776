// SPDX-License-Identifier: BSL-1.0
/// @file
/// Beams that are directed at walls, and what an instrument reads.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/random.hpp>
#include <gnomon/simulation/beam.hpp>
#include <gnomon/simulation/detail/instrument.hpp>
#include <gnomon/simulation/ray.hpp>

namespace beams {

namespace sim = gnomon::simulation;

/// A wall across the x axis.
struct wall {
    double range;
    double cosine = 1.0;  ///< of the incidence, as its normal says

    std::optional<sim::ray_hit> operator()(const sim::ray& r) const {
        const double t = (range - r.origin.x()) / r.direction.x();
        if (!(t > 0.0 && t <= r.reach)) return std::nullopt;
        return sim::ray_hit{t, {-cosine, std::sqrt(1 - cosine * cosine), 0}, 0};
    }
};

/// Two walls: the near one where y > edge.
struct step {
    double near;
    double far;
    double edge = 0.0;

    std::optional<sim::ray_hit> operator()(const sim::ray& r) const {
        const double t = (near - r.origin.x()) / r.direction.x();
        if (r.origin.y() + t * r.direction.y() > edge) return sim::ray_hit{t, {-1, 0, 0}, 0};
        return sim::ray_hit{(far - r.origin.x()) / r.direction.x(), {-1, 0, 0}, 1};
    }
};

inline const sim::ray ahead{{0, 0, 0}, {1, 0, 0}};

/// Those of n beams ahead, whose noise differs.
template <class C>
auto readings(const C& caster, const sim::beam& b, std::size_t n, double max_range = 10.0) {
    const sim::detail::instrument<C> read(caster, b, 0.0, max_range);
    std::vector<typename sim::detail::instrument<C>::reading> all;
    for (std::size_t i = 0; i < n; ++i) {
        gnomon::random_stream random(b.seed, i);
        all.push_back(read(ahead, random));
    }
    return all;
}

/// The root of their mean squared error.
double deviation(const auto& all, double truth) {
    double sum = 0.0;
    for (const auto& r : all) sum += (r.range - truth) * (r.range - truth);
    return std::sqrt(sum / static_cast<double>(all.size()));
}

}  // namespace beams
