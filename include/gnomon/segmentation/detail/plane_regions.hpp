// SPDX-License-Identifier: BSL-1.0
/// @file
/// The regions of segment_planes while they are made: each the sums over its points, from which its
/// plane and that of two regions together follow without looking at a point again.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/normals/plane_fit.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// The least squares plane of points.
struct fitted_plane {
    gnomon::plane plane{Eigen::Vector3d(0.0, 0.0, 0.0), 0.0};  ///< no normal if not determined
    double variance = 0.0;                                     ///< of the points across it [m^2]
};

/// Adds the moments about the same point.
inline void add(moments& to, const moments& more) {
    to.count += more.count;
    for (int j = 0; j < 3; ++j) {
        to.sum[j] += more.sum[j];
        for (int i = j; i < 3; ++i) to.outer(i, j) += more.outer(i, j);
    }
}

/// The plane of points with these moments about `origin`.
[[nodiscard]] inline fitted_plane fitted(const moments& m, const Eigen::Vector3d& origin) {
    fitted_plane f;
    if (m.count < 3) return f;
    const plane_fit fit = plane_of_least_spread(m.covariance_of_neighbors(), 0.0);
    if (!usable(fit.trust)) return f;
    const Eigen::Vector3d mean = combined(1.0, origin, 1.0 / static_cast<double>(m.count), m.sum);
    f.plane = {fit.normal, dot(fit.normal, mean)};
    f.variance = fit.spectrum.lambda[2];
    return f;
}

/// The mean squared distance [m^2] of points with these moments about `origin` from a plane.
[[nodiscard]] inline double mean_square(const moments& m, const Eigen::Vector3d& origin,
                                        const plane& to) {
    const Eigen::Matrix3d c = m.covariance_of_neighbors();
    const Eigen::Vector3d mean = combined(1.0, origin, 1.0 / static_cast<double>(m.count), m.sum);
    const double off = to.signed_distance(mean);
    return dot(to.normal, product(c, to.normal)) + off * off;
}

/// What regions have to keep to.
struct plane_rules {
    double noise;       ///< sigma, across the surface [m]
    double deviations;  ///< of a point from its plane, in sigma
    double min_cosine;  ///< between a point's normal and its plane's
    std::size_t min_points;
};

/// Makes regions of the points of a position_view.
template <class Points, neighborhood_graph Graph, normal_range Surface>
class plane_regions {
  public:
    plane_regions(const Points& points, const Graph& graph, const Surface& surface,
                  const plane_rules& rules)
        : points_(points),
          graph_(graph),
          surface_(surface),
          rules_(rules),
          labels_(points.size(), unlabeled),
          visit_(points.size(), 0) {
        std::size_t first = 0;
        while (first < points.size() && !is_finite(points[first])) ++first;
        if (first < points.size()) origin_ = points[first];
    }

    /// Regions from one seed after the other, those in the flattest surroundings first.
    template <execution X>
    void grow_all(const X& run) {
        for (const point_index seed : seeds(run)) {
            if (labels_[seed] != unlabeled) continue;
            grow(seed);
            if (members_.size() < rules_.min_points) continue;
            const auto label = static_cast<std::int32_t>(sums_.size());
            for (const point_index i : members_) labels_[i] = label;
            sums_.push_back(sum_of(members_));
            planes_.push_back(fitted(sums_.back(), origin_));
        }
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
    /// The points with a normal, by the mean square of their neighbors' distances from their
    /// tangent planes.
    template <execution X>
    std::vector<point_index> seeds(const X& run) const {
        std::vector<double> roughness(points_.size(), 0.0);
        for_each_chunk(run, points_.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                if (!may_grow(i)) continue;
                std::size_t count = 0;
                for (const point_index j : graph_[i]) {
                    const double d = dot(surface_[i].normal, difference(points_[j], points_[i]));
                    roughness[i] += d * d;
                    ++count;
                }
                if (count > 0) roughness[i] /= static_cast<double>(count);
            }
        });
        std::vector<point_index> order;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            if (may_grow(i)) order.push_back(static_cast<point_index>(i));
        }
        std::stable_sort(order.begin(), order.end(),
                         [&](point_index a, point_index b) { return roughness[a] < roughness[b]; });
        return order;
    }

    bool may_grow(std::size_t i) const {
        return is_finite(points_[i]) && !is_missing(surface_[i].normal);
    }

    /// Sets members_ to the region of a seed: grown while its plane becomes surer, then twice more
    /// with the whole plane, for what an early plane refused or should not have taken.
    void grow(point_index seed) {
        gnomon::plane along{surface_[seed].normal, 0.0};
        double reach = rules_.deviations * rules_.noise;
        along.offset = dot(along.normal, mean_around(seed, along.normal));
        members_.clear();
        if (!fits(seed, along, reach)) return;
        members_.push_back(seed);
        constexpr int passes = 3;
        for (int pass = 0; pass < passes; ++pass) {
            ++stamp_;
            if (pass > 0)
                std::erase_if(members_, [&](point_index i) { return !fits(i, along, reach); });
            for (const point_index i : members_) visit_[i] = stamp_;
            std::size_t refit_at = pass == 0 ? 8 : points_.size() + 1;
            for (std::size_t next = 0; next < members_.size(); ++next) {
                for (const point_index j : graph_[members_[next]]) {
                    if (visit_[j] == stamp_ || !fits(j, along, reach)) continue;
                    visit_[j] = stamp_;
                    members_.push_back(j);
                }
                if (members_.size() < refit_at) continue;
                if (const auto f = fitted(sum_of(members_), origin_); !is_missing(f.plane.normal))
                    along = f.plane;
                refit_at *= 2;
            }
            const fitted_plane f = fitted(sum_of(members_), origin_);
            if (is_missing(f.plane.normal)) {
                members_.clear();
                return;
            }
            along = f.plane;
            // Where there is more noise than elsewhere, up to twice as much.
            reach = rules_.deviations *
                    std::clamp(std::sqrt(f.variance), rules_.noise, 2.0 * rules_.noise);
        }
    }

    /// Whether a free point may join a plane.
    bool fits(point_index i, const gnomon::plane& to, double reach) const {
        return labels_[i] == unlabeled && may_grow(i) &&
               std::abs(dot(to.normal, surface_[i].normal)) >= rules_.min_cosine &&
               std::abs(to.signed_distance(points_[i])) <= reach;
    }

    /// The mean of the seed and those of its neighbors whose normals agree [m].
    Eigen::Vector3d mean_around(point_index seed, const Eigen::Vector3d& normal) const {
        moments m;
        for (const point_index j : graph_[seed]) {
            if (labels_[j] == unlabeled && may_grow(j) &&
                std::abs(dot(normal, surface_[j].normal)) >= rules_.min_cosine)
                m.add(difference(points_[j], points_[seed]));
        }
        return combined(1.0, points_[seed], 1.0, m.mean_with_point());
    }

    moments sum_of(const std::vector<point_index>& members) const {
        moments m;
        for (const point_index i : members) m.add(difference(points_[i], origin_));
        return m;
    }

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
    const Surface& surface_;
    plane_rules rules_;
    std::vector<std::int32_t> labels_;
    std::vector<std::size_t> visit_;  // by which pass of which seed
    std::size_t stamp_ = 0;
    std::vector<point_index> members_;
    Eigen::Vector3d origin_{0.0, 0.0, 0.0};
    std::vector<moments> sums_;  // by label, about origin_
    std::vector<fitted_plane> planes_;
};

}  // namespace gnomon::detail
