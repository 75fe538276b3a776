// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "features/patches.hpp"
#include "laws/clouds.hpp"
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/features/curvature.hpp>
#include <gnomon/features/estimate_curvature.hpp>
#include <gnomon/features/surface_type.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/orient.hpp>
#include <gnomon/normals/plane_pca.hpp>

namespace {

using gnomon::besl_jain, gnomon::surface_type;

// The table of Fig. 3.13, by the signs alone.
constexpr besl_jain by_sign;
static_assert(by_sign(1, -1) == surface_type::peak);
static_assert(by_sign(0, -1) == surface_type::ridge);
static_assert(by_sign(-1, -1) == surface_type::saddle_ridge);
static_assert(by_sign(0, 0) == surface_type::flat);
static_assert(by_sign(-0.0, -0.0) == surface_type::flat);
static_assert(by_sign(-1, 0) == surface_type::minimal);
static_assert(by_sign(-1, 1) == surface_type::saddle_valley);
static_assert(by_sign(0, 1) == surface_type::valley);
static_assert(by_sign(1, 1) == surface_type::pit);
static_assert(by_sign(1, 0) == surface_type::unknown);
static_assert(by_sign(clouds::nan, 0) == surface_type::unknown);
static_assert(by_sign(0, clouds::nan) == surface_type::unknown);
static_assert(by_sign(1e-300, -1e-300) == surface_type::peak);

// Values up to the tolerance, inclusive, count as zero; K and H each have their own tolerance.
constexpr besl_jain coarse{.gaussian_tolerance = 0.01, .mean_tolerance = 0.5};
static_assert(coarse(0.01, 0.5) == surface_type::flat);
static_assert(coarse(-0.01, -0.5) == surface_type::flat);
static_assert(coarse(-0.011, 0.5) == surface_type::minimal);
static_assert(coarse(0.01, 0.51) == surface_type::valley);
static_assert(coarse(0.01, -0.51) == surface_type::ridge);
static_assert(coarse(-0.011, -0.51) == surface_type::saddle_ridge);
static_assert(coarse(-0.011, 0.51) == surface_type::saddle_valley);
static_assert(coarse(0.2, 0.46) == surface_type::pit);  // a ball of radius 2.2 m is not flat
static_assert(coarse(0.2, -0.46) == surface_type::peak);

static_assert(gnomon::to_string(surface_type::peak)[0] == 'p');

TEST(surface_type, has_a_name_for_each) {
    std::set<std::string> names;
    for (std::uint8_t t = 0; t <= static_cast<std::uint8_t>(surface_type::unknown); ++t) {
        names.insert(to_string(static_cast<surface_type>(t)));
    }
    EXPECT_EQ(names.size(), 9u);
    EXPECT_STREQ(to_string(surface_type::saddle_valley), "saddle_valley");
    EXPECT_STREQ(to_string(surface_type::unknown), "unknown");
}

TEST(surface_type, of_an_unusable_curvature_is_unknown) {
    EXPECT_EQ(besl_jain{}(gnomon::curvature{}), surface_type::unknown);
    gnomon::curvature flat;
    flat.trust = gnomon::trust::weak;
    EXPECT_EQ(besl_jain{}(flat), surface_type::flat);
}

TEST(surface_type, refuses_tolerances_that_are_none) {
    for (const double t : {-1e-300, -1.0, clouds::nan}) {
        for (const besl_jain& broken :
             {besl_jain{.gaussian_tolerance = t}, {.mean_tolerance = t}}) {
            EXPECT_THROW((void)broken(0.0, 0.0), std::invalid_argument);
            EXPECT_THROW((void)broken(clouds::nan, 0.0), std::invalid_argument);
            EXPECT_THROW((void)broken(gnomon::curvature{}), std::invalid_argument);
        }
    }
    const besl_jain all_is_flat{.gaussian_tolerance = clouds::infinity,
                                .mean_tolerance = clouds::infinity};
    EXPECT_EQ(all_is_flat(1.0, -1.0), surface_type::flat);
}

/// Each of the eight types from its patch, and with the opposite normal the opposite type.
TEST(surface_type, of_known_surfaces) {
    // Neighborhoods of 1 cm: curvatures err by less than 1e-3 / m, on radii from half a metre.
    const besl_jain type{.gaussian_tolerance = 5e-3, .mean_tolerance = 1e-3};
    const auto opposite = [](surface_type t) {
        switch (t) {
            case surface_type::peak:
                return surface_type::pit;
            case surface_type::ridge:
                return surface_type::valley;
            case surface_type::saddle_ridge:
                return surface_type::saddle_valley;
            case surface_type::saddle_valley:
                return surface_type::saddle_ridge;
            case surface_type::valley:
                return surface_type::ridge;
            case surface_type::pit:
                return surface_type::peak;
            default:
                return t;
        }
    };
    const Eigen::Vector3d p(0, 0, 0);
    std::set<surface_type> seen;
    for (const auto& surface : patches::all()) {
        SCOPED_TRACE(surface.name);
        const auto neighbors = patches::neighborhood_of(surface, 100, 0.01, 3);
        const auto both = [&](const auto& estimate) {
            EXPECT_EQ(type(estimate(p, patches::up, neighbors)), surface.type);
            EXPECT_EQ(type(estimate(p, -patches::up, neighbors)), opposite(surface.type));
        };
        both(gnomon::shape_operator_curvature{});
        both(gnomon::thesis_curvature{});
        seen.insert(surface.type);
    }
    EXPECT_EQ(seen.size(), 8u);
}

/// The types of points observed from v, by the whole chain: normals, their orientation, curvatures.
std::vector<surface_type> types_seen_from(const Eigen::Vector3d& v, const clouds::cloud& points) {
    const auto seen = gnomon::with_viewpoint(points, v);
    const auto graph = gnomon::knn{.k = 20}(seen);
    auto surface = gnomon::estimate_normals(seen, graph, gnomon::plane_pca{});
    gnomon::orient_normals(seen, surface);
    std::vector<surface_type> types;
    for (const auto& c : gnomon::estimate_curvature(seen, graph, surface)) {
        types.push_back(besl_jain{.gaussian_tolerance = 0.05, .mean_tolerance = 0.05}(c));
    }
    return types;
}

/// A sphere is a peak if observed from outside, and a pit if observed from inside.
TEST(surface_type, of_a_sphere_depends_on_the_view_point) {
    const auto sphere = patches::on_sphere(4000);
    for (const surface_type t : types_seen_from({0, 0, 0}, sphere)) ASSERT_EQ(t, surface_type::pit);
    const auto from_outside = types_seen_from({10, 0, 0}, sphere);
    for (std::size_t i = 0; i < sphere.size(); ++i) {
        const double horizon = 0.1;  // at R^2 / 10 m the viewing ray is tangent to the sphere
        if (std::abs(sphere[i].x() - horizon) < 0.02) continue;
        ASSERT_EQ(from_outside[i],
                  sphere[i].x() > horizon ? surface_type::peak : surface_type::pit);
    }
}

/// A cylinder is a ridge if observed from outside, and a valley if observed from inside.
TEST(surface_type, of_a_cylinder_depends_on_the_view_point) {
    clouds::cloud column;
    for (int i = 0; i < 60; ++i) {
        for (int j = 0; j < 60; ++j) {
            const double phi = 0.02 * i - 0.6;  // a part that faces +x
            column.push_back({std::cos(phi), std::sin(phi), 0.02 * j});
        }
    }
    for (const surface_type t : types_seen_from({5, 0, 0}, column)) {
        ASSERT_EQ(t, surface_type::ridge);
    }
    for (const surface_type t : types_seen_from({0, 0, 0.6}, column)) {
        ASSERT_EQ(t, surface_type::valley);
    }
}

}  // namespace
