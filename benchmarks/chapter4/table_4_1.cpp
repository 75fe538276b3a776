// SPDX-License-Identifier: BSL-1.0
// Table 4.1: the times of the steps on eight scans, on one thread, and their results. Also counted
// are the changes by a second run of merging, and the seats of different chairs that are one
// segment after merging by the defaults and by Alg. 4.3 as printed.
#include <algorithm>
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

json measure(const effort& much) {
    json rows = json::array();
    for (const dataset& d : datasets()) {
        std::printf("%s\n", d.name.c_str());
        std::fflush(stdout);
        const gnomon::simulation::true_scan truth = d.scan(1);
        const perceived seen = perceive(truth);  // warms up
        std::vector<double> pp, nve, seg, m, c;
        for (int pass = 0; pass < much.passes(); ++pass) {
            const auto s = perceive(truth).seconds;
            pp.push_back(s.preprocessing);
            nve.push_back(s.normals);
            seg.push_back(s.segmentation);
            m.push_back(s.merging);
            c.push_back(s.assignment);
        }
        const gnomon::visibility visible(truth.scan);
        const gnomon::segments once =
            gnomon::merge_occluded(truth.scan, seen.surface, seen.initial_segments, visible)
                .segments;
        const gnomon::segments again =
            gnomon::merge_occluded(truth.scan, seen.surface, once, visible).segments;
        const gnomon::segments literal =
            gnomon::merge_occluded_literally(truth.scan, seen.initial_segments, visible);
        const auto seats = segments_of_seats(d.world, truth, seen.surfaces);
        const auto merged = std::ranges::count_if(
            seen.gaps, [](const gnomon::considered_gap& gap) { return gap.merged; });
        rows.push_back({{"data set", d.name},
                        {"n", truth.scan.size()},
                        {"t_s", rounded(d.seconds(), 3)},
                        {"n_pp", seen.kept.size()},
                        {"t_pp", rounded(median_of(pp), 5)},
                        {"t_nve", rounded(median_of(nve), 5)},
                        {"t_seg", rounded(median_of(seg), 5)},
                        {"t_m", rounded(median_of(m), 5)},
                        {"assignment", rounded(median_of(c), 5)},
                        {"n_m", seen.initial_segments.size() - once.size()},
                        {"n_s", seen.surfaces.size()},
                        {"view points", visible.images().size()},
                        {"gaps closed", merged},
                        {"gaps considered", seen.gaps.size()},
                        {"changed by a second run", again.labels() != once.labels()},
                        {"seats found", seats.size()},
                        {"seats merged", shared(seats)},
                        {"n_m, literal algorithm", seen.initial_segments.size() - literal.size()},
                        {"seats merged, literal algorithm",
                         shared(segments_of_seats(d.world, truth, literal))}});
    }
    return {{"rows", rows}};
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, measure); }
