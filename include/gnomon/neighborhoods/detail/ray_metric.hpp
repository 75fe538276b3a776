// SPDX-License-Identifier: BSL-1.0
/// @file
/// Distances that do not count the noise along a ray: of a position from the segment of a ray
/// about a point, 4 standard deviations of the range to either side. Where noise is stronger than
/// the spacing of points, the points nearest to a point in space are those whose noise is alike;
/// those nearest to the segment are chosen by direction alone.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/neighborhoods/detail/leaf_box.hpp>

namespace gnomon::detail {

/// Half the length of the segment in standard deviations of the noise (a number; of a normal
/// distribution, 1 in 16,000 points is farther off).
inline constexpr double ray_deviations = 4.0;

/// The distance from a segment about the searched position.
class ray_metric {
  public:
    /// Of a segment of no length.
    ray_metric() = default;
    /// @param direction    of the ray, of length 1
    /// @param half_length  of the segment [m]
    ray_metric(const Eigen::Vector3d& direction, double half_length)
        : u_(direction), half_length_(half_length) {}

    [[nodiscard]] const Eigen::Vector3d& direction() const { return u_; }
    /// [m]
    [[nodiscard]] double half_length() const { return half_length_; }

    /// The squared distance of a position at this offset from the middle of the segment [m^2].
    [[nodiscard]] double squared(double x, double y, double z) const {
        const double along = x * u_[0] + y * u_[1] + z * u_[2];
        const double beyond = std::max(0.0, std::abs(along) - half_length_);
        const double across = std::max(0.0, x * x + y * y + z * z - along * along);
        return across + beyond * beyond;
    }

    /// A lower bound of squared() of the positions in a box, relative to the middle `at`: the
    /// distance between the boxes around both, and between the segment and the ball around the box.
    [[nodiscard]] double lower_bound(const std::array<double, 3>& at, const leaf_box& box) const {
        double gaps = 0.0, diagonal = 0.0;
        std::array<double, 3> center;
        for (std::size_t a = 0; a < 3; ++a) {
            const double low = box.low[a] - at[a], high = box.high[a] - at[a];
            const double reach = half_length_ * std::abs(u_[static_cast<int>(a)]);
            const double gap = std::max({low - reach, -reach - high, 0.0});
            gaps += gap * gap;
            diagonal += (high - low) * (high - low);
            center[a] = 0.5 * (low + high);
        }
        const double to_center = std::sqrt(squared(center[0], center[1], center[2]));
        const double to_ball = std::max(0.0, to_center - 0.5 * std::sqrt(diagonal));
        return std::max(gaps, to_ball * to_ball);
    }

  private:
    Eigen::Vector3d u_{0.0, 0.0, 0.0};
    double half_length_ = 0.0;
};

/// The metric about the finite point i of an index: that from the point itself where its view point
/// is unknown, or at the point. (A template for compile time only.)
template <class Index>
[[nodiscard]] ray_metric ray_metric_of(const Index& index, std::size_t i,
                                       const noise_curve& noise) {
    if (index.viewpoints.empty()) return {};
    const Eigen::Vector3d ray = difference(index[i], index.viewpoints[i]);
    const double range = length(ray);
    if (!(range > 0.0 && std::isfinite(range))) return {};
    // A segment longer than the cloud measures as one of that length does.
    const double most = std::sqrt(index.tree().box().squared_diagonal());
    return {scaled(1.0 / range, ray), std::min(ray_deviations * noise.along(ray), most)};
}

}  // namespace gnomon::detail
