// SPDX-License-Identifier: BSL-1.0
/// @file
/// Clouds of PCL, both ways. A pcl::PointCloud is a point range as it is; here are its sensor, its
/// normals and its labels, and clouds filled from points, surfaces and segments. Needs no header of
/// PCL: everything is a template over the type of the cloud.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/exceptions.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon {

namespace detail {

/// A pcl::PointCloud, or a class with the same members.
template <class C>
concept pcl_cloud = indexed_range<C> && requires(C cloud) {
    cloud.points.resize(std::size_t{});
    { cloud.points[0].x } -> std::convertible_to<float>;
    { cloud.width } -> std::convertible_to<std::uint32_t>;
    { cloud.height } -> std::convertible_to<std::uint32_t>;
    cloud.is_dense = true;
    { cloud.sensor_origin_[0] } -> std::convertible_to<float>;
};

template <class C>
concept pcl_cloud_of_normals = pcl_cloud<C> && requires(C cloud) { cloud.points[0].normal_x; };

template <class C>
concept pcl_cloud_of_labels = pcl_cloud<C> && requires(C cloud) { cloud.points[0].label; };

/// A cloud with its sensor as viewpoint and its width; refers to the cloud.
template <pcl_cloud C>
struct pcl_view {
    const C* cloud;
    viewpoint_table viewpoints;
    std::size_t width;  // of an organized image; else 0

    [[nodiscard]] auto begin() const { return std::ranges::begin(*cloud); }
    [[nodiscard]] auto end() const { return std::ranges::end(*cloud); }
    [[nodiscard]] std::size_t size() const {
        return static_cast<std::size_t>(std::ranges::size(*cloud));
    }
};

/// `value` as the scalar of a cloud.
/// @throws std::invalid_argument  if that moves it by more than 1 mm
template <std::floating_point Scalar>
[[nodiscard]] Scalar pcl_coordinate(double value) {
    constexpr double max_shift = 1e-3;  // [m], below the noise of range finders
    const bool fits = !(std::isfinite(value) &&
                        std::abs(value) > static_cast<double>(std::numeric_limits<Scalar>::max()));
    const Scalar result = fits ? static_cast<Scalar>(value) : Scalar{0};
    require(fits && !(std::abs(static_cast<double>(result) - value) > max_shift),
            "to_pcl: float moves a coordinate by more than 1 mm: pass an origin, which is "
            "subtracted");
    return result;
}

}  // namespace detail

/// A surface element out of a cloud of PCL.
struct pcl_surfel {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< a unit vector; zero without a normal
    gnomon::trust trust = trust::degenerate;           ///< good, or not_finite for a NaN
    double curvature = 0.0;                            ///< surface variation; 0 if there is none

    /// The curvature, by the name that surface elements have for it, so that put_normals() keeps
    /// it.
    [[nodiscard]] double surface_variation() const { return curvature; }
};

/// The points of a cloud, seen from `sensor_origin_`, with the width of an organized image. Refers
/// to the cloud; O(1).
template <detail::pcl_cloud C>
[[nodiscard]] detail::pcl_view<C> pcl_points(const C& cloud) {
    const auto& origin = cloud.sensor_origin_;
    return {&cloud,
            Eigen::Vector3d(static_cast<double>(origin[0]), static_cast<double>(origin[1]),
                            static_cast<double>(origin[2])),
            cloud.height > 1 ? static_cast<std::size_t>(cloud.width) : 0};
}
template <detail::pcl_cloud C>
void pcl_points(const C&& cloud) = delete;

/// The normals of a cloud with normal_x, normal_y, normal_z, as a `normal_range`; NaN, which PCL
/// writes where it has no normal, becomes the zero vector. O(points).
template <detail::pcl_cloud_of_normals C>
[[nodiscard]] std::vector<pcl_surfel> pcl_surface(const C& cloud) {
    std::vector<pcl_surfel> result;
    result.reserve(cloud.points.size());
    for (const auto& p : cloud.points) {
        const Eigen::Vector3d normal(static_cast<double>(p.normal_x),
                                     static_cast<double>(p.normal_y),
                                     static_cast<double>(p.normal_z));
        pcl_surfel element;
        if (!is_finite(normal)) {
            element.trust = trust::not_finite;
        } else if (const double length = normal.norm(); length > 0.0) {
            element.normal = normal / length;
            element.trust = trust::good;
        }
        if constexpr (requires { p.curvature; })
            element.curvature = static_cast<double>(p.curvature);
        result.push_back(element);
    }
    return result;
}

