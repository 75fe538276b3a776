// SPDX-License-Identifier: BSL-1.0
/// @file
/// What the surface is at a point: the concept of this floor.
///
/// An *estimator* is called with a point and the ring of its neighbors and returns what it finds: a
/// struct with members `normal` and `trust` (and whatever the method gives for free), or, if you
/// are in a hurry, a bare 3-vector. A lambda will do.
///
/// Laws, checked in tests/laws/estimator_laws.hpp for every model: a usable normal has unit length,
/// an unusable one is zero; the result does not depend on the order of the ring, nor on where the
/// cloud lies or how large it is, and turns with the cloud up to its sign.
///
/// Models: `plane_pca`, and any lambda of yours.
#pragma once

#include <concepts>
#include <span>
#include <type_traits>

#include <Eigen/Core>

#include <gnomon/core/point.hpp>
#include <gnomon/core/trust.hpp>

namespace gnomon {

/// The positions [m] of a point's neighbors, in the order of the graph and without the point.
using ring_view = std::span<const Eigen::Vector3d>;

/// The least an estimate must tell.
template <class T>
concept normal_estimate = std::default_initializable<T> && requires(T& estimate) {
    { estimate.normal } -> std::same_as<Eigen::Vector3d&>;
    { estimate.trust } -> std::same_as<trust&>;
};

/// What e(point, ring) gives.
template <class E>
using estimator_result_t =
    std::remove_cvref_t<std::invoke_result_t<const E&, const Eigen::Vector3d&, ring_view>>;

/// e(point, ring) gives a `normal_estimate` or a bare 3-vector. Const and thread-safe. The vector
/// is a value, not an Eigen expression, which would refer to what is gone when e returns: let
/// lambdas say `-> Eigen::Vector3d`.
template <class E>
concept estimator = std::invocable<const E&, const Eigen::Vector3d&, ring_view> &&
                    (normal_estimate<estimator_result_t<E>> || point<estimator_result_t<E>>);

/// What the driver makes of a bare vector: normalised, with a trust that tells whether it could be.
struct bare_estimate {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    gnomon::trust trust = gnomon::trust::degenerate;
};

/// The type that an estimator's results are kept in.
template <estimator E>
using estimate_t = std::conditional_t<normal_estimate<estimator_result_t<E>>, estimator_result_t<E>,
                                      bare_estimate>;

}  // namespace gnomon
