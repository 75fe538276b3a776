// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/segmentation/plane_estimate.hpp>

namespace {

using gnomon::plane_estimate, gnomon::segments;

constexpr double sigma_of_patch = 0.01;
const gnomon::noise_curve noise_of_patch = gnomon::constant_noise{sigma_of_patch};

/// n points of a rectangle, seen from an eye, with noise along the rays.
struct patch {
    Eigen::Vector3d center{3.0, 0.0, 0.0}, side{0.0, 1.0, 0.0}, other_side{0.0, 0.0, 0.6};
    Eigen::Vector3d eye{0.0, 0.0, 0.0};
    int n = 400;

    [[nodiscard]] clouds::cloud points(std::uint64_t seed) const {
        gnomon::random_stream places(1), errors(seed);
        clouds::cloud all;
        for (int i = 0; i < n; ++i) {
            const double a = places.uniform() - 0.5, b = places.uniform() - 0.5;
            const Eigen::Vector3d p = center + a * side + b * other_side;
            all.push_back(p + sigma_of_patch * errors.gaussian() * (p - eye).normalized());
        }
        return all;
    }
};

segments whole_segment(std::size_t n) { return segments(std::vector<std::int32_t>(n, 0)); }

plane_estimate estimate(const auto& points) {
    return gnomon::estimate_planes(points, whole_segment(points.size()), noise_of_patch).at(0);
}
plane_estimate estimate_from(const clouds::cloud& points, const Eigen::Vector3d& eye) {
    return estimate(gnomon::with_viewpoint(points, eye));
}

/// The sum of the squared errors of the ranges, in variances of their noise, of a plane turned
/// about axes 0 and 1 and shifted.
double squares_of_ranges(const plane_estimate& e, const Eigen::Vector3d& by,
                         const clouds::cloud& points, const Eigen::Vector3d& eye,
                         const gnomon::noise_curve& noise) {
    const Eigen::Vector3d n =
        (e.plane.normal + by[1] * e.axes.col(0) - by[0] * e.axes.col(1)).normalized();
    const Eigen::Vector3d on = e.centroid + by[2] * e.plane.normal;
    double sum = 0.0;
    for (const Eigen::Vector3d& p : points) {
        const Eigen::Vector3d u = (p - eye).normalized();
        const double error = n.dot(p - on) / n.dot(u);
        const double s = noise((p - eye).norm());
        sum += error * error / (s * s + gnomon::detail::flatness * gnomon::detail::flatness);
    }
    return sum;
}

/// No plane nearby explains the ranges better: the lowest point of the parabola through three sums
/// of squares along each parameter is here, and its curvature is that of the covariance.
TEST(plane_estimate, is_of_maximum_likelihood) {
    const gnomon::noise_curve growing = gnomon::quadratic_noise{0.0, 0.0, 1e-3};
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const patch p{.center = {4.0, 1.0, 0.0}, .side = {1.0, 2.0, 0.0}};
        const auto points = p.points(seed);
        const auto found = gnomon::estimate_planes(gnomon::with_viewpoint(points, p.eye),
                                                   whole_segment(points.size()), growing)
                               .at(0);
        ASSERT_EQ(found.points, points.size()) << "all are on it";
        const Eigen::Matrix3d information = found.covariance.inverse();
        for (int k = 0; k < 3; ++k) {
            const double h = 0.3 * std::sqrt(found.covariance(k, k));
            const auto at = [&](double by) {
                return squares_of_ranges(found, by * Eigen::Vector3d::Unit(k), points, p.eye,
                                         growing);
            };
            const double low = at(-h), here = at(0.0), high = at(h);
            const double curvature = (low - 2.0 * here + high) / (h * h);
            EXPECT_NEAR(0.5 * (low - high) / h / curvature, 0.0, 2e-3 * h) << k;
            EXPECT_NEAR(0.5 * curvature / information(k, k), std::max(found.chi2, 1.0), 0.05);
        }
        EXPECT_EQ(found.axes.col(2), found.plane.normal);
        EXPECT_LE((found.axes.transpose() * found.axes - Eigen::Matrix3d::Identity()).norm(), 1e-9);
        EXPECT_NEAR(found.axes.determinant(), 1.0, 1e-9);
        EXPECT_NEAR(found.plane.signed_distance(found.centroid), 0.0, 1e-12);
        EXPECT_GT(found.plane.normal.dot(p.eye - found.centroid), 0.0) << "towards the view point";
    }
}

