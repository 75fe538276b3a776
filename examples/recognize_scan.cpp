// SPDX-License-Identifier: BSL-1.0
/// @file
/// Which objects are in a scan, and why? From a scan and a model file of `learn_objects` to the
/// names, places and boxes of objects, with the reasons of each decision.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/json.hpp"
#include "common/output_directory.hpp"
#include "common/program.hpp"
#include "common/progress.hpp"
#include "common/seen_scan.hpp"
#include "recognize_scan/objects.hpp"
#include "recognize_scan/options.hpp"
#include "recognize_scan/picture_of_objects.hpp"
#include "recognize_scan/reasons.hpp"
#include <gnomon/adapters/json_model.hpp>
#include <gnomon/gnomon.hpp>
#include <gnomon/io.hpp>
#include <gnomon/io/read_las.hpp>

namespace {

scan_objects recognized(const gnomon::scan& scan, const rec::object_recognizer<>& model,
                        const options& o) {
    const progress shown("recognizing");
    rec::perceive_views_options how{.up = o.up, .divergence = o.divergence};
    if (o.floor) how.ground = gnomon::plane{o.up, *o.floor};
    if (o.sigma) how.noise = gnomon::constant_noise{*o.sigma};
    rec::decide_options decisions = model.decision_options();
    if (o.min_probability) decisions.min_probability = *o.min_probability;
    return objects_of(scan, o.scan, how, model, decisions, o.threads);
}

/// The angle of an axis about `up` [rad], in [0, pi), from the projection of the x axis, or of the
/// y axis if x is up.
double yaw_of(const gnomon::oriented_box& box) {
    const Eigen::Vector3d up = box.axes.col(2), axis = box.axes.col(0);
    const Eigen::Vector3d ahead =
        picture::across(up, std::abs(up.x()) < 0.9 ? Eigen::Vector3d(Eigen::Vector3d::UnitX())
                                                   : Eigen::Vector3d(Eigen::Vector3d::UnitY()));
    const double yaw = std::atan2(axis.dot(up.cross(ahead)), axis.dot(ahead));
    return yaw < 0.0 ? yaw + std::numbers::pi : yaw;
}

json entry_of(const object& o, const rec::view& v, const rec::object_recognizer<>& model) {
    json evidence = json::array();
    for (const rec::evidence& e : o.decision.evidence) {
        json word = nullptr;
        if (e.word != rec::term::none) word = e.word;
        evidence.push_back(
            {{"what", description_of(e, v)}, {"word", word}, {"log_ratio", e.log_ratio}});
    }
    return {{"name", o.name},
            {"probability", o.probability()},
            {"best", model.names()[o.decision.best]},
            {"second", model.names()[o.decision.second]},
            {"points", o.points},
            {"center", array_of(o.box.center)},
            {"pose", {{"position", array_of(o.place())}, {"yaw", yaw_of(o.box)}}},
            {"box", box_description(o.box)},
            {"log_ratio", o.decision.log_ratio},
            {"evidence", evidence}};
}

json report_of(const gnomon::scan& scan, const scan_objects& found,
               const rec::object_recognizer<>& model) {
    json views = json::array();
    for (std::size_t v = 0; v < found.objects.size(); ++v)
        views.push_back(entry_of(found.objects[v], found.seen.views[v], model));
    return {{"points", scan.size()}, {"classes", model.names()}, {"views", views}};
}

/// The objects that were recognized, with the strongest reasons for each and against it.
void print_table(const json& report) {
    constexpr std::size_t most_reasons = 4;
    std::puts("\nview  object                probability   points  middle of the base [m]");
    std::size_t background = 0;
    for (std::size_t v = 0; v < report["views"].size(); ++v) {
        const json& view = report["views"][v];
        if (view["name"] == rec::background_name) {
            ++background;
            continue;
        }
        const auto place = view["pose"]["position"].get<std::vector<double>>();
        std::printf("%4zu  %-20s  %11.3f  %7s  %6.2f %6.2f %6.2f\n", v,
                    view["name"].get<std::string>().c_str(), view["probability"].get<double>(),
                    picture::with_commas(view["points"]).c_str(), place[0], place[1], place[2]);
        std::vector<json> reasons = view["evidence"];
        std::ranges::stable_sort(reasons, {}, [](const json& reason) {
            return -std::abs(reason["log_ratio"].get<double>());
        });
        for (std::size_t r = 0; r < std::min(most_reasons, reasons.size()); ++r)
            std::printf("        %s: %+.1f\n", reasons[r]["what"].get<std::string>().c_str(),
                        reasons[r]["log_ratio"].get<double>());
        std::printf("        in all, against %s: %+.1f\n",
                    view["second"].get<std::string>().c_str(), view["log_ratio"].get<double>());
    }
    std::printf("\n%s recognized, %s background\n",
                picture::counted(report["views"].size() - background, "object").c_str(),
                picture::counted(background, "view").c_str());
}

void recognize_scan(const options& o) {
    const stopwatch watch;
    const auto model = rec::read_model(o.model, o.threads);
    const gnomon::scan scan = seen_scan(gnomon::io::read(o.scan, {"*"}), o.scan, o.viewpoint);
    const stopwatch recognizing;
    const scan_objects found = recognized(scan, model, o);
    const double seconds = recognizing.seconds();

    // Not before: a scan without a floor is refused, and leaves no directory.
    const output_directory out(o.out, {"labeled.ply", "recognized.png", "objects.json"});
    const std::string png = picture_of(scan, found, o.up, o.threads).png();
    json report = report_of(scan, found, model);
    report["seconds"] = seconds;
    const gnomon::io::properties columns{
        gnomon::io::color_properties(found.seen.groups.labels(), picture::color_of),
        gnomon::io::scalar_property("label", found.seen.groups.labels())};
    gnomon::io::write_ply(out / "labeled.ply", scan,
                          {columns, gnomon::io::field_properties(scan, columns)});
    gnomon::io::replace_file(out / "recognized.png", png);
    gnomon::io::replace_file(out / "objects.json", report.dump(2) + "\n");
    std::printf("%s in %.2f s, recognized in %.2f s of it\n",
                picture::counted(scan.size(), "point").c_str(), watch.seconds(), seconds);
    print_table(report);
    out.report();
}

}  // namespace

int main(int argc, char** argv) {
    return run_program("recognize_scan", usage, options_from, recognize_scan, argc, argv);
}
