// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/estimator_laws.hpp"
#include "normals/outliers.hpp"
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/normals/sample_consensus.hpp>

namespace {

using gnomon::mlesac_plane, gnomon::plane_pca, gnomon::ransac_plane, gnomon::trust;

struct no_cost {
    double operator()(double sigma) const;
};
static_assert(gnomon::detail::consensus_cost<gnomon::detail::count_outliers>);
static_assert(gnomon::detail::consensus_cost<gnomon::detail::mixture_likelihood>);
static_assert(!gnomon::detail::consensus_cost<no_cost> &&
              !gnomon::detail::consensus_cost<plane_pca>);

/// With 30 % of outliers.
TEST(sample_consensus, turns_away_from_outliers) {
    const double pca = outliers::mean_gamma_with(plane_pca{}, 0.3);
    const double ransac = outliers::mean_gamma_with(ransac_plane{.sigma = 0.005}, 0.3);
    const double mlesac = outliers::mean_gamma_with(mlesac_plane{.sigma = 0.005}, 0.3);
    EXPECT_GE(ransac, pca + 0.05);
    EXPECT_GE(mlesac, ransac - 0.002);
}

TEST(sample_consensus, is_a_function_of_its_seed) {
    const auto s = laws::sample_neighborhood(1);
    const ransac_plane one{.sigma = 0.001, .trials = 5, .seed = 1};
    const ransac_plane other{.sigma = 0.001, .trials = 5, .seed = 2};
    EXPECT_EQ(one(s.p, s.neighbors).normal, one(s.p, s.neighbors).normal);
    EXPECT_NE(one(s.p, s.neighbors).normal, other(s.p, s.neighbors).normal);
}

/// Without outliers all points are within 2.5 sigma, and the fit is that of PlanePCA.
TEST(sample_consensus, of_nothing_but_inliers_is_plane_pca) {
    const auto s = laws::sample_neighborhood(2);
    EXPECT_LT(laws::angle_between(ransac_plane{.sigma = 1.0}(s.p, s.neighbors).normal,
                                  plane_pca{}(s.p, s.neighbors).normal),
              1e-12);
    EXPECT_LT(laws::angle_between(mlesac_plane{.sigma = 1.0}(s.p, s.neighbors).normal,
                                  plane_pca{}(s.p, s.neighbors).normal),
              1e-12);
}

/// The costs themselves, by hand.
TEST(sample_consensus, costs_match_their_definitions) {
    const auto distances = [](auto&& visit) {
        for (const double d : {0.0, 0.024, -0.026, 1.0}) visit(d);
    };
    EXPECT_EQ(gnomon::detail::count_outliers{}(0.01, distances), 2.0);
    // More points near the plane: more likely.
    const auto nearer = [](auto&& visit) {
        for (const double d : {0.0, 0.0, 0.0, 1.0}) visit(d);
    };
    EXPECT_LT(gnomon::detail::mixture_likelihood{}(0.01, nearer),
              gnomon::detail::mixture_likelihood{}(0.01, distances));
}

TEST(sample_consensus, reports_degenerate_neighborhoods) {
    const Eigen::Vector3d p(0, 0, 0);
    EXPECT_EQ(ransac_plane{}(p, clouds::cloud{{1, 0, 0}, {0, 1, 0}}).trust,
              trust::too_few_neighbors);
    EXPECT_EQ(ransac_plane{}(p, clouds::cloud(5, p)).trust, trust::degenerate);
    for (const double sigma : {0.0, -1.0, clouds::nan, clouds::infinity})
        EXPECT_THROW((void)(ransac_plane{.sigma = sigma}(p, clouds::cloud(5, p))),
                     std::invalid_argument);
}

TEST(sample_consensus, refuses_no_trials_and_no_reach) {
    const auto s = laws::sample_neighborhood(1);
    EXPECT_THROW((void)(ransac_plane{.trials = 0}(s.p, s.neighbors)), std::invalid_argument);
    EXPECT_THROW((void)(mlesac_plane{.cost = {.reach = 0.0}}(s.p, s.neighbors)),
                 std::invalid_argument);
}

TEST(sample_consensus, laws_hold) {
    laws::estimator_laws(ransac_plane{.trials = 20});
    laws::estimator_laws(mlesac_plane{.trials = 20});
}

}  // namespace
