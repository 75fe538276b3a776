// SPDX-License-Identifier: BSL-1.0
/// @file
/// The regions of segment_planes once they are grown: those that are one plane merge, and all
/// compete for the points.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/segmentation/detail/plane_growth.hpp>
#include <gnomon/segmentation/detail/plane_of_sums.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// Regions of the points of a position_view.
template <class Points, neighborhood_graph Graph>
class plane_regions {
  public:
    plane_regions(const Points& points, const Graph& graph, const plane_rules& rules,
                  std::vector<std::int32_t> labels)
        : points_(points), graph_(graph), rules_(rules), labels_(std::move(labels)) {
        std::size_t first = 0;
        while (first < points.size() && !is_finite(points[first])) ++first;
        if (first < points.size()) origin_ = points[first];
        std::int32_t last = unlabeled;
        for (const std::int32_t label : labels_) last = std::max(last, label);
        sums_.resize(static_cast<std::size_t>(last + 1));
        planes_.resize(sums_.size());
        refit();
    }

    /// Neighboring regions that are one plane become one, the most alike first.
    void merge() {
        std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> links;
        for (std::size_t i = 0; i < labels_.size(); ++i) {
            if (labels_[i] == unlabeled) continue;
            for (const point_index j : graph_[i]) {
                if (labels_[j] != unlabeled && labels_[j] != labels_[i])
                    ++links[std::minmax(labels_[i], labels_[j])];
            }
        }
        constexpr std::size_t min_links = 5;  // fewer are a touch by chance
        std::map<std::pair<std::int32_t, std::int32_t>, double> unlike;
        for (const auto& [pair, count] : links) {
            if (count >= min_links) unlike[pair] = unlikeness(pair.first, pair.second);
        }
        std::vector<std::int32_t> now(sums_.size());
        for (std::size_t r = 0; r < now.size(); ++r) now[r] = static_cast<std::int32_t>(r);
        for (;;) {
            const auto best =
                std::min_element(unlike.begin(), unlike.end(),
                                 [](const auto& a, const auto& b) { return a.second < b.second; });
            if (best == unlike.end() || !(best->second <= 1.0)) break;
            const auto [kept, gone] = best->first;
            unite(kept, gone, unlike);
            for (std::int32_t& label : now) {
                if (label == gone) label = kept;
            }
        }
        for (std::int32_t& label : labels_) {
            if (label != unlabeled) label = now[static_cast<std::size_t>(label)];
        }
    }

    /// Each point goes to the region among its neighbors that suits it best, or to none.
    /// @return whether any changed
    template <execution X>
    [[nodiscard]] bool compete(const X& run) {
        std::vector<std::int32_t> next(labels_.size(), unlabeled);
        for_each_chunk(run, labels_.size(), [&](std::size_t begin, std::size_t end) {
            std::vector<std::int32_t> around;
            for (std::size_t i = begin; i < end; ++i) {
                if (is_finite(points_[i])) next[i] = best_region(i, around);
            }
        });
        const bool changed = next != labels_;
        labels_ = std::move(next);
        refit();
        return changed;
    }

    /// The labels of the points, and the planes by label; some labels have no points.
    [[nodiscard]] const std::vector<std::int32_t>& labels() const { return labels_; }
    [[nodiscard]] const gnomon::plane& plane_of(std::size_t label) const {
        return planes_[label].plane;
    }

  private:
    /// The variance across a region's plane, at least that of the noise [m^2].
    double variance_of(std::int32_t r) const {
        return std::max(planes_[static_cast<std::size_t>(r)].variance, rules_.noise * rules_.noise);
    }

