// SPDX-License-Identifier: BSL-1.0
/// @file
/// PCL's planes, computed as pcl::NormalEstimation does, in single precision.
#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

#include <Eigen/Core>

#include "neighborhoods.hpp"
#include <gnomon/normals/estimator.hpp>
#include <pcl/features/normal_3d.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

namespace known_normals {

/// The planes of all test points, over each point and its k neighbors: setKSearch(k + 1), as PCL
/// counts the point.
inline std::vector<gnomon::normal_fit> pcl_planes(const std::vector<Eigen::Vector3d>& points,
                                                  const nearest_of_tests& nearest, std::size_t k) {
    std::vector<gnomon::normal_fit> result(nearest.tests());
    pcl::PointCloud<pcl::PointXYZ> neighbors;
    pcl::Indices all(k + 1);
    std::iota(all.begin(), all.end(), 0);
    const auto add = [&neighbors](const Eigen::Vector3d& p) {
        const Eigen::Vector3f f = p.cast<float>();
        neighbors.push_back({f.x(), f.y(), f.z()});
    };
    for (std::size_t i = 0; i < result.size(); ++i) {
        neighbors.clear();
        add(points[i]);
        for (const auto j : nearest.neighbors(i, k)) add(points[j]);
        Eigen::Vector4f plane;
        float curvature = 0.0F;
        if (!pcl::computePointNormal(neighbors, all, plane, curvature)) continue;
        result[i].normal = plane.head<3>().cast<double>().normalized();
    }
    return result;
}

}  // namespace known_normals
