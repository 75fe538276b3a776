// SPDX-License-Identifier: BSL-1.0
/// @file
/// How far apart the rays of a scan are, around each of them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/filters/detail/ray_sphere.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace gnomon::detail {

/// How far apart the rays of a scan are in the wider of its directions [rad], with a margin of up
/// to a quarter: around most rays at least, and where they are up to twice as sparse as there,
/// as far from the axis of a rotating scanner.
class raster_reach {
  public:
    template <execution X>
    raster_reach(const ray_sphere& rays, const X& run) {
        const std::size_t thinning = std::max<std::size_t>(1, rays.size() / about);
        scratch<std::size_t> some;
        for (std::size_t i = 0; i < rays.size(); ++i)  // at random: steps may hit a border always
            if (rays.has_ray(i) && random_stream(i).bits() % thinning == 0) some.push_back(i);
        usual_ = of_most(rays, some, run);
        if (usual_ == 0.0) return;
        std::vector<Eigen::Vector3d> ends(some.size());
        scratch<double> own(some.size());
        local_.resize(some.size());
        for_each_chunk(run, some.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t s = begin; s < end; ++s) {
                ends[s] = rays.end_of(some[s]);
                double reach = usual_;
                while (reach <= sparser * usual_ && !rays.is_surrounded(some[s], reach))
                    reach *= growth;
                own[s] = reach;
            }
        });
        sample_.rebuild(ends, run);
        for_each_chunk(run, some.size(), [&](std::size_t begin, std::size_t end) {
            scratch<double> around;
            for (std::size_t s = begin; s < end; ++s) {
                around.clear();
                for (const neighbor& q : sample_.nearest(ends[s], side_by_side))
                    if (own[q.index] <= sparser * usual_) around.push_back(own[q.index]);
                // Where many are at a silhouette, as on thin legs, they contain no information.
                const bool is_inside = 4 * around.size() > 3 * side_by_side;
                local_[s] = is_inside ? quantile_of(around, wide_share) : usual_;
            }
        });
    }

    /// Whether rays are next to each other in two directions.
    [[nodiscard]] bool is_known() const { return usual_ > 0.0; }
    /// Around ray i, which has a direction. Precondition: it is known.
    [[nodiscard]] double around(const ray_sphere& rays, std::size_t i) const {
        return local_[sample_.nearest(rays.end_of(i), 1)[0].index];
    }

  private:
    static constexpr std::size_t about = 2000;  // rays looked at; performance
    static constexpr double growth = 1.25;      // performance: of a reach that is tried
    // Chosen on furniture_models(), seeds 1 and 2: those of two legs are farther apart. A full turn
    // of a scan line is 1.4 times as sparse at its equator as its middle.
    static constexpr double sparser = 2.0;  // ratio of reaches
    // Samples that determine the local reach, and the share of them that it is enough for: not the
    // half, as a reach changes from sample to sample. Chosen on the same.
    static constexpr std::size_t side_by_side = 32;
    static constexpr double wide_share = 0.75;  // share of these samples

    [[nodiscard]] static double quantile_of(scratch<double>& values, double share) {
        const auto at = values.begin() +
                        static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
        std::nth_element(values.begin(), at, values.end());
        return *at;
    }

    /// The reach within which most of these rays are surrounded by others; 0 if there is none, as
    /// in a single scan line.
    template <execution X>
    [[nodiscard]] static double of_most(const ray_sphere& rays, const scratch<std::size_t>& some,
                                        const X& run) {
        constexpr std::size_t many = 1000, stride = 32;  // performance only: no raster has as many
        scratch<double> nearest(some.size()), to_many((some.size() + stride - 1) / stride);
        for_each_chunk(run, some.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k) {
                nearest[k] = rays.distance_of(some[k], 4);  // formula: the directions of a raster
                if (k % stride == 0) to_many[k / stride] = rays.distance_of(some[k], many);
            }
        });
        if (nearest.empty()) return 0.0;
        scratch<std::uint8_t> is_surrounded(some.size());
        // [rad] Coarser than any scanner, and smaller where rays form no raster, such as those from
        // a distant origin where view points are unknown; performance.
        const double widest = std::min(0.2, quantile_of(to_many, 0.5));
        for (double reach = growth * std::max(quantile_of(nearest, 0.5), ray_sphere::same_ray);
             reach < widest; reach *= growth) {
            for_each_chunk(run, some.size(), [&](std::size_t begin, std::size_t end) {
                for (std::size_t k = begin; k < end; ++k)
                    is_surrounded[k] = rays.is_surrounded(some[k], reach) ? 1 : 0;
            });
            const auto surrounded = std::count(is_surrounded.begin(), is_surrounded.end(), 1);
            if (2 * static_cast<std::size_t>(surrounded) >= some.size()) return reach;
        }
        return 0.0;
    }

    double usual_ = 0.0;
    spatial_index sample_;   // some rays,
    scratch<double> local_;  // and the reach around each
};

}  // namespace gnomon::detail
