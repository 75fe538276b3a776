// SPDX-License-Identifier: BSL-1.0
/// @file
/// Repeatability of a feature: whether two independent scans give the same place, or the same
/// segment, more similar values than different ones. It is 2 P - 1, where P is the probability
/// that the distance of the same is below that of different ones (ties count half): 1 if it always
/// is, 0 if the feature does not distinguish them. P depends on the order of distances alone, so
/// features of any unit and dimension are comparable.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "../chapter4/record.hpp"
#include "../surfaces/furnished.hpp"

/// Seeds of rooms that no other page uses.
inline constexpr std::uint64_t first_seed = 40'001;

/// Two scans of a room. The sensor of the second is turned by a fraction of the distance of scan
/// lines, so that no ray is repeated, and the noise is independent.
struct two_scans {
    sim::scene world;
    std::array<sim::true_scan, 2> scans;

    /// @param apart  the distance of their positions [m]
    two_scans(const setting& how, std::uint64_t seed, double apart = 0.0) : world(furnished(seed)) {
        const sim::bvh_caster caster(world);
        scans[0] = scan_of(world, caster, how, 1000 * seed + 1);
        sim::scene turned = world;
        turned.sensor = sim::at(0.0, apart, 0.0) * world.sensor * sim::yaw(gnomon::degrees(0.37)) *
                        sim::pitch(gnomon::degrees(0.11));
        scans[1] = scan_of(turned, caster, how, 1000 * seed + 2);
    }
};

/// The values of a feature, of some places or segments; none where it is not usable.
template <class Value>
using values_of = std::vector<std::optional<Value>>;

/// Places or segments, by their numbers in the first and in the second scan.
struct compared_pairs {
    std::vector<std::pair<std::size_t, std::size_t>> same, different;
};

/// The distances of the values of a feature.
struct feature_distances {
    std::vector<double> same, different;
    std::size_t pairs = 0;  ///< of the same, with those that are not usable

    template <class Value>
    void add(const compared_pairs& pairs_of, const values_of<Value>& first,
             const values_of<Value>& second, auto&& distance) {
        const auto add_all = [&](const auto& from, std::vector<double>& to) {
            for (const auto& [a, b] : from)
                if (first[a] && second[b]) to.push_back(distance(*first[a], *second[b]));
        };
        add_all(pairs_of.same, same);
        add_all(pairs_of.different, different);
        pairs += pairs_of.same.size();
    }

    void add(const feature_distances& other) {
        same.insert(same.end(), other.same.begin(), other.same.end());
        different.insert(different.end(), other.different.begin(), other.different.end());
        pairs += other.pairs;
    }

    /// The median distance of the same, divided by that of different ones.
    [[nodiscard]] double ratio() const { return median_of(same) / median_of(different); }

    [[nodiscard]] double repeatability() const {
        return 2.0 * probability_of_less(same, different) - 1.0;
    }
};

/// The distances of all features, by their names.
using all_distances = std::map<std::string, feature_distances>;

/// The distances of all features by noise and density, over all rooms.
class measured_features {
  public:
    /// @param of_lines      the densities, "whole" among them
    /// @param distances_of  (setting, seed) to all_distances
    measured_features(std::vector<std::string> features, const effort& much,
                      std::span<const char* const> of_lines, auto&& distances_of)
        : features_(std::move(features)) {
        const std::size_t rooms = much.quick ? 1 : 20;
        for (const double noise : {0.0, 5.0, 15.0, 30.0}) {
            for (const std::string density : of_lines) {
                std::vector<all_distances> of_rooms(rooms);
                gnomon::threads{}(rooms, [&](std::size_t r) {
                    of_rooms[r] = distances_of(setting{noise, density, "rotational"},
                                               first_seed + static_cast<std::uint64_t>(r));
                });
                all_distances& sum = by_setting_.emplace_back(noise, density).distances;
                for (const all_distances& room : of_rooms)
                    for (const auto& [feature, d] : room) sum[feature].add(d);
                std::printf("%g mm, %s: %zu pairs\n", noise, density.c_str(),
                            sum.at(features_[0]).pairs);
                std::fflush(stdout);
            }
        }
    }

    /// A row for each feature: the repeatability at each noise, at the density "whole".
    [[nodiscard]] json by_noise() const {
        json rows = table("whole", [](const feature_distances& d) { return d.repeatability(); });
        const auto of_table = std::find_if(by_setting_.begin(), by_setting_.end(), [](auto& one) {
            return one.noise == 15.0 && one.density == "whole";
        });
        for (std::size_t f = 0; f < features_.size(); ++f) {
            const feature_distances& d = of_table->distances.at(features_[f]);
            rows[f]["pairs"] = d.pairs;
            rows[f]["not usable [%]"] = rounded(
                100.0 - 100.0 * static_cast<double>(d.same.size()) / static_cast<double>(d.pairs),
                1);
        }
        return rows;
    }

    [[nodiscard]] json by_density() const {
        return table("", [](const feature_distances& d) { return d.repeatability(); });
    }

    [[nodiscard]] json ratios() const {
        return table("whole", [](const feature_distances& d) { return d.ratio(); });
    }

  private:
    /// @param only  this density, or all if empty
    [[nodiscard]] json table(const std::string& only, auto&& number) const {
        json rows = json::array();
        for (const std::string& f : features_) {
            json row{{"feature", f}};
            for (const auto& [noise, density, all] : by_setting_) {
                if (!only.empty() && density != only) continue;
                std::string column = std::to_string(static_cast<int>(noise)) + " mm";
                if (only.empty()) column += ", " + density;
                row[column] = rounded(number(all.at(f)), 3);
            }
            rows.push_back(row);
        }
        return rows;
    }

    struct one_setting {
        double noise;  ///< [mm]
        std::string density;
        all_distances distances;

        one_setting(double n, std::string d) : noise(n), density(std::move(d)) {}
    };

    std::vector<std::string> features_;
    std::vector<one_setting> by_setting_;
};

/// The time of the processor that this thread takes for one call [s]: the median of some.
inline double seconds_of(const effort& much, auto&& work) {
    const auto now = [] {
        std::timespec t{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
        return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
    };
    std::vector<double> times;
    for (int pass = 0; pass < much.passes(); ++pass) {
        const double begin = now();
        work();
        times.push_back(now() - begin);
    }
    return median_of(times);
}
