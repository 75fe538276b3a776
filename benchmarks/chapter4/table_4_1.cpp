// SPDX-License-Identifier: BSL-1.0
// Table 4.1: the times of the steps on eight scans, on one thread, and their results, by the chain
// of the thesis and by the default one. Also counted are the changes by a second run of merging,
// and the seats of different chairs that are one segment after merging by both chains and by
// Alg. 4.3 as printed.
#include <algorithm>
#include <map>
#include <set>

#include "rooms.hpp"

namespace {

/// The segment that holds most of each seat, if one holds half of it.
std::vector<std::int32_t> segments_of_seats(const gnomon::simulation::scene& world,
                                            const gnomon::simulation::true_scan& truth,
                                            const gnomon::segments& parts) {
    std::vector<std::int32_t> found;
    for (std::size_t s = 0; s < world.surfaces().size(); ++s) {
        const auto number = static_cast<std::int32_t>(s);
        if (!world.surface_name(number).ends_with("/seat/+z")) continue;
        std::size_t points = 0;
        for (const auto surface : truth.surfaces) points += surface == number ? 1 : 0;
        std::vector<std::size_t> held(parts.size(), 0);
        for (std::size_t label = 0; label < parts.size(); ++label)
            for (const auto i : parts[label]) held[label] += truth.surfaces[i] == number ? 1 : 0;
        const auto most = std::max_element(held.begin(), held.end());
        if (most != held.end() && 2 * *most > points)
            found.push_back(static_cast<std::int32_t>(most - held.begin()));
    }
    return found;
}

/// How many seats share a segment with another.
std::size_t shared(const std::vector<std::int32_t>& segments) {
    return segments.size() - std::set<std::int32_t>(segments.begin(), segments.end()).size();
}

/// The times of a chain over passes, by step [s].
class pass_times {
  public:
    void add(const perceived& seen) {
        for (const auto& step : seen.steps)
            of_step_[std::string(step.name)].push_back(step.seconds);
        all_.push_back(seen.seconds());
    }
    [[nodiscard]] double median(const char* step) const {
        return rounded(median_of(of_step_.at(step)), 5);
    }
    [[nodiscard]] double median_of_all() const { return rounded(median_of(all_), 5); }

  private:
    std::map<std::string, std::vector<double>> of_step_;
    std::vector<double> all_;
};

/// perceive(truth), measured again after a warm-up.
perceived timed(pass_times& times, const effort& much, auto&& perceive,
                const gnomon::simulation::true_scan& truth) {
    perceived seen = perceive(truth);  // warms up
    for (int pass = 0; pass < much.passes(); ++pass) times.add(perceive(truth));
    return seen;
}

std::ptrdiff_t gaps_closed(const perceived& seen) {
    return std::ranges::count_if(seen.gaps,
                                 [](const gnomon::considered_gap& gap) { return gap.merged; });
}

/// The chain of the thesis. The search tree counts as part of the normals, which need it first; the
/// noise is given, and the planes of surfaces are not in the thesis.
json row_of_thesis(const dataset& d, const gnomon::simulation::true_scan& truth,
                   const effort& much) {
    pass_times times;
    const perceived seen = timed(times, much, perceive_as_thesis, truth);
    const gnomon::constant_noise noise{noise_of_rooms};
    const gnomon::visibility visible(truth.scan, {.noise = noise});
    const auto merged = [&](const gnomon::segments& parts) {
        return gnomon::merge_occluded(truth.scan, parts, visible, gnomon::conservative{},
                                      {.noise = noise})
            .segments;
    };
    const gnomon::segments once = merged(seen.initial_segments), again = merged(once);
    const gnomon::segments literal =
        gnomon::merge_occluded_literally(truth.scan, seen.initial_segments, visible);
    const auto seats = segments_of_seats(d.world, truth, seen.surfaces);
    return {
        {"data set", d.name},
        {"n", truth.scan.size()},
        {"t_s", rounded(d.seconds(), 3)},
        {"n_pp", seen.kept.size()},
        {"t_pp", times.median("floor")},
        {"t_nve", rounded(times.median("index") + times.median("normals"), 5)},
        {"t_seg", times.median("segmentation")},
        {"t_m", times.median("merging")},
        {"planes of surfaces", times.median("planes of surfaces")},
        {"n_m", seen.initial_segments.size() - seen.surfaces.size()},
        {"n_s", seen.surfaces.size()},
        {"view points", visible.images().size()},
        {"gaps closed", gaps_closed(seen)},
        {"gaps considered", seen.gaps.size()},
        {"changed by a second run", again.labels() != once.labels()},
        {"seats found", seats.size()},
        {"seats merged", shared(seats)},
        {"n_m, literal algorithm", seen.initial_segments.size() - literal.size()},
        {"seats merged, literal algorithm", shared(segments_of_seats(d.world, truth, literal))}};
}

/// The default chain: all its steps, and their sum.
json row_of_default(const dataset& d, const gnomon::simulation::true_scan& truth,
                    const effort& much) {
    pass_times times;
    const perceived seen = timed(times, much, perceive, truth);
    json row{{"data set", d.name}};
    for (const auto& step : seen.steps) {
        const std::string name(step.name);
        row[name] = times.median(name.c_str());
    }
    row["all"] = times.median_of_all();
    const auto seats = segments_of_seats(d.world, truth, seen.surfaces);
    row.update({{"n_m", seen.initial_segments.size() - seen.surfaces.size()},
                {"n_s", seen.surfaces.size()},
                {"noise at 2 m [mm]", rounded(1e3 * seen.noise.curve.along({2.0, 0.0, 0.0}), 1)},
                {"gaps closed", gaps_closed(seen)},
                {"gaps considered", seen.gaps.size()},
                {"seats found", seats.size()},
                {"seats merged", shared(seats)}});
    return row;
}

json measure(const effort& much) {
    json as_thesis = json::array(), as_default = json::array();
    for (const dataset& d : datasets()) {
        std::printf("%s\n", d.name.c_str());
        std::fflush(stdout);
        const gnomon::simulation::true_scan truth = d.scan(1);
        as_thesis.push_back(row_of_thesis(d, truth, much));
        as_default.push_back(row_of_default(d, truth, much));
    }
    return {{"rows", as_thesis}, {"default chain", as_default}};
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, measure); }
