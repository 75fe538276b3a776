// SPDX-License-Identifier: BSL-1.0
/// @file
/// The laws of the weights of `averaging`.
#pragma once

#include <cmath>
#include <cstdint>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/normals/averaging.hpp>

namespace laws {

// [weight_is_of_the_triangle]
/// A triangle has the same finite weight whichever neighbor comes first and however it is turned.
template <gnomon::detail::triangle_weight W>
void weight_is_of_the_triangle(const W& weight) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        gnomon::random_stream random(seed);
        const Eigen::Vector3d a = clouds::gaussian_vector(random);
        const Eigen::Vector3d b = clouds::gaussian_vector(random);
        const double double_area =
            std::sqrt(a.squaredNorm() * b.squaredNorm() - a.dot(b) * a.dot(b));
        const double w = weight(a, b, double_area);
        ASSERT_TRUE(std::isfinite(w));
        const Eigen::Matrix3d r = clouds::random_rotation(seed);
        ASSERT_NEAR(weight(b, a, double_area), w, 1e-12 * std::abs(w));
        ASSERT_NEAR(weight(r * a, r * b, double_area), w, 1e-9 * std::abs(w));
    }
}
// [weight_is_of_the_triangle]

}  // namespace laws
