// SPDX-License-Identifier: BSL-1.0
/// @file
/// What did the user ask for? A command line of words, checked one by one.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <vector>

#include <Eigen/Core>

/// A command line that cannot be understood.
struct usage_error : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The whole of `text` as a number in [low, high], which `range` puts in words, whatever the
/// locale.
template <class Number>
Number number_within(const std::string& option, std::string_view text, Number low, Number high,
                     const char* range) {
    Number number{};
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (problem == std::errc::result_out_of_range) {
        throw usage_error(option + ": " + std::string(text) + " is too large or too small");
    }
    if (problem != std::errc{} || end != text.data() + text.size()) {
        throw usage_error(
            option + ": '" + std::string(text) + "' is not " +
            (std::is_integral_v<Number> ? "a whole number of 0 or more" : "a number"));
    }
    if (!(number >= low && number <= high)) {
        throw usage_error(option + ": must be " + range + ", not " + std::string(text));
    }
    return number;
}

/// Three numbers with commas between.
inline Eigen::Vector3d vector_of(const std::string& option, std::string_view text) {
    Eigen::Vector3d v;
    for (int i = 0; i < 3; ++i) {
        const std::size_t comma = text.find(',');
        if ((comma == text.npos) != (i == 2)) throw usage_error(option + ": requires X,Y,Z");
        v[i] = number_within(option, text.substr(0, comma), -1e9, 1e9, "within 1e9 m");
        if (i < 2) text.remove_prefix(comma + 1);
    }
    return v;
}

/// The seed of all that is random.
inline std::uint64_t seed_of(const std::string& option, std::string_view text) {
    constexpr std::uint64_t last = std::numeric_limits<std::uint64_t>::max();
    return number_within<std::uint64_t>(option, text, 0, last, "0 or more");
}

/// An option: its name, whether a value follows, and the function that stores it.
template <class Options>
struct option {
    const char* name;
    bool has_value;
    void (*set)(Options& o, const std::string& name, const std::string& value);
};

/// Reads the words of the command line; values come as `--name VALUE` or `--name=VALUE`.
/// @param positional  stores an argument that is no option
/// @return nothing if the user asked for help
/// @throws usage_error  for an argument that is not understood, or without a directory to write to
template <class Options>
std::optional<Options> options_from(const std::vector<std::string>& words,
                                    std::span<const option<Options>> known,
                                    void (*positional)(Options& o, const std::string& word)) {
    Options o;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i];
        if (word == "--help" || word == "-h") return std::nullopt;
        if (!word.starts_with("-")) {
            positional(o, word);
            continue;
        }
        const std::size_t equals = word.find('=');
        const std::string name = word.substr(0, equals);
        const auto found = std::ranges::find(known, name, &option<Options>::name);
        if (found == known.end()) throw usage_error("no such option: " + word);
        const bool in_this_word = equals != word.npos;
        if (!found->has_value) {
            if (in_this_word) throw usage_error(name + ": takes no value");
            found->set(o, name, "");
        } else if (in_this_word) {
            found->set(o, name, word.substr(equals + 1));
        } else {
            if (i + 1 == words.size() || words[i + 1].starts_with("--")) {
                throw usage_error(name + ": its value is missing");
            }
            found->set(o, name, words[++i]);
        }
    }
    if (o.out.empty()) {
        std::string what = "DIR";  // of the usage
        if constexpr (requires { Options::name_of_out; }) what = Options::name_of_out;
        throw usage_error("--out " + what + " is missing");
    }
    return o;
}

/// A word that is no option, as the scan to read.
template <class Options>
void take_scan(Options& o, const std::string& word) {
    if (!o.scan.empty()) throw usage_error("two scans: " + o.scan + " and " + word);
    if (word.empty()) throw usage_error("the name of the scan is empty");
    o.scan = word;
}

/// Options of several programs, each for those whose options have the member that it fills.
namespace common {

template <class Options>
inline constexpr option<Options> out{
    "--out", true, [](Options& o, const std::string&, const std::string& value) { o.out = value; }};

template <class Options>
inline constexpr option<Options> model{
    "--model", true, [](Options& o, const std::string& name, const std::string& value) {
        if (value.empty()) throw usage_error(name + ": its value is missing");
        o.model = value;
    }};

template <class Options>
inline constexpr option<Options> k{
    "--k", true, [](Options& o, const std::string& name, const std::string& value) {
        o.k = number_within<std::size_t>(name, value, 3, 10'000, "from 3 to 10,000");
    }};

template <class Options>
inline constexpr option<Options> sigma{
    "--sigma", true, [](Options& o, const std::string& name, const std::string& value) {
        o.sigma = number_within(name, value, 1e-6, 10.0, "from 1e-6 to 10");
    }};

template <class Options>
inline constexpr option<Options> threads{
    "--threads", true, [](Options& o, const std::string& name, const std::string& value) {
        o.threads.n = number_within(name, value, 0u, 1024u, "from 0 to 1,024");
    }};

}  // namespace common
