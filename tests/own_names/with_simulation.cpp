// SPDX-License-Identifier: BSL-1.0
// `using namespace gnomon::simulation` does not bring the names of gnomon: here, they are the
// user's own.
#include <cstddef>

#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

using namespace gnomon::simulation;

struct knn {
    int k;
};
struct segments {
    std::size_t count;
};
struct radius {
    double r;
};
double trust(const knn& nearest) { return nearest.k; }

int with_gnomon();

int main() {
    scene world;
    world.add_object("box", box{1, 1, 1}, at(2, 0, 0) * yaw(gnomon::degrees(30)));
    const true_scan truth = simulate(world, horizontal{.mount = world.sensor});
    const segments parts{truth.scan.size()};
    const bool are_own = trust(knn{3}) == 3.0 && radius{0.5}.r == 0.5;
    return parts.count > 0 && are_own ? with_gnomon() : 1;
}
