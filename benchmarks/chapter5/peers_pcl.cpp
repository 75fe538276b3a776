// SPDX-License-Identifier: BSL-1.0
#include <cstddef>
#include <iterator>

#include "peers.hpp"
#include <pcl/features/esf.h>
#include <pcl/features/normal_3d.h>
#include <pcl/features/vfh.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

namespace peers {
namespace {

constexpr std::size_t fewest = 20;
constexpr int neighbors = 20;

using cloud = pcl::PointCloud<pcl::PointXYZ>;

cloud::Ptr cloud_of(const gnomon::scan& view) {
    cloud::Ptr points(new cloud);
    for (const auto& p : view.points) {
        const Eigen::Vector3f q = p.cast<float>();
        points->emplace_back(q.x(), q.y(), q.z());
    }
    return points;
}

}  // namespace

std::vector<float> vfh(const gnomon::scan& view) {
    if (view.size() < fewest) return {};
    const auto points = cloud_of(view);
    const Eigen::Vector3f from = view.viewpoints[0].cast<float>();
    pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimate;
    estimate.setInputCloud(points);
    estimate.setKSearch(neighbors);
    estimate.setViewPoint(from.x(), from.y(), from.z());
    const pcl::PointCloud<pcl::Normal>::Ptr normals(new pcl::PointCloud<pcl::Normal>);
    estimate.compute(*normals);
    pcl::VFHEstimation<pcl::PointXYZ, pcl::Normal, pcl::VFHSignature308> describe;
    describe.setInputCloud(points);
    describe.setInputNormals(normals);
    describe.setViewPoint(from.x(), from.y(), from.z());
    pcl::PointCloud<pcl::VFHSignature308> found;
    describe.compute(found);
    return {std::begin(found[0].histogram), std::end(found[0].histogram)};
}

std::vector<float> esf(const gnomon::scan& view) {
    if (view.size() < fewest) return {};
    pcl::ESFEstimation<pcl::PointXYZ, pcl::ESFSignature640> describe;
    describe.setInputCloud(cloud_of(view));
    pcl::PointCloud<pcl::ESFSignature640> found;
    describe.compute(found);
    return {std::begin(found[0].histogram), std::end(found[0].histogram)};
}

}  // namespace peers
