// SPDX-License-Identifier: BSL-1.0
/// @file
/// What surfaces does a scan consist of? The whole way from a file to labeled points, a picture
/// and a table: read, leave out the floor if asked to, estimate normals, mend them, turn them to
/// the sensor, segment, describe the segments.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "common/output_directory.hpp"
#include "common/program.hpp"
#include "common/progress.hpp"
#include "picture/picture.hpp"
#include "segment_scan/options.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

namespace {

using surfel = gnomon::surfel<gnomon::plane_fit>;
using json = nlohmann::ordered_json;

/// What is found out about a scan, point by point.
struct result {
    std::vector<surfel> surface;
    gnomon::segments segments;
    std::vector<bool> left_out;  ///< with the floor
    double normals_seconds = 0.0;
    double segmentation_seconds = 0.0;
};

/// What there is to segment if the user has no scan: a kitchen, as a UTM-30LX that rolls about its
/// axis of sight would see it (Klasing 2010, Fig. 4.8).
gnomon::scan scan_of_kitchen(const gnomon::threads& threads) {
    const gnomon::scene kitchen = gnomon::scenes::kitchen();
    const gnomon::rotational trajectory{.mount = kitchen.sensor};
    return gnomon::simulate(kitchen, trajectory, {}, {.sigma = 0.015}, threads).scan;
}

gnomon::scan scan_of(const options& o) {
    const progress telling("reading");
    gnomon::scan scan = o.scan.empty() ? scan_of_kitchen(o.threads) : gnomon::io::read(o.scan);
    if (o.viewpoint) scan.viewpoints = *o.viewpoint;
    return scan;
}

/// The surfaces of a scan, or of what is left of it.
template <class Points>
result surfaces_of(const Points& points, const options& o) {
    result r;
    r.left_out.assign(points.size(), false);
    const stopwatch normals;
    {
        const progress telling("estimating normals");
        const gnomon::plane_pca plane;
        r.surface = gnomon::estimate_normals(points, o.neighborhood, plane, o.threads);
        gnomon::repair_anisotropic(points, r.surface, o.neighborhood, plane, {}, o.threads);
        gnomon::orient_normals(points, r.surface);
    }
    r.normals_seconds = normals.seconds();
    const stopwatch segmentation;
    {
        const progress telling("segmenting");
        r.segments = gnomon::segment_surfaces(points, r.surface, o.segmentation, o.threads);
    }
    r.segmentation_seconds = segmentation.seconds();
    return r;
}

/// The surfaces of what stands between floor and ceiling; floor and ceiling get no normals and no
/// labels.
result surfaces_without_floor(const gnomon::scan& scan, const options& o) {
    const auto guess = gnomon::guess_floor(scan, o.up.value_or(Eigen::Vector3d::UnitZ()));
    const auto floor = guess ? gnomon::find_floor(scan, *guess) : std::nullopt;
    if (!floor) {
        std::puts("no floor found, nothing left out");
        return surfaces_of(scan, o);
    }
    const auto ceiling = gnomon::find_ceiling(scan, *floor);
    const auto kept = gnomon::between_bands(scan, *floor, ceiling);
    std::printf("floor%s left out, %s left\n", ceiling ? " and ceiling" : "",
                picture::counted(kept.size(), "point").c_str());

    result part = surfaces_of(gnomon::subset_view(scan, kept), o);

    part.left_out.assign(scan.size(), true);
    std::vector<surfel> surface(scan.size());
    std::vector<std::int32_t> labels(scan.size(), gnomon::unlabeled);
    for (std::size_t i = 0; i < kept.size(); ++i) {
        part.left_out[kept[i]] = false;
        surface[kept[i]] = part.surface[i];
        labels[kept[i]] = part.segments.labels()[i];
    }
    part.surface = std::move(surface);
    part.segments = gnomon::segments(std::move(labels));
    return part;
}

json array_of(const Eigen::Vector3d& v) { return json::array({v.x(), v.y(), v.z()}); }

/// One object per segment, largest first.
json description_of(const gnomon::scan& scan, const gnomon::segments& segments) {
    json list = json::array();
    for (std::size_t label = 0; label < segments.size(); ++label) {
        const auto members = segments[label];
        const auto frame = gnomon::principal_frame_of(gnomon::subset_view(scan, members));
        const Eigen::Vector3d seen_along = frame.centroid - scan.viewpoints[members.front()];
        const bool away = frame.normal().dot(seen_along) > 0.0;
        list.push_back({{"label", label},
                        {"points", members.size()},
                        {"centroid", array_of(frame.centroid)},
                        {"normal", array_of(away ? -frame.normal() : frame.normal())},
                        {"surface_variation", frame.spectrum.surface_variation()},
                        {"aspect_ratio", frame.spectrum.aspect_ratio()},
                        {"box_size", array_of(frame.box_size)}});
    }
    return list;
}

/// The points as they are drawn: those that are finite and were not left out.
std::vector<picture::splat> splats_of(const gnomon::scan& scan, const result& r) {
    std::vector<picture::splat> splats;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        if (!gnomon::is_finite(scan.points[i]) || r.left_out[i]) continue;
        const surfel& s = r.surface[i];
        // k points that fill a disc at the distance rho_bar on average are 1.5 rho_bar sqrt(pi / k)
        // apart; a little more than that closes the surface, for points that lie in rows too.
        const double neighbors = std::max<double>(1.0, s.neighbors);
        const double spacing = 1.5 * s.mean_distance * std::sqrt(std::numbers::pi / neighbors);
        splats.push_back({scan.points[i], s.normal, 1.35 * spacing, r.segments.labels()[i]});
    }
    return splats;
}

