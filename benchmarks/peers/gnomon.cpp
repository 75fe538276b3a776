// SPDX-License-Identifier: BSL-1.0
// gnomon itself.
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "peer.hpp"
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/segmentation/euclidean_clusters.hpp>
#include <gnomon/segmentation/segment_surfaces.hpp>
#include <gnomon/version.hpp>

namespace {

/// What is alike for all.
struct on_points {
    static constexpr const char* library = "gnomon";
    static constexpr bool one_thread_only = false;

    const peers::vectors& points;
};

struct search : on_points {
    static constexpr const char* task = "search";

    explicit search(const peers::vectors& p) : on_points{p} {}

    auto operator()(const peers::request& r) const {
        return gnomon::knn{.k = r.k()}(points, gnomon::threads{r.threads});
    }

    static std::size_t last_neighbor(const gnomon::adjacency& graph, std::size_t i) {
        return graph[i].back();
    }
    static std::size_t bytes(const gnomon::adjacency& graph) {
        std::size_t sum = sizeof(std::uint64_t);
        for (std::size_t i = 0; i < graph.size(); ++i) {
            sum += sizeof(std::uint64_t) + graph[i].size_bytes();
        }
        return sum;
    }
};

struct normals : on_points {
    static constexpr const char* task = "normals";

    explicit normals(const peers::vectors& p) : on_points{p} {}

    auto operator()(const peers::request& r) const {
        return gnomon::estimate_normals(points, gnomon::knn{.k = r.k()}, gnomon::plane_pca{},
                                        gnomon::threads{r.threads});
    }

    static Eigen::Vector3d normal(const auto& surface, std::size_t i) { return surface[i].normal; }
    static std::size_t bytes(const auto& surface) { return surface.size() * sizeof(surface[0]); }
};

struct surfaces : on_points {
    static constexpr const char* task = "surfaces";

    explicit surfaces(const peers::vectors& p) : on_points{p} {}

    auto operator()(const peers::request& r) const {
        auto surface = normals(points)(r);
        const gnomon::segment_surfaces_options options{
            .max_angle = gnomon::radians(peers::max_angle), .min_points = peers::min_points};
        auto segments =
            gnomon::segment_surfaces(points, surface, options, gnomon::threads{r.threads});
        return std::pair(std::move(surface), std::move(segments));
    }

    static Eigen::Vector3d normal(const auto& result, std::size_t i) {
        return result.first[i].normal;
    }
    static std::size_t segment_count(const auto& result) { return result.second.size(); }
};

struct clusters : on_points {
    static constexpr const char* task = "clusters";

    explicit clusters(const peers::vectors& p) : on_points{p} {}

    auto operator()(const peers::request& r) const {
        return gnomon::euclidean_clusters(points, {.radius = r.radius(), .min_points = 1},
                                          gnomon::threads{r.threads});
    }

    static std::size_t segment_count(const gnomon::segments& groups) { return groups.size(); }
};

}  // namespace

int main(int argc, char** argv) {
    const std::string version = std::to_string(GNOMON_VERSION_MAJOR) + '.' +
                                std::to_string(GNOMON_VERSION_MINOR) + '.' +
                                std::to_string(GNOMON_VERSION_PATCH);
    return peers::serve<search, normals, surfaces, clusters>(version, argc, argv);
}
