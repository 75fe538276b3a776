// SPDX-License-Identifier: BSL-1.0
/// @file
/// Planes with noise, and with points that are not of them: what robust estimators are made for.
#pragma once

#include <cmath>
#include <cstdint>

#include "laws/clouds.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/normals/gamma.hpp>

namespace outliers {

/// The mean gamma of an estimator over 500 planes of 20 cm with 40 neighbors, noise of 5 mm, and
/// the given share of neighbors anywhere within 10 cm of the plane, on one side.
inline double mean_gamma_with(const auto& estimate, double share) {
    double sum = 0.0;
    constexpr int trials = 500;
    for (std::uint64_t seed = 0; seed < trials; ++seed) {
        gnomon::random_stream random(seed, 21);
        clouds::cloud neighbors;
        for (int i = 0; i < 40; ++i) {
            const double x = random.uniform(-0.1, 0.1);
            const double y = random.uniform(-0.1, 0.1);
            const bool is_outlier = random.uniform() < share;
            neighbors.push_back({x, y,
                                 is_outlier ? random.uniform(0.0, 0.1) * (1.0 + 10.0 * x)
                                            : 0.005 * random.gaussian()});
        }
        const Eigen::Vector3d p(0.0, 0.0, 0.005 * random.gaussian());
        sum += gnomon::gamma(estimate(p, neighbors).normal, Eigen::Vector3d::UnitZ());
    }
    return sum / trials;
}

}  // namespace outliers
