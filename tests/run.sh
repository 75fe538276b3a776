#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# Installs what is missing, builds the library's tests and examples in build/release, and runs all
# tests but those of the benchmarks:
#     sh tests/run.sh [options of ctest]      or only the first part:  sh tests/run.sh --set-up-only
#     sh tests/run.sh --quick                 in less than five minutes, without presets (CMake 3.22): the
#                                             tests of four floors and one example, optimised little;
#                                             ends with what it leaves out
#     sh tests/run.sh --benchmarks [...]      the programs of benchmarks/, each in a hurry; but what is
#                                             around libraries not installed here, which
#                                             benchmarks/reproduce.sh builds
#     sh tests/run.sh --matrix [...]          other compilers and platforms: tests/matrix.sh
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
. "$root/tools/setup.sh"
if [ "${1-}" = --help ]; then
    print_head "$0"
    exit 0
fi
if [ "${1-}" = --matrix ]; then
    shift
    exec sh "$root/tests/matrix.sh" "$@"
fi
# shellcheck disable=SC2086  # lists of words
set_up $build_packages $example_packages libgtest-dev libbenchmark-dev libcgal-dev python3 \
    python3-matplotlib ccache codespell make pkgconf universal-ctags valgrind -- clang-format-16 libembree-dev \
    doxygen doxygen-awesome-css
if [ "${1-}" = --set-up-only ]; then exit 0; fi

cd "$root"
jobs=$(getconf _NPROCESSORS_ONLN)
if [ "${1-}" = --quick ]; then
    build=build/quick example=quick_start
    . tests/floors.sh
    floors_of core io neighborhoods segmentation
    # One source per floor, so that what its tests share is compiled once.
    cmake -S . -B $build -G Ninja -D CMAKE_BUILD_TYPE=Debug -D CMAKE_CXX_FLAGS_DEBUG=-O1 \
        -D CMAKE_UNITY_BUILD=ON -D CMAKE_UNITY_BUILD_BATCH_SIZE=0 -D GNOMON_TEST_LONG=OFF \
        -D GNOMON_BUILD_TESTS=ON -D GNOMON_BUILD_EXAMPLES=ON -D GNOMON_BUILD_BENCHMARKS=OFF
    # shellcheck disable=SC2086  # a list of words
    cmake --build $build -j "$jobs" --target $targets $example
    status=0
    ctest --test-dir $build --output-on-failure -j "$jobs" -L "$labels" || status=$?
    ctest --test-dir $build --output-on-failure -R "^example[.]$example\$" || status=$?
    others=$(ls tests/*/*_test.cpp | cut -d / -f 2 | sort -u | grep -vE "$labels" | paste -s -d ' ')
    cat <<END

Left out here, and run by 'sh tests/run.sh': the tests in tests/ of $others;
the search for neighbors by each set of vector instructions, and on large scans; the examples but
$example; what must not compile; that each header can be included alone; style, packaging, optimised
code, and that there are no warnings. Commands of their own: sanitizers (sh tests/sanitize.sh),
benchmarks (sh tests/run.sh --benchmarks), other compilers (sh tests/run.sh --matrix).
END
    exit $status
fi
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
cmake --build --preset release -j "$jobs" --target all headers_alone  # more at once takes more memory

status=0
ctest --preset release -j "$jobs" "$@" || status=$?

passed_over=$(grep -c 'needs shared data' build/release/Testing/Temporary/LastTest.log || true)
if [ "$passed_over" -gt 0 ]; then
    echo "$passed_over tests passed over because shared data is missing"
fi
exit $status
