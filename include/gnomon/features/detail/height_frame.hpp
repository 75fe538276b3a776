// SPDX-License-Identifier: BSL-1.0
/// @file
/// The local frame in which a surface near a point is a height field over its tangent plane: z
/// along the normal, x and y along the principal components of the neighbors in the tangent plane
/// (Klasing 2010, Sec. 3.3.2).
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

/// A right-handed orthonormal frame at a point, and statistics of the neighbors in it.
struct height_frame {
    Eigen::Vector3d origin;     ///< the point [m]
    Eigen::Vector3d x;          ///< tangent direction of larger variance, unit length
    Eigen::Vector3d y;          ///< tangent direction of smaller variance, unit length
    Eigen::Vector3d z;          ///< the normal, unit length
    double rms_x = 0.0;         ///< root mean square of the neighbors' x [m]
    double rms_y = 0.0;         ///< root mean square of the neighbors' y [m]
    double aspect_ratio = 0.0;  ///< sigma_ar in the tangent plane, Eq. (3.19)
    gnomon::trust trust = gnomon::trust::too_few_neighbors;  ///< no frame unless usable

    /// Trust: `not_finite` if point, normal or a neighbor is not finite; `degenerate` if the normal
    /// is missing, or if the projections of the neighbors to the tangent plane are collinear.
    /// @param min_neighbors     number of neighbors below which the trust is `too_few_neighbors`
    /// @param min_aspect_ratio  sigma_ar below which the trust is `weak`
    /// Complexity: O(k).
    height_frame(const Eigen::Vector3d& p, const Eigen::Vector3d& normal,
                 neighborhood_view neighbors, std::size_t min_neighbors, double min_aspect_ratio)
        : origin(p) {
        if (!is_finite(p) || !all_finite(normal)) {
            trust = gnomon::trust::not_finite;
            return;
        }
        if (is_missing(normal)) {
            trust = gnomon::trust::degenerate;
            return;
        }
        if (neighbors.size() < min_neighbors) return;
        z = direction_of(normal);
        x = orthogonal(z);
        y = cross(z, x);
        trust = align(neighbors, min_aspect_ratio);
    }

    /// The coordinates [m] of the point q [m] in the frame.
    [[nodiscard]] std::array<double, 3> operator()(const Eigen::Vector3d& q) const {
        const Eigen::Vector3d d = difference(q, origin);
        return {dot(x, d), dot(y, d), dot(z, d)};
    }

    /// The vector a x + b y + c z, not normalized.
    [[nodiscard]] Eigen::Vector3d direction(double a, double b, double c) const {
        return combined(a, x, b, y, c, z);
    }

  private:
    /// Rotates x and y to the principal components of Q+, the neighbors and the point, in the
    /// tangent plane.
    gnomon::trust align(neighborhood_view neighbors, double min_aspect_ratio) {
        double sum_x = 0.0, sum_y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0, zz = 0.0;
        for (const Eigen::Vector3d& q : neighbors) {
            const auto [a, b, c] = (*this)(q);
            sum_x += a;
            sum_y += b;
            xx += a * a;
            xy += a * b;
            yy += b * b;
            zz += c * c;
        }
        if (!std::isfinite(xx + yy + zz)) return gnomon::trust::not_finite;
        // Curvatures of a smaller neighborhood would overflow.
        const double k = static_cast<double>(neighbors.size());
        constexpr double epsilon = std::numeric_limits<double>::epsilon();
        if (xx + yy < k * std::numeric_limits<double>::min() / epsilon) {
            return gnomon::trust::degenerate;
        }
        const double w = 1.0 / (k + 1.0);
        const eigen_2x2 spread(w * xx - (w * sum_x) * (w * sum_x),
                               w * xy - (w * sum_x) * (w * sum_y),
                               w * yy - (w * sum_y) * (w * sum_y));
        // The neighbors are collinear, by the same threshold as in plane_pca.
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
