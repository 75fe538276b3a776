// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core/execution.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/segmentation/assign_unlabeled.hpp>

namespace {

using gnomon::assign_unlabeled, gnomon::segments, gnomon::unlabeled;

constexpr double noise_of_sheets = 0.01;
constexpr gnomon::assign_unlabeled_options claiming{.sigma = noise_of_sheets};

/// Points with noise across the planes they are of, and a label for each.
struct cloud {
    std::vector<Eigen::Vector3d> points;
    std::vector<std::int32_t> labels;
    gnomon::random_stream random{1};

    /// A grid in the plane z = height, 1 cm wide, from (x, y) on.
    void add_sheet(double x, double y, std::size_t columns, std::size_t rows, double height,
                   std::int32_t label) {
        for (std::size_t i = 0; i < columns; ++i) {
            for (std::size_t j = 0; j < rows; ++j) {
                const double z = height + noise_of_sheets * random.gaussian();
                points.emplace_back(x + 0.01 * static_cast<double>(i),
                                    y + 0.01 * static_cast<double>(j), z);
                labels.push_back(label);
            }
        }
    }
    [[nodiscard]] segments claimed(const gnomon::assign_unlabeled_options& o = claiming) const {
        return assign_unlabeled(points, segments(labels), o);
    }
    /// The share of the points from `first` on that have a label.
    [[nodiscard]] static double share(const std::vector<std::int32_t>& labels, std::size_t first,
                                      std::size_t last, std::int32_t label) {
        const auto begin = labels.begin() + static_cast<std::ptrdiff_t>(first);
        const auto end = labels.begin() + static_cast<std::ptrdiff_t>(last);
        return static_cast<double>(std::count(begin, end, label)) /
               static_cast<double>(last - first);
    }
};

TEST(assign_unlabeled, assigns_points_adjacent_to_a_plane) {
    cloud c;
    c.add_sheet(0.0, 0.0, 60, 60, 0.0, 0);
    const std::size_t first = c.points.size();
    c.add_sheet(0.6, 0.0, 40, 60, 0.0, unlabeled);  // farther than any one step
    const segments found = c.claimed();
    EXPECT_EQ(found.size(), 1u);
    EXPECT_GE(cloud::share(found.labels(), first, c.points.size(), 0), 0.97);
}

/// The points of a thin board's rim are within three deviations of its face, but their mean is not.
TEST(assign_unlabeled, skips_points_whose_mean_is_off_the_plane) {
    cloud c;
    c.add_sheet(0.0, 0.0, 60, 60, 0.0, 0);
    const std::size_t first = c.points.size();
    c.add_sheet(0.6, 0.0, 20, 60, -1.5 * noise_of_sheets, unlabeled);
    EXPECT_LE(cloud::share(c.claimed().labels(), first, c.points.size(), 0), 0.05);
}

/// A tenth of the noise is forgiven: of thousands of points the mean is known better than any wall
/// is flat.
TEST(assign_unlabeled, many_points_need_not_be_on_the_plane_exactly) {
    cloud c;
    c.add_sheet(0.0, 0.0, 60, 60, 0.0, 0);
    const std::size_t first = c.points.size();
    for (int layer = 0; layer < 30; ++layer)
        c.add_sheet(0.3, 0.3, 10, 10, 0.12 * noise_of_sheets, unlabeled);
    EXPECT_GE(cloud::share(c.claimed().labels(), first, c.points.size(), 0), 0.97);
}

/// Noise is along the rays: at oblique incidence its component across a plane is smaller, and so is
/// the distance within which points are assigned.
TEST(assign_unlabeled, has_a_smaller_threshold_at_oblique_incidence) {
    cloud c;
    c.add_sheet(0.0, 0.0, 60, 60, 0.0, 0);
    for (Eigen::Vector3d& p : c.points) p.z() *= 0.5;
    const std::size_t first = c.points.size();
    for (int i = 0; i < 5; ++i) {  // here and there one that is off by two deviations of a range
        c.points.emplace_back(0.12 * i, 0.3, 0.02);
        c.labels.push_back(unlabeled);
    }
    const auto share_from = [&](const Eigen::Vector3d& eye) {
        const auto found =
            assign_unlabeled(gnomon::with_viewpoint(c.points, eye), segments(c.labels), claiming);
        return cloud::share(found.labels(), first, c.points.size(), 0);
    };
    EXPECT_EQ(share_from({0.3, 0.3, 50.0}), 1.0);
    EXPECT_EQ(share_from({50.0, 0.3, 5.0}), 0.0);
}

/// Two points of one cube, one just within three deviations: their mean is not, so there is no
/// evidence that they belong to the plane.
TEST(assign_unlabeled, assigns_nothing_without_evidence) {
    cloud c;
    for (int i = 0; i < 30; ++i) {
        for (int j = 0; j < 30; ++j) {
            c.points.emplace_back(0.01 * i, 0.01 * j, 0.005);
            c.labels.push_back(0);
        }
    }
    for (const double z : {0.0345, 0.0370}) {  // 2.95 and 3.2 deviations above
        c.points.emplace_back(0.152, 0.152, z);
        c.labels.push_back(unlabeled);
    }
    EXPECT_EQ(cloud::share(c.claimed().labels(), 900, 902, unlabeled), 1.0);
}

TEST(assign_unlabeled, gives_each_to_the_nearest_plane) {
    cloud c;
    c.add_sheet(0.0, 0.0, 50, 60, 0.0, 0);
    c.add_sheet(1.0, 0.0, 50, 60, 2.0 * noise_of_sheets, 1);
    const std::size_t first = c.points.size();
    c.add_sheet(0.5, 0.0, 20, 60, 0.0, unlabeled);
    const std::size_t second = c.points.size();
    c.add_sheet(0.8, 0.0, 20, 60, 2.0 * noise_of_sheets, unlabeled);
    const segments found = c.claimed();
    EXPECT_GE(cloud::share(found.labels(), first, second, found.labels().front()), 0.8);
    EXPECT_GE(cloud::share(found.labels(), second, c.points.size(), found.labels()[3000]), 0.8);
}

TEST(assign_unlabeled, takes_nothing_from_a_segment) {
    cloud c;
    c.add_sheet(0.0, 0.0, 40, 40, 0.0, 1);
    c.add_sheet(0.4, 0.0, 20, 40, 0.0, 0);
    c.add_sheet(0.2, 0.4, 40, 10, 0.0, unlabeled);
    const segments found = c.claimed();
    ASSERT_EQ(found.size(), 2u);
    EXPECT_GE(found[0].size(), found[1].size());
    for (std::size_t i = 0; i < c.points.size(); ++i) {
        if (c.labels[i] == unlabeled) continue;
        EXPECT_EQ(found.labels()[i] == 0, c.labels[i] == 1);
    }
}

TEST(assign_unlabeled, ignores_thick_and_distant_segments) {
    cloud c;
    c.add_sheet(0.0, 0.0, 40, 20, 0.0, 0);
    c.add_sheet(0.0, 0.2, 40, 20, 10.0 * noise_of_sheets, 0);  // no plane
    c.add_sheet(2.0, 0.0, 40, 40, 0.0, 1);
    c.add_sheet(0.4, 0.0, 40, 40, 0.0, unlabeled);  // 1.2 m from it
    EXPECT_EQ(c.claimed(), assign_unlabeled(c.points, c.claimed(), claiming));
    EXPECT_EQ(cloud::share(c.claimed().labels(), 3200, 4800, unlabeled), 1.0);
    c.add_sheet(2.8, 0.1, 3, 3, 0.0, unlabeled);  // 9 points: 0.4 m is adjacent
    EXPECT_EQ(cloud::share(c.claimed().labels(), 4800, 4809, unlabeled), 1.0);
    EXPECT_EQ(cloud::share(c.claimed({.sigma = noise_of_sheets, .max_distance = 0.5}).labels(),
                           4800, 4809, 0),
              1.0);
}

/// The order of points and their place change nothing, nor the number of threads.
TEST(assign_unlabeled, depends_on_no_order_place_or_thread) {
    cloud c;
    c.add_sheet(0.0, 0.0, 30, 60, 0.0, 0);
    c.add_sheet(0.3, 0.0, 30, 60, 0.0, unlabeled);
    c.add_sheet(0.6, 0.0, 20, 60, 1.5 * noise_of_sheets, unlabeled);
    c.add_sheet(0.8, 0.0, 20, 60, 1.5 * noise_of_sheets, 1);
    const auto expected = c.claimed().labels();
    for (const unsigned n : {2u, 4u}) {
        EXPECT_EQ(
            assign_unlabeled(c.points, segments(c.labels), claiming, gnomon::threads{n}).labels(),
            expected);
    }
    cloud reversed = c;
    std::reverse(reversed.points.begin(), reversed.points.end());
    std::reverse(reversed.labels.begin(), reversed.labels.end());
    auto labels = reversed.claimed().labels();
    std::reverse(labels.begin(), labels.end());
    EXPECT_EQ(labels, expected);

    // But for what is nearly as likely as not: strays are judged in cubes that do not turn.
    for (Eigen::Vector3d& p : c.points)
        p = Eigen::Vector3d(-p.y() + 512.0, p.x() - 256.0, p.z() + 1024.0);
    const auto turned = c.claimed().labels();
    std::size_t differ = 0;
    for (std::size_t i = 0; i < turned.size(); ++i) differ += turned[i] != expected[i] ? 1 : 0;
    EXPECT_LE(differ, turned.size() / 500);
}

/// Moved so that nothing is rounded, not one point is judged otherwise.
TEST(assign_unlabeled, is_the_same_anywhere) {
    cloud c;
    c.add_sheet(0.0, 0.0, 60, 60, 0.0, 0);
    c.add_sheet(0.6, 0.0, 40, 60, 1.0 * noise_of_sheets, unlabeled);
    for (Eigen::Vector3d& p : c.points)
        for (int a = 0; a < 3; ++a) p[a] = std::round(p[a] * 65536.0) / 65536.0;
    const auto here = c.claimed().labels();
    for (const Eigen::Vector3d& by : {Eigen::Vector3d(0.3125, 0.0078125, -0.0625),
                                      Eigen::Vector3d(524288.296875, 4194304.5, 0.25)}) {
        cloud moved = c;
        for (Eigen::Vector3d& p : moved.points) p += by;
        EXPECT_EQ(moved.claimed().labels(), here);
    }
}

TEST(assign_unlabeled, accepts_degenerate_input) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<Eigen::Vector3d> none;
    EXPECT_TRUE(assign_unlabeled(none, segments()).empty());
    const std::vector<Eigen::Vector3d> holes(50, Eigen::Vector3d(nan, 0, 0));
    EXPECT_EQ(assign_unlabeled(holes, segments(std::vector<std::int32_t>(50, unlabeled))).size(),
              0u);
    const std::vector<Eigen::Vector3d> one_place(5000, Eigen::Vector3d(1, 2, 3));
    std::vector<std::int32_t> labels(5000, unlabeled);
    EXPECT_EQ(assign_unlabeled(one_place, segments(labels)).size(), 0u);
    labels[7] = 0, labels[8] = 2;  // and 1 is empty
    EXPECT_NO_THROW(static_cast<void>(assign_unlabeled(one_place, segments(labels))));
}

