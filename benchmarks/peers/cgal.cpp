// SPDX-License-Identifier: BSL-1.0
// CGAL's neighbor search and point set processing: planes by principal components, and jets
// (quadrics over a plane); regions that grow; clusters.
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

#include "loops.hpp"
#include "peer.hpp"
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Search_traits_adapter.h>
#include <CGAL/Shape_detection/Region_growing/Region_growing.h>
#include <CGAL/Shape_detection/Region_growing/Region_growing_on_point_set/K_neighbor_query.h>
#include <CGAL/cluster_point_set.h>
#include <CGAL/jet_estimate_normals.h>
#include <CGAL/pca_estimate_normals.h>
#include <CGAL/property_map.h>
#include <CGAL/version.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#endif

namespace {

using kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using point = std::pair<kernel::Point_3, kernel::Vector_3>;
using points_with_normals = std::vector<point>;
using point_map = CGAL::First_of_pair_property_map<point>;
using normal_map = CGAL::Second_of_pair_property_map<point>;

/// What is alike for all.
class on_points {
  public:
    explicit on_points(const peers::vectors& points) {
        for (const Eigen::Vector3d& p : points) {
            points_.emplace_back(kernel::Point_3(p.x(), p.y(), p.z()), kernel::Vector_3(0, 0, 0));
        }
    }

    static Eigen::Vector3d normal(const points_with_normals& result, std::size_t i) {
        const kernel::Vector_3& n = result[i].second;
        return {n.x(), n.y(), n.z()};
    }

  protected:
    [[nodiscard]] points_with_normals& points() { return points_; }

    /// Calls estimate(tag, points, parameters), where the tag selects parallel execution.
    const points_with_normals& run([[maybe_unused]] unsigned threads, auto&& estimate) {
        const auto maps = CGAL::parameters::point_map(point_map()).normal_map(normal_map());
#ifdef CGAL_LINKED_WITH_TBB
        if (threads > 1) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
            estimate(CGAL::Parallel_tag(), points_, maps);
            return points_;
        }
#endif
        estimate(CGAL::Sequential_tag(), points_, maps);
        return points_;
    }

  private:
    points_with_normals points_;
};

using numbered_point = std::pair<kernel::Point_3, std::size_t>;
using numbered_point_map = CGAL::First_of_pair_property_map<numbered_point>;

/// The points, each with its number.
struct on_numbered_points {
    explicit on_numbered_points(const peers::vectors& list) {
        for (const Eigen::Vector3d& p : list) {
            points.emplace_back(kernel::Point_3(p.x(), p.y(), p.z()), points.size());
        }
    }

    std::vector<numbered_point> points;
};

struct search : on_numbered_points, peers::search_job {
    static constexpr const char* library = "CGAL Orthogonal_k_neighbor_search";
    static constexpr bool one_thread_only = peers::loops_have_one_thread;

    using on_numbered_points::on_numbered_points;
    auto operator()(const peers::request& r) const {
        using traits = CGAL::Search_traits_adapter<numbered_point, numbered_point_map,
                                                   CGAL::Search_traits_3<kernel>>;
        using one_search = CGAL::Orthogonal_k_neighbor_search<traits>;
        typename one_search::Tree tree(points.begin(), points.end());
        tree.build();
        peers::neighbor_lists lists(points.size(), r.k());
        const auto k = static_cast<unsigned>(r.k()) + 1;  // the point itself is found, too
        peers::for_each_index(points.size(), r.threads, [&] {
            return [&, k, neighbors = std::vector<std::size_t>()](std::size_t i) mutable {
                neighbors.clear();
                one_search found(tree, points[i].first, k);
                for (const auto& [p, square] : found) neighbors.push_back(p.second);
                lists.set(i, neighbors);
            };
        });
        return lists;
    }
};

/// What is alike for both.
struct estimator : on_points {
    static constexpr const char* task = "normals";
#ifdef CGAL_LINKED_WITH_TBB
    static constexpr bool one_thread_only = false;
#else
    static constexpr bool one_thread_only = true;
#endif

