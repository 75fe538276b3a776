// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstddef>
#include <deque>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "features/patches.hpp"
#include "laws/clouds.hpp"
#include "laws/curvature_laws.hpp"
#include <gnomon/core/scan.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/features/estimate_curvature.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/radius.hpp>
#include <gnomon/neighborhoods/raster.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/orient.hpp>
#include <gnomon/normals/plane_pca.hpp>

namespace {

using gnomon::curvature, gnomon::knn, gnomon::trust;

using laws::only_normal, patches::zero;

/// The theorem of Gauss and Bonnet: the integral of K over a surface of the topology of a sphere is
/// 4 pi.
/// @param axes  of an ellipsoid [m]
/// @return the integral divided by 4 pi
double total_curvature(const Eigen::Vector3d& axes, std::size_t n) {
    clouds::cloud points;
    std::vector<double> area;
    std::vector<only_normal> surface;
    for (const Eigen::Vector3d& u : patches::on_sphere(n)) {
        // The area element of the unit sphere is scaled by the cofactors of diag(axes).
        const Eigen::Vector3d m = u.cwiseQuotient(axes) * axes.prod();
        points.push_back(u.cwiseProduct(axes));
        area.push_back(4.0 * std::numbers::pi / static_cast<double>(n) * m.norm());
        surface.push_back({m.normalized()});
    }
    double sum = 0.0;
    const auto all = gnomon::estimate_curvature(points, knn{.k = 20}, surface);
    for (std::size_t i = 0; i < n; ++i) {
        EXPECT_LT(all[i].mean(), 0.0);
        sum += all[i].gaussian() * area[i];
    }
    return sum / (4.0 * std::numbers::pi);
}

TEST(estimate_curvature, sums_up_to_that_of_a_closed_surface) {
    EXPECT_NEAR(total_curvature({1, 1, 1}, 5000), 1.0, 0.02);
    EXPECT_NEAR(total_curvature({2, 1, 0.7}, 20'000), 1.0, 0.02);
}

/// By the whole chain, with estimated normals: 1/R within 1e-3.
TEST(estimate_curvature, of_a_sphere) {
    clouds::cloud points = patches::on_sphere(40'000);
    const double radius = 3.0;
    for (Eigen::Vector3d& p : points) p *= radius;
    const auto seen = gnomon::with_viewpoint(points, zero);
    const auto graph = knn{.k = 20}(seen);
    auto surface = gnomon::estimate_normals(seen, graph, gnomon::plane_pca{});
    gnomon::orient_normals(seen, surface);
    const auto all = gnomon::estimate_curvature(seen, graph, surface);
    ASSERT_EQ(all.size(), points.size());
    for (const curvature& c : all) {
        ASSERT_EQ(c.trust, trust::good);
        ASSERT_NEAR(c.kappa1, 1 / radius, 1e-3 / radius);
        ASSERT_NEAR(c.kappa2, 1 / radius, 1e-3 / radius);
    }
}

/// A sheet with oriented normals.
struct known_sheet {
    clouds::cloud points;
    std::vector<gnomon::surfel<gnomon::plane_fit>> surface;

    explicit known_sheet(std::size_t n, std::uint64_t seed) : points(clouds::sheet(n, seed)) {
        surface = gnomon::estimate_normals(points, knn{12}, gnomon::plane_pca{});
        gnomon::orient_normals(gnomon::with_viewpoint(points, {0.5, 0.5, 5}), surface);
    }
};

void expect_same_bytes(const std::vector<curvature>& a, const std::vector<curvature>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        ASSERT_EQ(a[i].kappa1, b[i].kappa1);
        ASSERT_EQ(a[i].kappa2, b[i].kappa2);
        ASSERT_EQ(a[i].direction1, b[i].direction1);
        ASSERT_EQ(a[i].direction2, b[i].direction2);
        ASSERT_EQ(a[i].trust, b[i].trust);
    }
}

/// The estimator's result for each point, with the neighbors in the order of the graph.
TEST(estimate_curvature, calls_the_estimator_once_per_point) {
    const known_sheet sheet(300, 1);
    const auto graph = knn{9}(sheet.points);
    std::vector<curvature> expected;
    for (std::size_t i = 0; i < 300; ++i) {
        clouds::cloud neighbors;
        for (const auto j : graph[i]) neighbors.push_back(sheet.points[j]);
        expected.push_back(gnomon::shape_operator_curvature{}(sheet.points[i],
                                                              sheet.surface[i].normal, neighbors));
    }
    expect_same_bytes(gnomon::estimate_curvature(sheet.points, graph, sheet.surface), expected);
}

/// The same bytes on any number of threads, from a stored graph and from the fused search.
TEST(estimate_curvature, does_not_depend_on_execution) {
    const known_sheet sheet(5000, 8);
    const knn policy{.k = 12};
    const auto compare = [&](const auto& estimate) {
        const auto expected =
            gnomon::estimate_curvature(sheet.points, policy, sheet.surface, estimate);
        for (const unsigned t : {1u, 2u, 4u}) {
            const gnomon::threads run{t};
            expect_same_bytes(
                gnomon::estimate_curvature(sheet.points, policy, sheet.surface, estimate, run),
                expected);
            expect_same_bytes(gnomon::estimate_curvature(sheet.points, policy(sheet.points),
                                                         sheet.surface, estimate, run),
                              expected);
        }
    };
    compare(gnomon::shape_operator_curvature{});
    compare(gnomon::thesis_curvature{});
}

/// Every kind of point range gives the same bytes.
TEST(estimate_curvature, reads_any_container) {
    struct laser_return {
        double time;
        Eigen::Vector3d xyz;
    };
    const known_sheet sheet(500, 2);
    std::deque<laser_return> returns;
    std::deque<only_normal> normals;
    for (const auto& p : sheet.points) returns.push_back({0.0, p});
    for (const auto& s : sheet.surface) normals.push_back({s.normal});
    const auto expected = gnomon::estimate_curvature(sheet.points, knn{10}, sheet.surface);
    expect_same_bytes(
        gnomon::estimate_curvature(returns, knn{10}, normals, gnomon::shape_operator_curvature{},
                                   gnomon::sequential{}, &laser_return::xyz),
        expected);
    expect_same_bytes(gnomon::estimate_curvature(returns, knn{10}(sheet.points), normals,
                                                 gnomon::shape_operator_curvature{},
                                                 gnomon::threads{2}, &laser_return::xyz),
                      expected);
}

/// Any neighborhood and any estimator; the result has the estimator's own type.
TEST(estimate_curvature, takes_any_policy) {
    struct mine : curvature {
        std::size_t neighbors = 0;
    };
    const auto count = [](const Eigen::Vector3d&, const Eigen::Vector3d&,
                          gnomon::neighborhood_view neighbors) {
        mine m;
        m.trust = trust::good;
        m.neighbors = neighbors.size();
        return m;
    };
    const known_sheet sheet(300, 3);
    const gnomon::radius ball{.r = 0.2};
    const auto graph = ball(sheet.points);
    const auto counted = gnomon::estimate_curvature(sheet.points, ball, sheet.surface, count);
    for (std::size_t i = 0; i < 300; ++i) EXPECT_EQ(counted[i].neighbors, graph[i].size());
}

TEST(estimate_curvature, takes_the_width_of_a_scan) {
    gnomon::scan scan;
    scan.points = clouds::in_cube(480, 1);
    scan.width = 24;
    const gnomon::raster pixels;
    const auto surface = estimate_normals(scan, pixels, gnomon::plane_pca{});
    const auto result = estimate_curvature(scan, pixels, surface);
    const auto expected = estimate_curvature(scan, pixels(scan), surface);
    for (std::size_t i = 0; i < scan.size(); ++i) EXPECT_EQ(result[i].trust, expected[i].trust);
}

/// The trust of a curvature is no better than that of its normal; a missing normal passes its trust
/// on.
TEST(estimate_curvature, is_at_most_as_trusted_as_the_normal) {
    known_sheet sheet(100, 4);
    sheet.surface[1].trust = trust::weak;
    sheet.surface[2].trust = trust::too_few_neighbors;
    sheet.surface[2].normal = zero;
    sheet.surface[3].normal = zero;  // although its trust is good
    sheet.surface[4].normal.x() = clouds::nan;
    const auto c = gnomon::estimate_curvature(sheet.points, knn{20}, sheet.surface);
    EXPECT_EQ(c[0].trust, trust::good);
    EXPECT_EQ(c[1].trust, trust::weak);
    EXPECT_NE(c[1].kappa1, 0.0);
    EXPECT_EQ(c[2].trust, trust::too_few_neighbors);
    EXPECT_EQ(c[3].trust, trust::degenerate);
    EXPECT_EQ(c[4].trust, trust::not_finite);

    const std::vector<only_normal> none(100, {zero});
    for (const auto& d : gnomon::estimate_curvature(sheet.points, knn{20}, none)) {
        EXPECT_EQ(d.trust, trust::degenerate);
        EXPECT_EQ(d.kappa1, 0.0);
    }
}

/// An estimator that returns NaN with a usable trust: the driver must reject the result.
TEST(estimate_curvature, keeps_the_promises_that_an_estimator_breaks) {
    const auto broken = [](const Eigen::Vector3d&, const Eigen::Vector3d&,
                           gnomon::neighborhood_view) {
        curvature c;
        c.trust = trust::good;
        c.kappa1 = clouds::nan;
        return c;
    };
    const auto careless = [](const Eigen::Vector3d&, const Eigen::Vector3d&,
                             gnomon::neighborhood_view) {
        curvature c;
        c.kappa1 = 7.0;  // of too few neighbors
        return c;
    };
    const known_sheet sheet(50, 5);
    for (const auto& c : gnomon::estimate_curvature(sheet.points, knn{20}, sheet.surface, broken)) {
        EXPECT_EQ(c.trust, trust::not_finite);
        EXPECT_EQ(c.kappa1, 0.0);
    }
    for (const auto& c :
         gnomon::estimate_curvature(sheet.points, knn{20}, sheet.surface, careless)) {
        EXPECT_EQ(c.trust, trust::too_few_neighbors);
        EXPECT_EQ(c.kappa1, 0.0);
    }
}

TEST(estimate_curvature, survives_every_cloud) {
    laws::curvatures_are_finite_or_zero(gnomon::shape_operator_curvature{});
}
TEST(estimate_curvature, survives_every_cloud_by_the_thesis) {
    laws::curvatures_are_finite_or_zero(gnomon::thesis_curvature{});
}

TEST(estimate_curvature, rejects_inputs_of_different_sizes) {
    const auto ten = clouds::sheet(10, 1);
    const auto eleven = clouds::sheet(11, 1);
    const std::vector<only_normal> normals(10, {patches::up});
    const auto of = [&normals](const auto& points, const auto& graph) {
        (void)gnomon::estimate_curvature(points, graph, normals);
    };
    EXPECT_NO_THROW(of(ten, knn{5}(ten)));
    EXPECT_THROW(of(ten, knn{5}(eleven)), std::invalid_argument);
    EXPECT_THROW(of(eleven, knn{5}(eleven)), std::invalid_argument);
    EXPECT_THROW(of(eleven, knn{5}), std::invalid_argument);
    EXPECT_THROW(of(ten, knn{0}), std::invalid_argument);
    const std::vector<std::vector<gnomon::point_index>> outside(10, {10u});
    EXPECT_THROW(of(ten, outside), std::invalid_argument);
    const std::vector<std::vector<gnomon::point_index>> longer(11);
    EXPECT_THROW(of(ten, longer), std::invalid_argument);
}

}  // namespace
