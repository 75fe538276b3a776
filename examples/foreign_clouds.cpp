// SPDX-License-Identifier: BSL-1.0
// How do I take clouds of PCL and matrices of Eigen, and give back normals and labels?
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <vector>

#include <Eigen/Core>

#include "common/help.hpp"
#include <gnomon/adapters/eigen_matrix.hpp>
#include <gnomon/adapters/pcl_cloud.hpp>
#include <gnomon/gnomon.hpp>
#include <gnomon/perception.hpp>
#include <gnomon/simulation.hpp>

// This program needs no PCL: here are the members that are used. With PCL, include
// <pcl/point_cloud.h> and <pcl/point_types.h> instead, and nothing else changes.
namespace pcl {

struct alignas(16) PointXYZ {
    float x = 0, y = 0, z = 0, one = 1;
};

struct alignas(16) PointXYZLNormal {
    float x = 0, y = 0, z = 0, one = 1;
    std::uint32_t label = 0;
    float normal_x = 0, normal_y = 0, normal_z = 0, curvature = 0;
};

template <class Point>
struct PointCloud {
    std::vector<Point> points;
    std::uint32_t width = 0, height = 0;
    bool is_dense = true;
    Eigen::Vector4f sensor_origin_ = Eigen::Vector4f::Zero();

    auto begin() const { return points.begin(); }
    auto end() const { return points.end(); }
    std::size_t size() const { return points.size(); }
};

}  // namespace pcl

int main(int argc, char** argv) {
    if (printed_help(
            argc, argv,
            "Takes a cloud of PCL and a matrix of Eigen, and gives back normals and labels."))
        return 0;
    namespace sim = gnomon::simulation;
    const sim::scene kitchen = sim::scenes::kitchen();
    const gnomon::scan scan =
        sim::simulate(kitchen, sim::rotational{.mount = kitchen.sensor}, {}, {.sigma = 0.005}).scan;
    const auto cloud = gnomon::to_pcl<pcl::PointCloud<pcl::PointXYZ>>(scan);

    // [pcl_cloud]
    // #include <gnomon/adapters/pcl_cloud.hpp>
    const auto points = gnomon::pcl_points(cloud);  // no copy; seen from cloud.sensor_origin_
    const auto seen = gnomon::perception<>{}(points, gnomon::threads{});

    auto result = gnomon::to_pcl<pcl::PointCloud<pcl::PointXYZLNormal>>(points);
    gnomon::put_normals(result, seen.surface);  // normal_x, normal_y, normal_z, curvature
    gnomon::put_labels(result, seen.surfaces);

    // And out of a cloud that has them:
    const auto surface = gnomon::pcl_surface(result);
    const gnomon::segments surfaces(gnomon::pcl_labels(result));
    const auto curvature = gnomon::estimate_curvature(points, gnomon::knn{.k = 30}, surface);
    // [pcl_cloud]

    const auto matrix =
        gnomon::point_rows<Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>>(scan);
    // [eigen_matrix]
    // #include <gnomon/adapters/eigen_matrix.hpp>
    const auto of_matrix = gnomon::estimate_normals(gnomon::rows(matrix), gnomon::knn{.k = 30},
                                                    gnomon::plane_pca{});  // matrix: n x 3
    const Eigen::Matrix<double, Eigen::Dynamic, 3> normals = gnomon::normal_rows(of_matrix);
    // [eigen_matrix]

    std::printf("%zu surfaces, %zu in the cloud; %zu curvatures; %td x %td normals\n",
                seen.surfaces.size(), surfaces.size(), curvature.size(), normals.rows(),
                normals.cols());
    return surfaces == seen.surfaces ? 0 : 1;
}
