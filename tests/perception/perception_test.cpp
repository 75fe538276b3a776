// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/partitions.hpp"
#include <gnomon/core/angle.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/supervised.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/filters/crop_height.hpp>
#include <gnomon/neighborhoods/radius.hpp>
#include <gnomon/perception.hpp>
#include <gnomon/simulation/simulate.hpp>
#include <gnomon/simulation/spinning_lidar.hpp>
#include <gnomon/simulation/street.hpp>
#include <gnomon/simulation/thesis_scenes.hpp>
#include <gnomon/simulation/trajectory.hpp>

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

using thesis_chain =
    perception<gnomon::knn, gnomon::plane_pca, gnomon::conservative, gnomon::smooth_surfaces>;

const gnomon::noise_curve noise_of_kitchen = gnomon::constant_noise{0.015};

TEST(perception, is_its_steps) {
    const gnomon::scan& scan = scan_of_kitchen();
    const thesis_chain chain{.noise = noise_of_kitchen, .leave_out = gnomon::floor_and_ceiling{}};
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
    const auto merged = gnomon::merge_occluded(rest, parts, gnomon::visibility(scan));
    const gnomon::segments& whole = merged.segments;
    const auto planes = gnomon::estimate_planes(rest, whole, noise_of_kitchen);

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
    ASSERT_EQ(result.gaps.size(), merged.gaps.size());
    for (std::size_t g = 0; g < merged.gaps.size(); ++g) {
        ASSERT_EQ(result.gaps[g].merged, merged.gaps[g].merged);
        for (std::size_t l = 0; l < merged.gaps[g].lines.size(); ++l)
            ASSERT_EQ(result.gaps[g].lines[l].first, kept[merged.gaps[g].lines[l].first]);
    }
    ASSERT_EQ(result.planes.size(), planes.size());
    for (std::size_t s = 0; s < planes.size(); ++s) {
        ASSERT_EQ(result.planes[s].plane.normal, planes[s].plane.normal);
        ASSERT_EQ(result.planes[s].is_flat, planes[s].is_flat);
    }
    EXPECT_LT(result.surfaces.size(), result.initial_segments.size());
    EXPECT_GT(result.seconds(), 0.0);
}

/// The planes of the surfaces are those of their points, most of which are flat.
TEST(perception, finds_planes_on_cells) {
    const gnomon::scan& scan = scan_of_kitchen();
    const perception<> chain{.leave_out = gnomon::floor_and_ceiling{}};
    const auto result = chain(scan, gnomon::threads{2});
    EXPECT_FALSE(result.noise.is_across_surface) << result.noise.reason;
    EXPECT_NEAR(result.noise.curve(2.0), 0.015, 0.0015);
    EXPECT_LT(result.surfaces.size(), result.initial_segments.size());
    const auto planes =
        gnomon::estimate_planes(scan, result.surfaces, result.noise.of_planes, gnomon::threads{2});
    ASSERT_EQ(result.planes.size(), result.surfaces.size());
    std::size_t flat = 0;
    for (std::size_t s = 0; s < planes.size(); ++s) {
        EXPECT_NEAR(result.planes[s].chi2, planes[s].chi2, 1e-6 * planes[s].chi2);
        EXPECT_EQ(result.planes[s].is_flat, planes[s].is_flat);
        flat += planes[s].is_flat ? result.surfaces[s].size() : 0;
    }
    EXPECT_GT(static_cast<double>(flat), 0.7 * static_cast<double>(result.kept.size()));
    for (const auto& gap : result.gaps)
        for (const auto& line : gap.lines) {
            EXPECT_LT(line.first, scan.size());
            const auto labels = [&](const gnomon::segments& of) {
                return of.labels()[line.first] == of.labels()[line.second];
            };
            EXPECT_TRUE(!gap.merged || labels(result.surfaces));
        }
}

TEST(perception, is_the_same_for_every_execution) {
    const gnomon::scan& scan = scan_of_kitchen();
    const perception<> chain;
    const auto expected = chain(scan);
    for (const unsigned t : {1u, 3u}) {
        const auto result = chain(scan, gnomon::threads{t});
        EXPECT_EQ(result.surfaces, expected.surfaces);
        EXPECT_EQ(result.noise.curve(3.0), expected.noise.curve(3.0));
        for (std::size_t s = 0; s < expected.planes.size(); ++s)
            EXPECT_EQ(result.planes[s].plane.normal, expected.planes[s].plane.normal);
    }
}

