// SPDX-License-Identifier: BSL-1.0
// Segmentation into planes and smooth parts: gnomon, PCL and CGAL on public labeled scans and on
// simulated ones, by Hoover's measures (hoover.hpp). Every method runs with its defaults and with
// all settings of a small grid of values that is the same for all (plane_methods.hpp); of the grid,
// the setting with the most correct regions is reported.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hoover.hpp"
#include "plane_methods.hpp"
#include "plane_scans.hpp"
#include "record.hpp"
#include <gnomon/core/execution.hpp>

namespace {

using planes::cloud;

/// Of Hoover et al. 1996, and 95 %.
constexpr std::array<double, 6> tolerances{0.51, 0.6, 0.7, 0.8, 0.9, 0.95};
constexpr std::size_t eighty = 3;

/// The score of a setting of a method on a cloud.
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

/// Whether a has more correct regions, or as many and a better F.
bool is_better(const score& a, const score& b) {
    const auto &x = a.at[eighty], &y = b.at[eighty];
    return x.correct != y.correct ? x.correct > y.correct : x.f() > y.f();
}

/// The tables of all runs.
struct report {
    json counts = json::array(), by_tolerance = json::array(), scans = json::array();

    void add(const cloud& scene) {
        scans.push_back({{"scan", scene.name},
                         {"points", scene.points.size()},
                         {"noise [mm]", rounded(1e3 * scene.noise, 2)},
                         {"spacing [mm]", rounded(1e3 * scene.spacing, 2)}});
    }
    void add(const cloud& scene, const std::string& method, const char* which, const score& s) {
        const hoover::counts& c = s.at[eighty];
        counts.push_back({{"scan", scene.name},
                          {"method", method},
                          {"setting", which},
                          {"regions", c.regions},
                          {"correct", c.correct},
                          {"over", c.over},
                          {"under", c.under},
                          {"missed", c.missed},
                          {"noise", c.noise},
                          {"F", rounded(c.f(), 3)},
                          {"which", s.setting}});
        json row{{"scan", scene.name}, {"method", method}, {"setting", which}};
        for (std::size_t t = 0; t < tolerances.size(); ++t) {
            char head[16];
            std::snprintf(head, sizeof head, "%.0f %%", 100.0 * tolerances[t]);
            row[head] = rounded(s.at[t].correct_fraction(), 2);
        }
        by_tolerance.push_back(row);
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
    scans.push_back([] { return planes::blocks(1, 100, 0.001); });
    if (quick) return scans;
    scans.push_back([] { return planes::blocks(11, 200, 0.005); });
    scans.push_back([] { return planes::furniture(1, 0.003); });
    return scans;
}

/// Hoover's counts of segmentations that are small enough to count by hand.
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

json measure(const effort& much, const std::vector<source>& own) {
    if (!hoover_is_right()) throw std::logic_error("Hoover's counts are not what they should be");
    report results;
    const std::vector<planes::method> methods = all_methods();
    for (const source& make : own.empty() ? all_scans(much.quick) : own) {
        const cloud scene = make();
        std::printf("plane_segmentation, %s\n", scene.name.c_str());
        std::fflush(stdout);
        results.add(scene);
        for (const planes::method& m : methods) {
            std::vector<score> scores(m.settings.size());
            gnomon::threads{}(scores.size(), [&](std::size_t s) {  // nothing is timed
                scores[s] = score_of(scene, m.settings[s]);
            });
            results.add(scene, m.name, "defaults", scores.front());
            const auto best =
                std::max_element(scores.begin(), scores.end(),
                                 [](const score& a, const score& b) { return is_better(b, a); });
            const auto best_f = std::max_element(
                scores.begin(), scores.end(),
                [](const score& a, const score& b) { return a.at[eighty].f() < b.at[eighty].f(); });
            results.add(scene, m.name, "best", *best);
            if (best_f->setting != best->setting) results.add(scene, m.name, "best F", *best_f);
        }
    }
    return {{"counts at 80 % overlap", results.counts},
            {"correct fraction by overlap", results.by_tolerance},
            {"scans", results.scans}};
}

}  // namespace

// With --scan FILE FIELD FIRST_LABEL, once or more, these labeled scans replace the default ones;
// points with smaller labels are background.
int main(int argc, char** argv) {
    std::vector<source> own;
    std::vector<char*> words;
    for (int i = 0; i < argc; ++i) {
        if (std::string_view(argv[i]) != "--scan" || i + 3 >= argc) {
            words.push_back(argv[i]);
            continue;
        }
        const std::string path = argv[i + 1], field = argv[i + 2];
        const double first = std::atof(argv[i + 3]);
        own.push_back([=] {
            const std::string name = std::filesystem::path(path).stem().string();
            return planes::read_labelled(name, path, field, first);
        });
        i += 3;
    }
    return run_program(
        static_cast<int>(words.size()), words.data(),
        [&](const effort& much) { return measure(much, own); },
        " [--scan FILE FIELD FIRST_LABEL]...");
}
