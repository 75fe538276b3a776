// SPDX-License-Identifier: BSL-1.0
/// @file
/// Simulates views of single objects, to train and to test recognition with
/// (Klasing 2010, Sec. 5.6, Fig. 5.3). A model stands alone, without a floor, at a random place and
/// heading in front of a range finder, which scans it from a fixed position. Optionally a thin
/// board between both occludes a share of the model. A view depends on the seed, its number and the
/// options only, so that views can be simulated in any order and in parallel:
///
///     namespace sim = gnomon::simulation;
///     const auto models = sim::furniture_models();
///     const sim::object_view_options training{.seed = 1};
///     const sim::object_view_options test{
///         .beam = {.sigma = 0.015,  // skimmed points by a beam of 10 mrad
///                  .footprint = {.divergence = gnomon::radians(0.010),
///                                .sub_rays = 9,
///                                .rule = sim::echo_rule::averaged}},
///         .occluded_share = 0.5,
///         .seed = 2};
///     for (const auto& view : sim::simulate_object_views(models, 40, training, gnomon::threads{}))
///         learn(view.model, view.truth.scan);
///     const sim::object_view view = sim::simulate_object_view(models[3], 7, test);
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/simulation/beam.hpp>
#include <gnomon/simulation/bounds.hpp>
#include <gnomon/simulation/detail/occluding_board.hpp>
#include <gnomon/simulation/detail/sweep_past.hpp>
#include <gnomon/simulation/furniture.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/scanner.hpp>
#include <gnomon/simulation/scene.hpp>
#include <gnomon/simulation/simulate.hpp>
#include <gnomon/simulation/trajectory.hpp>
#include <gnomon/simulation/true_scan.hpp>

namespace gnomon::simulation {

/// The instrument, the places of the object, and the occlusion of views. The defaults are those of
/// Sec. 5.6: a UTM-30LX on a vertical scan, and a floor of 5 m by 5 m in front of it.
struct object_view_options {
    gnomon::simulation::pose sensor = at(0.0, 0.0, 1.2);  ///< at the middle of the sweep [m]
    gnomon::simulation::scanner scanner = {};             ///< a UTM-30LX restricted to 180 degrees
    double duration = 8.0;                                ///< t_s [s]
    angle sweep = degrees(120);                           ///< of the vertical scan, in all
    gnomon::simulation::beam beam = {.sigma = 0.005};     ///< its seed is replaced for each view
    /// Positions of the object's frame: uniform in these bounds [m], where they are not nearer to
    /// the sensor than `nearest`, seen from above [m].
    bounds places = {{0.5, -2.5, 0.0}, {5.5, 2.5, 0.0}};
    double nearest = 1.2;  ///< least distance of the object's frame from the sensor [m]
    /// The share of the object's points, from 0 to 1, that a board in front of it hides: those on
    /// the left, on the right or at the bottom, with equal probability.
    double occluded_share = 0.0;
    std::uint64_t seed = 1;

    /// @throws std::invalid_argument  unless the sensor's pose is a rigid motion, the bounds are
    ///                                finite and not empty, `nearest` is finite and not negative,
    ///                                and the share is from 0 to 1
    void require_valid() const {
        using gnomon::detail::require;
        require(is_rigid(sensor), "object_view_options: the sensor's pose is no rigid motion");
        require(is_finite(places.low) && is_finite(places.high),
                "object_view_options: the places must be finite");
        for (int a = 0; a < 3; ++a)
            require(places.low[a] <= places.high[a], "object_view_options: there are no places");
        require(nearest >= 0.0 && std::isfinite(nearest),
                "object_view_options: the nearest distance must be finite and not negative");
        require(occluded_share >= 0.0 && occluded_share <= 1.0,
                "object_view_options: the occluded share must be from 0 to 1");
    }
};

/// A simulated view of one object.
struct object_view {
    /// The scan. Object 0 is the model, whose parts and surfaces have the numbers of a scene with
    /// it alone; object 1 is the board, if there is one. A far or thin object may have few points
    /// or none.
    true_scan truth;
    gnomon::simulation::pose pose;  ///< of the object
    std::size_t model = 0;          ///< its number in the list of models

