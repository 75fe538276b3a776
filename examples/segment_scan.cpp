// SPDX-License-Identifier: BSL-1.0
/// @file
/// What surfaces does a scan consist of? From a file to labeled points, a picture and a table: read
/// the scan, find its surfaces by `perception`, describe the segments and their shapes.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "common/json.hpp"
#include "common/output_directory.hpp"
#include "common/program.hpp"
#include "common/progress.hpp"
#include "common/seen_scan.hpp"
#include "picture/of_perception.hpp"
#include "recognize_scan/objects.hpp"
#include "segment_scan/mesh.hpp"
#include "segment_scan/options.hpp"
#include "segment_scan/shape.hpp"
#include <gnomon/adapters/json_model.hpp>
#include <gnomon/features/segment_shape.hpp>
#include <gnomon/gnomon.hpp>
#include <gnomon/io/read_las.hpp>
#include <gnomon/perception.hpp>
#include <gnomon/simulation.hpp>

namespace {

using surfel = gnomon::surfel<gnomon::plane_fit>;
using result = gnomon::perception_result<gnomon::plane_fit>;

/// The scan that is segmented if the user names none: a kitchen, simulated for a UTM-30LX that
/// rolls about its viewing direction (Klasing 2010, Fig. 4.8).
gnomon::scan scan_of_kitchen(const gnomon::threads& threads) {
    const gnomon::simulation::scene kitchen = gnomon::simulation::scenes::kitchen();
    const gnomon::simulation::rotational trajectory{.mount = kitchen.sensor};
    return gnomon::simulation::simulate(kitchen, trajectory, {}, {.sigma = 0.015}, threads).scan;
}

/// @throws gnomon::error  if the file cannot be read, or no point of it is finite
gnomon::scan scan_of(const options& o) {
    return seen_scan(o.scan.empty() ? scan_of_kitchen(o.threads) : gnomon::io::read(o.scan, {"*"}),
                     o.scan, o.viewpoint);
}

/// The median distance of a finite point from its nearest neighbor [m]; 0 for a single point.
double median_spacing(const gnomon::scan& scan, const gnomon::threads& threads) {
    const gnomon::adjacency nearest = gnomon::knn{.k = 1}(scan, threads);
    std::vector<double> spacings;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        for (const gnomon::point_index q : nearest[i])
            spacings.push_back(gnomon::squared_distance(scan.points[i], scan.points[q]));
    }
    if (spacings.empty()) return 0.0;
    const auto middle = spacings.begin() + static_cast<std::ptrdiff_t>(spacings.size() / 2);
    std::ranges::nth_element(spacings, middle);
    return std::sqrt(*middle);
}

/// Prints a warning if the points are so far apart that their unit is probably not the metre.
void warn_of_unit(const gnomon::scan& scan, const options& o) {
    constexpr double largest_spacing = 1.0;  // [m], of the median of a scan of a room or a building
    const double spacing = median_spacing(scan, o.threads);
    if (spacing > largest_spacing) {
        std::fprintf(stderr,
                     "segment_scan: the median distance between neighboring points is %.3g metres; "
                     "coordinates must be in metres\n",
                     spacing);
    }
}

/// The mean direction of the rays, which for a camera is about its optical axis.
/// @throws gnomon::error  if there is none, as for a scan all around
Eigen::Vector3d optical_axis_of(const gnomon::scan& scan, const options& o) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double rays = 0.0;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const Eigen::Vector3d ray = scan.points[i] - scan.viewpoints[i];
        if (!ray.allFinite() || ray.isZero()) continue;
        sum += ray.stableNormalized();
        rays += 1.0;
    }
    constexpr double shortest_mean = 0.5;  // of the rays of a field of view of 180 degrees
    if (!(sum.norm() >= shortest_mean * rays && rays > 0.0))
        throw gnomon::error(o.scan, "", "has no optical axis, so that it is not of a camera");
    return sum;
}

/// The noise that the user named; nothing if it is to be measured.
std::optional<gnomon::noise_curve> noise_of(const gnomon::scan& scan, const options& o) {
    if (const auto* constant = std::get_if<gnomon::constant_noise>(&o.noise.model))
        return *constant;
    if (const auto* camera = std::get_if<gnomon::quadratic_noise>(&o.noise.model))
        return gnomon::noise_curve(*camera, optical_axis_of(scan, o));
    return std::nullopt;
}

