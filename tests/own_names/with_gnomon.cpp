// SPDX-License-Identifier: BSL-1.0
// `using namespace gnomon` does not bring the simulator's names: here, they are the user's own.
#include <array>

#include <gnomon/gnomon.hpp>
#include <gnomon/perception.hpp>
#include <gnomon/simulation.hpp>

using namespace gnomon;

struct box {
    double edge;
};
struct chair {
    box seat;
};
struct ray {
    point_index pixel;
};
enum class table { round, square };
constexpr int nothing = 0;
constexpr bool horizontal = true;
constexpr bool vertical = false;
constexpr bool fixed = true;
double at(double x) { return 2.0 * x; }
double along(const box& b) { return b.edge; }
double yaw(double x) { return x; }
double simulate(const ray& r) { return r.pixel; }

int with_gnomon() {
    const std::array<Eigen::Vector3d, 4> points{{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}}};
    const auto surface = estimate_normals(points, knn{.k = 4}, plane_pca{});
    const bool is_level = std::abs(surface[0].normal.z()) > 0.99;
    const chair c{{0.4}};
    const bool are_own = at(along(c.seat)) == 0.8 && yaw(1.0) + simulate(ray{2}) == 3.0 &&
                         horizontal && !vertical && fixed && table::round != table::square;
    return is_level && are_own ? nothing : 1;
}
