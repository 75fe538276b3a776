// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <boost/hana/append.hpp>
#include <boost/hana/tuple.hpp>
#include <gtest/gtest.h>

#include "recognition/some_views.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/recognition/part_features.hpp>
#include <gnomon/recognition/view_descriptor.hpp>

namespace rec = gnomon::recognition;

namespace {

const rec::view_descriptor default_descriptor{rec::default_features, rec::default_relations, true};

void expect_near_descriptions(const std::vector<double>& a, const std::vector<double>& b,
                              double tolerance) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], tolerance) << i;
}

TEST(view_descriptor, has_a_fixed_length_and_finite_values) {
    const std::size_t length = default_descriptor(some_views::training().views.front()).size();
    for (const auto& v : some_views::training().views) {
        for (std::size_t n = 0; n <= v.parts.size(); ++n) {
            const auto d = default_descriptor(some_views::with_parts(v, n));
            EXPECT_EQ(d.size(), length);
            EXPECT_TRUE(std::all_of(d.begin(), d.end(), [](double x) { return std::isfinite(x); }));
            EXPECT_EQ(d[0], static_cast<double>(n));
        }
    }
}

TEST(view_descriptor, counts_what_is_about_pairs) {
    const rec::view_descriptor without{rec::default_features, rec::no_relations, true};
    const auto& v = some_views::training().views.front();
    EXPECT_EQ(default_descriptor(v).size(), without(v).size() + default_descriptor.pair_columns);
    EXPECT_EQ(without.pair_columns, 0u);
}

/// The heading of an object and its place on the floor change nothing: the view point turns with
/// it.
TEST(view_descriptor, does_not_depend_on_yaw_and_place) {
    const Eigen::Vector3d eye(5.0, 0.5, 1.2);
    for (std::uint32_t kind = 0; kind < 3; ++kind) {
        gnomon::random_stream random(5, kind);
        auto c = some_views::furniture(kind, random);
        const auto before = default_descriptor(some_views::view_of(c));
        const Eigen::Matrix3d turn = some_views::yaw(2.0);
        const Eigen::Vector3d by(3.0, -8.0, 0.0);
        c.move(turn, by);
        const auto after =
            default_descriptor(some_views::view_of(c, some_views::floor_plane, turn * eye + by));
        expect_near_descriptions(before, after, 1e-6);
    }
}

/// Describing some of the parts is describing a view that has only these.
TEST(view_descriptor, describes_parts_as_a_view_without_the_others) {
    gnomon::random_stream random(6);
    for (auto v : some_views::training().views) {
        for (int i = 0; i < 40; ++i) v.rest.add(random.uniform(0.1, 2.0), random.uniform(), 0.3);
        const auto measured = default_descriptor.measure(v);
        rec::view some{.parts = {}, .ground = v.ground, .rest = {}};
        std::vector<std::size_t> chosen;
        for (std::size_t i = 0; i < v.parts.size(); ++i) {
            if (random.uniform() < 0.4) continue;
            chosen.push_back(i);
            some.parts.push_back(v.parts[i]);
        }
        EXPECT_EQ(default_descriptor.describe(v, measured, chosen, false),
                  default_descriptor(some));
        some.rest = v.rest;
        EXPECT_EQ(default_descriptor.describe(v, measured, chosen, true), default_descriptor(some));
    }
}

TEST(view_descriptor, numbers_pairs) {
    using measured = rec::measured_view<1, 1>;
    std::size_t number = 0;
    for (std::size_t j = 0; j < 9; ++j)
        for (std::size_t i = 0; i < j; ++i) EXPECT_EQ(measured::pair(i, j), number++);
    const auto& v = some_views::training().views.front();
    const auto m = default_descriptor.measure(v);
    const std::size_t n = v.parts.size();
    EXPECT_EQ(m.pairs.size(), n * (n - 1) / 2);
    EXPECT_EQ(m.pairs[measured::pair(1, 3)],
              rec::relation_vector(rec::default_relations, v.parts[1], v.parts[3]));
}

TEST(view_descriptor, differs_between_kinds_of_furniture) {
    const auto& t = some_views::training();
    const auto chair = default_descriptor(t.views[0]), table = default_descriptor(t.views[1]),
               other_chair = default_descriptor(t.views[3]);
    const auto distance = [](const auto& a, const auto& b) {
        double sum = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
        return sum;
    };
    EXPECT_GT(distance(chair, table), 2.0 * distance(chair, other_chair));
}

TEST(view_descriptor, needs_the_ground_for_heights) {
    auto v = some_views::training().views.front();
    v.ground.reset();
    EXPECT_THROW((void)default_descriptor(v), std::invalid_argument);
    const rec::view_descriptor profile_only{boost::hana::make_tuple(), rec::no_relations, true};
    EXPECT_THROW((void)profile_only(v), std::invalid_argument);
    const rec::view_descriptor without{rec::invariant_features, rec::thesis_relations, false};
    EXPECT_NO_THROW((void)without(v));
}

/// Features for any pose, and relations that do not need heights: no pose changes a description.
TEST(view_descriptor, does_not_depend_on_the_pose_without_heights) {
    const rec::view_descriptor without{rec::invariant_features, rec::thesis_relations, false};
    gnomon::random_stream random(8);
    const Eigen::Vector3d eye(5.0, 0.5, 1.2);
    for (std::uint32_t kind = 0; kind < 3; ++kind) {
        auto c = some_views::furniture(kind, random);
        const auto before = without(some_views::view_of(c, std::nullopt, eye));
        const Eigen::Matrix3d turn = some_views::any_rotation(random);
        c.move(turn, {1.0, 2.0, 3.0});
        const auto after =
            without(some_views::view_of(c, std::nullopt, turn * eye + Eigen::Vector3d(1, 2, 3)));
        expect_near_descriptions(before, after, 1e-6);
    }
}

TEST(view_descriptor, takes_features_and_relations_of_a_user) {
    const rec::view_descriptor own{
        boost::hana::append(rec::default_features, some_views::share_of_points{}),
        boost::hana::append(rec::default_relations, some_views::ratio_of_points{}), true};
    const auto& v = some_views::training().views.front();
    EXPECT_EQ(own(v).size(), default_descriptor(v).size() + 7 + 3);
}

TEST(view_descriptor, refuses_features_that_are_not_finite) {
    const auto& v = some_views::training().views.front();
    const rec::view_descriptor bad{boost::hana::make_tuple(some_views::nan_feature{}),
                                   rec::no_relations, false};
    EXPECT_THROW((void)bad(v), std::invalid_argument);
}

TEST(view_descriptor, refuses_height_profiles_that_are_not_finite) {
    auto v = some_views::training().views.front();
    v.rest.levels[6].points = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW((void)default_descriptor(v), std::invalid_argument);
    v = some_views::training().views.front();
    v.parts[0].profile.levels[7].uu = std::numeric_limits<double>::infinity();
    EXPECT_THROW((void)default_descriptor(v), std::invalid_argument);
}

TEST(view_descriptor, refuses_relations_that_are_not_finite) {
    const auto& v = some_views::training().views.front();
    const rec::view_descriptor bad{rec::invariant_features,
                                   boost::hana::make_tuple(some_views::nan_relation{}), false};
    EXPECT_THROW((void)bad(v), std::invalid_argument);
}

}  // namespace
