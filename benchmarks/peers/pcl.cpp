// SPDX-License-Identifier: BSL-1.0
// The Point Cloud Library, its estimator for one thread and that for several.
#include <cmath>
#include <utility>
#include <vector>

#include "loops.hpp"
#include "peer.hpp"
#include <pcl/features/normal_3d.h>
#include <pcl/features/normal_3d_omp.h>
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/pcl_config.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>
#include <pcl/segmentation/region_growing.h>

namespace {

using estimation = pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal>;
using estimation_omp = pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal>;
using normal_cloud = pcl::PointCloud<pcl::Normal>;

/// What is alike for all.
class on_cloud {
  public:
    explicit on_cloud(const peers::vectors& points) {
        for (const Eigen::Vector3d& p : points) {
            const Eigen::Vector3f q = p.cast<float>();
            cloud_->emplace_back(q.x(), q.y(), q.z());
        }
    }

  protected:
    [[nodiscard]] const pcl::PointCloud<pcl::PointXYZ>::Ptr& cloud() const { return cloud_; }

    void run(estimation& estimate, std::size_t k, normal_cloud& result) const {
        estimate.setInputCloud(cloud_);
        estimate.setKSearch(static_cast<int>(k) + 1);  // the point itself is found, too
        estimate.compute(result);
    }

  private:
    pcl::PointCloud<pcl::PointXYZ>::Ptr cloud_{new pcl::PointCloud<pcl::PointXYZ>};
};

struct search : on_cloud, peers::search_job {
    static constexpr const char* library = "PCL KdTreeFLANN";
    static constexpr bool one_thread_only = peers::loops_have_one_thread;

    using on_cloud::on_cloud;
    auto operator()(const peers::request& r) const {
        pcl::KdTreeFLANN<pcl::PointXYZ> tree;
        tree.setInputCloud(cloud());
        peers::neighbor_lists lists(cloud()->size(), r.k());
        const auto k = static_cast<unsigned>(r.k()) + 1;  // the point itself is found, too
        peers::for_each_index(cloud()->size(), r.threads, [&] {
            return [&, k, neighbors = pcl::Indices(),
                    squares = std::vector<float>()](std::size_t i) mutable {
                tree.nearestKSearch((*cloud())[i], k, neighbors, squares);
                lists.set(i, neighbors);
            };
        });
        return lists;
    }
};

/// What is alike for both.
struct estimator : on_cloud {
    static constexpr const char* task = "normals";

    using on_cloud::on_cloud;
    static Eigen::Vector3d normal(const normal_cloud& result, std::size_t i) {
        return result[i].getNormalVector3fMap().cast<double>();
    }
    static std::size_t bytes(const normal_cloud& result) {
        return result.size() * sizeof(result[0]);
    }
};

struct normals : estimator {
    static constexpr const char* library = "PCL NormalEstimation";
    static constexpr bool one_thread_only = true;

    using estimator::estimator;
    auto operator()(const peers::request& r) const {
        estimation estimate;
        normal_cloud result;
        run(estimate, r.k(), result);
        return result;
    }
};

struct normals_omp : estimator {
    static constexpr const char* library = "PCL NormalEstimationOMP";
    static constexpr bool one_thread_only = false;

    using estimator::estimator;
    auto operator()(const peers::request& r) const {
        estimation_omp estimate(r.threads);
        normal_cloud result;
        run(estimate, r.k(), result);
        return result;
    }
};

struct surfaces : on_cloud {
    static constexpr const char* task = "surfaces";
    static constexpr const char* library = "PCL RegionGrowing";
    static constexpr bool one_thread_only = false;  // of the normals; it grows on one

    using on_cloud::on_cloud;
    auto operator()(const peers::request& r) const {
        estimation_omp estimate(r.threads);
        const normal_cloud::Ptr normals(new normal_cloud);
        run(estimate, r.k(), *normals);
        pcl::RegionGrowing<pcl::PointXYZ, pcl::Normal> growing;
        growing.setInputCloud(cloud());
        growing.setInputNormals(normals);
        growing.setNumberOfNeighbours(static_cast<unsigned>(r.k()) + 1);
        growing.setSmoothnessThreshold(static_cast<float>(peers::max_angle));
        growing.setCurvatureThreshold(1.0f);  // it is 1/3 at most
        growing.setMinClusterSize(peers::min_points);
        std::vector<pcl::PointIndices> segments;
        growing.extract(segments);
        return std::pair(normals, std::move(segments));
    }

    static Eigen::Vector3d normal(const auto& result, std::size_t i) {
        return estimator::normal(*result.first, i);
    }
    static std::size_t segment_count(const auto& result) { return result.second.size(); }
};

struct clusters : on_cloud {
    static constexpr const char* task = "clusters";
    static constexpr const char* library = "PCL EuclideanClusterExtraction";
    static constexpr bool one_thread_only = true;

    using on_cloud::on_cloud;
    auto operator()(const peers::request& r) const {
        pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
        extraction.setInputCloud(cloud());
        extraction.setClusterTolerance(r.radius());
        std::vector<pcl::PointIndices> groups;
        extraction.extract(groups);
        return groups;
    }

    static std::size_t segment_count(const auto& groups) { return groups.size(); }
};

}  // namespace

int main(int argc, char** argv) {
    return peers::serve<search, normals, normals_omp, surfaces, clusters>(PCL_VERSION_PRETTY, argc,
                                                                          argv);
}
