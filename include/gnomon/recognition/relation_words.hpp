// SPDX-License-Identifier: BSL-1.0
/// @file
/// Relation words: pairs of part words that occur at one angle, or at one distance. A pair of words
/// has a word of a relation if the fullest bin of the histogram of its values holds more than a
/// critical mass. Klasing 2010, Sec. 5.2.4, Eq. (5.4).
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include <boost/hana/for_each.hpp>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/recognition/detail/chi_squared.hpp>
#include <gnomon/recognition/part_relation.hpp>

namespace gnomon::recognition {

/// Two words that are related, and how: by the distribution of the values of a relation.
struct relation_word {
    std::size_t first = 0, second = 0;   ///< part words, first <= second
    std::size_t relation = 0;            ///< its number in the tuple of relations
    double mean = 0.0, deviation = 1.0;  ///< of the values of the relation

    /// Whether a value is an example of the word. Klasing 2010, Eq. (5.4).
    /// @param delta  in standard deviations
    [[nodiscard]] bool detects(double value, double delta) const {
        return std::abs(value - mean) <= delta * deviation;
    }
};

/// The values of relations of pairs of part words, as they occur in views.
template <std::size_t D>
class relation_statistics {
  public:
    /// Adds the relations of two parts of the words a and b.
    void add(std::size_t a, std::size_t b, const std::array<double, D>& values) {
        if (a > b) std::swap(a, b);
        for (std::size_t r = 0; r < D; ++r) values_[{a, b}][r].push_back(values[r]);
    }

    /// The pairs of words that are related, in the order of their numbers.
    /// @param relations    of which bins and critical masses are taken
    /// @param min_support  least number of values
    template <class Relations>
    [[nodiscard]] std::vector<relation_word> words(const Relations& relations,
                                                   std::size_t min_support) const {
        std::vector<relation_word> found;
        for (const auto& of_pair : values_) {
            std::size_t r = 0;
            boost::hana::for_each(relations, [&](const auto& relation) {
                const std::vector<double>& x = of_pair.second[r];
                const auto n = static_cast<double>(x.size());
                if (x.size() >= min_support && fullest(x, relation.bin) > relation.mass * n)
                    found.push_back(word_of(of_pair.first, r, x, relation.min_deviation));
                ++r;
            });
        }
        return found;
    }

  private:
    [[nodiscard]] static double fullest(const std::vector<double>& x, double bin) {
        std::map<double, double> histogram;
        double most = 0.0;
        for (const double value : x)
            most = std::max(most, histogram[std::floor(value / bin)] += 1.0);
        return most;
    }

    [[nodiscard]] static relation_word word_of(std::pair<std::size_t, std::size_t> pair,
                                               std::size_t relation, const std::vector<double>& x,
                                               double min_deviation) {
        const auto n = static_cast<double>(x.size());
        const double mean = std::accumulate(x.begin(), x.end(), 0.0) / n;
        double squares = 0.0;
        for (const double value : x) squares += (value - mean) * (value - mean);
        return {pair.first, pair.second, relation, mean,
                std::max(min_deviation, std::sqrt(squares / n))};
    }

    std::map<std::pair<std::size_t, std::size_t>, std::array<std::vector<double>, D>> values_;
};

}  // namespace gnomon::recognition
