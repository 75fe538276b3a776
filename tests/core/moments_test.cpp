// SPDX-License-Identifier: BSL-1.0
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/moments.hpp>

namespace {

/// The textbook covariance in two passes and long double.
Eigen::Matrix3d two_pass_covariance(const clouds::cloud& points) {
    using vector = Eigen::Matrix<long double, 3, 1>;
    vector mean = vector::Zero();
    for (const auto& p : points) mean += p.cast<long double>();
    mean /= static_cast<long double>(points.size());
    Eigen::Matrix<long double, 3, 3> sum = Eigen::Matrix<long double, 3, 3>::Zero();
    for (const auto& p : points) {
        const vector d = p.cast<long double>() - mean;
        sum += d * d.transpose();
    }
    return (sum / static_cast<long double>(points.size())).cast<double>();
}

TEST(moments, give_the_covariance_of_the_neighbors_with_and_without_the_point) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        clouds::cloud points = clouds::in_cube(30, seed);
        for (auto& p : points) p += Eigen::Vector3d(6e5, 4.8e6, 100);  // UTM
        gnomon::moments m;
        for (std::size_t j = 1; j < points.size(); ++j) m.add(points[j] - points[0]);
        EXPECT_EQ(m.count, 29u);
        EXPECT_LT((m.covariance_with_point() - two_pass_covariance(points)).norm(), 1e-14);
        points.erase(points.begin());
        EXPECT_LT((m.covariance_of_neighbors() - two_pass_covariance(points)).norm(), 1e-14);
    }
}

TEST(moments, of_some_are_those_of_all_less_the_others) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const clouds::cloud points = clouds::in_cube(30, seed);
        gnomon::moments all, some;
        for (const auto& p : points) all.add(p);
        for (std::size_t j = 0; j < points.size(); ++j) {
            if (j % 3 == 0)
                some.add(points[j]);
            else
                all.remove(points[j]);
        }
        EXPECT_EQ(all.count, some.count);
        EXPECT_LT((all.sum - some.sum).norm(), 1e-13);
        EXPECT_LT((all.second_moments() - some.second_moments()).norm(), 1e-14);
    }
}

TEST(moments, about_a_point_are_those_of_the_offsets) {
    const clouds::cloud points = clouds::in_cube(30, 1);
    const Eigen::Vector3d p(0.5, -0.25, 1.0);
    gnomon::moments m;
    for (const auto& q : points) m.add(q - p);
    const auto about = gnomon::moments::about(p, points);
    EXPECT_EQ(about.count, m.count);
    EXPECT_EQ(about.sum, m.sum);
    EXPECT_EQ(about.outer, m.outer);
}

}  // namespace
