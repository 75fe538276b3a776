// SPDX-License-Identifier: BSL-1.0
#include <string>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/estimator_laws.hpp"
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/plane_pca.hpp>

namespace {

/// A user's own estimator that returns a bare vector: the normal of the triangle of largest area
/// with a corner in p; unusual, but lawful.
const auto largest_triangle = [](const Eigen::Vector3d& p, gnomon::neighborhood_view neighbors) {
    Eigen::Vector3d best = Eigen::Vector3d::Zero();
    for (const auto& q : neighbors) {
        for (const auto& r : neighbors) {
            const Eigen::Vector3d a = q - p, b = r - p;
            const Eigen::Vector3d c(a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(),
                                    a.x() * b.y() - a.y() * b.x());
            if (c.squaredNorm() > best.squaredNorm()) best = c;
        }
    }
    return best;
};

/// One that promises trust and then returns NaN: the driver must not pass it on.
struct broken {
    gnomon::plane_fit operator()(const Eigen::Vector3d&, gnomon::neighborhood_view) const {
        gnomon::plane_fit fit;
        fit.normal.setConstant(clouds::nan);
        fit.trust = gnomon::trust::good;
        return fit;
    }
};

struct no_neighborhood {
    Eigen::Vector3d operator()(const Eigen::Vector3d&) const;
};
struct returns_text {
    std::string operator()(const Eigen::Vector3d&, gnomon::neighborhood_view) const;
};

/// One that forgets to normalise.
struct too_long {
    gnomon::plane_fit operator()(const Eigen::Vector3d& p,
                                 gnomon::neighborhood_view neighbors) const {
        gnomon::plane_fit fit = gnomon::plane_pca{}(p, neighbors);
        fit.normal *= 2.0;
        return fit;
    }
};

struct returns_matrix {
    Eigen::Matrix3d operator()(const Eigen::Vector3d&, gnomon::neighborhood_view) const;
};
struct returns_float {
    Eigen::Vector3f operator()(const Eigen::Vector3d&, gnomon::neighborhood_view) const;
};
static_assert(!gnomon::estimator<returns_matrix> && gnomon::estimator<returns_float>);
static_assert(gnomon::estimator<gnomon::plane_pca>);
static_assert(gnomon::estimator<decltype(largest_triangle)>);
static_assert(gnomon::estimator<decltype([](const auto& p, auto) { return p; })>);
static_assert(!gnomon::estimator<no_neighborhood> && !gnomon::estimator<returns_text>);
static_assert(!gnomon::estimator<int>);
// A column of a matrix that is destroyed: a dangling reference.
static_assert(!gnomon::estimator<decltype([](const auto& p, auto) {
    const Eigen::Matrix3d m = p * p.transpose();
    return m.col(0);
})>);
static_assert(!gnomon::estimator<decltype([](const auto& p, auto) { return -p; })>);
static_assert(std::same_as<gnomon::estimate_t<gnomon::plane_pca>, gnomon::plane_fit>);
static_assert(std::same_as<gnomon::estimate_t<decltype(largest_triangle)>, gnomon::normal_fit>);

TEST(estimator, laws_hold_for_plane_pca) { laws::estimator_laws(gnomon::plane_pca{}); }

TEST(estimator, laws_hold_for_a_lambda_that_returns_a_vector) {
    laws::normals_are_unit_or_zero(largest_triangle);
    laws::normal_follows_the_cloud(largest_triangle);
}

TEST(estimator, the_driver_keeps_the_promises_that_an_estimator_breaks) {
    laws::normals_are_unit_or_zero(broken{});
    laws::normals_are_unit_or_zero(too_long{});
    const auto points = clouds::sheet(20, 1);
    for (const auto& s : gnomon::estimate_normals(points, gnomon::knn{5}, broken{})) {
        EXPECT_EQ(s.trust, gnomon::trust::not_finite);
    }
}

}  // namespace
