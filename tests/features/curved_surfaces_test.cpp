// SPDX-License-Identifier: BSL-1.0
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/features/detail/curved_surfaces.hpp>

namespace {

using gnomon::detail::cone_surface;
using gnomon::detail::cylinder_surface;
using gnomon::detail::sphere_surface;

template <class Surface>
Surface random_surface(std::uint64_t seed) {
    gnomon::random_stream random(seed, 12);
    std::array<double, Surface::parameters> step{};
    for (double& s : step) s = random.uniform(-0.5, 0.5);
    Surface s;
    s.radius = 1.5;
    return s.moved(step);
}

/// Derivatives of the distance with respect to parameters and position against differences, and the
/// curvature against the divergence of the normal.
template <class Surface>
void expect_derivatives(std::uint64_t seed) {
    const auto s = random_surface<Surface>(seed);
    ASSERT_TRUE(s.is_valid());
    gnomon::random_stream random(seed, 13);
    Eigen::Vector3d x = clouds::gaussian_vector(random);
    const auto foot = s.foot_of(x);
    const auto gradient = s.gradient(foot);
    constexpr double h = 1e-5;
    for (std::size_t k = 0; k < Surface::parameters; ++k) {
        std::array<double, Surface::parameters> step{};
        step[k] = h;
        const double after = s.moved(step).foot_of(x).distance;
        step[k] = -h;
        const double before = s.moved(step).foot_of(x).distance;
        EXPECT_NEAR(gradient[k], (after - before) / (2.0 * h), 1e-7) << "parameter " << k;
    }
    const Eigen::Vector3d on = x - foot.distance * foot.normal;
    EXPECT_NEAR(s.foot_of(on).distance, 0.0, 1e-12);
    double divergence = 0.0;
    for (int a = 0; a < 3; ++a) {
        const Eigen::Vector3d d = h * Eigen::Vector3d::Unit(a);
        EXPECT_NEAR(foot.normal[a],
                    (s.foot_of(x + d).distance - s.foot_of(x - d).distance) / (2.0 * h), 1e-7);
        divergence += (s.foot_of(on + d).normal[a] - s.foot_of(on - d).normal[a]) / (2.0 * h);
    }
    // Near the apex of a cone, h is not small.
    const double tolerance = foot.curvature < 10.0 ? 1e-5 : clouds::infinity;
    EXPECT_NEAR(foot.curvature, divergence, tolerance);
}

TEST(curved_surfaces, have_the_derivatives_of_their_distance) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE(seed);
        expect_derivatives<sphere_surface>(seed);
        expect_derivatives<cylinder_surface>(seed);
        expect_derivatives<cone_surface>(seed);
    }
}

/// Normal form: orthonormal axes, the point of the axis nearest to the origin, a radius that
/// increases along the axis.
TEST(curved_surfaces, have_a_normal_form) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        const auto s = random_surface<cone_surface>(seed);
        EXPECT_NEAR(s.axis.norm(), 1.0, 1e-15);
        EXPECT_NEAR(s.e1.norm(), 1.0, 1e-15);
        EXPECT_NEAR(s.e1.dot(s.axis), 0.0, 1e-15);
        EXPECT_NEAR(s.point.dot(s.axis), 0.0, 1e-15);
        EXPECT_GE(s.half_angle, 0.0);
        EXPECT_NEAR(s.sine, std::sin(s.half_angle), 1e-15);
    }
}

TEST(curved_surfaces, have_a_half_angle_below_a_right_angle_after_a_step_of_turns) {
    cone_surface s;
    s.radius = 1.5;
    for (const double step : {0.3, 2.0 * std::numbers::pi + 0.3, -2.0 * std::numbers::pi - 0.3}) {
        const cone_surface after = s.moved({0, 0, 0, 0, 0, step});
        ASSERT_TRUE(after.is_valid());
        EXPECT_NEAR(after.half_angle, 0.3, 1e-14);
    }
}

}  // namespace
