// SPDX-License-Identifier: BSL-1.0
/// @file
/// Laws of features of parts. `part_feature_laws(f, view, moved)` runs them all on one feature; the
/// second view is of the same parts, in the same order, after a turn about the vertical and a move
/// along the ground.
#pragma once

#include <cmath>
#include <cstddef>
#include <string_view>

#include <gtest/gtest.h>

#include <gnomon/recognition/part_feature.hpp>
#include <gnomon/recognition/view.hpp>

namespace laws {

/// A feature has a name, a scale by which values can be divided, and a weight.
template <gnomon::recognition::part_feature F>
void feature_has_a_scale(const F& f) {
    EXPECT_FALSE(std::string_view(F::name).empty());
    EXPECT_TRUE(f.scale > 0.0 && std::isfinite(f.scale));
    EXPECT_TRUE(f.weight >= 0.0 && std::isfinite(f.weight));
}

// [feature_is_a_function]
/// The value of a part is a finite number, the same each time and of each copy.
template <gnomon::recognition::part_feature F>
void feature_is_a_function(const F& f, const gnomon::recognition::view& v) {
    const F copy = f;
    const auto copied = v;
    for (std::size_t i = 0; i < v.parts.size(); ++i) {
        const double x = f(v.parts[i], v);
        EXPECT_TRUE(std::isfinite(x)) << F::name;
        EXPECT_EQ(copy(copied.parts[i], copied), x) << F::name;
    }
}
// [feature_is_a_function]

// [feature_does_not_depend_on_heading]
/// Neither the heading of an object nor its place on the ground matters, up to rounding.
template <gnomon::recognition::part_feature F>
void feature_does_not_depend_on_heading(const F& f, const gnomon::recognition::view& v,
                                        const gnomon::recognition::view& moved, double tolerance) {
    ASSERT_EQ(v.parts.size(), moved.parts.size());
    for (std::size_t i = 0; i < v.parts.size(); ++i)
        EXPECT_NEAR(f(v.parts[i], v), f(moved.parts[i], moved), tolerance * f.scale) << F::name;
}
// [feature_does_not_depend_on_heading]

template <gnomon::recognition::part_feature F>
void part_feature_laws(const F& f, const gnomon::recognition::view& v,
                       const gnomon::recognition::view& moved, double tolerance = 1e-6) {
    feature_has_a_scale(f);
    feature_is_a_function(f, v);
    feature_does_not_depend_on_heading(f, v, moved, tolerance);
}

}  // namespace laws
