// SPDX-License-Identifier: BSL-1.0
#include <array>
#include <deque>
#include <functional>
#include <list>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core/point_range.hpp>
#include <gnomon/core/scan.hpp>

namespace {

struct laser_return {
    double time;
    Eigen::Vector3f xyz;
};

using gnomon::point_range;

static_assert(point_range<std::vector<Eigen::Vector3d>> && point_range<gnomon::scan>);
static_assert(point_range<std::array<Eigen::Vector3f, 4>> && point_range<Eigen::Vector3d[5]>);
static_assert(point_range<std::span<const std::array<float, 3>>>);
static_assert(point_range<std::deque<laser_return>, Eigen::Vector3f laser_return::*>);
static_assert(!point_range<std::deque<laser_return>>);
static_assert(!point_range<std::list<Eigen::Vector3d>>);  // no access by index
static_assert(!point_range<std::vector<int>> && !point_range<int>);

TEST(point_range, position_view_reads_through_the_projection) {
    std::deque<laser_return> returns;
    for (int i = 0; i < 5; ++i) returns.push_back({0.1 * i, Eigen::Vector3f(float(i), 2, 3)});
    const gnomon::position_view view(returns, &laser_return::xyz);
    ASSERT_EQ(view.size(), 5u);
    EXPECT_EQ(view[4], Eigen::Vector3d(4, 2, 3));
    static_assert(std::same_as<decltype(view)::scalar, float>);

    const gnomon::position_view shifted(returns, [](const laser_return& r) {
        return Eigen::Vector3d(r.xyz.cast<double>() + Eigen::Vector3d::Ones());
    });
    EXPECT_EQ(shifted[4], Eigen::Vector3d(5, 3, 4));
}

TEST(point_range, refuses_more_points_than_an_index_can_count) {
    struct endless {
        const Eigen::Vector3d* begin() const { return nullptr; }
        const Eigen::Vector3d* end() const { return nullptr; }
        std::size_t size() const { return std::size_t{1} << 32; }
    };
    EXPECT_THROW((gnomon::position_view<endless>(endless{})), std::invalid_argument);
}

}  // namespace
