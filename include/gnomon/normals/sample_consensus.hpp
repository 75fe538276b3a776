// SPDX-License-Identifier: BSL-1.0
/// @file
/// Planes by sample consensus: of many planes through three of the points each, the one that most
/// others agree with, fitted once more to those. For neighborhoods in which outliers abound.
///
/// Klasing 2010, Sec. 3.2.6 names both as improvements. RANSAC: Fischler and Bolles 1981; MLESAC:
/// Torr and Zisserman 2000.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/normals/detail/require_sigma.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/plane_fit.hpp>

namespace gnomon {

/// Where inliers end, in standard deviations: 99 % of them lie within.
inline constexpr double inlier_limit = 2.5;

namespace detail {

/// Distances as costs are given them: of one point, in its plane.
struct one_distance {
    void operator()(auto&& visit) const { visit(0.0); }
};

}  // namespace detail

/// How badly points agree with a plane: cost(sigma, distances), smaller is better, where
/// distances(visit) calls visit(signed distance [m]) for every point.
template <class C>
concept consensus_cost =
    requires(const C& cost, double sigma, const detail::one_distance& distances) {
        { cost(sigma, distances) } -> std::convertible_to<double>;
    };

/// RANSAC: the number of points that are not inliers.
struct count_outliers {
    [[nodiscard]] double operator()(double sigma, auto&& distances) const {
        double outliers = 0.0;
        distances([&](double d) { outliers += std::abs(d) > inlier_limit * sigma; });
        return outliers;
    }
};

/// MLESAC: minus the logarithm of the likelihood of inliers, normally distributed, and outliers,
/// anywhere within `reach`, in the proportion that fits best.
struct mixture_likelihood {
    double reach = 40.0;   ///< the width over which outliers are spread [sigma]
    int mixing_steps = 3;  ///< of expectation and maximization, for the proportion

    [[nodiscard]] double operator()(double sigma, auto&& distances) const {
        detail::require(reach > 0.0 && std::isfinite(reach),
                        "mixture_likelihood: the reach must be positive and finite");
        const double outlier = 1.0 / reach;
        const auto inlier = [sigma](double d) {
            constexpr double height = 0.5 * std::numbers::sqrt2 * std::numbers::inv_sqrtpi;
            return height * std::exp(-0.5 * (d / sigma) * (d / sigma));
        };
        double share = 0.5;
        for (int step = 0; step < mixing_steps; ++step) {
            double expected = 0.0;
            double n = 0.0;
            distances([&](double d) {
                const double in = share * inlier(d);
                expected += in / (in + (1.0 - share) * outlier);
                n += 1.0;
            });
            share = expected / n;
        }
        double cost = 0.0;
        distances([&](double d) { cost -= std::log(share * inlier(d) + (1.0 - share) * outlier); });
        return cost;
    }
};

/// Models `estimator`. Needs three neighbors. O(trials k).
///
/// Trust: that of PlanePCA on the inliers of the best plane.
template <consensus_cost Cost>
struct sample_consensus {
    static constexpr auto sensitive_to = sensitivity::order | sensitivity::units;

    double sigma = 0.01;     ///< standard deviation of inliers across the plane [m]
    int trials = 60;         ///< enough for one triple without outliers in 1,000, were half of them
    std::uint64_t seed = 1;  ///< of the triples, which are the same for every point
    double min_aspect_ratio = 0.1;  ///< sigma_ar of the inliers below which the normal is weak
    [[no_unique_address]] Cost cost = {};

    /// @throws std::invalid_argument  unless sigma is positive and finite and there is a trial
    [[nodiscard]] plane_fit operator()(const Eigen::Vector3d& p, ring_view ring) const {
        detail::require_sigma(sigma);
        detail::require(trials >= 1, "sample_consensus: needs a trial");
        if (ring.size() < 3) return {};
        const std::size_t n = ring.size() + 1;
        const auto offset = [&](std::size_t j) -> Eigen::Vector3d {
            return j == 0 ? Eigen::Vector3d(0.0, 0.0, 0.0) : detail::difference(ring[j - 1], p);
        };

        random_stream random(seed);
        plane best;
        double least = std::numeric_limits<double>::infinity();
        for (int trial = 0; trial < trials; ++trial) {
            const Eigen::Vector3d a = offset(random.bits() % n);
            const Eigen::Vector3d b = offset(random.bits() % n);
            const Eigen::Vector3d c = offset(random.bits() % n);
            const Eigen::Vector3d normal =
                detail::cross(detail::difference(b, a), detail::difference(c, a));
            const double length = detail::length(normal);
            if (!(length > 0.0) || !std::isfinite(length)) continue;  // a line: no plane
            const plane candidate{detail::scaled(1.0 / length, normal),
                                  detail::dot(a, normal) / length};
            const double value = cost(sigma, [&](auto&& visit) {
                for (std::size_t j = 0; j < n; ++j) visit(candidate.signed_distance(offset(j)));
            });
            if (value < least) {
                least = value;
                best = candidate;
            }
        }
        plane_fit fit;
        fit.trust = trust::degenerate;
        if (least == std::numeric_limits<double>::infinity()) return fit;
        weighted_moments inliers;
        for (std::size_t j = 0; j < n; ++j) {
            const Eigen::Vector3d d = offset(j);
            if (std::abs(best.signed_distance(d)) <= inlier_limit * sigma) inliers.add(d, 1.0);
        }
        return detail::plane_of_least_spread(inliers.covariance(), min_aspect_ratio);
    }
};

using ransac_plane = sample_consensus<count_outliers>;
using mlesac_plane = sample_consensus<mixture_likelihood>;

}  // namespace gnomon
