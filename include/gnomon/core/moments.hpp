// SPDX-License-Identifier: BSL-1.0
/// @file
/// Sums over a neighborhood, taken about the query point: one pass of nine sums, from which every
/// linear fit follows. Differences to the query point lose nothing far from the origin, where raw
/// moments do: at UTM coordinates even raw double moments turn normals by degrees.
#pragma once

#include <cstddef>

#include <Eigen/Core>

namespace gnomon {

/// Number, sum and sum of outer products of the offsets d_j = q_j - p of some neighbors q_j from
/// a point p. Plain loops: as expressions the compiler takes ten times as long to read them.
struct moments {
    std::size_t count = 0;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();    ///< sum of d_j [m]
    Eigen::Matrix3d outer = Eigen::Matrix3d::Zero();  ///< sum of d_j d_j^T [m^2], its lower half

    /// Takes in the neighbor at `offset` [m] from the point.
    void add(const Eigen::Vector3d& offset) {
        ++count;
        for (int j = 0; j < 3; ++j) {
            sum[j] += offset[j];
            for (int i = j; i < 3; ++i) outer(i, j) += offset[i] * offset[j];
        }
    }

    /// The covariance [m^2] of the neighbors and the point itself, the rows of Q+ in Eq. (3.2):
    /// 1/(k+1) times the scatter about their centroid. The point's own offset is zero.
    [[nodiscard]] Eigen::Matrix3d covariance_with_point() const { return covariance(count + 1); }

    /// The covariance [m^2] of the neighbors alone. Precondition: count > 0.
    [[nodiscard]] Eigen::Matrix3d covariance_of_neighbors() const { return covariance(count); }

  private:
    [[nodiscard]] Eigen::Matrix3d covariance(std::size_t n) const {
        const double w = 1.0 / static_cast<double>(n);
        Eigen::Matrix3d c;
        for (int j = 0; j < 3; ++j) {
            for (int i = j; i < 3; ++i) {
                c(i, j) = c(j, i) = w * outer(i, j) - (w * sum[i]) * (w * sum[j]);
            }
        }
        return c;
    }
};

}  // namespace gnomon
