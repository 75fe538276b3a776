// SPDX-License-Identifier: BSL-1.0
/// @file
/// The space above a piece of ground, in voxels: how much a surface there counts for an object.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/occlusion/range_image.hpp>
#include <gnomon/occlusion/visibility.hpp>
#include <gnomon/recognition/wall.hpp>

namespace gnomon::recognition::detail {

/// A cell of a scan, in the frame of the ground.
struct ground_cell {
    Eigen::Vector3d at;  ///< [m]
    /// Cosine between its normal and the vertical, without sign.
    double up = of_both_kinds;

    static constexpr double of_both_kinds = 0.7;  ///< also of cells without a normal
};

/// Voxels of 5 cm around some cells, for two kinds of surfaces: level ones and others.
class observed_space {
  public:
    static constexpr double edge = 0.05;  // [m]; chosen: as wide as thin parts of furniture
    /// How much a sample of a surface counts: where the scan has cells of its kind, next to these,
    /// where cells of the other kind are, and where the sensor saw through or a wall is. Unknown
    /// space counts nothing. Chosen on furnished_room() with clutter, seeds 1 to 20, and with
    /// touching furniture, seeds 1 to 10.
    static constexpr std::int8_t occupied = 2, adjacent = 1, of_other_kind = -1, empty = -3;

    /// @param cells   of objects; at least one
    /// @param frame   of the ground in that of the scan
    /// @param seen    by the sensor, floor and walls included
    /// @param walls   in which no object stands
    /// @param reach   of objects from their origins, which are within the bounds of the cells [m]
    /// @param height  of objects [m]
    /// Complexity: O(n + v i w) for n cells, v voxels, i view points and w walls.
    observed_space(std::span<const ground_cell> cells, const rigid_motion& frame,
                   const visibility& seen, std::span<const wall> walls, double reach, double height,
                   const auto& run) {
        const double margin = reach + 2.0 * edge;
        for (int a = 0; a < 2; ++a) {
            const auto [low, high] =
                std::ranges::minmax(cells, {}, [a](const ground_cell& c) { return c.at[a]; });
            const auto k = static_cast<std::size_t>(a);
            low_[k] = low.at[a] - margin;
            size_[k] = static_cast<std::size_t>((high.at[a] - low_[k] + margin) / edge) + 1;
            begin_[k] = static_cast<std::size_t>(margin / edge);
            end_[k] = size_[k] - begin_[k];
        }
        size_[2] = static_cast<std::size_t>(height / edge) + 3;  // one below, and one above
        fill(cells, run);
        find_empty(frame, seen, walls, run);
    }

    /// The columns along x or y at which an origin may be, from the first to one after the last.
    [[nodiscard]] std::size_t begin(std::size_t axis) const { return begin_[axis]; }
    [[nodiscard]] std::size_t end(std::size_t axis) const { return end_[axis]; }
    /// The middle of a column [m].
    [[nodiscard]] double middle(std::size_t axis, std::size_t column) const {
        return low_[axis] + edge * (static_cast<double>(column) + 0.5);
    }
    /// How much samples count, from the ground upwards in column (i, j), for level surfaces or
    /// others.
    [[nodiscard]] const std::int8_t* column(bool is_level, std::size_t i, std::size_t j) const {
        return value_[is_level ? 1 : 0].data() + (i * size_[1] + j) * size_[2] + 1;
    }
    /// From a value to that of the voxel which contains an offset [m]; the height is above ground.
    [[nodiscard]] std::ptrdiff_t step_to(const Eigen::Vector3d& offset) const {
        const auto steps = [](double x) { return static_cast<std::ptrdiff_t>(std::floor(x)); };
        return (steps(offset.x() / edge + 0.5) * static_cast<std::ptrdiff_t>(size_[1]) +
                steps(offset.y() / edge + 0.5)) *
                   static_cast<std::ptrdiff_t>(size_[2]) +
               steps(offset.z() / edge);
    }

