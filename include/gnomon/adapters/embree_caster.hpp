// SPDX-License-Identifier: BSL-1.0
/// @file
/// Ray casting with Embree 3 or 4 (Wald et al. 2014): in single precision, fastest on meshes of
/// many triangles. Link with gnomon::embree.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <gnomon/core/error.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/simulation/bounds.hpp>
#include <gnomon/simulation/polyhedron.hpp>
#include <gnomon/simulation/ray.hpp>
#include <gnomon/simulation/scene.hpp>

namespace gnomon::simulation {

/// Models `ray_caster`, in single precision: positions and ranges have a relative error of about
/// 1e-6 of the size of the scene; Embree's coordinates are relative to its center. One distant
/// shape reduces the precision of all, and rays from beyond 1e15 m have no hit. Shapes with planar
/// faces become triangles; the others are intersected by their own first_hit(), with rays rounded
/// to single precision.
class embree_caster {
  public:
    /// Keeps the shapes of `world`, not the scene.
    /// @throws gnomon::error  if Embree fails, e.g. for lack of memory
    explicit embree_caster(const scene& world)
        : device_(rtcNewDevice(nullptr)), content_(std::make_unique<content>(world)) {
        check();
        scene_.reset(rtcNewScene(device_.get()));
        rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
        rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_HIGH);
        for (std::size_t i = 0; i < content_->shapes.size(); ++i) {
            if (const auto flat = content_->shapes[i].shape->triangles()) {
                add_triangles(i, *flat);
            } else {
                add_curved(i);
            }
        }
        rtcCommitScene(scene_.get());
        check();
    }

