// SPDX-License-Identifier: BSL-1.0
/// @file
/// Finds part words and relation words in views. Klasing 2010, Eqs. (5.3) and (5.4).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <gnomon/recognition/part_feature.hpp>
#include <gnomon/recognition/part_relation.hpp>
#include <gnomon/recognition/relation_words.hpp>
#include <gnomon/recognition/view.hpp>
#include <gnomon/recognition/vocabulary.hpp>

namespace gnomon::recognition::detail {

/// The words that are detected in a view.
struct detected_words {
    /// A pair of parts that are examples of the two words of a relation word.
    struct pair {
        std::size_t first, second, word;
        bool is_related;  ///< whether the value of the relation is also that of the word
    };
    std::vector<std::pair<std::size_t, std::size_t>> parts;  ///< part and word
    std::vector<pair> pairs;
};

/// Part words and relation words, ready to be detected.
template <class Features, class Relations>
struct word_detector {
    Features features;
    Relations relations;
    bool one_word_per_part = false;
    vocabulary<feature_count<Features>> words = {};
    double max_deviations = 0.0;  ///< delta_r of relation words
    std::vector<relation_word> relation_words = {};
    /// The relation words of each pair of part words.
    std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> words_of_pair = {};

    [[nodiscard]] std::vector<std::size_t> words_of(const part& p, const view& v) const {
        const auto sample = feature_vector(features, p, v);
        std::vector<std::size_t> found;
        if (one_word_per_part) {
            const auto nearest = words.nearest(sample);
            if (nearest && nearest->distance <= words.max_distance) found.push_back(nearest->word);
        } else {
            for (const detection& d : words.detections(sample)) found.push_back(d.word);
        }
        return found;
    }

    /// All words of all parts, and all relation words whose two words are detected. Two parts that
    /// are both examples of both words of a pair are counted once.
    [[nodiscard]] detected_words operator()(const view& v) const {
        detected_words found;
        std::vector<std::vector<std::size_t>> of_part;
        for (std::size_t i = 0; i < v.parts.size(); ++i) {
            of_part.push_back(words_of(v.parts[i], v));
            for (const std::size_t w : of_part[i]) found.parts.emplace_back(i, w);
        }
        for (std::size_t j = 0; j < v.parts.size(); ++j) {
            for (std::size_t i = 0; i < j; ++i) {
                if (of_part[i].empty() || of_part[j].empty()) continue;
                const auto values = relation_vector(relations, v.parts[i], v.parts[j]);
                std::set<std::pair<std::size_t, std::size_t>> seen;
                for (const std::size_t a : of_part[i])
                    for (const std::size_t b : of_part[j]) seen.insert(std::minmax(a, b));
                for (const auto& pair : seen) {
                    const auto at = words_of_pair.find(pair);
                    if (at == words_of_pair.end()) continue;
                    for (const std::size_t q : at->second) {
                        const auto& word = relation_words[q];
                        found.pairs.push_back(
                            {i, j, q, word.detects(values[word.relation], max_deviations)});
                    }
                }
            }
        }
        return found;
    }
};

}  // namespace gnomon::recognition::detail
