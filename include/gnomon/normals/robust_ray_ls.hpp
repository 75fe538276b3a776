// SPDX-License-Identifier: BSL-1.0
/// @file
/// The regression of `plane_eif` on the inliers among the neighbors. Near edges, and where scan
/// lines are far apart, neighbors are on several surfaces. If the regression on all of them leaves
/// outliers, planes through the point and pairs of neighbors are tried (MSAC: Torr and Zisserman
/// 2000). Such a plane has the noise of three points; each that is better than all before it is
/// fitted again to its inliers, and the best of these wins (Chum, Matas and Kittler 2003). Each
/// quadrant around the ray counts the same in the cost of a plane: otherwise one through the scan
/// line of the point and a car next to it would be better than the road, of which few other points
/// are near.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/neighborhoods/detail/scan_line.hpp>
#include <gnomon/normals/detail/ray_regression.hpp>
#include <gnomon/normals/detail/require_noise.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/normal_belief.hpp>
#include <gnomon/normals/plane_eif.hpp>
#include <gnomon/normals/ray_ls.hpp>

namespace gnomon {

namespace detail {

/// The plane of a regression, relative to the view point.
[[nodiscard]] inline plane plane_of(const ray_regression& r) {
    const Eigen::Vector3d m = r.solution();
    const double size = length(m);
    return {scaled(1.0 / size, m), r.range() / size};
}

/// Points relative to a view point, and their distances from planes. (A template for compile time
/// only.)
template <class Vector = Eigen::Vector3d>
class seen_points {
  public:
    /// @param p      the point whose normal is estimated, and its neighbors [m]
    /// @param sigma  of the noise along the rays [m]
    seen_points(const Vector& p, neighborhood_view neighbors, const Vector& viewpoint, double sigma)
        : neighbors_(neighbors),
          viewpoint_(viewpoint),
          x_(difference(p, viewpoint)),
          sigma_(sigma) {}

    [[nodiscard]] std::size_t size() const { return neighbors_.size(); }

    /// The regression on the point and the neighbors for which is_in(neighbor).
    [[nodiscard]] ray_regression regression(auto&& is_in) const {
        ray_regression r(x_);
        for (std::size_t j = 0; j < size(); ++j) {
            const Vector q = at(j);
            if (is_in(q)) r.add(difference(q, x_));
        }
        r.solve();
        return r;
    }
    /// The regression on the point and the inliers of a plane.
    [[nodiscard]] ray_regression regression_on(const plane& of) const {
        return regression([&](const Vector& q) { return is_inlier(of, q); });
    }

    [[nodiscard]] bool has_point_on(const plane& one) const { return is_inlier(one, x_); }
    /// The share of the neighbors that are inliers.
    [[nodiscard]] double share_on(const plane& one) const {
        std::size_t inliers = 0;
        for (std::size_t j = 0; j < size(); ++j) inliers += is_inlier(one, at(j)) ? 1 : 0;
        return static_cast<double>(inliers) / static_cast<double>(size());
    }

    /// Of the planes through the point and two of its neighbors, fitted again to their inliers, the
    /// one of least cost; without a normal, if no pair determines one. Of more than 256 neighbors,
    /// those at even distances in their order count. Ends when, with the share of inliers of the
    /// best plane so far, all compared pairs contain an outlier with a probability of at most 0.1 %
    /// (Fischler and Bolles 1981).
    [[nodiscard]] plane consensus(int trials, std::uint64_t seed) const {
        constexpr double failure_probability = 1e-3;  // of no unit; as that of 60 trials, below
        const plane_costs cost(*this);
        random_stream random(seed);
        plane best{{0.0, 0.0, 0.0}, 0.0};
        double least = std::numeric_limits<double>::infinity(), least_tried = least;
        auto needed = static_cast<double>(trials);
        for (int drawn = 0, compared = 0; drawn < trials && compared < needed; ++drawn) {
            const Vector a = difference(at(random.below(size())), x_);
            const Vector b = difference(at(random.below(size())), x_);
            const Vector n = cross(a, b);
            const double area = length(n);
            constexpr double elongated = 0.2;  // the sine of 12 degrees: performance only
            if (!(area > elongated * length(a) * length(b))) continue;
            const plane tried{scaled(1.0 / area, n), dot(n, x_) / area};
            if (!(std::abs(tried.offset) > grazing_cosine * length(x_))) continue;
            ++compared;
            const double of_tried = cost(tried, least_tried);
            if (!(of_tried < least_tried)) continue;
            least_tried = of_tried;
            // Pairs are drawn from all neighbors, but planes are compared by quadrant.
            const double share = std::min(share_on(tried), std::max(0.0, 1.0 - of_tried));
            needed = std::min(needed, std::log(failure_probability) / std::log1p(-share * share));
            const ray_regression again = regression_on(tried);
            if (!usable(again.status())) continue;
            const plane fitted = plane_of(again);
            const double of_fitted = cost(fitted, least);
            if (!(of_fitted < least)) continue;
            least = of_fitted;
            best = fitted;
        }
        return best;
    }

