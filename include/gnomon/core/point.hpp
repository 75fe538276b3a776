// SPDX-License-Identifier: BSL-1.0
/// @file
/// The concept of a point. `point_traits` adapts a point type; it is specialized for Eigen
/// 3-vectors, for types with members x, y, z (PCL, ROS messages, user-defined structs) and for
/// arrays of three numbers. Every algorithm computes with `position(p)`, in double.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>

namespace gnomon {

/// The index of a point in its range. 32 bits halve the memory of neighbor graphs; ranges of
/// 2^32 - 1 points or more are refused with `std::invalid_argument`.
using point_index = std::uint32_t;

/// Specialize this for a user-defined point type:
///     using scalar = float;                                        // a floating-point type
///     static Eigen::Vector3<scalar> coordinates(const my_point&);  // [m]
template <class P>
struct point_traits;

namespace detail {

/// An Eigen 3-vector with its coordinates in memory. Expressions are excluded: the result of a
/// lambda that returns a + b refers to destroyed temporaries. Declare the lambda with
/// `-> Eigen::Vector3d`.
template <class P>
concept eigen_3vector = std::derived_from<P, Eigen::MatrixBase<P>> && P::SizeAtCompileTime == 3 &&
                        (P::Flags & Eigen::DirectAccessBit) != 0;

template <class P>
concept xyz_struct = requires(const P& p) {
    requires std::is_floating_point_v<std::remove_cvref_t<decltype(p.x)>>;
    requires std::is_floating_point_v<std::remove_cvref_t<decltype(p.y)>>;
    requires std::is_floating_point_v<std::remove_cvref_t<decltype(p.z)>>;
};

}  // namespace detail

/// Eigen vectors, rows and columns of compile-time size 3.
template <detail::eigen_3vector P>
struct point_traits<P> {
    using scalar = typename P::Scalar;
    static Eigen::Matrix<scalar, 3, 1> coordinates(const P& p) { return {p[0], p[1], p[2]}; }
};

/// Structs with floating-point members x, y, z.
template <detail::xyz_struct P>
struct point_traits<P> {
    using scalar = std::remove_cvref_t<decltype(std::declval<const P&>().x)>;
    static Eigen::Matrix<scalar, 3, 1> coordinates(const P& p) {
        return {p.x, static_cast<scalar>(p.y), static_cast<scalar>(p.z)};
    }
};

/// `std::array<T, 3>`
template <class T>
struct point_traits<std::array<T, 3>> {
    using scalar = T;
    static Eigen::Matrix<T, 3, 1> coordinates(const std::array<T, 3>& p) {
        return {p[0], p[1], p[2]};
    }
};

/// `T[3]`
template <class T>
struct point_traits<T[3]> {
    using scalar = T;
    static Eigen::Matrix<T, 3, 1> coordinates(const T (&p)[3]) { return {p[0], p[1], p[2]}; }
};

/// A point of 3-space with floating-point coordinates in metres.
template <class P>
concept point = requires(const P& p) {
    requires std::floating_point<typename point_traits<P>::scalar>;
    {
        point_traits<P>::coordinates(p)
    } -> std::convertible_to<Eigen::Matrix<typename point_traits<P>::scalar, 3, 1>>;
};

/// The coordinates of `p` in double [m].
template <point P>
[[nodiscard]] Eigen::Vector3d position(const P& p) {
    const Eigen::Matrix<typename point_traits<P>::scalar, 3, 1> c = point_traits<P>::coordinates(p);
    return {static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])};
}

/// Whether `p` is finite: no coordinate is NaN, infinite, or 1e150 or more, as its square would
/// overflow.
[[nodiscard]] inline bool is_finite(const Eigen::Vector3d& p) {
    constexpr double limit = 1e150;
    return std::abs(p.x()) < limit && std::abs(p.y()) < limit && std::abs(p.z()) < limit;
}

/// The squared Euclidean distance, in double [m^2]. Searches compare these values unless
/// `search_options` name another metric, and break ties by the index of the point.
[[nodiscard]] inline double squared_distance(const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
    const double dx = p.x() - q.x();
    const double dy = p.y() - q.y();
    const double dz = p.z() - q.z();
    return dx * dx + dy * dy + dz * dz;
}

}  // namespace gnomon
