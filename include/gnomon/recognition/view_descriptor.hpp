// SPDX-License-Identifier: BSL-1.0
/// @file
/// Describes a view, or some of its parts, by a vector of fixed length for a classifier: the
/// features of its parts and the relations of their pairs, pooled, and its height profile.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/recognition/height_profile.hpp>
#include <gnomon/recognition/part_feature.hpp>
#include <gnomon/recognition/part_relation.hpp>
#include <gnomon/recognition/view.hpp>

namespace gnomon::recognition {

/// The values of a view that its descriptions are made of: feature vectors of parts, and relations
/// of pairs.
template <std::size_t Features, std::size_t Relations>
struct measured_view {
    std::vector<std::array<double, Features>> parts;   ///< features of each part
    std::vector<std::array<double, Relations>> pairs;  ///< (0, 1), (0, 2), (1, 2), (0, 3), ...

    /// The number of the pair of parts i < j.
    [[nodiscard]] static std::size_t pair(std::size_t i, std::size_t j) {
        return j * (j - 1) / 2 + i;
    }
};

/// Describes views by features, relations, and the height profile if `uses_profile`.
template <class Features, class Relations>
struct view_descriptor {
    /// Numbers that describe a part.
    static constexpr std::size_t features_per_part = feature_count<Features>;
    /// Numbers that describe a pair.
    static constexpr std::size_t relations_per_pair = relation_count<Relations>;
    /// Numbers of a description that are about pairs.
    static constexpr std::size_t pair_columns = 3 * relations_per_pair;
    /// What is measured on a view.
    using measured = measured_view<features_per_part, relations_per_pair>;

    Features features;         ///< a tuple of models of `part_feature`
    Relations relations;       ///< a tuple of models of `part_relation`
    bool uses_profile = true;  ///< which needs the ground

    /// Measures a view. O(parts^2).
    /// @throws std::invalid_argument  if a feature, or the profile, needs the ground and the view
    ///                                has none, or a value is not finite
    [[nodiscard]] measured measure(const view& v) const {
        if (uses_profile) static_cast<void>(detail::ground_of(v, "height profile"));
        measured m;
        for (const part& p : v.parts) m.parts.push_back(feature_vector(features, p, v));
        if constexpr (relations_per_pair > 0) {
            for (std::size_t j = 0; j < v.parts.size(); ++j)
                for (std::size_t i = 0; i < j; ++i)
                    m.pairs.push_back(relation_vector(relations, v.parts[i], v.parts[j]));
        }
        return m;
    }

    /// The description of some parts of a view, largest first.
    /// @param has_rest  whether the points that belong to no part count
    /// @throws std::invalid_argument  if the height profile counts and is not finite
    [[nodiscard]] std::vector<double> describe(const view& v, const measured& m,
                                               std::span<const std::size_t> chosen,
                                               bool has_rest) const {
        std::vector<double> d;
        d.reserve(1 + (3 + largest_parts) * features_per_part + pair_columns +
                  2 * height_profile::count);
        d.push_back(static_cast<double>(chosen.size()));
        pool_parts(m, chosen, d);
        if constexpr (relations_per_pair > 0) pool_pairs(v, m, chosen, d);
        if (uses_profile) {
            height_profile sum;
            if (has_rest) sum += v.rest;
            for (const std::size_t i : chosen) sum += v.parts[i].profile;
            describe_profile(sum, d);
        }
        return d;
    }

    /// The description of all parts.
    [[nodiscard]] std::vector<double> operator()(const view& v) const {
        std::vector<std::size_t> all(v.parts.size());
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
        return describe(v, measure(v), all, true);
    }

  private:
    static constexpr std::size_t largest_parts = 4;
    /// The value of a feature where there is no part or pair; scaled values are around 0 to 20.
    static constexpr double absent = -10.0;

