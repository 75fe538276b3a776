// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/segmentation/join_surfaces_of_revolution.hpp>
#include <gnomon/segmentation/segment_surfaces.hpp>

namespace {

using gnomon::join_surfaces_of_revolution, gnomon::segments, gnomon::unlabeled;
using points_of_shape = std::vector<Eigen::Vector3d>;

constexpr double grid_step = 0.02;  // [m]

auto surface_of(const points_of_shape& points) {
    return gnomon::estimate_normals(points, gnomon::knn{.k = 50}, gnomon::plane_pca{});
}

segments strays(const points_of_shape& points) {
    return segments(std::vector<std::int32_t>(points.size(), unlabeled));
}

/// Noise along the normal and a random pose.
void put(points_of_shape& points, const points_of_shape& normals, double sigma,
         std::uint64_t seed) {
    gnomon::random_stream random(seed);
    const Eigen::Matrix3d turned = clouds::random_rotation(seed);
    const Eigen::Vector3d place = 3.0 * clouds::gaussian_vector(random);
    for (std::size_t i = 0; i < points.size(); ++i)
        points[i] = turned * (points[i] + sigma * random.gaussian() * normals[i]) + place;
}

/// The front of a surface of revolution, as far round its axis as is said [rad].
points_of_shape round_shape(const std::function<double(double)>& radius, double height,
                            double sigma, std::uint64_t seed, double round = std::numbers::pi) {
    points_of_shape points, normals;
    constexpr double step = 1e-4;
    for (double z = 0.5 * grid_step; z < height;) {
        const double r = radius(z), slope = (radius(z + step) - radius(z - step)) / (2.0 * step);
        for (double a = -0.5 * round; r > 0.0 && a <= 0.5 * round; a += grid_step / r) {
            points.emplace_back(r * std::cos(a), r * std::sin(a), z);
            normals.push_back(Eigen::Vector3d(std::cos(a), std::sin(a), -slope).normalized());
        }
        z += grid_step / std::sqrt(1.0 + slope * slope);
    }
    put(points, normals, sigma, seed);
    return points;
}

double of_vase(double z) { return 0.12 + 0.05 * std::sin(13.0 * z); }
double of_cylinder(double) { return 0.12; }
double of_cone(double z) { return 0.22 - 0.4 * z; }
double of_ball(double z) { return std::sqrt(std::max(0.0, 0.15 * 0.15 - (z - 0.15) * (z - 0.15))); }

/// Two or three faces of a box, with edges of these lengths.
points_of_shape box(double a, double b, double c, int faces, double sigma, std::uint64_t seed) {
    points_of_shape points, normals;
    const Eigen::Vector3d x(a, 0, 0), y(0, b, 0), z(0, 0, c);
    const auto add_face = [&](const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
        for (double s = 0.5 * grid_step; s < u.norm(); s += grid_step) {
            for (double t = 0.5 * grid_step; t < v.norm(); t += grid_step) {
                points.emplace_back(s * u.normalized() + t * v.normalized());
                normals.push_back(gnomon::detail::cross(u, v).normalized());
            }
        }
    };
    add_face(x, z);
    add_face(y, z);
    if (faces > 2) add_face(x, y);
    put(points, normals, sigma, seed);
    return points;
}

TEST(join_surfaces_of_revolution, vases_cylinders_cones_and_balls_are_one_segment) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const double sigma = seed % 2 == 0 ? 0.015 : 0.0;
        for (const points_of_shape& points :
             {round_shape(of_vase, 0.6, sigma, seed), round_shape(of_cylinder, 0.3, sigma, seed),
              round_shape(of_cone, 0.35, sigma, seed), round_shape(of_ball, 0.3, sigma, seed)}) {
            const segments joined =
                join_surfaces_of_revolution(points, surface_of(points), strays(points));
            ASSERT_EQ(joined.size(), 1u) << points.size() << " points, seed " << seed;
            EXPECT_EQ(joined[0].size(), points.size());
        }
    }
}

