// SPDX-License-Identifier: BSL-1.0
// The Point Cloud Library, its estimator for one thread and that for several.
#include "peer.hpp"
#include <pcl/features/normal_3d.h>
#include <pcl/features/normal_3d_omp.h>
#include <pcl/pcl_config.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

namespace {

using estimation = pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal>;
using estimation_omp = pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal>;

/// What is alike for both.
class estimator {
  public:
    static constexpr const char* task = "normals";

    explicit estimator(const peers::vectors& points) {
        for (const Eigen::Vector3d& p : points) {
            const Eigen::Vector3f q = p.cast<float>();
            cloud_->emplace_back(q.x(), q.y(), q.z());
        }
    }

    static Eigen::Vector3d normal(const pcl::PointCloud<pcl::Normal>& result, std::size_t i) {
        return result[i].getNormalVector3fMap().cast<double>();
    }

  protected:
    pcl::PointCloud<pcl::Normal> run(estimation& estimate, std::size_t k) const {
        estimate.setInputCloud(cloud_);
        estimate.setKSearch(static_cast<int>(k) + 1);  // the point itself is found, too
        pcl::PointCloud<pcl::Normal> result;
        estimate.compute(result);
        return result;
    }

  private:
    pcl::PointCloud<pcl::PointXYZ>::Ptr cloud_{new pcl::PointCloud<pcl::PointXYZ>};
};

struct normals : estimator {
    static constexpr const char* library = "PCL NormalEstimation";
    static constexpr bool one_thread_only = true;

    using estimator::estimator;
    auto operator()(const peers::request& r) const {
        estimation estimate;
        return run(estimate, r.k);
    }
};

struct normals_omp : estimator {
    static constexpr const char* library = "PCL NormalEstimationOMP";
    static constexpr bool one_thread_only = false;

    using estimator::estimator;
    auto operator()(const peers::request& r) const {
        estimation_omp estimate(r.threads);
        return run(estimate, r.k);
    }
};

}  // namespace

int main(int argc, char** argv) {
    return peers::serve<normals, normals_omp>(PCL_VERSION_PRETTY, argc, argv);
}
