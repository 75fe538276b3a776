// SPDX-License-Identifier: BSL-1.0
/// @file
/// The noise of a sensor: the standard deviation of a measured range as a function of the range,
/// or, of a depth camera, of a measured depth as a function of the depth. Noise is along the ray.
#pragma once

#include <concepts>

namespace gnomon {

/// noise(x) is the standard deviation [m] at the range, or depth, x [m].
template <class N>
concept range_noise = requires(const N& noise, double x) {
    { noise(x) } -> std::convertible_to<double>;
};

/// The same noise at every range.
struct constant_noise {
    double sigma = 0.015;  ///< standard deviation [m]; the default is the thesis's range finder

    [[nodiscard]] constexpr double operator()(double) const { return sigma; }
};

/// The standard deviation a + b x + c x^2 at the range x.
struct quadratic_noise {
    double a = 0.0;  ///< [m]
    double b = 0.0;  ///< coefficient of the linear term
    double c = 0.0;  ///< [1/m]

    [[nodiscard]] constexpr double operator()(double x) const { return a + x * (b + x * c); }
};

/// Published models of depth cameras, as functions of the depth. With the optical axis of the
/// camera they are a `noise_curve`.
namespace noises {

/// Structured light, the first Kinect: 1.2 mm + 1.9e-3/m (z - 0.4 m)^2.
/// Nguyen, Izadi and Lovell 2012, Eq. (2), for surfaces that face the camera.
[[nodiscard]] constexpr quadratic_noise structured_light() {
    return {0.0012 + 0.0019 * 0.4 * 0.4, -2.0 * 0.0019 * 0.4, 0.0019};
}

/// Time of flight, the second Kinect: 1.5 mm - 0.5e-3 z + 0.3e-3/m z^2.
/// Fankhauser et al. 2015, Eq. (6), for surfaces that face the camera.
[[nodiscard]] constexpr quadratic_noise time_of_flight() { return {0.0015, -0.0005, 0.0003}; }

/// Stereo: z^2 s / (f b), for disparities with the standard deviation s [pixel], the focal length
/// f [pixel] and the baseline b [m]. The default is an Intel RealSense D415 at 1280 x 720: 0.08
/// pixel, 1005 pixel and 55 mm (Grunnet-Jepsen, Sweetser and Woodfill 2018).
[[nodiscard]] constexpr quadratic_noise stereo(double disparity = 0.08,
                                               double focal_length = 1005.0,
                                               double baseline = 0.055) {
    return {0.0, 0.0, disparity / (focal_length * baseline)};
}

}  // namespace noises

}  // namespace gnomon