    /// The indices of the points of the model, without those of the board and of no surface. O(n).
    [[nodiscard]] std::vector<point_index> points_of_model() const {
        std::vector<point_index> indices;
        for (std::size_t i = 0; i < truth.objects.size(); ++i)
            if (truth.objects[i] == 0) indices.push_back(static_cast<point_index>(i));
        return indices;
    }
};

namespace detail {

/// A random pose on the floor.
/// @throws std::invalid_argument  if (almost) all places are too near to the sensor
[[nodiscard]] inline pose place_of_object(const object_view_options& options,
                                          random_stream& random) {
    constexpr int trials = 100'000;  // rounding aside, fails if less than 0.01 % are far enough
    const auto& [low, high] = options.places;
    for (int trial = 0; trial < trials; ++trial) {
        const double x = random.uniform(low.x(), high.x());
        const double y = random.uniform(low.y(), high.y());
        const double z = random.uniform(low.z(), high.z());
        const Eigen::Vector3d& sensor = options.sensor.position;
        if (std::hypot(x - sensor.x(), y - sensor.y()) < options.nearest) continue;
        return at(x, y, z) * yaw(degrees(random.uniform(-180.0, 180.0)));
    }
    GNOMON_THROW(
        std::invalid_argument("object_view_options: all places are too near to the sensor"));
}

}  // namespace detail

/// Simulates view `number` of a model. Views of the same number have the same pose and the same
/// occluded side for all beams, shares and scanners.
///
/// Complexity: that of simulate(); if a share is occluded, that of a second scan by beams without
/// width.
/// @throws std::invalid_argument  if the options are not valid, or simulate() refuses scanner, beam
///                                or duration
[[nodiscard]] inline object_view simulate_object_view(const furniture_model& model,
                                                      std::uint64_t number,
                                                      const object_view_options& options = {}) {
    options.require_valid();
    random_stream random(options.seed, number);
    object_view result;
    result.pose = detail::place_of_object(options, random);
    const auto side = static_cast<detail::occluded_side>(random.below(3));
    beam b = options.beam;
    b.seed = random.bits();

    scene world;
    add(world, model, result.pose);
    const vertical scan{
        .mount = options.sensor, .duration = options.duration, .sweep = options.sweep};
    if (options.occluded_share > 0.0) {
        const auto past = detail::sweep_past(world.extent(), scan, options.scanner, {});
        const true_scan unoccluded = simulate(world, past, options.scanner);
        detail::add_board(world, options.sensor.position, unoccluded.scan.points, side,
                          options.occluded_share);
    }
    const auto past = detail::sweep_past(world.extent(), scan, options.scanner, b);
    result.truth = simulate(world, past, options.scanner, b);
    return result;
}

/// Simulates the views 0 to `views_per_model` - 1 of each model: view v of model m is
/// simulate_object_view(models[m], 2^32 m + v, options), so that neither more views nor further
/// models change those that are there. Other seeds give other views.
///
/// The same seed gives the same bytes for every execution. Memory: about 100 bytes per point.
/// @return the views of model 0, then those of model 1, ...
/// @throws std::invalid_argument  as simulate_object_view() does
template <execution X = sequential>
[[nodiscard]] std::vector<object_view> simulate_object_views(
    std::span<const furniture_model> models, std::size_t views_per_model,
    const object_view_options& options = {}, const X& run = {}) {
    options.require_valid();
    std::vector<object_view> views(models.size() * views_per_model);
    run(views.size(), [&](std::size_t i) {
        const std::size_t m = i / views_per_model;
        const std::uint64_t number = (std::uint64_t{m} << 32) + i % views_per_model;
        views[i] = simulate_object_view(models[m], number, options);
        views[i].model = m;
    });
    return views;
}

}  // namespace gnomon::simulation
