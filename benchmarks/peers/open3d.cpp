// SPDX-License-Identifier: BSL-1.0
// Open3D's PointCloud; OMP_NUM_THREADS, which it obeys, tells the number of threads.
#include <utility>

#include "peer.hpp"
#include <open3d/Open3DConfig.h>
#include <open3d/geometry/KDTreeSearchParam.h>
#include <open3d/geometry/PointCloud.h>

namespace {

class normals {
  public:
    static constexpr const char* task = "normals";
    static constexpr const char* library = "Open3D";
    static constexpr bool one_thread_only = false;

    explicit normals(const peers::vectors& points) : cloud_(points) {}

    auto operator()(const peers::request& r) {
        const int k = static_cast<int>(r.k) + 1;  // the point itself is found, too
        cloud_.EstimateNormals(open3d::geometry::KDTreeSearchParamKNN(k));
        return std::exchange(cloud_.normals_, {});
    }

    static Eigen::Vector3d normal(const peers::vectors& result, std::size_t i) { return result[i]; }

  private:
    open3d::geometry::PointCloud cloud_;
};

}  // namespace

int main(int argc, char** argv) { return peers::serve<normals>(OPEN3D_VERSION, argc, argv); }