    /// Least, largest and mean value of each feature, and its values of the largest parts.
    static void pool_parts(const measured& m, std::span<const std::size_t> chosen,
                           std::vector<double>& d) {
        for (std::size_t f = 0; f < features_per_part; ++f) {
            double low = absent, high = absent, sum = absent;
            for (std::size_t k = 0; k < chosen.size(); ++k) {
                const double x = m.parts[chosen[k]][f];
                low = k == 0 ? x : std::min(low, x);
                high = k == 0 ? x : std::max(high, x);
                sum = k == 0 ? x : sum + x;
            }
            const auto n = static_cast<double>(std::max<std::size_t>(1, chosen.size()));
            d.insert(d.end(), {low, high, chosen.empty() ? absent : sum / n});
        }
        for (std::size_t k = 0; k < largest_parts; ++k) {
            for (std::size_t f = 0; f < features_per_part; ++f)
                d.push_back(k < chosen.size() ? m.parts[chosen[k]][f] : absent);
        }
    }

    /// The mean of each relation, weighted by the points of both parts, and its values of the
    /// heaviest pair, and of the heaviest one of parts that are not parallel.
    static void pool_pairs(const view& v, const measured& m, std::span<const std::size_t> chosen,
                           std::vector<double>& d) {
        std::array<double, relations_per_pair> mean{}, heaviest, corner;
        heaviest.fill(absent);
        corner.fill(absent);
        double total = 0.0, largest = 0.0, largest_corner = 0.0;
        for (std::size_t b = 1; b < chosen.size(); ++b) {
            for (std::size_t a = 0; a < b; ++a) {
                const part& p = v.parts[chosen[a]];
                const part& q = v.parts[chosen[b]];
                const auto& x = m.pairs[measured::pair(chosen[a], chosen[b])];
                const double weight =
                    static_cast<double>(p.shape.points) * static_cast<double>(q.shape.points);
                for (std::size_t r = 0; r < relations_per_pair; ++r) mean[r] += weight * x[r];
                total += weight;
                if (weight > largest) {
                    largest = weight;
                    heaviest = x;
                }
                constexpr double parallel = 0.7;  // cosine of about 45 degrees
                const double cosine = gnomon::detail::dot(p.shape.normal, q.shape.normal);
                if (std::abs(cosine) < parallel && weight > largest_corner) {
                    largest_corner = weight;
                    corner = x;
                }
            }
        }
        for (std::size_t r = 0; r < relations_per_pair; ++r)
            d.insert(d.end(), {total > 0.0 ? mean[r] / total : absent, heaviest[r], corner[r]});
    }

    /// Shares of the points at each height, heights of quantiles, and horizontal extents of bands
    /// of height: of legs, seats, tables, backs, and shelves.
    static void describe_profile(const height_profile& profile, std::vector<double>& d) {
        constexpr std::size_t n = height_profile::count;
        const height_profile::level all = profile.band(0, n);
        for (const double sum : {all.points, all.u, all.v, all.uu, all.uv, all.vv})
            gnomon::detail::require(std::isfinite(sum), "a height profile is not finite");
        const double total = all.points;
        for (const auto& level : profile.levels)
            d.push_back(total > 0.0 ? std::sqrt(level.points / total) : absent);
        for (const double quantile : {0.1, 0.5, 0.9, 0.995}) {
            double below = 0.0;
            std::size_t i = 0;
            while (i + 1 < n && (below += profile.levels[i].points) < quantile * total) ++i;
            d.push_back(total > 0.0 ? static_cast<double>(i) : absent);
        }
        constexpr std::array<std::size_t, 8> bands{0, 4, 8, 10, 13, 16, 24, n};  // of 5 cm
        for (std::size_t b = 0; b + 1 < bands.size(); ++b) {
            const auto extent = detail::horizontal_extent(profile.band(bands[b], bands[b + 1]));
            d.insert(d.end(), extent.begin(), extent.end());
        }
        const auto extent = detail::horizontal_extent(all);
        d.insert(d.end(), extent.begin(), extent.end());
    }
};

/// Deduces the types of the tuples, as clang does by itself from 17 on.
template <class Features, class Relations>
view_descriptor(Features, Relations, bool) -> view_descriptor<Features, Relations>;

}  // namespace gnomon::recognition
