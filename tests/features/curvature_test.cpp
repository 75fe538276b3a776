// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "features/patches.hpp"
#include "laws/clouds.hpp"
#include "laws/curvature_laws.hpp"
#include "laws/estimator_laws.hpp"
#include <gnomon/features/curvature.hpp>
#include <gnomon/normals/plane_pca.hpp>

namespace {

using gnomon::curvature, gnomon::shape_operator_curvature, gnomon::thesis_curvature, gnomon::trust;
using patches::up, patches::zero;

struct no_normal {
    curvature operator()(const Eigen::Vector3d&, gnomon::neighborhood_view) const;
};
struct returns_number {
    double operator()(const Eigen::Vector3d&, const Eigen::Vector3d&,
                      gnomon::neighborhood_view) const;
};
struct more_than_curvature : curvature {
    double residual = 0.0;
};
static_assert(gnomon::curvature_estimator<shape_operator_curvature>);
static_assert(gnomon::curvature_estimator<thesis_curvature>);
static_assert(gnomon::curvature_estimator<decltype([](const auto&, const auto&, auto) {
    return more_than_curvature{};
})>);
static_assert(!gnomon::curvature_estimator<no_normal>);
static_assert(!gnomon::curvature_estimator<returns_number>);
static_assert(!gnomon::curvature_estimator<gnomon::plane_pca>);

/// Errors are at most 1e-3 of the larger principal curvature, for dense neighborhoods without
/// noise.
template <class C>
void expect_known_curvatures(const C& estimate) {
    for (const auto& surface : patches::all()) {
        SCOPED_TRACE(surface.name);
        for (std::uint64_t seed = 0; seed < 20; ++seed) {
            const auto c = estimate(zero, up, patches::neighborhood_of(surface, 200, 0.01, seed));
            ASSERT_EQ(c.trust, trust::good);
            const double size = std::max(std::abs(surface.kappa1), std::abs(surface.kappa2));
            ASSERT_NEAR(c.kappa1, surface.kappa1, 1e-3 * size);
            ASSERT_NEAR(c.kappa2, surface.kappa2, 1e-3 * size);
            ASSERT_NEAR(c.gaussian(), surface.kappa1 * surface.kappa2, 2e-3 * size * size);
            ASSERT_NEAR(c.mean(), 0.5 * (surface.kappa1 + surface.kappa2), 1e-3 * size);
        }
    }
}

TEST(curvature, of_known_surfaces) { expect_known_curvatures(shape_operator_curvature{}); }
TEST(curvature, of_known_surfaces_by_the_thesis) { expect_known_curvatures(thesis_curvature{}); }

/// The principal directions of a cylinder are its axis and its circumference; those of z = xy are
/// the diagonals.
template <class C>
void expect_known_directions(const C& estimate) {
    const auto all = patches::all();
    const auto column = estimate(zero, up, patches::neighborhood_of(all[2], 200, 0.01, 1));
    EXPECT_LT(laws::angle_between(column.direction1, {1, 0, 0}), 1e-3);
    EXPECT_LT(laws::angle_between(column.direction2, {0, 1, 0}), 1e-3);
    const auto saddle = estimate(zero, up, patches::neighborhood_of(all[5], 200, 0.01, 1));
    EXPECT_LT(laws::angle_between(saddle.direction1, {1, 1, 0}), 1e-9);
    EXPECT_LT(laws::angle_between(saddle.direction2, {1, -1, 0}), 1e-9);
}

TEST(curvature, has_principal_directions) { expect_known_directions(shape_operator_curvature{}); }
TEST(curvature, has_principal_directions_by_the_thesis) {
    expect_known_directions(thesis_curvature{});
}

/// z = xy away from its middle, in a frame inclined by up to 49 degrees and at a point up to 1 mm
/// off the surface: the first-order terms and the constant absorb both. (The thesis's form has no
/// such terms. The point is one of the fitted points, so 1 mm has a small effect.)
TEST(curvature, counts_the_inclination_of_the_surface) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        gnomon::random_stream random(seed);
        const double x = random.uniform(-0.8, 0.8);
        const double y = random.uniform(-0.8, 0.8);
        clouds::cloud neighbors;
        for (int i = 0; i < 100; ++i) {
            const double u = x + random.uniform(-0.05, 0.05);
            const double v = y + random.uniform(-0.05, 0.05);
            neighbors.push_back({u, v, u * v});
        }
        for (const double off : {0.0, 0.001}) {
            const double tolerance = off == 0.0 ? 1e-9 : 0.05;
            const auto c = shape_operator_curvature{}({x, y, x * y + off}, up, neighbors);
            const double w = std::sqrt(1 + x * x + y * y);
            ASSERT_NEAR(c.gaussian(), -1 / (w * w * w * w), tolerance);
            ASSERT_NEAR(c.mean(), -x * y / (w * w * w), tolerance);
            const Eigen::Vector3d n = Eigen::Vector3d(-y, -x, 1) / w;
            ASSERT_LT((c.direction1.cross(c.direction2) - n).norm(), tolerance);
            // The normal curvature along a unit tangent: II(t, t) = 2 t_x t_y / w.
            const Eigen::Vector3d& t = c.direction1;
            ASSERT_NEAR(2 * t.x() * t.y() / w, c.kappa1, tolerance);
            const Eigen::Vector3d& u = c.direction2;
            ASSERT_NEAR(2 * u.x() * u.y() / w, c.kappa2, tolerance);
        }
    }
}

