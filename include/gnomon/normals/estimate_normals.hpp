// SPDX-License-Identifier: BSL-1.0
/// @file
/// Normals for all points of a cloud: any neighborhood, any estimator, one loop for all of them.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/touched_vector.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/normals/detail/ring_gatherer.hpp>
#include <gnomon/normals/estimator.hpp>

namespace gnomon {

/// A surface element: the estimator's own result, and what the neighborhood told besides.
template <class Estimate>
struct surfel : Estimate {
    double mean_distance = 0.0;  ///< rho_bar, mean distance to the neighbors [m], Eq. (4.2)
    point_index neighbors = 0;   ///< how many there were
};

namespace detail {

/// Whether an ulp of the coordinates at p exceeds 5 % of the mean distance to the neighbors [m], in
/// the scalar that the points came in.
template <class Scalar>
[[nodiscard]] bool is_coarse(const Eigen::Vector3d& p, double mean_distance) {
    const double ulp = static_cast<double>(std::numeric_limits<Scalar>::epsilon()) *
                       std::max({std::abs(p.x()), std::abs(p.y()), std::abs(p.z())});
    return ulp > 0.05 * mean_distance;
}

/// Makes surface elements of the points of a position_view one by one, through one buffer.
template <estimator E, class Points>
class surfel_maker {
  public:
    surfel_maker(const E& estimate, const Points& points, const viewpoint_table& viewpoints)
        : estimate_(estimate),
          points_(points),
          viewpoints_(viewpoints),
          gather_(points, "estimate_normals: the graph lists a neighbor of no point") {}

    /// The surface element of point i, whose ring `noted` is.
    template <class Ring>
    surfel<estimate_t<E>> operator()(std::size_t i, const noted_ring<Ring>& noted) {
        const Eigen::Vector3d p = points_[i];
        surfel<estimate_t<E>> s;
        if (!is_finite(p)) {
            s.trust = trust::not_finite;
            s.normal = Eigen::Vector3d(0.0, 0.0, 0.0);
            return s;
        }
        const ring_view ring = gather_(noted);
        static_cast<estimate_t<E>&>(s) = checked(i, raw(i, p, ring));
        s.neighbors = static_cast<point_index>(ring.size());
        if (!ring.empty()) {
            for (const Eigen::Vector3d& q : ring) {
                s.mean_distance += std::sqrt(squared_distance(q, p));
            }
            s.mean_distance /= static_cast<double>(ring.size());
        }
        if (s.trust == trust::good && (coarse(p, s.mean_distance) || !noted.note.certified))
            s.trust = trust::weak;
        return s;
    }

    /// That of point i from what a sweep has found.
    surfel<estimate_t<E>> from_sweep(std::size_t i, const auto& found) {
        found.sort_into(sorted_);
        return (*this)(i, noted_ring<const std::vector<neighbor>&>{sorted_, {}});
    }

    /// The same from the estimate for point i, the number of its neighbors and the mean distance to
    /// them.
    surfel<estimate_t<E>> finished(std::size_t i, const estimator_result_t<E>& raw,
                                   std::size_t neighbors, double mean_distance) const {
        surfel<estimate_t<E>> s;
        static_cast<estimate_t<E>&>(s) = checked(i, raw);
        s.neighbors = static_cast<point_index>(neighbors);
        s.mean_distance = mean_distance;
        if (s.trust == trust::good && coarse(points_[i], mean_distance)) s.trust = trust::weak;
        return s;
    }

  private:
    static bool coarse(const Eigen::Vector3d& p, double mean_distance) {
        return is_coarse<typename Points::scalar>(p, mean_distance);
    }

    /// An estimate for point i, with the promises kept that an estimator may have broken: a usable
    /// normal has unit length, an unusable one is zero.
    estimate_t<E> checked(std::size_t i, const estimator_result_t<E>& raw) const {
        estimate_t<E> e;
        if constexpr (normal_estimate<estimator_result_t<E>>) {
            e = raw;
        } else {
            e.normal = position(raw);
            e.trust = trust::good;
        }
        if constexpr (ray_estimator<E>) {
            if (!is_finite(viewpoints_[i])) e.trust = trust::not_finite;
        }
        if (usable(e.trust)) {
            const bool is_unit = std::abs(dot(e.normal, e.normal) - 1.0) <= 1e-15;
            if (!is_unit) normalise(e);
        }
        if (!usable(e.trust)) e.normal = Eigen::Vector3d(0.0, 0.0, 0.0);
        return e;
    }

    static void normalise(estimate_t<E>& e) {
        const double length = e.normal.norm();
        if (!std::isfinite(length)) e.trust = trust::not_finite;
        if (length < 1e-150) e.trust = trust::degenerate;
        if (usable(e.trust)) e.normal /= length;
    }

    estimator_result_t<E> raw(std::size_t i, const Eigen::Vector3d& p, ring_view ring) const {
        if constexpr (ray_estimator<E>) {
            return std::invoke(estimate_, p, ring, viewpoints_[i]);
        } else {
            return std::invoke(estimate_, p, ring);
        }
    }

    const E& estimate_;
    const Points& points_;
    const viewpoint_table& viewpoints_;
    ring_gatherer<Points> gather_;
    std::vector<neighbor> sorted_;
};

/// Visits what a sweep finds and makes surface elements of it, several at once if the estimator
/// can.
template <estimator E, class Points>
class sweep_visitor {
  public:
    sweep_visitor(const E& estimate, const Points& points, const viewpoint_table& viewpoints,
                  std::vector<surfel<estimate_t<E>>>& surface)
        : estimate_(estimate), make_(estimate, points, viewpoints), surface_(surface) {}