    using on_points::on_points;
    static std::size_t bytes(const points_with_normals&) { return 0; }  // were there before
};

// CGAL does not count the point itself among the k neighbors.

struct pca : estimator {
    static constexpr const char* library = "CGAL pca";

    using estimator::estimator;
    const auto& operator()(const peers::request& r) {
        return run(r.threads, [&](auto tag, auto& points, const auto& maps) {
            CGAL::pca_estimate_normals<decltype(tag)>(points, static_cast<unsigned>(r.k()), maps);
        });
    }
};

struct jet : estimator {
    static constexpr const char* library = "CGAL jet";

    using estimator::estimator;
    const auto& operator()(const peers::request& r) {
        return run(r.threads, [&](auto tag, auto& points, const auto& maps) {
            CGAL::jet_estimate_normals<decltype(tag)>(points, static_cast<unsigned>(r.k()), maps);
        });
    }
};

/// Grows from neighbor to neighbor where normals agree, as all others do: what CGAL brings along
/// would fit a plane to the region again and again. Small regions are left out afterwards, as
/// CGAL's own refusal would free their points and start with each of them once more.
struct smooth_region {
    const points_with_normals& points;
    double min_cosine = std::cos(peers::max_angle);

    [[nodiscard]] bool is_part_of_region(std::size_t from, std::size_t to,
                                         const std::vector<std::size_t>&) const {
        return std::abs(points[from].second * points[to].second) >= min_cosine;
    }
    [[nodiscard]] bool is_valid_region(const std::vector<std::size_t>&) const { return true; }
    void update(const std::vector<std::size_t>&) const {}
};

struct surfaces : pca {
    static constexpr const char* task = "surfaces";
    static constexpr const char* library = "CGAL pca + Region_growing";

    using pca::pca;
    auto operator()(const peers::request& r) {
        const points_with_normals& surface = pca::operator()(r);
        using CGAL::Shape_detection::Point_set::K_neighbor_query;
        K_neighbor_query<kernel, points_with_normals, point_map> neighbors(surface, r.k() + 1);
        smooth_region smooth{surface};
        CGAL::Shape_detection::Region_growing growing(surface, neighbors, smooth,
                                                      CGAL::Identity_property_map<std::size_t>());
        std::vector<std::vector<std::size_t>> regions;
        growing.detect(std::back_inserter(regions));
        return std::pair(&surface, std::move(regions));
    }

    static Eigen::Vector3d normal(const auto& result, std::size_t i) {
        return on_points::normal(*result.first, i);
    }
    static std::size_t segment_count(const auto& result) {
        return peers::count_of(result.second, peers::min_points);
    }
};

/// Labels by the numbers of points, as a property map.
struct label_map {
    using key_type = numbered_point;
    using value_type = std::size_t;
    using reference = value_type;
    using category = boost::read_write_property_map_tag;

    std::size_t* labels;

    friend std::size_t get(const label_map& map, const numbered_point& p) {
        return map.labels[p.second];
    }
    friend void put(const label_map& map, const numbered_point& p, std::size_t label) {
        map.labels[p.second] = label;
    }
};

struct clusters : on_numbered_points {
    static constexpr const char* task = "clusters";
    static constexpr const char* library = "CGAL cluster_point_set";
    static constexpr bool one_thread_only = true;

    using on_numbered_points::on_numbered_points;
    auto operator()(const peers::request& r) {
        std::vector<std::size_t> labels(points.size());
        const std::size_t count = CGAL::cluster_point_set(
            points, label_map{labels.data()},
            CGAL::parameters::point_map(numbered_point_map()).neighbor_radius(r.radius()));
        return std::pair(count, std::move(labels));
    }

    static std::size_t segment_count(const auto& result) { return result.first; }
};

}  // namespace

int main(int argc, char** argv) {
    return peers::serve<search, pca, jet, surfaces, clusters>(CGAL_VERSION_STR, argc, argv);
}
