// SPDX-License-Identifier: BSL-1.0
#include <cstddef>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/neighborhood_laws.hpp"
#include <gnomon/neighborhoods/adaptive_knn.hpp>
#include <gnomon/neighborhoods/angularly_sorted.hpp>
#include <gnomon/neighborhoods/delaunay.hpp>
#include <gnomon/neighborhoods/hybrid.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/neighborhoods/neighborhoods_into.hpp>
#include <gnomon/neighborhoods/radius.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/plane_svd.hpp>

namespace {

/// A user's own neighborhood: the points before and after, as along a scan line.
struct scan_line {
    template <class R, gnomon::execution X = gnomon::sequential, class Proj = std::identity>
    std::vector<std::vector<gnomon::point_index>> operator()(const R& points, const X& = {},
                                                             Proj projection = {}) const {
        const gnomon::position_view<R, Proj> p(points, projection);
        std::vector<std::vector<gnomon::point_index>> graph(p.size());
        for (std::size_t i = 1; i < p.size(); ++i) {
            if (!gnomon::is_finite(p[i - 1]) || !gnomon::is_finite(p[i])) continue;
            graph[i].push_back(static_cast<gnomon::point_index>(i - 1));
            graph[i - 1].push_back(static_cast<gnomon::point_index>(i));
        }
        return graph;
    }
};

static_assert(gnomon::indexed_neighborhood<gnomon::delaunay>);
static_assert(gnomon::indexed_neighborhood<gnomon::angularly_sorted<gnomon::radius>>);
static_assert(gnomon::sweeping_neighborhood<gnomon::knn>);
static_assert(gnomon::sweeping_neighborhood<gnomon::radius>);
static_assert(gnomon::sweeping_neighborhood<gnomon::hybrid>);
static_assert(!gnomon::sweeping_neighborhood<gnomon::delaunay>);
static_assert(gnomon::neighborhood<scan_line, clouds::cloud>);
static_assert(!gnomon::indexed_neighborhood<scan_line>);
static_assert(!gnomon::neighborhood<int, clouds::cloud>);
static_assert(!gnomon::neighborhood<gnomon::knn, std::vector<int>>);
static_assert(gnomon::neighborhood_graph<std::vector<std::vector<gnomon::point_index>>>);
static_assert(!gnomon::neighborhood_graph<std::vector<int>>);

/// The least that a sweeping policy has: knn, point after point.
struct plain_sweep {
    gnomon::knn policy{.k = 10};

    struct answer {
        std::vector<gnomon::neighbor> found;

        [[nodiscard]] std::size_t size() const { return found.size(); }
        template <class Allocator>
        void sort_into(std::vector<gnomon::neighbor, Allocator>& neighbors) const {
            neighbors.assign(found.begin(), found.end());
        }
    };

    gnomon::adjacency operator()(const auto& points, const auto& run, auto projection) const {
        return policy(points, run, projection);
    }
    void find(const gnomon::spatial_index& index, std::size_t i, auto& found) const {
        policy.find(index, i, found);
    }
    void sweep(const gnomon::spatial_index& index, const auto& run, auto make_visitor) const {
        run(1, [&](std::size_t) {
            auto visit = make_visitor();
            answer a;
            for (std::size_t i = 0; i < index.size(); ++i) {
                if (!index.is_finite(i)) continue;
                find(index, i, a.found);
                visit(i, a);
            }
            if constexpr (requires { visit.finish(); }) visit.finish();
        });
    }
};
static_assert(gnomon::sweeping_neighborhood<plain_sweep>);

/// A model of the minimal complete definition is enough.
TEST(neighborhood, a_sweep_needs_no_more_than_its_definition) {
    clouds::cloud points = clouds::sheet(500, 4);
    points[7].x() = std::numeric_limits<double>::quiet_NaN();
    gnomon::adjacency graph;
    gnomon::neighborhoods_into(graph, points, plain_sweep{});
    EXPECT_EQ(graph, gnomon::knn{.k = 10}(points));
    const auto expected =
        gnomon::estimate_normals(points, gnomon::knn{.k = 10}, gnomon::plane_svd{});
    const auto surface = gnomon::estimate_normals(points, plain_sweep{}, gnomon::plane_svd{});
    for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_EQ(surface[i].normal, expected[i].normal);
}

TEST(neighborhood, laws_hold_for_every_model_on_every_cloud) {
    auto all = clouds::degenerate();
    all.push_back({"cube", clouds::in_cube(3000, 1)});
    all.push_back({"sheet", clouds::sheet(3000, 2)});
    for (const auto& [name, points] : all) {
        SCOPED_TRACE(name);
        for (const std::size_t k : {1u, 2u, 10u, 50u}) {
            laws::neighborhood_laws(gnomon::knn{k}, points);
            laws::neighborhood_laws(gnomon::knn{k, gnomon::tie_rule::all}, points);
        }
        for (const double r : {0.0, 0.03, 0.25}) laws::neighborhood_laws(gnomon::radius{r}, points);
        for (const double r : {0.0, 0.1, 1e9})
            laws::neighborhood_laws(gnomon::hybrid{9, r}, points);
        laws::neighborhood_laws(gnomon::adaptive_knn<>{.min_k = 5, .max_k = 40}, points);
        laws::neighborhood_laws(gnomon::adaptive_knn<gnomon::prefer_low_entropy>{.growth = 1.2},
                                points);
        laws::neighborhood_laws(gnomon::adaptive_knn<gnomon::prefer_small_error>{}, points);
        for (const std::size_t k : {3u, 20u}) laws::neighborhood_laws(gnomon::delaunay{k}, points);
        laws::neighborhood_laws(gnomon::angularly_sorted{gnomon::knn{9}}, points);
        laws::neighborhood_laws(gnomon::angularly_sorted{gnomon::radius{0.1}}, points);
        laws::neighborhood_laws(scan_line{}, points);
    }
}

TEST(neighborhood, policies_without_an_order_of_their_own_list_the_nearest_first) {
    for (const auto& points : {clouds::sheet(500, 1), clouds::on_grid(500, 2)}) {
        laws::neighbors_are_in_canonical_order(gnomon::knn{9}, points);
        laws::neighbors_are_in_canonical_order(gnomon::radius{0.2}, points);
        laws::neighbors_are_in_canonical_order(gnomon::hybrid{9, 0.1}, points);
        laws::neighbors_are_in_canonical_order(gnomon::adaptive_knn<>{}, points);
    }
}

}  // namespace
