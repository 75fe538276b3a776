// SPDX-License-Identifier: BSL-1.0
/// @file
/// Corresponding samples of a surface, for points that move a little from one query to the next:
/// each point keeps the samples that a search has found, and searches again only when another
/// sample may be nearer than these.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/features/alignment.hpp>
#include <gnomon/features/detail/movable_cloud.hpp>
#include <gnomon/neighborhoods/detail/tree_query.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace gnomon::detail {

/// Where a point is on a surface.
struct surface_match {
    std::size_t entry = 0;   ///< in the list of the point: the nearest compatible one
    point_index sample = 0;  ///< its index
    Eigen::Vector3d normal;  ///< of the surface, where the point is
    double distance = 0.0;   ///< signed, of the point from the surface [m]
    double of_point = 0.0;   ///< variance that the noise of the point gives it [m^2]
    double of_sample = 0.0;  ///< variance that the noise of the sample gives it [m^2]
    double variance = 0.0;   ///< the sum, but that of a ray at least at `oblique` cosine [m^2]
};

/// The compatible samples that a search has found, nearest first. (Copies: performance only.)
struct sample_list {
    struct sample {
        Eigen::Vector3d at, normal;
        point_index index;
    };

    static constexpr std::size_t capacity = 8;  // performance only: enough for 1.6 spacings

    std::array<sample, capacity> of;
    std::size_t count = 0;
    Eigen::Vector3d searched{0.0, 0.0, 0.0};  ///< from where
    double reach = -1.0;  ///< all compatible samples up to this distance from there are listed
};

/// The canonical distance of some samples only.
template <class Accepts>
struct distance_of_some : canonical_metric {
    Accepts accepts;  ///< (i): whether sample i may be found
};

/// A surface that points are aligned to.
template <class Normals>
class matched_surface {
  public:
    /// Keeps references to all arguments.
    matched_surface(const spatial_index& samples, const Normals& normals,
                    const alignment_options& options)
        : samples_(samples),
          normals_(normals),
          options_(options),
          least_cosine_(cos(options.max_angle)) {}

    /// The match of a point at `x` with the axes of `rotation`, at most `limit` from its sample.
    /// @param found  working memory
    /// @return whether there is one
    [[nodiscard]] bool match(const movable_point& p, const Eigen::Vector3d& x,
                             const Eigen::Matrix3d& rotation, double limit, sample_list& list,
                             std::vector<neighbor>& found, surface_match& match) const {
        const Eigen::Vector3d ray = product(rotation, p.ray), own = product(rotation, p.normal);
        if (!find_in(list, x, ray, own, limit, match)) {
            search(list, x, ray, own, limit, found);
            if (!find_in(list, x, ray, own, limit, match)) return false;
        }
        if (match.distance > limit) return false;
        resolve_edge(list, x, ray, own, match);
        set_distance(list, x, ray, own, p, match);
        return true;
    }

    /// Measures the distance of a point at `x` from the sample that it has.
    void measure(const movable_point& p, const Eigen::Vector3d& x, const Eigen::Matrix3d& rotation,
                 const sample_list& list, surface_match& match) const {
        set_distance(list, x, product(rotation, p.ray), product(rotation, p.normal), p, match);
    }

  private:
    static constexpr double smooth = 0.8;  // chosen: cosine of 37 degrees, within one surface
    static constexpr double slack = 1.25;  // of the search radius (performance only)

    [[nodiscard]] bool is_compatible(const Eigen::Vector3d& normal, const Eigen::Vector3d& ray,
                                     const Eigen::Vector3d& own) const {
        const double facing = dot(normal, ray), aligned = dot(normal, own);
        const bool is_seen = options_.two_sided || is_missing(ray) || facing < 0.0;
        return is_seen && (is_missing(own) || std::abs(aligned) >= least_cosine_);
    }

