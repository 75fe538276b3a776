// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <stdexcept>

#include <boost/hana/append.hpp>
#include <boost/hana/concat.hpp>
#include <boost/hana/for_each.hpp>
#include <boost/hana/tuple.hpp>
#include <gtest/gtest.h>

#include "laws/part_feature_laws.hpp"
#include "recognition/some_views.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/recognition/part_features.hpp>

namespace rec = gnomon::recognition;

namespace {

const auto all_features = boost::hana::concat(rec::thesis_features, rec::default_features);

some_views::cloud featured_cloud(std::uint64_t seed) {
    gnomon::random_stream random(seed);
    return some_views::furniture(static_cast<std::uint32_t>(seed % 3), random);
}

/// The features of the parts of a view, by the number of their segment.
template <class Features>
auto features_by_segment(const Features& features, const rec::view& v) {
    std::vector<std::array<double, rec::feature_count<Features>>> x(v.parts.size());
    for (const auto& p : v.parts)
        x.at(static_cast<std::size_t>(p.segment)) = rec::feature_vector(features, p, v);
    return x;
}

void expect_near_features(const auto& a, const auto& b, double tolerance) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t s = 0; s < a.size(); ++s)
        for (std::size_t f = 0; f < a[s].size(); ++f)
            EXPECT_NEAR(a[s][f], b[s][f], tolerance) << "feature " << f << " of part " << s;
}

/// Sec. 5.2.2: features do not depend on the heading of an object, nor on its place on the floor.
TEST(part_features, do_not_depend_on_yaw_and_place) {
    gnomon::random_stream random(1);
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        auto c = featured_cloud(seed);
        const auto before = features_by_segment(all_features, some_views::view_of(c));
        c.move(some_views::yaw(random.uniform(-3.0, 3.0)),
               {random.uniform(-9.0, 9.0), random.uniform(-9.0, 9.0), 0.0});
        expect_near_features(features_by_segment(all_features, some_views::view_of(c)), before,
                             1e-9);
    }
}

/// At UTM coordinates, 500 m above the ellipsoid: up to the rounding of 1e-9 m of coordinates.
TEST(part_features, do_not_depend_on_the_place_at_utm_coordinates) {
    const Eigen::Vector3d far(4e5, 5e6, 500.0);
    const gnomon::plane ground{{0.0, 0.0, 1.0}, 500.0};
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        auto c = featured_cloud(seed);
        const auto before = features_by_segment(all_features, some_views::view_of(c));
        c.move(some_views::yaw(0.7), far);
        const auto v = some_views::view_of(c, ground, far + Eigen::Vector3d(5.0, 0.5, 1.2));
        expect_near_features(features_by_segment(all_features, v), before, 1e-6);
    }
}

/// On an inclined floor, heights are those above it.
TEST(part_features, are_those_above_an_inclined_ground) {
    const Eigen::Matrix3d tilt =
        Eigen::AngleAxisd(0.3, Eigen::Vector3d(1.0, 2.0, 0.0).normalized()).toRotationMatrix();
    auto c = featured_cloud(4);
    const auto before = features_by_segment(all_features, some_views::view_of(c));
    const Eigen::Vector3d by(1.0, 2.0, 3.0);
    c.move(tilt, by);
    const Eigen::Vector3d up = tilt.col(2);
    const auto v = some_views::view_of(c, gnomon::plane{up, up.dot(by)});
    expect_near_features(features_by_segment(all_features, v), before, 1e-9);
}

TEST(part_features, invariant_ones_do_not_depend_on_any_pose_and_need_no_ground) {
    gnomon::random_stream random(2);
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        auto c = featured_cloud(seed);
        const auto before =
            features_by_segment(rec::invariant_features, some_views::view_of(c, std::nullopt));
        c.move(some_views::any_rotation(random), {1.0, -7.0, 3.0});
        const auto v = some_views::view_of(c, std::nullopt);
        expect_near_features(features_by_segment(rec::invariant_features, v), before, 1e-9);
    }
}

