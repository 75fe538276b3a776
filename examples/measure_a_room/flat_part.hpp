// SPDX-License-Identifier: BSL-1.0
/// @file
/// A plane of a room, such as a wall, from all segments on it, with an uncertainty that allows for
/// errors that neighboring points have in common.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>

#include <gnomon/gnomon.hpp>
#include <gnomon/perception.hpp>

/// A length and its standard deviation [m].
struct measured_length {
    double value = 0.0;
    double sigma = 0.0;
};

/// What a scan and its segmentation say about noise.
struct scan_noise {
    gnomon::noise_curve curve = gnomon::constant_noise{0.0};
    bool is_across_surface = false;

    explicit scan_noise(const auto& seen)
        : curve(seen.noise.curve), is_across_surface(seen.noise.is_across_surface) {}

    /// The standard deviation of a point across a surface [m].
    [[nodiscard]] double across(const Eigen::Vector3d& ray, const Eigen::Vector3d& normal) const {
        const double range = ray.norm();
        const double along = curve.along(ray);
        return is_across_surface || range == 0.0 ? along
                                                 : along * std::abs(normal.dot(ray)) / range;
    }
};

/// Segments on one plane.
struct flat_part {
    std::vector<gnomon::point_index> members;
    gnomon::plane_estimate plane;
    double overdispersion = 1.0;  ///< of the means of patches, already in the covariance
    double area = 0.0;            ///< covered by points [m^2]

    [[nodiscard]] const Eigen::Vector3d& normal() const { return plane.plane.normal; }
    [[nodiscard]] double distance(const Eigen::Vector3d& x) const {
        return plane.plane.signed_distance(x);
    }

    /// The standard deviation of a point across the plane [m], more where the plane is rough.
    [[nodiscard]] double sigma_of(const gnomon::scan& scan, std::size_t i,
                                  const scan_noise& noise) const {
        return std::sqrt(std::max(plane.chi2, 1.0)) *
               noise.across(scan.points[i] - scan.viewpoints[i], normal());
    }

    /// Where the ray of a point crosses the plane; not finite if it does not.
    [[nodiscard]] Eigen::Vector3d crossing_of(const gnomon::scan& scan, std::size_t i) const {
        const Eigen::Vector3d& from = scan.viewpoints[i];
        const Eigen::Vector3d ray = scan.points[i] - from;
        const double share = -distance(from) / normal().dot(ray);
        return share > 0.0 ? Eigen::Vector3d(from + share * ray)
                           : Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    }

    /// The variance of the distance of the plane from a place [m^2]: a turn about one axis moves
    /// the plane along the normal by the offset along the other one.
    [[nodiscard]] double variance_at(const Eigen::Vector3d& x) const {
        const Eigen::Vector3d offset = plane.axes.transpose() * (x - plane.centroid);
        const Eigen::Vector3d effect(offset[1], -offset[0], 1.0);
        return effect.dot(plane.covariance * effect);
    }
};

namespace detail {

inline constexpr double largest_plane = 1e3;  // [m], of the middle of a plane; numerical

/// Square cells of a plane, by the axes of its estimate.
class plane_cells {
  public:
    using cell = std::pair<int, int>;

    plane_cells(const gnomon::plane_estimate& plane, double size) : plane_(plane), size_(size) {}

    /// Two coordinates in the plane, and the one along its normal.
    [[nodiscard]] Eigen::Vector3d local(const Eigen::Vector3d& x) const {
        return plane_.axes.transpose() * (x - plane_.centroid);
    }
    [[nodiscard]] cell of(const Eigen::Vector3d& local) const {
        return {static_cast<int>(std::floor(local[0] / size_)),
                static_cast<int>(std::floor(local[1] / size_))};
    }

