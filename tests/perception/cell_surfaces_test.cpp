// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/range_noise.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/perception/perception.hpp>

namespace {

/// A ground of 16 by 8 m, seen by a level sensor 1.8 m above its middle, with noise of 1 cm. Of
/// places that another thing hides, or is seen through, the rays have `other` times the length.
gnomon::scan seen_ground(const std::function<double(double)>& height, double other = 1.0) {
    constexpr double sigma = 0.01;
    const Eigen::Vector3d sensor(0.0, 0.0, 1.8);
    gnomon::scan scan;
    scan.viewpoints = sensor;
    gnomon::random_stream random(1);
    while (scan.points.size() < 20'000) {
        // As dense per angle as a scanner is, in the azimuth and in the elevation.
        const double azimuth = random.uniform(0.0, 2.0 * std::numbers::pi);
        const double range = 1.8 / std::tan(random.uniform(0.15, 1.2));
        const double x = range * std::cos(azimuth), y = range * std::sin(azimuth);
        if (std::abs(x) > 8.0 || std::abs(y) > 4.0) continue;
        Eigen::Vector3d at(x, y, height(y));
        if (x > 3.0 && x < 4.5) at = sensor + other * (at - sensor);
        scan.points.push_back(at + sigma * random.gaussian() * (at - sensor).normalized());
    }
    return scan;
}

double share_of_largest(const gnomon::segments& surfaces, const gnomon::scan& scan) {
    return static_cast<double>(surfaces[0].size()) / static_cast<double>(scan.points.size());
}

/// A road that is 10 cm higher in the middle is one surface, before and after merging; two that
/// meet at a crease are two.
TEST(cell_surfaces, are_whole_where_they_are_curved) {
    const gnomon::perception<> chain{.noise = gnomon::constant_noise{0.01}};
    const auto road = seen_ground([](double y) { return 0.1 * (1.0 - y * y / 16.0); });
    const auto seen = chain(road);
    EXPECT_GT(share_of_largest(seen.surfaces, road), 0.97);
    EXPECT_GT(share_of_largest(seen.initial_segments, road), 0.97);
    EXPECT_EQ(chain(road, gnomon::threads{3}).surfaces, seen.surfaces);

    const auto roof = seen_ground([](double y) { return -0.1 * std::abs(y); });
    EXPECT_LT(share_of_largest(chain(roof).surfaces, roof), 0.6);
}

/// A vehicle hides a strip of the road, or the ground is seen through a gap.
TEST(cell_surfaces, are_whole_where_they_are_curved_behind_something) {
    const gnomon::perception<> chain{.noise = gnomon::constant_noise{0.01}};
    const auto height = [](double y) { return 0.1 * (1.0 - y * y / 16.0); };
    const auto whole = [&](double other) {
        const auto road = seen_ground(height, other);
        const auto seen = chain(road);
        EXPECT_EQ(chain(road, gnomon::threads{3}).surfaces, seen.surfaces);
        std::size_t beyond = 0, of_largest = 0;
        for (std::size_t i = 0; i < road.points.size(); ++i) {
            if (road.points[i].x() < 6.0) continue;
            ++beyond;
            of_largest += seen.surfaces.labels()[i] == 0 ? 1 : 0;
        }
        return static_cast<double>(of_largest) / static_cast<double>(beyond);
    };
    EXPECT_GT(whole(0.6), 0.9) << "occluded";
    EXPECT_LT(whole(1.5), 0.1) << "free";
}

}  // namespace
