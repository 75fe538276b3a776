// SPDX-License-Identifier: BSL-1.0
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/detail/weighted_moments.hpp>
#include <gnomon/core/moments.hpp>

namespace {

TEST(weighted_moments, of_whole_weights_are_moments_of_repeated_points) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const clouds::cloud points = clouds::in_cube(30, seed);
        gnomon::detail::weighted_moments weighted;
        gnomon::moments repeated;
        for (std::size_t j = 0; j < points.size(); ++j) {
            const std::size_t times = j % 4;
            weighted.add(points[j], 0.5 * static_cast<double>(times));
            for (std::size_t t = 0; t < times; ++t) repeated.add(points[j]);
        }
        const double n = static_cast<double>(repeated.count);
        EXPECT_DOUBLE_EQ(weighted.weight, 0.5 * n);
        EXPECT_LT((weighted.mean() - repeated.sum / n).norm(), 1e-14);
        EXPECT_LT((weighted.covariance() - repeated.covariance_of_neighbors()).norm(), 1e-14);
        EXPECT_LT((weighted.second_moments() - repeated.second_moments()).norm(), 1e-14);
    }
}

}  // namespace
