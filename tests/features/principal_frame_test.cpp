// SPDX-License-Identifier: BSL-1.0
#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/features/principal_frame.hpp>

namespace {

/// A rotated box of known size, far from the origin: size, center and axes are recovered.
TEST(principal_frame, fits_a_turned_box) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const Eigen::Vector3d size(2.0, 1.0, 0.1);
        const Eigen::Matrix3d r = clouds::random_rotation(seed);
        const Eigen::Vector3d center(6e5, 4.8e6, 100);
        clouds::cloud points;
        for (int i = 0; i < 11; ++i) {
            for (int j = 0; j < 11; ++j) {
                for (int k = 0; k < 11; ++k) {
                    const Eigen::Vector3d u(i / 10.0 - 0.5, j / 10.0 - 0.5, k / 10.0 - 0.5);
                    points.push_back(center + r * size.cwiseProduct(u));
                }
            }
        }
        points.push_back({clouds::nan, 0, 0});
        const auto frame = gnomon::principal_frame::of(points);
        EXPECT_LT((frame.box_size - size).norm(), 1e-7);
        EXPECT_LT((frame.box_center - center).norm(), 1e-7);
        EXPECT_LT((frame.centroid - center).norm(), 1e-7);
        EXPECT_NEAR(std::abs(frame.normal().dot(r.col(2))), 1.0, 1e-9);
        EXPECT_NEAR(frame.axes.determinant(), 1.0, 1e-12);
        EXPECT_NEAR(frame.spectrum.aspect_ratio(), 0.5, 1e-6);
    }
}

TEST(principal_frame, survives_every_cloud) {
    for (const auto& [name, points] : clouds::degenerate()) {
        SCOPED_TRACE(name);
        const auto frame = gnomon::principal_frame::of(points);
        EXPECT_TRUE(frame.axes.allFinite() && frame.box_size.allFinite());
        EXPECT_NEAR(std::abs(frame.axes.determinant()), 1.0, 1e-9);
    }
}

TEST(principal_frame, has_an_oriented_box) {
    gnomon::principal_frame frame;
    frame.box_center = {1, 2, 3};
    frame.box_size = {4, 5, 6};
    frame.axes << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    const gnomon::oriented_box box = frame.box();
    EXPECT_EQ(box.center, frame.box_center);
    EXPECT_EQ(box.lengths, frame.box_size);
    EXPECT_EQ(box.axes, frame.axes);
}

}  // namespace
