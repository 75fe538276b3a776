// SPDX-License-Identifier: BSL-1.0
/// @file
/// Random points of a surface, each with the true normal there.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>

#include <Eigen/Core>

namespace known_normals {

using Eigen::Vector3d;

/// Random numbers, the same on every platform. No stream of gnomon's own: the clouds on which
/// `feature_preserving` was tuned were drawn with these, and are to be drawn again.
class dice {
  public:
    explicit dice(std::uint64_t seed) : engine_(seed) {}

    /// Uniform in [0, 1).
    double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

    /// Uniform in [low, high), up to rounding.
    double uniform(double low, double high) { return low + (high - low) * uniform(); }

    /// Uniform in the cube [low, high)^3.
    Vector3d in_cube(double low, double high) {
        const double z = uniform(low, high);
        const double y = uniform(low, high);
        return {uniform(low, high), y, z};
    }

    /// Standard normal in each coordinate (Box and Muller 1958).
    Vector3d gaussian() {
        Vector3d g;
        for (double& x : g) {
            const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
            x = radius * std::cos(2.0 * std::numbers::pi * uniform());
        }
        return g;
    }

  private:
    std::mt19937_64 engine_;
};

/// A point of a surface.
struct surface_point {
    Vector3d position;
    Vector3d normal;  ///< unit length
};

/// A surface: gives a point of it, uniform by area.
using surface = std::function<surface_point(dice&)>;

}  // namespace known_normals
