// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "features/round_samples.hpp"
#include "laws/clouds.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/features/surface_fit.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace {

using round_samples::kind;
using round_samples::outcome;

const gnomon::noise_curve one_centimetre = gnomon::constant_noise{0.01};

template <kind Kind>
struct of_kind {
    static constexpr kind value = Kind;
};
using all_kinds =
    testing::Types<of_kind<kind::sphere>, of_kind<kind::cylinder>, of_kind<kind::cone>>;

/// What all three fits have in common.
template <class K>
class surface_fit : public testing::Test {
  public:
    static auto fit(const auto& points, const auto& surface,
                    const gnomon::noise_curve& noise = one_centimetre) {
        return round_samples::fit<K::value>(points, surface, noise);
    }
    static round_samples::sample draw(round_samples::drawing d = {}, std::uint64_t seed = 1) {
        return round_samples::draw<K::value>(d, seed);
    }
    /// Whether no number of an estimate is NaN or infinite.
    static bool is_finite(const auto& e) {
        double sum = e.radius + e.chi_square + e.rms + e.covariance.sum();
        if constexpr (K::value == kind::sphere)
            sum += e.center.sum();
        else
            sum += e.axis_point.sum() + e.axes.sum();
        return std::isfinite(sum);
    }
};
TYPED_TEST_SUITE(surface_fit, all_kinds);

TYPED_TEST(surface_fit, survives_every_cloud) {
    for (const auto& [name, points] : clouds::degenerate()) {
        SCOPED_TRACE(name);
        for (const Eigen::Vector3d& normal : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0, 0, 1),
                                              Eigen::Vector3d(clouds::nan, 0, 0)}) {
            const std::vector<round_samples::element> surface(points.size(), {normal});
            EXPECT_TRUE(this->is_finite(this->fit(points, surface)));
            EXPECT_TRUE(this->is_finite(this->fit(points, surface, gnomon::constant_noise{0.0})));
            const auto viewed = gnomon::with_viewpoint(points, {0.5, 0.5, 5.0});
            EXPECT_TRUE(this->is_finite(this->fit(viewed, surface)));
        }
    }
}

TYPED_TEST(surface_fit, names_what_is_degenerate) {
    const auto outcome_of = [](const clouds::cloud& points) {
        const std::vector<round_samples::element> surface(points.size(), {{0, 0, 1}});
        const auto e = TestFixture::fit(points, surface);
        EXPECT_FALSE(e.has_parameters());
        EXPECT_EQ(e.radius, 0.0);
        EXPECT_EQ(e.covariance.norm(), 0.0);
        return e.status;
    };
    clouds::cloud line, plane, far_plane;
    for (int i = 0; i < 60; ++i) {
        line.push_back({0.1 * i, 0.2 * i, -0.3 * i});
        plane.push_back({0.1 * (i % 8), 0.1 * (i / 8), 0.05 * (i % 8) - 0.02 * (i / 8)});
        far_plane.push_back(plane.back() + Eigen::Vector3d(4e5, 5e6, 100.0));
    }
    EXPECT_EQ(outcome_of({}), outcome::too_few_points);
    EXPECT_EQ(outcome_of(clouds::in_cube(4, 1)), outcome::too_few_points);
    EXPECT_EQ(outcome_of(clouds::cloud(20, {clouds::nan, 0, 0})), outcome::too_few_points);
    EXPECT_EQ(outcome_of(clouds::cloud(20, {1.0, 2.0, 3.0})), outcome::degenerate);
    EXPECT_EQ(outcome_of(line), outcome::degenerate);
    EXPECT_EQ(outcome_of(plane), outcome::degenerate);
    EXPECT_EQ(outcome_of(far_plane), outcome::degenerate);
}

