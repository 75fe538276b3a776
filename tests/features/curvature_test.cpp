// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <gtest/gtest.h>

#include "features/patches.hpp"
#include "laws/clouds.hpp"
#include "laws/estimator_laws.hpp"
#include <gnomon/features/curvature.hpp>
#include <gnomon/normals/plane_pca.hpp>

namespace {

using gnomon::curvature, gnomon::shape_operator_curvature, gnomon::thesis_curvature, gnomon::trust;
using patches::up;

using patches::zero;

struct no_normal {
    curvature operator()(const Eigen::Vector3d&, gnomon::ring_view) const;
};
struct returns_number {
    double operator()(const Eigen::Vector3d&, const Eigen::Vector3d&, gnomon::ring_view) const;
};
struct more_than_curvature : curvature {
    double residual = 0.0;
};
static_assert(gnomon::curvature_estimator<shape_operator_curvature>);
static_assert(gnomon::curvature_estimator<thesis_curvature>);
static_assert(gnomon::curvature_estimator<decltype([](const auto&, const auto&, auto) {
    return more_than_curvature{};
})>);
static_assert(!gnomon::curvature_estimator<no_normal>);
static_assert(!gnomon::curvature_estimator<returns_number>);
static_assert(!gnomon::curvature_estimator<gnomon::plane_pca>);

void expect_zero(const curvature& c) {
    EXPECT_FALSE(gnomon::usable(c.trust));
    EXPECT_EQ(c.kappa1, 0.0);
    EXPECT_EQ(c.kappa2, 0.0);
    EXPECT_EQ(c.direction1, zero);
    EXPECT_EQ(c.direction2, zero);
}

/// Within 1e-3 of the larger principal curvature, which is what the specification asks for: dense
/// and without noise.
template <class C>
void expect_known_curvatures(const C& estimate) {
    for (const auto& surface : patches::all()) {
        SCOPED_TRACE(surface.name);
        for (std::uint64_t seed = 0; seed < 20; ++seed) {
            const auto c = estimate(zero, up, patches::ring_of(surface, 200, 0.01, seed));
            ASSERT_EQ(c.trust, trust::good);
            const double size = std::max(std::abs(surface.kappa1), std::abs(surface.kappa2));
            ASSERT_NEAR(c.kappa1, surface.kappa1, 1e-3 * size);
            ASSERT_NEAR(c.kappa2, surface.kappa2, 1e-3 * size);
            ASSERT_NEAR(c.gaussian(), surface.kappa1 * surface.kappa2, 2e-3 * size * size);
            ASSERT_NEAR(c.mean(), 0.5 * (surface.kappa1 + surface.kappa2), 1e-3 * size);
        }
    }
}

TEST(curvature, of_known_surfaces) { expect_known_curvatures(shape_operator_curvature{}); }
TEST(curvature, of_known_surfaces_by_the_thesis) { expect_known_curvatures(thesis_curvature{}); }

/// Of a column the axis is straight and the way around bends; of z = xy it is the diagonals.
template <class C>
void expect_known_directions(const C& estimate) {
    const auto all = patches::all();
    const auto column = estimate(zero, up, patches::ring_of(all[2], 200, 0.01, 1));
    EXPECT_LT(laws::angle_between(column.direction1, {1, 0, 0}), 1e-3);
    EXPECT_LT(laws::angle_between(column.direction2, {0, 1, 0}), 1e-3);
    const auto saddle = estimate(zero, up, patches::ring_of(all[5], 200, 0.01, 1));
    EXPECT_LT(laws::angle_between(saddle.direction1, {1, 1, 0}), 1e-9);
    EXPECT_LT(laws::angle_between(saddle.direction2, {1, -1, 0}), 1e-9);
}

TEST(curvature, has_principal_directions) { expect_known_directions(shape_operator_curvature{}); }
TEST(curvature, has_principal_directions_by_the_thesis) {
    expect_known_directions(thesis_curvature{});
}

/// z = xy away from its middle, in a frame inclined by up to 49 degrees and at a point up to 1 mm
/// off the surface: the first-order terms and the constant take it up. (The thesis's form does not;
/// the point is one of those fitted, which is why 1 mm is felt at all.)
TEST(curvature, counts_the_inclination_of_the_surface) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        gnomon::random_stream random(seed);
        const double x = random.uniform(-0.8, 0.8);
        const double y = random.uniform(-0.8, 0.8);
        clouds::cloud ring;
        for (int i = 0; i < 100; ++i) {
            const double u = x + random.uniform(-0.05, 0.05);
            const double v = y + random.uniform(-0.05, 0.05);
            ring.push_back({u, v, u * v});
        }
        for (const double off : {0.0, 0.001}) {
            const double tolerance = off == 0.0 ? 1e-9 : 0.05;
            const auto c = shape_operator_curvature{}({x, y, x * y + off}, up, ring);
            const double w = std::sqrt(1 + x * x + y * y);
            ASSERT_NEAR(c.gaussian(), -1 / (w * w * w * w), tolerance);
            ASSERT_NEAR(c.mean(), -x * y / (w * w * w), tolerance);
            const Eigen::Vector3d n = Eigen::Vector3d(-y, -x, 1) / w;
            ASSERT_LT((c.direction1.cross(c.direction2) - n).norm(), tolerance);
            // How the surface bends along a unit tangent: II(t, t) = 2 t_x t_y / w.
            const Eigen::Vector3d& t = c.direction1;
            ASSERT_NEAR(2 * t.x() * t.y() / w, c.kappa1, tolerance);
            const Eigen::Vector3d& u = c.direction2;
            ASSERT_NEAR(2 * u.x() * u.y() / w, c.kappa2, tolerance);
        }
    }
}

