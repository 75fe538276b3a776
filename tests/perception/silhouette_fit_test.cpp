// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/features/alignment.hpp>
#include <gnomon/occlusion/visibility.hpp>
#include <gnomon/perception/detail/ground_motions.hpp>
#include <gnomon/perception/detail/silhouette_fit.hpp>
#include <gnomon/recognition/surface_model.hpp>
#include <gnomon/recognition/vertical_symmetry.hpp>
#include <gnomon/simulation.hpp>
#include <gnomon/simulation/sample_surface.hpp>

namespace rec = gnomon::recognition;
namespace sim = gnomon::simulation;

namespace {

using gnomon::degrees;
using gnomon::rigid_motion;

const gnomon::noise_curve table_noise = gnomon::constant_noise{0.004};
const gnomon::angle beams_at_table = gnomon::radians(0.010);
const Eigen::Vector3d upwards(0.0, 0.0, 1.0);

rec::surface_model sampled_surface(const sim::furniture_model& model) {
    const auto samples = sim::sample_surface(model, {.spacing = 0.02});
    return rec::surface_model(samples, samples, 0.02, std::nullopt, &sim::surface_sample::position);
}

const sim::furniture_model dining_table = sim::furniture_models()[6];
const rigid_motion where_table_is = rigid_motion::on_ground(2.4, 0.5, degrees(25));

/// A table on a floor, seen from one or two places, and what is next to it.
struct table_scene {
    gnomon::scan scan;
    std::vector<std::int32_t> groups;  ///< of the points: 0 for table and shelf

    /// @param shelf  as high as the table, at its end
    explicit table_scene(gnomon::angle divergence, bool shelf = false, int sensors = 1) {
        sim::scene world;
        world.add_object("floor", sim::plane_patch{.length = 9.0, .width = 9.0},
                         sim::at(2.0, 0.0, 0.0));
        const auto table = sim::add(world, dining_table, where_table_is);
        const double top = sampled_surface(dining_table).high().z();
        std::int32_t beside = -2;
        if (shelf) {
            const auto at = where_table_is * rigid_motion::on_ground(1.05, 0.0, degrees(0));
            beside = world.add_object("shelf", sim::box{0.4, 1.2, top},
                                      {at.rotation, {at.position.x(), at.position.y(), 0.5 * top}});
        }
        sim::beam beam{.sigma = 0.004, .seed = 7};
        if (divergence > degrees(0.0))
            beam.footprint = {
                .divergence = divergence, .sub_rays = 9, .rule = sim::echo_rule::averaged};
        std::vector<Eigen::Vector3d> from;
        std::vector<std::uint32_t> line;
        for (int s = 0; s < sensors; ++s) {
            const Eigen::Vector3d place(0.0, -3.0 * s, 1.5);
            const auto truth = sim::simulate(
                world,
                sim::vertical{.mount = sim::at(place.x(), place.y(), place.z()), .duration = 8.0},
                sim::scanner{}, beam);
            from.push_back(place);
            for (std::size_t i = 0; i < truth.scan.size(); ++i) {
                scan.points.push_back(truth.scan.points[i]);
                line.push_back(static_cast<std::uint32_t>(s));
                const std::int32_t o = truth.objects[i];
                groups.push_back(o == table || o == beside ? 0 : -1);
            }
        }
        scan.viewpoints = gnomon::viewpoint_table(std::move(from), std::move(line));
    }

    [[nodiscard]] gnomon::visibility seen() const {
        return gnomon::visibility(scan, {.noise = table_noise});
    }
    [[nodiscard]] rec::detail::imaged_points imaged() const {
        return {groups, [this](gnomon::point_index i) { return scan.points[i]; }};
    }
};

/// An alignment that is off by a shift along the table, which is not known, and one across it,
/// which is known to 2 mm.
gnomon::alignment aligned_off(double along, const rigid_motion& truth = where_table_is) {
    gnomon::alignment a;
    a.pose = truth * rigid_motion::on_ground(along, 0.002, degrees(0.1));
    a.center = a.pose.position + Eigen::Vector3d(0.0, 0.0, 0.7);
    const Eigen::Vector3d ahead = truth.direction_out({1, 0, 0}), left = upwards.cross(ahead);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            a.covariance(i, j) = 1e-4 * upwards[i] * upwards[j];
            a.covariance(3 + i, 3 + j) = 1e6 * ahead[i] * ahead[j] + 4e-6 * left[i] * left[j];
        }
    a.determined = 2;
    a.status = gnomon::alignment::outcome::degenerate;
    return a;
}

