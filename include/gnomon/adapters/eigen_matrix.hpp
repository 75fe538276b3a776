// SPDX-License-Identifier: BSL-1.0
/// @file
/// Points and normals as n x 3 matrices of Eigen. The other way there is no copy: `rows(matrix)` in
/// gnomon/core/strided_view.hpp is a point range of a matrix, block or map of either storage order.
#pragma once

#include <cstddef>
#include <functional>
#include <iterator>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/point_range.hpp>

namespace gnomon {

/// A matrix whose row i is point i [m]. O(points).
/// @tparam Matrix     a matrix of dynamic rows and three columns, of any scalar and storage order
/// @param points      any point range
/// @param projection  maps an element of the range to a point
template <class Matrix = Eigen::Matrix<double, Eigen::Dynamic, 3>, class R,
          class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] auto point_rows(const R& points, Proj projection = {}) -> Matrix {
    const position_view<R, Proj> positions(points, std::move(projection));
    Matrix result(static_cast<Eigen::Index>(positions.size()), 3);
    for (std::size_t i = 0; i < positions.size(); ++i)
        result.row(static_cast<Eigen::Index>(i)) =
            positions[i].transpose().template cast<typename Matrix::Scalar>();
    return result;
}

/// A matrix whose row i is the normal of point i: a unit vector, or zero where it is missing.
/// O(points).
/// @tparam Matrix  as above
/// @param surface  the result of `estimate_normals`, or any other range with normals
template <class Matrix = Eigen::Matrix<double, Eigen::Dynamic, 3>, normal_range S>
[[nodiscard]] auto normal_rows(const S& surface) -> Matrix {
    const auto n = static_cast<std::size_t>(std::ranges::size(surface));
    Matrix result(static_cast<Eigen::Index>(n), 3);
    for (std::size_t i = 0; i < n; ++i)
        result.row(static_cast<Eigen::Index>(i)) =
            surface[i].normal.transpose().template cast<typename Matrix::Scalar>();
    return result;
}

}  // namespace gnomon
