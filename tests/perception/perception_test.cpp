// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/partitions.hpp"
#include <gnomon/core/angle.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/neighborhoods/radius.hpp>
#include <gnomon/perception.hpp>
#include <gnomon/simulation/simulate.hpp>
#include <gnomon/simulation/thesis_scenes.hpp>

namespace {

using gnomon::perception, gnomon::point_index;

const gnomon::scan& scan_of_kitchen() {
    static const gnomon::scan scan = [] {
        const gnomon::simulation::scene kitchen = gnomon::simulation::scenes::kitchen();
        const gnomon::simulation::rotational trajectory{.mount = kitchen.sensor};
        return gnomon::simulation::simulate(kitchen, trajectory, {}, {.sigma = 0.015, .seed = 3})
            .scan;
    }();
    return scan;
}

TEST(perception, is_its_steps) {
    const gnomon::scan& scan = scan_of_kitchen();
    const perception<> chain{.leave_out = gnomon::floor_and_ceiling{}};
    const auto result = chain(scan, gnomon::threads{2});

    const auto floor = gnomon::find_floor(scan);
    const auto ceiling = gnomon::find_ceiling(scan, floor.value());
    const auto kept = gnomon::crop_height(scan, *floor, ceiling);
    ASSERT_EQ(result.kept, kept);
    EXPECT_TRUE(result.floor->normal == floor->normal && result.ceiling == ceiling);
    const gnomon::subset_view rest(scan, kept);
    auto surface = gnomon::estimate_normals(rest, gnomon::knn{}, gnomon::plane_pca{});
    gnomon::repair_anisotropic(rest, gnomon::knn{}, surface, gnomon::plane_pca{});
    gnomon::orient_normals(rest, surface);
    const gnomon::segments parts = gnomon::segment_surfaces(rest, surface);
    const gnomon::visibility visible(scan);
    const auto merged = gnomon::merge_occluded(rest, surface, parts, visible);
    const auto released = gnomon::split_outliers(rest, surface, merged.segments);
    const auto again = gnomon::merge_occluded(rest, surface, released, visible);
    const gnomon::segments whole = gnomon::join_surfaces_of_revolution(
        rest, surface, gnomon::assign_unlabeled(rest, again.segments));
    EXPECT_LT(again.segments.size(), released.size());

    std::vector<bool> left_out(scan.size(), true);
    for (std::size_t i = 0; i < kept.size(); ++i) {
        left_out[kept[i]] = false;
        ASSERT_EQ(result.surface[kept[i]].normal, surface[i].normal);
        ASSERT_EQ(result.initial_segments.labels()[kept[i]], parts.labels()[i]);
        ASSERT_EQ(result.surfaces.labels()[kept[i]], whole.labels()[i]);
    }
    for (std::size_t i = 0; i < scan.size(); ++i) {
        if (!left_out[i]) continue;
        ASSERT_TRUE(result.surface[i].normal.isZero());
        ASSERT_EQ(result.initial_segments.labels()[i], gnomon::unlabeled);
        ASSERT_EQ(result.surfaces.labels()[i], gnomon::unlabeled);
    }
    std::vector<gnomon::considered_gap> gaps = merged.gaps;
    std::ranges::copy_if(again.gaps, std::back_inserter(gaps), &gnomon::considered_gap::merged);
    ASSERT_EQ(result.gaps.size(), gaps.size());
    for (std::size_t g = 0; g < gaps.size(); ++g) {
        ASSERT_EQ(result.gaps[g].merged, gaps[g].merged);
        for (std::size_t l = 0; l < gaps[g].lines.size(); ++l)
            ASSERT_EQ(result.gaps[g].lines[l].first, kept[gaps[g].lines[l].first]);
    }
    EXPECT_LT(result.surfaces.size(), result.initial_segments.size());
    EXPECT_GT(result.seconds.normals, 0.0);
    EXPECT_GT(result.seconds.merging, 0.0);
    EXPECT_GT(result.seconds.assignment, 0.0);
}

/// No step draws points by where they are stored, or lets those that come first win.
TEST(perception, depends_on_no_order_of_points) {
    const gnomon::scan& scan = scan_of_kitchen();
    const perception<> chain{.leave_out = gnomon::floor_and_ceiling{}};
    const auto expected = chain(scan);
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
        std::vector<std::size_t> order;
        gnomon::scan shuffled;
        shuffled.points = clouds::permuted(scan.points, seed, order);
        std::vector<Eigen::Vector3d> viewpoints;
        std::vector<std::int32_t> labels;
        for (const std::size_t i : order) {
            viewpoints.push_back(scan.viewpoints[i]);
            labels.push_back(expected.surfaces.labels()[i]);
        }
        shuffled.viewpoints = gnomon::viewpoint_table(viewpoints);
        const auto result = chain(shuffled);
        EXPECT_EQ(result.surfaces.size(), expected.surfaces.size());
        EXPECT_EQ(laws::rand_index(result.surfaces.labels(), labels), 1.0);
    }
}

