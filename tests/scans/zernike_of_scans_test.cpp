// SPDX-License-Identifier: BSL-1.0
/// @file
/// The negative result of Klasing 2010, Sec. 3.5.4: on noisy scans of uneven density, Zernike
/// descriptors of the same part differ about as much as those of different parts, unlike the five
/// features of Sec. 5.2.2.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/angle.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/features/principal_frame.hpp>
#include <gnomon/features/zernike_descriptor.hpp>
#include <gnomon/simulation/furniture.hpp>
#include <gnomon/simulation/scanner.hpp>
#include <gnomon/simulation/scene.hpp>
#include <gnomon/simulation/simulate.hpp>
#include <gnomon/simulation/trajectory.hpp>

namespace {

namespace sim = gnomon::simulation;

/// A segment with the name of its part: "kitchen chair seat".
struct seen_part {
    std::string name;
    clouds::cloud points;
};

/// The extended parts with 50 points and more of furniture in rotational scans with noise of 15 mm,
/// from 1.2 to 3 m away. Parts are those of the simulator, so that no segmentation interferes.
std::vector<seen_part> parts_of_views(std::size_t views) {
    const auto models = sim::furniture_models();
    std::vector<seen_part> all;
    for (std::size_t view = 0; view < views; ++view) {
        gnomon::random_stream random(view, 31);
        sim::scene world;
        const auto& model = models[view % models.size()];
        const double distance = random.uniform(1.2, 3.0);
        const auto turned = gnomon::degrees(random.uniform(-180.0, 180.0));
        sim::add(world, model,
                 sim::at(distance, random.uniform(-1.0, 1.0), 0.0) * sim::yaw(turned));
        const sim::rotational trajectory{.mount = sim::at(0.0, 0.0, 1.2) *
                                                  sim::pitch(gnomon::degrees(10))};
        const auto truth = sim::simulate(world, trajectory, sim::scanner{},
                                         sim::beam{.sigma = 0.015, .seed = view});
        std::map<std::int32_t, clouds::cloud> by_part;
        for (std::size_t i = 0; i < truth.scan.size(); ++i)
            if (truth.parts[i] >= 0 && truth.scan.points[i].allFinite())
                by_part[truth.parts[i]].push_back(truth.scan.points[i]);
        for (auto& [part, points] : by_part) {
            // Legs and the like, of which nothing but the length is seen, have elongated segments.
            const auto spectrum = gnomon::principal_frame::of(points).spectrum;
            if (points.size() < 50 || spectrum.aspect_ratio() < 0.2) continue;
            std::string name = world.parts()[static_cast<std::size_t>(part)].name;
            std::erase_if(name, [](char c) { return c >= '0' && c <= '9'; });
            all.push_back({model.name + "/" + name, std::move(points)});
        }
    }
    return all;
}

/// The mean distance of features of the same part in different views, divided by that of different
/// parts.
template <class Feature>
double ratio_of_distances(const std::vector<seen_part>& parts, const std::vector<Feature>& features,
                          auto&& distance) {
    double same = 0.0, different = 0.0;
    std::size_t same_pairs = 0, different_pairs = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const double d = distance(features[i], features[j]);
            (parts[i].name == parts[j].name ? same : different) += d;
            ++(parts[i].name == parts[j].name ? same_pairs : different_pairs);
        }
    }
    return same / static_cast<double>(same_pairs) /
           (different / static_cast<double>(different_pairs));
}

/// Mean height, inclination, surface variation, aspect ratio and volume of the box, of the whole
/// range [0, 1] each.
std::vector<std::vector<double>> basic_features(const std::vector<seen_part>& parts) {
    std::vector<std::vector<double>> all;
    for (const seen_part& part : parts) {
        const auto frame = gnomon::principal_frame::of(part.points);
        const double cosine = std::min(1.0, std::abs(frame.normal().z()));
        all.push_back({frame.centroid.z(), 2.0 * std::acos(cosine) / std::numbers::pi,
                       frame.spectrum.surface_variation(), frame.spectrum.aspect_ratio(),
                       frame.box_size.prod()});
    }
    for (const std::size_t bounded_by_data : {0u, 4u}) {
        double largest = 0.0;
        for (const auto& f : all) largest = std::max(largest, f[bounded_by_data]);
        for (auto& f : all) f[bounded_by_data] /= largest;
    }
    return all;
}

TEST(zernike_of_scans, differ_for_the_same_part) {
    const auto parts = parts_of_views(120);
    const auto manhattan = [](const auto& a, const auto& b) {
        double sum = 0.0;
        for (std::size_t k = 0; k < a.size(); ++k) sum += std::abs(a[k] - b[k]);
        return sum;
    };
    const double basic = ratio_of_distances(parts, basic_features(parts), manhattan);
    EXPECT_LT(basic, 0.3);
    const auto ratio_of = [&](const gnomon::zernike_options& options) {
        std::vector<gnomon::zernike_descriptor> all;
        for (const seen_part& part : parts)
            all.push_back(gnomon::zernike_descriptor::of(part.points, options));
        return ratio_of_distances(parts, all,
                                  [](const auto& a, const auto& b) { return a.distance(b); });
    };
    const double masses = ratio_of({}), enclosed = ratio_of({.enclose = true});
    const double voxels = ratio_of({.voxels = 32});
    EXPECT_GT(masses, 0.7);
    EXPECT_GT(enclosed, 0.7);
    EXPECT_GT(voxels, 0.5);
    std::printf("%zu parts: five basic features %.2f; Zernike %.2f, enclosed %.2f, voxels %.2f\n",
                parts.size(), basic, masses, enclosed, voxels);
}

}  // namespace
