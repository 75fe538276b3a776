// SPDX-License-Identifier: BSL-1.0
/// @file
/// Points on spheres, cylinders and cones at random places, with noise in all directions or along
/// rays, and the errors of the surfaces fitted to them in the coordinates of their covariances.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "laws/clouds.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/features/fit_cone.hpp>
#include <gnomon/features/fit_cylinder.hpp>
#include <gnomon/features/fit_sphere.hpp>

namespace round_samples {

using outcome = gnomon::surface_fit::outcome;

struct element {
    Eigen::Vector3d normal;
};

/// How points are drawn. Lengths in radii.
struct drawing {
    double radius = 1.0;  ///< [m], of cones half-way between their ends
    double arc = std::numbers::pi;
    double height = 2.0;
    double half_angle = 0.3;    ///< [rad], of cones
    double sigma = 0.0;         ///< of the noise
    double normal_noise = 0.1;  ///< [rad]
    std::size_t points = 100;
    bool along_rays = false;  ///< else noise is in all directions
};

/// Points with normals of any sign on a surface whose center is `center` and whose axis is `axis`.
struct sample {
    clouds::cloud points;
    std::vector<element> surface;
    Eigen::Matrix3d frame;      ///< x: the middle of the arc; z: the axis
    Eigen::Vector3d center;     ///< [m]
    Eigen::Vector3d viewpoint;  ///< five radii in front of the arc [m]

