// SPDX-License-Identifier: BSL-1.0
/// The neighbors that leaves find for all points at once are those that nanoflann finds one by one.
/// Compiled once more for each set of instructions, see tests/CMakeLists.txt.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/neighborhoods/detail/leaf_search.hpp>
#include <gnomon/neighborhoods/knn.hpp>

namespace {

using gnomon::knn, gnomon::knn_backend;
using gnomon::detail::found_neighbors, gnomon::detail::leaf_search, gnomon::detail::leaf_tree;

/// points[i] = make(random) for n points.
clouds::cloud cloud_of(std::size_t n, auto&& make) {
    gnomon::random_stream random(n);
    clouds::cloud points;
    for (std::size_t i = 0; i < n; ++i) points.push_back(make(i, random));
    return points;
}

clouds::cloud scaled(const clouds::cloud& points, double scale) {
    return clouds::moved(points, scale * Eigen::Matrix3d::Identity(), {0, 0, 0});
}

/// `points`, some of which are made anew: those whose number is a multiple of `every`.
clouds::cloud with_every(std::size_t every, clouds::cloud points, auto&& make) {
    for (std::size_t i = 0; i < points.size(); i += every) points[i] = make(i);
    return points;
}

/// As a depth camera gives them: disparities in steps of an eighth of a pixel.
Eigen::Vector3d depth_camera_point(std::size_t i) {
    const double u = double(i % 60) - 30, v = double(i / 60) - 20;
    const double z = 8.0 / std::round(16.0 + 8.0 * std::sin(0.1 * u));
    return {u * z / 60, v * z / 60, z};
}

std::vector<clouds::named_cloud> clouds_to_sweep() {
    constexpr std::size_t n = 1500;
    using stream = gnomon::random_stream&;
    const auto cube = clouds::in_cube(n, 1), sheet = clouds::sheet(n, 2);
    auto all = clouds::degenerate();
    all.push_back({"volume", cube});
    all.push_back({"surface", sheet});
    all.push_back({"line", cloud_of(n, [](auto, stream random) {
                       return Eigen::Vector3d(100 * random.uniform(), 0, 0);
                   })});
    all.push_back({"even line", cloud_of(n, [](auto i, auto&) {
                       return Eigen::Vector3d(double(i), 2 * double(i), 0);
                   })});
    all.push_back(
        {"clusters of different density", cloud_of(n, [](auto i, stream random) -> Eigen::Vector3d {
             const double spread = std::pow(10.0, -3.0 * double(i % 4));
             return Eigen::Vector3d(double(i % 4), 0, 0) + spread * clouds::gaussian_vector(random);
         })});
    for (const double decades : {8.0, 100.0, 300.0})
        all.push_back({"no scale over " + std::to_string(decades) + " decades",
                       cloud_of(n, [decades](auto, stream random) -> Eigen::Vector3d {
                           return std::pow(10.0, -decades * random.uniform()) *
                                  clouds::gaussian_vector(random);
                       })});
    all.push_back({"clumps of 20", cloud_of(n, [](auto i, stream random) -> Eigen::Vector3d {
                       return Eigen::Vector3d(1e3 * double(i / 20), 0, 0) +
                              clouds::gaussian_vector(random);
                   })});
    all.push_back({"grid", clouds::on_grid(n, 3, 0.01)});
    all.push_back({"full grid", cloud_of(n, [](auto i, auto&) {
                       return Eigen::Vector3d(double(i % 14), double(i / 14 % 14), double(i / 196));
                   })});
    all.push_back({"millimetres", cloud_of(n, [&](auto i, auto&) -> Eigen::Vector3d {
                       return (1e3 * sheet[i]).array().round() / 1e3;
                   })});
    all.push_back(
        {"depth camera", cloud_of(n, [](auto i, auto&) { return depth_camera_point(i); })});
    all.push_back(
        {"UTM coordinates", clouds::moved(sheet, Eigen::Matrix3d::Identity(), {6e5, 4.8e6, 100})});
    all.push_back(
        {"UTM coordinates, millimetres", cloud_of(n, [&](auto i, auto&) -> Eigen::Vector3d {
             const Eigen::Vector3d p = sheet[i] + Eigen::Vector3d(6e5, 4.8e6, 100);
             return Eigen::Vector3d((1e3 * p).array().round() / 1e3);
         })});
    all.push_back(
        {"pairs", with_every(2, cube, [&](auto i) -> Eigen::Vector3d { return cube[i + 1]; })});
    all.push_back({"triples, a hair apart", cloud_of(n, [&](auto i, auto&) -> Eigen::Vector3d {
                       return cube[i / 3] * (1 + double(i % 3) * 1e-15);
                   })});
    for (const std::size_t heap : {31u, 32u, 62u})
        all.push_back(
            {"heaps of " + std::to_string(heap),
             cloud_of(n, [&](auto i, auto&) -> Eigen::Vector3d { return cube[i / heap]; })});
    all.push_back({"a heap at the origin",
                   with_every(2, cube, [](auto) { return Eigen::Vector3d(0, 0, 0); })});
    all.push_back({"NaN and infinities", with_every(7, cube, [](auto i) {
                       return Eigen::Vector3d(i % 2 ? clouds::nan : clouds::infinity, 0, 0);
                   })});
    for (const double far : {1e9, 1e30, 1e140})
        all.push_back({"strays at " + std::to_string(far),
                       with_every(500, cube, [&](auto i) -> Eigen::Vector3d {
                           return Eigen::Vector3d(i % 1000 ? far : -far, 0, 0);
                       })});
    for (const double scale : {1e-300, 1e-160, 1e-158, 1e-154, 1e-140, 1e140})
        all.push_back({"cube of " + std::to_string(std::log10(scale)), scaled(cube, scale)});
    all.push_back(
        {"a cluster whose squares underflow", with_every(4, cube, [&](auto i) -> Eigen::Vector3d {
             return Eigen::Vector3d(1e-160 * cube[i]);
         })});
    return all;
}

void expect_the_same_neighbors(const clouds::cloud& points, std::size_t k) {
    const auto found = knn{.k = k}(points);
    const auto expected = knn{.k = k, .backend = knn_backend::nanoflann}(points);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        ASSERT_TRUE(std::ranges::equal(found[i], expected[i])) << "k " << k << ", point " << i;
}

TEST(leaf_search, finds_what_nanoflann_finds) {
    for (const auto& [name, points] : clouds_to_sweep()) {
        SCOPED_TRACE(name);
        for (const std::size_t k : {1u, 8u, 26u, 130u}) expect_the_same_neighbors(points, k);
    }
}

/// About full leaves and groups, and for more neighbors than there are.
TEST(leaf_search, finds_what_nanoflann_finds_of_any_number_of_points) {
    for (const std::size_t n :
         {0u, 1u, 2u, 3u, 31u, 32u, 33u, 63u, 64u, 65u, 127u, 128u, 129u, 160u, 161u, 1000u}) {
        for (const auto& points : {clouds::in_cube(n, n), clouds::on_grid(n, n)}) {
            SCOPED_TRACE(std::to_string(n) + " points");
            for (const std::size_t k : {1u, 2u, 3u, 31u, 32u, 33u, 127u})
                expect_the_same_neighbors(points, k);
            for (const std::size_t k : {n - 1, n, n + 1, 2 * n + 7})
                if (k > 0) expect_the_same_neighbors(points, k);
        }
    }
}

/// The search sweeps all of these clouds but where points crowd: it does not leave them to the
/// other way, which would make the comparison worthless.
TEST(leaf_search, is_what_was_tried) {
    std::size_t left_out = 0;
    for (const auto& [name, points] : clouds_to_sweep()) {
        const bool swept = knn{.k = 8}.sweep(points, gnomon::sequential{}, std::identity{},
                                             [] { return gnomon::detail::any_visitor{}; });
        left_out += !swept;
        EXPECT_TRUE(swept || name.find("equal") != name.npos || name.find("origin") != name.npos ||
                    name.find("heap") != name.npos || name.find("tiny") != name.npos)
            << name;
    }
    EXPECT_GT(left_out, 0u);
}

/// What one search finds for point i, by point, in the order of the tree.
struct finding {
    std::vector<gnomon::point_index> neighbors;
    gnomon::moments moments;
    double mean_distance;

