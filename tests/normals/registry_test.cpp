// SPDX-License-Identifier: BSL-1.0
// What holds for every estimator on every graph, run over the registry.
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <set>
#include <string>
#include <vector>

#include <boost/hana/for_each.hpp>
#include <boost/hana/size.hpp>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/estimator_laws.hpp"
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/registry.hpp>

namespace {

std::atomic<std::size_t> allocations{0};

/// Runs chunks on the calling thread and counts what they allocate.
struct counting {
    std::size_t* counted;

    void operator()(std::size_t chunks, std::invocable<std::size_t> auto&& work) const {
        const std::size_t before = allocations;
        for (std::size_t c = 0; c < chunks; ++c) work(c);
        *counted += allocations - before;
    }
};

}  // namespace

// Not inline, so that compilers do not warn about one function of a pair.
[[gnu::noinline]] void* operator new(std::size_t size) {
    ++allocations;
    if (void* memory = std::malloc(size)) return memory;
    throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    ++allocations;
    return std::malloc(size);
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
    ++allocations;
    const auto a = static_cast<std::size_t>(alignment);
    if (void* memory = std::aligned_alloc(a, (size + a - 1) / a * a)) return memory;
    throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    std::free(memory);
}

namespace {

namespace hana = boost::hana;

TEST(registry, names_are_unique_and_all_eight_of_the_thesis_are_there) {
    std::set<std::string> names;
    hana::for_each(gnomon::estimators,
                   [&](const auto& e) { EXPECT_TRUE(names.insert(e.name).second) << e.name; });
    EXPECT_EQ(names.size(), decltype(hana::size(gnomon::estimators))::value);
    for (const char* name : {"plane_svd", "plane_pca", "vector_svd", "quad_svd", "quad_trans_svd",
                             "area_weighted", "angle_weighted", "plane_ekf"})
        EXPECT_TRUE(names.contains(name)) << name;
    std::set<std::string> graphs;
    hana::for_each(gnomon::graphs,
                   [&](const auto& g) { EXPECT_TRUE(graphs.insert(g.name).second) << g.name; });
}

/// A graph that a policy of the registry gave: of one type for all, so that what is done with each
/// is compiled once.
struct named_graph {
    std::string name;
    gnomon::adjacency graph;
};

std::vector<named_graph> graphs_of(const clouds::cloud& points,
                                   const gnomon::threads& run = gnomon::threads{1}) {
    std::vector<named_graph> all;
    hana::for_each(gnomon::graphs, [&](const auto& g) {
        all.push_back({g.name, g.policy(points, run)});
    });
    return all;
}

/// Calls visit(name, surface) with the result of every estimator on every graph of `points`.
void for_each_surface(const clouds::cloud& points, auto&& visit) {
    const std::vector<named_graph> graphs = graphs_of(points);
    hana::for_each(gnomon::estimators, [&](const auto& e) {
        for (const named_graph& g : graphs)
            visit(std::string(e.name) + " on " + g.name,
                  gnomon::estimate_normals(points, g.graph, e.policy));
    });
}

TEST(registry, every_estimator_on_every_graph_survives_degenerate_clouds) {
    auto all = clouds::degenerate();
    all.push_back({"sheet", clouds::sheet(60, 1)});
    all.push_back({"cube of 1e-160 m", clouds::in_cube(60, 2)});
    for (Eigen::Vector3d& p : all.back().points) p *= 1e-160;
    for (const auto& cloud : all) {
        const clouds::cloud& points = cloud.points;
        for_each_surface(points, [&](const std::string& name, const auto& surface) {
            SCOPED_TRACE(name + ", " + cloud.name);
            ASSERT_EQ(surface.size(), points.size());
            for (std::size_t i = 0; i < points.size(); ++i) {
                const auto& s = surface[i];
                ASSERT_TRUE(s.normal.allFinite() && std::isfinite(s.mean_distance)) << i;
                ASSERT_TRUE(s.trust == gnomon::trust::not_finite || gnomon::is_finite(points[i]));
                ASSERT_NEAR(s.normal.norm(), gnomon::usable(s.trust) ? 1.0 : 0.0, 1e-12) << i;
                if constexpr (requires { s.covariance; }) {
                    laws::expect_covariance_of_an_axis(s);
                    if (HasFatalFailure()) return;
                }
            }
        });
    }
}

TEST(registry, results_are_the_same_bytes_on_any_number_of_threads) {
    const clouds::cloud points = clouds::sheet(1100, 8);  // two chunks
    const std::vector<named_graph> graphs = graphs_of(points);
    for (const unsigned t : {2u, 4u}) {
        const std::vector<named_graph> same = graphs_of(points, gnomon::threads{t});
        for (std::size_t g = 0; g < graphs.size(); ++g)
            ASSERT_EQ(same[g].graph, graphs[g].graph) << graphs[g].name;
    }
    hana::for_each(gnomon::estimators, [&](const auto& e) {
        for (const auto& [name, graph] : graphs) {
            SCOPED_TRACE(std::string(e.name) + " on " + name);
            const auto expected = gnomon::estimate_normals(points, graph, e.policy);
            for (const unsigned t : {2u, 4u}) {
                const auto found =
                    gnomon::estimate_normals(points, graph, e.policy, gnomon::threads{t});
                for (std::size_t i = 0; i < points.size(); ++i) {
                    ASSERT_EQ(found[i].normal, expected[i].normal);
                    ASSERT_EQ(found[i].trust, expected[i].trust);
                }
            }
        }
    });
}

/// The buffers of a chunk grow to the largest neighbors, which takes a few allocations, once. A
/// thousand points with one each would show.
TEST(registry, nothing_is_allocated_per_point) {
    const clouds::cloud points = clouds::sheet(1000, 9);
    hana::for_each(gnomon::graphs, [&](const auto& g) {
        hana::for_each(gnomon::estimators, [&](const auto& e) {
            SCOPED_TRACE(std::string(e.name) + " on " + g.name);
            std::size_t counted = 0;
            (void)gnomon::estimate_normals(points, g.policy, e.policy, counting{&counted});
            EXPECT_GT(counted, 0u);
            EXPECT_LT(counted, 50u);
        });
    });
}

}  // namespace
