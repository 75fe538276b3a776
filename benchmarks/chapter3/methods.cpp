// SPDX-License-Identifier: BSL-1.0
#include "methods.hpp"

#include <algorithm>
#include <stdexcept>

#include <benchmark/benchmark.h>
#include <boost/hana/for_each.hpp>

#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/registry.hpp>

namespace {

/// An estimator of the registry with the standard deviation of the noise, if it uses one.
template <class E>
E with_noise(E estimate, double sigma) {
    if constexpr (requires { estimate.noise; }) {
        if (sigma > 0.0) estimate.noise = gnomon::constant_noise{sigma};
    } else if constexpr (requires { estimate.sigma; }) {
        if (sigma > 0.0) estimate.sigma = sigma;
    }
    return estimate;
}

std::vector<method> unfolded(const auto& registry) {
    std::vector<method> all;
    boost::hana::for_each(registry, [&](const auto& entry) {
        const auto estimate = entry.policy;
        all.push_back(
            {entry.name,
             [estimate](const labeled_cloud& cloud, const gnomon::adjacency& graph, double sigma) {
                 benchmark::DoNotOptimize(gnomon::estimate_normals(cloud.scan, graph,
                                                                   with_noise(estimate, sigma),
                                                                   gnomon::threads{1})
                                              .data());
             },
             [estimate](const labeled_cloud& cloud, const gnomon::adjacency& graph, double sigma) {
                 return gnomon::normal_quality::of(
                     gnomon::estimate_normals(cloud.scan, graph, with_noise(estimate, sigma),
                                              gnomon::threads{}),
                     cloud.normals);
             }});
    });
    return all;
}

}  // namespace

std::vector<method> thesis_methods() { return unfolded(gnomon::thesis_estimators); }

std::vector<method> methods(const std::vector<std::string>& names) {
    const std::vector<method> all = unfolded(gnomon::estimators);
    std::vector<method> chosen;
    for (const std::string& name : names) {
        const auto found =
            std::find_if(all.begin(), all.end(), [&](const method& m) { return m.name == name; });
        if (found == all.end()) throw std::invalid_argument("no estimator is called " + name);
        chosen.push_back(*found);
    }
    return chosen;
}
