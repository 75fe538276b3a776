// SPDX-License-Identifier: BSL-1.0
/// @file
/// The boxes around a convex polyhedron that have an edge of it on each of two adjacent faces. The
/// box of smallest volume is among them (O'Rourke 1985). For each pair of edges they are a family
/// with one parameter, in which the volume is piecewise a rational function; the pieces are
/// searched by branch and bound on Bernstein coefficients.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/features/detail/polytope.hpp>

namespace gnomon::detail {

class flush_boxes {
  public:
    using axes = std::array<Eigen::Vector3d, 3>;

    /// Searches for the smallest box of a volume below `limit`, to a relative precision of 1e-9.
    /// O(e^2) for e edges, times the number of pieces.
    flush_boxes(const polytope& hull, double limit)
        : hull_(hull),
          limit_(limit),
          supports_{hull.start(), hull.start(), hull.start(), hull.start()} {
        const auto& arcs = hull.arcs();
        is_complete_ = !arcs.empty();
        for (std::size_t i = 0; i < arcs.size(); ++i) {
            for (std::size_t j = i + 1; j < arcs.size(); ++j) search_pair(arcs[i], arcs[j]);
        }
    }

    [[nodiscard]] bool found() const { return found_; }
    /// Whether no smaller box was missed: the polyhedron has a volume, and no family was left with
    /// boxes that are not searched.
    [[nodiscard]] bool is_complete() const { return is_complete_; }
    /// The axes of that box, orthogonal unit vectors.
    [[nodiscard]] const axes& best() const { return best_; }

  private:
    static constexpr std::size_t supports = 4;
    static constexpr int most_visits = 10000;  // numerical: no endless search among rounding errors

    /// A member of the family of two edges, with an edge on the face of outward normal u, the other
    /// on that of v, and w = u x v; these are not of unit length: u and v are linear in s.
    struct member {
        double s = 0.0;
        Eigen::Vector3d u{0.0, 0.0, 0.0};
        Eigen::Vector3d v{0.0, 0.0, 0.0};
        Eigen::Vector3d w{0.0, 0.0, 0.0};
        std::array<std::uint32_t, supports> distant{};  // farthest along -u, -v, w and -w
    };

    using quadratic = std::array<double, 3>;  // Bernstein coefficients

    void search_pair(const edge_arc& a, const edge_arc& b) {
        // Signed distances of the ends of arc b from the plane orthogonal to u, linear in s. An end
        // on each side: there is a normal v between them.
        const double first[2]{dot(a.first, b.first), dot(a.last, b.first)};
        const double last[2]{dot(a.first, b.last), dot(a.last, b.last)};
        const auto sign_change = [&](double s) {
            return ((1.0 - s) * first[0] + s * first[1]) * ((1.0 - s) * last[0] + s * last[1]);
        };
        std::array<double, 4> breaks{0.0, zero_of(first), zero_of(last), 1.0};
        if (breaks[1] > breaks[2]) std::swap(breaks[1], breaks[2]);
        for (std::size_t i = 0; i < 3; ++i) {
            constexpr double rounding = 1e-15;  // numerical: of two sines
            const double middle = 0.5 * (breaks[i] + breaks[i + 1]);
            if (!(breaks[i] < breaks[i + 1]) || sign_change(middle) > rounding) continue;
            a_ = &a;
            b_ = &b;
            const Eigen::Vector3d across =
                cross(combined(1.0 - middle, a.first, middle, a.last), b.direction);
            side_ = dot(across, b.first) + dot(across, b.last) < 0.0 ? -1.0 : 1.0;
            visits_ = most_visits;
            const member from = make(breaks[i]);
            search(from, make(breaks[i + 1]));
        }
    }

    /// The zero of the linear function with values f at 0 and 1, clamped to this interval.
    [[nodiscard]] static double zero_of(const double (&f)[2]) {
        return (f[0] < 0.0) == (f[1] < 0.0) ? 0.0 : f[0] / (f[0] - f[1]);
    }

    /// The member of parameter s; it becomes the best if it is smaller.
    [[nodiscard]] member make(double s) {
        member m;
        m.s = s;
        m.u = combined(1.0 - s, a_->first, s, a_->last);
        m.v = scaled(side_, cross(m.u, b_->direction));
        m.w = cross(m.u, m.v);
        const std::array<Eigen::Vector3d, supports> directions{scaled(-1.0, m.u), scaled(-1.0, m.v),
                                                               m.w, scaled(-1.0, m.w)};
        for (std::size_t k = 0; k < supports; ++k)
            m.distant[k] = supports_[k] = hull_.farthest(directions[k], supports_[k]);
        if (is_singular(m)) return m;
        const double uu = dot(m.u, m.u);
        const double vv = dot(m.v, m.v);
        const std::array<Eigen::Vector3d, 3> d = spans(m);
        const double volume = dot(d[0], m.u) * dot(d[1], m.v) * dot(d[2], m.w) / (uu * vv);
        if (volume < limit_) {
            limit_ = volume * (1.0 - 1e-9);
            best_ = {direction_of(m.u), direction_of(m.v), direction_of(m.w)};
            found_ = true;
        }
        return m;
    }

