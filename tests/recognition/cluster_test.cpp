// SPDX-License-Identifier: BSL-1.0
#include <gtest/gtest.h>

#include "samples.hpp"
#include <gnomon/recognition/cluster.hpp>

namespace {

using gnomon::recognition::cluster_statistics;

/// Mean and scatter by their definitions, in two passes.
template <std::size_t D>
cluster_statistics<D> defined(const samples::rows<D>& x) {
    cluster_statistics<D> c;
    c.count = x.size();
    for (const auto& row : x)
        for (std::size_t i = 0; i < D; ++i) c.mean[i] += row[i] / static_cast<double>(x.size());
    for (const auto& row : x)
        for (std::size_t i = 0; i < D; ++i)
            for (std::size_t j = 0; j < D; ++j)
                c.scatter[i][j] += (row[i] - c.mean[i]) * (row[j] - c.mean[j]);
    return c;
}

template <std::size_t D>
void expect_near(const cluster_statistics<D>& a, const cluster_statistics<D>& b, double tolerance) {
    EXPECT_EQ(a.count, b.count);
    const auto ca = a.covariance(), cb = b.covariance();
    for (std::size_t i = 0; i < D; ++i) {
        EXPECT_NEAR(a.mean[i], b.mean[i], tolerance);
        for (std::size_t j = 0; j < D; ++j) {
            EXPECT_NEAR(ca[i][j], cb[i][j], tolerance);
            EXPECT_EQ(ca[i][j], ca[j][i]);
        }
    }
}

TEST(cluster_statistics, are_those_of_the_definition) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        gnomon::random_stream random(seed);
        const auto x = samples::correlated<5>(2 + seed * 10, 0.3, {.1, .2, .3, .4, .5}, random);
        cluster_statistics<5> one_by_one, first, second;
        for (std::size_t i = 0; i < x.size(); ++i) {
            one_by_one.add(x[i]);
            (i < x.size() / 3 ? first : second).add(x[i]);
        }
        expect_near(one_by_one, defined(x), 1e-12);
        first.merge(second);
        expect_near(first, defined(x), 1e-12);
    }
}

TEST(cluster_statistics, keep_their_digits_far_from_the_origin) {
    gnomon::random_stream random(3);
    const auto near = samples::gaussian<2>(500, random);
    cluster_statistics<2> here, there;
    for (auto x : near) {
        here.add(x);
        x[0] += 4.8e6;
        there.add(x);
    }
    EXPECT_NEAR(here.covariance()[0][0], there.covariance()[0][0], 1e-8);
    EXPECT_NEAR(here.covariance()[0][1], there.covariance()[0][1], 1e-8);
}

TEST(cluster_statistics, of_nothing_change_nothing) {
    cluster_statistics<3> c, one;
    c.merge(cluster_statistics<3>{});
    EXPECT_EQ(c, (cluster_statistics<3>{}));
    EXPECT_EQ(c.covariance()[0][0], 0.0);
    one.add({1e-3, 1.0, 1e17});
    const auto before = one;
    one.merge(c);
    EXPECT_EQ(one, before);
    EXPECT_EQ(one.mean, (std::array<double, 3>{1e-3, 1.0, 1e17}));
    c.merge(one);
    EXPECT_EQ(c, one);
}

TEST(clustering, lists_its_members) {
    gnomon::recognition::clustering<1> c;
    c.labels = {0, 1, -1, 0, -1};
    EXPECT_EQ(c.members(0), (std::vector<std::size_t>{0, 3}));
    EXPECT_EQ(c.members(1), (std::vector<std::size_t>{1}));
    EXPECT_EQ(c.members(c.pruned), (std::vector<std::size_t>{2, 4}));
    EXPECT_TRUE(c.members(2).empty());
}

}  // namespace
