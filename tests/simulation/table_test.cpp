// SPDX-License-Identifier: BSL-1.0
#include <set>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "simulation/furnished.hpp"
#include <gnomon/simulation/table.hpp>

namespace sim = gnomon::simulation;

namespace {

using sim::table;
using sim::table_base;

TEST(table, names_its_parts) {
    using names = std::set<std::string>;
    const auto parts_of = [](const table& t) { return furnished::parts_of(t); };
    EXPECT_EQ(parts_of({.shelf_height = 0.2}),
              (names{"top", "leg 1", "leg 2", "leg 3", "leg 4", "shelf"}));
    EXPECT_EQ(parts_of({.base = table_base::panels}), (names{"top", "panel 1", "panel 2"}));
    EXPECT_EQ(parts_of({.base = table_base::pedestal}), (names{"top", "column", "foot"}));
    EXPECT_EQ(parts_of({.base = table_base::trestles}), (names{"top", "trestle 1", "trestle 2"}));
}

TEST(table, is_as_large_as_its_measures) {
    furnished::expect_extent(table{.length = 1.4, .round = true}, {-0.7, -0.7, 0.0},
                             {0.7, 0.7, 0.74});
}

TEST(table, scales_all_its_measures) {
    for (const table_base base :
         {table_base::legs, table_base::panels, table_base::pedestal, table_base::trestles}) {
        furnished::expect_scales(table{.base = base, .shelf_height = 0.2});
    }
}

TEST(table, refuses_measures_that_do_not_fit) {
    sim::scene world;
    EXPECT_THROW(sim::add(world, "table", table{.length = -1.0}), std::invalid_argument);
    EXPECT_THROW(sim::add(world, "table", table{.height = 0.01}), std::invalid_argument);
}

}  // namespace
