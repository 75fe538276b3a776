// SPDX-License-Identifier: BSL-1.0
/// @file
/// Eigenvalues and eigenvectors of a symmetric 2x2 matrix, in closed form.
#pragma once

#include <gnomon/core/detail/cmath.hpp>

namespace gnomon::detail {

/// Of a symmetric 2x2 matrix: its eigenvalues and the unit eigenvector (c, s) of the larger one;
/// (-s, c) is that of the smaller. Of equal eigenvalues the eigenvector is (1, 0).
struct eigen_2x2 {
    double larger;
    double smaller;
    double c = 1.0;
    double s = 0.0;

    /// Of [[xx, xy], [xy, yy]].
    eigen_2x2(double xx, double xy, double yy) {
        const double mean = 0.5 * (xx + yy);
        const double half = 0.5 * (xx - yy);
        const double radius = std::sqrt(half * half + xy * xy);
        larger = mean + radius;
        smaller = mean - radius;
        // Of the two rows of A - larger I, the one without cancellation.
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
