// SPDX-License-Identifier: BSL-1.0
/// @file
/// The moments of the neighbors of a point and their mean distance, summed over vectors of
/// neighbors.
#pragma once

#include <cstddef>

#include <gnomon/core/detail/pack.hpp>
#include <gnomon/core/moments.hpp>

namespace gnomon::detail {
inline namespace GNOMON_LANES {

/// Sums over the neighbors of a point.
struct neighborhood_sums {
    moments about_point;
    double mean_distance = 0.0;  // from it [m]; 0 if there are none
};

/// The same while they are summed.
struct vector_sums {
    slim_pack x = 0.0, y = 0.0, z = 0.0;
    slim_pack xx = 0.0, xy = 0.0, xz = 0.0, yy = 0.0, yz = 0.0, zz = 0.0;
    slim_pack distance = 0.0;

    /// Adds as many neighbors as a vector has numbers, by their offsets from the point [m].
    [[gnu::always_inline]] void add(const slim_pack& dx, const slim_pack& dy, const slim_pack& dz) {
        const slim_pack dxdx = dx * dx, dydy = dy * dy, dzdz = dz * dz;
        x += dx;
        y += dy;
        z += dz;
        xx += dxdx;
        xy += dx * dy;
        xz += dx * dz;
        yy += dydy;
        yz += dy * dz;
        zz += dzdz;
        distance += root(dxdx + dydy + dzdz);
    }

    /// @param count  the number of neighbors that were added, without zeros
    [[nodiscard]] neighborhood_sums of(std::size_t count) const {
        neighborhood_sums r;
        r.about_point.count = count;
        r.about_point.sum = {x.sum(), y.sum(), z.sum()};
        r.about_point.outer(0, 0) = xx.sum();
        r.about_point.outer(1, 0) = xy.sum();
        r.about_point.outer(2, 0) = xz.sum();
        r.about_point.outer(1, 1) = yy.sum();
        r.about_point.outer(2, 1) = yz.sum();
        r.about_point.outer(2, 2) = zz.sum();
        if (count > 0) r.mean_distance = distance.sum() / static_cast<double>(count);
        return r;
    }
};

}  // namespace GNOMON_LANES
}  // namespace gnomon::detail
