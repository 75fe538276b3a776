// SPDX-License-Identifier: BSL-1.0
/// @file
/// From where each point was seen (Klasing 2010, Sec. 2.4.1: every point keeps its view point).
/// View points are data that travel with the points: one for the whole cloud, one per scan of a
/// registered cloud, or one per point of a moving scanner.
#pragma once

#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/reset_on_move.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>

namespace gnomon {

/// The view point of every point of a cloud. A value that does not change.
class viewpoint_table {
  public:
    /// None known: the origin of the sensor frame stands for all.
    viewpoint_table() = default;

    /// One view point [m] for the whole cloud.
    explicit(false) viewpoint_table(const Eigen::Vector3d& viewpoint)
        : positions_{viewpoint}, scope_(scope::cloud), number_(next_number()) {}

    /// One view point [m] per point, in the points' order.
    explicit viewpoint_table(std::vector<Eigen::Vector3d> per_point)
        : positions_(std::move(per_point)), scope_(scope::point), number_(next_number()) {}

    /// One view point [m] per scan, and for each point the number of its scan.
    /// @throws std::invalid_argument  if a number has no scan
    viewpoint_table(std::vector<Eigen::Vector3d> per_scan, std::vector<point_index> scan_of_point)
        : positions_(std::move(per_scan)),
          scan_of_point_(std::move(scan_of_point)),
          scope_(scope::scan),
          number_(next_number()) {
        for (const point_index s : scan_of_point_)
            detail::require(s < positions_.size(), "viewpoint_table: a point of a missing scan");
    }

    /// The same number as that of another table: a copy of it, or as empty.
    [[nodiscard]] std::uint64_t number() const { return number_; }

    /// Whether no view point is known.
    [[nodiscard]] bool empty() const { return positions_.empty(); }

    /// The distinct positions [m]: none, one, one per scan or one per point.
    [[nodiscard]] const std::vector<Eigen::Vector3d>& positions() const { return positions_; }

    /// Whether the table has a view point for each of `points` points: true unless it lists view
    /// points or scans for another number of points.
    [[nodiscard]] bool covers(std::size_t points) const {
        if (scope_ == scope::point) return positions_.size() == points;
        return scope_ != scope::scan || scan_of_point_.size() == points;
    }

    /// The view point of point i [m]; the origin where none is known.
    /// Precondition: covers(n) for the n points of the cloud, and i < n.
    [[nodiscard]] Eigen::Vector3d operator[](std::size_t i) const {
        switch (scope_) {
            case scope::cloud:
                return positions_.front();
            case scope::scan:
                return positions_[scan_of_point_[i]];
            case scope::point:
                return positions_[i];
            case scope::none:
                break;
        }
        return Eigen::Vector3d(0.0, 0.0, 0.0);
    }

    /// The view points of some of the points, in the order of `indices`: one per scan, if they are
    /// here and the scans are fewer than the indices.
    /// Precondition: covers(n) and every index is below n.
    /// @param indices  point_index. (A template, for compile time.)
    [[nodiscard]] viewpoint_table subset(const auto& indices) const {
        if (scope_ == scope::none || scope_ == scope::cloud) return *this;
        if (scope_ == scope::point) return viewpoint_table(chosen(positions_, indices));
        auto scans = chosen(scan_of_point_, indices);
        if (positions_.size() < indices.size())
            return viewpoint_table(positions_, std::move(scans));
        return viewpoint_table(chosen(positions_, scans));
    }

  private:
    enum class scope : char { none, cloud, scan, point };

    [[nodiscard]] static auto chosen(const auto& values, const auto& indices) {
        std::remove_cvref_t<decltype(values)> result;
        result.reserve(indices.size());
        for (const point_index i : indices) result.push_back(values[i]);
        return result;
    }

    [[nodiscard]] static std::uint64_t next_number() {
        static std::atomic<std::uint64_t> last{0};
        return ++last;
    }

    std::vector<Eigen::Vector3d> positions_;
    std::vector<point_index> scan_of_point_;
    detail::reset_on_move<scope> scope_;
    detail::reset_on_move<std::uint64_t> number_;
};

/// A range that knows its view points: a `scan`, or what `with_viewpoint(s)` returns.
template <class R>
concept has_viewpoints = requires(const R& r) {
    { r.viewpoints } -> std::convertible_to<const viewpoint_table&>;
};

namespace detail {

/// f(table), where the table is that of a range, not a copy of it; the empty one (the origin) for a
/// range that knows none.
template <indexed_range R>
[[nodiscard]] auto with_table_of(const R& points, auto&& f) {
    if constexpr (has_viewpoints<R>) {
        const viewpoint_table& table = points.viewpoints;
        require(table.covers(std::ranges::size(points)),
                "the view points are for another number of points");
        return f(table);
    } else {
        return f(viewpoint_table());
    }
}

/// The view points of a range; the empty table (the origin) for a range that knows none.
/// @throws std::invalid_argument  if the table lists view points for another number of points
template <indexed_range R>
[[nodiscard]] viewpoint_table viewpoints_of(const R& points) {
    return with_table_of(points, [](const viewpoint_table& table) { return table; });
}

/// Those of some of its points; see `viewpoint_table::subset`.
/// @throws std::invalid_argument  if the table lists view points for another number of points
template <indexed_range R>
[[nodiscard]] viewpoint_table viewpoints_of(const R& points, std::span<const point_index> indices) {
    return with_table_of(points,
                         [indices](const viewpoint_table& table) { return table.subset(indices); });
}

/// A bare range of points and their view points; refers to the range.
template <detail::indexed_range R>
struct viewed_points {
    const R* range;
    viewpoint_table viewpoints;

    [[nodiscard]] auto begin() const { return std::ranges::begin(*range); }
    [[nodiscard]] auto end() const { return std::ranges::end(*range); }
    [[nodiscard]] std::size_t size() const {
        return static_cast<std::size_t>(std::ranges::size(*range));
    }
    [[nodiscard]] auto epsilon() const
        requires requires { range->epsilon(); }
    {
        return range->epsilon();
    }
};

}  // namespace detail

/// `points`, all seen from `viewpoint` [m].
template <detail::indexed_range R>
[[nodiscard]] detail::viewed_points<R> with_viewpoint(const R& points,
                                                      const Eigen::Vector3d& viewpoint) {
    return {&points, viewpoint};
}

/// `points` with the view points of `table`.
/// @throws std::invalid_argument  if the table lists view points for another number of points
template <detail::indexed_range R>
[[nodiscard]] detail::viewed_points<R> with_viewpoints(const R& points, viewpoint_table table) {
    detail::require(table.covers(static_cast<std::size_t>(std::ranges::size(points))),
                    "with_viewpoints: the table is for another number of points");
    return {&points, std::move(table)};
}

template <detail::indexed_range R>
void with_viewpoint(const R&& points, const Eigen::Vector3d& viewpoint) = delete;
template <detail::indexed_range R>
void with_viewpoints(const R&& points, viewpoint_table table) = delete;

}  // namespace gnomon
