// SPDX-License-Identifier: BSL-1.0
/// @file
/// A fast test for points that are not extreme: cells of a grid that lie within the convex hull of
/// a sample of the points. The grid is aligned with the sample, as a segment is thin.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/features/detail/hull_simplex.hpp>
#include <gnomon/features/detail/quickhull.hpp>

namespace gnomon::detail {

class inner_cells {
  public:
    /// O(c^3 h) for c cells per axis and h corners of the hull of the sample.
    /// @param sample  with coordinates up to 1 in magnitude
    explicit inner_cells(std::span<const Eigen::Vector3d> sample) {
        const hull_simplex simplex(sample);
        if (simplex.count < 4) return;
        origin_ = sample[simplex.corners[0]];
        const Eigen::Vector3d along = difference(sample[simplex.corners[1]], origin_);
        const Eigen::Vector3d across =
            cross(along, difference(sample[simplex.corners[2]], origin_));
        if (!has_length(along) || !has_length(across)) return;
        axes_[0] = direction_of(along);
        axes_[2] = direction_of(across);
        axes_[1] = cross(axes_[2], axes_[0]);
        for (std::size_t a = 0; a < 3; ++a) {
            double high = -std::numeric_limits<double>::infinity();
            double low = -high;
            for (const Eigen::Vector3d& p : sample) {
                const double x = dot(axes_[a], difference(p, origin_));
                low = std::min(low, x);
                high = std::max(high, x);
            }
            low_[a] = low;
            cell_[a] = (high - low) / count;
            if (!(cell_[a] > rounding)) return;
        }
        mark(sample, quickhull(sample, simplex.corners));
    }

    /// Whether a point is in the interior of the hull, if this is obvious.
    [[nodiscard]] bool contains(const Eigen::Vector3d& p) const {
        if (marks_.empty()) return false;
        std::size_t cell = 0;
        for (std::size_t a = 3; a-- > 0;) {
            const double x = (dot(axes_[a], difference(p, origin_)) - low_[a]) / cell_[a];
            if (!(x >= 0.0 && x < count)) return false;
            cell = cell * count + static_cast<std::size_t>(x);
        }
        return marks_[cell] != 0;
    }

  private:
    static constexpr std::size_t count = 16;   // cells per axis: performance only
    static constexpr double rounding = 1e-12;  // of positions up to 1, with a margin

    /// Marks the cells whose corners are within the hull by more than rounding.
    void mark(std::span<const Eigen::Vector3d> sample, const quickhull& hull) {
        std::vector<Eigen::Vector3d> normals;
        std::vector<double> offsets;
        hull.for_each_triangle([&](const hull_triangle& t) {
            const Eigen::Vector3d& a = sample[t[0]];
            normals.push_back(cross(difference(sample[t[1]], a), difference(sample[t[2]], a)));
            const double margin = rounding * length(normals.back());
            offsets.push_back(dot(normals.back(), a) - margin);
        });
        constexpr std::size_t nodes = count + 1;
        std::vector<std::uint8_t> inside(nodes * nodes * nodes, 1);
        std::size_t last = 0;  // the plane that excluded the last node
        for (std::size_t n = 0; n < inside.size(); ++n) {
            const std::array<std::size_t, 3> at{n % nodes, n / nodes % nodes, n / nodes / nodes};
            Eigen::Vector3d x = origin_;
            for (std::size_t a = 0; a < 3; ++a)
                x = combined(1.0, x, low_[a] + static_cast<double>(at[a]) * cell_[a], axes_[a]);
            const auto excludes = [&](std::size_t f) { return !(dot(normals[f], x) < offsets[f]); };
            if (excludes(last)) inside[n] = 0;
            for (std::size_t f = 0; f < normals.size() && inside[n] != 0; ++f) {
                if (!excludes(f)) continue;
                inside[n] = 0;
                last = f;
            }
        }
        marks_.assign(count * count * count, 1);
        for (std::size_t c = 0; c < marks_.size(); ++c) {
            for (std::size_t corner = 0; corner < 8; ++corner) {
                const std::size_t x = c % count + corner % 2;
                const std::size_t y = c / count % count + corner / 2 % 2;
                const std::size_t z = c / count / count + corner / 4;
                if (inside[x + nodes * (y + nodes * z)] == 0) marks_[c] = 0;
            }
        }
    }

    Eigen::Vector3d origin_{0.0, 0.0, 0.0};
    std::array<Eigen::Vector3d, 3> axes_;
    std::array<double, 3> low_{};
    std::array<double, 3> cell_{};
    std::vector<std::uint8_t> marks_;
};

}  // namespace gnomon::detail
