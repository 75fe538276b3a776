// SPDX-License-Identifier: BSL-1.0
/// @file
/// Solids built of solids by union, intersection and difference, whose boundary can be sampled
/// uniformly by area with exact normals.
///
/// A point of the boundary of a part is one of the whole exactly if one of its two sides is inside
/// the whole and the other is not. Parts must not share pieces of their boundaries, which would be
/// sampled twice.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "sampling.hpp"

namespace known_normals {

/// The whole boundary of a primitive.
struct boundary {
    double area;
    surface draw;
};

struct solid {
    std::vector<boundary> boundaries;  ///< of the primitives that it is built of
    std::function<bool(const Vector3d& p)> contains;
};

/// The solid, turned about the origin.
inline solid turned(const solid& s, const Eigen::Matrix3d& rotation) {
    solid result{{}, [rotation, contains = s.contains](const Vector3d& p) {
                     return contains(rotation.transpose() * p);
                 }};
    for (const boundary& b : s.boundaries) {
        result.boundaries.push_back(
            {b.area, [rotation, draw = b.draw](dice& d) {
                 const surface_point p = draw(d);
                 return surface_point{rotation * p.position, rotation * p.normal};
             }});
    }
    return result;
}

namespace detail {

inline std::vector<boundary> all_boundaries(const solid& a, const solid& b) {
    std::vector<boundary> all = a.boundaries;
    all.insert(all.end(), b.boundaries.begin(), b.boundaries.end());
    return all;
}

}  // namespace detail

/// Union.
inline solid operator|(const solid& a, const solid& b) {
    return {detail::all_boundaries(a, b), [in_a = a.contains, in_b = b.contains](
                                              const Vector3d& p) { return in_a(p) || in_b(p); }};
}

/// Intersection.
inline solid operator&(const solid& a, const solid& b) {
    return {detail::all_boundaries(a, b), [in_a = a.contains, in_b = b.contains](
                                              const Vector3d& p) { return in_a(p) && in_b(p); }};
}

/// Difference.
inline solid operator-(const solid& a, const solid& b) {
    return {detail::all_boundaries(a, b), [in_a = a.contains, in_b = b.contains](
                                              const Vector3d& p) { return in_a(p) && !in_b(p); }};
}

/// The boundary of a solid about as large as 1. Expected cost of a point: the area of all parts in
/// units of the area of the whole.
inline surface surface_of(solid s) {
    double total = 0.0;
    for (const boundary& b : s.boundaries) total += b.area;
    return [s = std::move(s), total](dice& d) {
        constexpr double step = 1e-6;  // to either side
        for (;;) {
            double u = d.uniform(0.0, total);
            std::size_t i = 0;
            while (i + 1 < s.boundaries.size() && u >= s.boundaries[i].area)
                u -= s.boundaries[i++].area;
            surface_point p = s.boundaries[i].draw(d);
            const bool behind = s.contains(p.position - step * p.normal);
            const bool before = s.contains(p.position + step * p.normal);
            if (behind == before) continue;
            if (before) p.normal = -p.normal;
            return p;
        }
    };
}

}  // namespace known_normals
