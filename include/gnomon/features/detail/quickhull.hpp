// SPDX-License-Identifier: BSL-1.0
/// @file
/// The convex hull of points in space: Quickhull (Barber, Dobkin and Huhdanpaa 1996) on triangles.
/// Each triangle has a list of the points above it; the farthest of them replaces the triangles
/// that it sees by a cone over their horizon. Points are above a plane, or not, by an exact sign,
/// so that the result is a convex polyhedron for all input; coplanar facets are triangulated.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/features/detail/orientation.hpp>

namespace gnomon::detail {

/// Three points, counterclockwise seen from outside.
using hull_triangle = std::array<std::uint32_t, 3>;

class quickhull {
  public:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    /// Adds all points to the hull of four of them. O(n log n) for most sets of n points.
    /// @param points   with coordinates up to 1 in magnitude; of equal ones the first is taken
    /// @param simplex  four points that are not coplanar
    quickhull(std::span<const Eigen::Vector3d> points, std::array<std::uint32_t, 4> simplex)
        : points_(points), next_(points.size(), none), face_from_(points.size(), none) {
        begin(simplex);
        // The oldest faces first as long as lists are long, for they grow short at once; then the
        // newest, whose points are in the cache. Performance only.
        constexpr std::size_t long_list = 4096;
        std::size_t oldest = 0;
        for (std::size_t apexes = points.size() / long_list; apexes > 0 && oldest < pending_.size();
             ++oldest) {
            if (faces_[pending_[oldest]].first == none) continue;
            add(pending_[oldest]);
            --apexes;
        }
        while (pending_.size() > oldest) {
            const std::uint32_t f = pending_.back();
            pending_.pop_back();
            if (faces_[f].first != none) add(f);
        }
    }

    /// Calls report(triangle) for each triangle of the hull.
    template <class Report>
    void for_each_triangle(const Report& report) const {
        for (const face& f : faces_)
            if (f.corners[0] != none) report(f.corners);
    }

    /// The extreme points, in ascending order: corners where the surface is not flat, nor folded
    /// along one line. Others can be left where facets are coplanar.
    [[nodiscard]] std::vector<std::uint32_t> extreme_points() const {
        std::vector<std::uint8_t> creases(points_.size(), 0);
        constexpr std::uint8_t corner = 3;  // at least this number of creases meet there
        const auto note = [&](std::uint32_t p) {
            if (creases[p] < corner) ++creases[p];
        };
        for (std::uint32_t f = 0; f < faces_.size(); ++f) {
            const face& here = faces_[f];
            for (std::size_t i = 0; i < 3; ++i) {
                const face& there = faces_[here.neighbors[i]];
                if (here.corners[0] == none || here.neighbors[i] < f) continue;  // each edge once
                std::size_t back = 0;
                while (there.neighbors[back] != f) ++back;
                if (height(here, there.corners[(back + 2) % 3]) == 0.0) continue;
                note(here.corners[i]);
                note(here.corners[(i + 1) % 3]);
            }
        }
        std::vector<std::uint32_t> result;
        for (std::uint32_t p = 0; p < creases.size(); ++p)
            if (creases[p] == corner) result.push_back(p);
        return result;
    }

    /// The number of corners of the triangles, by Euler's formula.
    [[nodiscard]] std::size_t corner_count() const {
        return (faces_.size() - free_.size()) / 2 + 2;
    }

  private:
    struct face {
        hull_triangle corners{};                   // none, if the face has been replaced
        std::array<std::uint32_t, 3> neighbors{};  // across the edges from corners 0, 1 and 2
        std::uint32_t first = none;                // list of the points above it
        std::uint32_t farthest = none;             // of them
        std::uint32_t visited = none;              // the last apex that was compared with it
        bool is_seen = false;                      // by that apex
        double distance = 0.0;                  // of the farthest, times the length of the normal
        Eigen::Vector3d normal{0.0, 0.0, 0.0};  // outwards
        double offset = 0.0;                    // normal . x of its points x
        double error = 0.0;                     // bound on the rounding error of height()
    };

    struct edge {
        std::uint32_t from;
        std::uint32_t to;
        std::uint32_t outside;  // the face beyond it that stays
    };

    /// The face of three corners. Its number is that of a replaced face, if there is one.
    std::uint32_t make_face(const hull_triangle& corners) {
        std::uint32_t f = static_cast<std::uint32_t>(faces_.size());
        if (!free_.empty()) {
            f = free_.back();
            free_.pop_back();
        } else {
            faces_.emplace_back();
        }
        face& made = faces_[f];
        made = face{};
        made.corners = corners;
        const Eigen::Vector3d& origin = points_[corners[0]];
        const Eigen::Vector3d u = difference(points_[corners[1]], origin);
        const Eigen::Vector3d v = difference(points_[corners[2]], origin);
        made.normal = cross(u, v);
        made.offset = dot(made.normal, origin);
        // |x| < 1 bounds the error of all terms by 8 epsilon times these magnitudes; twice that.
        constexpr double bound = 16.0 * std::numeric_limits<double>::epsilon();
        const Eigen::Vector3d a(std::abs(u[0]), std::abs(u[1]), std::abs(u[2]));
        const Eigen::Vector3d b(std::abs(v[0]), std::abs(v[1]), std::abs(v[2]));
        made.error = bound * (a[0] * (b[1] + b[2]) + a[1] * (b[2] + b[0]) + a[2] * (b[0] + b[1]));
        return f;
    }

