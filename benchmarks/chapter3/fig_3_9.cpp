// SPDX-License-Identifier: BSL-1.0
// Fig. 3.9: plates of 30 x 30 cm in front of a SICK LMS-200, each one neighborhood: PlanePCA, the
// Kalman filter of Alg. 3.2, and the one that this library has in its place. Ten plates as in the
// figure, and ten thousand.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>

#include "measure.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

namespace sim = gnomon::simulation;

namespace {

constexpr double sigma = 0.005;  // [m], the scanner's data sheet
constexpr double degree = std::numbers::pi / 180.0;

/// A plate: its points, its normal, and the direction that the points constrain least.
struct plate {
    std::vector<Eigen::Vector3d> points;  ///< the sensor is the origin
    Eigen::Vector3d normal;               ///< the true one
    Eigen::Vector3d weak;                 ///< in which the best estimate errs most
    std::uint64_t seed = 0;
};

/// The weak direction is that of the Cramer-Rao bound: of rays u with the true ranges r, 1 / r is
/// linear in m = n / d, so that the covariance of m is at least that of linear regression.
Eigen::Vector3d weak_direction(const sim::true_scan& truth, const Eigen::Vector3d& normal) {
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < truth.ranges.size(); ++i) {
        const Eigen::Vector3d x = truth.ranges[i] * truth.directions[i];
        information += x.squaredNorm() * (x * x.transpose());
    }
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - normal * normal.transpose();
    const Eigen::Matrix3d covariance = across * information.inverse() * across;
    return gnomon::detail::symmetric_eigen(covariance / covariance.trace()).vectors.col(0);
}

/// The first plates that show ten points, at less than 80 degrees.
std::vector<plate> first_plates(std::size_t count) {
    std::vector<plate> plates;
    const sim::scanner finder{.field_of_view = gnomon::degrees(180),
                              .resolution = gnomon::degrees(1),
                              .frequency = 60.0,
                              .min_range = 0.0};
    for (std::uint64_t seed = 1; plates.size() < count; ++seed) {
        const sim::scene world = sim::scenes::plate(seed);
        const sim::vertical sweep{
            .mount = world.sensor, .duration = 1.0, .sweep = gnomon::degrees(60)};
        const auto truth = sim::simulate(world, sweep, finder, {.sigma = sigma, .seed = seed});
        if (truth.scan.size() < 10) continue;
        Eigen::Vector3d rays = Eigen::Vector3d::Zero();
        for (const Eigen::Vector3d& u : truth.directions) rays += u;
        const Eigen::Vector3d& normal = truth.normals[0];
        if (std::abs(rays.normalized().dot(normal)) < std::cos(80.0 * degree)) continue;
        plates.push_back({truth.scan.points, normal, weak_direction(truth, normal), seed});
    }
    return plates;
}

auto estimated(const auto& estimate, const plate& p) {
    const auto others = std::span(p.points).subspan(1);
    if constexpr (gnomon::ray_estimator<std::remove_cvref_t<decltype(estimate)>>) {
        return estimate(p.points[0], others, Eigen::Vector3d::Zero());
    } else {
        return estimate(p.points[0], others);
    }
}

/// @param make  the estimator for a plate
void measure(benchmark::State& state, const std::vector<plate>& plates, const auto& make) {
    std::vector<double> seconds;
    for (auto _ : state) {
        seconds.push_back(seconds_of([&] {
            for (const plate& p : plates)
                benchmark::DoNotOptimize(estimated(make(p), p).normal.data());
        }));
    }

    // As many groups of plates as there are seeds elsewhere; of few plates, each is its own.
    const std::size_t groups = plates.size() > 10 ? 5 : plates.size();
    std::vector<double> gamma(groups), failures(groups), near_weak(groups), angles;
    const double share = static_cast<double>(groups) / static_cast<double>(plates.size());
    for (std::size_t i = 0; i < plates.size(); ++i) {
        const plate& p = plates[i];
        const std::size_t g = i * groups / plates.size();
        const auto found = estimated(make(p), p);
        const double quality =
            gnomon::usable(found.trust) ? gnomon::gamma(found.normal, p.normal) : 0.0;
        angles.push_back(gnomon::usable(found.trust)
                             ? gnomon::unoriented_angle(found.normal, p.normal).degrees()
                             : 90.0);
        gamma[g] += share * quality;
        failures[g] += 100.0 * share * (quality < 0.99);
        if constexpr (requires { found.covariance; }) {
            const Eigen::Vector3d axis =
                gnomon::detail::symmetric_eigen(found.covariance).vectors.col(0);
            near_weak[g] += 100.0 * share * (std::abs(axis.dot(p.weak)) > std::cos(20.0 * degree));
        }
    }
    std::sort(angles.begin(), angles.end());
    const auto percentile = [&](double part) {
        return angles[static_cast<std::size_t>(part * static_cast<double>(angles.size() - 1))];
    };
    count_seeds(state, "gamma", gamma);
    double points = 0.0;
    for (const plate& p : plates) points += static_cast<double>(p.points.size());
    state.counters["points"] = points / static_cast<double>(plates.size());
    if (groups != 5) return;
    count_seeds(state, "failures_percent", failures);
    if (near_weak[0] > 0.0) count_seeds(state, "near_weak_percent", near_weak);
    state.counters["p50_deg"] = percentile(0.50);
    state.counters["p90_deg"] = percentile(0.90);
    state.counters["p99_deg"] = percentile(0.99);
    const auto [low, median, high] = quartiles_of(seconds);
    const double microseconds = 1e6 / static_cast<double>(plates.size());
    state.counters["us"] = microseconds * median;
    state.counters["us_low"] = microseconds * low;
    state.counters["us_high"] = microseconds * high;
}

}  // namespace

void enter_benchmarks(const effort& much) {
    const auto over = [&](std::size_t count) {
        const auto plates = std::make_shared<std::vector<plate>>();
        const auto method = [&](const char* name, const auto& make) {
            const std::string title = "fig_3_9/plates:" + std::to_string(count) + "/method:" + name;
            benchmark::RegisterBenchmark(title.c_str(),
                                         [=](benchmark::State& state) {
                                             if (plates->empty()) *plates = first_plates(count);
                                             measure(state, *plates, make);
                                         })
                ->Iterations(much.passes())
                ->Unit(benchmark::kMillisecond);
        };
        method("plane_pca", [](const plate&) { return gnomon::plane_pca{}; });
        method("literal_plane_ekf", [](const plate& p) {
            return gnomon::literal_plane_ekf{.noise = gnomon::constant_noise{sigma},
                                             .seed = p.seed};
        });
        method("plane_ekf", [](const plate&) {
            return gnomon::plane_ekf{.noise = gnomon::constant_noise{sigma}};
        });
        method("plane_pca with covariance", [](const plate&) {
            return gnomon::with_covariance<gnomon::plane_pca>{.noise =
                                                                  gnomon::constant_noise{sigma}};
        });
    };
    over(10);
    over(much.quick ? 1'000 : 10'000);
}