/// Noisy planes have a radius of curvature, by chance; it is not significant.
TYPED_TEST(surface_fit, of_a_noisy_plane_is_degenerate) {
    int degenerate = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const auto points = [&] {
            clouds::cloud sheet = clouds::in_cube(200, seed);
            gnomon::random_stream random(seed, 3);
            for (auto& p : sheet) p.z() = 0.01 * random.gaussian();
            return sheet;
        }();
        const std::vector<round_samples::element> surface(points.size(), {{0, 0, 1}});
        degenerate += this->fit(points, surface).status == outcome::degenerate;
    }
    EXPECT_GE(degenerate, 95);
}

TYPED_TEST(surface_fit, of_a_cube_is_poor) {
    const auto points = clouds::in_cube(500, 1);
    const std::vector<round_samples::element> surface(points.size(), {{0, 0, 1}});
    const auto e = this->fit(points, surface);
    EXPECT_TRUE(e.status == outcome::poor_fit || e.status == outcome::not_converged ||
                e.status == outcome::degenerate)
        << gnomon::to_string(e.status);
}

/// Points that are not finite are left out, and so are normals, not their points.
TYPED_TEST(surface_fit, leaves_out_what_is_not_finite) {
    auto s = this->draw({.sigma = 0.01});
    const auto whole = this->fit(s.points, s.surface);
    s.surface[3].normal = {clouds::nan, 0, 0};
    s.surface[5].normal = {0, 0, 0};
    EXPECT_EQ(this->fit(s.points, s.surface).points, s.points.size());
    s.points.push_back({clouds::nan, 1, 2});
    s.points.push_back({1, clouds::infinity, 2});
    s.surface.push_back({{0, 0, 1}});
    s.surface.push_back({{0, 0, 1}});
    const auto e = this->fit(s.points, s.surface);
    EXPECT_EQ(e.points, whole.points);
    EXPECT_NEAR(e.radius, whole.radius, 1e-6 * std::sqrt(whole.covariance.trace()));
    EXPECT_NEAR(e.chi_square, whole.chi_square, 1e-9 * whole.chi_square);
}

TYPED_TEST(surface_fit, needs_no_normals) {
    auto s = this->draw({.sigma = 0.01});
    const auto with = this->fit(s.points, s.surface);
    for (auto& element : s.surface) element.normal = {0, 0, 0};
    EXPECT_NEAR(this->fit(s.points, s.surface).radius, with.radius, 1e-6);
}

TYPED_TEST(surface_fit, refuses_what_does_not_belong_together) {
    auto s = this->draw();
    EXPECT_THROW((void)this->fit(s.points, s.surface, gnomon::constant_noise{-0.01}),
                 std::invalid_argument);
    EXPECT_THROW((void)this->fit(s.points, s.surface, gnomon::constant_noise{clouds::nan}),
                 std::invalid_argument);
    s.surface.pop_back();
    EXPECT_THROW((void)this->fit(s.points, s.surface), std::invalid_argument);
}

/// A fit under a rigid motion and a scale: radius and deviations scale, outcomes stay.
TYPED_TEST(surface_fit, is_equivariant) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const auto s = this->draw({.sigma = 0.02}, seed);
        const auto e = this->fit(s.points, s.surface, gnomon::constant_noise{0.02});
        const Eigen::Matrix3d r = clouds::random_rotation(seed + 100);
        const double scale = std::exp(0.7 * static_cast<double>(seed) - 7.0);
        const auto moved = clouds::moved(s.points, scale * r, {1.0, -2.0, 3.0});
        auto surface = s.surface;
        for (auto& element : surface) element.normal = r * element.normal;
        const auto m = this->fit(moved, surface, gnomon::constant_noise{0.02 * scale});
        EXPECT_EQ(m.status, e.status);
        const int last = TypeParam::value == kind::sphere ? 3 : 4;  // the radius
        const double deviation = std::sqrt(e.covariance(last, last));
        EXPECT_NEAR(m.radius / scale, e.radius, 1e-4 * deviation);
        EXPECT_NEAR(std::sqrt(m.covariance(last, last)) / scale, deviation, 1e-4 * deviation);
        EXPECT_NEAR(m.chi_square, e.chi_square, 1e-6 * e.chi_square);
        EXPECT_NEAR(m.rms / scale, e.rms, 1e-6 * e.rms);
    }
}

