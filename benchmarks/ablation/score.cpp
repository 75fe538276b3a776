// SPDX-License-Identifier: BSL-1.0
// The scores of one variant of the default chain, a library that chain.cpp is compiled to: in
// furnished rooms, and on scans without ground truth. One JSON object per line.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "../../examples/common/help.hpp"
#include "../surfaces/furnished.hpp"
#include "../surfaces/scores.hpp"
#include "chain.hpp"
#include <dlfcn.h>

namespace {

/// What the command line selects.
struct selection {
    std::string chain;  // a library
    std::uint64_t first = 30'001, rooms = 1;
    bool merges = true;
    bool is_noise_true = false;  // the chain is given that of each room
    chain_options options;
    std::vector<std::filesystem::path> scans;
};

class loaded_chain {
  public:
    /// @throws std::runtime_error  if the file is no such library
    explicit loaded_chain(const std::string& file) {
        const std::string path = std::filesystem::absolute(file).string();
        void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (library != nullptr)
            perceive_ = reinterpret_cast<decltype(&perceive)>(dlsym(library, "perceive"));
        if (perceive_ == nullptr) throw std::runtime_error(dlerror());
    }

    [[nodiscard]] chain_result operator()(const gnomon::scan& scan,
                                          const chain_options& options) const {
        chain_result result;
        perceive_(scan, options, result);
        return result;
    }

  private:
    decltype(&perceive) perceive_ = nullptr;
};

void print_room(const loaded_chain& chain, const selection& chosen, std::uint64_t seed,
                double noise) {
    constexpr std::size_t fewest = 100;  // points of a surface that counts
    const setting how{noise, "whole", "rotational"};
    const sim::scene world = furnished(seed);
    const sim::bvh_caster caster(world);
    const sim::true_scan truth = scan_of(world, caster, how, 1000 * seed + 1);
    chain_options options = chosen.options;
    options.leaves_out_floor = true;
    if (chosen.is_noise_true) options.noise = how.sigma();
    const chain_result seen = chain(truth.scan, options);
    const gnomon::segments parts(seen.initial), found(chosen.merges ? seen.merged : seen.initial);
    const joined_surfaces surfaces(truth, seen.kept);
    const auto scores = recovered(surfaces, seen.kept, found, fewest);
    const merge_tally merging = merging_of(caster, truth, surfaces, parts, found).by_points;
    std::printf(
        "{\"noise [mm]\": %g, \"seed\": %llu, \"IoU\": %.5f, \"by points\": %.5f, "
        "\"impurity\": %.5f, \"wanted\": %.0f, \"right\": %.0f, \"wrong\": %.0f}\n",
        noise, static_cast<unsigned long long>(seed), mean_iou(scores, false),
        mean_iou(scores, true), impurity(surfaces, seen.kept, found), merging.wanted, merging.right,
        merging.wrong);
}

void print_scan(const loaded_chain& chain, const selection& chosen,
                const std::filesystem::path& file) {
    constexpr std::size_t fewest = 30;  // points of a segment that counts
    const gnomon::scan scan = gnomon::io::read(file.string());
    const chain_result seen = chain(scan, chosen.options);
    const gnomon::segments found(chosen.merges ? seen.merged : seen.initial);
    std::size_t segments = 0, labeled = 0;
    for (std::size_t s = 0; s < found.size(); ++s) {
        segments += found[s].size() >= fewest ? 1 : 0;
        labeled += found[s].size();
    }
    const auto points = std::ranges::count_if(
        scan.points, [](const Eigen::Vector3d& p) { return gnomon::is_finite(p); });
    std::printf("{\"scan\": \"%s\", \"segments\": %zu, \"labeled\": %zu, \"points\": %td}\n",
                file.stem().string().c_str(), segments, labeled, points);
}

/// Selects what --without names.
/// @return whether there is such a step
bool leave_out(selection& chosen, std::string_view step) {
    if (step == "merging")
        chosen.merges = false;
    else if (step == "narrow_gaps")
        chosen.options.closes_narrow_gaps = false;
    else
        return false;
    return true;
}

/// The whole number that a word is, or 0.
std::uint64_t number(const std::string& word) { return std::strtoull(word.c_str(), nullptr, 10); }

/// @return nothing for words that make no sense
std::optional<selection> selection_of(const std::vector<std::string>& words) {
    selection chosen;
    for (std::size_t i = 0; i + 1 < words.size(); ++i) {
        const std::string& option = words[i];
        const std::string& value = words[++i];
        if (option == "--chain") {
            chosen.chain = value;
        } else if (option == "--seeds" && i + 1 < words.size() && number(value) > 0) {
            chosen.first = number(value);
            chosen.rooms = number(words[++i]);
        } else if (option == "--noise" && (value == "true" || number(value) > 0)) {
            chosen.is_noise_true = value == "true";
            chosen.options.noise = 1e-3 * static_cast<double>(number(value));
        } else if (option == "--scan") {
            chosen.scans.push_back(value);
        } else if (option != "--without" || !leave_out(chosen, value)) {
            return std::nullopt;
        }
        if (i + 2 == words.size()) return std::nullopt;  // an option without its value
    }
    if (chosen.chain.empty() || chosen.rooms == 0) return std::nullopt;
    return chosen;
}

}  // namespace

int main(int argc, char** argv) {
    const char* const arguments =
        " --chain LIBRARY [--seeds FIRST COUNT] [--noise MM|true]\n"
        "    [--without merging|narrow_gaps]... [--scan FILE]...";
    if (printed_help(argc, argv, "Prints the scores of a chain, one JSON object per line.",
                     arguments))
        return 0;
    const auto chosen = selection_of({argv + 1, argv + argc});
    if (!chosen) {
        std::fputs(usage_of(argv[0], arguments).c_str(), stderr);
        return 2;
    }
    try {
        const loaded_chain chain(chosen->chain);
        for (const double noise : noises)
            for (std::uint64_t r = 0; r < chosen->rooms; ++r)
                print_room(chain, *chosen, chosen->first + r, noise);
        for (const auto& file : chosen->scans) print_scan(chain, *chosen, file);
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "%s: %s\n", argv[0], problem.what());
        return 1;
    }
    return 0;
}
