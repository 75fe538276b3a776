// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include <gnomon/recognition/learned_views.hpp>

namespace rec = gnomon::recognition;

namespace {

rec::learned_views<2> two_classes() {
    rec::learned_views<2> learned;
    for (const double x : {0.0, 1.0}) {
        const double sample[] = {x, 2.0, 3.0};
        learned.samples.add(sample, learned.class_number(x == 0.0 ? "chair" : "table"));
        learned.sources.push_back(static_cast<std::uint32_t>(x));
    }
    learned.words.resize(1);
    learned.words[0].add({0.5, 0.5});
    return learned;
}

TEST(learned_views, number_classes_in_the_order_of_their_first_names) {
    rec::learned_views<2> learned;
    EXPECT_EQ(learned.class_number("chair"), 0u);
    EXPECT_EQ(learned.class_number("table"), 1u);
    EXPECT_EQ(learned.class_number("chair"), 0u);
    EXPECT_EQ(learned.names.size(), 2u);
}

TEST(learned_views, try_other_features_as_often_with_those_of_pairs_as_without) {
    rec::learned_views<2> learned;
    learned.samples.columns = 100;
    EXPECT_EQ(learned.tree_options(0).features_per_split, 20u);
    learned.samples.columns = 150;  // a third of the draws are those of pairs
    EXPECT_EQ(learned.tree_options(50).features_per_split, 30u);
    EXPECT_EQ(learned.tree_options(150).features_per_split, 0u);
    learned.options.trees.features_per_split = 7;
    EXPECT_EQ(learned.tree_options(50).features_per_split, 7u);
}

TEST(learned_views, refuse_what_does_not_fit_together) {
    EXPECT_NO_THROW(two_classes().require_consistent());
    const auto refuses = [](auto&& change) {
        auto learned = two_classes();
        change(learned);
        EXPECT_THROW(learned.require_consistent(), std::invalid_argument);
    };
    refuses([](auto& l) { l.names.pop_back(); });
    refuses([](auto& l) { l.sources.pop_back(); });
    refuses([](auto& l) { l.sources.back() = 0xffffffff; });  // the next one would be 0
    refuses([](auto& l) { l.samples.values.pop_back(); });
    refuses([](auto& l) { l.samples.classes[1] = 2; });
    refuses([](auto& l) { l.samples.values[3] = std::nan(""); });
    refuses([](auto& l) { l.temperature = 0.0; });
    refuses([](auto& l) { l.temperature = 1e-310; });
    refuses([](auto& l) { l.temperature = std::numeric_limits<double>::infinity(); });
    refuses([](auto& l) { l.options.min_probability = 1.5; });
    refuses([](auto& l) { l.options.max_word_distance = std::numeric_limits<double>::infinity(); });
    refuses([](auto& l) { l.words[0].mean[0] = std::nan(""); });
    refuses([](auto& l) { l.words[0].count = 0; });
    refuses([](auto& l) { l.words[0].count = std::numeric_limits<std::size_t>::max(); });
}

}  // namespace
