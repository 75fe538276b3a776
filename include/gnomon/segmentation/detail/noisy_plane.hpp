// SPDX-License-Identifier: BSL-1.0
/// @file
/// The plane of a flat segment, and how far noise throws points off it. Noise lies along the rays:
/// the more these are slanted, the less of it is across the surface, and the better points tell
/// which plane they are of.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/core/symmetric_eigen.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/features/principal_frame.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// From where point i was seen [m]; not finite where that is not known.
[[nodiscard]] inline Eigen::Vector3d known_viewpoint(const viewpoint_table& viewpoints,
                                                     std::size_t i) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    return viewpoints.empty() ? Eigen::Vector3d(unknown, unknown, unknown) : viewpoints[i];
}

/// The plane of the points of a segment. What it is the plane of is wide enough for the direction
/// of least spread to be its normal; of what is slim, plane_sample tells more.
class noisy_plane {
  public:
    /// So many standard deviations a point of the plane is off it at most.
    static constexpr double at_most = 3.0;

    /// That of what is not flat.
    noisy_plane() = default;

    /// Flat are points that are no thicker than twice `sigma`, the standard deviation of ranges
    /// [m], but wider. What adjoins may be among them: the farther off they are, the less they
    /// count, and nothing beyond `at_most` (the biweight of Beaton and Tukey 1974). Points that are
    /// not finite do not count. O(n).
    /// @param points  a subset_view
    noisy_plane(const auto& points, double sigma) : sigma_(sigma) {
        const principal_frame frame = principal_frame_of(points);
        is_flat_ = frame.spectrum.lambda[1] >= sigma * sigma &&
                   frame.spectrum.lambda[2] <= 4.0 * sigma * sigma;
        take(frame.normal(), frame.centroid);
        constexpr int passes = 5;
        for (int pass = 0; is_flat_ && pass < passes; ++pass) {
            weighted_moments m;
            for (std::size_t i = 0; i < points.size(); ++i) {
                const Eigen::Vector3d p = points[i];
                const double deviation = deviation_at(p, known_viewpoint(points.viewpoints, i));
                const double off = distance(p) / (at_most * deviation);
                if (!(std::abs(off) < 1.0)) continue;
                const double root_of_weight = (1.0 - off * off) * (sigma / deviation);
                m.add(difference(p, frame.centroid), root_of_weight * root_of_weight);
            }
            is_flat_ = m.weight > 0.0;
            if (is_flat_)
                take(column(symmetric_eigen(m.covariance()).vectors, 2),
                     combined(1.0, frame.centroid, 1.0, m.mean()));
        }
    }

    [[nodiscard]] bool is_flat() const { return is_flat_; }

    /// Of unit length, and either sign.
    [[nodiscard]] const Eigen::Vector3d& normal() const { return plane_.normal; }

    /// Of p from the plane, with a sign [m].
    [[nodiscard]] double distance(const Eigen::Vector3d& p) const {
        return plane_.signed_distance(p);
    }

    /// p, moved into the plane.
    [[nodiscard]] Eigen::Vector3d foot_of(const Eigen::Vector3d& p) const {
        return combined(1.0, p, -distance(p), plane_.normal);
    }

    /// The standard deviation [m] that noise gives a point at p across the plane: that of ranges
    /// where it is not known from where it was seen. Never less than a third of it, as no surface
    /// is quite a plane.
    [[nodiscard]] double deviation_at(const Eigen::Vector3d& p,
                                      const Eigen::Vector3d& viewpoint) const {
        const Eigen::Vector3d ray = difference(p, viewpoint);
        const double cosine = std::abs(dot(plane_.normal, ray)) / length(ray);
        return std::isfinite(cosine) ? sigma_ * std::max(cosine, 1.0 / 3.0) : sigma_;
    }

  private:
    void take(const Eigen::Vector3d& normal, const Eigen::Vector3d& through) {
        plane_ = {normal, dot(normal, through)};
    }

    plane plane_;
    double sigma_ = 0.0;
    bool is_flat_ = false;
};

/// The planes of all segments, in their order. O(n).
template <class R, execution X, class Proj>
[[nodiscard]] std::vector<noisy_plane> planes_of_segments(const R& points, const segments& parts,
                                                          double sigma, const X& run,
                                                          const Proj& projection) {
    std::vector<noisy_plane> planes(parts.size());
    run(parts.size(), [&](std::size_t s) {
        planes[s] = noisy_plane(subset_view<R, Proj>(points, parts[s], projection), sigma);
    });
    return planes;
}

}  // namespace gnomon::detail
