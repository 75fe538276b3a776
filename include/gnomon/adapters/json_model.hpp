// SPDX-License-Identifier: BSL-1.0
/// @file
/// Files of trained object_recognizers, in JSON by nlohmann-json. The trees are not in
/// them: they are grown again from the samples, the same to the last bit. Link with gnomon::json.
///
///     namespace rec = gnomon::recognition;
///     rec::write_model("model.json", model);
///     const auto model = rec::read_model("model.json", gnomon::threads{});
///     const auto mine = rec::read_model("model.json", run, rec::object_recognizer({}, features));
///
/// Version 1: {"version", "features", "scales", "weights", "relations", "bins", "masses",
/// "min_deviations", "are_folded", "profile", "options", "temperature", "classes", "words",
/// "sources", "samples"}. Samples are in single precision, to which the recognizer rounds them.
/// Other members of features and relations are not in the file, other fields of it are ignored.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <set>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include <gnomon/adapters/detail/json_fields.hpp>
#include <gnomon/adapters/detail/model_fields.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/io/input.hpp>
#include <gnomon/io/output_file.hpp>
#include <gnomon/recognition/cluster.hpp>
#include <gnomon/recognition/object_recognizer.hpp>
#include <gnomon/recognition/part_feature.hpp>

namespace gnomon::recognition {

namespace detail {

inline constexpr std::uint64_t model_version = 1;

/// The checks of restore(), and bounds of options, with the place in the file.
template <class Recognizer>
void require_usable(const json_place& file, const Recognizer& made,
                    const typename Recognizer::content& c) {
    constexpr std::size_t most_trees = 1'000'000;  // performance only
    const json_place options = file["options"];
    options["trees"]["trees"].require(
        c.options.trees.trees >= 1 && c.options.trees.trees <= most_trees,
        "must be from 1 to 1,000,000");
    options["min_probability"].require(
        c.options.min_probability >= 0.0 && c.options.min_probability <= 1.0,
        "must be from 0 to 1");
    options["max_word_distance"].require(
        c.options.max_word_distance >= 0.0 && std::isfinite(c.options.max_word_distance),
        "must be finite and not negative");
    file["temperature"].require(c.temperature > 0.0, "must be positive");
    double weights = 0.0;
    for (const double w : feature_weights(made.descriptor().features)) weights += w;
    file["weights"].require(weights > 0.0 && std::isfinite(weights),
                            "must not be all 0, nor of infinite sum");
    file["classes"].require(c.names.size() > 1, "must be two or more");
    const std::set<std::string> names(c.names.begin(), c.names.end());
    file["classes"].require(names.size() == c.names.size() && !names.contains(""),
                            "must have different names that are not empty");
    for (std::size_t w = 0; w < c.words.size(); ++w)
        file["words"][w].require(c.words[w].count > 0 && is_finite_cluster(c.words[w]),
                                 "is empty, or its numbers are too large");
    const json_place samples = file["samples"];
    const std::size_t columns = made.descriptor().describe({}, {}, {}, false).size();
    samples["columns"].require(c.samples.columns == columns,
                               "must be " + std::to_string(columns) + " with these features");
    samples["values"].require(c.samples.values.size() == columns * c.samples.rows(),
                              "must be rows times columns");
    for (const std::uint32_t number : c.samples.classes)
        samples["classes"].require(number < c.names.size(), "has the number of a missing class");
    file["sources"].require(
        c.sources.size() == c.samples.rows() && std::is_sorted(c.sources.begin(), c.sources.end()),
        "must have an entry for each sample, ascending");
}

/// The double with the fewest digits that is this number in single precision.
[[nodiscard]] inline double with_few_digits(double x) {
    std::array<char, 32> digits{};
    const auto single = static_cast<float>(x);
    gnomon::detail::require(static_cast<double>(single) == x,
                            "write_model: a sample is not in single precision");
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), single).ptr;
    double few = 0.0;
    std::from_chars(digits.data(), end, few);
    return static_cast<float>(few) == single ? few : x;
}

}  // namespace detail

