// SPDX-License-Identifier: BSL-1.0
// The quick start without exceptions, for every row of tests/matrix.sh: the surfaces of two walls
// that meet in a corner, by each execution that the platform has. Ends with 1 if these are others
// than expected. With an argument, an invalid one is passed to the library.
#include <cstddef>
#include <cstdio>
#include <vector>

#include <gnomon/gnomon.hpp>
#include <gnomon/perception.hpp>

int main(int argc, char**) {
    if (argc > 1) {  // an error
        const std::vector<Eigen::Vector3d> points(3);
        return gnomon::knn{.k = 0}(points).size() == points.size() ? 0 : 1;
    }
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 100; ++i) {
        for (int j = 0; j < 100; ++j) {
            points.emplace_back(2.0, 0.01 * i, 0.01 * j);
            points.emplace_back(1.99 - 0.01 * i, 1.0, 0.01 * j);
        }
    }
    const auto print = [&points](const auto& run) {
        const auto seen = gnomon::perception<>{}(points, run);
        std::size_t flat = 0;
        for (std::size_t label = 0; label < seen.surfaces.size(); ++label) {
            const Eigen::Vector3d& n = seen.planes[label].plane.normal;
            std::printf("surface %u: %u points, normal (%.2f, %.2f, %.2f)\n",
                        static_cast<unsigned>(label),
                        static_cast<unsigned>(seen.surfaces[label].size()), n.x(), n.y(), n.z());
            if (seen.planes[label].is_flat && seen.surfaces[label].size() > 9500) ++flat;
        }
        return flat == 2 && seen.surfaces.size() == 2;
    };
    return print(gnomon::sequential{}) && print(gnomon::threads{2}) && print(gnomon::team(2)) ? 0
                                                                                              : 1;
}