  private:
    const gnomon::plane_estimate& plane_;
    double size_;
};

/// The cells next to something that stands on a plane or is at its edge, such as a leg or another
/// wall, and behind it: there, points of both are within the noise of the plane, and would shift
/// it.
inline std::set<plane_cells::cell> cells_at_others(const flat_part& part, double size,
                                                   const gnomon::scan& scan,
                                                   const scan_noise& noise) {
    constexpr double reach = 0.15;     // [m] in front of the noise; chosen
    constexpr double certain = 4.0;    // standard deviations; chosen
    constexpr double displaced = 6.0;  // standard deviations: three of each of two points
    constexpr int fewest = 2;          // points; chosen
    struct points_in_front {
        int number = 0;
        double sigma = 0.0;  // the largest one along a ray [m]
    };
    const plane_cells cells(part.plane, size);
    std::map<plane_cells::cell, points_in_front> in_front;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const double sigma = part.sigma_of(scan, i, noise);
        const double distance = part.distance(scan.points[i]);
        if (!(distance > certain * sigma && distance < certain * sigma + reach)) continue;
        const double along = noise.curve.along(scan.points[i] - scan.viewpoints[i]);
        for (const Eigen::Vector3d& x : {scan.points[i], part.crossing_of(scan, i)}) {
            const Eigen::Vector3d local = cells.local(x);
            if (!(local.norm() < largest_plane)) continue;
            points_in_front& p = in_front[cells.of(local)];
            ++p.number;
            p.sigma = std::max(p.sigma, along);
        }
    }
    std::set<plane_cells::cell> result;
    for (const auto& [c, p] : in_front) {
        if (p.number < fewest) continue;
        const int far = static_cast<int>(std::ceil(displaced * p.sigma / size));
        for (int i = -far; i <= far; ++i)
            for (int j = -far; j <= far; ++j) result.emplace(c.first + i, c.second + j);
    }
    return result;
}

/// The sums of the points of a patch of a plane.
struct patch_sums {
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< of two turns and the shift
    Eigen::Vector3d residuals = Eigen::Vector3d::Zero();    ///< times their effects

    /// @param effect  of the turns and the shift on the distance of a point
    void add(const Eigen::Vector3d& effect, double residual, double variance) {
        information += effect * effect.transpose() / variance;
        residuals += effect * (residual / variance);
    }
    /// The mean residual after a change of the plane.
    [[nodiscard]] double mean_after(const Eigen::Vector3d& change) const {
        return (residuals - information * change)[2] / information(2, 2);
    }
};

/// The change of a plane that its patches want.
struct patch_fit {
    Eigen::Vector3d change = Eigen::Vector3d::Zero();  ///< turns and shift
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    double dispersion = 1.0;  ///< of the means of patches, at least that of independent noise
};

/// Fits the patches by least squares, without those whose mean is far off: something flat lies
/// there, within the noise of the plane.
inline std::optional<patch_fit> fit_of(std::vector<patch_sums> patches) {
    constexpr std::size_t fewest = 4;  // one more than the parameters of a plane
    constexpr double farthest = 3.0;   // standard deviations of the means; chosen
    std::optional<patch_fit> fit;
    for (;;) {
        if (patches.size() < fewest) return fit;
        patch_sums all;
        for (const patch_sums& p : patches)
            all.information += p.information, all.residuals += p.residuals;
        fit.emplace();
        fit->covariance = all.information.inverse();
        if (!fit->covariance.allFinite()) return std::nullopt;
        fit->change = fit->covariance * all.residuals;
        std::vector<double> deviations;
        double squares = 0.0;
        for (const patch_sums& p : patches) {
            const double d = p.mean_after(fit->change) / std::sqrt(1.0 / p.information(2, 2));
            deviations.push_back(std::abs(d));
            squares += d * d;
        }
        fit->dispersion = std::max(1.0, squares / static_cast<double>(patches.size() - 3));
        // Without the patches that are far off for a normal distribution of the median's width.
        std::vector<double> sorted = deviations;
        const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
        std::ranges::nth_element(sorted, middle);
        const double most = farthest * std::max(1.0, 1.4826 * *middle);
        std::vector<patch_sums> kept;
        for (std::size_t i = 0; i < patches.size(); ++i)
            if (deviations[i] <= most) kept.push_back(patches[i]);
        if (kept.size() == patches.size()) return fit;
        patches = std::move(kept);
    }
}

}  // namespace detail