/// The surfaces of a scan; floor and ceiling, if they are left out, have no normals and no labels.
result surfaces_of(const gnomon::scan& scan, const std::optional<gnomon::noise_curve>& noise,
                   const options& o) {
    std::optional<gnomon::floor_and_ceiling> leave_out;
    if (o.remove_floor) leave_out = {.up = o.up.value_or(Eigen::Vector3d::UnitZ())};
    return std::visit(
        [&]<class Merge>(const Merge& merge) {
            const gnomon::perception<gnomon::noise_knn, gnomon::plane_pca, Merge> chain{
                .neighborhood = o.neighborhood,
                .merge = merge,
                .segmentation = o.segmentation,
                .noise = noise,
                .leave_out = leave_out};
            return chain(scan, o.threads);
        },
        o.merge);
}

void report_floor(const result& r) {
    if (!r.floor) {
        std::puts("no floor found, nothing left out");
        return;
    }
    std::printf("floor%s left out, %s left\n", r.ceiling ? " and ceiling" : "",
                picture::counted(r.kept.size(), "point").c_str());
}

/// The noise that all steps went by.
json description_of(const result::known_noise& noise, const options& o) {
    json description{{"model", noise.is_across_surface ? "across_surface" : o.noise.name},
                     {"at_1m", noise.curve(1.0)},
                     {"at_3m", noise.curve(3.0)}};
    if (noise.is_across_surface) description["reason"] = noise.reason;
    return description;
}

/// The plane of a flat segment, else null. Its axes are those of the box.
json description_of(const gnomon::plane_estimate& e, const gnomon::oriented_box& box) {
    if (!e.is_flat) return nullptr;
    return {{"normal", array_of(e.plane.normal)},
            {"offset", e.plane.offset},
            {"centroid", array_of(e.centroid)},
            {"axes", columns_of(box.axes)},
            {"covariance", columns_of(covariance_about(box.axes, e))}};
}

json description_of(const segment_bounds& bounds, const gnomon::alpha_shape::polygon& polygon) {
    const auto corners_of = [&](const std::vector<gnomon::point_index>& path) {
        json corners = json::array();
        for (const Eigen::Vector3d& corner : bounds.corners(path))
            corners.push_back(array_of(corner));
        return corners;
    };
    json holes = json::array();
    for (const auto& hole : polygon.holes) holes.push_back(corners_of(hole));
    return {{"area", polygon.area}, {"outline", corners_of(polygon.outline)}, {"holes", holes}};
}

/// The largest polygon of a flat segment with the others as its islands, null if there is none.
json description_of(const segment_bounds& bounds) {
    const auto& polygons = bounds.outline.polygons;
    if (polygons.empty()) return nullptr;
    json description = description_of(bounds, polygons.front());
    json islands = json::array();
    for (std::size_t i = 1; i < polygons.size(); ++i)
        islands.push_back(description_of(bounds, polygons[i]));
    description["islands"] = islands;
    return description;
}

/// The name of the object of most points of each segment. recognize_scan's own surfaces are used,
/// as the model has learned such: those of this program are larger.
/// @throws gnomon::error  if the scan has no floor
std::vector<std::string> object_names_of(const gnomon::scan& scan, const result& r,
                                         const gnomon::recognition::object_recognizer<>& model,
                                         const options& o) {
    const auto found = objects_of(
        scan, o.scan, {.up = o.up.value_or(Eigen::Vector3d::UnitZ()), .noise = r.noise.curve},
        model, model.decision_options(), o.threads);
    std::vector<std::string> names;
    for (std::size_t s = 0; s < r.surfaces.size(); ++s) {
        names.emplace_back(gnomon::recognition::background_name);
        std::vector<std::size_t> count(found.objects.size(), 0);
        for (const gnomon::point_index i : r.surfaces[s]) {
            const std::int32_t object = found.seen.groups.labels()[i];
            if (object == gnomon::unlabeled) continue;
            const auto number = static_cast<std::size_t>(object);
            if (2 * ++count[number] > r.surfaces[s].size())
                names.back() = found.objects[number].name;
        }
    }
    return names;
}

