// SPDX-License-Identifier: BSL-1.0
/// @file
/// The robust fit of a plane to a region: to those of its points that are on it.
#pragma once

#include <cstddef>
#include <span>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/normals/detail/quantile.hpp>
#include <gnomon/segmentation/detail/planar_cloud.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// The half of a segment that is nearest to the median of each coordinate, as a predicate of its
/// points. A few far points, which would turn the plane of all, are excluded. O(n).
[[nodiscard]] auto central_half(const auto& cloud, std::span<const point_index> members) {
    scratch<double> values;
    const auto median = [&](auto&& value_of) {
        values.clear();
        for (const point_index i : members)
            if (cloud.is_finite(i)) values.push_back(value_of(i));
        return values.empty() ? 0.0 : quantile(values, 0.5);
    };
    Eigen::Vector3d middle(0.0, 0.0, 0.0);
    for (int j = 0; j < 3; ++j)
        middle[j] = median([&](point_index i) { return cloud.offsets[i][j]; });
    const auto distance = [&cloud, middle](point_index i) {
        return std::sqrt(squared_distance(cloud.offsets[i], middle));
    };
    const double reach = median(distance);
    return [distance, reach](point_index i) { return distance(i) <= reach; };
}

/// The plane of some points of a cloud, in coordinates of the cloud. Points off the plane are left
/// out, and it is fit again, until their number stays the same. If more than half are off the plane
/// of all, the plane of the half around the middle is the first one.
template <class Cloud>
[[nodiscard]] planar_region region_of(const Cloud& cloud, std::span<const point_index> members) {
    const auto sums_of = [&](auto&& is_of) {
        planar_region some;
        for (const point_index i : members)
            if (cloud.is_finite(i) && is_of(i)) cloud.add(i, some.sums);
        some.fit = some.sums.fit();
        return some;
    };
    planar_region region = sums_of([](point_index) { return true; });
    const std::size_t all = region.sums.count;
    constexpr int most_passes = 50;  // numerical: in rooms and real scans five are enough
    for (int pass = 0; pass < most_passes && region.fit.is_determined; ++pass) {
        const planar_region on = sums_of([&](point_index i) { return cloud.is_on(i, region.fit); });
        if (2 * on.sums.count < region.sums.count || !on.fit.is_determined) {
            if (pass > 0) break;
            region = sums_of(central_half(cloud, members));
            continue;
        }
        const bool rests = on.sums.count == region.sums.count;
        region = on;
        if (rests) break;
    }
    region.is_planar = region.explains(all);
    return region;
}

/// The planes of segments, as regions.
template <execution X>
[[nodiscard]] scratch<planar_region> regions_of(const planar_cloud& cloud, const segments& parts,
                                                const X& run) {
    scratch<planar_region> regions(parts.size());
    run(parts.size(), [&](std::size_t s) { regions[s] = region_of(cloud, parts[s]); });
    return regions;
}

}  // namespace gnomon::detail
