// SPDX-License-Identifier: BSL-1.0
#include <array>
#include <optional>
#include <string>

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include "laws/shape_laws.hpp"
#include <gnomon/simulation/scene.hpp>
#include <gnomon/simulation/shape.hpp>
#include <gnomon/simulation/sphere.hpp>

namespace sim = gnomon::simulation;

namespace {

/// A user-defined shape: a disc in z = 0.
struct disc {
    double radius;

    [[nodiscard]] sim::bounds extent() const {
        return {{-radius, -radius, 0.0}, {radius, radius, 0.0}};
    }
    [[nodiscard]] static std::array<std::string, 1> surface_names() { return {"disc"}; }
    [[nodiscard]] std::optional<sim::ray_hit> first_hit(const sim::ray& r) const {
        const double t = -r.origin.z() / r.direction.z();
        if (!(t > 0.0 && t <= r.reach)) return std::nullopt;
        if (!(r.point_at(t).norm() <= radius)) return std::nullopt;
        return sim::ray_hit{t, {0.0, 0.0, r.direction.z() > 0.0 ? -1.0 : 1.0}, 0};
    }
};

static_assert(sim::shape<disc>);
static_assert(!sim::shape<double>);
static_assert(!sim::shape<sim::ray>);

TEST(shape, can_be_user_defined) {
    EXPECT_GT(laws::obeys_shape_laws(disc{0.4}, 1), 100u);
    sim::scene world;
    const auto surface = world.add_object("table", disc{0.4});
    EXPECT_EQ(world.surface_name(surface), "table/body/disc");
}

/// The laws have teeth: a ball that is blind from within breaks them.
struct blind_ball {
    sim::sphere ball;

    [[nodiscard]] sim::bounds extent() const { return ball.extent(); }
    [[nodiscard]] static std::array<std::string, 1> surface_names() { return {"ball"}; }
    [[nodiscard]] std::optional<sim::ray_hit> first_hit(const sim::ray& r) const {
        if (r.origin.norm() < ball.radius) return std::nullopt;
        return ball.first_hit(r);
    }
};

TEST(shape, must_be_seen_from_within) {
    testing::TestPartResultArray failures;
    {
        const testing::ScopedFakeTestPartResultReporter reporter(
            testing::ScopedFakeTestPartResultReporter::INTERCEPT_ALL_THREADS, &failures);
        (void)laws::obeys_shape_laws(blind_ball{{0.5}}, 1);
    }
    EXPECT_GT(failures.size(), 0);
}

}  // namespace
