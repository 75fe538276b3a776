// SPDX-License-Identifier: BSL-1.0
/// @file
/// A depth camera: an image of depths, taken at one time through a pinhole. x is the optical axis,
/// columns go from left to right and rows from top to bottom.
///
/// The error is one of the depth z along the optical axis, not of the range. Cameras that
/// triangulate (structured light, stereo) measure the disparity f b / z in steps, so that the steps
/// of the depth grow with its square (Khoshelham and Elberink 2012). Pixels have a width: where one
/// sees two surfaces, the reading lies between them.
#pragma once

#include <algorithm>
#include <cstddef>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/range_noise.hpp>
#include <gnomon/simulation/beam.hpp>

namespace gnomon::simulation {

namespace detail {

/// Of the middle of a pixel from the optical axis, at the depth 1.
/// @param number        of the pixel in its row or column
/// @param size          of that [pixels]
/// @param focal_length  [pixels]
[[nodiscard]] inline double pixel_offset(std::size_t number, std::size_t size,
                                         double focal_length) {
    return (static_cast<double>(number) + 0.5 - 0.5 * static_cast<double>(size)) / focal_length;
}

}  // namespace detail

/// A depth camera. The default is an ideal pinhole camera of the size of a Kinect.
struct depth_camera {
    std::size_t columns = 640;                ///< of pixels
    std::size_t rows = 480;                   ///< of pixels
    double focal_length = 575.0;              ///< f [pixel]
    noise_curve noise = constant_noise{0.0};  ///< standard deviation of the depth, of the depth
    double baseline = 0.0;                    ///< b, of cameras that triangulate [m]
    double disparity_step = 0.0;              ///< of cameras that triangulate [pixel]; 0 for none
    double min_depth = 0.4;                   ///< nearer surfaces give no reading [m]
    double max_depth = 8.0;                   ///< farther surfaces give no reading [m]

    /// The number of pixels. Precondition: the camera is valid.
    [[nodiscard]] std::size_t pixels() const { return columns * rows; }

    /// The direction of a pixel in the sensor's frame, of length 1; pixels are numbered row by row.
    [[nodiscard]] Eigen::Vector3d direction(std::size_t pixel) const {
        const double right = detail::pixel_offset(pixel % columns, columns, focal_length);
        const double down = detail::pixel_offset(pixel / columns, rows, focal_length);
        const double scale = 1.0 / std::sqrt(1.0 + right * right + down * down);
        return {scale, -right * scale, -down * scale};
    }

    /// The width of a pixel as a beam: the mean of all surfaces that it sees, twice as wide as the
    /// distance between pixels in terms of 1/e^2.
    [[nodiscard]] beam_footprint pixel() const {
        return {.divergence = radians(2.0 * std::atan(1.0 / focal_length)),
                .rule = echo_rule::averaged};
    }

    /// Whether a surface at this depth [m] gives a reading.
    [[nodiscard]] bool sees(double z) const { return z >= min_depth && z <= max_depth; }

    /// The longest range of a reading, at a corner of the image [m].
    [[nodiscard]] double max_range() const { return max_depth / direction(0)[0]; }

    /// The depth [m] nearest to z [m] that the camera can report.
    [[nodiscard]] double reported(double z) const {
        if (disparity_step == 0.0) return z;
        const double steps = focal_length * baseline / (z * disparity_step);
        return focal_length * baseline / (std::max(1.0, std::round(steps)) * disparity_step);
    }

    /// @throws std::invalid_argument  unless there are 1 to 100,000,000 pixels, lengths are finite
    ///                                and positive (baseline and step may be 0, but a step needs a
    ///                                baseline), and min_depth < max_depth
    void require_valid() const {
        using gnomon::detail::require;
        constexpr std::size_t most = 100'000'000;
        require(columns >= 1 && rows >= 1 && columns <= most && rows <= most / columns,
                "depth_camera: needs 1 to 100,000,000 pixels");
        require(focal_length > 0.0 && std::isfinite(focal_length),
                "depth_camera: the focal length must be positive and finite");
        require(baseline >= 0.0 && std::isfinite(baseline) && disparity_step >= 0.0 &&
                    std::isfinite(disparity_step) && (disparity_step == 0.0 || baseline > 0.0),
                "depth_camera: disparities in steps need a baseline");
        require(min_depth >= 0.0 && min_depth < max_depth && std::isfinite(max_depth),
                "depth_camera: needs 0 <= min_depth < max_depth, finite");
    }
};

/// Published depth cameras, with the noise of their depths.
namespace scanners {

/// A camera of structured light, the first Kinect: 58 degrees, disparities in eighths of a pixel
/// (Khoshelham and Elberink 2012), noise by Nguyen, Izadi and Lovell 2012.
[[nodiscard]] inline depth_camera structured_light() {
    return {.noise = noises::structured_light(), .baseline = 0.075, .disparity_step = 0.125};
}

/// A camera that measures times of flight, the second Kinect: 512 x 424 pixels (Fankhauser et al.
/// 2015).
[[nodiscard]] inline depth_camera time_of_flight() {
    return {.columns = 512,
            .rows = 424,
            .focal_length = 365.0,
            .noise = noises::time_of_flight(),
            .min_depth = 0.5,
            .max_depth = 4.5};
}

/// A stereo camera, an Intel RealSense D415 at 1280 x 720: disparities in 32nds of a pixel
/// (Grunnet-Jepsen, Sweetser and Woodfill 2018).
[[nodiscard]] inline depth_camera stereo() {
    return {.columns = 1280,
            .rows = 720,
            .focal_length = 1005.0,
            .noise = noises::stereo(),
            .baseline = 0.055,
            .disparity_step = 1.0 / 32.0,
            .min_depth = 0.45,
            .max_depth = 10.0};
}

}  // namespace scanners

}  // namespace gnomon::simulation
