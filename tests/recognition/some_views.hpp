// SPDX-License-Identifier: BSL-1.0
/// @file
/// Small views of furniture made of boards: the points of each board are one segment.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <boost/hana/tuple.hpp>

#include <gnomon/core/plane.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/recognition/posterior.hpp>
#include <gnomon/recognition/view.hpp>
#include <gnomon/recognition/views_of.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace some_views {

namespace rec = gnomon::recognition;

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline const gnomon::plane floor_plane{};

struct element {
    Eigen::Vector3d normal;
};

/// Points in segments, with normals, as a segmentation returns them.
struct cloud {
    std::vector<Eigen::Vector3d> points;
    std::vector<element> surface;
    std::vector<std::int32_t> labels;

    void add(const Eigen::Vector3d& x, const Eigen::Vector3d& normal, std::int32_t label) {
        points.push_back(x);
        surface.push_back({normal});
        labels.push_back(label);
    }

    /// Adds n points of a rectangle with the half edges u and v, with noise along its normal [m].
    void add_board(const Eigen::Vector3d& center, const Eigen::Vector3d& u,
                   const Eigen::Vector3d& v, int n, gnomon::random_stream& random,
                   double sigma = 0.002) {
        const std::int32_t label = next++;
        const Eigen::Vector3d normal = u.cross(v).normalized();
        for (int i = 0; i < n; ++i)
            add(center + random.uniform(-1.0, 1.0) * u + random.uniform(-1.0, 1.0) * v +
                    sigma * random.gaussian() * normal,
                normal, label);
    }

    /// Turns all by a rotation about the origin, then moves it.
    void move(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& by) {
        for (auto& x : points) x = (rotation * x + by).eval();
        for (auto& e : surface) e.normal = (rotation * e.normal).eval();
    }

    std::int32_t next = 0;
};

inline Eigen::Matrix3d yaw(double angle) {
    return Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

inline Eigen::Matrix3d any_rotation(gnomon::random_stream& random) {
    Eigen::Vector3d axis(random.gaussian(), random.gaussian(), random.gaussian());
    return Eigen::AngleAxisd(random.uniform(0.0, 6.0), axis.normalized()).toRotationMatrix();
}

inline constexpr std::array<std::string_view, 3> names{"chair", "table", "shelf"};

/// A chair, a table or a shelf at the origin, whose sizes vary by 3 %.
inline cloud furniture(std::uint32_t kind, gnomon::random_stream& random) {
    cloud c;
    const auto size = [&](double x) { return x * random.uniform(0.97, 1.03); };
    const auto legs = [&](double x, double y, double height) {
        for (const double sx : {-1.0, 1.0})
            for (const double sy : {-1.0, 1.0})
                c.add_board({sx * x, sy * y, 0.5 * height + 0.03}, {0.0, 0.02, 0.0},
                            {0.0, 0.0, 0.5 * height - 0.03}, 25, random);
    };
    if (kind == 0) {
        const double w = size(0.21), h = size(0.45);
        c.add_board({0.0, 0.0, h}, {w, 0.0, 0.0}, {0.0, w, 0.0}, 120, random);
        c.add_board({-w, 0.0, h + 0.25}, {0.0, w, 0.0}, {0.0, 0.0, 0.22}, 100, random);
        legs(w - 0.03, w - 0.03, h);
    } else if (kind == 1) {
        const double x = size(0.6), y = size(0.4), h = size(0.74);
        c.add_board({0.0, 0.0, h}, {x, 0.0, 0.0}, {0.0, y, 0.0}, 200, random);
        legs(x - 0.05, y - 0.05, h);
    } else {
        const double w = size(0.4);
        for (const double sy : {-1.0, 1.0})
            c.add_board({0.0, sy * w, 0.9}, {0.15, 0.0, 0.0}, {0.0, 0.0, 0.85}, 110, random);
        for (const double z : {0.3, 0.9, 1.5})
            c.add_board({0.0, 0.0, size(z)}, {0.15, 0.0, 0.0}, {0.0, w - 0.02, 0.0}, 80, random);
    }
    return c;
}

/// The view of all segments of a cloud.
inline rec::view view_of(const cloud& c, const std::optional<gnomon::plane>& ground = floor_plane,
                         const Eigen::Vector3d& eye = {5.0, 0.5, 1.2}) {
    const auto found =
        rec::views_of(gnomon::with_viewpoint(c.points, eye), c.surface, gnomon::segments(c.labels),
                      {.gap = rec::infinite_gap, .min_parts = 1, .ground = ground});
    return found.empty() ? rec::view{.parts = {}, .ground = ground, .rest = {}} : found.front();
}

/// Views and their classes.
struct labeled_views {
    std::vector<rec::view> views;
    std::vector<std::uint32_t> classes;
};

/// `each` views of each kind, at random places and headings.
inline labeled_views make_views(int each, std::uint64_t seed,
                                const std::optional<gnomon::plane>& ground = floor_plane) {
    labeled_views made;
    for (int i = 0; i < each; ++i) {
        for (std::uint32_t kind = 0; kind < names.size(); ++kind) {
            gnomon::random_stream random(seed, static_cast<std::uint64_t>(i) * 8 + kind);
            cloud c = furniture(kind, random);
            c.move(yaw(random.uniform(-3.0, 3.0)),
                   {random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0), 0.0});
            made.views.push_back(view_of(c, ground));
            made.classes.push_back(kind);
        }
    }
    return made;
}

