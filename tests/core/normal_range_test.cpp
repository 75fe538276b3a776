// SPDX-License-Identifier: BSL-1.0
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core/normal_range.hpp>

namespace {

struct mine {
    Eigen::Vector3d normal;
};
struct mine_in_float {
    Eigen::Vector3f normal;
};

static_assert(gnomon::normal_range<std::vector<mine>>);
static_assert(!gnomon::normal_range<std::vector<mine_in_float>>);  // say .cast<double>()
static_assert(!gnomon::normal_range<std::vector<Eigen::Vector3d>>);
static_assert(!gnomon::normal_range<mine>);

TEST(normal_range, missing_is_zero_and_nothing_else) {
    EXPECT_TRUE(gnomon::is_missing({0.0, -0.0, 0.0}));
    EXPECT_FALSE(gnomon::is_missing({0.0, 0.0, std::numeric_limits<double>::denorm_min()}));
    EXPECT_FALSE(gnomon::is_missing({1.0, 0.0, 0.0}));
}

}  // namespace
