// SPDX-License-Identifier: BSL-1.0
/// @file
/// Anisotropic neighborhoods and their repair. Where a scanner's lines are dense but far apart, the
/// k nearest neighbors all come from one line and contain no information about the surface
/// across it. Such neighborhoods have a small aspect ratio; more neighbors reach the next line.
///
/// Klasing 2010, Sec. 3.2.9, Eq. (3.19): the normal is estimated again from doubled k wherever
/// sigma_ar < 0.1. The mean neighbor distance, Eq. (4.2), is renewed with it.
#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <vector>

#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/detail/neighbor_gatherer.hpp>
#include <gnomon/normals/detail/surfel_maker.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/surfel.hpp>

namespace gnomon {

namespace detail {

/// An estimate that knows the aspect ratio of its neighborhood.
template <class T>
concept has_aspect_ratio = requires(const T& estimate) {
    { estimate.aspect_ratio() } -> std::convertible_to<double>;
};

}  // namespace detail

/// When and how often to try again.
struct repair_anisotropic_options {
    double min_aspect_ratio = 0.1;  ///< sigma_ar below which a neighborhood counts as anisotropic
    int doublings = 1;              ///< how often k may be doubled; the thesis does so once

    /// @throws std::invalid_argument  if one of them is negative or NaN
    void require_valid() const {
        detail::require(min_aspect_ratio >= 0.0 && doublings >= 0,
                        "repair_anisotropic: an option must not be negative or NaN");
    }
};

/// Estimates again, from doubled k, every finite point whose neighborhood is anisotropic. Orient
/// the normals afterwards, not before.
///
/// @param points   any point range of n points, or an index of them
/// @param policy   the neighborhood that the surface was estimated from
/// @param surface  what estimate_normals returned for these; changed in place
/// @return the number of points that were estimated again
/// @throws std::invalid_argument  if surface and points differ in size, k is 0, or for options that
///                                are not valid
/// Complexity: one search and one estimate for each anisotropic point and doubling, and the index
/// if `points` is none.
template <class R, estimator E, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj> && detail::has_aspect_ratio<estimate_t<E>>
std::size_t repair_anisotropic(const R& points, const knn& policy,
                               std::vector<surfel<estimate_t<E>>>& surface, const E& estimate,
                               const repair_anisotropic_options& options = {}, const X& run = {},
                               Proj projection = {}) {
    policy.require_valid();
    options.require_valid();
    detail::require(surface.size() == position_view<R, Proj>(points, projection).size(),
                    "repair_anisotropic: surface and points differ in size");
    const auto is_isotropic = [&](std::size_t i) {
        return surface[i].trust == trust::not_finite || surface[i].neighbors == 0 ||
               surface[i].aspect_ratio() >= options.min_aspect_ratio;
    };
    detail::scratch<std::size_t> flagged;
    for (std::size_t i = 0; i < surface.size(); ++i)
        if (!is_isotropic(i)) flagged.push_back(i);
    if (options.doublings == 0 || flagged.empty()) return 0;

    const std::size_t repaired = flagged.size();
    const auto& index = detail::index_of(points, run, projection);
    knn wider = policy;
    for (int round = 0; round < options.doublings && !flagged.empty(); ++round) {
        if (wider.k >= index.size()) break;  // there are no more neighbors
        wider.k *= 2;
        detail::estimate_at(
            run, flagged.size(), [&flagged](std::size_t f) { return flagged[f]; }, index,
            index.viewpoints, index.epsilon(), detail::found_neighborhoods(wider, index), estimate,
            surface);
        std::erase_if(flagged, is_isotropic);
    }
    return repaired;
}

}  // namespace gnomon
