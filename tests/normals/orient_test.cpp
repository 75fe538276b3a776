// SPDX-License-Identifier: BSL-1.0
#include <cstddef>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/orient.hpp>
#include <gnomon/normals/plane_pca.hpp>

namespace {

/// Eq. (3.20) holds afterwards for every point and its own view point.
void expect_faces(const clouds::cloud& points, const auto& surface,
                  const gnomon::viewpoint_table& v) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_LE(surface[i].normal.dot(points[i] - v[i]), 0.0);
    }
}

TEST(orient_normals, faces_the_view_point_of_each_point) {
    const auto points = clouds::sheet(400, 1);
    const auto surface = gnomon::estimate_normals(points, gnomon::knn{12}, gnomon::plane_pca{});
    std::vector<Eigen::Vector3d> per_point;
    std::vector<gnomon::point_index> scan_of_point;
    for (std::size_t i = 0; i < points.size(); ++i) {
        per_point.push_back({0, 0, i % 2 == 0 ? 5.0 : -5.0});
        scan_of_point.push_back(static_cast<gnomon::point_index>(i % 2));
    }
    const gnomon::viewpoint_table tables[] = {
        {},
        gnomon::viewpoint_table(Eigen::Vector3d(0.5, 0.5, 3)),
        gnomon::viewpoint_table(per_point),
        gnomon::viewpoint_table({{0, 0, 5}, {0, 0, -5}}, scan_of_point)};
    for (const auto& table : tables) {
        auto oriented = surface;
        gnomon::orient_normals(gnomon::with_viewpoints(points, table), oriented);
        expect_faces(points, oriented, table);
    }
    auto both_sides = surface;
    gnomon::orient_normals(gnomon::with_viewpoints(points, tables[3]), both_sides);
    EXPECT_GT(both_sides[0].normal.z(), 0.0);
    EXPECT_LT(both_sides[1].normal.z(), 0.0);
}

/// A view point that is missing must not leave normals as they are, silently.
TEST(orient_normals, refuses_a_view_point_that_is_not_finite) {
    const auto points = clouds::sheet(50, 1);
    auto surface = gnomon::estimate_normals(points, gnomon::knn{.k = 8}, gnomon::plane_pca{});
    EXPECT_THROW(
        gnomon::orient_normals(gnomon::with_viewpoint(points, {clouds::nan, 0, 0}), surface),
        std::invalid_argument);
}

/// A view point is no projection.
template <class S>
concept takes_a_bare_view_point = requires(const std::vector<Eigen::Vector3d>& points, S& surface) {
    gnomon::orient_normals(points, surface, Eigen::Vector3d(0, 0, 1));
};
static_assert(!takes_a_bare_view_point<std::vector<gnomon::surfel<gnomon::plane_fit>>>);

TEST(orient_normals, refuses_a_surface_of_other_points) {
    auto surface =
        gnomon::estimate_normals(clouds::sheet(5, 1), gnomon::knn{3}, gnomon::plane_pca{});
    EXPECT_THROW(gnomon::orient_normals(clouds::sheet(6, 1), surface), std::invalid_argument);
}

}  // namespace
