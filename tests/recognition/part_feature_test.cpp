// SPDX-License-Identifier: BSL-1.0
#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

#include <boost/hana/append.hpp>
#include <boost/hana/tuple.hpp>
#include <gtest/gtest.h>

#include "recognition/some_views.hpp"
#include <gnomon/recognition/part_feature.hpp>
#include <gnomon/recognition/part_features.hpp>

namespace rec = gnomon::recognition;
namespace hana = boost::hana;

namespace {

// [own_feature]
/// A feature of a user: the number of points of a part.
struct point_number {
    static constexpr std::string_view name = "number of points";
    double scale = 100.0, weight = 0.5;
    double operator()(const rec::part& p, const rec::view&) const {
        return static_cast<double>(p.shape.points);
    }
};
static_assert(rec::part_feature<point_number>);

const auto with_points = hana::append(rec::default_features, point_number{});
// [own_feature]

struct feature_without_scale {
    static constexpr std::string_view name = "no scale";
    double weight = 1.0;
    double operator()(const rec::part&, const rec::view&) const { return 0.0; }
};
struct feature_without_view {
    static constexpr std::string_view name = "no view";
    double scale = 1.0, weight = 1.0;
    double operator()(const rec::part&) const { return 0.0; }
};
struct feature_without_name {
    double scale = 1.0, weight = 1.0;
    double operator()(const rec::part&, const rec::view&) const { return 0.0; }
};
static_assert(!rec::part_feature<feature_without_scale>);
static_assert(!rec::part_feature<feature_without_view>);
static_assert(!rec::part_feature<feature_without_name>);
static_assert(rec::part_feature<rec::mean_height> && rec::part_feature<rec::lowest_height> &&
              rec::part_feature<rec::highest_height> && rec::part_feature<rec::inclination> &&
              rec::part_feature<rec::variation> && rec::part_feature<rec::elongation> &&
              rec::part_feature<rec::box_volume> && rec::part_feature<rec::box_edge<1>>);

static_assert(rec::feature_count<decltype(rec::thesis_features)> == 5);
static_assert(rec::feature_count<decltype(with_points)> ==
              rec::feature_count<decltype(rec::default_features)> + 1);
static_assert(rec::feature_count<hana::tuple<>> == 0);

TEST(feature_vector, divides_values_by_their_scales_in_order) {
    const auto& v = some_views::training().views.front();
    const auto features = hana::make_tuple(point_number{}, rec::highest_height{.scale = 0.5});
    for (const auto& p : v.parts) {
        const auto x = rec::feature_vector(features, p, v);
        EXPECT_DOUBLE_EQ(x[0], static_cast<double>(p.shape.points) / 100.0);
        EXPECT_DOUBLE_EQ(x[1], p.highest / 0.5);
    }
    EXPECT_EQ(rec::feature_weights(features), (std::array<double, 2>{0.5, 1.0}));
}

TEST(feature_vector, names_the_feature_that_needs_the_ground) {
    auto v = some_views::training().views.front();
    v.ground.reset();
    try {
        (void)rec::feature_vector(hana::make_tuple(point_number{}, rec::mean_height{}), v.parts[0],
                                  v);
        FAIL();
    } catch (const std::invalid_argument& e) {
        EXPECT_NE(std::string(e.what()).find("mean height"), std::string::npos) << e.what();
        EXPECT_NE(std::string(e.what()).find("ground"), std::string::npos) << e.what();
    }
    for (const auto& p : v.parts)
        EXPECT_NO_THROW((void)rec::feature_vector(rec::invariant_features, p, v));
}

/// Heights above a ground whose normal is of another length would be of other units.
TEST(feature_vector, refuses_a_ground_of_another_length) {
    auto v = some_views::training().views.front();
    v.ground->normal *= 2.0;
    EXPECT_THROW((void)rec::feature_vector(rec::default_features, v.parts[0], v),
                 std::invalid_argument);
}

TEST(feature_vector, names_the_feature_that_is_not_finite) {
    const auto& v = some_views::training().views.front();
    try {
        (void)rec::feature_vector(hana::make_tuple(some_views::nan_feature{}), v.parts[0], v);
        FAIL();
    } catch (const std::invalid_argument& e) {
        EXPECT_NE(std::string(e.what()).find("feature of NaN"), std::string::npos) << e.what();
    }
    EXPECT_THROW(
        (void)rec::feature_vector(hana::make_tuple(point_number{.scale = 0.0}), v.parts[0], v),
        std::invalid_argument);
}

}  // namespace
