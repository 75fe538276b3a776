// SPDX-License-Identifier: BSL-1.0
/// @file
/// Organized images of planes, as a depth camera at the origin sees them along the z axis, x to the
/// right and y down.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "laws/clouds.hpp"
#include <gnomon/core/plane.hpp>
#include <gnomon/core/random.hpp>

namespace images {

inline constexpr double focal_length = 525.0;  // [pixels], of the first Kinect

/// The ray of a pixel of an image of this size, of depth 1.
inline Eigen::Vector3d ray(std::size_t x, std::size_t y, std::size_t width, std::size_t height) {
    const auto offset = [](std::size_t at, std::size_t of) {
        return (static_cast<double>(at) - 0.5 * static_cast<double>(of - 1)) / focal_length;
    };
    return {offset(x, width), offset(y, height), 1.0};
}

/// The image of the first of the planes that each ray meets.
/// @param of_pixel  if there, becomes the number of the plane of each pixel, or -1
inline clouds::cloud of_planes(const std::vector<gnomon::plane>& planes, std::size_t width,
                               std::size_t height, std::vector<int>* of_pixel = nullptr) {
    clouds::cloud image;
    for (std::size_t y = 0; y < height; ++y) {
        for (std::size_t x = 0; x < width; ++x) {
            const Eigen::Vector3d u = ray(x, y, width, height);
            double depth = clouds::infinity;
            int nearest = -1;
            for (std::size_t p = 0; p < planes.size(); ++p) {
                const double z = planes[p].offset / planes[p].normal.dot(u);
                if (!(z > 0.0 && z < depth)) continue;
                depth = z;
                nearest = static_cast<int>(p);
            }
            image.push_back(nearest < 0 ? Eigen::Vector3d::Constant(clouds::nan)
                                        : Eigen::Vector3d(depth * u));
            if (of_pixel != nullptr) of_pixel->push_back(nearest);
        }
    }
    return image;
}

/// The same image with Gaussian noise of the depth, and without the returns of some pixels.
/// @param sigma  sigma(depth) [m]
/// @param lost   the share of pixels without a return
inline clouds::cloud measured(clouds::cloud image, auto&& sigma, double lost, std::uint64_t seed) {
    gnomon::random_stream random(seed);
    for (Eigen::Vector3d& p : image) {
        p *= 1.0 + sigma(p.z()) * random.gaussian() / p.z();
        if (random.uniform() < lost) p.setConstant(clouds::nan);
    }
    return image;
}

/// The depths of the first Kinect: disparities in steps of 1/8 pixel, at a baseline of 75 mm.
inline void quantize(clouds::cloud& image) {
    constexpr double steps = 8.0 * focal_length * 0.075;
    for (Eigen::Vector3d& p : image) p *= steps / std::round(steps / p.z()) / p.z();
}

}  // namespace images
