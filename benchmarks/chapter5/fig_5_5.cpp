// SPDX-License-Identifier: BSL-1.0
// The dictionary of the thesis, Secs. 5.6.1 and 5.6.2, Fig. 5.5: part words, what they are, whether
// they are normal (Sec. 5.3.3), relation words, and x-means in place of greedy means (Sec. 5.8.3).
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "outcomes.hpp"
#include "views.hpp"
#include <gnomon/recognition/greedy_means.hpp>
#include <gnomon/recognition/normality.hpp>
#include <gnomon/recognition/part_features.hpp>
#include <gnomon/recognition/part_relation.hpp>
#include <gnomon/recognition/relation_words.hpp>
#include <gnomon/recognition/word_histograms.hpp>
#include <gnomon/recognition/x_means.hpp>

namespace {

constexpr double level = 0.05;  // of significance, Sec. 5.3.3
constexpr std::array<double, 2> thresholds{0.10, 0.03};
using sample = std::array<double, 5>;
using clusters = rec::clustering<5>;

/// The parts of all views, their features, and their true names.
struct samples {
    std::vector<sample> features;
    std::vector<std::string> kinds;   ///< "leg"
    std::vector<std::string> pieces;  ///< "stool/leg"

    samples(const view_set& set, const std::vector<std::string>& names) {
        const auto scaled = rec::scaled_by_largest(rec::thesis_features, set.views);
        for (std::size_t i = 0; i < set.views.size(); ++i) {
            for (std::size_t p = 0; p < set.views[i].parts.size(); ++p) {
                features.push_back(
                    rec::feature_vector(scaled, set.views[i].parts[p], set.views[i]));
                kinds.push_back(set.parts[i][p]);
                pieces.push_back(names[set.classes[i]] + "/" + set.parts[i][p]);
            }
        }
    }
};

/// The names of the samples of a cluster, the most frequent ones first.
std::vector<std::pair<std::size_t, std::string>> counts_of(const clusters& found, std::size_t c,
                                                           const std::vector<std::string>& names) {
    std::map<std::string, std::size_t> counts;
    for (const std::size_t i : found.members(static_cast<std::ptrdiff_t>(c))) ++counts[names[i]];
    std::vector<std::pair<std::size_t, std::string>> order;
    for (const auto& [name, n] : counts) order.emplace_back(n, name);
    std::ranges::sort(order, [](const auto& a, const auto& b) { return a.first > b.first; });
    return order;
}

/// The share of the samples of clusters that have the most frequent name of their cluster.
double purity(const clusters& found, const std::vector<std::string>& names) {
    std::size_t right = 0, all = 0;
    for (std::size_t c = 0; c < found.clusters.size(); ++c) {
        right += counts_of(found, c, names).front().first;
        all += found.clusters[c].count;
    }
    return static_cast<double>(right) / static_cast<double>(all);
}

std::size_t largest(const clusters& found) {
    const auto at =
        std::ranges::max_element(found.clusters, {}, [](const auto& c) { return c.count; });
    return static_cast<std::size_t>(at - found.clusters.begin());
}

/// The relation words of the clusters that the parts of the views are in.
template <class Relations>
std::array<std::size_t, 2> relation_words(const view_set& set, const clusters& found,
                                          const Relations& relations, std::size_t support) {
    rec::relation_statistics<2> statistics;
    std::size_t first = 0;
    for (const rec::view& v : set.views) {
        for (std::size_t j = 0; j < v.parts.size(); ++j) {
            for (std::size_t i = 0; i < j; ++i) {
                const auto a = found.labels[first + i], b = found.labels[first + j];
                if (a < 0 || b < 0) continue;
                statistics.add(static_cast<std::size_t>(a), static_cast<std::size_t>(b),
                               rec::relation_vector(relations, v.parts[i], v.parts[j]));
            }
        }
        first += v.parts.size();
    }
    std::array<std::size_t, 2> counts{};
    for (const auto& word : statistics.words(relations, support)) ++counts[word.relation];
    return counts;
}

/// The shares of words that are not normal, of those that can be tested.
struct normality {
    std::size_t words = 0;          ///< with members enough
    double anderson_darling = 0.0;  ///< in one feature or more
    double mardia = 0.0;            ///< by skewness or kurtosis
    double energy = 0.0;

