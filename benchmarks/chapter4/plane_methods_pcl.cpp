// SPDX-License-Identifier: BSL-1.0
// Region growing of the Point Cloud Library.
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "plane_methods.hpp"
#include <pcl/features/normal_3d.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/segmentation/region_growing.h>

namespace planes {
namespace {

using points_and_normals =
    std::pair<pcl::PointCloud<pcl::PointXYZ>::Ptr, pcl::PointCloud<pcl::Normal>::Ptr>;

points_and_normals estimated(const cloud& scene, int k) {
    const points_and_normals made(new pcl::PointCloud<pcl::PointXYZ>,
                                  new pcl::PointCloud<pcl::Normal>);
    for (const Eigen::Vector3d& p : scene.points) {
        const Eigen::Vector3f q = p.cast<float>();
        made.first->emplace_back(q.x(), q.y(), q.z());
    }
    pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimate;
    estimate.setInputCloud(made.first);
    estimate.setKSearch(k);
    estimate.compute(*made.second);
    return made;
}

/// `configure` changes what the class has as defaults.
labels grown(const cloud& scene, int k, auto&& configure) {
    thread_local latest<points_and_normals> made;
    const auto& [points, normals] =
        made(scene, static_cast<std::size_t>(k), [&] { return estimated(scene, k); });
    pcl::RegionGrowing<pcl::PointXYZ, pcl::Normal> growing;
    growing.setInputCloud(points);
    growing.setInputNormals(normals);
    configure(growing);
    std::vector<pcl::PointIndices> clusters;
    growing.extract(clusters);
    std::vector<pcl::Indices> lists;
    for (const pcl::PointIndices& c : clusters) lists.push_back(c.indices);
    return labels_of(scene.points.size(), lists);
}

}  // namespace

std::vector<method> pcl_methods() {
    method growing{"PCL RegionGrowing", {}};
    // Normals have no default; 30 is that of the neighbors to grow to.
    growing.settings.push_back(
        {"defaults", [](const cloud& scene) { return grown(scene, 30, [](auto&) {}); }});
    for (const std::size_t k : ks) {
        for (const double angle : smooth_angles) {
            for (const double curvature : {0.05, 1.0}) {
                for (const std::size_t least : least_points) {
                    growing.settings.push_back(
                        {assigned("k", k) + " " + assigned("angle", angle) + " " +
                             assigned("curvature", curvature) + " " + assigned("min", least),
                         [=](const cloud& scene) {
                             return grown(scene, static_cast<int>(k), [&](auto& g) {
                                 g.setNumberOfNeighbours(static_cast<unsigned>(k));
                                 g.setSmoothnessThreshold(
                                     static_cast<float>(angle * std::numbers::pi / 180.0));
                                 g.setCurvatureThreshold(static_cast<float>(curvature));
                                 g.setMinClusterSize(static_cast<int>(least));
                             });
                         }});
                }
            }
        }
    }
    return {growing};
}

}  // namespace planes
