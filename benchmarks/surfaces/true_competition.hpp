// SPDX-License-Identifier: BSL-1.0
/// @file
/// How well a scan can be segmented by the competition of planes, which begins with the true labels
/// here, on the cells that `perception` works on. The IoU that is lost is lost by the competition;
/// where the chain has a smaller one, the difference is that of finding the planes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "joined_surfaces.hpp"
#include "scores.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/perception.hpp>

/// The competition of the true surfaces, with the noise that was measured. Floor and ceiling take
/// no part.
template <class Estimate>
class true_competition {
  public:
    /// @param seen  what `perception` returned for this scan
    true_competition(const sim::true_scan& truth, const joined_surfaces& surfaces,
                     const gnomon::perception_result<Estimate>& seen)
        : kept_(seen.kept),
          points_(kept_points(truth, seen.kept)),
          noise_(seen.noise),
          cells_(points_,
                 [&](std::size_t i) {
                     constexpr double least = 1e-6;  // [m], as in the chain
                     return std::max(noise_.of_planes.along(points_[i] - points_.viewpoints[i]),
                                     least);
                 }),
          index_(index_of(cells_)),
          graph_(gnomon::knn{.k = gnomon::noise_knn{}.k}(index_)),
          cloud_(index_, noise_.of_planes, gnomon::sequential{}, !noise_.is_across_surface) {
        cloud_.counts = cells_.counts;
        std::vector<std::vector<gnomon::point_index>> members(index_.size());
        for (std::size_t i = 0; i < points_.size(); ++i)
            if (points_.is_finite(i)) members[cells_.of_point[i]].push_back(kept_[i]);
        for (const auto& some : members)
            labels_.push_back(
                number_of(surfaces, most_frequent(some, [&](auto i) { return surfaces.of(i); })));
        compete();
    }

    true_competition(const true_competition&) = delete;  // the cloud refers to the index
    true_competition& operator=(const true_competition&) = delete;

    /// The labels of all points of the scan.
    [[nodiscard]] gnomon::segments segments(std::size_t points) const {
        const auto of_kept = gnomon::detail::labels_of_points(
            points_, noise_, cells_, cloud_, graph_, labels_, regions_,
            gnomon::detail::region_edges<>(), gnomon::sequential{});
        std::vector<std::int32_t> labels(points, gnomon::unlabeled);
        for (std::size_t i = 0; i < kept_.size(); ++i) labels[kept_[i]] = of_kept[i];
        return gnomon::segments(labels);
    }

  private:
    static gnomon::spatial_index kept_points(const sim::true_scan& truth,
                                             const std::vector<gnomon::point_index>& kept) {
        std::vector<Eigen::Vector3d> points;
        for (const auto i : kept) points.push_back(truth.scan.points[i]);
        return gnomon::spatial_index(
            gnomon::with_viewpoints(points, truth.scan.viewpoints.subset(kept)));
    }

    static gnomon::spatial_index index_of(const gnomon::detail::cells& cells) {
        return gnomon::spatial_index(gnomon::with_viewpoints(cells.means, cells.viewpoints));
    }

    /// The number of a true surface among those of cells, from 0 on.
    std::int32_t number_of(const joined_surfaces& surfaces, std::int32_t surface) {
        if (surface == sim::nothing) return gnomon::unlabeled;
        const auto next = static_cast<std::int32_t>(number_.size());
        const auto [found, is_new] = number_.try_emplace(surface, next);
        if (is_new) is_flat_.push_back(surfaces.is_flat(surface));
        return found->second;
    }

    void compete() {
        const gnomon::sequential run;
        fit();
        auto is_border = gnomon::detail::borders_of(graph_, labels_, run);
        for (int round = 0; round < gnomon::detail::most_rounds; ++round) {
            auto after =
                gnomon::detail::compete(cloud_, graph_, regions_, gnomon::detail::region_edges<>(),
                                        labels_, is_border, run);
            labels_.assign(after.begin(), after.end());
            fit();
        }
    }

    /// The planes of the labels. Curved surfaces have none, nor have surfaces of cells that do not
    /// determine one.
    void fit() {
        regions_.assign(is_flat_.size(), {});
        for (std::size_t c = 0; c < labels_.size(); ++c)
            if (labels_[c] != gnomon::unlabeled)
                cloud_.add(c, regions_[static_cast<std::size_t>(labels_[c])].sums);
        for (std::size_t r = 0; r < regions_.size(); ++r) {
            regions_[r].fit = regions_[r].sums.fit();
            regions_[r].is_planar = is_flat_[r] && regions_[r].fit.is_determined;
        }
    }

    std::vector<gnomon::point_index> kept_;
    gnomon::spatial_index points_;  // those kept
    typename gnomon::perception_result<Estimate>::known_noise noise_;
    gnomon::detail::cells cells_;
    gnomon::spatial_index index_;  // of the cells
    gnomon::adjacency graph_;
    gnomon::detail::planar_cloud cloud_;
    std::map<std::int32_t, std::int32_t> number_;  // of true surfaces
    std::vector<bool> is_flat_;                    // by number
    std::vector<std::int32_t> labels_;             // of cells
    gnomon::detail::scratch<gnomon::detail::planar_region> regions_;
};