/// The labels of a cloud, as the constructor of `segments` takes them: the largest number, with
/// which PCL marks points without a segment, becomes `unlabeled`. O(points).
/// @throws gnomon::error  for another label of 2^31 or more
template <detail::pcl_cloud_of_labels C>
[[nodiscard]] std::vector<std::int32_t> pcl_labels(const C& cloud) {
    std::vector<std::int32_t> result;
    result.reserve(cloud.points.size());
    for (const auto& p : cloud.points) {
        const auto label = static_cast<std::uint32_t>(p.label);
        constexpr auto none = std::numeric_limits<std::uint32_t>::max();
        if (label > static_cast<std::uint32_t>(std::numeric_limits<std::int32_t>::max()) &&
            label != none)
            GNOMON_THROW(error("PCL cloud", "point " + std::to_string(result.size()),
                               "the label " + std::to_string(label) + " has more than 31 bits"));
        result.push_back(label == none ? unlabeled : static_cast<std::int32_t>(label));
    }
    return result;
}

/// Writes normals into a cloud with normal_x, normal_y, normal_z, and into `curvature`, where the
/// cloud and the surface have it, the surface variation. Missing normals become NaN, as in PCL.
/// @throws std::invalid_argument  if cloud and surface differ in size
/// Complexity: O(points).
template <detail::pcl_cloud_of_normals C, normal_range S>
void put_normals(C& cloud, const S& surface) {
    const std::size_t n = cloud.points.size();
    detail::require(static_cast<std::size_t>(std::ranges::size(surface)) == n,
                    "put_normals: cloud and surface differ in size");
    constexpr float none = std::numeric_limits<float>::quiet_NaN();
    for (std::size_t i = 0; i < n; ++i) {
        auto& p = cloud.points[i];
        const auto& element = surface[i];
        const bool has_normal = !is_missing(element.normal);
        if (!has_normal) cloud.is_dense = false;
        p.normal_x = has_normal ? static_cast<float>(element.normal.x()) : none;
        p.normal_y = has_normal ? static_cast<float>(element.normal.y()) : none;
        p.normal_z = has_normal ? static_cast<float>(element.normal.z()) : none;
        if constexpr (requires { p.curvature = static_cast<float>(element.surface_variation()); })
            p.curvature = has_normal ? static_cast<float>(element.surface_variation()) : none;
    }
}

/// Writes labels into a cloud with `label`; `unlabeled` becomes 4294967295.
/// @throws std::invalid_argument  if cloud and segments differ in size
/// Complexity: O(points).
template <detail::pcl_cloud_of_labels C>
void put_labels(C& cloud, const segments& parts) {
    const std::size_t n = cloud.points.size();
    detail::require(parts.labels().size() == n, "put_labels: cloud and segments differ in size");
    for (std::size_t i = 0; i < n; ++i)
        cloud.points[i].label = static_cast<std::uint32_t>(parts.labels()[i]);
}

/// A cloud of the points, with the width of an organized image and, if there is a single viewpoint,
/// with `sensor_origin_`:
///
///     auto cloud = to_pcl<pcl::PointCloud<pcl::PointNormal>>(scan);
///     put_normals(cloud, surface);
///
/// @param points      any point range [m]; NaN is kept, and is_dense is false then
/// @param origin      is subtracted from all coordinates [m], as floats cannot hold those of maps
/// @param projection  maps an element of the range to a point
/// @throws std::invalid_argument  if a coordinate moves by more than 1 mm in the scalar of the
/// cloud Complexity: O(points).
template <detail::pcl_cloud C, class R, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] C to_pcl(const R& points, const Eigen::Vector3d& origin = Eigen::Vector3d::Zero(),
                       Proj projection = {}) {
    const position_view<R, Proj> positions(points, std::move(projection));
    C cloud;
    cloud.points.resize(positions.size());
    cloud.is_dense = true;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        auto& p = cloud.points[i];
        using scalar = std::remove_cvref_t<decltype(p.x)>;
        const Eigen::Vector3d q = positions[i] - origin;
        p.x = detail::pcl_coordinate<scalar>(q.x());
        p.y = detail::pcl_coordinate<scalar>(q.y());
        p.z = detail::pcl_coordinate<scalar>(q.z());
        if (!is_finite(q)) cloud.is_dense = false;
    }

    std::size_t width = 0;
    if constexpr (requires { static_cast<std::size_t>(points.width); })
        width = static_cast<std::size_t>(points.width);
    if (width == 0 || positions.size() % width != 0) width = positions.size();
    cloud.width = static_cast<std::uint32_t>(width);
    cloud.height = static_cast<std::uint32_t>(width == 0 ? 1 : positions.size() / width);

    const viewpoint_table viewpoints = detail::viewpoints_of(points);
    if (viewpoints.positions().size() == 1) {
        const Eigen::Vector3d sensor = viewpoints.positions().front() - origin;
        for (const int k : {0, 1, 2}) cloud.sensor_origin_[k] = static_cast<float>(sensor[k]);
    }
    return cloud;
}

}  // namespace gnomon
