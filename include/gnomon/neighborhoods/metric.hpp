// SPDX-License-Identifier: BSL-1.0
/// @file
/// Distances between positions: the Minkowski distances (sum |d_a|^p)^(1/p) over the three
/// coordinate differences d_a, among them the Manhattan distance (p = 1), the Euclidean distance
/// (p = 2) and the maximum distance (p = infinity).
///
/// Klasing 2010, App. A.1.
#pragma once

#include <algorithm>
#include <limits>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>

namespace gnomon {

/// The Minkowski distance of order p. `metric{}` is the Euclidean distance.
struct metric {
    double p = 2.0;  ///< at least 1; may be infinite

    /// |dx| + |dy| + |dz|
    [[nodiscard]] static constexpr metric manhattan() { return {1.0}; }
    [[nodiscard]] static constexpr metric euclidean() { return {2.0}; }  ///< p = 2
    /// The largest of |dx|, |dy| and |dz|.
    [[nodiscard]] static constexpr metric maximum() {
        return {std::numeric_limits<double>::infinity()};
    }

    /// The squared distance of positions whose coordinates differ by x, y and z [m^2].
    [[nodiscard]] double squared(double x, double y, double z) const {
        if (p == 2.0) return x * x + y * y + z * z;
        x = std::abs(x), y = std::abs(y), z = std::abs(z);
        if (p == 1.0) return (x + y + z) * (x + y + z);
        const double most = std::max({x, y, z});
        if (most == 0.0 || p == std::numeric_limits<double>::infinity()) return most * most;
        // Ratios first: powers of coordinates may overflow.
        const double sum = std::pow(x / most, p) + std::pow(y / most, p) + std::pow(z / most, p);
        const double distance = most * std::pow(sum, 1.0 / p);
        return distance * distance;
    }

    friend bool operator==(const metric&, const metric&) = default;
};

namespace detail {

/// @throws std::invalid_argument  unless the order is at least 1
inline void require_valid(const metric& m) {
    require(m.p >= 1.0, "metric: the order p must be at least 1");
}

}  // namespace detail
}  // namespace gnomon
