// SPDX-License-Identifier: BSL-1.0
/// @file
/// Where is a point in the picture? A pinhole camera, framed so that nearly all points are in it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace picture {

/// The p-th fraction of some numbers, 0 <= p <= 1; 0 if there are none.
[[nodiscard]] inline double percentile(std::vector<double>& numbers, double p) {
    if (numbers.empty()) return 0.0;
    const auto nth =
        numbers.begin() + static_cast<std::ptrdiff_t>(p * static_cast<double>(numbers.size() - 1));
    std::nth_element(numbers.begin(), nth, numbers.end());
    return *nth;
}

/// A camera at `position`; pixels count to the right and downwards.
struct camera {
    Eigen::Vector3d position;
    Eigen::Matrix3d axes;  ///< rows: to the right, downwards, forward
    double focal = 1.0;    ///< [pixels]
    double center_x = 0.0;
    double center_y = 0.0;

    /// Right and down [pixels], and the distance along the view [m]; visible if that is positive.
    [[nodiscard]] Eigen::Vector3d project(const Eigen::Vector3d& p) const {
        return pixel_of(axes * (p - position));
    }

    /// As project(), for a point in the frame of the camera.
    [[nodiscard]] Eigen::Vector3d pixel_of(const Eigen::Vector3d& q) const {
        return {center_x + focal * q.x() / q.z(), center_y + focal * q.y() / q.z(), q.z()};
    }
};

/// A unit vector that is perpendicular to `a` and, as far as that goes, like `b`.
[[nodiscard]] inline Eigen::Vector3d across(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    const Eigen::Vector3d c = b - b.dot(a) * a;
    return c.norm() > 0.1 ? Eigen::Vector3d(c.normalized()) : a.unitOrthogonal();
}

/// A camera that looks along the unit vector `forward`, with `up` upwards in the picture; where it
/// looks straight along `up`, what is in front (x, as robots have it) is upwards.
[[nodiscard]] inline camera looking(const Eigen::Vector3d& from, const Eigen::Vector3d& forward,
                                    const Eigen::Vector3d& up) {
    const bool steep = std::abs(forward.dot(up)) > 0.95;
    const Eigen::Vector3d top = across(forward, steep ? across(up, Eigen::Vector3d::UnitX()) : up);
    camera c;
    c.position = from;
    c.axes.row(0) = forward.cross(top);
    c.axes.row(1) = -top;
    c.axes.row(2) = forward;
    return c;
}

/// Nearly all of some numbers: all, but outliers far from the central 98 percent.
[[nodiscard]] inline std::array<double, 2> range_of(std::vector<double>& numbers) {
    const double low = percentile(numbers, 0.01);
    const double high = percentile(numbers, 0.99);
    const double slack = 0.15 * (high - low);
    return {std::max(low - slack, percentile(numbers, 0.0)),
            std::min(high + slack, percentile(numbers, 1.0))};
}

/// Zooms so that nearly all of these points fill `width` x `height` pixels, but for a margin.
inline void frame(camera& c, const std::vector<Eigen::Vector3d>& points, int width, int height) {
    std::vector<double> x;
    std::vector<double> y;
    c.focal = 1.0;
    c.center_x = c.center_y = 0.0;
    for (const Eigen::Vector3d& p : points) {
        const Eigen::Vector3d q = c.project(p);
        if (q.z() > 0.0 && std::isfinite(q.x()) && std::isfinite(q.y())) {
            x.push_back(q.x());
            y.push_back(q.y());
        }
    }
    const auto [left, right] = range_of(x);
    const auto [top, bottom] = range_of(y);
    constexpr double share = 0.94;
    c.focal = share *
              std::min(width / std::max(right - left, 1e-6), height / std::max(bottom - top, 1e-6));
    c.center_x = 0.5 * width - 0.5 * c.focal * (left + right);
    c.center_y = 0.5 * height - 0.5 * c.focal * (top + bottom);
}

}  // namespace picture
