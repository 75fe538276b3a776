// SPDX-License-Identifier: BSL-1.0
/// @file
/// 3D Zernike descriptors of a segment: norms of the moments of its points about the polynomials of
/// Canterakis and Zernike in the unit ball, which are invariant under rotation.
///
/// The thesis finds them unusable for noisy scans of uneven density: similar segments have
/// dissimilar descriptors.
///
/// Klasing 2010, Sec. 3.5.4. M. Novotni and R. Klein, 3D Zernike descriptors for content based
/// shape retrieval, 2003.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/features/detail/row_distance.hpp>
#include <gnomon/features/detail/zernike_moments.hpp>

namespace gnomon {

/// How a segment becomes a function in the unit ball.
struct zernike_options {
    std::size_t order = 5;  ///< the highest n, at most 20: higher ones lose their digits
    /// If above 0, the points become occupied voxels of a grid with this number of voxels along the
    /// diameter of the ball, at most 1024; if 0, each point is a mass of its own.
    std::size_t voxels = 0;
    /// The radius of the ball is twice the root mean square distance from the centroid, as in
    /// Novotni's implementation, and points beyond it are left out; if set, it is the largest
    /// distance, so that single points on the boundary of a segment determine its scale.
    bool enclose = false;
};

/// The norms F_nl of the vectors of moments Omega_nlm over m, for n = 0, ..., order and l = n, n -
/// 2, ..., from the smallest l on: F_00, F_11, F_20, F_22, F_31, ..., 12 numbers for order 5.
///
/// The function is 1 in occupied voxels, or a mass of 4 pi / 3 shared by the points. Position and
/// size of the segment have no effect, beyond the limits of voxels.
struct zernike_descriptor {
    std::vector<double> values;             ///< all zero if the trust is not usable
    Eigen::Vector3d center{0.0, 0.0, 0.0};  ///< of the ball [m]: the centroid
    double radius = 0.0;                    ///< of the ball [m]
    /// `too_few_neighbors` if no point is finite, `degenerate` if all of them coincide.
    gnomon::trust trust = gnomon::trust::too_few_neighbors;

    /// The descriptor of the finite points of a range.
    /// @param points      any point range of n points [m]
    /// @param run         for the sums over the points; the result is the same bytes for every one
    /// @param projection  maps an element of the range to a point
    /// @throws std::invalid_argument  if an option is out of range, or n is 2^32 - 1 or more
    /// Complexity: O(n order^3), with voxels O(n log n) and O(v order^3) for v occupied ones.
    template <class R, execution X = sequential, class Proj = std::identity>
        requires point_range<R, Proj>
    [[nodiscard]] static zernike_descriptor of(const R& points, const zernike_options& options = {},
                                               const X& run = {}, Proj projection = {});

    /// The Euclidean distance of the values. O(order^2).
    /// @throws std::invalid_argument  if the orders differ
    [[nodiscard]] double distance(const zernike_descriptor& other) const {
        detail::require(values.size() == other.values.size(),
                        "zernike_descriptor: the orders differ");
        return detail::euclidean_distance(values, other.values);
    }
};

namespace detail {

/// Moves and scales positions into the unit ball.
class unit_ball {
  public:
    Eigen::Vector3d center{0.0, 0.0, 0.0};
    double radius = 0.0;  ///< 0 if there are no positions, or all coincide

    unit_ball(const scratch<Eigen::Vector3d>& positions, bool enclose) {
        if (positions.empty()) return;
        const double share = 1.0 / static_cast<double>(positions.size());
        for (const Eigen::Vector3d& p : positions) center = combined(1.0, center, share, p);
        double largest = 0.0, mean = 0.0;
        for (const Eigen::Vector3d& p : positions) {
            const double square = dot(difference(p, center), difference(p, center));
            largest = std::max(largest, square);
            mean += share * square;
        }
        radius = enclose ? std::sqrt(largest) : 2.0 * std::sqrt(mean);
    }

