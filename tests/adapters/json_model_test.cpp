// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <boost/hana/append.hpp>
#include <boost/hana/tuple.hpp>
#include <gtest/gtest.h>

#include "io/io_test_support.hpp"
#include <gnomon/adapters/json_model.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/recognition/object_recognizer.hpp>
#include <gnomon/recognition/part_features.hpp>

namespace rec = gnomon::recognition;

namespace {

using file_json = nlohmann::ordered_json;

/// A view of boards of random sizes about the height of their class.
rec::view view_of_boards(std::size_t number, gnomon::random_stream& random) {
    rec::view v{.parts = {}, .ground = gnomon::plane{}, .rest = {}};
    for (std::size_t i = 0; i < 2 + number % 2; ++i) {
        std::vector<Eigen::Vector3d> points;
        const double height = 0.3 * static_cast<double>(number + 1) + random.uniform(-0.1, 0.1);
        for (int k = 0; k < 30; ++k)
            points.emplace_back(random.uniform(), random.uniform(0.0, 0.5),
                                height + random.uniform(0.0, 0.02));
        rec::part p;
        p.segment = static_cast<std::int32_t>(i);
        p.shape.frame = gnomon::principal_frame::of(points);
        p.shape.points = points.size();
        p.shape.normal = Eigen::Vector3d(0, 0, 1);
        p.shape.spread = gnomon::segment_shape::extent::volume;
        p.lowest = height;
        p.highest = height + 0.02;
        for (const auto& x : points) p.profile.add(x.z(), x.x(), x.y());
        v.parts.push_back(p);
    }
    return v;
}

const std::vector<std::string> classes{"table \"long\"", "St\xc3\xbchle", "background"};

template <class Recognizer>
Recognizer taught(Recognizer model) {
    gnomon::random_stream random(5);
    for (int i = 0; i < 12; ++i) {
        for (std::size_t c = 0; c < classes.size(); ++c) {
            const std::vector<rec::view> versions{view_of_boards(c, random),
                                                  view_of_boards(c, random)};
            model.learn(versions, classes[c]);
        }
    }
    model.fit();
    return model;
}

/// Learned once: a small model.
const rec::object_recognizer<>& small_model() {
    static const auto model = taught(rec::object_recognizer<>(
        {.trees = {.trees = 20, .seed = 0xfedcba9876543210}, .min_probability = 0.8}));
    return model;
}

std::string model_file(const std::string& name) { return io_test::scratch_path(name + ".json"); }

std::string text_of(const rec::object_recognizer<>& model) {
    const std::string path = model_file("text");
    rec::write_model(path, model);
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

/// What reading says to a changed file; empty if it accepts it.
std::string refusal(const std::function<void(file_json&)>& change) {
    static const std::string text = text_of(small_model());
    auto file = file_json::parse(text);
    change(file);
    try {
        static_cast<void>(rec::read_model(gnomon::io::input{"m.json", file.dump()}));
    } catch (const gnomon::error& problem) {
        EXPECT_EQ(problem.file(), "m.json");
        return problem.what();
    }
    return "";
}

TEST(json_model, round_trip_decides_the_same_to_the_last_bit) {
    const auto& model = small_model();
    const std::string path = model_file("round_trip");
    rec::write_model(path, model);
    const auto again = rec::read_model(path, gnomon::threads{2});
    EXPECT_EQ(text_of(again), text_of(model));
    const auto &a = model.learned(), &b = again.learned();
    EXPECT_EQ(a.names, b.names);
    EXPECT_EQ(a.words, b.words);
    EXPECT_EQ(a.sources, b.sources);
    EXPECT_EQ(a.samples.columns, b.samples.columns);
    EXPECT_EQ(a.samples.values, b.samples.values);
    EXPECT_EQ(a.samples.classes, b.samples.classes);
    EXPECT_EQ(a.temperature, b.temperature);
    EXPECT_EQ(a.options.trees.seed, b.options.trees.seed);
    EXPECT_EQ(a.options.min_probability, b.options.min_probability);
    gnomon::random_stream random(9);
    for (std::size_t i = 0; i < 30; ++i) {
        const rec::view v = view_of_boards(i % 4, random);
        const auto x = model.explain(v), y = again.explain(v);
        EXPECT_EQ(x.probability, y.probability);
        EXPECT_EQ(x.log_ratio, y.log_ratio);
        ASSERT_EQ(x.evidence.size(), y.evidence.size());
        for (std::size_t e = 0; e < x.evidence.size(); ++e) {
            EXPECT_EQ(x.evidence[e].log_ratio, y.evidence[e].log_ratio);
            EXPECT_EQ(x.evidence[e].word, y.evidence[e].word);
        }
    }
}

TEST(json_model, keeps_all_options) {
    const rec::object_recognizer_options all{
        .trees = {.trees = 7, .seed = 5, .features_per_split = 3, .min_split = 4},
        .max_word_distance = 0.75,
        .min_probability = 0.8};
    const auto model = taught(rec::object_recognizer<>(all));
    const auto again = rec::read_model(gnomon::io::input{"m.json", text_of(model)});
    const auto& o = again.learned().options;
    EXPECT_EQ(o.trees.trees, 7u);
    EXPECT_EQ(o.trees.seed, 5u);
    EXPECT_EQ(o.trees.features_per_split, 3u);
    EXPECT_EQ(o.trees.min_split, 4u);
    EXPECT_EQ(o.max_word_distance, 0.75);
    EXPECT_EQ(o.min_probability, 0.8);
}

TEST(json_model, learning_goes_on_as_if_it_had_not_been_interrupted) {
    auto model = small_model();
    auto again = rec::read_model(gnomon::io::input{"m.json", text_of(model)});
    gnomon::random_stream random(3);
    const rec::view more = view_of_boards(3, random);
    model.learn(more, "bench");
    again.learn(more, "bench");
    model.fit();
    again.fit();
    EXPECT_EQ(text_of(model), text_of(again));
}

TEST(json_model, numbers_of_the_file_replace_those_of_the_features) {
    auto features = rec::default_features;
    boost::hana::at_c<0>(features).scale = 0.07;
    auto relations = rec::default_relations;
    boost::hana::at_c<0>(relations).is_folded = false;
    const auto model = taught(rec::object_recognizer<>({}, features, relations, false));
    const auto again = rec::read_model(gnomon::io::input{"m.json", text_of(model)});
    EXPECT_EQ(boost::hana::at_c<0>(again.descriptor().features).scale, 0.07);
    EXPECT_FALSE(boost::hana::at_c<0>(again.descriptor().relations).is_folded);
    EXPECT_FALSE(again.descriptor().uses_profile);
}

struct own_feature {
    static constexpr std::string_view name = "points";
    double scale = 100.0, weight = 1.0;
    double operator()(const rec::part& p, const rec::view&) const {
        return static_cast<double>(p.shape.points);
    }
};

TEST(json_model, features_of_the_users_own_are_read_by_a_recognizer_that_has_them) {
    const auto features = boost::hana::append(rec::thesis_features, own_feature{});
    const rec::object_recognizer empty({}, features, rec::no_relations);
    const std::string path = model_file("own");
    rec::write_model(path, taught(empty));
    const auto again = rec::read_model(path, gnomon::sequential{}, empty);
    EXPECT_EQ(again.names(), classes);
    EXPECT_THROW(static_cast<void>(rec::read_model(path)), gnomon::error);
    const rec::object_recognizer twice({}, boost::hana::append(features, own_feature{}),
                                       rec::no_relations);
    EXPECT_THROW(rec::write_model(path, taught(twice)), std::invalid_argument);
}

TEST(json_model, another_version_or_other_features_are_refused) {
    EXPECT_EQ(refusal([](file_json&) {}), "");
    EXPECT_EQ(refusal([](file_json& f) { f["new field"] = 1; }), "");
    EXPECT_EQ(refusal([](file_json& f) { f["version"] = 2; }),
              "m.json, version: is 2; only 1 is known");
    EXPECT_NE(refusal([](file_json& f) { f["version"] = "1"; }), "");
    EXPECT_NE(refusal([](file_json& f) { f.erase("version"); }), "");
    EXPECT_NE(refusal([](file_json& f) { f = file_json::array(); }), "");
    EXPECT_NE(refusal([](file_json& f) { f["features"][0] = "color"; }), "");
    EXPECT_NE(refusal([](file_json& f) { f["features"].erase(0); }), "");
    EXPECT_NE(refusal([](file_json& f) { f["relations"].push_back("angle"); }), "");
}

TEST(json_model, every_field_is_required_and_of_its_type) {
    const auto file = file_json::parse(text_of(small_model()));
    for (const auto& [field, value] : file.items()) {
        const std::string name = field;
        EXPECT_NE(refusal([&](file_json& f) { f.erase(name); }), "") << name;
        for (const file_json& other :
             {file_json(nullptr), file_json(-1), file_json("x"), file_json(true), file_json(1.5),
              file_json::array({file_json(nullptr)}), file_json::object()}) {
            if (other.type() == value.type() || (other.is_number() && value.is_number_float()))
                continue;
            EXPECT_NE(refusal([&](file_json& f) { f[name] = other; }), "") << name << other;
        }
    }
}

TEST(json_model, numbers_that_contradict_each_other_are_refused) {
    const std::vector<std::pair<const char*, file_json>> changes{
        {"/temperature", 0.0},
        {"/temperature", -1.0},
        {"/temperature", 1e-310},
        {"/options/trees/trees", 0},
        {"/options/trees/trees", 4'000'000'000u},
        {"/options/trees/seed", 1.5},
        {"/options/min_probability", 1.5},
        {"/options/max_word_distance", -1.0},
        {"/scales/mean height", 0.0},
        {"/scales/mean height", "0.1"},
        {"/weights/mean height", -1.0},
        {"/weights",
         {{"mean height", 0},
          {"inclination", 0},
          {"longest edge", 0},
          {"middle edge", 0},
          {"shortest edge", 0},
          {"surface variation", 0},
          {"lowest height", 0},
          {"highest height", 0}}},
        {"/bins/angle", -1.0},
        {"/are_folded/angle", 1},
        {"/classes", {"one"}},
        {"/classes/0", ""},
        {"/classes/0", "background"},
        {"/words/0/count", 0},
        {"/words/0/count", 18'446'744'073'709'551'615u},
        {"/words/0/mean/0", 1e200},
        {"/words/0/mean", {1.0, 2.0}},
        {"/words/0/scatter/0/0", 1e300},
        {"/words/0/scatter/0", {1.0}},
        {"/sources/0", 1'000'000},
        {"/sources/0", 5'000'000'000u},
        {"/sources", {0}},
        {"/sources/71", 4'294'967'295u},
        {"/samples/columns", 3},
        {"/samples/classes/0", 3},
        {"/samples/classes", file_json::array()},
        {"/samples/values/0", 1e39},
        {"/samples/values", {1.0}},
    };
    for (const auto& [place, value] : changes)
        EXPECT_NE(refusal([&](file_json& f) { f[file_json::json_pointer(place)] = value; }), "")
            << place << " " << value;
}

TEST(json_model, one_class_is_refused_with_its_place) {
    EXPECT_EQ(refusal([](file_json& f) {
                  f["classes"] = {"one"};
                  for (auto& number : f["samples"]["classes"]) number = 0;
              }),
              "m.json, classes: must be two or more");
}

TEST(json_model, broken_files_are_refused_with_their_place) {
    const std::string text = text_of(small_model());
    for (std::size_t n = 0; n < text.size() - 1; n += 1 + n / 4) {
        const gnomon::io::input cut{"cut.json", text.substr(0, n)};
        EXPECT_THROW(static_cast<void>(rec::read_model(cut)), gnomon::error) << n;
    }
    const auto message_of = [](const std::string& bytes) {
        try {
            static_cast<void>(rec::read_model(gnomon::io::input{"b.json", bytes}));
        } catch (const gnomon::error& problem) {
            return std::string(problem.what());
        }
        return std::string();
    };
    EXPECT_EQ(message_of("{\"version\": }"), "b.json, byte 13: is not JSON");
    EXPECT_EQ(message_of("{\"version\": NaN}"), "b.json, byte 13: is not JSON");
    EXPECT_NE(message_of("{\"version\": 1e999}").find("not finite"), std::string::npos);
    EXPECT_NE(message_of(std::string(100'000, '[')).find("not JSON"), std::string::npos);
    EXPECT_THROW(static_cast<void>(rec::read_model(model_file("missing"))), gnomon::error);
}

/// A model that could not be read again is not written.
TEST(json_model, what_would_be_refused_is_not_written) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const std::string path = model_file("unreadable");
    std::filesystem::remove(path);
    const auto expect_refusal = [&](const auto& model, const char* place) {
        try {
            rec::write_model(path, model);
            ADD_FAILURE() << place;
        } catch (const gnomon::error& problem) {
            EXPECT_NE(std::string(problem.what()).find(place), std::string::npos);
        }
        EXPECT_FALSE(std::filesystem::exists(path));
    };
    expect_refusal(taught(rec::object_recognizer<>({.min_probability = nan})), "min_probability");
    expect_refusal(taught(rec::object_recognizer<>({.min_probability = 2.0})), "min_probability");
    expect_refusal(rec::object_recognizer<>(), "classes");
    for (const double scale : {nan, 0.0, std::numeric_limits<double>::infinity()}) {
        rec::object_recognizer empty(
            {}, boost::hana::append(rec::thesis_features, own_feature{.scale = scale}),
            rec::no_relations);
        expect_refusal(empty, "scales/points");
    }
}

TEST(json_model, what_cannot_be_written_leaves_the_file_as_it_is) {
    const std::string path = model_file("kept");
    rec::write_model(path, small_model());
    const auto size = std::filesystem::file_size(path);
    auto learned = small_model().learned();
    learned.names[0] = "\xff";
    auto broken = small_model();
    broken.restore(learned);
    EXPECT_THROW(rec::write_model(path, broken), std::invalid_argument);
    learned = small_model().learned();
    learned.samples.values[0] = 0.1;  // has no equal in single precision
    broken.restore(learned);
    EXPECT_THROW(rec::write_model(path, broken), std::invalid_argument);
    EXPECT_EQ(std::filesystem::file_size(path), size);
    EXPECT_THROW(rec::write_model(testing::TempDir() + "no_folder/m.json", small_model()),
                 gnomon::error);
}

}  // namespace
