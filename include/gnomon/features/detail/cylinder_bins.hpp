// SPDX-License-Identifier: BSL-1.0
/// @file
/// The bins of a spin image: divisions of a cylinder about the normal of a point by the distance
/// alpha from the axis and the height beta along it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/normals/estimator.hpp>

namespace gnomon::detail {

/// The members are those of `spin_image`.
struct cylinder_bins {
    double radius, height;  // [m], above 0
    std::size_t radial_bins, axial_bins;
    bool interpolate;

    /// Calls add(bin, weight, k) for each bin that neighbor number k contributes to, with weights
    /// of sum 1.
    /// @return the number of neighbors in the cylinder
    std::size_t for_each_weight(const Eigen::Vector3d& p, const Eigen::Vector3d& normal,
                                neighborhood_view neighbors, auto&& add) const {
        const double across = static_cast<double>(radial_bins),
                     along = static_cast<double>(axial_bins);
        const double per_radius = across / radius, per_height = along / height;
        const double half = 0.5 * height, squared_radius = radius * radius;
        std::size_t inside = 0;
        block_of_neighbors block;
        for (std::size_t first = 0; first < neighbors.size(); first += block_size) {
            const std::size_t size = std::min(block_size, neighbors.size() - first);
            block.measure(p, normal, neighbors.data() + first, size);
            // Without a branch for each neighbor, which would often be predicted wrongly.
            std::array<std::uint32_t, block_size> kept;
            std::size_t count = 0;
            for (std::size_t l = 0; l < size; ++l) {
                kept[count] = static_cast<std::uint32_t>(l);
                count += static_cast<std::size_t>((block.alpha2[l] <= squared_radius) &
                                                  (std::abs(block.beta[l]) <= half));
            }
            for (std::size_t c = 0; c < count; ++c) {
                const std::size_t l = kept[c];
                distribute({std::sqrt(block.alpha2[l]) * per_radius, across},
                           {(block.beta[l] + half) * per_height, along}, first + l, add);
            }
            inside += count;
        }
        return inside;
    }

  private:
    static constexpr std::size_t block_size = 32;  // performance only

    /// Squares of alpha [m^2], and beta [m], of some neighbors.
    struct block_of_neighbors {
        std::array<double, block_size> x{}, y{}, z{}, alpha2, beta;

        void measure(const Eigen::Vector3d& p, const Eigen::Vector3d& n,
                     const Eigen::Vector3d* first, std::size_t size) {
            for (std::size_t l = 0; l < size; ++l) {
                x[l] = first[l][0] - p[0];
                y[l] = first[l][1] - p[1];
                z[l] = first[l][2] - p[2];
            }
            const double nx = n[0], ny = n[1], nz = n[2];
            for (std::size_t l = 0; l < block_size; ++l) {  // of fixed length, for vectors
                beta[l] = nx * x[l] + ny * y[l] + nz * z[l];
                // |n x d|^2: |d|^2 - beta^2 has few correct digits near the axis.
                const double a = ny * z[l] - nz * y[l];
                const double b = nz * x[l] - nx * z[l];
                const double c = nx * y[l] - ny * x[l];
                alpha2[l] = a * a + b * b + c * c;
            }
        }
    };

    /// A place on an axis in units of its bins, of which the last one is closed.
    struct place {
        std::int64_t bin;
        double part;  // of the bin that is below, in [0, 1]

        place(double x, double bins) {
            x = x < bins ? x : bins;
            bin = static_cast<std::int64_t>(x);
            bin -= static_cast<std::int64_t>(x >= bins);
            part = x - static_cast<double>(bin);
        }
    };

    void distribute(const place& i, const place& j, std::size_t k, auto&& add) const {
        const auto bins = static_cast<std::int64_t>(axial_bins);
        if (!interpolate) return add(i.bin * bins + j.bin, 1.0, k);
        const std::int64_t corner = i.bin * (bins + 1) + j.bin, next = corner + bins + 1;
        const double both = i.part * j.part;
        add(corner, 1.0 - i.part - j.part + both, k);
        add(corner + 1, j.part - both, k);
        add(next, i.part - both, k);
        add(next + 1, both, k);
    }
};

}  // namespace gnomon::detail
