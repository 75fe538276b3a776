// SPDX-License-Identifier: BSL-1.0
/// @file
/// The two steps of `feature_preserving` that look at the neighbors' planes: one takes the plane
/// that fits a point best, its own or a neighbor's; the other takes the mean of the normals around
/// as far as they speak of the same surface.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/symmetric_eigen.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/normals/plane_fit.hpp>

namespace gnomon::detail {

/// The plane that a point has found: {p + x : <normal, x> = offset}.
struct local_plane {
    plane_fit fit;
    double offset = 0.0;         ///< from the point along the normal [m]
    point_index neighbors = 0;   ///< that noise asks for at the point
    double mean_distance = 0.0;  ///< to them [m]

    /// How far the position x [m] from the point is off the plane.
    [[nodiscard]] double residual(const Eigen::Vector3d& x) const {
        return dot(fit.normal, x) - offset;
    }
};

/// What a point sees: its neighbors, nearest first and itself in front, all from where it stands.
struct surroundings {
    std::vector<point_index> index;
    std::vector<Eigen::Vector3d> way;  ///< from the point to it [m]

    [[nodiscard]] std::size_t size() const { return index.size(); }
    [[nodiscard]] double radius() const { return length(way.back()); }

    /// The plane of member a of this ring, seen from the point.
    [[nodiscard]] local_plane borrowed(std::size_t a,
                                       const std::vector<local_plane>& planes) const {
        local_plane plane = planes[index[a]];
        plane.offset += dot(plane.fit.normal, way[a]);
        return plane;
    }
};

/// exp(-x), or nothing where that hardly counts.
[[nodiscard]] inline double decay(double x) { return x < 12.0 ? std::exp(-x) : 0.0; }

/// exp(-d^2 / 2) of a distance d in deviations.
[[nodiscard]] inline double gaussian(double d) { return decay(0.5 * d * d); }

/// Of all the planes around, the one on which the point and most of its neighbors lie. Beside an
/// edge it is that of a neighbor whose own neighbors are all on this side: a shifted neighborhood
/// (Cao et al. 2018). Precondition: the point's own plane is usable.
/// @param deviation  of points that lie on a plane [m]
[[nodiscard]] inline local_plane best_plane(const surroundings& ring,
                                            const std::vector<local_plane>& planes,
                                            double deviation) {
    constexpr std::size_t lenders = 24, judges = 32;  // at least, of a large ring
    const std::size_t each_lender = std::max<std::size_t>(1, (ring.size() - 1) / lenders);
    const std::size_t each_judge = std::max<std::size_t>(1, (ring.size() - 1) / judges);
    const auto most = static_cast<double>((ring.size() - 1) / each_judge + 1);
    local_plane best = planes[ring.index[0]];
    double best_score = -1.0;
    for (std::size_t a = 0; a < ring.size(); a += each_lender) {
        if (!usable(planes[ring.index[a]].fit.trust)) continue;
        const local_plane plane = ring.borrowed(a, planes);
        const double own = gaussian(plane.offset / deviation);
        if (own * most <= best_score) continue;
        double all = 0.0;
        for (std::size_t l = 0; l < ring.size(); l += each_judge)
            all += gaussian(plane.residual(ring.way[l]) / deviation);
        if (own * all > best_score) {
            best_score = own * all;
            best = plane;
        }
    }
    return best;
}

/// The plane fitted again to the members of the ring that lie on it, several times (iteratively
/// reweighted least squares).
/// @param deviation  at which a point has lost 40 % of its weight [m]
[[nodiscard]] inline local_plane refitted(const surroundings& ring, local_plane plane,
                                          double deviation, double min_aspect_ratio) {
    constexpr int rounds = 4;
    for (int i = 0; i < rounds; ++i) {
        weighted_moments m;
        for (const Eigen::Vector3d& x : ring.way) m.add(x, gaussian(plane.residual(x) / deviation));
        if (!(m.weight > 0.0)) break;
        const plane_fit fit = plane_of_least_spread(m.covariance(), min_aspect_ratio);
        if (!usable(fit.trust)) break;
        plane.fit = fit;
        plane.offset = dot(fit.normal, m.mean());
    }
    return plane;
}

/// The mean of the normals of a ring, as axes without sign, weighted by nearness, by agreement in
/// direction and by how near the points are to each other's planes: a bilateral filter that stops
/// at edges and between close walls. Precondition: the point's own plane is usable.
/// @param deviation  of points that lie on each other's planes [m]
[[nodiscard]] inline Eigen::Vector3d filtered_normal(const surroundings& ring,
                                                     const std::vector<local_plane>& planes,
                                                     double deviation) {
    constexpr double agreement = 0.8;  // deviation of the sine between normals of one surface
    constexpr double nearness = 0.5;   // deviation of distances, in radii of the ring
    const local_plane& own = planes[ring.index[0]];
    const double radius = ring.radius();
    weighted_moments axes;
    for (std::size_t l = 0; l < ring.size(); ++l) {
        const local_plane& other = planes[ring.index[l]];
        if (!usable(other.fit.trust)) continue;
        const double cosine = dot(own.fit.normal, other.fit.normal);
        const double here = own.residual(ring.way[l]) / deviation;
        const double there = ring.borrowed(l, planes).offset / deviation;
        const double far = length(ring.way[l]) / (nearness * radius);
        const double unlike = (1.0 - cosine * cosine) / (agreement * agreement) +
                              0.5 * (here * here + there * there) + far * far;
        axes.add(other.fit.normal, decay(0.5 * unlike));
    }
    if (!(axes.weight > 0.0)) return own.fit.normal;  // of an outlier, with which nobody agrees
    return column(symmetric_eigen(axes.second_moments()).vectors, 0);
}

}  // namespace gnomon::detail
