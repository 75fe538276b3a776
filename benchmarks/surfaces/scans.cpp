// SPDX-License-Identifier: BSL-1.0
// The default chain on scans of real sensors, which have no truth: the measured noise, how much of
// a scan is labeled, and whether the flat surfaces are flat. And on an image with the true planes,
// with more and more noise. The scans are not part of the repository; without them the tables are
// empty.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "../chapter4/hoover.hpp"
#include "../chapter4/plane_scans.hpp"
#include "../chapter4/record.hpp"
#include "flatness_check.hpp"
#include <gnomon/core/detail/stopwatch.hpp>
#include <gnomon/gnomon.hpp>
#include <gnomon/io/read.hpp>
#include <gnomon/perception.hpp>

#ifndef SURFACES_DATA  // compiled by hand, and called in the root of the repository
#define SURFACES_DATA "../shared/data"
#endif

namespace {

namespace files = std::filesystem;

/// A wall that is flat but for a part of 5 x `high` points, which is 10 cm nearer, is found to have
/// a blob from 30 points on.
void require_blobs_are_found() {
    for (const int high : {5, 6}) {
        gnomon::scan scan;
        std::vector<std::int32_t> labels;
        for (int i = 0; i < 60; ++i)
            for (int j = 0; j < 60; ++j)
                scan.points.push_back(
                    {i < 5 && j < high ? 2.9 : 3.0, 0.02 * (i - 30), 0.02 * (j - 30)});
        gnomon::perception_result<gnomon::plane_fit> seen;
        seen.surfaces.assign(std::vector<std::int32_t>(scan.size(), 0));
        seen.noise.curve = gnomon::constant_noise{0.01};
        seen.planes.push_back({.plane = {Eigen::Vector3d(-1, 0, 0), -3.0}, .is_flat = true});
        if (flatness_of(scan, seen).with_blob != (high == 6 ? 1u : 0u))
            throw std::logic_error("flatness_check.hpp does not find a blob of 30 points");
    }
}

/// The row of a scan.
json row_of(const files::path& file) {
    constexpr std::size_t fewest = 30;  // points of a surface that counts
    const gnomon::scan scan = gnomon::io::read(file.string());
    const gnomon::perception<> chain;
    const gnomon::detail::stopwatch watch;
    const auto seen = chain(scan);
    const double taken = watch.seconds();

    std::vector<double> ranges;
    for (std::size_t i = 0; i < scan.size(); ++i)
        if (gnomon::is_finite(scan.points[i]))
            ranges.push_back((scan.points[i] - scan.viewpoints[i]).norm());
    std::size_t surfaces = 0, labeled = 0;
    for (std::size_t s = 0; s < seen.surfaces.size(); ++s) {
        surfaces += seen.surfaces[s].size() >= fewest ? 1 : 0;
        labeled += seen.surfaces[s].size();
    }
    const double finite = static_cast<double>(ranges.size());
    const double range = ranges.empty() ? 0.0 : median_of(ranges);
    const double sigma = seen.noise.curve.along({0.0, 0.0, range});
    const flatness flat = flatness_of(scan, seen);
    return {{"scan", file.stem().string()},
            {"points", scan.size()},
            {"finite", ranges.size()},
            {"range [m]", rounded(range, 2)},
            {"noise [mm]", rounded(1e3 * sigma, 2)},
            {"of the noise", seen.noise.is_across_surface ? std::string(seen.noise.reason)
                                                          : "measured along the rays"},
            {"surfaces", surfaces},
            {"labeled [%]", rounded(100.0 * static_cast<double>(labeled) / finite, 1)},
            {"flat", flat.flat},
            {"flat with a blob", flat.with_blob},
            {"time [s]", rounded(taken, 2)}};
}

/// All real scans, or the smallest one.
json real_scans(bool quick) {
    const files::path folder = files::path(SURFACES_DATA) / "scans";
    std::vector<files::path> found;
    if (files::is_directory(folder))
        for (const auto& entry : files::directory_iterator(folder)) found.push_back(entry.path());
    if (found.empty()) std::printf("no scans in %s: left out\n", folder.string().c_str());
    std::ranges::sort(found);
    if (quick && !found.empty())
        found = {std::ranges::min(found, {}, [](const auto& f) { return files::file_size(f); })};
    json rows = json::array();
    for (const files::path& file : found) {
        rows.push_back(row_of(file));
        std::printf("%s\n", rows.back().dump().c_str());
        std::fflush(stdout);
    }
    return rows;
}

/// What the initial segments of an image with noise along its rays have in common with its regions.
hoover::overlaps overlaps_of(const planes::cloud& image, double sigma, std::uint64_t seed) {
    gnomon::random_stream random(seed);
    gnomon::scan scan{image.points, gnomon::viewpoint_table(Eigen::Vector3d(0.0, 0.0, 0.0)), {}};
    for (Eigen::Vector3d& p : scan.points) p += sigma * random.gaussian() * p.normalized();
    const auto seen = gnomon::perception<>{}(scan);
    return {image.truth, seen.initial_segments.labels()};
}

/// An image of 12 planes of synthetic noise-free blocks (SynPEB), with noise added.
json planes_under_noise(const effort& much) {
    const files::path file =
        files::path(SURFACES_DATA) / "segmentation_truth" / "synpeb_test_100.pcd";
    json rows = json::array();
    if (!files::exists(file)) {
        std::printf("%s is not there: left out\n", file.string().c_str());
        return rows;
    }
    constexpr double first_plane = 10.0;  // lower labels are background
    const planes::cloud image =
        planes::read_labelled("synpeb_test_100", file.string(), "intensity", first_plane);
    for (const double sigma : {0.0, 0.005, 0.020}) {
        const unsigned seeds = sigma > 0.0 ? much.seeds() : 1;  // no noise is the same for all
        constexpr double tolerance = 0.8;                       // of a region, and of its segment
        std::string of_each;
        std::vector<double> found, correct;
        std::size_t regions = 0;
        for (unsigned seed = 1; seed <= seeds; ++seed) {
            const hoover::overlaps overlaps = overlaps_of(image, sigma, seed);
            const hoover::counts c = overlaps.at(tolerance);
            const std::size_t matched = overlaps.matched(tolerance);
            regions = c.regions;
            found.push_back(static_cast<double>(matched));
            correct.push_back(static_cast<double>(c.correct));
            of_each += (seed > 1 ? ", " : "") + std::to_string(matched);
        }
        rows.push_back({{"noise added [mm]", rounded(1e3 * sigma, 1)},
                        {"planes", regions},
                        {"found, for each seed", of_each},
                        {"median", median_of(found)},
                        {"median of Hoover's correct ones", median_of(correct)}});
        std::printf("%s\n", rows.back().dump().c_str());
    }
    return rows;
}

json measure(const effort& much) {
    require_blobs_are_found();
    return {{"real scans", real_scans(much.quick)},
            {"planes of synpeb_test_100", planes_under_noise(much)}};
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, measure); }
