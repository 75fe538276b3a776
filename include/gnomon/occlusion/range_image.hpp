// SPDX-License-Identifier: BSL-1.0
/// @file
/// The omnidirectional range image: what one view point sees in every direction, by azimuth and
/// elevation. Unlike the image of a camera it holds any field of view, panoramas too.
///
/// Klasing 2010, Sec. 2.4.2, Eq. (2.1). There the poles, about which pixels crowd, are up and down;
/// here the image can be turned, by default such that they lie where least is seen.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <numbers>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/atan2pi.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/pack.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/symmetric_eigen.hpp>

namespace gnomon {

/// How large the image is and how it is turned.
struct range_image_format {
    std::size_t width = 720;   ///< pixels from azimuth -pi to pi
    std::size_t height = 360;  ///< pixels from elevation -pi/2 to pi/2
    /// Where elevation is pi/2, of any length; by default a direction in which least is seen. With
    /// the z-axis the image is that of Eq. (2.1).
    std::optional<Eigen::Vector3d> pole = std::nullopt;
};

/// The nearest return of each pixel.
class range_image {
  public:
    struct pixel {
        std::size_t azimuth, elevation;

        friend bool operator==(const pixel&, const pixel&) = default;
    };
    /// The range of a pixel in which nothing was seen, as in the thesis.
    static constexpr double nothing = -1.0;

    /// The image of all points at a finite distance from the view point [m], but of those in it. It
    /// keeps the rows in which something is seen, or, of few points in many pixels, these alone.
    /// O(n log n).
    /// @throws std::invalid_argument  without a pixel, for more than 2^31 in a row or column, or
    /// for
    ///                                a view point or a pole that is not finite, or a pole of no
    ///                                length
    template <class R, class Proj = std::identity>
        requires point_range<R, Proj>
    range_image(const R& points, const Eigen::Vector3d& viewpoint,
                const range_image_format& format = {}, Proj projection = {})
        : range_image(viewpoint, format) {
        const position_view<R, Proj> p(points, std::move(projection));
        std::vector<sight> sights;
        sights.reserve(p.size());
        for (std::size_t i = 0; i < p.size(); ++i) add(sights, p[i], i);
        show(sights, format);
    }

    /// The image of some points of a cloud: what it shows has its index in the whole of it.
    /// @throws std::invalid_argument  as above, or for an index of no point
    template <class R, class Proj = std::identity>
        requires point_range<R, Proj>
    range_image(const R& points, std::span<const point_index> some,
                const Eigen::Vector3d& viewpoint, const range_image_format& format = {},
                Proj projection = {})
        : range_image(viewpoint, format) {
        const position_view<R, Proj> p(points, std::move(projection));
        std::vector<sight> sights;
        sights.reserve(some.size());
        for (const point_index i : some) {
            detail::require(i < p.size(), "range_image: an index of no point");
            add(sights, p[i], i);
        }
        show(sights, format);
    }

    [[nodiscard]] std::size_t width() const { return width_; }
    [[nodiscard]] std::size_t height() const { return height_; }
    [[nodiscard]] const Eigen::Vector3d& viewpoint() const { return viewpoint_; }

