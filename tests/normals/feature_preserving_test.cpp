// SPDX-License-Identifier: BSL-1.0
// What the figures of docs/normals.md rest on is benchmarks/normals/known_normals.cpp.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/estimator_laws.hpp"
#include <gnomon/core/angle.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/feature_preserving.hpp>
#include <gnomon/normals/normal_quality.hpp>
#include <gnomon/normals/plane_pca.hpp>

namespace {

using gnomon::estimate_normals, gnomon::feature_preserving, gnomon::knn, gnomon::plane_pca;
using gnomon::trust;

/// A roof of two squares of 1 m at a right angle, its ridge along x, with noise; and its truth.
struct roof {
    clouds::cloud points;
    std::vector<Eigen::Vector3d> normals;

    roof(std::size_t n, double sigma, std::uint64_t seed) {
        gnomon::random_stream random(seed);
        for (std::size_t i = 0; i < n; ++i) {
            const double side = random.uniform() < 0.5 ? 1.0 : -1.0;
            const Eigen::Vector3d down(0.0, side * std::sqrt(0.5), -std::sqrt(0.5));
            const double x = random.uniform(), s = random.uniform();
            normals.emplace_back(0.0, side * std::sqrt(0.5), std::sqrt(0.5));
            points.push_back(Eigen::Vector3d(x, 0.0, 0.0) + s * down +
                             sigma * clouds::gaussian_vector(random));
        }
    }

    /// The root mean square of the angles between estimates and truth [degrees], of points chosen.
    double error_of(const auto& surface, const std::function<bool(std::size_t)>& chosen) const {
        double sum = 0.0, count = 0.0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (!chosen(i)) continue;
            const double angle = laws::angle_between(surface[i].normal, normals[i]);
            sum += angle * angle;
            count += 1.0;
        }
        return std::sqrt(sum / count) * 180.0 / 3.14159265358979;
    }
    double error_of(const auto& surface) const {
        return error_of(surface, [](std::size_t) { return true; });
    }
};

TEST(feature_preserving, is_exact_up_to_the_ridge_of_a_clean_roof) {
    const roof r(8000, 0.0, 1);
    const auto near_ridge = [&](std::size_t i) { return std::abs(r.points[i].y()) < 0.03; };
    EXPECT_GT(r.error_of(estimate_normals(r.points, knn{.k = 16}, plane_pca{}), near_ridge), 16.0);
    EXPECT_LT(r.error_of(estimate_normals(r.points, feature_preserving{}), near_ridge), 8.0);
}

/// With one set of parameters, ahead of PlanePCA with the best k for each noise.
TEST(feature_preserving, is_ahead_of_the_best_single_k_for_each_noise) {
    for (const double sigma : {0.0, 0.003, 0.01}) {
        SCOPED_TRACE(sigma);
        const roof r(8000, sigma, 2);
        double best = 90.0;
        for (const std::size_t k : {8u, 16u, 24u, 32u, 48u, 64u, 96u})
            best = std::min(best, r.error_of(estimate_normals(r.points, knn{k}, plane_pca{})));
        EXPECT_LT(r.error_of(estimate_normals(r.points, feature_preserving{})), best);
    }
}

/// Two walls, one in front of the other: neighbors beyond the gap have no say.
TEST(feature_preserving, keeps_close_walls_apart) {
    gnomon::random_stream random(5);
    clouds::cloud points;
    for (int i = 0; i < 4000; ++i)
        points.emplace_back(random.uniform(), random.uniform(), i % 2 == 0 ? 0.0 : 0.02);
    for (const auto& s : estimate_normals(points, feature_preserving{})) {
        ASSERT_TRUE(gnomon::usable(s.trust));
        ASSERT_GT(std::abs(s.normal.z()), 0.98);
    }
}

TEST(feature_preserving, chooses_the_number_of_neighbors_by_the_noise) {
    const roof clean(8000, 0.0, 3), noisy(8000, 0.01, 3);
    EXPECT_EQ(estimate_normals(clean.points, feature_preserving{})[0].neighbors, 8u);
    EXPECT_GT(estimate_normals(noisy.points, feature_preserving{})[0].neighbors, 24u);
    const auto told = estimate_normals(noisy.points, feature_preserving{.noise = 0.0, .min_k = 12});
    EXPECT_EQ(told[0].neighbors, 12u);
}

/// The numbers of neighbors are searched from a guess that depends on the point before, and must
/// not depend on it.
TEST(feature_preserving, does_not_depend_on_the_order_of_points) {
    const roof r(3000, 0.005, 4);
    std::vector<std::size_t> order;
    const clouds::cloud shuffled = clouds::permuted(r.points, 6, order);
    const feature_preserving method{.noise = 0.005};
    const auto expected = estimate_normals(r.points, method);
    const auto surface = estimate_normals(shuffled, method);
    for (std::size_t i = 0; i < order.size(); ++i) {
        ASSERT_EQ(surface[i].neighbors, expected[order[i]].neighbors);
        ASSERT_LT(laws::angle_between(surface[i].normal, expected[order[i]].normal), 1e-9);
    }
}

TEST(feature_preserving, follows_the_cloud) {
    const roof r(3000, 0.005, 7);
    const auto expected = estimate_normals(r.points, feature_preserving{});
    const auto expect = [&](const Eigen::Matrix3d& turn, const Eigen::Vector3d& t, double allowed) {
        const auto surface =
            estimate_normals(clouds::moved(r.points, turn, t), feature_preserving{});
        std::size_t changed = 0;  // a near tie between two planes may be decided otherwise
        for (std::size_t i = 0; i < surface.size(); ++i) {
            const Eigen::Vector3d n = turn.colwise().normalized() * expected[i].normal;
            changed += laws::angle_between(surface[i].normal, n) > allowed ? 1 : 0;
        }
        EXPECT_LE(changed, 3u);
    };
    const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
    expect(clouds::random_rotation(8), {0, 0, 0}, 1e-9);
    expect(1e3 * identity, {0, 0, 0}, 1e-9);
    expect(1e-100 * identity, {0, 0, 0}, 1e-9);
    expect(identity, {6e5, 4.8e6, 100}, 1e-5);
}

