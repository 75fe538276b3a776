// SPDX-License-Identifier: BSL-1.0
/// @file
/// Errors of normals on shapes with known normals: twelve shapes, six kinds of noise and density,
/// all estimators, CGAL's jets and PCL. The error is the root mean square of the unoriented angle
/// at the first 5,000 of 100,000 points; a missing normal counts as 90 degrees.
///
/// Estimators have the parameters of the registry and the k nearest neighbors, with the single k
/// that is best over all columns; averaging methods receive them in angular order; estimators that
/// use a view point have one far outside of the shape. `feature_preserving` has its defaults.
///     known_normals [--quick] [--meshes FOLDER]

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <boost/hana/for_each.hpp>

#include "known_normals/columns.hpp"
#include "known_normals/neighborhoods.hpp"
#include "known_normals/report.hpp"
#include "known_normals/shapes.hpp"
#ifdef GNOMON_BENCHMARKS_CGAL
#include "known_normals/jet.hpp"
#endif
#ifdef GNOMON_BENCHMARKS_PCL
#include "known_normals/pcl.hpp"
#endif
#include "../../examples/common/help.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/normals/registry.hpp>

namespace {

using namespace known_normals;

constexpr const char* ours = "feature_preserving";
const std::vector<std::string> rivals{"plane_pca", "CGAL jet"};

/// How much is measured.
struct plan {
    std::size_t points = 100'000;
    std::size_t tests = 5'000;
    std::vector<std::size_t> ks{8, 12, 16, 24, 32, 48, 64, 96, 128, 192};  ///< of rivals and PCL
    std::vector<std::size_t> ks_of_others{16, 32, 64, 128};
    std::string meshes = "../shared/data/normals_truth";
    bool quick = false;
};

constexpr const char* arguments = " [--quick] [--meshes FOLDER]";
constexpr const char* details =
    "Prints the errors of normals of shapes whose normals are known.\n"
    "  --quick          four shapes of fewer points, few k\n"
    "  --meshes FOLDER  with octagonal_pocket.stl, featuretype.stl and wingnut.obj;\n"
    "                   the default is ../shared/data/normals_truth";

/// The time of `work` [s].
double time_of(auto&& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Every method, with every k, on a cloud.
void measure(cloud_report& report, const cloud& data, const plan& p) {
    std::vector<measurement>& result = report.measured;
    const std::span truth = std::span(data.normals).first(p.tests);
    const auto enter = [&](const char* method, std::size_t k, const auto& surface) {
        const auto q = gnomon::normal_quality::of(std::span(surface).first(p.tests), truth);
        result.push_back({method, k, q.rms.degrees(), 1.0 - q.usable});
    };
    const nearest_of_tests nearest(data.points, p.tests, p.ks.back());

    const auto seen = gnomon::with_viewpoint(
        data.points, data.center + 5.0 * data.diagonal * Vector3d(1, 2, 3).normalized());
    std::vector<gnomon::adjacency> fans;
    for (const std::size_t k : p.ks_of_others)
        fans.push_back(gnomon::detail::sort_angularly(data.points, first_k{&nearest, k}));

    boost::hana::for_each(gnomon::estimators, [&](const auto& e) {
        using model = std::remove_cvref_t<decltype(e.policy)>;
        if constexpr (gnomon::cyclic_estimator<model>) {
            for (std::size_t i = 0; i < fans.size(); ++i)
                enter(e.name, p.ks_of_others[i], gnomon::estimate_normals(seen, fans[i], e.policy));
        } else {
            for (const std::size_t k :
                 std::is_same_v<model, gnomon::plane_pca> ? p.ks : p.ks_of_others)
                enter(e.name, k, gnomon::estimate_normals(seen, first_k{&nearest, k}, e.policy));
        }
    });
#ifdef GNOMON_BENCHMARKS_CGAL
    for (const std::size_t k : p.ks) enter("CGAL jet", k, jets(data.points, nearest, k));
#endif
#ifdef GNOMON_BENCHMARKS_PCL
    for (const std::size_t k : p.ks) enter("PCL", k, pcl_planes(data.points, nearest, k));
#endif
    std::vector<gnomon::surfel<gnomon::plane_fit>> surface;
    const double time = time_of(
        [&] { surface = gnomon::estimate_normals(data.points, gnomon::feature_preserving{}); });
    enter(ours, 0, surface);
    report.time_ratio =
        time / time_of([&] {
            (void)gnomon::estimate_normals(data.points, gnomon::knn{.k = 30}(data.points),
                                           gnomon::plane_pca{});
        });
}

/// All clouds, by shape and then by column.
std::vector<cloud_report> reports_of(const std::vector<shape>& shapes, const plan& p) {
    std::vector<cloud_report> reports;
    for (const shape& s : shapes) {
        for (std::size_t c = 0; s.boundary && c < columns.size(); ++c)
            reports.push_back({&s, c, {}, 0.0});
    }
    std::atomic<int> done{0};
    gnomon::threads{}(reports.size(), [&](std::size_t i) {
        cloud_report& r = reports[i];
        const column& c = columns[r.column];
        measure(r, make_cloud(*r.of->boundary, c, p.points, r.of->seed), p);
        std::fprintf(stderr, "%d of %zu clouds: %s, %s\n", ++done, reports.size(), r.of->name,
                     c.name);
    });
    return reports;
}

/// Prints the results of the other libraries.
/// @throws std::runtime_error  if the jets are not those of CGAL::jet_estimate_normals()
void print_others([[maybe_unused]] const shape& s, [[maybe_unused]] const plan& p) {
#ifdef GNOMON_BENCHMARKS_CGAL
    const std::size_t k = p.ks[p.ks.size() / 2];
    const cloud data = make_cloud(*s.boundary, columns[2], p.tests, s.seed);
    const double deviation = largest_deviation_of_jets(data.points, k);
    std::printf("\nCGAL jet: within %.1g rad of jet_estimate_normals() on %zu points, k = %zu\n",
                deviation, p.tests, k);
    if (!(deviation < 1e-9)) throw std::runtime_error("these are not the jets of CGAL");
#else
    std::printf("\nCGAL jet: not measured, as CGAL was not found when this was built\n");
#endif
#ifndef GNOMON_BENCHMARKS_PCL
    std::printf("\nPCL: not measured, as it was not found when this was built\n");
#endif
}

void run(const plan& p) {
    std::vector<shape> shapes;
    std::array<int, 3> taken{};  // of each part
    for (const shape& s : all_shapes(p.meshes)) {
        if (!p.quick || taken[static_cast<std::size_t>(s.of_list)]++ < 2) shapes.push_back(s);
    }
    const std::vector<cloud_report> reports = reports_of(shapes, p);
    std::vector<const cloud_report*> all, smooth;
    std::array<std::vector<const cloud_report*>, 2> half;
    for (const cloud_report& r : reports) {
        if (r.of->of_list == part::smooth) {
            if (columns[r.column].noise == 0.0) smooth.push_back(&r);
            continue;
        }
        all.push_back(&r);
        half[r.of->of_list == part::held_out ? 1 : 0].push_back(&r);
    }

    std::printf(
        "RMSE [degrees] at %zu of %zu points per cloud; each method with the k, the same\n"
        "for all columns, that is best on average over the shapes of the table.\n",
        p.tests, p.points);
    for (const shape& s : shapes) {
        if (!s.boundary)
            std::printf("\n%s: not measured, as %s could not be read\n", s.name, p.meshes.c_str());
    }
    print_others(shapes.front(), p);
    print_methods("tuning half", half[0], ours, rivals);
    print_methods("held-out half", half[1], ours, rivals);
    print_methods("all shapes", all, ours, rivals);
    for (const std::string& rival : rivals) print_choice_of_k(all, rival);
    for (const std::string& rival : rivals) print_duel(all, ours, rival);
    std::printf("\n");
    for (const std::string& rival : rivals) {
        print_own_k("all shapes", all, ours, rival);
        print_own_k("held-out half", half[1], ours, rival);
        print_own_k("smooth shapes without noise", smooth, ours, rival);
    }
    print_times(all, ours);
}

/// @throws std::invalid_argument  for a word that makes no sense
plan plan_of(const std::vector<std::string>& words) {
    plan p;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (words[i] == "--quick") {
            p.quick = true;
            p.points = 20'000;
            p.tests = 500;
            p.ks = {16, 48, 128};
            p.ks_of_others = {32};
        } else if (words[i] == "--meshes" && i + 1 < words.size()) {
            p.meshes = words[++i];
        } else {
            throw std::invalid_argument(words[i]);
        }
    }
    return p;
}

}  // namespace

int main(int argc, char** argv) {
    if (printed_help(argc, argv, details, arguments)) return 0;
    plan p;
    try {
        p = plan_of({argv + 1, argv + argc});
    } catch (const std::invalid_argument& problem) {
        std::fprintf(stderr, "known_normals: cannot understand '%s'\n%s%s\n", problem.what(),
                     usage_of(argv[0], arguments).c_str(), details);
        return 2;
    }
    try {
        run(p);
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "known_normals: %s\n", problem.what());
        return 1;
    }
    return 0;
}
