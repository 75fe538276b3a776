// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <set>
#include <stdexcept>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/images.hpp"
#include "laws/neighborhood_laws.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/core/range_noise.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/neighborhoods/neighborhoods_into.hpp>
#include <gnomon/neighborhoods/raster.hpp>

namespace {

static_assert(gnomon::sweeping_neighborhood<gnomon::raster>);
static_assert(gnomon::neighborhood<gnomon::raster, gnomon::scan>);

constexpr gnomon::constant_noise little_noise{0.002};

/// A wall, a floor, and a board in front of the wall, with noise and pixels without a return.
clouds::cloud room(std::size_t width, std::size_t height, std::uint64_t seed) {
    auto image = images::of_planes({{{0, 0, 1}, 2.0}, {{0, 1, 0.2}, 0.45}}, width, height);
    for (std::size_t y = height / 4; y < height / 2; ++y)
        for (std::size_t x = width / 4; x < width / 2; ++x)
            image[y * width + x] = 1.2 * images::ray(x, y, width, height);
    return images::measured(std::move(image), little_noise, 0.1, seed);
}

/// The neighbors by the definition: along the column, and from there along the rows, while the line
/// between the last two returns is at most 80 degrees from being across their rays, but for noise.
class brute_force {
  public:
    brute_force(const clouds::cloud& image, const gnomon::raster& policy)
        : image_(image), policy_(policy), height_(image.size() / policy.width) {}

    [[nodiscard]] std::set<gnomon::point_index> of(std::size_t i) const {
        std::set<gnomon::point_index> all;
        if (!gnomon::is_finite(image_[i])) return all;
        const long r = radius(i);
        for (const long q : reached(static_cast<long>(i), false, r))
            for (const long s : reached(q, true, r))
                if (s != static_cast<long>(i)) all.insert(static_cast<gnomon::point_index>(s));
        return all;
    }

    [[nodiscard]] long radius(std::size_t i) const {
        double pitch = clouds::infinity;  // of rays [rad]
        const long most = static_cast<long>(std::max(policy_.radius, policy_.max_radius));
        for (const bool in_row : {false, true}) {
            for (const long direction : {-1L, 1L}) {
                for (long k = 1; k <= most; ++k) {
                    const long j = moved(static_cast<long>(i), k * direction, in_row);
                    if (j < 0 || !gnomon::is_finite(at(j))) continue;
                    const double sine = (at(j).normalized() - image_[i].normalized()).norm();
                    pitch = std::min(pitch, sine / static_cast<double>(k));
                    break;
                }
            }
        }
        const double sigma = policy_.noise.along(image_[i]);
        long r = static_cast<long>(policy_.radius);
        const auto deviation = [&](long radius) {  // of the slope, by the sum over the window
            double sum = 0.0;
            for (long y = -radius; y <= radius; ++y)
                for (long x = -radius; x <= radius; ++x) sum += static_cast<double>(x * x);
            return sigma / (pitch * image_[i].norm()) / std::sqrt(sum);
        };
        while (r < static_cast<long>(policy_.max_radius) &&
               deviation(r) > policy_.precision.radians())
            ++r;
        return r;
    }

