// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "recognition/room_views.hpp"
#include <gnomon/recognition/surface_model.hpp>

namespace {

namespace rec = gnomon::recognition;

struct oriented_sample {
    Eigen::Vector3d at, normal;
};

rec::surface_model of_samples(const std::vector<oriented_sample>& s, double spacing = 0.02) {
    return rec::surface_model(s, s, spacing, {}, &oriented_sample::at);
}

/// Of the built-in furniture by its shape: a square stool, rectangular and round tables, chairs.
TEST(surface_model, measures_the_symmetry_of_furniture) {
    const auto models = gnomon::simulation::furniture_models();
    const int any = rec::vertical_symmetry::any_turn;
    const std::vector<int> orders{1, 1, 1, 4, 1, 1, 2, 2, any, 2, 4, 2};
    for (std::size_t i = 0; i < models.size(); ++i) {
        const auto surface = room_views::surface_of(models[i]);
        EXPECT_EQ(surface.symmetry().order, orders[i]) << models[i].name;
        if (orders[i] == 1) continue;
        EXPECT_NEAR(surface.symmetry().x, 0.0, 0.01);
        EXPECT_NEAR(surface.symmetry().y, 0.0, 0.01);
    }
}

TEST(surface_model, keeps_what_was_stored) {
    const std::vector<oriented_sample> samples{{{0, 0, 1}, {0, 0, 1}}, {{1, 0, 0.5}, {1, 0, 0}}};
    const rec::vertical_symmetry stored{.order = 3, .x = 1.0, .y = 2.0};
    const rec::surface_model m(samples, samples, 0.1, stored, &oriented_sample::at);
    EXPECT_EQ(m.symmetry().order, 3);
    EXPECT_EQ(m.points().size(), 2u);
    EXPECT_EQ(m.normals()[1].normal, samples[1].normal);
    EXPECT_EQ(m.low(), Eigen::Vector3d(0, 0, 0.5));
    EXPECT_EQ(m.high(), Eigen::Vector3d(1, 0, 1));
    EXPECT_EQ(m.spacing(), 0.1);
}

/// Each sample is within two spacings of a coarse one of its side, and coarse ones of one side are
/// farther apart than that.
TEST(surface_model, has_coarse_samples) {
    for (const auto& furniture : gnomon::simulation::furniture_models()) {
        const auto model = room_views::surface_of(furniture);
        const auto& coarse = model.coarse();
        ASSERT_EQ(coarse.points.size(), coarse.normals.size());
        EXPECT_LT(2 * coarse.points.size(), model.points().size()) << furniture.name;
        const double reach = 2.0 * model.spacing();
        const auto of_one_side = [&](const Eigen::Vector3d& x, const Eigen::Vector3d& normal) {
            const auto near = coarse.points.within(x, reach);
            return std::ranges::count_if(near, [&](const gnomon::neighbor& q) {
                return coarse.normals[q.index].normal.dot(normal) > 0.8;
            });
        };
        for (std::size_t i = 0; i < model.points().size(); ++i)
            EXPECT_GE(of_one_side(model.points()[i], model.normals()[i].normal), 1);
        for (std::size_t i = 0; i < coarse.points.size(); ++i)
            EXPECT_EQ(of_one_side(coarse.points[i], coarse.normals[i].normal), 1);
    }
    EXPECT_EQ(of_samples({}).coarse().points.size(), 0u);
}

TEST(surface_model, refuses_bad_samples) {
    const oriented_sample good{{0, 0, 1}, {0, 0, 1}};
    EXPECT_THROW((void)of_samples({good, {{0, 0, 1}, {0, 0, 2}}}), std::invalid_argument);
    EXPECT_THROW((void)of_samples({good, {{0, 0, 1}, {0, 0, 0}}}), std::invalid_argument);
    EXPECT_THROW((void)of_samples({good, {{0, NAN, 1}, {0, 0, 1}}}), std::invalid_argument);
    EXPECT_THROW((void)of_samples({good}, 0.0), std::invalid_argument);
    EXPECT_THROW((void)of_samples({good}, NAN), std::invalid_argument);
    EXPECT_EQ(of_samples({}).points().size(), 0u);
    const auto furniture = gnomon::simulation::furniture_models()[0];
    const auto samples = gnomon::simulation::sample_surface(furniture, {.spacing = 0.05});
    for (const rec::vertical_symmetry& bad :
         {rec::vertical_symmetry{.order = -1}, rec::vertical_symmetry{.order = 2, .x = NAN}})
        EXPECT_THROW((void)rec::surface_model(samples, samples, 0.05, bad,
                                              &gnomon::simulation::surface_sample::position),
                     std::invalid_argument);
}

}  // namespace