/// Where no ray is known, the plane is that of smallest variance.
TEST(plane_estimate, agrees_with_a_dense_weighted_fit_without_rays) {
    const gnomon::noise_curve growing = gnomon::quadratic_noise{0.0, 0.0, 0.01};
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const auto points = patch{.center = {4.0, 1.0, 0.0}, .side = {3.0, 1.0, 0.0}}.points(seed);
        const auto found =
            gnomon::estimate_planes(points, whole_segment(points.size()), growing).at(0);
        ASSERT_EQ(found.points, points.size());
        Eigen::VectorXd w(points.size());
        Eigen::MatrixXd x(points.size(), 3);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const auto row = static_cast<Eigen::Index>(i);
            const double s = growing(points[i].norm());
            w[row] = 1.0 / (s * s + gnomon::detail::flatness * gnomon::detail::flatness);
            x.row(row) = points[i];
        }
        const Eigen::Vector3d mean = x.transpose() * w / w.sum();
        const Eigen::MatrixXd about = x.rowwise() - mean.transpose();
        const Eigen::Matrix3d scatter = about.transpose() * w.asDiagonal() * about / w.sum();
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solved(scatter);
        const Eigen::Vector3d n = solved.eigenvectors().col(0);
        EXPECT_NEAR(std::abs(n.dot(found.plane.normal)), 1.0, 1e-12);
        EXPECT_LE((found.centroid - mean).norm(), 1e-9);
        EXPECT_NEAR(found.plane.offset, found.plane.normal.dot(mean), 1e-9);
        EXPECT_NEAR(std::abs(found.axes.col(0).dot(solved.eigenvectors().col(2))), 1.0, 1e-9);
    }
}

/// Strips 3 cm wide with noise of 1.5 cm: the direction of smallest variance is in the surface.
TEST(plane_estimate, of_a_strip_narrower_than_its_noise_is_right) {
    const Eigen::Vector3d eye(0.0, 0.0, 1.2), n(std::cos(0.5), std::sin(0.5), 0.0);
    const gnomon::noise_curve noise = gnomon::constant_noise{0.015};
    double nees = 0.0;
    constexpr int scans = 400;
    for (std::uint64_t seed = 1; seed <= scans; ++seed) {
        gnomon::random_stream random(seed);
        clouds::cloud points;
        for (int i = 0; i < 400; ++i) {
            const Eigen::Vector3d p =
                Eigen::Vector3d(2.0, 0.3, 0.0) +
                0.03 * (random.uniform() - 0.5) * Eigen::Vector3d(-n.y(), n.x(), 0.0) +
                random.uniform() * Eigen::Vector3d::UnitZ();
            points.push_back(p + 0.015 * random.gaussian() * (p - eye).normalized());
        }
        const plane_estimate e =
            gnomon::estimate_planes(gnomon::with_viewpoint(points, eye), whole_segment(400), noise)
                .at(0);
        EXPECT_TRUE(e.is_flat);
        EXPECT_GT(std::abs(n.dot(e.plane.normal)), std::cos(0.5));
        const Eigen::Vector3d turn =
            (n.dot(e.plane.normal) < 0.0 ? -1.0 : 1.0) * n.cross(e.plane.normal);
        const Eigen::Vector3d error(turn.dot(e.axes.col(0)), turn.dot(e.axes.col(1)),
                                    n.dot(e.centroid - Eigen::Vector3d(2.0, 0.3, 0.0)));
        nees += error.dot(e.covariance.inverse() * error) / 3.0 / scans;
    }
    EXPECT_GT(nees, 0.85);
    EXPECT_LT(nees, 1.15);
}

/// The covariance is that of the fits to many scans of a plane.
TEST(plane_estimate, covariance_agrees_with_simulated_noise) {
    for (const patch& p : {patch{}, patch{.center = {3.0, 1.0, 0.5}, .side = {0.5, 1.0, 0.0}},
                           patch{.center = {2.0, 0.0, -1.5},
                           .side = {1.5, 0.0, 0.0},
                           .other_side = {0.0, 0.8, 0.0}}}) {
        const Eigen::Vector3d n = p.side.cross(p.other_side).normalized();
        Eigen::Vector3d squares(0.0, 0.0, 0.0), expected(0.0, 0.0, 0.0);
        double chi2 = 0.0;
        constexpr int scans = 600;
        for (int scan = 1; scan <= scans; ++scan) {
            const auto e = estimate_from(p.points(static_cast<std::uint64_t>(scan)), p.eye);
            // The turns about axes 0 and 1 that bring the true normal to the estimated one.
            const Eigen::Vector3d turn =
                (n.dot(e.plane.normal) < 0.0 ? Eigen::Vector3d(-n) : n).cross(e.plane.normal);
            const Eigen::Vector3d error(turn.dot(e.axes.col(0)), turn.dot(e.axes.col(1)),
                                        n.dot(e.centroid - p.center));
            chi2 += e.chi2 / scans;
            EXPECT_TRUE(e.is_flat);
            squares += error.cwiseAbs2() / scans;
            expected += e.covariance.diagonal() / scans;
            ASSERT_EQ(e.covariance, e.covariance.transpose());
        }
        for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(std::sqrt(squares[i] / expected[i]), 1.0, 0.15) << "of " << i;
        EXPECT_NEAR(chi2, 1.0, 0.1);
    }
}

