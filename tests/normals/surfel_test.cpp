// SPDX-License-Identifier: BSL-1.0
#include <type_traits>

#include <gtest/gtest.h>

#include <gnomon/normals/plane_fit.hpp>
#include <gnomon/normals/surfel.hpp>

namespace {

TEST(surfel, derives_from_its_estimate) {
    const gnomon::surfel<gnomon::plane_fit> none;
    static_assert(std::is_base_of_v<gnomon::plane_fit, gnomon::surfel<gnomon::plane_fit>>);
    EXPECT_FALSE(gnomon::usable(none.trust));
    EXPECT_EQ(none.normal, Eigen::Vector3d::Zero());
    EXPECT_EQ(none.neighbors, 0u);
    EXPECT_EQ(none.mean_distance, 0.0);
}

}  // namespace
