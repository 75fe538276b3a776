// SPDX-License-Identifier: BSL-1.0
/// @file
/// The concept of a surface: a range with a normal for each point. The result of `estimate_normals`
/// is one, and so is a vector of the caller's own structs with a member `normal`.
#pragma once

#include <concepts>
#include <cstddef>
#include <type_traits>

#include <Eigen/Core>

#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>

namespace gnomon {

/// A random-access range whose elements have a member `normal`, an Eigen 3-vector of doubles: a
/// unit vector, or the zero vector where the normal is missing.
template <class S>
concept normal_range = detail::indexed_range<S> && requires(const S& surface, std::size_t i) {
    requires detail::eigen_3vector<std::remove_cvref_t<decltype(surface[i].normal)>>;
    requires std::same_as<double,
                          typename std::remove_cvref_t<decltype(surface[i].normal)>::Scalar>;
};

/// Returns whether a normal is missing, that is, the zero vector. NaN is not missing.
[[nodiscard]] inline bool is_missing(const Eigen::Vector3d& normal) {
    return normal.x() == 0.0 && normal.y() == 0.0 && normal.z() == 0.0;
}

}  // namespace gnomon
