// SPDX-License-Identifier: BSL-1.0
/// @file
/// Finds objects in a scan of a whole room, with their places, although they touch others or are
/// half hidden. Instead of first grouping points to views, parts vote for objects and places, and
/// the surface of each object is compared with a grid of places. Each such hypothesis is aligned
/// with the points and verified by what the sensor saw, and hypotheses compete for the points that
/// they explain.
///
///     namespace rec = gnomon::recognition;
///     rec::object_finder finder;
///     const std::size_t chair = finder.add("chair", surface_model_of_chair);
///     for (const auto& [view, pose] : views_of_chair) finder.learn(view, pose, chair);
///     ...
///     finder.fit(gnomon::threads{});
///     for (const rec::found_object& o : finder(scan, {.noise = noise}).objects)
///         use(finder.names()[o.object], o.aligned.pose, o.probability);
///
/// In no umbrella: include it by name.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/filters/voxel_grid.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/measure_noise.hpp>
#include <gnomon/occlusion/visibility.hpp>
#include <gnomon/perception/detail/object_competition.hpp>
#include <gnomon/perception/detail/object_hypotheses.hpp>
#include <gnomon/perception/detail/scene_evidence.hpp>
#include <gnomon/perception/found_object.hpp>
#include <gnomon/perception/perceive_views.hpp>
#include <gnomon/recognition/learned_views.hpp>
#include <gnomon/recognition/object_recognizer.hpp>
#include <gnomon/recognition/part_votes.hpp>
#include <gnomon/recognition/surface_model.hpp>
#include <gnomon/recognition/view.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::recognition {

/// How objects are found.
struct find_objects_options {
    /// Along the rays; else it is measured, and where it cannot be, that of constant_noise{}.
    std::optional<noise_curve> noise = std::nullopt;
    std::optional<plane> ground = std::nullopt;  ///< as in `perceive_views_options`
    Eigen::Vector3d up{0.0, 0.0, 1.0};           ///< as there
    /// Of objects that are found, at least 0.05; formula: more probable than not.
    double min_probability = 0.5;

    /// @throws std::invalid_argument  unless the probability is from 0 to 1
    void require_valid() const {
        gnomon::detail::require(min_probability >= 0.0 && min_probability <= 1.0,
                                "find_objects: a probability is from 0 to 1");
    }
};

/// What was found in a scan of n points.
struct found_objects {
    std::vector<found_object> objects;  ///< the most probable one first
    segments points;                    ///< of the n points: those that each object explains
    perceived_views seen;               ///< groups of points and their parts, objects or not
};

/// Objects that are known by their surfaces and by views of them, to be found in scans. Objects
/// stand upright on the ground.
class object_finder {
  public:
    /// Without objects.
    /// @throws std::invalid_argument  for options that are not valid
    explicit object_finder(part_votes_options votes = {}) : votes_(votes) {}

    /// Adds an object. Several may have one name: variants of one class. One that is larger than 4
    /// m, or whose origin is not within its bounds, is found by the votes of its parts only.
    /// @return its number
    /// @throws std::invalid_argument  if it has no name, or that of background, or its surface no
    ///                                samples
    std::size_t add(std::string name, surface_model surface) {
        using gnomon::detail::require;
        require(!name.empty(), "object_finder: an object needs a name");
        require(name != background_name, "object_finder: an object has the name of background");
        require(surface.points().size() > 0, "object_finder: the surface has no samples");
        names_.push_back(std::move(name));
        surfaces_.push_back(std::move(surface));
        return names_.size() - 1;
    }

    /// Stores the parts of a view of an object, as perceive_views() sees them.
    /// @param pose  of the object's frame in that of the view
    /// @throws std::invalid_argument  if there is no such object, the pose is no rigid motion, or
    ///                                the view has no ground; nothing is stored then
    void learn(const view& v, const rigid_motion& pose, std::size_t object) {
        gnomon::detail::require(object < names_.size(), "object_finder: there is no such object");
        gnomon::detail::require(is_rigid(pose), "object_finder: the pose is no rigid motion");
        recognizer_.learn(v, names_[object]);  // refuses what the votes would refuse
        votes_.learn(v, pose, object);
        is_fitted_ = false;
    }

