// SPDX-License-Identifier: BSL-1.0
// The covariances of normals on whole scans, each estimator with its own neighborhood, at points
// whose neighbors truly lie on one plane; and the errors of normals at all points. The neighbors
// are chosen by noisy positions, as those of a user are.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "../chapter4/record.hpp"
#include "furnished.hpp"
#include "known_scan.hpp"

namespace {

/// What is counted of the normals of one estimator in one setting.
struct tally {
    std::size_t points = 0, usable = 0, good = 0, covered = 0, wrong = 0;
    double nees = 0.0;  // the sum over good normals

    template <class Belief>
    void add(const Belief& belief, const Eigen::Vector3d& truth) {
        constexpr double most = 1e6;           // a singular covariance counts as that
        constexpr double ninety_five = 5.991;  // % of chi-square with 2 degrees are below
        ++points;
        if (!gnomon::usable(belief.trust)) return;
        ++usable;
        if (belief.trust != gnomon::trust::good) return;
        ++good;
        const double squared = gnomon::nees(belief, truth);
        nees += std::min(squared, most);
        covered += squared < ninety_five ? 1 : 0;
        wrong += std::abs(belief.normal.dot(truth)) < std::cos(40.0 / degrees_of_radian) ? 1 : 0;
    }
};

constexpr std::array estimators{"with_covariance<plane_pca> on knn", "plane_ekf on ray_knn",
                                "plane_ukf on ray_knn", "plane_eif on ray_knn"};
constexpr std::array<std::size_t, 3> sizes{10, 20, 50};

/// One line of the results: an estimator in a setting.
struct line {
    std::string scene, estimator;
    double noise;
    std::size_t k;
    bool given;
    tally counts;
    double error = 0.0, of_knn = 0.0;  ///< RMS of plane_eif and of plane_pca at all points

    [[nodiscard]] bool counts_as_setting() const { return 2 * counts.good >= counts.points; }
    [[nodiscard]] double nees() const {
        return counts.nees / static_cast<double>(std::max<std::size_t>(1, counts.good));
    }
    [[nodiscard]] double covered() const { return share(counts.covered, counts.good); }
    [[nodiscard]] double wrong() const { return share(counts.wrong, counts.good); }
    [[nodiscard]] double weak() const { return share(counts.usable - counts.good, counts.usable); }
    [[nodiscard]] bool is_outside() const {
        return !(nees() >= 1.75 && nees() <= 2.4 && covered() >= 92.0 && covered() <= 97.0);
    }

  private:
    [[nodiscard]] static double share(std::size_t part, std::size_t of) {
        return of > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(of) : 0.0;
    }
};

/// All estimators on a scan, at some of its points in random order: of those whose neighbors are
/// on one plane as many as `wanted`.
void measure_into(std::vector<line>& lines, const known_scan& s, std::size_t k, bool given,
                  std::size_t wanted) {
    const gnomon::spatial_index index(s.scan);
    gnomon::noise_curve noise = gnomon::constant_noise{1e-3 * s.noise};
    if (!given) {
        const auto found = gnomon::measure_noise(index);
        if (!found.curve) return;
        noise = *found.curve;
    }
    const gnomon::knn in_space{.k = k};
    const gnomon::ray_knn along_rays{.k = k, .noise = noise};
    const gnomon::with_covariance<gnomon::plane_pca> pca{.noise = noise};
    const gnomon::plane_ekf ekf{.noise = noise};
    const gnomon::plane_ukf ukf{.noise = noise};
    const gnomon::plane_eif eif{.noise = noise};

    std::vector<std::size_t> order(s.scan.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    gnomon::random_stream random(s.scan.size());
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);

    std::array<tally, estimators.size()> tallies;
    std::array<double, 2> squares{};  // of the errors of plane_eif and plane_pca
    std::size_t all = 0;
    std::vector<gnomon::neighbor> found;
    std::vector<Eigen::Vector3d> around;
    const auto gathered = [&](const auto& policy, std::size_t i) {
        policy.find(index, i, found);
        around.clear();
        bool flat = true;
        for (const auto& q : found) {
            around.push_back(s.scan.points[q.index]);
            flat = flat && s.on_one_plane(i, q.index);
        }
        return flat;
    };
    const auto squared_error = [&](const auto& belief, std::size_t i) {
        if (!gnomon::usable(belief.trust)) return 1.0;  // rad^2
        const double angle = gnomon::unoriented_angle(belief.normal, s.normals[i]).radians();
        return angle * angle;
    };
    for (const std::size_t i : order) {
        if (std::min(tallies[0].points, tallies[1].points) >= wanted) break;
        if (!gnomon::is_finite(s.scan.points[i]) || !(s.normals[i].squaredNorm() > 0.5)) continue;
        const Eigen::Vector3d& p = s.scan.points[i];
        const Eigen::Vector3d v = s.scan.viewpoints[i];
        ++all;
        const bool flat_in_space = gathered(in_space, i);
        const auto by_pca = pca(p, around, v);
        squares[1] += squared_error(by_pca, i);
        if (flat_in_space) tallies[0].add(by_pca, s.normals[i]);
        const bool flat_along_rays = gathered(along_rays, i);
        const auto by_eif = eif(p, around, v);
        squares[0] += squared_error(by_eif, i);
        if (!flat_along_rays) continue;
        tallies[1].add(ekf(p, around, v), s.normals[i]);
        tallies[2].add(ukf(p, around, v), s.normals[i]);
        tallies[3].add(by_eif, s.normals[i]);
    }
    const auto rms = [&](double sum) {
        return degrees_of_radian *
               std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, all)));
    };
    for (std::size_t e = 0; e < estimators.size(); ++e)
        lines.push_back({s.scene, estimators[e], s.noise, k, given, tallies[e], rms(squares[0]),
                         rms(squares[1])});
}

