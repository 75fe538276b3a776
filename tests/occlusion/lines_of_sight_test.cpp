// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "occlusion/looks.hpp"
#include <gnomon/occlusion/lines_of_sight.hpp>

namespace {

using gnomon::lines_of_sight, gnomon::sighting, gnomon::sighting_count;

using looks::origin;

TEST(sighting_count, counts_each_kind) {
    sighting_count count;
    EXPECT_EQ(count.total(), 0u);
    count.add(sighting::closer);
    count.add(sighting::closer);
    count.add(sighting::unseen);
    EXPECT_EQ(count[sighting::closer], 2u);
    EXPECT_EQ(count[sighting::unseen], 1u);
    EXPECT_EQ(count[sighting::farther], 0u);
    EXPECT_EQ(count.total(), 3u);
}

/// Of a wall 3 m ahead, what is asked for is before it, in it, behind it or beside it.
TEST(lines_of_sight, tell_what_was_seen_towards_a_place) {
    gnomon::scene world;
    looks::add_wall(world, -2.0, 2.0);
    const auto seen = looks::look_at(world);
    for (const double pixel : {0.0, 1.0, 3.0}) {
        const lines_of_sight sights(seen.scan, {.pixel = gnomon::degrees(pixel)});
        ASSERT_EQ(sights.images().size(), 1u);
        if (pixel > 0.0) {
            EXPECT_NEAR(sights.pixel().degrees(), pixel, 0.01);
        }
        for (const double y : {-1.5, 0.0, 0.7}) {
            EXPECT_EQ(sights.towards({3.0, y, 0.2}), sighting::level);
            EXPECT_EQ(sights.towards({2.0, y / 1.5, 0.2}), sighting::farther);
            EXPECT_EQ(sights.towards({4.0, y * 1.3, 0.2}), sighting::closer);
        }
        EXPECT_EQ(sights.towards({3.0, 3.5, 0.0}), sighting::unseen);
        EXPECT_EQ(sights.towards({-3.0, 0.0, 0.0}), sighting::unseen);
    }
}

/// Between two rays, where none is: what both tell, or what they have in common.
TEST(lines_of_sight, tell_what_the_rays_about_a_place_tell) {
    const auto place = [](double degrees, double range) -> Eigen::Vector3d {
        const gnomon::angle azimuth = gnomon::degrees(degrees);
        return range * Eigen::Vector3d(cos(azimuth), sin(azimuth), 0.0);
    };
    const auto between = [&](double right, double left, double away = 1.0) {
        const clouds::cloud rays{place(0.5 - away, right), place(0.5 + away, left)};
        const gnomon::lines_of_sight sights(
            rays, {.pixel = gnomon::degrees(1), .pole = Eigen::Vector3d::UnitZ()});
        return sights.towards(place(0.5, 3.0));
    };
    EXPECT_EQ(between(1.5, 1.5), sighting::closer);
    EXPECT_EQ(between(3.0, 3.0), sighting::level);
    EXPECT_EQ(between(5.0, 5.0), sighting::farther);
    EXPECT_EQ(between(1.5, 3.0), sighting::level) << "the edge of something before a surface";
    EXPECT_EQ(between(3.0, 1.5), sighting::level);
    EXPECT_EQ(between(1.5, 5.0), sighting::unseen);
    EXPECT_EQ(between(5.0, 3.0), sighting::unseen);
    // Lines of a scan that are far apart: what is hidden to both sides is hidden.
    EXPECT_EQ(between(1.5, 1.5, 2.0), sighting::closer);
    for (const double range : {1.5, 3.0, 5.0}) {
        EXPECT_EQ(between(3.0, range, 2.0), sighting::unseen);
        EXPECT_EQ(between(5.0, range, 2.0), sighting::unseen);
    }
    EXPECT_EQ(between(1.5, 1.5, 3.0), sighting::unseen);
}

/// Three sigma and what a surface may turn away within a pixel are no difference.
TEST(lines_of_sight, leave_a_margin_for_noise) {
    gnomon::scene world;
    looks::add_wall(world, -2.0, 2.0);
    const auto seen = looks::look_at(world);
    for (const double sigma : {0.0, 0.1}) {
        const lines_of_sight sights(seen.scan, {.sigma = sigma});
        const double margin = 3.0 * sigma + 3.0 * sights.pixel().radians();
        EXPECT_EQ(sights.towards({3.0 + 0.8 * margin, 0, 0}), sighting::level);
        EXPECT_EQ(sights.towards({3.0 - 0.8 * margin, 0, 0}), sighting::level);
        EXPECT_EQ(sights.towards({3.0 + 1.2 * margin, 0, 0}), sighting::closer);
        EXPECT_EQ(sights.towards({3.0 - 1.2 * margin, 0, 0}), sighting::farther);
    }
}

/// Places on a straight line across the column's shadow are 30 cm to each side hidden.
TEST(lines_of_sight, walk_across_a_gap) {
    const auto hidden = looks::look_at(looks::hidden());
    const lines_of_sight before(hidden.scan);
    const auto across = before.between({3, -0.3, 0}, {3, 0.3, 0}, origin);
    EXPECT_GE(across.total(), 8u);
    EXPECT_GE(across[sighting::closer] + 2, across.total());
    EXPECT_EQ(across[sighting::farther], 0u);
    EXPECT_EQ(across[sighting::unseen], 0u);

    const auto opened = looks::look_at(looks::opened(0.6));
    const auto through =
        lines_of_sight(opened.scan).between({3, -0.32, 0.1}, {3, 0.32, -0.1}, origin);
    EXPECT_GE(through[sighting::farther] + 3, through.total());
    EXPECT_EQ(through[sighting::closer], 0u);

    const auto torn = looks::look_at(looks::torn(0.6));
    const auto nothing = lines_of_sight(torn.scan).between({3, -0.32, 0}, {3, 0.32, 0}, origin);
    EXPECT_GE(nothing[sighting::unseen] + 4, nothing.total());
    EXPECT_EQ(nothing[sighting::closer] + nothing[sighting::farther], 0u);
}

/// Where the line meets the rays, not where a place between the ends by azimuth and range would be:
/// along a wall at a flat angle every place is level.
TEST(lines_of_sight, keep_to_the_straight_line) {
    gnomon::scene world;
    world.add_object("wall", gnomon::box{20.0, 0.1, 3.0}, gnomon::at(5.0, 1.05, 0.0));
    const auto seen = looks::look_at(world, {.left = 85.0});
    const auto count = lines_of_sight(seen.scan).between({8, 1, 0}, {0.5, 1, 0}, origin);
    EXPECT_GE(count.total(), 40u);
    EXPECT_EQ(count[sighting::level], count.total());
}

TEST(lines_of_sight, between_the_same_ray_has_no_place) {
    const auto seen = looks::look_at(looks::hidden());
    const lines_of_sight sights(seen.scan);
    EXPECT_EQ(sights.between({3, 0, 0}, {3, 0, 0}, origin).total(), 0u);
    EXPECT_EQ(sights.between({3, 0, 0}, {5, 0, 0}, origin).total(), 0u);
    EXPECT_EQ(sights.between(origin, {5, 0, 0}, origin).total(), 0u);
    EXPECT_EQ(sights.between(origin, origin, origin).total(), 0u);
    // Right through the view point.
    EXPECT_GT(sights.between({3, 0, 0}, {-3, 0, 0}, origin).total(), 100u);
}

TEST(lines_of_sight, see_nothing_nowhere) {
    const auto seen = looks::look_at(looks::hidden(), {.spacing = 2.0});
    const lines_of_sight sights(seen.scan);
    const Eigen::Vector3d wall(3, 0.5, 0);
    for (const Eigen::Vector3d& nowhere :
         {Eigen::Vector3d(clouds::nan, 0, 0), {0, clouds::infinity, 0}, {1e200, -1e300, 1e300}}) {
        EXPECT_EQ(sights.towards(nowhere), sighting::unseen);
        EXPECT_EQ(sights.between(nowhere, wall, origin).total(),
                  sights.between(nowhere, wall, origin)[sighting::unseen]);
        EXPECT_EQ(sights.between(wall, wall, nowhere).total(), 0u);
    }
}

/// The seam of azimuth runs behind the sensor, and here through the gap.
TEST(lines_of_sight, cross_the_seam) {
    const auto seen = looks::look_at(looks::hidden());
    Eigen::Matrix3d back = Eigen::Matrix3d::Identity();
    back(0, 0) = back(1, 1) = -1.0;
    const auto behind = clouds::moved(seen.scan.points, back, origin);
    const lines_of_sight sights(behind, {.pole = Eigen::Vector3d(0, 0, 1)});
    const auto across = sights.between({-3, -0.3, 0}, {-3, 0.3, 0}, origin);
    EXPECT_GE(across.total(), 8u);
    EXPECT_GE(across[sighting::closer] + 2, across.total());
}

/// One image for each view point that any finite point was seen from.
TEST(lines_of_sight, have_an_image_for_each_view_point) {
    const clouds::cloud points{{1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {clouds::nan, 0, 0}};
    const auto images = [&](const gnomon::viewpoint_table& table) {
        return lines_of_sight(gnomon::with_viewpoints(points, table)).images().size();
    };
    EXPECT_EQ(images({}), 1u);
    EXPECT_EQ(images(Eigen::Vector3d(0, 0, 1)), 1u);
    EXPECT_EQ(images({{{0, 0, 1}, {0, 0, 2}, {0, 0, 1}}, {0, 1, 2, 1}}), 2u);
    EXPECT_EQ(images({{{0, 0, 1}, {0, 0, 2}, {0, 0, 3}}, {0, 1, 1, 2}}), 2u);
    EXPECT_EQ(images(gnomon::viewpoint_table(
                  clouds::cloud{{0, 0, 1}, {clouds::nan, 0, 2}, {0, 1, 0}, {0, 0, 5}})),
              2u);
    EXPECT_EQ(lines_of_sight(clouds::cloud{}).images().size(), 0u);
    EXPECT_EQ(lines_of_sight(clouds::cloud{}).towards({1, 0, 0}), sighting::unseen);
}

/// Those nearer to each other than noise throws points count as one, wherever they lie; without
/// noise none do.
TEST(lines_of_sight, share_images_of_near_view_points) {
    clouds::cloud points, way;
    for (int i = 0; i < 300; ++i) {
        points.emplace_back(3.0, 0.01 * i, 0.0);
        way.emplace_back(0.0, 0.0005 * i, 1.0);  // 15 cm
    }
    const auto sights = [&](double sigma, const Eigen::Vector3d& by) {
        clouds::cloud p = points, v = way;
        for (std::size_t i = 0; i < p.size(); ++i) p[i] += by, v[i] += by;
        return lines_of_sight(gnomon::with_viewpoints(p, gnomon::viewpoint_table(v)),
                              {.sigma = sigma});
    };
    const lines_of_sight here = sights(0.015, origin);
    ASSERT_EQ(here.images().size(), 11u) << "the first and the last of half a cube";
    for (std::size_t k = 1; k < 10; ++k)
        EXPECT_NEAR(here.images()[k].viewpoint().y() / 0.015, static_cast<double>(k), 0.04);
    EXPECT_EQ(sights(0.0, origin).images().size(), 300u);
    EXPECT_EQ(sights(1e-300, origin).images().size(), 300u);
    EXPECT_EQ(sights(1.0, origin).images().size(), 1u);
    const Eigen::Vector3d far(524288.25, 4194304.5, -7.0);
    const lines_of_sight there = sights(0.015, far);
    ASSERT_NEAR(static_cast<double>(there.images().size()), 11.0, 1.0);
    EXPECT_EQ(there.towards(Eigen::Vector3d(3.0, 1.0, 0.0) + far),
              here.towards(Eigen::Vector3d(3.0, 1.0, 0.0)));
}

/// Two scans that see the wall behind a place outvote the one that sees something before it.
TEST(lines_of_sight, let_view_points_vote) {
    clouds::cloud points;
    std::vector<gnomon::point_index> scan_of_point;
    const clouds::cloud viewpoints{{0, 0, 0}, {0, 1, 0}, {0, -1, 0}};
    const Eigen::Vector3d place(2, 0, 0);
    for (gnomon::point_index v = 0; v < 3; ++v) {
        points.push_back(viewpoints[v] + (place - viewpoints[v]) * (v == 0 ? 0.5 : 2.0));
        scan_of_point.push_back(v);
    }
    const auto told = [&](std::size_t n) {
        const clouds::cloud some(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(n));
        const std::vector<gnomon::point_index> scans(
            scan_of_point.begin(), scan_of_point.begin() + static_cast<std::ptrdiff_t>(n));
        return lines_of_sight(gnomon::with_viewpoints(some, {viewpoints, scans})).towards(place);
    };
    EXPECT_EQ(told(1), sighting::closer);
    EXPECT_EQ(told(2), sighting::farther) << "of equally many what speaks against a surface";
    EXPECT_EQ(told(3), sighting::farther);
}

TEST(lines_of_sight, survive_any_cloud) {
    for (const auto& [name, points] : clouds::degenerate()) {
        SCOPED_TRACE(name);
        const lines_of_sight sights(points);
        for (const Eigen::Vector3d& place : clouds::in_cube(20, 1)) {
            (void)sights.towards(place);
            (void)sights.between(place, Eigen::Vector3d(1.0, 0.5, 0.0), origin);
        }
    }
}

TEST(lines_of_sight, refuse_what_makes_no_sense) {
    const clouds::cloud points{{1, 0, 0}};
    const auto make = [&](const gnomon::sight_options& options) {
        return lines_of_sight(points, options);
    };
    EXPECT_THROW(make({.pixel = gnomon::degrees(-1)}), std::invalid_argument);
    EXPECT_THROW(make({.pixel = gnomon::degrees(91)}), std::invalid_argument);
    EXPECT_THROW(make({.pixel = gnomon::radians(1e-300)}), std::invalid_argument);
    EXPECT_THROW(make({.pixel = gnomon::radians(clouds::nan)}), std::invalid_argument);
    EXPECT_THROW(make({.sigma = -0.1}), std::invalid_argument);
    EXPECT_THROW(make({.sigma = clouds::nan}), std::invalid_argument);
    EXPECT_THROW(make({.sigma = clouds::infinity}), std::invalid_argument);
    EXPECT_THROW(make({.pole = origin}), std::invalid_argument);
    EXPECT_NO_THROW(make({.pixel = gnomon::degrees(90), .sigma = 0.0}));
}

}  // namespace
