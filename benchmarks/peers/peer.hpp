// SPDX-License-Identifier: BSL-1.0
/// @file
/// The frame of a program that runs one library when it reads a line, so that the programs of
/// several libraries can take turns. It includes no header of gnomon: every program contains its
/// library alone.
///     PROGRAM                             prints in JSON its library and the jobs that it has
///     PROGRAM JOB DIRECTORY REACH THREADS runs a job on the cloud in a directory: once at the
///                                         start, as a warm-up, and prints memory and quality; then
///                                         once for each line that it reads, and prints the seconds
/// REACH is k, or for clusters the radius.
#pragma once

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <iterator>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "../../examples/common/help.hpp"
#include "peak_memory.hpp"
#include "vectors.hpp"

namespace peers {

/// The parameters of a job.
struct request {
    double reach;      ///< k, or a radius [m]
    unsigned threads;  ///< at most

    /// Neighbors of a point, itself not counted.
    [[nodiscard]] std::size_t k() const { return static_cast<std::size_t>(reach); }

    /// Neighbors are at most this far away [m].
    [[nodiscard]] double radius() const { return reach; }
};

/// Whether the parameter of a task is a radius; else it is k.
constexpr bool takes_radius(std::string_view task) { return task == "clusters"; }

/// Smaller segments are noise, of the task "surfaces"; and how far normals of neighbors may differ.
inline constexpr std::size_t min_points = 30;
inline constexpr double max_angle = 5.0 * std::numbers::pi / 180.0;

/// A task done by a library. The constructor copies the points into the container of the library
/// and is not timed; the call is timed. Optional functions evaluate the result and are not timed:
/// `normal(result, i)`, `segment_count(result)`, `last_neighbor(result, i)`, which is the farthest
/// of the k, and `bytes(result)`, the memory of the result.
template <class J>
concept job = std::constructible_from<J, const vectors&> && requires(J& work, request r) {
    { J::task } -> std::convertible_to<std::string_view>;
    { J::library } -> std::convertible_to<std::string_view>;
    { J::one_thread_only } -> std::convertible_to<bool>;
    work(r);
};

namespace detail {

/// Eq. (3.12) of the thesis: the mean of |<n, truth>|, a missing normal counting as 0.
template <job J>
double gamma(const auto& result, const vectors& truth) {
    double sum = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const double g = std::abs(J::normal(result, i).dot(truth[i]));
        if (g <= 1.5) sum += g;  // not NaN
    }
    return sum / static_cast<double>(truth.size());
}

/// The mean distance to the last neighbor [m].
template <job J>
double last_distance(const auto& result, const vectors& points) {
    double sum = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        sum += (points[J::last_neighbor(result, i)] - points[i]).norm();
    }
    return sum / static_cast<double>(points.size());
}

/// Prints in JSON the quality and the size of the result.
template <job J>
void print_quality(const auto& result, const vectors& points, const std::string& directory) {
    if constexpr (requires { J::bytes(result); }) {
        std::printf(", \"result_bytes\": %zu", std::size_t{J::bytes(result)});
    }
    if constexpr (requires { J::normal(result, 0); }) {
        const vectors truth = read_vectors(directory + "/normals");
        if (!truth.empty()) std::printf(", \"gamma\": %.6f", gamma<J>(result, truth));
    }
    if constexpr (requires { J::segment_count(result); }) {
        std::printf(", \"segments\": %zu", std::size_t{J::segment_count(result)});
    }
    if constexpr (requires { J::last_neighbor(result, 0); }) {
        std::printf(", \"last_distance\": %.9f", last_distance<J>(result, points));
    }
}

inline constexpr std::ptrdiff_t few_points = 1000;

template <job J>
void do_job(const std::string& directory, const request& r) {
    const vectors points = read_vectors(directory + "/points");
    {
        // Code is loaded and threads are started on a small cloud, so as not to count as memory.
        const vectors few(points.begin(),
                          points.begin() + std::min(std::ssize(points), few_points));
        J work(few);
        work(r);
    }
    J work(points);
    {
        const peak_memory peak;
        const auto result = work(r);
        std::printf("{\"peak_bytes\": %zu, \"process_bytes\": %zu", peak.above(), peak.total());
        print_quality<J>(result, points, directory);
    }
    std::puts("}");
    std::fflush(stdout);

    while (std::getchar() != EOF) {  // the line feed
        const auto start = std::chrono::steady_clock::now();
        const auto result = work(r);
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
        std::printf("%.6f\n", taken.count());
        std::fflush(stdout);
    }
}

template <job J>
std::string id() {
    return std::string(J::task) + "/" + J::library;
}

template <class Number>
std::optional<Number> number(std::string_view text) {
    Number n{};
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), n);
    const bool good = problem == std::errc{} && end == text.data() + text.size() && n > 0;
    return good ? std::optional(n) : std::nullopt;
}

/// k or a radius, depending on the job.
inline std::optional<double> reach_of(std::string_view job, std::string_view text) {
    if (takes_radius(job.substr(0, job.find('/')))) return number<double>(text);
    const auto k = number<std::uint32_t>(text);
    return k ? std::optional<double>(*k) : std::nullopt;
}

}  // namespace detail

/// The whole of main.
template <job... Jobs>
int serve(const std::string& version, int argc, char** argv) {
    const std::size_t count = sizeof...(Jobs);
    const std::string arguments = " [JOB DIRECTORY REACH THREADS]";
    const std::string jobs = "JOB:" + ((" '" + detail::id<Jobs>() + "'") + ...);
    if (printed_help(argc, argv,
                     "Runs a job on the cloud in DIRECTORY, once for each line on stdin; without "
                     "arguments, prints in JSON what it has. " +
                         jobs,
                     arguments))
        return 0;
    if (argc == 1) {
        std::printf(R"({"version": "%s", "compiler": "%s", "flags": "%s", "jobs": [)",
                    version.c_str(), PEERS_COMPILER, PEERS_FLAGS);
        std::size_t listed = 0;
        ((std::printf(R"({"task": "%s", "library": "%s", "one_thread_only": %s}%s)", Jobs::task,
                      Jobs::library, Jobs::one_thread_only ? "true" : "false",
                      ++listed < count ? ", " : "]}\n")),
         ...);
        return 0;
    }
    const auto reach = detail::reach_of(argc == 5 ? argv[1] : "", argc == 5 ? argv[3] : "");
    const auto threads = detail::number<unsigned>(argc == 5 ? argv[4] : "");
    if (!reach || !threads || !((argv[1] == detail::id<Jobs>()) || ...)) {
        std::fprintf(stderr, "%s%s\n", usage_of(argv[0], arguments).c_str(), jobs.c_str());
        return 2;
    }
    try {
        ((argv[1] == detail::id<Jobs>() ? detail::do_job<Jobs>(argv[2], {*reach, *threads})
                                        : void()),
         ...);
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "%s: %s\n", argv[0], problem.what());
        return 1;
    }
    return 0;
}

}  // namespace peers