    /// The height of a point above a face, times the length of the normal: positive, zero or
    /// negative as the exact one.
    [[nodiscard]] double height(const face& f, std::uint32_t p) const {
        const double result = dot(f.normal, points_[p]) - f.offset;
        if (std::abs(result) > f.error) return result;
        return signed_volume(points_[f.corners[0]], points_[f.corners[1]], points_[f.corners[2]],
                             points_[p]);
    }

    /// Puts a point on the list of a face, if it is above the face.
    bool assign(std::uint32_t f, std::uint32_t p) {
        const double h = height(faces_[f], p);
        if (!(h > 0.0)) return false;
        face& above = faces_[f];
        next_[p] = above.first;
        above.first = p;
        if (h > above.distance || (h == above.distance && p < above.farthest)) {
            above.distance = h;
            above.farthest = p;
        }
        return true;
    }

    void begin(std::array<std::uint32_t, 4> s) {
        if (signed_volume(points_[s[0]], points_[s[1]], points_[s[2]], points_[s[3]]) > 0.0)
            std::swap(s[1], s[2]);  // the last is below the first three
        make_face({s[0], s[1], s[2]});
        make_face({s[1], s[0], s[3]});
        make_face({s[2], s[1], s[3]});
        make_face({s[0], s[2], s[3]});
        faces_[0].neighbors = {1, 2, 3};
        faces_[1].neighbors = {0, 3, 2};
        faces_[2].neighbors = {0, 1, 3};
        faces_[3].neighbors = {0, 2, 1};
        for (std::uint32_t p = 0; p < points_.size(); ++p) {
            for (std::uint32_t f = 0; f < 4; ++f)
                if (assign(f, p)) break;
        }
        for (std::uint32_t f = 0; f < 4; ++f) pending_.push_back(f);
    }

    /// Adds the farthest point above face f to the hull.
    void add(std::uint32_t f) {
        const std::uint32_t apex = faces_[f].farthest;
        find_horizon(f, apex);
        for (const std::uint32_t s : seen_) faces_[s].corners[0] = none;
        cone_.clear();
        for (const edge& e : horizon_) {
            const std::uint32_t made = make_face({e.from, e.to, apex});
            cone_.push_back(made);
            faces_[made].neighbors[0] = e.outside;
            face& outside = faces_[e.outside];
            for (int i = 0; i < 3; ++i)
                if (outside.corners[static_cast<std::size_t>(i)] == e.to)
                    outside.neighbors[static_cast<std::size_t>(i)] = made;
            face_from_[e.from] = made;
        }
        for (const std::uint32_t made : cone_) {
            const std::uint32_t after = face_from_[faces_[made].corners[1]];
            faces_[made].neighbors[1] = after;
            faces_[after].neighbors[2] = made;
        }
        for (const std::uint32_t s : seen_) {
            for (std::uint32_t p = faces_[s].first; p != none;) {
                const std::uint32_t next = next_[p];
                if (p != apex) {
                    for (const std::uint32_t made : cone_)
                        if (assign(made, p)) break;
                }
                p = next;
            }
            faces_[s].first = none;
        }
        free_.insert(free_.end(), seen_.begin(), seen_.end());
        for (const std::uint32_t made : cone_)
            if (faces_[made].first != none) pending_.push_back(made);
    }

    /// Fills seen_ by the faces that the apex is above of, and horizon_ by the edges around them.
    void find_horizon(std::uint32_t f, std::uint32_t apex) {
        seen_.assign(1, f);
        horizon_.clear();
        faces_[f].visited = apex;
        faces_[f].is_seen = true;
        for (std::size_t s = 0; s < seen_.size(); ++s) {
            const face& from = faces_[seen_[s]];
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t n = from.neighbors[i];
                face& other = faces_[n];
                if (other.visited != apex) {
                    other.visited = apex;
                    other.is_seen = height(other, apex) > 0.0;
                    if (other.is_seen) seen_.push_back(n);
                }
                if (!other.is_seen)
                    horizon_.push_back({from.corners[i], from.corners[(i + 1) % 3], n});
            }
        }
    }

    std::span<const Eigen::Vector3d> points_;
    std::vector<std::uint32_t> next_;  // of a point: the next on the list of its face
    std::vector<std::uint32_t>
        face_from_;  // of a point: the new face whose horizon edge begins there
    std::vector<face> faces_;
    std::vector<std::uint32_t> free_;  // replaced faces, to be used again
    std::vector<std::uint32_t> pending_;
    std::vector<std::uint32_t> seen_;
    std::vector<std::uint32_t> cone_;
    std::vector<edge> horizon_;
};

}  // namespace gnomon::detail
