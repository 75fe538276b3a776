// SPDX-License-Identifier: BSL-1.0
/// @file
/// Whether a view point is one: from the view point of a scan, each ray has one depth. Of a cloud
/// fused from several scans, whose file gives the origin as its view point, rays have several.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/normals/detail/quantile.hpp>

namespace gnomon::detail {

/// Directions from one view point to points, in an order in which neighbors are close to each
/// other: that of Morton codes, in the box of the directions. (A template, so that only code that
/// measures noise compiles it.)
template <class Index>
class sorted_directions {
  public:
    sorted_directions(const Index& index, const Eigen::Vector3d& viewpoint) {
        Eigen::Vector3d low(2.0, 2.0, 2.0), high(-2.0, -2.0, -2.0);
        for (std::size_t i = 0; i < index.size(); ++i) {
            if (!index.is_finite(i)) continue;
            const Eigen::Vector3d ray = difference(index[i], viewpoint);
            const double range = length(ray);
            if (!(range > 0.0)) continue;
            all_.push_back({0, scaled(1.0 / range, ray), range});
            for (int a = 0; a < 3; ++a) {
                low[a] = std::min(low[a], all_.back().direction[a]);
                high[a] = std::max(high[a], all_.back().direction[a]);
            }
        }
        const Eigen::Vector3d width = difference(high, low);
        const double widest = std::max({width[0], width[1], width[2]});
        constexpr double cells = 2097151.0;  // 2^21 - 1 along each axis
        for (entry& e : all_) {
            for (int a = 0; a < 3; ++a) {
                const double at = widest > 0.0 ? (e.direction[a] - low[a]) / widest : 0.0;
                e.code |= spread(static_cast<std::uint64_t>(at * cells)) << a;
            }
        }
        keep_some_blocks();
        std::sort(all_.begin(), all_.end(),
                  [](const entry& a, const entry& b) { return a.code < b.code; });
    }

    /// Of pairs of rays that are next to each other in this order, and no farther apart than most
    /// of them, the share whose depths are not one surface: they differ by more than 8 standard
    /// deviations of the noise, and more than on a surface seen at 84 degrees.
    [[nodiscard]] double share_of_several_depths(auto&& noise) const {
        if (all_.size() < 2) return 0.0;
        scratch<double> apart;
        for (std::size_t i = 1; i < all_.size(); ++i) apart.push_back(angle_before(i));
        scratch<double> copy = apart;
        const double nearby = quantile(copy, 0.5);
        std::size_t pairs = 0, several = 0;
        for (std::size_t i = 1; i < all_.size(); ++i) {
            if (apart[i - 1] > nearby) continue;
            const double a = all_[i - 1].range, b = all_[i].range;
            constexpr double steep = 10.0;  // the tangent of 84 degrees; chosen
            const double slope = steep * apart[i - 1] * std::min(a, b);
            ++pairs;
            several += std::abs(a - b) > slope + 8.0 * noise(all_[i].direction, std::max(a, b));
        }
        return static_cast<double>(several) / static_cast<double>(pairs);
    }

  private:
    struct entry {
        std::uint64_t code;
        Eigen::Vector3d direction;
        double range;
    };

    /// Of many directions, those in some blocks are enough, as dense as before (performance only).
    void keep_some_blocks() {
        constexpr std::size_t enough = 40'000;
        const std::uint64_t part = all_.size() / enough;
        if (part < 2) return;
        std::erase_if(all_, [part](const entry& e) {
            constexpr int bits = 15;  // 32 blocks along each axis
            return random_stream(e.code >> (63 - bits)).bits() % part != 0;
        });
    }

    [[nodiscard]] double angle_before(std::size_t i) const {
        return length(difference(all_[i].direction, all_[i - 1].direction));
    }

    /// Two zero bits after each of the low 21 bits.
    [[nodiscard]] static std::uint64_t spread(std::uint64_t x) {
        x = (x | x << 32) & 0x001f00000000ffff;
        x = (x | x << 16) & 0x001f0000ff0000ff;
        x = (x | x << 8) & 0x100f00f00f00f00f;
        x = (x | x << 4) & 0x10c30c30c30c30c3;
        x = (x | x << 2) & 0x1249249249249249;
        return x;
    }

    scratch<entry> all_;
};

}  // namespace gnomon::detail
