// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/segmentation/split_outliers.hpp>

namespace {

using gnomon::split_outliers, gnomon::segments, gnomon::unlabeled;

constexpr double sigma_of_seat = 0.005;
const gnomon::noise_curve noise_of_seat = gnomon::constant_noise{sigma_of_seat};
const Eigen::Vector3d eye_before_seat(-1.6, 0.2, 0.8);

std::vector<std::int32_t> labels_of_one(std::size_t n) { return std::vector<std::int32_t>(n, 0); }

/// A seat, 40 cm wide, and the front of its board, 4 cm high, as a sensor in front of it sees them:
/// rays a degree apart, with noise along them. All in one segment, which is flat: fewer than 30
/// points are certainly off it.
struct seat {
    clouds::cloud points;
    std::vector<bool> is_of_front;

    explicit seat(std::uint64_t seed, double height = 0.04) {
        gnomon::random_stream random(seed);
        constexpr double spacing = 0.0175;  // of rays [rad]
        for (double elevation = -0.6; elevation < 0.0; elevation += spacing) {
            for (double azimuth = -0.3; azimuth < 0.3; azimuth += spacing) {
                const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth),
                                          std::cos(elevation) * std::sin(azimuth),
                                          std::sin(elevation));
                const double to_front = -eye_before_seat.x() / ray.x(),
                             to_seat = -eye_before_seat.z() / ray.z();
                const Eigen::Vector3d front = eye_before_seat + to_front * ray,
                                      top = eye_before_seat + to_seat * ray;
                const bool hits_front = front.z() <= 0.0 && front.z() > -height;
                const Eigen::Vector3d& hit = hits_front ? front : top;
                if (hit.x() < -1e-9 || hit.x() > 0.4 || hit.y() < 0.0 || hit.y() > 0.4) continue;
                points.emplace_back(hit + sigma_of_seat * random.gaussian() * ray);
                is_of_front.push_back(hits_front);
            }
        }
    }
    /// Of the points of the front, or else the seat, how many are no longer in the segment.
    [[nodiscard]] double split(bool front, const segments& left) const {
        double all = 0.0, off = 0.0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (is_of_front[i] != front) continue;
            all += 1.0;
            off += left.labels()[i] != 0 ? 1.0 : 0.0;
        }
        return off / all;
    }
    [[nodiscard]] segments parts() const { return segments(labels_of_one(points.size())); }
    [[nodiscard]] auto seen() const { return gnomon::with_viewpoint(points, eye_before_seat); }
};

TEST(split_outliers, splits_off_the_rim_and_keeps_the_plane) {
    double of_rim = 0.0;
    constexpr int seeds = 10;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const seat s(seed);
        const segments left = split_outliers(s.seen(), s.parts(), noise_of_seat);
        of_rim += s.split(true, left) / seeds;
        EXPECT_LE(s.split(false, left), 0.05) << seed;
    }
    EXPECT_GE(of_rim, 0.9);
}

/// Without view points noise is the same in all directions: points that are off by less may be
/// noise.
TEST(split_outliers, splits_off_fewer_points_without_view_points) {
    const seat s(1);
    EXPECT_LT(s.split(true, split_outliers(s.points, s.parts(), noise_of_seat)),
              s.split(true, split_outliers(s.seen(), s.parts(), noise_of_seat)) - 0.2);
}

/// Law: a plane, seen from anywhere, keeps 99 % of its points; the points of an object next to it
/// are split off.
TEST(split_outliers, keeps_planes) {
    gnomon::random_stream random(7);
    for (int round = 0; round < 20; ++round) {
        const Eigen::Vector3d from(3.0 * random.gaussian(), 3.0 * random.gaussian(),
                                   0.1 + std::abs(random.gaussian()));
        clouds::cloud points;
        for (int i = 0; i < 2000; ++i) {
            const Eigen::Vector3d p(random.uniform(), random.uniform(), 0.0);
            points.emplace_back(p + sigma_of_seat * random.gaussian() * (p - from).normalized());
        }
        for (int i = 0; i < 20; ++i)
            points.emplace_back(random.uniform(), -0.05, 0.1 + 0.05 * random.uniform());
        const auto labels = split_outliers(gnomon::with_viewpoint(points, from),
                                           segments(labels_of_one(2020)), noise_of_seat)
                                .labels();
        EXPECT_GE(std::count(labels.begin(), labels.end() - 20, 0), 1980) << round;
        EXPECT_EQ(std::count(labels.end() - 20, labels.end(), unlabeled), 20) << round;
    }
}

/// Three standard deviations are the limit: the noise, and what no surface is flatter than.
TEST(split_outliers, splits_off_what_is_beyond_three_deviations) {
    clouds::cloud points;
    for (int i = 0; i < 400; ++i) points.emplace_back(0.01 * (i % 20), 0.01 * (i / 20), 0.0);
    const double deviation = std::hypot(sigma_of_seat, gnomon::detail::flatness);
    points[210].z() = 2.9 * deviation;
    points[215].z() = -3.1 * deviation;
    const segments left = split_outliers(points, segments(labels_of_one(400)), noise_of_seat);
    EXPECT_EQ(left.labels()[210], 0);
    EXPECT_EQ(left.labels()[215], unlabeled);
    EXPECT_EQ(left[0].size(), 399u);
}

