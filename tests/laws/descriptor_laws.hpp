// SPDX-License-Identifier: BSL-1.0
/// @file
/// The laws of the `descriptor` concept as test functions, for the library's models and for
/// user-defined ones. A descriptor under test has a support radius of 0.05 m to 0.5 m.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/features/describe_points.hpp>
#include <gnomon/features/descriptor.hpp>

namespace laws {

/// The smallest surface element of a described point.
struct described_normal {
    Eigen::Vector3d normal;
};

/// A sheet, and for each point a random unit normal.
struct described_sheet {
    clouds::cloud points;
    std::vector<described_normal> surface;

    explicit described_sheet(std::size_t n, std::uint64_t seed) : points(clouds::sheet(n, seed)) {
        gnomon::random_stream random(seed, 3);
        for (std::size_t i = 0; i < n; ++i)
            surface.push_back({clouds::gaussian_vector(random).normalized()});
    }
};

/// The sum of the differences of the entries, as a share of the sum of the first.
double share_that_differs(const auto& a, const auto& b) {
    double sum = 0.0, difference = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        sum += std::abs(static_cast<double>(a[i]));
        difference += std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i]));
    }
    return sum > 0.0 ? difference / sum : difference;
}

// [descriptors_are_finite_or_zero]
/// For any points and any normals: entries are finite, and those of an unusable row are zero.
template <gnomon::descriptor D>
void descriptors_are_finite_or_zero(const D& describe) {
    auto all = clouds::degenerate();
    all.push_back({"sheet", clouds::sheet(500, 1)});
    for (const auto& [name, points] : all) {
        SCOPED_TRACE(name);
        for (const Eigen::Vector3d& normal :
             {Eigen::Vector3d(0.6, 0.0, -0.8), Eigen::Vector3d(0, 0, 0),
              Eigen::Vector3d(0, clouds::nan, 1), Eigen::Vector3d(1e-300, 1e300, 0)}) {
            const std::vector<described_normal> surface(points.size(), {normal});
            const auto rows = gnomon::describe_points(points, surface, describe);
            ASSERT_EQ(rows.size(), points.size());
            ASSERT_EQ(rows.dimension, describe.dimension());
            for (std::size_t i = 0; i < points.size(); ++i) {
                ASSERT_EQ(rows[i].size(), rows.dimension);
                for (const float entry : rows[i])
                    ASSERT_TRUE(gnomon::usable(rows.trust[i]) ? std::isfinite(entry)
                                                              : entry == 0.0f);
            }
        }
    }
}
// [descriptors_are_finite_or_zero]

/// Neither the order of the points nor their place matters: at most 1 % of the entries differ,
/// those of neighbors that rounding puts into the next bin.
template <gnomon::descriptor D>
void descriptors_follow_the_cloud(const D& describe) {
    const described_sheet sheet(800, 5);
    const auto expected = gnomon::describe_points(sheet.points, sheet.surface, describe);
    std::vector<std::size_t> order;
    const auto shuffled = clouds::permuted(sheet.points, 9, order);
    std::vector<described_normal> surface;
    for (const std::size_t i : order) surface.push_back(sheet.surface[i]);
    const auto permuted = gnomon::describe_points(shuffled, surface, describe);
    const auto far_away = gnomon::describe_points(
        clouds::moved(sheet.points, Eigen::Matrix3d::Identity(), {4e5, 5e6, 100}), sheet.surface,
        describe);
    double moved = 0.0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        ASSERT_EQ(permuted.trust[i], expected.trust[order[i]]);
        ASSERT_LT(share_that_differs(expected[order[i]], permuted[i]), 1e-6);
        ASSERT_EQ(far_away.trust[i], expected.trust[i]);
        moved += share_that_differs(expected[i], far_away[i]);
    }
    EXPECT_LT(moved, 0.01 * static_cast<double>(order.size()));
}

/// The distance of a descriptor to itself is zero; it is symmetric and not negative.
template <gnomon::descriptor D>
void descriptor_distances_are_distances(const D& describe) {
    const described_sheet sheet(300, 6);
    const auto rows = gnomon::describe_points(sheet.points, sheet.surface, describe);
    double largest = 0.0;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const double d = describe.distance(rows[i - 1], rows[i]);
        ASSERT_TRUE(d >= 0.0 && std::isfinite(d));
        ASSERT_NEAR(describe.distance(rows[i], rows[i - 1]), d, 1e-9 * d);
        ASSERT_NEAR(describe.distance(rows[i], rows[i]), 0.0, 1e-9);
        largest = std::max(largest, d);
    }
    EXPECT_GT(largest, 0.0);
}

/// The same bytes on any number of threads.
template <gnomon::descriptor D>
void descriptors_do_not_depend_on_execution(const D& describe) {
    const described_sheet sheet(3000, 7);
    const auto expected = gnomon::describe_points(sheet.points, sheet.surface, describe);
    for (const unsigned t : {1u, 2u, 4u}) {
        const auto rows =
            gnomon::describe_points(sheet.points, sheet.surface, describe, gnomon::threads{t});
        ASSERT_EQ(rows.values, expected.values);
        ASSERT_EQ(rows.trust, expected.trust);
    }
}

/// All of them.
template <gnomon::descriptor D>
void descriptor_laws(const D& describe) {
    descriptors_are_finite_or_zero(describe);
    descriptors_follow_the_cloud(describe);
    descriptor_distances_are_distances(describe);
    descriptors_do_not_depend_on_execution(describe);
}

}  // namespace laws
