// SPDX-License-Identifier: BSL-1.0
#include <gtest/gtest.h>

#include "laws/shape_laws.hpp"
#include <gnomon/simulation/box.hpp>
#include <gnomon/simulation/plane_patch.hpp>
#include <gnomon/simulation/polyhedron.hpp>
#include <gnomon/simulation/sphere.hpp>
#include <gnomon/simulation/triangle_mesh.hpp>

namespace {

static_assert(gnomon::flat_shape<gnomon::box>);
static_assert(gnomon::flat_shape<gnomon::plane_patch>);
static_assert(gnomon::flat_shape<gnomon::triangle_mesh>);
static_assert(!gnomon::flat_shape<gnomon::sphere>);

TEST(polyhedron, of_a_patch_is_the_patch) {
    const gnomon::plane_patch patch{0.4, 0.3};
    const gnomon::triangle_mesh mesh(patch.triangles());
    for (const gnomon::ray& r : laws::rays_at(patch.extent(), 2000, 1)) {
        const auto expected = patch.first_hit(r);
        const auto found = mesh.first_hit(r);
        ASSERT_EQ(expected.has_value(), found.has_value());
        if (expected) {
            EXPECT_NEAR(found->range, expected->range, 1e-12 * (1 + expected->range));
        }
    }
}

}  // namespace