/// A point and a ring of a bent and noisy sheet, with clearly different principal curvatures.
struct bent_sample {
    clouds::cloud ring;
    Eigen::Vector3d p = Eigen::Vector3d::Zero();

    explicit bent_sample(std::uint64_t seed) {
        const auto all = patches::all();
        ring = patches::ring_of(all[2 + seed % 2], 40, 0.2, seed, 1e-3);
        p.z() = 1e-3;
    }
};

void expect_same(const curvature& a, const curvature& b, double tolerance) {
    ASSERT_EQ(a.trust, b.trust);
    ASSERT_NEAR(a.kappa1, b.kappa1, tolerance);
    ASSERT_NEAR(a.kappa2, b.kappa2, tolerance);
    ASSERT_LT(laws::angle_between(a.direction1, b.direction1), tolerance);
    ASSERT_LT(laws::angle_between(a.direction2, b.direction2), tolerance);
}

/// The laws of a curvature estimator: order, place, rotation, and the side of the normal.
template <class C>
void curvature_follows_the_cloud(const C& estimate) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const auto [ring, p] = bent_sample(seed);
        const curvature c = estimate(p, up, ring);
        ASSERT_EQ(c.trust, trust::good);
        ASSERT_GT(c.kappa1 - c.kappa2, 1.0);

        std::vector<std::size_t> order;
        expect_same(estimate(p, up, clouds::permuted(ring, seed, order)), c, 1e-10);

        const Eigen::Matrix3d r = clouds::random_rotation(seed);
        for (const Eigen::Vector3d& t : {zero, Eigen::Vector3d(6e5, 4.8e6, 100)}) {
            const double tolerance = t == zero ? 1e-10 : 1e-5;  // rounded to 1e-9 m there
            curvature expected = c;
            expected.direction1 = r * c.direction1;
            expected.direction2 = r * c.direction2;
            expect_same(estimate(r * p + t, r * up, clouds::moved(ring, r, t)), expected,
                        tolerance);
        }

        const curvature back = estimate(p, -up, ring);
        ASSERT_NEAR(back.mean(), -c.mean(), 1e-10);
        ASSERT_NEAR(back.gaussian(), c.gaussian(), 1e-9);
        ASSERT_LT(laws::angle_between(back.direction1, c.direction2), 1e-10);
    }
}

TEST(curvature, follows_the_cloud) { curvature_follows_the_cloud(shape_operator_curvature{}); }
TEST(curvature, follows_the_cloud_by_the_thesis) {
    curvature_follows_the_cloud(thesis_curvature{});
}

TEST(curvature, is_one_over_a_length) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const auto [ring, p] = bent_sample(seed);
        const curvature c = shape_operator_curvature{}(p, up, ring);
        for (const double s : {1e-30, 1e-3, 7.0, 1e30}) {
            const Eigen::Matrix3d scaling = s * Eigen::Matrix3d::Identity();
            curvature scaled =
                shape_operator_curvature{}(s * p, up, clouds::moved(ring, scaling, zero));
            scaled.kappa1 *= s;
            scaled.kappa2 *= s;
            expect_same(scaled, c, 1e-10);
        }
    }
}