    void transform(scratch<Eigen::Vector3d>& positions) const {
        for (Eigen::Vector3d& p : positions) p = scaled(1.0 / radius, difference(p, center));
    }
};

/// Replaces positions by the centers of the voxels that they occupy, of a grid over the cube of the
/// unit ball; those outside the cube are left out.
inline void voxelize(scratch<Eigen::Vector3d>& positions, std::size_t voxels) {
    const auto n = static_cast<double>(voxels);
    scratch<std::uint64_t> cells;
    for (const Eigen::Vector3d& p : positions) {
        std::uint64_t cell = 0;
        bool inside = true;
        for (int a = 0; a < 3; ++a) {
            inside = inside && std::abs(p[a]) <= 1.0;
            if (!inside) break;
            const auto i = static_cast<std::uint64_t>(0.5 * n * (p[a] + 1.0));
            cell = cell * voxels + std::min<std::uint64_t>(i, voxels - 1);
        }
        if (inside) cells.push_back(cell);
    }
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    positions.clear();
    const auto at = [n](std::uint64_t i) { return (2.0 * static_cast<double>(i) + 1.0) / n - 1.0; };
    for (const std::uint64_t c : cells)
        positions.push_back({at(c / (voxels * voxels)), at(c / voxels % voxels), at(c % voxels)});
}

}  // namespace detail

template <class R, execution X, class Proj>
    requires point_range<R, Proj>
zernike_descriptor zernike_descriptor::of(const R& points, const zernike_options& options,
                                          const X& run, Proj projection) {
    detail::require(options.order <= 20, "zernike_descriptor: the order is 20 at most");
    detail::require(options.voxels <= 1024, "zernike_descriptor: there are 1024 voxels at most");
    const position_view<R, Proj> p(points, std::move(projection));
    detail::zernike_moments moments(options.order);
    zernike_descriptor result;
    result.values = moments.norms();  // zeros
    detail::scratch<Eigen::Vector3d> positions;
    Eigen::Vector3d origin{0.0, 0.0, 0.0};
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Eigen::Vector3d q = p[i];
        if (!is_finite(q)) continue;
        if (positions.empty()) origin = q;
        positions.push_back(detail::difference(q, origin));
    }
    if (positions.empty()) return result;
    const detail::unit_ball ball(positions, options.enclose);
    result.trust = trust::degenerate;
    if (!std::isnormal(ball.radius)) return result;
    ball.transform(positions);
    result.center = detail::combined(1.0, origin, 1.0, ball.center);
    result.radius = ball.radius;

    constexpr double volume = 4.0 / 3.0 * std::numbers::pi;  // of the unit ball
    double mass = volume / static_cast<double>(positions.size());
    if (options.voxels > 0) {
        detail::voxelize(positions, options.voxels);
        const detail::unit_ball filled(positions, options.enclose);
        if (!std::isnormal(filled.radius)) return result;  // one voxel
        filled.transform(positions);
        result.center = detail::combined(1.0, result.center, ball.radius, filled.center);
        result.radius *= filled.radius;
        const double side = 2.0 / (static_cast<double>(options.voxels) * filled.radius);
        mass = side * side * side;
    }
    // Sums of chunks in their order: the same bytes on any number of threads.
    std::vector<detail::zernike_moments> sums(detail::chunk_count(positions.size()), moments);
    detail::for_each_chunk(run, positions.size(), [&](std::size_t begin, std::size_t end) {
        detail::zernike_moments& own = sums[begin / detail::chunk_size];
        for (std::size_t i = begin; i < end; ++i)
            if (detail::dot(positions[i], positions[i]) <= 1.0) own.add(positions[i], mass);
    });
    for (const detail::zernike_moments& sum : sums) moments.add(sum);
    result.values = moments.norms();
    result.trust = trust::good;
    return result;
}

}  // namespace gnomon
