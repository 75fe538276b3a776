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
#include <gnomon/core/angle.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/segmentation/assign_unlabeled.hpp>
#include <gnomon/segmentation/split_outliers.hpp>

namespace {

using gnomon::split_outliers, gnomon::segments, gnomon::unlabeled;

constexpr double noise_of_ranges = 0.015;
const Eigen::Vector3d eye_before_seat(-1.6, 0.2, 0.8);

struct element_of_surface {
    Eigen::Vector3d normal{0.0, 0.0, 0.0};  ///< none: what follows is of places alone, if not said
};

segments released_from(const auto& points, const segments& parts,
                       const gnomon::split_outliers_options& options = {}, const auto&... run) {
    const std::vector<element_of_surface> none(parts.labels().size());
    return split_outliers(points, none, parts, options, run...);
}

/// A seat, 40 cm wide, and the front of its board, 4 cm high, as a sensor in front of it sees them:
/// rays half a degree apart, with noise along them. All in one segment.
struct seat {
    std::vector<Eigen::Vector3d> points;
    std::vector<std::int32_t> labels;
    std::vector<bool> is_of_front;

    explicit seat(std::uint64_t seed) {
        gnomon::random_stream random(seed);
        constexpr double spacing = 0.01;  // of rays [rad]
        for (double elevation = -0.6; elevation < 0.0; elevation += spacing) {
            for (double azimuth = -0.3; azimuth < 0.3; azimuth += spacing) {
                const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth),
                                          std::cos(elevation) * std::sin(azimuth),
                                          std::sin(elevation));
                const double to_front = -eye_before_seat.x() / ray.x(),
                             to_seat = -eye_before_seat.z() / ray.z();
                const Eigen::Vector3d front = eye_before_seat + to_front * ray,
                                      top = eye_before_seat + to_seat * ray;
                const bool hits_front = front.z() <= 0.0 && front.z() > -0.04;
                const Eigen::Vector3d& hit = hits_front ? front : top;
                if (hit.x() < -1e-9 || hit.x() > 0.4 || hit.y() < 0.0 || hit.y() > 0.4) continue;
                points.emplace_back(hit + noise_of_ranges * random.gaussian() * ray);
                labels.push_back(0);
                is_of_front.push_back(hits_front);
            }
        }
    }
    /// Of the points of the front, or else the seat, how many are no longer in the segment.
    [[nodiscard]] double released(bool front, const segments& left) const {
        double all = 0.0, released = 0.0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (is_of_front[i] != front) continue;
            all += 1.0;
            released += left.labels()[i] != 0 ? 1.0 : 0.0;
        }
        return released / all;
    }
    [[nodiscard]] auto seen() const { return gnomon::with_viewpoint(points, eye_before_seat); }
};

TEST(split_outliers, splits_off_the_rim_and_keeps_the_plane) {
    double of_rim = 0.0;
    constexpr int seeds = 10;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const seat s(seed);
        const segments left = released_from(s.seen(), segments(s.labels));
        of_rim += s.released(true, left) / seeds;
        EXPECT_LE(s.released(false, left), 0.05) << seed;
    }
    EXPECT_GE(of_rim, 0.75);
}

/// Most of the rim is not far enough off, each point for itself.
TEST(split_outliers, means_of_residuals_detect_more_than_single_residuals) {
    double by_mean = 0.0, by_itself = 0.0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const seat s(seed);
        by_mean += s.released(true, released_from(s.seen(), segments(s.labels)));
        by_itself +=
            s.released(true, released_from(s.seen(), segments(s.labels), {.max_distance = 0.0}));
    }
    EXPECT_GE(by_mean, by_itself + 1.0);
}

/// Without view points noise is the same in all directions: what is off by less may be noise.
TEST(split_outliers, splits_off_fewer_points_without_view_points) {
    const seat s(1);
    const segments parts(s.labels);
    EXPECT_LT(s.released(true, released_from(s.points, parts)),
              s.released(true, released_from(s.seen(), parts)) - 0.2);
}

