// SPDX-License-Identifier: BSL-1.0
#include <array>
#include <deque>
#include <functional>
#include <limits>
#include <list>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/point_range_laws.hpp"
#include <gnomon/core/detail/refused_points.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/core/strided_view.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/core/viewpoints.hpp>

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

// Homogeneous vectors are no points, but become points under the projection that compilers suggest.
using homogeneous = std::vector<Eigen::Vector4f>;
constexpr auto without_last = [](const Eigen::Vector4f& p) -> Eigen::Vector3f {
    return p.head<3>();
};
static_assert(!point_range<homogeneous> && point_range<homogeneous, decltype(without_last)>);
static_assert(gnomon::detail::refused_points<homogeneous>);
static_assert(!gnomon::detail::refused_points<homogeneous, decltype(without_last)>);
static_assert(gnomon::detail::refused_points<Eigen::Matrix3Xd>);
static_assert(gnomon::detail::refused_points<const float*>);
static_assert(gnomon::detail::refused_points<std::list<Eigen::Vector3d>>);
static_assert(!gnomon::detail::refused_points<gnomon::scan> &&
              !gnomon::detail::refused_points<int>);
/// Four points, one of which is not finite.
const clouds::cloud some_points{{1.0, 2.0, 3.0},
                                {-4.0, 0.5, 1e6},
                                {0.0, std::numeric_limits<double>::quiet_NaN(), 0.0},
                                {7.0, 8.0, 9.0}};

TEST(point_range, containers_obey_the_laws) {
    laws::point_range_laws(some_points);
    laws::point_range_laws(clouds::cloud{});
    laws::point_range_laws(std::span(some_points));
    laws::point_range_laws(std::array<std::array<float, 3>, 2>{{{1, 2, 3}, {4, 5, 6}}});
    std::deque<laser_return> returns;
    for (int i = 0; i < 5; ++i) returns.push_back({0.1 * i, Eigen::Vector3f(float(i), 2, 3)});
    laws::point_range_laws(returns, &laser_return::xyz);
}

TEST(point_range, views_obey_the_laws) {
    const std::vector<gnomon::point_index> chosen{3, 0, 2};
    laws::point_range_laws(gnomon::subset_view(some_points, chosen));
    Eigen::Matrix<float, 3, 4> matrix;
    matrix << 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12;
    laws::point_range_laws(gnomon::columns(matrix));
    laws::point_range_laws(gnomon::strided_view<float>(matrix.data(), 4, 3 * sizeof(float)));
}

TEST(point_range, ranges_with_viewpoints_obey_the_laws) {
    static_assert(gnomon::has_viewpoints<gnomon::scan>);
    static_assert(!gnomon::has_viewpoints<clouds::cloud>);
    const clouds::cloud positions{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}};
    const gnomon::scan none{some_points, {}, {}};
    const gnomon::scan one{some_points, gnomon::viewpoint_table(positions[0]), {}};
    const gnomon::scan all{some_points, gnomon::viewpoint_table(positions), {}};
    const gnomon::scan by_scan{
        some_points, gnomon::viewpoint_table({positions[1], positions[2]}, {0, 1, 1, 0}), {}};
    for (const gnomon::scan& scan : {none, one, all, by_scan}) {
        laws::point_range_laws(scan);
        laws::each_point_has_a_viewpoint(scan);
    }
    const auto viewed = gnomon::with_viewpoint(some_points, positions[3]);
    laws::point_range_laws(viewed);
    laws::each_point_has_a_viewpoint(viewed);
}

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
        std::size_t size() const {  // 2^32, if there are such numbers
            constexpr std::size_t most = std::numeric_limits<gnomon::point_index>::max();
            return most < ~std::size_t{0} ? most + 1 : most;
        }
    };
    EXPECT_THROW((gnomon::position_view<endless>(endless{})), std::invalid_argument);
}

}  // namespace
