// SPDX-License-Identifier: BSL-1.0
// A type that each concept of recognition refuses; docs/concepts quotes the messages.
#include <cstddef>
#include <string_view>
#include <vector>

#include <gnomon/recognition/part_feature.hpp>
#include <gnomon/recognition/part_relation.hpp>
#include <gnomon/recognition/posterior.hpp>
#include <gnomon/recognition/view.hpp>

namespace rec = gnomon::recognition;

// expect: f\.scale
// [refused_part_feature]
struct unscaled {
    static constexpr std::string_view name = "height";
    double weight = 1.0;
    double operator()(const rec::part& p, const rec::view& v) const;
};
static_assert(rec::part_feature<unscaled>);  // has no scale
// [refused_part_feature]

// expect: r\(a, b\)
// [refused_part_relation]
struct of_one_part {
    static constexpr std::string_view name = "height";
    double bin = 0.05, mass = 0.10, min_deviation = 0.02;
    double operator()(const rec::part& p) const;
};
static_assert(rec::part_relation<of_one_part>);  // takes one part
// [refused_part_relation]

// expect: l\.classes\(\)
// [refused_view_likelihood]
struct of_no_classes {
    std::vector<rec::term> operator()(const rec::view& v) const;
};
static_assert(rec::view_likelihood<of_no_classes>);  // no classes()
// [refused_view_likelihood]

int main() {}
