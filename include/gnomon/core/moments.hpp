// SPDX-License-Identifier: BSL-1.0
/// @file
/// Zeroth, first and second moments of a neighborhood about its query point, from which every
/// linear fit follows. They are accumulated in one pass over the neighbors, as ten numbers.
///
/// Moments about the query point keep their digits far from the origin. Moments about the origin do
/// not: at UTM coordinates (1e6 m) they turn normals by degrees, even in double precision.
#pragma once

#include <cstddef>
#include <span>

#include <Eigen/Core>

#include <gnomon/core/detail/vector3.hpp>

namespace gnomon {

namespace detail {

/// sum += w d, and outer += w d d^T in its lower triangle. Without loops, which g++ -O2 keeps:
/// performance only.
inline void add_moments(Eigen::Vector3d& sum, Eigen::Matrix3d& outer, const Eigen::Vector3d& d,
                        double w) {
    sum[0] += w * d[0];
    sum[1] += w * d[1];
    sum[2] += w * d[2];
    outer(0, 0) += w * d[0] * d[0];
    outer(1, 0) += w * d[1] * d[0];
    outer(2, 0) += w * d[2] * d[0];
    outer(1, 1) += w * d[1] * d[1];
    outer(2, 1) += w * d[2] * d[1];
    outer(2, 2) += w * d[2] * d[2];
}

/// w outer as a full matrix, of which `outer` holds the lower triangle. Written column by column:
/// g++ 12 at -O3 miscompiles the loop over rows at some call sites.
[[nodiscard]] inline Eigen::Matrix3d scaled_whole(const Eigen::Matrix3d& outer, double w) {
    Eigen::Matrix3d c;
    for (int j = 0; j < 3; ++j) {
        for (int i = j; i < 3; ++i) c(i, j) = c(j, i) = w * outer(i, j);
    }
    return c;
}

/// w outer - (w sum) (w sum)^T as a full matrix, of which `outer` holds the lower triangle.
[[nodiscard]] inline Eigen::Matrix3d covariance_of(const Eigen::Vector3d& sum,
                                                   const Eigen::Matrix3d& outer, double w) {
    Eigen::Matrix3d c;
    for (int j = 0; j < 3; ++j) {
        for (int i = j; i < 3; ++i) {
            c(i, j) = c(j, i) = w * outer(i, j) - (w * sum[i]) * (w * sum[j]);
        }
    }
    return c;
}

}  // namespace detail

/// Number, sum and sum of outer products of the offsets d_j = q_j - p of neighbors q_j from a query
/// point p [m].
///
/// A `moment_estimator` computes its normal from this struct alone, so that a search can accumulate
/// neighbors without listing them. Plain loops take a tenth of the compile time of Eigen
/// expressions.
struct moments {
    std::size_t count = 0;               ///< number k of neighbors
    Eigen::Vector3d sum{0.0, 0.0, 0.0};  ///< sum of d_j [m]
    Eigen::Matrix3d outer =
        detail::diagonal(0.0, 0.0, 0.0);  ///< sum of d_j d_j^T [m^2]; lower triangle only

    /// The moments of `neighbors` [m] about the point p [m]. O(k) for k neighbors.
    [[nodiscard]] static moments about(const Eigen::Vector3d& p,
                                       std::span<const Eigen::Vector3d> neighbors) {
        moments m;
        for (const Eigen::Vector3d& q : neighbors) m.add(detail::difference(q, p));
        return m;
    }

    /// Adds the neighbor at `offset` [m] from the query point.
    void add(const Eigen::Vector3d& offset) {
        ++count;
        detail::add_moments(sum, outer, offset, 1.0);
    }

    /// Removes a neighbor that was added before. Leaves a rounding error relative to the largest
    /// sums so far. Precondition: count > 0.
    void remove(const Eigen::Vector3d& offset) {
        --count;
        detail::add_moments(sum, outer, offset, -1.0);
    }

    /// The covariance [m^2] of the neighbors and the query point, the rows of Q+ in Klasing 2010,
    /// Eq. (3.2): 1/(k+1) times the scatter about their centroid. The query point's own offset is
    /// zero.
    [[nodiscard]] Eigen::Matrix3d covariance_with_point() const { return about_mean(count + 1); }

    /// The centroid [m] of the neighbors and the query point, relative to the query point.
    [[nodiscard]] Eigen::Vector3d mean_with_point() const {
        return detail::scaled(1.0 / static_cast<double>(count + 1), sum);
    }

    /// The covariance [m^2] of the neighbors without the query point. Precondition: count > 0.
    [[nodiscard]] Eigen::Matrix3d covariance_of_neighbors() const { return about_mean(count); }

    /// The mean of d_j d_j^T [m^2]: second moments about the query point, not about the centroid.
    /// Precondition: count > 0.
    [[nodiscard]] Eigen::Matrix3d second_moments() const {
        return detail::scaled_whole(outer, 1.0 / static_cast<double>(count));
    }

  private:
    [[nodiscard]] Eigen::Matrix3d about_mean(std::size_t n) const {
        return detail::covariance_of(sum, outer, 1.0 / static_cast<double>(n));
    }
};

}  // namespace gnomon
