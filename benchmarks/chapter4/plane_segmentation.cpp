// SPDX-License-Identifier: BSL-1.0
// How well planes and smooth parts are found: our segmentations beside those of PCL and CGAL, on
// scans with labels by others and on simulated ones, by Hoover's measures (hoover.hpp). Every
// method runs with its defaults and with all settings of a small grid, made of the same numbers for
// all (plane_methods.hpp); of the grid, the setting with the most correct regions is told.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hoover.hpp"
#include "plane_methods.hpp"
#include "plane_scans.hpp"

namespace {

using planes::cloud;

/// Of Hoover et al. 1996, and 95 %.
constexpr std::array<double, 6> tolerances{0.51, 0.6, 0.7, 0.8, 0.9, 0.95};
constexpr std::size_t eighty = 3;

/// What a setting of a method made of a cloud.
struct score {
    std::string setting;
    std::array<hoover::counts, tolerances.size()> at;
};

score score_of(const cloud& scene, const planes::setting& how) {
    const planes::labels found = how.segment(scene);
    const hoover::overlaps overlaps(scene.truth, found);
    score s{how.name, {}};
    for (std::size_t t = 0; t < tolerances.size(); ++t) s.at[t] = overlaps.at(tolerances[t]);
    return s;
}

/// More correct regions, or as many and fewer segments besides.
bool is_better(const score& a, const score& b) {
    const auto &x = a.at[eighty], &y = b.at[eighty];
    return x.correct != y.correct ? x.correct > y.correct : x.f() > y.f();
}

/// What has to be known of all runs.
struct table {
    std::string rows;  ///< of JSON

    void add(const cloud& scene, const std::string& method, const char* which, const score& s) {
        const hoover::counts& c = s.at[eighty];
        std::printf("%-34s %-24s %-9s %3zu/%-3zu %.3f %5zu %5zu %6zu %5zu  %.3f  %s\n",
                    scene.name.c_str(), method.c_str(), which, c.correct, c.regions,
                    c.correct_fraction(), c.over, c.under, c.missed, c.noise, c.f(),
                    s.setting.c_str());
        std::fflush(stdout);
        rows += rows.empty() ? "\n" : ",\n";
        rows += R"(  {"name": "plane_segmentation/cloud:)" + scene.name + "/method:" + method +
                "/setting:" + which + R"(", "parameters": ")" + s.setting + '"';
        number("points", static_cast<double>(scene.points.size()));
        number("noise", scene.noise);
        number("spacing", scene.spacing);
        number("regions", static_cast<double>(c.regions));
        number("segments", static_cast<double>(c.segments));
        for (std::size_t t = 0; t < tolerances.size(); ++t) {
            const hoover::counts& k = s.at[t];
            const std::string at =
                "_" + std::to_string(static_cast<int>(100 * tolerances[t] + 0.5));
            number("correct_fraction" + at, k.correct_fraction());
            number("f" + at, k.f());
            for (const auto& [name, count] :
                 {std::pair("correct", k.correct), std::pair("over", k.over),
                  std::pair("under", k.under), std::pair("missed", k.missed),
                  std::pair("noise", k.noise)})
                number(std::string(name) + at, static_cast<double>(count));
        }
        rows += "}";
    }

  private:
    void number(const std::string& name, double value) {
        char text[40];
        std::snprintf(text, sizeof text, "%.6g", value);
        rows += ", \"" + name + "\": " + text;
    }
};

std::vector<planes::method> all_methods() {
    std::vector<planes::method> all = planes::gnomon_methods();
    const auto add = [&all](std::vector<planes::method> more) {
        all.insert(all.end(), more.begin(), more.end());
    };
#ifdef PLANES_PCL
    add(planes::pcl_methods());
#endif
#ifdef PLANES_CGAL
    add(planes::cgal_methods());
#endif
    (void)add;
    return all;
}

/// A scan is made when its turn comes.
using source = std::function<cloud()>;

std::vector<source> all_scans(bool quick) {
    std::vector<source> scans;
    const auto add_file = [&scans](const std::string& name, const std::string& file,
                                   const std::string& field, double first_label) {
        const std::string path = std::string(PLANES_DATA) + "/segmentation_truth/" + file;
        if (!std::filesystem::exists(path)) {
            std::printf("%s is not there: left out\n", file.c_str());
            return;
        }
        scans.push_back([=] { return planes::read_labelled(name, path, field, first_label); });
    };
    add_file("synpeb_test_100", "synpeb_test_100.pcd", "intensity", 10);
    if (!quick) add_file("tum_office_room1", "tum_office_room1_parts.pcd", "label", 1);
    const std::uint64_t seeds = quick ? 1 : 3;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        scans.push_back([=] { return planes::blocks(seed, 100, 0.001); });
        if (!quick) scans.push_back([=] { return planes::blocks(seed + 10, 200, 0.005); });
    }
    for (std::uint64_t seed = 1; seed <= seeds && !quick; ++seed)
        scans.push_back([=] { return planes::furniture(seed, 0.003); });
    return scans;
}

