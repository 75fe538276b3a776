// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "occlusion/looks.hpp"
#include <gnomon/core/angle.hpp>
#include <gnomon/occlusion/range_image.hpp>

namespace {

using gnomon::range_image, gnomon::range_image_options, gnomon::point_index;
using pixel = range_image::pixel;

using looks::origin;

const Eigen::Vector3d up(0, 0, 1);

Eigen::Vector3d direction(double azimuth, double elevation) {
    return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
            std::sin(elevation)};
}

/// Points in all directions, 1 to 5 m away.
clouds::cloud all_around(std::size_t n, std::uint64_t seed) {
    gnomon::random_stream random(seed);
    clouds::cloud points(n);
    for (Eigen::Vector3d& p : points)
        p = clouds::gaussian_vector(random).normalized() * (1.0 + 4.0 * random.uniform());
    return points;
}

/// The nearest return of each pixel, from those that the image itself names.
void expect_nearest_returns(const range_image& image, const clouds::cloud& points) {
    std::vector<std::optional<point_index>> nearest(image.width() * image.height());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double distance = image.distance_to(points[i]);
        if (!std::isfinite(distance) || distance == 0.0) continue;
        const pixel at = image.pixel_of(points[i]);
        ASSERT_LT(at.azimuth, image.width());
        ASSERT_LT(at.elevation, image.height());
        ASSERT_GE(image.range(at), 0.0);
        EXPECT_LE(image.range(at), distance);
        auto& best = nearest[at.elevation * image.width() + at.azimuth];
        if (!best || distance < image.distance_to(points[*best]))
            best = static_cast<point_index>(i);
    }
    for (std::size_t e = 0; e < image.height(); ++e) {
        for (std::size_t a = 0; a < image.width(); ++a) {
            const auto best = nearest[e * image.width() + a];
            EXPECT_EQ(image.index({a, e}), best);
            EXPECT_EQ(image.range({a, e}),
                      best ? image.distance_to(points[*best]) : range_image::nothing);
        }
    }
}

/// Eq. (2.1): a = (atan2(y, x) + pi) / (2 pi) w, e = (asin(z / r) + pi / 2) / pi h.
TEST(range_image, with_the_pole_up_is_that_of_the_thesis) {
    const Eigen::Vector3d viewpoint(1, -2, 0.5);
    const auto around = all_around(500, 1);
    const range_image image(clouds::moved(around, Eigen::Matrix3d::Identity(), viewpoint),
                            viewpoint, {.width = 36, .height = 18, .pole = up});
    EXPECT_EQ(image.width(), 36u);
    EXPECT_EQ(image.height(), 18u);
    EXPECT_EQ(image.viewpoint(), viewpoint);
    const double pi = std::numbers::pi;
    for (const Eigen::Vector3d& d : around) {
        const double a = (std::atan2(d.y(), d.x()) + pi) / (2.0 * pi) * 36.0;
        const double e = (std::asin(d.z() / d.norm()) + 0.5 * pi) / pi * 18.0;
        EXPECT_EQ(image.pixel_of(viewpoint + d),
                  (pixel{static_cast<std::size_t>(a), static_cast<std::size_t>(e)}));
    }
}

TEST(range_image, has_the_same_pixels_of_some_points_as_of_each) {
    const Eigen::Vector3d viewpoint(1, -2, 0.5);
    const range_image image(all_around(50, 1), viewpoint, {.width = 36, .height = 18});
    constexpr std::size_t n = 11;
    std::array<Eigen::Vector3d, n> some;
    std::ranges::copy_n(all_around(n, 2).begin(), n, some.begin());
    some.back() = viewpoint;
    const auto pixels = image.pixels_of(some);
    for (std::size_t l = 0; l < n; ++l) EXPECT_EQ(pixels[l], image.pixel_of(some[l]));
}

TEST(range_image, closes_at_azimuth_pi_and_ends_at_the_pole) {
    const range_image image(clouds::cloud{}, origin, {.width = 36, .height = 18, .pole = up});
    EXPECT_EQ(image.pixel_of({-1, 0.0, 0}), (pixel{0, 9}));   // azimuth pi
    EXPECT_EQ(image.pixel_of({-1, -0.0, 0}), (pixel{0, 9}));  // azimuth -pi
    EXPECT_EQ(image.pixel_of({-1, 1e-9, 0}), (pixel{35, 9}));
    EXPECT_EQ(image.pixel_of({1, 1e-9, 0}), (pixel{18, 9}));
    EXPECT_EQ(image.pixel_of({0, 0, 2}).elevation, 17u);
    EXPECT_EQ(image.pixel_of({0, 0, -2}).elevation, 0u);
}