/// Law: a plane, seen from anywhere, keeps 99 % of its points; the points of an object next to it
/// are split off.
TEST(split_outliers, keeps_planes) {
    gnomon::random_stream random(7);
    for (int round = 0; round < 20; ++round) {
        const Eigen::Vector3d from(3.0 * random.gaussian(), 3.0 * random.gaussian(),
                                   0.1 + std::abs(random.gaussian()));
        std::vector<Eigen::Vector3d> points;
        for (int i = 0; i < 2000; ++i) {
            const Eigen::Vector3d p(random.uniform(), random.uniform(), 0.0);
            points.emplace_back(p + noise_of_ranges * random.gaussian() * (p - from).normalized());
        }
        for (int i = 0; i < 20; ++i)
            points.emplace_back(random.uniform(), -0.05, 0.1 + 0.05 * random.uniform());
        const auto labels = released_from(gnomon::with_viewpoint(points, from),
                                          segments(std::vector<std::int32_t>(2020, 0)))
                                .labels();
        EXPECT_GE(std::count(labels.begin(), labels.end() - 20, 0), 1980) << round;
        EXPECT_EQ(std::count(labels.end() - 20, labels.end(), unlabeled), 20) << round;
    }
}

/// A box on a table whose foot is round, so that a segmentation by normals climbs it.
TEST(split_outliers, connected_outliers_are_a_segment) {
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 40; ++i)
        for (int j = 0; j < 40; ++j) points.emplace_back(0.01 * i, 0.01 * j, 0.0);
    for (int i = 0; i < 10; ++i)
        for (int j = 0; j < 10; ++j) points.emplace_back(0.2, 0.15 + 0.01 * i, 0.01 * (j + 1));
    const segments parts(std::vector<std::int32_t>(points.size(), 0));
    const segments left = released_from(points, parts, {.sigma = 0.008});
    ASSERT_EQ(left.size(), 2u);
    EXPECT_LE(left[0].size(), 1620u);
    EXPECT_GE(left[1].size(), 80u);
    EXPECT_EQ(released_from(points, parts, {.sigma = 0.008, .min_points = 101}).size(), 1u);
    EXPECT_EQ(released_from(points, parts, {.sigma = 0.008, .max_distance = 0.005}).size(), 1u);
    // Of two segments, each is one for itself.
    std::vector<std::int32_t> labels(points.size(), 0);
    for (std::size_t i = 0; i < points.size(); ++i) labels[i] = points[i].y() < 0.195 ? 0 : 1;
    EXPECT_EQ(released_from(points, segments(labels), {.sigma = 0.008}).size(), 4u);
}

/// Among points of the plane, one that is far off goes alone.
TEST(split_outliers, isolated_outliers_become_unlabeled) {
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 400; ++i) points.emplace_back(0.01 * (i % 20), 0.01 * (i / 20), 0.0);
    points[210].z() = 4.9 * noise_of_ranges;
    points[215].z() = -5.1 * noise_of_ranges;
    const segments left = released_from(points, segments(std::vector<std::int32_t>(400, 0)));
    EXPECT_EQ(left.labels()[210], 0);
    EXPECT_EQ(left.labels()[215], unlabeled);
    EXPECT_EQ(left[0].size(), 399u);
}

/// An outlier, at any distance, does not change the mean residual of its neighbors.
TEST(split_outliers, no_neighbor_decides_alone) {
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 400; ++i) points.emplace_back(0.2 * (i % 20), 0.2 * (i / 20), 0.0);
    std::vector<std::int32_t> labels(400, 0);
    points.emplace_back(2.0, 2.0, 0.19);  // unlabeled
    labels.push_back(unlabeled);
    EXPECT_EQ(released_from(points, segments(labels)).labels(), labels);
}

/// A floor that is warped: what is off its plane by more than noise has a normal like it.
TEST(split_outliers, points_with_the_normal_of_the_plane_stay) {
    std::vector<Eigen::Vector3d> points;
    std::vector<element_of_surface> surface;
    for (int i = 0; i < 60; ++i) {
        for (int j = 0; j < 60; ++j) {
            points.emplace_back(0.05 * i, 0.05 * j, 0.026 * std::cos(0.1 * i));
            surface.push_back({Eigen::Vector3d(0.052 * std::sin(0.1 * i), 0.0, 1.0).normalized()});
        }
    }
    const segments parts(std::vector<std::int32_t>(3600, 0));
    EXPECT_EQ(split_outliers(points, surface, parts), parts);
    EXPECT_NE(released_from(points, parts), parts) << "without normals";
    for (element_of_surface& e : surface) e.normal *= -1.0;
    EXPECT_EQ(split_outliers(points, surface, parts), parts);
    // At most a right angle off are all normals, but not those that are missing.
    EXPECT_NE(released_from(points, parts, {.max_angle = gnomon::degrees(90)}), parts);
}