gnomon::alignment fitted_table(const gnomon::alignment& found, const table_scene& scene,
                               gnomon::angle divergence) {
    static const rec::surface_model model = sampled_surface(dining_table);
    return rec::detail::by_silhouette(found, model, scene.seen(), scene.imaged(), table_noise,
                                      divergence, upwards);
}

/// Of a pose of the table [m].
Eigen::Vector3d table_error(const gnomon::alignment& a) {
    return where_table_is.direction_in(a.pose.position - where_table_is.position);
}

/// A table that slides along itself is brought to where its ends are, and as certain as that.
TEST(silhouette_fit, finds_where_a_table_ends) {
    for (const gnomon::angle divergence : {degrees(0.0), beams_at_table}) {
        for (const int sensors : {1, 2}) {
            const table_scene scene(divergence, false, sensors);
            for (const double off : {-0.06, -0.03, 0.0, 0.03, 0.06}) {
                const auto a = fitted_table(aligned_off(off), scene, divergence);
                EXPECT_LT(std::abs(table_error(a).x()), 0.012) << off << " " << sensors;
                EXPECT_LT(std::abs(table_error(a).y()), 0.006) << off;
                EXPECT_LT(std::abs(a.pose.position.z()), 1e-9);
                EXPECT_EQ(a.status, gnomon::alignment::outcome::degenerate);
                const Eigen::Vector3d ahead = where_table_is.direction_out({1, 0, 0});
                const double deviation =
                    std::sqrt(ahead.dot(a.covariance.bottomRightCorner<3, 3>() * ahead));
                EXPECT_LT(deviation, 0.02);
                EXPECT_LT(std::abs(table_error(a).x()), 4.0 * deviation);
            }
        }
    }
}

/// Where a surface goes on beyond one end, the other end decides.
TEST(silhouette_fit, does_not_slide_onto_what_is_next_to_it) {
    const table_scene scene(beams_at_table, true);
    for (const double off : {-0.04, 0.0, 0.04})
        EXPECT_LT(std::abs(table_error(fitted_table(aligned_off(off), scene, beams_at_table)).x()),
                  0.02)
            << off;
}

/// What is known to millimeters stays.
TEST(silhouette_fit, leaves_what_is_known) {
    const table_scene scene(beams_at_table);
    auto known = aligned_off(0.01);
    known.covariance = 1e-6 * gnomon::alignment::covariance_matrix::Identity();
    const auto a = fitted_table(known, scene, beams_at_table);
    EXPECT_EQ(a.pose.position, known.pose.position);
    EXPECT_EQ(a.covariance, known.covariance);
}

/// An object that no ray meets stays, as one around the sensor does.
TEST(silhouette_fit, without_rays_stays) {
    const table_scene scene(beams_at_table);
    for (const auto& [x, y] : {std::pair(2.4, 40.0), std::pair(0.0, 0.0)}) {
        const auto lost = aligned_off(0.0, rigid_motion::on_ground(x, y, degrees(0)));
        const auto a = fitted_table(lost, scene, beams_at_table);
        EXPECT_LT((a.pose.position - lost.pose.position).norm(), 0.2);
        EXPECT_TRUE(a.covariance.allFinite());
    }
    gnomon::scan nothing;
    const std::vector<std::int32_t> none;
    const auto found = aligned_off(0.02);
    const auto a = rec::detail::by_silhouette(found, sampled_surface(dining_table),
                                              gnomon::visibility(nothing), {none, {}}, table_noise,
                                              beams_at_table, upwards);
    EXPECT_EQ(a.pose.position, found.pose.position);
}

rec::silhouette_match match_of(const sim::furniture_model& model, const table_scene& scene,
                               const rigid_motion& pose, gnomon::angle divergence) {
    const rec::surface_model surface = sampled_surface(model);
    return rec::detail::silhouette_fit(scene.seen(), scene.imaged(), table_noise, divergence,
                                       surface, pose)
        .match(pose);
}

/// A silhouette agrees with the object at its pose, and less where it is shifted.
TEST(silhouette_match, is_best_at_the_pose) {
    for (const gnomon::angle divergence : {degrees(0.0), beams_at_table}) {
        const table_scene scene(divergence);
        const auto at = match_of(dining_table, scene, where_table_is, divergence);
        EXPECT_GT(at.rays, 500u);
        EXPECT_GT(at.overlap, 0.85);
        EXPECT_LT(at.beyond, 0.1);
        double before = at.overlap;
        for (const double off : {0.1, 0.3, 0.6}) {
            const auto shifted = match_of(
                dining_table, scene,
                where_table_is * rigid_motion::on_ground(off, 0.0, degrees(0.0)), divergence);
            EXPECT_LT(shifted.overlap, before) << off;
            EXPECT_GT(shifted.beyond, at.beyond) << off;
            before = shifted.overlap;
        }
    }
}

