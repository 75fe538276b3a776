// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/features/align_to_surface.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/estimate_normals.hpp>

namespace {

using gnomon::alignment;
using gnomon::degrees;
using gnomon::rigid_motion;
using outcome = gnomon::alignment::outcome;

struct oriented_point {
    Eigen::Vector3d at, normal;
};
using oriented_cloud = std::vector<oriented_point>;

struct oriented_normal {
    Eigen::Vector3d normal;
};

/// The faces of boxes: a seat, a back and two legs.
const std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> chair_boxes{
    {{-0.22, -0.23, 0.42}, {0.23, 0.22, 0.47}},
    {{-0.27, -0.23, 0.30}, {-0.22, 0.22, 0.95}},
    {{0.17, -0.23, 0.0}, {0.23, -0.17, 0.42}},
    {{0.17, 0.16, 0.0}, {0.23, 0.22, 0.42}}};

/// n points, uniform in the area of the faces of boxes that face `from`; of all for NaN.
oriented_cloud on_boxes(std::size_t n, std::uint64_t seed,
                        const Eigen::Vector3d& from = Eigen::Vector3d::Constant(clouds::nan)) {
    gnomon::random_stream random(seed, 11);
    oriented_cloud result;
    while (result.size() < n) {
        const auto& [low, high] = chair_boxes[random.below(chair_boxes.size())];
        const auto axis = static_cast<int>(random.below(3));
        const int other = (axis + 1) % 3, third = (axis + 2) % 3;
        const double area = (high[other] - low[other]) * (high[third] - low[third]);
        const double side = random.below(2) == 0 ? 1.0 : -1.0;
        Eigen::Vector3d p, normal(0, 0, 0);
        normal[axis] = side;
        for (int a = 0; a < 3; ++a) p[a] = random.uniform(low[a], high[a]);
        p[axis] = side > 0 ? high[axis] : low[axis];
        if (random.uniform() * 0.4 > area || normal.dot(p - from) >= 0.0) continue;
        // No sample within another box.
        bool is_inside = false;
        for (const auto& [l, h] : chair_boxes)
            is_inside = is_inside || ((p + 1e-6 * normal - l).minCoeff() > 0 &&
                                      (h - p - 1e-6 * normal).minCoeff() > 0);
        if (!is_inside) result.push_back({p, normal});
    }
    return result;
}

std::vector<Eigen::Vector3d> positions_of(const oriented_cloud& cloud) {
    std::vector<Eigen::Vector3d> p;
    for (const auto& q : cloud) p.push_back(q.at);
    return p;
}

/// Points as a sensor at the origin of its frame measures them, with noise along rays.
struct measured {
    std::vector<Eigen::Vector3d> points;
    rigid_motion truth;  ///< of the sensor in the frame of the surface
};

measured measure(std::size_t n, double sigma, std::uint64_t seed, const rigid_motion& sensor) {
    gnomon::random_stream random(seed, 12);
    measured m{{}, sensor};
    for (const auto& p : on_boxes(n, seed, sensor.position)) {
        const Eigen::Vector3d x = sensor.point_in(p.at);
        m.points.push_back(x + sigma * random.gaussian() * x.normalized());
    }
    return m;
}

rigid_motion sensor_at(double x, double y, double z) {
    rigid_motion m = rigid_motion::on_ground(x, y, degrees(150));
    m.position.z() = z;
    return m;
}

rigid_motion displaced(const rigid_motion& m, double turn, double shift, bool on_ground,
                       std::uint64_t seed) {
    gnomon::random_stream random(seed, 13);
    Eigen::Vector3d w = turn * clouds::gaussian_vector(random).normalized();
    Eigen::Vector3d s = shift * clouds::gaussian_vector(random).normalized();
    if (on_ground) {
        w = Eigen::Vector3d(0, 0, turn);
        s.z() = 0.0;
    }
    rigid_motion d;
    d.rotation = Eigen::AngleAxisd(w.norm(), w.normalized()).toRotationMatrix();
    d.position = s;
    return d * m;
}

/// The parameters of the motion from the estimated pose to the true one, in the terms of the
/// covariance.
Eigen::Matrix<double, 6, 1> error_of(const alignment& a, const rigid_motion& truth) {
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(truth.rotation * a.pose.rotation.transpose()));
    Eigen::Matrix<double, 6, 1> e;
    e.head<3>() = turn.angle() * turn.axis();
    e.tail<3>() = truth.point_out(a.pose.point_in(a.center)) - a.center;
    return e;
}

