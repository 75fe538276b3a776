// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/partitions.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/segmentation/assign_unlabeled.hpp>

namespace {

using gnomon::assign_unlabeled, gnomon::knn, gnomon::segments, gnomon::unlabeled;

constexpr double sigma_of_sheet = 0.01;
const gnomon::noise_curve noise_of_sheet = gnomon::constant_noise{sigma_of_sheet};

/// Points with noise across the planes they are of, and a label for each.
struct cloud {
    clouds::cloud points;
    std::vector<std::int32_t> labels;
    gnomon::random_stream random{1};

    void add(const Eigen::Vector3d& p, std::int32_t label) {
        points.push_back(p);
        labels.push_back(label);
    }
    /// A grid in the plane z = height, 1 cm wide, from (x, y) on.
    void add_sheet(double x, double y, int columns, int rows, double height, std::int32_t label) {
        for (int i = 0; i < columns; ++i)
            for (int j = 0; j < rows; ++j)
                add({x + 0.01 * i, y + 0.01 * j, height + sigma_of_sheet * random.gaussian()},
                    label);
    }
    template <gnomon::execution X = gnomon::sequential>
    [[nodiscard]] segments assigned(const X& run = {}) const {
        return assign_unlabeled(points, knn{.k = 20}(points), segments(labels), noise_of_sheet,
                                run);
    }
};

/// The share of the points from `first` on, and before `last`, that have a label.
double share(const std::vector<std::int32_t>& labels, std::size_t first, std::size_t last,
             std::int32_t label) {
    const auto begin = labels.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = labels.begin() + static_cast<std::ptrdiff_t>(last);
    return static_cast<double>(std::count(begin, end, label)) / static_cast<double>(last - first);
}

/// Two walls at a right angle, and a strip next to their edge that no segment has.
struct edge : cloud {
    std::vector<std::int32_t> truth;

    explicit edge(std::uint64_t seed) {
        random = gnomon::random_stream(seed);
        for (const std::int32_t wall : {0, 1}) {
            for (int i = 0; i < 2500; ++i) {
                const double u = random.uniform(), v = random.uniform();
                const double e = sigma_of_sheet * random.gaussian();
                add(wall == 0 ? Eigen::Vector3d(u, v, e) : Eigen::Vector3d(e, v, u),
                    u < 0.08 ? unlabeled : wall);
                truth.push_back(wall);
            }
        }
    }
};

TEST(assign_unlabeled, assigns_the_points_of_an_edge_to_the_right_sides) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const edge e(seed);
        const auto found = e.assigned();
        ASSERT_EQ(found.size(), 2u);
        EXPECT_GE(laws::rand_index(found.labels(), e.truth), 0.95);
        EXPECT_LE(share(found.labels(), 0, e.points.size(), unlabeled), 0.01);
    }
}

/// What a segmentation by normals gave to the wrong side comes to the right one.
TEST(assign_unlabeled, moves_points_between_segments) {
    edge e(3);
    for (std::size_t i = 0; i < e.points.size(); ++i)
        e.labels[i] = e.points[i].z() < 0.05 ? 0 : 1;  // a part of wall 1 with wall 0
    const auto found = e.assigned();
    EXPECT_GT(laws::rand_index(found.labels(), e.truth), laws::rand_index(e.labels, e.truth));
    EXPECT_GE(laws::rand_index(found.labels(), e.truth), 0.95);
}

TEST(assign_unlabeled, gives_each_to_the_nearest_plane) {
    cloud c;
    c.add_sheet(0.0, 0.0, 50, 60, 0.0, 0);
    c.add_sheet(0.8, 0.0, 50, 60, 6.0 * sigma_of_sheet, 1);
    const std::size_t first = c.points.size();
    c.add_sheet(0.5, 0.0, 4, 60, 0.0, unlabeled);
    const std::size_t second = c.points.size();
    c.add_sheet(0.76, 0.0, 4, 60, 6.0 * sigma_of_sheet, unlabeled);
    const segments found = c.assigned();
    EXPECT_GE(share(found.labels(), first, second, found.labels().front()), 0.97);
    EXPECT_GE(share(found.labels(), second, c.points.size(), found.labels()[3000]), 0.97);
}

/// Three standard deviations are the limit, of a surface that is as rough as the noise.
TEST(assign_unlabeled, leaves_points_beyond_three_deviations) {
    cloud c;
    c.add_sheet(0.0, 0.0, 60, 60, 0.0, 0);
    const double deviation = std::hypot(sigma_of_sheet, gnomon::detail::flatness);
    for (const double deviations : {2.7, 3.4})
        for (int i = 0; i < 5; ++i)
            c.add({0.105 + 0.1 * i, 0.305, deviations * deviation}, unlabeled);
    const auto labels = c.assigned().labels();
    EXPECT_EQ(share(labels, 3600, 3605, 0), 1.0);
    EXPECT_EQ(share(labels, 3605, 3610, unlabeled), 1.0);
}

/// Noise is along the rays: at oblique incidence its component across a plane is smaller, and so is
/// the distance within which points are assigned.
TEST(assign_unlabeled, has_a_smaller_threshold_at_oblique_incidence) {
    cloud c;
    c.add_sheet(0.0, 0.0, 60, 60, 0.0, 0);
    for (Eigen::Vector3d& p : c.points) p.z() *= 0.3;
    for (int i = 0; i < 5; ++i) c.add({0.12 * i, 0.3, 2.0 * sigma_of_sheet}, unlabeled);
    const auto share_from = [&](const Eigen::Vector3d& eye) {
        const auto seen = gnomon::with_viewpoint(c.points, eye);
        const auto found =
            assign_unlabeled(seen, knn{.k = 20}(c.points), segments(c.labels), noise_of_sheet);
        return share(found.labels(), 3600, 3605, 0);
    };
    EXPECT_EQ(share_from({0.3, 0.3, 50.0}), 1.0);
    EXPECT_EQ(share_from({50.0, 0.3, 5.0}), 0.0);
}

