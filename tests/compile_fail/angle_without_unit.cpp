// SPDX-License-Identifier: BSL-1.0
// expect first: write_?\s?degrees
// A threshold that is an angle needs a unit.
#include <gnomon/segmentation/segment_surfaces.hpp>

int main() {
    const gnomon::segment_surfaces_options options{.max_angle = 5};
    return options.min_points > 0;
}