/// Squares of what is smaller than 1e-146 m are no numbers any more, nor are those of curvatures
/// beyond 1e154 / m.
TEST(curvature, of_no_size_is_not_determined) {
    const auto [ring, p] = bent_sample(1);
    const Eigen::Matrix3d tiny = 1e-150 * Eigen::Matrix3d::Identity();
    clouds::cloud needle;
    for (int i = -2; i <= 2; ++i) {
        for (int j = -2; j <= 2; ++j)
            needle.push_back({1e-144 * i, 1e-144 * j, -1.0 * (i * i + j * j)});
    }
    for (const clouds::cloud& points : {clouds::moved(ring, tiny, zero), needle}) {
        const auto c = shape_operator_curvature{}(zero, up, points);
        EXPECT_EQ(c.trust, trust::degenerate);
        expect_zero(c);
    }
}

/// Without noise the unit matters little, and the thesis's form gives small and large radii too.
TEST(curvature, of_the_thesis_for_small_and_large_radii) {
    const auto ring = patches::ring_of(patches::all()[0], 50, 0.02, 2);
    for (const double s : {1e-4, 1e-2, 1e2, 1e4}) {
        const Eigen::Matrix3d scaling = s * Eigen::Matrix3d::Identity();
        const auto c = thesis_curvature{}(zero, up, clouds::moved(ring, scaling, zero));
        EXPECT_EQ(c.trust, trust::good);
        EXPECT_NEAR(c.kappa1 * s, -0.5, 1e-3);
        EXPECT_NEAR(c.kappa2 * s, -0.5, 1e-3);
    }
}

/// The thesis's form does break the law of scale as soon as there is noise: in millimetres it
/// finds another surface. Should this fail, say so in its comment.
TEST(curvature, of_the_thesis_depends_on_the_unit) {
    const auto ring = patches::ring_of(patches::all()[2], 50, 0.05, 1, 0.005);
    const Eigen::Matrix3d thousand = 1e3 * Eigen::Matrix3d::Identity();
    const double in_metres = thesis_curvature{}(zero, up, ring).mean();
    const double in_millimetres =
        thesis_curvature{}(zero, up, clouds::moved(ring, thousand, zero)).mean();
    EXPECT_GT(std::abs(1e3 * in_millimetres - in_metres), 0.1 * std::abs(in_metres));
}

/// What noise does to both (Fig. 3.14): for the thesis's form noise is a saddle. Of all quadrics xy
/// and x^2 - y^2 are the smallest; where they are smaller than the noise of z, the least singular
/// vector consists of them, and divided by a small d' they are steep.
TEST(curvature, of_the_thesis_takes_noise_for_saddles) {
    const auto flat = patches::all()[4];
    int saddles[2] = {0, 0};
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        const auto ring = patches::ring_of(flat, 50, 0.05, seed, 0.015);
        saddles[0] += shape_operator_curvature{}(zero, up, ring).gaussian() < 0.0;
        saddles[1] += thesis_curvature{}(zero, up, ring).gaussian() < 0.0;
    }
    EXPECT_LT(saddles[0], 350);
    EXPECT_GT(saddles[1], 450);
}

/// Oracle: Eqs. (3.25) to (3.27) by dense SVDs in long double, the frame included.
struct dense_thesis {
    double K;
    double H;
    double condition;  ///< s_1 / (s_3 - s_4)

    dense_thesis(const Eigen::Vector3d& p, const clouds::cloud& ring, const Eigen::Vector3d& n) {
        using matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
        const auto k = static_cast<Eigen::Index>(ring.size());
        matrix q(k + 1, 3);
        q.row(k).setZero();
        for (Eigen::Index j = 0; j < k; ++j) {
            q.row(j) = (ring[static_cast<std::size_t>(j)] - p).transpose().cast<long double>();
        }
        const matrix centered = q.rowwise() - q.colwise().mean().eval();
        const Eigen::JacobiSVD<matrix> principal(centered,
                                                 Eigen::ComputeThinU | Eigen::ComputeThinV);
        matrix frame = principal.matrixV();
        frame.col(2) *= frame.col(2).dot(n.cast<long double>()) < 0 ? -1 : 1;
        q *= frame;
        matrix r(k, 4);
        for (Eigen::Index j = 0; j < k; ++j) {
            r.row(j) << q(j, 0) * q(j, 0), q(j, 0) * q(j, 1), q(j, 1) * q(j, 1), q(j, 2);
        }
        const Eigen::JacobiSVD<matrix> svd(r, Eigen::ComputeThinU | Eigen::ComputeThinV);
        const matrix c = svd.matrixV().col(3) / -svd.matrixV()(3, 3);
        K = static_cast<double>(4 * c(0) * c(2) - c(1) * c(1));
        H = static_cast<double>(c(0) + c(2));
        const auto& s = svd.singularValues();
        condition = static_cast<double>(s[0] / (s[2] - s[3]));
    }
};

