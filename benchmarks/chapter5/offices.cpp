// SPDX-License-Identifier: BSL-1.0
// A real office, Sec. 5.8.4: chairs and tables of a real scan, recognized by a model that has
// learned simulated views of other chairs and tables, and of clutter, in parts and as one part. The
// segments of an object are its labeled parts, or those that perceive_views finds in the group that
// most of its points are in.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "furniture_classes.hpp"
#include "outcomes.hpp"
#include "views.hpp"
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/io/label_properties.hpp>
#include <gnomon/io/read.hpp>
#include <gnomon/perception/perceive_views.hpp>
#include <gnomon/perception/views_of_segments.hpp>
#include <gnomon/recognition/object_recognizer.hpp>
#include <gnomon/simulation.hpp>

namespace {

constexpr std::array<const char*, 3> class_names{"chair", "table", "background"};
using furniture::class_of;
using furniture::other;

/// Furniture of the simulator and of mesh files, office chairs and tables, and clutter.
std::vector<sim::furniture_model> models_to_learn(std::uint64_t seed) {
    std::vector<sim::furniture_model> models = sim::furniture_models();
    // It is neither chair nor table, and too similar to both to be background.
    std::erase_if(models, [](const auto& m) { return m.name == "stool"; });
    for (auto& read : furniture::read_all(std::string(CHAPTER5_DATA) + "/furniture"))
        models.push_back(std::move(read));
    for (auto& made : sim::office_chairs(16, seed)) models.push_back(std::move(made));
    for (auto& made : sim::office_tables(16, seed)) models.push_back(std::move(made));
    for (auto& piece : sim::clutter_models(48, seed)) models.push_back(std::move(piece));
    return models;
}

/// The labeled parts of an object.
struct labeled_object {
    std::string name, kind;
    std::vector<std::int32_t> labels;

    [[nodiscard]] bool has(std::int32_t label) const {
        return std::ranges::find(labels, label) != labels.end();
    }
};

/// Of a table of label, object, class and part.
std::vector<labeled_object> objects_in(const std::string& path) {
    std::ifstream file(path);
    std::vector<labeled_object> all;
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
        std::istringstream row(line);
        std::int32_t label = 0;
        std::string name, kind;
        row >> label >> name >> kind;
        const auto known = std::ranges::find(all, name, &labeled_object::name);
        if (known != all.end())
            known->labels.push_back(label);
        else
            all.push_back({name, kind, {label}});
    }
    return all;
}

/// The view of points that are one object of these segments; without parts if there is none.
rec::view view_of_parts(const auto& points, const gnomon::segments& parts,
                        const std::optional<gnomon::noise_curve>& noise = std::nullopt) {
    auto views = rec::views_of_segments(
        points, parts, {.ground = gnomon::plane{}, .noise = noise, .gap = rec::infinite_gap});
    if (!views.empty()) return std::move(views.front());
    rec::view nothing;
    nothing.ground = gnomon::plane{};
    return nothing;
}

/// That of an object of the office whose segments are its labeled parts.
rec::view labeled_view(const gnomon::scan& scan, const std::vector<std::int32_t>& label_of,
                       const labeled_object& object) {
    std::vector<gnomon::point_index> members;
    std::vector<std::int32_t> parts;
    for (std::size_t i = 0; i < label_of.size(); ++i) {
        if (!object.has(label_of[i])) continue;
        members.push_back(static_cast<gnomon::point_index>(i));
        parts.push_back(static_cast<std::int32_t>(std::ranges::find(object.labels, label_of[i]) -
                                                  object.labels.begin()));
    }
    return view_of_parts(gnomon::subset_view(scan, members), gnomon::segments(std::move(parts)));
}

/// The views of scans, each once by its parts and once as one part: the segments of real scans, and
/// labels, are cut elsewhere than those of simulated ones.
view_set in_parts_and_whole(const scan_set& scans) {
    const view_set in_parts = views_of(scans);
    view_set both{.views = std::vector<rec::view>(2 * in_parts.views.size()),
                  .classes = {},
                  .parts = {},
                  .versions = 2 * in_parts.versions};
    gnomon::threads{}(in_parts.views.size(), [&](std::size_t i) {
        const gnomon::scan& scan = scans.scans[i];
        both.views[2 * i] = both.views[2 * i + 1] = in_parts.views[i];
        if (in_parts.views[i].parts.empty()) return;
        both.views[2 * i + 1] =
            view_of_parts(scan, gnomon::segments(std::vector<std::int32_t>(scan.size(), 0)),
                          gnomon::constant_noise{scans.sigma});
    });
    for (const std::uint32_t of : in_parts.classes) both.classes.insert(both.classes.end(), 2, of);
    return both;
}

/// A decision is right if its class is; no class is a decision, too, if that of the object is none.
bool is_right(const rec::decision& d, const std::vector<std::string>& names, std::uint32_t truth) {
    const bool is_decided = d.probability[d.best] >= usual_probability;
    const std::string& best = names[d.best];
    return truth == other ? !is_decided || best == class_names[other]
                          : is_decided && best == class_names[truth];
}

/// What was decided of an object, seed by seed.
struct decided_object {
    std::size_t seeds = 0, right = 0;
    std::vector<double> probability;  ///< of the true class, or of none
};

