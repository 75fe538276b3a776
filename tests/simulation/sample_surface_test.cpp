// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include <gnomon/simulation/box.hpp>
#include <gnomon/simulation/sample_surface.hpp>
#include <gnomon/simulation/scene.hpp>
#include <gnomon/simulation/sphere.hpp>

namespace {

namespace sim = gnomon::simulation;

/// A ball in a box is not visible, and samples are as many as squares.
TEST(sample_surface, samples_the_visible_surface_evenly) {
    sim::scene scene;
    scene.add_object("box", sim::box{1.0, 0.6, 0.4}, sim::at(0, 0, 0.2));
    scene.add_object("ball", sim::sphere{.radius = 0.1}, sim::at(0, 0, 0.2));
    const double spacing = 0.02;
    const auto samples = sim::sample_surface(scene, {.spacing = spacing});
    const double area = 2.0 * (1.0 * 0.6 + 1.0 * 0.4 + 0.6 * 0.4);
    const double squares = area / (spacing * spacing);
    EXPECT_GT(static_cast<double>(samples.size()), 0.85 * squares);
    EXPECT_LT(static_cast<double>(samples.size()), 1.15 * squares);
    std::size_t on_top = 0;
    for (const auto& s : samples) {
        EXPECT_NEAR(s.normal.norm(), 1.0, 1e-12);
        // On the box, with its outer normal.
        const Eigen::Vector3d middle(0, 0, 0.2), half(0.5, 0.3, 0.2);
        const Eigen::Vector3d out = (s.position - middle).cwiseAbs() - half;
        EXPECT_NEAR(out.maxCoeff(), 0.0, 1e-9);
        EXPECT_GT(s.normal.dot(s.position - middle), 0.19);
        on_top += s.normal.z() > 0.5;
    }
    EXPECT_NEAR(static_cast<double>(on_top) / static_cast<double>(samples.size()), 0.6 / area,
                0.02);
}

TEST(sample_surface, is_the_same_for_the_same_seed) {
    const auto model = sim::furniture_models()[3];
    const auto a = sim::sample_surface(model, {.spacing = 0.04});
    const auto b = sim::sample_surface(model, {.spacing = 0.04});
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].position, b[i].position);
}

TEST(sample_surface, refuses_what_cannot_be_meant) {
    const sim::scene empty;
    EXPECT_TRUE(sim::sample_surface(empty).empty());
    EXPECT_THROW((void)sim::sample_surface(empty, {.spacing = 0.0}), std::invalid_argument);
    EXPECT_THROW((void)sim::sample_surface(empty, {.spacing = std::nan("")}),
                 std::invalid_argument);
    EXPECT_THROW((void)sim::sample_surface(empty, {.directions = 0}), std::invalid_argument);
}

}  // namespace