TEST(part_features, obey_the_laws) {
    const auto with_own = boost::hana::append(
        boost::hana::concat(all_features, rec::invariant_features), some_views::share_of_points{});
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        auto c = featured_cloud(seed);
        const auto v = some_views::view_of(c);
        c.move(some_views::yaw(2.0), {3.0, -1.0, 0.0});
        const auto moved = some_views::view_of(c);
        boost::hana::for_each(with_own,
                              [&](const auto& f) { laws::part_feature_laws(f, v, moved); });
    }
}

/// Analytic: a level board and an upright one. A uniform board of half edge a has the variance
/// a^2 / 3.
TEST(part_features, are_those_of_boards) {
    gnomon::random_stream random(3);
    some_views::cloud c;
    c.add_board({1.0, 2.0, 0.7}, {0.6, 0.0, 0.0}, {0.0, 0.3, 0.0}, 5000, random, 0.0);
    c.add_board({1.0, 2.0, 0.5}, {0.0, 0.1, 0.0}, {0.0, 0.0, 0.4}, 4000, random, 0.0);
    const auto v = some_views::view_of(c);
    ASSERT_EQ(v.parts.size(), 2u);
    const auto& level = v.parts[0];
    const auto& upright = v.parts[1];
    EXPECT_NEAR(rec::mean_height{}(level, v), 0.7, 1e-9);
    EXPECT_NEAR(rec::mean_height{}(upright, v), 0.5, 0.02);
    EXPECT_NEAR(rec::lowest_height{}(upright, v), 0.1, 0.01);
    EXPECT_NEAR(rec::highest_height{}(upright, v), 0.9, 0.01);
    EXPECT_NEAR(rec::inclination{}(level, v), 0.0, 1e-6);
    EXPECT_NEAR(rec::inclination{}(upright, v), 1.0, 1e-6);
    EXPECT_NEAR(rec::variation{}(level, v), 0.0, 1e-9);
    EXPECT_NEAR(rec::box_edge<0>{}(level, v), 1.2, 0.02);
    EXPECT_NEAR(rec::box_edge<1>{}(level, v), 0.6, 0.02);
    EXPECT_NEAR(rec::box_edge<2>{}(level, v), 0.0, 1e-9);
    EXPECT_NEAR(rec::box_volume{}(level, v), 0.0, 1e-9);
    EXPECT_EQ(rec::elongation{}(level, v), level.shape.aspect_ratio());
}

TEST(part_features, edges_descend_and_make_the_volume) {
    for (const auto& v : some_views::training().views) {
        for (const auto& p : v.parts) {
            const double a = rec::box_edge<0>{}(p, v), b = rec::box_edge<1>{}(p, v),
                         c = rec::box_edge<2>{}(p, v);
            EXPECT_GE(a, b);
            EXPECT_GE(b, c);
            EXPECT_NEAR(a * b * c, rec::box_volume{}(p, v), 1e-12);
            EXPECT_GE(rec::inclination{}(p, v), 0.0);
            EXPECT_LE(rec::inclination{}(p, v), 1.0);
            EXPECT_LE(rec::lowest_height{}(p, v), rec::mean_height{}(p, v));
            EXPECT_LE(rec::mean_height{}(p, v), rec::highest_height{}(p, v));
        }
    }
}

TEST(part_features, of_heights_need_the_ground) {
    auto v = some_views::training().views.front();
    v.ground.reset();
    EXPECT_THROW((void)rec::mean_height{}(v.parts[0], v), std::invalid_argument);
    EXPECT_THROW((void)rec::lowest_height{}(v.parts[0], v), std::invalid_argument);
    EXPECT_THROW((void)rec::highest_height{}(v.parts[0], v), std::invalid_argument);
    EXPECT_THROW((void)rec::inclination{}(v.parts[0], v), std::invalid_argument);
}

/// Sec. 5.6.1: the weights have the sum 0.99.
TEST(part_features, have_the_weights_of_the_thesis) {
    const std::array<double, 5> weights{0.30, 0.30, 0.13, 0.13, 0.13};
    EXPECT_EQ(rec::feature_weights(rec::thesis_features), weights);
}

}  // namespace