TEST(range_image, holds_the_nearest_return_and_its_number) {
    const clouds::cloud points{{2, 0.01, 0.01}, {1, 0.01, 0.01}, {3, 0.01, 0.01},
                               {1, 0.01, 0.01}, {0, 4, 0.01},    {0, 0, 0}};
    const range_image image(points, origin, {.width = 36, .height = 18, .pole = up});
    EXPECT_EQ(image.index({18, 9}), 1u);
    EXPECT_DOUBLE_EQ(image.range({18, 9}), points[1].norm());
    EXPECT_EQ(image.index({27, 9}), 4u);
    EXPECT_EQ(image.index({17, 9}), std::nullopt);
    EXPECT_EQ(image.range({17, 9}), range_image::nothing);
    for (const std::size_t row : {std::size_t{0}, std::size_t{8}, std::size_t{10}, std::size_t{17}})
        EXPECT_EQ(image.range({18, row}), -1.0);
    expect_nearest_returns(image, points);
}

TEST(range_image, of_any_cloud_holds_its_nearest_returns) {
    for (const auto& [name, points] : clouds::degenerate()) {
        SCOPED_TRACE(name);
        for (const Eigen::Vector3d& viewpoint : {origin, Eigen::Vector3d(0.3, 0.4, 0.5)}) {
            expect_nearest_returns(range_image(points, viewpoint, {.width = 24, .height = 12}),
                                   points);
            expect_nearest_returns(range_image(points, viewpoint, {1, 1, up}), points);
            const Eigen::Vector3d diagonal(1, 1, 1);
            expect_nearest_returns(range_image(points, viewpoint, {24, 12, diagonal}), points);
        }
    }
    const auto around = all_around(3000, 2);
    expect_nearest_returns(range_image(around, origin, {.width = 40, .height = 20}), around);
}

/// However few of its pixels are taken, each is found again, and nothing else.
TEST(range_image, of_few_points_in_many_pixels_holds_them) {
    for (const std::size_t n : {1u, 5u, 60u, 3000u}) {
        clouds::cloud points = clouds::in_cube(n, n);
        for (Eigen::Vector3d& p : points) p -= Eigen::Vector3d(0.5, 0.5, 0.5);
        points.push_back(2.0 * points.front());  // hidden
        points.push_back(0.5 * points.front());  // hides
        const range_image image(points, Eigen::Vector3d(0, 0, 0), {.width = 7200, .height = 3600});
        for (std::size_t i = 1; i + 2 < points.size(); ++i) {
            const auto at = image.pixel_of(points[i]);
            ASSERT_TRUE(image.index(at).has_value());
            EXPECT_LE(image.range(at), points[i].norm() * (1.0 + 1e-12));
        }
        EXPECT_EQ(image.index(image.pixel_of(points.front())), points.size() - 1);
        std::size_t taken = 0;
        for (std::size_t e = 0; e < image.height(); e += 7) {
            for (std::size_t a = 0; a < image.width(); a += 11) {
                if (const auto index = image.index({a, e})) {
                    EXPECT_EQ(image.pixel_of(points[*index]), (range_image::pixel{a, e}));
                    ++taken;
                }
            }
        }
        EXPECT_LE(taken, points.size());
    }
}

/// So near that the square of their distance underflows: they are in the view point.
TEST(range_image, omits_points_next_to_the_view_point) {
    clouds::cloud points = clouds::in_cube(100, 1);
    for (const double tiny : {2.71e-162, 1e-160, 1e-200, 5e-324})
        points.emplace_back(tiny, 0.0, 0.0);
    const range_image image(points, Eigen::Vector3d(0, 0, 0));
    EXPECT_EQ(image.range(image.pixel_of(Eigen::Vector3d(1, 0, 0))), range_image::nothing);
}

