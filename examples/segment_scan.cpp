// SPDX-License-Identifier: BSL-1.0
/// @file
/// What surfaces does a scan consist of? The whole way from a file to labeled points, a picture
/// and a table: read, perceive, describe the segments.

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "common/output_directory.hpp"
#include "common/program.hpp"
#include "common/progress.hpp"
#include "picture/of_perception.hpp"
#include "segment_scan/options.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/perception.hpp>
#include <gnomon/simulation.hpp>

namespace {

using json = nlohmann::ordered_json;
using surfel = gnomon::surfel<gnomon::plane_fit>;
using result = gnomon::perceived<gnomon::plane_fit>;

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

/// The surfaces of a scan; floor and ceiling, if they are left out, get no normals and no labels.
result surfaces_of(const gnomon::scan& scan, const options& o) {
    const progress telling("perceiving");
    std::optional<gnomon::floor_and_ceiling> leave_out;
    if (o.remove_floor) leave_out = {.up = o.up.value_or(Eigen::Vector3d::UnitZ())};
    return std::visit(
        [&]<class Merge>(const Merge& merge) {
            const gnomon::perception<gnomon::knn, gnomon::plane_pca, Merge> chain{
                .neighborhood = o.neighborhood,
                .merge = merge,
                .segmentation = o.segmentation,
                .leave_out = leave_out,
                .releasing = gnomon::stray_releasing{.min_points = o.segmentation.min_points},
                .round = gnomon::round_joining{.min_points = o.segmentation.min_points}};
            return chain.with_sigma(o.sigma)(scan, o.threads);
        },
        o.merge);
}

void tell_of_floor(const result& r) {
    if (!r.floor) {
        std::puts("no floor found, nothing left out");
        return;
    }
    std::printf("floor%s left out, %s left\n", r.ceiling ? " and ceiling" : "",
                picture::counted(r.kept.size(), "point").c_str());
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

std::string picture_of(const gnomon::scan& scan, const result& r, const options& o) {
    const progress telling("drawing");
    const Eigen::Vector3d viewpoint = scan.viewpoints.positions().empty()
                                          ? Eigen::Vector3d::Zero()
                                          : scan.viewpoints.positions().front();
    return picture::picture_of(picture::splats_of(scan, r), picture::sizes_of(r.surfaces),
                               "segment", viewpoint, o.up, picture::color_of,
                               picture::gaps_of(scan, r))
        .png();
}

void write_points(const output_directory& out, const gnomon::scan& scan, const result& r) {
    using namespace gnomon::io;
    const properties normals = normal_properties(r.surface, &surfel::normal);
    write_ply(out / "normals.ply", scan,
              {normals, scalar_property("quality", r.surface, &surfel::surface_variation),
               scalar_property("trust", r.surface, &surfel::trust)});
    const auto& labels = r.surfaces.labels();
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

    const result r = surfaces_of(scan, o);
    if (o.remove_floor) tell_of_floor(r);
    json report{{"points", scan.size()},
                {"valid", std::ranges::count_if(scan, gnomon::is_finite)},
                {"seconds",
                 {{"read", read_seconds},
                  {"preprocessing", r.seconds.preprocessing},
                  {"normals", r.seconds.normals},
                  {"segmentation", r.seconds.segmentation},
                  {"merging", r.seconds.merging},
                  {"claiming", r.seconds.claiming}}},
                {"segments_before_merging", r.fragments.size()},
                {"segments", description_of(scan, r.surfaces)}};
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
