// SPDX-License-Identifier: BSL-1.0
/// @file
/// The normal equations of a small rigid motion of points on a surface: their robust sums, the
/// directions that they determine, and the covariance of the solution. Parameters are a turn about
/// the three axes, in units in which it moves the points by 1 m on average, and a shift [m].
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/jacobi_eigen.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/square_array.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/features/alignment.hpp>
#include <gnomon/features/detail/normal_equations.hpp>
#include <gnomon/features/detail/surface_matches.hpp>

namespace gnomon::detail {

/// Turns about three axes, then shifts along them.
using motion_vector = std::array<double, 6>;

/// Whether parameter i may not change.
[[nodiscard]] constexpr bool is_fixed(std::size_t i, bool on_ground) {
    return on_ground && (i < 2 || i == 5);
}

/// The residual of one point, in deviations of its noise, and its derivatives.
struct motion_term {
    bool is_matched = false;
    std::size_t entry = 0;  ///< of the sample in the list of the point
    point_index sample = 0;
    double weight = 0.0;  ///< of Tukey's biweight
    double residual = 0.0;
    double distance = 0.0;      ///< from the surface [m]
    double own_share = 0.0;     ///< of the variance of the residual: that of the point
    double sample_share = 0.0;  ///< that of the sample; the sum is below 1 at oblique incidence
    double per_metre = 0.0;     ///< 1 / deviation
    Eigen::Vector3d arm;        ///< from the centroid, over the lever
    motion_vector row{};

    /// @param from_center  of the point [m]
    void set(const surface_match& m, const Eigen::Vector3d& from_center, double lever,
             double rounding, const alignment_options& options) {
        const double variance = m.variance + rounding * rounding;
        per_metre = 1.0 / std::sqrt(variance);
        entry = m.entry;
        sample = m.sample;
        distance = m.distance;
        residual = distance * per_metre;
        sample_share = m.of_sample / variance;
        own_share = (m.of_point + rounding * rounding) / variance;
        arm = scaled(1.0 / lever, from_center);
        const Eigen::Vector3d turn = cross(arm, m.normal);
        for (std::size_t a = 0; a < 3; ++a) {
            const auto i = static_cast<int>(a);
            row[a] = is_fixed(a, options.on_ground) ? 0.0 : per_metre * turn[i];
            row[3 + a] = is_fixed(3 + a, options.on_ground) ? 0.0 : per_metre * m.normal[i];
        }
    }
};

/// Sums over points: J^T W J, J^T W r, and what J^T W J would be with normals in all directions.
struct motion_sums {
    normal_equations<6> equations;
    square_array<6> of_all_normals{};

    /// Adds a point with the weight of Tukey's biweight (Holland and Welsch 1977: 95 % efficiency).
    /// @param scale  of the residuals, in deviations of the noise
    /// @param width  of the weights, at least [m]
    void add(motion_term& t, double scale, double width) {
        constexpr double deviations = 4.685;  // formula: that of this efficiency
        const double u = t.residual / std::max(deviations * scale, width * t.per_metre);
        const double left = std::max(0.0, 1.0 - u * u);
        t.weight = left * left;
        if (t.weight == 0.0) return;
        motion_vector row = t.row;
        for (double& x : row) x *= left;
        equations.add(row, left * t.residual);
        const double w = t.weight * t.per_metre * t.per_metre;
        const double squared = dot(t.arm, t.arm);
        for (std::size_t i = 0; i < 3; ++i) {
            of_all_normals[3 + i][3 + i] += w;
            for (std::size_t j = 0; j < 3; ++j) {
                const double arms = t.arm[static_cast<int>(i)] * t.arm[static_cast<int>(j)];
                of_all_normals[i][j] += w * ((i == j ? squared : 0.0) - arms);
            }
            // (a x e_k)_i for the two other axes.
            const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
            of_all_normals[i][3 + k] += w * t.arm[static_cast<int>(j)];
            of_all_normals[i][3 + j] -= w * t.arm[static_cast<int>(k)];
        }
    }