/// Alg. 4.2 oversegments a narrow vase; its segments are joined.
TEST(join_surfaces_of_revolution, joins_the_segments_of_an_oversegmented_vase) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const points_of_shape points = round_shape(of_vase, 0.6, 0.015, seed);
        const auto surface = surface_of(points);
        const segments scraps = gnomon::segment_surfaces(points, surface);
        EXPECT_LT(scraps.empty() ? 0 : scraps[0].size(), points.size() / 2);
        const segments joined = join_surfaces_of_revolution(points, surface, scraps);
        ASSERT_EQ(joined.size(), 1u);
        EXPECT_EQ(joined[0].size(), points.size());
    }
}

/// Blended by 50 neighbors, edges are as round as a vase.
TEST(join_surfaces_of_revolution, boxes_boards_and_disks_stay_as_they_were) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const double sigma = seed % 2 == 0 ? 0.015 : 0.0;
        const auto disk = [&] {
            points_of_shape points, normals;
            for (double x = -0.2; x < 0.2; x += grid_step)
                for (double y = -0.2; y < 0.2; y += grid_step)
                    if (x * x + y * y < 0.04) points.emplace_back(x, y, 0.0);
            normals.resize(points.size(), Eigen::Vector3d::UnitZ());
            put(points, normals, sigma, seed);
            return points;
        };
        for (const points_of_shape& points :
             {box(0.2, 0.2, 0.4, 2, sigma, seed), box(0.3, 0.3, 0.3, 3, sigma, seed),
              box(0.4, 0.25, 0.15, 3, sigma, seed), box(0.4, 0.06, 0.5, 2, sigma, seed), disk()})
            EXPECT_EQ(join_surfaces_of_revolution(points, surface_of(points), strays(points)),
                      strays(points))
                << points.size() << " points, seed " << seed;
    }
}

/// A fifth of a round: what turns so little may be a board that is warped.
TEST(join_surfaces_of_revolution, keeps_surfaces_that_turn_too_little) {
    const auto gutter = [](double round) {
        return round_shape([](double) { return 0.2; }, 0.5, 0.0, 1, round);
    };
    const points_of_shape slight = gutter(1.3), deep = gutter(1.8);
    EXPECT_EQ(join_surfaces_of_revolution(slight, surface_of(slight), strays(slight)),
              strays(slight));
    EXPECT_EQ(join_surfaces_of_revolution(deep, surface_of(deep), strays(deep)).size(), 1u);
}

/// A low tin with its lid: all normals meet the axis, but most of them along it.
TEST(join_surfaces_of_revolution, a_lid_is_no_vase) {
    points_of_shape tin = round_shape(of_cylinder, 0.04, 0.0, 0);
    const Eigen::Matrix3d turned = clouds::random_rotation(0);
    const Eigen::Vector3d place = tin[0] - turned * Eigen::Vector3d(0.0, -0.12, 0.5 * grid_step);
    for (double x = 0.0; x < 0.12; x += grid_step)
        for (double y = -0.12; y < 0.12; y += grid_step)
            if (x * x + y * y < 0.0144)
                tin.emplace_back(turned * Eigen::Vector3d(x, y, 0.04) + place);
    auto surface = surface_of(tin);
    for (std::size_t i = 0; i < tin.size(); ++i) {  // without the blended ones at the edge
        const Eigen::Vector3d p = turned.transpose() * (tin[i] - place);
        const bool of_lid = p.z() > 0.0399;
        surface[i].normal =
            turned * (of_lid ? Eigen::Vector3d(0, 0, 1) : Eigen::Vector3d(p.x(), p.y(), 0) / 0.12);
    }
    EXPECT_EQ(join_surfaces_of_revolution(tin, surface, strays(tin)), strays(tin));
}

/// Some normals are quite wrong, and some half so: more than one in five of them.
TEST(join_surfaces_of_revolution, needs_most_of_the_normals) {
    const points_of_shape points = round_shape(of_cylinder, 0.3, 0.0, 1);
    const Eigen::Vector3d axis = clouds::random_rotation(1).col(2);
    auto surface = surface_of(points);
    EXPECT_EQ(join_surfaces_of_revolution(points, surface, strays(points)).size(), 1u);
    const auto turn = [&](std::size_t i, double angle) {
        Eigen::Vector3d& n = surface[i].normal;
        n = std::cos(angle) * n + std::sin(angle) * gnomon::detail::cross(axis, n);
    };
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (i % 50 < 4) turn(i, 0.5 * std::numbers::pi);
        if (i % 50 >= 44) turn(i, 0.2 * std::numbers::pi);
    }
    EXPECT_EQ(join_surfaces_of_revolution(points, surface, strays(points)), strays(points));
}

