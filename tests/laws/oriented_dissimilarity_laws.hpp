// SPDX-License-Identifier: BSL-1.0
/// @file
/// The laws of the `oriented_dissimilarity` concept, for any model: yours, too.
#pragma once

#include <cstdint>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/segmentation/segment_oriented_points.hpp>

namespace laws {

// [likeness_is_symmetric]
/// An oriented point is like itself; if i is like j, j is like i; and if two points are alike, they
/// would be so at a smaller distance.
template <gnomon::oriented_dissimilarity D>
void likeness_is_symmetric(const D& dissimilarity) {
    const auto alike = dissimilarity.criterion();
    const double limit = static_cast<double>(dissimilarity.radius) * dissimilarity.radius;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        gnomon::random_stream random(seed);
        const Eigen::Vector3d n = clouds::gaussian_vector(random).normalized();
        const double turn = seed % 2 ? 1.0 : 0.03;
        const Eigen::Vector3d m = (n + turn * clouds::gaussian_vector(random)).normalized();
        const double squared_distance = limit * random.uniform();
        ASSERT_TRUE(alike(0.0, n, n));
        ASSERT_EQ(alike(squared_distance, n, m), alike(squared_distance, m, n));
        if (alike(squared_distance, n, m)) {
            ASSERT_TRUE(alike(0.5 * squared_distance, n, m));
        }
    }
}
// [likeness_is_symmetric]

}  // namespace laws
