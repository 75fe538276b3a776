// SPDX-License-Identifier: BSL-1.0
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/range_noise.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/segmentation/detail/curved_pieces.hpp>
#include <gnomon/segmentation/detail/planar_cloud.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>

namespace {

using gnomon::point_index;

constexpr double ground_noise = 0.02;  // [m]
const Eigen::Vector3d above_ground(0.0, 0.0, 3.0);

/// A ground of 20 by 8 m with noise along the rays, and its two halves as regions.
class halves {
  public:
    explicit halves(const std::function<double(double, double)>& height, std::uint64_t seed = 1)
        : index_(scan_of(height, seed)),
          cloud_(index_, gnomon::constant_noise{ground_noise}, gnomon::sequential{}),
          labels_(index_.size()) {
        regions_.resize(2);
        for (std::size_t i = 0; i < index_.size(); ++i) {
            const std::size_t half = index_[i].y() > 0.0 ? 1 : 0;
            labels_[i] = static_cast<std::int32_t>(half);
            members_[half].push_back(static_cast<point_index>(i));
            cloud_.add(i, regions_[half].sums);
        }
        for (auto& r : regions_) r.fit = r.sums.fit();
    }

    [[nodiscard]] bool are_one() const {
        return gnomon::detail::are_of_curved_surface(cloud_, regions_[0], members_[0], regions_[1],
                                                     members_[1]);
    }
    /// Likewise, where they are found by their neighbors.
    [[nodiscard]] bool are_one_set() const {
        auto sets = gnomon::detail::curved_surfaces(cloud_, gnomon::knn{.k = 20}(index_), labels_,
                                                    regions_, gnomon::threads{2});
        return sets.find(1) == sets.find(0);
    }

  private:
    static gnomon::scan scan_of(const std::function<double(double, double)>& height,
                                std::uint64_t seed) {
        gnomon::random_stream random(seed);
        gnomon::scan scan;
        scan.viewpoints = above_ground;
        for (int i = 0; i < 4000; ++i) {
            const double x = random.uniform(-10.0, 10.0), y = random.uniform(-4.0, 4.0);
            const Eigen::Vector3d at(x, y, height(x, y));
            scan.points.push_back(at + ground_noise * random.gaussian() *
                                           (at - above_ground).normalized());
        }
        return scan;
    }

    gnomon::spatial_index index_;
    gnomon::detail::planar_cloud cloud_;
    gnomon::detail::scratch<std::int32_t> labels_;
    gnomon::detail::scratch<gnomon::detail::planar_region> regions_;
    std::array<std::vector<point_index>, 2> members_;
};

TEST(curved_pieces, are_one_where_the_surface_is_curved) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const halves road([](double, double y) { return 0.1 * (1.0 - y * y / 16.0); }, seed);
        EXPECT_TRUE(road.are_one()) << seed;
        EXPECT_TRUE(road.are_one_set()) << seed;
        EXPECT_TRUE(
            halves([](double x, double y) { return 0.01 * y * (y + 0.3 * x); }, seed).are_one())
            << "curved at an angle to the border; " << seed;
    }
}

TEST(curved_pieces, are_two_at_creases_and_steps) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const halves roof([](double, double y) { return -0.1 * std::abs(y); }, seed);
        EXPECT_FALSE(roof.are_one()) << seed;
        EXPECT_FALSE(roof.are_one_set()) << seed;
        EXPECT_FALSE(
            halves([](double, double y) { return y > 0.0 ? 0.12 - 0.02 * y : 0.02 * y; }, seed)
                .are_one())
            << "a road and a pavement; " << seed;
        EXPECT_FALSE(halves([](double, double y) { return y > 0.0 ? 0.12 : 0.0; }, seed).are_one())
            << "parallel; " << seed;
        EXPECT_FALSE(halves([](double, double y) { return std::abs(y); }, seed).are_one())
            << "at an edge; " << seed;
    }
}

/// The curved surface is that of few points as well, and of points on one line it is none.
TEST(curved_pieces, survive_flat_and_thin_regions) {
    EXPECT_FALSE(halves([](double, double) { return 0.0; }).are_one());
    gnomon::detail::planar_region a, b;
    const gnomon::spatial_index empty(std::vector<Eigen::Vector3d>{});
    const gnomon::detail::planar_cloud none(empty, gnomon::constant_noise{ground_noise},
                                            gnomon::sequential{});
    EXPECT_FALSE(gnomon::detail::are_of_curved_surface(none, a, {}, b, {}));
}

}  // namespace
