// SPDX-License-Identifier: BSL-1.0
/// @file
/// What a point is. `point_traits` is the one door through which foreign points enter; it stands
/// open for Eigen 3-vectors, for anything with members x, y, z (PCL, ROS messages, a struct of
/// yours) and for arrays of three. Every algorithm then works on `position(p)`, in double.
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

/// Index of a point in its range. 32 bits keep neighbor graphs small; ranges of 2^32 - 1 points
/// or more are refused with `std::invalid_argument`.
using point_index = std::uint32_t;

/// Specialise this for a point type of your own:
///     using scalar = float;                                        // a floating-point type
///     static Eigen::Vector3<scalar> coordinates(const my_point&);  // [m]
template <class P>
struct point_traits;

namespace detail {

/// One that has its coordinates in memory. An expression, such as what a lambda returns for a + b,
/// may refer to temporaries that are gone: say `-> Eigen::Vector3d`.
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
    return point_traits<P>::coordinates(p).template cast<double>();
}

/// Whether one can compute with `p`: no NaN, no infinity, and no coordinate of 1e150 or more,
/// whose square would overflow.
[[nodiscard]] inline bool is_finite(const Eigen::Vector3d& p) {
    constexpr double limit = 1e150;
    return std::abs(p.x()) < limit && std::abs(p.y()) < limit && std::abs(p.z()) < limit;
}

/// The canonical distance of this library: the sum of squared differences, in double [m^2].
/// Everything that compares distances compares these values, and breaks ties by the index.
[[nodiscard]] inline double squared_distance(const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
    const double dx = p.x() - q.x();
    const double dy = p.y() - q.y();
    const double dz = p.z() - q.z();
    return dx * dx + dy * dy + dz * dz;
}

}  // namespace gnomon
