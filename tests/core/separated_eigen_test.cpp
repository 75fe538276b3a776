// SPDX-License-Identifier: BSL-1.0
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/detail/jacobi_eigen.hpp>
#include <gnomon/core/detail/pack.hpp>
#include <gnomon/core/detail/separated_eigen.hpp>
#include <gnomon/core/detail/symmetric_eigen.hpp>

namespace {

using gnomon::detail::eigen_decomposition;
using gnomon::detail::is_accurate, gnomon::detail::pack;

template <class T>
using symmetric = gnomon::detail::symmetric_3x3<T>;
template <class T>
using separated = gnomon::detail::separated_eigen<T>;

/// A matrix of trace one with eigenvalues in any ratio: isotropic, planar or linear.
Eigen::Matrix3d any_matrix(std::uint64_t seed) {
    gnomon::random_stream random(seed, 4);
    const Eigen::Vector3d values(1.0, std::pow(10.0, -4.0 * random.uniform()),
                                 std::pow(10.0, -12.0 * random.uniform()));
    const Eigen::Matrix3d r = seed % 10 == 0 ? Eigen::Matrix3d(Eigen::Matrix3d::Identity())
                                             : clouds::random_rotation(seed);
    const Eigen::Matrix3d a = r * (values / values.sum()).asDiagonal() * r.transpose();
    return 0.5 * (a + a.transpose());
}

symmetric<double> packed(const Eigen::Matrix3d& a) {
    return {a(0, 0), a(1, 1), a(2, 2), a(1, 0), a(2, 0), a(2, 1)};
}

/// Lane l of the decomposition of a pack.
struct lane_of {
    eigen_decomposition e;
    double squared_residual;

