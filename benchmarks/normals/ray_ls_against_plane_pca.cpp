// SPDX-License-Identifier: BSL-1.0
/// @file
/// Where is RayLS better than PlanePCA, and where worse? Three ways to scan the kitchen, three
/// densities, seven levels of noise, three sizes of neighborhoods: the gain in gamma, in
/// thousandths.
///     ray_ls_against_plane_pca [--quick]
#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <string_view>
#include <vector>

#include "../../examples/common/help.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

namespace sim = gnomon::simulation;

namespace {

/// The result of one method on a scan.
struct result {
    double gamma;
    double seconds;
};

result run(const sim::true_scan& truth, const gnomon::adjacency& graph, const auto& estimate) {
    result best{0.0, 1e9};
    for (int repetition = 0; repetition < 3; ++repetition) {
        const auto begin = std::chrono::steady_clock::now();
        const auto surface = gnomon::estimate_normals(truth.scan, graph, estimate);
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
        best.seconds = std::min(best.seconds, taken.count());
        best.gamma = gnomon::mean_gamma(surface, truth.normals);
    }
    return best;
}

}  // namespace

int main(int argc, char** argv) {
    const char* const arguments = " [--quick]";
    if (printed_help(argc, argv,
                     "Prints how much better normals by ray_ls are than those by plane_pca.",
                     arguments))
        return 0;
    const bool quick = argc == 2 && std::string_view(argv[1]) == "--quick";
    if (argc > 2 || (argc == 2 && !quick)) {
        std::fputs(usage_of(argv[0], arguments).c_str(), stderr);
        return 2;
    }
    const sim::scene world = sim::scenes::kitchen();
    const std::vector<double> sigmas =
        quick ? std::vector{0.0, 0.015}
              : std::vector{0.0, 0.005, 0.010, 0.015, 0.020, 0.025, 0.030};
    std::vector finders{sim::densities::low(), sim::densities::medium(), sim::densities::high()};
    if (quick) finders.resize(1);
    std::printf("gamma(ray_ls) - gamma(plane_pca) in thousandths\n\n| scan | points | k |");
    for (const double sigma : sigmas) std::printf(" %g mm |", 1e3 * sigma);
    std::printf(" time |\n|---|---|---|");
    for (std::size_t i = 0; i <= sigmas.size(); ++i) std::printf("---|");
    std::printf("\n");

    double worst = 0.0;
    const auto rows_of = [&](const char* name, const auto& trajectory) {
        for (const sim::scanner& finder : finders) {
            std::array<std::vector<result>, 3> pca;
            std::array<std::vector<result>, 3> ray;
            constexpr std::array<std::size_t, 3> ks{15, 30, 50};
            std::size_t points = 0;
            for (const double sigma : sigmas) {
                const auto truth =
                    sim::simulate(world, trajectory, finder, {.sigma = sigma, .seed = 1});
                points = truth.scan.size();
                for (std::size_t i = 0; i < ks.size(); ++i) {
                    const auto graph = gnomon::knn{.k = ks[i]}(truth.scan);
                    pca[i].push_back(run(truth, graph, gnomon::plane_pca{}));
                    ray[i].push_back(run(truth, graph, gnomon::ray_ls{}));
                }
            }
            for (std::size_t i = 0; i < ks.size(); ++i) {
                std::printf("| %s | %zu | %zu |", name, points, ks[i]);
                std::vector<double> ratios;
                for (std::size_t s = 0; s < sigmas.size(); ++s) {
                    const double gain = ray[i][s].gamma - pca[i][s].gamma;
                    worst = std::min(worst, gain);
                    std::printf(" %+.1f |", 1e3 * gain);
                    ratios.push_back(ray[i][s].seconds / pca[i][s].seconds);
                }
                std::sort(ratios.begin(), ratios.end());
                std::printf(" %.2f |\n", ratios[ratios.size() / 2]);
                std::fflush(stdout);
            }
        }
    };
    rows_of("horizontal", sim::horizontal{.mount = world.sensor});
    rows_of("vertical", sim::vertical{.mount = world.sensor});
    rows_of("rotational", sim::rotational{.mount = world.sensor});
    std::printf(
        "\nThe largest loss is %.1f thousandths. Time: that of ray_ls in units of that of\n"
        "plane_pca, without the search, median over the levels of noise.\n",
        -1e3 * worst);
}
