// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <concepts>
#include <cstdint>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/estimator_laws.hpp"
#include "laws/triangle_weight_laws.hpp"
#include "normals/dense_oracles.hpp"
#include <gnomon/normals/averaging.hpp>

namespace {

using gnomon::angle_weighted, gnomon::area_weighted, gnomon::neighborhood_view,
    gnomon::triangle_sign, gnomon::trust;

/// Every compiler deduces the weight, though not from designated initialisers.
static_assert(std::same_as<decltype(gnomon::detail::averaging{triangle_sign::from_order,
                                                              gnomon::detail::area_weight{}}),
                           area_weighted>);

/// Eqs. (3.9)-(3.11) as they stand, in long double.
template <class Weight>
oracles::answer literal_average(const laws::neighborhood_sample& sample, const Weight& weight,
                                bool to_viewpoint) {
    const auto wide = [](const Eigen::Vector3d& x) { return x.cast<long double>().eval(); };
    const std::size_t k = sample.neighbors.size();
    oracles::vector3 sum = oracles::vector3::Zero();
    long double weights = 0.0L;
    for (std::size_t j = 0; j < k; ++j) {
        const oracles::vector3 a = wide(sample.neighbors[j]) - wide(sample.p);
        const oracles::vector3 b = wide(sample.neighbors[(j + 1) % k]) - wide(sample.p);
        const oracles::vector3 c = a.cross(b);
        long double w = weight(a, b);
        weights += w * a.norm() * b.norm() / c.norm();
        if (to_viewpoint && c.dot(wide(sample.viewpoint) - wide(sample.p)) < 0.0L) w = -w;
        sum += w * c.normalized();
    }
    // Its accuracy is what the sum has left of its terms, and these of the products of their sides.
    return {sum.normalized().cast<double>(), static_cast<double>(sum.norm() / weights)};
}

template <class Weight>
void expect_agrees(const gnomon::detail::triangle_weight auto& model, const Weight& weight) {
    for (const auto sign : {triangle_sign::from_order, triangle_sign::to_viewpoint}) {
        const gnomon::detail::averaging<std::remove_cvref_t<decltype(model)>> estimate{.sign =
                                                                                           sign};
        oracles::expect_agrees_with(estimate, [&](const auto& sample) {
            return literal_average(sample, weight, sign == triangle_sign::to_viewpoint);
        });
    }
}

TEST(averaging, agrees_with_the_formulas) {
    using v = oracles::vector3;
    expect_agrees(gnomon::detail::equal_weight{}, [](const v&, const v&) { return 1.0L; });
    expect_agrees(gnomon::detail::area_weight{},
                  [](const v& a, const v& b) { return 0.5L * a.cross(b).norm(); });
    expect_agrees(gnomon::detail::angle_weight{},
                  [](const v& a, const v& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); });
    expect_agrees(gnomon::detail::centroid_weight{},
                  [](const v& a, const v& b) { return 1.0L / ((a + b) / 3.0L).squaredNorm(); });
    expect_agrees(gnomon::detail::gravitational_weight{}, [](const v& a, const v& b) {
        return 0.5L * a.cross(b).norm() / ((a + b) / 3.0L).squaredNorm();
    });
}

/// The weight of Eq. (3.10) cancels the normalization of (3.9): half the mean of the cross
/// products.
TEST(averaging, area_weighted_is_the_mean_of_the_raw_cross_products) {
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        const auto s = laws::sample_neighborhood(seed);
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (std::size_t j = 0; j < s.neighbors.size(); ++j)
            sum +=
                0.5 * (s.neighbors[j] - s.p).cross(s.neighbors[(j + 1) % s.neighbors.size()] - s.p);
        EXPECT_LT((area_weighted{}(s.p, s.neighbors).normal - sum.normalized()).norm(), 1e-15);
    }
}

