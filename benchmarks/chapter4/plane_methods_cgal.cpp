// SPDX-License-Identifier: BSL-1.0
// Planes of CGAL: regions that grow, and efficient RANSAC (Schnabel et al. 2007).
#include <cstddef>
#include <iterator>
#include <tuple>
#include <vector>

#include "plane_methods.hpp"
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Shape_detection/Efficient_RANSAC.h>
#include <CGAL/Shape_detection/Region_growing/Region_growing.h>
#include <CGAL/Shape_detection/Region_growing/Region_growing_on_point_set.h>
#include <CGAL/pca_estimate_normals.h>
#include <CGAL/property_map.h>

namespace planes {
namespace {

using kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using point = std::tuple<kernel::Point_3, kernel::Vector_3, std::size_t>;  // with its number
using points_with_normals = std::vector<point>;
using point_map = CGAL::Nth_of_tuple_property_map<0, point>;
using normal_map = CGAL::Nth_of_tuple_property_map<1, point>;

points_with_normals estimated(const cloud& scene, unsigned k) {
    points_with_normals points;
    for (const Eigen::Vector3d& p : scene.points)
        points.emplace_back(kernel::Point_3(p.x(), p.y(), p.z()), kernel::Vector_3(0, 0, 0),
                            points.size());
    CGAL::pca_estimate_normals<CGAL::Sequential_tag>(
        points, k, CGAL::parameters::point_map(point_map()).normal_map(normal_map()));
    return points;
}

points_with_normals with_normals(const cloud& scene, unsigned k) {
    thread_local latest<points_with_normals> made;
    return made(scene, k, [&] { return estimated(scene, k); });
}

namespace sd = CGAL::Shape_detection::Point_set;
using neighbor_query = sd::K_neighbor_query<kernel, points_with_normals, point_map>;
using plane_region =
    sd::Least_squares_plane_fit_region<kernel, points_with_normals, point_map, normal_map>;
using plane_sorting =
    sd::Least_squares_plane_fit_sorting<kernel, points_with_normals, neighbor_query, point_map>;

labels grown(const cloud& scene, unsigned k, plane_region& region, points_with_normals& points) {
    neighbor_query neighbors(points, k);
    plane_sorting sorting(points, neighbors);
    sorting.sort();
    CGAL::Shape_detection::Region_growing growing(points, neighbors, region, sorting.seed_map());
    std::vector<std::vector<std::size_t>> regions;
    growing.detect(std::back_inserter(regions));
    return labels_of(scene.points.size(), regions);
}

method region_growing() {
    method growing{"CGAL Region_growing", {}};
    constexpr unsigned default_k = 12;  // of the neighbor query; normals have none
    growing.settings.push_back({"defaults", [](const cloud& scene) {
                                    auto points = with_normals(scene, default_k);
                                    plane_region region(points);
                                    return grown(scene, default_k, region, points);
                                }});
    for (const std::size_t k : ks) {
        for (const double angle : {25.0, 45.0}) {
            for (const double distance : deviations_of_noise) {
                for (const std::size_t least : least_points) {
                    growing.settings.push_back(
                        {assigned("k", k) + " " + assigned("angle", angle) + " " +
                             assigned("distance/noise", distance) + " " + assigned("min", least),
                         [=](const cloud& scene) {
                             auto points = with_normals(scene, static_cast<unsigned>(k));
                             plane_region region(points, distance * scene.noise, angle, least);
                             return grown(scene, static_cast<unsigned>(k), region, points);
                         }});
                }
            }
        }
    }
    return growing;
}

using ransac_traits = CGAL::Shape_detection::Efficient_RANSAC_traits<kernel, points_with_normals,
                                                                     point_map, normal_map>;
using ransac = CGAL::Shape_detection::Efficient_RANSAC<ransac_traits>;

/// `detect` calls detect() with parameters or without.
labels consensus(const cloud& scene, unsigned k, auto&& detect) {
    auto points = with_normals(scene, k);
    CGAL::get_default_random() = CGAL::Random(1);
    ransac search;
    search.set_input(points);
    search.add_shape_factory<CGAL::Shape_detection::Plane<ransac_traits>>();
    detect(search);
    std::vector<std::vector<std::size_t>> shapes;
    for (const auto& shape : search.shapes()) {
        shapes.emplace_back();
        for (const std::size_t i : shape->indices_of_assigned_points())  // of the reordered points
            shapes.back().push_back(std::get<2>(points[i]));
    }
    return labels_of(scene.points.size(), shapes);
}

method efficient_ransac() {
    method search{"CGAL Efficient_RANSAC", {}};
    search.settings.push_back({"defaults", [](const cloud& scene) {
                                   return consensus(scene, 12, [](ransac& r) { r.detect(); });
                               }});
    for (const std::size_t k : ks) {
        for (const double cosine : {0.8, 0.9}) {
            for (const double distance : deviations_of_noise) {
                for (const double gap : {4.0, 8.0}) {
                    for (const std::size_t least : least_points) {
                        search.settings.push_back(
                            {assigned("k", k) + " " + assigned("cosine", cosine) + " " +
                                 assigned("distance/noise", distance) + " " +
                                 assigned("gap/spacing", gap) + " " + assigned("min", least),
                             [=](const cloud& scene) {
                                 ransac::Parameters p;
                                 p.min_points = least;
                                 p.epsilon = distance * scene.noise;
                                 p.cluster_epsilon = gap * scene.spacing;
                                 p.normal_threshold = cosine;
                                 return consensus(scene, static_cast<unsigned>(k),
                                                  [&](ransac& r) { r.detect(p); });
                             }});
                    }
                }
            }
        }
    }
    return search;
}

}  // namespace

std::vector<method> cgal_methods() { return {region_growing(), efficient_ransac()}; }

}  // namespace planes
