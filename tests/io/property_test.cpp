// SPDX-License-Identifier: BSL-1.0
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <gnomon/io/property.hpp>

namespace {

namespace io = gnomon::io;
using io::field_type;

enum class kind : std::uint8_t { floor, wall };

struct labeled_surfel {
    Eigen::Vector3f normal;
    float quality;
    kind of;
    std::array<std::uint8_t, 3> color;
};

const std::vector<labeled_surfel> some_surfels = {{{0, 0, 1}, 0.5F, kind::wall, {1, 2, 3}},
                                                  {{1, 0, 0}, 0.25F, kind::floor, {255, 0, 7}}};

template <class T>
field_type deduced() {
    const std::vector<T> values(1);
    return io::scalar_property("v", values).type;
}

TEST(io_property, takes_its_type_from_the_values) {
    EXPECT_EQ(deduced<std::int8_t>(), field_type::int8);
    EXPECT_EQ(deduced<std::uint8_t>(), field_type::uint8);
    EXPECT_EQ(deduced<bool>(), field_type::uint8);
    EXPECT_EQ(deduced<std::int16_t>(), field_type::int16);
    EXPECT_EQ(deduced<std::uint16_t>(), field_type::uint16);
    EXPECT_EQ(deduced<std::int32_t>(), field_type::int32);
    EXPECT_EQ(deduced<std::uint32_t>(), field_type::uint32);
    EXPECT_EQ(deduced<std::int64_t>(), field_type::float64);
    EXPECT_EQ(deduced<std::uint64_t>(), field_type::float64);
    EXPECT_EQ(deduced<float>(), field_type::float32);
    EXPECT_EQ(deduced<double>(), field_type::float64);
    EXPECT_EQ(deduced<kind>(), field_type::uint8);
}

TEST(io_property, reads_through_members_and_functions) {
    const io::property quality =
        io::scalar_property("quality", some_surfels, &labeled_surfel::quality);
    EXPECT_EQ(quality.name, "quality");
    EXPECT_EQ(quality.type, field_type::float32);
    EXPECT_EQ(quality.size, 2U);
    EXPECT_EQ(quality.value(1), 0.25);
    EXPECT_EQ(io::scalar_property("kind", some_surfels, &labeled_surfel::of).value(0), 1);
    const auto twice = [](const labeled_surfel& s) { return 2.0 * static_cast<double>(s.quality); };
    EXPECT_EQ(io::scalar_property("twice", some_surfels, twice).value(0), 1);
    const std::vector<bool> proxies = {false, true};
    EXPECT_EQ(io::scalar_property("proxy", proxies).value(1), 1);
}

TEST(io_property, names_the_components_of_normals_and_colors) {
    const io::properties both = {io::normal_properties(some_surfels, &labeled_surfel::normal),
                                 io::color_properties(some_surfels, &labeled_surfel::color)};
    ASSERT_EQ(both.size(), 6U);
    std::string names;
    for (const io::property& p : both) names += p.name + " ";
    EXPECT_EQ(names, "nx ny nz red green blue ");
    EXPECT_EQ(both.begin()[2].value(0), 1);
    EXPECT_EQ(both.begin()[0].value(1), 1);
    EXPECT_EQ(both.begin()[0].type, field_type::float32);
    EXPECT_EQ(both.begin()[3].value(1), 255);
    EXPECT_EQ(both.begin()[5].value(0), 3);
    EXPECT_EQ(both.begin()[5].type, field_type::uint8);
}

TEST(io_property, groups_nest) {
    const std::vector<float> values(2);
    const io::properties one = io::scalar_property("a", values);
    const io::properties two = {one, io::scalar_property("b", values)};
    const io::properties four = {two, {}, two};
    EXPECT_EQ(one.size(), 1U);
    EXPECT_EQ(two.size(), 2U);
    EXPECT_EQ(four.size(), 4U);
    EXPECT_EQ(io::properties{}.size(), 0U);
    EXPECT_EQ(io::properties{two}.size(), 2U);
}

template <class R>
concept makes_scalar_property =
    requires(R&& range) { io::scalar_property("v", std::forward<R>(range)); };

TEST(io_property, does_not_refer_to_a_temporary) {
    static_assert(makes_scalar_property<std::vector<int>&>);
    static_assert(makes_scalar_property<const std::span<int>&>);
    static_assert(!makes_scalar_property<std::vector<int>>);
    static_assert(!makes_scalar_property<const std::vector<int>>);
    static_assert(!makes_scalar_property<std::vector<std::string>&>);
}

TEST(io_property, takes_the_fields_of_a_scan_along) {
    gnomon::scan scan;
    scan.points.resize(2);
    scan.fields = {{"red", {1, 2}, field_type::uint8},
                   {"column 4", {0.5, 1.5}},
                   {"column_4", {0, 0}},
                   {"", {3, 4}, field_type::int16},
                   {"label", {5, 6}, field_type::int32}};
    const std::vector<std::string> names{"red", "column_4", "_", "label"};
    const io::properties all = io::field_properties(scan);
    ASSERT_EQ(all.size(), names.size());
    for (std::size_t k = 0; k < names.size(); ++k)
        EXPECT_EQ(all.begin()[static_cast<std::ptrdiff_t>(k)].name, names[k]);
    EXPECT_EQ(all.begin()->type, field_type::uint8);
    EXPECT_EQ(all.begin()->size, 2u);
    EXPECT_EQ(all.begin()->value(1), 2.0);

    const std::vector<int> labels{7, 8};
    const io::properties mine = io::scalar_property("label", labels);
    EXPECT_EQ(io::field_properties(scan, mine).size(), 3u);
    EXPECT_EQ((io::properties{mine, io::field_properties(scan, mine)}).size(), 4u);
}

}  // namespace
