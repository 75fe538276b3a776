// SPDX-License-Identifier: BSL-1.0
/// @file
/// As many nearest neighbors as a point needs: few where the surface bends, many where noise must
/// be averaged out or a scanner's lines lie far apart. The numbers of neighbors to choose from form
/// a geometric series; a *preference* puts a cost on each, from the moments of that many neighbors,
/// and the least cost is taken. `surfel::neighbors` is the resulting number.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/symmetric_eigen.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/spectrum.hpp>
#include <gnomon/neighborhoods/adjacency.hpp>
#include <gnomon/neighborhoods/detail/graph_of.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace gnomon {

/// What a neighborhood of a certain size looks like.
struct neighborhood_shape {
    std::size_t k;                       ///< number of neighbors
    double squared_radius;               ///< of the ball that holds them [m^2]
    gnomon::spectrum spectrum;           ///< of the neighbors and the point [m^2]
    Eigen::Vector3d ray{0.0, 0.0, 0.0};  ///< from the view point to the point [m]
};

/// cost(shape) of a neighborhood: the least is taken, and of equals the smallest.
template <class P>
concept size_preference = requires(const P& preference, const neighborhood_shape& shape) {
    { preference(shape) } -> std::convertible_to<double>;
};

/// Doubles the size until the neighborhood is not that of a single scan line; takes the least
/// elongated one if there is none. Klasing 2010, Sec. 3.2.9, Eq. (3.19), before the estimate
/// instead of after it.
struct prefer_isotropic {
    double min_aspect_ratio = 0.1;  ///< sigma_ar

    [[nodiscard]] double operator()(const neighborhood_shape& shape) const {
        return std::max(0.0, min_aspect_ratio - shape.spectrum.aspect_ratio());
    }
};

/// The size at which one kind of shape (line, plane, ball) is most distinct: least Shannon entropy
/// of the normalized eigenvalues. Weinmann et al. 2014.
struct prefer_low_entropy {
    [[nodiscard]] double operator()(const neighborhood_shape& shape) const {
        const Eigen::Vector3d& l = shape.spectrum.lambda;
        const double sum = l[0] + l[1] + l[2];
        double entropy = 0.0;
        for (int i = 0; i < 3; ++i) {
            const double e = l[i] / sum;
            if (e > 0.0) entropy -= e * std::log(e);
        }
        return sum > 0.0 ? entropy : std::numeric_limits<double>::infinity();
    }
};

/// The size at which the normal is expected to err least: noise turns it by 2 sigma / (r sqrt(k))
/// in a disc of radius r, curvature by as much as the neighbors depart from a plane beyond the
/// noise. After Mitra, Nguyen and Guibas 2004, with the curvature read off the residual instead of
/// estimated first.
struct prefer_small_error {
    noise_curve noise = constant_noise{};  ///< of the sensor, taken as that across the surface

    [[nodiscard]] double operator()(const neighborhood_shape& shape) const {
        const double variance = noise.variance_along(shape.ray);
        const double turn = 4.0 * variance / static_cast<double>(shape.k + 1);
        const double excess = std::max(0.0, shape.spectrum.lambda[2] - variance);
        return shape.squared_radius > 0.0 ? (turn + excess) / shape.squared_radius
                                          : std::numeric_limits<double>::infinity();
    }
};

/// Models `indexed_neighborhood`. Neighbors come in canonical order, nearest first.
template <size_preference Preference = prefer_isotropic>
struct adaptive_knn {
    std::size_t min_k = 10;      ///< smallest size
    std::size_t max_k = 80;      ///< largest size
    double growth = 2.0;         ///< from one size to the next
    Preference preference = {};  ///< which of the sizes is taken

    /// The stored graph of points, or of an index of them. O(n (log n + max_k log max_k)).
    /// @throws std::invalid_argument  unless 1 <= min_k <= max_k and growth >= 1.1
    template <class R, execution X = sequential, class Proj = std::identity>
        requires point_range<R, Proj>
    [[nodiscard]] adjacency operator()(const R& points, const X& run = {},
                                       Proj projection = {}) const {
        return detail::graph_of(*this, points, run, projection);
    }

    /// Replaces the content of `found` by the neighbors of the finite point i.
    /// O(log n + max_k log max_k).
    /// @throws std::invalid_argument  unless 1 <= min_k <= max_k and growth >= 1.1
    void find(const spatial_index& index, std::size_t i, std::vector<neighbor>& found) const {
        require_valid();
        knn{.k = max_k}.find(index, i, found);
        found.resize(best_size(index, i, found), {});
    }

    /// @throws std::invalid_argument  unless 1 <= min_k <= max_k and growth >= 1.1
    void require_valid() const {
        detail::require(min_k >= 1 && min_k <= max_k, "adaptive_knn: needs 1 <= min_k <= max_k");
        detail::require(growth >= 1.1 && std::isfinite(growth),
                        "adaptive_knn: growth must be at least 1.1");
    }

  private:
    /// The number of neighbors of point i of least cost, from the `max_k` nearest.
    [[nodiscard]] std::size_t best_size(const spatial_index& index, std::size_t i,
                                        const std::vector<neighbor>& found) const {
        const Eigen::Vector3d p = index[i], ray = detail::difference(p, index.viewpoints[i]);
        moments m;
        std::size_t best = std::min(min_k, found.size());
        double least = std::numeric_limits<double>::infinity();
        double wanted = static_cast<double>(min_k);
        while (m.count < found.size()) {
            wanted = std::min(wanted, static_cast<double>(found.size()));
            const auto k = std::min(static_cast<std::size_t>(wanted), found.size());
            while (m.count < k) m.add(detail::difference(index[found[m.count].index], p));
            const Eigen::Matrix3d covariance = m.covariance_with_point();
            if (!detail::has_finite_trace(covariance)) break;
            const double cost = preference(
                neighborhood_shape{k, found[k - 1].squared_distance,
                                   spectrum(detail::symmetric_eigen(covariance).values), ray});
            if (cost < least) {
                least = cost;
                best = k;
            }
            wanted = std::max(wanted * growth, wanted + 1.0);
        }
        return best;
    }
};

template <class Preference>
adaptive_knn(std::size_t, std::size_t, double, Preference) -> adaptive_knn<Preference>;

}  // namespace gnomon
