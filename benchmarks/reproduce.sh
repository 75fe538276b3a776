#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# Measures on this machine, and makes a page of results from that:
#     sh benchmarks/reproduce.sh TARGET [--quick] [--out DIR]
# Each TARGET is a folder here with a make.sh, and a target of CMake that builds what it needs. The
# page goes to DIR, which without --out is docs/results; --quick measures less, to try it out.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)

print_usage() {
    echo "usage: benchmarks/reproduce.sh TARGET [--quick] [--out DIR]"
    for make in "$root"/benchmarks/*/make.sh; do
        echo "TARGET: $(basename "$(dirname "$make")")"
    done
}
usage() {
    print_usage >&2
    exit 2
}

target='' quick='' out=$root/docs/results
while [ $# -gt 0 ]; do
    case $1 in
        --help) print_usage; exit 0 ;;
        --quick) quick=--quick ;;
        --out) [ $# -ge 2 ] || usage; out=$2; shift ;;
        --out=*) out=${1#--out=} ;;
        -* | '' | */*) usage ;;
        *) [ -z "$target" ] || usage; target=$1 ;;
    esac
    shift
done
[ -n "$target" ] && [ -n "$out" ] && [ -f "$root/benchmarks/$target/make.sh" ] || usage

. "$root/tools/setup.sh"
# shellcheck disable=SC2086  # a list of words
set_up $build_packages libbenchmark-dev libstb-dev fonts-dejavu-core nlohmann-json3-dev pkgconf python3 python3-matplotlib

build=$root/build/benchmarks
cmake -S "$root" -B "$build" -G Ninja -D CMAKE_BUILD_TYPE=Release -D GNOMON_BUILD_BENCHMARKS=ON \
    -D GNOMON_BUILD_TESTS=OFF -D GNOMON_BUILD_EXAMPLES=OFF
cmake --build "$build" --target "$target"

# shellcheck disable=SC2086  # nothing, or one word
exec sh "$root/benchmarks/$target/make.sh" "$build/benchmarks/$target" "$out" $quick
