// SPDX-License-Identifier: BSL-1.0
/// @file
/// Finds heights at which many points lie, fits a plane to a floor there, and examines whether it
/// is one, by a grid in plan: which cells hold points of it, and above which of them something
/// stands.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/hash_of.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/symmetric_eigen.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/segmentation/detail/height_histogram.hpp>
#include <gnomon/segmentation/detail/surface_noise.hpp>

namespace gnomon::detail {

/// A plane through points of a floor, and their principal axes.
struct floor_fit {
    gnomon::plane plane;       ///< through the points
    Eigen::Vector3d centroid;  ///< [m]
    eigen_decomposition axes;  ///< of the covariance [m^2]; the last axis is along the normal
    std::size_t count;         ///< of points
    double band;               ///< half the height of the band about the plane [m]
};

/// The search for a floor among the points of a position_view.
template <class Points>
class floor_search {
  public:
    /// @param seen_from  the view points, where they are known
    /// @param widest     half the height of the band about a guess [m]
    /// @param min_width  of a floor, in both directions [m]
    floor_search(const Points& points, const viewpoint_table& seen_from, double widest,
                 double min_width)
        : points_(points), seen_from_(seen_from), widest_(widest), min_width_(min_width) {}

    /// The lowest floor, of those near heights at which as many points lie as a floor has cells.
    [[nodiscard]] std::optional<plane> lowest(const Eigen::Vector3d& up,
                                              const height_histogram& heights) {
        const double fewest = min_width_ * min_width_ / (side * side);
        std::size_t lower = 0;
        for (const auto& [height, count] : heights.bins) {
            if (2 * lower > heights.points) break;  // what is higher is above most points
            lower += count;
            if (static_cast<double>(count) < fewest) continue;
            if (const auto floor = from({up, height})) return floor;
        }
        return std::nullopt;
    }

  private:
    /// The floor that a fit finds from a level guess; nothing if what it finds is no floor.
    [[nodiscard]] std::optional<plane> from(const plane& guess) {
        const auto fit = settled(points_, guess, widest_);
        if (!fit || !is_below_sensor(fit->plane) || !examine(*fit)) return std::nullopt;
        const auto clear = fitted(means_, fit->plane, fit->band);
        if (!clear || !is_wide(*clear)) return std::nullopt;
        const auto floor = settled(means_, clear->plane, fit->band);
        return floor ? std::optional(floor->plane) : std::nullopt;
    }

    /// A cell of the grid: the numbers of points in the band of the plane, and of those above and
    /// below, up to three times as far from the plane.
    struct cell {
        std::uint32_t in_band = 0, above = 0, below = 0;
        Eigen::Vector3d sum{0.0, 0.0, 0.0};  ///< of those in the band, from the centroid [m]
    };

    // The share of the points of a floor that may be below it, and of the points of a clear cell
    // that may be above; chosen. In real scans of floors up to 3.4 % are below.
    static constexpr double few = 0.04;
    static constexpr double bands = 3.0;  // from the plane, within which cells extend; chosen
    static constexpr double side = 0.25;  // of a cell [m]; chosen, smaller than furniture

    /// The plane through the points in a band about itself; nothing if it turns away from the
    /// guess.
    [[nodiscard]] std::optional<floor_fit> settled(const auto& points, const plane& guess,
                                                   double band) {
        constexpr int most_refits = 50;     // performance only: a handful is enough
        constexpr double converged = 1e-6;  // [m], and of unit vectors; numerical
        constexpr double narrowest = certain_deviations * flatness;  // [m]: no floor is flatter
        std::optional<floor_fit> fit;
        plane floor = guess;
        for (int refit = 0; refit < most_refits; ++refit) {
            fit = fitted(points, floor, band);
            if (!fit || is_steep(fit->plane, guess)) return std::nullopt;
            // Narrow the band to three robust standard deviations of the points of the floor
            // (1.4826 times the median for a normal distribution).
            const auto median = distances_.begin() + std::ssize(distances_) / 2;
            std::nth_element(distances_.begin(), median, distances_.end());
            fit->band = std::clamp(most_deviations * 1.4826 * *median, std::min(narrowest, widest_),
                                   widest_);
            const bool rests = length(difference(fit->plane.normal, floor.normal)) < converged &&
                               std::abs(floor.signed_distance(fit->centroid)) < converged &&
                               std::abs(fit->band - band) < converged;
            if (rests) break;
            floor = fit->plane;
            band = fit->band;
        }
        return fit;
    }

