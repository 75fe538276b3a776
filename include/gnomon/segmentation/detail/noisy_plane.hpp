// SPDX-License-Identifier: BSL-1.0
/// @file
/// The plane of a flat segment, and how far noise displaces points from it. Noise acts along the
/// rays: the more oblique these are, the smaller is its component across the surface.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/symmetric_eigen.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/detail/weighted_moments.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/features/principal_frame.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// From where point i was seen [m]; not finite where that is not known.
[[nodiscard]] inline Eigen::Vector3d known_viewpoint(const viewpoint_table& viewpoints,
                                                     std::size_t i) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    return viewpoints.empty() ? Eigen::Vector3d(unknown, unknown, unknown) : viewpoints[i];
}

/// A point of a segment, and the ray to it.
struct observed_point {
    Eigen::Vector3d position;  ///< [m]
    Eigen::Vector3d ray;       ///< from its view point [m]; not finite where that is not known
    double range;              ///< the length of the ray [m]

    // Uninitialized, as Eigen's vectors are: arrays of these are written once.
    observed_point() {}  // NOLINT(modernize-use-equals-default)
    observed_point(const Eigen::Vector3d& p, const Eigen::Vector3d& viewpoint)
        : position(p), ray(difference(p, viewpoint)), range(length(ray)) {}
};

/// The plane of the points of a segment that is wide enough for the direction of least variance to
/// be its normal; plane_sample is for narrow ones.
class noisy_plane {
  public:
    /// A point of the plane is at most this number of standard deviations from it.
    static constexpr double at_most = 3.0;

    /// That of a segment that is not flat.
    noisy_plane() = default;

    /// A segment is flat if it is no thicker than twice `sigma`, the standard deviation of ranges
    /// [m], but wider. It may contain points of adjacent surfaces: the weight of a point decreases
    /// with its distance, and is zero beyond `at_most` (the biweight of Beaton and Tukey 1974).
    /// Points that are not finite are ignored. O(n).
    noisy_plane(std::span<const observed_point> points, double sigma) : sigma_(sigma) {
        const principal_frame frame = principal_axes_of(moments_about_first(positions{points}));
        is_flat_ = frame.spectrum.lambda[1] >= sigma * sigma &&
                   frame.spectrum.lambda[2] <= 4.0 * sigma * sigma;
        take(frame.normal(), frame.centroid);
        constexpr int passes = 5;
        for (int pass = 0; is_flat_ && pass < passes; ++pass) {
            weighted_moments m;
            for (const observed_point& p : points) {
                const double deviation = deviation_at(p.ray, p.range);
                const double off = distance(p.position) / (at_most * deviation);
                if (!(std::abs(off) < 1.0)) continue;
                const double root_of_weight = (1.0 - off * off) * (sigma / deviation);
                m.add(difference(p.position, frame.centroid), root_of_weight * root_of_weight);
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

    /// The standard deviation [m] that noise gives a point at p across the plane; that of ranges if
    /// the view point is not known. At least a third of that, as no surface is an exact plane.
    [[nodiscard]] double deviation_at(const Eigen::Vector3d& p,
                                      const Eigen::Vector3d& viewpoint) const {
        const Eigen::Vector3d ray = difference(p, viewpoint);
        return deviation_at(ray, length(ray));
    }

  private:
    /// The positions of points.
    struct positions {
        std::span<const observed_point> points;

        [[nodiscard]] std::size_t size() const { return points.size(); }
        [[nodiscard]] const Eigen::Vector3d& operator[](std::size_t i) const {
            return points[i].position;
        }
    };

    [[nodiscard]] double deviation_at(const Eigen::Vector3d& ray, double range) const {
        const double cosine = std::abs(dot(plane_.normal, ray)) / range;
        return std::isfinite(cosine) ? sigma_ * std::max(cosine, 1.0 / 3.0) : sigma_;
    }

    void take(const Eigen::Vector3d& normal, const Eigen::Vector3d& through) {
        plane_ = {normal, dot(normal, through)};
    }

    plane plane_;
    double sigma_ = 0.0;
    bool is_flat_ = false;
};

/// The plane of some points of an index. O(n).
/// @param observed  memory for one observed_point each
[[nodiscard]] inline noisy_plane noisy_plane_of(const spatial_index& points,
                                                std::span<const point_index> members, double sigma,
                                                std::span<observed_point> observed) {
    std::transform(members.begin(), members.end(), observed.begin(), [&](point_index i) {
        return observed_point(points[i], known_viewpoint(points.viewpoints, i));
    });
    return noisy_plane(observed, sigma);
}

/// The planes of all segments, in their order. O(n).
template <execution X>
[[nodiscard]] scratch<noisy_plane> planes_of_segments(const spatial_index& points,
                                                      const segments& parts, double sigma,
                                                      const X& run) {
    scratch<noisy_plane> planes(parts.size());
    // One array for all threads: the memory in use does not depend on which segments are fitted at
    // the same time.
    scratch<observed_point> observed(points.size());
    scratch<std::size_t> begin(parts.size(), 0);
    for (std::size_t s = 1; s < parts.size(); ++s) begin[s] = begin[s - 1] + parts[s - 1].size();
    run(parts.size(), [&](std::size_t s) {
        const auto own = std::span(observed).subspan(begin[s], parts[s].size());
        planes[s] = noisy_plane_of(points, parts[s], sigma, own);
    });
    return planes;
}

}  // namespace gnomon::detail
