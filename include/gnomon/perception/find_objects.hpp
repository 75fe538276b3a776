// SPDX-License-Identifier: BSL-1.0
/// @file
/// Finds objects in a scan of a whole room, with their places, although they touch others or are
/// half hidden. Parts of groups of points, as in perceive_views(), vote for objects and places, and
/// in the points that the objects found by votes leave, the surface of each object is compared with
/// a grid of places. Each such hypothesis is aligned with the points and verified by what the
/// sensor saw, by samples of its surface and by its silhouette, and hypotheses compete for points.
///
///     namespace rec = gnomon::recognition;
///     rec::object_finder finder;
///     const std::size_t chair = finder.add("chair", surface_model_of_chair);
///     for (const auto& [view, pose] : views_of_chair) finder.learn(view, pose, chair);
///     finder.fit(gnomon::threads{});
///     for (const rec::found_object& o : finder(scan, {.noise = noise}).objects)
///         use(finder.names()[o.object], o.aligned.pose, o.probability);
///
/// Hypotheses from elsewhere are aligned and verified: `finder.verify(scan, places)`. In no
/// umbrella: include it by name. It needs Boost.Hana.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/filters/voxel_grid.hpp>
#include <gnomon/occlusion/visibility.hpp>
#include <gnomon/perception/detail/known_objects.hpp>
#include <gnomon/perception/detail/object_competition.hpp>
#include <gnomon/perception/detail/object_hypotheses.hpp>
#include <gnomon/perception/detail/scene_evidence.hpp>
#include <gnomon/perception/found_object.hpp>
#include <gnomon/perception/perceive_views.hpp>
#include <gnomon/recognition/cast_votes.hpp>
#include <gnomon/recognition/learned_views.hpp>
#include <gnomon/recognition/object_recognizer.hpp>
#include <gnomon/recognition/part_votes.hpp>
#include <gnomon/recognition/surface_model.hpp>
#include <gnomon/recognition/view.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::recognition {

/// Objects that are known by their surfaces and by views of them, to be found in scans. Objects
/// stand upright on the ground.
class object_finder {
  public:
    /// Without objects.
    /// @throws std::invalid_argument  for options that are not valid
    explicit object_finder(part_votes_options votes = {}) : votes_(votes) {}

    /// Adds an object. Several may have one name: variants of one class. One that is larger than 4
    /// m, or whose origin is not within its bounds, is found by the votes of its parts only; one of
    /// which no view is learned, by its surface only.
    /// @param surface  with samples that are at most 3 cm apart
    /// @return its number
    /// @throws std::invalid_argument  if it has no name, or that of background, or if its surface
    ///                                has no samples, or some that are farther apart or more than
    ///                                10 cm below the ground
    std::size_t add(std::string name, surface_model surface) {
        return objects_.add(std::move(name), std::move(surface));
    }

    /// Stores the parts of a view of an object, as perceive_views() sees them.
    /// @param pose  of the object's frame in that of the view
    /// @throws std::invalid_argument  if there is no such object, the pose is no rigid motion, the
    ///                                view has no ground of unit normal, or a part is not finite;
    ///                                nothing is stored then
    void learn(const view& v, const rigid_motion& pose, std::size_t object) {
        gnomon::detail::require(is_rigid(pose), "object_finder: the pose is no rigid motion");
        part_votes<>().learn(v, pose, object);  // refuses before anything is stored
        learn(v, object);
        votes_.learn(v, pose, object);
    }

    /// Stores a view of an object without its pose: its parts distinguish the object from others,
    /// and do not vote. Views that vote cost time in operator(), these hardly any.
    /// @throws std::invalid_argument  as above
    void learn(const view& v, std::size_t object) {
        gnomon::detail::require(object < objects_.names.size(),
                                "object_finder: there is no such object");
        part_votes<>().learn(v, {}, object);  // likewise
        recognizer_.learn(v, objects_.names[object]);
        is_fitted_ = false;
    }

    /// Stores a view of something that is not to be found, such as clutter: what is more similar to
    /// it than to an object is less probable.
    /// @throws std::invalid_argument  if the view has no ground
    void learn_background(const view& v) {
        recognizer_.learn(v, background_name);
        is_fitted_ = false;
    }

    /// Fits the recognizer of parts, after all views are learned.
    /// @param run  the result does not depend on it
    /// @throws std::invalid_argument  if views of one name or none (background is one) were learned
    /// Complexity: that of object_recognizer::fit().
    template <execution X = sequential>
    void fit(const X& run = {}) {
        gnomon::detail::require(recognizer_.classes() > 1,
                                "object_finder: learn views of two names, or of background, first");
        recognizer_.fit(run);
        is_fitted_ = true;
    }

    /// The names of the objects, by their numbers.
    [[nodiscard]] const std::vector<std::string>& names() const { return objects_.names; }
    /// Their surfaces, likewise.
    [[nodiscard]] const std::vector<surface_model>& surfaces() const { return objects_.surfaces; }