/// Of a part of something larger, the surface goes on beyond the silhouette: here of half a table.
TEST(silhouette_match, tells_a_part_from_a_whole) {
    const table_scene scene(beams_at_table);
    const auto whole = match_of(dining_table, scene, where_table_is, beams_at_table);
    sim::furniture_model smaller = dining_table;
    std::get<sim::table>(smaller.piece).length *= 0.5;
    const auto part = match_of(smaller, scene, where_table_is, beams_at_table);
    EXPECT_GT(part.beyond, whole.beyond + 0.2);
    EXPECT_LT(part.overlap, whole.overlap);
}

/// What no ray meets is not known.
TEST(silhouette_match, of_no_rays_is_none) {
    const table_scene scene(beams_at_table);
    const auto none = match_of(dining_table, scene, rigid_motion::on_ground(2.4, 40.0, degrees(0)),
                               beams_at_table);
    EXPECT_EQ(none.rays, 0u);
    EXPECT_EQ(none.overlap, 0.0);
    EXPECT_EQ(none.beyond, 0.25);
}

/// Without a motion nothing changes, but rounding; the motions are those of the covariance.
TEST(ground_motions, are_along_the_axes_of_the_covariance) {
    const auto found = aligned_off(0.0);
    const rec::detail::ground_motions motions(found, sampled_surface(dining_table), upwards);
    const Eigen::Vector3d variances = motions.variances();
    EXPECT_NEAR(variances[0], 1e6, 1.0);
    EXPECT_GT(variances[1], variances[2]);
    EXPECT_NEAR(variances[2], 4e-6, 1e-9);
    const auto same = motions.after({0.0, 0.0, 0.0}, variances.asDiagonal());
    EXPECT_LT((same.pose.position - found.pose.position).norm(), 1e-12);
    EXPECT_LT((same.covariance - found.covariance).norm(), 1e-6);
    const auto shifted = motions.after({0.05, 0.0, 0.0}, variances.asDiagonal());
    EXPECT_NEAR(std::abs(table_error(shifted).x() - table_error(found).x()), 0.05, 1e-6);
    EXPECT_LT((shifted.center - found.center - shifted.pose.position + found.pose.position).norm(),
              1e-9);
    // A turn about the center moves what is half of the mean side off by its length.
    const auto turned = motions.pose_after({0.0, 0.01, 0.0});
    EXPECT_LT((turned.point_out(found.pose.point_in(found.center)) - found.center).norm(), 1e-9);
    EXPECT_GT((turned.rotation - found.pose.rotation).norm(), 0.01);
}

/// A surface of revolution does not turn: however uncertain a turn about its axis is, shifts are as
/// certain as at one heading, and so is the place of its axis at any heading.
TEST(ground_motions, of_a_surface_of_revolution_are_shifts) {
    const auto round = sampled_surface(sim::furniture_models()[8]);
    ASSERT_EQ(round.symmetry().order, rec::vertical_symmetry::any_turn);
    auto found = aligned_off(0.0);
    const Eigen::Vector3d axis =
        found.pose.point_out({round.symmetry().x, round.symmetry().y, 0.0});
    found.center = axis + Eigen::Vector3d(-0.3, 0.1, 0.4);
    Eigen::Matrix<double, 6, 1> turn;  // about the axis
    turn << upwards, upwards.cross(found.center - axis);
    found.covariance = 1e6 * turn * turn.transpose();
    found.covariance(3, 3) += 1e-4;
    found.covariance(4, 4) += 1e-6;
    const rec::detail::ground_motions motions(found, round, upwards);
    EXPECT_NEAR(motions.variances()[0], 1e-4, 1e-9);
    EXPECT_NEAR(motions.variances()[1], 1e-6, 1e-9);
    EXPECT_NEAR(motions.variances()[2], 0.0, 1e-9);
    const Eigen::Vector3d known(1e-4, 1e-6, 0.0);
    for (const auto& a : {motions.after({0.0, 0.0, 0.0}, known.asDiagonal()), motions.unmoved()}) {
        const auto c = a.covariance_about(axis);
        EXPECT_NEAR(c(2, 2), std::numbers::pi * std::numbers::pi / 3.0, 1e-9);
        EXPECT_NEAR(c(3, 3), 1e-4, 1e-9);
        EXPECT_NEAR(c(4, 4), 1e-6, 1e-9);
        EXPECT_NEAR(c(5, 5), 0.0, 1e-9);
    }
}

}  // namespace
