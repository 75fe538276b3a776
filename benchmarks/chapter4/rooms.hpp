// SPDX-License-Identifier: BSL-1.0
/// @file
/// The eight scans of Table 4.1, their segments by the chain of the thesis and by the default one,
/// and the part of each true surface that is one segment.
///
/// Two Chairs and SAT are surrogates of rooms that the thesis shows in photographs only. Their
/// horizontal scan is by an arm that turns about its elbow, so that every scan line has a view
/// point of its own; the others keep theirs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "record.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/perception.hpp>
#include <gnomon/simulation.hpp>

inline constexpr double noise_of_rooms = 0.015;  ///< of all scans [m], that of a UTM-30LX

/// A scan of the table.
struct dataset {
    std::string name;
    gnomon::simulation::scene world;
    char trajectory;    ///< 'H', 'V' or 'R'
    std::size_t lines;  ///< n / 720 (docs/thesis-notes.md, A5)

    [[nodiscard]] double seconds() const { return static_cast<double>(lines) / 40.0; }
    [[nodiscard]] gnomon::simulation::true_scan scan(std::uint64_t seed) const;
};

/// In the order of the table.
std::vector<dataset> datasets();
/// @throws std::out_of_range  if there is none of this name
dataset dataset_of(const std::string& name);

using perceived = gnomon::perception_result<gnomon::plane_fit>;

/// By the default chain, floor and ceiling left out.
perceived perceive(const gnomon::simulation::true_scan& truth);
/// The same, merging liberally.
perceived perceive_liberally(const gnomon::simulation::true_scan& truth);

/// The chain of the thesis (Fig. 4.2) with its parameters (Sec. 4.4.1), floor and ceiling left out;
/// the noise is given, as a sensor's data sheet gives it.
perceived perceive_as_thesis(const gnomon::simulation::true_scan& truth);
/// The same without merging: the segments of Alg. 4.2.
perceived segment_as_thesis(const gnomon::simulation::true_scan& truth);

/// How long a step of a chain took [s]; 0 for a step that it does not have.
double seconds_of(const perceived& seen, std::string_view step);

/// The recovery of a true surface as one segment: shares of its points.
struct recovery {
    std::size_t points = 0;            ///< that were not left out
    std::size_t initial_segments = 0;  ///< segments before merging that lie mostly in it
    double iou_before = 0.0;           ///< with the best segment
    double iou = 0.0;                  ///< after merging
    double iou_of_area = 0.0;          ///< where each pixel of a degree counts once, not each point
    std::int32_t segment = gnomon::unlabeled;  ///< the best after merging
};
recovery recovery_of(const gnomon::simulation::true_scan& truth, const perceived& seen,
                     std::int32_t surface);

/// Rows of recovery over seeds, one for each surface of each data set.
json recovery_table(const std::vector<dataset>& scans, const std::vector<std::string>& surfaces,
                    const effort& much);

/// A picture of the segments and of the considered gaps.
void draw(const gnomon::simulation::true_scan& truth, const perceived& seen,
          const std::filesystem::path& file);
/// A picture of points in groups, z upwards: as discs where there are normals, else as dots.
void draw(const std::vector<Eigen::Vector3d>& points, const std::vector<Eigen::Vector3d>& normals,
          const gnomon::segments& groups, const Eigen::Vector3d& viewpoint,
          const std::filesystem::path& file);
/// The normals alone.
std::vector<Eigen::Vector3d> normals_of(const auto& surface) {
    std::vector<Eigen::Vector3d> normals;
    for (const auto& s : surface) normals.push_back(s.normal);
    return normals;
}
