// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/filters/voxel_grid.hpp>
#include <gnomon/occlusion/visibility.hpp>
#include <gnomon/perception/detail/alignment_effort.hpp>
#include <gnomon/perception/detail/object_competition.hpp>
#include <gnomon/perception/detail/object_hypotheses.hpp>
#include <gnomon/perception/detail/object_probability.hpp>
#include <gnomon/perception/detail/pose_search.hpp>
#include <gnomon/perception/detail/scene_evidence.hpp>
#include <gnomon/perception/found_object.hpp>
#include <gnomon/recognition/cast_votes.hpp>
#include <gnomon/recognition/surface_model.hpp>
#include <gnomon/recognition/wall.hpp>
#include <gnomon/segmentation/segments.hpp>
#include <gnomon/simulation.hpp>
#include <gnomon/simulation/sample_surface.hpp>

namespace rec = gnomon::recognition;
namespace sim = gnomon::simulation;

namespace {

using gnomon::degrees;
using gnomon::rigid_motion;

const gnomon::noise_curve scene_noise = gnomon::constant_noise{0.005};
const rigid_motion where_chair_is = rigid_motion::on_ground(2.0, 0.3, degrees(160));

constexpr gnomon::angle narrow = degrees(0.0);
const gnomon::angle wide = gnomon::radians(0.010);

/// A chair on a floor, which votes know nothing of, seen by beams of some width.
class chair_in_scene {
  public:
    /// @param assumed   width of the beams in the scene
    /// @param neighbor  the place of a second chair, if there is one
    explicit chair_in_scene(gnomon::angle divergence = narrow, gnomon::angle assumed = narrow,
                            const std::optional<rigid_motion>& neighbor = std::nullopt) {
        sim::beam beam{.sigma = 0.005, .seed = 5};
        if (divergence > narrow)
            beam.footprint = {
                .divergence = divergence, .sub_rays = 9, .rule = sim::echo_rule::averaged};
        const sim::furniture_model chair = sim::furniture_models()[1];
        const auto samples = sim::sample_surface(chair, {.spacing = 0.02});
        surfaces_.emplace_back(samples, samples, 0.02, std::nullopt,
                               &sim::surface_sample::position);
        sim::scene world;
        world.add_object("floor", sim::plane_patch{.length = 5.0, .width = 5.0},
                         sim::at(2.0, 0.0, 0.0));
        (void)sim::add(world, chair, where_chair_is);
        if (neighbor) (void)sim::add(world, chair, *neighbor);
        const gnomon::scan scan =
            sim::simulate(world, sim::vertical{.mount = sim::at(0.0, 0.0, 1.2), .duration = 4.0},
                          sim::scanner{}, beam)
                .scan;
        std::vector<gnomon::point_index> above;
        for (std::size_t i = 0; i < scan.size(); ++i)
            if (scan.points[i].z() > 0.05) above.push_back(static_cast<gnomon::point_index>(i));
        cells_ = gnomon::average_voxels(gnomon::subset_view(scan, above), {.edge = 0.01});
        points_ = scan.points;
        groups_.assign(scan.size(), -1);
        for (const gnomon::point_index i : above) groups_[i] = 0;
        scene_.emplace(cells_, gnomon::visibility(scan, {.noise = scene_noise}),
                       rec::detail::imaged_points{
                           groups_, [this](gnomon::point_index i) { return points_[i]; }},
                       rec::cast_votes({}, 1), scene_noise, gnomon::plane{},
                       std::vector<rec::wall>(), assumed, gnomon::sequential{});
    }

    [[nodiscard]] const rec::detail::scene_evidence& scene() const { return *scene_; }
    [[nodiscard]] const std::vector<rec::surface_model>& surfaces() const { return surfaces_; }

    /// The hypotheses at some places.
    /// @param least  the probability from which on rough alignments are improved
    [[nodiscard]] std::vector<rec::found_object> hypotheses_at(
        const std::vector<rec::object_place>& places, const auto& run,
        double least = rec::detail::scene_evidence::worth) const {
        return rec::detail::hypotheses_at(places, scene(), surfaces(), least, run);
    }

    chair_in_scene(const chair_in_scene&) = delete;  // it refers to itself
    chair_in_scene& operator=(const chair_in_scene&) = delete;