    /// Stores a view of something that is not to be found, such as clutter: what is more similar to
    /// it than to an object is less probable.
    /// @throws std::invalid_argument  if the view has no ground
    void learn_background(const view& v) {
        recognizer_.learn(v, background_name);
        is_fitted_ = false;
    }

    /// Fits the recognizer of parts, to be called after all views are learned.
    /// @throws std::invalid_argument  if views of fewer than two objects were learned
    template <execution X = sequential>
    void fit(const X& run = {}) {
        recognizer_.fit(run);
        is_fitted_ = true;
    }

    /// The names of the objects, by their numbers.
    [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
    /// The surfaces of the objects, by their numbers.
    [[nodiscard]] const std::vector<surface_model>& surfaces() const { return surfaces_; }

    /// Finds objects.
    /// @param points  any point range of n points [m]; seen from the origin without view points
    /// @param run     the result does not depend on it
    /// @return none if no ground was found
    /// @throws std::invalid_argument  for options that are not valid, or before fit()
    /// Complexity: O(n log n), and O(log n) for each of 150 samples at each place, at most 12 of an
    /// object by votes and 8 by its surface around each 64 m^2, and of 1,000 where it may stand.
    template <class R, execution X = sequential, class Proj = std::identity>
        requires point_range<R, Proj>
    [[nodiscard]] found_objects operator()(const R& points,
                                           const find_objects_options& options = {},
                                           const X& run = {}, Proj projection = {}) const {
        options.require_valid();
        gnomon::detail::require(is_fitted_ || names_.empty(), "object_finder: fit() it first");
        const auto& team = gnomon::detail::staying(run);
        noise_curve noise = constant_noise{};
        if (options.noise) {
            noise = *options.noise;
        } else if (const auto measured = measure_noise(points, team, projection); measured.curve) {
            noise = *measured.curve;
        }
        found_objects result;
        constexpr std::size_t fewest_cells = 20;  // chosen: a stool at 5 m has 60 points
        result.seen = perceive_views(points,
                                     {.ground = options.ground,
                                      .up = options.up,
                                      .noise = noise,
                                      .min_points = fewest_cells},
                                     team, projection);
        std::vector<point_index> kept;
        for (std::size_t i = 0; i < result.seen.groups.labels().size(); ++i)
            if (result.seen.groups.labels()[i] != unlabeled)
                kept.push_back(static_cast<point_index>(i));
        result.points = segments(std::vector<std::int32_t>(std::ranges::size(points), unlabeled));
        if (kept.empty() || !result.seen.ground || names_.empty()) return result;

        const auto cells = average_voxels(subset_view<R, Proj>(points, kept, projection),
                                          {.edge = perceive_views_options{}.cell}, team);
        const detail::scene_evidence scene(
            cells, visibility(points, {.noise = noise}, team, projection),
            votes_.votes(result.seen.views), noise, *result.seen.ground, team);
        auto hypotheses =
            detail::hypotheses_at(scene.places(surfaces_, team), scene, surfaces_, team);
        team(hypotheses.size(), [&](std::size_t i) {
            const std::size_t object = hypotheses[i].object;
            scene.recognize(hypotheses[i], surfaces_[object], recognizer_, names_[object]);
        });
        std::vector<std::int32_t> of_cell;
        result.objects = detail::winners_of(std::move(hypotheses), scene, surfaces_,
                                            options.min_probability, of_cell, team);
        detail::settle(result.objects, scene, surfaces_, team);
        std::vector<std::int32_t> labels(std::ranges::size(points), unlabeled);
        for (std::size_t i = 0; i < kept.size(); ++i) labels[kept[i]] = of_cell[cells.of_point[i]];
        result.points = segments(std::move(labels));
        return result;
    }

  private:
    part_votes<> votes_;
    object_recognizer<> recognizer_;  // by the names of the objects
    bool is_fitted_ = false;
    std::vector<std::string> names_;
    std::vector<surface_model> surfaces_;
};

}  // namespace gnomon::recognition
