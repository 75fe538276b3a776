// SPDX-License-Identifier: BSL-1.0
/// @file
/// The laws of the `point_range` concept, and of ranges with view points, for any model: yours,
/// too.
#pragma once

#include <cstddef>
#include <cstring>
#include <functional>
#include <iterator>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/viewpoints.hpp>

namespace laws {

/// Equal to the byte, so that NaN equals itself.
inline bool same_bytes(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::memcmp(a.data(), b.data(), 3 * sizeof(double)) == 0;
}

// [size_counts_the_elements]
/// The size is the number of elements from begin to end.
template <class R, class Proj = std::identity>
    requires gnomon::point_range<R, Proj>
void size_counts_the_elements(const R& points, Proj projection = {}) {
    const auto n = static_cast<std::size_t>(std::ranges::size(points));
    ASSERT_EQ(static_cast<std::size_t>(std::ranges::end(points) - std::ranges::begin(points)), n);
    ASSERT_EQ(gnomon::position_view(points, projection).size(), n);
}
// [size_counts_the_elements]

// [index_and_iterator_agree]
/// Element i is the same by iterator, by index, in any order and each time that it is read.
template <class R, class Proj = std::identity>
    requires gnomon::point_range<R, Proj>
void index_and_iterator_agree(const R& points, Proj projection = {}) {
    const gnomon::position_view view(points, projection);
    std::vector<Eigen::Vector3d> in_order;
    for (auto it = std::ranges::begin(points); it != std::ranges::end(points); ++it)
        in_order.push_back(gnomon::position(std::invoke(projection, *it)));
    ASSERT_EQ(in_order.size(), view.size());
    for (std::size_t i = view.size(); i-- > 0;) ASSERT_TRUE(same_bytes(view[i], in_order[i]));
    for (std::size_t i = 0; i < view.size(); ++i) ASSERT_TRUE(same_bytes(view[i], in_order[i]));
}
// [index_and_iterator_agree]

template <class R, class Proj = std::identity>
    requires gnomon::point_range<R, Proj>
void point_range_laws(const R& points, Proj projection = {}) {
    size_counts_the_elements(points, projection);
    index_and_iterator_agree(points, projection);
}

// [each_point_has_a_viewpoint]
/// The table has a view point for each point of the range, the same each time that it is read.
template <class R>
    requires gnomon::has_viewpoints<R> && gnomon::detail::indexed_range<R>
void each_point_has_a_viewpoint(const R& points) {
    const auto n = static_cast<std::size_t>(std::ranges::size(points));
    const gnomon::viewpoint_table& table = points.viewpoints;
    ASSERT_TRUE(table.covers(n));
    const gnomon::viewpoint_table copy = gnomon::detail::viewpoints_of(points);
    for (std::size_t i = 0; i < n; ++i) ASSERT_TRUE(same_bytes(table[i], copy[i]));
}
// [each_point_has_a_viewpoint]

}  // namespace laws
