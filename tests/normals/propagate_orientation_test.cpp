// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/orient.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/normals/propagate_orientation.hpp>
#include <gnomon/simulation/simulate.hpp>
#include <gnomon/simulation/thesis_scenes.hpp>

namespace {

using rings = std::vector<std::vector<gnomon::point_index>>;
using surface_elements = std::vector<gnomon::surfel<gnomon::plane_fit>>;

/// Points of closed surfaces, with the outer normal that each should get.
struct solid {
    clouds::cloud points;
    clouds::cloud outside;

    void add(const Eigen::Vector3d& p, const Eigen::Vector3d& n) {
        points.push_back(p);
        outside.push_back(n);
    }

    void add_sphere(const Eigen::Vector3d& center, std::size_t n, double sigma = 0.0) {
        gnomon::random_stream random(n);
        for (std::size_t i = 0; i < n; ++i) {
            const Eigen::Vector3d u = clouds::gaussian_vector(random).normalized();
            add(center + u * (1.0 + sigma * random.gaussian()), u);
        }
    }

    /// `per_square_meter` points on each side, with noise along the normal.
    void add_box(const Eigen::Vector3d& half, double per_square_meter, double sigma = 0.0) {
        gnomon::random_stream random(static_cast<std::uint64_t>(per_square_meter));
        for (int side = 0; side < 6; ++side) {
            const int a = side / 2;
            const int b = (a + 1) % 3;
            const int c = (a + 2) % 3;
            Eigen::Vector3d n(0, 0, 0);
            n[a] = side % 2 == 0 ? 1.0 : -1.0;
            const double points_on_side = 4 * half[b] * half[c] * per_square_meter;
            for (int i = 0; i < static_cast<int>(points_on_side); ++i) {
                Eigen::Vector3d p;
                p[a] = n[a] * half[a] + sigma * random.gaussian();
                p[b] = random.uniform(-half[b], half[b]);
                p[c] = random.uniform(-half[c], half[c]);
                add(p, n);
            }
        }
    }

    void add_torus(std::size_t n) {
        gnomon::random_stream random(n);
        for (std::size_t i = 0; i < n; ++i) {
            const double u = random.uniform(0.0, 2 * std::numbers::pi);
            const double v = random.uniform(0.0, 2 * std::numbers::pi);
            const Eigen::Vector3d spoke(std::cos(u), std::sin(u), 0);
            const Eigen::Vector3d m = spoke * std::cos(v) + Eigen::Vector3d(0, 0, std::sin(v));
            add(spoke + 0.3 * m, m);
        }
    }

