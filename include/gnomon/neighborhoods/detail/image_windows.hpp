// SPDX-License-Identifier: BSL-1.0
/// @file
/// Windows around the pixels of an organized image that end where its surface does. The window of a
/// pixel goes up and down its column, and from each of these pixels along its row, over links, as
/// far as the radius (the cross-based support of Zhang, Lu and Lafruit 2009).
///
/// The radius is the least by which noise turns the normal of a plane by no more than a given
/// angle. The slope of a plane fit to the depths of n = (2 r + 1)^2 pixels at a spacing h has the
/// variance sigma^2 / S, where S = n h^2 r (r + 1) / 3 is the sum of their squared offsets.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/detail/image_links.hpp>
#include <gnomon/neighborhoods/detail/lane_instructions.hpp>
#include <gnomon/neighborhoods/detail/window_sums.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>

namespace gnomon::detail {
inline namespace GNOMON_LANES {

/// The vectors of some instructions.
template <class Instructions>
struct vectors_of {
    using type = four_numbers;
};
#if GNOMON_LANE_BITS == 256 || defined(GNOMON_LANES_UP_TO_AVX2)
template <>
struct vectors_of<avx2_instructions> {
    using type = four_numbers_of_avx2;
};
#endif
#if GNOMON_LANE_BITS == 512
template <>
struct vectors_of<avx512_instructions> {
    using type = four_numbers_of_avx2;
};
#endif

/// The pixels in the window of another one; refers to the windows.
template <class Windows>
class window_neighbors {
  public:
    window_neighbors(const Windows& windows, std::size_t center)
        : windows_(windows), center_(center) {
        windows.for_each_row(center, [this](std::size_t begin, std::size_t end) {
            count_ += windows_.returns(begin, end);
        });
        --count_;  // the pixel itself
    }

    [[nodiscard]] std::size_t size() const { return count_; }

    /// The moments [m], [m^2] of the neighbors about the pixel, and their mean distance. O(k).
    [[nodiscard]] neighborhood_sums summed() const {
        return with_widest([this](auto instructions) {
            return summed_by<typename vectors_of<decltype(instructions)>::type>(windows_, center_,
                                                                                count_);
        });
    }

    /// Replaces the content of `found` by the neighbors in the order of their pixels. O(k).
    template <class Allocator>
    void sort_into(std::vector<neighbor, Allocator>& found) const {
        found.clear();
        const auto& links = windows_.links();
        windows_.for_each_row(center_, [&](std::size_t begin, std::size_t end) {
            for (std::size_t l = begin; l < end; ++l) {
                if (l == center_ || !links.has_return(l)) continue;
                found.push_back({squared_distance(links[l], links[center_]),
                                 static_cast<point_index>(links.part().index_of(l))});
            }
        });
    }

  private:
    const Windows& windows_;
    std::size_t center_;
    std::size_t count_ = 0;
};

/// The windows of all pixels of a rectangle. (A template, so that only its users compile it.)
template <class Number = double, class Index = point_index>
class image_windows {
  public:
    /// @param least, most  radii [pixels]
    /// @param precision    the standard deviation of a normal from which on windows do not grow
    ///                     [rad]
    template <execution X>
    image_windows(const auto& points, const viewpoint_table& viewpoints, const noise_curve& noise,
                  const pixel_rectangle& part, std::size_t least, std::size_t most,
                  double precision, const X& run)
        : links_(points, viewpoints, noise, part, most, run) {
        for (scratch<Index>* const each : {&left_, &right_, &up_, &down_, &radius_, &before_})
            each->resize(part.size() + 1);
        // No window of a larger radius has more pixels.
        const std::size_t whole = std::max<std::size_t>(1, std::max(part.width, part.height));
        least = std::min(least, whole);
        most = std::min(most, whole);
        for (std::size_t l = 0; l < part.size(); ++l)
            before_[l + 1] = before_[l] + (links_.has_return(l) ? 1 : 0);
        for_each_chunk(run, part.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t l = begin; l < end; ++l)
                radius_[l] = static_cast<Index>(radius_of(l, least, most, precision));
        });
        part.for_each_row(run, [&](std::size_t first) {
            reach(first, 1, part.width, most, left_, right_, way::left);
        });
        part.for_each_column(run, [&](std::size_t first) {
            reach(first, part.width, part.height, most, up_, down_, way::up);
        });
    }

