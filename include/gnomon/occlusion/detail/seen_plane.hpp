// SPDX-License-Identifier: BSL-1.0
/// @file
/// The plane of a segment, as ranges tell of it, and whether two segments have the same. Noise lies
/// along the rays, not across the surface: so planes are found by regression of the depth along a
/// ray on the place across it, and compared as two regressions are (Chow 1960). Of what is narrower
/// than noise, or seen at a grazing angle, the direction of least spread is that of nothing; the
/// regression still knows how little it knows.
///
/// The rays to one segment count as parallel: those of a segment too wide for that tell so much
/// that it does not matter.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/symmetric_eigen.hpp>
#include <gnomon/core/viewpoints.hpp>

namespace gnomon::detail {

/// A direction of sight and two axes across it, all of unit length.
struct sight_axes {
    Eigen::Vector3d along, x, y;

    /// Towards d, of any length but zero.
    explicit sight_axes(const Eigen::Vector3d& d)
        : along(direction_of(d)), x(orthogonal(along)), y(cross(along, x)) {}
};

/// Two coordinates across a sight.
using place_across = std::array<double, 2>;

/// A symmetric matrix over them.
struct matrix_across {
    double xx, xy, yy;

    [[nodiscard]] double determinant() const { return xx * yy - xy * xy; }
    /// The inverse, times v.
    [[nodiscard]] place_across solved(const place_across& v) const {
        return {(yy * v[0] - xy * v[1]) / determinant(), (xx * v[1] - xy * v[0]) / determinant()};
    }
    [[nodiscard]] place_across operator*(const place_across& v) const {
        return {xx * v[0] + xy * v[1], xy * v[0] + yy * v[1]};
    }
    [[nodiscard]] double largest_eigenvalue() const {
        return 0.5 * (xx + yy) + std::hypot(0.5 * (xx - yy), xy);
    }
    [[nodiscard]] matrix_across inverse() const {
        return {yy / determinant(), -xy / determinant(), xx / determinant()};
    }
    friend matrix_across operator+(const matrix_across& a, const matrix_across& b) {
        return {a.xx + b.xx, a.xy + b.xy, a.yy + b.yy};
    }
    friend matrix_across operator*(double s, const matrix_across& a) {
        return {s * a.xx, s * a.xy, s * a.yy};
    }
};

[[nodiscard]] inline double dot(const place_across& a, const place_across& b) {
    return a[0] * b[0] + a[1] * b[1];
}

/// Points of one plane.
struct plane_sample {
    std::size_t count = 0;
    Eigen::Vector3d mean{0.0, 0.0, 0.0};                   ///< [m]
    Eigen::Matrix3d covariance = diagonal(0.0, 0.0, 0.0);  ///< [m^2]
    Eigen::Vector3d viewpoint{0.0, 0.0, 0.0};              ///< the mean of theirs [m]
};

/// The sight of a sample; of one about its own view point, that across its plane.
[[nodiscard]] inline sight_axes axes_towards(const plane_sample& sample) {
    const Eigen::Vector3d d = difference(sample.mean, sample.viewpoint);
    const double size = length(d);
    return sight_axes(size > 0.0 && std::isfinite(size)
                          ? d
                          : column(symmetric_eigen(sample.covariance).vectors, 2));
}

/// depth = slope . place + constant, through the mean of a sample.
struct depth_regression {
    place_across slope;
    matrix_across spread;  ///< covariance of the places [m^2]

    depth_regression(const plane_sample& sample, const sight_axes& axes) {
        const Eigen::Vector3d x = product(sample.covariance, axes.x);
        const Eigen::Vector3d y = product(sample.covariance, axes.y);
        // No place is known better than this: that of a single ray, or row of rays, neither.
        constexpr double exact = 1e-9;  // [m^2]
        spread = {dot(axes.x, x) + exact, dot(axes.x, y), dot(axes.y, y) + exact};
        slope = spread.solved({dot(axes.along, x), dot(axes.along, y)});
    }