/// Normalized estimation error squared over the degrees of freedom.
double nees_of(const Eigen::VectorXd& e, const Eigen::MatrixXd& covariance) {
    return e.dot(covariance.inverse() * e) / static_cast<double>(e.size());
}

struct chair_surface {
    oriented_cloud samples = on_boxes(4000, 99);
    gnomon::spatial_index index{samples, gnomon::sequential{}, &oriented_point::at};
};

const chair_surface& the_chair() {
    static const chair_surface chair;
    return chair;
}

TEST(align_to_surface, recovers_motions_exactly_without_noise) {
    const auto& [samples, index] = the_chair();
    for (const bool on_ground : {false, true}) {
        for (std::uint64_t seed = 0; seed < 10; ++seed) {
            const auto m = measure(1500, 0.0, seed, sensor_at(1.5, -1.0, 1.2));
            const auto a = gnomon::align_to_surface(
                gnomon::with_viewpoint(m.points, {0, 0, 0}), index, samples,
                displaced(m.truth, 0.04, 0.02, on_ground, seed),
                {.noise = gnomon::constant_noise{0.0}, .on_ground = on_ground});
            EXPECT_EQ(a.status, outcome::converged) << to_string(a.status) << seed;
            EXPECT_LT(error_of(a, m.truth).norm(), 1e-7) << seed;
            EXPECT_EQ(a.determined, on_ground ? 3u : 6u);
            EXPECT_LT(a.rms, 1e-7);
        }
    }
}

/// 100 draws each: the covariance is that of the errors.
TEST(align_to_surface, covariance_is_that_of_the_errors) {
    const auto& [samples, index] = the_chair();
    for (const bool on_ground : {false, true}) {
        double nees = 0.0;
        constexpr int draws = 100;
        for (std::uint64_t seed = 0; seed < draws; ++seed) {
            const auto m = measure(700, 0.005, seed, sensor_at(1.5, -1.0, 1.2));
            const auto a = gnomon::align_to_surface(
                gnomon::with_viewpoint(m.points, {0, 0, 0}), index, samples,
                displaced(m.truth, 0.02, 0.01, on_ground, seed),
                {.noise = gnomon::constant_noise{0.005}, .on_ground = on_ground});
            ASSERT_EQ(a.status, outcome::converged) << to_string(a.status) << seed;
            const Eigen::VectorXd e = error_of(a, m.truth);
            const Eigen::MatrixXd c = a.covariance;
            nees += on_ground ? nees_of(e.segment(2, 3), c.block(2, 2, 3, 3)) : nees_of(e, c);
            // The same from the other side.
            const alignment b = a.inverse();
            const Eigen::VectorXd f = error_of(b, m.truth.inverse());
            if (!on_ground) {
                EXPECT_NEAR(nees_of(f, b.covariance), nees_of(e, c), 0.05 * nees_of(e, c) + 0.01);
            }
        }
        RecordProperty(on_ground ? "nees_on_ground" : "nees", std::to_string(nees / draws));
        EXPECT_GT(nees / draws, 0.8);
        EXPECT_LT(nees / draws, 1.3);
    }
}