TEST(curvature, of_the_thesis_agrees_with_a_dense_svd) {
    int compared = 0;
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        gnomon::random_stream random(seed, 4);
        const auto all = patches::all();
        const std::size_t k = 6 + random.bits() % 50;
        const double radius = std::pow(10.0, random.uniform(-2.0, 0.0)) * 0.3;
        const double sigma = random.uniform() < 0.3 ? 0.0 : 0.05 * radius * random.uniform();
        const Eigen::Matrix3d r = clouds::random_rotation(seed);
        const auto ring = clouds::moved(patches::ring_of(all[seed % 8], k, radius, seed, sigma), r,
                                        Eigen::Vector3d(1, 2, 3));
        const Eigen::Vector3d p(1, 2, 3);
        Eigen::Vector3d n = gnomon::plane_pca{}(p, ring).normal;
        if (n.dot(r * up) < 0.0) n = -n;
        const curvature c = thesis_curvature{}(p, n, ring);
        if (!gnomon::usable(c.trust)) continue;
        const dense_thesis oracle(p, ring, n);
        if (oracle.condition > 1e4) continue;
        ++compared;
        const double size = std::max({1.0, std::abs(c.kappa1), std::abs(c.kappa2)});
        const double tolerance = 1e-14 * oracle.condition * oracle.condition * size / radius;
        ASSERT_NEAR(c.mean(), oracle.H, tolerance * size) << seed;
        ASSERT_NEAR(c.gaussian(), oracle.K, tolerance * size * size) << seed;
    }
    EXPECT_GT(compared, 1500);
}

