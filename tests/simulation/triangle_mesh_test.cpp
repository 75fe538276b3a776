// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/shape_laws.hpp"
#include "simulation/meshes.hpp"
#include <gnomon/simulation/box.hpp>
#include <gnomon/simulation/cylinder.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/triangle_mesh.hpp>

namespace sim = gnomon::simulation;

namespace {

using sim::triangle_mesh;
static_assert(sim::shape<triangle_mesh>);

TEST(triangle_mesh, obeys_the_laws) {
    EXPECT_GT(laws::obeys_shape_laws(meshes::of_box({0.4, 0.3, 1.2}), 1), 1000u);
    EXPECT_GT(laws::obeys_shape_laws(meshes::of_cylinder({0.3, 0.9}, 300), 2), 1000u);
}

TEST(triangle_mesh, of_a_box_is_the_box) {
    const sim::box box{0.4, 0.3, 1.2};
    const auto mesh = meshes::of_box(box);
    std::size_t hits = 0;
    for (const sim::ray& r : laws::rays_at(box.extent(), 5000, 3)) {
        const auto expected = box.first_hit(r);
        const auto found = mesh.first_hit(r);
        ASSERT_EQ(expected.has_value(), found.has_value());
        if (!expected) continue;
        ++hits;
        EXPECT_NEAR(found->range, expected->range, 1e-12 * (1 + expected->range));
        EXPECT_EQ(found->surface, expected->surface);
        EXPECT_LT((found->normal - expected->normal).norm(), 1e-12);
    }
    EXPECT_GT(hits, 2000u);
}

/// Facets of n sides stand r (1 - cos(pi / n)) behind the mantle at most.
TEST(triangle_mesh, of_a_cylinder_converges_to_the_cylinder) {
    const sim::cylinder round{0.3, 0.9};
    constexpr int sides = 1000;
    const auto mesh = meshes::of_cylinder(round, sides);
    const double sagitta = round.radius * (1 - std::cos(std::numbers::pi / sides));
    std::size_t hits = 0;
    for (const sim::ray& r : laws::rays_at(round.extent(), 5000, 4)) {
        const auto expected = round.first_hit(r);
        const auto found = mesh.first_hit(r);
        if (!expected || std::abs(expected->normal.dot(r.direction)) < 0.2) continue;
        const Eigen::Vector3d p = r.point_at(expected->range);
        // Near the rim the mesh may show another side.
        if (std::hypot(p.x(), p.y()) > 0.29 && (p.z() < 0.01 || p.z() > 0.89)) continue;
        ASSERT_TRUE(found);
        ++hits;
        EXPECT_EQ(found->surface, expected->surface);
        EXPECT_NEAR(found->range, expected->range, sagitta / 0.19);
        EXPECT_GT(found->normal.dot(expected->normal), std::cos(2 * std::numbers::pi / sides));
    }
    EXPECT_GT(hits, 1000u);
}

/// Every ray through a shared edge or a shared vertex is stopped.
TEST(triangle_mesh, lets_no_ray_through_between_triangles) {
    std::vector<Eigen::Vector3d> vertices;
    std::vector<sim::triangle> triangles;
    constexpr std::uint32_t n = 20;
    gnomon::random_stream random(7);
    for (std::uint32_t i = 0; i <= n; ++i) {
        for (std::uint32_t j = 0; j <= n; ++j) {
            vertices.push_back({i + (i % n ? 0.3 * random.uniform() : 0.0),
                                j + (j % n ? 0.3 * random.uniform() : 0.0), random.uniform()});
        }
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t j = 0; j < n; ++j) {
            const std::uint32_t a = i * (n + 1) + j;
            triangles.push_back({a, a + 1, a + n + 2});
            triangles.push_back({a, a + n + 2, a + n + 1});
        }
    }
    const triangle_mesh net({vertices, triangles, {}});
    for (int k = 0; k < 100'000; ++k) {
        const auto& t = triangles[random.below(triangles.size())];
        const double share = k % 10 ? random.uniform() : 0.0;
        const Eigen::Vector3d target = vertices[t[0]] + share * (vertices[t[1]] - vertices[t[0]]);
        if (target.x() < 0.1 || target.y() < 0.1 || target.x() > n - 0.1 || target.y() > n - 0.1)
            continue;
        const Eigen::Vector3d from(n * random.uniform(), n * random.uniform(), 30.0);
        ASSERT_TRUE(net.first_hit({from, (target - from).normalized()}));
    }
}

