// SPDX-License-Identifier: BSL-1.0
/// @file
/// From neighbors to surface elements: the loop of all algorithms that estimate normals.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/detail/neighbor_gatherer.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/surfel.hpp>

namespace gnomon::detail {

/// Whether an ulp of the coordinates at p exceeds 5 % of the mean distance to the neighbors [m],
/// for coordinates of this machine epsilon.
[[nodiscard]] inline bool is_coarse(double epsilon, const Eigen::Vector3d& p,
                                    double mean_distance) {
    const double ulp = epsilon * std::max({std::abs(p.x()), std::abs(p.y()), std::abs(p.z())});
    return ulp > 0.05 * mean_distance;
}

/// Makes surface elements of points one by one, through one buffer.
template <estimator E, class Points>
class surfel_maker {
  public:
    /// @param epsilon  machine epsilon of the numbers that the points came in
    surfel_maker(const E& estimate, const Points& points, const viewpoint_table& viewpoints,
                 double epsilon)
        : estimate_(estimate),
          points_(points),
          viewpoints_(viewpoints),
          epsilon_(epsilon),
          gather_(points, "estimate_normals: a neighbor index of the graph is out of range") {}

    /// The surface element of point i with its neighbors.
    template <class Neighbors>
    surfel<estimate_t<E>> operator()(std::size_t i, const noted_neighborhood<Neighbors>& noted) {
        const Eigen::Vector3d p = points_[i];
        surfel<estimate_t<E>> s;
        if (!is_finite(p)) {
            s.trust = trust::not_finite;
            s.normal = Eigen::Vector3d(0.0, 0.0, 0.0);
            return s;
        }
        const neighborhood_view neighbors = gather_(noted);
        static_cast<estimate_t<E>&>(s) = checked(i, raw(i, p, neighbors));
        s.neighbors = static_cast<point_index>(neighbors.size());
        if (!neighbors.empty()) {
            for (const Eigen::Vector3d& q : neighbors) {
                s.mean_distance += std::sqrt(squared_distance(q, p));
            }
            s.mean_distance /= static_cast<double>(neighbors.size());
        }
        if (s.trust == trust::good && (coarse(p, s.mean_distance) || !noted.note.certified))
            s.trust = trust::weak;
        return s;
    }

    /// That of point i from what a sweep has found.
    surfel<estimate_t<E>> from_sweep(std::size_t i, const auto& found) {
        found.sort_into(sorted_);
        return (*this)(i, noted_neighborhood<const scratch<neighbor>&>{sorted_, {}});
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
    [[nodiscard]] bool coarse(const Eigen::Vector3d& p, double mean_distance) const {
        return is_coarse(epsilon_, p, mean_distance);
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
        const double x = e.normal[0], y = e.normal[1], z = e.normal[2];
        const double length = std::sqrt(x * x + (y * y + z * z));
        if (!std::isfinite(length)) e.trust = trust::not_finite;
        if (length < 1e-150) e.trust = trust::degenerate;
        if (usable(e.trust)) e.normal = Eigen::Vector3d(x / length, y / length, z / length);
    }

    estimator_result_t<E> raw(std::size_t i, const Eigen::Vector3d& p,
                              neighborhood_view neighbors) const {
        if constexpr (ray_estimator<E>) {
            return std::invoke(estimate_, p, neighbors, viewpoints_[i]);
        } else {
            return std::invoke(estimate_, p, neighbors);
        }
    }

    const E& estimate_;
    const Points& points_;
    const viewpoint_table& viewpoints_;
    double epsilon_;
    neighbor_gatherer<Points> gather_;
    scratch<neighbor> sorted_;
};

/// Visits the neighborhoods that a sweep finds and makes surface elements of them, several at once
/// if the estimator can.
template <estimator E, class Points>
class sweep_visitor {
  public:
    /// @param epsilon  machine epsilon of the numbers that the points came in
    sweep_visitor(const E& estimate, const Points& points, const viewpoint_table& viewpoints,
                  double epsilon, std::vector<surfel<estimate_t<E>>>& surface)
        : estimate_(estimate), make_(estimate, points, viewpoints, epsilon), surface_(surface) {}

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

    /// Called at the end of a chunk of work.
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

/// Renews surface[i] for i = index_of(0), ..., index_of(n - 1), from neighborhoods that are stored
/// or found: neighborhoods(i, buffer).
template <execution X, estimator E, class Points>
void estimate_at(const X& run, std::size_t n, auto&& index_of, const Points& points,
                 const viewpoint_table& viewpoints, double epsilon, auto&& neighborhoods,
                 const E& estimate, std::vector<surfel<estimate_t<E>>>& surface) {
    for_each_chunk(run, n, [&](std::size_t begin, std::size_t end) {
        surfel_maker<E, Points> make(estimate, points, viewpoints, epsilon);
        buffer_of<decltype(neighborhoods)> buffer;
        for (std::size_t j = begin; j < end; ++j) {
            const std::size_t i = index_of(j);
            surface[i] = make(i, neighborhoods(i, buffer));
        }
    });
}

}  // namespace gnomon::detail
