// SPDX-License-Identifier: BSL-1.0
// The first scenario of the thesis (Klasing 2010, Sec. 3.2.6, Figs. 3.3 and 3.5): a box and a
// cylinder, 14,200 points. Do the methods rank as the thesis says? Over five seeds, at every fifth
// point.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>

#include <boost/hana/for_each.hpp>
#include <gtest/gtest.h>

#include "scans/sampled_neighborhoods.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/normals/registry.hpp>
#include <gnomon/simulation.hpp>

namespace {

constexpr int seeds = 5;

/// Mean gamma by method: of the seven of the thesis.
using ranking = std::map<std::string, double>;

/// Over all seeds, with every fifth point's neighbors as the policy finds it.
ranking rank(const auto& policy, double sigma) {
    ranking gammas;
    for (int seed = 1; seed <= seeds; ++seed) {
        const auto truth = gnomon::simulation::simulate(gnomon::simulation::box_and_cylinder{
            .sigma = sigma, .seed = static_cast<std::uint64_t>(seed)});
        const auto neighborhoods = sampled::neighborhoods_of(truth.scan, policy, 5);
        boost::hana::for_each(gnomon::thesis_estimators, [&](const auto& e) {
            gammas[e.name] += sampled::mean_gamma(e.policy, truth, neighborhoods) / seeds;
        });
    }
    return gammas;
}

void print(const std::string& what, const ranking& gammas) {
    std::printf("%-22s", what.c_str());
    for (const auto& [name, gamma] : gammas) std::printf("  %s %.4f", name.c_str(), gamma);
    std::printf("\n");
}

TEST(scenario_one, methods_rank_as_in_the_thesis_on_nearest_neighbors) {
    std::map<std::size_t, ranking> at;
    for (const std::size_t k : {10u, 30u, 50u}) {
        at[k] = rank(gnomon::knn{.k = k}, 0.015);
        print("k = " + std::to_string(k), at[k]);
    }
    for (const auto& [name, gamma] : at[30]) {  // more neighbors are never worse
        EXPECT_GE(gamma, at[10][name] - 0.002) << name;
        EXPECT_GE(at[50][name], gamma - 0.002) << name;
    }
    const auto first = {"plane_svd", "plane_pca"};
    const auto middle = {"quad_trans_svd", "quad_svd", "vector_svd"};
    const auto last = {"area_weighted", "angle_weighted"};
    for (const char* a : first) {
        for (const char* b : middle) EXPECT_GT(at[30][a], at[30][b]) << a << " " << b;
    }
    for (const char* a : middle) {
        for (const char* b : last) EXPECT_GT(at[30][a], at[30][b]) << a << " " << b;
    }
}

TEST(scenario_one, all_methods_suffer_from_noise_on_delaunay_stars) {
    std::map<double, ranking> at;
    const std::array<double, 4> sigmas{0.001, 0.005, 0.010, 0.015};
    const auto five = {"plane_svd", "plane_pca", "vector_svd", "area_weighted", "angle_weighted"};
    for (const double sigma : sigmas) {
        at[sigma] = rank(gnomon::delaunay{}, sigma);
        print("Delaunay, " + std::to_string(sigma), at[sigma]);
    }
    for (std::size_t i = 1; i < sigmas.size(); ++i) {
        for (const char* name : five)
            EXPECT_LT(at[sigmas[i]][name], at[sigmas[i - 1]][name]) << name;
    }
    // Six neighbors are few: twenty are better, for what does not need their order.
    for (const double sigma : {0.005, 0.015}) {
        ranking nearest = rank(gnomon::knn{.k = 20}, sigma);
        print("k = 20, " + std::to_string(sigma), nearest);
        for (const char* name : {"plane_svd", "plane_pca", "vector_svd"})
            EXPECT_GE(nearest[name], at[sigma][name]) << name;
    }
}

}  // namespace
