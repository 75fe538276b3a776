// SPDX-License-Identifier: BSL-1.0
// Makes a cloud and, where it is known, the truth: DIRECTORY/points and DIRECTORY/normals. The
// kitchen is a rotational scan with 15 mm of noise along the rays; of a file, the finite points are
// taken.
//     cloud kitchen|kitchen_medium|FILE DIRECTORY
#include <cstdio>
#include <exception>
#include <string>

#include "vectors.hpp"
#include <gnomon/core/point.hpp>
#include <gnomon/io/read.hpp>
#include <gnomon/simulation/simulate.hpp>
#include <gnomon/simulation/thesis_scenes.hpp>

namespace {

struct cloud {
    peers::vectors points;
    peers::vectors normals;  ///< the true ones, or none
};

cloud kitchen(const gnomon::scanner& finder) {
    const gnomon::scene world = gnomon::scenes::kitchen();
    const gnomon::rotational trajectory{.mount = world.sensor};
    const auto truth = gnomon::simulate(world, trajectory, finder, {.sigma = 0.015, .seed = 1});
    return {truth.scan.points, truth.normals};
}

cloud finite_points_of(const std::string& path) {
    cloud c;
    for (const Eigen::Vector3d& p : gnomon::io::read(path).points) {
        if (gnomon::is_finite(p)) c.points.push_back(p);
    }
    return c;
}

cloud called(const std::string& name) {
    if (name == "kitchen") return kitchen(gnomon::densities::high());
    if (name == "kitchen_medium") return kitchen(gnomon::densities::medium());
    return finite_points_of(name);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fputs("usage: cloud kitchen|kitchen_medium|FILE DIRECTORY\n", stderr);
        return 2;
    }
    try {
        const cloud c = called(argv[1]);
        const std::string directory = argv[2];
        peers::write_vectors(directory + "/points", c.points);
        peers::write_vectors(directory + "/normals", c.normals);
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "cloud: %s\n", problem.what());
        return 1;
    }
}
