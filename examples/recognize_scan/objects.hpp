// SPDX-License-Identifier: BSL-1.0
/// @file
/// The objects in a scan: its views, what each shows, and its box.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core.hpp>
#include <gnomon/features/convex_polygon.hpp>
#include <gnomon/features/minimum_area_rectangle.hpp>
#include <gnomon/filters/subset.hpp>
#include <gnomon/perception/perceive_views.hpp>
#include <gnomon/recognition/object_recognizer.hpp>
#include <gnomon/recognition/posterior.hpp>

/// A view and what it shows.
struct object {
    std::string name;  ///< of its class; "background" if nothing was decided
    gnomon::recognition::decision decision;
    std::size_t points = 0;
    gnomon::oriented_box box;  ///< upright: its third axis is up, the first along its longer edge

    [[nodiscard]] bool is_recognized() const { return !decision.is_background(); }
    [[nodiscard]] double probability() const { return decision.probability[decision.best]; }
    /// The middle of the base.
    [[nodiscard]] Eigen::Vector3d place() const {
        return box.center - 0.5 * box.lengths[2] * box.axes.col(2);
    }
};

/// The objects in a scan.
struct scan_objects {
    gnomon::recognition::perceived_views seen;
    std::vector<object> objects;  ///< those of seen.views
};

namespace detail {

/// The smallest box on a base in the directions of the ground.
inline gnomon::oriented_box upright_box(const gnomon::scan& scan,
                                        std::span<const gnomon::point_index> members,
                                        const gnomon::plane& ground) {
    const auto points = gnomon::subset(scan.points, members);  // projected upright, not along rays
    auto box = gnomon::minimum_area_rectangle(gnomon::convex_polygon::of(points, ground));
    const auto [lowest, highest] = std::ranges::minmax(
        points, {}, [&](const Eigen::Vector3d& p) { return ground.signed_distance(p); });
    const double low = ground.signed_distance(lowest), high = ground.signed_distance(highest);
    box.axes.col(2) = ground.normal;
    box.axes.col(1) = ground.normal.cross(Eigen::Vector3d(box.axes.col(0)));
    box.center += (0.5 * (low + high) - ground.signed_distance(box.center)) * ground.normal;
    box.lengths[2] = high - low;
    return box;
}

}  // namespace detail

/// Perceives the views of a scan, and decides on each.
/// @throws gnomon::error  if the ground is not known, from which heights are measured
inline scan_objects objects_of(const gnomon::scan& scan, const std::string& name,
                               const gnomon::recognition::perceive_views_options& how,
                               const gnomon::recognition::object_recognizer<>& model,
                               const gnomon::recognition::decide_options& decisions,
                               const gnomon::threads& threads) {
    scan_objects all{gnomon::recognition::perceive_views(scan, how, threads), {}};
    if (!all.seen.ground)
        throw gnomon::error(name, "", "has no floor, from which heights are measured");
    const auto& views = all.seen.views;
    all.objects.resize(views.size());
    threads(views.size(), [&](std::size_t v) {
        object& o = all.objects[v];
        o.decision = gnomon::recognition::explain(model, views[v], decisions);
        o.name = o.is_recognized() ? model.names()[o.decision.best]
                                   : std::string(gnomon::recognition::background_name);
        o.points = all.seen.groups[v].size();
        o.box = detail::upright_box(scan, all.seen.groups[v], *all.seen.ground);
    });
    return all;
}