    void operator()(std::size_t i, const auto& found) {
        if constexpr (batch_estimator<E>) {
            const auto sums = found.summed();
            waiting_[count_] = i;
            moments_[count_] = sums.about_point;
            mean_distances_[count_] = sums.mean_distance;
            if (++count_ == batch) finish();
        } else if constexpr (moment_estimator<E> && !ray_estimator<E>) {
            const auto sums = found.summed();
            surface_[i] = make_.finished(i, std::invoke(estimate_, sums.about_point), found.size(),
                                         sums.mean_distance);
        } else {
            surface_[i] = make_.from_sweep(i, found);
        }
    }

    /// Called when nothing more comes.
    void finish() {
        if constexpr (batch_estimator<E>) {
            const std::span waiting(moments_.data(), count_);
            std::invoke(estimate_, waiting, std::span(results_.data(), count_));
            for (std::size_t w = 0; w < count_; ++w) {
                surface_[waiting_[w]] =
                    make_.finished(waiting_[w], results_[w], waiting[w].count, mean_distances_[w]);
            }
            count_ = 0;
        }
    }

  private:
    static constexpr std::size_t batch = batch_estimator<E> ? 32 : 0;

    const E& estimate_;
    surfel_maker<E, Points> make_;
    std::vector<surfel<estimate_t<E>>>& surface_;
    std::size_t count_ = 0;
    std::array<std::size_t, batch> waiting_{};
    std::array<moments, batch> moments_{};
    std::array<double, batch> mean_distances_{};
    std::array<estimator_result_t<E>, batch> results_{};
};

/// Renews surface[i] for i = index_of(0), ..., index_of(n - 1), from `rings`, stored or found.
template <execution X, estimator E, class Points>
void estimate_at(const X& run, std::size_t n, auto&& index_of, const Points& points,
                 const viewpoint_table& viewpoints, auto&& rings, const E& estimate,
                 std::vector<surfel<estimate_t<E>>>& surface) {
    for_each_chunk(run, n, [&](std::size_t begin, std::size_t end) {
        surfel_maker<E, Points> make(estimate, points, viewpoints);
        std::vector<neighbor> buffer;
        for (std::size_t j = begin; j < end; ++j) {
            const std::size_t i = index_of(j);
            surface[i] = make(i, rings(i, buffer));
        }
    });
}

}  // namespace detail

/// The surface elements of all points, in their order: from a stored graph.
///
/// @param points      any point range of n points; ray estimators ask a scan, or what
///                    with_viewpoint(s) gives, for its view points and else assume the origin
/// @param graph       the neighbors of each of the n points, indices below n
/// @param estimate    any estimator
/// @param run         `sequential{}` or `threads{n}`; the result is the same bytes
/// @param projection  makes a point of an element of the range
/// @return n surface elements; a point without a usable normal has the zero vector and a trust that
///         says why. `weak` as well where an ulp of the coordinates exceeds 5 % of the mean
///         neighbor distance (float points far from the origin) or the ring is not certified;
///         `not_finite` as well where a ray estimator has a view point that is not.
/// @throws std::invalid_argument  if graph and points differ in size, an index is of no point, or
///                                the view points are for another number of points
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
    detail::estimate_at(run, p.size(), std::identity{}, p, viewpoints_of(points),
                        detail::stored_rings(graph), estimate, surface);
    return surface;
}

/// The same from a neighborhood policy. Nothing is stored if the policy streams: searched and
/// estimated point by point, or, if it sweeps, many points at once.
/// @throws std::invalid_argument  if the policy's parameters are out of range, e.g. k = 0
/// Complexity: one search and one call of the estimator per point.
template <class R, class N, estimator E, execution X = sequential, class Proj = std::identity>
    requires neighborhood<N, R, Proj>
[[nodiscard]] auto estimate_normals(const R& points, const N& policy, const E& estimate,
                                    const X& run = {}, Proj projection = {})
    -> std::vector<surfel<estimate_t<E>>> {
    const position_view<R, Proj> p(points, projection);
    const auto& team = detail::staying(run);
    if constexpr (sweeping_neighborhood<N, R, Proj>) {
        auto surface = detail::touched_vector<surfel<estimate_t<E>>>(p.size(), team);
        const viewpoint_table viewpoints = viewpoints_of(points);
        const auto make_visitor = [&] {
            return detail::sweep_visitor(estimate, p, viewpoints, surface);
        };
        if (policy.sweep(points, team, projection, make_visitor)) {
            for_each_chunk(team, p.size(), [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i)
                    if (!is_finite(p[i])) surface[i].trust = trust::not_finite;
            });
            return surface;
        }
    }
    if constexpr (streaming_neighborhood<N, R, Proj>) {
        const auto search = policy.search(points, projection);
        std::vector<surfel<estimate_t<E>>> surface(p.size());
        detail::estimate_at(team, p.size(), std::identity{}, p, viewpoints_of(points),
                            detail::found_rings(search), estimate, surface);
        return surface;
    } else {
        return estimate_normals(points, policy(points, team, projection), estimate, team,
                                projection);
    }
}

/// Refused: an estimator is called as e(point, ring) or e(point, ring, viewpoint) and gives a
/// `normal_estimate` or a bare 3-vector. Without this, compilers would first complain that a policy
/// is no graph.
template <class R, class N, class E>
    requires(!estimator<E>)
void estimate_normals(const R& points, const N& neighborhood, const E& not_an_estimator,
                      const auto&... others) = delete;

}  // namespace gnomon
