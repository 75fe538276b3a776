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
    /// How much samples on the ground count in column (i, j), to which steps lead from there.
    [[nodiscard]] const std::int8_t* column(std::size_t i, std::size_t j) const {
        return value_.data() + (i * size_[1] + j) * size_[2] + 1;
    }
    /// From there to how much a sample of a level surface, or of another one, counts in the voxel
    /// that contains an offset [m]; the height is above ground.
    [[nodiscard]] std::ptrdiff_t step_to(bool is_level, const Eigen::Vector3d& offset) const {
        const auto steps = [](double x) { return static_cast<std::ptrdiff_t>(std::floor(x)); };
        return (steps(offset.x() / edge + 0.5) * static_cast<std::ptrdiff_t>(size_[1]) +
                steps(offset.y() / edge + 0.5)) *
                   static_cast<std::ptrdiff_t>(size_[2]) +
               steps(offset.z() / edge) + (is_level ? static_cast<std::ptrdiff_t>(voxels()) : 0);
    }

  private:
    static constexpr std::int8_t unknown = 0;
    static constexpr std::size_t few = 8;  // performance only: pixels that are found at once
    using few_places = std::array<Eigen::Vector3d, few>;
    static constexpr std::size_t kinds_of_surfaces = 2;  // upright ones first

    [[nodiscard]] std::size_t voxels() const { return size_[0] * size_[1] * size_[2]; }

    void fill(std::span<const ground_cell> cells, const auto& run) {
        constexpr double level = 0.8, upright = 0.6;  // chosen: cosines; between them both kinds
        std::vector<unsigned char> kinds(voxels(), 0);
        for (const ground_cell& c : cells) {
            const double height = c.at.z() / edge;
            if (!(height >= 0.0 && height < static_cast<double>(size_[2] - 2))) continue;
            const auto i = static_cast<std::size_t>((c.at.x() - low_[0]) / edge),
                       j = static_cast<std::size_t>((c.at.y() - low_[1]) / edge);
            kinds[(i * size_[1] + j) * size_[2] + static_cast<std::size_t>(height) + 1] |=
                static_cast<unsigned char>((c.up < level ? 1 : 0) | (c.up > upright ? 2 : 0));
        }
        // Cells are `reach` and two voxels from the sides, and one from bottom and top.
        value_.assign(kinds_of_surfaces * voxels(), unknown);
        run(kinds_of_surfaces, [&](std::size_t kind) {
            for (std::size_t k = 0; k < kinds.size(); ++k)
                if (kinds[k] != 0) spread(kind * voxels() + k, (kinds[k] >> kind & 1) != 0);
        });
    }

    /// Fills a voxel and those around it, which are of the kind or not.
    void spread(std::size_t k, bool is_of_kind) {
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) {
                for (std::size_t h = 0; h < 3; ++h) {
                    const std::int8_t more = !is_of_kind                  ? of_other_kind
                                             : i == 1 && j == 1 && h == 1 ? occupied
                                                                          : adjacent;
                    std::int8_t& v = value_[k + (i * size_[1] + j) * size_[2] + h -
                                            ((size_[1] + 1) * size_[2] + 1)];
                    v = v == unknown ? more : std::max(v, more);
                }
            }
        }
    }

    /// Finds where the sensor saw through or a wall is, in a few voxels at once.
    void find_empty(const rigid_motion& frame, const visibility& seen, std::span<const wall> walls,
                    const auto& run) {
        run(size_[0], [&](std::size_t i) {
            few_places at;
            std::array<std::size_t, few> voxel{};
            std::size_t n = 0;
            const auto mark = [&] {
                std::fill(at.begin() + static_cast<std::ptrdiff_t>(n), at.end(), at.front());
                const auto is_empty = are_empty(at, seen, walls);
                for (std::size_t l = 0; l < n; ++l)
                    if (is_empty[l]) value_[voxel[l]] = value_[voxels() + voxel[l]] = empty;
                n = 0;
            };
            for (std::size_t j = 0; j < size_[1]; ++j) {
                for (std::size_t h = 0; h < size_[2]; ++h) {
                    const std::size_t k = (i * size_[1] + j) * size_[2] + h;
                    if (value_[k] != unknown) continue;
                    at[n] = frame.point_out(
                        {middle(0, i), middle(1, j), edge * (static_cast<double>(h) - 0.5)});
                    voxel[n++] = k;
                    if (n == few) mark();
                }
            }
            if (n > 0) mark();
        });
    }

    /// Whether one view point saw through a place, or a wall there.
    [[nodiscard]] static std::array<bool, few> are_empty(const few_places& at,
                                                         const visibility& seen,
                                                         std::span<const wall> walls) {
        constexpr double margin = 2.0 * edge;  // [m]; chosen: half a diagonal of 4 cm, and noise
        std::array<bool, few> is_empty{};
        for (const range_image& image : seen.images()) {
            const auto pixels = image.pixels_of(at);
            for (std::size_t l = 0; l < few; ++l)
                is_empty[l] = is_empty[l] ||
                              image.range(pixels[l]) > image.distance_to(at[l]) + margin ||
                              is_in_wall(at[l], walls, image);
        }
        return is_empty;
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
    std::vector<std::int8_t> value_;  // of the voxels, for each kind of surfaces
};

}  // namespace gnomon::recognition::detail
