// SPDX-License-Identifier: BSL-1.0
/// @file
/// What is done to a shape before its normals are estimated: nothing, noise, or an uneven density;
/// the columns of PCPNet (Guerrero et al. 2018).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "sampling.hpp"

namespace known_normals {

/// A column of the table.
struct column {
    const char* name;
    double noise;               ///< standard deviation in each coordinate, of the box's diagonal
    double (*density)(double);  ///< relative, up to 1, at 0 ... 1 along the box's longest axis
};

inline double even(double /*along*/) { return 1.0; }
/// Twelve bands, every second thinned to an eighth.
inline double stripes(double along) {
    return static_cast<int>(std::floor(12.0 * along)) % 2 != 0 ? 0.125 : 1.0;
}
/// Falls to a twentieth.
inline double gradient(double along) { return 0.05 + 0.95 * std::clamp(1.0 - along, 0.0, 1.0); }

inline constexpr std::array<column, 6> columns{{{"none", 0.0, even},
                                                {"0.12 %", 0.0012, even},
                                                {"0.6 %", 0.006, even},
                                                {"1.2 %", 0.012, even},
                                                {"stripes", 0.0, stripes},
                                                {"gradient", 0.0, gradient}}};

/// Points and what is true of them.
struct cloud {
    std::vector<Vector3d> points;
    std::vector<Vector3d> normals;  ///< of the surface where the point was before the noise
    Vector3d center;                ///< of the box
    double diagonal;                ///< of the box
};

/// n points of a shape, in random order.
inline cloud make_cloud(const surface& draw, const column& c, std::size_t n, std::uint64_t seed) {
    dice d(seed);
    Vector3d low = Vector3d::Constant(std::numeric_limits<double>::max());
    Vector3d high = -low;
    for (int i = 0; i < 20'000; ++i) {
        const Vector3d p = draw(d).position;
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    const Vector3d extent = high - low;
    Eigen::Index longest = 0;
    extent.maxCoeff(&longest);

    cloud result{{}, {}, 0.5 * (low + high), extent.norm()};
    while (result.points.size() < n) {
        const surface_point p = draw(d);
        const double keep = c.density((p.position[longest] - low[longest]) / extent[longest]);
        if (keep < 1.0 && d.uniform() >= keep) continue;
        result.points.push_back(p.position);
        result.normals.push_back(p.normal);
    }
    if (c.noise > 0.0) {
        dice noise(seed + 1000);
        for (Vector3d& p : result.points) p += c.noise * result.diagonal * noise.gaussian();
    }
    return result;
}

}  // namespace known_normals
