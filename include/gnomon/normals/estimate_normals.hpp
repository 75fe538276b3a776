// SPDX-License-Identifier: BSL-1.0
/// @file
/// Normals for all points of a cloud: any neighborhood, any estimator, one loop.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <functional>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/normals/estimator.hpp>

namespace gnomon {

/// A surface element: the estimator's own result, and what the neighborhood told besides.
template <class Estimate>
struct surfel : Estimate {
    double mean_distance = 0.0;  ///< rho_bar, mean distance to the neighbors [m], Eq. (4.2)
    point_index neighbors = 0;   ///< how many there were
};

namespace detail {

/// The rings of one chunk of points, brought into estimators one by one through one buffer.
template <estimator E, class Scalar>
class surfel_maker {
  public:
    explicit surfel_maker(const E& estimate) : estimate_(estimate) {}

    /// The surface element of the point at `p`, whose neighbors `position_of` gives for each
    /// element of `ring`.
    template <class Ring, class PositionOf>
    surfel<estimate_t<E>> operator()(const Eigen::Vector3d& p, const Ring& ring,
                                     const PositionOf& position_of) {
        surfel<estimate_t<E>> s;
        if (!is_finite(p)) {
            s.trust = trust::not_finite;
            s.normal = Eigen::Vector3d::Zero();
            return s;
        }
        positions_.clear();
        for (const auto& q : ring) positions_.push_back(position_of(q));
        static_cast<estimate_t<E>&>(s) = checked(p);
        s.neighbors = static_cast<point_index>(positions_.size());
        if (!positions_.empty()) {
            for (const Eigen::Vector3d& q : positions_)
                s.mean_distance += std::sqrt(squared_distance(q, p));
            s.mean_distance /= static_cast<double>(positions_.size());
        }
        if (s.trust == trust::good && resolution(p) > coarse * s.mean_distance) {
            s.trust = trust::weak;
        }
        return s;
    }

  private:
    /// Coordinates whose ulp exceeds this part of the mean neighbor distance are too coarse.
    static constexpr double coarse = 0.05;

    /// The spacing [m] of representable coordinates at p, in the scalar that the points came in.
    static double resolution(const Eigen::Vector3d& p) {
        return static_cast<double>(std::numeric_limits<Scalar>::epsilon()) *
               std::max({std::abs(p.x()), std::abs(p.y()), std::abs(p.z())});
    }

    /// The estimate, with the promises kept that an estimator may have broken: a usable normal is
    /// finite, an unusable one is zero.
    estimate_t<E> checked(const Eigen::Vector3d& p) const {
        const ring_view ring(positions_);
        using result = std::invoke_result_t<const E&, const Eigen::Vector3d&, ring_view>;
        estimate_t<E> e;
        if constexpr (normal_estimate<result>) {
            e = std::invoke(estimate_, p, ring);
        } else {
            e.normal = std::invoke(estimate_, p, ring);
            const double length = e.normal.norm();
            if (length > 0.0 && std::isfinite(length)) {
                e.normal /= length;
                e.trust = trust::good;
            }
        }
        if (!e.normal.allFinite()) e.trust = trust::not_finite;
        if (!usable(e.trust)) e.normal = Eigen::Vector3d::Zero();
        return e;
    }

    const E& estimate_;
    std::vector<Eigen::Vector3d> positions_;
};

template <class R, class Proj>
using coordinate_t = typename position_view<R, Proj>::scalar;

}  // namespace detail

/// The surface elements of all points, in their order: from a stored graph.
///
/// @param points      any point range of n points
/// @param graph       the neighbors of each of the n points
/// @param estimate    any estimator
/// @param run         `sequential{}` or `threads{n}`; the result is the same bytes
/// @param projection  makes a point of an element of the range
/// @return n surface elements; a point without a usable normal has the zero vector and a trust that
///         says why. `weak` as well where an ulp of the coordinates exceeds 5 % of the mean
///         neighbor distance (float points far from the origin).
/// @throws std::invalid_argument  if graph and points differ in size
/// Complexity: one call of the estimator per point. Source: Klasing 2010, Sec. 3.2.
template <class R, neighborhood_graph G, estimator E, execution X = sequential,
          class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] auto estimate_normals(const R& points, const G& graph, const E& estimate,
                                    const X& run = {}, Proj projection = {})
    -> std::vector<surfel<estimate_t<E>>> {
    const position_view<R, Proj> p(points, std::move(projection));
    detail::require(graph.size() == p.size(), "estimate_normals: the graph is of other points");
    std::vector<surfel<estimate_t<E>>> surface(p.size());
    for_each_chunk(run, p.size(), [&](std::size_t begin, std::size_t end) {
        detail::surfel_maker<E, detail::coordinate_t<R, Proj>> make(estimate);
        for (std::size_t i = begin; i < end; ++i) {
            surface[i] = make(p[i], graph[i], [&p](point_index j) { return p[j]; });
        }
    });
    return surface;
}

/// The same from a neighborhood policy: searched and estimated point by point, nothing stored.
template <class R, class N, estimator E, execution X = sequential, class Proj = std::identity>
    requires neighborhood<N, R, Proj>
[[nodiscard]] auto estimate_normals(const R& points, const N& policy, const E& estimate,
                                    const X& run = {}, Proj projection = {})
    -> std::vector<surfel<estimate_t<E>>> {
    if constexpr (streaming_neighborhood<N, R, Proj>) {
        const position_view<R, Proj> p(points, projection);
        const auto search = policy.search(points, projection);
        std::vector<surfel<estimate_t<E>>> surface(p.size());
        for_each_chunk(run, p.size(), [&](std::size_t begin, std::size_t end) {
            detail::surfel_maker<E, detail::coordinate_t<R, Proj>> make(estimate);
            std::vector<neighbor> ring;
            for (std::size_t i = begin; i < end; ++i) {
                search(i, ring);
                surface[i] = make(p[i], ring, [&p](const neighbor& q) { return p[q.index]; });
            }
        });
        return surface;
    } else {
        return estimate_normals(points, policy(points, run, projection), estimate, run, projection);
    }
}

}  // namespace gnomon
