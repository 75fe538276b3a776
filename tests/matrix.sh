#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# Compiles the headers, programs and tests with every compiler, standard library and target of
# docs/platforms.md that is installed here, with warnings as errors, runs them, and prints the
# outcome of each row:
#     sh tests/matrix.sh [--install] [ROW...]      --install: first installs the compilers with apt
# The variable `steps`, e.g. steps="headers core", limits what is run of each row. Ends with 1 if a
# row failed. The messages of compilers and programs are in build/matrix/ROW.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
. "$root/tools/setup.sh"
if [ "${1-}" = --help ]; then
    print_head "$0"
    exit 0
fi
cd "$root"
if [ "${1-}" = --install ]; then
    shift
    # shellcheck disable=SC2086  # a list of words
    set_up $build_packages googletest -- clang-14 clang-16 libc++-16-dev libc++abi-16-dev lld-16 g++-11 \
        g++-12 g++-12-multilib wasi-libc libclang-rt-16-dev-wasm32 libc++-16-dev-wasm32 \
        libc++abi-16-dev-wasm32 nodejs g++-mingw-w64-x86-64-posix wine wine64 g++-aarch64-linux-gnu qemu-user
fi

# Header-only libraries from the system's include directory, without its other headers.
out=$root/build/matrix
mkdir -p "$out/libraries"
for library in boost nanoflann.hpp; do
    if [ -e /usr/include/$library ]; then ln -sfn /usr/include/$library "$out/libraries/$library"; fi
done
googletest=/usr/src/googletest/googletest
settings="-std=c++20 -O1 -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror -I include -I tests \
    -isystem /usr/include/eigen3 -idirafter $out/libraries"
wanted=" $* "
table='' failed=0
ccache=$(command -v ccache || true)

# step NAME COMMAND...: notes whether it succeeded; what it printed is in $out/$row/NAME.log.
step() {
    name=$1
    shift
    if "$@" >"$out/$row/$name.log" 2>&1; then
        ran="$ran $name"
    else
        broken="$broken $name"
    fi
}

# program NAME ARGUMENTS: compiles what the arguments of the compiler name, and runs it.
program() {
    # shellcheck disable=SC2086  # lists of words
    $ccache $compile $settings $2 -c -o "$out/$row/$1.o" &&
        $compile "$out/$row/$1.o" $objects -o "$out/$row/$1.exe" && $run "$out/$row/$1.exe"
}

