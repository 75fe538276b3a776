// SPDX-License-Identifier: BSL-1.0
/// @file
/// Views of points in foreign memory, without a copy: a buffer with a stride (ROS PointCloud2, a
/// PCL cloud, LAS records, a numpy array), or the columns or rows of an Eigen matrix.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstring>

#include <Eigen/Core>

#include <gnomon/core/detail/index_iterator.hpp>
#include <gnomon/core/error.hpp>

namespace gnomon {

/// A range of 3-vectors in strided memory; models `point_range`. Does not own the memory, requires
/// no alignment, and copies only the point that is accessed.
template <std::floating_point Scalar>
class strided_view {
  public:
    /// @param data     first byte of the first point
    /// @param size     number of points
    /// @param stride   bytes from one point to the next
    /// @param offsets  bytes from a point's start to its x, y and z [m]
    /// @throws std::invalid_argument  if `data` is null and `size` is not 0
    strided_view(const void* data, std::size_t size, std::ptrdiff_t stride,
                 std::array<std::ptrdiff_t, 3> offsets = {0, sizeof(Scalar), 2 * sizeof(Scalar)})
        : data_(static_cast<const std::byte*>(data)),
          size_(size),
          stride_(stride),
          offsets_(offsets) {
        detail::require(data != nullptr || size == 0, "strided_view: null data with points in it");
    }

    /// The number of points.
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] auto begin() const { return detail::index_iterator(this, 0); }
    [[nodiscard]] auto end() const {
        return detail::index_iterator(this, static_cast<std::ptrdiff_t>(size_));
    }

    /// The coordinates of point i [m]. Precondition: i < size().
    [[nodiscard]] Eigen::Matrix<Scalar, 3, 1> operator[](std::size_t i) const {
        const std::byte* point = data_ + static_cast<std::ptrdiff_t>(i) * stride_;
        return {load(point + offsets_[0]), load(point + offsets_[1]), load(point + offsets_[2])};
    }

  private:
    static Scalar load(const std::byte* from) {
        Scalar value;
        std::memcpy(&value, from, sizeof value);
        return value;
    }

    const std::byte* data_;
    std::size_t size_;
    std::ptrdiff_t stride_;
    std::array<std::ptrdiff_t, 3> offsets_;
};

namespace detail {

/// An Eigen matrix, map or block: an expression with coordinates in memory, of floating-point
/// scalars.
template <class M>
concept eigen_memory =
    std::derived_from<M, Eigen::DenseBase<M>> && (M::Flags & Eigen::DirectAccessBit) != 0 &&
    std::floating_point<typename M::Scalar>;

/// The view of n rows or columns.
/// @param lines   number n of points
/// @param across  scalars from one point to the next
/// @param along   scalars from one coordinate to the next
template <class M>
auto view_of_lines(const M& m, Eigen::Index lines, Eigen::Index across, Eigen::Index along) {
    constexpr auto bytes = static_cast<std::ptrdiff_t>(sizeof(typename M::Scalar));
    return strided_view<typename M::Scalar>(m.derived().data(), static_cast<std::size_t>(lines),
                                            across * bytes, {0, along * bytes, 2 * along * bytes});
}

}  // namespace detail

/// The columns of a 3 x n matrix [m] as n points. Further rows, such as the fourth of homogeneous
/// coordinates, are ignored. O(1). The matrix must outlive the view.
/// @throws std::invalid_argument  if the matrix has fewer than three rows
template <detail::eigen_memory M>
[[nodiscard]] auto columns(const M& m) {
    detail::require(m.rows() >= 3, "columns: the matrix needs at least three rows");
    const bool by_column = !M::IsRowMajor;
    return detail::view_of_lines(m, m.cols(), by_column ? m.outerStride() : m.innerStride(),
                                 by_column ? m.innerStride() : m.outerStride());
}

/// The rows of an n x 3 matrix [m] as n points. Further columns are ignored. O(1). The matrix must
/// outlive the view.
/// @throws std::invalid_argument  if the matrix has fewer than three columns
template <detail::eigen_memory M>
[[nodiscard]] auto rows(const M& m) {
    detail::require(m.cols() >= 3, "rows: the matrix needs at least three columns");
    const bool by_row = M::IsRowMajor;
    return detail::view_of_lines(m, m.rows(), by_row ? m.outerStride() : m.innerStride(),
                                 by_row ? m.innerStride() : m.outerStride());
}

// A temporary matrix would be destroyed before the view. A temporary Map or Block is allowed: the
// memory it refers to stays.
template <detail::eigen_memory M>
    requires std::derived_from<M, Eigen::PlainObjectBase<M>>
void columns(const M&& m) = delete;
template <detail::eigen_memory M>
    requires std::derived_from<M, Eigen::PlainObjectBase<M>>
void rows(const M&& m) = delete;

}  // namespace gnomon
