// SPDX-License-Identifier: BSL-1.0
// Fig. 4.3: an outlier between two seats, whose normal agrees with both. Found as a neighbor of
// neither and a link to both: the bound on the distance is what keeps the seats apart.
#include <limits>

#include "rooms.hpp"

namespace {

/// Two seats 0.8 m apart, sampled every 2 cm with 2 mm of noise, and an outlier between them.
std::vector<Eigen::Vector3d> two_seats(std::uint64_t seed) {
    gnomon::random_stream random(seed);
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 20; ++i) {
        for (int j = 0; j < 20; ++j) {
            const double y = 0.02 * j;
            points.emplace_back(0.02 * i, y, 0.002 * random.gaussian());
            points.emplace_back(1.18 + 0.02 * i, y, 0.002 * random.gaussian());
        }
    }
    points.emplace_back(0.78, 0.19, 0.0);
    return points;
}

json measure(const effort& much) {
    json rows = json::array();
    for (unsigned seed = 1; seed <= much.seeds(); ++seed) {
        const auto points = two_seats(seed);
        const auto surface = gnomon::estimate_normals(points, gnomon::knn{}, gnomon::plane_pca{});
        const auto parts = [&](double max_distance) {
            return gnomon::segment_surfaces(points, surface, {.max_distance = max_distance});
        };
        const gnomon::segments bounded = parts(0.30);
        rows.push_back(
            {{"seed", seed},
             {"rho_bar of the outlier [m]", rounded(surface.back().mean_distance, 2)},
             {"segments, no link over 0.30 m", bounded.size()},
             {"without a bound", parts(std::numeric_limits<double>::infinity()).size()}});
        if (seed > 1) continue;
        draw(points, normals_of(surface), bounded, {0.78, -2.0, 1.2}, much.out / "fig_4_3.png");
    }
    return {{"seats", rows}};
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, measure); }
