// SPDX-License-Identifier: BSL-1.0
/// @file
/// The variance of a range as a function A + B x^2 + C x^4 of the range, from the variances of the
/// residuals of many local planes, of which some are not planes. The three terms are a constant
/// error, one in proportion to the range, and one of triangulation; variances of independent
/// sources add up. (Functions take `auto` so that only code that measures noise compiles them.)
#pragma once

#include <algorithm>
#include <cstddef>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/normals/detail/quantile.hpp>

namespace gnomon::detail {

/// A + B x^2 + C x^4 [m^2].
struct even_quartic {
    double a = 0.0, b = 0.0, c = 0.0;

    [[nodiscard]] double operator()(double x) const { return a + x * x * (b + x * x * c); }
    [[nodiscard]] even_quartic operator+(const even_quartic& other) const {
        return {a + other.a, b + other.b, c + other.c};
    }
    [[nodiscard]] noise_curve::quartic coefficients() const { return {a, 0.0, b, 0.0, c}; }
};

/// Regression of values y on x by an even quartic whose coefficients are not negative. O(1) a
/// value.
class even_regression {
  public:
    /// @param unit  a typical x [m]
    explicit even_regression(double unit) : unit2_(unit * unit) {}

    void add(double x, double y, double weight) {
        const double s = x * x / unit2_;
        const Eigen::Vector3d row(1.0, s, s * s);
        add_outer(matrix_, weight, row, row);
        right_ = combined(1.0, right_, weight * y, row);
    }

    /// The least squares solution among those without a negative coefficient: the best of those
    /// with some of the coefficients 0.
    [[nodiscard]] even_quartic solve() const {
        Eigen::Vector3d best(0.0, 0.0, 0.0);
        double most_explained = 0.0;
        for (unsigned kept = 1; kept < 8; ++kept) {
            Eigen::Matrix3d m = matrix_;
            Eigen::Vector3d right = right_;
            for (int i = 0; i < 3; ++i) {
                if ((kept >> i & 1U) != 0) continue;
                for (int j = 0; j < 3; ++j) m(i, j) = m(j, i) = i == j ? 1.0 : 0.0;
                right[i] = 0.0;
            }
            const Eigen::Vector3d x = product(inverse_of_symmetric(m), right);
            const double explained = dot(x, right);
            if (!all_finite(x) || x[0] < 0.0 || x[1] < 0.0 || x[2] < 0.0) continue;
            if (explained <= most_explained) continue;
            best = x;
            most_explained = explained;
        }
        return {best[0], best[1] / unit2_, best[2] / (unit2_ * unit2_)};
    }

  private:
    double unit2_;
    Eigen::Matrix3d matrix_ = diagonal(0.0, 0.0, 0.0);
    Eigen::Vector3d right_{0.0, 0.0, 0.0};
};

/// A value at the range, or depth, x [m]: the variance of the residuals of a plane fit to 17 points
/// [m^2], or the step between two readings [m].
struct value_at {
    double x, value;
};

/// Calls visit(x, y) for each of up to 20 bins of values in the order of x: the x in the middle of
/// a bin, and a quantile of its values.
/// @param fewest  values to a bin, unless there is only one
inline void for_each_bin(const auto& values, std::size_t fewest, double part, auto&& visit) {
    constexpr std::size_t most_bins = 20;  // chosen on furnished rooms 20,001 to 20,006
    const std::size_t n = values.size();
    const std::size_t bins = std::clamp<std::size_t>(n / fewest, 1, most_bins);
    scratch<double> of_bin;
    for (std::size_t b = 0; b < bins; ++b) {
        const std::size_t begin = b * n / bins, end = (b + 1) * n / bins;
        of_bin.clear();
        for (std::size_t i = begin; i < end; ++i) of_bin.push_back(values[i].value);
        visit(values[(begin + end) / 2].x, quantile(of_bin, part));
    }
}

/// The noise of planes, and how the residuals agree with it.
struct noise_fit {
    even_quartic variance;
    double inliers = 0.0;  // share of the residuals that are within the 5 and 90 % quantiles
    double low = 0.0;      // share of these that are below the 25 % quantile
};

/// Quantiles of chi^2 / f with f = 17 - 3 degrees of freedom, and the mean of the values between
/// those of 5 and 90 %: (F_16(f q90) - F_16(f q5)) / (F_14(f q90) - F_14(f q5)).
inline constexpr double chi2_of_5 = 6.5706 / 14.0, chi2_of_25 = 10.1653 / 14.0,
                        chi2_of_90 = 21.0641 / 14.0, mean_of_kept = 0.9466;

/// A start for `fit_noise`: in bins of the range, at least a quarter of the residuals are those of
/// planes. Sorts the residuals by range.
[[nodiscard]] even_quartic noise_of_lower_quartiles(auto& all, const even_quartic& least,
                                                    double unit) {
    constexpr std::size_t fewest = 150;  // for a quartile; chosen on rooms 20,001 to 20,006
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
    even_regression regression(unit);
    for_each_bin(all, fewest, 0.25, [&](double x, double quartile) {
        const double y = quartile / chi2_of_25;
        if (y > 0.0) regression.add(x, y - least(x), 1.0 / (y * y));
    });
    return least + regression.solve();
}

/// The noise of the planes among the residuals: a trimmed variance, as a fixed point. Residuals
/// below the 5 % and above the 90 % quantile of the model are left out, and the mean of the others
/// corrected for that. O(n log n). Precondition: there are residuals.
/// @param least  part of the noise that is known
[[nodiscard]] noise_fit fit_noise(auto all, const even_quartic& least) {
    scratch<double> xs;
    for (const value_at& s : all) xs.push_back(s.x);
    const double unit = quantile(xs, 0.5);
    noise_fit fit{noise_of_lower_quartiles(all, least, unit)};
    const double first = all.front().x, last = all.back().x;
    constexpr double converged = 1e-4;  // of the variance; performance only
    for (int i = 0; i < 50; ++i) {
        even_regression regression(unit);
        std::size_t inliers = 0, low = 0;
        for (const auto& [x, value] : all) {
            const double model = fit.variance(x);
            if (!(model > 0.0 && value >= chi2_of_5 * model && value <= chi2_of_90 * model))
                continue;
            regression.add(x, value / mean_of_kept - least(x), 1.0 / (model * model));
            ++inliers;
            low += value < chi2_of_25 * model;
        }
        const even_quartic previous = fit.variance;
        const auto n = static_cast<double>(inliers);
        fit = {least + regression.solve(), n / static_cast<double>(all.size()),
               inliers > 0 ? static_cast<double>(low) / n : 0.0};
        const auto moved = [&](double x) {
            return std::abs(fit.variance(x) - previous(x)) > converged * previous(x);
        };
        if (!moved(first) && !moved(unit) && !moved(last)) break;
    }
    return fit;
}

}  // namespace gnomon::detail
