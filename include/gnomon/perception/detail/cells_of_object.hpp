// SPDX-License-Identifier: BSL-1.0
/// @file
/// The cells of a scan that are on the surface of an object, and their alignment with it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/point.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/features/align_to_surface.hpp>
#include <gnomon/features/alignment.hpp>
#include <gnomon/filters/voxel_grid.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/recognition/detail/points_in_bounds.hpp>
#include <gnomon/recognition/surface_model.hpp>
#include <gnomon/recognition/verification.hpp>

namespace gnomon::recognition::detail {

/// The cells on the surface of an object at a pose, ascending. O(n log m) for n cells within its
/// bounds and m samples of the surface.
[[nodiscard]] inline std::vector<point_index> cells_on(const spatial_index& cells,
                                                       const surface_model& model,
                                                       const rigid_motion& pose) {
    constexpr double lowest = verification_options{}.lowest;
    constexpr double margin = 0.03;  // [m]; chosen: spacing of samples, and noise
    const Eigen::Vector3d around = Eigen::Vector3d::Constant(margin);
    Eigen::Vector3d low = model.low() - around;
    low.z() = std::max(low.z(), lowest);
    std::vector<point_index> on;
    std::vector<neighbor> nearest;
    for_each_point_in(cells, pose, low, model.high() + around,
                      [&](point_index i, const Eigen::Vector3d& x) {
                          model.points().nearest_within_into(nearest, x, 1, margin);
                          if (!nearest.empty()) on.push_back(i);
                      });
    std::ranges::sort(on);
    return on;
}

/// The alignment of some cells, of which at most `most` are used, evenly chosen, with the surface
/// of an object.
/// @param surface  of all cells, a `normal_range`
/// @param samples  of the surface of the object
/// @param start    of the object in the scan, as is the pose of the result
[[nodiscard]] alignment alignment_of_cells(const voxel_grid::means& cells, const auto& surface,
                                           const std::vector<point_index>& some, std::size_t most,
                                           const surface_model::oriented_samples& samples,
                                           const rigid_motion& start,
                                           const alignment_options& options) {
    const std::size_t n = std::min(some.size(), most);
    std::vector<point_index> used(n);
    std::vector<surface_model::oriented> normals(n);
    for (std::size_t k = 0; k < n; ++k) {
        used[k] = some[k * some.size() / n];
        normals[k].normal = surface[used[k]].normal;
    }
    return align_to_surface(subset_view(cells, used), normals, samples.points, samples.normals,
                            start.inverse(), options)
        .inverse();
}

}  // namespace gnomon::recognition::detail
