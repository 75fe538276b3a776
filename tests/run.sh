#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# Installs what is missing, builds the library's tests and examples in build/release, and runs all
# tests but those of the benchmarks:
#     sh tests/run.sh [options of ctest]      or only the first part:  sh tests/run.sh --set-up-only
#     sh tests/run.sh --benchmarks [...]      the programs of benchmarks/, each in a hurry; but what is
#                                             around libraries not installed here, which
#                                             benchmarks/reproduce.sh builds
#     sh tests/run.sh --matrix [...]          other compilers and platforms: tests/matrix.sh
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
configure() {
    cmake --preset release -D GNOMON_BUILD_TESTS=ON -D GNOMON_BUILD_EXAMPLES=ON \
        -D CMAKE_COMPILE_WARNING_AS_ERROR=ON "$@"
}
if [ "${1-}" = --benchmarks ]; then
    shift
    configure -D GNOMON_BUILD_BENCHMARKS=ON
    cmake --build --preset release --target benchmarks
    exec ctest --preset release -j "$jobs" -L benchmark "$@"
fi
configure -D GNOMON_BUILD_BENCHMARKS=OFF
cmake --build --preset release --target all all_verify_interface_header_sets

status=0
ctest --preset release -j "$jobs" "$@" || status=$?

passed_over=$(grep -c 'needs shared data' build/release/Testing/Temporary/LastTest.log || true)
if [ "$passed_over" -gt 0 ]; then
    echo "$passed_over tests passed over because shared data is missing"
fi
exit $status
