// SPDX-License-Identifier: BSL-1.0
/// @file
/// Quantized readings: the coordinate that takes few distinct values (the range, or the depth along
/// the optical axis of a camera), and the step between them.
#pragma once

#include <algorithm>
#include <cstddef>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/normals/detail/noise_fit.hpp>
#include <gnomon/normals/detail/residual_sampler.hpp>

namespace gnomon::detail {

/// The quantization of a sensor.
struct quantization {
    bool found = false;
    even_quartic variance = {};  ///< of the rounding to a step: step^2 / 12 [m^2]
};

/// The optical axis of a camera whose depth is quantized: where a whole neighborhood has one depth,
/// its plane has no residuals and faces the camera. 0 if there is none.
[[nodiscard]] Eigen::Vector3d axis_of_exact_planes(const auto& planes) {
    constexpr double exact = 1e-12;      // of the squared range: single precision rounds by 4e-15
    constexpr double same = 1.0 - 1e-6;  // the cosine of .08 degrees, for single precision
    // Chosen, on cameras in furnished rooms 20,001 to 20,006: some by chance do not make an axis.
    constexpr std::size_t needed = 30;
    scratch<Eigen::Vector3d> normals;
    for (const sampled_plane& s : planes)
        if (dot(s.normal, s.normal) > 0.0 && s.variance < exact * dot(s.ray, s.ray))
            normals.push_back(s.normal);
    const auto agreeing = [&](const Eigen::Vector3d& n) {
        return static_cast<std::size_t>(
            std::count_if(normals.begin(), normals.end(),
                          [&](const Eigen::Vector3d& m) { return std::abs(dot(m, n)) > same; }));
    };
    Eigen::Vector3d axis(0.0, 0.0, 0.0);
    if (normals.size() < needed || normals.size() * 100 < planes.size()) return axis;
    std::size_t most = normals.size() / 2;
    constexpr std::size_t candidates = 100;  // performance only
    for (std::size_t c = 0; c < normals.size(); c += 1 + normals.size() / candidates) {
        const std::size_t n = agreeing(normals[c]);
        if (n <= most) continue;
        most = n;
        axis = normals[c];
    }
    return axis;
}

/// The quantization of readings. Sorts them.
[[nodiscard]] quantization quantization_of(auto& readings) {
    constexpr double distinct = 3e-6;  // relative; single precision rounds by 6e-8
    // Readings to each distinct value, and values, at least (noise-free continuous readings have 1;
    // quantized ones 50 and more). Chosen on the same cameras.
    constexpr std::size_t per_value = 20, fewest_steps = 5;
    std::sort(readings.begin(), readings.end());
    scratch<value_at> steps;
    for (std::size_t i = 1; i < readings.size(); ++i) {
        const double gap = readings[i] - readings[i - 1];
        if (gap > distinct * std::max(0.1, readings[i])) steps.push_back({readings[i], gap});
    }
    if (steps.size() < fewest_steps || steps.size() * per_value > readings.size()) return {};
    // Values that no reading took make some gaps two steps wide, so less than the median. Chosen on
    // the same cameras.
    constexpr double typical = 0.4;     // quantile
    constexpr std::size_t fewest = 10;  // steps to a bin
    even_regression regression(steps[steps.size() / 2].x);
    for_each_bin(steps, fewest, typical, [&](double x, double step) {
        const double variance = step * step / 12.0;
        regression.add(x, variance, 1.0 / (variance * variance));
    });
    return {true, regression.solve()};
}

}  // namespace gnomon::detail
