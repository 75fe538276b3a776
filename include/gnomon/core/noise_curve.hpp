// SPDX-License-Identifier: BSL-1.0
/// @file
/// The noise of a sensor as a plain value, which every `range_noise` converts to, and every option
/// that requires the noise holds:
///
///     plane_ekf{.noise = constant_noise{0.005}}
///     plane_ekf{.noise = {noises::structured_light(), optical_axis}}
///     plane_ekf{.noise = [](double range) { return 0.002 + 0.001 * range; }}
///
/// The variance is a polynomial of the range of degree 4, exact for constant and quadratic
/// standard deviations and for sums of independent sources, or a table for any other model.
/// Quantization is a lower bound: readings in steps err by step / sqrt(12) at least.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/range_noise.hpp>

namespace gnomon {

/// Models `range_noise`. Noise is a function of the range of a point, or of its depth along an
/// optical axis.
class noise_curve {
  public:
    /// Coefficients of 1, x, x^2, x^3, x^4.
    using quartic = std::array<double, 5>;

    /// The curve of a model: exact for `constant_noise` and `quadratic_noise`; any other is read at
    /// 64 ranges from 5 cm to 500 m, between which the error is below 0.3 % for a sum of powers,
    /// and constant outside of them.
    /// @throws std::invalid_argument  if a standard deviation is negative, NaN or above 1e153 m
    template <range_noise N>
        requires(!std::same_as<N, noise_curve>)
    explicit(false) constexpr noise_curve(const N& noise) {
        set_model(noise);
    }

    /// The curve of a camera, for which `noise` is the standard deviation of the depth as a
    /// function of the depth.
    /// @param axis  the optical axis, of any length but 0
    /// @throws std::invalid_argument  also if the axis has no length or is not finite
    template <range_noise N>
    noise_curve(const N& noise, const Eigen::Vector3d& axis) {
        set_model(noise);
        set_axis(axis);
    }

    /// The curve of the variance `variance(x)`, where readings come in steps of the variance
    /// step(x)^2 / 12 = `quantization(x)` [m^2].
    /// @param axis  0 for functions of the range; else they are functions of the depth along it
    /// @throws std::invalid_argument  if a variance is negative, NaN or above 1e306 m^2, or the
    ///                                axis is not finite
    explicit noise_curve(const quartic& variance, const quartic& quantization = {},
                         const Eigen::Vector3d& axis = {0.0, 0.0, 0.0})
        : variance_(variance), quantization_(quantization) {
        if (detail::dot(axis, axis) != 0.0) set_axis(axis);
        for (std::size_t i = 0; i < knots; ++i) {
            require_deviation(std::sqrt(value(variance, knot(i))));
            require_deviation(std::sqrt(value(quantization, knot(i))));
            is_zero_ = is_zero_ && (*this)(knot(i)) == 0.0;
        }
    }

    /// The standard deviation [m] at the range, or depth, x [m].
    [[nodiscard]] double operator()(double x) const { return std::sqrt(variance(x)); }

    /// The standard deviation [m], along the ray, of a point at the offset `ray` [m] from its view
    /// point. An error of the depth is one of the range times 1 / cos(ray, axis); rays more than 80
    /// degrees from the axis count as at 80 degrees.
    [[nodiscard]] double along(const Eigen::Vector3d& ray) const {
        return std::sqrt(variance_along(ray));
    }
    /// The square of along() [m^2].
    [[nodiscard]] double variance_along(const Eigen::Vector3d& ray) const {
        const double range = detail::length(ray);
        if (!is_of_depth()) return variance(range);
        constexpr double least_cosine = 0.17;  // of 80 degrees
        const double cosine =
            range > 0.0 ? std::max(std::abs(detail::dot(ray, axis())) / range, least_cosine) : 1.0;
        return variance(range * cosine) / (cosine * cosine);
    }

    /// The curve of this noise and an independent error of the same deviation [m] everywhere.
    [[nodiscard]] noise_curve plus(double sigma) const {
        require_deviation(sigma);
        noise_curve sum = *this;
        sum.is_zero_ = is_zero_ && sigma == 0.0;
        sum.added_ += sigma * sigma;
        return sum;
    }