    normality(const samples& all, const clusters& found) {
        for (std::size_t c = 0; c < found.clusters.size(); ++c) {
            std::vector<sample> members;
            for (const std::size_t i : found.members(static_cast<std::ptrdiff_t>(c)))
                members.push_back(all.features[i]);
            const auto by_energy = rec::energy_normality(members, {}, gnomon::threads{});
            const auto by_feature = rec::anderson_darling(members);
            constexpr std::size_t fewest = 8;  // of Anderson and Darling
            if (by_energy.outcome != rec::test_outcome::tested || members.size() < fewest) continue;
            ++words;
            // Of five tests one rejects at this level with the probability of `level` in all.
            const bool rejected = std::ranges::any_of(by_feature, [](const auto& t) {
                return t.rejects(level / static_cast<double>(std::tuple_size_v<sample>));
            });
            const auto moments = rec::mardia_normality(members);
            anderson_darling += rejected ? 1.0 : 0.0;
            mardia += moments.skewness.rejects(0.5 * level) || moments.kurtosis.rejects(0.5 * level)
                          ? 1.0
                          : 0.0;
            energy += by_energy.rejects(level) ? 1.0 : 0.0;
        }
        const double n = static_cast<double>(std::max<std::size_t>(1, words));
        anderson_darling /= n;
        mardia /= n;
        energy /= n;
    }
};

/// Medians of columns, over the seeds, by the name of the row.
class medians {
  public:
    using columns = std::vector<std::pair<std::string, double>>;

    void add(const json& key, const columns& values) {
        auto at = std::ranges::find_if(rows_, [&](const auto& r) { return r.first == key; });
        if (at == rows_.end()) {
            rows_.emplace_back(key, std::vector<columns>{values});
            return;
        }
        at->second.push_back(values);
    }
    [[nodiscard]] json table(int digits) const {
        json rows = json::array();
        for (const auto& [key, seeds] : rows_) {
            json row = key;
            for (std::size_t column = 0; column < seeds[0].size(); ++column) {
                std::vector<double> values;
                for (const auto& s : seeds) values.push_back(s[column].second);
                row[seeds[0][column].first] = rounded(median_of(values), digits);
            }
            std::printf("%s\n", row.dump().c_str());
            rows.push_back(row);
        }
        return rows;
    }

  private:
    std::vector<std::pair<json, std::vector<columns>>> rows_;
};

class study {
  public:
    explicit study(const effort& much) : much_(much) {
        for (std::uint64_t s = 0; s < much.seeds(); ++s) add_seed(first_seed + s);
    }

    json tables() const {
        return {{"dictionary", dictionary_},
                {"most frequent words", words_},
                {"relation words by critical mass and support", relations_.table(0)},
                {"words that are not normal", normality_.table(3)},
                {"purity of clusters", purity_.table(3)}};
    }

  private:
    void add_seed(std::uint64_t seed) {
        const auto models = sim::furniture_models();
        const auto names = names_of(models);
        const view_set set = views_of(
            scans_of(models, views_per_model(much_), {}, seed, purpose::learning), thesis_density);
        const samples all(set, names);
        const auto weights = rec::feature_weights(rec::thesis_features);
        for (const double rho : thresholds) {
            const clusters found = rec::greedy_means(
                all.features, {.max_distance = rho, .distance = {.weights = weights}});
            add_words(seed, rho, all, found, set);
            const normality n(all, found);
            normality_.add({{"rho", rho}}, {{"words tested", static_cast<double>(n.words)},
                                            {"Anderson-Darling, a feature", n.anderson_darling},
                                            {"Mardia", n.mardia},
                                            {"energy", n.energy}});
            add_purity("greedy means", rho, all, found);
            add_purity("x-means, not more words", rho, all,
                       rec::x_means(all.features, {.max_clusters = found.clusters.size()}));
        }
        // By its own criterion it does not depend on rho.
        add_purity("x-means", 0.0, all, rec::x_means(all.features));
    }

