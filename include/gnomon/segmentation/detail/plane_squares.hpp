// SPDX-License-Identifier: BSL-1.0
/// @file
/// A region as squares of its plane, each with the sums of its points: their means have less noise
/// than the points, and they are next to each other as the surface is, whatever the noise.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/symmetric_eigen.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>

namespace gnomon::detail {

/// Squares over the extent of a region in its plane, with the sums of its points. (A template, so
/// that only its users compile it.)
template <class Cloud, class Sums = plane_sums>
class plane_squares {
  public:
    /// @param members  of the region, all finite, at least one
    /// @param each     mean number of them in a square, if they are everywhere
    plane_squares(const Cloud& cloud, std::span<const point_index> members,
                  const planar_region& whole, double each)
        : square_of_(members.size(), 0) {
        const eigen_decomposition principal = symmetric_eigen(whole.sums.positions.covariance());
        std::array<double, 2> low{}, extent{};
        const auto position = [&](std::size_t m, std::size_t axis) {
            return dot(column(principal.vectors, static_cast<int>(axis)),
                       cloud.offsets[members[m]]);
        };
        for (std::size_t a = 0; a < 2; ++a) {
            double high = low[a] = position(0, a);
            for (std::size_t m = 1; m < members.size(); ++m) {
                low[a] = std::min(low[a], position(m, a));
                high = std::max(high, position(m, a));
            }
            extent[a] = high - low[a];
        }
        const auto points = static_cast<double>(members.size());
        // Along an axis hardly more than there are points, however narrow the region is.
        const double width = std::max(std::sqrt(extent[0] * extent[1] * each / points),
                                      std::max(extent[0], extent[1]) / points);
        if (!(width > 0.0)) return;
        for (std::size_t a = 0; a < 2; ++a)
            along_[a] = 1 + static_cast<std::size_t>(extent[a] / width);
        sums.resize(along_[0] * along_[1]);
        for (std::size_t m = 0; m < members.size(); ++m) {
            for (std::size_t a = 0; a < 2; ++a) {
                const auto place = static_cast<std::size_t>((position(m, a) - low[a]) / width);
                square_of_[m] = square_of_[m] * along_[a] + std::min(place, along_[a] - 1);
            }
            cloud.add(members[m], sums[square_of_[m]]);
        }
    }

    scratch<Sums> sums;  ///< of each square; none if all points are one place

    /// Of a member.
    [[nodiscard]] std::size_t square_of(std::size_t member) const { return square_of_[member]; }

    /// Whether a square is in one of the four halves of the extent.
    [[nodiscard]] bool is_in_half(std::size_t square, std::size_t half) const {
        const bool is_far = half < 2 ? 2 * (square / along_[1]) >= along_[0]
                                     : 2 * (square % along_[1]) >= along_[1];
        return is_far == (half % 2 == 0);
    }

    /// Calls each(square) for those around a square that have points.
    void for_each_around(std::size_t square, auto&& each) const {
        const std::size_t row = square / along_[1], column = square % along_[1];
        for (std::size_t r = row - std::min<std::size_t>(row, 1); r < std::min(row + 2, along_[0]);
             ++r) {
            for (std::size_t c = column - std::min<std::size_t>(column, 1);
                 c < std::min(column + 2, along_[1]); ++c) {
                const std::size_t other = r * along_[1] + c;
                if (other != square && sums[other].count > 0) each(other);
            }
        }
    }

  private:
    std::array<std::size_t, 2> along_{};  // numbers of squares
    scratch<std::size_t> square_of_;
};

}  // namespace gnomon::detail
