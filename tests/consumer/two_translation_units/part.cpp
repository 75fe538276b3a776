// SPDX-License-Identifier: BSL-1.0
// Uses a small part of what the others use, so that they would share functions of this part only.
#include "shared.hpp"

double smallest_of_eight() {
    using gnomon::detail::pack;
    gnomon::detail::symmetric_3x3<pack> planes;
    planes.zz = planes.xy = planes.xz = planes.yz = pack::Zero();
    planes.xx = planes.yy = pack::Constant(0.5);
    return gnomon::detail::separated_eigen<pack>(planes).values[2].abs().maxCoeff();
}
