// SPDX-License-Identifier: BSL-1.0
/// @file
/// The fields of a trained object_recognizer, and the numbers of its features and
/// relations, in a model file.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <boost/hana/for_each.hpp>
#include <boost/hana/pair.hpp>
#include <boost/hana/tuple.hpp>

#include <gnomon/adapters/detail/json_fields.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/recognition/cluster.hpp>
#include <gnomon/recognition/object_recognizer.hpp>
#include <gnomon/recognition/random_trees.hpp>

namespace gnomon::recognition::detail {

template <>
inline constexpr auto json_fields<random_trees_options> = boost::hana::make_tuple(
    boost::hana::make_pair("trees", &random_trees_options::trees),
    boost::hana::make_pair("seed", &random_trees_options::seed),
    boost::hana::make_pair("features_per_split", &random_trees_options::features_per_split),
    boost::hana::make_pair("min_split", &random_trees_options::min_split));

template <>
inline constexpr auto json_fields<object_recognizer_options> = boost::hana::make_tuple(
    boost::hana::make_pair("trees", &object_recognizer_options::trees),
    boost::hana::make_pair("max_word_distance", &object_recognizer_options::max_word_distance),
    boost::hana::make_pair("min_probability", &object_recognizer_options::min_probability));

template <std::size_t D>
inline constexpr auto json_fields<cluster_statistics<D>> =
    boost::hana::make_tuple(boost::hana::make_pair("count", &cluster_statistics<D>::count),
                            boost::hana::make_pair("mean", &cluster_statistics<D>::mean),
                            boost::hana::make_pair("scatter", &cluster_statistics<D>::scatter));

template <>
inline constexpr auto json_fields<labeled_samples> =
    boost::hana::make_tuple(boost::hana::make_pair("columns", &labeled_samples::columns),
                            boost::hana::make_pair("classes", &labeled_samples::classes),
                            boost::hana::make_pair("values", &labeled_samples::values));

/// The members of object_recognizer<...>::content.
template <class Content>
    requires requires(Content c) { c.words, c.samples, c.sources; }
inline constexpr auto json_fields<Content> =
    boost::hana::make_tuple(boost::hana::make_pair("options", &Content::options),
                            boost::hana::make_pair("temperature", &Content::temperature),
                            boost::hana::make_pair("classes", &Content::names),
                            boost::hana::make_pair("words", &Content::words),
                            boost::hana::make_pair("sources", &Content::sources),
                            boost::hana::make_pair("samples", &Content::samples));

/// Calls f(list, value) for the numbers of a feature or a relation that values of views depend on.
inline constexpr auto for_each_number = [](auto& policy, auto&& f) {
    if constexpr (requires { policy.scale; }) f("scales", policy.scale);
    if constexpr (requires { policy.weight; }) f("weights", policy.weight);
    if constexpr (requires { policy.bin; }) f("bins", policy.bin);
    if constexpr (requires { policy.mass; }) f("masses", policy.mass);
    if constexpr (requires { policy.min_deviation; }) f("min_deviations", policy.min_deviation);
    if constexpr (requires { policy.is_folded; }) f("are_folded", policy.is_folded);
};

/// Adds the names of policies as a list, and each of their numbers to a list by name.
/// @throws std::invalid_argument  if two have the same name
void write_policies(json& file, const char* list, const auto& policies) {
    file[list] = json::array();
    boost::hana::for_each(policies, [&](const auto& policy) {
        const std::string name(policy.name);
        gnomon::detail::require(
            std::find(file[list].begin(), file[list].end(), name) == file[list].end(),
            "write_model: two features or relations have the same name");
        file[list].push_back(name);
        for_each_number(
            policy, [&](const char* numbers, const auto& value) { file[numbers][name] = value; });
    });
}

/// Takes over the numbers of policies of the same names in the same order.
void read_policies(const json_place& file, const char* list, auto& policies) {
    std::vector<std::string> names, expected;
    file[list].read(names);
    boost::hana::for_each(policies,
                          [&](const auto& policy) { expected.emplace_back(policy.name); });
    file[list].require(names == expected, "are others than those of this recognizer");
    boost::hana::for_each(policies, [&](auto& policy) {
        const std::string name(policy.name);
        for_each_number(policy, [&](const char* numbers, auto& value) {
            file[numbers][name].read(value);
            if constexpr (!std::same_as<std::remove_cvref_t<decltype(value)>, bool>) {
                const bool is_scale = std::string_view(numbers) == "scales";
                file[numbers][name].require(
                    std::isfinite(value) && (value > 0.0 || (value == 0.0 && !is_scale)),
                    is_scale ? "must be finite and positive" : "must be finite, not negative");
            }
        });
    });
}

}  // namespace gnomon::recognition::detail