    /// Times a way from the mean, how much deeper than the plane that ends. Not of unit length.
    [[nodiscard]] Eigen::Vector3d normal(const sight_axes& axes) const {
        return combined(1.0, axes.along, -slope[0], axes.x, -slope[1], axes.y);
    }
};

/// What a segment tells of its plane by itself.
struct plane_knowledge {
    double squared_width;    ///< variance of the places across the sight, the way it is wider [m^2]
    angle direction;         ///< three standard deviations of that of the plane
    Eigen::Vector3d normal;  ///< towards the view point, not of unit length
};

[[nodiscard]] inline plane_knowledge knowledge_of(const plane_sample& sample, double sigma) {
    const sight_axes axes = axes_towards(sample);
    const depth_regression plane(sample, axes);
    const auto n = static_cast<double>(sample.count);
    const double slope = sigma * std::sqrt(plane.spread.inverse().largest_eigenvalue() / n);
    return {plane.spread.largest_eigenvalue(), radians(std::atan(3.0 * slope)),
            scaled(-1.0, plane.normal(axes))};
}

/// How far off a plane a point of it may be, in standard deviations of a range.
inline constexpr double off_plane = 2.5;

/// Those of some points that are on the plane of a sample of them, as far as noise lets them.
/// @param points   a position_view of the cloud
/// @param members  indices of points of it
/// Complexity: O(n).
[[nodiscard]] std::vector<point_index> points_on_plane(const auto& points,
                                                       std::span<const point_index> members,
                                                       const plane_sample& sample, double sigma) {
    const sight_axes axes = axes_towards(sample);
    const Eigen::Vector3d off = depth_regression(sample, axes).normal(axes);
    std::vector<point_index> on;
    for (const point_index i : members)
        if (std::abs(dot(off, difference(points[i], sample.mean))) <= off_plane * sigma)
            on.push_back(i);
    return on;
}

/// The points of a segment that are of its plane. What adjoins it may have lent it some of its own
/// at the edges: what is off the plane is left out, again and again, unless that is most of what
/// was left. Of none if no point is finite.
/// @param points   a position_view of the cloud
/// @param members  indices of the points of the segment
/// Complexity: O(n).
[[nodiscard]] plane_sample plane_sample_of(const auto& points, std::span<const point_index> members,
                                           const viewpoint_table& viewpoints, double sigma) {
    plane_sample sample;
    moments seen_from;
    for (const point_index i : members)
        if (is_finite(viewpoints[i])) seen_from.add(viewpoints[i]);
    if (seen_from.count > 0)
        sample.viewpoint = scaled(1.0 / static_cast<double>(seen_from.count), seen_from.sum);
    const auto first = std::find_if(members.begin(), members.end(),
                                    [&](point_index i) { return is_finite(points[i]); });
    if (first == members.end()) return sample;
    const Eigen::Vector3d origin = points[*first];
    const auto take = [&](auto&& belongs) {
        moments m;
        for (const point_index i : members) {
            const Eigen::Vector3d d = difference(points[i], origin);
            if (all_finite(d) && belongs(d)) m.add(d);
        }
        if (2 * m.count < sample.count) return;
        sample.count = m.count;
        sample.mean = combined(1.0, origin, 1.0 / static_cast<double>(m.count), m.sum);
        sample.covariance = m.covariance_of_neighbors();
    };
    take([](const Eigen::Vector3d&) { return true; });
    for (int pass = 0; pass < 4; ++pass) {
        const sight_axes axes = axes_towards(sample);
        const Eigen::Vector3d off = depth_regression(sample, axes).normal(axes);
        const Eigen::Vector3d middle = difference(sample.mean, origin);
        take([&](const Eigen::Vector3d& d) {
            return std::abs(dot(off, difference(d, middle))) <= off_plane * sigma;
        });
    }
    return sample;
}

/// Two samples, and what noise lets them tell of whether they are of one plane.
class plane_comparison {
  public:
    /// With a sample of no points nothing is of one plane, nor of two.
    /// @param wide  that of the wider segment
    plane_comparison(const plane_sample& wide, const plane_sample& slim, double sigma)
        : sigma_(sigma), both_have_points_(wide.count > 0 && slim.count > 0) {
        const sight_axes axes = axes_towards(slim);  // which depends more on how the rays go
        const depth_regression a(wide, axes), b(slim, axes);
        constexpr double square_of_two = 11.8;  // 99.7 % of chi-squared, of two numbers
        const place_across turn{a.slope[0] - b.slope[0], a.slope[1] - b.slope[1]};
        const matrix_across spread = spread_of_slope(wide, a) + spread_of_slope(slim, b);
        parallel_ = dot(turn, spread.solved(turn)) <= square_of_two;
        const Eigen::Vector3d normal = a.normal(axes), other = b.normal(axes);
        turned_ = std::atan2(length(cross(normal, other)), dot(normal, other));
        turned_by_noise_ = std::atan(deviations * std::sqrt(spread.largest_eigenvalue()));

        // The slope of parallel planes is that of both, as each knows it; else the wide one knows
        // more.
        const matrix_across known_a = known(wide, a), known_b = known(slim, b);
        const matrix_across sum = parallel_ ? known_a + known_b : known_a;
        const place_across in_a = known_a * a.slope, in_b = known_b * b.slope;
        const place_across slope =
            parallel_ ? sum.solved({in_a[0] + in_b[0], in_a[1] + in_b[1]}) : a.slope;
        const Eigen::Vector3d between = difference(slim.mean, wide.mean);
        const place_across way{dot(axes.x, between), dot(axes.y, between)};
        const double cosine = 1.0 / std::sqrt(1.0 + dot(slope, slope));  // of depths, distances
        offset_ = cosine * std::abs(dot(axes.along, between) - dot(slope, way));
        const double variance = sigma * sigma;
        offset_deviation_ = cosine * std::sqrt(variance / static_cast<double>(wide.count) +
                                               variance / static_cast<double>(slim.count) +
                                               dot(way, sum.solved(way)));
        // What is hardly wider than noise became a segment by chance, and its points are no fair
        // sample of the noise.
        constexpr double chosen = 1.0;  // in standard deviations
        tolerated_offset_ = no_noise * sigma;
        if (b.spread.largest_eigenvalue() < 9.0 * variance)
            tolerated_offset_ = std::max(cosine * chosen * sigma, tolerated_offset_);
    }