/// Hoover's counts of segmentations that can be judged by hand.
bool hoover_is_right() {
    bool right = true;
    const auto expect = [&right](const char* what, const hoover::counts& is,
                                 const hoover::counts& wanted) {
        if (is == wanted) return;
        std::printf("wrong: %s\n", what);
        right = false;
    };
    const auto judged = [](const planes::labels& truth, const planes::labels& found, double t) {
        return hoover::overlaps(truth, found).at(t);
    };
    const planes::labels truth{0, 0, 0, 0, 0, 1, 1, 1, 1, 1};
    expect("itself", judged(truth, truth, 0.95), {.regions = 2, .segments = 2, .correct = 2});
    expect("other numbers", judged(truth, {4, 4, 4, 4, 4, 2, 2, 2, 2, 2}, 0.95),
           {.regions = 2, .segments = 2, .correct = 2});
    expect("a piece is lost", judged(truth, {0, 0, 0, 0, -1, 1, 1, 1, 1, 1}, 0.8),
           {.regions = 2, .segments = 2, .correct = 2});
    expect("a piece is lost, strictly", judged(truth, {0, 0, 0, 0, -1, 1, 1, 1, 1, 1}, 0.9),
           {.regions = 2, .segments = 2, .correct = 1, .missed = 1, .noise = 1});
    expect("cut in two", judged(truth, {0, 0, 0, 2, 2, 1, 1, 1, 1, 1}, 0.8),
           {.regions = 2, .segments = 3, .correct = 1, .over = 1});
    expect("run together", judged(truth, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 0.8),
           {.regions = 2, .segments = 1, .under = 1});
    expect("nothing found", judged(truth, planes::labels(10, -1), 0.8),
           {.regions = 2, .missed = 2});
    expect("half of each", judged(truth, {0, 0, -1, -1, -1, -1, -1, -1, 0, 0}, 0.8),
           {.regions = 2, .segments = 1, .missed = 2, .noise = 1});
    expect("on the background", judged({0, 0, 0, -1, -1, -1}, {0, 0, 0, 1, 1, 1}, 0.8),
           {.regions = 1, .segments = 1, .correct = 1});
    expect("into the background", judged({0, 0, 0, -1, -1, -1}, {0, 0, 0, 0, 0, 0}, 0.8),
           {.regions = 1, .segments = 1, .missed = 1, .noise = 1});
    return right;
}

int usage(const char* program) {
    std::fprintf(
        stderr,
        "usage: %s [--quick] [--self-test] [--benchmark_out=FILE] "
        "[--scan FILE FIELD FIRST_LABEL]...\n"
        "  --scan  a labelled scan instead of those known; smaller labels are background\n",
        program);
    return 2;
}

}  // namespace

int main(int argc, char** argv) try {
    bool quick = false;
    std::string out;
    std::vector<source> own;
    for (int i = 1; i < argc; ++i) {
        const std::string_view word = argv[i];
        constexpr std::string_view to = "--benchmark_out=";
        if (word == "--quick") {
            quick = true;
        } else if (word == "--self-test") {
            return hoover_is_right() ? 0 : 1;
        } else if (word.starts_with(to)) {
            out = word.substr(to.size());
        } else if (word == "--benchmark_out_format=json") {
            // There is no other.
        } else if (word == "--scan" && i + 3 < argc) {
            const std::string path = argv[i + 1], field = argv[i + 2];
            const double first = std::atof(argv[i + 3]);
            own.push_back([=] {
                return planes::read_labelled(std::filesystem::path(path).stem().string(), path,
                                             field, first);
            });
            i += 3;
        } else {
            return usage(argv[0]);
        }
    }
    if (!hoover_is_right()) return 1;

    std::printf("%-34s %-24s %-9s %-13s %5s %5s %6s %5s  %-5s\n", "scan", "method", "setting",
                "correct, 80 %", "over", "under", "missed", "noise", "F");
    table results;
    const std::vector<planes::method> methods = all_methods();
    for (const source& make : own.empty() ? all_scans(quick) : own) {
        const cloud scene = make();
        for (const planes::method& m : methods) {
            std::optional<score> best, best_f;
            for (const planes::setting& how : m.settings) {
                const score s = score_of(scene, how);
                if (!best) results.add(scene, m.name, "defaults", s);
                if (!best || is_better(s, *best)) best = s;
                if (!best_f || s.at[eighty].f() > best_f->at[eighty].f()) best_f = s;
            }
            results.add(scene, m.name, "best", *best);
            results.add(scene, m.name, "best F", *best_f);
        }
    }
    if (!out.empty()) {
        std::ofstream file(out);
        file << R"({"context": {"quick": ")" << (quick ? "true" : "false")
             << "\"},\n \"benchmarks\": [" << results.rows << "\n]}\n";
        if (!file.flush()) throw std::runtime_error("cannot write " + out);
    }
    return 0;
} catch (const std::exception& problem) {
    std::fprintf(stderr, "%s: %s\n", argv[0], problem.what());
    return 1;
}
