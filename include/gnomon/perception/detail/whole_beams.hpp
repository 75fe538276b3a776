// SPDX-License-Identifier: BSL-1.0
/// @file
/// The points of an object that whole beams hit, and how certain these make its pose. A beam at an
/// edge returns the mean range of two faces, or of one and of things behind it: such points shift
/// the pose of an object by millimeters, mostly away from the sensor. So do those that beams at the
/// edge of something in front of the object return, which only the scan shows to be mixed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/begins_from_sizes.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/features/alignment.hpp>
#include <gnomon/filters/remove_mixed_points.hpp>
#include <gnomon/filters/voxel_grid.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/plane_fit.hpp>
#include <gnomon/normals/surfel.hpp>
#include <gnomon/perception/detail/cells_of_object.hpp>
#include <gnomon/perception/detail/ground_motions.hpp>
#include <gnomon/perception/found_object.hpp>
#include <gnomon/recognition/cast_votes.hpp>
#include <gnomon/recognition/detail/points_in_bounds.hpp>
#include <gnomon/recognition/surface_model.hpp>

namespace gnomon::recognition::detail {

/// Whether a point of an object is less than half a beam from an edge, where two of its faces meet,
/// or next to no face at all.
/// @param x       in the frame of the object [m]
/// @param normal  likewise; compatible with all faces if it is missing
/// @param half    of the width of the beam [m]
/// @param nearby  working memory
[[nodiscard]] inline bool is_at_edge(const surface_model& model, const Eigen::Vector3d& x,
                                     const Eigen::Vector3d& normal, double half,
                                     std::vector<neighbor>& nearby) {
    using gnomon::detail::combined, gnomon::detail::difference, gnomon::detail::dot;
    constexpr double turned = 0.7;     // chosen: cosine of 45 degrees
    constexpr double spacings = 2.0;   // chosen: a sample of the other face is as near
    constexpr std::size_t most = 200;  // chosen: more than are so near if spaced by 5 mm
    model.points().nearest_within_into(nearby, x, most, half + spacings * model.spacing());
    const auto normal_of = [&](const neighbor& q) { return model.normals()[q.index].normal; };
    const auto own = std::ranges::find_if(nearby, [&](const neighbor& q) {
        return is_missing(normal) || std::abs(dot(normal_of(q), normal)) >= turned;
    });
    if (own == nearby.end()) return true;
    const Eigen::Vector3d face = normal_of(*own);
    const double off = dot(face, difference(x, model.points()[own->index]));
    const Eigen::Vector3d on_face = combined(1.0, x, -off, face);
    return std::ranges::any_of(nearby, [&](const neighbor& q) {
        const Eigen::Vector3d other = normal_of(q);
        return std::abs(dot(other, face)) < turned &&
               std::abs(dot(other, difference(on_face, model.points()[q.index]))) < half;
    });
}

/// Whether a beam mixed any of the points of a cell: tested each time that it is needed, which is
/// for the few cells near objects that were found or are verified.
class mixed_cells {
  public:
    /// Precondition: each of the chosen points is in a cell.
    /// @param chosen      some points of a scan
    /// @param cells       of these
    /// @param divergence  full angle of the beams
    /// @param noise       along the rays
    template <class R, class Proj>
    mixed_cells(const R& points, std::span<const point_index> chosen,
                const voxel_grid::means& cells, angle divergence, const noise_curve& noise,
                const auto& run, Proj projection)
        : is_mixed_(points, {.divergence = divergence, .noise = noise}, run, projection),
          points_(chosen.size()),
          begins_(cells.size() + 1, 0) {
        for (const point_index c : cells.of_point) ++begins_[c + 1];
        gnomon::detail::begins_from_sizes(begins_);
        std::vector<std::size_t> next = begins_;
        for (std::size_t i = 0; i < chosen.size(); ++i)
            points_[next[cells.of_point[i]]++] = chosen[i];
    }

    [[nodiscard]] bool operator()(point_index cell) const {
        const std::span<const point_index> points(points_);
        return std::ranges::any_of(points.subspan(begins_[cell], begins_[cell + 1] - begins_[cell]),
                                   std::cref(is_mixed_));
    }

