// SPDX-License-Identifier: BSL-1.0
/// @file
/// Scenes: placed shapes with a hierarchy of names. An object ("chair 2") consists of parts
/// ("seat"), a part of shapes, and a shape has surfaces ("+z"). Objects, parts and surfaces have
/// numbers, which the ground truth of a scan uses, and names.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/oriented_box.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/simulation/bounds.hpp>
#include <gnomon/simulation/detail/any_shape.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/ray.hpp>
#include <gnomon/simulation/shape.hpp>

namespace gnomon::simulation {

/// The number of an object, part or surface that does not exist.
inline constexpr std::int32_t nothing = -1;

/// A surface of a scene.
struct scene_surface {
    std::string name;   ///< given by its shape
    std::int32_t part;  ///< that it belongs to
};

/// A part of a scene.
struct scene_part {
    std::string name;     ///< given when it was added
    std::int32_t object;  ///< that it belongs to
};

/// A door or a window of a scene: a hole of a surface.
struct opening {
    std::string name;        ///< such as "door 1"
    oriented_box rectangle;  ///< level edge first, then the upright one; without a third length
};

/// A shape and its pose in a scene.
struct placed_shape {
    std::shared_ptr<const detail::any_shape> shape;  ///< in its own frame
    gnomon::simulation::pose pose;  ///< from the frame of the shape to that of the scene
    bounds extent;                  ///< in the scene's frame
    std::int32_t first_surface;     ///< number of its surface 0; the others follow

    /// The first hit, in the scene's frame and with the scene's surface numbers.
    [[nodiscard]] std::optional<ray_hit> first_hit(const ray& r) const {
        auto hit =
            shape->first_hit({pose.point_in(r.origin), pose.direction_in(r.direction), r.reach});
        if (hit) {
            hit->normal = pose.direction_out(hit->normal);
            hit->surface += first_surface;
        }
        return hit;
    }
};

/// A scene: objects, their parts and the shapes of these. Copies share the shapes.
class scene {
  public:
    /// The recommended sensor pose. By default the origin, level.
    pose sensor;
    /// The known holes of surfaces, such as doors and windows; rays do not depend on them.
    std::vector<opening> openings;

    /// A new object.
    /// @return its number
    std::int32_t add_object(std::string name) {
        objects_.push_back(std::move(name));
        return static_cast<std::int32_t>(objects_.size() - 1);
    }

    /// Adds an object with one part, "body", of one shape.
    /// @return the number of its first surface
    /// @throws std::invalid_argument  as add() does
    template <shape S>
    std::int32_t add_object(std::string name, S shape, const pose& at = {}) {
        return add(add_part(add_object(std::move(name)), "body"), std::move(shape), at);
    }

    /// Adds a part to an object.
    /// @return its number, unique in the scene
    /// @throws std::invalid_argument  if there is no such object
    std::int32_t add_part(std::int32_t object, std::string name) {
        gnomon::detail::require(object >= 0 && static_cast<std::size_t>(object) < objects_.size(),
                                "scene: a part of a missing object");
        parts_.push_back({std::move(name), object});
        return static_cast<std::int32_t>(parts_.size() - 1);
    }

    /// Adds a shape to a part.
    /// @return the number of its first surface
    /// @throws std::invalid_argument  if there is no such part; if the shape's size is negative or
    ///                                not finite, or its pose no rigid motion
    template <shape S>
    std::int32_t add(std::int32_t part, S shape, const pose& at = {}) {
        gnomon::detail::require(part >= 0 && static_cast<std::size_t>(part) < parts_.size(),
                                "scene: a shape of a missing part");
        gnomon::detail::require(is_rigid(at), "scene: a pose must be a rigid motion");
        const bounds extent = placed(shape.extent(), at);
        const auto first = static_cast<std::int32_t>(surfaces_.size());
        for (const auto& name : shape.surface_names())
            surfaces_.push_back({std::string(name), part});
        shapes_.push_back(
            {std::make_shared<const detail::any_shape_of<S>>(std::move(shape)), at, extent, first});
        return first;
    }

    friend std::int32_t add(scene& world, const scene& model, const pose& at);
    friend std::int32_t add(scene& world, std::string name, const scene& model, const pose& at);

    /// The names of the objects, by number.
    [[nodiscard]] const std::vector<std::string>& objects() const { return objects_; }
    /// The parts, by number.
    [[nodiscard]] const std::vector<scene_part>& parts() const { return parts_; }
    /// The surfaces, by number.
    [[nodiscard]] const std::vector<scene_surface>& surfaces() const { return surfaces_; }
    /// The shapes, in the order in which they were added.
    [[nodiscard]] const std::vector<placed_shape>& shapes() const { return shapes_; }

    /// The bounds of all shapes [m]; empty if there are none. O(shapes).
    [[nodiscard]] bounds extent() const {
        bounds all;
        for (const placed_shape& s : shapes_) all.extend(s.extent);
        return all;
    }