/// One object per segment, largest first.
json description_of(const gnomon::scan& scan, const result& r,
                    const std::vector<segment_bounds>& bounds, const options& o) {
    const auto shapes = gnomon::segment_shapes(scan, r.surface, r.surfaces, o.threads);
    json list = json::array();
    for (std::size_t label = 0; label < r.surfaces.size(); ++label) {
        const gnomon::plane_estimate& plane = r.planes[label];
        const gnomon::segment_shape& shape = shapes[label];
        const auto members = r.surfaces[label];
        list.push_back({{"label", label},
                        {"points", members.size()},
                        {"centroid", array_of(shape.frame.centroid)},
                        {"normal", array_of(plane.is_flat ? plane.plane.normal : shape.normal)},
                        {"flat", plane.is_flat},
                        {"surface_variation", shape.surface_variation()},
                        {"aspect_ratio", shape.aspect_ratio()},
                        {"box_size", array_of(shape.frame.box_size)},
                        {"plane", description_of(plane, bounds[label].box)},
                        {"box", box_description(bounds[label].box)},
                        {"polygon", description_of(bounds[label])},
                        {"viewpoint", array_of(scan.viewpoints[members.front()])}});
    }
    return list;
}

std::string picture_of(const gnomon::scan& scan, const result& r, const options& o) {
    const Eigen::Vector3d viewpoint = scan.viewpoints.positions().empty()
                                          ? Eigen::Vector3d::Zero()
                                          : scan.viewpoints.positions().front();
    return picture::picture_of(picture::splats_of(scan, r, o.threads),
                               picture::sizes_of(r.surfaces), "segment", viewpoint, o.up,
                               picture::color_of, picture::gaps_of(scan, r), o.threads)
        .png();
}

void write_points(const output_directory& out, const gnomon::scan& scan, const result& r) {
    using namespace gnomon::io;
    // What the file of the scan has under other names goes along: colors, intensities.
    const auto write = [&](const char* name, const properties& columns) {
        write_ply(out / name, scan, {columns, field_properties(scan, columns)});
    };
    const properties normals = normal_properties(r.surface, &surfel::normal);
    write("normals.ply",
          {normals, scalar_property("quality", r.surface, &surfel::surface_variation),
           scalar_property("trust", r.surface, &surfel::trust)});
    const auto& labels = r.surfaces.labels();
    write("segments.ply",
          {color_properties(labels, picture::color_of), scalar_property("label", labels), normals});
}

/// The polygons of all flat segments as a PLY file.
std::string mesh_of(const std::vector<segment_bounds>& bounds) {
    ply_mesh mesh;
    for (std::size_t label = 0; label < bounds.size(); ++label)
        mesh.add(bounds[label], static_cast<std::int32_t>(label));
    return mesh.bytes();
}

/// Length and width of a segment, and the height if it is not flat.
std::string size_of(const json& segment) {
    const auto size = segment["box"]["lengths"].get<std::vector<double>>();
    char text[64];
    if (segment["flat"])
        std::snprintf(text, sizeof text, "%5.2f x %5.2f        ", size[0], size[1]);
    else
        std::snprintf(text, sizeof text, "%5.2f x %5.2f x %5.2f", size[0], size[1], size[2]);
    return text;
}

void print_table(const json& report, unsigned threads) {
    const json& segments = report["segments"];
    std::printf("%s (%s finite), %s\n", picture::counted(report["points"], "point").c_str(),
                picture::with_commas(report["valid"]).c_str(),
                picture::counted(segments.size(), "segment").c_str());
    const json& noise = report["noise"];
    std::printf("noise: %s, %.2g m at 1 m, %.2g m at 3 m\n",
                noise["model"].get<std::string>().c_str(), noise["at_1m"].get<double>(),
                noise["at_3m"].get<double>());
    if (noise.contains("reason"))
        std::printf("across the surfaces, because of the scan: %s; nothing was merged\n",
                    noise["reason"].get<std::string>().c_str());
    if (!segments.empty())
        std::printf("\nlabel    points   size [m]              normal%s\n",
                    segments.front().contains("object") ? "              object" : "");
    for (std::size_t i = 0; i < std::min<std::size_t>(segments.size(), 10); ++i) {
        const json& s = segments[i];
        const auto normal = s["normal"].get<std::vector<double>>();
        std::printf("%5zu %9zu   %s   %5.2f %5.2f %5.2f%s%s%s\n", i, s["points"].get<std::size_t>(),
                    size_of(s).c_str(), normal[0], normal[1], normal[2],
                    s["flat"] ? "" : "   not flat", s.contains("object") ? "   " : "",
                    s.contains("object") ? s["object"].get<std::string>().c_str() : "");
    }
    if (segments.size() > 10) std::puts("  ...");
    std::puts("");
    long milliseconds = 0;  // the sum of the numbers that are printed
    for (const auto& [step, seconds] : report["seconds"].items()) {
        if (step == "total") continue;
        const long rounded = std::lround(1e3 * seconds.get<double>());
        std::printf("%-18s %8.3f s\n", step.c_str(), 1e-3 * static_cast<double>(rounded));
        milliseconds += rounded;
    }
    std::printf("%-18s %8.3f s\n", "total", 1e-3 * static_cast<double>(milliseconds));
    std::printf("%-18s %8u\n", "threads used", threads);
}