  private:
    [[nodiscard]] long width() const { return static_cast<long>(policy_.width); }
    [[nodiscard]] const Eigen::Vector3d& at(long i) const {
        return image_[static_cast<std::size_t>(i)];
    }
    /// The pixel that is some columns or rows from pixel i; -1 if there is none.
    [[nodiscard]] long moved(long i, long by, bool in_row) const {
        const long x = i % width() + (in_row ? by : 0), y = i / width() + (in_row ? 0 : by);
        const bool is_there = 0 <= x && x < width() && 0 <= y && y < static_cast<long>(height_);
        return is_there ? y * width() + x : -1;
    }
    [[nodiscard]] bool is_linked(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
        const double noise = 3.0 * std::hypot(policy_.noise.along(a), policy_.noise.along(b));
        const Eigen::Vector3d middle = (a.normalized() + b.normalized()).normalized();
        const double along = std::abs((b - a).dot(middle));
        const double across = (b - a).cross(middle).norm();
        return along - noise <= 5.67 * across;
    }
    /// The pixels with a return that i reaches along its row or column, itself included.
    [[nodiscard]] std::vector<long> reached(long i, bool in_row, long radius) const {
        std::vector<long> all{i};
        for (const long direction : {-1L, 1L}) {
            long last = i;
            for (long k = 1; k <= radius; ++k) {
                const long q = moved(i, k * direction, in_row);
                if (q < 0 || !gnomon::is_finite(at(q))) continue;
                if (!is_linked(at(std::min(last, q)), at(std::max(last, q)))) break;
                all.push_back(last = q);
            }
        }
        return all;
    }

