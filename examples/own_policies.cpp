// SPDX-License-Identifier: BSL-1.0
// What is the least that a policy of my own must have? One of each kind; docs/concepts explains
// them. Neighborhoods, estimators and containers have examples of their own.
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/help.hpp"
#include <gnomon/features/describe_points.hpp>
#include <gnomon/gnomon.hpp>

// [own_normal_range]
// Normals from elsewhere, such as a file or another library: any struct with a member `normal`.
struct oriented_point {
    Eigen::Vector3d position;  // [m]
    Eigen::Vector3d normal;    // unit length, or zero where there is none
    double mean_distance;      // to the neighbors [m]; segment_surfaces needs it
};
static_assert(gnomon::normal_range<std::vector<oriented_point>>);
static_assert(gnomon::surfel_range<std::vector<oriented_point>>);
// [own_normal_range]

// [own_graph]
// Neighbors that are known already, such as those along a scan line: graph[i] refers to those of i.
struct scan_line_graph {
    std::vector<std::vector<gnomon::point_index>> beside;

    std::size_t size() const { return beside.size(); }
    const std::vector<gnomon::point_index>& operator[](std::size_t i) const { return beside[i]; }
};
static_assert(gnomon::neighborhood_graph<scan_line_graph>);
// [own_graph]

// [own_execution]
// Runs the chunks in the calling thread, and counts them.
struct counted {
    std::size_t* count;

    void operator()(std::size_t chunks, auto&& work) const {
        for (std::size_t c = 0; c < chunks; ++c) work(c);
        *count += chunks;
    }
};
static_assert(gnomon::execution<counted>);
// [own_execution]

// [own_range_noise]
// The noise of a data sheet: a constant one up to 10 m, then in proportion to the range.
struct data_sheet_noise {
    double operator()(double range) const { return range < 10.0 ? 0.02 : 0.002 * range; }  // [m]
};
static_assert(gnomon::range_noise<data_sheet_noise>);
// [own_range_noise]

// [own_size_preference]
// Prefers the neighborhood that is flattest for its width.
struct prefer_flat {
    double operator()(const gnomon::neighborhood_shape& shape) const {
        return shape.spectrum.surface_variation();
    }
};
static_assert(gnomon::size_preference<prefer_flat>);
// [own_size_preference]

// [own_dissimilarity]
// Oriented points are alike up to `radius` apart and, unlike `two_thresholds`, with normals to the
// same side.
struct same_side {
    double radius = 0.05;  // [m]

    auto criterion() const {
        return [limit = radius * radius](double squared_distance, const Eigen::Vector3d& n_i,
                                         const Eigen::Vector3d& n_j) {
            return squared_distance <= limit && n_i.dot(n_j) >= 0.99;
        };
    }
};
static_assert(gnomon::oriented_dissimilarity<same_side>);
// [own_dissimilarity]

// [own_curvature_estimator]
// The mean curvature alone, from the mean height of the neighbors above the tangent plane.
struct mean_height {
    gnomon::curvature operator()(const Eigen::Vector3d& p, const Eigen::Vector3d& normal,
                                 gnomon::neighborhood_view neighbors) const {
        double heights = 0.0, squares = 0.0;
        for (const Eigen::Vector3d& q : neighbors) {
            heights += normal.dot(q - p);
            squares += (q - p).squaredNorm();
        }
        gnomon::curvature c;
        if (squares == 0.0) return c;  // too_few_neighbors
        c.kappa1 = c.kappa2 = 2.0 * heights / squares;
        c.direction1 = normal.unitOrthogonal();
        c.direction2 = c.direction1.cross(normal);
        c.trust = gnomon::trust::good;
        return c;
    }
};
static_assert(gnomon::curvature_estimator<mean_height>);
// [own_curvature_estimator]

// [own_descriptor]
// How many neighbors are in front of the tangent plane, and how many behind it.
struct front_and_back {
    double radius = 0.2;  // [m]

