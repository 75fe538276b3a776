// SPDX-License-Identifier: BSL-1.0
/// @file
/// The laws of the `merge_policy` concept, for any model: yours, too.
#pragma once

#include <array>

#include <gtest/gtest.h>

#include <gnomon/occlusion/merge_policy.hpp>

namespace laws {

inline constexpr std::array observations{
    gnomon::observation::unobserved, gnomon::observation::occluded, gnomon::observation::on_surface,
    gnomon::observation::free_space};

// [policy_is_a_function]
/// The answer depends on the observation alone: not on earlier calls, nor on which copy is called.
template <gnomon::merge_policy M>
void policy_is_a_function(const M& policy) {
    const M copy = policy;
    for (const auto first : observations) {
        const bool answer = policy(first);
        for (const auto second : observations) (void)static_cast<bool>(policy(second));
        ASSERT_EQ(static_cast<bool>(policy(first)), answer);
        ASSERT_EQ(static_cast<bool>(copy(first)), answer);
    }
}
// [policy_is_a_function]

// [free_space_is_the_strongest_objection]
/// A policy that merges where a place of the gap is seen to be empty merges whatever is seen.
template <gnomon::merge_policy M>
void free_space_is_the_strongest_objection(const M& policy) {
    if (!policy(gnomon::observation::free_space)) return;
    for (const auto seen : observations) ASSERT_TRUE(policy(seen));
}
// [free_space_is_the_strongest_objection]

template <gnomon::merge_policy M>
void merge_policy_laws(const M& policy) {
    policy_is_a_function(policy);
    free_space_is_the_strongest_objection(policy);
}

}  // namespace laws
