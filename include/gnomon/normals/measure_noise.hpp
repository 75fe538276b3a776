// SPDX-License-Identifier: BSL-1.0
/// @file
/// The noise of a sensor, measured on a scan: the standard deviation along the rays as a function
/// of the range, or, of a camera, of the depth. No data sheet is needed.
///
///     const auto noise = gnomon::measure_noise(scan);
///     if (noise.curve) std::printf("%.4f m at 2 m\n", (*noise.curve)(2.0));
///     else std::printf("%s\n", noise.reason.data());
///
/// Planes are fit along the rays to the neighborhoods of some of the points; most neighborhoods of
/// most scans are planes. Their residuals are noise, if neighbors are not chosen by their noise:
/// they are those nearest to the segment of the ray, 4 standard deviations to either side, which is
/// found by iteration. A trimmed variance leaves edges and bends out, and one model A + B x^2 +
/// C x^4 of the variance joins all ranges, as at some of them there are few planes. Quantized
/// readings are noticed; their noise is at least step / sqrt(12).
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string_view>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/detail/noise_coordinate.hpp>
#include <gnomon/normals/detail/noise_fit.hpp>
#include <gnomon/normals/detail/quantization.hpp>
#include <gnomon/normals/detail/ray_cone.hpp>
#include <gnomon/normals/detail/residual_sampler.hpp>
#include <gnomon/normals/detail/several_depths.hpp>

namespace gnomon {

/// What `measure_noise` found.
struct measured_noise {
    std::optional<noise_curve> curve;  ///< none if it cannot be measured
    std::string_view reason = {};      ///< why there is none
};

namespace detail {

/// The planes that a noise is measured on: the more, the less its own noise.
inline constexpr std::size_t sampled_planes = 3000;

/// Measures the noise of an index.
template <execution X>
class noise_meter {
  public:
    noise_meter(const spatial_index& index, const X& run)
        : index_(index), run_(run), sample_(index) {}

    /// @param many   planes; the more, the less the noise of the result
    /// @param least  a noise that that of the points is not less than
    [[nodiscard]] measured_noise operator()(std::size_t many = sampled_planes,
                                            const noise_curve& least = constant_noise{0.0}) {
        constexpr std::size_t fewest_points = 500;
        if (index_.finite() < fewest_points) return {{}, "fewer than 500 points"};
        std::size_t few = 1000;  // performance only
        scratch<sampled_plane> planes = sample_(few, run_, half_length(least));
        if (are_parallel(planes)) return {{}, no_view_point};
        find_quantization(planes);
        if (is_quantized_) {  // few of the planes cross steps
            few = many;
            planes = sample_(few, run_, half_length(least));
        }
        if (!fit(planes)) return without_fit();
        // Longer segments find more of the noise, until they hold all of it.
        constexpr double converged = 0.005;  // of the standard deviation; performance only
        constexpr int most_passes = 8;
        for (int pass = 0; pass < most_passes; ++pass) {
            const double before = typical();
            planes = sample_(few, run_, half_length(curve()));
            if (!fit(planes)) return without_fit();
            if (std::abs(typical() - before) <= converged * before) break;
        }
        planes = sample_(many, run_, half_length(curve()));
        if (!fit(planes)) return without_fit();
        if (!is_quantized_) prefer_depth(planes);
        if (!is_of_planes()) return {{}, too_little_flat};
        return {curve(), {}};
    }

  private:
    static constexpr std::string_view too_little_flat = "too little of the scan is flat";
    static constexpr std::string_view no_view_point =
        "the view point is too far away from the points, or none was given (the origin)";

    /// The noise where too few planes are seen: at least that of quantization is known.
    [[nodiscard]] measured_noise without_fit() {
        if (!is_quantized_) return {{}, too_little_flat};
        fit_ = {quantized_};
        return {curve(), {}};
    }

    /// Determines whether the readings are quantized, and which coordinate.
    void find_quantization(std::span<const sampled_plane> planes) {
        const noise_coordinate depth{axis_of_exact_planes(planes)};
        for (const noise_coordinate& candidate : {depth, noise_coordinate{}}) {
            scratch<double> readings;
            constexpr std::size_t most = 20'000;
            const std::size_t step = 1 + index_.size() / most;
            for (std::size_t i = 0; i < index_.size(); i += step)
                if (index_.is_finite(i))
                    readings.push_back(candidate(difference(index_[i], index_.viewpoints[i])));
            const quantization found = quantization_of(readings);
            if (!found.found) continue;
            coordinate_ = candidate;
            quantized_ = found.variance;
            is_quantized_ = true;
            return;
        }
    }

