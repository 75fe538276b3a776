// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <gnomon/core.hpp>
#include <gnomon/perception/find_objects.hpp>
#include <gnomon/simulation.hpp>
#include <gnomon/simulation/sample_surface.hpp>

namespace rec = gnomon::recognition;
namespace sim = gnomon::simulation;

namespace {

using gnomon::degrees;

const gnomon::noise_curve find_noise = gnomon::constant_noise{0.005};

std::vector<sim::furniture_model> chair_and_table() {
    const auto all = sim::furniture_models();
    return {all[0], all[10]};  // a kitchen chair and a side table
}

/// Learned from views of each alone.
/// @param has_poses  of the views, which vote then
rec::object_finder learned_finder(bool has_poses = true) {
    rec::object_finder finder;
    for (const auto& model : chair_and_table()) {
        const auto samples = sim::sample_surface(model, {.spacing = 0.02});
        const std::size_t number =
            finder.add(model.name, rec::surface_model(samples, samples, 0.02, std::nullopt,
                                                      &sim::surface_sample::position));
        for (std::uint64_t v = 0; v < 10; ++v) {
            const auto shot = sim::simulate_object_view(model, v, {.seed = 3});
            const auto seen = rec::perceive_views(shot.truth.scan, {.ground = gnomon::plane{},
                                                                    .noise = find_noise,
                                                                    .gap = rec::infinite_gap,
                                                                    .min_points = 10});
            for (const rec::view& view : seen.views)
                if (has_poses)
                    finder.learn(view, shot.pose, number);
                else
                    finder.learn(view, number);
        }
    }
    finder.fit();
    return finder;
}

const rec::object_finder& finder_of_two() {
    static const rec::object_finder finder = learned_finder();
    return finder;
}

const gnomon::rigid_motion chair_pose = gnomon::rigid_motion::on_ground(2.0, 0.6, degrees(160));
const gnomon::rigid_motion table_pose = gnomon::rigid_motion::on_ground(2.1, -0.05, degrees(10));

/// A room with a chair that touches a table, and a box; 0 is the chair, 1 the table, -1 all else.
struct small_room {
    gnomon::scan scan;
    std::vector<int> object_of;