TEST(join_surfaces_of_revolution, is_of_a_size) {
    const points_of_shape points = round_shape(of_cylinder, 0.3, 0.0, 1);
    const auto surface = surface_of(points);
    const auto joins = [&](const gnomon::join_surfaces_of_revolution_options& options) {
        return !join_surfaces_of_revolution(points, surface, strays(points), options).empty();
    };
    EXPECT_TRUE(joins({.max_radius = 0.13}));
    EXPECT_FALSE(joins({.max_radius = 0.11}));
    EXPECT_TRUE(joins({.sigma = 0.05}));
    EXPECT_FALSE(joins({.sigma = 0.07}));
    EXPECT_TRUE(joins({.min_points = points.size()}));
    EXPECT_FALSE(joins({.min_points = points.size() + 1}));
    EXPECT_FALSE(joins({.max_distance = 0.5 * grid_step}));
}

/// A vase in shreds on something of another segment: a long board, or a small piece of a table,
/// whose normals meet the axis as well as any. Either keeps its points, and the vase is whole.
TEST(join_surfaces_of_revolution, the_support_of_a_vase_keeps_its_points) {
    for (const double length : {0.1, 1.5}) {
        points_of_shape points;
        std::vector<std::int32_t> labels;
        for (double y = -length; y < length; y += grid_step)
            for (double x = 0.12; x < 0.24; x += grid_step) points.emplace_back(x, y, 0.0);
        const std::size_t below = points.size();
        labels.resize(below, 0);
        for (double z = 0.5 * grid_step; z < 0.6; z += grid_step)
            for (double a = -1.5; a <= 1.5; a += grid_step / 0.12)
                points.emplace_back(0.12 * std::cos(a), 0.12 * std::sin(a), z);
        labels.resize(points.size(), unlabeled);
        auto surface = surface_of(points);
        for (std::size_t i = 0; i < below; ++i) surface[i].normal = Eigen::Vector3d(0, 0, 1);
        const segments joined = join_surfaces_of_revolution(points, surface, segments(labels));
        ASSERT_EQ(joined.size(), 2u) << length;
        const std::int32_t of_board = joined.labels()[0], of_vase = joined.labels().back();
        for (std::size_t i = 0; i < points.size(); ++i)
            EXPECT_EQ(joined.labels()[i], i < below ? of_board : of_vase);
    }
}

/// A column against a wall: the wall keeps its points, and the column takes no part of it.
TEST(join_surfaces_of_revolution, wide_segments_keep_their_points) {
    points_of_shape points;
    std::vector<std::int32_t> labels;
    for (double y = -0.4; y < 0.4; y += grid_step) {
        for (double z = 0.0; z < 0.8; z += grid_step) {
            if (std::abs(y) < 0.12) continue;
            points.emplace_back(0.0, y, z);
            labels.push_back(0);
        }
    }
    const std::size_t of_wall = points.size();
    for (double z = 0.0; z < 0.8; z += grid_step) {
        for (double a = -1.5; a <= 1.5; a += grid_step / 0.12) {
            points.emplace_back(0.12 * std::cos(a), 0.12 * std::sin(a), z);
            labels.push_back(a < -0.5 ? 1 : a < 0.5 ? unlabeled : 2);
        }
    }
    const segments joined =
        join_surfaces_of_revolution(points, surface_of(points), segments(labels));
    ASSERT_EQ(joined.size(), 2u);
    EXPECT_EQ(joined[0].size(), of_wall);
    EXPECT_EQ(joined[0].back(), of_wall - 1);
}

/// All of a segment goes, also the points without a normal; strays without one stay strays.
TEST(join_surfaces_of_revolution, points_without_a_normal_go_with_their_segments) {
    points_of_shape points = round_shape(of_cylinder, 0.3, 0.0, 1);
    auto surface = surface_of(points);
    std::vector<std::int32_t> labels(points.size(), unlabeled);
    std::fill(labels.begin() + 100, labels.begin() + 150, 0);
    for (const std::size_t i : {120u, 20u}) surface[i].normal.setZero();
    points[30] = Eigen::Vector3d::Constant(clouds::nan);
    surface[40].normal = surface[130].normal = Eigen::Vector3d::Constant(clouds::nan);
    const segments joined = join_surfaces_of_revolution(points, surface, segments(labels));
    ASSERT_EQ(joined.size(), 1u);
    EXPECT_EQ(joined[0].size(), points.size() - 3);
    for (const std::size_t i : {120u, 130u}) EXPECT_EQ(joined.labels()[i], 0);
    for (const std::size_t i : {20u, 30u, 40u}) EXPECT_EQ(joined.labels()[i], unlabeled);
}

