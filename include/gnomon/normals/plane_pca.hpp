// SPDX-License-Identifier: BSL-1.0
/// @file
/// PlanePCA: the normal of the total least squares plane, the direction in which a point and its
/// neighbors have the least variance. The thesis uses it throughout.
///
/// Klasing, Aspects of 3D Perception, Abstraction, and Interpretation in Autonomous Mobile
/// Robotics, TUM 2010, Eq. (3.2) and Alg. 3.1; Hoppe et al. 1992.
#pragma once

#include <concepts>
#include <cstddef>
#include <span>

#include <Eigen/Core>

#include <gnomon/core/moments.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/plane_fit.hpp>

namespace gnomon {

/// Models `batch_estimator`. Needs two neighbors. O(k).
///
/// Trust: `weak` where the aspect ratio is below `min_aspect_ratio` (a neighborhood from one scan
/// line); `degenerate` where the normal is not determined: all points at one position, on one line,
/// or with equal variances in the two directions of less variance.
struct plane_pca {
    double min_aspect_ratio = 0.1;  ///< sigma_ar below which the normal is weak, Sec. 3.2.9

    [[nodiscard]] plane_fit operator()(const Eigen::Vector3d& p,
                                       neighborhood_view neighbors) const {
        return (*this)(moments::about(p, neighbors));
    }

    /// The fit from the moments of the neighbors about the point.
    [[nodiscard]] plane_fit operator()(const moments& m) const {
        if (m.count < 2) return {};
        return detail::plane_of_least_spread(m.covariance_with_point(),  // Eq. (3.5)
                                             min_aspect_ratio);
    }

    /// The fits of many neighborhoods at once, each from its moments. A template, so that it is
    /// compiled only where it is used.
    template <std::same_as<plane_fit> Fit>
    void operator()(std::span<const moments> m, std::span<Fit> fits) const {
        detail::planes_of_least_spread(
            m.size(), [m](std::size_t i) { return m[i].covariance_with_point(); }, min_aspect_ratio,
            fits);
        for (std::size_t i = 0; i < m.size(); ++i)
            if (m[i].count < 2) fits[i] = {};
    }
};

}  // namespace gnomon
