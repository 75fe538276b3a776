// SPDX-License-Identifier: BSL-1.0
/// @file
/// A scene of one chair, for tests of hypotheses and of the evidence for them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/filters/voxel_grid.hpp>
#include <gnomon/occlusion/visibility.hpp>
#include <gnomon/perception/detail/object_hypotheses.hpp>
#include <gnomon/perception/detail/scene_evidence.hpp>
#include <gnomon/perception/found_object.hpp>
#include <gnomon/recognition/cast_votes.hpp>
#include <gnomon/recognition/surface_model.hpp>
#include <gnomon/recognition/wall.hpp>
#include <gnomon/simulation.hpp>
#include <gnomon/simulation/sample_surface.hpp>

namespace one_chair {

namespace rec = gnomon::recognition;
namespace sim = gnomon::simulation;
using gnomon::degrees;
using gnomon::rigid_motion;

inline const gnomon::noise_curve scene_noise = gnomon::constant_noise{0.005};
inline const rigid_motion where_chair_is = rigid_motion::on_ground(2.0, 0.3, degrees(160));

/// Widths of beams.
inline constexpr gnomon::angle narrow = degrees(0.0);
inline const gnomon::angle wide = gnomon::radians(0.010);

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

/// The distance of an object from the place of the chair [m].
[[nodiscard]] inline double distance_off(const rec::found_object& o) {
    return (o.aligned.pose.position - where_chair_is.position).norm();
}

}  // namespace one_chair
