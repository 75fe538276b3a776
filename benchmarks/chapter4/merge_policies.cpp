// SPDX-License-Identifier: BSL-1.0
// Alg. 4.3 in random furnished rooms: precision and recall of merging segments of surfaces that an
// occluder interrupts, by policy and by trajectory. The segments are those of the default chain,
// and those of Alg. 4.2. The literal algorithm uses one range image with an upright pole, as in the
// thesis; for a moving sensor, one for each view point.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "initial_segments.hpp"
#include "record.hpp"
#include "rooms.hpp"

namespace sim = gnomon::simulation;

namespace {

constexpr std::array policies{"none",
                              "conservative",
                              "liberal",
                              "conservative, Alg. 4.2",
                              "liberal, Alg. 4.2",
                              "conservative, literal",
                              "liberal, literal"};
constexpr std::array trajectories{"horizontal", "vertical", "rotational", "moving"};

/// @param trajectory  "moving" is horizontal, on a rotating arm of 15 cm, so that each scan line
///                    has a view point of its own
sim::true_scan scan_of(const sim::scene& world, const sim::bvh_caster& caster,
                       const std::string& trajectory, std::uint64_t seed) {
    const sim::pose mount = world.sensor;
    const auto along = [&](const auto& way) {
        return sim::simulate(world, caster, way, {}, {.sigma = noise_of_rooms, .seed = seed});
    };
    if (trajectory == "horizontal") return along(sim::horizontal{.mount = mount});
    if (trajectory == "vertical") return along(sim::vertical{.mount = mount});
    if (trajectory == "rotational") return along(sim::rotational{.mount = mount});
    return along(sim::along(4.0, [&](double seconds) {
        return mount * sim::yaw(gnomon::degrees(180.0 * (seconds / 4.0 - 0.5))) *
               sim::at(0.15, 0.0, 0.0) * sim::roll(gnomon::degrees(90));
    }));
}

/// The tallies of a policy.
struct policy_tally : merge_tallies {
    merge_tally of_planes;  ///< each pair counts as one; coplanar faces are one surface
};

/// Segments before merging, and those of them on several surfaces.
struct segment_count {
    std::size_t all = 0, mixed = 0;

    segment_count& operator+=(const segment_count& o) {
        all += o.all;
        mixed += o.mixed;
        return *this;
    }
};

/// What is true of some segments before merging.
class ground_truth {
  public:
    ground_truth(const sim::bvh_caster& caster, const sim::true_scan& truth,
                 const gnomon::segments& parts)
        : parts_(parts.size()),
          surfaces_(caster, truth, parts),
          planes_(caster, truth, parts, unit::plane) {}

    [[nodiscard]] segment_count initial() const {
        segment_count count{parts_, 0};
        for (std::size_t s = 0; s < parts_; ++s)
            count.mixed += surfaces_.surface(s) == sim::nothing ? 1 : 0;
        return count;
    }
    [[nodiscard]] policy_tally tally(const gnomon::segments& merged) const {
        return {surfaces_.tally(merged), planes_.tally(merged).pairs};
    }

  private:
    std::size_t parts_;
    initial_segments surfaces_, planes_;
};

/// The results of all policies in one scan, or in many.
struct outcome {
    std::array<policy_tally, policies.size()> tallies{};
    segment_count of_default, of_thesis;

