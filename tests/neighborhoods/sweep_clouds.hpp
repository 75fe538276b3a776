// SPDX-License-Identifier: BSL-1.0
/// @file
/// Clouds that a sweep of leaves could go wrong on.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "laws/clouds.hpp"

namespace clouds {

/// make(i, random) for each i < n.
inline cloud cloud_of(std::size_t n, auto&& make) {
    gnomon::random_stream random(n);
    cloud points;
    for (std::size_t i = 0; i < n; ++i) points.push_back(make(i, random));
    return points;
}

inline cloud scaled(const cloud& points, double scale) {
    return moved(points, scale * Eigen::Matrix3d::Identity(), {0, 0, 0});
}

/// `points`, where each point with an index that is a multiple of `every` is replaced by make(i).
inline cloud with_every(std::size_t every, cloud points, auto&& make) {
    for (std::size_t i = 0; i < points.size(); i += every) points[i] = make(i);
    return points;
}

/// As a depth camera gives them: disparities in steps of an eighth of a pixel.
inline Eigen::Vector3d depth_camera_point(std::size_t i) {
    const double u = double(i % 60) - 30, v = double(i / 60) - 20;
    const double z = 8.0 / std::round(16.0 + 8.0 * std::sin(0.1 * u));
    return {u * z / 60, v * z / 60, z};
}

inline std::vector<named_cloud> to_sweep() {
    constexpr std::size_t n = 1500;
    using stream = gnomon::random_stream&;
    const auto cube = in_cube(n, 1), surface = clouds::sheet(n, 2);
    auto all = degenerate();
    all.push_back({"volume", cube});
    all.push_back({"surface", surface});
    all.push_back({"line", cloud_of(n, [](auto, stream random) {
                       return Eigen::Vector3d(100 * random.uniform(), 0, 0);
                   })});
    all.push_back({"even line", cloud_of(n, [](auto i, auto&) {
                       return Eigen::Vector3d(double(i), 2 * double(i), 0);
                   })});
    all.push_back(
        {"clusters of different density", cloud_of(n, [](auto i, stream random) -> Eigen::Vector3d {
             const double spread = std::pow(10.0, -3.0 * double(i % 4));
             return Eigen::Vector3d(double(i % 4), 0, 0) + spread * gaussian_vector(random);
         })});
    for (const double decades : {8.0, 100.0, 300.0})
        all.push_back({"no scale over " + std::to_string(decades) + " decades",
                       cloud_of(n, [decades](auto, stream random) -> Eigen::Vector3d {
                           return std::pow(10.0, -decades * random.uniform()) *
                                  gaussian_vector(random);
                       })});
    all.push_back({"clumps of 20", cloud_of(n, [](auto i, stream random) -> Eigen::Vector3d {
                       return Eigen::Vector3d(1e3 * double(i / 20), 0, 0) + gaussian_vector(random);
                   })});
    all.push_back({"grid", on_grid(n, 3, 0.01)});
    all.push_back({"full grid", cloud_of(n, [](auto i, auto&) {
                       return Eigen::Vector3d(double(i % 14), double(i / 14 % 14), double(i / 196));
                   })});
    all.push_back({"millimetres", cloud_of(n, [&](auto i, auto&) -> Eigen::Vector3d {
                       return (1e3 * surface[i]).array().round() / 1e3;
                   })});
    all.push_back(
        {"depth camera", cloud_of(n, [](auto i, auto&) { return depth_camera_point(i); })});
    all.push_back(
        {"UTM coordinates", moved(surface, Eigen::Matrix3d::Identity(), {6e5, 4.8e6, 100})});
    all.push_back(
        {"UTM coordinates, millimetres", cloud_of(n, [&](auto i, auto&) -> Eigen::Vector3d {
             const Eigen::Vector3d p = surface[i] + Eigen::Vector3d(6e5, 4.8e6, 100);
             return Eigen::Vector3d((1e3 * p).array().round() / 1e3);
         })});
    all.push_back(
        {"pairs", with_every(2, cube, [&](auto i) -> Eigen::Vector3d { return cube[i + 1]; })});
    all.push_back({"triples, a hair apart", cloud_of(n, [&](auto i, auto&) -> Eigen::Vector3d {
                       return cube[i / 3] * (1 + double(i % 3) * 1e-15);
                   })});
    for (const std::size_t heap : {31u, 32u, 62u})
        all.push_back(
            {"heaps of " + std::to_string(heap),
             cloud_of(n, [&](auto i, auto&) -> Eigen::Vector3d { return cube[i / heap]; })});
    all.push_back({"a heap at the origin",
                   with_every(2, cube, [](auto) { return Eigen::Vector3d(0, 0, 0); })});
    all.push_back({"NaN and infinities", with_every(7, cube, [](auto i) {
                       return Eigen::Vector3d(i % 2 ? nan : infinity, 0, 0);
                   })});
    for (const double far : {1e9, 1e30, 1e140})
        all.push_back({"strays at " + std::to_string(far),
                       with_every(500, cube, [&](auto i) -> Eigen::Vector3d {
                           return Eigen::Vector3d(i % 1000 ? far : -far, 0, 0);
                       })});
    for (const double scale : {1e-300, 1e-160, 1e-158, 1e-154, 1e-140, 1e140})
        all.push_back({"cube of " + std::to_string(std::log10(scale)), scaled(cube, scale)});
    all.push_back(
        {"a cluster whose squares underflow", with_every(4, cube, [&](auto i) -> Eigen::Vector3d {
             return Eigen::Vector3d(1e-160 * cube[i]);
         })});
    return all;
}

}  // namespace clouds