    /// At most 1 if two regions may be one plane: it is then no farther from the points of either,
    /// in the root mean square, than one and a half times what these scatter about their own.
    double unlikeness(std::int32_t a, std::int32_t b) const {
        constexpr double no = 2.0;
        const auto &one = sums_[static_cast<std::size_t>(a)],
                   &other = sums_[static_cast<std::size_t>(b)];
        const Eigen::Vector3d& n_a = planes_[static_cast<std::size_t>(a)].plane.normal;
        const Eigen::Vector3d& n_b = planes_[static_cast<std::size_t>(b)].plane.normal;
        if (!(std::abs(dot(n_a, n_b)) >= rules_.min_cosine)) return no;
        moments both = one;
        add(both, other);
        const fitted_plane f = fitted(both, origin_);
        if (is_missing(f.plane.normal)) return no;
        constexpr double more = 1.5 * 1.5;
        return std::max(mean_square(one, origin_, f.plane), mean_square(other, origin_, f.plane)) /
               (more * std::max(variance_of(a), variance_of(b)));
    }

    /// Makes one region of two, and renews what was known of the pairs.
    void unite(std::int32_t kept, std::int32_t gone, auto& unlike) {
        const auto k = static_cast<std::size_t>(kept), g = static_cast<std::size_t>(gone);
        add(sums_[k], sums_[g]);
        sums_[g] = {};
        planes_[k] = fitted(sums_[k], origin_);
        std::vector<std::int32_t> others;
        for (auto pair = unlike.begin(); pair != unlike.end();) {
            const auto [a, b] = pair->first;
            if (a == kept || a == gone || b == kept || b == gone) {
                const std::int32_t other = a == kept || a == gone ? b : a;
                if (other != kept && other != gone) others.push_back(other);
                pair = unlike.erase(pair);
            } else {
                ++pair;
            }
        }
        for (const std::int32_t other : others)
            unlike[std::minmax(kept, other)] = unlikeness(kept, other);
    }

    /// The region among those of the neighbors that costs point i least: its squared distance in
    /// variances, as a likelihood, and so much for each neighbor of another region, as of Potts.
    std::int32_t best_region(std::size_t i, std::vector<std::int32_t>& around) const {
        constexpr double all_others = 4.0;
        around.clear();
        std::size_t count = 0;
        for (const point_index j : graph_[i]) {
            ++count;
            if (labels_[j] != unlabeled) around.push_back(labels_[j]);
        }
        if (labels_[i] != unlabeled) around.push_back(labels_[i]);  // may stay, alone
        std::sort(around.begin(), around.end());
        std::int32_t best = unlabeled;
        double least = 0.0;
        for (auto first = around.begin(); first != around.end();) {
            const auto last = std::upper_bound(first, around.end(), *first);
            const double d =
                planes_[static_cast<std::size_t>(*first)].plane.signed_distance(points_[i]);
            const double deviation = d * d / variance_of(*first);
            const double agreeing = static_cast<double>(last - first) - (*first == labels_[i]);
            const double cost =
                0.5 * deviation + all_others * (1.0 - agreeing / static_cast<double>(count));
            if (deviation <= rules_.deviations * rules_.deviations &&
                (best == unlabeled || cost < least)) {
                best = *first;
                least = cost;
            }
            first = last;
        }
        return best;
    }

    /// Sums and planes anew; regions that became too small are given up.
    void refit() {
        for (moments& m : sums_) m = {};
        for (std::size_t i = 0; i < labels_.size(); ++i) {
            if (labels_[i] != unlabeled)
                sums_[static_cast<std::size_t>(labels_[i])].add(difference(points_[i], origin_));
        }
        for (std::size_t r = 0; r < sums_.size(); ++r) planes_[r] = fitted(sums_[r], origin_);
        for (std::int32_t& label : labels_) {
            if (label == unlabeled) continue;
            const auto r = static_cast<std::size_t>(label);
            if (sums_[r].count < rules_.min_points || is_missing(planes_[r].plane.normal))
                label = unlabeled;
        }
    }

    const Points& points_;
    const Graph& graph_;
    plane_rules rules_;
    std::vector<std::int32_t> labels_;
    Eigen::Vector3d origin_{0.0, 0.0, 0.0};
    std::vector<moments> sums_;  // by label, about origin_
    std::vector<fitted_plane> planes_;
};

}  // namespace gnomon::detail
