// SPDX-License-Identifier: BSL-1.0
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <gnomon/features/descriptor.hpp>

namespace {

using gnomon::trust;

/// All but a call.
struct uncallable_descriptor {
    static double support_radius() { return 0.1; }
    static std::size_t dimension() { return 1; }
    static double distance(std::span<const float>, std::span<const float>) { return 0.0; }
};

/// The least of the three forms.
struct of_positions : uncallable_descriptor {
    trust operator()(const auto&, const auto&, gnomon::neighborhood_view, std::span<double>) const {
        return trust::good;
    }
};
struct of_normals : uncallable_descriptor {
    trust operator()(const Eigen::Vector3d&, const Eigen::Vector3d&, gnomon::neighborhood_view,
                     std::span<double>, std::span<const Eigen::Vector3d>) const {
        return trust::good;
    }
};
struct of_densities : uncallable_descriptor {
    double density_radius = 0.1;
    trust operator()(const Eigen::Vector3d&, const Eigen::Vector3d&, gnomon::neighborhood_view,
                     std::span<double>, std::span<const double>) const {
        return trust::good;
    }
};
/// Densities within no radius; a call that changes the object; no result.
struct without_radius : uncallable_descriptor {
    trust operator()(const Eigen::Vector3d&, const Eigen::Vector3d&, gnomon::neighborhood_view,
                     std::span<double>, std::span<const double>) const {
        return trust::good;
    }
};
struct not_const : uncallable_descriptor {
    trust operator()(const auto&, const auto&, gnomon::neighborhood_view, std::span<double>) {
        return trust::good;
    }
};
struct without_trust : uncallable_descriptor {
    void operator()(const auto&, const auto&, gnomon::neighborhood_view, std::span<double>) const {}
};

static_assert(gnomon::descriptor<of_positions>);
static_assert(gnomon::descriptor<of_normals>);
static_assert(gnomon::descriptor<of_densities>);
static_assert(!gnomon::descriptor<uncallable_descriptor>);
static_assert(!gnomon::descriptor<without_radius>);
static_assert(!gnomon::descriptor<not_const>);
static_assert(!gnomon::descriptor<without_trust>);
static_assert(!gnomon::descriptor<int>);

TEST(point_descriptors, have_a_row_for_each_point) {
    const gnomon::point_descriptors rows{
        .dimension = 2, .values = {1, 2, 3, 4, 5, 6}, .trust = {trust::good, {}, trust::weak}};
    EXPECT_EQ(rows.size(), 3u);
    ASSERT_EQ(rows[1].size(), 2u);
    EXPECT_EQ(rows[1][0], 3.0);
    EXPECT_EQ(rows[2][1], 6.0);
    EXPECT_EQ(gnomon::point_descriptors{}.size(), 0u);
}

}  // namespace