    /// Fits the model to the planes; false if there are too few.
    [[nodiscard]] bool fit(std::span<const sampled_plane> planes) {
        constexpr std::size_t fewest = 100;  // planes: the result errs by 2 % then, 1 / sqrt(28 n)
        auto residuals = residuals_of(planes, coordinate_, quantized_, 2.0);
        if (residuals.size() < fewest)
            residuals = residuals_of(planes, coordinate_, quantized_, 0.0);
        if (residuals.size() < fewest) return false;
        fit_ = fit_noise(residuals, quantized_);
        median_ = residuals[residuals.size() / 2].x;
        return true;
    }

    /// A camera's noise goes with the depth: takes the depth for the range where that explains the
    /// residuals better.
    void prefer_depth(std::span<const sampled_plane> planes) {
        const noise_coordinate depth{axis_of_cone(planes)};
        if (dot(depth.axis, depth.axis) == 0.0) return;
        const noise_fit of_depth = fit_noise(residuals_of(planes, depth, {}, 0.0), {});
        double gain = 0.0;  // of the logarithm of the likelihood
        for (const sampled_plane& s : planes) {
            if (dot(s.normal, s.normal) == 0.0) continue;
            const double cosine = depth.cosine(s.ray);
            const double by_range = fit_.variance(length(s.ray));
            const double by_depth = of_depth.variance(depth(s.ray)) / (cosine * cosine);
            if (s.variance > chi2_of_90 * std::min(by_range, by_depth)) continue;
            gain += std::log(by_range / by_depth) + s.variance / by_range - s.variance / by_depth;
        }
        // A plane counts as its 14 degrees of freedom; the odds of the depth must be e^5 = 148.
        constexpr double half_of_freedom = 7.0, needed = 5.0;
        if (half_of_freedom * gain < needed) return;
        coordinate_ = depth;
        fit_ = of_depth;
    }

    /// Whether the residuals that the model was fit to are distributed as those of planes.
    [[nodiscard]] bool is_of_planes() const {
        // Chosen, with the noise of ten real scans in view: of a street and a registered office
        // with clutter, 17 and 13 % of the neighborhoods are planes of one noise.
        constexpr double fewest = 0.15;
        constexpr double expected = 0.2 / 0.85, tolerance = 0.12;  // chosen on the same scans
        constexpr double most = 0.1;  // of the range; chosen: more is no noise, but a cloud
        return fit_.inliers >= fewest && typical() <= most * median_ &&
               (is_quantized_ || std::abs(fit_.low - expected) <= tolerance);
    }

    /// The standard deviation at the median range [m].
    [[nodiscard]] double typical() const { return curve()(median_); }

    [[nodiscard]] noise_curve curve() const {
        noise_curve::quartic variance = fit_.variance.coefficients();
        constexpr double precision = 1e-6;  // no range is known better than by this part of it
        variance[2] += precision * precision;
        return noise_curve(variance, quantized_.coefficients(), coordinate_.axis);
    }

    [[nodiscard]] static auto half_length(const noise_curve& noise) {
        return [noise](const Eigen::Vector3d& ray) { return ray_deviations * noise.along(ray); };
    }

    const spatial_index& index_;
    const X& run_;
    residual_sampler<spatial_index> sample_;
    noise_coordinate coordinate_;
    bool is_quantized_ = false;
    even_quartic quantized_;  // variance [m^2]
    noise_fit fit_;
    double median_ = 0.0;  // [m]
};

/// Whether each ray has one depth, if there is one view point for all points.
[[nodiscard]] bool has_rays(const auto& index, const noise_curve& noise) {
    if (index.viewpoints.positions().size() > 1) return true;
    const sorted_directions directions(index, index.viewpoints[0]);
    constexpr double most = 0.3;  // chosen: in ten real scans there are 0 to 23 %
    return directions.share_of_several_depths([&](const Eigen::Vector3d& u, double range) {
        return noise.along(scaled(range, u));
    }) < most;
}

}  // namespace detail

/// The noise of the sensor of a scan.
///
/// @param points  any point range of n points [m] with its view points, or an index of it; points
///                that are not finite do not count
/// @return        no curve, and the reason, for fewer than 500 points, if too few neighborhoods
///                are planes, or if the view point is not one
/// @throws std::invalid_argument  if the view points are for another number of points
/// Complexity: O(n log n); some 20,000 neighborhoods. The same for every execution.
template <class R, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] measured_noise measure_noise(const R& points, const X& run = {},
                                           Proj projection = {}) {
    const auto& index = detail::index_of(points, run, projection);
    measured_noise found = detail::noise_meter(index, run)();
    if (found.curve && !detail::has_rays(index, *found.curve))
        return {{}, "the view point is not one: along one ray there are several depths"};
    return found;
}

}  // namespace gnomon