    lane_of(const separated<pack>& found, std::size_t l)
        : squared_residual(found.squared_residual[l]) {
        for (int i = 0; i < 3; ++i) {
            e.values[i] = found.values[i][l];
            e.vectors.col(i) << found.vectors[i].x[l], found.vectors[i].y[l], found.vectors[i].z[l];
        }
    }
};

/// Decomposes eight matrices at once: `a` in lane l, and `other` in the other lanes.
separated<pack> found_among(const Eigen::Matrix3d& a, std::size_t l, const Eigen::Matrix3d& other) {
    std::array<std::array<double, pack::size>, 6> all;
    for (std::size_t at = 0; at < pack::size; ++at) {
        const auto m = packed(at == l ? a : other);
        const double entries[] = {m.xx, m.yy, m.zz, m.xy, m.xz, m.yz};
        for (std::size_t e = 0; e < 6; ++e) all[e][at] = entries[e];
    }
    const auto of = [&](std::size_t e) { return pack(all[e].data()); };
    return separated<pack>(symmetric<pack>{of(0), of(1), of(2), of(3), of(4), of(5)});
}

eigen_decomposition found_alone(const separated<double>& found) {
    eigen_decomposition e;
    for (int i = 0; i < 3; ++i) {
        e.values[i] = found.values[i];
        e.vectors.col(i) << found.vectors[i].x, found.vectors[i].y, found.vectors[i].z;
    }
    return e;
}

/// Eigenvalues are accurate to rounding, eigenvectors to rounding divided by their gap.
void expect_decomposes(const Eigen::Matrix3d& a, const eigen_decomposition& e) {
    using matrix = Eigen::Matrix<long double, 3, 3>;
    const Eigen::SelfAdjointEigenSolver<matrix> truth(a.cast<long double>());
    ASSERT_LT((e.vectors.transpose() * e.vectors - Eigen::Matrix3d::Identity()).norm(), 2e-15);
    for (int i = 0; i < 3; ++i) {
        const auto value = [&](int j) { return double(truth.eigenvalues()[2 - j]); };
        ASSERT_NEAR(e.values[i], value(i), 1e-15) << a;
        double gap = 1.0;
        for (int j = 0; j < 3; ++j)
            if (j != i) gap = std::min(gap, std::abs(value(i) - value(j)));
        const Eigen::Vector3d v = truth.eigenvectors().col(2 - i).cast<double>();
        ASSERT_LT(e.vectors.col(i).cross(v).norm(), 1e-15 / gap + 1e-15) << a;
    }
}

/// A single matrix and a lane of a pack have the same accuracy.
TEST(separated_eigen, matches_long_double) {
    int alone_accepted = 0, in_pack_accepted = 0;
    for (std::uint64_t seed = 0; seed < 20'000; ++seed) {
        const Eigen::Matrix3d a = any_matrix(seed);
        const separated<double> alone(packed(a));
        if (is_accurate(alone.values[1], alone.values[2], alone.squared_residual)) {
            ++alone_accepted;
            expect_decomposes(a, found_alone(alone));
        }
        const std::size_t l = seed % pack::size;
        const lane_of in_pack(found_among(a, l, any_matrix(seed + 1)), l);
        if (is_accurate(in_pack.e.values[1], in_pack.e.values[2], in_pack.squared_residual)) {
            ++in_pack_accepted;
            expect_decomposes(a, in_pack.e);
        }
    }
    // A pack has fewer rounds and rejects very elongated neighborhoods, which take rotations.
    EXPECT_GT(alone_accepted, 12'000);
    EXPECT_GT(in_pack_accepted, 8000);
    EXPECT_LT(alone_accepted, 20'000);
}

/// The result of a lane does not depend on the other lanes, not even if they are NaN.
TEST(separated_eigen, of_a_lane_does_not_depend_on_the_others) {
    const Eigen::Matrix3d a = any_matrix(7);
    const lane_of expected(found_among(a, 0, a), 0);
    for (std::size_t l = 0; l < pack::size; ++l) {
        for (const Eigen::Matrix3d& other :
             {any_matrix(8), Eigen::Matrix3d(Eigen::Matrix3d::Zero()),
              Eigen::Matrix3d(Eigen::Matrix3d::Constant(clouds::nan)),
              Eigen::Matrix3d(Eigen::Matrix3d::Identity() / 3.0)}) {
            const lane_of found(found_among(a, l, other), l);
            EXPECT_EQ(found.e.values, expected.e.values);
            EXPECT_EQ(found.e.vectors, expected.e.vectors);
            EXPECT_EQ(found.squared_residual, expected.squared_residual);
        }
    }
}

/// Matrices whose smallest eigenvalue is not well separated, and matrices that are no second
/// moments.
TEST(separated_eigen, is_refused_where_rotations_are_needed) {
    const double infinity = std::numeric_limits<double>::infinity();
    Eigen::Matrix3d with_nan = any_matrix(1), with_infinity = any_matrix(2);
    with_nan(2, 1) = with_nan(1, 2) = clouds::nan;
    with_infinity(0, 0) = infinity;
    const auto diagonal = [](double x, double y, double z) -> Eigen::Matrix3d {
        return Eigen::Vector3d(x, y, z).asDiagonal();
    };
    for (const Eigen::Matrix3d& a :
         {diagonal(1, 0, 0), diagonal(0.5, 0.25, 0.25), diagonal(1.0 / 3, 1.0 / 3, 1.0 / 3),
          diagonal(0, 0, 0), diagonal(1 - 1e-5, 1e-5, 0), with_nan, with_infinity,
          Eigen::Matrix3d(Eigen::Matrix3d::Constant(1.0 / 3))}) {
        const separated<double> alone(packed(a));
        EXPECT_FALSE(is_accurate(alone.values[1], alone.values[2], alone.squared_residual)) << a;
        const lane_of in_pack(found_among(a, 3, a), 3);
        EXPECT_FALSE(
            is_accurate(in_pack.e.values[1], in_pack.e.values[2], in_pack.squared_residual))
            << a;
    }
    EXPECT_FALSE(is_accurate(0.3, 0.1, 1e-29));
    EXPECT_FALSE(is_accurate(clouds::nan, 0.1, 0.0));
    EXPECT_FALSE(is_accurate(0.3, 0.1, clouds::nan));
    for (const double trace : {0.0, -1.0, 1e-300, 1e300, infinity, clouds::nan})
        EXPECT_FALSE(gnomon::detail::has_scale(trace));
}

/// The fast path agrees with Jacobi rotations at every scale.
TEST(separated_eigen, agrees_with_rotations) {
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        const double scale = std::pow(10.0, double(seed % 581) - 290.0);
        const Eigen::Matrix3d a = scale * any_matrix(seed);
        const auto e = gnomon::detail::symmetric_eigen(a);
        gnomon::detail::square_array<3> rows;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) rows[i][j] = a(Eigen::Index(i), Eigen::Index(j));
        const auto rotated = gnomon::detail::jacobi_eigen<3>(rows);
        for (int i = 0; i < 3; ++i)
            ASSERT_NEAR(e.values[i] / scale, rotated.values[std::size_t(i)] / scale, 2e-15);
    }
}

}  // namespace