    /// The nearest hit within the ray's reach, in single precision. O(log n).
    [[nodiscard]] std::optional<ray_hit> operator()(const ray& r) const {
        const Eigen::Vector3d from = r.origin - content_->center;
        const double squared_length = r.direction.dot(r.direction);
        // Embree asserts finite origins within 1e15 m; a direction of 0 or NaN meets nothing.
        constexpr double farthest = 1e15;
        const bool is_ray = r.reach > 0.0 && squared_length > 0.5 && squared_length < 2.0 &&
                            from.dot(from) < farthest * farthest;
        if (!is_ray) return std::nullopt;

        RTCRayHit query{};
        query.ray.org_x = static_cast<float>(from.x());
        query.ray.org_y = static_cast<float>(from.y());
        query.ray.org_z = static_cast<float>(from.z());
        query.ray.dir_x = static_cast<float>(r.direction.x());
        query.ray.dir_y = static_cast<float>(r.direction.y());
        query.ray.dir_z = static_cast<float>(r.direction.z());
        query.ray.tnear = 0.0f;
        // Rounding must not lose a hit at the reach; its range is clamped to the reach.
        query.ray.tfar = static_cast<float>(r.reach + 1e-6 * (r.reach + content_->size));
        query.ray.mask = ~0u;
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
        rtcIntersect1(scene_.get(), &query);
#else
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(scene_.get(), &context, &query);
#endif
        if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;

        const placed_shape& s = content_->shapes[query.hit.geomID];
        const std::vector<std::int32_t>& surfaces =
            content_->surface_of_primitive[query.hit.geomID];
        const Eigen::Vector3d n(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
        const double sign = n.dot(r.direction) > 0.0 ? -1.0 : 1.0;
        const std::int32_t own = surfaces.empty() ? static_cast<std::int32_t>(query.hit.primID)
                                                  : surfaces[query.hit.primID];
        const double range = std::min<double>(query.ray.tfar, r.reach);
        return ray_hit{range, n * (sign / std::sqrt(n.dot(n))), s.first_surface + own};
    }

  private:
    struct release {
        void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
        void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
        void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
    };

    /// The data of Embree's callbacks; its address must not change.
    struct content {
        std::vector<placed_shape> shapes;
        Eigen::Vector3d center;  ///< of the scene: single precision is best about the origin
        double size = 0.0;       ///< of the scene, from end to end [m]
        /// The surface of each triangle of each shape; empty for curved shapes, whose callback
        /// stores the surface number as Embree's primitive number.
        std::vector<std::vector<std::int32_t>> surface_of_primitive;

        explicit content(const scene& world)
            : shapes(world.shapes()), center(0.0, 0.0, 0.0), surface_of_primitive(shapes.size()) {
            if (shapes.empty()) return;
            const bounds all = world.extent();
            center = all.middle();
            size = std::sqrt(squared_distance(all.low, all.high));
        }
    };

    /// The user data of a curved shape's callbacks.
    struct curved {
        const content* all;
        std::size_t index;
    };

    void check() const {
        const RTCError problem = rtcGetDeviceError(device_.get());
        if (problem == RTC_ERROR_NONE) return;
        throw error("embree", "",
                    problem == RTC_ERROR_OUT_OF_MEMORY ? "out of memory" : "cannot make a scene");
    }

    using geometry_pointer = std::unique_ptr<RTCGeometryTy, release>;

    /// Attaches a geometry to the scene, which shares its ownership.
    void attach(const geometry_pointer& geometry, std::size_t i) {
        rtcCommitGeometry(geometry.get());
        rtcAttachGeometryByID(scene_.get(), geometry.get(), static_cast<unsigned>(i));
    }

    void add_triangles(std::size_t i, const polyhedron& faces) {
        const geometry_pointer geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
        auto* const vertices = static_cast<float*>(
            rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                    3 * sizeof(float), faces.vertices.size()));
        auto* const indices = static_cast<std::uint32_t*>(
            rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                    3 * sizeof(std::uint32_t), faces.triangles.size()));
        check();
        for (std::size_t v = 0; v < faces.vertices.size(); ++v) {
            const Eigen::Vector3d p =
                content_->shapes[i].pose.point_out(faces.vertices[v]) - content_->center;
            for (int a = 0; a < 3; ++a)
                vertices[3 * v + static_cast<std::size_t>(a)] = static_cast<float>(p[a]);
        }
        std::vector<std::int32_t>& surfaces = content_->surface_of_primitive[i];
        surfaces = faces.surface_of_triangle;
        surfaces.resize(faces.triangles.size(), 0);
        for (std::size_t t = 0; t < faces.triangles.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k) indices[3 * t + k] = faces.triangles[t][k];
        }
        attach(geometry, i);
    }

    void add_curved(std::size_t i) {
        curved_.push_back(std::make_unique<curved>(curved{content_.get(), i}));
        const geometry_pointer geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER));
        rtcSetGeometryUserPrimitiveCount(geometry.get(), 1);
        rtcSetGeometryUserData(geometry.get(), curved_.back().get());
        rtcSetGeometryBoundsFunction(geometry.get(), bounds_of_curved, nullptr);
        rtcSetGeometryIntersectFunction(geometry.get(), intersect_curved);
        attach(geometry, i);
    }

    static void bounds_of_curved(const RTCBoundsFunctionArguments* a) {
        const auto& self = *static_cast<const curved*>(a->geometryUserPtr);
        const bounds& b = self.all->shapes[self.index].extent;
        const Eigen::Vector3d low = b.low - self.all->center;
        const Eigen::Vector3d high = b.high - self.all->center;
        constexpr float infinity = std::numeric_limits<float>::infinity();
        const auto down = [](double x) { return std::nextafter(float(x), -infinity); };
        const auto up = [](double x) { return std::nextafter(float(x), infinity); };
        *a->bounds_o = {down(low.x()), down(low.y()), down(low.z()), 0.0f,
                        up(high.x()),  up(high.y()),  up(high.z()),  0.0f};
    }

    static void intersect_curved(const RTCIntersectFunctionNArguments* a) {
        if (a->N != 1 || a->valid[0] == 0) return;
        const auto& self = *static_cast<const curved*>(a->geometryUserPtr);
        auto& query = *reinterpret_cast<RTCRayHit*>(a->rayhit);
        const ray r{
            Eigen::Vector3d(query.ray.org_x, query.ray.org_y, query.ray.org_z) + self.all->center,
            {query.ray.dir_x, query.ray.dir_y, query.ray.dir_z},
            query.ray.tfar};
        const placed_shape& s = self.all->shapes[self.index];
        const auto hit = s.first_hit(r);
        if (!hit) return;
        query.ray.tfar = static_cast<float>(hit->range);
        query.hit.Ng_x = static_cast<float>(hit->normal.x());
        query.hit.Ng_y = static_cast<float>(hit->normal.y());
        query.hit.Ng_z = static_cast<float>(hit->normal.z());
        query.hit.geomID = a->geomID;
        query.hit.primID = static_cast<unsigned>(hit->surface - s.first_surface);
    }

    std::unique_ptr<RTCDeviceTy, release> device_;
    std::unique_ptr<content> content_;
    std::vector<std::unique_ptr<curved>> curved_;
    std::unique_ptr<RTCSceneTy, release> scene_;
};

}  // namespace gnomon::simulation
