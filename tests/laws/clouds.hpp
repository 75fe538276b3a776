// SPDX-License-Identifier: BSL-1.0
/// @file
/// Clouds that the laws are tried on: random ones, and the degenerate ones that real scans contain.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/random.hpp>

namespace clouds {

using cloud = std::vector<Eigen::Vector3d>;

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinity = std::numeric_limits<double>::infinity();

inline Eigen::Vector3d gaussian_vector(gnomon::random_stream& random) {
    const double x = random.gaussian();
    const double y = random.gaussian();
    return {x, y, random.gaussian()};
}

/// A random rotation matrix: Gram-Schmidt on gaussian vectors.
inline Eigen::Matrix3d random_rotation(std::uint64_t seed) {
    gnomon::random_stream random(seed, 77);
    Eigen::Matrix3d r;
    r.col(0) = gaussian_vector(random).normalized();
    const Eigen::Vector3d v = gaussian_vector(random);
    r.col(1) = (v - v.dot(r.col(0)) * r.col(0)).normalized();
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        r(i, 2) = r(j, 0) * r(k, 1) - r(k, 0) * r(j, 1);
    }
    return r;
}

/// n points spread evenly in the unit cube.
inline cloud in_cube(std::size_t n, std::uint64_t seed) {
    gnomon::random_stream random(seed);
    cloud points(n);
    for (Eigen::Vector3d& p : points) {
        for (int a = 0; a < 3; ++a) p[a] = random.uniform();
    }
    return points;
}

/// A gently curved noisy sheet of about one metre.
inline cloud sheet(std::size_t n, std::uint64_t seed, double sigma = 0.002) {
    gnomon::random_stream random(seed);
    cloud points(n);
    for (Eigen::Vector3d& p : points) {
        const double x = random.uniform();
        const double y = random.uniform();
        p = {x, y, 0.1 * std::sin(3.0 * x) * y + sigma * random.gaussian()};
    }
    return points;
}

/// Points on an integer grid of the given step: full of ties, as depth cameras deliver them.
inline cloud on_grid(std::size_t n, std::uint64_t seed, double step = 0.25) {
    cloud points = in_cube(n, seed);
    for (Eigen::Vector3d& p : points) {
        for (int a = 0; a < 3; ++a) p[a] = step * std::floor(p[a] / step * 2.0);
    }
    return points;
}

/// `points`, shuffled; order[i] reports where the i-th of the result was.
inline cloud permuted(const cloud& points, std::uint64_t seed, std::vector<std::size_t>& order) {
    gnomon::random_stream random(seed, 5);
    order.resize(points.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    cloud result;
    for (const std::size_t i : order) result.push_back(points[i]);
    return result;
}

/// R p + t of every point.
inline cloud moved(const cloud& points, const Eigen::Matrix3d& r, const Eigen::Vector3d& t) {
    cloud result;
    for (const Eigen::Vector3d& p : points) result.push_back(r * p + t);
    return result;
}

/// A cloud with a name, for tests that run over all of them.
struct named_cloud {
    std::string name;
    cloud points;
};

/// What every algorithm must survive.
inline std::vector<named_cloud> degenerate() {
    std::vector<named_cloud> all;
    for (std::size_t n = 0; n <= 4; ++n)
        all.push_back({std::to_string(n) + " points", in_cube(n, n)});
    all.push_back({"all equal", cloud(60, {1.0, 2.0, 3.0})});
    cloud line;
    cloud plane;
    cloud far_line;
    for (int i = 0; i < 60; ++i) {
        line.push_back({0.1 * i, 0.2 * i, -0.3 * i});
        plane.push_back({0.1 * (i % 8), 0.1 * (i / 8), 0.5});
        far_line.push_back({6e5 + 0.1 * i, 4.8e6 + 0.2 * i, 100.0});
    }
    all.push_back({"collinear", line});
    all.push_back({"coplanar grid", plane});
    all.push_back({"collinear at UTM coordinates", far_line});
    all.push_back({"all NaN", cloud(20, {nan, nan, nan})});
    cloud mixed = sheet(200, 3);
    for (std::size_t i = 0; i < mixed.size(); i += 7) mixed[i][static_cast<int>(i % 3)] = nan;
    for (std::size_t i = 3; i < mixed.size(); i += 11) mixed[i].x() = infinity;
    for (std::size_t i = 5; i < mixed.size(); i += 13) mixed[i].y() = -infinity;
    all.push_back({"a sheet with NaN and infinities", mixed});
    all.push_back({"one finite among NaN", {{nan, 0, 0}, {1, 2, 3}, {nan, nan, nan}}});
    cloud doubled = sheet(100, 4);
    const cloud once = doubled;
    for (int copy = 0; copy < 4; ++copy) doubled.insert(doubled.end(), once.begin(), once.end());
    all.push_back({"every point five times", doubled});
    cloud dropouts = sheet(150, 5);  // at both zeros, which are one place
    for (std::size_t i = 0; i < dropouts.size(); i += 2) dropouts[i] = {i % 4 ? 0.0 : -0.0, 0, 0};
    all.push_back({"every second point at the origin", dropouts});
    all.push_back({"ties everywhere", on_grid(300, 6)});
    cloud huge = in_cube(80, 7);
    for (Eigen::Vector3d& p : huge) p *= 1e149;
    huge.push_back({1e200, 0, 0});
    huge.push_back({1.7e308, -1.7e308, 1.7e308});
    all.push_back({"huge coordinates", huge});
    cloud tiny = in_cube(80, 8);
    for (Eigen::Vector3d& p : tiny) p *= 1e-200;
    all.push_back({"tiny coordinates", tiny});
    return all;
}

}  // namespace clouds
