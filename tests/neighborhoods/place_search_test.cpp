// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "neighborhoods/sweep_clouds.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/neighborhoods/detail/leaf_search.hpp>
#include <gnomon/neighborhoods/detail/leaf_tree.hpp>
#include <gnomon/neighborhoods/detail/place_search.hpp>
#include <gnomon/neighborhoods/detail/place_set.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace {

using gnomon::detail::leaf_tree, gnomon::detail::nearest_wanted;

/// The places that a search finds for each place, ascending.
std::vector<std::vector<std::uint32_t>> all_found(const leaf_tree& tree, auto search) {
    std::vector<std::vector<std::uint32_t>> found(tree.size());
    for (std::size_t g = 0; g < tree.groups(); ++g) {
        search(g, [&](std::size_t place, std::span<const std::uint32_t> places) {
            EXPECT_TRUE(found[place].empty()) << "visited twice";
            found[place].assign(places.begin(), places.end());
            std::ranges::sort(found[place]);
        });
    }
    return found;
}

/// On crowded clouds too, though there the other one takes its time.
TEST(place_search, finds_what_leaf_search_finds) {
    for (const auto& [name, points] : clouds::to_sweep()) {
        const gnomon::spatial_index index(points);
        const leaf_tree& tree = index.tree();
        if (tree.size() == 0) continue;
        SCOPED_TRACE(name);
        gnomon::detail::place_set some;
        some.assign_if(tree, [](std::size_t i) { return i % 3 == 1; });
        for (const nearest_wanted& wanted :
             {nearest_wanted{.k = 1}, nearest_wanted{.k = 26},
              nearest_wanted{.k = 9, .ties = gnomon::tie_rule::all},
              nearest_wanted{.k = 30, .radius = 0.1}, nearest_wanted{.k = 12, .of = &some}}) {
            const gnomon::detail::distances_from_points distances(tree);
            EXPECT_EQ(all_found(tree, gnomon::detail::place_search(tree, wanted, distances)),
                      all_found(tree, gnomon::detail::leaf_search(tree, wanted, distances)));
        }
    }
}

}  // namespace