TEST(split_outliers, thick_segments_and_warped_ones_are_kept) {
    gnomon::random_stream random(3);
    std::vector<Eigen::Vector3d> points;
    std::vector<std::int32_t> labels;
    for (int i = 0; i < 900; ++i) {  // 0: a ball
        points.emplace_back(random.gaussian(), random.gaussian(), random.gaussian());
        labels.push_back(0);
    }
    for (int i = 0; i < 30; ++i) {  // 1: a chessboard of two heights, seen at oblique incidence
        for (int j = 0; j < 30; ++j) {
            const double height =
                (i / 5 + j / 5) % 2 == 0 ? 0.7 * noise_of_ranges : -0.7 * noise_of_ranges;
            points.emplace_back(10.0 + 0.01 * i, 0.01 * j, height);
            labels.push_back(1);
        }
    }
    const segments parts(labels);
    EXPECT_EQ(released_from(gnomon::with_viewpoint(points, Eigen::Vector3d(0, 0, 0.5)), parts),
              parts);
}

/// The largest may be another after it.
TEST(split_outliers, segments_are_largest_first) {
    const seat s(1);
    std::vector<Eigen::Vector3d> points = s.points;
    std::vector<std::int32_t> labels = s.labels;
    const std::size_t first = points.size();
    for (std::size_t i = 0; i + 20 < first; ++i) {  // elsewhere, flat, 20 fewer
        points.emplace_back(0.01 * static_cast<double>(i % 40),
                            3.0 + 0.01 * static_cast<double>(i / 40), 0.0);
        labels.push_back(1);
    }
    const segments left = released_from(gnomon::with_viewpoint(points, eye_before_seat),
                                        segments(labels), {.min_points = 1000});
    EXPECT_EQ(left.labels()[first], 0);
    EXPECT_EQ(*std::max_element(left.labels().begin(), left.labels().end()), 1);
}

TEST(split_outliers, depends_on_no_order_place_or_thread) {
    seat many(1);
    const auto of_one = static_cast<std::ptrdiff_t>(many.points.size());
    for (std::uint64_t seed = 2; seed <= 40; ++seed) {
        const seat s(seed);
        many.points.insert(many.points.end(), s.points.begin(), s.points.end());
        many.labels.insert(many.labels.end(), s.labels.size(), static_cast<std::int32_t>(seed - 1));
    }
    for (std::size_t i = 0; i < many.points.size(); ++i)  // side by side
        many.points[i] += 10.0 * many.labels[i] * Eigen::Vector3d::UnitX();
    const segments parts(many.labels);
    const auto expected = released_from(many.points, parts).labels();
    EXPECT_GT(std::count(expected.begin(), expected.begin() + of_one, unlabeled), 0);
    for (const unsigned n : {2u, 4u})
        EXPECT_EQ(released_from(many.points, parts, {}, gnomon::threads{n}).labels(), expected);

    const seat s(5);
    const auto here = released_from(s.seen(), segments(s.labels)).labels();
    seat moved = s;
    std::reverse(moved.points.begin(), moved.points.end());
    const Eigen::Vector3d by(1024.0, -512.0, 256.0);
    for (Eigen::Vector3d& p : moved.points) p += by;
    auto labels = released_from(gnomon::with_viewpoint(moved.points, eye_before_seat + by),
                                segments(s.labels))
                      .labels();
    std::reverse(labels.begin(), labels.end());
    EXPECT_EQ(labels, here);
}

