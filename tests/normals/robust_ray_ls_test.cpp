// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <span>
#include <stdexcept>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/estimator_laws.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/normals/normal_quality.hpp>
#include <gnomon/normals/plane_eif.hpp>
#include <gnomon/normals/robust_ray_ls.hpp>

namespace {

using gnomon::constant_noise, gnomon::plane_eif, gnomon::robust_ray_ls, gnomon::trust;

constexpr double range_sigma = 0.02;
const robust_ray_ls robust_normal{.noise = constant_noise{range_sigma}};
const Eigen::Vector3d lidar_place(0.0, 0.0, 0.0);

/// The point where the ray in a direction meets the plane n . x = d, with noise along the ray.
Eigen::Vector3d seen(const Eigen::Vector3d& direction, const Eigen::Vector3d& n, double d,
                     gnomon::random_stream& random) {
    const Eigen::Vector3d u = direction.normalized();
    return (d / n.dot(u) + range_sigma * random.gaussian()) * u;
}

double degrees_off(const auto& belief, const Eigen::Vector3d& truth) {
    return gnomon::unoriented_angle(belief.normal, truth).degrees();
}

TEST(robust_ray_ls, is_plane_eif_without_outliers) {
    gnomon::random_stream random(1);
    const Eigen::Vector3d n = Eigen::Vector3d(1.0, 0.2, 0.3).normalized();
    const plane_eif reference{.noise = constant_noise{range_sigma}};
    int same = 0;
    for (int trial = 0; trial < 200; ++trial) {
        clouds::cloud points;
        for (int i = 0; i < 19; ++i)
            points.push_back(
                seen({1.0, random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1)}, n, 4.0, random));
        const auto belief = robust_normal(points[0], std::span(points).subspan(1), lidar_place);
        const auto expected = reference(points[0], std::span(points).subspan(1), lidar_place);
        if (belief.normal != expected.normal) continue;  // a point was off by chance
        ++same;
        EXPECT_EQ(belief.covariance, expected.covariance);
        EXPECT_EQ(belief.trust, expected.trust);
    }
    EXPECT_GT(same, 180);
}

/// At the edge of two walls a normal is that of the wall of the point.
TEST(robust_ray_ls, takes_the_plane_of_the_point) {
    gnomon::random_stream random(2);
    const Eigen::Vector3d left = Eigen::Vector3d(1.0, 1.0, 0.0).normalized();
    const Eigen::Vector3d right = Eigen::Vector3d(1.0, -1.0, 0.0).normalized();
    int near = 0, near_without = 0;
    constexpr int trials = 200;
    for (int trial = 0; trial < trials; ++trial) {
        clouds::cloud points{seen({1.0, 0.03, 0.0}, left, 3.0, random)};
        for (int i = 0; i < 40; ++i) {
            const double y = random.uniform(-0.13, 0.19);
            points.push_back(
                seen({1.0, y, random.uniform(-0.15, 0.15)}, y > 0.0 ? left : right, 3.0, random));
        }
        const auto others = std::span(points).subspan(1);
        near += degrees_off(robust_normal(points[0], others, lidar_place), left) < 15.0 ? 1 : 0;
        near_without +=
            degrees_off(plane_eif{}(points[0], others, lidar_place), left) < 15.0 ? 1 : 0;
    }
    EXPECT_GT(near, trials * 9 / 10);
    EXPECT_LT(near_without, trials / 10);
}

/// Twenty points of a scan line on a road and ten of a car next to it are on one plane; the road
/// before and behind the line has eight.
TEST(robust_ray_ls, counts_each_quadrant_alike) {
    gnomon::random_stream random(3);
    const Eigen::Vector3d up(0.0, 0.0, 1.0), front(1.0, 0.0, 0.0);
    const auto on_road = [&](double x, double y) { return seen({x, y, -2.0}, -up, 2.0, random); };
    int near = 0;
    constexpr int trials = 100;
    for (int trial = 0; trial < trials; ++trial) {
        clouds::cloud points{on_road(8.0, 0.0)};
        for (int i = -10; i <= 10; ++i)
            if (i != 0) points.push_back(on_road(8.0, 0.05 * i));
        for (int i = 0; i < 10; ++i)
            points.push_back(seen({8.2, random.uniform(-0.4, 0.4), random.uniform(-1.8, -1.4)},
                                  front, 8.2, random));
        for (int i = 0; i < 4; ++i) {
            points.push_back(on_road(6.8, 0.1 * i));
            points.push_back(on_road(7.4, 0.1 * i));
        }
        near += degrees_off(robust_normal(points[0], std::span(points).subspan(1), lidar_place),
                            up) < 5.0;
    }
    EXPECT_GT(near, trials * 9 / 10);
}

/// Where a road meets a car, a plane between the two is within three standard deviations of most
/// points near the edge; the road is within two of its own.
TEST(robust_ray_ls, takes_no_plane_between_two_surfaces) {
    gnomon::random_stream random(5);
    const Eigen::Vector3d up(0.0, 0.0, 1.0), front(1.0, 0.0, 0.0);
    int near = 0;
    constexpr int trials = 300;
    for (int trial = 0; trial < trials; ++trial) {
        clouds::cloud points{seen({5.92, 0.0, -2.0}, -up, 2.0, random)};
        for (int i = 0; i < 12; ++i) {
            const double y = random.uniform(-0.3, 0.3);
            points.push_back(seen({random.uniform(5.7, 6.0), y, -2.0}, -up, 2.0, random));
            points.push_back(seen({6.0, y, random.uniform(-2.0, -1.7)}, front, 6.0, random));
        }
        near += degrees_off(robust_normal(points[0], std::span(points).subspan(1), lidar_place),
                            up) < 15.0;
    }
    EXPECT_GT(near, trials * 8 / 10);
}

TEST(robust_ray_ls, of_a_stray_point_is_weak) {
    gnomon::random_stream random(4);
    clouds::cloud wall;
    for (int i = 0; i < 30; ++i)
        wall.push_back(seen({1.0, random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1)},
                            Eigen::Vector3d::UnitX(), 4.0, random));
    const Eigen::Vector3d stray(3.5, 0.0, 0.0);
    EXPECT_EQ(robust_normal(Eigen::Vector3d(4.0, 0.0, 0.0), wall, lidar_place).trust, trust::good);
    EXPECT_EQ(robust_normal(stray, wall, lidar_place).trust, trust::weak);
}

TEST(robust_ray_ls, reports_degenerate_neighborhoods) {
    const Eigen::Vector3d p(2, 0, 0);
    EXPECT_EQ(robust_normal(p, clouds::cloud{{2, 1, 0}, {2, 0, 1}}).trust,
              trust::too_few_neighbors);
    EXPECT_EQ(robust_normal(p, clouds::cloud{{2, 1, 0}, {2, 2, 0}, {2, -1, 0}}).trust,
              trust::degenerate);
    EXPECT_THROW((void)(robust_ray_ls{.noise = constant_noise{0.0}}(p, clouds::cloud(4, p))),
                 std::invalid_argument);
    EXPECT_THROW((void)(robust_ray_ls{.trials = 0}(p, clouds::cloud(4, p))), std::invalid_argument);
}

TEST(robust_ray_ls, laws_hold) {
    laws::estimator_laws(robust_ray_ls{});
    laws::covariances_are_bounded(robust_ray_ls{.noise = constant_noise{10.0}});
}

}  // namespace