json row_of(const line& l) {
    return {{"scene", l.scene},
            {"noise [mm]", l.noise},
            {"k", l.k},
            {"noise", l.given ? "given" : "measured"},
            {"estimator", l.estimator},
            {"points", l.counts.points},
            {"weak [%]", rounded(l.weak(), 2)},
            {"NEES", rounded(l.nees(), 3)},
            {"in 95 % regions [%]", rounded(l.covered(), 2)},
            {"off by 40 degrees [%]", rounded(l.wrong(), 3)}};
}

/// One row for all settings that have enough good normals.
json summary_of(json row, const std::vector<const line*>& lines) {
    std::size_t settings = 0, outside = 0;
    double least = std::numeric_limits<double>::infinity(), most = 0.0;
    double fewest = 100.0, largest = 0.0, wrong = 0.0, most_wrong = 0.0, weak = 0.0;
    for (const line* l : lines) {
        weak += l->weak() / static_cast<double>(lines.size());
        if (!l->counts_as_setting()) continue;
        ++settings;
        outside += l->is_outside() ? 1 : 0;
        least = std::min(least, l->nees());
        most = std::max(most, l->nees());
        fewest = std::min(fewest, l->covered());
        largest = std::max(largest, l->covered());
        wrong += l->wrong();
        most_wrong = std::max(most_wrong, l->wrong());
    }
    row.update(
        {{"settings", lines.size()}, {"half good", settings}, {"weak [%]", rounded(weak, 1)}});
    if (settings == 0) return row;
    row.update({{"NEES", std::to_string(rounded(least, 2)).substr(0, 4) + " to " +
                             std::to_string(rounded(most, 2)).substr(0, 4)},
                {"in 95 % regions [%]", std::to_string(rounded(fewest, 1)).substr(0, 4) + " to " +
                                            std::to_string(rounded(largest, 1)).substr(0, 4)},
                {"settings outside", outside},
                {"off by 40 degrees [%]", rounded(wrong / static_cast<double>(settings), 3)},
                {"at most [%]", rounded(most_wrong, 3)}});
    return row;
}

/// The least time of some calls [s].
double least_time(bool quick, auto&& call) {
    double least = std::numeric_limits<double>::infinity();
    for (int pass = 0; pass < (quick ? 1 : 7); ++pass) {
        const auto start = std::chrono::steady_clock::now();
        call();
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
        least = std::min(least, taken.count());
    }
    return least;
}