    /// The full name of a surface, such as "chair 2/seat/+z". Precondition: the surface exists.
    [[nodiscard]] std::string surface_name(std::int32_t surface) const {
        const scene_surface& s = surfaces_[static_cast<std::size_t>(surface)];
        const scene_part& p = parts_[static_cast<std::size_t>(s.part)];
        return objects_[static_cast<std::size_t>(p.object)] + "/" + p.name + "/" + s.name;
    }

    /// The number of the first surface with this full name; `nothing` if there is none.
    /// O(surfaces).
    [[nodiscard]] std::int32_t find_surface(std::string_view whole_name) const {
        for (std::size_t i = 0; i < surfaces_.size(); ++i) {
            const auto number = static_cast<std::int32_t>(i);
            if (surface_name(number) == whole_name) return number;
        }
        return nothing;
    }

  private:
    /// Adds the contents of a model. Its object i becomes names[i], or all its objects the only
    /// name. All numbers are computed before anything is added, as the model may be this scene.
    /// @return the number of the first of these objects; `nothing` without names
    std::int32_t append(const scene& model, std::vector<std::string> names, bool as_one,
                        const pose& at) {
        gnomon::detail::require(is_rigid(at), "scene: a pose must be a rigid motion");
        const auto first_object = static_cast<std::int32_t>(objects_.size());
        const auto first_part = static_cast<std::int32_t>(parts_.size());
        const auto first_surface = static_cast<std::int32_t>(surfaces_.size());
        scene moved;
        moved.objects_ = std::move(names);
        moved.parts_ = model.parts_;
        moved.surfaces_ = model.surfaces_;
        moved.openings = model.openings;
        for (scene_part& p : moved.parts_) p.object = first_object + (as_one ? 0 : p.object);
        for (scene_surface& s : moved.surfaces_) s.part += first_part;
        for (const placed_shape& s : model.shapes_) {
            const pose outer = at * s.pose;
            moved.shapes_.push_back({s.shape, outer, placed(s.shape->extent(), outer),
                                     first_surface + s.first_surface});
        }
        for (opening& o : moved.openings) {
            o.rectangle.center = at.point_out(o.rectangle.center);
            o.rectangle.axes = (at * pose{o.rectangle.axes, {0.0, 0.0, 0.0}}).rotation;
        }
        const auto take = [](auto& all, auto& more) {
            all.insert(all.end(), std::make_move_iterator(more.begin()),
                       std::make_move_iterator(more.end()));
        };
        const bool is_empty = moved.objects_.empty();
        take(objects_, moved.objects_);
        take(parts_, moved.parts_);
        take(surfaces_, moved.surfaces_);
        take(shapes_, moved.shapes_);
        take(openings, moved.openings);
        return is_empty ? nothing : first_object;
    }

    /// The axis-aligned bounds of transformed bounds.
    static bounds placed(const bounds& own, const pose& at) {
        using gnomon::detail::require;
        bounds result;
        for (int i = 0; i < 3; ++i) {
            require(own.low[i] <= own.high[i],
                    "scene: the size of a shape must be finite and not negative");
            double reach = 0.0;
            double middle = at.position[i];
            for (int j = 0; j < 3; ++j) {
                middle += at.rotation(i, j) * 0.5 * (own.low[j] + own.high[j]);
                reach += std::abs(at.rotation(i, j)) * 0.5 * (own.high[j] - own.low[j]);
            }
            // A margin for rounding.
            reach += 1e-12 * (std::abs(middle) + reach);
            result.low[i] = middle - reach;
            result.high[i] = middle + reach;
        }
        require(is_finite(result.low) && is_finite(result.high),
                "scene: shapes must be of finite size, at a finite place");
        return result;
    }

    std::vector<std::string> objects_;
    std::vector<scene_part> parts_;
    std::vector<scene_surface> surfaces_;
    std::vector<placed_shape> shapes_;
};

/// Adds a copy of a model, which shares its shapes: its objects with their parts and surfaces under
/// their names, with the next free numbers, and its openings. The model may be the scene itself.
/// O(model).
/// @param at  the pose of the model's frame in the scene
/// @return the number of the first added object, the others follow; `nothing` for a model without
///         objects
/// @throws std::invalid_argument  if the pose is no rigid motion, or moves a shape out of the range
///                                of finite numbers; the scene stays as it is
inline std::int32_t add(scene& world, const scene& model, const pose& at = {}) {
    return world.append(model, model.objects_, false, at);
}

/// Adds a copy of a model, as above, as a single object with the parts of all objects of the model.
/// @return the number of the object
inline std::int32_t add(scene& world, std::string name, const scene& model, const pose& at = {}) {
    return world.append(model, {std::move(name)}, true, at);
}

}  // namespace gnomon::simulation
