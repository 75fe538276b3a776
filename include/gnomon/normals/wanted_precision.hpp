// SPDX-License-Identifier: BSL-1.0
/// @file
/// Normals of a wanted precision: neighborhoods grow where the covariance of a normal is too large,
/// by doublings of k, and stay small where they suffice, so that edges stay sharp. The estimator
/// must be consistent with its neighborhood, or growing stops too early: `robust_ray_ls` or
/// `plane_eif` on `ray_knn`, `with_covariance<plane_pca>` on `knn`. With `robust_ray_ls` a
/// neighborhood may grow across an edge.
///
///     auto surface = gnomon::estimate_normals(scan, gnomon::ray_knn{.k = 16, .noise = noise},
///                                             gnomon::robust_ray_ls{.noise = noise},
///                                             gnomon::wanted_precision{gnomon::degrees(1.5)});
#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <vector>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/detail/neighbor_gatherer.hpp>
#include <gnomon/normals/detail/surfel_maker.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/surfel.hpp>

namespace gnomon {

/// The precision that normals should have, and the effort to reach it.
struct wanted_precision {
    angle deviation = degrees(1.5);  ///< the root mean square angle to the true normal
    std::size_t max_k = 256;         ///< k is not doubled beyond this
};

namespace detail {

/// An indexed neighborhood of a number of neighbors that may be doubled.
template <class N>
concept neighborhood_of_k = indexed_neighborhood<N> && requires(N policy) { policy.k *= 2; };

/// An estimate with the covariance of its normal.
template <class T>
concept has_covariance = requires(const T& estimate) {
    { estimate.trace() } -> std::convertible_to<double>;
};

}  // namespace detail

/// The surface elements of all points, in their order: each with the fewest neighbors, k times a
/// power of two, for which the normal is good and as precise as wanted. Where more neighbors are no
/// better, or k reaches its limit, it is the best normal until then.
///
/// @param points     any point range, or an index of it
/// @param policy     a neighborhood with a number k to begin with
/// @param estimate   an estimator whose estimates have covariances
/// @return as estimate_normals(points, policy, estimate); surfel::neighbors is the number found
/// @throws std::invalid_argument  as that, and unless the deviation is positive
/// Complexity: that of estimate_normals, and for each doubling one search and one estimate of each
/// point that needs it, O(max_k) at most.
template <class R, detail::neighborhood_of_k N, estimator E, execution X = sequential,
          class Proj = std::identity>
    requires point_range<R, Proj> && detail::has_covariance<estimate_t<E>>
[[nodiscard]] auto estimate_normals(const R& points, const N& policy, const E& estimate,
                                    const wanted_precision& wanted, const X& run = {},
                                    Proj projection = {}) -> std::vector<surfel<estimate_t<E>>> {
    detail::require(wanted.deviation > degrees(0), "wanted_precision: the angle must be positive");
    const double most = wanted.deviation.radians() * wanted.deviation.radians();
    const auto& team = detail::staying(run);
    const auto& index = detail::index_of(points, team, projection);
    auto surface = estimate_normals(index, policy, estimate, team);

    detail::scratch<std::size_t> vague;
    for (std::size_t i = 0; i < surface.size(); ++i)
        if (index.is_finite(i)) vague.push_back(i);
    const auto is_precise = [&](std::size_t i) {
        return surface[i].trust == trust::good && surface[i].trace() <= most;
    };
    const auto is_better = [](const auto& a, const auto& b) {
        if (a.trust == trust::good || b.trust == trust::good)
            return a.trust == trust::good && (b.trust != trust::good || a.trace() < b.trace());
        return usable(a.trust) && (!usable(b.trust) || a.trace() < b.trace());
    };
    std::vector<surfel<estimate_t<E>>> before;
    N wider = policy;
    while (wider.k <= wanted.max_k / 2 && wider.k < index.size()) {
        std::erase_if(vague, is_precise);
        if (vague.empty()) break;
        wider.k *= 2;
        before.clear();
        for (const std::size_t i : vague) before.push_back(surface[i]);
        detail::estimate_at(
            team, vague.size(), [&vague](std::size_t v) { return vague[v]; }, index,
            index.viewpoints, index.epsilon(), detail::found_neighborhoods(wider, index), estimate,
            surface);
        std::size_t left = 0;
        for (std::size_t v = 0; v < vague.size(); ++v) {
            const std::size_t i = vague[v];
            if (is_better(surface[i], before[v]))
                vague[left++] = i;
            else
                surface[i] = before[v];
        }
        vague.resize(left);
    }
    return surface;
}

}  // namespace gnomon
