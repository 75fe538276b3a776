// SPDX-License-Identifier: BSL-1.0
// Spin images and shape contexts compared with those of PCL, on one thread. Spin images must be
// equal bin by bin to 1e-5, shape contexts in their sums over azimuths, whose reference PCL draws
// at random. PCL computes in float: a neighbor at a limit of a bin may be on the other side of it.
// Spin images with a neighbor that near to the end of the cylinder, or to its axis, are counted and
// not compared. Times are those of the processor, the least of several runs in turns, of both
// without the index.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "two_scans.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/features/describe_points.hpp>
#include <gnomon/features/shape_context.hpp>
#include <gnomon/features/spin_image.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <pcl/features/3dsc.h>
#include <pcl/features/impl/3dsc.hpp>
#include <pcl/features/impl/spin_image.hpp>
#include <pcl/features/spin_image.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

namespace {

struct normal_only {
    Eigen::Vector3d normal;
};

/// A cloud whose coordinates and normals floats can hold, for both libraries.
struct described_cloud {
    std::vector<Eigen::Vector3d> points;
    std::vector<normal_only> surface;
    std::vector<gnomon::point_index> keypoints;  // those with a normal, at most `most`
    gnomon::spatial_index index;
    pcl::PointCloud<pcl::PointXYZ>::Ptr pcl_points{new pcl::PointCloud<pcl::PointXYZ>};
    pcl::PointCloud<pcl::Normal>::Ptr pcl_normals{new pcl::PointCloud<pcl::Normal>};
    pcl::search::KdTree<pcl::PointXYZ>::Ptr pcl_tree{new pcl::search::KdTree<pcl::PointXYZ>};

    described_cloud(std::vector<Eigen::Vector3d> all, std::size_t most) {
        for (const Eigen::Vector3d& p : all)
            if (p.allFinite()) points.push_back(p.cast<float>().cast<double>());
        const auto less = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
            return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
        };
        std::sort(points.begin(), points.end(), less);  // PCL leaves out duplicates of a point
        points.erase(std::unique(points.begin(), points.end()), points.end());
        index = gnomon::spatial_index(points);
        const auto estimated = gnomon::estimate_normals(index, gnomon::knn{.k = 30});
        const std::size_t step = std::max<std::size_t>(1, points.size() / most);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Eigen::Vector3f p = points[i].cast<float>();
            const Eigen::Vector3f n = estimated[i].normal.cast<float>();
            surface.push_back({n.cast<double>()});
            pcl_points->emplace_back(p.x(), p.y(), p.z());
            pcl_normals->emplace_back(n.x(), n.y(), n.z());
            if (i % step == 0 && gnomon::usable(estimated[i].trust))
                keypoints.push_back(static_cast<gnomon::point_index>(i));
        }
        pcl_tree->setInputCloud(pcl_points);
    }

    template <class Estimation>
    void give_to(Estimation& estimation) const {
        estimation.setInputCloud(pcl_points);
        estimation.setInputNormals(pcl_normals);
        estimation.setSearchMethod(pcl_tree);
        estimation.setIndices(std::make_shared<pcl::Indices>(keypoints.begin(), keypoints.end()));
    }
};

/// The least times of some runs in turns. compare(ours, theirs) gets the results.
struct times {
    double ours = 0.0, pcl = 0.0;

    template <class Theirs>
    static times measure(const effort& much, auto&& describe, auto&& estimate, auto&& compare) {
        const effort once{.quick = true, .out = {}};
        const int runs = much.quick ? 1 : 5;
        times least{1e300, 1e300};
        gnomon::point_descriptors ours;
        pcl::PointCloud<Theirs> theirs;
        for (int run = 0; run < runs; ++run) {
            least.pcl = std::min(least.pcl, seconds_of(once, [&] { estimate(theirs); }));
            ours = {};  // both find the memory of their last result
            least.ours = std::min(least.ours, seconds_of(once, [&] { ours = describe(); }));
        }
        compare(ours, theirs);
        return least;
    }

    /// The first columns of a row.
    [[nodiscard]] json row(const std::string& cloud, const char* what, double radius,
                           std::size_t keys) const {
        const double n = static_cast<double>(keys);
        return {{"cloud", cloud},
                {"descriptor", what},
                {"radius [m]", radius},
                {"points", keys},
                {"PCL, of a point [us]", rounded(1e6 * pcl / n, 2)},
                {"gnomon, of a point [us]", rounded(1e6 * ours / n, 2)},
                {"ratio", rounded(pcl / ours, 1)}};
    }
};

/// Whether a neighbor is so near to a limit of the cylinder, or to its axis, that floats decide.
bool depends_on_rounding(const described_cloud& cloud, std::size_t i, const gnomon::spin_image& s) {
    const Eigen::Vector3d& p = cloud.points[i];
    const Eigen::Vector3d& n = cloud.surface[i].normal;
    for (const gnomon::neighbor& q : cloud.index.within(p, 1.001 * s.support_radius())) {
        const Eigen::Vector3d d = cloud.points[q.index] - p;
        const double beta = std::abs(n.dot(d)), alpha = n.cross(d).norm();
        const double doubt = 2e-6 * s.radius;  // a few units in the last place of the floats
        if (std::abs(beta - 0.5 * s.height) < doubt || std::abs(alpha - s.radius) < doubt ||
            (q.index != i && alpha < 1e-2 * beta))
            return true;
    }
    return false;
}

