// SPDX-License-Identifier: BSL-1.0
// gnomon itself.
#include "peer.hpp"
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/version.hpp>

namespace {

struct normals {
    static constexpr const char* task = "normals";
    static constexpr const char* library = "gnomon";
    static constexpr bool one_thread_only = false;

    const peers::vectors& points;

    auto operator()(const peers::request& r) const {
        return gnomon::estimate_normals(points, gnomon::knn{.k = r.k}, gnomon::plane_pca{},
                                        gnomon::threads{r.threads});
    }

    static Eigen::Vector3d normal(const auto& surface, std::size_t i) { return surface[i].normal; }
};

}  // namespace

int main(int argc, char** argv) {
    const std::string version = std::to_string(GNOMON_VERSION_MAJOR) + '.' +
                                std::to_string(GNOMON_VERSION_MINOR) + '.' +
                                std::to_string(GNOMON_VERSION_PATCH);
    return peers::serve<normals>(version, argc, argv);
}
