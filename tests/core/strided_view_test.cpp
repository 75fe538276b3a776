// SPDX-License-Identifier: BSL-1.0
#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core/point_range.hpp>
#include <gnomon/core/strided_view.hpp>

namespace {

static_assert(gnomon::point_range<gnomon::strided_view<float>>);
static_assert(std::random_access_iterator<
              decltype(std::declval<const gnomon::strided_view<double>&>().begin())>);

TEST(strided_view, reads_unaligned_fields_in_any_order) {
    // Records of 15 bytes: z, one byte, x, y, two bytes.
    std::vector<std::byte> buffer(3 * 15);
    for (std::size_t i = 0; i < 3; ++i) {
        const float x = 1.0f + float(i), y = 10.0f * x, z = 100.0f * x;
        std::memcpy(&buffer[15 * i], &z, 4);
        std::memcpy(&buffer[15 * i + 5], &x, 4);
        std::memcpy(&buffer[15 * i + 9], &y, 4);
    }
    const gnomon::strided_view<float> view(buffer.data(), 3, 15, {5, 9, 0});
    ASSERT_EQ(view.size(), 3u);
    EXPECT_EQ(view[2], Eigen::Vector3f(3, 30, 300));
    std::size_t seen = 0;
    for (const Eigen::Vector3f& p : view) EXPECT_EQ(p, view[seen++]);
    EXPECT_EQ(seen, 3u);
}

TEST(strided_view, refuses_null_with_points) {
    EXPECT_THROW(gnomon::strided_view<float>(nullptr, 1, 12), std::invalid_argument);
    EXPECT_EQ(gnomon::strided_view<float>(nullptr, 0, 12).size(), 0u);
}

/// Eigen matrices, maps and blocks of either storage order give the same points.
TEST(strided_view, sees_columns_and_rows_of_any_matrix) {
    const Eigen::MatrixXd m = Eigen::MatrixXd::Random(4, 7);
    const auto expect_columns = [&m](const auto& view) {
        ASSERT_EQ(view.size(), 7u);
        for (Eigen::Index i = 0; i < 7; ++i) {
            EXPECT_EQ(view[static_cast<std::size_t>(i)], Eigen::Vector3d(m.col(i).head<3>()));
        }
    };
    const Eigen::MatrixXd by_rows = m.transpose();
    const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> row_major = m;
    const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> row_major_t =
        m.transpose();
    const Eigen::Matrix<double, 3, Eigen::Dynamic> three = m.topRows<3>();
    const auto block = m.topRows(3);
    Eigen::MatrixXd big = Eigen::MatrixXd::Zero(9, 20);
    big.block(2, 3, 4, 7) = m;
    const auto inner = big.block(2, 3, 4, 7);
    const Eigen::Map<const Eigen::MatrixXd> map(m.data(), 4, 7);
    expect_columns(gnomon::columns(m));
    expect_columns(gnomon::columns(three));
    expect_columns(gnomon::columns(row_major));
    expect_columns(gnomon::columns(block));
    expect_columns(gnomon::columns(inner));
    expect_columns(gnomon::columns(map));
    expect_columns(gnomon::rows(by_rows));
    expect_columns(gnomon::rows(row_major_t));
}

TEST(strided_view, refuses_matrices_that_hold_no_3d_points) {
    const Eigen::MatrixXd flat = Eigen::MatrixXd::Zero(2, 5);
    EXPECT_THROW((void)gnomon::columns(flat), std::invalid_argument);
    const Eigen::MatrixXd thin = Eigen::MatrixXd::Zero(5, 2);
    EXPECT_THROW((void)gnomon::rows(thin), std::invalid_argument);
}

}  // namespace