TEST(range_image, omits_points_at_the_view_point_and_non_finite_points) {
    const clouds::cloud points{origin, {clouds::nan, 1, 1}, {1, clouds::infinity, 0}};
    for (const auto& cloud : {points, clouds::cloud{}}) {
        const range_image image(cloud, origin, {.width = 8, .height = 4});
        for (std::size_t e = 0; e < 4; ++e) {
            for (std::size_t a = 0; a < 8; ++a) {
                EXPECT_EQ(image.range({a, e}), range_image::nothing);
                EXPECT_EQ(image.index({a, e}), std::nullopt);
            }
        }
        EXPECT_EQ(image.pixel_of({0, 0, 1}).elevation, 3u) << "z is the pole where nothing is seen";
    }
}

/// A scanner that rolls about its viewing direction, x, has points above and below, but none within
/// 20 degrees of some other axis. The image takes that axis as its pole, so that no points lie near
/// the pole (docs/thesis-notes.md, A2).
TEST(range_image, turns_its_poles_to_where_least_is_seen) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        const Eigen::Matrix3d r = seed == 1 ? Eigen::Matrix3d(Eigen::Matrix3d::Identity())
                                            : clouds::random_rotation(seed);
        clouds::cloud points;
        for (const Eigen::Vector3d& p : all_around(3000, seed))
            if (p.x() > std::sin(0.5) * p.norm()) points.push_back(r * p);
        std::vector<std::size_t> rows;
        const range_image image(points, origin, {.width = 360, .height = 180});
        for (const Eigen::Vector3d& p : points) rows.push_back(image.pixel_of(p).elevation);
        EXPECT_GE(*std::min_element(rows.begin(), rows.end()), 20u);
        EXPECT_LT(*std::max_element(rows.begin(), rows.end()), 160u);
    }
}

/// A panorama keeps its poles up and down.
TEST(range_image, of_a_panorama_is_upright) {
    gnomon::random_stream random(5);
    clouds::cloud points;
    for (int i = 0; i < 2000; ++i)
        points.push_back(direction(6.28318 * random.uniform(), 0.8 * random.uniform() - 0.4));
    const range_image image(points, origin, {.width = 36, .height = 180});
    const std::size_t top = image.pixel_of(up).elevation;
    EXPECT_TRUE(top < 5 || top > 174);
}

/// Turning cloud and pole together changes no range and no number, but where pixels begin.
TEST(range_image, turns_with_its_cloud) {
    const auto points = all_around(2000, 3);
    const range_image upright(points, origin, {.width = 1, .height = 90, .pole = up});
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const auto r = clouds::random_rotation(seed);
        const Eigen::Vector3d t(1, 2, 3);
        const range_image turned(clouds::moved(points, r, t), t,
                                 {.width = 1, .height = 90, .pole = Eigen::Vector3d(r * up * 7.0)});
        for (std::size_t e = 0; e < 90; ++e) {
            EXPECT_EQ(turned.index({0, e}), upright.index({0, e}));
            EXPECT_NEAR(turned.range({0, e}), upright.range({0, e}), 1e-12);
        }
    }
}

TEST(range_image, takes_any_pole) {
    const auto points = all_around(2000, 4);
    for (const Eigen::Vector3d& pole :
         {Eigen::Vector3d(1, 0, 0), {-1, 0, 0}, {0, 1, 0}, {0.9, 0.1, 0}, {1, 0, 1}}) {
        for (const double length : {1e-300, 1.0, 1e300}) {
            const range_image image(
                points, origin,
                {.width = 20, .height = 10, .pole = Eigen::Vector3d(length * pole)});
            EXPECT_EQ(image.pixel_of(pole.normalized()).elevation, 9u);
            expect_nearest_returns(image, points);
        }
    }
}