    explicit small_room(bool has_floor = true) {
        sim::scene world;
        if (has_floor)
            world.add_object("floor", sim::plane_patch{.length = 5.0, .width = 5.0},
                             sim::at(2.0, 0.0, 0.0));
        world.add_object("carton", sim::box{0.4, 0.3, 0.5}, sim::at(2.8, 0.9, 0.25));
        const auto models = chair_and_table();
        const auto chair = sim::add(world, models[0], chair_pose);
        const auto table = sim::add(world, models[1], table_pose);
        auto truth =
            sim::simulate(world, sim::vertical{.mount = sim::at(0.0, 0.0, 1.2), .duration = 4.0},
                          sim::scanner{}, {.sigma = 0.005, .seed = 5});
        for (const std::int32_t o : truth.objects)
            object_of.push_back(o == chair ? 0 : o == table ? 1 : -1);
        scan = std::move(truth.scan);
    }
};

/// Checks what was found in a room that was moved by a motion.
void expect_chair_and_table(const rec::found_objects& found, const small_room& room,
                            const gnomon::rigid_motion& motion = {}) {
    ASSERT_EQ(found.objects.size(), 2u);
    ASSERT_EQ(found.points.labels().size(), room.scan.size());
    for (std::size_t i = 0; i < 2; ++i) {
        const rec::found_object& o = found.objects[i];
        const auto truth = motion * (o.object == 0 ? chair_pose : table_pose);
        EXPECT_LT((o.aligned.pose.position - truth.position).norm(), 0.02);
        const Eigen::Vector3d ahead = truth.direction_in(o.aligned.pose.direction_out({1, 0, 0}));
        const int order = finder_of_two().surfaces()[o.object].symmetry().order;
        const double period = 2.0 * 3.141592653589793 / order;
        EXPECT_LT(std::abs(std::remainder(std::atan2(ahead.y(), ahead.x()), period)), 0.035);
        EXPECT_GE(o.probability, 0.5);
        std::size_t own = 0, all = 0;
        for (std::size_t k = 0; k < room.scan.size(); ++k) {
            if (found.points.labels()[k] != static_cast<int>(i)) continue;
            ++all;
            own += room.object_of[k] == static_cast<int>(o.object) ? 1 : 0;
        }
        EXPECT_GT(own, 9 * all / 10);
        EXPECT_GT(all, 100u);
    }
    EXPECT_NE(found.objects[0].object, found.objects[1].object);
    EXPECT_GE(found.objects[0].probability, found.objects[1].probability);
}

TEST(find_objects, finds_objects_that_touch_on_any_number_of_threads) {
    const small_room room;
    const auto found = finder_of_two()(room.scan, {.noise = find_noise});
    expect_chair_and_table(found, room);
    const auto again = finder_of_two()(room.scan, {.noise = find_noise}, gnomon::threads{3});
    ASSERT_EQ(again.objects.size(), found.objects.size());
    EXPECT_EQ(again.points.labels(), found.points.labels());
    for (std::size_t i = 0; i < found.objects.size(); ++i) {
        EXPECT_EQ(again.objects[i].probability, found.objects[i].probability);
        EXPECT_EQ(again.objects[i].aligned.pose.position, found.objects[i].aligned.pose.position);
    }
    expect_chair_and_table(finder_of_two()(room.scan), room);  // with the noise measured
}

TEST(find_objects, finds_the_same_far_from_the_origin_and_with_missing_points) {
    small_room room;
    gnomon::rigid_motion motion;
    motion.rotation = Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    motion.position = {4e5, 5e6, 300};
    for (auto& p : room.scan.points) p = motion.point_out(p);
    std::vector<Eigen::Vector3d> places;
    room.scan.viewpoints = Eigen::Vector3d(motion.point_out({0.0, 0.0, 1.2}));
    room.scan.points[11] = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    expect_chair_and_table(finder_of_two()(room.scan, {.noise = find_noise}), room, motion);
}

/// Where the sensor saw through, and where nothing fits, there is none.
TEST(find_objects, finds_nothing_where_nothing_is) {
    sim::scene world;
    world.add_object("floor", sim::plane_patch{.length = 5.0, .width = 5.0},
                     sim::at(2.0, 0.0, 0.0));
    world.add_object("carton", sim::box{0.5, 0.5, 0.45}, sim::at(2.0, 0.3, 0.225));
    world.add_object("carton", sim::box{0.5, 0.05, 0.9}, sim::at(2.0, -0.6, 0.45));
    const auto truth =
        sim::simulate(world, sim::vertical{.mount = sim::at(0.0, 0.0, 1.2), .duration = 4.0},
                      sim::scanner{}, {.sigma = 0.005, .seed = 6});
    const auto found = finder_of_two()(truth.scan, {.noise = find_noise});
    EXPECT_TRUE(found.objects.empty());
    EXPECT_FALSE(found.seen.views.empty());
    EXPECT_EQ(found.points.size(), 0u);
}

/// The right object is probable at its place, another one there is not.
TEST(find_objects, verifies_hypotheses_of_others) {
    const small_room room;
    const auto near = gnomon::rigid_motion::on_ground(0.05, -0.04, degrees(6));
    const std::vector<rec::object_place> places{
        {0, chair_pose * near, 0.0},
        {1, chair_pose * near, 0.0},
        {0, table_pose * near, 0.0},
        {1, table_pose * near, 0.0},
        {0, gnomon::rigid_motion::on_ground(0.0, 5.0, degrees(0)), 0.0}};  // no points are there
    const auto& finder = finder_of_two();
    const auto verified = finder.verify(room.scan, places, {.noise = find_noise});
    ASSERT_EQ(verified.size(), places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        EXPECT_EQ(verified[i].object, places[i].object);
        const bool is_right = i == 0 || i == 3;
        EXPECT_EQ(verified[i].probability > 0.5, is_right) << i;
    }
    EXPECT_LT((verified[0].aligned.pose.position - chair_pose.position).norm(), 0.02);
    EXPECT_LT((verified[3].aligned.pose.position - table_pose.position).norm(), 0.02);
    EXPECT_EQ(verified[4].probability, 0.0);
    const auto again = finder.verify(room.scan, places, {.noise = find_noise}, gnomon::threads{3});
    for (std::size_t i = 0; i < places.size(); ++i)
        EXPECT_EQ(again[i].probability, verified[i].probability);

    const auto wide = finder.verify(room.scan, places,
                                    {.noise = find_noise, .divergence = gnomon::radians(0.01)});
    for (std::size_t i = 0; i < places.size(); ++i) {
        EXPECT_EQ(wide[i].probability > 0.5, verified[i].probability > 0.5) << i;
        EXPECT_LT((wide[i].aligned.pose.position - verified[i].aligned.pose.position).norm(), 0.02);
    }
    EXPECT_EQ(wide[4].aligned.pose.position, places[4].pose.position);  // as no points are there

    EXPECT_TRUE(finder.verify(room.scan, {}, {.noise = find_noise}).empty());
    const auto nowhere = finder.verify(gnomon::scan{}, places);
    ASSERT_EQ(nowhere.size(), places.size());
    EXPECT_EQ(nowhere[0].probability, 0.0);
    const std::vector<rec::object_place> unknown{{2, chair_pose, 0.0}};
    EXPECT_THROW(static_cast<void>(finder.verify(room.scan, unknown)), std::invalid_argument);
    std::vector<rec::object_place> skewed{{0, chair_pose, 0.0}};
    skewed[0].pose.rotation(0, 1) += 0.5;
    EXPECT_THROW(static_cast<void>(finder.verify(room.scan, skewed)), std::invalid_argument);
}

TEST(find_objects, of_no_points_or_no_ground_are_none) {
    const auto none = finder_of_two()(gnomon::scan{});
    EXPECT_TRUE(none.objects.empty());
    const small_room room(false);
    EXPECT_TRUE(finder_of_two()(room.scan, {.noise = find_noise}).objects.empty());
    expect_chair_and_table(
        finder_of_two()(room.scan, {.noise = find_noise, .ground = gnomon::plane{}}), room);
    const small_room whole;
    EXPECT_TRUE(rec::object_finder{}(whole.scan, {.noise = find_noise}).objects.empty());
}

/// A scan without view points is one from the origin.
TEST(find_objects, is_seen_from_the_origin_without_view_points) {
    small_room room;
    const Eigen::Vector3d sensor(0.0, 0.0, 1.2);
    for (auto& p : room.scan.points) p -= sensor;
    room.scan.viewpoints = Eigen::Vector3d(0.0, 0.0, 0.0);
    const auto found = finder_of_two()(room.scan, {.noise = find_noise});
    expect_chair_and_table(found, room, {Eigen::Matrix3d::Identity(), -sensor});
    room.scan.viewpoints = gnomon::viewpoint_table();
    const auto again = finder_of_two()(room.scan, {.noise = find_noise});
    ASSERT_EQ(again.objects.size(), found.objects.size());
    for (std::size_t i = 0; i < found.objects.size(); ++i) {
        EXPECT_EQ(again.objects[i].aligned.pose.position, found.objects[i].aligned.pose.position);
        EXPECT_EQ(again.objects[i].aligned.covariance, found.objects[i].aligned.covariance);
    }
}

/// An object of which only the surface is known is found by that.
TEST(find_objects, finds_an_object_without_views) {
    const auto models = chair_and_table();
    rec::object_finder finder = finder_of_two();
    const auto samples = sim::sample_surface(sim::furniture_models()[8], {.spacing = 0.02});
    const std::size_t number = finder.add(
        "round table",
        rec::surface_model(samples, samples, 0.02, std::nullopt, &sim::surface_sample::position));
    sim::scene world;
    world.add_object("floor", sim::plane_patch{.length = 5.0, .width = 5.0},
                     sim::at(2.0, 0.0, 0.0));
    const auto where = gnomon::rigid_motion::on_ground(2.2, 0.3, degrees(0));
    (void)sim::add(world, sim::furniture_models()[8], where);
    const auto truth =
        sim::simulate(world, sim::vertical{.mount = sim::at(0.0, 0.0, 1.2), .duration = 4.0},
                      sim::scanner{}, {.sigma = 0.005, .seed = 5});
    const auto found = finder(truth.scan, {.noise = find_noise});
    ASSERT_EQ(found.objects.size(), 1u);
    EXPECT_EQ(found.objects[0].object, number);
    EXPECT_LT((found.objects[0].aligned.pose.position - where.position).norm(), 0.02);
    // Its heading is anything, and its place is known, whatever point it turns about.
    const auto& aligned = found.objects[0].aligned;
    const auto c = aligned.covariance_about(aligned.pose.position);
    EXPECT_NEAR(std::sqrt(c(2, 2)), std::numbers::pi / std::sqrt(3.0), 1e-9);
    for (const int axis : {0, 1}) {
        const double deviation = std::sqrt(c(3 + axis, 3 + axis));
        EXPECT_LT(deviation, 0.003);
        EXPECT_LT(std::abs(aligned.pose.position[axis] - where.position[axis]), 3.0 * deviation);
    }
    // Less probable objects, for which its parts vote, take no cells from it.
    const auto more = finder(truth.scan, {.noise = find_noise, .min_probability = 0.0});
    ASSERT_GE(more.objects.size(), 1u);
    EXPECT_EQ(more.objects[0].object, number);
    EXPECT_EQ(more.objects[0].aligned.pose.position, found.objects[0].aligned.pose.position);
}

/// Views without poses do not vote, and teach the recognizer what views with poses do.
TEST(find_objects, recognizes_by_views_without_poses) {
    const small_room room;
    const auto found = learned_finder(false)(room.scan, {.noise = find_noise});
    expect_chair_and_table(found, room);
    const auto voted = finder_of_two()(room.scan, {.noise = find_noise});
    for (const rec::found_object& o : found.objects) {
        EXPECT_EQ(o.votes, 0.0);
        EXPECT_LT(o.log_recognized, 0.0);
        const auto same = std::ranges::find(voted.objects, o.object, &rec::found_object::object);
        ASSERT_NE(same, voted.objects.end());
        EXPECT_GT(same->votes, 0.0);
        EXPECT_NEAR(same->log_recognized, o.log_recognized, 0.2);
    }
}

/// A view that is refused is stored nowhere: the finder goes on as before.
TEST(find_objects, forgets_a_view_that_it_refused) {
    rec::object_finder finder = finder_of_two();
    const auto shot = sim::simulate_object_view(chair_and_table()[0], 20, {.seed = 3});
    auto seen = rec::perceive_views(
        shot.truth.scan,
        {.ground = gnomon::plane{}, .noise = find_noise, .gap = rec::infinite_gap});
    ASSERT_FALSE(seen.views.empty());
    rec::view& bad = seen.views[0];
    bad.ground->normal *= 2.0;
    EXPECT_THROW(finder.learn(bad, shot.pose, 0), std::invalid_argument);
    EXPECT_THROW(finder.learn(bad, 0), std::invalid_argument);
    bad.ground = gnomon::plane{};
    bad.parts.at(0).shape.frame.box_center.x() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(finder.learn(bad, shot.pose, 0), std::invalid_argument);
    EXPECT_THROW(finder.learn(bad, 0), std::invalid_argument);
    const small_room room;
    expect_chair_and_table(finder(room.scan, {.noise = find_noise}), room);
}

/// What no points were aligned with is anywhere.
TEST(find_objects, is_uncertain_where_nothing_is) {
    const std::vector<rec::object_place> places{
        {0, gnomon::rigid_motion::on_ground(0.0, 5.0, degrees(0)), 0.0}};
    for (const auto& scan : {small_room().scan, gnomon::scan{}}) {
        for (const double width : {0.0, 0.01}) {
            const auto lost = finder_of_two().verify(
                scan, places, {.noise = find_noise, .divergence = gnomon::radians(width)});
            EXPECT_GT(lost.at(0).aligned.covariance(3, 3), 1e5);
            EXPECT_GT(lost.at(0).aligned.covariance(2, 2), 1e5);
        }
    }
    // On a given ground, whatever is up.
    const auto lost = finder_of_two().verify(
        gnomon::scan{}, places, {.ground = gnomon::plane{Eigen::Vector3d::UnitY(), 0.0}});
    EXPECT_GT(lost.at(0).aligned.covariance(5, 5), 1e5);
    EXPECT_EQ(lost.at(0).aligned.covariance(4, 4), 0.0);
}

TEST(find_objects, refuses_bad_arguments) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    rec::object_finder finder;
    EXPECT_THROW(finder.fit(), std::invalid_argument);
    for (int i = 0; i < 2; ++i) {  // two variants of one name are one class
        const std::size_t variant = finder.add("chair", finder_of_two().surfaces()[0]);
        finder.learn({.parts = {}, .ground = gnomon::plane{}, .rest = {}}, {}, variant);
    }
    EXPECT_THROW(finder.fit(), std::invalid_argument);
    finder = finder_of_two();
    finder.learn({.parts = {}, .ground = gnomon::plane{}, .rest = {}}, {},
                 0);  // not fitted any more
    EXPECT_THROW(static_cast<void>(finder(small_room().scan)), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(finder(gnomon::scan{})), std::invalid_argument);
    gnomon::rigid_motion skewed;
    skewed.rotation(0, 1) = 0.5;
    EXPECT_THROW(finder.learn({.parts = {}, .ground = gnomon::plane{}, .rest = {}}, skewed, 0),
                 std::invalid_argument);
    finder = rec::object_finder();
    EXPECT_THROW(finder.add("nothing", {}), std::invalid_argument);
    const auto samples = sim::sample_surface(chair_and_table()[0], {.spacing = 0.02});
    const auto moved = [&](double lower, double spacing) {
        return rec::surface_model(
            samples, samples, spacing, std::nullopt, [&](const sim::surface_sample& s) {
                return Eigen::Vector3d(s.position - Eigen::Vector3d(0, 0, lower));
            });
    };
    EXPECT_THROW(finder.add("chair", moved(0.4, 0.02)), std::invalid_argument);  // in its middle
    EXPECT_THROW(finder.add("chair", moved(0.0, 20.0)), std::invalid_argument);  // in millimetres
    EXPECT_THROW(finder.add("", finder_of_two().surfaces()[0]), std::invalid_argument);
    EXPECT_THROW(finder.add(std::string(rec::background_name), finder_of_two().surfaces()[0]),
                 std::invalid_argument);
    const rec::view empty{.parts = {}, .ground = gnomon::plane{}, .rest = {}};
    EXPECT_THROW(finder.learn(empty, {}, 0), std::invalid_argument);
    EXPECT_THROW(finder.learn(empty, 0), std::invalid_argument);
    for (const double p : {-0.1, 1.1, nan})
        EXPECT_THROW(static_cast<void>(finder_of_two()(gnomon::scan{}, {.min_probability = p})),
                     std::invalid_argument);
    for (const Eigen::Vector3d& up : {Eigen::Vector3d(0, 0, 2), Eigen::Vector3d(0, nan, 1)}) {
        EXPECT_THROW(static_cast<void>(finder_of_two()(gnomon::scan{}, {.up = up})),
                     std::invalid_argument);
        EXPECT_THROW(
            static_cast<void>(finder_of_two()(gnomon::scan{}, {.ground = gnomon::plane{up, 0.0}})),
            std::invalid_argument);
    }
    for (const double width : {-0.1, 91.0, nan})
        EXPECT_THROW(
            static_cast<void>(finder_of_two()(gnomon::scan{}, {.divergence = degrees(width)})),
            std::invalid_argument);
}

}  // namespace
