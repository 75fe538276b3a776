// SPDX-License-Identifier: BSL-1.0
/// @file
/// Solid harmonics r^l Y_lm, for all degrees l below a bandwidth and all orders m >= 0, by the
/// recursion of the fully normalized associated Legendre functions. Y_lm is orthonormal on the unit
/// sphere and has the Condon-Shortley phase; Y_l,-m is (-1)^m times the conjugate of Y_lm.
#pragma once

#include <cstddef>
#include <numbers>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>

namespace gnomon::detail {

/// The functions, with the coefficients of the recursion.
class solid_harmonics {
  public:
    explicit solid_harmonics(std::size_t bandwidth) : bandwidth_(bandwidth) {
        for (std::size_t m = 0; m < bandwidth; ++m) {
            const auto order = static_cast<double>(m);
            terms_.push_back({m > 0 ? -std::sqrt(1.0 + 0.5 / order) : 1.0, 0.0});
            for (std::size_t l = m + 1; l < bandwidth; ++l)
                terms_.push_back(recursion(static_cast<double>(l), order));
        }
    }

    /// The number of functions: those of m >= 0.
    [[nodiscard]] std::size_t size() const { return terms_.size(); }

    /// Calls visit(l, m, real part, imaginary part) for each function at v, order by order.
    void at(const Eigen::Vector3d& v, auto&& visit) const {
        const double x = v[0], y = v[1], z = v[2], r2 = x * x + y * y + z * z;
        const term* next = terms_.data();
        double re = 0.5 * std::numbers::inv_sqrtpi, im = 0.0;  // of Y_mm r^m; Y_00 = (4 pi)^(-1/2)
        for (std::size_t m = 0; m < bandwidth_; ++m) {
            if (m > 0) {
                const double turned = next->a * (re * x - im * y);
                im = next->a * (re * y + im * x);
                re = turned;
            }
            ++next;
            double before = 0.0, factor = 1.0;  // of degrees l - 1 and l, without (re, im)
            visit(m, m, re, im);
            for (std::size_t l = m + 1; l < bandwidth_; ++l, ++next) {
                const double degree_l = next->a * z * factor - next->b * r2 * before;
                before = factor;
                factor = degree_l;
                visit(l, m, factor * re, factor * im);
            }
        }
    }

  private:
    struct term {
        double a, b;
    };

    [[nodiscard]] static term recursion(double l, double m) {
        const double a = std::sqrt((2.0 * l + 1.0) * (2.0 * l - 1.0) / ((l + m) * (l - m)));
        const double b = (l - 1.0 + m) * (l - 1.0 - m) / ((2.0 * l - 3.0) * (2.0 * l - 1.0));
        return {a, a * std::sqrt(b)};
    }

    std::size_t bandwidth_;
    scratch<term> terms_;  // in the order of visits
};

}  // namespace gnomon::detail