/// The scan with its points in another order, and where each was.
gnomon::scan shuffled(const gnomon::scan& scan, std::uint64_t seed,
                      std::vector<std::size_t>& order) {
    gnomon::scan result;
    result.points = clouds::permuted(scan.points, seed, order);
    std::vector<Eigen::Vector3d> viewpoints;
    for (const std::size_t i : order) viewpoints.push_back(scan.viewpoints[i]);
    result.viewpoints = gnomon::viewpoint_table(viewpoints);
    return result;
}

/// No step draws points by where they are stored, or lets those that come first win.
TEST(perception, depends_on_no_order_of_points) {
    const gnomon::scan& scan = scan_of_kitchen();
    const auto expect_same = [&](const auto& chain, double likeness) {
        const auto expected = chain(scan);
        for (std::uint64_t seed = 1; seed <= 2; ++seed) {
            std::vector<std::size_t> order;
            const auto result = chain(shuffled(scan, seed, order));
            std::vector<std::int32_t> labels;
            for (const std::size_t i : order) labels.push_back(expected.surfaces.labels()[i]);
            EXPECT_GE(laws::rand_index(result.surfaces.labels(), labels), likeness);
        }
    };
    expect_same(thesis_chain{.noise = noise_of_kitchen, .leave_out = gnomon::floor_and_ceiling{}},
                1.0);
    expect_same(perception<>{.noise = noise_of_kitchen}, 0.999);
}

TEST(perception, does_not_merge_if_merging_is_disabled) {
    const perception chain{gnomon::noise_knn{}, gnomon::plane_pca{}, gnomon::no_merging{},
                           gnomon::planes_on_cells{{.max_angle = gnomon::degrees(10)}}};
    const auto result = chain(scan_of_kitchen(), gnomon::threads{2});
    EXPECT_EQ(result.surfaces.labels(), result.initial_segments.labels());
    EXPECT_TRUE(result.gaps.empty());
    for (const auto& step : result.steps) EXPECT_NE(step.name, "merging");
    EXPECT_EQ(result.kept.size(), scan_of_kitchen().size());
    EXPECT_FALSE(result.floor || result.ceiling);
}

/// Scans from two places, moved into one frame, as if seen from its origin: rays are not known, so
/// that nothing is behind anything.
TEST(perception, merges_nothing_without_rays) {
    namespace sim = gnomon::simulation;
    const sim::scene kitchen = sim::scenes::kitchen();
    gnomon::scan fused;
    for (const double y : {-0.6, 0.6}) {
        sim::pose mount = kitchen.sensor;
        mount.position.y() += y;
        const auto seen = sim::simulate(kitchen, sim::rotational{.mount = mount},
                                        sim::densities::medium(), {.sigma = 0.015, .seed = 4});
        for (const Eigen::Vector3d& p : seen.scan.points)
            fused.points.push_back(p - Eigen::Vector3d(20.0, 20.0, 0.0));
    }
    const auto result = perception<>{}(fused, gnomon::threads{2});
    EXPECT_TRUE(result.noise.is_across_surface);
    EXPECT_FALSE(result.noise.reason.empty());
    EXPECT_TRUE(result.gaps.empty());
    EXPECT_EQ(result.surfaces, result.initial_segments);
    EXPECT_GT(result.surfaces.size(), 5u);
}

/// Where there are too few points to measure noise.
TEST(perception, normals_face_the_view_point_without_noise_along_the_rays) {
    clouds::cloud points;
    for (int i = 0; i < 400; ++i) points.emplace_back(0.02 * (i % 20), 0.02 * (i / 20), 1.0);
    points.emplace_back(clouds::nan, 0.0, 0.0);
    for (const double z : {3.0, -3.0}) {
        const auto result =
            perception<>{}(gnomon::with_viewpoint(points, Eigen::Vector3d(0.2, 0.2, z)));
        ASSERT_TRUE(result.noise.is_across_surface);
        EXPECT_EQ(result.surface[0].normal.z(), z > 0.0 ? 1.0 : -1.0);
        EXPECT_EQ(result.surface.back().trust, gnomon::trust::not_finite);
    }
}

