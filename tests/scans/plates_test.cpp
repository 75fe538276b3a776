// SPDX-License-Identifier: BSL-1.0
// Consistency of the covariances of normals (Klasing 2010, Fig. 3.9, with more plates): the errors
// of ten thousand plates of 30 x 30 cm in front of the scanner, with random orientations.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

namespace sim = gnomon::simulation;

namespace {

/// The results of all trials of one method.
struct study {
    const char* name;
    int trials = 0;
    int failures = 0;  ///< gamma below 0.99, or no normal
    int covered = 0;   ///< the truth within the region of 95 %
    double nees_sum = 0.0;
    double gamma_sum = 0.0;

    void take(const auto& belief, const Eigen::Vector3d& truth) {
        ++trials;
        if (!gnomon::usable(belief.trust)) {
            ++failures;
            return;
        }
        const double quality = gnomon::gamma(belief.normal, truth);
        gamma_sum += quality;
        failures += quality < 0.99;
        const double error = gnomon::nees(belief, truth);
        nees_sum += error;
        covered += error < 5.991;
    }

    [[nodiscard]] double nees() const { return nees_sum / trials; }
    [[nodiscard]] double coverage() const { return static_cast<double>(covered) / trials; }
    [[nodiscard]] double failure_rate() const { return static_cast<double>(failures) / trials; }
    [[nodiscard]] double gamma() const { return gamma_sum / trials; }

    void print() const {
        std::printf("%-26s NEES %-11.4g within 95 %% region %.4f  gamma %.6f  failures %.2f %%\n",
                    name, nees(), coverage(), gamma(), 100.0 * failure_rate());
    }
};

/// All points of a plate scanned on a raster of 1 degree, as seen from the sensor.
struct scanned_plate {
    std::vector<Eigen::Vector3d> points;
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    double cosine = 0.0;  ///< of the incidence

    scanned_plate(std::uint64_t seed, double sigma) {
        const sim::scene world = sim::scenes::plate(seed);
        const sim::scanner finder{.field_of_view = gnomon::degrees(180),
                                  .resolution = gnomon::degrees(1),
                                  .frequency = 60.0,
                                  .min_range = 0.0};
        const sim::vertical sweep{
            .mount = world.sensor, .duration = 1.0, .sweep = gnomon::degrees(60)};
        const auto truth =
            sim::simulate(world, sweep, finder, sim::beam{.sigma = sigma, .seed = seed});
        Eigen::Vector3d rays = Eigen::Vector3d::Zero();
        for (std::size_t i = 0; i < truth.normals.size(); ++i) {
            points.push_back(truth.scan.points[i] - truth.scan.viewpoints[i]);
            normal = truth.normals[i];
            rays += truth.directions[i];
        }
        if (!points.empty()) cosine = std::abs(rays.normalized().dot(normal));
    }
};

auto believe(const auto& estimate, const scanned_plate& plate) {
    return estimate(plate.points[0], std::span(plate.points).subspan(1), Eigen::Vector3d::Zero());
}

TEST(plates, covariances_are_consistent) {
    constexpr double sigma = 0.005;
    constexpr int plates = 10'000;
    study ekf{"plane_ekf"}, ukf{"plane_ukf"}, eif{"plane_eif"}, pca{"plane_pca with covariance"};
    study literal{"literal_plane_ekf"};
    int rejected = 0;
    for (std::uint64_t seed = 1; ekf.trials < plates; ++seed) {
        const scanned_plate plate(seed, sigma);
        if (plate.points.size() < 10 || plate.cosine < std::cos(80.0 * std::numbers::pi / 180.0)) {
            ++rejected;
            continue;
        }
        ekf.take(believe(gnomon::plane_ekf{.noise = gnomon::constant_noise{sigma}}, plate),
                 plate.normal);
        ukf.take(believe(gnomon::plane_ukf{.noise = gnomon::constant_noise{sigma}}, plate),
                 plate.normal);
        eif.take(believe(gnomon::plane_eif{.noise = gnomon::constant_noise{sigma}}, plate),
                 plate.normal);
        pca.take(
            believe(
                gnomon::with_covariance<gnomon::plane_pca>{.noise = gnomon::constant_noise{sigma}},
                plate),
            plate.normal);
        literal.take(
            believe(gnomon::literal_plane_ekf{.noise = gnomon::constant_noise{sigma}, .seed = seed},
                    plate),
            plate.normal);
    }
    std::printf("%d plates; %d more had under ten points or were seen at over 80 degrees\n", plates,
                rejected);
    for (const study* s : {&ekf, &ukf, &eif, &pca}) {
        s->print();
        EXPECT_GE(s->nees(), 1.8);
        EXPECT_LE(s->nees(), 2.3);
        EXPECT_GE(s->coverage(), 0.93);
        EXPECT_LE(s->coverage(), 0.97);
        EXPECT_LT(s->failure_rate(), 0.001);
    }
    EXPECT_GE(ukf.gamma(), ekf.gamma() - 1e-4);
    literal.print();  // the recipe of the thesis: random start, five passes over the same data
    EXPECT_GT(literal.failure_rate(), 0.05);
    EXPECT_LT(literal.coverage(), 0.5);
}

/// The direction in which the covariance is largest is the one in which the errors are.
TEST(plates, the_weak_direction_is_the_direction_of_the_errors) {
    constexpr double sigma = 0.005;
    double along_weak = 0.0;
    double along_strong = 0.0;
    for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
        const scanned_plate plate(seed, sigma);
        if (plate.points.size() < 10 || plate.cosine < 0.2) continue;
        const auto belief =
            believe(gnomon::plane_ekf{.noise = gnomon::constant_noise{sigma}}, plate);
        const auto axes = gnomon::detail::symmetric_eigen(belief.covariance).vectors;
        along_weak += std::pow(plate.normal.dot(axes.col(0)), 2);
        along_strong += std::pow(plate.normal.dot(axes.col(1)), 2);
    }
    EXPECT_GT(along_weak, 1.5 * along_strong);
}

}  // namespace