    [[nodiscard]] Eigen::Vector3d axis() const { return frame.col(2); }
    [[nodiscard]] auto viewed() const { return gnomon::with_viewpoint(points, viewpoint); }
};

enum class kind { sphere, cylinder, cone };

template <kind Kind>
sample draw(const drawing& d, std::uint64_t seed,
            const Eigen::Vector3d& center = {0.7, -2.1, 1.3}) {
    gnomon::random_stream random(seed, 31);
    sample s;
    s.frame = clouds::random_rotation(seed);
    s.center = center;
    const Eigen::Vector3d eye(5.0, 0.0, 0.5);
    s.viewpoint = center + d.radius * (s.frame * eye);
    const double top = std::sin(0.5 * std::min(d.arc, std::numbers::pi));
    const double slope = Kind == kind::cone ? std::tan(d.half_angle) : 0.0;
    while (s.points.size() < d.points) {
        const double phi = d.arc * random.uniform(-0.5, 0.5);
        const double z = random.uniform(-1.0, 1.0) * (Kind == kind::sphere ? top : 0.5 * d.height);
        const double r = Kind == kind::sphere ? std::sqrt(1.0 - z * z) : 1.0 + z * slope;
        Eigen::Vector3d p(r * std::cos(phi), r * std::sin(phi), z), n = p;
        if (Kind != kind::sphere)
            n = Eigen::Vector3d(std::cos(phi), std::sin(phi), -slope).normalized();
        const Eigen::Vector3d ray = (p - eye).normalized();
        if (d.along_rays && ray.dot(n) > 0.0) continue;  // on the far side
        p += d.along_rays ? Eigen::Vector3d(d.sigma * random.gaussian() * ray)
                          : Eigen::Vector3d(d.sigma * clouds::gaussian_vector(random));
        n = (n + d.normal_noise * clouds::gaussian_vector(random)).normalized();
        s.points.push_back(center + d.radius * (s.frame * p));
        s.surface.push_back({(random.uniform() < 0.5 ? -1.0 : 1.0) * (s.frame * n)});
    }
    return s;
}

/// The fit of the kind to points with normals.
template <kind Kind>
auto fit(const auto& points, const auto& surface, const gnomon::noise_curve& noise) {
    if constexpr (Kind == kind::sphere)
        return gnomon::fit_sphere(points, surface, noise);
    else if constexpr (Kind == kind::cylinder)
        return gnomon::fit_cylinder(points, surface, noise);
    else
        return gnomon::fit_cone(points, surface, noise);
}

/// Errors of the parameters, in the order of the covariance.
inline Eigen::VectorXd errors_of(const gnomon::sphere_estimate& e, const sample& s,
                                 const drawing& d) {
    Eigen::VectorXd x(4);
    x << e.center - s.center, e.radius - d.radius;
    return x;
}

inline Eigen::VectorXd errors_about_axis(const auto& e, const sample& s, const drawing& d,
                                         double slope) {
    // Where the true axis crosses the plane across the estimated one through its point.
    Eigen::Vector3d axis = s.axis();
    if (slope == 0.0 && axis.dot(e.direction()) < 0.0) axis = -axis;
    const double along = (e.axis_point - s.center).dot(e.direction()) / axis.dot(e.direction());
    const Eigen::Vector3d shift = e.axes.transpose() * (e.axis_point - s.center - along * axis);
    const Eigen::Vector3d turn =
        e.axes.transpose() * (e.direction() - axis / axis.dot(e.direction()));
    Eigen::VectorXd x(5);
    x << shift[0], shift[1], turn[0], turn[1], e.radius - d.radius - along * slope;
    return x;
}

inline Eigen::VectorXd errors_of(const gnomon::cylinder_estimate& e, const sample& s,
                                 const drawing& d) {
    return errors_about_axis(e, s, d, 0.0);
}

inline Eigen::VectorXd errors_of(const gnomon::cone_estimate& e, const sample& s,
                                 const drawing& d) {
    Eigen::VectorXd x(6);
    x << errors_about_axis(e, s, d, std::tan(d.half_angle)), e.half_angle.radians() - d.half_angle;
    return x;
}

/// A test of covariances: how many draws, how far their nees() may be from 1, and how many of them
/// may fail, of which .3 % are expected. Fewer under the address sanitizer, which takes ten times
/// as long; their mean scatters by more, with a standard deviation of .05.
struct draws_of_test {
    int many = 2000;
    double off = 0.1;
    int failed = 20;
};
#if defined(__SANITIZE_ADDRESS__)
inline constexpr draws_of_test draws{.many = 200, .off = 0.25, .failed = 5};
#else
inline constexpr draws_of_test draws{};
#endif

/// The mean of the normalized estimation error squared, divided by the number of parameters: 1 for
/// covariances that hold. Arcs go evenly from 90 degrees to `largest_arc`.
/// @param failed  gets the number of draws without a good fit
template <kind Kind>
double nees(drawing d, double largest_arc, int& failed) {
    double sum = 0.0;
    failed = 0;
    for (int i = 0; i < draws.many; ++i) {
        d.arc = 0.5 * std::numbers::pi + (largest_arc - 0.5 * std::numbers::pi) * i / draws.many;
        const sample s = draw<Kind>(d, static_cast<std::uint64_t>(i));
        const gnomon::noise_curve noise = gnomon::constant_noise{d.sigma * d.radius};
        const auto e = d.along_rays ? fit<Kind>(s.viewed(), s.surface, noise)
                                    : fit<Kind>(s.points, s.surface, noise);
        failed += e.status != outcome::good;
        if (!e.has_parameters()) continue;
        const Eigen::VectorXd x = errors_of(e, s, d);
        const Eigen::MatrixXd c = e.covariance;
        sum += x.dot(c.inverse() * x) / static_cast<double>(x.size());
    }
    return sum / draws.many;
}

/// Fits without noise are exact on arcs from 90 to 360 degrees, whatever the size, and the noise
/// that is stated.
/// @return the largest error, relative to the radius
template <kind Kind>
double largest_error(bool is_viewed) {
    double worst = 0.0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        gnomon::random_stream random(seed, 8);
        drawing d;
        d.radius = std::exp(random.uniform(-5.0, 5.0));
        d.arc = random.uniform(0.5, is_viewed ? 1.0 : 2.0) * std::numbers::pi;
        d.height = random.uniform(0.5, 4.0);
        d.half_angle = random.uniform(0.05, 0.45);
        d.normal_noise = seed % 2 == 0 ? 0.0 : 0.3;
        d.points = seed % 3 == 0 ? 2000 : 100;  // more than the start uses, or not
        d.along_rays = is_viewed;
        const sample s = draw<Kind>(d, seed, d.radius * Eigen::Vector3d(0.7, -2.1, 1.3));
        const gnomon::noise_curve noise = gnomon::constant_noise{0.01 * d.radius};
        const auto e = is_viewed ? fit<Kind>(s.viewed(), s.surface, noise)
                                 : fit<Kind>(s.points, s.surface, noise);
        if (e.status != outcome::good) return clouds::infinity;
        Eigen::VectorXd x = errors_of(e, s, d);
        for (int i = 0; i < x.size(); ++i) {
            const bool is_angle = Kind != kind::sphere && (i == 2 || i == 3 || i == 5);
            worst = std::max(worst, std::abs(x[i]) / (is_angle ? 1.0 : d.radius));
        }
    }
    return worst;
}

}  // namespace round_samples