    outcome& operator+=(const outcome& o) {
        for (std::size_t p = 0; p < policies.size(); ++p) {
            tallies[p].pairs.add(o.tallies[p].pairs, 1.0);
            tallies[p].by_points.add(o.tallies[p].by_points, 1.0);
            tallies[p].of_planes.add(o.tallies[p].of_planes, 1.0);
        }
        of_default += o.of_default;
        of_thesis += o.of_thesis;
        return *this;
    }
};

outcome outcome_in(std::uint64_t number, const std::string& trajectory, std::uint64_t seed) {
    const sim::scene world = sim::scenes::furnished_room(
        {.pieces = static_cast<int>(4 + 2 * (number % 5)), .seed = number});
    const sim::bvh_caster caster(world);
    const sim::true_scan truth = scan_of(world, caster, trajectory, 1000 * number + seed);
    outcome result;
    {
        const perceived seen = perceive(truth);
        const ground_truth known(caster, truth, seen.initial_segments);
        result.of_default += known.initial();
        result.tallies[0] = known.tally(seen.initial_segments);
        result.tallies[1] = known.tally(seen.surfaces);
        result.tallies[2] = known.tally(perceive_liberally(truth).surfaces);
    }
    const perceived seen = segment_as_thesis(truth);
    const gnomon::segments& parts = seen.initial_segments;
    const ground_truth known(caster, truth, parts);
    result.of_thesis += known.initial();
    const gnomon::constant_noise noise{noise_of_rooms};
    const gnomon::visibility visible(truth.scan, {.noise = noise});
    const gnomon::visibility upright(truth.scan,
                                     {.pole = Eigen::Vector3d::UnitZ(), .noise = noise});
    const auto merged = [&](const auto& policy) {
        return known.tally(
            gnomon::merge_occluded(truth.scan, parts, visible, policy, {.noise = noise}).segments);
    };
    const auto merged_literally = [&](const auto& policy) {
        return known.tally(gnomon::merge_occluded_literally(truth.scan, parts, upright, policy));
    };
    result.tallies[3] = merged(gnomon::conservative{});
    result.tallies[4] = merged(gnomon::liberal{});
    result.tallies[5] = merged_literally(gnomon::conservative{});
    result.tallies[6] = merged_literally(gnomon::liberal{});
    return result;
}

/// In rooms 1 to `rooms`; on all cores, as nothing is timed.
outcome outcome_of(std::uint64_t rooms, const std::string& trajectory, std::uint64_t seed) {
    std::vector<outcome> of_room(rooms);
    gnomon::threads{}(rooms,
                      [&](std::size_t r) { of_room[r] = outcome_in(r + 1, trajectory, seed); });
    outcome total;
    for (const outcome& o : of_room) total += o;
    return total;
}

json measure(const effort& much) {
    const std::uint64_t rooms = much.quick ? 4 : 100;
    json scores = json::array(), scans = json::array(), errors = json::array();
    for (const std::string trajectory : trajectories) {
        std::printf("merge_policies, %s\n", trajectory.c_str());
        std::fflush(stdout);
        std::vector<outcome> seeds;
        for (unsigned seed = 1; seed <= much.seeds(); ++seed)
            seeds.push_back(outcome_of(rooms, trajectory, seed));
        const auto mean = [&](const auto& value_of) {
            double sum = 0.0;
            for (const outcome& o : seeds) sum += static_cast<double>(value_of(o));
            return sum / static_cast<double>(seeds.size());
        };
        const auto least = [&](const auto& value_of) {
            double value = value_of(seeds.front());
            for (const outcome& o : seeds) value = std::min(value, value_of(o));
            return rounded(value, 3);
        };
        for (std::size_t p = 0; p < policies.size(); ++p) {
            using tally = merge_tally policy_tally::*;
            const auto rate = [p](tally by, double (merge_tally::*rate_of)() const) {
                return [=](const outcome& o) { return (o.tallies[p].*by.*rate_of)(); };
            };
            const auto precision = [&](tally by) { return rate(by, &merge_tally::precision); };
            const auto recall = [&](tally by) { return rate(by, &merge_tally::recall); };
            const auto count = [&](tally by, double merge_tally::*of) {
                return rounded(mean([=](const outcome& o) { return o.tallies[p].*by.*of; }), 1);
            };
            constexpr tally pairs = &policy_tally::pairs, points = &policy_tally::by_points,
                            planes = &policy_tally::of_planes;
            scores.push_back({{"trajectory", trajectory},
                              {"policy", policies[p]},
                              {"precision", rounded(mean(precision(pairs)), 3)},
                              {"least precision", least(precision(pairs))},
                              {"recall", rounded(mean(recall(pairs)), 3)},
                              {"least recall", least(recall(pairs))},
                              {"precision by points", rounded(mean(precision(points)), 3)},
                              {"recall by points", rounded(mean(recall(points)), 3)},
                              {"precision of planes", rounded(mean(precision(planes)), 3)},
                              {"recall of planes", rounded(mean(recall(planes)), 3)}});
            errors.push_back(
                {{"trajectory", trajectory},
                 {"policy", policies[p]},
                 {"pairs interrupted", count(pairs, &merge_tally::wanted)},
                 {"merged correctly", count(pairs, &merge_tally::right)},
                 {"wrongly merged", count(pairs, &merge_tally::wrong)},
                 {"of two objects in one plane", count(pairs, &merge_tally::coplanar)},
                 {"of planes less than 15 mm apart", count(pairs, &merge_tally::in_noise)},
                 {"of planes: interrupted", count(planes, &merge_tally::wanted)},
                 {"of planes: merged correctly", count(planes, &merge_tally::right)},
                 {"of planes: wrongly merged", count(planes, &merge_tally::wrong)}});
        }
        const auto row_of = [&](const char* chain, segment_count outcome::*of) {
            const double initial = mean([=](const outcome& o) { return (o.*of).all; });
            const double mixed = mean([=](const outcome& o) { return (o.*of).mixed; });
            scans.push_back(
                {{"trajectory", trajectory},
                 {"chain", chain},
                 {"scans", rooms * seeds.size()},
                 {"initial segments of a scan", rounded(initial / double(rooms), 1)},
                 {"of them on several surfaces [%]", rounded(100.0 * mixed / initial, 1)}});
        };
        row_of("default", &outcome::of_default);
        row_of("of the thesis", &outcome::of_thesis);
    }
    return {{"precision and recall", scores}, {"pairs, per seed", errors}, {"scans", scans}};
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, measure); }
