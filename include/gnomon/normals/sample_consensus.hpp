// SPDX-License-Identifier: BSL-1.0
/// @file
/// Planes by sample consensus, for neighborhoods with many outliers: among the planes through
/// random triples of points the one of least cost, refitted to its inliers by total least squares.
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
#include <gnomon/core/detail/weighted_moments.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/plane_fit.hpp>

namespace gnomon {
namespace detail {

/// The largest distance of an inlier, in standard deviations: 99 % of a normal distribution.
inline constexpr double inlier_limit = 2.5;

/// An archetype of the distances: those of one point, on its plane.
struct one_distance {
    void operator()(auto&& visit) const { visit(0.0); }
};

/// The cost of a plane: cost(sigma, distances), where distances(visit) calls visit(signed distance
/// [m]) for every point.
template <class C>
concept consensus_cost = requires(const C& cost, double sigma, const one_distance& distances) {
    { cost(sigma, distances) } -> std::convertible_to<double>;
};

/// RANSAC: the number of outliers.
struct count_outliers {
    [[nodiscard]] double operator()(double sigma, auto&& distances) const {
        double outliers = 0.0;
        distances([&](double d) { outliers += std::abs(d) > inlier_limit * sigma; });
        return outliers;
    }
};

/// MLESAC: the negative logarithm of the likelihood of a mixture of inliers, normally distributed,
/// and outliers, uniformly distributed, with the mixing proportion of maximum likelihood.
struct mixture_likelihood {
    double reach = 40.0;   ///< the width of the uniform distribution of outliers [sigma]
    int mixing_steps = 3;  ///< of expectation maximization, for the proportion

    [[nodiscard]] double operator()(double sigma, auto&& distances) const {
        require(reach > 0.0 && std::isfinite(reach),
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

/// The method behind `ransac_plane` and `mlesac_plane`.
template <consensus_cost Cost>
struct sample_consensus {
    static constexpr auto sensitive_to = sensitivity::order | sensitivity::units;

    double sigma = 0.01;  ///< standard deviation of inliers across the plane [m]
    /// The number of triples; with half of the points outliers, the probability that every triple
    /// contains one is (1 - 1/8)^60 < 0.001.
    int trials = 60;
    std::uint64_t seed = 1;         ///< of the triples; every point uses the same sequence
    double min_aspect_ratio = 0.1;  ///< sigma_ar of the inliers below which the normal is weak
    [[no_unique_address]] Cost cost = {};

    /// @throws std::invalid_argument  unless sigma is positive and finite and there is a trial
    [[nodiscard]] plane_fit operator()(const Eigen::Vector3d& p,
                                       neighborhood_view neighbors) const {
        require(sigma > 0.0 && std::isfinite(sigma),
                "ransac_plane, mlesac_plane: sigma must be positive and finite");
        require(trials >= 1, "ransac_plane, mlesac_plane: needs a trial");
        if (neighbors.size() < 3) return {};
        const std::size_t n = neighbors.size() + 1;
        const auto offset = [&](std::size_t j) -> Eigen::Vector3d {
            return j == 0 ? Eigen::Vector3d(0.0, 0.0, 0.0) : difference(neighbors[j - 1], p);
        };

        random_stream random(seed);
        plane best;
        double least = std::numeric_limits<double>::infinity();
        for (int trial = 0; trial < trials; ++trial) {
            const Eigen::Vector3d a = offset(random.below(n));
            const Eigen::Vector3d b = offset(random.below(n));
            const Eigen::Vector3d c = offset(random.below(n));
            const Eigen::Vector3d normal = cross(difference(b, a), difference(c, a));
            const double size = length(normal);
            if (!(size > 0.0) || !std::isfinite(size)) continue;  // collinear
            const plane candidate{scaled(1.0 / size, normal), dot(a, normal) / size};
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
        detail::weighted_moments inliers;
        for (std::size_t j = 0; j < n; ++j) {
            const Eigen::Vector3d d = offset(j);
            if (std::abs(best.signed_distance(d)) <= inlier_limit * sigma) inliers.add(d, 1.0);
        }
        return plane_of_least_spread(inliers.covariance(), min_aspect_ratio);
    }
};

}  // namespace detail

/// RANSAC: the plane with the most inliers. Models `estimator`. Needs three neighbors. O(trials k).
///
/// Parameters: `sigma`, the standard deviation of inliers across the plane [m]; the number of
/// `trials` and their `seed`; `min_aspect_ratio`, sigma_ar of the inliers below which the normal is
/// weak.
///
/// Trust: that of PlanePCA on the inliers of the best plane.
using ransac_plane = detail::sample_consensus<detail::count_outliers>;

/// MLESAC: the plane of maximum likelihood; otherwise as `ransac_plane`. Its parameter `cost` is
/// the mixture of inliers and outliers: `mlesac_plane{.cost = {.reach = 40.0}}`.
using mlesac_plane = detail::sample_consensus<detail::mixture_likelihood>;

}  // namespace gnomon
