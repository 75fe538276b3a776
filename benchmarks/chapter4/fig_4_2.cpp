// SPDX-License-Identifier: BSL-1.0
// Fig. 4.2: Alg. 4.1 on points with normals. Two boxes and a bin by one distance in six dimensions,
// greedily; a corner, a step and a bend by two thresholds.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "rooms.hpp"

namespace sim = gnomon::simulation;

namespace {

/// Agreement of two partitions beyond chance, 1 if they are the same (Hubert and Arabie 1985).
double adjusted_rand_index(const std::vector<std::int32_t>& a, const std::vector<std::int32_t>& b) {
    std::map<std::pair<std::int32_t, std::int32_t>, double> both;
    std::map<std::int32_t, double> in_a, in_b;
    for (std::size_t i = 0; i < a.size(); ++i) {
        ++both[{a[i], b[i]}];
        ++in_a[a[i]];
        ++in_b[b[i]];
    }
    const auto pairs = [](const auto& counts) {
        double sum = 0.0;
        for (const auto& [key, n] : counts) sum += 0.5 * n * (n - 1.0);
        return sum;
    };
    const auto n = static_cast<double>(a.size());
    const double expected = pairs(in_a) * pairs(in_b) / (0.5 * n * (n - 1.0));
    return (pairs(both) - expected) / (0.5 * (pairs(in_a) + pairs(in_b)) - expected);
}

/// Agreement of segmentations of scans with the true surfaces, over the labeled points.
struct agreement {
    std::vector<double> segments, percent, index;

    void add(const sim::true_scan& truth, const gnomon::segments& parts) {
        std::vector<std::int32_t> found, wanted;
        for (std::size_t i = 0; i < truth.scan.size(); ++i) {
            if (parts.labels()[i] == gnomon::unlabeled) continue;
            found.push_back(parts.labels()[i]);
            wanted.push_back(truth.surfaces[i]);
        }
        segments.push_back(static_cast<double>(parts.size()));
        percent.push_back(100.0 * static_cast<double>(found.size()) /
                          static_cast<double>(truth.scan.size()));
        index.push_back(adjusted_rand_index(found, wanted));
    }

    [[nodiscard]] json row(const char* normals, const char* dissimilarity) const {
        return {{"normals from", normals},
                {"dissimilarity", dissimilarity},
                {"segments", median_of(segments)},
                {"in segments [%]", rounded(median_of(percent), 1)},
                {"adjusted Rand index", rounded(median_of(index), 3)},
                {"least", rounded(std::ranges::min(index), 3)}};
    }
};

json boxes(const effort& much) {
    const sim::scene world = sim::scenes::boxes_and_bin();
    const sim::horizontal sweep{
        .mount = world.sensor, .duration = 0.455, .sweep = gnomon::degrees(70)};
    json rows = json::array();
    const auto enter = [&](const char* name, const auto& neighborhood) {
        agreement joint, thresholds;
        for (unsigned seed = 1; seed <= much.seeds(); ++seed) {
            const sim::true_scan truth = sim::simulate(world, sweep, sim::scanners::sick_lms_400(),
                                                       {.sigma = 0.001, .seed = seed});
            auto surface = gnomon::estimate_normals(truth.scan, neighborhood, gnomon::plane_pca{});
            gnomon::orient_normals(truth.scan, surface);
            const gnomon::segments parts = gnomon::segment_oriented_points(
                truth.scan, surface, gnomon::joint_distance{}, {.greedy = true});
            joint.add(truth, parts);
            thresholds.add(truth, gnomon::segment_oriented_points(
                                      truth.scan, surface, gnomon::two_thresholds{.radius = 0.05}));
            if (rows.empty() && seed == 1)
                draw(truth.scan.points, normals_of(surface), parts, truth.scan.viewpoints[0],
                     much.out / "fig_4_2.png");
        }
        rows.push_back(joint.row(name, "r = 0.14 in six dimensions, greedy"));
        rows.push_back(thresholds.row(name, "5 cm and 5 degrees"));
    };
    enter("Delaunay stars", gnomon::delaunay{});
    enter("30 nearest", gnomon::knn{.k = 30});
    return rows;
}

/// Strips of 40 x 20 points, a centimetre apart, that go on at the height z(s) with the slope t(s).
json strips() {
    struct profile {
        const char* name;
        Eigen::Vector2d (*position)(double);
        double (*slope)(double);
        std::size_t in_the_thesis;
    };
    const auto level = [](double) { return 0.0; };
    const profile profiles[] = {
        {"corner of 90 degrees",
         [](double s) {
             return s < 0.195 ? Eigen::Vector2d(s, 0.0) : Eigen::Vector2d(0.19, s - 0.19);
         },
         [](double s) { return s < 0.195 ? 0.0 : 0.5 * std::numbers::pi; }, 2},
        {"step of 10 cm", [](double s) { return Eigen::Vector2d(s, s < 0.195 ? 0.0 : 0.1); }, level,
         2},
        {"bend of radius 25 cm",
         [](double s) {
             return Eigen::Vector2d(0.25 * std::sin(4.0 * s), 0.25 - 0.25 * std::cos(4.0 * s));
         },
         [](double s) { return 4.0 * s; }, 1}};
    json rows = json::array();
    for (const profile& p : profiles) {
        std::vector<Eigen::Vector3d> points;
        std::vector<gnomon::surfel<gnomon::normal_fit>> surface;
        for (int i = 0; i < 40; ++i) {
            for (int j = 0; j < 20; ++j) {
                const Eigen::Vector2d at = p.position(0.01 * i);
                const double t = p.slope(0.01 * i);
                points.emplace_back(at.x(), 0.01 * j, at.y());
                surface.emplace_back().normal = Eigen::Vector3d(-std::sin(t), 0.0, std::cos(t));
            }
        }
        rows.push_back({{"scene", p.name},
                        {"segments", gnomon::segment_oriented_points(
                                         points, surface, gnomon::two_thresholds{.radius = 0.05})
                                         .size()},
                        {"in the thesis", p.in_the_thesis}});
    }
    return rows;
}

}  // namespace

int main(int argc, char** argv) {
    return run_program(argc, argv, [](const effort& much) -> json {
        return {{"two boxes and a bin", boxes(much)}, {"by two thresholds", strips()}};
    });
}