TEST(averaging, an_open_fan_does_not_wrap) {
    const Eigen::Vector3d p(0, 0, 0);
    // Two level triangles, and one from the last to the first that is not.
    const clouds::cloud neighbors{{1, 0, 0}, {0, 1, 0}, {-1, 0, 1e-3}};
    const Eigen::Vector3d level = area_weighted{}(p, neighborhood_view(neighbors, true)).normal;
    EXPECT_LT(laws::angle_between(level, {0, 0, 1}), 1e-3);
    const clouds::cloud sharp{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    EXPECT_NE(area_weighted{}(p, neighborhood_view(sharp, true)).normal,
              area_weighted{}(p, neighborhood_view(sharp, false)).normal);
    // Two neighbors form one triangle, whether the fan is open or closed.
    const clouds::cloud two{{1, 0, 0}, {0, 1, 0}};
    EXPECT_EQ(area_weighted{}(p, two).normal, Eigen::Vector3d::UnitZ());
}

TEST(averaging, angle_weights_add_up_to_a_full_turn) {
    double sum = 0.0;
    const gnomon::detail::angle_weight weight;
    for (int i = 0; i < 7; ++i) {
        const auto at = [](int j) {
            const double a = 2.0 * std::numbers::pi * j / 7.0;
            return Eigen::Vector3d(std::cos(a), std::sin(a), 0.0);
        };
        sum += weight(at(i), at(i + 1), at(i).cross(at(i + 1)).norm());
    }
    EXPECT_NEAR(sum, 2.0 * std::numbers::pi, 1e-14);
    EXPECT_NEAR(weight({1, 0, 0}, {-1, 1e-9, 0}, 1e-9), std::numbers::pi, 1e-8);
}

TEST(averaging, reports_degenerate_neighborhoods) {
    const Eigen::Vector3d p(0, 0, 0);
    EXPECT_EQ(area_weighted{}(p, clouds::cloud{{1, 0, 0}}).trust, trust::too_few_neighbors);
    EXPECT_EQ(area_weighted{}(p, clouds::cloud{{1, 0, 0}, {2, 0, 0}}).trust, trust::degenerate);
    EXPECT_EQ(area_weighted{}(p, clouds::cloud{{1, 0, 0}, {0, clouds::nan, 0}}).trust,
              trust::not_finite);
    struct negative {
        double operator()(const Eigen::Vector3d&, const Eigen::Vector3d&, double) const {
            return -1.0;
        }
    };
    EXPECT_EQ(gnomon::detail::averaging<negative>{}(
                  p, clouds::cloud{{1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, -1, 0}})
                  .trust,
              trust::degenerate);
    // There and back again: the triangles cancel, unless they are turned to the view point.
    const clouds::cloud there_and_back{{1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 1, 0}};
    EXPECT_EQ(area_weighted{}(p, there_and_back).trust, trust::degenerate);
    EXPECT_EQ(
        area_weighted{.sign = triangle_sign::to_viewpoint}(p, there_and_back, {0, 0, 1}).trust,
        trust::good);
}

TEST(averaging, laws_hold) {
    laws::estimator_laws(area_weighted{});
    laws::estimator_laws(angle_weighted{.sign = triangle_sign::to_viewpoint});
    laws::estimator_laws(gnomon::equally_weighted{});
    laws::estimator_laws(gnomon::centroid_weighted{});
    laws::estimator_laws(gnomon::gravitationally_weighted{});
    static_assert(gnomon::cyclic_estimator<area_weighted>);
}

static_assert(!gnomon::detail::triangle_weight<double>);

TEST(triangle_weight, models_obey_the_laws) {
    laws::weight_is_of_the_triangle(gnomon::detail::equal_weight{});
    laws::weight_is_of_the_triangle(gnomon::detail::area_weight{});
    laws::weight_is_of_the_triangle(gnomon::detail::angle_weight{});
    laws::weight_is_of_the_triangle(gnomon::detail::centroid_weight{});
    laws::weight_is_of_the_triangle(gnomon::detail::gravitational_weight{});
}

}  // namespace