    /// Whether there is no noise at any range from 5 cm to 500 m.
    [[nodiscard]] bool is_zero() const { return is_zero_; }
    /// Whether x is the depth along axis(), not the range.
    [[nodiscard]] bool is_of_depth() const { return is_of_depth_; }
    /// The optical axis, of length 1; 0 where x is the range.
    [[nodiscard]] Eigen::Vector3d axis() const { return {axis_[0], axis_[1], axis_[2]}; }
    /// The step of readings at x [m]; 0 where they are not quantized.
    [[nodiscard]] double step(double x) const {
        return std::sqrt(12.0 * std::max(0.0, value(quantization_, x)));
    }

  private:
    static constexpr std::size_t knots = 64;
    static constexpr double nearest = 0.05, farthest = 500.0;  // [m]
    static constexpr double most = 1e153;  // [m]: the square is finite, also times 1 / cos^2

    [[nodiscard]] double variance(double x) const {
        if (is_table_) return from_table(x) + added_;
        const double own = std::max(value(variance_, x), value(quantization_, x));
        return std::min(own, most * most) + added_;
    }

    [[nodiscard]] static double value(const quartic& c, double x) {
        return c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * c[4])));
    }

    [[nodiscard]] static double knot(std::size_t i) {
        return nearest * std::pow(farthest / nearest,
                                  static_cast<double>(i) / static_cast<double>(knots - 1));
    }

    void set_axis(const Eigen::Vector3d& axis) {
        detail::require(detail::has_length(axis) && detail::all_finite(axis),
                        "noise_curve: the optical axis must be finite and have a length");
        const Eigen::Vector3d unit = detail::direction_of(axis);
        axis_ = {unit[0], unit[1], unit[2]};
        is_of_depth_ = true;
    }

    template <class N>
    constexpr void set_model(const N& noise) {
        if constexpr (std::same_as<N, constant_noise>) {
            require_deviation(noise.sigma);
            variance_[0] = noise.sigma * noise.sigma;
            is_zero_ = noise.sigma == 0.0;
        } else if constexpr (std::same_as<N, quadratic_noise>) {
            for (std::size_t i = 0; i < knots; ++i) require_deviation(noise(knot(i)));
            const auto [a, b, c] = noise;
            variance_ = {a * a, 2.0 * a * b, b * b + 2.0 * a * c, 2.0 * b * c, c * c};
            is_zero_ = a == 0.0 && b == 0.0 && c == 0.0;
        } else {
            is_table_ = true;
            for (std::size_t i = 0; i < knots; ++i) {
                const double sigma = noise(knot(i));
                require_deviation(sigma);
                is_zero_ = is_zero_ && sigma == 0.0;
                // Logarithms, so that powers of the range are straight lines; 1e-150 stands for 0.
                log_sigma_[i] = static_cast<float>(std::log(std::max(sigma, 1e-150)));
            }
        }
    }

    static constexpr void require_deviation(double sigma) {
        detail::require(sigma >= 0.0 && sigma <= most,
                        "noise: a standard deviation must be from 0 to 1e153 m");
    }

    /// A variance [m^2].
    [[nodiscard]] double from_table(double x) const {
        constexpr double log_of_span = 9.210340371976184;  // of 500 m / 5 cm
        constexpr double per_knot = static_cast<double>(knots - 1) / log_of_span;
        const double at =
            x > nearest ? std::min(std::log(x / nearest) * per_knot, static_cast<double>(knots - 1))
                        : 0.0;
        const auto i = std::min(static_cast<std::size_t>(at), knots - 2);
        const double t = at - static_cast<double>(i);
        const double sigma = std::exp((1.0 - t) * static_cast<double>(log_sigma_[i]) +
                                      t * static_cast<double>(log_sigma_[i + 1]));
        return sigma > 2e-150 ? sigma * sigma : 0.0;
    }

    bool is_table_ = false;
    bool is_zero_ = true;
    bool is_of_depth_ = false;
    quartic variance_{};            // [m^2], of x [m]
    quartic quantization_{};        // [m^2], of x [m]
    double added_ = 0.0;            // [m^2]
    std::array<double, 3> axis_{};  // of length 1; a literal type, so that curves are constants
    std::array<float, knots> log_sigma_{};
};

}  // namespace gnomon
