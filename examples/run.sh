#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# Installs what is missing, builds the example segment_scan, and segments a scan:
#     sh examples/run.sh [SCAN] [--out DIR]
# The options are those of segment_scan; without --out, results go to segment_scan_out.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
. "$root/tools/setup.sh"
# shellcheck disable=SC2086  # lists of words
set_up $build_packages $example_packages

# A build directory that is there is taken as it is, tests and all; a new one is made without
# tests, and without calling warnings errors: a newer compiler may have new ones.
(
    cd "$root"
    if [ -f build/release/CMakeCache.txt ]; then
        cmake --preset release -D GNOMON_BUILD_EXAMPLES=ON
    else
        cmake --preset release -D GNOMON_BUILD_TESTS=OFF -D CMAKE_COMPILE_WARNING_AS_ERROR=OFF
    fi
    cmake --build --preset release --target segment_scan
)

out_given=false
for argument in "$@"; do
    case $argument in
        --out | --out=*) out_given=true ;;
    esac
done
$out_given || set -- "$@" --out segment_scan_out

# Called from where the user stands, so that relative paths mean what they say.
exec "$root/build/release/examples/segment_scan" "$@"
