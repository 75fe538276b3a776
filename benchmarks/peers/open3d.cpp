// SPDX-License-Identifier: BSL-1.0
// Open3D's PointCloud; OMP_NUM_THREADS, which it obeys, sets the number of threads.
#include <algorithm>
#include <utility>
#include <vector>

#include "loops.hpp"
#include "peer.hpp"
#include <open3d/Open3DConfig.h>
#include <open3d/geometry/KDTreeFlann.h>
#include <open3d/geometry/KDTreeSearchParam.h>
#include <open3d/geometry/PointCloud.h>

namespace {

/// What is alike for all.
struct on_cloud {
    static constexpr bool one_thread_only = false;

    explicit on_cloud(const peers::vectors& points) : cloud(points) {}

    open3d::geometry::PointCloud cloud;
};

struct search : on_cloud, peers::search_job {
    static constexpr const char* library = "Open3D KDTreeFlann";
    static constexpr bool one_thread_only = peers::loops_have_one_thread;

    using on_cloud::on_cloud;
    auto operator()(const peers::request& r) const {
        const open3d::geometry::KDTreeFlann tree(cloud);
        const int k = static_cast<int>(r.k()) + 1;  // the point itself is found, too
        peers::neighbor_lists lists(cloud.points_.size(), r.k());
        peers::for_each_index(cloud.points_.size(), r.threads, [&] {
            return [&, k, neighbors = std::vector<int>(),
                    squares = std::vector<double>()](std::size_t i) mutable {
                tree.SearchKNN(cloud.points_[i], k, neighbors, squares);
                lists.set(i, neighbors);
            };
        });
        return lists;
    }
};

struct normals : on_cloud {
    static constexpr const char* task = "normals";
    static constexpr const char* library = "Open3D";

    using on_cloud::on_cloud;
    auto operator()(const peers::request& r) {
        const int k = static_cast<int>(r.k()) + 1;  // the point itself is found, too
        cloud.EstimateNormals(open3d::geometry::KDTreeSearchParamKNN(k));
        return std::exchange(cloud.normals_, {});
    }

    static Eigen::Vector3d normal(const peers::vectors& result, std::size_t i) { return result[i]; }
    static std::size_t bytes(const peers::vectors& result) {
        return result.size() * sizeof(result[0]);
    }
};

/// With one point being enough for a cluster's core, DBSCAN is what grows by a radius.
struct clusters : on_cloud {
    static constexpr const char* task = "clusters";
    static constexpr const char* library = "Open3D ClusterDBSCAN";

    using on_cloud::on_cloud;
    auto operator()(const peers::request& r) const { return cloud.ClusterDBSCAN(r.radius(), 1); }

    static std::size_t segment_count(const std::vector<int>& labels) {
        const auto last = std::max_element(labels.begin(), labels.end());
        return last == labels.end() ? 0 : static_cast<std::size_t>(*last + 1);
    }
};

}  // namespace

int main(int argc, char** argv) {
    return peers::serve<search, normals, clusters>(OPEN3D_VERSION, argc, argv);
}
