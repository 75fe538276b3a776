// SPDX-License-Identifier: BSL-1.0
/// @file
/// A region in parallel strips, and the cut between two of them after which two planes explain the
/// points best. All cuts follow from the sums of the strips.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include <Eigen/Core>

#include <gnomon/core/detail/symmetric_eigen.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/segmentation/detail/parabola_test.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>

namespace gnomon::detail {

/// `count` strips of a width across a direction, of points of a planar_cloud; the first and the
/// last one have no end.
template <class Cloud, std::size_t count>
class strips {
  public:
    /// @param cloud  refers to it
    /// @param along  of unit length
    /// @param first  the position of the first strip along it, from the origin of the cloud [m]
    /// @param width  of each strip, more than zero [m]
    strips(const Cloud& cloud, const Eigen::Vector3d& along, double first, double width)
        : cloud_(&cloud), along_(along), first_(first), width_(width) {}
    strips(const Cloud& cloud, const Eigen::Vector3d& along, double first, double width,
           std::span<const point_index> members)
        : strips(cloud, along, first, width) {
        add(members);
    }

    void add(std::span<const point_index> members) {
        for (const point_index i : members) cloud_->add(i, sums_[strip_of(cloud_->offsets[i])]);
    }

    /// The strip before which a cut leaves two planes that explain the points best; 0 if there is
    /// none.
    /// @param accepts  accepts(side, side): whether these may be two planes
    /// @param least    the sum of squared deviations from the planes that the cut must be below; is
    ///                 replaced by that of the cut
    [[nodiscard]] std::size_t best_cut(std::size_t min_points, auto&& accepts,
                                       double& least) const {
        std::size_t best = 0;
        for (std::size_t cut = 1; cut < count; ++cut) {
            const auto [a, b] = sides_of(cut);
            if (std::min(a.sums.summands, b.sums.summands) < min_points || !accepts(a, b)) continue;
            const double both = a.sums.squares(a.fit) + b.sums.squares(b.fit);
            if (!(both < least)) continue;
            least = both;
            best = cut;
        }
        return best;
    }

    /// The cut before a strip.
    [[nodiscard]] plane cut_before(std::size_t strip) const {
        return {along_, first_ + width_ * static_cast<double>(strip)};
    }

    /// Whether a surface that is curved along the strips explains their means better than the two
    /// planes of a cut.
    [[nodiscard]] bool is_curved(std::size_t cut) const {
        const auto [a, b] = sides_of(cut);
        plane_sums all = a.sums;
        all.add(b.sums);
        parabola_test<count> test(all, along_);
        for (std::size_t s = 0; s < count; ++s) test.add(sums_[s], (s < cut ? a : b).fit.plane);
        return test.is_curved();
    }

  private:
    [[nodiscard]] std::size_t strip_of(const Eigen::Vector3d& offset) const {
        const double strip = (dot(along_, offset) - first_) / width_;
        return static_cast<std::size_t>(std::clamp(strip, 0.0, static_cast<double>(count - 1)));
    }

    /// The two sides of a cut before a strip, with their planes.
    [[nodiscard]] std::array<planar_region, 2> sides_of(std::size_t cut) const {
        std::array<planar_region, 2> sides;
        for (std::size_t s = 0; s < count; ++s) sides[s < cut ? 0 : 1].sums.add(sums_[s]);
        for (planar_region& side : sides) side.fit = side.sums.fit();
        return sides;
    }

    const Cloud* cloud_;
    Eigen::Vector3d along_;
    double first_;
    double width_;
    std::array<plane_sums, count> sums_{};
};

/// Calls each(strips) for the two principal axes of a region in its plane: `count` strips of its
/// members across the axis, over all of their extent. O(n). (A template, so that only its users
/// compile it.)
/// @param members  of the region, all finite, at least one
template <std::size_t count, class Cloud>
void for_each_axis(const Cloud& cloud, std::span<const point_index> members,
                   const planar_region& whole, auto&& each) {
    const eigen_decomposition principal = symmetric_eigen(whole.sums.positions.covariance());
    for (int axis = 0; axis < 2; ++axis) {
        const Eigen::Vector3d along = column(principal.vectors, axis);
        double first = dot(along, cloud.offsets[members.front()]), last = first;
        for (const point_index i : members) {
            const double position = dot(along, cloud.offsets[i]);
            first = std::min(first, position);
            last = std::max(last, position);
        }
        const double width = (last - first) / static_cast<double>(count);
        if (width > 0.0) each(strips<Cloud, count>(cloud, along, first, width, members));
    }
}

}  // namespace gnomon::detail
