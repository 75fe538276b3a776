// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <queue>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core/execution.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/segmentation/detail/separate_parts.hpp>

namespace {

using gnomon::point_index;
using neighbor_lists = std::vector<std::vector<point_index>>;
using label_list = gnomon::detail::scratch<std::int32_t>;

/// The parts of each label, by breadth-first search.
std::map<std::int32_t, std::vector<std::set<std::size_t>>> parts_of(const neighbor_lists& graph,
                                                                    const label_list& labels) {
    neighbor_lists both = graph;
    for (std::size_t i = 0; i < graph.size(); ++i)
        for (const point_index j : graph[i]) both[j].push_back(static_cast<point_index>(i));
    std::vector<bool> is_known(labels.size(), false);
    std::map<std::int32_t, std::vector<std::set<std::size_t>>> parts;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (labels[i] == gnomon::unlabeled || is_known[i]) continue;
        std::set<std::size_t> part;
        std::queue<std::size_t> next({i});
        is_known[i] = true;
        while (!next.empty()) {
            const std::size_t at = next.front();
            next.pop();
            part.insert(at);
            for (const point_index j : both[at]) {
                if (is_known[j] || labels[j] != labels[i]) continue;
                is_known[j] = true;
                next.push(j);
            }
        }
        parts[labels[i]].push_back(part);
    }
    return parts;
}

TEST(separate_parts, leaves_regions_that_neighbors_connect) {
    constexpr std::size_t n = 300, min_points = 3;
    gnomon::random_stream random(1);
    int separated = 0;
    for (int trial = 0; trial < 200; ++trial) {
        neighbor_lists graph(n);
        for (auto& neighbors : graph)
            for (int k = 0; k < 2; ++k)
                neighbors.push_back(static_cast<point_index>(random.below(n)));
        label_list labels;
        for (std::size_t i = 0; i < n; ++i)
            labels.push_back(static_cast<std::int32_t>(random.below(5)) - 1);
        const auto before = parts_of(graph, labels);
        label_list after = labels, on_threads = labels;
        const bool any = separate_parts(graph, after, min_points, gnomon::sequential{});
        EXPECT_EQ(separate_parts(graph, on_threads, min_points, gnomon::threads{3}), any);
        EXPECT_EQ(after, on_threads);
        EXPECT_EQ(after != labels, any);
        separated += any ? 1 : 0;
        std::set<std::int32_t> used;
        for (const auto& [label, parts] : before) {
            const auto size = [](const auto& part) { return part.size(); };
            const std::size_t largest = std::ranges::max(parts, {}, size).size();
            bool is_kept = false;
            for (const auto& part : parts) {
                const std::int32_t now = after[*part.begin()];
                for (const std::size_t i : part) ASSERT_EQ(after[i], now);
                if (now == label) {
                    is_kept = is_kept || part.size() == largest;
                    EXPECT_TRUE(part.size() == largest || part.size() < min_points);
                } else {
                    EXPECT_GE(part.size(), min_points);
                    EXPECT_TRUE(used.insert(now).second) << "one label for two parts";
                }
            }
            EXPECT_TRUE(is_kept);
        }
        EXPECT_FALSE(separate_parts(graph, after, min_points, gnomon::sequential{}));
    }
    EXPECT_GT(separated, 100);
}

TEST(separate_parts, accepts_nothing) {
    label_list none;
    EXPECT_FALSE(separate_parts(neighbor_lists{}, none, 1, gnomon::sequential{}));
}

}  // namespace
