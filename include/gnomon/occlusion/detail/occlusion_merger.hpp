// SPDX-License-Identifier: BSL-1.0
/// @file
/// Which segments merge_occluded compares, and which gaps between them it closes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/union_find.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/occlusion/detail/examined_gap.hpp>
#include <gnomon/occlusion/detail/segment_groups.hpp>
#include <gnomon/occlusion/merge_policy.hpp>
#include <gnomon/occlusion/visibility.hpp>
#include <gnomon/segmentation/detail/agglomeration.hpp>
#include <gnomon/segmentation/detail/planar_cloud.hpp>
#include <gnomon/segmentation/detail/plane_comparison.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>
#include <gnomon/segmentation/detail/region_fit.hpp>
#include <gnomon/segmentation/detail/region_pairs.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// One run of the algorithm.
/// @tparam Options  `merge_occluded_options`, which are valid
template <merge_policy M, class Options, execution X>
class occlusion_merger {
  public:
    occlusion_merger(const spatial_index& points, const planar_cloud& cloud, const segments& parts,
                     const visibility& visible, const M& policy, const Options& options,
                     const X& run)
        : points_(points),
          cloud_(cloud),
          visible_(visible),
          policy_(policy),
          options_(options),
          run_(run),
          regions_(parts.size()),
          wholes_(parts.labels().begin(), parts.labels().end()),
          labels_(wholes_.size(), unlabeled),
          members_(labels_) {
        run(parts.size(), [&](std::size_t s) { fit(s, parts[s]); });
        members_ = label_groups(labels_);
    }

    /// Merges the segments; their sets.
    [[nodiscard]] union_find operator()() {
        union_find sets = agglomeration(regions_)(
            pairs(),
            [this](const planar_region& a, const planar_region& b) { return dissimilarity(a, b); },
            [this](point_index a, point_index b) { return is_closed(a, b); },
            [this](union_find& merged) {
                fit_again(merged);
                return pairs();
            });
        for (examined_gap& gap : gaps_)
            gap.merged = sets.find(gap.sides.first) == sets.find(gap.sides.second);
        return sets;
    }

    /// All gaps that were examined.
    [[nodiscard]] std::span<const examined_gap> gaps() const { return gaps_; }

  private:
    /// The plane of a segment, and which of its points are on it.
    void fit(std::size_t s, std::span<const point_index> points) {
        regions_[s] = region_of(cloud_, points);
        for (const point_index i : points) {
            const bool is_on = cloud_.is_finite(i) && cloud_.is_on(i, regions_[s].fit);
            labels_[i] = is_on ? static_cast<std::int32_t>(s) : unlabeled;
        }
    }

    /// Fits the planes of the segments that have grown to all of their points, as another run on
    /// the result would: it finds nothing to merge.
    void fit_again(union_find& sets) {
        scratch<char> has_grown(regions_.size(), false);
        for (std::size_t s = 0; s < regions_.size(); ++s) {
            const point_index whole = sets.find(static_cast<point_index>(s));
            if (whole == s) continue;
            has_grown[whole] = has_grown[whole] != 0 || regions_[s].is_planar;
            regions_[s].is_planar = false;
        }
        unite_labels(wholes_, sets);
        const label_groups wholes(wholes_);
        run_(wholes.size(), [&](std::size_t s) {
            if (has_grown[s] != 0) fit(s, wholes[s]);
        });
        members_ = label_groups(labels_);
    }

    /// Pairs of flat segments that may be one.
    [[nodiscard]] scratch<region_pair> pairs() const {
        return pairs_to_compare(
            regions_.size(), options_.candidates,
            [this](std::size_t r) { return regions_[r].is_planar; },
            [this](std::size_t r) { return regions_[r].fit.centroid; },
            [this](point_index a, point_index b) {
                return dissimilarity(regions_[a], regions_[b]) <= 1.0;
            });
    }

    /// As dissimilarity_of_apart; infinite if one is not flat, or the planes are too far from each
    /// other.
    [[nodiscard]] double dissimilarity(const planar_region& a, const planar_region& b) const {
        return a.is_planar && b.is_planar && is_near(a, b)
                   ? dissimilarity_of_apart(a, b)
                   : std::numeric_limits<double>::infinity();
    }

    /// Whether the centroid of the smaller segment is near the plane of the larger one (of equal
    /// ones both, so that their order does not count), in place of rho_o, Eq. (4.6), which is the
    /// smaller distance of both.
    [[nodiscard]] bool is_near(const planar_region& a, const planar_region& b) const {
        const Eigen::Vector3d between = difference(b.fit.centroid, a.fit.centroid);
        const auto is_on = [&](const planar_region& wide) {
            return std::abs(dot(wide.fit.plane.normal, between)) <= options_.max_offset;
        };
        return (a.sums.count < b.sums.count || is_on(a)) &&
               (b.sums.count < a.sums.count || is_on(b));
    }

    /// Whether the gap between two segments is closed.
    [[nodiscard]] bool is_closed(point_index a, point_index b) {
        const auto side = [&](point_index r) { return gap_side{r, members_[r]}; };
        gaps_.push_back(gap_between(side(a), side(b), points_, visible_, policy_, options_));
        return gaps_.back().is_closed;
    }

    const spatial_index& points_;
    const planar_cloud& cloud_;
    const visibility& visible_;
    const M& policy_;
    const Options& options_;
    const X& run_;
    scratch<planar_region> regions_;
    scratch<std::int32_t> wholes_;  // of all points
    scratch<std::int32_t> labels_;  // of the points on the planes
    label_groups members_;          // at the beginning of the round
    scratch<examined_gap> gaps_;
};

}  // namespace gnomon::detail
