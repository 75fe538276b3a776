// SPDX-License-Identifier: BSL-1.0
/// @file
/// Clouds with the members and the memory of PCL's, for tests without PCL.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace pcl_like {

/// As pcl::PointXYZ: float data[4], aligned for SSE.
struct alignas(16) point_xyz {
    float x = 0, y = 0, z = 0, one = 1;
};

/// As pcl::PointXYZL.
struct alignas(16) point_xyzl {
    float x = 0, y = 0, z = 0, one = 1;
    std::uint32_t label = 0;
};

/// As pcl::PointNormal: float data[4], float data_n[4], curvature.
struct alignas(16) point_normal {
    float x = 0, y = 0, z = 0, one = 1;
    float normal_x = 0, normal_y = 0, normal_z = 0, zero = 0;
    float curvature = 0;
};
static_assert(sizeof(point_xyz) == 16 && sizeof(point_xyzl) == 32 && sizeof(point_normal) == 48);

/// As pcl::PointCloud.
template <class Point>
struct cloud_of {
    std::vector<Point> points;
    std::uint32_t width = 0, height = 0;
    bool is_dense = true;
    Eigen::Vector4f sensor_origin_ = Eigen::Vector4f::Zero();

    [[nodiscard]] auto begin() const { return points.begin(); }
    [[nodiscard]] auto end() const { return points.end(); }
    [[nodiscard]] std::size_t size() const { return points.size(); }
};

}  // namespace pcl_like
