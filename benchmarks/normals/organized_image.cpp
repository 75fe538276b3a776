// SPDX-License-Identifier: BSL-1.0
/// @file
/// How long do normals and surfaces of an organized image take, by its pixels and by a tree? Both
/// in one run, in turns, so that their ratios hold on a busy machine.
///     organized_image_times [--quick | FRAME.pcd]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string_view>
#include <vector>

#include "../../examples/common/help.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/perception/perception.hpp>
#include <gnomon/segmentation/segment_image.hpp>
#include <gnomon/simulation.hpp>

namespace sim = gnomon::simulation;

namespace {

/// The frame of a depth camera before a corner of 3 m by 2.5 m, with a board before it.
gnomon::scan corner(std::size_t width, std::size_t height) {
    constexpr gnomon::quadratic_noise sigma = gnomon::noises::structured_light();
    gnomon::random_stream random(1);
    gnomon::scan scan;
    scan.width = width;
    const double focal_length = 0.82 * static_cast<double>(width);  // [pixels], of the first Kinect
    for (std::size_t i = 0; i < width * height; ++i) {
        const double x =
            (static_cast<double>(i % width) - 0.5 * static_cast<double>(width)) / focal_length;
        const double y =
            (static_cast<double>(i / width) - 0.5 * static_cast<double>(height)) / focal_length;
        double z = std::min(3.0, x > 0.0 ? 1.5 / (x + 1e-9) : 1.0 / (1e-9 - x));
        if (y > 0.0) z = std::min(z, 1.0 / y);
        if (std::abs(x) < 0.1 && std::abs(y) < 0.2) z = 1.5;
        z += sigma(z) * random.gaussian();
        scan.points.emplace_back(z * x, z * y, z);
    }
    return scan;
}

}  // namespace

int main(int argc, char** argv) {
    const char* const arguments = " [--quick | FRAME.pcd]";
    if (printed_help(argc, argv,
                     "Prints the times of surfaces of an organized image, with a tree and without.",
                     arguments))
        return 0;
    const bool quick = argc == 2 && std::string_view(argv[1]) == "--quick";
    if (argc > 2) {
        std::fputs(usage_of(argv[0], arguments).c_str(), stderr);
        return 2;
    }
    const gnomon::scan scan = argc == 2 && !quick ? gnomon::io::read(argv[1])
                              : quick             ? corner(64, 48)
                                                  : corner(640, 480);
    const gnomon::raster pixels{
        .noise = {gnomon::noises::structured_light(), Eigen::Vector3d(0.0, 0.0, 1.0)}};
    const gnomon::team two(2);
    std::vector<gnomon::surfel<gnomon::plane_fit>> surface, by_tree;
    gnomon::segments parts;
    const gnomon::perception<> chain{.noise = pixels.noise};
    gnomon::perception<>::result_type seen;

    constexpr std::size_t ways = 5;
    double least[ways] = {1e9, 1e9, 1e9, 1e9, 1e9};  // [s]
    const auto time = [&least](std::size_t way, auto&& run) {
        const auto begin = std::chrono::steady_clock::now();
        run();
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
        least[way] = std::min(least[way], taken.count());
    };
    for (int turn = 0; turn < (quick ? 1 : 7); ++turn) {
        time(0, [&] {
            gnomon::estimate_normals_into(surface, scan, pixels, gnomon::plane_pca{}, two);
        });
        time(1, [&] { parts = gnomon::segment_surfaces(scan, pixels, surface, {}, two); });
        time(2, [&] {
            gnomon::estimate_normals_into(by_tree, scan, gnomon::knn{.k = 30}, gnomon::plane_pca{},
                                          two);
        });
        time(3, [&] { (void)gnomon::segment_surfaces(scan, by_tree, {}, two); });
        time(4, [&] { chain.into(seen, scan, two); });
    }
    const double image = least[0] + least[1];
    std::printf(
        "%zu pixels, two threads; seconds, and in units of normals and surfaces by pixels\n",
        scan.size());
    std::printf("| step | by pixels | by a tree |\n|---|---|---|\n");
    std::printf("| normals | %.3f (%.2f) | %.3f (%.2f) |\n", least[0], least[0] / image, least[2],
                least[2] / image);
    std::printf("| surfaces | %.3f (%.2f) | %.3f (%.2f) |\n", least[1], least[1] / image, least[3],
                least[3] / image);
    std::printf("| both | %.3f (1.00) | %.3f (%.2f) |\n", image, least[2] + least[3],
                (least[2] + least[3]) / image);
    std::printf("| perception | | %.3f (%.2f) |\n", least[4], least[4] / image);
    std::size_t labeled = 0;
    for (std::size_t s = 0; s < parts.size(); ++s) labeled += parts[s].size();
    std::printf("%zu segments of %zu points, the largest of %zu; perception has %zu\n",
                parts.size(), labeled, parts.empty() ? 0 : parts[0].size(), seen.surfaces.size());
    return 0;
}
