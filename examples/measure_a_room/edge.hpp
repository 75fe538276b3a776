// SPDX-License-Identifier: BSL-1.0
/// @file
/// The place of an edge of an opening with its standard deviation, from the rays next to it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "room.hpp"

/// A ray that crosses the plane of a wall near an edge.
struct edge_ray {
    double inwards = 0.0;  ///< of the first guess of the edge: into the opening [m]
    double depth = 0.0;    ///< of the measured point behind the wall [m]
    double sigma = 0.0;    ///< [m]
    double slope = 0.0;    ///< how much farther inwards the ray is, per depth
    /// The depth at which the ray leaves the opening across another edge [m].
    double way_out = std::numeric_limits<double>::infinity();
};

namespace detail {

[[nodiscard]] inline double normal_density(double x, double sigma) {
    const double z = x / sigma;
    return std::exp(-0.5 * z * z) / (sigma * std::sqrt(2.0 * std::numbers::pi));
}

/// Precondition: there are some.
[[nodiscard]] inline double median_of(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

/// The densities of depths on a surface, and behind an opening.
class depth_model {
  public:
    /// Fits what is behind: most of the rays on one surface (the leaf of a door), or at any depth.
    explicit depth_model(const std::vector<edge_ray>& rays) {
        constexpr double inside = 0.1;      // [m]; chosen: without most of the reveal
        constexpr std::size_t fewest = 10;  // rays; chosen
        std::vector<double> depths, variances;
        for (const edge_ray& r : rays) {
            if (r.inwards <= inside) continue;
            depths.push_back(r.depth);
            variances.push_back(r.sigma * r.sigma);
        }
        if (depths.size() < fewest) return;
        behind_ = median_of(depths);
        std::vector<double> deviations = depths;
        for (double& d : deviations) d = std::abs(d - behind_);
        constexpr double of_normal = 1.4826;  // standard deviation over median deviation
        const double width = of_normal * median_of(deviations);
        variance_ = std::max(0.0, width * width - median_of(variances));
        const auto near = [&](double d) { return std::abs(d - behind_) <= 3.0 * width; };
        share_ = std::min(1.0 - anywhere, static_cast<double>(std::ranges::count_if(depths, near)) /
                                              static_cast<double>(depths.size()));
    }

    /// On whatever is behind the opening.
    [[nodiscard]] double behind(const edge_ray& r) const {
        const double free = 0.5 * (1.0 + std::erf(r.depth / r.sigma / std::numbers::sqrt2));
        const double density = std::max(free, anywhere) / deepest;
        if (share_ == 0.0) return density;
        return (1.0 - share_) * density +
               share_ * normal_density(r.depth - behind_, std::sqrt(variance_ + r.sigma * r.sigma));
    }

    /// At a depth, such as that of the reveal where the ray meets it.
    [[nodiscard]] static double at(const edge_ray& r, double depth) {
        return (1.0 - anywhere) * normal_density(r.depth - depth, r.sigma) + anywhere / deepest;
    }

  private:
    static constexpr double anywhere = 0.01;  // share of rays with any depth; chosen
    static constexpr double deepest = 10.0;   // [m], of a uniform density; chosen

    double behind_ = 0.0;    // depth of the surface behind [m]
    double variance_ = 0.0;  // of the surface, in addition to noise [m^2]
    double share_ = 0.0;     // of the rays that hit it
};

/// The logarithm of the likelihood of an edge. The reveal at the edge has an unknown depth, all
/// from 0 to the deepest equally likely: the rays that meet its plane before that depth hit it,
/// nearly all of them, and the others pass.
class edge_likelihood {
  public:
    edge_likelihood(const std::vector<edge_ray>& near, const depth_model& model) {
        for (const edge_ray& r : near)
            rays_.push_back({r, std::log(depth_model::at(r, 0.0)), model.behind(r)});
    }

    [[nodiscard]] double operator()(double edge) const {
        // By steps of depth, the gains of the rays that hit the reveal in this step if it is
        // deeper, and if it ends in this step.
        std::array<double, depths> whole{}, half{};
        double sum = 0.0;
        for (const auto& [r, on_wall, behind] : rays_) {
            if (r.inwards <= edge) {
                sum += on_wall;
                continue;
            }
            sum += std::log(behind);
            if (r.slope >= 0.0) continue;
            const double depth = (r.inwards - edge) / -r.slope;
            if (depth >= std::min(step * depths, r.way_out)) continue;
            const double gain = depth_model::at(r, depth) / behind;
            const auto k = static_cast<std::size_t>(depth / step);
            whole[k] += std::log(hits * gain + 1.0 - hits);
            half[k] += std::log(0.5 * gain + 0.5);
        }
        double total = 0.0, most = -std::numeric_limits<double>::infinity(), likelihood = 0.0;
        for (std::size_t k = 0; k < depths; ++k) {
            half[k] += total;
            total += whole[k];
            most = std::max(most, half[k]);
        }
        for (const double gain : half) likelihood += std::exp(gain - most);
        return sum + most + std::log(likelihood / depths);
    }

  private:
    static constexpr std::size_t depths = 25;
    static constexpr double step = 0.02;  // [m]; chosen: walls up to 50 cm thick
    static constexpr double hits = 0.9;   // share of rays; chosen: handles, frames

    struct seen_ray {
        edge_ray ray;
        double on_wall, behind;
    };
    std::vector<seen_ray> rays_;
};

/// The farthest place at which an edge can be after the last ray on the wall before it, if hardly a
/// ray returns from the opening: the wall ends before the next ray would have hit it, which is at
/// most about the largest gap between rays on the wall away.
class gaps_on_wall {
  public:
    /// @param reach  the error of the guess is smaller [m]
    gaps_on_wall(const std::vector<edge_ray>& rays, double reach) {
        constexpr double least_returned = 0.25;  // of the number on the wall; chosen
        double on = 0.0, through = 0.0;
        for (const edge_ray& r : rays) {
            const bool is_on = std::abs(r.depth) <= 3.0 * r.sigma;
            if (is_on) on_.push_back(r.inwards);
            if (std::abs(r.inwards) < reach) (is_on ? on : through) += 1.0;
        }
        is_empty_ = through < least_returned * on;
        std::ranges::sort(on_);
        for (std::size_t i = 1; i < on_.size() && on_[i] < 0.0; ++i)
            largest_ = std::max(largest_, on_[i] - on_[i - 1]);
    }

    [[nodiscard]] bool allow(double edge) const {
        if (!is_empty_) return true;
        const auto next = std::ranges::lower_bound(on_, edge);
        return next != on_.begin() && edge - *std::prev(next) <= allowance * largest_;
    }
    [[nodiscard]] std::size_t rays() const { return on_.size(); }

  private:
    std::vector<double> on_;
    static constexpr double allowance = 1.5;  // chosen: gaps are wider where rays are oblique
    double largest_ = 0.0;
    bool is_empty_ = false;
};

/// Corrects depths by that of the wall next to the edge, and their standard deviations by the
/// dispersion there, as walls are not quite flat.
inline void level_out(std::vector<edge_ray>& rays, double window) {
    constexpr std::size_t fewest = 10;  // rays; chosen
    constexpr double margin = 0.03;     // [m]; chosen: before the guess of the edge
    std::vector<double> depths, scaled;
    for (const edge_ray& r : rays)
        if (r.inwards < -margin && r.inwards > -window &&
            std::abs(r.depth) < std::max(3.0 * r.sigma, unevenness))
            depths.push_back(r.depth);
    if (depths.size() < fewest) return;
    const double offset = median_of(depths);
    for (edge_ray& r : rays) {
        r.depth -= offset;
        if (r.inwards < -margin && r.inwards > -window &&
            std::abs(r.depth) < std::max(3.0 * r.sigma, unevenness))
            scaled.push_back(std::abs(r.depth) / r.sigma);
    }
    constexpr double of_normal = 1.4826;  // standard deviation over median deviation
    const double scale = scaled.empty() ? 1.0 : std::max(1.0, of_normal * median_of(scaled));
    for (edge_ray& r : rays) r.sigma *= scale;
}

}  // namespace detail

/// The edge of an opening relative to a first guess: mean and standard deviation of its posterior
/// distribution, where all places are equally likely before. If the rays leave no doubt on which
/// side of the edge they are, it is uniform between the last one on the wall and the first one
/// through; noise and a reveal that is hit near the edge make it wider or narrower.
/// @param reach      the error of the guess is smaller [m]
/// @param is_hidden  whether something in front of the opening hides places next to the edge
inline std::optional<measured_length> edge_near(const std::vector<edge_ray>& rays, double reach,
                                                bool is_hidden) {
    constexpr double step = 0.5e-3;     // [m]; numerical
    constexpr std::size_t fewest = 10;  // rays on the wall next to the edge; chosen
    constexpr double window = 0.3;      // [m]; chosen
    std::vector<edge_ray> near;
    for (const edge_ray& r : rays)
        if (r.depth > -3.0 * r.sigma && std::abs(r.inwards) < window) near.push_back(r);
    const detail::edge_likelihood likelihood(near, detail::depth_model(rays));
    const detail::gaps_on_wall gaps(near, reach);
    if (gaps.rays() < fewest) return std::nullopt;

    const auto places = static_cast<int>(reach / step);
    std::vector<double> logs;
    for (int k = -places; k <= places; ++k) {
        const double edge = step * k;
        const bool allowed = is_hidden || gaps.allow(edge);
        logs.push_back(allowed ? likelihood(edge) : -std::numeric_limits<double>::infinity());
    }
    const double most = *std::ranges::max_element(logs);
    if (!std::isfinite(most)) return std::nullopt;
    double weight = 0.0, first = 0.0, second = 0.0;
    for (int k = -places; k <= places; ++k) {
        const double p = std::exp(logs[static_cast<std::size_t>(k + places)] - most);
        weight += p;
        first += p * step * k;
        second += p * step * k * step * k;
    }
    const double mean = first / weight;
    const double variance = second / weight - mean * mean + step * step / 12.0;
    const double sigma = std::sqrt(std::max(variance, step * step / 12.0));
    if (std::abs(mean) + 2.0 * sigma > reach) return std::nullopt;  // the guess is not good enough
    return measured_length{mean, sigma};
}
