// SPDX-License-Identifier: BSL-1.0
/// @file
/// How segment_planes grows a region: from a seed to neighbors that lie on its plane, which is
/// fitted again each time that it has doubled.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
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
#include <gnomon/segmentation/detail/plane_of_sums.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// What regions have to keep to.
struct plane_rules {
    double noise;       ///< sigma, across the surface [m]
    double deviations;  ///< of a point from its plane, in sigma
    double min_cosine;  ///< between a point's normal and its plane's
    std::size_t min_points;
};

/// Regions of the points of a position_view, one after the other.
template <class Points, neighborhood_graph Graph, normal_range Surface>
class plane_growth {
  public:
    plane_growth(const Points& points, const Graph& graph, const Surface& surface,
                 const plane_rules& rules)
        : points_(points),
          graph_(graph),
          surface_(surface),
          rules_(rules),
          labels_(points.size(), unlabeled),
          visit_(points.size(), 0) {}

    /// From one seed after the other, those in the flattest surroundings first.
    /// @return the labels of the points
    template <execution X>
    [[nodiscard]] std::vector<std::int32_t> operator()(const X& run) {
        std::int32_t label = 0;
        for (const point_index seed : seeds(run)) {
            if (labels_[seed] != unlabeled) continue;
            grow(seed);
            if (members_.size() < rules_.min_points) continue;
            for (const point_index i : members_) labels_[i] = label;
            ++label;
        }
        return std::move(labels_);
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
                    if (!std::isfinite(d)) continue;
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

    /// Sets members_ to the region of a seed: grown while its plane becomes more accurate, then
    /// twice more with the final plane, which corrects the decisions of early planes.
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
                if (const auto f = plane_of_members(points_[seed]); !is_missing(f.plane.normal))
                    along = f.plane;
                refit_at *= 2;
            }
            const fitted_plane f = plane_of_members(points_[seed]);
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

    /// The plane of the members.
    fitted_plane plane_of_members(const Eigen::Vector3d& origin) const {
        moments m;
        for (const point_index i : members_) m.add(difference(points_[i], origin));
        return fitted(m, origin);
    }

    const Points& points_;
    const Graph& graph_;
    const Surface& surface_;
    plane_rules rules_;
    std::vector<std::int32_t> labels_;
    std::vector<std::size_t> visit_;  // by which pass of which seed
    std::size_t stamp_ = 0;
    std::vector<point_index> members_;
};

}  // namespace gnomon::detail