  private:
    gnomon::detail::mixed_point_test is_mixed_;
    std::vector<point_index> points_;  // cell by cell
    std::vector<std::size_t> begins_;  // of the points of each cell
};

/// Points of an object, and the beams that hit them.
struct whole_beams {
    std::vector<point_index> points;  ///< those at no edge
    double widest = 0.0;              ///< of all beams at the object, those at edges among them [m]
    Eigen::Vector3d way{0.0, 0.0, 0.0};  ///< the sum of these beams, from the sensor [m]
};

/// The points of an object that whole beams hit.
/// @param cloud       of index and normals, seen from the origin without view points
/// @param normals     of its points, a `normal_range`
/// @param pose        of the object
/// @param mixed       which of its points beams mixed; null if that is unknown
/// @param divergence  full angle of the beams
/// @param margin      around the object [m]
[[nodiscard]] whole_beams whole_beams_at(const voxel_grid::means& cloud, const spatial_index& index,
                                         const auto& normals, const mixed_cells* mixed,
                                         const surface_model& model, const rigid_motion& pose,
                                         angle divergence, double margin) {
    whole_beams found;
    std::vector<neighbor> nearby;
    const Eigen::Vector3d around = Eigen::Vector3d::Constant(margin);
    for_each_point_in(index, pose, model.low() - around, model.high() + around,
                      [&](point_index i, const Eigen::Vector3d& x) {
                          const Eigen::Vector3d way =
                              gnomon::detail::difference(cloud.points[i], cloud.viewpoints[i]);
                          const double width = divergence.radians() * gnomon::detail::length(way);
                          found.way = gnomon::detail::combined(1.0, found.way, 1.0, way);
                          found.widest = std::max(found.widest, width);
                          if (mixed != nullptr && (*mixed)(i)) return;
                          const Eigen::Vector3d normal = pose.direction_in(normals[i].normal);
                          if (!is_at_edge(model, x, normal, 0.5 * width, nearby))
                              found.points.push_back(i);
                      });
    return found;
}

/// Adds to the covariance of an object on the ground what does not become less with more points: an
/// unknown shift, such as that of its edges, which moves it along the ground, and turns it about
/// the vertical by the shift over half of its mean side.
/// @param found  its pose, in the frame of the scan
/// @param up     the normal of the ground
/// @param shift  standard deviation [m]
inline void add_shift_on_ground(alignment& found, const surface_model& model,
                                const Eigen::Vector3d& up, double shift) {
    const double turn = shift / half_of_mean_side(model);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const double upright = up[i] * up[j];
            found.covariance(i, j) += turn * turn * upright;
            found.covariance(3 + i, 3 + j) += shift * shift * ((i == j ? 1.0 : 0.0) - upright);
        }
    }
}

/// An object at a place of which the scan shows nothing: it may be anywhere on the ground.
[[nodiscard]] inline found_object unaligned(const object_place& place, const surface_model& model,
                                            const Eigen::Vector3d& up) {
    found_object h;
    h.object = place.object;
    h.aligned.pose = place.pose;
    add_shift_on_ground(h.aligned, model, up, alignment::unknown_deviation);
    return h;
}

/// Cells of a scan, seen by beams of some width.
struct beam_scene {
    const voxel_grid::means& cells;
    const spatial_index& index;                     ///< of these
    const std::vector<surfel<plane_fit>>& surface;  ///< their normals
    const mixed_cells* mixed;                       ///< null if beams are narrow
    const noise_curve& noise;                       ///< along the rays
    Eigen::Vector3d up;                             ///< the normal of the ground
    angle divergence;                               ///< full angle of the beams
    std::size_t most;                               ///< cells that are aligned
};

/// The alignment of an object that was found, by the cells that whole beams hit. Where these
/// determine less of the pose, or would move it by more than edges do, it stays, less certain.
/// @return the alignment that was found, for narrow beams
[[nodiscard]] inline alignment aligned_by_whole_beams(const alignment& found,
                                                      const surface_model& model,
                                                      const beam_scene& scene) {
    using gnomon::detail::difference, gnomon::detail::direction_of, gnomon::detail::dot;
    if (scene.divergence == degrees(0.0)) return found;
    // Shifts in widths of a beam: along the rays edges cause at most half of one; across them
    // more than a little is another slat or leg.
    constexpr double along = 0.5;     // formula: half of a beam
    constexpr double across = 0.2;    // chosen on rooms of seeds 1 to 20, of .2 to .5
    constexpr double unseen = 0.035;  // chosen on rooms of seeds 101 to 220, of .02 to .08
    constexpr int rounds = 2;         // chosen: the cells change with the pose
    const alignment_options how{
        .noise = scene.noise, .on_ground = true, .max_distance = alignment_options{}.last_distance};
    alignment settled = found;
    double share = unseen, widest = 0.0;
    for (int round = 0; round < rounds; ++round) {
        const auto whole = whole_beams_at(scene.cells, scene.index, scene.surface, scene.mixed,
                                          model, settled.pose, scene.divergence, how.max_distance);
        widest = whole.widest;
        const auto next = alignment_of_cells(scene.cells, scene.surface, whole.points, scene.most,
                                             model.all(), settled.pose, how);
        const Eigen::Vector3d moved =
            difference(next.pose.point_out(found.pose.point_in(found.center)), found.center);
        const double ahead = dot(direction_of(whole.way), moved);
        const double aside = std::sqrt(std::max(0.0, dot(moved, moved) - ahead * ahead));
        const bool is_known = next.determined >= found.determined &&
                              next.status != alignment::outcome::too_few_points &&
                              next.status != alignment::outcome::not_converged;
        if (!is_known || !(std::abs(ahead) < along * whole.widest) ||
            !(aside < across * whole.widest)) {
            settled = found;
            share = across;
            break;
        }
        settled = next;
    }
    add_shift_on_ground(settled, model, scene.up, share * widest);
    return settled;
}

}  // namespace gnomon::recognition::detail