class study {
  public:
    explicit study(const effort& much) : much_(much) {
        const std::string folder = std::string(CHAPTER5_DATA) + "/segmentation_truth/";
        scan_ = gnomon::io::read(folder + "tum_office_room1_parts.pcd", {"*"});
        labels_ = gnomon::io::labels_of(scan_);
        objects_ = objects_in(folder + "tum_office_room1_parts.classes.tsv");
        const auto seen =
            rec::perceive_views(scan_, {.ground = gnomon::plane{}}, gnomon::threads{});
        for (const labeled_object& o : objects_) {
            labeled_.push_back(labeled_view(scan_, labels_, o));
            own_.push_back(own_view(seen, o));
        }
        for (std::uint64_t s = 0; s < much.seeds(); ++s) add_seed(first_seed + s);
    }

    json tables() const {
        json rows = json::array();
        for (const auto& [key, d] : found_) {
            const auto& [learned, segments, o] = key;
            rows.push_back({{"learned", learned},
                            {"segments", segments},
                            {"object", objects_[o].name},
                            {"is", class_names[class_of(objects_[o].kind)]},
                            {"seeds", d.seeds},
                            {"right", d.right},
                            {"probability", rounded(median_of(d.probability), 3)},
                            {"least", rounded(std::ranges::min(d.probability), 3)}});
        }
        return {{"a real office", rows}, {"real and simulated", ratios()}};
    }

  private:
    void add_seed(std::uint64_t seed) {
        const std::size_t n = much_.quick ? 2 : 10;
        const auto models = models_to_learn(seed);
        std::vector<std::string> names;
        for (const auto& m : models) names.emplace_back(class_names[class_of(m.name)]);
        const view_set tests = views_of(scans_of(models, n, {}, seed, purpose::test));
        rec::object_recognizer model;
        for (const bool skims : {false, true}) {
            learn_views(model,
                        in_parts_and_whole(with_hidden_parts(
                            scans_of(models, n, {.skims = skims}, seed, purpose::learning), seed)),
                        names);
            model.fit(gnomon::threads{});
            const std::string learned = skims ? "thin and skimmed" : "thin";
            add_office(model, learned);
            std::size_t asked = 0, right = 0;
            for (std::size_t i = 0; i < tests.views.size(); ++i) {
                const std::uint32_t truth = class_of(models[tests.classes[i]].name);
                if (truth == other) continue;
                ++asked;
                if (is_right(model.decide(tests.views[i]), model.names(), truth)) ++right;
            }
            simulated_[learned].push_back(static_cast<double>(right) / static_cast<double>(asked));
        }
    }

    /// The view of the group that most points of an object are in; without parts if of none.
    [[nodiscard]] rec::view own_view(const rec::perceived_views& seen,
                                     const labeled_object& object) const {
        std::map<std::int32_t, std::size_t> counts;
        for (std::size_t i = 0; i < labels_.size(); ++i)
            if (object.has(labels_[i])) ++counts[seen.groups.labels()[i]];
        const std::int32_t group =
            std::ranges::max_element(counts, {}, [](const auto& c) { return c.second; })->first;
        return group == gnomon::unlabeled ? rec::view{}
                                          : seen.views[static_cast<std::size_t>(group)];
    }

    void add_office(const rec::object_recognizer<>& model, const std::string& learned) {
        for (std::size_t o = 0; o < objects_.size(); ++o) {
            const std::uint32_t truth = class_of(objects_[o].kind);
            add(model, labeled_[o], truth, found_[{learned, "labeled parts", o}]);
            add(model, own_[o], truth, found_[{learned, "own", o}]);
        }
    }

    static void add(const rec::object_recognizer<>& model, const rec::view& v, std::uint32_t truth,
                    decided_object& to) {
        ++to.seeds;
        if (v.parts.empty()) {  // of a wall, or of too few points: no object
            if (truth == other) ++to.right;
            to.probability.push_back(truth == other ? 1.0 : 0.0);
            return;
        }
        const rec::decision d = model.decide(v);
        if (is_right(d, model.names(), truth)) ++to.right;
        const auto at = std::ranges::find(model.names(), class_names[truth]);
        to.probability.push_back(
            d.probability[static_cast<std::size_t>(at - model.names().begin())]);
    }

    /// The share of chairs and tables that are right, in the office and in simulated views.
    json ratios() const {
        json rows = json::array();
        for (const auto& [learned, simulated] : simulated_) {
            for (const char* segments : {"labeled parts", "own"}) {
                double right = 0.0, asked = 0.0;
                for (std::size_t o = 0; o < objects_.size(); ++o) {
                    if (class_of(objects_[o].kind) == other) continue;
                    const decided_object& d = found_.at({learned, segments, o});
                    right += static_cast<double>(d.right);
                    asked += static_cast<double>(d.seeds);
                }
                const double real = right / asked, in_simulation = median_of(simulated);
                rows.push_back({{"learned", learned},
                                {"segments", segments},
                                {"real", rounded(real, 3)},
                                {"simulated", rounded(in_simulation, 3)},
                                {"ratio", rounded(real / in_simulation, 3)}});
            }
        }
        return rows;
    }

    effort much_;
    gnomon::scan scan_;
    std::vector<std::int32_t> labels_;
    std::vector<labeled_object> objects_;
    std::vector<rec::view> labeled_, own_;  // of the objects
    std::map<std::tuple<std::string, std::string, std::size_t>, decided_object> found_;
    std::map<std::string, std::vector<double>> simulated_;
};

json measure(const effort& much) {
    for (const char* folder : {"/furniture", "/segmentation_truth"})
        if (!furniture::is_there(CHAPTER5_DATA + std::string(folder))) return json::object();
    return study(much).tables();
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, measure); }
