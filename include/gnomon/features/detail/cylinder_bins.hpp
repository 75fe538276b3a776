// SPDX-License-Identifier: BSL-1.0
/// @file
/// The bins of a spin image: divisions of a cylinder about the normal of a point by the distance
/// alpha from the axis and the height beta along it.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/instruction_set.hpp>
#include <gnomon/core/detail/pack.hpp>
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
        block_of_neighbors block{*this};
        std::size_t inside = 0;
        for (std::size_t first = 0; first < neighbors.size(); first += block_size) {
            const std::size_t size = std::min(block_size, neighbors.size() - first);
            std::uint32_t kept = block.measure(p, normal, neighbors.subspan(first, size));
            inside += static_cast<std::size_t>(std::popcount(kept));
            // By bits: a branch for each neighbor would often be predicted wrongly.
            for (; kept != 0; kept &= kept - 1) {
                const auto l = static_cast<std::size_t>(std::countr_zero(kept));
                distribute({block.alpha[l], across}, {block.beta[l], along}, first + l, add);
            }
        }
        return inside;
    }

  private:
    static constexpr std::size_t block_size = 32;  // bits of a mask; performance only

    /// alpha, and beta from the lower end, of some neighbors, in units of the bins.
    class block_of_neighbors {
      public:
        std::array<double, block_size> alpha, beta;

        explicit block_of_neighbors(const cylinder_bins& of)
            : most_alpha2_(of.radius * of.radius),
              most_beta_(0.5 * of.height),
              per_radius_(static_cast<double>(of.radial_bins) / of.radius),
              per_height_(static_cast<double>(of.axial_bins) / of.height) {}

        /// @return a bit for each neighbor in the cylinder
        std::uint32_t measure(const Eigen::Vector3d& p, const Eigen::Vector3d& n,
                              std::span<const Eigen::Vector3d> neighbors) {
            std::uint32_t kept = 0;
            std::array<Eigen::Vector3d, pack::size> last;
            for (std::size_t l = 0; l < neighbors.size(); l += pack::size) {
                const std::size_t rest = neighbors.size() - l;
                const Eigen::Vector3d* first = neighbors.data() + l;
                if (rest < pack::size) {
                    last.fill(p);
                    std::copy_n(first, rest, last.begin());
                    first = last.data();
                }
                std::uint32_t bits = measure_pack(p, n, first, l);
                if (rest < pack::size) bits &= (std::uint32_t{1} << rest) - 1;
                kept |= bits << l;
            }
            return kept;
        }

      private:
        [[GNOMON_ALWAYS_INLINE]] std::uint32_t measure_pack(const Eigen::Vector3d& p,
                                                            const Eigen::Vector3d& n,
                                                            const Eigen::Vector3d* first,
                                                            std::size_t l) {
            static constexpr std::uint32_t stride[] = {0, 3, 6, 9, 12, 15, 18, 21};
            const double* const at = first->data();
            const pack x = pack(at, stride) - p[0];
            const pack y = pack(at + 1, stride) - p[1];
            const pack z = pack(at + 2, stride) - p[2];
            const pack above = n[0] * x + n[1] * y + n[2] * z;
            // |n x d|^2: |d|^2 - beta^2 has few correct digits near the axis.
            const pack a = n[1] * z - n[2] * y, b = n[2] * x - n[0] * z;
            const pack c = n[0] * y - n[1] * x;
            const pack alpha2 = a * a + b * b + c * c;
            const pack across = per_radius_ * root(alpha2);
            const pack along = per_height_ * (above + most_beta_);
            std::memcpy(&alpha[l], &across, sizeof across);
            std::memcpy(&beta[l], &along, sizeof along);
            return at_most(alpha2, most_alpha2_) & at_most(magnitude(above), most_beta_);
        }

        double most_alpha2_, most_beta_, per_radius_, per_height_;
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
