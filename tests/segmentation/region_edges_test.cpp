// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/segmentation/detail/planar_cloud.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>
#include <gnomon/segmentation/detail/region_edges.hpp>

namespace {

constexpr double edge_noise = 0.02;  // [m]

/// Two faces that meet in the y axis, each turned by half of an angle, seen from above.
class two_faces {
  public:
    /// @param turn  positive at a ridge, negative at a corner
    two_faces(gnomon::angle turn, const Eigen::Vector3d& viewpoint, std::uint64_t seed)
        : scan_{{}, gnomon::viewpoint_table(viewpoint), {}} {
        gnomon::random_stream random(seed);
        for (int i = 0; i < 2000; ++i) {
            const double x = random.uniform(-1.0, 1.0), y = random.uniform(-1.0, 1.0);
            const Eigen::Vector3d p(x, y, -std::tan(0.5 * turn.radians()) * std::abs(x));
            scan_.points.push_back(p +
                                   edge_noise * random.gaussian() * (p - viewpoint).normalized());
            truth.push_back(x < 0.0 ? 0 : 1);
        }
        regions.resize(2);
        const auto cloud = this->cloud();
        for (std::size_t i = 0; i < truth.size(); ++i)
            cloud.add(i, regions[static_cast<std::size_t>(truth[i])].sums);
        for (auto& r : regions) r.fit = r.sums.fit();
    }

    [[nodiscard]] const gnomon::spatial_index& index() const { return index_; }
    [[nodiscard]] gnomon::detail::planar_cloud cloud() {
        index_ = gnomon::spatial_index(scan_);
        return {index_, gnomon::constant_noise{edge_noise}, gnomon::sequential{}};
    }

    gnomon::detail::scratch<std::int32_t> truth;
    gnomon::detail::scratch<gnomon::detail::planar_region> regions;

  private:
    gnomon::scan scan_;
    gnomon::spatial_index index_;
};

/// Law: noise along the ray does not change on which side of an edge a point is. The points that
/// are wrong are within the error of the planes from it.
TEST(region_edges, find_the_side_whatever_the_noise_along_the_ray) {
    for (const double degrees : {6.0, 20.0, 80.0, 90.0, 100.0, -6.0, -20.0, -80.0, -90.0, -100.0}) {
        std::vector<Eigen::Vector3d> viewpoints{{0.0, 0.0, 3.0}, {1.5, 2.0, 4.0}};
        // Lower than some points: their rays point away from the other face.
        if (degrees < -45.0) viewpoints.push_back({0.1, 0.3, 0.4});
        for (const Eigen::Vector3d& from : viewpoints) {
            two_faces scene(gnomon::degrees(degrees), from, 7);
            const auto cloud = scene.cloud();
            const gnomon::detail::region_edges<> edges(cloud, scene.regions, scene.truth, {{0, 1}});
            std::size_t by_ray = 0, by_distance = 0, of_one = 0;
            for (std::size_t i = 0; i < scene.truth.size(); ++i) {
                const std::int32_t own = scene.truth[i];
                if (edges.is_across(own, 1 - own, cloud.offsets[i], cloud.ray(i))) ++by_ray;
                const auto off = [&](std::int32_t r) {
                    const auto& plane = scene.regions[static_cast<std::size_t>(r)].fit.plane;
                    return std::abs(plane.signed_distance(cloud.offsets[i]));
                };
                if (off(own) > off(1 - own)) ++by_distance;
                // Of the other region, the same point is across, if its ray meets both planes, as
                // all rays do from far above.
                const bool is_across = edges.is_across(0, 1, cloud.offsets[i], cloud.ray(i));
                const bool is_back = edges.is_across(1, 0, cloud.offsets[i], cloud.ray(i));
                EXPECT_FALSE(is_across && is_back);
                if (from.z() > 2.0 && degrees > -100.0) {
                    EXPECT_NE(is_across, is_back);
                }
                if (is_across || is_back) ++of_one;
            }
            EXPECT_GT(of_one, 100u) << degrees << ", from " << from.transpose();
            EXPECT_LT(by_ray, 40u) << degrees;
            if (std::abs(degrees) < 10.0) {
                EXPECT_GT(by_distance, 8 * by_ray) << degrees;
            }
        }
    }
}

TEST(region_edges, of_planes_that_meet_elsewhere_separate_nothing) {
    // A step of 6 cm moves the line in which they meet by half a meter.
    two_faces scene(gnomon::degrees(6.0), {0.0, 0.0, 3.0}, 3);
    const auto cloud = scene.cloud();
    scene.regions[1].fit.plane.offset += 0.06;
    const gnomon::detail::region_edges<> edges(cloud, scene.regions, scene.truth, {{0, 1}});
    for (std::size_t i = 0; i < scene.truth.size(); ++i) {
        EXPECT_FALSE(edges.is_across(0, 1, cloud.offsets[i], cloud.ray(i)));
        EXPECT_FALSE(edges.is_across(1, 0, cloud.offsets[i], cloud.ray(i)));
    }
}

TEST(region_edges, find_no_side_without_a_ray) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    two_faces scene(gnomon::degrees(80.0), {0.0, 0.0, 3.0}, 3);
    const auto cloud = scene.cloud();
    const gnomon::detail::region_edges<> edges(cloud, scene.regions, scene.truth, {{0, 1}});
    const Eigen::Vector3d at(0.1, 0.1, 0.0);
    for (const Eigen::Vector3d& ray :
         {Eigen::Vector3d(nan, nan, nan), Eigen::Vector3d(0.0, 0.0, 0.0),
          Eigen::Vector3d(0.0, 1.0, 0.0)}) {  // along the edge
        EXPECT_FALSE(edges.is_across(0, 1, at, ray));
        EXPECT_FALSE(edges.is_across(1, 0, at, ray));
    }
    EXPECT_FALSE(edges.is_across(0, 2, at, {0.0, 0.0, -3.0}));  // no edge of this pair
}

}  // namespace
