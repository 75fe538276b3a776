// SPDX-License-Identifier: BSL-1.0
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <Eigen/SVD>
#include <gtest/gtest.h>

#include <gnomon/core/detail/small_svd.hpp>
#include <gnomon/core/random.hpp>

namespace {

using matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

/// A random matrix whose columns differ in size by up to six orders of magnitude.
template <std::size_t N>
matrix random_rows(std::uint64_t seed, Eigen::Index rows) {
    gnomon::random_stream random(seed);
    matrix m(rows, static_cast<Eigen::Index>(N));
    for (Eigen::Index j = 0; j < m.cols(); ++j) {
        const double size = std::pow(10.0, -6.0 * random.uniform());
        for (Eigen::Index i = 0; i < rows; ++i) m(i, j) = size * random.gaussian();
    }
    return m.template cast<double>().template cast<long double>();
}

template <std::size_t N>
gnomon::detail::square_array<N> triangle_of(const matrix& m) {
    gnomon::detail::row_triangle<N> triangle;
    for (Eigen::Index i = 0; i < m.rows(); ++i) {
        std::array<double, N> row;
        for (std::size_t j = 0; j < N; ++j)
            row[j] = static_cast<double>(m(i, static_cast<Eigen::Index>(j)));
        triangle.add(row);
    }
    return triangle.matrix();
}

template <std::size_t N>
matrix wide(const gnomon::detail::square_array<N>& a) {
    matrix m(static_cast<Eigen::Index>(N), static_cast<Eigen::Index>(N));
    for (std::size_t i = 0; i < N; ++i) {
        for (std::size_t j = 0; j < N; ++j)
            m(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = a[i][j];
    }
    return m;
}

/// Compares with a dense SVD in long double: singular values agree to rounding, the last singular
/// vector to rounding divided by the gap of singular values (not of their squares).
template <std::size_t N>
void expect_agrees_with_a_dense_svd() {
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        SCOPED_TRACE(seed);
        const matrix m = random_rows<N>(seed, static_cast<Eigen::Index>(N + seed % 30));
        const auto triangle = triangle_of<N>(m);
        for (std::size_t i = 0; i < N; ++i) {
            for (std::size_t j = 0; j < i; ++j) ASSERT_EQ(triangle[i][j], 0.0);
        }
        const auto svd = gnomon::detail::small_svd<N>(triangle);
        const Eigen::JacobiSVD<matrix> oracle(m, Eigen::ComputeFullV);
        const auto& s = oracle.singularValues();
        for (std::size_t j = 0; j < N; ++j) {
            const auto column = static_cast<Eigen::Index>(j);
            ASSERT_NEAR(svd.values[j], static_cast<double>(s[column]),
                        1e-14 * static_cast<double>(s[0]));
        }
        // A = U S V^T, with orthonormal V and orthogonal U S.
        const matrix v = wide<N>(svd.right);
        const matrix us = wide<N>(svd.scaled_left);
        ASSERT_LT((v.transpose() * v - matrix::Identity(v.rows(), v.cols())).norm(), 1e-13L);
        ASSERT_LT((us * v.transpose() - wide<N>(triangle)).norm(), 1e-14L * s[0]);
        const auto last = static_cast<Eigen::Index>(N) - 1;
        const long double sine =
            (v.col(last) - v.col(last).dot(oracle.matrixV().col(last)) * oracle.matrixV().col(last))
                .norm();
        ASSERT_LT(sine, 1e-14L * s[0] / (s[last - 1] - s[last]) + 1e-14L);
    }
}

TEST(small_svd, agrees_with_a_dense_svd) {
    expect_agrees_with_a_dense_svd<3>();
    expect_agrees_with_a_dense_svd<6>();
    expect_agrees_with_a_dense_svd<10>();
}

TEST(small_svd, of_rank_deficient_matrices) {
    gnomon::detail::row_triangle<4> triangle;
    for (int i = 0; i < 5; ++i) triangle.add({1.0 * i, 2.0 * i, 0.0, 1.0});
    const auto svd = gnomon::detail::small_svd<4>(triangle.matrix());
    EXPECT_GT(svd.values[1], 0.1);
    EXPECT_LT(svd.values[2], 1e-14);
    EXPECT_LT(svd.values[3], 1e-14);
    gnomon::detail::row_triangle<4> tiny;  // whose squares are zero
    tiny.add({1e-200, 1.0, 0.0, 0.0});
    for (const auto& row : tiny.matrix()) {
        for (const double entry : row) EXPECT_TRUE(std::isfinite(entry));
    }
    const auto zero = gnomon::detail::small_svd<4>({});
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(zero.values[i], 0.0);
        EXPECT_EQ(zero.right[i][i], 1.0);
    }
}

}  // namespace
