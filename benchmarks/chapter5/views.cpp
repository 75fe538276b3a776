// SPDX-License-Identifier: BSL-1.0
#include "views.hpp"

#include <map>
#include <utility>

#include <gnomon/gnomon.hpp>
#include <gnomon/perception.hpp>
#include <gnomon/perception/perceive_views.hpp>
#include <gnomon/recognition/view_augmentation.hpp>
#include <gnomon/recognition/views_of.hpp>
#include <gnomon/simulation.hpp>
#include <gnomon/simulation/object_views.hpp>

namespace {

sim::object_view_options options_of(const view_kind& kind, std::uint64_t seed, purpose use) {
    // Sets to test that differ in noise, duration or occlusion only have the same poses.
    sim::object_view_options options{.sensor = sim::at(0.0, 0.0, sensor_height),
                                     .duration = kind.duration,
                                     .beam = {.sigma = kind.sigma},
                                     .occluded_share = kind.occluded_share,
                                     .seed = 10 * seed + static_cast<std::uint64_t>(use)};
    options.places.high.x() = kind.farthest;
    if (kind.skims) {
        options.beam.footprint = {
            .divergence = wide_beam, .sub_rays = 9, .rule = sim::echo_rule::averaged};
    }
    return options;
}

/// "leg 2" is a "leg".
std::string kind_of(std::string part) {
    std::erase_if(part, [](char c) { return (c >= '0' && c <= '9') || c == ' '; });
    return part;
}

gnomon::scan some_points(const gnomon::scan& all, const std::vector<gnomon::point_index>& chosen) {
    gnomon::scan some;
    some.viewpoints = all.viewpoints;
    for (const gnomon::point_index i : chosen) some.points.push_back(all.points[i]);
    return some;
}

template <class T>
std::vector<T> some_of(const std::vector<T>& all, const std::vector<gnomon::point_index>& chosen) {
    std::vector<T> some;
    for (const gnomon::point_index i : chosen) some.push_back(all[i]);
    return some;
}

/// The name that most of these points have.
std::string most_frequent(const std::vector<std::string>& names, const auto& members) {
    std::map<std::string, std::size_t> counts;
    for (const auto i : members) ++counts[names[i]];
    std::pair<std::size_t, std::string> best;
    for (const auto& [name, n] : counts) best = std::max(best, {n, name});
    return best.second;
}

struct seen {
    rec::view view;
    std::vector<std::string> parts;
};

/// @param truth  the part of each point, or empty
seen perceived(const gnomon::scan& scan, double sigma, gnomon::angle divergence,
               const std::optional<density>& thesis, const std::vector<std::string>& truth) {
    seen result;
    result.view.ground = gnomon::plane{};
    const std::size_t fewest = thesis ? thesis->min_points : fewest_cells;
    if (scan.size() < std::max<std::size_t>(fewest, 3)) return result;
    std::vector<rec::view> views;
    gnomon::segments parts;
    if (!thesis) {
        auto found = rec::perceive_views(scan, {.ground = gnomon::plane{},
                                                .noise = gnomon::constant_noise{sigma},
                                                .divergence = divergence,
                                                .gap = rec::infinite_gap,
                                                .min_points = fewest_cells});
        views = std::move(found.views);
        parts = std::move(found.parts);
    } else {
        gnomon::perception<gnomon::knn, gnomon::plane_pca, gnomon::conservative,
                           gnomon::smooth_surfaces>
            chain{.neighborhood = {.k = thesis->k}, .noise = gnomon::constant_noise{sigma}};
        chain.segmentation.surfaces.min_points = thesis->min_points;
        auto all = chain(scan);
        views =
            rec::views_of(scan, all.surface, all.surfaces,
                          {.gap = rec::infinite_gap, .min_parts = 1, .ground = gnomon::plane{}});
        parts = std::move(all.surfaces);
    }
    if (views.empty()) return result;
    result.view = std::move(views.front());
    if (truth.empty()) return result;
    for (const rec::part& p : result.view.parts)
        result.parts.push_back(most_frequent(truth, parts[static_cast<std::size_t>(p.segment)]));
    return result;
}

}  // namespace

scan_set scans_of(const std::vector<sim::furniture_model>& models, std::size_t views,
                  const view_kind& kind, std::uint64_t seed, purpose use) {
    const auto all =
        sim::simulate_object_views(models, views, options_of(kind, seed, use), gnomon::threads{});
    std::vector<std::vector<std::string>> names;
    for (const auto& model : models) {
        sim::scene alone;
        sim::add(alone, model);
        names.emplace_back();
        for (const auto& p : alone.parts()) names.back().push_back(kind_of(p.name));
    }
    scan_set set{.scans = {}, .classes = {}, .parts = {}, .versions = 1, .sigma = kind.sigma};
    for (const sim::object_view& v : all) {
        const auto chosen = v.points_of_model();
        set.scans.push_back(some_points(v.truth.scan, chosen));
        set.classes.push_back(static_cast<std::uint32_t>(v.model));
        set.parts.emplace_back();
        for (const gnomon::point_index i : chosen)
            set.parts.back().push_back(names[v.model][static_cast<std::size_t>(v.truth.parts[i])]);
    }
    return set;
}

scan_set with_hidden_parts(const scan_set& scans, std::uint64_t seed) {
    constexpr std::size_t hidden = 2;
    scan_set all{
        .scans = {}, .classes = {}, .parts = {}, .versions = 1 + hidden, .sigma = scans.sigma};
    for (std::size_t i = 0; i < scans.scans.size(); ++i) {
        gnomon::random_stream random(seed, i);
        for (std::size_t version = 0; version <= hidden; ++version) {
            all.classes.push_back(scans.classes[i]);
            if (version == 0) {
                all.scans.push_back(scans.scans[i]);
                all.parts.push_back(scans.parts[i]);
                continue;
            }
            const auto left = rec::hide_part(scans.scans[i], {0.0, 0.0, sensor_height}, random);
            all.scans.push_back(some_points(scans.scans[i], left));
            all.parts.push_back(some_of(scans.parts[i], left));
        }
    }
    return all;
}

rec::view view_of(const gnomon::scan& scan, double sigma, const std::optional<density>& thesis) {
    return perceived(scan, sigma, gnomon::degrees(0.0), thesis, {}).view;
}

view_set views_of(const scan_set& scans, const std::optional<density>& thesis) {
    const std::size_t n = scans.scans.size();
    view_set set{.views = std::vector<rec::view>(n),
                 .classes = scans.classes,
                 .parts = std::vector<std::vector<std::string>>(n),
                 .versions = scans.versions};
    gnomon::threads{}(n, [&](std::size_t i) {
        auto [view, parts] =
            perceived(scans.scans[i], scans.sigma, scans.divergence, thesis, scans.parts[i]);
        set.views[i] = std::move(view);
        set.parts[i] = std::move(parts);
    });
    return set;
}
