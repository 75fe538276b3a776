// SPDX-License-Identifier: BSL-1.0
/// @file
/// The competition of segments for points: each point goes to the plane that explains it best, and
/// rather to that of most of its neighbors, and rather to the plane that its ray ends on.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/thread_team.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/segmentation/detail/planar_cloud.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>
#include <gnomon/segmentation/detail/region_edges.hpp>
#include <gnomon/segmentation/detail/region_pairs.hpp>
#include <gnomon/segmentation/detail/surface_noise.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// Of the competition; chosen on furnished rooms 20,001 to 20,012: more take longer, and change the
/// mean IoU by less than its scatter.
inline constexpr int most_rounds = 4;

/// Labels that compete for a point: each plane by how far the point is from it, and by how many of
/// the neighbors of the point have its label (the Potts model, as in Isack and Boykov 2012), and of
/// two that meet at an edge, by the side on which the point is. (A template, so that only its users
/// compile it.)
template <class Label = std::int32_t>
class label_competition {
  public:
    /// Begins with the labels of the neighbors of a point, and its own.
    template <class Neighbors>
    void begin(const Neighbors& neighbors, const auto& labels, std::int32_t own) {
        candidates_.clear();
        if (own != unlabeled) candidates_.push_back({own, 0.0});
        for (const point_index j : neighbors)
            if (labels[j] != unlabeled) ++candidate_of(labels[j]).agreeing;
        neighbors_ = static_cast<double>(std::max<std::size_t>(neighbors.size(), 1));
    }

    /// The best label, of equal ones the smallest; unlabeled if none is possible.
    /// @param misfit     misfit(label): the square of the deviation of the point, in variances of
    ///                   its region; negative if it is impossible
    /// @param is_across  is_across(label, other): whether both meet at an edge, and the point is on
    ///                   the side of the other one; then the cost grows by as much as if all
    ///                   neighbors had another label
    [[nodiscard]] std::int32_t winner(auto&& misfit, auto&& is_across) {
        constexpr double half = 0.5;   // formula: the logarithm of a normal density
        constexpr double potts = 2.0;  // per share of neighbors with another label; chosen
        for (candidate& c : candidates_) c.squared = misfit(c.label);
        std::erase_if(candidates_, [](const candidate& c) { return c.squared < 0.0; });
        std::pair best(std::numeric_limits<double>::infinity(), unlabeled);
        for (const candidate& c : candidates_) {
            const bool is_beyond = std::ranges::any_of(candidates_, [&](const candidate& other) {
                return other.label != c.label && is_across(c.label, other.label);
            });
            const double differing = 1.0 - c.agreeing / neighbors_ + (is_beyond ? 1.0 : 0.0);
            best = std::min(best, std::pair(half * c.squared + potts * differing, c.label));
        }
        return best.second;
    }

  private:
    struct candidate {
        Label label;
        double agreeing;       // neighbors
        double squared = 0.0;  // misfit
    };

    [[nodiscard]] candidate& candidate_of(Label label) {
        const auto found = std::ranges::find(candidates_, label, &candidate::label);
        return found != candidates_.end() ? *found
                                          : candidates_.emplace_back(candidate{label, 0.0});
    }

    scratch<candidate> candidates_;  // few
    double neighbors_ = 1.0;
};

/// The square of the deviation of a point from the plane of a region, in variances of the region;
/// negative if it is too far. A region that is not planar is as near as a plane at one standard
/// deviation. (Templates, so that only their users compile them.)
[[nodiscard]] double misfit_of(const Eigen::Vector3d& offset, const point_noise& noise,
                               const auto& to) {
    if (!to.is_planar) return 1.0;
    const plane& p = to.fit.plane;
    const double deviations = p.signed_distance(offset) / noise.across(p.normal);
    const double squared = deviations * deviations / to.fit.excess();
    return squared <= most_deviations * most_deviations ? squared : -1.0;
}
[[nodiscard]] double misfit_of(const planar_cloud& cloud, std::size_t i, const auto& to) {
    return misfit_of(cloud.offsets[i], cloud.noise[i], to);
}