TEST(split_outliers, segments_that_are_not_flat_are_kept) {
    gnomon::random_stream random(3);
    clouds::cloud points;
    std::vector<std::int32_t> labels;
    for (int i = 0; i < 900; ++i) {  // 0: a ball, 1: two walls, 2: two points
        points.push_back(clouds::gaussian_vector(random));
        labels.push_back(0);
        const double u = random.uniform(), v = random.uniform();
        points.push_back(i % 2 == 0 ? Eigen::Vector3d(20.0 + u, v, 0.0)
                                    : Eigen::Vector3d(20.0, v, u));
        labels.push_back(1);
    }
    for (int i = 0; i < 2; ++i) {
        points.emplace_back(40.0, 0.0, 3.0 * i);
        labels.push_back(2);
    }
    const segments parts(labels);
    EXPECT_EQ(split_outliers(points, parts, noise_of_seat), parts);
}

/// The largest may be another after it.
TEST(split_outliers, segments_are_largest_first) {
    const seat s(1);
    clouds::cloud points = s.points;
    std::vector<std::int32_t> labels = labels_of_one(points.size());
    const std::size_t first = points.size();
    for (std::size_t i = 0; i + 5 < first; ++i) {  // elsewhere, flat, 5 fewer
        points.emplace_back(0.01 * static_cast<double>(i % 40),
                            3.0 + 0.01 * static_cast<double>(i / 40), 0.0);
        labels.push_back(1);
    }
    const segments left = split_outliers(gnomon::with_viewpoint(points, eye_before_seat),
                                         segments(labels), noise_of_seat);
    EXPECT_EQ(left.labels()[first], 0);
    EXPECT_EQ(*std::max_element(left.labels().begin(), left.labels().end()), 1);
}

TEST(split_outliers, depends_on_no_order_place_or_thread) {
    clouds::cloud all, eyes;
    std::vector<std::int32_t> labels;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {  // side by side
        for (const Eigen::Vector3d& p : seat(seed).points) {
            const Eigen::Vector3d aside(10.0 * static_cast<double>(seed), 0.0, 0.0);
            all.push_back(p + aside);
            eyes.push_back(eye_before_seat + aside);
            labels.push_back(static_cast<std::int32_t>(seed - 1));
        }
    }
    const auto points = gnomon::with_viewpoints(all, gnomon::viewpoint_table(eyes));
    const segments parts(labels);
    const auto expected = split_outliers(points, parts, noise_of_seat);
    EXPECT_GT(std::ranges::count(expected.labels(), unlabeled), 0);
    for (const unsigned n : {1u, 2u, 3u})
        EXPECT_EQ(split_outliers(points, parts, noise_of_seat, gnomon::threads{n}), expected);

    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const seat s(seed);
        const auto here = split_outliers(s.seen(), s.parts(), noise_of_seat).labels();
        const Eigen::Matrix3d r = clouds::random_rotation(seed);
        const Eigen::Vector3d by(6e5, 4.8e6, 100.0);
        auto moved = clouds::moved(s.points, r, by);
        std::reverse(moved.begin(), moved.end());
        auto there =
            split_outliers(gnomon::with_viewpoint(moved, Eigen::Vector3d(r * eye_before_seat + by)),
                           s.parts(), noise_of_seat)
                .labels();
        std::reverse(there.begin(), there.end());
        EXPECT_EQ(there, here);
    }
}

/// A second time hardly a point is split off.
TEST(split_outliers, is_nearly_idempotent) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const seat s(seed);
        const segments left = split_outliers(s.seen(), s.parts(), noise_of_seat);
        const segments again = split_outliers(s.seen(), left, noise_of_seat);
        EXPECT_LE(s.split(false, again) - s.split(false, left), 0.01);
        EXPECT_LE(s.split(true, again) - s.split(true, left), 0.05);
    }
}

TEST(split_outliers, takes_a_projection) {
    const seat s(1);
    std::vector<std::pair<int, Eigen::Vector3d>> named;
    for (const Eigen::Vector3d& p : s.points) named.emplace_back(7, p);
    const auto place = [](const auto& n) -> const Eigen::Vector3d& { return n.second; };
    EXPECT_EQ(split_outliers(named, s.parts(), noise_of_seat, gnomon::sequential{}, place),
              split_outliers(s.points, s.parts(), noise_of_seat));
}

TEST(split_outliers, accepts_degenerate_input) {
    const clouds::cloud one_place(50, Eigen::Vector3d(1, 2, 3));
    const segments one(labels_of_one(50));
    EXPECT_EQ(split_outliers(one_place, one, noise_of_seat), one);
    EXPECT_EQ(split_outliers(gnomon::with_viewpoint(one_place, one_place[0]), one, noise_of_seat),
              one);
    std::vector<std::int32_t> labels(50, unlabeled);
    labels[7] = 0, labels[8] = 2;  // and 1 is empty
    EXPECT_EQ(split_outliers(one_place, segments(labels), noise_of_seat).size(), 2u);
    // What is nowhere stays where it is, though it is off every plane.
    clouds::cloud slope;
    for (int i = 0; i < 400; ++i)
        slope.emplace_back(0.01 * (i % 20), 0.01 * (i / 20), 0.01 * (i % 20));
    slope.emplace_back(0.0, 0.0, std::numeric_limits<double>::infinity());
    const segments of_slope(labels_of_one(401));
    EXPECT_EQ(split_outliers(slope, of_slope, noise_of_seat), of_slope);
    for (const auto& [name, points] : clouds::degenerate()) {
        SCOPED_TRACE(name);
        const segments all(labels_of_one(points.size()));
        EXPECT_EQ(split_outliers(points, all, noise_of_seat).labels().size(), points.size());
    }
}

TEST(split_outliers, refuses_other_numbers_of_points) {
    const seat s(1);
    EXPECT_THROW((void)split_outliers(s.points, segments(labels_of_one(1)), noise_of_seat),
                 std::invalid_argument);
    EXPECT_THROW((void)split_outliers(s.points, segments(), noise_of_seat), std::invalid_argument);
}

}  // namespace
