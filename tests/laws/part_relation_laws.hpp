// SPDX-License-Identifier: BSL-1.0
/// @file
/// Laws of relations of parts. `part_relation_laws(r, view, moved)` runs them all on one relation;
/// the second view is of the same parts, in the same order, after a turn about the vertical and a
/// move along the ground.
#pragma once

#include <cmath>
#include <cstddef>
#include <string_view>

#include <gtest/gtest.h>

#include <gnomon/recognition/part_relation.hpp>
#include <gnomon/recognition/view.hpp>

namespace laws {

// [relation_is_symmetric]
/// The value of two parts is a finite number that does not depend on their order, up to rounding.
template <gnomon::recognition::part_relation R>
void relation_is_symmetric(const R& r, const gnomon::recognition::view& v) {
    for (std::size_t j = 0; j < v.parts.size(); ++j) {
        for (std::size_t i = 0; i < j; ++i) {
            const double x = r(v.parts[i], v.parts[j]);
            EXPECT_TRUE(std::isfinite(x)) << R::name;
            EXPECT_NEAR(r(v.parts[j], v.parts[i]), x, 1e-9 * r.bin) << R::name;
        }
    }
}
// [relation_is_symmetric]

/// Neither the heading of an object nor its place on the ground matters, up to rounding.
template <gnomon::recognition::part_relation R>
void relation_does_not_depend_on_heading(const R& r, const gnomon::recognition::view& v,
                                         const gnomon::recognition::view& moved, double tolerance) {
    ASSERT_EQ(v.parts.size(), moved.parts.size());
    for (std::size_t j = 0; j < v.parts.size(); ++j) {
        for (std::size_t i = 0; i < j; ++i) {
            EXPECT_NEAR(r(v.parts[i], v.parts[j]), r(moved.parts[i], moved.parts[j]),
                        tolerance * r.bin)
                << R::name;
        }
    }
}

/// A relation has a name, bins, a critical mass that is a share, and a least deviation.
template <gnomon::recognition::part_relation R>
void relation_has_bins(const R& r) {
    EXPECT_FALSE(std::string_view(R::name).empty());
    EXPECT_TRUE(r.bin > 0.0 && std::isfinite(r.bin));
    EXPECT_TRUE(r.mass >= 0.0 && r.mass <= 1.0);
    EXPECT_TRUE(r.min_deviation > 0.0 && std::isfinite(r.min_deviation));
}

template <gnomon::recognition::part_relation R>
void part_relation_laws(const R& r, const gnomon::recognition::view& v,
                        const gnomon::recognition::view& moved, double tolerance = 1e-5) {
    relation_has_bins(r);
    relation_is_symmetric(r, v);
    relation_does_not_depend_on_heading(r, v, moved, tolerance);
}

}  // namespace laws
