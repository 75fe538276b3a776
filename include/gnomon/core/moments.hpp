// SPDX-License-Identifier: BSL-1.0
/// @file
/// Sums over a neighborhood, taken about the query point: one pass of nine sums, from which every
/// linear fit follows. Differences to the query point lose nothing far from the origin, where raw
/// moments do: at UTM coordinates even raw double moments turn normals by degrees.
#pragma once

#include <cstddef>
#include <span>

#include <Eigen/Core>

#include <gnomon/core/detail/vector3.hpp>

namespace gnomon {

namespace detail {

/// sum += w d and the lower half of outer += w d d^T.
inline void add_moments(Eigen::Vector3d& sum, Eigen::Matrix3d& outer, const Eigen::Vector3d& d,
                        double w) {
    for (int j = 0; j < 3; ++j) {
        sum[j] += w * d[j];
        for (int i = j; i < 3; ++i) outer(i, j) += w * d[i] * d[j];
    }
}

/// w outer, whole. By columns: by rows, g++ 12 at -O3 makes nonsense of it in some places.
[[nodiscard]] inline Eigen::Matrix3d scaled_whole(const Eigen::Matrix3d& outer, double w) {
    Eigen::Matrix3d c;
    for (int j = 0; j < 3; ++j) {
        for (int i = j; i < 3; ++i) c(i, j) = c(j, i) = w * outer(i, j);
    }
    return c;
}

/// w outer - (w sum) (w sum)^T, whole.
[[nodiscard]] inline Eigen::Matrix3d covariance(const Eigen::Vector3d& sum,
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

/// Number, sum and sum of outer products of the offsets d_j = q_j - p of some neighbors q_j from
/// a point p. Plain loops: as expressions the compiler takes ten times as long to read them.
struct moments {
    std::size_t count = 0;
    Eigen::Vector3d sum{0.0, 0.0, 0.0};  ///< sum of d_j [m]
    Eigen::Matrix3d outer =
        detail::diagonal(0.0, 0.0, 0.0);  ///< sum of d_j d_j^T [m^2], its lower half

    /// Takes in the neighbor at `offset` [m] from the point.
    void add(const Eigen::Vector3d& offset) {
        ++count;
        detail::add_moments(sum, outer, offset, 1.0);
    }

    /// Takes out one that was taken in; what rounding leaves of it is little, if others stay.
    void remove(const Eigen::Vector3d& offset) {
        --count;
        detail::add_moments(sum, outer, offset, -1.0);
    }

    /// The covariance [m^2] of the neighbors and the point itself, the rows of Q+ in Eq. (3.2):
    /// 1/(k+1) times the scatter about their centroid. The point's own offset is zero.
    [[nodiscard]] Eigen::Matrix3d covariance_with_point() const { return about_mean(count + 1); }

    /// The mean [m] of the offsets, that of the point itself, zero, among them.
    [[nodiscard]] Eigen::Vector3d mean_with_point() const {
        return detail::scaled(1.0 / static_cast<double>(count + 1), sum);
    }

    /// The covariance [m^2] of the neighbors alone. Precondition: count > 0.
    [[nodiscard]] Eigen::Matrix3d covariance_of_neighbors() const { return about_mean(count); }

    /// The mean of the outer products [m^2]: second moments about the point, not about a mean.
    /// Precondition: count > 0.
    [[nodiscard]] Eigen::Matrix3d second_moments() const {
        return detail::scaled_whole(outer, 1.0 / static_cast<double>(count));
    }

  private:
    [[nodiscard]] Eigen::Matrix3d about_mean(std::size_t n) const {
        return detail::covariance(sum, outer, 1.0 / static_cast<double>(n));
    }
};

/// The same with weights.
struct weighted_moments {
    double weight = 0.0;                 ///< sum of w_j
    Eigen::Vector3d sum{0.0, 0.0, 0.0};  ///< sum of w_j d_j [m]
    Eigen::Matrix3d outer =
        detail::diagonal(0.0, 0.0, 0.0);  ///< sum of w_j d_j d_j^T [m^2], lower half

    /// Takes in what lies at `offset` [m] from the point, with weight `w`.
    void add(const Eigen::Vector3d& offset, double w) {
        weight += w;
        detail::add_moments(sum, outer, offset, w);
    }

    /// The weighted mean of the offsets [m]. Precondition: weight > 0.
    [[nodiscard]] Eigen::Vector3d mean() const { return detail::scaled(1.0 / weight, sum); }

    /// The weighted covariance [m^2]. Precondition: weight > 0.
    [[nodiscard]] Eigen::Matrix3d covariance() const {
        return detail::covariance(sum, outer, 1.0 / weight);
    }

    /// The weighted mean of the outer products: second moments about the point, not about a mean.
    /// Precondition: weight > 0.
    [[nodiscard]] Eigen::Matrix3d second_moments() const {
        return detail::scaled_whole(outer, 1.0 / weight);
    }
};

/// The moments of neighbors [m] about the point p [m]. O(k).
[[nodiscard]] inline moments moments_about(const Eigen::Vector3d& p,
                                           std::span<const Eigen::Vector3d> neighbors) {
    moments m;
    for (const Eigen::Vector3d& q : neighbors) m.add(detail::difference(q, p));
    return m;
}

}  // namespace gnomon