/// Strips of floor and of the adjacent wall, in two segments, seen at oblique incidence: the
/// normals at the edge are averages of both, but points of one segment are no evidence for the
/// other.
TEST(split_outliers, uses_no_points_of_other_segments) {
    std::vector<Eigen::Vector3d> points;
    std::vector<std::int32_t> labels;
    for (int i = 0; i < 40; ++i) {
        for (int j = 0; j < 20; ++j) {
            points.emplace_back(0.05 * i, 0.38 - 0.05 * j, 0.0);
            labels.push_back(0);
        }
        for (int j = 0; j < 10; ++j) {
            points.emplace_back(0.05 * i, 0.4, 0.03 + 0.01 * j);
            labels.push_back(1);
        }
    }
    const auto seen = gnomon::with_viewpoint(points, Eigen::Vector3d(0.4, -3.0, 0.5));
    const segments parts(labels);
    EXPECT_EQ(released_from(seen, parts), parts);
}

/// What was released is not claimed again, and a second time next to nothing is.
TEST(split_outliers, agrees_with_assign_unlabeled) {
    double back = 0.0, second = 0.0;
    constexpr int seeds = 10;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const seat s(seed);
        const segments left = released_from(s.seen(), segments(s.labels), {.min_points = 1000});
        const segments again = released_from(s.seen(), left, {.min_points = 1000});
        back += s.released(true, left) - s.released(true, gnomon::assign_unlabeled(s.seen(), left));
        second += s.released(false, again) - s.released(false, left);
    }
    EXPECT_LE(back / seeds, 0.15);
    EXPECT_LE(second / seeds, 0.02);
}

TEST(split_outliers, takes_a_projection) {
    const seat s(1);
    std::vector<std::pair<int, Eigen::Vector3d>> named;
    for (const Eigen::Vector3d& p : s.points) named.emplace_back(7, p);
    const auto place = [](const auto& n) -> const Eigen::Vector3d& { return n.second; };
    const std::vector<element_of_surface> none(s.labels.size());
    EXPECT_EQ(split_outliers(named, none, segments(s.labels), {}, gnomon::sequential{}, place),
              released_from(s.points, segments(s.labels)));
}

TEST(split_outliers, accepts_degenerate_input) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(released_from(std::vector<Eigen::Vector3d>{}, segments()).empty());
    const segments one(std::vector<std::int32_t>(50, 0));
    const std::vector<Eigen::Vector3d> holes(50, Eigen::Vector3d(nan, 0, 0));
    EXPECT_EQ(released_from(holes, one).labels(), one.labels());
    const std::vector<Eigen::Vector3d> one_place(50, Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(released_from(one_place, one).labels(), one.labels());
    EXPECT_EQ(
        released_from(gnomon::with_viewpoint(one_place, Eigen::Vector3d(1, 2, 3)), one).labels(),
        one.labels());
    std::vector<std::int32_t> labels(50, unlabeled);
    labels[7] = 0, labels[8] = 2;  // and 1 is empty
    EXPECT_EQ(released_from(one_place, segments(labels)).size(), 2u);
    // What is nowhere stays where it is, though it is off every plane.
    std::vector<Eigen::Vector3d> slope;
    for (int i = 0; i < 400; ++i)
        slope.emplace_back(0.01 * (i % 20), 0.01 * (i / 20), 0.01 * (i % 20));
    slope.emplace_back(0.0, 0.0, std::numeric_limits<double>::infinity());
    const segments of_slope(std::vector<std::int32_t>(401, 0));
    EXPECT_EQ(released_from(slope, of_slope), of_slope);
    for (const auto& [name, points] : clouds::degenerate()) {
        SCOPED_TRACE(name);
        const segments all(std::vector<std::int32_t>(points.size(), 0));
        EXPECT_EQ(released_from(points, all).labels().size(), points.size());
        EXPECT_EQ(assign_unlabeled(points, all).labels(), all.labels());
    }
}

TEST(split_outliers, refuses_bad_parameters) {
    const seat s(1);
    const auto refused = [&](const gnomon::split_outliers_options& o) {
        EXPECT_THROW(static_cast<void>(released_from(s.points, segments(s.labels), o)),
                     std::invalid_argument);
    };
    refused({.sigma = 0.0});
    refused({.sigma = std::numeric_limits<double>::quiet_NaN()});
    refused({.k = 0});
    refused({.max_distance = -1.0});
    refused({.max_angle = gnomon::degrees(91)});
    EXPECT_THROW(static_cast<void>(released_from(s.points, segments(std::vector<std::int32_t>{0}))),
                 std::invalid_argument);
}

}  // namespace