/// A step of the program while it lives: shows its progress, and writes its duration [s] under its
/// name.
class timed_step {
  public:
    timed_step(json& seconds, const char* name) : seconds_(seconds), name_(name), progress_(name) {}
    timed_step(const timed_step&) = delete;
    timed_step& operator=(const timed_step&) = delete;
    ~timed_step() { seconds_[name_] = watch_.seconds(); }

  private:
    json& seconds_;
    const char* name_;
    progress progress_;
    stopwatch watch_;
};

double sum_of(const json& seconds) {
    double sum = 0.0;
    for (const auto& [step, duration] : seconds.items()) sum += duration.get<double>();
    return sum;
}

/// The text of a JSON object with one more member, whose value is a text already.
std::string with_last_member(std::string object, const std::string& name,
                             const std::string& value) {
    object.resize(object.rfind("\n}"));
    return object + ",\n  \"" + name + "\": " + value + "\n}";
}

void segment_scan(const options& o) {
    json seconds = json::object();
    const auto timed = [&seconds](const char* name, auto&& work) {
        const timed_step step(seconds, name);
        return work();
    };
    std::optional<gnomon::recognition::object_recognizer<>> model;
    if (!o.model.empty())
        timed("reading of the model",
              [&] { model = gnomon::recognition::read_model(o.model, o.threads); });
    const gnomon::scan scan = timed("reading", [&] { return scan_of(o); });
    const std::optional<gnomon::noise_curve> noise = noise_of(scan, o);
    std::vector<std::string> files{"normals.ply", "segments.ply", "segments.png", "segments.json"};
    if (o.polygons) files.push_back("polygons.ply");
    const output_directory out(o.out, files);
    timed("spacing", [&] { warn_of_unit(scan, o); });

    const result r = [&] {
        const progress step("perception");
        return surfaces_of(scan, noise, o);
    }();
    for (const auto& step : r.steps) seconds[std::string(step.name)] = step.seconds;
    if (o.remove_floor) report_floor(r);
    std::vector<segment_bounds> bounds;
    json segments = timed("description", [&] {
        bounds = bounds_of(scan, r, o.threads);
        return description_of(scan, r, bounds, o);
    });
    if (model) {
        timed("recognition", [&] {
            const auto names = object_names_of(scan, r, *model, o);
            for (std::size_t s = 0; s < names.size(); ++s) segments[s]["object"] = names[s];
        });
    }
    const std::string png = timed("picture", [&] { return picture_of(scan, r, o); });
    std::string segments_text;
    timed("writing", [&] {
        segments_text = segments.dump(2);
        write_points(out, scan, r);
        if (o.polygons) gnomon::io::replace_file(out / "polygons.ply", mesh_of(bounds));
        gnomon::io::replace_file(out / "segments.png", png);
    });
    seconds["total"] = sum_of(seconds);
    json report{{"points", scan.size()},
                {"valid", std::ranges::count_if(scan, gnomon::is_finite)},
                {"noise", description_of(r.noise, o)},
                {"seconds", seconds},
                {"segments_before_merging", r.initial_segments.size()}};
    gnomon::io::replace_file(out / "segments.json",
                             with_last_member(report.dump(2), "segments", segments_text) + "\n");
    report["segments"] = std::move(segments);
    print_table(report, o.threads.count());
    out.report();
}

}  // namespace

int main(int argc, char** argv) {
    return run_program("segment_scan", usage, options_from, segment_scan, argc, argv);
}
