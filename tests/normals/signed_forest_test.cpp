// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/normals/detail/signed_forest.hpp>

namespace {

using gnomon::detail::sign_link, gnomon::detail::signed_forest;
using links = std::vector<sign_link>;

double cosine(double degrees) { return cos(gnomon::degrees(degrees)); }

/// Of two equal halves the one of the stronger link is the core, wherever it stands.
TEST(signed_forest, the_core_has_the_stronger_link) {
    for (const bool front : {true, false}) {
        const double first = cosine(front ? 10 : 20);
        const double last = cosine(front ? 20 : 10);
        const signed_forest halves(4, links{{first, 0, 1}, {cosine(40), 1, 2}, {last, 2, 3}});
        EXPECT_EQ(halves.way(0).weakest, front ? cosine(10) : cosine(40));
        EXPECT_EQ(halves.way(3).weakest, front ? cosine(40) : cosine(10));
    }
}

/// Oracle: the strength of the strongest path between each two of n points, that is of its weakest
/// link; 0 where there is no path.
std::vector<std::vector<double>> strongest_paths(std::size_t n, const links& all) {
    std::vector<std::vector<double>> best(n, std::vector<double>(n, 0.0));
    for (const sign_link& l : all)
        best[l.a][l.b] = best[l.b][l.a] = std::max(best[l.a][l.b], l.strength());
    for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j < n; ++j)
                best[i][j] = std::max(best[i][j], std::min(best[i][k], best[k][j]));
        }
    }
    return best;
}

/// From loose points to a dense graph, of random links that may contradict each other.
TEST(signed_forest, follows_the_strongest_paths) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        gnomon::random_stream random(seed);
        const std::size_t n = 2 + random.below(30);
        links all(random.below(4 * n));
        for (sign_link& l : all) {
            l.b = static_cast<gnomon::point_index>(1 + random.below(n - 1));
            l.a = static_cast<gnomon::point_index>(random.below(l.b));
            l.relation = random.uniform(-1.0, 1.0);
        }
        const auto best = strongest_paths(n, all);
        const signed_forest forest(n, all);
        for (std::size_t i = 0; i < n; ++i) {
            const auto way = forest.way(i);
            const double to_core =
                way.core == i ? *std::ranges::max_element(best[i]) : best[i][way.core];
            ASSERT_EQ(way.weakest, to_core) << "seed " << seed;
            for (std::size_t j = 0; j < n; ++j)
                ASSERT_EQ(way.core == forest.way(j).core, i == j || best[i][j] > 0.0);
        }
        for (const sign_link& l : all) {
            const bool is_strongest = l.strength() == best[l.a][l.b];
            const double sign = forest.way(l.a).sign * forest.way(l.b).sign;
            ASSERT_TRUE(!is_strongest || sign * l.relation > 0.0) << "seed " << seed;
        }
    }
}

TEST(signed_forest, numbers_trees_by_size) {
    // {0, 4}, {1, 2, 3}, {5}, {6, 7}, the last two not counted.
    const signed_forest forest(8, links{{1.0, 0, 4}, {0.5, 1, 2}, {-0.5, 2, 3}, {1.0, 6, 7}});
    std::vector<std::int32_t> number(8, -1);
    EXPECT_EQ(forest.number_trees([](std::size_t i) { return i < 6; }, number), 3u);
    EXPECT_EQ(number, (std::vector<std::int32_t>{1, 0, 0, 0, 1, 2, -1, -1}));
}

}  // namespace
