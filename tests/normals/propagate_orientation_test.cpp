// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/solids.hpp"
#include "normals/orientations.hpp"
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/plane_fit.hpp>
#include <gnomon/normals/propagate_orientation.hpp>

namespace {

using neighborhoods = std::vector<std::vector<gnomon::point_index>>;
using orientations::scramble_signs, orientations::surface_elements, orientations::unoriented,
    solids::solid;

/// |<n_i, n_j>| of Hoppe et al. would be 1 for the first three and 0 at both edges.
TEST(propagate_orientation, weighs_links_by_their_angle_to_the_tangent_planes) {
    const Eigen::Vector3d x(1, 0, 0);
    const Eigen::Vector3d z(0, 0, 1);
    const Eigen::Vector3d origin(0, 0, 0);
    using gnomon::detail::sign_relation;
    EXPECT_EQ(sign_relation(origin, z, {2, 3, 0}, z), 1.0);
    EXPECT_NEAR(sign_relation(origin, z, {1, 0, -1}, z), 0.5, 1e-15);      // through a board
    EXPECT_NEAR(sign_relation(origin, z, {0, 0, -1}, -z), 0.0, 1e-15);     // straight through it
    EXPECT_NEAR(sign_relation({-1, 0, 0}, z, {0, 0, -1}, x), 0.5, 1e-15);  // over a convex edge
    EXPECT_NEAR(sign_relation({1, 0, 0}, z, {0, 0, 1}, x), 0.5, 1e-15);    // in a concave one
    EXPECT_EQ(sign_relation(origin, z, origin, -z), -1.0);                 // duplicates
    EXPECT_NEAR(sign_relation(origin, z, {1e-310, 0, -1e-310}, z), 0.5, 1e-15);
    gnomon::random_stream random(1);
    for (int i = 0; i < 100; ++i) {
        const Eigen::Vector3d p = clouds::gaussian_vector(random);
        const Eigen::Vector3d q = clouds::gaussian_vector(random);
        const Eigen::Vector3d m = clouds::gaussian_vector(random).normalized();
        const Eigen::Vector3d n = clouds::gaussian_vector(random).normalized();
        EXPECT_EQ(sign_relation(p, m, q, n), sign_relation(q, n, p, m));
        EXPECT_EQ(sign_relation(p, m, q, n), -sign_relation(q, -n, p, m));
    }
}

/// Normals in a row of points, turned about it by these angles: c = cos of their differences.
struct row {
    clouds::cloud points;
    surface_elements surface;

