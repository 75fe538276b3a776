// SPDX-License-Identifier: BSL-1.0
/// @file
/// Which pixels of an organized image lie on one surface, as far as their ranges show.
///
/// Two pixels that follow each other in a row or a column, but for pixels without a return, are
/// linked unless there is a jump in range between them: more than the noise and the steepest
/// surface that is still seen explain. That is a surface under 80 degrees of incidence, so that the
/// step along the ray is at most tan(80 degrees) times the step across it; and three standard
/// deviations of the difference of two ranges, its 99.7 % quantile.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/viewpoints.hpp>

namespace gnomon::detail {

/// Some rows and columns of an image whose pixels are the points of a range, row by row.
struct pixel_rectangle {
    std::size_t image_width;  // [pixels]
    std::size_t first;        // the index of its first point
    std::size_t width, height;

    [[nodiscard]] std::size_t size() const { return width * height; }
    /// The index of the point of pixel l of the rectangle.
    [[nodiscard]] std::size_t index_of(std::size_t l) const {
        return width == image_width ? first + l : first + l / width * image_width + l % width;
    }

    /// Calls each(l) for the first pixel of each row; rows of about `chunk_size` pixels at a time.
    void for_each_row(const auto& run, auto&& each) const {
        for_each_line(run, height, 1 + chunk_size / std::max<std::size_t>(width, 1),
                      [&](std::size_t y) { each(y * width); });
    }
    /// The same for each column.
    void for_each_column(const auto& run, auto&& each) const {
        constexpr std::size_t at_a_time = 16;  // performance only: two cache lines
        for_each_line(run, width, at_a_time, each);
    }

