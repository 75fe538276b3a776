// SPDX-License-Identifier: BSL-1.0
/// @file
/// Samples of closed surfaces, which have an inside and an outside.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include <Eigen/Core>

#include "laws/clouds.hpp"
#include <gnomon/core/random.hpp>

namespace solids {

/// Points of closed surfaces, with the outer normal at each.
struct solid {
    clouds::cloud points;
    clouds::cloud outside;

    void add(const Eigen::Vector3d& p, const Eigen::Vector3d& n) {
        points.push_back(p);
        outside.push_back(n);
    }

    void add_sphere(const Eigen::Vector3d& center, std::size_t n, double sigma = 0.0) {
        gnomon::random_stream random(n);
        for (std::size_t i = 0; i < n; ++i) {
            const Eigen::Vector3d u = clouds::gaussian_vector(random).normalized();
            add(center + u * (1.0 + sigma * random.gaussian()), u);
        }
    }

    /// `per_square_meter` points on each side, with noise along the normal.
    void add_box(const Eigen::Vector3d& half, double per_square_meter, double sigma = 0.0) {
        gnomon::random_stream random(static_cast<std::uint64_t>(per_square_meter));
        for (int side = 0; side < 6; ++side) {
            const int a = side / 2;
            const int b = (a + 1) % 3;
            const int c = (a + 2) % 3;
            Eigen::Vector3d n(0, 0, 0);
            n[a] = side % 2 == 0 ? 1.0 : -1.0;
            const double points_on_side = 4 * half[b] * half[c] * per_square_meter;
            for (int i = 0; i < static_cast<int>(points_on_side); ++i) {
                Eigen::Vector3d p;
                p[a] = n[a] * half[a] + sigma * random.gaussian();
                p[b] = random.uniform(-half[b], half[b]);
                p[c] = random.uniform(-half[c], half[c]);
                add(p, n);
            }
        }
    }

    void add_torus(std::size_t n) {
        gnomon::random_stream random(n);
        for (std::size_t i = 0; i < n; ++i) {
            const double u = random.uniform(0.0, 2 * std::numbers::pi);
            const double v = random.uniform(0.0, 2 * std::numbers::pi);
            const Eigen::Vector3d spoke(std::cos(u), std::sin(u), 0);
            const Eigen::Vector3d m = spoke * std::cos(v) + Eigen::Vector3d(0, 0, std::sin(v));
            add(spoke + 0.3 * m, m);
        }
    }

    /// Of radius 0.2 and height 1, with both lids.
    void add_cylinder(std::size_t n) {
        gnomon::random_stream random(n);
        for (std::size_t i = 0; i < n; ++i) {
            const double u = random.uniform(0.0, 2 * std::numbers::pi);
            const Eigen::Vector3d spoke(std::cos(u), std::sin(u), 0);
            const double z = random.uniform();
            if (i % 6 == 0) {
                const double up = i % 12 == 0 ? 1.0 : 0.0;
                add({0.2 * std::sqrt(z) * spoke.x(), 0.2 * std::sqrt(z) * spoke.y(), up},
                    {0, 0, 2 * up - 1});
            } else {
                add(0.2 * spoke + Eigen::Vector3d(0, 0, z), spoke);
            }
        }
    }
};

}  // namespace solids
