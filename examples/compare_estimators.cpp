// SPDX-License-Identifier: BSL-1.0
/// @file
/// Which estimator shall I take? Runs all of them on a scan whose true normals are known, and
/// compares quality, time and trust.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <boost/hana/for_each.hpp>

#include "common/output_directory.hpp"
#include "common/program.hpp"
#include "common/progress.hpp"
#include "compare_estimators/chart.hpp"
#include "compare_estimators/options.hpp"
#include "picture/picture.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/normals/registry.hpp>
#include <gnomon/simulation.hpp>

namespace sim = gnomon::simulation;

namespace {

struct scan_with_truth {
    gnomon::scan scan;
    std::vector<Eigen::Vector3d> normals;  ///< unit length; zero where none is known
};

scan_with_truth scan_of(const options& o) {
    if (o.scan.empty()) {
        const sim::scene world = sim::scenes::kitchen();
        auto truth =
            sim::simulate(world, sim::rotational{.mount = world.sensor}, sim::densities::medium(),
                          {.sigma = o.sigma, .seed = o.seed}, o.threads);
        return {std::move(truth.scan), std::move(truth.normals)};
    }
    scan_with_truth result{gnomon::io::read(o.scan, {"nx", "ny", "nz"}), {}};
    for (std::size_t i = 0; i < result.scan.size(); ++i) {
        Eigen::Vector3d n;
        for (int a = 0; a < 3; ++a)
            n[a] = result.scan.fields[static_cast<std::size_t>(a)].values[i];
        const double length = n.norm();
        result.normals.push_back(length > 0.5 && length < 2.0 ? Eigen::Vector3d(n / length)
                                                              : Eigen::Vector3d::Zero());
    }
    return result;
}

/// An estimator of the registry with the standard deviation of the noise, if it uses one.
template <class E>
E with_noise(E estimate, double sigma) {
    if constexpr (requires { estimate.noise; }) estimate.noise = gnomon::constant_noise{sigma};
    if constexpr (requires { estimate.sigma; }) estimate.sigma = sigma;
    return estimate;
}

template <class E>
row compared(const char* name, const E& estimate, const scan_with_truth& data,
             const gnomon::adjacency& graph, const options& o) {
    const progress shown(name);
    double seconds = 1e9;
    std::vector<gnomon::surfel<gnomon::estimate_t<E>>> surface;
    for (int run = 0; run < 3 && (run == 0 || seconds < 0.5); ++run) {  // the least disturbed
        const stopwatch watch;
        surface = gnomon::estimate_normals(data.scan, graph, estimate, o.threads);
        seconds = std::min(seconds, watch.seconds());
    }
    const gnomon::normal_quality q = gnomon::normal_quality::of(surface, data.normals);
    std::array<double, 3> trust{};
    for (const auto& s : surface) {
        const std::size_t kind =
            s.trust == gnomon::trust::good ? 0 : (gnomon::usable(s.trust) ? 1 : 2);
        trust[kind] += 1.0 / static_cast<double>(surface.size());
    }
    return {name,
            q.gamma,
            q.median.degrees(),
            q.p90.degrees(),
            q.rms.degrees(),
            1e6 * seconds / static_cast<double>(surface.size()),
            trust};
}

void compare_estimators(const options& o) {
    const scan_with_truth data = scan_of(o);
    const std::size_t known =
        data.normals.size() - static_cast<std::size_t>(std::count_if(
                                  data.normals.begin(), data.normals.end(), gnomon::is_missing));
    if (known == 0) throw gnomon::error(o.scan, "", "has no true normals in nx, ny, nz");
    const output_directory out(o.out, {"estimators.png"});

    const stopwatch watch;
    const gnomon::adjacency graph = o.delaunay ? gnomon::delaunay{}(data.scan, o.threads)
                                               : gnomon::knn{.k = o.k}(data.scan, o.threads);
    const double search = 1e6 * watch.seconds() / static_cast<double>(data.scan.size());
    const std::string title = picture::counted(data.scan.size(), "point") + ", " +
                              (o.delaunay ? "Delaunay stars" : "k = " + std::to_string(o.k)) +
                              ", sigma " + chart::number("%g", 1e3 * o.sigma) + " mm";
    std::printf("%s; the search took %.2f us per point\n\n", title.c_str(), search);
    std::printf("%-28s %7s %8s %8s %8s %9s  %5s %5s %5s\n", "", "gamma", "median", "90 %", "rms",
                "us/normal", "good", "weak", "none");

    std::vector<row> rows;
    boost::hana::for_each(gnomon::estimators, [&](const auto& e) {
        const row r = compared(e.name, with_noise(e.policy, o.sigma), data, graph, o);
        std::printf(
            "%-28s %7.4f %7.2f\u00b0 %7.2f\u00b0 %7.2f\u00b0 %9.2f %5.1f%% %4.1f%% %4.1f%%\n",
            r.name.c_str(), r.gamma, r.median, r.p90, r.rms, r.microseconds, 100.0 * r.trust[0],
            100.0 * r.trust[1], 100.0 * r.trust[2]);
        std::fflush(stdout);
        rows.push_back(r);
    });

    const std::string drawing = chart_of(rows, title).png();
    gnomon::io::replace_file(out / "estimators.png", drawing);
    out.report();
}

}  // namespace

int main(int argc, char** argv) {
    return run_program("compare_estimators", usage, options_from, compare_estimators, argc, argv);
}
