// SPDX-License-Identifier: BSL-1.0
#include <array>
#include <string>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/point.hpp>

namespace own {
struct polar {
    float range;
};
struct pcl_like {
    float x, y, z;
    float intensity;
};
struct ticks {
    int x, y, z;
};
}  // namespace own

template <>
struct gnomon::point_traits<own::polar> {
    using scalar = float;
    static Eigen::Vector3f coordinates(const own::polar& p) { return {p.range, 0, 0}; }
};

namespace {

using gnomon::point;

static_assert(point<Eigen::Vector3d> && point<Eigen::Vector3f> && point<Eigen::RowVector3d>);
static_assert(point<std::array<float, 3>> && point<double[3]>);
static_assert(point<own::pcl_like> && point<own::polar>);
static_assert(!point<int> && !point<std::string> && !point<own::ticks>);
static_assert(!point<Eigen::Vector4d> && !point<Eigen::VectorXd> && !point<Eigen::Vector3i>);
// Expressions may refer to temporaries; blocks and maps refer to what stays.
static_assert(!point<decltype(Eigen::Vector3d() + Eigen::Vector3d())>);
static_assert(!point<decltype(-Eigen::Vector3d())>);
static_assert(point<decltype(std::declval<Eigen::Matrix3Xd&>().col(0))>);
static_assert(point<Eigen::Map<Eigen::Vector3f>>);
static_assert(!point<std::array<int, 3>> && !point<std::array<double, 2>>);

TEST(point, position_is_the_same_through_every_interface) {
    const Eigen::Vector3d expected(1.5, -2.25, 3.0);
    EXPECT_EQ(gnomon::position(expected), expected);
    EXPECT_EQ(gnomon::position(Eigen::Vector3f(1.5f, -2.25f, 3.0f)), expected);
    EXPECT_EQ(gnomon::position(Eigen::RowVector3d(1.5, -2.25, 3.0)), expected);
    EXPECT_EQ(gnomon::position(std::array<float, 3>{1.5f, -2.25f, 3.0f}), expected);
    EXPECT_EQ(gnomon::position(own::pcl_like{1.5f, -2.25f, 3.0f, 9.0f}), expected);
    EXPECT_EQ(gnomon::position(own::polar{2.0f}), Eigen::Vector3d(2, 0, 0));
    const double array[3] = {1.5, -2.25, 3.0};
    EXPECT_EQ(gnomon::position(array), expected);
    const Eigen::Matrix3d columns = expected * Eigen::RowVector3d::Ones();
    EXPECT_EQ(gnomon::position(columns.col(1)), expected);
}

TEST(point, finite_means_that_squares_do_not_overflow) {
    using clouds::infinity, clouds::nan;
    EXPECT_TRUE(gnomon::is_finite({0, -1e149, 3}));
    EXPECT_FALSE(gnomon::is_finite({nan, 0, 0}));
    EXPECT_FALSE(gnomon::is_finite({0, infinity, 0}));
    EXPECT_FALSE(gnomon::is_finite({0, 0, -infinity}));
    EXPECT_FALSE(gnomon::is_finite({0, 0, 1e150}));
}

TEST(point, squared_distance_is_symmetric_to_the_bit) {
    const auto points = clouds::in_cube(100, 1);
    for (const auto& p : points) {
        for (const auto& q : points) {
            ASSERT_EQ(gnomon::squared_distance(p, q), gnomon::squared_distance(q, p));
        }
    }
}

}  // namespace
