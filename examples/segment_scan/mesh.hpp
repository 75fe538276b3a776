// SPDX-License-Identifier: BSL-1.0
/// @file
/// The polygons of flat segments as a mesh of triangles, which have no holes to lose.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "picture/palette.hpp"
#include "segment_scan/shape.hpp"
#include <gnomon/gnomon.hpp>

/// A binary PLY file of triangles: vertices on the planes of the segments, with colors and labels.
class ply_mesh {
  public:
    /// Adds the triangles of a flat segment.
    void add(const segment_bounds& bounds, std::int32_t label) {
        std::vector<gnomon::point_index> used;
        for (const auto& triangle : bounds.outline.triangles)
            used.insert(used.end(), triangle.begin(), triangle.end());
        std::ranges::sort(used);
        used.erase(std::unique(used.begin(), used.end()), used.end());
        const picture::color color = picture::color_of(label);
        for (const Eigen::Vector3d& corner : bounds.corners(used)) {
            for (const double coordinate : corner) append<std::uint64_t>(vertices_, coordinate);
            for (const std::uint8_t channel : color) append<std::uint8_t>(vertices_, channel);
            append<std::uint32_t>(vertices_, label);
        }
        for (const auto& triangle : bounds.outline.triangles) {
            append<std::uint8_t>(faces_, std::uint8_t{3});
            for (const gnomon::point_index i : triangle) {
                const auto place = std::ranges::lower_bound(used, i) - used.begin();
                append<std::uint32_t>(faces_, static_cast<std::uint32_t>(
                                                  vertex_count_ + static_cast<std::size_t>(place)));
            }
        }
        vertex_count_ += used.size();
        face_count_ += bounds.outline.triangles.size();
    }

    [[nodiscard]] std::string bytes() const {
        return "ply\nformat binary_little_endian 1.0\nelement vertex " +
               std::to_string(vertex_count_) +
               "\nproperty double x\nproperty double y\nproperty double z\n"
               "property uchar red\nproperty uchar green\nproperty uchar blue\n"
               "property int label\nelement face " +
               std::to_string(face_count_) +
               "\nproperty list uchar uint vertex_indices\nend_header\n" + vertices_ + faces_;
    }

  private:
    template <std::unsigned_integral Bits, class T>
    static void append(std::string& bytes, T value) {
        static_assert(sizeof(Bits) == sizeof(T));
        const auto bits = std::bit_cast<Bits>(value);
        for (std::size_t i = 0; i < sizeof(T); ++i)
            bytes += static_cast<char>(static_cast<std::uint8_t>(bits >> (8 * i)));
    }

    std::string vertices_;
    std::string faces_;
    std::size_t vertex_count_ = 0;
    std::size_t face_count_ = 0;
};