    /// Finds objects.
    /// @param points  any point range of n points [m]; seen from the origin without view points
    /// @param run     the result does not depend on it
    /// @return none if no ground was found
    /// @throws std::invalid_argument  for options that are not valid, or before fit()
    /// Complexity: O(n log n), and alignments of 64 cells with O(log n) for each of 150 samples
    /// and each view point, at the places of most votes of each object and 20 by its surface in 64
    /// m^2; and a drawing of the silhouette of each of these that is worth it.
    template <class R, execution X = sequential, class Proj = std::identity>
        requires point_range<R, Proj>
    [[nodiscard]] found_objects operator()(const R& points,
                                           const find_objects_options& options = {},
                                           const X& run = {}, Proj projection = {}) const {
        found_objects result;
        const auto& team = gnomon::detail::staying(run);
        result.points = segments(std::vector<std::int32_t>(std::ranges::size(points), unlabeled));
        result.seen = in_scene(points, options, team, projection, [&](const scene_of& at) {
            std::vector<std::int32_t> of_cell;
            result.objects = detail::objects_in(
                at.scene, objects_.surfaces, options.min_probability,
                [&](found_object& h) { recognize(at.scene, h); }, of_cell, team);
            detail::settle(result.objects, at.scene, objects_.surfaces, team);
            detail::unite(result.objects, of_cell, objects_.surfaces);
            std::vector<std::int32_t> labels(std::ranges::size(points), unlabeled);
            for (std::size_t i = 0; i < at.points.size(); ++i)
                labels[at.points[i]] = of_cell[at.cells.of_point[i]];
            result.points = segments(std::move(labels));
        });
        return result;
    }

    /// Verifies hypotheses of others, such as a detector in images: each is aligned with the scan
    /// from its place, and is as probable as what the scan shows of it. They do not compete.
    /// @param points   as above
    /// @param places   m objects, each at most 10 cm and 15 degrees of heading from where it is on
    ///                 the ground; heights and tilts are not corrected, and votes not read
    /// @param options  as above; the least probability is not used
    /// @return m hypotheses in the order of the places, of probability 0 with too few points or
    ///         without ground. Poses of hypotheses of less than 0.01 are not refined
    /// @throws std::invalid_argument  as above; if there is no such object, or a pose is not rigid
    /// Complexity: O(n log n), and for each place some alignments as above.
    template <class R, execution X = sequential, class Proj = std::identity>
        requires point_range<R, Proj>
    [[nodiscard]] std::vector<found_object> verify(const R& points,
                                                   std::span<const object_place> places,
                                                   const find_objects_options& options = {},
                                                   const X& run = {}, Proj projection = {}) const {
        using gnomon::detail::require;
        std::vector<found_object> result(places.size());
        for (std::size_t i = 0; i < places.size(); ++i) {
            require(places[i].object < objects_.names.size(),
                    "object_finder: there is no such object");
            require(is_rigid(places[i].pose), "object_finder: the pose is no rigid motion");
            result[i] = detail::unaligned(places[i], objects_.surfaces[places[i].object],
                                          options.ground ? options.ground->normal : options.up);
        }
        const auto& team = gnomon::detail::staying(run);
        (void)in_scene(points, options, team, projection, [&](const scene_of& at) {
            team(places.size(), [&](std::size_t i) {
                found_object& h = result[i];
                h = detail::aligned_at(at.scene, places[i], objects_.surfaces);
                recognize(at.scene, h);
                if (h.probability >= detail::scene_evidence::worth)
                    h.aligned = at.scene.refined(h.aligned, objects_.surfaces[h.object]);
            });
        });
        return result;
    }

  private:
    /// What a scan shows of objects.
    struct scene_of {
        const std::vector<point_index>& points;  ///< those in groups, so not of the ground or walls
        const voxel_grid::means& cells;          ///< of these
        const detail::scene_evidence& scene;
    };

    /// Perceives a scan, and calls f(scene_of) unless it has no ground or no groups, or no objects
    /// are known.
    template <class R, class Proj>
    [[nodiscard]] perceived_views in_scene(const R& points, const find_objects_options& options,
                                           const auto& team, Proj projection, const auto& f) const {
        options.require_valid();
        gnomon::detail::require(is_fitted_ || objects_.names.empty(),
                                "object_finder: fit() it first");
        const noise_curve noise = detail::noise_of(points, options.noise, team, projection);
        perceived_views seen = perceive_views(points,
                                              {.ground = options.ground,
                                               .up = options.up,
                                               .noise = noise,
                                               .min_points = detail::scene_evidence::fewest},
                                              team, projection);
        std::vector<point_index> kept;
        for (std::size_t i = 0; i < seen.groups.labels().size(); ++i)
            if (seen.groups.labels()[i] != unlabeled) kept.push_back(static_cast<point_index>(i));
        if (kept.empty() || !seen.ground || objects_.names.empty()) return seen;
        auto cells = average_voxels(subset_view<R, Proj>(points, kept, projection),
                                    {.edge = perceive_views_options{}.cell}, team);
        if (cells.viewpoints.empty()) cells.viewpoints = Eigen::Vector3d(0.0, 0.0, 0.0);
        std::optional<detail::mixed_cells> mixed;
        if (options.divergence > degrees(0.0))
            mixed.emplace(points, kept, cells, options.divergence, noise, team, projection);
        const position_view<R, Proj> position(points, projection);
        const detail::scene_evidence scene(
            cells, visibility(points, {.noise = noise}, team, projection),
            {seen.groups.labels(), [&](point_index i) { return position[i]; }},
            votes_.votes(seen.views, team), noise, *seen.ground, seen.walls, options.divergence,
            team, mixed ? &*mixed : nullptr);
        f(scene_of{kept, cells, scene});
        return seen;
    }

    void recognize(const detail::scene_evidence& scene, found_object& h) const {
        scene.recognize(h, objects_.surfaces[h.object], recognizer_, objects_.names[h.object]);
    }

    part_votes<> votes_;
    object_recognizer<> recognizer_;  // by the names of the objects
    bool is_fitted_ = false;
    detail::known_objects objects_;
};

}  // namespace gnomon::recognition
