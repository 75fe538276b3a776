#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# Installs what is missing, builds everything in build/release, and runs all tests:
#     sh tests/run.sh [options of ctest]
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
. "$root/tools/setup.sh"
# shellcheck disable=SC2086  # lists of words
set_up $build_packages $example_packages libgtest-dev python3 ccache codespell pkgconf \
    -- clang-format-16

cd "$root"
jobs=$(getconf _NPROCESSORS_ONLN)
cmake --preset release -D GNOMON_BUILD_TESTS=ON -D GNOMON_BUILD_EXAMPLES=ON \
    -D CMAKE_COMPILE_WARNING_AS_ERROR=ON
cmake --build --preset release --target all all_verify_interface_header_sets

status=0
ctest --preset release -j "$jobs" "$@" || status=$?

log=build/release/Testing/Temporary/LastTest.log
echo "$(grep -c 'needs shared data' $log) tests passed over because shared data is missing"
exit $status