  private:
    static constexpr std::int8_t unknown = 0;

    void fill(std::span<const ground_cell> cells, const auto& run) {
        constexpr double level = 0.8, upright = 0.6;  // chosen: cosines; between them both kinds
        std::vector<unsigned char> kinds(size_[0] * size_[1] * size_[2], 0);
        for (const ground_cell& c : cells) {
            const double height = c.at.z() / edge;
            if (!(height >= 0.0 && height < static_cast<double>(size_[2] - 2))) continue;
            const auto i = static_cast<std::size_t>((c.at.x() - low_[0]) / edge),
                       j = static_cast<std::size_t>((c.at.y() - low_[1]) / edge);
            kinds[(i * size_[1] + j) * size_[2] + static_cast<std::size_t>(height) + 1] |=
                static_cast<unsigned char>((c.up < level ? 1 : 0) | (c.up > upright ? 2 : 0));
        }
        // Cells are `reach` and two voxels from the sides, and one from bottom and top.
        run(value_.size(), [&](std::size_t kind) {
            value_[kind].assign(kinds.size(), unknown);
            for (std::size_t k = 0; k < kinds.size(); ++k)
                if (kinds[k] != 0) spread(value_[kind], k, (kinds[k] >> kind & 1) != 0);
        });
    }

    /// Fills a voxel and those around it, which are of the kind or not.
    void spread(std::vector<std::int8_t>& value, std::size_t k, bool is_of_kind) const {
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) {
                for (std::size_t h = 0; h < 3; ++h) {
                    const std::int8_t more = !is_of_kind                  ? of_other_kind
                                             : i == 1 && j == 1 && h == 1 ? occupied
                                                                          : adjacent;
                    std::int8_t& v = value[k + (i * size_[1] + j) * size_[2] + h -
                                           ((size_[1] + 1) * size_[2] + 1)];
                    v = v == unknown ? more : std::max(v, more);
                }
            }
        }
    }

    void find_empty(const rigid_motion& frame, const visibility& seen, std::span<const wall> walls,
                    const auto& run) {
        constexpr double margin = 2.0 * edge;  // [m]; chosen: half a diagonal of 4 cm, and noise
        run(size_[0], [&](std::size_t i) {
            for (std::size_t j = 0; j < size_[1]; ++j) {
                for (std::size_t h = 0; h < size_[2]; ++h) {
                    const std::size_t k = (i * size_[1] + j) * size_[2] + h;
                    if (value_[0][k] != unknown) continue;
                    const Eigen::Vector3d x = frame.point_out(
                        {middle(0, i), middle(1, j), edge * (static_cast<double>(h) - 0.5)});
                    const bool is_empty =
                        std::ranges::any_of(seen.images(), [&](const range_image& image) {
                            const double range = image.range(image.pixel_of(x));
                            return range > image.distance_to(x) + margin ||
                                   is_in_wall(x, walls, image);
                        });
                    if (is_empty) value_[0][k] = value_[1][k] = empty;
                }
            }
        });
    }

    /// Whether a place is little behind a wall that is seen in front of it. (Farther behind it,
    /// there may be objects of the next room.)
    [[nodiscard]] static bool is_in_wall(const Eigen::Vector3d& x, std::span<const wall> walls,
                                         const range_image& image) {
        constexpr double deepest = 0.3;  // [m]; chosen: half the depth of a table
        return std::ranges::any_of(walls, [&](const wall& w) {
            if (!w.is_before(x, edge) || w.surface.signed_distance(x) < -deepest) return false;
            const Eigen::Vector3d foot = w.foot_of(x);
            return std::abs(image.range(image.pixel_of(foot)) - image.distance_to(foot)) < edge;
        });
    }

    std::array<double, 2> low_{};
    std::array<std::size_t, 3> size_{};
    std::array<std::size_t, 2> begin_{}, end_{};
    std::array<std::vector<std::int8_t>, 2> value_;
};

}  // namespace gnomon::recognition::detail
