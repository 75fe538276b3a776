// SPDX-License-Identifier: BSL-1.0
/// @file
/// The side of an edge on which a point is. Near the edge both planes are closer to each other than
/// the noise, so that the distances of the point from them do not determine it. But noise moves the
/// point along its ray only, and a ray ends on the first plane that it meets if they form a corner,
/// and on the second one if they form a ridge.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/segmentation/detail/plane_comparison.hpp>
#include <gnomon/segmentation/detail/region_pairs.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// The plane through the line in which the planes of two regions meet that halves the larger of
/// their angles, which is that between the regions if these turn by less than 90 degrees.
/// @return the plane, the first region on its negative side; nothing if their centroids are on the
///         same side
[[nodiscard]] std::optional<plane> middle_of(const auto& a, const auto& b) {
    const Eigen::Vector3d& n = a.fit.plane.normal;
    const Eigen::Vector3d& m = b.fit.plane.normal;
    const double turn = dot(n, m) < 0.0 ? -1.0 : 1.0;
    const Eigen::Vector3d between = combined(1.0, n, -turn, m);
    double scale = 1.0 / length(between);
    if (scale * dot(between, difference(b.fit.centroid, a.fit.centroid)) < 0.0) scale = -scale;
    const plane middle{scaled(scale, between),
                       scale * (a.fit.plane.offset - turn * b.fit.plane.offset)};
    if (!(middle.signed_distance(a.fit.centroid) < 0.0 &&
          middle.signed_distance(b.fit.centroid) > 0.0))
        return std::nullopt;
    return middle;
}

/// A tenth of a region may be on the wrong side of its edge.
inline constexpr std::size_t part_on_wrong_side = 10;  // numerical

/// The edge between two regions. (A template, so that only its users compile it.)
template <class Plane = plane>
class region_edge {
  public:
    /// @param viewpoint  of a point of either region, from the origin of the cloud [m]
    region_edge(const region_pair& pair, const auto& a, const auto& b,
                const Eigen::Vector3d& viewpoint)
        : regions(pair), first_(a.fit.plane), second_(b.fit.plane) {
        const bool is_before_a = is_before(first_, b.fit.centroid, viewpoint);
        is_seen = is_before_a == is_before(second_, a.fit.centroid, viewpoint);
        is_corner_ = is_before_a;
    }

    region_pair regions;
    bool is_seen;  ///< both sides of it, from the view point: else one of them occludes the other

    /// -1 if a ray ends on the first plane, 1 if on the second one, 0 if it does not meet both.
    /// @param at   the point, from the origin of the cloud [m]
    /// @param ray  from its view point to it [m]
    [[nodiscard]] int side_of(const Eigen::Vector3d& at, const Eigen::Vector3d& ray) const {
        // Where it meets them: beyond the point, in lengths of the ray.
        const double to_first = -first_.signed_distance(at) / dot(first_.normal, ray);
        const double to_second = -second_.signed_distance(at) / dot(second_.normal, ray);
        if (!(to_first > -1.0) || !(to_second > -1.0) || to_first == to_second) return 0;
        return (to_second < to_first) == is_corner_ ? 1 : -1;
    }

  private:
    /// Whether a place is on that side of a plane on which the view point is.
    [[nodiscard]] static bool is_before(const Plane& p, const Eigen::Vector3d& place,
                                        const Eigen::Vector3d& viewpoint) {
        return p.signed_distance(place) * p.signed_distance(viewpoint) > 0.0;
    }

    Plane first_, second_;
    bool is_corner_;
};

/// The edges between regions next to each other. (A template, so that only its users compile it.)
template <class Edge = region_edge<>>
class region_edges {
  public:
    region_edges() = default;

    /// @param cloud     a planar_cloud, whose view points are known
    /// @param labels    numbers of the regions
    /// @param touching  pairs of regions next to each other, sorted
    region_edges(const auto& cloud, const auto& regions, const auto& labels,
                 const scratch<region_pair>& touching) {
        const label_groups members(labels);
        for (const region_pair& pair : touching) {
            const auto &a = regions[pair.first], &b = regions[pair.second];
            if (!are_at_crease(a, b)) continue;
            const point_index any = members[pair.first].front();
            const Edge edge(pair, a, b, difference(cloud.offsets[any], cloud.ray(any)));
            if (!edge.is_seen) continue;
            if (are_turned(a, b, widest_crease) || separates(edge, cloud, members))
                edges_.push_back(edge);
        }
    }

    /// Whether a point of one of two regions is, by its ray, of the other.
    [[nodiscard]] bool is_across(std::int32_t own, std::int32_t other, const Eigen::Vector3d& at,
                                 const Eigen::Vector3d& ray) const {
        const region_pair pair =
            std::minmax(static_cast<point_index>(own), static_cast<point_index>(other));
        const auto found = std::ranges::lower_bound(edges_, pair, {}, &Edge::regions);
        if (found == edges_.end() || found->regions != pair) return false;
        return found->side_of(at, ray) == (own < other ? 1 : -1);
    }

  private:
    /// Whether a shallow edge is where the labels say: at most a tenth of the points of the smaller
    /// region are on the wrong side. Two planes with a step between them meet elsewhere.
    [[nodiscard]] static bool separates(const Edge& edge, const auto& cloud,
                                        const label_groups& members) {
        const auto &first = members[edge.regions.first], &second = members[edge.regions.second];
        const auto wrong = [&](const auto& points, int side) {
            return std::ranges::count_if(points, [&](point_index i) {
                return edge.side_of(cloud.offsets[i], cloud.ray(i)) == side;
            });
        };
        return part_on_wrong_side * static_cast<std::size_t>(wrong(first, 1) + wrong(second, -1)) <=
               std::min(first.size(), second.size());
    }

    scratch<Edge> edges_;
};

}  // namespace gnomon::detail