TEST(curvature, says_what_is_wrong) {
    const shape_operator_curvature fit;
    const clouds::cloud five{{1, 0, 0}, {0, 1, 0}, {-1, 0.5, 0}, {0.5, -1, 0}, {1, 1, 0.1}};
    EXPECT_EQ(fit(zero, up, five).trust, trust::good);
    EXPECT_EQ(fit(zero, 2.0 * up, five).kappa1, fit(zero, up, five).kappa1);
    const clouds::cloud four(five.begin(), five.end() - 1);
    EXPECT_EQ(fit(zero, up, four).trust, trust::too_few_neighbors);
    EXPECT_EQ(fit(zero, up, {}).trust, trust::too_few_neighbors);
    EXPECT_EQ(fit(zero, zero, five).trust, trust::degenerate);
    EXPECT_EQ(fit(zero, {0, clouds::nan, 1}, five).trust, trust::not_finite);
    EXPECT_EQ(fit({clouds::infinity, 0, 0}, up, five).trust, trust::not_finite);
    clouds::cloud broken = five;
    broken[3].y() = clouds::nan;
    EXPECT_EQ(fit(zero, up, broken).trust, trust::not_finite);
    EXPECT_EQ(fit(zero, up, clouds::cloud(9, zero)).trust, trust::degenerate);

    clouds::cloud line, far_line, two_lines, circle, flat;
    for (int i = 0; i < 20; ++i) {
        line.push_back({0.1 * i, 0, 0});
        far_line.push_back({0.1 * i, 1e-9 * (i % 3), 0});  // as rounding at UTM coordinates has it
        two_lines.push_back({0.1 * i, 0.5 * (i % 2), 0});
        circle.push_back({std::cos(i), std::sin(i), 0});  // about the point
        flat.push_back({0.1 * i, 0.01 * (i % 3), 0});
    }
    EXPECT_EQ(fit(zero, up, line).trust, trust::degenerate);
    EXPECT_EQ(fit(zero, up, far_line).trust, trust::degenerate);
    EXPECT_EQ(fit(zero, up, two_lines).trust, trust::degenerate);
    EXPECT_EQ(fit({1, 0, 0}, up, circle).trust, trust::degenerate);  // the point is on it
    EXPECT_EQ(fit(zero, up, circle).trust, trust::good);
    EXPECT_EQ(fit(zero, up, flat).trust, trust::weak);
    two_lines[5].y() += 1e-3;  // now determined, but by one point
    EXPECT_EQ(fit(zero, up, two_lines).trust, trust::weak);
    EXPECT_EQ(shape_operator_curvature{.min_independence = 0}(zero, up, two_lines).trust,
              trust::good);
    for (const auto& ring : {four, broken, line, circle}) expect_zero(fit({1, 0, 0}, up, ring));

    const thesis_curvature literal;
    EXPECT_EQ(literal(zero, up, {five.begin(), five.begin() + 2}).trust, trust::too_few_neighbors);
    EXPECT_EQ(literal(zero, up, {five.begin(), five.begin() + 3}).trust, trust::good);
    EXPECT_EQ(literal(zero, up, line).trust, trust::degenerate);
    EXPECT_EQ(literal(zero, up, broken).trust, trust::not_finite);
    // On two lines through the point x^2 and y^2 are one number: more than one quadric fits.
    clouds::cloud diagonals;
    for (int i = 1; i < 6; ++i) {
        for (const double x : {-0.2, 0.2}) {
            for (const double y : {-0.1, 0.1}) diagonals.push_back({i * x, i * y, i * i * x * x});
        }
    }
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const Eigen::Matrix3d r = clouds::random_rotation(seed);
        const auto c = literal(zero, r * up, clouds::moved(diagonals, r, zero));
        EXPECT_EQ(c.trust, trust::degenerate);
        expect_zero(c);
    }
    EXPECT_EQ(fit(zero, up, diagonals).trust, trust::degenerate);
    // On the axes xy is zero but for rounding: the least singular vector knows nothing of z.
    clouds::cloud axes;
    for (int i = 1; i < 6; ++i) {
        for (const double x : {-0.2, 0.2}) {
            axes.push_back({i * x, 0, 0.01 * (i % 2)});
            axes.push_back({0, 0.5 * i * x, 0.01 * (i % 3)});
        }
    }
    const Eigen::Vector3d turned_up = clouds::random_rotation(1) * up;
    for (const auto& ring : {axes, clouds::moved(axes, clouds::random_rotation(1), zero)}) {
        const auto c = literal(zero, ring == axes ? up : turned_up, ring);
        EXPECT_EQ(c.trust, trust::degenerate);
        expect_zero(c);
    }
}

/// Also where the square of the length is no number.
TEST(curvature, of_a_normal_of_any_length) {
    const auto [ring, p] = bent_sample(1);
    const Eigen::Vector3d inclined(0.25, -0.5, 1.0);
    const auto expect_equal = [](const curvature& a, const curvature& b) {
        EXPECT_EQ(a.trust, b.trust);
        EXPECT_EQ(a.kappa1, b.kappa1);
        EXPECT_EQ(a.kappa2, b.kappa2);
        EXPECT_EQ(a.direction1, b.direction1);
        EXPECT_EQ(a.direction2, b.direction2);
    };
    for (const double length : {1e-320, 1e-161, 1e-3, 1e161, 1e308}) {
        SCOPED_TRACE(length);
        expect_equal(shape_operator_curvature{}(p, length * up, ring),
                     shape_operator_curvature{}(p, up, ring));
        const double power = std::exp2(std::floor(std::log2(length)));
        expect_equal(thesis_curvature{}(p, power * inclined, ring),
                     thesis_curvature{}(p, inclined, ring));
    }
}

TEST(curvature, of_a_perfect_plane_is_zero) {
    clouds::cloud ring;
    for (int i = 0; i < 20; ++i) ring.push_back({0.1 * (i % 5), 0.1 * (i / 5), 0.0});
    for (const curvature& c : {shape_operator_curvature{}({0.2, 0.2, 0.0}, up, ring),
                               thesis_curvature{}({0.2, 0.2, 0.0}, up, ring)}) {
        EXPECT_EQ(c.trust, trust::good);
        EXPECT_EQ(c.kappa1, 0.0);
        EXPECT_EQ(c.kappa2, 0.0);
    }
}

}  // namespace