    /// The plane through the points in a band about another one, on the same side, and their
    /// distances from that; nothing where they do not determine a plane.
    [[nodiscard]] std::optional<floor_fit> fitted(const auto& points, const plane& about,
                                                  double band) {
        // Moments about a point of the band, so that nothing is lost far from the origin.
        Eigen::Vector3d origin(0.0, 0.0, 0.0);
        moments m;
        distances_.clear();
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Eigen::Vector3d p = points[i];
            const double d = std::abs(about.signed_distance(p));
            if (!(d <= band) || !is_finite(p)) continue;
            if (m.count == 0) origin = p;
            m.add(difference(p, origin));
            distances_.push_back(d);
        }
        if (m.count < 3) return std::nullopt;
        floor_fit fit{about, combined(1.0, origin, 1.0 / static_cast<double>(m.count), m.sum),
                      symmetric_eigen(m.covariance_of_neighbors()), m.count, band};
        constexpr double least_ratio = 1e-12;  // numerical: of variances, for points on a line
        if (!(fit.axes.values[1] > least_ratio * fit.axes.values[0])) return std::nullopt;
        const Eigen::Vector3d normal = column(fit.axes.vectors, 2);
        fit.plane.normal = scaled(dot(normal, about.normal) < 0.0 ? -1.0 : 1.0, normal);
        fit.plane.offset = dot(fit.plane.normal, fit.centroid);
        return fit;
    }

    /// Whether the level band about a guess does not contain a plane over the least width of a
    /// floor, as that of a wall that a fit turned to.
    [[nodiscard]] bool is_steep(const plane& found, const plane& guess) const {
        const double steepest = 2.0 * widest_ / min_width_;
        const double cosine = dot(found.normal, guess.normal);
        return cosine * cosine * (1.0 + steepest * steepest) < 1.0;
    }

    /// Whether at most half of the view points, where they are known, are under the plane.
    [[nodiscard]] bool is_below_sensor(const plane& floor) const {
        const auto is_under = [&](const auto& v) { return floor.signed_distance(v) < 0.0; };
        const auto& positions = seen_from_.positions();
        return 2 * std::ranges::count_if(positions, is_under) <= std::ssize(positions);
    }

    /// Lists the means of the points of clear cells, which count alike although most points are
    /// near the sensor. Whether hardly a point is below the plane.
    [[nodiscard]] bool examine(const floor_fit& fit) {
        double in_band = 0.0, below = 0.0;
        cells_.assign(std::bit_ceil(fit.count), {});
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const Eigen::Vector3d p = points_[i];
            const double d = fit.plane.signed_distance(p);
            if (!is_finite(p) || d > bands * fit.band) continue;
            if (d < -bands * fit.band) {
                below += 1.0;
                continue;
            }
            const Eigen::Vector3d from_centroid = difference(p, fit.centroid);
            cell& c = cells_[cell_of(fit, from_centroid)];
            if (std::abs(d) > fit.band) {
                ++(d > 0.0 ? c.above : c.below);
            } else {
                ++c.in_band;
                in_band += 1.0;
                c.sum = combined(1.0, c.sum, 1.0, from_centroid);
            }
        }
        means_.clear();
        // Noise is as often above as below: if more are above, something stands there.
        for (const cell& c : cells_)
            if (c.in_band > 0 && c.above <= c.below + few * c.in_band)
                means_.push_back(combined(1.0, fit.centroid, 1.0 / c.in_band, c.sum));
        return below <= few * in_band;
    }

    /// Whether cells are wide in both directions, as a rectangle with the same second moments, and
    /// cover the area of a square as wide: the feet of a table do not.
    [[nodiscard]] bool is_wide(const floor_fit& cells) const {
        const double area = side * side * static_cast<double>(cells.count);
        return std::min(area, 12.0 * cells.axes.values[1]) >= min_width_ * min_width_;
    }

    /// The number of the cell of a point: cells lie along the principal axes, so that they move
    /// with the points. A few share their number with another one.
    [[nodiscard]] std::size_t cell_of(const floor_fit& fit,
                                      const Eigen::Vector3d& from_centroid) const {
        const auto number_along = [&](int axis) {
            constexpr double exact = 1e15;  // numerical: whole numbers are; outliers share cells
            const double sides = dot(column(fit.axes.vectors, axis), from_centroid) / side;
            return static_cast<std::int64_t>(std::floor(std::clamp(sides, -exact, exact)));
        };
        const std::uint64_t hash = hash_of(std::array{number_along(0), number_along(1)});
        return static_cast<std::size_t>(hash) & (cells_.size() - 1);
    }

    const Points& points_;
    const viewpoint_table& seen_from_;
    double widest_, min_width_;  // [m]
    scratch<double> distances_;
    scratch<cell> cells_;
    scratch<Eigen::Vector3d> means_;
};

}  // namespace gnomon::detail
