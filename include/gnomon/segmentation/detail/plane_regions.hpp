// SPDX-License-Identifier: BSL-1.0
/// @file
/// The regions of segment_planes once they are grown: those that are one plane merge, and all
/// compete for the points.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/union_find.hpp>
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
        regions_.resize(static_cast<std::size_t>(last + 1));
        refit();
    }

    /// Neighboring regions that are one plane become one, the most alike first.
    void merge() {
        meet();
        std::vector<candidate> heap;
        for (std::int32_t a = 0; a < count(); ++a) {
            for (const std::int32_t b : at(a).beside) {
                if (a < b) push(heap, a, b);
            }
        }
        union_find whole(regions_.size());
        while (!heap.empty()) {
            std::pop_heap(heap.begin(), heap.end(), later);
            const candidate c = heap.back();
            heap.pop_back();
            // Regions that have changed since have a newer candidate, or were merged.
            if (at(c.a).age != c.age_of_a || at(c.b).age != c.age_of_b) continue;
            whole.unite(static_cast<point_index>(c.a), static_cast<point_index>(c.b));
            take_in(c.a, c.b);
            for (const std::int32_t other : at(c.a).beside)
                push(heap, std::min(c.a, other), std::max(c.a, other));
        }
        for (std::int32_t& label : labels_) {
            if (label != unlabeled)
                label = static_cast<std::int32_t>(whole.find(static_cast<point_index>(label)));
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
        return regions_[label].fit.plane;
    }

  private:
    struct region {
        moments sums{};  ///< of its points, about origin_
        fitted_plane fit{};
        std::vector<std::int32_t> beside = {};  ///< those that it touches, ascending
        std::uint32_t age = 0;                  ///< how often it has changed while merging
    };

    region& at(std::int32_t label) { return regions_[static_cast<std::size_t>(label)]; }
    const region& at(std::int32_t label) const { return regions_[static_cast<std::size_t>(label)]; }
    std::int32_t count() const { return static_cast<std::int32_t>(regions_.size()); }

    /// The variance across a region's plane, at least that of the noise [m^2].
    double variance_of(std::int32_t r) const {
        return std::max(at(r).fit.variance, rules_.noise * rules_.noise);
    }

    /// At most 1 if two regions may be one plane: it is then no farther from the points of either,
    /// in the root mean square, than one and a half times what these scatter about their own.
    double unlikeness(std::int32_t a, std::int32_t b) const {
        constexpr double no = 2.0;
        const moments &one = at(a).sums, &other = at(b).sums;
        const double cosine = dot(at(a).fit.plane.normal, at(b).fit.plane.normal);
        if (!(std::abs(cosine) >= rules_.min_cosine)) return no;
        moments both = one;
        add(both, other);
        const fitted_plane f = fitted(both, origin_);
        if (is_missing(f.plane.normal)) return no;
        constexpr double more = 1.5 * 1.5;
        return std::max(mean_square(one, origin_, f.plane), mean_square(other, origin_, f.plane)) /
               (more * std::max(variance_of(a), variance_of(b)));
    }

    /// Makes known to each region which others it touches.
    void meet() {
        for (region& r : regions_) {
            r.beside.clear();
            r.age = 0;
        }
        for (std::size_t i = 0; i < labels_.size(); ++i) {
            if (labels_[i] == unlabeled) continue;
            for (const point_index j : graph_[i]) {
                if (labels_[j] == unlabeled || labels_[j] == labels_[i]) continue;
                at(labels_[i]).beside.push_back(labels_[j]);
                at(labels_[j]).beside.push_back(labels_[i]);
            }
        }
        constexpr std::ptrdiff_t min_links = 5;  // fewer are a touch by chance
        for (region& r : regions_) {
            std::sort(r.beside.begin(), r.beside.end());
            auto kept = r.beside.begin();
            for (auto first = r.beside.begin(); first != r.beside.end();) {
                const auto last = std::upper_bound(first, r.beside.end(), *first);
                if (last - first >= min_links) *kept++ = *first;
                first = last;
            }
            r.beside.erase(kept, r.beside.end());
        }
    }

    /// Two regions that may become one.
    struct candidate {
        double unlikeness;
        std::int32_t a, b;
        std::uint32_t age_of_a, age_of_b;
    };
    static bool later(const candidate& x, const candidate& y) {
        return std::tie(x.unlikeness, x.a, x.b) > std::tie(y.unlikeness, y.a, y.b);
    }
    void push(auto& heap, std::int32_t a, std::int32_t b) {
        const double apart = unlikeness(a, b);
        if (!(apart <= 1.0)) return;
        heap.push_back({apart, a, b, at(a).age, at(b).age});
        std::push_heap(heap.begin(), heap.end(), later);
    }

    /// Makes one region of two.
    void take_in(std::int32_t kept, std::int32_t gone) {
        region &k = at(kept), &g = at(gone);
        add(k.sums, g.sums);
        k.fit = fitted(k.sums, origin_);
        ++k.age;
        ++g.age;
        for (const std::int32_t other : g.beside) {
            if (other == kept) continue;
            auto& names = at(other).beside;
            std::erase(names, gone);
            if (!std::binary_search(names.begin(), names.end(), kept)) {
                names.insert(std::upper_bound(names.begin(), names.end(), kept), kept);
                k.beside.push_back(other);
            }
        }
        std::erase(k.beside, gone);
        std::sort(k.beside.begin(), k.beside.end());
        g.beside.clear();
    }

    /// The region among those of the neighbors that costs point i least: its squared distance in
    /// variances (a likelihood), and a Potts term for each neighbor of another region.
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
            const double d = at(*first).fit.plane.signed_distance(points_[i]);
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

    /// Computes sums and planes again; regions that became too small are removed.
    void refit() {
        for (region& r : regions_) r.sums = {};
        for (std::size_t i = 0; i < labels_.size(); ++i) {
            if (labels_[i] != unlabeled) at(labels_[i]).sums.add(difference(points_[i], origin_));
        }
        for (region& r : regions_) r.fit = fitted(r.sums, origin_);
        for (std::int32_t& label : labels_) {
            if (label == unlabeled) continue;
            const region& r = at(label);
            if (r.sums.count < rules_.min_points || is_missing(r.fit.plane.normal))
                label = unlabeled;
        }
    }

    const Points& points_;
    const Graph& graph_;
    plane_rules rules_;
    std::vector<std::int32_t> labels_;
    Eigen::Vector3d origin_{0.0, 0.0, 0.0};
    std::vector<region> regions_;  // by label
};

}  // namespace gnomon::detail
