// SPDX-License-Identifier: BSL-1.0
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

using height_function = std::function<double(double, double)>;

/// A ground 8 m wide, with noise along the rays, in regions.
class ground_in_regions {
  public:
    [[nodiscard]] gnomon::detail::surface_patch patch(std::size_t region) const {
        return gnomon::detail::patch_of(cloud_, regions_[region], members_[region]);
    }

  protected:
    /// @param length     along x, in the middle of which `gap` is missing [m]
    /// @param region_of  region_of(place): one of `count`
    ground_in_regions(const height_function& height, std::uint64_t seed, std::size_t points,
                      double length, double gap, std::size_t count, auto&& region_of)
        : index_(scan_of(height, seed, points, length, gap)),
          cloud_(index_, gnomon::constant_noise{ground_noise}, gnomon::sequential{}),
          members_(count) {
        regions_.resize(count);
        for (std::size_t i = 0; i < index_.size(); ++i) {
            const std::size_t r = region_of(index_[i]);
            labels_.push_back(static_cast<std::int32_t>(r));
            members_[r].push_back(static_cast<point_index>(i));
            cloud_.add(i, regions_[r].sums);
        }
        for (auto& r : regions_) r.fit = r.sums.fit();
    }

    gnomon::spatial_index index_;
    gnomon::detail::planar_cloud cloud_;
    gnomon::detail::scratch<std::int32_t> labels_;
    gnomon::detail::scratch<gnomon::detail::planar_region> regions_;

  private:
    static gnomon::scan scan_of(const height_function& height, std::uint64_t seed,
                                std::size_t points, double length, double gap) {
        gnomon::random_stream random(seed);
        gnomon::scan scan;
        scan.viewpoints = above_ground;
        while (scan.points.size() < points) {
            const double x = random.uniform(-0.5 * length, 0.5 * length);
            const double y = random.uniform(-4.0, 4.0);
            if (std::abs(x) < 0.5 * gap) continue;
            const Eigen::Vector3d at(x, y, height(x, y));
            scan.points.push_back(at + ground_noise * random.gaussian() *
                                           (at - above_ground).normalized());
        }
        return scan;
    }

    std::vector<std::vector<point_index>> members_;
};

/// Its two halves, left and right.
class halves : public ground_in_regions {
  public:
    explicit halves(const height_function& height, std::uint64_t seed = 1)
        : ground_in_regions(
              height, seed, 4000, 20.0, 0.0, 2,
              [](const Eigen::Vector3d& p) -> std::size_t { return p.y() > 0.0 ? 1 : 0; }) {}

    [[nodiscard]] bool are_one() const {
        return gnomon::detail::are_of_curved_surface(regions_[0], patch(0), regions_[1], patch(1));
    }
    /// Likewise, where they are found by their neighbors.
    [[nodiscard]] bool are_one_set() const {
        auto sets = gnomon::detail::curved_surfaces(cloud_, gnomon::knn{.k = 20}(index_), labels_,
                                                    regions_, gnomon::threads{2});
        return sets.find(1) == sets.find(0);
    }
};

/// Its halves before a gap of 4 m, and behind it.
class ends : public ground_in_regions {
  public:
    explicit ends(const height_function& height, std::uint64_t seed = 1)
        : ground_in_regions(height, seed, 6000, 30.0, 4.0, 4,
                            [](const Eigen::Vector3d& p) -> std::size_t {
                                return (p.x() > 0.0 ? 2 : 0) + (p.y() > 0.0 ? 1 : 0);
                            }) {}

    /// Of both ends.
    [[nodiscard]] double dissimilarity() const {
        auto behind = patch(0), before = patch(2);
        behind.add(patch(1));
        before.add(patch(3));
        return gnomon::detail::dissimilarity_of_curved(behind, before, 0.05);
    }
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
    const gnomon::detail::planar_region none;
    EXPECT_FALSE(gnomon::detail::are_of_curved_surface(none, {}, none, {}));
}

double road_height(double y) { return 0.1 * (1.0 - y * y / 16.0); }

TEST(curved_pieces, are_one_across_a_gap_where_a_paraboloid_explains_both) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        EXPECT_LE(ends([](double, double y) { return road_height(y); }, seed).dissimilarity(), 1.0)
            << seed;
        const ends hill([](double x, double y) { return road_height(y) + 0.001 * x * x; }, seed);
        EXPECT_LE(hill.dissimilarity(), 1.0) << "curved along the gap, too; " << seed;
        const auto with_pavement = [](double x, double y) {
            return x > 13.0 && y > 3.5 ? 0.12 : road_height(y);
        };
        EXPECT_LE(ends(with_pavement, seed).dissimilarity(), 1.0) << "but for a corner; " << seed;
    }
}

TEST(curved_pieces, are_two_across_a_gap_at_steps_and_creases) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const auto step = [](double x, double y) {
            return road_height(y) + (x > 0.0 ? 0.12 : 0.0);
        };
        EXPECT_GT(ends(step, seed).dissimilarity(), 1.0) << seed;
        const auto ramp = [](double x, double y) {
            return road_height(y) + std::max(0.0, 0.1 * x);
        };
        EXPECT_GT(ends(ramp, seed).dissimilarity(), 1.0) << seed;
        const auto half = [](double x, double y) {
            return x > 0.0 && y > 0.0 ? 0.12 : road_height(y);
        };
        EXPECT_GT(ends(half, seed).dissimilarity(), 1.0) << "half of one end; " << seed;
    }
}

/// That is for planes to decide.
TEST(curved_pieces, are_two_across_a_gap_where_both_are_single_planes) {
    const ends road([](double, double y) { return road_height(y); });
    EXPECT_GT(gnomon::detail::dissimilarity_of_curved(road.patch(0), road.patch(2), 0.05), 1.0);
    EXPECT_GT(gnomon::detail::dissimilarity_of_curved({}, {}, 0.05), 1.0);
}

}  // namespace
