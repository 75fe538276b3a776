// SPDX-License-Identifier: BSL-1.0
/// @file
/// The picture of a scan in which objects have been recognized: each in a color of its own, in its
/// box, with its name.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "picture/picture.hpp"
#include "recognize_scan/objects.hpp"
#include <gnomon/gnomon.hpp>

/// The twelve edges of a box.
inline void add_edges(picture::annotation& drawing, const gnomon::oriented_box& box,
                      const picture::color& tint) {
    const auto corner = [&](unsigned bits) {
        Eigen::Vector3d p = box.center;
        for (int a = 0; a < 3; ++a)
            p += ((bits >> a & 1u) != 0 ? 0.5 : -0.5) * box.lengths[a] * box.axes.col(a);
        return p;
    };
    for (unsigned from = 0; from < 8; ++from)
        for (unsigned axis = 1; axis < 8; axis *= 2)
            if ((from & axis) == 0)
                drawing.strokes.push_back({corner(from), corner(from | axis), tint});
}

inline picture::image picture_of(const gnomon::scan& scan, const scan_objects& found,
                                 const Eigen::Vector3d& up, const gnomon::threads& threads) {
    picture::annotation drawing;
    std::vector<std::string> legend;
    std::vector<std::int32_t> color_of_object(found.objects.size(), gnomon::unlabeled);
    for (std::size_t v = 0; v < found.objects.size(); ++v) {
        const object& o = found.objects[v];
        if (!o.is_recognized()) continue;
        color_of_object[v] = static_cast<std::int32_t>(legend.size());
        const auto tint = picture::mixed(picture::color_of(color_of_object[v]), picture::ink, 0.5);
        const std::string text = std::to_string(v) + ": " + o.name;
        legend.push_back(text);
        add_edges(drawing, o.box, tint);
        drawing.texts.push_back({o.box.center + 0.5 * o.box.lengths[2] * up, text, tint});
    }
    constexpr std::size_t k = 12;
    auto surface =
        gnomon::estimate_normals(scan, gnomon::knn{.k = k}, gnomon::plane_pca{}, threads);
    gnomon::orient_normals(scan, surface, threads);  // those away from the viewer are left out
    std::vector<picture::splat> splats;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        if (!gnomon::is_finite(scan.points[i])) continue;
        const std::int32_t object = found.seen.groups.labels()[i];
        const std::int32_t label = object == gnomon::unlabeled
                                       ? object
                                       : color_of_object[static_cast<std::size_t>(object)];
        // As in of_perception.hpp: points that fill a disc.
        const double spacing =
            1.5 * surface[i].mean_distance * std::sqrt(std::numbers::pi / static_cast<double>(k));
        splats.push_back({scan.points[i], surface[i].normal, 1.35 * spacing, label});
    }
    const Eigen::Vector3d viewpoint = scan.viewpoints.positions().empty()
                                          ? Eigen::Vector3d::Zero()
                                          : scan.viewpoints.positions().front();
    return picture::picture_of(splats, legend, "object", viewpoint, up, picture::color_of, drawing,
                               threads);
}