    double support_radius() const { return radius; }
    static std::size_t dimension() { return 2; }
    static double distance(std::span<const float> a, std::span<const float> b) {
        return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]);
    }
    gnomon::trust operator()(const Eigen::Vector3d& p, const Eigen::Vector3d& normal,
                             gnomon::neighborhood_view neighbors, std::span<double> row) const {
        for (const Eigen::Vector3d& q : neighbors) row[normal.dot(q - p) > 0.0 ? 0 : 1] += 1.0;
        return neighbors.empty() ? gnomon::trust::too_few_neighbors : gnomon::trust::good;
    }
};
static_assert(gnomon::descriptor<front_and_back>);
// [own_descriptor]

// [own_merge_policy]
// Merges where the gap is hidden or shows the surface itself; a function or a lambda will do.
bool hidden_or_continued(gnomon::observation seen) {
    return seen == gnomon::observation::occluded || seen == gnomon::observation::on_surface;
}
static_assert(gnomon::merge_policy<decltype(&hidden_or_continued)>);
// [own_merge_policy]

int main(int argc, char** argv) {
    if (printed_help(argc, argv, "Runs one policy of its own of each kind.")) return 0;
    // A wall 2 m in front of the sensor, behind a post 1 m in front of it.
    std::vector<Eigen::Vector3d> points;
    for (int i = -50; i <= 50; ++i) {
        for (int j = -50; j <= 50; ++j) {
            const bool is_behind = std::abs(i) < 10;
            points.emplace_back(is_behind ? 1.0 : 2.0, (is_behind ? 0.01 : 0.02) * i,
                                (is_behind ? 0.01 : 0.02) * j);
        }
    }

    std::size_t chunks = 0;
    const gnomon::adaptive_knn<prefer_flat> neighborhood{.min_k = 10, .max_k = 40};
    const auto surface =
        gnomon::estimate_normals(points, neighborhood, gnomon::plane_pca{}, counted{&chunks});
    std::printf("%zu normals in %zu chunks\n", surface.size(), chunks);

    const auto believed = gnomon::estimate_normals(points, neighborhood,
                                                   gnomon::plane_eif{.noise = data_sheet_noise{}});
    std::printf("the first normal turns by %.4f rad\n", std::sqrt(believed[0].trace()));

    scan_line_graph along{std::vector<std::vector<gnomon::point_index>>(points.size())};
    for (std::size_t i = 1; i + 1 < points.size(); ++i)
        along.beside[i] = {static_cast<gnomon::point_index>(i - 1),
                           static_cast<gnomon::point_index>(i + 1)};
    const gnomon::area_weighted average{};
    const auto averaged = gnomon::estimate_normals(points, gnomon::delaunay{}, average);
    const auto in_lines = gnomon::estimate_normals(points, along, average);
    std::printf("the first normal: %.3f, in lines: %s\n", averaged[0].normal.x(),
                gnomon::to_string(in_lines[1].trust));

    const auto bends =
        gnomon::estimate_curvature(points, gnomon::knn{.k = 20}, surface, mean_height{});
    std::printf("the wall bends by %.3f 1/m\n", bends[0].mean());

    const auto sides = gnomon::describe_points(points, surface, front_and_back{});
    std::printf("%.0f neighbors in front of the first point, %.0f behind\n", sides[0][0],
                sides[0][1]);

    std::vector<oriented_point> mine;
    for (std::size_t i = 0; i < points.size(); ++i)
        mine.push_back({points[i], surface[i].normal, surface[i].mean_distance});
    gnomon::orient_normals(points, mine);
    const auto groups = gnomon::segment_oriented_points(points, mine, same_side{});
    const auto parts = gnomon::segment_surfaces(points, mine);
    const auto merged =
        gnomon::merge_occluded(points, parts, gnomon::visibility(points), &hidden_or_continued);
    std::printf("%zu groups, %zu surfaces, %zu after merging\n", groups.size(), parts.size(),
                merged.segments.size());
}
