// SPDX-License-Identifier: BSL-1.0
/// @file
/// The laws of the `normal_range` concept and of its refinement `surfel_range`, for any model:
/// yours, too.
#pragma once

#include <cmath>
#include <cstddef>
#include <iterator>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/segmentation/segment_surfaces.hpp>

namespace laws {

// [normals_have_unit_length_or_are_zero]
/// A normal has unit length, or is the zero vector; with a member `trust` it is zero exactly where
/// that is not usable.
template <gnomon::normal_range S>
void normals_have_unit_length_or_are_zero(const S& surface) {
    const auto n = static_cast<std::size_t>(std::ranges::size(surface));
    for (std::size_t i = 0; i < n; ++i) {
        const Eigen::Vector3d normal = surface[i].normal;
        const bool missing = gnomon::is_missing(normal);
        ASSERT_NEAR(normal.norm(), missing ? 0.0 : 1.0, 1e-12) << "element " << i;
        if constexpr (requires { gnomon::usable(surface[i].trust); }) {
            ASSERT_EQ(missing, !gnomon::usable(surface[i].trust)) << "element " << i;
        }
    }
}
// [normals_have_unit_length_or_are_zero]

// [elements_by_index_are_those_in_order]
/// Element i by index is element i in order.
template <gnomon::normal_range S>
void elements_by_index_are_those_in_order(const S& surface) {
    std::size_t i = 0;
    for (const auto& element : surface) ASSERT_EQ(element.normal, surface[i++].normal);
    ASSERT_EQ(i, static_cast<std::size_t>(std::ranges::size(surface)));
}
// [elements_by_index_are_those_in_order]

template <gnomon::normal_range S>
void normal_range_laws(const S& surface) {
    normals_have_unit_length_or_are_zero(surface);
    elements_by_index_are_those_in_order(surface);
}

// [mean_distances_are_lengths]
/// Where there is a normal, the mean distance to the neighbors is finite and not negative [m].
template <gnomon::surfel_range S>
void mean_distances_are_lengths(const S& surface) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(std::ranges::size(surface)); ++i) {
        if (gnomon::is_missing(surface[i].normal)) continue;
        ASSERT_TRUE(std::isfinite(surface[i].mean_distance)) << "element " << i;
        ASSERT_GE(surface[i].mean_distance, 0.0) << "element " << i;
    }
}
// [mean_distances_are_lengths]

template <gnomon::surfel_range S>
void surfel_range_laws(const S& surface) {
    normal_range_laws(surface);
    mean_distances_are_lengths(surface);
}

}  // namespace laws
