// SPDX-License-Identifier: BSL-1.0
/// @file
/// The remedy in the first line of the compiler's output where something is passed for points that
/// is no `point_range`: homogeneous vectors, a flat buffer of numbers, a matrix, a list.
#pragma once

#include <concepts>
#include <functional>
#include <iterator>
#include <type_traits>

#include <Eigen/Core>

#include <gnomon/core/point_range.hpp>

namespace gnomon::detail {

/// False, but not before the template is instantiated.
template <class...>
inline constexpr bool never = false;

template <class M>
concept eigen_object = std::derived_from<M, Eigen::EigenBase<M>>;

template <class P>
concept eigen_4vector = eigen_object<P> && P::SizeAtCompileTime == 4;

/// A type that users pass for points, and that is no point range under the projection.
template <class R, class Proj = std::identity>
concept refused_points =
    !point_range<R, Proj> && (eigen_object<R> || std::is_pointer_v<R> || indexed_range<R> ||
                              requires(R& r) { std::ranges::begin(r); });

/// Does not compile: the static assertion names the remedy. Its return type is deduced, so that
/// compilers instantiate it where it is called, before they complain about the result.
/// Precondition: refused_points.
template <class R, class Proj = std::identity>
constexpr auto explain_refused_points() {
    if constexpr (eigen_object<R>) {
        static_assert(never<R>,
                      "a matrix is not a range of points: pass gnomon::columns(matrix) or "
                      "gnomon::rows(matrix)");
    } else if constexpr (std::is_pointer_v<R>) {
        static_assert(never<R>,
                      "a pointer has no size: pass std::span(points, size), or "
                      "gnomon::strided_view<float>(data, number_of_points, bytes_per_point)");
    } else if constexpr (!indexed_range<R>) {
        static_assert(never<R>,
                      "a range of points needs access by index and a size: copy the points into a "
                      "std::vector");
    } else if constexpr (!requires { typename projected_element_t<R, Proj>; }) {
        static_assert(never<R>, "the projection cannot be called with an element of the range");
    } else if constexpr (std::is_arithmetic_v<projected_element_t<R, Proj>>) {
        static_assert(never<R>,
                      "numbers are not points: pass gnomon::strided_view<float>(data, "
                      "number_of_points, bytes_per_point)");
    } else if constexpr (eigen_4vector<projected_element_t<R, Proj>>) {
        static_assert(never<R>,
                      "points have three coordinates, these four: pass as projection "
                      "[](const Eigen::Vector4f& p) -> Eigen::Vector3f { return p.head<3>(); }");
    } else {
        static_assert(never<R>,
                      "the elements are not points: pass a projection that returns a point, or "
                      "specialize gnomon::point_traits");
    }
    return nullptr;
}

}  // namespace gnomon::detail
