// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core/subset_view.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/gamma.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/segmentation/euclidean_clusters.hpp>
#include <gnomon/segmentation/segment_surfaces.hpp>
#include <gnomon/simulation/simulate.hpp>
#include <gnomon/simulation/thesis_scenes.hpp>

namespace sim = gnomon::simulation;

namespace {

const sim::scene kitchen = sim::scenes::kitchen();

/// The points that were seen through the back of chair 2: between its slats, or all that would be
/// seen if it were not there.
std::vector<gnomon::point_index> seen_through_back(const sim::true_scan& truth,
                                                   const std::string& surface) {
    std::vector<gnomon::point_index> through;
    for (std::size_t i = 0; i < truth.scan.size(); ++i) {
        const Eigen::Vector3d v = truth.scan.viewpoints[i];
        const Eigen::Vector3d& u = truth.directions[i];
        const Eigen::Vector3d p = v + (1.355 - v.x()) / u.x() * u;  // in the plane of the back
        const bool in_back =
            u.x() > 0.0 && std::abs(p.y() - 0.25) < 0.21 && std::abs(p.z() - 0.675) < 0.225;
        const bool behind = truth.scan.points[i].x() > 1.76;  // and not the chair itself
        const std::string name = kitchen.surface_name(truth.surfaces[i]);
        if (in_back && behind && name == surface)
            through.push_back(static_cast<gnomon::point_index>(i));
    }
    return through;
}

/// How many pieces of a surface are seen through the back of chair 2, from `sensor`.
std::size_t fragments_behind_lattice(const sim::pose& sensor, const std::string& surface) {
    const auto truth = sim::simulate(kitchen, sim::rotational{.mount = sensor});
    const auto through = seen_through_back(truth, surface);
    return gnomon::euclidean_clusters(gnomon::subset_view(truth.scan, through),
                                      {.radius = 0.05, .min_points = 10})
        .size();
}

/// Fig. 4.8: the five slats leave four gaps. From where the sensor stands they show the floor, from
/// the height of the back the wall and what stands there, in pieces.
TEST(simulated_kitchen, lattice_splits_the_surface_behind_it) {
    const std::size_t floor = fragments_behind_lattice(kitchen.sensor, "room/floor/plane");
    const sim::pose level = sim::at(0.3, 0.25, 0.75);
    const std::size_t wall = fragments_behind_lattice(level, "room/wall +x/plane");
    std::printf("behind the lattice: %zu pieces of floor, %zu pieces of wall\n", floor, wall);
    EXPECT_GE(floor, 4u);
    EXPECT_GE(wall, 4u);
}

/// Fig. 2.16: the surface variation of 30 neighbors stands out at edges, at each density.
TEST(simulated_kitchen, surface_variation_shows_the_edges) {
    for (const auto& finder :
         {sim::densities::low(), sim::densities::medium(), sim::densities::high()}) {
        const auto truth = sim::simulate(kitchen, sim::rotational{.mount = kitchen.sensor}, finder);
        const auto graph = gnomon::knn{.k = 30}(truth.scan);
        const auto surface = gnomon::estimate_normals(truth.scan, graph, gnomon::plane_pca{});
        double sum[2] = {0.0, 0.0};
        double count[2] = {0.0, 0.0};
        for (std::size_t i = 0; i < truth.scan.size(); ++i) {
            bool at_edge = false;
            for (const auto j : graph[i]) {
                at_edge = at_edge || truth.surfaces[j] != truth.surfaces[i];
            }
            sum[at_edge] += surface[i].surface_variation();
            ++count[at_edge];
        }
        ASSERT_GT(count[0], 100.0);
        ASSERT_GT(count[1], 100.0);
        EXPECT_GT(sum[1] / count[1], 3.0 * sum[0] / count[0]);
    }
}

/// The whole chain on a scan whose truth is known: each of the large surfaces is one segment that
/// holds most of its points.
TEST(simulated_kitchen, large_surfaces_are_found) {
    const auto truth =
        sim::simulate(kitchen, sim::rotational{.mount = kitchen.sensor}, {}, {.sigma = 0.015});
    const auto surface =
        gnomon::estimate_normals(truth.scan, gnomon::knn{.k = 50}, gnomon::plane_pca{});
    const double gamma = gnomon::mean_gamma(surface, truth.normals);
    const auto parts = gnomon::segment_surfaces(truth.scan, surface);
    std::printf("gamma %.3f, %zu segments\n", gamma, parts.size());
    EXPECT_GT(gamma, 0.95);
    for (const char* name : {"room/floor/plane", "room/ceiling/plane", "room/wall +x/plane",
                             "room/wall -y/plane", "room/wall +y/plane", "table/top/+z"}) {
        const std::int32_t wanted = kitchen.find_surface(name);
        std::size_t all = 0;
        std::map<std::int32_t, std::size_t> held;
        for (std::size_t i = 0; i < truth.scan.size(); ++i) {
            if (truth.surfaces[i] != wanted) continue;
            ++all;
            ++held[parts.labels()[i]];
        }
        std::size_t most = 0;
        for (const auto& [label, count] : held) {
            if (label != gnomon::unlabeled) most = std::max(most, count);
        }
        EXPECT_GT(static_cast<double>(most), 0.8 * static_cast<double>(all)) << name;
    }
}

}  // namespace
