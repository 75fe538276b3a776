// SPDX-License-Identifier: BSL-1.0
/// @file
/// Smooth surfaces of an organized image. Alg. 4.2 joins neighboring points whose normals turn by a
/// small angle. With normals of wide windows this leaks: across an edge they turn gradually. Hence
/// pixels whose window is no plane, as its variance exceeds that of the noise, join nothing at
/// first; each of them, if a plane explains it, goes to a surface next to it afterwards.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/union_find.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/detail/image_links.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>
#include <gnomon/segmentation/detail/surface_noise.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// The surfaces of the pixels of an image. (A template, so that only its users compile it.)
template <class Links, class Surface, class Index = point_index>
class image_surfaces {
  public:
    /// @param epsilon  machine epsilon of the numbers that the points came in
    image_surfaces(const Links& links, const Surface& surface, double epsilon)
        : links_(links), surface_(surface), epsilon_(epsilon) {}

    /// The labels of the segments of at least `min_points` pixels, largest first.
    /// @param link      link(i, q): whether neighbor q of i is on the same surface by its normal
    /// @param distance  no link is longer [m]
    template <execution X>
    [[nodiscard]] auto labels(auto&& link, double distance, std::size_t min_points, const X& run) {
        const std::size_t n = links_.part().size();
        is_plane_.assign(n, 0);
        for_each_chunk(run, n, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) is_plane_[i] = is_plane(i) ? 1 : 0;
        });
        union_find sets(n);
        for_each_chunk(run, n, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                if (is_plane_[i] == 0) continue;
                for_each_before(i, [&](std::size_t j) {
                    const auto a = static_cast<Index>(i), b = static_cast<Index>(j);
                    const neighbor q{squared_distance(links_[i], links_[j]), b};
                    if (is_plane_[j] == 0 || q.squared_distance > distance * distance) return;
                    if (link(i, q)) sets.unite(a, b);
                });
            }
        });
        auto all = labels_of_sets(sets, min_points, [this](std::size_t i) { return is_plane_[i]; });
        assign_rest(all);
        number_by_size(all);
        return all;
    }

  private:
    static constexpr Index none = std::numeric_limits<Index>::max();

    /// Calls each(j) for the pixels before i in its row and column that it is linked with.
    void for_each_before(std::size_t i, auto&& each) const {
        if (const std::size_t gap = links_.in_row(i)) each(i - gap);
        if (const std::size_t gap = links_.in_column(i)) each(i - gap * links_.part().width);
    }

    /// The same for those before and after it.
    void for_each_linked(std::size_t i, auto&& each) const {
        for_each_before(i, each);
        if (const std::size_t gap = links_.to_next_in_row(i)) each(i + gap);
        if (const std::size_t gap = links_.to_next_in_column(i)) each(i + gap * links_.part().width);
    }

    [[nodiscard]] point_noise noise_at(std::size_t i) const {
        const Eigen::Vector3d p = links_[i];
        const double rounding =
            epsilon_ * std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
        return {links_.variance(i), links_.ray(i), true, rounding};
    }

    /// Whether a pixel has a normal, and its window is a plane, if the estimate has its variance.
    [[nodiscard]] bool is_plane(std::size_t i) const {
        const auto& element = surface_[i];
        if (!links_.has_return(i) || is_missing(element.normal)) return false;
        if constexpr (requires { element.spectrum.lambda[2]; }) {
            const double across = noise_at(i).across(element.normal);
            return element.spectrum.lambda[2] <= region_plane::most_excess * across * across;
        }
        return true;
    }

    /// Gives the unlabeled pixels, from the segments outwards, to the segment next to them whose
    /// tangent plane explains them best: within three standard deviations of a difference.
    void assign_rest(auto& labels) const {
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
            found.clear();
            for (const Index i : front) found.push_back(best_seed(i, seed));
            for (std::size_t f = 0; f < front.size(); ++f) {
                if (found[f] == none) continue;
                seed[front[f]] = found[f];
                labels[front[f]] = labels[found[f]];
            }
            // Only next to new labels there may be others.
            scratch<Index> next;
            for (std::size_t f = 0; f < front.size(); ++f) {
                if (found[f] == none) continue;
                for_each_linked(front[f], [&](std::size_t j) {
                    if (seed[j] == none) next.push_back(static_cast<Index>(j));
                });
            }
            std::sort(next.begin(), next.end());
            next.erase(std::unique(next.begin(), next.end()), next.end());
            front.swap(next);
        }
    }

    /// Of the seeds of the pixels that i is linked with, that whose tangent plane explains i best,
    /// of equal ones the smallest; none if it does not.
    [[nodiscard]] Index best_seed(std::size_t i, const scratch<Index>& seed) const {
        const point_noise own = noise_at(i);
        Index best = none;
        double least = most_deviations;
        for_each_linked(i, [&](std::size_t j) {
            if (seed[j] == none || seed[j] == best) return;
            const double off = deviations(i, own, seed[j]);
            if (off > least || (off == least && seed[j] > best)) return;
            least = off;
            best = seed[j];
        });
        return best;
    }

    /// How far pixel i is from the tangent plane of a seed, in deviations of the difference of both.
    [[nodiscard]] double deviations(std::size_t i, const point_noise& own, std::size_t seed) const {
        const Eigen::Vector3d& n = surface_[seed].normal;
        const double distance = std::abs(dot(n, difference(links_[i], links_[seed])));
        return distance / std::hypot(own.across(n), noise_at(seed).across(n));
    }

    const Links& links_;
    const Surface& surface_;
    double epsilon_;
    scratch<char> is_plane_;
};

}  // namespace gnomon::detail
