#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# Installs what is missing, builds everything in build/release (but what is around libraries not
# installed here, which benchmarks/reproduce.sh builds), and runs all tests:
#     sh tests/run.sh [options of ctest]      or only the first part:  sh tests/run.sh --set-up-only
# With --matrix, only what tests/matrix.sh does: other compilers and platforms.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
if [ "${1-}" = --matrix ]; then
    shift
    exec sh "$root/tests/matrix.sh" "$@"
fi
. "$root/tools/setup.sh"
# shellcheck disable=SC2086  # lists of words
set_up $build_packages $example_packages libgtest-dev libbenchmark-dev libcgal-dev python3 \
    ccache codespell pkgconf universal-ctags valgrind -- clang-format-16 libembree-dev \
    doxygen doxygen-awesome-css
if [ "${1-}" = --set-up-only ]; then exit 0; fi

cd "$root"
jobs=$(getconf _NPROCESSORS_ONLN)
cmake --preset release -D GNOMON_BUILD_TESTS=ON -D GNOMON_BUILD_EXAMPLES=ON -D GNOMON_BUILD_BENCHMARKS=ON \
    -D CMAKE_COMPILE_WARNING_AS_ERROR=ON
cmake --build --preset release --target all all_verify_interface_header_sets

status=0
ctest --preset release -j "$jobs" "$@" || status=$?

passed_over=$(grep -c 'needs shared data' build/release/Testing/Temporary/LastTest.log || true)
if [ "$passed_over" -gt 0 ]; then
    echo "$passed_over tests passed over because shared data is missing"
fi
exit $status
