// SPDX-License-Identifier: BSL-1.0
/// @file
/// Eigenvalues and eigenvectors of a symmetric 2x2 matrix, in closed form.
#pragma once

#include <gnomon/core/detail/cmath.hpp>

namespace gnomon::detail {

/// The eigenvalues of a symmetric 2x2 matrix and the unit eigenvector (c, s) of the larger one;
/// (-s, c) is the eigenvector of the smaller. If the eigenvalues are equal, (c, s) is (1, 0).
struct eigen_2x2 {
    double larger;
    double smaller;
    double c = 1.0;
    double s = 0.0;

    /// Decomposes [[xx, xy], [xy, yy]]. O(1).
    eigen_2x2(double xx, double xy, double yy) {
        const double mean = 0.5 * (xx + yy);
        const double half = 0.5 * (xx - yy);
        const double radius = std::sqrt(half * half + xy * xy);
        larger = mean + radius;
        smaller = mean - radius;
        // Orthogonal to that row of A - larger I in which no cancellation occurs.
        const double x = half >= 0.0 ? half + radius : xy;
        const double y = half >= 0.0 ? xy : radius - half;
        const double length = std::sqrt(x * x + y * y);
        if (length > 0.0) {
            c = x / length;
            s = y / length;
        }
    }
};

}  // namespace gnomon::detail