  private:
    std::vector<rec::surface_model> surfaces_;
    gnomon::voxel_grid::means cells_;
    std::vector<std::int32_t> groups_;
    std::vector<Eigen::Vector3d> points_;
    std::optional<rec::detail::scene_evidence> scene_;
};

double distance_off(const rec::found_object& o) {
    return (o.aligned.pose.position - where_chair_is.position).norm();
}

/// Places from which the alignment comes to one pose are one hypothesis, at the pose that fits.
TEST(object_hypotheses, are_one_at_each_pose) {
    const chair_in_scene chair;
    std::vector<rec::object_place> places;
    for (const double x : {-0.03, 0.0, 0.03})
        for (const double y : {-0.03, 0.0, 0.03})
            places.push_back(
                {0, where_chair_is * rigid_motion::on_ground(x, y, degrees(100.0 * x)), 0.0});
    const auto found = chair.hypotheses_at(places, gnomon::threads{2});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_LT(distance_off(found[0]), 0.01);
    EXPECT_GT(found[0].evidence.samples, 500u);  // verified carefully
}

/// A rough alignment from a place that is far off is hardly probable: only with a lower limit is it
/// improved, and then found where the chair is.
TEST(object_hypotheses, are_improved_from_a_least_probability_on) {
    const chair_in_scene chair;
    const std::vector<rec::object_place> place{
        {0, where_chair_is * rigid_motion::on_ground(0.12, -0.16, degrees(0.0)), 0.0}};
    EXPECT_TRUE(chair.hypotheses_at(place, gnomon::sequential{}).empty());
    const auto found = chair.hypotheses_at(place, gnomon::sequential{}, 0.002);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_LT(distance_off(found[0]), 0.01);
}

/// A neighbor that touches an object does not pull it away from where it is, as it does if surfaces
/// correspond that are farther apart.
TEST(object_hypotheses, stay_where_they_are_next_to_a_neighbor) {
    const chair_in_scene chair(narrow, narrow,
                               where_chair_is * rigid_motion::on_ground(0.0, 0.45, degrees(90.0)));
    const auto off = [&](const rec::detail::alignment_effort& much) {
        return distance_off(chair.scene().aligned(0, where_chair_is, chair.surfaces()[0], much));
    };
    EXPECT_LT(off(rec::detail::careful_effort), 0.01);
    auto farther = rec::detail::careful_effort;
    farther.max_distance = rec::detail::rough_effort.max_distance;
    EXPECT_GT(off(farther), 0.03);
}

/// A better pose is looked for with fewer counts, but the answer is that of all of them. Where
/// there are too few cells, nothing fits better.
TEST(object_hypotheses, are_better_as_by_complete_counts) {
    const chair_in_scene chair;
    const auto& scene = chair.scene();
    const auto& model = chair.surfaces()[0];
    const auto rough = rec::detail::rough_effort;
    std::size_t better = 0, others = 0;
    for (const double from : {0.0, 0.05, 0.3, 9.0}) {
        auto than = scene.aligned(
            0, where_chair_is * rigid_motion::on_ground(from, 0.0, degrees(0.0)), model, rough);
        if (from > 1.0) than.evidence.seen_through = 1000;
        for (const double x : {-0.2, -0.08, 0.0, 0.08, 7.0}) {
            const auto start = where_chair_is * rigid_motion::on_ground(x, 0.02, degrees(50.0 * x));
            const auto complete = scene.aligned(0, start, model, rough);
            const auto found = scene.aligned_better(than, start, model, rough);
            const bool is_better = complete.evidence.samples > 0 &&
                                   rec::detail::fits_better(complete.evidence, than.evidence);
            ASSERT_EQ(found.has_value(), is_better);
            ++(is_better ? better : others);
            if (!is_better) continue;
            EXPECT_EQ(found->aligned.pose.position, complete.aligned.pose.position);
            EXPECT_EQ(found->probability, complete.probability);
            EXPECT_EQ(found->evidence.supported, complete.evidence.supported);
            EXPECT_EQ(found->evidence.explained, complete.evidence.explained);
        }
    }
    EXPECT_GT(better, 0u);
    EXPECT_GT(others, 0u);
}

/// Where an object ends along x, improved from the origin, if it fits best at x [m].
/// @param probability  of the object at all poses
double improved_to(double x, double probability) {
    rec::found_object at_origin;
    at_origin.probability = probability;
    const auto off = [x](const rigid_motion& at) {
        return std::abs(at.position.x() - x) + at.position.tail<2>().norm();
    };
    const auto better_from = [&](const rec::found_object& best,
                                 const rigid_motion& start) -> std::optional<rec::found_object> {
        if (off(start) > 0.17 || off(start) >= off(best.aligned.pose)) return std::nullopt;
        rec::found_object next = best;
        next.aligned.pose = start;
        return next;
    };
    return rec::detail::improved(at_origin, better_from).aligned.pose.position.x();
}

/// Tops of tables slide along themselves, by more than one step.
TEST(object_hypotheses, are_improved_from_starts_farther_away) {
    for (const double x : {-0.16, -0.08, 0.08, 0.16, 0.32})
        EXPECT_NEAR(improved_to(x, 0.5), x, 1e-9);
}

/// A hypothesis that is not worth it after one round of improvements gets no further one.
TEST(object_hypotheses, are_given_up_if_the_first_round_does_not_help) {
    EXPECT_NEAR(improved_to(0.32, 0.005), 0.16, 1e-9);
}

/// Objects that came to one pose are one, which has the cells of all of them.
TEST(object_hypotheses, are_united_at_one_pose) {
    const chair_in_scene scene;
    const std::vector<rec::surface_model> surfaces(2, scene.surfaces()[0]);
    const auto at = [](std::size_t object, double x) {
        rec::found_object o;
        o.object = object;
        o.aligned.pose = rigid_motion::on_ground(x, 0.0, degrees(0.0));
        return o;
    };
    std::vector<rec::found_object> objects{at(0, 0.0), at(1, 0.0), at(0, 0.02), at(0, 0.05)};
    std::vector<std::int32_t> of_cell{3, 2, gnomon::unlabeled, 1, 0};
    rec::detail::unite(objects, of_cell, surfaces);
    ASSERT_EQ(objects.size(), 3u);
    EXPECT_EQ(objects[1].object, 1u);
    EXPECT_EQ(objects[2].aligned.pose.position.x(), 0.05);
    EXPECT_EQ(of_cell, (std::vector<std::int32_t>{2, 0, gnomon::unlabeled, 1, 0}));
}

/// Far from all points there is none.
TEST(object_hypotheses, are_none_where_nothing_is) {
    const chair_in_scene chair;
    const std::vector<rec::object_place> places{
        {0, rigid_motion::on_ground(9.0, 9.0, degrees(0.0)), 0.0}};
    EXPECT_TRUE(chair.hypotheses_at(places, gnomon::sequential{}).empty());
}

/// The surface of an object is found in the cells that are left, and in none of those that are not.
TEST(object_hypotheses, are_searched_in_what_is_left) {
    const chair_in_scene chair;
    const auto places_in = [&](bool is_left) {
        return chair.scene().searched_places(
            chair.surfaces(), [&](gnomon::point_index) { return is_left; }, gnomon::sequential{});
    };
    EXPECT_TRUE(places_in(false).empty());
    const auto places = places_in(true);
    EXPECT_LE(places.size(), rec::detail::pose_search::most);
    EXPECT_TRUE(std::ranges::any_of(places, [](const rec::object_place& p) {
        return (p.pose.position - where_chair_is.position).norm() < 0.15;
    }));
}

/// What was compared by its silhouette is more probable the better this agrees, and less the more a
/// surface goes on beyond it or the sensor saw through; without rays, samples decide.
TEST(object_hypotheses, are_probable_by_their_silhouettes) {
    rec::found_object o;
    o.evidence = {.samples = 500, .facing = 300, .supported = 200, .mismatched = 20, .hidden = 80};
    o.evidence.points = o.evidence.near_surface = 300;
    o.evidence.explained = o.evidence.on_surface = 280;
    o.votes = 0.5;
    const double by_samples = rec::detail::probability_of(o);
    o.silhouette = {.rays = 0, .overlap = 0.9, .beyond = 0.0};
    EXPECT_EQ(rec::detail::probability_of(o), by_samples);
    o.silhouette.rays = 800;
    const double good = rec::detail::probability_of(o);
    EXPECT_GT(good, 0.9);
    auto worse = o;
    worse.silhouette.overlap = 0.5;
    EXPECT_LT(rec::detail::probability_of(worse), good);
    worse = o;
    worse.silhouette.beyond = 0.9;
    EXPECT_LT(rec::detail::probability_of(worse), 0.5);
    worse = o;
    worse.evidence.seen_through = 50;
    EXPECT_LT(rec::detail::probability_of(worse), 0.5);
    EXPECT_TRUE(rec::detail::fits_better(o.evidence, worse.evidence));
    worse = o;
    worse.evidence.in_walls = 50;
    EXPECT_LT(rec::detail::probability_of(worse), 0.5);
    EXPECT_TRUE(rec::detail::fits_better(o.evidence, worse.evidence));
    const chair_in_scene chair(wide, wide);
    auto found =
        chair.scene().aligned(0, where_chair_is, chair.surfaces()[0], rec::detail::careful_effort);
    chair.scene().compare_silhouette(found, chair.surfaces()[0]);
    EXPECT_GT(found.silhouette.rays, 100u);
    EXPECT_GT(found.silhouette.overlap, 0.7);
    EXPECT_EQ(found.probability, rec::detail::probability_of(found));
}

/// What is found settles at the true pose, as probable as before, from one 9 cm away at which
/// it was left.
TEST(object_hypotheses, settle_where_they_fit_best) {
    const chair_in_scene chair;
    std::vector<rec::found_object> found(1);
    found[0].aligned.pose = where_chair_is * rigid_motion::on_ground(0.0, 0.09, degrees(0.0));
    found[0].evidence.samples = found[0].evidence.seen_through = 1000;
    found[0].probability = 0.7;
    rec::detail::settle(found, chair.scene(), chair.surfaces(), gnomon::sequential{});
    EXPECT_LT(distance_off(found[0]), 0.01);
    EXPECT_EQ(found[0].probability, 0.7);
    EXPECT_GT(found[0].evidence.supported, 10 * found[0].evidence.seen_through);
    EXPECT_GT(found[0].silhouette.overlap, 0.7);  // that of the pose at which it settled
}

/// Beams that average at edges shift the pose away from the sensor. The points that whole beams hit
/// do not, and their covariance holds.
TEST(object_hypotheses, settle_by_whole_beams) {
    const auto settled_for = [&](gnomon::angle assumed) {
        const chair_in_scene chair(wide, assumed);
        const auto start = where_chair_is * rigid_motion::on_ground(0.01, 0.0, degrees(1.0));
        std::vector<rec::found_object> found{
            chair.scene().aligned(0, start, chair.surfaces()[0], rec::detail::careful_effort)};
        rec::detail::settle(found, chair.scene(), chair.surfaces(), gnomon::sequential{});
        return found[0].aligned;
    };
    const auto error_of = [&](const gnomon::alignment& a) {
        return Eigen::Vector3d(where_chair_is.point_out(a.pose.point_in(a.center)) - a.center);
    };
    const auto by_all = settled_for(narrow), by_whole = settled_for(wide);
    ASSERT_TRUE(by_whole.is_usable());
    EXPECT_LT(by_whole.points, by_all.points);
    const Eigen::Vector3d away =
        Eigen::Vector3d(by_all.center.x(), by_all.center.y(), 0.0).normalized();
    EXPECT_LT(error_of(by_all).dot(away), -0.001);  // the chair is nearer than estimated
    EXPECT_LT(error_of(by_whole).norm(), 0.5 * error_of(by_all).norm());
    for (const int a : {3, 4})
        EXPECT_LT(std::abs(error_of(by_whole)[a - 3]), 4.0 * std::sqrt(by_whole.covariance(a, a)));
}

/// Where no whole beam hits the object, it stays where it is, less certain.
TEST(object_hypotheses, stay_without_whole_beams) {
    const auto settled_for = [&](gnomon::angle assumed) {
        const chair_in_scene chair(narrow, assumed);
        std::vector<rec::found_object> found{chair.scene().aligned(
            0, where_chair_is, chair.surfaces()[0], rec::detail::careful_effort)};
        rec::detail::settle(found, chair.scene(), chair.surfaces(), gnomon::sequential{});
        return found;
    };
    const auto sharp = settled_for(narrow), blurred = settled_for(degrees(45.0));
    EXPECT_EQ(blurred[0].aligned.pose.position, sharp[0].aligned.pose.position);
    EXPECT_LT(distance_off(sharp[0]), 0.01);
    EXPECT_TRUE(sharp[0].aligned.is_usable());
    for (const int a : {3, 4})
        EXPECT_GT(blurred[0].aligned.covariance(a, a), sharp[0].aligned.covariance(a, a) + 0.01);
}

}  // namespace
