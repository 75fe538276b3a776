// SPDX-License-Identifier: BSL-1.0
// Ours: planes, and smooth surfaces with what they lost at their borders.
#include <cstddef>
#include <limits>
#include <vector>

#include "plane_methods.hpp"
#include <gnomon/core/angle.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/segmentation.hpp>

namespace planes {
namespace {

using gnomon::degrees;
using gnomon::knn;
using gnomon::threads;

constexpr std::size_t few = 12;  // neighbors to grow to, as in CGAL

labels flat(const cloud& scene, std::size_t k, gnomon::segment_planes_options options) {
    const auto graph = knn{k}(scene.points, threads{});
    const auto surface =
        gnomon::estimate_normals(scene.points, graph, gnomon::plane_pca{}, threads{});
    options.noise = scene.noise;
    return gnomon::segment_planes(scene.points, graph, surface, options, threads{})
        .segments.labels();
}

labels smooth(const cloud& scene, const knn& policy,
              const gnomon::segment_surfaces_options& options) {
    const auto surface =
        gnomon::estimate_normals(scene.points, policy, gnomon::plane_pca{}, threads{});
    const auto found = gnomon::segment_surfaces(scene.points, surface, options, threads{});
    const auto graph = knn{few}(scene.points, threads{});
    return gnomon::extend_segments(scene.points, graph, surface, found, {}, threads{}).labels();
}

}  // namespace

std::vector<method> gnomon_methods() {
    method planes{"gnomon segment_planes", {}};
    planes.settings.push_back(
        {"defaults", [](const cloud& scene) { return flat(scene, few, {}); }});
    for (const std::size_t k : ks) {
        for (const double angle : {25.0, 45.0}) {
            for (const double deviations : deviations_of_noise) {
                for (const std::size_t least : least_points) {
                    planes.settings.push_back({assigned("k", k) + " " + assigned("angle", angle) +
                                                   " " + assigned("distance/noise", deviations) +
                                                   " " + assigned("min", least),
                                               [=](const cloud& scene) {
                                                   return flat(scene, k,
                                                               {.max_deviations = deviations,
                                                                .max_angle = degrees(angle),
                                                                .min_points = least});
                                               }});
                }
            }
        }
    }
    method surfaces{"gnomon segment_surfaces", {}};
    surfaces.settings.push_back(
        {"defaults", [](const cloud& scene) { return smooth(scene, {}, {}); }});
    for (const std::size_t k : ks) {
        for (const double angle : smooth_angles) {
            for (const std::size_t least : least_points) {
                surfaces.settings.push_back(
                    {assigned("k", k) + " " + assigned("angle", angle) + " " +
                         assigned("min", least),
                     [=](const cloud& scene) {
                         return smooth(scene, {.k = k},
                                       {.max_angle = degrees(angle), .min_points = least});
                     }});
            }
        }
    }
    return {planes, surfaces};
}

}  // namespace planes
