#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# Makes a package, installs it as its users do, and builds and runs a program with it:
#     sh packaging/test.sh [--stand-in] [--tarball FILE] [FORM...]
# FORM is vcpkg, conan, debian, cpack, ros, pkg-config or single-header; without one it is each of these.
# The source is that tarball, or one of this tree (tools/release.sh --source). vcpkg, conan and colcon are
# taken from the path; where one is missing, and with --stand-in, its steps are run without it, and the
# last line states it. debian needs root and a mirror of Debian, and installs what it runs. Exit status
# 77: something that a form cannot do without is missing.
# shellcheck disable=SC2016,SC2317  # functions are called by their names in variables
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
. "$root/tools/setup.sh"  # print_head, python_with, set_up
if [ "${1-}" = --help ]; then
    print_head "$0"
    exit 0
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

stand_in=''
if [ "${1-}" = --stand-in ]; then
    stand_in=yes
    shift
fi
tarball=''
if [ "${1-}" = --tarball ]; then
    tarball=$(realpath "$2")
    shift 2
else
    sh "$root/tools/release.sh" --source "$work"
    tarball=$(echo "$work"/*.tar.gz)
fi
tar -x -f "$tarball" -C "$work"
src=$(echo "$work"/gnomon-*/)
src=${src%/}
version=${src##*/gnomon-}
[ $# -gt 0 ] || set -- vcpkg conan debian cpack ros pkg-config single-header

run() {
    echo "+ $*" | sed "s|$work|WORK|g"
    "$@"
}
run_quietly() {
    echo "+ $*" | sed "s|$work|WORK|g"
    "$@" >"$work/log" 2>&1 || { cat "$work/log"; return 1; }
}
has() { command -v "$1" >/dev/null; }
has_client() { [ -z "$stand_in" ] && has "$1"; }

# consumer FOLDER [option of cmake...]: configures, builds and runs a project of tests/consumer.
consumer() {
    project=$1
    shift
    rm -rf "$work/consumer"
    run_quietly cmake -S "$src/tests/consumer/$project" -B "$work/consumer" "$@"
    run_quietly cmake --build "$work/consumer" --target consumer
    run "$work/consumer/consumer"
}

# install_to PREFIX
install_to() {
    run_quietly cmake -S "$src" -B "$work/build" -D GNOMON_BUILD_TESTS=OFF -D GNOMON_BUILD_EXAMPLES=OFF
    run_quietly cmake --install "$work/build" --prefix "$1"
}

# From the tree that the port is in, and with the port elsewhere, the tarball next to it.
test_vcpkg() {
    mkdir "$work/ports"
    cp -r "$src/packaging/vcpkg/gnomon" "$work/ports"
    cp "$tarball" "$work/ports/gnomon/gnomon-$version.tar.gz"
    for port in "$src/packaging/vcpkg" "$work/ports"; do
        installed=$work/installed
        if has_client vcpkg; then
            vcpkg_root=${VCPKG_ROOT:-$(dirname "$(command -v vcpkg)")}
            run_quietly vcpkg install 'gnomon[core]' --classic --overlay-ports="$port" \
                --overlay-ports="$src/tests/packages/vcpkg" --x-install-root="$installed" \
                --x-buildtrees-root="$work/buildtrees" --x-packages-root="$work/packages" \
                --binarysource=clear --triplet=x64-linux --vcpkg-root="$vcpkg_root"
            if grep 'gnomon/portfile.cmake: warning' "$work/log"; then return 1; fi
            set -- -D CMAKE_TOOLCHAIN_FILE="$vcpkg_root/scripts/buildsystems/vcpkg.cmake" \
                -D VCPKG_MANIFEST_MODE=OFF -D VCPKG_INSTALLED_DIR="$installed"
            installed=$installed/x64-linux
            how="vcpkg itself, $(vcpkg version | sed -n '1s/.*version //p')"
        else
            run_quietly cmake -D PORT_DIR="$port/gnomon" -D INSTALLED="$installed" -D WORK="$work/vcpkg" \
                -P "$src/tests/packages/vcpkg/stand_in.cmake"
            set -- -D CMAKE_PREFIX_PATH="$installed"
            how="a stand-in for vcpkg, which runs the steps of the port"
        fi
        consumer find_package "$@"
        run test -s "$installed/share/gnomon/copyright" -a -s "$installed/share/gnomon/usage"
        rm -rf "$work/installed" "$work/packages" "$work/buildtrees"
    done
    outcome "$how"
}

test_conan() {
    mkdir "$work/recipe"
    cp -r "$src/packaging/conan" "$work/recipe/gnomon"
    cp "$tarball" "$work/recipe/gnomon/gnomon-$version.tar.gz"
    if has_client conan; then
        export CONAN_HOME="$work/conan"
        run_quietly conan profile detect
        for library in boost eigen nlohmann_json; do
            run_quietly conan create "$src/tests/packages/conan" --name "$library" --no-remote
        done
        for recipe in "$src/packaging/conan" "$work/recipe/gnomon"; do
            run_quietly conan create "$recipe" --no-remote -s compiler.cppstd=20
            run_quietly conan create "$recipe" --no-remote -s compiler.cppstd=20 -o '&:json=True'
        done
        if conan create "$src/packaging/conan" --no-remote -s compiler.cppstd=17 >"$work/log" 2>&1; then
            echo "C++17 is not refused"
            return 1
        fi
        outcome "Conan itself, $(conan --version | sed 's/.*version //')"
    else
        run python3 "$src/tests/packages/conan/stand_in.py" "$src/packaging/conan" "$work/conan"
        consumer single_header -D GNOMON_SINGLE_INCLUDE="$work/conan/include"
        outcome "a stand-in for Conan, which runs the methods of the recipe"
    fi
}

test_debian() {
    set_up dpkg-dev debhelper lintian mmdebstrap libeigen3-dev
    for tool in dpkg-buildpackage dh lintian mmdebstrap; do
        has "$tool" || { echo "debian: $tool is missing"; return 77; }
    done
    mkdir "$work/deb"
    cp "$tarball" "$work/deb/gnomon_$version.orig.tar.gz"
    tar -x -f "$tarball" -C "$work/deb"
    cp -r "$src/packaging/debian" "$work/deb/gnomon-$version/debian"
    (cd "$work/deb/gnomon-$version" && run_quietly dpkg-buildpackage -us -uc)
    run lintian --display-info --fail-on error,warning,info "$work"/deb/*.changes
    deb=$work/deb/libgnomon-dev_$version-1_all.deb
    cp -r "$src/tests/consumer" "$work/consumers"

    # A system with nothing but apt, into which the package brings what it depends on.
    cat >"$work/in_chroot.sh" <<'EOF'
set -eux
export DEBIAN_FRONTEND=noninteractive
apt-get install -y -qq --no-install-recommends /tmp/libgnomon-dev.deb g++ cmake make pkgconf >/tmp/log 2>&1 ||
    { cat /tmp/log; exit 1; }
cmake -S /tmp/consumers/find_package -B /tmp/build
cmake --build /tmp/build
/tmp/build/consumer
sh /tmp/consumers/pkg_config.sh /usr/share/pkgconfig /tmp/pkg_config g++
apt-get remove -y -qq libgnomon-dev >/dev/null
test ! -e /usr/include/gnomon
EOF
    cp "$deb" "$work/libgnomon-dev.deb"
    sources=/etc/apt/sources.list.d/debian.sources
    [ -e "$sources" ] || sources=/etc/apt/sources.list
    run mmdebstrap --variant=apt --format=null --quiet \
        --customize-hook="copy-in $work/libgnomon-dev.deb $work/consumers $work/in_chroot.sh /tmp" \
        --customize-hook='chroot "$1" sh /tmp/in_chroot.sh' \
        "$(. /etc/os-release && echo "$VERSION_CODENAME")" /dev/null "$sources"
    outcome "dpkg-buildpackage, lintian, and apt in a new chroot"
}

test_cpack() {
    run_quietly cmake -S "$src" -B "$work/build" -D GNOMON_BUILD_TESTS=OFF -D GNOMON_BUILD_EXAMPLES=OFF
    (cd "$work/build" && run_quietly cpack)
    mkdir "$work/anywhere"
    run tar -x -f "$work/build/gnomon-$version-headers.tar.gz" -C "$work/anywhere"
    consumer find_package -D CMAKE_PREFIX_PATH="$work/anywhere/gnomon-$version-headers"
    outcome "cpack, and the tarball unpacked elsewhere"
}

test_ros() {
    mkdir -p "$work/workspace/src"
    cp -r "$src" "$work/workspace/src/gnomon"
    cp -r "$src/tests/packages/ros" "$work/workspace/src/gnomon_consumer"
    cp "$src/tests/consumer/main.cpp" "$work/workspace/src/gnomon_consumer"
    if has_client colcon && [ -d /usr/share/ament_cmake ]; then
        # The Python of the system, for which ament_cmake is installed.
        (cd "$work/workspace" && run_quietly colcon build \
            --cmake-args -D Python3_EXECUTABLE="$(python_with ament_package)")
        [ ! -e "$work/workspace/build/gnomon/tests" ]  # by colcon.pkg
        run "$work/workspace/install/gnomon_consumer/lib/gnomon_consumer/consumer"
        outcome "colcon, with a package of ament_cmake that depends on gnomon"
    else
        install_to "$work/workspace/install/gnomon"
        [ -e "$work/workspace/install/gnomon/share/gnomon/package.xml" ]
        consumer find_package -D CMAKE_PREFIX_PATH="$work/workspace/install/gnomon"
        outcome "the steps of colcon without it"
    fi
}

test_pkg_config() {
    install_to "$work/prefix"
    run mv "$work/prefix" "$work/moved"
    run sh "$src/tests/consumer/pkg_config.sh" "$work/moved/share/pkgconfig" "$work/pkg_config" "${CXX:-g++}"
    outcome "pkg-config, on an installation that was moved"
}

test_single_header() {
    mkdir -p "$work/single/gnomon"
    run python3 "$src/tools/amalgamate.py" --output "$work/single/gnomon-$version.hpp"
    echo "#include <gnomon-$version.hpp>" >"$work/single/gnomon/gnomon.hpp"
    consumer single_header -D GNOMON_SINGLE_INCLUDE="$work/single"
    outcome "the file under its own name, and a compiler"
}

outcome() { echo "$form: passed, by $1"; }

status=0
for form in "$@"; do
    case $form in
        vcpkg | conan | debian | cpack | ros | pkg-config | single-header) ;;
        *) echo "no form of package: $form" && exit 1 ;;
    esac
    echo "---- $form"
    set +e  # inside of an `if` or `||` the shell would not stop at errors
    (set -e; "test_$(echo "$form" | tr - _)")
    result=$?
    set -e
    if [ $result -ne 0 ]; then
        [ $result -eq 77 ] && [ $# -gt 1 ] || status=$result
        echo "$form: $([ $result -eq 77 ] && echo passed over || echo FAILED)"
    fi
    rm -rf "$work/build"
done
exit $status
