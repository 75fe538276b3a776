// SPDX-License-Identifier: BSL-1.0
/// @file
/// Neighbors by nanoflann, one point after the other: the oracle for clouds that are too large for
/// brute force. nanoflann's leaf test is strict and its bounds carry rounding, so that points
/// exactly at the limit get lost: the result sets report a limit that is slightly larger and decide
/// exactly. Points that coincide are one place in the tree, so that many of them cost no more than
/// one.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <nanoflann.hpp>

#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/adjacency.hpp>
#include <gnomon/neighborhoods/detail/graph_of.hpp>
#include <gnomon/neighborhoods/detail/size_with_ties.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>

namespace oracles {

/// Places are numbered by the first of their points.
class places {
  public:
    /// Of any indexed range of Eigen::Vector3d. O(n) on average.
    template <class Positions>
    explicit places(const Positions& points) {
        indices_.reserve(points.size());
        positions_.reserve(points.size());
        std::vector<gnomon::point_index> place_of;  // of each finite point, so far in `indices_`
        place_of.reserve(points.size());
        hash_table numbers(points.size());
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Eigen::Vector3d p = points[i];
            if (!gnomon::is_finite(p)) continue;
            const gnomon::point_index number = numbers.find_or_add(p, positions_);
            if (number == positions_.size()) positions_.push_back(p);
            place_of.push_back(number);
            indices_.push_back(static_cast<gnomon::point_index>(i));
        }
        if (positions_.size() < indices_.size()) group(place_of);
    }

    /// The number of places.
    [[nodiscard]] std::size_t size() const { return positions_.size(); }
    /// The number of points at all places together.
    [[nodiscard]] std::size_t points() const { return indices_.size(); }

    [[nodiscard]] const Eigen::Vector3d& position(std::size_t place) const {
        return positions_[place];
    }
    /// The indices of the points there, ascending and at least one.
    [[nodiscard]] std::span<const gnomon::point_index> at(std::size_t place) const {
        if (begin_.empty()) return {indices_.data() + place, 1};
        return {indices_.data() + begin_[place], indices_.data() + begin_[place + 1]};
    }

  private:
    /// Open addressing, linear probing, at most half full.
    class hash_table {
      public:
        explicit hash_table(std::size_t points)
            : slots_(std::bit_ceil(2 * points + 2), empty), mask_(slots_.size() - 1) {}

        /// The number of the place at p; positions.size(), now taken, if there is none yet.
        gnomon::point_index find_or_add(const Eigen::Vector3d& p,
                                        const std::vector<Eigen::Vector3d>& positions) {
            std::size_t s = hash(p) & mask_;
            while (slots_[s] != empty && !equal(positions[slots_[s]], p)) s = (s + 1) & mask_;
            if (slots_[s] == empty) slots_[s] = static_cast<gnomon::point_index>(positions.size());
            return slots_[s];
        }

      private:
        static constexpr gnomon::point_index empty =
            std::numeric_limits<gnomon::point_index>::max();

        static bool equal(const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
            return p.x() == q.x() && p.y() == q.y() && p.z() == q.z();
        }

        static std::size_t hash(const Eigen::Vector3d& p) {
            std::uint64_t h = 0;
            for (const double x : {p.x(), p.y(), p.z()}) {
                h ^= std::bit_cast<std::uint64_t>(x + 0.0);  // -0.0 is where 0.0 is
                h *= 0x9e3779b97f4a7c15;                     // 2^64 / golden ratio, odd
                h ^= h >> 32;
            }
            return static_cast<std::size_t>(h);
        }

        std::vector<gnomon::point_index> slots_;
        std::size_t mask_;
    };

    /// Puts the indices of each place side by side (a counting sort, which keeps them ascending).
    void group(const std::vector<gnomon::point_index>& place_of) {
        begin_.assign(size() + 1, 0);
        for (const gnomon::point_index place : place_of) ++begin_[place + 1];
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        std::vector<gnomon::point_index> next(begin_.begin(), begin_.end() - 1);
        std::vector<gnomon::point_index> grouped(indices_.size());
        for (std::size_t i = 0; i < place_of.size(); ++i) {
            grouped[next[place_of[i]]++] = indices_[i];
        }
        indices_ = std::move(grouped);
    }

    std::vector<Eigen::Vector3d> positions_;
    std::vector<gnomon::point_index> indices_;
    std::vector<gnomon::point_index>
        begin_;  // of each place in indices_; empty if each holds one point
};

#if NANOFLANN_VERSION >= 0x150
using nanoflann_parameters = nanoflann::SearchParameters;
#else
using nanoflann_parameters = nanoflann::SearchParams;
#endif

/// The points in the tree, with the interface that nanoflann requires.
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
        return gnomon::squared_distance({q[0], q[1], q[2]}, all.position(i));
    }
    [[nodiscard]] double accum_dist(double a, double b, std::size_t) const {
        return (a - b) * (a - b);
    }
};

using nanoflann_tree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann_metric, nanoflann_places, 3, gnomon::point_index>;

/// A limit that nanoflann must not prune at: its bounds err by a few ulp per level of the tree, and
/// ties may be a little farther than the k-th.
[[nodiscard]] inline double just_beyond(double squared_distance,
                                        gnomon::tie_rule rule = gnomon::tie_rule::by_index) {
    const double margin = rule == gnomon::tie_rule::all ? 2e-9 : 1e-12;
    return squared_distance * (1.0 + margin) + std::numeric_limits<double>::min();
}

