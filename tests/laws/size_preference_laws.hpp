// SPDX-License-Identifier: BSL-1.0
/// @file
/// The laws of the `size_preference` concept, for any model: yours, too.
#pragma once

#include <cmath>
#include <cstddef>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <gnomon/core/spectrum.hpp>
#include <gnomon/neighborhoods/adaptive_knn.hpp>

namespace laws {

// [costs_are_comparable]
/// The cost of every shape, degenerate ones too, is the same each time and no NaN; infinity stands
/// for a size that is not to be taken.
template <gnomon::size_preference P>
void costs_are_comparable(const P& preference) {
    for (const Eigen::Vector3d& lambda :
         {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(1, 1, 0),
          Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(2e-4, 1e-4, 1e-6)}) {
        for (const std::size_t k : {1u, 10u, 80u}) {
            for (const double squared_radius : {0.0, 0.01}) {
                const gnomon::neighborhood_shape shape{k, squared_radius, gnomon::spectrum(lambda)};
                ASSERT_FALSE(std::isnan(static_cast<double>(preference(shape))));
                ASSERT_EQ(static_cast<double>(preference(shape)),
                          static_cast<double>(preference(shape)));
            }
        }
    }
}
// [costs_are_comparable]

}  // namespace laws