# The tests of a floor as one file, without those that need CGAL or match $without.
unity() {
    for test in tests/"$1"/*_test.cpp; do
        if ! grep -qE "CGAL$without" "$test"; then echo "#include \"${test#tests/}\""; fi
    done
    case $without in
        *shared_file*) ;;
        *) printf '#define GNOMON_SHARED_DATA ""\n#include "shared_file.cpp"\n' ;;
    esac
}

refused() {  # an error that is not caught ends the program with its message
    if $run "$out/$row/corner.exe" refused >"$out/$row/message" 2>&1; then return 1; fi
    grep -q 'k must be' "$out/$row/message"
}

# row NAME WHAT COMPILER [OPTION...]: WHAT lists "headers", "corner" (a program), "refused" (that
# program's error), examples as example:NAME, and floors whose tests run. $run runs a program,
# $without is a pattern of tests that are left out.
row() {
    row=$1 what=$2
    shift 2
    compile=$* ran='' broken=''
    if [ "$wanted" != '  ' ] && ! echo "$wanted" | grep -q " $row "; then return 0; fi
    if ! command -v "$1" >/dev/null || { [ -n "$run" ] && ! command -v "${run%% *}" >/dev/null; } ||
        ! echo '#include <vector>' | $compile -std=c++20 -fsyntax-only -x c++ - 2>/dev/null; then
        table="$table$row|-|passed over: not installed\n"
        return 0
    fi
    if [ -z "${steps-}" ]; then rm -rf "${out:?}/$row"; fi
    mkdir -p "$out/$row"
    objects=''
    for each in $what; do
        if [ -n "${steps-}" ] && ! echo " $steps " | grep -q " ${each#*:} "; then continue; fi
        case $each in
            headers)
                find include/gnomon -name '*.hpp' ! -path '*/adapters/*' | sort |
                    sed 's,include/\(.*\),#include <\1>,' >"$out/$row/headers.cpp"
                # shellcheck disable=SC2086  # lists of words
                step headers $compile $settings -fsyntax-only "$out/$row/headers.cpp"
                ;;
            corner) step corner program corner tests/platforms/corner.cpp ;;
            refused) step refused refused ;;
            example:*) step "${each#*:}" program "${each#*:}" "-I examples examples/${each#*:}.cpp" ;;
            *)
                if [ -z "$objects" ]; then
                    for part in gtest-all gtest_main; do
                        # shellcheck disable=SC2086  # lists of words
                        step $part $ccache $compile -std=c++20 -w -I $googletest -I $googletest/include \
                            -c $googletest/src/$part.cc -o "$out/$row/$part.o"
                        objects="$objects $out/$row/$part.o"
                    done
                    ran=${ran% gtest-all gtest_main}
                fi
                unity "$each" >"$out/$row/$each.cpp"
                step "$each" program "$each" "-isystem $googletest/include $out/$row/$each.cpp"
                ;;
        esac
    done
    outcome=ok
    if [ -n "$broken" ]; then
        failed=1
        outcome=FAILED:$broken
    fi
    table="$table$row|${ran:- -}|$outcome\n"
    echo "$row:$ran; $outcome"
}

floors="core neighborhoods normals io"
examples="example:quick_start example:own_estimator example:use_index"

run='' without=''
row g++-12 "headers corner $examples" g++-12 -pthread
row g++-12-scalar "headers corner core neighborhoods" g++-12 -pthread -DGNOMON_SCALAR_LANES
row g++-11 "headers corner $examples $floors" g++-11 -pthread
row clang-16-libc++ "headers corner $examples $floors" clang++-16 -stdlib=libc++ -pthread
row clang-14 "headers corner $examples $floors" clang++-14 -pthread

# Tests that expect an exception, or threads, are left out where there are none. (io_test_support
# catches errors, nanoflann throws them.)
throwing='|THROW|throw|catch|io_test_support|nanoflann'
without=$throwing
row no-exceptions "headers corner refused $floors" g++-12 -pthread -fno-exceptions
row no-threads "headers corner core" g++-12 -DGNOMON_NO_THREADS
without="$throwing|<thread>|<mutex>|<atomic>|shared_file|unistd" run="node --no-warnings tests/platforms/wasi.mjs"
row wasm32-wasi "headers corner refused $floors" clang++-16 --target=wasm32-wasi -stdlib=libc++ \
    -fno-exceptions -DGTEST_HAS_PTHREAD=0 -DGTEST_HAS_STREAM_REDIRECTION=0

export WINEDEBUG=-all
without='|unistd|aligned_alloc' run=wine
row mingw-w64 "headers corner $examples $floors" x86_64-w64-mingw32-g++-posix -static
row mingw-w64-windows.h headers x86_64-w64-mingw32-g++-posix -DNOMINMAX -include windows.h
without='' run="qemu-aarch64 -L /usr/aarch64-linux-gnu"
# g++ notes that some arguments are passed in another way since its version 10.
row aarch64 "headers corner $examples $floors" aarch64-linux-gnu-g++ -Wno-psabi -pthread

run='' without=''
as_32_bit="-m32 -idirafter /usr/include/x86_64-linux-gnu"  # of which is <asm/errno.h>
# shellcheck disable=SC2086  # lists of words
row i686-sse2 "headers corner $examples $floors" g++-12 $as_32_bit -msse2 -mfpmath=sse -pthread
# shellcheck disable=SC2086  # lists of words
row i686 "headers corner" g++-12 $as_32_bit -pthread

printf '\n%b' "row|what ran|outcome\n$table" | column -t -s '|'
exit $failed
