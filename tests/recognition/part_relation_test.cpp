// SPDX-License-Identifier: BSL-1.0
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string_view>
#include <vector>

#include <boost/hana/append.hpp>
#include <boost/hana/concat.hpp>
#include <boost/hana/for_each.hpp>
#include <gtest/gtest.h>

#include "laws/part_relation_laws.hpp"
#include "recognition/some_views.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/recognition/part_relation.hpp>

namespace rec = gnomon::recognition;

namespace {

// [own_relation]
/// A relation of a user: how far apart two parts are, seen from above [m].
struct level_distance {
    static constexpr std::string_view name = "level distance";
    double bin = 0.05, mass = 0.10, min_deviation = 0.02;
    double operator()(const rec::part& a, const rec::part& b) const {
        return (a.shape.frame.centroid - b.shape.frame.centroid).head<2>().norm();
    }
};
static_assert(rec::part_relation<level_distance>);

const auto with_level_distance = boost::hana::append(rec::default_relations, level_distance{});
// [own_relation]

struct relation_without_bin {
    static constexpr std::string_view name = "no bin";
    double mass = 0.1, min_deviation = 0.1;
    double operator()(const rec::part&, const rec::part&) const { return 0.0; }
};
struct relation_of_one {
    static constexpr std::string_view name = "one part";
    double bin = 1.0, mass = 0.1, min_deviation = 0.1;
    double operator()(const rec::part&) const { return 0.0; }
};
static_assert(!rec::part_relation<relation_without_bin>);
static_assert(!rec::part_relation<relation_of_one>);
static_assert(rec::part_relation<rec::normal_angle> && rec::part_relation<rec::centroid_distance> &&
              rec::part_relation<rec::height_difference> && rec::part_relation<rec::plane_offset>);
static_assert(rec::relation_count<decltype(rec::thesis_relations)> == 2);
static_assert(rec::relation_count<decltype(rec::no_relations)> == 0);
static_assert(rec::relation_count<decltype(with_level_distance)> == 5);

rec::part related_part(const Eigen::Vector3d& centroid, const Eigen::Vector3d& normal,
                       double extent = 1.0) {
    rec::part p;
    p.shape.frame.centroid = centroid;
    p.shape.normal = normal.normalized();
    p.shape.frame.spectrum.lambda[0] = extent;
    return p;
}

TEST(part_relation, are_those_of_a_seat_and_a_back) {
    auto seat = related_part({0.0, 0.0, 0.45}, {0.0, 0.0, 1.0}, 2.0);
    auto back = related_part({-0.2, 0.0, 0.7}, {1.0, 0.0, 0.0}, 1.0);
    seat.lowest = seat.highest = 0.45;
    back.lowest = 0.5;
    back.highest = 0.9;
    EXPECT_NEAR(rec::normal_angle{}(seat, back), 0.5 * std::numbers::pi, 1e-12);
    EXPECT_NEAR(rec::centroid_distance{}(seat, back), std::hypot(0.2, 0.25), 1e-12);
    EXPECT_NEAR(rec::height_difference{}(seat, back), 0.25, 1e-12);
    EXPECT_NEAR(rec::plane_offset{}(seat, back), 0.2, 1e-12);
    EXPECT_EQ(rec::relation_vector(with_level_distance, seat, back)[4], 0.2);
}

/// docs/thesis-notes.md, A31: a board is seen from either side.
TEST(normal_angle, folds_angles_on_request) {
    const auto a = related_part({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0});
    for (const double t : {0.0, 0.3, 1.2, 1.9, 3.0, std::numbers::pi}) {
        const auto b = related_part({0.0, 0.0, 0.0}, {std::sin(t), 0.0, std::cos(t)});
        EXPECT_NEAR(rec::normal_angle{}(a, b), t, 1e-7);
        EXPECT_NEAR(rec::normal_angle{.is_folded = true}(a, b), std::min(t, std::numbers::pi - t),
                    1e-7);
    }
}

TEST(part_relation, obeys_the_laws) {
    const Eigen::Vector3d eye(5.0, 0.5, 1.2), by(3.0, -1.0, 0.0);
    const Eigen::Matrix3d turn = some_views::yaw(2.0);
    const auto all = boost::hana::concat(with_level_distance, rec::thesis_relations);
    for (std::uint32_t kind = 0; kind < 3; ++kind) {
        gnomon::random_stream random(2, kind);
        auto c = some_views::furniture(kind, random);
        const auto v = some_views::view_of(c);
        c.move(turn, by);
        const auto moved = some_views::view_of(c, some_views::floor_plane, turn * eye + by);
        boost::hana::for_each(all, [&](const auto& r) { laws::part_relation_laws(r, v, moved); });
    }
}

/// The order of the parts does not matter, nor where both are equally large.
TEST(plane_offset, does_not_depend_on_the_order_of_equal_parts) {
    const auto a = related_part({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0});
    const auto b = related_part({0.3, 0.0, 1.0}, {1.0, 0.0, 0.0});
    EXPECT_EQ(rec::plane_offset{}(a, b), rec::plane_offset{}(b, a));
}

/// Relations by segments of a view.
auto relations_by_segment(const rec::view& v) {
    constexpr std::size_t R = rec::relation_count<decltype(with_level_distance)>;
    const std::size_t n = v.parts.size();
    std::vector<std::array<double, R>> x(n * n);
    for (const auto& a : v.parts)
        for (const auto& b : v.parts)
            if (&a != &b)
                x[static_cast<std::size_t>(a.segment) * n + static_cast<std::size_t>(b.segment)] =
                    rec::relation_vector(with_level_distance, a, b);
    return x;
}

TEST(part_relation, does_not_depend_on_yaw_and_place) {
    const Eigen::Vector3d eye(5.0, 0.5, 1.2);
    for (const double far : {1.0, 1e5}) {  // at UTM coordinates, up to their rounding
        for (std::uint32_t kind = 0; kind < 3; ++kind) {
            gnomon::random_stream random(3, kind);
            auto c = some_views::furniture(kind, random);
            const auto before = relations_by_segment(some_views::view_of(c));
            const Eigen::Matrix3d turn = some_views::yaw(1.1);
            const Eigen::Vector3d by(4.0 * far, 50.0 * far, 0.0);
            c.move(turn, by);
            const auto after = relations_by_segment(
                some_views::view_of(c, some_views::floor_plane, turn * eye + by));
            for (std::size_t i = 0; i < before.size(); ++i)
                for (std::size_t r = 0; r < before[i].size(); ++r)
                    EXPECT_NEAR(before[i][r], after[i][r], 1e-9 * far + 1e-7) << r;
        }
    }
}

TEST(part_relation, heights_are_zero_without_ground) {
    gnomon::random_stream random(4);
    const auto v = some_views::view_of(some_views::furniture(0, random), std::nullopt);
    EXPECT_EQ(rec::height_difference{}(v.parts[0], v.parts[1]), 0.0);
}

}  // namespace