TEST(plane_estimate, planes_are_flat) {
    gnomon::random_stream random(3);
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        patch p{.eye = 2.0 * clouds::gaussian_vector(random)};
        p.eye.x() = std::min(p.eye.x(), 2.5);
        const plane_estimate e = estimate_from(p.points(seed), p.eye);
        EXPECT_TRUE(e.is_flat) << seed;
        EXPECT_GE(e.points, 390u);
        EXPECT_GT(std::abs(e.plane.normal.x()), std::cos(0.01));
    }
}

/// Points off the plane do not turn it: a tenth of them on something that stands on it.
TEST(plane_estimate, is_of_the_points_on_the_plane) {
    const patch p{.n = 1000};
    auto points = p.points(4);
    for (std::size_t i = 0; i < 20; ++i)
        points.push_back({2.7 - 0.01 * static_cast<double>(i), 0.4, 0.2});
    const plane_estimate e = estimate_from(points, p.eye);
    EXPECT_TRUE(e.is_flat);
    EXPECT_LE(e.points, 1000u);
    EXPECT_GT(std::abs(e.plane.normal.x()), std::cos(0.005));
    for (std::size_t i = 0; i < 20; ++i)
        points.push_back({2.7 - 0.01 * static_cast<double>(i), 0.4, 0.1});
    EXPECT_FALSE(estimate_from(points, p.eye).is_flat) << "40 points are certainly not of it";
}

TEST(plane_estimate, what_is_no_plane_is_not_flat) {
    gnomon::random_stream random(5);
    clouds::cloud cylinder, corner, step, ball;
    for (int i = 0; i < 900; ++i) {
        const double t = 3.0 * (random.uniform() - 0.5), h = random.uniform();
        const double u = random.uniform(), v = random.uniform();
        cylinder.emplace_back(3.0 - 0.3 * std::cos(t), 0.3 * std::sin(t), h);
        corner.push_back(i % 2 == 0 ? Eigen::Vector3d(3.0, u, v)
                                    : Eigen::Vector3d(3.0 - u, 0.0, v));
        step.emplace_back(i % 2 == 0 ? 3.0 : 3.15, u, v);
        ball.push_back(Eigen::Vector3d(3.0, 0.0, 0.0) + 0.5 * clouds::gaussian_vector(random));
    }
    for (const auto& points : {cylinder, corner, step, ball}) {
        EXPECT_FALSE(estimate_from(points, {0.0, 0.5, 0.5}).is_flat);
        EXPECT_FALSE(estimate(points).is_flat);
    }
}

/// The points of a scan line are of a plane through the view point, which was not seen.
TEST(plane_estimate, scan_lines_are_not_flat) {
    clouds::cloud line;
    for (int i = 0; i < 300; ++i) {
        const double t = 0.005 * i;
        line.emplace_back((2.0 + 0.5 * std::sin(5.0 * t)) *
                          Eigen::Vector3d(std::cos(t), std::sin(t), 0.0));
    }
    EXPECT_FALSE(estimate_from(line, {0.0, 0.0, 0.0}).is_flat);
    EXPECT_TRUE(estimate_from(line, {0.0, 0.0, 3.0}).is_flat);
}

