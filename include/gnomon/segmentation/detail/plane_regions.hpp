// SPDX-License-Identifier: BSL-1.0
/// @file
/// A labeling of a cloud by planes: their growth, the merging of neighbors, and the competition for
/// points, in turns.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/segmentation/detail/agglomeration.hpp>
#include <gnomon/segmentation/detail/label_competition.hpp>
#include <gnomon/segmentation/detail/planar_cloud.hpp>
#include <gnomon/segmentation/detail/plane_comparison.hpp>
#include <gnomon/segmentation/detail/plane_growth.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// The regions of a cloud.
template <neighborhood_graph G>
class plane_regions {
  public:
    plane_regions(const planar_cloud& cloud, const G& graph, std::size_t min_points,
                  scratch<std::int32_t> labels)
        : cloud_(cloud), graph_(graph), min_points_(min_points), labels_(std::move(labels)) {
        refit();
    }

    [[nodiscard]] const scratch<std::int32_t>& labels() const { return labels_; }
    [[nodiscard]] const scratch<planar_region>& regions() const { return regions_; }

    /// Adds regions that are not planar.
    /// @param more  the labels of unlabeled points: new regions are numbered from 0 on
    void add_regions(const auto& more) {
        const auto first = static_cast<std::int32_t>(regions_.size());
        for (std::size_t i = 0; i < labels_.size(); ++i) {
            if (labels_[i] != unlabeled || more[i] == unlabeled) continue;
            labels_[i] = first + more[i];
            const auto r = static_cast<std::size_t>(labels_[i]);
            while (regions_.size() <= r) regions_.push_back({{}, {}, false});
        }
    }

    /// Grows new regions in what is unlabeled; then rounds of merging and competition, until
    /// nothing changes.
    template <normal_range S, execution X>
    void grow(const S& surface, double min_cosine, const X& run) {
        plane_growth(cloud_, graph_, surface, min_points_, min_cosine, labels_)(
            static_cast<std::int32_t>(regions_.size()), run);
        refit();
        is_border_ = borders_of(graph_, labels_, run);
        merge_neighbors();
        for (int round = 0; round < most_rounds && compete(run); ++round) merge_neighbors();
    }

  private:
    /// Merges regions next to each other that one plane explains.
    void merge_neighbors() {
        union_find sets = agglomeration(regions_)(
            touching(),
            [](const planar_region& a, const planar_region& b) {
                return unlikeness_of_neighbors(a, b);
            },
            [](point_index, point_index) { return true; }, [](point_index, point_index) {});
        for (std::size_t r = 0; r < regions_.size(); ++r)
            if (sets.find(static_cast<point_index>(r)) != r) regions_[r] = {};
        for (std::int32_t& label : labels_)
            if (label != unlabeled)
                label = static_cast<std::int32_t>(sets.find(static_cast<point_index>(label)));
        drop_small();
    }

    /// Each point goes to the region, among those of its neighbors and its own, that explains it
    /// best; to none if all are too far. Planes are fit again.
    /// @return whether a label has changed
    template <execution X>
    bool compete(const X& run) {
        scratch<std::int32_t> next =
            labels_after_competition(cloud_, graph_, regions_, labels_, is_border_, run);
        labels_.swap(next);
        if (labels_ == next) return false;
        refit();
        return true;
    }

    /// Sums and planes of the labels.
    void refit() {
        std::int32_t most = unlabeled;
        for (const std::int32_t label : labels_) most = std::max(most, label);
        regions_.assign(static_cast<std::size_t>(most + 1), {});
        for (std::size_t i = 0; i < labels_.size(); ++i)
            if (labels_[i] != unlabeled)
                cloud_.add(i, regions_[static_cast<std::size_t>(labels_[i])].sums);
        for (planar_region& r : regions_) r.fit = r.sums.fit();
        drop_small();
    }

    /// Regions that are too small, or no planes, are none; the others are numbered again.
    void drop_small() {
        scratch<std::int32_t> number(regions_.size(), unlabeled);
        std::size_t kept = 0;
        for (std::size_t r = 0; r < regions_.size(); ++r) {
            if (regions_[r].sums.count < min_points_ || !regions_[r].fit.is_determined) continue;
            number[r] = static_cast<std::int32_t>(kept);
            regions_[kept++] = regions_[r];
        }
        if (kept == regions_.size()) return;
        regions_.resize(kept);
        for (std::int32_t& label : labels_)
            if (label != unlabeled) label = number[static_cast<std::size_t>(label)];
    }

    /// Pairs of regions that have neighboring points.
    [[nodiscard]] scratch<region_pair> touching() const {
        scratch<region_pair> pairs;
        for (std::size_t i = 0; i < labels_.size(); ++i) {
            if (is_border_[i] == 0 || labels_[i] == unlabeled) continue;
            for (const point_index j : graph_[i]) {
                if (labels_[j] == unlabeled || labels_[j] == labels_[i]) continue;
                const auto [a, b] = std::minmax(labels_[i], labels_[j]);
                const region_pair pair(a, b);
                if (pairs.empty() || pairs.back() != pair) pairs.push_back(pair);
            }
        }
        make_unique(pairs);
        return pairs;
    }

    const planar_cloud& cloud_;
    const G& graph_;
    std::size_t min_points_;
    scratch<std::int32_t> labels_;
    scratch<planar_region> regions_;
    scratch<char> is_border_;  // as borders_of, or more
};

}  // namespace gnomon::detail