TEST(range_image, rejects_invalid_formats_and_view_points) {
    const auto points = all_around(10, 1);
    const auto make = [&](const range_image_options& format, const Eigen::Vector3d& viewpoint) {
        return range_image(points, viewpoint, format);
    };
    EXPECT_THROW(make({.width = 0}, origin), std::invalid_argument);
    EXPECT_THROW(make({.height = 0}, origin), std::invalid_argument);
    constexpr std::size_t wide = std::size_t{1} << 62;  // four rows of which are none, in 64 bits
    EXPECT_THROW(make({.width = wide, .height = 4}, origin), std::invalid_argument);
    EXPECT_THROW(make({.height = wide}, origin), std::invalid_argument);
    EXPECT_NO_THROW(make({.width = std::size_t{1} << 31, .height = 1000}, origin));
    EXPECT_THROW(make({}, {0, clouds::nan, 0}), std::invalid_argument);
    EXPECT_THROW(make({}, {clouds::infinity, 0, 0}), std::invalid_argument);
    EXPECT_THROW(make({.pole = origin}, origin), std::invalid_argument);
    EXPECT_THROW(make({.pole = Eigen::Vector3d(clouds::nan, 0, 1)}, origin), std::invalid_argument);
    EXPECT_THROW(make({.pole = Eigen::Vector3d(clouds::infinity, 0, 1)}, origin),
                 std::invalid_argument);
    EXPECT_NO_THROW(make({}, origin));
}

/// The direction of a pixel is seen in it, and is of unit length.
TEST(range_image, directions_of_pixels_are_seen_there) {
    const std::vector<Eigen::Vector3d> points{{1.0, 2.0, 3.0}, {-2.0, 1.0, 0.5}};
    for (const Eigen::Vector3d& pole : {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, 2, -1)}) {
        const Eigen::Vector3d from(0.5, -1.0, 2.0);
        const gnomon::range_image image(points, from, {24, 12, pole});
        for (std::size_t e = 0; e < 12; ++e) {
            for (std::size_t a = 0; a < 24; ++a) {
                const Eigen::Vector3d ray = image.direction_of({a, e});
                EXPECT_NEAR(ray.norm(), 1.0, 1e-12);
                const auto at = image.pixel_of(Eigen::Vector3d(from + 2.0 * ray));
                EXPECT_EQ(at.azimuth, a);
                EXPECT_EQ(at.elevation, e);
            }
        }
    }
}

/// Where `may_show` is false, no pixel within two rows of the position has a point.
TEST(range_image, may_show_is_conservative) {
    gnomon::random_stream random(5);
    const auto any = [&](double low, double high) {
        return Eigen::Vector3d(random.uniform(-3, 3), random.uniform(-3, 3),
                               random.uniform(low, high));
    };
    std::size_t denied = 0;
    for (int trial = 0; trial < 20; ++trial) {
        std::vector<Eigen::Vector3d> line;
        for (int i = 0; i < 100; ++i) line.push_back(any(0.0, 0.05));
        const gnomon::range_image image(line, Eigen::Vector3d(0, 0, 0),
                                        {72, 36, Eigen::Vector3d(0, 0, 1)});
        for (int i = 0; i < 200; ++i) {
            const Eigen::Vector3d place = any(-3.0, 3.0);
            if (image.may_show(place)) continue;
            ++denied;
            const auto at = image.pixel_of(place);
            for (std::size_t e = at.elevation - std::min<std::size_t>(at.elevation, 2);
                 e <= std::min<std::size_t>(at.elevation + 2, 35); ++e)
                for (std::size_t a = 0; a < 72; ++a) EXPECT_FALSE(image.index({a, e}));
        }
    }
    EXPECT_GT(denied, 1000u);
}

/// An image of a subset of a cloud stores indices into the whole cloud.
TEST(range_image, of_a_subset_stores_indices_into_the_cloud) {
    const clouds::cloud points = all_around(500, 5);
    std::vector<point_index> some;
    clouds::cloud alone;
    for (std::size_t i = 3; i < points.size(); i += 3) {
        some.push_back(static_cast<point_index>(i));
        alone.push_back(points[i]);
    }
    const range_image_options format{.width = 36, .height = 18};
    const range_image image(points, some, origin, format), other(alone, origin, format);
    for (std::size_t e = 0; e < 18; ++e) {
        for (std::size_t a = 0; a < 36; ++a) {
            EXPECT_EQ(image.range({a, e}), other.range({a, e}));
            ASSERT_EQ(image.index({a, e}).has_value(), other.index({a, e}).has_value());
            if (image.index({a, e})) {
                EXPECT_EQ(*image.index({a, e}), some[*other.index({a, e})]);
            }
        }
    }
    some.push_back(static_cast<point_index>(points.size()));
    EXPECT_THROW(range_image(points, some, origin), std::invalid_argument);
}

}  // namespace
