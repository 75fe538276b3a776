# shellcheck shell=sh
# SPDX-License-Identifier: BSL-1.0
# Sourced by the run.sh scripts: sees to it that packages are there.

# set_up PACKAGE... [-- OPTIONAL_PACKAGE...]: installs what is missing of these, on systems of the
# Debian family; elsewhere it only says what it would have installed. Never fails: if something
# that is needed is really missing, CMake says what. Optional packages are those that older or newer
# releases do not have.
set_up() {
    if ! command -v dpkg-query >/dev/null; then
        echo "This is no Debian or Ubuntu: please have the counterparts of these installed: $*"
        return 0
    fi

    missing='' optional='' into=missing
    for package in "$@"; do
        if [ "$package" = -- ]; then
            into=optional
        elif ! dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed'; then
            if [ $into = missing ]; then missing="$missing $package"; else optional="$optional $package"; fi
        fi
    done
    [ -n "$missing$optional" ] || return 0

    as_root=''
    if [ "$(id -u)" -ne 0 ]; then
        if ! command -v sudo >/dev/null; then
            echo "Neither root nor sudo: please have these installed:$missing$optional"
            return 0
        fi
        as_root=sudo
        [ -t 0 ] || as_root="sudo -n"  # no terminal to type a password on
    fi

    echo "Installing$missing$optional"
    $as_root apt-get update -qq || echo "apt-get update failed; going on with what is known"
    for package in $optional; do
        if apt-cache show "$package" >/dev/null 2>&1; then missing="$missing $package"; fi
    done
    if [ -n "$missing" ]; then
        # shellcheck disable=SC2086  # a list of words
        $as_root env DEBIAN_FRONTEND=noninteractive \
            apt-get install -y -qq --no-install-recommends $missing ||
            echo "apt-get could not install$missing; going on with what is there"
    fi
}

# What every build needs (Boost for Hana, which the registry of estimators unfolds), and what the
# examples need in addition (a font for the labels of pictures; zlib, because Assimp links it and its
# package does not require it).
build_packages="g++ cmake ninja-build libeigen3-dev libnanoflann-dev libboost-dev"
example_packages="libstb-dev fonts-dejavu-core nlohmann-json3-dev libassimp-dev zlib1g-dev"

# print_head SCRIPT: the comment at the head of a script, which is its usage.
print_head() { awk 'NR > 2 { if (!/^#/) exit; sub(/^# ?/, ""); print }' "$1"; }

# python_with MODULE: names a Python that has this module. The system's packages are for the system's
# own Python, which need not be the first on the path.
python_with() {
    for python in python3 /usr/bin/python3; do
        if "$python" -c "import $1" 2>/dev/null; then break; fi
    done
    echo "$python"
}
