// SPDX-License-Identifier: BSL-1.0
/// @file
/// VectorPCA: PlanePCA of the neighbors without the point itself, so that the noise of the point
/// has no effect.
///
/// Klasing 2010, Sec. 3.2.3, where its results are almost identical to those of PlanePCA.
#pragma once

#include <Eigen/Core>

#include <gnomon/core/moments.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/plane_fit.hpp>

namespace gnomon {

/// Models `moment_estimator`. Needs three neighbors. O(k). Trust as for `plane_pca`.
struct vector_pca {
    double min_aspect_ratio = 0.1;  ///< sigma_ar below which the normal is weak

    [[nodiscard]] plane_fit operator()(const Eigen::Vector3d& p,
                                       neighborhood_view neighbors) const {
        return (*this)(moments::about(p, neighbors));
    }

    /// The fit from the moments of the neighbors about the point.
    [[nodiscard]] plane_fit operator()(const moments& m) const {
        if (m.count < 3) return {};
        return detail::plane_of_least_spread(m.covariance_of_neighbors(), min_aspect_ratio);
    }
};

}  // namespace gnomon
