// SPDX-License-Identifier: BSL-1.0
/// @file
/// The two steps of `feature_preserving` that use the planes of the neighbors: the selection of the
/// plane that fits a point best, its own or a neighbor's, and the bilateral mean of the normals of
/// the neighbors.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/symmetric_eigen.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/detail/weighted_moments.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/normals/plane_fit.hpp>

namespace gnomon::detail {

/// A plane fitted at a point p: {p + x : <normal, x> = offset}.
struct local_plane {
    plane_fit fit;
    double offset = 0.0;         ///< from the point along the normal [m]
    point_index neighbors = 0;   ///< the number of neighbors, chosen by the noise
    double mean_distance = 0.0;  ///< to them [m]

    /// The signed distance [m] of the position p + x from the plane.
    [[nodiscard]] double residual(const Eigen::Vector3d& x) const {
        return dot(fit.normal, x) - offset;
    }
};

/// The neighborhood of a point: the point itself, then its neighbors, nearest first, with their
/// offsets from the point.
struct surroundings {
    std::vector<point_index> index;
    std::vector<Eigen::Vector3d> way;  ///< from the point to it [m]

    [[nodiscard]] std::size_t size() const { return index.size(); }
    [[nodiscard]] double radius() const { return length(way.back()); }

    /// The plane of member a, with its offset from the point.
    [[nodiscard]] local_plane plane_of(std::size_t a,
                                       const std::vector<local_plane>& planes) const {
        local_plane plane = planes[index[a]];
        plane.offset += dot(plane.fit.normal, way[a]);
        return plane;
    }
};

/// exp(-x), or 0 for x of 12 and more, where it is below 1e-5: performance only.
[[nodiscard]] inline double decay(double x) { return x < 12.0 ? std::exp(-x) : 0.0; }

/// exp(-d^2 / 2) of a distance d in standard deviations.
[[nodiscard]] inline double gaussian(double d) { return decay(0.5 * d * d); }

/// Among the planes of the neighborhood, the one that the point and most of its neighbors lie on.
/// Near an edge it is the plane of a neighbor whose own neighborhood does not cross the edge: a
/// shifted neighborhood (Cao et al. 2018). Precondition: the plane of the point itself is usable.
/// @param deviation  standard deviation of points from their plane [m]
[[nodiscard]] inline local_plane best_plane(const surroundings& neighbors,
                                            const std::vector<local_plane>& planes,
                                            double deviation) {
    constexpr std::size_t candidates = 24,
                          samples = 32;  // of a large neighborhood: performance only
    const std::size_t each_candidate =
        std::max<std::size_t>(1, (neighbors.size() - 1) / candidates);
    const std::size_t each_sample = std::max<std::size_t>(1, (neighbors.size() - 1) / samples);
    const auto most = static_cast<double>((neighbors.size() - 1) / each_sample + 1);
    local_plane best = planes[neighbors.index[0]];
    double best_score = -1.0;
    for (std::size_t a = 0; a < neighbors.size(); a += each_candidate) {
        if (!usable(planes[neighbors.index[a]].fit.trust)) continue;
        const local_plane plane = neighbors.plane_of(a, planes);
        const double own = gaussian(plane.offset / deviation);
        if (own * most <= best_score) continue;
        double all = 0.0;
        for (std::size_t l = 0; l < neighbors.size(); l += each_sample)
            all += gaussian(plane.residual(neighbors.way[l]) / deviation);
        if (own * all > best_score) {
            best_score = own * all;
            best = plane;
        }
    }
    return best;
}

/// The plane refitted to the neighborhood by iteratively reweighted least squares.
/// @param deviation  distance from the plane at which the weight is exp(-1/2) [m]
[[nodiscard]] inline local_plane refitted(const surroundings& neighbors, local_plane plane,
                                          double deviation, double min_aspect_ratio) {
    constexpr int rounds = 4;
    for (int i = 0; i < rounds; ++i) {
        weighted_moments m;
        for (const Eigen::Vector3d& x : neighbors.way)
            m.add(x, gaussian(plane.residual(x) / deviation));
        if (!(m.weight > 0.0)) break;
        const plane_fit fit = plane_of_least_spread(m.covariance(), min_aspect_ratio);
        if (!usable(fit.trust)) break;
        plane.fit = fit;
        plane.offset = dot(fit.normal, m.mean());
    }
    return plane;
}

/// The mean of the normals of a neighborhood, as axes without sign: a bilateral filter. The weights
/// decrease with the distance, with the angle between the normals, and with the distances of the
/// points from each other's planes, so that normals beyond an edge or on a parallel wall have
/// almost no weight. Precondition: the plane of the point itself is usable.
/// @param deviation  standard deviation of points from each other's planes [m]
[[nodiscard]] inline Eigen::Vector3d filtered_normal(const surroundings& neighbors,
                                                     const std::vector<local_plane>& planes,
                                                     double deviation) {
    constexpr double agreement = 0.8;  // standard deviation of the sine of the angle
    constexpr double nearness = 0.5;   // standard deviation of the distance, in radii
    const local_plane& own = planes[neighbors.index[0]];
    const double radius = neighbors.radius();
    weighted_moments axes;
    for (std::size_t l = 0; l < neighbors.size(); ++l) {
        const local_plane& other = planes[neighbors.index[l]];
        if (!usable(other.fit.trust)) continue;
        const double cosine = dot(own.fit.normal, other.fit.normal);
        const double here = own.residual(neighbors.way[l]) / deviation;
        const double there = neighbors.plane_of(l, planes).offset / deviation;
        const double far = length(neighbors.way[l]) / (nearness * radius);
        const double unlike = (1.0 - cosine * cosine) / (agreement * agreement) +
                              0.5 * (here * here + there * there) + far * far;
        axes.add(other.fit.normal, decay(0.5 * unlike));
    }
    if (!(axes.weight > 0.0)) return own.fit.normal;  // an outlier
    return column(symmetric_eigen(axes.second_moments()).vectors, 0);
}

}  // namespace gnomon::detail
