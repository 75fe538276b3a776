// SPDX-License-Identifier: BSL-1.0
/// @file
/// The different places of points in a plane, in an order in which points that are near in the
/// plane are near in memory.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <gnomon/neighborhoods/detail/delaunay_star.hpp>

namespace gnomon::detail {

/// The extent of points along the axes.
struct planar_box {
    planar_point low, high;

    /// Of at least one point.
    template <class Iterator>
    planar_box(Iterator begin, Iterator end) : low(*begin), high(*begin) {
        for (; begin != end; ++begin) {
            low = {std::min(low.x, begin->x), std::min(low.y, begin->y), 0};
            high = {std::max(high.x, begin->x), std::max(high.y, begin->y), 0};
        }
    }

    [[nodiscard]] double width() const { return high.x - low.x; }
    [[nodiscard]] double height() const { return high.y - low.y; }
    /// Whether it is at least as high as wide.
    [[nodiscard]] bool is_upright() const { return width() <= height(); }
};

[[nodiscard]] inline std::size_t middle_of(std::size_t begin, std::size_t end) {
    return begin + (end - begin) / 2;
}

/// Calls visit(begin, end) for parts of a range, which is halved as long as both halves have
/// `least` elements.
template <class Visit>
void visit_cells(std::size_t begin, std::size_t end, std::size_t least, const Visit& visit) {
    const std::size_t middle = middle_of(begin, end);
    if (middle - begin < least) return visit(begin, end);
    visit_cells(begin, middle, least, visit);
    visit_cells(middle, end, least, visit);
}

/// Sorts points in place by the Morton code of a grid of 2^16 by 2^16 cells, then by x, y and
/// index. It is a radix sort from the highest digit on (American flag sort, McIlroy, Bostic and
/// McIlroy 1993).
class sort_in_cells {
  public:
    /// O(n) unless many points are in few cells, O(n log n) at most.
    explicit sort_in_cells(std::vector<planar_point>& points) : points_(points) {
        if (points_.empty()) return;
        const planar_box box(points_.begin(), points_.end());
        low_ = box.low;
        const double extent = std::max(box.width(), box.height());
        if (extent > 0.0) scale_ = 65535.5 / extent;
        sort(0, points_.size(), 32 - digit);
    }

  private:
    static constexpr int digit = 8;  // [bits], performance only
    static constexpr std::size_t digits = std::size_t{1} << digit;

    /// The 16 bits of the integer below, at every second place.
    [[nodiscard]] std::uint32_t every_second(double along) const {
        auto bits = static_cast<std::uint32_t>(scale_ * along);
        bits = (bits | bits << 8) & 0x00ff00ffu;
        bits = (bits | bits << 4) & 0x0f0f0f0fu;
        bits = (bits | bits << 2) & 0x33333333u;
        return (bits | bits << 1) & 0x55555555u;
    }
    [[nodiscard]] std::uint32_t cell(const planar_point& p) const {
        return every_second(p.x - low_.x) | every_second(p.y - low_.y) << 1;
    }

    /// @param shift  of the next digit of the codes, which are equal above
    void sort(std::size_t begin, std::size_t end, int shift) {
        constexpr std::size_t few = 128;  // performance only
        if (end - begin <= few || shift < 0) {
            const auto first = points_.begin();
            std::sort(first + static_cast<std::ptrdiff_t>(begin),
                      first + static_cast<std::ptrdiff_t>(end),
                      [](const planar_point& a, const planar_point& b) {
                          if (a.x != b.x) return a.x < b.x;
                          return a.y != b.y ? a.y < b.y : a.index < b.index;
                      });
            return;
        }
        const auto digit_of = [&](const planar_point& p) { return (cell(p) >> shift) % digits; };
        std::array<std::size_t, digits> next{};  // first the numbers
        std::array<std::size_t, digits> after{};
        for (std::size_t i = begin; i < end; ++i) ++next[digit_of(points_[i])];
        std::size_t sum = begin;
        for (std::size_t d = 0; d < digits; ++d) {
            after[d] = sum + next[d];
            next[d] = std::exchange(sum, after[d]);
        }
        for (std::size_t d = 0; d < digits; ++d) {
            while (next[d] < after[d]) {
                planar_point& p = points_[next[d]];
                std::swap(p, points_[next[digit_of(p)]++]);
            }
        }
        for (const std::size_t cell_end : after) {
            sort(begin, cell_end, shift - digit);
            begin = cell_end;
        }
    }

    std::vector<planar_point>& points_;
    planar_point low_{};
    double scale_ = 0.0;
};

/// Sorts points so; of points at one place the smallest index is kept.
inline void sort_places(std::vector<planar_point>& points) {
    sort_in_cells{points};
    const auto same_place = [](const planar_point& a, const planar_point& b) {
        return a.x == b.x && a.y == b.y;
    };
    points.erase(std::unique(points.begin(), points.end(), same_place), points.end());
}

}  // namespace gnomon::detail
