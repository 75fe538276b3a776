// SPDX-License-Identifier: BSL-1.0
// The negative result of Klasing 2010, Sec. 3.5.4: in noisy scans of uneven density, Zernike
// descriptors of the same part differ about as much as those of different parts, unlike the five
// features of Sec. 5.2.2.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "two_scans.hpp"
#include <gnomon/features/principal_frame.hpp>
#include <gnomon/features/zernike_descriptor.hpp>

namespace {

/// A part with its name, "kitchen chair/seat".
struct seen_part {
    std::string name;
    std::vector<Eigen::Vector3d> points;
    gnomon::principal_frame frame;
};

/// The parts of a piece of furniture alone, in a rotational scan with noise of 15 mm from 1.2 to
/// 3 m away. They are those of the simulator, so that no segmentation interferes.
std::vector<seen_part> parts_of_view(std::size_t view) {
    const auto models = sim::furniture_models();
    const auto& model = models[view % models.size()];
    gnomon::random_stream random(first_seed + view, 2);
    sim::scene world;
    const double distance = random.uniform(1.2, 3.0);
    const auto turned = gnomon::degrees(random.uniform(-180.0, 180.0));
    sim::add(world, model, sim::at(distance, random.uniform(-1.0, 1.0), 0.0) * sim::yaw(turned));
    const sim::rotational trajectory{.mount =
                                         sim::at(0.0, 0.0, 1.2) * sim::pitch(gnomon::degrees(10))};
    const auto truth = sim::simulate(world, trajectory, sim::scanner{},
                                     sim::beam{.sigma = 0.015, .seed = first_seed + view});
    std::map<std::int32_t, std::vector<Eigen::Vector3d>> by_part;
    for (std::size_t i = 0; i < truth.scan.size(); ++i)
        if (truth.parts[i] != sim::nothing) by_part[truth.parts[i]].push_back(truth.scan.points[i]);
    constexpr std::size_t fewest = 50;
    std::vector<seen_part> parts;
    for (auto& [number, points] : by_part) {
        if (points.size() < fewest) continue;
        std::string name = world.parts()[static_cast<std::size_t>(number)].name;
        std::erase_if(name, [](char c) { return c >= '0' && c <= '9'; });
        const auto frame = gnomon::principal_frame::of(points);
        parts.push_back({model.name + "/" + name, std::move(points), frame});
    }
    return parts;
}

/// Mean height, inclination, surface variation, aspect ratio and volume of the box, of the whole
/// range [0, 1] each.
std::vector<std::vector<double>> basic_features(const std::vector<seen_part>& parts) {
    std::vector<std::vector<double>> all;
    for (const auto& [name, points, frame] : parts) {
        const double cosine = std::min(1.0, std::abs(frame.normal().z()));
        all.push_back({frame.centroid.z(), 2.0 * std::acos(cosine) / std::numbers::pi,
                       frame.spectrum.surface_variation(), frame.spectrum.aspect_ratio(),
                       frame.box_size.prod()});
    }
    for (const std::size_t unbounded : {0u, 4u}) {
        double largest = 0.0;
        for (const auto& f : all) largest = std::max(largest, f[unbounded]);
        for (auto& f : all) f[unbounded] /= largest;
    }
    return all;
}

/// The mean distance of features of the same part in different views, and of different parts.
struct mean_distances {
    double same = 0.0, different = 0.0;

    template <class Feature>
    mean_distances(const std::vector<seen_part>& parts, const std::vector<Feature>& features,
                   auto&& distance) {
        std::size_t same_pairs = 0, different_pairs = 0;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                const double d = distance(features[i], features[j]);
                if (parts[i].name == parts[j].name) {
                    same += d;
                    ++same_pairs;
                } else {
                    different += d;
                    ++different_pairs;
                }
            }
        }
        same /= static_cast<double>(same_pairs);
        different /= static_cast<double>(different_pairs);
    }
};

/// @param name  of the set of parts
void add_rows(json& rows, const char* name, const std::vector<seen_part>& parts) {
    const auto add = [&](const char* feature, const mean_distances& d) {
        rows.push_back({{"parts", name},
                        {"number", parts.size()},
                        {"feature", feature},
                        {"of the same part", rounded(d.same, 4)},
                        {"of different parts", rounded(d.different, 4)},
                        {"ratio", rounded(d.same / d.different, 3)}});
        std::printf("%s\n", rows.back().dump().c_str());
    };
    const auto manhattan = [](const auto& a, const auto& b) {
        double sum = 0.0;
        for (std::size_t k = 0; k < a.size(); ++k) sum += std::abs(a[k] - b[k]);
        return sum;
    };
    add("five basic features", mean_distances(parts, basic_features(parts), manhattan));
    const auto add_zernike = [&](const char* feature, const gnomon::zernike_options& options) {
        std::vector<gnomon::zernike_descriptor> all;
        for (const seen_part& part : parts)
            all.push_back(gnomon::zernike_descriptor::of(part.points, options));
        add(feature,
            mean_distances(parts, all, [](const auto& a, const auto& b) { return a.distance(b); }));
    };
    add_zernike("Zernike", {});
    add_zernike("Zernike, enclosed", {.enclose = true});
    add_zernike("Zernike, 32 voxels", {.voxels = 32});
}

json measure(const effort& much) {
    const std::size_t views = much.quick ? 30 : 480;
    std::vector<seen_part> all, extended;
    for (std::size_t view = 0; view < views; ++view) {
        for (seen_part& part : parts_of_view(view)) {
            if (part.frame.spectrum.aspect_ratio() >= 0.2) extended.push_back(part);
            all.push_back(std::move(part));
        }
    }
    json rows = json::array();
    add_rows(rows, "all", all);
    add_rows(rows, "extended", extended);
    return {{"distances", rows}};
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, measure); }
