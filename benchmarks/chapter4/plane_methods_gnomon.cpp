// SPDX-License-Identifier: BSL-1.0
// Ours: planes, and the smooth surfaces of Alg. 4.2.
#include <array>
#include <cstddef>
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

constexpr std::size_t few = 20;                           // neighbors, as segment_planes recommends
constexpr std::array<double, 2> flat_angles{15.0, 30.0};  // between a normal and its plane's

/// @param noise  of points [m]; they are on a plane within three times as much
labels flat(const cloud& scene, std::size_t k, double noise,
            gnomon::segment_planes_options options) {
    const auto graph = knn{k}(scene.points, threads{});
    const auto surface =
        gnomon::estimate_normals(scene.points, graph, gnomon::plane_pca{}, threads{});
    options.noise = gnomon::constant_noise{noise};
    const auto found = gnomon::segment_planes(scene.points, graph, surface, options, threads{});
    return {found.labels().begin(), found.labels().end()};
}

labels smooth(const cloud& scene, const knn& policy,
              const gnomon::segment_surfaces_options& options) {
    const auto surface =
        gnomon::estimate_normals(scene.points, policy, gnomon::plane_pca{}, threads{});
    const auto found = gnomon::segment_surfaces(scene.points, surface, options, threads{});
    return {found.labels().begin(), found.labels().end()};
}

}  // namespace

std::vector<method> gnomon_methods() {
    method planes{"gnomon segment_planes", {}};
    planes.settings.push_back(
        {"defaults", [](const cloud& scene) { return flat(scene, few, scene.noise, {}); }});
    for (const std::size_t k : ks) {
        for (const double angle : flat_angles) {
            for (const double deviations : deviations_of_noise) {
                for (const std::size_t least : least_points) {
                    planes.settings.push_back(
                        {assigned("k", k) + " " + assigned("angle", angle) + " " +
                             assigned("distance/noise", deviations) + " " + assigned("min", least),
                         [=](const cloud& scene) {
                             return flat(scene, k, deviations / 3.0 * scene.noise,
                                         {.max_angle = degrees(angle), .min_points = least});
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
