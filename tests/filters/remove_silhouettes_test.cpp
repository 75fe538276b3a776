// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "filters/boards.hpp"
#include "laws/clouds.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/filters/remove_silhouettes.hpp>
#include <gnomon/filters/subset.hpp>

namespace {

using boards::all_of, boards::beam, boards::scan_of, boards::spacing;
using gnomon::radians;
using gnomon::remove_silhouettes;

/// Half the width of the first board as these points show it [m].
double half_width_of(const gnomon::scan& scan, const std::vector<gnomon::point_index>& kept) {
    double widest = 0.0;
    for (const gnomon::point_index i : kept) widest = std::max(widest, scan.points[i].y());
    return widest;
}

TEST(remove_silhouettes, a_board_is_as_wide_as_it_is) {
    for (const double half : {0.1, 0.2, 0.33}) {
        const gnomon::scan scan = scan_of({{3.0, half, 0.5}}, beam);
        ASSERT_GT(half_width_of(scan, all_of(scan)), half + 0.25 * beam * 3.0);
        const auto kept = remove_silhouettes(scan, {.divergence = radians(beam)});
        EXPECT_NEAR(half_width_of(scan, kept), half, spacing * 3.0) << half;
    }
}

TEST(remove_silhouettes, nothing_between_two_surfaces_is_left) {
    const gnomon::scan scan = scan_of({{2.0, 0.15, 0.2}, {4.0, 0.8, 1.0}}, beam);
    const auto is_between = [&](gnomon::point_index i) {
        return scan.points[i].x() > 2.3 && scan.points[i].x() < 3.7;
    };
    ASSERT_GT(std::ranges::count_if(all_of(scan), is_between), 100);
    const auto kept = remove_silhouettes(scan, {.divergence = radians(beam)});
    EXPECT_EQ(std::ranges::count_if(kept, is_between), 0);
    EXPECT_GT(kept.size(), scan.size() / 2);
}

TEST(remove_silhouettes, wider_beams_cost_more) {
    const gnomon::scan scan = scan_of({{3.0, 0.3, 0.4}}, 0.0);
    std::size_t last = scan.size();
    std::vector<double> half;
    for (const double width : {0.0, 0.02, 0.04}) {
        const auto kept = remove_silhouettes(scan, {.divergence = radians(width)});
        EXPECT_LT(kept.size(), last) << width;
        last = kept.size();
        half.push_back(half_width_of(scan, kept));
    }
    // The silhouette itself, and then half a beam, of which the silhouette is a part.
    EXPECT_NEAR(half[0], 0.3 - 3.0 * spacing, 2.0 * 3.0 * spacing);
    EXPECT_NEAR(half[1], 0.3 - 3.0 * 0.01, 2.0 * 3.0 * spacing);
    EXPECT_NEAR(half[2], 0.3 - 3.0 * 0.02, 2.0 * 3.0 * spacing);
}

TEST(remove_silhouettes, small_jumps_are_one_surface) {
    const gnomon::scan scan = scan_of({{3.0, 0.2, 0.4}, {3.2, 0.5, 0.7}}, 0.0);
    const auto one = remove_silhouettes(scan, {.max_jump = 0.5});
    const auto two = remove_silhouettes(scan, {.max_jump = 0.1});
    EXPECT_LT(two.size(), one.size());
    EXPECT_TRUE(std::ranges::includes(one, two));
}

TEST(remove_silhouettes, result_does_not_depend_on_threads_or_place) {
    const gnomon::scan scan = scan_of({{2.0, 0.15, 0.2}, {4.0, 0.8, 1.0}}, beam);
    const auto kept = remove_silhouettes(scan);
    for (const unsigned n : {1u, 2u, 4u})
        EXPECT_EQ(remove_silhouettes(scan, {}, gnomon::threads{n}), kept);
    const Eigen::Vector3d shift(524288.0, 4194304.0, 128.0);  // at UTM coordinates
    gnomon::scan far;
    far.viewpoints = shift;
    for (const Eigen::Vector3d& p : scan.points) far.points.push_back(p + shift);
    EXPECT_EQ(remove_silhouettes(far), kept);
}

TEST(remove_silhouettes, scans_from_two_places_do_not_mix) {
    const gnomon::scan scan = scan_of({{2.0, 0.15, 0.2}, {4.0, 0.8, 1.0}}, beam);
    const auto kept = remove_silhouettes(scan);
    const Eigen::Vector3d shift(0.0, 5.0, 0.0);
    gnomon::scan both;
    std::vector<gnomon::point_index> scan_of_point, expected = kept;
    for (const gnomon::point_index i : kept)
        expected.push_back(i + static_cast<gnomon::point_index>(scan.size()));
    for (const gnomon::point_index s : {0u, 1u}) {
        for (const Eigen::Vector3d& p : scan.points) {
            both.points.push_back(p + (s == 1 ? shift : Eigen::Vector3d(0, 0, 0)));
            scan_of_point.push_back(s);
        }
    }
    both.viewpoints = gnomon::viewpoint_table({{0, 0, 0}, shift}, scan_of_point);
    // But for the samples of rays by which the reach of a ray is chosen.
    const auto found = remove_silhouettes(both);
    std::vector<gnomon::point_index> different;
    std::ranges::set_symmetric_difference(found, expected, std::back_inserter(different));
    EXPECT_LE(different.size(), scan.size() / 100);
}

/// A sphere around the origin, or a ball ahead of it, in the rays of a scan line of half a degree
/// that turns about the vertical axis by 2 degrees: spokes, which are sparse far from the axis.
gnomon::scan rotational_scan(bool is_ball) {
    gnomon::scan scan;
    scan.viewpoints = Eigen::Vector3d(0, 0, 0);
    constexpr double degree = std::numbers::pi / 180.0, distance = 4.0, radius = 1.5;
    for (int turn = 0; turn < 180; ++turn) {
        for (int step = 1; step < 360; ++step) {
            const double around = 2.0 * degree * turn, down = 0.5 * degree * step;
            const Eigen::Vector3d ray(std::sin(down) * std::cos(around),
                                      std::sin(down) * std::sin(around), std::cos(down));
            double range = 2.0;
            if (is_ball) {
                const double along = distance * ray.x(),
                             root = along * along - distance * distance + radius * radius;
                if (along <= 0.0 || root < 0.0) continue;
                range = along - std::sqrt(root);
            }
            scan.points.push_back(range * ray);
        }
    }
    return scan;
}

TEST(remove_silhouettes, sparse_spokes_of_a_rotating_scanner_are_kept) {
    const gnomon::scan closed = rotational_scan(false);
    const auto kept = remove_silhouettes(closed, {.divergence = radians(0.003)});
    EXPECT_GT(kept.size(), closed.size() - closed.size() / 100);

    // Away from the silhouette, by three spokes; and the silhouette itself is found.
    const gnomon::scan ball = rotational_scan(true);
    const double rim = std::asin(1.5 / 4.0), spoke = 2.0 * std::numbers::pi / 180.0;
    const auto from_axis = [&](gnomon::point_index i) {
        return std::acos(ball.points[i].x() / ball.points[i].norm());
    };
    std::size_t inner = 0, inner_kept = 0, outer = 0, outer_kept = 0;
    const auto ball_kept = remove_silhouettes(ball, {.divergence = radians(0.003)});
    const auto count = [&](const std::vector<gnomon::point_index>& some, std::size_t& in,
                           std::size_t& out) {
        for (const gnomon::point_index i : some) {
            in += from_axis(i) < rim - 3.0 * spoke;
            out += from_axis(i) > rim - 0.25 * spoke;
        }
    };
    count(all_of(ball), inner, outer);
    count(ball_kept, inner_kept, outer_kept);
    EXPECT_GT(inner_kept, inner - inner / 50);
    EXPECT_LT(outer_kept, outer / 4);
}

TEST(remove_silhouettes, a_single_scan_line_is_kept) {
    const gnomon::scan scan = scan_of({{2.0, 0.15, 0.2}, {4.0, 0.8, 1.0}}, beam, 0);
    ASSERT_GT(scan.size(), 50u);
    EXPECT_EQ(remove_silhouettes(scan), all_of(scan));
}

TEST(remove_silhouettes, points_without_a_ray_are_left_out) {
    gnomon::scan scan = scan_of({{3.0, 0.3, 0.4}}, beam);
    const auto kept = remove_silhouettes(scan);
    boards::add_points_without_a_ray(scan);
    EXPECT_EQ(remove_silhouettes(scan), kept);
}

TEST(remove_silhouettes, few_points_and_echoes_of_one_ray) {
    EXPECT_TRUE(remove_silhouettes(gnomon::scan{}).empty());
    for (int n = 1; n < 8; ++n) {
        gnomon::scan scan;
        for (int i = 0; i < n; ++i) scan.points.emplace_back(3.0, 0.01 * i, 0.02 * i * i);
        EXPECT_EQ(remove_silhouettes(scan), all_of(scan)) << n;
        std::ranges::fill(scan.points, Eigen::Vector3d(3.0, 1.0, 1.0));
        EXPECT_EQ(remove_silhouettes(scan), all_of(scan)) << n;
    }
}

/// Rays from a distant origin, as those of a scan in a map without view points, are no raster: no
/// silhouette is found, without a search among all pairs of points.
TEST(remove_silhouettes, rays_of_unknown_view_points_are_kept) {
    const auto scan =
        clouds::moved(clouds::in_cube(40'000, 3), Eigen::Matrix3d::Identity(), {4e5, 5e6, 300.0});
    EXPECT_EQ(remove_silhouettes(scan).size(), scan.size());
}

TEST(remove_silhouettes, options_are_checked) {
    const gnomon::scan scan = scan_of({{3.0, 0.1, 0.1}}, beam);
    EXPECT_THROW((void)remove_silhouettes(scan, {.divergence = radians(-1.0)}),
                 std::invalid_argument);
    EXPECT_THROW((void)remove_silhouettes(scan, {.divergence = radians(clouds::nan)}),
                 std::invalid_argument);
    EXPECT_THROW((void)remove_silhouettes(scan, {.divergence = gnomon::degrees(91)}),
                 std::invalid_argument);
    EXPECT_THROW((void)remove_silhouettes(scan, {.max_jump = -0.1}), std::invalid_argument);
    EXPECT_THROW((void)remove_silhouettes(scan, {.max_jump = clouds::nan}), std::invalid_argument);
}

}  // namespace
