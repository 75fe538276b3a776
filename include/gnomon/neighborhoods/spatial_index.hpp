// SPDX-License-Identifier: BSL-1.0
/// @file
/// An index over points, as a value: built once, owned by the caller, and given to every algorithm
/// in place of the points. It answers which points are the k nearest to a position, which are
/// within a radius, or both, among all points or a subset.
///
///     const gnomon::spatial_index index(scan, gnomon::threads{});
///     auto surface = gnomon::estimate_normals(index, gnomon::knn{.k = 30});
///     for (const gnomon::neighbor& q : index.within(position, 0.05)) ...
///
/// The index is a kd-tree whose leaves hold 32 points (Klasing 2010, App. A.1). By default
/// answers are exact and unique, ties broken by the index of the point; see `search_options`.
#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/assigned_whole.hpp>
#include <gnomon/core/detail/exceptions.hpp>
#include <gnomon/core/detail/index_iterator.hpp>
#include <gnomon/core/detail/made_when_asked.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/neighborhoods/detail/index_queries.hpp>
#include <gnomon/neighborhoods/detail/leaf_tree.hpp>
#include <gnomon/neighborhoods/detail/place_set.hpp>

namespace gnomon {

namespace detail {
class indexed_subset;
}

/// Models `point_range` and `has_viewpoints`: stands for the points that it was built from, in
/// their order. Copies their positions in double (about 35 bytes a point, 67 after rebuild(),
/// which keeps its working memory) and their view points, so that the points may be destroyed.
/// Points that are not finite are counted, and never found. A value: copies are independent.
/// Queries are const and thread-safe.
class spatial_index : public detail::index_queries<spatial_index> {
  public:
    /// Those of the points.
    viewpoint_table viewpoints;

    /// Of no points. So is an index that was moved from.
    spatial_index() = default;

    /// @param points  any point range of n points [m]
    /// @throws std::invalid_argument  if the view points are for another number of points, or for
    ///                                2^32 - 1 points or more
    /// Complexity: O(n log n), on as many threads as `run` has. The same bytes for every execution.
    template <class R, execution X = sequential, class Proj = std::identity>
        requires point_range<R, Proj> && (!std::same_as<R, spatial_index>)
    explicit spatial_index(const R& points, const X& run = {}, Proj projection = {}) {
        rebuild(points, run, std::move(projection));
        tree_.release_scratch();
    }

    /// Makes this the index of no points; keeps the memory of the tree.
    void clear() {
        tree_.clear();
        viewpoints = {};
        kept.forget();
    }

    /// Replaces the points, in the memory of the index; allocates only to grow. If this throws, the
    /// index is of no points. Precondition: `points` does not refer to this index.
    /// Errors and complexity: those of the constructor.
    template <class R, execution X = sequential, class Proj = std::identity>
        requires point_range<R, Proj> && (!std::same_as<R, spatial_index>)
    void rebuild(const R& points, const X& run = {}, Proj projection = {}) {
        using view = position_view<R, Proj>;
        kept.forget();
        GNOMON_TRY {
            detail::with_table_of(points, [this](auto&& table) {
                viewpoints = std::forward<decltype(table)>(table);
            });
            epsilon_ = detail::epsilon_of<view>(points);
            tree_.rebuild(view(points, std::move(projection)), run);
        }
        GNOMON_CATCH {
            clear();
            GNOMON_RETHROW;
        }
    }

    /// The number of points, finite or not.
    [[nodiscard]] std::size_t size() const { return tree_.points(); }
    /// The number of finite points, which are those that queries find.
    [[nodiscard]] std::size_t finite() const { return tree_.size(); }
    /// Whether point i is finite, so that queries find it. Precondition: i < size().
    [[nodiscard]] bool is_finite(std::size_t i) const {
        return tree_.place_of(i) != detail::leaf_tree::no_place;
    }
    /// The position of point i [m]; NaN if it was not finite. Precondition: i < size().
    [[nodiscard]] Eigen::Vector3d operator[](std::size_t i) const {
        const point_index place = tree_.place_of(i);
        if (place == detail::leaf_tree::no_place) {
            constexpr double nan = std::numeric_limits<double>::quiet_NaN();
            return {nan, nan, nan};
        }
        const auto p = tree_.position(place);
        return {p[0], p[1], p[2]};
    }
    [[nodiscard]] auto begin() const { return detail::index_iterator(this, 0); }
    [[nodiscard]] auto end() const {
        return detail::index_iterator(this, static_cast<std::ptrdiff_t>(size()));
    }

    /// The machine epsilon of the numbers that the points came in: float or double.
    [[nodiscard]] double epsilon() const { return epsilon_; }

    /// The same queries, of which only these points are answers. Refers to the index; O(n / 32 + m)
    /// for m indices.
    /// @throws std::invalid_argument  for an index out of range
    [[nodiscard]] detail::indexed_subset subset(std::span<const point_index> indices) const&;
    void subset(std::span<const point_index> indices) && = delete;

    /// The tree, for algorithms that search for many points at once.
    [[nodiscard]] const detail::leaf_tree& tree() const { return tree_; }
    /// What algorithms derive from the points and keep here: see detail/across_lines.hpp.
    detail::made_when_asked kept;

  private:
    friend class detail::index_queries<spatial_index>;
    [[nodiscard]] static const detail::place_set* places() { return nullptr; }

    detail::assigned_whole<detail::leaf_tree> tree_;
    double epsilon_ = std::numeric_limits<double>::epsilon();
};

namespace detail {

/// The queries of an index among some of its points; neighbors keep their index in the cloud.
/// Refers to the index.
class indexed_subset : public index_queries<indexed_subset> {
  public:
    /// The finite ones among the points of these indices.
    /// @throws std::invalid_argument  for an index out of range
    indexed_subset(const spatial_index& index, std::span<const point_index> indices)
        : tree_(&index.tree()), places_(places_of(index.tree(), indices)) {}

    /// The number of points that queries find.
    [[nodiscard]] std::size_t size() const { return places_.size(); }

  private:
    friend class index_queries<indexed_subset>;
    [[nodiscard]] const leaf_tree& tree() const { return *tree_; }
    [[nodiscard]] const place_set* places() const { return &places_; }

    /// In memory of its own, whatever pool is current: a subset may be kept longer than the pool.
    [[nodiscard]] static place_set places_of(const leaf_tree& tree,
                                             std::span<const point_index> indices) {
        const pool_scope no_pool(nullptr);
        return {tree, indices};
    }

    const leaf_tree* tree_;
    place_set places_;
};

}  // namespace detail

inline detail::indexed_subset spatial_index::subset(std::span<const point_index> indices) const& {
    return {*this, indices};
}

namespace detail {

/// The index itself, which view points of another scan may have been assigned to.
/// @throws std::invalid_argument  if they are for another number of points
inline const spatial_index& checked(const spatial_index& index) {
    require(index.viewpoints.covers(index.size()),
            "the view points are for another number of points");
    return index;
}

/// The index itself, or one that is built of the points.
template <class R, execution X, class Proj>
[[nodiscard]] decltype(auto) index_of(const R& points, const X& run, const Proj& projection) {
    if constexpr (std::same_as<R, spatial_index> && std::same_as<Proj, std::identity>) {
        return checked(points);
    } else {
        return spatial_index(points, run, projection);
    }
}

}  // namespace detail
}  // namespace gnomon
