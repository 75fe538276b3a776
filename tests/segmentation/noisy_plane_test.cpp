// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core/random.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/segmentation/detail/noisy_plane.hpp>

namespace {

using gnomon::detail::noisy_plane;

constexpr double sigma_of_ranges = 0.015;

noisy_plane plane_of(const auto& points) {
    std::vector<gnomon::point_index> all(points.size());
    std::iota(all.begin(), all.end(), gnomon::point_index{0});
    std::vector<gnomon::detail::observed_point> observed(points.size());
    return gnomon::detail::noisy_plane_of(gnomon::spatial_index(points), all, sigma_of_ranges,
                                          observed);
}

/// Points of the plane z = 0, 40 cm wide, 2 m in front of and below a sensor at `eye`, with noise
/// along the rays; a third as many of the front below it.
std::vector<Eigen::Vector3d> seat_with_front(const Eigen::Vector3d& eye, std::uint64_t seed) {
    gnomon::random_stream random(seed);
    std::vector<Eigen::Vector3d> points;
    const auto add = [&](const Eigen::Vector3d& p) {
        points.emplace_back(p + sigma_of_ranges * random.gaussian() * (p - eye).normalized());
    };
    for (int i = 0; i < 300; ++i) add({0.4 * random.uniform(), 0.4 * random.uniform(), 0.0});
    for (int i = 0; i < 100; ++i) add({0.0, 0.4 * random.uniform(), -0.04 * random.uniform()});
    return points;
}

/// Law: at oblique incidence a plane is found although a quarter of the points are outliers; the
/// least squares plane has a large error there.
TEST(noisy_plane, is_that_of_most_points) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const Eigen::Vector3d eye(-2.0, 0.2, 0.7);
        const auto points = seat_with_front(eye, seed);
        const noisy_plane found = plane_of(gnomon::with_viewpoint(points, eye));
        EXPECT_TRUE(found.is_flat());
        const Eigen::Vector3d corners[] = {{0, 0, 0}, {0.4, 0, 0}, {0, 0.4, 0}, {0.4, 0.4, 0}};
        for (const Eigen::Vector3d& p : corners)
            EXPECT_LT(std::abs(found.distance(p)), 0.25 * sigma_of_ranges) << seed;
        const auto frame = gnomon::principal_frame_of(points);
        double worst = 0.0;
        for (const Eigen::Vector3d& p : corners)
            worst = std::max(worst, std::abs(frame.normal().dot(p - frame.centroid)));
        EXPECT_GT(worst, 0.5 * sigma_of_ranges) << seed;
    }
}

TEST(noisy_plane, noise_across_it_is_smaller_at_oblique_incidence) {
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 100; ++i) points.emplace_back(0.1 * (i % 10), 0.1 * (i / 10), 0.0);
    const noisy_plane of = plane_of(points);
    const Eigen::Vector3d p(1.0, 1.0, 0.0);
    EXPECT_NEAR(of.deviation_at(p, {1.0, 1.0, 3.0}), sigma_of_ranges, 1e-12);
    EXPECT_NEAR(of.deviation_at(p, {1.0 - std::sqrt(3.0), 1.0, -1.0}), sigma_of_ranges / 2.0,
                1e-12);
    EXPECT_NEAR(of.deviation_at(p, {-5.0, 1.0, 0.1}), sigma_of_ranges / 3.0, 1e-12);
    EXPECT_NEAR(of.deviation_at(p, p), sigma_of_ranges, 1e-12) << "no ray";
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NEAR(of.deviation_at(p, {nan, nan, nan}), sigma_of_ranges, 1e-12) << "not known";
}

TEST(noisy_plane, viewpoint_of_a_bare_range_is_not_known) {
    EXPECT_TRUE(std::isnan(gnomon::detail::known_viewpoint({}, 3).x()));
    const Eigen::Vector3d eye(1, 2, 3);
    EXPECT_EQ(gnomon::detail::known_viewpoint(eye, 3), eye);
}

/// Far from the origin nothing is lost.
TEST(noisy_plane, is_the_same_at_utm_coordinates) {
    const Eigen::Vector3d eye(-2.0, 0.2, 0.7), far(690'000.0, 5'335'000.0, 500.0);
    auto points = seat_with_front(eye, 1);
    const noisy_plane here = plane_of(gnomon::with_viewpoint(points, eye));
    for (Eigen::Vector3d& p : points) p += far;
    const noisy_plane there = plane_of(gnomon::with_viewpoint(points, eye + far));
    for (const Eigen::Vector3d& p : points)
        EXPECT_NEAR(there.distance(p), here.distance(p - far), 1e-7);
}

TEST(noisy_plane, thick_and_empty_point_sets_are_not_flat) {
    gnomon::random_stream random(1);
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 500; ++i)
        points.emplace_back(random.uniform(), random.uniform(), 0.2 * random.uniform());
    EXPECT_FALSE(plane_of(points).is_flat());
    points.resize(2);
    EXPECT_FALSE(plane_of(points).is_flat());
    points.clear();
    EXPECT_FALSE(plane_of(points).is_flat());
    EXPECT_FALSE(noisy_plane().is_flat());
}

/// Collinear, coincident and non-finite points have no plane; nor has a strip that is narrower than
/// the noise.
TEST(noisy_plane, degenerate_point_sets_are_not_flat) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<Eigen::Vector3d> holes(10, {nan, nan, nan}), one_place(10, {1, 2, 3});
    EXPECT_FALSE(plane_of(holes).is_flat());
    EXPECT_FALSE(plane_of(one_place).is_flat());
    std::vector<Eigen::Vector3d> line, strip;
    for (int i = 0; i < 100; ++i) {
        line.emplace_back(0.01 * i, 0.02 * i, 0.0);
        strip.emplace_back(0.01 * i, 0.01 * (i % 3), 0.0);
    }
    EXPECT_FALSE(plane_of(line).is_flat());
    EXPECT_FALSE(plane_of(strip).is_flat());
    line.resize(2);
    line.emplace_back(0.0, nan, 0.0);
    EXPECT_FALSE(plane_of(line).is_flat());
}

/// Points that are not finite do not count.
TEST(noisy_plane, survives_holes) {
    const Eigen::Vector3d eye(-2.0, 0.2, 0.7);
    auto points = seat_with_front(eye, 2);
    const noisy_plane whole = plane_of(gnomon::with_viewpoint(points, eye));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    points.insert(points.begin() + 5, 40, Eigen::Vector3d(0.1, nan, 0.1));
    const noisy_plane with_holes = plane_of(gnomon::with_viewpoint(points, eye));
    EXPECT_TRUE(with_holes.is_flat());
    EXPECT_NEAR(with_holes.distance({0.2, 0.2, 0.0}), whole.distance({0.2, 0.2, 0.0}), 1e-12);
}

}  // namespace
