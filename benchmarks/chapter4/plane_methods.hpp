// SPDX-License-Identifier: BSL-1.0
/// @file
/// The methods that plane_segmentation compares, each with its defaults and the settings of a small
/// grid. Lengths in the grids are multiples of the noise and of the spacing that are estimated from
/// the cloud, the same for all methods.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace planes {

using labels = std::vector<std::int32_t>;  ///< of points, -1 for none

struct cloud {
    std::string name;
    std::vector<Eigen::Vector3d> points;  ///< finite ones [m]
    labels truth;
    double noise = 0.0;    ///< across the surface, by gnomon's noise_level [m]
    double spacing = 0.0;  ///< median distance to the nearest neighbor [m]
};

struct setting {
    std::string name;  ///< such as "k=30 angle=10"
    std::function<labels(const cloud&)> segment;
};

/// The first setting is the method's defaults.
struct method {
    std::string name;
    std::vector<setting> settings;
};

// The values of the grids, the same for all methods that have such a parameter.

/// Neighbors, for normals and to grow to.
inline constexpr std::array<std::size_t, 3> ks{12, 30, 60};
/// Angles between normals of neighbors [degrees].
inline constexpr std::array<double, 4> smooth_angles{3.0, 6.0, 9.0, 12.0};
/// Distances from a plane, in `noise`.
inline constexpr std::array<double, 4> deviations_of_noise{3.0, 6.0, 12.0, 24.0};
/// What a segment has at least.
inline constexpr std::array<std::size_t, 2> least_points{30, 100};

/// Labels of n points by lists of their indices.
[[nodiscard]] labels labels_of(std::size_t n, const auto& segments) {
    labels result(n, -1);
    std::int32_t next = 0;
    for (const auto& indices : segments) {
        for (const auto i : indices) result[static_cast<std::size_t>(i)] = next;
        ++next;
    }
    return result;
}

/// "name=value" without trailing zeros.
[[nodiscard]] inline std::string assigned(const std::string& name, auto value) {
    std::string digits = std::to_string(static_cast<double>(value));
    digits.erase(digits.find_last_not_of('0') + 1);
    if (digits.back() == '.') digits.pop_back();
    return name + "=" + digits;
}

/// What was made last, and for which cloud and k: settings that differ in other things share it.
template <class T>
class latest {
  public:
    const T& operator()(const cloud& scene, std::size_t k, const auto& make) {
        if (!value_ || cloud_ != scene.name || k_ != k) {
            value_.emplace(make());
            cloud_ = scene.name;
            k_ = k;
        }
        return *value_;
    }

  private:
    std::optional<T> value_;
    std::string cloud_;
    std::size_t k_ = 0;
};

std::vector<method> gnomon_methods();
std::vector<method> pcl_methods();
std::vector<method> cgal_methods();

}  // namespace planes