    [[nodiscard]] const image_links<Number, Index>& links() const { return links_; }

    /// The number of pixels from begin to end that have a return.
    [[nodiscard]] std::size_t returns(std::size_t begin, std::size_t end) const {
        return before_[end] - before_[begin];
    }

    /// The pixels of the column of a window: begin, begin + step, ..., last.
    struct column {
        std::size_t begin, last, step, radius;
    };
    /// That of the window of pixel l.
    [[nodiscard]] column column_of(std::size_t l) const {
        const std::size_t r = radius_[l], width = links_.part().width;
        return {l - std::min<std::size_t>(r, up_[l]) * width,
                l + std::min<std::size_t>(r, down_[l]) * width, width, r};
    }

    /// The pixels of a row of a window: from begin, before end.
    struct row {
        std::size_t begin, end;
    };
    /// That through pixel q of the column of a window of this radius. Precondition: q has a return.
    [[nodiscard]] row row_of(std::size_t q, std::size_t radius) const {
        return {q - std::min<std::size_t>(radius, left_[q]),
                q + std::min<std::size_t>(radius, right_[q]) + 1};
    }

    /// Calls each(begin, end) for the rows of the window of l, which has a return.
    void for_each_row(std::size_t l, auto&& each) const {
        const column c = column_of(l);
        for (std::size_t q = c.begin; q <= c.last; q += c.step) {
            if (!links_.has_return(q)) continue;
            const row r = row_of(q, c.radius);
            each(r.begin, r.end);
        }
    }

    /// The neighbors of pixel l, which has a return. Refers to the windows.
    [[nodiscard]] auto neighbors_of(std::size_t l) const {
        return window_neighbors<image_windows>(*this, l);
    }

  private:
    [[nodiscard]] std::size_t radius_of(std::size_t l, std::size_t least, std::size_t most,
                                        double precision) const {
        std::size_t radius = least;
        if (!links_.has_return(l) || least >= most) return radius;
        const double turn = precision * links_.spacing(l) * length(links_.ray(l));
        const double needed = links_.variance(l) / (turn * turn);
        const auto gained = [](double r) {
            return (2.0 * r + 1.0) * (2.0 * r + 1.0) * r * (r + 1.0) / 3.0;
        };
        while (radius < most && gained(static_cast<double>(radius)) < needed) ++radius;
        return radius;
    }

    /// How far pixels first, first + step, ... reach over links [pixels], at most `most`, back to
    /// the first and forward to the last one.
    void reach(std::size_t first, std::size_t step, std::size_t count, std::size_t most,
               scratch<Index>& back, scratch<Index>& forward, way to_first) const {
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t l = first + k * step, gap = links_.gap(l, to_first);
            back[l] = forward[l] = Index{};
            if (gap > 0) back[l] = static_cast<Index>(std::min(most, back[l - gap * step] + gap));
        }
        for (std::size_t k = count; k-- > 0;) {
            const std::size_t l = first + k * step, gap = links_.gap(l, to_first);
            if (gap > 0)
                forward[l - gap * step] = static_cast<Index>(std::min(most, forward[l] + gap));
        }
    }

    image_links<Number, Index> links_;
    scratch<Index> left_, right_, up_, down_;  // reach over links, at most the largest radius
    scratch<Index> radius_;
    scratch<Index> before_;  // the number of returns before each pixel
};

}  // namespace GNOMON_LANES
}  // namespace gnomon::detail
