# SPDX-License-Identifier: BSL-1.0
# The Eigen of the system in place of vcpkg's, so that the test needs no network.
set(VCPKG_POLICY_EMPTY_PACKAGE enabled)
