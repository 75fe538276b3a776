// SPDX-License-Identifier: BSL-1.0
/// @file
/// The growth of planar segments into the unlabeled points next to them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/segmentation/detail/noisy_plane.hpp>
#include <gnomon/segmentation/detail/unlabeled_cubes.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// One run over a cloud.
template <neighborhood_graph G>
class unlabeled_assigner {
  public:
    /// @param graph         the neighbors of each unlabeled point, nearest first
    /// @param labels        those of the segments
    /// @param planes        those of the segments
    /// @param sigma         standard deviation of ranges [m]
    /// @param max_distance  of a point from a neighbor in the segment [m]
    unlabeled_assigner(const spatial_index& points, const G& graph, scratch<std::int32_t> labels,
                       std::span<const noisy_plane> planes, double sigma, double max_distance)
        : points_(points),
          graph_(graph),
          sigma_(sigma),
          max_distance_(max_distance),
          labels_(std::move(labels)),
          planes_(planes),
          cubes_(points, labels_, graph, sigma) {
        list_reverse_neighbors();
    }

    /// Segments grow by one layer of unlabeled points after the other, until none is assigned.
    /// @return the labels
    template <execution X>
    [[nodiscard]] scratch<std::int32_t> operator()(const X& run) {
        scratch<std::size_t> layer(cubes_.points().size());
        std::iota(layer.begin(), layer.end(), std::size_t{0});
        scratch<std::int32_t> claims;
        scratch<std::size_t> begin, next;
        while (!layer.empty()) {
            begin.clear();  // where the points of each cube begin in the layer
            for (std::size_t l = 0; l < layer.size(); ++l)
                if (l == 0 || unlabeled_at(layer[l]).cube != unlabeled_at(layer[l - 1]).cube)
                    begin.push_back(l);
            begin.push_back(layer.size());
            claims.resize(layer.size());
            for_each_chunk(run, begin.size() - 1, [&](std::size_t first, std::size_t last) {
                for (std::size_t l = begin[first]; l < begin[last]; ++l)
                    claims[l] = claim_to(unlabeled_at(layer[l]));
            });
            next.clear();  // the points with a neighbor that has been assigned
            for (std::size_t l = 0; l < layer.size(); ++l) {
                if (claims[l] == unlabeled) continue;
                const std::size_t s = layer[l];
                labels_[unlabeled_at(s).point] = claims[l];
                for (std::size_t f = first_reverse_[s]; f < first_reverse_[s + 1]; ++f)
                    next.push_back(reverse_[f]);
            }
            std::erase_if(next, [&](auto s) { return labels_[unlabeled_at(s).point] >= 0; });
            std::sort(next.begin(), next.end());
            next.erase(std::unique(next.begin(), next.end()), next.end());
            layer.swap(next);
        }
        return std::move(labels_);
    }

  private:
    [[nodiscard]] const unlabeled_point& unlabeled_at(std::size_t s) const {
        return cubes_.points()[s];
    }

    /// Reverse neighbor lists: for each unlabeled point, those that it is a neighbor of.
    void list_reverse_neighbors() {
        const auto all = cubes_.points();
        constexpr point_index none = std::numeric_limits<point_index>::max();
        scratch<point_index> number(points_.size(), none);
        for (std::size_t s = 0; s < all.size(); ++s)
            number[all[s].point] = static_cast<point_index>(s);
        const auto for_each_link = [&](auto&& visit) {
            for (std::size_t s = 0; s < all.size(); ++s)
                for (const point_index j : graph_[all[s].point])
                    if (number[j] != none) visit(static_cast<point_index>(s), number[j]);
        };
        first_reverse_.assign(all.size() + 1, 0);
        for_each_link([&](point_index, point_index to) { ++first_reverse_[to + 1]; });
        std::partial_sum(first_reverse_.begin(), first_reverse_.end(), first_reverse_.begin());
        reverse_.resize(first_reverse_.back());
        scratch<std::size_t> place(first_reverse_.begin(), first_reverse_.end() - 1);
        for_each_link([&](point_index s, point_index to) { reverse_[place[to]++] = s; });
    }

    /// The segment to which an unlabeled point is assigned in this round: of those among its
    /// neighbors whose plane it is on, the one with the nearest plane.
    std::int32_t claim_to(const unlabeled_point& s) {
        const Eigen::Vector3d p = points_[s.point];
        const Eigen::Vector3d viewpoint = known_viewpoint(points_.viewpoints, s.point);
        std::int32_t best = unlabeled;
        double least = std::numeric_limits<double>::infinity();
        for (const point_index j : graph_[s.point]) {
            if (squared_distance(points_[j], p) > max_distance_ * max_distance_) break;
            const std::int32_t segment = labels_[j];
            if (segment == unlabeled || segment == best) continue;
            const noisy_plane& of = planes_[static_cast<std::size_t>(segment)];
            const double distance = std::abs(of.distance(p));
            if (!of.is_flat() || distance >= least || distance > thickness(of, p, viewpoint) ||
                !are_on_plane(segment, cubes_[s.cube]))
                continue;
            best = segment;
            least = distance;
        }
        return best;
    }

    /// Whether the unlabeled points in the slab about the plane of a segment, near a cube, are on
    /// the plane: whether their mean is, within the noise of a mean.
    bool are_on_plane(std::int32_t segment, unlabeled_cube& near) {
        const auto known =
            std::find_if(near.judged.begin(), near.judged.end(),
                         [segment](const plane_judgement& j) { return j.segment == segment; });
        if (known != near.judged.end()) return known->is_on_plane;
        const noisy_plane& of = planes_[static_cast<std::size_t>(segment)];
        const double thick = thickness(of, near.mean, near.viewpoint);
        // So wide that noise does not decide which cubes are near.
        const double wide = noisy_plane::at_most * sigma_;
        const double width2 = std::max(wide * wide, near.squared_reach);
        double sum = 0.0, n = 0.0;
        const Eigen::Vector3d foot = of.foot_of(near.mean);
        const double reach2 = width2 + thick * thick;
        cubes_.for_each_near(
            foot, std::sqrt(reach2), [&](const Eigen::Vector3d& mean, double count) {
                const double squared = squared_distance(mean, foot);
                const double off = of.distance(mean);
                // Without branches, which are hard to predict here: performance only.
                const bool is_in = bool(squared <= reach2) & bool(std::abs(off) <= thick) &
                                   bool(squared - off * off <= width2);
                const double weight = is_in ? count : 0.0;
                sum += weight * off;
                n += weight;
            });
        constexpr double no_noise = 0.1;  // in standard deviations: no surface is an exact plane
        const bool is_on_plane =
            n > 0.0 && std::abs(sum) <= thick * std::sqrt(n) + no_noise * sigma_ * n;
        near.judged.push_back({segment, is_on_plane});
        return is_on_plane;
    }

    /// Half the thickness of the slab about a plane [m].
    static double thickness(const noisy_plane& of, const Eigen::Vector3d& p,
                            const Eigen::Vector3d& viewpoint) {
        return noisy_plane::at_most * of.deviation_at(p, viewpoint);
    }

    const spatial_index& points_;
    const G& graph_;
    double sigma_, max_distance_;  // [m]
    scratch<std::int32_t> labels_;
    std::span<const noisy_plane> planes_;  // of the segments
    unlabeled_cubes<G> cubes_;
    scratch<std::size_t> first_reverse_;
    scratch<point_index> reverse_;  // numbers of unlabeled points
};

}  // namespace gnomon::detail
