// SPDX-License-Identifier: BSL-1.0
/// @file
/// Spin images and shape contexts compared with those of PCL, on one thread:
///     pcl_descriptors SCAN...      without a scan: on the surface of a box with noise
/// Spin images must be equal bin by bin to 1e-5, shape contexts in their sums over azimuths, whose
/// reference PCL draws at random. PCL computes in float: a neighbor at a limit of a bin may be on
/// the other side of it. Spin images with a neighbor that near to the end of the cylinder, or to
/// its axis, are counted and not compared. Times are those of the processor, the least of several
/// runs in turns, of both without the index. Exit status: 0, or 1 if something differs.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <limits>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/random.hpp>
#include <gnomon/features/describe_points.hpp>
#include <gnomon/features/shape_context.hpp>
#include <gnomon/features/spin_image.hpp>
#include <gnomon/io/read.hpp>
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
    void give_to(Estimation& estimation, std::span<const gnomon::point_index> keys) const {
        estimation.setInputCloud(pcl_points);
        estimation.setInputNormals(pcl_normals);
        estimation.setSearchMethod(pcl_tree);
        estimation.setIndices(std::make_shared<pcl::Indices>(keys.begin(), keys.end()));
    }
};

/// Seconds of the processor that one call takes.
double seconds_of(auto&& work) {
    const auto now = [] {
        std::timespec t{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
        return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
    };
    const double begin = now();
    work();
    return now() - begin;
}

/// The least times of some runs in turns, summed over parts of the keypoints: other programs on the
/// machine rarely disturb all runs of a part. compare(keys, ours, theirs) gets the results.
struct times {
    double ours = 0.0, pcl = 0.0;

    template <class Theirs>
    static times measure(const described_cloud& cloud, auto&& describe, auto&& estimate,
                         auto&& compare, std::size_t part, int runs) {
        times sum;
        for (std::size_t begin = 0; begin < cloud.keypoints.size(); begin += part) {
            const auto rest = std::span(cloud.keypoints).subspan(begin);
            const auto keys = rest.first(std::min(part, rest.size()));
            times least{1e300, 1e300};
            gnomon::point_descriptors ours;
            pcl::PointCloud<Theirs> theirs;
            for (int run = 0; run < runs; ++run) {
                least.pcl = std::min(least.pcl, seconds_of([&] { estimate(keys, theirs); }));
                least.ours = std::min(least.ours, seconds_of([&] { ours = describe(keys); }));
            }
            sum.ours += least.ours;
            sum.pcl += least.pcl;
            compare(keys, ours, theirs);
        }
        return sum;
    }

    void print(const char* what, const std::string& name, double radius, std::size_t keys) const {
        std::printf("%s, %s, radius %.3f m, %zu points: PCL %.3f s, gnomon %.3f s, ratio %.1f\n",
                    what, name.c_str(), radius, keys, pcl, ours, pcl / ours);
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

/// @return the number of differences
std::size_t compare_spin_images(const described_cloud& cloud, const std::string& name,
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
    const auto describe = [&](std::span<const gnomon::point_index> keys) {
        return gnomon::describe_points(cloud.index, cloud.surface, keys, image);
    };
    const auto estimate = [&](std::span<const gnomon::point_index> keys, auto& result) {
        pcl::SpinImageEstimation<pcl::PointXYZ, pcl::Normal, histogram> estimation(width, 0.0, 0);
        cloud.give_to(estimation, keys);
        estimation.setRadiusSearch(search_radius);
        estimation.compute(result);
    };
    double largest = 0.0;
    std::size_t different = 0, doubtful = 0;
    const auto compare = [&](auto keys, const auto& ours, const auto& theirs) {
        for (std::size_t k = 0; k < keys.size(); ++k) {
            if (!gnomon::usable(ours.trust[k])) continue;
            double difference = 0.0;
            for (std::size_t b = 0; b < 153; ++b)
                difference =
                    std::max<double>(difference, std::abs(ours[k][b] - theirs[k].histogram[b]));
            if (difference > 1e-5 && depends_on_rounding(cloud, keys[k], image)) {
                ++doubtful;
                continue;
            }
            different += difference > 1e-5 ? 1 : 0;
            largest = std::max(largest, difference);
        }
    };
    times::measure<histogram>(cloud, describe, estimate, compare, 500, 5)
        .print("spin images", name, search_radius, cloud.keypoints.size());
    std::printf("  largest difference of a bin %.1e, %zu above 1e-5, and %zu by rounding\n",
                largest, different, doubtful);
    return different;
}

/// @return the number of differences
std::size_t compare_shape_contexts(const described_cloud& cloud, const std::string& name,
                                   double radius) {
    const gnomon::shape_context context{.radius = radius,
                                        .inner_radius = 0.1 * radius,
                                        .azimuth_bins = 12,
                                        .elevation_bins = 11,
                                        .radial_bins = 15,
                                        .density_radius = 0.2 * radius};
    const auto describe = [&](std::span<const gnomon::point_index> keys) {
        return gnomon::describe_points(cloud.index, cloud.surface, keys, context);
    };
    const auto estimate = [&](std::span<const gnomon::point_index> keys, auto& result) {
        pcl::ShapeContext3DEstimation<pcl::PointXYZ, pcl::Normal> estimation;
        cloud.give_to(estimation, keys);
        estimation.setRadiusSearch(radius);
        estimation.setMinimalRadius(context.inner_radius);
        estimation.setPointDensityRadius(context.density_radius);
        estimation.compute(result);
    };
    double sum = 0.0, difference = 0.0;
    const auto compare = [&](auto keys, const auto& ours, const auto& theirs) {
        for (std::size_t k = 0; k < keys.size(); ++k) {
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
    times::measure<pcl::ShapeContext1980>(cloud, describe, estimate, compare, 100, 3)
        .print("shape contexts", name, radius, cloud.keypoints.size());
    std::printf("  %.1e of the sum is in other bins\n", difference / sum);
    return difference <= 1e-3 * sum ? 0 : 1;
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

std::size_t compare_all(const std::vector<Eigen::Vector3d>& points, const std::string& name) {
    std::size_t different = 0;
    const described_cloud cloud(points, 10'000), few(points, 300);
    for (const double radius : {0.05, 0.1, 0.2})
        different += compare_spin_images(cloud, name, radius);
    return different + compare_shape_contexts(few, name, 0.2);
}

}  // namespace

int main(int argc, char** argv) {
    std::size_t different = 0;
    if (argc < 2) different += compare_all(noisy_box(20'000), "a box");
    for (int i = 1; i < argc; ++i) {
        const gnomon::scan scan = gnomon::io::read(argv[i]);
        different += compare_all({scan.begin(), scan.end()}, argv[i]);
    }
    return different == 0 ? 0 : 1;
}
