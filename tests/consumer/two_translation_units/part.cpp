// SPDX-License-Identifier: BSL-1.0
// Uses few of the functions that main.cpp uses, so that only these are inline in both.
#include "shared.hpp"

double smallest_of_eight() {
    using gnomon::detail::pack;
    const gnomon::detail::symmetric_3x3<pack> planes{0.5, 0.5, 0.0, 0.0, 0.0, 0.0};
    return magnitude(gnomon::detail::separated_eigen<pack>(planes).values[2]).sum();
}