    void add_words(std::uint64_t seed, double rho, const samples& all, const clusters& found,
                   const view_set& set) {
        const std::size_t top = largest(found);
        const auto kinds = counts_of(found, top, all.kinds);
        std::size_t kept = 0;
        for (const auto& c : found.clusters) kept += c.count;
        const auto relations = relation_words(set, found, rec::thesis_relations, 4);
        dictionary_.push_back(
            {{"seed", seed},
             {"rho", rho},
             {"parts", all.features.size()},
             {"part words", found.clusters.size()},
             {"the thesis", rho > 0.05 ? "24" : "110"},
             {"parts in words",
              rounded(static_cast<double>(kept) / static_cast<double>(all.kinds.size()), 3)},
             {"most frequent word", kinds.front().second},
             {"angle words", relations[0]},
             {"distance words", relations[1]},
             {"of the thesis", rho > 0.05 ? "7 + 2" : "45 + 307"}});
        std::printf("%s\n", dictionary_.back().dump().c_str());
        if (seed == first_seed) add_most_frequent(rho, all, found);
        for (const double mass : {1.0, 2.0, 3.0, 5.0}) {
            for (const std::size_t support : {4u, 10u, 20u, 40u}) {
                auto of = rec::thesis_relations;
                of[boost::hana::size_c<0>].mass *= mass;
                of[boost::hana::size_c<1>].mass *= mass;
                const auto counts = relation_words(set, found, of, support);
                relations_.add({{"rho", rho},
                                {"mass of angles [%]", rounded(10.0 * mass, 0)},
                                {"of distances [%]", rounded(5.0 * mass, 0)},
                                {"least support", support}},
                               {{"angle words", static_cast<double>(counts[0])},
                                {"distance words", static_cast<double>(counts[1])}});
            }
        }
    }

    void add_most_frequent(double rho, const samples& all, const clusters& found) {
        std::vector<std::size_t> order(found.clusters.size());
        for (std::size_t c = 0; c < order.size(); ++c) order[c] = c;
        std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
            return found.clusters[a].count > found.clusters[b].count;
        });
        constexpr std::size_t shown = 6;
        order.resize(std::min(order.size(), shown));
        for (const std::size_t c : order) {
            const auto kinds = counts_of(found, c, all.kinds);
            const double n = static_cast<double>(found.clusters[c].count);
            const auto share = [&](std::size_t k) {
                return rounded(static_cast<double>(kinds[k].first) / n, 2);
            };
            json row{{"rho", rho}, {"parts", found.clusters[c].count}};
            row["most are"] = kinds[0].second;
            row["share"] = share(0);
            row["then"] = kinds.size() > 1 ? kinds[1].second : "-";
            row["their share"] = kinds.size() > 1 ? share(1) : 0.0;
            row["models"] = counts_of(found, c, all.pieces).size();
            words_.push_back(row);
        }
    }

    void add_purity(const char* method, double rho, const samples& all, const clusters& found) {
        json key{{"method", method}};
        if (rho > 0.0)
            key["rho"] = rho;
        else
            key["rho"] = "-";
        purity_.add(key, {{"words", static_cast<double>(found.clusters.size())},
                          {"one kind of part", purity(found, all.kinds)},
                          {"a part of one model", purity(found, all.pieces)}});
    }

    effort much_;
    json dictionary_ = json::array(), words_ = json::array();
    medians relations_, normality_, purity_;
};

json measure(const effort& much) { return study(much).tables(); }

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, measure); }
