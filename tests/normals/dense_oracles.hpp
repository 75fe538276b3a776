// SPDX-License-Identifier: BSL-1.0
/// @file
/// Oracles for the estimators: the matrices of Tab. 3.1 of the thesis, written out row by row and
/// decomposed by a dense SVD in long double; and the random neighborhoods that they are tried on.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/SVD>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/estimator_laws.hpp"
#include <gnomon/core/random.hpp>

namespace oracles {

using matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using vector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
using vector3 = Eigen::Matrix<long double, 3, 1>;

/// A random neighborhood about `place`, seen from there less (0.3, 0.4, 2): an ellipsoid of any
/// shape from a ball to a line or a sheet, of 3 to 60 neighbors. With float coordinates if asked.
inline laws::neighborhood_sample random_neighborhood(std::uint64_t seed,
                                                     const Eigen::Vector3d& place,
                                                     bool in_float = false) {
    gnomon::random_stream random(seed, 3);
    const auto k = static_cast<std::size_t>(3 + random.below(58));
    const Eigen::Vector3d radii(1.0, std::pow(10.0, -3.0 * random.uniform()),
                                std::pow(10.0, -6.0 * random.uniform()));
    const Eigen::Matrix3d r = 0.05 * clouds::random_rotation(seed) * radii.asDiagonal();
    clouds::cloud all;
    for (std::size_t j = 0; j <= k; ++j) {
        const Eigen::Vector3d p = place + r * clouds::gaussian_vector(random);
        all.push_back(in_float ? p.cast<float>().cast<double>().eval() : p);
    }
    return {all[0], {all.begin() + 1, all.end()}, place - Eigen::Vector3d(0.3, 0.4, 2.0)};
}

/// Where few digits are left for a neighborhood [m]: UTM coordinates for doubles, a few metres from
/// the origin for floats.
inline Eigen::Vector3d place_of_few_digits(bool in_float) {
    return in_float ? Eigen::Vector3d(1, 2, 0.5) : Eigen::Vector3d(6e5, 4.8e6, 100);
}

/// A random neighborhood there, in doubles for even seeds, in floats for odd ones.
inline laws::neighborhood_sample neighborhood_of_few_digits(std::uint64_t seed) {
    const bool in_float = seed % 2 == 1;
    return random_neighborhood(seed, place_of_few_digits(in_float), in_float);
}

/// The rows `row(q)` of the neighbors, and of the point before them if `with_point`.
inline matrix rows_of(const laws::neighborhood_sample& sample, bool with_point,
                      Eigen::Index columns, auto&& row) {
    matrix m(static_cast<Eigen::Index>(sample.neighbors.size()) + with_point, columns);
    if (with_point) m.row(0) = row(sample.p.cast<long double>().eval()).transpose();
    for (std::size_t j = 0; j < sample.neighbors.size(); ++j) {
        m.row(static_cast<Eigen::Index>(j) + with_point) =
            row(sample.neighbors[j].cast<long double>().eval()).transpose();
    }
    return m;
}

/// A normal and the gap that its accuracy depends on: between the last two eigenvalues of the
/// matrix of squares, relative to the first.
struct answer {
    Eigen::Vector3d normal;
    double gap;
    vector singular_values = {};
};

/// The last right singular vector of m, the first three components of it.
inline answer last_singular_vector(const matrix& m) {
    const Eigen::JacobiSVD<matrix> svd(m, Eigen::ComputeFullV);
    const Eigen::Index d = m.cols();
    vector s = vector::Zero(d);
    s.head(svd.singularValues().size()) = svd.singularValues();
    const vector3 n = svd.matrixV().col(d - 1).head(3);
    const long double gap = (s[d - 2] * s[d - 2] - s[d - 1] * s[d - 1]) / (s[0] * s[0]);
    return {n.normalized().cast<double>(), static_cast<double>(gap), s};
}

/// The largest angle [rad] that rounding explains, for points in double and for points in float.
inline double allowed(double gap) { return gap >= 1e-2 ? 1e-12 : 1e-14 / gap; }

/// Runs `estimate` and the oracle on 10,000 neighborhoods each at the origin, at UTM coordinates
/// and in floats. Where the estimator is not good, the gap must be small.
template <class E>
void expect_agrees_with(const E& estimate, auto&& oracle, std::size_t min_k = 3,
                        int trials = 10'000) {
    int wide_gaps = 0;
    int usable = 0;
    for (const bool in_float : {false, true}) {
        const Eigen::Vector3d place = place_of_few_digits(in_float);
        for (int trial = 0; trial < trials; ++trial) {
            const auto seed = static_cast<std::uint64_t>(trial);
            // Every other one near the origin.
            const auto sample =
                random_neighborhood(seed, trial % 2 ? place : Eigen::Vector3d(0, 0, 0), in_float);
            if (sample.neighbors.size() < min_k) continue;
            const auto found = laws::estimate_one(estimate, sample);
            const answer expected = oracle(sample);
            wide_gaps += expected.gap >= 1e-2;
            if (!gnomon::usable(found.trust)) {
                ASSERT_LT(expected.gap, 2e-12) << "seed " << seed;
                continue;
            }
            ++usable;
            ASSERT_LE(laws::angle_between(found.normal, expected.normal), allowed(expected.gap))
                << "seed " << seed << " gap " << expected.gap << " in float " << in_float;
        }
    }
    EXPECT_GT(usable, trials);
    testing::Test::RecordProperty("wide_gaps", wide_gaps);
}

}  // namespace oracles
