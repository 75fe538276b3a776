// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <span>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/descriptor_laws.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/features/describe_points.hpp>
#include <gnomon/features/harmonic_shape_context.hpp>
#include <gnomon/features/shape_context.hpp>
#include <gnomon/features/spin_image.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/orient.hpp>

namespace {

using gnomon::describe_points, gnomon::point_index, gnomon::spin_image, gnomon::trust;
using laws::described_normal, laws::described_sheet;

/// A user's own: how many neighbors are above the tangent plane, and how many there are.
struct count_above {
    double radius = 0.1;

    double support_radius() const { return radius; }
    static std::size_t dimension() { return 2; }
    static double distance(std::span<const float> a, std::span<const float> b) {
        return std::abs(a[0] - b[0]);
    }
    trust operator()(const Eigen::Vector3d& p, const Eigen::Vector3d& normal,
                     gnomon::neighborhood_view neighbors, std::span<double> row) const {
        for (const Eigen::Vector3d& q : neighbors) row[0] += normal.dot(q - p) > 0.0 ? 1.0 : 0.0;
        row[1] = static_cast<double>(neighbors.size());
        return trust::good;
    }
};
static_assert(gnomon::descriptor<count_above>);

TEST(describe_points, shows_the_other_points_within_the_radius) {
    const described_sheet sheet(500, 2);
    const auto rows = describe_points(sheet.points, sheet.surface, count_above{});
    ASSERT_EQ(rows.size(), 500u);
    for (std::size_t i = 0; i < 500; ++i) {
        double above = 0.0, all = 0.0;
        for (std::size_t j = 0; j < 500; ++j) {
            const Eigen::Vector3d d = sheet.points[j] - sheet.points[i];
            if (j == i || d.norm() > 0.1) continue;
            ++all;
            above += sheet.surface[i].normal.dot(d) > 0.0 ? 1.0 : 0.0;
        }
        ASSERT_EQ(rows[i][0], above);
        ASSERT_EQ(rows[i][1], all);
        ASSERT_EQ(rows.trust[i], trust::good);
    }
}

/// The same rows for some points, in their order, also for those that are listed twice.
TEST(describe_points, describes_some_points) {
    const described_sheet sheet(2000, 3);
    const gnomon::spatial_index index(sheet.points);
    const std::vector<point_index> keypoints{1999, 7, 7, 0, 512, 7, 1024};
    const auto compare = [&](const auto& describe) {
        const auto all = describe_points(index, sheet.surface, describe);
        const auto some =
            describe_points(index, sheet.surface, keypoints, describe, gnomon::threads{2});
        ASSERT_EQ(some.size(), keypoints.size());
        for (std::size_t r = 0; r < keypoints.size(); ++r) {
            ASSERT_LT(laws::share_that_differs(some[r], all[keypoints[r]]), 1e-6);
            ASSERT_EQ(some.trust[r], all.trust[keypoints[r]]);
        }
    };
    compare(count_above{});
    compare(spin_image{.interpolate = true});
    compare(gnomon::angular_spin_image{});
    compare(gnomon::shape_context{.inner_radius = 0.01, .radial_bins = 3, .density_radius = 0.02});
    compare(gnomon::harmonic_shape_context{});
    EXPECT_EQ(
        describe_points(index, sheet.surface, std::vector<point_index>{}, count_above{}).size(),
        0u);
}

/// Where three surfaces meet, the image is another one than on a surface; and alike in a moved
/// copy.
TEST(describe_points, distinguishes_places) {
    clouds::cloud points{{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0.6, 0}};
    gnomon::random_stream random(9);
    for (int i = 0; i < 6000; ++i) {
        Eigen::Vector3d p(random.uniform(), random.uniform(), random.uniform());
        p[i % 3] = 0.002 * random.gaussian();
        points.push_back(p);
    }
    const std::vector<point_index> keypoints{0, 1, 2};
    // [describe]
    const gnomon::spatial_index index(points);
    auto surface = gnomon::estimate_normals(index, gnomon::knn{.k = 30});
    gnomon::orient_normals(gnomon::with_viewpoint(points, {1, 1, 1}), surface);

    const gnomon::spin_image describe{.radius = 0.2, .height = 0.2};
    const gnomon::point_descriptors rows =
        gnomon::describe_points(index, surface, keypoints, describe);
    const double to_corner = describe.distance(rows[0], rows[1]);
    const double on_floor = describe.distance(rows[1], rows[2]);
    // [describe]
    EXPECT_LT(on_floor, 0.1);
    EXPECT_GT(to_corner, 2.0 * on_floor);
}

TEST(describe_points, reads_any_container) {
    struct laser_return {
        double time;
        Eigen::Vector3d xyz;
    };
    const described_sheet sheet(300, 4);
    std::deque<laser_return> returns;
    for (const auto& p : sheet.points) returns.push_back({0.0, p});
    const std::vector<point_index> some{3, 1};
    const auto expected = describe_points(sheet.points, sheet.surface, spin_image{});
    const auto all = describe_points(returns, sheet.surface, spin_image{}, gnomon::sequential{},
                                     &laser_return::xyz);
    EXPECT_EQ(all.values, expected.values);
    const auto two = describe_points(returns, sheet.surface, some, spin_image{},
                                     gnomon::sequential{}, &laser_return::xyz);
    EXPECT_EQ(laws::share_that_differs(two[0], expected[3]), 0.0);
}

/// Surface elements pass on their trust, and the descriptor its own.
TEST(describe_points, has_a_trust_for_each_point) {
    auto points = clouds::sheet(100, 5);
    points[2] = {clouds::nan, 0, 0};
    points[4] = {50, 50, 50};  // without neighbors
    auto surface = gnomon::estimate_normals(points, gnomon::knn{10});
    for (auto& s : surface)
        if (gnomon::usable(s.trust)) s.trust = trust::good;
    surface[6].trust = trust::weak;
    surface[8].trust = trust::degenerate;
    surface[8].normal.setZero();
    surface[10].normal = {clouds::nan, 0, 1};
    surface[12].normal.setZero();  // in contradiction to its trust
    surface[14].normal *= 1e200;   // of any length
    const auto rows = describe_points(points, surface, spin_image{.radius = 0.3, .height = 0.3});
    EXPECT_EQ(rows.trust[2], trust::not_finite);
    EXPECT_EQ(rows.trust[4], trust::too_few_neighbors);
    EXPECT_EQ(rows.trust[6], trust::weak);
    EXPECT_EQ(rows.trust[8], trust::degenerate);
    EXPECT_EQ(rows.trust[10], trust::not_finite);
    EXPECT_EQ(rows.trust[12], trust::degenerate);
    EXPECT_EQ(rows.trust[14], trust::good);
    EXPECT_EQ(rows.trust[1], trust::good);
    for (const std::size_t i : {2u, 4u, 8u, 10u, 12u})
        for (const float entry : rows[i]) EXPECT_EQ(entry, 0.0f);
    for (const std::size_t i : {6u, 14u})
        EXPECT_NE(*std::max_element(rows[i].begin(), rows[i].end()), 0.0f);

    const std::vector<described_normal> bare(100, {{0, 0, 0}});
    EXPECT_EQ(describe_points(points, bare, count_above{}).trust[0], trust::degenerate);
}

/// What a user's own descriptor returns is checked, and rows are zero before, whatever it returned
/// for other points.
TEST(describe_points, enforces_the_laws) {
    struct bad_entries : count_above {
        static std::size_t dimension() { return 10; }
        trust operator()(const Eigen::Vector3d& p, const Eigen::Vector3d&,
                         gnomon::neighborhood_view, std::span<double> row) const {
            row[0] += 7.0;
            row[1] += p.x() > 0.5 ? clouds::nan : 1.0;
            row[9] += 5.0;
            return p.y() > 0.5 ? trust::too_few_neighbors : trust::good;
        }
    };
    const described_sheet sheet(200, 6);
    const auto rows = describe_points(sheet.points, sheet.surface, bad_entries{});
    for (std::size_t i = 0; i < 200; ++i) {
        const Eigen::Vector3d& p = sheet.points[i];
        const trust expected = p.y() > 0.5   ? trust::too_few_neighbors
                               : p.x() > 0.5 ? trust::not_finite
                                             : trust::good;
        ASSERT_EQ(rows.trust[i], expected);
        ASSERT_EQ(rows[i][0], expected == trust::good ? 7.0 : 0.0);
        ASSERT_EQ(rows[i][9], expected == trust::good ? 5.0 : 0.0);
    }
}

/// Duplicates are neighbors of each other at distance zero; a huge radius shows all points.
TEST(describe_points, takes_duplicates_and_any_radius) {
    clouds::cloud points(40, {4e5, 5e6, 100.0});
    points.push_back({4e5 + 1, 5e6, 100.0});
    const std::vector<described_normal> surface(points.size(), {{0, 0, 1}});
    for (const double radius : {0.0, 1e-9, 0.5}) {
        const auto rows = describe_points(points, surface, count_above{radius});
        EXPECT_EQ(rows[0][1], 39.0);
        EXPECT_EQ(rows[40][1], 0.0);
    }
    for (const double radius : {10.0, 1e10, 1e160, 1e300})
        EXPECT_EQ(describe_points(points, surface, count_above{radius})[40][1], 40.0);
    const auto images =
        describe_points(points, surface, spin_image{.radial_bins = 2, .axial_bins = 1});
    EXPECT_EQ(images[0][0], 39.0);
    EXPECT_EQ(images.trust[40], trust::too_few_neighbors);
}

TEST(describe_points, rejects_bad_arguments) {
    const described_sheet sheet(20, 7);
    const described_sheet more(21, 7);
    const auto refused = [](const auto&... arguments) {
        EXPECT_THROW((void)describe_points(arguments...), std::invalid_argument);
    };
    refused(sheet.points, more.surface, count_above{});
    refused(sheet.points, sheet.surface, std::vector<point_index>{20}, count_above{});
    for (const double bad : {-1.0, clouds::nan, clouds::infinity})
        refused(sheet.points, sheet.surface, count_above{bad});
    refused(sheet.points, sheet.surface, spin_image{.radius = 0.0});
    const clouds::cloud no_points;
    const std::vector<described_normal> no_surface;
    refused(no_points, no_surface, spin_image{.radius = -1.0});
    EXPECT_EQ(describe_points(no_points, no_surface, spin_image{}).size(), 0u);
}

TEST(describe_points, obeys_the_laws_with_own_descriptors) { laws::descriptor_laws(count_above{}); }

}  // namespace