std::string picture_of(const gnomon::scan& scan, const result& r, const options& o) {
    const progress telling("drawing");
    std::vector<std::string> legend;
    for (std::size_t label = 0; label < r.segments.size(); ++label) {
        legend.push_back(picture::with_commas(r.segments[label].size()));
    }
    const Eigen::Vector3d viewpoint = scan.viewpoints.positions().empty()
                                          ? Eigen::Vector3d::Zero()
                                          : scan.viewpoints.positions().front();
    return picture::picture_of(splats_of(scan, r), legend, "segment", viewpoint, o.up).png();
}

void write_points(const output_directory& out, const gnomon::scan& scan, const result& r) {
    using namespace gnomon::io;
    const properties normals = normal_properties(r.surface, &surfel::normal);
    write_ply(out / "normals.ply", scan,
              {normals, scalar_property("quality", r.surface, &surfel::surface_variation),
               scalar_property("trust", r.surface, &surfel::trust)});
    const auto& labels = r.segments.labels();
    write_ply(
        out / "segments.ply", scan,
        {color_properties(labels, picture::color_of), scalar_property("label", labels), normals});
}

void print_table(const json& report, unsigned threads) {
    const json& segments = report["segments"];
    std::printf("%s (%s finite), %s\n\n", picture::counted(report["points"], "point").c_str(),
                picture::with_commas(report["valid"]).c_str(),
                picture::counted(segments.size(), "segment").c_str());
    if (!segments.empty()) std::puts("label    points   size [m]              normal");
    for (std::size_t i = 0; i < std::min<std::size_t>(segments.size(), 10); ++i) {
        const json& s = segments[i];
        const auto size = s["box_size"].get<std::vector<double>>();
        const auto normal = s["normal"].get<std::vector<double>>();
        std::printf("%5zu %9zu   %5.2f x %5.2f x %5.2f   %5.2f %5.2f %5.2f\n", i,
                    s["points"].get<std::size_t>(), size[0], size[1], size[2], normal[0], normal[1],
                    normal[2]);
    }
    if (segments.size() > 10) std::puts("  ...");
    std::puts("");
    for (const auto& [step, seconds] : report["seconds"].items()) {
        std::printf("%-13s %8.3f s\n", step.c_str(), seconds.get<double>());
    }
    std::printf("%-13s %8u\n", "threads used", threads);
}

void segment_scan(const options& o) {
    const stopwatch total;
    const gnomon::scan scan = scan_of(o);
    const double read_seconds = total.seconds();

    const output_directory out(o.out,
                               {"normals.ply", "segments.ply", "segments.png", "segments.json"});

    const result r = o.remove_floor ? surfaces_without_floor(scan, o) : surfaces_of(scan, o);
    json report{{"points", scan.size()},
                {"valid", std::ranges::count_if(scan, gnomon::is_finite)},
                {"seconds",
                 {{"read", read_seconds},
                  {"normals", r.normals_seconds},
                  {"segmentation", r.segmentation_seconds}}},
                {"segments", description_of(scan, r.segments)}};
    const std::string png = picture_of(scan, r, o);

    {
        const progress telling("writing");
        write_points(out, scan, r);
        gnomon::io::replace_file(out / "segments.png", png);
        report["seconds"]["total"] = total.seconds();
        gnomon::io::replace_file(out / "segments.json", report.dump(2) + "\n");
    }
    print_table(report, o.threads.count());
    out.report();
    if (report["valid"] == 0) std::puts("The scan has no finite points: there was nothing to do.");
}

}  // namespace

int main(int argc, char** argv) {
    return run_program("segment_scan", usage, options_from, segment_scan, argc, argv);
}
