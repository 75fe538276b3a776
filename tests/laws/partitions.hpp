// SPDX-License-Identifier: BSL-1.0
/// @file
/// Comparing partitions: the Rand index, and an oracle for connected components.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <gnomon/core/point.hpp>

namespace laws {

/// The share of pairs of points that both labelings put together or both keep apart (Rand 1971).
/// Unlabeled points count as one group.
inline double rand_index(const std::vector<std::int32_t>& a, const std::vector<std::int32_t>& b) {
    std::map<std::pair<std::int32_t, std::int32_t>, double> both;
    std::map<std::int32_t, double> in_a, in_b;
    for (std::size_t i = 0; i < a.size(); ++i) {
        ++both[{a[i], b[i]}];
        ++in_a[a[i]];
        ++in_b[b[i]];
    }
    const auto pairs = [](double n) { return 0.5 * n * (n - 1.0); };
    double together = 0.0, apart_a = 0.0, apart_b = 0.0;
    for (const auto& [key, n] : both) together += pairs(n);
    for (const auto& [key, n] : in_a) apart_a += pairs(n);
    for (const auto& [key, n] : in_b) apart_b += pairs(n);
    const double all = pairs(static_cast<double>(a.size()));
    return all > 0.0 ? (all + 2.0 * together - apart_a - apart_b) / all : 1.0;
}

/// The components of the graph over n nodes that joins i < j where linked(i, j), by depth-first
/// search over all pairs: each node's smallest companion.
std::vector<gnomon::point_index> components_by_brute_force(std::size_t n, auto&& linked) {
    constexpr auto unseen = static_cast<gnomon::point_index>(-1);
    std::vector<gnomon::point_index> smallest(n, unseen);
    std::vector<std::size_t> stack;
    for (std::size_t root = 0; root < n; ++root) {
        if (smallest[root] != unseen) continue;
        smallest[root] = static_cast<gnomon::point_index>(root);
        stack.push_back(root);
        while (!stack.empty()) {
            const std::size_t i = stack.back();
            stack.pop_back();
            for (std::size_t j = 0; j < n; ++j) {
                if (smallest[j] != unseen || !linked(i, j)) continue;
                smallest[j] = static_cast<gnomon::point_index>(root);
                stack.push_back(j);
            }
        }
    }
    return smallest;
}

/// The labels that a segmentation must give to such components: largest first, ties by the smallest
/// index, groups under `min_points` and nodes that do not count unlabeled.
std::vector<std::int32_t> expected_labels(const std::vector<gnomon::point_index>& smallest,
                                          std::size_t min_points, auto&& counts) {
    std::map<gnomon::point_index, std::size_t> sizes;
    for (std::size_t i = 0; i < smallest.size(); ++i) sizes[smallest[i]] += counts(i);
    std::map<std::pair<std::size_t, gnomon::point_index>, std::int32_t> order;
    for (const auto& [root, size] : sizes) {
        if (size > 0 && size >= min_points) order[{smallest.size() - size, root}] = 0;
    }
    std::map<gnomon::point_index, std::int32_t> label;
    std::int32_t next = 0;
    for (const auto& [key, unused] : order) label[key.second] = next++;
    std::vector<std::int32_t> labels(smallest.size(), -1);
    for (std::size_t i = 0; i < smallest.size(); ++i) {
        const auto found = label.find(smallest[i]);
        if (found != label.end()) labels[i] = found->second;
    }
    return labels;
}

}  // namespace laws