/// Both clouds are measured, and normals are estimated.
TEST(align_to_surface, covariance_includes_the_noise_of_the_surface) {
    double nees = 0.0;
    constexpr int draws = 60;
    for (std::uint64_t seed = 0; seed < draws; ++seed) {
        const auto map = measure(6000, 0.003, 500 + seed, sensor_at(1.6, -0.9, 1.3));
        const auto viewed = gnomon::with_viewpoint(map.points, {0, 0, 0});
        const gnomon::spatial_index index(viewed);
        auto surface = gnomon::estimate_normals(index);
        for (std::size_t i = 0; i < surface.size(); ++i)
            if (surface[i].normal.dot(map.points[i]) > 0.0) surface[i].normal *= -1.0;
        const auto m = measure(1500, 0.003, seed, sensor_at(1.5, -1.0, 1.2));
        const rigid_motion truth = map.truth.inverse() * m.truth;
        const auto a = gnomon::align_to_surface(gnomon::with_viewpoint(m.points, {0, 0, 0}), index,
                                                surface, displaced(truth, 0.01, 0.01, false, seed),
                                                {.noise = gnomon::constant_noise{0.003},
                                                 .surface_noise = gnomon::constant_noise{0.003}});
        ASSERT_EQ(a.status, outcome::converged) << to_string(a.status) << seed;
        nees += nees_of(error_of(a, truth), a.covariance);
    }
    RecordProperty("nees", std::to_string(nees / draws));
    EXPECT_GT(nees / draws, 0.8);
    EXPECT_LT(nees / draws, 1.3);
}

/// View points of the surface that are not finite are unknown.
TEST(align_to_surface, takes_surfaces_of_unknown_view_points) {
    const auto map = measure(6000, 0.003, 500, sensor_at(1.6, -0.9, 1.3));
    auto surface = gnomon::estimate_normals(map.points);
    for (std::size_t i = 0; i < surface.size(); ++i)
        if (surface[i].normal.dot(map.points[i]) > 0.0) surface[i].normal *= -1.0;
    const auto m = measure(1500, 0.003, 7, sensor_at(1.5, -1.0, 1.2));
    const rigid_motion start = displaced(map.truth.inverse() * m.truth, 0.01, 0.01, false, 7);
    const auto aligned = [&](const auto& samples) {
        return gnomon::align_to_surface(m.points, samples, surface, start,
                                        {.noise = gnomon::constant_noise{0.003},
                                         .surface_noise = gnomon::constant_noise{0.003}});
    };
    const auto expected = aligned(map.points);
    ASSERT_EQ(expected.status, outcome::converged);
    const auto found =
        aligned(gnomon::with_viewpoint(map.points, Eigen::Vector3d::Constant(clouds::nan)));
    EXPECT_EQ(found.status, outcome::converged);
    EXPECT_EQ(found.pose.position, expected.pose.position);
    EXPECT_EQ(found.covariance, expected.covariance);
}

TEST(align_to_surface, does_not_depend_on_threads) {
    const auto& [samples, index] = the_chair();
    const auto m = measure(5000, 0.005, 3, sensor_at(1.5, -1.0, 1.2));
    const auto of = [&, &samples = samples, &index = index](const auto& run) {
        return gnomon::align_to_surface(m.points, index, samples,
                                        displaced(m.truth, 0.04, 0.02, false, 1), {}, run);
    };
    const alignment a = of(gnomon::sequential{}), b = of(gnomon::threads{3});
    EXPECT_EQ(a.pose.rotation, b.pose.rotation);
    EXPECT_EQ(a.pose.position, b.pose.position);
    EXPECT_EQ(a.covariance, b.covariance);
    EXPECT_EQ(a.inliers, b.inliers);
}

TEST(align_to_surface, works_far_from_the_origin) {
    const auto& [samples, index] = the_chair();
    const Eigen::Vector3d utm(4e5, 5e6, 500.0);
    const auto m = measure(800, 0.005, 4, sensor_at(1.5, -1.0, 1.2));
    const auto start = displaced(m.truth, 0.02, 0.01, false, 4);
    const auto here = gnomon::align_to_surface(gnomon::with_viewpoint(m.points, {0, 0, 0}), index,
                                               samples, start, {});
    auto points = m.points;
    for (auto& p : points) p += utm;
    rigid_motion moved = start;
    moved.position -= moved.rotation * utm;
    const auto there =
        gnomon::align_to_surface(gnomon::with_viewpoint(points, utm), index, samples, moved, {});
    EXPECT_EQ(there.status, here.status);
    EXPECT_LT((there.pose.point_out(points[0]) - here.pose.point_out(m.points[0])).norm(), 1e-6);
    EXPECT_LT((there.center - here.center).norm(), 1e-6);
    EXPECT_LT((there.covariance - here.covariance).norm(), 1e-4 * here.covariance.norm());
}