json compare_spin_images(const effort& much, const described_cloud& cloud, const std::string& name,
                         double search_radius) {
    constexpr unsigned width = 8;  // 153 bins, as in PCL's examples
    const double r = search_radius / std::numbers::sqrt2;
    const gnomon::spin_image image{.radius = r,
                                   .height = 2.0 * r,
                                   .radial_bins = width,
                                   .axial_bins = 2 * width,
                                   .interpolate = true,
                                   .normalize = true};
    using histogram = pcl::Histogram<153>;
    const auto describe = [&] {
        return gnomon::describe_points(cloud.index, cloud.surface, cloud.keypoints, image);
    };
    const auto estimate = [&](auto& result) {
        pcl::SpinImageEstimation<pcl::PointXYZ, pcl::Normal, histogram> estimation(width, 0.0, 0);
        cloud.give_to(estimation);
        estimation.setRadiusSearch(search_radius);
        estimation.compute(result);
    };
    double largest = 0.0;
    std::size_t different = 0, doubtful = 0;
    const auto compare = [&](const auto& ours, const auto& theirs) {
        for (std::size_t k = 0; k < cloud.keypoints.size(); ++k) {
            if (!gnomon::usable(ours.trust[k])) continue;
            double difference = 0.0;
            for (std::size_t b = 0; b < 153; ++b)
                difference =
                    std::max<double>(difference, std::abs(ours[k][b] - theirs[k].histogram[b]));
            if (difference > 1e-5 && depends_on_rounding(cloud, cloud.keypoints[k], image)) {
                ++doubtful;
                continue;
            }
            different += difference > 1e-5 ? 1 : 0;
            largest = std::max(largest, difference);
        }
    };
    json row = times::measure<histogram>(much, describe, estimate, compare)
                   .row(name, "spin image", search_radius, cloud.keypoints.size());
    if (different > 0)
        throw std::runtime_error(std::to_string(different) + " spin images differ from PCL's");
    char text[16];
    std::snprintf(text, sizeof text, "%.0e", largest);
    row["difference"] = text;
    row["by rounding"] = doubtful;
    return row;
}

json compare_shape_contexts(const effort& much, const described_cloud& cloud,
                            const std::string& name, double radius) {
    const gnomon::shape_context context{.radius = radius,
                                        .inner_radius = 0.1 * radius,
                                        .azimuth_bins = 12,
                                        .elevation_bins = 11,
                                        .radial_bins = 15,
                                        .density_radius = 0.2 * radius};
    const auto describe = [&] {
        return gnomon::describe_points(cloud.index, cloud.surface, cloud.keypoints, context);
    };
    const auto estimate = [&](auto& result) {
        pcl::ShapeContext3DEstimation<pcl::PointXYZ, pcl::Normal> estimation;
        cloud.give_to(estimation);
        estimation.setRadiusSearch(radius);
        estimation.setMinimalRadius(context.inner_radius);
        estimation.setPointDensityRadius(context.density_radius);
        estimation.compute(result);
    };
    double sum = 0.0, difference = 0.0;
    const auto compare = [&](const auto& ours, const auto& theirs) {
        for (std::size_t k = 0; k < cloud.keypoints.size(); ++k) {
            // Sums over azimuths. PCL puts nearer neighbors than the first shell into it.
            std::vector<double> a(165, 0.0), b(165, 0.0);
            for (std::size_t i = 0; i < 1980; ++i) {
                if (i % 15 == 0) continue;
                a[i % 165] += static_cast<double>(ours[k][i]);
                b[i % 165] += static_cast<double>(theirs[k].descriptor[i]);
            }
            for (std::size_t i = 0; i < 165; ++i) {
                sum += std::abs(b[i]);
                difference += std::abs(a[i] - b[i]);
            }
        }
    };
    json row = times::measure<pcl::ShapeContext1980>(much, describe, estimate, compare)
                   .row(name, "shape context", radius, cloud.keypoints.size());
    if (difference > 1e-3 * sum) throw std::runtime_error("shape contexts differ from PCL's");
    char text[16];
    std::snprintf(text, sizeof text, "%.0e", difference / sum);
    row["difference"] = text;
    row["by rounding"] = 0;
    return row;
}

/// The surface of a box of 1 m x 0.8 m x 0.6 m with noise of 2 mm.
std::vector<Eigen::Vector3d> noisy_box(std::size_t n) {
    gnomon::random_stream random(1);
    std::vector<Eigen::Vector3d> points;
    for (std::size_t i = 0; i < n; ++i) {
        Eigen::Vector3d p(random.uniform(), 0.8 * random.uniform(), 0.6 * random.uniform());
        const auto axis = static_cast<Eigen::Index>(i % 3);
        p[axis] =
            (i % 2 == 0 ? 0.0 : 1.0 - 0.2 * static_cast<double>(axis)) + 0.002 * random.gaussian();
        points.push_back(p);
    }
    return points;
}

void compare_all(const std::vector<Eigen::Vector3d>& points, const std::string& name,
                 const effort& much, json& rows) {
    const described_cloud cloud(points, much.quick ? 500 : 10'000);
    const described_cloud few(points, much.quick ? 20 : 2000);
    for (const double radius : {0.05, 0.1, 0.2})
        rows.push_back(compare_spin_images(much, cloud, name, radius));
    for (const double radius : {0.1, 0.2})
        rows.push_back(compare_shape_contexts(much, few, name, radius));
}

json measure(const effort& much) {
    json rows = json::array();
    compare_all(noisy_box(20'000), "box", much, rows);
    const two_scans room({15.0, "whole", "rotational"}, first_seed);
    const gnomon::scan& scan = room.scans[0].scan;
    compare_all({scan.begin(), scan.end()}, "room", much, rows);
    return {{"compared with PCL", rows}};
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, measure); }
