// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/features/zernike_descriptor.hpp>

namespace {

using gnomon::trust, gnomon::zernike_descriptor;

/// The points of a grid, `steps` along each edge of the cube of side 2, that are in a solid, turned
/// and moved.
clouds::cloud filled_solid(auto&& contains, int steps, const Eigen::Matrix3d& r,
                           const Eigen::Vector3d& t) {
    clouds::cloud points;
    const auto at = [steps](int i) { return (2.0 * i + 1.0) / steps - 1.0; };
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j)
            for (int k = 0; k < steps; ++k)
                if (const Eigen::Vector3d p(at(i), at(j), at(k)); contains(p))
                    points.push_back(r * p + t);
    return points;
}

bool in_ball(const Eigen::Vector3d& p) { return p.norm() <= 0.95; }
bool in_box(const Eigen::Vector3d& p) {
    return std::abs(p.x()) < 0.9 && std::abs(p.y()) < 0.6 && std::abs(p.z()) < 0.35;
}
/// A seat with a back.
bool in_chair(const Eigen::Vector3d& p) {
    if (std::abs(p.y()) > 0.5) return false;
    return (std::abs(p.x()) < 0.5 && std::abs(p.z()) < 0.15) ||
           (p.x() > 0.25 && p.x() < 0.5 && p.z() > -0.15 && p.z() < 0.9);
}

double share_of_values(const zernike_descriptor& a, const zernike_descriptor& b) {
    double squares = 0.0;
    for (const double v : a.values) squares += v * v;
    return a.distance(b) / std::sqrt(squares);
}

TEST(zernike_descriptor, has_twelve_values_to_order_five) {
    const auto d = zernike_descriptor::of(clouds::in_cube(100, 1));
    EXPECT_EQ(d.values.size(), 12u);
    EXPECT_EQ(d.trust, trust::good);
    EXPECT_NEAR(d.values[1], 0.0, 1e-12);  // F_11 about the centroid
    EXPECT_EQ(zernike_descriptor::of(clouds::in_cube(100, 1), {.order = 20}).values.size(), 121u);
}

/// The basis is orthonormal: the moments of a filled ball are those of the constant function alone.
TEST(zernike_descriptor, of_a_ball_is_one_moment) {
    const auto points = filled_solid(in_ball, 60, Eigen::Matrix3d::Identity(), {5, 6, 7});
    const auto d = zernike_descriptor::of(points, {.order = 8, .enclose = true});
    EXPECT_NEAR(d.values[0], 1.0, 1e-10);
    for (std::size_t i = 1; i < d.values.size(); ++i) EXPECT_NEAR(d.values[i], 0.0, 0.04);
    EXPECT_NEAR(d.radius, 0.95, 0.01);
    EXPECT_LT((d.center - Eigen::Vector3d(5, 6, 7)).norm(), 1e-12);
    const auto v = zernike_descriptor::of(points, {.voxels = 50, .enclose = true});
    EXPECT_NEAR(v.values[0], 1.0, 0.05);
}

/// F_20 and F_22 of two masses at -1 and 1 on an axis, from the closed forms of the basis.
TEST(zernike_descriptor, of_two_masses_has_closed_forms) {
    const clouds::cloud two{{1, 2, 2}, {1, 2, 4}};
    const auto d = zernike_descriptor::of(two, {.order = 2, .enclose = true});
    ASSERT_EQ(d.values.size(), 4u);
    EXPECT_NEAR(d.values[0], 1.0, 1e-14);
    EXPECT_NEAR(d.values[1], 0.0, 1e-14);
    // Z_200 = sqrt(7 / 3) (5 r^2 - 3) / 2; Z_220 = sqrt(7 / 3) sqrt(5) (3 z^2 - r^2) / 2
    EXPECT_NEAR(d.values[2], std::sqrt(7.0 / 3), 1e-14);
    EXPECT_NEAR(d.values[3], std::sqrt(7.0 / 3) * std::sqrt(5.0), 1e-13);
}

/// Rotation, place and size do not matter to masses, beyond rounding.
TEST(zernike_descriptor, is_invariant_under_similarity) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const auto points = clouds::sheet(300, seed);
        const Eigen::Matrix3d larger = 7.0 * clouds::random_rotation(seed);
        const auto d = zernike_descriptor::of(points, {.order = 8});
        const auto turned = clouds::moved(points, larger, {1, -2, 3});
        EXPECT_LT(share_of_values(d, zernike_descriptor::of(turned, {.order = 8})), 1e-12);
    }
}

