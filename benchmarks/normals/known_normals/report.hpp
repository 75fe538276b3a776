// SPDX-License-Identifier: BSL-1.0
/// @file
/// The tables: averages over shapes, and of every method the k that is best on average.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "columns.hpp"
#include "shapes.hpp"

namespace known_normals {

/// The result of a method on a cloud.
struct measurement {
    std::string method;
    std::size_t k;   ///< 0 where the method chooses
    double rms;      ///< of the unoriented angles to the true normals [degrees]
    double missing;  ///< the share of points without a normal, each counted as 90 degrees
};

/// All measurements on one cloud; the same list of methods and k for every cloud.
struct cloud_report {
    const shape* of;
    std::size_t column;  ///< number in `columns`
    std::vector<measurement> measured;
    double time_ratio;  ///< of our method to knn{30} and plane_pca, in one thread
};

/// What a method reaches on average over shapes, with one k for all columns.
struct average {
    std::string method;
    std::size_t k;
    std::vector<double> columns;  ///< [degrees], in the order of `columns`
    double all;                   ///< their mean [degrees]
    double missing;
    std::size_t row;  ///< number of the measurement in each report
};

/// Averages over some of the clouds, for each method and k.
inline std::vector<average> averages_of(const std::vector<const cloud_report*>& clouds) {
    std::vector<average> result;
    for (std::size_t r = 0; r < clouds.front()->measured.size(); ++r) {
        const measurement& first = clouds.front()->measured[r];
        average a{first.method, first.k, std::vector<double>(columns.size(), 0.0), 0.0, 0.0, r};
        const auto n = static_cast<double>(clouds.size());
        for (const cloud_report* c : clouds) {
            const measurement& m = c->measured[r];
            a.columns[c->column] += m.rms * static_cast<double>(columns.size()) / n;
            a.all += m.rms / n;
            a.missing += m.missing / n;
        }
        result.push_back(std::move(a));
    }
    return result;
}

/// Of each method the best k.
inline std::map<std::string, average> best_of(const std::vector<average>& averages) {
    std::map<std::string, average> best;
    for (const average& a : averages) {
        const auto [found, fresh] = best.try_emplace(a.method, a);
        if (!fresh && a.all < found->second.all) found->second = a;
    }
    return best;
}

/// The beginning of a markdown table that has a cell for each column, and `more` behind them.
inline void print_heading(const char* first, const std::vector<const char*>& more) {
    std::printf("\n| %s |", first);
    for (const column& c : columns) std::printf(" %s |", c.name);
    for (const char* name : more) std::printf(" %s |", name);
    std::printf("\n|---|");
    for (std::size_t i = 0; i < columns.size() + more.size(); ++i) std::printf("---|");
    std::printf("\n");
}

/// The table of some clouds, best method first, and the comparison of `ours` with its rivals.
inline void print_methods(const char* title, const std::vector<const cloud_report*>& clouds,
                          const std::string& ours, const std::vector<std::string>& rivals) {
    const auto best = best_of(averages_of(clouds));
    std::vector<average> rows;
    for (const auto& entry : best) rows.push_back(entry.second);
    std::stable_sort(rows.begin(), rows.end(),
                     [](const average& a, const average& b) { return a.all < b.all; });
    print_heading(title, {"average", "k", "no normal"});
    for (const average& a : rows) {
        std::printf("| %s |", a.method.c_str());
        for (const double rms : a.columns) std::printf(" %.2f |", rms);
        std::printf(" %.3f | %s | %.2g %% |\n", a.all,
                    a.k == 0 ? "its own" : std::to_string(a.k).c_str(), 100.0 * a.missing);
    }
    std::printf("\n");
    for (const std::string& rival : rivals) {
        if (!best.contains(rival)) continue;
        std::printf("%s / %s = %.3f\n", ours.c_str(), rival.c_str(),
                    best.at(ours).all / best.at(rival).all);
    }
}

/// How the averages of a method depend on k.
inline void print_choice_of_k(const std::vector<const cloud_report*>& clouds,
                              const std::string& method) {
    if (!best_of(averages_of(clouds)).contains(method)) return;
    print_heading((method + ", k").c_str(), {"average"});
    for (const average& a : averages_of(clouds)) {
        if (a.method != method) continue;
        std::printf("| %zu |", a.k);
        for (const double rms : a.columns) std::printf(" %.2f |", rms);
        std::printf(" %.3f |\n", a.all);
    }
}

/// Every cloud: `ours`, and the rival with its best k; then where the rival is ahead.
inline void print_duel(const std::vector<const cloud_report*>& clouds, const std::string& ours,
                       const std::string& rival) {
    const auto best = best_of(averages_of(clouds));
    if (!best.contains(rival)) return;
    const std::string title = ours + " : " + rival + ", k = " + std::to_string(best.at(rival).k);
    print_heading(title.c_str(), {});
    std::string losses;
    const shape* row = nullptr;
    for (const cloud_report* c : clouds) {
        if (c->of != row) std::printf("%s| %s |", row == nullptr ? "" : "\n", c->of->name);
        row = c->of;
        const double own = c->measured[best.at(ours).row].rms;
        const double other = c->measured[best.at(rival).row].rms;
        std::printf(" %.2f : %.2f |", own, other);
        if (own <= other) continue;
        losses += losses.empty() ? "" : "; ";
        losses += std::string(c->of->name) + ", " + columns[c->column].name;
    }
    std::printf("\n\n%s is behind %s on: %s\n", ours.c_str(), rival.c_str(),
                losses.empty() ? "no cloud" : losses.c_str());
}

/// `ours` in units of the rival, which has the k that is best for each cloud.
inline void print_own_k(const char* title, const std::vector<const cloud_report*>& clouds,
                        const std::string& ours, const std::string& rival) {
    double sum = 0.0, sum_of_rival = 0.0, ratios = 0.0;
    for (const cloud_report* c : clouds) {
        double own = 0.0, best = 90.0;
        for (const measurement& m : c->measured) {
            if (m.method == ours) own = m.rms;
            if (m.method == rival) best = std::min(best, m.rms);
        }
        sum += own;
        sum_of_rival += best;
        ratios += own / best / static_cast<double>(clouds.size());
    }
    if (clouds.empty() || sum_of_rival >= 90.0 * static_cast<double>(clouds.size())) return;
    std::printf("%s: %s / %s with the best k of each cloud: %.3f (mean of ratios %.3f)\n", title,
                ours.c_str(), rival.c_str(), sum / sum_of_rival, ratios);
}

/// How long `ours` takes.
inline void print_times(const std::vector<const cloud_report*>& clouds, const std::string& ours) {
    const auto [least, most] = std::minmax_element(
        clouds.begin(), clouds.end(),
        [](const auto* a, const auto* b) { return a->time_ratio < b->time_ratio; });
    std::printf("\n%s takes %.1f (%s, %s) to %.1f (%s, %s) times as long as knn{30} + plane_pca\n",
                ours.c_str(), (*least)->time_ratio, (*least)->of->name,
                columns[(*least)->column].name, (*most)->time_ratio, (*most)->of->name,
                columns[(*most)->column].name);
}

}  // namespace known_normals
