#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# Runs the tests with assertions under the address, undefined-behaviour and thread sanitizers, in
# build/dev and build/tsan:
#     sh tests/sanitize.sh             all of them, against the single header; takes an hour on two cores
#     sh tests/sanitize.sh FLOOR...    those of some floors, e.g. core io
# The thread sanitizer runs only those of core, which has all that threads share.
set -eu
. "$(dirname "$0")/../tools/setup.sh"
if [ "${1-}" = --help ]; then
    print_head "$0"
    exit 0
fi
cd "$(dirname "$0")/.."
sh tests/run.sh --set-up-only
jobs=$(getconf _NPROCESSORS_ONLN)

if [ $# -eq 0 ]; then
    cmake --preset dev -D GNOMON_TEST_SINGLE_HEADER=ON
    cmake --build --preset dev
    ctest --preset dev -j "$jobs" --progress
else
    . tests/floors.sh
    floors_of "$@"
    cmake --preset dev
    # shellcheck disable=SC2086  # a list of words
    cmake --build --preset dev --target $targets
    ctest --preset dev -j "$jobs" --progress -L "$labels"
fi

fixed_addresses=''  # older sanitizers stumble over much address randomisation
if setarch -R true 2>/dev/null; then fixed_addresses='setarch -R'; fi
cmake --preset tsan
cmake --build --preset tsan --target core_tests
$fixed_addresses ctest --preset tsan -j "$jobs" --progress -L '^core$'
