// SPDX-License-Identifier: BSL-1.0
/// @file
/// Growth of planes: from the flattest points on, those neighbors join whose normals agree and
/// which are within three standard deviations of the plane of the region, which is fit again as the
/// region grows (after Poppinga et al. 2008).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

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
    /// @param labels  those of the regions; grown ones are added
    plane_growth(const planar_cloud& cloud, const G& graph, const S& surface,
                 std::size_t min_points, scratch<std::int32_t>& labels)
        : cloud_(cloud),
          graph_(graph),
          surface_(surface),
          min_points_(min_points),
          labels_(labels),
          visit_(cloud.size(), 0) {}

    /// Grows regions of unlabeled points.
    /// @param min_cosine  of the angle between normals of points and planes
    /// @param next        the label of the first new region
    template <execution X>
    void operator()(double min_cosine, std::int32_t next, const X& run) {
        min_cosine_ = min_cosine;
        scratch<char> was_tried(cloud_.size(), false);
        for (const point_index seed : flattest_first(run)) {
            if (was_tried[seed] != 0 || !is_free(seed)) continue;
            const plane_sums sums = grown_from(seed);
            if (sums.count >= min_points_) {
                for (const point_index i : members_) labels_[i] = next;
                ++next;
            } else {
                for (const point_index i : members_) was_tried[i] = true;
            }
        }
    }

  private:
    [[nodiscard]] bool is_free(std::size_t i) const {
        return labels_[i] == unlabeled && !is_missing(normal(i));
    }

    [[nodiscard]] Eigen::Vector3d normal(std::size_t i) const { return surface_[i].normal; }

    /// The free points by the mean squared distance of their neighbors from the plane of their
    /// normal, in variances of the noise.
    template <execution X>
    [[nodiscard]] scratch<point_index> flattest_first(const X& run) const {
        scratch<double> roughness(cloud_.size(), std::numeric_limits<double>::infinity());
        for_each_chunk(run, cloud_.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                if (is_free(i)) roughness[i] = roughness_at(i);
        });
        scratch<point_index> order;
        for (std::size_t i = 0; i < cloud_.size(); ++i)
            if (is_free(i)) order.push_back(static_cast<point_index>(i));
        std::sort(order.begin(), order.end(), [&](point_index a, point_index b) {
            return roughness[a] != roughness[b] ? roughness[a] < roughness[b] : a < b;
        });
        return order;
    }

    [[nodiscard]] double roughness_at(std::size_t i) const {
        const Eigen::Vector3d n = normal(i);
        double sum = 0.0, count = 1.0, mean = 0.0;
        for (const point_index j : graph_[i]) {
            const double d = dot(n, difference(cloud_.offsets[j], cloud_.offsets[i]));
            sum += d * d;
            mean += d;
            count += 1.0;
        }
        const double dev = cloud_.noise[i].across(n);
        mean /= count;
        return (sum / count - mean * mean) / (dev * dev);
    }

    /// Sets members_ to the region of a seed: grown while its plane becomes more accurate, then
    /// twice again with the final plane, which corrects the decisions of early planes.
    plane_sums grown_from(point_index seed) {
        constexpr int passes = 3;
        region_plane to = start_at(seed);
        plane_sums sums;
        members_.clear();
        if (!fits(seed, to)) return sums;
        members_.push_back(seed);
        for (int pass = 0; pass < passes; ++pass) {
            if (pass > 0) std::erase_if(members_, [&](point_index i) { return !fits(i, to); });
            sums = spread(to, pass == 0);
            const region_plane next = sums.fit();
            if (!next.is_determined) return sums;
            to = next;
        }
        return sums;
    }

    /// Adds to members_ what fits a plane and is connected with them.
    /// @param follows  whether the plane is fit again each time that their number has doubled
    plane_sums spread(region_plane& to, bool follows) {
        ++stamp_;
        for (const point_index i : members_) visit_[i] = stamp_;
        plane_sums sums;
        std::size_t refit_at = follows ? 8 : std::numeric_limits<std::size_t>::max();
        for (std::size_t next = 0; next < members_.size(); ++next) {
            const point_index i = members_[next];
            cloud_.add(i, sums);
            for (const point_index j : graph_[i]) {
                if (visit_[j] == stamp_ || !fits(j, to)) continue;
                visit_[j] = stamp_;
                members_.push_back(j);
            }
            if (sums.count < refit_at) continue;
            const double excess = to.chi2;
            if (const region_plane f = sums.fit(); f.is_determined) to = f;
            to.chi2 = excess;  // that of a part is of little precision
            refit_at *= 2;
        }
        return sums;
    }

    [[nodiscard]] bool fits(std::size_t i, const region_plane& to) const {
        return is_free(i) && std::abs(dot(to.plane.normal, normal(i))) >= min_cosine_ &&
               cloud_.deviations(i, to.plane) <= most_deviations * std::sqrt(to.excess());
    }

    /// The plane through the mean of the seed and those of its neighbors whose normals agree.
    [[nodiscard]] region_plane start_at(point_index seed) const {
        const Eigen::Vector3d n = normal(seed);
        Eigen::Vector3d sum = cloud_.offsets[seed];
        double count = 1.0;
        for (const point_index j : graph_[seed]) {
            if (!is_free(j) || std::abs(dot(n, normal(j))) < min_cosine_) continue;
            sum = combined(1.0, sum, 1.0, cloud_.offsets[j]);
            count += 1.0;
        }
        region_plane start;
        start.plane = {n, dot(n, sum) / count};
        return start;
    }

    const planar_cloud& cloud_;
    const G& graph_;
    const S& surface_;
    std::size_t min_points_;
    scratch<std::int32_t>& labels_;
    double min_cosine_ = 1.0;
    scratch<std::size_t> visit_;  // by which spreading
    std::size_t stamp_ = 0;
    scratch<point_index> members_;
};

}  // namespace gnomon::detail