/// Fits the plane again, to all points near it whose rays cross it where its members are, but not
/// next to other things: which points these are does not depend on their noise, unlike the choice
/// of the members, which is one-sided at edges. Scales its covariance by the dispersion of the mean
/// residuals of square patches, relative to that of independent noise (the quasi-likelihood of
/// Wedderburn 1974): where a surface is not quite flat, or the sensor has errors in common for
/// neighboring points, the points are not independent.
inline void refine(flat_part& part, const gnomon::scan& scan, const scan_noise& noise) {
    constexpr double patch = 0.25;     // [m]; chosen: a part of a wall, many points
    constexpr double cell = 0.05;      // [m]; chosen
    constexpr double area_cell = 0.1;  // [m]; chosen: wider than gaps between rays
    const gnomon::plane_estimate before = part.plane;
    const detail::plane_cells cells(before, cell), patches(before, patch), areas(before, area_cell);
    const auto left_out = detail::cells_at_others(part, cell, scan, noise);
    std::set<detail::plane_cells::cell> covered, own;
    const auto place_of = [&](std::size_t i) { return cells.local(part.crossing_of(scan, i)); };
    for (const auto i : part.members) {
        const Eigen::Vector3d x = place_of(i);
        if (!(x.norm() < detail::largest_plane)) continue;
        covered.insert(areas.of(x));
        if (!left_out.contains(cells.of(x))) own.insert(cells.of(x));
    }
    std::map<detail::plane_cells::cell, detail::patch_sums> by_patch;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const Eigen::Vector3d x = place_of(i);
        const double sigma = part.sigma_of(scan, i, noise),
                     residual = part.distance(scan.points[i]);
        if (!(x.norm() < detail::largest_plane && std::abs(residual) <= 3.0 * sigma && sigma > 0.0))
            continue;
        if (own.contains(cells.of(x)))
            by_patch[patches.of(x)].add({x[1], -x[0], 1.0}, residual, sigma * sigma);
    }
    part.area = area_cell * area_cell * static_cast<double>(covered.size());
    std::vector<detail::patch_sums> sums;
    for (const auto& [place, of_patch] : by_patch) sums.push_back(of_patch);
    const auto fit = detail::fit_of(std::move(sums));
    if (!fit) return;
    part.overdispersion = fit->dispersion;
    part.plane.covariance = fit->dispersion * fit->covariance;
    const Eigen::Vector3d& change = fit->change;
    const Eigen::Matrix3d& axes = before.axes;
    const Eigen::Vector3d normal =
        (axes.col(2) + change[1] * axes.col(0) - change[0] * axes.col(1)).normalized();
    part.plane.centroid += change[2] * normal;
    part.plane.plane = {normal, normal.dot(part.plane.centroid)};
    const Eigen::Vector3d first = (axes.col(0) - axes.col(0).dot(normal) * normal).normalized();
    part.plane.axes << first, normal.cross(first), normal;
}

/// The planes of a scan, and the number of the plane of each point.
struct flat_parts {
    std::vector<flat_part> planes;
    std::vector<std::int32_t> plane_of_point;  ///< or `unlabeled`
};

/// The planes of a scan: its segments that are about flat, those on one plane together.
inline flat_parts flat_parts_of(const gnomon::scan& scan, const auto& seen, const scan_noise& noise,
                                const gnomon::threads& threads) {
    constexpr double same_offset = 0.03;       // [m]; chosen: less than a leaf is set back
    constexpr double same_direction = 0.9986;  // the cosine of 3 degrees; chosen
    constexpr std::size_t fewest = 50;         // points; chosen
    constexpr double roughest = 36.0;          // chi2; chosen: 6 times the noise

    // From the largest segment on, each joins the first plane that it is on.
    std::vector<std::int32_t> plane_of(seen.surfaces.size(), gnomon::unlabeled);
    std::vector<std::size_t> firsts;
    for (std::size_t s = 0; s < seen.surfaces.size(); ++s) {
        const gnomon::plane_estimate& own = seen.planes[s];
        if (own.points < fewest || own.chi2 > roughest || own.plane.normal.isZero()) continue;
        const auto is_on = [&](std::size_t first) {
            const gnomon::plane_estimate& other = seen.planes[first];
            return own.plane.normal.dot(other.plane.normal) > same_direction &&
                   std::abs(other.plane.signed_distance(own.centroid)) < same_offset;
        };
        const auto found = std::ranges::find_if(firsts, is_on);
        plane_of[s] = static_cast<std::int32_t>(found - firsts.begin());
        if (found == firsts.end()) firsts.push_back(s);
    }
    std::vector<std::int32_t> labels(scan.size(), gnomon::unlabeled);
    for (std::size_t s = 0; s < seen.surfaces.size(); ++s)
        for (const auto i : seen.surfaces[s]) labels[i] = plane_of[s];
    const gnomon::segments joined(std::move(labels));
    const auto planes = gnomon::estimate_planes(scan, joined, noise.curve, threads);
    flat_parts parts{{}, joined.labels()};
    for (std::size_t p = 0; p < joined.size(); ++p) {
        parts.planes.push_back({{joined[p].begin(), joined[p].end()}, planes[p]});
        if (!planes[p].plane.normal.isZero()) refine(parts.planes.back(), scan, noise);
    }
    return parts;
}

/// The distance between planes that face each other, at a place between them [m].
inline measured_length distance_between(const flat_part& a, const flat_part& b,
                                        const Eigen::Vector3d& place) {
    return {a.distance(place) + b.distance(place),
            std::sqrt(a.variance_at(place) + b.variance_at(place))};
}