    const clouds::cloud& image_;
    const gnomon::raster& policy_;
    std::size_t height_;
};

void expect_brute_force(const clouds::cloud& image, const gnomon::raster& policy) {
    const auto graph = policy(image);
    const brute_force expected(image, policy);
    for (std::size_t i = 0; i < image.size(); ++i) {
        ASSERT_TRUE(std::is_sorted(graph[i].begin(), graph[i].end()));  // by pixel
        ASSERT_EQ(std::set(graph[i].begin(), graph[i].end()), expected.of(i)) << "pixel " << i;
    }
}

TEST(raster, equals_brute_force) {
    const auto image = room(40, 30, 1);
    for (const std::size_t width : {40u, 20u, 1u, 1200u})  // the others are no images of anything
        for (const std::size_t radius : {1u, 3u, 8u})
            expect_brute_force(image, {.width = width, .noise = little_noise, .radius = radius});
    expect_brute_force(image, {.width = 40, .noise = little_noise, .radius = 50});
    expect_brute_force(image, {.width = 40, .noise = little_noise, .radius = 2, .max_radius = 0});
    expect_brute_force(image, {.width = 40});
}

TEST(raster, obeys_the_laws_of_neighborhoods) {
    auto all = clouds::degenerate();
    all.push_back({"room", room(24, 20, 2)});
    all.push_back({"no image", clouds::in_cube(480, 1)});
    for (const auto& [name, points] : all) {
        SCOPED_TRACE(name);
        for (const std::size_t width : {std::size_t{1}, std::size_t{24}, points.size()}) {
            if (width == 0 || points.size() % width != 0) continue;
            const gnomon::raster policy{.width = width, .noise = little_noise};
            laws::neighborhood_laws(policy, points);
            laws::neighborhood_laws(policy, points, Eigen::Vector3d(0.3, -0.2, -0.1));
        }
    }
}

TEST(raster, windows_end_at_jumps_and_only_there) {
    constexpr std::size_t width = 21, center = 10 * width + 10;
    const auto size = [](const clouds::cloud& image) {
        return gnomon::raster{
            .width = width, .noise = little_noise, .radius = 5, .max_radius = 0}(image)[center]
            .size();
    };
    const auto wall = images::of_planes({{{0, 0, 1}, 2.0}}, width, width);
    EXPECT_EQ(size(wall), 11u * 11u - 1u);
    const auto with_step = [&wall](double step) {
        auto image = wall;
        for (std::size_t i = 0; i < image.size(); ++i)
            if (i % width > 10) image[i] *= (2.0 + step) / 2.0;
        return image;
    };
    // 3 deviations of a difference, 8.5 mm, and the steepest surface, 5.67 times 2 m / 525.
    EXPECT_EQ(size(with_step(0.029)), 11u * 11u - 1u);
    EXPECT_EQ(size(with_step(0.031)), 6u * 11u - 1u);
    auto holes = wall;
    for (const std::size_t i : {center + 1, center + 2, center - width}) holes[i] *= clouds::nan;
    EXPECT_EQ(size(holes), 10u * 11u - 1u - 2u);  // a row without a return in the column
    // A floor that is seen from 1 m above at a distance of 5 m.
    const auto floor = images::of_planes({{{0, 1, 0.2}, 0.2 * 5.0}}, width, width);
    EXPECT_EQ(size(floor), 11u * 11u - 1u);
}

/// The squared slope, along x and y, of a plane fit to the depths of a pixel and its neighbors.
double squared_slope(const clouds::cloud& image, std::size_t i, auto&& neighbors) {
    Eigen::Vector3d mean = image[i];
    for (const auto j : neighbors) mean += image[j];
    mean /= static_cast<double>(neighbors.size() + 1);
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    const auto add = [&](const Eigen::Vector3d& p) {
        const Eigen::Vector3d d = p - mean;
        normal += d.head<2>() * d.head<2>().transpose();
        right += d.head<2>() * d.z();
    };
    add(image[i]);
    for (const auto j : neighbors) add(image[j]);
    return (normal.inverse() * right).squaredNorm();
}

/// Independent noise of the depth turns the normals of a wall by the precision, and would by more
/// if windows were a pixel smaller.
TEST(raster, windows_grow_until_noise_turns_normals_by_no_more_than_the_precision) {
    constexpr std::size_t width = 21, center = 10 * width + 10;
    const auto wall = images::of_planes({{{0, 0, 1}, 3.0}}, width, width);
    const gnomon::constant_noise sigma{0.012};
    const gnomon::raster policy{.width = width, .noise = {sigma, Eigen::Vector3d(0, 0, 1)}};
    constexpr int many = 500;
    double sum = 0.0;
    std::size_t members = 0;
    for (std::uint64_t seed = 0; seed < many; ++seed) {
        const auto image = images::measured(wall, sigma, 0.0, seed);
        const auto graph = policy(image);
        members = graph[center].size() + 1;
        sum += squared_slope(image, center, graph[center]) / 2.0;  // of two slopes
    }
    const double deviation = std::sqrt(sum / many) * 180.0 / std::numbers::pi;  // [deg]
    const auto radius = static_cast<std::size_t>(std::sqrt(static_cast<double>(members)) / 2.0);
    EXPECT_EQ(members, (2 * radius + 1) * (2 * radius + 1));
    EXPECT_GT(radius, 3u);
    EXPECT_LT(radius, 10u);
    const double r = static_cast<double>(radius);
    EXPECT_LT(deviation, 2.5 * 1.05);
    EXPECT_GT(deviation * r * r / ((r - 1.0) * (r - 1.0)), 2.5 * 1.05);
}

/// Some drivers write zeros where there was no return.
TEST(raster, links_nothing_with_a_point_at_its_view_point) {
    auto image = images::of_planes({{{0, 0, 1}, 2.0}}, 20, 20);
    image[210].setZero();
    const auto graph = gnomon::raster{.width = 20, .noise = gnomon::constant_noise{1e-4}}(image);
    EXPECT_TRUE(graph[210].empty());
    for (std::size_t i = 0; i < image.size(); ++i) EXPECT_LE(graph[i].size(), 48u);
}

TEST(raster, finds_the_mirrored_windows_in_a_mirrored_image) {
    constexpr std::size_t width = 24, height = 20, n = width * height;
    auto steps = images::of_planes({{{0, 0, 1}, 2.0}}, width, height);
    gnomon::random_stream random(7);
    for (Eigen::Vector3d& p : steps) p *= random.uniform(0.5, 1.5);  // about the steepest surface
    const gnomon::raster policy{.width = width, .noise = little_noise};
    const auto graph = policy(steps);
    for (const bool in_row : {false, true}) {
        const auto mirrored = [&](std::size_t i) {
            return in_row ? i / width * width + width - 1 - i % width
                          : n - width - i / width * width + i % width;
        };
        clouds::cloud image(n);
        for (std::size_t i = 0; i < n; ++i) image[mirrored(i)] = steps[i];
        const auto other = policy(image);
        for (std::size_t i = 0; i < n; ++i) {
            std::set<std::size_t> expected;
            for (const std::size_t j : graph[i]) expected.insert(mirrored(j));
            const auto found = other[mirrored(i)];
            EXPECT_EQ(std::set<std::size_t>(found.begin(), found.end()), expected);
        }
    }
}

/// Also where rays coincide, so that windows grow without end.
TEST(raster, takes_any_radius) {
    auto image = room(12, 10, 8);
    image[30] = image[29];
    const auto of_all = gnomon::raster{.width = 12, .noise = little_noise, .radius = 12}(image);
    const auto grown = gnomon::raster{.width = 12, .noise = little_noise, .max_radius = 12}(image);
    constexpr std::size_t most = std::numeric_limits<std::size_t>::max();
    constexpr std::size_t beyond_32_bits = most / 0xffffffff > 1 ? most / 0xffffffff : most;
    for (const std::size_t radius : {beyond_32_bits - 1, beyond_32_bits, most}) {
        EXPECT_EQ((gnomon::raster{.width = 12, .noise = little_noise, .radius = radius}(image)),
                  of_all);
        EXPECT_EQ((gnomon::raster{.width = 12, .noise = little_noise, .max_radius = radius}(image)),
                  grown);
    }
}

TEST(raster, keeps_its_digits_far_from_the_origin) {
    const auto image = room(40, 30, 4);
    const Eigen::Vector3d far(6e5, 4.8e6, 300.0);
    const auto moved = clouds::moved(image, Eigen::Matrix3d::Identity(), far);
    const gnomon::raster policy{.width = 40, .noise = little_noise};
    EXPECT_EQ(policy(gnomon::with_viewpoint(moved, far)), policy(image));
}

TEST(raster, takes_the_width_of_a_scan) {
    gnomon::scan scan;
    scan.points = room(40, 30, 5);
    EXPECT_THROW((void)gnomon::raster{}(scan), std::invalid_argument);
    scan.width = 40;
    EXPECT_EQ(gnomon::raster{}(scan), gnomon::raster{.width = 40}(scan.points));
    EXPECT_EQ(gnomon::raster{.width = 30}(scan), gnomon::raster{.width = 30}(scan.points));
    gnomon::adjacency graph;
    gnomon::neighborhoods_into(graph, scan, gnomon::raster{});
    EXPECT_EQ(graph, gnomon::raster{}(scan));
    EXPECT_THROW(gnomon::neighborhoods_into(graph, scan.points, gnomon::raster{}),
                 std::invalid_argument);
    EXPECT_EQ(graph.size(), 0u);
}

TEST(raster, refuses_what_is_no_image) {
    const auto image = room(40, 30, 6);
    const auto refuses = [&image](const gnomon::raster& policy) {
        EXPECT_THROW((void)policy(image), std::invalid_argument);
        EXPECT_THROW(
            policy.sweep(image, gnomon::sequential{}, [] { return gnomon::detail::any_visitor{}; }),
            std::invalid_argument);
        const gnomon::spatial_index index(image);
        std::vector<gnomon::neighbor> found;
        EXPECT_THROW(policy.find(index, 0, found), std::invalid_argument);
    };
    refuses({});
    refuses({.width = 41});
    refuses({.width = 40, .radius = 0});
    refuses({.width = 40, .precision = gnomon::degrees(-1)});
    refuses({.width = 40, .precision = gnomon::radians(clouds::nan)});
    EXPECT_EQ(gnomon::raster{.width = 7}(clouds::cloud{}).size(), 0u);
    const std::vector<gnomon::point_index> some{0, 1, 2};
    EXPECT_THROW((void)gnomon::raster{.width = 40}(gnomon::subset_view(image, some)),
                 std::invalid_argument);
}

}  // namespace