/// A closed shape is turned and voxelised: less than 1 %. Voxels are those whose center is in the
/// shape, or those occupied by points, of which the shape is full. (Sides along the axes of the
/// grid would be the worst case, as each moves by up to half a voxel as a whole.)
TEST(zernike_descriptor, of_a_voxelised_shape_is_invariant_under_rotation) {
    double largest = 0.0, occupied = 0.0;
    const auto compare = [&](auto&& solid) {
        const auto of_centers = [&](const Eigen::Matrix3d& r) {
            const auto turned = [&](const Eigen::Vector3d& p) { return solid(1.5 * (r * p)); };
            return zernike_descriptor::of(
                filled_solid(turned, 64, Eigen::Matrix3d::Identity(), {0, 0, 0}));
        };
        const auto of_points = [&](const Eigen::Matrix3d& r) {
            return zernike_descriptor::of(filled_solid(solid, 120, r, {1, 2, 3}), {.voxels = 64});
        };
        const Eigen::Matrix3d oblique = clouds::random_rotation(99);
        const auto centers = of_centers(oblique), points = of_points(oblique);
        for (std::uint64_t seed = 0; seed < 5; ++seed) {
            const Eigen::Matrix3d r = clouds::random_rotation(seed);
            largest = std::max(largest, share_of_values(centers, of_centers(r)));
            occupied = std::max(occupied, share_of_values(points, of_points(r)));
        }
    };
    compare(in_box);
    compare(in_chair);
    EXPECT_LT(largest, 0.01);
    EXPECT_LT(occupied, 0.01);
    RecordProperty("largest", std::to_string(largest));
    RecordProperty("occupied", std::to_string(occupied));
}

/// Shapes differ by more than their rotations do.
TEST(zernike_descriptor, distinguishes_shapes) {
    const auto box = zernike_descriptor::of(
        filled_solid(in_box, 100, clouds::random_rotation(1), {0, 0, 0}), {.voxels = 64});
    const auto chair = zernike_descriptor::of(
        filled_solid(in_chair, 100, clouds::random_rotation(2), {0, 0, 0}), {.voxels = 64});
    EXPECT_GT(share_of_values(box, chair), 0.1);
}

/// Voxels forget how many points they contain.
TEST(zernike_descriptor, of_voxels_does_not_depend_on_density) {
    auto points = filled_solid(in_chair, 60, Eigen::Matrix3d::Identity(), {0, 0, 0});
    const auto even = zernike_descriptor::of(points, {.voxels = 32});
    const std::size_t n = points.size();
    for (std::size_t i = 0; i < n; ++i)
        if (points[i].z() > 0.3)
            for (int copies = 0; copies < 5; ++copies) points.push_back(points[i]);
    const auto uneven = zernike_descriptor::of(points, {.voxels = 32});
    const auto masses = zernike_descriptor::of(points, {.voxels = 0});
    EXPECT_LT(share_of_values(even, uneven), 0.05);
    EXPECT_GT(share_of_values(zernike_descriptor::of(filled_solid(
                                  in_chair, 60, Eigen::Matrix3d::Identity(), {0, 0, 0})),
                              masses),
              0.1);
}

TEST(zernike_descriptor, names_degenerate_segments) {
    const auto expect_none = [](const clouds::cloud& points, trust expected) {
        for (const std::size_t voxels : {0u, 16u}) {
            const auto d = zernike_descriptor::of(points, {.voxels = voxels});
            EXPECT_EQ(d.trust, expected);
            EXPECT_EQ(d.values, std::vector<double>(12, 0.0));
        }
    };
    expect_none({}, trust::too_few_neighbors);
    expect_none(clouds::cloud(5, {clouds::nan, 0, 0}), trust::too_few_neighbors);
    expect_none({{1, 2, 3}}, trust::degenerate);
    expect_none(clouds::cloud(50, {4e5, 5e6, 100.0}), trust::degenerate);
    for (const auto& [name, points] : clouds::degenerate()) {
        SCOPED_TRACE(name);
        for (const std::size_t voxels : {0u, 16u}) {
            const auto d = zernike_descriptor::of(points, {.voxels = voxels});
            for (const double v : d.values) ASSERT_TRUE(std::isfinite(v));
        }
    }
}

/// Far from the origin, and with points that are not finite.
TEST(zernike_descriptor, keeps_its_digits) {
    auto points = clouds::sheet(400, 3);
    const auto expected = zernike_descriptor::of(points);
    points = clouds::moved(points, Eigen::Matrix3d::Identity(), {4e5, 5e6, 100});
    points.push_back({clouds::nan, 1, 2});
    EXPECT_LT(share_of_values(expected, zernike_descriptor::of(points)), 1e-8);
}

TEST(zernike_descriptor, is_the_same_on_any_number_of_threads) {
    const auto points = clouds::in_cube(5000, 4);
    for (const std::size_t voxels : {0u, 32u}) {
        const gnomon::zernike_options options{.order = 8, .voxels = voxels};
        const auto expected = zernike_descriptor::of(points, options);
        for (const unsigned n : {2u, 3u, 8u})
            EXPECT_EQ(zernike_descriptor::of(points, options, gnomon::threads{n}).values,
                      expected.values);
    }
}

TEST(zernike_descriptor, rejects_bad_arguments) {
    const auto points = clouds::in_cube(10, 1);
    EXPECT_THROW((void)zernike_descriptor::of(points, {.order = 21}), std::invalid_argument);
    EXPECT_THROW((void)zernike_descriptor::of(points, {.voxels = 1025}), std::invalid_argument);
    EXPECT_THROW(
        (void)zernike_descriptor::of(points).distance(zernike_descriptor::of(points, {.order = 4})),
        std::invalid_argument);
}

}  // namespace
