// SPDX-License-Identifier: BSL-1.0
/// @file
/// Anisotropic neighborhoods and their repair. Where a scanner's lines are dense but far apart, the
/// k nearest neighbors all come from one line and say nothing of the surface across it. Such
/// neighborhoods betray themselves by their aspect ratio; more neighbors reach the next line.
///
/// Klasing 2010, Sec. 3.2.9, Eq. (3.19): the normal is estimated again from doubled k wherever
/// sigma_ar < 0.1. The mean neighbor distance, Eq. (4.2), is renewed with it.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/neighborhoods/kd_tree.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/normals/detail/ring_gatherer.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/estimator.hpp>

namespace gnomon {

/// An estimate that knows the aspect ratio of its neighborhood.
template <class T>
concept has_aspect_ratio = requires(const T& estimate) {
    { estimate.aspect_ratio() } -> std::convertible_to<double>;
};

/// When and how often to try again.
struct anisotropy_repair {
    double min_aspect_ratio = 0.1;  ///< sigma_ar below which a neighborhood counts as anisotropic
    int doublings = 1;              ///< how often k may be doubled; the thesis does so once
};

/// Estimates again, from doubled k, every finite point whose neighborhood is anisotropic. Orient
/// the normals afterwards, not before.
///
/// @param surface  what estimate_normals gave for `points` and `policy`; changed in place
/// @return the number of points that were estimated again
/// @throws std::invalid_argument  if surface and points differ in size, or k is 0
/// Complexity: one kd-tree, and one search and estimate per flagged point and doubling.
template <class R, estimator E, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj> && has_aspect_ratio<estimate_t<E>>
std::size_t repair_anisotropic(const R& points, std::vector<surfel<estimate_t<E>>>& surface,
                               const knn& policy, const E& estimate,
                               const anisotropy_repair& repair = {}, const X& run = {},
                               Proj projection = {}) {
    const position_view<R, Proj> p(points, projection);
    detail::require(surface.size() == p.size(),
                    "repair_anisotropic: the surface is of other points");
    std::vector<std::size_t> flagged(surface.size());
    std::iota(flagged.begin(), flagged.end(), std::size_t{0});
    const auto settled = [&](std::size_t i) {
        return surface[i].trust == trust::not_finite || surface[i].neighbors == 0 ||
               surface[i].aspect_ratio() >= repair.min_aspect_ratio;
    };

    detail::require(policy.k > 0, "repair_anisotropic: k must be at least 1");
    std::erase_if(flagged, settled);
    const std::size_t repaired = repair.doublings > 0 ? flagged.size() : 0;
    if (repaired == 0) return 0;

    const kd_tree tree(points, projection);
    const viewpoint_table viewpoints = viewpoints_of(points);
    knn wider = policy;
    for (int round = 0; round < repair.doublings && !flagged.empty(); ++round) {
        if (wider.k >= p.size()) break;  // there are no more neighbors to be had
        wider.k *= 2;
        const auto found = [&](std::size_t i, std::vector<neighbor>& buffer) {
            wider.find(tree, p, i, buffer);
            return detail::noted_ring<const std::vector<neighbor>&>{buffer, {}};
        };
        const auto index_of = [&flagged](std::size_t f) { return flagged[f]; };
        detail::estimate_at(run, flagged.size(), index_of, p, viewpoints, found, estimate, surface);
        std::erase_if(flagged, settled);
    }
    return repaired;
}

}  // namespace gnomon
