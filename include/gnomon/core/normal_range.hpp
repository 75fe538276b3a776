// SPDX-License-Identifier: BSL-1.0
/// @file
/// What algorithms ask of a surface: a normal at each point, wherever it came from. What
/// `estimate_normals` returns is such a range, and so is a vector of a struct of yours.
#pragma once

#include <concepts>
#include <cstddef>
#include <type_traits>

#include <Eigen/Core>

#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>

namespace gnomon {

/// A random-access range of elements with a member `normal`, an Eigen 3-vector of doubles: a unit
/// vector, or zero where there is none.
template <class S>
concept normal_range = indexed_range<S> && requires(const S& surface, std::size_t i) {
    requires detail::eigen_3vector<std::remove_cvref_t<decltype(surface[i].normal)>>;
    requires std::same_as<double,
                          typename std::remove_cvref_t<decltype(surface[i].normal)>::Scalar>;
};

/// Whether a normal is missing: the zero vector.
[[nodiscard]] inline bool is_missing(const Eigen::Vector3d& normal) {
    return normal.x() == 0.0 && normal.y() == 0.0 && normal.z() == 0.0;
}

}  // namespace gnomon
