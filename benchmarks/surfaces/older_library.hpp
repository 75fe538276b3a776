// SPDX-License-Identifier: BSL-1.0
/// @file
/// Lets rooms.cpp compile with an older version of the library, for a comparison. The version is
/// checked out elsewhere; its program is named rooms_before, so that it writes rooms_before.json:
///
///     g++ -std=c++20 -O3 -march=native -pthread -include benchmarks/surfaces/older_library.hpp
///         -I OLDER/include -isystem /usr/include/eigen3 benchmarks/surfaces/rooms.cpp
///         -o rooms_before
#pragma once

#ifndef GNOMON_SIGMA_TOLD
#define GNOMON_SIGMA_TOLD
#endif

#include <gnomon/gnomon.hpp>
#include <gnomon/perception.hpp>
#include <gnomon/simulation.hpp>

#if !__has_include(<gnomon/perception/perception_result.hpp>)
// The names in a version with fewer namespaces.
namespace gnomon {
namespace simulation {
using namespace gnomon;
}
namespace detail {
using gnomon::boundary_pair;
using gnomon::union_find;
void append_boundary_pairs(auto& found, const auto& points, const auto& first, const auto& second,
                           const std::pair<Eigen::Vector3d, Eigen::Vector3d>& centroids) {
    found = gnomon::boundary_pairs(points, first, second, centroids);
}
}  // namespace detail
}  // namespace gnomon
#endif