  private:
    static void for_each_line(const auto& run, std::size_t lines, std::size_t at_a_time,
                              auto&& each) {
        run((lines + at_a_time - 1) / at_a_time, [&](std::size_t c) {
            const std::size_t end = std::min(lines, (c + 1) * at_a_time);
            for (std::size_t line = c * at_a_time; line < end; ++line) each(line);
        });
    }
};

/// The ways from a pixel along its row and its column.
enum class way : unsigned { left, right, up, down };

/// The pixels of a rectangle and their links. (A template, so that only its users compile it.)
template <class Number = double, class Index = point_index>
class image_links {
  public:
    /// @param points      points[i] is the position of point i of the image [m]
    /// @param viewpoints  from where they were seen, the origin if unknown
    /// @param most_gap    no link is longer [pixels]
    template <execution X>
    image_links(const auto& points, const viewpoint_table& viewpoints, const noise_curve& noise,
                const pixel_rectangle& part, std::size_t most_gap, const X& run)
        : part_(part), viewpoints_(viewpoints), most_gap_(most_gap) {
        for (scratch<Number>* const each : {&x_, &y_, &z_, &variance_, &spacing_})
            each->resize(part.size() + padding);
        for (scratch<Index>& each : gaps_) each.resize(part.size());
        for_each_chunk(run, part.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t l = begin; l < end; ++l) read(l, points[part.index_of(l)], noise);
        });
        part.for_each_row(
            run, [&](std::size_t first) { link(first, 1, part.width, way::left, way::right); });
        part.for_each_column(run, [&](std::size_t first) {
            link(first, part.width, part.height, way::up, way::down);
        });
    }

    /// By which the arrays of coordinates are longer, so that whole vectors can be read.
    static constexpr std::size_t padding = 3;

    [[nodiscard]] const pixel_rectangle& part() const { return part_; }
    [[nodiscard]] bool has_return(std::size_t l) const { return !std::isnan(x_[l]); }
    /// The coordinates of all pixels along an axis [m]; NaN where there is no return.
    [[nodiscard]] const Number* at(std::size_t axis) const {
        return axis == 0 ? x_.data() : axis == 1 ? y_.data() : z_.data();
    }
    [[nodiscard]] Eigen::Vector3d operator[](std::size_t l) const { return {x_[l], y_[l], z_[l]}; }
    /// From the view point of a pixel to its position [m].
    [[nodiscard]] Eigen::Vector3d ray(std::size_t l) const {
        return difference((*this)[l], viewpoints_[part_.index_of(l)]);
    }
    /// The variance of the noise along the ray [m^2].
    [[nodiscard]] double variance(std::size_t l) const { return variance_[l]; }
    /// Twice the sine of half of the angle between the rays of neighboring pixels, the smaller one
    /// of rows and columns; infinite if there are none.
    [[nodiscard]] double spacing(std::size_t l) const { return spacing_[l]; }
    /// How far the next pixel on a way from l is [pixels] if l is linked with it, else 0.
    [[nodiscard]] std::size_t gap(std::size_t l, way to) const { return gaps(to)[l]; }
    /// That pixel; l itself if there is none.
    [[nodiscard]] std::size_t next(std::size_t l, way to) const {
        const std::size_t step = to < way::up ? gap(l, to) : gap(l, to) * part_.width;
        return to == way::left || to == way::up ? l - step : l + step;
    }

  private:
    [[nodiscard]] const scratch<Index>& gaps(way to) const {
        return gaps_[static_cast<unsigned>(to)];
    }

    void read(std::size_t l, const Eigen::Vector3d& p, const noise_curve& noise) {
        constexpr Number nan = std::numeric_limits<Number>::quiet_NaN();
        const bool is_there = is_finite(p);
        x_[l] = is_there ? p[0] : nan;
        y_[l] = is_there ? p[1] : nan;
        z_[l] = is_there ? p[2] : nan;
        variance_[l] = is_there ? noise.variance_along(ray(l)) : Number{};
        spacing_[l] = std::numeric_limits<Number>::infinity();
        for (scratch<Index>& each : gaps_) each[l] = Index{};
    }

    /// Links the pixels first, first + step, ...
    void link(std::size_t first, std::size_t step, std::size_t count, way back, way forward) {
        std::size_t last = count;  // the last one with a return; none
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t l = first + k * step;
            if (!has_return(l)) continue;
            if (last < k && k - last <= most_gap_) {
                const std::size_t before = first + last * step;
                const auto gap = static_cast<Index>(link(before, l, k - last));
                gaps_[static_cast<unsigned>(back)][l] = gap;
                gaps_[static_cast<unsigned>(forward)][before] = gap;
            }
            last = k;
        }
    }

    /// The gap between two pixels [pixels] if they are linked, else 0. Notes their spacing.
    [[nodiscard]] std::size_t link(std::size_t a, std::size_t b, std::size_t gap) {
        constexpr double steepest = 5.67;   // tan(80 degrees)
        constexpr double deviations = 3.0;  // the 99.7 % quantile
        const Eigen::Vector3d to_a = ray(a), to_b = ray(b);
        if (!has_length(to_a) || !has_length(to_b)) return 0;  // at its view point: no return
        const double range_a = length(to_a), range_b = length(to_b);
        // Between both rays, so that mirrored images have the same links.
        const Eigen::Vector3d middle = combined(1.0 / range_a, to_a, 1.0 / range_b, to_b);
        const Eigen::Vector3d d = difference((*this)[b], (*this)[a]);
        const double along = std::abs(dot(d, middle)) / length(middle);
        const double across = std::sqrt(std::max(0.0, dot(d, d) - along * along));
        const Number sine = 2.0 * across / (static_cast<double>(gap) * (range_a + range_b));
        if (sine > Number{}) {
            spacing_[a] = std::min(spacing_[a], sine);
            spacing_[b] = std::min(spacing_[b], sine);
        }
        const double noise = deviations * std::sqrt(variance_[a] + variance_[b]);
        return along <= steepest * across + noise ? gap : 0;
    }

    pixel_rectangle part_;
    const viewpoint_table& viewpoints_;
    std::size_t most_gap_;
    scratch<Number> x_, y_, z_, variance_, spacing_;
    std::array<scratch<Index>, 4> gaps_;  // by way
};

}  // namespace gnomon::detail