/// What both result sets share with every nanoflann version.
struct nanoflann_result_set {
    using DistanceType = double;
    using IndexType = gnomon::point_index;

    static void sort() {}  // ours keep their own order
};

/// Cuts a list in canonical order to the k nearest, and those that the rule adds to them.
/// Precondition: k > 0.
inline void keep_nearest(std::vector<gnomon::neighbor>& found, std::size_t k,
                         gnomon::tie_rule rule) {
    if (found.size() <= k) return;
    found.resize(rule == gnomon::tie_rule::all ? gnomon::detail::size_with_ties(found, k, 2 * k)
                                               : k);
}

/// Collects the k nearest points, and those that the rule adds to them; finish() leaves them in
/// canonical order. Few are inserted into a sorted list; of many, the farthest are dropped from
/// time to time, so that the work stays linear.
class nearest_result_set : public nanoflann_result_set {
  public:
    /// Precondition: k > 0.
    nearest_result_set(const places& all, std::size_t k, gnomon::tie_rule rule,
                       std::vector<gnomon::neighbor>& found)
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

    bool addPoint(double squared_distance, gnomon::point_index place) {
        const auto points = all_.at(place);
        const std::size_t most = rule_ == gnomon::tie_rule::all ? 2 * k_ : k_;
        for (const gnomon::point_index index : points.first(std::min(points.size(), most))) {
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
    /// Performance only: insertion into a longer sorted list is slower than sorting at the end.
    [[nodiscard]] bool is_sorted() const { return k_ <= 128; }

    void append(const gnomon::neighbor& candidate) {
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

    void insert(const gnomon::neighbor& candidate) {
        if (rule_ == gnomon::tie_rule::by_index && full() && !(candidate < found_.back())) return;
        found_.push_back(candidate);
        gnomon::neighbor* slot = &found_.back();
        for (; slot != found_.data() && candidate < slot[-1]; --slot) *slot = slot[-1];
        *slot = candidate;
        keep_nearest(found_, k_, rule_);
    }

    const places& all_;
    std::size_t k_;
    gnomon::tie_rule rule_;
    std::vector<gnomon::neighbor>& found_;
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

    bool addPoint(double squared_distance, gnomon::point_index place) {
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

/// An index over the finite points of a range.
class nanoflann_index {
  public:
    template <class R>
    explicit nanoflann_index(const R& points)
        : places_(gnomon::position_view<R>(points)),
          tree_(3, places_, nanoflann::KDTreeSingleIndexAdaptorParams(12)) {
        tree_.buildIndex();
    }
    nanoflann_index(const nanoflann_index&) = delete;

    /// The k nearest to p but for point number `except`.
    void nearest(const Eigen::Vector3d& p, std::size_t k, std::size_t except,
                 std::vector<gnomon::neighbor>& found,
                 gnomon::tie_rule rule = gnomon::tie_rule::by_index) const {
        found.clear();
        k = std::min(k, places_.points());
        if (k == 0) return;
        nearest_result_set results(places_, k + 1, rule, found);  // `except` may be among them
        tree_.findNeighbors(results, p.data(), nanoflann_parameters());
        results.finish();
        std::erase_if(found, [except](const auto& q) { return q.index == except; });
        keep_nearest(found, k, rule);
    }

    /// Those at most `radius` from p but for point number `except`.
    void within(const Eigen::Vector3d& p, double radius, std::size_t except,
                std::vector<gnomon::neighbor>& found) const {
        found.clear();
        if (places_.size() == 0) return;
        const auto visit = [&](double squared, gnomon::point_index place) {
            for (const gnomon::point_index i : places_.at(place))
                if (i != except) found.push_back({squared, i});
        };
        ball_result_set results(radius * radius, visit);
        tree_.findNeighbors(results, p.data(), nanoflann_parameters());
        std::sort(found.begin(), found.end());
    }

  private:
    nanoflann_places places_;
    nanoflann_tree tree_;
};

/// The graph of the neighbors that find(index, p, i, found) finds for each finite point.
template <class R>
[[nodiscard]] gnomon::adjacency graph(const R& points, auto&& find) {
    const nanoflann_index index(points);
    const gnomon::position_view<R> p(points);
    return gnomon::detail::collected_graph<false>(
        p.size(), gnomon::threads{}, [&](std::size_t i, std::vector<gnomon::neighbor>& found) {
            found.clear();
            if (gnomon::is_finite(p[i])) find(index, p[i], i, found);
            return gnomon::neighborhood_note{};
        });
}

/// The graph that knn{k, ties} must give.
template <class R>
[[nodiscard]] gnomon::adjacency knn_graph(const R& points, std::size_t k,
                                          gnomon::tie_rule ties = gnomon::tie_rule::by_index) {
    return graph(points, [=](const auto& index, const auto& p, std::size_t i, auto& found) {
        index.nearest(p, k, i, found, ties);
    });
}

/// The graph that hybrid{k, r} must give, and for k of any size radius{r}.
template <class R>
[[nodiscard]] gnomon::adjacency graph_within(
    const R& points, double r, std::size_t k = std::numeric_limits<std::size_t>::max()) {
    return graph(points, [=](const auto& index, const auto& p, std::size_t i, auto& found) {
        index.within(p, r, i, found);
        if (found.size() > k) found.resize(k);
    });
}

}  // namespace oracles
