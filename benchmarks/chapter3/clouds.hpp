// SPDX-License-Identifier: BSL-1.0
/// @file
/// The point clouds of chapter 3, from seeds. The scenes are drawn once, in gnomon/simulation.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/scan.hpp>

/// Points with their true normals; zero where there is no truth.
struct labeled_cloud {
    gnomon::scan scan;
    std::vector<Eigen::Vector3d> normals;
};

/// The cloud of a seed, which is that of the noise.
using cloud_source = std::function<labeled_cloud(std::uint64_t seed)>;

/// Fig. 3.3: box and cylinder, 14,200 points. sigma in metres; scale is that of both objects.
cloud_source scenario_one(double sigma, double scale = 1.0);

/// A surrogate of Fig. 3.4: two boxes and a bin, 7,346 points.
cloud_source scenario_two(double sigma);

/// The kitchen of Fig. 2.16. Trajectories: horizontal, vertical, rotational; densities: 7200,
/// 28800, 115200 beams.
cloud_source kitchen(const std::string& trajectory, int density, double sigma, double scale = 1.0);

/// A real table, scanned by a SICK LMS-400. Its truth is that of planes fitted to all points of its
/// two largest segments, floor and table top; other points have none. Nothing if there is no file.
std::optional<cloud_source> real_table();