TYPED_TEST(surface_fit, does_not_depend_on_threads_or_containers) {
    const auto s = this->draw({.sigma = 0.01, .points = 5000});
    const auto fit_on = [&](const auto& points, const auto&... run) {
        if constexpr (TypeParam::value == kind::sphere)
            return gnomon::fit_sphere(points, s.surface, one_centimetre, run...);
        else if constexpr (TypeParam::value == kind::cylinder)
            return gnomon::fit_cylinder(points, s.surface, one_centimetre, run...);
        else
            return gnomon::fit_cone(points, s.surface, one_centimetre, run...);
    };
    const auto e = fit_on(s.points);
    for (unsigned n : {1u, 3u}) {
        const auto f = fit_on(s.points, gnomon::threads{n});
        EXPECT_EQ(f.radius, e.radius);
        EXPECT_EQ(f.chi_square, e.chi_square);
        EXPECT_EQ(f.covariance, e.covariance);
    }
    EXPECT_EQ(fit_on(gnomon::spatial_index(s.points)).radius, e.radius);
    std::vector<Eigen::Vector3f> floats;
    for (const Eigen::Vector3d& p : s.points) floats.push_back(p.cast<float>());
    EXPECT_NEAR(fit_on(floats).radius, e.radius, 1e-5);
}

/// The fit of members is that of a range of them, with their view points and normals.
TYPED_TEST(surface_fit, of_members_is_that_of_their_points) {
    auto s = this->draw({.sigma = 0.01, .along_rays = true});
    auto outliers = clouds::in_cube(50, 4);
    std::vector<gnomon::point_index> members;
    for (gnomon::point_index i = 0; i < s.points.size(); ++i) members.push_back(i);
    const auto alone = this->fit(s.viewed(), s.surface);
    s.points.insert(s.points.end(), outliers.begin(), outliers.end());
    s.surface.resize(s.points.size(), {{0, 0, 1}});
    const auto fit_of = [&](const auto& indices) {
        if constexpr (TypeParam::value == kind::sphere)
            return gnomon::fit_sphere(s.viewed(), s.surface, indices, one_centimetre);
        else if constexpr (TypeParam::value == kind::cylinder)
            return gnomon::fit_cylinder(s.viewed(), s.surface, indices, one_centimetre);
        else
            return gnomon::fit_cone(s.viewed(), s.surface, indices, one_centimetre);
    };
    EXPECT_EQ(fit_of(members).radius, alone.radius);
    EXPECT_EQ(fit_of(members).covariance, alone.covariance);
    members.push_back(1000);
    EXPECT_THROW((void)fit_of(members), std::invalid_argument);
}

/// Residuals have the chi-square distribution: .3 % of fits are poor.
TYPED_TEST(surface_fit, test_of_fit_has_its_level) {
    int poor = 0;
    double sum = 0.0;
    constexpr int draws = 1000;
    for (int i = 0; i < draws; ++i) {
        const auto s = this->draw({.sigma = 0.01, .points = 60}, static_cast<std::uint64_t>(i));
        const auto e = this->fit(s.points, s.surface);
        poor += e.status == outcome::poor_fit;
        sum += e.chi_square / static_cast<double>(e.degrees_of_freedom);
    }
    EXPECT_LT(poor, 10);
    EXPECT_NEAR(sum / draws, 1.0, 0.03);
}

TEST(surface_fit_outcome, has_a_name) {
    EXPECT_STREQ(gnomon::to_string(outcome::good), "good");
    EXPECT_STREQ(gnomon::to_string(outcome::poor_fit), "poor_fit");
    EXPECT_STREQ(gnomon::to_string(outcome::not_converged), "not_converged");
    EXPECT_STREQ(gnomon::to_string(outcome::too_few_points), "too_few_points");
    EXPECT_STREQ(gnomon::to_string(outcome::degenerate), "degenerate");
}

}  // namespace