TEST(assign_unlabeled, assigns_nothing_to_what_is_not_adjacent) {
    cloud c;
    c.add_sheet(0.0, 0.0, 40, 40, 0.0, 0);
    c.add_sheet(1.0, 0.0, 40, 40, 0.0, unlabeled);
    EXPECT_EQ(share(c.assigned().labels(), 1600, 3200, unlabeled), 1.0);
}

/// A segment that is not flat keeps its points, and as it has no plane, takes what touches it.
TEST(assign_unlabeled, keeps_segments_that_are_not_flat) {
    cloud c;
    for (int i = 0; i < 2000; ++i)
        c.add(clouds::gaussian_vector(c.random).normalized(), 0);  // a ball
    const segments found = c.assigned();
    EXPECT_EQ(found.labels(), c.labels);
}

TEST(assign_unlabeled, is_the_same_for_every_execution) {
    const edge e(7);
    const segments expected = e.assigned();
    for (const unsigned t : {1u, 2u, 3u}) EXPECT_EQ(e.assigned(gnomon::threads{t}), expected);
}

/// As partitions, but for points between two planes that explain them equally well.
TEST(assign_unlabeled, partition_survives_permutation_and_rigid_motion) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const edge e(seed);
        const auto expected = e.assigned().labels();
        std::vector<std::size_t> order;
        cloud shuffled;
        shuffled.points = clouds::permuted(e.points, seed, order);
        for (const std::size_t i : order) shuffled.labels.push_back(e.labels[i]);
        const auto labels = shuffled.assigned().labels();
        std::vector<std::int32_t> restored(order.size());
        for (std::size_t i = 0; i < order.size(); ++i) restored[order[i]] = labels[i];
        EXPECT_GT(laws::rand_index(restored, expected), 0.9995);
        for (const Eigen::Vector3d& by : {Eigen::Vector3d(5, -3, 9), {6e5, 4.8e6, 100.0}}) {
            cloud moved = e;
            moved.points = clouds::moved(e.points, clouds::random_rotation(seed), by);
            EXPECT_GT(laws::rand_index(moved.assigned().labels(), expected), 0.9995);
        }
    }
}

TEST(assign_unlabeled, segments_are_largest_first) {
    cloud c;
    c.add_sheet(0.0, 0.0, 30, 40, 0.0, 0);
    c.add_sheet(1.0, 0.0, 29, 40, 0.0, 1);
    c.add_sheet(1.29, 0.0, 4, 40, 0.0, unlabeled);
    const segments found = c.assigned();
    ASSERT_EQ(found.size(), 2u);
    EXPECT_GE(found[0].size(), found[1].size());
    EXPECT_EQ(found.labels()[1200], 0) << "it has become the largest";
}

TEST(assign_unlabeled, takes_a_projection) {
    const edge e(2);
    std::vector<std::pair<int, Eigen::Vector3d>> named;
    for (const Eigen::Vector3d& p : e.points) named.emplace_back(7, p);
    const auto place = [](const auto& n) -> const Eigen::Vector3d& { return n.second; };
    EXPECT_EQ(assign_unlabeled(named, knn{.k = 20}(e.points), segments(e.labels), noise_of_sheet,
                               gnomon::sequential{}, place),
              e.assigned());
}

TEST(assign_unlabeled, survives_every_cloud) {
    for (const auto& [name, points] : clouds::degenerate()) {
        SCOPED_TRACE(name);
        const auto graph = knn{.k = 20}(points);
        for (const std::int32_t groups : {1, 3}) {
            std::vector<std::int32_t> labels(points.size());
            std::iota(labels.begin(), labels.end(), 0);
            for (std::int32_t& l : labels) l = 2 * (l % groups) - 1;  // some numbers have no points
            for (std::int32_t& l : labels) l = std::max(l, unlabeled);
            const auto found = assign_unlabeled(points, graph, segments(labels), noise_of_sheet);
            ASSERT_EQ(found.labels().size(), points.size());
            EXPECT_LE(found.size(), segments(labels).size());
        }
    }
}

TEST(assign_unlabeled, refuses_other_numbers_of_points) {
    cloud c;
    c.add_sheet(0.0, 0.0, 5, 5, 0.0, 0);
    const auto fewer = clouds::in_cube(7, 1);
    const auto graph = knn{.k = 5}(c.points);
    const segments parts(c.labels);
    EXPECT_THROW((void)assign_unlabeled(c.points, graph, segments(), noise_of_sheet),
                 std::invalid_argument);
    EXPECT_THROW((void)assign_unlabeled(c.points, knn{.k = 5}(fewer), parts, noise_of_sheet),
                 std::invalid_argument);
    EXPECT_THROW((void)assign_unlabeled(fewer, graph, parts, noise_of_sheet),
                 std::invalid_argument);
    const std::vector<std::vector<gnomon::point_index>> astray(c.points.size(), {1000});
    EXPECT_THROW((void)assign_unlabeled(c.points, astray, parts, noise_of_sheet),
                 std::invalid_argument);
}

}  // namespace
