// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "occlusion/looks.hpp"
#include <gnomon/occlusion/visibility.hpp>

namespace sim = gnomon::simulation;

namespace {

using gnomon::visibility, gnomon::observation, gnomon::constant_noise;

using looks::origin;

/// Positions in front of a wall 3 m ahead, on it, behind it and next to it.
TEST(visibility, classifies_positions) {
    sim::scene world;
    looks::add_wall(world, -2.0, 2.0);
    const auto seen = looks::look_at(world);
    for (const double width : {0.0, 1.0, 3.0}) {
        const visibility visible(seen.scan, {.pixel = gnomon::degrees(width)});
        ASSERT_EQ(visible.images().size(), 1u);
        if (width > 0.0) {
            EXPECT_NEAR(visible.pixel().degrees(), width, 0.01);
        }
        for (const double y : {-1.5, 0.0, 0.7}) {
            EXPECT_EQ(visible.towards({3.0, y, 0.2}), observation::on_surface);
            EXPECT_EQ(visible.towards({2.0, y / 1.5, 0.2}), observation::free_space);
            EXPECT_EQ(visible.towards({4.0, y * 1.3, 0.2}), observation::occluded);
        }
        EXPECT_EQ(visible.towards({3.0, 3.5, 0.0}), observation::unobserved);
        EXPECT_EQ(visible.towards({-3.0, 0.0, 0.0}), observation::unobserved);
    }
}

/// A position between two rays: the observation of both, or what the two have in common.
TEST(visibility, combines_the_observations_of_adjacent_rays) {
    const auto place = [](double degrees, double range) -> Eigen::Vector3d {
        const gnomon::angle azimuth = gnomon::degrees(degrees);
        return range * Eigen::Vector3d(cos(azimuth), sin(azimuth), 0.0);
    };
    const auto between = [&](double right, double left, double away = 1.0) {
        const clouds::cloud rays{place(0.5 - away, right), place(0.5 + away, left)};
        const gnomon::visibility visible(
            rays, {.pixel = gnomon::degrees(1), .pole = Eigen::Vector3d::UnitZ()});
        return visible.towards(place(0.5, 3.0));
    };
    EXPECT_EQ(between(1.5, 1.5), observation::occluded);
    EXPECT_EQ(between(3.0, 3.0), observation::on_surface);
    EXPECT_EQ(between(5.0, 5.0), observation::free_space);
    EXPECT_EQ(between(1.5, 3.0), observation::on_surface)
        << "the edge of something before a surface";
    EXPECT_EQ(between(3.0, 1.5), observation::on_surface);
    EXPECT_EQ(between(1.5, 5.0), observation::unobserved);
    EXPECT_EQ(between(5.0, 3.0), observation::unobserved);
    // Lines of a scan that are far apart: what is hidden to both sides is hidden.
    EXPECT_EQ(between(1.5, 1.5, 2.0), observation::occluded);
    for (const double range : {1.5, 3.0, 5.0}) {
        EXPECT_EQ(between(3.0, range, 2.0), observation::unobserved);
        EXPECT_EQ(between(5.0, range, 2.0), observation::unobserved);
    }
    EXPECT_EQ(between(1.5, 1.5, 3.0), observation::unobserved);
}

/// Three sigma and what a surface may turn away within a pixel are no difference.
TEST(visibility, leave_a_margin_for_noise) {
    sim::scene world;
    looks::add_wall(world, -2.0, 2.0);
    const auto seen = looks::look_at(world);
    for (const double noise : {0.0, 0.1}) {
        const visibility visible(seen.scan, {.noise = constant_noise{noise}});
        const double margin = 3.0 * noise + 3.0 * visible.pixel().radians();
        EXPECT_EQ(visible.towards({3.0 + 0.8 * margin, 0, 0}), observation::on_surface);
        EXPECT_EQ(visible.towards({3.0 - 0.8 * margin, 0, 0}), observation::on_surface);
        EXPECT_EQ(visible.towards({3.0 + 1.2 * margin, 0, 0}), observation::occluded);
        EXPECT_EQ(visible.towards({3.0 - 1.2 * margin, 0, 0}), observation::free_space);
    }
}

/// Places on a straight line across the column's shadow are 30 cm to each side hidden.
TEST(visibility, walk_across_a_gap) {
    const auto hidden = looks::look_at(looks::hidden());
    const visibility before(hidden.scan);
    const auto across = before.between({3, -0.3, 0}, {3, 0.3, 0}, origin);
    EXPECT_GE(across.total(), 8u);
    EXPECT_GE(across[observation::occluded] + 2, across.total());
    EXPECT_EQ(across[observation::free_space], 0u);
    EXPECT_EQ(across[observation::unobserved], 0u);

    const auto opened = looks::look_at(looks::opened(0.6));
    const auto through = visibility(opened.scan).between({3, -0.32, 0.1}, {3, 0.32, -0.1}, origin);
    EXPECT_GE(through[observation::free_space] + 3, through.total());
    EXPECT_EQ(through[observation::occluded], 0u);

    const auto torn = looks::look_at(looks::torn(0.6));
    const auto nothing = visibility(torn.scan).between({3, -0.32, 0}, {3, 0.32, 0}, origin);
    EXPECT_GE(nothing[observation::unobserved] + 4, nothing.total());
    EXPECT_EQ(nothing[observation::occluded] + nothing[observation::free_space], 0u);
}

/// Where the line meets the rays, not where a place between the ends by azimuth and range would be:
/// along a wall at a flat angle every place is level.
TEST(visibility, keep_to_the_straight_line) {
    sim::scene world;
    world.add_object("wall", sim::box{20.0, 0.1, 3.0}, sim::at(5.0, 1.05, 0.0));
    const auto seen = looks::look_at(world, {.left = 85.0});
    const auto count = visibility(seen.scan).between({8, 1, 0}, {0.5, 1, 0}, origin);
    EXPECT_GE(count.total(), 40u);
    EXPECT_EQ(count[observation::on_surface], count.total());
}

TEST(visibility, between_the_same_ray_has_no_place) {
    const auto seen = looks::look_at(looks::hidden());
    const visibility visible(seen.scan);
    EXPECT_EQ(visible.between({3, 0, 0}, {3, 0, 0}, origin).total(), 0u);
    EXPECT_EQ(visible.between({3, 0, 0}, {5, 0, 0}, origin).total(), 0u);
    EXPECT_EQ(visible.between(origin, {5, 0, 0}, origin).total(), 0u);
    EXPECT_EQ(visible.between(origin, origin, origin).total(), 0u);
    // Right through the view point.
    EXPECT_GT(visible.between({3, 0, 0}, {-3, 0, 0}, origin).total(), 100u);
}

TEST(visibility, see_nothing_nowhere) {
    const auto seen = looks::look_at(looks::hidden(), {.spacing = 2.0});
    const visibility visible(seen.scan);
    const Eigen::Vector3d wall(3, 0.5, 0);
    for (const Eigen::Vector3d& nowhere :
         {Eigen::Vector3d(clouds::nan, 0, 0), {0, clouds::infinity, 0}, {1e200, -1e300, 1e300}}) {
        EXPECT_EQ(visible.towards(nowhere), observation::unobserved);
        EXPECT_EQ(visible.between(nowhere, wall, origin).total(),
                  visible.between(nowhere, wall, origin)[observation::unobserved]);
        EXPECT_EQ(visible.between(wall, wall, nowhere).total(), 0u);
    }
}

/// The seam of azimuth runs behind the sensor, and here through the gap.
TEST(visibility, cross_the_seam) {
    const auto seen = looks::look_at(looks::hidden());
    Eigen::Matrix3d back = Eigen::Matrix3d::Identity();
    back(0, 0) = back(1, 1) = -1.0;
    const auto behind = clouds::moved(seen.scan.points, back, origin);
    const visibility visible(behind, {.pole = Eigen::Vector3d(0, 0, 1)});
    const auto across = visible.between({-3, -0.3, 0}, {-3, 0.3, 0}, origin);
    EXPECT_GE(across.total(), 8u);
    EXPECT_GE(across[observation::occluded] + 2, across.total());
}

/// One image for each view point that any finite point was seen from.
TEST(visibility, have_an_image_for_each_view_point) {
    const clouds::cloud points{{1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {clouds::nan, 0, 0}};
    const auto images = [&](const gnomon::viewpoint_table& table) {
        return visibility(gnomon::with_viewpoints(points, table)).images().size();
    };
    EXPECT_EQ(images({}), 1u);
    EXPECT_EQ(images(Eigen::Vector3d(0, 0, 1)), 1u);
    EXPECT_EQ(images({{{0, 0, 1}, {0, 0, 2}, {0, 0, 1}}, {0, 1, 2, 1}}), 2u);
    EXPECT_EQ(images({{{0, 0, 1}, {0, 0, 2}, {0, 0, 3}}, {0, 1, 1, 2}}), 2u);
    EXPECT_EQ(images(gnomon::viewpoint_table(
                  clouds::cloud{{0, 0, 1}, {clouds::nan, 0, 2}, {0, 1, 0}, {0, 0, 5}})),
              2u);
    EXPECT_EQ(visibility(clouds::cloud{}).images().size(), 0u);
    EXPECT_EQ(visibility(clouds::cloud{}).towards({1, 0, 0}), observation::unobserved);
}

/// View points that are closer to each other than the noise share an image, at any distance from
/// the origin; without noise each has its own.
TEST(visibility, share_images_of_near_view_points) {
    clouds::cloud points, way;
    for (int i = 0; i < 300; ++i) {
        points.emplace_back(3.0, 0.01 * i, 0.0);
        way.emplace_back(0.0, 0.0005 * i, 1.0);  // 15 cm
    }
    const auto visible = [&](double noise, const Eigen::Vector3d& by) {
        clouds::cloud p = points, v = way;
        for (std::size_t i = 0; i < p.size(); ++i) p[i] += by, v[i] += by;
        return visibility(gnomon::with_viewpoints(p, gnomon::viewpoint_table(v)),
                          {.noise = constant_noise{noise}});
    };
    const visibility here = visible(0.015, origin);
    ASSERT_EQ(here.images().size(), 11u) << "the first and the last of half a cube";
    for (std::size_t k = 1; k < 10; ++k)
        EXPECT_NEAR(here.images()[k].viewpoint().y() / 0.015, static_cast<double>(k), 0.04);
    EXPECT_EQ(visible(0.0, origin).images().size(), 300u);
    EXPECT_EQ(visible(1e-300, origin).images().size(), 300u);
    EXPECT_EQ(visible(1.0, origin).images().size(), 1u);
    const Eigen::Vector3d far(524288.25, 4194304.5, -7.0);
    const visibility there = visible(0.015, far);
    ASSERT_NEAR(static_cast<double>(there.images().size()), 11.0, 1.0);
    EXPECT_EQ(there.towards(Eigen::Vector3d(3.0, 1.0, 0.0) + far),
              here.towards(Eigen::Vector3d(3.0, 1.0, 0.0)));
}

/// One return from far away, whose noise is large, does not make one sensor of two.
TEST(visibility, share_no_images_for_one_far_return) {
    constexpr gnomon::quadratic_noise growing{0.001, 0.0, 0.001};
    clouds::cloud points, from;
    for (int i = 0; i < 900; ++i) {
        from.emplace_back(i % 2 == 0 ? 0.0 : 5.0, 0.0, 1.0);
        points.push_back(from.back() + Eigen::Vector3d(0.001 * i, i == 450 ? 2000.0 : 2.0, 0.0));
    }
    const visibility seen(gnomon::with_viewpoints(points, gnomon::viewpoint_table(from)),
                          {.noise = growing});
    EXPECT_EQ(seen.images().size(), 2u);
}

/// Points that are not finite are no sample of the noise.
TEST(visibility, share_images_whatever_is_not_finite) {
    const gnomon::noise_curve tabulated = [](double range) { return 0.01 * range; };
    const auto images_with = [&](double bad) {
        clouds::cloud points, from;
        for (int i = 0; i < 40; ++i) {
            points.emplace_back(10.0, 0.1 * i, i % 2 == 0 ? 0.0 : bad);
            from.emplace_back(0.0, 0.01 * i, 0.0);
        }
        return visibility(gnomon::with_viewpoints(points, gnomon::viewpoint_table(from)),
                          {.noise = tabulated})
            .images()
            .size();
    };
    EXPECT_EQ(images_with(clouds::nan), images_with(0.0));
}

/// Two scans that see the wall behind a place outvote the one that sees something before it.
TEST(visibility, let_view_points_vote) {
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
        return visibility(gnomon::with_viewpoints(some, {viewpoints, scans})).towards(place);
    };
    EXPECT_EQ(told(1), observation::occluded);
    EXPECT_EQ(told(2), observation::free_space) << "of equally many free space";
    EXPECT_EQ(told(3), observation::free_space);
}

/// Upright scan lines, each from a place of its own, and a column in front of a wall. About the
/// axis along which all of them vary least, the pixels there are narrower than the spacing of the
/// rays.
TEST(visibility, have_a_pole_for_each_view_point) {
    clouds::cloud points, from;
    const auto towards = [](double azimuth, double elevation) {
        const gnomon::angle a = gnomon::degrees(azimuth), e = gnomon::degrees(elevation);
        return Eigen::Vector3d(cos(e) * cos(a), cos(e) * sin(a), sin(e));
    };
    for (int column = -85; column <= 85; ++column) {
        for (int elevation = -85; elevation <= 85; ++elevation) {
            from.emplace_back(0.001 * column, 0.0, 0.0);
            const double range = column >= 78 && column <= 83 ? 2.5 : 5.0;
            points.push_back(from.back() + range * towards(column, elevation));
        }
    }
    const visibility visible(gnomon::with_viewpoints(points, gnomon::viewpoint_table(from)),
                             {.noise = constant_noise{0.0005}});
    ASSERT_EQ(visible.images().size(), 171u);
    for (const double elevation : {-30.5, -0.5, 0.5, 30.5}) {
        const auto seen =
            visible.between(5.0 * towards(77, elevation), 5.0 * towards(84, elevation), origin);
        EXPECT_GE(seen[observation::occluded], 5u) << elevation;
        EXPECT_EQ(seen[observation::unobserved], 0u) << elevation;
    }
}

/// A lidar that spins sees neither what is below it nor the sky; whether it stands or moves.
TEST(visibility, end_below_and_above_all_that_was_seen) {
    for (const double step : {0.0, 0.001}) {
        clouds::cloud points, from;
        for (int column = 0; column < 360; ++column) {
            const gnomon::angle turned = gnomon::degrees(column);
            for (double elevation = -20.0; elevation <= 10.0; elevation += 1.0) {
                if (column > 100 && column < 140) continue;  // no returns
                const gnomon::angle e = gnomon::degrees(elevation);
                from.emplace_back(step * column, 0.0, 2.0);
                points.push_back(from.back() + 5.0 * Eigen::Vector3d(cos(e) * cos(turned),
                                                                     cos(e) * sin(turned), sin(e)));
            }
        }
        const visibility visible(gnomon::with_viewpoints(points, gnomon::viewpoint_table(from)),
                                 {.noise = constant_noise{0.01}});
        EXPECT_EQ(visible.towards({1.0, 0.5, 0.0}), observation::out_of_view);
        EXPECT_EQ(visible.towards({-0.5, 0.0, 0.5}), observation::out_of_view);
        EXPECT_EQ(visible.towards({1.0, 0.0, 5.0}), observation::out_of_view);
        EXPECT_EQ(visible.towards({-2.5, 4.3, 2.0}), observation::unobserved);
        EXPECT_EQ(visible.towards({4.0, 0.0, 2.0}), observation::free_space);
    }
}

/// A lidar whose view point is stated a meter off: the lowest line on its ground is nearer, and so
/// lower, ahead of that than behind.
TEST(visibility, end_below_what_was_seen_in_the_same_azimuth) {
    clouds::cloud points;
    for (int column = 0; column < 720; ++column) {
        const gnomon::angle turned = gnomon::degrees(0.5 * column);
        for (double range = 4.0; range < 20.0; range *= 1.05)
            points.emplace_back(range * cos(turned), range * sin(turned), 0.0);
    }
    const visibility visible(gnomon::with_viewpoint(points, {1.0, 0.0, 2.0}),
                             {.noise = constant_noise{0.01}});
    EXPECT_EQ(visible.towards({-3.5, 0.0, 0.0}), observation::out_of_view);
    EXPECT_EQ(visible.towards({-2.0, 1.0, 0.0}), observation::out_of_view);
    EXPECT_EQ(visible.towards({3.5, 0.0, 0.0}), observation::out_of_view);
    EXPECT_EQ(visible.towards({4.41, 0.0, 0.0}), observation::on_surface);
    for (int degree = 0; degree < 360; ++degree) {
        const gnomon::angle turned = gnomon::degrees(degree);
        EXPECT_EQ(visible.towards({3.7 * cos(turned), 3.7 * sin(turned), 0.0}),
                  observation::out_of_view)
            << degree;
    }
}

/// Of a sensor that sees only itself.
TEST(visibility, are_of_nothing_where_nothing_was_seen) {
    const clouds::cloud points(5, Eigen::Vector3d(1.0, 1.0, 1.0));
    const visibility visible(gnomon::with_viewpoint(points, points[0]));
    EXPECT_EQ(visible.towards({2.0, 3.0, 1.0}), observation::unobserved);
}

TEST(visibility, survive_any_cloud) {
    for (const auto& [name, points] : clouds::degenerate()) {
        SCOPED_TRACE(name);
        const visibility visible(points);
        for (const Eigen::Vector3d& place : clouds::in_cube(20, 1)) {
            (void)visible.towards(place);
            (void)visible.between(place, Eigen::Vector3d(1.0, 0.5, 0.0), origin);
        }
    }
}

TEST(visibility, rejects_invalid_input) {
    const clouds::cloud points{{1, 0, 0}};
    const auto make = [&](const gnomon::visibility_options& options) {
        return visibility(points, options);
    };
    EXPECT_THROW(make({.pixel = gnomon::degrees(-1)}), std::invalid_argument);
    EXPECT_THROW(make({.pixel = gnomon::degrees(91)}), std::invalid_argument);
    EXPECT_THROW(make({.pixel = gnomon::radians(1e-300)}), std::invalid_argument);
    EXPECT_THROW(make({.pixel = gnomon::radians(clouds::nan)}), std::invalid_argument);
    EXPECT_THROW(make({.pole = origin}), std::invalid_argument);
    EXPECT_THROW(make({.pole = Eigen::Vector3d(0, clouds::infinity, 1)}), std::invalid_argument);
    EXPECT_NO_THROW(make({.pole = Eigen::Vector3d(0, 0, 1e-160)}));
    EXPECT_NO_THROW(make({.pole = Eigen::Vector3d(0, 0, 1e200)}));
    EXPECT_NO_THROW(make({.pixel = gnomon::degrees(90), .noise = constant_noise{0.0}}));
}

}  // namespace
