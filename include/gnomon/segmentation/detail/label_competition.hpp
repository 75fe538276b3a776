// SPDX-License-Identifier: BSL-1.0
/// @file
/// The competition of segments for points: each point goes to the plane that explains it best, and
/// rather to that of most of its neighbors.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/segmentation/detail/planar_cloud.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>
#include <gnomon/segmentation/detail/surface_noise.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

inline constexpr int most_rounds = 6;  // of the competition; chosen

/// Labels that compete for a point: each plane by how far the point is from it, and by how many of
/// the neighbors of the point have its label (the Potts model, as in Isack and Boykov 2012).
class label_competition {
  public:
    /// Begins with the labels of the neighbors of a point.
    template <class Neighbors>
    void begin(const Neighbors& neighbors, const auto& labels, std::int32_t own) {
        around_.clear();
        for (const point_index j : neighbors)
            if (labels[j] != unlabeled) around_.push_back(labels[j]);
        if (own != unlabeled) around_.push_back(own);
        std::sort(around_.begin(), around_.end());
        own_ = own;
        neighbors_ = static_cast<double>(std::max<std::size_t>(neighbors.size(), 1));
    }

    /// The best label; unlabeled if none is possible.
    /// @param misfit  misfit(label): the square of the deviation of the point, in variances of its
    ///                region; negative if it is impossible
    [[nodiscard]] std::int32_t winner(auto&& misfit) const {
        constexpr double potts = 2.0;  // per share of neighbors with another label; chosen
        std::int32_t best = unlabeled;
        double least = 0.0;
        for (auto first = around_.begin(); first != around_.end();) {
            const auto last = std::upper_bound(first, around_.end(), *first);
            const std::int32_t label = *first;
            const double agree = static_cast<double>(last - first) - (label == own_ ? 1.0 : 0.0);
            first = last;
            const double squared = misfit(label);
            if (squared < 0.0) continue;
            const double cost = 0.5 * squared + potts * (1.0 - agree / neighbors_);
            if (best == unlabeled || cost < least) {
                best = label;
                least = cost;
            }
        }
        return best;
    }

  private:
    scratch<std::int32_t> around_;  // sorted
    std::int32_t own_ = unlabeled;
    double neighbors_ = 1.0;
};

/// The square of the deviation of a point from the plane of a region, in variances of the region;
/// negative if it is too far. A region that is not planar is as near as a plane at one standard
/// deviation.
[[nodiscard]] inline double misfit_of(const Eigen::Vector3d& offset, const point_noise& noise,
                                      const planar_region& to) {
    if (!to.is_planar) return 1.0;
    const plane& p = to.fit.plane;
    const double deviations = p.signed_distance(offset) / noise.across(p.normal);
    const double squared = deviations * deviations / to.fit.excess();
    return squared <= most_deviations * most_deviations ? squared : -1.0;
}
[[nodiscard]] inline double misfit_of(const planar_cloud& cloud, std::size_t i,
                                      const planar_region& to) {
    return misfit_of(cloud.offsets[i], cloud.noise[i], to);
}

/// Whether a point is certainly not of the plane of a region, whatever its other points.
[[nodiscard]] inline bool is_certainly_off(const Eigen::Vector3d& offset, const point_noise& noise,
                                           const planar_region& region) {
    const plane& p = region.fit.plane;
    return region.is_planar && std::abs(p.signed_distance(offset)) > noise.certain_reach(p.normal);
}

/// Whether all neighbors have the label of the point itself, as most have: performance only.
template <class Neighbors>
[[nodiscard]] bool is_alone(const Neighbors& neighbors, const auto& labels, std::int32_t own) {
    for (const point_index j : neighbors)
        if (labels[j] != own) return false;
    return true;
}

/// The labels of the points of a cloud after one round.
template <neighborhood_graph G, execution X>
[[nodiscard]] scratch<std::int32_t> labels_after_competition(const planar_cloud& cloud,
                                                             const G& graph,
                                                             const scratch<planar_region>& regions,
                                                             const auto& labels, const X& run) {
    scratch<std::int32_t> next(labels.size(), unlabeled);
    for_each_chunk(run, labels.size(), [&](std::size_t begin, std::size_t end) {
        label_competition competition;
        for (std::size_t i = begin; i < end; ++i) {
            if (!cloud.is_finite(i)) continue;
            const auto misfit = [&](std::int32_t label) {
                return misfit_of(cloud, i, regions[static_cast<std::size_t>(label)]);
            };
            if (const std::int32_t own = labels[i]; is_alone(graph[i], labels, own)) {
                if (own != unlabeled && misfit(own) >= 0.0) next[i] = own;
                continue;
            }
            competition.begin(graph[i], labels, labels[i]);
            next[i] = competition.winner(misfit);
        }
    });
    return next;
}

}  // namespace gnomon::detail
