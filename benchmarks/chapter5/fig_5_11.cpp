// SPDX-License-Identifier: BSL-1.0
// Fig. 5.11: examples of objects that are recognized though a board hides half of their points, as
// pictures; and how many of all such views of these models are.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "../../examples/picture/image.hpp"
#include "../../examples/picture/palette.hpp"
#include "../../examples/picture/scene.hpp"
#include "../../examples/picture/splat.hpp"
#include "outcomes.hpp"
#include "views.hpp"
#include <gnomon/io/output_file.hpp>
#include <gnomon/recognition/object_recognizer.hpp>

namespace {

constexpr double hidden_share = 0.5;
/// As in the thesis: a chair, a table, and an armchair.
constexpr std::array<std::string_view, 3> shown{"kitchen chair", "dining table", "armchair"};
const Eigen::Vector3d sensor_of_views(0.0, 0.0, sensor_height);  // [m]
constexpr picture::color hidden_color{205, 207, 211};

/// A decision on one view of which half is hidden.
struct example {
    std::size_t scan = 0;      ///< its number among the tests
    std::string decided = {};  ///< the most probable model
    double probability = 0.0;
};

/// The number of a kind of parts, which is its color, in the order in which they come.
std::int32_t label_of(const std::string& kind, std::vector<std::string>& kinds) {
    const auto at = std::ranges::find(kinds, kind);
    const auto label = static_cast<std::int32_t>(at - kinds.begin());
    if (at == kinds.end()) kinds.push_back(kind);
    return label;
}

/// The points that were seen, by the part that they are of, among those of the same view without
/// the board. All face the sensor.
std::vector<picture::splat> splats_of(const scan_set& tests, const scan_set& whole, std::size_t i,
                                      std::vector<std::string>& kinds) {
    constexpr double near = 0.03, radius = 0.01;  // [m]
    const auto& seen = tests.scans[i].points;
    std::vector<picture::splat> splats;
    const auto add = [&](const Eigen::Vector3d& p, std::int32_t label, const picture::color& tint) {
        splats.push_back({p, (sensor_of_views - p).normalized(), radius, label, tint});
    };
    for (const auto& p : whole.scans[i].points) {
        const auto is_near = [&](const auto& q) { return (p - q).norm() < near; };
        if (std::ranges::none_of(seen, is_near)) add(p, 0, hidden_color);
    }
    for (std::size_t k = 0; k < seen.size(); ++k) {
        const std::string& kind = tests.parts[i][k];
        const std::int32_t label = label_of(kind.starts_with("arm") ? "arm" : kind, kinds);
        add(seen[k], label, picture::color_of(label));
    }
    return splats;
}

void draw(const scan_set& tests, const scan_set& whole, const std::vector<example>& examples,
          const std::filesystem::path& file) {
    constexpr int side = 500, margin = 24, top = 80, bottom = 60;
    picture::image sheet(margin + static_cast<int>(examples.size()) * (side + margin),
                         top + side + bottom);
    std::vector<std::string> kinds;  // of parts
    int x = margin;
    for (const example& e : examples) {
        const auto splats = splats_of(tests, whole, e.scan, kinds);
        const picture::scene scene(splats, sensor_of_views, Eigen::Vector3d(0.0, 0.0, 1.0));
        const picture::view from_sensor = scene.views()[0];
        sheet.paste(picture::drawn(splats, {}, from_sensor.from, side, side, from_sensor.back), x,
                    top);
        const auto share = 100 * (whole.scans[e.scan].size() - tests.scans[e.scan].size()) /
                           whole.scans[e.scan].size();
        sheet.write(x, 20, std::to_string(share) + " % of the points are hidden");
        char text[100];
        std::snprintf(text, sizeof text, "recognized: %s, probability %.2f", e.decided.c_str(),
                      e.probability);
        sheet.write(x, 48, text);
        x += side + margin;
    }
    x = margin;
    const auto explain = [&](const picture::color& c, const std::string& text) {
        sheet.fill(x, top + side + 16, x + 20, top + side + 38, c);
        sheet.write(x + 28, top + side + 20, text);
        x += 28 + picture::image::width_of(text) + 24;
    };
    explain(hidden_color, "hidden by a board");
    for (std::size_t k = 0; k < kinds.size(); ++k)
        explain(picture::color_of(static_cast<std::int32_t>(k)), kinds[k]);
    gnomon::io::replace_file(file, sheet.png());
}

json measure(const effort& much) {
    const auto models = sim::furniture_models();
    const std::size_t n = views_per_model(much);
    const auto names = names_of(models);
    rec::object_recognizer model;
    learn(model,
          views_of(with_hidden_parts(scans_of(models, n, {}, first_seed, purpose::learning),
                                     first_seed)),
          names);
    const auto kind = view_kind{.occluded_share = hidden_share};
    const scan_set tests = scans_of(models, n, kind, first_seed, purpose::test);
    const scan_set whole = scans_of(models, n, {}, first_seed, purpose::test);
    const outcomes found =
        outcomes_of(views_of(tests), [&](const rec::view& v) { return model.decide(v); });

    json rows = json::array();
    std::vector<example> examples;
    for (const std::string_view name : shown) {
        const auto number =
            static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
        std::size_t views = 0, right = 0;
        example first;
        for (std::size_t i = 0; i < found.all.size(); ++i) {
            const outcome& o = found.all[i];
            if (o.truth != number) continue;
            ++views;
            if (!o.is_right || !o.is_decided(usual_probability)) continue;
            if (++right == 1) first = {i, names[o.best], o.probability};
        }
        if (right > 0) examples.push_back(first);
        rows.push_back({{"model", name},
                        {"hidden", hidden_share},
                        {"views", views},
                        {"right and decided", right},
                        {"of the picture: the probability", rounded(first.probability, 2)}});
    }
    draw(tests, whole, examples, much.out / "fig_5_11.png");
    return {{"views of which half is hidden", rows}};
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, measure); }
