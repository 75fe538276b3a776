// SPDX-License-Identifier: BSL-1.0
/// @file
/// VectorSVD: the normal minimizes the sum of squared scalar products with the vectors from the
/// point to its neighbors. The plane passes through the point, whose noise has its full effect.
///
/// Klasing 2010, Eq. (3.6).
#pragma once

#include <Eigen/Core>

#include <gnomon/core/moments.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/plane_fit.hpp>

namespace gnomon {

/// Models `moment_estimator`. Needs two neighbors. O(k). Trust as for `plane_pca`. The spectrum is
/// that of the second moments about the point instead of the centroid.
struct vector_svd {
    double min_aspect_ratio = 0.1;  ///< sigma_ar below which the normal is weak

    [[nodiscard]] plane_fit operator()(const Eigen::Vector3d& p,
                                       neighborhood_view neighbors) const {
        return (*this)(moments::about(p, neighbors));
    }

    /// The fit from the moments of the neighbors about the point.
    [[nodiscard]] plane_fit operator()(const moments& m) const {
        if (m.count < 2) return {};
        return detail::plane_of_least_spread(m.second_moments(), min_aspect_ratio);
    }
};

}  // namespace gnomon