/// Twelve views of each kind, to train with, and eight to test with.
inline const labeled_views& training() {
    static const labeled_views made = make_views(12, 1);
    return made;
}
inline const labeled_views& fresh() {
    static const labeled_views made = make_views(8, 2);
    return made;
}

/// A view whose parts are like none of the furniture: boards that hang high.
inline rec::view strange_view() {
    gnomon::random_stream random(99);
    cloud c;
    c.add_board({0.0, 0.0, 30.0}, {9.0, 0.0, 0.0}, {0.0, 7.0, 3.0}, 60, random);
    c.add_board({4.0, 0.0, 20.0}, {9.0, 0.0, 0.0}, {0.0, 7.0, 3.0}, 50, random);
    return view_of(c);
}

/// A view without parts, above the floor.
inline rec::view empty_view() { return {.parts = {}, .ground = floor_plane, .rest = {}}; }

/// The first n parts of a view.
inline rec::view with_parts(rec::view v, std::size_t n) {
    v.parts.resize(n);
    return v;
}

/// A feature of a user: the share of the points of the view.
struct share_of_points {
    static constexpr std::string_view name = "share of the points";
    double scale = 0.1, weight = 1.0;
    double operator()(const rec::part& p, const rec::view& v) const {
        double all = 0.0;
        for (const auto& q : v.parts) all += static_cast<double>(q.shape.points);
        return static_cast<double>(p.shape.points) / all;
    }
};

/// A relation of a user: the ratio of the numbers of points, at least 1.
struct ratio_of_points {
    static constexpr std::string_view name = "ratio of the points";
    double bin = 0.5, mass = 0.1, min_deviation = 0.1;
    double operator()(const rec::part& a, const rec::part& b) const {
        const auto x = static_cast<double>(a.shape.points), y = static_cast<double>(b.shape.points);
        return std::max(x, y) / std::min(x, y);
    }
};

/// A feature and a relation that are not numbers.
struct nan_feature {
    static constexpr std::string_view name = "feature of NaN";
    double scale = 1.0, weight = 1.0;
    double operator()(const rec::part&, const rec::view&) const { return nan; }
};
struct nan_relation {
    static constexpr std::string_view name = "relation of NaN";
    double bin = 1.0, mass = 0.1, min_deviation = 0.1;
    double operator()(const rec::part&, const rec::part&) const { return nan; }
};

/// The sum of the evidence of a decision.
inline double sum_of_evidence(const rec::decision& d) {
    double sum = 0.0;
    for (const auto& e : d.evidence) sum += e.log_ratio;
    return sum;
}

inline double sum_of_probability(const rec::decision& d) {
    double sum = 0.0;
    for (const double p : d.probability) sum += p;
    return sum;
}

}  // namespace some_views
