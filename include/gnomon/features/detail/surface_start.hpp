// SPDX-License-Identifier: BSL-1.0
/// @file
/// First values of spheres, cylinders and cones, from a sample of points with normals whose signs
/// do not matter. Sphere: the point nearest to the lines along the normals, and the algebraic fit.
/// Cylinder and cone: for some directions of the axis, the circles across it by an algebraic fit.
/// The directions are the normal of the great circle of the normals, the direction from the apex in
/// which the planes of points and normals meet, and the principal axes of normals and points, in
/// case that the normals are bad.
#pragma once

#include <cstddef>
#include <span>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/symmetric_eigen.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/features/detail/curved_surfaces.hpp>
#include <gnomon/features/detail/normal_equations.hpp>

namespace gnomon::detail {

/// A point relative to the centroid, with a unit normal, or zero where it is missing.
struct oriented_sample {
    Eigen::Vector3d at;
    Eigen::Vector3d normal;
};

/// x with rows(a, n) . x = values(a, n) in least squares, summed over the samples with a normal.
/// @param add  (sum, sample) adds the equations of one sample
template <std::size_t N>
[[nodiscard]] std::array<double, N> solved_over(std::span<const oriented_sample> samples,
                                                auto&& add) {
    normal_equations<N> sum;
    for (const oriented_sample& s : samples) add(sum, s);
    return linear_solution(sum);
}

/// Spheres to begin with.
[[nodiscard]] inline scratch<sphere_surface> starts_of(std::span<const oriented_sample> samples,
                                                       const sphere_surface&) {
    scratch<sphere_surface> starts;
    const auto add_start = [&](double x, double y, double z) {
        const Eigen::Vector3d center(x, y, z);
        double sum = 0.0;
        for (const oriented_sample& s : samples) sum += length(difference(s.at, center));
        starts.push_back({center, sum / static_cast<double>(samples.size())});
    };
    // The part of x - p across the normal is 0: the projector I - n n^T has three rows.
    const auto lines = solved_over<3>(samples, [](auto& sum, const oriented_sample& s) {
        for (int i = 0; i < 3; ++i) {
            std::array<double, 3> row{};
            for (int j = 0; j < 3; ++j)
                row.data()[j] =
                    (i == j ? dot(s.normal, s.normal) : 0.0) - s.normal[i] * s.normal[j];
            sum.add(row, -(row[0] * s.at[0] + row[1] * s.at[1] + row[2] * s.at[2]));
        }
    });
    add_start(lines[0], lines[1], lines[2]);
    // |p|^2 = 2 c . p + R^2 - |c|^2
    const auto algebraic = solved_over<4>(samples, [](auto& sum, const oriented_sample& s) {
        sum.add({2.0 * s.at[0], 2.0 * s.at[1], 2.0 * s.at[2], 1.0}, -dot(s.at, s.at));
    });
    add_start(algebraic[0], algebraic[1], algebraic[2]);
    return starts;
}

/// The cylinder or cone with an axis in the given direction that fits best in squares of distances
/// from the axis. In the plane across the axis, with the offset c of the axis and the coordinate s
/// along it, |q|^2 = 2 c . q + (R + t s)^2 - |c|^2 for the slope t.
template <std::size_t N>
[[nodiscard]] revolved_line<N> revolved_about(const Eigen::Vector3d& axis,
                                              std::span<const oriented_sample> samples) {
    constexpr std::size_t terms = N > 5 ? 5 : 3;
    revolved_line<N> r;
    r.axis = axis;
    r.e1 = orthogonal(axis);
    const Eigen::Vector3d e2 = cross(axis, r.e1);
    const auto x = solved_over<terms>(samples, [&](auto& sum, const oriented_sample& p) {
        const double a = dot(p.at, r.e1), b = dot(p.at, e2), s = dot(p.at, axis);
        std::array<double, terms> row{2.0 * a, 2.0 * b, 1.0};
        if constexpr (terms > 3) {
            row[3] = s;
            row[4] = s * s;
        }
        sum.add(row, -(a * a + b * b));
    });
    r.point = combined(x[0], r.e1, x[1], e2);
    const double square = x[2] + x[0] * x[0] + x[1] * x[1];
    r.radius = square > 0.0 ? std::sqrt(square) : 1.0;
    if constexpr (terms > 3) {
        r.half_angle = std::atan(0.5 * x[3] / r.radius);
        r.cosine = std::cos(r.half_angle);
        r.sine = std::sin(r.half_angle);
    }
    return r.normalized();
}

/// The direction of a cone's axis: the unit vectors from its apex to the points end on a circle.
[[nodiscard]] inline Eigen::Vector3d axis_from_apex(std::span<const oriented_sample> samples) {
    const auto apex = solved_over<3>(samples, [](auto& sum, const oriented_sample& s) {
        sum.add({s.normal[0], s.normal[1], s.normal[2]}, -dot(s.normal, s.at));
    });
    moments of_directions;
    for (const oriented_sample& s : samples) {
        const Eigen::Vector3d d = difference(s.at, {apex[0], apex[1], apex[2]});
        if (has_length(d)) of_directions.add(direction_of(d));
    }
    if (of_directions.count == 0) return {0.0, 0.0, 1.0};
    return column(symmetric_eigen(of_directions.covariance_of_neighbors()).vectors, 2);
}

/// Cylinders or cones to begin with.
template <std::size_t N>
[[nodiscard]] scratch<revolved_line<N>> starts_of(std::span<const oriented_sample> samples,
                                                  const revolved_line<N>&) {
    scratch<revolved_line<N>> starts;
    moments of_normals, of_points;
    for (const oriented_sample& s : samples) {
        of_normals.add(s.normal);
        of_points.add(s.at);
    }
    for (const Eigen::Matrix3d& m :
         {of_normals.second_moments(), of_points.covariance_of_neighbors()}) {
        const eigen_decomposition e = symmetric_eigen(m);
        for (int i = 2; i >= 0; --i)
            starts.push_back(revolved_about<N>(column(e.vectors, i), samples));
    }
    if constexpr (N > 5) starts.push_back(revolved_about<N>(axis_from_apex(samples), samples));
    return starts;
}

}  // namespace gnomon::detail
