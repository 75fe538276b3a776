// SPDX-License-Identifier: BSL-1.0
#include <gtest/gtest.h>

#include <gnomon/core/point_range.hpp>
#include <gnomon/simulation/true_scan.hpp>

namespace sim = gnomon::simulation;

namespace {

TEST(true_scan, holds_a_scan_that_all_algorithms_take) {
    static_assert(gnomon::point_range<decltype(sim::true_scan::scan)>);
    EXPECT_EQ(sim::true_scan().scan.size(), 0u);
}

}  // namespace
