// SPDX-License-Identifier: BSL-1.0
/// @file
/// A shape without its type, so that a scene can hold shapes of all types.
#pragma once

#include <optional>
#include <utility>

#include <gnomon/simulation/bounds.hpp>
#include <gnomon/simulation/polyhedron.hpp>
#include <gnomon/simulation/ray.hpp>
#include <gnomon/simulation/shape.hpp>

namespace gnomon::simulation::detail {

/// A type-erased shape.
class any_shape {
  public:
    any_shape() = default;
    any_shape(const any_shape&) = delete;
    any_shape& operator=(const any_shape&) = delete;
    virtual ~any_shape() = default;

    /// In the shape's own frame [m].
    [[nodiscard]] virtual bounds extent() const = 0;
    [[nodiscard]] virtual std::optional<ray_hit> first_hit(const ray& r) const = 0;
    /// The triangles of the shape, if its faces are planar.
    [[nodiscard]] virtual std::optional<polyhedron> triangles() const = 0;
};

template <shape S>
class any_shape_of final : public any_shape {
  public:
    explicit any_shape_of(S shape) : shape_(std::move(shape)) {}

    [[nodiscard]] bounds extent() const override { return shape_.extent(); }
    [[nodiscard]] std::optional<ray_hit> first_hit(const ray& r) const override {
        return shape_.first_hit(r);
    }
    [[nodiscard]] std::optional<polyhedron> triangles() const override {
        if constexpr (flat_shape<S>)
            return shape_.triangles();
        else
            return std::nullopt;
    }

  private:
    S shape_;
};

}  // namespace gnomon::simulation::detail
