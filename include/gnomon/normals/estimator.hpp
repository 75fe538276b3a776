// SPDX-License-Identifier: BSL-1.0
/// @file
/// What the surface is at a point: the concept of this floor.
///
/// An *estimator* is called with a point and the ring of its neighbors and returns what it finds: a
/// struct with members `normal` and `trust` (and whatever the method gives for free), or, if you
/// are in a hurry, a bare 3-vector. A lambda will do. Three refinements:
/// - a *ray estimator* takes the view point as third argument, since it reasons about rays;
/// - a *moment estimator* needs no more than the `moments` of the ring about the point;
/// - a *cyclic estimator* reads its ring as a fan of triangles, so that the order matters.
///
/// Laws, checked in tests/laws/estimator_laws.hpp for every model: a usable normal has unit length,
/// an unusable one is zero; the result does not depend on the order of the ring, nor on where cloud
/// and view point lie or how large the cloud is, and turns with them up to its sign. A model that
/// breaks one of these by its nature says so in a member `static constexpr sensitivity
/// sensitive_to`.
///
/// Models: `plane_svd`, `plane_pca`, `vector_svd`, `vector_pca`, `quad_svd`, `quad_trans_svd`,
/// `area_weighted`, `angle_weighted`, `plane_ekf` of the thesis; `ray_ls` and others beyond it, see
/// normals/registry.hpp; and any lambda of yours.
#pragma once

#include <concepts>
#include <span>
#include <type_traits>

#include <Eigen/Core>

#include <gnomon/core/moments.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/trust.hpp>

namespace gnomon {

/// The positions [m] of a point's neighbors, in the order of the graph and without the point.
class ring_view : public std::span<const Eigen::Vector3d> {
  public:
    using std::span<const Eigen::Vector3d>::span;

    explicit(false) ring_view(std::span<const Eigen::Vector3d> positions, bool open = false)
        : std::span<const Eigen::Vector3d>(positions), open_(open) {}

    /// Whether the fan of neighbors ends at a boundary: last and first are then no pair.
    [[nodiscard]] bool open() const { return open_; }

  private:
    bool open_ = false;
};

/// The least an estimate must tell.
template <class T>
concept normal_estimate = std::default_initializable<T> && requires(T& estimate) {
    { estimate.normal } -> std::same_as<Eigen::Vector3d&>;
    { estimate.trust } -> std::same_as<trust&>;
};

/// No more than that: of methods that give nothing else for free, and of bare vectors, which the
/// driver normalises.
struct normal_fit {
    Eigen::Vector3d normal{0.0, 0.0, 0.0};  ///< unit length, or zero if not usable
    gnomon::trust trust = gnomon::trust::too_few_neighbors;
};

namespace detail {

template <class E>
concept takes_ring = std::invocable<const E&, const Eigen::Vector3d&, ring_view>;
template <class E>
concept takes_viewpoint =
    std::invocable<const E&, const Eigen::Vector3d&, ring_view, const Eigen::Vector3d&>;

template <class E>
struct result_of {};
template <class E>
    requires(takes_ring<E> && !takes_viewpoint<E>)
struct result_of<E> : std::invoke_result<const E&, const Eigen::Vector3d&, ring_view> {};
template <takes_viewpoint E>
struct result_of<E>
    : std::invoke_result<const E&, const Eigen::Vector3d&, ring_view, const Eigen::Vector3d&> {};

/// Whether a vector is a value: an Eigen block, map or expression refers to what may be gone.
template <class T>
concept owns_its_coordinates =
    !requires { typename T::PlainObject; } || std::same_as<typename T::PlainObject, T>;

template <class T>
concept gives_normal = normal_estimate<T> || (point<T> && owns_its_coordinates<T>);

}  // namespace detail

/// What e(point, ring) or e(point, ring, viewpoint) gives.
template <class E>
using estimator_result_t = std::remove_cvref_t<typename detail::result_of<E>::type>;

/// e(point, ring) or e(point, ring, viewpoint) gives a `normal_estimate` or a bare 3-vector. Const
/// and thread-safe. The vector is a value, not an Eigen expression or block, which would refer to
/// what is gone when e returns: let lambdas say `-> Eigen::Vector3d`.
template <class E>
concept estimator = detail::gives_normal<estimator_result_t<E>>;

/// Is told from where the point was seen [m]: the origin where no view point is known.
template <class E>
concept ray_estimator = estimator<E> && detail::takes_viewpoint<E>;

/// Gives the same from the moments of the neighbors about the point, so that a search can sum up
/// neighbors without listing them.
template <class E>
concept moment_estimator = estimator<E> && requires(const E& estimate, const moments& m) {
    { estimate(m) } -> std::same_as<estimator_result_t<E>>;
};

/// Gives the same but for rounding from the moments of many neighborhoods, at once and therefore
/// faster: estimate(moments, results), both spans of one size.
template <class E>
concept batch_estimator =
    moment_estimator<E> &&
    requires(const E& estimate, std::span<const moments> m,
             std::span<estimator_result_t<E>> results) { estimate(m, results); };

/// Reads its ring as a fan: says `static constexpr bool reads_fan = true`. Meant for rings in
/// angular order, which `delaunay` and `sorted_around` give.
template <class E>
concept cyclic_estimator = estimator<E> && E::reads_fan;

/// What a normal may depend on besides the shape of its neighborhood; a set of flags.
enum class sensitivity : unsigned {
    none = 0,
    order = 1,  ///< of the ring
    units = 2,  ///< the numbers change their meaning unless coordinates are metres
    axes = 4    ///< how the coordinate axes lie
};
[[nodiscard]] constexpr sensitivity operator|(sensitivity a, sensitivity b) {
    return static_cast<sensitivity>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}

/// What the model E says that its normals depend on.
template <class E>
[[nodiscard]] constexpr sensitivity sensitivity_of() {
    if constexpr (requires { E::sensitive_to; }) {
        return E::sensitive_to;
    } else {
        return sensitivity::none;
    }
}

/// Whether `what` is among that.
template <class E>
[[nodiscard]] constexpr bool is_sensitive_to(sensitivity what) {
    return (static_cast<unsigned>(sensitivity_of<E>()) & static_cast<unsigned>(what)) != 0;
}

/// The type that an estimator's results are kept in.
template <estimator E>
using estimate_t =
    std::conditional_t<normal_estimate<estimator_result_t<E>>, estimator_result_t<E>, normal_fit>;

}  // namespace gnomon
