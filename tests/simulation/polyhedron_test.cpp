// SPDX-License-Identifier: BSL-1.0
#include <gtest/gtest.h>

#include "laws/shape_laws.hpp"
#include <gnomon/simulation/box.hpp>
#include <gnomon/simulation/plane_patch.hpp>
#include <gnomon/simulation/polyhedron.hpp>
#include <gnomon/simulation/sphere.hpp>
#include <gnomon/simulation/triangle_mesh.hpp>

namespace sim = gnomon::simulation;

namespace {

static_assert(sim::detail::flat_shape<sim::box>);
static_assert(sim::detail::flat_shape<sim::plane_patch>);
static_assert(sim::detail::flat_shape<sim::triangle_mesh>);
static_assert(!sim::detail::flat_shape<sim::sphere>);

TEST(polyhedron, of_a_patch_is_the_patch) {
    const sim::plane_patch patch{0.4, 0.3};
    const sim::triangle_mesh mesh(patch.triangles());
    for (const sim::ray& r : laws::rays_at(patch.extent(), 2000, 1)) {
        const auto expected = patch.first_hit(r);
        const auto found = mesh.first_hit(r);
        ASSERT_EQ(expected.has_value(), found.has_value());
        if (expected) {
            EXPECT_NEAR(found->range, expected->range, 1e-12 * (1 + expected->range));
        }
    }
}

}  // namespace