    /// Sets the nearest compatible sample of a list and its distance; infinite if there is none.
    /// @return whether no sample that is not listed can be nearer, or within the limit
    [[nodiscard]] bool find_in(const sample_list& list, const Eigen::Vector3d& x,
                               const Eigen::Vector3d& ray, const Eigen::Vector3d& own, double limit,
                               surface_match& match) const {
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < list.count; ++k) {
            const double squared = squared_distance(list.of[k].at, x);
            if (squared >= nearest || !is_compatible(list.of[k].normal, ray, own)) continue;
            nearest = squared;
            match.entry = k;
        }
        match.distance = std::sqrt(nearest);
        if (list.reach < 0.0) return false;
        const double moved = length(difference(x, list.searched));
        return std::min(match.distance, limit) + moved <= list.reach;
    }

    /// Searches for the compatible samples that are nearest to x.
    void search(sample_list& list, const Eigen::Vector3d& x, const Eigen::Vector3d& ray,
                const Eigen::Vector3d& own, double limit, std::vector<neighbor>& found) const {
        const double radius = slack * limit;
        const auto is_wanted = [&](point_index q) {
            const Eigen::Vector3d n = normals_[q].normal;
            return is_unit(n) && is_compatible(n, ray, own);
        };
        search_tree(samples_.tree(), x, {.k = list.of.size(), .squared_radius = radius * radius},
                    found, distance_of_some<decltype(is_wanted)>{{}, is_wanted});
        list.searched = x;
        list.count = found.size();
        list.reach = radius;
        for (std::size_t i = 0; i < list.count; ++i) {
            const point_index q = found[i].index;
            list.of[i] = {samples_[q], normals_[q].normal, q};
            if (i + 1 == list.of.size()) list.reach = std::sqrt(found[i].squared_distance);
        }
    }

    [[nodiscard]] static bool is_unit(const Eigen::Vector3d& n) {
        constexpr double rounding = 1e-3;  // numerical: of normals in float
        return std::abs(dot(n, n) - 1.0) < rounding;
    }

    /// Near an edge the nearest sample may be on the other one of two surfaces. Where they meet in
    /// a convex edge a ray meets the one whose plane it crosses later, else the one that it crosses
    /// earlier, however noise displaces the point along the ray.
    void resolve_edge(const sample_list& list, const Eigen::Vector3d& x, const Eigen::Vector3d& ray,
                      const Eigen::Vector3d& own, surface_match& match) const {
        constexpr double least = 0.05;  // numerical: cosine of ray and normal
        const auto crossing = [&](const sample_list::sample& q) {
            const double off = dot(q.normal, difference(x, q.at));
            return is_missing(ray) ? off : off / std::max(std::abs(dot(q.normal, ray)), least);
        };
        double chosen = 0.0;
        bool is_known = false;
        for (std::size_t k = 0; k < list.count; ++k) {
            const auto &q = list.of[k], &here = list.of[match.entry];
            if (dot(q.normal, here.normal) >= smooth || !is_compatible(q.normal, ray, own))
                continue;
            const Eigen::Vector3d way = difference(q.at, here.at);
            const double from_here = dot(here.normal, way), from_there = -dot(q.normal, way);
            if (!(from_here * from_there > 0.0)) continue;
            if (!std::exchange(is_known, true)) chosen = crossing(here);
            const double other = crossing(q);
            if (!(from_here < 0.0 ? other > chosen : other < chosen)) continue;
            chosen = other;
            match.entry = k;
        }
    }

    /// Sets normal, distance and variances of a match to the sample that it has.
    void set_distance(const sample_list& list, const Eigen::Vector3d& x, const Eigen::Vector3d& ray,
                      const Eigen::Vector3d& own, const movable_point& p,
                      surface_match& match) const {
        constexpr double oblique = 0.2;  // chosen: of ray and normal, 78 degrees
        const Eigen::Vector3d &q = list.of[match.entry].at, &normal = list.of[match.entry].normal;
        match.sample = list.of[match.entry].index;
        Eigen::Vector3d sum = scaled(1e-6, normal);  // numerical: never zero
        for (std::size_t k = 0; k < list.count; ++k) {
            const Eigen::Vector3d& n = list.of[k].normal;
            if (dot(n, normal) < smooth || !is_compatible(n, ray, own)) continue;
            const double inside =
                1.0 - squared_distance(list.of[k].at, x) / (list.reach * list.reach);
            if (inside > 0.0) sum = combined(1.0, sum, inside * inside, n);
        }
        match.normal = direction_of(sum);
        // With the mean of the normals at both ends the distance from a sphere is exact.
        const Eigen::Vector3d mean = direction_of(combined(1.0, normal, 1.0, match.normal));
        match.distance = dot(mean, difference(x, q));
        const double c = is_missing(ray) ? 1.0 : dot(mean, ray);
        match.of_point = p.variance * c * c;
        match.of_sample = 0.0;
        if (!options_.surface_noise.is_zero()) {
            const Eigen::Vector3d v = samples_.viewpoints[match.sample];
            const bool is_seen = !samples_.viewpoints.empty() && is_finite(v);
            const Eigen::Vector3d way = is_seen ? difference(q, v) : q;
            const double s = is_seen && has_length(way) ? dot(mean, direction_of(way)) : 1.0;
            match.of_sample = options_.surface_noise.variance_along(way) * s * s;
        }
        match.variance = p.variance * std::max(c * c, oblique * oblique) + match.of_sample;
    }

    const spatial_index& samples_;
    const Normals& normals_;
    const alignment_options& options_;
    double least_cosine_;
};

}  // namespace gnomon::detail
