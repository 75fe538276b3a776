// SPDX-License-Identifier: BSL-1.0
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/features/detail/curved_surfaces.hpp>
#include <gnomon/features/detail/surface_regression.hpp>

namespace {

using gnomon::detail::regression_point;
using gnomon::detail::sphere_surface;
using gnomon::detail::surface_foot;
using gnomon::detail::surface_regression;

constexpr double deviation_of_samples = 0.01;
constexpr int many_iterations = 100;

/// Noisy points of the unit sphere whose view points are unknown.
std::vector<regression_point> sphere_samples(std::size_t n, std::uint64_t seed) {
    gnomon::random_stream random(seed, 21);
    std::vector<regression_point> points;
    for (std::size_t i = 0; i < n; ++i) {
        const Eigen::Vector3d at = clouds::gaussian_vector(random).normalized() +
                                   deviation_of_samples * clouds::gaussian_vector(random);
        points.push_back({at, {0.0, 0.0, 0.0}, deviation_of_samples});
    }
    return points;
}

/// All steps from a first sphere lead to none that is valid.
struct sphere_without_neighbors : sphere_surface {
    bool is_first = true;

    [[nodiscard]] sphere_without_neighbors moved(const std::array<double, 4>& step) const {
        return {sphere_surface::moved(step), false};
    }
    [[nodiscard]] bool is_valid() const { return is_first; }
};

/// The curvature has the sign that moves the surface away: residuals about a small one are those
/// of a larger one and vice versa, without a fixed point.
struct sphere_without_fixed_point : sphere_surface {
    double limit = 1.0;

    [[nodiscard]] surface_foot foot_of(const Eigen::Vector3d& x) const {
        surface_foot foot = sphere_surface::foot_of(x);
        foot.curvature = (radius > limit ? 0.3 : -0.3) / deviation_of_samples;
        return foot;
    }
    [[nodiscard]] sphere_without_fixed_point moved(const std::array<double, 4>& step) const {
        return {sphere_surface::moved(step), limit};
    }
};

const gnomon::sequential unthreaded;

TEST(surface_regression, converges_to_the_minimum) {
    const auto points = sphere_samples(200, 1);
    surface_regression<sphere_surface, gnomon::sequential> regression(points, unthreaded);
    const auto fit = regression.from({{0.3, 0.1, -0.2}, 1.4}, many_iterations);
    EXPECT_TRUE(fit.is_converged);
    EXPECT_NEAR(fit.surface.radius, 1.0, 5e-3);
    EXPECT_FALSE(fit.is_settled(fit.first_gain));
    const auto again = regression.from(fit.surface, many_iterations);
    EXPECT_TRUE(again.is_settled(again.first_gain));
    EXPECT_TRUE(regression.refined(fit, many_iterations).is_converged);
}

TEST(surface_regression, is_not_converged_if_it_is_cut_off) {
    const auto points = sphere_samples(200, 2);
    const surface_regression<sphere_surface, gnomon::sequential> regression(points, unthreaded);
    EXPECT_FALSE(regression.from({{0.3, 0.1, -0.2}, 1.4}, 2).is_converged);
}

/// A step that damping has made negligible is no sign of a minimum.
TEST(surface_regression, is_not_converged_if_all_steps_are_rejected) {
    const auto points = sphere_samples(200, 3);
    const surface_regression<sphere_without_neighbors, gnomon::sequential> regression(points,
                                                                                      unthreaded);
    for (const double radius : {1.4, 1.003}) {
        const auto fit = regression.from({{{0.0, 0.0, 0.0}, radius}}, many_iterations);
        EXPECT_FALSE(fit.is_converged);
        EXPECT_EQ(fit.surface.radius, radius);
    }
}

TEST(surface_regression, is_not_converged_without_a_fixed_point_of_the_residuals) {
    const auto points = sphere_samples(200, 4);
    surface_regression<sphere_without_fixed_point, gnomon::sequential> regression(points,
                                                                                  unthreaded);
    sphere_without_fixed_point start{{{0.0, 0.0, 0.0}, 1.1}};
    auto fit = regression.from(start, many_iterations);
    ASSERT_TRUE(fit.is_converged);
    fit.surface.limit = fit.surface.radius;
    EXPECT_FALSE(regression.refined(fit, many_iterations).is_converged);
}

}  // namespace
