// SPDX-License-Identifier: BSL-1.0
/// @file
/// The frame in which a surface near a point is a height over its tangent plane: z along the
/// normal, x and y along the principal components of the neighbors across it (Klasing 2010,
/// Sec. 3.3.2). Plain sums: once per point, and nothing on the heap.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/features/detail/eigen_2x2.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/plane_fit.hpp>

namespace gnomon::detail {

/// A right-handed frame at a point. Its numbers hold for the ring that it was made of.
struct height_frame {
    Eigen::Vector3d origin;
    Eigen::Vector3d x;  ///< the direction of larger spread
    Eigen::Vector3d y;
    Eigen::Vector3d z;          ///< the normal, of unit length
    double rms_x = 0.0;         ///< root of the mean square of the neighbors' x [m]
    double rms_y = 0.0;         ///< the same of y [m]
    double aspect_ratio = 0.0;  ///< sigma_ar in the tangent plane, Eq. (3.19)
    gnomon::trust trust = gnomon::trust::too_few_neighbors;  ///< usable, or there is no frame

    /// @param min_aspect_ratio  below which the trust is weak
    height_frame(const Eigen::Vector3d& p, const Eigen::Vector3d& normal, ring_view ring,
                 std::size_t min_neighbors, double min_aspect_ratio)
        : origin(p) {
        if (!is_finite(p) || !all_finite(normal)) {
            trust = gnomon::trust::not_finite;
            return;
        }
        if (is_missing(normal)) {
            trust = gnomon::trust::degenerate;
            return;
        }
        if (ring.size() < min_neighbors) return;
        z = direction_of(normal);
        x = orthogonal(z);
        y = cross(z, x);
        trust = align(ring, min_aspect_ratio);
    }

    /// The coordinates of q [m].
    [[nodiscard]] std::array<double, 3> operator()(const Eigen::Vector3d& q) const {
        const Eigen::Vector3d d = difference(q, origin);
        return {dot(x, d), dot(y, d), dot(z, d)};
    }

    /// The direction of (a, b, c), not normalised.
    [[nodiscard]] Eigen::Vector3d direction(double a, double b, double c) const {
        return combined(a, x, b, y, c, z);
    }

  private:
    /// Turns x and y to the principal components of Q+, the ring and the point, in their plane.
    gnomon::trust align(ring_view ring, double min_aspect_ratio) {
        double sum_x = 0.0, sum_y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0, zz = 0.0;
        for (const Eigen::Vector3d& q : ring) {
            const auto [a, b, c] = (*this)(q);
            sum_x += a;
            sum_y += b;
            xx += a * a;
            xy += a * b;
            yy += b * b;
            zz += c * c;
        }
        if (!std::isfinite(xx + yy + zz)) return gnomon::trust::not_finite;
        // A radius whose square's inverse is no number has no curvature.
        const double k = static_cast<double>(ring.size());
        constexpr double epsilon = std::numeric_limits<double>::epsilon();
        if (xx + yy < k * std::numeric_limits<double>::min() / epsilon) {
            return gnomon::trust::degenerate;
        }
        const double w = 1.0 / (k + 1.0);
        const eigen_2x2 spread(w * xx - (w * sum_x) * (w * sum_x),
                               w * xy - (w * sum_x) * (w * sum_y),
                               w * yy - (w * sum_y) * (w * sum_y));
        // On one line, up to the same gap as in plane_pca.
        if (spread.smaller <= smallest_gap * spread.larger) return gnomon::trust::degenerate;
        aspect_ratio = std::sqrt(spread.smaller / spread.larger);

        const double c = spread.c;
        const double s = spread.s;
        const Eigen::Vector3d u = x;
        x = combined(c, u, s, y);
        y = combined(c, y, -s, u);
        rms_x = std::sqrt(std::max(0.0, c * c * xx + 2.0 * c * s * xy + s * s * yy) / k);
        rms_y = std::sqrt(std::max(0.0, s * s * xx - 2.0 * c * s * xy + c * c * yy) / k);
        return aspect_ratio < min_aspect_ratio ? gnomon::trust::weak : gnomon::trust::good;
    }
};

}  // namespace gnomon::detail
