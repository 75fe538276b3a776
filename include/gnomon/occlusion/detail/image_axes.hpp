// SPDX-License-Identifier: BSL-1.0
/// @file
/// The orientation of a range image, and the projection of directions to its pixels (Klasing 2010,
/// Eq. 2.1, with any pole).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include <Eigen/Core>

#include <gnomon/core/detail/atan2pi.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/pack.hpp>
#include <gnomon/core/detail/symmetric_eigen.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/moments.hpp>

namespace gnomon::detail {

/// Column and row of a pixel.
struct image_cell {
    std::size_t azimuth, elevation;

    friend bool operator==(const image_cell&, const image_cell&) = default;
};

/// Whether a pole has a direction: it is finite, and of any length but 0.
[[nodiscard]] inline bool is_direction(const Eigen::Vector3d& pole) {
    return all_finite(pole) && (pole[0] != 0.0 || pole[1] != 0.0 || pole[2] != 0.0);
}

/// The axes of a range image, of unit length and orthogonal; z is the pole.
struct image_axes {
    Eigen::Vector3d x, y, z;

    /// Those with a given pole of any length. Azimuth counts from the x-axis; where that is the
    /// pole, from the y-axis.
    /// (A template, so that only its users compile it.)
    /// @throws std::invalid_argument  if the pole is not finite or has no length
    [[nodiscard]] static image_axes with_pole(const auto& pole) {
        require(is_direction(pole), "range_image: the pole must be a finite direction");
        constexpr double nearly = 0.9;  // a cosine; numerical: the cross product has a length
        image_axes axes;
        axes.z = direction_of(pole);
        const Eigen::Vector3d start =
            std::abs(axes.z[0]) < nearly ? Eigen::Vector3d(1, 0, 0) : Eigen::Vector3d(0, 1, 0);
        axes.y = direction_of(cross(axes.z, start));
        axes.x = cross(axes.y, axes.z);
        return axes;
    }

    /// The cells of an image of this size for N offsets from its view point [m], N at a time.
    template <std::size_t N>
    [[nodiscard]] std::array<image_cell, N> cells_towards(const std::array<Eigen::Vector3d, N>& to,
                                                          std::size_t width,
                                                          std::size_t height) const {
        using numbers = pack_of<N>;
        const auto along = [&to](const Eigen::Vector3d& axis) {
            std::array<double, N> a;
            for (std::size_t l = 0; l < N; ++l) a[l] = dot(axis, to[l]);
            return numbers(a.data());
        };
        const numbers on_x = along(x), on_y = along(y), on_z = along(z);
        const numbers azimuth = 0.5 * atan2pi(on_y, on_x) + 0.5;
        const numbers elevation = atan2pi(on_z, root(on_x * on_x + on_y * on_y)) + 0.5;
        std::array<image_cell, N> at;
        for (std::size_t l = 0; l < N; ++l) {
            at[l] = {static_cast<std::size_t>(azimuth[l] * static_cast<double>(width)) % width,
                     std::min(static_cast<std::size_t>(elevation[l] * static_cast<double>(height)),
                              height - 1)};
        }
        return at;
    }
};

/// The axis along which directions vary least; z if there are none.
/// @param offset_of  offset_of(s) is the offset to the point of sample s, not zero [m]
[[nodiscard]] Eigen::Vector3d least_observed_axis(const auto& samples, auto&& offset_of) {
    moments directions;
    for (const auto& s : samples) {
        const Eigen::Vector3d d = offset_of(s);
        add_moments(directions.sum, directions.outer, d, 1.0 / dot(d, d));
    }
    Eigen::Matrix3d sum = scaled_whole(directions.outer, 1.0);
    constexpr double tie = 1e-9;  // rounding: where z is as good as any, it is z
    sum(2, 2) *= 1.0 - tie;
    return column(symmetric_eigen(sum).vectors, 2);
}

}  // namespace gnomon::detail
