// SPDX-License-Identifier: BSL-1.0
/// @file
/// Why is it a chair? The evidence of a decision in words.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>

#include <Eigen/Core>

#include <gnomon/core.hpp>
#include <gnomon/recognition/posterior.hpp>
#include <gnomon/recognition/view.hpp>

namespace rec = gnomon::recognition;

/// "level part at 0.45 m". Precondition: the view has a ground.
inline std::string name_of(const rec::part& p, const rec::view& v) {
    const double cosine = std::abs(p.shape.frame.normal().dot(v.ground->normal));
    const char* inclination = cosine > std::cos(gnomon::degrees(20).radians())   ? "level"
                              : cosine < std::cos(gnomon::degrees(70).radians()) ? "upright"
                                                                                 : "slanted";
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%s part at %.2f m", inclination,
                  v.ground->signed_distance(p.shape.frame.centroid));
    return text.data();
}

/// With its size: "level part at 0.45 m, 0.42 x 0.40 m".
inline std::string description_of(const rec::part& p, const rec::view& v) {
    Eigen::Vector3d edges = p.shape.frame.box_size;
    std::sort(edges.data(), edges.data() + 3, std::greater<>());
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), ", %.2f x %.2f m", edges[0], edges[1]);
    return name_of(p, v) + text.data();
}

/// What a piece of evidence is about.
inline std::string description_of(const rec::evidence& e, const rec::view& v) {
    const auto both = [&](const char* how) {
        return name_of(v.parts[e.first], v) + how +
               (e.second == rec::term::none ? "the other points" : name_of(v.parts[e.second], v));
    };
    switch (e.kind) {
        case rec::term_kind::part:
            return description_of(v.parts[e.first], v);
        case rec::term_kind::pair:
            return both(" with ");
        case rec::term_kind::missing_pair:
            return both(" not as usual with ");
        case rec::term_kind::part_count:
            return "number of parts";
        case rec::term_kind::rest:
            return "other points and small parts";
        case rec::term_kind::prior:
            break;
    }
    return "frequency of the class";
}