    explicit row(const std::vector<double>& degrees) : surface(degrees.size()) {
        for (std::size_t i = 0; i < degrees.size(); ++i) {
            const double a = degrees[i] * std::numbers::pi / 180.0;
            points.push_back({static_cast<double>(i), 0, 0});
            surface[i].normal = {0, std::sin(a), std::cos(a)};
        }
    }
};

TEST(propagate_orientation, confidence_is_the_weakest_link_of_the_strongest_path) {
    // A core of three points, a weak link, two points; and a direct but weaker way to the last.
    row r({0, 10, 20, 80, 100});
    const neighborhoods graph{{1}, {2}, {3}, {4}, {0}};
    const auto o = gnomon::propagate_orientation(r.points, graph, r.surface);
    const auto c = [](double degrees) { return std::cos(degrees * std::numbers::pi / 180.0); };
    for (const std::size_t i : {0u, 1u, 2u}) EXPECT_NEAR(o.confidence[i], c(10), 1e-12) << i;
    for (const std::size_t i : {3u, 4u}) EXPECT_NEAR(o.confidence[i], c(60), 1e-12) << i;
    EXPECT_LT(r.surface[0].normal.dot(r.surface[4].normal), 0.0);  // 100 degrees, step by step

    const auto cut =
        gnomon::propagate_orientation(r.points, graph, r.surface, {.min_link = c(60) + 0.01});
    EXPECT_EQ(cut.component, (std::vector<std::int32_t>{0, 0, 0, 1, 1}));
    EXPECT_NEAR(cut.confidence[3], c(20), 1e-12);
}

TEST(propagate_orientation, a_graph_is_read_in_both_directions) {
    solid sphere;
    sphere.add_sphere({0, 0, 0}, 300);
    const auto graph = gnomon::knn{.k = 10}(sphere.points);
    neighborhoods both(graph.size());
    neighborhoods one(graph.size());
    for (gnomon::point_index i = 0; i < graph.size(); ++i) {
        for (const auto j : graph[i]) {
            both[i].push_back(j);
            both[j].push_back(i);
            one[std::max(i, j)].push_back(std::min(i, j));
        }
    }
    auto surface = unoriented(sphere.points);
    auto same = surface;
    auto half = surface;
    const auto o = gnomon::propagate_orientation(sphere.points, graph, surface);
    const auto p = gnomon::propagate_orientation(sphere.points, both, same);
    const auto q = gnomon::propagate_orientation(sphere.points, one, half);
    EXPECT_EQ(o.confidence, p.confidence);
    EXPECT_EQ(o.confidence, q.confidence);
    EXPECT_EQ(q.components, 1u);
    for (std::size_t i = 0; i < surface.size(); ++i) {
        EXPECT_EQ(surface[i].normal, same[i].normal);
        EXPECT_EQ(surface[i].normal, half[i].normal);
    }
}

/// Noisy, of three components, and with a few points without normal.
solid rough_scene() {
    solid s;
    s.add_sphere({0, 0, 0}, 900, 0.05);
    s.add_sphere({4, 0, 0}, 700, 0.05);
    s.add_sphere({0, 4, 0}, 40);
    s.add({clouds::nan, 0, 0}, {0, 0, 0});
    return s;
}

TEST(propagate_orientation, depends_neither_on_order_nor_signs_nor_threads) {
    const solid s = rough_scene();
    const gnomon::knn policy{.k = 12};
    auto surface = unoriented(s.points);
    auto threaded = surface;
    const auto o = gnomon::propagate_orientation(s.points, policy(s.points), surface);
    EXPECT_EQ(o.components, 3u);

    scramble_signs(threaded, 5);
    const auto t =
        gnomon::propagate_orientation(s.points, policy, threaded, {}, gnomon::threads{3});
    EXPECT_EQ(t.confidence, o.confidence);
    EXPECT_EQ(t.component, o.component);

    std::vector<std::size_t> order;
    const auto shuffled = clouds::permuted(s.points, 4, order);
    auto moved = unoriented(shuffled);
    const auto m = gnomon::propagate_orientation(shuffled, policy, moved);
    for (std::size_t i = 0; i < order.size(); ++i) {
        EXPECT_EQ(surface[order[i]].normal, threaded[order[i]].normal);
        EXPECT_EQ(surface[order[i]].normal, moved[i].normal);
        EXPECT_EQ(o.confidence[order[i]], m.confidence[i]);
        EXPECT_EQ(o.component[order[i]], m.component[i]);
    }
}

TEST(propagate_orientation, moves_with_the_cloud) {
    const solid s = rough_scene();
    const auto graph = gnomon::knn{.k = 12}(s.points);
    auto surface = unoriented(s.points);
    const Eigen::Matrix3d r = clouds::random_rotation(8);
    auto turned = surface;
    for (auto& e : turned) e.normal = r * e.normal;
    const auto moved = clouds::moved(s.points, r, {10, -20, 30});
    const auto o = gnomon::propagate_orientation(s.points, graph, surface);
    const auto m = gnomon::propagate_orientation(moved, graph, turned);
    EXPECT_EQ(o.component, m.component);
    for (std::size_t i = 0; i < surface.size(); ++i) {
        EXPECT_LT((r * surface[i].normal - turned[i].normal).norm(), 1e-9);
        EXPECT_NEAR(o.confidence[i], m.confidence[i], 1e-9);
    }
}

/// Whatever the cloud, and for estimated normals as for arbitrary ones.
TEST(propagate_orientation, survives_degenerate_clouds) {
    for (const auto& [name, points] : clouds::degenerate()) {
        gnomon::random_stream random(3);
        surface_elements arbitrary(points.size());
        for (auto& s : arbitrary) s.normal = clouds::gaussian_vector(random).normalized();
        for (const auto& before : {unoriented(points), arbitrary}) {
            auto surface = before;
            const auto o = gnomon::propagate_orientation(points, gnomon::knn{.k = 8}, surface);
            ASSERT_EQ(o.confidence.size(), points.size()) << name;
            ASSERT_EQ(o.component.size(), points.size()) << name;
            std::int32_t last = -1;
            for (std::size_t i = 0; i < points.size(); ++i) {
                const bool usable =
                    gnomon::is_finite(points[i]) && !gnomon::is_missing(before[i].normal);
                EXPECT_EQ(o.component[i] >= 0, usable) << name << ' ' << i;
                EXPECT_TRUE(o.confidence[i] >= 0.0 && o.confidence[i] <= 1.0) << name << ' ' << i;
                EXPECT_TRUE(usable || o.confidence[i] == 0.0) << name << ' ' << i;
                EXPECT_TRUE(surface[i].normal == before[i].normal ||
                            (usable && surface[i].normal == -before[i].normal))
                    << name << ' ' << i;
                last = std::max(last, o.component[i]);
            }
            EXPECT_EQ(o.components, static_cast<std::size_t>(last + 1)) << name;
        }
    }
}

TEST(propagate_orientation, skips_points_without_normal_or_link) {
    row r({0, 180, 0, 180, 0});
    r.surface[2].normal = {0, 0, 0};
    r.surface[4].normal = {0, clouds::nan, 1};
    const auto o =
        gnomon::propagate_orientation(r.points, neighborhoods{{1}, {2}, {3}, {4}, {0}}, r.surface);
    EXPECT_EQ(o.component, (std::vector<std::int32_t>{0, 0, -1, 1, -1}));
    EXPECT_EQ(o.confidence, (std::vector<double>{1, 1, 0, 0, 0}));
    EXPECT_TRUE(gnomon::is_missing(r.surface[2].normal));
    EXPECT_EQ(r.surface[4].normal.z(), 1.0);
    EXPECT_GT(r.surface[0].normal.dot(r.surface[1].normal), 0.99);

    row far_off({0, 0, 0, 0});  // a link to a point that is not finite leads nowhere
    far_off.points[2].x() = 1e200;
    const auto parted = gnomon::propagate_orientation(
        far_off.points, neighborhoods{{1}, {2}, {}, {2}}, far_off.surface);
    EXPECT_EQ(parted.component, (std::vector<std::int32_t>{0, 0, -1, 1}));

    row self({0, 0});
    const auto lonely =
        gnomon::propagate_orientation(self.points, neighborhoods{{0}, {1}}, self.surface);
    EXPECT_EQ(lonely.components, 2u);
    EXPECT_EQ(lonely.confidence, (std::vector<double>{0, 0}));
}

TEST(propagate_orientation, rejects_invalid_input_and_changes_nothing) {
    const solid s = rough_scene();
    const auto graph = gnomon::knn{.k = 4}(s.points);
    auto surface = unoriented(s.points);
    const auto before = surface;
    const auto refuses = [&](const auto& points, const auto& g, auto& sf, double min_link = 0.0) {
        EXPECT_THROW(gnomon::propagate_orientation(points, g, sf, {.min_link = min_link}),
                     std::invalid_argument);
    };
    neighborhoods stray(s.points.size());
    stray.back().push_back(static_cast<gnomon::point_index>(s.points.size()));
    surface_elements fewer(s.points.size() - 1);
    refuses(s.points, neighborhoods(s.points.size() - 1), surface);
    refuses(s.points, stray, surface);
    refuses(s.points, graph, fewer);
    for (const double bad : {-0.1, 1.1, clouds::nan}) refuses(s.points, graph, surface, bad);
    refuses(gnomon::with_viewpoint(s.points, {clouds::nan, 0, 0}), graph, surface);
    refuses(s.points, gnomon::knn{.k = 0}, surface);
    for (std::size_t i = 0; i < surface.size(); ++i) {
        EXPECT_EQ(surface[i].normal, before[i].normal);
    }
}

/// Points and normals in one struct of the user's, seen through a projection.
TEST(propagate_orientation, takes_the_caller_s_own_types) {
    struct sample {
        Eigen::Vector3d place;
        Eigen::Vector3d normal;
    };
    solid sphere;
    sphere.add_sphere({0, 0, 0}, 200);
    std::vector<sample> mine;
    for (std::size_t i = 0; i < sphere.points.size(); ++i) {
        const double sign = i % 3 == 0 ? -1.0 : 1.0;
        mine.push_back({sphere.points[i], sign * sphere.outside[i]});
    }
    gnomon::propagate_orientation(mine, gnomon::knn{.k = 8}, mine, {}, gnomon::sequential{},
                                  &sample::place);
    for (const sample& m : mine) EXPECT_GT(m.normal.dot(m.place), 0.0);
}

/// A surface that cannot be written to is not taken.
template <class S>
concept taken = requires(const clouds::cloud& points, const neighborhoods& graph, S& surface) {
    gnomon::propagate_orientation(points, graph, surface);
};
static_assert(taken<surface_elements> && !taken<const surface_elements>);

}  // namespace
