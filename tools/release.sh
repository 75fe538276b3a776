#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# Builds the files of a release, of the last commit, the same bytes on each run:
#     sh tools/release.sh [DIR]      into DIR (build/release_files)
#     sh tools/release.sh --check    twice, in different folders, time zones and umasks, and compares
#     sh tools/release.sh --source DIR    only the tarball of the source, with changes not committed
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"
version=$(python3 tools/packages.py --version)
name=gnomon-$version
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# pack FOLDER FILE: FOLDER as a tarball without traces of time, user and file system.
pack() {
    tar --sort=name --mtime="@$SOURCE_DATE_EPOCH" --owner=0 --group=0 --numeric-owner --mode=u=rwX,go=rX \
        --format=ustar -C "$(dirname "$1")" -c "$(basename "$1")" | gzip -9n >"$2"
}

# source_tarball COMMIT DIR [LEVEL of gzip]: outside of a clone, of the tree as it is.
source_tarball() {
    if [ -z "$(git rev-parse --show-prefix 2>/dev/null || echo none)" ]; then
        git archive --format=tar --prefix="$name/" "$1" | gzip -n "${3:--9}" >"$2/$name.tar.gz"
    else
        mkdir "$work/$name"
        tar --exclude=./build --exclude=__pycache__ -c . | tar -x -C "$work/$name"
        pack "$work/$name" "$2/$name.tar.gz"
    fi
}

if [ "${1-}" = --source ]; then
    SOURCE_DATE_EPOCH=0
    changed=$(git stash create 2>/dev/null || true)
    mkdir -p "$2"
    source_tarball "${changed:-HEAD}" "$2" -1
    exit 0
fi

SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH
[ -z "$(git status --porcelain)" ] || echo "Changes that are not committed are left out"

# release WORK OUT: makes the tarball of the source, unpacks it, and makes all other files from that.
release() {
    mkdir -p "$1" "$2"
    source_tarball HEAD "$2"
    tar -x -f "$2/$name.tar.gz" -C "$1"
    src=$1/$name

    python3 "$src/tools/amalgamate.py" --output "$2/$name.hpp"

    # What CPack makes has the time of the build in it: packed again.
    cmake -S "$src" -B "$1/build" -D GNOMON_BUILD_TESTS=OFF -D GNOMON_BUILD_EXAMPLES=OFF >/dev/null
    (cd "$1/build" && cpack >/dev/null)
    mkdir "$1/cpack"
    tar -x -f "$1/build/$name-headers.tar.gz" -C "$1/cpack"
    pack "$1/cpack/$name-headers" "$2/$name-headers.tar.gz"

    hash=$(sha512sum "$2/$name.tar.gz" | cut -d' ' -f1)
    mkdir "$1/port" "$1/recipe"
    cp -r "$src/packaging/vcpkg/gnomon" "$1/port/gnomon"
    sed -i "s/^set(tarball_sha512 .*/set(tarball_sha512 $hash)/" "$1/port/gnomon/portfile.cmake"
    pack "$1/port/gnomon" "$2/$name-vcpkg-port.tar.gz"

    hash=$(sha256sum "$2/$name.tar.gz" | cut -d' ' -f1)
    cp -r "$src/packaging/conan" "$1/recipe/gnomon"
    sed -i "s/^    sha256: .*/    sha256: \"$hash\"/" "$1/recipe/gnomon/conandata.yml"
    pack "$1/recipe/gnomon" "$2/$name-conan-recipe.tar.gz"

    if command -v dh >/dev/null && command -v dpkg-buildpackage >/dev/null; then
        cp -r "$src/packaging/debian" "$src/debian"
        (cd "$src" && dpkg-buildpackage -b -us -uc >"$1/dpkg-buildpackage.log" 2>&1) ||
            { cat "$1/dpkg-buildpackage.log"; return 1; }
        cp "$1"/*.deb "$2"
    else
        echo "Without debhelper there is no package for Debian"
    fi

    (cd "$2" && sha256sum -- *gnomon* >SHA256SUMS)
}

if [ "${1-}" = --check ]; then
    (umask 022; TZ=UTC release "$work/first" "$work/1")
    (umask 077; TZ=Asia/Tokyo LC_ALL=C release "$work/second_folder" "$work/2")
    diff -r "$work/1" "$work/2"
    cat "$work/1/SHA256SUMS"
    echo "The same bytes twice"
else
    out=${1:-build/release_files}
    release "$work/files" "$out"
    cat "$out/SHA256SUMS"
fi
