// SPDX-License-Identifier: BSL-1.0
/// @file
/// The one place that knows nanoflann. Two things are put right here: versions (1.5 renamed the
/// search parameters and sorts results of its own accord), and ties: nanoflann's leaf test is
/// strict and its bounds on boxes carry rounding, so that points exactly at the limit get lost. Our
/// result sets report a limit that is a hair larger and then decide by themselves, exactly.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>
#include <nanoflann.hpp>

#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/detail/places.hpp>
#include <gnomon/neighborhoods/detail/size_with_ties.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>

static_assert(NANOFLANN_VERSION >= 0x142, "gnomon needs nanoflann 1.4.3, which calls itself 0x142");

namespace gnomon::detail {

#if NANOFLANN_VERSION >= 0x150
using nanoflann_parameters = nanoflann::SearchParameters;
#else
using nanoflann_parameters = nanoflann::SearchParams;
#endif

/// The places in the tree, as nanoflann wants to see them.
struct nanoflann_places : places {
    using places::places;

    [[nodiscard]] std::size_t kdtree_get_point_count() const { return size(); }
    [[nodiscard]] double kdtree_get_pt(std::size_t i, std::size_t axis) const {
        return position(i)[static_cast<Eigen::Index>(axis)];
    }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
        return false;  // let nanoflann compute it
    }
};

/// The canonical distance as a nanoflann metric.
struct nanoflann_metric {
    using ElementType = double;
    using DistanceType = double;

    const nanoflann_places& all;

    explicit nanoflann_metric(const nanoflann_places& p) : all(p) {}

    [[nodiscard]] double evalMetric(const double* q, std::size_t i, std::size_t) const {
        return squared_distance({q[0], q[1], q[2]}, all.position(i));
    }
    [[nodiscard]] double accum_dist(double a, double b, std::size_t) const {
        return (a - b) * (a - b);
    }
};

using nanoflann_tree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann_metric, nanoflann_places, 3, point_index>;

/// A limit that nanoflann must not prune at: its bounds err by a few ulp per level of the tree, and
/// ties may be a little farther than the k-th.
[[nodiscard]] inline double just_beyond(double squared_distance,
                                        tie_rule rule = tie_rule::by_index) {
    const double margin = rule == tie_rule::all ? 2e-9 : 1e-12;
    return squared_distance * (1.0 + margin) + std::numeric_limits<double>::min();
}

/// What both result sets share with every nanoflann version.
struct nanoflann_result_set {
    using DistanceType = double;
    using IndexType = point_index;

    static void sort() {}  // ours keep their own order
};

/// Cuts a list in canonical order to the k nearest, and those that the rule adds to them.
/// Precondition: k > 0.
inline void keep_nearest(std::vector<neighbor>& found, std::size_t k, tie_rule rule) {
    if (found.size() <= k) return;
    found.resize(rule == tie_rule::all ? size_with_ties(found, k, 2 * k) : k);
}

/// Collects the k nearest points, and those that the rule adds to them; finish() leaves them in
/// canonical order. Few are inserted into a sorted list; of many, the farthest are dropped from
/// time to time, so that the work stays linear.
class nearest_result_set : public nanoflann_result_set {
  public:
    /// Precondition: k > 0.
    nearest_result_set(const places& all, std::size_t k, tie_rule rule,
                       std::vector<neighbor>& found)
        : all_(all), k_(k), rule_(rule), found_(found) {}

    [[nodiscard]] std::size_t size() const { return found_.size(); }
    [[nodiscard]] bool empty() const { return found_.empty(); }
    [[nodiscard]] bool full() const { return found_.size() >= k_; }
    [[nodiscard]] double worstDist() const {
        if (is_sorted()) {
            return full() ? just_beyond(found_.back().squared_distance, rule_)
                          : std::numeric_limits<double>::infinity();
        }
        return limit_;
    }

    bool addPoint(double squared_distance, point_index place) {
        const auto points = all_.at(place);
        const std::size_t most = rule_ == tie_rule::all ? 2 * k_ : k_;
        for (const point_index index : points.first(std::min(points.size(), most))) {
            if (is_sorted())
                insert({squared_distance, index});
            else
                append({squared_distance, index});
        }
        return true;
    }

    void finish() {
        if (is_sorted()) return;
        std::sort(found_.begin(), found_.end());
        keep_nearest(found_, k_, rule_);
    }

  private:
    /// Beyond so many, moving them to insert one costs more than it saves.
    [[nodiscard]] bool is_sorted() const { return k_ <= 128; }

    void append(const neighbor& candidate) {
        found_.push_back(candidate);
        if (found_.size() / 4 < k_) return;
        const auto at = [this](std::size_t i) {
            return found_.begin() + static_cast<std::ptrdiff_t>(i);
        };
        std::nth_element(found_.begin(), at(k_ - 1), found_.end());
        limit_ = just_beyond(found_[k_ - 1].squared_distance, rule_);
        // Ties of the k-th may be among twice as many.
        std::nth_element(at(k_), at(2 * k_), found_.end());
        found_.resize(2 * k_);
    }

    void insert(const neighbor& candidate) {
        if (rule_ == tie_rule::by_index && full() && !(candidate < found_.back())) return;
        found_.push_back(candidate);
        neighbor* slot = &found_.back();
        for (; slot != found_.data() && candidate < slot[-1]; --slot) *slot = slot[-1];
        *slot = candidate;
        keep_nearest(found_, k_, rule_);
    }

    const places& all_;
    std::size_t k_;
    tie_rule rule_;
    std::vector<neighbor>& found_;
    double limit_ = std::numeric_limits<double>::infinity();  // if not sorted
};

/// Hands every place within a limit, the limit included, to a visitor.
template <class Visitor>
class ball_result_set : public nanoflann_result_set {
  public:
    ball_result_set(double squared_radius, const Visitor& visit)
        : squared_radius_(squared_radius), visit_(visit) {}

    [[nodiscard]] std::size_t size() const { return visited_; }
    [[nodiscard]] bool empty() const { return visited_ == 0; }
    [[nodiscard]] bool full() const { return true; }
    [[nodiscard]] double worstDist() const { return just_beyond(squared_radius_); }

    bool addPoint(double squared_distance, point_index place) {
        if (squared_distance > squared_radius_) return true;
        ++visited_;
        visit_(squared_distance, place);
        return true;
    }

  private:
    double squared_radius_;
    const Visitor& visit_;
    std::size_t visited_ = 0;
};

}  // namespace gnomon::detail
