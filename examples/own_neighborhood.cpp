// SPDX-License-Identifier: BSL-1.0
// How do I use a neighborhood of my own? In an organized cloud the neighbors are the pixels
// around, without a search.
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "common/help.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

namespace sim = gnomon::simulation;

// [own_neighborhood]
// Called with points, an execution and a projection, it gives a graph: for each point the indices
// of its neighbors. It must leave out neighbors that are not finite.
struct pixels_around {
    std::size_t width;
    std::size_t reach = 2;

    template <class R, class X = gnomon::sequential, class Proj = std::identity>
    std::vector<std::vector<gnomon::point_index>> operator()(const R& points, const X& = {},
                                                             Proj projection = {}) const {
        const gnomon::position_view<R, Proj> p(points, projection);
        std::vector<std::vector<gnomon::point_index>> graph(p.size());
        for (std::size_t i = 0; i < p.size(); ++i) {
            const std::size_t x = i % width;
            const std::size_t first = i / width - std::min(reach, i / width);
            const std::size_t last = std::min(i / width + reach, p.size() / width - 1);
            for (std::size_t row = first; row <= last; ++row) {
                for (std::size_t column = x - std::min(reach, x);
                     column <= std::min(x + reach, width - 1); ++column) {
                    const std::size_t j = row * width + column;
                    if (j == i || !gnomon::is_finite(p[j])) continue;
                    graph[i].push_back(static_cast<gnomon::point_index>(j));
                }
            }
        }
        return graph;
    }
};
static_assert(gnomon::neighborhood<pixels_around, gnomon::scan>);
// [own_neighborhood]

int main(int argc, char** argv) {
    if (printed_help(argc, argv, "Compares a neighborhood of its own with one of the library."))
        return 0;
    const sim::scene kitchen = sim::scenes::kitchen();
    const auto truth = sim::simulate(kitchen, sim::vertical{.mount = kitchen.sensor});
    const std::size_t width = sim::scanner().beams();
    const auto report = [&](const char* name, const auto& neighborhood) {
        const auto surface =
            gnomon::estimate_normals(truth.scan, neighborhood, gnomon::plane_pca{});
        std::printf("%-14s gamma = %.3f\n", name, gnomon::mean_gamma(surface, truth.normals));
    };
    report("pixels_around", pixels_around{.width = width});
    report("knn", gnomon::knn{.k = 24});
    return 0;
}
