// SPDX-License-Identifier: BSL-1.0
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/filters/voxel_grid.hpp>
#include <gnomon/normals/plane_fit.hpp>
#include <gnomon/normals/surfel.hpp>
#include <gnomon/perception/detail/separated_walls.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace rec = gnomon::recognition;

namespace {

/// Cells of a wall at x = 0, 2 m high, and of a board in front of it that is in one surface with
/// it; one cell of each is in no surface.
struct wall_with_board {
    gnomon::voxel_grid::means cells;
    std::vector<gnomon::surfel<gnomon::plane_fit>> surface;
    std::vector<std::int32_t> labels;
    std::vector<char> is_wall;

    /// @param board  its distance from the wall [m]
    /// @param width  of the wall [m]
    explicit wall_with_board(double board, double width = 4.0) {
        const auto add = [&](double x, double y, double z, std::int32_t label, bool of_wall) {
            cells.points.emplace_back(x, y, z);
            surface.emplace_back();
            surface.back().normal = Eigen::Vector3d::UnitX();
            labels.push_back(label);
            is_wall.push_back(of_wall);
        };
        for (int i = 0; i <= 80; ++i)
            for (int k = 0; k <= 40; ++k) add(0.0, width * i / 80.0, 0.05 * k, 0, true);
        for (int i = 0; i < 10; ++i)
            for (int k = 0; k < 10; ++k) add(board, 1.0 + 0.04 * i, 0.5 + 0.04 * k, 0, false);
        add(0.008, 2.0, 1.0, gnomon::unlabeled, true);
        add(board, 2.0, 1.0, gnomon::unlabeled, false);
        cells.viewpoints = Eigen::Vector3d(3.0, 0.0, 1.0);
    }
    [[nodiscard]] rec::detail::separated_walls separated(double noise) const {
        return rec::detail::separate_walls(cells, surface,
                                           gnomon::segments(std::vector<std::int32_t>(labels)), 2.2,
                                           gnomon::constant_noise{noise}, Eigen::Vector3d::UnitZ());
    }
    /// Whether the board is left, and no cell of the wall.
    [[nodiscard]] bool is_separated(double noise) const {
        const auto left = separated(noise).others;
        std::vector<char> is_left(labels.size(), 0);
        for (const gnomon::point_index i : left) is_left[i] = 1;
        for (std::size_t i = 0; i < labels.size(); ++i)
            if ((is_left[i] != 0) == (is_wall[i] != 0)) return false;
        return true;
    }
};

TEST(separated_walls, what_is_in_one_surface_with_a_wall_is_left_unless_in_its_plane) {
    EXPECT_TRUE(wall_with_board(0.03).is_separated(0.005));
    // Nearer than three deviations of the noise it cannot be distinguished from the wall.
    EXPECT_FALSE(wall_with_board(0.03).is_separated(0.015));
    EXPECT_TRUE(wall_with_board(0.06).is_separated(0.015));
    // Without noise walls are even within 1 cm.
    EXPECT_TRUE(wall_with_board(0.02).is_separated(1e-6));
}

TEST(separated_walls, walls_face_the_sensor) {
    for (const double side : {3.0, -3.0}) {
        wall_with_board seen(0.03);
        seen.cells.viewpoints = Eigen::Vector3d(side, 0.0, 1.0);
        const auto walls = seen.separated(0.005).walls;
        ASSERT_EQ(walls.size(), 1u);
        EXPECT_GT(walls[0].surface.normal.x() * side, 2.99);
        EXPECT_NEAR(walls[0].surface.signed_distance({0.0, 1.0, 1.0}), 0.0, 0.005);
        EXPECT_NEAR(walls[0].extent.lengths.maxCoeff(), 4.0, 0.05);
    }
}

/// Their cells are removed all the same.
TEST(separated_walls, edges_and_bent_surfaces_are_not_given_as_walls) {
    wall_with_board low(0.03), bent(0.03);
    for (auto& p : low.cells.points) p.z() *= 0.1;
    for (auto& p : bent.cells.points) p.x() += 0.2 * p.y() * p.y();
    for (const wall_with_board& w : {low, bent}) {
        EXPECT_TRUE(w.separated(0.005).walls.empty());
        EXPECT_LT(w.separated(0.005).others.size(), w.labels.size());
    }
}

TEST(separated_walls, short_surfaces_are_no_walls) {
    EXPECT_FALSE(wall_with_board(0.03, 1.5).is_separated(0.005));
    EXPECT_TRUE(wall_with_board(0.03, 1.5).separated(0.005).walls.empty());
}

}  // namespace