TEST(triangle_mesh, passes_over_degenerate_triangles) {
    const std::vector<Eigen::Vector3d> vertices{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}};
    const triangle_mesh needles({vertices, {{0, 1, 2}, {1, 1, 3}, {2, 2, 2}}, {}});
    for (const sim::ray& r : laws::rays_at(needles.extent(), 1000, 5)) {
        EXPECT_FALSE(needles.first_hit(r));
    }
    EXPECT_FALSE(needles.first_hit({{1, 0, 3}, {0, 0, -1}}));
    const triangle_mesh one_good({vertices, {{0, 1, 2}, {0, 1, 3}, {2, 2, 2}}, {}});
    EXPECT_TRUE(one_good.first_hit({{0.2, 0.2, 3}, {0, 0, -1}}));
}

/// Vertices that are collinear up to rounding: the range of a hit on such a triangle would be
/// arbitrary.
TEST(triangle_mesh, skips_nearly_collinear_triangles) {
    gnomon::random_stream random(7);
    const auto anywhere = [&](double size) {
        return Eigen::Vector3d(size * random.gaussian(), size * random.gaussian(),
                               size * random.gaussian());
    };
    for (int k = 0; k < 200; ++k) {
        const Eigen::Vector3d o = anywhere(1.0);
        const Eigen::Vector3d d = anywhere(1.0);
        for (const double share : {0.0, 0.1, 1.0}) {
            const triangle_mesh line({{o, o + share * d, o + d}, {{0, 1, 2}}, {}});
            for (int i = 0; i < 200; ++i) {
                const Eigen::Vector3d to = o + random.uniform() * d;
                const Eigen::Vector3d from = anywhere(4.0);
                EXPECT_FALSE(line.first_hit({from, (to - from).normalized()}));
            }
        }
    }
}

/// A closed mesh from within, at its edges: also where the compiler fuses products with sums.
TEST(triangle_mesh, is_watertight_from_within) {
    const sim::box room{4, 4, 2};
    const sim::polyhedron faces = room.triangles();
    for (const auto& place : {sim::pose{}, sim::at(3.3, 6.6, -3.3) * sim::yaw(gnomon::degrees(31)) *
                                               sim::pitch(gnomon::degrees(15))}) {
        sim::polyhedron placed = faces;
        for (Eigen::Vector3d& v : placed.vertices) v = place.point_out(v);
        const triangle_mesh mesh(placed, {"+x", "-x", "+y", "-y", "+z", "-z"});
        gnomon::random_stream random(5);
        for (int i = 0; i < 20'000; ++i) {
            const auto& t = placed.triangles[random.below(placed.triangles.size())];
            const Eigen::Vector3d& a = placed.vertices[t[0]];
            const Eigen::Vector3d& b = placed.vertices[t[1 + random.below(2)]];
            const Eigen::Vector3d to = a + (i % 4 ? random.uniform() : 0.0) * (b - a);
            const Eigen::Vector3d from = place.point_out(
                {random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4)});
            const auto hit = mesh.first_hit({from, (to - from).normalized()});
            ASSERT_TRUE(hit);
            EXPECT_NEAR(hit->range, (to - from).norm(), 1e-12);
        }
    }
}

TEST(triangle_mesh, rejects_invalid_meshes) {
    const std::vector<Eigen::Vector3d> v{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    std::vector<Eigen::Vector3d> broken = v;
    broken[1].y() = clouds::nan;
    const std::vector<sim::triangle> one{{0, 1, 2}};
    using names = std::vector<std::string>;
    EXPECT_NO_THROW(triangle_mesh({v, one, {1}}, {"a", "b"}));
    EXPECT_THROW(triangle_mesh({v, {}, {}}), std::invalid_argument);
    EXPECT_THROW(triangle_mesh({broken, one, {}}), std::invalid_argument);
    EXPECT_THROW(triangle_mesh({v, {{0, 1, 3}}, {}}), std::invalid_argument);
    EXPECT_THROW(triangle_mesh({v, one, {0, 0}}), std::invalid_argument);
    EXPECT_THROW(triangle_mesh({v, one, {-1}}), std::invalid_argument);
    EXPECT_THROW(triangle_mesh({v, one, {2}}, {"a", "b"}), std::invalid_argument);
    EXPECT_THROW(triangle_mesh({v, one, {}}, names{}), std::invalid_argument);
}

}  // namespace