  private:
    /// The cost of planes, 0 to 1: of the points farther than two standard deviations, and of the
    /// others by their squared distances; each quadrant around the ray counts the same. (A plane
    /// between two surfaces has much more within three deviations than within two.)
    class plane_costs {
      public:
        explicit plane_costs(const seen_points& points)
            : points_(points), step_((points.size() + most_counted - 1) / most_counted) {
            const ray_plane<Vector> around(scaled(1.0 / length(points.x_), points.x_));
            scan_line<> line;
            for (std::size_t j = 0; j < points.size(); j += step_)
                line.add(around.offset(points.at(j)));
            line.fit();
            const auto quadrant = [&](std::size_t j) {
                return line.quadrant(around.offset(points.at(j * step_)));
            };
            std::array<double, 4> counts{};
            for (std::size_t j = 0; j * step_ < points.size(); ++j) counts[quadrant(j)] += 1.0;
            const auto seen = std::ranges::count_if(counts, [](double n) { return n > 0.0; });
            for (std::size_t j = 0; j * step_ < points.size(); ++j)
                weight_[j] = 1.0 / (counts[quadrant(j)] * static_cast<double>(seen));
        }

        /// The cost of a plane, or one that is not less than `least`.
        [[nodiscard]] double operator()(const plane& of, double least) const {
            constexpr double most = 2.0;  // chosen on streets 20,001 to 20,012 and rooms
            double cost = 0.0;
            for (std::size_t j = 0; j * step_ < points_.size() && cost < least; ++j) {
                const double d2 = points_.squared_deviation(of, points_.at(j * step_));
                cost += weight_[j] * std::min(1.0, d2 / (most * most));
            }
            return cost;
        }

      private:
        static constexpr std::size_t most_counted = 256;  // performance only
        const seen_points& points_;
        std::size_t step_;
        std::array<double, most_counted> weight_{};
    };

    /// The squared distance of a point from a plane, divided by its variance: that of the noise
    /// across the plane, and of half of the noise in any direction, for errors that are not along
    /// the ray (chosen on streets 20,001 to 20,003).
    [[nodiscard]] double squared_deviation(const plane& from, const Vector& x) const {
        constexpr double elsewhere = 0.5;  // of the noise along the ray
        const double along = dot(from.normal, x), off = along - from.offset;
        const double r2 = dot(x, x);
        return off * off * r2 / (sigma_ * sigma_ * (along * along + elsewhere * elsewhere * r2));
    }
    [[nodiscard]] bool is_inlier(const plane& of, const Vector& x) const {
        constexpr double most = 3.0;  // deviations: 99.7 % of a normal distribution
        return squared_deviation(of, x) <= most * most;
    }

    [[nodiscard]] Vector at(std::size_t j) const { return difference(neighbors_[j], viewpoint_); }

    neighborhood_view neighbors_;
    Vector viewpoint_, x_;
    double sigma_;
};

}  // namespace detail

/// Models `ray_estimator`. Needs three neighbors. O(k) where they are inliers, and O(trials k)
/// elsewhere.
///
/// Trust: that of `plane_eif` on the inliers; `weak` as well where the point is not one of them, or
/// fewer than half of the neighbors are.
struct robust_ray_ls {
    static constexpr auto sensitive_to = sensitivity::order | sensitivity::units;

    noise_curve noise = constant_noise{};  ///< along the rays
    /// The number of pairs at most; with two thirds of the neighbors outliers, all of them contain
    /// one in (1 - 1/9)^60, 1 of 1,000 cases.
    int trials = 60;
    std::uint64_t seed = 1;          ///< of the pairs; every point uses the same sequence
    double min_aspect_ratio = 0.05;  ///< of the rays of the inliers, below which the normal is weak

    /// (A template for compile time only.)
    /// @throws std::invalid_argument  if the noise is 0, or there is no trial
    template <class Vector = Eigen::Vector3d>
    [[nodiscard]] normal_belief<ray_fit> operator()(const std::type_identity_t<Vector>& p,
                                                    neighborhood_view neighbors,
                                                    const Eigen::Vector3d& viewpoint = {
                                                        0.0, 0.0, 0.0}) const {
        detail::require_noise(noise);
        detail::require(trials >= 1, "robust_ray_ls: needs a trial");
        if (neighbors.size() < 3) return {};
        const Vector ray = detail::difference(p, viewpoint);
        const double sigma = noise.along(ray);
        const detail::seen_points<Vector> points(p, neighbors, viewpoint, sigma);
        auto regression = points.regression([](const auto&) { return true; });
        constexpr double nearly_all = 0.95;  // chosen on streets 20,001 to 20,003
        bool is_inlier = true;
        if (usable(regression.status())) {
            plane found = detail::plane_of(regression);
            if (!points.has_point_on(found) || points.share_on(found) < nearly_all) {
                const plane best = points.consensus(trials, seed);
                if (detail::has_length(best.normal)) found = best;
                regression = points.regression_on(found);
                if (usable(regression.status())) found = detail::plane_of(regression);
                is_inlier = points.has_point_on(found) && points.share_on(found) >= 0.5;
            }
        }
        auto belief = detail::belief_of(regression, ray, sigma, min_aspect_ratio);
        if (belief.trust == trust::good && !is_inlier) belief.trust = trust::weak;
        return belief;
    }
};

}  // namespace gnomon
