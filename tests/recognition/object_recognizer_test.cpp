// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <boost/hana/append.hpp>
#include <boost/hana/tuple.hpp>
#include <gtest/gtest.h>

#include "laws/view_likelihood_laws.hpp"
#include "recognition/some_views.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/recognition/object_recognizer.hpp>
#include <gnomon/recognition/view_augmentation.hpp>
#include <gnomon/segmentation/segment_surfaces.hpp>
#include <gnomon/simulation/object_views.hpp>

namespace rec = gnomon::recognition;
namespace hana = boost::hana;

namespace {

static_assert(rec::view_likelihood<rec::object_recognizer<>>);

const rec::object_recognizer_options few_trees{.trees = {.trees = 40}};

void learn_all(auto& model, const some_views::labeled_views& t, std::size_t first = 0,
               std::size_t last = 1'000'000) {
    for (std::size_t i = first; i < std::min(last, t.views.size()); ++i)
        model.learn(t.views[i], some_views::names[t.classes[i]]);
}

/// A recognizer of the three kinds of furniture.
auto fitted_recognizer() {
    rec::object_recognizer model(few_trees);
    learn_all(model, some_views::training());
    model.fit();
    return model;
}
const auto& furniture_recognizer() {
    static const auto model = fitted_recognizer();
    return model;
}

/// Equal to the last bit, with the evidence.
void expect_equal_decisions(const auto& a, const auto& b) {
    EXPECT_EQ(a.names(), b.names());
    EXPECT_EQ(a.learned().temperature, b.learned().temperature);
    EXPECT_EQ(a.learned().samples.values, b.learned().samples.values);
    EXPECT_EQ(a.learned().words, b.learned().words);
    for (const auto& v : some_views::fresh().views) {
        const auto x = a.explain(v), y = b.explain(v);
        EXPECT_EQ(x.probability, y.probability);
        EXPECT_EQ(x.best, y.best);
        EXPECT_EQ(x.second, y.second);
        EXPECT_EQ(x.log_ratio, y.log_ratio);
        ASSERT_EQ(x.evidence.size(), y.evidence.size());
        for (std::size_t i = 0; i < x.evidence.size(); ++i) {
            EXPECT_EQ(x.evidence[i].log_ratio, y.evidence[i].log_ratio);
            EXPECT_EQ(x.evidence[i].word, y.evidence[i].word);
        }
    }
}

/// What was learned, as it was before a call that was refused.
void expect_unchanged(const auto& model, const auto& before) {
    EXPECT_EQ(model.learned().names, before.names);
    EXPECT_EQ(model.learned().words, before.words);
    EXPECT_EQ(model.learned().samples.values, before.samples.values);
    EXPECT_EQ(model.learned().samples.classes, before.samples.classes);
    EXPECT_EQ(model.learned().sources, before.sources);
    EXPECT_EQ(model.learned().temperature, before.temperature);
}

TEST(object_recognizer, recognizes_fresh_views) {
    const auto& model = furniture_recognizer();
    const auto& fresh = some_views::fresh();
    EXPECT_EQ(model.names(), (std::vector<std::string>{"chair", "table", "shelf"}));
    for (std::size_t i = 0; i < fresh.views.size(); ++i) {
        const auto found = model.decide(fresh.views[i]);
        EXPECT_EQ(found.best, fresh.classes[i]);
        EXPECT_FALSE(found.is_background());
        EXPECT_TRUE(found.evidence.empty());
    }
}

/// The view of the points of a scan that are chosen, perceived from the beginning.
rec::view perceived_view(const gnomon::scan& scan, const std::vector<gnomon::point_index>& chosen) {
    std::vector<Eigen::Vector3d> points;
    for (const auto i : chosen) points.push_back(scan.points[i]);
    if (points.size() < 20) return some_views::empty_view();
    const auto surface =
        gnomon::estimate_normals(points, gnomon::knn{.k = 20}, gnomon::plane_pca{});
    const auto parts = gnomon::segment_surfaces(points, surface, {.min_points = 15});
    const auto views = rec::views_of(
        gnomon::with_viewpoint(points, {0.0, 0.0, 1.2}), surface, parts,
        {.gap = rec::infinite_gap, .min_parts = 1, .ground = some_views::floor_plane});
    return views.empty() ? some_views::empty_view() : views.front();
}

/// The whole chain: simulated scans of a chair, a stool and a table, whole and partly hidden.
TEST(object_recognizer, recognizes_simulated_furniture) {
    namespace sim = gnomon::simulation;
    const auto all = sim::furniture_models();
    const std::vector<sim::furniture_model> models{all[0], all[3], all[6]};
    sim::object_view_options options{
        .scanner = {.resolution = gnomon::degrees(0.5)}, .duration = 4.0, .seed = 21};
    rec::object_recognizer model(few_trees);
    gnomon::random_stream random(3);
    for (const auto& v : sim::simulate_object_views(models, 8, options)) {
        std::vector<rec::view> versions{perceived_view(v.truth.scan, v.points_of_model())};
        for (int i = 0; i < 2; ++i)
            versions.push_back(perceived_view(
                v.truth.scan,
                rec::hide_part(v.truth.scan, {0.0, 0.0, 1.2}, random, {.most = 0.5})));
        model.learn(versions, models[v.model].name);
    }
    model.fit();
    options.seed = 22;
    std::size_t right = 0;
    for (const auto& v : sim::simulate_object_views(models, 6, options)) {
        const auto found = model.explain(perceived_view(v.truth.scan, v.points_of_model()));
        right += model.names()[found.best] == models[v.model].name;
        EXPECT_NEAR(some_views::sum_of_evidence(found), found.log_ratio, 1e-9);
    }
    EXPECT_GE(right, 15u);
}

TEST(object_recognizer, has_evidence_that_sums_to_the_decision) {
    const auto& model = furniture_recognizer();
    auto views = some_views::fresh().views;
    for (std::size_t n = 0; n <= 6; ++n)
        views.push_back(some_views::with_parts(some_views::fresh().views[0], n));
    views.push_back(some_views::strange_view());
    views.push_back(some_views::fresh().views[1]);
    for (int i = 0; i < 300; ++i) views.back().rest.add(1.0 + 0.004 * i, 0.01 * i, 0.3);
    for (const auto& v : views) {
        const auto slow = model.explain(v), fast = model.decide(v);
        EXPECT_NEAR(some_views::sum_of_evidence(slow), slow.log_ratio, 1e-9);
        EXPECT_NEAR(some_views::sum_of_probability(slow), 1.0, 1e-12);
        EXPECT_NEAR(fast.log_ratio, slow.log_ratio, 1e-9);
        EXPECT_EQ(fast.is_background(), slow.is_background());
        const std::size_t n = v.parts.size();
        EXPECT_EQ(slow.evidence.size(), 2 + n + n * (n + 1) / 2);
        for (const auto& e : slow.evidence) {
            EXPECT_TRUE(std::isfinite(e.log_ratio));
            if (e.kind == rec::term_kind::part) {
                EXPECT_LT(e.first, n);
                EXPECT_LT(e.word, model.learned().words.size());
            }
        }
    }
}

TEST(object_recognizer, obeys_the_laws) {
    for (const auto& v : some_views::fresh().views)
        laws::view_likelihood_laws(furniture_recognizer(), v);
    laws::view_likelihood_laws(furniture_recognizer(), some_views::empty_view());
}

/// More parts than terms are made for: all further parts are one term.
TEST(object_recognizer, explains_views_of_many_parts) {
    auto v = some_views::fresh().views[0];
    const auto parts = v.parts;
    v.parts.insert(v.parts.end(), parts.begin(), parts.end());
    for (const std::size_t other : {2u, 1u, 5u}) {  // of shelves and a table
        const auto& more = some_views::fresh().views[other].parts;
        v.parts.insert(v.parts.end(), more.begin(), more.end());
    }
    ASSERT_GT(v.parts.size(), 20u);
    const auto found = furniture_recognizer().explain(v);
    EXPECT_EQ(found.evidence.size(), 2u + 12u + 12u * 13u / 2u);
    EXPECT_NEAR(some_views::sum_of_evidence(found), found.log_ratio, 1e-9);
    EXPECT_NEAR(furniture_recognizer().decide(v).log_ratio, found.log_ratio, 1e-9);
}

/// Views in pieces, with fit() between them, give the model of all at once.
TEST(object_recognizer, learns_on_to_the_last_bit) {
    const auto& t = some_views::training();
    rec::object_recognizer pieces(few_trees);
    learn_all(pieces, t, 0, 7);
    pieces.fit();
    learn_all(pieces, t, 7, 20);
    pieces.fit(gnomon::threads{2});
    (void)pieces.explain(some_views::fresh().views[0]);
    learn_all(pieces, t, 20);
    pieces.fit();
    expect_equal_decisions(pieces, furniture_recognizer());
}

/// A new class changes neither the words nor the samples of the others.
TEST(object_recognizer, keeps_what_it_learned_when_a_class_is_new) {
    auto model = furniture_recognizer();
    const auto before = model.learned();
    model.learn(some_views::strange_view(), "sail");
    EXPECT_EQ(model.names().back(), "sail");
    for (std::size_t i = 0; i < before.samples.values.size(); ++i)
        ASSERT_EQ(model.learned().samples.values[i], before.samples.values[i]);
    for (std::size_t w = 0; w < before.words.size(); ++w)
        EXPECT_EQ(model.learned().words[w], before.words[w]);
    EXPECT_THROW((void)model.explain(some_views::fresh().views[0]), std::invalid_argument);
    model.fit();
    EXPECT_EQ(model.explain(some_views::fresh().views[0]).probability.size(), 4u);
}

TEST(object_recognizer, does_not_depend_on_threads) {
    for (const unsigned n : {2u, 4u}) {
        rec::object_recognizer model(few_trees);
        learn_all(model, some_views::training());
        model.fit(gnomon::threads{n});
        expect_equal_decisions(model, furniture_recognizer());
    }
}

TEST(object_recognizer, decides_the_same_when_restored) {
    rec::object_recognizer model;
    model.restore(furniture_recognizer().learned(), gnomon::threads{2});
    expect_equal_decisions(model, furniture_recognizer());
    // Further views follow.
    auto original = furniture_recognizer();
    for (auto* m : {&model, &original}) {
        learn_all(*m, some_views::fresh(), 0, 5);
        m->fit();
    }
    expect_equal_decisions(model, original);
}

/// All versions of a view have one source, so that calibration leaves them out together.
TEST(object_recognizer, knows_versions_of_a_view) {
    rec::object_recognizer model(few_trees);
    const auto& v = some_views::training().views[0];
    const std::vector<rec::view> versions{v, some_views::with_parts(v, 2)};
    model.learn(versions, "chair");
    model.learn(v, "chair");
    EXPECT_EQ(model.learned().sources, (std::vector<std::uint32_t>{0, 0, 1}));
    EXPECT_EQ(model.learned().samples.rows(), 3u);
}

/// Calibration leaves out views with all their versions: of labels without meaning, nothing is
/// certain. If it tested on the samples that the trees were grown on, all would be.
TEST(object_recognizer, is_calibrated_on_views_that_are_left_out) {
    for (const bool has_versions : {false, true}) {
        rec::object_recognizer model(few_trees);
        gnomon::random_stream random(12);
        for (const auto& v : some_views::training().views) {
            const auto name = some_views::names[random.below(2)];
            if (has_versions) {
                model.learn(std::vector<rec::view>{v, v}, name);
            } else {
                model.learn(v, name);
            }
        }
        model.fit();
        EXPECT_GT(model.learned().temperature, 2.0);
    }
}

TEST(object_recognizer, knows_the_class_of_other_things) {
    rec::object_recognizer model(few_trees);
    const auto& t = some_views::training();
    for (std::size_t i = 0; i < t.views.size(); ++i)
        model.learn(t.views[i],
                    t.classes[i] == 2 ? rec::background_name : some_views::names[t.classes[i]]);
    EXPECT_EQ(model.decision_options().background_class, 2u);
    model.fit();
    const auto& fresh = some_views::fresh();
    for (std::size_t i = 0; i < fresh.views.size(); ++i) {
        const auto found = model.decide(fresh.views[i]);
        EXPECT_EQ(found.is_background(), fresh.classes[i] == 2);
        EXPECT_EQ(found.is_of_background_class, fresh.classes[i] == 2);
    }
    EXPECT_EQ(furniture_recognizer().decision_options().background_class, rec::term::none);
}

TEST(object_recognizer, takes_views_without_parts_for_background) {
    auto v = some_views::with_parts(some_views::fresh().views[0], 0);
    v.rest = {};
    const auto found = furniture_recognizer().explain(v);
    EXPECT_TRUE(found.is_background());
    EXPECT_NEAR(some_views::sum_of_evidence(found), found.log_ratio, 1e-9);
}

/// Sec. 5.5.2: precision does not fall, and recall does not rise, with P_d, as views only drop out.
TEST(object_recognizer, decides_on_fewer_views_for_a_larger_p_d) {
    auto t = some_views::fresh();
    for (auto& v : t.views) v.parts.resize(std::min<std::size_t>(v.parts.size(), 2));
    std::vector<bool> was(t.views.size(), true);
    for (const double p : {0.0, 0.4, 0.6, 0.8, 0.9, 0.99, 1.0}) {
        for (std::size_t i = 0; i < t.views.size(); ++i) {
            auto options = furniture_recognizer().decision_options();
            options.min_probability = p;
            const bool is = rec::decide(furniture_recognizer(), t.views[i], options).is_certain;
            EXPECT_TRUE(was[i] || !is);
            was[i] = is;
        }
    }
}

TEST(object_recognizer, takes_features_and_relations_of_a_user) {
    rec::object_recognizer model(
        few_trees, hana::append(rec::default_features, some_views::share_of_points{}),
        hana::append(rec::default_relations, some_views::ratio_of_points{}));
    learn_all(model, some_views::training());
    model.fit();
    EXPECT_GT(model.learned().samples.columns, furniture_recognizer().learned().samples.columns);
    for (std::size_t i = 0; i < some_views::fresh().views.size(); ++i) {
        const auto found = model.explain(some_views::fresh().views[i]);
        EXPECT_EQ(found.best, some_views::fresh().classes[i]);
        EXPECT_NEAR(some_views::sum_of_evidence(found), found.log_ratio, 1e-9);
    }
}

/// Objects that lie on their sides: features for any pose, no relations of heights, no profile.
TEST(object_recognizer, works_without_ground) {
    rec::object_recognizer model(few_trees, rec::invariant_features, rec::thesis_relations, false);
    learn_all(model, some_views::training());
    model.fit();
    std::size_t right = 0;
    for (std::uint64_t i = 0; i < 12; ++i) {
        gnomon::random_stream random(50, i);
        const auto kind = static_cast<std::uint32_t>(i % 3);
        auto c = some_views::furniture(kind, random);
        c.move(some_views::any_rotation(random), {0.0, 0.0, 1.0});
        const auto found = model.explain(some_views::view_of(c, std::nullopt));
        EXPECT_NEAR(some_views::sum_of_evidence(found), found.log_ratio, 1e-9);
        right += found.best == kind;
    }
    EXPECT_GE(right, 11u);
    rec::object_recognizer parts_only(few_trees, rec::invariant_features, rec::no_relations, false);
    learn_all(parts_only, some_views::make_views(4, 3, std::nullopt));
    parts_only.fit();
    const auto found = parts_only.explain(some_views::fresh().views[0]);
    EXPECT_NEAR(some_views::sum_of_evidence(found), found.log_ratio, 1e-9);
}

TEST(object_recognizer, refuses_views_without_ground_and_learns_nothing) {
    auto model = furniture_recognizer();
    const auto before = model.learned();
    auto v = some_views::fresh().views[0];
    auto blind = v;
    blind.ground.reset();
    EXPECT_THROW(model.learn(blind, "new"), std::invalid_argument);
    EXPECT_THROW(model.learn(std::vector<rec::view>{v, blind}, "new"), std::invalid_argument);
    EXPECT_THROW(model.learn(v, ""), std::invalid_argument);
    auto bad = v;
    bad.parts[1].shape.frame.centroid.z() = some_views::nan;
    EXPECT_THROW(model.learn(bad, "new"), std::invalid_argument);
    auto huge = v;
    huge.parts[1].shape.frame.centroid.z() = 1e200;
    EXPECT_THROW(model.learn(huge, "new"), std::invalid_argument);
    expect_unchanged(model, before);
    EXPECT_NO_THROW((void)model.decide(v));
    EXPECT_THROW((void)model.decide(blind), std::invalid_argument);
    EXPECT_THROW((void)model.explain(bad), std::invalid_argument);
}

/// No version is no view: there is no class without samples.
TEST(object_recognizer, learns_nothing_from_no_versions) {
    rec::object_recognizer model(few_trees);
    learn_all(model, some_views::training(), 0, 4);
    const auto before = model.learned();
    try {
        model.learn(std::vector<rec::view>{}, "ghost");
    } catch (const std::invalid_argument&) {
    }
    expect_unchanged(model, before);
}

TEST(object_recognizer, refuses_relations_that_are_not_finite) {
    rec::object_recognizer model(few_trees, rec::default_features,
                                 hana::make_tuple(some_views::nan_relation{}));
    EXPECT_THROW(model.learn(some_views::training().views[0], "chair"), std::invalid_argument);
    EXPECT_EQ(model.learned().samples.rows(), 0u);
}

/// A value beyond single precision, in which descriptions are stored, must not become infinite.
TEST(object_recognizer, refuses_values_beyond_single_precision) {
    rec::object_recognizer model(few_trees);
    auto v = some_views::training().views[0];
    v.parts[0].shape.frame.centroid.z() = 1e60;
    EXPECT_THROW(model.learn(v, "chair"), std::invalid_argument);
    EXPECT_EQ(model.learned().samples.rows(), 0u);
}

TEST(object_recognizer, must_be_fitted_to_two_classes) {
    rec::object_recognizer model(few_trees);
    const auto& v = some_views::training().views[0];
    EXPECT_THROW(model.fit(), std::invalid_argument);
    EXPECT_THROW((void)model.decide(v), std::invalid_argument);
    model.learn(v, "chair");
    EXPECT_THROW(model.fit(), std::invalid_argument);
    model.learn(some_views::training().views[1], "table");
    EXPECT_THROW((void)model.explain(v), std::invalid_argument);
    EXPECT_THROW((void)model.log_likelihood(v), std::invalid_argument);
    model.fit();
    EXPECT_NEAR(some_views::sum_of_probability(model.decide(v)), 1.0, 1e-12);
}

/// What was moved elsewhere has no trees, and can learn again.
TEST(object_recognizer, must_be_fitted_again_after_a_move) {
    auto model = furniture_recognizer();
    const auto moved = std::move(model);
    const auto& v = some_views::training().views[0];
    EXPECT_EQ(moved.classes(), 3u);
    EXPECT_THROW((void)model.explain(v), std::invalid_argument);  // NOLINT: it was moved
    EXPECT_THROW((void)model.log_likelihood(v), std::invalid_argument);
    learn_all(model, some_views::training(), 0, 6);
    model.fit();
    EXPECT_NEAR(some_views::sum_of_probability(model.decide(v)), 1.0, 1e-12);
}

/// A fit that is cancelled, in calibration or in the trees, leaves the trees and their temperature.
TEST(object_recognizer, decides_as_before_after_a_fit_that_was_cancelled) {
    auto model = furniture_recognizer();
    auto learned = model.learned();
    learned.temperature = 7.0;
    model.restore(learned);
    struct cancelled {};
    bool has_ended = false;
    for (std::size_t most = 0; !has_ended; most += 7) {
        std::size_t trees = 0;
        const auto run = [&](std::size_t chunks, auto&& work) {
            for (std::size_t c = 0; c < chunks; ++c) {
                if (trees++ == most) throw cancelled{};
                work(c);
            }
        };
        const auto before = model.explain(some_views::fresh().views[0]);
        try {
            model.fit(run);
            has_ended = true;
        } catch (const cancelled&) {
            EXPECT_EQ(model.learned().temperature, 7.0) << most;
            EXPECT_EQ(model.explain(some_views::fresh().views[0]).probability, before.probability);
        }
    }
    EXPECT_NE(model.learned().temperature, 7.0);
}

TEST(object_recognizer, refuses_options_out_of_range) {
    rec::object_recognizer none(rec::object_recognizer_options{.trees = {.trees = 0}});
    learn_all(none, some_views::training(), 0, 6);
    EXPECT_THROW(none.fit(), std::invalid_argument);
    for (const double bad : {-1.0, some_views::nan}) {
        rec::object_recognizer model(rec::object_recognizer_options{.max_word_distance = bad});
        EXPECT_THROW(learn_all(model, some_views::training(), 0, 2), std::invalid_argument);
        EXPECT_TRUE(model.names().empty());
    }
}

/// Views that are all the same: no feature varies, and no class is preferred.
TEST(object_recognizer, has_no_opinion_where_nothing_varies) {
    rec::object_recognizer model(few_trees);
    const auto& v = some_views::training().views[0];
    for (int i = 0; i < 8; ++i) model.learn(v, i % 2 == 0 ? "this" : "that");
    model.fit();
    const auto found = model.explain(v);
    EXPECT_NEAR(found.probability[0], 0.5, 1e-12);
    EXPECT_TRUE(found.is_background());
}

TEST(object_recognizer, refuses_to_restore_what_does_not_fit_together) {
    auto model = furniture_recognizer();
    const auto good = model.learned();
    const auto refused = [&](auto change) {
        auto bad = good;
        change(bad);
        EXPECT_THROW(model.restore(bad), std::invalid_argument);
        expect_unchanged(model, good);
    };
    refused([](auto& c) { c.names.pop_back(); });
    refused([](auto& c) { c.names.resize(1); });
    refused([](auto& c) { c.samples = {}; });
    refused([](auto& c) { c.sources.pop_back(); });
    refused([](auto& c) { c.samples.values.pop_back(); });
    refused([](auto& c) { c.samples.values[5] = some_views::nan; });
    refused([](auto& c) { c.samples.classes[0] = 77; });
    for (const double bad : {0.0, -1.0, some_views::nan, some_views::infinity})
        refused([bad](auto& c) { c.temperature = bad; });
    refused([](auto& c) { c.options.trees.trees = 0; });
    expect_equal_decisions(model, furniture_recognizer());
}

/// Samples of other features have another length; trees on them would read past a description.
TEST(object_recognizer, refuses_to_restore_samples_of_other_features) {
    auto model = furniture_recognizer();
    auto longer = model.learned();
    const std::size_t n = longer.samples.rows(), columns = longer.samples.columns + 3;
    longer.samples.columns = columns;
    longer.samples.values.assign(n * columns, 0.0);
    EXPECT_THROW(model.restore(longer), std::invalid_argument);
    auto shorter = model.learned();
    shorter.samples.columns = 2;
    shorter.samples.values.assign(n * 2, 0.0);
    EXPECT_THROW(model.restore(shorter), std::invalid_argument);
}

/// Names of classes are different and not empty, and P_d is a probability.
TEST(object_recognizer, refuses_to_restore_bad_names_and_options) {
    auto model = furniture_recognizer();
    auto twice = model.learned();
    twice.names[1] = twice.names[0];
    EXPECT_THROW(model.restore(twice), std::invalid_argument);
    auto certain = model.learned();
    certain.options.min_probability = 2.0;
    EXPECT_THROW(model.restore(certain), std::invalid_argument);
    auto words = model.learned();
    words.words[0].mean[0] = some_views::nan;
    EXPECT_THROW(model.restore(words), std::invalid_argument);
}

}  // namespace