/// Errors and times of normals. The time of a neighborhood is that with `plane_pca`, whose fit
/// takes next to none.
void add_normals_of(const known_scan& s, bool quick, json& rows) {
    const gnomon::spatial_index index(s.scan);
    const gnomon::noise_curve noise = *gnomon::measure_noise(index).curve;
    const auto timed = [&](const auto& neighborhood, const auto& estimator) {
        const double seconds = least_time(
            quick, [&] { (void)gnomon::estimate_normals(index, neighborhood, estimator); });
        return 1e6 * seconds / static_cast<double>(index.size());
    };
    const gnomon::plane_pca pca;
    const double unit = timed(gnomon::knn{.k = 30}, pca);
    const auto errors_of = [&](const char* name, const auto& surface) {
        std::vector<double> errors;  // [degrees]
        double squares = 0.0;
        for (std::size_t i = 0; i < surface.size(); ++i) {
            if (!(s.normals[i].squaredNorm() > 0.5)) continue;
            errors.push_back(
                gnomon::usable(surface[i].trust)
                    ? gnomon::unoriented_angle(surface[i].normal, s.normals[i]).degrees()
                    : 90.0);
            squares += errors.back() * errors.back();
        }
        const double rms = std::sqrt(squares / static_cast<double>(errors.size()));
        return json{{"scan", s.scene},
                    {"method", name},
                    {"median [deg]", rounded(median_of(errors), 2)},
                    {"RMS [deg]", rounded(rms, 2)}};
    };
    const auto add = [&](const char* name, const auto& neighborhood, const auto& estimator) {
        json row = errors_of(name, gnomon::estimate_normals(index, neighborhood, estimator));
        const double found = timed(neighborhood, pca), all = timed(neighborhood, estimator);
        row.update({{"neighborhood [us]", rounded(found, 2)},
                    {"fit [us]", rounded(std::max(0.0, all - found), 2)},
                    {"neighborhood / knn", rounded(found / unit, 1)},
                    {"fit / knn", rounded(std::max(0.0, all - found) / unit, 1)}});
        rows.push_back(row);
    };
    const gnomon::ray_knn along_rays{.k = 30, .noise = noise};
    add("plane_pca on knn", gnomon::knn{.k = 30}, pca);
    add("plane_eif on ray_knn", along_rays, gnomon::plane_eif{.noise = noise});
    const gnomon::robust_ray_ls robust{.noise = noise};
    add("robust_ray_ls on ray_knn", along_rays, robust);
    rows.push_back(
        errors_of("the same, wanted_precision of 1.5 degrees",
                  gnomon::estimate_normals(index, along_rays, robust,
                                           gnomon::wanted_precision{gnomon::degrees(1.5)})));
}

json measure(const effort& much) {
    json normals = json::array();  // first, while no other thread runs
    add_normals_of(kitchen(15.0), much.quick, normals);
    for (const bool own_car : {false, true}) add_normals_of(street(own_car), much.quick, normals);

    std::vector<known_scan> scans;
    const std::uint64_t first = 10'001, rooms = much.quick ? 1 : 10, convex = much.quick ? 1 : 3;
    for (const double noise : noises) {
        if (!much.quick) scans.push_back(kitchen(noise));
        for (std::uint64_t r = 0; r < rooms; ++r) scans.push_back(room(noise, first + r));
        for (std::uint64_t c = 0; c < convex; ++c) scans.push_back(convex_room(noise, first + c));
    }
    for (std::uint64_t c = 0; c < (much.quick ? 1 : 5); ++c) scans.push_back(image(first + c));
    const std::size_t wanted = much.quick ? 500 : 10'000;
    std::vector<std::vector<line>> of_scan(scans.size());
    gnomon::threads{}(scans.size(), [&](std::size_t s) {
        for (const std::size_t k : sizes)
            for (const bool given : {true, false})
                if (!given || scans[s].noise > 0.0)
                    measure_into(of_scan[s], scans[s], k, given, wanted);
    });

    json all = json::array(), summary = json::array(), cameras = json::array(),
         errors = json::array();
    std::vector<const line*> lines;
    for (const auto& of : of_scan)
        for (const line& l : of) {
            lines.push_back(&l);
            all.push_back(row_of(l));
        }
    const auto those = [&](auto&& wanted_of) {
        std::vector<const line*> some;
        std::ranges::copy_if(lines, std::back_inserter(some), wanted_of);
        return some;
    };
    for (const std::string estimator : estimators) {
        for (const double noise : noises)
            for (const bool given : {true, false}) {
                const auto some = those([&](const line* l) {
                    return l->estimator == estimator && l->noise == noise && l->given == given;
                });
                summary.push_back(summary_of({{"estimator", estimator},
                                              {"noise [mm]", noise},
                                              {"noise", given ? "given" : "measured"}},
                                             some));
            }
        cameras.push_back(summary_of({{"estimator", estimator}}, those([&](const line* l) {
                                         return l->estimator == estimator && l->noise == 0.0;
                                     })));
    }
    for (const double noise : noises)
        for (const std::size_t k : sizes) {
            double eif = 0.0, pca = 0.0;
            const auto some = those([&](const line* l) {
                return l->estimator == estimators[3] && l->noise == noise && l->k == k &&
                       !l->given && l->scene.starts_with("room");
            });
            for (const line* l : some) eif += l->error * l->error, pca += l->of_knn * l->of_knn;
            const auto n = static_cast<double>(std::max<std::size_t>(1, some.size()));
            errors.push_back({{"noise [mm]", noise},
                              {"k", k},
                              {"plane_eif on ray_knn [deg]", rounded(std::sqrt(eif / n), 2)},
                              {"plane_pca on knn [deg]", rounded(std::sqrt(pca / n), 2)},
                              {"ratio", rounded(std::sqrt(eif / pca), 3)}});
        }
    for (const json& table : {summary, cameras, errors, normals})
        for (const json& row : table) std::printf("%s\n", row.dump().c_str());
    return {{"range finders", summary},
            {"depth cameras", cameras},
            {"errors at all points of rooms", errors},
            {"normals", normals},
            {"settings", all}};
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, measure); }