/// Nothing holds a plane that slides on itself, nor a cylinder that turns about its axis.
TEST(align_to_surface, names_what_the_points_do_not_determine) {
    oriented_cloud plane, cylinder;
    gnomon::random_stream random(5);
    for (int i = 0; i < 4000; ++i) {
        plane.push_back({{random.uniform(-1, 1), random.uniform(-1, 1), 0.7}, {0, 0, 1}});
        const double a = random.uniform(-3.1416, 3.1416);
        const Eigen::Vector3d n(std::cos(a), std::sin(a), 0);
        cylinder.push_back({0.04 * n + Eigen::Vector3d(0, 0, random.uniform(0, 0.7)), n});
    }
    const auto aligned = [&](const oriented_cloud& surface, bool on_ground, double sigma) {
        const gnomon::spatial_index index(surface, gnomon::sequential{}, &oriented_point::at);
        auto points = positions_of(surface);
        points.resize(500);
        for (std::size_t i = 0; i < points.size(); ++i)
            points[i] += sigma * random.gaussian() * surface[i].normal +
                         Eigen::Vector3d(0.001, 0.002, on_ground ? 0.0 : 0.003);
        return gnomon::align_to_surface(
            points, index, surface, {},
            {.noise = gnomon::constant_noise{sigma}, .on_ground = on_ground});
    };
    for (const double sigma : {0.0, 0.003}) {
        for (const auto& [surface, on_ground, determined] : {std::tuple{&plane, false, 3u},
                                                             {&plane, true, 0u},
                                                             {&cylinder, false, 4u},
                                                             {&cylinder, true, 2u}}) {
            const alignment a = aligned(*surface, on_ground, sigma);
            EXPECT_EQ(a.status, outcome::degenerate) << to_string(a.status);
            EXPECT_EQ(a.determined, determined) << (surface == &plane) << on_ground << sigma;
            EXPECT_TRUE(a.covariance.allFinite());
            EXPECT_GT(a.covariance.diagonal().maxCoeff(), 1e5);
            EXPECT_TRUE(gnomon::is_rigid(a.pose));
        }
    }
    // Estimated normals of a noisy plane hold it no better.
    auto noisy = positions_of(plane);
    for (auto& p : noisy) p.z() += 0.003 * random.gaussian();
    const gnomon::spatial_index index(noisy);
    const auto surface = gnomon::estimate_normals(index);
    const alignment a = gnomon::align_to_surface(
        positions_of(plane), index, surface, {},
        {.noise = gnomon::constant_noise{0.003}, .normal_noise = degrees(3), .two_sided = true});
    EXPECT_EQ(a.status, outcome::degenerate);
    EXPECT_EQ(a.determined, 3u);
}

TEST(align_to_surface, leaves_out_points_without_coordinates_and_outliers) {
    const auto& [samples, index] = the_chair();
    auto m = measure(800, 0.003, 6, sensor_at(1.5, -1.0, 1.2));
    gnomon::random_stream random(6);
    for (int i = 0; i < 200; ++i) {
        m.points.push_back({clouds::nan, 0, 0});
        m.points.push_back(m.points[static_cast<std::size_t>(i)] +
                           0.3 * clouds::gaussian_vector(random));
    }
    const auto a = gnomon::align_to_surface(gnomon::with_viewpoint(m.points, {0, 0, 0}), index,
                                            samples, displaced(m.truth, 0.03, 0.02, false, 6),
                                            {.noise = gnomon::constant_noise{0.003}});
    EXPECT_EQ(a.status, outcome::converged);
    EXPECT_EQ(a.points, 1000u);
    EXPECT_LT(error_of(a, m.truth).tail<3>().norm(), 0.002);
    EXPECT_GT(a.inliers, 780u);
    EXPECT_LT(a.inliers, 850u);
}

