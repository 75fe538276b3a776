// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core.hpp>
#include <gnomon/perception/perceive_views.hpp>
#include <gnomon/perception/views_of_segments.hpp>
#include <gnomon/simulation.hpp>
#include <gnomon/simulation/object_views.hpp>

namespace rec = gnomon::recognition;
namespace sim = gnomon::simulation;

namespace {

/// Of an object on a floor that is not in the scan.
const rec::perceive_views_options of_one_object{
    .ground = gnomon::plane{}, .noise = gnomon::constant_noise{0.005}, .gap = rec::infinite_gap};

void expect_same_view(const rec::view& a, const rec::view& b) {
    ASSERT_EQ(a.parts.size(), b.parts.size());
    for (std::size_t p = 0; p < a.parts.size(); ++p) {
        const rec::part &x = a.parts[p], &y = b.parts[p];
        EXPECT_EQ(x.segment, y.segment);
        EXPECT_EQ(x.shape.frame.centroid, y.shape.frame.centroid);
        EXPECT_EQ(x.shape.mean_normal, y.shape.mean_normal);
        EXPECT_EQ(x.shape.mean_surface_variation, y.shape.mean_surface_variation);
        EXPECT_EQ(x.lowest, y.lowest);
        EXPECT_EQ(x.highest, y.highest);
    }
    constexpr auto all = gnomon::recognition::height_profile::count;
    EXPECT_EQ(a.rest.band(0, all).points, b.rest.band(0, all).points);
}

/// The parts that perceive_views() found make the view that it made.
TEST(views_of_segments, parts_that_were_perceived_are_the_same_view) {
    std::size_t views = 0;
    for (const auto& model : sim::furniture_models()) {
        const auto shot = sim::simulate_object_view(model, 3, {.seed = 5});
        const auto seen = rec::perceive_views(shot.truth.scan, of_one_object);
        const auto known = rec::views_of_segments(shot.truth.scan, seen.parts, of_one_object);
        ASSERT_EQ(seen.views.size(), known.size()) << model.name;
        for (std::size_t v = 0; v < known.size(); ++v) expect_same_view(seen.views[v], known[v]);
        views += known.size();
    }
    EXPECT_GE(views, 10u);
}

/// All points as one segment are one part, as high as the object, and there is no rest.
TEST(views_of_segments, an_object_as_one_part) {
    const auto shot = sim::simulate_object_view(sim::furniture_models()[0], 3, {.seed = 5});
    const gnomon::segments whole(std::vector<std::int32_t>(shot.truth.scan.size(), 0));
    const auto views = rec::views_of_segments(shot.truth.scan, whole, of_one_object);
    ASSERT_EQ(views.size(), 1u);
    ASSERT_EQ(views[0].parts.size(), 1u);
    double highest = 0.0;
    for (const auto& x : shot.truth.scan.points) highest = std::max(highest, x.z());
    EXPECT_NEAR(views[0].parts[0].highest, highest, 0.02);
    EXPECT_EQ(views[0].rest.band(0, rec::height_profile::count).points, 0.0);
}

/// Segments far from each other are different objects; points of none are the rest of the nearest.
TEST(views_of_segments, are_grouped_by_the_gap) {
    std::vector<Eigen::Vector3d> points;
    std::vector<std::int32_t> labels;
    const auto add_square = [&](double x, std::int32_t label) {
        for (int i = 0; i < 20; ++i)
            for (int j = 0; j < 20; ++j) {
                points.emplace_back(x + 0.015 * i, 0.015 * j, 0.5 + 0.001 * ((i + j) % 2));
                labels.push_back(label);
            }
    };
    add_square(1.0, 0);
    add_square(1.35, 1);  // 6 cm from the first
    add_square(3.0, 4);
    add_square(3.3, gnomon::unlabeled);
    const auto views_by = [&](double gap) {
        return rec::views_of_segments(points, gnomon::segments(labels),
                                      {.ground = gnomon::plane{}, .gap = gap}, gnomon::threads{2});
    };
    const auto near = views_by(0.10), apart = views_by(0.04);
    ASSERT_EQ(near.size(), 2u);
    EXPECT_EQ(near[0].parts.size(), 2u);
    ASSERT_EQ(near[1].parts.size(), 1u);
    EXPECT_EQ(near[1].parts[0].segment, 4);
    EXPECT_GT(near[1].rest.band(0, rec::height_profile::count).points, 0.0);
    EXPECT_EQ(apart.size(), 3u);
}

/// Whatever the order of the points and the number of threads.
TEST(views_of_segments, a_cell_is_of_the_segment_of_most_of_its_points) {
    std::vector<Eigen::Vector3d> points;
    std::vector<std::int32_t> labels;
    // Squares of two segments, of which the second is in cells of the first, with fewer points.
    for (int i = 0; i < 30; ++i)
        for (int j = 0; j < 30; ++j)
            for (int k = 0; k < 3; ++k) {
                points.emplace_back(1.003 + 0.01 * i + 0.002 * k, 0.005 + 0.01 * j, 0.505);
                labels.push_back(k == 2 ? 0 : 1);
            }
    const auto views = [&](const auto& run) {
        return rec::views_of_segments(points, gnomon::segments(labels), of_one_object, run);
    };
    const auto forwards = views(gnomon::sequential{});
    std::ranges::reverse(points);
    std::ranges::reverse(labels);
    for (const auto& some : {forwards, views(gnomon::sequential{}), views(gnomon::threads{3})}) {
        ASSERT_EQ(some.size(), 1u);
        ASSERT_EQ(some[0].parts.size(), 1u);
        EXPECT_EQ(some[0].parts[0].segment, 1);
        EXPECT_EQ(some[0].parts[0].shape.points, forwards[0].parts[0].shape.points);
    }
}

/// Unlabeled points belong to no view if they are farther from all parts than the gap.
TEST(views_of_segments, far_points_are_no_rest) {
    auto shot = sim::simulate_object_view(sim::furniture_models()[0], 3, {.seed = 5});
    std::vector<std::int32_t> labels(shot.truth.scan.size(), 0);
    auto near = of_one_object;
    near.gap = 0.10;
    const auto rest = [&] {
        const auto views =
            rec::views_of_segments(shot.truth.scan.points, gnomon::segments(labels), near);
        return views.at(0).rest.band(0, rec::height_profile::count).points;
    };
    EXPECT_EQ(rest(), 0.0);
    for (int i = 0; i < 20; ++i) {
        shot.truth.scan.points.emplace_back(9.0, 0.05 * i, 0.5);
        labels.push_back(gnomon::unlabeled);
    }
    EXPECT_EQ(rest(), 0.0);
    shot.truth.scan.points.push_back(shot.truth.scan.points.front() +
                                     Eigen::Vector3d(0.0, 0.0, 0.05));
    labels.push_back(gnomon::unlabeled);
    EXPECT_EQ(rest(), 1.0);
}

TEST(views_of_segments, degenerate_scans_have_no_views) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (const std::size_t n : {0u, 1u, 3u, 200u}) {
        for (const double x : {nan, 1.0}) {
            const std::vector<Eigen::Vector3d> points(n, Eigen::Vector3d(x, 1.0, 1.0));
            const gnomon::segments whole(std::vector<std::int32_t>(n, 0));
            EXPECT_TRUE(rec::views_of_segments(points, whole, of_one_object).empty());
            EXPECT_TRUE(rec::views_of_segments(points, whole).empty());
        }
    }
    const std::vector<Eigen::Vector3d> points(100, Eigen::Vector3d(1, 2, 3));
    const gnomon::segments none(std::vector<std::int32_t>(100, gnomon::unlabeled)), too_few;
    EXPECT_TRUE(rec::views_of_segments(points, none, of_one_object).empty());
    EXPECT_THROW(static_cast<void>(rec::views_of_segments(points, too_few, of_one_object)),
                 std::invalid_argument);
    EXPECT_THROW(static_cast<void>(rec::views_of_segments(points, none, {.gap = -1.0})),
                 std::invalid_argument);
}

}  // namespace
