// SPDX-License-Identifier: BSL-1.0
// How do I get a LAS file with the surface of each point as a label, and the labels back?
//     las_labels [SURVEY.las]
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <string>

#include <Eigen/Core>

#include "common/help.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/io/label_properties.hpp>
#include <gnomon/io/read_las.hpp>
#include <gnomon/io/write_las.hpp>
#include <gnomon/perception.hpp>
#include <gnomon/simulation.hpp>

namespace {

/// A simulated kitchen in coordinates of a map (UTM).
std::string kitchen_survey() {
    namespace sim = gnomon::simulation;
    const sim::scene kitchen = sim::scenes::kitchen();
    gnomon::scan scan =
        sim::simulate(kitchen, sim::rotational{.mount = kitchen.sensor}, {}, {.sigma = 0.005}).scan;
    const Eigen::Vector3d corner(691234.0, 5335678.0, 515.0);
    for (Eigen::Vector3d& p : scan.points) p += corner;
    scan.viewpoints = Eigen::Vector3d(scan.viewpoints[0] + corner);
    gnomon::io::write_las("kitchen.las", scan, {}, {.drop_missing = true});
    return "kitchen.las";
}

}  // namespace

int main(int argc, char** argv) try {
    if (printed_help(argc, argv,
                     "Writes a LAS file with the surface of each point as a label, and reads it "
                     "again; without SURVEY.las, a simulated survey.",
                     " [SURVEY.las]"))
        return 0;
    const std::string path = argc > 1 ? argv[1] : kitchen_survey();

    // [las_labels]
    // #include <gnomon/io/read_las.hpp>, write_las.hpp, label_properties.hpp,
    // <gnomon/perception.hpp>
    namespace io = gnomon::io;
    const io::input survey = io::load(path);
    const gnomon::scan scan = io::read(survey, {"*"});  // of others: with_viewpoint(scan, sensor)

    const auto seen = gnomon::perception<>{}(scan, gnomon::threads{});

    // What the file has goes along: attributes, scale and offset, coordinate reference system.
    const io::properties label = io::scalar_property("label", seen.surfaces.labels());
    io::write_las("labeled.las", scan, {label, io::field_properties(scan, label)},
                  {.source = &survey});

    // And back.
    const gnomon::scan again = io::read("labeled.las", {"label"});
    const gnomon::segments surfaces(io::labels_of(again));
    // [las_labels]

    std::printf("%zu points, %zu surfaces, %zu fields in the file\n", scan.size(), surfaces.size(),
                scan.fields.size());
    return surfaces == seen.surfaces && again.points == scan.points ? 0 : 1;
} catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
}
