// SPDX-License-Identifier: BSL-1.0
#include <array>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "laws/shape_laws.hpp"
#include <gnomon/simulation/scene.hpp>
#include <gnomon/simulation/shape.hpp>

namespace {

/// A shape of somebody else's: a disc in z = 0.
struct disc {
    double radius;

    [[nodiscard]] gnomon::bounds extent() const {
        return {{-radius, -radius, 0.0}, {radius, radius, 0.0}};
    }
    [[nodiscard]] static std::array<std::string, 1> surface_names() { return {"disc"}; }
    [[nodiscard]] std::optional<gnomon::ray_hit> first_hit(const gnomon::ray& r) const {
        const double t = -r.origin.z() / r.direction.z();
        if (!(t > 0.0 && t <= r.reach)) return std::nullopt;
        if (!(r.point_at(t).norm() <= radius)) return std::nullopt;
        return gnomon::ray_hit{t, {0.0, 0.0, r.direction.z() > 0.0 ? -1.0 : 1.0}, 0};
    }
};

static_assert(gnomon::shape<disc>);
static_assert(!gnomon::shape<double>);
static_assert(!gnomon::shape<gnomon::ray>);

TEST(shape, may_be_the_users_own) {
    EXPECT_GT(laws::obeys_shape_laws(disc{0.4}, 1), 100u);
    gnomon::scene world;
    const auto surface = world.add(world.add_part(world.add_object("table"), "top"), disc{0.4});
    EXPECT_EQ(world.surface_name(surface), "table/top/disc");
}

}  // namespace
