// SPDX-License-Identifier: BSL-1.0
#include <set>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include <gnomon/simulation/table.hpp>

namespace {

using gnomon::table;
using gnomon::table_base;

std::set<std::string> parts_of(const table& t) {
    gnomon::scene world;
    gnomon::add(world, "table", t);
    std::set<std::string> parts;
    for (const auto& part : world.parts()) parts.insert(part.name);
    return parts;
}

TEST(table, names_its_parts) {
    using names = std::set<std::string>;
    EXPECT_EQ(parts_of({.shelf_height = 0.2}),
              (names{"top", "leg 1", "leg 2", "leg 3", "leg 4", "shelf"}));
    EXPECT_EQ(parts_of({.base = table_base::panels}), (names{"top", "panel 1", "panel 2"}));
    EXPECT_EQ(parts_of({.base = table_base::pedestal}), (names{"top", "column", "foot"}));
    EXPECT_EQ(parts_of({.base = table_base::trestles}), (names{"top", "trestle 1", "trestle 2"}));
}

TEST(table, is_as_large_as_its_measures) {
    gnomon::scene world;
    gnomon::add(world, "table", table{.length = 1.4, .round = true});
    const gnomon::bounds extent = world.extent();
    EXPECT_LT((extent.low - Eigen::Vector3d(-0.7, -0.7, 0.0)).norm(), 1e-9);
    EXPECT_LT((extent.high - Eigen::Vector3d(0.7, 0.7, 0.74)).norm(), 1e-9);
}

TEST(table, scales_all_its_measures) {
    for (const table_base base :
         {table_base::legs, table_base::panels, table_base::pedestal, table_base::trestles}) {
        const table t{.base = base, .shelf_height = 0.2};
        gnomon::scene once;
        gnomon::scene twice;
        gnomon::add(once, "table", t);
        gnomon::add(twice, "table", scaled(t, 2.0));
        ASSERT_EQ(once.shapes().size(), twice.shapes().size());
        for (std::size_t i = 0; i < once.shapes().size(); ++i) {
            const gnomon::bounds& a = once.shapes()[i].extent;
            const gnomon::bounds& b = twice.shapes()[i].extent;
            EXPECT_LT((2.0 * a.low - b.low).norm(), 1e-9);
            EXPECT_LT((2.0 * a.high - b.high).norm(), 1e-9);
        }
    }
}

TEST(table, refuses_measures_that_do_not_fit) {
    gnomon::scene world;
    EXPECT_THROW(gnomon::add(world, "table", table{.length = -1.0}), std::invalid_argument);
    EXPECT_THROW(gnomon::add(world, "table", table{.height = 0.01}), std::invalid_argument);
}

}  // namespace
