// SPDX-License-Identifier: BSL-1.0
// CGAL's point set processing: planes by principal components, and jets (quadrics over a plane).
#include <utility>
#include <vector>

#include "peer.hpp"
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
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

/// What is alike for both.
class estimator {
  public:
    static constexpr const char* task = "normals";
#ifdef CGAL_LINKED_WITH_TBB
    static constexpr bool one_thread_only = false;
#else
    static constexpr bool one_thread_only = true;
#endif

    explicit estimator(const peers::vectors& points) {
        for (const Eigen::Vector3d& p : points) {
            points_.emplace_back(kernel::Point_3(p.x(), p.y(), p.z()), kernel::Vector_3(0, 0, 0));
        }
    }

    static Eigen::Vector3d normal(const std::vector<point>& result, std::size_t i) {
        const kernel::Vector_3& n = result[i].second;
        return {n.x(), n.y(), n.z()};
    }

  protected:
    /// Calls estimate(tag, points, parameters), where the tag says whether to go parallel.
    const std::vector<point>& run(unsigned threads, auto&& estimate) {
        const auto maps = CGAL::parameters::point_map(CGAL::First_of_pair_property_map<point>())
                              .normal_map(CGAL::Second_of_pair_property_map<point>());
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
    std::vector<point> points_;
};

// CGAL does not count the point itself among the k neighbors.

struct pca : estimator {
    static constexpr const char* library = "CGAL pca";

    using estimator::estimator;
    const auto& operator()(const peers::request& r) {
        return run(r.threads, [&](auto tag, auto& points, const auto& maps) {
            CGAL::pca_estimate_normals<decltype(tag)>(points, static_cast<unsigned>(r.k), maps);
        });
    }
};

struct jet : estimator {
    static constexpr const char* library = "CGAL jet";

    using estimator::estimator;
    const auto& operator()(const peers::request& r) {
        return run(r.threads, [&](auto tag, auto& points, const auto& maps) {
            CGAL::jet_estimate_normals<decltype(tag)>(points, static_cast<unsigned>(r.k), maps);
        });
    }
};

}  // namespace

int main(int argc, char** argv) { return peers::serve<pca, jet>(CGAL_VERSION_STR, argc, argv); }