    /// Of radius 0.2 and height 1, with both lids.
    void add_cylinder(std::size_t n) {
        gnomon::random_stream random(n);
        for (std::size_t i = 0; i < n; ++i) {
            const double u = random.uniform(0.0, 2 * std::numbers::pi);
            const Eigen::Vector3d spoke(std::cos(u), std::sin(u), 0);
            const double z = random.uniform();
            if (i % 6 == 0) {
                const double up = i % 12 == 0 ? 1.0 : 0.0;
                add({0.2 * std::sqrt(z) * spoke.x(), 0.2 * std::sqrt(z) * spoke.y(), up},
                    {0, 0, 2 * up - 1});
            } else {
                add(0.2 * spoke + Eigen::Vector3d(0, 0, z), spoke);
            }
        }
    }
};

void scramble_signs(auto& surface, std::uint64_t seed) {
    gnomon::random_stream random(seed);
    for (auto& s : surface) {
        if (random.bits() % 2 == 0) s.normal = -s.normal;
    }
}

/// Normals of k neighbors, of random sign.
surface_elements unoriented(const clouds::cloud& points, std::size_t k = 12) {
    auto surface = gnomon::estimate_normals(points, gnomon::knn{.k = k}, gnomon::plane_pca{});
    scramble_signs(surface, 99);
    return surface;
}

/// The part of the points with normals for which is_right(i).
double part_right(const gnomon::orientation& o, auto&& is_right) {
    double right = 0.0;
    double all = 0.0;
    for (std::size_t i = 0; i < o.component.size(); ++i) {
        if (o.component[i] < 0) continue;
        all += 1.0;
        if (is_right(i)) right += 1.0;
    }
    return right / all;
}

/// Whether a point's normal looks out of the solid.
auto outwards(const surface_elements& surface, const solid& s) {
    return [&](std::size_t i) { return surface[i].normal.dot(s.outside[i]) > 0.0; };
}

/// The probability that a wrong point has less confidence than a right one (area under the ROC).
double area_under_curve(const gnomon::orientation& o, auto&& is_right) {
    std::vector<std::pair<double, bool>> sorted;
    for (std::size_t i = 0; i < o.component.size(); ++i) {
        if (o.component[i] >= 0) sorted.push_back({o.confidence[i], is_right(i)});
    }
    std::sort(sorted.begin(), sorted.end());
    double wrong = 0.0;
    double right = 0.0;
    double pairs = 0.0;
    for (const auto& [confidence, is] : sorted) {
        (is ? right : wrong) += 1.0;
        if (is) pairs += wrong;
    }
    return pairs / (wrong * right);
}

TEST(propagate_orientation, closed_surfaces_look_outwards) {
    solid sphere;
    sphere.add_sphere({3, -2, 1}, 1000);
    solid coarse_sphere;
    coarse_sphere.add_sphere({0, 0, 0}, 100);
    solid torus;
    torus.add_torus(4000);
    solid cylinder;
    cylinder.add_cylinder(4800);
    solid box;
    box.add_box({0.5, 0.3, 0.2}, 3000);
    for (const solid* s : {&sphere, &coarse_sphere, &torus, &cylinder, &box}) {
        auto surface = unoriented(s->points);
        const auto o = gnomon::propagate_orientation(s->points, gnomon::knn{.k = 12}, surface);
        EXPECT_EQ(o.components, 1u);
        // At a corner of the box an estimated normal may be at right angles to the true one.
        EXPECT_GE(part_right(o, outwards(surface, *s)), s == &box ? 0.999 : 1.0);
        EXPECT_GT(*std::min_element(o.confidence.begin(), o.confidence.end()), 0.5);
    }
}

/// True normals turn by a right angle from one point to the next.
TEST(propagate_orientation, crosses_sharp_edges) {
    solid box;
    box.add_box({0.5, 0.3, 0.2}, 300);
    surface_elements surface(box.points.size());
    for (std::size_t i = 0; i < surface.size(); ++i) surface[i].normal = box.outside[i];
    scramble_signs(surface, 3);
    const auto o = gnomon::propagate_orientation(box.points, gnomon::knn{.k = 12}, surface);
    EXPECT_EQ(part_right(o, outwards(surface, box)), 1.0);
    for (const double confidence : o.confidence) EXPECT_GT(confidence, 0.45);

    // c = a b / (a^2 + b^2) for distances a and b from the edge: such links can be refused.
    const auto sides = gnomon::propagate_orientation(box.points, gnomon::knn{.k = 12}, surface,
                                                     {.min_link = 0.51});
    EXPECT_EQ(sides.components, 6u);
    for (std::size_t i = 1; i < surface.size(); ++i) {
        const bool same_side = box.outside[i] == box.outside[i - 1];
        EXPECT_EQ(sides.component[i] == sides.component[i - 1], same_side);
    }
}

TEST(propagate_orientation, separate_objects_each_look_outwards) {
    solid two;
    two.add_sphere({5, 0, 0}, 500);
    two.add_sphere({0, 0, 0}, 900);
    auto surface = unoriented(two.points);
    const auto o = gnomon::propagate_orientation(two.points, gnomon::knn{.k = 12}, surface);
    EXPECT_EQ(o.components, 2u);
    for (std::size_t i = 0; i < two.points.size(); ++i) EXPECT_EQ(o.component[i], i < 500 ? 1 : 0);
    EXPECT_EQ(part_right(o, outwards(surface, two)), 1.0);
}

/// A board of 2 cm. At 5 mm between the points, rings of 12 stay on their own side; at 10 mm many
/// reach through the board, and what reaches must not persuade. (At 18 mm all do, and nothing that
/// looks at links alone can tell the two sides.)
TEST(propagate_orientation, tells_the_two_sides_of_a_thin_board) {
    for (const double spacing : {0.005, 0.010}) {
        solid board;
        board.add_box({0.3, 0.3, 0.01}, 1.0 / (spacing * spacing));
        auto surface = unoriented(board.points);
        const auto o = gnomon::propagate_orientation(board.points, gnomon::knn{.k = 12}, surface);
        const auto right = outwards(surface, board);
        std::printf("board at %.0f mm: %.4f right\n", 1000 * spacing, part_right(o, right));
        if (spacing < 0.007) {
            EXPECT_GT(part_right(o, right), 0.9995);
        } else {
            EXPECT_GT(part_right(o, right), 0.97);
            EXPECT_GT(area_under_curve(o, right), 0.9);
        }
    }
}

TEST(propagate_orientation, survives_noise_and_knows_where_it_fails) {
    solid box;
    box.add_box({0.5, 0.3, 0.2}, 3000, 0.005);
    solid rough_box;
    rough_box.add_box({0.5, 0.3, 0.2}, 3000, 0.010);  // half the distance between the points
    solid sphere;
    sphere.add_sphere({0, 0, 0}, 3000, 0.05);
    for (const auto& [s, k] : {std::pair{&box, 12}, {&rough_box, 30}, {&sphere, 30}}) {
        auto surface = unoriented(s->points, static_cast<std::size_t>(k));
        const auto o = gnomon::propagate_orientation(s->points, gnomon::knn{.k = 12}, surface);
        EXPECT_GT(part_right(o, outwards(surface, *s)), 0.99);
    }
    for (const solid* s : {&rough_box, &sphere}) {  // too few neighbors for so much noise
        auto surface = unoriented(s->points, 12);
        const auto o = gnomon::propagate_orientation(s->points, gnomon::knn{.k = 12}, surface);
        const double part = part_right(o, outwards(surface, *s));
        const double area = area_under_curve(o, outwards(surface, *s));
        std::printf("rough: %.4f right, area under curve %.3f\n", part, area);
        EXPECT_GT(part, 0.98);
        EXPECT_LT(part, 1.0);
        EXPECT_GT(area, 0.8);
    }
}

/// Held against Eq. (3.20), the truth, where the surface is not grazed: there noise turns a normal
/// past the view point. View points decide for whole components only, of which there are few.
TEST(propagate_orientation, agrees_with_the_view_point_of_the_kitchen) {
    const gnomon::scene kitchen = gnomon::scenes::kitchen();
    const struct {
        double sigma;
        double min_link;
        double agreement;
    } cases[] = {{0.0, 0.0, 0.9999}, {0.005, 0.0, 0.999}, {0.015, 0.0, 0.98}, {0.015, 0.8, 0.984}};
    for (const auto& [sigma, min_link, agreement] : cases) {
        const auto scan = gnomon::simulate(kitchen, gnomon::rotational{.mount = kitchen.sensor}, {},
                                           {.sigma = sigma})
                              .scan;
        const auto graph = gnomon::knn{.k = 12}(scan);
        auto surface = unoriented(scan.points, 30);
        auto truth = surface;
        gnomon::orient_normals(scan, truth);
        const auto o = gnomon::propagate_orientation(scan, graph, surface, {.min_link = min_link});

        const auto same = [&](std::size_t i) { return surface[i].normal == truth[i].normal; };
        const auto same_or_grazed = [&](std::size_t i) {
            const Eigen::Vector3d ray = scan.points[i] - scan.viewpoints[i];
            return same(i) || truth[i].normal.dot(ray) > -0.1 * ray.norm();
        };
        const double all = part_right(o, same);
        const double seen_well = part_right(o, same_or_grazed);
        const double area = area_under_curve(o, same);
        std::printf(
            "kitchen, sigma %2.0f mm, links over %.1f: %.4f agree, %.4f but for grazed ones, "
            "%zu components, area under curve %.3f\n",
            1000 * sigma, min_link, all, seen_well, o.components, area);
        EXPECT_GT(seen_well, agreement);
        EXPECT_TRUE(sigma < 0.01 || area > 0.85);
    }
}

/// A sphere seen from its center, from outside, and by nobody.
TEST(propagate_orientation, view_points_decide_for_a_component) {
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
TEST(propagate_orientation, an_outlier_does_not_decide) {
    solid sphere;
    sphere.add_sphere({0, 0, 0}, 300);
    sphere.add({1, 0, 0}, {1, 0, 0});
    const auto around = gnomon::knn{.k = 12}(sphere.points);
    rings graph;
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
TEST(propagate_orientation, a_plane_looks_up) {
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

/// |<n_i, n_j>| of Hoppe et al. would be 1 for the first three and 0 at both edges.
TEST(propagate_orientation, weighs_links_by_what_leaves_the_tangent_planes) {
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
    const rings graph{{1}, {2}, {3}, {4}, {0}};
    const auto o = gnomon::propagate_orientation(r.points, graph, r.surface);
    const auto c = [](double degrees) { return std::cos(degrees * std::numbers::pi / 180.0); };
    for (const std::size_t i : {0u, 1u, 2u}) EXPECT_NEAR(o.confidence[i], c(10), 1e-12) << i;
    for (const std::size_t i : {3u, 4u}) EXPECT_NEAR(o.confidence[i], c(60), 1e-12) << i;
    EXPECT_LT(r.surface[0].normal.dot(r.surface[4].normal), 0.0);  // 100 degrees, step by step

    // Of two equal halves the one of the stronger link is the core, wherever it stands.
    for (const bool front : {true, false}) {
        row halves(front ? std::vector<double>{0, 10, 50, 70} : std::vector<double>{0, 20, 60, 70});
        const auto h =
            gnomon::propagate_orientation(halves.points, rings{{1}, {2}, {3}, {}}, halves.surface);
        EXPECT_NEAR(h.confidence[0], front ? c(10) : c(40), 1e-12);
        EXPECT_NEAR(h.confidence[3], front ? c(40) : c(10), 1e-12);
    }

    const auto cut =
        gnomon::propagate_orientation(r.points, graph, r.surface, {.min_link = c(60) + 0.01});
    EXPECT_EQ(cut.component, (std::vector<std::int32_t>{0, 0, 0, 1, 1}));
    EXPECT_NEAR(cut.confidence[3], c(20), 1e-12);
}

TEST(propagate_orientation, a_graph_is_read_in_both_directions) {
    solid sphere;
    sphere.add_sphere({0, 0, 0}, 300);
    const auto graph = gnomon::knn{.k = 10}(sphere.points);
    rings both(graph.size());
    rings one(graph.size());
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

TEST(propagate_orientation, leaves_alone_what_has_no_normal_or_no_link) {
    row r({0, 180, 0, 180, 0});
    r.surface[2].normal = {0, 0, 0};
    r.surface[4].normal = {0, clouds::nan, 1};
    const auto o =
        gnomon::propagate_orientation(r.points, rings{{1}, {2}, {3}, {4}, {0}}, r.surface);
    EXPECT_EQ(o.component, (std::vector<std::int32_t>{0, 0, -1, 1, -1}));
    EXPECT_EQ(o.confidence, (std::vector<double>{1, 1, 0, 0, 0}));
    EXPECT_TRUE(gnomon::is_missing(r.surface[2].normal));
    EXPECT_EQ(r.surface[4].normal.z(), 1.0);
    EXPECT_GT(r.surface[0].normal.dot(r.surface[1].normal), 0.99);

    row far_off({0, 0, 0, 0});  // a link to a point that is not finite leads nowhere
    far_off.points[2].x() = 1e200;
    const auto parted =
        gnomon::propagate_orientation(far_off.points, rings{{1}, {2}, {}, {2}}, far_off.surface);
    EXPECT_EQ(parted.component, (std::vector<std::int32_t>{0, 0, -1, 1}));

    row self({0, 0});
    const auto lonely = gnomon::propagate_orientation(self.points, rings{{0}, {1}}, self.surface);
    EXPECT_EQ(lonely.components, 2u);
    EXPECT_EQ(lonely.confidence, (std::vector<double>{0, 0}));
}

TEST(propagate_orientation, refuses_bad_input_and_changes_nothing) {
    const solid s = rough_scene();
    const auto graph = gnomon::knn{.k = 4}(s.points);
    auto surface = unoriented(s.points);
    const auto before = surface;
    const auto refuses = [&](const auto& points, const auto& g, auto& sf, double min_link = 0.0) {
        EXPECT_THROW(gnomon::propagate_orientation(points, g, sf, {.min_link = min_link}),
                     std::invalid_argument);
    };
    rings stray(s.points.size());
    stray.back().push_back(static_cast<gnomon::point_index>(s.points.size()));
    surface_elements fewer(s.points.size() - 1);
    refuses(s.points, rings(s.points.size() - 1), surface);
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
concept taken = requires(const clouds::cloud& points, const rings& graph, S& surface) {
    gnomon::propagate_orientation(points, graph, surface);
};
static_assert(taken<surface_elements> && !taken<const surface_elements>);

}  // namespace
