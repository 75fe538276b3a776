// SPDX-License-Identifier: BSL-1.0
// What is this piece of furniture, and why?
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string_view>
#include <vector>

#include <boost/hana/append.hpp>

#include "common/help.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/recognition.hpp>
#include <gnomon/simulation.hpp>

namespace sim = gnomon::simulation;

// [view_in]
namespace rec = gnomon::recognition;

/// The view of the object that a scan shows alone, above a floor that is known.
rec::view view_in(const gnomon::scan& scan, const gnomon::plane& floor) {
    const gnomon::spatial_index index(scan);
    const auto surface = gnomon::estimate_normals(index, gnomon::knn{.k = 20}, gnomon::plane_pca{});
    const auto parts = gnomon::segment_surfaces(index, surface, {.min_points = 15});
    const auto views = rec::views_of(scan, surface, parts,
                                     {.gap = rec::infinite_gap, .min_parts = 1, .ground = floor});
    return views.empty() ? rec::view{.parts = {}, .ground = floor, .rest = {}} : views.front();
}
// [view_in]

// [own_feature]
/// The number of points of a part for each square metre of its box: fewer behind a lattice.
struct density {
    static constexpr std::string_view name = "density";
    double scale = 1000.0, weight = 1.0;
    double operator()(const rec::part& p, const rec::view&) const {
        const auto& size = p.shape.frame.box_size;
        return static_cast<double>(p.shape.points) / (size[0] * size[1] + 1e-4);
    }
};
static_assert(rec::part_feature<density>);
// [own_feature]

int main(int argc, char** argv) {
    if (printed_help(argc, argv, "Recognizes simulated furniture, and prints why.")) return 0;
    const gnomon::plane floor{};
    const auto all = sim::furniture_models();
    const std::vector<sim::furniture_model> models{all[0], all[3], all[6], all[9]};
    const sim::object_view_options coarse{.scanner = {.resolution = gnomon::degrees(0.5)}};
    std::vector<rec::view> views, fresh;
    std::vector<std::uint32_t> classes;
    for (const auto& v : sim::simulate_object_views(models, 12, coarse)) {
        views.push_back(view_in(v.truth.scan, floor));
        classes.push_back(static_cast<std::uint32_t>(v.model));
    }
    auto other = coarse;
    other.seed = 2;
    for (const auto& v : sim::simulate_object_views(models, 3, other))
        fresh.push_back(view_in(v.truth.scan, floor));

    // [learn]
    rec::object_recognizer model;
    for (std::size_t i = 0; i < views.size(); ++i) model.learn(views[i], models[classes[i]].name);
    model.fit(gnomon::threads{});
    // [learn]

    for (const rec::view& view : fresh) {
        // [decide]
        const rec::decision found = model.explain(view);
        const char* name = model.names()[found.best].c_str();
        std::printf("%s%s, %.0f %%, log ratio %.1f\n", found.is_background() ? "perhaps " : "",
                    name, 100.0 * found.probability[found.best], found.log_ratio);
        std::vector<double> worth(view.parts.size(), 0.0);
        for (const rec::evidence& reason : found.evidence) {
            const bool is_pair = reason.kind == rec::term_kind::pair;
            for (const std::size_t part : {reason.first, reason.second})
                if (part < worth.size()) worth[part] += (is_pair ? 0.5 : 1.0) * reason.log_ratio;
        }
        for (std::size_t i = 0; i < worth.size(); ++i)
            std::printf("  part %zu at %.2f m: %+.1f\n", i, view.parts[i].highest, worth[i]);
        // [decide]
    }

    // [thesis]
    const auto features = rec::scaled_by_largest(rec::thesis_features, views);
    const rec::word_histograms thesis(views, classes, models.size(), features,
                                      rec::thesis_relations, {.max_distance = 0.10});
    for (const rec::view& view : fresh) {
        const rec::decision found = rec::explain(thesis, view, {.min_probability = 0.90});
        std::printf("%s, %zu reasons\n",
                    found.is_background() ? "background" : models[found.best].name.c_str(),
                    found.evidence.size());
    }
    // [thesis]

    // [with_own_feature]
    const auto mine = boost::hana::append(rec::default_features, density{});
    rec::object_recognizer denser({}, mine, rec::default_relations);
    // [with_own_feature]
    for (std::size_t i = 0; i < views.size(); ++i) denser.learn(views[i], models[classes[i]].name);
    denser.fit();
    std::printf("%s\n", denser.names()[denser.decide(fresh[0]).best].c_str());
    return 0;
}
