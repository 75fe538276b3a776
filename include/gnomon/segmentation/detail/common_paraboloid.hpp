// SPDX-License-Identifier: BSL-1.0
/// @file
/// How well a paraboloid explains two patches, compared with their planes.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/segmentation/detail/orthogonal_terms.hpp>
#include <gnomon/segmentation/detail/plane_comparison.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>
#include <gnomon/segmentation/detail/surface_patch.hpp>

namespace gnomon::detail {

/// The parts of two patches, and their heights over a paraboloid that fits them. (A template, so
/// that only its users compile it.)
template <class Patch = surface_patch, class Part = surface_part>
class common_paraboloid {
  public:
    common_paraboloid(const Patch& a, const Patch& b)
        : patches_{&a, &b}, base_(plane_of_both(a, b)) {
        for (const Patch* patch : patches_)
            for (const Part& part : patch->parts) parts_.push_back(&part);
        for (const Part* part : parts_) weights_.push_back(part->weight);
    }

    /// Whether a plane of both is known, and those of the patches are nearly parallel to it.
    [[nodiscard]] bool is_determined() const {
        return base_.is_determined && std::ranges::all_of(patches_, [&](const auto* patch) {
                   const region_plane own = patch->sums.fit();
                   return own.is_determined && is_nearly_parallel(own, base_);
               });
    }

    /// Whether it explains the parts better than their planes do.
    [[nodiscard]] bool is_better() const {
        const scratch<double> heights = heights_over(weights_);
        double of_planes = 0.0;
        for (const Part* part : parts_)
            of_planes += part->weight * part->off_plane * part->off_plane;
        return of_planes > weighted_product(weights_, heights, heights);
    }

    /// How far the smaller patch is, on average, from the paraboloid of the larger one alone [m];
    /// of equal ones, the second one counts as smaller.
    [[nodiscard]] double offset() const {
        const std::size_t smaller = patches_[1]->sums.count <= patches_[0]->sums.count ? 1 : 0;
        scratch<double> of_larger = weights_;
        for (std::size_t p = 0; p < parts_.size(); ++p)
            if (side_of(p) == smaller) of_larger[p] = 0.0;
        const scratch<double> heights = heights_over(of_larger);
        double sum = 0.0, weight = 0.0;
        for (std::size_t p = 0; p < parts_.size(); ++p) {
            if (side_of(p) != smaller) continue;
            sum += weights_[p] * heights[p];
            weight += weights_[p];
        }
        return std::abs(sum / weight);
    }

    /// How much worse it explains the patches than their planes do: the sum of squared deviations
    /// of their means, in variances, by which it is worse for either. Parts that the noise of
    /// points does not explain are left out, as a plane reaches beyond the border of its surface by
    /// some points; infinite if these are more than an eighth of a patch, as many as one row of
    /// parts has (on streets 20,001 to 20,006, a road stayed in two by a twentieth).
    [[nodiscard]] double worse() const {
        scratch<double> weights = weights_;
        constexpr int most_passes = 50;  // numerical: two or three are enough
        for (int pass = 0; pass < most_passes; ++pass) {
            const scratch<double> heights = heights_over(weights);
            std::array<std::size_t, 2> off{};
            std::array<double, 2> worse{};
            bool rests = true;
            for (std::size_t p = 0; p < parts_.size(); ++p) {
                const Part& part = *parts_[p];
                const std::size_t side = side_of(p);
                const bool is_on = std::abs(heights[p]) <= part.reach;
                rests = rests && is_on == (weights[p] > 0.0);
                weights[p] = is_on ? part.weight : 0.0;
                if (is_on)
                    worse[side] +=
                        part.weight * (heights[p] * heights[p] - part.off_plane * part.off_plane);
                else
                    off[side] += part.count;
            }
            for (std::size_t side = 0; side < 2; ++side)
                if (parts_along * off[side] > patches_[side]->sums.count)
                    return std::numeric_limits<double>::infinity();
            if (!rests) continue;
            return std::max(0.0, worse[0]) / patches_[0]->excess +
                   std::max(0.0, worse[1]) / patches_[1]->excess;
        }
        return std::numeric_limits<double>::infinity();
    }

  private:
    /// The patch that a part is of: the first or the second.
    [[nodiscard]] std::size_t side_of(std::size_t part) const {
        return part < patches_[0]->parts.size() ? 0 : 1;
    }

    /// Of all parts, over the paraboloid that fits them best by these weights.
    [[nodiscard]] scratch<double> heights_over(const scratch<double>& weights) const {
        const Eigen::Vector3d along = orthogonal(base_.plane.normal);
        const Eigen::Vector3d across = cross(base_.plane.normal, along);
        std::array<scratch<double>, 6> terms;  // formula: 1, x, y, x^2, x y, y^2
        scratch<double> heights;
        for (const Part* part : parts_) {
            const Eigen::Vector3d offset = difference(part->mean, base_.centroid);
            const double x = dot(along, offset), y = dot(across, offset);
            const std::array<double, 6> at{1.0, x, y, x * x, x * y, y * y};
            for (std::size_t t = 0; t < at.size(); ++t) terms[t].push_back(at[t]);
            heights.push_back(dot(base_.plane.normal, offset));
        }
        remove_terms(weights, terms, heights);
        return heights;
    }

    std::array<const Patch*, 2> patches_;
    region_plane base_;
    scratch<const Part*> parts_;  // of both
    scratch<double> weights_;
};

}  // namespace gnomon::detail
