// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "recognition/some_views.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/recognition/view_novelty.hpp>

namespace rec = gnomon::recognition;

namespace {

constexpr std::uint32_t shelf = 2;

/// A recognizer that knows all furniture but one kind.
rec::object_recognizer<> recognizer_without(std::uint32_t kind) {
    rec::object_recognizer model({.trees = {.trees = 40}});
    const auto& t = some_views::training();
    for (std::size_t i = 0; i < t.views.size(); ++i)
        if (t.classes[i] != kind)
            model.learn(t.views[i], std::string(some_views::names[t.classes[i]]));
    model.fit();
    return model;
}

const rec::view_novelty<>& without_shelves() {
    static const rec::view_novelty novelty(recognizer_without(shelf));
    return novelty;
}

TEST(view_novelty, is_large_for_what_was_never_learned) {
    const auto& t = some_views::fresh();
    for (std::size_t i = 0; i < t.views.size(); ++i) {
        const double x = without_shelves()(t.views[i]);
        EXPECT_GE(x, 0.0);
        EXPECT_LE(x, 1.0);
        if (t.classes[i] == shelf) {
            EXPECT_EQ(x, 1.0) << i;
        }
    }
    EXPECT_EQ(without_shelves()(some_views::strange_view()), 1.0);
    EXPECT_EQ(without_shelves()(some_views::empty_view()), 1.0);
}

/// Fresh views of known objects are as novel as learned views that were left out: their mean is
/// that of a uniform number within four standard deviations.
TEST(view_novelty, is_about_uniform_for_what_is_known) {
    double sum = 0.0;
    const auto t = some_views::make_views(40, 3);
    std::size_t known = 0;
    for (std::size_t i = 0; i < t.views.size(); ++i) {
        if (t.classes[i] == shelf) continue;
        sum += without_shelves()(t.views[i]);
        ++known;
    }
    const auto n = static_cast<double>(known);
    EXPECT_NEAR(sum / n, 0.5, 4.0 * std::sqrt(1.0 / 12.0 * (1.0 / n + 1.0 / 24.0)));
}

/// Groups may be parts of a kind, but not of two.
TEST(view_novelty, groups_unknown_views_of_one_kind) {
    const rec::view_novelty novelty(recognizer_without(0));
    const auto t = some_views::make_views(30, 4);
    auto views = t.views;
    views.push_back(some_views::strange_view());
    const auto groups = novelty.groups_of(views);
    ASSERT_EQ(groups.size(), views.size());
    std::map<std::size_t, std::set<std::uint32_t>> kinds;
    std::map<std::size_t, std::size_t> sizes;
    for (std::size_t i = 0; i < t.views.size(); ++i) {
        kinds[groups[i]].insert(t.classes[i]);
        ++sizes[groups[i]];
    }
    for (const auto& [group, of] : kinds) EXPECT_EQ(of.size(), 1u) << group;
    EXPECT_EQ(sizes[groups.back()], 0u);  // the strange view is alone
    std::size_t large = 0;
    for (const auto& [group, size] : sizes) large += size >= 10;
    EXPECT_GE(large, 3u);
    EXPECT_TRUE(novelty.groups_of({}).empty());
    EXPECT_EQ(novelty.groups_of(views, novelty.typical_distance()), groups);
    // No limit and any: as many groups as views that differ, and one.
    EXPECT_EQ(std::ranges::max(novelty.groups_of(views, 0.0)), views.size() - 1);
    EXPECT_EQ(std::ranges::max(novelty.groups_of(views, 3.0)), 0u);
}

TEST(view_novelty, learns_a_group_by_a_name) {
    auto model = without_shelves().model();
    const auto& t = some_views::training();
    for (std::size_t i = 0; i < t.views.size(); ++i)
        if (t.classes[i] == shelf) model.learn(t.views[i], "my shelf");
    model.fit();
    const rec::view_novelty novelty(std::move(model));
    const auto& fresh = some_views::fresh();
    std::size_t novel = 0;
    for (std::size_t i = 0; i < fresh.views.size(); ++i)
        if (fresh.classes[i] == shelf) {
            novel += novelty(fresh.views[i]) == 1.0;
            EXPECT_EQ(novelty.model().names()[novelty.model().decide(fresh.views[i]).best],
                      "my shelf");
        }
    EXPECT_LE(novel, 1u);
}

TEST(view_novelty, distance_is_a_metric_of_descriptions) {
    const auto& v = some_views::fresh().views;
    for (std::size_t i = 0; i + 2 < v.size(); ++i) {
        const double ab = without_shelves().distance(v[i], v[i + 1]);
        EXPECT_EQ(without_shelves().distance(v[i], v[i]), 0.0);
        EXPECT_EQ(ab, without_shelves().distance(v[i + 1], v[i]));
        EXPECT_LE(ab, without_shelves().distance(v[i], v[i + 2]) +
                          without_shelves().distance(v[i + 2], v[i + 1]) + 1e-12);
        EXPECT_LE(ab, 3.0);
    }
}

TEST(view_novelty, does_not_depend_on_threads) {
    const rec::view_novelty parallel(without_shelves().model(), gnomon::threads{3});
    for (const rec::view& v : some_views::fresh().views)
        EXPECT_EQ(parallel(v), without_shelves()(v));
}

TEST(view_novelty, refuses_recognizers_that_are_not_fitted_and_views_without_ground) {
    EXPECT_THROW(rec::view_novelty(rec::object_recognizer<>()), std::invalid_argument);
    rec::view airborne = some_views::fresh().views[0];
    airborne.ground.reset();
    EXPECT_THROW((void)without_shelves()(airborne), std::invalid_argument);
    EXPECT_THROW((void)without_shelves().groups_of({&airborne, 1}), std::invalid_argument);
    for (const double limit : {-0.1, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_THROW((void)without_shelves().groups_of(some_views::fresh().views, limit),
                     std::invalid_argument);
}

/// Nothing is novel to views that cannot be compared with those of another scan.
TEST(view_novelty, refuses_recognizers_of_one_scan) {
    auto learned = without_shelves().model().learned();
    for (std::uint32_t& s : learned.sources) s = 0;
    rec::object_recognizer<> model;
    model.restore(std::move(learned));
    EXPECT_THROW(rec::view_novelty(std::move(model)), std::invalid_argument);
}

/// Sources of a file may all belong to the same fold: then no view was left out.
TEST(view_novelty, of_a_file_whose_sources_are_of_one_fold) {
    auto learned = without_shelves().model().learned();
    for (std::uint32_t& s : learned.sources) s *= 4;
    rec::object_recognizer<> model;
    model.restore(std::move(learned));
    const rec::view_novelty novelty(std::move(model));
    EXPECT_EQ(novelty(some_views::strange_view()), 1.0);
}

}  // namespace
