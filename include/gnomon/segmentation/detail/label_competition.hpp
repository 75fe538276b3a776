// SPDX-License-Identifier: BSL-1.0
/// @file
/// The competition of segments for points: each point goes to the plane that explains it best, and
/// rather to that of most of its neighbors.
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
#include <gnomon/segmentation/detail/region_pairs.hpp>
#include <gnomon/segmentation/detail/surface_noise.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// Of the competition; chosen on furnished rooms 20,001 to 20,012: more take longer, and change the
/// mean IoU by less than its scatter.
inline constexpr int most_rounds = 4;

/// Labels that compete for a point: each plane by how far the point is from it, and by how many of
/// the neighbors of the point have its label (the Potts model, as in Isack and Boykov 2012). (A
/// template, so that only its users compile it.)
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
    /// @param misfit  misfit(label): the square of the deviation of the point, in variances of its
    ///                region; negative if it is impossible
    [[nodiscard]] std::int32_t winner(auto&& misfit) const {
        constexpr double potts = 2.0;  // per share of neighbors with another label; chosen
        std::pair best(std::numeric_limits<double>::infinity(), unlabeled);
        for (const candidate& c : candidates_) {
            const double squared = misfit(c.label);
            if (squared < 0.0) continue;
            const double cost = 0.5 * squared + potts * (1.0 - c.agreeing / neighbors_);
            best = std::min(best, std::pair(cost, c.label));
        }
        return best.second;
    }

    /// Calls each(label) for all labels but this one.
    void for_each_other(std::int32_t label, auto&& each) const {
        for (const candidate& c : candidates_)
            if (c.label != label) each(c.label);
    }

  private:
    struct candidate {
        Label label;
        double agreeing;  // neighbors
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

/// One round. Points that are no border keep their label if they are on the plane.
/// @param is_border  as borders_of; becomes true where that may have changed
/// @return the labels afterwards, and the regions that have neighboring points, each pair once
template <neighborhood_graph G, execution X>
[[nodiscard]] auto compete(const planar_cloud& cloud, const G& graph,
                           const scratch<planar_region>& regions, const auto& labels,
                           scratch<char>& is_border, const X& run) {
    struct {
        scratch<std::int32_t> labels;
        scratch<region_pair> touching = {};
    } after{scratch<std::int32_t>(labels.size(), unlabeled)};
    mutex guard;
    for_each_chunk(run, labels.size(), [&](std::size_t begin, std::size_t end) {
        label_competition competition;
        scratch<region_pair> touching;
        for (std::size_t i = begin; i < end; ++i) {
            if (!cloud.is_finite(i)) continue;
            const auto misfit = [&](std::int32_t label) {
                return misfit_of(cloud, i, regions[static_cast<std::size_t>(label)]);
            };
            std::int32_t& next = after.labels[i];
            if (is_border[i] == 0) {
                if (labels[i] != unlabeled && misfit(labels[i]) >= 0.0) next = labels[i];
                continue;
            }
            competition.begin(graph[i], labels, labels[i]);
            next = competition.winner(misfit);
            if (next == unlabeled) continue;
            competition.for_each_other(next, [&](std::int32_t other) {
                const region_pair pair =
                    std::minmax(static_cast<point_index>(next), static_cast<point_index>(other));
                add_once(pair, touching);
            });
        }
        const guard_of locked(guard);
        after.touching.insert(after.touching.end(), touching.begin(), touching.end());
    });
    make_unique(after.touching);
    for_each_chunk(run, labels.size(), [&](std::size_t begin, std::size_t end) {
        const auto has_changed = [&](std::size_t j) { return after.labels[j] != labels[j]; };
        for (std::size_t i = begin; i < end; ++i)
            if (is_border[i] == 0)
                is_border[i] = has_changed(i) || std::ranges::any_of(graph[i], has_changed);
    });
    return after;
}

}  // namespace gnomon::detail
