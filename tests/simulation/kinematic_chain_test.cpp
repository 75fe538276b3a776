// SPDX-License-Identifier: BSL-1.0
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/trajectory_laws.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/simulation/kinematic_chain.hpp>
#include <gnomon/simulation/simulate.hpp>
#include <gnomon/simulation/thesis_scenes.hpp>

namespace sim = gnomon::simulation;

namespace {

using gnomon::degrees, gnomon::radians;
using sim::joint_kind, sim::kinematic_chain;
static_assert(sim::sensor_trajectory<sim::joint_motion>);

constexpr double half_pi = 0.5 * std::numbers::pi;

sim::pose any_frame(gnomon::random_stream& random) {
    std::array<double, 6> x{};
    for (double& value : x) value = random.uniform(-3.0, 3.0);
    return sim::at(x[0], x[1], x[2]) * sim::yaw(radians(x[3])) * sim::pitch(radians(x[4])) *
           sim::roll(radians(x[5]));
}

/// A chain of up to 8 joints of both kinds.
kinematic_chain any_chain(gnomon::random_stream& random) {
    kinematic_chain chain{.base = any_frame(random), .tool = any_frame(random)};
    const auto joints = random.below(9);
    for (std::uint64_t i = 0; i < joints; ++i) {
        sim::chain_joint joint;
        joint.theta = radians(random.uniform(-3.0, 3.0));
        joint.d = random.uniform(-1.0, 1.0);
        joint.a = random.uniform(-1.0, 1.0);
        joint.alpha = radians(random.uniform(-3.0, 3.0));
        if (random.uniform() < 0.5) joint.kind = joint_kind::prismatic;
        chain.joints.push_back(joint);
    }
    return chain;
}

std::vector<double> any_values(std::size_t n, gnomon::random_stream& random) {
    std::vector<double> values;
    for (std::size_t i = 0; i < n; ++i) values.push_back(random.uniform(-3.0, 3.0));
    return values;
}

Eigen::Matrix4d homogeneous(const sim::pose& p) {
    Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
    m.topLeftCorner<3, 3>() = p.rotation;
    m.topRightCorner<3, 1>() = p.position;
    return m;
}

/// The oracle: the matrix of a joint as textbooks print it.
Eigen::Matrix4d matrix_of(const sim::chain_joint& joint, double value) {
    const bool turns = joint.kind == joint_kind::revolute;
    const double theta = joint.theta.radians() + (turns ? value : 0.0);
    const double d = joint.d + (turns ? 0.0 : value);
    const double c = std::cos(theta), s = std::sin(theta);
    const double ca = std::cos(joint.alpha.radians()), sa = std::sin(joint.alpha.radians());
    Eigen::Matrix4d m;
    m << c, -s * ca, s * sa, joint.a * c,  //
        s, c * ca, -c * sa, joint.a * s,   //
        0, sa, ca, d,                      //
        0, 0, 0, 1;
    return m;
}

TEST(kinematic_chain, is_the_product_of_homogeneous_matrices) {
    gnomon::random_stream random(20'001);
    for (int trial = 0; trial < 300; ++trial) {
        const kinematic_chain chain = any_chain(random);
        const auto values = any_values(chain.joints.size(), random);
        Eigen::Matrix4d expected = homogeneous(chain.base);
        for (std::size_t i = 0; i < values.size(); ++i)
            expected = expected * matrix_of(chain.joints[i], values[i]);
        expected = expected * homogeneous(chain.tool);
        EXPECT_LT((homogeneous(chain(values)) - expected).norm(), 1e-12);
    }
}

/// Two links in a plane: (a cos q1 + b cos(q1 + q2), a sin q1 + b sin(q1 + q2)).
TEST(kinematic_chain, of_two_links_has_a_closed_form) {
    const kinematic_chain chain{.joints = {{.a = 0.7}, {.a = 0.4}}};
    for (double p = -3.0; p < 3.0; p += 0.37) {
        for (double q = -3.0; q < 3.0; q += 0.41) {
            const sim::pose hand = chain(std::array{p, q});
            const Eigen::Vector3d expected(0.7 * std::cos(p) + 0.4 * std::cos(p + q),
                                           0.7 * std::sin(p) + 0.4 * std::sin(p + q), 0.0);
            EXPECT_LT((hand.position - expected).norm(), 1e-15);
            EXPECT_NEAR(std::remainder(std::atan2(hand.rotation(1, 0), hand.rotation(0, 0)) - p - q,
                                       2 * std::numbers::pi),
                        0.0, 1e-14);
        }
    }
}

TEST(joint_motion, obeys_the_laws) {
    gnomon::random_stream random(20'002);
    for (int trial = 0; trial < 30; ++trial) {
        const kinematic_chain chain = any_chain(random);
        const sim::joint_motion motion{.chain = chain,
                                       .from = any_values(chain.joints.size(), random),
                                       .to = any_values(chain.joints.size(), random),
                                       .duration = random.uniform(0.1, 10.0)};
        laws::poses_are_rigid_and_always_the_same(motion);
        EXPECT_EQ(motion(0.0).position, chain(motion.from).position);
        EXPECT_LT((motion(motion.duration).position - chain(motion.to).position).norm(), 1e-12);
    }
}

/// The arm of Fig. 2.17 (b), hanging from the ceiling: seven revolute joints, the axes of shoulder
/// and wrist each through one point. The thesis gives no lengths; these are of a human arm. The
/// optical axis of the UTM-30LX is the axis of the last joint.
// [hanging_arm]
kinematic_chain hanging_arm() {
    return {.base = sim::at(0.3, 0.0, 2.3) * sim::roll(degrees(180)),
            .joints = {{.d = 0.2, .alpha = degrees(-90)},
                       {.alpha = degrees(90)},
                       {.d = 0.35, .alpha = degrees(-90)},
                       {.alpha = degrees(90)},
                       {.d = 0.3, .alpha = degrees(-90)},
                       {.alpha = degrees(90)},
                       {.d = 0.1}},
            .tool = sim::pitch(degrees(-90))};
}
// [hanging_arm]
const std::vector<double> bent{0.2, 0.4, -0.3, 0.9, 0.1, 0.5, 0.0};

bool have_same_bytes(const sim::true_scan& a, const sim::true_scan& b) {
    return a.scan.size() == b.scan.size() && a.surfaces == b.surfaces &&
           std::memcmp(a.scan.points.data(), b.scan.points.data(),
                       a.scan.size() * sizeof(a.scan.points[0])) == 0;
}

/// Sec. 2.5: an arm at rest gives the scan of one view point.
TEST(joint_motion, at_rest_gives_the_scan_of_a_fixed_sensor) {
    const auto kitchen = sim::scenes::kitchen();
    gnomon::random_stream random(20'003);
    for (int trial = 0; trial < 5; ++trial) {
        auto values = bent;
        for (double& value : values) value += random.uniform(-0.1, 0.1);
        const sim::joint_motion rest{
            .chain = hanging_arm(), .from = values, .to = values, .duration = 0.5};
        const sim::beam b{.sigma = 0.015, .seed = 20'004};
        const auto scan = sim::simulate(kitchen, rest, sim::scanner{}, b);
        EXPECT_EQ(scan.scan.viewpoints.positions().size(), 1u);
        EXPECT_GT(scan.scan.size(), 10'000u);
        const sim::fixed still{.mount = hanging_arm()(values), .duration = 0.5};
        EXPECT_TRUE(have_same_bytes(scan, sim::simulate(kitchen, still, sim::scanner{}, b)));
    }
}

TEST(joint_motion, has_a_view_point_per_scan_line) {
    auto to = bent;
    to[1] += 0.5;
    const sim::joint_motion swing{.chain = hanging_arm(), .from = bent, .to = to, .duration = 1.0};
    const auto scan = sim::simulate(sim::scenes::kitchen(), swing, sim::densities::low());
    EXPECT_EQ(scan.scan.viewpoints.positions().size(), 10u);
    for (std::size_t line = 0; line < 10; ++line) {
        const double seconds = (static_cast<double>(line) + 0.5) / 10.0;
        EXPECT_EQ(scan.scan.viewpoints.positions()[line], swing(seconds).position);
    }
}

/// The last joint of the arm turns the range finder about its optical axis: the rotational scan of
/// Fig. 2.14.
TEST(joint_motion, of_the_wrist_is_a_rotational_scan) {
    auto from = bent, to = bent;
    from.back() = -half_pi;
    to.back() = half_pi;
    const sim::joint_motion wrist{.chain = hanging_arm(), .from = from, .to = to};
    const sim::rotational expected{.mount = hanging_arm()(bent)};
    for (double t = 0.0; t <= 4.0; t += 0.25) {
        EXPECT_LT((wrist(t).position - expected(t).position).norm(), 1e-12);
        EXPECT_LT((wrist(t).rotation - expected(t).rotation).norm(), 1e-12);
    }
}

/// The robot of Fig. 2.17 (a): an LMS-400 with upright scan lines, pitched down by 45 degrees. It
/// turns in place; the sensor is 0.2 m in front of the axis, so that it moves on an arc.
TEST(joint_motion, of_a_turning_robot_is_a_horizontal_scan) {
    const kinematic_chain robot{
        .joints = {{}},
        .tool = sim::at(0.2, 0.0, 1.0) * sim::pitch(degrees(45)) * sim::roll(degrees(90))};
    const sim::joint_motion turn{
        .chain = robot, .from = {-half_pi}, .to = {half_pi}, .duration = 0.455};
    const auto lms_400 = sim::scanners::sick_lms_400();
    const auto truth = sim::simulate(sim::scenes::boxes_and_bin(), turn, lms_400);
    EXPECT_GT(truth.scan.size(), 1000u);
    EXPECT_EQ(truth.scan.viewpoints.positions().size(), 163u);
    for (std::size_t i = 0; i < truth.scan.size(); ++i) {
        const Eigen::Vector3d v = truth.scan.viewpoints[i];
        EXPECT_NEAR(std::hypot(v.x(), v.y()), 0.2, 1e-12);
        // The beams of a line and the axis of the robot lie in one plane.
        EXPECT_NEAR(v.x() * truth.directions[i].y() - v.y() * truth.directions[i].x(), 0.0, 1e-12);
    }
}

TEST(kinematic_chain, rejects_other_numbers_of_values) {
    const kinematic_chain arm = hanging_arm();
    EXPECT_THROW((void)arm(std::vector<double>(6)), std::invalid_argument);
    EXPECT_THROW((void)arm(std::vector<double>(8)), std::invalid_argument);
    const auto scanning = [&](std::vector<double> from, std::vector<double> to) {
        return sim::simulate(sim::scene(), sim::joint_motion{.chain = arm, .from = from, .to = to});
    };
    EXPECT_NO_THROW((void)scanning(bent, bent));
    EXPECT_THROW((void)scanning(bent, {}), std::invalid_argument);
    EXPECT_THROW((void)scanning({}, bent), std::invalid_argument);
    EXPECT_THROW((void)scanning({}, {}), std::invalid_argument);
    auto broken = bent;
    broken[3] = clouds::nan;
    EXPECT_THROW((void)scanning(broken, bent), std::invalid_argument);
}

}  // namespace
