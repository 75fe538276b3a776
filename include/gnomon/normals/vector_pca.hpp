// SPDX-License-Identifier: BSL-1.0
/// @file
/// VectorPCA: PlanePCA without the point itself, so that its own noise does not matter.
///
/// Klasing 2010, Sec. 3.2.3, where it is found almost identical to PlanePCA.
#pragma once

#include <Eigen/Core>

#include <gnomon/core/moments.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/plane_fit.hpp>

namespace gnomon {

/// Models `moment_estimator`. Needs three neighbors. O(k). Trust as for `plane_pca`.
struct vector_pca {
    double min_aspect_ratio = 0.1;  ///< sigma_ar below which the normal is weak

    [[nodiscard]] plane_fit operator()(const Eigen::Vector3d& p, ring_view ring) const {
        return (*this)(moments_about(p, ring));
    }

    /// The fit from the moments of the neighbors about the point.
    [[nodiscard]] plane_fit operator()(const moments& m) const {
        if (m.count < 3) return {};
        return detail::plane_of_least_spread(m.covariance_of_neighbors(), min_aspect_ratio);
    }
};

}  // namespace gnomon