    /// Where a point is seen; (0, 0) in the view point. Azimuth pi is -pi, and the pole belongs to
    /// the last row. Precondition: its distance, squared, is finite.
    [[nodiscard]] pixel pixel_of(const Eigen::Vector3d& p) const {
        std::array<Eigen::Vector3d, detail::slim_pack::size> to;
        to.fill(detail::difference(p, viewpoint_));
        return pixels_towards(to)[0];
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

    /// False only if nothing was seen in the pixel of a place, nor in any up to two beside it: a
    /// quick look.
    [[nodiscard]] bool may_show(const Eigen::Vector3d& p) const {
        const Eigen::Vector3d d = detail::difference(p, viewpoint_);
        const double up = detail::dot(z_, d), distance = detail::length(d);
        return up >= lowest_sine_ * distance && up <= highest_sine_ * distance;
    }

  private:
    struct view {
        double range = nothing;
        point_index index = 0;
    };

    /// A point that is seen.
    struct sight {
        Eigen::Vector3d offset;  // from the view point [m]
        view what;
        pixel at = {};
    };

    range_image(const Eigen::Vector3d& viewpoint, const range_image_format& format)
        : width_(format.width), height_(format.height), viewpoint_(viewpoint) {
        detail::require(width_ > 0 && height_ > 0, "range_image: needs a pixel");
        constexpr std::size_t most = std::size_t{1} << 31;
        detail::require(width_ <= most && height_ <= most,
                        "range_image: at most 2^31 pixels in a row or column");
        detail::require(is_finite(viewpoint), "range_image: the view point must be finite");
    }

    void add(std::vector<sight>& sights, const Eigen::Vector3d& p, std::size_t i) const {
        const Eigen::Vector3d d = detail::difference(p, viewpoint_);
        if (detail::has_length(d))
            sights.push_back({d, {detail::length(d), static_cast<point_index>(i)}});
    }

    void show(std::vector<sight>& sights, const range_image_format& format) {
        turn(format.pole ? *format.pole : least_seen(sights));
        project(sights);
        // Only rows in which something is seen are kept, for scan lines a single one.
        std::size_t lowest = height_, highest = 0;
        for (const sight& s : sights) {
            lowest = std::min(lowest, s.at.elevation);
            highest = std::max(highest, s.at.elevation);
        }
        first_row_ = lowest;
        const auto sine_of_row = [this](double row) {
            const double turn = std::clamp(row / static_cast<double>(height_), 0.0, 1.0) - 0.5;
            return std::sin(turn * std::numbers::pi);
        };
        constexpr double about = 2.0 + 1e-3;  // rows, and what rounding may make of that
        lowest_sine_ = sine_of_row(static_cast<double>(lowest) - about);
        highest_sine_ = sine_of_row(static_cast<double>(highest) + 1.0 + about);
        keep(sights, lowest <= highest ? (highest - lowest + 1) * width_ : 0);
    }

    [[nodiscard]] view view_of(const pixel& at) const {
        if (at.elevation < first_row_) return {};
        std::size_t place = place_of(at);
        if (is_sparse_) {
            const auto found = std::lower_bound(taken_.begin(), taken_.end(), place);
            if (found == taken_.end() || *found != place) return {};
            place = static_cast<std::size_t>(found - taken_.begin());
        }
        return place < seen_.size() ? seen_[place] : view{};
    }

    /// Stores the nearest sight of each pixel, of so many.
    void keep(std::vector<sight>& sights, std::size_t pixels) {
        constexpr std::size_t few = 32;  // pixels for each sight take no more than looking it up
        is_sparse_ = pixels / few > sights.size();
        if (is_sparse_) {
            const auto key = [this](const sight& s) {
                return std::tuple(place_of(s.at), s.what.range, s.what.index);
            };
            std::sort(sights.begin(), sights.end(),
                      [&](const sight& a, const sight& b) { return key(a) < key(b); });
            for (const sight& s : sights) {
                if (!taken_.empty() && taken_.back() == place_of(s.at)) continue;
                taken_.push_back(place_of(s.at));
                seen_.push_back(s.what);
            }
            return;
        }
        seen_.resize(pixels);
        for (const sight& s : sights) {
            view& v = seen_[place_of(s.at)];
            if (v.range < 0.0 || s.what.range < v.range) v = s.what;
        }
    }

    [[nodiscard]] std::size_t place_of(const pixel& at) const {
        return (at.elevation - first_row_) * width_ + at.azimuth;
    }

    /// Where what lies at N offsets from the view point [m] is seen, side by side.
    template <std::size_t N>
    [[nodiscard]] std::array<pixel, N> pixels_towards(
        const std::array<Eigen::Vector3d, N>& to) const {
        using pack = detail::pack_of<N>;
        const auto along = [&to](const Eigen::Vector3d& axis) {
            std::array<double, N> a;
            for (std::size_t l = 0; l < N; ++l) a[l] = detail::dot(axis, to[l]);
            return pack(a.data());
        };
        const pack x = along(x_), y = along(y_), z = along(z_);
        const pack azimuth = 0.5 * detail::atan2pi(y, x) + 0.5;
        const pack elevation = detail::atan2pi(z, root(x * x + y * y)) + 0.5;
        std::array<pixel, N> at;
        for (std::size_t l = 0; l < N; ++l) {
            at[l] = {static_cast<std::size_t>(azimuth[l] * static_cast<double>(width_)) % width_,
                     std::min(static_cast<std::size_t>(elevation[l] * static_cast<double>(height_)),
                              height_ - 1)};
        }
        return at;
    }

    /// Says of each in which pixel it is.
    void project(std::vector<sight>& sights) const {
        std::array<Eigen::Vector3d, detail::pack::size> to;
        for (std::size_t s = 0; s < sights.size(); s += to.size()) {
            const std::size_t count = std::min(to.size(), sights.size() - s);
            for (std::size_t l = 0; l < to.size(); ++l)
                to[l] = sights[s + std::min(l, count - 1)].offset;
            const auto at = pixels_towards(to);
            for (std::size_t l = 0; l < count; ++l) sights[s + l].at = at[l];
        }
    }

    /// The axis along which the directions to the points spread least; z where there are none.
    [[nodiscard]] static Eigen::Vector3d least_seen(const std::vector<sight>& sights) {
        Eigen::Matrix3d sum = detail::diagonal(0.0, 0.0, 0.0);
        for (const sight& s : sights) {
            const Eigen::Vector3d& d = s.offset;
            const double weight = 1.0 / detail::dot(d, d);
            for (int r = 0; r < 3; ++r)
                for (int c = r; c < 3; ++c) sum(r, c) += weight * d[r] * d[c];
        }
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < r; ++c) sum(r, c) = sum(c, r);
        // Where z is as good as any, it is z.
        sum(2, 2) *= 1.0 - 1e-9;
        return detail::column(symmetric_eigen(sum).vectors, 2);
    }

    void turn(const Eigen::Vector3d& pole) {
        const bool has_direction = pole[0] != 0.0 || pole[1] != 0.0 || pole[2] != 0.0;
        detail::require(detail::all_finite(pole) && has_direction,
                        "range_image: the pole must be a finite direction");
        z_ = detail::direction_of(pole);
        // Azimuth counts from the x-axis; where that is the pole, from the y-axis.
        const Eigen::Vector3d start =
            std::abs(z_[0]) < 0.9 ? Eigen::Vector3d(1, 0, 0) : Eigen::Vector3d(0, 1, 0);
        y_ = detail::cross(z_, start);
        const double across = std::sqrt(detail::dot(y_, y_));
        y_ = Eigen::Vector3d(y_[0] / across, y_[1] / across, y_[2] / across);
        x_ = detail::cross(y_, z_);
    }

    std::size_t width_, height_;
    Eigen::Vector3d viewpoint_;
    Eigen::Vector3d x_, y_, z_;  // axes of the image; z is the pole
    std::size_t first_row_ = 0;
    double lowest_sine_ = -1.0, highest_sine_ = 1.0;  // of elevations in the rows kept, and about
    std::vector<view> seen_;  // row by row, from the first in which something is seen
    bool is_sparse_ = false;  // only pixels in which something is seen, whose places are
    std::vector<std::size_t> taken_;
};

}  // namespace gnomon