    friend bool operator==(const finding& a, const finding& b) {
        return a.neighbors == b.neighbors && a.moments.sum == b.moments.sum &&
               a.moments.outer == b.moments.outer && a.mean_distance == b.mean_distance;
    }
};

/// Guesses come from what was found before; what is found does not, to the last bit.
TEST(leaf_search, does_not_depend_on_what_was_found_before) {
    for (const auto& [name, points] : clouds_to_sweep()) {
        const leaf_tree tree(gnomon::position_view<clouds::cloud>(points), gnomon::sequential{});
        if (tree.size() == 0 || tree.crowded()) continue;
        SCOPED_TRACE(name);
        for (const std::size_t k : {5u, 20u}) {
            std::vector<finding> once(points.size()), afresh(points.size());
            const auto into = [](std::vector<finding>& all) {
                return [&all](std::size_t i, const found_neighbors& found) {
                    EXPECT_TRUE(all[i].neighbors.empty()) << "visited twice";
                    all[i] = {{found.index(), found.index() + found.size()},
                              found.moments_about_point(),
                              found.mean_distance()};
                };
            };
            leaf_search learning(tree, k);
            for (std::size_t g = tree.groups(); g-- > 0;) learning(g, into(once));
            for (std::size_t g = 0; g < tree.groups(); ++g) leaf_search(tree, k)(g, into(afresh));
            EXPECT_EQ(once, afresh);
        }
    }
}

/// Moments and mean distance of what was found, against plain sums.
TEST(leaf_search, sums_up_what_it_finds) {
    const auto points = clouds::sheet(1000, 3);
    const leaf_tree tree(gnomon::position_view<clouds::cloud>(points), gnomon::sequential{});
    for (const std::size_t k : {1u, 3u, 4u, 5u, 7u, 8u, 9u, 20u}) {
        const auto visit = [&](std::size_t i, const found_neighbors& found) {
            ASSERT_EQ(found.size(), k);
            gnomon::moments expected;
            double distance = 0.0;
            for (std::size_t j = 0; j < k; ++j) {
                const Eigen::Vector3d& q = points[found.index()[j]];
                ASSERT_EQ(found.squared_distance()[j], gnomon::squared_distance(points[i], q));
                expected.add(q - points[i]);
                distance += (q - points[i]).norm() / static_cast<double>(k);
            }
            const gnomon::moments m = found.moments_about_point();
            ASSERT_EQ(m.count, k);
            ASSERT_LE((m.sum - expected.sum).norm(), 1e-14 * distance * double(k));
            ASSERT_LE((m.outer - expected.outer).norm(), 1e-14 * expected.outer.norm());
            ASSERT_NEAR(found.mean_distance(), distance, 1e-14 * distance);
        };
        leaf_search search(tree, k);
        for (std::size_t g = 0; g < tree.groups(); ++g) search(g, visit);
    }
}

TEST(leaf_search, is_the_same_for_any_number_of_threads) {
    const auto points = clouds::on_grid(9000, 4, 0.05);
    const auto expected = knn{.k = 20}(points);
    for (const unsigned t : {1u, 2u, 4u})
        EXPECT_EQ(knn{.k = 20}(points, gnomon::threads{t}), expected);
}

}  // namespace