// Points far off determine nothing, and hide nothing that the others determine.
TEST(align_to_surface, is_as_certain_with_points_far_off) {
    const auto& [samples, index] = the_chair();
    const auto alone = measure(800, 0.003, 6, sensor_at(1.5, -1.0, 1.2));
    const auto align = [&](const auto& points) {
        return gnomon::align_to_surface(gnomon::with_viewpoint(points, {0, 0, 0}), index, samples,
                                        displaced(alone.truth, 0.03, 0.02, false, 6),
                                        {.noise = gnomon::constant_noise{0.003}});
    };
    const auto expected = align(alone.points);
    ASSERT_EQ(expected.status, outcome::converged);
    for (const double distance : {20.0, 60.0, 1e3, 1e30}) {
        auto points = alone.points;
        for (int i = 0; i < (distance < 1e3 ? 100 : 1); ++i)
            points.insert(points.begin(), Eigen::Vector3d(distance, 0.02 * i, -0.01 * i));
        const auto a = align(points);
        EXPECT_EQ(a.status, outcome::converged) << distance;
        EXPECT_LT((a.pose.position - expected.pose.position).norm(), 1e-3) << distance;
        EXPECT_LT((a.center - expected.center).norm(), 1e-3) << distance;
        EXPECT_NEAR(a.covariance.trace(), expected.covariance.trace(),
                    0.1 * expected.covariance.trace())
            << distance;
    }
}

// Points that are near the surface at the start only have no part in rms, inliers and covariance.
TEST(align_to_surface, forgets_points_that_were_near_the_surface_before) {
    const auto& [samples, index] = the_chair();
    auto m = measure(500, 0.003, 6, sensor_at(1.5, -1.0, 1.2));  // few: not sampled first
    const std::size_t n = m.points.size();
    gnomon::alignment_options options{.noise = gnomon::constant_noise{0.003}};
    const auto align = [&] {
        return gnomon::align_to_surface(gnomon::with_viewpoint(m.points, {0, 0, 0}), index, samples,
                                        displaced(m.truth, 0.03, 0.02, false, 6), options);
    };
    const auto alone = align();
    for (std::size_t i = 0; i < n / 4; ++i)  // 6 cm before the surface
        m.points.push_back(m.points[i] - 0.06 * m.points[i].normalized());
    const auto a = align();
    EXPECT_EQ(a.status, outcome::converged);
    EXPECT_LT(a.inliers, alone.inliers + n / 20);  // few are near another surface
    EXPECT_LT(a.rms, 1.2 * alone.rms);
    EXPECT_GT(a.covariance.trace(), 0.9 * alone.covariance.trace());
    EXPECT_LT(a.covariance.trace(), 1.2 * alone.covariance.trace());
}

TEST(align_to_surface, compares_normals_of_points) {
    const auto& [samples, index] = the_chair();
    const oriented_cloud seen = on_boxes(500, 7);
    oriented_cloud wrong = seen;
    for (auto& p : wrong) p.normal = Eigen::Vector3d(1, 1, 1).normalized();  // 55 degrees to all
    const gnomon::alignment_options options{.noise = gnomon::constant_noise{0.001}};
    const auto good = gnomon::align_to_surface(seen, seen, index, samples, {}, options,
                                               gnomon::sequential{}, &oriented_point::at);
    EXPECT_EQ(good.status, outcome::converged);
    EXPECT_GT(good.inliers, 495u);  // of 500: some have no sample within last_distance
    const auto bad = gnomon::align_to_surface(wrong, wrong, index, samples, {}, options,
                                              gnomon::sequential{}, &oriented_point::at);
    EXPECT_EQ(bad.status, outcome::too_few_points);
    EXPECT_EQ(bad.inliers, 0u);
    EXPECT_TRUE(bad.covariance.allFinite());
}

