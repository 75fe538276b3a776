// SPDX-License-Identifier: BSL-1.0
#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <gnomon/adapters/eigen_matrix.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/strided_view.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/plane_pca.hpp>

namespace {

template <class Scalar, int Order>
using rows_of = Eigen::Matrix<Scalar, Eigen::Dynamic, 3, Order>;

std::vector<Eigen::Vector3d> matrix_points() {
    gnomon::random_stream random(2);
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 300; ++i)
        points.emplace_back(static_cast<float>(random.uniform()),
                            static_cast<float>(random.uniform()), static_cast<float>(i % 2));
    return points;
}

/// Points go into a matrix of any scalar and order and come back; the normals of both are the same.
template <class Matrix>
void expect_turn() {
    const auto points = matrix_points();
    const Matrix matrix = gnomon::point_rows<Matrix>(points);
    ASSERT_EQ(matrix.rows(), 300);
    const auto view = gnomon::rows(matrix);
    const gnomon::position_view positions(view);
    for (std::size_t i = 0; i < points.size(); ++i) ASSERT_EQ(positions[i], points[i]);

    const gnomon::knn neighbors{.k = 10};
    const auto surface = gnomon::estimate_normals(points, neighbors, gnomon::plane_pca{});
    const Matrix normals =
        gnomon::normal_rows<Matrix>(gnomon::estimate_normals(view, neighbors, gnomon::plane_pca{}));
    ASSERT_EQ(normals.rows(), 300);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Eigen::Vector3d n =
            normals.row(static_cast<Eigen::Index>(i)).transpose().template cast<double>();
        ASSERT_LE((n - surface[i].normal).norm(), 1e-6);
    }
}

TEST(adapters_eigen_matrix, points_and_normals_in_every_order) {
    expect_turn<rows_of<double, Eigen::ColMajor>>();
    expect_turn<rows_of<double, Eigen::RowMajor>>();
    expect_turn<rows_of<float, Eigen::ColMajor>>();
    expect_turn<rows_of<float, Eigen::RowMajor>>();
    expect_turn<Eigen::MatrixXd>();
}

/// A map of foreign memory, a block and a matrix with further columns are read where they lie.
TEST(adapters_eigen_matrix, maps_and_blocks_are_ranges) {
    std::array<float, 12> memory{1, 2, 3, 9, 4, 5, 6, 9, 7, 8, 9, 9};
    const Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 4, Eigen::RowMajor>> map(
        memory.data(), 3, 4);
    const auto view = gnomon::rows(map);
    EXPECT_EQ(gnomon::point_rows(view).row(2), Eigen::RowVector3d(7, 8, 9));
    const auto block = map.rightCols<3>();
    EXPECT_EQ(gnomon::point_rows(gnomon::rows(block)).row(0), Eigen::RowVector3d(2, 3, 9));
    memory[8] = -7;
    EXPECT_EQ(gnomon::position_view(view)[2].x(), -7);
}

struct matrix_hit {
    int number;
    std::array<double, 3> where;
};

TEST(adapters_eigen_matrix, takes_a_projection_and_nothing) {
    const std::vector<matrix_hit> hits = {{1, {1, 2, 3}}, {2, {4, 5, 6}}};
    EXPECT_EQ(gnomon::point_rows(hits, &matrix_hit::where).row(1), Eigen::RowVector3d(4, 5, 6));
    EXPECT_EQ(gnomon::point_rows(std::vector<Eigen::Vector3d>{}).rows(), 0);
}

}  // namespace