/// Whether a point is a certain outlier of a region's plane.
[[nodiscard]] bool is_certainly_off(const Eigen::Vector3d& offset, const point_noise& noise,
                                    const auto& region) {
    const plane& p = region.fit.plane;
    return region.is_planar && std::abs(p.signed_distance(offset)) > noise.certain_reach(p.normal);
}

/// The points that have a neighbor with another label: only these compete.
template <neighborhood_graph G, execution X>
[[nodiscard]] scratch<char> borders_of(const G& graph, const auto& labels, const X& run) {
    scratch<char> is_border(labels.size(), false);
    for_each_chunk(run, labels.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            is_border[i] = std::ranges::any_of(
                graph[i], [&](point_index j) { return labels[j] != labels[i]; });
    });
    return is_border;
}

/// The pairs of regions that have neighboring points, sorted; around an unlabeled point, those of
/// its first labeled neighbor with each of the others. O(n k) for k neighbors.
/// @param is_border  of each point that has a neighbor with another label
template <neighborhood_graph G, execution X>
[[nodiscard]] scratch<region_pair> touching_regions(const G& graph, const auto& labels,
                                                    const scratch<char>& is_border, const X& run) {
    scratch<region_pair> all;
    mutex guard;
    for_each_chunk(run, labels.size(), [&](std::size_t begin, std::size_t end) {
        scratch<region_pair> some;
        for (std::size_t i = begin; i < end; ++i) {
            if (is_border[i] == 0) continue;
            std::int32_t own = labels[i];
            for (const point_index j : graph[i]) {
                const std::int32_t other = labels[j];
                if (other == unlabeled || other == own) continue;
                if (own == unlabeled) {
                    own = other;
                    continue;
                }
                add_once(region_pair(std::minmax(static_cast<point_index>(own),
                                                 static_cast<point_index>(other))),
                         some);
            }
        }
        const guard_of locked(guard);
        all.insert(all.end(), some.begin(), some.end());
    });
    make_unique(all);
    return all;
}

/// One round. Points that are no border keep their label if they are on the plane.
/// @param edges      between the regions, or none
/// @param is_border  as borders_of; becomes true where that may have changed
/// @return the labels afterwards
template <neighborhood_graph G, execution X>
[[nodiscard]] scratch<std::int32_t> compete(const planar_cloud& cloud, const G& graph,
                                            const scratch<planar_region>& regions,
                                            const auto& edges, const auto& labels,
                                            scratch<char>& is_border, const X& run) {
    scratch<std::int32_t> after(labels.size(), unlabeled);
    for_each_chunk(run, labels.size(), [&](std::size_t begin, std::size_t end) {
        label_competition competition;
        for (std::size_t i = begin; i < end; ++i) {
            if (!cloud.is_finite(i)) continue;
            const auto misfit = [&](std::int32_t label) {
                return misfit_of(cloud, i, regions[static_cast<std::size_t>(label)]);
            };
            if (is_border[i] == 0) {
                if (labels[i] != unlabeled && misfit(labels[i]) >= 0.0) after[i] = labels[i];
                continue;
            }
            competition.begin(graph[i], labels, labels[i]);
            after[i] = competition.winner(misfit, [&](std::int32_t own, std::int32_t other) {
                return edges.is_across(own, other, cloud.offsets[i], cloud.ray(i));
            });
        }
    });
    for_each_chunk(run, labels.size(), [&](std::size_t begin, std::size_t end) {
        const auto has_changed = [&](std::size_t j) { return after[j] != labels[j]; };
        for (std::size_t i = begin; i < end; ++i)
            if (is_border[i] == 0)
                is_border[i] = has_changed(i) || std::ranges::any_of(graph[i], has_changed);
    });
    return after;
}

}  // namespace gnomon::detail
