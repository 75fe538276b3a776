// SPDX-License-Identifier: BSL-1.0
// Rays per second and core of the default caster, of Embree and of Eigen's bounding volume
// hierarchy, on the rays of one high-density rotational scan; and whole scans.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <benchmark/benchmark.h>

#include "../../examples/common/help.hpp"
#include <gnomon/adapters/embree_caster.hpp>
#include <gnomon/simulation.hpp>
#include <unsupported/Eigen/BVH>

namespace sim = gnomon::simulation;

namespace {

using box3 = Eigen::AlignedBox<double, 3>;

/// The shapes of a scene in Eigen's hierarchy, walked by its own search for a minimum.
class eigen_caster {
  public:
    explicit eigen_caster(const sim::scene& world) : shapes_(world.shapes()) {
        std::vector<std::size_t> numbers;
        std::vector<box3> boxes;
        for (std::size_t i = 0; i < shapes_.size(); ++i) {
            numbers.push_back(i);
            boxes.emplace_back(shapes_[i].extent.low, shapes_[i].extent.high);
        }
        tree_.init(numbers.begin(), numbers.end(), boxes.begin(), boxes.end());
    }

    std::optional<sim::ray_hit> operator()(const sim::ray& r) const {
        search s{shapes_, r, std::nullopt};
        Eigen::BVMinimize(tree_, s);
        return s.hit;
    }

  private:
    struct search {
        using Scalar = double;

        const std::vector<sim::placed_shape>& shapes;
        sim::ray r;
        std::optional<sim::ray_hit> hit;

        double minimumOnVolume(const box3& b) const {
            double enter = 0.0;
            double leave = r.reach;
            for (int a = 0; a < 3; ++a) {
                const double t0 = (b.min()[a] - r.origin[a]) / r.direction[a];
                const double t1 = (b.max()[a] - r.origin[a]) / r.direction[a];
                enter = std::max(enter, std::min(t0, t1));
                leave = std::min(leave, std::max(t0, t1));
            }
            return enter <= leave ? enter : std::numeric_limits<double>::infinity();
        }
        double minimumOnObject(std::size_t i) {
            const auto found = shapes[i].first_hit(r);
            if (!found) return std::numeric_limits<double>::infinity();
            hit = found;
            r.reach = found->range;
            return found->range;
        }
    };

    std::vector<sim::placed_shape> shapes_;
    Eigen::KdBVH<double, 3, std::size_t> tree_;
};

/// One mesh: a bumpy cave of 80,000 triangles around the sensor.
sim::scene cave() {
    constexpr std::uint32_t n = 200;
    sim::polyhedron faces;
    for (std::uint32_t i = 0; i <= n; ++i) {
        for (std::uint32_t j = 0; j < n; ++j) {
            const double latitude = std::numbers::pi * i / n;
            const double longitude = 2.0 * std::numbers::pi * j / n;
            const double r = 3.0 + 0.3 * std::sin(9.0 * latitude) * std::cos(7.0 * longitude);
            faces.vertices.push_back({r * std::sin(latitude) * std::cos(longitude),
                                      r * std::sin(latitude) * std::sin(longitude),
                                      r * std::cos(latitude)});
        }
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t j = 0; j < n; ++j) {
            const std::uint32_t here = i * n + j;
            const std::uint32_t right = i * n + (j + 1) % n;
            faces.triangles.push_back({here, right, right + n});
            faces.triangles.push_back({here, right + n, here + n});
        }
    }
    sim::scene world;
    world.add(world.add_part(world.add_object("cave"), "wall"), sim::triangle_mesh(faces));
    return world;
}

const sim::scene& scene_called(const std::string& name) {
    static const std::map<std::string, sim::scene> scenes{
        {"kitchen", sim::scenes::kitchen()},
        {"living_room", sim::scenes::living_room()},
        {"cave_of_80000_triangles", cave()}};
    return scenes.at(name);
}

/// The rays of a rotational scan of 115,200.
std::vector<sim::ray> rays_of(const sim::scene& world) {
    const sim::rotational trajectory{.mount = world.sensor};
    const sim::scanner finder = sim::densities::high();
    std::vector<sim::ray> rays;
    for (std::size_t line = 0; line < finder.lines(4.0); ++line) {
        const sim::pose sensor = trajectory((static_cast<double>(line) + 0.5) / 40.0);
        for (std::size_t j = 0; j < finder.beams(); ++j)
            rays.push_back({sensor.position, sensor.direction_out(finder.direction(j))});
    }
    return rays;
}

template <class Caster>
void cast(benchmark::State& state, const std::string& name) {
    const sim::scene& world = scene_called(name);
    const Caster caster(world);
    const auto rays = rays_of(world);
    for (auto _ : state) {
        double sum = 0.0;
        for (const sim::ray& r : rays) {
            if (const auto hit = caster(r)) sum += hit->range;
        }
        benchmark::DoNotOptimize(sum);
    }
    state.counters["rays/s"] = benchmark::Counter(static_cast<double>(rays.size()),
                                                  benchmark::Counter::kIsIterationInvariantRate);
}

void scan(benchmark::State& state, const sim::beam& b) {
    const sim::scene& world = scene_called("kitchen");
    const sim::rotational trajectory{.mount = world.sensor};
    std::size_t points = 0;
    for (auto _ : state) {
        points = sim::simulate(world, trajectory, sim::densities::high(), b).scan.size();
    }
    state.counters["points"] = static_cast<double>(points);
}

}  // namespace

int main(int argc, char** argv) {
    if (printed_help(argc, argv, "Measures the times of ray casters.",
                     " [options of Google Benchmark, such as --benchmark_filter=REGEX]"))
        return 0;
    benchmark::Initialize(&argc, argv);
    const auto measure = [](const std::string& name, const auto& what, const auto& how) {
        benchmark::RegisterBenchmark(name.c_str(), what, how)->Unit(benchmark::kMillisecond);
    };
    for (const std::string scene : {"kitchen", "living_room", "cave_of_80000_triangles"}) {
        measure("cast/" + scene + "/bvh_caster", cast<sim::bvh_caster>, scene);
        measure("cast/" + scene + "/embree_caster", cast<sim::embree_caster>, scene);
        measure("cast/" + scene + "/eigen_kdbvh", cast<eigen_caster>, scene);
    }
    measure("scan/kitchen/noisy", scan, sim::beam{.sigma = 0.015});
    const sim::beam_footprint wide{.divergence = gnomon::radians(0.004)};
    measure("scan/kitchen/skimmed", scan, sim::beam{.sigma = 0.015, .footprint = wide});
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
}