TEST(align_to_surface, finds_the_front_of_a_board_with_many_samples_on_its_back) {
    // Of each point the 12 nearest samples are on the back, 1 cm behind it, but not all 64.
    std::vector<Eigen::Vector3d> samples, points;
    std::vector<oriented_normal> normals, own;
    const auto grid = [](double spacing, double z, Eigen::Vector3d n, auto& at, auto& of) {
        for (double x = -0.1; x < 0.1; x += spacing)
            for (double y = -0.1; y < 0.1; y += spacing) {
                at.push_back({x, y, z});
                of.push_back({n});
            }
    };
    grid(0.02, 0.0, {0, 0, 1}, samples, normals);
    grid(0.003, -0.01, {0, 0, -1}, samples, normals);
    grid(0.02, 0.0, {0, 0, 1}, points, own);
    for (Eigen::Vector3d& p : points) p += Eigen::Vector3d(0.01, 0.01, 0.001);  // between samples
    const rigid_motion sensor{Eigen::Matrix3d::Identity(), {0, 0, 2}};
    for (Eigen::Vector3d& p : points) p = sensor.point_in(p);
    gnomon::spatial_index seen(points);
    seen.viewpoints = Eigen::Vector3d(0, 0, 0);
    const auto found = gnomon::align_to_surface(seen, own, samples, normals, sensor);
    EXPECT_EQ(found.inliers, points.size());
    EXPECT_NEAR(found.pose.position.z(), 1.999, 1e-6);
    EXPECT_NEAR(found.rms, 0.0, 1e-6);
}

TEST(align_to_surface, names_too_few_points) {
    const auto& [samples, index] = the_chair();
    const std::vector<Eigen::Vector3d> none, few(3, samples[0].at), away(50, {9, 9, 9});
    for (const auto& points : {none, few, away}) {
        const auto a = gnomon::align_to_surface(points, index, samples);
        EXPECT_EQ(a.status, outcome::too_few_points);
        EXPECT_EQ(a.pose.rotation, Eigen::Matrix3d::Identity());
        EXPECT_TRUE(a.covariance.allFinite());
        EXPECT_EQ(a.determined, 0u);
    }
    EXPECT_EQ(gnomon::align_to_surface(few, none, oriented_cloud{}).status,
              outcome::too_few_points);
}

TEST(align_to_surface, refuses_what_cannot_be_meant) {
    const auto& [samples, index] = the_chair();
    const auto points = positions_of(samples);
    const auto align = [&, &samples = samples, &index = index](const rigid_motion& start,
                                                               const gnomon::alignment_options& o) {
        return gnomon::align_to_surface(points, index, samples, start, o);
    };
    rigid_motion doubled;
    doubled.rotation *= 2.0;
    EXPECT_THROW((void)align(doubled, {}), std::invalid_argument);
    EXPECT_THROW((void)align({}, {.max_distance = -1.0}), std::invalid_argument);
    EXPECT_THROW((void)align({}, {.max_distance = clouds::nan}), std::invalid_argument);
    EXPECT_THROW((void)align({}, {.last_distance = 0.2}), std::invalid_argument);
    EXPECT_THROW((void)align({}, {.last_distance = 0.0}), std::invalid_argument);
    EXPECT_THROW((void)align({}, {.max_angle = degrees(-1)}), std::invalid_argument);
    EXPECT_THROW((void)align({}, {.normal_noise = degrees(91)}), std::invalid_argument);
    EXPECT_THROW((void)align({}, {.max_iterations = 0}), std::invalid_argument);
    const oriented_cloud fewer(samples.begin(), samples.end() - 1);
    EXPECT_THROW((void)gnomon::align_to_surface(points, index, fewer), std::invalid_argument);
    EXPECT_THROW((void)gnomon::align_to_surface(points, fewer, index, samples),
                 std::invalid_argument);
}

}  // namespace
