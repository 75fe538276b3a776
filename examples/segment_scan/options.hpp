// SPDX-License-Identifier: BSL-1.0
/// @file
/// What can one ask segment_scan for? Its command line, checked word by word.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <vector>

#include <Eigen/Core>

#include <gnomon/gnomon.hpp>

inline constexpr const char* usage =
    R"(usage: segment_scan [SCAN] --out DIR [options]

Segments SCAN (PLY, PCD, VTK or text) into smooth surfaces; without SCAN, a simulated
one. Writes normals.ply, segments.ply, segments.png and segments.json into DIR.

  --k N               neighbors per point (50)
  --max-angle DEG     largest angle between normals of neighbors (5)
  --max-distance M    no link between points is longer (0.30)
  --min-points N      smaller segments are noise (30)
  --viewpoint X,Y,Z   where the sensor stood (what SCAN says, else 0,0,0)
  --remove-floor      leave out floor and ceiling
  --up X,Y,Z          against gravity (0,0,1)
  --threads N         0 for all there are (0)
  --help              this text
)";

/// A command line that cannot be understood.
struct usage_error : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct options {
    std::string scan;  ///< path, or empty for the simulated one
    std::string out;
    gnomon::knn neighborhood{.ties = gnomon::tie_rule::all};
    gnomon::surface_segmentation segmentation;
    std::optional<Eigen::Vector3d> viewpoint;
    std::optional<Eigen::Vector3d> up;  ///< unit length
    bool remove_floor = false;
    gnomon::threads threads;
    bool help = false;
};

namespace detail {

/// The whole of `text` as a number, whatever the locale.
template <class Number>
Number number_of(const std::string& option, std::string_view text) {
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
    return number;
}

/// The same, and in [low, high], which `range` puts in words.
template <class Number>
Number number_within(const std::string& option, std::string_view text, Number low, Number high,
                     const char* range) {
    const Number number = number_of<Number>(option, text);
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
        if ((comma == text.npos) != (i == 2)) throw usage_error(option + ": wants X,Y,Z");
        v[i] = number_within(option, text.substr(0, comma), -1e9, 1e9, "within 1e9 m");
        if (i < 2) text.remove_prefix(comma + 1);
    }
    return v;
}

/// An option that is followed by a value, and what becomes of it.
struct option_with_value {
    const char* name;
    void (*set)(options& o, const std::string& name, const std::string& value);
};

inline constexpr option_with_value options_with_value[] = {
    {"--out", [](options& o, const std::string&, const std::string& value) { o.out = value; }},
    {"--k",
     [](options& o, const std::string& name, const std::string& value) {
         o.neighborhood.k =
             number_within<std::size_t>(name, value, 1, 100'000, "from 1 to 100,000");
     }},
    {"--max-angle",
     [](options& o, const std::string& name, const std::string& value) {
         o.segmentation.max_angle =
             gnomon::degrees(number_within(name, value, 0.0, 90.0, "from 0 to 90"));
     }},
    {"--max-distance",
     [](options& o, const std::string& name, const std::string& value) {
         constexpr double infinity = std::numeric_limits<double>::infinity();
         o.segmentation.max_distance = number_within(name, value, 0.0, infinity, "0 or more");
     }},
    {"--min-points",
     [](options& o, const std::string& name, const std::string& value) {
         o.segmentation.min_points =
             number_within<std::size_t>(name, value, 1, 1'000'000'000, "from 1 to 1,000,000,000");
     }},
    {"--viewpoint", [](options& o, const std::string& name,
                       const std::string& value) { o.viewpoint = vector_of(name, value); }},
    {"--up",
     [](options& o, const std::string& name, const std::string& value) {
         o.up = vector_of(name, value).stableNormalized();
         if (!(o.up->norm() > 0.5)) throw usage_error("--up: 0,0,0 is no direction");
     }},
    {"--threads",
     [](options& o, const std::string& name, const std::string& value) {
         o.threads.n = number_within(name, value, 0u, 1024u, "from 0 to 1,024");
     }},
};

}  // namespace detail

/// Reads the words of the command line; values come as `--name VALUE` or `--name=VALUE`.
/// @throws usage_error  if there is a word that makes no sense
inline options options_from(const std::vector<std::string>& words) {
    options o;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i];
        if (word == "--help" || word == "-h") {
            o.help = true;
            return o;
        }
        if (word == "--remove-floor") {
            o.remove_floor = true;
            continue;
        }
        if (!word.starts_with("-")) {
            if (!o.scan.empty()) throw usage_error("two scans: " + o.scan + " and " + word);
            if (word.empty()) throw usage_error("the name of the scan is empty");
            o.scan = word;
            continue;
        }
        const std::size_t equals = word.find('=');
        const std::string name = word.substr(0, equals);
        const auto option =
            std::ranges::find(detail::options_with_value, name, &detail::option_with_value::name);
        if (option == std::end(detail::options_with_value)) {
            throw usage_error("no such option: " + word);
        }
        const bool in_next_word = equals == word.npos;
        if (in_next_word && (i + 1 == words.size() || words[i + 1].starts_with("--"))) {
            throw usage_error(name + ": its value is missing");
        }
        option->set(o, name, in_next_word ? words[++i] : word.substr(equals + 1));
    }
    if (o.out.empty()) throw usage_error("--out DIR is missing");
    return o;
}