/// Where no view point is known, noise is the same in all directions.
TEST(plane_estimate, without_view_points_noise_is_isotropic) {
    const patch oblique{
        .center = {2.0, 0.0, -1.0}, .side = {1.0, 0.0, 0.0}, .other_side = {0.0, 1.0, 0.0}};
    clouds::cloud points = oblique.points(2);
    const double variance =
        sigma_of_patch * sigma_of_patch + gnomon::detail::flatness * gnomon::detail::flatness;
    const Eigen::Vector3d nowhere(clouds::nan, clouds::nan, clouds::nan);
    const plane_estimate unknown = estimate_from(points, nowhere), none = estimate(points),
                         seen = estimate_from(points, oblique.eye);
    EXPECT_NEAR(none.covariance(2, 2), variance / static_cast<double>(none.points),
                1e-3 * none.covariance(2, 2));
    EXPECT_EQ(unknown.covariance, none.covariance);
    EXPECT_EQ(unknown.plane.normal, none.plane.normal);
    EXPECT_LT(seen.covariance(2, 2), 0.5 * none.covariance(2, 2)) << "at oblique incidence";
    EXPECT_LT(none.chi2, 0.5 * seen.chi2);
}

/// Then the range is the distance from the origin.
TEST(plane_estimate, without_view_points_the_origin_stands_for_them) {
    const gnomon::noise_curve growing = gnomon::quadratic_noise{0.0, 0.0, 1.0 / 900.0};
    const auto points = patch{}.points(3);  // 3 m away, where this noise is 1 cm
    const auto parts = whole_segment(points.size());
    const auto none = gnomon::estimate_planes(points, parts, growing).at(0);
    const auto seen =
        gnomon::estimate_planes(gnomon::with_viewpoint(points, {0, 0, 0}), parts, growing).at(0);
    EXPECT_TRUE(none.is_flat);
    EXPECT_NEAR(none.chi2, seen.chi2, 0.1);
}

/// Of an invalid return at the origin, and of one far away: the others keep their digits.
TEST(plane_estimate, keeps_its_digits_in_spite_of_a_far_point) {
    const Eigen::Vector3d utm(5e5, 5e6, 100.0);
    auto points = patch{}.points(4);
    const plane_estimate near = estimate(points);
    for (Eigen::Vector3d& p : points) p += utm;
    points.insert(points.begin(), Eigen::Vector3d(0.0, 0.0, 0.0));
    std::vector<std::int32_t> labels(points.size(), 0);
    labels[0] = gnomon::unlabeled;
    const auto far = gnomon::estimate_planes(gnomon::with_viewpoint(points, utm), segments(labels),
                                             noise_of_patch)
                         .at(0);
    EXPECT_TRUE(far.is_flat);
    EXPECT_EQ(far.points, near.points);
    EXPECT_NEAR(std::abs(far.plane.normal.dot(near.plane.normal)), 1.0, 1e-6);
}

TEST(plane_estimate, faces_the_view_point_whatever_its_outliers) {
    auto points =
        patch{.center = {2.0, 0.0, 0.0}, .side = {1, 0, 0}, .other_side = {0, 1, 0}}.points(5);
    points.insert(points.begin(), Eigen::Vector3d(2.0, 0.0, 4.0));  // above the sensor
    EXPECT_GT(estimate_from(points, {0.0, 0.0, 2.0}).plane.normal.z(), 0.9);
    EXPECT_LT(estimate_from(points, {0.0, 0.0, -2.0}).plane.normal.z(), -0.9);
}

TEST(plane_estimate, of_too_few_points_has_no_normal) {
    const clouds::cloud points{{1.0, 2.0, 3.0}, {1.0, 2.5, 3.0}};
    const plane_estimate two = estimate(points);
    EXPECT_EQ(two.points, 2u);
    EXPECT_FALSE(two.is_flat);
    EXPECT_TRUE(two.plane.normal.isZero());
    EXPECT_LE((two.centroid - Eigen::Vector3d(1.0, 2.25, 3.0)).norm(), 1e-12);
    for (const auto& [name, cloud] : clouds::degenerate()) {
        SCOPED_TRACE(name);
        if (cloud.empty()) continue;
        const plane_estimate e = estimate(cloud);
        EXPECT_LE(e.points, cloud.size());
        EXPECT_NEAR(e.plane.normal.norm(), e.plane.normal.isZero() ? 0.0 : 1.0, 1e-9);
        if (e.is_flat) {
            EXPECT_FALSE(e.plane.normal.isZero());
            EXPECT_TRUE(e.covariance.allFinite());
        }
    }
}

