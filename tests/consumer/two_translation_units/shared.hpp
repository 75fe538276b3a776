// SPDX-License-Identifier: BSL-1.0
// What passes between the two translation units, by value.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <gnomon/gnomon.hpp>

/// Size and alignment of the types that cross, in the order of `layout_of_crossing_types`.
using layout = std::array<std::size_t, 12>;

template <class... T>
constexpr layout layout_of() {
    return {sizeof(T)..., alignof(T)...};
}

constexpr layout layout_of_crossing_types() {
    return layout_of<gnomon::scan, gnomon::moments, gnomon::plane, gnomon::angle,
                     gnomon::viewpoint_table, decltype(gnomon::detail::symmetric_eigen({}))>();
}

layout layout_there();
gnomon::scan scan_made_there();
gnomon::moments moments_made_there(gnomon::scan);
gnomon::adjacency neighbors_found_there(const gnomon::scan&);
std::vector<gnomon::surfel<gnomon::plane_fit>> normals_found_there(const gnomon::scan&);
double smallest_of_eight();
