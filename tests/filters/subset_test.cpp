// SPDX-License-Identifier: BSL-1.0
#include <cstddef>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/scan.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/filters/subset.hpp>

namespace {

using indices = std::vector<gnomon::point_index>;

/// An image of 3 rows of 4 pixels, with a field.
gnomon::scan small_image() {
    gnomon::scan all{.points = clouds::in_cube(12, 1), .viewpoints = {}, .fields = {}, .width = 4};
    all.fields.push_back({"color", {}, gnomon::scan::field_type::uint8});
    for (int i = 0; i < 12; ++i) all.fields[0].values.push_back(20 * i);
    return all;
}

TEST(subset, takes_points_view_points_and_fields_along) {
    gnomon::scan all = small_image();
    indices scan_of_point;
    for (gnomon::point_index i = 0; i < 12; ++i) scan_of_point.push_back(i % 2);
    const std::vector<Eigen::Vector3d> sensors{{1, 2, 3}, {4, 5, 6}};
    const std::vector<gnomon::viewpoint_table> tables{{},
                                                      Eigen::Vector3d(7, 8, 9),
                                                      {sensors, scan_of_point},
                                                      gnomon::viewpoint_table(all.points)};
    for (const indices& kept : {indices{0, 3, 7, 11}, indices{5}, indices{}, indices{9, 2, 2}}) {
        for (const gnomon::viewpoint_table& table : tables) {
            all.viewpoints = table;
            const gnomon::scan part = gnomon::subset(all, kept);
            ASSERT_EQ(part.size(), kept.size());
            ASSERT_EQ(part.fields.size(), 1u);
            EXPECT_EQ(part.fields[0].name, "color");
            EXPECT_EQ(part.fields[0].type, gnomon::scan::field_type::uint8);
            EXPECT_TRUE(part.viewpoints.covers(part.size()));
            EXPECT_EQ(part.viewpoints.empty(),
                      table.empty() || (kept.empty() && part.viewpoints.empty()));
            EXPECT_EQ(part.width, 0u);
            for (std::size_t k = 0; k < kept.size(); ++k) {
                EXPECT_EQ(part.points[k], all.points[kept[k]]);
                EXPECT_EQ(part.fields[0].values[k], all.fields[0].values[kept[k]]);
                EXPECT_EQ(part.viewpoints[k], all.viewpoints[kept[k]]);
            }
        }
    }
}

TEST(subset, keeps_one_view_point_per_scan) {
    gnomon::scan all = small_image();
    all.viewpoints = gnomon::viewpoint_table({{1, 2, 3}, {4, 5, 6}},
                                             indices{0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1});
    EXPECT_EQ(gnomon::subset(all, indices{1, 6, 7}).viewpoints.positions().size(), 2u);
}

TEST(subset, is_an_image_only_as_a_whole) {
    const gnomon::scan all = small_image();
    indices kept(12);
    std::iota(kept.begin(), kept.end(), 0u);
    EXPECT_EQ(gnomon::subset(all, kept).width, 4u);
    std::swap(kept[3], kept[4]);
    EXPECT_EQ(gnomon::subset(all, kept).width, 0u);
    kept.pop_back();
    EXPECT_EQ(gnomon::subset(all, kept).width, 0u);
}

TEST(subset, takes_elements_of_any_vector) {
    const std::vector<std::string> names{"a", "b", "c"};
    EXPECT_EQ(gnomon::subset(names, indices{2, 0}), (std::vector<std::string>{"c", "a"}));
    const std::vector<bool> flags{true, false, true};
    EXPECT_EQ(gnomon::subset(flags, indices{1, 2}), (std::vector<bool>{false, true}));
}

TEST(subset, refuses_indices_and_tables_of_another_cloud) {
    gnomon::scan all = small_image();
    EXPECT_THROW(static_cast<void>(gnomon::subset(all, indices{12})), std::invalid_argument);
    all.viewpoints = gnomon::viewpoint_table(std::vector<Eigen::Vector3d>(3));
    EXPECT_THROW(static_cast<void>(gnomon::subset(all, indices{0})), std::invalid_argument);
    all.viewpoints = {};
    all.fields[0].values.pop_back();
    EXPECT_THROW(static_cast<void>(gnomon::subset(all, indices{0})), std::invalid_argument);
}

TEST(complement, is_what_is_not_kept) {
    EXPECT_EQ(gnomon::complement(indices{1, 2, 4}, 6), (indices{0, 3, 5}));
    EXPECT_EQ(gnomon::complement(indices{}, 3), (indices{0, 1, 2}));
    EXPECT_EQ(gnomon::complement(indices{0, 1, 2}, 3), indices{});
    EXPECT_EQ(gnomon::complement(indices{}, 0), indices{});
    EXPECT_THROW(static_cast<void>(gnomon::complement(indices{3}, 3)), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(gnomon::complement(indices{1, 1}, 3)), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(gnomon::complement(indices{2, 1}, 3)), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(gnomon::complement(indices{}, std::size_t{1} << 32)),
                 std::invalid_argument);
}

}  // namespace
