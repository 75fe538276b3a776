// SPDX-License-Identifier: BSL-1.0
/// @file
/// The distance between feature vectors, with a weight for each feature. Klasing 2010, Eq. (5.2).
#pragma once

#include <array>
#include <cstddef>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>

namespace gnomon::recognition {

/// How the weighted differences of the features become a distance.
enum class difference_sum {
    absolute,   ///< sum of w_m |d_m|, a metric: a distance of 0.1 allows a variation of 10 %
    as_printed  ///< |sum of w_m d_m| / D, Eq. (5.2): opposite differences cancel. For the record
};

/// The weighted distance of two feature vectors, with weights of any sum: they are divided by it.
///
///     const gnomon::recognition::weighted_distance<5> rho{{.30, .30, .13, .13, .13}};
///     const double d = rho(a, b);
template <std::size_t D>
struct weighted_distance {
    std::array<double, D> weights = equal();        ///< not negative, not all 0
    difference_sum sum = difference_sum::absolute;  ///< how the features are added up

    /// The distance of two vectors of finite values. O(D).
    /// @return not negative
    [[nodiscard]] double operator()(const std::array<double, D>& a,
                                    const std::array<double, D>& b) const {
        double total = 0.0, distance = 0.0;
        for (std::size_t m = 0; m < D; ++m) {
            const double d = a[m] - b[m];
            total += weights[m];
            distance += weights[m] * (sum == difference_sum::absolute ? std::abs(d) : d);
        }
        if (sum == difference_sum::as_printed) total *= static_cast<double>(D);
        return std::abs(distance) / total;
    }

    /// @throws std::invalid_argument  if a weight is negative, infinite or NaN, or all are 0
    void require_weights() const {
        double total = 0.0;
        for (const double w : weights) {
            gnomon::detail::require(w >= 0.0, "weighted_distance: a weight is negative or NaN");
            total += w;
        }
        gnomon::detail::require(total > 0.0 && std::isfinite(total),
                                "weighted_distance: the sum of the weights is 0 or not finite");
    }

  private:
    static constexpr std::array<double, D> equal() {
        std::array<double, D> w{};
        w.fill(1.0);
        return w;
    }
};

}  // namespace gnomon::recognition