TEST(perception, does_not_merge_if_merging_is_disabled) {
    perception chain{gnomon::knn{.k = 30},
                     gnomon::plane_pca{},
                     gnomon::no_merging{},
                     {.max_angle = gnomon::degrees(4)}};
    chain.splitting.reset();   // which may make new segments,
    chain.revolution.reset();  // and this fewer
    EXPECT_EQ(chain(scan_of_kitchen()).surfaces.size(),
              chain(scan_of_kitchen()).initial_segments.size());
    chain.assignment.reset();
    const auto result = chain(scan_of_kitchen(), gnomon::threads{2});
    EXPECT_EQ(result.surfaces.labels(), result.initial_segments.labels());
    EXPECT_TRUE(result.gaps.empty());
    EXPECT_EQ(result.seconds.merging, 0.0);
    EXPECT_EQ(result.kept.size(), scan_of_kitchen().size());
    EXPECT_FALSE(result.floor || result.ceiling);
}

struct hit {
    double time;
    Eigen::Vector3d at;
};

/// A policy that stores, an estimator that can do nothing but estimate, a policy of the user's, and
/// points that are members of something, seen from elsewhere.
TEST(perception, takes_any_policies_and_points) {
    std::vector<hit> hits;
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 60; ++i) {
        for (int j = 0; j < 40; ++j) {
            if (i > 28 && i < 32) continue;  // a gap, nothing seen in it
            points.emplace_back(2.0, 0.01 * i, 0.01 * j);
            hits.push_back({0.0, points.back()});
        }
    }
    const perception chain{
        gnomon::radius{.r = 0.025},
        [](const Eigen::Vector3d&, const auto&) { return Eigen::Vector3d(1, 0, 0); },
        [](gnomon::observation s) { return s == gnomon::observation::unobserved; }};
    const auto result = chain(hits, gnomon::sequential{}, &hit::at);
    EXPECT_EQ(result.initial_segments.size(), 2u);
    EXPECT_EQ(result.surfaces.size(), 1u);
    EXPECT_EQ(result.surface[0].normal, Eigen::Vector3d(-1, 0, 0));

    const auto seen_from = gnomon::with_viewpoint(points, Eigen::Vector3d(4.0, 0.3, 0.2));
    EXPECT_EQ(chain(seen_from).surface[0].normal, Eigen::Vector3d(1, 0, 0));
}

TEST(perception, survives_clouds_of_nothing) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const perception<> chain{.leave_out = gnomon::floor_and_ceiling{}};
    for (const std::size_t n : {0u, 1u, 3u, 100u}) {
        const std::vector<Eigen::Vector3d> nothing(n, Eigen::Vector3d(nan, 0, 0));
        const std::vector<Eigen::Vector3d> one_place(n, Eigen::Vector3d(1, 2, 3));
        for (const auto& points : {nothing, one_place}) {
            const auto result = chain(points);
            EXPECT_EQ(result.surface.size(), n);
            EXPECT_EQ(result.surfaces.labels().size(), n);
            EXPECT_EQ(result.surfaces.size(), 0u);
        }
    }
}

TEST(perception, passes_the_noise_to_all_steps) {
    perception<> chain = perception<>{}.with_sigma(0.002);
    for (const double sigma : {chain.merging.sigma, chain.visibility.sigma, chain.assignment->sigma,
                               chain.splitting->sigma, chain.revolution->sigma})
        EXPECT_EQ(sigma, 0.002);
    chain.assignment.reset();
    chain.splitting.reset();
    chain.revolution.reset();
    chain = chain.with_sigma(0.003);
    EXPECT_EQ(chain.merging.sigma, 0.003);
    EXPECT_FALSE(chain.assignment || chain.splitting || chain.revolution);
}

TEST(perception, rejects_what_its_steps_reject) {
    const std::vector<Eigen::Vector3d> points(100, Eigen::Vector3d(1, 2, 3));
    const auto refused = [&](const auto& chain) {
        EXPECT_THROW(static_cast<void>(chain(points)), std::invalid_argument);
    };
    refused(perception{gnomon::knn{.k = 0}, gnomon::plane_pca{}, gnomon::conservative{}});
    refused(perception<>{.segmentation = {.max_distance = -1.0}});
    refused(perception<>{.merging = {.boundary_pairs = 3}});
    refused(perception<>{.splitting = gnomon::split_outliers_options{.sigma = 0.0}});
    refused(perception<>{.assignment = gnomon::assign_unlabeled_options{.sigma = 0.0}});
    refused(perception<>{.revolution = gnomon::join_surfaces_of_revolution_options{.sigma = -1.0}});
    refused(perception<>{.visibility = {.sigma = -1.0}});
    refused(perception<>{.leave_out = gnomon::floor_and_ceiling{.up = Eigen::Vector3d(0, 0, 2)}});
}

}  // namespace
