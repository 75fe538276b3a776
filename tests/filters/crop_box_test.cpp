// SPDX-License-Identifier: BSL-1.0
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/filters/crop_box.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace {

constexpr double without_end = std::numeric_limits<double>::infinity();

/// On a grid, so that points lie on the faces of boxes, with points that are not finite.
clouds::cloud cloud_to_crop(std::uint64_t seed) {
    clouds::cloud points = clouds::on_grid(2000, seed);
    const clouds::cloud others = clouds::in_cube(2000, seed);
    points.insert(points.end(), others.begin(), others.end());
    points[7] = {clouds::nan, 0, 0};
    points[1234] = {0, 0, clouds::infinity};
    points.back() = {0.5, clouds::nan, 0.5};
    return points;
}

std::vector<gnomon::point_index> those(const clouds::cloud& points, auto&& is_inside) {
    std::vector<gnomon::point_index> kept;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (points[i].allFinite() && is_inside(points[i]))
            kept.push_back(static_cast<gnomon::point_index>(i));
    return kept;
}

TEST(crop_box, keeps_the_points_of_a_closed_box_along_the_axes) {
    gnomon::random_stream random(3);
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const clouds::cloud points = cloud_to_crop(seed);
        const gnomon::spatial_index index(points);
        Eigen::Vector3d low, high;
        for (int a = 0; a < 3; ++a) {  // multiples of the grid's step, on which many points lie
            low[a] = 0.25 * std::floor(random.uniform(-2.0, 3.0));
            high[a] = low[a] + 0.25 * std::floor(random.uniform(0.0, 4.0));
        }
        if (seed % 4 == 0) low[2] = -without_end;
        if (seed % 5 == 0) high[0] = without_end;
        const auto expected = those(points, [&](const Eigen::Vector3d& p) {
            return (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
        });
        EXPECT_EQ(gnomon::crop_box(points, low, high), expected);
        EXPECT_EQ(gnomon::crop_box(index, low, high), expected);
    }
}

TEST(crop_box, keeps_the_points_of_an_oriented_box) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const Eigen::Vector3d far_away =
            seed % 2 == 0 ? Eigen::Vector3d(4e5, 5e6, 300) : Eigen::Vector3d(0, 0, 0);
        const clouds::cloud points =
            clouds::moved(cloud_to_crop(seed), Eigen::Matrix3d::Identity(), far_away);
        const gnomon::spatial_index index(points);
        gnomon::oriented_box box{.center = far_away + Eigen::Vector3d(0.4, 0.5, 0.6),
                                 .axes = clouds::random_rotation(seed),
                                 .lengths = {0.3, 0.7, 0.9}};
        if (seed % 3 == 0) box.lengths[1] = without_end;
        const auto expected = those(points, [&](const Eigen::Vector3d& p) {
            const Eigen::Vector3d local = box.axes.transpose() * (p - box.center);
            return (2.0 * local.array().abs() <= box.lengths.array()).all();
        });
        EXPECT_GT(expected.size(), 10u);
        EXPECT_EQ(gnomon::crop_box(points, box), expected);
        EXPECT_EQ(gnomon::crop_box(index, box), expected);
    }
    // Boxes whose axes are those of the coordinates: their ends may be infinite, and zero.
    const clouds::cloud points = cloud_to_crop(1);
    const gnomon::oriented_box slab{.center = {0, 0, 0.5},
                                    .lengths = {without_end, without_end, 0}};
    const auto expected = those(points, [](const Eigen::Vector3d& p) { return p.z() == 0.5; });
    EXPECT_GT(expected.size(), 0u);
    EXPECT_EQ(gnomon::crop_box(points, slab), expected);
    EXPECT_EQ(gnomon::crop_box(gnomon::spatial_index(points), slab), expected);
}

/// Axes rounded to float are off by 1e-7, which displaces the ends of a long thin box by more than
/// it is thick: with an index the result is the same.
TEST(crop_box, with_an_index_keeps_the_points_of_a_long_thin_box_with_rounded_axes) {
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        gnomon::random_stream random(seed);
        Eigen::Matrix3d axes = clouds::random_rotation(seed).cast<float>().cast<double>();
        if (seed % 2 == 0) {  // nearly along the coordinate axes
            axes = Eigen::Matrix3d::Identity();
            for (int i = 0; i < 9; ++i) axes.data()[i] += random.uniform(-3e-7, 3e-7);
        }
        const Eigen::Vector3d far_away =
            seed % 3 == 0 ? Eigen::Vector3d(4e5, 5e6, 300) : Eigen::Vector3d(0, 0, 0);
        gnomon::oriented_box box{.center = far_away, .axes = axes, .lengths = {100, 1, 0.05}};
        if (seed % 5 == 0) box.lengths[0] = 1e6;
        const Eigen::Matrix3d dual = axes.inverse().transpose();
        clouds::cloud points;
        for (int i = 0; i < 400; ++i) {  // near the corners
            Eigen::Vector3d y;
            for (int a = 0; a < 3; ++a)
                y[a] = (random.uniform() < 0.5 ? -0.5 : 0.5) * box.lengths[a];
            points.push_back(box.center + random.uniform(1 - 1e-9, 1 + 1e-12) * (dual * y));
        }
        const auto expected = gnomon::crop_box(points, box);
        EXPECT_GT(expected.size(), 100u);
        EXPECT_EQ(gnomon::crop_box(gnomon::spatial_index(points), box), expected);
    }
}

TEST(crop_box, keeps_nothing_of_nothing) {
    const clouds::cloud none, not_finite(3, {clouds::nan, 0, 0});
    for (const clouds::cloud& points : {none, not_finite}) {
        EXPECT_TRUE(gnomon::crop_box(points, {0, 0, 0}, {1, 1, 1}).empty());
        EXPECT_TRUE(gnomon::crop_box(gnomon::spatial_index(points), {0, 0, 0}, {1, 1, 1}).empty());
    }
}

TEST(crop_box, sees_points_through_a_projection) {
    struct hit {
        Eigen::Vector3f at;
    };
    const std::vector<hit> hits{{{0, 0, 0}}, {{2, 0, 0}}, {{1, 1, 1}}};
    EXPECT_EQ(gnomon::crop_box(hits, {0, 0, 0}, {1, 1, 1}, &hit::at),
              (std::vector<gnomon::point_index>{0, 2}));
}

TEST(crop_box, refuses_what_is_no_box) {
    const clouds::cloud points = clouds::in_cube(10, 1);
    const auto crop = [&](const auto&... box) {
        static_cast<void>(gnomon::crop_box(points, box...));
    };
    const Eigen::Vector3d zero(0, 0, 0), one(1, 1, 1), unknown(0, clouds::nan, 0);
    EXPECT_THROW(crop(one, zero), std::invalid_argument);
    EXPECT_THROW(crop(unknown, one), std::invalid_argument);
    EXPECT_THROW(crop(zero, unknown), std::invalid_argument);
    EXPECT_THROW(crop(gnomon::oriented_box{.lengths = {-1, 1, 1}}), std::invalid_argument);
}

}  // namespace
