// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <vector>

#include <boost/hana/append.hpp>
#include <boost/hana/front.hpp>
#include <boost/hana/tuple.hpp>
#include <gtest/gtest.h>

#include "laws/view_likelihood_laws.hpp"
#include "recognition/some_views.hpp"
#include <gnomon/recognition/word_histograms.hpp>

namespace rec = gnomon::recognition;
namespace hana = boost::hana;

namespace {

const auto& scaled_features() {
    static const auto features =
        rec::scaled_by_largest(rec::thesis_features, some_views::training().views);
    return features;
}

auto histograms_of(const some_views::labeled_views& t, const rec::word_histogram_options& options,
                   std::size_t classes = 3) {
    return rec::word_histograms(t.views, t.classes, classes, scaled_features(),
                                rec::thesis_relations, options);
}

const auto& thesis_histograms() {
    static const auto model = histograms_of(some_views::training(), {.max_distance = 0.10});
    return model;
}
static_assert(rec::view_likelihood<std::remove_cvref_t<decltype(thesis_histograms())>>);

/// Every combination of the options that change the terms.
std::vector<rec::word_histogram_options> histogram_variants() {
    std::vector<rec::word_histogram_options> all;
    for (int bits = 0; bits < 16; ++bits)
        all.push_back({.max_distance = 0.10,
                       .repair = (bits & 1) != 0 ? rec::covariance_repair::pooled
                                                 : rec::covariance_repair::diagonal,
                       .counts_parts = (bits & 2) != 0,
                       .one_word_per_part = (bits & 4) != 0,
                       .counts_absence = (bits & 8) != 0});
    return all;
}

/// Eq. (5.1); docs/thesis-notes.md, A33: new views may exceed 1.
TEST(scaled_by_largest, puts_the_features_of_the_training_set_into_0_to_1) {
    std::array<double, 5> largest{};
    for (const auto& v : some_views::training().views) {
        for (const auto& p : v.parts) {
            const auto x = rec::feature_vector(scaled_features(), p, v);
            for (std::size_t f = 0; f < 5; ++f) {
                EXPECT_GE(x[f], 0.0);
                EXPECT_LE(x[f], 1.0);
                largest[f] = std::max(largest[f], x[f]);
            }
        }
    }
    EXPECT_EQ(largest[0], 1.0);
    EXPECT_EQ(largest[4], 1.0);
    EXPECT_EQ(rec::feature_weights(scaled_features()), rec::feature_weights(rec::thesis_features));
    const auto v = some_views::strange_view();
    EXPECT_GT(rec::feature_vector(scaled_features(), v.parts[0], v)[0], 1.0);
}

TEST(scaled_by_largest, needs_the_ground_and_leaves_other_features_alone) {
    auto views = some_views::training().views;
    const auto own = hana::make_tuple(some_views::share_of_points{.scale = 0.7});
    EXPECT_EQ(hana::front(rec::scaled_by_largest(own, views)).scale, 0.7);
    views[1].ground.reset();
    EXPECT_THROW((void)rec::scaled_by_largest(rec::thesis_features, views), std::invalid_argument);
}

/// Boards without noise have no volume; that of a new view stays small.
TEST(scaled_by_largest, has_scales_where_all_values_of_the_training_set_are_zero) {
    gnomon::random_stream random(1);
    some_views::cloud flat;
    flat.add_board({0.0, 0.0, 0.5}, {0.2, 0.0, 0.0}, {0.0, 0.2, 0.0}, 50, random, 0.0);
    std::vector<rec::view> views{some_views::view_of(flat)};
    for (auto& p : views[0].parts) p.shape.frame.box_size[2] = 0.0;
    const auto features = rec::scaled_by_largest(rec::thesis_features, views);
    const auto& v = some_views::fresh().views[0];
    const auto unscaled = rec::scaled_by_largest(rec::thesis_features, {});
    for (const auto& chosen : {features, unscaled})
        for (const double x : rec::feature_vector(chosen, v.parts[0], v)) EXPECT_LT(x, 1e6);
}

TEST(word_histograms, recognize_fresh_views) {
    const auto& fresh = some_views::fresh();
    for (const auto& options : histogram_variants()) {
        const auto model = histograms_of(some_views::training(), options);
        std::size_t right = 0;
        for (std::size_t i = 0; i < fresh.views.size(); ++i)
            right += rec::explain(model, fresh.views[i]).best == fresh.classes[i];
        EXPECT_GE(right, fresh.views.size() - 2);
    }
}

TEST(word_histograms, have_evidence_that_sums_to_the_decision) {
    for (const auto& options : histogram_variants()) {
        const auto model = histograms_of(some_views::training(), options);
        for (const auto& v : some_views::fresh().views) {
            const auto found = rec::explain(model, v);
            EXPECT_NEAR(some_views::sum_of_probability(found), 1.0, 1e-12);
            EXPECT_NEAR(some_views::sum_of_evidence(found), found.log_ratio, 1e-9);
            for (const auto& e : found.evidence) {
                EXPECT_TRUE(std::isfinite(e.log_ratio));
                if (e.kind == rec::term_kind::part) {
                    EXPECT_LT(e.first, v.parts.size());
                    EXPECT_LT(e.word, model.words().words.size());
                } else if (e.kind != rec::term_kind::part_count) {
                    EXPECT_LT(e.first, e.second);
                    EXPECT_LT(e.second, v.parts.size());
                    EXPECT_LT(e.word, model.relation_words().size());
                    EXPECT_TRUE(options.counts_absence || e.kind == rec::term_kind::pair);
                }
            }
        }
    }
}

TEST(word_histograms, obey_the_laws) {
    for (const auto& v : some_views::fresh().views)
        laws::view_likelihood_laws(thesis_histograms(), v);
    laws::view_likelihood_laws(thesis_histograms(), some_views::empty_view());
}

TEST(word_histograms, give_one_word_to_a_part_on_request) {
    const auto model =
        histograms_of(some_views::training(), {.max_distance = 0.10, .one_word_per_part = true});
    for (const auto& v : some_views::fresh().views) {
        std::vector<int> words(v.parts.size(), 0);
        for (const auto& t : model(v))
            if (t.kind == rec::term_kind::part) ++words[t.first];
        for (const int n : words) EXPECT_LE(n, 1);
    }
}

/// Eqs. (5.5) to (5.8), docs/thesis-notes.md, A28: the probabilities of the words of a class have
/// the sum 1; shares of related pairs are in [0, 1], mostly near 1 on the training set.
TEST(word_histograms, have_entries_that_are_probabilities) {
    const auto& model = thesis_histograms();
    ASSERT_GT(model.words().words.size(), 2u);
    ASSERT_FALSE(model.relation_words().empty());
    std::vector<double> seen;
    for (const auto& row : model.relation_shares()) {
        ASSERT_EQ(row.size(), 3u);
        for (const double share : row) {
            EXPECT_GT(share, 0.0);
            EXPECT_LE(share, 1.0);
            seen.push_back(share);
        }
    }
    std::nth_element(seen.begin(), seen.begin() + static_cast<std::ptrdiff_t>(seen.size() / 2),
                     seen.end());
    EXPECT_GE(seen[seen.size() / 2], 0.9);

    std::vector<std::vector<double>> shares(model.words().words.size());
    for (const auto& v : some_views::training().views)
        for (const auto& t : model(v))
            if (t.kind == rec::term_kind::part) shares[t.word] = t.log_likelihood;
    for (std::size_t c = 0; c < 3; ++c) {
        double sum = 0.0;
        for (const auto& s : shares) {
            ASSERT_EQ(s.size(), 3u);
            sum += std::exp(s[c]);
        }
        EXPECT_NEAR(sum, 1.0, 1e-12);
    }
}

/// docs/thesis-notes.md, A27: by the formula, a missing relation is no evidence; on request it is.
TEST(word_histograms, count_missing_relations_on_request) {
    auto v = some_views::fresh().views[0];
    for (auto& p : v.parts) p.shape.normal = Eigen::Vector3d(0.6, 0.0, 0.8);  // no right angles
    const auto number = [&](bool counts_absence) {
        const auto model = histograms_of(some_views::training(),
                                         {.max_distance = 0.10, .counts_absence = counts_absence});
        const auto terms = model(v);
        return std::count_if(terms.begin(), terms.end(), [](const rec::term& t) {
            return t.kind == rec::term_kind::missing_pair;
        });
    };
    EXPECT_EQ(number(false), 0);
    EXPECT_GT(number(true), 0);
}

/// docs/thesis-notes.md, A29: a view in which no word is detected is background, for every P_d and
/// every number of classes.
TEST(word_histograms, take_views_without_words_for_background) {
    const auto strange = some_views::strange_view();
    ASSERT_FALSE(strange.parts.empty());
    const auto& model = thesis_histograms();
    EXPECT_TRUE(model(strange).empty());
    EXPECT_TRUE(rec::explain(model, strange).is_background());
    EXPECT_TRUE(rec::explain(model, strange, {.min_probability = 0.3}).is_background());
    auto single = some_views::training();
    single.classes.assign(single.classes.size(), 0);
    EXPECT_TRUE(
        rec::explain(histograms_of(single, {.max_distance = 0.10}, 1), strange).is_background());
}

TEST(word_histograms, work_on_views_of_no_part_or_one) {
    const auto& model = thesis_histograms();
    const auto& v = some_views::fresh().views[0];
    const auto none = rec::explain(model, some_views::with_parts(v, 0));
    EXPECT_TRUE(none.is_background());
    const auto one = rec::explain(model, some_views::with_parts(v, 1));
    EXPECT_NEAR(some_views::sum_of_evidence(one), one.log_ratio, 1e-9);
    std::vector<rec::view> views;
    for (const auto& w : some_views::training().views)
        views.push_back(some_views::with_parts(w, 1));
    const rec::word_histograms parts_only(views, some_views::training().classes, 3,
                                          scaled_features(), rec::thesis_relations,
                                          {.max_distance = 0.10});
    EXPECT_TRUE(parts_only.relation_words().empty());
    EXPECT_TRUE(std::isfinite(rec::explain(parts_only, v).log_ratio));
}

TEST(word_histograms, take_features_and_relations_of_a_user_or_no_relations) {
    const auto& t = some_views::training();
    const rec::word_histograms own(
        t.views, t.classes, 3, hana::append(scaled_features(), some_views::share_of_points{}),
        hana::append(rec::thesis_relations, some_views::ratio_of_points{}), {.max_distance = 0.10});
    const rec::word_histograms none(t.views, t.classes, 3, scaled_features(), rec::no_relations,
                                    {.max_distance = 0.10});
    EXPECT_TRUE(std::any_of(own.relation_words().begin(), own.relation_words().end(),
                            [](const auto& w) { return w.relation == 2; }));
    EXPECT_TRUE(none.relation_words().empty());
    for (const auto& v : some_views::fresh().views) {
        for (const auto& found : {rec::explain(own, v), rec::explain(none, v)})
            EXPECT_NEAR(some_views::sum_of_evidence(found), found.log_ratio, 1e-9);
    }
}

/// Features for any pose need no ground.
TEST(word_histograms, work_without_ground) {
    const auto t = some_views::make_views(6, 4, std::nullopt);
    const rec::word_histograms model(t.views, t.classes, 3, rec::invariant_features,
                                     rec::thesis_relations, {.max_distance = 1.0});
    std::size_t right = 0;
    for (std::size_t i = 0; i < t.views.size(); ++i)
        right += rec::explain(model, t.views[i]).best == t.classes[i];
    EXPECT_GE(right, t.views.size() - 2);
    EXPECT_THROW((void)histograms_of(t, {}), std::invalid_argument);
    EXPECT_THROW((void)thesis_histograms()(t.views[0]), std::invalid_argument);
}

TEST(word_histograms, have_classes_without_views) {
    const auto model = histograms_of(some_views::training(), {.max_distance = 0.10}, 4);
    for (const auto& v : some_views::fresh().views) {
        const auto found = rec::explain(model, v);
        EXPECT_NEAR(some_views::sum_of_probability(found), 1.0, 1e-12);
        EXPECT_NE(found.best, 3u);
    }
}

TEST(word_histograms, refuse_what_does_not_fit) {
    auto t = some_views::training();
    EXPECT_THROW((void)histograms_of(t, {}, 2), std::invalid_argument);
    t.classes.pop_back();
    EXPECT_THROW((void)histograms_of(t, {}), std::invalid_argument);
    const auto& good = some_views::training();
    EXPECT_THROW(
        rec::word_histograms(good.views, good.classes, 3,
                             hana::make_tuple(some_views::nan_feature{}), rec::thesis_relations),
        std::invalid_argument);
}

TEST(word_histograms, refuse_options_out_of_range) {
    const auto& t = some_views::training();
    const double nan = some_views::nan;
    for (const double bad : {-0.1, nan})
        EXPECT_THROW((void)histograms_of(t, {.max_distance = bad}), std::invalid_argument);
    for (const double bad : {0.0, 1.0, nan})
        EXPECT_THROW((void)histograms_of(t, {.inlier_probability = bad}), std::invalid_argument);
    for (const double bad : {-1.0, nan, some_views::infinity})
        EXPECT_THROW((void)histograms_of(t, {.smoothing = bad}), std::invalid_argument);
}

/// Without smoothing, a word that a class never had excludes the class; nothing is NaN.
TEST(word_histograms, work_or_refuse_without_smoothing) {
    try {
        const auto model =
            histograms_of(some_views::training(), {.max_distance = 0.10, .smoothing = 0.0}, 4);
        for (const auto& v : some_views::fresh().views)
            for (const double p : rec::explain(model, v).probability) EXPECT_TRUE(std::isfinite(p));
    } catch (const std::invalid_argument&) {
    }
}

/// A clustering of other parts does not fit.
TEST(word_histograms, refuse_a_clustering_of_other_parts) {
    const auto& t = some_views::training();
    const std::vector<std::array<double, 5>> samples(8);
    const auto clusters = rec::greedy_means(samples);
    EXPECT_THROW(rec::word_histograms(t.views, t.classes, 3, scaled_features(),
                                      rec::thesis_relations, clusters, {}),
                 std::invalid_argument);
}

TEST(word_histograms, refuse_relations_that_are_not_finite) {
    const auto& t = some_views::training();
    EXPECT_THROW(
        rec::word_histograms(t.views, t.classes, 3, scaled_features(),
                             hana::make_tuple(some_views::nan_relation{}), {.max_distance = 0.10}),
        std::invalid_argument);
}

}  // namespace