    /// Whether the second edge is orthogonal to its face, within rounding. Any v will do then; the
    /// smallest box with this u has another edge on another face.
    [[nodiscard]] static bool is_singular(const member& m) {
        constexpr double rounding = 1e-16;  // of a squared sine
        return !(dot(m.v, m.v) > rounding * dot(m.u, m.u));
    }

    /// Vectors between supporting corners of opposite faces.
    [[nodiscard]] std::array<Eigen::Vector3d, 3> spans(const member& m) const {
        return {difference(hull_[a_->corner], hull_[m.distant[0]]),
                difference(hull_[b_->corner], hull_[m.distant[1]]),
                difference(hull_[m.distant[2]], hull_[m.distant[3]])};
    }

    void search(const member& from, const member& to) {
        constexpr double finest = 1e-10;  // rounding
        if (is_singular(from) && is_singular(to)) return;
        if (exceeds(from, to, from) || exceeds(from, to, to)) return;
        if (visits_ == 0 || to.s - from.s < finest) {
            is_complete_ = false;
            return;
        }
        --visits_;
        const member middle = make(split(from, to));
        search(from, middle);
        search(middle, to);
    }

    /// Whether no box from one member to the other is smaller than the limit, as the corners that
    /// support one of them, `of`, lie in all: volume - limit has Bernstein coefficients >= 0.
    [[nodiscard]] bool exceeds(const member& from, const member& to, const member& of) const {
        const std::array<Eigen::Vector3d, 3> d = spans(of);
        const quadratic uv =
            product(dot(d[0], from.u), dot(d[0], to.u), dot(d[1], from.v), dot(d[1], to.v));
        const quadratic w{dot(d[2], from.w),
                          0.5 * (dot(d[2], cross(from.u, to.v)) + dot(d[2], cross(to.u, from.v))),
                          dot(d[2], to.w)};
        const quadratic uu{dot(from.u, from.u), dot(from.u, to.u), dot(to.u, to.u)};
        const quadratic vv{dot(from.v, from.v), dot(from.v, to.v), dot(to.v, to.v)};
        const std::array<double, 5> volume = product(uv, w);
        const std::array<double, 5> unit = product(uu, vv);
        for (std::size_t i = 0; i < volume.size(); ++i)
            if (!(volume[i] >= limit_ * unit[i])) return false;
        return true;
    }

    /// Where the support changes, or else the middle.
    [[nodiscard]] double split(const member& from, const member& to) const {
        const std::array<std::pair<Eigen::Vector3d, Eigen::Vector3d>, supports> directions{
            {{from.u, to.u}, {from.v, to.v}, {from.w, to.w}, {from.w, to.w}}};
        for (std::size_t k = 0; k < supports; ++k) {
            if (from.distant[k] == to.distant[k]) continue;
            const Eigen::Vector3d d = difference(hull_[from.distant[k]], hull_[to.distant[k]]);
            const double ahead = std::abs(dot(d, directions[k].first));
            const double behind = std::abs(dot(d, directions[k].second));
            const double t = ahead / (ahead + behind);
            constexpr double margin = 0.1;  // numerical: recursions end within 220 calls
            if (t > margin && t < 1.0 - margin) return from.s + t * (to.s - from.s);
        }
        return 0.5 * (from.s + to.s);
    }

    /// The Bernstein coefficients of products: of linear functions by their values at the ends, and
    /// of quadratic ones.
    [[nodiscard]] static quadratic product(double a0, double a1, double b0, double b1) {
        return {a0 * b0, 0.5 * (a0 * b1 + a1 * b0), a1 * b1};
    }
    [[nodiscard]] static std::array<double, 5> product(const quadratic& a, const quadratic& b) {
        return {a[0] * b[0], 0.5 * (a[0] * b[1] + a[1] * b[0]),
                (a[0] * b[2] + 4.0 * a[1] * b[1] + a[2] * b[0]) / 6.0,
                0.5 * (a[1] * b[2] + a[2] * b[1]), a[2] * b[2]};
    }

    const polytope& hull_;
    double limit_;
    std::array<std::uint32_t, supports> supports_;  // of the last member
    const edge_arc* a_ = nullptr;
    const edge_arc* b_ = nullptr;
    double side_ = 1.0;
    int visits_ = 0;  // that are left to the family
    bool found_ = false;
    bool is_complete_ = false;
    axes best_;
};

}  // namespace gnomon::detail