TEST(feature_preserving, is_the_same_bytes_on_any_number_of_threads) {
    const roof r(5000, 0.005, 9);
    const auto expected = estimate_normals(r.points, feature_preserving{});
    for (const unsigned t : {1u, 2u, 4u}) {
        const auto surface = estimate_normals(r.points, feature_preserving{}, gnomon::threads{t});
        for (std::size_t i = 0; i < surface.size(); ++i) {
            ASSERT_EQ(surface[i].normal, expected[i].normal);
            ASSERT_EQ(surface[i].spectrum.lambda, expected[i].spectrum.lambda);
            ASSERT_EQ(surface[i].neighbors, expected[i].neighbors);
        }
    }
}

/// A point that lies neither on its own plane nor on that of a neighbor keeps its normal.
TEST(feature_preserving, keeps_the_normals_of_outliers) {
    gnomon::random_stream random(10);
    clouds::cloud points;
    for (int i = 0; i < 4000; ++i) points.emplace_back(random.uniform(), random.uniform(), 0.0);
    for (int i = 0; i < 80; ++i)
        points.emplace_back(random.uniform(), random.uniform(), random.uniform(-0.3, 0.3));
    for (const auto& s : estimate_normals(points, feature_preserving{}))
        ASSERT_NE(s.normal, Eigen::Vector3d(1.0, 0.0, 0.0));
}

/// Where a plane is biased, without noise: a quadric is not.
TEST(feature_preserving, follows_smooth_surfaces) {
    gnomon::random_stream random(11);
    clouds::cloud ball, torus, normals;
    for (int i = 0; i < 4000; ++i) ball.push_back(clouds::gaussian_vector(random).normalized());
    while (torus.size() < 8000) {
        const double turn = 6.28318530717959 * random.uniform();
        const double around = 6.28318530717959 * random.uniform();
        const Eigen::Vector3d out(std::cos(turn), std::sin(turn), 0.0);
        if (random.uniform() * 1.4 > 1.0 + 0.4 * std::cos(around)) continue;  // uniform by area
        normals.push_back(std::cos(around) * out + std::sin(around) * Eigen::Vector3d::UnitZ());
        torus.push_back(out + 0.4 * normals.back());
    }
    const auto error_of = [](const clouds::cloud& points, const clouds::cloud& truth) {
        return gnomon::normal_quality::of(estimate_normals(points, feature_preserving{}), truth)
            .rms;
    };
    EXPECT_LT(error_of(ball, ball), gnomon::degrees(0.2));
    EXPECT_LT(error_of(torus, normals), gnomon::degrees(0.5));
    const auto planes = estimate_normals(torus, knn{.k = 8}, plane_pca{});
    EXPECT_GT(gnomon::normal_quality::of(planes, normals).rms, gnomon::degrees(1.5));
}

/// Floats at UTM coordinates are half a metre apart.
TEST(feature_preserving, is_weak_where_coordinates_are_coarse) {
    const roof r(500, 0.005, 11);
    std::vector<Eigen::Vector3f> far;
    for (const Eigen::Vector3d& p : r.points)
        far.push_back((p + Eigen::Vector3d(6e5, 4.8e6, 100)).cast<float>());
    for (const auto& s : estimate_normals(far, feature_preserving{}))
        ASSERT_NE(s.trust, trust::good);
}

TEST(feature_preserving, survives_degenerate_clouds) {
    for (const auto& [name, points] : clouds::degenerate()) {
        SCOPED_TRACE(name);
        for (const auto& method : {feature_preserving{}, feature_preserving{.noise = 0.0},
                                   feature_preserving{.noise = 1e3, .min_k = 2, .max_k = 2}}) {
            const auto surface = estimate_normals(points, method);
            ASSERT_EQ(surface.size(), points.size());
            for (std::size_t i = 0; i < points.size(); ++i) {
                const auto& s = surface[i];
                ASSERT_TRUE(s.normal.allFinite() && std::isfinite(s.mean_distance));
                ASSERT_EQ(s.trust == trust::not_finite, !gnomon::is_finite(points[i]));
                ASSERT_NEAR(s.normal.norm(), gnomon::usable(s.trust) ? 1.0 : 0.0, 1e-12);
            }
        }
    }
}

TEST(feature_preserving, takes_more_neighbors_than_there_are) {
    const auto few = clouds::in_cube(10, 1);
    const auto all = estimate_normals(few, feature_preserving{});
    const auto more =
        estimate_normals(few, feature_preserving{.max_k = std::numeric_limits<std::size_t>::max()});
    for (std::size_t i = 0; i < few.size(); ++i) EXPECT_EQ(all[i].normal, more[i].normal);
}

TEST(feature_preserving, rejects_invalid_options) {
    const clouds::cloud points = clouds::sheet(50, 1);
    const auto refuses = [&](const feature_preserving& method) {
        EXPECT_THROW((void)estimate_normals(points, method), std::invalid_argument);
    };
    refuses({.noise = -1.0});
    refuses({.noise = clouds::nan});
    refuses({.tilt = 0.0});
    refuses({.tilt = clouds::infinity});
    refuses({.min_k = 1});
    refuses({.min_k = 9, .max_k = 8});
}

}  // namespace
