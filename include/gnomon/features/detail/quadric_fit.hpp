// SPDX-License-Identifier: BSL-1.0
/// @file
/// Quadratics fitted to heights z over a plane, by sums of products in fixed arrays: as Eigen
/// expressions the compiler takes ten times as long to read them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace gnomon::detail {

/// z = a x^2 + b x y + c y^2 + e x + f y + constant.
struct quadric {
    double a = 0.0;
    double b = 0.0;
    double c = 0.0;
    double e = 0.0;
    double f = 0.0;
};

/// All six coefficients by least squares of z. Normal equations, so x and y should be of order one.
class least_squares_quadric {
  public:
    void add(double x, double y, double z) {
        const std::array<double, 6> row{1.0, x, y, x * x, x * y, y * y};
        for (std::size_t i = 0; i < 6; ++i) {
            right_[i] += row[i] * z;
            for (std::size_t j = 0; j <= i; ++j) left_[i][j] += row[i] * row[j];
        }
    }

    /// Solves by L D L^T, in place. Returns the least share of a column that the columns before it
    /// do not explain, D_j / A_jj, in [0, 1]; there is no solution if it is zero up to rounding.
    double solve() {
        double least = 1.0;
        for (std::size_t j = 0; j < 6; ++j) {
            const double all = left_[j][j];
            for (std::size_t k = 0; k < j; ++k) {
                left_[j][j] -= left_[j][k] * left_[j][k] * left_[k][k];
            }
            if (!(left_[j][j] > 0.0)) return 0.0;
            least = std::min(least, left_[j][j] / all);
            for (std::size_t i = j + 1; i < 6; ++i) {
                for (std::size_t k = 0; k < j; ++k) {
                    left_[i][j] -= left_[i][k] * left_[j][k] * left_[k][k];
                }
                left_[i][j] /= left_[j][j];
            }
        }
        for (std::size_t i = 0; i < 6; ++i) {
            for (std::size_t k = 0; k < i; ++k) right_[i] -= left_[i][k] * right_[k];
        }
        for (std::size_t i = 6; i-- > 0;) {
            right_[i] /= left_[i][i];
            for (std::size_t k = i + 1; k < 6; ++k) right_[i] -= left_[k][i] * right_[k];
        }
        return least;
    }

    /// The solution, for coordinates that were multiplied by sx and sy before they were added.
    [[nodiscard]] quadric solution(double sx, double sy) const {
        return {right_[3] * sx * sx, right_[4] * sx * sy, right_[5] * sy * sy, right_[1] * sx,
                right_[2] * sy};
    }

  private:
    std::array<std::array<double, 6>, 6> left_{};  // its lower half
    std::array<double, 6> right_{};
};

/// The unit vector [a' b' c' d'] for which the sum of squares of a' x^2 + b' x y + c' y^2 + d' z is
/// least, Eq. (3.25).
class homogeneous_quadric {
  public:
    void add(double x, double y, double z) {
        const std::array<double, 4> row{x * x, x * y, y * y, z};
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = 0; j < 4; ++j) products_[i][j] += row[i] * row[j];
        }
    }

    /// The quadric z = a x^2 + b x y + c y^2 with a = -a'/d' and so on; nothing if there is none,
    /// or more than one.
    [[nodiscard]] std::optional<quadric> solve() const {
        double trace = 0.0;
        for (std::size_t i = 0; i < 4; ++i) trace += products_[i][i];
        if (!(trace > 0.0) || !std::isfinite(trace)) return std::nullopt;
        matrix m = products_;
        for (auto& row : m) {
            for (double& element : row) element /= trace;
        }
        matrix v{};
        for (std::size_t i = 0; i < 4; ++i) v[i][i] = 1.0;
        diagonalise(m, v);

        std::array<std::size_t, 4> order{0, 1, 2, 3};
        std::sort(order.begin(), order.end(),
                  [&m](std::size_t i, std::size_t j) { return m[i][i] < m[j][j]; });
        const std::size_t last = order[0];
        constexpr double rounding = 1e-14;
        if (m[order[1]][order[1]] - m[last][last] <= rounding) return std::nullopt;
        const double d = v[3][last];
        if (std::abs(d) < 1e-12) return std::nullopt;
        return quadric{-v[0][last] / d, -v[1][last] / d, -v[2][last] / d, 0.0, 0.0};
    }

  private:
    using matrix = std::array<std::array<double, 4>, 4>;

    /// Cyclic Jacobi rotations, as in symmetric_eigen: columns of v become eigenvectors.
    static void diagonalise(matrix& m, matrix& v) {
        constexpr int max_sweeps = 16;
        for (int sweep = 0; sweep < max_sweeps; ++sweep) {
            bool done = true;
            for (std::size_t p = 0; p < 3; ++p) {
                for (std::size_t q = p + 1; q < 4; ++q) {
                    // Negligible beside both: keeps small eigenvalues of graded matrices.
                    if (std::abs(m[p][q]) <= 1e-18 * std::sqrt(std::abs(m[p][p] * m[q][q]))) {
                        continue;
                    }
                    done = false;
                    rotate_away(m, v, p, q);
                }
            }
            if (done) break;
        }
    }

    static void rotate_away(matrix& m, matrix& v, std::size_t p, std::size_t q) {
        const double theta = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
        const double t =
            std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(1.0 + theta * theta));
        const double c = 1.0 / std::sqrt(1.0 + t * t);
        const double s = t * c;
        const double pq = m[p][q];
        m[p][p] -= t * pq;
        m[q][q] += t * pq;
        m[p][q] = m[q][p] = 0.0;
        for (std::size_t r = 0; r < 4; ++r) {
            const double vp = v[r][p];
            const double vq = v[r][q];
            v[r][p] = c * vp - s * vq;
            v[r][q] = s * vp + c * vq;
            if (r == p || r == q) continue;
            const double rp = m[r][p];
            const double rq = m[r][q];
            m[r][p] = m[p][r] = c * rp - s * rq;
            m[r][q] = m[q][r] = s * rp + c * rq;
        }
    }

    matrix products_{};
};

}  // namespace gnomon::detail
