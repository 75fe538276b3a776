// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/solids.hpp"
#include "normals/orientations.hpp"
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/orient.hpp>
#include <gnomon/normals/propagate_orientation.hpp>

namespace {

using orientations::outwards, orientations::part_right, orientations::surface_elements,
    orientations::unoriented, solids::solid;

/// A sphere seen from its center, from outside, and without a view point.
TEST(component_facing, view_points_decide_for_a_component) {
    solid sphere;
    sphere.add_sphere({3, 0, 0}, 500);
    const gnomon::knn policy{.k = 12};
    auto surface = unoriented(sphere.points);
    auto o = gnomon::propagate_orientation(gnomon::with_viewpoint(sphere.points, {3, 0, 0}), policy,
                                           surface);
    EXPECT_EQ(part_right(o, outwards(surface, sphere)), 0.0);
    o = gnomon::propagate_orientation(sphere.points, policy, surface);
    EXPECT_EQ(part_right(o, outwards(surface, sphere)), 1.0);

    clouds::cloud seen;  // only what faces the origin
    for (const auto& p : sphere.points) {
        if (p.x() < 2.7) seen.push_back(p);
    }
    auto front = unoriented(seen);
    const auto scan = gnomon::with_viewpoint(seen, {0, 0, 0});
    gnomon::propagate_orientation(scan, policy, front);
    auto faced = front;
    gnomon::orient_normals(scan, faced);
    for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_EQ(front[i].normal, faced[i].normal);
}

/// A point far off, looking inwards, does not turn the sphere over that it is linked to.
TEST(component_facing, an_outlier_does_not_decide) {
    solid sphere;
    sphere.add_sphere({0, 0, 0}, 300);
    sphere.add({1, 0, 0}, {1, 0, 0});
    const auto around = gnomon::knn{.k = 12}(sphere.points);
    std::vector<std::vector<gnomon::point_index>> graph;
    for (std::size_t i = 0; i < around.size(); ++i)
        graph.emplace_back(around[i].begin(), around[i].end());
    sphere.add({1.5, 3, 0}, {0.5, -std::sqrt(0.75), 0});
    graph.push_back({300});
    auto surface = unoriented(sphere.points);
    surface.back().normal = sphere.outside.back();
    const auto o = gnomon::propagate_orientation(sphere.points, graph, surface);
    EXPECT_EQ(o.components, 1u);
    EXPECT_EQ(part_right(o, outwards(surface, sphere)), 1.0);
}

/// Where there is no outside the rule is a convention.
TEST(component_facing, orients_a_plane_upwards) {
    for (const double z : {-2.0, 2.0}) {  // rounding puts the centroid above it or below
        clouds::cloud plane;
        for (int i = 0; i < 100; ++i) plane.push_back({0.1 * (i % 10), 0.1 * (i / 10), z});
        surface_elements surface(plane.size());
        for (const double sign : {1.0, -1.0}) {
            for (auto& e : surface) e.normal = Eigen::Vector3d(0, 0, sign);
            const auto o = gnomon::propagate_orientation(plane, gnomon::knn{.k = 8}, surface);
            for (std::size_t i = 0; i < plane.size(); ++i) {
                EXPECT_EQ(surface[i].normal.z(), 1.0);
                EXPECT_EQ(o.confidence[i], 1.0);
            }
        }
    }
}

}  // namespace
