// SPDX-License-Identifier: BSL-1.0
/// @file
/// Smooth surfaces of an organized image. Alg. 4.2 joins neighboring points whose normals turn by a
/// small angle. With normals of wide windows this leaks: across an edge they turn gradually. Hence
/// pixels join nothing at first whose window is no plane, as its variance exceeds that of the
/// noise, or whose normal disagrees with that of a pixel a quarter of its window away. Each of
/// these is assigned to an adjacent segment whose tangent plane explains it. Then adjacent segments
/// that one plane explains are merged.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/union_find.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/detail/image_links.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/segmentation/detail/agglomeration.hpp>
#include <gnomon/segmentation/detail/plane_comparison.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>
#include <gnomon/segmentation/detail/region_pairs.hpp>
#include <gnomon/segmentation/detail/surface_noise.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// The surfaces of the pixels of an image. (A template, so that only its users compile it.)
template <class Links, class Surface, class Index = point_index>
class image_surfaces {
  public:
    /// @param epsilon       machine epsilon of the numbers that the points came in
    /// @param max_distance  no pixels of one segment are next to each other that are farther [m]
    image_surfaces(const Links& links, const Surface& surface, double epsilon, double max_distance)
        : links_(links),
          surface_(surface),
          epsilon_(epsilon),
          max_squared_(max_distance * max_distance) {}

