// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include <boost/hana/append.hpp>
#include <boost/hana/tuple.hpp>
#include <gtest/gtest.h>

#include "laws/view_likelihood_laws.hpp"
#include "recognition/some_views.hpp"
#include <gnomon/recognition/part_features.hpp>
#include <gnomon/recognition/part_kernels.hpp>

namespace rec = gnomon::recognition;
namespace hana = boost::hana;

namespace {

auto kernels_of(const some_views::labeled_views& t, const rec::part_kernel_options& options = {},
                std::size_t classes = 3) {
    return rec::part_kernels(t.views, t.classes, classes, rec::default_features,
                             rec::default_relations, options);
}

const auto& default_kernels() {
    static const auto model = kernels_of(some_views::training());
    return model;
}
static_assert(rec::view_likelihood<std::remove_cvref_t<decltype(default_kernels())>>);

TEST(part_kernels, recognize_fresh_views) {
    const auto& fresh = some_views::fresh();
    for (const double pair_weight : {0.0, 0.5}) {
        const auto model = kernels_of(some_views::training(), {.pair_weight = pair_weight});
        std::size_t right = 0;
        for (std::size_t i = 0; i < fresh.views.size(); ++i)
            right += rec::explain(model, fresh.views[i]).best == fresh.classes[i];
        EXPECT_GE(right, fresh.views.size() - 1);
    }
}

TEST(part_kernels, learn_view_by_view_as_at_once) {
    const auto& t = some_views::training();
    rec::part_kernels piecewise(3, rec::default_features, rec::default_relations);
    for (std::size_t i = 0; i < t.views.size(); ++i) {
        piecewise.learn(t.views[i], t.classes[i]);
        if (i == t.views.size() / 2) piecewise.calibrate();
    }
    piecewise.calibrate();
    EXPECT_EQ(piecewise.temperature(), default_kernels().temperature());
    for (const auto& v : some_views::fresh().views) {
        EXPECT_EQ(rec::explain(piecewise, v).probability,
                  rec::explain(default_kernels(), v).probability);
    }
    EXPECT_THROW(piecewise.learn(t.views[0], 3), std::invalid_argument);
}

TEST(part_kernels, have_evidence_that_sums_to_the_decision) {
    for (const bool counts_parts : {false, true}) {
        for (const double pair_weight : {0.0, 0.5}) {
            const auto model = kernels_of(
                some_views::training(), {.pair_weight = pair_weight, .counts_parts = counts_parts});
            for (const auto& v : some_views::fresh().views) {
                const auto found = rec::explain(model, v, {.temperature = model.temperature()});
                const std::size_t n = v.parts.size();
                EXPECT_EQ(found.evidence.size(),
                          n + (pair_weight > 0.0 ? n * (n - 1) / 2 : 0) + (counts_parts ? 1 : 0));
                EXPECT_NEAR(some_views::sum_of_evidence(found), found.log_ratio, 1e-9);
                EXPECT_NEAR(some_views::sum_of_probability(found), 1.0, 1e-12);
            }
        }
    }
}

TEST(part_kernels, obey_the_laws) {
    for (const auto& v : some_views::fresh().views)
        laws::view_likelihood_laws(default_kernels(), v);
    laws::view_likelihood_laws(default_kernels(), some_views::empty_view());
}

/// Oracle: the mean of the kernels of one feature, written out.
TEST(part_kernels, are_the_mean_of_gaussian_kernels) {
    const auto& t = some_views::training();
    const auto one = hana::make_tuple(rec::mean_height{.scale = 0.1});
    const rec::part_kernels model(
        t.views, t.classes, 3, one, rec::no_relations,
        {.bandwidth = 0.7, .least_share = 1e-3, .pair_weight = 0.0, .counts_parts = false});
    const auto& v = some_views::fresh().views[1];
    const auto terms = model(v);
    ASSERT_EQ(terms.size(), v.parts.size());
    for (std::size_t i = 0; i < v.parts.size(); ++i) {
        const double x = rec::mean_height{}(v.parts[i], v) / 0.1;
        for (std::uint32_t c = 0; c < 3; ++c) {
            double sum = 0.0, n = 0.0;
            for (std::size_t k = 0; k < t.views.size(); ++k) {
                if (t.classes[k] != c) continue;
                for (const auto& p : t.views[k].parts) {
                    const double d = (x - rec::mean_height{}(p, t.views[k]) / 0.1) / 0.7;
                    sum += std::exp(-0.5 * d * d);
                    n += 1.0;
                }
            }
            EXPECT_NEAR(terms[i].log_likelihood[c], std::log(1e-3 + sum / n), 1e-9);
        }
    }
}

/// The temperature is that of views without themselves: with themselves, it would be the least one.
TEST(part_kernels, leave_out_a_view_in_calibration) {
    auto t = some_views::training();
    for (std::size_t i = 0; i < t.classes.size(); ++i)
        t.classes[i] = static_cast<std::uint32_t>((i / 3) % 2);  // labels without meaning
    const auto model = rec::part_kernels(t.views, t.classes, 2, rec::default_features,
                                         rec::no_relations, {.bandwidth = 0.05});
    EXPECT_GT(model.temperature(), 2.0);
}

TEST(part_kernels, work_on_views_of_no_part_or_one) {
    const auto& v = some_views::fresh().views[0];
    EXPECT_TRUE(default_kernels()(some_views::with_parts(v, 0)).empty());
    EXPECT_TRUE(rec::explain(default_kernels(), some_views::with_parts(v, 0)).is_background());
    const auto one = rec::explain(default_kernels(), some_views::with_parts(v, 1));
    EXPECT_NEAR(some_views::sum_of_evidence(one), one.log_ratio, 1e-9);
    for (const auto& w : {some_views::strange_view(), some_views::with_parts(v, 2)}) {
        const auto found = rec::explain(default_kernels(), w);
        EXPECT_TRUE(std::isfinite(found.log_ratio));
        EXPECT_NEAR(some_views::sum_of_probability(found), 1.0, 1e-12);
    }
}

/// Parts unlike all others are no evidence for any class.
TEST(part_kernels, have_no_opinion_on_strange_parts) {
    const auto found = rec::explain(kernels_of(some_views::training(), {.counts_parts = false}),
                                    some_views::strange_view());
    EXPECT_NEAR(found.log_ratio, 0.0, 1e-9);
    EXPECT_TRUE(found.is_background());
}

TEST(part_kernels, take_features_and_relations_of_a_user_or_no_relations) {
    const auto& t = some_views::training();
    const rec::part_kernels own(
        t.views, t.classes, 3, hana::append(rec::default_features, some_views::share_of_points{}),
        hana::append(rec::default_relations, some_views::ratio_of_points{}));
    const rec::part_kernels none(t.views, t.classes, 3, rec::default_features, rec::no_relations);
    for (const auto& v : some_views::fresh().views) {
        for (const auto& found : {rec::explain(own, v), rec::explain(none, v)})
            EXPECT_NEAR(some_views::sum_of_evidence(found), found.log_ratio, 1e-9);
    }
}

TEST(part_kernels, work_without_ground) {
    const auto t = some_views::make_views(6, 4, std::nullopt);
    const rec::part_kernels model(t.views, t.classes, 3, rec::invariant_features,
                                  rec::thesis_relations);
    std::size_t right = 0;
    for (std::size_t i = 0; i < t.views.size(); ++i)
        right += rec::explain(model, t.views[i]).best == t.classes[i];
    EXPECT_GE(right, t.views.size() - 2);
    EXPECT_THROW((void)kernels_of(t), std::invalid_argument);
    EXPECT_THROW((void)default_kernels()(t.views[0]), std::invalid_argument);
}

TEST(part_kernels, have_one_class_and_classes_without_views) {
    auto t = some_views::training();
    const auto five = kernels_of(t, {}, 5);
    for (const auto& v : some_views::fresh().views) EXPECT_LT(rec::explain(five, v).best, 3u);
    t.classes.assign(t.classes.size(), 0);
    const auto single = rec::explain(kernels_of(t, {}, 1), some_views::fresh().views[0]);
    EXPECT_EQ(single.probability, std::vector<double>{1.0});
    EXPECT_EQ(single.second, rec::term::none);
}

TEST(part_kernels, refuse_what_does_not_fit) {
    auto t = some_views::training();
    EXPECT_THROW((void)kernels_of(t, {}, 2), std::invalid_argument);
    EXPECT_THROW(rec::part_kernels(t.views, t.classes, 3,
                                   hana::make_tuple(some_views::nan_feature{}), rec::no_relations),
                 std::invalid_argument);
    t.classes.pop_back();
    EXPECT_THROW((void)kernels_of(t), std::invalid_argument);
}

TEST(part_kernels, refuse_options_out_of_range) {
    const auto& t = some_views::training();
    for (const double bad : {0.0, -1.0, some_views::nan}) {
        EXPECT_THROW((void)kernels_of(t, {.bandwidth = bad}), std::invalid_argument);
        EXPECT_THROW((void)kernels_of(t, {.least_share = bad}), std::invalid_argument);
    }
    for (const double bad : {-1.0, some_views::nan, some_views::infinity})
        EXPECT_THROW((void)kernels_of(t, {.pair_weight = bad}), std::invalid_argument);
}

TEST(part_kernels, refuse_relations_that_are_not_finite) {
    const auto& t = some_views::training();
    EXPECT_THROW(rec::part_kernels(t.views, t.classes, 3, rec::default_features,
                                   hana::make_tuple(some_views::nan_relation{})),
                 std::invalid_argument);
}

}  // namespace
