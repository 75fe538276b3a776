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
#include <gnomon/neighborhoods/neighborhood.hpp>

static_assert(NANOFLANN_VERSION >= 0x142, "gnomon needs nanoflann 1.4.3, which calls itself 0x142");

namespace gnomon::detail {

#if NANOFLANN_VERSION >= 0x150
using nanoflann_parameters = nanoflann::SearchParameters;
#else
using nanoflann_parameters = nanoflann::SearchParams;
#endif

/// The points in the tree, as nanoflann wants to see them.
struct nanoflann_points {
    std::vector<Eigen::Vector3d> positions;

    [[nodiscard]] std::size_t kdtree_get_point_count() const { return positions.size(); }
    [[nodiscard]] double kdtree_get_pt(std::size_t i, std::size_t axis) const {
        return positions[i][static_cast<Eigen::Index>(axis)];
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

    const nanoflann_points& points;

    explicit nanoflann_metric(const nanoflann_points& p) : points(p) {}

    [[nodiscard]] double evalMetric(const double* q, std::size_t i, std::size_t) const {
        return squared_distance({q[0], q[1], q[2]}, points.positions[i]);
    }
    [[nodiscard]] double accum_dist(double a, double b, std::size_t) const {
        return (a - b) * (a - b);
    }
};

using nanoflann_tree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann_metric, nanoflann_points, 3, point_index>;

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
    std::size_t kept = k;
    if (rule == tie_rule::all) {
        const double limit = found[k - 1].squared_distance * (1.0 + 1e-9);
        while (kept < std::min(found.size(), 2 * k) && found[kept].squared_distance <= limit) {
            ++kept;
        }
    }
    found.resize(kept);
}

/// Collects the k nearest points in canonical order, and those that the rule adds to them.
class nearest_result_set : public nanoflann_result_set {
  public:
    nearest_result_set(std::size_t k, tie_rule rule, std::vector<neighbor>& found)
        : k_(k), rule_(rule), found_(found) {}

    [[nodiscard]] std::size_t size() const { return found_.size(); }
    [[nodiscard]] bool empty() const { return found_.empty(); }
    [[nodiscard]] bool full() const { return found_.size() >= k_; }
    [[nodiscard]] double worstDist() const {
        return full() ? just_beyond(found_.back().squared_distance, rule_)
                      : std::numeric_limits<double>::infinity();
    }

    bool addPoint(double squared_distance, point_index slot) {
        const neighbor candidate{squared_distance, slot};
        if (rule_ == tie_rule::by_index && full() && !(candidate < found_.back())) return true;
        found_.push_back(candidate);
        neighbor* place = &found_.back();
        for (; place != found_.data() && candidate < place[-1]; --place) *place = place[-1];
        *place = candidate;
        keep_nearest(found_, k_, rule_);
        return true;
    }

  private:
    std::size_t k_;
    tie_rule rule_;
    std::vector<neighbor>& found_;
};

/// Hands every point within a limit, the limit included, to a visitor.
template <class Visitor>
class ball_result_set : public nanoflann_result_set {
  public:
    ball_result_set(double squared_radius, const Visitor& visit)
        : squared_radius_(squared_radius), visit_(visit) {}

    [[nodiscard]] std::size_t size() const { return visited_; }
    [[nodiscard]] bool empty() const { return visited_ == 0; }
    [[nodiscard]] bool full() const { return true; }
    [[nodiscard]] double worstDist() const { return just_beyond(squared_radius_); }

    bool addPoint(double squared_distance, point_index slot) {
        if (squared_distance > squared_radius_) return true;
        ++visited_;
        visit_(neighbor{squared_distance, slot});
        return true;
    }

  private:
    double squared_radius_;
    const Visitor& visit_;
    std::size_t visited_ = 0;
};

}  // namespace gnomon::detail