    /// The labels of the segments of at least `min_points` pixels, largest first.
    /// @param link      link(i, q): whether the normals of i and of q, next to it, agree
    /// @param agrees    the same for pixels that are farther apart
    template <execution X>
    [[nodiscard]] auto labels(auto&& link, auto&& agrees, std::size_t min_points, const X& run) {
        const std::size_t n = links_.part().size();
        is_plane_.assign(n, 0);
        for_each_chunk(run, n, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) is_plane_[i] = is_plane(i) ? 1 : 0;
        });
        is_inner_.assign(n, 0);
        for_each_chunk(run, n, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) is_inner_[i] = is_inner(i, agrees) ? 1 : 0;
        });
        union_find sets(n);
        for_each_chunk(run, n, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                if (is_inner_[i] == 0) continue;
                for_each_linked(i, before, [&](std::size_t j) {
                    const auto a = static_cast<Index>(i), b = static_cast<Index>(j);
                    const neighbor q{squared_distance(links_[i], links_[j]), b};
                    if (is_inner_[j] != 0 && link(i, q)) sets.unite(a, b);
                });
            }
        });
        auto all = labels_of_sets(sets, min_points, [this](std::size_t i) { return is_inner_[i]; });
        assign_rest(all, run);
        merge_coplanar(all);
        number_by_size(all);
        return all;
    }

  private:
    static constexpr Index none = std::numeric_limits<Index>::max();

    static constexpr std::array before{way::left, way::up};
    static constexpr std::array around{way::left, way::right, way::up, way::down};

    /// Calls each(j) for the pixels on these ways that i is linked with, none farther than the
    /// limit.
    void for_each_linked(std::size_t i, const auto& ways, auto&& each) const {
        for (const way to : ways) {
            if (links_.gap(i, to) == 0) continue;
            const std::size_t j = links_.next(i, to);
            if (squared_distance(links_[i], links_[j]) <= max_squared_) each(j);
        }
    }

    [[nodiscard]] double rounding_at(std::size_t i) const {
        const Eigen::Vector3d p = links_[i];
        return epsilon_ * std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
    }
    [[nodiscard]] point_noise noise_at(std::size_t i) const {
        return {links_.variance(i), links_.ray(i), true, rounding_at(i)};
    }
    /// The square of noise_at(i).across(normal) [m^2], in less time.
    [[nodiscard]] double variance_across(std::size_t i, const Eigen::Vector3d& normal) const {
        const Eigen::Vector3d ray = links_.ray(i);
        const double rounding = rounding_at(i), along = dot(ray, normal);
        const double variance = flatness * flatness + rounding * rounding + links_.variance(i);
        if (!has_length(ray)) return variance;
        return variance * std::max(along * along / dot(ray, ray), least_cosine * least_cosine);
    }

    /// Whether a pixel has a normal, and its window is a plane, if the estimate has its variance.
    [[nodiscard]] bool is_plane(std::size_t i) const {
        const auto& element = surface_[i];
        if (!links_.has_return(i) || is_missing(element.normal)) return false;
        if constexpr (requires { element.spectrum.lambda[2]; }) {
            return element.spectrum.lambda[2] <=
                   region_plane::most_excess * variance_across(i, element.normal);
        }
        return true;
    }

    /// A quarter of the width of a square window with these neighbors [pixels].
    [[nodiscard]] static std::size_t quarter_of_window(double neighbors) {
        constexpr double quarter = 0.25;  // formula
        return static_cast<std::size_t>(quarter * std::sqrt(neighbors + 1.0));
    }

    /// Whether a pixel is a plane, and agrees with those a quarter of its window away, by twice the
    /// angle of pixels next to each other: across an edge, windows that overlap by three quarters
    /// turn by a large part of its angle, and on a plane they share most of their noise.
    [[nodiscard]] bool is_inner(std::size_t i, auto&& agrees) const {
        if (is_plane_[i] == 0) return false;
        std::size_t quarter = 1;  // of the width of the window [pixels]
        if constexpr (requires { surface_[i].neighbors; })
            quarter = std::max(quarter, quarter_of_window(surface_[i].neighbors));
        for (const way to : around) {
            std::size_t j = i;
            for (std::size_t moved = 0; moved < quarter && links_.gap(j, to) > 0;) {
                moved += links_.gap(j, to);
                j = links_.next(j, to);
            }
            if (is_plane_[j] != 0 && !agrees(i, neighbor{0.0, static_cast<Index>(j)})) return false;
        }
        return true;
    }

    /// Gives the unlabeled pixels, from the segments outwards, to the segment next to them
    /// whose tangent plane explains them best: within three standard deviations of a
    /// difference.
    template <execution X>
    void assign_rest(auto& labels, const X& run) const {
        const std::size_t n = labels.size();
        scratch<Index> seed(n, none);  // the pixel whose tangent plane a label comes with
        scratch<Index> front, found;
        for (std::size_t i = 0; i < n; ++i) {
            if (labels[i] != unlabeled)
                seed[i] = static_cast<Index>(i);
            else if (links_.has_return(i))
                front.push_back(static_cast<Index>(i));
        }
        while (!front.empty()) {
            found.resize(front.size());
            for_each_chunk(run, front.size(), [&](std::size_t begin, std::size_t end) {
                for (std::size_t f = begin; f < end; ++f) found[f] = best_seed(front[f], seed);
            });
            for (std::size_t f = 0; f < front.size(); ++f) {
                if (found[f] == none) continue;
                seed[front[f]] = found[f];
                labels[front[f]] = labels[found[f]];
            }
            // Only next to new labels there may be others.
            scratch<Index> next;
            for (std::size_t f = 0; f < front.size(); ++f) {
                if (found[f] == none) continue;
                for_each_linked(front[f], around, [&](std::size_t j) {
                    if (seed[j] == none) next.push_back(static_cast<Index>(j));
                });
            }
            std::sort(next.begin(), next.end());
            next.erase(std::unique(next.begin(), next.end()), next.end());
            front.swap(next);
        }
    }

    /// Of the seeds of the pixels that i is linked with, that whose tangent plane explains i
    /// best, of equal ones the smallest; none if it does not.
    [[nodiscard]] Index best_seed(std::size_t i, const scratch<Index>& seed) const {
        Index best = none;
        double least = most_deviations;
        for_each_linked(i, around, [&](std::size_t j) {
            if (seed[j] == none || seed[j] == best) return;
            const double off = deviations(i, seed[j]);
            if (!(off <= least) || (off == least && seed[j] > best)) return;
            least = off;
            best = seed[j];
        });
        return best;
    }

    /// Merges segments next to each other that one plane explains: where noise is correlated,
    /// as in steps of the depth, a wall is several at first.
    void merge_coplanar(auto& labels) const {
        const auto last = std::max_element(labels.begin(), labels.end());
        if (last == labels.end() || *last < 1) return;
        scratch<planar_region> regions(static_cast<Index>(*last) + std::size_t{1});
        scratch<char> skip(regions.size(), 0);
        scratch<region_pair> pairs;
        const Eigen::Vector3d origin = links_[static_cast<std::size_t>(last - labels.begin())];
        for (std::size_t i = 0; i < labels.size(); ++i) {
            if (labels[i] == unlabeled) continue;
            const auto own = static_cast<Index>(labels[i]);
            if (skip[own] == 0) regions[own].sums.add(difference(links_[i], origin), noise_at(i));
            skip[own] ^= 1;  // every second pixel of each: performance only
            for_each_linked(i, before, [&](std::size_t j) {
                if (labels[j] == unlabeled || labels[j] == labels[i]) return;
                add_once(region_pair(std::minmax(own, static_cast<Index>(labels[j]))), pairs);
            });
        }
        for (planar_region& r : regions) r.fit = r.sums.fit();
        make_unique(pairs);
        union_find sets = agglomeration(regions)(
            std::move(pairs),
            [](const planar_region& a, const planar_region& b) {
                return dissimilarity_of_neighbors(a, b);
            },
            [](Index, Index) { return true; }, [](union_find&) { return scratch<region_pair>(); });
        unite_labels(labels, sets);
    }

    /// How far pixel i is from the tangent plane of a seed, in deviations of the difference of
    /// both.
    [[nodiscard]] double deviations(std::size_t i, std::size_t seed) const {
        const Eigen::Vector3d& n = surface_[seed].normal;
        const double distance = std::abs(dot(n, difference(links_[i], links_[seed])));
        return distance / std::sqrt(variance_across(i, n) + variance_across(seed, n));
    }

    const Links& links_;
    const Surface& surface_;
    double epsilon_, max_squared_;
    scratch<char> is_plane_, is_inner_;
};

}  // namespace gnomon::detail
