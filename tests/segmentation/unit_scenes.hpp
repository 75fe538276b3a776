// SPDX-License-Identifier: BSL-1.0
/// @file
/// The three unit scenes of Fig. 4.2 (b)-(d) and the outlier bridge of Fig. 4.3, with true normals.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "laws/clouds.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/normals/estimate_normals.hpp>

namespace unit_scenes {

/// Points with surface elements made by hand.
struct scene {
    clouds::cloud points;
    std::vector<gnomon::surfel<gnomon::normal_fit>> surface;

    void add(const Eigen::Vector3d& p, const Eigen::Vector3d& n, double mean_distance = 0.03) {
        points.push_back(p);
        surface.emplace_back();
        surface.back().normal = n;
        surface.back().trust = gnomon::trust::good;
        surface.back().mean_distance = mean_distance;
    }
};

/// A strip of 40 x 20 points, one centimetre apart, bent by height(s) and tilt(s) along its length.
scene strip(auto&& position, auto&& tilt) {
    scene s;
    for (int i = 0; i < 40; ++i) {
        for (int j = 0; j < 20; ++j) {
            const Eigen::Vector2d xz = position(0.01 * i);
            const double t = tilt(0.01 * i);
            s.add({xz.x(), 0.01 * j, xz.y()}, {-std::sin(t), 0.0, std::cos(t)});
        }
    }
    return s;
}

/// Two halves at right angles.
inline scene corner() {
    return strip(
        [](double s) {
            return s < 0.195 ? Eigen::Vector2d(s, 0) : Eigen::Vector2d(0.19, s - 0.19);
        },
        [](double s) { return s < 0.195 ? 0.0 : 0.5 * std::numbers::pi; });
}

/// Two parallel halves, 10 cm apart in height.
inline scene step() {
    return strip([](double s) { return Eigen::Vector2d(s, s < 0.195 ? 0.0 : 0.1); },
                 [](double) { return 0.0; });
}

/// A quarter of a cylinder of radius 25 cm.
inline scene smooth() {
    constexpr double r = 0.25;
    return strip(
        [](double s) { return Eigen::Vector2d(r * std::sin(s / r), r - r * std::cos(s / r)); },
        [](double s) { return s / r; });
}

/// Two flat patches with a chain of three sparse outliers between them whose normals agree.
inline scene outlier_bridge() {
    scene s;
    for (int i = 0; i < 20; ++i) {
        for (int j = 0; j < 20; ++j) {
            s.add({0.01 * i, 0.01 * j, 0}, {0, 0, 1});
            s.add({1.4 + 0.01 * i, 0.01 * j, 0}, {0, 0, 1});
        }
    }
    for (const double x : {0.5, 0.8, 1.1}) s.add({x, 0.1, 0.0}, {0, 0, 1}, 0.6);
    return s;
}

}  // namespace unit_scenes
