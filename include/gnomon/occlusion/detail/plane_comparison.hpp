// SPDX-License-Identifier: BSL-1.0
/// @file
/// The test whether two segments are coplanar, certainly not coplanar, or neither can be decided
/// under the noise: a Chow test of two regressions (Chow 1960).
#pragma once

#include <algorithm>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/occlusion/detail/seen_plane.hpp>

namespace gnomon::detail {

/// Two samples and the result of the test.
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

        // The common slope of parallel planes is the mean weighted by information; otherwise the
        // slope of the wider segment is used.
        const matrix_across known_a = a.information(wide.count, sigma),
                            known_b = b.information(slim.count, sigma);
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

    /// The distance of the narrower segment from the common plane, or from that of the wider
    /// segment [m].
    [[nodiscard]] double offset() const { return offset_; }

    /// Whether the segments are coplanar. Their angle must be below its 99.7 % quantile under the
    /// null hypothesis, plus a tenth of a standard deviation for rounded edges; an angle that is
    /// known well may be up to max_angle. The offset must be below its 97.6 % quantile, as parallel
    /// planes a centimeter apart are common. False if the noise would hide an offset of max_offset
    /// in more than one of six cases.
    [[nodiscard]] bool is_of_one(angle max_angle, double max_offset) const {
        constexpr double not_hidden = deviations + 1.0;  // of which 84 % are found
        return both_have_points_ &&
               (parallel_ ||
                (turned_ <= max_angle.radians() && turned_by_noise_ <= max_angle.radians())) &&
               offset_ < max_offset &&
               not_hidden * offset_deviation_ + no_noise * sigma_ < max_offset &&
               offset_ <= deviations_of_offset * offset_deviation_ + tolerated_offset_;
    }

    /// Whether their angle is greater than max_angle, or their offset than max_offset, by more than
    /// three standard deviations. Of what is neither of one plane nor of two, nothing is known.
    [[nodiscard]] bool is_of_two(angle max_angle, double max_offset) const {
        return both_have_points_ &&
               ((!parallel_ && turned_ - turned_by_noise_ > max_angle.radians()) ||
                offset_ - deviations * offset_deviation_ - tolerated_offset_ > max_offset);
    }

  private:
    static constexpr double deviations = 3.0;             // 99.7 % of a normal distribution
    static constexpr double deviations_of_offset = 2.25;  // 97.6 %
    static constexpr double no_noise = 0.1;               // in standard deviations

    /// The covariance of a slope, with what is no noise.
    [[nodiscard]] matrix_across spread_of_slope(const plane_sample& sample,
                                                const depth_regression& r) const {
        const double more = no_noise * no_noise * static_cast<double>(sample.count);
        return (1.0 + more) * r.information(sample.count, sigma_).inverse();
    }

    double sigma_;
    bool both_have_points_, parallel_;
    double turned_, turned_by_noise_;                      // [rad]
    double offset_, offset_deviation_, tolerated_offset_;  // [m]
};

}  // namespace gnomon::detail