/// Writes what a recognizer has learned, atomically: a file of that name is replaced or stays as it
/// is.
/// @throws gnomon::error          with the operating system's message; or for less than two classes
///                                or numbers that are not finite or contradict each other, which
///                                read_model() would refuse, with their place
/// @throws std::invalid_argument  if two features or two relations have the same name, a class name
///                                is not UTF-8, or a sample is not in single precision, as
///                                restore() may have left it
template <class Features, class Relations>
void write_model(const std::string& path, const object_recognizer<Features, Relations>& model) {
    detail::json file{{"version", detail::model_version}};
    detail::write_policies(file, "features", model.descriptor().features);
    detail::write_policies(file, "relations", model.descriptor().relations);
    file["profile"] = model.descriptor().uses_profile;
    auto learned = model.learned();
    for (double& x : learned.samples.values) x = detail::with_few_digits(x);
    detail::write_fields(file, learned);
    // The checks of read_model(), which would otherwise refuse what is written.
    Features features = model.descriptor().features;
    Relations relations = model.descriptor().relations;
    const detail::json_place place(path, file);
    detail::read_policies(place, "features", features);
    detail::read_policies(place, "relations", relations);
    detail::require_usable(place, model, learned);
    std::string text;
    try {
        text = file.dump(-1, ' ', false, detail::json::error_handler_t::strict) + "\n";
    } catch (const detail::json::exception&) {
        throw std::invalid_argument("write_model: the name of a class is not UTF-8");
    }
    io::replace_file(path, text);
}

/// Reads a model, and grows its trees. Scales, weights and the numbers of the relations are those
/// of the file.
/// @param file  path of the file, or its name and contents
/// @param run   the result does not depend on it
/// @param like  a recognizer with the features and relations of the file
/// @return what decides as the recognizer that was written, to the last bit
/// @throws gnomon::error  with file and place: if the file cannot be read, is no JSON, has another
///                        version or other features or relations, lacks a field, has one of another
///                        type, or numbers that contradict each other. All is checked before a
///                        recognizer is made
/// Complexity: O(file), and that of the trees.
template <execution X = sequential, class Features = std::remove_cv_t<decltype(default_features)>,
          class Relations = std::remove_cv_t<decltype(default_relations)>>
[[nodiscard]] object_recognizer<Features, Relations> read_model(
    const io::input& file, const X& run = {},
    const object_recognizer<Features, Relations>& like = object_recognizer<Features, Relations>{}) {
    detail::json parsed;
    try {
        parsed = detail::json::parse(file.bytes);
    } catch (const detail::json::parse_error& problem) {
        throw error(file.name, "byte " + std::to_string(problem.byte), "is not JSON");
    } catch (const detail::json::exception&) {
        throw error(file.name, "", "has a number that is not finite in double precision");
    }
    const detail::json_place place(file.name, parsed);
    std::uint64_t version = 0;
    place["version"].read(version);
    place["version"].require(version == detail::model_version,
                             "is " + std::to_string(version) + "; only " +
                                 std::to_string(detail::model_version) + " is known");
    Features features = like.descriptor().features;
    Relations relations = like.descriptor().relations;
    detail::read_policies(place, "features", features);
    detail::read_policies(place, "relations", relations);
    bool uses_profile = false;
    place["profile"].read(uses_profile);
    typename object_recognizer<Features, Relations>::content learned;
    place.read(learned);
    for (double& x : learned.samples.values) x = static_cast<double>(static_cast<float>(x));

    object_recognizer<Features, Relations> model(learned.options, std::move(features),
                                                 std::move(relations), uses_profile);
    detail::require_usable(place, model, learned);
    try {
        model.restore(std::move(learned), run);
    } catch (const std::invalid_argument& problem) {
        throw error(file.name, "", problem.what());
    }
    return model;
}
/// The same, of a path.
template <execution X = sequential, class Features = std::remove_cv_t<decltype(default_features)>,
          class Relations = std::remove_cv_t<decltype(default_relations)>>
[[nodiscard]] object_recognizer<Features, Relations> read_model(
    const std::string& path, const X& run = {},
    const object_recognizer<Features, Relations>& like = object_recognizer<Features, Relations>{}) {
    return read_model(io::load(path), run, like);
}

}  // namespace gnomon::recognition
