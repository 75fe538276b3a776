// SPDX-License-Identifier: BSL-1.0
/// @file
/// Growth of planes: from the flattest points on, those neighbors join whose normals agree and
/// which are within three standard deviations of the plane of the region, which is fit again as the
/// region grows (after Poppinga et al. 2008).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/segmentation/detail/planar_cloud.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// Grows planes in a cloud.
template <neighborhood_graph G, normal_range S>
class plane_growth {
  public:
    /// @param min_cosine  of the angle between normals of points and planes
    /// @param labels      those of the regions; grown ones are added
    plane_growth(const planar_cloud& cloud, const G& graph, const S& surface,
                 std::size_t min_points, double min_cosine, scratch<std::int32_t>& labels)
        : cloud_(cloud),
          graph_(graph),
          surface_(surface),
          min_points_(min_points),
          min_cosine_(min_cosine),
          labels_(labels),
          visit_(cloud.size(), no_seed) {
        members_.reserve(cloud.size());
    }

    /// Grows regions of unlabeled points. Points of a region that is too small, or whose plane
    /// most of its points do not fit in the end, are no seeds.
    /// @param next  the label of the first new region
    template <execution X>
    void operator()(std::int32_t next, const X& run) {
        for (const auto& [roughness, seed] : flattest_first(run)) {
            if (visit_[seed] != no_seed || !is_free(seed) || !grow_from(seed)) continue;
            for (const point_index i : members_) labels_[i] = next;
            ++next;
        }
    }

  private:
    [[nodiscard]] bool is_free(std::size_t i) const {
        return labels_[i] == unlabeled && cloud_.is_finite(i) && !is_missing(normal(i));
    }

    [[nodiscard]] Eigen::Vector3d normal(std::size_t i) const { return surface_[i].normal; }

    /// The free points by their roughness, each with it: the variance of the neighborhood along the
    /// normal, in variances of the noise. (A template of numbers for compile time only.)
    template <execution X, class Number = double>
    [[nodiscard]] auto flattest_first(const X& run) const {
        scratch<std::pair<Number, point_index>> order;
        for (std::size_t i = 0; i < cloud_.size(); ++i)
            if (is_free(i)) order.emplace_back(0.0, static_cast<point_index>(i));
        for_each_chunk(run, order.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t o = begin; o < end; ++o)
                order[o].first = roughness_at(order[o].second);
        });
        std::erase_if(order, [](const auto& o) { return std::isnan(o.first); });
        std::sort(order.begin(), order.end());
        return order;
    }

    [[nodiscard]] double roughness_at(std::size_t i) const {
        const Eigen::Vector3d n = normal(i);
        double sum = 0.0, count = 1.0, mean = 0.0;
        for (const point_index j : graph_[i]) {
            if (!cloud_.is_finite(j)) continue;
            const double d = dot(n, difference(cloud_.offsets[j], cloud_.offsets[i]));
            sum += d * d;
            mean += d;
            count += 1.0;
        }
        const double dev = cloud_.noise[i].across(n);
        mean /= count;
        return (sum / count - mean * mean) / (dev * dev);
    }

    /// Sets members_ to the region of a seed, whose plane is fit again each time that their number
    /// has doubled.
    /// @return whether they are enough, and most fit the final plane
    bool grow_from(point_index seed) {
        region_plane to;
        to.plane = plane_about(seed);
        plane_sums sums;
        members_.assign(1, seed);
        visit_[seed] = seed;
        constexpr std::size_t first_refit = 8;  // performance only: then at each doubling
        std::size_t refit_at = first_refit;
        for (std::size_t next = 0; next < members_.size(); ++next) {
            cloud_.add(members_[next], sums);
            for (const point_index j : graph_[members_[next]]) {
                if (visit_[j] == seed || !fits(j, to)) continue;
                visit_[j] = seed;
                members_.push_back(j);
            }
            if (sums.summands < refit_at) continue;
            if (const region_plane f = sums.fit(); f.is_determined) to.plane = f.plane;
            refit_at *= 2;
        }
        if (const region_plane f = sums.fit(); f.is_determined) to = f;
        const auto fitting =
            std::ranges::count_if(members_, [&](point_index i) { return fits(i, to); });
        return members_.size() >= min_points_ && 2 * fitting > std::ssize(members_);
    }

    [[nodiscard]] bool fits(std::size_t i, const region_plane& to) const {
        return is_free(i) && std::abs(dot(to.plane.normal, normal(i))) >= min_cosine_ &&
               cloud_.is_on(i, to);
    }

    /// The plane through the mean of the seed and those of its neighbors whose normals agree.
    [[nodiscard]] plane plane_about(point_index seed) const {
        const Eigen::Vector3d n = normal(seed);
        Eigen::Vector3d sum = cloud_.offsets[seed];
        double count = 1.0;
        for (const point_index j : graph_[seed]) {
            if (!is_free(j) || !(std::abs(dot(n, normal(j))) >= min_cosine_)) continue;
            sum = combined(1.0, sum, 1.0, cloud_.offsets[j]);
            count += 1.0;
        }
        return {n, dot(n, sum) / count};
    }

    static constexpr point_index no_seed = std::numeric_limits<point_index>::max();

    const planar_cloud& cloud_;
    const G& graph_;
    const S& surface_;
    std::size_t min_points_;
    double min_cosine_;
    scratch<std::int32_t>& labels_;
    scratch<point_index> visit_;  // the seed of the last region that a point was in
    scratch<point_index> members_;
};

}  // namespace gnomon::detail
