// SPDX-License-Identifier: BSL-1.0
/// @file
/// The concept of a normal estimator, and its refinements.
///
/// An *estimator* is called with a point and the positions of its neighbors. It returns a struct
/// with members `normal` and `trust` (and whatever else the method computes), or only a 3-vector. A
/// lambda is an estimator. Refinements:
/// - a *ray estimator* has the view point as third parameter;
/// - a *moment estimator* can compute its result from the `moments` of the neighbors alone;
/// - a *batch estimator* can do so for several neighborhoods at once;
/// - a *cyclic estimator* interprets its neighbors as a fan of triangles, so that their order
///   matters.
///
/// Laws, checked in tests/laws/estimator_laws.hpp for every model: a usable normal has unit length
/// and an unusable one is zero; the result is invariant to permutations of the neighbors and to
/// translation and scaling of neighbors and view point; it is equivariant to their rotation up to
/// its sign; a covariance has no eigenvalue above (pi/2)^2. A model that does not satisfy one of
/// the invariances declares this in a member `static constexpr sensitivity sensitive_to`.
///
/// Models: `plane_svd`, `plane_pca`, `vector_svd`, `vector_pca`, `quad_svd`, `quad_trans_svd`,
/// `area_weighted`, `angle_weighted`, `plane_ekf` of the thesis; `ray_ls` and others beyond it, see
/// normals/registry.hpp; lambdas.
#pragma once

#include <concepts>
#include <span>
#include <type_traits>

#include <Eigen/Core>

#include <gnomon/core/moments.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/trust.hpp>

namespace gnomon {

/// The positions [m] of the neighbors of a point, in the order of the graph and without the point.
class neighborhood_view : public std::span<const Eigen::Vector3d> {
  public:
    using std::span<const Eigen::Vector3d>::span;

    /// @param open  whether the fan ends at a boundary
    explicit(false) neighborhood_view(std::span<const Eigen::Vector3d> positions, bool open = false)
        : std::span<const Eigen::Vector3d>(positions), open_(open) {}

    /// Whether the fan of neighbors ends at a boundary: the last and the first neighbor then form
    /// no triangle.
    [[nodiscard]] bool open() const { return open_; }

  private:
    bool open_ = false;
};

/// The members that every estimate has.
template <class T>
concept normal_estimate = std::default_initializable<T> && requires(T& estimate) {
    { estimate.normal } -> std::same_as<Eigen::Vector3d&>;
    { estimate.trust } -> std::same_as<trust&>;
};

/// An estimate with these members only: of methods that compute nothing else, and of estimators
/// that return a 3-vector, which `estimate_normals` normalizes.
struct normal_fit {
    Eigen::Vector3d normal{0.0, 0.0, 0.0};                   ///< unit length, or zero if not usable
    gnomon::trust trust = gnomon::trust::too_few_neighbors;  ///< why there is a normal, or none
};

namespace detail {

template <class E>
concept takes_neighborhood = std::invocable<const E&, const Eigen::Vector3d&, neighborhood_view>;
template <class E>
concept takes_viewpoint =
    std::invocable<const E&, const Eigen::Vector3d&, neighborhood_view, const Eigen::Vector3d&>;

template <class E>
struct result_of {};
template <class E>
    requires(takes_neighborhood<E> && !takes_viewpoint<E>)
struct result_of<E> : std::invoke_result<const E&, const Eigen::Vector3d&, neighborhood_view> {};
template <takes_viewpoint E>
struct result_of<E> : std::invoke_result<const E&, const Eigen::Vector3d&, neighborhood_view,
                                         const Eigen::Vector3d&> {};

/// Whether a vector is a value: an Eigen block, map or expression refers to other objects, which
/// may be destroyed.
template <class T>
concept owns_its_coordinates =
    !requires { typename T::PlainObject; } || std::same_as<typename T::PlainObject, T>;

template <class T>
concept gives_normal = normal_estimate<T> || (point<T> && owns_its_coordinates<T>);

/// The type of e(point, neighbors) or e(point, neighbors, viewpoint).
template <class E>
using estimator_result_t = std::remove_cvref_t<typename result_of<E>::type>;

}  // namespace detail

/// e(point, neighbors) or e(point, neighbors, viewpoint) returns a `normal_estimate` or a 3-vector.
/// Const and thread-safe. The vector is a value, not an Eigen expression or block, which would
/// refer to local variables of e: declare lambdas with `-> Eigen::Vector3d`.
template <class E>
concept estimator = detail::gives_normal<detail::estimator_result_t<E>>;

/// An estimator with the view point of the point [m] as third parameter; it is the origin where no
/// view point is known.
template <class E>
concept ray_estimator = estimator<E> && detail::takes_viewpoint<E>;

/// An estimator that computes the same result from the moments of the neighbors about the point, so
/// that a search can sum them without a list of neighbors.
template <class E>
concept moment_estimator = estimator<E> && requires(const E& estimate, const moments& m) {
    { estimate(m) } -> std::same_as<detail::estimator_result_t<E>>;
};

/// A moment estimator that computes the results of several neighborhoods at once, equal up to
/// rounding and faster: estimate(moments, results), two spans of equal size.
template <class E>
concept batch_estimator =
    moment_estimator<E> &&
    requires(const E& estimate, std::span<const moments> m,
             std::span<detail::estimator_result_t<E>> results) { estimate(m, results); };

/// An estimator that interprets its neighbors as a fan of triangles, declared by `static constexpr
/// bool reads_fan = true`. It requires neighbors in angular order, as from `delaunay` and
/// `angularly_sorted`.
template <class E>
concept cyclic_estimator = estimator<E> && E::reads_fan;

/// Properties of the input, other than the shape of the neighborhood, that a normal depends on; a
/// set of flags.
enum class sensitivity : unsigned {
    none = 0,
    order = 1,  ///< of the neighbors
    units = 2,  ///< of length: parameters are in metres, or the method is not invariant to scaling
    axes = 4    ///< the directions of the coordinate axes
};
/// The flags of both.
[[nodiscard]] constexpr sensitivity operator|(sensitivity a, sensitivity b) {
    return static_cast<sensitivity>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}

namespace detail {

/// The flags that the model E declares.
template <class E>
[[nodiscard]] constexpr sensitivity sensitivity_of() {
    if constexpr (requires { E::sensitive_to; }) {
        return E::sensitive_to;
    } else {
        return sensitivity::none;
    }
}

/// Whether `what` is among the flags that E declares.
template <class E>
[[nodiscard]] constexpr bool is_sensitive_to(sensitivity what) {
    return (static_cast<unsigned>(sensitivity_of<E>()) & static_cast<unsigned>(what)) != 0;
}

}  // namespace detail

/// The type in which the results of an estimator are stored: a `normal_estimate`.
template <estimator E>
using estimate_t = std::conditional_t<normal_estimate<detail::estimator_result_t<E>>,
                                      detail::estimator_result_t<E>, normal_fit>;

}  // namespace gnomon
