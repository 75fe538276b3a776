// SPDX-License-Identifier: BSL-1.0
/// @file
/// What does a chair look like? From models of objects to simulated scans, to views of them, and to
/// a model file by which `recognize_scan` recognizes them.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "common/program.hpp"
#include "common/progress.hpp"
#include "learn_objects/models.hpp"
#include "learn_objects/options.hpp"
#include "learn_objects/progress_bar.hpp"
#include <gnomon/adapters/json_model.hpp>
#include <gnomon/filters/subset.hpp>
#include <gnomon/gnomon.hpp>
#include <gnomon/io.hpp>
#include <gnomon/perception/perceive_views.hpp>
#include <gnomon/perception/views_of_segments.hpp>
#include <gnomon/recognition/object_recognizer.hpp>
#include <gnomon/recognition/view_augmentation.hpp>
#include <gnomon/simulation.hpp>

namespace {

namespace rec = gnomon::recognition;

// [learn_views]
/// Adds what is seen of an object in a scan of it alone, if that has parts: its parts, and the
/// object as one part, as real scans are cut into other parts than simulated ones.
void add_views(std::vector<rec::view>& views, const gnomon::scan& scan, double sigma) {
    const rec::perceive_views_options alone{.ground = gnomon::plane{},
                                            .noise = gnomon::constant_noise{sigma},
                                            .gap = rec::infinite_gap};
    auto seen = rec::perceive_views(scan, alone).views;
    if (seen.empty()) return;
    std::ranges::move(seen, std::back_inserter(views));
    const gnomon::segments whole(std::vector<std::int32_t>(scan.size(), 0));
    std::ranges::move(rec::views_of_segments(scan, whole, alone), std::back_inserter(views));
}
// [learn_views]

/// The views of a scan of a model, and of two versions of it of which a part is hidden.
std::vector<rec::view> versions_of_view(const sim::furniture_model& model, std::uint64_t number,
                                        const options& o) {
    const sim::object_view_options how{.beam = {.sigma = o.sigma}, .seed = o.seed};
    const auto shot = sim::simulate_object_view(model, number, how);
    std::vector<rec::view> versions;
    add_views(versions, shot.truth.scan, o.sigma);
    gnomon::random_stream random(~o.seed, number);
    for (int i = 0; i < 2; ++i) {
        const auto visible = rec::hide_part(shot.truth.scan, how.sensor.position, random);
        add_views(versions, gnomon::subset(shot.truth.scan, visible), o.sigma);
    }
    return versions;
}

/// A view to be simulated.
struct task {
    const example* of;
    std::uint64_t number;
};

std::vector<task> tasks_of(const std::vector<example>& examples) {
    std::vector<task> tasks;
    for (std::size_t m = 0; m < examples.size(); ++m)
        for (std::size_t v = 0; v < examples[m].views; ++v)
            tasks.push_back({&examples[m], (std::uint64_t{m} << 32) + v});
    return tasks;
}

/// "0.70 x 0.70 x 1.10": length, width and height [m].
std::string size_of(const sim::furniture_model& model) {
    sim::scene alone;
    sim::add(alone, model);
    const Eigen::Vector3d size = alone.extent().size();
    char text[64];
    std::snprintf(text, sizeof text, "%.2f x %.2f x %.2f", size.x(), size.y(), size.z());
    return text;
}

void learn_objects(const options& o) {
    const stopwatch watch;
    const auto examples = examples_of(o);
    { const gnomon::io::output_file trial(o.out); }
    const auto tasks = tasks_of(examples);
    std::vector<std::vector<rec::view>> views(tasks.size());
    {
        progress_bar bar("views", tasks.size());
        o.threads(tasks.size(), [&](std::size_t i) {
            views[i] = versions_of_view(tasks[i].of->model, tasks[i].number, o);
            bar.step();
        });
    }
    rec::object_recognizer model;
    std::map<std::string, std::string> sizes;
    for (const example& e : examples) {
        constexpr std::size_t most = 60;  // characters: the first few models of a class
        std::string& line = sizes[e.name];
        if (line.size() < most) line += (line.empty() ? "" : ", ") + size_of(e.model);
    }
    std::map<std::string, std::pair<std::size_t, std::size_t>> counts;  // scans, versions
    for (std::size_t i = 0; i < tasks.size(); ++i) {
        auto& [scans, versions] = counts[tasks[i].of->name];
        ++scans;
        versions += views[i].size();
        if (!views[i].empty()) model.learn(views[i], tasks[i].of->name);
    }
    if (model.classes() < 2)
        throw gnomon::error(
            o.models, "",
            "surfaces were seen of one class only, or of none: are lengths in metres?");
    model.fit(o.threads);
    rec::write_model(o.out, model);

    // Sizes show a wrong unit, or an axis that does not point up.
    std::printf("class                     scans   views   of [m]\n");
    for (const auto& [name, count] : counts)
        std::printf("%-24s %6zu  %6zu   %s\n", name.c_str(), count.first, count.second,
                    sizes[name].c_str());
    std::printf("\nlearned %zu views of %zu classes, %zu words, in %.1f s\nwrote %s\n",
                model.learned().samples.rows(), model.classes(), model.learned().words.size(),
                watch.seconds(), o.out.c_str());
}

}  // namespace

int main(int argc, char** argv) {
    return run_program("learn_objects", usage, options_from, learn_objects, argc, argv);
}