/// Floats are half a metre apart at map coordinates: what they rounded away is noise, and named.
TEST(perception, names_the_rounding_of_coordinates) {
    std::vector<Eigen::Vector3f> floats;
    clouds::cloud doubles;
    for (int i = 0; i < 10'000; ++i) {
        const Eigen::Vector3d p(650'000.0 + 0.02 * (i % 100), 5'300'000.0 + 0.02 * (i / 100), 2.0);
        doubles.push_back(p);
        floats.push_back(p.cast<float>());
    }
    const auto rounded = perception<>{}(floats).noise;
    EXPECT_NEAR(rounded.curve(1.0), 0.5 / std::sqrt(12.0), 0.05);
    EXPECT_NE(rounded.reason.find("rounded"), std::string_view::npos);
    const auto exact = perception<>{}(doubles).noise;
    EXPECT_LT(exact.curve(1.0), 1e-8);
    EXPECT_EQ(exact.reason.find("rounded"), std::string_view::npos);
}

/// The lines of a spinning lidar are far apart, and the road is not seen below it.
TEST(perception, finds_one_road_by_a_spinning_lidar) {
    namespace sim = gnomon::simulation;
    const sim::scene street = sim::scenes::street({.seed = 20'001});
    const std::int32_t road = street.find_surface("road/body/plane");
    for (const double speed : {0.0, 15.0}) {
        const sim::spinning_lidar lidar =
            speed > 0.0 ? sim::scanners::velodyne_hdl_32e() : sim::scanners::velodyne_vlp_16();
        const sim::driving car{.mount = street.sensor,
                               .duration = lidar.revolution(),
                               .velocity = Eigen::Vector3d(speed, 0.0, 0.0)};
        const auto seen = sim::simulate(street, car, lidar, {.sigma = 0.02, .seed = 1});
        const auto result = perception<>{}(seen.scan, gnomon::threads{2});
        std::vector<std::size_t> count(result.surfaces.size(), 0);
        std::size_t points = 0;
        for (std::size_t i = 0; i < seen.scan.size(); ++i) {
            if (seen.surfaces[i] != road) continue;
            ++points;
            const std::int32_t label = result.surfaces.labels()[i];
            if (label != gnomon::unlabeled) ++count[static_cast<std::size_t>(label)];
        }
        EXPECT_GT(*std::max_element(count.begin(), count.end()), points * 98 / 100);
    }
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
        [](gnomon::observation s) { return s == gnomon::observation::unobserved; },
        gnomon::smooth_surfaces{}, gnomon::constant_noise{0.005}};
    const auto result = chain(hits, gnomon::sequential{}, &hit::at);
    EXPECT_EQ(result.initial_segments.size(), 2u);
    EXPECT_EQ(result.surfaces.size(), 1u);
    EXPECT_EQ(result.surface[0].normal, Eigen::Vector3d(-1, 0, 0));

    const auto seen_from = gnomon::with_viewpoint(points, Eigen::Vector3d(4.0, 0.3, 0.2));
    EXPECT_EQ(chain(seen_from).surface[0].normal, Eigen::Vector3d(1, 0, 0));
}

TEST(perception, survives_clouds_of_nothing) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const perception<> above_floor{.leave_out = gnomon::floor_and_ceiling{}}, all{};
    for (const std::size_t n : {0u, 1u, 3u, 100u}) {
        const std::vector<Eigen::Vector3d> nothing(n, Eigen::Vector3d(nan, 0, 0));
        const std::vector<Eigen::Vector3d> one_place(n, Eigen::Vector3d(1, 2, 3));
        for (const auto& points : {nothing, one_place, clouds::in_cube(n, 1)}) {
            for (const auto* chain : {&above_floor, &all}) {
                const auto result = (*chain)(points);
                EXPECT_EQ(result.surface.size(), n);
                EXPECT_EQ(result.surfaces.labels().size(), n);
                EXPECT_EQ(result.surfaces.size(), 0u);
                EXPECT_TRUE(result.noise.is_across_surface);
                EXPECT_FALSE(result.noise.reason.empty());
            }
        }
    }
    for (const auto& [name, points] : clouds::degenerate()) {
        SCOPED_TRACE(name);
        EXPECT_EQ(all(points).surfaces.labels().size(), points.size());
        EXPECT_EQ(thesis_chain{}(points).surfaces.labels().size(), points.size());
    }
}

/// As many view points as points, and a segment for every three.
TEST(perception, finishes_with_a_view_point_for_each_point) {
    gnomon::random_stream random(1);
    std::vector<Eigen::Vector3d> points, eyes;
    std::vector<std::int32_t> labels;
    for (std::int32_t i = 0; i < 500; ++i) {
        points.emplace_back(3.0, random.uniform(), random.uniform());
        eyes.push_back(clouds::gaussian_vector(random));
        labels.push_back(i % 150);
    }
    const auto seen = gnomon::with_viewpoints(points, gnomon::viewpoint_table(eyes));
    const gnomon::visibility visible(seen);
    EXPECT_GT(visible.images().size(), 400u);
    const auto merged = gnomon::merge_occluded(seen, gnomon::segments(labels), visible);
    EXPECT_LE(merged.segments.size(), 150u);
    EXPECT_EQ(perception<>{}(seen).surfaces.labels().size(), 500u);
}

/// A table of view points covers the points, whether or not they are finite.
TEST(perception, finds_the_view_points_of_clouds_with_points_that_are_not_finite) {
    const Eigen::Vector3d nowhere(clouds::nan, 0, 0);
    const std::vector<Eigen::Vector3d> one_eye(1, Eigen::Vector3d(0, 0, 2));
    const auto labels_of = [](const std::vector<Eigen::Vector3d>& points, auto table) {
        return perception<>{}(gnomon::with_viewpoints(points, table)).surfaces.labels().size();
    };
    EXPECT_EQ(labels_of({nowhere}, gnomon::viewpoint_table(one_eye)), 1u);
    auto points = clouds::sheet(500, 1);
    points.push_back(nowhere);
    const std::vector<gnomon::point_index> of_one_scan(points.size(), 0);
    EXPECT_EQ(labels_of(points, gnomon::viewpoint_table(one_eye, of_one_scan)), points.size());
}

/// Also where they are so far that squares overflow.
TEST(perception, refuses_view_points_that_are_not_finite) {
    const auto points = clouds::sheet(500, 1);
    for (const double bad : {clouds::nan, std::numeric_limits<double>::infinity(), 1e200}) {
        const auto seen = gnomon::with_viewpoint(points, Eigen::Vector3d(0, bad, 2));
        EXPECT_THROW((void)perception<>{}(seen), std::invalid_argument) << bad;
        const perception<> camera{
            .noise = {{gnomon::constant_noise{0.01}, Eigen::Vector3d(0, 0, 1)}}};
        EXPECT_THROW((void)camera(seen), std::invalid_argument) << bad;
    }
}

/// Before the first step: who follows the progress hears of none.
TEST(perception, refuses_bad_parameters_before_the_first_step) {
    const std::vector<Eigen::Vector3d> points(100, Eigen::Vector3d(1, 2, 3));
    const auto refused = [&](const auto& chain) {
        std::size_t steps = 0;
        const auto on_step = [&](const char*, std::size_t, std::size_t) { ++steps; };
        EXPECT_THROW((void)chain(points, gnomon::supervised(gnomon::sequential{}, {}, on_step)),
                     std::invalid_argument);
        EXPECT_EQ(steps, 0u);
    };
    refused(perception<>{.neighborhood = {.k = 0}});
    refused(perception<>{.neighborhood = {.deviations = -1.0}});
    refused(perception{gnomon::knn{.k = 0}, gnomon::plane_pca{}});
    refused(perception{gnomon::radius{.r = -1.0}, gnomon::plane_pca{}});
    refused(perception<>{.merging = {.max_gap = -0.1}});
    refused(perception<>{.merging = {.max_offset = clouds::nan}});
    refused(perception<>{.merging = {.boundary_pairs = 3}});
    refused(perception<>{.merging = {.boundary_pairs = 0}});
    refused(perception<>{.visibility = {.pixel = gnomon::degrees(100)}});
    refused(perception<>{.visibility = {.pole = Eigen::Vector3d(0, 0, 0)}});
    refused(perception<>{.segmentation = {.planes = {.max_angle = gnomon::degrees(120)}}});
    refused(thesis_chain{.segmentation = {.surfaces = {.max_distance = -1.0}}});
    refused(perception<>{.leave_out = gnomon::floor_and_ceiling{.up = Eigen::Vector3d(0, 0, 2)}});
    refused(perception<>{.leave_out = gnomon::floor_and_ceiling{.bands = {.floor = clouds::nan}}});
}

}  // namespace