    void add(const motion_sums& other) {
        equations.add(other.equations);
        for (std::size_t i = 0; i < 6; ++i)
            for (std::size_t j = 0; j < 6; ++j) of_all_normals[i][j] += other.of_all_normals[i][j];
    }
};

/// What noise contributes to the covariance of J^T W r: that of points, which is independent, and
/// that of samples, which all points have in common that correspond to the sample.
[[nodiscard]] inline square_array<6> noise_of_terms(std::span<const motion_term> terms,
                                                    std::size_t samples) {
    square_array<6> sum{};
    const auto add = [&](double weight, const motion_vector& row) {
        for (std::size_t i = 0; i < 6; ++i)
            for (std::size_t j = 0; j < 6; ++j) sum[i][j] += weight * row[i] * row[j];
    };
    bool is_exact = true;
    for (const motion_term& t : terms) {
        if (!(t.weight > 0.0)) continue;
        add(t.weight * t.own_share, t.row);
        is_exact = is_exact && t.sample_share == 0.0;
    }
    if (is_exact) return sum;
    scratch<motion_vector> of_sample(samples, motion_vector{});
    for (const motion_term& t : terms) {
        if (!(t.weight > 0.0)) continue;
        const double w = std::sqrt(t.weight * t.sample_share);
        for (std::size_t i = 0; i < 6; ++i) of_sample[t.sample][i] += w * t.row[i];
    }
    for (const motion_vector& row : of_sample) add(1.0, row);
    return sum;
}

/// A step of the motion.
struct motion_step {
    Eigen::Vector3d turn{0.0, 0.0, 0.0}, shift{0.0, 0.0, 0.0};
    double gain = 0.0;  ///< by which the sum of squares is to decrease
};

/// The solution of the normal equations, along the directions that they determine: the eigenvectors
/// of J^T W J.
class motion_solution {
  public:
    /// @param scale  of the residuals, in deviations of the noise
    motion_solution(const motion_sums& sums, double scale, const alignment_options& options)
        : right_(sums.equations.right), on_ground_(options.on_ground) {
        square_array<6> left = sums.equations.left;
        for (std::size_t i = 0; i < 6; ++i)
            for (std::size_t j = i + 1; j < 6; ++j) left[i][j] = left[j][i];
        eigen_ = jacobi_eigen<6>(left);
        constexpr double variation = 1e-9;   // numerical: of normals, 3e-5 rad squared
        constexpr double fluctuation = 4.0;  // chosen: of that of normals with noise, squared
        const double sine = sin(options.normal_noise);
        const double of_noise = fluctuation * sine * sine;
        for (std::size_t k = 0; k < 6; ++k) {
            double with_all = 0.0;
            for (std::size_t i = 0; i < 6; ++i)
                for (std::size_t j = 0; j < 6; ++j)
                    with_all += eigen_.vectors[i][k] * eigen_.vectors[j][k] *
                                (sums.of_all_normals[std::min(i, j)][std::max(i, j)]);
            const double value = eigen_.values[k];
            const double deviation = scale / std::sqrt(std::max(value, 1e-300));
            is_determined_[k] = value > variation * eigen_.values[0] &&
                                value > of_noise * with_all && deviation < options.last_distance;
        }
    }

    /// The number of directions that are determined.
    [[nodiscard]] std::size_t determined() const {
        return static_cast<std::size_t>(
            std::count(is_determined_.begin(), is_determined_.end(), true));
    }

    /// The step to the minimum, at most `longest` [m].
    [[nodiscard]] motion_step step(double longest) const {
        motion_vector x{};
        motion_step s;
        for (std::size_t k = 0; k < 6; ++k) {
            if (!is_determined_[k]) continue;
            double along = 0.0;
            for (std::size_t i = 0; i < 6; ++i) along -= eigen_.vectors[i][k] * right_[i];
            s.gain += along * along / eigen_.values[k];
            for (std::size_t i = 0; i < 6; ++i)
                x[i] += eigen_.vectors[i][k] * along / eigen_.values[k];
        }
        double squared = 0.0;
        for (const double a : x) squared += a * a;
        const double shorten = std::min(1.0, longest / std::max(std::sqrt(squared), 1e-300));
        s.turn = scaled(shorten, {x[0], x[1], x[2]});
        s.shift = scaled(shorten, {x[3], x[4], x[5]});
        return s;
    }

    /// The covariance of the solution.
    /// @param noise  covariance of J^T W r
    /// @param shown  the variance of the residuals, in that of the noise
    [[nodiscard]] square_array<6> covariance(const square_array<6>& noise, double shown) const {
        // Tukey's biweight on normal residuals: E w psi'^-2 psi^2 of its moments, formula.
        constexpr double of_weights = 0.963;  // formula: a ratio of moments, without unit
        square_array<6> c{};
        for (std::size_t k = 0; k < 6; ++k) {
            for (std::size_t l = 0; l < 6; ++l) {
                double between = 0.0;
                if (is_determined_[k] && is_determined_[l]) {
                    for (std::size_t i = 0; i < 6; ++i)
                        for (std::size_t j = 0; j < 6; ++j)
                            between += eigen_.vectors[i][k] * noise[i][j] * eigen_.vectors[j][l];
                    between *= of_weights * shown / (eigen_.values[k] * eigen_.values[l]);
                } else if (k == l && is_free(k)) {
                    between = alignment::unknown_deviation * alignment::unknown_deviation;
                }
                for (std::size_t i = 0; i < 6; ++i)
                    for (std::size_t j = 0; j < 6; ++j)
                        c[i][j] += eigen_.vectors[i][k] * between * eigen_.vectors[j][l];
            }
        }
        return c;
    }

  private:
    /// Whether eigenvector k is no fixed axis. Rotations leave axes without entries alone.
    [[nodiscard]] bool is_free(std::size_t k) const {
        for (std::size_t i = 0; i < 6; ++i)
            if (is_fixed(i, on_ground_) && eigen_.vectors[i][k] != 0.0) return false;
        return true;
    }

    motion_vector right_;
    bool on_ground_;
    small_eigen_decomposition<6> eigen_;
    std::array<bool, 6> is_determined_{};
};

}  // namespace gnomon::detail
