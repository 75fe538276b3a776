// SPDX-License-Identifier: BSL-1.0
// Uses a small part of what the others use, so that they would share functions of this part only.
#include "shared.hpp"

double smallest_of_eight() {
    using gnomon::detail::pack;
    const gnomon::detail::symmetric_3x3<pack> planes{0.5, 0.5, 0.0, 0.0, 0.0, 0.0};
    return magnitude(gnomon::detail::separated_eigen<pack>(planes).values[2]).sum();
}