TEST(join_surfaces_of_revolution, depends_on_no_order_place_or_thread) {
    points_of_shape points;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        points_of_shape more = seed % 3 == 0 ? box(0.3, 0.3, 0.3, 3, 0.01, seed)
                                             : round_shape(of_vase, 0.6, 0.01, seed);
        for (Eigen::Vector3d& p : more)
            p += Eigen::Vector3d(20.0 * static_cast<double>(seed), 0, 0);
        points.insert(points.end(), more.begin(), more.end());
    }
    const auto surface = surface_of(points);
    const segments parts = gnomon::segment_surfaces(points, surface);
    const segments joined = join_surfaces_of_revolution(points, surface, parts);
    EXPECT_GT(std::ranges::count(parts.labels(), unlabeled),
              std::ranges::count(joined.labels(), unlabeled));
    for (const unsigned n : {2u, 4u})
        EXPECT_EQ(join_surfaces_of_revolution(points, surface, parts, {}, gnomon::threads{n}),
                  joined);

    points_of_shape moved(points.rbegin(), points.rend());
    for (Eigen::Vector3d& p : moved) p += Eigen::Vector3d(524288.0, 4194304.0, -64.0);
    const auto surface_moved = surface_of(moved);
    const auto parts_moved = gnomon::segment_surfaces(moved, surface_moved);
    std::vector<std::int32_t> found =
        join_surfaces_of_revolution(moved, surface_moved, parts_moved).labels();
    std::ranges::reverse(found);
    for (std::size_t s = 0; s < joined.size(); ++s) {  // of the same points, whatever the number
        const std::int32_t there = found[joined[s].front()];
        EXPECT_EQ(std::ranges::count(found, there), static_cast<std::ptrdiff_t>(joined[s].size()));
        for (const auto i : joined[s]) EXPECT_EQ(found[i], there);
    }
}

TEST(join_surfaces_of_revolution, takes_a_projection) {
    const points_of_shape points = round_shape(of_vase, 0.6, 0.01, 1);
    std::vector<std::pair<int, Eigen::Vector3d>> named;
    for (const Eigen::Vector3d& p : points) named.emplace_back(7, p);
    const auto place = [](const auto& n) -> const Eigen::Vector3d& { return n.second; };
    EXPECT_EQ(join_surfaces_of_revolution(named, surface_of(points), strays(points), {},
                                          gnomon::sequential{}, place)
                  .size(),
              1u);
}

TEST(join_surfaces_of_revolution, refuses_bad_input) {
    const points_of_shape points = round_shape(of_cylinder, 0.3, 0.0, 1);
    const auto surface = surface_of(points);
    const auto refused = [&](const gnomon::join_surfaces_of_revolution_options& options) {
        EXPECT_THROW(static_cast<void>(
                         join_surfaces_of_revolution(points, surface, strays(points), options)),
                     std::invalid_argument);
    };
    for (const double bad : {-1.0, clouds::nan}) {
        refused({.sigma = bad});
        refused({.max_radius = bad});
        refused({.max_distance = bad});
    }
    const points_of_shape fewer(points.begin(), points.end() - 1);
    EXPECT_THROW(static_cast<void>(join_surfaces_of_revolution(points, surface, strays(fewer))),
                 std::invalid_argument);
    EXPECT_THROW(
        static_cast<void>(join_surfaces_of_revolution(points, surface_of(fewer), strays(points))),
        std::invalid_argument);
    const points_of_shape none;
    EXPECT_TRUE(join_surfaces_of_revolution(none, surface_of(none), strays(none)).empty());
    const points_of_shape one_place(100, Eigen::Vector3d(1, 2, 3));
    EXPECT_TRUE(
        join_surfaces_of_revolution(one_place, surface_of(one_place), strays(one_place)).empty());
}

}  // namespace
