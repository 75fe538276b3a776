// SPDX-License-Identifier: BSL-1.0
/// @file
/// What a `range_noise` promises.
#pragma once

#include <cmath>

#include <gtest/gtest.h>

#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/range_noise.hpp>

namespace laws {

// [is_a_standard_deviation]
/// From 5 cm to 500 m the noise is finite, not negative, and the same each time.
template <gnomon::range_noise N>
void is_a_standard_deviation(const N& noise) {
    for (double x = 0.05; x <= 500.0; x *= 1.01) {
        const double sigma = noise(x);
        ASSERT_GE(sigma, 0.0) << x;
        ASSERT_TRUE(std::isfinite(sigma)) << x;
        ASSERT_EQ(sigma, static_cast<double>(noise(x)));
    }
}

/// The curve of a model is the model, to 0.3 %.
template <gnomon::range_noise N>
void converts_to_a_curve(const N& noise) {
    const gnomon::noise_curve curve = noise;
    for (double x = 0.05; x <= 500.0; x *= 1.01)
        ASSERT_NEAR(curve(x), noise(x), 0.003 * noise(x)) << x;
}
// [is_a_standard_deviation]

}  // namespace laws
