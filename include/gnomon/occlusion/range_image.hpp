// SPDX-License-Identifier: BSL-1.0
/// @file
/// The omnidirectional range image: what one view point sees in every direction, by azimuth and
/// elevation. Unlike the image of a camera it holds any field of view, panoramas too.
///
/// Klasing 2010, Sec. 2.4.2, Eq. (2.1). There the poles, where pixels are dense, are up and down;
/// here the image can be rotated, by default such that the poles are where few points are.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/pack.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/occlusion/detail/image_axes.hpp>

namespace gnomon {

/// How large the image is and how it is turned.
struct range_image_options {
    /// Pixels from azimuth -pi to pi; by default as wide as the beams of the thesis are apart, 0.25
    /// degrees (Sec. 4.4.2).
    std::size_t width = 1440;
    std::size_t height = 720;  ///< pixels from elevation -pi/2 to pi/2: half the width (formula)
    /// Where elevation is pi/2, of any length; by default a direction in which least is seen. With
    /// the z-axis the image is that of Eq. (2.1).
    std::optional<Eigen::Vector3d> pole = std::nullopt;
};

/// The nearest return of each pixel.
class range_image {
  public:
    /// Column `azimuth` and row `elevation`.
    using pixel = detail::image_cell;
    /// The range of a pixel in which nothing was seen, as in the thesis.
    static constexpr double nothing = -1.0;

    /// The image of all points at a finite distance from the view point [m], except points at the
    /// view point itself. It stores the rows in which something is seen, or, for few points in many
    /// pixels, single pixels. O(n log n).
    /// @throws std::invalid_argument  without a pixel, for more than 2^31 in a row or column, for
    ///                                a view point or a pole that is not finite, or for a pole of
    ///                                no length
    template <class R, class Proj = std::identity>
        requires point_range<R, Proj>
    range_image(const R& points, const Eigen::Vector3d& viewpoint,
                const range_image_options& format = {}, Proj projection = {})
        : range_image(viewpoint, format) {
        const position_view<R, Proj> p(points, std::move(projection));
        show(p, p.size(), std::identity(), format.pole);
    }

    /// The image of some points of a cloud: what it shows has its index in the whole of it.
    /// @throws std::invalid_argument  as above, or for an index out of range
    template <class R, class Proj = std::identity>
        requires point_range<R, Proj>
    range_image(const R& points, std::span<const point_index> some,
                const Eigen::Vector3d& viewpoint, const range_image_options& format = {},
                Proj projection = {})
        : range_image(viewpoint, format) {
        const position_view<R, Proj> p(points, std::move(projection));
        for (const point_index i : some)
            detail::require(i < p.size(), "range_image: an index is out of range");
        show(
            p, some.size(), [some](std::size_t s) { return some[s]; }, format.pole);
    }

    [[nodiscard]] std::size_t width() const { return width_; }                     ///< in pixels
    [[nodiscard]] std::size_t height() const { return height_; }                   ///< in pixels
    [[nodiscard]] const Eigen::Vector3d& viewpoint() const { return viewpoint_; }  ///< [m]

    /// Where a point is seen; (0, 0) in the view point. Azimuth pi is -pi, the pole in the last
    /// row. Precondition: its squared distance is finite. (A template: only its users compile it.)
    template <class Point = Eigen::Vector3d>
    [[nodiscard]] pixel pixel_of(const Point& p) const {
        return pixels_of(std::array<Eigen::Vector3d, 1>{p})[0];
    }

    /// Where N points are seen, as by pixel_of(), in less time. Precondition as above.
    template <std::size_t N>
    [[nodiscard]] std::array<pixel, N> pixels_of(const std::array<Eigen::Vector3d, N>& p) const {
        constexpr std::size_t width = detail::slim_pack::size;
        std::array<pixel, N> at;
        std::array<Eigen::Vector3d, width> to;
        for (std::size_t k = 0; k < N; k += width) {
            for (std::size_t l = 0; l < width; ++l)
                to[l] = detail::difference(p[std::min(k + l, N - 1)], viewpoint_);
            std::copy_n(axes_.cells_towards(to, width_, height_).begin(), std::min(width, N - k),
                        at.begin() + k);
        }
        return at;
    }