TEST(curvature, follows_the_cloud) {
    laws::curvature_follows_the_cloud(shape_operator_curvature{});
}
TEST(curvature, follows_the_cloud_by_the_thesis) {
    laws::curvature_follows_the_cloud(thesis_curvature{});
}
TEST(curvature, is_one_over_a_length) {
    laws::curvature_is_one_over_a_length(shape_operator_curvature{});
}

/// Squares of lengths below 1e-146 m underflow, and squares of curvatures above 1e154 / m overflow.
TEST(curvature, of_no_size_is_not_determined) {
    const auto [neighbors, p] = laws::bent_sample(1);
    const Eigen::Matrix3d tiny = 1e-150 * Eigen::Matrix3d::Identity();
    clouds::cloud needle;
    for (int i = -2; i <= 2; ++i) {
        for (int j = -2; j <= 2; ++j)
            needle.push_back({1e-144 * i, 1e-144 * j, -1.0 * (i * i + j * j)});
    }
    for (const clouds::cloud& points : {clouds::moved(neighbors, tiny, zero), needle}) {
        const auto c = shape_operator_curvature{}(zero, up, points);
        EXPECT_EQ(c.trust, trust::degenerate);
        laws::expect_no_curvature(c);
    }
}

TEST(curvature, reports_degenerate_neighborhoods) {
    const shape_operator_curvature fit;
    const clouds::cloud five{{1, 0, 0}, {0, 1, 0}, {-1, 0.5, 0}, {0.5, -1, 0}, {1, 1, 0.1}};
    EXPECT_EQ(fit(zero, up, five).trust, trust::good);
    EXPECT_EQ(fit(zero, 2.0 * up, five).kappa1, fit(zero, up, five).kappa1);
    const clouds::cloud four(five.begin(), five.end() - 1);
    EXPECT_EQ(fit(zero, up, four).trust, trust::too_few_neighbors);
    EXPECT_EQ(fit(zero, up, {}).trust, trust::too_few_neighbors);
    EXPECT_EQ(fit(zero, zero, five).trust, trust::degenerate);
    EXPECT_EQ(fit(zero, {0, clouds::nan, 1}, five).trust, trust::not_finite);
    EXPECT_EQ(fit({clouds::infinity, 0, 0}, up, five).trust, trust::not_finite);
    clouds::cloud broken = five;
    broken[3].y() = clouds::nan;
    EXPECT_EQ(fit(zero, up, broken).trust, trust::not_finite);
    EXPECT_EQ(fit(zero, up, clouds::cloud(9, zero)).trust, trust::degenerate);

    clouds::cloud line, far_line, two_lines, circle, flat;
    for (int i = 0; i < 20; ++i) {
        line.push_back({0.1 * i, 0, 0});
        far_line.push_back({0.1 * i, 1e-9 * (i % 3), 0});  // as rounding at UTM coordinates has it
        two_lines.push_back({0.1 * i, 0.5 * (i % 2), 0});
        circle.push_back({std::cos(i), std::sin(i), 0});  // about the point
        flat.push_back({0.1 * i, 0.01 * (i % 3), 0});
    }
    EXPECT_EQ(fit(zero, up, line).trust, trust::degenerate);
    EXPECT_EQ(fit(zero, up, far_line).trust, trust::degenerate);
    EXPECT_EQ(fit(zero, up, two_lines).trust, trust::degenerate);
    EXPECT_EQ(fit({1, 0, 0}, up, circle).trust, trust::degenerate);  // the point is on it
    EXPECT_EQ(fit(zero, up, circle).trust, trust::good);
    EXPECT_EQ(fit(zero, up, flat).trust, trust::weak);
    two_lines[5].y() += 1e-3;  // now determined, but by one point
    EXPECT_EQ(fit(zero, up, two_lines).trust, trust::weak);
    EXPECT_EQ(shape_operator_curvature{.min_independence = 0}(zero, up, two_lines).trust,
              trust::good);
    for (const auto& neighbors : {four, broken, line, circle})
        laws::expect_no_curvature(fit({1, 0, 0}, up, neighbors));
}

/// Also if the square of the length over- or underflows.
TEST(curvature, of_a_normal_of_any_length) {
    const auto [neighbors, p] = laws::bent_sample(1);
    const Eigen::Vector3d inclined(0.25, -0.5, 1.0);
    const auto expect_equal = [](const curvature& a, const curvature& b) {
        EXPECT_EQ(a.trust, b.trust);
        EXPECT_EQ(a.kappa1, b.kappa1);
        EXPECT_EQ(a.kappa2, b.kappa2);
        EXPECT_EQ(a.direction1, b.direction1);
        EXPECT_EQ(a.direction2, b.direction2);
    };
    for (const double length : {1e-320, 1e-161, 1e-3, 1e161, 1e308}) {
        SCOPED_TRACE(length);
        expect_equal(shape_operator_curvature{}(p, length * up, neighbors),
                     shape_operator_curvature{}(p, up, neighbors));
        const double power = std::exp2(std::floor(std::log2(length)));
        expect_equal(thesis_curvature{}(p, power * inclined, neighbors),
                     thesis_curvature{}(p, inclined, neighbors));
    }
}

TEST(curvature, of_a_perfect_plane_is_zero) {
    clouds::cloud neighbors;
    for (int i = 0; i < 20; ++i) neighbors.push_back({0.1 * (i % 5), 0.1 * (i / 5), 0.0});
    for (const curvature& c : {shape_operator_curvature{}({0.2, 0.2, 0.0}, up, neighbors),
                               thesis_curvature{}({0.2, 0.2, 0.0}, up, neighbors)}) {
        EXPECT_EQ(c.trust, trust::good);
        EXPECT_EQ(c.kappa1, 0.0);
        EXPECT_EQ(c.kappa2, 0.0);
    }
}

}  // namespace
