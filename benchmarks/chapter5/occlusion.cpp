// SPDX-License-Identifier: BSL-1.0
// Occluded objects, Fig. 5.11: a board in front of an object hides a share of its points. All
// methods learn the same views; all but the thesis as printed also versions of these of which a
// part is hidden.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <boost/hana/tuple.hpp>

#include "outcomes.hpp"
#include "peers.hpp"
#include "views.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/recognition/height_profile.hpp>
#include <gnomon/recognition/object_recognizer.hpp>
#include <gnomon/recognition/part_features.hpp>
#include <gnomon/recognition/part_relation.hpp>
#include <gnomon/recognition/view.hpp>
#include <gnomon/recognition/word_histograms.hpp>

namespace {

/// A view that is the height profile of all points, without parts.
rec::view profile_of(const gnomon::scan& scan) {
    rec::view v;
    v.ground = gnomon::plane{};
    for (const auto& p : scan.points) {
        const Eigen::Vector3d d = p - scan.points.front();
        v.rest.add(p.z(), d.x(), d.y());
    }
    return v;
}

view_set profiles_of(const scan_set& scans) {
    view_set set{.views = {}, .classes = scans.classes, .parts = {}, .versions = scans.versions};
    for (const auto& s : scans.scans) set.views.push_back(profile_of(s));
    return set;
}

/// Trees on the profile alone. The feature of parts is never used, as there are none.
using profile_trees = rec::object_recognizer<boost::hana::tuple<rec::box_edge<0>>,
                                             std::remove_cv_t<decltype(rec::no_relations)>>;

outcomes outcomes_of_profiles(const profile_trees& trees, const scan_set& tests) {
    outcomes found =
        outcomes_of(profiles_of(tests), [&](const rec::view& v) { return trees.decide(v); });
    for (std::size_t i = 0; i < found.all.size(); ++i)
        found.all[i].has_parts = tests.scans[i].size() >= fewest_cells;
    return found;
}

#ifdef CHAPTER5_PCL

/// A descriptor of each scan; empty if there are hardly points.
struct described_set {
    std::vector<std::vector<float>> rows;
    std::vector<std::uint32_t> classes;
    std::size_t versions;

    described_set(std::vector<float> (*describe)(const gnomon::scan&), const scan_set& set)
        : rows(set.scans.size()), classes(set.classes), versions(set.versions) {
        gnomon::threads{}(rows.size(), [&](std::size_t i) { rows[i] = describe(set.scans[i]); });
    }
};

/// The known descriptor with the least sum of absolute differences.
/// @param step  only each step-th one is known
std::size_t nearest(const described_set& known, std::size_t step, const std::vector<float>& x) {
    std::size_t best = 0;
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < known.rows.size(); i += step) {
        if (known.rows[i].empty()) continue;
        float sum = 0.0f;
        for (std::size_t k = 0; k < x.size(); ++k) sum += std::abs(x[k] - known.rows[i][k]);
        if (sum >= least) continue;
        least = sum;
        best = i;
    }
    return best;
}

/// Of the nearest neighbor, which is certain of all its answers, right or wrong.
/// @param only_whole  without the versions of views of which a part is hidden
outcomes outcomes_of_nearest(const described_set& known, const described_set& tests,
                             bool only_whole) {
    outcomes found{std::vector<outcome>(tests.rows.size())};
    gnomon::threads{}(tests.rows.size(), [&](std::size_t i) {
        outcome& o = found.all[i];
        o.truth = tests.classes[i];
        if (tests.rows[i].empty()) return;
        o.has_parts = true;
        o.probability = 1.0;
        o.best = known.classes[nearest(known, only_whole ? known.versions : 1, tests.rows[i])];
        o.is_right = o.best == o.truth;
    });
    return found;
}

#endif

void add_seed(outcomes_by_row& rows, const effort& much, std::uint64_t seed) {
    const auto models = sim::furniture_models();
    const std::size_t n = views_per_model(much);
    const scan_set once = scans_of(models, n, {}, seed, purpose::learning);
    const scan_set scans = with_hidden_parts(once, seed);
    const view_set training = views_of(scans), training15 = views_of(scans, repaired_density);

    rec::object_recognizer model;
    learn(model, training, names_of(models));
    profile_trees profiles({}, boost::hana::make_tuple(rec::box_edge<0>{}), rec::no_relations);
    learn(profiles, profiles_of(scans), names_of(models));
    const view_set once50 = views_of(once, thesis_density);
    const rec::word_histograms thesis(once50.views, once50.classes, models.size(),
                                      rec::scaled_by_largest(rec::thesis_features, once50.views),
                                      rec::thesis_relations);
    const rec::word_histograms repaired(
        training15.views, training15.classes, models.size(),
        rec::scaled_by_largest(rec::thesis_features, training15.views), rec::thesis_relations,
        {.counts_parts = false, .counts_absence = true});
#ifdef CHAPTER5_PCL
    const described_set vfh(peers::vfh, scans), esf(peers::esf, scans);
#endif

    const std::vector<double> shares = much.quick
                                           ? std::vector<double>{0.0, 0.5}
                                           : std::vector<double>{0.0, 0.2, 0.4, 0.5, 0.6, 0.8};
    for (const double share : shares) {
        const scan_set tests = scans_of(models, n, {.occluded_share = share}, seed, purpose::test);
        const view_set seen = views_of(tests), seen50 = views_of(tests, thesis_density),
                       seen15 = views_of(tests, repaired_density);
        const auto add = [&](const char* method, outcomes found) {
            rows.add({{"hidden", share}, {"method", method}}, std::move(found));
        };
        add("default", outcomes_of(seen, [&](const rec::view& v) { return model.decide(v); }));
        add("thesis, as printed", outcomes_of(thesis, seen50, 1.0));
        add("thesis, repaired", outcomes_of(repaired, seen15, 1.0));
        add("height profile", outcomes_of_profiles(profiles, tests));
#ifdef CHAPTER5_PCL
        // ESF is slow: only where relations compare it, and at the largest share.
        if (share == 0.0 || share == 0.5 || share == 0.8) {
            const described_set vfh_tests(peers::vfh, tests), esf_tests(peers::esf, tests);
            add("VFH, nearest", outcomes_of_nearest(vfh, vfh_tests, false));
            add("ESF, nearest", outcomes_of_nearest(esf, esf_tests, false));
            add("VFH, nearest, nothing hidden in training",
                outcomes_of_nearest(vfh, vfh_tests, true));
            add("ESF, nearest, nothing hidden in training",
                outcomes_of_nearest(esf, esf_tests, true));
        }
#endif
        std::printf("seed %d, %.1f hidden\n", static_cast<int>(seed), share);
        std::fflush(stdout);
    }
}

json measure(const effort& much) {
    // Seeds side by side: many steps of a seed have one thread.
    std::vector<outcomes_by_row> of_seeds(much.seeds());
    gnomon::threads{}(of_seeds.size(),
                      [&](std::size_t s) { add_seed(of_seeds[s], much, first_seed + s); });
    outcomes_by_row rows;
    for (const outcomes_by_row& of_seed : of_seeds)
        for (const auto& [key, found] : of_seed.rows()) rows.add(key, found.front());
    return {{"by hidden share", rows.table(usual_measures())}};
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, measure); }