    /// The unit vector from the view point through the middle of a pixel. (A template, as above.)
    template <class Pixel = pixel>
    [[nodiscard]] Eigen::Vector3d direction_of(const Pixel& at) const {
        const auto turn = [](std::size_t i, std::size_t n) {  // from -1 to 1
            return (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(n) - 1.0;
        };
        const double azimuth = std::numbers::pi * turn(at.azimuth, width_);
        const double elevation = std::numbers::pi / 2.0 * turn(at.elevation, height_);
        const double flat = std::cos(elevation);
        return detail::combined(flat * std::cos(azimuth), axes_.x, flat * std::sin(azimuth),
                                axes_.y, std::sin(elevation), axes_.z);
    }

    /// The distance of the nearest point in a pixel [m], or `nothing`.
    [[nodiscard]] double range(const pixel& at) const { return view_of(at).range; }

    /// That point, or nothing.
    [[nodiscard]] std::optional<point_index> index(const pixel& at) const {
        const view v = view_of(at);
        return v.range < 0.0 ? std::nullopt : std::optional(v.index);
    }

    /// The distance of a point from the view point [m].
    [[nodiscard]] double distance_to(const Eigen::Vector3d& p) const {
        return detail::length(detail::difference(p, viewpoint_));
    }

    /// False only if the pixel of a place and its neighbors up to two pixels away are empty. O(1).
    [[nodiscard]] bool may_show(const Eigen::Vector3d& p) const {
        const Eigen::Vector3d d = detail::difference(p, viewpoint_);
        const double up = detail::dot(axes_.z, d), distance = detail::length(d);
        return up >= lowest_sine_ * distance && up <= highest_sine_ * distance;
    }

  private:
    struct view {
        double range = nothing;
        point_index index = 0;
    };

    /// A point that is seen, and the place of its pixel, row by row.
    struct sight {
        view what;
        std::uint64_t place;
    };

    range_image(const Eigen::Vector3d& viewpoint, const range_image_options& format)
        : width_(format.width), height_(format.height), viewpoint_(viewpoint) {
        constexpr std::size_t most = std::size_t{1} << 31;  // overflow of their numbers
        detail::require(0 < width_ && width_ <= most && 0 < height_ && height_ <= most,
                        "range_image: needs a pixel, and at most 2^31 in a row or column");
        detail::require(is_finite(viewpoint), "range_image: the view point must be finite");
    }

    /// Stores the nearest of `count` points in each pixel. (A template, as what it calls, so that
    /// only code that makes images compiles it.)
    void show(const auto& points, std::size_t count, const auto& index_of, const auto& pole) {
        detail::scratch<sight> visible;
        visible.reserve(count);
        const auto offset_of = [&](const sight& s) {
            return detail::difference(points[s.what.index], viewpoint_);
        };
        for (std::size_t k = 0; k < count; ++k) {
            const auto i = static_cast<point_index>(index_of(k));
            const Eigen::Vector3d d = detail::difference(points[i], viewpoint_);
            if (detail::has_length(d)) visible.push_back({{detail::length(d), i}, 0});
        }
        axes_ = detail::image_axes::with_pole(
            pole ? *pole : detail::least_observed_axis(visible, offset_of));
        std::size_t lowest = height_, highest = 0;
        std::array<Eigen::Vector3d, detail::pack::size> to;
        for (std::size_t k = 0; k < visible.size(); k += to.size()) {
            const std::size_t next = std::min(to.size(), visible.size() - k);
            for (std::size_t l = 0; l < to.size(); ++l)
                to[l] = offset_of(visible[k + std::min(l, next - 1)]);
            const auto at = axes_.cells_towards(to, width_, height_);
            for (std::size_t l = 0; l < next; ++l) {
                visible[k + l].place = place_of(at[l]);
                lowest = std::min(lowest, at[l].elevation);
                highest = std::max(highest, at[l].elevation);
            }
        }
        if (!visible.empty()) keep(visible, lowest, highest);
        const auto sine_of_row = [this](double row) {
            const double turn = std::clamp(row / static_cast<double>(height_), 0.0, 1.0) - 0.5;
            return std::sin(turn * std::numbers::pi);
        };
        constexpr double about = 2.0 + 1e-3;  // rows, and a margin for rounding
        lowest_sine_ = sine_of_row(static_cast<double>(lowest) - about);
        highest_sine_ = sine_of_row(static_cast<double>(highest) + 1.0 + about);
    }

    /// Stores the nearest point of each pixel, between two rows.
    void keep(auto& visible, std::size_t lowest, std::size_t highest) {
        constexpr std::size_t few = 32;  // pixels per point (performance only)
        const std::uint64_t pixels = std::uint64_t{highest - lowest + 1} * width_;
        if (pixels / few <= visible.size()) {
            first_ = std::uint64_t{lowest} * width_;
            seen_.resize(static_cast<std::size_t>(pixels));
            for (const sight& s : visible) {
                view& v = seen_[static_cast<std::size_t>(s.place - first_)];
                if (v.range < 0.0 || s.what.range < v.range) v = s.what;
            }
            return;
        }
        std::sort(visible.begin(), visible.end(), [](const sight& a, const sight& b) {
            const auto key = [](const sight& s) {
                return std::tuple(s.place, s.what.range, s.what.index);
            };
            return key(a) < key(b);
        });
        for (const sight& s : visible) {
            if (!places_.empty() && places_.back() == s.place) continue;
            places_.push_back(s.place);
            seen_.push_back(s.what);
        }
    }

    [[nodiscard]] std::uint64_t place_of(const pixel& at) const {
        return std::uint64_t{at.elevation} * width_ + at.azimuth;
    }

    [[nodiscard]] view view_of(const pixel& at) const {
        std::uint64_t number = place_of(at) - first_;  // large for what is before the first
        if (!places_.empty()) {
            const auto found = std::lower_bound(places_.begin(), places_.end(), place_of(at));
            if (found == places_.end() || *found != place_of(at)) return {};
            number = static_cast<std::uint64_t>(found - places_.begin());
        }
        return number < seen_.size() ? seen_[static_cast<std::size_t>(number)] : view{};
    }

    std::size_t width_, height_;
    Eigen::Vector3d viewpoint_;
    detail::image_axes axes_;
    double lowest_sine_ = -1.0, highest_sine_ = 1.0;  // of elevations in which something is seen
    detail::scratch<view> seen_;  // of the rows in which something is seen, or of single pixels
    std::uint64_t first_ = 0;     // place of seen_[0] if rows are stored
    detail::scratch<std::uint64_t> places_;  // ascending, of seen_; empty if rows are stored
};

}  // namespace gnomon