/// A stray at a time, each the neighbor of the one before: as many rounds as strays.
TEST(assign_unlabeled, a_long_thin_tail_takes_no_long_time) {
    cloud c;
    c.add_sheet(0.0, 0.0, 30, 30, 0.0, 0);
    for (Eigen::Vector3d& p : c.points) p.z() = 0.0;
    for (int i = 0; i < 50'000; ++i) {
        c.points.emplace_back(0.3 + 0.01 * i, 0.15, 0.0);
        c.labels.push_back(unlabeled);
    }
    const auto found = c.claimed({.sigma = noise_of_sheets, .k = 2});
    EXPECT_EQ(cloud::share(found.labels(), 900, c.points.size(), 0), 1.0);
}

TEST(assign_unlabeled, refuses_bad_parameters) {
    cloud c;
    c.add_sheet(0.0, 0.0, 3, 3, 0.0, 0);
    const auto refused = [&](const gnomon::assign_unlabeled_options& o) {
        EXPECT_THROW(static_cast<void>(c.claimed(o)), std::invalid_argument);
    };
    refused({.sigma = 0.0});
    refused({.sigma = std::numeric_limits<double>::quiet_NaN()});
    refused({.k = 0});
    refused({.max_distance = -1.0});
    EXPECT_THROW(
        static_cast<void>(assign_unlabeled(c.points, segments(std::vector<std::int32_t>{0}))),
        std::invalid_argument);
}

}  // namespace
