// SPDX-License-Identifier: BSL-1.0
/// @file
/// What descriptors read of their neighbors in addition to positions: normals, or densities.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include <Eigen/Core>

#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/features/descriptor.hpp>
#include <gnomon/neighborhoods/detail/leaf_balls.hpp>
#include <gnomon/neighborhoods/detail/leaf_sweep.hpp>
#include <gnomon/neighborhoods/detail/leaf_tree.hpp>

namespace gnomon::detail {

/// The unit vector along a normal; zero if it is missing, infinite or NaN.
[[nodiscard]] inline Eigen::Vector3d unit_normal(const Eigen::Vector3d& normal) {
    if (is_missing(normal) || !all_finite(normal)) return {0.0, 0.0, 0.0};
    return direction_of(normal);
}

/// For all points of a tree, by their places: unit normals, numbers of points within a radius, or
/// nothing, as the descriptor requires. O(n), and a sweep for densities.
template <descriptor D>
class neighbor_extras {
  public:
    /// Whether the descriptor has a fifth parameter.
    static constexpr bool any = reads_normals<D> || reads_densities<D>;

    template <execution X>
    neighbor_extras(const leaf_tree& tree, const auto& surface, const D& describe, const X& run) {
        if constexpr (reads_normals<D>) {
            values_.resize(tree.size());
            for_each_chunk(run, tree.size(), [&](std::size_t begin, std::size_t end) {
                for (std::size_t place = begin; place < end; ++place)
                    values_[place] = unit_normal(surface[tree.index()[place]].normal);
            });
        } else if constexpr (reads_densities<D>) {
            const double r = describe.density_radius;
            if (!(r > 0.0)) return;
            values_.resize(tree.size());
            const auto make_search = [r](const auto& of) {
                return leaf_balls(of, [r](std::size_t) { return r; });
            };
            search_all_groups(tree, run, make_search, [this] {
                return [this](std::size_t place, std::span<const std::uint32_t> places) {
                    values_[place] = static_cast<double>(places.size() + 1);
                };
            });
        }
    }

    using value = std::conditional_t<reads_normals<D>, Eigen::Vector3d, double>;

    /// Those of the neighbors at some places, in a buffer; empty if the descriptor reads none.
    [[nodiscard]] std::span<const value> at(std::span<const std::uint32_t> places,
                                            scratch<value>& buffer) const {
        buffer.clear();
        if (!values_.empty())
            for (const std::uint32_t place : places) buffer.push_back(values_[place]);
        return buffer;
    }

  private:
    scratch<value> values_;
};

}  // namespace gnomon::detail
