// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/features/alignment.hpp>
#include <gnomon/filters/remove_mixed_points.hpp>
#include <gnomon/filters/voxel_grid.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/perception/detail/whole_beams.hpp>
#include <gnomon/recognition/surface_model.hpp>
#include <gnomon/simulation.hpp>
#include <gnomon/simulation/sample_surface.hpp>

namespace rec = gnomon::recognition;
namespace sim = gnomon::simulation;

namespace {

const gnomon::angle beam_width = gnomon::radians(0.010);
const gnomon::noise_curve beam_noise = gnomon::constant_noise{0.005};

/// A table behind a post, of which the points above the floor are in cells.
struct table_behind_post {
    gnomon::rigid_motion pose = gnomon::rigid_motion::on_ground(2.2, 0.1, gnomon::degrees(25));
    sim::furniture_model table = sim::furniture_models().back();
    gnomon::scan scan;
    std::vector<gnomon::point_index> above;
    gnomon::voxel_grid::means cells;

    table_behind_post() {
        sim::scene world;
        world.add_object("floor", sim::plane_patch{.length = 6.0, .width = 6.0}, sim::at(2, 0, 0));
        (void)sim::add(world, table, pose);
        world.add_object("post", sim::box{0.05, 0.05, 1.0}, sim::at(1.3, 0.1, 0.5));
        scan = sim::simulate(world, sim::vertical{.mount = sim::at(0.0, 0.0, 1.2), .duration = 4.0},
                             sim::scanner{},
                             {.sigma = 0.005,
                              .footprint = {.divergence = beam_width,
                                            .sub_rays = 9,
                                            .rule = sim::echo_rule::averaged}})
                   .scan;
        for (std::size_t i = 0; i < scan.size(); ++i)
            if (scan.points[i].z() > 0.05) above.push_back(static_cast<gnomon::point_index>(i));
        cells = gnomon::average_voxels(gnomon::subset_view(scan, above), {.edge = 0.01});
    }

    [[nodiscard]] rec::detail::mixed_cells mixed(const auto& run) const {
        return {scan, above, cells, beam_width, beam_noise, run, std::identity{}};
    }
};

TEST(whole_beams, mixed_cells_are_those_of_points_that_the_filter_removes) {
    const table_behind_post seen;
    const auto is_mixed = seen.mixed(gnomon::sequential{});
    const auto by_threads = seen.mixed(gnomon::threads{3});
    const auto kept =
        gnomon::remove_mixed_points(seen.scan, {.divergence = beam_width, .noise = beam_noise});
    std::vector<bool> expected(seen.cells.size(), false);
    for (std::size_t i = 0; i < seen.above.size(); ++i)
        if (!std::ranges::binary_search(kept, seen.above[i]))
            expected[seen.cells.of_point[i]] = true;
    for (gnomon::point_index c = 0; c < expected.size(); ++c) {
        EXPECT_EQ(is_mixed(c), expected[c]);
        EXPECT_EQ(by_threads(c), expected[c]);
    }
    EXPECT_GT(std::ranges::count(expected, true), 20);
}

TEST(whole_beams, points_of_mixed_cells_are_left_out) {
    const table_behind_post seen;
    const auto samples = sim::sample_surface(seen.table, {.spacing = 0.02});
    const rec::surface_model surface(samples, samples, 0.02, std::nullopt,
                                     &sim::surface_sample::position);
    const gnomon::spatial_index index(seen.cells);
    const auto normals = gnomon::estimate_normals(index, gnomon::knn{.k = 15}, gnomon::plane_pca{});
    const auto at = [&](const rec::detail::mixed_cells* mixed) {
        return rec::detail::whole_beams_at(seen.cells, index, normals, mixed, surface, seen.pose,
                                           beam_width, 0.03);
    };
    const auto is_mixed = seen.mixed(gnomon::sequential{});
    const auto all = at(nullptr), some = at(&is_mixed);
    std::vector<gnomon::point_index> expected = all.points;
    EXPECT_GT(std::erase_if(expected, std::cref(is_mixed)), 0u);
    EXPECT_EQ(some.points, expected);
    EXPECT_FALSE(some.points.empty());
    // The width and the direction are those of all beams at the object.
    EXPECT_EQ(some.widest, all.widest);
    EXPECT_EQ(some.way, all.way);
}

/// The shift is along the ground and the turn about its normal, whatever the axes of the scan are,
/// and the turn is the shift over half of the mean side.
TEST(whole_beams, shifts_of_edges_are_added_along_the_ground) {
    const auto samples =
        sim::sample_surface({"table", sim::table{.length = 1.2, .width = 0.4}}, {.spacing = 0.02});
    const rec::surface_model model(samples, samples, 0.02, std::nullopt,
                                   &sim::surface_sample::position);
    constexpr double shift = 0.002, half = 0.4;
    for (const Eigen::Vector3d& up : {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0.6, 0, 0.8)}) {
        gnomon::alignment found;
        rec::detail::add_shift_on_ground(found, model, up, shift);
        const Eigen::Vector3d level = up.cross(Eigen::Vector3d(0, 1, 0)), side(0, 1, 0);
        const auto deviation = [&](int first, const Eigen::Vector3d& along) {
            const Eigen::Matrix3d block = found.covariance.block<3, 3>(first, first);
            return std::sqrt(std::max(0.0, along.dot(block * along)));
        };
        EXPECT_NEAR(deviation(0, up), shift / half, 0.05 * shift / half);
        EXPECT_NEAR(deviation(0, level), 0.0, 1e-9);
        EXPECT_NEAR(deviation(3, up), 0.0, 1e-9);
        EXPECT_NEAR(deviation(3, level), shift, 1e-9);
        EXPECT_NEAR(deviation(3, side), shift, 1e-9);
        const auto once = found.covariance;
        rec::detail::add_shift_on_ground(found, model, up, shift);
        EXPECT_NEAR(found.covariance(4, 4), 2.0 * once(4, 4), 1e-12);
    }
    // Of a single sample nothing is infinite.
    const std::vector<sim::surface_sample> one(samples.begin(), samples.begin() + 1);
    const rec::surface_model point(one, one, 0.02, std::nullopt, &sim::surface_sample::position);
    gnomon::alignment found;
    rec::detail::add_shift_on_ground(found, point, Eigen::Vector3d(0, 0, 1), shift);
    EXPECT_NEAR(found.covariance(2, 2), std::pow(shift / 0.02, 2), 1e-12);
}

}  // namespace