/// The planes of the parts of a sphere have hardly a point on them, if no noise is given.
TEST(plane_estimate, is_finite_or_has_no_normal) {
    std::size_t with_normal = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        gnomon::random_stream random(seed);
        clouds::cloud points;
        std::vector<std::int32_t> labels;
        for (int i = 0; i < 2500; ++i) {
            const Eigen::Vector3d p(random.gaussian(), random.gaussian(), random.gaussian());
            points.push_back(5.0 * p.normalized());
            labels.push_back(static_cast<std::int32_t>(std::floor(points.back().z())) + 5);
        }
        for (const double noise : {0.0, 1e-9, 1e-3}) {
            const auto planes =
                gnomon::estimate_planes(gnomon::with_viewpoint(points, {0.0, 0.0, 0.0}),
                                        segments(labels), gnomon::constant_noise{noise});
            for (const plane_estimate& e : planes) {
                EXPECT_TRUE(e.covariance.allFinite()) << seed << ", " << noise;
                EXPECT_TRUE(e.centroid.allFinite() && e.plane.normal.allFinite() &&
                            std::isfinite(e.plane.offset))
                    << seed << ", " << noise;
                with_normal += e.plane.normal.isZero() ? 0 : 1;
            }
        }
    }
    EXPECT_GT(with_normal, 0u);
}

TEST(plane_estimate, passes_over_points_that_are_not_finite) {
    const patch p;
    const auto points = p.points(6);
    clouds::cloud more;
    for (const auto& q : points) {
        more.push_back(q);
        more.push_back({clouds::nan, q.y(), clouds::infinity});
    }
    more.insert(more.begin(), {clouds::nan, clouds::nan, clouds::nan});
    const plane_estimate expected = estimate_from(points, p.eye),
                         found = estimate_from(more, p.eye);
    EXPECT_EQ(found.points, expected.points);
    EXPECT_EQ(found.is_flat, expected.is_flat);
    EXPECT_EQ(found.plane.normal, expected.plane.normal);
    EXPECT_EQ(found.covariance, expected.covariance);
}

/// Law: a motion of points and view points moves planes and changes nothing else, even far from the
/// origin of the coordinates.
TEST(plane_estimate, moves_with_the_points) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const patch p;
        const auto points = p.points(seed);
        const plane_estimate here = estimate_from(points, p.eye);
        const Eigen::Matrix3d r = clouds::random_rotation(seed);
        for (const Eigen::Vector3d& by : {Eigen::Vector3d(1, 2, 3), {6e5, 4.8e6, 100.0}}) {
            const plane_estimate there =
                estimate_from(clouds::moved(points, r, by), r * p.eye + by);
            EXPECT_EQ(there.points, here.points);
            EXPECT_EQ(there.is_flat, here.is_flat);
            EXPECT_LE((there.plane.normal - r * here.plane.normal).norm(), 1e-7);
            EXPECT_LE((there.centroid - r * here.centroid - by).norm(), 1e-7);
            EXPECT_NEAR(there.chi2, here.chi2, 1e-5);
            const Eigen::Matrix3d same = there.axes.transpose() * r * here.axes;  // up to signs
            EXPECT_LE((there.covariance - same * here.covariance * same.transpose()).norm(),
                      1e-5 * here.covariance.norm());
        }
    }
}

/// An estimate for each segment, also for one of no points; the same for every execution.
TEST(plane_estimate, is_one_for_each_segment) {
    clouds::cloud points;
    std::vector<std::int32_t> labels;
    for (std::int32_t s = 0; s < 50; ++s) {
        const patch p{.center = {2.0 + 0.1 * s, 0.0, 0.0}, .n = 60};
        for (const auto& q : p.points(static_cast<std::uint64_t>(s))) {
            points.push_back(q);
            labels.push_back(s % 7 == 3 ? gnomon::unlabeled : s);
        }
    }
    const auto all = gnomon::estimate_planes(points, segments(labels), noise_of_patch);
    ASSERT_EQ(all.size(), 50u);
    for (std::size_t s = 0; s < 50; ++s) EXPECT_EQ(all[s].is_flat, s % 7 != 3);
    for (const unsigned t : {1u, 3u}) {
        const auto again =
            gnomon::estimate_planes(points, segments(labels), noise_of_patch, gnomon::threads{t});
        for (std::size_t s = 0; s < 50; ++s) {
            EXPECT_EQ(again[s].plane.normal, all[s].plane.normal);
            EXPECT_EQ(again[s].covariance, all[s].covariance);
        }
    }
}

TEST(plane_estimate, refuses_other_numbers_of_points) {
    const auto points = clouds::in_cube(10, 1);
    EXPECT_THROW((void)gnomon::estimate_planes(points, segments(), noise_of_patch),
                 std::invalid_argument);
    EXPECT_THROW((void)gnomon::estimate_planes(points, whole_segment(11), noise_of_patch),
                 std::invalid_argument);
}

}  // namespace
