// SPDX-License-Identifier: BSL-1.0
/// @file
/// Ranges of points. A `point_range` is a random-access sized range whose elements are points, or
/// become points under a projection. Algorithms never change, reorder or resize it; they read it
/// through `position_view`, by index and in double.
#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <type_traits>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/error.hpp>
#include <gnomon/core/point.hpp>

namespace gnomon {

namespace detail {

/// A range with constant-time access by index and a known size.
template <class R>
concept indexed_range = requires(const R& r) {
    { std::ranges::begin(r) } -> std::random_access_iterator;
    { std::ranges::size(r) } -> std::integral;
};

/// The type that a projection returns for an element of the range.
template <class R, class Proj>
using projected_element_t = std::remove_cvref_t<
    std::invoke_result_t<const Proj&, decltype(*std::ranges::begin(std::declval<const R&>()))>>;

}  // namespace detail

/// An indexed range of points, seen through a projection (a callable or a pointer to member).
template <class R, class Proj = std::identity>
concept point_range = detail::indexed_range<R> && point<detail::projected_element_t<R, Proj>>;

/// A view of the positions of a point range, by index, in double. Refers to the range.
template <class R, class Proj = std::identity>
    requires point_range<R, Proj>
class position_view {
  public:
    /// The scalar in which the coordinates are stored.
    using scalar = typename point_traits<detail::projected_element_t<R, Proj>>::scalar;

    /// @throws std::invalid_argument  for more points than `point_index` can count
    explicit position_view(const R& points, Proj projection = {})
        : first_(std::ranges::begin(points)),
          size_(static_cast<std::size_t>(std::ranges::size(points))),
          projection_(std::move(projection)) {
        detail::require(size_ < std::numeric_limits<point_index>::max(),
                        "a point range must hold fewer than 2^32 - 1 points");
    }

    [[nodiscard]] std::size_t size() const { return size_; }

    /// The position of point i [m].
    [[nodiscard]] Eigen::Vector3d operator[](std::size_t i) const {
        using difference = std::iter_difference_t<decltype(first_)>;
        return position(std::invoke(projection_, first_[static_cast<difference>(i)]));
    }

  private:
    decltype(std::ranges::begin(std::declval<const R&>())) first_;
    std::size_t size_;
    [[no_unique_address]] Proj projection_;
};

namespace detail {

/// The machine epsilon of the numbers that the coordinates of a range are stored in: the range
/// states it by a member epsilon(), or they are those of the view.
template <class View, class R>
[[nodiscard]] double epsilon_of(const R& points) {
    if constexpr (requires {
                      { points.epsilon() } -> std::same_as<double>;
                  })
        return points.epsilon();
    else
        return static_cast<double>(std::numeric_limits<typename View::scalar>::epsilon());
}

}  // namespace detail

}  // namespace gnomon