    /// How far the slim one is off the plane of both, or of the wide one [m].
    [[nodiscard]] double offset() const { return offset_; }

    /// Their angle and their offset may each be what noise makes of none in 997 of 1,000 cases, and
    /// of what is no noise, such as round edges, a tenth of a standard deviation more; an angle
    /// that is well known may be up to max_angle. Nothing is told if noise would hide an offset of
    /// max_offset more often than one time in six.
    [[nodiscard]] bool is_of_one(angle max_angle, double max_offset) const {
        constexpr double not_hidden = deviations + 1.0;  // of which 84 % are found
        return both_have_points_ &&
               (parallel_ ||
                (turned_ <= max_angle.radians() && turned_by_noise_ <= max_angle.radians())) &&
               offset_ < max_offset &&
               not_hidden * offset_deviation_ + no_noise * sigma_ < max_offset &&
               offset_ <= deviations * offset_deviation_ + tolerated_offset_;
    }

    /// Whether their angle is greater than max_angle, or their offset than max_offset, by more than
    /// three standard deviations. Of what is neither of one plane nor of two, nothing is known.
    [[nodiscard]] bool is_of_two(angle max_angle, double max_offset) const {
        return both_have_points_ &&
               ((!parallel_ && turned_ - turned_by_noise_ > max_angle.radians()) ||
                offset_ - deviations * offset_deviation_ - tolerated_offset_ > max_offset);
    }

  private:
    static constexpr double deviations = 3.0;  // 99.7 % of a normal distribution
    static constexpr double no_noise = 0.1;    // in standard deviations

    /// How well a slope is known: the inverse of its covariance.
    [[nodiscard]] matrix_across known(const plane_sample& sample, const depth_regression& r) const {
        return (static_cast<double>(sample.count) / (sigma_ * sigma_)) * r.spread;
    }

    /// The covariance of a slope.
    [[nodiscard]] matrix_across spread_of_slope(const plane_sample& sample,
                                                const depth_regression& r) const {
        const double more = no_noise * no_noise * static_cast<double>(sample.count);
        return (1.0 + more) * known(sample, r).inverse();
    }

    double sigma_;
    bool both_have_points_, parallel_;
    double turned_, turned_by_noise_;                      // [rad]
    double offset_, offset_deviation_, tolerated_offset_;  // [m]
};

}  // namespace gnomon::detail
