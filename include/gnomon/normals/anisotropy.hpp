// SPDX-License-Identifier: BSL-1.0
/// @file
/// Anisotropic neighborhoods and their repair. Where a scanner's lines are dense but far apart, the
/// k nearest neighbors all come from one line and say nothing of the surface across it. Such
/// neighborhoods betray themselves by their aspect ratio; more neighbors reach the next line.
///
/// Klasing 2010, Sec. 3.2.9, Eq. (3.19): the normal is estimated again from doubled k wherever
/// sigma_ar < 0.1. The mean neighbor distance, Eq. (4.2), is renewed with it.
#pragma once

#include <cstddef>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/neighborhoods/knn.hpp>
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

/// Estimates again, from doubled k, every finite point whose neighborhood is anisotropic.
///
/// @param surface  what estimate_normals gave for `points` and `policy`; changed in place
/// @return the number of points that were estimated again
/// @throws std::invalid_argument  if surface and points differ in size
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

    std::size_t repaired = 0;
    knn wider = policy;
    for (int round = 0; round < repair.doublings; ++round) {
        std::erase_if(flagged, settled);
        if (flagged.empty()) break;
        if (round == 0) repaired = flagged.size();
        wider.k *= 2;
        const auto search = wider.search(points, projection);
        for_each_chunk(run, flagged.size(), [&](std::size_t begin, std::size_t end) {
            detail::surfel_maker<E, detail::coordinate_t<R, Proj>> make(estimate);
            std::vector<neighbor> ring;
            for (std::size_t f = begin; f < end; ++f) {
                const std::size_t i = flagged[f];
                search(i, ring);
                surface[i] = make(p[i], ring, [&p](const neighbor& q) { return p[q.index]; });
            }
        });
    }
    return repaired;
}

}  // namespace gnomon
